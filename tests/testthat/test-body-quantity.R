# A body stands for its mass, its radius, its moment of inertia or beta: with the same bits.

test_that("every function that takes a mass, a radius, beta or a moment takes a body", {
  disk <- body_disk(2, 0.25)
  ball <- body_sphere(0.3, 0.07)
  swing <- measured(1.4, 0.001)
  same <- function(with_number, with_body) expect_identical(with_body, with_number)
  # A mass.
  same(torque_gravity(2, 0.3), torque_gravity(disk, 0.3))
  same(load_weight(2, c(1, 0)), load_weight(disk, c(1, 0)))
  same(falling_weight(0.3, 0.02), falling_weight(ball, 0.02))
  same(scene_hanging_mass(disk, 0.3, 0.1), scene_hanging_mass(disk, ball, 0.1))
  same(
    scene_hanging_mass(disk, 0.3, counter_mass_kg = 0.1),
    scene_hanging_mass(disk, ball, counter_mass_kg = body_point(0.1))
  )
  same(scene_hoop(0.3, 0.2, 5), scene_hoop(ball, 0.2, 5))
  same(scene_hoop(0.3, 0.07, 5), scene_hoop(0.3, ball, 5))
  same(scene_chain(c(1, 2), c(2, 0.3), 0), scene_chain(c(1, 2), list(disk, ball), 0))
  same(
    scene_pivot(c(1, 1, 2), c(0, 0, 9), mass_kg = 2, centre_m = c(0, 0, 1)),
    scene_pivot(c(1, 1, 2), c(0, 0, 9), mass_kg = disk, centre_m = c(0, 0, 1))
  )
  same(
    hinged_hit(disk, 0.1, 0.2, 0.3, 5)$omega_rad_per_s,
    hinged_hit(disk, 0.1, 0.2, ball, 5)$omega_rad_per_s
  )
  same(
    atwood_machine(c(2, 0.3), 1, disk), atwood_machine(list(disk, ball), body_point(1), disk)
  )
  same(
    inertia_compound_pendulum(swing, 2, 0.3)$value,
    inertia_compound_pendulum(swing, disk, 0.3)$value
  )
  same(
    inertia_bifilar(swing, 2, 1, 0.2, 0.3)$value, inertia_bifilar(swing, disk, 1, 0.2, 0.3)$value
  )
  same(
    inertia_trifilar(swing, 2, 1, 0.2, 0.3)$value, inertia_trifilar(swing, disk, 1, 0.2, 0.3)$value
  )
  same(angular_momentum_of(2, 3, 0.5), angular_momentum_of(disk, 3, 0.5))
  same(angular_momentum_of(c(2, 0.3), 3, 0.5), angular_momentum_of(list(disk, ball), 3, 0.5))
  same(check_inertia(diag(3), mass_kg = 2), check_inertia(diag(3), mass_kg = disk))
  # A radius.
  same(point_motion(3, 0.25), point_motion(3, disk))
  same(point_motion(3, c(0.25, 0.07)), point_motion(3, list(disk, ball)))
  same(torque_of_force(5, 0.25), torque_of_force(5, disk))
  # A moment of inertia.
  moment <- disk$inertia_kg_m2[9]
  same(reflected_inertia(moment, 3), reflected_inertia(disk, 3))
  same(parallel_axis(moment, 2, 0.3), parallel_axis(disk, disk, 0.3))
  same(rotor("z", moment, 3), rotor("z", disk, 3))
  same(clutch_engagement(moment, 3, 5, 9), clutch_engagement(disk, 3, 5, 9))
  same(disks_lock(moment, 3, 9, 0), disks_lock(disk, 3, 9, 0))
  same(
    angular_impulse(2, 0, 1, body = moment)[1:3], angular_impulse(2, 0, 1, body = disk)[1:3]
  )
  same(gear_train(c(moment, 1), 3), gear_train(list(disk, 1), 3))
  same(scene_axle(moment)$moment_of_inertia_kg_m2, scene_axle(disk)$moment_of_inertia_kg_m2)
  same(
    scene_rotors(c(moment, 1), 3)$moment_of_inertia_kg_m2,
    scene_rotors(list(disk, 1), 3)$moment_of_inertia_kg_m2
  )
  # Beta, by a body, a list of them, a name.
  for (f in list(
    function(x) rolling_acceleration(x, 20), function(x) rolling_final_speed(x, 2),
    function(x) rolling_friction_coefficient(x, 20), function(x) rolling_critical_angle(x, 0.3),
    function(x) loop_start_height(x, 1), function(x) loop_leaving_angle(x, 1, 1.5),
    hill_leaving_angle, function(x) energy_partition(x, 2)$rotational_energy_fraction
  )) {
    same(f(0.5), f(disk))
    same(f(c(0.5, 0.4)), f(list(disk, ball)))
    same(f(c(1, 0.4)), f(c("hoop", "sphere")))
  }
  same(rolling_table(data.frame(beta = 0.5))$final_speed_m_per_s,
       rolling_table(disk)$final_speed_m_per_s)
  same(energy_partition(0.5, 3, mass_kg = 2, radius_m = 0.25), energy_partition(disk, 3))
  same(
    energy_partition(c(0.5, 0.4), 3, mass_kg = c(2, 0.3), radius_m = c(0.25, 0.07)),
    energy_partition(list(disk, ball), 3)
  )
})

test_that("a body has no other numbers, and not all bodies have these", {
  disk <- body_disk(2, 0.25)
  box <- body_box(1, 1, 2, 3)
  expect_error(torque_constant(disk), "stands for", class = "rotdyn_error_type")
  expect_error(body_disk(2, 0.1, areal_density_kg_m2 = disk), class = "rotdyn_error")
  expect_error(scene_axle(1, theta0_rad = disk), class = "rotdyn_error_type")
  expect_error(rolling_acceleration(box, 20), "no beta", class = "rotdyn_error_value")
  expect_error(rolling_acceleration("cone", 20), class = "rotdyn_error_value")
  expect_error(point_motion(1, box), "radius", class = "rotdyn_error_missing")
  expect_error(torque_gravity(list(disk, disk), 1), class = "rotdyn_error_size")
  expect_error(torque_gravity(list(disk, 2), 1), class = "rotdyn_error_type")
  expect_error(energy_partition(disk, 1, mass_kg = 2), class = "rotdyn_error_argument")
})
