#' A body that nothing holds
#'
#' A rigid body that turns about its centre of mass: thrown, in orbit, or in free fall. In the
#' body's axes
#' \deqn{\dot L = L \times \omega + \tau - \gamma L,\quad
#'   L = I\omega + \sum_k J_k W_k a_k,\quad \dot q = \tfrac12 q\,(0, \omega).}{
#'   L' = L x omega + torque - damping L,  L = I omega + sum of J W a,  q' = q (0, omega)/2.}
#' The sum is over the rotors that the body carries, none by default: moment of inertia J about the
#' axis a, angular velocity W relative to the body.
#' Without torque the motion is exact for any moments of inertia and at any time (`free_exact`):
#' the attitude is good to some 1e-15 rad after 1e12 rad. With a torque it is integrated.
#'
#' A body with rotors driven at a constant speed is a gyrostat. It is exact (`free_gyrostat`) where
#' the rotors lie along one of the principal axes, unless the motion is next to a separatrix; in a
#' ball they may lie along any axes. Every other scene with rotors is integrated. A motor's torque
#' on a reaction wheel turns the body the other way; only outer torques change the angular momentum
#' of all. Rotors that spin along the middle axis make the spin about it stable, if they spin fast
#' enough: with \eqn{h = \sum J W}{h = sum of J W} and the spin \eqn{\Omega}{Omega} about axis k,
#' where \eqn{(I_k - I_i)\Omega + h}{(I_k - I_i) Omega + h} and \eqn{(I_k - I_j)\Omega + h}{(I_k -
#' I_j) Omega + h} have one sign.
#'
#' A body that spins about its middle axis turns over again and again (the intermediate axis
#' theorem; Dzhanibekov's wing nut, the tennis racket): [flip_time()] says how often. The events
#' `flip` are the times at which the component of the angular momentum along the middle axis passes
#' zero, where without torque that axis would come within 45 degrees of the angular momentum; the
#' closed form lists none in a span with more than 10000 of them, nor does a body with rotors.
#'
#' @param body A `rot_body`, a 3 x 3 inertia tensor about the centre of mass, or three principal
#'   moments of inertia in kg m^2, about the body's axes x, y and z.
#' @param omega0_rad_per_s Three components of the angular velocity at `start_s`, in body axes.
#' @param ... Not used; names after it must be given in full.
#' @param attitude0 Attitude at `start_s`, body to space: NULL (the axes coincide), a row of
#'   [attitude_from()], a 3 x 3 rotation matrix, or a quaternion `c(qw, qx, qy, qz)`. As there,
#'   a quaternion of another length than 1 is normalised.
#' @param torque Torque about the centre of mass: NULL, three numbers, a data frame with the
#'   columns `time_s`, `x_n_m`, `y_n_m`, `z_n_m` (linear between its times, 0 before and after; two
#'   rows at the same time make a jump), a list of up to three laws of time by the names of their
#'   axes, such as `list(x = torque_sinusoid(1, 2), z = 0.5)`, or a function of `time_s`, or of
#'   `time_s`, `omega_rad_per_s` (body axes) and `attitude` (quaternion, scalar first), that returns
#'   three numbers; [torque_function()] gives it the times of its jumps and kinks.
#' @param torque_axes Axes of the components: `"body"` or `"space"`.
#' @param resistance NULL, or `resistance(damping_per_s = )`: the torque `-damping L`, which makes L
#'   fade as `exp(-damping t)`.
#' @param rotors NULL, a [rotor()], a list of them, or a data frame with a row for each rotor and
#'   the columns `axis_x`, `axis_y`, `axis_z`, `moment_of_inertia_kg_m2`, `omega_rad_per_s`, as the
#'   arguments of [rotor()]; `torque_n_m`, too, which is NA of a driven rotor. At most 16. `body`
#'   includes them, locked.
#' @param start_s Time at which the state above holds; earlier times are reached backwards.
#' @return A `rot_scene_free`, which is a `rot_scene`. Its trajectory has the columns
#'   `r describe_columns(columns_of_motion("free"))`
#'   The quaternion is continuous: it does not jump to -q. [audit()] balances the energy, each
#'   component of the angular momentum in space, and the norm of the quaternion. Angular momentum
#'   and energy include the rotors. With rotors there are, for each,
#'   `r describe_columns(columns_of_motion("free", more = TRUE)[1:2])`
#'   and [augment()] has `motor_work_j`. The error of the momenta of rotors counts as that of the
#'   angular momentum.
#' @section Warnings: `rotdyn_warning_inertia`: three moments that no body has, since one exceeds
#'   the sum of the others; driven rotors with more moment than the body with them.
#'   `rotdyn_warning_normalised`: an attitude that is not of unit length, or not orthogonal, by more
#'   than 1e-12.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (also NA, NaN and
#'   Inf, and a spin about an axis without moment of inertia), `rotdyn_error_unit`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`, `rotdyn_error_inertia`.
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), section 37; Ashbaugh, Chicone and
#'   Cushman, J. Dyn. Diff. Eq. 3 (1991) 67, for the flips; Hughes, Spacecraft Attitude Dynamics
#'   (1986), chapter 6, for rotors.
#' @seealso [rotor()], [attitude], [flip_time()], [spin_stability()], [principal_axes()].
#' @concept Dzhanibekov
#' @concept tumbling
#' @concept tennis racket
#' @concept satellite
#' @concept thrown body
#' @examples
#' # A wing nut spun about its middle axis, a little off:
#' nut <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01))
#' motion <- trajectory(nut, time_s = 0:20)
#' motion
#' motion_events(motion)
#' audit(motion)
#' # A block with thrusters, in the axes of the body:
#' block <- scene_free(body_box(10, 0.4, 0.6, 1), c(0, 0, 0.2), torque = c(0.01, 0, 0))
#' trajectory(block, time_s = c(0, 30, 60))
#' # A rotor along the middle axis keeps the nut from turning over:
#' steady <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01), rotors = rotor(c(0, 1, 0), 0.05, 120))
#' range(trajectory(steady, time_s = seq(0, 20, by = 0.1))$omega_y_rad_per_s)
#' # A reaction wheel of 0.01 kg m^2, spun up to w and stopped again, turns a body of 2 kg m^2:
#' pulse <- data.frame(time_s = c(0, 4.9, 5.1, 10), torque_n_m = c(0.02, 0.02, -0.02, -0.02))
#' slew <- trajectory(
#'   scene_free(c(4, 5, 2), c(0, 0, 0), rotors = rotor(c(0, 0, 1), 0.01, 0, pulse)),
#'   time_s = c(0, 5, 10)
#' )
#' slew[c("time_s", "qw", "qz", "omega_z_rad_per_s", "rotor_1_omega_rad_per_s")]
#' audit(slew)
#' @export
scene_free <- function(body, omega0_rad_per_s, ..., attitude0 = NULL, torque = NULL,
                       torque_axes = c("body", "space"), resistance = NULL, rotors = NULL,
                       start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("body", "omega0_rad_per_s"), call)
  inertia <- free_inertia(body, call)
  scene <- c(list(body = body_of_inertia(inertia)), space_inputs(
    omega0_rad_per_s, attitude0, torque, torque_axes, resistance, rotors, start_s, call
  ))
  check_space_axes(scene, inertia, call)
  finish_scene("free", scene, call)
}

