# The model of two bodies and a clutch.

clutch_exact <- list(
  id = "clutch_exact",
  constraint = "clutch",
  equations = "I1 omega1' = tau1 - T, I2 omega2' = tau2 + T; T = capacity sign(slip) or less",
  assumptions = "rigid bodies; capacity constant while it slips; torques constant between jumps",
  limits = "not before the start; where a torque equals the static capacity, rounding decides",
  requires = "constant or stepped torques",
  source = "closed form between exact events; Shigley 2004, chapter 16",
  error_kind = "bound",
  handles = character(),
  why_not = function(scene, time_s) NULL,
  why = function(scene) "all torques are constant between events: a closed form is known",
  error = function(accuracy) 4e-15,
  cost = function(scene, rows, accuracy) 100 * rows,
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    check_not_before_start(scene, time_s, call)
    result <- .Call(ffi_clutch_run, scene, time_s, progress_bar("clutch"))
    list(result[[1]], result[[2]], NULL, tibble::as_tibble(result[[4]]))
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_clutch_ledger, scene, c(from_s, to_s))
  }
)

clutch_models <- list(clutch_exact)

check_not_before_start <- function(scene, time_s, call) {
  if (length(time_s) && time_s[1] < scene$start_s) {
    abort_rotdyn(
      c(
        "{.arg time_s} must not begin before the scene's {.arg start_s}.",
        x = "It begins at {format(time_s[1])} s, the scene at {format(scene$start_s)} s.",
        i = "A locked clutch has forgotten how it slipped: there is no way back."
      ),
      "time",
      call
    )
  }
}
