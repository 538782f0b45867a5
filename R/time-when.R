#' When a motion reaches a value
#'
#' The times at which a column of the motion has a value: when does the wheel turn at 10 rad/s, when
#' does the pendulum pass the lowest point? The model runs again at the times in question, so the
#' times have the model's accuracy, not that of the rows.
#'
#' @param x A trajectory, searched from its first to its last row; or a scene, searched from its
#'   start on.
#' @param ... One column and its value, such as `omega_rad_per_s = 10`; and for several bodies which
#'   one, `rotor = 2`. Values may have units.
#' @param occurrence `"first"` or `"all"`.
#' @param until_s Where the search ends. Needed for all occurrences in a scene; without it the first
#'   is searched in spans that grow until the motion must have shown it: 1000 cycles of what swings
#'   alone, a million million times the slowest of the motion's times else (1000 times that for an
#'   integrator).
#' @param accuracy That of [trajectory()], for a scene.
#' @return A tibble with `time_s`, `direction` (`"up"`, `"down"`; `"reached"` where the value is
#'   there at the start, is only touched, or stays) and the other columns of the motion at that
#'   time. The first occurrence is one row, of NA if there is none; all of them may be no row.
#'   Where the motion stays at the value (a wheel at rest) the time is the first one.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_unit`;
#'   `rotdyn_error_time` for a span of more than 10000 cycles; those of [trajectory()].
#' @source Chandrupatla, Advances in Engineering Software 28 (1997) 145, for the zeros.
#' @seealso [period_of()], [stopping()], [motion_events()].
#' @concept event
#' @concept period
#' @examples
#' time_when(spin_up(), omega_rad_per_s = 10)
#' time_when(spin_up(), omega_rad_per_s = 10, occurrence = "all")
#' # The passages and the turning points of a damped pendulum.
#' swing <- scene_pendulum(body_point(1), 0.8, resistance(0.1), theta0_rad = 2)
#' time_when(swing, theta_rad = 0, occurrence = "all", until_s = 6)
#' time_when(swing, omega_rad_per_s = 0, occurrence = "all", until_s = 6)
#' @export
time_when <- function(x, ..., occurrence = c("first", "all"), until_s = NULL, accuracy = 1e-9) {
  call <- current_env()
  check_supplied("x", call)
  occurrence <- if (missing(occurrence)) {
    "first"
  } else {
    check_string(occurrence, "occurrence", c("first", "all"), call)
  }
  first <- occurrence == "first"
  if (inherits(x, "rot_trajectory")) {
    run <- check_trajectory(x, "x", call)
    asked <- asked_value(run$scene, list(...), call)
    if (!is.null(until_s)) {
      abort_rotdyn(c(
        "{.arg until_s} is for a scene.",
        i = "A trajectory is searched from its first to its last row."
      ), "type", call)
    }
    check_column_of_run(asked$column, x, run, call)
    span <- if (nrow(x)) range(x$time_s) else double()
    return(answer_when(search_run(run, asked, span, call), run, asked, first, call))
  }
  check_class(x, "rot_scene", "x", "Give a scene or a {.fn trajectory}.", call)
  check_scene(x, call)
  asked <- asked_value(x, list(...), call)
  warn_of_end(x, NULL, call)
  when_in_scene(x, asked, first, until_s, accuracy, call)
}

when_in_scene <- function(scene, asked, first, until_s, accuracy, call) {
  run_to <- function(from, to) {
    motion <- compute_trajectory(scene, c(from, to), accuracy, NULL, "abort", 1e6, call)
    check_column_of_run(asked$column, motion, trajectory_run(motion), call)
    trajectory_run(motion)
  }
  start <- scene$start_s
  if (!is.null(until_s)) {
    until_s <- check_number(until_s, "until_s", "s", call, lower = start)
    run <- run_to(start, until_s)
    return(answer_when(search_run(run, asked, c(start, until_s), call), run, asked, first, call))
  }
  if (!first) {
    abort_rotdyn(c(
      "{.arg until_s} is needed for all occurrences.", i = "A motion has no end of its own."
    ), "type", call)
  }
  # Its sizes alone count: the error of a motion without a span does not.
  heard <- NULL
  quietly <- function(expr) {
    heard <<- NULL
    withCallingHandlers(expr, rotdyn_warning_accuracy = function(w) {
      heard <<- w
      invokeRestart("muffleWarning")
    })
  }
  run <- quietly(run_to(start, start))
  time_scales <- time_scales_of(run)
  marks <- time_scales$breaks_s[time_scales$breaks_s > start] - start
  swing <- if (time_scales$swing_rad_per_s > 0) 2 * pi / time_scales$swing_rad_per_s
  times <- c(swing, marks, time_scales$fades_s, if (is.null(swing)) 1)
  times <- times[is.finite(times) & times > 0]
  closed <- !isTRUE(record_of(run)$adapts)
  swings <- !is.null(swing) && !isTRUE(time_scales$drifts)
  maximum <- if (swings) 1e3 * swing + 10 * max(times) else
    if (closed) 1e12 * max(times) else 1e3 * max(times)
  from <- start
  reach <- min(times)
  repeat {
    to <- start + min(reach, maximum)
    run <- quietly(run_to(from, to))
    found <- search_run(run, asked, c(from, to), call)
    if (length(found$time_s) || reach >= maximum) break
    if (closed) from <- to
    reach <- 4 * reach
  }
  if (!is.null(heard)) warning(heard)
  answer_when(found, run, asked, TRUE, call)
}

