test_that("textbook: a bucket on a well, Atwood's machine", {
  # a = g/(1 + M/(2 m)) for a disk of M; v^2 = 2 a h.
  well <- scene_hanging_mass(body_disk(2, 0.1), 0.5, 0.1)
  fallen <- time_when(well, theta_rad = 30)
  expect_equal(fallen$time_s, sqrt(2 * 3 / (9.80665 / 3)), tolerance = 1e-14)
  expect_equal(0.1 * fallen$omega_rad_per_s, sqrt(2 * 9.80665 / 3 * 3), tolerance = 1e-14)
  # The energy of both is m g h; the pulley has I/(I + m r^2) = 2/3 of it.
  expect_equal(fallen$rotational_kinetic_energy_j, 0.5 * 9.80665 * 3 * 2 / 3, tolerance = 1e-14)
  expect_equal(fallen$mass_kinetic_energy_j, 0.5 * 9.80665 * 3 / 3, tolerance = 1e-14)
  expect_equal(fallen$mass_potential_energy_j, -0.5 * 9.80665 * 3, tolerance = 1e-14)
  atwood <- scene_hanging_mass(0, 1.1, 0.05, counter_mass_kg = 1)
  expect_equal(0.05 * trajectory(atwood, 1)$omega_rad_per_s, 9.80665 * (1.1 - 1) / 2.1,
    tolerance = 1e-14)
  # The heavier one on the other side pulls it up.
  up <- scene_hanging_mass(0.01, 1, 0.05, counter_mass_kg = 2)
  expect_equal(trajectory(up, 2)$omega_rad_per_s, -9.80665 * 0.05 / (0.01 + 3 * 0.0025) * 2,
    tolerance = 1e-14)
})

test_that("the radius of the rope need not be that of the body; losses", {
  drum <- scene_hanging_mass(body_disk(2, 0.5), 0.5, 0.1, resistance(0.02))
  expect_equal(drum$moment_of_inertia_kg_m2, 0.25 + 0.005)
  expect_equal(stopping(drum)$terminal_omega_rad_per_s, 0.5 * 9.80665 * 0.1 / 0.02)
})

test_that("errors", {
  expect_error(scene_hanging_mass(1, 1), class = "rotdyn_error_missing")
  expect_error(scene_hanging_mass(body_box(1, 1, 1, 1), 1), class = "rotdyn_error_missing")
  expect_error(
    scene_hanging_mass(body_disk(1, 1), 1, axis = "x"), class = "rotdyn_error_missing"
  )
  expect_error(scene_hanging_mass(-1, 1, 1), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass("disk", 1, 1), class = "rotdyn_error_type")
  expect_error(scene_hanging_mass(1, 0, 1), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass(1, 1, 0), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass(1, 1, 1, counter_mass_kg = -1), class = "rotdyn_error_value")
  expect_error(scene_hanging_mass(1, 1e300, 1e300), class = "rotdyn_error_value")
})

