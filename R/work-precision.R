#' What accuracy costs: models measured side by side
#'
#' Runs a scene with every model that fits it, at every accuracy, and measures: what the run cost,
#' how far it is from the truth, and whether it said so. Peers, functions of your own, are measured
#' in the same way.
#'
#' **The truth** is a closed form where one fits, else the integrator at the least accuracy it
#' promises, or what you give as `reference`. A reference has an error too, `reference_error`. A
#' true error below three times that cannot be told: it is set to that value and marked `floor`.
#'
#' **The cost** is processor time, which other work on the machine does not count into. A run is
#' repeated until a batch takes `least_batch_s`; the first batch is thrown away. Everything counts
#' that a call of [trajectory()] does. `rhs_calls` does not depend on the machine.
#'
#' @inheritParams trajectory
#' @param time_s Output times in s, at least one.
#' @param models Names of [models()], or NULL for every one that fits.
#' @param accuracies Accuracies to ask for, numbers in (0, 1].
#' @param ... Not used; names after it must be given in full.
#' @param peers A named list of functions of `scene`, `time_s` and `accuracy`. Each returns a list
#'   with `theta_rad` and `omega_rad_per_s`, one number for each time, and may add `rhs_calls`,
#'   `steps` and `error` (relative, what it says of itself).
#' @param reference NULL; or a `rot_trajectory` of the same times; or a list with `theta_rad`,
#'   `omega_rad_per_s` and their relative `error`.
#' @param least_batch_s Least processor time of a batch in s.
#' @param batches Batches that count.
#' @return A `rot_work_precision`, with an `autoplot()`: a tibble with a row for each model or peer
#'   and accuracy, and the columns `r describe_columns(work_precision_columns)`
#'   A model that does not promise an accuracy has no row for it. `covered` is NA where the error of
#'   the reference decides, and for a peer that reports no error.
#' @section Warnings: What a run warns of, once. `rotdyn_warning_failed` names the runs that failed:
#'   they have no row.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_time`, `rotdyn_error_model` for an unknown model, `rotdyn_error_accuracy` if
#'   nothing can serve as reference.
#' @seealso [choose_model()] predicts what this function measures.
#' @source Work-precision diagrams as in Hairer, Norsett and Wanner, Solving Ordinary Differential
#'   Equations I, 2nd ed. (1993), section II.10.
#' @examples
#' scene <- scene_axle(body_disk(2, 0.25), torque_constant(0.8), resistance(0.03))
#' work_precision(scene, 0:8, accuracies = c(1e-3, 1e-9), least_batch_s = 0.002)
#' @export
work_precision <- function(scene, time_s, models = NULL, accuracies = 10^-c(3, 6, 9, 12), ...,
                           peers = list(), reference = NULL, least_batch_s = 0.02, batches = 5) {
  call <- rlang::current_env()
  check_supplied(c("scene", "time_s"), call)
  check_no_dots(...)
  check_scene(scene, call)
  time_s <- check_times(time_s, call)
  if (length(time_s) == 0L) {
    abort_rotdyn("{.arg time_s} must have one time at least.", "size", call)
  }
  accuracies <- check_finite(accuracies, "accuracies", "1", call)
  for (accuracy in accuracies) {
    check_number(accuracy, "accuracies", "1", call, lower = 0, upper = 1, open = TRUE)
  }
  check_peers(peers, call)
  least_batch_s <- check_number(least_batch_s, "least_batch_s", "s", call, lower = 0)
  batches <- floor(check_number(batches, "batches", "1", call, lower = 1))
  contestants <- list_contestants(scene, time_s, models, accuracies, peers, call)

  heard <- new.env()
  truth <- hear_warnings(find_reference(scene, time_s, reference, call), heard)
  n <- nrow(contestants)
  rows <- vector("list", n)
  failed <- character()
  bar <- cli::cli_progress_bar("measuring", total = n)
  for (i in seq_len(n)) {
    one <- contestants[i, ]
    rows[[i]] <- tryCatch(
      hear_warnings(measure_one(one, scene, time_s, peers, truth, least_batch_s, batches), heard),
      rotdyn_error = function(e) {
        why <- strsplit(cli::ansi_strip(conditionMessage(e)), "\n", fixed = TRUE)[[1]][1]
        failed <<- c(failed, paste0(one$model, " at ", format(one$accuracy), ": ", why))
        NULL
      }
    )
    cli::cli_progress_update(id = bar)
  }
  cli::cli_progress_done(id = bar)
  tell_warnings(heard, failed, call)
  new_work_precision(rows, truth, scene, time_s, least_batch_s, batches)
}

