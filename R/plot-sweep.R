#' Plot a sweep
#'
#' What a sweep of [sweep_run()] or [sweep_read()] found, a panel for each output.
#'
#' | kind | picture | of | default for |
#' |---|---|---|---|
#' | `"histogram"` | share of the rows in bins of one width, with the median and the middle 90 % | all rows | random, Latin and Sobol designs; sweeps without rows |
#' | `"lines"` | over one input: the rows themselves, or the median with bands of 50 % and 90 % | rows kept | grids and lists |
#' | `"map"` | tiles over two inputs | rows kept | grids of two inputs with more than seven values each |
#' | `"indices"` | Sobol indices, with two standard errors to both sides | all rows | [design_saltelli()] |
#'
#' The subtitle says which rows are not known: not computed, infinite, or with an error above the
#' accuracy. A histogram has bins of at least 0.4 % of its values, the resolution of the sums that a
#' sweep keeps, unless all rows are at hand.
#'
#' @param object A sweep. Rows that were filtered, and columns that were added, show in lines and
#'   maps.
#' @inheritParams autoplot.rot_trajectory
#' @param kind One of these kinds; NULL: as the design has it.
#' @param x NULL, or inputs by name: of lines the one across, and one that distinguishes lines by
#'   colour; of a map the one across, the one up, and one with a panel for each value.
#' @param panels NULL, or which outputs: at most six by default, of a map the first.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument` for indices of
#'   another design; `rotdyn_error_type`; `rotdyn_error_value` for unknown columns, a map without a
#'   grid, and where rows are needed that were not kept.
#' @seealso [sweep_run()], [summary.rot_sweep()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' wheel <- scene_axle(0.0625, resistance = resistance(0.002), omega0_rad_per_s = 20)
#' varied <- sweep_plan(
#'   wheel, time_s = 60, design_sobol(1024, seed = 1, "omega0_rad_per_s" = vary_normal(20, 1))
#' )
#' ggplot2::autoplot(sweep_run(varied))
#' combined <- sweep_plan(
#'   wheel, time_s = 60, design_grid("body" = seq(0.02, 0.1, by = 0.01), "omega0_rad_per_s" = 8:20)
#' )
#' ggplot2::autoplot(sweep_run(combined))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept parameter study
#' @concept sensitivity analysis
autoplot.rot_sweep <- function(object, ..., kind = NULL, x = NULL, panels = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  sweep <- attr(object, "sweep", exact = TRUE)
  if (is.null(sweep$plan)) abort_form("", "object", "sweep", call)
  kinds <- c("histogram", "lines", "map", "indices")
  kind <- if (is.null(kind)) kind_of_sweep(object) else check_string(kind, "kind", kinds, call)
  draw <- switch(kind,
    histogram = plot_sweep_histogram, lines = plot_sweep_lines, map = plot_sweep_map,
    indices = plot_sweep_indices
  )
  draw(object, x, panels, base_size, call)
}

# ---- what all kinds share -----------------------------------------------------------------------

sweep_plan_of <- function(object) attr(object, "sweep", exact = TRUE)$plan

# The inputs that vary, with their numbers of values; Inf for a law.
values_varied <- function(plan) {
  n <- vapply(plan$design$inputs, function(law) {
    switch(law$kind, fixed = 1, values = , column = as.double(length(unique(law$x))), Inf)
  }, double(1))
  n[n > 1]
}

kind_of_sweep <- function(object) {
  plan <- sweep_plan_of(object)
  varied <- values_varied(plan)
  if (plan$design$kind == "saltelli") return("indices")
  if (!nrow(object) || !plan$design$kind %in% c("grid", "list") || !length(varied)) {
    return("histogram")
  }
  if (plan$design$kind == "grid" && length(varied) == 2L && all(varied > length(plot_colours))) {
    return("map")
  }
  "lines"
}

sweep_panels <- function(object, panels, n, known, call) {
  if (is.null(panels)) return(utils::head(sweep_plan_of(object)$outputs, n))
  if (!is.character(panels) || !length(panels)) check_sweep_name(panels, "panels", known, call)
  for (name in panels) check_sweep_name(name, "panels", known, call)
  unique(panels)
}

