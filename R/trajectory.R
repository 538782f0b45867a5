#' The motion of a scene
#'
#' Chooses the cheapest model that takes the scene and reaches the accuracy (see [choose_model()]),
#' and computes the motion in C. The result carries its model, its error and its [audit()].
#'
#' @param scene A scene: [scene_axle()], [scene_pendulum()], [scene_rotors()], [scene_clutch()],
#'   [scene_drive()], [scene_gears()], [scene_hanging_mass()], [scene_hoop()], [scene_chain()],
#'   [scene_incline()], [scene_free()], [scene_pivot()], or [scene_equations()].
#' @param time_s Output times in s, finite and not decreasing (repeated ones give repeated rows;
#'   none gives no row). They need not contain the scene's `start_s`; earlier times are reached
#'   backwards.
#' @param accuracy Largest relative error wanted in the state, one number in (0, 1]: of theta
#'   relative to the largest |theta| up to the last row, and of omega likewise. Or with units, such
#'   as `units::set_units(0.1, "degree")` or `units::set_units(1, "rpm")`: the largest error wanted
#'   in the angle, or in the angular velocity.
#' @param model NULL for the cheapest, or the name of one of [models()].
#' @param ... Not used; names after it must be given in full.
#' @param on_fail If a run fails part-way (a torque that is not finite, a step budget used up):
#'   `"abort"` with an error that says where, or `"truncate"`: the rows before the failure, with a
#'   warning of class `rotdyn_warning_truncated`.
#' @param max_steps Most steps that an integrator tries in one run, beyond one for each row.
#' @param step_s Length of the steps in s, for models whose steps are of fixed length: explicit
#'   Euler (`axle_euler`), semi-implicit Euler (`axle_semi_implicit`), Runge-Kutta of order 4
#'   (`axle_rk4`); `drive_`, `incline_`, `hoop_`, `chain_`, `free_`, `pivot_` and `equations_`
#'   likewise, and `free_split` and `pivot_split`. They run only where `model` names them. NULL:
#'   1/64 of the shortest time scale of the scene at its start (a decay, a swing), 1/1000 of the
#'   span where it has none. Of bodies that turn freely or about a point: of the time
#'   \eqn{2\pi/\nu}{2 pi/nu} the 64th part, of `_split` the 32nd, with
#'   \eqn{\nu = |\omega_0| + \sqrt{\tau/I} + \gamma}{nu = |omega0| + sqrt(tau/I) + damping}, the
#'   largest torque and the least moment. A step ends at each break of a law and at each event that
#'   changes the law; a row between two steps takes a shorter one. They have no accuracy of their
#'   own: `accuracy = 1` asks for none, and the error of each run is estimated by a second one with
#'   half the step.
#' @param event_rows TRUE: also a row at each event of [motion_events()] between the first time and
#'   the last, and a column `event` that names the event in each row at its time, asked for or
#'   added. A [scene_incline()] has that column always, and takes the rows from the run itself;
#'   other scenes are run again to the times of the events. FALSE: n times give n rows.
#' @param resolution For torque laws, forces and clutches that are R functions: the width of the
#'   narrowest change in time, in an angle or in a rate that is sure to be found, as a part of the
#'   range of it that the motion visits, one number from 1e-5 to 1. The function is called along the
#'   motion that was found, \eqn{1.43/resolution}{1.43/resolution} times or some more where
#'   the steps themselves did not call it; where it is not what they believed, they are chosen anew.
#'   Narrower changes may be missed, in the motion and in its audit: the head of the result says so.
#'   1: only the steps call the function.
#' @return A `rot_trajectory`: a tibble with the columns `r describe_columns(trajectory_columns)`
#'   The trajectory of a [scene_rotors()], [scene_clutch()], [scene_drive()] or
#'   [scene_hanging_mass()] has columns of its own, listed there. [summary()] and
#'   [generics::glance()] give one row, `predict()` other times, [audit()] the balance,
#'   [augment()][augment.rot_trajectory] work and heat row by row, [motion_events()] the events,
#'   `ggplot2::autoplot()` a plot. dplyr verbs keep the class with the key columns. A scene with
#'   [inertia_knots()] adds the column `moment_of_inertia_kg_m2`.
#' @section Warnings: `rotdyn_warning_breaks` if breaks of a torque function were searched for;
#'   `rotdyn_warning_accuracy` if the error figure exceeds the accuracy asked for.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_time` (times missing or
#'   not in order), `rotdyn_error_unit`; `rotdyn_error_model`, `rotdyn_error_accuracy` when nothing
#'   fits; `rotdyn_error_torque`, `rotdyn_error_random` (a law that gives two values for the same
#'   arguments), `rotdyn_error_range`, `rotdyn_error_budget`, `rotdyn_error_step` from a run: those
#'   carry `info`, with the time reached. An error, a condition, an interrupt or a time limit raised
#'   in a torque function keeps its class.
#' @source [models()] says for each model where its equations come from.
#' @seealso [choose_model()], [audit()], [predict.rot_trajectory()], [motion_events()],
#'   [time_when()], [compare_runs()], [autoplot.rot_trajectory()], [animate_motion()].
#' @concept simulation
#' @concept motion
#' @concept RK4
#' @concept Runge-Kutta
#' @concept integrator
#' @concept fixed step
#' @examples
#' scene <- scene_axle(
#'   body_disk(mass_kg = 2, radius_m = 0.25),
#'   torque_knots(time_s = c(0, 1, 4, 6, 8), torque_n_m = c(0, 0.8, 0.8, 0, 0)),
#'   resistance(viscous_n_m_s = 0.03)
#' )
#' motion <- trajectory(scene, time_s = seq(0, 8, by = 0.5))
#' motion
#' summary(motion)
#' predict(motion, time_s = c(5.25, 1.75))
#' @export
trajectory <- function(scene, time_s, accuracy = 1e-9, model = NULL, ...,
                       on_fail = c("abort", "truncate"), max_steps = 1e6, step_s = NULL,
                       event_rows = FALSE, resolution = 0.005) {
  if (nargs() == 2L && !missing(scene) && !missing(time_s)) {
    motion <- quick_trajectory(scene, time_s)
    if (!is.null(motion)) return(motion)
  }
  call <- environment()
  if (missing(scene) || missing(time_s)) check_supplied(c("scene", "time_s"), call)
  check_no_dots(...)
  if (!missing(max_steps)) max_steps <- check_number(max_steps, "max_steps", "1", call, lower = 1)
  on_fail <- if (missing(on_fail)) {
    "abort"
  } else {
    check_string(on_fail, "on_fail", c("abort", "truncate"), call)
  }
  if (!is.null(step_s)) step_s <- check_number(step_s, "step_s", "s", call, lower = 0, open = TRUE)
  if (missing(resolution)) {
    resolution <- NULL
  } else {
    resolution <- check_number(resolution, "resolution", "1", call, lower = 1e-5, upper = 1)
  }
  if (!missing(event_rows)) event_rows <- check_flag(event_rows, "event_rows", call)
  motion <- compute_trajectory(
    scene, time_s, accuracy, model, on_fail, max_steps, call, step_s, event_rows, resolution
  )
  warn_of_end(scene, motion, call)
  motion
}