check_peers <- function(peers, call) {
  named <- length(peers) == 0L || (!is.null(names(peers)) && all(nzchar(names(peers))) &&
    !anyDuplicated(names(peers)))
  if (!is.list(peers) || !named || !all(vapply(peers, is.function, logical(1)))) {
    abort_rotdyn(
      c(
        "{.arg peers} must be a list of functions, each with a name of its own.",
        x = "It is {describe_value(peers)}."
      ),
      "type",
      call
    )
  }
}

# ---- who takes part -----------------------------------------------------------------------------

# Models that fit at an accuracy, cheapest first, as a choice has them; none if nothing reaches it.
models_that_fit <- function(scene, time_s, accuracy) {
  choice <- tryCatch(
    choose_model(scene, time_s, accuracy), rotdyn_error_accuracy = function(e) NULL
  )
  if (is.null(choice)) choice else choice[choice$applies, ]
}

# A row for each contestant and accuracy: model, error_kind, accuracy, peer.
list_contestants <- function(scene, time_s, models, accuracies, peers, call) {
  known <- tryCatch(choose_model(scene, time_s, 1), rotdyn_error = function(e) {
    e$call <- rlang::error_call(call)
    rlang::cnd_signal(e)
  })$model
  if (!is.null(models) && !(is.character(models) && all(models %in% known))) {
    abort_rotdyn(
      c(
        "{.arg models} must be NULL or some of {.val {known}}.",
        x = "It is {if (is.character(models)) cli::cli_vec(models) else describe_value(models)}."
      ),
      "model",
      call
    )
  }
  each <- lapply(accuracies, function(accuracy) {
    fit <- models_that_fit(scene, time_s, accuracy)
    wanted <- if (is.null(models)) fit$model else intersect(models, fit$model)
    data.frame(
      model = c(wanted, names(peers)),
      error_kind = c(fit$error_kind[match(wanted, fit$model)], rep(NA_character_, length(peers))),
      accuracy = rep(accuracy, length(wanted) + length(peers)),
      peer = rep(c(FALSE, TRUE), c(length(wanted), length(peers)))
    )
  })
  all <- do.call(rbind, c(each, list(data.frame(
    model = character(), error_kind = character(), accuracy = double(), peer = logical()
  ))))
  order <- unique(all$model[order(all$peer)])
  all[order(match(all$model, order)), ]
}

method_of <- function(model, error_kind, peer) {
  if (peer) {
    "peer"
  } else if (error_kind == "bound") {
    "closed form"
  } else {
    sub("^[^_]*_", "", model)
  }
}

# ---- the truth ----------------------------------------------------------------------------------

# list(name, theta, omega, theta_max, omega_max, error): the values, their sizes, what they are
# good for. Rows are doubles, so none is better than half a unit of the last place.
new_truth <- function(name, theta, omega, theta_max, omega_max, error) {
  list(
    name = name, theta = theta, omega = omega, theta_max = theta_max, omega_max = omega_max,
    error = max(error, .Machine$double.eps / 2)
  )
}

truth_of_run <- function(motion) {
  run <- trajectory_run(motion)
  new_truth(
    run$model, motion$theta_rad, motion$omega_rad_per_s, run$info$sizes[["theta"]],
    run$info$sizes[["omega"]],
    run$info$error
  )
}

find_reference <- function(scene, time_s, reference, call) {
  if (!is.null(reference)) {
    return(given_reference(scene, time_s, reference, call))
  }
  # A closed form first, and among equals the one that claims less error; then the cheapest
  # integrator. At the least accuracies they know.
  for (kind in c("bound", "estimate")) {
    for (accuracy in 10^-(15:6)) {
      fit <- models_that_fit(scene, time_s, accuracy)
      for (model in fit$model[fit$error_kind == kind]) {
        motion <- tryCatch(
          trajectory(scene, time_s, accuracy, model), rotdyn_error = function(e) NULL
        )
        if (!is.null(motion)) {
          return(truth_of_run(motion))
        }
      }
    }
  }
  abort_rotdyn(
    c(
      "No model can serve as reference for this scene: every run failed.",
      i = "{.fn trajectory} says why; {.arg reference} takes values of your own."
    ),
    "accuracy",
    call
  )
}

