cloud <- function() {
  data.frame(
    mass_kg = c(1.5, 2.25, 0.4, 3), x_m = c(0.3, -3.1, 5.5, 1), y_m = c(-1.2, 0.7, 6.25, 2),
    z_m = c(4, 0.2, -7, 3)
  )
}

test_that("points have their mass, centre, second moment and reach", {
  body <- body_points(cloud())
  # mpmath, 50 digits.
  expect_equal(body$mass_kg, 7.15)
  expect_ulps(
    unname(body$centre_m), c(-0.1853146853146853, 1.157342657342657, 1.769230769230769), 4
  )
  expect_ulps(
    unname(body$second_moment_kg_m2[c(1, 5, 9, 4, 7, 8)]),
    c(
      36.61195804195804, 21.31048951048951, 48.30923076923077, 15.86097902097902,
      -3.650769230769232, -21.02538461538462
    ), 8
  )
  # The farthest is the third.
  far <- sqrt(sum((c(5.5, 6.25, -7) - body$centre_m)^2))
  expect_equal(body$reach_m, far)
  expect_gte(body$reach_m, far)
  expect_equal(body$provenance, "points")
  expect_equal(body$detail$points, 4)
  expect_lte(body$error, 1e-15)
  expect_gt(body$error, 0)
  expect_equal(body$error_kind, "bound")
})

test_that("no offset costs a digit", {
  at <- cloud()
  at[2:4] <- round(at[2:4] * 1024) / 1024 # stays exact when moved
  near <- body_points(at)
  for (offset in c(1e4, -1e8)) {
    far <- at
    far[2:4] <- far[2:4] + offset
    body <- body_points(far)
    change <- abs(body$second_moment_kg_m2 - near$second_moment_kg_m2)
    expect_lte(max(change), 4e-16 * sum(diag(near$second_moment_kg_m2)))
    expect_lte(max(abs(body$centre_m - offset - near$centre_m)), 2 * body$detail$centre_error_m)
    expect_lte(body$detail$centre_error_m, 4 * .Machine$double.eps * max(abs(body$centre_m), 1))
  }
})

test_that("a matrix, a plane, one mass for all, groups and extra columns are understood", {
  at <- cloud()
  body <- body_points(at)
  same <- function(x) expect_equal(x$second_moment_kg_m2, body$second_moment_kg_m2)
  xyz <- as.matrix(at[2:4])
  same(body_points(xyz, mass_kg = at$mass_kg))
  same(body_points(unname(xyz), mass_kg = at$mass_kg))
  short <- xyz[, 3:1]
  colnames(short) <- c("z", "y", "x")
  same(body_points(short, mass_kg = at$mass_kg))
  same(body_points(cbind(as.matrix(at), extra = 7)))
  same(body_points(tibble::as_tibble(cbind(at, label = "a"))))
  plane <- body_points(at[1:3])
  expect_equal(plane$second_moment_kg_m2["z", ], c(x = 0, y = 0, z = 0))
  flat <- plane$inertia_kg_m2
  expect_equal(flat[3, 3], flat[1, 1] + flat[2, 2])
  expect_equal(body_points(xyz, mass_kg = 2)$mass_kg, 8)
  expect_equal(
    body_points(xyz, mass_kg = 2)$second_moment_kg_m2, 8 * stats::cov(xyz) * 3 / 4,
    ignore_attr = TRUE
  )
})

test_that("units are converted", {
  skip_if_not_installed("units")
  at <- cloud()
  body <- body_points(at)
  with_units <- at
  with_units$mass_kg <- units::set_units(at$mass_kg * 1000, "g", mode = "standard")
  with_units$z_m <- units::set_units(at$z_m * 100, "cm", mode = "standard")
  expect_equal(body_points(with_units)$inertia_kg_m2, body$inertia_kg_m2)
  metres <- units::set_units(as.matrix(at[2:4]) * 1000, "mm", mode = "standard")
  expect_equal(body_points(metres, mass_kg = at$mass_kg)$inertia_kg_m2, body$inertia_kg_m2)
  with_units$x_m <- units::set_units(at$x_m, "s", mode = "standard")
  expect_error(body_points(with_units), class = "rotdyn_error_unit")
})

