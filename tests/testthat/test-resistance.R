test_that("a resistance is what was given", {
  expect_equal(unclass(resistance(0.03)), list(
    viscous_n_m_s = 0.03, quadratic_n_m_s2 = 0, coulomb_n_m = 0, static_n_m = 0, damping_per_s = 0,
    drag_n_s_per_m = 0, drag_n_s2_per_m2 = 0
  ))
  expect_equal(unclass(resistance(coulomb_n_m = 0.2)), list(
    viscous_n_m_s = 0, quadratic_n_m_s2 = 0, coulomb_n_m = 0.2, static_n_m = 0.2, damping_per_s = 0,
    drag_n_s_per_m = 0, drag_n_s2_per_m2 = 0
  ))
  expect_equal(resistance(-0.1)$viscous_n_m_s, -0.1)
  expect_snapshot({
    resistance()
    resistance(0.03)
    resistance(0.03, 1e-4, 0.2, 0.3)
    resistance(coulomb_n_m = 0.2)
  })
})

test_that("impossible ones are refused", {
  expect_error(resistance(NA), class = "rotdyn_error_type")
  expect_error(resistance(Inf), class = "rotdyn_error_value")
  expect_error(resistance(c(1, 2)), class = "rotdyn_error_size")
  expect_error(resistance(0, -1), class = "rotdyn_error_value")
  expect_error(resistance(coulomb_n_m = -1), class = "rotdyn_error_value")
  expect_error(resistance(coulomb_n_m = 1, static_n_m = 0.5), class = "rotdyn_error_value")
})

test_that("a scene takes a resistance, or its viscous coefficient", {
  expect_identical(scene_axle(1, resistance = 0.03), scene_axle(1, resistance = resistance(0.03)))
  expect_error(scene_axle(1, resistance = "a"), class = "rotdyn_error_type")
  expect_error(scene_free(c(1, 1, 1), c(0, 0, 1), resistance = 0.1), class = "rotdyn_error_type")
})

# Every term in every scene: taken, or refused by its name.
test_that("terms of a resistance by scenes", {
  ball <- body_sphere(1, 0.1)
  torque_terms <- c("viscous_n_m_s", "quadratic_n_m_s2", "coulomb_n_m", "static_n_m")
  scenes <- list(
    list(function(r) scene_axle(1, resistance = r), torque_terms),
    list(function(r) scene_pendulum(body_rod(1, 1), resistance = r, distance_m = 0.5),
      torque_terms),
    list(function(r) scene_hanging_mass(body_disk(1, 0.1), 1, resistance = r), torque_terms),
    list(function(r) scene_drive(c(1, 2), coupling_gear(2), resistance = list(r, NULL)),
      torque_terms),
    list(function(r) scene_rotors(c(1, 2), 3, resistance = r), torque_terms),
    list(function(r) scene_rotors(c(1, 2), 3, resistance = list(r, NULL)), torque_terms),
    list(function(r) scene_gears(c(1, 2), 3, resistance = r), torque_terms),
    list(function(r) scene_clutch(1, 2, 3, resistance = list(r, NULL)), torque_terms),
    list(function(r) scene_chain(c(1, 1), 1, 0, resistance = r), "viscous_n_m_s"),
    list(function(r) scene_free(c(1, 1, 1), c(0, 0, 1), resistance = r), "damping_per_s"),
    list(
      function(r) scene_pivot(c(1, 1, 1), c(0, 0, 1), mass_kg = 1, centre_m = 1:3, resistance = r),
      "damping_per_s"
    ),
    list(
      function(r) scene_incline(ball, 20, resistance = r), c("drag_n_s_per_m", "drag_n_s2_per_m2")
    ),
    list(function(r) scene_hoop(1, 1, 2, resistance = r), "drag_n_s_per_m")
  )
  for (one in scenes) {
    for (term in names(resistance_terms)) {
      given <- list(0.1)
      names(given) <- term
      made <- function() one[[1]](do.call(resistance, given))
      if (term %in% one[[2]]) {
        scene <- made()
        expect_s3_class(scene, "rot_scene")
        motion <- trajectory(scene, c(0, 0.1))
        expect_true(glance(motion)$error < 1e-6, info = term)
      } else {
        error <- expect_error(made(), class = "rotdyn_error_value")
        expect_match(conditionMessage(error), term, fixed = TRUE)
        expect_match(conditionMessage(error), one[[2]][1], fixed = TRUE)
      }
    }
  }
})

