# Arguments of motion_record() that are columns: what they give and the factor to SI.
record_arguments <- list(
  time_s = list("time_s", "s", 1, "time"),
  theta_rad = list("theta_rad", "rad", 1, "angle"),
  theta_deg = list("theta_rad", "degree", pi / 180, "angle"),
  theta_turns = list("theta_rad", "1", 2 * pi, "angle"),
  counts = list("theta_rad", "1", NA, "count"),
  omega_rad_per_s = list("omega_rad_per_s", "rad/s", 1, "rate"),
  omega_deg_per_s = list("omega_rad_per_s", "degree/s", pi / 180, "rate"),
  omega_rpm = list("omega_rad_per_s", "rpm", pi / 30, "rate"),
  pulses = list("pulses", "1", 1, "count"),
  x_m = list("x_m", "m", 1, "length"),
  y_m = list("y_m", "m", 1, "length")
)

#' A record of a measured rotation
#'
#' Samples of an angle, of an angular velocity, or the times of pulses, in SI units, with what was
#' read, changed and assumed. Every function that takes measurements takes a record.
#'
#' A column is given by its name in quotes, as a bare name, or as an expression of columns. An
#' object of the units package is converted, and so is a column whose heading has a unit, such as
#' `"Angle (deg)"` or `omega [rpm]`. Without any of these arguments, columns are recognised by their
#' headings; of an angle and a rate the angle is read, unless their names are those of a record.
#'
#' An **angle** whose values stay within one turn and jump by more than half a turn is wrapped. It
#' is unwrapped against the angle predicted from the last two samples (or from the rate, if it was
#' measured). More than half a turn between two samples cannot be resolved and is an error. In a
#' gap, where angles are missing, the turns are those of the rate, if it was measured there, else
#' those of the angle's mean rates before and after the gap, if these agree. A jump in a gap where
#' nothing resolves it stays and is said under `assumed`.
#'
#' **Positions** of a mark become an angle about a centre:
#' \deqn{\theta = \mathrm{atan2}(y - y_c, x - x_c)}{theta = atan2(y - yc, x - xc)}
#' with the centre given, tracked, or fitted as that of a circle (least squares of the distances).
#' `x_m` alone is a position along a line, for [fit_scene()] with a [scene_incline()].
#'
#' **Rates about three axes** need an `axis`: one by name, or `"principal"`, the direction of most
#' of the mean square rate, with the sign of its largest component positive. The latter is an error
#' if more than a tenth of the mean square is across that direction: the motion is no rotation about
#' a fixed axis. `"all"` keeps the three rates, as columns for [fit_scene()] with a [scene_free()];
#' other verbs take the rate about one axis.
#'
#' **Times** that go back begin a new segment. Equal times with different values are taken for a
#' pause and begin a new segment, too. Where they are more than 1 in 50 rows, the clock is coarse:
#' they become one row, the mean, after the angle is unwrapped row by row. Exact copies of a row,
#' rows without a time and rows without any value are dropped.
#'
#' The **resolution** of a column is the largest step of which all differences are multiples, where
#' there is one: a counter, an encoder, or few digits in a file.
#'
#' @param data A data frame with a row for each sample.
#' @param time_s Times in s: a column of `data`. Date-times become seconds since the first; so do
#'   stamps in another unit, in ms since 1970 for instance, where seconds would round their spacing.
#' @param theta_rad,theta_deg,theta_turns,counts Angle in rad, degrees, turns, or counts of an
#'   encoder with `counts_per_turn`.
#' @param omega_rad_per_s,omega_deg_per_s,omega_rpm Angular velocity in rad/s, degrees/s or rpm: one
#'   column, or the names of three.
#' @param pulses The running number of pulses at these times: a column, or one number, the pulses a
#'   turn, where each row is a pulse.
#' @param ... Not used: an unknown argument is an error.
#' @param x_m,y_m Position of a mark in m; `x_m` alone along a line.
#' @param centre_m Its centre of rotation: two numbers, two names of columns (tracked), or `"fit"`.
#' @param axis For rates about three axes: `"x"`, `"y"`, `"z"`, the name of a column,
#'   `"principal"`, or `"all"`.
#' @param counts_per_turn,pulses_per_turn Counts and pulses in a turn.
#' @param segment A column that numbers the runs of the record, or NULL.
#' @param floor TRUE where counts are rounded down: half a count is added.
#' @param source Where the data come from, for the print.
#' @return A tibble of class `rot_record` with the columns
#'   `r describe_columns(c("time_s", "theta_rad", "omega_rad_per_s", "omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s", "pulses", "x_m", "y_m", "segment"), c(time_s = "time of the sample", theta_rad = "angle, unwrapped", omega_rad_per_s = "angular velocity", x_m = "x of the mark", y_m = "y of the mark"))`
#'   (those that were measured; a missing value is NA). Its attribute `record` is a list: `source`,
#'   `columns` (the original headings and units), `resolution` (by column, NA where none was found),
#'   `dropped` (rows of `data` and why), `breaks` (where segments begin, and why), `assumed`,
#'   `pulses_per_turn`, `spacing_s` and, where they apply, `centre` and `axis`. dplyr's verbs on
#'   rows keep the class; without `time_s`, `segment` or any measured column it is a plain tibble.
#' @section Errors: `rotdyn_error_missing` (no times, no measured column), `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_size` (fewer than two rows), `rotdyn_error_unit`,
#'   `rotdyn_error_value` (infinite numbers, turns that are not resolved, rates about several axes).
#' @source For the circle: Taubin, IEEE Trans. Pattern Anal. Mach. Intell. 13, 1115 (1991), then
#'   Gauss-Newton steps.
#' @seealso [read_motion()] for files, [fit_swing()] for oscillations.
#' @concept measurement
#' @concept encoder
#' @concept gyroscope
#' @concept video
#' @examples
#' samples <- data.frame(t = seq(0, 2, by = 0.1), angle = 40 * seq(0, 2, by = 0.1)^2)
#' motion_record(samples, time_s = "t", theta_deg = "angle")
#'
#' # A hall sensor with four magnets: the time of each pulse.
#' motion_record(data.frame(t = cumsum(c(0, 0.11, 0.12, 0.14))), time_s = t, pulses = 4)
#'
#' # A mark on a filmed wheel, about a centre that is fitted.
#' film <- data.frame(t = 0:20 / 30, x = 0.2 * cos(0:20 / 4) + 0.1, y = 0.2 * sin(0:20 / 4))
#' motion_record(film, time_s = t, x_m = x, y_m = y)
#' @export
motion_record <- function(data, time_s = NULL, theta_rad = NULL, omega_rad_per_s = NULL,
                          pulses = NULL, ..., theta_deg = NULL, theta_turns = NULL, counts = NULL,
                          omega_deg_per_s = NULL, omega_rpm = NULL, x_m = NULL, y_m = NULL,
                          centre_m = "fit", axis = NULL, counts_per_turn = NULL,
                          pulses_per_turn = NULL, segment = NULL, floor = FALSE, source = NULL) {
  call <- check_no_dots(...)
  check_supplied("data", call)
  if (!is.data.frame(data)) {
    abort_rotdyn(
      c("{.arg data} must be a data frame.", x = "It is {describe_value(data)}."), "type", call
    )
  }
  check_headings(data, "data", call)
  given <- rlang::enquos(
    time_s = time_s, theta_rad = theta_rad, theta_deg = theta_deg, theta_turns = theta_turns,
    counts = counts, omega_rad_per_s = omega_rad_per_s, omega_deg_per_s = omega_deg_per_s,
    omega_rpm = omega_rpm, pulses = pulses, x_m = x_m, y_m = y_m, segment = segment
  )
  columns <- Map(record_argument, given, names(given), MoreArgs = list(data = data, call = call))
  columns <- columns[!vapply(columns, is.null, NA)]
  if (!length(setdiff(names(columns), "segment"))) {
    columns <- c(columns, recognise_columns(data, call))
  }
  if (!is.null(counts_per_turn)) {
    counts_per_turn <- check_number(
      counts_per_turn, "counts_per_turn", "1", call, lower = 0, open = TRUE
    )
  }
  if (!is.null(pulses_per_turn)) {
    pulses_per_turn <- check_number(
      pulses_per_turn, "pulses_per_turn", "1", call, lower = 0, open = TRUE
    )
  }
  check_flag(floor, "floor", call)
  if (!is.null(source)) check_name(source, "source", call)
  if (is.character(centre_m) && length(centre_m) == 2L) {
    centre_m <- cbind(
      record_argument(rlang::quo(!!centre_m[1]), "x_m", data, call)$value,
      record_argument(rlang::quo(!!centre_m[2]), "y_m", data, call)$value
    )
  }
  build_record(
    columns, nrow(data), call,
    counts_per_turn = counts_per_turn, pulses_per_turn = pulses_per_turn, axis = axis,
    centre_m = centre_m, floor = floor, source = source
  )
}

