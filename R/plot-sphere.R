#' Plot the path of an axis, or a polhode
#'
#' The path of [axis_path()] on the unit sphere, with the vertical; the path of [polhode()] on the
#' ellipsoid of constant energy, with the principal axes (1: the least moment) and the separatrix.
#' Seen from 30 degrees beside x and 25 degrees above: what lies behind is pale. A dot marks the
#' start.
#'
#' @param object A path, from [axis_path()] or [polhode()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type` where columns were removed, `rotdyn_error_value` where there is nothing to
#'   draw.
#' @seealso [axis_path()], [polhode()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(polhode(scene_free(c(1, 2, 3), c(0.3, 4, 0.3))))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept path of the axis
#' @name autoplot.rot_axis_path
autoplot.rot_axis_path <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  for (name in axis_path_columns) {
    if (is.null(object[[name]])) abort_missing_column(name, object, call)
  }
  path <- do.call(cbind, unclass(object)[axis_path_columns[1:3]])
  path <- drawn_rows(path, call)
  circle <- closed_circle()
  grid <- c(
    lapply(c(-60, -30, 0, 30, 60) * pi / 180, function(up) {
      cbind(cos(up) * circle, sin(up))
    }),
    lapply(seq(0, 150, by = 30) * pi / 180, function(round) {
      cbind(cos(round) * circle[, 1], sin(round) * circle[, 1], circle[, 2])
    })
  )
  tilt <- object[[axis_path_columns[4]]] * 180 / pi
  turned <- object[[axis_path_columns[5]]]
  turned <- turned[is.finite(turned)]
  span <- if (length(turned)) (turned[length(turned)] - turned[1]) / (2 * pi) else 0
  said <- paste0(
    "angle to the vertical ", range_in_words(tilt), " degrees, ",
    format_si(signif(span, 3)), " turns about it"
  )
  surface_plot(
    diag(3), grid, list(path), colours = plot_colours[1], labels = list(list(c(0, 0, 1), "up")),
    title = "Path of the axis on the unit sphere", said = said, base_size = base_size
  )
}

#' @rdname autoplot.rot_axis_path
#' @exportS3Method ggplot2::autoplot
autoplot.rot_polhode <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  run <- check_trajectory(object, "object", call)
  for (name in free_rates("")) if (is.null(object[[name]])) abort_missing_column(name, object, call)
  scene <- run$scene
  own <- do.call(cbind, unclass(object)[free_rates("")])
  if (scene$axes[1] != 1) own <- own %*% matrix_of_quaternion(scene$axes, "axes", call)
  order <- order(scene$moment_of_inertia_kg_m2)
  moments <- scene$moment_of_inertia_kg_m2[order]
  path <- drawn_rows(own[, order, drop = FALSE], call)
  energy <- 0.5 * sum(moments * path[1, ]^2)
  if (moments[1] == 0 || energy == 0) {
    abort_rotdyn("There is no ellipsoid of energy to draw.", "value", call)
  }
  semi <- sqrt(2 * energy / moments)
  size <- max(semi)
  circle <- closed_circle()
  sections <- lapply(1:3, function(k) {
    out <- matrix(0, nrow(circle), 3)
    out[, -k] <- circle
    t(semi * t(out)) / size
  })
  labels <- lapply(1:3, function(k) list(semi[k] / size * (1:3 == k), paste("axis", k)))
  turns_over <- moments[2] - moments[1] > 1e-9 * moments[3] &&
    moments[3] - moments[2] > 1e-9 * moments[3]
  separatrix <- if (turns_over) {
    reach <- sqrt(2 * energy / (moments[1] * moments[3] * (moments[3] - moments[1])))
    aside <- reach * sqrt(c(
      moments[3] * (moments[3] - moments[2]), moments[1] * (moments[2] - moments[1])
    ))
    lapply(c(-1, 1), function(side) {
      cbind(circle[, 2] * aside[1], semi[2] * circle[, 1], side * circle[, 2] * aside[2]) / size
    })
  }
  about <- c("the axis of the least moment", "the middle axis", "the axis of the largest moment")
  momentum2 <- sum((moments * path[1, ])^2)
  round <- if (momentum2 < 2 * energy * moments[2]) 1L else 3L
  surface_plot(
    diag(semi / size), sections, list(path / size), colours = plot_colours[2], labels = labels,
    dashed = separatrix, title = "Polhode on the ellipsoid of energy",
    said = paste("the angular velocity goes round", about[round]), base_size = base_size
  )
}

