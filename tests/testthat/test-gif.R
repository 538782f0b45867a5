# A GIF file, read as the format is described: size, delay, colours and pixels of each picture.
read_gif <- function(path) {
  bytes <- as.integer(readBin(path, "raw", file.size(path)))
  short <- function(at) bytes[at] + 256 * bytes[at + 1]
  expect_identical(rawToChar(as.raw(bytes[1:6])), "GIF89a")
  at <- 14
  pictures <- list()
  delay <- NA
  repeat {
    kind <- bytes[at]
    if (kind == 0x3b) break
    if (kind == 0x21) {
      if (bytes[at + 1] == 0xf9) delay <- short(at + 4)
      at <- at + 2
      while (bytes[at] > 0) at <- at + bytes[at] + 1
      at <- at + 1
    } else if (kind == 0x2c) {
      size <- c(short(at + 5), short(at + 7))
      colours <- 2^(bytes[at + 9] %% 8 + 1)
      palette <- matrix(bytes[at + 9 + seq_len(3 * colours)], 3)
      at <- at + 10 + 3 * colours
      width <- bytes[at]
      at <- at + 1
      data <- integer()
      while (bytes[at] > 0) {
        data <- c(data, bytes[at + seq_len(bytes[at])])
        at <- at + bytes[at] + 1
      }
      at <- at + 1
      pictures <- c(pictures, list(list(
        size = size, delay = delay, palette = palette, pixels = unpack_gif(data, width)
      )))
    } else {
      stop("not a GIF")
    }
  }
  expect_identical(at, length(bytes) + 0)
  pictures
}

unpack_gif <- function(data, bits) {
  stream <- as.integer(intToBits(data))
  dim(stream) <- c(32, length(data))
  stream <- as.vector(stream[1:8, ])
  clear <- 2^bits
  out <- list()
  width <- bits + 1
  known <- c(as.list(seq_len(clear) - 1), list(NULL, NULL))
  old <- NULL
  at <- 0
  repeat {
    code <- sum(stream[at + seq_len(width)] * 2^(seq_len(width) - 1))
    at <- at + width
    if (code == clear + 1) break
    if (code == clear) {
      width <- bits + 1
      known <- c(as.list(seq_len(clear) - 1), list(0, 0))
      old <- NULL
      next
    }
    new <- if (code < length(known)) known[[code + 1]] else c(old, old[1])
    if (!is.null(old) && length(known) < 4096) {
      known[[length(known) + 1]] <- c(old, new[1])
      if (length(known) == 2^width && width < 12) width <- width + 1
    }
    out[[length(out) + 1]] <- new
    old <- new
  }
  unlist(out)
}

test_that("pictures come back, pixel by pixel", {
  skip_if_not(capabilities("cairo"), "no bitmap device")
  path <- tempfile(fileext = ".gif")
  on.exit(unlink(path))
  # Without smoothed edges there are the colours given, and no others.
  draw <- function(i) {
    old <- graphics::par(mar = c(0, 0, 0, 0), xaxs = "i", yaxs = "i")
    on.exit(graphics::par(old))
    graphics::plot.new()
    graphics::plot.window(c(0, 50), c(0, 40))
    graphics::rect(10 * i, 20, 10 * i + 10, 30, col = "#FF0000", border = NA)
    graphics::rect(0, 0, 50, 10, col = "#0040A0", border = NA)
  }
  grDevices::pdf(NULL)
  mine <- grDevices::dev.cur()
  grDevices::pdf(NULL)
  other <- grDevices::dev.cur()
  on.exit(for (one in c(mine, other)) grDevices::dev.off(one), add = TRUE)
  grDevices::dev.set(mine)
  write_gif(path, 3, draw, 50, 40, 7, NULL)
  expect_identical(grDevices::dev.cur(), mine) # of those that were open
  pictures <- read_gif(path)
  expect_length(pictures, 3)
  for (i in 1:3) {
    one <- pictures[[i]]
    expect_identical(one$size, c(50, 40))
    expect_identical(one$delay, 7)
    pixels <- matrix(one$pixels + 1, 50) # from the top
    colour <- function(x, y) one$palette[, pixels[x, y]]
    expect_identical(colour(5, 38), c(0L, 64L, 160L))
    expect_identical(colour(10 * i + 5, 15), c(255L, 0L, 0L))
    expect_identical(colour(10 * i - 5, 15), c(255L, 255L, 255L))
    expect_identical(colour(45, 3), c(255L, 255L, 255L))
  }
})

test_that("more colours than a palette holds become the nearest", {
  colours <- matrix(as.integer(c(rep(0:299, 2), 0:299 * 65536L)), 30)
  kept <- most_frequent(colours, 256L)
  expect_length(kept, 256)
  expect_identical(nearest_colour(c(3, 65536 * 7 + 256), c(0, 2, 65536 * 7)), c(2L, 3L))
  bytes <- gif_picture(colours, 4)
  expect_type(bytes, "raw")
  expect_identical(most_frequent(c(5L, 5L, 7L), 1L), 5L)
})

test_that("files of 8 bits with a palette are read, too", {
  path <- tempfile(fileext = ".bmp")
  on.exit(unlink(path))
  long <- function(x) as.raw(c(x %% 256, x %/% 256, 0, 0))
  # 3 x 2 pixels of 2 colours: lines of 4 bytes, the lowest first
  header <- c(
    charToRaw("BM"), long(70), long(0), long(62), long(40), long(3), long(2), as.raw(c(1, 0, 8, 0)),
    long(0), long(8), long(0), long(0), long(2), long(0),
    as.raw(c(1, 2, 3, 0, 10, 20, 30, 0)), as.raw(c(0, 1, 1, 0)), as.raw(c(1, 0, 0, 0))
  )
  writeBin(header, path)
  low <- 3L * 65536L + 2L * 256L + 1L
  high <- 30L * 65536L + 20L * 256L + 10L
  expect_identical(read_bmp(path), matrix(c(high, low, low, low, high, high), 3))
})
