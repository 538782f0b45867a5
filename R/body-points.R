#' A body from point masses
#'
#' Mass, centre of mass and second moment of rigidly connected points. The sums are compensated and
#' taken about the centre, so the error is some 1e-16 of the trace at any distance from the origin;
#' sums about the origin lose all digits at a distance of 1e8 sizes.
#' \deqn{m = \sum_i m_i,\quad g = \frac{1}{m}\sum_i m_i x_i,\quad
#'   C = \sum_i m_i (x_i - g)(x_i - g)^T,\quad I = \mathrm{tr}(C)\,1 - C}{
#'   m = sum m_i,  g = sum m_i x_i / m,  C = sum m_i (x_i - g)(x_i - g)',  I = tr(C) 1 - C}
#'
#' @param data A data frame with columns `mass_kg`, `x_m`, `y_m` and `z_m`, or a matrix whose
#'   columns are x, y and z (with these names or none), with the masses in `mass_kg`. Without `z_m`,
#'   z is 0. Other columns and groups are ignored: see the examples. Columns may be units objects.
#' @param ... Not used; names after it must be given in full.
#' @param mass_kg Masses, one for each row or one for all, if `data` has no column of that name.
#' @param name Name of the body.
#' @return A `rot_body` in the axes of the coordinates. `reach_m` is the distance to the farthest
#'   point; `detail` has the number of `points`, the points themselves if there are at most 2000
#'   (`at`, drawn by `autoplot()`), and `centre_error_m`, a bound of the error of each coordinate of
#'   the centre. `error` is a bound of the rounding errors; masses and coordinates are taken as
#'   exact.
#'
#'   Masses may be 0. If all are, the second moment is 0 and the centre is the unweighted mean of
#'   the points. Masses and coordinates may differ by any factor.
#' @section Errors: `rotdyn_error_value` for NA, NaN, Inf and a mass below 0, with the row (for
#'   holes see [cut_body()]); `rotdyn_error_type` for a missing column or one of a wrong type;
#'   `rotdyn_error_size` for no points or incompatible lengths; `rotdyn_error_missing`;
#'   `rotdyn_error_unit`; `rotdyn_error_range` where the mass or the moments exceed double
#'   precision.
#' @source Chan, Golub and LeVeque, The American Statistician 37 (1983) 242: sums about a centre.
#' @seealso [body_density()] for a continuous body, [join_bodies()] for bodies with a size.
#' @concept point masses
#' @concept particles
#' @concept molecule
#' @concept moment of inertia
#' @examples
#' # A water molecule.
#' u <- 1.66053906660e-27
#' angle <- 104.45 / 2 * pi / 180
#' water <- data.frame(
#'   mass_kg = c(15.999, 1.008, 1.008) * u,
#'   x_m = 0.9584e-10 * c(0, sin(angle), -sin(angle)),
#'   y_m = 0.9584e-10 * c(0, cos(angle), cos(angle))
#' )
#' body_points(water, name = "water")
#'
#' body_points(matrix(rnorm(30), 10), mass_kg = 0.1)
#'
#' # A body for each group of a table.
#' if (requireNamespace("dplyr", quietly = TRUE)) {
#'   water$end <- c("left", "right", "left")
#'   dplyr::summarise(
#'     dplyr::group_by(water, end),
#'     body = list(body_points(data.frame(mass_kg, x_m, y_m)))
#'   )
#' }
#' @export
body_points <- function(data, ..., mass_kg = NULL, name = "points") {
  call <- check_no_dots(...)
  check_supplied("data", call)
  name <- check_name(name, "name", call)
  points <- read_points(data, mass_kg, call)
  bad <- .Call(ffi_points_bad, points$mass_kg, points$x_m, points$y_m, points$z_m)
  if (bad[1] > 0) abort_point(points, bad[1], bad[2] + 1, call)
  moments <- points_moments(points$mass_kg, points$x_m, points$y_m, points$z_m, call)
  check_moments_fit(moments, call)
  new_body(
    name, moments[["mass"]], moments_second(moments), moments_centre(moments),
    reach_m = .Call(ffi_points_reach, points$x_m, points$y_m, points$z_m, as.double(moments)),
    formula = "sum of m (x - g)(x - g)'",
    source = "the points given",
    provenance = "points",
    detail = list(
      points = length(points$x_m),
      at = if (length(points$x_m) <= 2000) tibble::as_tibble(points),
      centre_error_m = moments_centre_error(moments)
    ),
    error = moments[["error"]]
  )
}

# ---- input --------------------------------------------------------------------------------------

place_columns <- c("x_m", "y_m", "z_m")

