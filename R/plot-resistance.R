# What resists a motion, over its speed.

#' Plot a resistance
#'
#' The torque of a resistance over the angular velocity, with its parts: dry friction, viscous and
#' quadratic; a dot is the static friction, at rest. Of a resistance that has drag on a centre of
#' mass alone, the force over the speed; of damping of a body in space, the rate.
#'
#' @param object A [resistance()].
#' @inheritParams autoplot.rot_trajectory
#' @param largest The largest angular velocity (rad/s) or speed (m/s), greater than 0; NULL for one
#'   at which the parts are about equal, or 10.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where nothing resists.
#' @seealso [resistance()], [autoplot.rot_torque()].
#' @concept plot
#' @concept friction
#' @concept drag
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(resistance(0.03, quadratic_n_m_s2 = 0.002, coulomb_n_m = 0.1))
#' @exportS3Method ggplot2::autoplot
autoplot.rot_resistance <- function(object, ..., largest = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  of <- function(name) resistance_value(object, name)
  parts <- c(
    "dry friction" = of("coulomb_n_m"), viscous = of("viscous_n_m_s"),
    quadratic = of("quadratic_n_m_s2")
  )
  labels <- c("angular velocity (rad/s)", "torque against it (N m)")
  static <- of("static_n_m")
  if (all(parts == 0)) {
    parts <- c(linear = of("drag_n_s_per_m"), quadratic = of("drag_n_s2_per_m2"))
    labels <- c("speed (m/s)", "force against it (N)")
    static <- 0
    if (all(parts == 0) && of("damping_per_s") != 0) {
      parts <- c(damping = of("damping_per_s"))
      labels <- c("angular momentum (kg m^2/s)", "torque against it (N m)")
    }
    power <- c(linear = 1, quadratic = 2, damping = 1)[names(parts)]
  } else {
    power <- 0:2
  }
  shown <- parts != 0
  if (!any(shown)) abort_rotdyn("Nothing resists: there is nothing to draw.", "value", call)
  power <- power[shown]
  parts <- parts[shown]
  if (is.null(largest)) {
    # Where the highest power equals the lowest one, a round number.
    k <- length(parts)
    largest <- if (k > 1L) 1.5 * (abs(parts[1] / parts[k]))^(1 / (power[k] - power[1])) else 10
    largest <- signif(largest, 1)
    if (!is.finite(largest) || largest <= 0) largest <- 10
  } else {
    largest <- check_number(largest, "largest", "1", call, lower = 0, open = TRUE)
  }
  speed <- seq(-largest, largest, length.out = 402L) # not at rest
  lines <- lapply(seq_along(parts), function(j) {
    data.frame(
      x = speed, y = sign(speed) * parts[[j]] * abs(speed)^power[[j]], part = names(parts)[j]
    )
  })
  all <- do.call(rbind, lines)
  if (length(parts) > 1L) {
    whole <- Reduce(`+`, lapply(lines, `[[`, "y"))
    all <- rbind(all, data.frame(x = speed, y = whole, part = "together"))
  }
  all$part <- factor(all$part, unique(all$part))
  n <- nlevels(all$part)
  colours <- c(plot_colours[c(2, 3, 4)][seq_along(parts)], plot_ink)[seq_len(n)]
  values <- paste(names(parts), format_si(signif(parts, 4)), collapse = ", ")
  plot <- ggplot2::ggplot(all, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey70") +
    ggplot2::geom_vline(xintercept = 0, colour = "grey70") +
    # A jump at rest is no line.
    ggplot2::geom_line(
      ggplot2::aes(
        colour = .data$part, linetype = .data$part, group = paste(.data$part, .data$x > 0)
      ), linewidth = 0.055 * base_size
    ) +
    ggplot2::scale_colour_manual(values = colours, name = NULL) +
    ggplot2::scale_linetype_manual(values = rev(c("solid", "42", "13", "4213")[seq_len(n)]),
                                   name = NULL) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size)) +
    ggplot2::labs(
      title = wrap_title("A resistance", base_size), x = labels[1], y = labels[2],
      alt = paste0("Lines of the ", labels[2], " over the ", labels[1], ": ", values, ".")
    ) +
    plot_theme(base_size)
  if (static > parts[1] && names(parts)[1] == "dry friction") {
    plot <- plot + ggplot2::geom_point(
      data = data.frame(x = c(0, 0), y = c(-1, 1) * static), size = 0.2 * base_size
    )
  }
  plot
}

resistance_value <- function(object, name) {
  x <- .subset2(object, name)
  if (is.null(x)) 0 else as.double(x)
}

#' Plot a moment of inertia over time
#'
#' The moment of inertia of knots, constant before the first and after the last one.
#'
#' @param object An [inertia_knots()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [inertia_knots()].
#' @concept plot
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(inertia_knots(c(1, 2), c(5, 2)))
#' @exportS3Method ggplot2::autoplot
autoplot.rot_inertia_knots <- function(object, ..., base_size = 13) {
  check_plot(base_size, ...)
  time <- object$time_s
  value <- object$moment_of_inertia_kg_m2
  n <- length(time)
  gap <- if (n > 1L && time[n] > time[1]) 0.15 * (time[n] - time[1]) else 1
  line <- data.frame(
    x = c(time[1] - gap, time, time[n] + gap), y = c(value[1], value, value[n])
  )
  ggplot2::ggplot(line, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_line(colour = plot_colours[1], linewidth = 0.055 * base_size) +
    ggplot2::geom_point(
      data = data.frame(x = time, y = value), size = 0.2 * base_size, colour = plot_colours[1]
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size), limits = c(0, NA)) +
    ggplot2::labs(
      title = wrap_title("A moment of inertia that changes", base_size), x = "time (s)",
      y = "moment of inertia (kg m^2)",
      alt = paste0("A line of the moment of inertia ", describe_inertia_knots(object), ".")
    ) +
    plot_theme(base_size)
}
