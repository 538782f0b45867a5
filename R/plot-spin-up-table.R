#' Plot a table of spin-ups, of inclines
#'
#' The results of [spin_up_table()] or [incline_table()] over one of its parameters, a panel each; a
#' second parameter distinguishes lines by colour, a third one by their type.
#'
#' @param object A table from [spin_up_table()] or [incline_table()].
#' @inheritParams autoplot.rot_trajectory
#' @param x NULL, or the column across: by default the number that varies most.
#' @param colour NULL, or the column that distinguishes lines: by default another one that varies,
#'   with at most seven values. `FALSE` for none.
#' @param panels NULL for the final state (of a spin-up also the largest angular velocity, of an
#'   incline when it began to roll and the heat of the slip), or other columns of results.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` for unknown columns.
#' @seealso [spin_up_table()], [incline_table()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' designs <- expand.grid(
#'   moment_of_inertia_kg_m2 = seq(0.05, 0.5, by = 0.05), viscous_n_m_s = c(0, 0.03, 0.3)
#' )
#' ggplot2::autoplot(spin_up_table(designs, torque_constant(0.8), time_s = 8))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept designs
autoplot.rot_spin_up_table <- function(object, ..., x = NULL, colour = NULL, panels = NULL,
                                       base_size = 13) {
  call <- check_plot(base_size, ...)
  panels <- panels %||% intersect(
    c(
      "final_omega_rad_per_s",
      # The largest speed is often the final one.
      if (!identical(abs(object[["final_omega_rad_per_s"]]), object[["max_abs_omega_rad_per_s"]])) {
        "max_abs_omega_rad_per_s"
      },
      "final_theta_rad"
    ), names(object)
  )
  plot_table(object, spin_up_table_columns, panels, x, colour, "spin-ups", base_size, call)
}

#' @rdname autoplot.rot_spin_up_table
#' @exportS3Method ggplot2::autoplot
autoplot.rot_incline_table <- function(object, ..., x = NULL, colour = NULL, panels = NULL,
                                       base_size = 13) {
  call <- check_plot(base_size, ...)
  panels <- panels %||% intersect(
    c(
      "final_v_m_per_s",
      if (any(is.finite(object[["roll_time_s"]]))) "roll_time_s",
      if (any(object[["slip_heat_j"]] > 0, na.rm = TRUE)) "slip_heat_j",
      "final_x_m"
    ), names(object)
  )
  plot_table(object, incline_table_columns, panels, x, colour, "inclines", base_size, call)
}

