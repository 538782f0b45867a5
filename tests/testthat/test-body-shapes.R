# Moments of m = 2 kg, r or l = 3 m, by hand from the textbook formulas.
test_that("shapes have the moments of the textbook", {
  diagonal <- function(body) unname(diag(body$inertia_kg_m2))
  expect_equal(diagonal(body_disk(2, 3)), c(4.5, 4.5, 9))
  expect_equal(diagonal(body_hoop(2, 3)), c(9, 9, 18))
  expect_equal(diagonal(body_sphere(2, 3)), c(7.2, 7.2, 7.2))
  expect_equal(diagonal(body_spherical_shell(2, 3)), c(12, 12, 12))
  expect_equal(diagonal(body_rod(2, 3)), c(0, 1.5, 1.5))
  expect_identical(body_disk(2, 0.25)$inertia_kg_m2[3, 3], 0.0625)
})

test_that("the tensor is diagonal in the own axes and obeys I1 + I2 >= I3", {
  for (body in list(body_disk(2, 3), body_hoop(2, 3), body_sphere(2, 3), body_rod(2, 3))) {
    tensor <- body$inertia_kg_m2
    expect_equal(unname(tensor), diag(diag(tensor)))
    moments <- sort(diag(tensor))
    expect_gte(moments[1] + moments[2], moments[3] * (1 - 1e-15))
  }
})

test_that("beta is there where a body rolls", {
  expect_identical(body_disk(2, 3)$beta, 0.5)
  expect_identical(body_hoop(2, 3)$beta, 1)
  expect_identical(body_sphere(2, 3)$beta, 0.4)
  expect_identical(body_spherical_shell(2, 3)$beta, 2 / 3)
  expect_identical(body_rod(2, 3)$beta, NA_real_)
})

test_that("moments survive sizes whose square does not", {
  expect_ulps(body_hoop(1e300, 1e-200)$inertia_kg_m2[3, 3], 1e-100, 2)
  expect_ulps(body_hoop(1e-300, 1e200)$inertia_kg_m2[3, 3], 1e100, 2)
})

test_that("an impossible body is an error", {
  expect_error(body_disk(-1, 1), class = "rotdyn_error_value")
  expect_error(body_rod(1, -1), class = "rotdyn_error_value")
  expect_equal(sum(body_disk(0, 1)$inertia_kg_m2), 0)
})

# ---- the catalogue against its geometry ----------------------------------------------------------

test_that("every shape has the mass, centre and second moments of its geometry", {
  for (shape in names(shape_maps)) {
    dimension <- shapes()$dimension[shapes()$shape == shape]
    for (size in test_sizes[[shape]]) {
      want <- quadrature(shape_maps[[shape]](size), dimension)
      body <- body_of_shape(shape, size, density = 2)
      info <- paste(shape, paste(size, collapse = ", "))
      scale <- sum(diag(want$second))
      expect_lte(abs(body$mass_kg / (2 * want$mass) - 1), 1e-12, label = info)
      expect_lte(max(abs(body$centre_m - want$centre)), 1e-12 * sqrt(scale), label = info)
      off <- body$second_moment_kg_m2 - body$mass_kg * want$second
      expect_lte(max(abs(off)), 1e-12 * body$mass_kg * scale, label = info)
      # The zeros of rods and plates are exact.
      expect_true(all(body$second_moment_kg_m2[want$second == 0] == 0), label = info)
      expect_gte(body$reach_m * (1 + 1e-12), want$far, label = info)
      expect_lte(body$reach_m, 1.5 * want$far, label = info)
    }
  }
  all <- setdiff(shapes()$shape, c("point", "sliding_point", "ellipsoid_shell"))
  expect_setequal(names(shape_maps), all)
})

