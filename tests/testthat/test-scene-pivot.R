top <- function(theta_rad = pi / 6, omega3 = 60, ...) {
  scene_pivot(
    c(0.0042, 0.0042, 0.002), c(0, 0, omega3), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
    attitude0 = attitude_from(c(1, 0, 0, theta_rad), "axis_angle"), ...
  )
}

test_that("heavy tops agree with 40-digit values", {
  x <- utils::read.csv(shared("refs", "heavy_top.csv"))
  for (i in seq_len(nrow(x))) {
    e <- x[i, ]
    across <- e$dphi0 * sin(e$theta0)
    scene <- scene_pivot(
      c(e$I1, e$I1, e$I3),
      c(
        e$dtheta0 * cos(e$psi0) + across * sin(e$psi0),
        across * cos(e$psi0) - e$dtheta0 * sin(e$psi0), e$omega3
      ),
      mass_kg = e$Mgl, centre_m = c(0, 0, 1), gravity_m_per_s2 = 1,
      attitude0 = attitude_from(
        c(e$phi0, e$theta0, e$psi0), "euler", sequence = "intrinsic zxz"
      )
    )
    motion <- trajectory(scene, e$t)
    want <- stats::setNames(unlist(e[c("q0", "q1", "q2", "q3")]), c("qw", "qx", "qy", "qz"))
    expect_lte(attitude_difference(motion, want), 2e-15)
    expect_equal(run_of(motion)$model, "pivot_top")
    expect_lte(attitude_difference(motion, want), summary(motion)$error)
    got <- unlist(unclass(motion)[paste0("omega_", c("x", "y", "z"), "_rad_per_s")])
    want <- unlist(e[c("w1", "w2", "w3")])
    expect_lte(max(abs(got - want)), 2e-15 * sqrt(sum(want^2)))
  }
})

test_that("the heavy top of Simo and Wong (1991)", {
  # M = 20, g = l = 1, J = (5, 5, 1), 0.05 rad about x: published H = 1269.975, Lambda_33 = 0.99875.
  # The rest from the root of its cubic (mpmath, 40 digits) and an independent integration.
  tilted <- attitude_from(c(0.05, 0, 0), "rotation_vector")
  published <- scene_pivot(
    c(5, 5, 1), c(0, 0, 50), mass_kg = 20, centre_m = c(0, 0, 1), attitude0 = tilted,
    gravity_m_per_s2 = 1
  )
  motion <- trajectory(published, c(0, 1, 5, 10))
  energy <- motion$rotational_kinetic_energy_j + motion$potential_energy_j
  expect_equal(energy, rep(1269.9750052078994, 4), tolerance = 1e-15)
  expect_equal(cos(motion$inclination_rad[1]), 0.99875, tolerance = 1e-6)
  known <- list( # at 1, 5 and 10 s: omega in the body, the axis in space
    c(-0.0227234352, 0.0368068565, 50, 0.0215411, -0.05001034, 0.99851637),
    c(-0.0127942823, -0.0323965941, 50, 0.04706796, 0.02419568, 0.99859861),
    c(-0.0306183994, 0.0286529742, 50, -0.04713223, 0.02674869, 0.99853045)
  )
  turned <- attitude_to(motion[c("qw", "qx", "qy", "qz")], "matrix")
  for (i in 1:3) {
    row <- i + 1
    omega <- unlist(unclass(motion)[paste0("omega_", c("x", "y", "z"), "_rad_per_s")])
    expect_lt(max(abs(omega[row + c(0, 4, 8)] - known[[i]][1:3])), 1e-10)
    axis <- c(turned[[3]][row], turned[[6]][row], turned[[9]][row])
    expect_lt(max(abs(axis - known[[i]][4:6])), 1e-8)
  }
  # The nutation, from 0.05 rad to where the centre of mass is lowest.
  turns <- motion_events(trajectory(published, c(0, 10)))
  lowest <- predict(motion, turns$time_s[turns$event == "lowest"])
  expect_equal(
    lowest$inclination_rad, rep(0.05455169022434169, nrow(lowest)), tolerance = 1e-14
  )
  highest <- predict(motion, turns$time_s[turns$event == "highest"])
  expect_equal(highest$inclination_rad, rep(0.05, nrow(highest)), tolerance = 1e-14)
})

test_that("the closed form and the integrator agree, along any axis and hanging", {
  t <- seq(-1, 2, length.out = 13)
  moments <- c(0.0042, 0.0042, 0.002)
  for (axis in 1:3) {
    for (lever in c(0.08, -0.08)) {
      order <- (seq(axis, axis + 2) %% 3) + 1 # the third one is `axis`
      m <- w <- r <- double(3)
      m[order] <- moments
      w[order] <- c(1, -2, 40)
      r[order] <- c(0, 0, lever)
      scene <- scene_pivot(
        m, w, mass_kg = 0.5, centre_m = r, attitude0 = c(0.5, 0.5, -0.1, 0.7)
      )
      exact <- trajectory(scene, t)
      expect_identical(run_of(exact)$model, "pivot_top")
      other <- trajectory(scene, t, accuracy = 1e-11, model = "pivot_rk8pd")
      expect_lte(max(attitude_difference(exact, other)), 1e-9)
      expect_equal(
        exact$rotational_kinetic_energy_j + exact$potential_energy_j,
        rep(exact$rotational_kinetic_energy_j[1] + exact$potential_energy_j[1], 13),
        tolerance = 1e-13
      )
      expect_true(all(audit(exact)$verdict == "balanced"))
      expect_true(all(audit(other)$verdict == "balanced"))
    }
  }
})

