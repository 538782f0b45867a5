#' Two bodies that collide at a point
#'
#' Velocities after a collision of two free rigid bodies, or of one with a fixed obstacle, in three
#' dimensions, with restitution and friction. The collision takes no time: positions stay,
#' velocities jump. Many collisions are one call.
#'
#' The velocity u of the point of contact of body 1 over that of body 2 follows the impulse p,
#' `du = K dp` with the inverse inertia K of the contact (Keller). While the normal impulse grows,
#' friction is `-mu` times its increment along the slip, which turns on the way; a slip that stops
#' either sticks, where friction can hold it, or starts again in the one direction in which it can
#' grow. Stick and slip in a fixed direction are in closed form; a slip that turns is integrated by
#' series of order 23.
#'
#' What ends the collision is the `coefficient`:
#'
#' | `coefficient` | the end | |
#' |---|---|---|
#' | `"energetic"` | work of restitution = e^2 work of compression | Stronge; energy never grows |
#' | `"kinetic"` | impulse of restitution = e impulse of compression | Poisson |
#' | `"kinematic"` | normal velocity after = -e normal velocity before | Newton; may create energy |
#'
#' They agree where the slip does not change its direction, and without friction. Where the normal
#' and the tangential motion are coupled (the normal misses the centre of mass) and the slip stops
#' or turns, the kinematic coefficient may end with more energy than there was: `creates_energy`.
#'
#' @param body_1,body_2 A `rot_body`, or a list of them, one for each collision. Without `body_2`
#'   body 1 meets a fixed obstacle.
#' @param ... Not used: the other arguments are given by name.
#' @param velocity_1_m_per_s,velocity_2_m_per_s,omega_1_rad_per_s,omega_2_rad_per_s Velocities of
#'   the centres of mass and angular velocities before. Vectors are three numbers, for each
#'   collision a row of a matrix with three columns, or a data frame of three columns; in the axes
#'   of space.
#' @param normal Normal of the contact, out of body 2 (or the obstacle) and into body 1, of any
#'   length but 0. Body 1 approaches against it: of a ball that moves along +x and hits another one,
#'   it is `c(-1, 0, 0)`.
#' @param arm_1_m,arm_2_m From the centre of mass to the point of contact. NULL: for a sphere its
#'   radius along the normal, for a point mass 0.
#' @param restitution,friction Coefficients: 0 to 1; at least 0, or Inf.
#' @param coefficient What the coefficient of restitution refers to, see above.
#' @param separating What is done where the bodies separate at the contact, along this normal:
#'   `"refuse"`, an error, since most often the normal has the wrong sign; or `"keep"`: such bodies
#'   keep their motion, with an impulse of 0.
#' @param attitude_1,attitude_2 Rotation of the body's own axes in space: a 3 x 3 matrix, a
#'   quaternion (scalar first), or a matrix with a quaternion in each row; orthogonal, or of length
#'   1, within 1e-8. NULL: none.
#' @return A tibble (class `rot_collision`), a row for each collision:
#'   `r describe_columns(collide_columns)`
#'   without those of body 2 where there is none. NA in a row gives NA. Bodies that touch without
#'   approaching keep their motion: their impulse is 0. `creates_energy` is TRUE where the energy
#'   grows by more than rounding. See [collision_ledger()] for the balances of a row.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_missing`,
#'   `rotdyn_error_argument`, `rotdyn_error_unit`; `rotdyn_error_value` for numbers outside their
#'   domain, where the bodies separate along the normal, and where the impulse would turn a rod
#'   about its own axis, where it has no inertia. A row beyond double precision is NaN, an
#'   energy alone Inf, with a warning (`rotdyn_warning_range`).
#' @source Stronge, Impact Mechanics (2000), chapters 4 and 8; Keller, J. Appl. Mech. 53 (1986) 1;
#'   Routh, Dynamics of a System of Rigid Bodies, part 1 (1905), chapter 8.
#' @seealso [collision_ledger()], [ball_bounce()] and [hinged_hit()] for bodies on a floor and on a
#'   hinge, [conserved()].
#' @concept collision
#' @concept restitution
#' @concept billiards
#' @concept hockey puck
#' @examples
#' # A rod falls on the floor, inclined by 30 degrees.
#' rod <- body_rod(1, 1)
#' end <- c(-0.5 * cos(pi / 6), 0, -0.5 * sin(pi / 6))
#' hit <- collide(
#'   rod, velocity_1_m_per_s = c(0, 0, -3), normal = c(0, 0, 1), arm_1_m = end,
#'   attitude_1 = rotation_about("y", angle_deg = -30), restitution = 0.6, friction = 0.3
#' )
#' hit[c("vx_1_m_per_s", "vz_1_m_per_s", "omega_y_1_rad_per_s", "sticks")]
#' collision_ledger(hit)
#'
#' # Two billiard balls, one at rest, for three aims.
#' ball <- body_sphere(0.17, 0.0286)
#' aim <- cbind(-cos(0:2 / 2), sin(0:2 / 2), 0)
#' collide(
#'   ball, ball, velocity_1_m_per_s = c(2, 0, 0), velocity_2_m_per_s = c(0, 0, 0), normal = aim,
#'   restitution = 0.95, friction = 0.06
#' )
#' @export
collide <- function(body_1, body_2 = NULL, ..., velocity_1_m_per_s, velocity_2_m_per_s = c(0, 0, 0),
                    omega_1_rad_per_s = c(0, 0, 0), omega_2_rad_per_s = c(0, 0, 0), normal,
                    arm_1_m = NULL, arm_2_m = NULL, restitution = 1, friction = 0,
                    coefficient = c("energetic", "kinetic", "kinematic"), attitude_1 = NULL,
                    attitude_2 = NULL, separating = c("refuse", "keep")) {
  call <- check_no_dots(...)
  check_supplied(c("body_1", "velocity_1_m_per_s", "normal"), call)
  laws <- c("energetic", "kinetic", "kinematic")
  law <- check_choice(coefficient, "coefficient", laws, call)
  separating <- check_choice(separating, "separating", c("refuse", "keep"), call)
  normal <- as_vectors(normal, "normal", "1", call)
  check_normals(normal, call)
  normal <- unit_rows(normal)
  numbers <- impact_columns(list(restitution = restitution, friction = friction), call)
  numbers <- lapply(numbers, as.double)
  party <- function(body, i, v, omega, arm, attitude) {
    name <- function(text) sprintf(text, i)
    masses <- colliding_bodies(body, name("body_%d"), call)
    c(masses, list(
      v = as_vectors(v, name("velocity_%d_m_per_s"), "m/s", call),
      omega = as_vectors(omega, name("omega_%d_rad_per_s"), "rad/s", call),
      arm_m = contact_arm(arm, body, normal, c(-1, 1)[i], name("arm_%d_m"), call),
      attitude = as_attitudes(attitude, name("attitude_%d"), call)
    ))
  }
  first <- party(body_1, 1L, velocity_1_m_per_s, omega_1_rad_per_s, arm_1_m, attitude_1)
  second <- if (!is.null(body_2)) {
    party(body_2, 2L, velocity_2_m_per_s, omega_2_rad_per_s, arm_2_m, attitude_2)
  } else {
    check_no_second(list(
      velocity_2_m_per_s = velocity_2_m_per_s, omega_2_rad_per_s = omega_2_rad_per_s,
      arm_2_m = arm_2_m, attitude_2 = attitude_2
    ), call)
  }
  rows <- function(x) if (is.matrix(x)) nrow(x) else length(x)
  words <- c(
    mass_kg = "body_%d", second_moment_kg_m2 = "body_%d", v = "velocity_%d_m_per_s",
    omega = "omega_%d_rad_per_s", arm_m = "arm_%d_m", attitude = "attitude_%d"
  )
  label <- function(party, i) {
    if (is.null(party)) list() else stats::setNames(party, sprintf(words[names(party)], i))
  }
  all <- c(label(first, 1L), label(second, 2L), list(normal = normal), numbers)
  n <- check_recyclable(lapply(all, function(x) seq_len(rows(x))), call)
  approach <- contact_speeds(first, second, normal, n)
  if (separating == "refuse") check_approach(approach, call)
  contact <- c(list(normal = normal, law = match(law, laws) - 1), numbers)
  out <- .Call(ffi_collide, first, second, contact, as.double(n))
  if (out[[2]] > 0) {
    abort_rotdyn(c(
      "The impulse would turn a body about an axis about which it has no moment of inertia.",
      x = "In row {out[[2]]}: the point of contact is not on the line or at the point that the body
           is.",
      i = "Give the body a radius, as {.fn body_cylinder} has."
    ), "value", call)
  }
  columns <- out[[1]]
  columns$sticks <- as.logical(columns$sticks)
  # Both losses are rounded relative to the work of the impulses.
  work <- approach$size * (columns$normal_impulse_n_s + columns$friction_impulse_n_s)
  columns$creates_energy <-
    columns$normal_loss_j + columns$friction_loss_j < -64 * .Machine$double.eps * work
  parties <- list("body 1" = collide_party(first, 1L, ball_radii(body_1)))
  if (!is.null(second)) parties[["body 2"]] <- collide_party(second, 2L, ball_radii(body_2))
  impulse <- c("impulse_x_n_s", "impulse_y_n_s", "impulse_z_n_s")
  outside <- if (is.null(second)) {
    list("the obstacle" = list(point_m = matrix(0, 1, 3), impulse = impulse))
  }
  new_collision(
    columns, n, parties, outside, list("the contact" = matrix(0, 1, 3)), call,
    normal = normal
  )
}

