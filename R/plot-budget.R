#' Plot an uncertainty budget
#'
#' What each quantity contributes to the variance of the result, as bars from the largest to the
#' smallest, in per cent: a panel for each result. Where quantities are correlated a share may be
#' negative; they sum to 100 %.
#'
#' @param object A budget, from [uncertainty_budget()], or a moment of inertia of
#'   [inertia_torsion()] and its relatives.
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where nothing is uncertain.
#' @seealso [uncertainty_budget()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' hung <- inertia_compound_pendulum(
#'   measured(1.4274, 0.0010, name = "period"), measured(1.55, 0.005, name = "mass"),
#'   measured(0.296, 0.001, name = "distance")
#' )
#' ggplot2::autoplot(hung)
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept error budget
autoplot.rot_uncertainty_budget <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_budget(object, "object", call)
  words <- vapply(seq_along(object$value), function(j) {
    format_concise(object$value[[j]], object$u[[j]])
  }, "")
  plot_budget(object$contributions, names(object$value), words, base_size, call)
}

#' @rdname autoplot.rot_uncertainty_budget
#' @exportS3Method ggplot2::autoplot
autoplot.rot_inertia_measured <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_measured(object, "object", call)
  check_form(unclass(object), inertia_measured_form, "object", "measured moment of inertia", call)
  rows <- object$contributions
  rows$output <- rep("I", nrow(rows))
  plot_budget(rows, "I", paste(format.rot_measured(object), "kg m^2"), base_size, call)
}

# `words`: each result with its uncertainty.
plot_budget <- function(rows, outputs, words, base_size, call) {
  rows <- rows[is.finite(rows$share), ]
  if (!any(rows$share != 0)) {
    abort_rotdyn(c(
      "No quantity of this result is uncertain.", i = "Give {.fn measured} numbers."
    ), "value", call)
  }
  panels <- paste(outputs, "=", words)
  # Names that occur twice are different quantities.
  input <- stats::ave(rows$input, rows$output, FUN = function(x) make.unique(x, " "))
  top <- tapply(abs(rows$share), input, max)
  data <- data.frame(
    input = factor(input, names(sort(top))), percent = 100 * rows$share,
    panel = factor(panels[match(rows$output, outputs)], panels)
  )
  data$text <- ifelse(
    abs(data$percent) < 0.05, "< 0.1", format_si(round(data$percent, 1))
  )
  low <- min(data$percent, 0)
  high <- max(data$percent)
  room <- 0.16 * (high - low) * base_size / 13
  largest <- vapply(outputs, function(name) {
    some <- which(rows$output == name)
    at <- some[which.max(abs(rows$share[some]))]
    if (!length(at)) return(paste0(name, " is exact"))
    paste0(
      "the largest part of the variance of ", name, " is from ", input[at], ", ",
      format_si(round(100 * rows$share[at], 1)), " %"
    )
  }, "")
  ggplot2::ggplot(data, ggplot2::aes(.data$percent, .data$input)) +
    ggplot2::geom_col(
      ggplot2::aes(fill = .data$percent < 0), width = 0.65
    ) +
    ggplot2::geom_vline(xintercept = 0, colour = "grey60", linewidth = 0.02 * base_size) +
    ggplot2::geom_text(
      ggplot2::aes(label = .data$text, hjust = ifelse(.data$percent < 0, 1.15, -0.15)),
      colour = plot_ink, size = text_size(base_size)
    ) +
    ggplot2::scale_fill_manual(
      values = c("FALSE" = plot_colours[1], "TRUE" = plot_colours[2]), guide = "none"
    ) +
    ggplot2::facet_wrap(~panel, ncol = 1, drop = FALSE) +
    ggplot2::scale_x_continuous(
      breaks = plot_breaks(base_size), limits = c(low - if (low < 0) room else 0, high + room),
      guide = plot_axis()
    ) +
    ggplot2::labs(
      title = wrap_title("Where the uncertainty comes from", base_size),
      x = "share of the variance (%)", y = NULL,
      alt = paste0(
        "Bars of the shares of ", length(unique(input)), " quantities: ",
        paste(largest, collapse = "; "), "."
      )
    ) +
    plot_theme(base_size)
}
