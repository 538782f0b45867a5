# The columns of `parameters`: unit, default, least value (open: not itself), largest value.
incline_parameters <- list(
  beta = list(unit = "1", lower = 0, open = TRUE),
  radius_m = list(unit = "m", lower = 0, open = TRUE),
  mass_kg = list(unit = "kg", default = 1, lower = 0, open = TRUE),
  incline_angle_deg = list(unit = "degree", lower = -90, upper = 90),
  gravity_m_per_s2 = list(unit = "m/s^2", default = 9.80665, lower = 0),
  static_friction = list(unit = "1", default = Inf, lower = 0, infinite = TRUE),
  kinetic_friction = list(unit = "1", lower = 0, infinite = TRUE),
  rolling_arm_m = list(unit = "m", default = 0, lower = 0),
  v0_m_per_s = list(unit = "m/s", default = 0),
  omega0_rad_per_s = list(unit = "rad/s"),
  time_s = list(unit = "s", lower = 0)
)

#' Many inclines, one row each
#'
#' One body on an incline for each row of `parameters`: the state at `time_s`, the heat until then,
#' and when rolling began, in one call of C. The physics is that of [scene_incline()].
#'
#' @param parameters A data frame. These columns are numbers of the scene, row by row: `beta`,
#'   `radius_m`, `incline_angle_deg` (needed); `static_friction` (Inf), `kinetic_friction` (the
#'   static one), `rolling_arm_m` (0), `v0_m_per_s` (0), `omega0_rad_per_s` (`v0/radius`: it starts
#'   rolling), `mass_kg` (1), `gravity_m_per_s2` (9.80665). Others are kept unchanged.
#' @param time_s How long each row lasts: one time, or one for each row; or NULL for a column
#'   `time_s` of `parameters`.
#' @param ... Not used; names after it must be given in full.
#' @param threads Most threads to use. The result does not depend on it, to the last bit.
#' @return `parameters` as a tibble (class `rot_incline_table`, with an `autoplot()`), with the
#'   columns
#'   `r describe_columns(incline_table_columns)`
#'   `error` is a bound. Paths begin at 0. A row with NA in what it needs has NA in these.
#' @section Warnings: `rotdyn_warning_range` names the rows that leave the range of double
#'   precision; they are NaN.
#' @section Errors: `rotdyn_error_type` (also for a column that is missing), `rotdyn_error_size`,
#'   `rotdyn_error_value` with the first row outside its domain (also a slip that an infinite
#'   kinetic friction would end at once), `rotdyn_error_unit`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4.
#' @seealso [scene_incline()], [roll_race()] for bodies released together, [rolling_table()].
#' @concept incline
#' @concept design
#' @examples
#' # How long does a bowling ball slide on lanes of different friction?
#' lanes <- data.frame(
#'   beta = 0.4, radius_m = 0.11, incline_angle_deg = 0, static_friction = c(0.05, 0.1, 0.2),
#'   v0_m_per_s = 8, omega0_rad_per_s = 0
#' )
#' incline_table(lanes, time_s = 3)
#' @export
incline_table <- function(parameters, time_s = NULL, ..., threads = 1) {
  call <- current_env()
  check_supplied("parameters", call)
  check_no_dots(...)
  check_parameters(parameters, call)
  threads <- floor(check_number(threads, "threads", "1", call, lower = 1))
  threads <- min(threads, .Call(ffi_axle_sweep_threads))
  known <- names(incline_parameters)
  given <- c(intersect(names(parameters), known), if (!is.null(time_s)) "time_s")
  check_near_columns(parameters, known, given, column_table()$name, call)
  columns <- incline_inputs(parameters, time_s, call)
  n <- nrow(parameters)
  out <- if (n) run_incline_table(columns, n, threads, call) else empty_incline_table()
  data <- table_from(parameters, "rot_incline_table")
  data[incline_table_columns] <- out[incline_table_columns]
  data
}

empty_incline_table <- function() {
  out <- rep(list(double()), length(incline_table_columns))
  names(out) <- incline_table_columns
  out$rolling <- logical()
  out
}

