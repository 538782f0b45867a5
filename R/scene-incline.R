#' A body on an incline
#'
#' A round body on a plane slope that rolls, slides or rests. With down the slope positive, and
#' omega positive where it rolls that way,
#' \deqn{m \dot v = m g \sin\alpha - F,\quad I \dot\omega = F R - T}{
#'   m v' = m g sin(alpha) - F,  I omega' = F R - T}
#' and the normal force `N = m g cos(alpha)`. While the contact slips, with the slip speed
#' `u = v - R omega`, the friction is `F = mu_k N sign(u)`; while it sticks, `F` is what keeps
#' `u = 0`, as long as that is at most `mu_s N`. The rolling resistance is `T = b N sign(omega)`,
#' and at rest what holds the body, up to `b N`.
#'
#' [trajectory()] gives the closed form with the exact times of its events: `roll` (slip ends),
#' `slip` (static friction is exceeded), `reverse` (the velocity passes zero), `slip_reverse` (the
#' slip passes zero, and friction is too weak to keep it there), `stick` (the body comes to rest and
#' stays). They have rows of their own with `event_rows = TRUE`. A force that exceeds what friction
#' holds by less than rounding is held: at its [critical angle][rolling_critical_angle()] a body
#' rolls. From rest, what holds least gives way first: a body that can roll without slipping does.
#' Launched uphill, with back-spin or over-spin, are signs of the start.
#'
#' @param body A `rot_body` that is round about its own z axis, such as [body_sphere()],
#'   [body_disk()] or [body_hoop()], or of which a part is, such as the wheel of a compound. Its
#'   centre of mass must be on the axis of that part. A body without an outline, such as
#'   [body_tensor()], is taken as round about its own z axis.
#' @param incline_angle_deg Angle of the slope in degrees, -90 to 90. Its sine and cosine are those
#'   of the exact angle in degrees.
#' @param ... Not used; names after it must be given in full.
#' @param static_friction Coefficient of static friction, at least 0. Inf: the contact never slips,
#'   as on a rack, on 90 degrees neither.
#' @param kinetic_friction Coefficient of kinetic friction, 0 to `static_friction`. Inf where the
#'   start rolls.
#' @param rolling_arm_m Arm b of the rolling resistance in m, at least 0: the normal force acts
#'   that far ahead of the centre.
#' @param resistance NULL, or `resistance(drag_n_s_per_m = , drag_n_s2_per_m2 = )`: air drag on the
#'   centre of mass. The motion is then integrated.
#' @param force A force along the slope on the centre of mass, in N, positive down: NULL, a number,
#'   or an R function of `time_s`, or of `time_s, x_m, v_m_per_s`, that returns one number;
#'   [force_function()] gives it the times of its jumps and kinks.
#' @param radius_m Radius on which the body rolls, in m; NULL for that of the body.
#' @param v0_m_per_s,omega0_rad_per_s Velocity down the slope and angular velocity at `start_s`;
#'   `omega0_rad_per_s = NULL` for a start that rolls, `v0/radius`. Where it is not given, and a
#'   moving body could slip, a message (class `rotdyn_message_start`) says that it rolls.
#' @param x0_m,theta0_rad Place along the slope and angle at `start_s`.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param start_s Time at which the state above holds. Earlier times are an error: the slip before
#'   rolling is undetermined.
#' @return A `rot_scene_incline`, which is a `rot_scene`. Its trajectory has the columns
#'   `r describe_columns(columns_of_motion("incline"))`
#'   With air drag or a force also `r describe_columns(columns_of_motion("incline", TRUE))`
#'   The error of the closed form is a bound. [summary()] has the largest velocities and the highest
#'   place between the rows, too: the least x where the angle is positive, the largest where it is
#'   negative, on the level the first one. [time_when()] finds the time of any value.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (also NA, NaN and
#'   Inf where a number must be finite, a body without moment of inertia, one that is not round, and
#'   one whose centre of mass is beside the axis on which it would roll),
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4; Halliday,
#'   Resnick and Walker, Fundamentals of Physics, section 11-2 (rolling with slip).
#' @seealso [rolling_table()] for pure rolling, [rolling_friction_coefficient()].
#' @concept bowling
#' @concept rolling
#' @concept slipping
#' @concept friction
#' @concept ball
#' @concept skid
#' @examples
#' ball <- body_sphere(6, 0.11)
#' # A bowling ball slides, then rolls:
#' lane <- scene_incline(ball, 0, static_friction = 0.19, v0_m_per_s = 8.1, omega0_rad_per_s = 0)
#' motion <- trajectory(lane, time_s = 0:3)
#' motion_events(motion)
#' audit(motion)
#' # The highest point of a body launched uphill:
#' time_when(scene_incline(ball, 10, v0_m_per_s = -3), v_m_per_s = 0)
#' # Too little friction to roll on 60 degrees:
#' scene_incline(body_hoop(1, 0.3), 60, static_friction = 0.5, kinetic_friction = 0.4)
#' @export
scene_incline <- function(body, incline_angle_deg, ..., static_friction = Inf,
                          kinetic_friction = static_friction, rolling_arm_m = 0, radius_m = NULL,
                          v0_m_per_s = 0, omega0_rad_per_s = NULL, x0_m = 0, theta0_rad = 0,
                          resistance = NULL, force = NULL, gravity_m_per_s2 = 9.80665,
                          start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("body", "incline_angle_deg"), call)
  check_body(body, call)
  inertia <- one_inertia(body, "body", call)
  check_rolls(body, call)
  if (is.null(radius_m)) radius_m <- rolling_radius(body, inertia, call)
  breaks_s <- if (inherits(force, "rot_force_function")) force$breaks_s
  if (!is.null(breaks_s)) force <- force$f
  if (identical(force, 0)) force <- NULL
  scene <- scene_of_inputs("incline", call)
  if (missing(omega0_rad_per_s)) say_start_rolls(scene)
  scene
}

