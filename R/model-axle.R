# Models of a body on a fixed axle. .subset2() because `$` looks for a method first: 10 us of a 35
# us call.

# Times where a torque or the inertia jumps or kinks; those of an R function are looked for later.
axle_breaks <- function(scene) {
  terms <- lapply(scene$loads$terms, function(term) term$breaks_s)
  sort(unique(c(scene$loads$knots$time_s, unlist(terms), scene$inertia$time_s)))
}

viscous_of <- function(scene) .subset2(.subset2(scene, "resistance"), "viscous_n_m_s")

motor_of <- function(scene) .subset2(.subset2(scene, "loads"), "motor_n_m_s")

knots_of <- function(scene) .subset2(.subset2(scene, "loads"), "knots")

# ---- reasons ------------------------------------------------------------------------------------

# An effect in words.
effect_words <- c(
  torque = "a torque",
  ramp = "a torque that changes in time",
  sinusoid = "a sinusoidal torque",
  exponential = "an exponential torque",
  polynomial = "a polynomial torque",
  curve = "a torque-speed curve",
  spring = "a spring",
  gravity = "gravity",
  "function" = "a torque that is an R function",
  viscous = "viscous resistance",
  motor = "a motor",
  quadratic = "quadratic drag",
  friction = "dry friction",
  inertia = "a changing moment of inertia"
)

# A torque that changes in time is a torque, too: said once.
effects_in_words <- function(effects) {
  if ("ramp" %in% effects) effects <- setdiff(effects, "torque")
  and_words(unname(effect_words[effects]))
}

and_words <- function(x) {
  n <- length(x)
  if (n < 2L) x else paste(paste(x[-n], collapse = ", "), "and", x[n])
}

terms_of <- function(scene, kind) {
  Filter(function(term) term$kind %in% kind, scene$loads$terms)
}

always <- function(terms) {
  all(vapply(terms, function(term) term$from_s == -Inf && term$to_s == Inf, logical(1)))
}

why_not_backward <- function(scene, time_s) {
  if (length(time_s) && time_s[1] < scene$start_s) {
    "it cannot run backwards from the scene's start"
  }
}

# ---- closed forms -------------------------------------------------------------------------------

axle_free <- list(
  id = "axle_free",
  constraint = "axle",
  equations = "omega = omega0; theta = theta0 + omega0 t",
  assumptions = "rigid body; nothing acts about the axle",
  limits = "none in double precision",
  requires = "no torque, no resistance",
  source = "Goldstein 2002, section 1.1",
  error_kind = "bound",
  handles = character(),
  why_not = function(scene, time_s) NULL,
  why = function(scene) "nothing acts about the axle: omega keeps its value",
  error = function(accuracy) 4e-16,
  cost = function(scene, rows, accuracy) 10 * rows,
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    .Call(ffi_axle_run, "axle_free", scene, time_s, progress_bar("free spin"))
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_axle_ledger, scene, from_s, to_s, progress_bar("ledger"))
  }
)

axle_linear <- list(
  id = "axle_linear",
  constraint = "axle",
  equations = "I domega/dt = torque(t) - c omega, solved in closed form between the knots",
  assumptions = "rigid body; torque a piecewise-linear function of time; resistance -c omega",
  limits = "any c t/I from 0 to 1e300; the state must stay within double precision",
  requires = "constants, knots, steps, pulses, linear motors; viscous resistance or none",
  source = "Hochbruck & Ostermann 2010, section 2.1 (phi functions)",
  error_kind = "bound",
  handles = c("torque", "ramp", "viscous", "motor"),
  why_not = function(scene, time_s) NULL,
  why = function(scene) {
    knots <- knots_of(scene)
    paste0(
      "the torque is ",
      if (motor_of(scene) != 0) "linear in the speed" else
        if (length(knots$time_s)) "piecewise linear" else "constant",
      if (viscous_of(scene) == 0) " and nothing resists" else
        " and the resistance viscous",
      ": the solution is known in closed form"
    )
  },
  # Some twenty roundings of the terms added (measured: four). Terms of two signs that cancel lose
  # more: the run's own bound says how much, and warns.
  error = function(accuracy) 2.5e-15,
  # On even times; 100 a row elsewhere.
  cost = function(scene, rows, accuracy) 30 * rows + 600 * (1 + length(knots_of(scene)$time_s)),
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    .Call(ffi_axle_run, "axle_linear", scene, time_s, progress_bar("closed form"))
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_axle_ledger, scene, from_s, to_s, progress_bar("ledger"))
  }
)

