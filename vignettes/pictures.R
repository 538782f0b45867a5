# How the pages print code and draw pictures. Sourced by their setup chunks where it is at hand: a
# page runs without it.
#
# Pictures are drawn by svglite and stand in the page as SVG, sharp at any size. A page has 588 px
# for the 504 points of seven inches, so a tenth of a point is a quarter of a pixel on a screen of
# two device pixels: coordinates are rounded to it, points of a line that lie nearer to their
# neighbours' line are left out (the spin-up, 400 points a curve: 46 kB as svglite writes it, 9 kB
# so). Without svglite, PNG of 168 dots an inch.

knitr::opts_chunk$set(
  collapse = TRUE, comment = "#>", fig.width = 7, fig.height = 3.6,
  fig.align = "center", out.width = "100%"
)
options(width = 80) # what a reader's console has

picture_tolerance <- 0.1

# Which points of an open line are kept (Douglas and Peucker 1973).
kept_points <- function(x, y) {
  n <- length(x)
  keep <- logical(n)
  keep[c(1L, n)] <- TRUE
  open <- list(c(1L, n))
  while (length(open)) {
    from <- open[[1]][1]
    to <- open[[1]][2]
    open[[1]] <- NULL
    if (to - from < 2L) next
    i <- seq.int(from + 1L, to - 1L)
    along <- c(x[to] - x[from], y[to] - y[from])
    long <- sum(along^2)
    t <- if (long > 0) ((x[i] - x[from]) * along[1] + (y[i] - y[from]) * along[2]) / long else 0
    t <- pmin(pmax(t, 0), 1)
    far <- (x[i] - x[from] - t * along[1])^2 + (y[i] - y[from] - t * along[2])^2
    if (max(far) <= picture_tolerance^2) next
    mid <- i[which.max(far)]
    keep[mid] <- TRUE
    open <- c(list(c(from, mid), c(mid, to)), open)
  }
  keep
}

# A number as SVG has it: no zeros that say nothing.
short_number <- function(x) sub("^(-?)0[.]", "\\1.", sub("^-0$", "0", as.character(round(x, 1))))

short_points <- function(text) {
  xy <- matrix(as.numeric(strsplit(trimws(text), "[ ,]+")[[1]]), 2)
  keep <- kept_points(xy[1, ], xy[2, ])
  paste(short_number(xy[1, keep]), short_number(xy[2, keep]), sep = ",", collapse = " ")
}

# gsub() with a function of what matched.
replace_each <- function(text, pattern, f) {
  found <- gregexpr(pattern, text, perl = TRUE)
  regmatches(text, found) <- lapply(regmatches(text, found), function(one) {
    vapply(one, f, "", USE.NAMES = FALSE)
  })
  text
}

# The styles of a page, as classes with short names that all its pictures share.
page_styles <- new.env()
page_styles$all <- character()
page_styles$pictures <- 0L

style_class <- function(style) {
  # The font is the page's: svglite's is that of the machine that made it.
  style <- gsub("stroke-linecap: round;|stroke-linejoin: round;|font-family: [^;]*;", "", style)
  style <- gsub("(\\d[.]\\d*?)0+(?=px|;)", "\\1", gsub("\\s*([:;])\\s*", "\\1", style), perl = TRUE)
  style <- sub(";$", "", gsub("[.](?=px|;)", "", style, perl = TRUE))
  if (!style %in% page_styles$all) page_styles$all <- c(page_styles$all, style)
  paste0("p", match(style, page_styles$all))
}

# A text with the width that it has in Helvetica, by which the picture was laid out: another font is
# squeezed to it. (DejaVu Sans is a sixth wider: labels were cut, or ran into each other.)
with_length <- function(element) {
  words <- sub(".*>", "", element)
  for (one in c("<lt", ">gt", "'#39", "\"quot", "&amp")) {
    words <- gsub(paste0("&", substring(one, 2), ";"), substr(one, 1, 1), words, fixed = TRUE)
  }
  if (grepl("[^ -~]", words)) return(element)
  size <- as.numeric(sub(".*font-size: ([0-9.]+)px.*", "\\1", element))
  long <- helvetica_width(words, size, grepl("font-weight: bold", element))
  squeezed <- paste0(" textLength='", short_number(long), "' lengthAdjust='spacingAndGlyphs'>")
  sub(">", squeezed, element)
}

