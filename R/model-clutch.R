# The model of two bodies and a clutch.

clutch_exact <- list(
  id = "clutch_exact",
  equations = "I1 omega1' = tau1 - T, I2 omega2' = tau2 + T; T = capacity sign(slip) or less",
  assumptions = "rigid bodies; capacity constant while it slips; torques constant between jumps",
  limits = "not before the start; where a torque equals the static capacity, rounding decides",
  requires = "constant or stepped torques",
  source = "closed form between exact events; Shigley 2004, chapter 16",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    result <- .Call(ffi_clutch_run, scene, time_s, progress_bar("clutch"))
    result$info <- void_error(result$info, result$columns)
    result
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_clutch_ledger, scene, c(from_s, to_s))
  }
)

clutch_models <- list(clutch_exact)
