test_that("matrix, six numbers and three moments are the same body", {
  six <- c(ixx = 0.05, iyy = 0.06, izz = 0.07, ixy = 0.01, ixz = -0.002, iyz = 0.003)
  matrix <- matrix(c(0.05, 0.01, -0.002, 0.01, 0.06, 0.003, -0.002, 0.003, 0.07), 3)
  body <- body_tensor(2, six)
  expect_equal(unname(body$inertia_kg_m2), matrix, tolerance = 1e-15)
  expect_identical(body_tensor(2, matrix)$inertia_kg_m2, body$inertia_kg_m2)
  # In any order, with capitals.
  shuffled <- six[c(4, 2, 6, 1, 5, 3)]
  names(shuffled) <- toupper(names(shuffled))
  expect_identical(body_tensor(2, shuffled)$inertia_kg_m2, body$inertia_kg_m2)
  expect_equal(
    unname(body_tensor(2, c(0.05, 0.06, 0.07))$inertia_kg_m2), diag(c(0.05, 0.06, 0.07))
  )
  # Names say which is which, of three as well as of six.
  three <- body_tensor(2, c(izz = 0.07, ixx = 0.05, iyy = 0.06))
  expect_equal(unname(three$inertia_kg_m2), diag(c(0.05, 0.06, 0.07)))
  expect_identical(body_tensor(2, rev(diag(three$inertia_kg_m2))), three)
  names(six) <- paste0(names(six), "_kg_m2")
  expect_identical(body_tensor(2, six)$inertia_kg_m2, body$inertia_kg_m2)
  expect_error(
    body_tensor(2, c(izz = 0.07, ixy = 0, iyy = 0.06)), "names",
    class = "rotdyn_error_size"
  )
  expect_error(body_tensor(2, c(a = 1, b = 1, c = 1)), class = "rotdyn_error_size")
  # The second moment: (tr I)/2 1 - I.
  expect_equal(
    unname(body$second_moment_kg_m2), 0.09 * diag(3) - matrix, tolerance = 1e-15
  )
  expect_equal(body$provenance, "tensor")
  expect_equal(body$mass_kg, 2)
})

test_that("products may be given with either sign", {
  six <- c(ixx = 0.05, iyy = 0.06, izz = 0.07, ixy = 0.01, ixz = -0.002, iyz = 0.003)
  negative <- body_tensor(2, six)
  flipped <- six * c(1, 1, 1, -1, -1, -1)
  expect_identical(
    body_tensor(2, flipped, products = "positive")$inertia_kg_m2, negative$inertia_kg_m2
  )
  expect_equal(body_tensor(2, six, products = "positive")$inertia_kg_m2["x", "y"], -0.01)
  # A tensor that knows its own sign is believed.
  known <- inertia_tensor(negative, products = "positive")
  expect_equal(body_tensor(2, known)$inertia_kg_m2, negative$inertia_kg_m2, tolerance = 1e-15)
})

test_that("a tensor about another point, or in other axes, comes to the centre and the own axes", {
  body <- body_tensor(2, c(0.05, 0.06, 0.07), c(0.1, -0.2, 0.3))
  turn <- rotation_about(c(1, -1, 2), angle_deg = 25)
  for (about in list("origin", c(0.5, 0.5, 0), "centre")) {
    given <- inertia_tensor(body, about, axes = turn)
    back <- body_tensor(2, as.matrix(given), body$centre_m, about = about, axes = turn)
    expect_equal(back$inertia_kg_m2, body$inertia_kg_m2, tolerance = 1e-13)
    expect_equal(back$centre_m, body$centre_m)
    # The error bound knows of the subtraction.
    expect_gte(back$error * 0.18 / 2, max(abs(back$inertia_kg_m2 - body$inertia_kg_m2)))
  }
  # By a quaternion too.
  quarter <- c(sqrt(0.5), 0, 0, sqrt(0.5))
  turned <- body_tensor(2, c(0.05, 0.06, 0.07), axes = quarter)
  expect_equal(diag(turned$inertia_kg_m2), c(x = 0.06, y = 0.05, z = 0.07), tolerance = 1e-15)
})