closed_circle <- function(n = 121) {
  a <- seq(0, 2 * pi, length.out = n)
  cbind(cos(a), sin(a))
}

# The rows that are numbers.
drawn_rows <- function(path, call) {
  path <- path[rowSums(is.finite(path)) == 3L, , drop = FALSE]
  if (!nrow(path)) abort_rotdyn("There is no row to draw.", "value", call)
  path
}

# Curves on the ellipsoid { shape n, |n| = 1 }, seen as the drawings of bodies are. `grid`,
# `dashed`: curves of the surface; `labels`: list(point, text), with a line from the surface.
surface_plot <- function(shape, grid, paths, colours, labels, title, said, base_size,
                         dashed = NULL) {
  view <- view_of_space()
  toward <- c(view[1, 2] * view[2, 3] - view[1, 3] * view[2, 2],
              view[1, 3] * view[2, 1] - view[1, 1] * view[2, 3],
              view[1, 1] * view[2, 2] - view[1, 2] * view[2, 1])
  inverse <- solve(shape)
  # The normal at shape n is along inverse n: the front is where it points toward the reader.
  front <- function(curve) as.vector(curve %*% inverse %*% inverse %*% toward) >= 0
  flat <- function(curve, id) {
    at <- curve %*% t(view)
    seen <- front(curve)
    part <- paste(id, cumsum(c(0, diff(seen) != 0)))
    data.frame(x = at[, 1], y = at[, 2], seen = seen, part = part)
  }
  gather <- function(curves, id) {
    do.call(rbind, lapply(seq_along(curves), function(k) flat(curves[[k]], paste(id, k))))
  }
  # The rim: n across inverse toward.
  rim <- as.vector(inverse %*% toward)
  basis <- qr.Q(qr(cbind(rim, diag(3))))[, 2:3]
  outline <- closed_circle() %*% t(basis) %*% t(shape) %*% t(view)
  outline <- data.frame(x = outline[, 1], y = outline[, 2])
  lines <- gather(grid, "grid")
  path <- gather(paths, "path")
  ends <- do.call(rbind, lapply(labels, function(label) {
    tip <- as.vector(view %*% label[[1]])
    long <- 1 + 0.18 / max(sqrt(sum(label[[1]]^2)), 0.3)
    # Letters are wider than high.
    away <- c(0.17, 0.1) * tip / max(sqrt(sum(tip^2)), 1e-3)
    data.frame(x = tip[1], y = tip[2], to_x = long * tip[1], to_y = long * tip[2],
               at_x = long * tip[1] + away[1], at_y = long * tip[2] + away[2], text = label[[2]])
  }))
  aes <- ggplot2::aes
  line <- function(data, ...) {
    ggplot2::geom_path(aes(.data$x, .data$y, group = .data$part), data, ...)
  }
  width <- 0.05 * base_size
  plot <- ggplot2::ggplot() +
    ggplot2::geom_polygon(aes(.data$x, .data$y), outline, fill = "grey96", colour = "grey45") +
    line(lines[!lines$seen, ], colour = "grey90", linewidth = 0.3) +
    line(path[!path$seen, ], colour = colours, alpha = 0.3, linewidth = width) +
    line(lines[lines$seen, ], colour = "grey75", linewidth = 0.3)
  if (length(dashed)) {
    dashes <- gather(dashed, "dashed")
    plot <- plot + line(dashes[dashes$seen, ], colour = "grey30", linetype = "42",
      linewidth = 0.4)
  }
  plot +
    ggplot2::geom_segment(
      aes(.data$x, .data$y, xend = .data$to_x, yend = .data$to_y), ends, colour = plot_ink,
      arrow = grid::arrow(length = grid::unit(0.35 * base_size, "pt"), type = "closed")
    ) +
    ggplot2::geom_text(
      aes(.data$at_x, .data$at_y, label = .data$text), ends, colour = plot_ink,
      size = text_size(base_size)
    ) +
    line(path[path$seen, ], colour = colours, linewidth = width) +
    ggplot2::geom_point(
      aes(.data$x, .data$y), path[1, ], colour = colours, size = 0.2 * base_size
    ) +
    ggplot2::coord_equal(clip = "off") +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(sentence(said), base_size),
      alt = paste0(title, ": ", said, ".")
    ) +
    plot_theme(base_size) +
    ggplot2::theme(
      axis.text = ggplot2::element_blank(), axis.title = ggplot2::element_blank(),
      panel.grid = ggplot2::element_blank()
    )
}