# With a friction that is given the user may have meant a body that slides at first.
say_start_rolls <- function(scene) {
  v0 <- .subset2(scene, "v0_m_per_s")
  if (v0 == 0 || is.infinite(.subset2(scene, "static_friction"))) return(invisible())
  omega0 <- format_si(.subset2(scene, "omega0_rad_per_s"))
  inform_quickly(c(
    paste0("The body rolls from the start: `omega0_rad_per_s` is ", omega0, ", as none is given."),
    "`omega0_rad_per_s = 0`: it slides at first. `omega0_rad_per_s = NULL`: it rolls, as now."
  ), "start")
}

#' A force that an R function gives
#'
#' The law of a force in time, and perhaps in place and velocity, with the times at which it may
#' jump or have a kink. Without them they are looked for.
#'
#' @param f A function of `time_s`, or of `time_s, x_m, v_m_per_s`, that returns one number in N.
#' @param breaks_s Times at which the force or one of its derivatives may jump; NULL: they are
#'   looked for.
#' @param ... Not used: an unknown argument is an error.
#' @return A `rot_force_function`, for [scene_incline()].
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_missing`,
#'   `rotdyn_error_argument`.
#' @source Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993),
#'   section II.6 (discontinuities).
#' @seealso [torque_function()].
#' @concept force
#' @examples
#' push <- force_function(function(time_s) if (time_s < 1) 20 else 0, breaks_s = 1)
#' block <- scene_incline(body_sphere(2, 0.1), 10, force = push)
#' trajectory(block, time_s = 0:2)[c("time_s", "v_m_per_s", "applied_force_n")]
#' @export
force_function <- function(f, breaks_s = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("f", call)
  if (!is.function(f)) {
    abort_rotdyn(c(
      "{.arg f} must be a function.", x = "It is {describe_value(f)}.",
      i = "A constant force is a number."
    ), "type", call)
  }
  check_law_order(f, c("time_s", "x_m", "v_m_per_s"), "f", "type", call)
  count_law_arguments(f, function(n) {
    abort_rotdyn(c(
      "{.arg f} must be a function of {.code time_s}, or of {.code time_s, x_m, v_m_per_s}.",
      x = "It has {n} argument{?s} without a default."
    ), "type", call)
  })
  breaks_s <- sort(unique(check_finite(breaks_s %||% double(), "breaks_s", "s", call)))
  structure(list(f = f, breaks_s = breaks_s), class = "rot_force_function")
}

#' @export
print.rot_force_function <- function(x, ...) {
  say("<rot_force_function> ", describe_force(x$f), if (length(x$breaks_s)) {
    paste0(", breaks at ", paste(format_si(x$breaks_s), collapse = ", "), " s")
  })
  invisible(x)
}

describe_force <- function(force) {
  if (is.function(force)) "an R function, in N" else paste(format_si(force), "N")
}

# The radius of a body whose beta is known: its own size where that gives beta, else from beta.
rolling_radius <- function(body, inertia, call) {
  beta <- body$beta
  if (is.na(beta) || beta <= 0) {
    abort_rotdyn(c(
      "{.arg radius_m} is missing: the body has no radius of its own on which it rolls.",
      x = "It is a {.val {body$shape}}."
    ), "missing", call)
  }
  sizes <- unname(body$size_m[names(body$size_m) %in% c("radius_m", "outer_radius_m")])
  if (body$mass_kg == 0 && length(sizes)) return(sizes[1]) # a pulley without mass
  from_beta <- sqrt(inertia / body$mass_kg / beta)
  # A moment below 1e-308 has fewer digits.
  digits <- 1e-9 + 2^-1074 / inertia
  own <- sizes[abs(sizes - from_beta) <= digits * from_beta]
  if (length(own)) own[1] else from_beta
}

#' @export
print.rot_scene_incline <- function(x, ...) {
  check_scene(x, current_env())
  beta <- x$moment_of_inertia_kg_m2 / x$mass_kg / x$radius_m^2
  say(
    "<rot_scene> ", scene_title(x), "\n",
    "  body      ", x$body$shape, ", ", format_si(x$mass_kg), " kg, radius ",
    format_si(x$radius_m), " m, I/(m r^2) ", format_si(beta), "\n",
    "  incline   ", format_si(x$incline_angle_deg), " degrees, gravity ",
    format_si(x$gravity_m_per_s2), " m/s^2\n",
    "  friction  ", if (x$static_friction == Inf) "never slips" else paste(
      format_si(x$static_friction), "static,", format_si(x$kinetic_friction), "kinetic"
    ), "; rolling needs ",
    format(rolling_friction_coefficient(beta, x$incline_angle_deg), digits = 4), "\n",
    if (x$rolling_arm_m > 0) paste0("  arm       ", format_si(x$rolling_arm_m), " m\n"),
    resistance_line(x),
    if (!is.null(x$force)) paste0("  force     ", describe_force(x$force), "\n"),
    "  start     v ", format_si(x$v0_m_per_s), " m/s, omega ", format_si(x$omega0_rad_per_s),
    " rad/s at ", format_si(x$start_s), " s\n"
  )
  invisible(x)
}

#' The friction that a scene needs to roll
#'
#' What a body on an incline needs at rest and from rest not to slip, and what it does with the
#' friction that it has. A body that rolls needs `mu = (beta |tan(angle)| + b/R)/(1 + beta)`, with
#' the arm b of the rolling resistance. A body that the resistance holds at rest, where
#' `|tan(angle)| <= b/R`, needs `mu = |tan(angle)|`: friction alone balances gravity along the
#' slope.
#'
#' @param scene A [scene_incline()]. Its start does not count; a force and air drag of its own are
#'   not taken.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble of one row:
#'   `r describe_columns(friction_columns)`
#'   The acceleration is that of the motion it makes. The critical angle is NA where it rolls at no
#'   angle.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_missing`, `rotdyn_error_argument`;
#'   `rotdyn_error_value` for a scene with air drag or a force.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4.
#' @seealso [rolling_friction_coefficient()] and [rolling_critical_angle()] for numbers,
#'   [scene_incline()].
#' @concept incline
#' @concept rolling
#' @concept slipping
#' @examples
#' # University Physics, example 11.1: a hoop on 60 degrees needs 0.866.
#' friction_needed(scene_incline(body_hoop(1, 0.3), 60, static_friction = 0.5))
#' @export
friction_needed <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene(scene, call)
  if (!inherits(scene, "rot_scene_incline")) {
    abort_rotdyn("{.arg scene} must be a {.fn scene_incline}.", "type", call)
  }
  if (has_outer_force(scene)) {
    abort_rotdyn(c(
      "What air drag or a force of its own needs changes on the way.",
      i = "The events {.val slip} of {.fn trajectory} say where static friction is exceeded."
    ), "value", call)
  }
  beta <- scene$moment_of_inertia_kg_m2 / scene$mass_kg / scene$radius_m^2
  start <- .Call(ffi_incline_starts, c(list(beta = beta, length_m = 1), scene[c(
    "radius_m", "incline_angle_deg", "gravity_m_per_s2", "static_friction", "kinetic_friction",
    "rolling_arm_m"
  )]), progress_bar("incline"))
  sticks <- scene$static_friction * (1 + beta) - scene$rolling_arm_m / scene$radius_m
  critical <- if (scene$rolling_arm_m == 0) {
    .Call(ffi_incline_critical, beta, scene$static_friction)
  } else if (sticks >= 0) {
    atan(sticks / beta) * 180 / pi
  } else {
    NA_real_
  }
  new_table(list(
    friction_needed = start$friction_needed, static_friction = scene$static_friction,
    critical_angle_deg = critical,
    from_rest = if (start$slips) "slides" else if (start$rests) "rests" else "rolls",
    acceleration_m_per_s2 = start$acceleration_m_per_s2,
    alpha_rad_per_s2 = start$angular_acceleration_rad_per_s2
  ), nrow = 1L)
}

