#' Plot a record of a motion
#'
#' A panel over time for each measured quantity: angle, angular velocity, pulses or positions. Up to
#' 400 samples are points, more are a thin line. Neither the line nor anything else joins segments,
#' and a missing value leaves a gap.
#'
#' The subtitle names what was read: samples, segments, source and the rate of the samples.
#'
#' @param object A record or a motion, from [motion_record()] or [read_motion()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_unit`.
#' @seealso [motion_record()], [read_motion()], [autoplot.rot_estimate()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' samples <- data.frame(t = c(0:20, 30:50) / 10, angle = c(0:20, 30:50)^2 / 50)
#' ggplot2::autoplot(motion_record(samples, time_s = t, theta_rad = angle, segment = t > 2.5))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept samples
autoplot.rot_record <- function(object, ..., units = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  units <- check_plot_units(units, call)
  panels <- c(
    theta_rad = "angle (rad)", omega_rad_per_s = "angular velocity (rad/s)",
    omega_x_rad_per_s = "rate about x (rad/s)", omega_y_rad_per_s = "rate about y (rad/s)",
    omega_z_rad_per_s = "rate about z (rad/s)", pulses = "pulses",
    x_m = "x (m)", y_m = "y (m)"
  )
  panels <- panels[names(panels) %in% names(object)]
  labels <- lapply(panels, in_plot_unit, units = units)
  levels <- vapply(labels, `[[`, "", "label", USE.NAMES = FALSE)
  time <- in_plot_unit("time (s)", units)
  long <- do.call(rbind, lapply(seq_along(panels), function(i) {
    value <- object[[names(panels)[i]]] * labels[[i]]$factor
    # The samples on either side of a missing value are not joined.
    kept <- is.finite(value)
    data.frame(
      panel = rep(levels[i], nrow(object)), time = object$time_s * time$factor, value = value,
      piece = paste(object$segment, cumsum(!kept))
    )[kept, ]
  }))
  if (!NROW(long)) abort_rotdyn("There are no rows to draw.", "value", call)
  long$panel <- factor(long$panel, levels)
  layer <- if (nrow(object) > 400L) {
    ggplot2::geom_line(
      ggplot2::aes(group = .data$piece), colour = plot_colours[1], linewidth = 0.03 * base_size
    )
  } else {
    ggplot2::geom_point(colour = plot_colours[1], size = 0.08 * base_size, shape = 16)
  }
  ggplot2::ggplot(long, ggplot2::aes(.data$time, .data$value)) +
    layer +
    ggplot2::facet_wrap("panel", scales = "free_y", ncol = 1) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title("Measured samples", base_size),
      subtitle = wrap_subtitle(record_subtitle(object), base_size), x = time$label, y = NULL,
      alt = paste0(
        "Samples over time, in ", length(levels), " panel", if (length(levels) > 1L) "s", ": ",
        paste0(panels, " from ", vapply(object[names(panels)], range_in_words, ""),
               collapse = ", "), "."
      )
    ) +
    plot_theme(base_size)
}

record_subtitle <- function(object) {
  segments <- length(unique(object$segment))
  # Across the start of a segment there is no spacing.
  steps <- diff(object$time_s)[diff(object$segment) == 0]
  spacing <- if (length(steps)) stats::median(steps) else 0
  source <- attr(object, "record")$source
  paste0(
    nrow(object), " sample", if (nrow(object) != 1L) "s",
    if (segments > 1L) paste0(" in ", segments, " segments"),
    if (length(source) && source[1] != "a data frame") paste0(" from ", basename(source[1])),
    if (isTRUE(spacing > 0) && !"pulses" %in% names(object)) {
      paste0(", ", format_si(signif(1 / spacing, 3)), " Hz")
    }
  )
}
