#' What accuracy costs: models measured side by side
#'
#' Runs a scene with every model that fits it, at every accuracy, and measures the cost, the true
#' error, and whether the reported error covers it. Peers are functions of your own, measured in the
#' same way.
#'
#' **The reference** is a closed form where one fits, else the integrator at the least accuracy it
#' promises, or what you give as `reference`. It is never the run itself: a model that nothing else
#' can be compared with has the reference `"none"`, and its true error is NA. A reference has an
#' error too, `reference_error`. A true error below three times that is not resolved: it is set to
#' that value and marked `floor`.
#'
#' **The cost** is processor time of whole calls of [trajectory()], without other work of the
#' machine. A run is repeated until a batch takes `min_batch_s`; the first batch is discarded.
#' `rhs_calls` does not depend on the machine.
#'
#' @inheritParams trajectory
#' @param time_s Output times in s, at least one.
#' @param models Names of [models()], or NULL for every one that fits.
#' @param steps_s Lengths of steps in s, for models whose steps are of fixed length: those in
#'   `models`, or, where that is NULL, all that the scene has. Each length is a run. NULL: the
#'   models named in `models` run once, with the step that [trajectory()] takes.
#' @param accuracies Accuracies to ask for, numbers in (0, 1].
#' @param ... Not used; names after it must be given in full.
#' @param peers A named list of functions of `scene`, `time_s` and `accuracy`. Each returns a list
#'   with the columns of the scene's measures (on an axle `theta_rad` and `omega_rad_per_s`), one
#'   number for each time, and may add `rhs_calls`, `steps` and `error` (relative, its own figure).
#' @param reference NULL; or a `rot_trajectory` of the same times, also of another scene with these
#'   columns; or a list with the same columns and their relative `error`; or a function of the times
#'   that returns such a list (without `error`: 0).
#' @param min_batch_s Least processor time of a batch in s, at most 3600.
#' @param batches Batches that count, at most 10000.
#' @return A `rot_work_precision`, with an `autoplot()`: a tibble with a row for each model or peer
#'   and accuracy, and the columns `r describe_columns(work_precision_columns)`
#'   and `step_s` where steps of fixed length take part; their `accuracy` is NA. A model that does
#'   not promise an accuracy has no row for it. `covered` is NA where the error of
#'   the reference decides, and for a peer that reports no error.
#' @section Warnings: Those of the runs, once each. `rotdyn_warning_failed` names the runs that
#'   failed: they have no row.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_time`, `rotdyn_error_model` for an unknown model, `rotdyn_error_accuracy` if
#'   nothing can serve as reference.
#' @seealso [choose_model()] predicts what this function measures.
#' @source Work-precision diagrams as in Hairer, Norsett and Wanner, Solving Ordinary Differential
#'   Equations I, 2nd ed. (1993), section II.10.
#' @concept RK4
#' @concept Runge-Kutta
#' @concept benchmark
#' @concept cost of accuracy
#' @examples
#' scene <- scene_axle(body_disk(2, 0.25), torque_constant(0.8), resistance(0.03))
#' work_precision(scene, 0:8, accuracies = c(1e-3, 1e-9), min_batch_s = 0.002)
#' # A right-hand side and a method of one's own, beside Euler, semi-implicit Euler and Runge-Kutta
#' # of the package, and beside the closed form of the same pendulum.
#' alpha <- function(time_s, theta_rad, omega_rad_per_s) -9.80665 * sin(theta_rad)
#' mine <- scene_axle(1, alpha, theta0_rad = 1) # 1 kg m^2: the torque is the acceleration
#' my_euler <- function(scene, time_s, accuracy, step_s = 0.01) {
#'   t <- time_s[1]
#'   theta <- 1
#'   omega <- 0
#'   rows <- lapply(time_s, function(end) {
#'     while (t < end - step_s / 2) {
#'       slope <- alpha(t, theta, omega)
#'       theta <<- theta + step_s * omega
#'       omega <<- omega + step_s * slope
#'       t <<- t + step_s
#'     }
#'     c(theta, omega)
#'   })
#'   list(theta_rad = sapply(rows, `[`, 1), omega_rad_per_s = sapply(rows, `[`, 2))
#' }
#' exact <- scene_pendulum(body_point(1), 1, theta0_rad = 1)
#' work_precision(
#'   mine, 0:4, accuracies = 1e-9, steps_s = c(0.01, 0.001), peers = list(my_euler = my_euler),
#'   reference = trajectory(exact, 0:4), min_batch_s = 0.002, batches = 1
#' )
#' @export
work_precision <- function(scene, time_s, models = NULL, accuracies = 10^-c(3, 6, 9, 12), ...,
                           steps_s = NULL, peers = list(), reference = NULL, min_batch_s = 0.02,
                           batches = 5) {
  call <- current_env()
  check_supplied(c("scene", "time_s"), call)
  check_no_dots(...)
  check_scene(scene, call)
  time_s <- check_times(time_s, call)
  if (length(time_s) == 0L) abort_rotdyn("{.arg time_s} must have one time at least.", "size", call)
  constraint <- constraint_of(scene)
  accuracies <- check_finite(accuracies, "accuracies", "1", call)
  for (accuracy in accuracies) {
    check_number(accuracy, "accuracies", "1", call, lower = 0, upper = 1, open = TRUE)
  }
  check_peers(peers, call)
  min_batch_s <- check_number(min_batch_s, "min_batch_s", "s", call, lower = 0, upper = 3600)
  batches <- floor(check_number(batches, "batches", "1", call, lower = 1, upper = 1e4))
  check_known_models(models, scene, time_s, call)
  steps_s <- check_steps(steps_s, constraint, models, call)
  contestants <- rbind(
    list_contestants(scene, time_s, models, accuracies, peers, call),
    list_steppers(constraint, models, steps_s)
  )

  heard <- new.env()
  references <- hear_warnings(find_references(scene, time_s, reference, constraint, call), heard)
  n <- nrow(contestants)
  rows <- vector("list", n)
  failed <- character()
  bar <- cli::cli_progress_bar("measuring", total = n)
  for (i in seq_len(n)) {
    one <- contestants[i, ]
    rows[[i]] <- tryCatch(
      hear_warnings(
        measure_one(
          one, scene, time_s, constraint, peers, reference_for(references, one, constraint),
          min_batch_s, batches
        ),
        heard
      ),
      rotdyn_error = function(e) {
        why <- strsplit(cli::ansi_strip(conditionMessage(e)), "\n", fixed = TRUE)[[1]][1]
        failed <<- c(failed, paste0(one$model, " at ", asked_of(one), ": ", why))
        NULL
      }
    )
    cli::cli_progress_update(id = bar)
  }
  cli::cli_progress_done(id = bar)
  tell_warnings(heard, failed, call)
  new_work_precision(rows, constraint, scene, time_s, min_batch_s, batches)
}