check_sweep_inputs <- function(object, x, n, call) {
  if (!is.character(x) || !length(x) || length(x) > n) {
    abort_rotdyn("{.arg x} must be NULL or the names of up to {n} inputs.", "type", call)
  }
  for (name in x) check_sweep_name(name, "x", names(object), call)
  x
}

check_rows_kept <- function(object, what, call) {
  if (nrow(object)) return()
  abort_rotdyn(c(
    "{what} need rows, and this sweep has none.",
    i = "Plan it with {.code keep = \"rows\"}; {.code kind = \"histogram\"} needs none."
  ), "value", call)
}

# "body mass (kg)" of body$mass_kg, "pivot [3] (m)" of pivot_m[3], "body (kg m^2)".
sweep_label <- function(name, plan) {
  place <- sub("^.*?(\\[[0-9]+\\])?$", "\\1", name, perl = TRUE)
  label <- column_label(gsub("$", " ", without_place(name), fixed = TRUE))
  if (nzchar(place)) {
    label <- if (grepl(" [(]", label)) sub(" [(]", paste0(" ", place, " ("), label) else
      paste(label, place)
  }
  if (grepl("[(]", label)) return(label)
  unit <- c(
    plan$known$unit[match(name, plan$known$path)], plan$output_unit[match(name, plan$outputs)]
  )
  unit <- plain_units(stats::na.omit(unit)[1])
  if (is.na(unit) || unit == "1") label else paste0(label, " (", unit, ")")
}

# Without the unit.
sweep_name <- function(names, plan) {
  sub(" [(][^(]*[)]$", "", vapply(names, sweep_label, "", plan, USE.NAMES = FALSE))
}

sweep_title <- function(object, base_size, call) {
  plan <- sweep_plan_of(object)
  rows <- paste(count_in_words(plan$n), if (plan$n == 1) "row" else "rows")
  # Scenes of a function have no title in common.
  scene <- if (is.null(plan$node)) "scenes of a function" else
    scene_title(scene_of_node(plan$node, call))
  wrap_title(paste0(rows, " of ", scene), base_size)
}

count_in_words <- function(n) format(n, big.mark = ",", scientific = FALSE)

# Which rows are not known, in words. `outputs`: whose infinite values count.
sweep_unknown <- function(object, outputs, call) {
  plan <- sweep_plan_of(object)
  figures <- sweep_figures(object, 0.5, call)
  share <- function(n) paste(format(100 * n / plan$n, digits = 2), "% of the rows")
  failed <- plan$n - figures$status[1]
  infinite <- rowSums(figures$column[, c("plus_inf", "minus_inf"), drop = FALSE])
  infinite <- infinite[match(outputs, plan$outputs)]
  at <- which(infinite > 0)
  c(
    if (failed > 0) paste(share(failed), "not computed"),
    if (figures$whole[3] > 0) {
      paste0(share(figures$whole[3]), " with an error above ", format(plan$accuracy))
    },
    if (length(at)) {
      paste0(sweep_name(outputs[at], plan), " infinite in ", vapply(infinite[at], share, ""))
    }
  )
}

# Sentences in one subtitle.
sweep_subtitle <- function(parts, base_size) {
  parts <- parts[nzchar(parts)]
  if (!length(parts)) return(NULL)
  wrap_subtitle(paste0(toupper(substr(parts[1], 1L, 1L)), substring(
    paste(parts, collapse = "; "), 2L
  )), base_size)
}

rows_in_words <- function(object) {
  plan <- sweep_plan_of(object)
  if (nrow(object) < plan$n) paste("the", count_in_words(nrow(object)), "rows at hand")
}

# Why there is nothing to draw, by the statuses of the rows.
abort_no_numbers <- function(object, call) {
  status <- attr(summary.rot_sweep(object), "about")$status
  abort_rotdyn(c(
    "No row has a finite number.",
    x = "Rows by status: {paste0(names(status), ' ', count_in_words(status), collapse = ', ')}."
  ), "value", call)
}