# Every accepted term against Runge-Kutta, moving one way; and at rest against a motor.
test_that("every term of a resistance resists as its formula says, in every scene that takes it", {
  g <- 9.80665
  terms <- list(
    viscous = list(resistance(0.2), function(w) 0.2 * w),
    quadratic = list(resistance(quadratic_n_m_s2 = 0.1), function(w) 0.1 * abs(w) * w),
    coulomb = list(resistance(coulomb_n_m = 0.3), function(w) 0.3 * sign(w)),
    static = list(resistance(static_n_m = 0.3), function(w) 0),
    all = list(
      resistance(0.2, 0.1, 0.3, 0.5), function(w) 0.2 * w + 0.1 * abs(w) * w + 0.3 * sign(w)
    ),
    driving = list(resistance(-0.2), function(w) -0.2 * w)
  )
  disk <- body_disk(2, 0.1)
  axle <- c("theta_rad", "omega_rad_per_s")
  scenes <- list(
    axle = list(function(r) scene_axle(2, 0.1, r, omega0_rad_per_s = 3), c(0, 3),
                function(t, y, r) c(y[2], (0.1 - r(y[2])) / 2)),
    skater = list(
      function(r) scene_axle(inertia_knots(0:1, c(2, 1)), 0.1, r, omega0_rad_per_s = 3), c(0, 3),
      function(t, y, r) c(y[2], (0.1 - r(y[2]) + y[2]) / (2 - t))
    ),
    braked = list(
      function(r) scene_axle(2, 0.1, r, brake = brake(0.4, to_s = 0.2), omega0_rad_per_s = 3),
      c(0, 3), function(t, y, r) c(y[2], (0.1 - r(y[2]) - 0.4 * (t < 0.2)) / 2), 0.2
    ),
    pendulum = list(
      function(r) scene_pendulum(body_rod(1, 1), 0.5, r, 0.3, 10), c(0.3, 10),
      function(t, y, r) c(y[2], 3 * (-0.5 * g * sin(y[1]) - r(y[2])))
    ),
    hanging = list(
      function(r) scene_hanging_mass(disk, 1, resistance = r, omega0_rad_per_s = 3), c(0, 3),
      function(t, y, r) c(y[2], (0.1 * g - r(y[2])) / (0.01 + 0.01))
    ),
    rotors = list(
      function(r) {
        scene_rotors(c(1, 2), 5, resistance = list(r, NULL), omega0_rad_per_s = c(3, 3))
      }, c(0, 0, 3, 3), function(t, y, r) {
        shaft <- 5 * (y[1] - y[2])
        c(y[3], y[4], -shaft - r(y[3]), shaft / 2)
      }
    ),
    rotors_all = list(
      function(r) scene_rotors(c(1, 2), 5, resistance = r, omega0_rad_per_s = c(3, 3)),
      c(0, 0, 3, 3), function(t, y, r) {
        shaft <- 5 * (y[1] - y[2])
        c(y[3], y[4], -shaft - r(y[3]), (shaft - r(y[4])) / 2)
      }
    ),
    gears = list(
      function(r) scene_gears(c(1, 2), 3, resistance = list(NULL, r), omega0_rad_per_s = 9),
      c(0, 9), function(t, y, r) c(y[2], -r(y[2] / 3) / 3 / (1 + 2 / 9))
    ),
    gears_all = list(
      function(r) scene_gears(c(1, 2), 3, resistance = r, omega0_rad_per_s = 9),
      c(0, 9), function(t, y, r) c(y[2], -(r(y[2]) + r(y[2] / 3) / 3) / (1 + 2 / 9))
    ),
    clutch = list(
      function(r) {
        scene_clutch(1, 2, 3, resistance = list(r, NULL), omega0_rad_per_s = c(6, 0))
      }, c(0, 0, 6, 0), function(t, y, r) c(y[3], y[4], -3 - r(y[3]), 1.5)
    ),
    drive = list(
      function(r) {
        scene_drive(c(1, 2), coupling_shaft(5), resistance = list(NULL, r),
                    omega0_rad_per_s = c(3, 3))
      }, c(0, 0, 3, 3), function(t, y, r) {
        shaft <- 5 * (y[1] - y[2])
        c(y[3], y[4], -shaft, (shaft - r(y[4])) / 2)
      }
    )
  )
  for (scene in names(scenes)) {
    one <- scenes[[scene]]
    # What drives a light pulley makes its rope slack.
    for (term in setdiff(names(terms), if (scene == "hanging") "driving")) {
      motion <- trajectory(one[[1]](terms[[term]][[1]]), c(0, 0.4))
      columns <- if ("theta_1_rad" %in% names(motion)) {
        c("theta_1_rad", "theta_2_rad", "omega_1_rad_per_s", "omega_2_rad_per_s")
      } else axle
      got <- last_of(motion, columns)
      if (startsWith(scene, "gears") && length(got) == 4L) got <- got[c(1, 3)]
      expect_length(got, length(one[[2]]))
      want <- rk4(
        function(t, y) one[[3]](t, y, terms[[term]][[2]]), one[[2]], 0, 0.4, one[4][[1]]
      )
      # Nothing turns back within this time.
      expect_true(all(want[length(want) / 2 + seq_len(length(want) / 2)] > 0))
      expect_lt(max(abs(got - want)) / max(abs(want)), 1e-8, label = paste(scene, term))
    }
  }
})

