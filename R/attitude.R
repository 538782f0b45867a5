#' Attitudes
#'
#' An attitude is how a body is turned against space. The package holds it as a unit quaternion,
#' scalar first, that takes body axes to space: `v_space = q v_body q*`. These functions convert it,
#' row by row.
#'
#' | form | columns | meaning |
#' |---|---|---|
#' | `"quaternion"` | `qw, qx, qy, qz` | `(cos(phi/2), n sin(phi/2))` |
#' | `"matrix"` | `r11, r12, r13, r21, ..., r33` | `v_space = R v_body`; row, then column |
#' | `"rotation_vector"` | `rx_rad, ry_rad, rz_rad` | `phi n` |
#' | `"axis_angle"` | `x, y, z, angle_rad` | axis of any length, angle about it |
#' | `"rodrigues"` | `px, py, pz` | modified Rodrigues parameters, `n tan(phi/4)` |
#' | `"euler"` | `angle_1_rad, angle_2_rad, angle_3_rad` | angles in the order of the `sequence` |
#'
#' A `sequence` of Euler angles names its axes and what they belong to: `"intrinsic zyx"` turns
#' about the body's z, then about its new y, then its new x (yaw, pitch, roll); `"extrinsic xyz"`
#' turns about axes of space, and gives the same attitude with the angles in reverse order. There
#' are 12 of each kind.
#'
#' Near `angle_2_rad` = +-pi/2 (three different axes), or 0 and pi (the first and the third axis the
#' same), the other two angles are not unique (gimbal lock). The column `gimbal_lock` is TRUE within
#' 1e-7 rad: each of them has then an error of 1e-9 rad and more, while the attitude that the three
#' describe keeps all its digits. At the lock itself `angle_3_rad` is 0.
#'
#' @param data The numbers of the form: a data frame with the columns above, a matrix with as many
#'   columns, or one row as a vector. A single 3 x 3 matrix is a rotation matrix.
#' @param form Name of the form.
#' @param ... Not used; names after it must be given in full.
#' @param order Of quaternions without names: `"wxyz"` (scalar first) or `"xyzw"` (scalar last). It
#'   has no default, since both are in use.
#' @param sequence Of Euler angles, such as `"intrinsic zyx"`. It has no default.
#' @param maps `"body_to_space"`, or `"space_to_body"` for numbers that take vectors the other way.
#' @param attitude,from,to,first,second Attitudes: data frames with the columns `qw, qx, qy, qz`,
#'   such as a trajectory, or such vectors with names. One row, or n rows.
#' @param fraction Part of the way from `from` (0) to `to` (1); other numbers extrapolate.
#' @param vector Vectors: three numbers, or a data frame with the columns `x, y, z`.
#' @param axes `"space"`: components in body axes become components in space; `"body"`: the reverse.
#' @return Tibbles, a row for each row of the input. `attitude_from()`, `attitude_compose()`,
#'   `attitude_inverse()`, `attitude_slerp()`: the columns
#'   `r describe_columns(quaternion_columns)`
#'   `attitude_to()`: the columns of the form, for Euler angles with `gimbal_lock`. Angles of
#'   rotation are 0 to pi, Rodrigues parameters at most 1 in length, Euler angles -pi to pi, the
#'   middle one -pi/2 to pi/2 (0 to pi where two axes are the same). The axis of no rotation is x.
#'   `attitude_turn()`: `x, y, z`.
#'
#'   `attitude_difference()`: the angle in rad, 0 to pi, of the rotation that takes `from` to `to`;
#'   q and -q are the same attitude.
#'
#'   `attitude_compose()` is the product `first second`: an attitude `second` of a part in a body of
#'   attitude `first`. `attitude_slerp()` turns at a constant rate, the short way.
#'
#'   A row with NA gives NA. Errors are a few roundings of 1, also next to no rotation and to half
#'   turns; small rotations keep their relative accuracy.
#' @section Warnings: `rotdyn_warning_normalised`: quaternions were not of unit length, or matrices
#'   not orthogonal, by more than 1e-12. They are normalised.
#'   `rotdyn_warning_range`: a component of a rotated vector is beyond double precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_unit`,
#'   `rotdyn_error_argument`; `rotdyn_error_missing` for an `order` or a `sequence` that is not
#'   named; `rotdyn_error_value` with the row: a quaternion or an axis of length 0, a matrix that is
#'   not a rotation (`R'R` differs from 1 by more than 1e-6, or a reflection), infinite numbers.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 4.4 to 4.9;
#'   Shepperd, J. Guid. Control 1 (1978) 223; Bernardes and Viollet, PLOS ONE 17 (2022) e0276302.
#' @seealso [rotation_about()] for one rotation matrix.
#' @concept quaternion
#' @concept Euler angles
#' @examples
#' # Yaw, pitch and roll of an aircraft, and back:
#' q <- attitude_from(c(0.3, 0.1, -0.2), "euler", sequence = "intrinsic zyx")
#' q
#' attitude_to(q, "euler", sequence = "intrinsic zyx")
#' attitude_to(q, "rotation_vector")
#' # A quaternion from elsewhere, scalar last:
#' attitude_from(c(0, 0, 0.6, 0.8), "quaternion", order = "xyzw")
#' attitude_difference(c(qw = 1, qx = 0, qy = 0, qz = 0), q)
#' attitude_turn(q, c(1, 0, 0))
#' # Two turns one after the other, the way back, and a third of the way.
#' quarter <- attitude_from(c(0, 0, 1, pi / 2), "axis_angle")
#' both <- attitude_compose(quarter, q)
#' attitude_compose(both, attitude_inverse(both))
#' attitude_slerp(q, both, fraction = 1 / 3)
#' @name attitude
NULL

