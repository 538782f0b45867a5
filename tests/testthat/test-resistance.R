test_that("viscous resistance of any sign, and none", {
  expect_equal(resistance(0.03)$viscous_n_m_s, 0.03)
  expect_equal(resistance(-0.5)$viscous_n_m_s, -0.5)
  expect_equal(resistance()$viscous_n_m_s, 0)
})

test_that("what is not modelled yet says so instead of being zero", {
  expect_error(resistance(1, quadratic_n_m_s2 = 0.1), class = "rotdyn_error_not_yet")
  expect_error(resistance(1, coulomb_n_m = 0.1), class = "rotdyn_error_not_yet")
  expect_error(resistance(1, static_n_m = 0.1), class = "rotdyn_error_not_yet")
  expect_silent(resistance(1, quadratic_n_m_s2 = 0, coulomb_n_m = 0))
})

test_that("a scene wants a resistance, not a number", {
  expect_error(scene_axle(1, 1, 0.03), class = "rotdyn_error_type")
  expect_error(resistance("a"), class = "rotdyn_error_type")
  expect_error(resistance(NA_real_), class = "rotdyn_error_value")
  expect_snapshot({
    resistance(0.03)
    resistance()
  })
})
