# What is exhaustive has fewer cases, unless ROTDYN_LONG is set (`make check-long`).
long_tests <- identical(Sys.getenv("ROTDYN_LONG"), "yes")
or_long <- function(few, all) if (long_tests) all else few

# Error in units in the last place of the reference.
ulps <- function(got, want) {
  size <- ifelse(want == 0, 2^-1074, pmax(2^-1074, 2^(floor(log2(abs(want))) - 52)))
  ifelse(got == want, 0, abs(got - want) / size)
}

expect_ulps <- function(got, want, at_most) {
  expect_equal(length(got), length(want))
  expect_lte(max(ulps(got, want)), at_most)
}

# The relative error of each number. expect_equal() compares the mean of all numbers, and absolutely
# where their mean is not above the tolerance.
expect_within <- function(got, want, relative) {
  expect_equal(length(got), length(want))
  expect_lte(max(abs(got - want) / abs(want)), relative)
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

# The numbers of an audit, energy first, by name.
audited <- function(x) {
  a <- audit(x)
  term <- function(row, pattern) sum(a$terms[[row]]$value[grepl(pattern, a$terms[[row]]$term)])
  list(
    verdict = if (anyNA(a$verdict)) NA_character_ else
      if (all(a$verdict == "balanced")) "balanced" else "unbalanced",
    work_j = if (is.na(a$supplied[1])) NA_real_ else term(1, "work of the torque"),
    inertia_work_j = term(1, "changes the inertia"),
    dissipated_j = a$dissipated[1], dissipated_viscous_j = term(1, "viscous"),
    dissipated_quadratic_j = term(1, "quadratic"), dissipated_coulomb_j = term(1, "dry"),
    kinetic_energy_change_j = term(1, "kinetic"), energy_residual_j = a$residual[1],
    energy_rounding_j = a$rounding[1], torque_impulse_n_m_s = a$supplied[2],
    damping_impulse_n_m_s = -a$dissipated[2], angular_momentum_change_kg_m2_per_s = a$change[2],
    momentum_residual_kg_m2_per_s = a$residual[2], momentum_rounding_kg_m2_per_s = a$rounding[2]
  )
}

# The axes of pictures have few labels, and fewer with large letters; `draw` takes base_size.
expect_few_labels <- function(draw) {
  for (size in c(13, 30)) {
    panels <- ggplot2::ggplot_build(draw(size))$layout$panel_params
    for (axis in c("x", "y")) {
      labels <- vapply(panels, function(one) sum(!is.na(one[[axis]]$breaks)), 0L)
      expect_lte(max(labels), if (size == 13) 7 else 4)
    }
  }
}
