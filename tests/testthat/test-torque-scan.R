many <- function(f) function(t) vapply(t, f, double(1))
scan <- function(f, from = 0, to = 10, ...) rotdyn:::scan_breaks(many(f), from, to, ...)$breaks
looked_for <- function(scene, t, ...) suppressWarnings(run_of(trajectory(scene, t, ...))$info)

test_that("jumps are found to the last bit", {
  expect_equal(scan(function(t) if (t >= pi) 1 else 0), pi, tolerance = 1e-15)
  expect_equal(scan(function(t) if (t > 2) t else -t), 2, tolerance = 1e-15)
  pulse <- function(t) if (t >= 5 && t < 5.002) 40 else 0
  expect_equal(scan(pulse, points = 8193L), c(5, 5.002), tolerance = 1e-15)
  pulse <- function(t) if (t >= 5.01 && t < 5.05) 40 else 0
  expect_equal(scan(pulse), c(5.01, 5.05), tolerance = 1e-15)
})

test_that("a jump among steep changes is found to the last bit", {
  at <- 1.9822911920024682
  law <- function(t) 9 * cos(4.75 * t + 2.2) + if (t >= at) 2.1 else 0
  expect_identical(scan(law, 0, 13.24, 257L), at)
  expect_identical(scan(function(t) -law(t), 0, 13.24, 257L), at)
  # Wherever it lies between two of the points.
  for (at in 1.73 + 1:17 / 170) expect_identical(scan(law, 0, 13.24, 257L), at)
})

test_that("kinks are found", {
  expect_equal(scan(function(t) abs(t - pi)), pi, tolerance = 1e-14)
  knots <- approxfun(c(0, 1, 4, 6, 10), c(0, 0.8, 0.8, 0, 0))
  expect_equal(scan(knots), c(1, 4, 6), tolerance = 1e-14)
  expect_equal(scan(function(t) exp(t) + abs(t - 1)), 1, tolerance = 1e-13)
  expect_equal(scan(function(t) abs(sin(3 * t))), 1:9 * pi / 3, tolerance = 1e-14)
})

test_that("smooth functions have none, however fast", {
  expect_length(scan(sin), 0)
  expect_length(scan(function(t) sin(200 * t)), 0)
  expect_length(scan(function(t) exp(-t) * t^3), 0)
  expect_length(scan(function(t) tanh(100 * (t - 5))), 0)
  expect_length(scan(function(t) 1 / (1 + 25 * (t - 5)^2)), 0)
  expect_length(scan(function(t) 0), 0)
  expect_length(scan(function(t) 1e-300 * t), 0)
})

test_that("a steep but smooth change is guarded, not reported", {
  bump <- function(t) 1000 * exp(-((t - 5) / 3e-4)^2)
  expect_length(scan(bump), 0)
  guards <- rotdyn:::scan_breaks(many(bump), 0, 10)$guards
  expect_true(any(guards < 5) && any(guards > 5))
  # The area of the bump, which a step of a second would pass unseen.
  expect_warning(motion <- trajectory(scene_axle(0.5, bump), c(0, 10)), NA)
  expect_equal(motion$omega_rad_per_s[2], 2 * 1000 * 3e-4 * sqrt(pi), tolerance = 1e-8)
})

test_that("a pulse eight intervals wide is guarded, and not passed by long implicit steps", {
  pulse <- function(t) 10 * exp(-((t - 0.688) / 0.0107)^2)
  guards <- scan_breaks(pulse, 0, 0.88, 129L)$guards
  expect_true(any(guards > 0.64 & guards < 0.688) && any(guards > 0.688 & guards < 0.74))
  law <- torque_function(function(time_s, theta_rad, omega_rad_per_s) {
    pulse(time_s) - 0.15 * sin(theta_rad)
  })
  # From its linear torque: 10 sqrt(pi) 0.0107 / I, and what the sine does in 0.88 s at most.
  end <- trajectory(scene_axle(0.114, law), c(0, 0.88), 1e-4, "axle_radau")$omega_rad_per_s[2]
  expect_equal(end, 10 * sqrt(pi) * 0.0107 / 0.114, tolerance = 0.05)
})

test_that("an empty interval and values that are not finite are left alone", {
  law <- torque_function(function(t) if (t > 1) 1 else 0)
  expect_identical(rotdyn:::law_breaks(law, stop, 1, 1, NULL), list(stops = double()))
  expect_length(scan(function(t) if (t > 3) NaN else 1), 0)
})

