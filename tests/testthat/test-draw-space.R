nut <- function(...) trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), ...)

spinning_top <- function(...) {
  scene_pivot(
    place_body(body_disk(2, 0.15), c(0, 0, 0.15)), c(0, 0, 60),
    attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle"), ...
  )
}

test_that("the solid has the body's moments of inertia", {
  # Of a box of 2 kg, 0.3 x 0.2 x 0.1 m: its half edges.
  moments <- 2 / 12 * c(0.2^2 + 0.1^2, 0.3^2 + 0.1^2, 0.3^2 + 0.2^2)
  box <- solid_of_inertia(moments, diag(3), 2)
  expect_equal(box$semi, c(0.15, 0.1, 0.05))
  expect_equal(apply(abs(box$points), 2, max), box$semi)
  expect_length(box$faces, 6)
  # Of a cylinder of 2 kg, 0.4 m along y, radius 0.1 m.
  moments <- 2 * c(0.1^2 / 4 + 0.4^2 / 12, 0.1^2 / 2, 0.1^2 / 4 + 0.4^2 / 12)
  cylinder <- solid_of_inertia(moments, diag(3), 2)
  expect_equal(cylinder$semi, c(0.1, 0.2, 0.1))
  # A turned box, and one of a rod, a plate, a ball and a point.
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  expect_equal(
    solid_of_inertia(c(1, 2, 2.5), turn)$points,
    solid_of_inertia(c(1, 2, 2.5), diag(3))$points %*% t(turn)
  )
  for (one in list(c(1, 1, 0), c(1, 2, 3), c(1, 1, 1), c(0, 0, 0))) {
    expect_true(all(solid_of_inertia(one, diag(3))$semi > 0))
  }
})

test_that("sides have corners in one plane, in order, and outward normals can be told", {
  for (solid in list(unit_box(), unit_cylinder(1), unit_cylinder(3))) {
    seen <- integer()
    for (at in solid$faces) {
      side <- solid$points[at, ]
      flat <- svd(sweep(side, 2, colMeans(side)))$d
      expect_lt(flat[3], 1e-12)
      seen <- c(seen, at)
    }
    expect_setequal(seen, seq_len(nrow(solid$points)))
    expect_identical(length(solid$fill), length(solid$faces))
  }
})

test_that("of a fixed point, the body hangs where its centre of mass is", {
  solid <- pivot_solid(spinning_top())
  expect_equal(colMeans(solid$points), c(0, 0, 0.15))
  # A disk without thickness: radius 0.15 m, as thick as it has to be to have a side.
  expect_equal(range(solid$points[, 1]), c(-0.15, 0.15), tolerance = 1e-3)
  expect_lt(diff(range(solid$points[, 3])), 0.016)
  expect_gt(solid$tip[3], 0.15)
  expect_equal(unname(solid$rod[2, ]), c(0, 0, min(solid$points[, 3])))
  # The fixed point inside the body: there is no rod to be seen.
  expect_null(pivot_solid(scene_pivot(
    place_body(body_sphere(2, 0.15), c(0, 0, 0.1)), c(0, 0, 6)
  ))$rod)
  point <- pivot_solid(scene_pivot(diag(c(0.02, 0.02, 0)), c(1, 0, 0), mass_kg = 2,
                                   centre_m = c(0, 0, 0.1)))
  expect_equal(colMeans(point$points), c(0, 0, 0.1))
  expect_gt(diff(range(point$points[, 1])), 0)
  light <- pivot_solid(scene_pivot(c(1, 2, 2.5), c(1, 0, 0), mass_kg = 0, centre_m = c(0, 0, 0)))
  expect_equal(colMeans(light$points), c(0, 0, 0))
})

test_that("the sides of a box that are seen are those turned to the reader", {
  box <- unit_box()
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  points <- box$points %*% t(turn)
  marks <- lapply(seq_along(box$faces), function(k) {
    mark_in_space("face", points[box$faces[[k]], ], box$fill[k], "body")
  })
  for (view_deg in list(c(0, 0), c(30, 25), c(-120, 60), c(90, -45))) {
    view <- whole_view(view_deg)
    expect_equal(view %*% t(view), diag(3))
    drawn <- vapply(project_marks(marks, view), `[[`, "", "style")
    # A unit box's sides are centred at their normals.
    normals <- vapply(box$faces, function(at) colMeans(points[at, ]), double(3))
    seen <- drop(view[3, ] %*% normals) > 0
    expect_setequal(drawn, box$fill[seen])
  }
})