# A panel for each label; one alone has its label at the axis.
sweep_facets <- function(labels, base_size, scales, ncol) {
  if (length(labels) < 2L) return(ggplot2::theme(strip.text = ggplot2::element_blank()))
  ggplot2::facet_wrap(
    "panel", scales = scales, ncol = ncol,
    labeller = ggplot2::as_labeller(function(text) {
      vapply(text, wrap_label, "", size = 0.75 * base_size, width_in = 6.2 / ncol)
    })
  )
}

# ---- histograms ---------------------------------------------------------------------------------

plot_sweep_histogram <- function(object, x, panels, base_size, call) {
  plan <- sweep_plan_of(object)
  if (!is.null(x)) {
    abort_rotdyn("A histogram has no input across: {.arg x} must be NULL.", "value", call)
  }
  panels <- sweep_panels(object, panels, 6L, plan$outputs, call)
  labels <- unname(vapply(panels, sweep_label, "", plan))
  figures <- sweep_figures(object, c(0.05, 0.5, 0.95), call)
  at <- match(panels, plan$outputs)
  middle <- middle_of(figures$low, figures$high)[at, , drop = FALSE]
  bins <- lapply(seq_along(panels), function(i) {
    bins <- sweep_bins(object, at[i], figures, call)
    if (!is.null(bins)) cbind(bins, panel = factor(labels[i], labels))
  })
  data <- do.call(rbind, bins)
  if (is.null(data)) abort_no_numbers(object, call)
  marks <- data.frame(
    across = c(middle), panel = factor(rep(labels, 3L), labels),
    quantile = rep(c("limit", "median", "limit"), each = length(panels))
  )
  marks <- marks[is.finite(marks$across) & marks$panel %in% data$panel, ]
  beyond <- vapply(split(data$beyond, data$panel), function(b) b[1], double(1))
  outside <- which(beyond > 0)
  single <- length(labels) == 1L
  ggplot2::ggplot(data, ggplot2::aes(.data$across, .data$percent)) +
    ggplot2::geom_col(
      width = data$width, fill = plot_colours[6], colour = "white", linewidth = 0.01 * base_size
    ) +
    ggplot2::geom_vline(
      ggplot2::aes(xintercept = .data$across, linetype = .data$quantile), marks,
      colour = plot_ink, linewidth = 0.045 * base_size
    ) +
    ggplot2::scale_linetype_manual(values = c(limit = "42", median = "solid"), guide = "none") +
    sweep_facets(labels, base_size, "free", if (length(labels) > 3L) 2L else 1L) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(
      breaks = plot_breaks(base_size, 4), guide = plot_axis(),
      expand = ggplot2::expansion(mult = c(0, 0.06))
    ) +
    ggplot2::labs(
      title = sweep_title(object, base_size, call),
      subtitle = sweep_subtitle(c(
        "solid: median; 90 % of the rows between the dashed lines",
        if (length(outside)) {
          paste0(
            sweep_name(panels[outside], plan), ": ", format(100 * beyond[outside], digits = 2),
            " % not shown"
          )
        },
        sweep_unknown(object, panels, call)
      ), base_size),
      x = if (single) labels, y = "rows in a bin (%)",
      alt = paste0(
        "Histograms of ", count_in_words(plan$n), " rows. ", paste0(
          labels, ": median ", format_si(signif(middle[, 2], 4)), ", 90 % from ",
          format_si(signif(middle[, 1], 4)), " to ", format_si(signif(middle[, 3], 4)),
          collapse = "; "
        ), "."
      )
    ) +
    plot_theme(base_size)
}

