# A model is a record:
#   id, equations, assumptions, limits, requires, source: text
#   run(scene, time_s, accuracy, max_steps, call, asked)  list(columns, info, events, ledger), all
#                           named; `asked`: the user named this model
#   adapts                  TRUE: its error follows the accuracy asked; FALSE: it goes by steps that
#                           do not; NULL: no steps
#   run_with_step(scene, time_s, step_s, max_steps, call)  NULL, or run() by steps of this length
#   ran_as(info)            the id of the model that a run ended with
#   loses                   NULL, or the cause of large errors, for the warning
#   leaves_out              NULL, or what an approximation leaves out, for the head of a trajectory
# and, from the C core:
#   error_kind              "bound" (a closed form) or "estimate"
#   handles                 the effects of a scene that it takes, by name
#   why_not(scene, time_s)  NULL if it takes them as they are here, else the reason in words
#   why                     what makes it fit, in words (57 characters fit on a line)
#   error(accuracy)         promised relative error
#   on_trial                TRUE: only a run tells its error; it is kept if that is good enough

core_record <- function(record) {
  known <- core_models()
  at <- match(record$id, known$model)
  promise <- known$error[at]
  id <- known$constraint[at]
  record$error_kind <- known$error_kind[at]
  record$handles <- known$takes[[at]]
  record$why_not <- function(scene, time_s) {
    core_pick(id, scene, time_s, 1, model = record$id)$reason
  }
  record$why <- known$why[at]
  record$error <- function(accuracy) if (isTRUE(record$adapts)) max(accuracy, promise) else promise
  record$on_trial <- known$on_trial[at]
  record
}

#' The models
#'
#' Every model that the package can run, by constraint.
#'
#' @return A tibble with one row for each model:
#'   `r describe_columns(model_columns)`
#'   `error` is the smallest relative error that the model promises.
#' @seealso [choose_model()] says which of them fit a scene.
#' @concept RK4
#' @concept Euler
#' @concept integrators
#' @concept methods
#' @examples
#' models()
#' @export
models <- function() {
  constraints <- all_constraints()
  all <- unlist(lapply(constraints, function(constraint) constraint$models), recursive = FALSE)
  text <- function(field) vapply(all, function(m) m[[field]], character(1), USE.NAMES = FALSE)
  of <- lapply(constraints, function(constraint) rep(constraint$id, length(constraint$models)))
  as_table(
    model = text("id"),
    constraint = unlist(of, use.names = FALSE),
    equations = text("equations"),
    assumptions = text("assumptions"),
    limits = text("limits"),
    requires = text("requires"),
    error = vapply(all, function(m) m$error(0), double(1), USE.NAMES = FALSE),
    error_kind = text("error_kind"),
    source = text("source")
  )
}

# How a model runs a scene: list(record, scene: what it will solve, dropped: NULL or what was left
# out, reason: NULL or why it does not fit, result: NULL or that of a run on trial).
new_fit <- function(record, scene, dropped, reason = NULL) {
  if (!is.null(dropped)) scene$without <- dropped$effects # C leaves them out
  list(record = record, scene = scene, dropped = dropped, reason = reason, result = NULL)
}

too_coarse <- function(error, accuracy) {
  if (!(error <= accuracy)) {
    paste0("its error of ", format(error, digits = 2), " exceeds the accuracy asked")
  }
}

# A model on trial is run, and kept if its error is good enough.
try_model <- function(fit, time_s, accuracy, max_steps, call) {
  if (is.null(fit$reason) && isTRUE(fit$record$on_trial)) {
    fit$result <- fit$record$run(
      fit$scene, time_s, accuracy, max_steps + length(time_s), call, FALSE
    )
    fit$reason <- too_coarse(fit$result$info$error, accuracy)
  }
  fit
}

