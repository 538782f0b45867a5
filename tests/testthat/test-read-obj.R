write_obj <- function(mesh, path) {
  writeLines(c(
    "# a comment", "o thing",
    sprintf("v %.17g %.17g %.17g", mesh$vb[1, ], mesh$vb[2, ], mesh$vb[3, ]),
    sprintf("f %.0f %.0f %.0f", mesh$it[1, ], mesh$it[2, ], mesh$it[3, ])
  ), path)
}

test_that("an OBJ keeps its digits", {
  mesh <- tetrahedron3d()
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] / 7 + 0.1
  path <- tempfile(fileext = ".obj")
  write_obj(mesh, path)
  expect_no_warning(body <- body_mesh(path, mass_kg = 2))
  expect_equal(body$inertia_kg_m2, body_mesh(mesh, mass_kg = 2)$inertia_kg_m2, tolerance = 1e-15)
  expect_equal(body$detail$reader, "rotdyn")
})

test_that("an OBJ may have negative numbers, colours, and lines that go on", {
  vertices <- c("v 0 0 0 1 0 0", "v 1 0 0 0 1 0", "v 0 2 0 0 0 1", "v 0 0 3 1 1 1")
  faces <- c("f -4/1/1 -2//1 -3/2", "f -4 -3 -1", "f -4 \\", "-1 -2", "f 2 3 4 # the last")
  expect_equal(obj_body(vertices, faces)$mass_kg, 1, tolerance = 1e-15)
  # Indented, by spaces or a tab.
  expect_equal(obj_body(paste0("  ", vertices), paste0("\t", faces))$mass_kg, 1, tolerance = 1e-15)
  # Negative numbers count from the vertices so far.
  early <- obj_body(vertices, "f -4 -2 -3", "f -4 -3 -1", "f -4 -1 -2", "f -3 -2 -1", "v 9 9 9")
  expect_equal(early$mass_kg, 1, tolerance = 1e-15)
})

test_that("a damaged OBJ is refused", {
  expect_no_mesh_file("v 1 2", ".obj", "fewer than three coordinates")
  expect_no_mesh_file("v 1 2 a", ".obj", "not a number: a")
  expect_no_mesh_file(c("v 1 2 3", "f 1 1"), ".obj", "fewer than three corners")
})
