#' The flips of a tumbling body
#'
#' The time between two flips of a body that turns freely: between two zeros of the component of
#' its angular velocity along the middle axis. With \eqn{I_1 < I_2 < I_3} it is
#' \deqn{t = \frac{2 K(m)}{\lambda},\quad
#'   \lambda^2 = \frac{(L^2 - 2 T I_1)(I_3 - I_2)}{I_1 I_2 I_3}\quad(L^2 > 2 T I_2)}{
#'   t = 2 K(m)/lambda,  lambda^2 = (L^2 - 2 T I1) (I3 - I2)/(I1 I2 I3)  where L^2 > 2 T I2}
#' and the same with 1 and 3 exchanged where \eqn{L^2 < 2 T I_2}{L^2 < 2 T I2}. Spun about the
#' middle axis with small rates e beside it, the time grows with `log(1/e)`: the flips come late,
#' and all of a sudden.
#'
#' @param body A `rot_body`, a 3 x 3 inertia tensor, three principal moments in kg m^2 about the
#'   body's axes x, y and z, or a matrix with such a row for each body. Or a [scene_free()] without
#'   torque, resistance and rotors, which knows its angular velocity.
#' @param omega_rad_per_s Three components of the angular velocity in the body's axes, or a matrix
#'   with such a row for each motion.
#' @param ... Not used; names after it must be given in full.
#' @return Times in s, one for each row: Inf for a spin about a principal axis, for equal moments
#'   about the axes of the spin, and on the separatrix. NA for a row with NA, and for a spin about
#'   an axis without moment of inertia. The numbers count as exact: some ulp, also next to the
#'   separatrix.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`, `rotdyn_error_inertia`.
#' @source Landau and Lifshitz, Mechanics, 3rd ed. (1976), section 37.
#' @seealso [scene_free()] for the motion, [spin_stability()], [polhode()].
#' @concept Dzhanibekov
#' @concept intermediate axis theorem
#' @concept tennis racket theorem
#' @concept tennis racket
#' @concept wing nut
#' @examples
#' flip_time(c(1, 2, 3), c(0.01, 4, 0.01))
#' flip_time(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)))
#' # A tenth of the disturbance, one more flip later:
#' flip_time(c(1, 2, 3), cbind(10^-(1:6), 4, 0))
#' flip_time(body_box(0.2, 0.02, 0.1, 0.2), c(0.1, 0.1, 10))
#' @export
flip_time <- function(body, omega_rad_per_s, ...) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  if (inherits(body, "rot_scene")) {
    return(flip_time_of_scene(body, missing(omega_rad_per_s), call))
  }
  check_supplied("omega_rad_per_s", call)
  rates <- rows_of_three(omega_rad_per_s, "omega_rad_per_s", "rad/s", call)
  table <- is.matrix(body) && is.numeric(body) && !is.object(body) &&
    !identical(dim(body), c(3L, 3L))
  if (table) {
    moments <- rows_of_three(body, "body", "kg*m^2", call)
    for (one in moments) check_not_negative(one, "body", "kg*m^2", call)
  } else {
    inertia <- free_inertia(body, call)
    moments <- as.list(inertia$moment_of_inertia_kg_m2)
    if (inertia$axes[1] != 1) {
      rates <- unname(.Call(ffi_attitude_turn, c(as.list(inertia$axes), rates), 0))
    }
  }
  check_recyclable(list(body = moments[[1]], omega_rad_per_s = rates[[1]]), call)
  .Call(ffi_free_flips, moments, rates)
}

flip_time_of_scene <- function(scene, alone, call) {
  check_scene_of(scene, "free", call)
  if (!alone) abort_rotdyn("{.arg omega_rad_per_s} is known of a scene.", "argument", call)
  acts <- acts_on_flips(scene)
  if (length(acts)) {
    abort_rotdyn(c(
      "There is no closed form of the flips of a body with {.field {acts}}.",
      i = "The events {.val flip} of {.fn trajectory} are theirs."
    ), "model", call)
  }
  scene_flip_time(scene)
}

# Three columns of a vector of three numbers, or of a matrix.
rows_of_three <- function(x, arg, unit, call) {
  if (is.matrix(x)) {
    if (ncol(x) != 3L) abort_size_of(x[1, ], arg, 3L, call)
    return(lapply(1:3, function(k) check_column(x[, k], arg, unit, call)))
  }
  x <- check_column(x, arg, unit, call)
  if (length(x) != 3L) abort_size_of(x, arg, 3L, call)
  unname(as.list(x))
}