# A motion of which nothing is to be said, with all that is chosen left to its default: one call of
# C chooses and runs. NULL where there is more to do.
quick_trajectory <- function(scene, time_s, accuracy = 1e-9) {
  constraint <- constraint_of(scene)
  # Names and dimensions of the times are none of a column.
  if (!isTRUE(constraint$quick) || !is.null(attributes(time_s))) return()
  result <- .Call(
    ffi_scene_quick, constraint$id, constraint$form, scene, time_s, accuracy
  )
  if (is.null(result)) return()
  run <- result[[2L]]
  if (!is.null(constraint$event_rows)) run <- name_events(run)
  new_trajectory(run$columns, length(time_s), new_run(
    scene, scene, NULL, result[[1L]], accuracy, "bound", run$info, run$ledger, NULL, run$events,
    1e6, FALSE, NULL
  ))
}

# What a trajectory remembers of its run.
new_run <- function(scene, solved, dropped, model, accuracy, error_kind, info, ledger, step_s,
                    events, max_steps, asked, body) {
  list(
    scene = scene, solved = solved, dropped = dropped, model = model, accuracy = accuracy,
    error_kind = error_kind, info = info, ledger = ledger, step_s = step_s, events = events,
    max_steps = max_steps, asked = asked, body = body
  )
}

# From when on a motion is beyond its model, if it is.
warn_of_end <- function(scene, columns, call) {
  ends <- constraint_of(scene)$ends
  text <- if (!is.null(ends)) ends(scene, columns)
  if (!is.null(text)) warn_quickly(paste0(sentence(text), "."), "slack", call)
}

