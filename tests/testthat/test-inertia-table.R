test_that("the standard shapes, at m = 2, r = 3, l = 5", {
  table <- inertia_table(inertia_objects(2, 3, 5))
  want <- c(
    hoop = 18, disk = 9, sphere = 7.2, spherical_shell = 12, rod = 50 / 12, rod_end = 50 / 3,
    point = 18, sliding_point = 0
  )
  got <- setNames(table$moment_of_inertia_kg_m2, table$object)
  expect_ulps(unname(got[names(want)]), unname(want), 2)
  expect_equal(table$radius_of_gyration_m, sqrt(table$moment_of_inertia_kg_m2 / 2))
  expect_equal(table$beta[table$object == "rod"], NA_real_)
  expect_identical(table$beta[table$object == "spherical_shell"], 2 / 3)
  expect_true(all(nzchar(table$axis)) && all(nzchar(table$formula)))
})

test_that("parallel axes: a rod about its end is a rod about its centre plus m (l/2)^2", {
  table <- inertia_table(data.frame(object = c("rod", "rod_end"), mass_kg = 2, length_m = 3))
  expect_equal(diff(table$moment_of_inertia_kg_m2), 2 * 1.5^2)
})

test_that("the article's names, extra columns and rows that only have beta", {
  table <- inertia_table(data.frame(
    object = c("solid_disk", "thin_spherical_shell", "point_mass_sliding", "my_wheel"),
    mass_kg = 2, radius_m = 3, beta = c(NA, NA, NA, 0.7), colour = "red"
  ))
  expect_equal(table$moment_of_inertia_kg_m2, c(9, 12, 0, 12.6))
  expect_equal(table$beta, c(0.5, 2 / 3, 0, 0.7))
  expect_equal(table$colour, rep("red", 4))
})

test_that("bodies, one or a list", {
  table <- inertia_table(list(body_disk(2, 3), body_rod(2, 3)))
  expect_equal(table$moment_of_inertia_kg_m2, c(9, 1.5))
  expect_equal(inertia_table(body_disk(2, 3))$moment_of_inertia_kg_m2, 9)
  expect_equal(nrow(inertia_table(list())), 0)
})

test_that("NA in, NA out; what is impossible is an error", {
  table <- inertia_table(data.frame(object = "disk", mass_kg = c(NA, 2), radius_m = c(3, NA)))
  expect_equal(table$moment_of_inertia_kg_m2, c(NA_real_, NA_real_))
  bad <- function(...) inertia_table(data.frame(...))
  expect_error(bad(object = "disk", mass_kg = -1, radius_m = 1), class = "rotdyn_error_value")
  expect_error(bad(object = "disk", mass_kg = 1, radius_m = -1), class = "rotdyn_error_value")
  expect_error(bad(object = "blob", mass_kg = 1, radius_m = 1), class = "rotdyn_error_value")
  expect_error(bad(object = "disk", mass_kg = 1), class = "rotdyn_error_type")
  expect_error(bad(mass_kg = 1, radius_m = 1), class = "rotdyn_error_type")
  expect_error(inertia_table(3), class = "rotdyn_error_type")
})

test_that("published radii of gyration", {
  cases <- read.csv(shared("refs", "inertia_ratios.csv"), colClasses = "numeric")
  solid <- cases[cases$r == 0, ][1, ]
  table <- inertia_table(data.frame(object = c("sphere", "disk"), mass_kg = 1, radius_m = solid$R))
  expect_ulps(
    table$moment_of_inertia_kg_m2, c(solid$hollow_sphere_k2, solid$thick_cylinder_axis_k2), 2
  )
})
