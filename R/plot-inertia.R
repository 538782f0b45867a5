# Tensors of inertia: their nine elements, and their principal axes.

#' Plot an inertia tensor, principal axes
#'
#' A tensor as its nine elements, in colours by sign and size. Principal axes as the homogeneous box
#' (cylinder, ball) with these moments, with its axes and those of the table.
#'
#' @param object From [inertia_tensor()] or [principal_axes()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`.
#' @seealso [inertia_tensor()], [principal_axes()], [autoplot.rot_body()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' box <- place_body(body_box(10, 0.4, 0.6, 1), rotation = rotation_about("z", angle_deg = 30))
#' ggplot2::autoplot(inertia_tensor(box))
#' ggplot2::autoplot(principal_axes(box))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept products of inertia
autoplot.rot_inertia_tensor <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_inertia_tensor(object, "object", call)
  names <- c("x", "y", "z")
  value <- as.vector(unclass(object))
  size <- max(abs(value))
  value <- clear_noise(value, 1e-14 * size)
  tiles <- data.frame(
    row = factor(rep(names, 3), rev(names)), column = factor(rep(names, each = 3), names),
    value = value
  )
  tiles$text <- format_si(signif(value, 4))
  tiles$name <- paste0("I[", tiles$row, tiles$column, "]")
  about <- switch(attr(object, "about"),
    centre = "the centre of mass", origin = "the origin",
    paste0("(", paste(format_si(attr(object, "point_m")), collapse = ", "), ") m")
  )
  sign <- if (attr(object, "products") == "negative") "minus" else "plus"
  own <- identical(attr(object, "rotation"), diag(3))
  title <- paste("Inertia tensor about", about)
  words <- paste0(
    "in kg m^2, ", if (own) "own" else "rotated", " axes; off the diagonal ", sign,
    " the integrals of x y dm"
  )
  ggplot2::ggplot(tiles, ggplot2::aes(.data$column, .data$row)) +
    ggplot2::geom_tile(ggplot2::aes(fill = .data$value), colour = "white", linewidth = 1.5) +
    ggplot2::geom_text(
      ggplot2::aes(label = .data$name), parse = TRUE, colour = "grey35", nudge_y = 0.22,
      size = text_size(base_size)
    ) +
    ggplot2::geom_text(
      ggplot2::aes(label = .data$text), colour = plot_ink, nudge_y = -0.12,
      size = 1.4 * text_size(min(base_size, 17))
    ) +
    # Pale at both ends, for dark letters.
    ggplot2::scale_fill_gradient2(
      low = "#E9A56B", mid = "grey95", high = "#7FB8DA", limits = c(-1, 1) * max(size, 1e-300),
      guide = "none"
    ) +
    ggplot2::scale_x_discrete(position = "top") +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(words, base_size), x = NULL,
      y = NULL, alt = paste0(
        title, ", ", words, ". ",
        paste0(gsub("\\[|\\]", "", tiles$name), " ", tiles$text, collapse = ", "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(panel.grid = ggplot2::element_blank(), aspect.ratio = 0.55)
}

#' @rdname autoplot.rot_inertia_tensor
#' @exportS3Method ggplot2::autoplot
autoplot.rot_principal_axes <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  columns <- c("principal_moment_kg_m2", "x", "y", "z", "unique")
  for (name in columns) if (is.null(object[[name]])) abort_missing_column(name, object, call)
  numbers <- vapply(columns[1:4], function(name) is.double(object[[name]]), NA)
  if (nrow(object) != 3L || !all(numbers) || !is.logical(object$unique) ||
    !all(is.finite(unlist(unclass(object)[columns])))) {
    abort_form("", "object", "table of principal axes", call)
  }
  kind <- attr(object, "symmetry")
  title <- paste0("Principal axes", if (!is.null(kind)) paste0(": ", kind))
  draw(draw_principal(object), title, base_size)
}

draw_principal <- function(x) {
  d <- new_drawing()
  axes <- t(cbind(x$x, x$y, x$z))
  moments <- x$principal_moment_kg_m2
  solid <- solid_of_inertia(moments, axes)
  size <- max(solid$semi)
  # From where a line along a direction leaves the box, to a length beyond.
  ends <- function(direction, long) {
    from <- 1 / max(abs(crossprod(axes, direction)) / solid$semi)
    rbind(from * direction, max(long * size, from + 0.3 * size) * direction)
  }
  lines <- list()
  for (k in 1:3) {
    own <- mark_in_space("line", ends(diag(3)[, k], 1.7), "dashed", paste("e", k))
    line <- ends(axes[, k], 1.35)
    lines <- c(lines, list(own), lapply(c(-1, 1), function(side) {
      mark_in_space("line", side * line, "torque", paste(k, side))
    }))
  }
  faces <- Map(function(face, fill, edged) {
    mark_in_space("face", solid$points[face, ], fill, "body", edged)
  }, solid$faces, solid$fill, rep_len(solid$edged, length(solid$faces)))
  unit <- 0.7 / size
  for (one in project_marks(c(faces, lines))) {
    one$points <- one$points * unit
    d$add(one)
  }
  view <- whole_view()
  # Beside the end that is turned to the reader.
  name <- function(symbol, at, aside) {
    flat <- unit * as.vector(view[1:2, ] %*% at)
    aside <- aside * c(flat[2], -flat[1]) / max(length_of(flat), 0.1)
    d$say(symbol, flat[1] + aside[1], flat[2] + aside[2])
  }
  for (k in 1:3) {
    name(paste0("e[", c("x", "y", "z")[k], "]"), ends(diag(3)[, k], 1.7)[2, ], 0.13)
    symbol <- paste0("I[", k, "]")
    side <- if (sum(view[3, ] * axes[, k]) < 0) -1 else 1
    name(symbol, side * ends(axes[, k], 1.35)[2, ], -0.13)
    along <- paste(format_si(signif(clear_noise(axes[, k], 1e-12), 3)), collapse = ", ")
    d$key(quantity(
      symbol, value_text(moments[k], "kg m^2"),
      if (x$unique[k]) paste0("along (", along, ")") else "axis not unique", "torque"
    ))
  }
  d$key(quantity("e[i]", "axes of the table", ""))
  d$done(c(-1.5, 1.5, -1.5, 1.5), "The homogeneous body with these moments; not to scale.")
}
