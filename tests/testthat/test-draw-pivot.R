# Of the weight, and of omega.
arrow_tips <- function(drawing) {
  of <- function(style) {
    Filter(function(one) one$type == "arrow" && one$style == style, drawing$marks)
  }
  lapply(c(of("weight"), of("speed")), function(one) one$points[2, ] - one$points[1, ])
}

test_that("a body with a fixed point: its weight down, omega along its direction in space", {
  top <- function(...) {
    scene_pivot(c(0.02, 0.02, 0.01), c(0, 0, 30), mass_kg = 0.5, centre_m = c(0, 0, 0.08), ...)
  }
  drawing <- draw_pivot(top())
  tips <- arrow_tips(drawing)
  expect_length(tips, 2)
  expect_equal(tips[[1]][1], 0)
  expect_lt(tips[[1]][2], 0)
  expect_equal(tips[[2]][1], 0)
  expect_gt(tips[[2]][2], 0)
  values <- drawing$quantities
  expect_match(values$value[values$symbol == "m*g"], "4.903", fixed = TRUE)
  expect_match(values$value[values$symbol == "omega"], "30", fixed = TRUE)
  expect_match(values$value[values$symbol == "r[c]"], "0.08", fixed = TRUE)
  expect_match(values$value[values$symbol == "I[3]"], "0.01", fixed = TRUE)
  # Turned by a half about x, the body hangs and omega points down.
  hung <- arrow_tips(draw_pivot(top(attitude0 = c(0, 1, 0, 0))))
  expect_lt(hung[[2]][2], 0)
  # A quarter about x: z of the body is -y of space, to the left in this view.
  lying <- arrow_tips(draw_pivot(top(attitude0 = rotation_about("x", angle_deg = 90))))
  expect_lt(lying[[2]][1], -0.3)
})

test_that("without gravity there is no weight, at rest no angular velocity", {
  free <- scene_pivot(
    c(1, 2, 2.5), c(0, 0, 0), mass_kg = 1, centre_m = c(0, 0, 0.1), gravity_m_per_s2 = 0
  )
  expect_length(arrow_tips(draw_pivot(free)), 0)
})

test_that("the drawing holds a box about the point", {
  drawing <- draw_pivot(
    scene_pivot(c(1, 1, 2), c(0, 0, 3), mass_kg = 1, centre_m = c(0, 0, 0.1))
  )
  expect_identical(drawing$limits, c(-1.5, 1.5, -1.5, 1.5))
  inside <- function(p) all(abs(p) <= 1.5)
  expect_true(all(vapply(drawing$marks, function(one) inside(one$points), NA)))
})

test_that("the letter of a rotor stands beyond the tip of its axis", {
  wheels <- list(rotor(c(0, 0, 1), 0.1, 50), rotor(c(1, 0, 0), 0.1, 20))
  drawing <- draw_free(scene_free(c(1, 2, 2.6), c(0.05, 6, 0.05), rotors = wheels))
  axes <- Filter(function(one) one$type == "arrow" && one$style == "spring", drawing$marks)
  expect_length(axes, 2)
  for (k in 1:2) {
    at <- unlist(drawing$labels[drawing$labels$symbol == paste0("W[", k, "]"), c("x", "y")])
    away <- at - axes[[k]]$points[2, ]
    expect_equal(sqrt(sum(away^2)), 0.12, tolerance = 1e-6)
    expect_gt(sum(away * axes[[k]]$points[2, ]), 0)
  }
})

test_that("rotors of the body have their rates", {
  gyrostat <- scene_pivot(
    c(0.02, 0.02, 0.01), c(0, 0, 30), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
    rotors = rotor(c(0, 0, 1), 0.003, 50)
  )
  values <- draw_pivot(gyrostat)$quantities
  expect_match(values$value[values$name == "rotor"], "50 rad/s", fixed = TRUE)
  expect_match(values$value[values$symbol == "L"], "0.45", fixed = TRUE)
})
