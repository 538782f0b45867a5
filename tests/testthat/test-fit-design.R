# Planned records beside linear regression, and beside fits with a further record.

wheel <- function(theta0, omega0) scene_axle(0.5, theta0_rad = theta0, omega0_rad_per_s = omega0)
start <- c("theta0_rad", "omega0_rad_per_s")

turning <- function(time_s, sigma, seed = 1) {
  set.seed(seed)
  data.frame(time_s = time_s, theta_rad = 1 + 3 * time_s + stats::rnorm(length(time_s), 0, sigma))
}

# Standard errors of a straight line by its normal equations.
line_errors <- function(time_s, sigma) {
  design <- cbind(1, time_s) / sigma
  unname(sqrt(diag(solve(crossprod(design)))))
}

test_that("further records of a linear motion: the normal equations", {
  near <- 0:40 / 10
  far <- 0:80 / 5
  fit <- fit_scene(wheel(0, 2), turning(near, 0.05), start, noise = c(theta_rad = 0.05))
  planned <- fit_design(fit, list(
    again = planned_record(near, "theta_rad"),
    far = planned_record(far, "theta_rad"),
    fine = planned_record(near, "theta_rad", noise = c(theta_rad = 0.005)),
    one = planned_record(20, "theta_rad"),
    rate = planned_record(c(1, 2), "omega_rad_per_s", noise = c(omega_rad_per_s = 0.001))
  ))
  expect_s3_class(planned, "rot_fit_design")
  expect_identical(planned$candidate, rep(c("again", "far", "fine", "one", "rate"), each = 2))
  expect_identical(planned$unknown, rep(start, 5))
  expect_equal(planned$standard_error, rep(line_errors(near, 0.05), 5), tolerance = 1e-6)
  both <- function(time_s, sigma) {
    line_errors(c(near, time_s), c(rep(0.05, length(near)), rep(sigma, length(time_s))))
  }
  rate <- sqrt(diag(solve(crossprod(cbind(1, near) / 0.05) + diag(c(0, 2 / 0.001^2)))))
  wanted <- c(both(near, 0.05), both(far, 0.05), both(near, 0.005), both(20, 0.05), rate)
  expect_equal(planned$planned_error, unname(wanted), tolerance = 1e-6)
  expect_equal(planned$ratio, planned$planned_error / planned$standard_error)
  expect_equal(planned$ratio[1:2], rep(sqrt(0.5), 2), tolerance = 1e-6)
})

test_that("a planned record does what the record does when it is measured", {
  friction <- function(omega0) {
    scene_axle(0.5, resistance = resistance(0.02, 0, 0.05), omega0_rad_per_s = omega0)
  }
  record <- function(omega0, time_s, seed) {
    set.seed(seed)
    out <- as.data.frame(trajectory(friction(omega0), time_s)[c("time_s", "theta_rad")])
    out$theta_rad <- out$theta_rad + stats::rnorm(nrow(out), 0, 0.01)
    out
  }
  unknown <- c("resistance$viscous_n_m_s", "resistance$coulomb_n_m", "omega0_rad_per_s")
  first <- record(10, 0:100 / 10, 1)
  of <- function(records) {
    fit_scene(friction(9), records, unknown, per_record = "omega0_rad_per_s",
              noise = c(theta_rad = 0.01))
  }
  fit <- of(list(first))
  planned <- fit_design(fit, planned_record(0:300 / 10, "theta_rad", inputs = list(
    omega0_rad_per_s = 4
  )))
  measured_too <- of(list(first, record(4, 0:300 / 10, 2)))
  # Known unknowns, the start of the first record; each record has a start of its own.
  expect_equal(planned$planned_error, measured_too$standard_error[1:3], tolerance = 0.02)
  expect_lt(planned$ratio[2], 0.2)
  # An instrument's zero is one of both records, its clock is not.
  own <- function(...) {
    fit_scene(friction(9), list(first), unknown[2:3], noise = c(theta_rad = 0.01), ...)
  }
  zero <- fit_design(own(offset = "theta_rad"), planned_record(0:5, "theta_rad"))
  expect_identical(zero$unknown, c(unknown[2:3], "offset of theta_rad"))
  expect_true(all(zero$ratio < 1))
})