test_that("a stick that hangs from its end swings as the pendulum on an axle", {
  stick <- body_rod_end(mass_kg = 0.1, length_m = 1)
  flat <- trajectory(scene_pendulum(stick, theta0_rad = 1), seq(0, 3, by = 0.5))
  # From the direction of the stick in its body to 1 rad from straight down.
  along <- stick$centre_m / sqrt(sum(stick$centre_m^2))
  swing <- 1
  down <- c(sin(swing), 0, -cos(swing))
  turn <- rotation_about(
    c(along[2] * down[3] - along[3] * down[2], along[3] * down[1] - along[1] * down[3],
      along[1] * down[2] - along[2] * down[1]),
    angle_rad = acos(sum(along * down))
  )
  scene <- scene_pivot(stick, c(0, 0, 0), attitude0 = turn)
  motion <- trajectory(scene, seq(0, 3, by = 0.5))
  expect_equal(
    motion$potential_energy_j, -0.1 * 9.80665 * 0.5 * cos(flat$theta_rad), tolerance = 1e-13
  )
})

test_that("events, nutation and what is conserved", {
  scene <- top()
  motion <- trajectory(scene, seq(0, 2, by = 0.25))
  events <- motion_events(motion)
  expect_true(all(events$event == rep(c("highest", "lowest"), length.out = nrow(events))))
  expect_equal(
    unique(round(diff(events$time_s), 12)), round(summary(motion)$nutation_period_s / 2, 12)
  )
  table <- precession_table(
    data.frame(
      mass_kg = 0.5, lever_arm_m = 0.08, moment_of_inertia_kg_m2 = 0.002, spin_rad_per_s = 60
    ),
    axis_angle_deg = 30, transverse_moment_kg_m2 = 0.0042
  )
  expect_equal(summary(motion)$nutation_period_s, table$nutation_period_s, tolerance = 1e-13)
  expect_equal(
    summary(motion)$mean_precession_rad_per_s, table$mean_precession_rad_per_s, tolerance = 1e-13
  )
  kept <- conserved(scene)
  expect_identical(kept$conserved, c(TRUE, FALSE, FALSE, TRUE))
  expect_false(conserved(top(resistance = resistance(damping_per_s = 0.1)))$conserved[1])
})

test_that("tops that are integrated have the turns of their closed form", {
  scene <- top()
  exact <- motion_events(trajectory(scene, c(0, 2)))
  run <- motion_events(trajectory(scene, c(0, 2), model = "pivot_rk8pd"))
  expect_identical(run$event, exact$event)
  expect_equal(run$time_s, exact$time_s, tolerance = 1e-9)
  # An asymmetric one: where it is highest or lowest it neither rises nor falls.
  odd <- scene_pivot(c(0.004, 0.005, 0.002), c(1, 0.5, 40), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
                     attitude0 = rotation_about(c(1, 0, 0), angle_rad = 0.5))
  turns <- motion_events(trajectory(odd, c(0, 1)))
  height <- function(time_s) trajectory(odd, time_s, accuracy = 1e-11)$potential_energy_j
  at <- height(turns$time_s)
  for (step in c(-1e-3, 1e-3)) {
    expect_identical(height(turns$time_s + step) < at, turns$event == "highest")
  }
})

test_that("highest and lowest are those of the centre of mass, on either side of the point", {
  for (lever in c(0.08, -0.08)) {
    scene <- scene_pivot(
      c(0.0042, 0.0042, 0.002), c(0.5, 0, 60), mass_kg = 0.5, centre_m = c(0, 0, lever),
      attitude0 = attitude_from(c(1, 0, 0, 1), "axis_angle")
    )
    motion <- trajectory(scene, seq(0, 1, by = 0.01))
    events <- motion_events(motion)
    at <- predict(motion, events$time_s)$inclination_rad
    expect_equal(
      at, ifelse(events$event == "highest", min(at), max(at)), tolerance = 1e-12
    )
    expect_lte(max(motion$inclination_rad), max(at) + 1e-12)
  }
})

test_that("torques, damping and bodies that are no tops are integrated", {
  t <- c(0, 0.5, 1)
  damped <- trajectory(top(resistance = resistance(damping_per_s = 0.2)), t)
  expect_match(run_of(damped)$model, "pivot_rk8pd")
  expect_true(all(audit(damped)$verdict == "balanced"))
  pushed <- trajectory(top(torque = c(0, 0, 0.01)), t)
  # Along the axis of symmetry only the torque acts: I3 omega3' = torque.
  expect_equal(pushed$omega_z_rad_per_s, 60 + 0.01 / 0.002 * t, tolerance = 1e-9)
  box <- scene_pivot(body_box(1, 0.1, 0.2, 0.3), c(1, 2, 3), pivot_m = c(0.05, 0.1, 0.15))
  motion <- trajectory(box, t)
  expect_match(run_of(motion)$model, "pivot_rk8pd")
  expect_true(all(audit(motion)$verdict == "balanced"))
  # Held at its centre of mass it is a free body.
  held <- trajectory(scene_pivot(body_box(1, 0.1, 0.2, 0.3), c(1, 2, 3)), t)
  free <- trajectory(scene_free(body_box(1, 0.1, 0.2, 0.3), c(1, 2, 3)), t)
  expect_identical(run_of(held)$model, "pivot_free")
  expect_equal(held$qz, free$qz, tolerance = 1e-14)
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(box), "ggplot")
  expect_s3_class(ggplot2::autoplot(motion), "ggplot")
})

