# A hoop seen along its plane, its axis, the bead at its angle, the weight; to scale.
draw_hoop <- function(scene, theta = scene$theta0_rad) {
  d <- new_drawing()
  at <- c(sin(theta), -cos(theta))
  around <- seq(0, 2 * pi, length.out = 121)
  d$add(mark("line", rbind(c(0, -1.3), c(0, 1.3)), "resistance"))
  d$add(mark("line", cbind(cos(around), sin(around)), "body"))
  d$add(mark("line", rbind(c(0, 0), at), "resistance"))
  if (scene$gravity_m_per_s2 > 0) d$add(mark("arrow", rbind(at, at - c(0, 0.55)), "weight"))
  d$add(mark("fill", draw_circle(at[1], at[2], 0.07), "body"))
  if (scene$hoop_omega_rad_per_s != 0) {
    # A turn about the vertical, seen a little from above: an arc of an ellipse in front.
    arc <- seq(-0.8 * pi, -0.2 * pi, length.out = 31)
    if (scene$hoop_omega_rad_per_s < 0) arc <- rev(arc)
    d$add(mark("arrow", cbind(0.3 * cos(arc), 1.3 + 0.1 * sin(arc)), "speed"))
    d$say("Omega", 0.45, 1.3)
  }
  if (abs(theta) >= 0.1) {
    d$add(mark("line", draw_arc(0, 0, 0.33, -90, -90 + theta * 180 / pi), "resistance"))
  }
  # There is no room between the lines of a small angle.
  small <- abs(sin(theta)) < 0.4
  side <- if (theta < 0) -1 else 1
  d$say("theta", if (small) 0.45 * sin(theta) + 0.12 * side else 0.45 * sin(theta / 2) + 0.07,
        -0.45 * cos(if (small) theta else theta / 2))
  weight <- scene$mass_kg * scene$gravity_m_per_s2
  if (weight > 0) d$say("m*g", at[1] + 0.2, at[2] - 0.4)
  d$key(quantity("R", "radius of the hoop", value_text(scene$radius_m, "m")))
  d$key(quantity("Omega", "its angular velocity", value_text(scene$hoop_omega_rad_per_s, "rad/s"),
                 "speed"))
  d$key(quantity("theta", "angle at start", value_text(scene$theta0_rad, "rad"), "resistance"))
  d$key(start_rate(scene))
  d$key(quantity("m*g", "weight of the bead", value_text(weight, "N"), "weight"))
  drag <- resistance_term(scene, "drag_n_s_per_m")
  if (drag > 0) {
    d$key(quantity("c", "drag", value_text(drag, "N s/m"), "resistance"))
  }
  if (scene$static_friction > 0) {
    d$key(quantity("mu[s]", "static friction", format_si(scene$static_friction), "resistance"))
    d$key(quantity("mu[k]", "kinetic friction", format_si(scene$kinetic_friction), "resistance"))
  }
  d$done(c(-1.5, 1.5, -1.7, 1.5), "seen from beside the plane of the hoop, which turns")
}

# In motion: the plane of the hoop turns, so that its circle becomes an ellipse, seen from the side
# and a little above.
hoop_frames <- function(scene, rows) {
  around <- seq(0, 2 * pi, length.out = 121)
  above <- 0.25
  shown <- function(x, y, z) cbind(x, cos(above) * z - sin(above) * y)
  seen <- function(turned, theta) {
    x <- sin(theta)
    shown(x * cos(turned), x * sin(turned), -cos(theta))
  }
  turned <- scene$hoop_omega_rad_per_s * (rows$time_s - scene$start_s)
  lapply(seq_along(rows$theta_rad), function(i) {
    bead <- seen(turned[i], rows$theta_rad[i])
    list(
      marks = list(
        mark("line", shown(c(0, 0), c(0, 0), c(-1.3, 1.3)), "resistance"),
        mark("line", seen(turned[i], around), "body"),
        mark("fill", draw_circle(bead[1], bead[2], 0.08), "body")
      ),
      limits = c(-1.4, 1.4, -1.5, 1.5)
    )
  })
}
