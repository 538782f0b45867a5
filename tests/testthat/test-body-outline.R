plane <- function(...) diag(3)[, c(...)]

shadow <- function(body, ...) rotdyn:::project_solids(rotdyn:::body_solids(body), plane(...))

# Points on a grid that has the ends of each parameter.
surface_points <- function(shape, size) {
  map <- shape_maps[[shape]]
  do.call(rbind, lapply(map(size), function(one) {
    p <- as.matrix(expand.grid(rep(list(seq(0, 1, length.out = 25)), 3)))
    suppressWarnings(do.call(cbind, lapply(one(p), rep_len, nrow(p))))
  }))
}

test_that("every shape's outline spans what its geometry spans, along each axis", {
  skip_on_cran() # exhaustive: `make test` runs it
  shapes <- setdiff(intersect(names(shape_maps), names(test_sizes)), "point")
  expect_setequal(
    setdiff(rotdyn::shapes()$shape, names(rotdyn:::shape_solids)), c("point", "sliding_point")
  )
  for (shape in shapes) {
    for (size in test_sizes[[shape]]) {
      points <- surface_points(shape, size)
      body <- body_of_shape(shape, size, mass_kg = 1)
      for (axes in list(1:2, c(1, 3), 2:3)) {
        seen <- do.call(rbind, shadow(body, axes))
        want <- apply(points[, axes], 2, range, na.rm = TRUE)
        got <- apply(seen[c("across", "up")], 2, range)
        # The grid of the test misses a curved rim by less than 1 - cos(pi/24).
        expect_equal(unname(got), unname(want), tolerance = 0.01, info = shape)
        # And nothing of the body is outside.
        expect_true(all(got[1, ] <= want[1, ] + 1e-9 & got[2, ] >= want[2, ] - 1e-9), info = shape)
      }
    }
  }
})

test_that("a disk of 0.25 m reaches 0.25 m, and a ball turned anyhow its radius", {
  disk <- shadow(body_disk(2, 0.25), 1:2)$fill
  expect_equal(sqrt(disk$across^2 + disk$up^2), rep(0.25, nrow(disk)), tolerance = 1e-14)
  ball <- place_body(body_sphere(2, 0.3), c(1, 2, 3), rotation_about(c(1, 2, 3), angle_deg = 50))
  edge <- shadow(ball, c(1, 3))$fill
  expect_equal(sqrt((edge$across - 1)^2 + (edge$up - 3)^2), rep(0.3, nrow(edge)), tolerance = 1e-13)
})

test_that("placed twice is moved twice", {
  rod <- body_rod_end(1, 2)
  turn <- rotation_about("z", angle_deg = 90)
  placed <- place_body(place_body(rod, c(1, 0, 0), turn), c(0, 0, 5), turn)
  # The end: (2, 0, 0) -> (0, 2, 0) + (1, 0, 0) -> (-2, 1, 0) + (0, 0, 5).
  line <- rotdyn:::body_solids(placed)[[1]]$points
  expect_equal(line, rbind(c(0, 1, 5), c(-2, 1, 5)))
})

test_that("joined bodies have the outlines of their parts, also placed; holes are holes", {
  ball <- body_sphere(2, 0.1)
  pair <- join_bodies(
    body_rod(1, 1), place_body(ball, c(0.6, 0, 0)), place_body(ball, c(-0.6, 0, 0))
  )
  seen <- shadow(place_body(pair, c(0, 0, 3), rotation_about("z", angle_deg = 90)), 2:3)
  expect_equal(range(seen$fill$across), c(-0.7, 0.7))
  expect_equal(range(seen$fill$up), c(2.9, 3.1))
  expect_equal(range(seen$line$across), c(-0.5, 0.5))
  cut <- cut_body(body_disk(4, 0.2), place_body(body_disk(0.25, 0.05), c(0.1, 0, 0)))
  hole <- shadow(cut, 1:2)$fill
  expect_equal(range(hole$across[hole$hole]), c(0.05, 0.15))
  expect_equal(range(hole$across[!hole$hole]), c(-0.2, 0.2))
  # A hole in a hole is solid.
  ring <- cut_body(body_disk(4, 0.2), cut_body(body_disk(1, 0.1), body_disk(0.25, 0.05)))
  solids <- rotdyn:::body_solids(ring)
  expect_equal(vapply(solids, function(one) one$hole, NA), c(FALSE, TRUE, FALSE))
})

test_that("polygons are not made convex, meshes have the edges where they turn away", {
  ell <- cbind(c(0, 2, 2, 1, 1, 0), c(0, 0, 1, 1, 2, 2))
  fill <- shadow(body_polygon(vertices_m = ell, areal_density_kg_m2 = 8), 1:2)$fill
  expect_equal(cbind(fill$across, fill$up), ell)
  corner <- list(
    vertices = rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)),
    faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  )
  seen <- shadow(body_mesh(corner, mass_kg = 1), 1:2)
  # From above: the triangle (0, 0), (1, 0), (0, 2), three edges of it, and one face.
  expect_equal(nrow(seen$mesh), 3)
  span <- function(x) c(range(x$across), range(x$up))
  expect_equal(span(seen$line), c(0, 1, 0, 2))
  in_mm <- body_mesh(corner, mass_kg = 1, length_unit = "mm")
  expect_equal(span(shadow(in_mm, 1:2)$line), c(0, 1, 0, 2) / 1000)
  box <- shadow(body_mesh(corner, mass_kg = 1, method = "box"), c(1, 3))$fill
  expect_setequal(paste(box$across, box$up), c("0 0", "1 0", "0 3", "1 3"))
  # Loose triangles, as of an STL file, share edges after welding.
  loose <- list(
    vertices = corner$vertices[as.vector(t(corner$faces)), ], faces = matrix(1:12, 4, byrow = TRUE)
  )
  expect_equal(
    nrow(shadow(body_mesh(loose, mass_kg = 1), 1:2)$line), nrow(seen$line)
  )
})

test_that("of a box only the edges of its outline are drawn, and no diagonals of its faces", {
  corners <- as.matrix(expand.grid(x = 0:1, y = 0:1, z = 0:1))
  faces <- rbind(
    c(1, 3, 4, 2), c(5, 6, 8, 7), c(1, 2, 6, 5), c(3, 7, 8, 4), c(1, 5, 7, 3), c(2, 4, 8, 6)
  )
  box <- body_mesh(list(
    vertices = unname(corners), faces = rbind(faces[, 1:3], faces[, c(1, 3, 4)])
  ), mass_kg = 1)
  edges <- function(plane) nrow(rotdyn:::project_solids(rotdyn:::body_solids(box), plane)$line) / 2
  # Along an axis a square; from a corner a hexagon, without the three edges of the near corner.
  for (axes in list(1:2, c(1, 3), 2:3)) expect_equal(edges(plane(axes)), 4)
  expect_equal(edges(cbind(c(1, -1, 0) / sqrt(2), c(1, 1, -2) / sqrt(6))), 6)
})

test_that("what has no outline has none, nor a compound with such a part", {
  tensor <- body_tensor(1, c(5, 6.8, 8.2))
  expect_null(rotdyn:::body_solids(tensor))
  expect_null(rotdyn:::body_solids(join_bodies(body_disk(2, 0.25), tensor)))
  expect_length(rotdyn:::body_solids(join_bodies(body_disk(2, 0.25), body_point(1, 0.5))), 1)
})
