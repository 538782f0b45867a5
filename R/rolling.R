#' Rolling down an incline
#'
#' Acceleration, final speed and energies of bodies that roll without slipping, which depend on
#' `beta = I/(m r^2)` only. `rolling_table()` computes the whole table in one pass in C.
#'
#' \deqn{a = \frac{g \sin\alpha}{1+\beta},\quad v = \sqrt{\frac{2 g h}{1+\beta}},\quad
#'   \frac{K_{rot}}{K} = \frac{\beta}{1+\beta},\quad \frac{K_{trans}}{K} = \frac{1}{1+\beta}}{
#'   a = g sin(alpha)/(1 + beta),  v = sqrt(2 g h/(1 + beta)),  K_rot/K = beta/(1 + beta),
#'   K_trans/K = 1/(1 + beta)}
#'
#' @param bodies A data frame with a column `beta` (at least 0; Inf takes the limit). Its other
#'   columns are kept. Columns `incline_angle_deg`, `height_drop_m` or `gravity_m_per_s2` replace
#'   the arguments. Or one body such as [body_sphere()], a list of bodies, or the names of shapes
#'   whose `beta` does not depend on their size (see [shapes()]). By default the five objects of the
#'   article.
#' @param incline_angle_deg Angle of the incline in degrees, -90 to 90: one number, or one for each
#'   row. The sine is that of the exact angle in degrees: `sin(30 degrees)` is 0.5.
#' @param height_drop_m Height lost from rest in m, at least 0: one number, or one for each row.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble (class `rot_rolling_table`, with an `autoplot()`) of the
#'   columns of `bodies`, then `r describe_columns(rolling_columns)`
#'   NA in a row gives NA in the values that depend on it. At most four roundings each (5e-16).
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_type` (no `beta`, or not numbers), `rotdyn_error_size`,
#'   `rotdyn_error_value` with the row of the first value outside its domain, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4.
#' @seealso [rolling_functions] for use in `dplyr::mutate()`.
#' @concept rolling
#' @concept race
#' @concept incline
#' @concept hoop and disk
#' @examples
#' rolling_table()
#' rolling_table(data.frame(beta = c(0.4, 0.4), incline_angle_deg = c(10, 80)))
#' rolling_table(c("hoop", "sphere"))
#' rolling_table(list(ball = body_sphere(0.2, 0.05), pipe = body_thick_tube(2, 0.05, 0.04, 1)))
#' @export
rolling_table <- function(bodies = NULL, incline_angle_deg = 20, height_drop_m = 1,
                          gravity_m_per_s2 = 9.80665, ...) {
  call <- check_no_dots(...)
  bodies <- if (is.null(bodies)) rolling_objects() else rolling_bodies(bodies, "bodies", call)
  given <- c(
    incline_angle_deg = !missing(incline_angle_deg), height_drop_m = !missing(height_drop_m),
    gravity_m_per_s2 = !missing(gravity_m_per_s2)
  )
  twice <- names(given)[given & names(given) %in% names(bodies)]
  if (length(twice)) {
    warn_rotdyn(
      "{.arg {twice}} {?is/are} given both as column and as argument: the column is used.",
      "column", call
    )
  }
  units <- rolling_units[names(rolling_units) != "body"]
  check_near_columns(
    bodies, names(units), unique(c(names(given)[given], names(bodies))),
    column_table()$name, call
  )
  columns <- list(
    beta = bodies[["beta"]],
    incline_angle_deg = bodies[["incline_angle_deg"]] %||% incline_angle_deg,
    height_drop_m = bodies[["height_drop_m"]] %||% height_drop_m,
    gravity_m_per_s2 = bodies[["gravity_m_per_s2"]] %||% gravity_m_per_s2
  )
  columns <- check_columns_of(columns, units, call)
  n <- nrow(bodies)
  check_rows_fit(columns, n, "bodies", call)
  values <- .Call(
    ffi_rolling_table, columns[[1]], columns[[2]], columns[[3]], columns[[4]],
    progress_bar("rolling")
  )
  check_place(values, columns, call)
  warn_fast(values, columns, n, call)

  # New columns are last, or replace those of the same name.
  out <- as.list(bodies)
  if (inherits(bodies[["beta"]], "units")) out$beta <- columns$beta
  out[names(values)] <- values
  new_table(out, nrow = n, class = "rot_rolling_table")
}

# What rolls, as a data frame with the column beta: of bodies also object, mass_kg, radius_m.
rolling_bodies <- function(objects, arg, call) {
  if (is.data.frame(objects)) {
    if (is.null(objects[["beta"]])) abort_missing_column("beta", objects, call)
    return(objects)
  }
  if (inherits(objects, "rot_body")) objects <- list(objects)
  if (is.character(objects) && length(objects)) return(rolling_shapes(objects, arg, call))
  if (is.list(objects) && length(objects) && !is.object(objects)) {
    return(rolling_round_bodies(objects, arg, call))
  }
  abort_rotdyn(c(
    "{.arg {arg}} must be a data frame with a column {.field beta}, bodies, or names of shapes.",
    x = "It is {describe_value(objects)}.",
    i = "For numbers use {.code data.frame(beta = )}."
  ), "type", call)
}

rolling_shapes <- function(names, arg, call) {
  table <- shape_table()
  id <- shape_ids(names, table)
  # A formula without a letter does not depend on the sizes.
  fixed <- table$shape[nzchar(table$beta) & !grepl("[A-Za-z]", table$beta)]
  known <- id > 0L & table$shape[pmax(id, 1L)] %in% fixed
  if (!all(known)) {
    abort_rotdyn(c(
      "{.arg {arg}} must name shapes whose {.field beta} does not depend on their size.",
      x = "These are not: {.val {unique(names[!known])}}.",
      i = "Such shapes are {.val {fixed}}. Others are bodies with sizes: {.fn body_hollow_sphere}."
    ), "value", call)
  }
  beta <- vapply(table$beta[id], function(text) eval(str2lang(text), baseenv()), double(1))
  new_table(list(object = names, beta = unname(beta)), nrow = length(names))
}

rolling_round_bodies <- function(bodies, arg, call) {
  given <- names(bodies) %||% rep("", length(bodies))
  each <- lapply(seq_along(bodies), function(i) {
    body <- bodies[[i]]
    if (!inherits(body, "rot_body")) {
      abort_rotdyn(c(
        "The elements of {.arg {arg}} must be bodies.",
        x = "Element {i} is {describe_value(body)}.",
        i = "A body is what {.fn body_sphere} and the other constructors return."
      ), "type", call)
    }
    inertia <- one_inertia(body, paste0(arg, "[[", i, "]]"), call)
    radius <- rolling_radius(body, inertia, call)
    list(
      object = if (is.na(given[i]) || given[i] == "") body$shape else given[i], beta = body$beta,
      mass_kg = body$mass_kg, radius_m = radius
    )
  })
  column <- function(name) vapply(each, function(one) one[[name]], each[[1]][[name]])
  new_table(list(
    object = column("object"), beta = column("beta"), mass_kg = column("mass_kg"),
    radius_m = column("radius_m")
  ), nrow = length(each))
}

# Those of the article.
rolling_objects <- function() {
  new_table(list(
    object = c("hoop", "solid_disk", "solid_sphere", "thin_spherical_shell", "point_mass_sliding"),
    beta = shape_beta(c("hoop", "disk", "sphere", "spherical_shell", "sliding_point"))
  ), nrow = 5L)
}

#' Rolling, for vectors
#'
#' The functions of [rolling_table()] for vectors, for use in `dplyr::mutate()`. Arguments have
#' length 1 or n.
#'
#' | function | value |
#' |---|---|
#' | `rolling_acceleration()` | `g sin(angle)/(1 + beta)`, m/s^2 |
#' | `rolling_final_speed()` | `sqrt(2 g h/(1 + beta))`, m/s |
#' | `rolling_friction_coefficient()` | `beta/(1 + beta)` times the tangent of the angle's size, the least for rolling |
#'
#' @param body A round body such as [body_sphere()], a list of bodies, names of shapes such as
#'   `"hoop"`, or numbers: `beta = I/(m r^2)`, at least 0, where Inf takes the limit.
#' @inheritParams rolling_table
#' @return Doubles, with NA where an argument is NA. Largest error: 4 ulp (5 ulp for the friction
#'   coefficient).
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a result beyond double
#'   precision.
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_value` with the row of the first value outside its domain, `rotdyn_error_unit`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4.
#' @seealso [rolling_table()] for all of them, [energy_partition()].
#' @concept incline
#' @concept rolling
#' @concept friction
#' @concept rolling without slipping
#' @examples
#' rolling_acceleration(c("hoop", "disk", "sphere"), incline_angle_deg = 20)
#' rolling_final_speed(body_sphere(0.1, 0.02), height_drop_m = 0.5)
#' rolling_friction_coefficient(1, incline_angle_deg = 60)
#' @name rolling_functions
NULL