# The model asked for, or the cheapest that applies, which the core picks.
pick_model <- function(scene, time_s, accuracy, model, max_steps, call) {
  constraint <- constraint_of(scene)
  if (!is.null(model)) {
    return(named_model(constraint, scene, time_s, accuracy, model, max_steps, call))
  }
  pick <- .Call(ffi_choice_pick, constraint$id, scene, time_s, accuracy, 1e-6, NULL) # 1 us less
  tried <- NULL
  for (i in seq_along(pick$model)) {
    record <- constraint$models[[pick$model[i]]]
    fit <- new_fit(record, scene, pick$dropped[[i]])
    trial <- record$on_trial
    if (is.null(trial) || !trial) return(fit)
    fit <- try_model(fit, time_s, accuracy, max_steps, call)
    if (is.null(fit$reason)) return(fit)
    tried <- c(tried, fit$result$info$error)
  }
  abort_no_model(constraint, scene, time_s, accuracy, tried, call)
}

# Seconds of processor time of a call: the median of five, after one that is not counted. NaN where
# there is no clock.
call_seconds <- function(once) {
  timed <- function(i) {
    start <- .Call(ffi_clock_cpu)
    once()
    .Call(ffi_clock_cpu) - start
  }
  stats::median(vapply(0:5, timed, double(1))[-1])
}

#' Choose a model for a scene
#'
#' The model with the least predicted time of those that take the scene and reach the accuracy.
#' [trajectory()] makes the same choice; `choose_model()` shows the candidates and the reasons.
#'
#' An effect is ignored only where no closed form takes the scene unchanged, and only with a bound:
#' a torque of at most D changes omega by at most `D/I min(T, I/c)` in a time T, and theta by T
#' times that. The trajectory names the effect, and its error includes the bound.
#'
#' @param scene A scene, such as [scene_axle()].
#' @param time_s Output times in s, finite and not decreasing: their number counts for the cost,
#'   their span for the effects that may be ignored.
#' @param accuracy Largest relative error wanted in the state, one number in (0, 1]; or an angle or
#'   an angular velocity with units: see [trajectory()].
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble (class `rot_model_choice`) with one row for each model of the scene's
#'   constraint, in the order of predicted time. It prints the chosen model with its reason, then
#'   the other models that apply, then the rest. The columns:
#'   `r describe_columns(c("model", "applies", "error", "error_kind", "cost_s", "chosen", "reason"))`
#'   `cost_s` is a prediction.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_time`, `rotdyn_error_value`;
#'   `rotdyn_error_accuracy` if no model reaches the accuracy.
#' @source [models()] says for each model where its equations come from.
#' @seealso [models()] lists all, [work_precision()] measures what is predicted here,
#'   [trajectory()].
#' @concept which model
#' @concept method
#' @concept approximation
#' @examples
#' scene <- scene_axle(body_disk(2, 0.25), torque_constant(0.8), resistance(0.03))
#' choose_model(scene, time_s = seq(0, 8, by = 0.1))
#'
#' # Drag so weak that it is ignored at 1e-6, but not at 1e-12:
#' ramp <- torque_knots(c(0, 8), c(0, 0.8))
#' weak <- scene_axle(body_disk(2, 0.25), ramp, resistance(0.03, quadratic_n_m_s2 = 1e-12))
#' choose_model(weak, time_s = 0:8, accuracy = 1e-6)
#' @export
choose_model <- function(scene, time_s, accuracy = 1e-9, ...) {
  call <- check_no_dots(...)
  if (missing(scene) || missing(time_s)) check_supplied(c("scene", "time_s"), call)
  check_scene(scene, call)
  time_s <- check_times(time_s, call)
  check_span(scene, time_s, call)
  accuracy <- relative_accuracy(accuracy, scene, time_s, call)
  constraint <- constraint_of(scene)
  once <- if (!is.null(constraint$call_laws)) constraint$call_laws(scene, call)
  law_s <- if (is.null(once)) {
    0
  } else {
    tryCatch(call_seconds(once), error = function(e) if (is_time_limit(e)) stop(e) else 1e-6)
  }
  choice <- core_candidates(constraint$id, scene, time_s, accuracy, law_s)
  if (!any(choice$chosen)) {
    tried <- choice$error[vapply(constraint$models[choice$model], function(record) {
      isTRUE(record$on_trial)
    }, NA)]
    abort_no_model(constraint, scene, time_s, accuracy, tried, call)
  }
  choice <- choice[c("model", "applies", "error", "error_kind", "cost_s", "chosen", "reason")]
  n <- length(choice$model)
  attributes(choice) <- list( # new_table() takes a third of the time of all
    names = names(choice), class = c("rot_model_choice", "tbl_df", "tbl", "data.frame"),
    row.names = c(NA_integer_, -n)
  )
  choice
}

