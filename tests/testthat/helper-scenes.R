# Random scenes of all constraints, of parts of all kinds.

one_of <- function(...) list(...)[[sample.int(...length(), 1L)]]

random_body <- function() {
  one_of(
    10^stats::runif(1, -1, 1), random_compound(), random_compound(),
    body_disk(stats::runif(1, 0.5, 4), stats::runif(1, 0.2, 1)),
    body_rod_end(1, stats::runif(1, 0.5, 2)), body_point(stats::runif(1), stats::runif(1, 0.5, 1)),
    body_cylinder(radius_m = 0.3, length_m = 0.8, density_kg_m3 = 500)
  )
}

# With moments about all axes, away from the origin.
random_compound <- function() {
  box <- body_box(3, 0.4, 0.5, 0.3)
  placed <- function(body) {
    turn <- one_of(NULL, rotation_about(stats::rnorm(3), angle_deg = stats::runif(1, 0, 180)))
    place_body(body, stats::rnorm(3, 0, 0.3), turn)
  }
  places <- data.frame(mass_kg = stats::runif(5), x_m = stats::rnorm(5), y_m = stats::rnorm(5))
  corners <- matrix(c(0, 2, 2.5, 1, 0, 0, 0.5, 2), 4)
  one_of(
    placed(box), join_bodies(placed(box), list(placed(body_disk(1, 0.2)), body_sphere(1, 0.1))),
    cut_body(box, place_body(body_sphere(0.01, 0.05), stats::runif(3, -0.1, 0.1))),
    body_points(places),
    body_points(cbind(places[-1], z_m = stats::rnorm(5)), mass_kg = 0.2),
    body_polygon(2, corners), body_polygon(vertices_m = corners, areal_density_kg_m2 = 3),
    placed(body_tetrahedron(1, rbind(diag(3), 0) + 0.1))
  )
}

# A sum of up to four laws, or NULL.
random_torque <- function() {
  stepped <- torque_steps(c(0, 2, 5), stats::rnorm(3))
  laws <- list(
    torque_constant(stats::rnorm(1)), stepped, torque_motor(stats::runif(1, 0.5, 2), 10),
    torque_knots(sort(round(stats::runif(4, 0, 8), 1)), stats::rnorm(4), outside = "hold"),
    torque_pulse(stats::runif(3, 0, 8), stats::runif(1, 0.1, 2), stats::rnorm(1)),
    torque_sinusoid(stats::rnorm(1), stats::runif(1, 0.1, 5), to_s = 4),
    torque_exponential(stats::rnorm(1), stats::runif(1, 0.1, 2)),
    torque_polynomial(c(0, 2, 5), matrix(stats::rnorm(6), 2)),
    torque_spring(stats::runif(1, 0.1, 9)),
    torque_gravity(stats::runif(1, 0.1, 2), stats::runif(1, 0.1, 1)),
    torque_curve(c(-10, 0, 3, 10), c(1, 1, 0.5, -1)), torque_motor(stats::runif(1, 0.5, 2), 20)
  )
  laws <- laws[sample.int(12L, sample(0:4, 1))]
  if (length(laws)) Reduce(`+`, laws)
}

random_resistance <- function() {
  one_of(NULL, resistance(
    one_of(0, stats::runif(1)), one_of(0, 0, stats::runif(1), 1e-12), one_of(0, 0, stats::runif(1))
  ))
}

random_axle <- function() {
  body <- random_body()
  if (stats::runif(1) < 0.15) body <- inertia_knots(c(0, 2, 5), stats::runif(3, 0.5, 2))
  # A point and a rod have an axis without moment of inertia.
  thick <- inherits(body, "rot_body") && !body$shape %in% c("point", "rod_end")
  axis <- if (thick) one_of("z", "x", stats::rnorm(3)) else "z"
  suppressMessages(scene_axle(
    body, random_torque(), random_resistance(), one_of(0, stats::rnorm(1)), one_of(0, 3),
    start_s = one_of(0, 1), axis = axis
  ))
}

random_pendulum <- function() {
  suppressMessages(scene_pendulum(
    one_of(body_rod_end(1.5, 2), body_point(2, 0.5), body_disk(1, 0.2), body_box(1, 0.2, 0.3, 0.4)),
    stats::runif(1, 0.1, 2), random_resistance(), stats::rnorm(1), one_of(0, 2),
    torque = one_of(NULL, NULL, random_torque()), start_s = one_of(0, 1),
    axis = one_of("z", "x", stats::rnorm(3)), gravity_m_per_s2 = one_of(9.80665, 1.62)
  ))
}

random_hanging <- function() {
  scene_hanging_mass(
    one_of(0, 0.3, body_disk(2, 0.1), body_disk(0, 0.1), body_thick_tube(2, 0.1, 0.05, 1)),
    stats::runif(1, 0.1, 3), stats::runif(1, 0.05, 0.5), random_resistance(), one_of(0, 1),
    stats::rnorm(1), counter_mass_kg = one_of(0, 0, stats::runif(1, 0.1, 3))
  )
}

