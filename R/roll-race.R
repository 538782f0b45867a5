#' A race of rolling bodies
#'
#' Bodies released together from rest at the top of an incline: where each of them is at each time,
#' a row for each body and time, ready to be drawn frame by frame. [summary()] gives the order of
#' the finish, `ggplot2::autoplot()` a picture.
#'
#' From rest every force is constant, so that a body rolls, slides or rests for good:
#' \deqn{a = \frac{g(\sin\alpha - (b/R)\cos\alpha)}{1 + \beta}\ \mbox{(rolls)},\quad
#'   a = g(\sin\alpha - \mu_k\cos\alpha)\ \mbox{(slides)}}{
#'   a = g (sin(alpha) - b/R cos(alpha))/(1 + beta) where it rolls,
#'   a = g (sin(alpha) - mu_k cos(alpha)) where it slides}
#' It arrives after `sqrt(2 length/a)`. [scene_incline()] takes other starts.
#'
#' @param bodies What races, as in [rolling_table()]: a data frame with a column `beta`, bodies such
#'   as [body_sphere()], or names of shapes. Columns of the names of the arguments below replace
#'   these.
#' @param incline_angle_deg Angle of the incline in degrees, -90 to 90.
#' @param length_m Length of the incline from the start to the finish in m, greater than 0.
#' @param ... Not used; names after it must be given in full.
#' @param radius_m Radius on which a body rolls, in m, where it has none of its own: `theta_rad` and
#'   the rolling resistance depend on it.
#' @param static_friction,kinetic_friction Coefficients of friction, `0 <= kinetic <= static`; Inf:
#'   no body slips.
#' @param rolling_arm_m Arm of the rolling resistance in m, at least 0.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param time_s Times of the frames in s, finite and at least 0; or NULL for `frames` of them, from
#'   the start to the last arrival.
#' @param frames How many, where `time_s` is NULL.
#' @return A tibble (class `rot_race`) with a row for each time and body, all bodies of the first
#'   time first: the columns of `bodies`, then
#'   `r describe_columns(race_columns)`
#'   After its finish a body keeps the state in which it arrived. A body with `beta = 0` does not
#'   turn. With other rows, or without one of these columns, it is a plain tibble.
#'   `summary()`: one row for each body, in the order of the finish, with
#'   `r describe_columns(race_summary_columns)`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` with the row of
#'   the first value outside its domain, `rotdyn_error_unit`, `rotdyn_error_time`,
#'   `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 2.4.
#' @seealso [rolling_table()] for speeds and energies, [autoplot.rot_race()], [scene_incline()].
#' @concept incline
#' @concept animation
#' @examples
#' race <- roll_race(c("hoop", "disk", "sphere"), incline_angle_deg = 10, length_m = 2)
#' race
#' summary(race)
#' # A frame of an animation:
#' race[race$time_s == race$time_s[100], c("object", "x_m", "theta_rad")]
#' # On ice the hoop slips first:
#' summary(roll_race(incline_angle_deg = 20, length_m = 2, static_friction = 0.15))
#' @export
roll_race <- function(bodies = NULL, incline_angle_deg = 20, length_m = 1, ...,
                      radius_m = 0.1, static_friction = Inf, kinetic_friction = static_friction,
                      rolling_arm_m = 0, gravity_m_per_s2 = 9.80665, time_s = NULL,
                      frames = 61) {
  call <- current_env()
  check_no_dots(...)
  objects <- if (is.null(bodies)) rolling_objects() else rolling_bodies(bodies, "bodies", call)
  n <- nrow(objects)
  given <- list(
    beta = NULL, radius_m = radius_m, incline_angle_deg = incline_angle_deg,
    gravity_m_per_s2 = gravity_m_per_s2, static_friction = static_friction,
    kinetic_friction = kinetic_friction, rolling_arm_m = rolling_arm_m, length_m = length_m
  )
  if (is.null(objects[["kinetic_friction"]]) && missing(kinetic_friction)) {
    given["kinetic_friction"] <- list(objects[["static_friction"]] %||% static_friction)
  }
  check_near_columns(objects, names(given), names(objects), column_table()$name, call)
  columns <- lapply(stats::setNames(names(given), names(given)), function(name) {
    x <- check_column(objects[[name]] %||% given[[name]], name, race_domain(name)$unit, call)
    if (name == "radius_m" && !is.null(objects[[name]])) {
      own <- check_number(radius_m, name, "m", call, lower = 0, open = TRUE)
      x[is.na(x)] <- own
    }
    if (!length(x) %in% c(1L, n)) {
      abort_rotdyn(c(
        "{.arg {name}} must have one number, or one for each body.",
        x = "It has {length(x)}, and there are {n} bod{?y/ies}."
      ), "size", call)
    }
    check_race_column(x, name, call)
    x
  })
  less <- which(columns$static_friction < columns$kinetic_friction)
  if (length(less)) {
    abort_rotdyn(
      "{.arg kinetic_friction} must be at most {.arg static_friction}: it is larger in row
       {less[1]}.", "value", call
    )
  }
  starts <- .Call(ffi_incline_starts, columns, progress_bar("race"))
  if (n != length(starts[[1]])) starts <- lapply(starts, rep_len, n)
  time_s <- race_times(time_s, frames, starts$finish_time_s, call)
  rows <- .Call(ffi_incline_frames, starts, time_s, progress_bar("race"))
  warn_beyond(Filter(is.double, rows), list(), length(rows$lane), call)
  own <- objects[setdiff(names(objects), names(rows))]
  who <- rows$lane
  new_table(
    c(lapply(own, function(column) rep.int(column, length(time_s))), rows),
    nrow = length(who), class = "rot_race",
    race = list(objects = new_table(own, nrow = n), starts = starts, columns = columns)
  )
}

