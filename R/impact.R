#' Collisions: a bouncing ball, a hinged body
#'
#' Velocities after a collision that takes no time, with the impulses and the energy lost, in closed
#' form. `ball_bounce()`: a spinning ball on a floor, with restitution and friction.
#' `hinged_hit()`: a particle strikes a body on a hinge. `centre_of_percussion()`: where a blow
#' gives the hinge no impulse.
#'
#' A ball that meets the floor with the velocity `vy < 0` and the slip `u = vx - R omega` gets the
#' impulses
#' \deqn{J_n = -(1 + e) m v_y,\quad J_t = -\min\left(\mu J_n, \frac{\beta}{1+\beta} m |u|\right)
#'   \mathrm{sign}(u)}{J_n = -(1 + e) m vy,  J_t = -min(mu J_n, beta/(1 + beta) m |u|) sign(u)}
#' with the second where the contact sticks. With the tangential restitution e_t sticking gives a
#' share of the slip back, by (1 + e_t) of that impulse where friction allows it; e_t of a superball
#' is near 1.
#' A particle gives a hinged body, at the distance d,
#' \deqn{J = \frac{(1 + e)(v - \omega d)}{1/m + d^2/I_p},\quad
#'   J_{hinge} = J\left(\frac{M a d}{I_p} - 1\right)}{
#'   J = (1 + e) (v - omega d)/(1/m + d^2/I_p),  J_hinge = J (M a d/I_p - 1)}
#' with the distance a of its centre of mass. Losses are products of one sign: a collision never
#' gains energy. Bodies that do not approach keep their motion.
#'
#' @param body A `rot_body` that is round about its own z axis, such as [body_sphere()]. For
#'   `hinged_hit()` and `centre_of_percussion()`: a `rot_body`, hinged with the axis along its own
#'   z. A [body_point()] on a rod without mass makes a ballistic pendulum.
#' @param vx_m_per_s,vy_m_per_s Velocity before, x along the floor and y up.
#' @param omega_rad_per_s Angular velocity before; of the ball positive where it rolls towards +x,
#'   of a hinged body where the point struck moves along the particle's positive velocity.
#' @param restitution Coefficient of restitution, 0 to 1. 0: a particle sticks to the hinged body.
#' @param tangential_restitution Share of the slip that is returned where the contact sticks, 0 to
#'   1.
#' @param friction Coefficient of friction, at least 0; Inf: the contact sticks.
#' @param centre_m Distance of the body's centre of mass from the hinge, at least 0.
#' @param distance_m Distance of the point struck from the hinge; negative beyond the hinge.
#' @param particle_mass_kg Mass of the particle, greater than 0.
#' @param particle_v_m_per_s Its velocity, across the line from the hinge to the point struck. It
#'   meets the body where it is faster than that point; else nothing changes.
#' @param ... Not used: an unknown argument is an error.
#' @return `ball_bounce()`, `hinged_hit()`: a tibble (class `rot_collision`, see
#'   [collision_ledger()]) with a row for each element of the arguments, which have length 1 or n;
#'   NA in a row gives NA. The columns are
#'   `r describe_columns(bounce_columns)`
#'   and `r describe_columns(setdiff(hinged_columns, bounce_columns))`
#'   `centre_of_percussion()`: distances in m from the hinge; Inf for a hinge at the centre of mass.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision, such as an energy: it is Inf.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` with the row of
#'   the first value outside its domain, `rotdyn_error_unit`, `rotdyn_error_missing`,
#'   `rotdyn_error_argument`.
#' @source Routh, Dynamics of a System of Rigid Bodies, part 1 (1905), chapters 4 and 8; Garwin, Am.
#'   J. Phys. 37 (1969) 88, for the superball.
#' @seealso [collide()] for two free bodies, [disks_lock()], [angular_impulse()], [scene_incline()]
#'   for a ball that slides and rolls.
#' @concept collision
#' @concept impulse
#' @concept bowling
#' @concept bouncing ball
#' @concept baseball bat
#' @concept ballistic pendulum
#' @examples
#' ball_bounce(
#'   body_sphere(0.06, 0.033), vx_m_per_s = 20, vy_m_per_s = -5, omega_rad_per_s = c(-300, 0),
#'   restitution = 0.75, friction = 0.5
#' )
#' stick <- body_rod(2, 1.2)
#' hinged_hit(stick, 0.6, distance_m = 1.2, particle_mass_kg = 0.05, particle_v_m_per_s = 30)
#' centre_of_percussion(stick, 0.6) # 2/3 of the length
#' @name impact
NULL

