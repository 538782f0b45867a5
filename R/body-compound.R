#' Bodies made of bodies
#'
#' @description
#' * `place_body()`: rotates and translates a body: its own axes become those of a common frame.
#' * `join_bodies()`: placed bodies as one rigid body.
#' * `cut_body()`: subtracts a body from another: a hole.
#'
#' The results are bodies, so the functions can be nested.
#'
#' \deqn{m = \sum_i m_i,\quad g = \frac{1}{m}\sum_i m_i g_i,\quad
#'   C = \sum_i \left(C_i + m_i d_i d_i^T\right),\quad d_i = g_i - g}{
#'   m = sum m_i,  g = sum m_i g_i / m,  C = sum (C_i + m_i d_i d_i'),  d_i = g_i - g}
#' The common centre is computed first, and the tensors are summed about it. A distant origin of the
#' frame costs only the rounding of the parts' positions.
#'
#' @param body A `rot_body`.
#' @param at_m Position of the body's own origin in the frame, three numbers in m. (The origin is
#'   stated in the help of the shape; it need not be the centre of mass.)
#' @param rotation Rotation of the body about its own origin, applied first: a rotation matrix (own
#'   axes to the frame, as from [rotation_about()]), a unit quaternion, scalar first, or a row of
#'   [attitude_from()]; orthogonal, or of length 1, within 1e-8.
#' @param ... `join_bodies()`: bodies placed in one frame, or lists of them. Otherwise not used.
#' @param hole A `rot_body` in the same frame: the material removed, with its mass. Its mass is
#'   consistent if it is made with the density of the body, `density_kg_m3 =`.
#' @param name Name of the result.
#' @return A `rot_body` in the common frame. `detail$parts` of a joined body lists its parts;
#'   `detail$centre_error_m` bounds the rounding error of each coordinate of the centre. The error
#'   of a joined body combines the errors of the parts and of their centres with the rounding of the
#'   sum; it is a bound if all of theirs are. It is large where a hole leaves little of the body.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf,
#'   a matrix that is not a rotation, a hole at least as heavy as the body), `rotdyn_error_inertia`
#'   for a hole that cannot have been inside the body: its centre is outside the body's reach, or
#'   the remaining inertia is not physical. (A hole that protrudes slightly is not detected.)
#'   `rotdyn_error_range`, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.3.
#' @seealso [inertia_tensor()], [parallel_axis()] for numbers, [rotation_about()], [body_shapes].
#' @concept composite body
#' @concept parallel axis theorem
#' @concept merry-go-round
#' @concept parallel axis
#' @concept dumbbell
#' @examples
#' # A dumbbell: a rod along x with a ball at each end.
#' rod <- body_rod(mass_kg = 0.5, length_m = 1)
#' ball <- body_sphere(mass_kg = 2, radius_m = 0.1)
#' dumbbell <- join_bodies(rod, place_body(ball, c(0.6, 0, 0)), place_body(ball, c(-0.6, 0, 0)))
#' dumbbell
#'
#' # A disk with a hole at half its radius: the mass of the hole is proportional to its area.
#' cut_body(body_disk(4, 0.2), place_body(body_disk(4 * 0.25^2, 0.05), c(0.1, 0, 0)))
#' @name compound
NULL

