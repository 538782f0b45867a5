test_that("supports keep what they were given, and print it", {
  expect_output(print(support_pin(c(0, 0))), "pin: pin at (0, 0) m", fixed = TRUE)
  floor <- support_surface(c(1, 0), friction = 0.4, name = "floor")
  expect_output(print(floor), "floor: surface at (1, 0) m, normal (0, 1), friction 0.4",
                fixed = TRUE)
  expect_output(print(support_cable(c(0, 0), c(0, 2))), "to (0, 2) m", fixed = TRUE)
  expect_output(print(support_hinge(c(0, 0, 0), c(0, 0, 1))), "axis (0, 0, 1)", fixed = TRUE)
  expect_identical(support_roller(c(1, 2, 3))$normal, c(0, 0, 1))
})

test_that("each support has its number of unknowns", {
  unknowns <- function(support) length(reactions_of(support))
  plane <- list(
    support_pin(c(0, 0)), support_roller(c(0, 0)), support_surface(c(0, 0)),
    support_surface(c(0, 0), friction = 1), support_fixed(c(0, 0)),
    support_cable(c(0, 0), c(1, 0)), support_rod(c(0, 0), c(1, 0))
  )
  expect_equal(vapply(plane, unknowns, 0), c(2, 1, 1, 2, 3, 1, 1))
  p <- c(0, 0, 0)
  space <- list(
    support_pin(p), support_roller(p), support_surface(p), support_surface(p, friction = Inf),
    support_fixed(p), support_hinge(p, c(0, 0, 1)), support_hinge(p, c(1, 2, 3), slides = TRUE),
    support_cable(p, c(1, 0, 0))
  )
  expect_equal(vapply(space, unknowns, 0), c(3, 1, 1, 3, 6, 5, 4, 1))
  # Across a slanted hinge: unit vectors at right angles to the axis.
  across <- across_hinge(c(1, 2, 3))$directions
  expect_equal(crossprod(across), diag(2), ignore_attr = TRUE)
  expect_equal(as.double(crossprod(across, c(1, 2, 3))), c(0, 0))
})

test_that("errors of supports", {
  expect_error(support_pin(), class = "rotdyn_error_missing")
  expect_error(support_pin(1), class = "rotdyn_error_size")
  expect_error(support_roller(c(0, 0), c(0, 0)), class = "rotdyn_error_value")
  expect_error(support_roller(c(0, 0), c(0, 0, 1)), class = "rotdyn_error_size")
  expect_error(support_surface(c(0, 0), friction = -1), class = "rotdyn_error_value")
  expect_error(support_cable(c(0, 0), c(0, 0)), class = "rotdyn_error_value")
  expect_error(support_hinge(c(0, 0), c(0, 1)), class = "rotdyn_error_size")
  expect_error(support_hinge(c(0, 0, 0), c(0, 0, 1), slides = 1), class = "rotdyn_error_type")
  expect_error(support_pin(c(0, 0), at = 2), class = "rotdyn_error_argument")
  load <- load_weight(1, c(0, 0))
  expect_error(static_equilibrium(load, 1), class = "rotdyn_error_type")
  expect_error(static_equilibrium(load, list(1)), class = "rotdyn_error_type")
  expect_error(static_equilibrium(load, support_pin(c(0, 0, 0))), class = "rotdyn_error_size")
  broken <- support_pin(c(0, 0))
  broken$kind <- "cable"
  expect_error(static_equilibrium(load, broken), class = "rotdyn_error_type")
  expect_error(print(broken), class = "rotdyn_error_type")
  broken$kind <- NULL
  expect_error(print(broken), class = "rotdyn_error_type")
})
