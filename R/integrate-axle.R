# The run of an axle by an integrator, after breaks and samples of an R function.

integrate_axle <- function(id, scene, time_s, accuracy, max_steps, call, asked) {
  loads <- torque_loads(given_torque(scene))
  law <- loads$law
  resolution <- if (is.null(law)) 0 else resolution_of(scene)
  control <- c(accuracy, max_steps, asked, resolution, TRUE, FALSE, 0)
  solve <- function(solved, time_s, laws = NULL) {
    .Call(ffi_scene_run, "axle", solved, id, time_s, control, laws, progress_bar("integrating"))
  }
  if (is.null(law)) return(solve(scene, time_s))
  span <- range(scene$start_s, time_s)
  reader <- law_reader(law, scene, call)
  if (law$arguments == 3L) check_start_level(scene, reader, call)
  seen <- law_breaks(law, reader$at, span[1], span[2], call, resolution)
  sampled <- if (law$arguments == 1L) sample_and_compare(reader, resolution, span, seen, accuracy)
  if (is.null(sampled)) {
    law$breaks_s <- seen$stops
    solved <- with_law(scene, law)
    result <- solve(solved, time_s, list(torque = list(reader$own)))
  } else {
    term <- sampled_law(sampled)
    solved <- with_law(scene, term)
    result <- solve(solved, time_s)
    alone <- identical(axle_torque(solved), term)
    if (alone) result <- read_zeros(result, sampled, reader$at, time_s)
  }
  result$info$rhs_calls <- reader$calls() + if (is.null(sampled)) result$info$rhs_calls else 0
  result$info$resolution <- resolution
  if (is.null(sampled) || length(time_s) == 0L || result$info$kind != "none") return(result)
  add_sampling(result, sampled, scene, time_s, function(push_n_m) {
    pushed <- solved
    pushed$torque <- sum_torques(solved$torque, torque_constant(push_n_m))
    solve(pushed, seq(min(scene$start_s, time_s), max(scene$start_s, time_s), length.out = 65L))
  }, accuracy)
}

# The scene with a law in the place of all its R functions.
with_law <- function(scene, law) {
  laws <- if (inherits(scene$torque, "rot_torque_sum")) scene$torque$laws else list(scene$torque)
  others <- Filter(function(one) !inherits(one, "rot_torque_function"), laws)
  scene$torque <- if (length(others)) do.call(sum_torques, c(others, list(law))) else law
  scene
}

# A body at rest where its torque jumps in the angle, pushed back from both sides by more than holds
# it: it stays, and an integrator would cross the jump for ever. Two calls where it is not so.
check_start_level <- function(scene, reader, call) {
  if (scene$omega0_rad_per_s != 0) return()
  theta <- scene$theta0_rad
  difference <- max(4 * .Machine$double.eps * abs(theta), 1e-300)
  others <- .Call(ffi_axle_torques, scene, scene$start_s, theta, 0)$applied_torque_n_m
  torque <- function(steps) reader$beside(theta + steps * difference) + others
  holds <- axle_resistance(scene)$static_n_m
  above <- torque(1)
  if (!isTRUE(above < -holds)) return()
  below <- torque(-1)
  if (!isTRUE(below > holds)) return()
  # At an angle where the law's value holds it the integrator rests; no jump but a slope grows.
  here <- torque(0)
  steep <- max(abs(torque(64) - above), abs(torque(-64) - below)) > 0.1 * (below - above)
  if (steep || !isTRUE(abs(here) > holds)) return()
  abort_rotdyn(c(
    "The torque pushes the body back to where it starts at rest, from both sides: it stays there.",
    x = "At {format(theta, digits = 17)} rad the law gives {format(here)} N m, beside it
         {format(below)} and {format(above)} N m.",
    i = "Let it return 0 N m at that angle, as {.code sign()} does at 0: then it rests. Or start
         beside it."
  ), "step", call)
}

# Where a law alone passes zero, its samples leave their rounding: those rows take what the function
# returns, if that is as small. At most 129 calls.
read_zeros <- function(result, sampled, at, time_s) {
  if (result$info$kind != "none") return(result)
  applied <- result$columns$applied_torque_n_m
  noise <- 4e-15 * sampled$largest
  rows <- utils::head(which(applied != 0 & abs(applied) <= noise), 129L)
  if (!length(rows)) return(result)
  exact <- at(time_s[rows])
  small <- is.finite(exact) & abs(exact) <= noise
  rows <- rows[small]
  exact <- exact[small]
  damping <- result$columns$damping_torque_n_m[rows]
  stuck <- result$columns$net_torque_n_m[rows] == 0
  damping[stuck] <- -exact[stuck]
  result$columns$applied_torque_n_m[rows] <- exact
  result$columns$damping_torque_n_m[rows] <- damping
  result$columns$net_torque_n_m[rows] <- exact + damping
  result
}

# The error of the samples added to that of the run. The bound assumes an inverted pendulum at all
# times, a growth of 1e125 in 100 s: where it matters the growth is measured, by a constant torque
# large enough to exceed the integration's own error. solve(push_n_m): the motion with it added.
add_sampling <- function(result, sampled, scene, time_s, solve, accuracy) {
  if (all(result$info$sizes == 0)) return(result) # at rest throughout, held
  disturb <- function(size, impulse, grow) {
    .Call(ffi_axle_disturbance, scene, time_s, c(size, impulse, grow))
  }
  free <- disturb(1, Inf, 1)
  grow <- disturb(1, Inf, NaN)[["omega"]] / free[["omega"]]
  push <- min(100 * accuracy, 1e-3) * result$info$sizes[["omega"]] / free[["omega"]]
  if (isTRUE(grow > 2) && is.finite(push) && push > 0) {
    runs <- lapply(c(0, push), solve)
    if (all(vapply(runs, function(run) run$info$kind == "none", logical(1)))) {
      difference <- function(column) {
        max(abs(runs[[2]]$columns[[column]] - runs[[1]]$columns[[column]])) / push
      }
      grow <- max(1, c(difference("theta_rad"), difference("omega_rad_per_s")) / free)
    }
  } else if (!is.finite(grow)) {
    grow <- 1 # no motion, or no time
  }
  result$info <- widen_error(result$info, disturb(sampled$error, sampled$impulse, grow))
  result
}