test_that("bad input is refused with its class, and the print says what is held", {
  expect_error(scene_pivot(c(1, 1, 1), c(0, 0, 1)), class = "rotdyn_error_missing")
  expect_error(scene_pivot(), class = "rotdyn_error_missing")
  expect_error(top(gravity_m_per_s2 = -1), class = "rotdyn_error_value")
  expect_error(top(torque = 1), class = "rotdyn_error_size")
  expect_error(
    scene_pivot(body_box(1, 1, 1, 1), c(0, 0, 1), mass_kg = 1), class = "rotdyn_error_value"
  )
  expect_error(
    scene_pivot(body_box(1, 1, 1, 1), c(0, 0, 1), pivot_m = 1), class = "rotdyn_error_size"
  )
  # Moments are about the point: it is not moved.
  expect_error(top(pivot_m = c(0, 0, 0.1)), "centre_m", class = "rotdyn_error_argument")
  expect_error(update(top(), pivot_m = c(0, 0, 0.1)), class = "rotdyn_error_argument")
  expect_error(top(pivot_m = NaN), class = "rotdyn_error_argument")
  expect_identical(top(pivot_m = c(0, 0, 0)), top())
  expect_output(print(top()), "0.5 kg at 0, 0, 0.08 m from the point", fixed = TRUE)
})

test_that("the splitting keeps the energy of an asymmetric top for thousands of turns", {
  top <- scene_pivot(
    c(1, 1.4, 2.2), c(0.3, 0.2, 2), mass_kg = 1, centre_m = c(0.2, 0, 1), gravity_m_per_s2 = 1
  )
  t <- c(0, 5, 10, 15, 2990, 2995, 3000)
  off <- function(motion) {
    energy <- motion$rotational_kinetic_energy_j + motion$potential_energy_j
    max(abs(energy - energy[1]))
  }
  long <- trajectory(top, t, model = "pivot_split", accuracy = 1e-2)
  expect_lt(off(long), 1e-10)
  lz <- long$angular_momentum_z_kg_m2_per_s
  expect_lt(max(abs(lz - lz[1])), 1e-12)
  rk4 <- trajectory(top, t, model = "pivot_rk4", accuracy = 1)
  expect_gt(off(rk4), 1e4 * off(long))
  fine <- trajectory(top, t, model = "pivot_split", accuracy = 1e-4, step_s = 0.02)
  expect_lte(
    max(attitude_difference(long, fine)),
    1.1 * trajectory_run(long)$info$errors[["attitude"]]
  )
  expect_identical(audit(long)$verdict, rep("balanced", 5))
})

test_that("the gyroscope's short cuts are taken within their bounds, and said", {
  tilted <- attitude_from(c(1, 0, 0, 1.1), "axis_angle")
  wheel <- scene_pivot(
    c(0.7, 0.7, 1), c(0, 0, 100), mass_kg = 1, centre_m = c(0, 0, 2), gravity_m_per_s2 = 1,
    attitude0 = tilted
  )
  t <- seq(0, 5, by = 0.05)
  exact <- trajectory(wheel, t)
  expect_identical(trajectory_run(exact)$model, "pivot_top")
  rough <- trajectory(wheel, t, accuracy = 1e-2)
  run <- trajectory_run(rough)
  expect_identical(run$model, "pivot_precession")
  expect_identical(run$error_kind, "bound")
  expect_match(tibble::tbl_sum(rough)[["Left out"]], "nutation")
  expect_lte(max(attitude_difference(rough, exact)), run$info$errors[["attitude"]])
  expect_lte(run$info$error, 1e-2)
  choice <- choose_model(wheel, t, accuracy = 1e-2)
  expect_equal(choice$error[choice$chosen], run$info$error, tolerance = 1e-6)
  strict <- choose_model(wheel, t, accuracy = 1e-6)
  expect_match(strict$reason[strict$model == "pivot_precession"], "exceeds the accuracy asked")
  # For a moment nutation to first order is good to 1e-6, and precession alone is not.
  expect_identical(
    trajectory_run(trajectory(wheel, seq(0, 1e-3, by = 1e-5), accuracy = 1e-5))$model,
    "pivot_nutation"
  )
  expect_warning(predict(rough, 1e4), class = "rotdyn_warning_accuracy")
  expect_identical(audit(rough)$verdict, rep("balanced", 5))
  swing <- trajectory(wheel, t, model = "pivot_nutation", accuracy = 1e-2)
  off <- max(attitude_difference(swing, exact))
  expect_lte(off, trajectory_run(swing)$info$errors[["attitude"]])
  still <- scene_pivot(c(0.7, 0.7, 1), c(0, 0, 0), mass_kg = 1, centre_m = c(0, 0, 2))
  expect_error(trajectory(still, t, model = "pivot_precession"), class = "rotdyn_error_model")
})

# ---- rotors -------------------------------------------------------------------------------------

# A top of two equal moments, tilted, with rotors.
with_rotors <- function(omega, rotors = NULL, third = 0.002, ...) {
  scene_pivot(
    c(0.0042, 0.0042, third), omega, mass_kg = 0.5, centre_m = c(0, 0, 0.08),
    attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle"), rotors = rotors, ...
  )
}

