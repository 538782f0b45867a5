read_text <- function(lines) {
  read_delimited(paste(lines, collapse = "\n"), "x.csv", rlang::current_env())
}

test_that("separators, decimal marks, lines above the headings", {
  want <- list(c(0, 0.5, 1), c(1.25, -2.5, 300))
  for (case in list(c(",", "."), c(";", "."), c("\t", "."), c(" ", "."), c(";", ","), c("\t", ","),
    c(" ", ","))) {
    cells <- rbind(c("t", "a"), c("0", "1.25"), c("0.5", "-2.5"), c("1.0", "3e2"))
    if (case[2] == ",") cells <- sub(".", ",", cells, fixed = TRUE)
    lines <- apply(cells, 1, paste, collapse = case[1])
    for (above in list(character(), c("A file of today", "", "with two lines"))) {
      table <- read_text(c(above, lines))
      expect_equal(table$columns, want, info = paste(case, collapse = " "))
      expect_equal(table$headings, c("t", "a"))
    }
  }
})

test_that("headings with separators in quotes, of names and units on several lines", {
  table <- read_text(c("\"Time, run 1 (s)\",\"Angle (rad)\"", "1,2", "3,4"))
  expect_equal(table$headings, c("Time, run 1 (s)", "Angle (rad)"))
  table <- read_text(c(
    "Vernier Format 2", "x.cmbl", "Run 1", "Time\tAngle", "t\ta", "s\trad", "0\t1", "1\t3"
  ))
  expect_equal(table$headings, c("Time (s)", "Angle (rad)"))
  expect_equal(read_text(c("1 2", "3 4"))$headings, character())
})

test_that("missing cells, a separator at the end, cells that are no number", {
  table <- read_text(c("t,a,b", "0,,1", "1,2,NaN", "2,3,4", "3,4,5"))
  expect_equal(table$columns[[2]], c(NA, 2, 3, 4))
  expect_equal(table$columns[[3]], c(1, NA, 4, 5))
  table <- read_text(c("t,a,", "0,1,", "1,2,", "2,3,"))
  expect_equal(table$headings, c("t", "a"))
  expect_length(table$columns, 2)
  table <- read_text(c("t,a", "0,1", "1,0x10", "2,1d5", "3,4", "4,1e999"))
  expect_equal(table$columns[[2]], c(1, NA, NA, 4, NA))
  expect_equal(table$odd, c(0, 3))
})

test_that("rows with another number of cells are dropped, never shifted", {
  rows <- c("t,a,b", sprintf("%d,%d,%d", 0:40, 2 * 0:40, 3 * 0:40))
  rows[8] <- "6,18"
  rows[20] <- "18,36,54,7"
  table <- read_text(rows)
  expect_equal(table$dropped$row, c(7, 19))
  keep <- setdiff(1:41, c(7, 19))
  expect_equal(table$columns[[3]][keep], 3 * (keep - 1))
  expect_true(all(is.na(table$columns[[2]][c(7, 19)])))
  # Decimal commas in a file with commas: twice the cells.
  expect_error(read_text(c("t,a", sprintf("0,%02d,1,%02d", 1:20, 1:20))),
    class = "rotdyn_error_file")
  rows[seq(5, 40, 4)] <- "1,2"
  expect_error(read_text(rows), class = "rotdyn_error_file")
})

test_that("a log of one column, of a known rate", {
  file <- tempfile(fileext = ".csv")
  rates <- c(1, -2.5, 3e-2, 4)
  for (above in list("wz (rad/s)", c("# a log of one column", "wz (rad/s)"))) {
    writeLines(c(above, rates), file)
    log <- read_imu(file, rate_hz = 10)
    expect_identical(log$omega_rad_per_s, rates)
    expect_equal(log$time_s, 0:3 / 10)
  }
  expect_error(read_imu(file), "rate_hz", class = "rotdyn_error_file")
  expect_error(read_tracker(file), class = "rotdyn_error_file")
  writeLines(as.character(rates), file)
  expect_error(read_imu(file, rate_hz = 10), class = "rotdyn_error_file")
  log <- read_imu(file, rate_hz = 10, headings = "wz (deg/s)")
  expect_equal(log$omega_rad_per_s, rates * pi / 180)
  writeLines(c("wz", "one", "two"), file)
  expect_error(read_imu(file, rate_hz = 10), "table of numbers", class = "rotdyn_error_file")
})