# A closed form for scenes with more than knots.
axle_kernel <- function(id, ..., why, error, each, why_not = function(scene, time_s) NULL) {
  promised <- error
  list(
    id = id, constraint = "axle", ...,
    error_kind = "bound",
    why_not = why_not,
    why = function(scene) paste0(why, ": the solution is known in closed form"),
    error = function(accuracy) promised,
    cost = function(scene, rows, accuracy) each * (rows + 4 * length(axle_breaks(scene)) + 1),
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      .Call(ffi_axle_run, id, scene, time_s, progress_bar("closed form"))
    },
    ledger = function(scene, run, from_s, to_s) ledger_by_quadrature(scene, run, from_s, to_s)
  )
}

axle_skater <- axle_kernel(
  "axle_skater",
  equations = "d(I(t) omega)/dt = torque, I piecewise linear in time",
  assumptions = "rigid but for the change of inertia, which needs no torque about the axle",
  limits = "none in double precision",
  requires = "inertia_knots(); a torque that is constant between its steps; no resistance",
  source = "Goldstein 2002, section 1.1",
  handles = c("torque", "inertia"),
  why = "angular momentum changes by the torque alone",
  error = 4e-15, each = 200
)

axle_pendulum <- axle_kernel(
  "axle_pendulum",
  equations = "I domega/dt = -m g d sin(theta), in Jacobi's elliptic functions",
  assumptions = "rigid body; uniform gravity",
  limits = "any amplitude, rotation and the separatrix included",
  requires = "torque_gravity() and nothing else",
  source = "Landau & Lifshitz 1976, section 11; DLMF chapter 22",
  handles = "gravity",
  why = "gravity alone acts",
  error = 1e-14, each = 500,
  why_not = function(scene, time_s) {
    gravity <- terms_of(scene, "gravity")
    if (length(gravity) != 1L) "it needs gravity, and only one" else
      if (!always(gravity)) "gravity must act at all times"
  }
)

axle_oscillator <- axle_kernel(
  "axle_oscillator",
  equations = "I domega/dt = -k (theta - rest) - c omega + torque(t)",
  assumptions = "rigid body; a spring that obeys Hooke's law",
  limits = "any damping; the state must stay within double precision",
  requires = "torque_spring(), constants, knots, steps, sinusoids, motors, viscous resistance",
  source = "Landau & Lifshitz 1976, sections 22 to 26",
  handles = c("spring", "torque", "ramp", "sinusoid", "viscous", "motor"),
  why = "the equation is linear",
  error = 1e-14, each = 400,
  why_not = function(scene, time_s) {
    spring <- terms_of(scene, "spring")
    if (length(spring) != 1L) "it needs a spring, and only one" else
      if (spring[[1]]$x[1] <= 0) "the spring's stiffness must be greater than 0" else
        if (!always(c(spring, terms_of(scene, "sinusoid")))) {
          "spring and sinusoids must act at all times"
        }
  }
)

axle_forced <- axle_kernel(
  "axle_forced",
  equations = "I domega/dt = torque(t) - c omega, solved term by term",
  assumptions = "rigid body; resistance -c omega",
  limits = "polynomials to degree 16; the state must stay within double precision",
  requires = "sums of constants, knots, polynomials, sinusoids, exponentials, motors; viscous resistance",
  source = "Hochbruck & Ostermann 2010, section 2.1; McCurdy, Ng & Parlett 1984 (divided differences)",
  handles = c(
    "torque", "ramp", "viscous", "motor", "sinusoid", "exponential", "polynomial"
  ),
  why = "the torque is a sum of laws in time, and the resistance viscous or none",
  error = 1e-14, each = 400,
  why_not = function(scene, time_s) {
    degree <- vapply(terms_of(scene, "polynomial"), function(term) term$x[2] - 1, double(1))
    if (any(degree > 16)) "it takes polynomials up to degree 16"
  }
)

