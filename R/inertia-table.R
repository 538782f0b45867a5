#' Moments of inertia of the standard shapes
#'
#' The moments of inertia of each row of a table of bodies, in one pass in C; by default of all
#' standard shapes at one mass and one size.
#'
#' @param bodies One of:
#'   * NULL: all standard shapes of [shapes()], or names of some, such as `c("disk", "rod")`, with
#'     `mass_kg`, `radius_m` and `length_m`;
#'   * a data frame with a column `object` (or `shape`) naming a standard shape, `mass_kg`, and the
#'     sizes of the shapes that occur: `radius_m`, `length_m`, `outer_radius_m`, ..., as in their
#'     constructors and in [shapes()]. The article's names (`solid_disk`, `solid_sphere`,
#'     `thin_spherical_shell`, `point_mass_sliding`, ...) are also accepted. A row with another name
#'     needs `beta` and `radius_m`: its moment is `beta m r^2`. Other columns are kept; sizes that a
#'     row's shape does not have are ignored.
#'   * a `rot_body`, or a list of them: the moment about the body's `z` axis through its centre of
#'     mass; for a [body_rod_end()] about its end, and for a [body_point()] about the axis at the
#'     distance `radius_m`. The position of a body has no effect; after a rotation the moment is
#'     about the new `z` axis, while `formula` is unchanged.
#' @param ... Not used; names after it must be given in full.
#' @param mass_kg,radius_m,length_m Mass, radius and length of the standard shapes, where `bodies`
#'   is NULL or names. Their other sizes are simple parts of these: inner radii are half of
#'   `radius_m`.
#' @return A tibble: the columns of `bodies` (of standard shapes: last), then
#'   `r describe_columns(inertia_columns)`
#'   The first moment is about `axis`, with its `formula`, and is that of [moment_of_inertia()] and
#'   of scenes; the other three are about the centre of mass, along the own axes. `beta` is NA for
#'   bodies that do not roll; a row with only `beta` has no other moments (NA). NA in a row's mass
#'   or sizes gives NA in that row's results, NaN gives NaN and Inf the limit of the formula.
#'   Each moment has at most 25 roundings (3e-15; 2 to 5 for most shapes), for sizes in ratios of up
#'   to 1e300 and any mass.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type` for a missing column or a wrong type, `rotdyn_error_size`
#'   for a column that is a matrix, `rotdyn_error_value` for a negative mass or length, sizes that
#'   are inconsistent, or an unknown shape without `beta`, with the row; `rotdyn_error_unit`.
#' @source As in [body_shapes] and [shapes()].
#' @seealso [shapes()] for the formulas, [moment_of_inertia()] for any axis, [body_shapes],
#'   [rolling_table()].
#' @concept moment
#' @concept moment of inertia
#' @concept disc
#' @concept ring
#' @concept hoop
#' @examples
#' inertia_table()
#' inertia_table(c("disk", "hoop", "sphere"), mass_kg = 2, radius_m = 0.25)
#' inertia_table(data.frame(object = c("disk", "rod"), mass_kg = 2, radius_m = 0.3, length_m = 1.2))
#' inertia_table(data.frame(
#'   shape = "hollow_sphere", mass_kg = 1, outer_radius_m = 0.1, inner_radius_m = c(0, 0.05, 0.1)
#' ))
#' inertia_table(body_disk(2, 0.25))
#' @export
inertia_table <- function(bodies = NULL, ..., mass_kg = 1, radius_m = 0.1, length_m = 1) {
  call <- check_no_dots(...)
  standard <- is.null(bodies) || is.character(bodies)
  if (!standard && !(missing(mass_kg) && missing(radius_m) && missing(length_m))) {
    abort_rotdyn(c(
      "{.arg mass_kg}, {.arg radius_m} and {.arg length_m} are those of standard shapes.",
      i = "Bodies and rows of a table have their own."
    ), "argument", call)
  }
  objects <- if (standard) {
    standard_objects(bodies, mass_kg, radius_m, length_m, call)
  } else {
    bodies
  }
  if (inherits(objects, "rot_body")) objects <- list(objects)
  if (!is.data.frame(objects)) return(inertia_of_bodies(objects, call))
  name <- c(intersect(c("object", "shape"), names(objects)), NA)[1]
  if (is.na(name)) abort_missing_column("object", objects, call)
  shapes <- shape_table()
  check_shape_names(objects[[name]], name, nrow(objects), call)
  id <- shape_ids(objects[[name]], shapes)
  beta <- if ("beta" %in% names(objects)) needed_column("beta", "1", objects, call) else NA_real_
  check_known(objects[[name]], id, beta, call)
  mass <- needed_column("mass_kg", "kg", objects, call)
  sizes <- needed_sizes(id, shapes, objects, call)

  # Known names have precedence over beta and the radius.
  values <- .Call(ffi_shapes_table, id, mass, beta, sizes)
  if (!is.list(values)) abort_row(values, id, mass, beta, sizes, call)
  warn_beyond(values, c(list(mass, beta), Filter(length, sizes)), nrow(objects), call)
  text <- id + 1L
  out <- as.list(objects)
  out[names(values)] <- values
  out[["axis"]] <- c("rolling axis", shapes$axis)[text]
  out[["formula"]] <- c("beta m r^2", shapes$formula)[text]
  # The columns given, then the results in the order of the dictionary.
  kept <- setdiff(names(out), inertia_columns)
  columns <- c(kept, inertia_columns)
  if (standard) {
    first <- c("object", "mass_kg", "moment_of_inertia_kg_m2", "axis", "formula")
    columns <- c(first, setdiff(inertia_columns, first), setdiff(kept, first))
  }
  new_table(out[columns], nrow = nrow(objects))
}

