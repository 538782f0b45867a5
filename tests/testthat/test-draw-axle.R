drawing <- function(scene) rotdyn:::constraint_of(scene)$drawing(scene)
fills <- function(drawing) {
  Filter(function(one) one$type == "fill" && one$style %in% c("body", "hole"), drawing$marks)
}
all_points <- function(marks) do.call(rbind, lapply(marks, function(one) one$points))

test_that("the body is drawn to scale about its axle", {
  # A disk about a point of its rim: the outline spans a diameter from the axle.
  scene <- scene_axle(body_disk(2, 0.25), through = c(0.25, 0, 0))
  points <- all_points(fills(drawing(scene)))
  expect_equal(range(points[, 1]), c(-1, 0), tolerance = 1e-12)
  expect_equal(range(points[, 2]), c(-0.5, 0.5), tolerance = 1e-12)
  # About the point above its centre: it hangs.
  hangs <- all_points(fills(drawing(scene_axle(body_disk(2, 0.25), through = c(0, 0.25, 0)))))
  expect_equal(range(hangs[, 2]), c(-1, 0), tolerance = 1e-12)
  # About its centre, the radius is drawn.
  key <- drawing(scene_axle(body_annulus(2, 0.3, 0.1)))
  expect_true(all(c("R", "r") %in% key$quantities$symbol))
  hole <- Filter(function(one) one$style == "hole", key$marks)[[1]]$points
  expect_equal(sqrt(rowSums(hole^2)), rep(1 / 3, nrow(hole)), tolerance = 1e-12)
})

test_that("the start turns it, and the axis is the line of sight", {
  box <- body_rectangle(1, 2, 1)
  turned <- all_points(fills(drawing(scene_axle(box, theta0_rad = pi / 2))))
  expect_equal(diff(range(turned[, 2])) / diff(range(turned[, 1])), 2)
  # The plane across x is right-handed: y, z turn into each other.
  plane <- rotdyn:::across_axle(c(1, 0, 0), 0)
  cross <- function(a, b) {
    c(a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1])
  }
  expect_equal(cross(plane[, 1], plane[, 2]), c(1, 0, 0))
  plane <- rotdyn:::across_axle(c(0, 0, 1), 0.3)
  expect_equal(cross(plane[, 1], plane[, 2]), c(0, 0, 1))
  # A body turned by 0.3 shows its own x axis at 0.3.
  expect_equal(as.double(c(1, 0, 0) %*% plane), c(cos(0.3), sin(0.3)))
})

test_that("a pendulum hangs at its angle, with its weight and its distance to scale", {
  # A rod of 1 m about its end, at 90 degrees: from the axle to the right.
  scene <- scene_pendulum(body_rod(0.1, 1), distance_m = 0.5, theta0_rad = pi / 2)
  look <- drawing(scene)
  rod <- Filter(function(one) one$type == "line" && nrow(one$points) == 2, look$marks)[[1]]$points
  expect_equal(sort(abs(rod[, 1])), c(0, 1.2), tolerance = 1e-9)
  expect_equal(rod[, 2], c(0, 0), tolerance = 1e-9)
  key <- look$quantities
  expect_equal(key$value[key$symbol == "m*g"], "0.9807 N")
  expect_equal(key$value[key$symbol == "d"], "0.5 m")
})

test_that("a law drawn otherwise is not a torque arrow", {
  pendulum <- scene_pendulum(body_point(1), 1, theta0_rad = 1)
  expect_false("tau" %in% drawing(pendulum)$quantities$symbol)
  sprung <- scene_axle(1, torque_spring(3) + torque_constant(2))
  key <- drawing(sprung)$quantities
  expect_equal(key$value[key$symbol %in% c("tau", "k")], c("2 N m", "3 N m/rad"))
})

test_that("a skater's masses are at the radius of gyration", {
  look <- drawing(scene_axle(inertia_knots(c(1, 2), c(4, 1)), omega0_rad_per_s = 2))
  ends <- Filter(function(one) one$type == "fill" && one$style == "hole", look$marks)
  centres <- vapply(ends, function(one) mean(range(one$points[, 1])), 1)
  expect_equal(sort(centres), c(-0.5, 0.5)) # sqrt(1/4)
})

test_that("masses hang from their pulley at the radius of the rope", {
  look <- drawing(scene_hanging_mass(body_disk(2, 0.2), 0.5, 0.1, counter_mass_kg = 4))
  lines <- Filter(function(one) one$type == "line" && nrow(one$points) == 2, look$marks)
  ropes <- vapply(lines, function(one) one$points[1, 1], 0)
  # Half of the radius of the body, which is drawn at 0.6; the first mass is on the left.
  expect_true(all(c(-0.3, 0.3) %in% round(ropes, 12)))
  boxes <- Filter(function(one) nrow(one$points) == 4, fills(look))
  width <- vapply(boxes, function(one) diff(range(one$points[, 1])), 0)
  expect_equal(width[2] / width[1], 2)
  expect_true(all(c("m[1]", "m[2]", "r[1]") %in% look$quantities$symbol))
  alone <- drawing(scene_hanging_mass(0, 1.1, 0.05))
  expect_false("m[2]" %in% alone$quantities$symbol)
  expect_equal(alone$title, "A mass hanging from a pulley")
})

test_that("a brake shoe is pressed against the rim from below, the bearing has its letter", {
  look <- drawing(scene_axle(body_disk(2, 0.25), resistance = resistance(0.3, coulomb_n_m = 0.1)))
  letter <- look$labels[look$labels$symbol == "c", ]
  expect_lt(max(letter$x, letter$y), -0.1)
  of <- function(style) Filter(function(one) one$style == style, look$marks)[[1]]$points
  shoe <- of("fixed")
  rim <- min(all_points(fills(look))[, 2])
  expect_true(all(shoe[, 2] < rim))
  arrow <- of("resistance")
  expect_lt(arrow[2, 2], min(shoe[, 2]))
  expect_gt(arrow[2, 2], min(shoe[, 2]) - 0.05)
  expect_lt(arrow[1, 2], arrow[2, 2])
  expect_equal(arrow[, 1], rep(mean(shoe[, 1]), 2))
})
