info_of <- function(x) attr(x, "record")

test_that("columns by name, by expression, and by their headings, in any unit", {
  d <- data.frame(t = 0:10 / 10, a = 0:10, check.names = FALSE)
  want <- 0:10 * pi / 180
  got <- list(
    motion_record(d, time_s = "t", theta_deg = "a"),
    motion_record(d, time_s = t, theta_deg = a),
    motion_record(d, time_s = d$t, theta_rad = a * pi / 180),
    motion_record(stats::setNames(d, c("Time (s)", "Angle (deg)"))),
    motion_record(stats::setNames(d, c("t (s)", "Angle (deg)")),
      time_s = "t (s)", theta_rad = "Angle (deg)"),
    motion_record(data.frame(time_s = d$t, theta_deg = d$a)),
    motion_record(transform(d, t = 1000 * t), time_s = t / 1000, theta_turns = a / 360),
    motion_record(stats::setNames(transform(d, t = 1000 * t), c("t (ms)", "b")),
      time_s = "t (ms)", counts = b, counts_per_turn = 360)
  )
  for (x in got) {
    expect_s3_class(x, "rot_record")
    expect_equal(x$time_s, d$t)
    expect_equal(x$theta_rad, want)
    expect_identical(x$segment, rep(1L, 11))
  }
  rate <- motion_record(d, time_s = t, omega_rpm = a)
  expect_equal(rate$omega_rad_per_s, 0:10 * 2 * pi / 60)
  rate <- motion_record(d, time_s = t, omega_deg_per_s = a)
  expect_equal(rate$omega_rad_per_s, want)
  expect_error(motion_record(stats::setNames(d, c("t", "w (rad/s)")), time_s = t,
    theta_rad = "w (rad/s)"), class = "rotdyn_error_unit")
  expect_error(motion_record(stats::setNames(d, c("t", "w (rad)")), time_s = t,
    theta_deg = "w (rad)"), class = "rotdyn_error_unit")
})

test_that("units objects, difftimes and date-times", {
  d <- data.frame(t = 0:10, a = 0:10)
  d$t <- as.difftime(d$t, units = "mins")
  expect_equal(motion_record(d, time_s = t, theta_rad = a)$time_s, 60 * 0:10)
  d$t <- as.POSIXct("2024-01-01 10:00:00", tz = "UTC") + 0:10 / 4
  expect_equal(motion_record(d, time_s = t, theta_rad = a)$time_s, 0:10 / 4, tolerance = 1e-6)
  skip_if_not_installed("units")
  d$t <- units::set_units(1000 * 0:10, "ms")
  d$a <- units::set_units(0:10, "degree")
  x <- motion_record(d, time_s = t, theta_rad = a)
  expect_equal(x$time_s, 0:10)
  expect_equal(x$theta_rad, 0:10 * pi / 180)
  d$a <- units::set_units(0:10, "degree/s")
  expect_equal(motion_record(d, time_s = t, omega_rad_per_s = a)$omega_rad_per_s, 0:10 * pi / 180)
  expect_error(motion_record(d, time_s = t, theta_rad = a), class = "rotdyn_error_unit")
})

test_that("pulses: one number is the pulses a turn, a column their running number", {
  d <- data.frame(t = c(0, 0.1, 0.3, 0.6), k = c(0, 2, 4, 6))
  one <- motion_record(d, time_s = t, pulses = 4)
  expect_equal(one$pulses, 0:3)
  expect_equal(info_of(one)$pulses_per_turn, 4)
  column <- motion_record(d, time_s = t, pulses = k, pulses_per_turn = 3)
  expect_equal(column$pulses, d$k)
  expect_equal(info_of(column)$pulses_per_turn, 3)
  expect_equal(info_of(motion_record(d, time_s = t, pulses = k))$pulses_per_turn, 1)
})

