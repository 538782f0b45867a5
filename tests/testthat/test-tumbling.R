test_that("published bodies flip as often as they do", {
  # Principia's and another, computed by an independent integration.
  times <- flip_time(
    rbind(c(3, 5, 9), c(1, 2, 3)), rbind(c(0, 0.4, 0.0011111111111111111), c(0.01, 4, 0.01))
  )
  expect_equal(times, c(59.05544352, 6.08915246), tolerance = 2e-9)
  root <- Sys.getenv("ROTDYN_SHARED")
  path <- file.path(root, "cases", "dzhanibekov_collection", "cases.csv")
  skip_if(!nzchar(root) || !file.exists(path), "no shared reference data")
  table <- utils::read.csv(path)
  got <- flip_time(
    as.matrix(table[c("I1", "I2", "I3")]), as.matrix(table[c("w1", "w2", "w3")])
  )
  expect_equal(got, table$ours, tolerance = 2e-9)
})

test_that("flip times follow the closed form, and the limit of small disturbances", {
  # I = (1, 2, 3), w = (sqrt(1.53), 0, 1): m = 0.51, lambda = 1, 2 K(0.51) by mpmath.
  half <- 2 * 1.8626408023327386
  expect_equal(flip_time(c(1, 2, 3), c(sqrt(1.53), 0, 1)), half, tolerance = 1e-12)
  # Any order of the axes.
  expect_equal(flip_time(c(3, 1, 2), c(1, sqrt(1.53), 0)), half, tolerance = 1e-12)
  # A tenth of the disturbance: log(10) over the growth rate more, twice in a half period.
  times <- flip_time(c(1, 2, 3), cbind(10^-(4:9), 4, 0))
  growth <- spin_stability(c(1, 2, 3))$growth_per_omega[2]
  expect_equal(diff(times), rep(2 * log(10) / (4 * growth), 5), tolerance = 1e-6)
  expect_identical(flip_time(c(1, 2, 3), c(0, 4, 0)), Inf)
  expect_identical(flip_time(c(2, 2, 2), c(1, 4, 0)), Inf)
  expect_identical(flip_time(c(1, 2, 3), rbind(c(1, 1, NA), c(0, 0, 0))), c(NA, Inf))
  expect_error(flip_time(c(1, 2), c(0, 1, 0)), class = "rotdyn_error_size")
  expect_error(flip_time(c(1, 2, 3), 1), class = "rotdyn_error_size")
  expect_error(flip_time(cbind(-1, 1, 1), c(0, 1, 0)), class = "rotdyn_error_value")
  expect_error(flip_time(c(1, 2, 3)), class = "rotdyn_error_missing")
})

test_that("a body in any axes flips as often", {
  box <- body_box(0.2, 0.02, 0.1, 0.2)
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  omega <- c(0.1, 0.2, 10)
  turned <- place_body(box, rotation = turn)
  expect_equal(
    flip_time(turned, as.vector(turn %*% omega)), flip_time(box, omega), tolerance = 1e-10
  )
})

test_that("the stability of each axis", {
  out <- spin_stability(c(1, 2, 3))
  expect_identical(out$stability, c("stable", "unstable", "stable"))
  expect_equal(out$growth_per_omega, c(0, sqrt(1 / 3), 0))
  expect_equal(out$wobble_per_omega, c(sqrt(2 / 6), 0, sqrt(2 / 2)))
  # The growth, seen: from 1e-6 by exp(growth omega t).
  motion <- trajectory(scene_free(c(1, 2, 3), c(1e-6, 4, -1e-6 / sqrt(3))), c(0, 2, 3))
  expect_equal(
    motion$omega_x_rad_per_s[3] / motion$omega_x_rad_per_s[2], exp(4 / sqrt(3)), tolerance = 1e-3
  )
  # The wobble, seen: 4 sqrt(2/2) rad/s about axis 3.
  wobble <- trajectory(scene_free(c(1, 2, 3), c(1e-5, 0, 4)), c(0, 2 * pi / 4))
  expect_equal(wobble$omega_x_rad_per_s[2], 1e-5, tolerance = 1e-6)
  expect_identical(spin_stability(c(2, 2, 3))$stability, c("neutral", "neutral", "stable"))
  expect_identical(spin_stability(c(0, 2, 2))$stability, c(NA, "neutral", "neutral"))
  expect_identical(spin_stability(c(2, 2, 2))$stability, rep("neutral", 3))
})

test_that("the polhode closes, on the ellipsoid of energy; the herpolhode lies in a plane", {
  nut <- scene_free(c(1, 2, 3), c(0.5, 4, 0.3))
  path <- polhode(nut, 101)
  omega <- do.call(cbind, unclass(path)[free_rates("")])
  expect_equal(omega[1, ], omega[101, ], tolerance = 1e-12)
  expect_equal(as.vector(omega^2 %*% c(1, 2, 3)), rep(32.52, 101), tolerance = 1e-14)
  space <- do.call(cbind, unclass(path)[free_rates("space_")])
  expect_equal(as.vector(space %*% c(0.5, 8, 0.9)), rep(32.52, 101), tolerance = 1e-14)
  expect_equal(polhode(scene_free(c(1, 2, 3), c(0, 0, 2)), 2)$time_s, c(0, pi))
  expect_error(polhode(scene_free(c(1, 2, 3), c(0, 0, 2),
    resistance = resistance(damping_per_s = 1))),
               class = "rotdyn_error_value")
  expect_error(polhode(scene_free(c(4, 5, 9), c(3, 0, 1))), class = "rotdyn_error_value")
  expect_error(polhode(scene_axle(1)), class = "rotdyn_error_value")
})

test_that("a scene knows its body and its rates", {
  nut <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01))
  expect_identical(flip_time(nut), flip_time(c(1, 2, 3), c(0.01, 4, 0.01)))
  turned <- scene_free(place_body(body_box(1, 1, 2, 3), c(0, 0, 0),
    rotation_about("x", angle_deg = 30)),
                       c(0.1, 3, 0.2))
  expect_equal(flip_time(turned), diff(motion_events(trajectory(turned, c(0, 20)))$time_s)[1],
               tolerance = 1e-9)
  expect_identical(spin_stability(nut), spin_stability(c(1, 2, 3)))
  expect_error(flip_time(nut, c(1, 1, 1)), class = "rotdyn_error_argument")
  expect_error(flip_time(update(nut, torque = c(1, 0, 0))), class = "rotdyn_error_model")
  expect_error(flip_time(scene_axle(1)), class = "rotdyn_error_type")
})

test_that("moments that differ by more than their roundings are two moments", {
  # Beside an axis of nearly equal moments: stable about the first and the last, at 1e-11 of each.
  expect_equal(spin_stability(c(1, 1 + 1e-11, 2))$stability, c("stable", "unstable", "stable"))
  expect_equal(spin_stability(c(1, 1 + 1e-13, 2))$stability, c("neutral", "neutral", "stable"))
})

test_that("more points of a polhode than fit are an error of the package", {
  nut <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01))
  expect_error(polhode(nut, 1e300), "1e\\+06", class = "rotdyn_error_value")
})
