test_that("the published list of valid and invalid tensors is told apart", {
  cases <- utils::read.csv(shared("cases", "inertia_validity", "validity.csv"))
  for (i in seq_len(nrow(cases))) {
    check <- check_inertia(cases[i, ])
    # 1.4e-14 beyond the plate: what Drake refuses, rounding may do.
    valid <- cases$published_valid[i] == "True" || cases$id[i] == "drake_246plus"
    expect_equal(holds(check), valid, info = cases$id[i])
    if (!is.na(cases$p1[i])) {
      p <- unlist(cases[i, c("p1", "p2", "p3")])
      largest <- max(abs(p), 1e-300)
      expect_lte(abs(at(check, "positive semidefinite")$value - p[1]), 4e-15 * largest)
      expect_lte(
        abs(at(check, "triangle inequality")$value - (p[1] + p[2] - p[3])), 1e-14 * largest
      )
    }
  }
  expect_equal(
    at(check_inertia(cases[cases$id == "drake_246plus", ]), "triangle inequality")$verdict,
    "holds within rounding"
  )
})

test_that("what the diagonal does not tell is found", {
  # Drake's rotational_inertia_test.cc @ be259df7: the principal moments are published there.
  check <- check_inertia(six(34, 13, 10, -3, -3, -6))
  expect_equal(
    at(check, "triangle inequality")$value,
    4.709552639531104 + 17.66953281292159 - 34.620914547547315,
    tolerance = 1e-14
  )
  expect_equal(
    at(check, "triangle inequality")$margin, -12.241829095 / 34.6209145475, tolerance = 1e-9
  )
  # Positive definite, every sum of the diagonal legal: 2 - sqrt 2, 2, 2 + sqrt 2.
  check <- check_inertia(six(2, 2, 2, -1, 0, -1))
  expect_equal(at(check, "positive semidefinite")$verdict, "holds")
  expect_equal(at(check, "triangle inequality")$verdict, "fails")
  expect_equal(at(check, "triangle inequality")$value, 2 - 2 * sqrt(2), tolerance = 1e-14)
  # The sign of the products decides.
  talos <- six(1.15e-4, 1.53e-4, 1.9e-4, 5.2e-5, 2.5e-5, 3.4e-5)
  expect_false(holds(check_inertia(talos)))
  expect_true(holds(check_inertia(talos, products = "positive")))
})

test_that("rounding is let pass, and said", {
  verdict <- function(excess) {
    at(check_inertia(c(1, 1, 2 + 2 * excess)), "triangle inequality")$verdict
  }
  expect_equal(
    vapply(c(-1e-3, 0, 2^-52, 1e-14, 9e-13, 1.1e-12, 1e-6), verdict, ""),
    c("holds", "holds", "holds", rep("holds within rounding", 2), "fails", "fails")
  )
  asymmetric <- function(by) {
    check <- check_inertia(matrix(c(2, 0.5, 0, 0.5 + by, 3, 0, 0, 0, 4), 3))
    at(check, "symmetric")
  }
  expect_equal(asymmetric(0)$verdict, "holds")
  expect_equal(asymmetric(2e-12)$verdict, "holds within rounding")
  expect_within(asymmetric(2e-12)$value, 5e-13, 1e-3)
  expect_equal(asymmetric(5e-12)$verdict, "fails")
})

test_that("points, rods and plates are legal", {
  expect_match(at(check_inertia(c(0, 0, 0)), "triangle inequality")$meaning, "^a point")
  expect_match(at(check_inertia(c(0, 2, 2)), "triangle inequality")$meaning, "^a rod")
  expect_match(at(check_inertia(c(1, 2, 3)), "triangle inequality")$meaning, "^a plate")
  expect_match(at(check_inertia(c(1, 2, 2.9)), "triangle inequality")$meaning, "^no principal")
  expect_true(all(vapply(
    list(body_disk(2, 0.3), body_rod(1, 2), body_sphere(1, 1e-3), body_hoop(0, 1)),
    function(body) holds(check_inertia(body)), TRUE
  )))
})

test_that("verdicts do not depend on the scale", {
  for (scale in c(1e-300, 1e-12, 1e300)) {
    good <- check_inertia(scale * six(17, 13, 10, -3, -3, -6))
    bad <- check_inertia(scale * six(34, 13, 10, -3, -3, -6))
    expect_true(holds(good))
    expect_false(holds(bad))
    expect_equal(
      at(bad, "triangle inequality")$margin,
      at(check_inertia(six(34, 13, 10, -3, -3, -6)), "triangle inequality")$margin,
      tolerance = 1e-13
    )
  }
  expect_true(holds(check_inertia(rep(1.7e308, 3))))
  expect_true(holds(check_inertia(matrix(1.2e308 * diag(3), 3), mass_kg = 1e-300)))
})