# The inputs that a body with a fixed point has, too.
space_inputs <- function(omega0_rad_per_s, attitude0, torque, torque_axes, resistance, rotors,
                         start_s, call) {
  omega0 <- check_finite(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call)
  if (length(omega0) != 3L) abort_size_of(omega0, "omega0_rad_per_s", 3L, call)
  both <- c("body", "space")
  axes <- if (identical(torque_axes, both)) "body" else {
    check_string(torque_axes, "torque_axes", both, call)
  }
  law <- space_torque(torque, call)
  rotors <- rotors_of(rotors, call)
  list(
    omega0_rad_per_s = omega0, attitude0 = start_attitude(attitude0, call),
    torque = law$torque, torque_axes = axes,
    resistance = check_resistance(resistance, "damping_per_s", call), rotors = rotors,
    breaks_s = with_rotor_breaks(law$breaks_s, rotors),
    start_s = check_number(start_s, "start_s", "s", call)
  )
}

# list(body, moment_of_inertia_kg_m2, axes, moment_error): principal moments, and the attitude of
# their axes in the body. A diagonal tensor keeps its axes and its numbers.
free_inertia <- function(body, call) {
  if (inherits(body, "rot_principal_moments")) {
    return(new_free_inertia(NULL, body$moment_of_inertia_kg_m2, body$axes, 2e-15))
  }
  if (is.numeric(body) && is.null(dim(body))) {
    moments <- check_finite(body, "body", "kg*m^2", call)
    if (length(moments) != 3L) abort_size_of(moments, "body", 3L, call)
    check_not_negative(moments, "body", "kg*m^2", call)
    if (any(moments > (0.5 + 1e-12) * sum(moments))) {
      warn_rotdyn(c(
        "No body has these moments of inertia: one exceeds the sum of the other two.",
        x = "They are {format(moments, digits = 7)} kg m^2.",
        i = "Euler's equations are solved with them all the same."
      ), "inertia", call)
    }
    return(new_free_inertia(NULL, moments))
  }
  tensor <- if (is.numeric(body) && !is.object(body)) body
  of <- if (inherits(body, "rot_body")) check_body(body, call) else body_of_tensor(body, call)
  if (is.null(tensor)) {
    second <- matrix(of$second_moment_kg_m2, 3)
    tensor <- diag(c(second[2, 2] + second[3, 3], second[1, 1] + second[3, 3],
                     second[1, 1] + second[2, 2])) - (second - diag(diag(second)))
  }
  keep <- if (inherits(body, "rot_body")) of
  if (all(tensor[row(tensor) != col(tensor)] == 0)) {
    return(new_free_inertia(keep, as.double(diag(tensor))))
  }
  principal <- find_principal(body, NULL, call)
  axes <- .Call(ffi_attitude_from, 1, as.list(as.double(t(attr(principal, "axes")))), NULL)
  new_free_inertia(
    keep, principal$principal_moment_kg_m2, unlist(axes[1:4], use.names = FALSE), 2e-15
  )
}

