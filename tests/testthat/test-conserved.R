kept <- function(x, quantity, point = NA, ...) {
  table <- conserved(x, ...)
  same <- table$quantity == quantity & (if (is.na(point)) is.na(table$about) else
    table$about %in% point)
  table$conserved[same]
}

test_that("an axle: skater, pendulum, motor, brake", {
  skater <- scene_axle(inertia_knots(c(0, 2), c(4, 1.2)), omega0_rad_per_s = 3)
  expect_identical(kept(skater, "angular_momentum", "the axle"), TRUE)
  expect_identical(kept(skater, "energy"), FALSE)
  pendulum <- scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 1)
  expect_identical(kept(pendulum, "energy"), TRUE)
  expect_identical(kept(pendulum, "angular_momentum", "the axle"), FALSE)
  expect_match(conserved(pendulum)$why[2], "gravity")
  free <- scene_axle(2, 0, omega0_rad_per_s = 3)
  expect_identical(conserved(free)$conserved, c(TRUE, TRUE))
  for (scene in list(
    scene_axle(2, 1), scene_axle(2, 0, resistance(0.1), omega0_rad_per_s = 1),
    scene_axle(2, torque_motor(1, 10)), scene_axle(2, function(time_s) sin(time_s))
  )) {
    expect_identical(conserved(scene)$conserved, c(FALSE, FALSE))
    expect_true(all(nzchar(conserved(scene)$why)))
  }
  # A torque about any axis of the body does work.
  for (axis in 1:3) {
    torque <- replace(numeric(3), axis, 1e-3)
    top <- scene_pivot(
      body_box(2, 1, 0.2, 0.3), omega0_rad_per_s = c(0, 0, 1), pivot_m = c(0, 0, -0.5),
      torque = torque
    )
    expect_false(any(conserved(top)$conserved))
    body <- scene_free(1:3, omega0_rad_per_s = c(0, 0, 1), torque = torque)
    expect_identical(kept(body, "energy"), FALSE)
  }
})

test_that("several bodies: torques between them are internal", {
  shaft <- scene_rotors(c(1, 2), 100, omega0_rad_per_s = c(1, 0))
  expect_identical(conserved(shaft)$conserved, c(TRUE, TRUE))
  damped <- scene_rotors(c(1, 2), 100, 0.5, omega0_rad_per_s = c(1, 0))
  expect_identical(conserved(damped)$conserved, c(FALSE, TRUE))
  expect_identical(
    conserved(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)))$conserved, c(FALSE, TRUE)
  )
  expect_identical(
    conserved(scene_clutch(2, 3, 12, torque = list(1, NULL)))$conserved, c(FALSE, FALSE)
  )
  geared <- scene_drive(list(1, 2), list(coupling_gear(3)), omega0_rad_per_s = c(3, 1))
  expect_identical(conserved(geared)$conserved, c(TRUE, FALSE))
  expect_match(conserved(geared)$why[2], "housings")
})

test_that("an incline: rolling, sliding, level", {
  ball <- body_sphere(6, 0.11)
  rolls <- scene_incline(ball, 10)
  expect_identical(kept(rolls, "energy"), TRUE)
  expect_identical(kept(rolls, "momentum_along_slope"), FALSE)
  expect_identical(kept(rolls, "angular_momentum", "the centre of mass"), FALSE)
  lane <- scene_incline(ball, 0, static_friction = 0.2, v0_m_per_s = 8, omega0_rad_per_s = 0)
  expect_identical(kept(lane, "energy"), FALSE)
  expect_identical(kept(lane, "angular_momentum", "a point of the slope"), TRUE)
  expect_identical(kept(lane, "angular_momentum", "the centre of mass"), FALSE)
  # 5/7 of the speed: the angular momentum about a point of the lane, by hand.
  after <- trajectory(lane, c(0, 20))
  about <- function(i) {
    6 * 0.11 * after$v_m_per_s[i] + 0.4 * 6 * 0.11^2 * after$omega_rad_per_s[i]
  }
  expect_equal(about(nrow(after)), about(1), tolerance = 1e-13)
  ice <- scene_incline(ball, 20, static_friction = 0, omega0_rad_per_s = 5)
  expect_identical(kept(ice, "energy"), TRUE)
  expect_identical(kept(ice, "angular_momentum", "the centre of mass"), TRUE)
})