# Kleppner and Kolenkow, and the equations of each body alone: m1 a = m1 g - T1, I alpha = (T1 -
# T2) r - c omega. omega = omega_end (1 - exp(-c t/I')) with I' = I + (m1 + m2) r^2.
test_that("tensions, heights and energies are those of each body, with a viscous resistance", {
  g <- 9.80665
  r <- 0.1
  for (m in list(c(0.5, 0), c(0.5, 0.3), c(0.2, 0.7))) {
    for (own in c(0.01, 0)) {
      c_v <- 0.004
      scene <- scene_hanging_mass(own, m[1], r, resistance(c_v), counter_mass_kg = m[2])
      t <- c(0, 0.3, 1, 5)
      motion <- trajectory(scene, t)
      whole <- own + sum(m) * r^2
      end <- (m[1] - m[2]) * g * r / c_v
      omega <- -end * expm1(-c_v * t / whole)
      alpha <- end * c_v / whole * exp(-c_v * t / whole)
      theta <- end * (t + whole / c_v * expm1(-c_v * t / whole))
      tension <- cbind(m[1] * (g - r * alpha), m[2] * (g + r * alpha))
      expect_equal(motion$alpha_rad_per_s2, alpha, tolerance = 1e-12)
      expect_equal(motion$applied_torque_n_m, (tension[, 1] - tension[, 2]) * r, tolerance = 1e-12)
      expect_equal(motion$damping_torque_n_m, -c_v * omega, tolerance = 1e-12)
      expect_equal(motion$net_torque_n_m, own * alpha, tolerance = 1e-12)
      expect_equal(motion$rotational_kinetic_energy_j, own * omega^2 / 2, tolerance = 1e-12)
      expect_equal(motion$angular_momentum_kg_m2_per_s, whole * omega, tolerance = 1e-12)
      both <- m[2] > 0
      for (i in seq_len(1 + both)) {
        of <- function(name) motion[[sub("#", if (both) paste0("_", i) else "", name)]]
        height <- c(-1, 1)[i] * r * theta
        expect_equal(of("tension#_n"), tension[, i], tolerance = 1e-12)
        expect_equal(of("height#_m"), height, tolerance = 1e-12)
        expect_equal(of("mass#_kinetic_energy_j"), m[i] * (r * omega)^2 / 2, tolerance = 1e-12)
        expect_equal(of("mass#_potential_energy_j"), m[i] * g * height, tolerance = 1e-12)
      }
      expect_true(all(audit(motion)$verdict == "balanced"))
      # The rope works on the pulley, the resistance takes from it.
      ledger <- augment(motion)
      expect_equal(
        ledger$work_j - ledger$dissipated_j, own * omega^2 / 2, tolerance = 1e-11
      )
      expect_equal(
        ledger$torque_impulse_n_m_s + ledger$damping_impulse_n_m_s, own * omega, tolerance = 1e-11
      )
      expect_setequal(setdiff(names(ledger), column_table()$name), character())
    }
  }
})

test_that("tension is not weight: 0.5 kg on a drum of its own inertia", {
  # I = m r^2: a = g/2, and the torque is half of m g r.
  motion <- trajectory(scene_hanging_mass(0.02, 0.5, 0.2), 0:2)
  expect_equal(motion$applied_torque_n_m, rep(0.5 * 9.80665 * 0.2 / 2, 3), tolerance = 1e-14)
  expect_equal(motion$tension_n, rep(0.5 * 9.80665 / 2, 3), tolerance = 1e-14)
  expect_equal(
    motion$rotational_kinetic_energy_j + motion$mass_kinetic_energy_j +
      motion$mass_potential_energy_j, double(3), tolerance = 1e-12
  )
  # A heavy mass on a light drum falls freely: the tension keeps its digits.
  light <- trajectory(scene_hanging_mass(1e-12, 5, 0.2), 1)
  expect_equal(light$tension_n, 9.80665 * 1e-12 / (0.04 + 1e-12 / 5), tolerance = 1e-14)
})

test_that("held at rest the tensions are the weights; a slowed one tells a slack rope", {
  held <- trajectory(
    scene_hanging_mass(0.02, 0.5, 0.2, resistance(coulomb_n_m = 2), counter_mass_kg = 0.2), 0:1
  )
  expect_equal(held$tension_1_n, rep(0.5 * 9.80665, 2), tolerance = 1e-14)
  expect_equal(held$tension_2_n, rep(0.2 * 9.80665, 2), tolerance = 1e-14)
  expect_equal(held$applied_torque_n_m, rep(0.3 * 9.80665 * 0.2, 2), tolerance = 1e-14)
  # Wound up against a brake: (m g r + 40)/(I + m r^2) r > g.
  wound <- scene_hanging_mass(
    0.02, 0.5, 0.2, resistance(coulomb_n_m = 40), omega0_rad_per_s = -50, start_s = 3
  )
  expect_warning(brake <- trajectory(wound, c(3, 3.01)), "slack", class = "rotdyn_warning_slack")
  alpha <- (0.5 * 9.80665 * 0.2 + 40) / 0.04
  expect_equal(brake$tension_n[1], 0.5 * (9.80665 - 0.2 * alpha), tolerance = 1e-13)
  expect_lt(brake$tension_n[1], 0)
  expect_match(tibble::tbl_sum(brake)[["Not valid"]], "slack from 3 s on.*-97.548")
  expect_warning(time_when(wound, omega_rad_per_s = 0), class = "rotdyn_warning_slack")
  expect_warning(stop <- stopping(wound), "slack from 3 s on", class = "rotdyn_warning_slack")
  expect_equal(stop$stop_time_s, 3 + 50 / alpha, tolerance = 1e-14)
})

