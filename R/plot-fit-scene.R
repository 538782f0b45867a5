# Pictures of fits: the records with the fitted motion, and what is left over.

#' Plot a fit
#'
#' | kind | picture |
#' |---|---|
#' | `"motion"` | for each observed column the samples with the fitted motion, and the residuals with two standard deviations of their noise; outliers are crosses |
#' | `"profiles"` | for each unknown the distance from the fit by the growth of the sum of squares ([profile()]), over the values at which it is held; straight where the problem is linear, beside the line of the standard error |
#' | `"pairs"` | for each two unknowns the ellipses that hold 68 and 95 % of the probability |
#'
#' Of a [fit_design()]: by how much each further record would reduce each standard error.
#'
#' @param object A [fit_scene()], or a [fit_design()].
#' @inheritParams autoplot.rot_trajectory
#' @param kind One of these kinds.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`.
#' @seealso [fit_scene()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' wheel <- scene_axle(0.5, resistance = resistance(coulomb_n_m = 0.2), omega0_rad_per_s = 3)
#' set.seed(1)
#' film <- trajectory(wheel, 0:60 / 6)[c("time_s", "theta_rad")]
#' film$theta_rad <- film$theta_rad + rnorm(61, 0, 0.05)
#' fit <- fit_scene(wheel, film, c("resistance$coulomb_n_m", "omega0_rad_per_s"))
#' ggplot2::autoplot(fit)
#' ggplot2::autoplot(fit, kind = "pairs")
#' @exportS3Method ggplot2::autoplot
#' @concept plot
autoplot.rot_fit <- function(object, ..., kind = "motion", base_size = 13) {
  call <- check_plot(base_size, ...)
  kind <- check_string(kind, "kind", c("motion", "profiles", "pairs"), call)
  fit <- fit_of(object, call, "object")
  draw <- switch(kind,
    motion = plot_fit_motion, profiles = plot_fit_profiles, pairs = plot_fit_pairs
  )
  draw(object, fit, base_size, call)
}

plot_fit_motion <- function(object, fit, base_size, call) {
  rows <- augment.rot_fit(object)
  noise <- noise_table(fit)
  columns <- unique(rows$column)
  records <- unique(rows$record)
  unit <- noise$unit[match(columns, noise$column)]
  label <- paste0(columns, ifelse(is.na(unit) | unit %in% c("", "1"), "", paste0(" (", unit, ")")))
  panels <- c(rbind(label, paste("left over:", label)))
  panel <- function(column, residual) {
    factor(panels[2 * match(column, columns) - !residual], panels)
  }
  samples <- data.frame(
    x = rep(rows$time_s, 2), y = c(rows$measured, rows$residual), record = rep(rows$record, 2),
    panel = panel(rep(rows$column, 2), rep(c(FALSE, TRUE), each = nrow(rows)))
  )
  lines <- do.call(rbind, lapply(seq_along(records), function(r) fitted_line(fit, r, call)))
  lines$panel <- panel(lines$column, FALSE)
  lines$record <- records[lines$record]
  band <- data.frame(
    low = -2 * noise$sigma, high = 2 * noise$sigma, panel = panel(noise$column, TRUE)
  )
  band <- band[!duplicated(band$panel), ]
  several <- length(records) > 1L
  samples$record <- factor(samples$record, records)
  lines$record <- factor(lines$record, records)
  said <- paste0(object$unknown, " ", ifelse(
    is.nan(object$standard_error), object$status,
    vapply(seq_along(object$value), function(i) {
      if (is.nan(object$standard_error[i])) "" else
        with_error(object$value[i], object$standard_error[i])
    }, "")
  ), collapse = ", ")
  colour <- function(of) if (several) ggplot2::aes(colour = .data$record) else ggplot2::aes()
  one <- plot_colours[1]
  left <- rep(rows$outlier, 2)
  points <- list(
    data = samples[!left, ], mapping = colour(), size = 0.07 * base_size, na.rm = TRUE
  )
  curve <- list(data = lines, mapping = colour(), linewidth = 0.05 * base_size)
  if (!several) {
    points$colour <- "grey45"
    curve$colour <- one
  }
  picture <- ggplot2::ggplot(samples, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_rect(
      ggplot2::aes(ymin = .data$low, ymax = .data$high), band, xmin = -Inf, xmax = Inf,
      fill = "grey50", alpha = 0.15, inherit.aes = FALSE
    ) +
    do.call(ggplot2::geom_point, points) +
    do.call(ggplot2::geom_line, curve) +
    ggplot2::geom_point(
      data = samples[left, ], shape = 4, size = 0.18 * base_size, colour = plot_colours[2],
      na.rm = TRUE
    ) +
    ggplot2::facet_wrap(~panel, ncol = if (length(columns) > 1L) 2L else 1L, scales = "free_y") +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4)) +
    ggplot2::labs(
      title = wrap_title("The motion fitted, and what it leaves over", base_size),
      subtitle = wrap_subtitle(said, base_size), x = "time (s)", y = NULL, colour = NULL,
      alt = paste0(
        "Samples of ", paste(columns, collapse = ", "),
        " with the fitted motion, and residuals of ",
        paste(format_each(signif(noise$sigma, 2)), collapse = ", "), "; ", said, "."
      )
    ) +
    plot_theme(base_size)
  if (several) picture <- picture + ggplot2::scale_colour_manual(
    values = rep_len(plot_colours, length(records))
  )
  picture
}

