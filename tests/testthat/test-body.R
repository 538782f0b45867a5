test_that("a moment about an axis is n' I n", {
  disk <- body_disk(2, 3)
  expect_equal(rotdyn:::moment_about_axis(disk, c(0, 0, 1)), 9)
  expect_equal(rotdyn:::moment_about_axis(disk, c(1, 0, 0)), 4.5)
  # Half way between: (Ixx + Izz)/2.
  expect_equal(rotdyn:::moment_about_axis(disk, c(1, 0, 1) / sqrt(2)), 6.75)
})

test_that("the tensor is made of the second moment, off-diagonals minus the products", {
  body <- rotdyn:::new_body("test", 2, c(1, 2, 4, 0.5, -0.25, 0.125))
  expect_identical(
    body$inertia_kg_m2,
    matrix(c(6, -0.5, 0.25, -0.5, 5, -0.125, 0.25, -0.125, 3), 3,
           dimnames = list(c("x", "y", "z"), c("x", "y", "z")))
  )
  expect_identical(diag(body$second_moment_kg_m2), c(x = 1, y = 2, z = 4))
  # Six numbers or the matrix: the same.
  again <- rotdyn:::new_body("test", 2, body$second_moment_kg_m2)
  expect_identical(again$inertia_kg_m2, body$inertia_kg_m2)
})

test_that("what is beyond double precision is no body", {
  expect_error(body_sphere(1, 1e200), class = "rotdyn_error_range")
  expect_error(rotdyn:::new_body("test", 1, c(NaN, 1, 1, 0, 0, 0)), class = "rotdyn_error_range")
  expect_s3_class(body_sphere(1e-300, 1e300), "rot_body")
})

test_that("a body prints its mass, size, inertia and formula", {
  expect_snapshot({
    body_disk(2, 0.25)
    body_rod(1.5, 2)
    body_disk(0, 1)
    place_body(body_rod(1.5, 2), c(1, 0, -2), rotation_about("z", angle_deg = 30))
    body_tensor(2, diag(c(0.05, 0.06, 0.07)) - 0.001 * (1 - diag(3)), name = "forearm")
    join_bodies(body_sphere(2, 0.1), place_body(body_sphere(1, 0.1), c(0.3, 0, 0)), name = "pair")
  })
})

test_that("moments near the largest double are made and printed", {
  expect_equal(body_rod(8e307, 4.5)$inertia_kg_m2[[9]] / 1.35e308, 1)
  expect_output(print(body_tensor(1, c(1.7e308, 1.7e308, 1.7e308))), "Izz 1.7e[+]308")
})

test_that("print keeps to the console's width", {
  bodies <- list(
    body_frustum(1, 0.1, 0.2, 0.4), body_spherical_cap(1, 0.1, 0.05),
    place_body(body_box(2, 0.3, 0.2, 0.1), c(0.5, 0, 0), rotation_about("z", angle_deg = 30))
  )
  for (width in c(60L, 80L, 120L)) {
    lines <- rlang::with_options(
      unlist(lapply(bodies, function(body) capture.output(print(body)))),
      width = width
    )
    expect_lte(max(nchar(lines)), min(width, 98L))
    # Nothing is lost.
    words <- strsplit(trimws(lines), " +")
    expect_true(all(c("rotated", "frustum", "kg", "symmetry") %in% unlist(words)))
  }
})

test_that("print shows no more digits than the error leaves", {
  rough <- body_density(
    1000, domain_inside(function(x, y, z) x^4 + y^4 + z^4 < 1, c(-1, -1, -1), c(1, 1, 1)),
    max_evaluations = 1e4
  )
  expect_gt(rough$error, 1e-3)
  line <- grep("^  inertia", capture.output(print(rough)), value = TRUE)
  moment <- regmatches(line, regexpr("Ixx [0-9.]+", line))
  expect_equal(moment, paste("Ixx", format(rough$inertia_kg_m2[1, 1], digits = 4)))
  # Exact ones have seven.
  line <- capture.output(print(body_sphere(1, 1 / 3)))
  expect_match(line, "Ixx 0.04444444,", fixed = TRUE, all = FALSE)
})

test_that("print says what of a mesh the body is", {
  open <- list(
    vertices = rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)),
    faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3))
  )
  from <- function(method) {
    tail(capture.output(print(body_mesh(open, mass_kg = 1, method = method))), 1)
  }
  expect_match(from("box"), "from      box of a mesh, relative error", fixed = TRUE)
  expect_match(from("shell"), "from      faces of a mesh, exact integrals", fixed = TRUE)
})

test_that("a body of unknown origin is printed", {
  body <- body_disk(1, 1)
  body$provenance <- "elsewhere"
  expect_output(print(body), "from +unknown")
  body$provenance <- "mesh"
  expect_output(print(body), "from +unknown")
})

test_that("a point or a rod whose size has lost its name is refused", {
  for (body in list(body_point(4.16), body_rod_end(1, 2))) {
    body$size_m <- unname(body$size_m)
    expect_error(print(body), class = "rotdyn_error_type")
    expect_error(scene_axle(body), class = "rotdyn_error_type")
  }
})

test_that("a print says where an axle passes", {
  said <- rotdyn:::describe_point
  disk <- body_disk(2, 0.25)
  expect_identical(said(disk, c(0, 0, 0)), "through the origin of the own axes")
  expect_identical(said(disk, c(0.1, 0, -2)), "through (0.1, 0, -2) m")
  placed <- place_body(disk, c(0, 0.5, 0))
  expect_identical(said(placed, c(0, 0.5, 0)), "through the centre of mass")
  expect_identical(said(placed, c(0, 0, 0)), "through the origin of the own axes")
  expect_identical(said(placed, c(0, 0.25, 0)), "through (0, 0.25, 0) m")
})

test_that("a centre of mass beyond four roundings of the size is printed, one within is none", {
  # Of a disk of radius 2 m the root of the second moments over the mass is sqrt(2) m.
  said <- function(x_m) {
    body <- place_body(body_disk(1, 2), c(x_m, 0, 0))
    any(grepl("^  centre", utils::capture.output(print(body))))
  }
  expect_true(said(6 * 2^-52))
  expect_false(said(5 * 2^-52))
})
