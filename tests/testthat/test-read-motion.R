test_that("every measured file gives its numbers, or says why not", {
  file <- function(name) shared("data", "measured", name)
  table <- function(name, ...) utils::read.csv(file(name), check.names = FALSE, ...)
  deg <- pi / 180
  got <- read_motion(file("ngimu_wheelchair_coastdown_right.csv"), axis = "y")
  want <- table("ngimu_wheelchair_coastdown_right.csv")
  expect_identical(got$time_s, want[[1]])
  expect_identical(got$omega_rad_per_s, want[[3]] * deg)
  got <- read_motion(file("xio_imu_first_2000_rows.csv"), axis = "z")
  expect_identical(got$omega_rad_per_s, table("xio_imu_first_2000_rows.csv")[[4]] * deg)
  got <- read_motion(file("phyphox_roller_spin_and_precession_z_cir.csv"), axis = "z")
  expect_identical(
    got$omega_rad_per_s, table("phyphox_roller_spin_and_precession_z_cir.csv")[[4]]
  )
  for (name in c("pend00-run02.csv", "pend00-run05.csv")) {
    got <- read_motion(file(name))
    expect_identical(got$theta_rad, table(name)[[2]])
    expect_equal(2 * pi / attr(got, "record")$resolution[["theta_rad"]], 2400, tolerance = 1e-6)
  }
  for (name in c("bicycle_wheel_torsional_gyro.csv", "bicycle_wheel_compound_pendulum_gyro.csv")) {
    got <- read_motion(file(name))
    expect_identical(got$omega_rad_per_s, table(name)[[2]])
    expect_match(attr(got, "record")$assumed, "rad/s", all = FALSE)
  }
  name <- "phy180_trial1_rawdata.txt"
  expect_error(read_motion(file(name)), class = "rotdyn_error_file")
  got <- read_motion(file(name), headings = c("time_s", "theta_rad"))
  expect_identical(got$theta_rad, utils::read.table(file(name))[[2]])
  # Tables that are no motion.
  others <- c(
    "bicycle_Gyro_measured.txt", "unipi_pendulum_hand_timed_odd.csv",
    grep("^catania", list.files(dirname(file(name))), value = TRUE)
  )
  for (name in others) expect_error(read_motion(file(name)), class = "rotdyn_error_file")
})

test_that("files that are missing, empty, folders, or of another format", {
  expect_error(read_motion(tempfile()), class = "rotdyn_error_file")
  expect_error(read_motion(tempdir()), class = "rotdyn_error_file")
  expect_error(read_motion(3), class = "rotdyn_error_type")
  expect_error(read_motion(), class = "rotdyn_error_missing")
  for (bytes in list(raw(), as.raw(1:100), as.raw(c(0x50, 0x4b, 3, 4, 1, 2)),
    charToRaw("<?xml version='1.0'?><a>"), charToRaw("hello"),
    charToRaw("a {b} c\n{stop('x')},1\n"))) {
    file <- tempfile()
    writeBin(bytes, file)
    expect_error(read_motion(file), class = "rotdyn_error_file")
  }
  file <- text_file(phyphox_lines(spin_samples()))
  expect_error(read_motion(file, run = 3), class = "rotdyn_error_argument")
  expect_error(read_phyphox(file, axes = 3), class = "rotdyn_error_argument")
  skip_if_not_installed("readxl")
  writeBin(as.raw(c(0xd0, 0xcf, 0x11, 0xe0, 1)), file)
  expect_error(read_motion(file), class = "rotdyn_error_file")
})

test_that("a heading that is code is text", {
  file <- text_file(c("time {stop('no')} (x),b", "1,2", "2,3"))
  expect_error(read_motion(file), "stop", class = "rotdyn_error_file")
})

# Cut, other separators, missing cells, bytes changed, other encodings.
mutate_bytes <- function(bytes) {
  n <- length(bytes)
  at <- function(k = 1) sample.int(n, k, replace = TRUE)
  switch(sample.int(8, 1),
    bytes[seq_len(at())],
    bytes[-seq_len(min(at(), n - 1))],
    replace(bytes, at(sample.int(20, 1)), as.raw(sample.int(256, 1) - 1)),
    {
      from <- charToRaw(sample(c(",", ";", "\t", ".", "\n", "\"", " ", ":"), 1))
      to <- charToRaw(sample(c(",", ";", "\t", ".", "\n", "\"", " ", "x"), 1))
      hit <- which(bytes == from)
      if (sample.int(2, 1) == 1) hit <- hit[stats::runif(length(hit)) < 0.1]
      replace(bytes, hit, to)
    },
    {
      # Some cells lost.
      digit <- which(bytes >= as.raw(48) & bytes <= as.raw(57))
      if (length(digit)) bytes[-sample(digit, max(1, length(digit) %/% 30))] else bytes
    },
    c(bytes[seq_len(n %/% 2)], bytes),
    as.raw(rbind(as.integer(bytes), 0L)),
    {
      k <- sort(at(2))
      bytes[-(k[1]:k[2])]
    }
  )
}

