test_that("the time scales of drives and shafts are those of their rotors and couplings", {
  pace <- function(scene) rotdyn:::constraint_of(scene)$pace(scene, c(omega = 2), "rotors_modal")
  # The rate of two equal rotors is 2 c/I; Gershgorin's bound is at most twice as large.
  within <- function(value, truth) expect_true(value <= 1.0001 * truth && value >= truth / 4.0001)
  shaft <- scene_rotors(c(2, 2), 50, damping_n_m_s = 0.8)
  within(pace(shaft)$fades_s, 2 / (2 * 0.8))
  within(1 / pace(shaft)$swing_rad_per_s, 1 / sqrt(2 * 50 / 2))
  rigid <- rotdyn:::rotors_pace(
    scene_rotors(c(2, 3), 50, viscous_n_m_s = c(0.5, 0.25)), c(omega = 2), "rotors_rigid"
  )
  expect_equal(rigid$fades_s, 5 / 0.75)
})