# Principal moments of a body given as a tensor, and the attitude of their axes: for texts.
new_principal <- function(moments, axes) {
  x <- list(moment_of_inertia_kg_m2 = moments, axes = axes)
  class(x) <- "rot_principal_moments"
  x
}

read_principal <- function(moment_of_inertia_kg_m2, axes) {
  call <- current_env()
  check_supplied(c("moment_of_inertia_kg_m2", "axes"), call)
  moments <- check_finite(moment_of_inertia_kg_m2, "moment_of_inertia_kg_m2", "kg*m^2", call)
  if (length(moments) != 3L) abort_size_of(moments, "moment_of_inertia_kg_m2", 3L, call)
  check_inertia_or_abort(diag(moments), NULL, call, given_by_user = FALSE)
  turn <- start_attitude(axes, call)
  if (max(abs(turn - axes)) > 4 * .Machine$double.eps) axes <- turn
  new_principal(moments, as.double(axes))
}

#' @export
text_node.rot_principal_moments <- function(x, where, call) list(principal_moments = unclass(x))

new_free_inertia <- function(body, moments, axes = c(1, 0, 0, 0), error = 0) {
  list(
    body = body, moment_of_inertia_kg_m2 = as.double(moments), axes = axes, moment_error = error
  )
}

# As a scene has it: the body, its moments about its own axes, or those about others.
body_of_inertia <- function(x) {
  x$body %||% (if (x$moment_error == 0) {
    x$moment_of_inertia_kg_m2
  } else {
    new_principal(x$moment_of_inertia_kg_m2, x$axes)
  })
}

