#' A body from its inertia tensor
#'
#' For a tensor from another source: CAD, a data sheet, a robot description. A tensor that is not
#' physical is an error, with the reason and, if one number explains it, a suggested repair.
#'
#' @param mass_kg Mass, at least 0.
#' @param inertia_kg_m2 A symmetric 3 x 3 matrix in kg m^2; or six numbers named `ixx`, `iyy`,
#'   `izz`, `ixy`, `ixz`, `iyz`; or three principal moments along the own axes (if they have names,
#'   `ixx`, `iyy`, `izz` or `x`, `y`, `z`); or an [inertia_tensor()], whose point, axes and sign
#'   convention are used; or a body, whose tensor it is.
#' @param centre_m Centre of mass in the own axes.
#' @param ... Not used; names after it must be given in full.
#' @param about Point of the tensor: `"centre"` (of mass), `"origin"` (of the own axes), or three
#'   numbers in m. The tensor is moved from there to the centre, with a warning
#'   (`rotdyn_warning_digits`) if the subtraction cancels more than half of the digits.
#' @param axes Axes of the components: `"own"`, or a rotation matrix whose columns are those axes in
#'   the own ones (or its quaternion, scalar first).
#' @param products `"negative"` (as in Goldstein and URDF): the off-diagonal elements are minus the
#'   products of inertia, \eqn{-\int x y\,dm}{-int x y dm}. `"positive"`: they are \eqn{+\int x
#'   y\,dm}{+int x y dm}.
#' @param reach_m Distance from the centre of mass to the farthest point, if known: the tensor is
#'   checked against it.
#' @param name Name of the body.
#' @return A `rot_body`. Its error bound includes the rounding of the numbers given to sixteen
#'   digits.
#' @section Errors: `rotdyn_error_inertia` for a tensor that is not physical ([check_inertia()]),
#'   `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf included, but
#'   for the tensor: that is `rotdyn_error_inertia`), `rotdyn_error_unit`; `rotdyn_error_range`
#'   where the moved tensor exceeds double precision.
#' @source Wensing, Kim and Slotine, IEEE Robotics and Automation Letters 3 (2018) 60, for the
#'   conditions.
#' @seealso [check_inertia()] finds what is wrong with a tensor, [inertia_tensor()],
#'   [principal_axes()].
#' @concept inertia tensor
#' @examples
#' body_tensor(2, c(ixx = 0.05, iyy = 0.06, izz = 0.07, ixy = 0.01, ixz = 0, iyz = 0))
#' try(body_tensor(2, diag(c(0.05, 0.06, 0.7))))
#' @export
body_tensor <- function(mass_kg, inertia_kg_m2, centre_m = c(0, 0, 0), ..., about = "centre",
                        axes = "own", products = c("negative", "positive"), reach_m = NULL,
                        name = "given tensor") {
  call <- check_no_dots(...)
  check_supplied(c("mass_kg", "inertia_kg_m2"), call)
  mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  centre_m <- check_vector(centre_m, "centre_m", "m", call)
  name <- check_name(name, "name", call)
  if (!is.null(reach_m)) reach_m <- check_number(reach_m, "reach_m", "m", call, lower = 0)
  if (inherits(inertia_kg_m2, "rot_body")) inertia_kg_m2 <- inertia_tensor(inertia_kg_m2)
  tensor <- as_tensor(inertia_kg_m2, "inertia_kg_m2", call, check_products(products, call))
  askew <- max(abs(tensor - t(tensor))) / 2
  given <- tensor
  # It must be physical about any point, and symmetric to be moved.
  tensor <- check_inertia_or_abort(tensor, mass_kg, call)
  # The point and axes of an inertia_tensor() are the defaults.
  knows <- inherits(inertia_kg_m2, "rot_inertia_tensor")
  if (knows && missing(about) && attr(inertia_kg_m2, "about") != "centre") {
    about <- attr(inertia_kg_m2, "point_m")
  }
  if (knows && missing(axes)) axes <- attr(inertia_kg_m2, "rotation")
  point <- as_point(about, list(centre_m = centre_m), "about", call)
  rotation <- if (identical(axes, "own")) NULL else as_rotation(axes, "axes", call)
  if (identical(unname(rotation), diag(3))) rotation <- NULL
  d <- centre_m - point
  largest <- max(abs(tensor))
  scale <- sum(abs(diag(tensor)) / largest)
  if (!is.null(rotation)) tensor <- .Call(ffi_inertia_rotate, tensor, rotation)
  if (any(d != 0)) {
    tensor <- check_in_range(.Call(ffi_inertia_shift, tensor, mass_kg, d, -1), call)
    tensor <- check_shifted(tensor, tensor + mass_kg * sum(d^2), mass_kg, d, call)
  }
  tensor <- check_inertia_or_abort(tensor, mass_kg, call, reach_m = reach_m, given_by_user = FALSE)
  second <- .Call(ffi_inertia_second, tensor)
  # Relative to the largest entry, so that sums do not overflow.
  trace <- sum(diag(second) / largest)
  new_body(
    name, mass_kg, second, centre_m,
    reach_m = reach_m %||% NA_real_,
    formula = "given",
    provenance = "tensor",
    # What makes it again: a tensor that was moved or turned has another error.
    detail = if (is.null(rotation) && !any(d != 0)) {
      list(tensor = unname(given), tensor_at_m = as.double(centre_m))
    } else {
      list()
    },
    # An element of the second moment is from three elements of the tensor, rounded once each.
    error = if (largest > 0 && trace > 0) {
      # The last term is for underflow.
      (8 * .Machine$double.eps * scale + askew / largest + 2^-1072 / largest) / trace
    } else {
      0
    },
    call = call
  )
}

