#' Forces at points: torques, resultant, central axis
#'
#' A table of forces with the points where they act, in a plane or in space; its torques about any
#' point, and the one force and couple to which it reduces.
#' \deqn{\vec F = \sum_i \vec F_i,\quad \vec\tau_P = \sum_i (\vec r_i - \vec r_P) \times \vec F_i +
#'   \vec C_i}{F = sum F_i,  tau_P = sum (r_i - r_P) x F_i + C_i}
#'
#' Points and vectors of two numbers are in the plane of x and y, with y up and torques positive
#' counter-clockwise. Those of three numbers are in space, with z up. One table has one kind.
#'
#' About a point of the **central axis** the torque is parallel to the force. The force along this
#' axis and the couple along it are a *wrench*; couple/force is its pitch. In a plane the couple of
#' a wrench is 0: a force on its line of action is left, or a couple alone.
#'
#' Sums are carried to twice the precision, so that forces which cancel leave the rounding of the
#' numbers given. A sum below 8 roundings (9e-16) of the sum of its absolute terms counts as 0.
#'
#' @param ... For `forces()`: loads (`load_force()`, ...), data frames, or lists of them; a name
#'   names the rows of an argument. A data frame has the columns `x_m`, `y_m`, `fx_n`, `fy_n`; in
#'   space `z_m` and `fz_n`, too. `torque_n_m` (in space `torque_x_n_m`, `torque_y_n_m`,
#'   `torque_z_n_m`) and `load` (a name) may be left out. For the other functions: not used, an
#'   unknown argument is an error.
#' @param force_n Two or three components in N; or a size, with `angle_deg`.
#' @param at_m,from_m,to_m Points in m: two or three numbers.
#' @param angle_deg Direction of the force in degrees from the x axis, counter-clockwise.
#' @param mass_kg Mass in kg, at least 0; its weight acts along -y in a plane, -z in space.
#' @param gravity_m_per_s2 Acceleration of gravity, at least 0.
#' @param torque_n_m A couple: one number in a plane, three in space.
#' @param down_n_per_m Load per length, down: a number, or those at both ends of a linear load.
#' @param name Name of the load.
#' @param loads What `forces()` returned, or anything that it takes.
#' @param about_m The point; the origin by default.
#' @return `forces()` and loads: a tibble with a row for each force and the columns `load`, points,
#'   components and couples as above. A linear load is two forces, which have its force and torque.
#'
#'   `force_torques()`: the same rows and columns, and
#'   `r describe_columns(c("torque_about_n_m", "lever_arm_m"))`
#'   In space the torque has the columns `torque_about_x_n_m`, `torque_about_y_n_m`,
#'   `torque_about_z_n_m`.
#'
#'   `resultant()`: one row with `kind` ("none", "force", "couple" or "wrench"), the components of
#'   force and torque about the point, and
#'   `r describe_columns(resultant_columns)`
#'   The axis is NA without a force. Numbers must be finite: NA and Inf are errors.
#' @section Warnings: `rotdyn_warning_range` where a sum exceeds double precision.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size` for vectors of another length and for
#'   plane and space in one table, `rotdyn_error_value`, `rotdyn_error_unit`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), section 1.2; for the
#'   central axis Routh, Analytical Statics, vol. 1 (1896), chapter 7.
#' @seealso [static_equilibrium()] for the reactions of supports, [torque_of_force()].
#' @concept torque
#' @concept wrench
#' @concept couple
#' @concept seesaw
#' @concept lever
#' @concept weight
#' @examples
#' pull <- forces(
#'   load_force(c(40, 0), at_m = c(0, 0.3)),
#'   load_force(50, angle_deg = 90, at_m = c(0.25, 0)),
#'   brake = load_couple(-3)
#' )
#' pull
#' force_torques(pull)
#' resultant(pull)
#' resultant(pull, about_m = c(0.25, 0.3))
#' # Sand along 2 m of a beam acts at the middle of what it covers.
#' sand <- forces(load_line(150, from_m = c(1, 0), to_m = c(3, 0)))
#' force_torques(sand)
#' # In space: a force and a couple along it are a wrench.
#' resultant(data.frame(
#'   x_m = c(0, 1), y_m = 0, z_m = c(0, 2), fx_n = c(0, 3), fy_n = c(4, 0), fz_n = 0
#' ))
#' @export
forces <- function(...) {
  call <- environment()
  given <- list(...)
  named <- rlang::names2(given)
  parts <- lapply(seq_along(given), function(i) {
    collect_forces(given[[i]], if (nzchar(named[i])) named[i] else NULL, call)
  })
  parts <- unlist(parts, recursive = FALSE)
  if (!length(parts)) return(new_forces(character(), matrix(0, 0, 2), matrix(0, 0, 2), double()))
  bind_forces(parts, call)
}