test_that("wrapped angles are unwrapped against the predicted angle; more is refused", {
  t <- 0:100 / 10
  for (rate in c(3, -3)) {
    a <- (rate * t + 0.4 * t^2 * sign(rate))
    low <- (a + pi) %% (2 * pi) - pi
    x <- motion_record(data.frame(t, low), time_s = t, theta_rad = low)
    expect_equal(x$theta_rad - x$theta_rad[1], a - a[1], tolerance = 1e-12)
    expect_match(info_of(x)$assumed, "unwrapped", all = FALSE)
    x <- motion_record(data.frame(t, d = 180 / pi * (a %% (2 * pi))), time_s = t, theta_deg = d)
    expect_equal(x$theta_rad - x$theta_rad[1], a - a[1], tolerance = 1e-12)
  }
  # From rest to 50 rad/s: steps of up to 5 rad.
  a <- 2.5 * t^2
  w <- a %% (2 * pi)
  expect_error(motion_record(data.frame(t, w), time_s = t, theta_rad = w),
    class = "rotdyn_error_value")
  x <- motion_record(data.frame(t, w, v = 5 * t), time_s = t, theta_rad = w, omega_rad_per_s = v)
  expect_equal(x$theta_rad, a, tolerance = 1e-12)
  # A running angle is kept as it is.
  x <- motion_record(data.frame(t, a), time_s = t, theta_rad = a)
  expect_identical(x$theta_rad, a)
})

test_that("rows: missing, copied, equal times, times that go back", {
  d <- data.frame(
    t = c(0, 1, 1, NA, 2, 3, 3, 4, 5, 0, 1, 2), a = c(1, 2, 2, 9, NA, 3, 7, 8, 9, 4, 5, 6)
  )
  long <- rbind(d, data.frame(t = 3:120, a = 7:124))
  x <- motion_record(long, time_s = t, theta_rad = a / 100)
  expect_equal(info_of(x)$dropped$row, c(3, 4, 5))
  expect_equal(info_of(x)$dropped$why, c("copy of the row before", "no time", "no value"))
  expect_equal(info_of(x)$breaks$segment, c(2, 3))
  expect_match(info_of(x)$breaks$why, "pause|goes back")
  expect_equal(x$segment, rep(1:3, c(3, 3, 121)))
  # Equal times in a tenth of the rows: a coarse clock.
  d <- data.frame(t = c(rep(1:10, each = 2), 11:90), a = c(1:20, 21:100))
  x <- motion_record(d, time_s = t, theta_rad = a)
  expect_equal(x$theta_rad[1:11], c(seq(1.5, 19.5, 2), 21))
  expect_equal(max(x$segment), 1)
  expect_equal(nrow(info_of(x)$dropped), 10)
  # Runs by a column, rows in any order of runs.
  d <- data.frame(t = c(0, 0, 1, 1, 2), a = 1:5, run = c("b", "a", "b", "a", "b"))
  x <- motion_record(d, time_s = t, theta_rad = a, segment = run)
  expect_equal(x$theta_rad, c(1, 3, 5, 2, 4))
  expect_equal(x$segment, c(1, 1, 1, 2, 2))
})

test_that("resolution: encoders, floors, few digits, none", {
  set.seed(1)
  t <- 0:400 / 50
  a <- 3 * sin(t) + 0.2 * t
  quantum <- 2 * pi / 2400
  x <- motion_record(data.frame(t, a = quantum * round(a / quantum)), time_s = t, theta_rad = a)
  expect_equal(2 * pi / info_of(x)$resolution[["theta_rad"]], 2400, tolerance = 1e-9)
  x <- motion_record(data.frame(t, a = round(a, 3)), time_s = t, theta_rad = a)
  expect_equal(info_of(x)$resolution[["theta_rad"]], 1e-3, tolerance = 1e-9)
  x <- motion_record(data.frame(t, a), time_s = t, theta_rad = a)
  expect_true(is.na(info_of(x)$resolution[["theta_rad"]]))
  n <- floor(a / quantum)
  x <- motion_record(data.frame(t, n), time_s = t, counts = n, counts_per_turn = 2400, floor = TRUE)
  expect_lte(max(abs(x$theta_rad - a)), quantum / 2 * (1 + 1e-12))
  expect_equal(info_of(x)$resolution[["theta_rad"]], quantum)
  expect_error(motion_record(data.frame(t, n), time_s = t, counts = n),
    class = "rotdyn_error_missing")
  # Half of it at rest.
  x <- motion_record(
    data.frame(t, a = c(rep(0, 200), round(a[1:201], 2))), time_s = t, theta_rad = a
  )
  expect_equal(info_of(x)$resolution[["theta_rad"]], 1e-2, tolerance = 1e-9)
})