# Unit vectors of rows of any length but 0, also of one whose square is not a double.
unit_rows <- function(x) {
  x <- x / apply(abs(x), 1L, max)
  x / sqrt(rowSums(x^2))
}

# For n collisions, of the velocity of body 1 at the contact over that of body 2: list(normal, its
# part along the normal; rounding, of that part; size, of the whole).
contact_speeds <- function(first, second, normal, n) {
  rows <- function(x) x[rep_len(seq_len(nrow(x)), n), , drop = FALSE]
  turned <- function(party) {
    w <- rows(party$omega)
    r <- rows(party$arm_m)
    cbind(
      w[, 2] * r[, 3] - w[, 3] * r[, 2], w[, 3] * r[, 1] - w[, 1] * r[, 3],
      w[, 1] * r[, 2] - w[, 2] * r[, 1]
    )
  }
  length_of <- function(x) sqrt(rowSums(x^2))
  parts <- c(
    list(rows(first$v), turned(first)), if (!is.null(second)) list(rows(second$v), turned(second))
  )
  sign <- c(1, 1, -1, -1)[seq_along(parts)]
  u <- Reduce(`+`, Map(`*`, parts, sign))
  sizes <- Reduce(`+`, lapply(parts, length_of))
  list(
    normal = rowSums(u * rows(normal)), rounding = 16 * .Machine$double.eps * sizes,
    size = length_of(u)
  )
}

