# The models of a free body.

free_exact <- list(
  id = "free_exact",
  equations = "L' = L x omega - damping L (body axes), q' = q (0, omega)/2",
  assumptions = "rigid body; damping in proportion to the angular momentum",
  limits = "beyond 1e15 rad no digit of the attitude is left",
  requires = "no torque",
  source = "Landau and Lifshitz, Mechanics, section 37; elliptic functions of DLMF 19 and 22",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    result <- .Call(ffi_free_exact, scene, time_s, progress_bar("tumbling"))
    result$info <- void_error(result$info, result$columns)
    result
  },
  ledger = function(scene, run, from_s, to_s) {
    flow <- .Call(ffi_free_flows, scene, c(from_s, to_s))
    eps <- .Machine$double.eps
    c(
      flow,
      energy_rounding_j = 8 * eps * abs(flow[["heat_j"]]),
      impulse_rounding_n_m_s = 8 * eps * max(abs(flow[free_impulses("damping")]))
    )
  }
)

free_impulses <- function(of) paste0(of, "_impulse_", c("x", "y", "z"), "_n_m_s")

free_gyrostat <- list(
  id = "free_gyrostat",
  equations = "L' = L x omega, L = I omega + sum J W a (body axes), q' = q (0, omega)/2",
  assumptions = "rigid body; symmetric rotors, driven at constant speeds or free of friction",
  limits = "beyond 1e15 rad no digit of the attitude is left",
  requires = "rotors along a principal axis, no torque, no damping",
  source = "Hughes 1986, Spacecraft Attitude Dynamics, chapter 6; functions of DLMF 19 and 22",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    result <- .Call(ffi_free_gyrostat, scene, time_s, progress_bar("tumbling"))
    result$info <- void_error(result$info, result$columns)
    result
  },
  ledger = function(scene, run, from_s, to_s) {
    names <- c(
      "work_j", "heat_j", free_impulses("torque"), free_impulses("damping"), "motor_work_j",
      "energy_rounding_j", "impulse_rounding_n_m_s"
    )
    out <- stats::setNames(double(length(names)), names)
    driven <- driven_momentum(scene)
    ends <- .Call(ffi_free_gyrostat, scene, c(from_s, to_s), NULL)
    rates <- do.call(cbind, ends$columns[free_rates("")])
    # The torque on a driven rotor is J a omega', its power that times W.
    out[["motor_work_j"]] <- sum(driven * (rates[2, ] - rates[1, ]))
    out[["energy_rounding_j"]] <- 2 * sum(abs(driven)) * ends$info$errors[["omega"]]
    out
  }
)

# ---- integrated ---------------------------------------------------------------------------------

# What C calls: f(c(time_s, omega, attitude)), which returns three numbers.
free_law <- function(law, call) {
  if (is.null(law)) return(NULL)
  f <- law$f
  arguments <- law$arguments
  function(x) {
    value <- if (arguments == 1L) f(x[1]) else f(x[1], x[2:4], x[5:8])
    if (!is.numeric(value) || is.object(value) || length(value) != 3L) {
      abort_rotdyn(c(
        "The function {.arg torque_n_m} must return three numbers in N m.",
        x = "At {format(x[1], digits = 17)} s it returned {describe_value(value)}."
      ), "torque", call)
    }
    as.double(value)
  }
}

free_laws <- function(scene, call) {
  list(free_law(scene$law, call), motor_laws(scene$rotors, call))
}

integrate_free <- function(scene, time_s, accuracy, max_steps, call, method) {
  result <- .Call(
    ffi_free_integrate, scene, free_laws(scene, call), time_s,
    c(accuracy, max_steps, method, resolution_of(scene)),
    progress_bar("integrating")
  )
  called <- !is.null(scene$law) || !is.null(motor_laws(scene$rotors, call))
  if (called) result$info$resolution <- resolution_of(scene)
  with_free_sums(result, time_s)
}

# The result of a run by steps, with its sums as a matrix.
with_free_sums <- function(result, time_s) {
  sums <- result$ledger
  errors <- sums$errors
  sums$errors <- NULL
  n <- length(time_s)
  result$ledger <- cbind(
    do.call(cbind, c(list(time_s = time_s), sums)),
    energy_rounding_j = rep(errors[1] + errors[2] + errors[9], n),
    impulse_rounding_n_m_s = rep(max(errors[3:5]) + max(errors[6:8]), n)
  )
  result$info <- void_error(result$info, result$columns)
  result
}