#' The steepest angle for rolling
#'
#' The angle of an incline up to which a body that starts from rest rolls without slipping:
#' `tan(angle) = mu_s (1 + beta)/beta`. The reverse of [rolling_friction_coefficient()].
#'
#' @param body A round body, a list of bodies, names of shapes such as `"hoop"`, or numbers: `beta =
#'   I/(m r^2)`, at least 0; 0 gives 90 degrees, Inf the angle at which a block slides.
#' @param static_friction Coefficient of static friction, at least 0; Inf gives 90 degrees. Each
#'   argument has length 1 or n.
#' @param ... Not used: an unknown argument is an error.
#' @return Degrees, with NA where an argument is NA.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` with the row of
#'   the first value below 0, `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4.
#' @seealso [rolling_friction_coefficient()], [scene_incline()].
#' @concept incline
#' @concept slipping
#' @examples
#' rolling_critical_angle(c("hoop", "disk", "sphere"), static_friction = 0.5)
#' @export
rolling_critical_angle <- function(body, static_friction, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "static_friction"), call)
  columns <- check_columns_of(
    list(body = body, static_friction = static_friction), c("1", "1"), call
  )
  check_recyclable(columns, call)
  for (name in names(columns)) check_not_negative(columns[[name]], name, "1", call)
  .Call(ffi_incline_critical, columns$body, columns$static_friction)
}

has_outer_force <- function(scene) {
  !is.null(scene$resistance) || !is.null(scene$force)
}
