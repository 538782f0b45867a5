# Drawings of scenes. A constraint's record has drawing(scene), which returns
#   marks        list of mark(): what is drawn, in units of the drawing, scale 1 : 1
#   labels       data frame of x, y, symbol: where the symbols stand in the drawing
#   quantities   data frame of quantity(): the symbols with their values, as the key tells them
#   limits       c(left, right, bottom, top)
#   note         NULL, or a caption
# and knows nothing of ggplot2. A constraint without one is drawn by default_drawing().

# A polygon ("fill"), a line ("line") or a line with an arrow at its end ("arrow").
mark <- function(type, points, style) {
  list(type = type, points = matrix(as.double(points), ncol = 2L), style = style)
}

# `symbol` in plotmath; "" for one that has no place in the drawing.
quantity <- function(symbol, name, value, style = "body") {
  data.frame(symbol = symbol, name = name, value = value, style = style)
}

label_at <- function(symbol, x, y) data.frame(symbol = symbol, x = x, y = y)

# A word that stands in a drawing; `hjust` as in text: 0 begins at the point, 1 ends there.
word_at <- function(word, x, y, hjust = 0.5, style = "body") {
  data.frame(symbol = encodeString(word, quote = "\""), x = x, y = y, style = style, hjust = hjust)
}

# Of the palette in R/plot.R.
draw_colours <- c(
  body = "#333333", speed = "#0072B2", torque = "#D55E00", weight = "#009E73",
  resistance = "#AA4499", spring = "#B8860B", shaft = "#777777"
)

draw_fills <- c(body = "#E0E0E0", hole = "#FFFFFF", shaft = "#999999", fixed = "#BFBFBF")

# A style is a name of those above, or a colour.
fill_of <- function(style) if (startsWith(style, "#")) style else draw_fills[[style]]

# Sides of solids have an edge where they say so, other fills always.
edge_of <- function(one) {
  if (is.null(one$edge) || one$edge) plot_edge else fill_of(one$style)
}

plot_edge <- "#404040"

#' Draw a scene
#'
#' `autoplot()` of a scene draws what it describes, with its quantities: a body on its axle, with
#' torque, brake, spring and start; a pendulum with its weight; rotors on a shaft; two bodies and a
#' clutch; a gear train; masses on a pulley. Bodies on an axle and pendulums have the true outline
#' of their body, seen along the axle and to scale; rotors are drawn from the side, not to scale.
#' Arrows of torques and angular velocities have the sense of their sign, counter-clockwise for
#' positive ones.
#'
#' @param object A scene: [scene_axle()], [scene_pendulum()], [scene_rotors()], [scene_clutch()],
#'   [scene_gears()], ...
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [autoplot.rot_trajectory()] for the motion, [autoplot.rot_body()] for bodies.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03, coulomb_n_m = 0.1))
#' ggplot2::autoplot(wheel)
#' ggplot2::autoplot(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = pi / 3))
#' ggplot2::autoplot(scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0)))
#' ggplot2::autoplot(scene_gears(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept drawing of a scene
#' @concept free-body diagram
autoplot.rot_scene <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_scene(object, call)
  constraint <- constraint_of(object)
  drawing <- (constraint$drawing %||% default_drawing)(object)
  title <- constraint$title(list(scene = object, solved = object))
  draw(drawing, drawing$title %||% title, base_size)
}