# A list of columns; z_m may have length 1.
read_points <- function(data, mass_kg, call) {
  if (inherits(data, "units")) {
    keep <- attributes(data)[c("dim", "dimnames")]
    data <- as_si(data, "m", "data", call)
    attributes(data) <- keep[lengths(keep) > 0]
  }
  columns <- if (is.data.frame(data)) {
    as.list(data)
  } else if (is.matrix(data) && is.numeric(data)) {
    matrix_columns(data, call)
  } else {
    abort_rotdyn(c(
      "{.arg data} must be a data frame with columns {.field mass_kg}, {.field x_m},
       {.field y_m} and {.field z_m}, or a matrix of coordinates.",
      x = "It is {describe_value(data)}."
    ), "type", call)
  }
  n <- nrow(data)
  check_places_named(columns, is.null(mass_kg), call)
  if (n == 0L) abort_rotdyn("{.arg data} must have at least one point: it has none.", "size", call)
  if (!is.null(mass_kg)) columns$mass_kg <- mass_kg
  points <- list(
    mass_kg = check_column(columns$mass_kg, "mass_kg", "kg", call),
    x_m = check_column(columns$x_m, "x_m", "m", call),
    y_m = check_column(columns$y_m, "y_m", "m", call),
    z_m = if (is.null(columns$z_m)) 0 else check_column(columns$z_m, "z_m", "m", call)
  )
  for (column in names(points)) {
    # A column that is a matrix would be read as more points.
    if (!length(points[[column]]) %in% c(1L, n)) {
      abort_rotdyn(
        "{.arg {column}} must have one number for each of the {n} point{?s}, or one for all: it has
         {length(points[[column]])}.",
        "size", call
      )
    }
  }
  lapply(points, function(x) {
    attributes(x) <- NULL
    x
  })
}

matrix_columns <- function(data, call) {
  names <- colnames(data)
  if (is.null(names) && ncol(data) %in% 2:3) names <- place_columns[seq_len(ncol(data))]
  if (is.null(names)) {
    abort_rotdyn(c(
      "A matrix without column names must have two or three columns: x, y and z.",
      x = "It has {ncol(data)}."
    ), "size", call)
  }
  columns <- lapply(seq_len(ncol(data)), function(j) as.vector(data[, j]))
  short <- match(names, c("x", "y", "z"))
  names[!is.na(short)] <- place_columns[short[!is.na(short)]]
  stats::setNames(columns, names)
}

# A column with a name like z_m is taken for a misspelling, not for points in a plane.
check_places_named <- function(columns, needs_mass, call) {
  has <- names(columns)
  wanted <- c(if (needs_mass) "mass_kg", "x_m", "y_m")
  if (any(grepl("^z($|[^[:alpha:]])", has, ignore.case = TRUE))) wanted <- c(wanted, "z_m")
  lacking <- setdiff(wanted, has)
  if (length(lacking)) {
    abort_rotdyn(c(
      "{.arg data} has no {cli::qty(lacking)}column{?s} {.field {lacking}}.",
      x = if (length(has)) "Its columns are {.field {has}}." else "It has no columns.",
      i = if (identical(lacking, "mass_kg")) "Or give the masses as {.arg mass_kg}."
    ), "type", call)
  }
  if (!needs_mass && "mass_kg" %in% has) {
    abort_rotdyn(
      "Masses must be given once: as {.arg mass_kg} or as a column of {.arg data}.", "value", call
    )
  }
}

abort_point <- function(points, row, column, call) {
  arg <- names(points)[column]
  x <- points[[column]]
  value <- if (length(x) == 1L) x else x[row]
  abort_rotdyn(c(
    if (column == 1L) "Masses must be finite and at least 0." else "Coordinates must be finite.",
    x = "{.field {arg}} is {format(value)} in row {format(row, big.mark = ',')}.",
    i = if (isTRUE(value < 0) && is.finite(value)) "For a hole, use {.fn cut_body}."
  ), "value", call)
}

# ---- moments ------------------------------------------------------------------------------------

# The numbers of src/glue/points.c; used for nodes and random points of a density, too.
moment_names <- c(
  "mass", "x", "y", "z", "x_lo", "y_lo", "z_lo", "xx", "yy", "zz", "xy", "xz", "yz",
  "mass_error", "centre_error", "error", "vanished"
)

points_moments <- function(mass, x, y, z, call, exponent = 0, progress = progress_bar("points")) {
  moments <- .Call(ffi_points_moments, mass, x, y, z, exponent, progress)
  if (is.null(moments)) {
    abort_rotdyn("The points are too far apart for double precision.", "range", call)
  }
  names(moments) <- moment_names
  moments
}

join_moments <- function(a, b) {
  if (is.null(a)) return(b)
  stats::setNames(.Call(ffi_points_join, as.double(a), as.double(b)), moment_names)
}

moments_second <- function(moments) as.double(moments[8:13])

moments_centre <- function(moments) as.double(moments[2:4])

moments_trace <- function(moments) sum(moments[8:10])

# The low part of the centre is dropped.
moments_centre_error <- function(moments) {
  moments[["centre_error"]] + max(abs(moments[5:7]))
}

check_moments_fit <- function(moments, call) {
  if (!.Call(ffi_points_fit, as.double(moments))) {
    abort_rotdyn(c(
      "The mass or the second moment exceeds double precision.",
      x = "Mass {format(moments[['mass']], digits = 3)} kg, trace of the second moment
           {format(moments_trace(moments), digits = 3)} kg m^2.",
      i = "Use other units of mass or length, as if they were kg and m."
    ), "range", call)
  }
}