axis_of_top <- function(motion) {
  turned <- attitude_to(motion[c("qw", "qx", "qy", "qz")], "matrix")
  cbind(turned[[3]], turned[[6]], turned[[9]])
}

test_that("a wheel on the axis of a top moves that axis as the top's own spin does", {
  # The axis follows from I1 and L3 alone: I3 w3 + J W of a driven rotor. Of one without friction
  # the moment about the axis is I3 - J, and the rest of L3 is s = J (W + w3).
  t <- seq(0, 3, by = 0.25)
  top <- trajectory(with_rotors(c(0.3, 0.1, 10 + 5e-4 * 200 / 0.002)), t)
  expect_identical(attr(top, "run")$model, "pivot_top")
  for (wheel in list(rotor(c(0, 0, 1), 5e-4, 200), rotor(c(0, 0, -1), 5e-4, -200, 0))) {
    scene <- with_rotors(c(0.3, 0.1, 10), wheel)
    exact <- trajectory(scene, t)
    expect_identical(attr(exact, "run")$model, "pivot_top")
    expect_lt(max(abs(axis_of_top(exact) - axis_of_top(top))), 1e-14)
    motion <- trajectory(scene, t, accuracy = 1e-11, model = "pivot_rk8pd")
    expect_lt(max(attitude_difference(motion, exact)), 1e-10)
    for (name in names(exact)) expect_equal(motion[[name]], exact[[name]], tolerance = 1e-9)
    expect_true(all(audit(exact)$verdict == "balanced"))
    expect_identical(unique(augment(exact)$motor_work_j), 0)
    expect_lt(max(abs(axis_of_top(motion) - axis_of_top(top))), 1e-10)
    expect_equal(motion$inclination_rad, top$inclination_rad, tolerance = 1e-10)
    expect_equal(motion$omega_z_rad_per_s, rep(10, length(t)), tolerance = 1e-10)
    expect_equal(abs(motion$rotor_1_omega_rad_per_s), rep(200, length(t)), tolerance = 1e-10)
    for (name in c("x", "y", "z")) {
      column <- paste0("angular_momentum_", name, "_kg_m2_per_s")
      expect_equal(motion[[column]], top[[column]], tolerance = 1e-9)
    }
    shown <- audit(motion)
    expect_true(all(shown$verdict == "balanced"))
    expect_identical(shown$conserved[shown$balance == "energy"], !is.null(wheel$torque))
    split <- trajectory(with_rotors(c(0.3, 0.1, 10), wheel), t, model = "pivot_split")
    expect_lt(max(attitude_difference(split, motion)), attr(split, "run")$info$error + 1e-10)
  }
})

test_that("a reaction wheel swings a pendulum against the motor's torque", {
  # About x: (I - J) theta'' = -m g l sin(theta) - u, the motion of an axle with the moment I - J.
  u <- 0.03
  wheel <- rotor(c(1, 0, 0), 1e-3, 5, u)
  hanging <- scene_pivot(
    c(0.012, 0.011, 0.003), c(0, 0, 0), mass_kg = 0.5, centre_m = c(0, 0, -0.1), rotors = wheel
  )
  t <- seq(0, 4, by = 0.1)
  motion <- trajectory(hanging, t, accuracy = 1e-11)
  rest <- body_tensor(0.5, diag(0.006, 3)) # 0.011 - 0.5 * 0.1^2
  axle <- trajectory(scene_pendulum(rest, 0.1, torque = torque_constant(-u)), t, accuracy = 1e-11)
  expect_equal(motion$omega_x_rad_per_s, axle$omega_rad_per_s, tolerance = 1e-9)
  expect_equal(2 * atan2(motion$qx, motion$qw), axle$theta_rad, tolerance = 1e-9)
  # The wheel's own: J (W' + theta'') = u.
  expect_equal(
    motion$rotor_1_omega_rad_per_s, 5 + u / 1e-3 * t - axle$omega_rad_per_s, tolerance = 1e-9
  )
  shown <- audit(motion)
  expect_true(all(shown$verdict == "balanced"))
  kept <- conserved(hanging)
  expect_identical(kept$conserved[kept$quantity == "energy"], FALSE)
  expect_match(kept$why[kept$quantity == "energy"], "motors")
  # What the motor's power adds up to: u times the angle that the wheel turns in the body.
  work <- augment(motion)$motor_work_j
  expect_equal(
    utils::tail(work, 1), u * (5 * 4 + u / 1e-3 * 8 - utils::tail(axle$theta_rad, 1)),
    tolerance = 1e-8
  )
})

test_that("a top at rest upright stays, one beside that falls with all its digits", {
  rate <- sqrt(0.5 * 9.80665 * 0.08 / 0.0042)
  t <- c(0, 0.5, 1, 2)
  at_rest <- function(q) {
    scene_pivot(c(0.0042, 0.0042, 0.002), c(0, 0, 0), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
                attitude0 = q)
  }
  still <- trajectory(at_rest(attitude_from(c(0, 0, 1, 1), "axis_angle")), t)
  expect_lt(trajectory_run(still)$info$error, 1e-14)
  expect_identical(still$omega_x_rad_per_s, c(0, 0, 0, 0))
  # Next to the top theta'' = rate^2 theta.
  for (angle in c(1e-140, 1e-100, 1e-20, 1e-17, 1e-13)) {
    falls <- trajectory(at_rest(c(1, angle / 2, 0, 0)), t)
    info <- trajectory_run(falls)$info
    expect_lt(info$error, 1e-12)
    near <- if (angle > 1e-14) 1:3 else 1:4
    expect_equal(2 * falls$qx[near] / angle, cosh(rate * t[near]), tolerance = 1e-13)
    omega <- falls$omega_x_rad_per_s[near]
    expect_lte(max(abs(omega - angle * rate * sinh(rate * t[near]))), info$errors[["omega"]])
  }
})