attitude_forms <- list(
  quaternion = c("qw", "qx", "qy", "qz"),
  matrix = paste0("r", rep(1:3, each = 3), 1:3),
  rotation_vector = c("rx_rad", "ry_rad", "rz_rad"),
  axis_angle = c("x", "y", "z", "angle_rad"),
  rodrigues = c("px", "py", "pz"),
  euler = paste0("angle_", 1:3, "_rad")
)

#' @rdname attitude
#' @export
attitude_from <- function(data, form, ..., order = NULL, sequence = NULL,
                          maps = c("body_to_space", "space_to_body")) {
  call <- check_no_dots(...)
  check_supplied(c("data", "form"), call)
  form <- check_string(form, "form", names(attitude_forms), call)
  maps <- if (missing(maps)) "body_to_space" else {
    check_string(maps, "maps", c("body_to_space", "space_to_body"), call)
  }
  columns <- form_columns(data, form, order, call)
  q <- read_attitude(form, columns, euler_sequence(form, sequence, call), "data", call)
  if (maps == "space_to_body") q[2:4] <- lapply(q[2:4], `-`)
  new_table(q, nrow = length(q[[1]]))
}

#' @rdname attitude
#' @export
attitude_to <- function(attitude, form, ..., sequence = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("attitude", "form"), call)
  form <- check_string(form, "form", names(attitude_forms), call)
  code <- euler_sequence(form, sequence, call)
  q <- as_attitude(attitude, "attitude", call)
  out <- .Call(ffi_attitude_to, match(form, names(attitude_forms)) - 1, q, code)
  names(out) <- c(attitude_forms[[form]], "gimbal_lock")
  if (form != "euler") out$gimbal_lock <- NULL
  new_table(out, nrow = length(out[[1]]))
}

#' @rdname attitude
#' @export
attitude_compose <- function(first, second, ...) {
  call <- check_no_dots(...)
  check_supplied(c("first", "second"), call)
  pair_of_attitudes(1, list(first = first, second = second), NULL, call)
}

#' @rdname attitude
#' @export
attitude_inverse <- function(attitude, ...) {
  call <- check_no_dots(...)
  check_supplied("attitude", call)
  q <- as_attitude(attitude, "attitude", call)
  q[2:4] <- lapply(q[2:4], `-`)
  new_table(q, nrow = length(q[[1]]))
}

