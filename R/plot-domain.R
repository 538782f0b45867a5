# A domain of a density, seen along the three axes.

#' Plot a domain
#'
#' Three projections of a domain: the faces of its parameters as wires; of a [domain_inside()] the
#' cells in which one of the points of a grid lies inside.
#'
#' @param object One of the [domains].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where no point is inside; `rotdyn_error_range`.
#' @seealso [domains], [autoplot.rot_body()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(domain_cylinder(0.5, 2, inner_radius_m = 0.4, angle_rad = c(0, 5)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept region
autoplot.rot_domain <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, domain_form, "object", "domain", call)
  inside <- object$kind == "inside"
  found <- if (inside) domain_cells(object, call) else domain_wires(object, call)
  points <- found$points
  drawn <- in_panels(function(across, up) {
    flat <- data.frame(
      across = points[, across], up = points[, up], wire = found$wire %||% seq_len(nrow(points))
    )
    if (inside) flat[!duplicated(flat[c("across", "up")]), ] else flat
  })
  frame <- panel_frame(list(drawn))
  check_drawable(frame, call)
  span <- diff(frame$across[1:2])
  unit <- panel_unit(span)
  step <- found$step
  sizes <- if (length(object$size_m)) {
    paste0(
      gsub("_", " ", sub("_m$", "", names(object$size_m))), " ", format_si(object$size_m), " m",
      collapse = ", "
    )
  }
  title <- paste("A domain:", c(
    box = "a box", cylinder = "a cylinder", ball = "a ball", ellipsoid = "an ellipsoid",
    map = "the image of a box", inside = "the points that a function accepts"
  )[[object$kind]])
  reach <- apply(points, 2L, range)
  if (inside) reach <- reach + c(-0.5, 0.5) %o% step
  ggplot2::ggplot(drawn, ggplot2::aes(.data$across, .data$up)) +
    ggplot2::geom_blank(data = frame) +
    (if (inside) {
      steps <- in_panels(function(across, up) data.frame(w = step[[across]], h = step[[up]]))
      here <- match(drawn$panel, steps$panel)
      ggplot2::geom_tile(width = steps$w[here], height = steps$h[here], fill = plot_colours[6],
                         colour = plot_colours[6], linewidth = 0.2)
    } else {
      ggplot2::geom_path(
        ggplot2::aes(group = .data$wire), colour = plot_colours[1], linewidth = 0.025 * base_size
      )
    }) +
    ggplot2::facet_wrap(
      "panel", ncol = 3, scales = "free",
      labeller = ggplot2::as_labeller(function(panel) paste0(panel, " (", unit$name, ")"))
    ) +
    ggplot2::scale_x_continuous(
      expand = c(0, 0), breaks = even_breaks(span), labels = unit$label, guide = plot_axis()
    ) +
    ggplot2::scale_y_continuous(
      expand = c(0, 0), breaks = even_breaks(span), labels = unit$label
    ) +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(sizes, base_size), x = NULL,
      y = NULL, alt = paste0(
        title, if (!is.null(sizes)) paste0(", ", sizes),
        ". Projections along the three axes; it spans ",
        paste0(apply(reach, 2L, range_in_words), " m along ", c("x", "y", "z"), collapse = ", "),
        "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(aspect.ratio = 1)
}

# Lines on the faces of the box of parameters, as points in space.
domain_wires <- function(domain, call, fine = 61L) {
  # Walls may be thin.
  n <- if (domain$kind %in% c("box", "map")) c(9, 9, 9) else c(2, 9, 9)
  low <- domain$chart[2:4]
  high <- domain$chart[5:7]
  parts <- list()
  for (face in which(!domain$periodic)) {
    for (end in unique(c(low[face], high[face]))) {
      for (along in setdiff(1:3, face)) {
        other <- setdiff(1:3, c(face, along))
        for (at in seq(low[other], high[other], length.out = n[other])) {
          line <- matrix(0, fine, 3)
          line[, face] <- end
          line[, other] <- at
          line[, along] <- seq(low[along], high[along], length.out = fine)
          parts[[length(parts) + 1L]] <- line
        }
      }
    }
  }
  points <- domain_points(domain, do.call(rbind, parts), call)
  colnames(points) <- c("x", "y", "z")
  list(points = points, wire = rep(seq_along(parts), each = fine))
}

# Parameters to points: boxes; cylinders (r, angle, z); balls (r, cosine, angle), stretched.
domain_points <- function(domain, p, call) {
  if (domain$kind == "map") {
    p <- p + rep(domain$parameter, each = nrow(p))
    points <- domain$map(p[, 1], p[, 2], p[, 3])
    points <- if (is.list(points)) do.call(cbind, unname(points)) else as.matrix(points)
    if (is.numeric(points) && identical(dim(points), dim(p)) && all(is.finite(points))) {
      return(points)
    }
    abort_rotdyn("The map gives no finite points.", "value", call)
  }
  points <- switch(domain$kind,
    box = p,
    cylinder = cbind(p[, 1] * cos(p[, 2]), p[, 1] * sin(p[, 2]), p[, 3]),
    {
      flat <- p[, 1] * sqrt(pmax(1 - p[, 2]^2, 0))
      cbind(flat * cos(p[, 3]), flat * sin(p[, 3]), p[, 1] * p[, 2])
    }
  )
  points * rep(domain$chart[8:10], each = nrow(p)) + rep(domain$centre_m, each = nrow(p))
}

# Of a grid of 48 cells along each axis the middles that are inside.
domain_cells <- function(domain, call, n = 48L) {
  half <- domain$chart[5:7]
  step <- stats::setNames(2 * half / n, c("x", "y", "z"))
  axes <- lapply(1:3, function(k) domain$centre_m[k] + half[k] * ((2 * seq_len(n) - 1) / n - 1))
  grid <- as.matrix(expand.grid(x = axes[[1]], y = axes[[2]], z = axes[[3]]))
  kept <- domain$inside(grid[, 1], grid[, 2], grid[, 3])
  if (!is.logical(kept) || length(kept) != nrow(grid) || !any(kept %in% TRUE)) {
    abort_rotdyn("No point of a grid of {n}^3 is inside: there is nothing to draw.", "value", call)
  }
  list(points = grid[kept %in% TRUE, , drop = FALSE], step = step)
}