test_that("a top in next to no gravity moves as without", {
  t <- c(-1, 0, 2)
  top <- function(gravity, ...) {
    scene_pivot(
      c(0.0042, 0.0042, 0.002), c(0.1, 0, 60), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
      attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle"), gravity_m_per_s2 = gravity, ...
    )
  }
  free <- trajectory(top(0), t)
  for (gravity in c(1e-50, 1e-60, 1e-100, 1e-300)) {
    motion <- trajectory(top(gravity), t)
    expect_lte(max(attitude_difference(motion, free)), 1e-13)
    expect_equal(run_of(motion)$model, "pivot_top")
  }
  # Of the rotor, too.
  spun <- top(1e-100, rotors = rotor("z", 1e-4, 100))
  still <- top(0, rotors = rotor("z", 1e-4, 100))
  expect_lte(max(attitude_difference(trajectory(spun, t), trajectory(still, t))), 1e-13)
})

test_that("a top that spins fast has its exact motion, one without is refused at once", {
  top <- function(omega0, moments = c(0.0042, 0.0042, 0.002), ...) {
    scene_pivot(
      moments, omega0, mass_kg = 0.5, centre_m = c(0, 0, 0.08),
      attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle"), ...
    )
  }
  for (scale in c(1e31, 1e100, 1e150)) {
    t <- c(-1, 2) / scale
    motion <- trajectory(top(c(0.1, 0, 1) * scale), t)
    free <- trajectory(top(c(0.1, 0, 1) * scale, gravity_m_per_s2 = 0), t)
    expect_equal(run_of(motion)$model, "pivot_top")
    expect_lte(max(attitude_difference(motion, free)), 1e-14)
    expect_lte(summary(motion)$error, 1e-13)
    # Of 1 s no digit is left.
    expect_warning(motion <- trajectory(top(c(0, 0, scale)), 0:1), "not known")
    expect_identical(summary(motion)$error, NA_real_)
  }
  expect_error(trajectory(top(c(0, 0, 1e160)), 0:1), "energy", class = "rotdyn_error_range")
  expect_error(trajectory(top(c(0, 0, 1e300)), 0:1), "energy", class = "rotdyn_error_range")
  uneven <- top(c(0, 1, 1e10), c(0.0042, 0.005, 0.006))
  expect_soon(
    expect_error(trajectory(uneven, 0:1), "turns", class = "rotdyn_error_budget"), 20
  )
})

test_that("impulses with too many nutations to resolve have a figure", {
  fast <- scene_pivot(
    c(1, 1, 1.9), c(0.3, 0, 2e4), mass_kg = 1, centre_m = c(0, 0, 0.1),
    attitude0 = attitude_from(c(1, 0, 0, 0.1), "axis_angle")
  )
  # The torque turns by 1000 s at m g l/L = 2.6e-5 rad/s: a quadrature of 1e4 nutations a second.
  checked <- audit(trajectory(fast, c(0, 1000)))
  expect_equal(checked$verdict, rep("balanced", 5))
  expect_lt(max(checked$rounding[2:3]), 1e-3 * abs(checked$change[2]))
  expect_lt(max(abs(checked$residual[2:3])), 1e-9 * abs(checked$change[2]))
})

test_that("the impulses of a plane pendulum balance along any axis of the body", {
  t <- seq(0, 10, by = 0.1)
  for (k in 1:3) for (line in list(c(1, 0, 0), c(0, 1, 0))) {
    moments <- ifelse(1:3 == k, 0.002, 0.05)
    scene <- scene_pivot(
      moments, c(0, 0, 0), mass_kg = 0.5, centre_m = 0.3 * (1:3 == k),
      attitude0 = attitude_from(c(line, pi / 3), "axis_angle")
    )
    shown <- audit(trajectory(scene, t))
    expect_identical(shown$verdict, rep("balanced", 5))
    expect_true(all(shown$rounding < 1e-12))
  }
})

test_that("rotors of a body with a fixed point are exact where nothing else acts", {
  wheel <- rotor(c(0, 1, 0), 0.05, 60)
  held <- scene_pivot(
    c(1, 2, 3), c(0.1, 2, 0.3), mass_kg = 1, centre_m = c(0, 0, 0), rotors = wheel
  )
  free <- scene_free(c(1, 2, 3), c(0.1, 2, 0.3), rotors = wheel)
  t <- c(0, 1, 100)
  got <- trajectory(held, t)
  expect_identical(attr(got, "run")$model, "pivot_gyrostat")
  expect_identical(got$qw, trajectory(free, t)$qw)
  expect_true(all(audit(got)$verdict == "balanced"))
  expect_true(is.na(summary(got)$nutation_period_s))
})

two_wheels <- function() {
  with_rotors(c(0.3, 0.1, 10), list(
    rotor(c(0, 0, 1), 5e-4, 200), rotor(c(1, 0, 0), 1e-4, 0, 0.01)
  ))
}