# The ggplot of a drawing. The key stands beside a drawing that is about as high as wide, and under
# a wide one.
draw <- function(drawing, title, base_size) {
  box <- drawing$limits
  beside <- diff(box[1:2]) < 1.4 * diff(box[3:4])
  key <- drawing$quantities
  key$id <- paste0("q", seq_len(nrow(key)))
  key_size <- 0.75 * base_size
  # "m*g*d" has three letters.
  wide <- 1.1 * (1 + max(1, lengths(strsplit(key$symbol, "*", fixed = TRUE))))
  text <- key_text(key, key_size, if (beside) 2.4 else 6.3)
  # Many quantities in large letters get smaller ones.
  high <- sum(nchar(gsub("[^\n]", "", text)) + 1.4) * 1.2 * key_size
  if (beside && high > 290) {
    key_size <- key_size * max(290 / high, 0.5)
    text <- key_text(key, key_size, 2.4)
  }
  plot <- ggplot2::ggplot(mapping = ggplot2::aes(.data$x, .data$y))
  for (one in drawing$marks) plot <- plot + draw_mark(one, base_size)
  labels <- drawing$labels
  words <- labels[startsWith(labels$symbol, "\""), ]
  for (k in seq_len(nrow(words))) {
    plot <- plot + ggplot2::annotate(
      "text", x = words$x[k], y = words$y[k], label = words$symbol[k], parse = TRUE,
      hjust = words$hjust[k], colour = draw_colours[[words$style[k]]], size = text_size(base_size)
    )
  }
  labels$id <- factor(key$id[match(labels$symbol, key$symbol)], key$id)
  # "tau[2]" belongs to the quantity "tau[i]".
  any_of <- sub("\\[.*", "[i]", labels$symbol)
  labels$id[is.na(labels$id)] <- key$id[match(any_of, key$symbol)][is.na(labels$id)]
  labels <- labels[!is.na(labels$id), ]
  if (nrow(labels)) {
    plot <- plot + ggplot2::geom_text(
      ggplot2::aes(label = .data$symbol, colour = .data$id), labels, parse = TRUE,
      size = 1.2 * text_size(base_size), key_glyph = draw_symbol, show.legend = TRUE
    )
  } else {
    plot <- plot + ggplot2::geom_text(
      ggplot2::aes(label = "", colour = .data$id),
      data.frame(x = mean(box[1:2]), y = mean(box[3:4]), id = factor(key$id, key$id)),
      key_glyph = draw_symbol, show.legend = TRUE
    )
  }
  plot +
    ggplot2::scale_colour_manual(
      values = stats::setNames(draw_colours[key$style], key$id), limits = key$id, breaks = key$id,
      labels = stats::setNames(text, NULL), name = NULL
    ) +
    ggplot2::guides(colour = ggplot2::guide_legend(
      ncol = if (beside) 1L else legend_columns(text, base_size), byrow = TRUE,
      override.aes = list(label = key$symbol, size = 1.4 * key_size / (72.27 / 25.4))
    )) +
    ggplot2::coord_fixed(xlim = box[1:2], ylim = box[3:4], expand = FALSE,
                        clip = drawing$clip %||% "off") +
    ggplot2::labs(
      title = wrap_title(title, base_size), x = NULL, y = NULL,
      caption = if (!is.null(drawing$note)) wrap_text(drawing$note, 0.7 * base_size),
      alt = paste0(
        "Drawing. ", title, ". ", paste(trimws(paste(key$name, key$value)), collapse = "; "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(
      axis.text = ggplot2::element_blank(), panel.grid.major = ggplot2::element_blank(),
      legend.position = if (beside) "right" else "bottom",
      legend.text = ggplot2::element_text(size = key_size, lineheight = 0.95),
      legend.spacing.y = ggplot2::unit(0.3 * key_size, "pt"),
      legend.key.width = ggplot2::unit(wide * key_size, "pt"),
      legend.key.height = ggplot2::unit(1.6 * key_size, "pt")
    )
}

# Name and value on one line where they fit, else the value on its own.
key_text <- function(key, size, width_in) {
  room <- width_in * 72 - 2.2 * size
  vapply(seq_len(nrow(key)), function(i) {
    one <- trimws(paste(key$name[i], key$value[i]))
    if (text_width(one, size) <= room) return(one)
    paste(wrap_text(key$name[i], size, room / 72), wrap_text(key$value[i], size, room / 72),
          sep = "\n")
  }, "")
}

# The symbol of a quantity as its key.
draw_symbol <- function(data, params, size) {
  label <- if (nzchar(data$label %||% "")) parse(text = data$label) else ""
  grid::textGrob(label, gp = grid::gpar(col = data$colour, fontsize = data$size * 72.27 / 25.4))
}

draw_mark <- function(one, base_size) {
  data <- data.frame(x = one$points[, 1], y = one$points[, 2])
  thick <- 0.045 * base_size
  if (one$type == "fill") {
    return(ggplot2::geom_polygon(
      data = data, fill = fill_of(one$style), colour = edge_of(one), linewidth = thick,
      linetype = if (one$style == "hole") "22" else "solid"
    ))
  }
  dashed <- one$style == "dashed"
  ggplot2::geom_path(
    data = data, na.rm = TRUE, colour = if (dashed) "grey50" else draw_colours[[one$style]],
    linetype = if (dashed) "22" else "solid",
    linewidth = if (one$type == "arrow") 2 * thick else 1.3 * thick,
    arrow = if (one$type == "arrow") {
      grid::arrow(length = grid::unit(0.7 * base_size, "pt"), type = "closed", angle = 22)
    }
  )
}

# ---- shapes -------------------------------------------------------------------------------------

draw_circle <- function(x, y, radius) ring(radius)[, 1:2] + rep(c(x, y), each = 181L)

draw_box <- function(x, y, width, height) {
  cbind(x + c(-1, 1, 1, -1) * width / 2, y + c(-1, -1, 1, 1) * height / 2)
}

# From one angle to another in degrees, about (x, y).
draw_arc <- function(x, y, radius, from, to) {
  angle <- seq(from, to, length.out = 61L) * pi / 180
  cbind(x + radius * cos(angle), y + radius * sin(angle))
}

# An arc with an arrow, counter-clockwise from `from` by `by` degrees, or back where `sign` is
# negative.
turn_arrow <- function(x, y, radius, from, by, sign, style) {
  ends <- if (sign < 0) c(from + by, from) else c(from, from + by)
  mark("arrow", draw_arc(x, y, radius, ends[1], ends[2]), style)
}

# A wheel that has turned by `angle`: a rim with spokes and a dot beside the first of them, so that
# turns show. `hollow`: the radius of its hole in parts of its own.
wheel_marks <- function(x, y, radius, angle, hollow = 0, spokes = 5L) {
  from <- 0.12 * radius
  to <- radius * if (hollow > 0) hollow else 0.86
  rays <- lapply(angle + 2 * pi * (seq_len(spokes) - 1) / spokes, function(one) {
    direction <- c(cos(one), sin(one))
    mark("line", rbind(c(x, y) + from * direction, c(x, y) + to * direction), "body")
  })
  dot <- c(x, y) + radius * (0.93 * to / radius - 0.16) *
    c(cos(angle + pi / spokes / 2), sin(angle + pi / spokes / 2))
  c(
    list(mark("fill", draw_circle(x, y, radius), "body")),
    if (hollow > 0) list(mark("fill", draw_circle(x, y, radius * hollow), "#FFFFFF")),
    rays,
    list(
      mark("fill", draw_circle(x, y, from), "shaft"),
      mark("fill", draw_circle(dot[1], dot[2], 0.09 * radius), "#0072B2")
    )
  )
}

# The hole of a ring with that beta = (1 + hole^2)/2; 0 for what has more mass inside.
hole_of_beta <- function(beta) {
  if (!isTRUE(beta > 0.55)) 0 else min(sqrt(2 * min(beta, 1) - 1), 0.88)
}

# A zigzag along x.
draw_spring <- function(from, to, y, height, turns = 5L) {
  n <- 2L * turns
  inner <- from + (to - from) * c(0.15, 0.15 + 0.7 * (seq_len(n) - 0.5) / n, 0.85)
  cbind(c(from, inner, to), y + c(0, 0, rep_len(c(height, -height), n), 0, 0))
}

# ---- values -------------------------------------------------------------------------------------

# "2 kg", "1, 2, 1 N m": equal values once, many by their range.
value_text <- function(x, unit) {
  x <- as.double(x)
  shown <- format_si(signif(x, 4))
  if (length(unique(shown)) == 1L) shown <- shown[1]
  if (length(shown) > 6L) shown <- range_in_words(x, 4)
  trimws(paste(paste(shown, collapse = ", "), unit))
}

# A torque law in a few words.
torque_text <- function(torque) {
  if (inherits(torque, "rot_torque_knots")) {
    if (!length(torque$time_s)) return(value_text(torque$outside[1], "N m"))
    return(paste(range_in_words(c(torque$torque_n_m, torque$outside), 4), "N m over time"))
  }
  if (inherits(torque, "rot_torque_motor")) {
    return(paste(value_text(torque$stall_torque_n_m, "N m"), "of a motor at rest"))
  }
  if (inherits(torque, "rot_torque_sum")) {
    return(paste(vapply(torque$laws, torque_text, ""), collapse = " + "))
  }
  describe_torque(torque)
}

# The numbers of a scene whose names end in a unit, without those that are 0.
field_quantities <- function(scene) {
  rows <- lapply(names(scene), function(name) {
    unit <- unit_in_name(name)
    x <- scene[[name]]
    if (unit == "1" || !is.numeric(x) || !length(x) || !all(is.finite(x)) || all(x == 0)) {
      return(NULL)
    }
    quantity("", words_in_name(name, unit), value_text(x, unit))
  })
  do.call(rbind, rows) %||% quantity("", "a scene", "")
}

# A constraint without a drawing of its own: rotors in a line where the scene has several moments of
# inertia, else a body; with the scene's numbers.
default_drawing <- function(scene) {
  inertia <- scene[["moment_of_inertia_kg_m2"]]
  if (is.numeric(inertia) && length(inertia) > 1L) {
    return(draw_shafting(scene, inertia, couplings_of(scene)))
  }
  list(
    marks = list(mark("fill", draw_circle(0, 0, 0.6), "body")),
    labels = label_at(character(), double(), double()), quantities = field_quantities(scene),
    limits = c(-1, 1, -1, 1), note = "not to scale"
  )
}

# Between neighbours: "spring", "clutch", "gear", with ratios, as far as the scene says.
couplings_of <- function(scene) {
  n <- length(scene$moment_of_inertia_kg_m2) - 1L
  given <- scene[["couplings"]]
  if (!is.list(given) || length(given) != n) {
    return(list(kind = rep("spring", n), ratio = rep(1, n)))
  }
  field <- function(one, name, default) {
    x <- one[[name]]
    if (is.numeric(x) && length(x) == 1L && is.finite(x)) x else default
  }
  kind <- vapply(given, field, 0, "kind", 0)
  list(
    kind = c("spring", "clutch", "gear")[pmin(pmax(kind, 0), 2) + 1],
    ratio = vapply(given, field, 1, "ratio", 1)
  )
}
