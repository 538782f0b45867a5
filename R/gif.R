# Animated GIF89a files: pictures of a bitmap device (bmp(), whose files are not compressed),
# packed in C.

# The pictures that draw(i) makes, i from 1 to n, with delay_cs hundredths of a second between them.
write_gif <- function(path, n, draw, width_px, height_px, delay_cs, call) {
  # Before the pictures: they may take a minute.
  out <- tryCatch(
    suppressWarnings(file(path, "wb")), error = function(e) abort_unwritten(path, e, call)
  )
  on.exit(close(out))
  folder <- tempfile("frames")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE), add = TRUE)
  pattern <- file.path(folder, "%05d.bmp")
  before <- grDevices::dev.cur()
  picture_device(pattern, width_px, height_px, call)
  device <- grDevices::dev.cur()
  shut <- function() {
    if (device %in% grDevices::dev.list()) grDevices::dev.off(device)
    if (before %in% grDevices::dev.list()) grDevices::dev.set(before)
  }
  on.exit(shut(), add = TRUE, after = FALSE)
  put <- function(bytes) {
    tryCatch(writeBin(bytes, out), error = function(e) abort_unwritten(path, e, call))
  }
  put_picture <- function(i) {
    picture <- sprintf(pattern, i)
    put(gif_picture(read_bmp(picture), delay_cs))
    unlink(picture)
  }
  # Without a palette for all; it begins again after the last picture.
  put(c(
    charToRaw("GIF89a"), gif_short(width_px), gif_short(height_px), as.raw(c(0x70, 0, 0)),
    as.raw(c(0x21, 0xff, 11)), charToRaw("NETSCAPE2.0"), as.raw(c(3, 1, 0, 0, 0))
  ))
  # The file of a picture is complete when the next one has begun.
  for (i in seq_len(n)) {
    draw(i)
    if (i > 1L) put_picture(i - 1L)
  }
  shut()
  put_picture(n)
  put(as.raw(0x3b))
}

picture_device <- function(pattern, width_px, height_px, call) {
  type <- if (.Platform$OS.type == "windows") "windows" else if (capabilities("cairo")) "cairo"
  opened <- tryCatch(
    {
      grDevices::bmp(pattern, width_px, height_px, type = type %||% "Xlib")
      NULL
    },
    error = identity, warning = identity
  )
  if (!is.null(opened)) {
    abort_rotdyn(c(
      "A GIF needs the bitmap device {.fn bmp}, which this R does not have.",
      x = conditionMessage(opened)
    ), "package", call)
  }
}

gif_short <- function(x) as.raw(c(x %% 256, x %/% 256))

# Palette and pixels of one picture: `colours` is 65536 red + 256 green + blue, a row of pixels
# after the other.
gif_picture <- function(colours, delay_cs) {
  palette <- most_frequent(colours, 256L)
  bits <- max(2, ceiling(log2(length(palette))))
  at <- match(colours, palette)
  lost <- is.na(at)
  if (any(lost)) {
    rest <- unique(colours[lost])
    at[lost] <- nearest_colour(rest, palette)[match(colours[lost], rest)]
  }
  size <- dim(colours)
  padded <- c(palette, integer(2^bits - length(palette)))
  c(
    as.raw(c(0x21, 0xf9, 4, 4)), gif_short(delay_cs), as.raw(c(0, 0)),
    as.raw(0x2c), gif_short(0), gif_short(0), gif_short(size[1]), gif_short(size[2]),
    as.raw(0x80 + bits - 1), as.raw(rbind(padded %/% 65536, padded %/% 256 %% 256, padded %% 256)),
    .Call(ffi_gif_pack, as.raw(at - 1L), bits)
  )
}

most_frequent <- function(colours, n) {
  all <- unique(as.vector(colours))
  if (length(all) <= n) return(all)
  often <- tabulate(match(colours, all))
  all[order(often, decreasing = TRUE)[seq_len(n)]]
}

nearest_colour <- function(colours, palette) {
  off <- 0
  for (by in c(65536, 256, 1)) {
    off <- off + outer(colours %/% by %% 256, palette %/% by %% 256, `-`)^2
  }
  max.col(-off, "first")
}

# A matrix of width x height colours, from the top. The files of bmp() have 8 bits and a palette, or
# 24 or 32 bits, and lines from the bottom, each of whole groups of 4 bytes.
read_bmp <- function(path) {
  bytes <- readBin(path, "raw", file.size(path))
  number <- function(at, n) sum(as.integer(bytes[at + seq_len(n)]) * 256^(seq_len(n) - 1))
  width <- number(18, 4)
  height <- number(22, 4)
  depth <- number(28, 2)
  line <- ceiling(width * depth / 32) * 4
  pixels <- matrix(bytes[number(10, 4) + seq_len(line * height)], line)
  colours <- function(parts, each) {
    part <- function(k) as.integer(parts[seq(k, length(parts), by = each)])
    part(1) + 256L * part(2) + 65536L * part(3)
  }
  used <- pixels[seq_len(width * depth / 8), ]
  all <- if (depth == 8) {
    palette <- bytes[(15 + number(14, 4)):number(10, 4)]
    colours(palette, 4)[as.integer(used) + 1L]
  } else {
    colours(used, depth / 8)
  }
  matrix(all, width)[, height:1]
}
