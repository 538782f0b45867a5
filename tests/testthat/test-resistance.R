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
