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

# For each constructor a call, and another value for every argument.
update_cases <- function() {
  disk <- body_disk(2, 0.25)
  ball <- body_sphere(1, 0.1)
  rod <- body_rod(1, 1)
  slope <- function(time_s, theta_rad, omega_rad_per_s) -theta_rad
  turned <- attitude_from(c(0.6, 0.8, 0, 0), "quaternion", order = "wxyz")
  list(
    scene_axle = list(
      list(body = disk, torque = 0.8, resistance = resistance(0.03), omega0_rad_per_s = 3),
      list(
        body = list(ball, 3, inertia_knots(0:1, c(2, 1))),
        torque = list(NULL, 2, slope, torque_motor(1, 10), torque_motor(1, 10) + slope),
        resistance = list(NULL, 0.2, resistance(coulomb_n_m = 1)), theta0_rad = list(1),
        omega0_rad_per_s = list(20), brake = list(brake(3), NULL), start_s = list(-1),
        axis = list("x", c(1, 1, 0)), through = list("origin", c(0, 0.1, 0), "centre")
      )
    ),
    scene_pendulum = list(
      list(body = rod, distance_m = 0.5, theta0_rad = 1),
      list(
        body = list(disk, body_rod_end(1, 2)), distance_m = list(0.3),
        resistance = list(0.1, NULL),
        theta0_rad = list(0.2), omega0_rad_per_s = list(2), torque = list(1, slope, NULL),
        start_s = list(3), axis = list("y"), gravity_m_per_s2 = list(1.62)
      )
    ),
    scene_hanging_mass = list(
      list(body = disk, mass_kg = 1, theta0_rad = 0),
      list(
        body = list(body_disk(3, 0.3)), mass_kg = list(2, ball), radius_m = list(0.2),
        resistance = list(0.1), theta0_rad = list(1), omega0_rad_per_s = list(-1),
        counter_mass_kg = list(0.5), start_s = list(1), axis = list(c(0, 0, -1)),
        gravity_m_per_s2 = list(1.62)
      )
    ),
    scene_gears = list(
      list(bodies = c(1, 2), ratios = 3, torque = c(1, 0), omega0_rad_per_s = 6),
      list(
        bodies = list(list(disk, 3), c(4, 5)), ratios = list(2, -4), efficiency = list(0.9),
        torque = list(0, c(0, 2), list(torque_motor(1, 2), NULL)),
        resistance = list(0.1, c(0, 0.2), list(NULL, resistance(coulomb_n_m = 1))),
        brake = list(list(NULL, brake(2))), theta0_rad = list(1),
        omega0_rad_per_s = list(0), start_s = list(2)
      )
    ),
    scene_rotors = list(
      list(bodies = c(1, 2), stiffness_n_m_per_rad = 5, omega0_rad_per_s = c(1, 0)),
      list(
        bodies = list(c(3, 4), list(disk, ball)), stiffness_n_m_per_rad = list(7),
        damping_n_m_s = list(0.1), torque = list(c(1, 0), list(slope, NULL)),
        resistance = list(0.1, c(0, 0.2), list(resistance(coulomb_n_m = 1), NULL)),
        brake = list(list(brake(1), NULL)), theta0_rad = list(c(0, 1)),
        omega0_rad_per_s = list(0, c(2, 3)), start_s = list(2)
      )
    ),
    scene_clutch = list(
      list(body_1 = 1, body_2 = 2, capacity_n_m = 3, omega0_rad_per_s = c(5, 0)),
      list(
        body_1 = list(disk, 4), body_2 = list(3), capacity_n_m = list(5),
        static_capacity_n_m = list(4), torque = list(c(1, 0), list(torque_motor(1, 2), NULL)),
        resistance = list(list(0.1, NULL)), brake = list(list(NULL, brake(1))),
        theta0_rad = list(c(1, 2)), omega0_rad_per_s = list(c(0, 5)), engage_s = list(1),
        start_s = list(-2)
      )
    ),
    scene_drive = list(
      list(bodies = c(1, 2), couplings = coupling_gear(2), omega0_rad_per_s = 2),
      list(
        bodies = list(c(3, 4), list(disk, 1)),
        couplings = list(coupling_shaft(5), coupling_clutch(3)),
        torque = list(list(1, NULL), list(NULL, slope), c(1, 2)), resistance = list(c(0.1, 0.2)),
        brake = list(list(brake(1), NULL)), theta0_rad = list(c(2, 1)),
        omega0_rad_per_s = list(c(4, 2)), start_s = list(1)
      )
    ),
    scene_incline = list(
      list(body = ball, incline_angle_deg = 20, static_friction = 0.4, v0_m_per_s = 1),
      list(
        body = list(body_sphere(2, 0.2), disk), incline_angle_deg = list(0, 30),
        static_friction = list(0.5, Inf), kinetic_friction = list(0.3), rolling_arm_m = list(1e-3),
        radius_m = list(0.05), v0_m_per_s = list(3), omega0_rad_per_s = list(0, 5),
        x0_m = list(2), theta0_rad = list(1), resistance = list(resistance(drag_n_s_per_m = 0.1)),
        force = list(2, function(time_s) time_s, force_function(function(time_s) 1, 2)),
        gravity_m_per_s2 = list(1.62), start_s = list(1)
      )
    ),
    scene_hoop = list(
      list(mass_kg = 1, radius_m = 0.5, hoop_omega_rad_per_s = 3, theta0_rad = 0.1),
      list(
        mass_kg = list(2), radius_m = list(1), hoop_omega_rad_per_s = list(0),
        theta0_rad = list(1), omega0_rad_per_s = list(1),
        resistance = list(resistance(drag_n_s_per_m = 1)), static_friction = list(0.3),
        kinetic_friction = list(0), gravity_m_per_s2 = list(1), start_s = list(1)
      )
    ),
    scene_chain = list(
      list(length_m = c(1, 1), mass_kg = 1, theta0_rad = 0.1),
      list(
        length_m = list(c(2, 1)), mass_kg = list(c(1, 2), 3), theta0_rad = list(c(0, 1), 0.2),
        links = list("points"), omega0_rad_per_s = list(1), resistance = list(0.1),
        gravity_m_per_s2 = list(1), start_s = list(1)
      )
    ),
    scene_free = list(
      list(body = c(1, 2, 3), omega0_rad_per_s = c(1, 1, 1)),
      list(
        body = list(disk, c(2, 2, 3)), omega0_rad_per_s = list(c(0, 4, 0.1)),
        attitude0 = list(turned),
        torque = list(c(0, 0, 1), list(z = 1), function(time_s) c(1, 0, 0)),
        torque_axes = list("space"), resistance = list(resistance(damping_per_s = 0.1)),
        rotors = list(rotor("z", 0.1, 3), list(rotor("x", 0.1, 3, 1))), start_s = list(1)
      )
    ),
    scene_pivot = list(
      list(body = disk, omega0_rad_per_s = c(0, 0, 60), pivot_m = c(0, 0, -0.1)),
      list(
        body = list(body_disk(3, 0.3)), omega0_rad_per_s = list(c(1, 0, 9)),
        pivot_m = list(c(0, 0, -0.2)), attitude0 = list(turned), gravity_m_per_s2 = list(1.62),
        torque = list(c(0, 0, 1), list(z = 1)), torque_axes = list("space"),
        resistance = list(resistance(damping_per_s = 0.1)), rotors = list(rotor("z", 0.01, 3)),
        start_s = list(1)
      )
    ),
    scene_pivot = list(
      list(body = c(1, 1, 2), omega0_rad_per_s = c(0, 0, 9), mass_kg = 1, centre_m = c(0, 0, 1)),
      list(
        mass_kg = list(2), centre_m = list(c(0, 0, 2)), body = list(c(1, 1, 1.5)),
        start_s = list(1)
      )
    ),
    scene_equations = list(
      list(f = swings, start = c(x = 1, v = 0)),
      list(
        f = list(function(x, v) c(v, -2 * x)), start = list(c(x = 2, v = 1)), positions = list("x"),
        conserved = list(list(energy = function(x, v) x^2 + v^2)), start_s = list(1)
      )
    )
  )
}
swings <- function(x, v) c(v, -x)
quietly <- function(code) suppressMessages(suppressWarnings(code))
make <- function(name, arguments) {
  quietly(do.call(getExportedValue("rotdyn", name), arguments, quote = TRUE))
}

