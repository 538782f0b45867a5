#' A rotor in a free body
#'
#' A wheel on bearings in a body, for [scene_free()]: it is symmetric about its axis, its centre of
#' mass lies on that axis, and the axis is fixed in the body. It is driven at a constant speed
#' relative to the body (a gyrostat, a dual-spin satellite), or a motor turns it with a torque (a
#' reaction wheel), and the bearing has no friction.
#'
#' With the moment J about its axis a, and the speed W relative to the body, the rotor has the
#' angular momentum \eqn{J (W + a\cdot\omega)}{J (W + a.omega)} about the axis, of which
#' \eqn{J W a} is beside that of the body with the rotor locked. A driven rotor keeps W, and its
#' motor has whatever torque that takes. Any other has
#' \deqn{J (\dot W + a\cdot\dot\omega) = u,}{J (W' + a.omega') = u,}
#' with the torque u of its motor on the rotor. The body has the torque -u.
#'
#' @param axis Direction of the axis in the body's axes: three numbers of any length, or `"x"`,
#'   `"y"`, `"z"`. The rotor turns about it by the right-hand rule.
#' @param moment_of_inertia_kg_m2 Its moment of inertia J about the axis, more than 0. The body of
#'   [scene_free()] includes the rotor, locked: its mass and all its moments.
#' @param omega_rad_per_s Its angular velocity W at the start, relative to the body.
#' @param torque NULL: driven at that speed. Else the torque u of its motor on the rotor about the
#'   axis: a number (0: it turns freely), a [torque] law of the time, a data frame with the columns
#'   `time_s` and `torque_n_m` (linear between its times, 0 before and after; two rows at the same
#'   time make a jump), or a function of `time_s`, or of `time_s`, `omega_rad_per_s` (of the body,
#'   in its axes) and `attitude` (quaternion, scalar first), that returns one number;
#'   [torque_function()] gives it the times of its jumps and kinks.
#' @param ... Not used: an unknown argument is an error.
#' @return A `rot_rotor`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (also NA, NaN and
#'   Inf, and an axis that is not three numbers, or of length 0), `rotdyn_error_unit`,
#'   `rotdyn_error_missing`, `rotdyn_error_time`, `rotdyn_error_argument`.
#' @source Hughes, Spacecraft Attitude Dynamics (1986), sections 3.4 and 6.2.
#' @seealso [scene_free()].
#' @concept gyrostat
#' @concept reaction wheel
#' @concept momentum wheel
#' @concept dual-spin satellite
#' @examples
#' rotor(c(0, 0, 1), 0.02, 300)
#' # A reaction wheel, turned by a motor for 5 s:
#' wheel <- rotor(c(0, 0, 1), 0.01, 0, data.frame(time_s = c(0, 5), torque_n_m = 0.02))
#' body <- scene_free(c(4, 5, 2), c(0, 0, 0), rotors = wheel)
#' motion <- trajectory(body, time_s = 0:6)
#' motion[c("time_s", "omega_z_rad_per_s", "rotor_1_omega_rad_per_s")]
#' audit(motion)
#' @export
rotor <- function(axis, moment_of_inertia_kg_m2, omega_rad_per_s, torque = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied(c("axis", "moment_of_inertia_kg_m2", "omega_rad_per_s"), call)
  new_rotor(axis, moment_of_inertia_kg_m2, omega_rad_per_s, torque, call)
}

new_rotor <- function(axis, moment_of_inertia_kg_m2, omega_rad_per_s, torque, call) {
  moment <- check_number(
    moment_of_inertia_kg_m2, "moment_of_inertia_kg_m2", "kg*m^2", call, lower = 0
  )
  if (moment == 0) {
    abort_rotdyn("{.arg moment_of_inertia_kg_m2} of a rotor must be more than 0.", "value", call)
  }
  law <- motor_torque(torque, call)
  x <- list(
    axis = unit_axis(as_axis(axis, call), call), moment_of_inertia_kg_m2 = moment,
    omega_rad_per_s = check_number(omega_rad_per_s, "omega_rad_per_s", "rad/s", call),
    torque = law$torque, breaks_s = law$breaks_s
  )
  class(x) <- "rot_rotor"
  x
}

# list(torque: NULL, a number, a list of columns or a function; breaks_s)
motor_torque <- function(torque, call) {
  if (inherits(torque, "rot_torque_function")) {
    return(list(torque = torque$f, breaks_s = breaks_of(torque, call)))
  }
  if (inherits(torque, "rot_torque")) {
    check_law_of_time(check_form(torque, torque_form, "torque", "torque law", call), "torque", call)
    if (torque_is_constant(torque)) return(motor_torque(torque$outside[1], call))
    law <- torque
    return(list(
      torque = function(time_s) torque_of_time(law, time_s),
      breaks_s = sort(unique(as.double(breaks_of_torque(law))))
    ))
  }
  torque <- if (is.function(torque)) {
    torque_arguments(torque, call)
    torque
  } else if (is.list(torque)) {
    torque_table(torque, "torque_n_m", call)
  } else if (!is.null(torque)) {
    check_number(torque, "torque", "N*m", call)
  }
  list(torque = torque, breaks_s = breaks_of(torque, call))
}