# The results of rows over one of their parameters. `what`: the rows in words.
plot_table <- function(object, results, panels, x, colour, what, base_size, call) {
  if (!nrow(object)) abort_rotdyn("There are no rows to draw.", "value", call)
  data <- as.list(object)
  given <- setdiff(names(data), results)
  distinct <- vapply(data[given], function(values) length(unique(values)), 1L)
  numbers <- vapply(data[given], is_number, NA)
  vary <- distinct > 1L
  if (is.null(x)) {
    best <- if (any(vary & numbers)) vary & numbers else vary
    x <- if (any(best)) given[best][which.max(distinct[best])]
  } else {
    check_sweep_name(x, "x", names(data), call)
  }
  if (is.null(colour)) {
    others <- given[vary & distinct <= length(plot_colours) & given != (x %||% "")]
    colour <- if (length(others)) others[1]
  } else if (isFALSE(colour)) {
    colour <- NULL
  } else {
    check_sweep_name(colour, "colour", names(data), call)
  }
  for (name in panels) check_sweep_name(name, "panels", names(data), call)
  across <- if (is.null(x)) seq_len(nrow(object)) else data[[x]]
  by_number <- is_number(across)
  if (!by_number) across <- factor(as.character(across), unique(as.character(across)))
  key <- if (is.null(colour)) rep(no_name, nrow(object)) else sweep_key(data[[colour]])
  key <- factor(key, unique(key[order(if (is.null(colour)) key else data[[colour]])]))
  # A line for each set of the other parameters; a third one of few values has types of line.
  others <- setdiff(given[vary], c(x, colour))
  group <- do.call(paste, c(list(rep("", nrow(object))), unname(data[others])))
  third <- others[distinct[others] <= 4L][1]
  type <- if (is.na(third)) rep(no_name, nrow(object)) else sweep_key(data[[third]])
  type <- factor(type, unique(type[order(if (is.na(third)) type else data[[third]])]))
  types <- setdiff(levels(type), no_name)
  long <- do.call(rbind, lapply(panels, function(name) {
    data.frame(
      across = across, value = as.double(data[[name]]), key = key, type = type, group = group,
      panel = column_label(name)
    )
  }))
  long <- long[is.finite(long$value), ]
  long$panel <- factor(long$panel, vapply(panels, column_label, ""))
  keys <- setdiff(levels(key), no_name)
  label <- if (is.null(x)) "row" else column_label(x)
  plot <- ggplot2::ggplot(long, ggplot2::aes(.data$across, .data$value, colour = .data$key))
  if (by_number && nrow(object) <= 5000L) {
    plot <- plot + ggplot2::geom_line(
      ggplot2::aes(linetype = .data$type, group = interaction(.data$key, .data$group)),
      linewidth = 0.05 * base_size
    ) + ggplot2::scale_linetype_manual(
      values = stats::setNames(
        rep_len(c("solid", "42", "13", "4213"), nlevels(type)), levels(type)
      ), breaks = types, name = if (length(types)) column_label(third),
      guide = if (length(types)) ggplot2::guide_legend(order = 2) else "none"
    )
  }
  plot +
    ggplot2::geom_point(size = 0.13 * base_size, alpha = if (nrow(object) > 500L) 0.4 else 1) +
    ggplot2::facet_wrap(
      "panel", scales = "free_y", ncol = 1,
      labeller = ggplot2::as_labeller(function(text) {
        vapply(text, wrap_label, "", size = 0.75 * base_size, width_in = 5.8)
      })
    ) +
    (if (by_number) {
      ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis())
    } else {
      ggplot2::scale_x_discrete(guide = plot_axis())
    }) +
    ggplot2::scale_y_continuous(
      breaks = plot_breaks(base_size, 4), guide = plot_axis(),
      expand = ggplot2::expansion(mult = 0.12)
    ) +
    ggplot2::scale_colour_manual(
      values = stats::setNames(
        c(line_colours(length(keys)), plot_colours[1]), c(keys, no_name)
      ),
      breaks = keys, name = if (length(keys)) {
        wrap_text(column_label(colour), 0.75 * base_size, 2.4)
      },
      guide = if (length(keys)) {
        ggplot2::guide_legend(
          ncol = legend_columns(keys, base_size), title.position = if (legends_fit(
            list(column_label(colour), keys), base_size
          )) "left" else "top"
        )
      } else {
        "none"
      }
    ) +
    ggplot2::labs(
      title = wrap_title(paste(format(nrow(object), big.mark = ","), what), base_size),
      x = label, y = NULL,
      alt = paste0(
        nrow(object), " ", what, " over ", label, if (!is.null(colour)) {
          paste0(", coloured by ", column_label(colour))
        }, if (length(types)) paste0(", types of line by ", column_label(third)),
        ". ", paste(vapply(split(long, long$panel), function(one) {
          paste0(one$panel[1], ": ", range_in_words(one$value))
        }, ""), collapse = "; "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(legend.box = if (legends_fit(
      list(colour, keys, if (length(types)) third, types), base_size
    )) "horizontal" else "vertical")
}

sweep_key <- function(values) {
  if (is_number(values)) format_si(signif(values, 4)) else as.character(values)
}

check_sweep_name <- function(name, arg, names, call) {
  if (!rlang::is_string(name) || !name %in% names) {
    abort_rotdyn(c(
      "{.arg {arg}} must name columns of the table.", x = "It is {describe_value(name)}.",
      i = "The columns are {.field {names}}."
    ), "value", call)
  }
}
