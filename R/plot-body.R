# The plot of a body: the solid ellipsoid of the same mass and second moments, projected along x, y
# and z. The projection of the ellipsoid x' M^-1 x = 1 has the block of M in that plane as its
# matrix, also where M is singular (plates and rods). For a uniform solid ellipsoid C = (m/5) M.

#' Plot a body
#'
#' Draws the *equivalent ellipsoid*, the uniform solid ellipsoid with the same mass, centre and
#' second moments, with its principal axes, projected along the three own axes, at one scale. The
#' rotation of a rigid body depends only on this ellipsoid.
#'
#' The semi-axes are \eqn{a_k = \sqrt{5 c_k/m}}{a_k = sqrt(5 c_k/m)} with the second moments
#' \eqn{c_k} along the principal axes. The longest semi-axis belongs to the smallest moment of
#' inertia, axis 1. A plate is a flat ellipse, a rod a line, a point or a body without mass a dot.
#' Parts and points of the body are marked (at most 2000 of a kind); holes are crosses.
#'
#' Dashed lines continue the principal axes. Coordinates are in m or a power of 1000 of it, as
#' stated above the panels. If the distance of the own origin is more than twenty times the size of
#' the body, coordinates are relative to the centre of mass, which the caption states.
#'
#' @param object A `rot_body`.
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot.
#' @section Errors: `rotdyn_error_package` without ggplot2.
#' @seealso [principal_axes()], whose moments and class are in the subtitle.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' rod <- body_rod(mass_kg = 0.5, length_m = 1)
#' ball <- body_sphere(mass_kg = 2, radius_m = 0.1)
#' dumbbell <- join_bodies(rod, place_body(ball, c(0.6, 0, 0)), place_body(ball, c(-0.6, 0, 0)))
#' ggplot2::autoplot(place_body(dumbbell, c(0.5, 0, 0), rotation_about("z", angle_deg = 30)))
#' @exportS3Method ggplot2::autoplot
autoplot.rot_body <- function(object, ..., base_size = 13) {
  check_plot(base_size, ...)
  drawn <- body_drawing(object)
  colours <- stats::setNames(plot_colours[1:3], levels(drawn$axes$axis))
  ggplot2::ggplot(mapping = ggplot2::aes(.data$across, .data$up)) +
    ggplot2::geom_blank(data = drawn$frame) +
    ggplot2::geom_polygon(data = drawn$outline, fill = "grey70", alpha = 0.35) +
    # The outline as a path, too: a polygon without area is invisible.
    ggplot2::geom_path(data = drawn$outline, colour = "grey30", linewidth = 0.8) +
    ggplot2::geom_segment(
      ggplot2::aes(xend = .data$across_end, yend = .data$up_end, colour = .data$axis),
      drawn$axes[drawn$axes$part == "direction", ], linetype = "22", linewidth = 0.8
    ) +
    ggplot2::geom_segment(
      ggplot2::aes(xend = .data$across_end, yend = .data$up_end, colour = .data$axis),
      drawn$axes[drawn$axes$part == "semi-axis", ], linewidth = 1.3, lineend = "round"
    ) +
    # Many points must not hide the rest.
    ggplot2::geom_point(
      ggplot2::aes(shape = .data$what), drawn$pieces,
      colour = "grey20", fill = "white", stroke = 1,
      size = if (drawn$few) 3 else 1.5, alpha = if (drawn$few) 1 else 0.6
    ) +
    # The cross of the origin is larger than the dot of the centre, so both are visible.
    ggplot2::geom_point(
      ggplot2::aes(shape = .data$what), drawn$marks[drawn$marks$what == "own origin", ],
      size = 5, stroke = 1, colour = "grey10"
    ) +
    ggplot2::geom_point(
      ggplot2::aes(shape = .data$what), drawn$marks[drawn$marks$what == "centre of mass", ],
      size = 3, colour = "grey10"
    ) +
    ggplot2::facet_wrap(
      "panel", nrow = 1, scales = "free",
      labeller = ggplot2::as_labeller(function(panel) paste0(panel, " (", drawn$unit$name, ")"))
    ) +
    ggplot2::scale_x_continuous(
      expand = c(0, 0), breaks = drawn$breaks, labels = drawn$unit$label,
      guide = ggplot2::guide_axis(check.overlap = TRUE)
    ) +
    ggplot2::scale_y_continuous(
      expand = c(0, 0), breaks = drawn$breaks, labels = drawn$unit$label
    ) +
    # No colour scale for a point, which has no axes.
    (if (nrow(drawn$axes)) {
      ggplot2::scale_colour_manual(values = colours, name = "principal axis")
    }) +
    ggplot2::scale_shape_manual(values = body_marks, name = NULL) +
    ggplot2::guides(
      colour = ggplot2::guide_legend(order = 1, override.aes = list(linewidth = 1.3)),
      shape = ggplot2::guide_legend(order = 2, override.aes = list(size = 3, alpha = 1))
    ) +
    ggplot2::labs(
      title = body_title(object), subtitle = body_subtitle(object), caption = drawn$caption,
      x = NULL, y = NULL,
      alt = paste(body_title(object), body_subtitle(object), sep = ". ")
    ) +
    plot_theme(base_size) +
    ggplot2::theme(
      aspect.ratio = 1,
      legend.box = "vertical",
      legend.spacing.y = ggplot2::unit(0, "pt"),
      panel.spacing = ggplot2::unit(14, "pt"),
      plot.margin = ggplot2::margin(8, 14, 4, 8)
    )
}

