#' Inertia of a body about any point and axis
#'
#' @description
#' * `inertia_tensor()`: the tensor about a point, in given axes.
#' * `moment_of_inertia()`: the moment about an axis through a point.
#' * `radius_of_gyration()`: the distance from the axis of a point mass with the same moment.
#'
#' \deqn{I_{ij} = \int (x^2 \delta_{ij} - x_i x_j)\, dm, \quad
#'   I_n = n^T I n, \quad I_o = I_g + m (d^2 1 - d d^T), \quad k = \sqrt{I_n/m}}{
#'   I = int (x^2 1 - x x') dm,  I_n = n' I n,  I_o = I_g + m (d^2 1 - d d'),  k = sqrt(I_n/m)}
#' with \eqn{d} from the centre of mass \eqn{g} to the point \eqn{o} (parallel axes, Steiner).
#'
#' @section Signs: The off-diagonal elements of the tensor are *minus* the products of inertia:
#'   \eqn{I_{xy} = -\int x y\, dm}{Ixy = -int x y dm}. That is `products = "negative"`, as in
#'   Goldstein, URDF and most of mechanics. Some books and CAD programs write \eqn{+\int x y\,
#'   dm}{+int x y dm}: `products = "positive"` gives those.
#'
#' @param body A `rot_body`.
#' @param about,through The point: `"centre"` (of mass), `"origin"` (of the body's own axes), or
#'   three numbers in m in the own axes. `through = NULL` is the axle that the body names: the end
#'   of a [body_rod_end()], the axis of a [body_point()], the centre of mass of any other body. That
#'   is the moment of [inertia_table()], [scene_axle()] and the other scenes.
#' @param ... Not used; names after it must be given in full.
#' @param axes The axes the components refer to: `"own"`, `"principal"`, or a rotation matrix whose
#'   columns are the new axes in the own ones (or its quaternion, scalar first).
#' @param products Sign convention of the off-diagonal elements: see the section on signs.
#' @param axis Direction of the axis in the own axes: `"x"`, `"y"`, `"z"`, or three numbers of any
#'   length but 0. Disks, hoops and wheels turn about `"z"`, a rod lies along `"x"`.
#' @return `inertia_tensor()`: a 3 x 3 matrix in kg m^2 (class `rot_inertia_tensor`) with its point,
#'   axes and sign convention as attributes: tensors about different points or in different axes
#'   cannot be added. `as.matrix()` returns the plain matrix.
#'
#'   `moment_of_inertia()`: one number in kg m^2. `radius_of_gyration()`: one number in m; NaN for a
#'   body without mass.
#'
#'   The error is that of the body plus some eight roundings.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf
#'   included), `rotdyn_error_unit`; `rotdyn_error_range` where the result overflows;
#'   `rotdyn_error_point` for a sum of tensors about different points or in different axes.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 5.3 and 5.4.
#' @seealso [principal_axes()], [parallel_axis()] for numbers without a body, [join_bodies()].
#' @concept moment
#' @concept parallel axis theorem
#' @concept moment of inertia
#' @concept parallel axis
#' @examples
#' rod <- body_rod(mass_kg = 1.5, length_m = 2)
#' moment_of_inertia(rod, axis = "z")
#' moment_of_inertia(rod, axis = "z", through = c(1, 0, 0)) # about its end: four times as much
#' inertia_tensor(body_disk(2, 0.25), about = c(0.25, 0, 0))
#' radius_of_gyration(body_sphere(1, 0.1), "x")
#' @export
inertia_tensor <- function(body, about = "centre", ..., axes = "own",
                           products = c("negative", "positive")) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  check_body(body, call)
  products <- check_products(products, call)
  point <- as_point(about, body, "about", call)
  rotation <- as_axes(axes, body, call)
  tensor <- .Call(
    ffi_inertia_about, body$second_moment_kg_m2, body$mass_kg, body$centre_m - point, rotation
  )
  check_in_range(tensor, call)
  if (products == "positive") tensor <- flip_products(tensor)
  structure(
    tensor,
    point_m = point,
    about = if (is.character(about)) about else "point",
    rotation = rotation %||% diag(3),
    products = products,
    class = c("rot_inertia_tensor", "matrix", "array")
  )
}

#' @rdname inertia_tensor
#' @export
moment_of_inertia <- function(body, axis = "z", through = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  moment <- moment_through(body, axis, through, call)
  if (missing(through)) say_axis_in_centre(body, axis, call)
  moment
}

# As say_axle_in_centre() of R/scene.R, with the moment about the body's own axis.
say_axis_in_centre <- function(body, axis, call) {
  axis <- unit_axis(as_axis(axis, call), call)
  off <- off_own_axis(body, axis)
  if (off == 0) return(invisible())
  own <- moment_about_axis(body, axis, c(0, 0, 0))
  inform_quickly(c(
    paste0(
      "The axis passes through the centre of mass, ", format_si(off), " m from the body's own axis."
    ),
    paste0(
      "`through = \"origin\"`: about the own axis it is ", format_si(own), " kg m^2. ",
      "`through = \"centre\"`: as now."
    )
  ), "axle")
}

#' @rdname inertia_tensor
#' @export
radius_of_gyration <- function(body, axis = "z", through = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  sqrt(moment_through(body, axis, through, call) / body$mass_kg)
}

moment_through <- function(body, axis, through, call) {
  check_body(body, call)
  axis <- unit_axis(as_axis(axis, call), call)
  point <- if (is.null(through)) named_point(body) else as_point(through, body, "through", call)
  moment <- moment_about_axis(body, axis, point)
  check_in_range(moment, call)
}

