test_that("exported text: positions, names of tracks above, angles ask for their unit", {
  t <- 0:40 / 30
  a <- 2.8 + 3 * t
  x <- 0.05 + 0.2 * cos(a)
  y <- 0.2 * sin(a)
  lines <- c("masa A", "t\tx\ty", paste(t, x, y, sep = "\t"))
  r <- read_motion(text_file(lines, ext = ".txt"))
  expect_equal(diff(r$theta_rad), diff(a), tolerance = 1e-6)
  expect_equal(attr(r, "record")$centre$radius_m, 0.2, tolerance = 1e-6)
  comma <- gsub(".", ",", lines, fixed = TRUE)
  expect_equal(read_tracker(text_file(comma, ext = ".txt"))$x_m, x, tolerance = 1e-9)
  # A video at 240 frames a second, played at 30.
  fast <- read_tracker(text_file(lines, ext = ".txt"), frame_rate_hz = 240)
  expect_equal(fast$time_s, t / 8, tolerance = 1e-6)
  angles <- text_file(c("masa A", "t\t\u03b8", paste(t, a * 180 / pi, sep = "\t")), ext = ".txt")
  expect_error(read_motion(angles), class = "rotdyn_error_missing")
  expect_equal(read_tracker(angles, angle_unit = "deg")$theta_rad, a, tolerance = 1e-9)
  expect_equal(read_tracker(angles, angle_unit = "rad")$theta_rad, a * 180 / pi, tolerance = 1e-9)
})

test_that("projects: y down, an angle, a scale, frames, a tracked centre", {
  skip_if_not_installed("xml2")
  frame <- c(5:20, 22:30)
  a <- 3 + 0.2 * frame
  wheel <- data.frame(frame, x = 0.1 + 0.01 * frame + 0.2 * cos(a), y = 0.3 + 0.2 * sin(a))
  hub <- data.frame(frame, x = 0.1 + 0.01 * frame, y = 0.3)
  file <- text_file(
    tracker_xml(list(rim = wheel, hub = hub), angle = 12, start = 5), ext = ".trk"
  )
  r <- read_motion(file, mark = "rim", centre = "hub")
  expect_equal(r$x_m, wheel$x, tolerance = 1e-9)
  expect_equal(r$y_m, wheel$y, tolerance = 1e-9)
  expect_equal(r$time_s, (frame - 5) / 30, tolerance = 1e-12)
  expect_equal(diff(r$theta_rad), diff(a), tolerance = 1e-8)
  expect_error(read_motion(file), class = "rotdyn_error_missing")
  expect_error(read_motion(file, mark = "no"), class = "rotdyn_error_value")
  expect_equal(read_tracker(file, mark = "hub", frame_rate_hz = 300)$time_s, (frame - 5) / 300)
})

test_that("the car in the loop", {
  skip_if_not_installed("xml2")
  car <- read_motion(shared("data", "measured", "tracker_car_in_loop.trk"))
  expect_equal(nrow(car), 53)
  expect_equal(c(car$x_m[1], car$y_m[1]), c(0.021111, -0.000743), tolerance = 1e-3)
  expect_equal(car$time_s, 0:52 / 240)
  loop <- motion_record(car[car$y_m > 0.02, ], time_s = time_s, x_m = x_m, y_m = y_m)
  expect_equal(attr(loop, "record")$centre$radius_m, 0.0397, tolerance = 0.002)
  # Unwrapped through +-pi: the car turns one way.
  expect_lt(max(diff(loop$theta_rad)), 0)
  expect_gt(diff(range(loop$theta_rad)), 3)
})

test_that("projects in Latin-1 are read, declared or not, and UTF-8 under any declaration", {
  skip_if_not_installed("xml2")
  frame <- 5:20
  wheel <- data.frame(frame, x = 0.2 * cos(0.2 * frame), y = 0.2 * sin(0.2 * frame))
  plain <- tracker_xml(list(R = wheel))
  plain <- gsub(">R<", ">R\u00e4d<", plain, fixed = TRUE)
  expect_true(any(grepl("R\u00e4d", plain)))
  body <- sub("<[?]xml[^>]*[?]>", "", plain)
  heads <- c(none = "", utf8 = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
    latin = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>")
  for (head in heads) {
    for (encoding in c("latin1", "UTF-8")) {
      file <- tempfile(fileext = ".trk")
      text <- iconv(paste(c(head, body), collapse = "\n"), "UTF-8", encoding, toRaw = TRUE)[[1]]
      writeBin(text, file)
      r <- read_motion(file, mark = "R\u00e4d")
      expect_equal(r$x_m, wheel$x, tolerance = 1e-9)
    }
  }
})

test_that("the panel of a project may be within another object", {
  skip_if_not_installed("xml2")
  frame <- 0:9
  rim <- data.frame(frame, x = cos(frame / 3), y = sin(frame / 3))
  lines <- tracker_xml(list(rim = rim))
  for (root in c("<object class=\"org.opensourcephysics.TrackerData\">", "<object>")) {
    file <- text_file(
      c(lines[1], root, "<property name=\"panel\" type=\"object\">", lines[-1], "</property>",
        "</object>"), ext = ".trk"
    )
    expect_equal(read_tracker(file)$x_m, rim$x, tolerance = 1e-9)
  }
  other <- c("<object class=\"org.opensourcephysics.Dataset\">", "</object>")
  file <- text_file(other, ext = ".trk")
  expect_error(read_tracker(file), "no project of Tracker", class = "rotdyn_error_file")
})