# The fitted motion of record r at 201 times, by column, with offset and factor.
fitted_line <- function(fit, r, call) {
  record <- fit$about$records[[r]]
  times <- seq(record$time_s[1], record$time_s[length(record$time_s)], length.out = 201)
  series <- predicted_series(fit$about, fit$found$x, r, times, call)
  do.call(rbind, lapply(names(series), function(name) {
    data.frame(x = times, y = series[[name]], column = name, record = r)
  }))
}

# Unknowns with their units, for strips and axes.
fitted_labels <- function(object, fit) {
  unit <- ifelse(is.na(object$unit) | object$unit %in% c("", "1"), "",
                 paste0(" (", object$unit, ")"))
  paste0(sub("$", "$\n", fit$about$parameters$name, fixed = TRUE), unit)
}

check_some_errors <- function(object, n, call) {
  known <- which(!is.nan(object$standard_error))
  if (length(known) >= n) return(known)
  abort_rotdyn(c(
    "The picture needs {n} unknown{?s} with {?a standard error/standard errors}.",
    x = "The fit has {length(known)}."
  ), "value", call)
}

plot_fit_profiles <- function(object, fit, base_size, call) {
  known <- check_some_errors(object, 1L, call)
  label <- fitted_labels(object, fit)
  rows <- as.data.frame(profile.rot_fit(object, known, points = 6))
  rows <- rows[is.finite(rows$rooted), ]
  rows$panel <- factor(label[match(rows$unknown, fit$about$parameters$name)], label[known])
  limit <- stats::qt((1 + fit$about$level) / 2, fit$dof)
  said <- paste0(
    "The curve beside the line of the standard error; dotted: 1 and ", format(limit, digits = 3),
    ", the ", round(100 * fit$about$level), " % interval"
  )
  ggplot2::ggplot(rows, ggplot2::aes(.data$value)) +
    ggplot2::geom_hline(yintercept = c(-limit, -1, 0, 1, limit), colour = "grey60",
                        linetype = "dotted") +
    ggplot2::geom_line(ggplot2::aes(y = .data$linear), colour = "grey45", linetype = "dashed") +
    ggplot2::geom_line(ggplot2::aes(y = .data$rooted), colour = plot_colours[1],
                       linewidth = 0.05 * base_size) +
    ggplot2::geom_point(ggplot2::aes(y = .data$rooted), colour = plot_colours[1],
                        size = 0.12 * base_size) +
    ggplot2::facet_wrap(~panel, scales = "free_x") +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size, 3)) +
    ggplot2::labs(
      title = wrap_title("Profiles of the fit", base_size),
      subtitle = wrap_subtitle(said, base_size), x = NULL, y = "distance from the fit (s.e.)",
      alt = paste0(
        "Signed root of the growth of the sum of squares over ",
        paste(sub("\n", "", label[known]), collapse = ", "), "; ", said, "."
      )
    ) +
    plot_theme(base_size)
}

