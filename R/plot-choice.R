#' Plot a choice of models
#'
#' The models that apply, with their error over their predicted cost: what was chosen is the
#' leftmost of those good enough. The subtitle counts the others.
#'
#' @param object From [choose_model()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where no model applies.
#' @seealso [choose_model()], [autoplot.rot_work_precision()] for measured costs.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' scene <- scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 0.3)
#' ggplot2::autoplot(choose_model(scene, time_s = 0:10))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept cost of a model
autoplot.rot_model_choice <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  columns <- c("model", "applies", "error", "error_kind", "cost_s", "chosen")
  for (name in columns) if (is.null(object[[name]])) abort_missing_column(name, object, call)
  fits <- is.character(object$model) && is.logical(object$applies) && is.logical(object$chosen) &&
    is.numeric(object$error) && is.numeric(object$cost_s)
  if (!fits) abort_form("", "object", "choice of models", call)
  shown <- object$applies %in% TRUE & is.finite(object$error) & is.finite(object$cost_s) &
    object$cost_s > 0
  if (!any(shown)) abort_rotdyn("No model applies: there is nothing to draw.", "value", call)
  data <- data.frame(
    model = object$model, error = pmax(object$error, 1e-17), cost = object$cost_s,
    chosen = object$chosen, bound = object$error_kind %in% "bound"
  )[shown, ]
  data$text <- paste0(
    data$model, "\n", ifelse(data$bound, "at most ", "about "), format_si(data$error, 2), ", ",
    format_seconds(data$cost)
  )
  # Labels of equal errors stand above and below their points in turn.
  data <- data[order(data$cost), ]
  data$above <- seq_len(nrow(data)) %% 2 == 1
  best <- data$model[data$chosen]
  named <- sum(object[["reason"]] %in% only_by_name)
  rest <- nrow(object) - nrow(data) - named
  said <- paste0(
    "lower left is better", if (rest > 0L) paste0("; ", rest, " more do not apply"),
    if (named > 0L) paste0("; ", named, " by name alone")
  )
  reach <- function(x, by) 10^(range(log10(x)) + c(-1, 1) * by)
  wide <- max(0.6, 0.35 * diff(range(log10(data$cost))))
  ggplot2::ggplot(data, ggplot2::aes(.data$cost, .data$error)) +
    ggplot2::geom_point(
      ggplot2::aes(colour = .data$chosen, shape = .data$chosen), size = 0.35 * base_size,
      stroke = 1.2
    ) +
    ggplot2::geom_text(
      ggplot2::aes(
        label = .data$text, colour = .data$chosen, vjust = ifelse(.data$above, -0.45, 1.45)
      ), size = text_size(base_size), lineheight = 0.95, show.legend = FALSE
    ) +
    ggplot2::scale_colour_manual(
      values = c("TRUE" = plot_colours[2], "FALSE" = plot_colours[1]), breaks = c("TRUE", "FALSE"),
      labels = c("chosen", "also applies"), name = NULL
    ) +
    ggplot2::scale_shape_manual(
      values = c("TRUE" = 16, "FALSE" = 1), breaks = c("TRUE", "FALSE"),
      labels = c("chosen", "also applies"), name = NULL
    ) +
    ggplot2::scale_x_log10(
      limits = reach(data$cost, wide), labels = format_seconds, guide = plot_axis()
    ) +
    ggplot2::scale_y_log10(
      limits = reach(
        data$error, max(1, 0.3 * diff(range(log10(data$error)))) * max(1, base_size / 15)
      )
    ) +
    ggplot2::labs(
      title = wrap_title(
        if (length(best)) paste("The model chosen:", best[1]) else "Models that apply", base_size
      ),
      subtitle = wrap_subtitle(said, base_size),
      x = "predicted cost", y = "relative error",
      alt = paste0(
        "Error over cost of ", nrow(data), " models. ",
        if (length(best)) paste0("Chosen: ", best[1], ". "), sentence(said), ". ",
        paste(gsub("\n", ", error ", data$text), collapse = "; "), "."
      )
    ) +
    plot_theme(base_size)
}
