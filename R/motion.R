# What scenes of several bodies return: a tibble with one attribute, `run`, as a trajectory has, and
# the names of its key columns.
new_motion <- function(columns, n, run) {
  attr(columns, "run") <- run
  class(columns) <- c("rot_motion", "tbl_df", "tbl", "data.frame")
  attr(columns, "row.names") <- .set_row_names(n)
  columns
}

run_motion <- function(record, scene, time_s, accuracy, on_fail, call) {
  result <- record$run(scene, time_s, accuracy, Inf, call, TRUE)
  columns <- result[[1]]
  info <- result[[2]]
  each <- if (is.null(columns$rotor)) 1L else length(scene$moment_of_inertia_kg_m2)
  n <- length(time_s)
  if (info$kind != "none") {
    failed_run(info, n, on_fail, call)
    n <- info$rows_done
    columns <- lapply(columns, `[`, seq_len(n * each))
  } else if (n && !(info$error <= accuracy)) {
    warn_rotdyn(
      c(
        "The {record$error_kind} of the relative error is {format(info$error, digits = 2)}, more
         than the accuracy of {format(accuracy)} asked for.",
        i = "Stiff springs turn through many radians of phase, and large terms may cancel: the
             {record$error_kind} says how much is left."
      ),
      "accuracy",
      call
    )
  }
  new_motion(columns, n * each, list(
    scene = scene,
    model = record$id,
    accuracy = accuracy,
    error_kind = record$error_kind,
    info = info,
    events = result[[4]],
    key = if (each > 1L || !is.null(columns$rotor)) rotors_keys else clutch_keys
  ))
}

# ---- the class ----------------------------------------------------------------------------------

# As for a trajectory: the class stands while the key columns do; of values that the run did not
# compute nothing is known.
reconstruct_motion <- function(data, template) {
  run <- attr(template, "run", exact = TRUE)
  tibble_class <- c("tbl_df", "tbl", "data.frame")
  if (is.null(run) || !all(run$key %in% names(data))) {
    attr(data, "run") <- NULL
    class(data) <- tibble_class
    return(data)
  }
  now <- unclass(data)[run$key]
  before <- unclass(template)[run$key]
  if (!identical(now, before)) {
    label <- function(x) paste(x$time_s, x$rotor)
    rows <- match(label(now), label(before))
    if (anyNA(rows) || !identical(now, lapply(before, `[`, rows))) run$info$error <- NA_real_
  }
  attr(data, "run") <- run
  class(data) <- c("rot_motion", tibble_class)
  data
}

#' @export
`[.rot_motion` <- function(x, ...) {
  out <- NextMethod()
  if (is.data.frame(out)) reconstruct_motion(out, x) else out
}

#' @export
`[<-.rot_motion` <- function(x, ..., value) reconstruct_motion(NextMethod(), x)

#' @export
`[[<-.rot_motion` <- function(x, ..., value) reconstruct_motion(NextMethod(), x)

#' @export
`$<-.rot_motion` <- function(x, name, value) reconstruct_motion(NextMethod(), x)

#' @export
`names<-.rot_motion` <- function(x, value) reconstruct_motion(NextMethod(), x)

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_motion <- function(data, template) reconstruct_motion(data, template)

#' @export
as_tibble.rot_motion <- function(x, ...) {
  attr(x, "run") <- NULL
  class(x) <- setdiff(class(x), "rot_motion")
  tibble::as_tibble(x, ...)
}

#' @export
tbl_sum.rot_motion <- function(x, ...) {
  run <- attr(x, "run", exact = TRUE)
  events <- run$events
  c(
    "A rotdyn motion" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)),
    "Model" = paste0(run$model, ", accuracy asked ", format(run$accuracy)),
    "Error" = describe_error(run),
    if (!is.null(events) && nrow(events)) {
      first <- seq_len(min(4L, nrow(events)))
      shown <- paste(events$event[first], "at", format_si(events$time_s[first]), "s")
      c("Events" = paste0(paste(shown, collapse = ", "), if (nrow(events) > 4L) ", ..."))
    }
  )
}

#' @rdname predict.rot_trajectory
#' @export
predict.rot_motion <- function(object, time_s, ...) {
  call <- rlang::current_env()
  if (missing(time_s)) {
    check_supplied("time_s", call)
  }
  check_no_dots(...)
  run <- attr(object, "run", exact = TRUE)
  scene <- run$scene
  time_s <- check_column(time_s, "time_s", "s", call)
  known <- which(!is.na(time_s))
  sorted <- known[order(time_s[known])]
  times <- check_times(time_s[sorted], call)
  # How rigid a shaft may be taken depends on the times: the choice is made anew.
  fit <- pick_model(scene, times, run$accuracy, NULL, call)
  rows <- tibble::as_tibble(run_motion(fit$record, scene, times, run$accuracy, "abort", call))
  each <- if (is.null(rows[["rotor"]])) 1L else length(scene$moment_of_inertia_kg_m2)
  from <- rep(NA_integer_, length(time_s))
  from[sorted] <- seq_along(sorted)
  out <- rows[as.vector(outer(seq_len(each) - each, each * from, `+`)), ]
  if (!is.null(out[["rotor"]])) out$rotor <- rep.int(seq_len(each), length(time_s))
  out
}

