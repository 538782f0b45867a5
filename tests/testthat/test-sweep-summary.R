wheel <- scene_axle(
  0.0625, resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
)
losses <- design_random(70001, seed = 9,
  "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2), omega0_rad_per_s = vary_normal(20, 0.5)
)

test_that("means, deviations, extremes and quantiles are those of the rows", {
  sweep <- sweep_run(sweep_plan(wheel, 82, losses, outputs = c("final_theta_rad", "stop_time_s")))
  found <- summary(sweep, c(0.05, 0.5, 0.95))
  for (k in 1:2) {
    x <- sweep[[found$output[k]]]
    x <- x[is.finite(x)]
    expect_equal(found$mean[k], mean(x), tolerance = 1e-14)
    expect_equal(found$sd[k], sd(x), tolerance = 1e-12)
    expect_identical(c(found$min[k], found$max[k]), range(x))
    expect_identical(sweep[[found$output[k]]][found$min_row[k]], min(x))
    expect_identical(sweep[[found$output[k]]][found$max_row[k]], max(x))
    expect_identical(found$finite[k], as.double(length(x)))
  }
  # The error of a mean of independent rows.
  expect_equal(found$mean_error[1], found$sd[1] / sqrt(70001), tolerance = 0.6)
  # Order statistics, infinite values among them; 2^-9 is the bound of the middle.
  limits <- quantile(sweep, seq(0, 1, 0.01))
  for (output in unique(limits$output)) {
    x <- sort(sweep[[output]])
    rank <- pmax(1, ceiling(seq(0, 1, 0.01) * 70001))
    at <- limits[limits$output == output, ]
    expect_true(all(at$low <= x[rank] & x[rank] <= at$high))
    finite <- is.finite(x[rank])
    expect_true(all(abs(at$value - x[rank])[finite] <= 2^-9 * abs(x[rank])[finite]))
  }
  expect_true(any(is.infinite(limits$value)))
  expect_identical(limits$value[limits$p == 0], unname(vapply(
    split(as.list(sweep)[c("final_theta_rad", "stop_time_s")], 1:2),
    function(x) min(unlist(x)), 1
  )), ignore_attr = TRUE)
})

test_that("what is not known is counted, and said first", {
  scene <- scene_axle(0.1, resistance = resistance(coulomb_n_m = 0.01, static_n_m = 0.02))
  rows <- design_grid("resistance$static_n_m" = c(0.005, 0.009, 1:8 / 100))
  found <- summary(sweep_run(sweep_plan(scene, 5, rows)))
  about <- attr(found, "about")
  expect_identical(about$status[["value"]], 2)
  expect_identical(about$failed, c(1, 2))
  said <- capture.output(print(found))
  expect_match(said[2], "not computed \\(value\\): 2 rows, 20 %")
  # A pendulum driven over the top: rows whose error exceeds the accuracy.
  driven <- scene_pendulum(
    body_point(1), 1, resistance(viscous_n_m_s = 0.05), theta0_rad = 1,
    torque = torque_sinusoid(9, 1 / 2.5)
  )
  chaos <- sweep_run(sweep_plan(driven, 60, accuracy = 1e-10,
    design_grid(theta0_rad = seq(-2, 2, length.out = 12))
  ))
  above <- sum(!(chaos$error <= 1e-10))
  expect_identical(attr(summary(chaos), "about")$above, as.double(above))
  expect_identical(attr(summary(chaos), "about")$error, max(chaos$error, na.rm = TRUE))
  if (above > 0) expect_true(any(grepl("error above 1e-10", capture.output(summary(chaos)))))
})

test_that("indices are those of a function whose indices are known", {
  # theta = omega0 t + torque t^2/(2 I): linear in both, so first and total are the shares of the
  # variance.
  free <- scene_axle(2, 1, omega0_rad_per_s = 1)
  plan <- sweep_plan(free, 2, outputs = "final_theta_rad", keep = "summary", design_saltelli(4096,
    seed = 2, torque = vary_normal(1, 0.3), omega0_rad_per_s = vary_normal(1, 0.2), start_s = 0
  ))
  found <- sweep_indices(sweep_run(plan))
  share <- c((0.3 * 4 / 4)^2, (0.2 * 2)^2)
  share <- share / sum(share)
  expect_identical(found$input, c("torque", "omega0_rad_per_s"))
  expect_true(all(abs(found$first - share) < 3 * found$first_error + 1e-3))
  expect_true(all(abs(found$total - share) < 3 * found$total_error + 1e-3))
  expect_equal(found$first, share, tolerance = 0.02)
  expect_equal(found$total, share, tolerance = 0.02)
  expect_error(
    sweep_indices(sweep_run(sweep_plan(wheel, 4, losses, keep = "summary"))), "random",
    class = "rotdyn_error_argument"
  )
})

test_that("some rows are computed again by another model, and audited", {
  sweep <- sweep_run(sweep_plan(wheel, 40, losses, keep = "summary", audit_rows = 5))
  found <- sweep_audit(sweep)
  expect_identical(found$row, c(1, 17501, 35001, 52501, 70001))
  expect_true(all(found$verdict == "balanced"))
  expect_true(all(found$model == "axle_drag" & found$other != "axle_drag"))
  expect_true(all(found$difference <= 1))
  # An error figure that claims too much shows.
  expect_gt(difference_of(trajectory(wheel, c(0, 4)), trajectory(
    scene_axle(0.0626, resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20), c(0, 4)
  )), 1e6)
})

test_that("probabilities and sweeps are checked", {
  sweep <- sweep_run(sweep_plan(wheel, 4, losses, keep = "summary"))
  expect_error(quantile(sweep, 1.5), class = "rotdyn_error_value")
  expect_error(summary(sweep, NA), class = "rotdyn_error")
  expect_error(sweep_indices(3), class = "rotdyn_error_type")
  attr(sweep, "sweep")$whole$sums$value[1] <- -3
  expect_error(summary(sweep), class = "rotdyn_error_type")
})

test_that("two motions differ by a share of what their errors allow together", {
  scene <- scene_axle(1, torque_sinusoid(1, 2), resistance(0.1), omega0_rad_per_s = 1)
  exact <- trajectory(scene, c(0, 5))
  stepped <- trajectory(scene, c(0, 5), 1e-6, model = "axle_rk8pd")
  errors <- function(x) attr(x, "run")$info$errors
  off <- abs(c(
    theta = stepped$theta_rad[2] - exact$theta_rad[2],
    omega = stepped$omega_rad_per_s[2] - exact$omega_rad_per_s[2]
  ))
  allowed <- errors(exact)[names(off)] + errors(stepped)[names(off)]
  expect_equal(difference_of(stepped, exact), max(off / allowed))
  expect_identical(difference_of(exact, exact), 0)
  # Of two that know the same.
  expect_equal(difference_of(stepped, stepped), 0)
  moved <- stepped
  moved$theta_rad[2] <- moved$theta_rad[2] + 3 * errors(stepped)[["theta"]]
  expect_equal(difference_of(moved, stepped), 1.5, tolerance = 1e-6)
})

test_that("a summary may have no quantiles", {
  sweep <- sweep_run(sweep_plan(scene_axle(1, omega0_rad_per_s = 1), 1, design_grid(body = 1:3)))
  without <- summary(sweep, probs = double())
  expect_identical(names(without), setdiff(names(summary(sweep)), c("p5", "p50", "p95")))
})
