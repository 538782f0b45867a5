skip_if_not_installed("ggplot2")

keys <- function(scene) rotdyn:::constraint_of(scene)$drawing(scene)$quantities

test_that("every kind of scene draws without a warning, in letters of any size, with words", {
  scenes <- list(
    scene_axle(2), scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03, 1e-3, 0.1, 0.2), 0.5, -3),
    scene_axle(body_tensor(1, c(5, 6.8, 8.2)), torque_motor(2, 300) + torque_spring(3), axis = "x"),
    scene_axle(inertia_knots(c(1, 2), c(5, 2)), omega0_rad_per_s = 2),
    scene_axle(1, function(t) sin(t)), scene_axle(1, torque_gravity(1, 0.5)),
    scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = pi / 3),
    scene_pendulum(
      body_point(0.4), 0.5, resistance(0.01), theta0_rad = -3, omega0_rad_per_s = 1, torque = 1
    ),
    scene_gears(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4)),
    scene_rotors(c(1, 2, 1), c(500, 0), torque = c(3, 0, -3)), scene_rotors(1:20, 500),
    scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0), engage_s = 1)
  )
  for (scene in scenes) {
    for (size in or_long(24, c(13, 24))) {
      plot <- ggplot2::autoplot(scene, base_size = size)
      expect_silent(ggplot2::ggplotGrob(plot))
    }
    expect_match(plot$labels$alt, "moment of inertia|weight")
  }
})

test_that("the key has the quantities of the scene, and leaves out what is zero", {
  scene <- scene_axle(
    body_disk(2, 0.25), 0.8, resistance(0.03, coulomb_n_m = 0.1), omega0_rad_per_s = 10
  )
  key <- keys(scene)
  value <- function(symbol) key$value[key$symbol == symbol]
  expect_equal(value("I"), "0.0625 kg m^2")
  expect_equal(value("m"), "2 kg")
  expect_equal(value("r"), "0.25 m")
  expect_equal(value("tau"), "0.8 N m")
  expect_equal(value("omega[0]"), "10 rad/s")
  expect_equal(value("c"), "0.03 N m s")
  expect_equal(value("tau[f]"), "0.1 N m")
  expect_setequal(keys(scene_axle(2))$symbol, "I")
  expect_false("theta[0]" %in% key$symbol)
})

test_that("a scene whose constraint has no drawing is drawn with its numbers", {
  scene <- structure(
    list(height_m = 100, mass_kg = 2, drag_kg_per_m = 0, name = "x"),
    class = c("rot_scene_none", "rot_scene")
  )
  drawing <- rotdyn:::default_drawing(scene)
  expect_equal(drawing$quantities$name, c("height", "mass"))
  expect_equal(drawing$quantities$value, c("100 m", "2 kg"))
  expect_silent(ggplot2::ggplotGrob(rotdyn:::draw(drawing, "A thing", 13)))
  # A law has a unit and no number.
  scene$force_n <- function(time_s) 1
  expect_equal(rotdyn:::default_drawing(scene)$quantities$name, c("height", "mass"))
  # Several moments of inertia are rotors in a line.
  scene$moment_of_inertia_kg_m2 <- c(1, 2, 1)
  scene$couplings <- list(list(kind = 1, ratio = 1), list(kind = 2, ratio = -3))
  expect_silent(ggplot2::ggplotGrob(
    rotdyn:::draw(rotdyn:::default_drawing(scene), "A chain", 13)
  ))
})

test_that("values are said with their unit: equal ones once, many by their range", {
  say <- rotdyn:::value_text
  expect_equal(say(c(1, 2, 1), "kg"), "1, 2, 1 kg")
  expect_equal(say(c(2, 2), "kg"), "2 kg")
  expect_equal(say(1:9, "kg"), "1 to 9 kg")
  expect_equal(rotdyn:::torque_text(torque_constant(-3)), "-3 N m")
  expect_equal(rotdyn:::torque_text(article_torque()), "0 to 0.8 N m over time")
  expect_equal(rotdyn:::torque_text(torque_motor(2, 300)), "2 N m of a motor at rest")
})

test_that("arrows have the sense of the sign", {
  # The end of an arrow that turns counter-clockwise from 0 degrees is above its beginning.
  to <- function(sign) rotdyn:::turn_arrow(0, 0, 1, 0, 90, sign, "torque")$points
  expect_equal(to(1)[c(1, 61), ], rbind(c(1, 0), c(0, 1)))
  expect_equal(to(-1)[c(1, 61), ], rbind(c(0, 1), c(1, 0)))
})

test_that("a spring runs from its end to its end, straight there and to both sides between", {
  spring <- rotdyn:::draw_spring(1, 3, 5, 0.2)
  expect_false(is.unsorted(spring[, 1], strictly = TRUE))
  expect_identical(range(spring[, 1]), c(1, 3))
  expect_equal(spring[c(1, 2, nrow(spring) - 1:0), 2], rep(5, 4))
  expect_equal(range(spring[, 2]), c(4.8, 5.2))
})

test_that("a scene with one moment of inertia and no drawing is a body, with several a line", {
  one <- structure(
    list(moment_of_inertia_kg_m2 = 2, height_m = 3), class = c("rot_scene_none", "rot_scene")
  )
  drawing <- rotdyn:::default_drawing(one)
  expect_identical(drawing$note, "not to scale")
  expect_length(drawing$marks, 1)
  one$moment_of_inertia_kg_m2 <- c(2, 2)
  expect_gt(length(rotdyn:::default_drawing(one)$marks), 1)
  # Words in its place are not drawn.
  one$moment_of_inertia_kg_m2 <- c("a", "b")
  expect_length(rotdyn:::default_drawing(one)$marks, 1)
})