#' @rdname compound
#' @export
place_body <- function(body, at_m = c(0, 0, 0), rotation = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  check_body(body, call)
  at_m <- check_vector(at_m, "at_m", "m", call)
  centre <- as.double(body$centre_m)
  second <- body$second_moment_kg_m2
  beta <- body$beta
  error <- body$error
  off <- centre_error(body)
  formula <- body$formula
  if (!is.null(rotation)) {
    turn <- as_rotation(rotation, "rotation", call)
    centre <- turn[, 1] * centre[1] + turn[, 2] * centre[2] + turn[, 3] * centre[3]
    second <- .Call(ffi_inertia_rotate, second, turn)
    if (!identical(turn, diag(3))) {
      beta <- NA_real_
      error <- error + 16 * .Machine$double.eps
      off <- sqrt(3) * off + 8 * .Machine$double.eps * max(abs(centre))
      # The formula of a shape is about its own axis, which was rotated.
      if (body$shape %in% shape_table()$shape && body$provenance == "formula") {
        formula <- paste0(sub(rotated_mark, "", formula, fixed = TRUE), rotated_mark)
      }
    }
  }
  off <- off + max(abs(lost_in_sum(centre, at_m)))
  centre <- centre + at_m
  detail <- place_detail(body$detail, if (!is.null(rotation)) turn, at_m)
  detail$centre_error_m <- if (off > 0) off
  detail$frame <- placed_frame(body$detail$frame, if (!is.null(rotation)) turn, at_m)
  if (!all(is.finite(centre))) abort_rotdyn("The position exceeds double precision.", "range", call)
  new_body(
    body$shape, body$mass_kg, second, centre, body$size_m, body$reach_m, beta, formula,
    body$source, body$provenance, detail, error, body$error_kind, call
  )
}

rotated_mark <- ", then rotated"

# A bound of the rounding error of each coordinate of the centre, where known. It is ignored for the
# body alone, but matters when the body is joined to others.
centre_error <- function(body) {
  known <- .subset2(.subset2(body, "detail"), "centre_error_m")
  if (!is.null(known)) {
    known
  } else if (body$provenance == "mesh") {
    .Machine$double.eps * (max(abs(body$centre_m)) + max(0, body$reach_m, na.rm = TRUE))
  } else {
    0
  }
}

# The rounding error of a + b, exactly (Knuth).
lost_in_sum <- function(a, b) {
  sum <- a + b
  of_b <- sum - a
  lost <- (a - (sum - of_b)) + (b - of_b)
  ifelse(is.finite(lost), lost, 0)
}

# Moves the positions in a body's detail (parts, points) with the body.
place_detail <- function(detail, turn, at_m) {
  xyz <- c("x_m", "y_m", "z_m")
  lapply(detail, function(table) {
    if (is.data.frame(table) && all(xyz %in% names(table))) {
      at <- rbind(table$x_m, table$y_m, table$z_m)
      if (!is.null(turn)) at <- turn %*% at
      table[xyz] <- list(at[1, ] + at_m[1], at[2, ] + at_m[2], at[3, ] + at_m[3])
    }
    table
  })
}

#' @rdname compound
#' @export
join_bodies <- function(..., name = "compound") {
  call <- current_env()
  parts <- flatten_bodies(list(...), call)
  name <- check_name(name, "name", call)
  if (!length(parts)) abort_rotdyn("{.fn join_bodies} needs at least one body.", "missing", call)
  combine_bodies(parts, rep(1, length(parts)), name, call)
}

#' @rdname compound
#' @export
cut_body <- function(body, hole, ..., name = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("body", "hole"), call)
  check_body(body, call)
  check_body(hole, call, "hole")
  if (!is.null(name)) name <- check_name(name, "name", call)
  if (!(hole$mass_kg < body$mass_kg)) {
    abort_rotdyn(c(
      "A hole must be lighter than the body.",
      x = "{.arg hole} has {format_si(hole$mass_kg)} kg, {.arg body}
           {format_si(body$mass_kg)} kg.",
      i = "{.arg hole} is the material removed: give both the same density."
    ), "value", call)
  }
  check_hole_near(body, hole, call)
  left <- combine_bodies(
    list(body, hole), c(1, -1), name %||% paste(body$shape, "with a hole"), call
  )
  check_inertia_or_abort(left$inertia_kg_m2, left$mass_kg, call, given_by_user = FALSE)
  left$reach_m <- body$reach_m + hypot3(as.double(left$centre_m - body$centre_m))
  left
}