# A name for each column, in a known encoding.
check_headings <- function(data, arg, call) {
  headings <- names(data)
  if (length(headings) != length(data) || anyNA(headings)) {
    abort_rotdyn(c(
      "{.arg {arg}} must have a name for each of its columns.",
      x = if (is.null(headings)) "It has none." else "It has {sum(!is.na(headings))} for
        {length(data)} columns.",
      i = "Name them: {.code names({arg}) <- c(\"time_s\", \"theta_rad\")}."
    ), "missing", call)
  }
  if (!is_readable_text(headings)) abort_unreadable(headings, paste0("names(", arg, ")"), call)
}

# ---- arguments -----------------------------------------------------------------------------------

# The column that an argument names: its value, heading and the factor to SI; or NULL.
record_argument <- function(quo, arg, data, call) {
  if (rlang::quo_is_null(quo)) return(NULL)
  value <- tryCatch(rlang::eval_tidy(quo, data), error = function(e) {
    abort_rotdyn(c(
      "{.arg {arg}} is no column of {.arg data}.",
      x = "{.code {rlang::as_label(quo)}}: {conditionMessage(e)}",
      i = "The columns are {.field {names(data)}}."
    ), "argument", call)
  })
  heading <- rlang::as_label(quo)
  if (is.character(value) && !is.object(value) && length(value) <= 3L &&
    (length(value) != nrow(data) || all(value %in% names(data)))) {
    if (!is_readable_text(value)) abort_unreadable(value, arg, call)
    unknown <- setdiff(value, names(data))
    if (length(unknown)) {
      near <- near_names(unknown, names(data))
      abort_rotdyn(c(
        "{.arg {arg}} must name a column of {.arg data}.",
        x = "There is no column {.val {unknown}}.",
        i = if (length(near)) "Did you mean {.val {near}}?",
        i = "The columns are {.field {names(data)}}."
      ), "argument", call)
    }
    heading <- value
    value <- if (length(value) == 1L) data[[value]] else data[value]
  } else if (rlang::quo_is_symbol(quo)) {
    heading <- rlang::as_string(rlang::quo_get_expr(quo))
  }
  if (arg == "segment") return(list(value = value, heading = heading, arg = arg))
  as_record_column(value, heading, arg, nrow(data), call)
}

as_record_column <- function(value, heading, arg, n, call) {
  role <- record_arguments[[arg]]
  if (is.data.frame(value) || is.matrix(value)) {
    value <- as.list(as.data.frame(value))
    if (!length(value)) {
      abort_rotdyn(c(
        "{.arg {arg}} must have a number for each row of {.arg data}.",
        x = "It is a table without columns."
      ), "size", call)
    }
    if (length(value) == 1L) return(as_record_column(value[[1]], heading, arg, n, call))
    # Rates about three axes.
    if (role[[4]] != "rate") {
      abort_rotdyn(c(
        "{.arg {arg}} must be one column.",
        x = "It is a table of {length(value)} columns: {.field {names(value)}}."
      ), "size", call)
    }
    parts <- Map(as_record_column, value, names(value), arg, n, list(call))
    return(list(
      value = vapply(parts, function(p) as.double(p$value), numeric(n)), heading = names(value),
      arg = arg, unit = parts[[1]]$unit, said = parts[[1]]$said
    ))
  }
  unit <- NULL
  if (is_date_time(value) && arg == "time_s") {
    value <- seconds_since_first(value)
    unit <- "date-time"
  } else if (is.character(value) || is.factor(value)) {
    bad <- which(!is.na(value))[1]
    abort_rotdyn(c(
      "{.arg {arg}} must be numbers.",
      x = "Column {.field {heading}} is text; its first value is
           {.val {as.character(value)[bad]}}.",
      i = "Read the file with the right decimal mark, for instance by {.fn read_motion}."
    ), "type", call)
  } else if (inherits(value, "units") && arg %in% c("theta_turns", "counts", "pulses")) {
    value <- as_si(value, "1", arg, call)
  } else if (is.object(value)) {
    if (inherits(value, "units")) unit <- units::deparse_unit(value)
    value <- check_column(value, arg, role[[2]], call)
  }
  value <- check_column(value, arg, role[[2]], call)
  if (length(value) != n && !(arg == "pulses" && length(value) == 1L)) {
    abort_rotdyn(c(
      "{.arg {arg}} must have a number for each of the {n} row{?s} of {.arg data}.",
      x = "It has {length(value)}."
    ), "size", call)
  }
  factor <- role[[3]]
  heads <- heading_table(heading)
  said <- NULL
  if (is.null(unit) && !is.na(heads$factor) && heads$kind == role[[4]] && nzchar(heads$name) &&
    heads$factor != factor) {
    if (!endsWith(arg, "_rad") && !endsWith(arg, "_s") && !endsWith(arg, "_m")) {
      abort_rotdyn(c(
        "{.arg {arg}} contradicts the heading of its column.",
        x = "Column {.field {heading}} is in {heads$unit}."
      ), "unit", call)
    }
    factor <- heads$factor
    said <- heads$unit
    if (arg == "time_s" && is_rounded_by(value, factor)) {
      value <- value - value[is.finite(value)][1]
      said <- paste(said, "since the first")
    }
  } else if (is.null(unit) && !is.na(heads$factor) && nzchar(heads$name) &&
    !heads$kind %in% c(role[[4]], "other") && role[[4]] != "count") {
    abort_rotdyn(c(
      "{.arg {arg}} must be a quantity in {plain_unit(role[[2]])}.",
      x = "Column {.field {heading}} is in {heads$unit}."
    ), "unit", call)
  }
  list(
    value = if (is.na(factor)) value else value * factor, heading = heading, arg = arg,
    unit = unit %||% said %||% role[[2]], said = said
  )
}

