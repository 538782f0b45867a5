#' Plot a motion along a curve
#'
#' The path of the centre, to scale, with its places at equal intervals of time and how it ends.
#'
#' @param object From [roll_on_curve()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [roll_on_curve()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(roll_on_curve(curve_cycloid(1), 0, 2 * pi, body = 2 / 5))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept loop
#' @concept track
autoplot.rot_curve_motion <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  run <- check_curve_motion(object, call)
  for (name in c("time_s", "x_m", "y_m", "v_m_per_s")) {
    if (!is.double(object[[name]])) abort_form(name, "object", "motion along a curve", call)
  }
  path <- data.frame(x = object$x_m, y = object$y_m, time = object$time_s, v = object$v_m_per_s)
  even <- seq(0, max(path$time), length.out = 13L)
  at <- function(column) stats::approx(path$time, column, even, ties = "ordered")$y
  places <- data.frame(x = at(path$x), y = at(path$y), v = at(path$v))
  step <- format_si(signif(even[2], 3))
  last <- run$last
  end <- data.frame(x = last$x_m, y = last$y_m)
  words <- c(arrives = "arrives", turns = "turns", leaves = "leaves the track", slips = "slips")
  said <- paste0(words[[last$event]], " after ", format_si(signif(last$time_s, 4)), " s")
  ggplot2::ggplot(path, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_path(colour = "grey60", linewidth = 0.045 * base_size) +
    ggplot2::geom_point(ggplot2::aes(colour = .data$v), places, size = 0.2 * base_size) +
    ggplot2::geom_point(data = end, shape = 4, size = 0.3 * base_size, stroke = 1.2) +
    ggplot2::scale_colour_gradient(
      low = "#56B4E9", high = "#D55E00", name = "speed (m/s)", breaks = plot_breaks(base_size, 4)
    ) +
    ggplot2::coord_fixed() +
    ggplot2::labs(
      title = wrap_title(sentence(paste("the body", said)), base_size),
      subtitle = wrap_subtitle(paste("a point every", step, "s; the cross: the end"), base_size),
      x = "x (m)", y = "y (m)",
      alt = paste0("A path from (", format_si(signif(path$x[1], 3)), ", ",
                   format_si(signif(path$y[1], 3)), ") m to (", format_si(signif(last$x_m, 3)),
                   ", ", format_si(signif(last$y_m, 3)), ") m: the body ", said, ".")
    ) +
    plot_theme(base_size) +
    ggplot2::theme(legend.key.width = ggplot2::unit(2.2 * base_size, "pt"))
}
