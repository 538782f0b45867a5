#' Bodies given by their vertices
#'
#' @description
#' * `body_polygon()`: a flat plate with a polygonal outline, in the plane z = 0.
#' * `body_tetrahedron()`: a solid tetrahedron.
#'
#' \deqn{C = \frac{M}{24 A} \sum_i d_i \left(a_i a_i^T + b_i b_i^T
#'   + (a_i + b_i)(a_i + b_i)^T\right), \quad d_i = a_i \times b_i}{
#'   C = M/(24 A) sum d_i (a_i a_i' + b_i b_i' + (a_i + b_i)(a_i + b_i)'),  d_i = a_i x b_i}
#' over the edges of a polygon, from \eqn{a_i} to \eqn{b_i} relative to the centre of mass, with
#' \eqn{A = \sum d_i/2}{A = sum d_i/2} (Green);
#' \deqn{C = \frac{M}{20} \sum_i (v_i - g)(v_i - g)^T}{C = M/20 sum (v_i - g)(v_i - g)'}
#' over the vertices of a tetrahedron. Differences of vertices are exact and sums have 31 digits, so
#' distance from the origin costs no digits.
#'
#' @inheritParams body_shapes
#' @param vertices_m Vertices in m, in the body's own axes, in rows: a matrix of two columns
#'   (polygon) or three (tetrahedron, four rows), or a data frame with columns `x_m`, `y_m` (and
#'   `z_m`). The vertices of a polygon are in order, in either sense; the first need not be
#'   repeated.
#' @param areal_density_kg_m2,density_kg_m3 Mass per area or volume, instead of `mass_kg`.
#' @inherit body_shapes return
#' @section Errors: As for all shapes (see [body_shapes]); `rotdyn_error_value` also for coordinates
#'   of NA, NaN or Inf, for collinear (coplanar) vertices, and for edges that cross. Vertices may
#'   touch an edge, as where a slit leads to a hole.
#' @source Steger, On the calculation of arbitrary moments of polygons, TU Muenchen FGBV-96-05
#'   (1996); Tonon, Journal of Mathematics and Statistics 1 (2005) 8.
#' @seealso [body_triangle()] by base and height, [body_polygon_plate()] and
#'   [body_regular_tetrahedron()] for the regular ones; [cut_body()] for holes.
#' @concept polygon
#' @concept outline
#' @concept convex hull
#' @examples
#' # An L of sheet metal.
#' ell <- cbind(c(0, 2, 2, 1, 1, 0), c(0, 0, 1, 1, 2, 2))
#' body_polygon(vertices_m = ell, areal_density_kg_m2 = 8)
#' body_tetrahedron(1, rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)))$centre_m
#' @name body_vertices
NULL

#' @rdname body_vertices
#' @export
body_polygon <- function(mass_kg, vertices_m, ..., areal_density_kg_m2 = NULL) {
  call <- check_no_dots(...)
  check_supplied("vertices_m", call)
  vertices <- as_vertices(vertices_m, 2L, call)
  if (nrow(vertices) < 3L) abort_corners("A polygon has at least three corners.", vertices, call)
  amount <- mass_or_density("areal_density_kg_m2", "kg/m^2", call)
  parts <- .Call(
    ffi_vertices_polygon, vertices, amount, !is.null(names(amount)), progress_bar("polygon")
  )
  new_vertices_body("polygon", vertices, parts, amount, "sum over the edges", "Steger 1996", call)
}

#' @rdname body_vertices
#' @export
body_tetrahedron <- function(mass_kg, vertices_m, ..., density_kg_m3 = NULL) {
  call <- check_no_dots(...)
  check_supplied("vertices_m", call)
  vertices <- as_vertices(vertices_m, 3L, call)
  if (nrow(vertices) != 4L) abort_corners("A tetrahedron has four corners.", vertices, call)
  amount <- mass_or_density("density_kg_m3", "kg/m^3", call)
  parts <- .Call(ffi_vertices_tetrahedron, vertices, amount, !is.null(names(amount)))
  new_vertices_body(
    "tetrahedron", vertices, parts, amount, "m/20 sum (v - g)(v - g)'", "Tonon 2005", call
  )
}

abort_corners <- function(must, vertices, call) {
  abort_rotdyn(c(must, x = "{.arg vertices_m} has {nrow(vertices)} row{?s}."), "size", call)
}

new_vertices_body <- function(shape, vertices, parts, amount, formula, source, call) {
  if (!is.list(parts)) abort_vertices(parts, shape, call)
  body <- finish_body(
    shape, parts, numeric(), list(formula = formula, source = source), amount, call
  )
  measure <- if (shape == "polygon") "area_m2" else "volume_m3"
  # Of the first vertex and the offset from it.
  body$detail$centre_error_m <- .Machine$double.eps * (max(abs(body$centre_m)) + body$reach_m)
  body$detail <- c(
    body$detail, list(corners = nrow(vertices)), stats::setNames(list(parts[[7]]), measure),
    list(vertices_m = vertices)
  )
  body
}

# A matrix of finite doubles with `dimension` columns.
as_vertices <- function(x, dimension, call) {
  names <- c("x_m", "y_m", "z_m")[seq_len(dimension)]
  if (is.data.frame(x)) {
    if (!all(names %in% names(x))) {
      abort_rotdyn(c(
        "{.arg vertices_m} needs the columns {.field {names}}.",
        x = "Its columns are {.field {names(x)}}."
      ), "type", call)
    }
    columns <- lapply(names, function(name) check_corner_column(x[[name]], name, nrow(x), call))
    return(matrix(unlist(columns, use.names = FALSE), ncol = dimension))
  }
  if (!is.matrix(x) || ncol(x) != dimension) {
    abort_rotdyn(c(
      "{.arg vertices_m} must be a matrix of {dimension} columns, or a data frame with the columns
       {.field {names}}.",
      x = "It is {describe_value(x)}."
    ), if (is.matrix(x)) "size" else "type", call)
  }
  matrix(check_finite(x, "vertices_m", "m", call), ncol = dimension)
}

# A column that is a matrix would be read as more vertices.
check_corner_column <- function(x, name, rows, call) {
  x <- check_finite(x, name, "m", call)
  if (length(x) != rows) {
    abort_rotdyn(
      "{.arg {name}} must have one number for each of the {rows} corner{?s}: it has {length(x)}.",
      "size", call
    )
  }
  x
}

# c(fault, edge, edge), in the order of rot_vertices_fault.
abort_vertices <- function(fault, shape, call) {
  flat <- fault[1] == 1
  abort_rotdyn(
    if (!flat) {
      c(
        "The edges of {.arg vertices_m} cross.",
        x = "The one from corner {fault[2]} crosses the one from corner {fault[3]}.",
        i = "Corners must be in the order of the outline, in either sense."
      )
    } else if (shape == "polygon") {
      c("The corners of {.arg vertices_m} enclose no area.", i = "They lie on one line.")
    } else {
      c("The corners of {.arg vertices_m} enclose no volume.", i = "They lie in one plane.")
    },
    "value", call
  )
}
