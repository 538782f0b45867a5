# Absolute bounds on what leaving effects out changes, and the scene without them.
bound <- function(scene, effects, id, t) {
  dropped <- core_pick("axle", scene, as.double(t), 1, model = id)$dropped[[1]]
  expect_setequal(dropped$effects, effects)
  scene$without <- effects
  c(as.list(dropped$errors), list(scene = scene))
}

# Scenes whose full and reduced motion both have a closed form: the bound must cover the difference,
# and not by decades.
test_that("what was dropped changes the motion by no more than the bound", {
  t <- seq(0.5, 8, by = 0.5)
  cases <- list(
    list(resistance(0.03, quadratic_n_m_s2 = 1e-6), "quadratic"),
    list(resistance(0.03, coulomb_n_m = 1e-4, static_n_m = 2e-4), "friction"),
    list(resistance(0.03, 1e-5, 1e-3), c("quadratic", "friction")),
    list(resistance(0, 1e-5), "quadratic")
  )
  for (case in cases) {
    for (omega0 in c(-3, 0, 5)) {
      scene <- scene_axle(0.0625, torque_steps(c(0, 3), c(0.8, -0.2)), case[[1]], 1, omega0)
      full <- trajectory(scene, t, model = "axle_drag")
      b <- bound(scene, case[[2]], "axle_linear", t)
      reduced <- trajectory(b$scene, t, model = "axle_linear")
      for (state in c("omega", "theta")) {
        column <- c(omega = "omega_rad_per_s", theta = "theta_rad")[[state]]
        difference <- max(abs(full[[column]] - reduced[[column]]))
        expect_lte(difference, b[[state]])
        expect_gte(difference, b[[state]] / 100)
      }
    }
  }
})

test_that("weak drag is left out at a low accuracy, with the reason, and kept at a high one", {
  scene <- scene_axle(
    body_disk(2, 0.25), torque_knots(c(0, 8), c(0, 0.8)),
    resistance(0.03, quadratic_n_m_s2 = 1e-12)
  )
  coarse <- trajectory(scene, 0:8, accuracy = 1e-6)
  run <- attr(coarse, "run")
  expect_equal(run$model, "axle_linear")
  expect_equal(run$dropped$effects, "quadratic")
  expect_lte(run$info$error, 1e-6)
  expect_gt(run$info$error, 1e-12)
  expect_match(choose_model(scene, 0:8, 1e-6)$reason[2], "quadratic drag ignored")
  expect_match(paste(names(tibble::tbl_sum(coarse)), collapse = " "), "Dropped")
  fine <- trajectory(scene, 0:8, accuracy = 1e-12)
  expect_match(attr(fine, "run")$model, "rk8pd")
  expect_null(attr(fine, "run")$dropped)
  expect_lte(
    max(abs(fine$omega_rad_per_s - coarse$omega_rad_per_s)) / max(fine$omega_rad_per_s),
    run$info$error
  )
  expect_equal(audited(coarse)$verdict, "balanced")
})

test_that("an exact model is never left for a cheaper one with something dropped", {
  scene <- scene_axle(1, 1, resistance(viscous_n_m_s = 1e-30))
  expect_equal(attr(trajectory(scene, 1, 0.1), "run")$model, "axle_linear")
})

test_that("nothing is dropped that has no bound", {
  # A torque of unknown size; a motion of size 0; times before the start.
  f <- scene_axle(1, torque_function(function(t) 1, breaks_s = double()), resistance(0, 1e-30))
  expect_equal(attr(trajectory(f, 1, 0.1), "run")$model, "axle_rk8pd")
  still <- scene_axle(1, torque_knots(c(5, 6), c(1, 2)), resistance(0, 1e-30))
  expect_equal(attr(trajectory(still, 0:3, 0.1), "run")$model, "axle_rk8pd")
  ramp <- scene_axle(1, torque_knots(c(0, 1), c(1, 2)), resistance(0, 1e-30), omega0_rad_per_s = 1)
  expect_equal(attr(trajectory(ramp, -1:3, 0.1), "run")$model, "axle_rk8pd")
})