#' @rdname forces
#' @export
load_force <- function(force_n, at_m, ..., angle_deg = NULL, name = "force") {
  call <- check_no_dots(...)
  check_supplied(c("force_n", "at_m"), call)
  name <- check_name(name, "name", call)
  at_m <- check_point(at_m, "at_m", "m", call)
  if (!is.null(angle_deg)) {
    size <- check_number(force_n, "force_n", "N", call)
    angle <- check_number(angle_deg, "angle_deg", "degree", call)
    force_n <- .Call(ffi_lever, 1, 1, size, c(90 - angle, angle))
  }
  force_n <- check_point(force_n, "force_n", "N", call)
  check_dimensions(list(force_n = force_n, at_m = at_m), call)
  new_forces(name, rbind(at_m), rbind(force_n), 0 * moment_of(at_m))
}

#' @rdname forces
#' @export
load_weight <- function(mass_kg, at_m, ..., gravity_m_per_s2 = 9.80665, name = "weight") {
  call <- check_no_dots(...)
  check_supplied(c("mass_kg", "at_m"), call)
  mass <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  g <- check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call, lower = 0)
  name <- check_name(name, "name", call)
  at_m <- check_point(at_m, "at_m", "m", call)
  if (!is.finite(mass * g)) abort_beyond("The weight", call)
  new_forces(name, rbind(at_m), rbind(mass * g * down_of(at_m)), 0 * moment_of(at_m))
}

#' @rdname forces
#' @export
load_couple <- function(torque_n_m, at_m = NULL, ..., name = "couple") {
  call <- check_no_dots(...)
  check_supplied("torque_n_m", call)
  name <- check_name(name, "name", call)
  torque_n_m <- check_finite(torque_n_m, "torque_n_m", "N*m", call)
  if (!length(torque_n_m) %in% c(1L, 3L)) {
    abort_rotdyn(c(
      "{.arg torque_n_m} must be one number, or three in space.",
      x = "It has {length(torque_n_m)}."
    ), "size", call)
  }
  at_m <- at_m %||% if (length(torque_n_m) == 1L) c(0, 0) else c(0, 0, 0)
  at_m <- check_point(at_m, "at_m", "m", call)
  if (length(torque_n_m) != length(moment_of(at_m))) {
    abort_rotdyn(c(
      "A couple at a point of {length(at_m)} numbers needs {length(moment_of(at_m))}.",
      x = "{.arg torque_n_m} has {length(torque_n_m)}."
    ), "size", call)
  }
  new_forces(name, rbind(at_m), rbind(0 * at_m), rbind(torque_n_m))
}

#' @rdname forces
#' @export
load_line <- function(down_n_per_m, from_m, to_m, ..., name = "line load") {
  call <- check_no_dots(...)
  check_supplied(c("down_n_per_m", "from_m", "to_m"), call)
  name <- check_name(name, "name", call)
  ends <- check_finite(down_n_per_m, "down_n_per_m", "N/m", call)
  if (!length(ends) %in% 1:2) {
    abort_rotdyn(c(
      "{.arg down_n_per_m} must be one number, or two for the ends.", x = "It has {length(ends)}."
    ), "size", call)
  }
  from_m <- check_point(from_m, "from_m", "m", call)
  to_m <- check_point(to_m, "to_m", "m", call)
  check_dimensions(list(from_m = from_m, to_m = to_m), call)
  along <- to_m - from_m
  size <- max(abs(along))
  length_m <- if (size > 0) size * sqrt(sum((along / size)^2)) else 0
  # A triangle acts at a third of its length.
  at <- if (length(ends) == 1L) rbind(from_m + along / 2) else
    rbind(from_m + along / 3, to_m - along / 3)
  force <- (ends * length_m / length(ends)) %o% down_of(from_m)
  if (!all(is.finite(force), is.finite(at))) abort_beyond("The load", call)
  some <- ends != 0 | length(ends) == 1L
  at <- at[some, , drop = FALSE]
  couple <- matrix(0, nrow(at), length(moment_of(from_m)))
  out <- new_forces(rep(name, nrow(at)), at, force[some, , drop = FALSE], couple)
  # For drawings: where the load lies.
  attr(out, "lines") <- list(list(
    rows = seq_len(nrow(at)), from_m = from_m, to_m = to_m, down_n_per_m = rep_len(ends, 2L)
  ))
  out
}

