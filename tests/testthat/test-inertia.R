# Three points, by hand: 2 kg at (1, 2, 3), 1 kg at (-1, 0, 2), 4 kg at (0, -2, 1). About the
# origin sum m x x' = [3 4 4; 4 24 4; 4 4 26]; the centre is at (1, -4, 12)/7.
three_points <- function() {
  body_tensor(
    7, matrix(c(50, -4, -4, -4, 29, -4, -4, -4, 27), 3), c(1, -4, 12) / 7,
    about = "origin", name = "three points"
  )
}

test_that("a tensor about any point is what the points themselves give", {
  body <- three_points()
  expect_equal(
    unname(as.matrix(inertia_tensor(body, "origin"))),
    matrix(c(50, -4, -4, -4, 29, -4, -4, -4, 27), 3), tolerance = 1e-15
  )
  # About (1, 1, 1): arms (0, 1, 2), (-2, -1, 1), (-1, -3, 0).
  expect_equal(
    unname(as.matrix(inertia_tensor(body, c(1, 1, 1)))),
    matrix(c(
      2 * 5 + 1 * 2 + 4 * 9, -(0 + 2 + 12), -(0 - 2 + 0),
      -14, 2 * 4 + 1 * 5 + 4 * 1, -(4 - 1 + 0),
      2, -3, 2 * 1 + 1 * 5 + 4 * 10
    ), 3),
    tolerance = 1e-15
  )
  # About the centre: m (g'g 1 - g g') less, g = (1, -4, 12)/7.
  expect_equal(inertia_tensor(body)[1, 1], 50 - 160 / 7, tolerance = 1e-15)
  expect_equal(inertia_tensor(body)[1, 2], -4 - 4 / 7, tolerance = 1e-15)
  expect_equal(inertia_tensor(body)[2, 3], -4 - 48 / 7, tolerance = 1e-15)
})

test_that("the products' sign is a choice, and 0 has none", {
  body <- three_points()
  negative <- inertia_tensor(body, "origin")
  positive <- inertia_tensor(body, "origin", products = "positive")
  expect_equal(negative["x", "y"], -4)
  expect_equal(positive["x", "y"], 4)
  expect_identical(diag(as.matrix(negative)), diag(as.matrix(positive)))
  expect_equal(attr(positive, "products"), "positive")
  flat <- inertia_tensor(body_disk(2, 1), products = "positive")
  expect_identical(1 / flat["x", "y"], Inf)
})

test_that("a moment about an axis is n'In of the tensor about its point", {
  body <- three_points()
  point <- c(-0.5, 2, 1)
  tensor <- as.matrix(inertia_tensor(body, point))
  for (n in list(c(1, 0, 0), c(3, 0, 4), c(-1, 2, 5))) {
    u <- n / sqrt(sum(n^2))
    expect_equal(
      moment_of_inertia(body, n, through = point), drop(u %*% tensor %*% u), tolerance = 1e-14
    )
    # Another point of the same axis, and an axis of another length: the same.
    expect_equal(
      moment_of_inertia(body, -1e-200 * n, through = point + 3 * n),
      moment_of_inertia(body, n, through = point), tolerance = 1e-14
    )
  }
  # By hand about the x axis: 2 (4 + 9) + 1 (0 + 4) + 4 (4 + 1).
  expect_equal(moment_of_inertia(body, "x", "origin"), 50, tolerance = 1e-15)
})

test_that("a rod about its end, a disk about its rim", {
  rod <- body_rod(1.5, 2)
  expect_equal(moment_of_inertia(rod, "z", c(1, 0, 0)), 1.5 * 4 / 3)
  expect_equal(moment_of_inertia(rod, "y", c(-1, 5, 0)), 1.5 * 4 / 3)
  expect_equal(moment_of_inertia(body_disk(2, 0.25), "z", c(0, 0.25, 0)), 1.5 * 2 * 0.25^2)
  expect_equal(moment_of_inertia(rod, "x"), 0)
  expect_equal(radius_of_gyration(rod, "z"), 2 / sqrt(12))
  expect_equal(radius_of_gyration(rod, "z", c(1, 0, 0)), 2 / sqrt(3))
})

