test_that("rows take the law's own value only where it is as small as its rounding", {
  calls <- 0
  law <- function(time_s) {
    calls <<- calls + length(time_s)
    exp(-time_s)
  }
  count <- function(times) {
    calls <<- 0
    trajectory(scene_axle(1, law), times)
    calls
  }
  # From 2e-9 to 1e-11 of its largest value: no row is read again.
  expect_identical(count(c(0, seq(20, 25, length.out = 100), 30)), count(c(0, 30)))
})