test_that("a counter that moves by many counts between samples has its resolution", {
  quantum <- 2 * pi / 2400
  n <- 0:200
  for (counts in c(13, 14.3, 20, 25.4, 200)) {
    for (turned in list(counts * n * (1 + 3e-4 * n), 50 * counts * sin(n / 50))) {
      found <- rotdyn:::find_resolution(quantum * round(turned), rep(1, 201))
      expect_equal(found, quantum, tolerance = 1e-9)
    }
  }
  # A steady rate with noise of some percent of what it turns between samples is no counter.
  set.seed(1)
  expect_identical(rotdyn:::find_resolution(0.1 * n + rnorm(201, 0, 1e-3), rep(1, 201)), NA_real_)
})

test_that("rates about three axes: one by name, the principal one, and its refusal", {
  t <- 0:200 / 100
  w <- 5 * exp(-t)
  d <- data.frame(t, gx = 0.1 * w, gy = -0.98 * w, gz = 0.05 * w)
  x <- motion_record(d, time_s = t, omega_rad_per_s = c("gx", "gy", "gz"), axis = "gy")
  expect_equal(x$omega_rad_per_s, d$gy)
  p <- motion_record(d, time_s = t, omega_rad_per_s = cbind(gx, gy, gz), axis = "principal")
  expect_equal(abs(p$omega_rad_per_s), w * sqrt(0.1^2 + 0.98^2 + 0.05^2))
  expect_lt(info_of(p)$axis$across, 1e-12)
  expect_error(motion_record(d, time_s = t, omega_rad_per_s = c("gx", "gy", "gz")),
    class = "rotdyn_error_missing")
  x <- motion_record(d, time_s = t, omega_rad_per_s = c("gx", "gy", "gz"), axis = "gx")
  expect_equal(x$omega_rad_per_s, d$gx)
  expect_gt(info_of(x)$axis$across, 0.9)
  # Precession: two axes with an eighth of the mean square across.
  d$gx <- sqrt(1 / 7) * w * sin(40 * t) * sqrt(2)
  d$gy <- w
  d$gz <- 0
  expect_error(
    motion_record(d, time_s = t, omega_rad_per_s = c("gx", "gy", "gz"), axis = "principal"),
    class = "rotdyn_error_value"
  )
})

