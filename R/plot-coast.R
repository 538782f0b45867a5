#' Plot a coast-down fit
#'
#' Three panels: the fitted angular velocity with its band (with the measured rates, where rates
#' were measured), the residuals, and the retarding torque by speed with its band.
#'
#' @param object A [fit_coast_down()].
#' @inheritParams autoplot.rot_trajectory
#' @param run Number or name of the run of the first two panels.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [fit_coast_down()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' set.seed(1)
#' time_s <- 0:80 / 10
#' samples <- data.frame(time_s, omega_rad_per_s = 21 * exp(-0.1 * time_s) - 1 + rnorm(81, 0, 0.02))
#' ggplot2::autoplot(fit_coast_down(samples, losses = c("coulomb", "viscous")))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept coast-down
autoplot.rot_coast_fit <- function(object, ..., run = 1, base_size = 13) {
  call <- check_plot(base_size, ...)
  fit <- coast_fit(object, "object", call)
  i <- check_run(run, fit, call)
  at <- fit$runs[[i]]
  torque <- retarding_torque(object)
  unit <- c("rad", "rad/s", "s")[at$kind + 1]
  panels <- c(
    "angular velocity (rad/s), by time (s)",
    paste0("residual (", unit, "), by time (s)"),
    paste(
      if (is.na(coast_inertia(fit))) "deceleration (rad/s^2)," else "retarding torque (N m),",
      "by angular velocity (rad/s)"
    )
  )
  samples <- augment.rot_coast_fit(object)
  samples <- samples[samples$run == at$name, ]
  grid <- seq(at$time_s[1], at$time_s[length(at$time_s)], length.out = 201)
  motion <- predict.rot_coast_fit(object, grid, run = i)
  line <- data.frame(
    x = c(grid, torque$omega_rad_per_s), y = c(motion$omega_rad_per_s, torque[[2]]),
    lower = c(motion$omega_rad_per_s_lower, torque$lower),
    upper = c(motion$omega_rad_per_s_upper, torque$upper),
    panel = factor(panels[rep(c(1, 3), c(201, nrow(torque)))], panels)
  )
  points <- data.frame(x = samples$time_s, y = samples$residual, panel = factor(panels[2], panels))
  if (at$kind == 1) {
    points <- rbind(
      points,
      data.frame(x = samples$time_s, y = samples$measured, panel = factor(panels[1], panels))
    )
  }
  zero <- data.frame(y = 0, panel = factor(panels[2], panels))
  colour <- plot_colours[1]
  rows <- unclass(object)
  said <- paste(rows$loss, rows$status, collapse = ", ")
  ggplot2::ggplot(line, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_hline(
      ggplot2::aes(yintercept = .data$y), zero, colour = "grey60", linewidth = 0.02 * base_size
    ) +
    ggplot2::geom_point(data = points, colour = "grey45", size = 0.05 * base_size) +
    ggplot2::geom_ribbon(
      ggplot2::aes(ymin = .data$lower, ymax = .data$upper), fill = colour, alpha = 0.25
    ) +
    ggplot2::geom_line(colour = colour, linewidth = 0.05 * base_size) +
    ggplot2::facet_wrap(~panel, ncol = 1, scales = "free") +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4)) +
    ggplot2::labs(
      title = wrap_title("Coast-down: the motion fitted, and what it leaves over", base_size),
      subtitle = wrap_subtitle(said, base_size), x = NULL, y = NULL,
      alt = paste0(
        "The fitted angular velocity falls from ", format_si(signif(motion$omega_rad_per_s[1], 3)),
        " to ", format_si(signif(motion$omega_rad_per_s[201], 3)), " rad/s; residuals of ",
        format(at$numbers[["sigma"]], digits = 2), " ", unit, "; losses: ", said, "."
      )
    ) +
    plot_theme(base_size)
}

#' Draw a falling weight
#'
#' A weight on the string of a drum, as it drives a coast-down: the force on it and the torque on
#' the drum while the drum does not accelerate.
#'
#' @param object From [falling_weight()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`.
#' @seealso [falling_weight()], [fit_coast_down()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(falling_weight(mass_kg = 0.5, radius_m = 0.02, until_s = 3))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
autoplot.rot_falling_weight <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, falling_weight_form, "object", "falling weight", call)
  d <- new_drawing()
  d$add(mark("fill", draw_circle(0, 0, 1), "body"))
  d$add(mark("fill", draw_circle(0, 0, 0.6), "shaft"))
  d$add(mark("line", rbind(c(0, 0), c(-0.6, 0)), "body"))
  d$add(mark("fill", draw_circle(0, 0, 0.06), "fixed"))
  d$add(mark("line", rbind(c(-0.6, 0), c(-0.6, -1.4)), "spring"))
  d$add(mark("fill", draw_box(-0.6, -1.55, 0.34, 0.3), "body"))
  d$add(mark("arrow", rbind(c(-0.6, -1.55), c(-0.6, -2.15)), "weight"))
  d$add(turn_arrow(0, 0, 1.16, 110, 50, 1, "torque"))
  d$say("r", -0.3, 0.13)
  d$say("m", -0.93, -1.55)
  d$say("m*g", -0.24, -2.05)
  d$say("tau", -0.96, 1)
  known <- function(x, unit) if (is.na(x)) "is fitted" else value_text(x, unit)
  mass <- object$mass_kg
  weight <- mass * object$gravity_m_per_s2
  d$key(quantity("m", "mass", known(mass, "kg")))
  d$key(quantity("r", "radius of the drum", known(object$radius_m, "m")))
  d$key(quantity("m*g", "weight", known(weight, "N"), "weight"))
  d$key(quantity("tau", "torque, at most", known(weight * object$radius_m, "N m"), "torque"))
  end <- object$until_s
  d$key(quantity("", "pulls", if (is.na(end)) "until a time that is fitted" else
    paste("until", value_text(end, "s"))))
  draw(d$done(c(-1.5, 1.5, -2.3, 1.4), "not to scale"), "A falling weight on a drum", base_size)
}
