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

# Every argument of every export that is such a number, or that takes bodies: with a number, then
# with a body, the same bits. `argument_cases` has them all, or says why not.
argument_cases <- function() {
  swing <- measured(1.4, 0.001)
  time_s <- seq(0, 10, 0.05)
  coast <- motion_record(data.frame(
    time_s, theta_rad = 10 * (1 - exp(-time_s / 5)) + 1e-3 * sin(1e4 * time_s)
  ), "time_s", "theta_rad")
  list(
    mass = list(
      angular_momentum_of.body = function(x) angular_momentum_of(x, 3, 0.5),
      atwood_machine.mass_1_kg = function(x) atwood_machine(x, 1, body_disk(1, 0.1)),
      atwood_machine.mass_2_kg = function(x) atwood_machine(1, x, body_disk(1, 0.1)),
      body_density.mass_kg = function(x) {
        body_density(1000, domain_ball(0.1), mass_kg = x)$inertia_kg_m2
      },
      body_mesh.mass_kg = function(x) body_mesh(tetrahedron, mass_kg = x)$inertia_kg_m2,
      body_points.mass_kg = function(x) {
        body_points(cbind(x = 1:2, y = 0, z = 0), mass_kg = x)$inertia_kg_m2
      },
      body_polygon.mass_kg = function(x) {
        body_polygon(x, rbind(c(0, 0), c(1, 0), c(0, 1)))$inertia_kg_m2
      },
      body_tensor.mass_kg = function(x) body_tensor(x, c(1, 1, 1))$inertia_kg_m2,
      body_tetrahedron.mass_kg = function(x) body_tetrahedron(x, rbind(0, diag(3)))$inertia_kg_m2,
      check_inertia.mass_kg = function(x) check_inertia(diag(3), mass_kg = x),
      energy_partition.mass_kg = function(x) {
        energy_partition(0.5, 3, mass_kg = x, radius_m = 0.1)
      },
      falling_weight.mass_kg = function(x) falling_weight(x, 0.02),
      hinged_hit.particle_mass_kg = function(x) {
        unclass(hinged_hit(body_disk(1, 0.1), 0.1, 0.2, x, 5))$omega_rad_per_s
      },
      inertia_bifilar.mass_kg = function(x) inertia_bifilar(swing, x, 1, 0.2, 0.3)$value,
      inertia_compound_pendulum.mass_kg = function(x) {
        inertia_compound_pendulum(swing, x, 0.3)$value
      },
      inertia_table.mass_kg = function(x) inertia_table(c("disk", "rod"), mass_kg = x),
      inertia_trifilar.mass_kg = function(x) inertia_trifilar(swing, x, 1, 0.2, 0.3)$value,
      kinetic_energy.mass_kg = function(x) kinetic_energy(1, 2, 3, mass_kg = x),
      load_weight.mass_kg = function(x) load_weight(x, c(1, 0)),
      parallel_axis.mass_kg = function(x) parallel_axis(1, x, 0.3),
      scene_chain.mass_kg = function(x) scene_chain(1, x, 0.1),
      scene_hanging_mass.mass_kg = function(x) scene_hanging_mass(body_disk(1, 0.1), x),
      scene_hanging_mass.counter_mass_kg = function(x) {
        scene_hanging_mass(body_disk(1, 0.1), 5, counter_mass_kg = x)
      },
      scene_hoop.mass_kg = function(x) scene_hoop(x, 0.2, 5),
      scene_pivot.mass_kg = function(x) {
        scene_pivot(c(1, 1, 2), c(0, 0, 9), mass_kg = x, centre_m = c(0, 0, 1))
      },
      torque_gravity.mass_kg = function(x) torque_gravity(x, 0.3)
    ),
    radius = list(
      angular_momentum_of.radius_m = function(x) angular_momentum_of(2, 3, x),
      atwood_machine.radius_m = function(x) {
        atwood_machine(2, 1, body_tensor(2, c(1, 1, 0.06)), radius_m = x)
      },
      curve_circle.radius_m = function(x) curve_circle(x)$x(0.3),
      curve_cycloid.radius_m = function(x) curve_cycloid(x)$x(0.3),
      domain_ball.radius_m = function(x) domain_ball(x)$size_m,
      domain_ball.inner_radius_m = function(x) domain_ball(2, inner_radius_m = x)$size_m,
      domain_cylinder.radius_m = function(x) domain_cylinder(x, 1)$size_m,
      domain_cylinder.inner_radius_m = function(x) {
        domain_cylinder(2, 1, inner_radius_m = x)$size_m
      },
      energy_partition.radius_m = function(x) energy_partition(0.5, 3, mass_kg = 1, radius_m = x),
      falling_weight.radius_m = function(x) falling_weight(1, x),
      inertia_table.radius_m = function(x) inertia_table(c("disk", "hoop"), radius_m = x),
      inertia_trifilar.upper_radius_m = function(x) inertia_trifilar(swing, 1, 1, x, 0.3)$value,
      inertia_trifilar.lower_radius_m = function(x) inertia_trifilar(swing, 1, 1, 0.2, x)$value,
      loop_leaving_angle.radius_m = function(x) loop_leaving_angle(0.5, x, 1.5 * 0.25),
      loop_start_height.radius_m = function(x) loop_start_height(0.5, x),
      point_motion.radius_m = function(x) point_motion(3, x),
      rims_meet.radius_1_m = function(x) {
        unclass(rims_meet(1, 1, 3, 1, radius_1_m = x, radius_2_m = 0.1))$omega_1_rad_per_s
      },
      rims_meet.radius_2_m = function(x) {
        unclass(rims_meet(1, 1, 3, 1, radius_1_m = 0.1, radius_2_m = x))$omega_1_rad_per_s
      },
      roll_race.radius_m = function(x) summary(roll_race("hoop", radius_m = x)),
      scene_hanging_mass.radius_m = function(x) scene_hanging_mass(1, 1, radius_m = x),
      scene_hoop.radius_m = function(x) scene_hoop(0.3, x, 5),
      scene_incline.radius_m = function(x) {
        scene_incline(body_tensor(1, c(1, 1, 1) / 100), 10, radius_m = x)
      },
      spool_pull.radius_m = function(x) spool_pull(body_disk(1, 0.4), 5, 10, 0.1, radius_m = x),
      spool_pull.inner_radius_m = function(x) spool_pull(body_disk(1, 0.4), 5, 10, x),
      torque_of_force.radius_m = function(x) torque_of_force(5, x),
      yo_yo.radius_m = function(x) yo_yo(body_disk(1, 0.4), 0.1, radius_m = x),
      yo_yo.inner_radius_m = function(x) yo_yo(body_disk(1, 0.4), x)
    ),
    moment = list(
      angular_impulse.body = function(x) angular_impulse(2, 0, 1, body = x)[1:3],
      clutch_engagement.body_1 = function(x) clutch_engagement(x, 3, 5, 9),
      clutch_engagement.body_2 = function(x) clutch_engagement(3, x, 5, 9),
      disks_lock.body_1 = function(x) unclass(disks_lock(x, 3, 9, 0))$common_omega_rad_per_s,
      disks_lock.body_2 = function(x) unclass(disks_lock(3, x, 9, 0))$common_omega_rad_per_s,
      estimate_motion.inertia = function(x) estimate_motion(coast, inertia = x)$net_torque_n_m,
      fit_coast_down.inertia = function(x) fit_coast_down(coast, inertia = x)$value,
      gear_train.bodies = function(x) gear_train(list(x, 1), 3)$reflected_inertia_kg_m2,
      inertia_knots.moment_of_inertia_kg_m2 = function(x) {
        inertia_knots(0:1, if (is.list(x)) list(x, x) else c(x, x))
      },
      kinetic_energy.body = function(x) kinetic_energy(x, 3),
      parallel_axis.inertia_kg_m2 = function(x) {
        parallel_axis(x, if (is.list(x)) x else 2, 0.3)
      },
      reflected_inertia.moment_of_inertia_kg_m2 = function(x) reflected_inertia(x, 3),
      rims_meet.body_1 = function(x) {
        unclass(rims_meet(x, 1, 3, 1, radius_1_m = 0.1, radius_2_m = 0.1))$omega_1_rad_per_s
      },
      rims_meet.body_2 = function(x) {
        unclass(rims_meet(1, x, 3, 1, radius_1_m = 0.1, radius_2_m = 0.1))$omega_1_rad_per_s
      },
      rotor.moment_of_inertia_kg_m2 = function(x) rotor("z", x, 3),
      scene_axle.body = function(x) trajectory(scene_axle(x, 1), 0:3)$theta_rad,
      scene_clutch.body_1 = function(x) scene_clutch(x, 1, 3)$moment_of_inertia_kg_m2,
      scene_clutch.body_2 = function(x) scene_clutch(1, x, 3)$moment_of_inertia_kg_m2,
      scene_drive.bodies = function(x) {
        scene_drive(list(x, 1), coupling_shaft(3))$moment_of_inertia_kg_m2
      },
      scene_gears.bodies = function(x) scene_gears(list(x, 1), 3)$moment_of_inertia_kg_m2,
      scene_hanging_mass.body = function(x) {
        scene_hanging_mass(x, 1, radius_m = 0.1)$moment_of_inertia_kg_m2
      },
      scene_rotors.bodies = function(x) scene_rotors(list(x, 1), 3)$moment_of_inertia_kg_m2,
      spin_up.body = function(x) spin_up(x, time_s = 0:3)$theta_rad
    ),
    beta = list(
      energy_partition.body = function(x) energy_partition(x, 2)$rotational_energy_fraction,
      hill_leaving_angle.body = hill_leaving_angle,
      loop_leaving_angle.body = function(x) loop_leaving_angle(x, 1, 1.5),
      loop_start_height.body = function(x) loop_start_height(x, 1),
      roll_on_curve.body = function(x) {
        roll_on_curve(curve_circle(1), 0.5, 0.2, x)$time_s
      },
      rolling_acceleration.body = function(x) rolling_acceleration(x, 20),
      rolling_critical_angle.body = function(x) rolling_critical_angle(x, 0.3),
      rolling_final_speed.body = function(x) rolling_final_speed(x, 2),
      rolling_friction_coefficient.body = function(x) rolling_friction_coefficient(x, 20)
    ),
    tensor = list(
      body_tensor.inertia_kg_m2 = function(x) body_tensor(2, x)$inertia_kg_m2,
      flip_time.body = function(x) flip_time(x, c(0.01, 4, 0.01)),
      principal_axes.body = function(x) principal_axes(x)$principal_moment_kg_m2,
      scene_free.body = function(x) {
        trajectory(scene_free(x, c(0.01, 4, 0.01)), 0:3)$omega_x_rad_per_s
      },
      spin_stability.body = function(x) spin_stability(x)$principal_moment_kg_m2,
      symmetry_class.body = function(x) symmetry_class(x)
    )
  )
}
# Those that take a body and no number instead of it, rows of bodies, or another number.
bodies_alone <- c(
  "ball_bounce.body", "ball_on_turntable.body", "centre_of_percussion.body", "collide.body_1",
  "collide.body_2", "cut_body.body", "cut_body.hole", "falling_rod.rod", "hinged_hit.body",
  "inertia_table.bodies", "inertia_tensor.body", "moment_of_inertia.body", "place_body.body",
  "precession_table.tops", "precession_table.transverse_moment_kg_m2", "radius_of_gyration.body",
  "roll_disk.body", "roll_race.bodies", "rolling_disk_speed.body", "rolling_table.bodies",
  "scene_incline.body", "scene_pendulum.body", "scene_pivot.body", "spool_pull.body", "yo_yo.body",
  "atwood_machine.pulley"
)
tetrahedron <- list(
  vertices = rbind(0, diag(3)), faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
)

