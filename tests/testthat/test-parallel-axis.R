test_that("a moment goes out with m d^2 and comes back without", {
  expect_identical(parallel_axis(0.5, mass_kg = 1.5, distance_m = 1), 2)
  expect_identical(parallel_axis(2, 1.5, 1, direction = "to_centre"), 0.5)
  expect_identical(parallel_axis(0.5, 1.5, 2), 6.5)
  set.seed(3)
  own <- runif(50)
  mass <- runif(50)
  distance <- runif(50, 0, 3)
  away <- parallel_axis(own, mass, distance)
  expect_true(all(away >= own))
  expect_equal(
    parallel_axis(away, mass, distance, direction = "to_centre"), own, tolerance = 1e-13
  )
})

test_that("it works by row: recycled, NA gives NA", {
  expect_identical(parallel_axis(c(1, NA, 3), 2, 1), c(3, NA, 5))
  expect_identical(parallel_axis(1, c(1, 2), c(3, 4)), c(10, 33))
  expect_identical(parallel_axis(c(3, NA, 4), 2, 1, direction = "to_centre"), c(1, NA, 2))
  expect_identical(parallel_axis(numeric(), 2, 1), numeric())
  expect_identical(parallel_axis(1L, 2L, 3L), 19)
})

test_that("a tensor moves by m (d'd 1 - d d'), and back", {
  own <- diag(c(7, 5, 4))
  d <- c(1, 2, -4)
  want <- own + 3 * (sum(d^2) * diag(3) - outer(d, d))
  moved <- parallel_axis(own, mass_kg = 3, distance_m = d)
  expect_identical(unname(moved), want)
  expect_identical(unname(parallel_axis(own, 3, -d)), want)
  expect_identical(unname(parallel_axis(moved, 3, d, direction = "to_centre")), own)
  # As a body does it.
  body <- body_tensor(3, own)
  expect_identical(as.matrix(inertia_tensor(body, d)), moved)
})

test_that("from one point to another the way leads through the centre", {
  # From the point at (1, 0, 0) to the one at (0, 1, 0) by way of the centre.
  tilt <- rotation_about("x", angle_rad = 1)
  body <- place_body(body_tensor(2, c(0.5, 0.6, 0.7)), c(0, 0, 0), tilt)
  first <- as.matrix(inertia_tensor(body, c(1, 0, 0)))
  centre <- parallel_axis(first, 2, c(1, 0, 0), direction = "to_centre")
  expect_equal(
    parallel_axis(centre, 2, c(0, 1, 0)), as.matrix(inertia_tensor(body, c(0, 1, 0))),
    tolerance = 1e-15
  )
})

test_that("what is lost on the way to the centre is said, in digits", {
  expect_warning(
    parallel_axis(1e9 + 1, 1e9, 1, direction = "to_centre"), "about 6 digits",
    class = "rotdyn_warning_digits"
  )
  # Half of the digits is where it begins: m d^2 = 1e8 times what is left.
  expect_no_warning(parallel_axis(1e8 + 1, 1e8, 1, direction = "to_centre"))
  expect_warning(
    parallel_axis(1.5e8 + 1, 1.5e8, 1, direction = "to_centre"), class = "rotdyn_warning_digits"
  )
  expect_no_warning(parallel_axis(1, 1e12, 1))
  expect_warning(
    left <- parallel_axis(diag(c(1, 1, 1)) + 1e10 * diag(c(0, 1, 1)), 1e10, c(1, 0, 0),
                          direction = "to_centre"),
    "about 5 digits", class = "rotdyn_warning_digits"
  )
  expect_equal(unname(left), diag(3))
  expect_warning(
    body_tensor(1e10, diag(c(1, 1, 1)) + 1e10 * diag(c(0, 1, 1)), c(1, 0, 0), about = "origin"),
    class = "rotdyn_warning_digits"
  )
  # A point mass is left with nothing at all.
  expect_warning(
    none <- parallel_axis(2 * 0.3^2, 2, 0.3, direction = "to_centre"),
    "about 0 digits", class = "rotdyn_warning_digits"
  )
  expect_gte(none, 0)
  expect_lte(none, 1e-16)
  # In a column the row that warns is not the first.
  expect_warning(
    parallel_axis(c(2, 1e9 + 1), c(1, 1e9), 1, direction = "to_centre"), "1e\\+09 kg m\\^2",
    class = "rotdyn_warning_digits"
  )
})

test_that("the warning tells what to do", {
  expect_snapshot(x <- parallel_axis(1e9 + 1, 1e9, 1, direction = "to_centre"))
})

test_that("rounding on the way back leaves no impossible tensor", {
  # A plate and a rod, from far away: what comes back may be short of possible by rounding only.
  set.seed(11)
  for (i in 1:20) {
    d <- runif(3, -30, 30)
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, 0, 6))
    for (flat in list(c(0, 1, 1), c(1, 2, 3))) {
      body <- place_body(body_tensor(2, flat), c(0, 0, 0), turn)
      away <- as.matrix(inertia_tensor(body, d))
      back <- parallel_axis(away, 2, d, direction = "to_centre")
      second <- sum(diag(back)) / 2 * diag(3) - back
      expect_gte(min(eigen(second, TRUE, TRUE)$values), -1e-14)
      expect_equal(back, body$inertia_kg_m2, tolerance = 1e-11)
    }
  }
})

test_that("a tensor that is impossible by more than rounding is not altered", {
  # I1 + I2 short of I3 by 1e-13, 56 times the rounding allowed; exact in double precision.
  short <- diag(c(1, 1 - 2^-43, 2))
  away <- short + diag(c(0, 0.25, 0.25))
  back <- parallel_axis(away, 1, c(0.5, 0, 0), direction = "to_centre")
  expect_identical(unname(back), short)
})

