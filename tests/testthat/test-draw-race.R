test_that("a wheel's hole is that of its beta, and what does not turn is a block", {
  expect_equal(hole_of_beta(0.625), 0.5)
  expect_identical(hole_of_beta(0.5), 0)
  expect_identical(hole_of_beta(1), 0.88)
  fills <- function(marks) sum(vapply(marks, function(one) one$type == "fill", NA))
  expect_identical(fills(racer_marks(0, 0, 1, 0, 1)), fills(racer_marks(0, 0, 1, 0, 0.5)) + 1L)
  expect_length(racer_marks(0, 0, 1, 0, 0), 1)
})

test_that("bodies of a race are on their lanes, and turn as they roll", {
  race <- roll_race(c("hoop", "sphere"), incline_angle_deg = 20, length_m = 2)
  about <- attr(race, "race")
  film <- race_film(about, c(0, 0.5, 1))
  rims <- lapply(film$frames, function(one) {
    Filter(function(m) m$type == "fill" && m$style == "body", one$marks)
  })
  centre <- function(i, k) colMeans(rims[[i]][[k]]$points[-1, ])
  x <- matrix(.Call(ffi_incline_frames, about$starts, c(0, 0.5, 1), NULL)$x_m, 2)
  # The sphere, faster, is on top.
  for (k in 1:2) {
    lane <- c(2, 1)[k]
    moved <- centre(3, k) - centre(1, k)
    expect_equal(sqrt(sum(moved^2)), x[lane, 3])
    expect_equal(atan2(-moved[2], moved[1]), 20 * pi / 180)
  }
  labels <- film$frames[[1]]$labels
  expect_identical(labels$symbol, c("\"sphere\"", "\"hoop\""))
  # Steep and upward lanes fit.
  for (angle in c(90, -10)) {
    steep <- roll_race(c("hoop", "sphere"), incline_angle_deg = angle, length_m = 1, time_s = 0:1)
    box <- race_film(attr(steep, "race"), 0:1)$box
    expect_lt(diff(box[3:4]) / diff(box[1:2]), 1.2)
  }
})

test_that("the dot of a wheel turns with it, half a gap behind its first spoke", {
  for (angle in c(0, 0.7)) {
    marks <- wheel_marks(2, -1, 3, angle, spokes = 4L)
    dots <- Filter(function(one) one$style == "#0072B2", marks)
    expect_length(dots, 1L)
    centre <- colMeans(dots[[1]]$points[-1, ]) - c(2, -1)
    expect_equal(atan2(centre[2], centre[1]), angle + pi / 8, tolerance = 1e-10)
    expect_equal(sqrt(sum(centre^2)), 3 * (0.93 * 0.86 - 0.16), tolerance = 1e-10)
  }
})
