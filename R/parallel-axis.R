#' The parallel-axis theorem
#'
#' Moves a moment of inertia or a tensor from the centre of mass to a parallel axis or another
#' point, and back.
#'
#' \deqn{I_o = I_g + m d^2, \qquad I_o = I_g + m (d^2 1 - d d^T)}{
#'   I_o = I_g + m d^2,  I_o = I_g + m (d^2 1 - d d')}
#'
#' Moving *to* the centre subtracts, which may cancel: where \eqn{m d^2} is more than 1e8 times the
#' result, half the digits are lost, and a warning of class `rotdyn_warning_digits` says how many
#' are left. A body stores its second moment about the centre, so [inertia_tensor()] does not
#' subtract.
#'
#' @param inertia_kg_m2 Moments of inertia (a vector, recycled with the others, so that it works
#'   inside `dplyr::mutate()`), or one 3 x 3 tensor whose off-diagonal elements are minus the
#'   products of inertia. Or a body, or a list of them: the mass, and the moment about the own z
#'   axis through the centre of mass, count, and the distance may be the second argument.
#' @param mass_kg Mass, at least 0; not of a body.
#' @param distance_m For moments: the distance of the two axes. For a tensor: the three components
#'   of the vector between the two points (its sign has no effect).
#' @param ... Not used; names after it must be given in full.
#' @param direction `"from_centre"`: `inertia_kg_m2` is about the centre of mass, and the result
#'   about the parallel axis. `"to_centre"`: the reverse.
#' @return Moments in kg m^2, or a 3 x 3 tensor. Each is rounded at most four times, relative to the
#'   larger of the two terms. Of moments, NA gives NA, NaN gives NaN and Inf what the formula gives.
#' @section Warnings: `rotdyn_warning_digits`; `rotdyn_warning_range` where finite numbers give a
#'   moment beyond double precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (a negative mass
#'   or distance; a moment about the centre that would be negative; of a tensor NA, NaN and Inf),
#'   `rotdyn_error_inertia` (a tensor that is not physical), `rotdyn_error_range` (a tensor beyond
#'   double precision), `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), equation 5.21.
#' @seealso [inertia_tensor()] and [moment_of_inertia()] for bodies about any axis, [join_bodies()].
#' @concept parallel axis
#' @concept Steiner
#' @concept moment
#' @concept moment of inertia
#' @examples
#' # A rod of 1.5 kg and 2 m: from its centre to its end, and back.
#' parallel_axis(0.5, mass_kg = 1.5, distance_m = 1)
#' parallel_axis(2, mass_kg = 1.5, distance_m = 1, direction = "to_centre")
#' # A disk about a point of its rim.
#' parallel_axis(body_disk(3, 0.2), distance_m = 0.2)
#' parallel_axis(diag(c(1, 2, 3)), mass_kg = 2, distance_m = c(0, 0, 0.5))
#' @export
parallel_axis <- function(inertia_kg_m2, mass_kg, distance_m, ...,
                          direction = c("from_centre", "to_centre")) {
  call <- check_no_dots(...)
  if (!missing(inertia_kg_m2) && are_bodies(inertia_kg_m2)) {
    if (missing(distance_m) && !missing(mass_kg)) {
      distance_m <- mass_kg
    } else if (!missing(mass_kg) && !are_bodies(mass_kg)) {
      abort_rotdyn("{.arg mass_kg} is known of a body.", "argument", call)
    }
    if (check_choice(direction, "direction", c("from_centre", "to_centre"), call) == "to_centre") {
      abort_rotdyn("The moment of a body is that about its centre of mass.", "value", call)
    }
    bodies <- if (inherits(inertia_kg_m2, "rot_body")) list(inertia_kg_m2) else inertia_kg_m2
    for (body in bodies) check_body(body, call, "inertia_kg_m2")
    mass_kg <- vapply(bodies, function(body) body$mass_kg, 0)
    # A body that names its axle, such as a rod on its end, is moved from its centre of mass, too.
    inertia_kg_m2 <- vapply(bodies, moment_about_axis, 0, axis = c(0, 0, 1))
  }
  check_supplied(c("inertia_kg_m2", "mass_kg", "distance_m"), call)
  direction <- check_choice(direction, "direction", c("from_centre", "to_centre"), call)
  sign <- if (direction == "from_centre") 1 else -1
  if (is.matrix(inertia_kg_m2)) {
    return(parallel_axis_tensor(inertia_kg_m2, mass_kg, distance_m, sign, call))
  }
  columns <- list(
    inertia_kg_m2 = check_column(inertia_kg_m2, "inertia_kg_m2", "kg*m^2", call),
    mass_kg = check_column(mass_kg, "mass_kg", "kg", call),
    distance_m = check_column(distance_m, "distance_m", "m", call)
  )
  # Arrays of different dimensions cannot be added.
  columns <- lapply(columns, function(x) if (is.null(dim(x))) x else as.vector(x))
  check_recyclable(columns, call)
  check_not_negative(columns$inertia_kg_m2, "inertia_kg_m2", "kg*m^2", call)
  check_not_negative(columns$mass_kg, "mass_kg", "kg", call)
  check_not_negative(columns$distance_m, "distance_m", "m", call)
  moved <- columns$mass_kg * columns$distance_m * columns$distance_m
  value <- columns$inertia_kg_m2 + sign * moved
  # m d^2 alone may be too large for a double.
  endless <- columns$inertia_kg_m2 == Inf & is.finite(columns$mass_kg + columns$distance_m)
  value[which(rep_len(endless, length(value)))] <- Inf
  # A point mass leaves a rounding error of either sign.
  rounding <- 4 * .Machine$double.eps * moved
  if (sign < 0) {
    below <- which(value == -Inf | value < -rounding)
    if (length(below)) {
      i <- below[1]
      abort_rotdyn(c(
        "{.arg inertia_kg_m2} must be at least m d^2, its value for a point mass.",
        x = "In row {i} the moment about the centre would be {format(value[i], digits = 3)}
             kg m^2."
      ), "value", call)
    }
    value <- pmax(value, 0)
    warn_lost_digits(moved, value, call)
  }
  warn_beyond(list(inertia_kg_m2 = value), columns, length(value), call)
  value
}

