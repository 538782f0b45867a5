#' Principal axes and moments of a body
#'
#' `principal_axes()` diagonalises a body's inertia about its centre of mass; `symmetry_class()`
#' classifies the body.
#'
#' The eigenvalues \eqn{c_1 \ge c_2 \ge c_3}{c1 >= c2 >= c3} of the second moment
#' \eqn{C = \int x x^T dm}{C = int x x' dm} are found
#' by Jacobi rotations, which resolve the small ones, and the moments are their sums:
#' \deqn{I_1 = c_2 + c_3 \le I_2 = c_1 + c_3 \le I_3 = c_1 + c_2.}{
#'   I1 = c2 + c3 <= I2 = c1 + c3 <= I3 = c1 + c2.}
#'
#' The axes are right-handed. The largest component of each of the first two is positive; the third
#' is their cross product. For equal moments (to 1e-14) the axes are not unique: those nearest to
#' the own axes are returned.
#'
#' | class | moments |
#' |---|---|
#' | `"point"` | all zero |
#' | `"rod"` | I1 = 0, I2 = I3 |
#' | `"plate"` | I1 + I2 = I3: all mass in one plane; it may also be oblate |
#' | `"spherical"` | I1 = I2 = I3 |
#' | `"oblate"` | I1 = I2 < I3 |
#' | `"prolate"` | I1 < I2 = I3 |
#' | `"asymmetric"` | all different |
#' | `"unknown"` | the body's own error is half of its second moment, or more |
#'
#' @param body A `rot_body`, or a 3 x 3 inertia tensor in kg m^2 (off-diagonal elements are minus
#'   the products of inertia), which must be physical: see [check_inertia()].
#' @param ... Not used; names after it must be given in full.
#' @param tolerance Moments count as equal if they differ by at most this part of the largest second
#'   moment. By default 1e-12, or the body's error where that is larger.
#' @return `principal_axes()`: a tibble (class `rot_principal_axes`) of three rows, moments
#'   ascending: `r describe_columns(principal_columns)`
#'   Attributes: `symmetry`, `axes` (3 x 3, axes in columns).
#'   The second moments are right to 1e-15 of the largest, and at least 0.
#'
#'   `symmetry_class()`: one string.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`; `rotdyn_error_inertia` for a tensor that is not physical, or not finite.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.4;
#'   Demmel and Veselic, SIAM J. Matrix Anal. Appl. 13 (1992) 1204, for the rotations.
#' @seealso [inertia_tensor()], [check_inertia()], [autoplot.rot_body()].
#' @concept principal moment
#' @examples
#' principal_axes(body_disk(mass_kg = 2, radius_m = 0.25))
#' symmetry_class(body_sphere(1, 0.1))
#' principal_axes(matrix(c(2, -0.5, 0, -0.5, 3, 0, 0, 0, 4), 3))
#' @export
principal_axes <- function(body, ..., tolerance = NULL) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  find_principal(body, tolerance, call)
}

find_principal <- function(body, tolerance, call) {
  body <- if (inherits(body, "rot_body")) check_body(body, call) else body_of_tensor(body, call)
  # With an error of this size the class is undetermined.
  unknown <- is.null(tolerance) && isTRUE(body$error >= 0.5)
  tolerance <- if (is.null(tolerance)) {
    max(1e-12, body$error, na.rm = TRUE)
  } else {
    check_number(tolerance, "tolerance", "1", call, lower = 0, upper = 1)
  }
  p <- .Call(ffi_inertia_principal, body$second_moment_kg_m2, tolerance)
  if (p$second[3] < 0) {
    # A rotated rod: a rounding error below 0.
    p$second <- pmax(p$second, 0)
    p$moment <- p$second[c(2, 1, 1)] + p$second[c(3, 3, 2)]
  }
  equal <- p$equal
  new_table(
    list(
      axis = 1:3,
      principal_moment_kg_m2 = p$moment,
      second_moment_kg_m2 = p$second,
      x = p$axes[1, ],
      y = p$axes[2, ],
      z = p$axes[3, ],
      unique = !c(equal[1], equal[1] || equal[2], equal[2])
    ),
    nrow = 3L,
    axes = p$axes,
    symmetry = if (unknown) "unknown" else name_symmetry(p$second, equal, tolerance),
    class = "rot_principal_axes"
  )
}

#' @rdname principal_axes
#' @export
symmetry_class <- function(body, ..., tolerance = NULL) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  attr(find_principal(body, tolerance, call), "symmetry")
}

name_symmetry <- function(second, equal, tolerance) {
  if (second[1] <= 0) return("point")
  gone <- second <= tolerance * second[1]
  if (gone[2]) {
    "rod"
  } else if (gone[3]) {
    "plate"
  } else if (all(equal)) {
    "spherical"
  } else if (equal[1]) {
    "oblate"
  } else if (equal[2]) {
    "prolate"
  } else {
    "asymmetric"
  }
}

describe_symmetry <- function(axes) {
  symmetry <- attr(axes, "symmetry")
  free <- sum(!axes$unique)
  paste0(
    symmetry,
    switch(symmetry,
      point = "",
      unknown = " (the error is as large as the body's second moment)",
      rod = " (any axes across it are principal)",
      spherical = " (every axis is principal)",
      if (free == 2L) {
        which <- paste(which(!axes$unique), collapse = " and ")
        paste0(" (axes ", which, " not unique: their moments are equal)")
      } else {
        ""
      }
    )
  )
}

#' @export
print.rot_principal_axes <- function(x, ...) {
  symmetry <- attr(x, "symmetry")
  # Unless rows or columns were removed.
  if (!is.null(symmetry) && "unique" %in% names(x) && nrow(x) == 3L) {
    head <- paste("Principal axes about the centre of mass:", describe_symmetry(x))
    say(strwrap(head, print_width() + 1L, prefix = "# "), sep = "\n")
    # Rounding errors (of a plate, for example) are shown as 0.
    shown <- x
    second <- x$second_moment_kg_m2
    if (!is.null(second)) {
      shown$second_moment_kg_m2 <- clear_noise(second, 8 * .Machine$double.eps * max(second))
    }
    class(shown) <- setdiff(class(x), "rot_principal_axes")
    print(shown, ...)
    return(invisible(x))
  }
  NextMethod()
}
