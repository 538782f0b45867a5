# What all pictures share. ggplot2 is suggested; the methods are registered when it is loaded.

# A palette for colour-blind readers and projectors (Okabe and Ito 2008), without its yellow, which
# is too pale for lines on white.
plot_colours <- c("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")

# n colours; beyond seven, plot_types() distinguishes them.
line_colours <- function(n) rep_len(plot_colours, n)

plot_types <- function(n) {
  rep_len(rep(c("solid", "42", "13", "4213"), each = length(plot_colours)), n)
}

# The checks of every picture. The dots must be empty; returns the caller's frame.
check_plot <- function(base_size, ...) {
  call <- parent.frame()
  if (...length()) {
    abort_dots(as.list(substitute(list(...)))[-1L], call, rlang::caller_fn())
  }
  need_package("ggplot2", "A plot", call)
  check_number(base_size, "base_size", "1", call, lower = 4, upper = 96)
  call
}

# The darkest letters. Their smoothed edges then leave colours free in a PNG of 256 colours, which
# is a third of the size of one in true colour (14 of 43 kB for four panels).
plot_ink <- "grey15"

# Margins grow less than the letters, so that panels have room where the letters are large.
plot_theme <- function(base_size = 13) {
  gap <- 3 + 0.15 * base_size
  text <- function(...) ggplot2::element_text(..., lineheight = 0.95)
  ggplot2::theme_minimal(base_size = base_size) +
    ggplot2::theme(
      text = ggplot2::element_text(colour = plot_ink),
      panel.grid.minor = ggplot2::element_blank(),
      plot.title.position = "plot",
      plot.title = text(face = "bold", size = ggplot2::rel(1.1), margin = ggplot2::margin(b = gap)),
      plot.subtitle = text(
        colour = "grey35", size = ggplot2::rel(0.8), margin = ggplot2::margin(b = gap)
      ),
      plot.caption = text(hjust = 0, size = ggplot2::rel(0.7), colour = "grey35"),
      plot.caption.position = "plot",
      axis.title = text(size = ggplot2::rel(0.8)),
      axis.text = text(size = ggplot2::rel(0.72)),
      strip.text = text(
        colour = plot_ink, hjust = 0, face = "bold", size = ggplot2::rel(0.75),
        margin = ggplot2::margin(gap / 2, 0, gap / 2, 0)
      ),
      legend.position = "bottom",
      legend.margin = ggplot2::margin(0, 0, 0, 0),
      legend.box.spacing = ggplot2::unit(gap, "pt"),
      legend.spacing.y = ggplot2::unit(0, "pt"),
      legend.text = text(size = ggplot2::rel(0.75)),
      legend.title = text(size = ggplot2::rel(0.75)),
      legend.key.height = ggplot2::unit(1.05 * base_size, "pt"),
      legend.key.width = ggplot2::unit(1.6 * base_size, "pt"),
      panel.spacing.y = ggplot2::unit(gap, "pt"),
      panel.spacing.x = ggplot2::unit(gap + 0.6 * base_size, "pt"),
      plot.margin = ggplot2::margin(6, 0.7 * base_size, 4, 6)
    )
}

# The size of geom_text() for letters as large as those of the axes.
text_size <- function(base_size) 0.72 * base_size / (72.27 / 25.4)

# Labels of an axis that would overlap are left out.
plot_axis <- function() ggplot2::guide_axis(check.overlap = TRUE)

# Few round values within the limits: fewer where the letters are large.
plot_breaks <- function(base_size, maximum = 5) {
  n <- max(2, round(maximum * 13 / max(base_size, 13)))
  function(limits) {
    at <- pretty(limits, n)
    at[at >= limits[1] & at <= limits[2]]
  }
}

# The width of text in points: a letter is about 0.55 of its size, a bold one 0.58.
text_width <- function(text, size, bold = FALSE) {
  max(nchar(text), 0L) * size * if (bold) 0.58 else 0.55
}

# Lines of text that fit a width, by default that of a picture of 7 inches.
wrap_text <- function(text, size, width_in = 6.7, bold = FALSE) {
  room <- max(floor(width_in * 72 / text_width("x", size, bold)), 10)
  paste(unlist(lapply(text, strwrap, room + 1)), collapse = "\n")
}

