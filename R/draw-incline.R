# A body on its incline: the slope to its angle, the body as its beta says, and all forces on it, in
# one scale: its weight at the centre, at the contact the normal force and the friction.

# Forces of a row in N: c(weight, normal, friction, applied) along their own directions. The normal
# force acts from below (from above on an incline of more than a right angle); friction and what the
# scene applies are along the incline.
incline_forces <- function(scene, rows, i = 1L) {
  weight <- scene$mass_kg * scene$gravity_m_per_s2
  friction <- rows[["friction_force_n"]][i]
  c(
    weight = weight, normal = weight * cospi(scene$incline_angle_deg / 180),
    friction = if (length(friction)) friction else NA_real_,
    applied = if (is.numeric(scene$force)) scene$force[1] else 0
  )
}

# The body with its centre at `centre`, radius r in the drawing, turned by `angle` from the normal;
# `unit`: length of a newton.
incline_body <- function(d, scene, centre, r, angle, forces, unit) {
  slope <- scene$incline_angle_deg * pi / 180
  along <- c(cos(slope), -sin(slope))
  out <- c(sin(slope), cos(slope))
  beta <- scene$moment_of_inertia_kg_m2 / (scene$mass_kg * scene$radius_m^2)
  d$add(mark("fill", draw_circle(centre[1], centre[2], r), "body"))
  hole <- hole_of_beta(beta)
  if (hole > 0) d$add(mark("fill", draw_circle(centre[1], centre[2], hole * r), "#FFFFFF"))
  for (k in 1:4) d$add(spoke(centre[1], centre[2], r, pi / 2 - slope - angle + (k - 1) * pi / 2))
  dot <- pi / 2 - slope - angle
  at <- centre + 0.72 * r * c(cos(dot + 0.35), sin(dot + 0.35))
  d$add(mark("fill", draw_circle(at[1], at[2], 0.09 * r), "#0072B2"))
  contact <- centre - r * out
  arrow <- function(from, direction, force, symbol, style, side) {
    long <- unit * force
    if (!isTRUE(abs(long) > 0.02)) return()
    tip <- from + long * direction
    d$add(mark("arrow", rbind(from, tip), style))
    beside <- sign(side) * c(-direction[2], direction[1])
    beyond <- (if (style == "weight") -0.12 else 0.05) * sign(long) * direction
    away <- if (style == "weight") 0.18 else 0.15
    d$say(symbol, tip[1] + away * beside[1] + beyond[1], tip[2] + away * beside[2] + beyond[2])
  }
  arrow(centre, c(0, -1), forces[["weight"]], "m*g", "weight", if (slope < 0) 1 else -1)
  arrow(contact, out, forces[["normal"]], "N", "torque", 1)
  arrow(contact, along, forces[["friction"]], "F[f]", "resistance", -1)
  arrow(centre, along, forces[["applied"]], "F", "spring", 1)
}

incline_scale <- function(forces, long) {
  largest <- max(abs(forces), na.rm = TRUE)
  if (largest > 0) long / largest else 0
}

