# The model of a body on an incline.

incline_exact <- list(
  id = "incline_exact",
  equations = "m v' = m g sin - F, I omega' = F R - T; Coulomb friction F, rolling resistance T",
  assumptions = "rigid round body on a plane; centre of mass on its axis; constant coefficients",
  limits = "not before the start; where a force equals what friction holds, rounding decides",
  requires = "a body on an incline",
  source = "closed form between exact events; Goldstein 2002, section 2.4",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    result <- .Call(ffi_incline_run, scene, time_s, progress_bar("incline"))
    result$info <- void_error(result$info, result$columns)
    result
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_incline_ledger, scene, c(from_s, to_s))
  }
)

incline_models <- list(incline_exact)
