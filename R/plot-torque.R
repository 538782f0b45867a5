#' Plot a torque law
#'
#' A law over what it depends on: time, angular velocity, angle. The laws of a sum that depend on
#' one of them are drawn as their sum. Knots and points of a curve are marked.
#'
#' @param object A [torque] law.
#' @inheritParams autoplot.rot_trajectory
#' @param time_s,omega_rad_per_s,theta_rad NULL, or the ranges to draw: two numbers each. An R
#'   function of time, angle and rate is called at the angle 0 and the rate 0.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`, `rotdyn_error_unit`;
#'   `rotdyn_error_torque` for an R function that gives no finite number.
#' @seealso [torque], [torque-terms].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)))
#' ggplot2::autoplot(torque_motor(2, 300) + torque_pulse(1, 0.2, 3))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept torque over time
autoplot.rot_torque <- function(object, ..., time_s = NULL, omega_rad_per_s = NULL,
                                theta_rad = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, torque_form, "object", "torque law", call)
  laws <- if (inherits(object, "rot_torque_sum")) object$laws else list(object)
  over <- vapply(laws, law_variable, "")
  asked <- list(
    time = check_range(time_s, "time_s", "s", call),
    omega = check_range(omega_rad_per_s, "omega_rad_per_s", "rad/s", call),
    theta = check_range(theta_rad, "theta_rad", "rad", call)
  )
  labels <- c(
    time = "over time (s)", omega = "over angular velocity (rad/s)", theta = "over angle (rad)"
  )
  used <- names(labels)[names(labels) %in% over]
  parts <- lapply(used, function(variable) {
    own <- laws[over == variable]
    range <- asked[[variable]] %||% law_range(own, variable)
    at <- law_grid(own, variable, range)
    data.frame(
      at = at, value = Reduce(`+`, lapply(own, law_values, at, call)), panel = labels[[variable]]
    )
  })
  lines <- do.call(rbind, parts)
  lines$panel <- factor(lines$panel, unique(lines$panel))
  marks <- do.call(rbind, lapply(which(over != "theta"), function(i) {
    points <- law_points(laws[[i]])
    alone <- sum(over == over[i]) == 1L
    if (!alone || nrow(points) > 40L || !nrow(points)) return(NULL)
    range <- asked[[over[i]]] %||% range(points$at)
    points <- points[points$at >= range[1] & points$at <= range[2], ]
    if (nrow(points)) cbind(points, panel = labels[[over[i]]])
  }))
  of_state <- any(vapply(laws, function(law) identical(law$arguments, 3L), NA))
  words <- gsub("\n +", " ", describe_torque(object))
  plot <- ggplot2::ggplot(lines, ggplot2::aes(.data$at, .data$value)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey80") +
    ggplot2::geom_line(colour = plot_colours[2], linewidth = 0.06 * base_size)
  if (!is.null(marks)) {
    marks$panel <- factor(marks$panel, levels(lines$panel))
    plot <- plot +
      ggplot2::geom_point(data = marks, colour = plot_colours[2], size = 0.16 * base_size)
  }
  alone <- length(used) == 1L
  plot +
    ggplot2::facet_wrap(
      "panel", scales = "free_x", ncol = if (base_size > 16) 1 else length(used),
      labeller = ggplot2::as_labeller(function(text) {
        columns <- if (base_size > 16) 1 else length(used)
        vapply(text, wrap_label, "", size = 0.75 * base_size, width_in = 6.2 / columns - 0.1)
      })
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title("A torque law", base_size),
      subtitle = wrap_subtitle(
        c(shortened(words, 2 * 6.7 * 72 / text_width("x", 0.8 * base_size) - 12),
          if (of_state) "drawn at theta = 0 and omega = 0"), base_size
      ),
      x = if (alone) sub("over ", "", labels[[used]]), y = "torque (N m)",
      alt = paste0(
        "Torque law: ", words, ". ", paste(vapply(split(lines, lines$panel), function(x) {
          paste0(
            x$panel[1], " from ", range_in_words(x$at), ": ", range_in_words(x$value), " N m"
          )
        }, ""), collapse = "; "), "."
      )
    ) +
    plot_theme(base_size) +
    (if (alone) ggplot2::theme(strip.text = ggplot2::element_blank()))
}

shortened <- function(text, room) {
  if (nchar(text) > room) paste0(substr(text, 1L, room - 4L), " ...") else text
}

check_range <- function(x, arg, unit, call) {
  if (is.null(x)) return(NULL)
  x <- check_finite(x, arg, unit, call)
  if (length(x) != 2L) {
    abort_rotdyn(
      c("{.arg {arg}} must be two numbers.", x = "It has {length(x)}."), "size", call
    )
  }
  if (!(x[1] < x[2])) {
    abort_rotdyn("{.arg {arg}} must increase; it is {format(x[1])}, {format(x[2])}.", "value", call)
  }
  x
}

