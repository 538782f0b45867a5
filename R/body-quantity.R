# A body stands for the number that an argument asks for: its mass, its radius, its moment of
# inertia or beta. The unit says which.

#' @export
quantity_of.rot_body <- function(x, arg, unit, call) {
  check_body(x, call, arg)
  if (unit == "kg") return(x$mass_kg)
  if (arg == "transverse_moment_kg_m2") {
    abort_rotdyn(c(
      "{.arg {arg}} must be a number in kg m^2.",
      x = "It is a body, whose moment about its own z axis is another.",
      i = "{.arg tops} takes a body, and finds this moment from it."
    ), "type", call)
  }
  if (unit == "kg*m^2") return(one_inertia(x, arg, call))
  if (unit == "m" && grepl("(^|_)radius(_[0-9])?_m$", arg)) {
    return(rolling_radius(x, one_inertia(x, arg, call), call))
  }
  if (unit == "1" && arg %in% c("beta", "body")) return(rolling_beta(x, arg, call))
  abort_rotdyn(c(
    "{.arg {arg}} must be a number{in_unit(unit)}.",
    x = "It is {describe_value(x)}.",
    i = "A body stands for its mass, its radius, its moment of inertia or beta."
  ), "type", call)
}

#' @export
quantity_of.list <- function(x, arg, unit, call) {
  if (!length(x) || !all(vapply(x, inherits, NA, "rot_body"))) return(x)
  vapply(x, quantity_of, double(1), arg, unit, call, USE.NAMES = FALSE)
}

# Names of shapes, whatever their sizes.
#' @export
quantity_of.character <- function(x, arg, unit, call) {
  if (unit != "1" || arg != "body") return(x)
  rolling_shapes(x, arg, call)$beta
}

rolling_beta <- function(body, arg, call) {
  if (is.na(body$beta)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a body that rolls.",
      x = "A {.val {body$shape}} has no {.field beta}, I/(m r^2)."
    ), "value", call)
  }
  body$beta
}

# Columns of numbers that bodies know, by the names of `columns`. `radius_m`: given beside the body,
# or NULL.
columns_of_bodies <- function(bodies, columns, arg, call, radius_m = NULL) {
  if (inherits(bodies, "rot_body")) bodies <- list(bodies)
  fits <- is.list(bodies) && length(bodies) && all(vapply(bodies, inherits, NA, "rot_body"))
  if (!fits) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a body, or a list of bodies.",
      x = "It is {describe_value(bodies)}.",
      i = "Such as {.code body_disk(2, 0.1)}."
    ), "type", call)
  }
  for (body in bodies) {
    check_body(body, call, arg)
    if ("radius_m" %in% columns && is.null(radius_m) && body$mass_kg > 0) {
      one_inertia(body, arg, call)
    }
  }
  read <- function(column) {
    vapply(bodies, quantity_of, double(1), column, body_units[[column]], call, USE.NAMES = FALSE)
  }
  if (is.null(radius_m)) return(stats::setNames(lapply(columns, read), columns))
  out <- list(radius_m = check_column(radius_m, "radius_m", "m", call))
  others <- setdiff(columns, "radius_m")
  out[others] <- lapply(others, function(column) {
    if (column != "beta") return(read(column))
    read("moment_of_inertia_kg_m2") / read("mass_kg") / out$radius_m / out$radius_m
  })
  out[columns]
}

body_units <- c(mass_kg = "kg", radius_m = "m", moment_of_inertia_kg_m2 = "kg*m^2", beta = "1")