# Rotors as an argument: NULL, a rotor, a list of them, or a data frame with a row for each.
rotors_of <- function(rotors, call) {
  if (is.null(rotors)) return(NULL)
  if (inherits(rotors, "rot_rotor")) rotors <- list(rotors)
  if (is.data.frame(rotors)) rotors <- rotors_of_table(rotors, call)
  if (!is.list(rotors) || !all(vapply(rotors, inherits, NA, "rot_rotor"))) {
    abort_rotdyn(c(
      "{.arg rotors} must be made of {.fn rotor}: one, or a list of them.",
      x = "It is {describe_value(rotors)}.",
      i = "A data frame has the columns {.field {rotor_table_columns}}."
    ), "type", call)
  }
  if (length(rotors) > 16L) {
    abort_rotdyn(c("A body has at most 16 rotors.", x = "It has {length(rotors)}."), "size", call)
  }
  for (i in seq_along(rotors)) {
    check_form(rotors[[i]], rotor_form, paste0("rotors[[", i, "]]"), "rotor", call)
  }
  if (length(rotors)) unname(rotors)
}

with_rotor_breaks <- function(breaks_s, rotors) {
  own <- unlist(lapply(rotors, function(one) one$breaks_s))
  if (length(own)) sort(unique(c(breaks_s, own))) else breaks_s
}

rotor_table_columns <- c(
  "axis_x", "axis_y", "axis_z", "moment_of_inertia_kg_m2", "omega_rad_per_s"
)

# With the column torque_n_m, where a rotor that is driven has NA, or without it.
rotors_of_table <- function(table, call) {
  missing <- setdiff(rotor_table_columns, names(table))
  if (length(missing)) abort_missing_column(missing[1], table, call)
  torque <- table[["torque_n_m"]] %||% rep(NA_real_, nrow(table))
  lapply(seq_len(nrow(table)), function(i) {
    axis <- vapply(rotor_table_columns[1:3], function(name) as.double(table[[name]][i]), 0)
    new_rotor(
      unname(axis), table$moment_of_inertia_kg_m2[i], table$omega_rad_per_s[i],
      if (!is.na(torque[i])) torque[i], call
    )
  })
}

# The body with its rotors locked has more moment about each axis than the rotors have.
check_rotors <- function(rotors, inertia, call) {
  if (is.null(rotors)) return(invisible())
  if (any(inertia$moment_of_inertia_kg_m2 == 0)) {
    abort_rotdyn("A body with rotors must have a moment about each axis.", "value", call)
  }
  tensor <- free_tensor(inertia)
  for (one in rotors) {
    tensor <- tensor - one$moment_of_inertia_kg_m2 * outer(one$axis, one$axis)
  }
  minimum <- min(eigen(tensor, symmetric = TRUE, only.values = TRUE)$values)
  if (minimum > 1e-12 * max(inertia$moment_of_inertia_kg_m2)) return(invisible())
  message <- c(
    "The rotors have more moment of inertia than the body with them.",
    x = "Without them its least moment is {format(minimum, digits = 7)} kg m^2.",
    i = "{.arg body} includes the rotors, locked: their mass and their moments."
  )
  if (!all(vapply(rotors, is_driven, NA))) {
    abort_rotdyn(message, "value", call)
  }
  warn_rotdyn(c(message, i = "The equations are solved all the same."), "inertia", call)
}

is_driven <- function(rotor) is.null(rotor$torque)

# Their sum of J W a at the start, in body axes.
rotor_momentum <- function(scene) {
  sum <- c(0, 0, 0)
  for (one in scene$rotors) {
    sum <- sum + one$moment_of_inertia_kg_m2 * one$omega_rad_per_s * one$axis
  }
  sum
}

describe_rotor <- function(x) {
  torque <- x$torque
  drive <- if (is_driven(x)) {
    "driven"
  } else if (is.function(torque)) {
    "motor by an R function"
  } else if (is.list(torque)) {
    paste("motor by", length(torque$time_s), "knots")
  } else if (torque == 0) {
    "free"
  } else {
    paste("motor", format_si(torque), "N m")
  }
  paste0(
    format_si(x$moment_of_inertia_kg_m2), " kg m^2 about (",
    paste(format_si(x$axis), collapse = ", "),
    "), ", format_si(x$omega_rad_per_s), " rad/s, ", drive
  )
}

#' @export
print.rot_rotor <- function(x, ...) {
  check_form(x, rotor_form, "x", "rotor", current_env())
  say("<rot_rotor> ", describe_rotor(x), "\n")
  invisible(x)
}

rotor_arguments <- function(x) {
  list(
    axis = x$axis, moment_of_inertia_kg_m2 = x$moment_of_inertia_kg_m2,
    omega_rad_per_s = x$omega_rad_per_s, torque = law_with_breaks(x)
  )
}

# A function with breaks of its own as a law, that a constructor makes the scene again of.
law_with_breaks <- function(x, name = "torque") {
  law <- .subset2(x, name)
  if (!is.function(law) || !length(x$breaks_s)) return(law)
  new_torque("rot_torque_function", f = law, breaks_s = x$breaks_s, arguments = 1L,
             vectorised = FALSE)
}
