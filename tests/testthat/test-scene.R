test_that("the moment of inertia is that about the axle", {
  disk <- body_disk(2, 3)
  expect_equal(scene_axle(disk)$moment_of_inertia_kg_m2, 9)
  expect_equal(scene_axle(disk, axis = c(5, 0, 0))$moment_of_inertia_kg_m2, 4.5)
  expect_equal(scene_axle(disk, axis = c(1e-200, 0, 1e-200))$moment_of_inertia_kg_m2, 6.75)
  expect_equal(scene_axle(0.7)$moment_of_inertia_kg_m2, 0.7)
})

test_that("without inertia about the axle there is no motion", {
  expect_error(scene_axle(body_disk(0, 1)), class = "rotdyn_error_value")
  expect_error(scene_axle(body_rod(1, 1), axis = c(1, 0, 0)), class = "rotdyn_error_value")
  expect_error(scene_axle(0), class = "rotdyn_error_value")
  expect_error(scene_axle(-1), class = "rotdyn_error_value")
  expect_error(scene_axle("disk"), class = "rotdyn_error_type")
  expect_error(scene_axle(body_disk(1, 1), axis = c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(scene_axle(1, omega0_rad_per_s = Inf), class = "rotdyn_error_value")
})

test_that("a scene prints itself", {
  expect_snapshot(article_scene(omega0_rad_per_s = 3, start_s = -1))
})

test_that("an axle goes through the centre, or the point that is asked for", {
  rod <- body_rod_end(2, 3)
  moved <- place_body(body_rod(2, 3), c(1.5, 0, 0))
  expect_message(centre <- scene_axle(moved), class = "rotdyn_message_axle")
  expect_equal(centre$moment_of_inertia_kg_m2, 2 * 3^2 / 12)
  expect_no_message(end <- scene_axle(rod, through = "origin"))
  expect_equal(end$moment_of_inertia_kg_m2, 2 * 3^2 / 3)
  expect_no_message(same <- scene_axle(rod, through = "centre"))
  expect_equal(same$moment_of_inertia_kg_m2, 2 * 3^2 / 12)
  aside <- place_body(body_disk(2, 0.5), c(1, 2, 7))
  expect_equal(scene_axle(aside, through = "origin")$moment_of_inertia_kg_m2, 0.25 + 2 * 5)
  expect_equal(scene_axle(aside, through = c(1, 0, 0))$moment_of_inertia_kg_m2, 0.25 + 2 * 4)
  expect_equal(
    scene_axle(aside, axis = "x", through = "origin")$moment_of_inertia_kg_m2, 0.125 + 2 * 53
  )
  expect_equal(
    scene_axle(body_rod(1.5, 2), axis = "y", through = c(0, 5, 0))$moment_of_inertia_kg_m2, 0.5
  )
  # Along the axle a place is of no account.
  expect_no_message(scene_axle(place_body(body_disk(2, 0.5), c(0, 0, 7))))
  expect_no_message(scene_axle(body_cone(1, 0.5, 2)))
  expect_error(scene_axle(rod, through = "end"), class = "rotdyn_error_value")
  expect_error(scene_axle(rod, through = 1), class = "rotdyn_error_size")
})

test_that("an axis is checked where it has no effect, too", {
  expect_error(scene_axle(1, axis = "nonsense"), class = "rotdyn_error_value")
  expect_error(scene_axle(1, axis = c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(scene_pendulum(body_point(1), 1, axis = "nonsense"), class = "rotdyn_error_value")
})

test_that("scenes take the axle that the body names, and print where it passes", {
  rod <- body_rod_end(1.5, 2)
  shown <- function(x) paste(capture.output(print(x)), collapse = "\n")
  expect_no_message(scene <- scene_axle(rod, 1))
  expect_equal(scene$moment_of_inertia_kg_m2, 2)
  expect_match(shown(scene), "2 kg m^2 about the axle, through the rod's end", fixed = TRUE)
  expect_match(shown(scene_axle(rod, 1, through = "centre")), "through the centre of mass")
  expect_match(shown(scene_axle(rod, 1, through = c(0, 1, 0))), "through (0, 1, 0) m", fixed = TRUE)
  expect_match(shown(scene_axle(body_point(2, 0.5))), "0.5 m from the point")
  # Wherever the rod was put: about its end, and a rod along z has no moment about z.
  placed <- place_body(rod, c(3, -4, 5), rotation_about("z", angle_deg = 30))
  expect_equal(scene_axle(placed)$moment_of_inertia_kg_m2, 2)
  upright <- place_body(rod, c(3, -4, 5), rotation_about("y", angle_deg = 90))
  expect_equal(scene_axle(upright, axis = "x")$moment_of_inertia_kg_m2, 2)
  # One moment wherever a body stands for it.
  expect_equal(inertia_table(rod)$moment_of_inertia_kg_m2, 2)
  expect_match(inertia_table(rod)$axis, "through one end")
  expect_equal(moment_of_inertia(rod, "z"), 2)
  expect_match(shown(rod), "m l^2 / 3 = 2 kg m^2", fixed = TRUE)
  expect_match(shown(body_point(2, 0.5)), "m r^2 = 0.5 kg m^2", fixed = TRUE)
  expect_equal(gear_train(list(rod, rod), 2)$moment_of_inertia_kg_m2, c(2, 2))
  expect_equal(scene_rotors(list(rod, rod), 2)$moment_of_inertia_kg_m2, c(2, 2))
  expect_equal(scene_clutch(rod, 1, 2)$moment_of_inertia_kg_m2, c(2, 1))
})

test_that("a pendulum hangs from the axle that the body names", {
  expect_equal(scene_pendulum(body_rod_end(1.5, 2))$moment_of_inertia_kg_m2, 2)
  expect_equal(scene_pendulum(body_rod_end(1.5, 2))$distance_m, 1)
  expect_equal(scene_pendulum(body_point(2, 0.5))$moment_of_inertia_kg_m2, 0.5)
  placed <- place_body(body_rod_end(1.5, 2), c(3, -4, 5), rotation_about("z", angle_deg = 30))
  expect_equal(scene_pendulum(placed)$distance_m, 1, tolerance = 1e-15)
  # Along the axle the distance does not count.
  expect_error(scene_pendulum(body_rod_end(1.5, 2), axis = "x"), class = "rotdyn_error_missing")
  expect_error(scene_pendulum(body_disk(1, 1)), "distance_m", class = "rotdyn_error_missing")
  expect_equal(scene_pendulum(body_rod_end(1.5, 2), 0.5)$moment_of_inertia_kg_m2, 0.5 + 1.5 / 4)
})

test_that("a bare number stands for a moment of inertia, in no scene for a mass", {
  expect_error(scene_pendulum(2, 1), "body_point\\(2\\)", class = "rotdyn_error_type")
})

test_that("a pendulum prints its body, its moment about the axle and the distance", {
  expect_output(
    print(scene_pendulum(body_rod(0.1, 1), 0.5)), "rod on a fixed axle.*the axle, 0.5 m from"
  )
})

test_that("a brake on an axle", {
  # 0.8 N m for 2 s on 0.5 kg m^2 give 3.2 rad/s; 1.6 N m stop it in 1 s; the brake holds.
  scene <- scene_axle(
    0.5, torque_steps(c(0, 2), c(0.8, 0)), brake = brake(1.6, from_s = 2)
  )
  expect_s3_class(scene, "rot_scene_drive")
  x <- trajectory(scene, c(0, 2, 2.5, 3, 9))
  expect_equal(x$omega_rad_per_s, c(0, 3.2, 1.6, 0, 0), tolerance = 1e-9)
  expect_equal(x$heat_j[5], 0.5 * 0.5 * 3.2^2, tolerance = 1e-9)
  expect_equal(stopping(scene)$stop_time_s, 3, tolerance = 1e-9)
  # About the axle that is named, not through the centre.
  rod <- scene_axle(body_rod(3, 2), brake = brake(1), through = c(1, 0, 0), omega0_rad_per_s = 1)
  expect_equal(rod$moment_of_inertia_kg_m2, 3 * 2^2 / 3, tolerance = 1e-14)
  expect_error(
    scene_axle(inertia_knots(0:1, 1:2), brake = brake(1)), class = "rotdyn_error_value"
  )
  expect_error(scene_axle(1, brake = 3), class = "rotdyn_error_type")
})

test_that("a resistance that was left out of the motion has its heat all the same", {
  # I omega' = cos(3 t): omega = 10 + sin(3 t)/6; heat: the integral of q omega^3.
  scene <- scene_axle(
    2, torque_sinusoid(1, 3), resistance(quadratic_n_m_s2 = 1e-6), omega0_rad_per_s = 10
  )
  motion <- trajectory(scene, 0:4, accuracy = 1e-2)
  expect_identical(summary(motion)$model, "axle_forced")
  heat <- function(t) 1e-6 * (10 + sin(3 * t) / 6)^3
  want <- vapply(0:4, function(t) stats::integrate(heat, 0, t, rel.tol = 1e-12)$value, 0)
  expect_equal(augment(motion)$dissipated_quadratic_j, want, tolerance = 1e-10)
})

test_that("a symmetric body through its own axis says nothing, one beside it says how far", {
  about <- function(body) off_own_axis(body, c(0, 0, 1))
  disk <- body_disk(2, 0.25)
  expect_identical(about(place_body(disk, c(0, 0, 3))), 0) # along the axis
  expect_equal(about(place_body(disk, c(0.3, 0.4, 3))), 0.5)
  expect_identical(about(body_rod_end(1, 2)), 0) # names its axle
  expect_identical(about(disk), 0)
})

test_that("an axis is scaled to unit length unless rounding alone is left", {
  axis_of <- function(axis) as.double(scene_axle(body_box(1, 0.1, 0.2, 0.3), axis = axis)$axis)
  expect_identical(axis_of(c(0.6, 0.8, 0)), c(0.6, 0.8, 0))
  expect_lte(abs(sum(axis_of(c(0.6, 0.8, 0) * (1 + 1e-13))^2) - 1), 4 * .Machine$double.eps)
  expect_identical(axis_of(c(0, 0, 1 + 1e-13)), c(0, 0, 1))
  expect_identical(axis_of(c(0, 0, 5e300)), c(0, 0, 1))
})