#' @rdname impact
#' @export
ball_bounce <- function(body, vx_m_per_s, vy_m_per_s, omega_rad_per_s = 0, restitution = 1,
                        friction = 0, tangential_restitution = 0, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "vx_m_per_s", "vy_m_per_s"), call)
  check_rolls(check_body(body, call), call)
  inertia <- one_inertia(body, "body", call)
  radius <- rolling_radius(body, inertia, call)
  columns <- impact_columns(list(
    vx_m_per_s = vx_m_per_s, vy_m_per_s = vy_m_per_s, omega_rad_per_s = omega_rad_per_s,
    restitution = restitution, friction = friction,
    tangential_restitution = tangential_restitution
  ), call)
  beta <- inertia / body$mass_kg / radius / radius
  out <- .Call(ffi_impact_bounce, unname(c(list(body$mass_kg, radius, beta), columns)))
  out$sticks <- as.logical(out$sticks)
  ball <- list(
    mass_kg = body$mass_kg, second_moment_kg_m2 = planar_second(inertia),
    attitude = planar_attitude, centre_m = cbind(0, radius, 0), radius_m = radius,
    v = cbind(columns$vx_m_per_s, columns$vy_m_per_s, 0),
    omega = cbind(0, 0, -columns$omega_rad_per_s), after_v = c("vx_m_per_s", "vy_m_per_s", ""),
    after_omega = c("", "", "-omega_rad_per_s")
  )
  floor <- list(
    point_m = cbind(0, 0, 0), impulse = c("friction_impulse_n_s", "normal_impulse_n_s", "")
  )
  new_collision(
    out, length(out[[1]]), list("the ball" = ball), list("the floor" = floor),
    list("the contact" = cbind(0, 0, 0), "the centre" = cbind(0, radius, 0)), call,
    normal = cbind(0, 1, 0)
  )
}

# A moment of inertia about z, as the second moment that has it.
planar_second <- function(inertia) {
  cbind(inertia / 2, 0, 0, 0, inertia / 2, 0, 0, 0, 0, deparse.level = 0)
}
planar_attitude <- matrix(as.double(diag(3)), 1L)

#' @rdname impact
#' @export
hinged_hit <- function(body, centre_m, distance_m, particle_mass_kg, particle_v_m_per_s,
                       restitution = 0, omega_rad_per_s = 0, ...) {
  call <- check_no_dots(...)
  check_supplied(
    c("body", "centre_m", "distance_m", "particle_mass_kg", "particle_v_m_per_s"), call
  )
  check_body(body, call)
  columns <- impact_columns(list(
    centre_m = centre_m, distance_m = distance_m, omega_rad_per_s = omega_rad_per_s,
    particle_mass_kg = particle_mass_kg, particle_v_m_per_s = particle_v_m_per_s,
    restitution = restitution
  ), call)
  inertia <- hinged_inertia(body, columns$centre_m, call)
  out <- .Call(ffi_impact_hinged, unname(c(list(inertia, body$mass_kg), columns)))
  n <- length(out[[1]])
  # The hinge at the origin, the body along x, the particle along y.
  a <- columns$centre_m
  hinged <- list(
    mass_kg = body$mass_kg, second_moment_kg_m2 = planar_second(own_inertia(body)),
    attitude = planar_attitude, centre_m = cbind(a, 0, 0),
    v = cbind(0, columns$omega_rad_per_s * a, 0),
    omega = cbind(0, 0, columns$omega_rad_per_s), after_v = cbind(0, out$omega_rad_per_s * a, 0),
    after_omega = c("", "", "omega_rad_per_s")
  )
  particle <- list(
    mass_kg = columns$particle_mass_kg, second_moment_kg_m2 = matrix(0, 1L, 9L),
    attitude = planar_attitude, centre_m = cbind(columns$distance_m, 0, 0),
    v = cbind(0, columns$particle_v_m_per_s, 0), omega = cbind(0, 0, 0),
    after_v = c("", "particle_v_m_per_s", ""), after_omega = c("", "", "")
  )
  hinge <- list(point_m = cbind(0, 0, 0), impulse = c("", "hinge_impulse_n_s", ""))
  new_collision(
    out, n, list("the body" = hinged, "the particle" = particle), list("the hinge" = hinge),
    list(
      "the hinge" = cbind(0, 0, 0), "the contact" = cbind(columns$distance_m, 0, 0),
      "the centre" = cbind(a, 0, 0)
    ), call,
    contact = cbind(columns$distance_m, 0, 0)
  )
}

