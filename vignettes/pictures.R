# How the lessons print code and draw pictures. Sourced by their setup chunks where it is at hand: a
# lesson runs without it.
#
# Eighty pictures of 84 dots an inch, with smooth edges, would take the package beyond 5 MB. As PNG
# with a palette of the few colours that a plot has they take a third (spin-up, 588 x 302: 34 kB as
# R writes it, 11 kB so).

knitr::opts_chunk$set(
  collapse = TRUE, comment = "#>", fig.width = 7, fig.height = 3.6,
  fig.align = "center", out.width = "100%"
)
options(width = 86, pillar.width = Inf)

# Colours so near to each other, in steps of 1/255, become one. A difference of hue counts twice: a
# grey line that becomes slightly green is seen, one that becomes slightly darker is not.
nearest_kept <- 18

lightness_and_hue <- function(rgb) {
  matrix(c(1, 1, 1, sqrt(6), -sqrt(6), 0, sqrt(2), sqrt(2), -sqrt(8)), 3L, byrow = TRUE) %*% rgb /
    sqrt(3)
}

# Indices (from 0) into a palette of the most frequent colours.
with_palette <- function(pixels) {
  levels <- round(255 * pixels)
  key <- as.integer(levels[, , 1] * 65536 + levels[, , 2] * 256 + levels[, , 3])
  all <- unique(key)
  all <- all[order(tabulate(match(key, all)), decreasing = TRUE)]
  rgb <- rbind(all %/% 65536L, all %/% 256L %% 256L, all %% 256L)
  colours <- lightness_and_hue(rgb)
  kept <- integer()
  for (i in seq_along(all)) {
    apart <- colSums((colours[, kept, drop = FALSE] - colours[, i])^2)
    if (!any(apart < nearest_kept^2)) kept <- c(kept, i)
    if (length(kept) == 256L) break
  }
  chosen <- colours[, kept, drop = FALSE]
  index <- apply(colours, 2L, function(colour) which.min(colSums((chosen - colour)^2)))
  list(
    palette = rgb[, kept, drop = FALSE],
    index = matrix(index[match(key, all)] - 1L, nrow(levels))
  )
}

crc_table <- vapply(0:255, function(byte) {
  for (k in 1:8) {
    byte <- bitwXor(bitwShiftR(byte, 1L), if (byte %% 2 != 0) -306674912L else 0L)
  }
  byte
}, 0)

big_endian <- function(x) as.raw(x %/% 256^(3:0) %% 256)

# Length, name, data and checksum (PNG specification, sections 5.3 and D).
png_chunk <- function(name, data) {
  bytes <- c(charToRaw(name), data)
  crc <- -1L
  for (byte in as.integer(bytes)) {
    low <- bitwAnd(bitwXor(crc, byte), 255L)
    crc <- bitwXor(crc_table[low + 1L], bitwShiftR(crc, 8L))
  }
  c(big_endian(length(data)), bytes, big_endian(bitwNot(crc) %% 2^32))
}

# The file again, with a palette; as it was where the package png is not there.
shrink_png <- function(path, options) {
  if (!grepl("[.]png$", path) || !requireNamespace("png", quietly = TRUE)) return(path)
  pixels <- png::readPNG(path)
  if (length(dim(pixels)) != 3L) return(path)
  new <- with_palette(pixels)
  index <- new$index
  bits <- if (ncol(new$palette) <= 16L) 4L else 8L
  width <- ncol(index)
  if (bits == 4L) {
    if (width %% 2L) index <- cbind(index, 0L)
    odd <- seq(1L, ncol(index), by = 2L)
    index <- 16L * index[, odd] + index[, odd + 1L]
  }
  rows <- rbind(0L, t(index)) # each row begins with its filter: none
  bytes <- c(
    as.raw(c(137, 80, 78, 71, 13, 10, 26, 10)),
    png_chunk("IHDR", c(big_endian(width), big_endian(nrow(index)), as.raw(c(bits, 3, 0, 0, 0)))),
    png_chunk("PLTE", as.raw(new$palette)),
    png_chunk("IDAT", memCompress(as.raw(rows), "gzip")),
    png_chunk("IEND", raw())
  )
  if (length(bytes) < file.size(path)) writeBin(bytes, path)
  path
}

knitr::opts_chunk$set(
  dpi = if (requireNamespace("png", quietly = TRUE)) 84 else 60, fig.process = shrink_png
)
