#' Domains of a density
#'
#' Domains for [body_density()]. Boxes, cylinders, balls, ellipsoids and maps are the image of a
#' cuboid of parameters, for which quadrature is accurate with few evaluations. A `domain_inside()`
#' is defined by a predicate and needs random points.
#'
#' @param lower_m,upper_m Opposite corners of the box, three numbers each. For `domain_inside()`, a
#'   bounding box of the body.
#' @param radius_m,length_m Outer radius; length along z; both greater than 0 m.
#' @param inner_radius_m Radius of the hole, less than `radius_m`.
#' @param angle_rad First and last angle of a sector, from x towards y; at most a full turn.
#' @param centre_m Centre of the cylinder, ball or ellipsoid.
#' @param semi_x_m,semi_y_m,semi_z_m Semi-axes, greater than 0 m.
#' @param map A function of three vectors, the parameters, that returns the points: a matrix with
#'   columns x, y, z, or a list of three vectors.
#' @param jacobian A function of the same vectors that returns the absolute value of the determinant
#'   \eqn{|\partial(x, y, z)/\partial(u, v, w)|}{|d(x, y, z)/d(u, v, w)|}. It is compared with
#'   finite differences of `map` at a few points.
#' @param lower,upper Smallest and largest value of the three parameters.
#' @param periodic Which parameters are periodic, so that map and density repeat after
#'   `upper - lower`: three logical values.
#' @param inside A function of the vectors x, y and z that returns TRUE for points in the body.
#' @param ... Not used; names after it must be given in full.
#' @return A `rot_domain`.
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_value` (NA, NaN, Inf, an empty domain), `rotdyn_error_unit`;
#'   `rotdyn_error_density` for a map that returns no points, or a wrong Jacobian.
#' @seealso [body_density()]
#' @concept region
#' @concept integration domain
#' @examples
#' domain_box(lower_m = c(0, 0, 0), upper_m = c(1, 2, 3))
#' domain_cylinder(radius_m = 0.5, length_m = 2, inner_radius_m = 0.4)
#' domain_ball(radius_m = 6.371e6)
#' domain_ellipsoid(semi_x_m = 3, semi_y_m = 2, semi_z_m = 1)
#'
#' # A torus, radii 2 and 0.5, by its map ...
#' domain_map(
#'   function(r, t, p) cbind((2 + r * cos(t)) * cos(p), (2 + r * cos(t)) * sin(p), r * sin(t)),
#'   jacobian = function(r, t, p) r * (2 + r * cos(t)),
#'   lower = c(0, 0, 0), upper = c(0.5, 2 * pi, 2 * pi), periodic = c(FALSE, TRUE, TRUE)
#' )
#' # ... and by a predicate.
#' domain_inside(
#'   function(x, y, z) (sqrt(x^2 + y^2) - 2)^2 + z^2 < 0.25,
#'   lower_m = c(-2.5, -2.5, -0.5), upper_m = c(2.5, 2.5, 0.5)
#' )
#' @name domains
NULL

#' @rdname domains
#' @export
domain_box <- function(lower_m, upper_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("lower_m", "upper_m"), call)
  box <- check_box(lower_m, upper_m, c("lower_m", "upper_m"), "m", call)
  new_domain(
    "box",
    size_m = stats::setNames(2 * box$half, c("length_x_m", "length_y_m", "length_z_m")),
    centre_m = box$middle,
    chart = c(0, -box$half, box$half, 1, 1, 1)
  )
}

#' @rdname domains
#' @export
domain_cylinder <- function(radius_m, length_m, ..., inner_radius_m = 0,
                            angle_rad = c(0, 2 * pi), centre_m = c(0, 0, 0)) {
  call <- check_no_dots(...)
  check_supplied(c("radius_m", "length_m"), call)
  radii <- check_radii(inner_radius_m, radius_m, call)
  length_m <- check_number(length_m, "length_m", "m", call, lower = 0, open = TRUE)
  angle <- check_turn(angle_rad, call)
  new_domain(
    "cylinder",
    size_m = c(
      radius_m = radii[2], length_m = length_m, if (radii[1] > 0) c(inner_radius_m = radii[1])
    ),
    centre_m = check_vector(centre_m, "centre_m", "m", call),
    chart = c(1, radii[1], angle$from, -length_m / 2, radii[2], angle$to, length_m / 2, 1, 1, 1),
    periodic = c(FALSE, angle$full, FALSE)
  )
}

#' @rdname domains
#' @export
domain_ball <- function(radius_m, ..., inner_radius_m = 0, centre_m = c(0, 0, 0)) {
  call <- check_no_dots(...)
  check_supplied("radius_m", call)
  radii <- check_radii(inner_radius_m, radius_m, call)
  new_domain(
    "ball",
    size_m = c(radius_m = radii[2], if (radii[1] > 0) c(inner_radius_m = radii[1])),
    centre_m = check_vector(centre_m, "centre_m", "m", call),
    chart = c(2, radii[1], -1, -pi, radii[2], 1, pi, 1, 1, 1),
    periodic = c(FALSE, FALSE, TRUE)
  )
}

#' @rdname domains
#' @export
domain_ellipsoid <- function(semi_x_m, semi_y_m, semi_z_m, ..., centre_m = c(0, 0, 0)) {
  call <- check_no_dots(...)
  check_supplied(c("semi_x_m", "semi_y_m", "semi_z_m"), call)
  size <- c(
    semi_x_m = check_number(semi_x_m, "semi_x_m", "m", call, lower = 0, open = TRUE),
    semi_y_m = check_number(semi_y_m, "semi_y_m", "m", call, lower = 0, open = TRUE),
    semi_z_m = check_number(semi_z_m, "semi_z_m", "m", call, lower = 0, open = TRUE)
  )
  new_domain(
    "ellipsoid",
    size_m = size,
    centre_m = check_vector(centre_m, "centre_m", "m", call),
    chart = c(2, 0, -1, -pi, 1, 1, pi, size),
    periodic = c(FALSE, FALSE, TRUE)
  )
}

#' @rdname domains
#' @export
domain_map <- function(map, jacobian, lower, upper, ..., periodic = c(FALSE, FALSE, FALSE)) {
  call <- check_no_dots(...)
  check_supplied(c("map", "jacobian", "lower", "upper"), call)
  check_field_function(map, "map", call)
  check_field_function(jacobian, "jacobian", call)
  box <- check_box(lower, upper, c("lower", "upper"), "1", call)
  if (!is.logical(periodic) || length(periodic) != 3L || anyNA(periodic)) {
    abort_rotdyn("{.arg periodic} must be three logical values.", "type", call)
  }
  domain <- new_domain(
    "map",
    chart = c(0, -box$half, box$half, 1, 1, 1), periodic = periodic, parameter = box$middle,
    map = map, jacobian = jacobian
  )
  check_jacobian(domain, call)
  domain
}

#' @rdname domains
#' @export
domain_inside <- function(inside, lower_m, upper_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("inside", "lower_m", "upper_m"), call)
  check_field_function(inside, "inside", call)
  box <- check_box(lower_m, upper_m, c("lower_m", "upper_m"), "m", call)
  new_domain(
    "inside", centre_m = box$middle, chart = c(0, -box$half, box$half, 1, 1, 1), inside = inside
  )
}

# `chart` is what src/glue/density.c reads: kind, low, high, stretch. Its coordinates are about
# `centre_m`; those of a map are parameters about `parameter`.
new_domain <- function(kind, size_m = numeric(), centre_m = c(0, 0, 0), chart,
                       periodic = c(FALSE, FALSE, FALSE), parameter = NULL, map = NULL,
                       jacobian = NULL, inside = NULL) {
  chart <- as.double(chart)
  structure(
    list(
      kind = kind, size_m = size_m, centre_m = centre_m, chart = chart,
      exponent = .Call(ffi_density_exponent, chart), periodic = periodic,
      parameter = parameter, map = map, jacobian = jacobian, inside = inside
    ),
    class = "rot_domain"
  )
}

#' @export
print.rot_domain <- function(x, ...) {
  check_form(x, domain_form, "x", "domain", current_env())
  size <- if (length(x$size_m)) {
    paste0(": ", paste0(names(x$size_m), " = ", format_si(x$size_m), collapse = ", "))
  }
  how <- if (x$kind == "inside") "random points only" else "quadrature, random points"
  say("<rot_domain> ", x$kind, size, "\n")
  if (any(x$centre_m != 0)) {
    print_field("centre", paste0("(", paste(format_si(x$centre_m), collapse = ", "), ") m"))
  }
  print_field("for", how)
  invisible(x)
}

# Upper bound of the distance of points of the domain from `from` (in its axes); NA for a map.
domain_reach <- function(domain, from) {
  g <- abs(from - domain$centre_m)
  high <- domain$chart[5:7]
  reach <- switch(domain$kind,
    box = ,
    inside = hypot3(g + high),
    cylinder = hypot3(c(hypot3(c(g[1:2], 0)) + high[1], g[3] + high[3], 0)),
    ball = hypot3(g) + high[1],
    ellipsoid = hypot3(g) + max(domain$chart[8:10]),
    NA_real_
  )
  reach * (1 + 8 * .Machine$double.eps)
}

# Length of a vector, without overflow.
hypot3 <- function(x) {
  size <- max(abs(x))
  if (size > 0) size * sqrt(sum((x / size)^2)) else 0
}

# ---- checks -------------------------------------------------------------------------------------

# A function of three vectors.
check_field_function <- function(f, arg, call) {
  check_function(f, arg, call)
  if (takes_arguments(f, 3L)) return()
  abort_rotdyn(c(
    "{.arg {arg}} must be a function of three vectors.",
    x = "It takes {length(arguments_of(f))}, {length(required_arguments(f))} of them without a
         default."
  ), "type", call)
}

check_box <- function(lower, upper, args, unit, call) {
  lower <- check_vector(lower, args[1], unit, call)
  upper <- check_vector(upper, args[2], unit, call)
  half <- upper / 2 - lower / 2
  at <- which(!(half > 0))[1]
  if (!is.na(at)) {
    abort_rotdyn(c(
      "{.arg {args[2]}} must be greater than {.arg {args[1]}}.",
      x = "Component {at} is {format(upper[at])} against {format(lower[at])}."
    ), "value", call)
  }
  list(middle = lower / 2 + upper / 2, half = half)
}

check_radii <- function(inner_m, outer_m, call) {
  outer_m <- check_number(outer_m, "radius_m", "m", call, lower = 0, open = TRUE)
  inner_m <- check_number(inner_m, "inner_radius_m", "m", call, lower = 0)
  if (inner_m >= outer_m) {
    abort_rotdyn(c(
      "{.arg inner_radius_m} must be less than {.arg radius_m}.",
      x = "It is {format(inner_m)} m against {format(outer_m)} m.",
      i = "For a thin shell with an areal density see {.fn shapes}."
    ), "value", call)
  }
  c(inner_m, outer_m)
}

check_turn <- function(angle_rad, call) {
  angle <- check_finite(angle_rad, "angle_rad", "rad", call)
  if (length(angle) != 2L) {
    abort_rotdyn(
      "{.arg angle_rad} must be two angles, the first and the last: it has {length(angle)}.",
      "size", call
    )
  }
  turn <- (angle[2] - angle[1]) / (2 * pi)
  if (!(turn > 0 && turn <= 1 + 1e-12)) {
    abort_rotdyn(c(
      "{.arg angle_rad} must increase, by at most a full turn.",
      x = "It goes from {format(angle[1])} to {format(angle[2])} rad."
    ), "value", call)
  }
  full <- turn >= 1 - 1e-12
  list(from = angle[1], to = if (full) angle[1] + 2 * pi else angle[2], full = full)
}

# Finite differences of the map at five generic points. A wrong factor fails at all of them; a kink
# may fail at one or two.
check_jacobian <- function(domain, call) {
  half <- domain$chart[5:7]
  t <- (outer(1:5, c(0.819, 0.671, 0.549)) %% 1) * 1.8 - 0.9
  at <- sweep(sweep(t, 2, half, `*`), 2, domain$parameter, `+`)
  place <- function(p) {
    do.call(cbind, map_places(domain, p[, 1], p[, 2], p[, 3], call))
  }
  # Central differences, accurate to some 1e-8.
  step <- 1e-5 * half
  slopes <- lapply(1:3, function(k) {
    off <- matrix(rep(step * (1:3 == k), each = 5), 5)
    (place(at + off) - place(at - off)) / (2 * step[k])
  })
  found <- vapply(1:5, function(i) {
    abs(det(vapply(slopes, function(s) s[i, ], double(3))))
  }, double(1))
  said <- map_jacobian(domain, at[, 1], at[, 2], at[, 3], call)
  off <- abs(found - said) > 0.01 * pmax(found, said)
  if (sum(off) >= 3) {
    i <- which(off)[1]
    abort_rotdyn(c(
      "{.arg jacobian} must be the absolute value of the determinant of the derivatives of
       {.arg map}.",
      x = "At ({paste(format(at[i, ], digits = 4), collapse = ', ')}) it is
           {format(said[i], digits = 4)}; differences of {.arg map} give
           {format(found[i], digits = 4)}."
    ), "density", call)
  }
}

map_places <- function(domain, u, v, w, call) {
  places <- domain$map(u, v, w)
  if (is.matrix(places)) places <- lapply(seq_len(ncol(places)), function(j) places[, j])
  fine <- is.list(places) && length(places) == 3L &&
    all(vapply(places, function(x) is_number(x) && length(x) == length(u), NA))
  if (!fine) {
    abort_rotdyn(c(
      "{.arg map} must return a matrix with columns x, y and z, a row for each of its arguments'
       elements, or a list of three such vectors.",
      x = "For {length(u)} point{?s} it returned {describe_value(places)}."
    ), "density", call)
  }
  places <- lapply(unname(as.list(places)), as.double)
  at <- which(!(is.finite(places[[1]]) & is.finite(places[[2]]) & is.finite(places[[3]])))
  if (length(at)) {
    place <- vapply(places, function(x) format(x[at[1]], digits = 7), "")
    abort_rotdyn(c(
      "{.arg map} must return finite coordinates.",
      x = "At u = {format(u[at[1]], digits = 7)}, v = {format(v[at[1]], digits = 7)},
           w = {format(w[at[1]], digits = 7)} it returned ({paste(place, collapse = ', ')})."
    ), "density", call)
  }
  places
}

map_jacobian <- function(domain, u, v, w, call) {
  check_field(domain$jacobian(u, v, w), "jacobian", list(u, v, w), call)
}

# Checks the value of a function of points: a number of at least 0 for each.
check_field <- function(x, arg, places, call, names = c("u", "v", "w")) {
  n <- length(places[[1]])
  if (inherits(x, "units") && arg == "f") x <- as_si(x, "kg/m^3", "f", call)
  if (!is_number(x) || is.object(x)) {
    abort_rotdyn(
      c("{.arg {arg}} must return numbers.", x = "It returned {describe_value(x)}."),
      "density", call
    )
  }
  if (length(x) != n) {
    abort_rotdyn(c(
      "{.arg {arg}} must return one value for each of the points it is given.",
      x = "For {n} points it returned {length(x)} value{?s}.",
      i = "If it takes one point at a time, wrap it: {.code Vectorize({arg})}.",
      i = if (length(x) == 1L && arg == "f") "A density that is the same everywhere is a number."
    ), "density", call)
  }
  if (!(isTRUE(min(x) >= 0) && max(x) < Inf)) {
    at <- which(is.na(x) | x < 0 | x == Inf)[1]
    where <- paste0(
      names, " = ", vapply(places, function(p) format(p[at], digits = 7), ""), collapse = ", "
    )
    abort_rotdyn(
      c("{.arg {arg}} must be finite and at least 0.", x = "It is {format(x[at])} at {where}."),
      "density", call
    )
  }
  as.double(x)
}