test_that("what is not finite fails, and nothing else is claimed", {
  for (bad in c(NA, NaN, Inf, -Inf)) {
    check <- check_inertia(six(bad, 13, 10))
    expect_equal(at(check, "finite")$verdict, "fails")
    expect_equal(check$verdict[2:4], rep("not checked", 3))
    expect_equal(nrow(inertia_repairs(check)), 0L)
  }
  check <- check_inertia(c(1, 1, 1), mass_kg = NaN, size_m = 1)
  expect_equal(at(check, "mass")$verdict, "fails")
  expect_equal(nrow(at(check, "size")), 0L)
})

test_that("mass and size are checked where they are known", {
  expect_equal(at(check_inertia(c(1, 1, 1), mass_kg = 0), "mass")$verdict, "fails")
  expect_equal(at(check_inertia(c(0, 0, 0), mass_kg = 0), "mass")$verdict, "holds")
  expect_equal(at(check_inertia(c(1, 1, 1), mass_kg = -2), "mass")$verdict, "fails")
  expect_equal(nrow(at(check_inertia(c(1, 1, 1), mass_kg = NA), "mass")), 0L)
  # A rod of 3 kg and 2 m: m l^2/12 = 1, radius of gyration l/sqrt(12).
  check <- check_inertia(c(0, 1, 1), mass_kg = 3, size_m = 1)
  expect_equal(at(check, "size")$value, sqrt(1 / 3))
  expect_equal(at(check, "size")$margin, 1 - sqrt(1 / 3))
  expect_true(holds(check))
  expect_false(holds(check_inertia(c(0, 1, 1), mass_kg = 3, size_m = 0.57)))
  # A dumbbell reaches its limit.
  expect_true(holds(check_inertia(c(0, 8, 8), mass_kg = 2, size_m = 2)))
  disk <- check_inertia(body_disk(2, 0.3))
  expect_equal(at(disk, "mass")$value, 2)
})

test_that("tables have a row a condition, with names, masses and sizes of their own", {
  table <- data.frame(
    object = c("a", "b"), Ixx_kg_m2 = 1:2, Iyy_kg_m2 = 1, Izz_kg_m2 = c(1, 9),
    mass_kg = c(2, NA), size_m = c(1, 1)
  )
  check <- check_inertia(table)
  expect_equal(check$row, rep(1:2, c(6, 4)))
  expect_equal(unique(check$object), c("a", "b"))
  expect_setequal(setdiff(names(check), column_table()$name), character())
  expect_setequal(setdiff(names(inertia_repairs(check)), column_table()$name), character())
  expect_equal(check_inertia(table, mass_kg = 7)$value[5], 7)
  expect_equal(unique(check_inertia(table, name = c("p", "q"))$object), c("p", "q"))
  empty <- check_inertia(table[0, ])
  expect_equal(dim(empty), c(0L, 9L))
  expect_equal(vapply(empty, typeof, ""), vapply(check, typeof, ""))
  # With products, in any order of columns, either sign.
  wide <- data.frame(iyz = 3.4, izz = 19, ixx = 11.5, iyy = 15.3, ixz = 2.5, ixy = 5.2)
  expect_false(holds(check_inertia(wide)))
  expect_true(holds(check_inertia(wide, products = "positive")))
})

test_that("vectors, matrices and units say the same", {
  moments <- six(17, 13, 10, -3, -2, -6)
  matrix <- matrix(c(17, -3, -2, -3, 13, -6, -2, -6, 10), 3)
  expect_equal(check_inertia(moments)$value, check_inertia(matrix)$value)
  expect_equal(check_inertia(rev(moments))$value, check_inertia(matrix)$value)
  expect_equal(check_inertia(c(1, 2, 2.5))$value, check_inertia(diag(c(1, 2, 2.5)))$value)
  # A tensor that knows its own sign.
  body <- body_tensor(2, matrix)
  expect_equal(check_inertia(inertia_tensor(body))$value, check_inertia(matrix)$value)
  expect_equal(
    check_inertia(inertia_tensor(body, products = "positive"))$value, check_inertia(matrix)$value
  )
  skip_if_not_installed("units")
  grams <- units::set_units(1e3 * c(1, 2, 2.5), "g*m^2", mode = "standard")
  expect_equal(check_inertia(grams)$value, check_inertia(c(1, 2, 2.5))$value)
  expect_error(
    check_inertia(units::set_units(1:3, "kg*m", mode = "standard")), class = "rotdyn_error_unit"
  )
})