# Whether times, as stamps since 1970 are, lose a millionth of their spacing by another unit.
is_rounded_by <- function(times, factor) {
  times <- times[is.finite(times)] * factor
  .Machine$double.eps * max(abs(times), 0) > 1e-6 * stats::median(abs(diff(times)))
}

# Columns by their headings, for a table without arguments.
recognise_columns <- function(data, call) {
  exact <- intersect(names(record_arguments), names(data))
  twice <- intersect(exact, names(data)[duplicated(names(data))])
  if (length(twice)) {
    abort_rotdyn(c(
      "The heading of a column must be that of no other.",
      x = "{.arg data} has {sum(names(data) == twice[1])} columns {.field {twice[1]}}.",
      i = "{.code names(data) <- make.unique(names(data))} tells them from each other."
    ), "value", call)
  }
  if ("time_s" %in% exact && length(exact) > 1L) {
    columns <- lapply(exact, function(arg) {
      as_record_column(data[[arg]], arg, arg, nrow(data), call)
    })
    names(columns) <- exact
    if (!is.null(data[["segment"]])) {
      columns$segment <- list(value = data$segment, heading = "segment", arg = "segment")
    }
    return(columns)
  }
  heads <- heading_table(names(data))
  numbers <- vapply(data, function(x) is_number(unclass(x)) || is_date_time(x), NA)
  pick <- function(kind) which(numbers & heads$kind %in% kind)
  time <- pick("time")
  if (!length(time)) {
    abort_rotdyn(c(
      "{.arg time_s} is missing: no heading says that its column is a time.",
      i = if (length(data)) "The columns are {.field {names(data)}}." else "There are no columns.",
      i = "Name it: {.code motion_record(data, time_s = ...)}."
    ), "missing", call)
  }
  take <- function(at, arg) as_record_column(data[[at]], names(data)[at], arg, nrow(data), call)
  columns <- list(time_s = take(time[1], "time_s"))
  angle <- pick("angle")
  rate <- setdiff(pick("rate"), which(heads$component %in% "absolute"))
  several <- c(if (length(angle) > 1L) names(data)[angle], if (length(rate) > 3L) names(data)[rate])
  if (length(several)) {
    abort_rotdyn(c(
      "{.arg data} has several columns of the same kind: {.field {several}}.",
      i = "Name the one: {.code motion_record(data, time_s = ..., theta_rad = ...)}."
    ), "missing", call)
  }
  # A rate beside an angle was computed from it, as a rule: it is read where it is named.
  if (length(angle)) {
    columns$theta_rad <- take(angle, "theta_rad")
    rate <- integer()
  }
  if (length(rate) == 1L) columns$omega_rad_per_s <- take(rate, "omega_rad_per_s")
  if (length(rate) > 1L) {
    columns$omega_rad_per_s <-
      as_record_column(data[rate], names(data)[rate], "omega_rad_per_s", nrow(data), call)
  }
  if (!length(angle) && !length(rate)) {
    x <- which(numbers & heads$kind %in% "length" & heads$component %in% "x")
    y <- which(numbers & heads$kind %in% "length" & heads$component %in% "y")
    if (length(x) == 1L && length(y) < 2L) {
      columns$x_m <- take(x, "x_m")
      if (length(y)) columns$y_m <- take(y, "y_m")
    }
  }
  columns
}

# ---- the record ----------------------------------------------------------------------------------

# From columns in SI (as record_argument() returns them) to the record. `why_breaks`: reasons by row
# that a reader knows, such as a pause; `notes`: what a reader assumed.
build_record <- function(columns, n, call, counts_per_turn = NULL, pulses_per_turn = NULL,
                         axis = NULL, centre_m = "fit", floor = FALSE, source = NULL,
                         notes = character(), breaks = NULL, dropped = NULL, marks = "angle") {
  if (is.null(columns$time_s) && n > 0L) {
    abort_rotdyn(c(
      "{.arg time_s} is missing: a record needs the times of its samples.",
      i = "For a fixed rate: {.code time_s = (seq_len(nrow(data)) - 1) / rate_hz}."
    ), "missing", call)
  }
  assumed <- notes
  kind <- vapply(columns, function(x) x$arg, "")
  target <- vapply(kind, function(arg) {
    if (arg == "segment") "segment" else record_arguments[[arg]][[1]]
  }, "")
  twice <- unique(target[duplicated(target)])
  if (length(twice)) {
    abort_rotdyn(c(
      "{.arg {kind[target %in% twice]}} are the same quantity: give one of them."
    ), "argument", call)
  }
  names(columns) <- target
  if (identical(axis, "all")) columns <- with_all_rates(columns, call)
  measured <- intersect(record_measured, names(columns))
  if ("y_m" %in% measured && !"x_m" %in% measured) {
    abort_rotdyn(c(
      "A mark needs both {.arg x_m} and {.arg y_m}.",
      i = "A position along a line is {.arg x_m}."
    ), "missing", call)
  }
  if (!length(measured)) {
    abort_rotdyn(c(
      "A record needs a measured column.",
      i = "Give {.arg theta_rad}, {.arg omega_rad_per_s} or {.arg pulses}, or {.arg x_m} and
           {.arg y_m} of a mark."
    ), "missing", call)
  }
  for (arg in names(columns)[names(columns) != "segment"]) {
    at <- which(is.infinite(columns[[arg]]$value))[1]
    if (!is.na(at)) {
      abort_rotdyn(c(
        "{.arg {columns[[arg]]$arg}} must be finite or missing.",
        x = "Row {(at - 1) %% n + 1} is infinite."
      ), "value", call)
    }
  }
  axis_found <- NULL
  if (!is.null(columns$omega_rad_per_s)) {
    chosen <- choose_axis(columns$omega_rad_per_s, axis, call)
    columns$omega_rad_per_s$value <- chosen$omega
    axis_found <- chosen$axis
  }
  if ("counts" %in% kind) {
    if (is.null(counts_per_turn)) {
      abort_rotdyn(c(
        "{.arg counts_per_turn} is missing: counts are no angle without it.",
        i = "An encoder of 600 lines, read at each edge, has 2400."
      ), "missing", call)
    }
    value <- columns$theta_rad$value + if (floor) 0.5 else 0
    columns$theta_rad$value <- value * (2 * pi / counts_per_turn)
    columns$theta_rad$unit <- paste0("counts, ", format(counts_per_turn), " per turn")
  }
  if (!is.null(columns$pulses)) {
    p <- columns$pulses$value
    if (length(p) == 1L && n > 1L) {
      if (!is.finite(p) || p <= 0) abort_domain(p, "pulses", "1", call, 0, Inf, TRUE)
      if (is.null(pulses_per_turn)) pulses_per_turn <- p
      p <- seq_len(n) - 1
      assumed <- c(assumed, "each row is a pulse")
    } else if (is.null(pulses_per_turn)) {
      pulses_per_turn <- 1
      assumed <- c(assumed, "one pulse per turn")
    }
    columns$pulses$value <- p
  }
  out <- lapply(columns[c("time_s", measured)], function(x) as.double(x$value))
  group <- if (is.null(columns$segment)) rep(1L, n) else {
    value <- columns$segment$value
    if (length(value) != n) {
      abort_rotdyn("{.arg segment} must have a value for each row of {.arg data}.", "size", call)
    }
    match(value, unique(value))
  }
  rows <- record_rows(out, group, breaks, dropped)
  if (length(rows$keep) < 2L) {
    abort_rotdyn(c(
      "A record needs at least two samples.",
      x = "{n} row{?s} {?is/are} given, {length(rows$keep)} {?has/have} a time and a value."
    ), "size", call)
  }
  # Row by row until the angle is unwrapped: a mean of wrapped angles is no angle.
  out <- rows$columns
  assumed <- c(assumed, rows$assumed)
  segment <- rows$segment[rows$sample]
  turned <- NULL
  if (!is.null(out$theta_rad)) {
    turned <- unwrap_record(out, segment, call)
  } else if (all(c("x_m", "y_m") %in% measured)) {
    turned <- angle_of_mark(out, segment, centre_m, rows$row, marks, call)
  }
  out$theta_rad <- turned$theta
  centre <- turned$centre
  assumed <- c(assumed, turned$assumed)
  out <- lapply(out, mean_of_samples, sample = rows$sample)
  out$time_s <- rows$time
  segment <- rows$segment
  resolution <- vapply(out[measured], find_resolution, 0, segment = segment)
  if ("counts" %in% kind) resolution[["theta_rad"]] <- 2 * pi / counts_per_turn
  spacing <- diff(out$time_s)[diff(segment) == 0]
  info <- list(
    source = source %||% "a data frame",
    columns = record_headings(columns),
    resolution = resolution,
    rows_read = n,
    dropped = rows$dropped,
    breaks = rows$breaks,
    assumed = unique(assumed),
    spacing_s = if (length(spacing)) stats::median(spacing) else NA_real_,
    pulses_per_turn = pulses_per_turn,
    centre = centre,
    axis = axis_found
  )
  out <- out[intersect(c("time_s", record_measured), names(out))]
  out$segment <- segment
  new_table(out, nrow = length(segment), class = "rot_record", record = info)
}

