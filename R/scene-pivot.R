#' A body with a fixed point
#'
#' A rigid body of which one point is held, under gravity: a top, a gyroscope, a pendulum that
#' swings in space. In the body's axes
#' \deqn{\dot L = L \times \omega + r_c \times m g + \tau - \gamma L,\quad L = I\omega,\quad
#'   \dot q = \tfrac12 q\,(0, \omega),}{
#'   L' = L x omega + r_c x m g + torque - damping L,  L = I omega,  q' = q (0, omega)/2,}
#' with I and L about the fixed point and r_c from there to the centre of mass. z of space is up.
#'
#' A symmetric top (two equal moments, the centre of mass on the axis of the third) is exact at any
#' time (`pivot_top`): its attitude is good to some 1e-15 rad, through the poles, asleep, hanging.
#' The bound covers the rounding of an inclined attitude at the start, some 1e-16 of the phase.
#' So is a body that is held at its centre of mass. Everything else is integrated. Events: the
#' centre of mass is `highest` or `lowest`; the short cuts below and the models with steps of fixed
#' length list none.
#'
#' A body may carry rotors: a gyroscope's wheel in its frame, reaction wheels that swing a pendulum
#' up. Then \eqn{L = I\omega + \sum_k J_k W_k a_k}{L = I omega + sum of J W a}, as in
#' [scene_free()], with I that of the body with the rotors locked. A symmetric top with rotors on
#' its axis is exact (`pivot_top`): its axis moves as that of a top with the spin
#' \eqn{\omega_3 + JW/I_3}{omega3 + J W/I3}. So is a body that is held at its centre of mass, with
#' rotors along a principal axis (`pivot_gyrostat`).
#'
#' Two short cuts of the fast top have a bound, and are taken where it is within the accuracy asked:
#' `pivot_precession`, the gyroscope that goes round at torque over angular momentum, and
#' `pivot_nutation`, small nutation to first order. The head of the trajectory says what is left
#' out.
#'
#' @param body A `rot_body`; or three principal moments of inertia in kg m^2 about the fixed point,
#'   along the body's axes: then `mass_kg` and `centre_m` say where gravity acts.
#' @inheritParams scene_free
#' @param omega0_rad_per_s Three components of the angular velocity at `start_s`, in body axes.
#' @param pivot_m The fixed point, in the body's own axes, in m: by default their origin. For a
#'   `rot_body` only.
#' @param mass_kg,centre_m With moments as the body: its mass, and the centre of mass from the fixed
#'   point, three numbers in the body's axes.
#' @param torque Torque about the fixed point, besides gravity: as in [scene_free()].
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @return A `rot_scene_pivot`, which is a `rot_scene`. Its trajectory has the columns
#'   `r describe_columns(columns_of_motion("pivot"))`
#'   with the angular momentum about the fixed point; `inclination_rad` is NaN of a body held at its
#'   centre of mass. [audit()] balances the energy, each component
#'   of the angular momentum in space, and the norm of the quaternion. Angular momentum and energy
#'   include the rotors. With rotors there are, for each,
#'   `r describe_columns(columns_of_motion("pivot", more = TRUE)[1:2])`
#'   and [augment()] has `motor_work_j`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.7; Whittaker,
#'   Analytical Dynamics, 4th ed. (1937), sections 71 and 72.
#' @seealso [precession_table()] for the rates of precession and nutation, [scene_free()],
#'   [attitude], [scene_pendulum()] for a body on an axle.
#' @concept top
#' @concept gyroscope
#' @concept spherical pendulum
#' @concept spinning top
#' @examples
#' # A top on its tip, tilted by 30 degrees, spun and let go:
#' tilted <- attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
#' top <- scene_pivot(
#'   c(0.0042, 0.0042, 0.002), c(0, 0, 60), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
#'   attitude0 = tilted
#' )
#' motion <- trajectory(top, time_s = seq(0, 2, by = 0.1))
#' motion
#' motion_events(motion)
#' audit(motion)
#' # A wheel in a frame of 0.5 kg, at 3000 rpm, held at one end of its axle:
#' wheel <- scene_pivot(
#'   c(0.0052, 0.0052, 0.001), c(0, 0, 0), mass_kg = 0.5, centre_m = c(0, 0, 0.1),
#'   attitude0 = attitude_from(c(1, 0, 0, pi / 2), "axis_angle"),
#'   rotors = rotor(c(0, 0, 1), 4e-4, 314)
#' )
#' audit(trajectory(wheel, time_s = seq(0, 2, by = 0.1)))
#' @export
scene_pivot <- function(body, omega0_rad_per_s, ..., pivot_m = c(0, 0, 0), mass_kg = NULL,
                        centre_m = NULL, attitude0 = NULL, gravity_m_per_s2 = 9.80665,
                        torque = NULL, torque_axes = c("body", "space"), resistance = NULL,
                        rotors = NULL, start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("body", "omega0_rad_per_s"), call)
  gravity <- check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call, lower = 0)
  held <- pivot_inertia(body, pivot_m, mass_kg, centre_m, call)
  scene <- c(
    list(
      body = held$body, pivot_m = held$pivot_m, mass_kg = held$mass_kg, centre_m = held$centre_m,
      gravity_m_per_s2 = gravity
    ),
    space_inputs(
      omega0_rad_per_s, attitude0, torque, torque_axes, resistance, rotors, start_s, call
    )
  )
  if (!all(is.finite(held$mass_kg * gravity * held$centre_m))) {
    abort_rotdyn("The torque of gravity is not finite.", "value", call)
  }
  check_space_axes(scene, held$inertia, call)
  finish_scene("pivot", scene, call)
}

