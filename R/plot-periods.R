#' Plot pooled periods
#'
#' The mean of each group with its standard error inside (thick) and with the error between groups
#' (thin), over the pooled period with its 95 % interval as a band. Groups left out are crosses;
#' those beyond the plot, as miscounts are, stand at its edge with their value.
#'
#' @param object Pooled periods, from [pool_periods()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`.
#' @seealso [pool_periods()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' times <- c(17.63, 17.48, 17.59, 17.64, 17.71, 17.69, 17.66, 17.74, 17.52, 17.49, 17.55, 17.50)
#' pooled <- pool_periods(times, swings = 10, group = rep(c("A", "B", "C"), each = 4))
#' ggplot2::autoplot(pooled)
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept stopwatch
autoplot.rot_pooled_periods <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_pooled_periods(object, "object", call)
  groups <- object$groups
  period <- object$period_s
  half <- if (period$u > 0) stats::qt(0.975, period$dof) * period$u else 0
  used <- groups$status == "used"
  total <- sqrt(groups$u_s^2 + object$between_s^2)
  name <- factor(as.character(groups$group), rev(unique(as.character(groups$group))))
  ends <- range(
    groups$period_s[used] - total[used], groups$period_s[used] + total[used],
    period$value - half, period$value + half
  )
  room <- max(diff(ends), 1e-6 * period$value)
  far <- groups$period_s < ends[1] - room | groups$period_s > ends[2] + room
  at <- pmin(pmax(groups$period_s, ends[1] - 0.25 * room), ends[2] + 0.25 * room)
  points <- data.frame(x = ifelse(far, at, groups$period_s), group = name, used = used)
  bars <- data.frame(
    group = name, low = groups$period_s - groups$u_s, high = groups$period_s + groups$u_s,
    all_low = groups$period_s - total, all_high = groups$period_s + total
  )[!far, ]
  labels <- data.frame(
    x = at, group = name, left = groups$period_s > period$value,
    text = paste0(format_si(signif(groups$period_s, 4)), " s, ", groups$status)
  )[far, ]
  said <- paste0(
    "T = ", format(period), " s from ", sum(used), " of ", nrow(groups), " groups; ",
    format_si(object$between_s, 2), " s between groups"
  )
  colour <- plot_colours[1]
  ggplot2::ggplot(points, ggplot2::aes(.data$x, .data$group)) +
    ggplot2::annotate(
      "rect", xmin = period$value - half, xmax = period$value + half, ymin = -Inf, ymax = Inf,
      fill = colour, alpha = 0.2
    ) +
    ggplot2::geom_vline(
      xintercept = period$value, colour = colour, linewidth = 0.05 * base_size
    ) +
    ggplot2::geom_segment(
      ggplot2::aes(x = .data$all_low, xend = .data$all_high, yend = .data$group), bars,
      colour = "grey45", linewidth = 0.03 * base_size
    ) +
    ggplot2::geom_segment(
      ggplot2::aes(x = .data$low, xend = .data$high, yend = .data$group), bars, colour = plot_ink,
      linewidth = 0.09 * base_size
    ) +
    ggplot2::geom_point(
      ggplot2::aes(shape = .data$used, colour = .data$used), size = 0.2 * base_size, stroke = 1
    ) +
    ggplot2::geom_text(
      ggplot2::aes(label = .data$text, hjust = ifelse(.data$left, 1.1, -0.1)), labels,
      colour = plot_ink, size = text_size(base_size)
    ) +
    ggplot2::scale_shape_manual(values = c("TRUE" = 16, "FALSE" = 4), guide = "none") +
    ggplot2::scale_colour_manual(
      values = c("TRUE" = plot_ink, "FALSE" = plot_colours[2]), guide = "none"
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title("Periods timed in groups, and pooled", base_size),
      subtitle = wrap_subtitle(said, base_size), x = "period (s)", y = NULL,
      alt = paste0(
        "The periods of ", sum(used), " groups are ", range_in_words(groups$period_s[used], 4),
        " s. ", said, ".", if (any(!used)) paste0(
          " Left out: ", paste0(
            "group ", groups$group[!used], " with ", format_si(signif(groups$period_s[!used], 4)),
            " s, ", groups$status[!used], collapse = "; "
          ), "."
        )
      )
    ) +
    plot_theme(base_size)
}

#' Plot pivots
#'
#' The periods of a pendulum over the distance of its pivots, and the period of the fitted radius of
#' gyration and acceleration of gravity. Pivots left out are crosses.
#'
#' @param object From [fit_pivots()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`.
#' @seealso [fit_pivots()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(fit_pivots(c(1.566, 1.526, 1.601, 1.568, 1.637), c(0.2, 0.3, 0.4, 0.16, 0.5)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept physical pendulum
autoplot.rot_pivots <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  pivots <- .subset2(object, "pivots")
  k2 <- .subset2(object, "gyration_square_m2")
  g <- .subset2(object, "gravity_m_per_s2")
  fits <- is.data.frame(pivots) && is.numeric(pivots[["distance_m"]]) &&
    is.numeric(pivots[["period_s"]]) && is.character(pivots[["status"]]) && nrow(pivots) > 0L
  if (!fits) abort_form("pivots", "object", "fit of pivots", call)
  check_measured(k2, "object$gyration_square_m2", call)
  check_measured(g, "object$gravity_m_per_s2", call)
  points <- data.frame(
    x = pivots$distance_m, y = pivots$period_s, used = pivots$status == "used"
  )
  ends <- range(points$x)
  d <- seq(max(ends[1] - 0.08 * diff(ends), 0.5 * ends[1]), ends[2] + 0.08 * diff(ends),
           length.out = 201L)
  line <- data.frame(x = d, y = 2 * pi * sqrt((k2$value + d^2) / (g$value * d)))
  said <- paste0("k^2 = ", format(k2), " m^2, g = ", format(g), " m/s^2")
  out <- points[!points$used, ]
  ggplot2::ggplot(points, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_line(data = line, colour = plot_colours[1], linewidth = 0.06 * base_size) +
    ggplot2::geom_point(
      ggplot2::aes(shape = .data$used, colour = .data$used), size = 0.25 * base_size, stroke = 1.2
    ) +
    ggplot2::scale_shape_manual(
      values = c("TRUE" = 16, "FALSE" = 4), breaks = c("TRUE", "FALSE"),
      labels = c("used", "left out"), name = NULL, guide = if (nrow(out)) "legend" else "none"
    ) +
    ggplot2::scale_colour_manual(
      values = c("TRUE" = plot_ink, "FALSE" = plot_colours[2]), breaks = c("TRUE", "FALSE"),
      labels = c("used", "left out"), name = NULL, guide = if (nrow(out)) "legend" else "none"
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size)) +
    ggplot2::labs(
      title = wrap_title("Periods about several pivots, and the fit", base_size),
      subtitle = wrap_subtitle(said, base_size), x = "distance from pivot to centre of mass (m)",
      y = "period (s)",
      alt = paste0(
        nrow(points), " periods, ", range_in_words(points$y), " s, over distances of ",
        range_in_words(points$x), " m, and a fitted line: ", said, ".", if (nrow(out)) paste0(
          " Left out: the pivot at ", paste(format_si(signif(out$x, 4)), collapse = ", "), " m."
        )
      )
    ) +
    plot_theme(base_size)
}
