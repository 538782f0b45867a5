#' Plot a measured number
#'
#' The distribution of a value with its standard uncertainty: normal, or Student's with few degrees
#' of freedom. Dark: within one standard uncertainty; light: within the 95 % interval.
#'
#' @param object A number from [measured()], or one computed with such.
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` for an exact number.
#' @seealso [measured()], [autoplot.rot_uncertainty_budget()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(measured(c(0.3358, 0.3361, 0.3362, 0.3359), name = "radius"))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept standard uncertainty
autoplot.rot_measured <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_measured(object, "object", call)
  u <- object$u
  if (!(u > 0)) {
    abort_rotdyn("{.arg object} is exact: there is no uncertainty to draw.", "value", call)
  }
  half <- stats::qt(0.975, object$dof)
  z <- sort(c(seq(-1, 1, length.out = 401L) * max(4, 1.4 * half), -half, -1, 1, half))
  curve <- data.frame(x = object$value + u * z, y = stats::dt(z, object$dof) / u)
  ends <- object$value + c(-half, half) * u
  words <- paste0(
    "95 % between ", paste(format_si(signif(ends, 6)), collapse = " and "),
    if (is.finite(object$dof)) paste0("; ", format_si(object$dof, 3), " degrees of freedom")
  )
  shade <- function(reach, alpha) {
    ggplot2::geom_ribbon(
      ggplot2::aes(ymin = 0, ymax = .data$y), curve[abs(z) <= reach, ], fill = plot_colours[1],
      alpha = alpha
    )
  }
  title <- paste(object$name, "=", format.rot_measured(object))
  ggplot2::ggplot(curve, ggplot2::aes(.data$x, .data$y)) +
    shade(half, 0.25) +
    shade(1, 0.4) +
    ggplot2::geom_line(colour = plot_colours[1], linewidth = 0.06 * base_size) +
    ggplot2::geom_vline(xintercept = object$value, colour = plot_ink, linetype = "22") +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = NULL, expand = ggplot2::expansion(c(0, 0.05))) +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(words, base_size),
      x = object$name, y = "density",
      alt = paste0("A bell-shaped curve of ", title, ". Shaded: one standard uncertainty, ",
                   format_si(signif(u, 3)), ", and ", words, ".")
    ) +
    plot_theme(base_size)
}