# trajectory(), for other functions too: `call` is the user's.
compute_trajectory <- function(scene, time_s, accuracy, model, on_fail, max_steps, call,
                               step_s = NULL, event_rows = FALSE, resolution = NULL) {
  check_scene(scene, call)
  time_s <- check_times(time_s, call)
  check_span(scene, time_s, call)
  if (!identical(accuracy, 1e-9)) accuracy <- relative_accuracy(accuracy, scene, time_s, call)
  fit <- pick_model(scene, time_s, accuracy, model, max_steps, call)
  if (!is.null(resolution)) fit$scene$resolution <- resolution
  if (!is.null(step_s)) {
    if (is.null(fit$record$run_with_step)) abort_no_steps(constraint_of(scene), fit$record$id, call)
    fit$record <- with_step(fit$record, step_s)
    fit$step_s <- step_s
  }
  run_trajectory(
    fit, scene, time_s, accuracy, on_fail, max_steps, call, !is.null(model), event_rows
  )
}

fixed_step_models <- function(constraint) {
  names(Filter(function(record) !is.null(record$run_with_step), constraint$models))
}

abort_no_steps <- function(constraint, model, call, arg = "step_s") {
  ids <- fixed_step_models(constraint)
  abort_rotdyn(c(
    "{.arg {arg}} is for models whose steps are of fixed length: {.field {model}} {?is/are} none.",
    i = if (length(ids)) "Of this scene these are {.val {ids}}." else "This scene has none."
  ), "model", call)
}

# `scene` is what the user described; `fit$scene` is what is solved.
# `event_rows`: whether rows at the times of events are added; NA: only the column is, for rows that
# are given with the events among them.
run_trajectory <- function(fit, scene, time_s, accuracy, on_fail, max_steps, call, asked,
                           event_rows = FALSE) {
  record <- fit$record
  constraint <- constraint_of(scene)
  # One step for each row at least, so that many rows are not a failure.
  result <- fit$result
  if (is.null(result)) {
    steps <- max_steps + length(time_s)
    result <- if (isTRUE(event_rows) && !is.null(constraint$event_rows)) {
      record$run(fit$scene, time_s, accuracy, steps, call, asked, event_rows = TRUE)
    } else {
      record$run(fit$scene, time_s, accuracy, steps, call, asked)
    }
  }
  each <- if (is.null(constraint$index)) 1L else constraint$rows_per_time(scene)
  info <- result$info
  n <- length(time_s)
  if (!is.null(fit$dropped)) {
    info <- widen_error(info, fit$dropped$errors)
  }
  if (info$kind == "none" && n && suspicious(info, record, accuracy, fit$dropped)) {
    info <- measure_between_rows(info, fit, time_s, accuracy, max_steps, call)
  }
  run_as <- function(body) {
    new_run(
      scene, fit$scene, fit$dropped, record$ran_as(info), # one integrator may switch to the other
      accuracy, record$error_kind, info, result$ledger, fit$step_s, result$events, max_steps, asked,
      body
    )
  }
  if (!isFALSE(event_rows) || !is.null(constraint$event_rows)) {
    events <- result$events
    if (is.null(constraint$event_rows)) {
      if (info$kind == "none") {
        run <- run_as(NULL)
        events <- events_of(new_trajectory(result$columns, n * each, run), run, call)
      }
      if (isTRUE(event_rows)) {
        result$event_rows <- run_to_events(
          result, events, record, fit$scene, accuracy, max_steps, call, asked
        )
      }
    }
    result <- name_events(if (isTRUE(event_rows)) add_event_rows(result) else result, events)
    n <- length(result$columns$time_s) / each
    time_s <- result$columns$time_s[seq(1, by = each, length.out = n)]
  }
  columns <- result$columns
  if (!is.null(constraint$more_columns)) columns <- constraint$more_columns(columns, scene, time_s)
  if (info$kind != "none") {
    failed_run(info, n, on_fail, call)
    n <- info$rows_done
    columns <- lapply(columns, `[`, seq_len(n * each))
  } else if (is.na(info$error)) {
    abort_rotdyn(
      "The error bound is not finite: the motion exceeds double precision.", "range", call,
      info = info
    )
  } else if (n && is_lost(info)) {
    info$lost <- TRUE
    warn_rotdyn(c(
      "The relative error is not known: the figure of the {record$error_kind},
       {format(info$error, digits = 2)}, is larger than the motion itself.",
      i = "Rows that far from the start may be those of another motion from nearly the same start:
           ask for a shorter time."
    ), "accuracy", call)
    info$error <- NA_real_
  } else if (n && !(info$error <= accuracy)) {
    beyond <- if (is.infinite(info$error)) beyond_doubles(columns)
    why <- record$loses %||% if (isTRUE(record$adapts)) {
      "Shorter steps do not lessen it: ask for less accuracy, or for a shorter time."
    } else {
      "Large terms of two signs cancel in this motion."
    }
    warn_rotdyn(c(
      "The {record$error_kind} of the relative error is {format(info$error, digits = 2)}, more
       than the accuracy of {format(accuracy)} asked for.",
      i = if (!length(beyond)) why,
      x = if (length(beyond)) "Beyond double precision: {.field {beyond}}."
    ), "accuracy", call)
  }
  new_trajectory(
    columns, n * each,
    run_as(if (info$kind == "none") body_effect(fit, time_s, accuracy, max_steps, call))
  )
}