# The body of a tensor without a mass.
body_of_tensor <- function(x, call) {
  if (inherits(x, "rot_measured")) x <- as.double(x)
  tensor <- check_inertia_or_abort(as_tensor(x, "body", call), NULL, call)
  new_body(
    "tensor", NA_real_, .Call(ffi_inertia_second, tensor),
    provenance = "tensor", error = 8 * .Machine$double.eps
  )
}

# A 3 x 3 matrix of doubles with negative products, not yet checked.
as_tensor <- function(x, arg, call, products = "negative") {
  if (inherits(x, "rot_inertia_tensor")) {
    products <- attr(check_inertia_tensor(x, arg, call), "products")
    x <- as.matrix(x)
  }
  if (is.object(x)) {
    keep <- attributes(x)[c("dim", "names")]
    x <- as_si(x, "kg*m^2", arg, call)
    attributes(x) <- keep[lengths(keep) > 0]
  }
  if (!is.numeric(x)) abort_tensor(x, arg, call)
  names <- plain_entry_names(names(x))
  tensor <- if (is.matrix(x) && all(dim(x) == 3L)) {
    matrix(as.double(x), 3)
  } else if (length(x) == 6L && setequal(names, inertia_entries)) {
    six_to_tensor(as.double(x[match(inertia_entries, names)]))
  } else if (length(x) == 3L && setequal(names, inertia_entries[1:3])) {
    diag(as.double(x[match(inertia_entries[1:3], names)]))
  } else if (length(x) == 3L && !length(names)) {
    diag(as.double(x))
  } else {
    abort_tensor(x, arg, call)
  }
  dimnames(tensor) <- list(c("x", "y", "z"), c("x", "y", "z"))
  if (products == "positive") flip_products(tensor) else tensor
}

abort_tensor <- function(x, arg, call) {
  abort_rotdyn(c(
    "{.arg {arg}} must be a 3 x 3 matrix, six numbers named {.val {inertia_entries}}, or three
     principal moments.",
    x = if (length(x) %in% c(3L, 6L) && length(names(x))) {
      "Its names are {.val {names(x)}}."
    } else {
      "It is {describe_value(x)}."
    }
  ), if (is.numeric(x)) "size" else "type", call)
}