random_gears <- function() {
  n <- sample(1:4, 1)
  scene_gears(
    one_of(as.list(stats::runif(n, 0.01, 1)), replicate(n, body_disk(1, 0.2), simplify = FALSE)),
    sample(c(-3, -0.7, 0.5, 2, 5.1), n - 1, TRUE),
    efficiency = if (n > 1) one_of(1, stats::runif(n - 1, 0.4, 1)) else 1,
    torque = round(stats::rnorm(n), 2), resistance = one_of(0, stats::runif(n, 0, 0.3)),
    omega0_rad_per_s = stats::rnorm(1, sd = 5), start_s = one_of(0, 1)
  )
}

random_rotors <- function() {
  n <- sample(2:4, 1)
  scene_rotors(
    lapply(seq_len(n), function(i) random_body()), 10^stats::runif(n - 1, 1, 9),
    one_of(0, stats::runif(n - 1)), torque = stats::rnorm(n), resistance = one_of(0, 0.1),
    theta0_rad = one_of(0, stats::rnorm(n)), omega0_rad_per_s = stats::rnorm(n)
  )
}

random_clutch <- function() {
  capacity <- stats::runif(1, 0, 12)
  steps <- torque_steps(c(1, 2, 4), stats::rnorm(3))
  scene_clutch(
    random_body(), random_body(), capacity, static_capacity_n_m = capacity * one_of(1, 1.4),
    torque = list(one_of(NULL, steps, steps + torque_pulse(c(0.5, 3), 1, 2) + 1),
      one_of(NULL, stats::rnorm(1))),
    omega0_rad_per_s = c(10, 0), engage_s = one_of(-Inf, 0.7)
  )
}

random_drive <- function() {
  capacity <- one_of(stats::runif(1, 0, 8), torque_knots(c(0, 0.5), c(0, 8), outside = "hold"))
  coupling <- one_of(
    coupling_shaft(stats::runif(1, 50, 800), 0.2, ratio = one_of(1, -3)), coupling_gear(2),
    coupling_clutch(capacity, static_ratio = one_of(1, 1.2), ratio = one_of(1, 0.5))
  )
  scene_drive(
    list(random_body(), 2, random_body()), list(coupling, coupling_shaft(300)),
    torque = list(random_torque(), NULL, 1), resistance = list(NULL, random_resistance(), NULL),
    brake = one_of(NULL, list(NULL, NULL, brake(capacity, from_s = 1))),
    omega0_rad_per_s = one_of(0, 3)
  )
}

random_torques <- function() {
  one_of(NULL, stats::rnorm(3), {
    data.frame(time_s = c(0, 1, 1, 4), x_n_m = stats::rnorm(4), y_n_m = 0, z_n_m = stats::rnorm(4))
  })
}

random_wheels <- function() {
  motor <- data.frame(time_s = c(0, 1, 1, 3), torque_n_m = 1e-3 * stats::rnorm(4))
  wheel <- function(torque) rotor(stats::rnorm(3), 1e-3, stats::rnorm(1, 0, 30), torque)
  one_of(
    NULL, NULL, wheel(NULL), list(wheel(NULL), rotor("y", 2e-3, 5, 0)),
    list(wheel(1e-3), rotor("z", 1e-3, 4, motor))
  )
}

random_attitude <- function() {
  one_of(NULL, attitude_from(c(stats::rnorm(3), stats::runif(1, 0, 3)), "axis_angle"))
}

# A body, a tensor, or three moments.
random_moments <- function() {
  turn <- qr.Q(qr(matrix(stats::rnorm(9), 3)))
  tensor <- turn %*% diag(c(0.1, 0.15, 0.2)) %*% t(turn)
  one_of(
    random_compound(), random_compound(), c(0.11, 0.12, 0.2), tensor / 2 + t(tensor) / 2
  )
}

random_free <- function() {
  scene_free(
    random_moments(), stats::rnorm(3), attitude0 = random_attitude(), torque = random_torques(),
    torque_axes = one_of("body", "space"),
    resistance = resistance(damping_per_s = one_of(0, 0.1)), rotors = random_wheels(),
    start_s = one_of(0, 1)
  )
}

random_pivot <- function() {
  top <- stats::runif(1) < 0.4
  body <- if (top) c(0.0042, 0.0042, 0.002) else random_moments()
  own <- inherits(body, "rot_body")
  arguments <- list(
    body, if (top) c(0, 0, one_of(60, 600)) else stats::rnorm(3), attitude0 = random_attitude(),
    torque = if (!top) random_torques(),
    resistance = resistance(damping_per_s = if (top) 0 else one_of(0, 0.1)),
    rotors = if (!top) random_wheels(), gravity_m_per_s2 = one_of(9.8, 0)
  )
  where <- if (own) list(pivot_m = stats::rnorm(3)) else {
    list(mass_kg = 0.5, centre_m = if (top) c(0, 0, 0.08) else stats::rnorm(3))
  }
  do.call(scene_pivot, c(arguments, where))
}
