test_that("a moment about an axis is n' I n", {
  disk <- body_disk(2, 3)
  expect_equal(rotdyn:::moment_about_axis(disk, c(0, 0, 1)), 9)
  expect_equal(rotdyn:::moment_about_axis(disk, c(1, 0, 0)), 4.5)
  # Half way between: (Ixx + Izz)/2.
  expect_equal(rotdyn:::moment_about_axis(disk, c(1, 0, 1) / sqrt(2)), 6.75)
})

test_that("a body prints its mass, size, inertia and formula", {
  expect_snapshot({
    body_disk(2, 0.25)
    body_rod(1.5, 2)
  })
})
