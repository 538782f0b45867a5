# Plots. ggplot2 is suggested; the methods are registered when it is loaded.

# A palette for colour-blind readers and projectors (Okabe & Ito 2008).
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
#' `autoplot()` of a trajectory draws the state, the torques and the energies of its scene over
#' time, with its events as dashed lines: of an axle, angle, angular velocity, the three torques and
#' the kinetic energy; of rotors, the angular velocity of each and the torque of each piece of
#' shaft; of a clutch, both angular velocities, the torque of the clutch and the heat. Of a rolling
#' table it draws the final speed of each object and how its energy is divided.
#'
#' @param object A `rot_trajectory`, or what [rolling_table()] returned.
#' @param ... Not used.
#' @return A ggplot.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(spin_up())
#' ggplot2::autoplot(rolling_table())
#' scene <- scene_clutch(2, 3, capacity_n_m = 12, omega1_rad_per_s = 10)
#' ggplot2::autoplot(trajectory(scene, time_s = seq(0, 2, by = 0.02)))
#' @name autoplot.rotdyn
NULL

#' @rdname autoplot.rotdyn
#' @exportS3Method ggplot2::autoplot
autoplot.rot_trajectory <- function(object, ...) {
  need_package("ggplot2", "A plot", rlang::current_env())
  run <- trajectory_run(object)
  constraint <- constraint_of(run$scene)
  long <- panel_lines(object, constraint)
  lines <- setdiff(levels(long$line), "")
  colours <- stats::setNames(c(plot_colours[1], line_colours(lines)), c("", lines))
  # "net" is dashed: it may coincide with another line.
  types <- stats::setNames(ifelse(names(colours) == "net", "22", "solid"), names(colours))
  plot <- ggplot2::ggplot(long, ggplot2::aes(.data$time_s, .data$value, colour = .data$line)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey80")
  if (length(run$events$time_s)) {
    plot <- plot + ggplot2::geom_vline(
      xintercept = run$events$time_s, colour = "grey55", linetype = "22"
    )
  }
  plot +
    ggplot2::geom_line(ggplot2::aes(linetype = .data$line), linewidth = 0.8) +
    ggplot2::facet_wrap(
      "panel", scales = "free_y", ncol = if (length(constraint$panels) > 3L) 2 else 1
    ) +
    ggplot2::scale_colour_manual(values = colours, breaks = lines, name = NULL) +
    ggplot2::scale_linetype_manual(values = types, breaks = lines, name = NULL) +
    ggplot2::labs(
      title = constraint$title(run),
      subtitle = paste0("model ", run$model, ", relative error ", describe_error(run)),
      x = "time (s)", y = NULL
    ) +
    plot_theme()
}

line_colours <- function(lines) {
  named <- c(applied = plot_colours[5], damping = plot_colours[2], net = plot_colours[3])
  if (all(lines %in% names(named))) named[lines] else rep_len(plot_colours, length(lines))
}

# The columns of the panels in long form: time_s, value, panel, line. Where rows have an index, each
# value of it is a line.
panel_lines <- function(object, constraint) {
  index <- constraint$index
  parts <- lapply(constraint$panels, function(panel) {
    columns <- panel$columns[names(panel$columns) %in% names(object)]
    lapply(names(columns), function(name) {
      value <- object[[name]]
      line <- if (is.null(index)) columns[[name]] else paste(index, object[[index]])
      part <- data.frame(
        time_s = object$time_s, value = value, panel = rep(panel$label, length(value)), line = line
      )
      part[!is.na(value), ]
    })
  })
  long <- do.call(rbind, unlist(parts, recursive = FALSE))
  for (name in c("panel", "line")) long[[name]] <- factor(long[[name]], unique(long[[name]]))
  long
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