test_that("marks: centre fitted, given, tracked; a line is refused", {
  t <- 0:60 / 30
  a <- 2.5 + 4 * t + t^2
  d <- data.frame(
    t, x = 0.03 + 0.2 * cos(a), y = -0.4 + 0.2 * sin(a), cx = 0.03 + 0 * t, cy = -0.4, nx = t
  )
  fitted <- motion_record(d, time_s = t, x_m = x, y_m = y)
  given <- motion_record(d, time_s = t, x_m = x, y_m = y, centre_m = c(0.03, -0.4))
  tracked <- motion_record(d, time_s = t, x_m = x, y_m = y, centre_m = c("cx", "cy"))
  for (got in list(fitted, given, tracked)) {
    expect_equal(diff(got$theta_rad), diff(a), tolerance = 1e-10)
  }
  centre <- info_of(fitted)$centre
  expect_equal(c(centre$x_m, centre$y_m, centre$radius_m), c(0.03, -0.4, 0.2), tolerance = 1e-12)
  expect_error(motion_record(d, time_s = t, x_m = t, y_m = nx), class = "rotdyn_error_value")
  for (bend in c(0, 1e-12, 1e-9, 1e-7, 1e-5)) {
    d$bent <- 0.3 * d$t + bend * d$t^2
    expect_error(
      motion_record(d, time_s = t, x_m = t, y_m = bent), "on a line", class = "rotdyn_error_value"
    )
  }
  expect_error(motion_record(d, time_s = t, y_m = x), class = "rotdyn_error_missing")
  # With noise the fit's own standard errors hold: 200 fits, the centre within 1.96 of them.
  set.seed(5)
  inside <- replicate(200, {
    fit <- fit_circle(d$x + stats::rnorm(61, 0, 1e-3), d$y + stats::rnorm(61, 0, 1e-3))
    abs(c(fit$x_m - 0.03, fit$y_m + 0.4, fit$radius_m - 0.2)) < 2 * fit$u_m
  })
  expect_gt(mean(inside), 0.92)
  expect_lt(mean(inside), 0.98)
})

test_that("what was read and assumed is printed", {
  d <- data.frame(t = c(0:40 / 10, NA), a = c(round(30 * sin(0:40 / 10)), 1))
  text <- cli::ansi_strip(paste(tibble::tbl_sum(motion_record(d, time_s = t, theta_deg = a)),
    collapse = "\n"))
  for (word in c("degree", "spacing 0.1 s", "360 counts a turn", "no time: 1")) {
    expect_match(text, word, fixed = TRUE)
  }
})

test_that("the class survives verbs on rows and columns, and goes with what it needs", {
  d <- data.frame(t = 0:10, a = 1:11)
  x <- motion_record(d, time_s = t, theta_rad = a)
  expect_s3_class(x[3:5, ], "rot_record")
  expect_false(inherits(x["time_s"], "rot_record"))
  y <- x
  y$note <- "a"
  expect_s3_class(y, "rot_record")
  y$segment <- NULL
  expect_false(inherits(y, "rot_record"))
  expect_null(attr(y, "record"))
  expect_false(inherits(tibble::as_tibble(x), "rot_record"))
  skip_if_not_installed("dplyr")
  expect_s3_class(dplyr::mutate(dplyr::filter(x, time_s > 3), b = 1), "rot_record")
  expect_false(inherits(dplyr::select(x, time_s), "rot_record"))
  expect_equal(info_of(dplyr::filter(x, time_s > 3)), info_of(x))
})

test_that("errors are the package's own", {
  d <- data.frame(t = 0:10, a = 1:11, text = letters[1:11], a2 = 1)
  expect_error(motion_record(1), class = "rotdyn_error_type")
  expect_error(motion_record(d), class = "rotdyn_error_missing")
  expect_error(motion_record(d, time_s = t), class = "rotdyn_error_missing")
  expect_error(motion_record(d, theta_rad = a), class = "rotdyn_error_missing")
  expect_error(motion_record(d, time_s = "u", theta_rad = a), class = "rotdyn_error_argument")
  expect_error(motion_record(d, time_s = t, theta_rad = b), class = "rotdyn_error_argument")
  expect_error(motion_record(d, time_s = t, theta_rad = text), class = "rotdyn_error_type")
  expect_error(motion_record(d, time_s = t, theta_rad = "text"), class = "rotdyn_error_type")
  expect_error(motion_record(d, time_s = t, theta_rad = 1:3), class = "rotdyn_error_size")
  expect_error(motion_record(d, time_s = t, theta_rad = a, theta_deg = a),
    class = "rotdyn_error_argument")
  expect_error(motion_record(d, time_s = t, theta_rad = a / 0), class = "rotdyn_error_value")
  expect_error(motion_record(d[1, ], time_s = t, theta_rad = a), class = "rotdyn_error_size")
  expect_error(motion_record(d, time_s = t, omega = a, unknown = 3),
    class = "rotdyn_error_argument")
})

