# Couplings and brakes of a drive, and rotors of a body.

#' Plot a coupling, a brake, a rotor
#'
#' Of a brake and of a clutch the torque against the motion over time and, where it is largest, over
#' the angular velocity (of a clutch the slip): dashed what it can hold at rest, where that differs.
#' Shafts and gears are drawn between two rotors, with the sense of their rates. A rotor is a wheel
#' on its axis in the axes of its body; the arrow is its angular velocity.
#'
#' @param object A [brake()], a coupling ([coupling_clutch()], [coupling_shaft()],
#'   [coupling_gear()]) or a [rotor()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`; `rotdyn_error_torque` for a capacity that is not
#'   finite.
#' @seealso [couplings], [rotor()], [autoplot.rot_scene()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(brake(12, static_ratio = 1.3, from_s = 2, to_s = 3.5))
#' ggplot2::autoplot(coupling_gear(-3, efficiency = 0.97))
#' ggplot2::autoplot(rotor(c(0, 0, 1), 0.02, 300))
#' @name autoplot.couplings
#' @concept plot
#' @concept drawing of gears
NULL

#' @rdname autoplot.couplings
#' @exportS3Method ggplot2::autoplot
autoplot.rot_brake <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, brake_form, "object", "brake", call)
  plot_friction(object, "A brake", "angular velocity", base_size, call)
}

#' @rdname autoplot.couplings
#' @exportS3Method ggplot2::autoplot
autoplot.rot_coupling <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, coupling_form, "object", "coupling", call)
  if (is_coupling(object, "clutch")) {
    return(plot_friction(object, "A clutch", "slip", base_size, call))
  }
  shaft <- is_coupling(object, "shaft")
  ratio <- object$ratio
  title <- if (shaft) "An elastic shaft between two rotors" else "A gear between two rotors"
  draw(draw_coupling(object, shaft, ratio), title, base_size)
}

# `over`: what the torque depends on besides time.
plot_friction <- function(object, title, over, base_size, call) {
  law <- object$capacity_n_m
  laws <- if (inherits(law, "rot_torque_sum")) law$laws else list(law)
  if (any(vapply(laws, law_variable, "") != "time")) {
    abort_rotdyn("A capacity that depends on the motion is not drawn.", "value", call)
  }
  switches <- c(object$from_s, object$to_s)
  switches <- switches[is.finite(switches)]
  ends <- law_range(laws, "time")
  ends <- if (length(switches)) {
    own <- range(unlist(lapply(laws, breaks_of_law)), switches)
    widened(if (diff(own) > 0) own else own + c(-1, 1), 0.2)
  } else {
    ends
  }
  before <- switches - 1e-9 * diff(ends)
  at <- sort(unique(c(law_grid(laws, "time", ends), switches, before)))
  capacity <- Reduce(`+`, lapply(laws, law_values, at, call))
  capacity[at < object$from_s | at >= object$to_s] <- 0
  highest <- max(capacity)
  labels <- c("over time (s)", paste0("over the ", over, " (rad/s)"))
  kinds <- c("slipping", "at rest, at most")
  speed <- c(-10, 0, 0, 10)
  lines <- rbind(
    data.frame(at = at, value = capacity, kind = kinds[1], panel = labels[1], side = 1),
    data.frame(
      at = speed, value = highest * c(-1, -1, 1, 1), kind = kinds[1], panel = labels[2],
      side = c(-1, -1, 1, 1)
    )
  )
  ratio <- object$static_ratio
  # At rest the torque is whatever is needed, between the dots.
  dots <- data.frame(at = c(0, 0), value = c(-1, 1) * ratio * highest, panel = labels[2])
  if (ratio > 1) {
    held <- lines[lines$panel == labels[1], ]
    held$value <- ratio * held$value
    held$kind <- kinds[2]
    lines <- rbind(held, lines)
  }
  lines$kind <- factor(lines$kind, kinds)
  lines$panel <- factor(lines$panel, labels)
  dots$panel <- factor(dots$panel, labels)
  words <- describe_friction(object)
  ggplot2::ggplot(lines, ggplot2::aes(.data$at, .data$value)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey80") +
    ggplot2::geom_line(
      ggplot2::aes(linetype = .data$kind, group = paste(.data$kind, .data$side)),
      colour = plot_colours[2], linewidth = 0.06 * base_size
    ) +
    ggplot2::geom_line(data = dots, colour = plot_colours[2], linetype = "13") +
    ggplot2::geom_point(data = dots, colour = plot_colours[2], size = 0.2 * base_size) +
    ggplot2::facet_wrap(
      "panel", scales = "free_x", ncol = 2, labeller = ggplot2::as_labeller(function(text) {
        vapply(text, wrap_label, "", size = 0.75 * base_size, width_in = 2.9)
      })
    ) +
    ggplot2::scale_linetype_manual(
      values = stats::setNames(c("solid", "42"), kinds), breaks = kinds[kinds %in% lines$kind],
      name = NULL, guide = if (ratio > 1) "legend" else "none"
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size)) +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(words, base_size),
      x = NULL, y = "torque (N m)",
      alt = paste0(
        title, ": ", words, ". Lines of its torque over time, at most ",
        format_si(signif(highest, 4)), " N m, and over the ", over, "; dots at ",
        format_si(signif(ratio * highest, 4)), " N m, the most at rest."
      )
    ) +
    plot_theme(base_size)
}