check_approach <- function(approach, call) {
  away <- which(approach$normal > approach$rounding & is.finite(approach$rounding))
  if (length(away)) {
    abort_rotdyn(c(
      "The bodies separate at the contact: {.arg normal} must point out of body 2 (or the obstacle)
       and into body 1, which approaches against it.",
      x = "{if (length(approach$normal) > 1) paste0('In row ', away[1], ' they') else 'They'} move
           apart along it at {format_si(approach$normal[away[1]])} m/s.",
      i = "Give {.arg normal} the other sign; or {.code separating = \"keep\"}: bodies that do not
           meet keep their motion."
    ), "value", call)
  }
}

# Mass and second moment, a row each for one body or for n of them.
colliding_bodies <- function(body, arg, call) {
  many <- is.list(body) && !is.object(body)
  if (!many) body <- list(body)
  if (!length(body)) abort_rotdyn("{.arg {arg}} is empty.", "size", call)
  for (i in seq_along(body)) {
    check_body(body[[i]], call, if (many) paste0(arg, "[[", i, "]]") else arg)
  }
  list(
    mass_kg = vapply(body, function(b) as.double(b$mass_kg), double(1)),
    second_moment_kg_m2 = matrix(
      vapply(body, function(b) as.double(b$second_moment_kg_m2), double(9)), ncol = 9L,
      byrow = TRUE
    )
  )
}