# The numbers of all rows, in SI units, each of length 1 or n.
incline_inputs <- function(parameters, time_s, call) {
  n <- nrow(parameters)
  columns <- lapply(names(incline_parameters), function(name) {
    known <- incline_parameters[[name]]
    given <- if (name == "time_s") time_s %||% parameters[[name]] else parameters[[name]]
    if (is.null(given)) return(known$default)
    given <- check_column(given, name, known$unit, call)
    if (length(given) != n && !(name == "time_s" && length(given) == 1L)) {
      abort_rotdyn(c(
        "{.field {name}} must have one number for each row.",
        x = "It has {length(given)}, and there are {n} row{?s}."
      ), "size", call)
    }
    given
  })
  names(columns) <- names(incline_parameters)
  for (name in c("beta", "radius_m", "incline_angle_deg", "time_s")) {
    if (is.null(columns[[name]])) {
      if (name == "time_s") check_supplied(name, call)
      abort_missing_column(
        name, parameters, call,
        if (name == "beta") "{.fn rolling_table} and {.fn shapes} have it for bodies."
      )
    }
  }
  if (is.null(columns$kinetic_friction)) columns$kinetic_friction <- columns$static_friction
  # NaN says that it starts rolling, so a missing one makes the row's time missing.
  if (is.null(columns$omega0_rad_per_s)) {
    columns$omega0_rad_per_s <- NaN
  } else if (anyNA(columns$omega0_rad_per_s)) {
    columns$time_s <- replace(
      rep_len(columns$time_s, n), is.na(columns$omega0_rad_per_s), NA_real_
    )
  }
  columns
}

run_incline_table <- function(columns, n, threads, call) {
  result <- .Call(ffi_incline_table, columns, threads, progress_bar("inclines"))
  out <- result[[1]]
  bad <- result[[2]]
  if (all(lengths(columns) == 1L)) {
    out <- lapply(out, rep_len, n)
    if (length(bad)) bad <- seq_len(n)
  }
  if (!length(bad)) return(out)
  at <- lapply(columns, function(x) if (length(x) == 1L) rep(x, length(bad)) else x[bad])
  rolls <- identical(columns$omega0_rad_per_s, NaN)
  missing <- Reduce(`|`, lapply(at[if (rolls) names(at) != "omega0_rad_per_s" else TRUE], is.na))
  for (name in names(incline_parameters)) {
    if (rolls && name == "omega0_rad_per_s") next
    check_incline_column(at[[name]], name, bad, missing, call)
  }
  less <- which(!missing & at$static_friction < at$kinetic_friction)
  if (length(less)) {
    abort_rotdyn(c(
      "{.field kinetic_friction} must be at most {.field static_friction}.",
      x = "It is larger in row {bad[less[1]]}."
    ), "value", call)
  }
  slip <- which(!missing & is.infinite(at$kinetic_friction) &
    abs(at$v0_m_per_s - at$radius_m * at$omega0_rad_per_s) >
      8 * .Machine$double.eps * abs(at$v0_m_per_s))
  if (length(slip)) {
    abort_rotdyn(c(
      "An infinite {.field kinetic_friction} ends the slip of the start at once.",
      x = "Row {bad[slip[1]]} starts with a slip."
    ), "value", call)
  }
  lost <- bad[!missing]
  if (length(lost)) {
    warn_rotdyn(c(
      "{length(lost)} row{?s} left the range of double precision.",
      i = "{cli::qty(length(lost))}Row{?s}
           {cli::cli_vec(format(lost, trim = TRUE), list('vec-trunc' = 6))} {?is/are} NaN."
    ), "range", call)
  }
  gone <- bad[missing]
  lapply(out, function(x) if (is.double(x)) replace(x, gone, NA_real_) else x)
}

check_incline_column <- function(x, name, rows, missing, call) {
  known <- incline_parameters[[name]]
  lower <- known$lower %||% -Inf
  upper <- known$upper %||% Inf
  open <- isTRUE(known$open)
  outside <- x < lower | x > upper | (open & x <= lower) |
    (is.infinite(x) & !isTRUE(known$infinite))
  first <- which(outside & !missing)[1]
  if (!is.na(first)) {
    abort_domain(x[first], name, known$unit, call, lower, upper, open, row = rows[first])
  }
}
