#' Many tumbling bodies, one row each
#'
#' Where each of many free bodies is at a time: attitude and angular velocity in closed form, in one
#' call of C, by several threads.
#'
#' @param parameters A data frame with the principal moments of inertia `ixx_kg_m2`, `iyy_kg_m2`,
#'   `izz_kg_m2` about the body's axes and the angular velocity in them at the start,
#'   `omega_x_rad_per_s`, `omega_y_rad_per_s`, `omega_z_rad_per_s`; and the attitude at the start,
#'   `qw`, `qx`, `qy`, `qz`, unless the axes coincide. Others are kept unchanged.
#' @param time_s Time since the start in s, of any sign: one, or one for each row.
#' @param ... Not used; names after it must be given in full.
#' @param threads Most threads to use. The result does not depend on it, to the last bit.
#' @return `parameters` as a tibble, with the columns
#'   `r describe_columns(tumbling_columns)`
#'   `error` is a bound on the angle of the attitude's error, in rad; within it the row is that of
#'   [trajectory()], whose last bits may differ. A row with NA has NA in these,
#'   and so has one without a motion: a negative or infinite number, a spin about an axis without
#'   moment of inertia, moments in a ratio of 1e100 or more. Moments that no body has (one exceeds
#'   the sum of the others) are computed like others: [check_inertia()] finds them.
#' @section Errors: `rotdyn_error_type` (also for a column that is missing), `rotdyn_error_size`,
#'   `rotdyn_error_value`, `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source As for [scene_free()].
#' @seealso [scene_free()] for one body at many times, [flip_time()].
#' @concept tumbling
#' @examples
#' debris <- data.frame(
#'   ixx_kg_m2 = 1, iyy_kg_m2 = 2, izz_kg_m2 = 2.5,
#'   omega_x_rad_per_s = 0.01, omega_y_rad_per_s = 1:3, omega_z_rad_per_s = 0
#' )
#' tumbling_table(debris, time_s = 86400)
#' @export
tumbling_table <- function(parameters, time_s, ..., threads = 1) {
  call <- check_no_dots(...)
  check_supplied(c("parameters", "time_s"), call)
  if (!is.data.frame(parameters)) {
    abort_rotdyn(
      c("{.arg parameters} must be a data frame.", x = "It is {describe_value(parameters)}."),
      "type", call
    )
  }
  n <- nrow(parameters)
  needed <- c("ixx_kg_m2", "iyy_kg_m2", "izz_kg_m2", free_rates(""))
  attitude <- if (any(quaternion_columns %in% names(parameters))) quaternion_columns
  missing <- setdiff(c(needed, attitude), names(parameters))
  if (length(missing)) abort_missing_column(missing[1], parameters, call)
  units <- c(rep("kg*m^2", 3), rep("rad/s", 3), rep("1", 4))
  columns <- Map(
    function(name, unit) check_column(parameters[[name]], name, unit, call),
    c(needed, attitude), units[seq_along(c(needed, attitude))]
  )
  if (is.null(attitude)) columns <- c(columns, list(qw = 1, qx = 0, qy = 0, qz = 0))
  columns$time_s <- check_column(time_s, "time_s", "s", call)
  if (!length(columns$time_s) %in% c(1L, n)) {
    abort_rotdyn(c(
      "{.arg time_s} must have one time, or one for each row.",
      x = "It has {length(columns$time_s)}, and there are {n} rows."
    ), "size", call)
  }
  threads <- floor(check_number(threads, "threads", "1", call, lower = 1))
  threads <- min(threads, .Call(ffi_axle_sweep_threads))
  out <- .Call(ffi_free_table, columns, threads, progress_bar("tumbling"))
  out <- lapply(out, function(x) if (anyNA(x)) replace(x, is.nan(x), NA_real_) else x)
  data <- table_from(parameters)
  data[tumbling_columns] <- out
  attr(data, "first") <- tumbling_columns
  data
}