# NULL, or list(columns, ledger): rows at the times of events, by a run of their own.
run_to_events <- function(result, events, record, scene, accuracy, max_steps, call, asked) {
  at <- unique(as.double(events$time_s))
  if (!length(at) || result$info$kind != "none") return(NULL)
  rows <- record$run(scene, at, accuracy, max_steps + length(at), call, asked)
  if (rows$info$kind == "none") rows[c("columns", "ledger")]
}

# The result with the run's rows at its events, between the first time and the last; a time that
# was asked for keeps its own row.
add_event_rows <- function(result) {
  rows <- result$event_rows
  time_s <- result$columns$time_s
  n <- length(time_s)
  if (is.null(rows) || n < 2L || result$info$kind != "none") return(result)
  between <- function(at) which(at > time_s[1] & at < time_s[n] & !at %in% time_s)
  new <- between(rows$columns$time_s)
  order <- order(c(time_s, rows$columns$time_s[new]))
  result$columns <- Map(
    function(column, more) c(column, more[new])[order], result$columns,
    rows$columns[names(result$columns)]
  )
  if (is.matrix(rows$ledger) && is.matrix(result$ledger)) { # by time
    new <- between(rows$ledger[, "time_s"])
    ledger <- rbind(result$ledger, rows$ledger[new, , drop = FALSE])
    result$ledger <- ledger[order(ledger[, "time_s"]), , drop = FALSE]
  }
  result
}

# The result with the column `event`: NA where there is none.
name_events <- function(result, events = result$events) {
  at <- as.double(events$time_s)
  words <- as.character(events$event)
  if (anyDuplicated(at)) {
    words <- vapply(split(words, match(at, unique(at))), paste, "", collapse = ", ")
    at <- unique(at)
  }
  result$columns$event <- unname(words)[match(result$columns$time_s, at)]
  result
}

# Whether the largest values of the motion may be far above those that the core found on the way,
# which does not know what was left out. The integrators know theirs.
suspicious <- function(info, record, accuracy, dropped) {
  error <- info$error
  (error > 1e-13 || error > accuracy) && is.finite(error) && is.null(record$adapts) &&
    !is.null(dropped)
}

# The error figure with the largest values at more times, unevenly spaced so that no period of the
# motion hides them. They are values of the motion, so the figure stays what it says.
measure_between_rows <- function(info, fit, time_s, accuracy, max_steps, call) {
  from <- min(fit$scene$start_s, time_s[1])
  to <- max(fit$scene$start_s, time_s[length(time_s)])
  between <- sort(from + (to - from) * (seq_len(256) * 0.6180339887498949) %% 1)
  more <- fit$record$run(fit$scene, between, accuracy, max_steps + 256, call, TRUE)$info
  if (more$kind != "none") return(info)
  info$sizes <- pmax(info$sizes, more$sizes)
  widen_error(info, 0 * info$errors)
}

# What the uncertainty of the bodies' moments of inertia does to the motion: list(inertia, effect),
# relative; NULL where they are known to rounding. By a second run for each body, at 65 times at
# most, with its moment changed by its error.
body_effect <- function(fit, time_s, accuracy, max_steps, call) {
  if (!length(time_s) || known_to_rounding(fit$scene)) return(NULL)
  off <- inertia_errors(fit$scene)
  known <- !is.finite(off) | off <= 1e-14
  rows <- unique(round(seq(1, length(time_s), length.out = min(65, length(time_s)))))
  times <- sort(c(time_s[rows], fit$scene$start_s + (max(time_s) - fit$scene$start_s) / 2))
  run <- function(scene) {
    fit$record$run(scene, times, accuracy, max_steps + length(times), call, TRUE)
  }
  measures <- constraint_of(fit$scene)$measures
  base <- run(fit$scene)
  effect <- 0 * base$info$sizes
  for (i in which(!known)) {
    moved <- run(with_moment(fit$scene, i, 1 + off[i]))
    if (base$info$kind != "none" || moved$info$kind != "none") {
      return(list(inertia = max(off[!known]), effect = NA_real_))
    }
    difference <- vapply(measures, function(measure) {
      max(abs(unlist(moved$columns[measure$columns]) - unlist(base$columns[measure$columns])))
    }, double(1))
    effect <- effect + difference[names(effect)]
  }
  list(
    inertia = max(off[!known]), effect = .Call(ffi_error_figure, effect, base$info$sizes)
  )
}

