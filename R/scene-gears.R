# The constructor of gear trains as scenes: their motion is that of the first shaft on its axle,
# R/constraint-axle.R.

#' @rdname gear_train
#' @inheritParams scene_axle
#' @param brake NULL, or a list of `n` [brake()]s, with NULL for none.
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity of the first shaft at `start_s`.
#' @return `scene_gears()`: a `rot_scene_gears`, which is a `rot_scene_axle`, of the first shaft.
#'   Its motion has a column for the angle and one for the angular velocity of each other shaft:
#'   `theta_2_rad`, `omega_2_rad_per_s`, ...; all angles are 0 where that of the first is. Where a
#'   torque is not constant, a resistance not viscous, or there is a brake, the train is a
#'   [scene_drive()].
#' @export
scene_gears <- function(bodies, ratios, ..., efficiency = 1, torque = 0, resistance = 0,
                        brake = NULL, theta0_rad = 0, omega0_rad_per_s = 0, start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("bodies", "ratios"), call)
  inertia <- check_inertias(bodies, "bodies", call)
  n <- length(inertia)
  loads <- family_loads(torque, resistance, brake, n, call)
  x <- check_train(n, ratios, efficiency, loads$torque, loads$resistance, call)
  if (loads$is_drive) {
    gears <- Map(function(ratio, efficiency) coupling_gear(ratio, efficiency = efficiency),
      x$ratios,
                 x$efficiency)
    return(new_drive(
      bodies, gears, torque = x$torque, resistance = x$resistance, brake = loads$brake,
      theta0_rad = check_number(theta0_rad, "theta0_rad", "rad", call),
      omega0_rad_per_s = check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
      start_s = start_s, call = call
    ))
  }
  finish_scene("axle", c(
    list(bodies = plain_bodies(bodies, inertia) %||% inertia), x,
    list(
      theta0_rad = check_number(theta0_rad, "theta0_rad", "rad", call),
      omega0_rad_per_s = check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
      start_s = check_number(start_s, "start_s", "s", call)
    )
  ), call, "scene_gears")
}

train_of_scene <- function(scene) {
  train_of(
    scene$bodies, scene$ratios, scene$efficiency, scene$torque, scene$resistance, NULL
  )
}

# A line for each shaft.
describe_shafts <- function(train) {
  shown <- seq_len(min(8L, length(train$shaft)))
  efficiency <- c(1, attr(train, "efficiency"))[shown]
  c(
    paste0(
      "  ", format(paste("shaft", train$shaft[shown]), width = 11L), " ",
      format_si(train$moment_of_inertia_kg_m2[shown]), " kg m^2, ratio to the first ",
      format_si(train$ratio_to_first[shown]),
      ifelse(efficiency < 1, paste0(", by a mesh of efficiency ", format_si(efficiency)), ""),
      "\n", recycle0 = TRUE
    ),
    if (length(train$shaft) > 8L) "  ...\n"
  )
}

#' @export
print.rot_scene_gears <- function(x, ...) {
  check_scene(x, current_env())
  train <- train_of_scene(x)
  law <- attr(train, "law")
  print_axle(
    x, scene_title(x), paste(describe_moment(x), "the first shaft"),
    more = describe_shafts(train),
    gears = if (any(x$efficiency < 1)) {
      paste0(
        "loss of ", format_si(law[["forward_n_m"]]), " N m forward, ",
        format_si(law[["backward_n_m"]]), " N m backward, from rest"
      )
    }
  )
}

gears_title <- function(scene) {
  n <- if (inherits(scene$bodies, "rot_body")) 1L else length(scene$bodies)
  paste0("A gear train of ", n, " shaft", if (n != 1L) "s")
}