test_that("the audit says the same, and checks it", {
  scenes <- list(
    scene_axle(inertia_knots(c(0, 2), c(4, 1.2)), omega0_rad_per_s = 3),
    scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 1), scene_axle(2, 0, omega0_rad_per_s = 3),
    scene_axle(2, 1, resistance(0.1)), scene_rotors(c(1, 2), 100, omega0_rad_per_s = c(1, 0)),
    scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)),
    scene_drive(list(1, 2), list(coupling_gear(3)), omega0_rad_per_s = c(3, 1)),
    scene_incline(body_sphere(6, 0.11), 10), scene_incline(body_sphere(6, 0.11), 0,
      static_friction = 0.2, v0_m_per_s = 8, omega0_rad_per_s = 0),
    scene_incline(body_sphere(6, 0.11), 20, static_friction = 0, omega0_rad_per_s = 5),
    scene_incline(body_sphere(6, 0.11), 0, v0_m_per_s = 2)
  )
  for (scene in scenes) {
    motion <- trajectory(scene, seq(0, 3, by = 0.5))
    a <- audit(motion)
    table <- conserved(scene)
    expect_identical(conserved(motion), table)
    for (i in seq_len(nrow(a))) {
      same <- table$quantity == a$balance[i] & table$about %in% a$about[i]
      expect_identical(a$conserved[i], table$conserved[same])
    }
    expect_true(all(a$verdict == "balanced"))
    # What is not conserved changes here; gears that turn freely take no torque.
    moves <- a$conserved %in% FALSE & a$balance != "energy" & !inherits(scene, "rot_scene_drive")
    expect_true(all(abs(a$change[moves]) > a$rounding[moves]))
  }
  expect_output(print(audit(trajectory(scenes[[1]], 0:2))), "about the axle: conserved")
  # A statement that is wrong is found by the numbers.
  wrong <- rotdyn:::mark_conserved(
    list(rotdyn:::balance("energy", NA, "J", -2, 0, 2, 1e-12)),
    list(rotdyn:::statement("energy", NA_character_, TRUE, "so it seems"))
  )
  expect_identical(wrong[[1]]$verdict, "unbalanced")
})

test_that("a collision, about each point", {
  ball <- ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, 0.75, 0.5)
  expect_identical(kept(ball, "angular_momentum_z", "the contact"), TRUE)
  expect_identical(kept(ball, "angular_momentum_z", "the centre", about = "the centre"), FALSE)
  expect_identical(kept(ball, "momentum_y"), FALSE)
  expect_identical(kept(ball, "energy"), FALSE)
  expect_true(all(audit(ball)$conserved == c(FALSE, FALSE, TRUE, FALSE)))
  super <- ball_bounce(body_sphere(1, 0.1), 7, -2, 0, 1, Inf, 1)
  expect_identical(kept(super, "energy"), TRUE)
  # At the centre of percussion the hinge gives nothing: momentum is conserved as well.
  rod <- body_rod(2, 1)
  at <- centre_of_percussion(rod, 0.5)
  hit <- hinged_hit(rod, 0.5, c(at, 0.9), 0.2, 5)
  expect_identical(kept(hit, "angular_momentum_z", "the hinge", row = 2), TRUE)
  expect_identical(kept(hit, "momentum_y", row = 2), FALSE)
  # Two axles push in opposite directions, and turn.
  mesh <- conserved(rims_meet(body_disk(2, 0.1), body_disk(8, 0.2), 60, 0))
  expect_identical(mesh$conserved, c(TRUE, FALSE, FALSE))
  expect_match(mesh$why[1], "cancel")
  balls <- collide(
    body_sphere(1, 0.1), body_sphere(1, 0.1), velocity_1_m_per_s = c(1, 0.5, 0),
    normal = c(-1, 0, 0), friction = 0.3
  )
  expect_true(all(conserved(balls)$conserved[conserved(balls)$quantity != "energy"]))
  expect_setequal(names(conserved(balls)), c("quantity", "about", "conserved", "why"))
  expect_error(conserved(1), class = "rotdyn_error_type")
  expect_error(conserved(), class = "rotdyn_error_missing")
  expect_error(conserved(scene_axle(1), row = 1), class = "rotdyn_error_argument")
})