test_that("rotors of a body with a fixed point come back from text", {
  skip_if_not_installed("yyjsonr")
  scene <- two_wheels()
  back <- read_scene(write_scene(scene))
  expect_identical(trajectory(back, 0:2), trajectory(scene, 0:2), ignore_attr = TRUE)
})

test_that("rotors of a body with a fixed point are drawn, printed and checked", {
  scene <- two_wheels()
  expect_output(print(scene), "rotor .* 200 rad/s, driven")
  names <- names(trajectory(scene, 0:1))
  expect_true(all(sprintf("rotor_%d_omega_rad_per_s", 1:2) %in% names))
  expect_true("W[2]" %in% draw_pivot(scene)$quantities$symbol)
  expect_error(with_rotors(c(0, 0, 1), rotor(c(0, 0, 1), 0.1, 1, 0)), class = "rotdyn_error_value")
  expect_error(with_rotors(c(0, 0, 1), 3), class = "rotdyn_error_type")
  pulsed <- with_rotors(c(0, 0, 1), rotor(
    c(0, 0, 1), 5e-4, 0, data.frame(time_s = c(0, 0.25, 1), torque_n_m = c(0, 0.1, 0))
  ))
  expect_identical(pulsed$breaks_s, c(0, 0.25, 1))
  expect_true(all(audit(trajectory(pulsed, c(0, 0.6, 2)))$verdict == "balanced"))
})

test_that("a top with a wheel is exact in any axes of the body", {
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  start <- matrix(unlist(attitude_to(attitude_from(c(pi / 6, 0, 0), "rotation_vector"), "matrix")),
                  3, byrow = TRUE)
  scene_in <- function(turn) {
    tensor <- turn %*% diag(c(0.0042, 0.0042, 0.002)) %*% t(turn)
    scene_pivot(
      (tensor + t(tensor)) / 2, as.vector(turn %*% c(0.3, 0.1, 10)),
      mass_kg = 0.5, centre_m = as.vector(turn %*% c(0, 0, 0.08)), attitude0 = start %*% t(turn),
      rotors = rotor(as.vector(turn %*% c(0, 0, 1)), 5e-4, 200)
    )
  }
  t <- c(0, 0.7, 30)
  plain <- trajectory(scene_in(diag(3)), t)
  turned <- trajectory(scene_in(turn), t)
  for (one in list(plain, turned)) expect_identical(attr(one, "run")$model, "pivot_top")
  expect_equal(turned$inclination_rad, plain$inclination_rad, tolerance = 1e-12)
  for (name in c("omega_space_x_rad_per_s", "angular_momentum_x_kg_m2_per_s", "potential_energy_j",
                 "rotational_kinetic_energy_j", "rotor_1_angular_momentum_kg_m2_per_s")) {
    expect_equal(turned[[name]], plain[[name]], tolerance = 1e-11)
  }
  expect_true(all(audit(turned)$verdict == "balanced"))
  # Across the axis, or with a motor, it is integrated.
  across <- with_rotors(c(0.3, 0.1, 10), rotor(c(1, 0, 0), 5e-4, 200))
  choice <- choose_model(across, t)
  expect_match(choice$reason[choice$model == "pivot_top"], "not along the axis of symmetry")
  expect_identical(choice$model[choice$chosen], "pivot_rk8pd")
  expect_true(all(audit(trajectory(across, t[1:2]))$verdict == "balanced"))
  driven <- choose_model(with_rotors(c(0.3, 0.1, 10), rotor(c(0, 0, 1), 5e-4, 200, 0.1)), t)
  expect_identical(driven$model[driven$chosen], "pivot_rk8pd")
})

test_that("a top keeps its digits for a day, and its bound covers the rounding of what was given", {
  # m g l and the attitude in quadruple precision, one nutation by Taylor series, repeated.
  top <- scene_pivot(
    c(.0042, .0042, .002), c(0, 0, 60), mass_kg = .5, centre_m = c(0, 0, .08),
    attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  )
  want <- rbind(
    c(-0.86051537448858687, -0.25550314329779042, 0.18410682661381589, 0.40041991762137183),
    c(-0.74700618707020783, 0.31472724963552603, 0.083015360784765506, 0.57968695404456202)
  )
  for (k in 1:2) {
    motion <- trajectory(top, c(3600, 86400)[k])
    q <- unlist(motion[nrow(motion), quaternion_columns])
    off <- attitude_difference(stats::setNames(want[k, ], quaternion_columns), q)
    expect_lt(off, 5e-14)
    errors <- attr(motion, "run")$info$errors
    expect_lt(off, errors[["attitude"]])
    # A rounding of the phase, not more.
    expect_lt(errors[["attitude"]], 60 * c(3600, 86400)[k] * 2^-52)
  }
  # Upright, no component of the attitude is rounded.
  asleep <- scene_pivot(c(.0042, .0042, .002), c(0, 0, 60), mass_kg = .5, centre_m = c(0, 0, .08))
  motion <- suppressWarnings(trajectory(asleep, 1e7))
  expect_lt(attr(motion, "run")$info$errors[["attitude"]], 1e-14)
})

