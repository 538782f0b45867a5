classes <- function() {
  list(
    point = body_disk(2, 0), rod = body_rod(2, 1), plate = body_disk(2, 0.25),
    plate = body_tensor(2, c(0.1, 0.2, 0.3)), spherical = body_sphere(2, 0.3),
    oblate = body_tensor(2, c(0.2, 0.2, 0.3)), prolate = body_tensor(2, c(0.1, 0.3, 0.3)),
    asymmetric = body_tensor(2, c(0.2, 0.25, 0.3))
  )
}

test_that("the class is named, whatever way the body is turned", {
  for (name in names(classes())) {
    expect_equal(symmetry_class(classes()[[name]]), name)
  }
  set.seed(7)
  for (i in 1:20) {
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, 0, 6))
    bodies <- classes()
    for (k in seq_along(bodies)) {
      placed <- place_body(bodies[[k]], runif(3), turn)
      expect_equal(symmetry_class(placed), names(bodies)[k])
      expect_equal(principal_axes(placed)$unique, principal_axes(bodies[[k]])$unique)
    }
  }
})

test_that("a disk with a weight on its axis is oblate, with far weights prolate", {
  disk <- body_disk(2, 0.25)
  weights <- function(z) {
    lapply(c(-z, z), function(z) place_body(body_sphere(0.5, 0), c(0, 0, z)))
  }
  # 2 c_xx = m r^2/2 = 0.0625 against c_zz = 2 * 0.5 z^2.
  expect_equal(symmetry_class(join_bodies(disk, weights(0.1))), "oblate")
  expect_equal(symmetry_class(join_bodies(disk, weights(1))), "prolate")
  expect_equal(symmetry_class(join_bodies(disk, weights(sqrt(0.03125)))), "spherical")
})

test_that("moments ascend and are sums of second moments", {
  axes <- principal_axes(body_tensor(2, c(0.3, 0.2, 0.25)))
  expect_named(axes, rotdyn:::principal_columns)
  expect_equal(setdiff(names(axes), column_table()$name), character())
  expect_equal(axes$axis, 1:3)
  expect_equal(axes$principal_moment_kg_m2, c(0.2, 0.25, 0.3), tolerance = 1e-15)
  expect_equal(axes$second_moment_kg_m2, c(0.175, 0.125, 0.075), tolerance = 1e-15)
  # Axis 1 is y, axis 2 is z, axis 3 is x.
  expect_identical(attr(axes, "axes"), matrix(c(0, 1, 0, 0, 0, 1, 1, 0, 0), 3))
  expect_equal(axes$unique, c(TRUE, TRUE, TRUE))
})

test_that("a known tensor: eigenvalues 1, 3, 4 by hand", {
  # (2, 3) block [3.5 0.5; 0.5 3.5] has 3 and 4 along (0, 1, -1) and (0, 1, 1).
  tensor <- matrix(c(1, 0, 0, 0, 3.5, 0.5, 0, 0.5, 3.5), 3)
  axes <- principal_axes(tensor)
  expect_equal(axes$principal_moment_kg_m2, c(1, 3, 4), tolerance = 1e-15)
  expect_equal(c(axes$x[1], axes$y[1], axes$z[1]), c(1, 0, 0))
  expect_equal(c(axes$x[2], axes$y[2], axes$z[2]), c(0, 1, -1) / sqrt(2), tolerance = 1e-15)
  expect_equal(c(axes$x[3], axes$y[3], axes$z[3]), c(0, 1, 1) / sqrt(2), tolerance = 1e-15)
  expect_equal(attr(axes, "symmetry"), "plate")
})

