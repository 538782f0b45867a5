# A torque that is off by E moves a body of 2 kg m^2 by E t^2/(2 I), its rate by E t/I. With a
# viscous resistance c backwards in time: I omega' = E - c omega. (Not a tiny E: expect_equal()
# compares numbers below its tolerance by their difference.)
test_that("a rounded coefficient counts as the torque it is, forwards and backwards", {
  scene <- list(
    rounding = c(0.3, 0), moment_of_inertia_kg_m2 = 2, start_s = 1,
    resistance = list(viscous_n_m_s = 0)
  )
  sizes <- c(theta = 1, omega = 1)
  expect_equal(
    rotdyn:::axle_rounding(scene, c(1, 5), sizes),
    list(theta = 0.3 * 4^2 / 2 / 2, omega = 0.3 * 4 / 2), tolerance = 1e-12
  )
  # In proportion to omega, too.
  scene$rounding <- c(0, 0.3)
  expect_equal(
    rotdyn:::axle_rounding(scene, c(1, 5), c(theta = 1, omega = 7))$omega, 7 * 0.3 * 4 / 2,
    tolerance = 1e-12
  )
  scene$rounding <- c(0.3, 0)
  scene$resistance$viscous_n_m_s <- 1.5
  late <- rotdyn:::axle_rounding(scene, c(1, 100), sizes)
  expect_equal(late$omega, 0.3 / 1.5, tolerance = 1e-12)
  expect_equal(late$theta, 0.3 * 99 / 1.5, tolerance = 1e-12)
  # Backwards over 4 s: what the resistance makes of it.
  back <- rotdyn:::axle_rounding(scene, c(-3, 1), sizes)
  growth <- expm1(1.5 * 4 / 2)
  expect_equal(back$omega, 0.3 / 1.5 * growth, tolerance = 1e-12)
  theta <- 0.3 / 1.5 * (growth * 2 / 1.5 - 4)
  expect_gte(back$theta, theta)
  expect_lt(back$theta, 4 * theta)
  expect_null(rotdyn:::axle_rounding(scene, c(1, 5), c(theta = 1, omega = 0)))
})
