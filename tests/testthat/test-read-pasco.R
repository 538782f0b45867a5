test_that("Capstone: runs side by side, decimal commas, a mark at the start, empty cells", {
  t <- 0:29 / 20
  a <- 0.3 + 2 * t
  heads <- paste(rep(c("Time (s)", "Angle (rad)", "Angular Velocity (rad/s)"), 2), "Run",
    rep(c("#1", "#2"), each = 3))
  rows <- vapply(1:30, function(i) {
    second <- if (i <= 12) c(t[i], -a[i], -2) else c("", "", "")
    # The velocity begins later: it is a difference.
    paste(c(t[i], a[i], if (i > 1) 2 else "", second), collapse = "\t")
  }, "")
  lines <- c(paste(heads, collapse = "\t"), gsub(".", ",", rows, fixed = TRUE))
  for (r in list(
    read_motion(text_file(lines, ext = ".txt", bom = TRUE)),
    read_motion(text_file(gsub("\t", ";", lines), bom = TRUE)),
    read_pasco(text_file(lines, encoding = "UTF-16LE", bom = TRUE))
  )) {
    expect_equal(r$segment, rep(1:2, c(30, 12)))
    expect_equal(r$theta_rad, c(a, -a[1:12]))
    expect_match(attr(r, "record")$assumed, "not used", all = FALSE)
    expect_match(attr(r, "record")$source, "PASCO")
  }
  expect_equal(nrow(read_pasco(text_file(lines), run = "Run #2")), 12)
})

test_that("sensors with different rates: empty cells between", {
  t <- 0:59 / 60
  a <- ifelse(0:59 %% 3 == 0, 4 * t, NA)
  lines <- c(
    "Time (s) Run #1,Angle (deg) Run #1,Force (N) Run #1",
    gsub("NA", "", paste(t, a, 1.5, sep = ","))
  )
  r <- read_motion(text_file(lines))
  expect_equal(r$theta_rad, a[!is.na(a)] * pi / 180)
  expect_equal(nrow(attr(r, "record")$dropped), 40)
})

test_that("a heading with a control character is printed without a warning", {
  file <- text_file(c(
    "Time (s) Run\001 #1,Angle (rad) Run\001 #1", "0,1", "0.1,1.1", "0.2,1.3"
  ))
  printed <- expect_no_warning(utils::capture.output(print(read_pasco(file))))
  expect_match(printed, "Time (s) Run\\001 #1", fixed = TRUE, all = FALSE)
})

test_that("archives and workbooks are refused with what to do", {
  table <- c("Time (s),Angle (rad)", "0,1", "1,2")
  folder <- tempfile("t")
  dir.create(folder)
  old <- setwd(folder)
  on.exit(setwd(old))
  writeLines(table, "a.csv")
  utils::tar("a.tar", "a.csv", tar = "internal")
  writeBin(as.raw(c(0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1)), "a.xls")
  for (file in c(zip_file(list("a.csv" = table)), "a.tar", "a.xls")) {
    expect_error(read_pasco(file), "export the table from Capstone", class = "rotdyn_error_file")
    expect_error(read_imu(file), "no table of text", class = "rotdyn_error_file")
  }
})