record_headings <- function(columns) {
  columns <- columns[names(columns) != "segment"]
  as_table(
    column = rep(names(columns), vapply(columns, function(x) length(x$heading), 0L)),
    heading = unlist(lapply(columns, `[[`, "heading"), use.names = FALSE),
    unit = rep(
      vapply(columns, function(x) x$unit, ""), vapply(columns, function(x) length(x$heading), 0L)
    )
  )
}

# Rows that stay, segments and why: see the help. `row`: rows with a time and a value, with their
# `columns`; `sample`: the sample of each. `keep`: the first row of each sample, with its `time` and
# `segment`.
record_rows <- function(columns, group, breaks, dropped) {
  n <- length(columns$time_s)
  why <- rep(NA_character_, n)
  why[dropped$row] <- dropped$why
  values <- columns[names(columns) != "time_s"]
  why[is.na(why) & is.na(columns$time_s)] <- "no time"
  empty <- Reduce(`&`, lapply(values, is.na))
  why[is.na(why) & empty] <- "no value"
  keep <- which(is.na(why))
  keep <- keep[order(group[keep])]
  time <- columns$time_s[keep]
  same_group <- diff(group[keep]) == 0
  equal <- which(diff(time) == 0 & same_group)
  rows_per_time <- equal[Reduce(`&`, lapply(values, function(x) {
    a <- x[keep][equal]
    b <- x[keep][equal + 1L]
    (is.na(a) & is.na(b)) | (!is.na(a) & !is.na(b) & a == b)
  }), init = rep(TRUE, length(equal)))]
  assumed <- character()
  if (length(rows_per_time)) {
    why[keep[rows_per_time + 1L]] <- "copy of the row before"
    keep <- keep[-(rows_per_time + 1L)]
    time <- columns$time_s[keep]
    equal <- which(diff(time) == 0 & diff(group[keep]) == 0)
  }
  columns <- lapply(columns, `[`, keep)
  row <- keep
  sample <- seq_along(keep)
  if (length(equal) > length(keep) / 50) {
    # A clock that is coarser than the sampling.
    again <- c(FALSE, diff(time) == 0 & diff(group[keep]) == 0)
    sample <- cumsum(!again)
    columns$time_s <- spread_times(time, sample, group[keep])
    why[keep[again]] <- "same time as the row before: the mean is kept"
    keep <- keep[!again]
    time <- time[!again]
    assumed <- "equal times are one sample each: their mean"
  }
  m <- length(time)
  starts <- rep(NA_character_, m)
  if (m > 1L) {
    starts[which(diff(group[keep]) != 0) + 1L] <- "another run"
    starts[which(diff(time) < 0 & is.na(starts[-1])) + 1L] <- "the time goes back"
    starts[which(diff(time) == 0 & is.na(starts[-1])) + 1L] <- "two values at one time: a pause"
  }
  for (k in seq_len(NROW(breaks))) {
    # The first row kept from the row of a break on.
    at <- which(keep >= breaks$row[k])[1]
    if (!is.na(at) && at > 1L) starts[at] <- breaks$why[k]
  }
  segment <- 1L + cumsum(!is.na(starts))
  gone <- which(!is.na(why))
  new <- which(!is.na(starts))
  list(
    keep = keep, time = time, segment = segment, row = row, columns = columns, sample = sample,
    assumed = assumed,
    dropped = as_table(row = gone, why = why[gone]),
    breaks = as_table(segment = segment[new], time_s = time[new], why = starts[new])
  )
}

# Times of the rows of a coarse clock: those of a sample are evenly spaced up to the next sample; in
# the last sample of a run, as in the sample before.
spread_times <- function(time, sample, group) {
  size <- tabulate(sample)
  first <- !duplicated(sample)
  h <- c(diff(time[first]), NA) / size
  h[c(diff(group[first]) != 0, TRUE) | !(h > 0)] <- NA
  last <- which(is.na(h))
  before <- pmax(last - 1L, 1L)
  h[last] <- ifelse(group[first][before] == group[first][last], h[before], NA)
  h[is.na(h)] <- 0
  time + (sequence(size) - 1) * h[sample]
}

