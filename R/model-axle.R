# Models of a body on a fixed axle. The numbers and the torque of a scene as src/ffi_axle.c wants
# them. .subset2() because `$` looks for a method first: 10 us of a 35 us call.
axle_numbers <- function(scene) {
  c(
    .subset2(scene, "moment_of_inertia_kg_m2"), viscous_of(scene), .subset2(scene, "start_s"),
    .subset2(scene, "theta0_rad"), .subset2(scene, "omega0_rad_per_s")
  )
}

viscous_of <- function(scene) .subset2(.subset2(scene, "resistance"), "viscous_n_m_s")

axle_knots <- function(torque) {
  list(.subset2(torque, "time_s"), .subset2(torque, "torque_n_m"), .subset2(torque, "outside"))
}

has_knots <- function(scene) inherits(.subset2(scene, "torque"), "rot_torque_knots")

axle_free <- list(
  id = "axle_free",
  constraint = "axle",
  equations = "omega = omega0; theta = theta0 + omega0 t",
  assumptions = "rigid body; nothing acts about the axle",
  limits = "none in double precision",
  requires = "no torque, no resistance",
  source = "Goldstein 2002, section 1.1",
  error_kind = "bound",
  why_not = function(scene) {
    if (viscous_of(scene) != 0) {
      "the resistance is not zero"
    } else if (!torque_is_zero(scene$torque)) {
      "the torque is not zero"
    }
  },
  why = function(scene) "nothing acts about the axle: omega keeps its value",
  error = function(accuracy) 4e-16,
  cost = function(scene, rows, accuracy) 10 * rows,
  run = function(scene, time_s, accuracy, max_steps, call) {
    .Call(ffi_axle_free, axle_numbers(scene), time_s, progress_bar("free spin"))
  },
  ledger = function(scene, run, from_s, to_s) double(6)
)

# Even stretches of the times may be computed by doubling where its bound is good enough.
by_doubling <- function(accuracy) accuracy >= 1e-13

axle_linear <- list(
  id = "axle_linear",
  constraint = "axle",
  equations = "I domega/dt = torque(t) - c omega, solved in closed form between the knots",
  assumptions = "rigid body; torque a piecewise-linear function of time; resistance -c omega",
  limits = "any c t/I from 0 to 1e300; the state must stay within double precision",
  requires = "torque_constant() or torque_knots(); viscous resistance or none",
  source = "Hochbruck & Ostermann 2010, section 2.1 (phi functions)",
  error_kind = "bound",
  why_not = function(scene) {
    if (!has_knots(scene)) "the torque is an R function, not straight lines between knots"
  },
  why = function(scene) {
    paste0(
      "the torque is ",
      if (length(scene$torque$time_s)) "piecewise linear" else "constant",
      if (viscous_of(scene) == 0) " and nothing resists" else
        " and the resistance viscous",
      ": the solution is known in closed form"
    )
  },
  # Twelve roundings of the terms added, or with doubling some eighty (measured: five). Terms of two
  # signs that cancel lose more: the run's own bound says how much, and warns.
  error = function(accuracy) if (by_doubling(accuracy)) 2e-14 else 2e-15,
  cost = function(scene, rows, accuracy) {
    each <- if (by_doubling(accuracy)) 30 else 150
    each * rows + 600 * (1 + length(scene$torque$time_s))
  },
  run = function(scene, time_s, accuracy, max_steps, call) {
    .Call(
      ffi_axle_linear, axle_numbers(scene), axle_knots(.subset2(scene, "torque")), time_s,
      as.double(by_doubling(accuracy)), progress_bar("closed form")
    )
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(
      ffi_axle_ledger, axle_numbers(scene), axle_knots(scene$torque), from_s, to_s,
      progress_bar("ledger")
    )
  }
)

