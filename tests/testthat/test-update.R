test_that("a scene is made again with some arguments changed", {
  wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03), omega0_rad_per_s = 3)
  expect_identical(
    update(wheel, omega0_rad_per_s = 20, torque = NULL),
    scene_axle(body_disk(2, 0.25), NULL, resistance(0.03), omega0_rad_per_s = 20)
  )
  expect_identical(update(wheel), wheel)
  expect_identical(update(wheel, resistance = NULL)$resistance, NULL)
  expect_s3_class(update(wheel, body = 3), "rot_scene_axle")
})

test_that("what had its default follows", {
  ball <- body_sphere(6, 0.11)
  lane <- scene_incline(ball, 10, v0_m_per_s = 3, static_friction = 0.2)
  faster <- update(lane, v0_m_per_s = 4)
  expect_identical(faster, scene_incline(ball, 10, v0_m_per_s = 4, static_friction = 0.2))
  expect_equal(faster$omega0_rad_per_s, 4 / 0.11)
  # Larger ball, its own radius; kinetic friction as static.
  large <- update(lane, body = body_sphere(6, 0.2), static_friction = 0.4)
  expect_equal(large$radius_m, 0.2)
  expect_equal(large$kinetic_friction, 0.4)
  # What was given stays.
  slides <- scene_incline(ball, 10, v0_m_per_s = 3, omega0_rad_per_s = 0, static_friction = 0.2)
  expect_identical(update(slides, v0_m_per_s = 4)$omega0_rad_per_s, 0)
})

test_that("scenes of every constructor are updated", {
  scenes <- list(
    scene_axle(1, function(time_s) time_s), scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 1),
    scene_hanging_mass(body_disk(1, 0.1), 2), scene_gears(c(1, 2), 3, torque = c(1, 0)),
    scene_clutch(1, 2, 3, omega0_rad_per_s = c(1, 0)), scene_rotors(c(1, 2), 5),
    scene_drive(c(1, 2), coupling_gear(2)), scene_incline(body_disk(1, 0.1), 20),
    scene_free(c(1, 2, 3), c(1, 1, 1)), scene_hoop(1, 1, 3), scene_chain(c(1, 1), 1, 0.1),
    scene_equations(function(x, v) c(v, -x), c(x = 1, v = 0), positions = "x"),
    scene_pivot(c(1, 1, 2), c(0, 0, 9), mass_kg = 1, centre_m = c(0, 0, 1))
  )
  for (scene in scenes) {
    later <- update(scene, start_s = 2)
    expect_identical(later$start_s, 2)
    expect_identical(class(later), class(scene))
    expect_identical(update(later, start_s = 0), scene)
  }
  # A function with breaks keeps them.
  push <- torque_function(function(time_s) c(time_s < 1, 0, 0), 1)
  pulsed <- scene_free(c(1, 1, 1), c(0, 0, 0), torque = push)
  expect_identical(update(pulsed, start_s = -1)$breaks_s, 1)
})

test_that("bodies", {
  expect_identical(update(body_disk(2, 0.25), mass_kg = 3), body_disk(3, 0.25))
  placed <- place_body(body_sphere(1, 0.1), c(1, 0, 0))
  expect_equal(update(placed, at_m = c(2, 0, 0))$centre_m, c(2, 0, 0), ignore_attr = TRUE)
  expect_error(
    update(body_density(function(x, y, z) 1 + 0 * x, domain_ball(1)), mass_kg = 2),
    class = "rotdyn_error_type"
  )
})

test_that("wrong arguments are named with the user's call", {
  wheel <- scene_axle(1, omega0_rad_per_s = 3)
  error <- expect_error(update(wheel, omega_rad_per_s = 2), class = "rotdyn_error_argument")
  expect_match(conditionMessage(error), "omega0_rad_per_s")
  expect_error(update(wheel, 2), class = "rotdyn_error_argument")
  error <- expect_error(update(wheel, omega0_rad_per_s = "2"), class = "rotdyn_error_type")
  expect_identical(as.character(conditionCall(error)[[1]]), "update")
})
