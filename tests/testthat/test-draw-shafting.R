chain <- function(scene) rotdyn:::constraint_of(scene)$drawing(scene)

test_that("each rotor and each piece of shaft is drawn", {
  look <- chain(scene_rotors(c(1, 2, 1), c(500, 0), torque = c(3, 0, -3)))
  styles <- vapply(look$marks, function(one) one$style, "")
  types <- vapply(look$marks, function(one) one$type, "")
  expect_equal(sum(styles == "body" & types == "fill"), 3)
  expect_equal(sum(styles == "spring"), 1)
  expect_equal(sum(styles == "dashed"), 1) # the piece without stiffness
  expect_equal(sum(styles == "torque"), 2)
  expect_setequal(
    look$labels$symbol, c("I[1]", "I[2]", "I[3]", "k[1]", "tau[1]", "tau[3]")
  )
  # The first arrow goes to the left over the top, the last to the right.
  arrows <- look$marks[styles == "torque"]
  ends <- vapply(arrows, function(one) diff(one$points[c(1, nrow(one$points)), 1]), 1)
  expect_equal(sign(ends), c(-1, 1))
})

test_that("a clutch is two plates, a gear two wheels in the ratio of their radii", {
  look <- chain(scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0)))
  expect_equal(sum(vapply(look$marks, function(one) one$style == "shaft", NA)), 2)
  key <- look$quantities
  expect_equal(key$value[key$symbol == "T"], "12 N m")
  gear <- rotdyn:::draw_shafting(
    list(moment_of_inertia_kg_m2 = c(1, 2)), c(1, 2), list(kind = "gear", ratio = -3)
  )
  wheels <- Filter(function(one) one$style == "shaft", gear$marks)
  heights <- vapply(wheels, function(one) diff(range(one$points[, 2])), 1)
  expect_equal(heights[2] / heights[1], 3)
  # They touch.
  expect_equal(min(wheels[[1]]$points[, 2]), max(wheels[[2]]$points[, 2]))
})

test_that("many rotors have no letters", {
  expect_equal(nrow(chain(scene_rotors(1:20, 500))$labels), 0)
})

test_that("a drive shows its clutches and brakes", {
  drive <- scene_drive(
    list(0.02, 1, 0.5), list(coupling_clutch(12), coupling_shaft(800)),
    brake = list(NULL, NULL, brake(4, from_s = 2))
  )
  look <- rotdyn:::drive_constraint()$drawing(drive)
  key <- look$quantities
  expect_equal(key$value[match(c("T[1]", "B[3]", "k[i]"), key$symbol)],
    c("12 N m", "4 N m, from 2 s", "800 N m/rad"))
  expect_true(all(c("T[1]", "B[3]", "k[2]") %in% look$labels$symbol))
  terms <- audit(trajectory(drive, c(0, 0.1)))$terms[[1]]$term
  expect_true("work of the torques" %in% terms)
})

test_that("the rate of a braked rotor is below its brake, a shaft with gears has its spring", {
  scene <- scene_drive(
    c(1, 2), coupling_shaft(100, ratio = 4), brake = list(NULL, brake(3)), omega0_rad_per_s = 1
  )
  drawing <- chain(scene)
  at <- function(symbol) drawing$labels$y[drawing$labels$symbol == symbol]
  expect_lt(at("omega[2]"), at("B[2]") - 0.3)
  expect_gt(at("omega[2]"), drawing$limits[3])
  expect_true("k[1]" %in% drawing$labels$symbol)
})