test_that("the records of real instruments", {
  read <- function(name) utils::read.csv(shared("data", "measured", name), check.names = FALSE)
  pendulum <- motion_record(read("pend00-run02.csv"))
  expect_equal(2 * pi / info_of(pendulum)$resolution[["theta_rad"]], 2400, tolerance = 1e-6)
  wheel <- read("ngimu_wheelchair_coastdown_right.csv")
  x <- motion_record(wheel, axis = "y")
  expect_equal(x$omega_rad_per_s, wheel[["Gyroscope Y (deg/s)"]] * pi / 180)
  precessing <- read("phyphox_roller_spin_and_precession_z_cir.csv")
  expect_error(motion_record(precessing, axis = "principal"), class = "rotdyn_error_value")
  expect_gt(info_of(motion_record(precessing, axis = "z"))$axis$across, 0.1)
})

test_that("an angle far from the predicted one is said", {
  t <- 0:60 / 30
  a <- 1.2 * sin(4 * t) + ifelse(t > 1, 2.4, 0) + 2
  w <- (a + 1.2) %% (2 * pi)
  x <- motion_record(data.frame(t, w = ifelse(t < 0.1, 6.2, w)), time_s = t, theta_rad = w)
  expect_match(info_of(x)$assumed, "quarter turn", all = FALSE)
})

test_that("a table without columns is no column", {
  data <- data.frame(t = 0:9, theta = 0:9)
  for (none in list(data.frame(), matrix(0, 10, 0))) {
    expect_error(motion_record(data, !!none, theta), class = "rotdyn_error_size")
  }
})

test_that("a table without headings is refused, whoever reads it", {
  bare <- data.frame(1:30 / 10, sin(1:30))
  part <- bare
  names(bare) <- NULL
  names(part) <- c("time_s", NA)
  for (data in list(bare, part)) {
    error <- expect_error(motion_record(data), "a name for each", class = "rotdyn_error_missing")
    expect_identical(error$call[[1]], quote(motion_record))
    error <- expect_error(estimate_motion(data), class = "rotdyn_error_missing")
    expect_identical(error$call[[1]], quote(estimate_motion))
  }
  expect_error(motion_record(bare, time_s = 1:30, theta_rad = 1:30), "It has none",
    class = "rotdyn_error_missing"
  )
})

test_that("the step of a counter is found far from its zero", {
  counts <- c(0, 1, 1, 2, 3, 5, 6, 7, 9, 10, 11, 12, 14)
  found <- rotdyn:::find_resolution(1e9 + 1e-3 * counts, rep(1, length(counts)))
  expect_equal(found, 1e-3, tolerance = 1e-3)
  expect_identical(rotdyn:::find_resolution(1e9 + 1e-6 * counts, rep(1, 13)), NA_real_)
})