test_that("every argument of every scene is changed, one at a time, as if it was made so", {
  cases <- update_cases()
  makers <- grep("^scene_(?!hash|code)", getNamespaceExports("rotdyn"), value = TRUE, perl = TRUE)
  for (maker in makers) {
    tried <- unlist(lapply(cases[names(cases) == maker], function(one) names(one[[2]])))
    arguments <- setdiff(names(formals(getExportedValue("rotdyn", maker))), "...")
    expect_setequal(tried, arguments)
  }
  for (i in seq_along(cases)) {
    maker <- names(cases)[i]
    base <- cases[[i]][[1]]
    scene <- make(maker, base)
    for (argument in names(cases[[i]][[2]])) {
      for (value in cases[[i]][[2]][[argument]]) {
        change <- stats::setNames(list(value), argument)
        other <- base
        other[argument] <- change
        want <- make(maker, other)
        got <- quietly(do.call(update, c(list(scene), change), quote = TRUE))
        expect_identical(got, want, info = paste(maker, argument))
        # And back again.
        if (argument %in% names(base) && identical(class(got), class(scene))) {
          back <- quietly(do.call(update, c(list(got), base[argument]), quote = TRUE))
          expect_identical(back, scene, info = paste(maker, argument, "back"))
        }
      }
    }
  }
})