# Bins of one width for an output, with the per cent of all rows in each: list of across, width,
# percent, beyond (the fraction outside all bins); NULL without finite rows.
sweep_bins <- function(object, at, figures, call) {
  sweep <- attr(object, "sweep", exact = TRUE)
  buckets <- .Call(ffi_sweep_buckets, sweep$whole$sums, at - 1)
  if (is.null(buckets)) abort_form("", "object", "sweep", call)
  buckets <- buckets[is.finite(buckets[, 1]), , drop = FALSE]
  ends <- unname(figures$column[at, c("min", "max")])
  # The infinite ones have no bin.
  if (!nrow(buckets)) return(NULL)
  if (!all(is.finite(ends))) ends <- range(pmin(buckets[, 1:2], .Machine$double.xmax))
  low <- pmax(buckets[, 1], ends[1])
  high <- pmin(buckets[, 2], ends[2])
  count <- buckets[, 3]
  name <- sweep$plan$outputs[at]
  if (grepl("^n_|^balanced$", name) && diff(ends) < 40) {
    breaks <- seq(ends[1] - 0.5, ends[2] + 0.5)
  } else {
    # Few rows far outside would leave the others one bin.
    span <- figures$low[at, 3] - figures$low[at, 1]
    if (is.finite(span) && span > 0) {
      ends <- c(max(ends[1], figures$low[at, 1] - 2 * span),
                min(ends[2], figures$high[at, 3] + 2 * span))
    }
    if (ends[1] == ends[2]) ends <- ends + c(-0.5, 0.5) * max(abs(ends[1]), 1e-300) * 0.01
    n <- 40
    coarse <- floor(diff(ends) / max(high - low))
    if (coarse < n) {
      value <- object[[name]]
      if (nrow(object) == sweep$plan$n && is.double(value)) {
        low <- high <- value[is.finite(value)]
        count <- rep(1, length(low))
        n <- max(min(n, ceiling(sqrt(length(low)))), 1)
      } else {
        n <- max(coarse, 1)
      }
    }
    breaks <- seq(ends[1], ends[2], length.out = n + 1)
  }
  inside <- counts_in_bins(low, high, count, breaks)
  list_of <- data.frame(
    across = (breaks[-1] + breaks[-length(breaks)]) / 2, width = diff(breaks),
    percent = 100 * inside / sweep$plan$n
  )
  list_of$beyond <- max(1 - sum(inside) / sum(count), 0)
  if (list_of$beyond[1] < 1e-12) list_of$beyond <- 0
  list_of
}

# Counts spread evenly from low to high, in bins between breaks. A count at a point is in the bin
# whose lower break it reaches.
counts_in_bins <- function(low, high, count, breaks) {
  below <- function(b) {
    part <- ifelse(high > low, (b - low) / (high - low), as.double(low < b))
    sum(count * pmin(pmax(part, 0), 1))
  }
  last <- length(breaks)
  total <- vapply(breaks, below, double(1))
  total[last] <- total[last] + sum(count[low == high & low == breaks[last]])
  diff(total)
}

# ---- lines --------------------------------------------------------------------------------------