# A scene with moment of inertia i times `factor`: of its body, where it follows from that.
with_moment <- function(scene, i, factor) {
  constraint <- constraint_of(scene)
  bodies <- constraint$bodies
  scaled <- function(body, by = factor) {
    if (is.numeric(body)) return(by * body)
    body$second_moment_kg_m2 <- by * body$second_moment_kg_m2
    body
  }
  if (anyDuplicated(bodies)) { # the three principal moments of one
    moments <- scene$moment_of_inertia_kg_m2
    moments[i] <- factor * moments[i]
    scene$body <- new_principal(moments, scene$axes)
    scene$pivot_m <- NULL
  } else if (identical(bodies, "bodies")) {
    scene$bodies[[i]] <- scaled(scene$bodies[[i]])
  } else {
    # Of the moment about an axle, the part about the centre of mass is the body's.
    whole <- scene$moment_of_inertia_kg_m2[i]
    given <- scene[[bodies[i]]]
    double <- scene
    double[[bodies[i]]] <- scaled(given, 2)
    own <- .Call(ffi_scene_derived, constraint$id, double)$moment_of_inertia_kg_m2[i] - whole
    scene[[bodies[i]]] <- scaled(given, 1 + (factor - 1) * whole / own)
  }
  scene
}

# Whether the moments of inertia of a scene are known to rounding, or not at all.
known_to_rounding <- function(scene) {
  off <- inertia_errors(scene)
  is.null(off) || all(!is.finite(off) | off <= 1e-14)
}

# The relative error of each moment of inertia of a scene, NULL where all are known to rounding. A
# body's is relative to the sum of its second moments; numbers have none.
inertia_errors <- function(scene) {
  constraint <- constraint_of(scene)
  names <- constraint$bodies %||% "body"
  bodies <- .subset2(scene, "bodies") %||% unname(unclass(scene)[names])
  rough <- function(body) is.list(body) && isTRUE(.subset2(body, "error") > 1e-14)
  if (!any(vapply(bodies, rough, NA))) return(NULL)
  inertia <- if (is.null(constraint$moments)) {
    .subset2(scene, "moment_of_inertia_kg_m2")
  } else {
    constraint$moments(scene)
  }
  vapply(seq_along(inertia), function(i) {
    body <- if (i <= length(bodies)) bodies[[i]]
    if (!inherits(body, "rot_body") || !isTRUE(body$error > 1e-14)) return(0)
    body$error * sum(diag(body$second_moment_kg_m2)) / inertia[i]
  }, double(1))
}

# ---- the class ----------------------------------------------------------------------------------

new_trajectory <- function(columns, n, run) {
  attributes(columns) <- list(
    names = names(columns),
    run = run,
    class = c("rot_trajectory", "tbl_df", "tbl", "data.frame"),
    row.names = c(NA_integer_, -as.integer(n))
  )
  columns
}

# After a change of rows or columns: the class is kept with the key columns as numbers, the ledger
# with the rows. The error figure of the run holds for any of its rows; the error of values that the
# run did not compute is unknown.
reconstruct_trajectory <- function(data, template) {
  run <- trajectory_run(template)
  tibble_class <- c("tbl_df", "tbl", "data.frame")
  constraint <- if (is.list(run) && is.object(run$scene)) constraint_of(run$scene)
  now <- if (!is.null(constraint)) unclass(data)[constraint$keys]
  holds <- function(name) is_key(now[[name]]) || name %in% constraint$index && name %in% names(data)
  if (is.null(now) || !all(vapply(constraint$keys, holds, NA))) {
    attr(data, "run") <- NULL
    class(data) <- tibble_class
    return(data)
  }
  before <- unclass(template)[constraint$keys]
  if (!identical(now, before)) {
    run["ledger"] <- list(NULL)
    if (!rows_of_run(now, before, constraint$index)) run$info$error <- NA_real_
  } else if (!has_values_of_run(data, template, run)) {
    run$info$error <- NA_real_
  }
  attr(data, "run") <- run
  class(data) <- c("rot_trajectory", tibble_class)
  data
}

# Numbers, or whether a clutch is locked; NULL is a column that is not there.
is_key <- function(x) {
  (is.numeric(x) || is.logical(x)) && !is.factor(x)
}