check_peers <- function(peers, call) {
  named <- length(peers) == 0L || (!is.null(names(peers)) && all(nzchar(names(peers))) &&
    !anyDuplicated(names(peers)))
  if (!is.list(peers) || !named || !all(vapply(peers, is.function, logical(1)))) {
    abort_rotdyn(c(
      "{.arg peers} must be a list of functions, each with a name of its own.",
      x = "It is {describe_value(peers)}."
    ), "type", call)
  }
}

check_steps <- function(steps_s, constraint, models, call) {
  if (is.null(steps_s)) return(NULL)
  steps_s <- check_finite(steps_s, "steps_s", "s", call)
  for (step in steps_s) check_number(step, "steps_s", "s", call, lower = 0, open = TRUE)
  by_steps <- fixed_step_models(constraint)
  if (!length(if (is.null(models)) by_steps else intersect(models, by_steps))) {
    abort_no_steps(constraint, models %||% names(constraint$models), call, "steps_s")
  }
  steps_s
}

# ---- who takes part -----------------------------------------------------------------------------

# Models that fit at an accuracy, cheapest first, as a choice has them; none if nothing reaches it.
models_that_fit <- function(scene, time_s, accuracy) {
  choice <- tryCatch(
    choose_model(scene, time_s, accuracy), rotdyn_error_accuracy = function(e) NULL
  )
  if (is.null(choice)) choice else choice[choice$applies, ]
}

