# The model of two bodies and a clutch. The scene as src/ffi_clutch.c wants it.
clutch_pack <- function(scene) {
  # -Inf is no time for the core: engaged from the start on says the same.
  engage <- max(scene$engage_s, scene$start_s)
  list(
    c(
      scene$moment_of_inertia_kg_m2, scene$capacity_n_m, scene$static_capacity_n_m, engage,
      scene$start_s, scene$theta0_rad, scene$omega0_rad_per_s
    ),
    scene$steps[[1]], scene$steps[[2]]
  )
}

clutch_exact <- list(
  id = "clutch_exact",
  equations = "I1 omega1' = tau1 - T, I2 omega2' = tau2 + T; T = capacity sign(slip) or less",
  assumptions = "rigid bodies; capacity constant while it slips; torques constant between jumps",
  limits = "not before the start; where a torque equals the static capacity, rounding decides",
  requires = "constant or stepped torques",
  source = "closed form between exact events; Shigley 2004, chapter 16",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    .Call(ffi_clutch_run, clutch_pack(scene), time_s, progress_bar("clutch"))
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_clutch_ledger, clutch_pack(scene), c(from_s, to_s))
  }
)

clutch_models <- list(clutch_exact)
