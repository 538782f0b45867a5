#' Plot a swing fit
#'
#' The samples of the interval with the fitted motion, its residuals, and the period of small swings
#' of each swing by its amplitude, with the fitted one and its 95 % interval as a band. A period
#' that changes with the amplitude, or residuals that swell and fade, show another law.
#'
#' Without a fitted motion (`from` is `"swings"`) there are no residuals. Swings that were not used
#' are open circles.
#'
#' @param object A [fit_swing()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [fit_swing()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' swing <- scene_pendulum(body_rod_end(0.2, 0.6), resistance = resistance(0.002), theta0_rad = 0.8)
#' samples <- trajectory(swing, seq(0, 12, by = 0.04))
#' set.seed(1)
#' samples$theta_rad <- samples$theta_rad + rnorm(nrow(samples), sd = 0.002)
#' fit <- fit_swing(motion_record(samples, time_s = time_s, theta_rad = theta_rad))
#' ggplot2::autoplot(fit)
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept pendulum
autoplot.rot_swing_fit <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_swing_fit(object, "object", call)
  fitted <- !is.null(object$motion)
  angle <- object$kind == "theta_rad"
  unit <- if (angle) "rad" else "rad/s"
  panels <- c(
    paste0(if (angle) "angle" else "angular velocity", " (", unit, "), by time (s)"),
    if (fitted) paste0("residual (", unit, "), by time (s)"),
    "period of small swings (s), by amplitude (rad)"
  )
  last <- panels[length(panels)]
  place <- function(data, panel) {
    if (nrow(data)) data$panel <- factor(panel, panels)
    data
  }
  samples <- object$samples
  points <- place(data.frame(x = samples$time_s, y = samples$measured), panels[1])
  line <- NULL
  if (fitted) {
    rest <- augment.rot_swing_fit(object)$residual
    points <- rbind(points, place(data.frame(x = samples$time_s, y = rest), panels[2]))
    # Forty points a swing, of 2000 at most.
    span <- range(samples$time_s)
    count <- min(ceiling(40 * diff(span) / object$period_s$value), 2000)
    grid <- seq(span[1], span[2], length.out = max(count, 2))
    line <- place(data.frame(x = grid, y = swing_rows(object, grid, call)$value), panels[1])
  }
  swings <- object$swings
  swings <- swings[is.finite(swings$amplitude_rad) & is.finite(swings$period0_s), ]
  # Periods far off are not swings, and would hide the rest.
  near <- abs(swings$period0_s / object$period_s$value - 1) < 0.2 | swings$used
  swings <- swings[near, ]
  marks <- place(data.frame(
    x = swings$amplitude_rad, y = swings$period0_s,
    used = factor(ifelse(swings$used, "used", "not used"), c("used", "not used"))
  ), last)
  period <- object$period_s
  half <- stats::qt(0.975, period$dof) * period$u
  band <- place(data.frame(
    low = period$value - half, high = period$value + half, y = period$value
  ), last)
  zero <- if (fitted) place(data.frame(y = 0), panels[2])
  colour <- plot_colours[1]
  said <- paste0(
    "T0 = ", format(period), " s; the law is ",
    if (object$law_complete) "complete" else "incomplete"
  )
  plot <- ggplot2::ggplot(points, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_rect(
      ggplot2::aes(ymin = .data$low, ymax = .data$high), band, xmin = -Inf, xmax = Inf,
      fill = colour, alpha = 0.25, inherit.aes = FALSE
    ) +
    ggplot2::geom_hline(
      ggplot2::aes(yintercept = .data$y), band, colour = colour, linewidth = 0.05 * base_size
    )
  if (fitted) {
    plot <- plot + ggplot2::geom_hline(
      ggplot2::aes(yintercept = .data$y), zero, colour = "grey60", linewidth = 0.02 * base_size
    ) + ggplot2::geom_line(data = line, colour = colour, linewidth = 0.03 * base_size)
  }
  plot +
    ggplot2::geom_point(colour = "grey35", size = 0.05 * base_size) +
    ggplot2::geom_point(
      ggplot2::aes(shape = .data$used), marks, colour = plot_ink, size = 0.13 * base_size
    ) +
    ggplot2::scale_shape_manual(
      values = c(used = 16, "not used" = 1), drop = FALSE, guide = "none"
    ) +
    ggplot2::facet_wrap(~panel, ncol = 1, scales = "free") +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title("A measured swing: the motion fitted, and its periods", base_size),
      subtitle = wrap_subtitle(said, base_size), x = NULL, y = NULL,
      alt = paste0(
        "The ", if (angle) "angle" else "angular velocity", " swings for ",
        format_si(signif(diff(range(samples$time_s)), 3)), " s",
        if (fitted) paste0(
          " and the fitted motion follows it, with residuals of ",
          format(object$residual, digits = 2), " ", unit
        ),
        "; the periods of ", sum(swings$used), " swings used, of amplitudes ",
        range_in_words(swings$amplitude_rad), " rad, are ", range_in_words(swings$period0_s, 5),
        " s. ", sentence(said), "."
      )
    ) +
    plot_theme(base_size)
}
