test_that("of the standard shapes the moments come first", {
  standard <- inertia_table()
  expect_named(standard[1:5], c("object", "mass_kg", "moment_of_inertia_kg_m2", "axis", "formula"))
  given <- inertia_table(standard_objects())
  expect_named(given[1:3], names(standard_objects())[1:3])
  expect_equal(standard[names(given)], given)
})

test_that("the standard shapes, at m = 2, r = 3, l = 5", {
  table <- inertia_table(standard_objects(NULL, 2, 3, 5))
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

test_that("every shape of the catalogue is in the list, with sizes it can have", {
  objects <- standard_objects(NULL, 2, 0.3, 1.5)
  expect_setequal(objects$object, shapes()$shape)
  table <- inertia_table(objects)
  expect_true(all(is.finite(table$moment_of_inertia_kg_m2)))
  expect_true(all(is.finite(table$izz_kg_m2)))
  moments <- cbind(table$ixx_kg_m2, table$iyy_kg_m2, table$izz_kg_m2)
  expect_true(all(rowSums(moments) - 2 * moments >= -1e-15))
  expect_true(nrow(inertia_table(standard_objects(NULL, 1, 0, 0))) == nrow(objects))
})

test_that("a row is what the constructor makes of it", {
  shapes <- names(test_sizes)
  rows <- do.call(rbind, lapply(shapes, function(shape) {
    sizes <- as.list(body_of_shape(shape, test_sizes[[shape]][[2]], mass_kg = 2.5)$size_m)
    all <- setdiff(names(standard_objects()), c("object", "mass_kg"))
    sizes[setdiff(all, names(sizes))] <- NA_real_
    as.data.frame(c(list(shape = shape, mass_kg = 2.5), sizes[all]))
  }))
  rows$note <- rev(seq_along(shapes))
  table <- inertia_table(rows[sample(nrow(rows)), ])
  for (i in seq_along(shapes)) {
    row <- table[table$shape == shapes[i], ]
    body <- body_of_shape(shapes[i], test_sizes[[shapes[i]]][[2]], mass_kg = 2.5)
    got <- c(row$ixx_kg_m2, row$iyy_kg_m2, row$izz_kg_m2)
    expect_ulps(got, unname(diag(body$inertia_kg_m2)), 3)
    expect_identical(row$beta, body$beta)
    expect_equal(row$radius_of_gyration_m, sqrt(row$moment_of_inertia_kg_m2 / 2.5))
    expect_identical(row$note, rows$note[i])
  }
})

test_that("names may be a factor, and rows are found by name wherever they are", {
  rows <- data.frame(
    object = factor(c("ring", "disk", NA, "disk"), levels = c("disk", "ring", "unused")),
    mass_kg = 2, radius_m = 3
  )
  expect_identical(inertia_table(rows)$moment_of_inertia_kg_m2, c(18, 9, NA, 9))
})

test_that("sizes that do not fit together name the row", {
  rows <- data.frame(
    shape = c("disk", "annulus"), mass_kg = 1, radius_m = c(1, -5), outer_radius_m = 1,
    inner_radius_m = c(-1, 2)
  )
  # The disk's row has no inner radius, the annulus no radius: neither is looked at.
  expect_error(inertia_table(rows), "2 m in row 2", class = "rotdyn_error_value")
  rows$inner_radius_m[2] <- 0.5
  expect_equal(inertia_table(rows)$moment_of_inertia_kg_m2, c(0.5, 0.625))
  expect_error(
    inertia_table(data.frame(shape = "polygon_plate", mass_kg = 1, radius_m = 1, sides = c(3, 2))),
    "row 2", class = "rotdyn_error_value"
  )
  expect_error(
    inertia_table(data.frame(shape = "disk", mass_kg = c(1, 1, -2), radius_m = 1)),
    "mass_kg.*row 3", class = "rotdyn_error_value"
  )
  expect_error(
    inertia_table(data.frame(object = "wheel", beta = c(1, -1), mass_kg = 1, radius_m = 1)),
    "beta.*row 2", class = "rotdyn_error_value"
  )
  expect_error(
    inertia_table(data.frame(shape = "cone", mass_kg = 1, radius_m = 1)), "height_m",
    class = "rotdyn_error_type"
  )
})

test_that("rows with beta alone have one moment, and NA for the others", {
  table <- inertia_table(data.frame(object = "wheel", mass_kg = 2, radius_m = 3, beta = 0.7))
  expect_equal(table$moment_of_inertia_kg_m2, 12.6)
  expect_identical(c(table$ixx_kg_m2, table$iyy_kg_m2, table$izz_kg_m2), rep(NA_real_, 3))
  expect_identical(table$axis, "rolling axis")
})

test_that("bodies bring all their moments and sizes", {
  table <- inertia_table(list(body_cone(2, 3, 5), body_box(1, 1, 2, 3)))
  expect_identical(table$height_m, c(5, 3))
  expect_identical(table$radius_m, c(3, NA))
  expect_equal(table$ixx_kg_m2, c(2 * (3 * 9 / 20 + 3 * 25 / 80), 13 / 12))
  expect_identical(table$izz_kg_m2, table$moment_of_inertia_kg_m2)
})

test_that("sizes without an end follow the formula", {
  table <- inertia_table(data.frame(shape = c("disk", "rod"), mass_kg = 1, radius_m = Inf,
                                    length_m = Inf))
  expect_identical(table$moment_of_inertia_kg_m2, c(Inf, Inf))
  expect_identical(table$ixx_kg_m2[2], 0)
})

test_that("published radii of gyration", {
  cases <- read.csv(shared("refs", "inertia_ratios.csv"), colClasses = "numeric")
  solid <- cases[cases$r == 0, ][1, ]
  table <- inertia_table(data.frame(object = c("sphere", "disk"), mass_kg = 1, radius_m = solid$R))
  expect_ulps(
    table$moment_of_inertia_kg_m2, c(solid$hollow_sphere_k2, solid$thick_cylinder_axis_k2), 2
  )
})

test_that("a table of bodies has each moment about the axis it names", {
  bodies <- list(body_rod_end(2, 3), body_point(2, 3), body_disk(2, 3), body_rod(2, 3))
  of_bodies <- inertia_table(bodies)
  expect_equal(of_bodies$moment_of_inertia_kg_m2, c(2 * 9 / 3, 2 * 9, 9, 2 * 9 / 12))
  expect_equal(of_bodies$radius_of_gyration_m, sqrt(of_bodies$moment_of_inertia_kg_m2 / 2))
  expect_equal(of_bodies$izz_kg_m2, c(1.5, 0, 9, 1.5))
  expect_equal(
    of_bodies$axis,
    c("perpendicular, through one end", "at distance r", rep("z, through the centre of mass", 2))
  )
  # Another body of the same name is not that shape.
  given <- body_tensor(2, c(0, 1, 1), name = "rod_end")
  expect_equal(inertia_table(given)$moment_of_inertia_kg_m2, 1)
})

test_that("a column that is a matrix is no column of numbers", {
  wide <- tibble::tibble(object = "disk", mass_kg = 1, radius_m = matrix(c(1, 2), 1))
  expect_error(inertia_table(wide), class = "rotdyn_error_size")
})

test_that("columns that are tables, or of another length, are errors", {
  table <- data.frame(shape = c("disk", "wheel"), mass_kg = 1:2, radius_m = 1:2)
  table$beta <- matrix(1:4 / 8, 2)
  expect_error(inertia_table(table), class = "rotdyn_error_size")
  table$beta <- 0.5
  table$shape <- matrix("disk", 2, 2)
  expect_error(inertia_table(table), class = "rotdyn_error_size")
  table$shape <- data.frame(a = c("disk", "hoop"))
  expect_error(inertia_table(table), class = "rotdyn_error_type")
  expect_error(inertia_table(data.frame()), "no columns", class = "rotdyn_error_type")
  table$shape <- list("disk", "hoop")
  expect_equal(inertia_table(table)$moment_of_inertia_kg_m2, c(0.5, 8))
})

test_that("a body's named axis goes with it when it is turned", {
  up <- rotation_about("y", angle_deg = 90)
  turned <- list(
    place_body(body_rod_end(2, 3), rotation = up), place_body(body_point(2, 3), c(1, 0, 0), up)
  )
  table <- inertia_table(turned)
  expect_equal(table$moment_of_inertia_kg_m2, c(2 * 9 / 3, 2 * 9))
  expect_equal(table$radius_of_gyration_m, c(sqrt(3), 3))
  expect_equal(table$izz_kg_m2, c(0, 0))
})

test_that("sizes of any ratio, in a table and as bodies", {
  table <- inertia_table(data.frame(
    shape = "cylinder", mass_kg = c(3, 1e300), radius_m = c(1e-150, 1e-280),
    length_m = c(1e150, 1e-3)
  ))
  expect_within(table$izz_kg_m2, c(1.5e-300, 5e-261), 1e-14)
  expect_within(table$moment_of_inertia_kg_m2, c(1.5e-300, 5e-261), 1e-14)
  expect_equal(table$radius_of_gyration_m / c(1e-150, 1e-280), sqrt(c(0.5, 0.5)))
  wire <- body_cylinder(3, 1e-150, 1e150)
  expect_equal(moment_of_inertia(wire, "z") / 1.5e-300, 1, tolerance = 1e-14)
  expect_equal(body_sphere(radius_m = 1e-150, density_kg_m3 = 1)$error, Inf)
})

test_that("a rod's end stays across the rod, however the rod was turned", {
  rod <- body_rod_end(3, 2)
  up <- place_body(rod, c(1, 2, 3), rotation_about("y", angle_deg = 90))
  leaning <- place_body(rod, rotation = rotation_about(c(1, 2, 3), angle_deg = 50))
  table <- inertia_table(list(rod, up, leaning))
  # m l^2 / 3
  expect_equal(table$moment_of_inertia_kg_m2, c(4, 4, 4), tolerance = 1e-14)
  expect_equal(table$izz_kg_m2[1:2], c(1, 0))
})

test_that("a table without names is an error that says so", {
  expect_error(inertia_table(setNames(data.frame(1, 2), NULL)), class = "rotdyn_error_type")
})

test_that("moments beyond double precision are said", {
  heavy <- data.frame(object = "disk", mass_kg = 1e300, radius_m = c(1, 1e10))
  expect_warning(x <- inertia_table(heavy), "row 2", class = "rotdyn_warning_range")
  expect_equal(x$moment_of_inertia_kg_m2, c(5e299, Inf))
})