test_that("axes are right-handed and diagonalise; the largest component is positive", {
  set.seed(2)
  for (i in 1:50) {
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, 0, 6))
    body <- place_body(body_tensor(1, c(0.2, 0.25, 0.3)), c(0, 0, 0), turn)
    axes <- principal_axes(body)
    v <- attr(axes, "axes")
    expect_lte(max(abs(crossprod(v) - diag(3))), 2e-15)
    expect_equal(det(v), 1, tolerance = 1e-14)
    expect_equal(v %*% diag(axes$principal_moment_kg_m2) %*% t(v), unname(body$inertia_kg_m2),
                 tolerance = 2e-15)
    for (k in 1:2) expect_gt(v[which.max(abs(v[, k])), k], 0)
    # The columns of the table are the columns of the attribute.
    expect_identical(unname(rbind(axes$x, axes$y, axes$z)), v)
    # It is the turn itself, up to signs.
    expect_equal(abs(diag(crossprod(turn, v))), rep(1, 3), tolerance = 1e-13)
  }
})

test_that("the second moment keeps what the moments lose", {
  # A needle: c = 1, 1e-14, 1e-20. Its least moment is 1e-14, its middle and largest 1.
  needle <- rotdyn:::new_body("needle", 1, c(1, 1e-14, 1e-20, 0, 0, 0))
  axes <- principal_axes(needle)
  expect_within(axes$second_moment_kg_m2, c(1, 1e-14, 1e-20), 1e-15)
  expect_equal(axes$principal_moment_kg_m2[1], 1e-14 + 1e-20, tolerance = 1e-15)
  # A plate's law holds to the last bit.
  plate <- principal_axes(body_disk(0.3, 0.7))
  expect_identical(sum(plate$principal_moment_kg_m2[1:2]), plate$principal_moment_kg_m2[3])
})

test_that("equal moments take the axes nearest to the own ones, and say so", {
  disk <- principal_axes(body_disk(2, 0.25))
  expect_identical(attr(disk, "axes"), diag(3))
  expect_equal(disk$unique, c(FALSE, FALSE, TRUE))
  rod <- principal_axes(place_body(body_rod(2, 1), rotation = rotation_about("x", angle_deg = 70)))
  expect_equal(attr(rod, "axes"), diag(3))
  expect_equal(rod$unique, c(TRUE, FALSE, FALSE))
  expect_equal(principal_axes(body_sphere(1, 1))$unique, c(FALSE, FALSE, FALSE))
})

test_that("what cannot be told apart is not told apart", {
  near <- body_tensor(2, c(0.2, 0.2 * (1 + 1e-10), 0.3))
  expect_equal(symmetry_class(near), "asymmetric")
  expect_equal(symmetry_class(near, tolerance = 1e-9), "oblate")
  near$error <- 1e-8
  expect_equal(symmetry_class(near), "oblate")
  expect_equal(symmetry_class(near, tolerance = 0), "asymmetric")
  # Moments 0.2 (1 + 1e-13) and 0.2 are within the default.
  expect_equal(symmetry_class(body_tensor(2, c(0.2, 0.2 * (1 + 1e-13), 0.3))), "oblate")
})

test_that("moving a body changes no principal moment, nor any class", {
  body <- body_tensor(2, c(0.2, 0.25, 0.3))
  expect_identical(principal_axes(place_body(body, c(1e8, -1e8, 1))), principal_axes(body))
})

test_that("it prints its class", {
  expect_snapshot({
    principal_axes(body_disk(2, 0.25))
    principal_axes(body_sphere(2, 0.25))
    principal_axes(body_rod(2, 0.25))
  })
  axes <- principal_axes(body_disk(2, 0.25))
  expect_output(print(axes[c("axis", "x")]), "axis +x")
  expect_output(print(axes[1:2, ]), "A tibble: 2")
})

test_that("bad arguments are refused by class", {
  disk <- body_disk(2, 0.25)
  expect_error(principal_axes("disk"), class = "rotdyn_error_type")
  expect_error(principal_axes(diag(2)), class = "rotdyn_error_size")
  expect_error(principal_axes(disk, tolerance = -1), class = "rotdyn_error_value")
  expect_error(principal_axes(disk, tolerance = NA_real_), class = "rotdyn_error_value")
  expect_error(principal_axes(disk, tolerance = "small"), class = "rotdyn_error_type")
  expect_error(principal_axes(disk, 0.1), class = "rotdyn_error_argument")
  expect_error(symmetry_class(disk, 0.1), class = "rotdyn_error_argument")
  expect_error(symmetry_class(NULL), class = "rotdyn_error_type")
  for (bad in list(diag(c(1, 1, 3)), diag(c(1, NA, 1)), diag(c(-1, 1, 1)))) {
    expect_error(principal_axes(bad), class = "rotdyn_error_inertia")
    expect_error(symmetry_class(bad), class = "rotdyn_error_inertia")
  }
})