# Of the columns that the model computes and that are still there.
has_values_of_run <- function(data, template, run) {
  columns <- intersect(computed_columns(template, run), names(data))
  identical(unclass(data)[columns], unclass(template)[columns])
}

# The columns of a motion that its constraint computes; others are the user's own.
computed_columns <- function(motion, run) {
  constraint <- constraint_of(run$scene)
  known <- c(
    constraint$columns, constraint$keys, constraint$index,
    if (!is.null(constraint$more_names)) constraint$more_names(run$scene), more_computed
  )
  intersect(names(motion), known)
}

more_computed <- c("event", "moment_of_inertia_kg_m2", "potential_energy_j", "inclination_rad")

# Whether all rows are rows of the run, matched by the bits of time and by index.
rows_of_run <- function(now, before, index) {
  identity <- function(x) {
    id <- match(x$time_s, before$time_s)
    for (name in index) {
      values <- unique(before[[name]])
      id <- id * (length(values) + 1) + match(x[[name]], values)
    }
    id
  }
  rows <- match(identity(now), identity(before))
  !anyNA(rows) && identical(now, lapply(before, `[`, rows))
}

#' @export
`[.rot_trajectory` <- function(x, ...) {
  out <- NextMethod()
  if (is.data.frame(out)) reconstruct_trajectory(out, x) else out
}

#' @export
`[<-.rot_trajectory` <- function(x, ..., value) reconstruct_trajectory(NextMethod(), x)

#' @export
`[[<-.rot_trajectory` <- function(x, ..., value) reconstruct_trajectory(NextMethod(), x)

#' @export
`$<-.rot_trajectory` <- function(x, name, value) reconstruct_trajectory(NextMethod(), x)

#' @export
`names<-.rot_trajectory` <- function(x, value) reconstruct_trajectory(NextMethod(), x)

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_trajectory <- function(data, template) {
  reconstruct_trajectory(data, template)
}

#' @exportS3Method tibble::as_tibble
as_tibble.rot_trajectory <- function(x, ...) {
  attr(x, "run") <- NULL
  class(x) <- setdiff(class(x), "rot_trajectory")
  tibble::as_tibble(x, ...)
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_trajectory <- function(x, ...) {
  run <- check_trajectory(x, "x", current_env())
  ends <- constraint_of(run$scene)$ends
  c(
    "A rotdyn trajectory" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)),
    "Scene" = scene_title(run$scene),
    "Model" = paste0(run$model, ", accuracy asked ", format(run$accuracy, digits = 3)),
    "Why" = describe_why(run),
    "Error" = describe_error(run),
    if (!is.null(run$info$step_s)) c("Steps" = paste(format_si(run$info$step_s), "s each")),
    if (!is.null(run$body)) c("Body" = describe_body_effect(run$body)),
    if (!is.null(record_of(run)$leaves_out)) c("Left out" = record_of(run)$leaves_out),
    if (!is.null(run$dropped)) {
      c("Dropped" = describe_dropped(run$dropped, constraint_of(run$scene)))
    },
    c("Not valid" = if (!is.null(ends)) ends(run$scene, x)),
    if (length(run$events$time_s)) c("Events" = describe_events(run$events)),
    if (!is.null(run$info$resolution)) {
      c("Law" = describe_resolution(run$info$resolution))
    } else if (!is.null(run$info$step_s) && is.function(run$scene[["torque"]])) {
      c("Law" = "an R function, called at the steps: what changes between them is missed")
    }
  )
}

describe_resolution <- function(resolution) {
  paste0(
    "an R function: changes narrower than ", format_si(100 * resolution), " % of the times, ",
    "angles and rates visited may be missed (`resolution`)"
  )
}

describe_why <- function(run) {
  if (isTRUE(run$asked)) "named in the call" else record_of(run)$why
}

describe_events <- function(events) {
  n <- length(events$time_s)
  first <- seq_len(min(4L, n))
  shown <- paste(events$event[first], "at", format_si(events$time_s[first]), "s")
  paste0(paste(shown, collapse = ", "), if (n > 4L) ", ...")
}

describe_body_effect <- function(body) {
  paste0(
    "its moment of inertia is known to ", format(body$inertia, digits = 2), ", which changes the ",
    "motion by about ", format(body$effect, digits = 2)
  )
}

describe_error <- function(run) {
  if (isTRUE(run$info$lost)) return("not known: the figure is larger than the motion")
  if (is.na(run$info$error)) return("unknown: the values are not those of the run")
  paste0(
    if (run$error_kind == "bound") "at most " else "about ",
    format(run$info$error, digits = 2), " (", run$error_kind, ")"
  )
}

