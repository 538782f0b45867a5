# Error in units in the last place of the reference.
ulps <- function(got, want) {
  size <- ifelse(want == 0, 2^-1074, pmax(2^-1074, 2^(floor(log2(abs(want))) - 52)))
  ifelse(got == want, 0, abs(got - want) / size)
}

expect_ulps <- function(got, want, at_most) {
  expect_equal(length(got), length(want))
  expect_lte(max(ulps(got, want)), at_most)
}

# The reference tables stand beside the repository; a check elsewhere does without them.
shared <- function(...) {
  root <- Sys.getenv("ROTDYN_SHARED", NA)
  if (is.na(root)) {
    root <- file.path("..", "..", "..", "shared")
  }
  path <- file.path(root, ...)
  if (!file.exists(path)) {
    skip(paste("no reference data:", file.path(...)))
  }
  path
}

article_torque <- function() torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
article_scene <- function(...) {
  scene_axle(body_disk(2, 0.25), article_torque(), resistance(viscous_n_m_s = 0.03), ...)
}

run_of <- function(x) attr(x, "run")
