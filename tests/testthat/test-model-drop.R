record <- function(id) Filter(function(m) m$id == id, rotdyn:::all_models())[[1]]
bound <- function(scene, effects, id, t) {
  rotdyn:::drop_bound(scene, effects, record(id), t, NULL)
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
  expect_equal(audit(coarse)$verdict, "balanced")
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