only_by_name <- "it runs only where it is named" # src/core/scene/choice.c

#' @export
print.rot_model_choice <- function(x, ...) {
  kinds <- c(
    model = "character", applies = "logical", error = "numeric", error_kind = "character",
    cost_s = "numeric", chosen = "logical", reason = "character"
  )
  # Unless rows or columns were removed, or made anew.
  if (!has_kinds(x, kinds) || sum(x$chosen %in% TRUE) != 1L) {
    print(drop_class(x, "rot_model_choice"), ...)
    return(invisible(x))
  }
  chosen <- which(x$chosen)
  rest <- which(!x$applies & x$reason != only_by_name)
  named <- which(x$reason == only_by_name)
  others <- setdiff(which(x$applies), chosen)
  error <- paste(ifelse(x$error_kind == "bound", "error at most", "error about"),
                 format_si(x$error, 2))
  cost <- format_seconds(x$cost_s)
  say("<rot_model_choice> ", x$model[chosen], "\n")
  print_field("why", x$reason[chosen])
  print_field("error", sub("error ", "", error[chosen]))
  print_field("cost", paste(cost[chosen], "predicted, the least of those that apply"))
  if (length(others)) {
    say("also apply:\n")
    names <- format(x$model[others])
    reason <- ifelse(grepl(" is cheaper$", x$reason[others]), "", paste0("  ", x$reason[others]))
    line <- paste0(
      "  ", names, "  ", format(paste0(error[others], ",")), " cost ", format(cost[others]), reason
    )
    say(strwrap_each(line, nchar(names[1]) + 4L), sep = "\n")
  }
  if (length(rest)) {
    say("do not apply:\n")
    names <- format(x$model[rest])
    say(strwrap_each(paste0("  ", names, "  ", x$reason[rest]), nchar(names[1]) + 4L), sep = "\n")
  }
  if (length(named)) say("by name alone: ", paste(x$model[named], collapse = ", "), "\n")
  invisible(x)
}

# Lines wrapped to the console's width, with the blanks of their columns.
strwrap_each <- function(lines, indent) {
  room <- max(print_width() - indent, 30L)
  unlist(lapply(lines, function(line) {
    if (nchar(line) <= print_width()) return(trimws(line, "right"))
    text <- strwrap(substring(line, indent + 1L), room + 1L)
    paste0(c(substr(line, 1L, indent), rep(strrep(" ", indent), length(text) - 1L)), text)
  }))
}

drop_class <- function(x, class) {
  class(x) <- setdiff(class(x), class)
  x
}

# Times with two digits, in the unit that suits each.
format_seconds <- function(x) {
  unit <- c(s = 1, ms = 1e-3, us = 1e-6, ns = 1e-9)
  at <- vapply(x, function(one) which(c(one >= unit[1:3], TRUE))[1], 1L)
  at[is.na(x)] <- 1L
  paste(format_si(signif(x / unit[at], 2)), names(unit)[at])
}

