log_file <- function(heading, stamps, separator = ",", values = seq_along(stamps)) {
  file <- tempfile(fileext = ".csv")
  writeLines(c(heading, paste(stamps, values, sep = separator)), file)
  file
}

test_that("times of day in a log are seconds since its first row", {
  tenths <- function(...) paste0(..., 0:5)
  cases <- list(
    list("timestamp,w (rpm)", tenths("2026-03-01T10:11:12."), ","),
    list("timestamp;w (rpm)", tenths("2026-03-01 10:11:12,"), ";"),
    list("Zeit\tw (rpm)", tenths("01.03.2026 10:11:12,"), "\t"),
    list("time w (rpm)", tenths("2026/3/1 10:11:12."), " "),
    list("Time,w (rpm)", tenths("3/1/26 1:11:12."), ","),
    list("Time,w (rpm)", tenths("10:11:12:"), ","),
    list("Time,w (rpm)", paste(tenths("1:11:12."), "pm"), ","),
    list("Date,Time,w (rpm)", tenths("2026-03-01,10:11:12."), ",")
  )
  for (case in cases) {
    if (case[[3]] == " ") case[[1]] <- "time omega_rpm"
    file <- log_file(case[[1]], case[[2]], case[[3]])
    record <- read_motion(file)
    expect_equal(record$time_s, 0:5 / 10, tolerance = 1e-12, info = case[[2]][1])
    expect_equal(record$omega_rad_per_s, 1:6 * pi / 30, info = case[[2]][1])
    unlink(file)
  }
  expect_output(print(record), "times of day: seconds since the first row")
  expect_output(print(record), "time_s from \"Time\"", fixed = TRUE)
})

test_that("days, halves of days and offsets from UTC are R's", {
  at <- as.POSIXct("2024-02-28 22:30:00", tz = "UTC") + c(0, 3599, 5400, 86400 + 1, 2.5 * 86400)
  since <- as.double(at) - as.double(at[1])
  expect_equal(stamp_seconds(format(at, "%Y-%m-%dT%H:%M:%S")), since)
  expect_equal(stamp_seconds(format(at, "%Y-%m-%dT%I:%M:%S%p")), since)
  zones <- c("UTC", "Asia/Kolkata", "America/St_Johns", "Europe/Berlin", "UTC")
  far <- vapply(seq_along(at), function(k) format(at[k], "%Y-%m-%dT%H:%M:%S%z", tz = zones[k]), "")
  expect_equal(stamp_seconds(far), since)
  expect_equal(stamp_seconds(sub("([0-9]{2})$", ":\\1", far)), since)
  # Without a date: noon, midnight, the next day.
  expect_equal(
    stamp_seconds(c("11:59:59AM", "12:00:00PM", "11:59:59PM", "12:00:00AM", "1:00:00AM")),
    c(0, 1, 43200, 43201, 46801)
  )
  # Microseconds of a date are kept, other cells are missing.
  stamps <- c("2026-03-01T23:59:59.999999", "5", "2026-03-02T00:00:00.000001", "24-01-01")
  expect_equal(stamp_seconds(stamps), c(0, NA, 2e-6, NA), tolerance = 1e-9)
  expect_equal(stamp_seconds(c("a", "1")), c(NA_real_, NA))
})

test_that("an arrow of a logging program is a separator, a clock of its own comes first", {
  lines <- sprintf("10:11:12.%d -> %d", 0:5, 6:1)
  file <- tempfile(fileext = ".log")
  writeLines(lines, file)
  expect_error(read_motion(file), "headings", class = "rotdyn_error_file")
  named <- read_motion(file, headings = c("time_ms", "omega_rad_per_s"))
  expect_equal(named$time_s, 0:5 / 10)
  expect_equal(named$omega_rad_per_s, 6:1)
  counted <- read_motion(file, headings = c("clock", "w (rpm)"), rate_hz = 50)
  expect_equal(counted$time_s, 0:5 / 50)
  lines <- sprintf("10:11:12.%d -> %d;%d", 0:5, 0:5, 6:1)
  writeLines(c("10:11:11.900 -> millis;w (rpm)", lines), file)
  own <- read_motion(file)
  expect_equal(own$time_s, 0:5 / 1000)
  expect_equal(own$omega_rad_per_s, 6:1 * pi / 30)
  unlink(file)
})

test_that("date-times of R are times of a record and of a fit", {
  wheel <- scene_axle(2, resistance = resistance(viscous_n_m_s = 0.1), omega0_rad_per_s = 10)
  run <- as.data.frame(trajectory(wheel, 0:20 / 2))[c("time_s", "omega_rad_per_s")]
  dated <- run
  dated$time_s <- as.POSIXct("2026-03-01 23:59:55", tz = "UTC") + run$time_s
  found <- fit_scene(wheel, dated, "omega0_rad_per_s")
  expect_equal(coef(found), coef(fit_scene(wheel, run, "omega0_rad_per_s")))
  expect_equal(motion_record(dated)$time_s, run$time_s)
})