# ---- audit --------------------------------------------------------------------------------------

#' Audit a motion of several bodies
#'
#' [audit()] of the trajectory of a [scene_rotors()] or a [scene_clutch()]: two balances from the
#' first time to the last, the changes taken from the rows as they stand. Energy: the change of
#' kinetic and elastic energy against the work of the torques less the heat of dampers, bearings or
#' clutch. Momentum: the change of the total angular momentum against the impulses from outside;
#' what acts between the bodies has no part in it.
#'
#' Work and heat of rotors are computed by themselves; the heat of a clutch is its column.
#'
#' @param x A `rot_motion`.
#' @param ... Not used.
#' @return A `rot_audit`: a tibble of one row with the columns
#'   `r describe_columns(motion_audit_columns)`
#'   The verdict is NA where a balance cannot be drawn: no rows, or rotors missing from them.
#' @examples
#' scene <- scene_rotors(c(1, 2), 1000, 0.5, torque_n_m = c(3, 0))
#' audit(trajectory(scene, time_s = seq(0, 1, by = 0.1)))
#' @export
audit.rot_motion <- function(x, ...) {
  check_no_dots(...)
  run <- attr(x, "run", exact = TRUE)
  check_rows(x, rlang::current_env(), run$key)
  balance <- if (inherits(run$scene, "rot_scene_rotors")) balance_rotors else balance_clutch
  values <- if (nrow(x)) balance(x, run)
  if (is.null(values)) {
    values <- stats::setNames(rep(list(NA_real_), length(motion_audit_columns)),
                              motion_audit_columns)
    values$verdict <- NA_character_
    return(tibble::new_tibble(values, nrow = 1L, class = c("rot_audit_motion", "rot_audit")))
  }
  energy <- (values$kinetic + values$elastic - values$work) + values$heat
  momentum <- (values$momentum - values$impulse) - values$damping
  balanced <- abs(energy) <= values$energy_rounding && abs(momentum) <= values$momentum_rounding
  tibble::new_tibble(list(
    work_j = values$work,
    dissipated_j = values$heat,
    kinetic_energy_change_j = values$kinetic,
    elastic_energy_change_j = values$elastic,
    energy_residual_j = energy,
    energy_rounding_j = values$energy_rounding,
    torque_impulse_n_m_s = values$impulse,
    damping_impulse_n_m_s = values$damping,
    angular_momentum_change_kg_m2_per_s = values$momentum,
    momentum_residual_kg_m2_per_s = momentum,
    momentum_rounding_kg_m2_per_s = values$momentum_rounding,
    verdict = if (is.na(balanced)) NA_character_ else if (balanced) "balanced" else "unbalanced"
  ), nrow = 1L, class = c("rot_audit_motion", "rot_audit"))
}

# Terms of both balances from the rows of the first and the last time; NULL where rotors miss.
balance_rotors <- function(x, run) {
  scene <- run$scene
  inertia <- scene$moment_of_inertia_kg_m2
  n <- length(inertia)
  span <- range(x$time_s)
  state <- function(time) {
    rows <- which(x$time_s == time)
    rows <- rows[match(seq_len(n), x$rotor[rows])]
    if (anyNA(rows)) NULL else list(
      theta = x$theta_rad[rows], omega = x$omega_rad_per_s[rows],
      shaft = x$shaft_torque_n_m[rows][-n]
    )
  }
  from <- state(span[1])
  to <- state(span[2])
  if (is.null(from) || is.null(to)) {
    return(NULL)
  }
  record <- if (run$model == "rotors_rigid") rotors_rigid else rotors_modal
  ledger <- unname(record$ledger(scene, run, span[1], span[2]))
  eps <- .Machine$double.eps
  error <- run$info$errors[["omega"]] + eps * max(abs(c(from$omega, to$omega)))
  rate <- c(from$omega, to$omega)
  twist <- elastic_energy(scene, from, to, record)
  # An error of omega goes with one of the same energy norm in the twists.
  rounding <- ledger[3] + ledger[4] + sum(inertia * abs(rate)) * error +
    sqrt(2 * sum(inertia)) * twist$root * error + twist$rounding +
    4 * eps * (abs(ledger[1]) + ledger[2])
  moved <- to$theta - from$theta
  momentum <- sum(inertia * (to$omega - from$omega))
  impulse <- sum(scene$torque_n_m) * diff(span)
  turned_error <- 2 * run$info$errors[["theta"]] +
    eps * max(abs(c(from$theta, to$theta)))
  list(
    work = ledger[1],
    heat = ledger[2],
    kinetic = sum(0.5 * inertia * (to$omega - from$omega) * (to$omega + from$omega)),
    elastic = twist$change,
    energy_rounding = rounding,
    momentum = momentum,
    impulse = impulse,
    damping = -sum(scene$viscous_n_m_s * moved),
    momentum_rounding = 2 * sum(inertia) * error + sum(scene$viscous_n_m_s) * turned_error +
      4 * eps * (n * sum(inertia * abs(rate)) + sum(abs(scene$torque_n_m)) * diff(span))
  )
}

