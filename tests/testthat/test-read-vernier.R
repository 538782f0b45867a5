samples <- function(n) data.frame(t = 0:(n - 1) / 20, a = 0.5 + 2 * 0:(n - 1) / 20, v = 2)

test_that("CSV of Graphical Analysis and Logger Pro: runs side by side, of unequal length", {
  one <- samples(30)
  two <- samples(20)
  two$a <- two$a + 1
  for (label in list(c("Run 1: ", "Run 2: "), c("Data Set 1:", "Data Set 2:"))) {
    heads <- paste0(
      rep(label, each = 3), c("Time (s)", "Angle (rad)", "Velocity (rad/s)")
    )
    rows <- vapply(1:30, function(i) {
      paste(c(one$t[i], one$a[i], one$v[i], if (i <= 20) c(two$t[i], two$a[i], two$v[i]) else
        c("", "", "")), collapse = ",")
    }, "")
    r <- read_motion(text_file(c(paste(heads, collapse = ","), rows)))
    expect_equal(r$segment, rep(1:2, c(30, 20)))
    expect_equal(r$theta_rad, c(one$a, two$a))
    expect_false("omega_rad_per_s" %in% names(r))
    expect_match(attr(r, "record")$source, "Vernier")
  }
  expect_equal(nrow(read_vernier(text_file(c(paste(heads, collapse = ","), rows)), run = 2)), 20)
  lines <- c("Latest: Time (s),Latest: Angle (deg)", paste(one$t, one$a, sep = ","))
  r <- read_motion(text_file(lines))
  expect_equal(r$theta_rad, one$a * pi / 180)
})

test_that("text of Logger Pro: names, short names, units on lines of their own", {
  one <- samples(30)
  lines <- c(
    "Vernier Format 2", "wheel.cmbl 5/5/2019 9:37:43 .", "Latest", "Time\tAngle", "t\tA", "s\tdeg",
    paste(one$t, one$a, sep = "\t")
  )
  r <- read_motion(text_file(lines, ext = ".txt"))
  expect_equal(r$theta_rad, one$a * pi / 180)
  expect_equal(r$time_s, one$t)
})

test_that("projects: .cmbl is XML, .gambl a tar archive with it", {
  skip_if_not_installed("xml2")
  runs <- list("Run 1" = samples(30), Latest = samples(20))
  runs[[1]]$a[5] <- NA
  lines <- sub("^NA$", "Z1 1:", vernier_xml(runs))
  lines <- gsub("\nNA\n", "\nZ1 1:\n", lines, fixed = TRUE)
  r <- read_motion(text_file(lines, ext = ".cmbl"))
  expect_equal(r$segment, rep(1:2, c(29, 20)))
  # What was left out is told first, then how the rest was divided.
  expect_match(attr(r, "record")$assumed[1], "not used: \"Velocity (rad/s)\"", fixed = TRUE)
  expect_match(attr(r, "record")$assumed, "segments are the runs Run 1, Latest$", all = FALSE)
  expect_match(tail(attr(r, "record")$assumed, 1), "^segments")
  expect_equal(r$theta_rad, c(runs[[1]]$a[-5], runs[[2]]$a))
  folder <- tempfile("g")
  dir.create(file.path(folder, "vstudm"), recursive = TRUE)
  writeLines(lines, file.path(folder, "vstudm", "data.udm"))
  writeLines("{}", file.path(folder, "vstudm", "manifest.json"))
  old <- setwd(folder)
  on.exit(setwd(old))
  utils::tar("x.gambl", "vstudm", tar = "internal")
  g <- read_motion(file.path(folder, "x.gambl"))
  expect_equal(g$theta_rad, r$theta_rad)
  expect_equal(nrow(read_vernier(file.path(folder, "x.gambl"), run = "Latest")), 20)
  expect_error(read_vernier(file.path(folder, "x.gambl"), run = "x"), class = "rotdyn_error_value")
})

test_that("fields of a tar archive may fill their places, without a byte 0 behind", {
  name <- strrep("abcde", 20)
  header <- raw(512)
  header[1:100] <- charToRaw(name)
  header[124 + 1:12] <- charToRaw("000000000013")
  data <- charToRaw("hello, disk")
  bytes <- c(header, data, raw(512 - 11), raw(1024))
  expect_identical(rotdyn:::tar_files(bytes, "x.tar", NULL), stats::setNames(list(data), name))
  # A file of no bytes, and one with the usual ends.
  header[124 + 1:12] <- charToRaw("000000000000")
  other <- raw(512)
  other[1:3] <- charToRaw("a.b")
  other[124 + 1:11] <- charToRaw("00000000013")
  bytes <- c(header, other, data, raw(512 - 11), raw(1024))
  expect_identical(
    rotdyn:::tar_files(bytes, "x.tar", NULL), stats::setNames(list(raw(), data), c(name, "a.b"))
  )
  expect_error(
    rotdyn:::tar_files(bytes[1:1030], "x.tar", NULL), "damaged", class = "rotdyn_error_file"
  )
})

test_that("a tenth of the cells of a run may be no number, not more", {
  skip_if_not_installed("xml2")
  read_with <- function(bad) {
    runs <- list(Latest = samples(40))
    runs[[1]]$a[3 * seq_len(bad)] <- NA
    lines <- gsub("\nNA\n", "\nfive\n", vernier_xml(runs), fixed = TRUE)
    lines[lines == "NA"] <- "five"
    read_motion(text_file(lines, ext = ".cmbl"))
  }
  expect_equal(sum(is.finite(read_with(4)$theta_rad)), 36)
  expect_error(read_with(5), "no number", class = "rotdyn_error_file")
})

test_that("a name of one letter ends no archive", {
  field <- function(text, n) c(charToRaw(text), raw(n - nchar(text)))
  head <- c(field("a", 100), raw(24), field("00000000003", 12), raw(376))
  entry <- c(head, charToRaw("xyz"), raw(509))
  expect_identical(tar_files(c(entry, raw(1024)), "x.tar", NULL), list(a = charToRaw("xyz")))
})

test_that("a column of a project that is shorter has no value in the last rows", {
  skip_if_not_installed("xml2")
  text <- paste(vernier_xml(list("Run 1" = samples(30))), collapse = "\n")
  short <- sub("\n3.3\n3.4\n</ColumnCells>", "\n</ColumnCells>", text, fixed = TRUE)
  expect_false(identical(short, text))
  expect_no_warning(r <- read_motion(text_file(short, ext = ".cmbl")))
  expect_equal(r$time_s, samples(28)$t)
  expect_equal(r$theta_rad, samples(28)$a)
})

test_that("a blank line among the cells of a project is a value that is missing", {
  skip_if_not_installed("xml2")
  text <- paste(vernier_xml(list("Run 1" = samples(30))), collapse = "\n")
  blank <- sub("\n3.1\n", "\n\n", text, fixed = TRUE)
  expect_false(identical(blank, text))
  r <- read_motion(text_file(blank, ext = ".cmbl"))
  kept <- is.finite(r$theta_rad)
  expect_equal(sum(kept), 29)
  expect_equal(r$theta_rad[kept], samples(30)$a[-27])
  expect_equal(r$time_s[kept], samples(30)$t[-27])
})