test_that("an ellipsoid's shell is what is left between two similar ellipsoids", {
  for (size in test_sizes$ellipsoid_shell) {
    thin <- 1e-4
    solid <- do.call(body_ellipsoid, as.list(c(1, size)))$second_moment_kg_m2
    # m ~ k^3 and C ~ k^5: the difference of the two, as a mass of 1.
    less <- (1 - thin)^c(3, 5)
    want <- solid * (1 - less[2]) / (1 - less[1])
    got <- do.call(body_ellipsoid_shell, as.list(c(1, size)))$second_moment_kg_m2
    expect_lte(max(abs(got / want - 1), na.rm = TRUE), 2 * thin)
  }
  expect_identical(
    body_ellipsoid_shell(2, 3, 3, 3)$inertia_kg_m2, body_spherical_shell(2, 3)$inertia_kg_m2
  )
})

test_that("the mass of a constructor goes in as it is, and moments grow with it", {
  for (shape in names(test_sizes)) {
    size <- test_sizes[[shape]][[1]]
    one <- body_of_shape(shape, size, mass_kg = 1)
    seven <- body_of_shape(shape, size, mass_kg = 7)
    none <- body_of_shape(shape, size, mass_kg = 0)
    expect_identical(seven$mass_kg, 7)
    expect_equal(seven$second_moment_kg_m2, 7 * one$second_moment_kg_m2, tolerance = 1e-15)
    expect_true(all(none$second_moment_kg_m2 == 0))
    expect_identical(none$error, 0)
    expect_identical(seven$centre_m, one$centre_m)
    expect_identical(seven$provenance, "formula")
    expect_identical(seven$error_kind, "bound")
    expect_true(seven$error > 0 && seven$error < 3e-15)
    expect_equal(unname(seven$size_m), size)
  }
})

test_that("the engines' closed forms", {
  cases <- read.csv(shared("cases", "inertia_shapes", "shapes.csv"))
  want <- stats::setNames(cases$value, cases$id)
  moment <- function(body, axis, ...) moment_of_inertia(body, axis, ...)
  ell <- body_ellipsoid(1, 3, 4, 5)
  box <- body_box(1, 1, 2, 3)
  cylinder <- body_cylinder(1, 2.5, 1.5)
  capsule <- body_capsule(1, 0.5, 1.5)
  tetra <- body_tetrahedron(1, rbind(0, c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)))
  about_vertex <- inertia_tensor(tetra, about = "origin")
  hemi <- body_hemisphere(radius_m = 1.5, density_kg_m3 = 50)
  hollow <- body_hollow_sphere(outer_radius_m = 2.3, inner_radius_m = 2.1, density_kg_m3 = 50)
  half_turn <- rotation_about("x", angle_deg = 180)
  joined <- join_bodies(
    place_body(hemi, c(0, 0, 2)), place_body(hemi, c(0, 0, 2), rotation = half_turn)
  )
  whole <- body_box(length_m = 4, width_m = 8, height_m = 12, density_kg_m3 = 100)
  got <- c(
    ell_x = moment(ell, "x"), ell_y = moment(ell, "y"), ell_z = moment(ell, "z"),
    sph = moment(body_sphere(1, 3.5), "x"), hsph = moment(body_spherical_shell(1, 3.5), "x"),
    box_x = moment(box, "x"), box_y = moment(box, "y"), box_z = moment(box, "z"),
    cube = moment(body_cube(1, 1.5), "y"),
    cyl_p = moment(cylinder, "x"), cyl_a = moment(cylinder, "z"),
    cyl_e = moment(cylinder, "y", through = c(0, 0, 0.75)),
    cap_p = moment(capsule, "x"), cap_a = moment(capsule, "z"),
    rod = moment(body_rod(1, 1.5), "z"),
    tetv_xx = about_vertex[1, 1], tetv_yy = about_vertex[2, 2], tetv_zz = about_vertex[3, 3],
    tetv_xy = about_vertex[1, 2], tetv_xz = about_vertex[1, 3], tetv_yz = about_vertex[2, 3],
    hemi_m = hemi$mass_kg, hemi_t = moment(hemi, "x"), hemi_c = hemi$centre_m[["z"]],
    hemi2 = moment(joined, "x"), hs_m = hollow$mass_kg, hs_I = moment(hollow, "z"),
    bx_m = whole$mass_kg, bx_xx = moment(whole, "x"), bx_yy = moment(whole, "y"),
    bx_zz = moment(whole, "z")
  )
  expect_length(setdiff(names(got), names(want)), 0)
  expect_gte(length(got), 29)
  for (id in names(got)) {
    expect_lte(abs(got[[id]] / want[[id]] - 1), 2e-14, label = id)
  }
})