test_that("the error bound grows by what moving to the centre loses", {
  near <- body_tensor(2, diag(3))
  far <- body_tensor(2, diag(3) + 2e4 * diag(c(0, 1, 1)), c(100, 0, 0), about = "origin")
  expect_gt(far$error, 1e4 * near$error)
  expect_lt(near$error, 1e-14)
})

test_that("a tiny asymmetry is rounding", {
  tensor <- matrix(c(2, 0.1, 0, 0.1 * (1 + 1e-12), 2, 0, 0, 0, 2), 3)
  expect_message(body <- body_tensor(1, tensor), "mean", class = "rotdyn_message_inertia")
  expect_identical(body$inertia_kg_m2["x", "y"], body$inertia_kg_m2["y", "x"])
  expect_equal(body$inertia_kg_m2["x", "y"], 0.1 * (1 + 0.5e-12), tolerance = 1e-15)
  # Which of the two was meant is not known.
  expect_gte(body$error * 3, 0.5e-13)
})

test_that("a rod, a plate, a point and no mass are legal", {
  expect_equal(symmetry_class(body_tensor(1, c(0, 2, 2))), "rod")
  expect_equal(symmetry_class(body_tensor(1, c(1, 2, 3))), "plate")
  expect_equal(symmetry_class(body_tensor(1, c(0, 0, 0))), "point")
  expect_equal(symmetry_class(body_tensor(0, c(0, 0, 0))), "point")
  expect_identical(body_tensor(1, c(0, 0, 0))$error, 0)
  # No word is said where nothing was changed.
  expect_silent(body_tensor(1, c(1, 2, 3)))
})

test_that("what no body can have is refused", {
  expect_error(body_tensor(2, diag(c(0.05, 0.06, 0.7))), class = "rotdyn_error_inertia")
  expect_error(body_tensor(2, c(1, 1, -1e-3)), class = "rotdyn_error_inertia")
  expect_error(body_tensor(2, diag(c(1, NaN, 1))), class = "rotdyn_error_inertia")
  expect_error(body_tensor(2, diag(c(1, NA, 1))), class = "rotdyn_error_inertia")
  expect_error(body_tensor(2, diag(c(1, Inf, 1))), class = "rotdyn_error_inertia")
  # Not symmetric, also where it would be moved or turned first.
  askew <- matrix(c(2, 0.1, 0, 0.2, 2, 0, 0, 0, 2), 3)
  expect_error(body_tensor(1, askew), class = "rotdyn_error_inertia")
  expect_error(body_tensor(1, askew, c(1, 0, 0), about = "origin"), class = "rotdyn_error_inertia")
  turned <- rotation_about("z", angle_deg = 45)
  expect_error(body_tensor(1, askew, axes = turned), class = "rotdyn_error_inertia")
  expect_error(
    body_tensor(1, diag(c(1, NaN, 1)), c(1, 0, 0), about = "origin"), class = "rotdyn_error_inertia"
  )
  # Drake's test of a shift: (2, 3, 4) about P, 1.1 kg, to a centre at (2.234, 3.14, 0.56).
  expect_error(
    body_tensor(1.1, c(2, 3, 4), c(2.234, 3.14, 0.56), about = "origin"),
    class = "rotdyn_error_inertia"
  )
  # Inertia without mass; more than a body of that reach can have.
  expect_error(body_tensor(0, c(1, 1, 1)), class = "rotdyn_error_inertia")
  expect_error(body_tensor(1, c(1, 1, 1), reach_m = 0.1), class = "rotdyn_error_inertia")
  expect_s3_class(body_tensor(1, c(1, 1, 1), reach_m = 1), "rot_body")
})

