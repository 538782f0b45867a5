#' Audit a trajectory
#'
#' Two balances from the first row to the last. Energy: the change of kinetic energy against the
#' work of the torque (and of what changes the inertia) less what the resistance took. Momentum: the
#' change of angular momentum against the impulses of both. Work, heat and impulses are computed by
#' themselves (in closed form, or with the integration), never as what is missing, so a residual
#' means something; each comes with what rounding and the stated error could explain, and a verdict.
#' \deqn{\Delta\left(\tfrac12 I \omega^2\right) = \int \tau\,\omega\,dt - Q, \quad
#'   \Delta(I \omega) = \int (\tau + \tau_r)\,dt}{
#'   change of I omega^2/2 = int tau omega dt - Q,  change of I omega = int (tau + tau_r) dt}
#' with the heat Q and the torque \eqn{\tau_r}{tau_r} of the resistance.
#'
#' The changes are taken from the rows as they stand: edit a value, and the audit says so. When rows
#' were dropped, the balance runs over the rows that are left. Where [choose_model()] left an effect
#' out, the balance is that of the motion without it.
#'
#' @param x A `rot_trajectory`.
#' @param ... Not used.
#' @return A `rot_audit`: a tibble of one row with the columns `r describe_columns(audit_columns)`
#'   Without rows all numbers are NA. The verdict is NA where a balance cannot be drawn: no rows, or
#'   energies beyond double precision.
#' @section Errors: `rotdyn_error_type` for what has no audit (a table that lost its columns is no
#'   trajectory); `rotdyn_error_time` for a missing time.
#' @examples
#' audit(spin_up())
#' @export
audit <- function(x, ...) {
  UseMethod("audit")
}

#' @export
audit.default <- function(x, ...) {
  check_class(
    x, "rot_trajectory", "x", "{.fn trajectory} gives one.", rlang::caller_env()
  )
}

#' @export
audit.rot_trajectory <- function(x, ...) {
  call <- rlang::current_env()
  check_no_dots(...)
  run <- trajectory_run(x)
  n <- nrow(x)
  if (n == 0L) {
    empty <- stats::setNames(rep(list(NA_real_), length(audit_columns)), audit_columns)
    empty$verdict <- NA_character_
    return(tibble::new_tibble(empty, nrow = 1L, class = "rot_audit"))
  }
  check_rows(x, call)
  scene <- run$solved
  t <- as.double(x$time_s[c(1L, n)])
  ledger <- run$ledger
  if (is.null(ledger)) {
    ledger <- record_of(run)$ledger(scene, c(run, call = call), min(t), max(t))
    if (t[2] < t[1]) {
      ledger[-(4:6)] <- -ledger[-(4:6)] # rows turned round: the balance runs backwards
    }
  }
  ledger <- unname(ledger)
  inertia <- if (is.null(scene$inertia)) {
    rep(scene$moment_of_inertia_kg_m2, 2L)
  } else {
    inertia_at(scene$inertia, t)
  }
  omega <- x$omega_rad_per_s[c(1L, n)]
  theta <- x$theta_rad[c(1L, n)]
  linear <- !any(c("quadratic", "friction") %in% scene$effects)
  damping <- if (linear) -viscous_of(scene) * (theta[2] - theta[1]) else ledger[10]

  # K1 - K0 as a product, so that a small change of a large energy keeps its digits.
  kinetic <- if (inertia[1] == inertia[2]) {
    0.5 * inertia[1] * (omega[2] - omega[1]) * (omega[2] + omega[1])
  } else {
    0.5 * (inertia[2] * omega[2]^2 - inertia[1] * omega[1]^2)
  }
  momentum <- inertia[2] * omega[2] - inertia[1] * omega[1]
  if (inertia[1] == inertia[2]) momentum <- inertia[1] * (omega[2] - omega[1])
  energy_residual <- (kinetic - ledger[1] - ledger[11]) + ledger[2]
  momentum_residual <- (momentum - ledger[3]) - damping

  eps <- .Machine$double.eps
  omega_error <- run$info$errors[["omega"]] + eps * abs(omega)
  energy_rounding <- ledger[4] + ledger[5] + sum(inertia * abs(omega) * omega_error) +
    2 * eps * (abs(kinetic) + abs(ledger[1]) + abs(ledger[2]) + abs(ledger[11])) +
    if (is.null(scene$inertia)) 0 else 2 * eps * sum(inertia * omega^2)
  momentum_rounding <- ledger[6] + sum(inertia * omega_error) +
    abs(viscous_of(scene)) * sum(run$info$errors[["theta"]] + eps * abs(theta)) +
    2 * eps * (abs(momentum) + abs(ledger[3]) + abs(damping))
  balanced <- abs(energy_residual) <= energy_rounding &&
    abs(momentum_residual) <= momentum_rounding
  tibble::new_tibble(list(
    work_j = ledger[1],
    dissipated_j = ledger[2],
    dissipated_viscous_j = ledger[7],
    dissipated_quadratic_j = ledger[8],
    dissipated_coulomb_j = ledger[9],
    inertia_work_j = ledger[11],
    kinetic_energy_change_j = kinetic,
    energy_residual_j = energy_residual,
    energy_rounding_j = energy_rounding,
    torque_impulse_n_m_s = ledger[3],
    damping_impulse_n_m_s = damping,
    angular_momentum_change_kg_m2_per_s = momentum,
    momentum_residual_kg_m2_per_s = momentum_residual,
    momentum_rounding_kg_m2_per_s = momentum_rounding,
    verdict = if (is.na(balanced)) NA_character_ else if (balanced) "balanced" else "unbalanced"
  ), nrow = 1L, class = "rot_audit")
}

#' @export
print.rot_audit <- function(x, ...) {
  if (!all(audit_columns %in% names(x)) || nrow(x) != 1L) {
    return(NextMethod())
  }
  line <- function(text, value, unit) {
    cat(sprintf("  %-34s %24s %s\n", text, format(value, digits = 15), unit))
  }
  cat("<rot_audit> ", x$verdict, "\n", sep = "")
  line("work of the torque", x$work_j, "J")
  line("- dissipated", x$dissipated_j, "J")
  parts <- c(
    viscous = x$dissipated_viscous_j, quadratic = x$dissipated_quadratic_j,
    `dry friction` = x$dissipated_coulomb_j
  )
  parts <- parts[!is.na(parts) & parts != 0]
  if (length(parts) > 1L) {
    for (name in names(parts)) line(paste("    of it", name), parts[[name]], "J")
  }
  if (!is.na(x$inertia_work_j) && x$inertia_work_j != 0) {
    line("+ work of what changes the inertia", x$inertia_work_j, "J")
  }
  line("= change of kinetic energy", x$kinetic_energy_change_j, "J")
  line("  residual", signif(x$energy_residual_j, 2), "J")
  line("  explained by rounding and error", signif(x$energy_rounding_j, 2), "J")
  line("impulse of the torque", x$torque_impulse_n_m_s, "N m s")
  line("+ impulse of the damping", x$damping_impulse_n_m_s, "N m s")
  line("= change of angular momentum", x$angular_momentum_change_kg_m2_per_s, "kg m^2/s")
  line("  residual", signif(x$momentum_residual_kg_m2_per_s, 2), "kg m^2/s")
  line("  explained by rounding and error", signif(x$momentum_rounding_kg_m2_per_s, 2), "kg m^2/s")
  invisible(x)
}
