# The C routine behind sweeps; the numbers themselves are checked in tests/core/test_sweep.c.

knots <- list(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0), c(0, 0))

sweep_linear <- function(..., start_s = 0, threads = 1) {
  .Call(rotdyn:::ffi_sweep_linear, knots, list(...), start_s, threads, NULL)
}

test_that("a sweep gives where each row ends and how fast it was", {
  got <- sweep_linear(c(0.0625, 0.0625), 0.03, 1, 0, 0, c(8, 5.5))
  expect_identical(got[[2]], c(0L, 0L))
  columns <- got[[1]]
  # mpmath, 50 digits
  expect_equal(columns$theta_rad, c(107.858645333017104, 79.8310161413961043), tolerance = 1e-14)
  expect_equal(columns$omega_rad_per_s, c(5.82785024015179531, 18.4811122521298745),
    tolerance = 1e-14
  )
  expect_equal(columns$omega_max, rep(22.0539440643637922, 2), tolerance = 1e-14)
  expect_equal(columns$omega_max_time_s, rep(4.34595419517271574, 2), tolerance = 1e-14)
  expect_identical(columns$speed_max, columns$omega_max)
  expect_identical(columns$omega_min, c(0, 0))
  expect_true(all(columns$error > 0 & columns$error < 1e-14))
  expect_identical(got[[3]]$rows_done, 2)
})

test_that("a sweep does not depend on the number of threads", {
  inertia <- seq(0.05, 0.1, length.out = 1e5)
  expect_gte(.Call(rotdyn:::ffi_sweep_threads), 1L)
  expect_identical(
    sweep_linear(inertia, 0.03, 1, 0, 0, 8, threads = 1)[1:2],
    sweep_linear(inertia, 0.03, 1, 0, 0, 8, threads = 0)[1:2]
  )
})

test_that("a row that cannot be computed says so, and the others go on", {
  got <- sweep_linear(c(1, -1, NA, 1), 0, 1, 0, 0, c(2, 2, 2, -1))
  expect_identical(got[[2]] == 0L, c(TRUE, FALSE, FALSE, FALSE))
  expect_identical(is.nan(got[[1]]$omega_max), c(FALSE, TRUE, TRUE, TRUE))
})

test_that("a wrong call is an error", {
  expect_error(sweep_linear(1, 0, 1, 0, 0), "internal")
  expect_error(sweep_linear(c(1, 2, 3), c(0, 0), 1, 0, 0, 1), "internal")
  expect_error(sweep_linear(1L, 0, 1, 0, 0, 1), "internal")
  expect_error(sweep_linear(1, 0, 1, 0, 0, 1, threads = -1), "internal")
})