test_that("static friction holds up to its torque, in every scene that takes it", {
  hold <- resistance(coulomb_n_m = 0.2, static_n_m = 0.5)
  for (push in c(0.4, -0.4, 0.6, -0.6)) {
    moves <- abs(push) > 0.5
    # Loose from the start: it slides with 0.2 N m.
    rate <- moves * (push - 0.2 * sign(push))
    expect_omega <- function(scene, inertia, which = 1L, ratio = 1) {
      got <- last_of(trajectory(scene, c(0, 1)), "omega_rad_per_s")[which]
      expect_equal(got, rate / inertia, tolerance = 1e-9, info = class(scene)[1])
    }
    expect_omega(scene_axle(2, push, hold), 2)
    expect_omega(scene_axle(2, function(time_s) push, hold), 2)
    expect_omega(scene_axle(inertia_knots(c(0, 9), c(2, 2)), push, hold), 2)
    expect_omega(scene_gears(2, double(), torque = list(push), resistance = list(hold)), 2)
    expect_omega(scene_drive(2, torque = push, resistance = hold), 2)
    expect_omega(scene_drive(
      c(1, 1), coupling_gear(1), torque = list(push, NULL), resistance = list(hold, NULL)
    ), 2)
    # A brake alone: 0.5 N m at rest where 0.2 slides.
    expect_omega(scene_axle(2, push, brake = brake(0.2, static_ratio = 2.5)), 2)
  }
  held <- scene_pendulum(body_point(1), 1, hold, theta0_rad = asin(0.4 / 9.80665))
  expect_identical(last_of(trajectory(held, c(0, 5)), "omega_rad_per_s"), 0)
  loose <- scene_pendulum(body_point(1), 1, hold, theta0_rad = asin(0.6 / 9.80665))
  expect_lt(last_of(trajectory(loose, c(0, 0.1)), "omega_rad_per_s"), 0)
})

test_that("drag and damping of bodies that move in space, on an incline, on a hoop, in a chain", {
  g <- 9.80665
  moments <- c(1, 1.5, 2)
  space <- c("omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s")
  start <- c(0.3, 0.2, 1)
  free <- scene_free(moments, start, resistance = resistance(damping_per_s = 0.4))
  want <- rk4(function(t, w) (-0.4 * moments * w - cross3(w, moments * w)) / moments, start, 0, 1)
  expect_lt(max(abs(last_of(trajectory(free, 0:1), space) - want)), 1e-9)
  pivot <- scene_pivot(
    moments, start, mass_kg = 1, centre_m = c(0, 0, 0.2),
    resistance = resistance(damping_per_s = 0.4)
  )
  want <- rk4(function(t, y) {
    turn <- matrix(y[4:12], 3)
    weight <- cross3(c(0, 0, 0.2), as.double(t(turn) %*% c(0, 0, -g)))
    w <- y[1:3]
    c((weight - 0.4 * moments * w - cross3(w, moments * w)) / moments, turn %*% skew(w))
  }, c(start, diag(3)), 0, 1)[1:3]
  expect_lt(max(abs(last_of(trajectory(pivot, 0:1), space) - want)), 1e-9)
  for (drag in list(c(0.3, 0), c(0, 0.2), c(0.3, 0.2))) {
    rolls <- scene_incline(body_sphere(2, 0.1), 20, v0_m_per_s = 1, resistance = resistance(
      drag_n_s_per_m = drag[1], drag_n_s2_per_m2 = drag[2]
    ))
    want <- rk4(function(t, y) {
      c(y[2], (2 * g * sinpi(20 / 180) - (drag[1] + drag[2] * abs(y[2])) * y[2]) / 2.8)
    }, c(0, 1), 0, 1)
    expect_lt(max(abs(last_of(trajectory(rolls, 0:1), c("x_m", "v_m_per_s")) - want)), 1e-9)
  }
  bead <- scene_hoop(0.5, 0.4, 6, theta0_rad = 0.7, resistance = resistance(drag_n_s_per_m = 0.3))
  want <- rk4(function(t, y) {
    c(y[2], (36 * cos(y[1]) - g / 0.4) * sin(y[1]) - 0.3 / 0.5 * y[2])
  }, c(0.7, 0), 0, 1)
  axle <- c("theta_rad", "omega_rad_per_s")
  expect_lt(max(abs(last_of(trajectory(bead, 0:1), axle) - want)), 1e-9)
  # A double pendulum of points of 1 kg at 1 m, with joints.
  chain <- scene_chain(
    c(1, 1), 1, c(0.5, -0.4), links = "points", resistance = resistance(viscous_n_m_s = 0.2)
  )
  want <- rk4(function(t, y) {
    d <- y[1] - y[2]
    joint <- c(0.2 * y[3], 0.2 * (y[4] - y[3]))
    right <- c(
      -sin(d) * y[4]^2 - 2 * g * sin(y[1]) - joint[1] + joint[2],
      sin(d) * y[3]^2 - g * sin(y[2]) - joint[2]
    )
    c(y[3:4], solve(matrix(c(2, cos(d), cos(d), 1), 2), right))
  }, c(0.5, -0.4, 0, 0), 0, 1, steps = 400L)
  expect_lt(max(abs(last_of(trajectory(chain, 0:1), axle) - want)), 1e-8)
})
