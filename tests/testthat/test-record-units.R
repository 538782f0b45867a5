test_that("headings of instruments give the name, the unit and the factor", {
  heads <- heading_table(c(
    "Time (s)", "Time/s", "AngVel/rad/s", "Gyroscope x (rad/s)", "Gyroscope Y (deg/s)",
    "omega [rpm]", "theta_deg", "omega_rad_per_s", "Angle (\u00b0)", "w (rad s\u207b\u00b9)",
    "w (rad\u00b7s^-1)", "rate (\u00b0/s)", "t (ms)", "x (cm)", "Absolute (rad/s)", "gyroX (dps)",
    "Magnetometer X (uT)", "seconds_elapsed", "label", "Force (lbf)", "a (m/s\u00b2)"
  ))
  expect_equal(heads$kind, c(
    "time", "time", "rate", "rate", "rate", "rate", "angle", "rate", "angle", "rate", "rate",
    "rate", "time", "length", "rate", "rate", "other", "time", NA, "other", "other"
  ))
  deg <- pi / 180
  expect_equal(heads$factor[1:15], c(
    1, 1, 1, 1, deg, pi / 30, deg, 1, deg, 1, 1, deg, 1e-3, 1e-2, 1
  ))
  expect_equal(heads$component[c(4, 5, 14:17)], c("x", "y", "x", "absolute", "x", "x"))
  expect_equal(heads$name[c(1, 3, 4, 7, 9)], c("Time", "AngVel", "Gyroscope x", "theta", "Angle"))
})

test_that("a unit in a name without a slash is a rate where it ends in the second", {
  deg <- pi / 180
  rates <- heading_table(c(
    "gyro_z_rad_s", "wz_deg_s", "yaw_rate_deg_s", "omega_rads", "Gyro Z (degs)", "GyroZ_radps",
    "gyr_z_degps", "omega_rad_per_sec", "w_rev_s", "rpm", "rad/s"
  ))
  expect_identical(rates$kind, rep("rate", 11))
  expect_equal(
    rates$factor, c(1, deg, deg, 1, deg, 1, deg, 1, 2 * pi, pi / 30, 1), tolerance = 1e-15
  )
  expect_identical(rates$component[1:2], c("z", "z"))
  others <- heading_table(c("v_m_s", "a_m_s2", "alpha_rad_s2", "theta_rads", "time_s", "t_max_s",
    "rad", "s", "m"))
  expect_identical(
    others$kind, c("other", "other", "other", "angle", "time", "time", NA, NA, NA)
  )
})

test_that("fine and coarse parts of a rate are thousandths of the unit, and thousands", {
  rates <- heading_table(c("w (mrad/s)", "w (rad/ms)", "w (mdps)", "w (rad/s)"))
  expect_identical(rates$kind, rep("rate", 4))
  expect_equal(rates$factor, c(1e-3, 1e3, pi / 180e3, 1))
})

test_that("clocks of microcontrollers and units in words", {
  heads <- heading_table(c(
    "millis", "micros", "Zeit in ms", "Winkel in rad", "gz_dps", "micros_left", "made in Rome"
  ))
  expect_identical(heads$kind, c("time", "time", "time", "angle", "rate", NA, NA))
  expect_equal(heads$factor[1:5], c(1e-3, 1e-6, 1e-3, 1, pi / 180))
  expect_identical(heads$unit[1:2], c("ms", "us"))
  expect_identical(heads$component[5], "z")
})

test_that("each word of a unit is its multiple of the SI unit", {
  factor <- function(...) vapply(c(...), function(text) rotdyn:::parse_unit(text)$factor, 0)
  same <- function(words, value) expect_equal(unname(factor(words)) / value, rep(1, length(words)))
  same(c("s", "sec", "secs", "second", "seconds"), 1)
  same(c("ms", "msec", "millisecond", "milliseconds"), 1e-3)
  same(c("us", "microseconds"), 1e-6)
  same(c("ns", "nanoseconds"), 1e-9)
  same(c("min", "minutes"), 60)
  same(c("rad", "rads", "radian", "radians"), 1)
  same(c("deg", "degs", "degree", "degrees"), pi / 180)
  same(c("turn", "turns", "rev", "revs", "revolution", "revolutions", "rotation"), 2 * pi)
  same(c("rpm", "rev/min", "r/min"), pi / 30)
  same(c("rps", "rev/s", "turn/s", "turns/s", "revs/s"), 2 * pi)
  same(c("mdps"), pi / 180000)
  same(c("dps", "deg/s", "degrees/second"), pi / 180)
  same(c("km", "cm", "mm", "um", "inch"), c(1e3, 1e-2, 1e-3, 1e-6, 0.0254))
  same(c("mrad/s", "rad/ms"), c(1e-3, 1e3))
  same(c("g", "mg", "m/s2", "deg/s2"), c(9.80665, 9.80665e-3, 1, pi / 180))
  same(c("m/s", "cm/s", "ut", "hpa", "%"), c(1, 1e-2, 1e-6, 100, 1e-2))
})

test_that("what stands in the place of a unit is said, known or not", {
  said <- function(heading) parse_heading(heading)[c("name", "said")]
  expect_identical(said("angle [furlong]"), list(name = "angle", said = "furlong"))
  expect_identical(said("(a) angle (b)"), list(name = "(a) angle", said = "b"))
  expect_identical(said("theta (deg)"), list(name = "theta", said = "deg"))
  expect_null(parse_heading("angle [furlong]")$unit)
  expect_null(said("angle")$said)
})

test_that("inches and feet are lengths, omega_in is the rate of an input", {
  heads <- heading_table(c("x (in)", "x [ft]", "x_ft", "x in in", "y (inches)"))
  expect_identical(heads$kind, rep("length", 5))
  expect_equal(heads$factor, c(0.0254, 0.3048, 0.3048, 0.0254, 0.0254))
  expect_identical(heading_table("omega_in")$kind, NA_character_)
})
