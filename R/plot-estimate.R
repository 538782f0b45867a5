#' Plot a measured motion
#'
#' Four panels over time: the angle, the angular velocity, the angular acceleration (or with an
#' inertia the net torque), each with the band of its interval, and the leave-one-out residuals of
#' the samples in standard deviations. Breaks are dashed lines, samples that were left out are
#' crosses. A band is drawn at the estimate's `level`, for each time alone.
#'
#' Samples are drawn where they are: in the panel of the angle or of the rate. Residuals beyond 6
#' standard deviations are drawn at the edge.
#'
#' @param object A `rot_estimate`, from [estimate_motion()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_unit`.
#' @seealso [estimate_motion()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' time <- seq(0, 4, by = 0.05)
#' set.seed(1)
#' record <- data.frame(
#'   time_s = time, theta_rad = 2 * time + 6 * pmax(time - 2, 0) + stats::rnorm(81, sd = 0.01)
#' )
#' ggplot2::autoplot(estimate_motion(record))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept measured motion
autoplot.rot_estimate <- function(object, ..., units = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  fit <- check_estimate(object, "object", call)
  units <- check_plot_units(units, call)
  with_torque <- !is.null(fit$asked$inertia) && !is.null(object[["net_torque_n_m"]])
  panels <- list(
    c("angle (rad)", "theta", "rad"), c("angular velocity (rad/s)", "omega", "rad_per_s"),
    if (with_torque) c("net torque (N m)", "net_torque", "n_m") else
      c("angular acceleration (rad/s^2)", "alpha", "rad_per_s2")
  )
  labels <- lapply(panels, function(panel) in_plot_unit(panel[1], units))
  residual_label <- "residual (standard deviations)"
  levels <- c(vapply(labels, `[[`, "", "label"), residual_label)
  time <- in_plot_unit("time (s)", units)
  parts <- estimate_residuals(fit)
  left <- matrix(fit$left_out, nrow(object))
  # A line is not drawn across a break or between segments.
  breaks <- fit$breaks
  piece <- vapply(seq_len(nrow(object)), function(i) {
    sum(breaks$segment == object$segment[i] & breaks$time_s <= object$time_s[i])
  }, 0L)
  piece <- interaction(object$segment, piece, drop = TRUE)
  # Nearer to a break than the error of its time a row may lie on either side: no band is drawn.
  either <- vapply(seq_len(nrow(object)), function(i) {
    any(breaks$segment == object$segment[i] &
      abs(breaks$time_s - object$time_s[i]) < 2 * fit$break_se_s)
  }, NA)
  long <- do.call(rbind, lapply(seq_along(panels), function(i) {
    column <- function(what) {
      object[[paste0(panels[[i]][2], what, "_", panels[[i]][3])]] * labels[[i]]$factor
    }
    data.frame(
      panel = levels[i], time = object$time_s * time$factor, piece = piece, value = column(""),
      low = ifelse(either, column(""), column("_low")),
      high = ifelse(either, column(""), column("_high"))
    )
  }))
  dots <- function(name, i, channel) {
    if (is.null(parts[[name]])) return(NULL)
    data.frame(
      panel = levels[i], time = object$time_s * time$factor,
      value = parts[[name]] * labels[[i]]$factor, left = left[, channel]
    )
  }
  rest <- function(name, channel) {
    if (is.null(parts[[name]])) return(NULL)
    data.frame(
      panel = residual_label, time = object$time_s * time$factor,
      value = pmin(pmax(parts[[name]], -6), 6), left = left[, channel]
    )
  }
  samples <- rbind(
    dots("theta_sample_rad", 1, 1), dots("omega_sample_rad_per_s", 2, 2),
    rest("theta_residual", 1), rest("omega_residual", 2)
  )
  samples <- samples[is.finite(samples$value), ]
  long$panel <- factor(long$panel, levels)
  samples$panel <- factor(samples$panel, levels)
  events <- data.frame(time = breaks$time_s * time$factor)
  small <- 0.06 * base_size * min(1, sqrt(300 / nrow(object)))
  ggplot2::ggplot(long, ggplot2::aes(.data$time, .data$value)) +
    ggplot2::geom_vline(
      ggplot2::aes(xintercept = .data$time), events, colour = "grey55", linetype = "22"
    ) +
    ggplot2::geom_hline(
      ggplot2::aes(yintercept = .data$value),
      data.frame(panel = factor(residual_label, levels), value = 0), colour = "grey80"
    ) +
    ggplot2::geom_point(
      data = samples[!samples$left, ], colour = plot_colours[7], alpha = 0.35, size = small,
      shape = 16
    ) +
    ggplot2::geom_ribbon(
      ggplot2::aes(ymin = .data$low, ymax = .data$high, group = .data$piece),
      fill = plot_colours[6], alpha = 0.45
    ) +
    ggplot2::geom_line(
      ggplot2::aes(group = .data$piece), colour = plot_colours[1], linewidth = 0.05 * base_size
    ) +
    ggplot2::geom_point(
      data = samples[samples$left, ], colour = plot_colours[2], shape = 4, size = 0.16 * base_size,
      stroke = 0.9
    ) +
    ggplot2::facet_wrap(
      "panel", scales = "free_y", ncol = 2, labeller = ggplot2::as_labeller(function(x) {
        vapply(
          x, wrap_label, "", size = 0.75 * base_size,
          width_in = (6.8 - 0.03 * base_size) / 2 - 0.03 * base_size
        )
      })
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title(estimate_title(fit), base_size),
      subtitle = wrap_subtitle(estimate_subtitle(fit, time$factor, time$label), base_size),
      x = time$label, y = NULL, alt = estimate_alt(fit, object, levels, with_torque)
    ) +
    plot_theme(base_size)
}

estimate_title <- function(fit) {
  paste0("Measured motion, with bands of ", format(100 * fit$asked$level), " %")
}

estimate_subtitle <- function(fit, factor, label) {
  events <- fit$events
  left <- sum(fit$left_out)
  unit <- sub("^.*\\((.*)\\)$", "\\1", label)
  parts <- c(
    if (NROW(events)) {
      shown <- utils::head(seq_len(nrow(events)), 3)
      paste0(
        paste0(
          events$event[shown], " at ", format_si(signif(events$time_s[shown] * factor, 4)), " ",
          unit, collapse = ", "
        ),
        if (nrow(events) > 3L) ", ..."
      )
    },
    if (left > 0) paste0(left, " sample", if (left > 1) "s", " left out (crosses)")
  )
  if (length(parts)) paste(parts, collapse = "; ")
}

estimate_alt <- function(fit, object, levels, with_torque) {
  span <- function(x) paste(format_si(signif(range(x), 3)), collapse = " to ")
  third <- if (with_torque) object$net_torque_n_m else object$alpha_rad_per_s2
  paste0(
    "Four panels over time with bands of uncertainty: angle from ", span(object$theta_rad),
    " rad, angular velocity from ", span(object$omega_rad_per_s), " rad/s, ",
    if (with_torque) "net torque" else "angular acceleration", " from ", span(third),
    if (with_torque) " N m" else " rad/s^2", ", residuals of the samples. ",
    if (NROW(fit$events)) {
      paste0(
        "Breaks: ",
        paste0(fit$events$event, " at ", format_si(signif(fit$events$time_s, 4)), " s",
               collapse = ", "), ". "
      )
    },
    sum(fit$left_out), " samples were left out."
  )
}