test_that("short dates give the day where they determine the order of day and month", {
  hours <- function(..., heading = "Time,w (rpm)", separator = ",") {
    file <- log_file(heading, c(...), separator)
    on.exit(unlink(file))
    read_motion(file)$time_s / 3600
  }
  expect_equal(hours("30/12/2026 10:00:00", "31/12/2026 11:00:00"), c(0, 25))
  expect_equal(hours("12/30/2026 10:00:00", "12/31/2026 11:00:00"), c(0, 25))
  expect_equal(hours("12/30/26 10:00:00 PM", "1/1/27 1:00:00 AM"), c(0, 27))
  expect_equal(hours("28.02.2024 22:00:00", "01.03.2024 01:00:00"), c(0, 27))
  expect_equal(hours("31/12/2026 23:00:00", "01/01/2027 01:00:00"), c(0, 2))
  # The order does not matter for one day.
  expect_equal(hours("3/1/26 10:00:00", "3/1/26 11:00:00"), c(0, 1))
  expect_equal(
    hours("31/12/2026;23:00:00", "01/01/2027;01:00:00", heading = "Date;Time;w (rpm)",
      separator = ";"), c(0, 2)
  )
  for (dates in list(c("01/03/2026", "02/03/2026"), c("26-12-30", "26-12-31"),
    c("01.03.26", "02.03.26"))) {
    error <- expect_error(
      hours(paste(dates, "10:00:00")), "2026-03-01", class = "rotdyn_error_file"
    )
    expect_match(conditionMessage(error), dates[2], fixed = TRUE)
  }
})

test_that("a column of dates joins the times of day", {
  clock <- c("23:00:00", "23:00:00", "01:00:00", "23:00:00")
  dates <- c("2024-02-28", "2024-02-29", "2024-03-01", "2024-03-01")
  for (lines in list(
    c("Date,Time,w (rpm)", paste(dates, clock, 1:4, sep = ",")),
    c("Time\tw (rpm)\tDate", paste(clock, 1:4, dates, sep = "\t")),
    c("Date;Time;w (rpm)", paste(gsub("-", "/", dates), clock, 1:4, sep = ";"))
  )) {
    file <- tempfile(fileext = ".csv")
    writeLines(lines, file)
    r <- read_motion(file)
    expect_equal(r$time_s, 3600 * c(0, 24, 26, 48), info = lines[1])
    expect_equal(r$omega_rad_per_s, 1:4 * pi / 30)
    expect_true(all(r$segment == 1))
    unlink(file)
  }
  # A logger that writes the date where it changes.
  file <- log_file("Date,Time,w (rpm)", paste(c("2026-03-01", "", "2026-03-05", ""),
    c("22:00:00", "23:00:00", "23:00:00", "01:00:00"), sep = ","))
  expect_equal(read_motion(file)$time_s, 3600 * c(0, 1, 97, 99))
  unlink(file)
})

test_that("a date that does not exist leaves the days of the others, and is reported", {
  days <- sprintf("2026-02-%02d", 10:28)
  stamps <- paste(c(days, "2026-02-30"), "10:00:00")
  for (heading in c("time,w (rpm)", "date,time,w (rpm)")) {
    if (startsWith(heading, "date")) stamps <- sub(" ", ",", stamps)
    file <- log_file(heading, stamps)
    r <- read_motion(file)
    expect_equal(r$time_s, 86400 * 0:18)
    expect_equal(attr(r, "record")$dropped$row, 20)
    expect_match(attr(r, "record")$assumed, "1 cell is no number", all = FALSE)
    unlink(file)
  }
  file <- log_file("time,w (rpm)", paste(c("2026-02-28", "2026-02-30"), "10:00:00"))
  expect_error(read_motion(file), "no number", class = "rotdyn_error_file")
  unlink(file)
  expect_equal(stamp_seconds(c("2026-02-30T10:00:00", "99/99/2026T10:00:00")), c(NA_real_, NA))
})

test_that("dates of unknown order do no harm beside a column of seconds or a known rate", {
  file <- log_file("time,seconds,w (rpm)", c("01/03/2026 10:00:00,0", "02/03/2026 10:00:00,5"))
  expect_equal(read_motion(file)$time_s, c(0, 5))
  unlink(file)
  file <- log_file("time,w (rpm)", c("01/03/2026 10:00:00", "02/03/2026 10:00:00"))
  expect_equal(read_motion(file, rate_hz = 10)$time_s, c(0, 0.1))
  expect_error(read_motion(file), "order of day", class = "rotdyn_error_file")
  unlink(file)
})