are_bodies <- function(x) {
  inherits(x, "rot_body") || (is.list(x) && length(x) && all(vapply(x, inherits, NA, "rot_body")))
}

parallel_axis_tensor <- function(inertia, mass, d, sign, call) {
  mass <- check_number(mass, "mass_kg", "kg", call, lower = 0)
  d <- check_vector(d, "distance_m", "m", call)
  tensor <- check_inertia_or_abort(as_tensor(inertia, "inertia_kg_m2", call), mass, call)
  out <- check_in_range(.Call(ffi_inertia_shift, tensor, mass, d, sign), call)
  if (sign < 0) out <- check_shifted(out, tensor, mass, d, call)
  out
}

# A tensor moved to the centre must be physical within the rounding of the subtraction; warns where
# it cancels.
check_shifted <- function(out, tensor, mass, d, call) {
  moved <- mass * sum(d^2)
  rounding <- 8 * .Machine$double.eps * max(abs(tensor))
  second <- .Call(ffi_inertia_second, out)
  p <- .Call(ffi_inertia_principal, second, 0)
  if (p$second[3] >= -rounding && p$second[3] < 0) {
    # Violated by rounding alone: the nearest physical tensor.
    keep <- pmax(p$second, 0)
    second <- p$axes %*% (keep * t(p$axes))
    second <- (second + t(second)) / 2
    out <- .Call(ffi_inertia_tensors, second)[[2]]
  }
  out <- check_inertia_or_abort(out, mass, call, given_by_user = FALSE)
  warn_lost_digits(moved, max(abs(p$moment)), call)
  out
}

# At 1e8 half of the sixteen digits are lost.
warn_lost_digits <- function(moved, left, call) {
  lost <- which(moved > 1e8 * left)
  if (length(lost)) {
    i <- lost[1]
    left <- rep_len(left, max(lost))[i]
    digits <- if (left > 0) max(0, floor(-log10(.Machine$double.eps * moved[i] / left))) else 0
    warn_rotdyn(c(
      "Moving to the centre of mass cancels nearly all of the moment of inertia.",
      x = "m d^2 is {format(moved[i], digits = 3)} kg m^2, the result
           {format(left, digits = 3)}, of which about {digits} digit{?s} {?is/are} correct.",
      i = "Give the tensor about the centre of mass, or a point near it."
    ), "digits", call)
  }
}