check_shape_names <- function(given, column, rows, call) {
  if (is.data.frame(given) || length(given) != rows) {
    abort_rotdyn(c(
      "{.field {column}} must be a column of names, one for each row.",
      x = "It is {describe_value(given)} for {rows} row{?s}."
    ), if (is.data.frame(given)) "type" else "size", call)
  }
}

# The C core's numbers of the named shapes; 0 for other names.
shape_ids <- function(given, shapes) {
  known <- c(shapes$shape, names(shape_aliases))
  ids <- c(seq_along(shapes$shape), match(shape_aliases, shapes$shape))
  if (is.factor(given)) {
    id <- ids[match(levels(given), known)][given]
  } else {
    id <- ids[match(as.character(given), known)]
  }
  id[is.na(id)] <- 0L
  id
}

check_known <- function(given, id, beta, call) {
  unknown <- id == 0L
  if (!any(unknown)) return(invisible())
  unknown <- unique(as.character(given[unknown & is.na(beta) & !is.na(given)]))
  if (length(unknown)) {
    abort_rotdyn(c(
      "Every object must be a standard shape or have a {.field beta}.",
      x = "Neither: {.val {unknown}}.",
      i = "{.fn shapes} lists the standard shapes; {.val {names(shape_aliases)}} are other names."
    ), "value", call)
  }
}

needed_column <- function(column, unit, objects, call) {
  if (is.null(objects[[column]])) abort_missing_column(column, objects, call)
  values <- check_column(objects[[column]], column, unit, call)
  if (length(values) != nrow(objects)) {
    abort_rotdyn(c(
      "{.arg {column}} must have one number for each row.",
      x = "It has {length(values)} for {nrow(objects)} row{?s}."
    ), "size", call)
  }
  values
}

# The columns of sizes in the order of the C core; NULL if no row needs it.
needed_sizes <- function(id, shapes, objects, call) {
  all <- size_table()
  used <- which(tabulate(id, nrow(shapes)) > 0L)
  needed <- unique(c(unlist(shapes$names[used]), if (any(id == 0L)) "radius_m"))
  lapply(seq_len(nrow(all)), function(k) {
    if (all$name[k] %in% needed) {
      needed_column(all$name[k], if (all$kind[k] == "count") "1" else "m", objects, call)
    }
  })
}

# c(fault, row, slot) of the C pass, as an error about that row.
abort_row <- function(fault, id, mass, beta, sizes, call) {
  row <- fault[2]
  at <- function(x) x[if (length(x) == 1L) 1L else row]
  if (fault[1] == 5) abort_domain(at(mass), "mass_kg", "kg", call, 0, Inf, FALSE, row = row)
  if (fault[1] == 6) abort_domain(at(beta), "beta", "1", call, 0, Inf, FALSE, row = row)
  names <- if (id[row]) shape_table()$names[[id[row]]] else "radius_m"
  size <- vapply(match(names, size_table()$name), function(k) at(sizes[[k]]), double(1))
  abort_shape(fault, names, size, row, call)
}