#' @rdname attitude
#' @export
attitude_slerp <- function(from, to, fraction, ...) {
  call <- check_no_dots(...)
  check_supplied(c("from", "to", "fraction"), call)
  fraction <- check_column(fraction, "fraction", "1", call)
  check_no_infinite(list(fraction), "fraction", call)
  pair_of_attitudes(2, list(from = from, to = to), list(fraction = fraction), call)
}

#' @rdname attitude
#' @export
attitude_difference <- function(from, to, ...) {
  call <- check_no_dots(...)
  check_supplied(c("from", "to"), call)
  pair_of_attitudes(3, list(from = from, to = to), NULL, call)[[1]]
}

#' @rdname attitude
#' @export
attitude_turn <- function(attitude, vector, axes = c("space", "body"), ...) {
  call <- check_no_dots(...)
  check_supplied(c("attitude", "vector"), call)
  axes <- if (missing(axes)) "space" else check_string(axes, "axes", c("space", "body"), call)
  q <- as_attitude(attitude, "attitude", call)
  if (!is.list(vector)) {
    vector <- check_column(vector, "vector", "1", call)
    if (length(vector) != 3L) abort_size_of(vector, "vector", 3L, call)
    names(vector) <- c("x", "y", "z")
  }
  v <- named_columns(vector, c("x", "y", "z"), "vector", call)
  check_no_infinite(v, "vector", call)
  check_recyclable(c(q[1], v[1]), call)
  out <- .Call(ffi_attitude_turn, unname(c(q, v)), as.double(axes == "space"))
  warn_beyond(out, v, length(out[[1]]), call)
  new_table(out, nrow = length(out[[1]]))
}

# ---- arguments ----------------------------------------------------------------------------------

# c(axis, axis, axis, intrinsic) with axes from 0; NULL for the forms that need none.
euler_sequence <- function(form, sequence, call) {
  if (form != "euler") return(NULL)
  if (is.null(sequence)) {
    abort_rotdyn(c(
      "{.arg sequence} is missing: Euler angles mean nothing without it.",
      i = "Such as {.val intrinsic zyx} for yaw, pitch and roll, or {.val intrinsic zxz}."
    ), "missing", call)
  }
  said <- if (rlang::is_string(sequence)) lower_case(sequence) else ""
  parts <- regmatches(said, regexec("^(intrinsic|extrinsic)[ _]([xyz])([xyz])([xyz])$", said))[[1]]
  axes <- match(parts[3:5], c("x", "y", "z"))
  if (anyNA(axes) || any(diff(axes) == 0)) {
    abort_rotdyn(c(
      "{.arg sequence} must name its kind and three axes, neighbours different.",
      x = "It is {describe_value(sequence)}.",
      i = "Such as {.val intrinsic zyx} or {.val extrinsic zxz}."
    ), "value", call)
  }
  as.double(c(axes - 1, parts[2] == "intrinsic"))
}

# The columns of a form as a list of doubles, in the order of attitude_forms.
form_columns <- function(data, form, order, call) {
  wanted <- attitude_forms[[form]]
  if (is.list(data)) return(named_columns(data, wanted, "data", call))
  if (form == "matrix" && identical(dim(data), c(3L, 3L))) data <- as.vector(t(data))
  if (is.null(dim(data))) {
    data <- check_column(data, "data", "1", call)
    if (!is.null(names(data)) && all(wanted %in% names(data))) {
      return(unname(as.list(data[wanted])))
    }
    if (length(data) != length(wanted)) abort_size_of(data, "data", length(wanted), call)
    data <- matrix(data, 1L)
  }
  if (length(dim(data)) != 2L || ncol(data) != length(wanted)) {
    abort_size_of(seq_len(prod(dim(data)[-1])), "data", length(wanted), call)
  }
  columns <- lapply(seq_along(wanted), function(k) check_column(data[, k], "data", "1", call))
  if (form != "quaternion") return(columns)
  if (is.null(order)) {
    abort_rotdyn(c(
      "{.arg order} is missing: quaternions without names come in two orders.",
      i = "{.val wxyz} has the scalar first, {.val xyzw} last."
    ), "missing", call)
  }
  order <- check_string(order, "order", c("wxyz", "xyzw"), call)
  if (order == "wxyz") columns else columns[c(4, 1:3)]
}