test_that("the rates about all axes are columns of their own", {
  rates <- cbind(gz = c(3, 1, 2), gx = c(4, 5, 6), gy = c(7, 9, 8))
  d <- data.frame(t = 0:2, rates)
  record <- motion_record(d, time_s = t, omega_deg_per_s = c("gz", "gx", "gy"), axis = "all")
  expect_s3_class(record, "rot_record")
  expect_named(record, c(
    "time_s", "omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s", "segment"
  ))
  expect_equal(record$omega_x_rad_per_s, c(4, 5, 6) * pi / 180)
  expect_equal(record$omega_z_rad_per_s, c(3, 1, 2) * pi / 180)
  expect_equal(attr(record, "record")$columns$heading, c("t", "gx", "gy", "gz"))
  expect_null(attr(record, "record")$axis)
  expect_output(print(record), "omega_y_rad_per_s from \"gy\"")
  expect_s3_class(record[1:2, ], "rot_record")
  # Verbs about one axis say how to get it.
  expect_error(estimate_motion(record), "principal", class = "rotdyn_error_missing")
  expect_error(fit_coast_down(record), "principal", class = "rotdyn_error_missing")
  expect_error(fit_swing(record), "principal", class = "rotdyn_error_missing")
  expect_error(
    motion_record(d, time_s = t, omega_rad_per_s = gx, axis = "all"), "several axes",
    class = "rotdyn_error_argument"
  )
  expect_error(
    motion_record(d, time_s = t, omega_rad_per_s = cbind(gx, gx), axis = "all"),
    "one column for each axis", class = "rotdyn_error_argument"
  )
  skip_if_not_installed("ggplot2")
  plot <- ggplot2::autoplot(record)
  expect_identical(levels(plot$data$panel), paste0("rate about ", c("x", "y", "z"), " (rad/s)"))
})

test_that("positions along a line are a record for a fit", {
  lane <- scene_incline(body_sphere(6, 0.108), 0, static_friction = 0.12, v0_m_per_s = 8,
    omega0_rad_per_s = 0)
  film <- as.data.frame(trajectory(lane, 0:40 / 20))[c("time_s", "x_m", "theta_rad")]
  sheet <- data.frame("t (s)" = film$time_s, "x (cm)" = 100 * film$x_m, check.names = FALSE)
  record <- motion_record(sheet)
  expect_named(record, c("time_s", "x_m", "segment"))
  expect_equal(record$x_m, film$x_m)
  file <- tempfile(fileext = ".csv")
  utils::write.csv(sheet, file, row.names = FALSE)
  expect_equal(read_motion(file)$x_m, film$x_m)
  # Tracker's export of one coordinate.
  writeLines(c("ball", "t,x", paste(film$time_s, film$x_m, sep = ",")), file)
  expect_equal(read_tracker(file)$x_m, film$x_m)
  fit <- fit_scene(lane, record, c("static_friction", "v0_m_per_s"))
  expect_equal(fit$value, c(0.12, 8), tolerance = 1e-6)
  expect_error(estimate_motion(record), "centre", class = "rotdyn_error_missing")
  expect_error(
    motion_record(film, time_s = time_s, y_m = x_m), "along a line", class = "rotdyn_error_missing"
  )
  # Beside an angle it is named as not read.
  sheet[["theta (rad)"]] <- film$theta_rad
  utils::write.csv(sheet, file, row.names = FALSE)
  both <- read_motion(file)
  expect_named(both, c("time_s", "theta_rad", "segment"))
  expect_match(attr(both, "record")$assumed, "not used beside the rotation: \"x", all = FALSE)
  unlink(file)
})