#' @rdname rolling_functions
#' @export
rolling_acceleration <- function(body, incline_angle_deg, gravity_m_per_s2 = 9.80665, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "incline_angle_deg"), call)
  by_row(1L, list(
    body = body, incline_angle_deg = incline_angle_deg, gravity_m_per_s2 = gravity_m_per_s2
  ), call)
}

#' @rdname rolling_functions
#' @export
rolling_final_speed <- function(body, height_drop_m, gravity_m_per_s2 = 9.80665, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "height_drop_m"), call)
  by_row(2L, list(
    body = body, height_drop_m = height_drop_m, gravity_m_per_s2 = gravity_m_per_s2
  ), call)
}

#' @rdname rolling_functions
#' @export
rolling_friction_coefficient <- function(body, incline_angle_deg, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "incline_angle_deg"), call)
  by_row(5L, list(body = body, incline_angle_deg = incline_angle_deg), call)
}

rolling_units <- c(
  beta = "1", body = "1", incline_angle_deg = "degree", height_drop_m = "m",
  gravity_m_per_s2 = "m/s^2"
)

# Function number `which` of src/glue/rolling.c.
by_row <- function(which, columns, call) {
  columns <- check_columns_of(columns, rolling_units[names(columns)], call)
  n <- check_recyclable(columns, call)
  values <- .Call(ffi_rolling_value, which, columns)
  check_place(values, columns, call)
  if (which == 2L) warn_fast(list(final_speed_m_per_s = values[[1]]), columns, n, call)
  values[[1]]
}

# The speed alone can overflow, and not below g h = 1e300.
warn_fast <- function(values, columns, n, call) {
  largest_of <- function(x) max(x, 0, na.rm = TRUE)
  gravity <- max(1, largest_of(columns$gravity_m_per_s2))
  if (largest_of(columns$height_drop_m) < 1e300 / gravity) return()
  warn_beyond(values["final_speed_m_per_s"], columns, n, call)
}

# In place of a list, C returns c(column, row, lowest, highest) of the first value out of its
# domain.
check_place <- function(values, columns, call) {
  if (!is.list(values)) {
    arg <- names(columns)[values[1]]
    abort_domain(
      columns[[arg]][values[2]], arg, rolling_units[[arg]], call, values[3], values[4], FALSE,
      row = if (length(columns[[arg]]) > 1L) values[2]
    )
  }
}