# NA where a sample has no value in this column.
mean_of_samples <- function(x, sample) {
  if (is.null(x) || !anyDuplicated(sample)) return(x)
  mean <- as.double(tapply(x, sample, mean, na.rm = TRUE))
  replace(mean, is.nan(mean), NA_real_)
}

# The rate about the axis asked for, of one column or of three.
choose_axis <- function(column, axis, call) {
  omega <- column$value
  if (!is.matrix(omega)) return(list(omega = omega))
  headings <- column$heading
  if (is.null(axis)) {
    abort_rotdyn(c(
      "{.arg axis} is missing: rates about {ncol(omega)} axes were measured.",
      i = "Give {.val x}, {.val y}, {.val z}, the name of a column, {.val principal}, or {.val all}
           for all of them.",
      x = "Their root mean squares are {format(sqrt(colMeans(omega^2, na.rm = TRUE)), digits = 3)}
           rad/s."
    ), "missing", call)
  }
  if (!is.character(axis) || length(axis) != 1L || is.na(axis)) {
    abort_rotdyn(c(
      "{.arg axis} must be one piece of text.", x = "It is {describe_value(axis)}."
    ), "type", call)
  }
  part <- axes_of_headings(headings)
  square <- crossprod(omega[stats::complete.cases(omega), , drop = FALSE])
  total <- sum(diag(square))
  if (axis == "principal") {
    direction <- principal_rate(square)
  } else {
    at <- match(axis, headings)
    if (is.na(at)) at <- match(lower_case(axis), part)
    if (is.na(at)) {
      abort_rotdyn(c(
        "{.arg axis} must be one of {.or {.val {c(part, headings, 'principal', 'all')}}}.",
        x = "It is {.val {axis}}."
      ), "value", call)
    }
    direction <- as.double(seq_along(headings) == at)
  }
  across <- part_across(square, direction)
  if (across > across_limit && axis == "principal") {
    abort_rotdyn(c(
      "The motion is no rotation about one axis.",
      x = "{format(100 * across, digits = 2)} % of the mean square rate is across the principal
           axis.",
      i = "Mean squares by column: {format(100 * diag(square) / total, digits = 2)} %.",
      i = "{.arg axis} takes one of the axes in spite of that: {.or {.val {part}}}; {.val all} keeps
           the rates about all."
    ), "value", call)
  }
  list(
    omega = drop(omega %*% direction),
    axis = list(
      name = axis, direction = stats::setNames(direction, part[seq_along(direction)]),
      across = across
    )
  )
}

# Of each column the axis that its heading names, else by their order.
axes_of_headings <- function(headings) {
  part <- heading_table(headings)$component
  part[is.na(part)] <- c("x", "y", "z")[seq_along(headings)][is.na(part)]
  part
}

# Beyond this part of the mean square the motion is no rotation about a fixed axis.
across_limit <- 0.1

# From the products of the rates: the direction of most of their mean square, and what part of it is
# across a direction.
principal_rate <- function(square) {
  if (!(sum(diag(square)) > 0)) return(c(1, rep(0, ncol(square) - 1L)))
  direction <- eigen(square, symmetric = TRUE)$vectors[, 1]
  direction * sign(direction[which.max(abs(direction))])
}

part_across <- function(square, direction) {
  total <- sum(diag(square))
  if (!(total > 0)) return(0)
  max(0, 1 - drop(crossprod(direction, square %*% direction)) / total)
}

# Three rates as columns of their own.
with_all_rates <- function(columns, call) {
  omega <- columns$omega_rad_per_s
  if (!is.matrix(omega$value)) {
    abort_rotdyn(c(
      "{.arg axis} is {.val all}, but rates about several axes were not measured.",
      i = "{.arg omega_rad_per_s} takes the names of three columns."
    ), "argument", call)
  }
  part <- axes_of_headings(omega$heading)
  if (anyDuplicated(part)) {
    abort_rotdyn(c(
      "{.arg omega_rad_per_s} must have one column for each axis.",
      x = "The columns {.field {omega$heading}} are about {.val {part}}."
    ), "argument", call)
  }
  each <- lapply(order(part), function(k) {
    replace(omega, c("value", "heading"), list(omega$value[, k], omega$heading[k]))
  })
  names(each) <- paste0("omega_", sort(part), "_rad_per_s")
  c(columns[names(columns) != "omega_rad_per_s"], each)
}

# ---- angles --------------------------------------------------------------------------------------

# Unwraps a theta within one turn; an angle that leaves one turn is a running angle already. Where
# no two neighbouring angles differ by more than half a turn, the wrap may still be in a gap.
unwrap_record <- function(columns, segment, call) {
  time <- columns$time_s
  theta <- columns$theta_rad
  omega <- columns$omega_rad_per_s
  range <- range(theta, na.rm = TRUE)
  within <- diff(range) <= 2 * pi * (1 + 1e-6) &&
    (range[1] >= -1e-6 || (range[1] >= -pi * (1 + 1e-6) && range[2] <= pi * (1 + 1e-6)))
  if (!within) return(list(theta = theta))
  runs <- known_runs(time, theta, segment, omega)
  jumps <- vapply(runs, function(run) {
    any(abs(diff(run$x)) > pi & !(run$long & run$hidden)[-1])
  }, NA)
  said <- "the angle is wrapped to one turn: unwrapped"
  if (any(jumps)) {
    turned <- unwrap_angle(time, theta, segment, omega, call, runs)
    return(list(theta = turned$theta, assumed = c(said, turned$doubt)))
  }
  turned <- 0L
  unknown <- 0L
  for (run in runs) {
    turns <- double(length(run$x))
    for (i in which(run$long)[-1]) {
      turns[i] <- turns_in_gap(run, i, run$x)
      if (is.na(turns[i])) {
        unknown <- unknown + (abs(run$x[i] - run$x[i - 1L]) > pi)
        turns[i] <- 0
      }
    }
    turned <- turned + sum(turns != 0)
    theta[run$rows] <- run$x + 2 * pi * cumsum(turns)
  }
  list(theta = theta, assumed = c(if (turned) said, if (unknown) {
    paste(
      "in", unknown, ngettext(unknown, "gap", "gaps"), "the angle changes by more than half a",
      "turn: its turns there are undetermined, none are added"
    )
  }))
}

# Of each segment the rows with an angle: `rows`, their times `t` and angles `x`; for the step to
# each row from the one before: `long`, much longer than their median; `hidden`, there are rows
# without an angle between; `advance`, the integral of the measured rate, NA: not measured at its
# ends; `measured`: the rate is measured all along the step. `long` is TRUE at the first row.
# `from`, `to`: the rows from which and up to which a time as long as the step lies before and after
# it.
known_runs <- function(time, theta, segment, omega) {
  known <- which(!is.na(theta))
  runs <- split(known, segment[known])
  lapply(unname(runs), function(rows) {
    t <- time[rows]
    h <- c(NA, diff(t))
    long <- c(TRUE, h[-1] > 1.5 * stats::median(h[-1]))
    rate <- list(advance = rep(NA_real_, length(t)), measured = rep(FALSE, length(t)))
    if (!is.null(omega)) {
      at <- which(segment == segment[rows[1]] & is.finite(omega))
      rate <- integrate_rate(time[at], omega[at], t)
    }
    before <- c(t[1], t[-length(t)])
    h[1] <- 0
    list(
      rows = rows, t = t, x = theta[rows], from = findInterval(before - h * (1 + 1e-9), t) + 1L,
      to = findInterval(t + h * (1 + 1e-9), t), long = long, hidden = c(FALSE, diff(rows) > 1L),
      advance = rate$advance, measured = rate$measured
    )
  })
}