test_that("hollow spheres of any wall keep all digits", {
  cases <- read.csv(shared("refs", "inertia_ratios.csv"), colClasses = "numeric")
  for (i in seq_len(nrow(cases))) {
    R <- cases$R[i]
    r <- cases$r[i]
    expect_ulps(body_hollow_sphere(1, R, r)$inertia_kg_m2[3, 3], cases$hollow_sphere_k2[i], 4)
    expect_ulps(body_annulus(1, R, r)$inertia_kg_m2[3, 3], cases$thick_cylinder_axis_k2[i], 2)
    expect_ulps(body_frustum(1, R, r, 2)$inertia_kg_m2[3, 3], cases$frustum_axis_k2[i], 4)
  }
})

test_that("limits: one shape becomes another", {
  same <- function(a, b, ulps = 1) {
    expect_ulps(diag(a$second_moment_kg_m2), diag(b$second_moment_kg_m2), ulps)
  }
  same(body_thick_tube(2, 3, 0, 5), body_cylinder(2, 3, 5))
  same(body_thick_tube(2, 3, 3, 5), body_tube(2, 3, 5))
  same(body_hollow_sphere(2, 3, 0), body_sphere(2, 3))
  same(body_hollow_sphere(2, 3, 3), body_spherical_shell(2, 3))
  same(body_frustum(2, 3, 3, 5), body_cylinder(2, 3, 5), 2)
  same(body_frustum(2, 3, 0, 5), body_cone(2, 3, 5), 2)
  same(body_capsule(2, 3, 0), body_sphere(2, 3))
  same(body_spherical_cap(2, 3, 6), body_sphere(2, 3), 2)
  same(body_spherical_cap(2, 3, 3), body_hemisphere(2, 3), 2)
  expect_equal(body_spherical_cap(2, 3, 6)$centre_m[["z"]], 3)
  expect_equal(body_hollow_sphere(2, 3, 3)$beta, 2 / 3)
  expect_equal(body_annulus(2, 3, 0)$beta, 1 / 2)
})

test_that("from 1e-150 to 1e150, and beside one another", {
  for (scale in c(1e-150, 1e150)) {
    box <- body_box(2, 3 * scale, 4 * scale, 5 * scale)$second_moment_kg_m2
    expect_ulps(diag(box) / scale / scale, 2 * c(9, 16, 25) / 12, 4)
    sphere <- body_hollow_sphere(1, 3 * scale, 3 * scale)$inertia_kg_m2
    expect_ulps(sphere[1, 1] / scale / scale, 6, 4)
  }
  needle <- body_box(1, 1, 1e-150, 1e-150)
  expect_ulps(needle$second_moment_kg_m2[1, 1], 1 / 12, 1)
  expect_ulps(needle$second_moment_kg_m2[2, 2] * 1e150 * 1e150, 1 / 12, 3)
  wire <- body_cylinder(radius_m = 1e-150, length_m = 1, density_kg_m3 = 7e300)
  expect_equal(wire$mass_kg, 7 * pi, tolerance = 1e-15)
})

test_that("the own origin: what lies off the centre says so", {
  expect_equal(as.double(body_point(2, 3)$centre_m), c(3, 0, 0))
  expect_equal(moment_of_inertia(body_point(2, 3), "z", through = "origin"), 18)
  expect_true(all(body_point(2)$inertia_kg_m2 == 0))
  rod <- body_rod_end(2, 3)
  expect_equal(moment_of_inertia(rod, "z", through = "origin"), 6)
  expect_equal(moment_of_inertia(rod, "z", through = "centre"), 1.5)
  # The axle that the body names.
  expect_equal(moment_of_inertia(rod, "z"), 6)
  expect_equal(moment_of_inertia(body_point(2, 3), "z"), 18)
  expect_equal(radius_of_gyration(body_point(2, 3), "z"), 3)
})