test_that("no argument of any export that is such a number goes without a body", {
  skip_on_cran() # exhaustive: `make test` runs it
  exports <- Filter(is.function, lapply(
    stats::setNames(nm = sort(getNamespaceExports("rotdyn"))), getExportedValue, ns = "rotdyn"
  ))
  found <- unlist(lapply(names(exports), function(name) {
    arguments <- grep(
      paste0(
        "(^|_)(mass|radius)(_[0-9])?_(kg|m)$|moment|^inertia(_kg_m2)?$|^bod(y|ies)(_[0-9])?$|",
        "beta|^hole$"
      ),
      names(formals(exports[[name]])), value = TRUE
    )
    if (length(arguments)) paste0(name, ".", arguments)
  }))
  cases <- argument_cases()
  # Shapes have a test of their own.
  shapes <- grep("^body_(?!density|points|tensor|mesh)", found, value = TRUE, perl = TRUE)
  expect_gt(length(shapes), 60)
  expect_setequal(
    c(unlist(lapply(cases, names), use.names = FALSE), bodies_alone),
    c(setdiff(found, shapes), "atwood_machine.pulley", "falling_rod.rod", "precession_table.tops",
      "body_polygon.mass_kg", "body_tetrahedron.mass_kg")
  )
  disk <- body_disk(2, 0.25)
  box <- body_box(1, 1, 2, 3)
  of_number <- list(
    mass = 2, radius = 0.25, moment = disk$inertia_kg_m2[9], beta = 0.5,
    tensor = unclass(box$inertia_kg_m2)
  )
  of_body <- list(mass = disk, radius = disk, moment = disk, beta = disk, tensor = box)
  for (kind in names(cases)) {
    for (name in names(cases[[kind]])) {
      f <- cases[[kind]][[name]]
      number <- suppressMessages(f(of_number[[kind]]))
      body <- suppressMessages(f(of_body[[kind]]))
      # The laws of a function's environment are others.
      expect_true(identical(number, body, ignore.environment = TRUE), info = name)
    }
  }
})