axle_drag <- axle_kernel(
  "axle_drag",
  equations = "I domega/dt = torque - c omega - q omega |omega| - tau_c sign(omega); sticks at rest",
  assumptions = "rigid body; a torque that is constant between its steps",
  limits = "forward in time; c >= 0",
  requires = "constants, steps, pulses, a motor; viscous, quadratic and dry friction",
  source = "Riccati's equation; Armstrong-Helouvry 1991, chapter 2 (dry friction)",
  handles = c("torque", "viscous", "motor", "quadratic", "friction"),
  why = "the torque is constant between its steps",
  error = 2e-14, each = 300,
  why_not = function(scene, time_s) {
    if (viscous_of(scene) + motor_of(scene) < 0) "it takes no viscous coefficient below 0" else
      why_not_backward(scene, time_s)
  }
)

axle_bands <- axle_kernel(
  "axle_bands",
  equations = "I domega/dt = torque(t) + curve(omega) - c omega - tau_c sign(omega); sticks at rest",
  assumptions = "rigid body; torque piecewise linear in time and in omega",
  limits = "forward in time",
  requires = "constants, knots, steps, pulses, motors, one torque_curve(); viscous and dry friction",
  source = "Armstrong-Helouvry 1991, chapter 2 (dry friction)",
  handles = c("torque", "ramp", "viscous", "motor", "curve", "friction"),
  why = "torque and resistance are straight lines between known speeds",
  error = 1e-13, each = 600,
  why_not = function(scene, time_s) {
    curve <- terms_of(scene, "curve")
    if (length(curve) > 1L) "it takes one curve" else
      if (!always(curve)) "the curve must act at all times" else
        why_not_backward(scene, time_s)
  }
)

# ---- integrated ---------------------------------------------------------------------------------

axle_integrator <- function(id, method, ..., each, why) {
  list(
    id = id, constraint = "axle",
    equations = "d(I omega)/dt = torque(t, theta, omega) + resistance, integrated",
    assumptions = "rigid body; torque finite, and smooth between its breaks",
    ...,
    error_kind = "estimate",
    handles = names(effect_words),
    why_not = function(scene, time_s) {
      if ("friction" %in% scene$effects) why_not_backward(scene, time_s)
    },
    why = why,
    error = function(accuracy) max(accuracy, 1e-13),
    cost = function(scene, rows, accuracy) {
      # Two runs of 13 evaluations a step; up to 64 rows are landed on, more are filled in. An R call
      # is some 500 ns; samples of a function of time alone are few.
      call_r <- !is.null(scene$loads$law) && scene$loads$law$arguments == 3L
      steps <- min(rows, 64) + 4 * max(1, -log10(accuracy)) * (1 + length(axle_breaks(scene)))
      (if (call_r) 2000 else each) * 2 * 13 * steps
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      integrate_axle(scene, time_s, accuracy, max_steps, call, if (asked) method else 0)
    },
    # The integrator carries the ledger with the state; other rows mean another run.
    ledger = function(scene, run, from_s, to_s) {
      result <- integrate_axle(scene, c(from_s, to_s), run$accuracy, run$max_steps, run$call, method)
      if (result[[2]]$kind == "none") result[[3]] else rep(NA_real_, 11)
    }
  )
}

axle_rk8pd <- axle_integrator(
  "axle_rk8pd", 1,
  limits = "not stiff: a step is at most about 6 I/c long",
  requires = "any torque, any resistance",
  source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library",
  each = 60,
  why = function(scene) paste0("no closed form is known for this scene (", scene_words(scene),
                               "), so it is integrated")
)

axle_radau <- axle_integrator(
  "axle_radau", 2,
  limits = "each step solves a system of equations: dear where the motion is not stiff",
  requires = "any torque, any resistance",
  source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)",
  each = 300,
  why = function(scene) "the motion is stiff: resistance acts much faster than the times asked for"
)

scene_words <- function(scene) effects_in_words(scene$effects)

# Cheapest first.
axle_closed_forms <- list(
  axle_free, axle_linear, axle_skater, axle_drag, axle_forced, axle_oscillator, axle_pendulum,
  axle_bands
)

# A function of the fraction done, for the C code to call at most 20 times a second. The bar comes
# into being a second after the first call, so that short work makes none and asks no clock.
progress_bar <- function(name) {
  start <- NULL
  bar <- NULL
  owner <- parent.frame()
  function(fraction) {
    if (is.null(bar)) {
      if (is.null(start)) start <<- proc.time()[[3L]]
      if (proc.time()[[3L]] - start < 1) {
        return()
      }
      bar <<- cli::cli_progress_bar(name, total = 1, .envir = owner)
    }
    cli::cli_progress_update(set = fraction, id = bar, .envir = owner)
  }
}
