# Paths in a plane: a disk that rolls on a floor, a ball on a turntable, Foucault's pendulum.

#' Plot a path in a plane
#'
#' The path of a rolling disk's contact, of a ball on a turntable, or of Foucault's pendulum, from
#' above: a dot where it starts, a cross where it ends. Of the disk, its rim at some times; of the
#' turntable, the circle that the ball goes round. Both axes have one scale, unless the path is more
#' than twelve times as long as wide.
#'
#' @param object What [roll_disk()], [ball_on_turntable()] or [foucault_pendulum()] returned, with
#'   rows for two times or more.
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type` where columns are missing, `rotdyn_error_value` for fewer than two rows
#'   with numbers.
#' @seealso [roll_disk()], [ball_on_turntable()], [foucault_pendulum()].
#' @concept plot
#' @concept path
#' @concept rolling disk
#' @name autoplot.paths
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' coin <- roll_disk(body_disk(0.5, 0.04), seq(0, 2, 0.01), spin_rad_per_s = 20, lean_deg = 10)
#' ggplot2::autoplot(coin)
#' ggplot2::autoplot(foucault_pendulum(seq(0, 300, 0.2), 49, length_m = 67, east_m = 3))
NULL

#' @rdname autoplot.paths
#' @exportS3Method ggplot2::autoplot
autoplot.rot_rolled_disk <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  columns <- path_rows(object, c("contact_x_m", "contact_y_m", "x_m", "y_m", quaternion_columns),
                       call)
  n <- length(columns$x_m)
  shown <- unique(round(seq(1, n, length.out = min(n, 9L))))
  turned <- as.matrix(attitude_to(as.data.frame(columns[quaternion_columns])[shown, ], "matrix"))
  # The radius is the distance of the centre from the contact.
  radius <- sqrt((columns$x_m - columns$contact_x_m)^2 + (columns$y_m - columns$contact_y_m)^2 +
    path_rows(object, "z_m", call)$z_m[1]^2)[1]
  rims <- do.call(rbind, lapply(seq_along(shown), function(k) {
    turn <- matrix(turned[k, ], 3L, byrow = TRUE)
    rim <- ring(radius) %*% t(turn)
    data.frame(x = columns$x_m[shown[k]] + rim[, 1], y = columns$y_m[shown[k]] + rim[, 2], id = k)
  }))
  plot_path(
    columns$contact_x_m, columns$contact_y_m, "A disk rolls on a floor, from above",
    c("x (m)", "y (m)"), "the path of the contact; the rim at some times", base_size,
    behind = list(ggplot2::geom_polygon(
      ggplot2::aes(group = .data$id), rims, fill = NA, colour = "grey55", linewidth = 0.4
    ))
  )
}

#' @rdname autoplot.paths
#' @exportS3Method ggplot2::autoplot
autoplot.rot_turntable <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  columns <- path_rows(object, c("x_m", "y_m", "circle_x_m", "circle_y_m", "circle_radius_m"), call)
  behind <- list()
  if (is.finite(columns$circle_radius_m[1])) {
    circle <- ring(columns$circle_radius_m[1])
    circle <- data.frame(
      x = columns$circle_x_m[1] + circle[, 1], y = columns$circle_y_m[1] + circle[, 2]
    )
    behind <- list(ggplot2::geom_path(data = circle, colour = "grey65", linetype = "22"))
  }
  axle <- data.frame(x = 0, y = 0)
  behind <- c(behind, list(ggplot2::geom_point(data = axle, shape = 3, size = 4)))
  plot_path(
    columns$x_m, columns$y_m, "A ball on a turntable, from above", c("x (m)", "y (m)"),
    "dashed: the circle of the path; plus: the axle of the turntable", base_size, behind
  )
}

#' @rdname autoplot.paths
#' @exportS3Method ggplot2::autoplot
autoplot.rot_foucault <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  columns <- path_rows(object, c("east_m", "north_m"), call)
  plot_path(
    columns$east_m, columns$north_m, "Foucault's pendulum, from above",
    c("east (m)", "north (m)"), NULL, base_size
  )
}

# The columns where all of them are finite or infinite at least, as a list.
path_rows <- function(object, names, call) {
  for (name in names) if (!is.double(object[[name]])) abort_missing_column(name, object, call)
  rows <- as.data.frame(unclass(object)[names])
  rows <- rows[!is.na(rows[[1]]) & !is.na(rows[[min(2L, length(rows))]]), , drop = FALSE]
  if (nrow(rows) < 2L) abort_rotdyn("A path needs rows for two times or more.", "value", call)
  as.list(rows)
}

plot_path <- function(x, y, title, labels, subtitle, base_size, behind = list()) {
  path <- data.frame(x = x, y = y)
  n <- nrow(path)
  ends <- format_si(signif(c(x[1], y[1], x[n], y[n]), 3))
  spans <- c(diff(range(x)), diff(range(y)))
  flat <- min(spans) > 0 && min(spans) < max(spans) / 12
  if (flat) subtitle <- paste(c(subtitle, "each axis in its own scale"), collapse = "; ")
  plot <- ggplot2::ggplot(path, ggplot2::aes(.data$x, .data$y))
  for (one in behind) plot <- plot + one
  plot +
    ggplot2::geom_path(colour = plot_colours[1], linewidth = 0.035 * base_size) +
    ggplot2::geom_point(data = path[1, ], size = 0.2 * base_size) +
    ggplot2::geom_point(data = path[n, ], shape = 4, size = 0.3 * base_size, stroke = 1.2) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size)) +
    (if (!flat) ggplot2::coord_equal()) +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(subtitle, base_size),
      x = labels[1], y = labels[2],
      alt = paste0(
        title, ". A path from (", ends[1], ", ", ends[2], ") m to (", ends[3], ", ", ends[4],
        ") m, between ", range_in_words(x), " m across and ", range_in_words(y), " m up."
      )
    ) +
    plot_theme(base_size)
}
