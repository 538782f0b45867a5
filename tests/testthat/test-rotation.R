test_that("a rotation turns counter-clockwise as seen from the axis's tip", {
  quarter <- rotation_about("z", angle_deg = 90)
  expect_identical(as.double(quarter %*% c(1, 0, 0)), c(0, 1, 0))
  expect_identical(as.double(quarter %*% c(0, 1, 0)), c(-1, 0, 0))
  expect_identical(as.double(rotation_about("x", angle_deg = 90) %*% c(0, 1, 0)), c(0, 0, 1))
  expect_identical(as.double(rotation_about("y", angle_deg = 90) %*% c(0, 0, 1)), c(1, 0, 0))
  third <- rotation_about(c(1, 1, 1), angle_deg = 120)
  expect_equal(as.double(third %*% c(1, 0, 0)), c(0, 1, 0), tolerance = 1e-15)
})

test_that("radians and degrees agree, and whole turns drop out exactly", {
  n <- c(0.3, -2, 0.7)
  expect_equal(rotation_about(n, angle_rad = 0.7), rotation_about(n, angle_deg = 126 / pi))
  expect_identical(rotation_about(n, angle_deg = 30), rotation_about(n, angle_deg = 30 + 360 * 1e9))
  # 1e15 = 280 (mod 360)
  expect_equal(
    rotation_about("z", angle_deg = 1e15), rotation_about("z", angle_deg = -80), tolerance = 1e-15
  )
  expect_identical(rotation_about("z", angle_rad = 0), diag(3))
})

test_that("a rotation is orthogonal, and small angles keep their digits", {
  for (angle in c(1e-9, 0.1, 1, 3, 3.14159, -2)) {
    turn <- rotation_about(c(1, -2, 0.5), angle_rad = angle)
    expect_lte(max(abs(crossprod(turn) - diag(3))), 1e-15)
    expect_equal(det(turn), 1, tolerance = 1e-15)
    expect_equal(as.double(turn %*% c(1, -2, 0.5)), c(1, -2, 0.5), tolerance = 1e-15)
  }
  # 1 - cos(1e-9) = 5e-19
  tiny <- rotation_about("z", angle_rad = 1e-9)
  expect_equal(tiny[2, 1], 1e-9, tolerance = 1e-15)
  # The length of the axis does not matter.
  expect_equal(rotation_about(c(0, 0, 1e-300), angle_rad = 1), rotation_about("z", angle_rad = 1))
  expect_equal(rotation_about(c(0, 1e300, 0), angle_rad = 1), rotation_about("y", angle_rad = 1))
})

test_that("a quaternion is the same rotation, scalar first", {
  body <- body_tensor(2, c(0.05, 0.06, 0.07), c(1, 2, 3))
  angle <- 0.8
  n <- c(2, -1, 2) / 3
  by_matrix <- place_body(body, rotation = rotation_about(n, angle_rad = angle))
  by_quaternion <- place_body(body, rotation = c(cos(angle / 2), sin(angle / 2) * n))
  expect_equal(by_quaternion$inertia_kg_m2, by_matrix$inertia_kg_m2, tolerance = 1e-14)
  expect_equal(by_quaternion$centre_m, by_matrix$centre_m, tolerance = 1e-14)
  minus <- place_body(body, rotation = -c(cos(angle / 2), sin(angle / 2) * n))
  expect_equal(minus$inertia_kg_m2, by_quaternion$inertia_kg_m2, tolerance = 1e-15)
})

test_that("a rotation given to nine digits is brought to the nearest one", {
  exact <- rotation_about(c(1, 2, 3), angle_deg = 40)
  rough <- round(exact, 9)
  body <- body_tensor(2, c(0.05, 0.06, 0.07))
  placed <- place_body(body, rotation = rough)
  expect_gt(max(abs(crossprod(rough) - diag(3))), 1e-10)
  expect_equal(
    principal_axes(placed)$principal_moment_kg_m2, c(0.05, 0.06, 0.07), tolerance = 2e-15
  )
  # One that is exact stays as it is.
  quarter <- rotation_about("y", angle_deg = 90)
  expect_identical(rotdyn:::as_rotation(quarter, "rotation", NULL), quarter)
})

