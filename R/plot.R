# Pictures. ggplot2 is a suggestion; its generic is registered when it is there.

# A palette that survives colour blindness and a projector (Okabe & Ito 2008).
plot_colours <- c("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00")

plot_theme <- function() {
  ggplot2::theme_minimal(base_size = 13) +
    ggplot2::theme(
      panel.grid.minor = ggplot2::element_blank(),
      plot.title.position = "plot",
      plot.title = ggplot2::element_text(face = "bold"),
      plot.subtitle = ggplot2::element_text(colour = "grey35"),
      strip.text = ggplot2::element_text(hjust = 0, face = "bold"),
      legend.position = "bottom",
      legend.margin = ggplot2::margin(0, 0, 0, 0),
      legend.key.width = ggplot2::unit(24, "pt")
    )
}

#' Plot a trajectory or a rolling table
#'
#' `autoplot()` of a trajectory draws angle, angular velocity, the three torques and the kinetic
#' energy over time; of a rolling table, the final speed of each object and how its energy is
#' divided.
#'
#' @param object A `rot_trajectory`, or what [rolling_table()] returned.
#' @param ... Not used.
#' @return A ggplot.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(spin_up())
#' ggplot2::autoplot(rolling_table())
#' @name autoplot.rotdyn
NULL

#' @rdname autoplot.rotdyn
#' @exportS3Method ggplot2::autoplot
autoplot.rot_trajectory <- function(object, ...) {
  need_package("ggplot2", "A plot", rlang::current_env())
  run <- trajectory_run(object)
  shape <- run$scene$body$shape
  panels <- c(
    theta_rad = "angle (rad)", omega_rad_per_s = "angular velocity (rad/s)",
    applied_torque_n_m = "torque (N m)", damping_torque_n_m = "torque (N m)",
    net_torque_n_m = "torque (N m)", rotational_kinetic_energy_j = "kinetic energy (J)"
  )
  lines <- c(
    theta_rad = "state", omega_rad_per_s = "state", applied_torque_n_m = "applied",
    damping_torque_n_m = "damping", net_torque_n_m = "net",
    rotational_kinetic_energy_j = "state"
  )
  panels <- panels[names(panels) %in% names(object)]
  n <- nrow(object)
  long <- data.frame(
    time_s = rep(object$time_s, length(panels)),
    value = unlist(lapply(names(panels), function(name) object[[name]]), use.names = FALSE),
    panel = factor(rep(panels, each = n), levels = unique(panels)),
    line = factor(
      rep(lines[names(panels)], each = n), levels = c("applied", "damping", "net", "state")
    )
  )
  ggplot2::ggplot(long, ggplot2::aes(.data$time_s, .data$value, colour = .data$line)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey80") +
    ggplot2::geom_line(ggplot2::aes(linetype = .data$line), linewidth = 0.8) +
    ggplot2::facet_wrap("panel", scales = "free_y", ncol = 2) +
    ggplot2::scale_colour_manual(
      values = c(
        applied = plot_colours[5], damping = plot_colours[2], net = plot_colours[3],
        state = plot_colours[1]
      ),
      breaks = c("applied", "damping", "net"), name = "torque"
    ) +
    # Net is dashed: without damping, or without torque, it lies on one of the others.
    ggplot2::scale_linetype_manual(
      values = c(applied = "solid", damping = "solid", net = "22", state = "solid"),
      breaks = c("applied", "damping", "net"), name = "torque"
    ) +
    ggplot2::labs(
      title = paste("A", gsub("_", " ", shape %||% "body"), "on a fixed axle"),
      subtitle = paste0("model ", run$model, ", relative error ", describe_error(run)),
      x = "time (s)", y = NULL
    ) +
    plot_theme()
}

#' @rdname autoplot.rotdyn
#' @exportS3Method ggplot2::autoplot
autoplot.rot_rolling_table <- function(object, ...) {
  need_package("ggplot2", "A plot", rlang::current_env())
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
    share = c(
      object[["translational_energy_fraction"]], object[["rotational_energy_fraction"]]
    ),
    motion = factor(
      rep(c("translation", "rotation"), each = length(label)),
      levels = c("rotation", "translation")
    )
  )
  speeds <- data.frame(
    label = factor(label, levels = order),
    text = paste(formatC(speed, digits = 3, format = "f"), "m/s")
  )
  ggplot2::ggplot(long, ggplot2::aes(.data$share, .data$label)) +
    ggplot2::geom_col(ggplot2::aes(fill = .data$motion), width = 0.7) +
    ggplot2::geom_text(
      data = speeds, ggplot2::aes(x = 1.02, y = .data$label, label = .data$text),
      hjust = 0, size = 4, colour = "grey25"
    ) +
    ggplot2::scale_x_continuous(
      limits = c(0, 1.25), breaks = seq(0, 1, by = 0.25),
      labels = c("0", "25 %", "50 %", "75 %", "100 %"), expand = c(0, 0)
    ) +
    ggplot2::scale_fill_manual(
      values = c(rotation = plot_colours[2], translation = plot_colours[1]),
      breaks = c("translation", "rotation"), name = NULL
    ) +
    ggplot2::labs(
      title = "What rolls faster puts less into rotation",
      subtitle = "share of the kinetic energy, and the speed at the bottom",
      x = NULL, y = NULL
    ) +
    plot_theme() +
    ggplot2::theme(panel.grid.major.y = ggplot2::element_blank())
}
