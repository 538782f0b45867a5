test_that("the five dialects give the same numbers", {
  d <- spin_samples()
  for (case in list(c(",", "."), c("\t", "."), c(";", "."), c("\t", ","), c(";", ","))) {
    x <- read_motion(text_file(phyphox_lines(d, case[1], case[2])), axis = "z")
    expect_equal(x$time_s, d$t, tolerance = 1e-9)
    expect_equal(x$omega_rad_per_s, d$z, tolerance = 1e-9)
    expect_match(attr(x, "record")$source, "phyphox")
  }
  # Axes by their headings, in any order.
  lines <- phyphox_lines(d)
  swapped <- vapply(strsplit(lines, ","), function(x) {
    paste(x[c(1, 4, 3, 2, 5)], collapse = ",")
  }, "")
  x <- read_phyphox(text_file(swapped), axis = "z")
  expect_equal(x$omega_rad_per_s, d$z, tolerance = 1e-9)
})

test_that("a zip has the pauses, which the time column has not", {
  d <- spin_samples()
  events <- c(
    "\"event\",\"experiment time\",\"system time\",\"system time text\"",
    "\"START\",0.000000000E0,1759650000.000,\"2025-10-05 10:20:00.000 UTC+02:00\"",
    paste0("\"PAUSE\",", format(d$t[25] + 0.004), ",1759650001.331,\"x\""),
    paste0("\"START\",", format(d$t[25] + 0.004), ",1759650005.512,\"x\""),
    "\"PAUSE\",2.3,1759650006.492,\"x\""
  )
  zip <- zip_file(list(
    "Gyroscope.csv" = phyphox_lines(d), "meta/device.csv" = "\"property\",\"value\"",
    "meta/time.csv" = events
  ))
  x <- read_motion(zip, axis = "z")
  expect_equal(x$segment, rep(1:2, c(25, 35)))
  expect_match(attr(x, "record")$breaks$why, "pause")
  expect_length(attr(x, "record")$assumed, 0)
  # Five hours on, the last sample before a pause is closer to it by 2e-7 of the time.
  d$t <- d$t + 20000
  number <- function(x) formatC(x, format = "f", digits = 3)
  events[2:5] <- c(
    paste0("\"START\",", number(d$t[1]), ",1759650000.000,\"x\""),
    paste0("\"PAUSE\",", number(d$t[25] + 0.004), ",1759650001.331,\"x\""),
    paste0("\"START\",", number(d$t[25] + 0.004), ",1759650005.512,\"x\""),
    "\"PAUSE\",20002.3,1759650006.492,\"x\""
  )
  late <- zip_file(list("Gyroscope.csv" = phyphox_lines(d), "meta/time.csv" = events))
  expect_equal(read_motion(late, axis = "z")$segment, rep(1:2, c(25, 35)))
  # Without pauses there is one segment; a sheet without rotation is passed over.
  acc <- gsub("Gyroscope", "Acceleration", gsub("rad/s", "m/s^2", phyphox_lines(d)))
  zip <- zip_file(list(
    "Accelerometer.csv" = acc, "Gyroscope.csv" = phyphox_lines(d),
    "meta/time.csv" = events[c(1, 2, 5)]
  ))
  expect_equal(max(read_phyphox(zip)$segment), 1)
  expect_equal(nrow(read_phyphox(zip, sheet = "Gyroscope")), 60)
  expect_error(read_phyphox(zip, sheet = "Accelerometer"), class = "rotdyn_error_file")
  expect_error(read_phyphox(zip, sheet = "none"), class = "rotdyn_error_value")
})

test_that("the Excel export is equal to its CSV", {
  skip_if_not_installed("readxl")
  csv <- read_motion(shared("data", "measured", "phyphox_roller_spinup_z_acc.csv"), axis = "z")
  xls <- read_motion(shared("data", "measured", "phyphox_roller_spinup_z_acc.xls"), axis = "z")
  # The CSV has ten digits.
  expect_lt(max(abs(csv$omega_rad_per_s - xls$omega_rad_per_s) / abs(csv$omega_rad_per_s)), 1e-9)
  expect_equal(csv$time_s, xls$time_s, tolerance = 1e-9)
  want <- utils::read.csv(shared("data", "measured", "phyphox_roller_spinup_z_acc.csv"))
  expect_identical(csv$omega_rad_per_s, want[[4]])
})

test_that("the pauses of an Excel export are in its sheet of times", {
  sheets <- list(
    "Raw Data" = data.frame(
      "Time (s)" = c("0", "0.5", "2"), "Gyroscope z (rad/s)" = c("1", "2", ""), check.names = FALSE
    ),
    "Metadata Device" = data.frame(property = "version", value = "1.1"),
    "Metadata Time" = data.frame(event = c("START", "PAUSE", "START"), time = c("0", "0.7", "0.7"))
  )
  got <- phyphox_sheets(sheets)
  expect_named(got$data, "Raw Data")
  expect_equal(got$data[[1]]$columns, list(c(0, 0.5, 2), c(1, 2, NA)))
  expect_equal(got$data[[1]]$odd, c(0, 0))
  expect_equal(phyphox_pauses(got$time), 0.7)
})

test_that("a motion about no fixed axis is read with the rates about all", {
  file <- tempfile(fileext = ".csv")
  write <- function(x, y, z) {
    time <- 0:(length(x) - 1) / 100
    writeLines(c(
      "\"Time (s)\",\"Gyroscope x (rad/s)\",\"Gyroscope y (rad/s)\",\"Gyroscope z (rad/s)\"",
      paste(time, x, y, z, sep = ",")
    ), file)
  }
  angle <- 0:20 / 5
  write(3 * cos(angle), 3 * sin(angle), 1 + 0 * angle)
  record <- read_motion(file)
  expect_equal(record$omega_x_rad_per_s, 3 * cos(angle))
  expect_equal(record$omega_z_rad_per_s, rep(1, 21))
  expect_match(attr(record, "record")$assumed, "no fixed axis: the rates about all", all = FALSE)
  expect_error(read_phyphox(file, axis = "principal"), class = "rotdyn_error_value")
  expect_named(read_phyphox(file, axis = "y"), c("time_s", "omega_rad_per_s", "segment"))
  # Nine parts in ten of the mean square about one axis are a rotation about it.
  write(0.1 * cos(angle), 0.1 * sin(angle), 3 + 0 * angle)
  expect_equal(attr(read_motion(file), "record")$axis$name, "principal")
  expect_named(read_motion(file, axis = "all"), names(record))
  unlink(file)
})