test_that("what is no rotation is refused by class", {
  body <- body_disk(2, 0.25)
  turn <- function(rotation) place_body(body, rotation = rotation)
  expect_error(turn("z"), class = "rotdyn_error_type")
  expect_error(turn(diag(2)), "must be a 3 x 3 rotation", class = "rotdyn_error_type")
  expect_error(turn(1:3), class = "rotdyn_error_type")
  expect_error(turn(as.double(diag(3))), class = "rotdyn_error_type")
  expect_error(turn(TRUE), class = "rotdyn_error_type")
  expect_error(turn(diag(c(1, 1, NA))), class = "rotdyn_error_value")
  expect_error(turn(diag(c(1, 1, Inf))), class = "rotdyn_error_value")
  expect_error(turn(diag(c(1, 1, -1))), "reflection", class = "rotdyn_error_value")
  for (factor in c(1.001, 1 + 2e-7)) {
    expect_error(turn(factor * diag(3)), "differs from 1", class = "rotdyn_error_value")
  }
  expect_no_error(turn((1 + 2e-9) * diag(3)))
  expect_error(turn(c(1, 1, 0, 0)), "unit quaternion", class = "rotdyn_error_value")
  expect_error(turn(c(0, 0, 0, 0)), "unit quaternion", class = "rotdyn_error_value")
  expect_error(rotation_about(), class = "rotdyn_error_missing")
  expect_error(rotation_about("z"), class = "rotdyn_error_missing")
  expect_error(rotation_about("z", angle_rad = 1, angle_deg = 2), class = "rotdyn_error_value")
  expect_error(rotation_about("w", angle_rad = 1), class = "rotdyn_error_value")
  expect_error(rotation_about(c(0, 0, 0), angle_rad = 1), class = "rotdyn_error_value")
  expect_error(rotation_about(c(0, 1), angle_rad = 1), class = "rotdyn_error_value")
  expect_error(rotation_about(c(0, NA, 1), angle_rad = 1), class = "rotdyn_error_value")
  expect_error(rotation_about(list(1), angle_rad = 1), class = "rotdyn_error_type")
  expect_error(rotation_about("z", angle_rad = Inf), class = "rotdyn_error_value")
  expect_error(rotation_about("z", angle_deg = NaN), class = "rotdyn_error_value")
  expect_error(rotation_about("z", angle_deg = "9"), class = "rotdyn_error_type")
  expect_error(rotation_about("z", angle_rad = c(1, 2)), class = "rotdyn_error_size")
})

test_that("angles may come with a unit", {
  skip_if_not_installed("units")
  expect_equal(
    rotation_about("z", angle_rad = units::set_units(90, "degree")),
    rotation_about("z", angle_deg = 90)
  )
  expect_error(
    rotation_about("z", angle_rad = units::set_units(1, "m")), class = "rotdyn_error_unit"
  )
})

test_that("degrees: any number of turns, of either sense, and small angles", {
  expect_silent(big <- rotation_about("z", angle_deg = 1e300))
  # 1e300 mod 360 = 280, and 1e15 + 1 mod 360 = 281: integer arithmetic in Python.
  expect_silent(expect_equal(rotation_about("z", angle_deg = 1e15 + 1)[1, 1], cospi(281 / 180)))
  expect_equal(max(abs(crossprod(big) - diag(3))), 0, tolerance = 1e-15)
  expect_ulps(rotation_about("z", angle_deg = -1e-20)[2, 1], -1e-20 * pi / 180, 1)
  expect_identical(
    rotation_about("z", angle_deg = -0.1)[2, 1], -rotation_about("z", angle_deg = 0.1)[2, 1]
  )
  expect_identical(rotation_about("x", angle_deg = -270), rotation_about("x", angle_deg = 90))
  expect_identical(rotation_about("x", angle_deg = 360 * 2^60), diag(3))
})

test_that("an angle has its unit", {
  expect_error(rotation_about("z", 30), class = "rotdyn_error_argument")
  expect_error(rotation_about("z", angle = 30), class = "rotdyn_error_argument")
})

test_that("a rotation is also a row of attitude_from()", {
  row <- attitude_from(c(1, 2, 2, 0.7), "axis_angle")
  plate <- body_box(1, 1, 2, 3)
  turn <- rotation_about(c(1, 2, 2), angle_rad = 0.7)
  expect_equal(inertia_tensor(place_body(plate, rotation = row)),
               inertia_tensor(place_body(plate, rotation = turn)), tolerance = 1e-15)
  two <- rbind(row, row)
  expect_error(place_body(plate, rotation = two), class = "rotdyn_error_size")
  expect_error(place_body(plate, rotation = data.frame(x = 1)), class = "rotdyn_error_type")
})