# ---- verbs --------------------------------------------------------------------------------------

#' One row about a trajectory
#'
#' On an axle the maxima are those of the motion from the first row to the last, between the rows,
#' too: the model runs again where it turns. Of edited rows, of several bodies, of more than 10000
#' cycles, and where this run fails, they are over the rows as they are.
#'
#' @param object,x A `rot_trajectory`.
#' @param ... Not used.
#' @return A tibble of one row. On an axle, the columns `r describe_columns(summary_columns)`
#'   With several rotors the largest values are those of the whole shaft; a clutch has
#'   `r describe_columns(clutch_summary_columns)`
#'   instead of those before `model`.
#' @section Warnings: `rotdyn_warning_failed` if the model does not run again: the maxima are those
#'   of the rows.
#' @section Errors: none: the largest and the last of no rows are NA.
#' @seealso [audit()], [motion_events()], [predict.rot_trajectory()].
#' @concept maximum
#' @examples
#' summary(spin_up())
#' @export
summary.rot_trajectory <- function(object, ...) {
  call <- check_no_dots(...)
  run <- check_trajectory(object, "object", call)
  constraint <- constraint_of(run$scene)
  if (isTRUE(is.unsorted(object$time_s))) {
    object <- object[do.call(order, unclass(object)[c("time_s", constraint$index)]), ]
  }
  new_table(c(
    constraint$summary(object, run, call),
    list(
      model = run$model,
      accuracy = run$accuracy,
      error = run$info$error,
      error_kind = run$error_kind,
      steps = run$info$steps,
      rhs_calls = run$info$rhs_calls
    )
  ), nrow = 1L)
}

#' @rdname summary.rot_trajectory
#' @aliases glance
#' @rawNamespace export(glance)
#' @export
glance.rot_trajectory <- function(x, ...) {
  check_no_dots(...)
  summary(x)
}

