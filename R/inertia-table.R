#' Moments of inertia of the standard shapes
#'
#' `inertia_objects()` lists the standard shapes at one mass and one size; `inertia_table()` gives
#' the moment of inertia of each row of a table of objects, in one pass in C.
#'
#' @param objects One of:
#'   * a data frame with a column `object` (or `shape`) naming a standard shape, `mass_kg`, and the
#'     length that sizes the shape: `radius_m`, or `length_m` for the rods. The article's names
#'     (`solid_disk`, `solid_sphere`, `thin_spherical_shell`, `point_mass_sliding`, ...) are
#'     understood. A row whose name is no standard shape needs `beta` and `radius_m`: its moment is
#'     `beta m r^2`. Other columns are kept.
#'   * a `rot_body`, or a list of them: the moment about the body's `z` axis.
#' @param mass_kg,radius_m,length_m Mass, radius and length of the standard objects.
#' @return A tibble: the columns of `objects`, then
#'   `r describe_columns(inertia_columns)`
#'   `beta` is NA for what does not roll. NA in a row's mass or size gives NA in that row's moment.
#'   Each moment carries at most four roundings (5e-16), whatever the size of its factors.
#' @section Errors: `rotdyn_error_type` for a missing column or a wrong type, `rotdyn_error_value`
#'   for a negative mass or length or an unknown shape without `beta`, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), chapter 5.
#' @examples
#' inertia_table()
#' inertia_table(data.frame(object = c("disk", "rod"), mass_kg = 2, radius_m = 0.3, length_m = 1.2))
#' inertia_table(body_disk(2, 0.25))
#' @export
inertia_table <- function(objects = inertia_objects()) {
  call <- rlang::current_env()
  if (inherits(objects, "rot_body")) {
    objects <- list(objects)
  }
  if (!is.data.frame(objects)) {
    return(inertia_of_bodies(objects, call))
  }
  name <- intersect(c("object", "shape"), names(objects))[1]
  if (is.na(name)) {
    abort_missing_column("object", objects, call)
  }
  shapes <- shape_table()
  given <- as.character(objects[[name]])
  known <- ifelse(given %in% names(shape_aliases), shape_aliases[given], given)
  i <- match(known, shapes$shape)
  beta <- if ("beta" %in% names(objects)) {
    check_column(objects[["beta"]], "beta", "1", call)
  } else {
    rep(NA_real_, length(i))
  }
  if (any(is.na(i) & is.na(beta) & !is.na(given))) {
    unknown <- unique(given[is.na(i) & is.na(beta) & !is.na(given)])
    abort_rotdyn(
      c(
        "Every object must be a standard shape or have a {.field beta}.",
        x = "Not so: {.val {unknown}}.",
        i = "The standard shapes are {.val {shapes$shape}}, also known as
             {.val {names(shape_aliases)}}."
      ),
      "value",
      call
    )
  }
  check_not_negative(beta, "beta", "1", call)

  # A name that the list knows decides; else beta and the radius do.
  k <- ifelse(is.na(i), beta, shapes$k[i])
  size_name <- ifelse(is.na(i), "radius_m", shapes$size[i])
  size <- rep(NA_real_, nrow(objects))
  for (column in unique(size_name)) {
    if (is.null(objects[[column]])) {
      abort_missing_column(column, objects, call)
    }
    values <- check_column(objects[[column]], column, "m", call)
    check_not_negative(values, column, "m", call)
    size[size_name == column] <- values[size_name == column]
  }
  if (is.null(objects[["mass_kg"]])) {
    abort_missing_column("mass_kg", objects, call)
  }
  mass <- check_column(objects[["mass_kg"]], "mass_kg", "kg", call)
  check_not_negative(mass, "mass_kg", "kg", call)

  moments <- .Call(ffi_shapes_table, k, mass, size)
  rolls <- shapes$size == "radius_m" & shapes$shape != "point"
  out <- as.list(objects)
  out[["moment_of_inertia_kg_m2"]] <- moments$moment_of_inertia_kg_m2
  out[["beta"]] <- ifelse(is.na(i), beta, ifelse(rolls, shapes$k, NA_real_)[i])
  out[["radius_of_gyration_m"]] <- moments$radius_of_gyration_m
  out[["axis"]] <- ifelse(is.na(i), "rolling axis", shapes$axis[i])
  out[["formula"]] <- ifelse(is.na(i), "beta m r^2", shapes$formula[i])
  tibble::new_tibble(out, nrow = nrow(objects))
}

#' @rdname inertia_table
#' @export
inertia_objects <- function(mass_kg = 1, radius_m = 0.1, length_m = 1) {
  call <- rlang::current_env()
  mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  radius_m <- check_number(radius_m, "radius_m", "m", call, lower = 0)
  length_m <- check_number(length_m, "length_m", "m", call, lower = 0)
  shapes <- shape_table()
  round <- shapes$size == "radius_m"
  tibble::new_tibble(list(
    object = shapes$shape,
    mass_kg = rep(mass_kg, length(round)),
    radius_m = ifelse(round, radius_m, NA_real_),
    length_m = ifelse(round, NA_real_, length_m)
  ), nrow = length(round))
}

inertia_of_bodies <- function(bodies, call) {
  if (!is.list(bodies) || !all(vapply(bodies, inherits, logical(1), "rot_body"))) {
    abort_rotdyn(
      c(
        "{.arg objects} must be a data frame, a {.cls rot_body}, or a list of those.",
        x = "It is {describe_value(bodies)}."
      ),
      "type",
      call
    )
  }
  pick <- function(f) vapply(bodies, f, numeric(1))
  size <- function(name) {
    pick(function(b) if (name %in% names(b$size_m)) b$size_m[[name]] else NA_real_)
  }
  mass <- pick(function(b) b$mass_kg)
  moment <- pick(function(b) b$inertia_kg_m2[3, 3])
  tibble::tibble(
    object = vapply(bodies, function(b) b$shape, character(1)),
    mass_kg = mass,
    radius_m = size("radius_m"),
    length_m = size("length_m"),
    moment_of_inertia_kg_m2 = moment,
    beta = pick(function(b) b$beta),
    radius_of_gyration_m = sqrt(moment / mass),
    axis = rep("own z axis", length(bodies)),
    formula = vapply(bodies, function(b) b$formula, character(1))
  )
}

check_not_negative <- function(x, arg, unit, call) {
  bad <- which(x < 0)
  if (length(bad)) {
    abort_domain(x[bad[1]], arg, unit, call, 0, Inf, FALSE, row = bad[1])
  }
}

abort_missing_column <- function(column, data, call) {
  abort_rotdyn(
    c(
      "The table needs a column {.field {column}}.",
      x = "Its columns are {.field {names(data)}}."
    ),
    "type",
    call
  )
}
