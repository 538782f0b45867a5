# Pictures of fits: the records with the fitted motion, and what is left over.

#' Plot a fit
#'
#' For each observed column two panels: the samples with the fitted motion, and the residuals with
#' two standard deviations of their noise.
#'
#' @param object A [fit_scene()].
#' @inheritParams autoplot.rot_trajectory
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
#' @exportS3Method ggplot2::autoplot
#' @concept plot
autoplot.rot_fit <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  fit <- fit_of(object, call, "object")
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
  lines <- do.call(rbind, lapply(seq_along(records), function(r) fitted_line(object, fit, r)))
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
  points <- list(data = samples, mapping = colour(), size = 0.07 * base_size, na.rm = TRUE)
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
fitted_line <- function(object, fit, r) {
  record <- fit$about$records[[r]]
  p <- fit$about$parameters
  x <- fit$found$x
  number <- function(kind, of, otherwise) {
    at <- which(p$kind == kind & p$of == of & p$record %in% c(0L, r))
    if (length(at)) x[at[1]] else otherwise
  }
  shift <- number("clock", "time_s", 0)
  times <- seq(record$time_s[1], record$time_s[length(record$time_s)], length.out = 201)
  motion <- predict.rot_fit(object, times + shift, record = r)
  index <- constraint_of(trajectory_run(motion)$scene)$index
  do.call(rbind, lapply(names(record$series), function(name) {
    y <- motion[[sub("\\[[0-9]+\\]$", "", name)]]
    if (!is.null(index)) {
      y <- y[motion[[index]] == as.integer(sub("^.*\\[([0-9]+)\\]$", "\\1", name))]
    }
    data.frame(x = times, y = number("offset", name, 0) + number("factor", name, 1) * y,
               column = name, record = r)
  }))
}