plot_fit_pairs <- function(object, fit, base_size, call) {
  known <- check_some_errors(object, 2L, call)
  label <- fitted_labels(object, fit)
  p <- fit$about$parameters
  x <- fit$found$x
  turn <- seq(0, 2 * pi, length.out = 121)
  pairs <- utils::combn(known, 2)
  # Radii in standard deviations of two normal numbers, with the degrees of freedom of the noise.
  inside <- c(0.68, 0.95)
  radius <- sqrt(2 * stats::qf(inside, 2, fit$dof))
  lines <- do.call(rbind, lapply(seq_len(ncol(pairs)), function(c) {
    at <- pairs[, c]
    root <- t(chol(fit$spread[at, at] + diag(1e-14 * diag(fit$spread)[at])))
    do.call(rbind, lapply(seq_along(radius), function(k) {
      off <- root %*% rbind(cos(turn), sin(turn)) * radius[k]
      place <- x[at] + off
      place[p$log[at], ] <- (x[at] * exp(off))[p$log[at], ]
      data.frame(x = place[1, ], y = place[2, ], across = label[at[1]], up = label[at[2]],
                 inside = paste(100 * inside[k], "%"))
    }))
  }))
  centre <- data.frame(x = x[pairs[1, ]], y = x[pairs[2, ]], across = label[pairs[1, ]],
                       up = label[pairs[2, ]])
  for (name in c("across", "up")) {
    lines[[name]] <- factor(lines[[name]], label)
    centre[[name]] <- factor(centre[[name]], label)
  }
  r <- stats::cov2cor(fit$spread[known, known])
  said <- paste0("correlation ", paste(vapply(seq_len(ncol(pairs)), function(c) {
    format(round(r[match(pairs[1, c], known), match(pairs[2, c], known)], 3))
  }, ""), collapse = ", "))
  ggplot2::ggplot(lines, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_path(ggplot2::aes(linetype = .data$inside), colour = plot_colours[1],
                       linewidth = 0.05 * base_size) +
    ggplot2::geom_point(data = centre, colour = plot_colours[1], size = 0.15 * base_size) +
    ggplot2::facet_grid(up ~ across, scales = "free", switch = "both") +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size, 3)) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4)) +
    ggplot2::labs(
      title = wrap_title("Pairs of unknowns", base_size),
      subtitle = wrap_subtitle(said, base_size), x = NULL, y = NULL, linetype = "inside",
      alt = paste0(
        "Ellipses of ", paste(sub("\n", "", label[known]), collapse = ", "), "; ", said, "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(strip.placement = "outside")
}

#' @rdname autoplot.rot_fit
#' @exportS3Method ggplot2::autoplot
autoplot.rot_fit_design <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  if (!all(c("candidate", "unknown", "ratio") %in% names(object))) {
    abort_form("", "object", "fit design", call)
  }
  rows <- as.data.frame(object)
  rows <- rows[is.finite(rows$ratio), ]
  best <- rows[which.min(rows$ratio), ]
  rows$candidate <- factor(rows$candidate, rev(unique(rows$candidate)))
  rows$unknown <- sub("$", "$\n", rows$unknown, fixed = TRUE)
  rows$unknown <- factor(rows$unknown, unique(rows$unknown))
  said <- paste0("smallest: ", best$unknown, " by ", best$candidate, ", ",
                 format(best$ratio, digits = 2), " of the standard error now")
  ggplot2::ggplot(rows, ggplot2::aes(.data$ratio, .data$candidate)) +
    ggplot2::geom_vline(xintercept = 1, colour = "grey60", linetype = "dashed") +
    ggplot2::geom_segment(ggplot2::aes(xend = 1, yend = .data$candidate), colour = "grey70",
                          linewidth = 0.1 * base_size) +
    ggplot2::geom_point(colour = plot_colours[1], size = 0.25 * base_size) +
    ggplot2::facet_wrap(~unknown) +
    ggplot2::scale_x_continuous(limits = c(0, NA), breaks = plot_breaks(base_size, 3)) +
    ggplot2::labs(
      title = wrap_title("What a further record would do", base_size),
      subtitle = wrap_subtitle(said, base_size),
      x = "standard error with it, relative to that now", y = NULL,
      alt = paste0("Ratios of standard errors for each unknown and candidate; ", said, ".")
    ) +
    plot_theme(base_size)
}
