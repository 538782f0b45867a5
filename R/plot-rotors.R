#' Plot a motion of several bodies
#'
#' `autoplot()` of the trajectory of a [scene_rotors()] draws the angular velocity of each rotor and
#' the torque of each piece of shaft over time; of a [scene_clutch()], both speeds, the clutch's
#' torque and the heat, with its events.
#'
#' @param object A `rot_motion`.
#' @param ... Not used.
#' @return A ggplot.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' scene <- scene_clutch(2, 3, capacity_n_m = 12, omega1_rad_per_s = 10)
#' ggplot2::autoplot(trajectory(scene, time_s = seq(0, 2, by = 0.02)))
#' @exportS3Method ggplot2::autoplot
autoplot.rot_motion <- function(object, ...) {
  need_package("ggplot2", "A plot", rlang::current_env())
  run <- attr(object, "run", exact = TRUE)
  rotors <- inherits(run$scene, "rot_scene_rotors")
  long <- if (rotors) rotors_lines(object) else clutch_lines(object)
  events <- run$events
  plot <- ggplot2::ggplot(long, ggplot2::aes(.data$time_s, .data$value, colour = .data$line)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey80")
  if (!is.null(events) && nrow(events)) {
    plot <- plot + ggplot2::geom_vline(
      xintercept = events$time_s, colour = "grey55", linetype = "22"
    )
  }
  colours <- rep_len(plot_colours, nlevels(long$line))
  plot +
    ggplot2::geom_line(linewidth = 0.8) +
    ggplot2::facet_wrap("panel", scales = "free_y", ncol = 1) +
    ggplot2::scale_colour_manual(values = colours, drop = FALSE, name = NULL) +
    ggplot2::labs(
      title = if (rotors) "Rotors on one shaft" else "Two bodies and a clutch",
      subtitle = paste0("model ", run$model, ", relative error ", describe_error(run)),
      x = "time (s)", y = NULL
    ) +
    plot_theme()
}

rotors_lines <- function(object) {
  n <- max(object$rotor)
  shafts <- object[["shaft_torque_n_m"]]
  has_shaft <- !is.na(shafts) & object$rotor < n
  line <- paste("rotor", object$rotor)
  data.frame(
    time_s = c(object$time_s, object$time_s[has_shaft]),
    value = c(object$omega_rad_per_s, shafts[has_shaft]),
    panel = factor(
      rep(c("angular velocity (rad/s)", "torque of the shaft behind it (N m)"),
          c(nrow(object), sum(has_shaft))),
      levels = c("angular velocity (rad/s)", "torque of the shaft behind it (N m)")
    ),
    line = factor(c(line, line[has_shaft]), levels = paste("rotor", seq_len(n)))
  )
}

clutch_lines <- function(object) {
  panels <- c("angular velocity (rad/s)", "torque of the clutch (N m)", "heat (J)")
  n <- nrow(object)
  data.frame(
    time_s = rep(object$time_s, 4),
    value = c(
      object$omega_1_rad_per_s, object$omega_2_rad_per_s, object$clutch_torque_n_m, object$heat_j
    ),
    panel = factor(rep(panels, c(2 * n, n, n)), levels = panels),
    line = factor(
      rep(c("body 1", "body 2", "clutch"), c(n, n, 2 * n)),
      levels = c("body 1", "body 2", "clutch")
    )
  )
}
