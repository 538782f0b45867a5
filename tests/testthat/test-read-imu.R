test_that("Sensor Logger: z before x, nanoseconds beside seconds, no units", {
  d <- spin_samples()
  lines <- c(
    "time,seconds_elapsed,z,y,x",
    paste(format(1.7e18 + round(d$t * 1e9), digits = 19), d$t, d$z, d$y, d$x, sep = ",")
  )
  r <- read_motion(text_file(lines, name = "Gyroscope.csv"), axis = "z")
  expect_equal(r$omega_rad_per_s, d$z)
  expect_equal(r$time_s, d$t)
  expect_match(attr(r, "record")$assumed, "rad/s", all = FALSE)
  other <- text_file(lines, name = "table.csv")
  expect_error(read_motion(other), class = "rotdyn_error_missing")
  expect_equal(read_imu(other, axis = "x", quantity = "rate")$omega_rad_per_s, d$x)
  expect_error(read_imu(other, quantity = "other"), class = "rotdyn_error_file")
})

test_that("NGIMU, xio: degrees, dps, microseconds, stamps", {
  d <- spin_samples()
  lines <- c(
    "Time (s),Gyroscope X (deg/s),Gyroscope Y (deg/s),Gyroscope Z (deg/s),Accelerometer X (g)",
    paste(d$t, d$x, d$y, d$z, 0.1, sep = ",")
  )
  r <- read_motion(text_file(lines), axis = "z")
  expect_equal(r$omega_rad_per_s, d$z * pi / 180)
  lines <- c(
    "Timestamp (us),Gyroscope X (dps),Gyroscope Y (dps),Gyroscope Z (dps)",
    paste(format(1.7e15 + 1e6 * d$t, digits = 17), d$x, d$y, d$z, sep = ",")
  )
  r <- read_motion(text_file(lines), axis = "z")
  expect_equal(r$omega_rad_per_s, d$z * pi / 180)
  expect_equal(r$time_s, d$t, tolerance = 1e-6)
})

test_that("any table: headings of another name, rows a second, an angle", {
  lines <- c("a b", "0 10", "1 20", "2 40")
  r <- read_imu(text_file(lines, ext = ".txt"), headings = c("time (ms)", "theta_deg"))
  expect_equal(r$time_s, c(0, 1e-3, 2e-3))
  expect_equal(r$theta_rad, c(10, 20, 40) * pi / 180)
  r <- read_imu(text_file(c("n,w (rpm)", "1,10", "2,20", "3,30")), rate_hz = 50)
  expect_equal(r$time_s, c(0, 0.02, 0.04))
  expect_equal(r$omega_rad_per_s, c(10, 20, 30) * pi / 30)
  expect_error(read_motion(text_file(c("n,w (rpm)", "1,10", "2,20"))), class = "rotdyn_error_file")
  expect_error(read_motion(text_file(c("1,10", "2,20"))), class = "rotdyn_error_file")
  expect_error(
    read_motion(text_file(c("time,w (rpm)", "1700000000000,10", "1700000000010,20"))),
    class = "rotdyn_error_file"
  )
  expect_error(read_imu(text_file(lines), headings = "t"), class = "rotdyn_error_size")
})

test_that("a log without times names the argument that gives its rate", {
  file <- text_file(c("Packet number,Gyroscope x (deg/s)", paste(1:30, 10 + 1:30, sep = ",")))
  error <- expect_error(read_motion(file), "rate_hz", class = "rotdyn_error_file")
  expect_match(conditionMessage(error), "says a time")
  r <- read_motion(file, rate_hz = 100)
  expect_equal(r$time_s, 0:29 / 100)
  expect_equal(r$omega_rad_per_s, (10 + 1:30) * pi / 180)
})

test_that("the first of the stamps is subtracted in their own unit", {
  ms <- 10 * 0:20
  stamps <- format(1.7e12 + ms, digits = 15)
  file <- text_file(c("timestamp (ms),w (rpm)", paste(stamps, 1:21, sep = ",")))
  expect_identical(read_motion(file)$time_s, ms * 1e-3)
})
