#' Rotations
#'
#' The rotation by an angle about an axis, as the 3 x 3 matrix that turns vectors: `v_space = R
#' v_body`. Its columns are the body's axes in space.
#'
#' \deqn{R = 1 + \sin\phi\,[n]_\times + (1 - \cos\phi)\,[n]_\times^2}{
#'   R = 1 + sin(phi) [n x] + (1 - cos(phi)) [n x]^2}
#'
#' @param axis Direction of the axis: `"x"`, `"y"`, `"z"`, or three numbers of any length but 0.
#' @param ... Not used: the angle is given by name, so that its unit is stated.
#' @param angle_rad,angle_deg The angle, right-handed about the axis: one of the two. Quarter turns
#'   in degrees are exact.
#' @return A 3 x 3 matrix, orthogonal to two roundings.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf,
#'   an axis of length 0, two angles), `rotdyn_error_unit`, `rotdyn_error_missing` for no angle.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 4.7.
#' @seealso [place_body()], [inertia_tensor()], [convert_angle()].
#' @concept rotation matrix
#' @examples
#' rotation_about("z", angle_deg = 90)
#' @export
rotation_about <- function(axis, ..., angle_rad = NULL, angle_deg = NULL) {
  call <- check_no_dots(...)
  check_supplied("axis", call)
  if (is.null(angle_rad) == is.null(angle_deg)) {
    abort_rotdyn(
      "Exactly one of {.arg angle_rad} and {.arg angle_deg} must be given.",
      if (is.null(angle_rad)) "missing" else "value", call
    )
  }
  n <- unit_axis(as_axis(axis, call), call)
  # 1 - cos from the half angle, without cancellation.
  if (is.null(angle_deg)) {
    angle <- check_number(angle_rad, "angle_rad", "rad", call)
    sine <- sin(angle)
    versine <- 2 * sin(angle / 2)^2
  } else {
    # In C, where the reduction is exact.
    angle <- check_number(angle_deg, "angle_deg", "degree", call)
    sine <- .Call(ffi_inertia_sine, angle)
    versine <- 2 * .Call(ffi_inertia_sine, angle / 2)^2
  }
  # Quarter turns: the rounded square of the sine of 45 degrees is not 1/2.
  if (abs(sine) == 1) versine <- 1
  cross <- matrix(c(0, n[3], -n[2], -n[3], 0, n[1], n[2], -n[1], 0), 3)
  diag(3) + sine * cross + versine * (cross %*% cross)
}

# "x", "y", "z" or three numbers.
as_axis <- function(axis, call) {
  if (is.character(axis)) {
    axis <- check_string(axis, "axis", c("x", "y", "z"), call)
    as.double(c("x", "y", "z") == axis)
  } else {
    axis
  }
}

unit_axis <- function(axis, call) {
  axis <- check_finite(axis, "axis", "1", call)
  if (length(axis) != 3L || all(axis == 0)) {
    abort_rotdyn("{.arg axis} must be three numbers, not all 0.", "value", call)
  }
  # What is a unit vector within rounding keeps its bits.
  if (isTRUE(abs(sum(axis^2) - 1) <= 4 * .Machine$double.eps)) return(axis)
  axis <- axis / max(abs(axis))
  axis / sqrt(sum(axis^2))
}

# A rotation as a matrix: NULL (none), a 3 x 3 matrix, or a quaternion, scalar first, body to space.
as_rotation <- function(rotation, arg, call) {
  if (is.null(rotation)) return(diag(3))
  if (is.data.frame(rotation)) {
    q <- as_attitude(rotation, arg, call)
    if (length(q[[1]]) != 1L) {
      abort_rotdyn(c(
        "{.arg {arg}} must be one attitude.", x = "It has {length(q[[1]])} rows."
      ), "size", call)
    }
    rotation <- unlist(q, use.names = FALSE)
  }
  size <- dim(rotation) %||% length(rotation)
  if (!is.numeric(rotation) || is.object(rotation) ||
    !(identical(size, c(3L, 3L)) || identical(size, 4L))) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a 3 x 3 rotation matrix, a quaternion (scalar first), or a row of
       {.fn attitude_from}.",
      x = "It is {describe_value(rotation)}.",
      i = "See {.fn rotation_about}."
    ), "type", call)
  }
  if (!all(is.finite(rotation))) abort_rotdyn("{.arg {arg}} must be finite.", "value", call)
  if (length(rotation) == 4L) return(matrix_of_quaternion(as.double(rotation), arg, call))
  rotation <- matrix(as.double(rotation), 3)
  square <- product_of_three(t(rotation), rotation)
  off <- max(abs(square - diag(3)))
  if (off > 1e-8 || det(rotation) < 0) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a rotation: orthogonal, with determinant +1.",
      x = if (off > 1e-8) {
        "R'R differs from 1 by {format(off, digits = 3)}."
      } else {
        "Its determinant is -1: a reflection."
      }
    ), "value", call)
  }
  # One Newton step to the nearest orthogonal matrix, for numbers given with few digits.
  product_of_three(rotation, 3 * diag(3) - square) / 2
}

# Of two 3 x 3 matrices, with the additions of the core in their order, whatever BLAS is here.
product_of_three <- function(a, b) {
  outer(a[, 1], b[1, ]) + outer(a[, 2], b[2, ]) + outer(a[, 3], b[3, ])
}

matrix_of_quaternion <- function(q, arg, call) {
  norm <- sqrt(sum(q^2))
  if (!(abs(norm - 1) <= 1e-8)) {
    abort_rotdyn(
      c("{.arg {arg}} must be a unit quaternion.", x = "Its norm is {format(norm, digits = 7)}."),
      "value", call
    )
  }
  q <- q / norm
  v <- q[2:4]
  cross <- matrix(c(0, v[3], -v[2], -v[3], 0, v[1], v[2], -v[1], 0), 3)
  diag(3) + 2 * q[1] * cross + 2 * (cross %*% cross)
}

# Two unit vectors across the axle, turned by theta about it: right-handed with the axle.
across_axle <- function(axis, theta) {
  axis <- axis / sqrt(sum(axis^2))
  start <- diag(3)[, if (abs(axis[3]) > 0.9) 1L else 3L]
  first <- start - sum(start * axis) * axis
  first <- first / sqrt(sum(first^2))
  second <- c(
    axis[2] * first[3] - axis[3] * first[2], axis[3] * first[1] - axis[1] * first[3],
    axis[1] * first[2] - axis[2] * first[1]
  )
  plane <- cbind(first, second)
  plane %*% rbind(c(cos(theta), sin(theta)), c(-sin(theta), cos(theta)))
}