body_marks <- c("centre of mass" = 16, "own origin" = 3, part = 21, "cut out" = 4, point = 20)

body_title <- function(body) {
  name <- gsub("_", " ", body$shape)
  substr(name, 1, 1) <- toupper(substr(name, 1, 1))
  paste(strwrap(paste0(name, ": equivalent ellipsoid and principal axes"), 70), collapse = "\n")
}

body_subtitle <- function(body) {
  axes <- principal_axes(body)
  moments <- clear_noise(axes$principal_moment_kg_m2, body_noise(body))
  moments <- vapply(moments, format, character(1), digits = 4)
  paste0(
    format_si(body$mass_kg), " kg; I1, I2, I3 = ", paste(moments, collapse = ", "), " kg m^2\n",
    describe_symmetry(axes)
  )
}

# The contents of the plot as data frames with `panel`, `across` and `up`.
body_drawing <- function(body) {
  axes <- principal_axes(body)
  centre <- as.double(body$centre_m)
  semi <- if (body$mass_kg > 0) {
    sqrt(5 * (pmax(axes$second_moment_kg_m2, 0) / body$mass_kg))
  } else {
    c(0, 0, 0)
  }
  far <- sqrt(sum(centre^2)) > 20 * semi[1] && semi[1] > 0
  # The origin of the plot: the own origin or the centre.
  zero <- if (far) centre else c(0, 0, 0)
  at <- centre - zero
  pieces <- body_pieces(body, zero)
  marks <- data.frame(what = "centre of mass", x = at[1], y = at[2], z = at[3])
  if (!far) marks <- rbind(marks, data.frame(what = "own origin", x = 0, y = 0, z = 0))
  marks$what <- factor(marks$what, levels = names(body_marks))
  directions <- attr(axes, "axes")
  lines <- rbind(
    axis_lines(directions, pmax(1.15 * semi, 0.3 * semi[1]), at, axes, "direction"),
    axis_lines(directions, semi, at, axes, "semi-axis")
  )
  # A point has no axes to show.
  lines <- lines[rep(semi[1] > 0, nrow(lines)), ]
  outline <- body_outline(directions, semi, at)
  lines <- project_lines(lines)
  marks <- project(marks)
  few <- nrow(pieces) <= 30L
  pieces <- project(pieces)
  frame <- panel_frame(list(
    outline, marks, pieces, lines,
    data.frame(panel = lines$panel, across = lines$across_end, up = lines$up_end)
  ))
  span <- diff(frame$across[1:2])
  list(
    outline = outline, axes = lines, marks = marks, pieces = pieces, few = few, frame = frame,
    breaks = even_breaks(span), unit = panel_unit(span),
    caption = if (far) {
      paste0("measured from the centre of mass, at (", paste(format_si(centre), collapse = ", "),
             ") m in the own axes")
    }
  )
}

body_panels <- list(
  list(label = "across x, up y", across = "x", up = "y"),
  list(label = "across x, up z", across = "x", up = "z"),
  list(label = "across y, up z", across = "y", up = "z")
)

# One step for all panels and both directions, so that the grid is square.
even_breaks <- function(span) {
  step <- diff(pretty(c(0, span), n = 3))[1]
  function(limits) step * seq(ceiling(limits[1] / step), floor(limits[2] / step))
}

