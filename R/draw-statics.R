#' Free-body drawing
#'
#' The body with all forces on it: loads, and the reactions of the supports. The arrows are to
#' scale; forces below a fifth of the largest are drawn longer, so that they are seen. A load along
#' a line is arrows along it, as high as it is there. Dashed arrows are the normals of surfaces and
#' rollers. A body in space is drawn in oblique projection, with x to the right, z up and y into the
#' page; on supports below its loads it has a plate and legs, unless it has an outline.
#'
#' @param object From [static_equilibrium()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [static_equilibrium()].
#' @concept free body diagram
#' @concept plot
#' @concept free-body diagram
#' @concept ladder
#' @concept seesaw
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(static_equilibrium(
#'   forces(load_weight(20, c(2, 0), name = "beam"), load_weight(50, c(1, 0), name = "box")),
#'   list(left = support_pin(c(0, 0)), right = support_roller(c(4, 0))), name = "beam"
#' ))
#' @exportS3Method ggplot2::autoplot
autoplot.rot_equilibrium <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  rest <- check_equilibrium(object, "object", call)
  title <- paste0(sentence(rest$name), ": ", verdict_words[[rest_verdict(rest)]])
  draw(draw_statics(rest), title, base_size)
}

# Oblique: y at 35 degrees into the page, to less than half its length.
flatten_points <- function(points, plane) {
  if (plane) return(points[, 1:2, drop = FALSE])
  cbind(points[, 1] + 0.45 * cospi(35 / 180) * points[, 2],
        points[, 3] + 0.45 * sinpi(35 / 180) * points[, 2])
}

draw_statics <- function(rest) {
  s <- rest$structure
  plane <- s$problem$plane > 0
  rows <- support_rows(rest)
  system <- system_of(s$loads)
  at <- rbind(t(system$at), do.call(rbind, lapply(s$supports, function(one) c(one$at_m, 0)[1:3])))
  outline <- rest$outline$points
  if (!is.null(outline) && plane) outline <- cbind(outline, 0 * outline[, 1])
  # In units of the largest coordinate, so that nothing overflows; anchors may be far away.
  size <- max(abs(c(at, outline)), 0, na.rm = TRUE)
  if (!(size > 1e-300)) size <- 1
  at <- at / size
  outline <- if (!is.null(outline)) outline / size
  supports <- lapply(s$supports, function(one) {
    one$at_m <- one$at_m / size
    one$to_m <- pmin(pmax(one$to_m / size, -1e9), 1e9)
    one$normal <- one$normal / max(abs(one$normal), 1e-300)
    one
  })
  couples <- apply(system$force == 0, 2L, all)
  # A couple without a place does not enlarge the drawing.
  used <- rbind(at[!c(couples, rep(FALSE, length(s$supports))), , drop = FALSE], outline)
  if (!nrow(used)) used <- rbind(at, 0)
  flat <- flatten_points(used, plane)
  seen <- flat[stats::complete.cases(flat), , drop = FALSE]
  low <- apply(seen, 2L, min)
  extent <- max(apply(seen, 2L, max) - low)
  if (!(extent > 1e-300)) extent <- 1
  # The drawing is 2 wide or high.
  place <- function(points) {
    p <- flatten_points(points, plane)
    cbind(2 * (p[, 1] - low[1]) / extent, 2 * (p[, 2] - low[2]) / extent)
  }
  d <- new_drawing()
  stool <- if (is.null(outline) && !plane) stool_of(s$supports, at, couples, place)
  for (one in stool %||% outline_of(place, used, outline)) d$add(one)
  lines <- if (plane) line_loads(s$loads, system)
  for (line in lines) draw_line_load(d, line, size, place, lines, s$loads$load[line$rows[1]])
  on_line <- unlist(lapply(lines, `[[`, "rows"))
  for (one in supports) for (mark in support_marks(one, place, plane)) d$add(mark)
  columns <- function(names) vapply(names, function(name) rows[[name]], numeric(nrow(at) - ncol(
    system$at)))
  reaction <- matrix(columns(force_columns(plane)), ncol = 3L - plane)
  turn <- matrix(columns(couple_columns(plane)), ncol = if (plane) 1L else 3L)
  full <- function(m) if (plane) cbind(m, 0) else m
  forces <- rbind(t(system$force), full(reaction))
  turns <- rbind(t(system$couple), if (plane) cbind(0, 0, turn) else turn)
  n <- ncol(system$at)
  names <- c(s$loads$load, rows$support)
  style <- rep(c("weight", "torque"), c(n, nrow(at) - n))
  letter <- ifelse(style == "weight", "F", "R")
  number <- c(seq_len(n), seq_len(nrow(at) - n))
  # What is only rounding is not drawn.
  sizes <- apply(forces, 1L, length_of)
  slack <- c(rep(0, n), rows$error_n)
  turning <- apply(turns, 1L, length_of)
  turn_slack <- c(rep(0, n), rows$error_n_m)
  largest <- max(sizes, 0)
  normal <- matrix(normals_of(s$supports), 3L)
  middle <- colMeans(place(at))
  centre <- colMeans(used[stats::complete.cases(used), , drop = FALSE])
  met <- character()
  for (i in seq_len(nrow(at))) {
    if (i %in% on_line) next
    if (sizes[i] > slack[i]) {
      symbol <- paste0(letter[i], "[", number[i], "]")
      # Forces along one line stand beside each other.
      where <- paste(signif(c(at[i, ], forces[i, ] / sizes[i]), 6), collapse = " ")
      twin <- sum(met == where)
      met <- c(met, where)
      p <- place(at[i, , drop = FALSE])
      p[1] <- p[1] + 0.07 * twin
      draw_force(d, p, forces[i, ], sizes[i] / largest, symbol, style[i], plane,
                 style[i] == "torque" && pushes(rest, i - n, forces[i, ], at[i, ], centre),
                 place(at[sizes > slack, , drop = FALSE]))
      d$key(quantity(symbol, names[i], force_text(forces[i, ], sizes[i], plane), style[i]))
    }
    if (i > n && !is.na(normal[1, i - n])) {
      p <- place(at[i, , drop = FALSE])
      draw_normal(d, p, normal[, i - n], paste0("n[", i - n, "]"), plane)
      d$key(quantity(paste0("n[", i - n, "]"), paste("normal,", names[i]),
                     normal_text(normal[, i - n], 3L - plane), "body"))
    }
    if (turning[i] > turn_slack[i]) {
      symbol <- paste0(if (style[i] == "weight") "M" else "C", "[", number[i], "]")
      p <- place(at[i, , drop = FALSE])
      sign <- if (plane) turns[i, 3] else 1
      d$add(turn_arrow(p[1], p[2], 0.16, 20, 290, sign, style[i]))
      d$say(symbol, p[1] + 0.27, p[2] + 0.1)
      value <- if (plane) value_text(turns[i, 3], "N m") else
        paste0("(", paste(format_si(signif(turns[i, ], 4)), collapse = ", "), ") N m")
      d$key(quantity(symbol, paste("couple,", names[i]), value, style[i]))
    }
  }
  drawn <- d$done(c(0, 1, 0, 1))
  if (is.null(drawn$quantities)) d$key(quantity("", "no forces", ""))
  ends <- do.call(rbind, lapply(drawn$marks, function(one) one$points))
  box <- apply(rbind(ends, middle), 2L, range)
  note <- c(
    if (!plane) "Oblique: x to the right, z up, y into the page.",
    if (any(sizes > slack & sizes < 0.2 * largest)) "Arrows to scale, but for small forces." else
      "Arrows to scale.",
    if (any(!rest$determined)) "Reactions that equilibrium does not determine: minimum norm."
  )
  d$done(c(box[1, 1] - 0.25, box[2, 1] + 0.25, box[1, 2] - 0.18, box[2, 2] + 0.2),
         paste(note, collapse = " "))
}

# The loads along lines whose rows are as load_line() made them.
line_loads <- function(loads, system) {
  Filter(function(line) {
    whole <- mean(line$down_n_per_m) * sqrt(sum((line$to_m - line$from_m)^2))
    all(line$rows <= ncol(system$force)) && length(line$from_m) == 2L &&
      isTRUE(all.equal(sum(system$force[2, line$rows]), -whole))
  }, attr(loads, "lines", exact = TRUE))
}

# Arrows down on the line, as long as the load is at each place, relative to the largest one.
draw_line_load <- function(d, line, size, place, lines, name) {
  maximum <- max(abs(unlist(lapply(lines, `[[`, "down_n_per_m"))), 1e-300)
  ends <- place(cbind(rbind(line$from_m, line$to_m) / size, 0))
  high <- 0.42 * line$down_n_per_m / maximum
  top <- ends + cbind(0, high)
  d$add(mark("line", rbind(ends[1, ], top, ends[2, ]), "weight"))
  n <- max(3L, min(12L, ceiling(sqrt(sum((ends[2, ] - ends[1, ])^2)) / 0.16)))
  for (s in seq(0, 1, length.out = n)) {
    from <- top[1, ] + s * (top[2, ] - top[1, ])
    to <- ends[1, ] + s * (ends[2, ] - ends[1, ])
    if (abs(from[2] - to[2]) > 0.05) d$add(mark("arrow", rbind(from, to), "weight"))
  }
  symbol <- paste0("w[", line$rows[1], "]")
  middle <- colMeans(top)
  d$say(symbol, middle[1], middle[2] + 0.14)
  whole <- mean(line$down_n_per_m) * sqrt(sum((line$to_m - line$from_m)^2))
  text <- paste0(
    value_text(line$down_n_per_m, "N/m"), ", together ", value_text(abs(whole), "N"),
    if (whole < 0) " up" else " down"
  )
  d$key(quantity(symbol, name, text, "weight"))
}

# A body on three supports or more, all lower than its loads: a plate at the lowest load, on legs.
stool_of <- function(supports, at, couples, place) {
  n <- length(couples)
  feet <- at[n + seq_along(supports), , drop = FALSE]
  loads <- at[seq_len(n)[!couples], , drop = FALSE]
  stands <- vapply(supports, function(one) one$kind %in% c("surface", "roller", "pin"), NA)
  if (length(supports) < 3L || !all(stands) || !nrow(loads)) return(NULL)
  top <- min(loads[, 3])
  if (!(top - max(feet[, 3]) > 1e-6)) return(NULL)
  raised <- cbind(feet[, 1:2, drop = FALSE], top)
  around <- rbind(raised, cbind(loads[, 1:2, drop = FALSE], top))
  plate <- around[grDevices::chull(around[, 1], around[, 2]), , drop = FALSE]
  legs <- lapply(order(-feet[, 2]), function(i) thick_line(place(rbind(feet[i, ], raised[i, ]))))
  c(unlist(legs, recursive = FALSE), list(mark("fill", place(plate), "body")))
}

# Does the arrow of a support end at its point? It lies outside of the body: a pin may also pull.
pushes <- function(rest, i, force, at, centre) {
  one <- rest$structure$supports[[i]]
  if (one$kind %in% c("cable", "rod")) return(FALSE)
  if (one$kind == "surface") return(TRUE)
  out <- at - centre
  !(sum(out * force) > 0.3 * length_of(out) * length_of(force))
}

# A force of the share of the largest; its arrow ends or begins at the point. The symbol is on the
# side where no other of the `points` is near.
draw_force <- function(d, point, force, share, symbol, style, plane, ends,
                       points = rbind(point)) {
  direction <- flatten_points(rbind(force / length_of(force)), plane)
  if (length_of(direction) < 0.05) direction <- cbind(0.05, 0.05)
  direction <- direction / length_of(direction)
  tip <- 0.75 * max(share, 0.2) * direction
  from <- if (ends) point - tip else point
  to <- from + tip
  d$add(mark("arrow", rbind(from, to), style))
  outer <- if (ends) from else to
  side <- 0.17 * c(-direction[2], direction[1])
  if (side[1] < 0 || (side[1] == 0 && side[2] < 0)) side <- -side
  beside <- (points - rep(point, each = nrow(points))) %*% side / 0.17
  if (any(beside > 0.02 & beside < 0.35) && !any(beside < -0.02 & beside > -0.35)) side <- -side
  d$say(symbol, outer[1] + side[1], outer[2] + side[2])
}

# A short dashed line from the point along the normal, into the body.
draw_normal <- function(d, point, normal, symbol, plane) {
  direction <- flatten_points(rbind(normal), plane)
  if (length_of(direction) < 0.05) direction <- cbind(0.05, 0.05)
  tip <- point + 0.3 * direction / length_of(direction)
  d$add(mark("arrow", rbind(point, tip), "dashed"))
  d$say(symbol, tip[1] + 0.08 * direction[1] + 0.09 * direction[2],
    tip[2] + 0.08 * direction[2] - 0.09 * direction[1])
}

# "490.3 N down", "351 N at 66 degrees", "(61.3, 0, 122.6) N".
force_text <- function(force, size, plane) {
  shown <- value_text(size, "N")
  along <- which(abs(force) > 1e-12 * size)
  if (length(along) == 1L) {
    words <- if (plane) c("right", "left", "up", "down") else
      c("along x", "along -x", "into the page", "out of the page", "up", "down")
    return(paste(shown, words[2L * along - (force[along] > 0)]))
  }
  if (plane) {
    angle <- atan2(force[2], force[1]) * 180 / pi
    return(paste0(shown, " at ", format_si(round(angle, 1)), "\u00b0"))
  }
  paste0("(", paste(format_si(signif(force * (abs(force) > 1e-12 * size), 4)), collapse = ", "),
         ") N")
}

# The outline given, or the convex hull of the points: a line where they lie on one.
outline_of <- function(place, used, outline) {
  if (is.null(outline)) {
    flat <- place(used)
    hull <- flat[grDevices::chull(flat[, 1], flat[, 2]), , drop = FALSE]
    if (nrow(hull) < 2L) {
      return(list(mark("fill", draw_circle(hull[1, 1], hull[1, 2], 0.05), "body")))
    }
    spread <- svd(hull - rep(colMeans(hull), each = nrow(hull)))$d
    if (nrow(hull) < 3L || spread[2] < 1e-6 * spread[1]) {
      ends <- hull[order(hull[, 1] + 1e-3 * hull[, 2]), , drop = FALSE]
      return(thick_line(ends[c(1L, nrow(ends)), ]))
    }
    return(list(mark("fill", hull, "body")))
  }
  broken <- !stats::complete.cases(outline)
  parts <- split(seq_len(nrow(outline))[!broken], cumsum(broken)[!broken])
  unlist(lapply(parts, function(rows) {
    flat <- place(outline[rows, , drop = FALSE])
    closed <- nrow(flat) > 3L && all(outline[rows[1], ] == outline[rows[length(rows)], ])
    if (closed) return(list(mark("fill", flat, "body")))
    unlist(lapply(seq_len(nrow(flat) - 1L), function(i) thick_line(flat[i + 0:1, ])), FALSE)
  }), FALSE)
}

# A bar from one point to another.
thick_line <- function(ends, half = 0.025) {
  direction <- ends[2, ] - ends[1, ]
  if (!(length_of(direction) > 0)) return(list())
  side <- half * c(-direction[2], direction[1]) / length_of(direction)
  list(mark("fill", rbind(ends[1, ] + side, ends[2, ] + side, ends[2, ] - side, ends[1, ] - side),
            "body"))
}

# What holds the body, in grey: a triangle, a bar across the normal, a line to the anchor.
support_marks <- function(one, place, plane) {
  point <- function(p) as.double(place(rbind(c(p, 0)[1:3])))
  p <- point(one$at_m)
  if (one$kind %in% c("cable", "rod")) {
    # Long cables are cut: the anchor may be far away.
    direction <- point(one$to_m) - p
    end <- p + direction * min(1, 1.2 / length_of(direction))
    return(list(mark("line", rbind(p, end), "dashed"),
                mark("fill", draw_circle(end[1], end[2], 0.025), "fixed")))
  }
  if (one$kind %in% c("roller", "surface")) {
    direction <- flatten_points(rbind(c(one$normal, 0)[1:3]), plane)
    if (length_of(direction) == 0) direction <- cbind(0, 1)
    direction <- as.double(direction / length_of(direction))
    across <- c(-direction[2], direction[1])
    gap <- if (one$kind == "roller") 0.07 else 0
    bar <- rbind(p - gap * direction + 0.16 * across, p - gap * direction - 0.16 * across,
                 p - (gap + 0.05) * direction - 0.16 * across,
                 p - (gap + 0.05) * direction + 0.16 * across)
    wheel <- if (gap > 0) {
      centre <- p - 0.5 * gap * direction
      list(mark("fill", draw_circle(centre[1], centre[2], 0.5 * gap), "hole"))
    }
    return(c(list(mark("fill", bar, "fixed")), wheel))
  }
  if (one$kind == "fixed") return(list(mark("fill", draw_box(p[1], p[2], 0.08, 0.3), "fixed")))
  list(mark("fill", rbind(p, p + c(-0.07, -0.11), p + c(0.07, -0.11)), "fixed"),
       mark("fill", draw_circle(p[1], p[2], 0.025), "hole"))
}