given_reference <- function(scene, time_s, reference, call) {
  if (inherits(reference, "rot_trajectory")) {
    if (!identical(as.double(reference$time_s), time_s)) {
      abort_rotdyn("The {.arg reference} must have the same times.", "size", call)
    }
    truth <- truth_of_run(reference)
    if (!is.finite(truth$error)) {
      abort_rotdyn("The error of the {.arg reference} is not known.", "value", call)
    }
    return(truth)
  }
  wanted <- c("theta_rad", "omega_rad_per_s", "error")
  if (!is.list(reference) || !all(wanted %in% names(reference))) {
    abort_rotdyn(
      c(
        "{.arg reference} must be NULL, a {.cls rot_trajectory}, or a list with {.field {wanted}}.",
        x = "It is {describe_value(reference)}."
      ),
      "type",
      call
    )
  }
  theta <- check_finite(reference[["theta_rad"]], "reference$theta_rad", "rad", call)
  omega <- check_finite(reference[["omega_rad_per_s"]], "reference$omega_rad_per_s", "rad/s", call)
  if (length(theta) != length(time_s) || length(omega) != length(time_s)) {
    abort_rotdyn("The {.arg reference} must have a row for each time.", "size", call)
  }
  new_truth(
    "given", theta, omega, max(abs(c(theta, scene$theta0_rad))),
    max(abs(c(omega, scene$omega0_rad_per_s))),
    check_number(reference[["error"]], "reference$error", "1", call, lower = 0, upper = 1)
  )
}

# Largest difference relative to the largest value on the way.
distance_to <- function(got, want, largest) {
  if (anyNA(got)) {
    return(NA_real_)
  }
  difference <- max(abs(got - want))
  if (difference == 0) 0 else if (largest > 0) difference / largest else 1
}

# ---- one contestant -----------------------------------------------------------------------------

measure_one <- function(one, scene, time_s, peers, truth, least_batch_s, batches) {
  accuracy <- one$accuracy
  if (one$peer) {
    f <- peers[[one$model]]
    go <- function() f(scene, time_s, accuracy)
    said <- peer_report(try_peer(go, one$model), one$model, length(time_s))
  } else {
    model <- one$model
    go <- function() trajectory(scene, time_s, accuracy, model)
    said <- model_report(go())
  }
  raw <- c(
    distance_to(said$theta, truth$theta, truth$theta_max),
    distance_to(said$omega, truth$omega, truth$omega_max)
  )
  floor <- 3 * truth$error
  error <- pmax(raw, floor)
  cost <- measure_cost(go, least_batch_s, batches)
  list(
    model = one$model,
    method = method_of(one$model, one$error_kind, one$peer),
    accuracy = accuracy,
    theta_error = error[1],
    omega_error = error[2],
    true_error = max(error),
    floor = max(raw) < floor,
    error = said$error,
    error_kind = one$error_kind,
    covered = is_covered(max(raw), said$error, truth$error),
    cost_s = min(cost),
    cost_median_s = stats::median(cost),
    rhs_calls = said$rhs_calls,
    steps = said$steps,
    rejected = said$rejected,
    energy_residual = said$energy_residual,
    reference = truth$name,
    reference_error = truth$error
  )
}

# The true error lies within the reference's own of what was found; NA where that decides.
is_covered <- function(found, said, reference) {
  if (is.na(found) || is.na(said)) {
    NA
  } else if (found + reference <= said) {
    TRUE
  } else if (found - reference > said) {
    FALSE
  } else {
    NA
  }
}

model_report <- function(motion) {
  info <- trajectory_run(motion)$info
  balance <- audit(motion)
  largest <- max(
    abs(balance$work_j), abs(balance$dissipated_j), motion$rotational_kinetic_energy_j
  )
  residual <- abs(balance$energy_residual_j)
  list(
    theta = motion$theta_rad, omega = motion$omega_rad_per_s, error = info$error,
    rhs_calls = as.double(info$rhs_calls), steps = as.double(info$steps),
    rejected = as.double(info$rejected),
    energy_residual = if (residual %in% 0) 0 else residual / largest
  )
}

