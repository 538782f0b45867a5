# A body: mass, centre of mass, second moment about it, size, source and error of the numbers.
# `second_moment_kg_m2` is C = int (x - g)(x - g)' dm in the body's own axes; the inertia tensor
# I = tr(C) 1 - C is derived only here. `centre_m` is in the own axes, with the origin stated in the
# help of the shape. `reach_m` is an upper bound of the distance from the centre of mass to the
# farthest point; NA if unknown.
new_body <- function(shape, mass_kg, second_moment_kg_m2, centre_m = c(0, 0, 0),
                     size_m = numeric(), reach_m = NA_real_, beta = NA_real_, formula = "",
                     source = "", provenance = "formula", detail = list(), error = NA_real_,
                     error_kind = "bound", call = rlang::caller_env()) {
  tensors <- .Call(ffi_inertia_tensors, second_moment_kg_m2)
  if (!all(is.finite(.subset2(tensors, 2L)))) {
    abort_rotdyn("The body's inertia exceeds double precision.", "range", call)
  }
  attr(centre_m, "names") <- c("x", "y", "z")
  body <- list(
    shape = shape,
    mass_kg = mass_kg,
    size_m = size_m,
    centre_m = centre_m,
    second_moment_kg_m2 = .subset2(tensors, 1L),
    inertia_kg_m2 = .subset2(tensors, 2L),
    point = "centre of mass",
    axes = "own",
    reach_m = reach_m,
    beta = beta,
    formula = formula,
    source = source,
    provenance = provenance,
    detail = detail,
    error = error,
    error_kind = error_kind
  )
  class(body) <- "rot_body"
  body
}

# The source of a body's numbers, in words.
provenance_words <- c(
  formula = "formula", tensor = "given tensor", points = "point masses",
  quadrature = "quadrature of a density",
  monte_carlo = "random points in a density", compound = "joined bodies"
)

# For a mesh, by method.
mesh_words <- c(
  solid = "mesh, exact integrals", shell = "faces of a mesh, exact integrals",
  hull = "convex hull of a mesh, exact integrals", box = "box of a mesh"
)

check_body <- function(body, call, arg = "body") {
  if (!inherits(body, "rot_body")) {
    check_class(
      body, "rot_body", arg, "Make one with {.fn body_disk} or another constructor.", call
    )
  }
  check_form(body, body_form, arg, "body", call)
  if (body$mass_kg < 0) abort_form("mass_kg", arg, "body", call)
  # Their own moment is computed from the size.
  size <- switch(axis_shape(body), point = "radius_m", rod_end = "length_m")
  if (!is.null(size) && !size %in% names(body$size_m)) abort_form("size_m", arg, "body", call)
  body
}

# I_n = n' I n about the unit vector n in the body's own axes, through a point.
moment_about_axis <- function(body, axis, point = centre) {
  centre <- .subset2(body, "centre_m")
  .Call(
    ffi_inertia_axis, .subset2(body, "mass_kg"), centre, .subset2(body, "second_moment_kg_m2"),
    axis, point
  )
}

# Where the axle that a body names passes: the end of a rod_end, the axis of a point, wherever they
# are placed. The centre of mass of all other bodies.
named_point <- function(body) {
  if (!nzchar(axis_shape(body))) return(as.double(.subset2(body, "centre_m")))
  .subset2(.subset2(body, "detail"), "frame")$at_m %||% c(0, 0, 0)
}

# The moment of inertia that scenes take: about that axle, along `axis`.
named_moment <- function(body, axis) {
  moment_about_axis(body, axis, named_point(body))
}

# For prints: where an axle passes. `through` as in scene_axle(), NULL for the named axle.
describe_point <- function(body, through) {
  if (is.null(through)) through <- axis_shape(body)
  if (is.numeric(through)) {
    at <- as.double(through)
    if (any(at != 0) && !identical(at, as.double(body$centre_m))) {
      return(paste0("through (", paste(format_si(at), collapse = ", "), ") m"))
    }
    through <- if (any(at != 0)) "centre" else "origin"
  }
  switch(through,
    origin = "through the origin of the own axes",
    rod_end = "through the rod's end",
    point = paste(format_si(body$size_m[["radius_m"]]), "m from the point"),
    "through the centre of mass"
  )
}