# Units from micrometres to kilometres by name, others as powers of 1000 m.
panel_unit <- function(span) {
  power <- if (span >= 0.02 && span < 2e4) 0 else 3 * floor(log10(span / 2) / 3)
  named <- c("-6" = "um", "-3" = "mm", "0" = "m", "3" = "km")
  name <- named[as.character(power)]
  list(
    name = if (is.na(name)) sprintf("1e%d m", as.integer(power)) else name[[1]],
    label = function(breaks) format(breaks / 10^power, digits = 6, trim = TRUE)
  )
}

in_panels <- function(one) {
  labels <- vapply(body_panels, function(panel) panel$label, character(1))
  frames <- lapply(body_panels, function(panel) {
    frame <- one(panel$across, panel$up)
    frame$panel <- factor(rep(panel$label, nrow(frame)), levels = labels)
    frame
  })
  do.call(rbind, frames)
}

project <- function(points) {
  in_panels(function(across, up) {
    cbind(points["what"], across = points[[across]], up = points[[up]])
  })
}

project_lines <- function(lines) {
  in_panels(function(across, up) {
    data.frame(
      axis = lines$axis, part = lines$part, across = lines[[across]], up = lines[[up]],
      across_end = lines[[paste0(across, "_end")]], up_end = lines[[paste0(up, "_end")]]
    )
  })
}

# The outline of the projection. The columns of B are the projected semi-axes, M = B B'; the left
# singular vectors and values of B also give a flat projection as a line of the right length.
body_outline <- function(directions, semi, at, n = 181L) {
  names(at) <- rownames(directions) <- c("x", "y", "z")
  angle <- 2 * pi * seq(0, 1, length.out = n)
  largest <- max(semi, .Machine$double.xmin) # squares of the sizes may leave the range
  in_panels(function(across, up) {
    seen <- directions[c(across, up), ] %*% diag(semi / largest)
    shadow <- svd(seen, nv = 0)
    edge <- largest * (shadow$u %*% (shadow$d * rbind(cos(angle), sin(angle))))
    data.frame(across = at[[across]] + edge[1, ], up = at[[up]] + edge[2, ])
  })
}

axis_lines <- function(directions, reach, at, axes, part) {
  tip <- directions %*% diag(reach)
  free <- ifelse(axes$unique, "", " (not unique)")
  label <- paste0(axes$axis, free)
  data.frame(
    axis = factor(label, levels = label), part = part,
    x = at[1] - tip[1, ], y = at[2] - tip[2, ], z = at[3] - tip[3, ],
    x_end = at[1] + tip[1, ], y_end = at[2] + tip[2, ], z_end = at[3] + tip[3, ]
  )
}

# Tables in the detail with x_m, y_m and z_m. Negative masses are holes.
body_pieces <- function(body, zero, most = 2000L) {
  empty <- data.frame(what = character(), x = double(), y = double(), z = double())
  xyz <- c("x_m", "y_m", "z_m")
  pieces <- lapply(names(body$detail), function(name) {
    table <- body$detail[[name]]
    if (!is.data.frame(table) || !all(xyz %in% names(table)) || !nrow(table)) return(empty)
    kept <- unique(round(seq(1, nrow(table), length.out = min(nrow(table), most))))
    mass <- if ("mass_kg" %in% names(table)) table$mass_kg[kept] else 0
    data.frame(
      what = ifelse(mass < 0, "cut out", if (name == "parts") "part" else "point"),
      x = table$x_m[kept] - zero[1], y = table$y_m[kept] - zero[2], z = table$z_m[kept] - zero[3]
    )
  })
  pieces <- do.call(rbind, c(list(empty), pieces))
  pieces$what <- factor(pieces$what, levels = names(body_marks))
  pieces
}

# Limits of each panel, so that all panels span the same length.
panel_frame <- function(tables) {
  all <- do.call(rbind, lapply(tables, function(table) table[c("panel", "across", "up")]))
  spans <- lapply(split(all, all$panel), function(one) {
    list(across = range(one$across), up = range(one$up))
  })
  half <- max(vapply(spans, function(s) max(diff(s$across), diff(s$up)), double(1))) / 2
  # Margin for a mark at the edge.
  half <- 1.12 * if (half > 0) half else 1
  corners <- lapply(names(spans), function(panel) {
    data.frame(
      panel = factor(panel, levels = names(spans)),
      across = mean(spans[[panel]]$across) + c(-half, half),
      up = mean(spans[[panel]]$up) + c(-half, half)
    )
  })
  do.call(rbind, corners)
}
