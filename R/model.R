# A model is a record:
#   id, constraint, equations, assumptions, limits, requires, source: text
#   error_kind  "bound" (a closed form) or "estimate" (an integrator)
#   handles     the effects of a scene that it takes, by name
#   why_not(scene, time_s)  NULL if it takes them as they are here, else the reason in words
#   why(scene)              what makes it fit, in words
#   error(accuracy)         predicted relative error
#   cost(scene, rows, accuracy)  predicted floating-point operations
#   run(scene, time_s, accuracy, max_steps, call, asked)  list(columns, info, ledger, events);
#                           `asked`: the user named this model
#   ledger(scene, run, from_s, to_s)  work, heat and impulse between two times

# The models of a scene, cheapest first: what is exact, then integrators. What a rigid shaft leaves
# out depends on the times.
closed_forms_for <- function(scene, time_s) {
  if (inherits(scene, "rot_scene_axle")) {
    axle_closed_forms
  } else if (inherits(scene, "rot_scene_rotors")) {
    rotors_models_for(scene, time_s)
  } else {
    clutch_models
  }
}

# Here, because R reads the files in alphabetical order.
axle_integrators <- list(axle_rk8pd, axle_radau)

integrators_for <- function(scene) {
  if (inherits(scene, "rot_scene_axle")) axle_integrators else list()
}

models_for <- function(scene, time_s) c(closed_forms_for(scene, time_s), integrators_for(scene))

all_models <- function() {
  c(axle_closed_forms, axle_integrators, rotors_models, clutch_models)
}

#' The models
#'
#' Every model that the package can run, cheapest first within a constraint.
#'
#' @return A tibble with one row for each model:
#'   `r describe_columns(model_columns)`
#'   `error` is the smallest relative error that the model promises.
#' @seealso [choose_model()] says which of them fit a scene.
#' @examples
#' models()
#' @export
models <- function() {
  all <- all_models()
  text <- function(field) vapply(all, function(m) m[[field]], character(1))
  tibble::tibble(
    model = text("id"),
    constraint = text("constraint"),
    equations = text("equations"),
    assumptions = text("assumptions"),
    limits = text("limits"),
    requires = text("requires"),
    error = vapply(all, function(m) m$error(0), double(1)),
    error_kind = text("error_kind"),
    source = text("source")
  )
}

# A model for a scene: list(record, scene: what it will solve, dropped: NULL or drop_bound(),
# reason: NULL or why it does not fit). The first way is without dropping anything.
fit_model <- function(record, scene, time_s, accuracy) {
  effects <- .subset2(scene, "effects")
  taken <- match(effects, record$handles, 0L) > 0L
  reason <- if (!all(taken)) {
    paste("it does not take", effects_in_words(effects[!taken]))
  } else {
    record$why_not(scene, time_s)
  }
  if (is.null(reason) && record$error(accuracy) > accuracy) {
    reason <- paste0(
      "its error of ", format(record$error(accuracy), digits = 2), " exceeds the accuracy asked"
    )
  }
  list(record = record, scene = scene, dropped = NULL, reason = reason)
}

# The second way: without what it does not take, if that changes little enough.
fit_without <- function(fit, time_s, accuracy, call) {
  record <- fit$record
  scene <- fit$scene
  missing <- setdiff(scene$effects, record$handles)
  if (length(missing) == 0L || !all(missing %in% droppable) || record$error_kind != "bound") {
    return(fit)
  }
  reduced <- drop_effects(scene, missing)
  reason <- record$why_not(reduced, time_s)
  if (!is.null(reason)) {
    return(fit)
  }
  dropped <- drop_bound(scene, missing, record, time_s, call)
  if (!(dropped$error + record$error(accuracy) <= accuracy)) {
    fit$reason <- paste0(
      fit$reason, if (is.finite(dropped$error)) paste0(
        ", and without ", if (length(missing) == 1L) "it" else "them", " the error could be ",
        format(dropped$error, digits = 2)
      )
    )
    return(fit)
  }
  list(record = record, scene = reduced, dropped = dropped, reason = NULL)
}

