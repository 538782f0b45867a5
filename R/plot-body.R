# The plot of a body along x, y and z: its true outline, and over it the solid ellipsoid of the
# same mass and second moments. Projected, the ellipsoid x' M^-1 x = 1 has the block of M in that
# plane as its matrix, also where M is singular (plates and rods). For a uniform solid ellipsoid C
# = (m/5) M.

#' Plot a body
#'
#' Draws a body projected along the three own axes, at one scale: its true outline (of shapes,
#' polygons and meshes, placed, joined and cut; holes dashed), over it the *equivalent ellipsoid*,
#' the uniform solid ellipsoid with the same mass, centre and second moments, with its principal
#' axes. The rotation of a rigid body depends only on this ellipsoid. A body of a tensor, of points
#' or of a density has the ellipsoid alone.
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
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`; `rotdyn_error_range` for sizes below 1e-280 or above
#'   1e280 of the unit drawn.
#' @seealso [principal_axes()], whose moments and class are in the subtitle.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' rod <- body_rod(mass_kg = 0.5, length_m = 1)
#' ball <- body_sphere(mass_kg = 2, radius_m = 0.1)
#' dumbbell <- join_bodies(rod, place_body(ball, c(0.6, 0, 0)), place_body(ball, c(-0.6, 0, 0)))
#' ggplot2::autoplot(place_body(dumbbell, c(0.5, 0, 0), rotation_about("z", angle_deg = 30)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept drawing of a body
autoplot.rot_body <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  drawn <- body_drawing(object, call)
  wide <- base_size > 16
  axis_label <- function(axis) paste("axis", if (wide) substr(axis, 1L, 1L) else axis)
  rows <- function(labels) legend_columns(labels, base_size)
  panel_in <- 2.2 - 0.03 * base_size
  colours <- stats::setNames(plot_colours[1:3], levels(drawn$axes$axis))
  ggplot2::ggplot(mapping = ggplot2::aes(.data$across, .data$up)) +
    ggplot2::geom_blank(data = drawn$frame) +
    # A mesh: its triangles, with a rim of their own colour, or their seams would show.
    ggplot2::geom_polygon(
      ggplot2::aes(group = .data$group), drawn$solids$mesh, fill = "grey88", colour = "grey88",
      linewidth = 0.2
    ) +
    # A polygon without area is visible by its border alone.
    ggplot2::geom_polygon(
      ggplot2::aes(group = .data$group, linetype = .data$what), drawn$solids$fill,
      fill = ifelse(drawn$solids$fill$hole, "white", "grey88"), colour = "grey25", linewidth = 0.6,
      key_glyph = "path"
    ) +
    ggplot2::geom_path(
      ggplot2::aes(linetype = .data$what), drawn$outline, colour = "grey40", linewidth = 0.7
    ) +
    ggplot2::geom_path(
      ggplot2::aes(group = .data$group, linetype = .data$what), drawn$solids$line,
      colour = "grey25", linewidth = 0.6
    ) +
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
      "panel", ncol = 3, scales = "free",
      labeller = ggplot2::as_labeller(function(panel) {
        label <- paste0(panel, " (", drawn$unit$name, ")")
        vapply(label, wrap_label, "", size = 0.75 * base_size, width_in = panel_in)
      })
    ) +
    ggplot2::scale_x_continuous(
      expand = c(0, 0), breaks = function(limits) ends_of(drawn$breaks(limits), base_size),
      labels = drawn$unit$label, guide = ggplot2::guide_axis(check.overlap = TRUE)
    ) +
    ggplot2::scale_y_continuous(
      expand = c(0, 0), breaks = drawn$breaks, labels = drawn$unit$label
    ) +
    # No colour scale for a point, which has no axes.
    (if (nrow(drawn$axes)) {
      ggplot2::scale_colour_manual(
        values = colours, labels = axis_label, name = NULL
      )
    }) +
    ggplot2::scale_shape_manual(values = body_marks, name = NULL) +
    ggplot2::scale_linetype_manual(
      values = body_lines, breaks = names(body_lines), name = NULL
    ) +
    ggplot2::guides(
      linetype = ggplot2::guide_legend(
        order = 1, ncol = rows(names(body_lines)),
        override.aes = list(fill = NA, colour = "grey25", linewidth = 0.6)
      ),
      colour = ggplot2::guide_legend(
        order = 2, ncol = rows(axis_label(levels(drawn$axes$axis))),
        override.aes = list(linewidth = 1.3)
      ),
      shape = ggplot2::guide_legend(
        order = 3, ncol = rows(names(body_marks)[1:3]), override.aes = list(size = 3, alpha = 1)
      )
    ) +
    ggplot2::labs(
      title = wrap_title(body_title(object), base_size),
      subtitle = wrap_subtitle(strsplit(body_subtitle(object, wide), "\n")[[1]], base_size),
      caption = if (!is.null(drawn$caption)) wrap_text(drawn$caption, 0.7 * base_size),
      x = NULL, y = NULL, alt = body_alt(object, drawn)
    ) +
    plot_theme(base_size) +
    ggplot2::theme(
      aspect.ratio = 1,
      legend.box = "vertical",
      legend.box.just = "center",
      legend.key.width = ggplot2::unit(1.3 * base_size, "pt"),
      panel.spacing.x = ggplot2::unit(0.5 * base_size, "pt")
    )
}

body_marks <- c("centre of mass" = 16, "own origin" = 3, part = 21, "cut out" = 4, point = 20)

body_lines <- c(outline = "solid", hole = "22", ellipsoid = "62")

body_title <- function(body) sentence(gsub("_", " ", body$shape))

# What is drawn, and how far it reaches along each own axis.
body_alt <- function(body, drawn) {
  shown <- rbind(drawn$solids$fill, drawn$solids$line, drawn$solids$mesh)
  of <- if (nrow(shown)) "outline" else "equivalent ellipsoid"
  if (!nrow(shown)) shown <- drawn$outline
  panel <- as.integer(shown$panel)
  reach <- list(x = shown$across[panel == 1L], y = shown$up[panel == 1L], z = shown$up[panel == 2L])
  paste0(
    body_title(body), ", ", gsub("\n", "; ", body_subtitle(body)),
    ". Projections along the three own axes; the ", of, " spans ",
    paste0(vapply(reach, range_in_words, ""), " m along ", names(reach), collapse = ", "), "."
  )
}

body_subtitle <- function(body, short = FALSE) {
  axes <- principal_axes(body)
  moments <- clear_noise(axes$principal_moment_kg_m2, body_noise(body))
  moments <- vapply(moments, format, character(1), digits = 4)
  paste0(
    format_si(body$mass_kg), if (short) " kg; I = " else " kg; I1, I2, I3 = ",
    paste(moments, collapse = ", "), " kg m^2\n",
    if (short) attr(axes, "symmetry") else describe_symmetry(axes)
  )
}

# The contents of the plot as data frames with `panel`, `across` and `up`.
body_drawing <- function(body, call) {
  axes <- principal_axes(body)
  centre <- as.double(body$centre_m)
  semi <- if (body$mass_kg > 0) {
    # The roots first: the quotient may be beyond the doubles.
    sqrt(5) * sqrt(pmax(axes$second_moment_kg_m2, 0)) / sqrt(body$mass_kg)
  } else {
    c(0, 0, 0)
  }
  far <- sqrt(sum(centre^2)) > 20 * semi[1] && semi[1] > 0
  # The origin of the plot: the own origin or the centre.
  zero <- if (far) centre else c(0, 0, 0)
  at <- centre - zero
  solids <- body_shadows(body, zero)
  pieces <- body_pieces(body, zero)
  # Parts that are drawn need no mark.
  if (nrow(solids$fill) + nrow(solids$line)) pieces <- pieces[pieces$what == "point", ]
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
    outline, marks, pieces, lines, solids$fill, solids$line, solids$mesh,
    data.frame(panel = lines$panel, across = lines$across_end, up = lines$up_end)
  ))
  check_drawable(frame, call)
  span <- diff(frame$across[1:2])
  list(
    outline = outline, solids = solids, axes = lines, marks = marks, pieces = pieces, few = few,
    frame = frame,
    breaks = even_breaks(span), unit = panel_unit(span),
    caption = if (far) {
      paste0("measured from the centre of mass, at (", paste(format_si(centre), collapse = ", "),
             ") m in the own axes")
    }
  )
}

body_panels <- list(
  list(label = "y over x", across = "x", up = "y"),
  list(label = "z over x", across = "x", up = "z"),
  list(label = "z over y", across = "y", up = "z")
)

# One step for all panels and both directions, so that the grid is square.
even_breaks <- function(span) {
  step <- diff(pretty(c(0, span), n = 3))[1]
  function(limits) step * seq(ceiling(limits[1] / step), floor(limits[2] / step))
}

# The first and the last where letters are large.
ends_of <- function(breaks, base_size) if (base_size > 18) unique(range(breaks)) else breaks

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

# The outline of the projected ellipsoid.
body_outline <- function(directions, semi, at) {
  in_panels(function(across, up) {
    ball <- list(centre = at, axes = directions %*% diag(semi))
    edge <- ball_shadow(ball, panel_plane(across, up))
    data.frame(across = edge[, 1], up = edge[, 2], what = body_line("ellipsoid", 1L))
  })
}

panel_plane <- function(across, up) diag(3)[, match(c(across, up), c("x", "y", "z"))]

body_line <- function(what, n) factor(rep_len(what, n), levels = names(body_lines))

# The true outline in all panels.
body_shadows <- function(body, zero) {
  solids <- lapply(body_solids(body), move_solid, diag(3), -zero)
  of <- function(which) {
    in_panels(function(across, up) {
      one <- project_solids(solids, panel_plane(across, up))[[which]]
      one$what <- body_line(ifelse(one$hole, "hole", "outline"), nrow(one))
      one
    })
  }
  list(fill = of("fill"), line = of("line"), mesh = of("mesh"))
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
body_pieces <- function(body, zero, maximum = 2000L) {
  empty <- data.frame(what = character(), x = double(), y = double(), z = double())
  xyz <- c("x_m", "y_m", "z_m")
  pieces <- lapply(names(body$detail), function(name) {
    table <- body$detail[[name]]
    if (!is.data.frame(table) || !all(xyz %in% names(table)) || !nrow(table)) return(empty)
    kept <- unique(round(seq(1, nrow(table), length.out = min(nrow(table), maximum))))
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

# The axes of a plot need sizes well inside the doubles.
check_drawable <- function(frame, call) {
  size <- max(diff(range(frame$across)), diff(range(frame$up)))
  if (is.finite(size) && (size == 0 || (size > 1e-280 && size < 1e280))) return(invisible())
  abort_rotdyn(c(
    "The body is too small or too large to be drawn.",
    x = "Its size is {format(size, digits = 3)} of the unit drawn.",
    i = "Draw it with other lengths: the shape is the same."
  ), "range", call)
}