test_that("a rod about itself has no moment, turned anyhow: never less than 0", {
  set.seed(5)
  for (i in 1:50) {
    n <- rnorm(3)
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, 0, 6))
    rod <- place_body(body_rod(1, 1), rotation = turn)
    moment <- moment_of_inertia(rod, turn[, 1])
    expect_gte(moment, 0)
    expect_lte(moment, 1e-16)
    expect_false(is.nan(radius_of_gyration(rod, turn[, 1])))
  }
})

test_that("turning body and axis together changes no moment", {
  body <- three_points()
  n <- c(1, 2, -0.5)
  point <- c(0.4, -1, 2)
  before <- moment_of_inertia(body, n, point)
  for (angle in c(0.3, 1.7, 2.9)) {
    turn <- rotation_about(c(0.2, -1, 0.6), angle_rad = angle)
    shift <- c(10, -20, 30)
    placed <- place_body(body, shift, turn)
    expect_equal(
      moment_of_inertia(placed, turn %*% n, drop(turn %*% point) + shift), before,
      tolerance = 2e-14
    )
  }
})

test_that("components in other axes are those of a body turned the other way", {
  body <- three_points()
  turn <- rotation_about(c(1, 2, 2), angle_deg = 35)
  seen <- inertia_tensor(body, axes = turn)
  own <- as.matrix(inertia_tensor(body))
  expect_equal(unname(as.matrix(seen)), unname(t(turn) %*% own %*% turn), tolerance = 1e-14)
  expect_equal(
    unname(as.matrix(seen)), unname(place_body(body, rotation = t(turn))$inertia_kg_m2),
    tolerance = 1e-14
  )
  # The x axis of a frame turned by 90 degrees about z is the own y axis.
  quarter <- inertia_tensor(body, axes = rotation_about("z", angle_deg = 90))
  expect_identical(quarter["x", "x"], own["y", "y"])
  expect_identical(quarter["x", "y"], -own["x", "y"])
  principal <- as.matrix(inertia_tensor(body, axes = "principal"))
  expect_equal(
    unname(principal), diag(principal_axes(body)$principal_moment_kg_m2), tolerance = 1e-14
  )
})

test_that("lengths and masses scale as they must, to the ends of the range", {
  body <- three_points()
  for (by in c(2^400, 2^-400)) {
    scaled <- body_tensor(
      7 * by, as.matrix(inertia_tensor(body)) / by, body$centre_m / by
    )
    expect_within(
      as.matrix(inertia_tensor(scaled, "origin")), as.matrix(inertia_tensor(body, "origin")) / by,
      1e-14
    )
    expect_within(
      moment_of_inertia(scaled, c(1, 2, 3), "origin"),
      moment_of_inertia(body, c(1, 2, 3), "origin") / by, 1e-14
    )
  }
  disk <- body_disk(2, 0.25)
  expect_error(inertia_tensor(disk, c(1e200, 0, 0)), class = "rotdyn_error_range")
  expect_error(moment_of_inertia(disk, "z", c(1e200, 0, 0)), class = "rotdyn_error_range")
})

test_that("a massless body has no radius of gyration", {
  expect_identical(radius_of_gyration(body_disk(0, 1), "z"), NaN)
})

