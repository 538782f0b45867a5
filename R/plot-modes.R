#' Plot the modes of a shaft
#'
#' The shape of each mode: the angles of the rotors relative to the largest one, which is 1. Rotors
#' on one side of 0 turn alike, others against them; a crossing of 0 is a node.
#'
#' @param object Modes, from [shaft_modes()].
#' @inheritParams autoplot.rot_trajectory
#' @param modes NULL for the first six, or the numbers of the modes to draw.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [shaft_modes()], [scene_rotors()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(shaft_modes(scene_rotors(c(1, 2, 1, 4), stiffness_n_m_per_rad = 500)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept mode shapes
autoplot.rot_shaft_modes <- function(object, ..., modes = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  shaft <- attr(object, "shaft")
  shapes <- mode_shapes(shaft$moment_of_inertia_kg_m2, shaft$stiffness_n_m_per_rad)
  n <- ncol(shapes)
  modes <- if (is.null(modes)) {
    seq_len(min(n, 6L))
  } else {
    modes <- check_finite(modes, "modes", "1", call)
    if (!length(modes) || !all(modes %in% seq_len(n))) {
      abort_rotdyn("{.arg modes} must be numbers from 1 to {n}.", "value", call)
    }
    unique(modes)
  }
  rate <- object$natural_rad_per_s[match(modes, object$mode)]
  label <- paste0("mode ", modes, " (", format_si(signif(rate, 3)), " rad/s)")
  long <- do.call(rbind, lapply(seq_along(modes), function(k) {
    data.frame(
      rotor = seq_len(n), value = shapes[, modes[k]], panel = factor(label[k], levels = label)
    )
  }))
  cols <- if (length(modes) %in% c(3L, 5:9) && base_size <= 16) 3L else
    if (length(modes) > 2L) 2L else 1L
  rotors <- if (n <= 8L) seq_len(n) else function(limits) {
    at <- unique(round(pretty(limits, 5)))
    at[at >= 1 & at <= n]
  }
  ggplot2::ggplot(long, ggplot2::aes(.data$rotor, .data$value)) +
    ggplot2::geom_hline(yintercept = 0, colour = "grey60") +
    ggplot2::geom_line(colour = plot_colours[1], linewidth = 0.05 * base_size) +
    ggplot2::geom_point(colour = plot_colours[1], size = 0.2 * base_size) +
    ggplot2::facet_wrap(
      "panel", ncol = cols, labeller = ggplot2::as_labeller(function(x) {
        vapply(x, wrap_label, "", size = 0.75 * base_size, width_in = 6.4 / cols - 0.4)
      })
    ) +
    ggplot2::scale_x_continuous(breaks = rotors, guide = plot_axis()) +
    ggplot2::scale_y_continuous(limits = c(-1.15, 1.15), breaks = c(-1, 0, 1)) +
    ggplot2::labs(
      title = wrap_title("Modes of a shaft", base_size), x = "rotor", y = "relative angle",
      alt = paste0("Shapes of modes. ", paste0(
        label, ": ", vapply(modes, function(k) {
          paste(format_si(signif(shapes[, k], 2)), collapse = ", ")
        }, ""), collapse = "; "
      ), ".")
    ) +
    plot_theme(base_size)
}

# The shapes in columns, ascending: eigenvectors of J^-1/2 K J^-1/2, good to the eye; the largest
# angle of each is 1. The frequencies are those of the C core.
mode_shapes <- function(inertia, stiffness) {
  n <- length(inertia)
  if (n == 1L) return(matrix(1))
  spring <- diff(diag(n)) * sqrt(stiffness)
  root <- sqrt(inertia)
  found <- eigen(crossprod(spring %*% diag(1 / root, n)), symmetric = TRUE)
  shapes <- found$vectors[, n:1, drop = FALSE] / root
  apply(shapes, 2, function(shape) {
    shape <- shape / shape[which.max(abs(shape))]
    shape[abs(shape) < 1e-9] <- 0
    shape
  })
}