# A matrix with a vector in each row.
as_vectors <- function(x, arg, unit, call) {
  refuse <- function() {
    abort_rotdyn(c(
      "{.arg {arg}} must be three numbers{in_unit(unit)}, or a table with three columns of them.",
      x = "It is {describe_value(x)}."
    ), if (is_number(x) && !is.object(x)) "size" else "type", call)
  }
  if (is.data.frame(x)) {
    if (length(x) != 3L) refuse()
    x <- lapply(seq_along(x), function(i) check_column(x[[i]], names(x)[i], unit, call))
    return(matrix(unlist(x, use.names = FALSE), ncol = 3L))
  }
  if (is.matrix(x) && is.numeric(x) && !is.object(x)) {
    if (ncol(x) != 3L) refuse()
    return(matrix(as.double(x), ncol = 3L))
  }
  x <- check_column(x, arg, unit, call)
  if (length(x) != 3L) refuse()
  matrix(as.double(x), 1L, 3L)
}

check_normals <- function(normal, call) {
  bad <- which(rowSums(normal != 0) == 0 | rowSums(is.infinite(normal)) > 0)
  if (length(bad)) {
    abort_rotdyn(c(
      "{.arg normal} must be finite and not 0.", x = "It is not in row {bad[1]}."
    ), "value", call)
  }
}

round_shapes <- c("sphere", "hollow_sphere", "spherical_shell")

ball_radius <- function(body) {
  sizes <- body$size_m
  if (all(body$second_moment_kg_m2 == 0)) return(0)
  if (body$shape %in% round_shapes) {
    unname(sizes[names(sizes) %in% c("radius_m", "outer_radius_m")][1])
  }
}

# One of each body, or NULL where a body has none.
ball_radii <- function(bodies) {
  radii <- lapply(if (inherits(bodies, "rot_body")) list(bodies) else bodies, ball_radius)
  if (!any(vapply(radii, function(r) is.null(r) || is.na(r), NA))) unlist(radii, use.names = FALSE)
}

# NULL: a sphere has its radius along the normal, a point mass nothing. A row for each body, or for
# each normal.
contact_arm <- function(arm, bodies, normal, sign, arg, call) {
  if (!is.null(arm)) return(as_vectors(arm, arg, "m", call))
  radius <- ball_radii(bodies)
  if (is.null(radius)) {
    abort_rotdyn(c(
      "{.arg {arg}} is missing: spheres and point masses need none, any other body does.",
      i = "It leads from the centre of mass to the point of contact."
    ), "missing", call)
  }
  n <- max(length(radius), nrow(normal))
  sign * rep_len(radius, n) * normal[rep_len(seq_len(nrow(normal)), n), , drop = FALSE]
}

# A rotation matrix by columns in each row.
as_attitudes <- function(attitude, arg, call) {
  quaternions <- is.matrix(attitude) && ncol(attitude) == 4L && is.numeric(attitude)
  if (!quaternions) return(matrix(as_rotation(attitude, arg, call), 1L, 9L))
  q <- unname(attitude)
  off <- abs(sqrt(rowSums(q^2)) - 1)
  bad <- which(off > 1e-8)
  if (length(bad)) {
    abort_rotdyn(c(
      "{.arg {arg}} must have a unit quaternion in each row.",
      x = "The norm in row {bad[1]} is off by {format(off[bad[1]], digits = 3)}."
    ), "value", call)
  }
  q <- q / sqrt(rowSums(q^2))
  w <- q[, 1]
  x <- q[, 2]
  y <- q[, 3]
  z <- q[, 4]
  matrix(c(
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)
  ), ncol = 9L)
}

check_no_second <- function(given, call) {
  moved <- vapply(given, function(x) !is.null(x) && !all(unlist(x) %in% 0), NA)
  if (any(moved)) {
    abort_rotdyn(c(
      "{.arg {names(given)[moved]}} refer{?s/} to {.arg body_2}, which is missing.",
      i = "Without {.arg body_2} body 1 meets a fixed obstacle."
    ), "argument", call)
  }
}

# With the origin at the point of contact.
collide_party <- function(party, i, radius) {
  list(
    mass_kg = party$mass_kg, second_moment_kg_m2 = party$second_moment_kg_m2,
    attitude = party$attitude, centre_m = -party$arm_m, radius_m = radius, v = party$v,
    omega = party$omega,
    after_v = sprintf(c("vx_%d_m_per_s", "vy_%d_m_per_s", "vz_%d_m_per_s"), i),
    after_omega = sprintf(
      c("omega_x_%d_rad_per_s", "omega_y_%d_rad_per_s", "omega_z_%d_rad_per_s"), i
    )
  )
}