test_that("encodings", {
  text <- "Zeit (s);Winkel (\u00b0)\n0,5;10\n0,6;20\n"
  call <- rlang::current_env()
  for (encoding in c("UTF-8", "latin1", "UTF-16LE", "UTF-16BE")) {
    bytes <- iconv(text, "UTF-8", encoding, toRaw = TRUE)[[1]]
    expect_equal(decode_bytes(bytes, "x", call), text, info = encoding)
  }
  expect_equal(decode_bytes(c(as.raw(c(0xef, 0xbb, 0xbf)), charToRaw("a")), "x", call), "a")
  # A last character that is cut in two is left out.
  for (encoding in c("UTF-16LE", "UTF-16BE")) {
    bytes <- iconv(text, "UTF-8", encoding, toRaw = TRUE)[[1]]
    expect_equal(decode_bytes(bytes[-length(bytes)], "x", call), sub("\n$", "", text))
    mark <- as.raw(if (encoding == "UTF-16LE") c(0xff, 0xfe) else c(0xfe, 0xff))
    expect_equal(decode_bytes(c(mark, bytes, as.raw(65)), "x", call), text)
  }
  expect_error(decode_bytes(as.raw(c(65, 0, 66, 67, 68, 69)), "x", call),
    class = "rotdyn_error_file")
  expect_error(decode_bytes(as.raw(c(0xff, 0xfe, 65, 0, 0, 0, 66, 0)), "x", call),
    class = "rotdyn_error_file")
})

test_that("a name of bytes is no name of a file", {
  bytes <- "a\xff"
  Encoding(bytes) <- "bytes"
  expect_error(read_motion(bytes), class = "rotdyn_error_type")
})

test_that("up to a tenth of the rows may have another number of cells", {
  rows <- c("t,a,b", sprintf("%d,%d,%d", 0:59, 0:59, 0:59))
  rows[c(10, 20, 30, 40, 50)] <- "1,2"
  expect_identical(nrow(read_text(rows)$dropped), 5L)
  rows[c(15, 25)] <- "1,2"
  expect_error(read_text(rows), "another number of cells", class = "rotdyn_error_file")
})

test_that("places along two axes are both taken, in metres", {
  t <- 0:19 / 10
  lines <- c("t (s);x (cm);y (cm)", paste(t, 3 * t, 40 - 490 * t^2, sep = ";"))
  r <- read_motion(text_file(lines))
  expect_equal(r$x_m, 0.03 * t)
  expect_equal(r$y_m, 0.4 - 4.9 * t^2)
})

test_that("a cell with a point among decimal commas is no number", {
  t <- 0:40 / 2
  turned <- sprintf("%d", 40 * 0:40)
  lines <- paste(gsub(".", ",", sprintf("%.1f", t), fixed = TRUE), turned, sep = ";")
  lines[41] <- "20,0;1.600"
  r <- read_motion(text_file(c("Zeit (s);Winkel (deg)", lines)))
  expect_equal(r$theta_rad, 40 * 0:39 * pi / 180)
  info <- attr(r, "record")
  expect_equal(info$dropped$row, 41)
  expect_match(info$assumed, "1 cell is no number", all = FALSE)
  for (k in 27:41) lines[k] <- sub(";1", ";1.", lines[k], fixed = TRUE)
  error <- expect_error(
    read_motion(text_file(c("Zeit (s);Winkel (deg)", lines))), class = "rotdyn_error_file"
  )
  expect_match(conditionMessage(error), "1600 or 1.6", fixed = TRUE)
})