check_in_range <- function(x, call) {
  if (!all(is.finite(x))) abort_rotdyn("The inertia exceeds double precision.", "range", call)
  x
}

check_products <- function(products, call) {
  check_choice(products, "products", c("negative", "positive"), call)
}

flip_products <- function(tensor) {
  off <- row(tensor) != col(tensor)
  tensor[off] <- 0 - tensor[off]
  tensor
}

as_point <- function(point, body, arg, call) {
  if (is.character(point)) {
    switch(check_string(point, arg, c("centre", "origin"), call),
      centre = as.double(body$centre_m),
      origin = c(0, 0, 0)
    )
  } else {
    check_vector(point, arg, "m", call)
  }
}

# Three finite numbers.
check_vector <- function(x, arg, unit, call) {
  x <- check_finite(x, arg, unit, call)
  if (length(x) != 3L) {
    abort_rotdyn(
      c("{.arg {arg}} must have three components.", x = "It has {length(x)}."), "size", call
    )
  }
  x
}

# NULL for the own axes.
as_axes <- function(axes, body, call) {
  if (is.character(axes)) {
    switch(check_string(axes, "axes", c("own", "principal"), call),
      own = NULL,
      principal = attr(principal_axes(body), "axes")
    )
  } else {
    as_rotation(axes, "axes", call)
  }
}

# ---- the class of a tensor -----------------------------------------------------------------------

#' @export
print.rot_inertia_tensor <- function(x, ...) {
  check_inertia_tensor(x, "x", current_env())
  about <- switch(attr(x, "about"),
    centre = "the centre of mass",
    origin = "the origin of the own axes",
    paste0("(", paste(format_si(attr(x, "point_m")), collapse = ", "), ") m")
  )
  own <- identical(attr(x, "rotation"), diag(3))
  sign <- if (attr(x, "products") == "negative") "-" else "+"
  where <- paste0(
    "<inertia tensor> kg m^2, about ", about, ", ", if (own) "own" else "rotated", " axes,"
  )
  signs <- paste0("off-diagonal ", sign, "int x y dm")
  head <- paste(where, signs)
  if (nchar(head) > print_width()) {
    head <- c(strwrap(where, print_width() + 1L, exdent = 2L), paste0("  ", signs))
  }
  say(head, sep = "\n")
  # Rotations leave rounding errors in place of zeros.
  print(clear_noise(as.matrix(x), 8 * .Machine$double.eps * max(abs(x))), ...)
  invisible(x)
}

#' @export
as.matrix.rot_inertia_tensor <- function(x, ...) {
  attributes(x) <- attributes(x)[c("dim", "dimnames")]
  x
}

# Parts of a tensor are plain numbers or matrices.
#' @export
`[.rot_inertia_tensor` <- function(x, ...) {
  as.matrix(x)[...]
}

# Sums of tensors about one point in one set of axes, and multiples, are tensors; other results are
# plain matrices.
#' @export
Ops.rot_inertia_tensor <- function(e1, e2) {
  bare <- function(x) if (inherits(x, "rot_inertia_tensor")) as.matrix(x) else x
  operation <- get(.Generic, mode = "function")
  for (x in if (missing(e2)) list(e1) else list(e1, e2)) {
    if (inherits(x, "rot_inertia_tensor")) check_inertia_tensor(x, "tensor", rlang::caller_env())
  }
  if (missing(e2)) return(operation(bare(e1)))
  value <- operation(bare(e1), bare(e2))
  both <- inherits(e1, "rot_inertia_tensor") && inherits(e2, "rot_inertia_tensor")
  if (both && .Generic %in% c("+", "-")) {
    check_same_point(e1, e2, .Generic, sum_call(.Generic, sys.call()))
    return(like_tensor(value, e1))
  }
  one <- if (inherits(e1, "rot_inertia_tensor")) e1 else e2
  other <- if (inherits(e1, "rot_inertia_tensor")) e2 else e1
  scaled <- .Generic == "*" || (.Generic == "/" && identical(one, e1))
  if (!both && scaled && length(other) == 1L) like_tensor(value, one) else value
}

like_tensor <- function(value, tensor) {
  attributes(value) <- attributes(tensor)
  value
}

# The call as the user wrote it; R puts the name of the method into it.
sum_call <- function(generic, call) {
  call[[1L]] <- as.name(generic)
  call
}

check_same_point <- function(e1, e2, operation, call) {
  p1 <- attr(e1, "point_m")
  p2 <- attr(e2, "point_m")
  verb <- if (operation == "+") "added" else "subtracted"
  if (!identical(p1, p2)) {
    abort_rotdyn(c(
      "Inertia tensors about different points cannot be {verb}.",
      x = "One is about ({paste(format_si(p1), collapse = ', ')}) m, the other about
           ({paste(format_si(p2), collapse = ', ')}) m.",
      i = "Take both about one point, {.code inertia_tensor(body, about = )}, or join the bodies:
           {.fn join_bodies}."
    ), "point", call)
  }
  if (!isTRUE(all.equal(attr(e1, "rotation"), attr(e2, "rotation"), tolerance = 1e-12)) ||
    attr(e1, "products") != attr(e2, "products")) {
    abort_rotdyn(c(
      "Inertia tensors in different axes, or of different sign conventions, cannot be {verb}.",
      i = "Take both in the same {.arg axes} and with the same {.arg products}."
    ), "point", call)
  }
}