# Points that a law was given by.
law_points <- function(law) {
  if (inherits(law, "rot_torque_knots")) {
    return(data.frame(at = law$time_s, value = law$torque_n_m))
  }
  if (inherits(law, "rot_torque_term") && law$kind == "curve") {
    n <- law$x[1]
    return(data.frame(at = law$x[2:(n + 1)], value = law$x[(n + 2):(2 * n + 1)]))
  }
  data.frame(at = double(), value = double())
}

# A range that shows the law: a tenth more than its breaks; three periods, five times of decay; from
# rest to no load; a turn.
law_range <- function(laws, variable) {
  if (variable == "theta") {
    rest <- vapply(laws, function(law) law$x[2], 1)
    return(range(rest) + c(-pi, pi))
  }
  if (variable == "omega") {
    ends <- unlist(lapply(laws, function(law) {
      if (inherits(law, "rot_torque_motor")) law$no_load_omega_rad_per_s else law_points(law)$at
    }))
    return(widened(range(c(0, ends)), 0.05))
  }
  breaks <- unlist(lapply(laws, breaks_of_law))
  reach <- unlist(lapply(laws, function(law) {
    if (!inherits(law, "rot_torque_term")) return(NULL)
    start <- if (is.finite(law$from_s)) law$from_s else 0
    switch(law$kind,
      sinusoid = if (law$x[2] != 0) start + c(0, 6 * pi / abs(law$x[2])),
      exponential = start + c(0, if (law$x[2] != 0) 5 / abs(law$x[2]) else 1)
    )
  }))
  from <- min(c(breaks, reach, if (!length(breaks)) 0))
  to <- max(c(breaks, reach, if (length(c(breaks, reach)) < 2L) from + 1))
  if (length(breaks)) widened(c(from, to), 0.1) else c(from, to)
}

widened <- function(ends, share) {
  by <- share * diff(ends)
  if (by == 0) by <- 1
  ends + c(-by, by)
}

# Even points, and both sides of each break.
law_grid <- function(laws, variable, range) {
  even <- seq(range[1], range[2], length.out = 601L)
  if (variable == "theta") return(even)
  own <- unlist(lapply(laws, if (variable == "time") breaks_of_law else function(law) {
    law_points(law)$at
  }))
  own <- own[own >= range[1] & own <= range[2]]
  sort(unique(c(even, own, pmax(own - 1e-9 * diff(range), range[1]))))
}

#' Plot a force
#'
#' A force over time; one of position and velocity, too, where both are 0.
#'
#' @param object From [force_function()].
#' @inheritParams autoplot.rot_trajectory
#' @param time_s NULL, or the times to draw: two numbers.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` for a force that is not finite.
#' @seealso [force_function()], [autoplot.rot_torque()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' push <- force_function(function(time_s) if (time_s < 1) 20 else 0, breaks_s = 1)
#' ggplot2::autoplot(push)
#' @exportS3Method ggplot2::autoplot
#' @concept plot
autoplot.rot_force_function <- function(object, ..., time_s = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  f <- .subset2(object, "f")
  breaks <- .subset2(object, "breaks_s")
  if (!is.function(f)) abort_form("f", "object", "force", call)
  if (!is.null(breaks) && !is.numeric(breaks)) abort_form("breaks_s", "object", "force", call)
  ends <- check_range(time_s, "time_s", "s", call) %||%
    if (length(breaks)) range(breaks, 0, 1.25 * breaks) else c(0, 1)
  own <- breaks[breaks > ends[1] & breaks < ends[2]]
  at <- sort(unique(c(seq(ends[1], ends[2], length.out = 401L), own, own - 1e-9 * diff(ends))))
  all <- count_law_arguments(f, function(n) abort_form("f", "object", "force", call)) == 3L
  value <- vapply(at, function(t) {
    one <- if (all) f(t, 0, 0) else f(t)
    if (is.numeric(one) && length(one) == 1L) as.double(one) else NA_real_
  }, double(1))
  if (!all(is.finite(value))) {
    abort_rotdyn("The force is not finite at {at[!is.finite(value)][1]} s.", "value", call)
  }
  ggplot2::ggplot(data.frame(at, value), ggplot2::aes(.data$at, .data$value)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey80") +
    ggplot2::geom_line(colour = plot_colours[2], linewidth = 0.06 * base_size) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::labs(
      title = wrap_title("A force over time", base_size),
      subtitle = if (all) wrap_subtitle("where position and velocity are 0", base_size),
      x = "time (s)", y = "force (N)",
      alt = paste0(
        "A line of a force, ", range_in_words(value), " N, over time, ", range_in_words(at), " s",
        if (length(own)) paste0(", with breaks at ", paste(format_si(own), collapse = ", "), " s"),
        "."
      )
    ) +
    plot_theme(base_size)
}
