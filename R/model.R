# A model is a record:
#   id, constraint, equations, assumptions, limits, requires, source: text
#   error_kind  "bound" or "estimate"
#   why_not(scene)         NULL if the model fits the scene, else the reason in words
#   why(scene)             what makes it fit, in words
#   error(accuracy)        predicted relative error
#   cost(scene, rows, accuracy)  predicted floating-point operations
#   run(scene, time_s, accuracy, max_steps, call)  list(columns, info, ledger)
#   ledger(scene, run, from_s, to_s)               work, heat and impulse between two times

# The models of a constraint, cheapest first.
models_for <- function(scene) {
  if (inherits(scene, "rot_scene_axle")) axle_models else list()
}

all_models <- function() {
  axle_models
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

# NULL if the model may run, else why not.
model_why_not <- function(model, scene, accuracy) {
  reason <- model$why_not(scene)
  if (is.null(reason) && model$error(accuracy) > accuracy) {
    reason <- paste0(
      "its error of ", format(model$error(accuracy), digits = 2), " exceeds the accuracy asked"
    )
  }
  reason
}

#' Choose a model for a scene
#'
#' The cheapest model that fits the scene and reaches the accuracy. [trajectory()] makes the same
#' choice; `choose_model()` shows the candidates and the reasons.
#'
#' @param scene A scene, such as [scene_axle()].
#' @param time_s Output times in s, finite and not decreasing: their number counts for the cost.
#' @param accuracy Largest relative error wanted in the state, one number in (0, 1].
#' @return A tibble with one row for each model of the scene's constraint, cheapest first:
#'   `r describe_columns(c("model", "applies", "error", "error_kind", "cost", "chosen", "reason"))`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_time`, `rotdyn_error_value`;
#'   `rotdyn_error_accuracy` if no model reaches the accuracy.
#' @examples
#' scene <- scene_axle(body_disk(2, 0.25), torque_constant(0.8), resistance(0.03))
#' choose_model(scene, time_s = seq(0, 8, by = 0.1))
#' @export
choose_model <- function(scene, time_s, accuracy = 1e-9) {
  call <- rlang::current_env()
  if (missing(scene) || missing(time_s)) {
    check_supplied(c("scene", "time_s"), call)
  }
  check_scene(scene, call)
  time_s <- check_times(time_s, call)
  accuracy <- check_accuracy(accuracy, call)
  candidates <- models_for(scene)
  chosen <- pick_model(scene, accuracy, NULL, call)$id
  why_not <- lapply(candidates, model_why_not, scene, accuracy)
  applies <- vapply(why_not, is.null, logical(1))
  id <- vapply(candidates, function(m) m$id, character(1))
  reason <- vapply(seq_along(id), function(i) {
    if (!applies[i]) {
      why_not[[i]]
    } else if (id[i] == chosen) {
      candidates[[i]]$why(scene)
    } else {
      paste0("fits, but costs more than ", chosen)
    }
  }, character(1))
  cost <- vapply(candidates, function(m) m$cost(scene, length(time_s), accuracy), double(1))
  columns <- list(
    model = id,
    applies = applies,
    error = vapply(candidates, function(m) m$error(accuracy), double(1)),
    error_kind = vapply(candidates, function(m) m$error_kind, character(1)),
    cost = cost,
    chosen = id == chosen,
    reason = reason
  )
  tibble::new_tibble(lapply(columns, `[`, order(cost)), nrow = length(id))
}

check_scene <- function(scene, call) {
  check_class(scene, "rot_scene", "scene", "Describe one with {.fn scene_axle}.", call)
}

# The record of the model asked for, or of the cheapest that applies.
pick_model <- function(scene, accuracy, model, call) {
  candidates <- models_for(scene)
  if (is.null(model)) {
    for (candidate in candidates) {
      if (is.null(model_why_not(candidate, scene, accuracy))) {
        return(candidate)
      }
    }
    fit <- Filter(function(m) is.null(m$why_not(scene)), candidates)
    best <- min(vapply(fit, function(m) m$error(accuracy), double(1)))
    abort_rotdyn(
      c(
        "No model of this scene reaches a relative accuracy of {format(accuracy)}.",
        i = "The best that one promises is {format(best, digits = 2)}."
      ),
      "accuracy",
      call
    )
  }
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
  record <- candidates[[match(model, ids)]]
  reason <- model_why_not(record, scene, accuracy)
  if (!is.null(reason)) {
    abort_rotdyn(
      c(
        "Model {.val {model}} does not fit: {reason}.",
        i = "{.code model = NULL} picks one that does; {.fn choose_model} says why."
      ),
      "model",
      call
    )
  }
  record
}