# A row for each model of fixed steps and each length; NA: that of trajectory().
list_steppers <- function(constraint, models, steps_s) {
  by_steps <- fixed_step_models(constraint)
  if (is.null(models) && is.null(steps_s)) by_steps <- character()
  if (!is.null(models)) by_steps <- intersect(models, by_steps)
  steps_s <- steps_s %||% NA_real_
  data.frame(
    model = rep(by_steps, each = length(steps_s)),
    error_kind = rep("estimate", length(by_steps) * length(steps_s)),
    accuracy = rep(NA_real_, length(by_steps) * length(steps_s)),
    step_s = rep(steps_s, length(by_steps)),
    peer = logical(length(by_steps) * length(steps_s))
  )
}

# What was asked of a contestant, in words.
asked_of <- function(one) {
  if (!is.na(one$accuracy)) format(one$accuracy) else paste(format(one$step_s), "s a step")
}

check_known_models <- function(models, scene, time_s, call) {
  known <- in_call(choose_model(scene, time_s, 1), call)$model
  if (!is.null(models) && !(is.character(models) && all(models %in% known))) {
    abort_rotdyn(c(
      "{.arg models} must be NULL or some of {.val {known}}.",
      x = "It is {if (is.character(models)) cli::cli_vec(models) else describe_value(models)}."
    ), "model", call)
  }
}

