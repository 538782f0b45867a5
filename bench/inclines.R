# Bodies on inclines: slip to roll by the closed form, by the package's own rk8pd with its events,
# by GSL's rk8pd with Brent's root finder, and by deSolve with a root and an event; many inclines in
# one call; a race against dplyr.

slip_lane <- function() {
  rotdyn::scene_incline(
    rotdyn::body_sphere(6, 0.11), 0, static_friction = 0.19, v0_m_per_s = 8.1,
    omega0_rad_per_s = 0, gravity_m_per_s2 = 9.8
  )
}

# x, v, theta, omega at the times, by the formulas of rolling with slip.
slip_truth <- function(time) {
  roll <- 8.1 / (0.19 * 9.8 * 3.5)
  slide <- pmin(time, roll)
  v <- 8.1 - 0.19 * 9.8 * slide
  x <- 8.1 * slide - 0.19 * 9.8 * slide^2 / 2 + 8.1 / 1.4 * (time - slide)
  alpha <- 0.19 * 9.8 / 0.4 / 0.11
  list(
    x_m = x, v_m_per_s = v, theta_rad = alpha * slide^2 / 2 + 8.1 / 1.4 / 0.11 * (time - slide),
    omega_rad_per_s = alpha * slide
  )
}

slip_error <- function(rows, truth) {
  max(mapply(function(got, want) max(abs(got - want)) / max(abs(want)), rows[names(truth)], truth))
}

# The last component says whether it rolls.
slip_desolve <- function(time, tolerance) {
  force <- function(t, y, p) {
    slip <- if (y[5] > 0) 0 else sign(y[2] - 0.11 * y[4])
    list(c(y[2], -0.19 * 9.8 * slip, y[4], 0.19 * 9.8 * slip / 0.4 / 0.11, 0))
  }
  function() {
    out <- deSolve::ode(
      c(0, 8.1, 0, 0, 0), time, force, NULL, method = "lsodar", rtol = tolerance,
      atol = tolerance,
      rootfun = function(t, y, p) if (y[5] > 0) 1 else y[2] - 0.11 * y[4],
      events = list(root = TRUE, func = function(t, y, p) c(y[1:4], 1))
    )
    list(
      x_m = out[, 2], v_m_per_s = out[, 3], theta_rad = out[, 4], omega_rad_per_s = out[, 5],
      rhs_calls = attr(out, "istate")[3]
    )
  }
}

run_slip <- function(rounds) {
  time <- seq(0, 3, length.out = 301)
  truth <- slip_truth(time)
  scene <- slip_lane()
  ours <- function(model, accuracy) {
    function() rotdyn::trajectory(scene, time, accuracy, model = model)
  }
  judged <- function(name, run, calls = function(x) x$rhs_calls) {
    rows <- run()
    at <- if (inherits(rows, "rot_trajectory")) match(time, rows$time_s) else seq_along(time)
    count <- if (is.data.frame(rows)) attr(rows, "run")$info$rhs_calls else rows$rhs_calls
    got <- lapply(names(truth), function(column) rows[[column]][at])
    names(got) <- names(truth)
    contender(name, run, slip_error(got, truth), rhs_calls = count)
  }
  other <- function(name, run) {
    rows <- solve_child(run)
    shown <- names(rows) != "rhs_calls"
    error <- slip_error(rows[shown], truth[names(rows)[shown]])
    contender(name, run, error, rhs_calls = rows$rhs_calls)
  }
  core <- compile_program("slip-core", core_files())
  gsl <- compile_program("slip-gsl")
  paired("inclines", "slip to roll, 301 rows", c(
    list(
      judged("rotdyn, trajectory(), closed form", ours("incline_exact", 1e-9)),
      judged("rotdyn, steps of GSL rk8pd with events, 1e-9", ours("incline_rk8pd", 1e-9)),
      other("rotdyn, C core without R, closed form", child(core, "exact", time)),
      other("GSL rk8pd in C with Brent's roots, 1e-9", child(gsl, "1e-9", time)),
      other("GSL rk8pd in C with Brent's roots, 1e-12", child(gsl, "1e-12", time))
    ),
    if (has_package("deSolve")) {
      list(
        judged("deSolve lsodar with a root, 1e-6 (default)", slip_desolve(time, 1e-6)),
        judged("deSolve lsodar with a root, 1e-12", slip_desolve(time, 1e-12))
      )
    }
  ), rounds)
}

run_many_inclines <- function(rounds) {
  n <- 1e6
  set.seed(13)
  rows <- data.frame(
    beta = stats::runif(n, 0.2, 1), radius_m = stats::runif(n, 0.05, 0.5),
    incline_angle_deg = stats::runif(n, 0, 60), static_friction = stats::runif(n, 0, 0.7),
    v0_m_per_s = stats::runif(n, 0, 4), omega0_rad_per_s = stats::runif(n, 0, 40)
  )
  table <- function(threads) {
    force(threads)
    function() rotdyn::incline_table(rows, 2, threads = threads)
  }
  paired("inclines", "1e6 inclines", list(
    contender("rotdyn, incline_table()", table(1), max(table(1)()$error)),
    contender("rotdyn, incline_table(), two threads", table(2))
  ), max(3, rounds %/% 3), batches = 3, collect = TRUE)
}

run_race <- function(rounds) {
  n <- 1e6
  set.seed(14)
  bodies <- data.frame(beta = stats::runif(n))
  time <- c(0.5, 1)
  ours <- function() rotdyn::roll_race(bodies, 20, 1, time_s = time)
  pipeline <- function() {
    dplyr::cross_join(data.frame(time_s = time), dplyr::mutate(
      bodies, lane = seq_len(n), a = 9.80665 * sin(20 * pi / 180) / (1 + beta),
      finish_time_s = sqrt(2 / a)
    )) |>
      dplyr::mutate(
        t = pmin(time_s, finish_time_s), x_m = a * t^2 / 2, v_m_per_s = a * t,
        theta_rad = x_m / 0.1, omega_rad_per_s = v_m_per_s / 0.1,
        finished = time_s >= finish_time_s
      )
  }
  if (has_package("dplyr") && utils::packageVersion("dplyr") < "1.1.0") {
    pipeline <- function() {
      dplyr::tibble(
        time_s = rep(time, each = n), lane = rep(seq_len(n), length(time)),
        beta = rep(bodies$beta, length(time))
      ) |>
        dplyr::mutate(
          a = 9.80665 * sin(20 * pi / 180) / (1 + beta), finish_time_s = sqrt(2 / a),
          t = pmin(time_s, finish_time_s), x_m = a * t^2 / 2, v_m_per_s = a * t,
          theta_rad = x_m / 0.1, omega_rad_per_s = v_m_per_s / 0.1,
          finished = time_s >= finish_time_s
        )
    }
  }
  paired("inclines", "a race of 1e6 bodies, 2 times", c(
    list(contender("rotdyn, roll_race()", ours)),
    if (has_package("dplyr")) list(contender("dplyr, mutate()", pipeline))
  ), max(3, rounds %/% 3), batches = 3, collect = TRUE)
}

run_inclines <- function(rounds) {
  rbind(run_slip(rounds), run_many_inclines(rounds), run_race(rounds))
}