# The standard shapes, or some by name, at one mass and one size.
standard_objects <- function(names = NULL, mass_kg = 1, radius_m = 0.1, length_m = 1,
                             call = rlang::caller_env()) {
  mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  r <- check_number(radius_m, "radius_m", "m", call, lower = 0)
  l <- check_number(length_m, "length_m", "m", call, lower = 0)
  shapes <- shape_table()
  values <- c(
    radius_m = r, length_m = l, outer_radius_m = r, inner_radius_m = r / 2, base_radius_m = r,
    top_radius_m = r / 2, ring_radius_m = r, tube_radius_m = r / 4, semi_x_m = r,
    semi_y_m = r / 2, semi_z_m = r / 4, width_m = r, height_m = r, edge_m = r, base_m = r,
    apex_m = r / 2, sides = 6
  )
  n <- nrow(shapes)
  sizes <- matrix(NA_real_, n, length(values), dimnames = list(NULL, names(values)))
  of <- match(unlist(shapes$names), names(values))
  sizes[cbind(rep.int(seq_len(n), lengths(shapes$names)), of)] <- values[of]
  sizes <- lapply(seq_along(values), function(k) sizes[, k])
  names(sizes) <- names(values)
  all <- new_table(
    c(list(object = shapes$shape, mass_kg = rep(mass_kg, n)), sizes), nrow = n
  )
  if (is.null(names)) return(all)
  id <- shape_ids(names, shapes)
  check_known(names, id, rep(NA_real_, length(id)), call)
  if (anyNA(names)) abort_rotdyn("{.arg bodies} has a missing name.", "value", call)
  some <- all[id, ]
  some$object <- names
  some
}

inertia_of_bodies <- function(bodies, call) {
  if (!is.list(bodies) || !all(vapply(bodies, inherits, logical(1), "rot_body"))) {
    abort_rotdyn(c(
      "{.arg bodies} must be a data frame, names of shapes, a {.cls rot_body}, or a list of those.",
      x = "It is {describe_value(bodies)}."
    ), "type", call)
  }
  for (body in bodies) check_body(body, call, "bodies")
  pick <- function(f) vapply(bodies, f, numeric(1))
  given <- unique(unlist(lapply(bodies, function(b) names(b$size_m))))
  known <- intersect(size_table()$name, c("radius_m", "length_m", given))
  sizes <- lapply(known, function(name) {
    pick(function(b) if (name %in% names(b$size_m)) b$size_m[[name]] else NA_real_)
  })
  names(sizes) <- known
  moment <- function(k) pick(function(b) b$inertia_kg_m2[k, k])
  mass <- pick(function(b) b$mass_kg)
  izz <- moment(3)
  # Two shapes have their moment about an axis that is not through the centre.
  id <- shape_ids(vapply(bodies, axis_shape, ""), shape_table())
  about <- pick(moment_of_shape)
  new_table(c(
    list(object = vapply(bodies, function(b) b$shape, character(1)), mass_kg = mass),
    sizes,
    list(
      moment_of_inertia_kg_m2 = about,
      axis = c("z, through the centre of mass", shape_table()$axis)[id + 1L],
      ixx_kg_m2 = moment(1),
      iyy_kg_m2 = moment(2),
      izz_kg_m2 = izz,
      beta = pick(function(b) b$beta),
      radius_of_gyration_m = sqrt(about / mass),
      formula = vapply(bodies, function(b) b$formula, character(1))
    )
  ), nrow = length(bodies))
}

# The shape of a body if its moment is about an axis that is not through its centre; else "".
axis_shape <- function(body) {
  shape <- .subset2(body, "shape") # four calls for each scene: %in% and $ would take 15 us of them
  if ((shape == "point" || shape == "rod_end") && .subset2(body, "provenance") == "formula") {
    shape
  } else {
    ""
  }
}

# The axis rotates with the body, so the moment is computed from the sizes.
moment_of_shape <- function(body) {
  mass <- body$mass_kg
  switch(axis_shape(body),
    point = mass * body$size_m[["radius_m"]] * body$size_m[["radius_m"]],
    rod_end = mass * body$size_m[["length_m"]] * body$size_m[["length_m"]] / 3,
    body$inertia_kg_m2[[9]]
  )
}