test_that("sizes that do not fit together are refused, with the remedy", {
  refused <- function(code, text) {
    expect_error(code, text, class = "rotdyn_error_value")
  }
  refused(body_annulus(1, 1, 2), "at most `outer_radius_m`")
  refused(body_thick_tube(1, 1, 2, 3), "inner_radius_m. must be at most")
  refused(body_hollow_sphere(1, 0.1, 0.11), "It is 0.11 m")
  refused(body_torus(1, 1, 2), "intersect itself")
  refused(body_torus_shell(1, 1, 2), "intersect itself")
  refused(body_spherical_cap(1, 1, 2.1), "at most twice `radius_m`")
  refused(body_spherical_cap_shell(1, 1, 2.1), "the sphere")
  refused(body_polygon_plate(1, 1, 2), "at least 3")
  refused(body_polygon_prism(1, 1, 3.5, 1), "whole number")
  refused(body_box(1, 1, 1, -1), "height_m")
  refused(body_cone(1, 1, Inf), "finite|at least")
  refused(body_triangle(1, 1, 1, apex_m = NA_real_), "apex_m")
  refused(body_disk(1, 1, areal_density_kg_m2 = 1), "not both")
  refused(body_sphere(radius_m = 1, density_kg_m3 = -1), "density_kg_m3")
  expect_error(body_disk(1, "a"), class = "rotdyn_error_type")
  expect_error(body_disk(1, c(1, 2)), class = "rotdyn_error_size")
  expect_error(body_disk(1), "radius_m", class = "rotdyn_error_missing")
  expect_error(body_sphere(radius_m = 1), "density_kg_m3", class = "rotdyn_error_missing")
  expect_error(body_point(), "mass_kg", class = "rotdyn_error_missing")
  expect_error(body_hoop(1e300, 1e200), class = "rotdyn_error_range")
  expect_error(
    body_sphere(radius_m = 1e150, density_kg_m3 = 1), "double precision",
    class = "rotdyn_error_range"
  )
  expect_error(body_disk(1, 2, 3), class = "rotdyn_error_argument")
})

test_that("an error names the user's own call", {
  error <- tryCatch(body_annulus(1, 1, 2), error = identity)
  expect_identical(as.character(conditionCall(error)[[1]]), "body_annulus")
  error <- tryCatch(body_sphere(radius_m = 1), error = identity)
  expect_identical(as.character(conditionCall(error)[[1]]), "body_sphere")
})

test_that("densities and sizes may carry units", {
  skip_if_not_installed("units")
  steel <- units::set_units(7.85, "g/cm^3", mode = "standard")
  radius <- units::set_units(10, "cm", mode = "standard")
  expect_equal(
    body_sphere(radius_m = radius, density_kg_m3 = steel)$mass_kg, 7850 * 4 / 3 * pi * 1e-3
  )
  expect_error(
    body_sphere(radius_m = radius, density_kg_m3 = units::set_units(1, "kg", mode = "standard")),
    class = "rotdyn_error_unit"
  )
})

test_that("beta is there for what rolls, Izz/(m r^2) on the outer radius", {
  outer <- c(
    hoop = 3, disk = 3, annulus = 3, tube = 3, can = 3, cylinder = 3, thick_tube = 3, sphere = 3,
    spherical_shell = 3, hollow_sphere = 3, torus = 5, torus_shell = 5, capsule = 3
  )
  for (shape in names(test_sizes)) {
    body <- body_of_shape(shape, test_sizes[[shape]][[1]], mass_kg = 2)
    if (shape %in% names(outer)) {
      expect_ulps(body$beta, body$inertia_kg_m2[3, 3] / (2 * outer[[shape]]^2), 6)
    } else {
      expect_identical(body$beta, NA_real_, label = shape)
    }
  }
})

test_that("the centre of a shape that lies off its origin is known to eight roundings", {
  half <- body_hemisphere(2, 0.8)
  expect_equal(half$centre_m[["z"]], 3 / 8 * 0.8)
  expect_within(half$detail$centre_error_m, 8 * 2^-53 * 0.3, 1e-9)
  expect_null(body_sphere(2, 0.8)$detail$centre_error_m)
})
