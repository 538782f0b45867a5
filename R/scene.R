#' A body on a fixed axle
#'
#' The scene that [trajectory()] computes, with `I` the moment of inertia about the axle:
#' \deqn{\frac{d(I\omega)}{dt} = \tau + \tau_r,\quad \frac{d\theta}{dt} = \omega}{
#'   d(I omega)/dt = torque + resistance,  d(theta)/dt = omega}
#'
#' The axle is the one that the body names, unless `through` says otherwise: through the end of a
#' [body_rod_end()], at `radius_m` from a [body_point()], through the centre of mass of any other
#' body. Where [place_body()] put a body does not matter. A message of class `rotdyn_message_axle`
#' says so where `through` is not given and the centre is not on the own axis parallel to the axle.
#' Weight does not act: see [scene_pendulum()] and [torque_gravity()].
#'
#' @param body A `rot_body` (see [body_disk()]), or one number: the moment of inertia about the axle
#'   in kg m^2. It must be greater than 0. Or [inertia_knots()], where it changes in time.
#' @param torque A torque law (see [torque] and [torque-terms]) or a sum of them, an R function, one
#'   number in N m, or NULL for none.
#' @param resistance A [resistance()], or NULL for none.
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity at `start_s`.
#' @param ... Not used; names after it must be given in full.
#' @param start_s Time at which the state above holds. It does not depend on the output times;
#'   earlier ones are reached backwards.
#' @param axis Direction of the axle in the body's own axes: `"x"`, `"y"`, `"z"`, or three numbers
#'   of any length but 0.
#' @param through A point on the axle: NULL for the axle that the body names, `"centre"` (of mass),
#'   `"origin"` (of the body's own axes), or three numbers in m in the own axes. Ignored unless
#'   `body` is a `rot_body`.
#' @return A `rot_scene_axle`, which is a `rot_scene`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf,
#'   no moment of inertia), `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.3.
#' @seealso [trajectory()] for the motion, [torque] and [torque-terms], [resistance()],
#'   [stopping()], [scene_pendulum()], [autoplot.rot_scene()].
#' @concept flywheel
#' @concept wheel
#' @concept disc
#' @concept fixed axis
#' @examples
#' scene_axle(
#'   body_disk(mass_kg = 2, radius_m = 0.25),
#'   torque_knots(time_s = c(0, 1, 4, 6, 8), torque_n_m = c(0, 0.8, 0.8, 0, 0)),
#'   resistance(viscous_n_m_s = 0.03)
#' )
#' # A rod that turns about its end.
#' scene_axle(body_rod_end(mass_kg = 1.5, length_m = 2), 0.8)
#' @export
scene_axle <- function(body, torque = NULL, resistance = NULL, theta0_rad = 0,
                       omega0_rad_per_s = 0, ..., start_s = 0, axis = c(0, 0, 1),
                       through = NULL) {
  call <- environment()
  if (missing(body)) check_supplied("body", call)
  check_no_dots(...)
  describe_axle(
    body, torque, resistance, theta0_rad, omega0_rad_per_s, start_s,
    if (!missing(axis)) axis, if (!missing(through)) through, call
  )
}

# scene_axle(), for other functions too: `call` is the user's. NULL for `axis` and `through`: not
# given.
describe_axle <- function(body, torque, resistance, theta0_rad, omega0_rad_per_s, start_s, axis,
                          through, call) {
  axis <- if (is.null(axis)) c(0, 0, 1) else unit_axis(as_axis(axis, call), call)
  if (inherits(body, "rot_body")) {
    check_body(body, call)
    point <- if (!is.null(through)) as_point(through, body, "through", call)
    about <- describe_point(body, if (is.character(through)) through else point)
    if (is.null(through)) {
      inertia <- named_moment(body, axis)
      if (nzchar(axis_shape(body))) {
        through <- named_point(body)
      } else if (any(.subset2(body, "centre_m") != 0)) {
        say_axle_in_centre(body, axis)
      }
    } else {
      through <- point
      inertia <- moment_about_axis(body, axis, through)
    }
  } else if (is.numeric(body) || inherits(body, "rot_measured")) {
    inertia <- check_number(body, "body", "kg*m^2", call)
    body <- NULL
  } else if (inherits(body, "rot_inertia_knots")) {
    check_form(body, inertia_knots_form, "body", "change of inertia", call)
    inertia <- NULL # depends on the start, below
  } else {
    check_class(
      body, "rot_body", "body",
      "Make one with {.fn body_disk}, or give the moment of inertia as one number in kg m^2.", call
    )
  }
  start_s <- check_number(start_s, "start_s", "s", call)
  if (is.null(body) || is.null(inertia)) about <- NULL
  changing <- NULL
  if (is.null(inertia)) {
    changing <- body
    inertia <- inertia_at(changing, start_s)
  }
  check_turns(inertia, call, computed = !is.null(body))
  torque <- as_torque(torque, call)
  resistance <- as_resistance(resistance, call)
  theta0_rad <- check_number(theta0_rad, "theta0_rad", "rad", call)
  omega0_rad_per_s <- check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call)
  scene <- new_scene_axle(
    body, inertia, changing, axis, torque, resistance, theta0_rad, omega0_rad_per_s, start_s
  )
  # For the drawing.
  if (is.double(through)) scene$through <- as.double(through)
  scene$about <- about # for the print
  sound_scene(scene, call)
}