draw_incline <- function(scene) {
  d <- new_drawing()
  slope <- scene$incline_angle_deg * pi / 180
  along <- c(cos(slope), -sin(slope))
  out <- c(sin(slope), cos(slope))
  r <- 0.36
  centre <- -0.25 * along + r * out
  ends <- rbind(-1.25 * along, 1.25 * along)
  low <- min(ends[, 2]) - 0.08
  ground <- rbind(ends, c(ends[2, 1], low), c(ends[1, 1], low))
  d$add(mark("fill", ground, "fixed"))
  forces <- incline_forces(scene, start_row(scene))
  incline_body(d, scene, centre, r, 0, forces, incline_scale(forces, 0.85))
  d$keys(size_quantities(scene$body))
  d$key(quantity("alpha", "incline", value_text(scene$incline_angle_deg, "degrees")))
  corner <- if (slope >= 0) ends[2, ] else ends[1, ]
  if (slope != 0) d$say("alpha", corner[1] - sign(slope) * 0.4, corner[2] + 0.06)
  force <- function(name, symbol, words, style) {
    if (isTRUE(forces[[name]] != 0)) {
      d$key(quantity(symbol, words, value_text(abs(forces[[name]]), "N"), style))
    }
  }
  force("weight", "m*g", "weight", "weight")
  force("normal", "N", "normal force", "torque")
  force("friction", "F[f]", "friction at start", "resistance")
  force("applied", "F", "force", "spring")
  if (scene$v0_m_per_s != 0) {
    # Beside the tip of the normal force.
    from <- centre + (r + 0.12) * out + 0.12 * sign(scene$v0_m_per_s) * along
    tip <- from + 0.5 * sign(scene$v0_m_per_s) * along
    d$add(mark("arrow", rbind(from, tip), "speed"))
    d$say("v[0]", tip[1], tip[2] + 0.14)
  }
  d$key(quantity("v[0]", "velocity at start", value_text(scene$v0_m_per_s, "m/s"), "speed"))
  if (scene$omega0_rad_per_s != 0) {
    ends_deg <- 90 - sign(scene$omega0_rad_per_s) * c(-50, 50)
    d$add(mark("arrow", draw_arc(centre[1], centre[2], 0.6 * r, ends_deg[1], ends_deg[2]), "speed"))
    aside <- if (scene$v0_m_per_s < 0) 0.55 else -0.55
    d$say("omega[0]", centre[1] + aside, centre[2] + 0.3)
  }
  d$key(start_rate(scene))
  d$key(quantity("mu[s]", "static friction", format_si(scene$static_friction), "resistance"))
  d$key(quantity("mu[k]", "kinetic friction", format_si(scene$kinetic_friction), "resistance"))
  if (scene$rolling_arm_m > 0) {
    d$key(quantity(
      "b", "arm of rolling resistance", value_text(scene$rolling_arm_m, "m"), "resistance"
    ))
  }
  d$done(c(-1.5, 1.5, -1.5, 1.5), "Forces in one scale; the body not to scale.")
}

# In motion, to scale: a window over the whole path, or one that follows the body along it. Units
# are those of its half width.
incline_frames <- function(scene, rows) {
  r <- scene$radius_m
  x <- rows$x_m
  slope <- scene$incline_angle_deg * pi / 180
  along <- c(cos(slope), -sin(slope))
  out <- c(sin(slope), cos(slope))
  follows <- diff(range(x)) > 14 * r
  half <- if (follows) 6 * r else max(3 * r, 0.7 * diff(range(x)) + 1.5 * r)
  origin <- if (follows) x else rep(mean(range(x)), length(x))
  speed <- rows$v_m_per_s / max(abs(rows$v_m_per_s), .Machine$double.xmin)
  touches <- scene$gravity_m_per_s2 > 0
  size <- r / half
  maximum <- vapply(seq_along(x), function(i) {
    incline_scale(incline_forces(scene, rows, i), 0.5)
  }, 0)
  unit <- min(maximum[maximum > 0], Inf)
  if (!is.finite(unit)) unit <- 0
  lapply(seq_along(x), function(i) {
    d <- new_drawing()
    at <- function(s) (s - origin[i]) / half * along
    ends <- rbind(-2.2 * along, 2.2 * along)
    d$add(mark("fill", rbind(ends, ends[2:1, ] - rep(2.5 * out, each = 2)), "fixed"))
    # Marks on the ground, a radius apart, each fifth one longer.
    first <- ceiling((origin[i] - 1.5 * half) / r)
    for (k in seq(first, floor((origin[i] + 1.5 * half) / r))) {
      long <- if (k %% 5 == 0) 0.08 else 0.04
      d$add(mark("line", rbind(at(k * r), at(k * r) - long * out), "shaft"))
    }
    centre <- at(x[i]) + size * out
    incline_body(
      d, scene, centre, size, rows$theta_rad[i], incline_forces(scene, rows, i), unit
    )
    from <- centre + (size + 0.06) * out
    d$add(mark("arrow", rbind(from, from + 0.3 * speed[i] * along), "speed"))
    if (abs(speed[i]) > 0.1) {
      tip <- from + 0.3 * speed[i] * along + 0.09 * out
      d$say("v[0]", tip[1], tip[2])
    }
    frame <- d$done(c(-1, 1, -1, 1))
    frame$says <- if (!touches) "" else if (rows$rolling[i]) "rolls" else "slips"
    frame
  })
}
