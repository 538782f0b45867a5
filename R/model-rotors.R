# Models of several rotors on one shaft.

# Rows in long form: by time, then rotor. `how`: 0 rigid, 1 modal, 2 modal with shared exponentials.
run_rotors_as <- function(how, scene, time_s) {
  result <- .Call(ffi_rotors_run, scene, time_s, as.double(how), progress_bar("rotors"))
  inertia <- scene$moment_of_inertia_kg_m2
  n <- length(inertia)
  rotor <- rep.int(seq_len(n), length(time_s))
  omega <- result[[1]]$omega_rad_per_s
  momentum <- inertia[rotor] * omega
  columns <- list(
    time_s = rep(time_s, each = n),
    rotor = rotor,
    theta_rad = result[[1]]$theta_rad,
    omega_rad_per_s = omega,
    angular_momentum_kg_m2_per_s = momentum,
    rotational_kinetic_energy_j = 0.5 * momentum * omega,
    shaft_torque_n_m = result[[1]]$shaft_torque_n_m
  )
  list(columns, result[[2]], NULL, NULL)
}

rotors_rigid <- list(
  id = "rotors_rigid",
  constraint = "rotors",
  equations = "sum(J) domega/dt = sum(tau) - sum(d) omega: all rotors turn as one",
  assumptions = "twists stay below the accuracy asked for: bounded by their energy",
  limits = "a bound is known forward in time, or without damping; every piece needs a stiffness",
  requires = "constant torques, stiff shafts",
  source = "energy norm of the difference; Meirovitch 2001, section 7.5",
  error_kind = "bound",
  handles = character(),
  why_not = function(scene, time_s) {
    if (any(scene$stiffness_n_m_per_rad == 0)) "a piece of the shaft has no stiffness"
  },
  why = function(scene) "the twists stay below the accuracy: the shaft turns as one body",
  error = function(accuracy) 4e-15,
  cost = function(scene, rows, accuracy) 40 * rows * length(scene$moment_of_inertia_kg_m2),
  run = function(scene, time_s, accuracy, max_steps, call, asked) run_rotors_as(0, scene, time_s),
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_rotors_ledger, scene, 1, c(from_s, to_s))
  }
)

# Even rows may share an exponential where its error is good enough.
share_exponentials <- function(accuracy) accuracy >= 1e-11

rotors_modal <- list(
  id = "rotors_modal",
  constraint = "rotors",
  equations = "J theta'' + C theta' + K theta = tau, mean motion and twists in modes",
  assumptions = "rigid rotors, linear springs and dampers, constant torques",
  limits = "constant torques; the error grows with the phase where rotors are damped unevenly",
  requires = "constant torques",
  source = "Meirovitch 2001, chapter 7; Higham 2005 (exponential of a matrix)",
  error_kind = "estimate",
  handles = character(),
  why_not = function(scene, time_s) NULL,
  why = function(scene) "linear springs and dampers under constant torques: the modes are exact",
  error = function(accuracy) 1e-14,
  cost = function(scene, rows, accuracy) {
    n <- length(scene$moment_of_inertia_kg_m2)
    40 * n^3 + rows * (200 * n + 8 * n^2)
  },
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    run_rotors_as(if (share_exponentials(accuracy)) 2 else 1, scene, time_s)
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_rotors_ledger, scene, 0, c(from_s, to_s))
  }
)

rotors_models <- list(rotors_rigid, rotors_modal)

# What the rigid shaft leaves out depends on the times: its record with the bound for these.
rotors_models_for <- function(scene, time_s) {
  rigid <- rotors_rigid
  if (is.null(rigid$why_not(scene, time_s))) {
    bound <- run_rotors_as(0, scene, time_s)[[2]]$error
    rigid$error <- function(accuracy) max(4e-15, bound)
  }
  list(rigid, rotors_modal)
}
