motion_of <- function(scene, time_s, accuracy = 1e-9, model = NULL) {
  trajectory(scene, time_s, accuracy, model)
}

test_that("a clutch locks when and where it must", {
  # 12 N m on 2 and 3 kg m^2: 12 (1/2 + 1/3) = 10 rad/s^2, so 10 rad/s are gone after 1 s.
  motion <- motion_of(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)), c(0, 0.5, 1, 2))
  expect_named(motion, columns_of_motion("clutch"))
  expect_equal(motion$omega_1_rad_per_s, c(10, 7, 4, 4), tolerance = 1e-15)
  expect_equal(motion$omega_2_rad_per_s, c(0, 2, 4, 4), tolerance = 1e-15)
  expect_equal(motion$heat_j, c(0, 45, 60, 60), tolerance = 1e-15)
  expect_equal(motion$locked, c(FALSE, FALSE, TRUE, TRUE))
  expect_equal(motion$clutch_torque_n_m, c(12, 12, 0, 0))
  run <- attr(motion, "run")
  expect_equal(run$events$event, "lock")
  expect_equal(run$events$time_s, 1, tolerance = 1e-15)
  expect_equal(run$error_kind, "bound")
  expect_lte(run$info$error, 1e-14)
})

test_that("a locked clutch slips when the torque grows, and the audit balances", {
  scene <- scene_clutch(
    2, 3, 12, static_capacity_n_m = 15, omega0_rad_per_s = c(10, 0),
    torque = list(torque_knots(c(0, 2, 2, 3, 3, 9), c(0, 0, 50, 50, -5, -5)), NULL),
    engage_s = 0.25
  )
  motion <- motion_of(scene, seq(0, 9, by = 0.25))
  # Locked, 3/5 of 50 N m is more than 15; afterwards 3/5 of 5 is not.
  expect_equal(attr(motion, "run")$events$event, c("lock", "slip", "lock"))
  expect_equal(attr(motion, "run")$events$time_s[1:2], c(1.25, 2), tolerance = 1e-15)
  balance <- audited(motion)
  expect_equal(balance$verdict, "balanced")
  expect_equal(balance$torque_impulse_n_m_s, 50 - 30)
  expect_gt(balance$dissipated_j, 60)
  motion$heat_j[nrow(motion)] <- motion$heat_j[nrow(motion)] * 1.001
  expect_equal(audited(motion)$verdict, "unbalanced")
})

test_that("there is no way back before the start", {
  scene <- scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0), start_s = 1)
  expect_error(motion_of(scene, 0:2), class = "rotdyn_error_time")
  expect_equal(motion_of(scene, 1:2)$omega_1_rad_per_s, c(10, 4), tolerance = 1e-15)
})

test_that("two motions are as far apart as the body that differs most", {
  got <- rbind(c(1, -2), c(3, 4))
  expect_identical(rotdyn:::largest_distance(got, rbind(c(1.5, -2), c(3, 1))), c(0.5, 3))
})

test_that("a clutch whose bodies turn alike conserves the energy", {
  energy <- function(...) {
    stated <- conserved(scene_clutch(2, 3, ..., engage_s = 1))
    stated[stated$quantity == "energy", ]
  }
  alike <- energy(12, omega0_rad_per_s = c(5, 5))
  expect_true(alike$conserved)
  expect_match(alike$why, "does not slip")
  expect_true(energy(0, omega0_rad_per_s = c(5, 4))$conserved)
  slips <- energy(12, omega0_rad_per_s = c(5, 4))
  expect_false(slips$conserved)
  expect_match(slips$why, "slips")
})

test_that("the summary's lock time is that of the rows", {
  lock <- function(...) summary(trajectory(scene_clutch(1, 2, ...), 0:4))$lock_time_s
  # 10 rad/s of slip, changed by 5 N m (1/1 + 1/2) / (kg m^2).
  expect_equal(lock(5, omega0_rad_per_s = c(10, 0)), 10 / 7.5, tolerance = 1e-12)
  expect_identical(lock(5, omega0_rad_per_s = c(3, 3)), 0)
  expect_identical(lock(0.1, omega0_rad_per_s = c(10, 0)), NA_real_)
})

test_that("a clutch that is never pressed is refused, one that always was is not", {
  expect_error(
    scene_clutch(1, 2, 5, engage_s = Inf), "a number, or -Inf; it is Inf",
    class = "rotdyn_error_value"
  )
  expect_no_error(scene_clutch(1, 2, 5, engage_s = -Inf))
})
