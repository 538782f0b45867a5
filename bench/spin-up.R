# The standard damped spin-up, 1000 rows from 0 to 8 s, against the integrators.

spin_times <- seq(0, 8, length.out = 1000)
spin_inertia <- 0.0625 # 2 kg, 0.25 m
spin_viscous <- 0.03

spin_scene <- function(torque = rotdyn::torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))) {
  rotdyn::scene_axle(rotdyn::body_disk(2, 0.25), torque, rotdyn::resistance(spin_viscous))
}

spin_torque <- function(t) {
  if (t < 1) 0.8 * t else if (t < 4) 0.8 else if (t < 6) 0.4 * (6 - t) else 0
}

# ---- the reference ------------------------------------------------------------------------------

# Within a piece, torque = a + k s, and with l = c/I
#   omega = (a - k/l)/c + (k/c) s + C exp(-l s),   theta = its integral.
# It cancels for small l s; in the first rows some 25 of the 31 digits are left.
spin_piece <- function(theta, omega, a, k, s, inertia = spin_inertia, viscous = spin_viscous) {
  l <- over(viscous, inertia)
  slope <- over(k, viscous)
  level <- over(minus(a, over(k, l)), viscous)
  transient <- minus(omega, level)
  left <- times(transient, exp_pair(minus(0, times(l, s))))
  list(
    theta = plus(
      theta,
      plus(
        times(s, plus(level, times(slope, times(s, 0.5)))),
        over(minus(transient, left), l)
      )
    ),
    omega = plus(plus(level, times(slope, s)), left)
  )
}

spin_reference <- function(t) {
  start <- c(0, 1, 4, 6)
  # The doubles 0.8 and 0.4: one is exactly twice the other.
  a <- c(0, 0.8, 0.8, 0)
  k <- c(0.8, 0, -0.4, 0)
  state <- list(theta = pair(0), omega = pair(0))
  blank <- pair(rep(NA_real_, length(t)))
  out <- list(theta = blank, omega = blank)
  for (i in seq_along(start)) {
    rows <- t >= start[i] & t <= c(start[-1], Inf)[i]
    at <- spin_piece(state$theta, state$omega, a[i], k[i], two_sum(t[rows], -start[i]))
    for (name in names(out)) {
      out[[name]]$hi[rows] <- at[[name]]$hi
      out[[name]]$lo[rows] <- at[[name]]$lo
    }
    if (i < length(start)) {
      state <- spin_piece(state$theta, state$omega, a[i], k[i], pair(start[i + 1] - start[i]))
    }
  }
  out
}

# The reference itself must give the figures known to 19 digits.
check_spin_reference <- function() {
  found <- spin_reference(c(1, 4, 6, 8))
  omega <- c(5.487966211452269604, 21.64884463601268780, 15.22057591984251148, 5.827850240151794541)
  theta <- c(1.900070392807771658, 48.23157367497356707, 88.29046683366143441, 107.8586453330170947)
  stopifnot(
    abs(found$omega$hi / omega - 1) < 2.3e-16,
    abs(found$theta$hi / theta - 1) < 2.3e-16
  )
}

# In norm: the larger of theta's and omega's largest difference over the largest value. Pointwise:
# omega's largest relative difference in any row that turns.
spin_errors <- function(solution, reference) {
  theta <- off_by(solution$theta_rad, reference$theta)
  omega <- off_by(solution$omega_rad_per_s, reference$omega)
  turns <- reference$omega$hi != 0
  in_norm <- function(off, reference) max(off) / max(abs(reference$hi))
  c(
    norm = max(in_norm(theta, reference$theta), in_norm(omega, reference$omega)),
    pointwise = max((omega / abs(reference$omega$hi))[turns])
  )
}

# ---- the contenders -----------------------------------------------------------------------------

# `read` makes list(theta_rad, omega_rad_per_s, rhs_calls) of what `run` returns.
spin_contender <- function(name, run, read, reference) {
  solution <- if (inherits(run, "child")) solve_child(run) else read(run())
  errors <- spin_errors(solution, reference)
  contender(name, run, errors[["norm"]], errors[["pointwise"]], solution$rhs_calls)
}

read_rotdyn <- function(x) {
  list(
    theta_rad = x$theta_rad, omega_rad_per_s = x$omega_rad_per_s, rhs_calls = summary(x)$rhs_calls
  )
}

read_desolve <- function(x) {
  list(
    theta_rad = x[, 2], omega_rad_per_s = x[, 3], rhs_calls = attr(x, "istate")[3]
  )
}

# The leanest right-hand side that R allows.
desolve_in_r <- function(torque, ...) {
  rates <- function(t, y, parms) {
    list(c(y[2], (torque(t) - spin_viscous * y[2]) / spin_inertia))
  }
  function() deSolve::ode(c(0, 0), spin_times, rates, NULL, ...)
}

desolve_compiled <- function(...) {
  function() {
    deSolve::ode(c(0, 0), spin_times, "spin_rates_for_desolve", NULL, dllname = "shared", ...)
  }
}

run_spin_up <- function(rounds) {
  check_spin_reference()
  reference <- spin_reference(spin_times)
  scene <- spin_scene()
  form <- rotdyn:::constraint_of(scene)$form
  gsl <- compile_program("spin-up-gsl")
  core <- compile_program("spin-up-core", core_files())

  contenders <- list()
  add <- function(name, run, read = NULL) {
    contenders[[length(contenders) + 1]] <<- spin_contender(name, run, read, reference)
  }
  add("rotdyn, trajectory()", function() rotdyn::trajectory(scene, spin_times), read_rotdyn)
  add(
    "rotdyn, body, torque, scene and trajectory()",
    function() rotdyn::trajectory(spin_scene(), spin_times), read_rotdyn
  )
  add(
    "rotdyn, the routine that trajectory() calls",
    function() .Call(rotdyn:::ffi_scene_quick, "axle", form, scene, spin_times, 1e-9),
    function(x) c(x[[2]]$columns[c("theta_rad", "omega_rad_per_s")], rhs_calls = 0)
  )
  add("rotdyn, C core without R", child(core, "all", spin_times))
  if (has_package("deSolve")) {
    tight <- list(rtol = 1e-9, atol = 1e-9)
    add("deSolve lsoda, R function, 1e-6 (default)", desolve_in_r(spin_torque), read_desolve)
    add(
      "deSolve lsoda, R function, 1e-9", do.call(desolve_in_r, c(spin_torque, tight)),
      read_desolve
    )
    add("deSolve lsoda, compiled, 1e-6 (default)", desolve_compiled(), read_desolve)
    add("deSolve lsoda, compiled, 1e-9", do.call(desolve_compiled, tight), read_desolve)
  }
  add("GSL rk8pd in C, 1e-9, over the kinks", child(gsl, "whole", spin_times))
  add("GSL rk8pd in C, 1e-9, split at the kinks", child(gsl, "split", spin_times))
  if (!is.null(scipy)) {
    python <- function(how) child(scipy$command, how, spin_times, "bench/peers/spin-up-scipy.py")
    add("scipy RK45, 1e-3 (default)", python("rk45-default"))
    add("scipy RK45, 1e-9", python("rk45-tight"))
    add("scipy LSODA, 1e-9", python("lsoda-tight"))
  }
  # Short batches: the garbage of a long one would be collected in it.
  paired("spin-up", "1000 rows", contenders, rounds, batches = 10, batch_us = 2e3)
}