# As attitude_from() reads them: a row of it, a matrix, or four numbers, scalar first.
start_attitude <- function(attitude, call) {
  if (is.null(attitude)) return(c(1, 0, 0, 0))
  bare <- is.numeric(attitude) && !is.object(attitude)
  q <- if (bare && identical(dim(attitude), c(3L, 3L))) {
    read_attitude("matrix", as.list(as.double(t(attitude))), NULL, "attitude0", call)
  } else if (bare && is.null(names(attitude)) && length(attitude) == 4L) {
    read_attitude("quaternion", as.list(as.double(attitude)), NULL, "attitude0", call)
  } else if (is.list(attitude) || (is.numeric(attitude) && !is.null(names(attitude)))) {
    as_attitude(attitude, "attitude0", call)
  } else {
    abort_rotdyn(c(
      "{.arg attitude0} must be an attitude: a row of {.fn attitude_from}, a 3 x 3 rotation matrix,
       or a quaternion, scalar first.",
      x = "It is {describe_value(attitude)}."
    ), "type", call)
  }
  if (length(q[[1]]) != 1L) {
    abort_rotdyn(c(
      "{.arg attitude0} must be one attitude.", x = "It has {length(q[[1]])} rows."
    ), "size", call)
  }
  q <- unlist(q, use.names = FALSE)
  if (anyNA(q)) abort_rotdyn("{.arg attitude0} must not be missing.", "value", call)
  q
}

# list(torque: NULL, three numbers, a list of columns or a function; breaks_s)
space_torque <- function(torque, call) {
  if (inherits(torque, "rot_torque_function")) {
    return(list(torque = torque$f, breaks_s = breaks_of(torque, call)))
  }
  if (inherits(torque, "rot_torque")) {
    abort_rotdyn(c(
      "{.arg torque} of a body in space must name an axis.",
      x = "It is {describe_torque(torque)}.",
      i = "Such as {.code torque = list(z = torque_sinusoid(1, 2))}."
    ), "type", call)
  }
  if (is.list(torque) && !is.data.frame(torque) && length(torque) && !is.null(names(torque)) &&
        all(names(torque) %in% c("x", "y", "z"))) {
    return(torque_by_axes(torque, call))
  }
  torque <- if (is.function(torque)) {
    torque_arguments(torque, call)
    torque
  } else if (is.list(torque)) {
    torque_table(torque, c("x_n_m", "y_n_m", "z_n_m"), call)
  } else if (!is.null(torque)) {
    torque <- check_finite(torque, "torque", "N*m", call)
    if (length(torque) != 3L) abort_size_of(torque, "torque", 3L, call)
    if (any(torque != 0)) torque
  }
  list(torque = torque, breaks_s = breaks_of(torque, call))
}

# Of a law with breaks of its own, or the times of a table.
breaks_of <- function(torque, call) {
  own <- if (inherits(torque, "rot_torque_function")) torque$breaks_s
  sort(unique(c(double(), own, if (is.list(torque) && is.null(own)) torque[["time_s"]])))
}

# Laws of time along axes: numbers where all are constant, else a function of the time.
torque_by_axes <- function(laws, call) {
  laws <- lapply(stats::setNames(nm = c("x", "y", "z")), function(axis) {
    as_torque(laws[[axis]], call, paste0("torque$", axis))
  })
  for (axis in names(laws)) check_law_of_time(laws[[axis]], paste0("torque$", axis), call)
  constant <- vapply(laws, torque_is_constant, NA)
  if (all(constant)) {
    return(space_torque(unname(vapply(laws, function(law) law$outside[1], 1)), call))
  }
  list(
    torque = function(time_s) vapply(laws, torque_of_time, 1, time_s, USE.NAMES = FALSE),
    breaks_s = sort(unique(unlist(lapply(laws, breaks_of_torque), use.names = FALSE)))
  )
}

torque_arguments <- function(torque, call) {
  check_law_order(torque, c("time_s", "omega_rad_per_s", "attitude"), "torque", "type", call)
  count_law_arguments(torque, function(n) {
    abort_rotdyn(c(
      "The function {.arg torque} must have one argument, the time, or three.",
      x = "It has {n} argument{?s} without a default.",
      i = "{.code function(time_s, omega_rad_per_s, attitude)}"
    ), "type", call)
  })
}

