# Published answers on kinematics, inertia, energy, angular momentum and precession, as a user would
# ask for them: the inputs of the row in its own units, the answer within its digits.

is_published <- function() {
  rows <- published("openstax_rotation")
  function(id, got) {
    force(id)
    expect_published(got(inputs_of(rows[[id]])), rows[[id]])
  }
}

start_of <- function(moment, omega, ...) {
  trajectory(scene_axle(moment, omega0_rad_per_s = omega, ...), 0)
}

energy_at <- function(moment, omega) start_of(moment, omega)$rotational_kinetic_energy_j

# Omega after the angle, from rest.
spun_over <- function(moment, torque, angle) {
  scene <- scene_axle(moment, torque_constant(torque))
  trajectory(scene, time_when(scene, theta_rad = angle)$time_s[1])$omega_rad_per_s
}

test_that("OpenStax: angular accelerations that change", {
  is <- is_published()
  # omega = (t - 30)^2/100 and its rate.
  slows <- scene_axle(1, torque_knots(c(0, 30), c(-0.6, 0)), omega0_rad_per_s = 9)
  is("UP10-02", function(x) trajectory(slows, x$t_s)$net_torque_n_m)
  expect_equal(trajectory(slows, c(15, 30))$omega_rad_per_s, c(2.25, 0), tolerance = 1e-14)
  is("UP10-13", function(x) {
    trajectory(scene_axle(1, torque_knots(c(0, 10), c(2, -28))), x$t_s)$theta_rad
  })
})

test_that("OpenStax: moments of inertia", {
  is <- is_published()
  washers <- function(x) {
    at <- data.frame(mass_kg = x$m_kg, x_m = c(-x$r_m, x$r_m), y_m = 0, z_m = 0)
    moment_of_inertia(body_points(at), "z")
  }
  is("UP10-20", washers)
  is("UP10-21", washers)
  ringed <- function(x) {
    moment_of_inertia(join_bodies(body_disk(x$M1, x$R1), body_annulus(x$M2, x$ro, x$ri)), "z")
  }
  is("UP10-27", ringed)
  is("UP10-34", function(x) {
    parallel_axis(moment_of_inertia(body_rod(1, 1), "z"), 1, x$d_over_L)
  })
  # A mass per area of r m/(pi R^3), m = R = 1, on a disk of unit thickness.
  is("UP10-69", function(x) {
    r <- function(x_m, y_m, z_m) sqrt(x_m^2 + y_m^2) / pi
    moment_of_inertia(body_density(r, domain_cylinder(1, 1)), "z")
  })
})

test_that("OpenStax: energy, work and power", {
  is <- is_published()
  is("UP10-22", function(x) energy_at(x$I, 2 * pi * x$rev_s))
  is("UP10-25", function(x) {
    energy_at(body_rod(x$m, x$L), 2 * pi * x$rev_s) + x$m * x$v^2 / 2
  })
  is("UP10-28", function(x) energy_at(x$I, 2 * pi * x$rev_s))
  is("UP10-29", function(x) energy_at(body_sphere(x$M, x$R), 2 * pi / x$T))
  is("UP10-60", function(x) spun_over(x$I, x$tau, convert_angle(x$rev, "turn", "rad")))
  is("UP10-61", function(x) {
    # Power is proportional to the torque.
    driven <- start_of(1, convert_angle(x$rpm, "rpm", "rad/s"), torque = torque_constant(1))
    x$P / augment(driven)$power_w
  })
  is("UP10-71", function(x) spun_over(x$I, torque_of_force(x$F, x$R), x$d / x$R))
  is("UP10-80", function(x) energy_at(x$I, x$v / x$r))
  is("CP10-09", function(x) {
    sqrt(x$m * x$v^2 / 2 / (x$eta * energy_at(body_disk(x$M, x$R), 1)))
  })
})

test_that("OpenStax: angular momentum", {
  is <- is_published()
  is("UP11-22", function(x) {
    tip <- body_points(data.frame(mass_kg = c(1, 1.5), x_m = 1, y_m = 0, z_m = 0))
    arm <- join_bodies(body_rod_end(2, 1), tip)
    start_of(inertia_tensor(arm, about = c(0, 0, 0))["z", "z"], pi * x$w_over_pi)$
      angular_momentum_kg_m2_per_s / pi
  })
  is("UP11-26", function(x) {
    blades <- moment_of_inertia(body_rod(x$M, x$L), "z")
    torque <- torque_constant(blades * convert_angle(x$rpm, "rpm", "rad/s") / x$t)
    trajectory(scene_axle(blades, torque), 10)$angular_momentum_kg_m2_per_s
  })
  is("CP10-15", function(x) {
    start_of(body_sphere(x$M, x$R), 2 * pi / 86400)$angular_momentum_kg_m2_per_s
  })
})

test_that("OpenStax: precession", {
  is <- is_published()
  top <- function(g) {
    disk <- body_disk(0.3, 0.05)
    precession_table(data.frame(
      mass_kg = 0.3, lever_arm_m = 0.05, moment_of_inertia_kg_m2 = moment_of_inertia(disk, "z"),
      spin_rad_per_s = 2 * pi * 20, gravity_m_per_s2 = g
    ))
  }
  is("UP11-50", function(x) top(x$g)$precession_rad_per_s)
  is("UP11-51", function(x) top(9.8)$precession_period_s)
  is("UP11-53", function(x) {
    x$w * top(9.8 / 6)$precession_rad_per_s / top(9.8)$precession_rad_per_s
  })
  # A conical pendulum is a top that hangs and hardly spins.
  is("UP11-56", function(x) {
    rate <- function(angle_deg, length_m) {
      bob <- data.frame(
        mass_kg = 1, lever_arm_m = length_m, moment_of_inertia_kg_m2 = 1e-3, spin_rad_per_s = 1e-9
      )
      abs(precession_table(bob, 180 - angle_deg, length_m^2, x$g)$fast_precession_rad_per_s)
    }
    length_m <- (rate(x$th1_deg, 1) / x$w1)^2
    stats::uniroot(function(angle) rate(angle, length_m) - x$w2, c(45, 85), tol = 1e-10)$root
  })
  # Half a turn of the Earth's axis about the pole of the ecliptic.
  is("CP10-29", function(x) {
    tilt <- x$eps_deg * pi / 180
    before <- x$L * c(sin(tilt), 0, cos(tilt))
    half <- attitude_from(c(0, 0, pi), "rotation_vector")
    after <- unlist(attitude_turn(half, rbind(before)))
    sqrt(sum((after - before)^2)) / (x$T_y / 2 * 3.156e7) # the book's year
  })
})

test_that("every row of the textbooks has a test", {
  rows <- published("openstax_rotation")
  text <- unlist(lapply(list.files(".", "^test-.*[.]R$"), readLines, warn = FALSE))
  tested <- vapply(names(rows), function(id) any(grepl(paste0("\"", id, "\""), text)), NA)
  expect_identical(names(rows)[!tested], character())
})
