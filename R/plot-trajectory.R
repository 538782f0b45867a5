# The picture of a trajectory: a panel for each quantity over time, from the panels of the
# constraint's record. Several runs are drawn in one picture.

#' Plot a trajectory
#'
#' `autoplot()` of a trajectory draws its quantities over time, each in a panel with its unit: of an
#' axle, angle, angular velocity, torques and kinetic energy (with [inertia_knots()] also the moment
#' of inertia and the angular momentum); of rotors, the angular velocity of each and the torque of
#' each piece of shaft; of a clutch, both angular velocities, the torque of the clutch and the heat.
#' Quantities that are 0 throughout, and a net torque equal to the applied one, are left out.
#' Events ([motion_events()]) are dashed lines, with marks in the first panel.
#'
#' **Several runs** in one picture: of [compare_runs()], or of rows bound together, by the column
#' that distinguishes them (`by`). Events are marked for the former.
#'
#' @param object A `rot_trajectory`, or what [compare_runs()] returned.
#' @param ... Not used; names after it must be given in full.
#' @param units NULL for SI units, or units to draw in, such as `c("degree", "rpm", "ms")`: of
#'   angles `"degree"`, `"turn"`, `"rad"`; of angular velocities `"rpm"`, `"degree/s"`, `"turn/s"`,
#'   `"rad/s"`; of time `"ms"`, `"min"`, `"h"`, `"s"`; of energies `"mJ"`, `"kJ"`, `"W h"`, `"J"`;
#'   of torques `"mN m"`, `"kN m"`, `"N m"`.
#' @param panels NULL for all, or the panels to draw, in this order: the beginnings of their names
#'   (`"angular velocity"`) or columns of the table (`"angular_momentum_kg_m2_per_s"`).
#' @param by NULL, or the name of the column whose values distinguish runs.
#' @param base_size Size of the letters in points. Titles are wrapped for a width of 7 inches.
#' @return A ggplot, with alternative text (`ggplot2::get_alt_text()`).
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument` for an unknown
#'   argument; `rotdyn_error_unit`; `rotdyn_error_value` for unknown panels and columns;
#'   `rotdyn_error_type`.
#' @seealso [trajectory()], [compare_runs()], [motion_events()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(spin_up(), units = c("turn", "rpm"))
#' ggplot2::autoplot(spin_up(), panels = c("angular velocity", "torque"))
#' scene <- scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0))
#' ggplot2::autoplot(trajectory(scene, time_s = seq(0, 2, by = 0.02)))
#' skater <- scene_axle(inertia_knots(c(1, 2), c(5, 2)), omega0_rad_per_s = 2)
#' ggplot2::autoplot(trajectory(skater, time_s = seq(0, 3, by = 0.02)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept graph
#' @concept figure
autoplot.rot_trajectory <- function(object, ..., units = NULL, panels = NULL, by = NULL,
                                    base_size = 13) {
  call <- check_plot(base_size, ...)
  run <- check_trajectory(object, "object", current_env())
  parts <- split_runs(object, run, by, call)
  plot_runs(parts, units, panels, base_size, call)
}

#' Several runs in one table and one picture
#'
#' Binds the rows of trajectories under each other. `ggplot2::autoplot()` of the result draws all of
#' them in one picture, a colour for each run, and takes the arguments of that of a trajectory.
#'
#' @param ... Trajectories of one kind of scene, or a list of them, with the names of the runs. A
#'   run without a name has its number.
#' @return A tibble of class `rot_runs`: the column `run`, a factor, then those of [trajectory()].
#' @section Errors: `rotdyn_error_missing`, `rotdyn_error_type`, `rotdyn_error_value` for runs of
#'   different kinds and names given twice.
#' @seealso [autoplot.rot_trajectory()].
#' @concept convergence
#' @concept compare models
#' @examples
#' wheel <- function(c) scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = c))
#' time <- seq(0, 10, by = 0.1)
#' runs <- compare_runs(
#'   "no resistance" = trajectory(wheel(0), time), "0.03 N m s" = trajectory(wheel(0.03), time)
#' )
#' runs
#' if (requireNamespace("ggplot2", quietly = TRUE)) {
#'   ggplot2::autoplot(runs, panels = "angular velocity")
#' }
#' @export
compare_runs <- function(...) {
  call <- current_env()
  runs <- list(...)
  if (length(runs) == 1L && is.list(runs[[1]]) && !is.data.frame(runs[[1]])) runs <- runs[[1]]
  if (!length(runs)) abort_rotdyn("{.fn compare_runs} needs trajectories.", "missing", call)
  for (i in seq_along(runs)) {
    check_class(runs[[i]], "rot_trajectory", paste0("..", i), "{.fn trajectory} gives one.", call)
  }
  name <- names(runs) %||% rep("", length(runs))
  name <- ifelse(is.na(name) | name == "", paste("run", seq_along(runs)), name)
  if (anyDuplicated(name)) {
    abort_rotdyn("Two runs are named {.val {name[duplicated(name)][1]}}.", "value", call)
  }
  of <- lapply(runs, trajectory_run)
  kinds <- vapply(of, function(run) class(run$scene)[1], "")
  if (length(unique(kinds)) > 1L) {
    makers <- sub("rot_", "", unique(kinds), fixed = TRUE)
    abort_rotdyn(
      "The runs must be of one kind of scene; they are of {.fn {makers}}.", "value", call
    )
  }
  columns <- unique(unlist(lapply(runs, names)))
  n <- vapply(runs, nrow, 1L)
  rows <- lapply(stats::setNames(columns, columns), function(column) {
    unlist(lapply(runs, function(x) x[[column]] %||% rep(NA, nrow(x))), use.names = FALSE)
  })
  names(of) <- name
  new_table(
    c(list(run = factor(rep(name, n), levels = name)), rows), nrow = sum(n), runs = of,
    class = "rot_runs"
  )
}

#' @rdname autoplot.rot_trajectory
#' @exportS3Method ggplot2::autoplot
autoplot.rot_runs <- function(object, ..., units = NULL, panels = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  of <- attr(object, "runs")
  here <- intersect(names(of), as.character(object[["run"]]))
  parts <- lapply(here, function(name) {
    rows <- as.list(object)[names(object) != "run"]
    rows <- lapply(rows, `[`, object[["run"]] == name)
    list(name = name, rows = rows, run = of[[name]], events = of[[name]]$events, known = TRUE)
  })
  plot_runs(parts, units, panels, base_size, call)
}

# The runs in a table: a part for each value of `by`; without it, rows bound together are told
# apart by a column of words, or by time that starts again.
split_runs <- function(object, run, by, call) {
  rows <- as.list(object)
  constraint <- constraint_of(run$scene)
  if (is.null(by)) {
    step <- diff(rows$time_s)
    again <- which(step < 0)
    if (!length(again) || length(again) > length(step) / 4) {
      return(list(list(name = NA_character_, rows = rows, run = run, events = run$events)))
    }
    words <- Filter(function(name) {
      is.character(rows[[name]]) || is.factor(rows[[name]])
    }, setdiff(names(rows), constraint$columns))
    value <- if (length(words)) {
      rows[[words[1]]]
    } else {
      paste("run", cumsum(c(TRUE, step < 0)))
    }
  } else {
    if (!rlang::is_string(by) || !by %in% names(rows)) {
      abort_rotdyn(c(
        "{.arg by} must be NULL or the name of a column.",
        x = "It is {describe_value(by)}.", i = "The columns are {.field {names(rows)}}."
      ), "value", call)
    }
    value <- rows[[by]]
  }
  value <- factor(value, unique(value))
  lapply(levels(value), function(name) {
    list(name = name, rows = lapply(rows, `[`, value %in% name), run = run, events = NULL)
  })
}

plot_runs <- function(parts, units, panels, base_size, call) {
  if (!any(vapply(parts, function(part) length(part$rows$time_s) > 0L, NA))) {
    abort_rotdyn("There are no rows to draw.", "value", call)
  }
  constraint <- constraint_of(parts[[1]]$run$scene)
  units <- check_plot_units(units, call)
  columns <- unique(unlist(lapply(parts, function(part) names(part$rows))))
  chosen <- choose_panels(constraint, panels, columns, call)
  long <- panel_lines(parts, chosen, constraint, units, drop_zero = is.null(panels))
  if (!any(is.finite(long$value))) abort_rotdyn("There are no values to draw.", "value", call)
  several <- length(parts) > 1L
  time <- in_plot_unit("time (s)", units)
  lines <- setdiff(levels(long$line), no_name)
  long$key <- if (several) long$run else long$line
  shown <- if (several) levels(long$run) else lines
  colours <- key_colours(levels(long$key))
  types <- key_types(levels(long$line), several)
  events <- event_marks(parts, long, constraint, time$factor, several)
  labels <- levels(long$panel)
  cols <- if (length(labels) > 4L) 3L else if (length(labels) > 3L) 2L else 1L
  plot <- ggplot2::ggplot(long, ggplot2::aes(.data$time_s, .data$value, colour = .data$key)) +
    ggplot2::geom_hline(
      ggplot2::aes(yintercept = .data$value), panels_with_zero(long), colour = "grey80"
    )
  few <- nrow(events$lines) <= 12L
  if (nrow(events$lines) && few) {
    plot <- plot + ggplot2::geom_vline(
      ggplot2::aes(xintercept = .data$time_s), events$lines,
      colour = if (several) colours[as.character(events$lines$run)] else "grey55",
      linetype = "22"
    )
  }
  plot <- plot + ggplot2::geom_line(
    ggplot2::aes(linetype = .data$line, group = interaction(.data$run, .data$line)),
    linewidth = 0.06 * base_size
  )
  # As many marks would hide the line.
  if (nrow(events$marks) && nrow(events$marks) <= 30L) {
    plot <- plot +
      ggplot2::geom_point(
        ggplot2::aes(shape = .data$event), events$marks, size = 0.2 * base_size, stroke = 1,
        fill = "white", show.legend = c(shape = TRUE, colour = FALSE, linetype = FALSE)
      ) +
      ggplot2::scale_shape_manual(
        values = rep_len(c(21, 24, 22, 23, 25, 4, 3), nlevels(events$marks$event)), name = NULL,
        guide = ggplot2::guide_legend(order = 3)
      )
  }
  plot +
    ggplot2::facet_wrap(
      "panel", scales = "free_y", ncol = cols,
      labeller = ggplot2::as_labeller(function(x) {
        vapply(
          x, wrap_label, "", size = 0.75 * base_size,
          width_in = (6.8 - 0.03 * base_size) / cols - 0.03 * base_size
        )
      })
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(
      breaks = plot_breaks(base_size, if (length(labels) > 2L) 4 else 5), guide = plot_axis()
    ) +
    ggplot2::scale_colour_manual(
      values = colours, breaks = shown, name = NULL,
      guide = if (length(shown)) {
        ggplot2::guide_legend(order = 1, ncol = legend_columns(shown, base_size))
      } else {
        "none"
      }
    ) +
    ggplot2::scale_linetype_manual(
      values = types, breaks = lines, name = NULL,
      guide = if (length(lines)) {
        ggplot2::guide_legend(
          order = if (several) 2 else 1, ncol = legend_columns(lines, base_size)
        )
      } else {
        "none"
      }
    ) +
    ggplot2::labs(
      title = wrap_title(runs_title(parts, constraint), base_size),
      subtitle = wrap_subtitle(runs_subtitle(parts), base_size),
      x = time$label, y = NULL, alt = runs_alt(parts, constraint, long, time$label, events)
    ) +
    # A mark at the largest value is drawn whole.
    ggplot2::coord_cartesian(clip = "off") +
    plot_theme(base_size) +
    ggplot2::theme(
      legend.box = if (legends_fit(list(shown, if (several) lines, levels(events$marks$event)),
                                   base_size)) "horizontal" else "vertical"
    )
}

# Zero is shown, except where a motion far from it would be a flat line.
panels_with_zero <- function(long) {
  far <- vapply(split(long$value, long$panel), function(value) {
    ends <- range(value[is.finite(value)], 0)
    own <- range(value[is.finite(value)])
    span <- diff(own)
    isTRUE(span > 1e-6 * max(abs(own)) && diff(ends) > 6 * span)
  }, NA)
  panels <- levels(long$panel)[!far]
  data.frame(value = 0 * seq_along(panels), panel = factor(panels, levels(long$panel)))
}

# Values beyond those that axes show without exponents are in powers of 1000 of the unit.
in_powers <- function(long) {
  for (name in unique(long$panel)) {
    here <- long$panel == name
    power <- power_of(long$value[here])
    if (power == 0 || !grepl("[(].*[)]$", name)) next
    long$value[here] <- long$value[here] / 10^power
    long$panel[here] <- label_in_power(name, power)
  }
  long
}

# The name of a line that needs none: a scale takes no empty name.
no_name <- " "

key_colours <- function(keys) {
  named <- c(applied = plot_colours[5], damping = plot_colours[2], net = plot_colours[3])
  lines <- setdiff(keys, no_name)
  of <- if (all(lines %in% names(named))) named[lines] else line_colours(length(lines))
  stats::setNames(c(of, plot_colours[1]), c(lines, no_name))
}

# Of one run, types change where the colours repeat; of several, each line has its own. "net" is
# dashed: it may coincide with another line.
key_types <- function(keys, several) {
  lines <- setdiff(keys, no_name)
  of <- if (several) rep_len(c("solid", "42", "13", "4213"), length(lines)) else
    ifelse(lines == "net", "22", plot_types(length(lines)))
  stats::setNames(c(of, "solid"), c(lines, no_name))
}

# As many columns as fit 7 inches.
legend_columns <- function(labels, base_size) {
  each <- text_width(labels, 0.75 * base_size) + 2.6 * base_size
  max(1L, min(length(labels), floor(6.8 * 72 / each)))
}

# Whether legends beside each other fit 7 inches.
legends_fit <- function(labels, base_size) {
  all <- unlist(labels)
  drawn <- sum(lengths(labels) > 0L)
  text_width(strrep("x", sum(nchar(all))), 0.75 * base_size) +
    base_size * (2.6 * length(all) + 2 * (drawn - 1)) < 6.8 * 72
}

# The panels to draw; a column without a panel gets its own.
choose_panels <- function(constraint, panels, columns, call) {
  all <- Filter(function(one) {
    any(names(one$columns) %in% columns) && (is.null(one$only_with) || one$only_with %in% columns)
  }, constraint$panels)
  if (is.null(panels)) return(all)
  if (!is.character(panels) || !length(panels) || anyNA(panels)) {
    abort_rotdyn(c(
      "{.arg panels} must be NULL or names of panels or columns.",
      x = "It is {describe_value(panels)}."
    ), "type", call)
  }
  labels <- sub(" \\(.*", "", vapply(all, function(one) one$label, ""))
  lapply(panels, function(name) {
    if (name %in% columns) return(panel(column_label(name), stats::setNames("", name)))
    hit <- which(labels == name)
    if (!length(hit)) hit <- which(startsWith(labels, name))
    if (length(hit) != 1L) {
      abort_rotdyn(c(
        "{.arg panels} must have names of panels or columns.",
        x = "{.val {name}} is neither.",
        i = "The panels are {.val {labels}}, the columns {.field {columns}}."
      ), "value", call)
    }
    all[[hit]]
  })
}

# "angular momentum (kg m^2/s)" of the column's name, by the unit in it.
column_label <- function(name) {
  unit <- unit_in_name(name)
  paste0(words_in_name(name, unit), if (unit != "1") paste0(" (", unit, ")"))
}

# The columns of the panels in long form: time_s, value, panel, line, run. Where rows have an index,
# each value of it is a line.
panel_lines <- function(parts, panels, constraint, units, drop_zero) {
  index <- constraint$index
  time <- in_plot_unit("time (s)", units)
  one <- function(part, spec) {
    columns <- spec$columns[names(spec$columns) %in% names(part$rows)]
    unit <- in_plot_unit(spec$label, units)
    lapply(names(columns), function(name) {
      value <- part$rows[[name]]
      line <- if (is.null(index)) {
        rep(columns[[name]], length(value))
      } else {
        trimws(paste(columns[[name]], index, part$rows[[index]]))
      }
      data <- data.frame(
        time_s = part$rows$time_s * time$factor, value = as.double(value) * unit$factor,
        panel = rep(unit$label, length(value)), line = line, run = rep(part$name, length(value))
      )
      data <- data[!is.na(value), ]
      if (!unit_in_name(name) %in% c("N", "N m") || !length(part$events$time_s)) return(data)
      at <- sort(unique(part$events$time_s)) * time$factor
      do.call(rbind, lapply(unname(split(data, data$line)), with_jumps, at))
    })
  }
  long <- do.call(rbind, unlist(lapply(panels, function(spec) {
    unlist(lapply(parts, one, spec), recursive = FALSE)
  }), recursive = FALSE))
  long <- in_powers(if (drop_zero) without_zero(long) else long)
  long$run[is.na(long$run)] <- ""
  long$line[long$line == ""] <- no_name
  for (name in c("panel", "line", "run")) {
    long[[name]] <- factor(long[[name]], unique(long[[name]]))
  }
  long
}

# A line of a force or a torque, with points on both sides of the times `at` at which it jumps: from
# the two rows before and the two after. Else the jump is drawn as a slope from row to row.
with_jumps <- function(line, at) {
  rows <- split(seq_len(nrow(line)), findInterval(line$time_s, at))
  if (length(rows) < 2L) return(line)
  range <- diff(range(line$value))
  near <- function(i, time_s) { # i: one row or two, the nearer one first
    if (length(i) == 1L) return(line$value[i])
    slope <- diff(line$value[i]) / diff(line$time_s[i])
    line$value[i[1]] + slope * (time_s - line$time_s[i[1]])
  }
  added <- lapply(seq_along(rows)[-1], function(k) {
    before <- rev(rows[[k - 1L]])
    after <- rows[[k]]
    time_s <- at[as.integer(names(rows)[k])]
    ends <- c(near(utils::head(before, 2L), time_s), near(utils::head(after, 2L), time_s))
    whole <- abs(line$value[after[1]] - line$value[before[1]])
    if (!isTRUE(abs(diff(ends)) > max(0.5 * whole, 0.01 * range))) return(NULL)
    points <- line[c(before[1], after[1]), ]
    points$time_s <- time_s
    points$value <- ends
    points
  })
  added <- do.call(rbind, added)
  # At one time: before, a row, after.
  place <- c(rep(1L, nrow(line)), rep_len(c(0L, 2L), max(0L, nrow(added))))
  out <- rbind(line, added)
  out[order(out$time_s, place), ]
}

# Without lines that are 0 throughout, and without a net torque that is one of the others; one panel
# is left at least.
without_zero <- function(long) {
  key <- paste(long$panel, long$line, sep = "\r")
  moves <- rowsum(as.integer(long$value != 0), key)[, 1] > 0
  kept <- long[moves[key], ]
  if (!nrow(kept)) return(long[long$panel == long$panel[1], ])
  for (name in unique(kept$panel)) {
    here <- which(kept$panel == name)
    lines <- split(kept$value[here], kept$line[here])
    others <- lines[names(lines) != "net"]
    if (!is.null(lines$net) && any(vapply(others, identical, NA, lines$net))) {
      kept <- kept[-here[kept$line[here] == "net"], ]
    }
  }
  kept
}

# Events: their times, and their points on the lines of the first panel.
event_marks <- function(parts, long, constraint, factor, several) {
  first <- long[long$panel == levels(long$panel)[1], ]
  all <- lapply(parts, function(part) {
    events <- part$events
    if (!length(events$time_s)) return(NULL)
    span <- range(part$rows$time_s)
    inside <- events$time_s >= span[1] & events$time_s <= span[2]
    run <- if (several) part$name else ""
    at <- data.frame(time_s = events$time_s[inside] * factor, event = events$event[inside])
    if (!nrow(at)) return(NULL)
    at$run <- run
    own <- first[first$run == run, ]
    marks <- lapply(split(own, own$line, drop = TRUE), function(line) {
      if (nrow(line) < 2L) return(NULL)
      value <- stats::approx(line$time_s, line$value, at$time_s, ties = mean)$y
      cbind(at, value = value, line = line$line[1], key = line$key[1], panel = line$panel[1])
    })
    list(lines = at, marks = do.call(rbind, marks))
  })
  bind <- function(name) {
    out <- do.call(rbind, lapply(all, function(one) one[[name]]))
    out %||% data.frame(time_s = double(), event = character(), run = character())
  }
  marks <- bind("marks")
  if (nrow(marks)) marks <- marks[!is.na(marks$value), ]
  marks$event <- factor(marks$event, unique(marks$event))
  list(lines = bind("lines"), marks = marks)
}

runs_title <- function(parts, constraint) {
  titles <- unique(vapply(parts, function(part) constraint$title(part$run), ""))
  if (!is.null(constraint$rows_are)) titles <- paste0(titles, ": ", constraint$rows_are)
  if (length(titles) == 1L) titles else paste(length(parts), "runs")
}

# Of rows bound together only the first run is known.
runs_subtitle <- function(parts) {
  if (length(parts) == 1L) {
    run <- parts[[1]]$run
    error <- run$info$error
    return(paste0(run$model, if (is.finite(error)) paste(
      ", relative error", if (run$error_kind == "bound") "at most" else "about",
      format(error, digits = 2)
    )))
  }
  if (is.null(parts[[1]]$known)) return(NULL)
  models <- unique(vapply(parts, function(part) part$run$model, ""))
  paste(if (length(models) == 1L) "model" else "models", paste(models, collapse = ", "))
}

runs_alt <- function(parts, constraint, long, time, events) {
  of <- vapply(split(long, long$panel), function(one) {
    lines <- vapply(split(one, list(one$run, one$line), drop = TRUE), function(line) {
      name <- trimws(paste(line$run[1], line$line[1]))
      paste0(if (nzchar(name)) paste0(name, " "), range_in_words(line$value))
    }, "")
    if (length(lines) > 6L) lines <- range_in_words(one$value)
    paste0(one$panel[1], ": ", paste(lines, collapse = ", "))
  }, "")
  unit <- sub("^.*\\((.*)\\)$", "\\1", time)
  at <- events$lines
  paste0(
    runs_title(parts, constraint), ". Lines over time from ",
    range_in_words(long$time_s), " ", unit, ". ", paste(of, collapse = "; "), ".",
    if (nrow(at)) {
      first <- utils::head(at, 6L)
      paste0(
        " Events: ", paste0(first$event, " at ", format_si(signif(first$time_s, 4)), " ", unit,
                            collapse = ", "), if (nrow(at) > 6L) ", ...", "."
      )
    }
  )
}