test_that("the accept and reject list of two engines holds", {
  rows <- read.csv(shared("cases", "inertia_validity", "validity.csv"))
  for (i in seq_len(nrow(rows))) {
    row <- rows[i, ]
    six <- as.double(row[c("Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz")])
    names(six) <- c("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    # Zero needs a mass of its own kind; any will do. Policy rows go by what is computed.
    if (row$recomputed_valid == "True") {
      body <- suppressMessages(body_tensor(1, six))
      expect_equal(
        principal_axes(body)$principal_moment_kg_m2, c(row$p1, row$p2, row$p3), tolerance = 2e-14,
        info = row$id
      )
    } else {
      expect_error(body_tensor(1, six), class = "rotdyn_error_inertia", info = row$id)
    }
  }
  expect_gte(nrow(rows), 18)
})

test_that("bad arguments are refused by class", {
  expect_error(body_tensor(), class = "rotdyn_error_missing")
  expect_error(body_tensor(1), class = "rotdyn_error_missing")
  expect_error(body_tensor(-1, diag(3)), class = "rotdyn_error_value")
  expect_error(body_tensor(NA_real_, diag(3)), class = "rotdyn_error_value")
  expect_error(body_tensor("1", diag(3)), class = "rotdyn_error_type")
  expect_error(body_tensor(1, "diag"), class = "rotdyn_error_type")
  expect_error(body_tensor(1, diag(2)), class = "rotdyn_error_size")
  expect_error(body_tensor(1, 1:6), class = "rotdyn_error_size")
  expect_error(body_tensor(1, numeric()), class = "rotdyn_error_size")
  expect_error(body_tensor(1, c(a = 1, b = 2, c = 3, d = 0, e = 0, f = 0)),
               class = "rotdyn_error_size")
  expect_error(body_tensor(1, diag(3), c(1, 2)), class = "rotdyn_error_size")
  expect_error(body_tensor(1, diag(3), c(1, 2, Inf)), class = "rotdyn_error_value")
  expect_error(body_tensor(1, diag(3), about = "end"), class = "rotdyn_error_value")
  expect_error(body_tensor(1, diag(3), axes = diag(2)), class = "rotdyn_error_type")
  expect_error(body_tensor(1, diag(3), products = "none"), class = "rotdyn_error_value")
  expect_error(body_tensor(1, diag(3), reach_m = -1), class = "rotdyn_error_value")
  expect_error(body_tensor(1, diag(3), c(0, 0, 0), "origin"), class = "rotdyn_error_argument")
  expect_error(
    body_tensor(1, diag(3), c(1e200, 0, 0), about = "origin"), class = "rotdyn_error_range"
  )
})

test_that("a tensor may come with a unit", {
  skip_if_not_installed("units")
  given <- units::set_units(c(500, 600, 700), "kg*cm^2")
  expect_equal(diag(body_tensor(2, given)$inertia_kg_m2), c(x = 0.05, y = 0.06, z = 0.07))
  turned <- matrix(c(5, 1, 0, 1, 6, 0, 0, 0, 7), 3)
  expect_equal(
    body_tensor(2, units::set_units(100 * turned, "kg*cm^2"))$inertia_kg_m2,
    body_tensor(2, turned / 100)$inertia_kg_m2
  )
  expect_error(
    body_tensor(2, units::set_units(c(1, 1, 1), "kg*m")), class = "rotdyn_error_unit"
  )
})

test_that("a tensor that knows its point, axes and signs comes back as the same body", {
  turn <- rotation_about(c(1, 2, 3), angle_deg = 40)
  body <- place_body(body_tensor(2, diag(c(0.05, 0.06, 0.07)), c(0.3, 0, 0.1)), rotation = turn)
  known <- inertia_tensor(
    body,
    about = c(1, 0, 2), axes = rotation_about("x", angle_deg = 25), products = "positive"
  )
  again <- body_tensor(2, known, body$centre_m)
  expect_equal(again$second_moment_kg_m2, body$second_moment_kg_m2, tolerance = 1e-12)
})

test_that("a tensor near the largest double keeps its class and its error", {
  big <- body_tensor(1, diag(3) * 1e308)
  expect_lt(big$error, 1e-14)
  expect_equal(symmetry_class(big), "spherical")
  small <- body_tensor(1, diag(3) * 2^-1000)
  expect_within(small$error, big$error, 1e-6)
})
