test_that("the article's table", {
  table <- rolling_table()
  expect_equal(names(table), c(
    "object", "beta", "acceleration_m_per_s2", "final_speed_m_per_s",
    "rotational_energy_fraction", "translational_energy_fraction"
  ))
  expect_equal(table$object, c(
    "hoop", "solid_disk", "solid_sphere", "thin_spherical_shell", "point_mass_sliding"
  ))
  expect_identical(table$beta, c(1, 0.5, 0.4, 2 / 3, 0))
  # g sin(20 degrees)/(1 + beta) and sqrt(2 g/(1 + beta)), computed with 50 digits.
  expect_ulps(
    table$acceleration_m_per_s2[1:3],
    c(1.6770359192723345418, 2.2360478923631127224, 2.3957655989604778788), 2
  )
  expect_ulps(
    table$final_speed_m_per_s[1:3],
    c(3.1315571206669693163, 3.6160106931995282146, 3.7429266623859996428), 2
  )
  expect_equal(table$rotational_energy_fraction, c(1 / 2, 1 / 3, 2 / 7, 2 / 5, 0))
  expect_equal(table$rotational_energy_fraction + table$translational_energy_fraction, rep(1, 5))
})

test_that("columns of the table decide row by row, others are kept, same names are replaced", {
  objects <- data.frame(
    beta = c(0.4, 1), incline_angle_deg = c(30, 90), height_drop_m = c(2, 3), who = c("a", "b"),
    final_speed_m_per_s = -1
  )
  table <- rolling_table(objects, gravity_m_per_s2 = 7)
  expect_equal(table$acceleration_m_per_s2, 7 * c(0.5, 1) / c(1.4, 2))
  expect_equal(table$final_speed_m_per_s, sqrt(2 * 7 * c(2, 3) / c(1.4, 2)))
  expect_equal(table$who, c("a", "b"))
  expect_equal(sum(names(table) == "final_speed_m_per_s"), 1)
  expect_warning(
    rolling_table(objects, incline_angle_deg = 10), class = "rotdyn_warning_column"
  )
})

test_that("the functions beneath agree with the table and work inside mutate()", {
  objects <- data.frame(beta = c(0.4, 1, 0, Inf), incline_angle_deg = c(20, 30, 45, 60))
  table <- rolling_table(objects, height_drop_m = 3)
  expect_identical(
    rolling_acceleration(objects$beta, objects$incline_angle_deg), table$acceleration_m_per_s2
  )
  expect_identical(rolling_final_speed(objects$beta, 3), table$final_speed_m_per_s)
  split <- energy_partition(objects$beta, 1)
  expect_identical(split$rotational_energy_fraction, table$rotational_energy_fraction)
  expect_identical(split$translational_energy_fraction, table$translational_energy_fraction)
  skip_if_not_installed("dplyr")
  mutated <- dplyr::mutate(objects, a = rolling_acceleration(beta, incline_angle_deg))
  expect_identical(mutated$a, table$acceleration_m_per_s2)
})

test_that("limits: a point that slides, all energy in rotation, vertical, level, backwards", {
  table <- rolling_table(data.frame(beta = c(0, Inf)), height_drop_m = 2)
  expect_equal(table$rotational_energy_fraction, c(0, 1))
  expect_equal(table$final_speed_m_per_s, c(sqrt(4 * 9.80665), 0))
  expect_identical(rolling_acceleration(1, 30, 9), 2.25) # sin(30 degrees) is 0.5
  expect_identical(rolling_acceleration(1, c(0, 90, -90), 9), c(0, 4.5, -4.5))
  expect_equal(rolling_final_speed(0, 1e200, 1e200) / 1e200, sqrt(2))
})

test_that("the friction that rolling needs", {
  # University Physics 1, section 11.1 (OpenStax): hoop and solid cylinder on 60 degrees.
  expect_equal(
    rolling_friction_coefficient(c(1, 0.5), 60), c(0.8660254037844386, 0.5773502691896258)
  )
  expect_equal(rolling_friction_coefficient(1, -60), rolling_friction_coefficient(1, 60))
  expect_identical(rolling_friction_coefficient(c(0, 1), 90), c(0, Inf))
})

test_that("near the vertical the angle keeps its digits", {
  # cos(90 - 1e-10 degrees), to 40 digits; in radians the cosine loses 1e-5 of it.
  angle <- 90 - 1e-10
  exact <- (90 - angle) * 1.7453292519943295769e-2
  expect_equal(1 / rolling_friction_coefficient(1, angle), 2 * exact, tolerance = 1e-15)
})

test_that("NA in, NA out, row by row", {
  table <- rolling_table(data.frame(beta = c(NA, 1), incline_angle_deg = c(20, NA)))
  expect_equal(is.na(table$acceleration_m_per_s2), c(TRUE, TRUE))
  expect_equal(is.na(table$final_speed_m_per_s), c(TRUE, FALSE))
  expect_equal(rolling_acceleration(NA, 20), NA_real_)
})