plot_sweep_lines <- function(object, x, panels, base_size, call) {
  plan <- sweep_plan_of(object)
  check_rows_kept(object, "Lines", call)
  varied <- values_varied(plan)
  if (is.null(x)) {
    if (!length(varied)) abort_rotdyn("No input varies: nothing is across.", "value", call)
    x <- names(varied)[order(-varied)]
    few <- length(x) == 2L && varied[x[2]] <= length(plot_colours)
    x <- x[seq_len(1L + few)]
  }
  x <- check_sweep_inputs(object, x, 2L, call)
  panels <- sweep_panels(object, panels, 6L, names(object), call)
  labels <- unname(vapply(panels, sweep_label, "", plan))
  across <- as.double(object[[x[1]]])
  key <- if (length(x) > 1L) sweep_key(object[[x[2]]]) else rep(no_name, nrow(object))
  key <- factor(key, unique(key[order(if (length(x) > 1L) object[[x[2]]] else key)]))
  keys <- setdiff(levels(key), no_name)
  if (length(keys) > length(plot_colours)) {
    abort_rotdyn(c(
      "Colours distinguish at most {length(plot_colours)} values.",
      x = "{.field {x[2]}} has {length(keys)}.", i = "Filter the rows, or leave it out of {.arg x}."
    ), "value", call)
  }
  place <- places_across(across)
  several <- any(duplicated(data.frame(place, key)))
  long <- do.call(rbind, lapply(seq_along(panels), function(i) {
    value <- as.double(object[[panels[i]]])
    rows <- if (several) quantiles_at(place, key, value) else {
      data.frame(across = place, key = key, p50 = value)
    }
    cbind(rows, panel = factor(rep(labels[i], nrow(rows)), labels))
  }))
  long <- long[is.finite(long$p50), ]
  if (!nrow(long)) abort_no_numbers(object, call)
  colours <- stats::setNames(
    c(line_colours(length(keys)), plot_colours[1]), c(keys, no_name)
  )
  band <- function(low, high) {
    ggplot2::geom_ribbon(
      ggplot2::aes(ymin = .data[[low]], ymax = .data[[high]], fill = .data$key), alpha = 0.22,
      colour = NA
    )
  }
  legend <- if (length(keys)) {
    ggplot2::guide_legend(ncol = legend_columns(keys, base_size))
  } else {
    "none"
  }
  title <- if (length(keys)) wrap_text(sweep_label(x[2], plan), 0.75 * base_size, 2.4)
  single <- length(labels) == 1L
  label <- sweep_label(x[1], plan)
  ggplot2::ggplot(long, ggplot2::aes(.data$across, .data$p50, colour = .data$key)) +
    (if (several) list(band("p5", "p95"), band("p25", "p75"))) +
    ggplot2::geom_line(linewidth = 0.06 * base_size) +
    (if (length(unique(place)) <= 40L) ggplot2::geom_point(size = 0.11 * base_size)) +
    sweep_facets(labels, base_size, "free_y", 1L) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::scale_y_continuous(breaks = plot_breaks(base_size, 4), guide = plot_axis()) +
    ggplot2::scale_colour_manual(values = colours, breaks = keys, name = title, guide = legend) +
    ggplot2::scale_fill_manual(values = colours, breaks = keys, name = title, guide = legend) +
    ggplot2::labs(
      title = sweep_title(object, base_size, call),
      subtitle = sweep_subtitle(c(
        if (several) "median, with bands of 50 % and 90 % of the rows", rows_in_words(object),
        sweep_unknown(object, intersect(panels, plan$outputs), call)
      ), base_size),
      x = label, y = if (single) labels,
      alt = paste0(
        if (several) "Median and bands of 50 % and 90 % of the rows" else "Lines", " over ", label,
        if (length(keys)) paste0(", coloured by ", sweep_label(x[2], plan)), ". ",
        paste(vapply(split(long, long$panel), function(one) {
          paste0(one$panel[1], ": ", range_in_words(one$p50))
        }, ""), collapse = "; "), "."
      )
    ) +
    plot_theme(base_size)
}

# Where each row is drawn: at its value, or, of more than 60, at the middle of twenty groups of as
# many rows each.
places_across <- function(x) {
  if (length(unique(x)) <= 60L || !anyDuplicated(x) && length(x) <= 60L) return(x)
  group <- ceiling(20 * rank(x, ties.method = "min") / length(x))
  stats::ave(x, group, FUN = stats::median)
}

quantiles_at <- function(place, key, value) {
  rows <- lapply(split(seq_along(value), list(place, key), drop = TRUE), function(at) {
    known <- value[at][!is.nan(value[at])]
    q <- if (length(known)) {
      stats::quantile(known, c(0.05, 0.25, 0.5, 0.75, 0.95), type = 1, names = FALSE)
    } else {
      rep(NaN, 5L)
    }
    data.frame(across = place[at[1]], key = key[at[1]], p5 = q[1], p25 = q[2], p50 = q[3],
               p75 = q[4], p95 = q[5])
  })
  do.call(rbind, unname(rows))
}

# ---- maps ---------------------------------------------------------------------------------------