test_that("tensors know their point and axes", {
  disk <- body_disk(2, 0.25)
  ball <- body_sphere(1, 0.1)
  sum <- inertia_tensor(disk) + inertia_tensor(ball)
  expect_s3_class(sum, "rot_inertia_tensor")
  expect_equal(sum["z", "z"], 0.0625 + 0.004)
  less <- sum - inertia_tensor(ball)
  expect_equal(as.matrix(less), as.matrix(inertia_tensor(disk)))
  expect_s3_class(2 * sum, "rot_inertia_tensor")
  expect_equal((sum * 2)["x", "x"], 2 * sum["x", "x"])
  expect_equal((sum / 4)["x", "x"], sum["x", "x"] / 4)
  expect_s3_class(sum / 4, "rot_inertia_tensor")
  # What is no inertia tensor does not claim to be one.
  for (bare in list(1 / sum, sum * sum, sum + diag(3), sum == sum, -sum, sum * diag(3), sum^2)) {
    expect_false(inherits(bare, "rot_inertia_tensor"))
  }
  expect_equal(unname(-sum)[3, 3], -0.0665)
  expect_equal(solve(sum)[3, 3], 1 / 0.0665)
  expect_false(is.object(sum[1:2, 1:2]))

  expect_error(
    inertia_tensor(disk) + inertia_tensor(disk, c(1, 0, 0)), class = "rotdyn_error_point"
  )
  expect_error(
    inertia_tensor(disk) - inertia_tensor(place_body(disk, c(0, 0, 1))),
    "subtracted", class = "rotdyn_error_point"
  )
  expect_error(
    inertia_tensor(disk) + inertia_tensor(disk, axes = rotation_about("x", angle_deg = 1)),
    "different axes", class = "rotdyn_error_point"
  )
  expect_error(
    inertia_tensor(disk) + inertia_tensor(disk, products = "positive"), class = "rotdyn_error_point"
  )
  # The same point under two names.
  expect_s3_class(inertia_tensor(disk) + inertia_tensor(disk, "origin"), "rot_inertia_tensor")
  # Tensors that may be added give what joining gives.
  away <- place_body(ball, c(0.3, 0.1, 0))
  expect_equal(
    as.matrix(inertia_tensor(disk, "origin") + inertia_tensor(away, "origin")),
    as.matrix(inertia_tensor(join_bodies(disk, away), "origin")), tolerance = 1e-15
  )
})

test_that("a tensor prints its point, axes and sign", {
  body <- place_body(body_disk(2, 0.25), c(1, 0, 0), rotation_about("x", angle_deg = 90))
  expect_snapshot({
    inertia_tensor(body)
    inertia_tensor(body, "origin")
    inertia_tensor(body, c(0, 0, 0.5), products = "positive")
    inertia_tensor(body, axes = "principal")
  })
})

test_that("the errors say what to do", {
  disk <- body_disk(2, 0.25)
  expect_snapshot(error = TRUE, {
    inertia_tensor(disk) + inertia_tensor(disk, c(1, 0, 0))
    inertia_tensor(disk, "center")
    moment_of_inertia(diag(3), "z")
    moment_of_inertia(disk, c(0, 0, 0))
  })
})

test_that("bad arguments are refused by class", {
  disk <- body_disk(2, 0.25)
  expect_error(inertia_tensor(), class = "rotdyn_error_missing")
  expect_error(inertia_tensor(1), class = "rotdyn_error_type")
  expect_error(moment_of_inertia("disk", "z"), class = "rotdyn_error_type")
  expect_error(radius_of_gyration(NULL, "z"), class = "rotdyn_error_type")
  expect_error(inertia_tensor(disk, about = c(1, 2)), class = "rotdyn_error_size")
  expect_error(inertia_tensor(disk, about = c(1, NA, 2)), class = "rotdyn_error_value")
  expect_error(inertia_tensor(disk, about = c(1, NaN, 2)), class = "rotdyn_error_value")
  expect_error(inertia_tensor(disk, about = c(1, Inf, 2)), class = "rotdyn_error_value")
  expect_error(inertia_tensor(disk, about = list(1, 2, 3)), class = "rotdyn_error_type")
  expect_error(inertia_tensor(disk, about = "rim"), class = "rotdyn_error_value")
  expect_error(inertia_tensor(disk, axes = "body"), class = "rotdyn_error_value")
  expect_error(inertia_tensor(disk, axes = diag(2)), class = "rotdyn_error_type")
  expect_error(inertia_tensor(disk, products = "plus"), class = "rotdyn_error_value")
  expect_error(inertia_tensor(disk, "centre", "own"), class = "rotdyn_error_argument")
  expect_error(moment_of_inertia(disk, "q"), class = "rotdyn_error_value")
  expect_error(moment_of_inertia(disk, c(1, 0)), class = "rotdyn_error_value")
  expect_error(moment_of_inertia(disk, c(1, NA, 0)), class = "rotdyn_error_value")
  expect_error(moment_of_inertia(disk, TRUE), class = "rotdyn_error_type")
  expect_error(moment_of_inertia(disk, "z", through = "rim"), class = "rotdyn_error_value")
  expect_error(moment_of_inertia(disk, "z", through = 1), class = "rotdyn_error_size")
})