# By trapezoids between the times t, from a rate at times `time`.
integrate_rate <- function(time, rate, t) {
  none <- list(advance = rep(NA_real_, length(t)), measured = rep(FALSE, length(t)))
  if (length(time) < 2L) return(none)
  at <- findInterval(t, time, rightmost.closed = TRUE)
  inside <- at >= 1L & at < length(time)
  at <- pmin(pmax(at, 1L), length(time) - 1L)
  h <- diff(time)
  slope <- ifelse(h > 0, diff(rate) / h, 0)
  past <- t - time[at]
  whole <- c(0, cumsum(h * (rate[-1] + rate[-length(rate)]) / 2))
  angle <- ifelse(inside, whole[at] + past * (rate[at] + slope[at] * past / 2), NA)
  # Holes in the rate up to the end of each step.
  hole <- cumsum(h > 1.5 * stats::median(h))
  until <- hole[at]
  # A step that ends at a time of the rate does not reach into the interval after it.
  until <- until - ifelse(past == 0, c(0, hole)[at + 1L] - c(0, hole)[at], 0)
  list(
    advance = c(NA, diff(angle)),
    measured = c(FALSE, is.finite(diff(angle)) & until[-1] == c(0, hole)[at[-length(at)]])
  )
}

# Turns to add to the angle behind the gap before row i: by the measured rate where it is measured
# throughout the gap, else by the rates of the angle on both sides. NA: not resolved. `x`: the
# angle, unwrapped up to the gap.
turns_in_gap <- function(run, i, x) {
  step <- x[i] - x[i - 1L]
  if (run$measured[i]) {
    expected <- run$advance[i]
    limit <- pi / 2
  } else {
    h <- run$t[i] - run$t[i - 1L]
    before <- rates_beside(run, x, seq.int(i - 1L, min(run$from[i], i - 1L)), -1, h)
    after <- rates_beside(run, x, seq.int(i, run$to[i]), 1, h)
    if (is.null(before) || is.null(after)) return(NA_real_)
    expected <- h * c(before, after)
    limit <- pi / 3
  }
  turns <- -round((step - mean(expected)) / (2 * pi))
  if (all(abs(step + 2 * pi * turns - expected) < limit)) turns else NA_real_
}

# Mean rates of the angle on one side of a gap of length h: over a time as long as the gap and over
# its quarter next to the gap. They differ where the motion is not steady over such a time, as in a
# swing. `rows`: from the gap on, outward. NULL: less than half of that time is without another gap.
rates_beside <- function(run, x, rows, side, h) {
  gap <- if (side < 0) run$long[rows] else c(run$long[rows[-1]], FALSE)
  if (any(gap)) rows <- rows[seq_len(which(gap)[1])]
  past <- abs(run$t[rows] - run$t[rows[1]])
  last <- length(rows)
  if (last < 3L || past[last] < h / 2) return(NULL)
  change <- diff(x[rows])
  change <- side * cumsum(c(0, change - 2 * pi * round(change / (2 * pi))))
  quarter <- which(past >= past[last] / 4 & past > 0)[1]
  change[c(last, quarter)] / past[c(last, quarter)]
}

# Against the predicted angle theta + omega h, with the measured rate where there is one. A step
# beyond half a turn is only resolved by a measured rate, or in a gap by the rates on both sides.
# `doubt`: how often the angle is beyond a quarter turn of the predicted one, and turns in gaps.
unwrap_angle <- function(time, theta, segment, omega, call,
                         runs = known_runs(time, theta, segment, omega)) {
  turn <- 2 * pi
  doubtful <- 0L
  by_rate <- 0L
  by_angle <- 0L
  for (run in runs) {
    x <- run$x
    t <- run$t
    speed <- 0
    for (i in seq_along(x)[-1]) {
      h <- t[i] - t[i - 1L]
      seen <- is.finite(run$advance[i])
      turns <- if (run$long[i] && (run$measured[i] || !seen)) turns_in_gap(run, i, x) else NA_real_
      if (!is.na(turns)) {
        x[i] <- x[i] + turn * turns
        beyond <- abs(x[i] - x[i - 1L]) > pi
        if (run$measured[i]) by_rate <- by_rate + beyond else by_angle <- by_angle + beyond
      } else {
        expected <- x[i - 1L] + if (seen) run$advance[i] else speed * h
        x[i] <- x[i] - turn * round((x[i] - expected) / turn)
        if (i > 2L || seen) doubtful <- doubtful + (abs(x[i] - expected) > pi / 2)
        if (!seen && abs(x[i] - x[i - 1L]) > pi) abort_aliased(t[i], call)
      }
      if (h > 0) speed <- (if (seen) run$advance[i] else x[i] - x[i - 1L]) / h
    }
    theta[run$rows] <- x
  }
  list(theta = theta, doubt = c(
    if (by_rate) {
      paste(
        "turns in", by_rate, ngettext(by_rate, "gap", "gaps"), "of the angle are those of the",
        "measured rate"
      )
    },
    if (by_angle) {
      paste(
        "turns in", by_angle, ngettext(by_angle, "gap", "gaps"), "of the angle are those of its",
        "rate before and after", ngettext(by_angle, "it", "them")
      )
    },
    if (doubtful) {
      paste(
        "in", doubtful, ngettext(doubtful, "step", "steps"), "the angle is more than a quarter",
        "turn from the predicted one: turns may be miscounted"
      )
    }
  ))
}

abort_aliased <- function(time, call) {
  abort_rotdyn(c(
    "The angle turns by more than half a turn between two samples.",
    x = "At {format(time)} s.",
    i = "Its sense and number of turns are not resolved: sample faster, or measure the rate, too."
  ), "value", call)
}