test_that("a spring of negative stiffness is bounded, not taken for a gain", {
  t <- c(0, 0.5, 1)
  strong <- scene_axle(1, -1 * torque_spring(100), omega0_rad_per_s = 20)
  m <- trajectory(strong, t, accuracy = 1e-6)
  expect_equal(m$theta_rad, 2 * sinh(10 * t), tolerance = 1e-6) # theta'' = 100 theta
  weak <- scene_axle(1, -1 * torque_spring(1e-9), omega0_rad_per_s = 20)
  b <- bound(weak, "spring", "axle_free", t)
  k <- sqrt(1e-9)
  expect_lte(abs(20 / k * sinh(k) - 20), b$theta)
  expect_lte(20 * (cosh(k) - 1), b$omega)
  expect_lte(b$omega, 100 * 20 * (cosh(k) - 1))
})

test_that("a bound knows that shrinking inertia speeds the body up", {
  # I from 5 to 0.5 at once: omega = 10, and q omega^2/I t = 0.02 after 10 s for q = 1e-5.
  skater <- inertia_knots(c(0.001, 0.001), c(5, 0.5))
  scene <- scene_axle(
    skater, resistance = resistance(quadratic_n_m_s2 = 1e-5), omega0_rad_per_s = 1
  )
  b <- bound(scene, "quadratic", "axle_skater", c(0, 10))
  slowed <- 10 / (1 + 1e-5 * 10 / 0.5 * 10) # omega' = -(q/I) omega^2
  expect_gte(b$omega, 10 - slowed)
  expect_lte(b$omega, 20 * (10 - slowed))
  # A spring gives and takes; pulling in at the right time pumps it.
  pumped <- scene_axle(
    inertia_knots(c(1, 1), c(5, 0.5)), torque_spring(1e-6), omega0_rad_per_s = 1
  )
  full <- trajectory(pumped, c(0, 5), 1e-10, model = "axle_rk8pd")
  free <- trajectory(scene_axle(inertia_knots(c(1, 1), c(5, 0.5)), omega0_rad_per_s = 1), c(0, 5))
  b <- bound(pumped, "spring", "axle_skater", c(0, 5))
  expect_lte(max(abs(full$omega_rad_per_s - free$omega_rad_per_s)), b$omega)
})

test_that("nothing is dropped where static friction decides, nor without rows", {
  law <- torque_knots(c(0, 10), c(-2, -1)) + torque_curve(c(-1, 1), c(0, 0))
  losses <- resistance(0, 1e-9, coulomb_n_m = 0.1, static_n_m = 1.5)
  sticky <- scene_axle(1, law, losses, omega0_rad_per_s = 9.5)
  pick <- core_pick("axle", sticky, as.double(0:5), 1, model = "axle_bands")
  expect_null(pick$dropped[[1]])
  expect_match(pick$reason, "does not take quadratic drag")
  fading <- scene_axle(1, torque_exponential(1, 2), resistance(0, 1e-9))
  expect_silent(trajectory(fading, numeric(), 0.1))
})

test_that("predict() beyond the rows does not lean on a bound that ends with them", {
  scene <- scene_axle(
    1, torque_knots(c(0, 8), c(0, 1)), resistance(0, 1e-9), omega0_rad_per_s = 1
  )
  m <- trajectory(scene, 0:8, 1e-6)
  expect_equal(run_of(m)$dropped$effects, "quadratic")
  far <- trajectory(scene, 1e6, 1e-6, model = "axle_rk8pd")
  expect_equal(predict(m, 1e6)$theta_rad, far$theta_rad, tolerance = 1e-6)
  expect_equal(predict(m, 4), tibble::as_tibble(m)[5, ])
})