# The centre of a hole inside a body is within the body's reach.
check_hole_near <- function(body, hole, call) {
  gap <- as.double(hole$centre_m) - as.double(body$centre_m)
  away <- hypot3(gap)
  rounding <- 8 * .Machine$double.eps * (max(abs(body$centre_m)) + max(abs(hole$centre_m)))
  if (isTRUE(hole$mass_kg > 0 && away > body$reach_m * (1 + 1e-12) + rounding)) {
    abort_rotdyn(c(
      "A hole must be inside the body.",
      x = "The centre of {.arg hole} is {format_si(away)} m from that of {.arg body}, which
           reaches {format_si(body$reach_m)} m.",
      i = "Both must be placed in one frame: {.fn place_body}."
    ), "inertia", call)
  }
}

flatten_bodies <- function(x, call) {
  parts <- list()
  for (i in seq_along(x)) {
    if (inherits(x[[i]], "rot_body")) {
      parts <- c(parts, list(check_body(x[[i]], call, paste0("..", i))))
    } else if (is.list(x[[i]]) && !is.object(x[[i]])) {
      parts <- c(parts, flatten_bodies(x[[i]], call))
    } else {
      hint <- if (is.matrix(x[[i]])) {
        "A tensor has no mass and no position: make a body of it with {.fn body_tensor}."
      } else {
        "Make one with {.fn body_disk} or another constructor."
      }
      check_class(x[[i]], "rot_body", paste0("..", i), hint, call)
    }
  }
  parts
}

# `sign` is -1 for holes.
combine_bodies <- function(parts, sign, name, call) {
  pick <- function(field) vapply(parts, function(b) as.double(b[[field]]), double(1))
  mass <- pick("mass_kg")
  centres <- vapply(parts, function(b) as.double(b$centre_m), double(3))
  seconds <- vapply(parts, function(b) {
    as.double(b$second_moment_kg_m2)[c(1, 5, 9, 4, 7, 8)]
  }, double(6))
  sum <- .Call(ffi_inertia_join, sign * mass, centres, seconds * rep(sign, each = 6))
  trace <- if (is.null(sum)) Inf else sum(diag(sum$second_kg_m2))
  if (!is.finite(trace)) {
    abort_rotdyn("The bodies' inertia exceeds double precision.", "range", call)
  }
  traces <- colSums(seconds[1:3, , drop = FALSE])
  # The error of a part whose moment underflowed is a few smallest doubles.
  own <- ifelse(pick("error") == Inf & traces == 0, 2^-1070, pick("error") * traces)
  error <- (if (trace > 0) sum(own) / trace else if (any(own > 0)) Inf else 0) + sum$error
  kinds <- vapply(parts, function(b) b$error_kind, character(1))
  away <- apply(centres - sum$centre_m, 2, hypot3)
  off <- vapply(parts, centre_error, double(1))
  # The effect on m d d' of the errors of the centres; d itself is from a rounded centre.
  arm <- away + 2 * .Machine$double.eps * max(abs(sum$centre_m))
  if (trace > 0) error <- error + sum(mass * (2 * arm + off) * off / trace)
  new_body(
    name, sum$mass_kg, sum$second_kg_m2, sum$centre_m,
    reach_m = max(away + pick("reach_m")),
    formula = "sum of C + m d d' about the common centre",
    provenance = "compound",
    detail = list(parts = as_table(
      shape = vapply(parts, function(b) b$shape, character(1)),
      mass_kg = sign * mass,
      x_m = centres[1, ], y_m = centres[2, ], z_m = centres[3, ]
    ), centre_error_m = joined_centre_error(mass, off, away, sum), bodies = parts, signs = sign),
    error = error,
    error_kind = if (all(kinds == "bound")) "bound" else "estimate",
    call = call
  )
}

# The errors of the parts' centres, weighted by mass, and the rounding of the mean.
joined_centre_error <- function(mass, off, away, sum) {
  if (sum$mass_kg > 0) {
    share <- mass / sum$mass_kg
    sum(share * off) + .Machine$double.eps * (max(abs(sum$centre_m)) + 4 * sum(share * away))
  } else {
    max(off)
  }
}
