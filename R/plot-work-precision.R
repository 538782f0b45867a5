#' Plot what accuracy costs
#'
#' `autoplot()` of [work_precision()] draws the work-precision diagram: cost against true error,
#' both logarithmic, a line for each model or peer through the accuracies asked for. A solid point
#' is the true error, a ring at the same cost the error that the run reported, which should not be
#' below its point. In the grey band true errors are not resolved (below 3 x `reference_error`).
#'
#' @param object A table, from [work_precision()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [work_precision()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' scene <- scene_axle(body_disk(2, 0.25), torque_constant(0.8), resistance(0.03))
#' measured <- work_precision(scene, 0:8, accuracies = c(1e-3, 1e-9), min_batch_s = 0.002)
#' ggplot2::autoplot(measured)
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept cost of accuracy
autoplot.rot_work_precision <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  needed <- c("model", "accuracy", "cost_s", "error", "true_error", "reference_error", "floor")
  for (column in setdiff(needed, names(object))) abort_missing_column(column, object, call)
  points <- as.data.frame(object)
  fixed <- is.na(points$accuracy)
  asked <- ifelse(fixed, points[["step_s"]] %||% NA_real_, points$accuracy)
  points$asked <- ifelse(fixed, paste(format_asked(asked), "s"), format_asked(asked))
  points <- points[order(match(points$model, unique(points$model)), -asked), ]
  points$model <- factor(points$model, levels = unique(points$model))
  points <- points[is.finite(points$true_error) & points$cost_s > 0, ]
  if (!nrow(points)) abort_rotdyn("There are no runs to draw.", "value", call)
  limit <- 3 * max(points$reference_error)
  shown <- points[!points$floor, ]
  at_floor <- points[points$floor, ]
  said <- points[!is.na(points$error) & points$error > 0, ]
  colours <- rep_len(c(plot_colours, "#999999"), nlevels(points$model))
  # Room at the right for the labels, of which the longest are "1e-9 to 1e-12".
  label <- text_width("  1e-9 to 1e-12", 0.75 * base_size)
  across <- padded(points$cost_s, 0.06, 1.1 * label / (6.2 * 72 - label))
  errors <- c("true", "true, at most", "reported")
  up <- padded(c(points$true_error, said$error), 0.08, 0.06)
  ggplot2::ggplot(points, ggplot2::aes(.data$cost_s, .data$true_error, colour = .data$model)) +
    ggplot2::annotate(
      "rect", xmin = across[1], xmax = across[2], ymin = up[1],
      ymax = min(max(limit, up[1]), up[2]), fill = "grey50", alpha = 0.14
    ) +
    ggplot2::geom_linerange(
      data = said, ggplot2::aes(
        ymin = pmin(.data$true_error, .data$error), ymax = pmax(.data$true_error, .data$error)
      ), linewidth = 0.5, alpha = 0.6, show.legend = FALSE
    ) +
    ggplot2::geom_path(linewidth = 0.9) +
    ggplot2::geom_point(
      data = said, ggplot2::aes(y = .data$error, shape = "reported"), size = 4.5
    ) +
    ggplot2::geom_point(data = shown, ggplot2::aes(shape = "true"), size = 3) +
    ggplot2::geom_point(data = at_floor, ggplot2::aes(shape = "true, at most"), size = 3) +
    accuracy_labels(points, base_size) +
    ggplot2::scale_shape_manual(
      values = c(true = 16, "true, at most" = 6, reported = 1),
      breaks = errors, name = "error"
    ) +
    ggplot2::scale_colour_manual(values = colours, name = NULL) +
    ggplot2::scale_x_log10(labels = format_cost, limits = across, expand = c(0, 0)) +
    ggplot2::scale_y_log10(
      labels = format_power, breaks = 10^seq(-18, 3, by = 3), limits = up, expand = c(0, 0)
    ) +
    ggplot2::labs(
      title = wrap_title("What accuracy costs", base_size),
      subtitle = wrap_subtitle(
        paste0(
          "lower left is better; labels: accuracy asked for", if (any(fixed)) " or step",
          "; grey: not resolved"
        ), base_size
      ),
      x = "processor time of one run", y = "relative error",
      alt = paste0("Cost against true error, both logarithmic. ", paste(vapply(
        split(points, points$model, drop = TRUE), function(one) {
          paste0(
            one$model[1], ": ", paste(format_cost(range(one$cost_s)), collapse = " to "),
            ", error ", paste(format_si(signif(range(one$true_error), 2)), collapse = " to ")
          )
        }, ""
      ), collapse = "; "), ".")
    ) +
    ggplot2::guides(
      colour = ggplot2::guide_legend(
        order = 1, override.aes = list(shape = NA),
        ncol = legend_columns(levels(points$model), base_size)
      ),
      shape = ggplot2::guide_legend(
        order = 2, override.aes = list(size = 3), title.position =
          if (legends_fit(list("error", errors), base_size)) "left" else "top"
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(legend.box = "vertical", plot.margin = ggplot2::margin(6, 18, 6, 6))
}

# Limits on a logarithmic axis, wider than the values by shares of their range; half a decade at
# least, or a single point would stand in no space.
padded <- function(x, before, after) {
  ends <- log10(range(x[x > 0 & is.finite(x)]))
  span <- max(diff(ends), 1)
  10^(ends + span * c(-before, after) + (span - diff(ends)) * c(-0.5, 0.5))
}

# One label for each point; points at the same place (a closed form has one error at any
# accuracy) share one, with the range.
accuracy_labels <- function(points, base_size) {
  place <- paste(points$model, signif(log10(points$true_error), 2))
  labels <- do.call(rbind, lapply(split(points, factor(place, unique(place))), function(group) {
    asked <- unique(group$asked[c(1L, nrow(group))]) # the rows of a model go down
    group <- group[which.max(group$cost_s), ]
    group$label <- paste0("  ", paste(asked, collapse = " to "))
    group
  }))
  ggplot2::geom_text(
    data = labels, ggplot2::aes(label = .data$label), hjust = 0, vjust = -0.4,
    size = 0.9 * text_size(base_size), show.legend = FALSE, check_overlap = TRUE
  )
}

# 0.001 is 1e-3.
format_asked <- function(x) sub("e([+-])0", "e\\1", formatC(x, digits = 0, format = "e"))

format_power <- function(x) {
  parse(text = ifelse(is.na(x), "NA", paste0("10^", round(log10(x)))))
}

# 2e-05 s is "20 us": not every device has the micro sign.
format_cost <- function(x) {
  unit <- ifelse(x < 0.999e-3, "us", ifelse(x < 0.999, "ms", "s"))
  scale <- c(us = 1e6, ms = 1e3, s = 1)[unit]
  ifelse(is.na(x), NA, paste(format(signif(x * scale, 2), trim = TRUE, drop0trailing = TRUE), unit))
}