test_that("what was left out is named", {
  expect_error(principal_axes(), class = "rotdyn_error_missing")
  expect_error(symmetry_class(), class = "rotdyn_error_missing")
})

test_that("a body whose error is as large as itself has no class", {
  # What is left of the ball is a rounding: 2^-50 of its mass.
  left <- cut_body(body_sphere(1, 1), body_sphere(1 - 2^-50, 1 - 2^-51))
  expect_gt(left$error, 0.5)
  expect_equal(symmetry_class(left), "unknown")
  expect_output(print(left), "the error is as large")
  expect_equal(symmetry_class(body_sphere(1, 1e-170)), "unknown")
  # A tolerance of the user's own is taken at its word.
  expect_no_match(symmetry_class(left, tolerance = 1e-12), "unknown")
})

test_that("no principal moment of a body is negative, however it was turned", {
  set.seed(9)
  least <- vapply(1:200, function(i) {
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, -3, 3))
    rod <- place_body(body_rod(2, 1), rotation = turn)
    pair <- join_bodies(place_body(body_point(1), rnorm(3)), place_body(body_point(2), rnorm(3)))
    expect_equal(symmetry_class(pair), "rod")
    both <- rbind(principal_axes(rod), principal_axes(pair))
    min(both$principal_moment_kg_m2, both$second_moment_kg_m2)
  }, 0)
  expect_gte(min(least), 0)
})

test_that("print shows no second moment across a plate, the table keeps the rounding", {
  # In the plane through (1, 2, 3), (-1, 0, 1) and the centre: not along the axes.
  at <- rbind(c(1, 2, 3), c(-1, 0, 1), c(0.3, 0.7, -0.2))
  axes <- principal_axes(body_points(at, mass_kg = c(0.1, 0.7, 1.3)))
  expect_lt(abs(axes$second_moment_kg_m2[3]), 1e-15)
  shown <- capture.output(print(axes))
  expect_match(shown[1], "plate")
  expect_false(any(grepl("e-", shown, fixed = TRUE)))
})

test_that("a slender rod in any direction has moments 0, I, I", {
  # A rounding error below 0 of the smallest second moment is removed from the moments, too.
  below <- 0
  for (i in 1:40) {
    u <- c(i, 7 - i, 3.3) / sqrt(i^2 + (7 - i)^2 + 3.3^2)
    rod <- body_rod(12, 1)
    rod$second_moment_kg_m2 <- outer(u, u)
    below <- below + (.Call(rotdyn:::ffi_inertia_principal, outer(u, u), 1e-12)$second[3] < 0)
    axes <- principal_axes(rod)
    expect_equal(axes$principal_moment_kg_m2, c(0, 1, 1), tolerance = 1e-14)
    expect_gte(min(axes$second_moment_kg_m2), 0)
  }
  expect_gt(below, 0)
})

test_that("a plate in any direction has moments 1, 3, 4", {
  # A rounding error below 0 across the plate is removed; the moments are sums of the other two.
  below <- 0
  for (i in 1:40) {
    u <- c(i, 7 - i, 3.3) / sqrt(i^2 + (7 - i)^2 + 3.3^2)
    w <- c(7 - i, -i, 0) / sqrt(i^2 + (7 - i)^2)
    second <- 3 * outer(u, u) + outer(w, w)
    plate <- body_rod(12, 1)
    plate$second_moment_kg_m2 <- second
    below <- below + (.Call(rotdyn:::ffi_inertia_principal, second, 1e-12)$second[3] < 0)
    expect_equal(principal_axes(plate)$principal_moment_kg_m2, c(1, 3, 4), tolerance = 1e-14)
  }
  expect_gt(below, 0)
})