#' @rdname impact
#' @export
centre_of_percussion <- function(body, centre_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "centre_m"), call)
  check_body(body, call)
  centre <- impact_columns(list(centre_m = centre_m), call)$centre_m
  hinged_inertia(body, centre, call) / (body$mass_kg * centre)
}

# About the centre of mass, along z: 0 of a point mass.
own_inertia <- function(body) moment_about_axis(body, c(0, 0, 1))

# The moment about a hinge at that distance from the centre of mass.
hinged_inertia <- function(body, centre_m, call) {
  inertia <- own_inertia(body) + body$mass_kg * centre_m^2
  bad <- which(!(is.finite(inertia) & inertia > 0) & !is.na(centre_m))
  if (length(bad)) {
    abort_rotdyn(c(
      "The body must have a moment of inertia about its hinge, finite and greater than 0.",
      x = "It is {format(inertia[bad[1]])} kg m^2
           {if (length(inertia) > 1) paste('in row', bad[1])}.",
      i = "A point mass has one where {.arg centre_m}, its distance from the hinge, is not 0."
    ), "value", call)
  }
  inertia
}

impact_units <- c(
  vx_m_per_s = "m/s", vy_m_per_s = "m/s", omega_rad_per_s = "rad/s", restitution = "1",
  friction = "1", centre_m = "m", distance_m = "m", particle_mass_kg = "kg",
  particle_v_m_per_s = "m/s", tangential_restitution = "1", omega_1_rad_per_s = "rad/s",
  omega_2_rad_per_s = "rad/s", radius_1_m = "m", radius_2_m = "m", largest_impulse_n_s = "N*s"
)
# From 0; from 0 to 1; greater than 0; that may be infinite.
impact_least_0 <- c("friction", "centre_m", "particle_mass_kg", "largest_impulse_n_s", "radius_1_m")
impact_shares <- c("restitution", "tangential_restitution")
impact_open <- c("particle_mass_kg", "radius_1_m")
impact_limits <- c("friction", "largest_impulse_n_s")

# Columns in SI, each value in its domain.
impact_columns <- function(columns, call) {
  columns <- check_columns_of(columns, impact_units[names(columns)], call)
  check_recyclable(columns, call)
  for (name in names(columns)) {
    x <- columns[[name]]
    lower <- if (name %in% c(impact_shares, impact_least_0)) 0 else -Inf
    upper <- if (name %in% impact_shares) 1 else Inf
    open <- name %in% impact_open
    bad <- x < lower | x > upper | (open & x == lower) |
      (is.infinite(x) & !name %in% impact_limits)
    if (any(bad, na.rm = TRUE)) {
      at <- which(bad)[1]
      abort_domain(
        x[at], name, impact_units[[name]], call, lower, upper, open,
        row = if (length(x) > 1L) at
      )
    }
  }
  columns
}
