lanes <- function(...) {
  data.frame(
    beta = 0.4, radius_m = 0.11, incline_angle_deg = 0, static_friction = c(0.05, 0.1, 0.2),
    v0_m_per_s = 8.1, omega0_rad_per_s = 0, mass_kg = 6, gravity_m_per_s2 = 9.8, ...
  )
}

test_that("the bowling ball on lanes of different friction", {
  # t = 2 v0/(7 mu g), v = 5/7 v0, heat = m/7 v0^2
  out <- incline_table(lanes(), time_s = 6)
  mu <- c(0.05, 0.1, 0.2)
  expect_equal(out$roll_time_s, 2 / 7 * 8.1 / (mu * 9.8), tolerance = 1e-15)
  expect_equal(out$final_v_m_per_s, rep(8.1 * 5 / 7, 3), tolerance = 1e-15)
  expect_equal(out$slip_heat_j, rep(6 / 7 * 8.1^2, 3), tolerance = 1e-14)
  expect_true(all(out$rolling))
  expect_true(all(out$error < 1e-14))
  expect_s3_class(out, "rot_incline_table")
  # Too early for the first two.
  expect_identical(is.na(incline_table(lanes(), 1.3)$roll_time_s), c(TRUE, TRUE, FALSE))
  expect_false(any(is.nan(incline_table(lanes(), 1.3)$roll_time_s)))
})

test_that("every row is what its scene does", {
  set.seed(7)
  n <- 60
  mu <- stats::runif(n, 0, 0.8)
  rows <- data.frame(
    beta = stats::runif(n, 0.2, 1), radius_m = stats::runif(n, 0.05, 0.5),
    incline_angle_deg = stats::runif(n, -60, 60), static_friction = mu,
    kinetic_friction = mu * stats::runif(n, 0.5, 1), rolling_arm_m = rep(c(0, 0.004), n / 2),
    v0_m_per_s = stats::rnorm(n, 0, 3), omega0_rad_per_s = stats::rnorm(n, 0, 20),
    mass_kg = stats::runif(n, 0.1, 5), time_s = stats::runif(n, 0, 4)
  )
  out <- incline_table(rows)
  for (i in seq_len(n)) {
    r <- rows[i, ]
    scene <- scene_incline(
      body_disk(r$mass_kg, r$radius_m * sqrt(2 * r$beta)), r$incline_angle_deg,
      radius_m = r$radius_m, static_friction = r$static_friction,
      kinetic_friction = r$kinetic_friction, rolling_arm_m = r$rolling_arm_m,
      v0_m_per_s = r$v0_m_per_s, omega0_rad_per_s = r$omega0_rad_per_s
    )
    motion <- trajectory(scene, r$time_s)
    end <- c(motion$x_m, motion$v_m_per_s, motion$theta_rad, motion$omega_rad_per_s)
    got <- unlist(out[i, c(
      "final_x_m", "final_v_m_per_s", "final_theta_rad", "final_omega_rad_per_s"
    )], use.names = FALSE)
    info <- run_of(motion)$info
    # beta of the body is a rounding off.
    expect_true(all(abs(got - end) <= info$errors + (out$error[i] + 1e-14) * info$sizes))
    expect_equal(out$slip_heat_j[i], motion$slip_heat_j, tolerance = 1e-11)
    expect_equal(out$rolling_heat_j[i], motion$rolling_heat_j, tolerance = 1e-11)
    expect_identical(out$rolling[i], motion$rolling)
    expect_equal(out$roll_time_s[i], summary(motion)$roll_time_s, tolerance = 1e-11)
  }
})

test_that("threads change no bit", {
  n <- 20000
  set.seed(3)
  rows <- data.frame(
    beta = stats::runif(n, 0.2, 1), radius_m = 0.1, incline_angle_deg = stats::runif(n, 0, 60),
    static_friction = stats::runif(n), v0_m_per_s = stats::rnorm(n), omega0_rad_per_s = 5
  )
  expect_identical(incline_table(rows, 2, threads = 2), incline_table(rows, 2))
})

test_that("missing numbers, defaults, no rows", {
  out <- incline_table(transform(lanes(), static_friction = c(NA, 0.1, 0.2)), 6)
  expect_identical(is.na(out$final_v_m_per_s), c(TRUE, FALSE, FALSE))
  expect_identical(is.na(out$rolling), c(TRUE, FALSE, FALSE))
  spin <- transform(lanes(), omega0_rad_per_s = c(0, NA, 0))
  expect_identical(is.na(incline_table(spin, 6)$final_x_m), c(FALSE, TRUE, FALSE))
  # University Physics 11: a marble on 30 degrees, 15.75 m in 3 s.
  marble <- incline_table(
    data.frame(beta = 0.4, radius_m = 0.01, incline_angle_deg = 30, gravity_m_per_s2 = 9.8), 3
  )
  expect_equal(marble$final_x_m, 15.75, tolerance = 1e-15)
  expect_identical(nrow(incline_table(lanes()[0, ], 1)), 0L)
  expect_named(incline_table(lanes()[0, ], 1), c(names(lanes()), incline_table_columns))
  expect_setequal(setdiff(incline_table_columns, column_table()$name), character())
})

test_that("bad rows are named", {
  bad <- function(..., time_s = 1) incline_table(transform(lanes(), ...), time_s)
  expect_error(incline_table(), class = "rotdyn_error_missing")
  expect_error(incline_table(3), class = "rotdyn_error_type")
  expect_error(incline_table(lanes()), "time_s", class = "rotdyn_error_missing")
  expect_error(incline_table(lanes()[-1], 1), "beta", class = "rotdyn_error_type")
  expect_error(bad(beta = c(1, 0, 1)), "row 2", class = "rotdyn_error_value")
  expect_error(bad(beta = c(1, Inf, 1)), "row 2", class = "rotdyn_error_value")
  expect_error(bad(incline_angle_deg = c(1, 2, 95)), "row 3", class = "rotdyn_error_value")
  expect_error(bad(static_friction = -1), class = "rotdyn_error_value")
  expect_error(bad(kinetic_friction = c(0.01, 0.2, 0.1)), "row 2", class = "rotdyn_error_value")
  expect_error(bad(static_friction = Inf), "slip", class = "rotdyn_error_value")
  expect_error(bad(time_s = -1), class = "rotdyn_error_value")
  expect_error(bad(time_s = 1:2), class = "rotdyn_error_size")
  expect_error(bad(beta = "a"), class = "rotdyn_error_type")
  expect_error(incline_table(lanes(), 1, thread = 2), class = "rotdyn_error_argument")
  expect_error(incline_table(transform(lanes()[-4], static_frictions = 1), 1),
    class = "rotdyn_error_argument")
  expect_warning(
    far <- bad(v0_m_per_s = c(1e300, 8, 8), time_s = 1e10),
    class = "rotdyn_warning_range"
  )
  expect_identical(is.nan(far$final_x_m), c(TRUE, FALSE, FALSE))
})

test_that("the plot of a table", {
  skip_if_not_installed("ggplot2")
  plot <- ggplot2::autoplot(incline_table(lanes(), 6))
  expect_match(ggplot2::get_alt_text(plot), "3 inclines over static friction")
})