test_that("the points follow from the resolution, and are counted", {
  step <- function(t) ifelse(t < pi, 1, 0)
  for (vectorised in c(FALSE, TRUE)) {
    for (resolution in c(0.02, 0.005, 0.001)) {
      calls <- 0
      counted <- function(t) {
        calls <<- calls + length(t)
        step(t)
      }
      scene <- scene_axle(1, torque_function(counted, vectorised = vectorised))
      points <- 1 + ceiling(1.28 / resolution)
      if (vectorised) points <- max(points, 8193)
      info <- looked_for(scene, 0:10, resolution = resolution)
      expect_equal(info$rhs_calls, calls)
      expect_identical(info$resolution, resolution)
      # The points, the jump bisected to the last of 52 bits, and two pieces of 33 samples.
      expect_gt(calls, points)
      expect_lt(calls, points + 60 + 2 * 33 + 10)
    }
  }
})

test_that("samples of a law whose breaks are given are compared with it", {
  bump <- function(t) {
    0.3 * cos(6 * t) + ifelse(abs(t - 5.2) < 0.025, 1 + cos(40 * pi * (t - 5.2)), 0)
  }
  plain <- 0.05 * sin(60)
  for (law in list(bump, torque_function(bump, breaks_s = numeric()))) {
    end <- trajectory(scene_axle(1, law), c(0, 10))$omega_rad_per_s[2]
    expect_equal(end, plain + 0.05, tolerance = 1e-9)
  }
  box <- function(t) 0.3 * cos(6 * t) - ifelse(abs(t - 5.2) < 0.026, 1, 0)
  end <- trajectory(scene_axle(1, torque_function(box, breaks_s = numeric())), c(0, 10))
  expect_equal(end$omega_rad_per_s[2], plain - 0.052, tolerance = 1e-9)
  # Narrower than the resolution: missed, which the head says, or found where that is asked.
  thin <- function(t) ifelse(abs(t - 5.2013) < 0.0015, 1, 0)
  scene <- scene_axle(1, torque_function(thin, breaks_s = numeric()))
  expect_identical(trajectory(scene, c(0, 10))$omega_rad_per_s[2], 0)
  expect_match(tibble::tbl_sum(trajectory(scene, c(0, 10)))[["Law"]], "narrower than 0.5 %")
  fine <- trajectory(scene, c(0, 10), resolution = 2e-4)
  expect_equal(fine$omega_rad_per_s[2], 0.003, tolerance = 1e-9)
})

test_that("the same motion twice is the same to the last bit", {
  f <- function(t, theta, omega) -2 * sin(theta) + if (t < 3.3) t else 3
  scene <- scene_axle(1, f, theta0_rad = 1)
  motion <- function() suppressWarnings(trajectory(scene, (0:40) / 2))
  expect_identical(motion(), motion())
})

test_that("a trajectory warns of what was found and stops there", {
  pulse <- function(t) if (t >= 50 & t < 50.02) 40 else 0
  scene <- scene_axle(body_disk(2, 0.25), pulse)
  # Longer than the spacing of 0.39 s, or it may be missed.
  lasts <- function(t) if (t >= 50.1 && t < 50.5) 4 else 0
  warning <- expect_warning(
    motion <- trajectory(scene_axle(body_disk(2, 0.25), lasts), 0:100),
    class = "rotdyn_warning_breaks"
  )
  expect_match(conditionMessage(warning), "found 2, at 50.1, 50.5 s", fixed = TRUE)
  expect_match(conditionMessage(warning), "sampled every 0.39 s: anything shorter is not resolved")
  expect_equal(motion$omega_rad_per_s[101], 4 * (50.5 - 50.1) / 0.0625, tolerance = 1e-12)
  # A function that takes vectors is sampled every 12 ms.
  short <- torque_function(function(t) ifelse(t >= 50 & t < 50.02, 40, 0), vectorised = TRUE)
  expect_warning(
    motion <- trajectory(scene_axle(body_disk(2, 0.25), short), 0:100),
    class = "rotdyn_warning_breaks"
  )
  expect_equal(motion$omega_rad_per_s[101], 40 * (50.02 - 50) / 0.0625, tolerance = 1e-12)
  # Told, there is nothing to warn of.
  told <- scene_axle(body_disk(2, 0.25), torque_function(pulse, breaks_s = c(50, 50.02)))
  expect_silent(motion <- trajectory(told, 0:100))
  expect_equal(motion$omega_rad_per_s[101], 12.8, tolerance = 1e-9)
})

test_that("curves that do not meet in the interval are parted in its middle", {
  # Of parabolas that meet beyond an end.
  meets <- function(at) {
    f <- function(t) ifelse(t < 0.5, 0, t - at)
    t <- c(0, 0.5, 1)
    rotdyn:::cross_curves(f, t, f(t))
  }
  expect_equal(meets(0.6), 0.6, tolerance = 1e-12)
  expect_identical(meets(1.4), 0.5)
  expect_identical(meets(-0.4), 0.5)
})