test_that("every shape takes its mass and its radii from bodies", {
  disk <- body_disk(2, 0.25)
  small <- body_disk(1, 0.07)
  sizes <- function(name) switch(name,
    mass_kg = 2, vertices_m = rbind(0, diag(3)), sides = 6, inner_radius_m = , top_radius_m = ,
    tube_radius_m = 0.07, height_m = 0.2, if (grepl("radius_m$", name)) 0.25 else 0.5
  )
  instead <- function(name) switch(name,
    mass_kg = disk, inner_radius_m = , top_radius_m = , tube_radius_m = small,
    if (grepl("radius_m$", name)) disk else sizes(name)
  )
  makers <- grep("^body_(?!density|points|tensor|mesh)", getNamespaceExports("rotdyn"),
                 value = TRUE, perl = TRUE)
  for (maker in makers) {
    f <- getExportedValue("rotdyn", maker)
    needed <- Filter(function(x) identical(x, quote(expr = )), as.list(formals(f)))
    names <- setdiff(names(needed), "...")
    names <- union(names, grep("radius_m$", names(formals(f)), value = TRUE))
    numbers <- lapply(stats::setNames(nm = names), sizes)
    if (maker == "body_polygon") numbers$vertices_m <- rbind(c(0, 0), c(1, 0), c(0, 1))
    bodies <- lapply(stats::setNames(nm = names), instead)
    if (maker == "body_polygon") bodies$vertices_m <- numbers$vertices_m
    expect_identical(do.call(f, bodies), do.call(f, numbers), info = maker)
  }
})

test_that("a body does not stand for a moment about another axis", {
  rows <- data.frame(
    mass_kg = 2, moment_of_inertia_kg_m2 = 0.06, spin_rad_per_s = 300, lever_arm_m = 0.1
  )
  expect_error(
    precession_table(rows, transverse_moment_kg_m2 = body_disk(2, 0.25)), "takes a body",
    class = "rotdyn_error_type"
  )
})