test_that("what is no tensor is an error", {
  expect_error(check_inertia(), class = "rotdyn_error_missing")
  expect_error(check_inertia("1"), class = "rotdyn_error_type")
  expect_error(check_inertia(1:4), class = "rotdyn_error_size")
  expect_error(check_inertia(matrix(1, 2, 2)), class = "rotdyn_error_size")
  expect_error(check_inertia(c(1, 2, 3, 0, 0, 0)), class = "rotdyn_error_value")
  expect_error(check_inertia(c(a = 1, b = 2, c = 3)), class = "rotdyn_error_value")
  expect_error(check_inertia(data.frame(ixx = 1, iyy = 1)), class = "rotdyn_error_type")
  expect_error(
    check_inertia(data.frame(ixx = 1, iyy = 1, izz = 1, ixy = 0)), class = "rotdyn_error_type"
  )
  expect_error(check_inertia(1:3, size_m = 0), class = "rotdyn_error_value")
  expect_error(check_inertia(1:3, size_m = NaN), class = "rotdyn_error_value")
  expect_error(check_inertia(1:3, mass_kg = 1:2), class = "rotdyn_error_size")
  expect_error(check_inertia(1:3, name = 1), class = "rotdyn_error_type")
  expect_error(check_inertia(1:3, products = "both"), class = "rotdyn_error_value")
  expect_error(inertia_repairs(1), class = "rotdyn_error_type")
})

test_that("body_tensor() refuses with the condition, the margin and the repair", {
  error <- tryCatch(body_tensor(2, c(0.0123, 0.0145, 213)), error = identity)
  expect_s3_class(error, "rotdyn_error_inertia")
  expect_equal(error$call[[1]], quote(body_tensor))
  expect_equal(error$condition, "triangle inequality")
  expect_equal(error$value, 0.0268 - 213)
  expect_equal(error$margin, 0.0268 / 213 - 1)
  expect_s3_class(error$check, "rot_inertia_check")
  expect_match(conditionMessage(error), "izz = 0.0213 instead of 213", fixed = TRUE)
  expect_error(body_tensor(0, c(1, 1, 1)), class = "rotdyn_error_inertia")
  expect_error(body_tensor(1, c(1, 1, NaN)), class = "rotdyn_error_inertia")
  # A mass of 2 kg that would have to lie 1 m away from the centre of a body of 0.5 m.
  expect_error(body_tensor(2, c(2, 2, 2), reach_m = 0.5), class = "rotdyn_error_inertia")
  expect_s3_class(body_tensor(2, c(2, 2, 2), reach_m = 0.75), "rot_body")
})

test_that("an asymmetry of rounding is averaged, and said", {
  tensor <- matrix(c(2, 0.5, 0, 0.5 + 2e-12, 3, 0, 0, 0, 4), 3)
  call <- rlang::current_env()
  expect_message(
    symmetric <- rotdyn:::check_inertia_or_abort(tensor, 1, call),
    class = "rotdyn_message_inertia"
  )
  expect_true(isSymmetric(symmetric, tol = 0))
  expect_equal(symmetric[1, 2], 0.5 + 1e-12, tolerance = 1e-15)
  expect_no_message(
    expect_equal(rotdyn:::check_inertia_or_abort(diag(3), NULL, call), diag(3))
  )
  tensor[1, 2] <- 0.6
  expect_error(
    rotdyn:::check_inertia_or_abort(tensor, 1, call), class = "rotdyn_error_inertia"
  )
})

test_that("a check prints what fails and what to look at", {
  expect_snapshot({
    check_inertia(six(0.0123, 0.0145, 213), mass_kg = 1.4, size_m = 0.23, name = "forearm")
    check_inertia(data.frame(
      ixx = c(1, 2), iyy = c(1, 2), izz = 2, ixy = c(0, -1.2), ixz = 0, iyz = 0
    ))
  })
  expect_snapshot(error = TRUE, {
    body_tensor(1.4, c(0.0123, 0.0145, 213))
    body_tensor(1, matrix(c(2, 0.1, 0, 0.2, 3, 0, 0, 0, 4), 3))
    check_inertia(c(1, 2, 3, 0, 0, 0))
  })
})

test_that("a column that nearly has the name of an optional one is refused, not ignored", {
  link <- data.frame(ixx = 1, iyy = 2, izz = 2.5)
  near <- function(...) {
    expect_error(check_inertia(cbind(link, ...)), "Did you mean", class = "rotdyn_error_argument")
  }
  near(mass = 3)
  near(mas_kg = 3)
  near(size_mm = 200)
  near(ixy_kgm2 = 0.1)
  expect_no_error(check_inertia(cbind(link, mass_kg = 3, size_m = 1, link = 4)))
  all_nine <- cbind(link, ixy = 0, ixz = 0, iyz = 0, iyx = 0, izx = 0, izy = 0)
  expect_no_error(check_inertia(all_nine))
})

test_that("rows of what was not checked are printed", {
  x <- check_inertia(data.frame(ixx = c(1, NA), iyy = 2, izz = 2.5))
  expect_output(print(x[x$value > 0, ]), "physical")
})