# Widths in points, by a device of Helvetica that draws nothing.
helvetica_width <- function(words, size, bold) {
  shown <- grDevices::dev.cur()
  grDevices::pdf(NULL)
  on.exit({
    grDevices::dev.off()
    if (shown > 1L) grDevices::dev.set(shown)
  })
  graphics::plot.new()
  graphics::strwidth(words, "inches", cex = size / 12, font = if (bold) 2L else 1L) * 72
}

# The SVG of a file for a page: alternative text, short numbers, classes for styles.
svg_in_page <- function(path, alt) {
  svg <- paste(readLines(path, encoding = "UTF-8", warn = FALSE), collapse = "\n")
  size <- as.numeric(strsplit(sub(".*?viewBox='([^']*)'.*", "\\1", svg), " ")[[1]])
  body <- sub("</svg>\\s*$", "", sub("(?s)^.*?</defs>\\s*", "", svg, perl = TRUE))
  known <- length(page_styles$all)
  page_styles$pictures <- page_styles$pictures + 1L
  body <- replace_each(body, "points='[^']*'", function(one) {
    paste0("points='", short_points(gsub("^points='|'$", "", one)), "'")
  })
  body <- replace_each(body, "(?<=[ (])(x|y|x1|x2|y1|y2|cx|cy|r|width|height)='-?[0-9.]+'",
                       function(one) {
    number <- sub(".*'(.*)'", "\\1", one)
    sub("'.*", paste0("='", short_number(as.numeric(number)), "'"), sub("=", "", one))
  })
  # Identifiers hold for the whole page. A map has any letters in its data.
  body <- gsub("(id='|url\\(#)cp", paste0("\\1c", page_styles$pictures), body)
  body <- replace_each(body, "<text [^>]*>[^<]{9,}(?=</text>)", with_length)
  body <- replace_each(body, "style='[^']*'", function(one) {
    paste0("class='", style_class(gsub("^style='|'$", "", one)), "'")
  })
  body <- gsub("\\s*/>", "/>", gsub(">\\s*\n\\s*<", "><", body))
  new <- page_styles$all[seq_along(page_styles$all) > known]
  rules <- if (length(new)) sprintf(".pic .p%d{%s}", known + seq_along(new), new)
  if (page_styles$pictures == 1L) {
    rules <- c(
      ".pic{display:block;margin:1em auto;max-width:100%;height:auto}",
      paste0(".pic line,.pic polyline,.pic polygon,.pic path,.pic rect,.pic circle",
             "{fill:none;stroke:#000;stroke-linecap:round;stroke-linejoin:round;",
             "stroke-miterlimit:10}"),
      ".pic text{white-space:pre}", rules
    )
  }
  text <- gsub("\"", "&quot;", gsub("<", "&lt;", gsub("&", "&amp;", alt)))
  paste0(
    "<svg class=\"pic\" role=\"img\" aria-label=\"", text, "\" viewBox=\"",
    paste(size, collapse = " "), "\" width=\"", round(size[3] * 7 / 6), "\">",
    if (length(rules)) paste0("<style>", paste(rules, collapse = ""), "</style>"), body, "</svg>"
  )
}

`%||%` <- function(x, y) if (is.null(x)) y else x

# pkgdown names its pictures itself.
if (requireNamespace("svglite", quietly = TRUE) && Sys.getenv("IN_PKGDOWN") == "") {
  knitr::opts_chunk$set(dev = "svglite", dev.args = list(fix_text_size = FALSE))
  drawn_by_format <- knitr::knit_hooks$get("plot")
  knitr::knit_hooks$set(plot = function(x, options) {
    if (!grepl("[.]svg$", x)) return(drawn_by_format(x, options))
    alt <- options$fig.alt %||% ggplot2::get_alt_text(ggplot2::last_plot())
    # The comment parts it from output that follows in the same chunk.
    paste0("\n```{=html}\n", svg_in_page(x, paste(alt, collapse = " ")), "\n```\n\n<!-- -->\n")
  })
} else {
  knitr::opts_chunk$set(dpi = 168)
}