abort_size_of <- function(x, arg, wanted, call) {
  abort_rotdyn(
    c("{.arg {arg}} must have {wanted} numbers in a row.", x = "It has {length(x)}."), "size", call
  )
}

named_columns <- function(data, wanted, arg, call) {
  missing <- setdiff(wanted, names(data))
  if (length(missing)) abort_missing_column(missing[1], data, call)
  columns <- lapply(wanted, function(name) {
    check_column(data[[name]], name, if (endsWith(name, "_rad")) "rad" else "1", call)
  })
  names(columns) <- wanted
  check_recyclable(columns, call)
  unname(columns)
}

# NA is allowed.
check_no_infinite <- function(columns, arg, call) {
  infinite <- vapply(columns, function(x) match(TRUE, is.infinite(x)), 1L)
  if (!all(is.na(infinite))) {
    row <- min(infinite, na.rm = TRUE)
    abort_rotdyn("{.arg {arg}} must be finite: row {row} is not.", "value", call)
  }
}

# Unit quaternions, list(qw, qx, qy, qz), of columns of a form.
read_attitude <- function(form, columns, code, arg, call) {
  check_no_infinite(columns, arg, call)
  q <- .Call(ffi_attitude_from, match(form, names(attitude_forms)) - 1, unname(columns), code)
  off <- q$off
  q$off <- NULL
  given <- Reduce(`&`, lapply(columns, function(x) !is.na(x)))
  # About an axis of length 0 the cosine of the half angle is a number.
  bad <- which(given & (is.nan(q$qw) | is.nan(q$qx)))
  if (length(bad)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be attitudes.",
      x = if (form == "matrix") "The matrix in row {bad[1]} is singular." else
        "The {if (form == 'quaternion') 'quaternion' else 'axis'} in row {bad[1]} has length 0."
    ), "value", call)
  }
  if (form == "matrix") {
    bad <- which(off > 1e-6)
    if (length(bad)) {
      abort_rotdyn(c(
        "{.arg {arg}} must be rotations: orthogonal, with determinant +1.",
        x = if (is.infinite(off[bad[1]])) {
          "The matrix in row {bad[1]} is a reflection."
        } else {
          "R'R differs from 1 by {format(off[bad[1]], digits = 3)} in row {bad[1]}."
        }
      ), "value", call)
    }
  }
  far <- which(off > 1e-12)
  if (length(far)) {
    maximum <- max(off[far])
    what <- if (form == "matrix") "R'R differs from 1" else "the length differs from 1"
    warn_rotdyn(c(
      "{.arg {arg}}: {length(far)} attitude{?s} {?was/were} normalised.",
      i = "{what} by up to {format(maximum, digits = 2)}."
    ), "normalised", call)
  }
  q
}

# Of a table, or of a vector with names.
as_attitude <- function(x, arg, call) {
  wanted <- attitude_forms$quaternion
  if (is.numeric(x) && is.null(dim(x)) && all(wanted %in% names(x))) x <- as.list(x[wanted])
  if (!is.list(x)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a data frame with the columns {.field {wanted}}.",
      x = "It is {describe_value(x)}.",
      i = "{.fn attitude_from} makes one of other forms."
    ), "type", call)
  }
  read_attitude("quaternion", named_columns(x, wanted, arg, call), NULL, arg, call)
}

pair_of_attitudes <- function(which, pair, more, call) {
  q <- Map(function(x, arg) as_attitude(x, arg, call), pair, names(pair))
  check_recyclable(c(lapply(q, `[[`, 1L), more), call)
  out <- .Call(ffi_attitude_pair, which, unname(c(q[[1]], q[[2]], more)))
  new_table(out, nrow = length(out[[1]]))
}
