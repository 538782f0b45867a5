# The run of an axle by an integrator: breaks and samples of an R function first.

integrate_axle <- function(scene, time_s, accuracy, max_steps, call, method) {
  loads <- scene$loads
  breaks <- axle_breaks(scene)
  law <- sampled <- NULL
  if (!is.null(loads$law)) {
    span <- range(scene$start_s, time_s)
    reader <- law_reader(loads$law, scene, call)
    scan <- law_breaks(loads$law, reader$at, span[1], span[2], call)
    if (loads$law$arguments == 1L) {
      sampled <- sample_torque(reader, span, scan$stops, accuracy)
    }
    if (is.null(sampled)) law <- reader$own
    loads$terms <- c(loads$terms, list(sampled$term)[!is.null(sampled)])
    breaks <- sort(unique(c(breaks, scan$stops, sampled$term$breaks_s)))
  }
  solve <- function(loads, time_s) {
    .Call(
      ffi_axle_integrate,
      pack_axle(scene, breaks, loads, if (is.null(sampled)) 0 else sampled$error), law, time_s,
      c(accuracy, max_steps, method), progress_bar("integrating")
    )
  }
  result <- add_end_jumps(solve(loads, time_s), scene, time_s)
  if (!is.null(loads$law)) {
    result$info$rhs_calls <- reader$calls() + if (is.null(sampled)) result$info$rhs_calls else 0
    result$info$scan_spacing_s <- scan$spacing_s
  }
  if (is.null(sampled) || length(time_s) == 0L || result$info$kind != "none") {
    return(result)
  }
  add_sampling(result, sampled, scene, time_s, function(push_n_m) {
    loads$knots <- add_knots(list(loads$knots, torque_constant(push_n_m)))
    solve(loads, seq(min(scene$start_s, time_s), max(scene$start_s, time_s), length.out = 65L))
  }, accuracy)
}

# Where a jump of the inertia lies at an end of the integrator's ledger, it is counted by the side
# that was integrated; in the balance of rows it belongs to what lies before it.
add_end_jumps <- function(result, scene, time_s) {
  n <- length(time_s)
  if (is.null(scene$inertia) || n == 0L || result$info$kind != "none") {
    return(result)
  }
  start <- scene$start_s
  from <- time_s[1]
  to <- time_s[n]
  at <- function(end, omega) {
    jump_work(scene, function(t) omega * inertia_at(scene$inertia, t), function(t) t == end)
  }
  omega <- result$columns$omega_rad_per_s
  add <- function(result, jumps, sign) {
    off <- c(inertia_work_j = sign * sum(jumps$work),
             work_rounding_j = 4 * .Machine$double.eps * sum(jumps$size))
    result$ledger[names(off)] <- result$ledger[names(off)] + off
    result
  }
  if (from < start && to >= start) result <- add(result, at(start, scene$omega0_rad_per_s), 1)
  if (to > start) result <- add(result, at(to, omega[n]), 1)
  if (from > start) result <- add(result, at(from, omega[1]), -1)
  result
}

# What the samples' error can do to the motion, and what the samples cost. solve(push_n_m) is the
# motion under a constant torque besides.
add_sampling <- function(result, sampled, scene, time_s, solve, accuracy) {
  info <- result$info
  grow <- sampling_growth(info, scene, time_s, solve, accuracy)
  reach <- disturbance(scene, sampled$error, time_s, sampled$impulse, grow)
  info <- widen_error(info, reach)
  result$info <- info
  result
}

# How much more a small torque does than in free motion. The bound of growth() takes a pendulum for
# upside down all the time, 1e125 in 100 s: where it matters the growth is measured, by a push that
# stands out from the integration's own error.
sampling_growth <- function(info, scene, time_s, solve, accuracy) {
  free <- disturbance(scene, 1, time_s, grow = 1)
  grow <- disturbance(scene, 1, time_s)$omega / free$omega
  if (!(grow > 2) || !(info$sizes[["omega"]] > 0)) {
    return(if (is.finite(grow)) grow else 1)
  }
  push <- min(100 * accuracy, 1e-3) * info$sizes[["omega"]] / free$omega
  if (!(is.finite(push) && push > 0)) {
    return(grow)
  }
  still <- solve(0)
  moved <- solve(push)
  if (still$info$kind != "none" || moved$info$kind != "none") {
    return(grow)
  }
  apart <- function(column) max(abs(moved$columns[[column]] - still$columns[[column]])) / push
  max(1, apart("omega_rad_per_s") / free$omega, apart("theta_rad") / free$theta)
}