test_that("the limit of a slack rope is where the tension is 0, on both sides", {
  # T1 = m1 (g (I0 + 2 m2 r^2) - r tau)/I, T2 = m2 (g (I0 + 2 m1 r^2) + r tau)/I, tau = -c omega.
  g <- 9.80665
  scene <- function(omega, c = 0.8) {
    scene_hanging_mass(
      0.02, 0.5, 0.2, resistance(c), omega0_rad_per_s = omega, counter_mass_kg = 0.3
    )
  }
  up <- -g * (0.02 + 2 * 0.3 * 0.04) / 0.2 / 0.8
  down <- g * (0.02 + 2 * 0.5 * 0.04) / 0.2 / 0.8
  for (taut in c(0.999 * up, 0, 0.999 * down)) {
    motion <- expect_silent(trajectory(scene(taut), 0:1))
    expect_false("Not valid" %in% names(tibble::tbl_sum(motion)))
  }
  for (slack in c(1.001 * up, 1.001 * down)) {
    expect_warning(
      trajectory(scene(slack), 0:1), "slack from 0 s on", class = "rotdyn_warning_slack"
    )
  }
  # Taut at the start, slack at rows before it.
  expect_warning(
    trajectory(scene(0.999 * up), c(-0.5, 0, 1)), "slack from -0.5 s on",
    class = "rotdyn_warning_slack"
  )
})

test_that("a pulley without mass has its radius", {
  ideal <- scene_hanging_mass(body_disk(0, 0.1), 1.1, counter_mass_kg = 1)
  expect_identical(ideal$radius_m, 0.1)
  # Atwood's machine: a = (m1 - m2)/(m1 + m2) g.
  motion <- trajectory(ideal, 0:2)
  expect_equal(motion$alpha_rad_per_s2 * 0.1, rep(0.1 / 2.1 * 9.80665, 3), tolerance = 1e-14)
})

test_that("the radius is the body's where it has one", {
  expect_equal(scene_hanging_mass(body_disk(2, 0.1), 0.5)$radius_m, 0.1)
  expect_equal(scene_hanging_mass(body_thick_tube(2, 0.1, 0.05, 1), 0.5)$radius_m, 0.1)
  expect_equal(scene_hanging_mass(body_sphere(2, 0.1), 0.5, axis = "x")$radius_m, 0.1)
  placed <- place_body(body_cylinder(2, 0.1, 1), c(1, 2, 3))
  expect_equal(scene_hanging_mass(placed, 0.5)$radius_m, 0.1)
  expect_identical(
    trajectory(scene_hanging_mass(body_disk(2, 0.1), 0.5), 0:2)$tension_n,
    trajectory(scene_hanging_mass(body_disk(2, 0.1), 0.5, 0.1), 0:2)$tension_n
  )
})

