# A body with a fixed point: the line to its centre of mass, the vertical, weight and angular
# velocity, seen as draw_free() sees a free body.
draw_pivot <- function(scene) {
  d <- new_drawing()
  view <- view_of_space()
  turn <- matrix_of_quaternion(scene$attitude0, "attitude0", NULL)
  centre <- as.vector(turn %*% scene$centre_m)
  long <- sqrt(sum(centre^2))
  d$add(mark("line", rbind(c(0, -0.2), c(0, 1.35)), "resistance"))
  at <- if (long > 0) as.vector(view %*% centre) / long else c(0, 0)
  if (long > 0) d$add(mark("line", rbind(c(0, 0), at), "body"))
  around <- seq(0, 2 * pi, length.out = 61)
  disk <- function(radius, middle) cbind(middle[1] + radius * cos(around),
                                         middle[2] + radius * sin(around))
  d$add(mark("fill", disk(0.09, at), "body"))
  d$add(mark("fill", disk(0.03, c(0, 0)), "body"))
  weight <- scene$mass_kg * scene$gravity_m_per_s2
  if (weight > 0) {
    d$add(mark("arrow", rbind(at, at - c(0, 0.6)), "weight"))
    d$say("m*g", at[1] - 0.18, at[2] - 0.5)
    d$key(quantity("m*g", "weight", value_text(weight, "N"), "weight"))
  }
  omega <- as.vector(turn %*% scene$omega0_rad_per_s)
  size <- sqrt(sum(omega^2))
  if (size > 0) {
    tip <- as.vector(view %*% omega) * 1.3 / size
    d$add(mark("arrow", rbind(c(0, 0), tip), "speed"))
    aside <- 0.12 * c(-tip[2], tip[1]) / max(sqrt(sum(tip^2)), 1e-3)
    d$say("omega", tip[1] + aside[1], tip[2] + aside[2])
  }
  draw_rotors(d, scene, view %*% turn)
  d$key(quantity("omega", "angular velocity", value_text(signif(size, 4), "rad/s"), "speed"))
  d$key(quantity("r[c]", "centre of mass", value_text(signif(long, 4), "m"), "body"))
  for (k in 1:3) {
    value <- value_text(scene$moment_of_inertia_kg_m2[k], "kg m^2")
    d$key(quantity(paste0("I[", k, "]"), "moment about the point", value, "resistance"))
  }
  d$done(c(-1.5, 1.5, -1.5, 1.5), "not to scale")
}
