test_that("the race of the article: the order depends on beta alone", {
  race <- roll_race(incline_angle_deg = 30, length_m = 2, gravity_m_per_s2 = 9.8)
  order <- summary(race)
  expect_identical(order$object, c(
    "point_mass_sliding", "solid_sphere", "solid_disk", "thin_spherical_shell", "hoop"
  ))
  expect_identical(order$place, 1:5)
  # t = sqrt(2 L (1 + beta)/(g sin))
  expect_equal(order$finish_time_s, sqrt(4 * (1 + order$beta) / 4.9), tolerance = 1e-15)
  expect_equal(order$final_speed_m_per_s, sqrt(4 * 4.9 / (1 + order$beta)), tolerance = 1e-15)
  expect_identical(order$from_rest, rep(c("slides", "rolls"), c(1, 4)))
  expect_equal(order$friction_needed, rolling_friction_coefficient(order$beta, 30),
    tolerance = 1e-15)
  expect_output(print(race), "point mass sliding after 0.9035")
})

test_that("a row for each body and time, and each is what its scene does", {
  bodies <- list(hoop = body_hoop(2, 0.3), ball = body_sphere(1, 0.05))
  race <- roll_race(
    bodies, 25, 3, static_friction = 0.2, kinetic_friction = 0.15, rolling_arm_m = 0.002,
    time_s = c(0, 0.5, 1, 1.5, 9)
  )
  expect_identical(nrow(race), 10L)
  expect_identical(race$time_s, rep(c(0, 0.5, 1, 1.5, 9), each = 2))
  expect_identical(race$lane, rep(1:2, 5))
  expect_identical(race$object, rep(c("hoop", "ball"), 5))
  for (i in 1:2) {
    scene <- scene_incline(
      bodies[[i]], 25, static_friction = 0.2, kinetic_friction = 0.15, rolling_arm_m = 0.002
    )
    mine <- race[race$lane == i, ]
    finish <- time_when(scene, x_m = 3)$time_s
    expect_equal(summary(race)$finish_time_s[summary(race)$object == names(bodies)[i]], finish,
      tolerance = 1e-13)
    there <- predict(trajectory(scene, 0:1), pmin(mine$time_s, finish))
    for (column in c("x_m", "v_m_per_s", "theta_rad", "omega_rad_per_s")) {
      expect_equal(mine[[column]], there[[column]], tolerance = 1e-13)
    }
    expect_identical(mine$finished, mine$time_s >= finish)
  }
  # The hoop needs 0.23, so it slides.
  expect_setequal(summary(race)$from_rest, c("slides", "rolls"))
  known <- column_table()$name
  expect_setequal(setdiff(c(names(race), names(summary(race))), c(known, "object")), character())
})

test_that("limits: nothing moves, no body, no time", {
  up <- roll_race("hoop", -20)
  expect_identical(summary(up)$place, NA_integer_)
  expect_identical(summary(up)$finish_time_s, Inf)
  still <- roll_race(data.frame(beta = 0.4), 1, rolling_arm_m = 0.01)
  expect_identical(summary(still)$from_rest, "rests")
  expect_true(all(still$x_m == 0))
  expect_identical(nrow(roll_race(time_s = double())), 0L)
  expect_identical(nrow(roll_race(data.frame(beta = double()))), 0L)
  expect_identical(nrow(summary(roll_race(data.frame(beta = double())))), 0L)
  missing <- roll_race(data.frame(beta = c(NA, 1)), time_s = 1)
  expect_identical(is.na(missing$x_m), c(TRUE, FALSE))
  near <- roll_race("hoop", 89.9999999999, static_friction = 0.5)
  expect_identical(summary(near)$from_rest, "slides")
})

test_that("columns replace arguments", {
  lanes <- data.frame(
    object = c("a", "b"), beta = c(0.5, 0.5), length_m = c(1, 4), incline_angle_deg = c(30, 30)
  )
  order <- summary(roll_race(lanes, 10, 7))
  expect_equal(order$finish_time_s[2] / order$finish_time_s[1], 2, tolerance = 1e-15)
  expect_identical(names(order)[2:5], c("object", "beta", "length_m", "incline_angle_deg"))
})

test_that("bad calls are refused by the user's call", {
  expect_error(roll_race(3), class = "rotdyn_error_type")
  expect_error(roll_race(data.frame(a = 1)), class = "rotdyn_error_type")
  expect_error(roll_race("box"), class = "rotdyn_error_value")
  expect_error(roll_race(list(1)), class = "rotdyn_error_type")
  expect_error(roll_race(data.frame(beta = c(1, -1))), "row 2", class = "rotdyn_error_value")
  expect_error(roll_race(incline_angle_deg = 91), class = "rotdyn_error_value")
  expect_error(roll_race(length_m = 0), class = "rotdyn_error_value")
  expect_error(roll_race(length_m = 1:2), class = "rotdyn_error_size")
  expect_error(roll_race(static_friction = 0.1, kinetic_friction = 0.2),
    class = "rotdyn_error_value")
  expect_error(roll_race(time_s = -1), class = "rotdyn_error_time")
  expect_error(roll_race(time_s = 2:1), class = "rotdyn_error_time")
  expect_error(roll_race(speed = 2), class = "rotdyn_error_argument")
  expect_error(roll_race(frames = 0), class = "rotdyn_error_value")
})

test_that("rows that were filtered or changed are no race: they would be taken for the whole", {
  race <- roll_race(c("hoop", "sphere"))
  expect_identical(race[], race)
  expect_s3_class(race[names(race)], "rot_race")
  for (part in list(race[1:2, ], race["time_s"], race[rev(seq_len(nrow(race))), ])) {
    expect_false(inherits(part, "rot_race"))
    expect_null(attr(part, "race"))
  }
  expect_output(print(race[1:2, ]), "A tibble: 2")
  skip_if_not_installed("dplyr")
  expect_s3_class(dplyr::mutate(race, heat = 1), "rot_race")
  expect_false(inherits(dplyr::filter(race, lane == 1), "rot_race"))
  expect_false(inherits(dplyr::mutate(race, x_m = 2 * x_m), "rot_race"))
})

test_that("without an arrival the frames end after a second", {
  flat <- roll_race(c("hoop", "sphere"), incline_angle_deg = 0, frames = 3)
  expect_identical(unique(flat$time_s), c(0, 0.5, 1))
  expect_true(all(flat$x_m == 0))
})
