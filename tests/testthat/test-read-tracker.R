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

test_that("units in the headings of exported text are converted, others are refused", {
  t <- 0:20 / 20
  x <- cos(3 * t)
  y <- sin(3 * t)
  export <- function(heads, t, x, y) {
    text_file(c("mass A", heads, paste(t, x, y, sep = "\t")), ext = ".txt")
  }
  metres <- c(mm = 1e-3, cm = 1e-2, m = 1, km = 1e3, "in" = 0.0254, ft = 0.3048)
  for (unit in names(metres)) {
    heads <- paste0("t (ms)\tx (", unit, ")\ty [", unit, "]")
    file <- export(heads, 1e3 * t, x / metres[[unit]], y / metres[[unit]])
    for (read in list(read_motion, read_tracker)) {
      r <- read(file, centre_m = c(0, 0))
      expect_equal(r$time_s, t, tolerance = 1e-12, info = unit)
      expect_equal(r$x_m, x, tolerance = 1e-12, info = unit)
      expect_equal(r$y_m, y, tolerance = 1e-12, info = unit)
      expect_false(any(grepl("in m$", attr(r, "record")$assumed)))
    }
  }
  for (heads in c("t (s)\tx (px)\ty (px)", "t (s)\tx (m)\ty (furlong)", "t (frames)\tx (m)\ty (m)",
    "t (s)\tx (s)\ty (m)")) {
    expect_error(read_tracker(export(heads, t, x, y)), "unit of", class = "rotdyn_error_file")
  }
})

test_that("frame numbers of a file give the times at the rate of the camera", {
  frame <- c(0, 3, 6, 9, 15, 18, 20)
  shown <- sprintf("%.2f", 0.5 + frame / 30)
  export <- function(frame) {
    text_file(c(
      "mass A", "t\tx\ty\tframe",
      paste(shown, cos(frame / 9), sin(frame / 9), frame, sep = "\t")
    ), ext = ".txt")
  }
  r <- read_motion(export(frame), frame_rate_hz = 240, centre_m = c(0, 0))
  expect_equal(r$time_s - r$time_s[1], frame / 240, tolerance = 1e-12)
  expect_equal(r$time_s[1], 0.5 / 8, tolerance = 0.05)
  expect_match(attr(r, "record")$assumed, "frame numbers", all = FALSE)
  for (bad in list(rev(frame), frame / 2)) {
    expect_error(
      read_tracker(export(bad), frame_rate_hz = 240), "frame numbers", class = "rotdyn_error_file"
    )
  }
})