race_domain <- function(name) {
  if (name == "length_m") return(list(unit = "m", lower = 0, open = TRUE))
  known <- incline_parameters[[name]]
  if (name == "beta") known <- list(unit = "1", lower = 0, infinite = TRUE)
  known
}

check_race_column <- function(x, name, call) {
  known <- race_domain(name)
  lower <- known$lower
  upper <- known$upper %||% Inf
  open <- isTRUE(known$open)
  ends <- suppressWarnings(range(x, na.rm = TRUE))
  if (!length(x) || all(is.na(x))) return(invisible())
  fine <- ends[1] >= lower && ends[2] <= upper && !(open && ends[1] <= lower) &&
    (all(is.finite(ends)) || isTRUE(known$infinite))
  if (fine) return(invisible())
  outside <- x < lower | x > upper | (open & x <= lower) |
    (is.infinite(x) & !isTRUE(known$infinite))
  first <- which(outside)[1]
  abort_domain(
    x[first], name, known$unit, call, lower, upper, open, row = if (length(x) > 1L) first
  )
}

# Those given, or frames up to the last arrival.
race_times <- function(time_s, frames, finish_s, call) {
  if (!is.null(time_s)) {
    time_s <- check_times(time_s, call)
    if (length(time_s) && time_s[1] < 0) {
      abort_rotdyn(c(
        "{.arg time_s} must be at least 0: the race starts then.",
        x = "It begins at {format(time_s[1])} s."
      ), "time", call)
    }
    return(time_s)
  }
  frames <- floor(check_number(frames, "frames", "1", call, lower = 1, upper = 1e6))
  ends <- finish_s[is.finite(finish_s)]
  seq(0, if (length(ends)) max(ends) else 1, length.out = frames)
}

reconstruct_race <- function(x, from) {
  reconstruct_whole(x, from, "race", intersect(race_columns, names(from)))
}

#' @export
`[.rot_race` <- function(x, ...) reconstruct_race(NextMethod(), x)

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_race <- function(data, template) reconstruct_race(data, template)

#' @export
summary.rot_race <- function(object, ...) {
  check_no_dots(...)
  race <- attr(object, "race", exact = TRUE)
  if (is.null(race)) {
    abort_rotdyn("These rows are no race any more.", "type", current_env())
  }
  starts <- race$starts
  order <- order(starts$finish_time_s)
  place <- rank(starts$finish_time_s, na.last = "keep", ties.method = "min")
  place[is.infinite(starts$finish_time_s)] <- NA
  slides <- starts$slips | rep_len(race$columns$beta, length(order)) %in% 0
  columns <- c(
    list(place = as.integer(place)), as.list(race$objects),
    starts[c("acceleration_m_per_s2", "finish_time_s")],
    list(
      final_speed_m_per_s = ifelse(
        is.finite(starts$finish_time_s), starts$acceleration_m_per_s2 * starts$finish_time_s,
        NA_real_
      ),
      friction_needed = starts$friction_needed,
      from_rest = ifelse(starts$rests, "rests", ifelse(slides, "slides", "rolls"))
    )
  )
  new_table(
    lapply(columns[!duplicated(names(columns))], `[`, order), nrow = length(order)
  )
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_race <- function(x, ...) {
  race <- attr(x, "race", exact = TRUE)
  size <- c("A race" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)))
  if (is.null(race)) return(size)
  finish_s <- race$starts$finish_time_s
  n <- length(finish_s)
  best <- min(c(finish_s, Inf), na.rm = TRUE)
  first <- if (best < Inf) which(finish_s == best)
  c(
    size, "Bodies" = paste(n, "at", length(unique(x[["time_s"]])), "times"),
    if (length(first)) {
      c("First" = paste0(
        paste(utils::head(escape_controls(race_labels(race)[first]), 3L), collapse = ", "),
        " after ",
        format_si(best), " s"
      ))
    }
  )
}

race_labels <- function(race) {
  object <- race$objects[["object"]]
  if (is.null(object)) {
    paste("beta =", format(race$objects[["beta"]], digits = 3, trim = TRUE))
  } else {
    gsub("_", " ", as.character(object))
  }
}