test_that("what is not determined becomes so, or stays as it is", {
  throw <- scene_free(c(1, 2, 2.4), c(0.1, 5, 0.2))
  film <- as.data.frame(trajectory(throw, 0:50 / 100))
  rates <- paste0("omega_", c("x", "y", "z"), "_rad_per_s")
  film <- film[c("time_s", rates)]
  set.seed(3)
  for (name in rates) film[[name]] <- film[[name]] + stats::rnorm(51, 0, 0.01)
  fit <- fit_scene(throw, film, c("body[1]", "body[2]", "body[3]"))
  planned <- fit_design(fit, list(
    same = planned_record(0:50 / 100, rates),
    energy = planned_record(0:50 / 100, "rotational_kinetic_energy_j",
                              noise = c(rotational_kinetic_energy_j = 0.01))
  ))
  expect_true(all(is.nan(planned$planned_error[1:3])))
  expect_true(all(is.finite(planned$planned_error[4:6])))
  expect_identical(planned$ratio[4:6], c(0, 0, 0))
})

test_that("planned records that cannot be", {
  fit <- fit_scene(wheel(0, 2), turning(0:40 / 10, 0.05), start)
  refused <- function(record, class, text) {
    expect_error(fit_design(fit, record), text, class = class)
  }
  refused(planned_record(0:3, "height_m"), "rotdyn_error_argument", "height_m")
  refused(planned_record(0:3, "theta_rad", inputs = c(omega0_rad_per_s = 3)),
          "rotdyn_error_argument", "per_record")
  refused(planned_record(0:3, "theta_rad", inputs = c(mass = 3)), "rotdyn_error_argument", "mass")
  refused(planned_record(0:3, "omega_rad_per_s"), "rotdyn_error_argument", "noise")
  refused(planned_record(0:3, "theta_rad", noise = c(x_m = 1)), "rotdyn_error_argument", "x_m")
  refused(planned_record(-1:3, "theta_rad"), "rotdyn_error_value", "begins before")
  refused(list(1), "rotdyn_error_type", "planned_record")
  expect_error(planned_record(0:3, 1), class = "rotdyn_error_type")
  expect_error(planned_record(double(), "x_m"), class = "rotdyn_error_time")
  expect_error(planned_record(0, "x_m", noise = c(x_m = -1)), class = "rotdyn_error_value")
  expect_error(planned_record(0, "x_m", inputs = 3), class = "rotdyn_error_type")
  expect_output(print(planned_record(0:3, "x_m", inputs = c(a = 1), noise = c(x_m = 2))),
                "4 times, 0 to 3 s, of x_m\n  a = 1\n  noise of x_m: 2")
})

test_that("values of a fit are measured numbers with their correlations", {
  film <- turning(0:40 / 10, 0.05)
  fit <- fit_scene(wheel(0, 2), film, start, noise = "white")
  numbers <- measured(fit)
  expect_identical(names(numbers), start)
  expect_equal(numbers$theta0_rad$value, fit$value[1])
  expect_equal(c(numbers[[1]]$u, numbers[[2]]$u), fit$standard_error)
  # The angle at a time, by regression.
  at <- numbers$theta0_rad + 2.5 * numbers$omega0_rad_per_s
  line <- stats::predict(stats::lm(theta_rad ~ time_s, film), data.frame(time_s = 2.5),
                         se.fit = TRUE)
  expect_equal(at$value, unname(line$fit), tolerance = 1e-9)
  expect_equal(at$u, line$se.fit, tolerance = 1e-6)
  expect_equal(numbers$theta0_rad$parts$dof[1], 39)
  # Twice the same.
  expect_identical((measured(fit)$theta0_rad - numbers$theta0_rad)$u, 0)
  expect_identical(nrow((measured(fit)$theta0_rad - numbers$theta0_rad)$parts), 0L)
})

test_that("a planned record observes columns by name", {
  expect_identical(planned_record(1:3, c("theta_rad", "theta_rad"))$observed, "theta_rad")
  for (observed in list(character(), NA_character_, c("theta_rad", NA), 1)) {
    expect_error(planned_record(1:3, observed), "names of columns", class = "rotdyn_error_type")
  }
})
