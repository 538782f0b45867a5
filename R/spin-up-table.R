# The columns of `parameters` that are numbers of a scene: unit, default.
spin_up_parameters <- list(
  moment_of_inertia_kg_m2 = list("kg*m^2", NULL),
  viscous_n_m_s = list("N*m*s", 0),
  torque_scale = list("1", 1),
  omega0_rad_per_s = list("rad/s", 0),
  theta0_rad = list("rad", 0),
  quadratic_n_m_s2 = list("N*m*s^2", 0),
  coulomb_n_m = list("N*m", 0),
  static_n_m = list("N*m", NULL)
)

#' Many spin-ups, one row each
#'
#' One scene on a fixed axle for each row of `parameters`, all under the same torque law: the final
#' state of each, and its extreme speeds, in one call of C. The extremes are those of the continuous
#' motion, where `d(omega)/dt = 0`.
#'
#' @param parameters A data frame. These columns are numbers of the scene, row by row:
#'   `moment_of_inertia_kg_m2` (needed, > 0), `viscous_n_m_s`, `quadratic_n_m_s2`, `coulomb_n_m` (0
#'   where they are not given), `static_n_m` (`coulomb_n_m`), `torque_scale` (1: a factor on the
#'   torque), `omega0_rad_per_s`, `theta0_rad` (0). Others are kept unchanged.
#' @param torque A torque law, as in [scene_axle()], but no R function: see [torque-terms].
#' @param time_s When each row ends: one time, or one for each row, not before `start_s`; or NULL
#'   for a column `time_s` of `parameters`.
#' @param ... Not used; names after it must be given in full.
#' @param start_s Time at which all begin.
#' @param threads Most threads to use. The result does not depend on it, to the last bit.
#' @return `parameters` as a tibble (class `rot_spin_up_table`, with an `autoplot()`), with the
#'   columns
#'   `r describe_columns(spin_up_table_columns)`
#'   A row with NA in what it needs has NA in these. Where dry friction, quadratic drag or terms
#'   beyond knots are in play, `max_omega_time_s` is NaN; with terms beyond knots, the extremes too.
#' @section Warnings: `rotdyn_warning_range` names the rows that leave the range of double
#'   precision; they are NaN.
#' @section Errors: `rotdyn_error_type` (also for a column that is missing), `rotdyn_error_size`,
#'   `rotdyn_error_value` with the row, `rotdyn_error_time`; `rotdyn_error_model` for a law that no
#'   closed form takes.
#' @source As for [trajectory()]: see [models()].
#' @seealso [spin_up()], [inertia_table()], [autoplot.rot_spin_up_table()].
#' @concept flywheel
#' @concept design
#' @examples
#' designs <- data.frame(
#'   name = c("light", "heavy", "oily"),
#'   moment_of_inertia_kg_m2 = c(0.05, 0.2, 0.05),
#'   viscous_n_m_s = c(0.03, 0.03, 0.3)
#' )
#' law <- torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
#' spin_up_table(designs, law, time_s = 8)
#' @export
spin_up_table <- function(parameters, torque = NULL, time_s = NULL, ..., start_s = 0,
                          threads = 1) {
  call <- current_env()
  check_supplied("parameters", call)
  check_no_dots(...)
  check_parameters(parameters, call)
  n <- nrow(parameters)
  start_s <- check_number(start_s, "start_s", "s", call)
  threads <- floor(check_number(threads, "threads", "1", call, lower = 1))
  threads <- min(threads, .Call(ffi_axle_sweep_threads))
  torque <- as_torque(torque, call)
  known_columns <- c(names(spin_up_parameters), "time_s")
  given <- c(intersect(names(parameters), known_columns), if (!is.null(time_s)) "time_s")
  check_near_columns(parameters, known_columns, given, column_table()$name, call)
  columns <- spin_up_inputs(parameters, time_s, call)
  known <- rep(TRUE, n)
  some_missing <- any(vapply(columns, anyNA, logical(1)))
  if (some_missing) known <- Reduce(`&`, lapply(columns, function(x) rep_len(!is.na(x), n)), known)
  check_spin_up_rows(columns, known, start_s, call)
  if (some_missing) {
    # A row with a missing number runs with a harmless one, and is set to NA after.
    columns[] <- Map(function(x, name) {
      if (anyNA(x)) {
        replace(x, is.na(x), if (name %in% c("moment_of_inertia_kg_m2", "torque_scale")) 1 else 0)
      } else {
        x
      }
    }, columns, names(columns))
    columns$time_s <- replace(rep_len(columns$time_s, n), !known, start_s)
  }
  result <- if (n) run_spin_ups(torque, columns, start_s, threads, call) else empty_spin_ups()
  out <- result[[1]]
  failed <- which(result[[2]] != 0L & known)
  if (some_missing) out <- lapply(out, function(x) replace(x, !known, NA_real_))
  if (length(failed)) {
    warn_rotdyn(c(
      "{length(failed)} row{?s} left the range of double precision.",
      i = "{cli::qty(length(failed))}Row{?s}
           {cli::cli_vec(format(failed, trim = TRUE), list('vec-trunc' = 6))} {?is/are} NaN."
    ), "range", call)
  }
  data <- table_from(parameters, "rot_spin_up_table")
  data[spin_up_table_columns] <- out
  data
}

