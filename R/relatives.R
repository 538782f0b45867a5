#' Relatives of rolling: spool, yo-yo, Atwood's machine, falling rod
#'
#' Closed forms for columns of numbers.
#'
#' `spool_pull()`: a spool on a level floor is pulled by a string that leaves its inner radius r
#' from below, at an angle alpha over the floor. It rolls towards the pull where cos(alpha) > r/R
#' and away from it beyond this *critical angle*, at which the line of the string meets the contact.
#' \deqn{a = \frac{T (\cos\alpha - r/R)}{m (1 + \beta)},\quad
#'   f = -T\, \frac{\beta \cos\alpha + r/R}{1 + \beta},\quad N = m g - T \sin\alpha}{
#'   a = T (cos(alpha) - r/R)/(m (1 + beta)),  f = -T (beta cos(alpha) + r/R)/(1 + beta),
#'   N = m g - T sin(alpha)}
#' Where f needs more than the friction, it slips, with f = -mu N.
#'
#' `yo_yo()`: it falls with a = g/(1 + beta (R/r)^2), on a string that is wound at the radius r.
#'
#' `atwood_machine()`: two masses on a pulley whose bearing resists with a torque tau,
#' \deqn{a = \frac{(m_1 - m_2) g \mp \tau/r}{m_1 + m_2 + I/r^2},\quad T_1 = m_1 (g - a),\quad
#'   T_2 = m_2 (g + a)}{a = ((m1 - m2) g -+ tau/r)/(m1 + m2 + I/r^2),  T1 = m1 (g - a),
#'   T2 = m2 (g + a)}
#' from rest; it stays at rest while the weights' difference is not above tau/r.
#'
#' `falling_rod()`: a uniform rod, or a chimney, falls about its lower end from rest at
#' `start_angle_deg` from the vertical.
#' \deqn{\omega^2 = \frac{3 g}{l} (\cos\theta_0 - \cos\theta),\quad
#'   \dot\omega = \frac{3 g}{2 l} \sin\theta,\quad
#'   M(x) = \frac{m g \sin\theta}{4 l^2}\, x (l - x)^2}{
#'   omega^2 = (3 g/l) (cos(theta0) - cos(theta)),  alpha = 3 g sin(theta)/(2 l),
#'   M(x) = m g sin(theta) x (l - x)^2/(4 l^2)}
#' The bending moment M is largest at a third of the length from the lower end: there a chimney
#' breaks, the upper part lagging behind. The tip falls faster than g where the rod is flat enough.
#'
#' @param force_n The pull of the string, at least 0.
#' @param angle_deg Angle of the string over the floor, 0 to 90 degrees; of a rod, from the
#'   vertical, from `start_angle_deg` to 180 degrees.
#' @param body A spool or a yo-yo: a round body such as [body_disk()], or a list of them. Its mass,
#'   its outer radius R and `beta = I/(m R^2)` count.
#' @param inner_radius_m Radius of the string, > 0; of a spool below that of the body.
#' @param mass_1_kg,mass_2_kg Masses that hang on the pulley, greater than 0; or bodies.
#' @param pulley A round body, or a list of them, whose moment of inertia and radius count.
#' @param friction Coefficient of friction, at least 0; Inf: does not slip.
#' @param radius_m Outer radius of the spool or yo-yo, radius of the pulley, in m, > 0; NULL for
#'   that of the body.
#' @param bearing_torque_n_m Torque of dry friction in the bearing, at least 0.
#' @param rod A [body_rod()] or [body_rod_end()], or a list of them.
#' @param start_angle_deg Where it starts from rest, 0 to 180 degrees.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with a row for each element of the arguments, which have length 1 or n; NA in a
#'   row gives NA.
#'   `spool_pull()`: `r describe_columns(spool_columns, spool_meanings)`
#'   `yo_yo()`: `r describe_columns(yo_yo_columns, yo_yo_meanings)`
#'   `atwood_machine()`: `r describe_columns(atwood_columns, atwood_meanings)`
#'   `falling_rod()`: `r describe_columns(falling_rod_columns, falling_rod_meanings)`
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_value` with the row of the first value outside its domain,
#'   `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_unit`, `rotdyn_error_missing`,
#'   `rotdyn_error_argument`.
#' @source Kleppner and Kolenkow, An Introduction to Mechanics, 2nd ed. (2014), chapter 7; Varieschi
#'   and Kamiya, Am. J. Phys. 71 (2003) 1025, for the chimney.
#' @seealso [scene_hanging_mass()] for the motion of a pulley under any resistance;
#'   [scene_pendulum()] for a rod that swings; [scene_incline()].
#' @concept spool
#' @concept yo-yo
#' @concept Atwood machine
#' @concept chimney
#' @concept pulley
#' @concept falling chimney
#' @concept unwinding string
#' @examples
#' # Forward, at the critical angle of 60 degrees, backward.
#' spool_pull(body_disk(2, 0.1), 5, c(0, 60, 80), inner_radius_m = 0.05)
#' yo_yo(body_disk(0.05, 0.03), inner_radius_m = 0.004)
#' atwood_machine(1.1, 1, body_disk(0.8, 0.05), bearing_torque_n_m = c(0, 0.02, 0.1))
#' falling_rod(body_rod(1000, 20), angle_deg = c(10, 35, 60, 90))
#' @name relatives
NULL

#' @rdname relatives
#' @export
spool_pull <- function(body, force_n, angle_deg, inner_radius_m, friction = Inf, ...,
                       radius_m = NULL, gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied(c("body", "force_n", "angle_deg", "inner_radius_m"), call)
  x <- relative_columns(c(
    list(force_n = force_n, angle_deg = angle_deg),
    columns_of_bodies(body, c("mass_kg", "radius_m", "beta"), "body", call, radius_m),
    list(
      inner_radius_m = inner_radius_m, friction = friction, gravity_m_per_s2 = gravity_m_per_s2
    )
  ), call, angle = 90)
  wide <- which(x$inner_radius_m >= x$radius_m)
  if (length(wide)) {
    abort_rotdyn(c(
      "{.arg inner_radius_m} must be below the radius of the body.",
      x = "It is not in row {wide[1]}."
    ), "value", call)
  }
  share <- x$inner_radius_m / x$radius_m
  cosine <- cos_of(x$angle_deg)
  normal <- x$mass_kg * x$gravity_m_per_s2 - x$force_n * sin_of(x$angle_deg)
  rolling <- -x$force_n * (x$beta * cosine + share) / (1 + x$beta)
  needed <- ifelse(rolling == 0, 0, ifelse(normal > 0, -rolling / normal, Inf))
  lifts <- normal < 0
  slips <- !lifts & needed > x$friction
  limit <- -pmin(x$friction, .Machine$double.xmax) * pmax(normal, 0)
  force <- ifelse(lifts, 0, ifelse(slips, limit, rolling))
  moment <- x$beta * x$mass_kg * x$radius_m^2
  turn <- -(force * x$radius_m + x$force_n * x$inner_radius_m)
  rolls <- x$force_n * (cosine - share) / (x$mass_kg * (1 + x$beta))
  free <- lifts | slips
  out <- list(
    acceleration_m_per_s2 = ifelse(free, (x$force_n * cosine + force) / x$mass_kg, rolls),
    alpha_rad_per_s2 = ifelse(free, turn / moment, rolls / x$radius_m),
    friction_force_n = force, normal_n = ifelse(lifts, 0, normal), friction_needed = needed,
    critical_angle_deg = acos(share) * 180 / pi,
    motion = ifelse(
      lifts, "lifts", ifelse(slips, "slips", ifelse(
        rolls > 0, "rolls towards the pull", ifelse(rolls < 0, "rolls away", "stays")
      ))
    )
  )
  relative_table(out, x[names(x) != "friction"], call, "friction_needed")
}

#' @rdname relatives
#' @export
yo_yo <- function(body, inner_radius_m, ..., radius_m = NULL, gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied(c("body", "inner_radius_m"), call)
  x <- relative_columns(c(
    columns_of_bodies(body, c("mass_kg", "radius_m", "beta"), "body", call, radius_m),
    list(inner_radius_m = inner_radius_m, gravity_m_per_s2 = gravity_m_per_s2)
  ), call)
  inertia <- x$beta * (x$radius_m / x$inner_radius_m)^2
  a <- x$gravity_m_per_s2 / (1 + inertia)
  out <- list(
    acceleration_m_per_s2 = a, alpha_rad_per_s2 = a / x$inner_radius_m,
    # m (g - a) would cancel where the yo-yo falls almost freely.
    tension_n = x$mass_kg * x$gravity_m_per_s2 / (1 + 1 / inertia)
  )
  relative_table(out, x, call)
}

#' @rdname relatives
#' @export
atwood_machine <- function(mass_1_kg, mass_2_kg, pulley, bearing_torque_n_m = 0, ...,
                           radius_m = NULL, gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied(c("mass_1_kg", "mass_2_kg", "pulley"), call)
  x <- relative_columns(c(
    list(mass_1_kg = mass_1_kg, mass_2_kg = mass_2_kg),
    columns_of_bodies(
      pulley, c("radius_m", "moment_of_inertia_kg_m2"), "pulley", call, radius_m
    ),
    list(bearing_torque_n_m = bearing_torque_n_m, gravity_m_per_s2 = gravity_m_per_s2)
  ), call)
  pull <- (x$mass_1_kg - x$mass_2_kg) * x$gravity_m_per_s2
  held <- x$bearing_torque_n_m / x$radius_m
  net <- ifelse(abs(pull) <= held, 0, pull - sign(pull) * held)
  rim <- x$moment_of_inertia_kg_m2 / x$radius_m / x$radius_m
  total <- x$mass_1_kg + x$mass_2_kg + rim
  # m (g - a) would cancel where the heavier one falls almost freely.
  tension <- function(own, other, held) {
    weight <- x$gravity_m_per_s2
    own * ifelse(net == 0, weight, ((2 * other + rim) * weight + held) / total)
  }
  out <- list(
    acceleration_m_per_s2 = net / total,
    tension_1_n = tension(x$mass_1_kg, x$mass_2_kg, sign(net) * held),
    tension_2_n = tension(x$mass_2_kg, x$mass_1_kg, -sign(net) * held),
    motion = ifelse(net > 0, "1 goes down", ifelse(net < 0, "2 goes down", "stays"))
  )
  relative_table(out, x, call)
}

#' @rdname relatives
#' @export
falling_rod <- function(rod, angle_deg, start_angle_deg = 0, ..., gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied(c("rod", "angle_deg"), call)
  x <- relative_columns(c(
    columns_of_rods(rod, call),
    list(
      angle_deg = angle_deg, start_angle_deg = start_angle_deg,
      gravity_m_per_s2 = gravity_m_per_s2
    )
  ), call, angle = 180)
  back <- which(x$angle_deg < x$start_angle_deg)
  if (length(back)) {
    abort_rotdyn(c(
      "{.arg angle_deg} must not be below {.arg start_angle_deg}: the rod falls.",
      x = "It is in row {back[1]}."
    ), "value", call)
  }
  g <- x$gravity_m_per_s2
  weight <- x$mass_kg * g
  sine <- sin_of(x$angle_deg)
  cosine <- cos_of(x$angle_deg)
  # cos(a) - cos(b) as a product, which does not cancel.
  drop <- 2 * sin_of((x$angle_deg + x$start_angle_deg) / 2) *
    sin_of((x$angle_deg - x$start_angle_deg) / 2)
  out <- list(
    # The square may be no double where its root is one.
    omega_rad_per_s = sqrt(3 * g * drop) / sqrt(x$length_m),
    alpha_rad_per_s2 = 1.5 * g / x$length_m * sine,
    tip_acceleration_m_per_s2 = g * sqrt((1.5 * sine)^2 + (3 * drop)^2),
    tip_fall_m_per_s2 = g * (1.5 * sine^2 + 3 * drop * cosine),
    hinge_along_n = weight * (cosine - 1.5 * drop), hinge_across_n = weight * sine / 4,
    bending_moment_n_m = weight * x$length_m * sine / 27, break_at_m = x$length_m / 3 + 0 * sine
  )
  relative_table(out, x, call)
}

columns_of_rods <- function(rod, call) {
  x <- columns_of_bodies(rod, "mass_kg", "rod", call)
  if (inherits(rod, "rot_body")) rod <- list(rod)
  not <- which(!vapply(rod, function(one) one$shape %in% c("rod", "rod_end"), NA))
  if (length(not)) {
    abort_rotdyn(c(
      "{.arg rod} must be a {.fn body_rod}.", x = "It is a {.val {rod[[not[1]]]$shape}}."
    ), "value", call)
  }
  c(list(length_m = vapply(rod, function(one) one$size_m[["length_m"]], double(1))), x)
}

# `other`: a column that is infinite where there is no such number.
relative_table <- function(out, given, call, other = NULL) {
  n <- length(out[[1]])
  numbers <- Filter(is.numeric, out[setdiff(names(out), other)])
  warn_beyond(lapply(numbers, nan_as_inf), given, n, call)
  new_table(out, nrow = n)
}

sin_of <- function(angle_deg) .Call(ffi_lever, 1, 1, 1, as.double(angle_deg))
cos_of <- function(angle_deg) sin_of(90 - angle_deg)

relative_units <- c(
  force_n = "N", angle_deg = "degree", start_angle_deg = "degree", mass_kg = "kg",
  mass_1_kg = "kg", mass_2_kg = "kg", radius_m = "m", inner_radius_m = "m", beta = "1",
  friction = "1", gravity_m_per_s2 = "m/s^2", moment_of_inertia_kg_m2 = "kg*m^2",
  bearing_torque_n_m = "N*m", length_m = "m"
)

# Columns in SI, all of one length, each in its domain.
relative_columns <- function(columns, call, angle = 0) {
  columns <- check_columns_of(columns, relative_units[names(columns)], call)
  n <- check_recyclable(columns, call)
  for (name in names(columns)) {
    x <- columns[[name]]
    open <- grepl("mass|radius|length", name)
    upper <- if (grepl("angle", name)) angle else Inf
    bad <- x < 0 | x > upper | (open & x == 0) | (is.infinite(x) & name != "friction")
    if (any(bad, na.rm = TRUE)) {
      at <- which(bad)[1]
      abort_domain(
        x[at], name, relative_units[[name]], call, 0, upper, open, row = if (length(x) > 1L) at
      )
    }
    columns[[name]] <- rep_len(x, n)
  }
  columns
}