test_that("a wrapped angle on a coarse clock is unwrapped before the mean", {
  t <- rep(0:200 / 100, each = 2)
  for (sign in c(1, -1)) {
    degrees <- sign * 3.7 * seq_along(t)
    d <- data.frame(t, th = degrees %% 360)
    x <- motion_record(d, time_s = t, theta_deg = th)
    expect_equal(diff(x$theta_rad), rep(sign * 7.4 * pi / 180, 200), tolerance = 1e-10)
    expect_match(info_of(x)$assumed, "unwrapped", all = FALSE)
    expect_match(info_of(x)$assumed, "equal times", all = FALSE)
  }
  # 100 degrees a row: 200 between two times of the clock.
  d$th <- (100 * seq_along(t)) %% 360
  x <- motion_record(d, time_s = t, theta_deg = th)
  expect_equal(diff(x$theta_rad), rep(200 * pi / 180, 200), tolerance = 1e-10)
  # 200 degrees a row, resolved by the rate.
  d$th <- (200 * seq_along(t)) %% 360
  d$rate <- 200 / 0.005
  x <- motion_record(d, time_s = t, theta_deg = th, omega_deg_per_s = rate)
  expect_equal(diff(x$theta_rad), rep(400 * pi / 180, 200), tolerance = 1e-10)
  # A mark: the angle of each row.
  a <- 3.7 * pi / 180 * seq_along(t)
  d <- data.frame(t, x = cos(a), y = sin(a))
  x <- motion_record(d, time_s = t, x_m = x, y_m = y)
  expect_equal(info_of(x)$centre$radius_m, 1, tolerance = 1e-12)
  expect_equal(diff(x$theta_rad), rep(7.4 * pi / 180, 200), tolerance = 1e-10)
  # Groups of different sizes, two runs.
  t <- c(0, 0, 1, 1, 1, 2, 2, 3, 0, 1, 1, 2, 2)
  run <- rep(1:2, c(8, 5))
  a <- 2.5 * seq_along(t)
  x <- motion_record(data.frame(t, a = a %% (2 * pi), run), time_s = t, theta_rad = a,
    segment = run)
  mean <- c(1.5, 4, 6.5, 8, 9, 10.5, 12.5) * 2.5
  expect_equal(tapply(x$theta_rad - mean, x$segment, function(e) diff(range(e))), c(0, 0),
    tolerance = 1e-10, ignore_attr = TRUE)
})

test_that("a wrap in a gap of the angle is found by the measured rate", {
  t <- 0:120 / 20
  hidden <- function(a, rows) replace(a %% (2 * pi), rows, NA)
  wrap <- which(diff((2 * t) %% (2 * pi)) < 0)
  x <- motion_record(
    data.frame(time_s = t, theta_rad = hidden(2 * t, c(wrap, wrap + 1)), omega_rad_per_s = 2)
  )
  expect_equal(x$theta_rad, replace(2 * t, c(wrap, wrap + 1), NA))
  expect_match(info_of(x)$assumed, "unwrapped", all = FALSE)
  # More than a turn is hidden, the rate changes.
  a <- 2 * t + t^2 / 2
  x <- motion_record(
    data.frame(time_s = t, theta_rad = hidden(a, 30:80), omega_rad_per_s = 2 + t)
  )
  expect_equal(x$theta_rad, replace(a, 30:80, NA))
  expect_match(info_of(x)$assumed, "turns in 1 gap of .* measured rate", all = FALSE)
  # A rate that is missing in the gap, too, is not interpolated: the swing has no wrap.
  a <- 1 + 0.9 * sin(2 * pi * t / 2)
  d <- data.frame(time_s = t, theta_rad = a, omega_rad_per_s = 0.9 * pi * cos(pi * t), x_m = 0)
  d[41:81, 2:3] <- NA
  x <- motion_record(d, time_s = time_s, theta_rad = theta_rad, omega_rad_per_s = omega_rad_per_s,
    x_m = x_m)
  expect_identical(x$theta_rad, d$theta_rad)
  # Angle and rate in alternate rows.
  d <- data.frame(time_s = t, theta_rad = (2 * t) %% (2 * pi), omega_rad_per_s = 2)
  d$theta_rad[c(FALSE, TRUE)] <- NA
  d$omega_rad_per_s[c(TRUE, FALSE)] <- NA
  x <- motion_record(d)
  expect_equal(x$theta_rad[c(TRUE, FALSE)], (2 * t)[c(TRUE, FALSE)])
})

