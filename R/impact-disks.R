#' Two disks that lock, or whose rims meet
#'
#' `disks_lock()`: two disks on one axle come to a common angular velocity, at once: no torque from
#' outside acts, so the angular momentum is conserved. `rims_meet()`: the rims of two disks on
#' fixed axles touch, or two gears mesh: friction acts until the rims roll on each other. The axles
#' take the reaction, so the angular momentum of both together is *not* conserved.
#'
#' \deqn{\omega = \frac{I_1 \omega_1 + I_2 \omega_2}{I_1 + I_2},\quad
#'   \Delta K = -\frac12 \frac{I_1 I_2}{I_1 + I_2} (\omega_1 - \omega_2)^2}{
#'   omega = (I1 omega1 + I2 omega2)/(I1 + I2),
#'   Delta K = -1/2 I1 I2/(I1 + I2) (omega1 - omega2)^2}
#' and for the rims, with the slip u,
#' \deqn{J = -\frac{u}{R_1^2/I_1 + R_2^2/I_2},\quad u = R_1 \omega_1 + R_2 \omega_2}{
#'   J = -u/(R1^2/I1 + R2^2/I2),  u = R1 omega1 + R2 omega2}
#' The time that it takes, and the torque, are those of [clutch_engagement()] and [scene_clutch()].
#'
#' @param body_1,body_2 A `rot_body` (its Izz counts), or one moment of inertia in kg m^2, > 0.
#' @param omega_1_rad_per_s,omega_2_rad_per_s Angular velocities before, in one sense for both.
#' @param radius_1_m,radius_2_m Radii of the rims, those of the bodies by default: the first greater
#'   than 0, the second not 0; a negative one is a ring gear, whose rim lies around disk 1.
#' @param restitution Share of the slip that the contact gives back, 0 to 1.
#' @param largest_impulse_n_s The most that friction can give while the rims touch, `mu N` times the
#'   time; Inf: until they roll on each other, as gears do.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble (class `rot_collision`, see [collision_ledger()]), a row for each element of the
#'   arguments, which have length 1 or n; NA in a row gives NA.
#'   `disks_lock()`: `r describe_columns(lock_columns, c(friction_loss_j = "energy lost"))`
#'   `rims_meet()`: `r describe_columns(rims_columns, rims_meanings)`
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision, such as an energy: it is Inf.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source OpenStax, University Physics 1 (2016), section 11.3; Routh, Dynamics of a System of Rigid
#'   Bodies, part 1 (1905), chapter 4.
#' @seealso [clutch_engagement()], [gear_train()], [collision_ledger()].
#' @concept collision
#' @concept gear
#' @concept merry-go-round
#' @concept flywheel
#' @concept clutch
#' @concept conservation of angular momentum
#' @examples
#' # A flywheel at 600 rpm couples to one at rest with three times its moment of inertia.
#' lock <- disks_lock(1, 3, omega_1_rad_per_s = 600 * pi / 30, omega_2_rad_per_s = 0)
#' lock$common_omega_rad_per_s * 30 / pi
#' collision_ledger(lock)
#' # Two gears mesh: the axles take an angular impulse.
#' mesh <- rims_meet(
#'   body_disk(2, 0.1), body_disk(8, 0.2), omega_1_rad_per_s = 60, omega_2_rad_per_s = 0
#' )
#' collision_ledger(mesh)
#' @name disks
NULL

