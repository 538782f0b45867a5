#' Precession of gyroscopes and tops
#'
#' A body that spins about its axis of symmetry, with a point of that axis held: gravity makes the
#' axis precess about the vertical. `precession_table()` gives the fast-top formula and its error,
#' the exact rates of steady precession, and the nutation of a top that is released.
#'
#' \deqn{\tau = m g l \sin\theta,\quad L = I_3 \omega_3,\quad
#'   \Omega = \frac{m g l}{I_3 \omega_3},\quad
#'   I_1 \cos\theta\, \Omega^2 - I_3 \omega_3 \Omega + m g l = 0}{
#'   tau = m g l sin(theta),  L = I3 omega3,  Omega = m g l/(I3 omega3),
#'   I1 cos(theta) Omega^2 - I3 omega3 Omega + m g l = 0}
#'
#' The third equation is the formula of a fast top, the last one is exact for steady precession.
#' With the axis horizontal both agree. Else the formula lacks at most
#' `e = 4 I1 m g l cos(theta)/(I3 omega3)^2` of the slow rate, relative to it. A top that is held at
#' its angle and released does not precess steadily: its axis falls, precesses faster, and rises
#' again (nutation).
#'
#' @param tops Tops, or gyroscopes. A [scene_pivot()] of a symmetric body, or a list of them: mass,
#'   moments, lever arm, spin, angle and gravity are those of the scenes. A body with its axis along
#'   z, or a list of bodies, with `spin_rad_per_s` and `lever_arm_m`. Or a data frame with the
#'   columns `mass_kg`, `lever_arm_m` (from the fixed point to the centre of mass, along the axis;
#'   negative: the centre of mass is on the other side), `moment_of_inertia_kg_m2` (about the axis,
#'   I3), `spin_rad_per_s` (component of the angular velocity along the axis, omega3; not 0). Its
#'   other columns are kept. `axis_angle_deg`, `transverse_moment_kg_m2` or `gravity_m_per_s2` as
#'   columns replace the arguments. By default the three rotors of the article.
#' @param axis_angle_deg Angle of the axis from the upward vertical in degrees, 0 to 180: one
#'   number, or one for each row.
#' @param transverse_moment_kg_m2 Moment of inertia about a line through the fixed point across the
#'   axis, I1: at least half of I3. NA where it is not known.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param ... Not used; names after it must be given in full.
#' @param spin_rad_per_s,lever_arm_m With bodies: as the columns; the lever arm of a body is by
#'   default the distance along z of its centre of mass from the origin.
#' @return A tibble of the columns of `tops`, then
#'   `r describe_columns(precession_columns)`
#'   and, if a transverse moment is given, `r describe_columns(nutation_columns)`
#'   Rates have the sign of the spin where `lever_arm_m` is positive: counterclockwise seen from
#'   above. The slow and the fast rate are NaN where there is no steady precession at this angle,
#'   the fast one also where the axis is horizontal. Without a transverse moment `formula_error` is
#'   known for a horizontal axis only, and NaN elsewhere. NA gives NA in what depends on it. Errors
#'   are a few roundings; those of the nutation are below 1e-14 unless the top is within 1e-8 of
#'   sleeping.
#' @section Warnings: `rotdyn_warning_range` where finite numbers give a rate or a period beyond
#'   double precision.
#' @section Errors: `rotdyn_error_type` (a column is missing, or no numbers), `rotdyn_error_size`,
#'   `rotdyn_error_value` with the row of the first value outside its domain, `rotdyn_error_unit`,
#'   `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 5.7.
#' @seealso [trajectory()] for motions in time, [attitude] for the attitude of bodies.
#' @concept gyroscope
#' @concept precession
#' @concept nutation
#' @concept top
#' @concept bicycle wheel
#' @concept spinning top
#' @examples
#' precession_table()
#' # A top at 30 degrees: what the formula lacks, and how deep the axis falls when released.
#' cone <- body_cone(0.5, 0.04, 0.1)
#' on_tip <- place_body(cone, c(0, 0, 0.1), rotation_about("x", angle_deg = 180))
#' precession_table(on_tip, axis_angle_deg = 30, spin_rad_per_s = 500)
#' # The wheel of a bicycle on a rope, its axle level:
#' precession_table(body_hoop(2, 0.3), spin_rad_per_s = 20, lever_arm_m = 0.1)
#' @export
precession_table <- function(tops = NULL, axis_angle_deg = 90, transverse_moment_kg_m2 = NA_real_,
                             gravity_m_per_s2 = 9.80665, ..., spin_rad_per_s, lever_arm_m) {
  call <- check_no_dots(...)
  given <- c(
    axis_angle_deg = !missing(axis_angle_deg),
    transverse_moment_kg_m2 = !missing(transverse_moment_kg_m2),
    gravity_m_per_s2 = !missing(gravity_m_per_s2), spin_rad_per_s = !missing(spin_rad_per_s),
    lever_arm_m = !missing(lever_arm_m)
  )
  if (is.null(tops)) tops <- article_rotors()
  beside <- list(
    given = names(given)[given],
    spin_rad_per_s = if (given[["spin_rad_per_s"]]) spin_rad_per_s,
    lever_arm_m = if (given[["lever_arm_m"]]) lever_arm_m
  )
  tops <- table_of_tops(tops, beside, call)
  needed <- c("mass_kg", "lever_arm_m", "moment_of_inertia_kg_m2", "spin_rad_per_s")
  for (name in needed) if (is.null(tops[[name]])) abort_missing_column(name, tops, call)
  columns <- c(
    as.list(tops)[needed],
    list(
      transverse_moment_kg_m2 = tops[["transverse_moment_kg_m2"]] %||% transverse_moment_kg_m2,
      axis_angle_deg = tops[["axis_angle_deg"]] %||% axis_angle_deg,
      gravity_m_per_s2 = tops[["gravity_m_per_s2"]] %||% gravity_m_per_s2
    )
  )
  check_near_columns(
    tops, names(precession_units), names(tops), column_table()$name, call
  )
  columns <- check_columns_of(columns, precession_units, call)
  n <- nrow(tops)
  check_rows_fit(columns, n, "tops", call)
  check_top_columns(columns, call)
  out <- as.list(tops)
  columns <- lapply(columns, rep_len, n)
  values <- .Call(ffi_precession, unname(columns))
  values$sleeping_spin_rad_per_s <- .Call(ffi_precession_sleeps, unname(columns[c(
    "moment_of_inertia_kg_m2", "transverse_moment_kg_m2", "mass_kg", "lever_arm_m",
    "gravity_m_per_s2"
  )]))
  known <- any(!is.na(columns$transverse_moment_kg_m2))
  falls <- columns$mass_kg != 0 & columns$lever_arm_m != 0 & columns$gravity_m_per_s2 != 0
  moves <- list(ifelse(falls, 1, Inf)) # else it has no period
  rates <- values[c("precession_rad_per_s", "precession_period_s")]
  warn_beyond(rates, c(columns, moves), n, call)
  shown <- c(precession_columns, if (known) nutation_columns)
  out[shown] <- values[shown]
  new_table(out, nrow = n, first = c("precession_rad_per_s", "precession_period_s"))
}