test_that("points may come with a unit", {
  skip_if_not_installed("units")
  disk <- body_disk(2, 0.25)
  expect_equal(
    moment_of_inertia(disk, "z", units::set_units(c(25, 0, 0), "cm")),
    moment_of_inertia(disk, "z", c(0.25, 0, 0))
  )
  expect_error(
    moment_of_inertia(disk, "z", units::set_units(c(25, 0, 0), "kg")), class = "rotdyn_error_unit"
  )
})

test_that("a sign convention that is no text is an error of this package", {
  expect_error(inertia_tensor(body_disk(1, 1), products = sum), class = "rotdyn_error_value")
  expect_error(body_tensor(1, diag(3), products = sum), class = "rotdyn_error_value")
})

test_that("errors and range checks name the function that was called", {
  d <- body_disk(2, 0.3)
  called <- function(expr) {
    error <- tryCatch(expr, rotdyn_error = identity)
    deparse(conditionCall(error)[[1]])
  }
  expect_equal(called(radius_of_gyration(d, "z", through = 1)), "radius_of_gyration")
  expect_equal(called(radius_of_gyration(d, "w")), "radius_of_gyration")
  expect_equal(called(radius_of_gyration(d, "z", c(1e200, 0, 0))), "radius_of_gyration")
  expect_equal(called(moment_of_inertia(d, "z", through = "here")), "moment_of_inertia")
  expect_equal(called(symmetry_class(diag(c(1, 1, 3)))), "symmetry_class")
  expect_equal(called(symmetry_class(d, tolerance = 2)), "symmetry_class")
  expect_equal(called(inertia_tensor(d) + inertia_tensor(d, c(1, 0, 0))), "+")
  tilted <- rotation_about("x", angle_rad = 1)
  expect_equal(called(inertia_tensor(d) - inertia_tensor(d, axes = tilted)), "-")
})

test_that("print shows no roundings off the diagonal of a turned tensor", {
  turn <- rotation_about(c(1, 1, 1), angle_deg = 40)
  box <- place_body(body_box(2, 0.3, 0.2, 0.1), rotation = turn)
  tensor <- inertia_tensor(box, axes = "principal")
  expect_gt(max(abs(as.matrix(tensor)[upper.tri(tensor)])), 0)
  shown <- capture.output(print(tensor))
  expect_false(any(grepl("e-", shown, fixed = TRUE)))
})

test_that("the axis is z where none is given, as that of an axle", {
  expect_identical(moment_of_inertia(body_disk(2, 0.5)), 0.25)
  expect_identical(radius_of_gyration(body_hoop(2, 0.5)), 0.5)
  e <- expect_error(rotation_about(angle_deg = 3), class = "rotdyn_error_missing")
  expect_match(cli::ansi_strip(conditionMessage(e)), '"x", "y", or "z"', fixed = TRUE)
})

test_that("an axis beside the own one is said, with the moment about that", {
  wheel <- join_bodies(body_disk(500, 2), place_body(body_point(25), c(1, 0, 0)))
  said <- function(expr) {
    tryCatch({
      expr
      ""
    }, rotdyn_message_axle = function(m) cli::ansi_strip(conditionMessage(m)))
  }
  # I = m R^2/2 + M d^2 about the own axis.
  expect_match(said(moment_of_inertia(wheel)), "about the own axis it is 1025 kg m^2", fixed = TRUE)
  expect_identical(said(moment_of_inertia(wheel, through = "centre")), "")
  expect_identical(said(moment_of_inertia(wheel, "x")), "")
  expect_identical(said(moment_of_inertia(body_rod_end(1, 2))), "")
  expect_equal(moment_of_inertia(wheel, through = "origin"), 1025)
})
