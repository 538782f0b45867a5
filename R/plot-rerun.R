#' Plot a record computed again
#'
#' The largest difference of each quantity, over what the errors of both runs allow: up to the line
#' at 1 nothing contradicts. Differences of more than twice that stand at the edge.
#'
#' @param object From [records_rerun()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where no values are kept.
#' @seealso [records_rerun()].
#' @examplesIf all(c("ggplot2", "RSQLite", "yyjsonr") %in% rownames(utils::installed.packages()))
#' records <- DBI::dbConnect(RSQLite::SQLite(), ":memory:")
#' records_create(records)
#' run <- records_add(records, spin_up(time_s = 0:8))
#' ggplot2::autoplot(records_rerun(records, run))
#' DBI::dbDisconnect(records)
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept reproducibility
autoplot.rot_rerun <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  where <- .subset2(object, "where")
  fits <- is.data.frame(where) && is.character(where[["quantity"]]) &&
    is.numeric(where[["difference"]]) && is.numeric(where[["allowed"]]) &&
    rlang::is_string(.subset2(object, "verdict"))
  if (!fits) abort_form("where", "object", "record computed again", call)
  if (!nrow(where)) abort_rotdyn("No values are kept: there is nothing to draw.", "value", call)
  ratio <- ifelse(where$difference == 0, 0, where$difference / where$allowed)
  names <- vapply(where$quantity, column_label, "")
  rows <- data.frame(
    quantity = factor(names, rev(names)),
    ratio = pmin(ratio, 2), fits = ratio <= 1
  )
  worst <- which.max(ratio)
  said <- if (all(ratio == 0)) {
    "every value has the same bits"
  } else {
    paste0(
      "the most: ", where$quantity[worst], " in row ", where$row[worst], ", off by ",
      format_si(signif(where$difference[worst], 2)), ", ",
      format_si(signif(where$allowed[worst], 2)), " allowed"
    )
  }
  title <- paste0("A record computed again: ", object$verdict)
  ggplot2::ggplot(rows, ggplot2::aes(.data$ratio, .data$quantity, colour = .data$fits)) +
    ggplot2::geom_vline(xintercept = 1, colour = plot_ink, linetype = "22") +
    ggplot2::geom_segment(
      ggplot2::aes(x = 0, xend = .data$ratio, yend = .data$quantity), linewidth = 0.1 * base_size
    ) +
    ggplot2::geom_point(size = 0.22 * base_size) +
    ggplot2::scale_colour_manual(
      values = c("TRUE" = plot_colours[3], "FALSE" = plot_colours[2]), guide = "none"
    ) +
    ggplot2::scale_x_continuous(limits = c(0, 2), breaks = c(0, 0.5, 1, 1.5, 2)) +
    ggplot2::labs(
      title = wrap_title(title, base_size), subtitle = wrap_subtitle(said, base_size),
      x = wrap_text("difference over what the errors allow", 0.8 * base_size, 3.5), y = NULL,
      alt = paste0(
        title, "; ", said, ". ", sum(rows$fits), " of ", nrow(rows),
        " quantities are within what the errors allow."
      )
    ) +
    plot_theme(base_size)
}