test_that("bad input is an error that names the row", {
  error <- expect_error(
    rolling_table(data.frame(beta = c(1, 2, -3))), class = "rotdyn_error_value"
  )
  expect_match(conditionMessage(error), "row 3")
  for (angle in c(91, -91)) {
    expect_error(rolling_table(data.frame(beta = 1), angle), class = "rotdyn_error_value")
    expect_error(rolling_acceleration(1, angle), class = "rotdyn_error_value")
  }
  expect_error(rolling_table(height_drop_m = -1), class = "rotdyn_error_value")
  expect_error(rolling_table(gravity_m_per_s2 = -1), class = "rotdyn_error_value")
  expect_error(rolling_table(incline_angle_deg = 1:3), class = "rotdyn_error_size")
  expect_error(rolling_table(data.frame(x = 1)), class = "rotdyn_error_type")
  expect_error(rolling_table(TRUE), class = "rotdyn_error_type")
  expect_error(rolling_acceleration(1:2, 1:3), class = "rotdyn_error_size")
  expect_error(rolling_acceleration("a", 20), class = "rotdyn_error_value")
})

test_that("no row, one row, many rows", {
  expect_equal(nrow(rolling_table(data.frame(beta = numeric()))), 0)
  expect_equal(nrow(rolling_table(data.frame(beta = 1))), 1)
  beta <- (0:3000) / 1500
  table <- rolling_table(data.frame(beta = beta))
  expect_equal(table$translational_energy_fraction, 1 / (1 + beta))
  expect_equal(table$final_speed_m_per_s, sqrt(2 * 9.80665 / (1 + beta)))
})

test_that("textbook and simulator cases", {
  # Marble on 30 degrees (University Physics 1, section 11.1), sphere on 15 degrees after 1 s (the
  # analytic value of Drake's inclined-plane test).
  expect_equal(rolling_acceleration(0.4, 30, 9.8), 3.5)
  expect_equal(rolling_acceleration(0.4, 15, 9.81), 1.813582023, tolerance = 1e-9)
  # College Physics, section 10.4: solid cylinder, 2.00 m.
  expect_equal(rolling_final_speed(0.5, 2, 9.8), 5.112077203, tolerance = 1e-9)
})

test_that("a speed that is a double is found, whatever its square is", {
  # sqrt(2 1e308^2/(1 + 1e308)) = sqrt(2e308)
  expect_equal(rolling_final_speed(1e308, 1e308, 1e308), 1.4142135623730950e154, tolerance = 1e-15)
  expect_equal(rolling_final_speed(0.5, 1e308, 1e308), 1.1547005383792515e308, tolerance = 1e-15)
  expect_within(rolling_final_speed(0, 1e-300, 1e-300), 1.4142135623730950e-300, 1e-15)
  # The square is 2e-308: a root of a subnormal number would have lost digits.
  expect_within(rolling_final_speed(1e300, 1e-8, 3), sqrt(6) * 1e-154, 1e-15)
  table <- rolling_table(data.frame(beta = c(1e308, 0.5, 1e300)), 30, c(1e308, 1e308, 1e-8),
                         c(1e308, 1e308, 3))
  expect_within(
    table$final_speed_m_per_s, c(1.4142135623730950e154, 1.1547005383792515e308, sqrt(6) * 1e-154),
    1e-15
  )
  expect_warning(
    expect_equal(rolling_final_speed(0, 1.7e308, 1.7e308), Inf), class = "rotdyn_warning_range"
  )
  expect_silent(expect_equal(rolling_final_speed(0, Inf, 1), Inf)) # the limit
})

test_that("bodies and names of shapes roll, too", {
  names <- rolling_table(c("hoop", "disk", "solid_sphere"), 20, 1)
  expect_identical(names$beta, c(1, 0.5, 0.4))
  expect_identical(names$object, c("hoop", "disk", "solid_sphere"))
  expect_identical(rolling_table(c("cylinder", "tube", "spherical_shell"))$beta, c(0.5, 1, 2 / 3))
  pipe <- body_thick_tube(2, 0.05, 0.04, 1)
  both <- rolling_table(list(ball = body_sphere(0.2, 0.05), pipe), 20, 1)
  expect_identical(both$object, c("ball", "thick_tube"))
  # (1 + (0.04/0.05)^2)/2
  expect_equal(both$beta, c(0.4, 0.82), tolerance = 1e-15)
  expect_equal(both$radius_m, c(0.05, 0.05), tolerance = 1e-15)
  expect_equal(both$final_speed_m_per_s, sqrt(2 * 9.80665 / (1 + both$beta)), tolerance = 1e-15)
  expect_identical(rolling_table(body_hoop(1, 1))$beta, 1)
  expect_error(rolling_table("box"), class = "rotdyn_error_value")
  expect_error(rolling_table("hollow_sphere"), "does not depend", class = "rotdyn_error_value")
  expect_error(rolling_table(list(2)), "Element 1", class = "rotdyn_error_type")
  expect_error(rolling_table(body_rod(1, 1)), class = "rotdyn_error_missing")
})

test_that("a number of a function or columns that do not exist are refused", {
  value <- function(which, columns) .Call(rotdyn:::ffi_rolling_value, which, columns)
  expect_identical(value(3L, list(1))$value, 0.5) # beta/(1 + beta)
  for (which in c(0L, 6L)) expect_error(value(which, list(1)), "no such function")
  for (columns in list(1, list(1, 2))) expect_error(value(3L, columns), "of another function")
})

test_that("an angle and a height have no silent default", {
  expect_error(rolling_final_speed(1), class = "rotdyn_error_missing")
  expect_error(rolling_acceleration(1), class = "rotdyn_error_missing")
  # A hoop: v^2 = g h.
  expect_equal(rolling_final_speed(1, 1, gravity_m_per_s2 = 4), 2, tolerance = 1e-15)
})