test_that("without a rate the angle's own rate before and after a gap decides, or nothing does", {
  t <- 0:120 / 20
  # Rows that have a pulse have no gap in the record where the angle is missing.
  record <- function(a, rows) {
    d <- data.frame(t, a = replace(a, rows, NA), k = seq_along(t))
    motion_record(d, time_s = t, theta_rad = a, pulses = k)
  }
  wrap <- which(diff((2 * t) %% (2 * pi)) < 0)
  x <- record((2 * t) %% (2 * pi), c(wrap, wrap + 1))
  expect_equal(x$theta_rad, replace(2 * t, c(wrap, wrap + 1), NA))
  expect_match(info_of(x)$assumed, "unwrapped", all = FALSE)
  # Four radians in a gap, and wraps elsewhere.
  for (sign in c(1, -1)) {
    x <- record((sign * 4 * t) %% (2 * pi), 50:69)
    got <- x$theta_rad - x$theta_rad[1]
    expect_equal(got, replace(sign * 4 * t, 50:69, NA))
    expect_match(info_of(x)$assumed, "turns in 1 gap of .* before and after it", all = FALSE)
  }
  # Two different rates: nothing is added, and it is said.
  a <- ifelse(t < 2, t, 6.2 - (6 - t) / 10)
  x <- record(a, 41:50)
  expect_identical(x$theta_rad, replace(a, 41:50, NA))
  expect_match(info_of(x)$assumed, "undetermined", all = FALSE)
  # Swings within one turn stay, wherever the gap is.
  for (amplitude in c(1, 1.5, 3)) {
    for (first in 1:60) {
      for (length in c(5, 10, 20, 40)) {
        a <- amplitude * sin(2 * pi * t / 1.5)
        rows <- first + seq_len(length)
        expect_identical(record(a, rows)$theta_rad, replace(a, rows, NA))
      }
    }
  }
})

test_that("stamps in ms since 1970 keep their digits: seconds are counted from the first", {
  stamps <- 1.6e12 + cumsum(c(0, 7, 8, 7, 9, 10))
  for (a in list(stamps, c(NA, stamps))) {
    data <- data.frame(a = a, theta = seq_along(a))
    names(data)[1] <- "t (ms)"
    record <- motion_record(data, time_s = "t (ms)", theta_rad = theta)
    expect_equal(record$time_s, c(0, 7, 15, 22, 31, 41) / 1000, tolerance = 1e-15)
    expect_output(print(record), "(ms since the first)", fixed = TRUE)
  }
  # Stamps that seconds do not round, and seconds themselves, stay.
  data[[1]] <- c(NA, 1e6 + 0:5)
  expect_equal(motion_record(data, time_s = "t (ms)", theta_rad = theta)$time_s, 1000 + 0:5 / 1000)
  expect_equal(motion_record(data.frame(t = 1.6e9 + 0:5, b = 1:6), t, b)$time_s, 1.6e9 + 0:5)
})

test_that("a step is measured where its rate is, up to the time at which a hole begins", {
  found <- integrate_rate(c(0, 1, 2, 5, 6), rep(1, 5), c(0.5, 1.5, 2, 2.5, 5.5, 6))
  expect_equal(found$advance, c(NA, 1, 0.5, 0.5, 3, 0.5))
  expect_identical(found$measured, c(FALSE, TRUE, TRUE, FALSE, FALSE, TRUE))
})

test_that("an angle is one column, and a heading that of one", {
  data <- data.frame(time_s = 0:3)
  data$theta_rad <- cbind(0:3, 1:4)
  expect_error(motion_record(data), "table of 2 columns", class = "rotdyn_error_size")
  data$theta_rad <- matrix(c(0, 1, 3, 6))
  expect_identical(motion_record(data)$theta_rad, c(0, 1, 3, 6))
  data <- data.frame(time_s = 0:3, theta_rad = 0:3, theta_rad = 4:1, check.names = FALSE)
  expect_error(motion_record(data), "2 columns `?theta_rad", class = "rotdyn_error_value")
  expect_error(motion_record(data.frame()), "There are no columns", class = "rotdyn_error_missing")
})

test_that("a column that is named NA is no column", {
  data <- data.frame(time_s = 1:3, theta_rad = 1:3)
  expect_error(
    motion_record(data, omega_rpm = NA_character_), "no column", class = "rotdyn_error_argument"
  )
})