# Knots: the times and these columns of torques.
torque_table <- function(torque, columns, call) {
  names <- c("time_s", columns)
  missing <- setdiff(names, names(torque))
  if (length(missing)) abort_missing_column(missing[1], torque, call)
  knots <- lapply(names, function(name) {
    check_finite(torque[[name]], name, if (name == "time_s") "s" else "N*m", call)
  })
  names(knots) <- names
  time_s <- knots$time_s
  if (any(lengths(knots) != length(time_s)) || is.unsorted(time_s)) {
    abort_rotdyn(c(
      "The times of {.arg torque} must not go back, with a torque each.",
      i = "Two rows at the same time make a jump."
    ), "time", call)
  }
  if (length(time_s) < 2L) {
    abort_rotdyn("{.arg torque} needs two times at least.", "size", call)
  }
  if (time_s[1] == time_s[length(time_s)]) {
    abort_rotdyn(c(
      "The times of {.arg torque} must span some time.",
      x = "All of them are {format(time_s[1])} s."
    ), "time", call)
  }
  knots
}

# An axis without moment of inertia: no spin about it, and no torque. Rotors need one about each.
check_space_axes <- function(scene, inertia, call) {
  check_spin(scene, inertia, call)
  check_rotors(scene$rotors, inertia, call)
}

check_spin <- function(scene, inertia, call) {
  moments <- inertia$moment_of_inertia_kg_m2
  if (all(moments == 0)) {
    abort_rotdyn("The body has no moment of inertia: it has no motion of its own.", "value", call)
  }
  if (all(moments > 0)) return(invisible())
  omega <- if (inertia$axes[1] == 1) scene$omega0_rad_per_s else {
    unlist(.Call(ffi_attitude_turn, as.list(c(inertia$axes, scene$omega0_rad_per_s)), 0))
  }
  along <- abs(omega[moments == 0])
  if (any(along > 0) || !is.null(scene$torque)) {
    abort_rotdyn(c(
      "The body has an axis without moment of inertia: it can neither spin about it nor bear a
       torque.",
      x = "Its moments are {format(moments, digits = 7)} kg m^2.",
      i = "A thin cylinder has a small moment there."
    ), "value", call)
  }
}

#' @export
print.rot_scene_free <- function(x, ...) {
  check_scene(x, current_env())
  say("<rot_scene> ", scene_title(x), "\n")
  print_field("body", paste0(
    shape_of(x$body), "principal moments ", list_si(x$moment_of_inertia_kg_m2), " kg m^2"
  ))
  print_field("torque", describe_free_torque(x))
  print_free_start(x)
}

# The lines that a free body and a body with a fixed point have in common.
print_free_start <- function(x) {
  say(resistance_line(x))
  for (one in x$rotors) print_field("rotor", describe_rotor(one))
  print_field("start", paste0(
    "omega ", list_si(x$omega0_rad_per_s), " rad/s (body axes), quaternion ",
    list_si(x$attitude0), " at ", format_si(x$start_s), " s"
  ))
  invisible(x)
}

list_si <- function(v) paste(format_si(v), collapse = ", ")

resistance_line <- function(x) {
  if (!is.null(x$resistance)) paste0("  resists   ", describe_resistance(x$resistance), "\n")
}

shape_of <- function(body) if (inherits(body, "rot_body")) paste0(body$shape, ", ")

describe_free_torque <- function(scene) {
  torque <- scene$torque %||% c(0, 0, 0)
  said <- if (is.function(torque)) {
    "an R function"
  } else if (is.list(torque)) {
    paste(length(torque$time_s), "knots")
  } else {
    paste(paste(format_si(torque), collapse = ", "), "N m")
  }
  paste0(said, " (", scene$torque_axes, " axes)")
}

# The inertia tensor in the body's own axes.
free_tensor <- function(scene) {
  moments <- scene$moment_of_inertia_kg_m2
  if (scene$axes[1] == 1) return(diag(moments))
  axes <- matrix_of_quaternion(scene$axes, "axes", NULL)
  axes %*% (moments * t(axes))
}
