#' Plot the conditions of an inertia tensor
#'
#' The margin of each condition of [check_inertia()], relative to its limit: negative where the
#' condition fails. Margins beyond 1 are drawn at 1. The first twelve tensors have a panel each.
#'
#' @param object A check, from [check_inertia()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [check_inertia()], whose rows say what each condition means.
#' @concept triangle inequality
#' @concept plot
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' tensors <- data.frame(
#'   object = c("arm", "lid"), ixx = 1, iyy = c(2, 1), izz = c(2.5, 3), ixy = 0, ixz = 0, iyz = 0
#' )
#' ggplot2::autoplot(check_inertia(tensors))
#' @exportS3Method ggplot2::autoplot
autoplot.rot_inertia_check <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  shown <- check_rows_drawn(object, call)
  verdicts <- c("holds", "holds within rounding", "fails")
  colours <- stats::setNames(plot_colours[c(3, 5, 2)], verdicts)
  tensors <- levels(shown$tensor)
  failed <- vapply(split(shown, shown$tensor), function(one) {
    bad <- one$condition[one$verdict == "fails"]
    paste0(one$tensor[1], ": ", if (length(bad)) paste(bad, collapse = ", ") else "none")
  }, "")
  ggplot2::ggplot(shown, ggplot2::aes(.data$reach, .data$condition, colour = .data$verdict)) +
    ggplot2::geom_vline(xintercept = 0, colour = "grey60") +
    ggplot2::geom_segment(
      ggplot2::aes(x = 0, xend = .data$reach, yend = .data$condition), linewidth = 0.1 * base_size
    ) +
    ggplot2::geom_point(size = 0.22 * base_size) +
    (if (length(tensors) > 1L) ggplot2::facet_wrap("tensor", ncol = 2L)) +
    ggplot2::scale_colour_manual(values = colours, breaks = verdicts, name = NULL) +
    ggplot2::scale_x_continuous(
      limits = c(min(-0.1, shown$reach), max(0.1, shown$reach)), breaks = plot_breaks(base_size),
      guide = plot_axis()
    ) +
    ggplot2::labs(
      title = wrap_title("Conditions of an inertia tensor", base_size),
      x = "margin, relative to the limit", y = NULL,
      alt = paste0(
        "Margins of the conditions of an inertia tensor. Those that fail: ",
        paste(failed, collapse = "; "), "."
      )
    ) +
    plot_theme(base_size)
}

# The rows that are drawn, with `tensor` and `reach`, the margin within -1 and 1.
check_rows_drawn <- function(object, call) {
  lost <- setdiff(c("row", "object", "condition", "margin", "verdict"), names(object))
  if (length(lost)) abort_form(lost[1], "object", "check of an inertia tensor", call)
  fits <- is.numeric(object$margin) && is.character(object$condition) &&
    is.character(object$verdict) && is.character(object$object)
  if (!fits || !length(object$row)) abort_form("", "object", "check of an inertia tensor", call)
  name <- ifelse(is.na(object$object), paste("tensor", object$row), object$object)
  shown <- data.frame(
    tensor = factor(name, levels = unique(name)),
    condition = factor(object$condition, levels = rev(unique(object$condition))),
    verdict = object$verdict,
    reach = pmax(-1, pmin(1, ifelse(is.na(object$margin), -1, object$margin)))
  )
  shown <- shown[as.integer(shown$tensor) <= 12L, , drop = FALSE]
  shown$tensor <- droplevels(shown$tensor)
  shown
}