# An error of a peer's own is a failed run, not the end of the measurement.
try_peer <- function(go, name) {
  tryCatch(go(), error = function(e) {
    text <- conditionMessage(e)
    abort_rotdyn("The peer {.val {name}} failed: {text}", "peer", NULL)
  })
}

peer_report <- function(value, name, rows) {
  ok <- is.list(value) && is.numeric(value[["theta_rad"]]) &&
    is.numeric(value[["omega_rad_per_s"]]) && length(value[["theta_rad"]]) == rows &&
    length(value[["omega_rad_per_s"]]) == rows
  if (!ok) {
    abort_rotdyn(
      "The peer {.val {name}} must return a list with {.field theta_rad} and
       {.field omega_rad_per_s}, one number for each time.",
      "peer",
      NULL
    )
  }
  number <- function(field) if (is.null(value[[field]])) NA_real_ else as.double(value[[field]])
  list(
    theta = as.double(value[["theta_rad"]]), omega = as.double(value[["omega_rad_per_s"]]),
    error = number("error"), rhs_calls = number("rhs_calls"), steps = number("steps"),
    rejected = number("rejected"), energy_residual = NA_real_
  )
}

# Processor time of one call of go(), a number for each batch. The batch grows until it takes long
# enough for the clock; the first one of full size is thrown away.
measure_cost <- function(go, least_batch_s, batches) {
  repeats <- 1
  batch <- function() {
    start <- .Call(ffi_clock_cpu)
    for (i in seq_len(repeats)) go()
    .Call(ffi_clock_cpu) - start
  }
  # Where there is no clock the costs are NaN.
  while (isTRUE((took <- batch()) < least_batch_s)) {
    grow <- if (took > 0) 1.2 * least_batch_s / took else 10
    repeats <- ceiling(repeats * min(10, max(1.5, grow)))
  }
  vapply(seq_len(batches), function(i) batch() / repeats, double(1))
}

# ---- warnings -----------------------------------------------------------------------------------

# The same run is made many times: what it warns of is kept, once, and told in the end; not that an
# accuracy was missed, which the table says.
hear_warnings <- function(expr, heard) {
  withCallingHandlers(expr, rotdyn_warning = function(w) {
    if (!inherits(w, "rotdyn_warning_accuracy")) {
      assign(conditionMessage(w), w, envir = heard)
    }
    rlang::cnd_muffle(w)
  })
}

tell_warnings <- function(heard, failed, call) {
  for (text in ls(heard)) {
    warning(get(text, envir = heard))
  }
  if (length(failed)) {
    lines <- paste0("{failed[", seq_along(failed), "]}") # their text is no template
    warn_rotdyn(
      c("{length(failed)} run{?s} failed and {?has/have} no row.", rlang::set_names(lines, "x")),
      "failed",
      call
    )
  }
}

# ---- the class ----------------------------------------------------------------------------------

new_work_precision <- function(rows, truth, scene, time_s, least_batch_s, batches) {
  rows <- Filter(Negate(is.null), rows)
  empty <- list(
    model = character(), method = character(), floor = logical(), error_kind = character(),
    covered = logical(), reference = character()
  )
  columns <- lapply(work_precision_columns, function(name) {
    unlist(c(list(empty[[name]] %||% double()), lapply(rows, `[[`, name)), use.names = FALSE)
  })
  names(columns) <- work_precision_columns
  tibble::new_tibble(
    columns, nrow = length(rows), class = "rot_work_precision",
    measured = list(
      reference = truth$name,
      reference_error = truth$error,
      rows = length(time_s),
      torque = if (inherits(scene$torque, "rot_torque_function")) "an R function" else "in C",
      batches = batches,
      least_batch_s = least_batch_s,
      machine = paste0(R.version$platform, ", R ", getRversion())
    )
  )
}

#' @importFrom tibble tbl_sum
#' @export
tbl_sum.rot_work_precision <- function(x, ...) {
  how <- attr(x, "measured", exact = TRUE)
  size <- c("Work and precision" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)))
  if (is.null(how)) {
    return(size)
  }
  c(
    size,
    "Reference" = paste0(how$reference, ", error ", format(how$reference_error, digits = 2)),
    "Cost" = paste0(
      "processor time of ", format(how$rows, big.mark = ","), " rows, ", how$batches,
      " batches of ", format(1000 * how$least_batch_s), " ms, torque ", how$torque
    ),
    "Machine" = how$machine
  )
}