# Between two times, from the run's own sums where it has these times. NULL where that failed.
integrated_free_ledger <- function(scene, run, from_s, to_s) {
  known <- free_sums(scene, run, c(from_s, to_s))
  if (is.null(known)) return(NULL)
  errors <- grepl("_rounding_", colnames(known)[-1]) # of the whole run
  known[2, -1] - ifelse(errors, 0, known[1, -1])
}

free_sums <- function(scene, run, time_s) {
  known <- run$ledger
  at <- if (is.null(known)) NA else match(time_s, known[, "time_s"])
  if (!anyNA(at)) return(known[at, , drop = FALSE])
  again <- record_of(run)$run(
    scene, time_s, run$accuracy, run$max_steps + length(time_s), run$call, TRUE
  )
  if (again$info$kind == "none") again$ledger
}

free_integrator <- function(id, method, ...) {
  list(
    id = id,
    equations = "L' = L x omega + torque - damping L (body axes), q' = q (0, omega)/2",
    assumptions = "rigid body; torques finite, and smooth between their breaks",
    requires = "moments of inertia greater than 0",
    ...,
    adapts = TRUE,
    ran_as = function(info) {
      if (info$method %in% c("rk8pd", "radau")) paste0("free_", info$method) else id
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      integrate_free(scene, time_s, accuracy, max_steps, call, if (asked) method else 0)
    },
    ledger = integrated_free_ledger
  )
}

free_rk8pd <- free_integrator(
  "free_rk8pd", 1,
  limits = "not stiff: a step is at most about 6 times the shortest decay",
  source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library"
)

free_radau <- free_integrator(
  "free_radau", 2,
  limits = "each step solves a system of equations: expensive for a motion that is not stiff",
  source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)"
)

# ---- steps of fixed length ----------------------------------------------------------------------

step_free <- function(scene, time_s, step_s, max_steps, call, method) {
  if (is.null(step_s)) {
    span <- if (length(time_s)) max(abs(range(time_s) - scene$start_s)) else 0
    step_s <- .Call(ffi_free_step, scene, method, span)
  }
  result <- .Call(
    ffi_free_step_through, scene, free_laws(scene, call), time_s, c(step_s, max_steps, method, 0),
    progress_bar("stepping")
  )
  result <- with_free_sums(result, time_s)
  result$info$step_s <- step_s
  result
}

# `method`: as in src/core/ground/status.h.
free_stepper <- function(id, method, ...) {
  list(
    id = id,
    equations = free_rk8pd$equations,
    ...,
    adapts = FALSE,
    loses = "Its steps are of fixed length: {.arg step_s} makes them shorter.",
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      step_free(scene, time_s, NULL, max_steps, call, method)
    },
    run_with_step = function(scene, time_s, step_s, max_steps, call) {
      step_free(scene, time_s, step_s, max_steps, call, method)
    },
    ledger = integrated_free_ledger
  )
}

free_euler <- free_stepper(
  "free_euler", 3,
  assumptions = "rigid body; a step goes on along the slopes at its start",
  limits = "order 1; angular momentum and energy grow without bound",
  requires = "to be named; moments of inertia greater than 0",
  source = "Hairer, Norsett and Wanner 1993, section I.7"
)

free_semi_implicit <- free_stepper(
  "free_semi_implicit", 4,
  assumptions = "rigid body; a step changes L in space axes, then turns the body by the new rate",
  limits = "order 1; without torque the angular momentum stays, the energy drifts",
  requires = "to be named; moments of inertia greater than 0",
  source = "Hairer, Lubich and Wanner 2006, section I.1"
)

free_rk4 <- free_stepper(
  "free_rk4", 5,
  assumptions = "rigid body; torques smooth between their breaks",
  limits = "order 4; the energy drifts in proportion to time",
  requires = "to be named; moments of inertia greater than 0",
  source = "Hairer, Norsett and Wanner 1993, section II.1"
)

free_split <- free_stepper(
  "free_split", 6,
  assumptions = "rigid body; a step is composed of exact turns and of kicks by gravity",
  limits = "order 6; the energy stays within a bound, the phase drifts in proportion to time",
  requires = "to be named; no torque but gravity, no motors, no damping, moments greater than 0",
  source = "McLachlan 1995; Kahan and Li 1997; Hairer, Lubich and Wanner 2006, section VII.5"
)

free_models <- list(
  free_exact, free_gyrostat, free_rk8pd, free_radau, free_euler, free_semi_implicit, free_rk4,
  free_split
)