test_that("masses of zero are points without weight", {
  at <- cloud()
  body <- body_points(rbind(at, c(0, 100, 0, 0)))
  expect_equal(body$second_moment_kg_m2, body_points(at)$second_moment_kg_m2)
  expect_gt(body$reach_m, 100)
  at$mass_kg <- 0
  none <- body_points(at)
  expect_equal(none$mass_kg, 0)
  expect_equal(unname(none$centre_m), unname(colMeans(at[2:4])))
  expect_true(all(none$inertia_kg_m2 == 0))
  one <- body_points(cloud()[2, ])
  expect_equal(unname(one$centre_m), c(-3.1, 0.7, 0.2))
  expect_true(all(one$inertia_kg_m2 == 0))
  expect_equal(one$error, 0)
})

test_that("no scale is out of reach but those that doubles cannot hold", {
  at <- cloud()
  body <- body_points(at)
  for (power in c(-480, 480)) {
    scaled <- at
    scaled[2:4] <- at[2:4] * 2^power
    scaled$mass_kg <- at$mass_kg * 2^(-2 * power + 30)
    expect_identical(
      body_points(scaled)$second_moment_kg_m2, body$second_moment_kg_m2 * 2^30
    )
  }
  at[2:4] <- at[2:4] * 2^600
  expect_error(body_points(at), class = "rotdyn_error_range")
  at[2:4] <- at[2:4] * 2^-600 * 2^-600
  expect_error(body_points(at), class = "rotdyn_error_range")
  expect_error(
    body_points(data.frame(mass_kg = 1, x_m = c(-1.7e308, 1.7e308), y_m = 0)),
    class = "rotdyn_error_range"
  )
})

test_that("a bad point is an error that names its row", {
  at <- cloud()
  spoil <- function(row, column, value) {
    at[row, column] <- value
    at
  }
  expect_error(body_points(spoil(3, "x_m", NA)), "row 3", class = "rotdyn_error_value")
  expect_error(body_points(spoil(2, "z_m", NaN)), "z_m.*row 2", class = "rotdyn_error_value")
  expect_error(body_points(spoil(4, "mass_kg", Inf)), "row 4", class = "rotdyn_error_value")
  expect_error(body_points(spoil(2, "mass_kg", -1)), "cut_body", class = "rotdyn_error_value")
  expect_error(body_points(at[0, ]), class = "rotdyn_error_size")
  expect_error(body_points(at[-1]), "mass_kg", class = "rotdyn_error_type")
  expect_error(body_points(at[-3]), "y_m", class = "rotdyn_error_type")
  expect_error(body_points(at, mass_kg = 1), class = "rotdyn_error_value")
  # A slip in the name of the third column is not a plane.
  names(at)[4] <- "z_mm"
  expect_error(body_points(at), "z_m", class = "rotdyn_error_type")
  expect_error(body_points(1:3), class = "rotdyn_error_type")
  expect_error(body_points(matrix(1, 2, 4), mass_kg = 1), class = "rotdyn_error_size")
  expect_error(body_points(matrix(1, 2, 3), mass_kg = 1:3), class = "rotdyn_error_size")
  expect_error(body_points(matrix("a", 2, 3), mass_kg = 1), class = "rotdyn_error_type")
  expect_error(body_points(), class = "rotdyn_error_missing")
  error <- tryCatch(body_points(spoil(3, "x_m", NA)), error = identity)
  expect_equal(error$call[[1]], quote(body_points))
})

test_that("points of a rod of many points tend to the rod", {
  n <- 2e5
  x <- (seq_len(n) - 0.5) / n * 2
  body <- body_points(data.frame(mass_kg = 1.5 / n, x_m = x + 1e5, y_m = -1e5))
  # n equal points of a rod: m l^2/12 (1 - 1/n^2).
  expect_equal(body$inertia_kg_m2["z", "z"], 1.5 * 4 / 12 * (1 - 1 / n^2), tolerance = 1e-11)
  expect_lte(body$inertia_kg_m2["x", "x"], 1e-12)
})

test_that("a column that is a matrix does not become more points", {
  wide <- tibble::tibble(mass_kg = 1, x_m = matrix(c(1, 2), 1), y_m = 1)
  expect_error(body_points(wide), class = "rotdyn_error_size")
  tall <- tibble::tibble(mass_kg = c(1, 3), x_m = matrix(c(0, 4), 2), y_m = 1)
  expect_equal(body_points(tall)$centre_m[["x"]], 3)
})