test_that("every argument of every body is changed, one at a time, as if it was made so", {
  makers <- grep("^body_(?!density|points|mesh|tensor)", getNamespaceExports("rotdyn"),
                 value = TRUE, perl = TRUE)
  first <- function(name) switch(name,
    mass_kg = 2, vertices_m = rbind(0, diag(3)), sides = 6, inner_radius_m = , top_radius_m = ,
    tube_radius_m = 0.07, height_m = 0.2,
    if (grepl("radius_m$", name)) 0.25 else 0.5
  )
  then <- function(name) switch(name,
    vertices_m = rbind(0, diag(c(1, 1, 2))), sides = 8,
    1.1 * first(name)
  )
  for (maker in makers) {
    f <- getExportedValue("rotdyn", maker)
    needed <- Filter(function(x) identical(x, quote(expr = )), as.list(formals(f)))
    arguments <- lapply(stats::setNames(nm = setdiff(names(needed), "...")), first)
    if (maker == "body_polygon") arguments$vertices_m <- rbind(c(0, 0), c(1, 0), c(0, 1))
    body <- do.call(f, arguments)
    expect_identical(update(body), body, info = maker)
    for (name in names(arguments)) {
      value <- if (maker == "body_polygon" && name == "vertices_m") {
        rbind(c(0, 0), c(2, 0), c(0, 1))
      } else then(name)
      other <- arguments
      other[[name]] <- value
      got <- do.call(update, c(list(body), stats::setNames(list(value), name)))
      expect_identical(got, do.call(f, other), info = paste(maker, name))
    }
    # A density instead of the mass.
    density <- grep("density", names(formals(f)), value = TRUE)
    if (length(density)) {
      dense <- do.call(update, c(list(body), stats::setNames(list(3), density)))
      other <- c(arguments[names(arguments) != "mass_kg"], stats::setNames(list(3), density))
      expect_identical(dense, do.call(f, other), info = maker)
      expect_identical(update(dense, mass_kg = 2), body, info = maker)
    }
  }
})

test_that("what cannot be changed is refused with the reason", {
  disk <- body_disk(2, 0.25)
  braked <- scene_axle(1, 1, brake = brake(2), omega0_rad_per_s = 3)
  expect_identical(
    update(braked, brake = brake(3)), scene_axle(1, 1, brake = brake(3), omega0_rad_per_s = 3)
  )
  expect_identical(update(braked, torque = 4), scene_axle(1, 4, brake = brake(2),
                                                          omega0_rad_per_s = 3))
  motor <- list(torque_motor(1, 2), NULL)
  for (one in list(
    list(quote(update(braked, body = 3)), "`body` is in its `bodies`"),
    list(quote(update(scene_gears(1:2, 3, torque = motor), ratios = 4)), "in its `couplings`"),
    list(quote(update(scene_rotors(1:2, 3, torque = motor), damping_n_m_s = 4)), "`couplings`"),
    list(quote(update(scene_clutch(1, 2, 3, torque = motor), capacity_n_m = 4)), "`couplings`"),
    list(quote(update(scene_axle(1), torqe = 4)), "Did you mean `torque`"),
    list(quote(update(scene_axle(1), gravity_m_per_s2 = 4)), "The arguments are `body`"),
    list(quote(update(join_bodies(disk, disk), mass_kg = 3)), "no argument `mass_kg`"),
    list(quote(update(body_tensor(9, c(9, 9, 9), c(0.1, 0, 0), about = "origin"), mass_kg = 3)),
         "body_tensor\\(\\)"),
    list(quote(update(body_density(1, domain_ball(1)), mass_kg = 3)), "body_density\\(\\)"),
    list(quote(update(disk, mass_kg = -1)), "mass_kg"),
    list(quote(update(scene_axle(inertia_knots(0:1, 1:2)), brake = brake(1))), "coulomb_n_m")
  )) {
    error <- expect_error(eval(one[[1]]), class = "rotdyn_error")
    expect_match(gsub("\\s+", " ", conditionMessage(error)), one[[2]])
  }
})