#' @rdname forces
#' @export
force_torques <- function(loads, about_m = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("loads", call)
  loads <- as_forces(loads, "loads", call)
  about <- check_about(about_m, loads, call)
  s <- system_of(loads)
  rows <- lapply(seq_len(nrow(loads)), function(i) {
    .Call(ffi_statics_sums, s$at[, i], s$force[, i], s$couple[, i], about)$torque
  })
  arms <- vapply(seq_len(nrow(loads)), function(i) {
    f <- s$force[, i]
    if (all(f == 0)) return(NA_real_)
    sums <- .Call(ffi_statics_sums, s$at[, i], f, c(0, 0, 0), about)
    length_of(sums$point - about)
  }, 0)
  torque <- matrix(as.double(unlist(rows)), 3L)
  warn_beyond(list(torque_about_n_m = as.double(torque)), list(), length(torque), call)
  columns <- if (is_plane(loads)) list(torque_about_n_m = torque[3, ]) else list(
    torque_about_x_n_m = torque[1, ], torque_about_y_n_m = torque[2, ],
    torque_about_z_n_m = torque[3, ]
  )
  new_table(c(unclass_columns(loads), columns, list(lever_arm_m = arms)),
                     nrow = nrow(loads))
}

#' @rdname forces
#' @export
resultant <- function(loads, about_m = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("loads", call)
  loads <- as_forces(loads, "loads", call)
  about <- check_about(about_m, loads, call)
  s <- system_of(loads)
  sums <- .Call(ffi_statics_sums, as.double(s$at), as.double(s$force), as.double(s$couple), about)
  n <- sums$axis
  plane <- is_plane(loads)
  axis <- if (n[1] %in% c(1, 3)) sums$point else rep(NA_real_, 3L)
  out <- list(kind = c("none", "force", "couple", "wrench")[n[1] + 1])
  out[force_columns(plane)] <- sums$force[seq_len(3L - plane)]
  out$force_n <- length_of(sums$force)
  out[couple_columns(plane)] <- if (plane) sums$torque[3] else sums$torque
  out[c("axis_x_m", "axis_y_m", if (!plane) "axis_z_m")] <- axis[seq_len(3L - plane)]
  out$couple_n_m <- if (plane && n[1] == 2) sums$torque[3] else n[2]
  if (!plane) out$pitch_m <- n[3]
  out$force_error_n <- 2^-53 * n[4] * 2
  out$torque_error_n_m <- 2^-53 * n[5] * 4
  numbers <- out[vapply(out, is.numeric, NA)]
  warn_beyond(numbers, list(), 1L, call)
  new_table(out, nrow = 1L)
}

# ---- the table ----------------------------------------------------------------------------------

point_axes <- function(plane) c("x_m", "y_m", if (!plane) "z_m")
force_columns <- function(plane) c("fx_n", "fy_n", if (!plane) "fz_n")
couple_columns <- function(plane) {
  if (plane) "torque_n_m" else c("torque_x_n_m", "torque_y_n_m", "torque_z_n_m")
}

normal_columns <- function(plane) c("normal_x", "normal_y", if (!plane) "normal_z")

is_plane <- function(loads) !"z_m" %in% names(loads)

# Down in a plane or in space; a couple at such a point.
down_of <- function(at) c(rep(0, length(at) - 1L), -1)
moment_of <- function(at) if (length(at) == 2L) 0 else c(0, 0, 0)

length_of <- function(x) {
  size <- max(abs(x), 0)
  if (is.finite(size) && size > 0) size * sqrt(sum((x / size)^2)) else size
}

unclass_columns <- function(table) as.list(table)[names(table)]

new_forces <- function(name, at, force, couple) {
  plane <- ncol(at) == 2L
  couple <- matrix(couple, nrow(at))
  columns <- c(
    list(name), lapply(seq_len(ncol(at)), function(j) unname(at[, j])),
    lapply(seq_len(ncol(force)), function(j) unname(force[, j])),
    lapply(seq_len(ncol(couple)), function(j) unname(couple[, j]))
  )
  if (!nrow(at)) columns <- c(list(character()), rep(list(double()), if (plane) 5L else 9L))
  names(columns) <- c("load", point_axes(plane), force_columns(plane), couple_columns(plane))
  new_table(columns, nrow = nrow(at))
}

# A list of tables of forces.
collect_forces <- function(x, name, call) {
  if (is.data.frame(x)) {
    table <- read_forces(x, call)
    if (!is.null(name)) table$load <- rep(name, nrow(table))
    return(list(table))
  }
  if (is.list(x) && !is.object(x)) {
    named <- rlang::names2(x)
    parts <- lapply(seq_along(x), function(i) {
      collect_forces(x[[i]], if (nzchar(named[i])) named[i] else name, call)
    })
    return(unlist(parts, recursive = FALSE))
  }
  abort_rotdyn(c(
    "Loads must be tables of forces.",
    x = "One is {describe_value(x)}.",
    i = "{.fn load_force}, {.fn load_weight}, {.fn load_couple} and {.fn load_line} make them."
  ), "type", call)
}