#' Choose a model for a scene
#'
#' The cheapest model that fits the scene and reaches the accuracy: a closed form if there is one;
#' else a closed form of the scene without effects that provably change too little to matter at the
#' accuracy asked; else an integrator. [trajectory()] makes the same choice; `choose_model()` shows
#' the candidates and the reasons.
#'
#' An effect is dropped only with a bound: a torque of at most D changes omega by at most
#' `D/I min(T, I/c)` in a time T, and theta by T times that. The trajectory names what was dropped,
#' and its error includes the bound.
#'
#' @param scene A scene, such as [scene_axle()].
#' @param time_s Output times in s, finite and not decreasing: their number counts for the cost,
#'   their span for what may be dropped.
#' @param accuracy Largest relative error wanted in the state, one number in (0, 1]; or an angle or
#'   an angular velocity with units: see [trajectory()].
#' @return A tibble with one row for each model of the scene's constraint, cheapest first:
#'   `r describe_columns(c("model", "applies", "error", "error_kind", "cost", "chosen", "reason"))`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_time`, `rotdyn_error_value`;
#'   `rotdyn_error_accuracy` if no model reaches the accuracy.
#' @source [models()] says for each model where its equations come from.
#' @examples
#' scene <- scene_axle(body_disk(2, 0.25), torque_constant(0.8), resistance(0.03))
#' choose_model(scene, time_s = seq(0, 8, by = 0.1))
#'
#' # Drag so weak that it may be left out at 1e-6, but not at 1e-12:
#' ramp <- torque_knots(c(0, 8), c(0, 0.8))
#' weak <- scene_axle(body_disk(2, 0.25), ramp, resistance(0.03, quadratic_n_m_s2 = 1e-12))
#' choose_model(weak, time_s = 0:8, accuracy = 1e-6)
#' @export
choose_model <- function(scene, time_s, accuracy = 1e-9) {
  call <- rlang::current_env()
  if (missing(scene) || missing(time_s)) {
    check_supplied(c("scene", "time_s"), call)
  }
  check_scene(scene, call)
  time_s <- check_times(time_s, call)
  check_span(scene, time_s, call)
  accuracy <- relative_accuracy(accuracy, scene, time_s, call)
  chosen <- pick_model(scene, time_s, accuracy, NULL, call)$record$id
  fits <- lapply(models_for(scene, time_s), function(record) {
    fit <- fit_model(record, scene, time_s, accuracy)
    if (is.null(fit$reason)) fit else fit_without(fit, time_s, accuracy, call)
  })
  records <- lapply(fits, function(fit) fit$record)
  applies <- vapply(fits, function(fit) is.null(fit$reason), logical(1))
  id <- vapply(records, function(m) m$id, character(1))
  reason <- vapply(fits, function(fit) {
    if (!is.null(fit$reason)) {
      fit$reason
    } else if (!is.null(fit$dropped)) {
      describe_dropped(fit$dropped)
    } else if (fit$record$id == chosen) {
      fit$record$why(scene)
    } else {
      paste0("fits, but ", chosen, " comes first")
    }
  }, character(1))
  cost <- vapply(records, function(m) m$cost(scene, length(time_s), accuracy), double(1))
  error <- vapply(fits, function(fit) {
    fit$record$error(accuracy) + if (is.null(fit$dropped)) 0 else fit$dropped$error
  }, double(1))
  columns <- list(
    model = id,
    applies = applies,
    error = error,
    error_kind = vapply(records, function(m) m$error_kind, character(1)),
    cost = cost,
    chosen = id == chosen,
    reason = reason
  )
  tibble::new_tibble(lapply(columns, `[`, order(cost)), nrow = length(id))
}

check_scene <- function(scene, call) {
  if (inherits(scene, "rot_scene")) {
    return()
  }
  check_class(scene, "rot_scene", "scene", "Describe one with {.fn scene_axle}.", call)
}

# The model asked for, or the first that applies: closed forms, then closed forms of the scene with
# something dropped, then integrators.
pick_model <- function(scene, time_s, accuracy, model, call) {
  if (!is.null(model)) {
    return(named_model(models_for(scene, time_s), scene, time_s, accuracy, model, call))
  }
  closed_forms <- closed_forms_for(scene, time_s)
  exact <- first_fit(closed_forms, scene, time_s, accuracy)
  if (!is.null(exact)) {
    return(exact)
  }
  if (any(scene$effects %in% droppable)) {
    for (candidate in closed_forms) {
      fit <- fit_model(candidate, scene, time_s, accuracy)
      fit <- fit_without(fit, time_s, accuracy, call)
      if (is.null(fit$reason)) {
        return(fit)
      }
    }
  }
  integrated <- first_fit(integrators_for(scene), scene, time_s, accuracy)
  if (is.null(integrated)) {
    abort_no_model(models_for(scene, time_s), scene, time_s, accuracy, call)
  }
  integrated
}

# The first that takes the scene as it is, or NULL. No reason is made for the others: half the time
# of a small call.
first_fit <- function(candidates, scene, time_s, accuracy) {
  effects <- .subset2(scene, "effects")
  for (candidate in candidates) {
    if (!anyNA(match(effects, candidate$handles)) && is.null(candidate$why_not(scene, time_s)) &&
      candidate$error(accuracy) <= accuracy) {
      return(list(record = candidate, scene = scene, dropped = NULL, reason = NULL))
    }
  }
}

abort_no_model <- function(candidates, scene, time_s, accuracy, call) {
  takes <- Filter(
    function(m) all(scene$effects %in% m$handles) && is.null(m$why_not(scene, time_s)), candidates
  )
  if (length(takes) == 0L) {
    abort_rotdyn(
      c(
        "No model can run this scene backwards.",
        x = "{.arg time_s} begins at {format(time_s[1])} s, the scene at {format(scene$start_s)} s.",
        i = "Where dry friction has brought a body to rest, its past cannot be told: ask for times
             from {.arg start_s} on."
      ),
      "time",
      call
    )
  }
  best <- min(vapply(takes, function(m) m$error(accuracy), double(1)))
  abort_rotdyn(
    c(
      "No model of this scene reaches a relative accuracy of {format(accuracy)}.",
      i = "The best that one promises is {format(best, digits = 2)}."
    ),
    "accuracy",
    call
  )
}

named_model <- function(candidates, scene, time_s, accuracy, model, call) {
  ids <- vapply(candidates, function(m) m$id, character(1))
  if (!rlang::is_string(model) || !model %in% ids) {
    abort_rotdyn(
      c(
        "{.arg model} must be NULL or one of {.or {.val {ids}}}.",
        x = "It is {describe_value(model)}."
      ),
      "model",
      call
    )
  }
  fit <- fit_model(candidates[[match(model, ids)]], scene, time_s, accuracy)
  if (!is.null(fit$reason)) fit <- fit_without(fit, time_s, accuracy, call)
  if (!is.null(fit$reason)) {
    abort_rotdyn(
      c(
        "Model {.val {model}} does not fit: {fit$reason}.",
        i = "{.code model = NULL} picks one that does; {.fn choose_model} says why."
      ),
      "model",
      call
    )
  }
  fit
}
