test_that("supports keep what they were given, and print it", {
  expect_output(print(support_pin(c(0, 0))), "<support> pin at (0, 0) m", fixed = TRUE)
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

test_that("up is the default direction of a push at the ground alone", {
  expect_output(print(support_surface(c(2, 4))), "normal (0, 1), friction 0 (up by default",
                fixed = TRUE)
  load <- load_weight(70, c(1, 2))
  rest <- function(..., loads = load, outline_m = NULL) {
    summary(static_equilibrium(loads, list(...), outline_m = outline_m))$verdict
  }
  foot <- support_surface(c(0, 0), friction = 0.6)
  # A ladder's wall: as a floor it would need no friction at the foot.
  for (wall in list(support_surface(c(2, 4), name = "wall"), support_roller(c(2, 4)))) {
    expect_error(rest(foot, wall), "at y = 4 m", class = "rotdyn_error_value")
    expect_error(rest(support_pin(c(0, 0)), wall), class = "rotdyn_error_value")
  }
  # The load or the outline is below; a couple has no place, nor a force of 0.
  expect_error(rest(support_surface(c(1, 3)), loads = load), class = "rotdyn_error_value")
  box <- cbind(c(0, 2, 2), c(-1, -1, 3))
  expect_error(rest(foot, loads = load, outline_m = box), class = "rotdyn_error_value")
  idle <- forces(load_weight(0, c(0, -3)), load_couple(0), load_weight(1, c(0, 7)))
  expect_equal(rest(support_surface(c(0, 5), friction = 1), loads = idle), "rests")
  # Uneven ground: a thousandth of the extent.
  expect_equal(rest(foot, support_surface(c(2, 1e-3))), "rests")
  expect_error(rest(foot, support_surface(c(2, 3e-3))), class = "rotdyn_error_value")
  # With a direction: the wall of a ladder on a rough floor, N = 70 g / 4, and 1/4 is enough.
  held <- static_equilibrium(load, list(foot, support_surface(c(2, 4), c(-1, 0))))
  expect_equal(held$normal_n, c(70, 17.5) * 9.80665, tolerance = 1e-14)
  expect_equal(held$friction_needed[1], 0.25, tolerance = 1e-14)
  # In space; far from the origin; extents near the largest double.
  legs <- function(z, size = 1) {
    static_equilibrium(
      load_force(c(0, 0, -1), c(0.2, 0.2, 3) * size),
      lapply(1:3, function(i) support_surface(c(c(0, 1, 0)[i], c(0, 0, 1)[i], z[i]) * size))
    )
  }
  expect_error(legs(c(0, 0, 1)), "at z = 1 m", class = "rotdyn_error_value")
  expect_equal(legs(c(0, 0, 0), 5e307)$normal_n, c(0.6, 0.2, 0.2))
})

test_that("normals show in the table and its head", {
  wall <- support_surface(c(2, 4), c(-3, 0), name = "wall")
  x <- static_equilibrium(
    load_weight(70, c(1, 2)), list(floor = support_surface(c(0, 0), friction = 0.6), wall)
  )
  expect_equal(x$normal_x, c(0, -1))
  expect_equal(x$normal_y, c(1, 0))
  expect_output(print(x), "Normals: +floor [(]0, 1[)], wall [(]-1, 0[)]")
  pinned <- static_equilibrium(load_weight(1, c(0, 0, 0)), support_fixed(c(0, 0, 0)))
  expect_identical(pinned$normal_z, NA_real_)
  expect_false(any(grepl("Normals", utils::capture.output(print(pinned)))))
})

test_that("the axis of a hinge by its name", {
  expect_identical(support_hinge(c(0, 0, 1), "z"), support_hinge(c(0, 0, 1), c(0, 0, 1)))
  expect_error(support_hinge(c(0, 0, 1), "w"), class = "rotdyn_error_value")
})

test_that("an edited support without a friction, or with a negative one, is refused", {
  floor <- support_surface(c(0, 0), c(0, 1), friction = 0.4)
  for (friction in c(NA, -0.1)) {
    cut <- floor
    cut$friction <- friction
    expect_error(
      static_equilibrium(forces(load_force(c(0, -1), c(0, 0))), list(cut)),
      class = "rotdyn_error"
    )
    expect_false(support_is_whole(cut))
  }
  expect_true(support_is_whole(floor))
})
