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
