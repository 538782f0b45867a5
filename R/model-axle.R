# Models of a body on a fixed axle.

# ---- closed forms -------------------------------------------------------------------------------

# A closed form. `ledger`: that of the core, or by quadrature of the motion.
axle_closed_form <- function(id, ..., ledger = NULL) {
  list(
    id = id, ...,
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      .Call(ffi_axle_run, id, scene, time_s, progress_bar("closed form"))
    },
    ledger = ledger %||% function(scene, run, from_s, to_s) {
      axle_ledger_by_quadrature(run, from_s, to_s)
    }
  )
}

linear_ledger <- function(scene, run, from_s, to_s) {
  .Call(ffi_axle_ledger, scene, from_s, to_s, progress_bar("ledger"))
}

axle_free <- axle_closed_form(
  "axle_free",
  equations = "omega = omega0; theta = theta0 + omega0 t",
  assumptions = "rigid body; nothing acts about the axle",
  limits = "none in double precision",
  requires = "no torque, no resistance",
  source = "Goldstein 2002, section 1.1",
  ledger = linear_ledger
)

axle_linear <- axle_closed_form(
  "axle_linear",
  equations = "I domega/dt = torque(t) - c omega, solved in closed form between the knots",
  assumptions = "rigid body; torque a piecewise-linear function of time; resistance -c omega",
  limits = "any c t/I from 0 to 1e300; the state must stay within double precision",
  requires = "constants, knots, steps, pulses, linear motors; viscous resistance or none",
  source = "Hochbruck & Ostermann 2010, section 2.1 (phi functions)",
  ledger = linear_ledger
)

axle_skater <- axle_closed_form(
  "axle_skater",
  equations = "d(I(t) omega)/dt = torque, I piecewise linear in time",
  assumptions = "rigid but for the change of inertia, which needs no torque about the axle",
  limits = "none in double precision",
  requires = "inertia_knots(); a torque that is constant between its steps; no resistance",
  source = "Goldstein 2002, section 1.1"
)

axle_pendulum <- axle_closed_form(
  "axle_pendulum",
  equations = "I domega/dt = -m g d sin(theta), in Jacobi's elliptic functions",
  assumptions = "rigid body; uniform gravity",
  limits = "any amplitude, rotation and the separatrix included",
  requires = "torque_gravity() and nothing else",
  source = "Landau & Lifshitz 1976, section 11; DLMF chapter 22"
)

axle_oscillator <- axle_closed_form(
  "axle_oscillator",
  equations = "I domega/dt = -k (theta - rest) - c omega + torque(t)",
  assumptions = "rigid body; a spring that obeys Hooke's law",
  limits = "any damping; the state must stay within double precision",
  requires = "torque_spring(), constants, knots, steps, sinusoids, motors, viscous resistance",
  source = "Landau & Lifshitz 1976, sections 22 to 26"
)

axle_forced <- axle_closed_form(
  "axle_forced",
  equations = "I domega/dt = torque(t) - c omega, solved term by term",
  assumptions = "rigid body; resistance -c omega",
  limits = "polynomials to degree 16; the state must stay within double precision",
  requires =
    "sums of constants, knots, polynomials, sinusoids, exponentials, motors; viscous resistance",
  source =
    "Hochbruck & Ostermann 2010, section 2.1; McCurdy, Ng & Parlett 1984 (divided differences)"
)

axle_drag <- axle_closed_form(
  "axle_drag",
  equations =
    "I domega/dt = torque - c omega - q omega |omega| - tau_c sign(omega); sticks at rest",
  assumptions = "rigid body; a torque that is constant between its steps",
  limits = "forward in time; c >= 0",
  requires = "constants, steps, pulses, a motor; viscous, quadratic and dry friction",
  source = "Riccati's equation; Armstrong-Helouvry 1991, chapter 2 (dry friction)"
)

axle_bands <- axle_closed_form(
  "axle_bands",
  equations =
    "I domega/dt = torque(t) + curve(omega) - c omega - tau_c sign(omega); sticks at rest",
  assumptions = "rigid body; torque piecewise linear in time and in omega",
  limits = "forward in time",
  requires =
    "constants, knots, steps, pulses, motors, one torque_curve(); viscous and dry friction",
  source = "Armstrong-Helouvry 1991, chapter 2 (dry friction)"
)

# ---- integrated ---------------------------------------------------------------------------------

axle_integrator <- function(id, method, ...) {
  list(
    id = id,
    equations = "d(I omega)/dt = torque(t, theta, omega) + resistance, integrated",
    assumptions = "rigid body; torque finite, and smooth between its breaks",
    requires = "any torque, any resistance",
    ...,
    adapts = TRUE,
    ran_as = function(info) {
      if (info$method %in% c("rk8pd", "radau")) paste0("axle_", info$method) else id
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      integrate_axle(scene, time_s, accuracy, max_steps, call, if (asked) method else 0)
    },
    # The integrator carries the ledger with the state; other rows mean another run.
    ledger = function(scene, run, from_s, to_s) {
      result <- integrate_axle(
        scene, c(from_s, to_s), run$accuracy, run$max_steps, run$call, method
      )
      if (result$info$kind == "none") result$ledger else empty_axle_ledger(NA_real_)
    }
  )
}

axle_rk8pd <- axle_integrator(
  "axle_rk8pd", 1,
  limits = "not stiff: a step is at most about 6 I/c long",
  source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library"
)

axle_radau <- axle_integrator(
  "axle_radau", 2,
  limits = "each step solves a system of equations: expensive for a motion that is not stiff",
  source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)"
)

scene_words <- function(scene) {
  constraint <- constraint_of(scene)
  effects_in_words(constraint$effects_of(scene), constraint)
}

axle_models <- list(
  axle_free, axle_linear, axle_skater, axle_drag, axle_forced, axle_oscillator, axle_pendulum,
  axle_bands, axle_rk8pd, axle_radau
)