test_that("what is left out of the motion acts in the columns of torque", {
  # -1 * 1 * 9.80665 sin(1), by hand
  still <- trajectory(scene_pendulum(body_point(1), 1, resistance(0.5), theta0_rad = 1), 0)
  expect_equal(still$net_torque_n_m, -9.80665 * sin(1), tolerance = 1e-15)
  expect_equal(still$applied_torque_n_m, -9.80665 * sin(1), tolerance = 1e-15)
  moving <- trajectory(
    scene_axle(2, torque_spring(3, 0.5), resistance(0.5, 0.25, 1), omega0_rad_per_s = -2), 0
  )
  expect_equal(moving$applied_torque_n_m, 1.5)
  expect_equal(moving$damping_torque_n_m, 0.5 * 2 + 0.25 * 4 + 1)
  expect_equal(moving$net_torque_n_m, 4.5)
  # At rest friction holds it, or opposes its breaking loose.
  at_rest <- function(...) {
    trajectory(scene_axle(1, torque_spring(3, 0.5), resistance(quadratic_n_m_s2 = 1, ...)), 0)
  }
  expect_equal(at_rest(coulomb_n_m = 2)$damping_torque_n_m, -1.5)
  expect_equal(at_rest(coulomb_n_m = 1)$net_torque_n_m, 0.5)
})

test_that("the error figure holds for every column of a motion without some effects", {
  ramp <- torque_knots(c(0, 8), c(0.1, 0.8))
  scenes <- list(
    scene_axle(0.5, ramp, resistance(0.03, quadratic_n_m_s2 = 1e-9)),
    scene_axle(0.5, ramp + torque_spring(1e-8, 20), resistance(0.03, quadratic_n_m_s2 = 1e-9)),
    scene_axle(0.5, torque_sinusoid(1, 3) + torque_gravity(1e-9, 1), resistance(0.1, 1e-9)),
    scene_axle(0.5, torque_sinusoid(1, 3), resistance(0.03, coulomb_n_m = 1e-9))
  )
  for (scene in scenes) {
    coarse <- trajectory(scene, seq(0, 8, 0.5), accuracy = 1e-4)
    fine <- trajectory(scene, seq(0, 8, 0.5), accuracy = 1e-12)
    expect_false(is.null(run_of(coarse)$dropped))
    ledger <- augment(coarse)
    want <- augment(fine)
    for (name in setdiff(names(coarse), "time_s")) {
      off <- max(abs(coarse[[name]] - fine[[name]])) / max(abs(fine[[name]]))
      expect_lte(off, 4 * run_of(coarse)$info$error)
    }
    for (name in c("work_j", "dissipated_viscous_j", "dissipated_quadratic_j",
                   "dissipated_coulomb_j")) {
      size <- max(abs(want[[name]]))
      if (size > 0) expect_lte(max(abs(ledger[[name]] - want[[name]])) / size, 1e-4)
    }
  }
})

test_that("a motion without some effects is measured between its rows", {
  # A kick and its reverse between two rows, in a twentieth of the time: omega reaches 0.1 rad/s.
  kick <- torque_knots(c(4, 4.1, 4.3, 4.4), c(0, 1, -1, 0))
  motion <- trajectory(scene_axle(1, kick, resistance(0, 1e-10)), c(0, 10), 1e-3)
  expect_equal(run_of(motion)$dropped$effects, "quadratic")
  expect_lt(max(abs(motion$omega_rad_per_s)), 1e-12)
  expect_equal(run_of(motion)$info$sizes[["omega"]], 0.1, tolerance = 0.01)
  # Also where the figure of the rows alone is small.
  turning <- scene_axle(1, kick, resistance(0, 1e-10), omega0_rad_per_s = 0.01)
  motion <- trajectory(turning, c(0, 10), 1e-3)
  expect_lt(run_of(motion)$info$error, 1e-3)
  expect_equal(run_of(motion)$info$sizes[["omega"]], 0.11, tolerance = 0.01)
})
