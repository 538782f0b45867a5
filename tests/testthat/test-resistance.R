test_that("a resistance is what was given", {
  expect_equal(unclass(resistance(0.03)), list(
    viscous_n_m_s = 0.03, quadratic_n_m_s2 = 0, coulomb_n_m = 0, static_n_m = 0
  ))
  expect_equal(unclass(resistance(coulomb_n_m = 0.2)), list(
    viscous_n_m_s = 0, quadratic_n_m_s2 = 0, coulomb_n_m = 0.2, static_n_m = 0.2
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

test_that("a scene takes a resistance and nothing else", {
  expect_error(scene_axle(1, resistance = 0.03), class = "rotdyn_error_type")
})