test_that("every verb knows pulley and masses", {
  scene <- scene_hanging_mass(body_disk(2, 0.1), 0.5, omega0_rad_per_s = -20)
  expect_output(
    print(scene), "a mass hanging from a pulley.*disk.*rope at 0.1 m.*0.5 kg.*of the weights"
  )
  expect_output(
    print(scene_hanging_mass(0.1, 2, 0.1, counter_mass_kg = 1)),
    "two masses hanging from a pulley.*2 and 1 kg"
  )
  motion <- trajectory(scene, seq(0, 2, by = 0.5))
  # The highest place, between the rows: v^2/(2 a), a = g/3.
  up <- time_when(motion, omega_rad_per_s = 0)
  expect_equal(up$time_s, 2 * 3 / 9.80665, tolerance = 1e-14)
  expect_equal(up$height_m, 4 * 3 / 2 / 9.80665, tolerance = 1e-13)
  expect_equal(
    time_when(motion, height_m = 0, occurrence = "all")$time_s, c(0, 12 / 9.80665),
    tolerance = 1e-13
  )
  expect_equal(predict(motion, 1)$tension_n, 0.5 * 9.80665 * 2 / 3, tolerance = 1e-14)
  # Of a pulley without inertia, too.
  none <- trajectory(
    scene_hanging_mass(0, 1.2, 0.1, counter_mass_kg = 1, omega0_rad_per_s = -20), c(0, 9)
  )
  expect_equal(
    time_when(none, height_1_m = 0, occurrence = "all")$time_s, c(0, 4 / (0.2 / 2.2 * 9.80665)),
    tolerance = 1e-12
  )
  expect_equal(summary(none)$max_rotational_kinetic_energy_j, 0)
  kept <- conserved(scene)
  expect_true(kept$conserved[kept$quantity == "energy"])
  expect_match(kept$why[kept$quantity == "angular_momentum"], "weights")
  balances <- audit(motion)
  expect_true(all(balances$verdict == "balanced"))
  expect_true(balances$conserved[balances$balance == "energy"])
  # A rate that is wrong shows.
  wrong <- motion
  wrong$omega_rad_per_s[5] <- wrong$omega_rad_per_s[5] * (1 + 1e-9)
  expect_equal(audit(wrong)$verdict, c("unbalanced", "unbalanced"))
  skip_if_not_installed("yyjsonr")
  again <- read_scene(write_scene(scene))
  expect_identical(trajectory(again, 0:2)$tension_n, trajectory(scene, 0:2)$tension_n)
  expect_identical(scene_hash(again), scene_hash(scene))
  # The frame of the pulley turns with its angular acceleration, that of the mass.
  turned <- to_rotating_frame(
    data.frame(time_s = 0:1, x_m = 1, y_m = 0, z_m = 0), motion
  )
  expect_true(all(is.finite(unlist(turned))))
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(motion), "ggplot")
  expect_s3_class(ggplot2::autoplot(none, panels = c("tension", "energy of the masses")), "ggplot")
})

# On a pulley without inertia that winds a mass up, the tension is -c |omega|/r.
test_that("a tension below 0 is slack from 16 units of rounding of the weights on", {
  wound <- function(units) {
    size <- units * .Machine$double.eps * 2 * 9.80665
    scene_hanging_mass(
      0, 2, 0.5, resistance(viscous_n_m_s = size * 0.5), omega0_rad_per_s = -1
    )
  }
  expect_no_warning(trajectory(wound(12), 0))
  expect_warning(trajectory(wound(24), 0), class = "rotdyn_warning_slack")
})

test_that("a round body's radius is taken about its axis, whichever way that points", {
  disk <- body_disk(2, 0.25)
  for (axis in list(c(0, 0, 1), c(0, 0, -1))) {
    expect_equal(scene_hanging_mass(disk, 1, axis = axis)$radius_m, 0.25)
  }
  expect_error(scene_hanging_mass(disk, 1, axis = c(1, 0, 0)), class = "rotdyn_error_missing")
})

test_that("the slopes of both masses: one goes up where the other goes down", {
  columns <- list(omega_rad_per_s = c(2, -1), alpha_rad_per_s2 = c(0.5, 0.5))
  two <- rotdyn:::hanging_slopes(columns, scene_hanging_mass(0.05, 3, 0.1, counter_mass_kg = 2))
  one <- rotdyn:::hanging_slopes(columns, scene_hanging_mass(0.05, 3, 0.1))
  expect_length(one, 3)
  expect_length(two, 6)
  expect_false(anyNA(names(two)) || anyDuplicated(names(two)) > 0)
  expect_equal(unname(two[[1]]), -unname(two[[4]]))
  expect_equal(unname(two[[1]]), -columns$omega_rad_per_s)
  expect_equal(unname(two[[2]]), c(1, -0.5))
})

test_that("the columns of the masses are documented in the order of the table", {
  for (counter in c(0, 2)) {
    motion <- trajectory(scene_hanging_mass(0.05, 3, 0.1, counter_mass_kg = counter), 0:1)
    named <- rotdyn:::hanging_names_of(1L + (counter > 0))
    expect_identical(intersect(names(motion), named), named)
  }
})
