# A free body: the homogeneous box or cylinder with its moments, its principal axes, its angular
# velocity and angular momentum, and the wheels of its rotors, as its animation shows it
# (R/draw-space.R).
draw_free <- function(scene) {
  d <- new_drawing()
  moments <- scene$moment_of_inertia_kg_m2
  turn <- matrix_of_quaternion(scene$attitude0, "attitude0", NULL)
  omega <- scene$omega0_rad_per_s
  momentum <- as.vector(free_tensor(scene) %*% omega) + rotor_momentum(scene)
  torque <- if (is.numeric(scene$torque)) scene$torque
  if (!is.null(torque) && scene$torque_axes != "space") torque <- as.vector(turn %*% torque)
  solid <- free_solid(scene)
  still <- space_still(solid, turn, list(
    omega = as.vector(turn %*% omega), L = as.vector(turn %*% momentum), tau = torque
  ))
  for (one in still$marks) d$add(one)
  for (k in seq_len(NROW(still$labels))) do.call(d$say, as.list(still$labels[k, ]))
  # The principal axes, from where they leave the body; their names stand at the ends that
  # arrows point to less often, at the others where an arrow or a name is near.
  view <- view_of_space()
  arrows <- Filter(function(one) one$type == "arrow", still$marks)
  along <- lapply(arrows, function(one) {
    (0:8 / 8) %o% one$points[2, ] + (8:0 / 8) %o% one$points[1, ]
  })
  taken <- do.call(rbind, c(list(c(Inf, Inf), cbind(still$labels$x, still$labels$y)), along))
  axes <- turn %*% axes_of(scene)
  for (k in 1:3) {
    direction <- as.vector(view %*% axes[, k]) * still$unit
    ends <- c(solid$semi[k], solid$semi[k] + 0.22 / still$unit)
    for (side in c(-1, 1)) d$add(mark("line", side * ends %o% direction, "dashed"))
    at <- (ends[2] + 0.13 / still$unit) * rbind(-direction, direction)
    room <- apply(at, 1, function(end) sqrt(min(colSums((t(taken) - end)^2))))
    at <- at[if (room[1] < 0.3 && room[2] > room[1]) 2 else 1, ]
    taken <- rbind(taken, at)
    d$say(paste0("I[", k, "]"), at[1], at[2])
    d$key(quantity(paste0("I[", k, "]"), "principal moment", value_text(moments[k], "kg m^2")))
  }
  size <- function(v, unit) value_text(signif(sqrt(sum(v^2)), 4), unit)
  d$key(quantity("omega", "angular velocity", size(omega, "rad/s"), arrow_styles[["omega"]]))
  d$key(quantity("L", "angular momentum", size(momentum, "kg m^2/s"), arrow_styles[["L"]]))
  rotor_quantities(d, scene, turn, still$unit, solid)
  if (!is.null(torque)) d$key(quantity("tau", "torque", size(torque, "N m"), "torque"))
  damping <- resistance_term(scene, "damping_per_s")
  if (damping != 0) {
    d$key(quantity("gamma", "damping", value_text(damping, "1/s"), "resistance"))
  }
  d$done(c(-1.5, 1.5, -1.5, 1.5), "The homogeneous body with these moments; not to scale.")
}

# Names of the wheels, at the ends of their axes.
rotor_quantities <- function(d, scene, turn, unit, solid) {
  view <- view_of_space()
  for (k in seq_along(scene$rotors)) {
    tip <- as.vector(view %*% turn %*% solid$wheels[[k]]$axis[2, ]) * unit
    symbol <- if (length(scene$rotors) > 1) paste0("W[", k, "]") else "W"
    at <- tip + 0.12 * tip / max(sqrt(sum(tip^2)), 1e-3)
    d$say(symbol, at[1], at[2])
    d$key(quantity(
      symbol, "rotor", value_text(scene$rotors[[k]]$omega_rad_per_s, "rad/s"), "spring"
    ))
  }
}
