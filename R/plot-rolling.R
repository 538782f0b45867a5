#' Plot a rolling table
#'
#' The final speed of each object, and how its kinetic energy is divided.
#'
#' @param object From [rolling_table()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [rolling_table()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(rolling_table())
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept rolling
autoplot.rot_rolling_table <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  label <- if ("object" %in% names(object)) {
    gsub("_", " ", as.character(object[["object"]]))
  } else {
    paste("beta =", format(object[["beta"]], digits = 3, trim = TRUE))
  }
  label <- make.unique(label, sep = " ")
  speed <- object[["final_speed_m_per_s"]]
  order <- label[order(speed)]
  long <- data.frame(
    label = factor(rep(label, 2), levels = order),
    share = c(object[["translational_energy_fraction"]], object[["rotational_energy_fraction"]]),
    motion = factor(
      rep(c("translation", "rotation"), each = length(label)),
      levels = c("rotation", "translation")
    )
  )
  speeds <- data.frame(
    label = factor(label, levels = order),
    text = paste(formatC(speed, digits = 3, format = "f"), "m/s")
  )
  # Room for the speeds beside the bars, of a picture of 7 inches.
  room <- 7 * 72 - text_width(label, 0.72 * base_size) - 2 * base_size
  reach <- 1 / (1 - min(text_width(paste0(speeds$text, "mmm"), 0.72 * base_size) / room, 0.6))
  ggplot2::ggplot(long, ggplot2::aes(.data$share, .data$label)) +
    ggplot2::geom_col(ggplot2::aes(fill = .data$motion), width = 0.7) +
    ggplot2::geom_text(
      data = speeds, ggplot2::aes(x = 1.02, y = .data$label, label = .data$text),
      hjust = 0, size = text_size(base_size), colour = "grey25"
    ) +
    ggplot2::scale_x_continuous(
      limits = c(0, reach), breaks = seq(0, 1, by = if (base_size > 16) 0.5 else 0.25),
      labels = function(share) ifelse(share == 0, "0", paste(100 * share, "%")), expand = c(0, 0),
      guide = plot_axis()
    ) +
    ggplot2::scale_fill_manual(
      values = c(rotation = plot_colours[2], translation = plot_colours[1]),
      breaks = c("translation", "rotation"), name = NULL
    ) +
    ggplot2::labs(
      title = wrap_title("What rolls faster puts less into rotation", base_size),
      subtitle = wrap_subtitle(
        "share of the kinetic energy, and the speed at the bottom", base_size
      ),
      x = NULL, y = NULL,
      alt = paste0(
        "Bars of the shares of translation and rotation in the kinetic energy, slowest first: ",
        paste0(order, ", ", format_si(sort(speed), 3), " m/s", collapse = "; "), "."
      )
    ) +
    ggplot2::coord_cartesian(clip = "off") +
    plot_theme(base_size) +
    ggplot2::theme(panel.grid.major.y = ggplot2::element_blank())
}