article_rotors <- function() {
  utils::read.csv(
    system.file("extdata", "gyroscope_cases.csv", package = "rotdyn", mustWork = TRUE)
  )
}

# A row for each top. `beside`: the arguments that a body or a data frame has beside it.
table_of_tops <- function(tops, beside, call) UseMethod("table_of_tops")

#' @export
table_of_tops.default <- function(tops, beside, call) {
  abort_rotdyn(c(
    "{.arg tops} must be scenes of {.fn scene_pivot}, bodies, or a data frame with a column
     {.field spin_rad_per_s}.",
    x = "It is {describe_value(tops)}."
  ), "type", call)
}

#' @export
table_of_tops.data.frame <- function(tops, beside, call) {
  columns <- intersect(beside$given, c("spin_rad_per_s", "lever_arm_m"))
  if (length(columns)) {
    abort_rotdyn(
      "{.arg {columns}} {?is a column/are columns} of a data frame of tops.", "argument", call
    )
  }
  tops
}

#' @export
table_of_tops.list <- function(tops, beside, call) {
  if (length(tops) && all(vapply(tops, inherits, NA, "rot_body"))) {
    return(table_of_bodies(tops, beside, call))
  }
  if (!length(tops) || !all(vapply(tops, inherits, NA, "rot_scene"))) {
    return(table_of_tops.default(tops, beside, call))
  }
  do.call(rbind, lapply(tops, table_of_tops, beside, call))
}

#' @export
table_of_tops.rot_body <- function(tops, beside, call) table_of_bodies(list(tops), beside, call)