#' The motion at other times
#'
#' Runs the trajectory's model again at these times, with the same accuracy and no interpolation.
#' Where the error of the model depends on the times (an effect ignored, a shaft taken as rigid),
#' the model is chosen again.
#'
#' @param object A `rot_trajectory`.
#' @param time_s Times in s, in any order, also outside the rows. NA gives a row of NA.
#' @param ... Not used.
#' @return A tibble with one row for each time (and rotor), in their order, and the columns of
#'   [trajectory()].
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_time` for infinite times, and those of
#'   [trajectory()].
#' @seealso [trajectory()], [time_when()].
#' @concept interpolate
#' @concept other times
#' @examples
#' predict(spin_up(), time_s = c(7.5, NA, 1 / 3))
#' @export
predict.rot_trajectory <- function(object, time_s, ...) {
  call <- current_env()
  if (missing(time_s)) check_supplied("time_s", call)
  check_no_dots(...)
  run <- check_trajectory(object, "object", call)
  scene <- run$scene
  constraint <- constraint_of(scene)
  time_s <- check_column(time_s, "time_s", "s", call)
  known <- which(!is.na(time_s))
  sorted <- known[order(time_s[known])]
  times <- check_times(time_s[sorted], call)
  check_span(scene, times, call)
  fit <- list(record = record_of(run), scene = run$solved, dropped = run$dropped)
  beyond <- !is.null(fit$dropped) && length(times) &&
    (times[1] < scene$start_s || times[length(times)] > fit$dropped$until_s)
  if (beyond || isTRUE(fit$record$on_trial)) {
    fit <- pick_model(scene, times, run$accuracy, NULL, run$max_steps, call)
  }
  why_not <- fit$record$why_not(fit$scene, times)
  if (!is.null(why_not)) {
    abort_rotdyn("Model {.val {run$model}} cannot do that: {why_not}.", "time", call)
  }
  rows <- tibble::as_tibble(run_trajectory(
    fit, scene, times, run$accuracy, "abort", run$max_steps, call, TRUE
  ))
  from <- rep(NA_integer_, length(time_s))
  from[sorted] <- seq_along(sorted)
  if (is.null(constraint$index)) return(rows[from, ])
  each <- constraint$rows_per_time(scene)
  out <- rows[as.vector(outer(seq_len(each) - each, each * from, `+`)), ]
  out[[constraint$index]] <- rep.int(seq_len(each), length(time_s))
  out
}

#' Events of a motion
#'
#' With dry friction: the body comes to rest (`stick`), breaks loose (`slip`), reverses without
#' sticking (`reverse`). Of a clutch: it locks (`lock`), slips (`slip`), or the slip changes sign
#' (`reverse`). What a spring or gravity pulls back turns (`turn`: omega changes its sign) and
#' passes its rest angle (`passage`): found in spans of up to 10000 cycles. The times of a closed
#' form are exact, those of an integration have the accuracy asked.
#'
#' On an incline: `roll`, `slip`, `reverse`, `slip_reverse`, `stick`, see [scene_incline()].
#'
#' Of a measured motion, the breaks that [estimate_motion()] found or was given: an `impact`, where
#' omega jumps; a `switch`, where its derivative jumps; a `stop`, behind which the body rests.
#'
#' @param x A `rot_trajectory`, or what [estimate_motion()] returned.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with the columns `r describe_columns(c("time_s", "event"))`
#'   of an estimate, `r describe_columns(estimate_event_columns)`
#'   and, of a [scene_drive()], `where`: the rotor or coupling. A motion that starts at rest, held
#'   or free, has no event at the start. Models without events give none.
#' @section Errors: `rotdyn_error_type`.
#' @seealso [time_when()] for the time of an angle or a rate, [stopping()], [period_of()].
#' @concept event
#' @concept stick and slip
#' @examples
#' wheel <- scene_axle(2, resistance = resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
#' motion_events(trajectory(wheel, time_s = 0:60))
#' motion_events(trajectory(scene_pendulum(body_point(1), 0.5, theta0_rad = 1), time_s = 0:3))
#' @concept turning point
#' @export
motion_events <- function(x, ...) {
  check_supplied("x", current_env())
  UseMethod("motion_events")
}

#' @export
motion_events.default <- function(x, ...) {
  check_class(
    x, "rot_trajectory", "x", "{.fn trajectory} and {.fn estimate_motion} give some.",
    current_env()
  )
}

#' @export
motion_events.rot_trajectory <- function(x, ...) {
  check_no_dots(...)
  run <- check_trajectory(x, "x", current_env())
  events_of(x, run, current_env())
}

# The events that the run logged, and those that are looked for in its motion.
events_of <- function(x, run, call) {
  events <- run$events
  out <- list(time_s = as.double(events$time_s), event = as.character(events$event))
  more <- constraint_of(run$scene)$more_events
  if (!is.null(more)) {
    more <- more(x, run, call)
    order <- order(c(out$time_s, more$time_s))
    out <- list(
      time_s = c(out$time_s, more$time_s)[order], event = c(out$event, more$event)[order]
    )
  }
  if (!is.null(events$where)) out$where <- events$where
  new_table(out, nrow = length(out$time_s))
}

#' Spin a body up
#'
#' Builds a [scene_axle()] and computes its [trajectory()]. With no argument it is the standard
#' example: a disk of 2 kg and 0.25 m, damped with 0.03 N m s, under a torque that rises to 0.8 N m
#' in 1 s, is constant for 3 s, falls to 0 in 2 s, and stays 0. A body of your own is not damped
#' unless `resistance` says so.
#'
#' @inheritParams scene_axle
#' @inheritParams trajectory
#' @return A `rot_trajectory`, as [trajectory()] gives.
#' @section Errors: those of [scene_axle()] and [trajectory()].
#' @source As for [trajectory()].
#' @seealso [scene_axle()] and [trajectory()], of which it is a shortcut; [spin_up_table()] for
#'   many.
#' @concept flywheel
#' @concept wheel
#' @concept motor
#' @concept angular acceleration
#' @examples
#' spin_up()
#' spin_up(body_sphere(5, 0.1), torque = 0.2, time_s = 0:10)
#' @export
spin_up <- function(body = body_disk(2, 0.25),
                    torque = torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)),
                    resistance = if (missing(body)) 0.03,
                    time_s = seq.int(0, 8, length.out = 1000), ...,
                    theta0_rad = 0, omega0_rad_per_s = 0, accuracy = 1e-9, model = NULL) {
  call <- environment()
  check_no_dots(...)
  if (is.numeric(resistance)) { # before `body` is given
    resistance <- new_resistance(check_number(resistance, "resistance", "N*m*s", call))
  }
  body <- body # given, for what describes the scene
  start_s <- 0
  axis <- c(0, 0, 1)
  through <- NULL
  scene <- scene_of_inputs("axle", call)
  say_axle_in_centre(scene)
  if (is.null(model) && identical(accuracy, 1e-9)) {
    motion <- quick_trajectory(scene, time_s)
    if (!is.null(motion)) return(motion)
  }
  compute_trajectory(scene, time_s, accuracy, model, "abort", 1e6, call)
}