test_that("parts are drawn by their depth, and trails behind and before them", {
  toward <- whole_view()[3, ]
  square <- rbind(c(0, 0, 0), c(0, 1, 0), c(0, 1, 1), c(0, 0, 1))
  at <- function(depth, style) {
    mark_in_space("face", sweep(square, 2, depth * toward, "+"), style, style)
  }
  marks <- list(at(2, "#000002"), at(-1, "#000001"), at(3, "#000003"))
  expect_identical(
    vapply(project_marks(marks), `[[`, "", "style"), c("#000001", "#000002", "#000003")
  )
  trail <- c(
    mark_in_space("line", rbind(-2 * toward, -toward, toward, 2 * toward), "speed", "over"),
    list(trail = list(path = NULL, from = 1, to = 3))
  )
  out <- project_marks(c(marks, list(trail)))
  expect_identical(vapply(out, `[[`, "", "type"), c("line", "fill", "fill", "fill", "line"))
  expect_identical(is.na(out[[1]]$points[, 1]), c(FALSE, FALSE, TRUE, TRUE))
  expect_identical(is.na(out[[5]]$points[, 1]), c(TRUE, TRUE, FALSE, FALSE))
})

test_that("frames have the attitude and the arrows of the rows", {
  motion <- nut(time_s = c(1, 3, 5))
  scene <- attr(motion, "run")$scene
  rows <- predict(motion, seq(1, 5, by = 0.25))
  solid <- free_solid(scene)
  film <- space_film(rows, solid)
  turn <- matrix(unlist(attitude_to(rows[10, quaternion_columns], "matrix")), 3, byrow = TRUE)
  of <- function(i, type) Filter(function(one) one$type == type, film$frames[[i]]$marks)
  faces <- of(10, "face")
  expect_equal(faces[[1]]$points, solid$points[solid$faces[[1]], ] %*% t(turn))
  trail <- Filter(function(one) !is.null(one$trail), film$frames[[10]]$marks)[[1]]
  expect_equal(trail$points[10, ], as.vector(turn %*% solid$tip))
  expect_equal(nrow(trail$points), 10)
  # L stays where it is; omega does not.
  tip <- function(i, name) {
    at <- film$frames[[i]]$labels
    unlist(at[at$symbol == name, c("x", "y", "z")])
  }
  expect_equal(tip(1, "L"), tip(17, "L"), tolerance = 1e-13)
  expect_gt(max(abs(tip(1, "omega") - tip(8, "omega"))), 0.01)
})

test_that("a ball has one shape from all sides, and a stand is below or above the point", {
  ball <- solid_of_inertia(c(2, 2, 2), diag(3), 5)
  expect_equal(sqrt(rowSums(ball$points^2)), rep(1, nrow(ball$points)))
  expect_identical(pivot_solid(spinning_top())$stand, 1)
  expect_identical(pivot_solid(scene_pivot(
    place_body(body_sphere(2, 0.05), c(0, 0, -0.35)), c(1, 0, 0)
  ))$stand, -1)
})

test_that("a box with the proportions of a phone has a screen on one side", {
  phone <- scene_free(body_box(0.2, 0.15, 0.075, 0.008), c(0, 4, 0))
  solid <- free_solid(phone)
  expect_length(solid$faces, 7)
  screen <- solid$points[solid$faces[[7]], ]
  # On the side of the shortest axis, with its corners counter-clockwise from outside.
  expect_lt(diff(range(screen[, 3])), 1e-12)
  expect_equal(max(abs(screen[, 3])) / max(abs(screen[, 1])), 0.008 / 0.15 / 0.9, tolerance = 1e-6)
  normal <- cross_product(screen[2, ] - screen[1, ], screen[3, ] - screen[1, ])
  expect_gt(sum(normal * colMeans(screen)), 0)
  for (other in list(
    body_box(1, 0.3, 0.2, 0.1), body_box(0.2, 0.15, 0.12, 0.008), body_box(0.2, 0.15, 0.05, 0.008)
  )) {
    expect_length(free_solid(scene_free(other, c(0, 4, 0)))$faces, 6)
  }
})
