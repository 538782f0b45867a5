#' Draw a collision
#'
#' The bodies before and after, seen along the axis in which least happens: centres of mass, lines
#' to the point of contact, rims of round bodies, velocities as arrows of one scale, and angular
#' velocities about the line of sight as numbers.
#'
#' @param object A collision, from [collide()], [ball_bounce()], [hinged_hit()], [disks_lock()] or
#'   [rims_meet()].
#' @param ... Not used; names after it must be given in full.
#' @param row The collision: a row of `object`.
#' @param base_size Size of the letters in points.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`;
#'   `rotdyn_error_type` for what is no collision any more, `rotdyn_error_value` for a row that is
#'   missing or not finite.
#' @seealso [collision_ledger()] and its [picture][autoplot.rot_ledger()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ball <- body_sphere(0.06, 0.033)
#' ggplot2::autoplot(ball_bounce(ball, 20, -5, -300, restitution = 0.75, friction = 0.5))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept drawing of a collision
autoplot.rot_collision <- function(object, ..., row = 1, base_size = 13) {
  call <- check_plot(base_size, ...)
  collision <- check_collision(object, call)
  row <- floor(check_number(row, "row", "1", call, lower = 1, upper = max(1, nrow(object))))
  if (nrow(object) == 0L) abort_rotdyn("{.arg object} has no collision: no rows.", "value", call)
  state <- collision_state(object, collision, row)
  if (!all(is.finite(unlist(state)))) {
    abort_rotdyn("Row {row} is not finite: there is nothing to draw.", "value", call)
  }
  if (one_axle(collision, state)) return(draw_lock(state, base_size))
  look <- collision_look(object, collision, row)
  seen <- look$seen
  flat <- function(v) v[seen]
  sight <- list(look$sight$axis, look$sight$sign)
  names <- names(state)
  times <- factor(c("before", "after"), c("before", "after"))
  reach <- look$reach
  speeds <- vapply(state, function(s) {
    max(sqrt(sum(flat(s$v[[1]])^2)), sqrt(sum(flat(s$v[[2]])^2)))
  }, double(1))
  scale <- if (max(speeds) > 0) 1.3 * reach / max(speeds) else 0
  rows <- function(f) {
    do.call(rbind, lapply(seq_along(state), function(b) {
      do.call(rbind, lapply(1:2, function(k) {
        part <- f(b, k)
        if (!is.null(part)) data.frame(body = names[b], time = times[k], part)
      }))
    }))
  }
  arms <- rows(function(b, k) {
    data.frame(x = look$centre[[b]][1], y = look$centre[[b]][2], xend = 0, yend = 0)
  })
  arrows <- rows(function(b, k) {
    v <- flat(state[[b]]$v[[k]]) * scale
    if (sqrt(sum(v^2)) < 1e-3 * reach) return(NULL)
    from <- look$centre[[b]]
    data.frame(x = from[1], y = from[2], xend = from[1] + v[1], yend = from[2] + v[2])
  })
  rims <- rows(function(b, k) {
    outline <- look$outline[[b]]
    if (!is.null(outline)) {
      data.frame(x = look$centre[[b]][1] + outline[, 1], y = look$centre[[b]][2] + outline[, 2])
    }
  })
  number <- function(x) format_si(signif(x, 3))
  said <- rows(function(b, k) {
    s <- state[[b]]
    w <- sight[[2]] * s$omega[[k]][sight[[1]]]
    speed <- sqrt(sum(s$v[[k]]^2))
    data.frame(text = paste0(
      names[b], ": ", if (s$mass > 0) paste0(number(speed), " m/s"),
      if (s$mass > 0 && any(s$inertia != 0)) ", ",
      if (any(s$inertia != 0)) paste0(number(if (abs(w) < 1e-12) 0 else w), " rad/s")
    ))
  })
  captions <- vapply(levels(times), function(time) {
    paste(said$text[said$time == time], collapse = "\n")
  }, "")
  ground <- do.call(rbind, lapply(seq_along(ground_marks(look)), function(g) {
    one <- ground_marks(look)[[g]]
    data.frame(x = one$points[, 1], y = one$points[, 2], id = g, filled = one$type == "fill")
  }))
  plot <- ggplot2::ggplot() +
    ggplot2::facet_wrap("time", labeller = ggplot2::as_labeller(function(time) {
      paste0(time, "\n", captions[time])
    })) +
    ggplot2::coord_equal()
  if (!is.null(ground)) {
    plot <- plot +
      ggplot2::geom_polygon(
        ggplot2::aes(.data$x, .data$y, group = .data$id), ground[ground$filled, ],
        fill = draw_fills[["fixed"]], colour = plot_edge, linewidth = 0.4
      ) +
      ggplot2::geom_path(
        ggplot2::aes(.data$x, .data$y, group = .data$id), ground[!ground$filled, ],
        colour = "grey55", linetype = "22"
      )
  }
  if (!is.null(rims)) {
    plot <- plot + ggplot2::geom_polygon(
      ggplot2::aes(.data$x, .data$y, fill = .data$body, group = .data$body), rims,
      colour = plot_edge, linewidth = 0.5, show.legend = FALSE
    ) + ggplot2::scale_fill_manual(
      values = stats::setNames(rep_len(collision_fills, length(names)), names)
    )
  }
  plot <- plot +
    ggplot2::geom_segment(
      ggplot2::aes(.data$x, .data$y, xend = .data$xend, yend = .data$yend, colour = .data$body),
      arms, linewidth = 0.5, linetype = "22"
    ) +
    ggplot2::geom_point(ggplot2::aes(.data$x, .data$y, colour = .data$body), arms, size = 2)
  if (!is.null(arrows)) {
    plot <- plot + ggplot2::geom_segment(
      ggplot2::aes(.data$x, .data$y, xend = .data$xend, yend = .data$yend, colour = .data$body),
      arrows, linewidth = 1, arrow = ggplot2::arrow(length = ggplot2::unit(8, "pt"))
    )
  }
  letters <- c("x", "y", "z")[seen]
  plot +
    ggplot2::scale_colour_manual(
      values = stats::setNames(plot_colours[c(1, 2)][seq_along(names)], names), name = NULL
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size, 4), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title(paste(sentence(and_words(names)), if (length(names) > 1L) "collide" else
        "bounces"), base_size),
      x = paste(letters[1], "from the contact (m)"), y = paste(letters[2], "(m)"),
      caption = wrap_text(
        "Arrows: velocities, in one scale. Angular velocities: positive counter-clockwise.",
        0.7 * base_size
      ),
      alt = paste0(
        "Two drawings of a collision. Before: ", gsub("\n", "; ", captions[["before"]]),
        ". After: ", gsub("\n", "; ", captions[["after"]]), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(strip.text = ggplot2::element_text(face = "plain"))
}

# The two axes along which most happens, in their order.
viewed_axes <- function(state, normal) {
  share <- function(vectors) {
    size <- abs(do.call(rbind, vectors))
    if (max(size) > 0) colSums(size) / max(size) else c(0, 0, 0)
  }
  moves <- share(unlist(lapply(state, function(s) s$v), recursive = FALSE))
  lies <- share(lapply(state, function(s) s$centre))
  turns <- share(unlist(lapply(state, function(s) s$omega), recursive = FALSE))
  score <- moves + lies - 0.5 * turns + if (is.null(normal)) 0 else abs(normal) / max(abs(normal))
  sort(order(-score)[1:2])
}

# ---- bodies of a collision ----------------------------------------------------------------------

# What each body looks like, seen along the axis in which least happens, with the contact at the
# origin: list(seen, sight, names, centre, outline, arm, fixed, across, normal, reach, state).
# `outline`: a polygon about the centre, or NULL for what has no size.
collision_look <- function(x, collision, row) {
  state <- collision_state(x, collision, row)
  point <- function(part) unname(collision_row(part, x, row))
  contact <- if (is.null(collision$contact)) c(0, 0, 0) else point(collision$contact)
  normal <- if (!is.null(collision$normal)) point(collision$normal)
  seen <- viewed_axes(state, normal)
  fixed <- lapply(collision$outside, function(o) point(o$point_m) - contact)
  outline <- Map(function(party, s) {
    own <- if (!is.null(party$radius_m)) abs(point(party$radius_m))
    if (!is.null(own) && isTRUE(own > 0)) return(draw_circle(0, 0, own))
    if (is.null(normal) && length(fixed)) {
      return(hinged_outline(s, (contact + fixed[[1]])[seen], seen))
    }
    outline_of_moments(s, seen)
  }, collision$parties, state)
  centre <- lapply(state, function(s) (s$centre - contact)[seen])
  sizes <- vapply(seq_along(state), function(b) {
    own <- if (is.null(outline[[b]])) 0 else max(sqrt(rowSums(outline[[b]]^2)))
    sqrt(sum(centre[[b]]^2)) + own
  }, 0)
  reach <- max(sizes, unlist(lapply(fixed, function(p) sqrt(sum(p[seen]^2)))))
  if (!(reach > 0)) reach <- 1
  across <- if (!is.null(normal)) {
    n <- normal[seen] / sqrt(sum(normal[seen]^2))
    1.3 * reach * c(-n[2], n[1])
  }
  list(
    state = state, seen = seen, centre = centre, outline = outline, reach = reach,
    fixed = lapply(fixed, function(p) p[seen]), across = across,
    normal = if (!is.null(normal)) normal[seen] / sqrt(sum(normal[seen]^2)),
    obstacle = length(collision$outside) > 0L && !is.null(normal),
    # The sign of the rotation about the line of sight: x z is seen from -y.
    sight = list(axis = setdiff(1:3, seen), sign = if (identical(seen, c(1L, 3L))) -1 else 1)
  )
}

# A bar from the hinge through the centre of mass, as long as its moment of inertia says.
hinged_outline <- function(s, hinge, seen) {
  turning <- max(abs(s$inertia))
  if (!(s$mass > 0) || !(turning > 0)) return(NULL)
  direction <- s$centre[seen] - hinge
  long <- sqrt(sum(direction^2))
  if (long == 0) return(outline_of_moments(s, seen))
  bar_outline(direction / long * max(sqrt(3 * turning / s$mass), long))
}

bar_outline <- function(half) {
  aside <- 0.04 * c(-half[2], half[1])
  rbind(half + aside, -half + aside, -half - aside, half - aside)
}

# The homogeneous body with these second moments, as it is seen: a circle for equal ones, a bar for
# one that is long, else a box; NULL without mass or size.
outline_of_moments <- function(s, seen) {
  second <- sum(diag(s$inertia)) / 2 * diag(3) - s$inertia
  if (!(s$mass > 0) || !(max(abs(second)) > 0)) return(NULL)
  root <- eigen(second / s$mass, symmetric = TRUE)
  moments <- pmax(root$values, 0)
  if (diff(range(moments)) < 1e-6 * moments[1]) return(draw_circle(0, 0, sqrt(5 * moments[1])))
  equal <- abs(moments[1] - moments[2]) < 1e-6 * moments[1]
  line <- setdiff(1:3, seen)
  if (equal && abs(root$vectors[line, 3]) > 1 - 1e-6) {
    return(draw_circle(0, 0, 2 * sqrt(moments[1])))
  }
  semi <- sqrt(3 * moments)
  corners <- as.matrix(expand.grid(c(-1, 1), c(-1, 1), c(-1, 1))) %*%
    (semi * t(root$vectors))
  flat <- unname(corners[, seen, drop = FALSE])
  # A bar without width has a hundredth of its length.
  wide <- svd(flat)
  if (wide$d[2] < 0.04 * wide$d[1]) {
    return(bar_outline(max(sqrt(rowSums(flat^2))) * wide$v[, 1]))
  }
  flat[grDevices::chull(flat), , drop = FALSE]
}

collision_fills <- c("#A5CFEA", "#F2C879")

# ---- in motion ----------------------------------------------------------------------------------

collision_plan <- function(x, call, row = 1) {
  collision <- check_collision(x, call)
  if (nrow(x) == 0L) abort_rotdyn("{.arg x} has no collision: no rows.", "value", call)
  state <- collision_state(x, collision, row)
  if (!all(is.finite(unlist(state)))) {
    abort_rotdyn("Row {row} is not finite: there is nothing to show.", "value", call)
  }
  if (one_axle(collision, state)) return(axle_plan(state, call))
  look <- collision_look(x, collision, row)
  # Bodies cross half of the picture, or turn by a radian and a half, before and after.
  rate <- max(vapply(look$state, function(s) {
    max(vapply(1:2, function(k) {
      max(sqrt(sum(s$v[[k]][look$seen]^2)) / (1.6 * look$reach),
          if (any(s$inertia != 0)) abs(s$omega[[k]][look$sight$axis]) / 3 else 0)
    }, 0))
  }, 0))
  if (!(rate > 0)) {
    abort_rotdyn("Nothing moves in the plane of the picture: there is nothing to show.", "value",
                 call)
  }
  list(
    ends = c(-1, 1) / rate, through = 0,
    film = function(time_s) collision_film(look, names(collision$parties), time_s)
  )
}

# The picture of two disks that lock, from the side: before and after beside each other.
draw_lock <- function(state, base_size) {
  moments <- vapply(state, function(s) s$inertia[3, 3], 0)
  omega <- lapply(1:2, function(k) vapply(state, function(s) s$omega[[k]][3], 0))
  before <- draw_locking(moments, unname(omega[[1]]))
  after <- draw_locking(moments, unname(omega[[2]]), locked = TRUE)
  right <- diff(before$limits[1:2]) + 1.2
  marks <- lapply(after$marks, function(one) {
    one$points[, 1] <- one$points[, 1] + right
    one
  })
  after$labels$x <- after$labels$x + right
  after$labels$symbol <- gsub("omega", "omega*minute", after$labels$symbol, fixed = TRUE)
  top <- before$limits[4] - 0.35
  words <- rbind(word_at("before", 0.75, top), word_at("after", 0.75 + right, top))
  plain <- rbind(before$labels, after$labels)
  number <- function(x) value_text(x, "rad/s")
  key <- rbind(
    quantity("I[i]", "moment of inertia", value_text(unname(moments), "kg m^2")),
    quantity("omega[i]", "before", number(unname(omega[[1]])), "speed"),
    quantity("omega*minute[i]", "after", number(unname(omega[[2]])), "speed")
  )
  said <- function(k) paste0(names(state), ": ", format_si(signif(omega[[k]], 3)), " rad/s")
  out <- draw(
    list(
      marks = c(before$marks, marks),
      labels = rbind(cbind(plain, style = "body", hjust = 0.5), words), quantities = key,
      limits = c(before$limits[1], before$limits[2] + right, before$limits[3], top + 0.35),
      note = "from the side, not to scale"
    ), "Two disks lock", base_size
  )
  out + ggplot2::labs(alt = paste0(
    "Two drawings of a collision. Before: ", paste(said(1), collapse = "; "), ". After: ",
    paste(said(2), collapse = "; "), "."
  ))
}

# Two disks on one axle, which lock.
one_axle <- function(collision, state) {
  length(state) == 2L && !length(collision$outside) && is.null(collision$normal) &&
    all(vapply(state, function(s) s$mass == 0 && all(s$centre == 0), NA))
}

# From the side, each with a stripe that comes to the front once a turn.
axle_plan <- function(state, call) {
  omega <- lapply(state, function(s) vapply(s$omega, `[[`, 0, 3L))
  fastest <- max(abs(unlist(omega)))
  if (!(fastest > 0)) {
    abort_rotdyn("Nothing moves: there is nothing to show.", "value", call)
  }
  moments <- vapply(state, function(s) s$inertia[3, 3], 0)
  list(
    ends = c(-1, 1) * 3 * pi / fastest, through = 0,
    film = function(time_s) {
      after <- 1L + (time_s >= 0)
      rates <- rbind(omega[[1]][after], omega[[2]][after])
      frames <- lapply(seq_along(time_s), function(i) {
        c(
          draw_locking(moments, rates[, i], rates[, i] * time_s[i], after[i] == 2L),
          says = c("before", "after")[after[i]]
        )
      })
      values <- lapply(1:2, function(b) {
        list(label = paste("rate of turn,", names(state)[b]), unit = "rad/s", x = rates[b, ])
      })
      plane_film(frames, "Two disks that lock", values, frames[[1]]$quantities)
    }
  )
}

draw_locking <- function(moments, omega, theta = NULL, locked = FALSE) {
  scene <- list(omega0_rad_per_s = omega)
  out <- draw_shafting(
    scene, unname(moments), list(kind = if (locked) "locked" else "clutch", ratio = 1),
    theta = theta
  )
  out$quantities <- quantity("I[i]", "moment of inertia", value_text(moments, "kg m^2"))
  out$quantities <- rbind(
    out$quantities, quantity("omega[i]", "rate at start", value_text(omega, "rad/s"), "speed")
  )
  out
}

# Before the contact, at time 0, and after it each body moves and turns evenly. The forces of others
# (weight, hinges' springs) are no part of a collision.
collision_film <- function(look, names, time_s) {
  n <- length(names)
  hinge <- if (is.null(look$normal) && length(look$fixed)) look$fixed[[1]]
  after <- time_s >= 0
  omega <- lapply(look$state, function(s) {
    look$sight$sign * vapply(s$omega, `[[`, 0, look$sight$axis)
  })
  v <- lapply(look$state, function(s) lapply(s$v, function(one) one[look$seen]))
  turns_about_hinge <- vapply(seq_len(n), function(b) {
    if (is.null(hinge) || !any(omega[[b]] != 0)) return(FALSE)
    arm <- look$centre[[b]] - hinge
    size <- max(abs(omega[[b]])) * sqrt(sum(arm^2))
    all(vapply(1:2, function(k) {
      sqrt(sum((v[[b]][[k]] - omega[[b]][k] * c(-arm[2], arm[1]))^2)) <= 1e-9 * size
    }, NA)) && size > 0
  }, NA)
  place <- function(b, i) {
    k <- 1L + after[i]
    angle <- omega[[b]][k] * time_s[i]
    turn <- rbind(c(cos(angle), sin(angle)), c(-sin(angle), cos(angle)))
    centre <- if (turns_about_hinge[b]) {
      hinge + as.vector((look$centre[[b]] - hinge) %*% turn)
    } else {
      look$centre[[b]] + v[[b]][[k]] * time_s[i]
    }
    list(centre = centre, turn = turn, angle = angle)
  }
  speeds <- vapply(v, function(of) max(vapply(of, function(one) sqrt(sum(one^2)), 0)), 0)
  scale <- if (max(speeds) > 0) 0.9 * look$reach / max(speeds) else 0
  frames <- lapply(seq_along(time_s), function(i) {
    bodies <- lapply(seq_len(n), function(b) collision_body(look, b, place(b, i)))
    arrows <- lapply(seq_len(n), function(b) {
      from <- place(b, i)$centre
      direction <- scale * v[[b]][[1L + after[i]]]
      if (sqrt(sum(direction^2)) < 1e-3 * look$reach) return(NULL)
      mark("arrow", rbind(from, from + direction), "speed")
    })
    labels <- do.call(rbind, lapply(seq_len(n), function(b) {
      at <- place(b, i)$centre
      direction <- scale * v[[b]][[1L + after[i]]]
      # The number stands on the side that the arrow leaves free.
      aside <- if (sum(direction^2) > 0) -direction / sqrt(sum(direction^2)) else c(0, 1)
      outline <- look$outline[[b]]
      thin <- is.null(outline) || min(sqrt(rowSums(outline^2))) < 0.2 * look$reach
      at <- at + aside * if (thin) 0.1 * look$reach else 0.5 * max(outline)
      word_at(as.character(b), at[1], at[2])
    }))
    list(
      marks = c(ground_marks(look), do.call(c, bodies), Filter(Negate(is.null), arrows)),
      labels = labels, says = if (after[i]) "after" else "before"
    )
  })
  ends <- do.call(rbind, lapply(frames[c(1L, length(frames))], function(one) {
    do.call(rbind, lapply(one$marks, `[[`, "points"))
  }))
  box <- apply(rbind(ends, 0), 2, range)
  gap <- 0.15 * look$reach
  frames <- lapply(frames, function(one) {
    c(one, list(limits = c(box[1, 1] - gap, box[2, 1] + gap, box[1, 2] - gap, box[2, 2] + gap)))
  })
  values <- unlist(lapply(seq_len(n), function(b) {
    s <- look$state[[b]]
    list(
      if (s$mass > 0) {
        list(label = paste("speed,", names[b]), unit = "m/s", x = vapply(s$v, function(one) {
          sqrt(sum(one^2))
        }, 0)[1L + after])
      },
      if (any(s$inertia != 0)) {
        list(
          label = paste("rate of turn,", names[b]), unit = "rad/s",
          x = (omega[[b]] + 0)[1L + after]
        )
      }
    )
  }), recursive = FALSE)
  key <- do.call(rbind, lapply(seq_len(n), function(b) quantity(as.character(b), names[b], "")))
  plane_film(frames, "A collision", Filter(Negate(is.null), values), key)
}

# A body at its place: its outline and a line from the centre that shows how it has turned, or a
# dot.
collision_body <- function(look, b, at) {
  fill <- collision_fills[1L + (b - 1L) %% 2L]
  outline <- look$outline[[b]]
  if (is.null(outline)) {
    own <- 0.045 * look$reach
    bar <- if (is.null(look$normal) && length(look$fixed) && any(look$state[[b]]$inertia != 0)) {
      list(mark("line", rbind(look$fixed[[1]], at$centre), "body"))
    }
    return(c(bar, list(mark("fill", draw_circle(at$centre[1], at$centre[2], own), fill))))
  }
  points <- sweep(outline %*% at$turn, 2, at$centre, "+")
  far <- outline[which.max(rowSums(outline^2)), ]
  c(
    list(mark("fill", points, fill)),
    if (nrow(outline) > 20L) {
      list(mark("line", rbind(at$centre, at$centre + as.vector(0.85 * far %*% at$turn)), "body"))
    },
    list(mark("fill", draw_circle(at$centre[1], at$centre[2], 0.02 * look$reach), "shaft"))
  )
}

# The obstacle as a block, the plane of contact of two bodies dashed, hinges as triangles.
ground_marks <- function(look) {
  out <- list()
  if (look$obstacle) {
    ends <- rbind(-look$across, look$across)
    deep <- -0.12 * look$reach * look$normal
    out <- list(mark("fill", rbind(ends, ends[2:1, ] + rep(deep, each = 2)), "fixed"))
  } else if (!is.null(look$across)) {
    out <- list(mark("line", rbind(-look$across, look$across), "dashed"))
  }
  if (!is.null(look$normal)) return(out)
  size <- 0.07 * look$reach
  c(out, lapply(look$fixed, function(p) {
    mark("fill", rbind(p, p + size * c(-0.7, -1.3), p + size * c(0.7, -1.3)), "fixed")
  }))
}