# The user may have meant the own axis parallel to the axle, where that misses the centre of mass.
say_axle_in_centre <- function(body, axis) {
  centre <- as.double(.subset2(body, "centre_m"))
  off <- centre - sum(centre * axis) * axis
  size <- sqrt(sum(diag(body$second_moment_kg_m2)) / body$mass_kg)
  if (!is.finite(size)) size <- 0
  if (max(abs(off)) <= 16 * .Machine$double.eps * (size + max(abs(centre)))) return(invisible())
  cli::cli_inform(
    c(
      "The axle is taken through the centre of mass, {format_si(sqrt(sum(off^2)))} m from the
       body's own axis.",
      i = "{.code through = \"centre\"} says that it is meant; {.code through = \"origin\"} takes
           the own axis instead."
    ),
    class = c("rotdyn_message_axle", "rotdyn_message")
  )
}

new_scene_axle <- function(body, inertia, changing, axis, torque, resistance, theta0, omega0,
                           start_s) {
  loads <- torque_loads(torque)
  scene <- list(
    body = body,
    moment_of_inertia_kg_m2 = inertia,
    inertia = changing,
    axis = axis,
    torque = torque,
    loads = loads,
    resistance = resistance,
    theta0_rad = theta0,
    omega0_rad_per_s = omega0,
    start_s = start_s
  )
  class(scene) <- c("rot_scene_axle", "rot_scene")
  scene
}

# At a jump, the moment after it.
inertia_at <- function(knots, t) {
  times <- knots$time_s
  moment <- knots$moment_of_inertia_kg_m2
  n <- length(times)
  last <- findInterval(t, times) # the last knot at or before
  i <- pmin(pmax(last, 1L), n - 1L)
  width <- times[i + 1L] - times[i]
  between <- moment[i] * ((times[i + 1L] - t) / width) + moment[i + 1L] * ((t - times[i]) / width)
  ifelse(last == 0L, moment[1], ifelse(last == n, moment[n], between))
}

#' A pendulum: a body that hangs from an axle
#'
#' Shortcut for a [scene_axle()] with [torque_gravity()]: the moment of inertia about the axle is
#' that about the centre of mass plus `m d^2` (parallel axes).
#' \deqn{(I_g + m d^2)\,\ddot\theta = -m g d \sin\theta + \tau + \tau_r}{
#'   (I_g + m d^2) theta'' = -m g d sin(theta) + torque + resistance}
#' `theta` is 0 where it hangs
#' straight down. Without resistance the motion is known in closed form at any amplitude.
#'
#' @inheritParams scene_axle
#' @inheritParams torque-terms
#' @param body A `rot_body`; a point mass is [body_point()].
#' @param distance_m Distance of the centre of mass from the axle, >= 0. NULL for the axle that the
#'   body names: the end of a [body_rod_end()], the axis of a [body_point()] at its `radius_m`.
#' @param torque Any other torque law, or NULL.
#' @return A `rot_scene_axle`.
#' @section Errors: those of [scene_axle()].
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), section 11.
#' @seealso [period()] at any amplitude, [when()] for passages, [torque_gravity()],
#'   [scene_axle()].
#' @concept pendulum
#' @concept period
#' @concept swing
#' @examples
#' # A metre stick about its end, let go from horizontal.
#' pendulum <- scene_pendulum(body_rod_end(0.1, 1), theta0_rad = pi / 2)
#' trajectory(pendulum, time_s = seq(0, 2, by = 0.5))
#' @export
scene_pendulum <- function(body, distance_m = NULL, resistance = NULL, theta0_rad = 0,
                           omega0_rad_per_s = 0, ..., torque = NULL, start_s = 0,
                           axis = c(0, 0, 1), gravity_m_per_s2 = 9.80665) {
  call <- rlang::current_env()
  check_no_dots(...)
  check_supplied("body", call)
  check_class(
    body, "rot_body", "body",
    if (is.numeric(body)) {
      paste0(
        "A point mass in kg is {.code body_point(", format_si(body[1]), ")}. In other scenes a ",
        "number is a moment of inertia; a pendulum needs a mass."
      )
    } else {
      "Make one with {.fn body_rod} or {.fn body_point}."
    }, call
  )
  mass_kg <- check_body(body, call)$mass_kg
  axis <- unit_axis(as_axis(axis, call), call)
  distance_m <- if (is.null(distance_m)) {
    named_distance(body, axis, call)
  } else {
    check_number(distance_m, "distance_m", "m", call, lower = 0)
  }
  torque <- as_torque(torque, call)
  about_centre <- moment_about_axis(body, axis)
  gravity_m_per_s2 <- check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call)
  gravity <- gravity_law(mass_kg, distance_m, gravity_m_per_s2, 0, call)
  inertia <- .Call(ffi_sum_product, about_centre, c(mass_kg, distance_m, distance_m))
  check_turns(inertia[1], call, computed = TRUE)
  scene <- new_scene_axle(
    body, inertia[1], NULL, axis,
    if (torque_is_zero(torque)) gravity else sum_torques(gravity, torque),
    as_resistance(resistance, call),
    check_number(theta0_rad, "theta0_rad", "rad", call),
    check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
    check_number(start_s, "start_s", "s", call)
  )
  scene$inertia_lo <- inertia[2]
  # For the drawing.
  scene$hang <- list(
    mass_kg = mass_kg, distance_m = distance_m, gravity_m_per_s2 = gravity_m_per_s2
  )
  scene$given <- list(torque = torque) # for the text
  scene$about <- paste(format_si(distance_m), "m from the centre of mass")
  sound_scene(scene, call)
}