#' @rdname disks
#' @export
disks_lock <- function(body_1, body_2, omega_1_rad_per_s, omega_2_rad_per_s, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body_1", "body_2", "omega_1_rad_per_s", "omega_2_rad_per_s"), call)
  inertia <- c(one_inertia(body_1, "body_1", call), one_inertia(body_2, "body_2", call))
  columns <- impact_columns(list(
    omega_1_rad_per_s = omega_1_rad_per_s, omega_2_rad_per_s = omega_2_rad_per_s
  ), call)
  out <- rims(inertia, list(1, -1), columns, list(0, Inf))
  out <- list(
    common_omega_rad_per_s = out$omega_1_rad_per_s, angular_impulse_n_m_s = out$impulse_n_s,
    friction_loss_j = out$friction_loss_j
  )
  common <- rep("common_omega_rad_per_s", 2)
  new_collision(
    out, length(out[[1]]), disk_parties(inertia, columns, cbind(0, 0, 0), common), list(),
    list("the axle" = cbind(0, 0, 0)), call
  )
}

#' @rdname disks
#' @export
rims_meet <- function(body_1, body_2, omega_1_rad_per_s, omega_2_rad_per_s, restitution = 0,
                      largest_impulse_n_s = Inf, ..., radius_1_m = body_1, radius_2_m = body_2) {
  call <- check_no_dots(...)
  check_supplied(c("body_1", "body_2", "omega_1_rad_per_s", "omega_2_rad_per_s"), call)
  alone <- c(
    radius_1_m = missing(radius_1_m) && !inherits(body_1, "rot_body"),
    radius_2_m = missing(radius_2_m) && !inherits(body_2, "rot_body")
  )
  if (any(alone)) {
    abort_rotdyn(
      "{.arg {names(alone)[alone]}} {?is/are} missing: a moment of inertia has no radius.",
      "missing", call
    )
  }
  inertia <- c(one_inertia(body_1, "body_1", call), one_inertia(body_2, "body_2", call))
  columns <- impact_columns(list(
    radius_1_m = radius_1_m, radius_2_m = radius_2_m, omega_1_rad_per_s = omega_1_rad_per_s,
    omega_2_rad_per_s = omega_2_rad_per_s, restitution = restitution,
    largest_impulse_n_s = largest_impulse_n_s
  ), call)
  flat <- which(columns$radius_2_m == 0)
  if (length(flat)) abort_rotdyn("{.arg radius_2_m} must not be 0.", "value", call)
  out <- rims(inertia, columns[1:2], columns[3:4], columns[5:6])
  out$locked <- as.logical(out$locked)
  second <- cbind(columns$radius_1_m + columns$radius_2_m, 0, 0)
  new_collision(
    out, length(out[[1]]),
    disk_parties(
      inertia, columns[3:4], second, c("omega_1_rad_per_s", "omega_2_rad_per_s"), columns[1:2]
    ),
    list(
      "axle 1" = list(point_m = cbind(0, 0, 0), impulse = c("", "-impulse_n_s", "")),
      "axle 2" = list(point_m = second, impulse = c("", "impulse_n_s", ""))
    ),
    list("axle 1" = cbind(0, 0, 0), "axle 2" = second), call,
    contact = cbind(columns$radius_1_m, 0, 0)
  )
}

rims_meanings <- c(
  omega_1_rad_per_s = "angular velocity of disk 1, after",
  omega_2_rad_per_s = "angular velocity of disk 2, after",
  impulse_n_s = "on the rim of disk 1, positive where it speeds up a positive omega",
  locked = "FALSE where friction did not end the slip"
)

rims <- function(inertia, radius, omega, contact) {
  .Call(ffi_impact_rims, unname(c(list(inertia[1], inertia[2]), radius, omega, contact)))
}

# Disks on fixed axles: their masses do not move.
disk_parties <- function(inertia, omega, second, after, radius = list(NULL, NULL)) {
  party <- function(i, centre) {
    list(
      radius_m = radius[[i]],
      mass_kg = 0, second_moment_kg_m2 = planar_second(inertia[i]), attitude = planar_attitude,
      centre_m = centre, v = cbind(0, 0, 0), omega = cbind(0, 0, omega[[i]]),
      after_v = c("", "", ""), after_omega = c("", "", after[i])
    )
  }
  list("disk 1" = party(1L, cbind(0, 0, 0)), "disk 2" = party(2L, second))
}