test_that("bad arguments are refused by class", {
  expect_error(parallel_axis(), class = "rotdyn_error_missing")
  expect_error(parallel_axis(1, 2), class = "rotdyn_error_missing")
  expect_error(parallel_axis("1", 2, 3), class = "rotdyn_error_type")
  expect_error(parallel_axis(1, TRUE, 3), class = "rotdyn_error_type")
  expect_error(parallel_axis(1, 2, list(3)), class = "rotdyn_error_type")
  expect_error(parallel_axis(1:3, 1, 1:2), class = "rotdyn_error_size")
  expect_error(parallel_axis(-1, 2, 1), "row 1", class = "rotdyn_error_value")
  expect_error(parallel_axis(1, c(2, -2), 1), "row 2", class = "rotdyn_error_value")
  expect_error(parallel_axis(1, 2, -1), class = "rotdyn_error_value")
  expect_error(
    parallel_axis(c(3, 1), 2, 1, direction = "to_centre"), "In row 2", class = "rotdyn_error_value"
  )
  expect_error(parallel_axis(1, 2, 3, direction = "away"), class = "rotdyn_error_value")
  expect_error(parallel_axis(1, 2, 3, "to_centre"), class = "rotdyn_error_argument")
  expect_error(parallel_axis(diag(2), 1, c(1, 0, 0)), class = "rotdyn_error_size")
  expect_error(parallel_axis(diag(3), 1, 2), class = "rotdyn_error_size")
  expect_error(parallel_axis(diag(3), -1, c(1, 0, 0)), class = "rotdyn_error_value")
  expect_error(parallel_axis(diag(3), 1, c(1, NA, 0)), class = "rotdyn_error_value")
  expect_error(parallel_axis(diag(3), 1, c(1e200, 0, 0)), class = "rotdyn_error_range")
  for (bad in list(diag(c(1, 1, NA)), diag(c(1, 1, Inf)), matrix(c(9, 1, rep(0, 7)), 3))) {
    expect_error(
      parallel_axis(bad, 1, c(1, 0, 0), direction = "to_centre"), class = "rotdyn_error_inertia"
    )
    expect_error(parallel_axis(bad, 1, c(1, 0, 0)), class = "rotdyn_error_inertia")
  }
  # m d^2 alone is more than it has.
  expect_error(
    parallel_axis(diag(3), 5, c(1, 0, 0), direction = "to_centre"), class = "rotdyn_error_inertia"
  )
})

test_that("NA, NaN and Inf are kept, as in tables; finite numbers beyond double precision warn", {
  expect_warning(
    expect_identical(parallel_axis(c(1, 1), 1, c(1e200, 1)), c(Inf, 2)), "row 1",
    class = "rotdyn_warning_range"
  )
  expect_identical(parallel_axis(c(1, Inf, 1, 1), c(1, 1, Inf, 0), c(0, 2, 2, Inf)),
                   c(1, Inf, Inf, NaN))
  expect_identical(parallel_axis(c(NA, NaN, 1), 1, c(1e200, 1, NA)), c(NA, NaN, NA))
  expect_identical(
    parallel_axis(c(Inf, Inf, NA), 1, c(1e200, Inf, 1), direction = "to_centre"), c(Inf, NaN, NA)
  )
  for (one in list(c(1, Inf), c(Inf, 1), c(1, 1e200))) {
    expect_error(
      parallel_axis(1, one[1], one[2], direction = "to_centre"), "-Inf",
      class = "rotdyn_error_value"
    )
  }
  # The same rule in a table and of a gear.
  expect_identical(
    inertia_table(data.frame(shape = "hoop", mass_kg = c(NA, Inf, 1), radius_m = c(1, 1, NaN))
    )$moment_of_inertia_kg_m2, c(NA, Inf, NaN)
  )
  expect_identical(reflected_inertia(c(NA, Inf, NaN), 2), c(NA, Inf, NaN))
  expect_warning(reflected_inertia(1e200, 1e-200), class = "rotdyn_warning_range")
})

test_that("arrays are numbers, and a direction that is no text is an error", {
  expect_identical(parallel_axis(array(1, c(1, 1, 1)), 2, 1:3), c(3, 9, 19))
  expect_identical(parallel_axis(array(1:2), 1, matrix(c(1, 2), 2)), c(2, 6))
  for (direction in list(sum, quote(x), new.env(), NULL, list(), data.frame(), NA, character())) {
    expect_error(parallel_axis(1, 1, 1, direction = direction), class = "rotdyn_error_value")
  }
})

test_that("a body has its mass, and its moment about its centre of mass", {
  expect_equal(parallel_axis(body_disk(3, 0.2), distance_m = 0.2), 1.5 * 3 * 0.2^2)
  expect_equal(parallel_axis(body_disk(3, 0.2), c(0, 0.2)), c(0.5, 1.5) * 3 * 0.2^2)
  # Not about the end that it names: m l^2/12 + m (l/2)^2.
  expect_equal(parallel_axis(body_rod_end(3, 2), 1), 4)
  expect_equal(parallel_axis(list(body_rod_end(3, 2), body_disk(2, 1)), c(1, 2)), c(4, 9))
  expect_error(parallel_axis(body_disk(3, 0.2), 3, 0.2), class = "rotdyn_error_argument")
  expect_error(parallel_axis(body_disk(3, 0.2)), class = "rotdyn_error_missing")
  expect_error(
    parallel_axis(body_disk(3, 0.2), 0.2, direction = "to_centre"), class = "rotdyn_error_value"
  )
})
