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
  point <- function(part) unname(collision_row(part, object, row))
  contact <- if (is.null(collision$contact)) c(0, 0, 0) else point(collision$contact)
  normal <- if (!is.null(collision$normal)) point(collision$normal)
  seen <- viewed_axes(state, normal)
  flat <- function(v) v[seen]
  # The sign of the rotation about the line of sight: x z is seen from -y.
  sight <- list(setdiff(1:3, seen), if (identical(seen, c(1L, 3L))) -1 else 1)

  names <- names(state)
  times <- factor(c("before", "after"), c("before", "after"))
  centres <- do.call(rbind, lapply(state, function(s) flat(s$centre - contact)))
  radius <- vapply(collision$parties, function(party) {
    if (is.null(party$radius_m)) NA_real_ else abs(point(party$radius_m))
  }, double(1))
  reach <- max(sqrt(rowSums(centres^2)), radius, 0, na.rm = TRUE)
  if (reach == 0) reach <- 1
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
    data.frame(x = centres[b, 1], y = centres[b, 2], xend = 0, yend = 0)
  })
  arrows <- rows(function(b, k) {
    v <- flat(state[[b]]$v[[k]]) * scale
    if (sqrt(sum(v^2)) < 1e-3 * reach) return(NULL)
    data.frame(
      x = centres[b, 1], y = centres[b, 2], xend = centres[b, 1] + v[1],
      yend = centres[b, 2] + v[2]
    )
  })
  turn <- seq(0, 2 * pi, length.out = 121)
  rims <- rows(function(b, k) {
    if (!is.na(radius[b])) {
      data.frame(
        x = centres[b, 1] + radius[b] * cos(turn), y = centres[b, 2] + radius[b] * sin(turn)
      )
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
  fixed <- do.call(rbind, lapply(collision$outside, function(o) flat(point(o$point_m) - contact)))
  across <- if (!is.null(normal)) {
    n <- flat(normal) / sqrt(sum(flat(normal)^2))
    1.3 * reach * c(-n[2], n[1])
  }
  plot <- ggplot2::ggplot() +
    ggplot2::facet_wrap("time", labeller = ggplot2::as_labeller(function(time) {
      paste0(time, "\n", captions[time])
    })) +
    ggplot2::coord_equal()
  if (!is.null(across)) {
    plot <- plot + ggplot2::annotate(
      "segment", x = -across[1], y = -across[2], xend = across[1], yend = across[2],
      colour = "grey55", linewidth = if (length(collision$outside)) 1.4 else 0.4
    )
  }
  if (!is.null(fixed) && is.null(normal)) {
    if (is.null(rims)) { # what is hinged, from there to the contact
      plot <- plot + ggplot2::annotate(
        "segment", x = fixed[, 1], y = fixed[, 2], xend = 0, yend = 0, colour = "grey75",
        linewidth = 2.5
      )
    }
    plot <- plot + ggplot2::annotate(
      "point", x = fixed[, 1], y = fixed[, 2], shape = 17, size = 3, colour = "grey30"
    )
  }
  if (!is.null(rims)) {
    plot <- plot + ggplot2::geom_path(
      ggplot2::aes(.data$x, .data$y, colour = .data$body), rims, linewidth = 0.8
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
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size)) +
    ggplot2::labs(
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
