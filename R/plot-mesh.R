#' Plot the check of a mesh
#'
#' The conditions of a mesh as a list with marks: holds, fails, was not checked; with the number of
#' faces, edges or vertices that were counted.
#'
#' @param object From [check_mesh()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`.
#' @seealso [check_mesh()], whose rows say what each condition means.
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' open <- list(vertices = rbind(0, diag(3)), faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3)))
#' ggplot2::autoplot(check_mesh(open))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept watertight
autoplot.rot_mesh_check <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  for (column in c("condition", "count", "verdict")) {
    if (is.null(object[[column]])) abort_missing_column(column, object, call)
  }
  fits <- is.character(object$condition) && is.numeric(object$count) &&
    is.character(object$verdict) && length(object$condition) > 0L
  if (!fits) abort_form("", "object", "check of a mesh", call)
  n <- nrow(object)
  high <- ceiling(n / 2)
  verdict <- object$verdict
  known <- c("holds", "fails", "not checked")
  verdict[is.na(verdict) | !verdict %in% known[1:2]] <- known[3]
  rows <- data.frame(
    x = (seq_len(n) - 1L) %/% high, y = -((seq_len(n) - 1L) %% high),
    verdict = factor(verdict, known),
    text = paste0(object$condition, ifelse(
      is.na(object$count) | object$count == 0, "", paste0(": ", format_si(object$count))
    ))
  )
  failed <- rows$text[verdict == "fails"]
  said <- if (length(failed)) paste("fails:", toString(failed)) else
    "no condition that was checked fails"
  ggplot2::ggplot(rows, ggplot2::aes(.data$x, .data$y)) +
    ggplot2::geom_point(
      ggplot2::aes(colour = .data$verdict, shape = .data$verdict), size = 0.25 * base_size,
      stroke = 1.2
    ) +
    ggplot2::geom_text(
      ggplot2::aes(label = .data$text), hjust = 0, nudge_x = 0.04, colour = plot_ink,
      fontface = ifelse(verdict == "fails", "bold", "plain"), size = text_size(min(base_size, 15))
    ) +
    ggplot2::scale_colour_manual(
      values = stats::setNames(c(plot_colours[c(3, 2)], "grey55"), known), name = NULL
    ) +
    ggplot2::scale_shape_manual(values = stats::setNames(c(16, 4, 1), known), name = NULL) +
    ggplot2::scale_x_continuous(limits = c(-0.05, 1.95)) +
    ggplot2::scale_y_continuous(expand = ggplot2::expansion(add = 0.7)) +
    ggplot2::labs(
      title = wrap_title("Conditions of a mesh", base_size),
      subtitle = wrap_subtitle(said, base_size), x = NULL, y = NULL,
      alt = paste0(
        "A list of ", n, " conditions of a mesh; ", said, ". ",
        paste0(known, ": ", as.vector(table(rows$verdict)), collapse = ", "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(axis.text = ggplot2::element_blank(), panel.grid = ggplot2::element_blank())
}
