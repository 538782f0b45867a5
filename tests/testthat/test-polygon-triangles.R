read_obj_text <- function(lines) {
  path <- tempfile(fileext = ".obj")
  on.exit(unlink(path))
  writeLines(lines, path)
  read_obj(path)
}

test_that("polygons are cut into triangles that cover them once", {
  hexagon <- obj_body(prism_obj(cospi(0:5 / 3), sinpi(0:5 / 3), 1))
  expect_equal(hexagon$mass_kg, 1.5 * sqrt(3), tolerance = 1e-14)
  expect_equal(hexagon$detail$faces, 2 * 4 + 6 * 2)
  corner <- prism_obj(c(1, 2, 2, 0.5, 0.5, 0, 0), c(0, 0, 0.5, 0.5, 2, 2, 0), 1)
  angle <- obj_body(corner)
  expect_equal(angle$mass_kg, 1.75, tolerance = 1e-14)
  # Fans across the notch would count its area twice.
  expect_equal(angle$detail$area_m2, 2 * 1.75 + 8, tolerance = 1e-14)
  # Turned, so that no polygon lies along an axis.
  turned <- rotation_rpy(c(0.3, -0.7, 1.2)) %*% read_obj_text(corner)$vb
  lines <- c(
    sprintf("v %.17g %.17g %.17g", turned[1, ], turned[2, ], turned[3, ]),
    grep("^f", corner, value = TRUE)
  )
  expect_equal(obj_body(lines)$detail$area_m2, 11.5, tolerance = 1e-14)
  # A square in a square, cut open along one line: the corners there come twice.
  keyhole <- obj_body(prism_obj(
    c(0, 3, 3, 0, 0, 1, 1, 2, 2, 1), c(0, 0, 3, 3, 0, 1, 2, 2, 1, 1), 1
  ))
  expect_equal(keyhole$mass_kg, 8, tolerance = 1e-14)
})

test_that("what names no vertex is handed on, to be counted later", {
  square <- rbind(c(0, 1, 1, 0), c(0, 0, 1, 1), 0)
  expect_equal(polygon_triangles(square, matrix(1:4)), cbind(c(1, 2, 3), c(1, 3, 4)))
  expect_equal(polygon_triangles(square, matrix(c(1, 2, NA, 9))), cbind(c(1, 2, NA), c(1, NA, 9)))
  # On a line there is no way round: as many triangles, and none of the edges is lost.
  flat <- polygon_triangles(rbind(0:3, 0, 0), matrix(1:4))
  expect_equal(dim(flat), c(3L, 2L))
  expect_setequal(flat, 1:4)
})

test_that("a convex polygon far longer than wide stays a fan", {
  # The cross products of its corners are some ten times its area.
  kite <- rbind(c(0, 10, 10, 9), c(0, 9, 10, 10), 0)
  expect_equal(polygon_triangles(kite, matrix(1:4)), cbind(c(1, 2, 3), c(1, 3, 4)))
  expect_true(rotdyn:::flat_polygons(kite, matrix(1:4))$convex)
})