# From the axle that the body names to its centre of mass.
named_distance <- function(body, axis, call) {
  off <- as.double(body$centre_m) - named_point(body)
  off <- off - sum(off * axis) * axis
  distance <- max(abs(off))
  if (distance > 0) distance <- distance * sqrt(sum((off / distance)^2))
  if (!nzchar(axis_shape(body)) || distance == 0) {
    abort_rotdyn(c(
      "{.arg distance_m} is missing: the axle passes through no point that this body names.",
      i = "Give the distance of the centre of mass from the axle.",
      i = "{.fn body_rod_end}, and {.fn body_point} with a {.arg radius_m}, name their axle."
    ), "missing", call)
  }
  distance
}

# A computed moment below 2.2e-308 has lost digits.
check_turns <- function(inertia, call, computed = FALSE) {
  if (is.finite(inertia) && inertia > 0 && computed && inertia < .Machine$double.xmin) {
    abort_rotdyn(c(
      "The moment of inertia is below what double precision resolves.",
      x = "It is about {format(inertia)} kg m^2."
    ), "value", call)
  }
  if (!(is.finite(inertia) && inertia > 0)) {
    abort_rotdyn(c(
      "The body must have a moment of inertia about its axle, finite and greater than 0.",
      x = "It is {format(inertia)} kg m^2.",
      i = "Without inertia there is no equation of motion: check mass, size and {.arg axis}."
    ), "value", call)
  }
}

#' @export
print.rot_scene_axle <- function(x, ...) {
  check_scene(x, rlang::current_env())
  body <- if (inherits(x$body, "rot_body")) x$body$shape else "a body"
  inertia <- if (is.null(x$inertia)) {
    paste0(
      format_si(x$moment_of_inertia_kg_m2), " kg m^2 about ",
      if (is.null(x$train)) "the axle" else "the first shaft",
      if (is.character(x$about)) paste0(", ", x$about)
    )
  } else {
    describe_inertia_knots(x$inertia)
  }
  torque <- x$torque
  shown <- x$resistance
  rope <- .subset2(x, "rope")
  if (!is.null(x$gears)) { # dry friction stands for their loss
    torque <- torque_constant(x$gears$applied_n_m)
    shown[c("coulomb_n_m", "static_n_m")] <- 0
    shown["viscous_n_m_s"] <- x$gears$bearings_n_m_s
  }
  cat(
    "<rot_scene> ",
    if (!is.null(rope)) hanging_title(rope) else
      if (is.null(x$train)) paste(body, "on a fixed axle") else "a gear train",
    "\n",
    describe_shafts(x$train),
    if (!is.null(rope)) describe_rope(rope, body),
    "  inertia     ", inertia, if (!is.null(rope)) ", masses included", "\n",
    "  torque      ", describe_torque(torque), if (!is.null(rope)) ", of the weights", "\n",
    "  resistance  ", describe_resistance(shown), "\n",
    if (!is.null(x$gears)) c("  gears       ", describe_gears(x$gears), "\n"),
    "  start       theta ", format_si(x$theta0_rad), " rad, omega ",
    format_si(x$omega0_rad_per_s), " rad/s at ", format_si(x$start_s), " s\n",
    sep = ""
  )
  invisible(x)
}