angle_of_mark <- function(columns, segment, centre_m, keep, marks, call) {
  x <- columns$x_m
  y <- columns$y_m
  if (identical(centre_m, "fit")) {
    fit <- fit_circle(x, y)
    loose <- is.null(fit) || fit$scatter_m > 0.05 * fit$radius_m || fit$arc_rad < 0.5
    if (loose) {
      if (marks == "keep") {
        return(list(assumed = "no angle: the marks are not on a circle about a fixed centre"))
      }
      abort_rotdyn(c(
        "The positions of the mark are not on a circle.",
        x = if (is.null(fit)) {
          "They are on a line, or fewer than four."
        } else if (fit$arc_rad < 0.5) {
          "They cover {format(fit$arc_rad, digits = 2)} rad of it: too little to fit its centre."
        } else {
          "Their distances from the best circle scatter by
           {format(fit$scatter_m, digits = 2)} m, its radius is
           {format(fit$radius_m, digits = 3)} m."
        },
        i = "Give {.arg centre_m}, or the rows of the rotation alone."
      ), "value", call)
    }
    centre <- fit[c("x_m", "y_m", "radius_m", "scatter_m", "u_m")]
    centre$kind <- "fitted"
    cx <- fit$x_m
    cy <- fit$y_m
  } else if (is.matrix(centre_m)) {
    cx <- centre_m[keep, 1]
    cy <- centre_m[keep, 2]
    centre <- list(kind = "tracked")
  } else {
    centre_m <- check_finite(centre_m, "centre_m", "m", call)
    if (length(centre_m) != 2L) {
      abort_rotdyn(c(
        "{.arg centre_m} must be two numbers, two names of columns, or {.val fit}.",
        x = "It is {describe_value(centre_m)}."
      ), "size", call)
    }
    cx <- centre_m[1]
    cy <- centre_m[2]
    centre <- list(kind = "given", x_m = cx, y_m = cy)
  }
  theta <- atan2(y - cy, x - cx)
  theta <- unwrap_angle(columns$time_s, theta, segment, columns$omega_rad_per_s, call)
  list(theta = theta$theta, centre = centre, assumed = theta$doubt)
}

# The circle of least squares: Taubin's algebraic fit, then Gauss-Newton on the distances.
fit_circle <- function(x, y) {
  known <- is.finite(x) & is.finite(y)
  x <- x[known]
  y <- y[known]
  n <- length(x)
  if (n < 4L) return(NULL)
  at <- c(mean(x), mean(y))
  size <- sqrt(mean((x - at[1])^2 + (y - at[2])^2))
  if (!(size > 0)) return(NULL)
  u <- (x - at[1]) / size
  v <- (y - at[2]) / size
  z <- u^2 + v^2
  zm <- mean(z)
  pencil <- svd(cbind((z - zm) / (2 * sqrt(zm)), u, v), nu = 0)$v[, 3]
  a <- pencil[1] / (2 * sqrt(zm))
  if (abs(a) < 1e-9) return(NULL)
  c0 <- -pencil[2:3] / (2 * a)
  p <- c(c0, sqrt(max(sum(c0^2) + zm, 1e-12)))
  for (round in 1:50) {
    d <- sqrt((u - p[1])^2 + (v - p[2])^2)
    if (any(d == 0)) return(NULL)
    r <- d - p[3]
    J <- cbind(-(u - p[1]) / d, -(v - p[2]) / d, -1)
    step <- tryCatch(qr.solve(J, -r), error = function(e) NULL)
    if (is.null(step) || !all(is.finite(step))) return(NULL)
    p <- p + step
    if (max(abs(step)) < 1e-13) break
  }
  if (!all(is.finite(p)) || p[3] <= 0) return(NULL)
  scatter <- sqrt(sum(r^2) / max(n - 3L, 1L))
  u_p <- scatter * sqrt(diag(chol2inv(qr.R(qr(J)))))
  angles <- sort(atan2(v - p[2], u - p[1]))
  gap <- max(diff(c(angles, angles[1] + 2 * pi)))
  list(
    x_m = at[1] + size * p[1], y_m = at[2] + size * p[2], radius_m = size * p[3],
    scatter_m = size * scatter, u_m = size * u_p, arc_rad = 2 * pi - gap
  )
}

# The step of which 99 % of the differences are multiples, or NA. A twentieth of the step is the
# tolerance, so that chance agrees in 10 %, and the rounding of numbers printed with few digits
# passes. Of a counter that moves by many counts between samples no difference is one count: there
# the differences of differences are.
find_resolution <- function(x, segment) {
  step <- abs(diff(x)[diff(segment) == 0])
  step <- step[is.finite(step)]
  rounding <- 16 * .Machine$double.eps * max(abs(x), na.rm = TRUE)
  step <- step[step > rounding]
  # A counter that is mostly at rest has few steps, all of them of its size, and repeats its count.
  rests <- sum(!is.na(x)) - 1L - length(step)
  if (length(step) > 0L && length(step) < 8L && rests >= 8L * length(step)) {
    counts <- step / min(step)
    return(if (all(abs(counts - round(counts)) < 0.05)) min(step) else NA_real_)
  }
  if (length(step) < 8L) return(NA_real_)
  gap <- diff(sort(step))
  gap <- gap[gap > 4 * rounding]
  for (parts in 1:6) {
    unit <- min(step) / parts
    if (unit < 4 * rounding) break
    found <- step_of_multiples(step, unit)
    if (is.na(found)) next
    if (length(unique(round(step / found))) > 1L) return(found)
    # Differences that are all alike may be those of a steady motion.
    if (parts == 1L && (rests > 0L || !length(gap))) return(found)
    break
  }
  if (!length(gap) || !is_limited_by(x, segment, min(gap))) return(NA_real_)
  step_of_multiples(step, min(gap))
}

# A unit of which 99 % of the steps are multiples, refined by them; or NA.
step_of_multiples <- function(step, unit) {
  turns <- step / unit
  fits <- abs(turns - round(turns)) < 0.05
  if (mean(fits) < 0.99) return(NA_real_)
  sum(step[fits] * round(turns[fits])) / sum(round(turns[fits])^2)
}

# Is the noise, by third differences (sqrt(20) times its s.d.), at most five times that of counts?
is_limited_by <- function(x, segment, unit) {
  third <- abs(diff(x, differences = 3)[diff(segment, 3) == 0])
  isTRUE(stats::median(third, na.rm = TRUE) < 0.6745 * 5 * sqrt(20 / 12) * unit)
}

# Squares, products and quotients of times and values must be numbers, too.
check_magnitudes <- function(time_s, value, call) {
  span <- diff(range(time_s))
  size <- max(abs(value - value[1]))
  if (length(value) < 2L || size == 0 || span == 0) return(invisible())
  magnitudes <- c(span, size, size / span)
  if (all(magnitudes > 1e-60 & magnitudes < 1e60)) return(invisible())
  abort_rotdyn(c(
    "The times or values of the record are too large or too small to be fitted.",
    x = "It lasts {format_si(span, 3)} s, its values differ by {format_si(size, 3)}.",
    i = "Check their units."
  ), "range", call)
}

# ---- the class -----------------------------------------------------------------------------------

record_measured <- c(
  "theta_rad", "omega_rad_per_s", "omega_x_rad_per_s", "omega_y_rad_per_s", "omega_z_rad_per_s",
  "pulses", "x_m", "y_m"
)

reconstruct_record <- function(data, template) {
  kept <- all(c("time_s", "segment") %in% names(data)) && any(record_measured %in% names(data)) &&
    all(vapply(
      unclass(data)[intersect(c("time_s", "segment", record_measured), names(data))], is_number, NA
    ))
  class <- c("tbl_df", "tbl", "data.frame")
  attr(data, "record") <- if (kept) attr(template, "record", exact = TRUE)
  class(data) <- if (kept) c("rot_record", class) else class
  data
}