test_that("the power of gravity is what the height gives, in any axes", {
  box <- body_box(2, 0.3, 0.5, 0.2)
  turned <- place_body(box, c(0.1, 0.2, 0), rotation_about(c(1, 2, 1), angle_rad = 1))
  for (body in list(turned, box)) {
    scene <- scene_pivot(body, c(1, 2, 0.5), pivot_m = c(0.1, 0, 0.3))
    motion <- augment(trajectory(scene, c(1 - 1e-4, 1, 1 + 1e-4), accuracy = 1e-12))
    slope <- diff(motion$potential_energy_j[c(1, 3)]) / 2e-4
    expect_equal(motion$power_w[2], -slope, tolerance = 1e-6)
    expect_gt(abs(slope), 0.1)
    expect_equal(motion$work_j[3], -diff(motion$potential_energy_j[c(1, 3)]), tolerance = 1e-6)
  }
})

test_that("an upright top has the inclination 0, a level one a right angle, a held one none", {
  turned <- function(angle) attitude_from(c(1, 0, 0, angle), "axis_angle")
  inclination <- function(angle, centre_m = c(0, 0, 0.1)) {
    scene <- scene_pivot(
      c(0.1, 0.1, 0.05), c(0, 0, 3), mass_kg = 1, centre_m = centre_m, attitude0 = turned(angle)
    )
    trajectory(scene, 0)$inclination_rad
  }
  expect_identical(inclination(0), 0)
  expect_equal(inclination(pi / 2), pi / 2, tolerance = 1e-15)
  expect_equal(inclination(pi), pi, tolerance = 1e-15)
  expect_true(is.na(inclination(0, c(0, 0, 0)) %||% NA))
  none <- augment(trajectory(scene_pivot(
    c(0.1, 0.1, 0.05), c(0, 0, 3), mass_kg = 1, centre_m = c(0, 0, 0.1)
  ), 0:1)[0, ])
  expect_identical(none$power_w, double())
})

test_that("three moments need a mass and a centre of mass, both", {
  moments <- c(0.02, 0.02, 0.03)
  for (given in list(list(mass_kg = 2), list(centre_m = c(0, 0, 0.1)), list())) {
    expect_error(
      do.call(scene_pivot, c(list(moments, c(0, 0, 30)), given)), "mass_kg.*centre_m",
      class = "rotdyn_error_missing"
    )
  }
})

test_that("motions of 1e-12 rad/s about an equilibrium keep their digits, also as they grow", {
  # Taylor series of 45 digits from these doubles (mpmath 1.3.0): the torque at the start is what
  # products of 0.1 N m leave.
  down <- c(0.96965223310360704, -0.090800688769367061, 0.22700172192341764, 0)
  up <- c(0.24448833681218429, 0.36011979868061567, -0.90029949670153919, 0)
  omega0 <- c(1e-12, 2e-12, -1e-12)
  tensor <- matrix(c(.03, .002, .001, .002, .04, -.003, .001, -.003, .035), 3)
  cases <- list(
    list(c(.02, .03, .04), omega0, down, c(
      6.3419565332040004e-13, 1.6577689928419534e-12, -1.1427857377435489e-12
    )),
    list(c(.02, .03, .04), c(1e-13, 0, 0), up, c(
      7.9294775996475997e-5, -8.2277342553291127e-6, 1.8589533576018336e-5
    )),
    list(tensor, omega0, down, c(
      8.298287608710385e-13, -1.1705294048007368e-12, -2.1537555185488944e-12
    ))
  )
  for (case in cases) {
    scene <- scene_pivot(
      case[[1]], case[[2]], mass_kg = 1, centre_m = c(.05, .02, -.1), attitude0 = case[[3]]
    )
    motion <- trajectory(scene, c(0, 3))
    omega <- unlist(motion[2, paste0("omega_", c("x", "y", "z"), "_rad_per_s")])
    figure <- glance(motion)$error
    size <- max(sqrt(sum(case[[4]]^2)), sqrt(sum(case[[2]]^2)))
    expect_lte(sqrt(sum((omega - case[[4]])^2)), figure * size)
    expect_lt(figure, 1e-10)
    expect_lt(trajectory_run(motion)$info$rhs_calls, 1e5)
  }
})

test_that("a pendulum that a steady torque holds aside swings by 1e-12 rad/s with all its digits", {
  # Taylor series of 40 digits (mpmath 1.3.0) from these doubles. Gravity's torque rounded, the
  # steps for 7e-8 rad/s exceeded the budget.
  last <- c(
    "1e-6" = -3.5105745242822423565e-7, "1e-9" = -3.5105769862314284972e-10,
    "1e-12" = -3.5112843019662499575e-13
  )
  lean <- attitude_from(
    c(0x1.e921dd42f09bap-1, 0x1.2e9cd95baba33p-2, 0, 0), "quaternion", order = "wxyz"
  )
  for (start in names(last)) {
    rate <- as.numeric(start)
    scene <- scene_pivot(
      c(3, 3.2, 3.1), c(rate, 0, 0), mass_kg = 2, centre_m = c(0, 0, -0.5), attitude0 = lean,
      torque = c(0x1.6262527ca4c5ap+2, 0, 0)
    )
    motion <- trajectory(scene, c(0, 5))
    figure <- glance(motion)$error * rate
    expect_lt(abs(motion$omega_x_rad_per_s[2] - last[[start]]), figure)
    expect_lt(figure, 1e-9 * rate)
    # Steps of fixed length take the change since the start, too: 1e-9 rad/s was off by 1e-6.
    steps <- trajectory(scene, c(0, 5), model = "pivot_rk4", step_s = 0.002)
    figure <- glance(steps)$error * rate
    expect_lt(abs(steps$omega_x_rad_per_s[2] - last[[start]]), figure)
    expect_lt(figure, 1e-9 * rate)
  }
})