plot_sweep_map <- function(object, x, panels, base_size, call) {
  plan <- sweep_plan_of(object)
  check_rows_kept(object, "Tiles", call)
  varied <- values_varied(plan)
  finite <- varied[is.finite(varied)]
  x <- x %||% utils::head(names(finite)[order(-finite)], 3L)
  if (length(x) < 2L) abort_no_grid(call)
  x <- check_sweep_inputs(object, x, 3L, call)
  name <- sweep_panels(object, panels, 1L, names(object), call)
  if (length(name) > 1L) {
    abort_rotdyn("A map shows one output: {.arg panels} has {length(name)}.", "value", call)
  }
  data <- data.frame(
    across = as.double(object[[x[1]]]), up = as.double(object[[x[2]]]),
    value = as.double(object[[name]])
  )
  data$value[!is.finite(data$value)] <- NA
  third <- if (length(x) > 2L) {
    paste(sweep_label(x[3], plan), "=", sweep_key(object[[x[3]]]))
  } else {
    rep("", nrow(object))
  }
  data$panel <- factor(third, unique(third[order(if (length(x) > 2L) object[[x[3]]] else third)]))
  if (anyDuplicated(data[c("across", "up", "panel")]) || nlevels(data$panel) > 9L) {
    abort_no_grid(call)
  }
  if (all(is.na(data$value))) abort_no_numbers(object, call)
  axes <- list(map_axis(data$across), map_axis(data$up))
  labels <- unname(vapply(c(x[1:2], name), sweep_label, "", plan))
  missing <- sum(is.na(data$value))
  found <- sort(unique(data$value))
  few <- length(found) <= length(plot_colours) && all(found == round(found))
  if (few) data$value <- factor(data$value, found)
  even <- axes[[1]]$even && axes[[2]]$even
  ggplot2::ggplot(data, ggplot2::aes(.data$across, .data$up, fill = .data$value)) +
    (if (even) {
      ggplot2::geom_raster()
    } else {
      ggplot2::geom_tile(
        width = axes[[1]]$width[match(data$across, axes[[1]]$at)],
        height = axes[[2]]$width[match(data$up, axes[[2]]$at)]
      )
    }) +
    sweep_facets(levels(data$panel), base_size, "fixed", min(nlevels(data$panel), 3L)) +
    map_scale(ggplot2::scale_x_continuous, ggplot2::scale_x_log10, axes[[1]], base_size) +
    map_scale(ggplot2::scale_y_continuous, ggplot2::scale_y_log10, axes[[2]], base_size) +
    (if (few) {
      ggplot2::scale_fill_manual(
        values = stats::setNames(line_colours(length(found)), found), na.value = "grey75",
        name = labels[3], breaks = found, drop = FALSE
      )
    } else {
      ggplot2::scale_fill_viridis_c(
        na.value = "grey75", name = labels[3], breaks = plot_breaks(base_size, 4),
        guide = ggplot2::guide_colourbar(
          barwidth = ggplot2::unit(12 * base_size, "pt"),
          barheight = ggplot2::unit(0.7 * base_size, "pt"), title.vjust = 1
        )
      )
    }) +
    ggplot2::labs(
      title = sweep_title(object, base_size, call),
      subtitle = sweep_subtitle(c(
        if (missing) paste("grey:", count_in_words(missing), "rows without a finite number"),
        rows_in_words(object), sweep_unknown(object, intersect(name, plan$outputs), call)
      ), base_size),
      x = labels[1], y = labels[2],
      alt = paste0(
        "A map of ", count_in_words(nrow(data)), " tiles: ", labels[3], ", ",
        range_in_words(found), ", over ", labels[1], ", ", range_in_words(data$across), ", and ",
        labels[2], ", ", range_in_words(data$up), "."
      )
    ) +
    plot_theme(base_size) +
    # Room between the bar and its numbers.
    ggplot2::theme(
      panel.grid = ggplot2::element_blank(),
      legend.spacing.y = ggplot2::unit(if (few) 0 else 0.3 * base_size, "pt")
    )
}

abort_no_grid <- function(call) {
  abort_rotdyn(c(
    "A map needs one row for each pair of values of two inputs.",
    i = "Plan the sweep with {.fn design_grid}; name two inputs in {.arg x}, or a third one of up
         to nine values; filter the rows by the others."
  ), "value", call)
}

