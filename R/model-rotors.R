# Models of several rotors on one shaft.

# Rows in long form: by time, then rotor. `how`: 0 rigid, 1 modal, 2 modal with shared exponentials.
run_rotors_as <- function(how, scene, time_s) {
  result <- .Call(ffi_rotors_run, scene, time_s, as.double(how), progress_bar("rotors"))
  inertia <- scene$moment_of_inertia_kg_m2
  n <- length(inertia)
  rotor <- rep.int(seq_len(n), length(time_s))
  omega <- result$columns$omega_rad_per_s
  momentum <- inertia[rotor] * omega
  columns <- list(
    time_s = rep(time_s, each = n),
    rotor = rotor,
    theta_rad = result$columns$theta_rad,
    omega_rad_per_s = omega,
    angular_momentum_kg_m2_per_s = momentum,
    rotational_kinetic_energy_j = 0.5 * momentum * omega,
    shaft_torque_n_m = result$columns$shaft_torque_n_m
  )
  list(columns = columns, info = void_error(result$info, columns))
}

rotors_rigid <- list(
  id = "rotors_rigid",
  equations = "sum(J) domega/dt = sum(tau) - sum(d) omega: all rotors turn as one",
  assumptions = "twists stay below the accuracy asked for: bounded by their energy",
  limits = "a bound is known forward in time, or without damping; every piece needs a stiffness",
  requires = "constant torques, stiff shafts",
  source = "energy norm of the difference; Meirovitch 2001, section 7.5",
  run = function(scene, time_s, accuracy, max_steps, call, asked) run_rotors_as(0, scene, time_s),
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_rotors_ledger, scene, 1, c(from_s, to_s), progress_bar("ledger"))
  }
)

# Even rows may share an exponential where its error is good enough.
share_exponentials <- function(accuracy) accuracy >= 1e-11

rotors_modal <- list(
  id = "rotors_modal",
  loses = "Stiff springs turn through many radians of phase, and large terms may cancel.",
  equations = "J theta'' + C theta' + K theta = tau, mean motion and twists in modes",
  assumptions = "rigid rotors, linear springs and dampers, constant torques",
  limits = "constant torques; the error grows with the phase where rotors are damped unevenly",
  requires = "constant torques",
  source = "Meirovitch 2001, chapter 7; Higham 2005 (exponential of a matrix)",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    run_rotors_as(if (share_exponentials(accuracy)) 2 else 1, scene, time_s)
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_rotors_ledger, scene, 0, c(from_s, to_s), progress_bar("ledger"))
  }
)

rotors_models <- list(rotors_rigid, rotors_modal)