# A row for each contestant and accuracy: model, error_kind, accuracy, step_s (none), peer.
list_contestants <- function(scene, time_s, models, accuracies, peers, call) {
  each <- lapply(accuracies, function(accuracy) {
    fit <- models_that_fit(scene, time_s, accuracy)
    wanted <- if (is.null(models)) fit$model else intersect(models, fit$model)
    many <- length(wanted) + length(peers)
    data.frame(
      model = c(wanted, names(peers)),
      error_kind = c(fit$error_kind[match(wanted, fit$model)], rep(NA_character_, length(peers))),
      accuracy = rep(accuracy, many), step_s = rep(NA_real_, many),
      peer = rep(c(FALSE, TRUE), c(length(wanted), length(peers)))
    )
  })
  all <- do.call(rbind, c(each, list(data.frame(
    model = character(), error_kind = character(), accuracy = double(), step_s = double(),
    peer = logical()
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

# list(name, accuracy, columns, sizes, error): the columns of the measures, the sizes of these, and
# the relative error. Rows are doubles, so none is better than half a unit of the last place.
new_truth <- function(name, accuracy, columns, sizes, error) {
  list(
    name = name, accuracy = accuracy, columns = columns, sizes = sizes,
    error = max(error, .Machine$double.eps / 2)
  )
}

measure_columns <- function(constraint) {
  unique(unlist(lapply(constraint$measures, `[[`, "columns"), use.names = FALSE))
}

truth_of_run <- function(motion, constraint, time_s) {
  run <- trajectory_run(motion)
  columns <- columns_at(motion, measure_columns(constraint), constraint, time_s)
  sizes <- run$info$sizes
  known <- constraint_of(run$scene)$measures
  if (!identical(names(constraint$measures), names(known))) { # another scene's
    of_rows <- sizes_of(columns, constraint)
    sizes <- vapply(names(constraint$measures), function(name) {
      same <- vapply(known, function(m) identical(m$columns, constraint$measures[[name]]$columns),
                     NA)
      max(of_rows[[name]], sizes[names(known)[same]])
    }, double(1))
  }
  new_truth(run$model, run$accuracy, columns, sizes, run$info$error)
}

# The sizes of the measures of rows.
sizes_of <- function(columns, constraint) {
  vapply(constraint$measures, function(m) {
    zero <- lapply(columns[m$columns], function(x) 0 * x)
    largest(m$distance(do.call(cbind, columns[m$columns]), do.call(cbind, zero)))
  }, double(1))
}

# Columns of a trajectory without the rows that its events added.
columns_at <- function(motion, columns, constraint, time_s) {
  rows <- unclass(motion)[columns]
  if (is.null(constraint$event_rows)) return(rows)
  lapply(rows, `[`, match(time_s, motion$time_s))
}

# Up to two, so that no model is compared with itself: closed forms first, then the cheapest
# integrator, at the smallest accuracy that they reach.
find_references <- function(scene, time_s, reference, constraint, call) {
  if (!is.null(reference)) return(list(given_reference(scene, time_s, reference, constraint, call)))
  found <- list()
  for (kind in c("bound", "estimate")) {
    for (accuracy in 10^-(15:6)) {
      fit <- models_that_fit(scene, time_s, accuracy)
      wanted <- fit$model[fit$error_kind == kind]
      for (model in setdiff(wanted, vapply(found, `[[`, "", "name"))) {
        motion <- tryCatch(
          trajectory(scene, time_s, accuracy, model), rotdyn_error = function(e) NULL
        )
        if (is.null(motion)) next
        found[[length(found) + 1L]] <- truth_of_run(motion, constraint, time_s)
        if (length(found) == 2L) return(found)
      }
    }
  }
  if (length(found) == 0L) {
    abort_rotdyn(c(
      "No model can serve as reference for this scene: every run failed.",
      i = "{.fn trajectory} says why; {.arg reference} takes values of your own."
    ), "accuracy", call)
  }
  found
}

# The first that is another run than the contestant; else one that says there is none. A model that
# adapts to the accuracy is another run at a tenth of it.
reference_for <- function(references, one, constraint) {
  for (truth in references) {
    if (!identical(truth$name, one$model)) return(truth)
    if (isTRUE(constraint$models[[one$model]]$adapts) && truth$accuracy < 0.1 * one$accuracy) {
      return(truth)
    }
  }
  list(name = "none", error = NA_real_)
}

given_reference <- function(scene, time_s, reference, constraint, call) {
  columns <- measure_columns(constraint)
  if (inherits(reference, "rot_trajectory")) {
    each <- if (is.null(constraint$index)) 1L else constraint$rows_per_time(scene)
    lacks <- setdiff(columns, names(reference))
    if (length(lacks)) {
      abort_rotdyn("The {.arg reference} must have the columns {.field {columns}}.", "value", call)
    }
    times <- as.double(reference$time_s)
    if (!is.null(constraint$event_rows)) times <- times[match(time_s, times)]
    if (!identical(times, rep(time_s, each = each))) {
      abort_rotdyn("The {.arg reference} must have the same times.", "size", call)
    }
    truth <- truth_of_run(reference, constraint, time_s)
    if (!is.finite(truth$error)) {
      abort_rotdyn("The error of the {.arg reference} is not known.", "value", call)
    }
    truth["name"] <- list(paste("given:", truth$name))
    return(truth)
  }
  if (is.function(reference)) {
    reference <- reference(time_s)
    if (is.list(reference) && is.null(reference$error)) reference$error <- 0
  }
  wanted <- c(columns, "error")
  if (!is.list(reference) || !all(wanted %in% names(reference))) {
    abort_rotdyn(c(
      "{.arg reference} must be NULL, a {.cls rot_trajectory}, or a list with {.field {wanted}}, or
       a function of the times that returns one.",
      x = "It is {describe_value(reference)}."
    ), "type", call)
  }
  values <- lapply(columns, function(name) {
    check_finite(reference[[name]], paste0("reference$", name), "1", call)
  })
  names(values) <- columns
  rows <- length(time_s) * if (is.null(constraint$index)) 1L else constraint$rows_per_time(scene)
  if (any(lengths(values) != rows)) {
    abort_rotdyn("The {.arg reference} must have a row for each time.", "size", call)
  }
  new_truth(
    "given", 0, values, sizes_of(values, constraint),
    check_number(reference[["error"]], "reference$error", "1", call, lower = 0, upper = 1)
  )
}

# Largest distance of a measure relative to its largest value on the way.
distance_to <- function(columns, truth, name, measure) {
  got <- do.call(cbind, columns[measure$columns])
  if (anyNA(got)) return(NA_real_)
  difference <- max(measure$distance(got, do.call(cbind, truth$columns[measure$columns])))
  size <- truth$sizes[[name]]
  if (difference == 0) 0 else if (size > 0) difference / size else 1
}

# ---- one contestant -----------------------------------------------------------------------------

measure_one <- function(one, scene, time_s, constraint, peers, truth, min_batch_s, batches) {
  accuracy <- one$accuracy
  columns <- measure_columns(constraint)
  if (one$peer) {
    f <- peers[[one$model]]
    go <- function() f(scene, time_s, accuracy)
    rows <- length(time_s) * if (is.null(constraint$index)) 1L else constraint$rows_per_time(scene)
    said <- peer_report(try_peer(go, one$model), one$model, columns, rows)
  } else {
    model <- one$model
    step <- if (!is.na(one$step_s)) one$step_s
    go <- if (is.na(accuracy)) {
      # 1: a warning that steps miss an accuracy would cost more than they do.
      function() trajectory(scene, time_s, 1, model, step_s = step)
    } else {
      function() trajectory(scene, time_s, accuracy, model)
    }
    said <- model_report(go(), columns, constraint, time_s)
  }
  measures <- constraint$measures
  raw <- rep(NA_real_, length(measures))
  if (truth$name != "none") {
    raw <- vapply(names(measures), function(name) {
      distance_to(said$columns, truth, name, measures[[name]])
    }, double(1))
  }
  floor <- 3 * truth$error
  error <- pmax(raw, floor)
  names(error) <- paste0(names(measures), "_error")
  cost <- measure_cost(go, min_batch_s, batches)
  c(
    list(model = one$model, method = method_of(one$model, one$error_kind, one$peer),
         accuracy = accuracy, step_s = said$step_s %||% NA_real_),
    as.list(error),
    list(
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
  )
}

# NA where the error of the reference decides.
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

model_report <- function(motion, columns, constraint, time_s) {
  info <- trajectory_run(motion)$info
  balance <- audit(motion)
  energy <- balance[balance$balance == "energy", ]
  terms <- unlist(lapply(energy$terms, function(one) one$value))
  sizes <- abs(c(energy$change, energy$supplied, energy$dissipated, terms))
  residual <- abs(energy$residual)
  list(
    columns = columns_at(motion, columns, constraint, time_s), error = info$error,
    rhs_calls = as.double(info$rhs_calls), steps = as.double(info$steps),
    rejected = as.double(info$rejected), step_s = info$step_s,
    energy_residual = if (length(residual) == 0L) NA_real_ else
      if (residual %in% 0) 0 else residual / max(sizes)
  )
}

# An error in a peer is a failed run.
try_peer <- function(go, name) {
  tryCatch(go(), error = function(e) {
    text <- conditionMessage(e)
    abort_rotdyn("The peer {.val {name}} failed: {text}", "peer", NULL)
  })
}

peer_report <- function(value, name, columns, rows) {
  right <- function(x) is.numeric(x) && length(x) == rows
  if (!is.list(value) || !all(vapply(columns, function(of) right(value[[of]]), logical(1)))) {
    abort_rotdyn(
      "The peer {.val {name}} must return a list with {.field {columns}}, a number for each time.",
      "peer", NULL
    )
  }
  number <- function(field) if (is.null(value[[field]])) NA_real_ else as.double(value[[field]])
  list(
    columns = lapply(value[columns], as.double), error = number("error"),
    rhs_calls = number("rhs_calls"), steps = number("steps"), rejected = number("rejected"),
    energy_residual = NA_real_
  )
}

# Processor time of one call of go(), a number for each batch. The batch grows until it takes long
# enough for the clock; the first one of full size is discarded.
measure_cost <- function(go, min_batch_s, batches) {
  repeats <- 1
  batch <- function() {
    start <- .Call(ffi_clock_cpu)
    for (i in seq_len(repeats)) go()
    .Call(ffi_clock_cpu) - start
  }
  # Where there is no clock the costs are NaN.
  while (isTRUE((took <- batch()) < min_batch_s)) {
    grow <- if (took > 0) 1.2 * min_batch_s / took else 10
    repeats <- ceiling(repeats * min(10, max(1.5, grow)))
  }
  vapply(seq_len(batches), function(i) batch() / repeats, double(1))
}

# ---- warnings -----------------------------------------------------------------------------------

# Runs are repeated: each warning is kept once, and given in the end, except that of a missed
# accuracy, which the table shows.
hear_warnings <- function(expr, heard) {
  withCallingHandlers(expr, rotdyn_warning = function(w) {
    if (!inherits(w, "rotdyn_warning_accuracy")) assign(conditionMessage(w), w, envir = heard)
    rlang::cnd_muffle(w)
  })
}

tell_warnings <- function(heard, failed, call) {
  for (text in ls(heard)) {
    warning(get(text, envir = heard))
  }
  if (length(failed)) {
    lines <- paste0("{failed[", seq_along(failed), "]}") # the text is not glue
    warn_rotdyn(
      c("{length(failed)} run{?s} failed and {?has/have} no row.", rlang::set_names(lines, "x")),
      "failed", call
    )
  }
}

# ---- the class ----------------------------------------------------------------------------------

new_work_precision <- function(rows, constraint, scene, time_s, min_batch_s, batches) {
  rows <- Filter(Negate(is.null), rows)
  empty <- list(
    model = character(), method = character(), floor = logical(), error_kind = character(),
    covered = logical(), reference = character()
  )
  names <- c(
    "model", "method", "accuracy",
    if (any(!is.na(vapply(rows, `[[`, double(1), "step_s")))) "step_s",
    paste0(names(constraint$measures), "_error"),
    setdiff(work_precision_columns, c("model", "method", "accuracy", "theta_error", "omega_error"))
  )
  columns <- lapply(names, function(name) {
    unlist(c(list(empty[[name]] %||% double()), lapply(rows, `[[`, name)), use.names = FALSE)
  })
  names(columns) <- names
  new_table(
    columns, nrow = length(rows), class = "rot_work_precision",
    measured = list(
      rows = length(time_s),
      law = if (is.function(.subset2(scene, "f"))) "right-hand side" else "torque",
      torque = if (inherits(scene$torque, "rot_torque_function") ||
                   is.function(.subset2(scene, "f"))) "an R function" else "in C",
      batches = batches,
      min_batch_s = min_batch_s,
      machine = paste0(R.version$platform, ", R ", getRversion())
    )
  )
}

describe_references <- function(x) {
  each <- unique(data.frame(
    name = x[["reference"]], error = x[["reference_error"]] %||% NA_real_, row.names = NULL
  ))
  toString(paste0(
    each$name, ifelse(is.na(each$error), "", paste(", error", format(each$error, digits = 2)))
  ))
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_work_precision <- function(x, ...) {
  how <- attr(x, "measured", exact = TRUE)
  size <- c("Work and precision" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)))
  if (is.null(how)) return(size)
  c(
    size,
    if (!is.null(x[["reference"]])) c("Reference" = describe_references(x)),
    "Cost" = paste0(
      "processor time of ", format(how$rows, big.mark = ","), " rows, ", how$batches,
      " batches of ", format(1000 * how$min_batch_s), " ms, ",
      how$law %||% "torque", " ", how$torque
    ),
    "Machine" = how$machine
  )
}