#' @export
print.rot_body <- function(x, ...) {
  check_body(x, current_env(), "x")
  say("<rot_body> ", x$shape, "\n")
  size <- if (length(x$size_m)) {
    paste0(", ", paste0(names(x$size_m), " = ", format_si(x$size_m), collapse = ", "))
  }
  print_field("mass", paste0(format_si(x$mass_kg), " kg", size))
  size <- sqrt(sum(diag(x$second_moment_kg_m2)) / x$mass_kg)
  centre <- clear_noise(x$centre_m, if (is.finite(size)) 4 * .Machine$double.eps * size else 0)
  if (any(centre != 0)) {
    print_field("centre", paste0("(", paste(format_si(centre), collapse = ", "), ") m"))
  }
  print_inertia(x)
  if (!is.na(x$beta)) print_field("beta", paste0(format_si(x$beta), "  (I/(m r^2) when it rolls)"))
  # The moment about the centre stands above: that of the formula may be about another axis.
  formula <- x$formula
  if (nzchar(axis_shape(x))) {
    value <- paste0(" = ", format_si(moment_of_shape(x)), " kg m^2  (")
    formula <- sub("  (", value, formula, fixed = TRUE)
  }
  if (nzchar(formula)) print_field("formula", formula)
  from <- if (x$provenance == "mesh") {
    mesh_words[paste(x$detail$method, collapse = " ")]
  } else {
    provenance_words[x$provenance]
  }
  if (is.na(from)) from <- "unknown"
  print_field("from", paste0(from, ", ", describe_body_error(x)))
  invisible(x)
}

# A line "name  text", wrapped to the console's width under the text.
print_field <- function(name, text) {
  room <- max(print_width() - 12L, 20L)
  lines <- if (nchar(text) > room) strwrap(text, room + 1L) else text
  names <- formatC(c(name, rep("", length(lines) - 1L)), width = -10)
  cat(paste0("  ", names, lines, "\n"), sep = "")
}

# Values below the body's error are shown as 0.
print_inertia <- function(x) {
  noise <- body_noise(x)
  digits <- body_digits(x)
  inertia <- clear_noise(x$inertia_kg_m2, noise)
  axes <- principal_axes(x)
  about <- paste0("about the ", x$point, ", ", x$axes, " axes")
  if (all(inertia[upper.tri(inertia)] == 0)) {
    moments <- paste(c("Ixx", "Iyy", "Izz"), format_si(diag(inertia), digits), collapse = ", ")
    print_field("inertia", paste0(moments, " kg m^2 ", about))
  } else {
    print_field("inertia", paste0("kg m^2 ", about, ":"))
    say(paste0(strrep(" ", 12), format_columns(inertia, digits), "\n"))
    moments <- clear_noise(axes$principal_moment_kg_m2, noise)
    print_field("principal", paste0(paste(format_si(moments, digits), collapse = ", "), " kg m^2"))
  }
  print_field("symmetry", describe_symmetry(axes))
}

body_noise <- function(x) {
  # Term by term: the sum of moments near 1.8e308 would overflow.
  if (is.finite(x$error)) sum(x$error * diag(x$second_moment_kg_m2)) else 0
}

# The significant digits by the error, and one more; at most 7.
body_digits <- function(x) {
  if (isTRUE(x$error > 0)) min(max(1 - floor(log10(x$error)), 2), 7) else 7
}

clear_noise <- function(x, noise) {
  x[abs(x) <= noise] <- 0
  x
}

describe_body_error <- function(x) {
  if (is.na(x$error)) return("accuracy unknown")
  if (x$error == 0) return("exact")
  paste0(
    "relative error ", if (x$error_kind == "bound") "at most " else "about ",
    format(x$error, digits = 2)
  )
}

format_si <- function(x, digits = 7) {
  vapply(x, format, character(1), digits = digits)
}

# The rows of a matrix as text, with aligned columns.
format_columns <- function(x, digits = 7) {
  columns <- apply(x, 2, function(column) format(format_si(column, digits), justify = "right"))
  apply(columns, 1, paste, collapse = "  ")
}
