#' The path of an axis of a body
#'
#' Where an axis of the body points in space, row by row: the tip of a gyroscope's axis on the unit
#' sphere, its angle to the vertical (nutation) and its azimuth (precession). `autoplot()` draws the
#' path on the sphere.
#'
#' @param x A trajectory of a [scene_free()] or a [scene_pivot()], or any data frame with
#'   quaternions (`qw`, `qx`, `qy`, `qz`, body to space) and perhaps `time_s`.
#' @param axis The axis, in the body: `"x"`, `"y"`, `"z"`, or three numbers, of any length but 0.
#' @param ... Not used; names after it must be given in full.
#' @return A tibble with a row for each row of `x`: `time_s` where `x` has it, then
#'   `r describe_columns(axis_path_columns)`
#'   The azimuth goes on beyond a turn where rows are less than half a turn apart; it is NaN where
#'   the axis is vertical. NA gives NA.
#' @section Errors: `rotdyn_error_type` (a column is missing), `rotdyn_error_size`,
#'   `rotdyn_error_value`, `rotdyn_error_argument`, `rotdyn_error_missing`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.7.
#' @seealso [polhode()] for the path of the angular velocity in the body, [precession_table()].
#' @concept precession
#' @concept nutation
#' @concept spinning top
#' @concept path of the axis
#' @examples
#' tilted <- attitude_from(c(1, 0, 0, pi / 3), "axis_angle")
#' wheel <- scene_pivot(
#'   c(0.02, 0.02, 0.03), c(0, 0, 60), mass_kg = 2, centre_m = c(0, 0, 0.1), attitude0 = tilted
#' )
#' path <- axis_path(trajectory(wheel, seq(0, 2, by = 0.005)))
#' path
#' if (requireNamespace("ggplot2", quietly = TRUE)) ggplot2::autoplot(path)
#' @export
axis_path <- function(x, axis = "z", ...) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  if (!is.data.frame(x)) {
    abort_rotdyn(c(
      "{.arg x} must be a trajectory with quaternions.", x = "It is {describe_value(x)}."
    ), "type", call)
  }
  for (name in quaternion_columns) if (is.null(x[[name]])) abort_missing_column(name, x, call)
  along <- unit_axis(as_axis(axis, call), call)
  q <- as_attitude(unclass(x)[quaternion_columns], "x", call)
  tip <- .Call(ffi_attitude_turn, unname(c(q, as.list(along))), 1)
  across <- sqrt(tip[[1]]^2 + tip[[2]]^2)
  azimuth <- atan2(tip[[2]], tip[[1]])
  azimuth[across == 0] <- NaN
  out <- c(
    if (!is.null(x[["time_s"]])) list(time_s = x[["time_s"]]),
    stats::setNames(
      c(tip[1:3], list(atan2(across, tip[[3]]), unwrap(azimuth))), axis_path_columns
    )
  )
  new_table(out, nrow = nrow(x), class = "rot_axis_path")
}

# Angles that go on beyond a turn, each less than half a turn from the known one before.
unwrap <- function(angle) {
  known <- which(is.finite(angle))
  if (length(known) < 2L) return(angle)
  turns <- round(diff(angle[known]) / (2 * pi))
  angle[known] <- angle[known] - 2 * pi * c(0, cumsum(turns))
  angle
}