axle_rk8pd <- list(
  id = "axle_rk8pd",
  constraint = "axle",
  equations = "I domega/dt = torque(t, theta, omega) - c omega, integrated",
  assumptions = "rigid body; torque finite, and smooth between its breaks",
  limits = "not stiff: a step is at most about 6 I/c long",
  requires = "any torque",
  source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library",
  error_kind = "estimate",
  why_not = function(scene) NULL,
  why = function(scene) "the torque is an R function: no closed form is known, so it is integrated",
  error = function(accuracy) max(accuracy, 1e-13),
  cost = function(scene, rows, accuracy) {
    # Two runs of 13 evaluations a step; up to 64 rows are landed on, more are filled in; the torque
    # once more for each row. An R call is some 500 ns.
    each <- if (has_knots(scene)) 60 else 2000
    steps <- min(rows, 64) + 4 * max(1, -log10(accuracy)) * (1 + length(scene$torque$time_s))
    each * (2 * 13 * steps + rows)
  },
  run = function(scene, time_s, accuracy, max_steps, call) {
    integrate_axle(scene, time_s, accuracy, max_steps, call)
  },
  # The integrator carries the ledger with the state; other rows mean another run.
  ledger = function(scene, run, from_s, to_s) {
    result <- integrate_axle(scene, c(from_s, to_s), run$accuracy, run$max_steps, run$call)
    if (result[[2]]$kind == "none") result[[3]] else rep(NA_real_, 6)
  }
)

axle_models <- list(axle_free, axle_linear, axle_rk8pd)

integrate_axle <- function(scene, time_s, accuracy, max_steps, call) {
  torque <- scene$torque
  law <- NULL
  if (has_knots(scene)) {
    knots <- axle_knots(torque)
    breaks <- double()
  } else {
    complain <- function(value, time_s) abort_torque_value(value, time_s, call)
    breaks <- torque_breaks(scene, time_s, complain, call)
    knots <- NULL
    # The C code fills in the arguments; an error of the function's own shows the call f(...).
    law <- list(
      as.call(c(quote(f), rep(list(NULL), torque$arguments))),
      list2env(list(f = torque$f), parent = baseenv()),
      complain
    )
  }
  numbers <- c(axle_numbers(scene), 0, 0, 0, 0) # no motor; viscous resistance alone
  pack <- list(numbers, knots, list(), list(double(), double()), breaks)
  .Call(
    ffi_axle_integrate, pack, law, time_s, c(accuracy, max_steps, 0), progress_bar("integrating")
  )
}

abort_torque_value <- function(value, time_s, call) {
  abort_rotdyn(
    c(
      "The torque function must return one number in N m.",
      x = "At {format(time_s, digits = 17)} s it returned {describe_value(value)}."
    ),
    "torque",
    call
  )
}

# Breaks the user told, or those that a scan finds, with a warning.
torque_breaks <- function(scene, time_s, complain, call) {
  torque <- scene$torque
  if (!is.null(torque$breaks_s)) {
    return(torque$breaks_s)
  }
  f <- torque$f
  at <- function(t) {
    value <- if (torque$arguments == 3L) {
      f(t, scene$theta0_rad, scene$omega0_rad_per_s)
    } else {
      f(t)
    }
    if (!(is.numeric(value) || is.logical(value)) || is.object(value) || length(value) != 1L) {
      complain(value, t)
    }
    as.double(value)
  }
  scan <- scan_breaks(at, min(scene$start_s, time_s), max(scene$start_s, time_s))
  breaks <- scan$breaks
  if (length(breaks)) {
    shown <- cli::cli_vec(format(breaks, digits = 7, trim = TRUE), list("vec-trunc" = 6))
    warn_rotdyn(
      c(
        "The torque function was not told its {.arg breaks_s}; a scan found {length(breaks)}.",
        i = "At {shown} s. The integrator stops there.",
        i = "Breaks closer than {format(diff(range(scene$start_s, time_s)) / (scan_points - 1),
             digits = 2)} s may be missed: to be sure, give
             {.code torque_function(f, breaks_s = )}."
      ),
      "breaks",
      call
    )
  }
  sort(c(breaks, scan$guards))
}

# A function of the fraction done, for the C code to call at most 20 times a second. The bar comes
# into being after a second, so that short work makes none.
progress_bar <- function(name) {
  bar <- NULL
  owner <- parent.frame()
  start <- proc.time()[[3L]]
  function(fraction) {
    if (is.null(bar)) {
      if (proc.time()[[3L]] - start < 1) {
        return()
      }
      bar <<- cli::cli_progress_bar(name, total = 1, .envir = owner)
    }
    cli::cli_progress_update(set = fraction, id = bar, .envir = owner)
  }
}
