#' Plot a race
#'
#' The bodies of a race beside each other at some of its times, as a stroboscope shows them: a spoke
#' on each shows how far it has turned. The bodies are not to scale.
#'
#' @param object A `rot_race`, from [roll_race()].
#' @inheritParams autoplot.rot_trajectory
#' @param time_s NULL for some of the race's times, or those to draw.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` for no rows, or times that the race does not have.
#' @seealso [roll_race()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(roll_race())
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept race
autoplot.rot_race <- function(object, ..., time_s = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  race <- attr(object, "race", exact = TRUE)
  if (is.null(race) || !all(race_columns %in% names(object))) {
    abort_rotdyn("These rows are no race any more.", "type", call)
  }
  known <- unique(object[["time_s"]])
  if (!length(known)) abort_rotdyn("There are no rows to draw.", "value", call)
  if (is.null(time_s)) {
    time_s <- known[unique(round(seq(1, length(known), length.out = min(5, length(known)))))]
  } else {
    time_s <- check_finite(time_s, "time_s", "s", call)
    if (!all(time_s %in% known)) {
      abort_rotdyn(c(
        "The race has no row at {format(time_s[!time_s %in% known][1])} s.",
        i = "{.arg time_s} of {.fn roll_race} sets its times."
      ), "value", call)
    }
  }
  order <- order(race$starts$finish_time_s)
  shown <- utils::head(order, 12L)
  length_m <- max(race$columns$length_m, na.rm = TRUE)
  unit <- length_m / 14
  lane_of <- function(lane) -2.6 * unit * (match(lane, shown) - 1)
  rows <- as.list(object)[race_columns]
  keep <- rows$time_s %in% time_s & rows$lane %in% shown & !is.na(rows$x_m)
  rows <- lapply(rows, `[`, keep)
  outline <- draw_circle(0, 0, unit)
  round <- race$objects[["beta"]][rows$lane] > 0
  block <- cbind(unit * c(-1, 1, 1, -1), 0.8 * unit * c(-1, -1, 1, 1))
  shape_of <- function(i) if (isTRUE(round[i])) outline else block
  polygons <- do.call(rbind, lapply(seq_along(rows$lane), function(i) {
    shape <- shape_of(i)
    data.frame(
      x = rows$x_m[i] + shape[, 1], y = lane_of(rows$lane[i]) + shape[, 2], id = i,
      time_s = rows$time_s[i]
    )
  }))
  spokes <- data.frame(
    x = rows$x_m, y = lane_of(rows$lane), time_s = rows$time_s,
    to_x = rows$x_m + unit * sin(rows$theta_rad),
    to_y = lane_of(rows$lane) + unit * cos(rows$theta_rad)
  )[which(round), ]
  label <- race_labels(race)[shown]
  arrives <- race$starts$finish_time_s[shown]
  ends <- data.frame(
    x = length_m + 1.6 * unit, y = lane_of(shown),
    text = ifelse(is.finite(arrives), paste(format_si(signif(arrives, 3)), "s"), "")
  )
  ground <- data.frame(y = lane_of(shown) - unit)
  ggplot2::ggplot() +
    ggplot2::geom_segment(
      data = ground, ggplot2::aes(
        x = -1.2 * unit, xend = length_m + 1.2 * unit, y = .data$y, yend = .data$y
      ), colour = "grey70"
    ) +
    ggplot2::geom_vline(xintercept = length_m, colour = "grey40", linetype = "22") +
    ggplot2::geom_polygon(
      data = polygons, ggplot2::aes(
        .data$x, .data$y, group = .data$id, fill = .data$time_s
      ), colour = "grey25", linewidth = 0.3
    ) +
    ggplot2::geom_segment(
      data = spokes, ggplot2::aes(.data$x, .data$y, xend = .data$to_x, yend = .data$to_y),
      colour = "grey15"
    ) +
    ggplot2::geom_text(
      data = ends, ggplot2::aes(.data$x, .data$y, label = .data$text), hjust = 0,
      size = text_size(base_size), colour = "grey25"
    ) +
    ggplot2::scale_fill_gradient(
      low = "grey95", high = plot_colours[1], name = "time (s)", breaks = plot_breaks(base_size, 3)
    ) +
    ggplot2::scale_y_continuous(breaks = lane_of(shown), labels = make.unique(label, " ")) +
    ggplot2::scale_x_continuous(
      breaks = plot_breaks(base_size), guide = plot_axis(),
      expand = ggplot2::expansion(add = c(0.4, 4) * unit)
    ) +
    ggplot2::coord_equal(clip = "off") +
    ggplot2::labs(
      title = wrap_title("A race from rest", base_size),
      subtitle = wrap_subtitle(paste0(
        "each at ", length(time_s), " times; dashed the finish, with the time of arrival",
        if (length(order) > length(shown)) {
          paste0("; the first ", length(shown), " of ", length(order))
        }
      ), base_size),
      x = "path (m)", y = NULL,
      alt = paste0(
        "A race: ", paste0(label, " ", ifelse(
          is.finite(arrives), paste("arrives after", format_si(signif(arrives, 3)), "s"),
          "does not arrive"
        ), collapse = "; "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(
      panel.grid = ggplot2::element_blank(),
      # The number at the low end of the colour bar is as wide as half of itself beyond it.
      legend.title = ggplot2::element_text(
        vjust = 1, margin = ggplot2::margin(r = base_size, unit = "pt")
      )
    )
}