test_that("damaged files give a record or an error of the package", {
  set.seed(15)
  files <- dialect_files()
  rounds <- as.integer(Sys.getenv("ROTDYN_MUTATED_FILES", or_long(100, 300)))
  bad <- character()
  out <- tempfile()
  for (k in seq_len(rounds)) {
    source <- files[[(k - 1) %% length(files) + 1]]
    bytes <- readBin(source, "raw", 1e6)
    for (again in seq_len(sample.int(3, 1))) if (length(bytes) > 2) bytes <- mutate_bytes(bytes)
    target <- file.path(dirname(out), basename(source))
    writeBin(bytes, target)
    result <- tryCatch(suppressWarnings(read_motion(target)), error = identity)
    fine <- inherits(result, "rotdyn_error") || (
      inherits(result, "rot_record") && !anyNA(result$time_s) &&
        all(is.finite(unlist(attr(result, "record")$spacing_s)))
    )
    if (!fine) {
      kept <- file.path(Sys.getenv("ROTDYN_KEEP", tempdir()), paste0("bad-", k))
      file.copy(target, kept)
      bad <- c(bad, paste(kept, paste(conditionMessage(result), collapse = " ")))
    }
  }
  expect_equal(bad, character())
})

test_that("no damage of single cells shifts a column", {
  set.seed(5)
  d <- spin_samples(100)
  lines <- phyphox_lines(d)
  whole <- read_motion(text_file(lines), axis = "z")
  for (round in 1:40) {
    bad <- lines
    for (row in sample(2:101, 4)) {
      commas <- gregexpr(",", bad[row], fixed = TRUE)[[1]]
      at <- sample(commas, 1)
      bad[row] <- switch(sample(4, 1),
        paste0(substr(bad[row], 1, at - 1), substring(bad[row], at + 1)),
        paste0(substr(bad[row], 1, at), ",", substring(bad[row], at + 1)),
        sub("[^,]+,", "", bad[row]),
        sub(",[^,]+", ",", bad[row])
      )
    }
    got <- read_motion(text_file(bad), axis = "z")
    digits <- function(x) format(x, digits = 15)
    pairs <- function(x) paste(digits(x$time_s), digits(x$omega_rad_per_s))
    seen <- is.finite(got$omega_rad_per_s)
    expect_true(all(pairs(got[seen, ]) %in% pairs(whole)))
    expect_gte(nrow(got) + nrow(attr(got, "record")$dropped), 100)
  }
})

test_that("a part of a zip that does not fit on the disk is not called damaged", {
  lines <- c("\"Time (s)\",\"Gyroscope z (rad/s)\"", paste0(0:20 / 100, ",", 1:21))
  zip <- zip_file(list("Gyroscope.csv" = lines))
  expect_equal(nrow(read_motion(zip, axis = "z")), 21L)
  unpack <- unzip_one
  cut <- function(...) {
    out <- unpack(...)
    writeBin(charToRaw("\"Time"), out) # as a full disk leaves it
    out
  }
  whole <- put_file
  replace <- function(name, f) utils::assignInNamespace(name, f, "rotdyn")
  on.exit({
    replace("unzip_one", unpack)
    replace("put_file", whole)
  })
  replace("unzip_one", cut)
  expect_error(read_motion(zip, axis = "z"), "is damaged", class = "rotdyn_error_file")
  replace("put_file", function(...) "The disk is full.")
  expect_error(read_motion(zip, axis = "z"), "disk is full.*TMPDIR", class = "rotdyn_error_file")
})

test_that("the first line of a table says whose it is", {
  format <- function(lines) {
    rotdyn:::motion_format(charToRaw(paste0(lines, collapse = "\n")), "a.csv", NULL)
  }
  phyphox <- '"Time (s)","Gyroscope x (rad/s)","Gyroscope y (rad/s)"'
  expect_identical(format(c(phyphox, "0,1,2", "1,2,3")), "phyphox")
  expect_identical(format(c("0,1,2", phyphox, "1,2,3")), "imu")
  expect_identical(format(c("", "mass A,,", "t,x,y", "0,1,2")), "tracker")
})
