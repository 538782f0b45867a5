#' Plot an audit
#'
#' A bar for each term of each balance: what was supplied is added from 0 on, what was dissipated is
#' taken away, and the change begins at 0 again: where a motion balances, it ends where the last of
#' the others ends. Terms of 0 and balances that have nothing but rounding are left out.
#'
#' @param object A `rot_audit`, from [audit()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value` where no balance can be drawn.
#' @seealso [audit()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' wheel <- audit(spin_up())
#' ggplot2::autoplot(wheel)
#' ggplot2::autoplot(wheel[wheel$balance == "energy", ])
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept energy bars
autoplot.rot_audit <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  for (column in c("balance", "unit", "terms", "verdict")) {
    if (is.null(object[[column]])) abort_missing_column(column, object, call)
  }
  drawn <- do.call(rbind, lapply(seq_len(nrow(object)), function(i) {
    balance_bars(
      object$terms[[i]], object$unit[i], audit_label(object, i), object$rounding[i]
    )
  }))
  if (is.null(drawn)) {
    abort_rotdyn("There is no balance to draw: no rows, or no values.", "value", call)
  }
  for (name in unique(drawn$panel)) {
    here <- drawn$panel == name
    power <- power_of(c(drawn$from[here], drawn$to[here]))
    if (!grepl(")", name, fixed = TRUE)) next
    drawn[here, c("from", "to")] <- drawn[here, c("from", "to")] / 10^power
    drawn$panel[here] <- label_in_power(name, power)
  }
  # Balances without a bar are named, unless there are no others.
  empty <- tapply(drawn$from != drawn$to, drawn$panel, any)
  empty <- unique(drawn$panel)[!empty[unique(drawn$panel)]]
  still <- length(empty) == length(unique(drawn$panel))
  if (!still) drawn <- drawn[!drawn$panel %in% empty, ]
  # Smaller letters shorten the lines, or, of many rows, join them.
  many <- FALSE
  label_in <- function(size) {
    folded_at <- if (many) size else min(0.66 * base_size, 1.2 * size)
    vapply(seq_len(nrow(drawn)), function(i) {
      one <- paste0(drawn$term[i], ", ", drawn$value_text[i])
      if (text_width(one, folded_at) <= 2.5 * 72) return(one)
      paste(wrap_text(drawn$term[i], folded_at, 2.5), drawn$value_text[i], sep = "\n")
    }, "")
  }
  # All rows fit a picture of 3 inches, if somewhat smaller letters do it, or one of 5 inches.
  # Panels have one height.
  rows <- max(table(drawn$panel)) * length(unique(drawn$panel))
  high <- function(size) {
    1.05 * size * rows * (max(nchar(gsub("[^\n]", "", label_in(size)))) + 1.3)
  }
  room <- function(inches) 72 * inches - base_size * (4 + 2.3 * length(unique(drawn$panel)))
  small <- 0.66 * base_size
  while (small > 0.55 * base_size && high(small) > room(3)) small <- 0.98 * small
  many <- high(small) > room(3)
  while (small > 6 && high(small) > room(5)) small <- 0.95 * small
  drawn$label <- label_in(small)
  # Rows are numbered, so that a term may stand in two panels.
  drawn$row <- factor(seq_len(nrow(drawn)), levels = rev(seq_len(nrow(drawn))))
  drawn$panel <- factor(drawn$panel, unique(drawn$panel))
  verdict <- if (all(object$verdict %in% "balanced")) "balanced" else
    if ("unbalanced" %in% object$verdict) "unbalanced" else "not known"
  roles <- c(supplied = plot_colours[1], dissipated = plot_colours[2], change = plot_colours[3])
  ggplot2::ggplot(drawn, ggplot2::aes(y = .data$row, fill = .data$role)) +
    ggplot2::geom_vline(xintercept = 0, colour = "grey60") +
    # A bar of little width is visible by its border alone.
    ggplot2::geom_tile(
      ggplot2::aes(
        x = (.data$from + .data$to) / 2, width = abs(.data$to - .data$from), height = 0.62,
        colour = .data$role
      ), linewidth = 0.5
    ) +
    ggplot2::facet_wrap(
      "panel", ncol = 1, scales = "free", labeller = ggplot2::as_labeller(function(text) {
        vapply(text, wrap_label, "", size = 0.75 * base_size, width_in = 4.1)
      })
    ) +
    ggplot2::scale_y_discrete(labels = stats::setNames(drawn$label, drawn$row)) +
    (if (still) {
      list(
        ggplot2::scale_x_continuous(breaks = 0, limits = c(-1, 1)),
        ggplot2::annotate(
          "text", x = 0.03, y = 1, label = "0, but for rounding", hjust = 0, colour = plot_ink,
          size = text_size(base_size)
        )
      )
    } else {
      ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis())
    }) +
    ggplot2::scale_fill_manual(
      values = roles, breaks = if (!still) names(roles), name = NULL
    ) +
    ggplot2::scale_colour_manual(
      values = roles, breaks = if (!still) names(roles), name = NULL
    ) +
    ggplot2::labs(
      title = wrap_title(paste("Audit:", verdict), base_size), x = NULL, y = NULL,
      subtitle = if (length(empty) && !still) {
        wrap_subtitle(paste0("0, but for rounding: ", toString(empty)), base_size)
      },
      alt = paste0(
        "Bars of the terms of each balance, ", verdict, ". ",
        paste0(drawn$panel, ", ", drawn$role, ": ", drawn$term, " ", drawn$value_text,
               collapse = "; "), ".",
        if (length(empty)) paste0(" Nothing but rounding: ", toString(empty), ".")
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(
      panel.grid.major.y = ggplot2::element_blank(), legend.justification = "right",
      strip.text = ggplot2::element_text(size = 0.66 * base_size, hjust = if (many) 1),
      strip.clip = "off",
      axis.text.y = ggplot2::element_text(size = small, lineheight = 0.9)
    )
}

audit_label <- function(object, i) {
  unit <- object$unit[i]
  paste0(gsub("_", " ", object$balance[i]), if (unit != "1") paste0(" (", unit, ")"))
}

# From and to of each bar; NULL where the balance could not be drawn up.
balance_bars <- function(terms, unit, panel, rounding = 0) {
  if (!NROW(terms) || anyNA(terms$value)) return(NULL)
  # Nothing but rounding: all is 0.
  if (isTRUE(max(abs(terms$value)) <= rounding)) terms$value <- 0 * terms$value
  # What is rounding of the largest term is no bar.
  kept <- terms[abs(terms$value) > 1e-13 * max(abs(terms$value)), ]
  if (!nrow(kept)) kept <- terms[1, ]
  step <- ifelse(kept$role == "dissipated", -kept$value, kept$value)
  change <- kept$role == "change"
  to <- double(nrow(kept))
  to[!change] <- cumsum(step[!change])
  to[change] <- cumsum(step[change])
  data.frame(
    panel = panel, term = kept$term, role = kept$role, from = to - step, to = to,
    value_text = trimws(paste(format_si(signif(kept$value, 4)), if (unit != "1") unit))
  )
}