# list(column, value, body): what the dots say.
asked_value <- function(scene, dots, call) {
  constraint <- constraint_of(scene)
  index <- constraint$index
  columns <- setdiff(names(dots), index)
  if (length(columns) != 1L || !nzchar(columns) || anyDuplicated(names(dots))) {
    abort_rotdyn(c(
      "Name one column and its value.", i = "Such as {.code time_when(x, omega_rad_per_s = 10)}."
    ), "type", call)
  }
  body <- 1L
  if (!is.null(index)) {
    maximum <- constraint$rows_per_time(scene)
    if (is.null(dots[[index]]) && maximum > 1L) {
      abort_rotdyn(c(
        "Name the body, too.", i = "Such as {.code {index} = 2}, from 1 to {maximum}."
      ), "type", call)
    }
    body <- as.integer(check_whole(dots[[index]] %||% 1, index, call, 1, maximum))
  }
  # Those of shaft 3, 4, ... are listed as those of 2.
  listed <- sub("^rotor_[0-9]+_", "rotor_1_", sub("^(theta|omega)_[0-9]+_", "\\1_2_", columns))
  unit <- column_table()$unit[match(listed, column_table()$name)]
  unit <- if (is.na(unit) || !nzchar(unit)) "1" else gsub(" ", "*", unit, fixed = TRUE)
  list(column = columns, value = check_number(dots[[columns]], columns, unit, call), body = body)
}

# A column that the model gives, with numbers in it.
check_column_of_run <- function(column, x, run, call) {
  constraint <- constraint_of(run$scene)
  fit <- vapply(unclass(x), is.double, NA)
  known <- intersect(names(x)[fit], c(
    constraint$columns, "moment_of_inertia_kg_m2",
    if (!is.null(constraint$more_names)) constraint$more_names(run$scene)
  ))
  known <- setdiff(known, c("time_s", constraint$index))
  if (column %in% known) return(invisible())
  abort_rotdyn(c(
    "{.field {column}} is not a column of numbers of this motion.",
    i = "Those are {.field {known}}."
  ), "value", call)
}

search_run <- function(run, asked, span, call) {
  if (!length(span)) return(list(time_s = double(), direction = character()))
  grid <- if (span[1] == span[2]) span[1] else search_times(run, span[1], span[2])
  if (is.null(grid)) {
    abort_rotdyn(c(
      "The span has too many cycles to be searched, more than 10000.",
      i = "Shorten it, or use {.fn period_of}."
    ), "time", call)
  }
  constraint <- constraint_of(run$scene)
  read <- motion_reader(run, asked$body, call)
  slopes <- if (!is.null(constraint$slopes)) function(x) constraint$slopes(x, run$scene)
  passages(read, slopes, asked$column, asked$value, grid, column_error(run, asked$column))
}

answer_when <- function(found, run, asked, first, call) {
  if (first) found <- lapply(found, `[`, 1L) # NA where there is none
  known <- !is.na(found$time_s)
  read <- motion_reader(run, asked$body, call)
  rows <- read(found$time_s[known])
  rows <- lapply(rows, function(column) {
    out <- column[rep(NA_integer_, length(known))]
    out[known] <- column
    out
  })
  rows$time_s <- NULL
  new_table(
    c(list(time_s = found$time_s, direction = found$direction), rows), nrow = length(known)
  )
}
