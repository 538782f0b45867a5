test_that("the time scales of drives and shafts are those of their rotors and couplings", {
  time_scales <- function(scene) rotdyn:::constraint_of(scene)$time_scales(scene, c(omega = 2),
    "rotors_modal")
  # The rate of two equal rotors is 2 c/I; Gershgorin's bound is at most twice as large.
  within <- function(value, truth) expect_true(value <= 1.0001 * truth && value >= truth / 4.0001)
  shaft <- scene_rotors(c(2, 2), 50, damping_n_m_s = 0.8)
  within(time_scales(shaft)$fades_s, 2 / (2 * 0.8))
  within(1 / time_scales(shaft)$swing_rad_per_s, 1 / sqrt(2 * 50 / 2))
  rigid <- rotdyn:::rotors_time_scales(
    scene_rotors(c(2, 3), 50, resistance = c(0.5, 0.25)), c(omega = 2), "rotors_rigid"
  )
  expect_equal(rigid$fades_s, 5 / 0.75)
})

test_that("a drive's time scale: I/c of its rotors and of its shafts, the rates added", {
  time_scales <- function(...) {
    rotdyn:::drive_constraint()$time_scales(scene_drive(...), c(theta = 1, omega = 2),
      "drive_rk8pd")
  }
  one <- time_scales(
    c(2, 3), coupling_gear(2), resistance = list(resistance(viscous_n_m_s = 0.5), NULL)
  )
  expect_equal(one$fades_s, 2 / 0.5)
  # 2 k/I and 2 c/I of two equal rotors; bounds at most twice as large.
  both <- time_scales(
    c(2, 2), coupling_shaft(50, damping_n_m_s = 0.8),
    resistance = list(resistance(viscous_n_m_s = 0.5), NULL)
  )
  slowest <- 1 / (0.5 / 2 + 2 * 0.8 / 2)
  expect_lte(both$fades_s, 1.0001 * slowest)
  expect_gte(both$fades_s, slowest / 2.0001)
  fastest <- sqrt(2 * 50 / 2)
  expect_gte(both$swing_rad_per_s, 0.9999 * fastest)
  expect_lte(both$swing_rad_per_s, 1.4143 * fastest)
})

test_that("gravity swings as fast as its small swings, or as the body turns", {
  # m g d = 9 N m on 4 kg m^2: 1.5 rad/s, and twice that on the way down from the top.
  scene <- scene_drive(4, torque = torque_gravity(1, 1, gravity_m_per_s2 = 9))
  time_scales <- function(omega) {
    rotdyn:::drive_constraint()$time_scales(scene, c(theta = 1, omega = omega), "drive_rk8pd")
  }
  expect_equal(time_scales(2)$fades_s, 1 / 3)
  expect_equal(time_scales(2)$swing_rad_per_s, 3)
  expect_equal(time_scales(5)$swing_rad_per_s, 5)
})

test_that("an undamped stiff drive under a sinusoid is refused after a few steps", {
  # 3e7 rad/s for 10 s; the whole budget took 5 s and reached 0.03 s.
  s <- scene_rotors(
    c(0.01, 1, 30), c(1e12, 1e15), torque = list(torque_sinusoid(2, 5), NULL, NULL)
  )
  error <- expect_error(trajectory(s, 0:10), "step budget")
  reached <- as.numeric(sub(".*failed at ([^ ]+) s:.*", "\\1", conditionMessage(error)))
  expect_lt(reached, 0.002)
  # A softer one is solved: steps of its 5e4 rad/s are within reach.
  soft <- scene_rotors(c(0.01, 1), 2e7, torque = list(torque_sinusoid(2, 5), NULL))
  expect_lt(glance(trajectory(soft, c(0, 0.5)))$error, 1e-8)
})

test_that("sums over the rotors count a time that is asked for twice once", {
  once <- function(motion) {
    glance(motion)[c("max_rotational_kinetic_energy_j", "heat_j")]
  }
  s <- scene_drive(c(1, 2), coupling_shaft(10, 0.5), omega0_rad_per_s = c(1, 0))
  all <- trajectory(s, c(0, 0, 1, 1))
  expect_equal(once(all), once(trajectory(s, 0:1)))
  expect_equal(once(all)$max_rotational_kinetic_energy_j, 0.5) # at the start
  expect_equal(once(all[c(6, 8, 1, 3, 5, 2), ])$max_rotational_kinetic_energy_j, 0.5)
})
