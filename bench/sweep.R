# Many spin-ups, a row each: where each ends at 8 s. The designs are those of bench/peers/sweep.h.

sweep_rows <- 1e5
sweep_u <- (seq_len(sweep_rows) - 0.5) / sweep_rows

sweep_designs <- function() {
  v <- 1000 * sweep_u
  data.frame(
    moment_of_inertia_kg_m2 = spin_inertia * (0.5 + sweep_u),
    viscous_n_m_s = spin_viscous * (0.5 + (v - floor(v)))
  )
}

# The last state of some rows, in numbers of 31 digits.
sweep_reference <- function(designs) {
  start <- c(0, 1, 4, 6, 8)
  a <- c(0, 0.8, 0.8, 0)
  k <- c(0.8, 0, -0.4, 0)
  state <- list(theta = pair(rep(0, nrow(designs))), omega = pair(rep(0, nrow(designs))))
  for (i in seq_along(a)) {
    state <- spin_piece(
      state$theta, state$omega, a[i], k[i], pair(start[i + 1] - start[i]),
      designs$moment_of_inertia_kg_m2, designs$viscous_n_m_s
    )
  }
  state
}

run_sweep <- function(rounds) {
  designs <- sweep_designs()
  law <- rotdyn::torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
  some <- seq(1, sweep_rows, length.out = 2000)
  some <- unique(as.integer(some))
  reference <- sweep_reference(designs[some, ])
  core <- compile_program("sweep-core", core_files())
  gsl <- compile_program("sweep-gsl")
  one <- function(name, run) {
    solution <- if (inherits(run, "child")) solve_child(run) else run()
    rows <- list(
      theta_rad = solution[[if (is.data.frame(solution)) "final_theta_rad" else "theta_rad"]][some],
      omega_rad_per_s = solution[[
        if (is.data.frame(solution)) "final_omega_rad_per_s" else "omega_rad_per_s"
      ]][some]
    )
    errors <- spin_errors(rows, reference)
    contender(
      name, run, errors[["norm"]], errors[["pointwise"]],
      if (is.data.frame(solution)) 0 else solution$rhs_calls
    )
  }
  table <- function(threads) {
    force(threads)
    function() rotdyn::spin_up_table(designs, law, 8, threads = threads)
  }
  paired("sweep", "100,000 rows", list(
    one("rotdyn, C core without R", child(core, "all", sweep_u)),
    one("rotdyn, spin_up_table()", table(1)),
    one("rotdyn, spin_up_table(), two threads", table(2)),
    one("GSL rk8pd in C, 1e-9, split at the kinks", child(gsl, "split", sweep_u))
  ), min(rounds, 7L), batch_us = 5e4)
}