draw_coupling <- function(object, shaft, ratio) {
  out <- draw_shafting(
    list(stiffness_n_m_per_rad = if (shaft) object$stiffness_n_m_per_rad else 1,
         omega0_rad_per_s = c(1, sign(ratio))),
    c(1, 1), list(kind = if (shaft) "spring" else "gear", ratio = ratio)
  )
  out$labels <- out$labels[!startsWith(out$labels$symbol, "I"), ]
  speeds <- paste0("1 to ", fraction_text(ratio))
  out$quantities <- rbind(
    if (shaft) rbind(
      quantity("k[1]", "stiffness", value_text(object$stiffness_n_m_per_rad, "N m/rad"), "spring"),
      if (object$damping_n_m_s > 0) {
        quantity("", "damping", value_text(object$damping_n_m_s, "N m s"), "spring")
      }
    ),
    quantity("omega[i]", if (shaft) "rates without twist" else "rates", speeds, "speed"),
    if (ratio != 1) quantity("", "ratio", format_si(ratio)),
    if (!shaft && object$efficiency < 1) {
      quantity("", "efficiency", format_si(object$efficiency), "resistance")
    }
  )
  out$note <- if (shaft && abs(ratio) == 1) "from the side" else "from the side; wheels to scale"
  out
}

#' @rdname autoplot.couplings
#' @exportS3Method ggplot2::autoplot
autoplot.rot_rotor <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, rotor_form, "object", "rotor", call)
  draw(draw_rotor(object), "A rotor in its body", base_size)
}

draw_rotor <- function(x) {
  d <- new_drawing()
  solid <- unit_cylinder(3L)
  axes <- qr.Q(qr(cbind(x$axis, diag(3))))[, c(2, 3, 1)]
  solid$points <- solid$points %*% (c(0.5, 0.5, 0.1) * t(axes))
  solid$faces <- outward(solid$points, solid$faces)
  torque <- if (is.numeric(x$torque) && x$torque != 0) x$torque * x$axis
  still <- space_still(
    c(solid, list(tip = x$axis, held = FALSE)), diag(3),
    list(omega = x$omega_rad_per_s * x$axis, tau = torque)
  )
  view <- view_of_space() * still$unit
  for (k in 1:3) {
    tip <- view[, k]
    d$add(mark("line", rbind(c(0, 0), tip), "dashed"))
    # Beside the line: the angular velocity may lie on it.
    aside <- 0.13 * c(tip[2], -tip[1]) / length_of(tip)
    d$say(paste0("e[", c("x", "y", "z")[k], "]"), tip[1] + aside[1], tip[2] + aside[2])
  }
  for (one in still$marks) d$add(one)
  for (k in seq_len(NROW(still$labels))) do.call(d$say, as.list(still$labels[k, ]))
  d$key(quantity("e[i]", "axes of the body", ""))
  axis <- paste0("(", paste(format_si(signif(x$axis, 3)), collapse = ", "), ")")
  d$key(quantity("", "axis", axis))
  d$key(quantity("", "moment of inertia", value_text(x$moment_of_inertia_kg_m2, "kg m^2")))
  d$key(quantity(
    "omega", "rate relative to the body", value_text(x$omega_rad_per_s, "rad/s"), "speed"
  ))
  momentum <- x$moment_of_inertia_kg_m2 * x$omega_rad_per_s
  d$key(quantity("", "angular momentum", value_text(momentum, "kg m^2/s"), "speed"))
  words <- sub("^.*rad/s, ", "", describe_rotor(x))
  d$key(if (is.null(torque)) {
    quantity("", if (words == "driven") "driven at a constant rate" else words, "", "torque")
  } else {
    quantity("tau", "motor", value_text(x$torque, "N m"), "torque")
  })
  d$done(c(-1.5, 1.5, -1.5, 1.5), "not to scale")
}