# From the shaft's torque: the difference of two angles would have lost the twist of a stiff shaft.
# The rigid shaft has none.
elastic_energy <- function(scene, from, to, record) {
  k <- scene$stiffness_n_m_per_rad
  if (record$id == "rotors_rigid" || all(k == 0)) {
    return(list(change = 0, root = 0, rounding = 0))
  }
  damped <- function(state) scene$damping_n_m_s * -diff(state$omega)
  spring <- function(state) (state$shaft - damped(state))[k > 0]
  size <- function(state) {
    (abs(state$shaft) + scene$damping_n_m_s * max(abs(state$omega)))[k > 0]
  }
  k_used <- k[k > 0]
  before <- spring(from)
  after <- spring(to)
  list(
    change = sum(0.5 * (after - before) * (after + before) / k_used),
    root = sqrt(sum(before^2 / k_used)) + sqrt(sum(after^2 / k_used)),
    rounding = 8 * .Machine$double.eps *
      sum((abs(before) * size(from) + abs(after) * size(to)) / k_used)
  )
}

balance_clutch <- function(x, run) {
  scene <- run$scene
  inertia <- scene$moment_of_inertia_kg_m2
  rows <- c(which.min(x$time_s), which.max(x$time_s))
  if (rows[1] == rows[2]) rows[2] <- rows[1]
  time <- x$time_s[rows]
  omega <- rbind(x$omega_1_rad_per_s[rows], x$omega_2_rad_per_s[rows])
  ledger <- unname(clutch_exact$ledger(scene, run, time[1], time[2]))
  eps <- .Machine$double.eps
  error <- run$info$errors[["omega"]] + eps * max(abs(omega))
  heat <- x$heat_j[rows[2]] - x$heat_j[rows[1]]
  impulses <- vapply(scene$steps, steps_impulse, double(2), time[1], time[2])
  list(
    work = ledger[1],
    heat = heat,
    kinetic = sum(0.5 * inertia * (omega[, 2] - omega[, 1]) * (omega[, 2] + omega[, 1])),
    elastic = 0,
    energy_rounding = ledger[2] + sum(inertia * abs(omega)) * error +
      16 * eps * abs(x$heat_j[rows[2]]) +
      4 * scene$static_capacity_n_m * run$info$errors[["theta"]] +
      4 * eps * (abs(ledger[1]) + heat),
    momentum = sum(inertia * (omega[, 2] - omega[, 1])),
    impulse = sum(impulses[1, ]),
    damping = 0,
    momentum_rounding = 2 * sum(inertia) * error + 8 * eps * sum(impulses[2, ]) +
      4 * eps * sum(inertia * abs(omega))
  )
}

# Time integral of a stepped torque, and of its absolute value.
steps_impulse <- function(steps, from_s, to_s) {
  ends <- pmin(pmax(c(from_s, steps[[1]], to_s), from_s), to_s)
  parts <- steps[[2]] * diff(ends)
  c(sum(parts), sum(abs(parts)))
}

#' @export
print.rot_audit_motion <- function(x, ...) {
  if (!all(motion_audit_columns %in% names(x)) || nrow(x) != 1L) {
    return(NextMethod())
  }
  line <- function(text, value, unit) {
    cat(sprintf("  %-34s %24s %s\n", text, format(value, digits = 15), unit))
  }
  cat("<rot_audit> ", x$verdict, "\n", sep = "")
  line("work of the torques", x$work_j, "J")
  line("- dissipated", x$dissipated_j, "J")
  line("= change of kinetic energy", x$kinetic_energy_change_j, "J")
  line("+ change of elastic energy", x$elastic_energy_change_j, "J")
  line("  residual", signif(x$energy_residual_j, 2), "J")
  line("  explained by rounding and error", signif(x$energy_rounding_j, 2), "J")
  line("impulse of the torques", x$torque_impulse_n_m_s, "N m s")
  line("+ impulse of the bearings", x$damping_impulse_n_m_s, "N m s")
  line("= change of angular momentum", x$angular_momentum_change_kg_m2_per_s, "kg m^2/s")
  line("  residual", signif(x$momentum_residual_kg_m2_per_s, 2), "kg m^2/s")
  line("  explained by rounding and error", signif(x$momentum_rounding_kg_m2_per_s, 2), "kg m^2/s")
  invisible(x)
}
