# The same spin-up with the torque as an R function: both sides integrate and both call R.

run_function_torque <- function(rounds) {
  check_spin_reference()
  reference <- spin_reference(spin_times)
  told <- spin_scene(rotdyn::torque_function(spin_torque, breaks_s = c(1, 4, 6)))
  untold <- spin_scene(rotdyn::torque_function(spin_torque))
  contenders <- list(
    spin_contender(
      "rotdyn, breaks given", function() rotdyn::trajectory(told, spin_times),
      read_rotdyn, reference
    ),
    spin_contender(
      "rotdyn, breaks looked for",
      function() suppressWarnings(rotdyn::trajectory(untold, spin_times)), read_rotdyn, reference
    )
  )
  if (has_package("deSolve")) {
    contenders[[3]] <- spin_contender(
      "deSolve lsoda, 1e-9", desolve_in_r(spin_torque, rtol = 1e-9, atol = 1e-9), read_desolve,
      reference
    )
  }
  paired("function-torque", "1000 rows", contenders, rounds, batch_us = 2e4)
}
