test_that("a mesh3d is read as it is: triangles, quadrangles, a fourth coordinate", {
  one <- body_mesh(tetrahedron3d(), density_kg_m3 = 1)
  expect_equal(one$mass_kg, 1, tolerance = 1e-15)
  pair <- as_pair(tetrahedron3d())
  expect_equal(body_mesh(pair, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  scaled <- tetrahedron3d()
  scaled$vb <- scaled$vb * rep(c(2, 4, 0.5, 8), each = 4)
  expect_equal(body_mesh(scaled, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  flat <- tetrahedron3d()
  flat$vb <- flat$vb[1:3, ]
  expect_equal(body_mesh(flat, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  integers <- tetrahedron3d()
  storage.mode(integers$it) <- "integer"
  expect_equal(body_mesh(integers, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  cube <- structure(
    list(
      vb = rbind(t(expand.grid(0:1, 0:1, 0:1)), 1),
      ib = cbind(
        c(1, 3, 4, 2), c(5, 6, 8, 7), c(1, 2, 6, 5), c(3, 7, 8, 4), c(1, 5, 7, 3), c(2, 4, 8, 6)
      )
    ),
    class = "mesh3d"
  )
  body <- body_mesh(cube, density_kg_m3 = 6)
  expect_equal(unname(diag(body$inertia_kg_m2)), rep(1, 3), tolerance = 1e-15)
  # Both in one: a quadrangle as two triangles.
  cube$it <- matrix(c(2, 4, 8, 2, 8, 6), 3)
  cube$ib <- cube$ib[, -6]
  expect_equal(body_mesh(cube, density_kg_m3 = 6)$inertia_kg_m2, body$inertia_kg_m2)
  no_faces <- structure(list(vb = cube$vb), class = "mesh3d")
  expect_error(body_mesh(no_faces, mass_kg = 1), class = "rotdyn_error_mesh")
})

test_that("vertices come as a data frame, with units, and in an unnamed list", {
  pair <- as_pair(tetrahedron3d())
  one <- body_mesh(pair, density_kg_m3 = 1)
  frame <- stats::setNames(as.data.frame(pair$vertices), c("x_m", "y_m", "z_m"))
  unnamed <- list(frame, pair$faces)
  expect_equal(body_mesh(unnamed, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  turned <- list(faces = as.data.frame(pair$faces), vertices = frame)
  expect_equal(body_mesh(turned, density_kg_m3 = 1)$mass_kg, 1, tolerance = 1e-15)
  expect_error(
    body_mesh(list(frame, pair$faces), mass_kg = 1, length_unit = "mm"),
    class = "rotdyn_error_unit"
  )
  names(frame) <- c("x", "y", "z")
  expect_equal(
    body_mesh(list(frame, pair$faces), density_kg_m3 = 1, length_unit = "mm")$mass_kg, 1e-9,
    tolerance = 1e-14
  )
  skip_if_not_installed("units")
  pair$vertices <- units::set_units(pair$vertices * 100, "cm")
  expect_equal(body_mesh(pair, density_kg_m3 = 1)$mass_kg, 1, tolerance = 1e-14)
  # Their own unit holds, whatever that of plain numbers is.
  expect_equal(
    body_mesh(pair, density_kg_m3 = 1, length_unit = "cm")$mass_kg, 1,
    tolerance = 1e-14
  )
  columns <- data.frame(x = pair$vertices[, 1], y = pair$vertices[, 2], z = pair$vertices[, 3])
  expect_equal(
    body_mesh(list(columns, pair$faces), density_kg_m3 = 1, length_unit = "mm")$mass_kg, 1,
    tolerance = 1e-14
  )
  pair$vertices <- units::set_units(units::drop_units(pair$vertices), "kg")
  expect_error(body_mesh(pair, mass_kg = 1), class = "rotdyn_error_unit")
})

test_that("what is no mesh is said so", {
  pair <- as_pair(tetrahedron3d())
  broken <- list(
    NULL, 1:3, data.frame(x = 1), list(1), list(points = 1, faces = 2),
    list(vertices = "a", faces = pair$faces),
    list(vertices = pair$vertices[, 1:2], faces = pair$faces),
    list(vertices = pair$vertices, faces = pair$faces[, 1:2]),
    list(vertices = pair$vertices, faces = pair$faces == 1),
    list(vertices = pair$vertices, faces = array(as.character(pair$faces), dim(pair$faces))),
    list(vertices = data.frame(x_m = 1, y_m = 2), faces = pair$faces),
    structure(list(vb = "a"), class = "mesh3d"),
    structure(list(vb = pair$vertices, it = 1:3), class = "mesh3d")
  )
  for (mesh in broken) {
    expect_error(body_mesh(mesh, mass_kg = 1), class = "rotdyn_error_type")
    expect_error(check_mesh(mesh), class = "rotdyn_error_type")
  }
})

test_that("what is wrong with a list or a matrix is told", {
  pair <- as_pair(tetrahedron3d())
  expect_error(body_mesh(c(pair, list(normals = 1)), mass_kg = 1), "normals")
  turned <- list(vertices = t(pair$vertices), faces = pair$faces)
  expect_error(body_mesh(turned, mass_kg = 1), "a 3 x 4 double matrix")
  several <- structure(list(tetrahedron3d(), tetrahedron3d()), class = "shapelist3d")
  expect_error(body_mesh(several, mass_kg = 1), "<shapelist3d> object")
})

test_that("units of length are known by name, or to the package units", {
  expect_equal(metres_in("in", NULL), 0.0254)
  expect_equal(metres_in("m", NULL), 1)
  skip_if_not_installed("units")
  expect_equal(metres_in("furlong", NULL), 201.168, tolerance = 1e-5)
  expect_error(metres_in("second", NULL), class = "rotdyn_error_unit")
  expect_error(metres_in("no such unit", NULL), class = "rotdyn_error_unit")
})

# ---- files --------------------------------------------------------------------------------------

test_that("files that are none are refused", {
  odd <- tempfile(fileext = ".xyz")
  writeLines("1 2 3", odd)
  expect_error(body_mesh(odd, mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh(tempdir(), mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh(c(odd, odd), mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh(NA_character_, mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh("not/there.stl", mass_kg = 1), class = "rotdyn_error_file")
  for (extension in c(".stl", ".obj", ".ply")) expect_no_mesh_file(raw(), extension, "empty")
})

test_that("the real meshes have their mass properties, and the bad ones are refused", {
  withr_null()
  skip_without_reader("rgl")
  known <- utils::read.csv(shared("data", "mesh", "mass_properties.csv"))
  expect_gte(nrow(known), 12)
  for (i in seq_len(nrow(known))) {
    want <- known[i, ]
    path <- shared("data", "mesh", want$file)
    if (grepl("^BAD", want$file)) {
      error <- tryCatch(body_mesh(path, density_kg_m3 = 1), error = identity)
      expect_s3_class(error, "rotdyn_error_mesh")
      counts <- error$check$count[error$check$verdict == "fails"]
      expect_equal(counts[1], want$bad_edges)
      next
    }
    body <- body_mesh(path, density_kg_m3 = 1, length_unit = "m")
    inertia <- matrix(
      unlist(want[c("Ixx", "Ixy", "Ixz", "Ixy", "Iyy", "Iyz", "Ixz", "Iyz", "Izz")]), 3
    )
    # The figures were made about the origin: misc_busted lies five of its sizes away from it.
    most <- if (want$file == "misc_busted.STL") 2e-14 else 4e-15
    expect_lte(max(abs(body$inertia_kg_m2 - inertia)) / sum(diag(inertia)), most)
    expect_equal(body$mass_kg, want$mass, tolerance = 4e-15)
    expect_equal(body$detail$area_m2, want$area, tolerance = 4e-15)
    expect_lte(max(abs(body$centre_m - unlist(want[c("cx", "cy", "cz")]))), 4e-15 * 30)
    expect_lte(body$error, 1e-12)
  }
})

test_that("a path that R cannot translate is refused", {
  path <- "a\xff.obj"
  Encoding(path) <- "bytes"
  expect_error(check_mesh(path), class = "rotdyn_error_type")
})

test_that("a unit of length is a unit and nothing besides", {
  skip_if_not_installed("units")
  pair <- list(
    vertices = rbind(c(0, 0, 0), c(1, 0, 0), c(0, 1, 0), c(0, 0, 1)),
    faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  )
  # "2 m" was read as metres, with a warning of another package; "m-1" is a reciprocal length.
  for (unit in c("2 m", "-m", "log(m)", "m-1", "a^", "\\")) {
    expect_no_warning(
      expect_error(
        body_mesh(pair, density_kg_m3 = 1, length_unit = unit), class = "rotdyn_error_unit"
      )
    )
  }
  small <- body_mesh(pair, density_kg_m3 = 6e18, length_unit = "micrometer")
  expect_equal(small$mass_kg, 1, tolerance = 1e-14)
})

test_that("C takes a mesh as a matrix of doubles and one of integers alone", {
  vertices <- matrix(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 4)
  faces <- matrix(c(1L, 1L, 1L, 2L, 3L, 2L, 4L, 3L, 2L, 4L, 3L, 4L), 4)
  check <- function(vertices, faces) {
    .Call(rotdyn:::ffi_mesh_check, vertices, faces, FALSE, -1, NULL)
  }
  expect_no_error(check(vertices, faces))
  whole <- vertices
  storage.mode(whole) <- "integer"
  expect_error(check(whole, faces), "internal: a mesh is")
  expect_error(check(as.double(vertices), faces), "internal: a mesh is")
  expect_error(check(vertices, faces + 0), "internal: a mesh is")
  expect_error(check(vertices, as.integer(faces)), "internal: a mesh is")
  expect_error(check(vertices[, 1:2], faces), "internal: a mesh has three")
})
