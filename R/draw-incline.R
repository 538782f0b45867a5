# A body on its incline: the slope to its angle, the body and its arrows not to scale.
draw_incline <- function(scene) {
  d <- new_drawing()
  slope <- scene$incline_angle_deg * pi / 180
  along <- c(cos(slope), -sin(slope))
  out <- c(sin(slope), cos(slope))
  r <- 0.32
  centre <- -0.3 * along + r * out
  ends <- rbind(-1.25 * along, 1.25 * along)
  low <- min(ends[, 2]) - 0.08
  ground <- rbind(ends, c(ends[2, 1], low), c(ends[1, 1], low))
  d$add(mark("fill", ground, "fixed"))
  d$add(mark("fill", draw_circle(centre[1], centre[2], r), "body"))
  d$add(mark("line", rbind(centre, centre + r * out), "body"))
  weight <- scene$mass_kg * scene$gravity_m_per_s2
  d$keys(size_quantities(scene$body))
  d$key(quantity("alpha", "incline", value_text(scene$incline_angle_deg, "degrees")))
  corner <- if (slope >= 0) ends[2, ] else ends[1, ]
  d$say("alpha", corner[1] - sign(slope + (slope == 0)) * 0.5, corner[2] + 0.06)
  if (weight > 0) {
    tip <- centre - c(0, 0.75)
    d$add(mark("arrow", rbind(centre, tip), "weight"))
    d$say("m*g", tip[1] - 0.24, tip[2] + 0.1)
    d$key(quantity("m*g", "weight", value_text(weight, "N"), "weight"))
  }
  if (scene$v0_m_per_s != 0) {
    from <- centre + (r + 0.12) * out
    tip <- from + 0.5 * sign(scene$v0_m_per_s) * along
    d$add(mark("arrow", rbind(from, tip), "speed"))
    d$say("v[0]", tip[1], tip[2] + 0.14)
  }
  d$key(quantity("v[0]", "velocity at start", value_text(scene$v0_m_per_s, "m/s"), "speed"))
  if (scene$omega0_rad_per_s != 0) {
    ends_deg <- 90 - sign(scene$omega0_rad_per_s) * c(-50, 50)
    d$add(mark("arrow", draw_arc(centre[1], centre[2], 0.6 * r, ends_deg[1], ends_deg[2]), "speed"))
    d$say("omega[0]", centre[1] - 0.5, centre[2] + 0.3)
  }
  d$key(start_rate(scene))
  d$key(quantity("mu[s]", "static friction", format_si(scene$static_friction), "resistance"))
  d$key(quantity("mu[k]", "kinetic friction", format_si(scene$kinetic_friction), "resistance"))
  if (scene$rolling_arm_m > 0) {
    d$key(quantity(
      "b", "arm of rolling resistance", value_text(scene$rolling_arm_m, "m"), "resistance"
    ))
  }
  d$done(c(-1.5, 1.5, -1.5, 1.5), "not to scale")
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
  share <- function(column) column / max(abs(column), .Machine$double.xmin)
  speed <- share(rows$v_m_per_s)
  friction <- share(rows$friction_force_n)
  touches <- scene$gravity_m_per_s2 > 0
  size <- r / half
  lapply(seq_along(x), function(i) {
    at <- function(s) (s - origin[i]) / half * along
    ends <- rbind(-2.2 * along, 2.2 * along)
    # Marks on the ground, a radius apart, each fifth one longer.
    first <- ceiling((origin[i] - 1.5 * half) / r)
    numbers <- seq(first, floor((origin[i] + 1.5 * half) / r))
    ticks <- lapply(numbers, function(k) {
      long <- if (k %% 5 == 0) 0.08 else 0.04
      mark("line", rbind(at(k * r), at(k * r) - long * out), "body")
    })
    centre <- at(x[i]) + size * out
    contact <- at(x[i])
    says <- if (!touches) "" else if (rows$rolling[i]) "rolls" else "slips"
    list(
      marks = c(
        list(mark("fill", rbind(ends, ends[2:1, ] - rep(2.5 * out, each = 2)), "fixed")),
        ticks,
        list(
          mark("fill", draw_circle(centre[1], centre[2], size), "body"),
          spoke(centre[1], centre[2], size, pi / 2 - slope - rows$theta_rad[i]),
          mark("arrow", rbind(centre, centre + 0.3 * speed[i] * along), "speed"),
          mark("arrow", rbind(contact, contact + 0.3 * friction[i] * along), "resistance")
        )
      ),
      limits = c(-1, 1, -1, 1), says = says
    )
  })
}
