# A body with a fixed point on its stand: the line to its centre of mass, the vertical, weight and
# angular velocity, as its animation shows it (R/draw-space.R).
draw_pivot <- function(scene) {
  d <- new_drawing()
  turn <- matrix_of_quaternion(scene$attitude0, "attitude0", NULL)
  omega <- as.vector(turn %*% scene$omega0_rad_per_s)
  momentum <- as.vector(
    turn %*% (free_tensor(scene) %*% scene$omega0_rad_per_s + rotor_momentum(scene))
  )
  solid <- pivot_solid(scene)
  still <- space_still(solid, turn, list(omega = omega, L = momentum))
  for (one in still$marks) d$add(one)
  for (k in seq_len(NROW(still$labels))) do.call(d$say, as.list(still$labels[k, ]))
  weight <- scene$mass_kg * scene$gravity_m_per_s2
  if (weight > 0) d$key(quantity("m*g", "weight", value_text(weight, "N"), "weight"))
  size <- function(v, unit) value_text(signif(sqrt(sum(v^2)), 4), unit)
  d$key(quantity("omega", "angular velocity", size(omega, "rad/s"), "speed"))
  d$key(quantity("L", "angular momentum", size(momentum, "kg m^2/s"), arrow_styles[["L"]]))
  rotor_quantities(d, scene, turn, still$unit, solid)
  d$key(quantity("r[c]", "centre of mass", size(scene$centre_m, "m"), "body"))
  for (k in 1:3) {
    value <- value_text(scene$moment_of_inertia_kg_m2[k], "kg m^2")
    d$key(quantity(paste0("I[", k, "]"), "moment about the point", value))
  }
  d$done(c(-1.5, 1.5, -1.5, 1.5), "not to scale")
}