# list(body: as the scene has it; inertia, mass_kg, centre_m: about the fixed point, the centre of
# mass from there; pivot_m).
pivot_inertia <- function(body, pivot_m, mass_kg, centre_m, call) {
  if (inherits(body, "rot_body")) {
    check_body(body, call)
    if (!is.null(mass_kg) || !is.null(centre_m)) {
      abort_rotdyn(
        c(
          "{.arg mass_kg} and {.arg centre_m} are those of the body: they are given twice.",
          i = "{.arg pivot_m} is where the body is held, in its own axes: {.code pivot_m = c(0, 0,
               -0.1)} on the axis of a disk, 0.1 m below its centre."
        ),
        "value", call
      )
    }
    pivot <- check_finite(pivot_m, "pivot_m", "m", call)
    if (length(pivot) != 3L) abort_size_of(pivot, "pivot_m", 3L, call)
    centre <- body$centre_m - pivot
    tensor <- .Call(ffi_inertia_about, body$second_moment_kg_m2, body$mass_kg, centre, NULL)
    check_in_range(tensor, call)
    inertia <- if (all(tensor[row(tensor) != col(tensor)] == 0)) {
      new_free_inertia(body, as.double(diag(tensor)))
    } else {
      free_inertia(tensor, call)
    }
    return(list(
      body = body, inertia = inertia, mass_kg = body$mass_kg, centre_m = centre, pivot_m = pivot
    ))
  }
  if (!identical(pivot_m, c(0, 0, 0))) {
    abort_rotdyn(c(
      "{.arg pivot_m} is for a {.cls rot_body}: moments are about the fixed point.",
      i = "{.arg centre_m} is the centre of mass from there."
    ), "argument", call)
  }
  if (is.null(mass_kg) || is.null(centre_m)) {
    abort_rotdyn(c(
      "{.arg mass_kg} and {.arg centre_m} are missing.",
      i = "Three moments do not say where gravity acts; a {.cls rot_body} does."
    ), "missing", call)
  }
  centre <- check_finite(centre_m, "centre_m", "m", call)
  if (length(centre) != 3L) abort_size_of(centre, "centre_m", 3L, call)
  inertia <- free_inertia(body, call)
  list(
    body = body_of_inertia(inertia), inertia = inertia,
    mass_kg = check_number(mass_kg, "mass_kg", "kg", call, lower = 0), centre_m = centre
  )
}

#' @export
print.rot_scene_pivot <- function(x, ...) {
  check_scene(x, current_env())
  say("<rot_scene> ", scene_title(x), "\n")
  print_field("body", paste0(
    shape_of(x$body), "principal moments ", list_si(x$moment_of_inertia_kg_m2),
    " kg m^2 about the point"
  ))
  print_field("gravity", paste0(
    format_si(x$mass_kg), " kg at ", list_si(x$centre_m), " m from the point"
  ))
  if (!is.null(x$torque)) print_field("torque", describe_free_torque(x))
  print_free_start(x)
}

# A symmetric top as a row of precession_table().
#' @export
table_of_tops.rot_scene_pivot <- function(tops, beside, call) {
  check_scene(tops, call)
  if (length(beside$given)) {
    abort_rotdyn("{.arg {beside$given}} {?is/are} known of a scene.", "argument", call)
  }
  moments <- tops$moment_of_inertia_kg_m2
  centre <- tops$centre_m
  axis <- which.max(abs(if (any(centre != 0)) centre else tops$omega0_rad_per_s))
  others <- setdiff(1:3, axis)
  even <- abs(diff(moments[others])) <= 1e-9 * max(moments)
  along <- all(abs(centre[others]) <= 1e-9 * max(abs(centre)))
  if (!even || !along || !identical(tops$axes, c(1, 0, 0, 0)) || length(tops$rotors)) {
    abort_rotdyn(c(
      "{.arg tops} must be scenes of symmetric tops without rotors, the centre of mass on the axis
       of symmetry.",
      i = "{.fn trajectory} has the motion of any body."
    ), "model", call)
  }
  own <- as.list(as.double(seq_len(3) == axis))
  up <- unlist(.Call(ffi_attitude_turn, c(as.list(tops$attitude0), own), 1), use.names = FALSE)
  new_table(list(
    mass_kg = tops$mass_kg, lever_arm_m = centre[axis],
    moment_of_inertia_kg_m2 = moments[axis], spin_rad_per_s = tops$omega0_rad_per_s[axis],
    transverse_moment_kg_m2 = mean(moments[others]),
    axis_angle_deg = atan2(sqrt(sum(up[1:2]^2)), up[3]) * 180 / pi,
    gravity_m_per_s2 = tops$gravity_m_per_s2
  ), nrow = 1L)
}

# A symmetric body that spins about its axis, a point of which is held, is a gyroscope or a top.
pivot_title <- function(scene) {
  body <- sentence(scene_body(scene))
  along <- symmetry_axis(scene)
  spins <- length(along) && (length(scene$rotors) || sum(along * scene$omega0_rad_per_s) != 0)
  if (spins) {
    paste("A gyroscope or top:", lower_first(body), "with a fixed point")
  } else {
    paste(body, "with a fixed point")
  }
}

# Where the centre of mass is on it: a unit vector in body axes, or NULL.
symmetry_axis <- function(scene) {
  if (!identical(scene$axes, c(1, 0, 0, 0))) return(NULL)
  moments <- scene$moment_of_inertia_kg_m2
  centre <- scene$centre_m
  for (k in 1:3) {
    same <- abs(diff(moments[-k])) <= 1e-9 * max(moments)
    if (same && max(abs(centre[-k])) <= 1e-9 * max(abs(centre))) return(as.double(1:3 == k))
  }
}
