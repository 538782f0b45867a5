#' Plot the ledger of a collision
#'
#' The energy before and after, stacked: translation and rotation of each body, and what was lost to
#' restitution and to friction. Both bars have one height where the energy balances.
#'
#' @param object From [collision_ledger()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where there is no energy to draw.
#' @seealso [collision_ledger()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' lock <- disks_lock(1, 3, omega_1_rad_per_s = 60, omega_2_rad_per_s = 0)
#' ggplot2::autoplot(collision_ledger(lock))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept energy of a collision
autoplot.rot_ledger <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  energies <- attr(object, "energies")
  form <- list(term = "texts", before = "values=term", after = "values=term")
  if (is.null(energies) || is.null(object[["verdict"]])) {
    abort_missing_column("verdict", object, call)
  }
  check_form(as.list(energies), form, "object", "ledger", call)
  maximum <- max(abs(energies$before), abs(energies$after))
  if (!isTRUE(is.finite(maximum) && maximum > 0)) {
    abort_rotdyn("There is no energy to draw.", "value", call)
  }
  shown <- energies[energies$before != 0 | energies$after != 0, ]
  lost <- startsWith(shown$term, "lost")
  n <- nrow(shown)
  # The bars are seen from below: the moving bodies first, the losses on top.
  colours <- stats::setNames(character(n), shown$term)
  colours[!lost] <- rep_len(plot_colours[c(1, 6, 3, 4)], sum(!lost))
  colours[lost] <- plot_colours[c(2, 5)][match(shown$term[lost], c(
    "lost to restitution", "lost to friction"
  ))]
  drawn <- data.frame(
    when = factor(rep(c("before", "after"), each = n), c("before", "after")),
    term = factor(rep(shown$term, 2), rev(shown$term)), value = c(shown$before, shown$after)
  )
  drawn$text <- paste0(format_si(signif(drawn$value, 3)), " J")
  drawn$text[abs(drawn$value) < 0.06 * sum(shown$before)] <- ""
  drawn$ink <- ifelse(colours[as.character(drawn$term)] %in% plot_colours[1:2], "white", plot_ink)
  verdict <- ledger_verdict(object$verdict)
  said <- function(values) {
    paste0(shown$term, " ", format_si(signif(values, 4)), " J")[values != 0]
  }
  ggplot2::ggplot(drawn, ggplot2::aes(x = .data$when, y = .data$value, fill = .data$term)) +
    ggplot2::geom_col(width = 0.6, colour = "white", linewidth = 0.4) +
    ggplot2::geom_text(
      ggplot2::aes(label = .data$text, colour = .data$ink, group = .data$term),
      position = ggplot2::position_stack(vjust = 0.5), size = text_size(base_size)
    ) +
    ggplot2::scale_colour_identity() +
    ggplot2::geom_hline(yintercept = 0, colour = "grey60") +
    ggplot2::scale_fill_manual(values = colours, name = NULL) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size)) +
    ggplot2::labs(
      title = wrap_title(paste("Energy of the collision:", verdict), base_size), x = NULL,
      y = "energy (J)",
      alt = paste0(
        "Stacked bars of the energy, ", verdict, ". Before: ",
        paste(said(shown$before), collapse = ", "), ". After: ",
        paste(said(shown$after), collapse = ", "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(legend.position = "right", panel.grid.major.x = ggplot2::element_blank())
}
