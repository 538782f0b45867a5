#' Plot a motion along a curve
#'
#' The track and the path of the centre, to scale, with the body's places at equal intervals of time
#' and how it ends. A body whose radius is known is drawn with it, on its track.
#'
#' @param object From [roll_on_curve()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [roll_on_curve()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(roll_on_curve(curve_cycloid(1), 0, 2 * pi, body = 2 / 5))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept loop
#' @concept track
autoplot.rot_curve_motion <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  run <- check_curve_motion(object, call)
  for (name in c("time_s", "x_m", "y_m", "v_m_per_s")) {
    if (!is.double(object[[name]])) abort_form(name, "object", "motion along a curve", call)
  }
  path <- data.frame(x = object$x_m, y = object$y_m, time = object$time_s, v = object$v_m_per_s)
  even <- seq(0, max(path$time), length.out = 13L)
  at <- function(column) stats::approx(path$time, column, even, ties = "ordered")$y
  places <- data.frame(x = at(path$x), y = at(path$y), v = at(path$v))
  step <- format_si(signif(even[2], 3))
  last <- run$last
  end <- data.frame(x = last$x_m, y = last$y_m)
  words <- c(arrives = "arrives", turns = "turns", leaves = "leaves the track", slips = "slips")
  said <- paste0(words[[last$event]], " after ", format_si(signif(last$time_s, 4)), " s")
  size <- max(diff(range(path$x)), diff(range(path$y)))
  radius <- stats::median((object$v_m_per_s / object[["omega_rad_per_s"]]), na.rm = TRUE)
  known <- isTRUE(radius > 0.005 * size && radius < 0.25 * size)
  track <- track_of(path$x, path$y, if (known) radius else 0, run$direction %||% 1)
  balls <- if (known) {
    do.call(rbind, lapply(seq_len(nrow(places)), function(k) {
      rim <- draw_circle(places$x[k], places$y[k], radius)
      data.frame(x = rim[, 1], y = rim[, 2], id = k)
    }))
  }
  ggplot2::ggplot(path, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_path(data = track, colour = "grey40", linewidth = 0.11 * base_size) +
    (if (known) {
      ggplot2::geom_polygon(
        ggplot2::aes(group = .data$id), balls, fill = draw_fills[["body"]], colour = plot_edge,
        linewidth = 0.3
      )
    }) +
    ggplot2::geom_path(colour = "grey60", linewidth = 0.03 * base_size, linetype = "22") +
    ggplot2::geom_point(ggplot2::aes(colour = .data$v), places, size = 0.2 * base_size) +
    ggplot2::geom_point(data = end, shape = 4, size = 0.3 * base_size, stroke = 1.2) +
    ggplot2::scale_colour_gradient(
      low = "#56B4E9", high = "#D55E00", name = "speed (m/s)", breaks = plot_breaks(base_size, 4)
    ) +
    ggplot2::coord_fixed() +
    ggplot2::labs(
      title = wrap_title(sentence(paste("the body", said)), base_size),
      subtitle = wrap_subtitle(
        paste("a point every", step, "s; the cross: the end; dashed: the centre's path"), base_size
      ),
      x = "x (m)", y = "y (m)",
      alt = paste0("A path from (", format_si(signif(path$x[1], 3)), ", ",
                   format_si(signif(path$y[1], 3)), ") m to (", format_si(signif(last$x_m, 3)),
                   ", ", format_si(signif(last$y_m, 3)), ") m: the body ", said, ".")
    ) +
    plot_theme(base_size) +
    ggplot2::theme(legend.key.width = ggplot2::unit(2.2 * base_size, "pt"))
}

# What the body rolls on: to the right of the path as its parameter grows, by the body's radius.
track_of <- function(x, y, radius, direction) {
  n <- length(x)
  after <- c(seq_len(n)[-1], n)
  before <- c(1L, seq_len(n)[-n])
  dx <- x[after] - x[before]
  dy <- y[after] - y[before]
  long <- pmax(sqrt(dx^2 + dy^2), .Machine$double.xmin)
  data.frame(x = x + direction * radius * dy / long, y = y - direction * radius * dx / long)
}

#' Plot a curve
#'
#' The curve on which a body may roll, to scale, between two places.
#'
#' @param object From [curve_function()], [curve_path()], [curve_table()], [curve_circle()] or
#'   [curve_cycloid()].
#' @inheritParams autoplot.rot_trajectory
#' @param from,to NULL, or the ends, as those of [roll_on_curve()]: by default the ends of a table,
#'   a full turn of a circle or a cycloid, else -1 and 1.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` for a curve that is not finite.
#' @seealso [roll_on_curve()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(curve_cycloid(1))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
autoplot.rot_curve <- function(object, ..., from = NULL, to = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, curve_form, "object", "curve", call)
  ends <- if (length(object$knots) > 1L) {
    range(object$knots)
  } else if (grepl("circle", object$kind)) {
    c(-pi, pi)
  } else if (grepl("cycloid", object$kind)) {
    c(0, 2 * pi)
  } else {
    c(-1, 1)
  }
  if (!is.null(from)) ends[1] <- check_number(from, "from", "1", call)
  if (!is.null(to)) ends[2] <- check_number(to, "to", "1", call)
  if (!(ends[1] < ends[2])) {
    abort_rotdyn("{.arg to} must be greater than {.arg from}.", "value", call)
  }
  u <- seq(ends[1], ends[2], length.out = 601L)
  line <- data.frame(x = as.double(object$x(u)), y = as.double(object$y(u)))
  if (!all(is.finite(unlist(line)))) {
    abort_rotdyn("The curve is not finite between {ends[1]} and {ends[2]}.", "value", call)
  }
  knots <- object$knots[object$knots >= ends[1] & object$knots <= ends[2]]
  points <- data.frame(x = as.double(object$x(knots)), y = as.double(object$y(knots)))
  title <- paste("A curve:", object$kind)
  ggplot2::ggplot(line, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_path(colour = plot_ink, linewidth = 0.09 * base_size) +
    ggplot2::geom_point(data = points, colour = plot_colours[2], size = 0.2 * base_size) +
    ggplot2::coord_equal() +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title(title, base_size), x = "x (m)", y = "y (m)",
      alt = paste0(
        title, ". It spans ", range_in_words(line$x), " m along x and ", range_in_words(line$y),
        " m along y.", if (nrow(points)) paste0(" Dots: the ", nrow(points), " points of a table.")
      )
    ) +
    plot_theme(base_size)
}
