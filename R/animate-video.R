# Animations as files of pictures: GIF by gifski, MP4 and WebM by av. The encoders print what is
# wrong and go on, or write an empty file: what they wrote is looked at before it takes its name.

# The i-th frame on the open device, by the marks that draw_mark() (R/draw.R) draws, too; a frame of
# ggplot2 would take ten times as long.
draw_film_frame <- function(film, i) {
  frame <- flat_frame(film, i)
  box <- film$box
  middle <- c(mean(box[1:2]), mean(box[3:4]))
  room <- max(diff(box[1:2]), diff(box[3:4])) / 2 * 1.04
  old <- graphics::par(mar = c(0, 0, 0, 0), bg = "white")
  on.exit(graphics::par(old))
  graphics::plot.new()
  graphics::plot.window(c(-room, room), c(-room, room), asp = 1, xaxs = "i", yaxs = "i")
  for (one in frame$marks) {
    points <- sweep(one$points, 2, middle)
    dashed <- one$style %in% c("dashed", "hole")
    if (one$type == "fill") {
      graphics::polygon(points, col = fill_of(one$style), border = edge_of(one),
                        lty = if (dashed) 2 else 1)
      next
    }
    colour <- if (dashed) "grey50" else draw_colours[[one$style]]
    graphics::lines(points, col = colour, lty = if (dashed) 2 else 1, lwd = 2)
    n <- nrow(points)
    if (one$type == "arrow" && sum((points[n, ] - points[n - 1L, ])^2) > 1e-6 * room^2) {
      graphics::arrows(points[n - 1L, 1], points[n - 1L, 2], points[n, 1], points[n, 2],
                       length = 0.11, angle = 20, lwd = 2, col = colour)
    }
  }
  labels <- frame$labels
  for (k in seq_len(NROW(labels))) {
    graphics::text(
      labels$x[k] - middle[1], labels$y[k] - middle[2], parse(text = labels$symbol[k]),
      col = draw_colours[[labels$style[k]]], cex = 1.1, adj = c(labels$hjust[k] %||% 0.5, 0.5)
    )
  }
  graphics::text(-0.98 * room, 0.95 * room, frame$says, adj = c(0, 1))
  shown <- formatC(film$time_s[i], format = "f", digits = film_time_digits(film))
  graphics::text(-0.98 * room, -0.97 * room, paste("t =", shown, "s"), adj = c(0, 0))
  speed <- speed_words(film$slow)
  if (nzchar(speed)) graphics::text(0.98 * room, -0.97 * room, speed, adj = c(1, 0))
}

write_film <- function(file, film, width_px, delay_s, call) {
  kind <- tolower(sub("^.*\\.", "", file))
  folder <- tempfile("frames")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  before <- grDevices::dev.cur()
  grDevices::png(file.path(folder, "%05d.png"), width_px, width_px)
  device <- grDevices::dev.cur()
  shut <- function() {
    if (device %in% grDevices::dev.list()) grDevices::dev.off(device)
    if (before %in% grDevices::dev.list()) grDevices::dev.set(before)
  }
  on.exit(shut(), add = TRUE, after = FALSE)
  for (i in seq_along(film$time_s)) draw_film_frame(film, i)
  shut()
  write_file(encoded_bytes(folder, kind, width_px, delay_s, call), file, call)
}

encode_film <- function(pictures, made, kind, width_px, delay_s) {
  if (kind == "gif") {
    gifski::gifski(pictures, made, width_px, width_px, delay_s, progress = FALSE)
  } else {
    av::av_encode_video(pictures, made, framerate = 1 / delay_s, verbose = FALSE)
  }
}

# The file of the pictures in a folder, made there.
encoded_bytes <- function(folder, kind, width_px, delay_s, call, encode = encode_film) {
  pictures <- list.files(folder, full.names = TRUE)
  made <- file.path(folder, paste0("film.", kind))
  fault <- "The disk is full, perhaps."
  whole <- length(pictures) && all(vapply(pictures, ends_with, NA, png_end))
  if (whole) {
    fault <- tryCatch({
      encode(pictures, made, kind, width_px, delay_s)
      if (is_film(made, kind)) "" else "The encoder wrote an empty or a damaged file."
    }, error = conditionMessage)
    whole <- !nzchar(fault)
  }
  if (whole) return(readBin(made, "raw", file.size(made)))
  # Space that is left shows that the disk is not the reason.
  probe <- tempfile("space", dirname(folder))
  on.exit(unlink(probe))
  full <- put_file(raw(2^20), probe)
  abort_rotdyn(c(
    "The pictures of the film cannot be stored in {.file {dirname(folder)}}.",
    x = braces_doubled(if (nzchar(full)) full else fault)
  ), "file", call)
}

# Is the file whole? A GIF ends with its trailer; MP4 and WebM begin with their heads, and have a
# picture of some size.
is_film <- function(path, kind) {
  if (kind == "gif") return(ends_with(path, as.raw(0x3b)) && file.size(path) > 100)
  if (!isTRUE(file.size(path) > 500)) return(FALSE)
  head <- readBin(path, "raw", 12L)
  if (kind == "mp4") return(identical(rawToChar(head[5:8]), "ftyp"))
  identical(head[1:4], as.raw(c(0x1a, 0x45, 0xdf, 0xa3)))
}

png_end <- as.raw(c(0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82)) # IEND and its checksum

ends_with <- function(path, bytes) {
  size <- file.size(path)
  if (is.na(size) || size < length(bytes)) return(FALSE)
  con <- file(path, "rb")
  on.exit(close(con))
  seek(con, size - length(bytes))
  identical(readBin(con, "raw", length(bytes)), bytes)
}