table_of_bodies <- function(bodies, beside, call) {
  if ("transverse_moment_kg_m2" %in% beside$given) {
    abort_rotdyn("{.arg transverse_moment_kg_m2} is known of a body.", "argument", call)
  }
  if (is.null(beside$spin_rad_per_s)) {
    abort_rotdyn("{.arg spin_rad_per_s} is missing: it has no default.", "missing", call)
  }
  for (body in bodies) check_body(body, call, "tops")
  number <- function(f) vapply(bodies, f, double(1), USE.NAMES = FALSE)
  given <- check_columns_of(
    list(
      spin_rad_per_s = beside$spin_rad_per_s,
      lever_arm_m = beside$lever_arm_m %||% number(function(body) body$centre_m[[3]])
    ),
    c("rad/s", "m"), call
  )
  x <- c(list(
    mass_kg = number(function(body) body$mass_kg),
    moment_of_inertia_kg_m2 = number(function(body) symmetric_moments(body, call)[1]),
    across = number(function(body) symmetric_moments(body, call)[2])
  ), given)
  n <- check_recyclable(x, call)
  x <- lapply(x, rep_len, n)
  new_table(list(
    mass_kg = x$mass_kg, lever_arm_m = x$lever_arm_m,
    moment_of_inertia_kg_m2 = x$moment_of_inertia_kg_m2, spin_rad_per_s = x$spin_rad_per_s,
    transverse_moment_kg_m2 = x$across + x$mass_kg * x$lever_arm_m^2
  ), nrow = n)
}

# About the centre of mass: along z, across it.
symmetric_moments <- function(body, call) {
  tensor <- body$inertia_kg_m2
  size <- sqrt(max(tensor) / body$mass_kg)
  off <- max(abs(tensor[row(tensor) != col(tensor)]), abs(tensor[1] - tensor[5]))
  if (off > 1e-9 * max(tensor) || any(abs(body$centre_m[1:2]) > 1e-9 * size)) {
    abort_rotdyn(c(
      "{.arg tops} must be bodies that are symmetric about the z axis.",
      x = "The moments of a {.val {body$shape}} are {format_si(diag(tensor))} kg m^2, its centre of
           mass is at {format_si(body$centre_m)} m."
    ), "value", call)
  }
  tensor[c(9, 1)]
}

precession_units <- c(
  mass_kg = "kg", lever_arm_m = "m", moment_of_inertia_kg_m2 = "kg*m^2", spin_rad_per_s = "rad/s",
  transverse_moment_kg_m2 = "kg*m^2", axis_angle_deg = "degree", gravity_m_per_s2 = "m/s^2"
)

# Columns of tops, with the row of the first value outside its domain.
check_top_columns <- function(columns, call) {
  for (name in names(columns)) {
    bad <- which(is.infinite(columns[[name]]))
    if (length(bad)) {
      abort_domain(columns[[name]][bad[1]], name, precession_units[[name]], call, -Inf, Inf, FALSE,
                   row = bad[1])
    }
  }
  for (name in intersect(c("mass_kg", "gravity_m_per_s2"), names(columns))) {
    check_not_negative(columns[[name]], name, precession_units[[name]], call)
  }
  for (name in intersect(c("moment_of_inertia_kg_m2", "transverse_moment_kg_m2"), names(columns))) {
    check_not_negative(columns[[name]], name, "kg*m^2", call, open = TRUE)
  }
  angle <- columns$axis_angle_deg
  bad <- which(angle < 0 | angle > 180)
  if (length(bad)) {
    abort_domain(angle[bad[1]], "axis_angle_deg", "degree", call, 0, 180, FALSE, row = bad[1])
  }
  bad <- which(columns$spin_rad_per_s == 0)
  if (length(bad)) {
    abort_rotdyn(c(
      "{.arg spin_rad_per_s} must not be 0.",
      x = "It is 0 in row {bad[1]}.",
      i = "A body that does not spin falls: see {.fn scene_pendulum}."
    ), "value", call)
  }
  bad <- which(columns$transverse_moment_kg_m2 < columns$moment_of_inertia_kg_m2 / 2 * (1 - 1e-9))
  if (length(bad)) {
    abort_rotdyn(c(
      "{.arg transverse_moment_kg_m2} must be at least half of {.arg moment_of_inertia_kg_m2}.",
      x = "In row {bad[1]} it is less: no body has such moments."
    ), "value", call)
  }
}
