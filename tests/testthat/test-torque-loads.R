
test_that("sum() adds laws up, and other summaries are refused", {
  laws <- list(torque_constant(1), torque_sinusoid(2, 3), torque_constant(-0.25))
  whole <- trajectory(scene_axle(0.5, do.call(sum, laws)), 0:3)
  parts <- trajectory(scene_axle(0.5, laws[[1]] + laws[[2]] + laws[[3]]), 0:3)
  expect_identical(whole$omega_rad_per_s, parts$omega_rad_per_s)
  expect_error(max(laws[[1]], laws[[2]]), class = "rotdyn_error_type")
})