#' Which spins are stable
#'
#' A body spins steadily about each of its principal axes. About those of the largest and of the
#' smallest moment a small disturbance stays small, and goes round as a wobble; about the middle
#' axis it grows, until the body turns over. With the spin \eqn{\Omega} about axis k,
#' disturbances obey
#' \deqn{\ddot\epsilon = -\Omega^2\,\frac{(I_k - I_i)(I_k - I_j)}{I_i I_j}\,\epsilon.}{
#'   e'' = -Omega^2 (I_k - I_i) (I_k - I_j)/(I_i I_j) e.}
#'
#' @param body As in [flip_time()], one body.
#' @param ... Not used.
#' @return A tibble with a row for each principal axis:
#'   `r describe_columns(stability_columns)`
#'   `stability` is `"stable"`, `"unstable"`, or `"neutral"` where another moment is equal (to
#'   1e-12 of the largest): a disturbance grows evenly with time. An axis without moment of
#'   inertia has none (NA).
#' @section Errors: those of [flip_time()].
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.6.
#' @seealso [flip_time()], [principal_axes()].
#' @concept Dzhanibekov
#' @concept intermediate axis theorem
#' @concept tennis racket
#' @concept intermediate axis
#' @examples
#' spin_stability(c(1, 2, 3))
#' spin_stability(body_box(0.2, 0.02, 0.1, 0.2))
#' @export
spin_stability <- function(body, ...) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  if (inherits(body, "rot_scene")) {
    check_scene_of(body, "free", call)
    body <- body$body
  }
  inertia <- free_inertia(body, call)
  moments <- inertia$moment_of_inertia_kg_m2
  axes <- diag(3)
  if (inertia$axes[1] != 1) axes <- matrix_of_quaternion(inertia$axes, "axes", call)
  equal <- 1e-12 * max(moments)
  square <- vapply(1:3, function(k) {
    d <- moments[k] - moments[-k]
    if (moments[k] == 0) return(NA_real_)
    if (any(abs(d) <= equal)) return(0)
    (d[1] / moments[-k][1]) * (d[2] / moments[-k][2])
  }, double(1))
  as_table(
    axis = 1:3,
    principal_moment_kg_m2 = moments,
    x = axes[1, ], y = axes[2, ], z = axes[3, ],
    stability = ifelse(square > 0, "stable", ifelse(square < 0, "unstable", "neutral")),
    growth_per_omega = ifelse(square < 0, sqrt(abs(square)), 0 * square),
    wobble_per_omega = ifelse(square > 0, sqrt(abs(square)), 0 * square)
  )
}

#' Polhode and herpolhode
#'
#' The path of the tip of the angular velocity over one period of a free body: in the body (the
#' polhode, a closed curve on the ellipsoid of constant energy) and in space (the herpolhode, which
#' lies in a plane across the angular momentum and does not close).
#'
#' @param scene A [scene_free()] without torque, damping and rotors.
#' @param n Number of points, from 2 to 1e6, evenly spaced in time.
#' @param ... Not used; names after it must be given in full.
#' @return A `rot_trajectory` over one period, twice [flip_time()]; over one turn for a steady spin.
#'   [autoplot()][autoplot.rot_polhode] draws it on the ellipsoid.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value` (a torque or damping; the separatrix,
#'   which has no period), `rotdyn_error_argument`, `rotdyn_error_missing`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.6.
#' @seealso [flip_time()], [scene_free()].
#' @concept tennis racket
#' @concept herpolhode
#' @concept stability
#' @examples
#' nut <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01))
#' path <- polhode(nut)
#' plot(path$omega_x_rad_per_s, path$omega_y_rad_per_s, type = "l", asp = 1)
#' if (requireNamespace("ggplot2", quietly = TRUE)) ggplot2::autoplot(path)
#' @export
polhode <- function(scene, n = 201, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene(scene, call)
  constraint <- constraint_of(scene)
  if (constraint$id != "free" || length(constraint$effects_of(scene))) {
    abort_rotdyn(
      "{.arg scene} must be a {.fn scene_free} without torque, damping and rotors.", "value", call
    )
  }
  n <- check_number(n, "n", "1", call, lower = 2, upper = 1e6)
  found <- .Call(ffi_free_period, scene)
  if (found$kind == "separatrix") {
    abort_rotdyn("The motion on the separatrix has no period.", "value", call)
  }
  period <- if (found$kind == "none") 0 else found$period_s
  times <- scene$start_s + period * seq(0, 1, length.out = floor(n))
  out <- compute_trajectory(scene, times, 1e-9, "free_exact", "abort", 1e6, call)
  class(out) <- c("rot_polhode", class(out))
  out
}

# A half period of the motion as it starts, without torque.
# What takes a body out of the closed form of its flips.
acts_on_flips <- function(scene) {
  names <- c("torque", "resistance", "rotors")
  names[!vapply(unclass(scene)[names], is.null, NA)]
}

scene_flip_time <- function(scene) {
  omega <- scene$omega0_rad_per_s
  if (scene$axes[1] != 1) {
    omega <- unlist(.Call(ffi_attitude_turn, as.list(c(scene$axes, omega)), 0), use.names = FALSE)
  }
  .Call(ffi_free_flips, as.list(scene$moment_of_inertia_kg_m2), as.list(omega))
}
