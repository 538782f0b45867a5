# Scenes of gear trains: what they change in the record of R/constraint-axle.R.

# Of a motion of the first shaft: angle and rate of the others, theta/N and omega/N.
shaft_columns <- function(columns, scene) {
  ratio <- ratios_to_first(scene)
  of <- function(column) lapply(ratio, function(one) column / one)
  columns[shaft_names(scene)] <- c(of(columns$theta_rad), of(columns$omega_rad_per_s))
  columns
}

ratios_to_first <- function(scene) cumprod(scene$ratios)

shaft_names <- function(scene) {
  others <- seq_along(scene$ratios) + 1L
  c(sprintf("theta_%d_rad", others), sprintf("omega_%d_rad_per_s", others))
}

gears_maker <- function() {
  list(
    title = function(run) gears_title(run$scene), rows_are = "first shaft",
    quick = FALSE,
    torque = function(scene) {
      torque_constant(attr(train_of_scene(scene), "law")[["applied_n_m"]])
    },
    resistance = function(scene) {
      new_resistance(attr(train_of_scene(scene), "law")[["bearings_n_m_s"]])
    },
    moments = function(scene) check_inertias(scene$bodies, "bodies", NULL),
    more_columns = function(columns, scene, time_s) shaft_columns(columns, scene),
    more_names = shaft_names,
    slopes = function(columns, scene) {
      net <- columns$net_torque_n_m
      ratio <- sign(ratios_to_first(scene))
      others <- c(lapply(ratio, `*`, columns$omega_rad_per_s), lapply(ratio, `*`, net))
      c(stats::setNames(others, shaft_names(scene)), axle_slopes(columns, scene, net))
    },
    drawing = function(scene) draw_train(train_of_scene(scene), scene),
    frames = train_frames
  )
}