empty_spin_ups <- function() {
  list(rep(list(double()), length(spin_up_table_columns)), integer())
}

# The numbers of all rows, in SI units, each of length 1 or n.
spin_up_inputs <- function(parameters, time_s, call) {
  n <- nrow(parameters)
  if (is.null(parameters[["moment_of_inertia_kg_m2"]])) {
    abort_missing_column(
      "moment_of_inertia_kg_m2", parameters, call,
      "{.fn inertia_table} computes it for the standard shapes."
    )
  }
  columns <- lapply(names(spin_up_parameters), function(name) {
    unit <- spin_up_parameters[[name]][[1]]
    given <- parameters[[name]]
    if (is.null(given)) return(spin_up_parameters[[name]][[2]])
    given <- check_column(given, name, unit, call)
    if (length(given) != n) {
      abort_rotdyn("Column {.field {name}} must have one number in each row.", "size", call)
    }
    given
  })
  names(columns) <- names(spin_up_parameters)
  if (is.null(columns$static_n_m)) columns$static_n_m <- columns$coulomb_n_m
  if (is.null(time_s)) time_s <- parameters[["time_s"]]
  if (is.null(time_s)) {
    abort_rotdyn(c(
      "{.arg time_s} is missing: the end of each row.",
      i = "Give one time, one for each row, or a column {.field time_s}."
    ), "missing", call)
  }
  columns$time_s <- check_column(time_s, "time_s", "s", call)
  if (!length(columns$time_s) %in% c(1L, n)) {
    abort_rotdyn(c(
      "{.arg time_s} must have one time, or one for each row.",
      x = "It has {length(columns$time_s)}, and there are {n} rows."
    ), "size", call)
  }
  columns
}

check_spin_up_rows <- function(columns, known, start_s, call) {
  first <- function(bad) which(bad & known)[1]
  for (name in names(columns)) {
    x <- columns[[name]]
    minimum <- if (name %in% c("quadratic_n_m_s2", "coulomb_n_m", "static_n_m")) 0 else -Inf
    open <- name == "moment_of_inertia_kg_m2"
    if (length(x) == 0L || (all(is.finite(x)) && min(x) >= minimum && !(open && min(x) <= 0))) next
    bad <- first(rep_len(!is.finite(x) | x < minimum | (open & x <= 0), length(known)))
    if (!is.na(bad)) {
      value <- rep_len(x, length(known))[bad]
      unit <- if (name == "time_s") "s" else spin_up_parameters[[name]][[1]]
      abort_domain(value, name, unit, call, if (open) 0 else minimum, Inf, open, row = bad)
    }
  }
  bad <- if (any(columns$time_s < start_s, na.rm = TRUE)) {
    first(rep_len(columns$time_s < start_s, length(known)))
  } else {
    NA
  }
  if (!is.na(bad)) {
    abort_rotdyn(c(
      "{.arg time_s} must not lie before {.arg start_s}.",
      x = "Row {bad} ends at {format(rep_len(columns$time_s, length(known))[bad])} s, all begin
           at {format(start_s)} s."
    ), "time", call)
  }
  slips <- columns$static_n_m < columns$coulomb_n_m
  bad <- if (any(slips, na.rm = TRUE)) first(rep_len(slips, length(known))) else NA
  if (!is.na(bad)) {
    abort_rotdyn(
      "{.arg static_n_m} must be at least {.arg coulomb_n_m}: it is less in row {bad}.",
      "value", call
    )
  }
}

run_spin_ups <- function(torque, columns, start_s, threads, call) {
  loads <- torque_loads(torque)
  friction <- any(columns$static_n_m != 0)
  quadratic <- any(columns$quadratic_n_m_s2 != 0)
  # The effects of all rows together.
  scene <- bare_axle(torque, start_s, new_resistance(
    (if (any(columns$viscous_n_m_s < 0)) min else max)(columns$viscous_n_m_s),
    quadratic * 1, friction * 1, friction * 1
  ))
  linear <- !friction && !quadratic && length(loads$terms) == 0L && is.null(loads$law)
  if (linear) {
    # A motor's slope is part of the torque law, so the factor scales it too.
    if (loads$motor_n_m_s != 0) {
      columns$viscous_n_m_s <- columns$viscous_n_m_s + columns$torque_scale * loads$motor_n_m_s
    }
    model <- "axle_linear"
  } else {
    model <- spin_up_model(scene, loads, columns, call)
  }
  .Call(ffi_axle_sweep, model, scene, columns, threads, progress_bar("sweep"))
}

# The closed form that takes what acts in any of the rows.
spin_up_model <- function(scene, loads, columns, call) {
  fits <- core_candidates("axle", scene, scene$start_s, 1)
  takes <- fits$applies & fits$error_kind == "bound" & lengths(fits$dropped) == 0L &
    !fits$model %in% c("axle_free", "axle_linear")
  scaled <- any(columns$torque_scale != 1) &&
    (length(loads$terms) || loads$motor_n_m_s != 0)
  if (!any(takes) || scaled) {
    abort_rotdyn(c(
      "There is no closed form for these rows ({scene_words(scene)}).",
      i = if (scaled) {
        "{.field torque_scale} scales knots only: scale the law itself, {.code 2 * law}."
      } else {
        "{.fn trajectory} integrates one scene at a time."
      }
    ), "model", call)
  }
  fits$model[takes][1]
}