# `tried`: errors of the models that were run on trial.
abort_no_model <- function(constraint, scene, time_s, accuracy, tried, call) {
  effects <- constraint$effects_of(scene)
  takes <- Filter(function(record) all(effects %in% record$handles), constraint$models)
  why_not <- lapply(takes, function(record) record$why_not(scene, time_s))
  fits <- vapply(why_not, is.null, logical(1))
  if (!any(fits)) {
    abort_rotdyn(c(
      "No model can run this scene at these times.",
      x = paste0(
        "{.arg time_s} begins at {format(time_s[1])} s, ",
        "the scene at {format(scene$start_s)} s."
      ),
      i = "{.field {takes[[1]]$id}}: {why_not[[1]]}."
    ), "time", call)
  }
  promised <- vapply(takes[fits], function(record) {
    if (isTRUE(record$on_trial)) Inf else record$error(accuracy)
  }, double(1))
  best <- min(promised, tried)
  abort_rotdyn(c(
    "No model of this scene reaches a relative accuracy of {format(accuracy)}.",
    i = "The best that one promises is {format(best, digits = 2)}."
  ), "accuracy", call)
}

named_model <- function(constraint, scene, time_s, accuracy, model, max_steps, call) {
  ids <- names(constraint$models)
  if (!rlang::is_string(model) || !model %in% ids) {
    abort_rotdyn(c(
      "{.arg model} must be NULL or one of {.or {.val {ids}}}.",
      x = "It is {describe_value(model)}."
    ), "model", call)
  }
  record <- constraint$models[[model]]
  pick <- core_pick(constraint$id, scene, time_s, accuracy, model = model)
  fit <- new_fit(
    record, scene, pick$dropped[[1]], if (!isTRUE(pick$applies)) pick$reason
  )
  fit <- try_model(fit, time_s, accuracy, max_steps, call)
  if (!is.null(fit$reason)) {
    abort_rotdyn(c(
      "Model {.val {model}} does not fit: {fit$reason}.",
      i = "{.code model = NULL} picks one that does; {.fn choose_model} says why."
    ), "model", call)
  }
  fit
}

record_of <- function(run) {
  record <- constraint_of(run$scene)$models[[run$model]]
  if (is.null(run$step_s) || is.null(record$run_with_step)) return(record)
  with_step(record, run$step_s)
}

# A model whose steps have the length that the user asked for.
with_step <- function(record, step_s) {
  record$run <- function(scene, time_s, accuracy, max_steps, call, asked, ...) {
    record$run_with_step(scene, time_s, step_s, max_steps, call)
  }
  record
}

scene_words <- function(scene) {
  constraint <- constraint_of(scene)
  effects_in_words(constraint$effects_of(scene), constraint)
}

# A torque that changes in time is a torque, too: said once.
effects_in_words <- function(effects, constraint) {
  if ("ramp" %in% effects) effects <- setdiff(effects, "torque")
  and_words(unname(constraint$effects[effects]))
}

describe_dropped <- function(dropped, constraint) {
  paste0(
    constraint$effects[dropped$effects], " ignored: it changes omega by at most ",
    vapply(dropped$each, format, character(1), digits = 2), " of its maximum",
    collapse = "; "
  )
}

# The accuracy as a relative number. A physical one is that of the measure of its unit, divided by
# the measure's size, which a run at 1e-3 gives; a tenth less, a margin for the error of that size.
relative_accuracy <- function(accuracy, scene, time_s, call) {
  if (!is.object(accuracy) || !inherits(accuracy, "units")) return(check_accuracy(accuracy, call))
  need_package("units", "An accuracy with units", call)
  measures <- constraint_of(scene)$measures
  fits <- vapply(measures, function(m) {
    units::ud_are_convertible(units(accuracy), m$unit)
  }, logical(1))
  of <- names(measures)[if (any(fits)) which(fits)[1] else length(measures)]
  wanted <- check_number(accuracy, "accuracy", measures[[of]]$unit, call, lower = 0, open = TRUE)
  pilot <- pick_model(scene, time_s, 1e-3, NULL, 1e6, call)
  info <- (pilot$result %||%
    pilot$record$run(pilot$scene, time_s, 1e-3, 1e6 + length(time_s), call, FALSE))$info
  size <- info$sizes[[of]]
  if (info$kind != "none" || !(size > 0)) {
    return(1e-9) # a failing run reports why; a motion of size 0 has no error
  }
  min(1, 0.9 * wanted / size)
}