# The label of a panel: its unit stays whole.
wrap_label <- function(label, size, width_in) {
  if (text_width(label, size, TRUE) <= width_in * 72) return(label)
  unit <- sub("^.*(\\([^(]*\\))$", "\\1", label)
  name <- trimws(substr(label, 1L, nchar(label) - if (unit == label) 0L else nchar(unit)))
  paste(c(wrap_text(name, size, width_in, TRUE), if (unit != label) unit), collapse = "\n")
}

wrap_title <- function(text, base_size) wrap_text(text, 1.1 * base_size, bold = TRUE)

wrap_subtitle <- function(text, base_size) {
  if (length(text)) wrap_text(text, 0.8 * base_size)
}

# Units that a picture may show, by the SI unit: the factor to each.
plot_units <- list(
  rad = c(degree = 180 / pi, turn = 0.5 / pi, rad = 1),
  "rad/s" = c(rpm = 30 / pi, "degree/s" = 180 / pi, "turn/s" = 0.5 / pi, "rad/s" = 1),
  s = c(ms = 1e3, min = 1 / 60, h = 1 / 3600, s = 1),
  J = c(mJ = 1e3, kJ = 1e-3, "W h" = 1 / 3600, J = 1),
  "N m" = c("mN m" = 1e3, "kN m" = 1e-3, "N m" = 1)
)

# The units asked for, by the SI unit that each replaces.
check_plot_units <- function(units, call) {
  if (is.null(units)) return(character())
  known <- unlist(lapply(plot_units, names), use.names = FALSE)
  if (!is.character(units) || anyNA(units)) {
    abort_rotdyn(c(
      "{.arg units} must be NULL or names of units.", x = "It is {describe_value(units)}."
    ), "type", call)
  }
  bad <- setdiff(units, known)
  if (length(bad)) {
    abort_rotdyn(c(
      "{.arg units} must be among {.or {.val {known}}}.", x = "It has {.val {bad}}."
    ), "unit", call)
  }
  of <- rep(names(plot_units), lengths(plot_units))[match(units, known)]
  if (anyDuplicated(of)) {
    twice <- units[of == of[duplicated(of)][1]]
    abort_rotdyn("{.arg units} has two units of one quantity: {.val {twice}}.", "unit", call)
  }
  stats::setNames(units, of)
}

# list(label, factor) of a panel whose label ends in a unit: "angle (rad)".
in_plot_unit <- function(label, units) {
  si <- sub("^.*\\((.*)\\)$", "\\1", label)
  if (!si %in% names(units)) return(list(label = label, factor = 1))
  unit <- units[[si]]
  list(
    label = paste0(sub("\\([^(]*\\)$", "", label), "(", unit, ")"),
    factor = plot_units[[si]][[unit]]
  )
}

# The power of 1000 in which an axis of these values has no exponents; 0 for usual values.
power_of <- function(values) {
  size <- max(abs(values), 0)
  if (!isTRUE(is.finite(size) && size > 0 && (size < 1e-3 || size >= 1e5))) return(0)
  3 * floor(log10(size) / 3)
}

# "angle (1e-6 rad)".
label_in_power <- function(label, power) {
  if (power == 0) label else sub("[(]([^(]*)$", paste0("(1e", power, " \\1"), label)
}

# "3, 1.5 to 7": the range of values in words.
range_in_words <- function(x, digits = 3) {
  x <- x[is.finite(x)]
  if (!length(x)) return("no values")
  ends <- format_si(signif(range(x), digits))
  if (ends[1] == ends[2]) ends[1] else paste(ends[1], "to", ends[2])
}

# ---- plot() -------------------------------------------------------------------------------------

# plot() of a class that has autoplot() draws that picture, instead of pairs of columns.
plot_by_autoplot <- function(x, ...) {
  need_package("ggplot2", "A plot", current_env())
  picture <- ggplot2::autoplot(x, ...)
  print(picture)
  invisible(picture)
}

register_plots <- function() {
  names <- grep("^autoplot[.]rot_", ls(topenv(), all.names = TRUE), value = TRUE)
  for (class in sub("^autoplot[.]", "", names)) {
    registerS3method("plot", class, plot_by_autoplot, envir = baseenv())
  }
}