test_that("a body that a steady torque in space holds aside moves with all its digits", {
  # Extrapolation to 30 digits (mpmath 1.3.0) from these doubles, 2 s; principal and other axes. The
  # torque rotated and rounded, the steps for it were minutes or exceeded the budget.
  cases <- list(
    list(
      body = c(0x1.7b9b05b587ef6p+1, 0x1.0e118620dde77p+1, 0x1.5ed4121d531e5p+1),
      mass = 0x1.fc11ad2dc2e7ap-1,
      centre = c(-0x1.4f21aae0c9b7p-3, 0x1.1fb70d54fe0c4p-3, 0x1.7fd9547585e76p-3),
      attitude = c(
        0x1.6940dd98a4c65p-2, -0x1.5b1a81aae8994p-1, -0x1.40972004f0bc8p-1,
        0x1.3c74600321e67p-3
      ),
      torque = c(-0x1.ebf6cabab175bp-1, 0x1.c6ac43e3ad279p-2, -0x1p-116),
      rate = c(-0x1.7ba978c2ac4ep-29, -0x1.0e601c12406dep-29, 0x1.4f39b7de71784p-29),
      want = c(-0x1.784322790be6dp-33, 0x1.2f79f94576c16p-29, 0x1.4433d350cbccbp-32)
    ),
    list(
      body = matrix(c(
        0x1.613b7cda46902p+1, -0x1.56a25327d1a34p-4, 0x1.9c990f531a57p-4,
        -0x1.56a25327d1a34p-4, 0x1.f9f4e2b90c476p+1, -0x1.741732778cecp-3,
        0x1.9c990f531a57p-4, -0x1.741732778cecp-3, 0x1.2ad1faf716ccp+1
      ), 3),
      mass = 0x1.5947db925652p+1,
      centre = c(-0x1.380963c4c0cf8p-3, 0x1.313275e427f73p-2, -0x1.a796308734fe4p-4),
      attitude = c(
        -0x1.406cf13305feep-4, 0x1.751e1981341c7p-1, -0x1.08d58fc0ccb62p-1,
        -0x1.c47c5d27faf8bp-2
      ),
      torque = c(-0x1.2f8b748cb9df3p+1, 0x1.4fe455ae4d2e3p+2, -0x1.ep-115),
      rate = c(0x1.f6925412dc7efp-34, -0x1.0486c7bd839ddp-33, 0x1.a580c98864e73p-34),
      want = c(0x1.e4853f19491e9p-33, 0x1.15a5314b68778p-31, 0x1.3adcefd43cc34p-31)
    )
  )
  for (case in cases) {
    scene <- scene_pivot(
      case$body, case$rate, mass_kg = case$mass, centre_m = case$centre,
      attitude0 = attitude_from(case$attitude, "quaternion", order = "wxyz"),
      torque = case$torque, torque_axes = "space"
    )
    runs <- list(
      trajectory(scene, c(0, 2), max_steps = 1e4),
      trajectory(scene, c(0, 2), model = "pivot_rk4", step_s = 0.005)
    )
    for (motion in runs) {
      rate <- unlist(motion[2, c("omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s")])
      size <- sqrt(max(sum(case$want^2), sum(case$rate^2)))
      figure <- glance(motion)$error
      expect_lt(sqrt(sum((rate - case$want)^2)) / size, figure)
      expect_lt(figure, 1e-9)
    }
  }
})

test_that("a figure has the rounding of a torque function that holds a body aside", {
  # Extrapolation to 30 digits (mpmath 1.3.0) from these doubles, 2 s: off by 1.6e6 figures before.
  body <- matrix(c(
    0x1.34b01221233dcp+1, -0x1.8734e707fc3dp-5, -0x1.448ba102c1817p-3,
    -0x1.8734e707fc3dp-5, 0x1.ca07591a552a8p+1, -0x1.276f37b5299cp-2,
    -0x1.448ba102c1817p-3, -0x1.276f37b5299cp-2, 0x1.560ab332c4208p+1
  ), 3)
  torque <- c(-0x1.36e48135069fbp+0, -0x1.fc915996c766fp+0, -0x1.4f93cc9b8710cp+1)
  scene <- scene_pivot(
    body, c(0x1.637ea29180177p-36, 0x1.efc515d72e6bep-35, -0x1.13714d1801833p-34),
    mass_kg = 0x1.0e3f70a72a8e6p+0,
    centre_m = c(-0x1.c040d70d238cp-7, -0x1.1a50603d1874cp-2, 0x1.b8d3184678096p-3),
    attitude0 = attitude_from(c(
      0x1.6d52e50992188p-1, 0x1.0c3857a5e0d97p-3, 0x1.535096cb8ca55p-1,
      0x1.7c8f49013467fp-3
    ), "quaternion", order = "wxyz"),
    torque = function(time_s) torque
  )
  want <- c(-0x1.98721925717a3p-33, 0x1.ad078c8b5e1dfp-34, -0x1.e68858a29d4c1p-37)
  runs <- suppressWarnings(list(
    trajectory(scene, c(0, 2)),
    trajectory(scene, c(0, 2), model = "pivot_rk4", step_s = 0.01)
  ))
  for (motion in runs) {
    rate <- unlist(motion[2, c("omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s")])
    figure <- glance(motion)$error
    expect_lt(sqrt(sum((rate - want)^2) / sum(want^2)), figure)
    expect_lt(figure, 1e-3)
  }
})