# list(at, width, log, even): the values of an axis, the size of a tile at each, whether a
# logarithmic axis spaces them evenly, and whether they are even on their axis.
map_axis <- function(values) {
  at <- sort(unique(values))
  is_even <- function(x) length(x) < 3L || diff(range(diff(x))) < 1e-6 * diff(range(x))
  linear <- is_even(at)
  log <- !linear && at[1] > 0 && (is_even(log(at)) || at[length(at)] > 100 * at[1])
  on_axis <- if (log) log10(at) else at
  step <- diff(on_axis)
  width <- if (length(step)) (c(step[1], step) + c(step, step[length(step)])) / 2 else 1
  list(at = at, width = width, log = log, even = is_even(on_axis))
}

map_scale <- function(linear, log, axis, base_size) {
  if (axis$log) return(log(expand = c(0, 0), guide = plot_axis()))
  linear(expand = c(0, 0), breaks = plot_breaks(base_size), guide = plot_axis())
}

# ---- indices ------------------------------------------------------------------------------------

plot_sweep_indices <- function(object, x, panels, base_size, call) {
  plan <- sweep_plan_of(object)
  if (!is.null(x)) {
    abort_rotdyn("Indices are of all inputs: {.arg x} must be NULL.", "value", call)
  }
  rows <- sweep_indices(object)
  panels <- sweep_panels(object, panels, 6L, plan$outputs, call)
  rows <- rows[rows$output %in% panels & is.finite(rows$total), ]
  if (!nrow(rows)) {
    abort_rotdyn("No output varies: it has no indices.", "value", call)
  }
  labels <- sweep_name(panels, plan)
  total <- tapply(rows$total, rows$input, max)
  order <- names(sort(total))
  kinds <- c("with others", "alone")
  data <- data.frame(
    input = factor(rep(rows$input, 2L), order, make.unique(sweep_name(order, plan), " ")),
    percent = 100 * c(rows$total, rows$first), error = 100 * c(rows$total_error, rows$first_error),
    part = factor(rep(kinds, each = nrow(rows)), kinds),
    panel = factor(rep(labels[match(rows$output, panels)], 2L), labels)
  )
  beside <- ggplot2::position_dodge(width = 0.75)
  largest <- vapply(panels[panels %in% rows$output], function(name) {
    some <- rows[rows$output == name, ]
    one <- which.max(some$total)
    paste0(labels[panels == name], ": ", sweep_name(some$input[one], plan), " ",
           format_si(signif(100 * some$total[one], 3)), " %")
  }, "")
  ggplot2::ggplot(data, ggplot2::aes(.data$percent, .data$input, fill = .data$part)) +
    ggplot2::geom_col(width = 0.7, position = beside) +
    ggplot2::geom_linerange(
      ggplot2::aes(
        xmin = .data$percent - 2 * .data$error, xmax = .data$percent + 2 * .data$error
      ), position = beside, colour = plot_ink, linewidth = 0.045 * base_size
    ) +
    ggplot2::geom_vline(xintercept = 0, colour = "grey60", linewidth = 0.02 * base_size) +
    ggplot2::facet_wrap("panel", ncol = if (length(labels) > 1L) 2L else 1L) +
    ggplot2::scale_fill_manual(
      values = stats::setNames(plot_colours[c(6, 1)], kinds), name = NULL, breaks = rev(kinds)
    ) +
    ggplot2::scale_x_continuous(breaks = plot_breaks(base_size), guide = plot_axis()) +
    ggplot2::labs(
      title = sweep_title(object, base_size, call),
      subtitle = sweep_subtitle(c(
        "Sobol indices, with two standard errors to both sides",
        sweep_unknown(object, panels, call)
      ), base_size),
      x = "share of the variance (%)", y = NULL,
      alt = paste0(
        "Bars of first and total Sobol indices. Largest total index of ",
        paste(largest, collapse = "; "), "."
      )
    ) +
    plot_theme(base_size) +
    ggplot2::theme(panel.grid.major.y = ggplot2::element_blank())
}