#' @export
`[.rot_record` <- function(x, ...) {
  out <- NextMethod()
  if (is.data.frame(out)) reconstruct_record(out, x) else out
}

#' @export
`[<-.rot_record` <- function(x, ..., value) reconstruct_record(NextMethod(), x)

#' @export
`[[<-.rot_record` <- function(x, ..., value) reconstruct_record(NextMethod(), x)

#' @export
`$<-.rot_record` <- function(x, name, value) reconstruct_record(NextMethod(), x)

#' @export
`names<-.rot_record` <- function(x, value) reconstruct_record(NextMethod(), x)

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_record <- function(data, template) reconstruct_record(data, template)

#' @exportS3Method tibble::as_tibble
as_tibble.rot_record <- function(x, ...) {
  attr(x, "record") <- NULL
  class(x) <- setdiff(class(x), "rot_record")
  tibble::as_tibble(x, ...)
}

record_form <- list(
  source = "text",
  columns = list(column = "texts", heading = "texts=column", unit = "texts=column"),
  resolution = "values", dropped = list(why = "texts"), breaks = list(why = "texts"),
  assumed = "texts", spacing_s = "values:1", pulses_per_turn = "number?",
  centre = list(.optional = TRUE, kind = "text"),
  axis = list(.optional = TRUE, name = "text", direction = "numbers", across = "number")
)

has_all_rates <- function(columns) any(grepl("^omega_[xyz]_rad_per_s$", columns))
one_axis_remedy <- "{.arg axis} of {.fn motion_record} and {.fn read_motion} takes the rate about
  one axis: {.val principal}, or one by its name."

# A record as an argument, with at least one of the columns `needs`: times in order within each
# segment, everything finite or NA. Returns it with the columns that the verbs read, segments
# numbered from 1 in the order of the rows.
check_record <- function(x, arg, call, needs = c("theta_rad", "omega_rad_per_s", "pulses")) {
  if (is.data.frame(x) && !inherits(x, "rot_record") && "time_s" %in% names(x)) {
    check_headings(x, arg, call)
    x <- build_record(recognise_columns(x, call), nrow(x), call)
  }
  check_class(x, "rot_record", arg, "Make one with {.fn motion_record} or {.fn read_motion}.", call)
  if (!any(needs %in% names(x))) {
    abort_rotdyn(c(
      "{.arg {arg}} must have {.or {.field {needs}}}.",
      x = "It has {.field {setdiff(names(x), 'segment')}}.",
      i = if (has_all_rates(names(x))) one_axis_remedy
    ), "missing", call)
  }
  for (name in intersect(c("time_s", "segment", record_measured), names(x))) {
    values <- x[[name]]
    if (!is_number(values) || any(is.infinite(values))) {
      abort_rotdyn("Column {.field {name}} of {.arg {arg}} must be finite numbers.", "value", call)
    }
  }
  segment <- x$segment
  if (anyNA(x$time_s) || anyNA(segment)) {
    abort_rotdyn("{.arg {arg}} has rows without a time or a segment.", "time", call)
  }
  runs <- rle(as.double(segment))
  if (anyDuplicated(runs$values) || any(diff(x$time_s)[diff(segment) == 0] <= 0)) {
    abort_rotdyn(c(
      "The times of {.arg {arg}} must increase within each segment.",
      i = "Sort it by {.field segment} and {.field time_s}."
    ), "time", call)
  }
  x$segment <- match(segment, unique(segment))
  x
}

record_info <- function(x) attr(x, "record", exact = TRUE)

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_record <- function(x, ...) {
  info <- record_info(x)
  size <- c("A rotdyn record" = paste(format(nrow(x), big.mark = ","), "x", ncol(x)))
  if (!is.null(.Call(ffi_form_fault, info, record_form)) || is.null(names(info$resolution)) ||
    !all(c("time_s", "segment") %in% names(x))) {
    return(c(size, "Note" = "what was read and assumed is lost"))
  }
  c(size, escape_controls(describe_record(x, info)))
}

describe_record <- function(x, info) {
  heads <- info$columns
  from <- vapply(unique(heads$column), function(name) {
    rows <- heads[heads$column == name, ]
    paste0(
      name, " from ", paste0("\"", rows$heading, "\"", collapse = ", "),
      if (!plain_unit(rows$unit[1]) %in% c("1", "s", "rad", "rad/s", "m")) {
        paste0(" (", plain_unit(rows$unit[1]), ")")
      }
    )
  }, "")
  runs <- length(unique(x$segment))
  resolution <- info$resolution[is.finite(info$resolution)]
  steps <- vapply(names(resolution), function(name) {
    size <- resolution[[name]]
    unit <- column_table()$unit[match(name, column_table()$name)]
    turn <- 2 * pi / size
    paste0(
      name, " ", format(size, digits = 4), if (unit != "1") paste0(" ", unit),
      if (name == "theta_rad" && abs(turn - round(turn)) < 1e-3 * turn && round(turn) >= 2) {
        paste0(" (", round(turn), " counts a turn)")
      }
    )
  }, "")
  steps <- steps[names(steps) != "pulses"]
  dropped <- table(info$dropped$why)
  c(
    "Source" = info$source,
    "Columns" = paste(from, collapse = "; "),
    "Time" = if (nrow(x)) {
      paste0(
        format_si(min(x$time_s)), " to ", format_si(max(x$time_s)), " s, spacing ",
        format_si(info$spacing_s), " s"
      )
    },
    if (length(steps)) c("Resolution" = paste(steps, collapse = "; ")),
    if (runs > 1L) {
      c("Segments" = paste0(
        runs, if (nrow(info$breaks)) paste0(": ", paste(unique(info$breaks$why), collapse = "; "))
      ))
    },
    if (!is.null(info$pulses_per_turn)) c("Pulses" = paste(info$pulses_per_turn, "a turn")),
    if (is.list(info$axis)) {
      c("Axis" = paste0(
        info$axis$name, " (",
        paste(names(info$axis$direction), format(info$axis$direction, digits = 3), collapse = ", "),
        "), ", format(100 * info$axis$across, digits = 2), " % of the mean square is across it"
      ))
    },
    if (is.list(info$centre)) c("Centre" = describe_centre(info$centre)),
    if (length(dropped)) c("Dropped" = paste0(names(dropped), ": ", dropped, collapse = "; ")),
    if (length(info$assumed)) c("Assumed" = paste(info$assumed, collapse = "; "))
  )
}

describe_centre <- function(centre) {
  if (centre$kind == "tracked" || !is_number(centre$x_m) || !is_number(centre$y_m)) {
    return(centre$kind)
  }
  paste0(
    centre$kind, ": (", format(centre$x_m, digits = 4), ", ", format(centre$y_m, digits = 4), ") m",
    if (centre$kind == "fitted" && is_number(centre$radius_m) && is_number(centre$scatter_m)) {
      paste0(
        ", radius ", format(centre$radius_m, digits = 4), " m, distances scatter by ",
        format(centre$scatter_m, digits = 2), " m"
      )
    }
  )
}