read_forces <- function(x, call) {
  space <- c("z_m", "fz_n", "torque_x_n_m", "torque_y_n_m", "torque_z_n_m")
  plane <- !any(space %in% names(x))
  needed <- c(point_axes(plane), force_columns(plane))
  for (column in needed) if (!column %in% names(x)) abort_missing_column(column, x, call)
  all <- c(needed, couple_columns(plane))
  units <- ifelse(startsWith(all, "torque"), "N*m", ifelse(startsWith(all, "f"), "N", "m"))
  columns <- lapply(seq_along(all), function(i) {
    if (!all[i] %in% names(x)) return(rep(0, nrow(x)))
    value <- check_finite(x[[all[i]]], all[i], units[i], call)
    if (length(value) != nrow(x)) {
      abort_rotdyn("The column {.field {all[i]}} must have a number in each row.", "size", call)
    }
    value
  })
  names(columns) <- all
  name <- if ("load" %in% names(x)) x[["load"]] else rep("force", nrow(x))
  if (is.factor(name)) name <- as.character(name)
  if (!is.character(name) || length(name) != nrow(x) || anyNA(name)) {
    abort_rotdyn("The column {.field load} must be names.", "type", call)
  }
  out <- new_table(c(list(load = name), columns), nrow = nrow(x))
  attr(out, "lines") <- attr(x, "lines", exact = TRUE)
  out
}

bind_forces <- function(parts, call) {
  # A couple in a plane, and a table without rows, fit only their own kind, too.
  plane <- vapply(parts, is_plane, NA)
  if (any(plane) && !all(plane)) {
    abort_rotdyn(c(
      "Forces must all be in a plane, or all in space.",
      x = "Some points have two numbers and some have three.",
      i = "Give every point and vector three numbers."
    ), "size", call)
  }
  names <- names(parts[[1]])
  columns <- lapply(names, function(name) {
    unlist(lapply(parts, function(part) part[[name]]), use.names = FALSE)
  })
  names(columns) <- names
  out <- new_table(columns, nrow = length(columns[[1]]))
  before <- cumsum(c(0L, vapply(parts, nrow, 0L)))
  attr(out, "lines") <- unlist(lapply(seq_along(parts), function(k) {
    lapply(attr(parts[[k]], "lines", exact = TRUE), function(line) {
      line$rows <- line$rows + before[k]
      line
    })
  }), recursive = FALSE)
  out
}

# What forces() takes, as one table.
as_forces <- function(x, arg, call) {
  parts <- collect_forces(x, NULL, call)
  if (!length(parts)) {
    abort_rotdyn(
      c("{.arg {arg}} has no table of forces.", x = "It is {describe_value(x)}."), "size", call
    )
  }
  bind_forces(parts, call)
}

# 3 x n matrices; what a plane has not is 0.
system_of <- function(loads) {
  n <- nrow(loads)
  if (is_plane(loads)) {
    list(
      at = rbind(loads$x_m, loads$y_m, rep(0, n)), force = rbind(loads$fx_n, loads$fy_n, rep(0, n)),
      couple = rbind(rep(0, n), rep(0, n), loads$torque_n_m)
    )
  } else {
    list(
      at = rbind(loads$x_m, loads$y_m, loads$z_m),
      force = rbind(loads$fx_n, loads$fy_n, loads$fz_n),
      couple = rbind(loads$torque_x_n_m, loads$torque_y_n_m, loads$torque_z_n_m)
    )
  }
}

# ---- checks -------------------------------------------------------------------------------------

# Two or three finite numbers.
check_point <- function(x, arg, unit, call) {
  x <- check_finite(x, arg, unit, call)
  if (!length(x) %in% 2:3) {
    abort_rotdyn(c(
      "{.arg {arg}} must be two numbers in a plane, three in space.", x = "It has {length(x)}."
    ), "size", call)
  }
  x
}

check_dimensions <- function(points, call) {
  sizes <- lengths(points)
  if (length(unique(sizes)) > 1L) {
    abort_rotdyn(c(
      "{.arg {names(points)}} must both have two numbers, or both three.",
      x = "They have {sizes}."
    ), "size", call)
  }
}

check_about <- function(about_m, loads, call) {
  size <- if (is_plane(loads)) 2L else 3L
  if (is.null(about_m)) return(c(0, 0, 0))
  about_m <- check_point(about_m, "about_m", "m", call)
  if (length(about_m) != size) {
    abort_rotdyn(c(
      "{.arg about_m} must have {size} numbers, as the points of the forces.",
      x = "It has {length(about_m)}."
    ), "size", call)
  }
  c(about_m, 0)[1:3]
}

abort_beyond <- function(what, call) {
  abort_rotdyn("{what} exceeds double precision.", "range", call)
}
