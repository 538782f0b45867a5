test_that("names of files", {
  bytes <- "a\xff"
  Encoding(bytes) <- "bytes"
  for (name in list(1, "", NA_character_, c("a", "b"), NULL, bytes)) {
    expect_error(write_scene(scene_axle(1, 1), name %||% list()), class = "rotdyn_error_type")
    expect_error(metadata(file = name %||% list()), class = "rotdyn_error_type")
  }
})

test_that("what cannot be written says so, without a warning of R's own", {
  skip_if_not_installed("yyjsonr")
  for (name in c(file.path(tempfile("none"), "a"), strrep("long ", 2000))) {
    expect_error(
      expect_no_warning(write_scene(scene_axle(1, 1), name)), class = "rotdyn_error_file"
    )
    expect_error(expect_no_warning(metadata(file = name)), class = "rotdyn_error_file")
  }
  path <- tempfile()
  write_scene(scene_axle(1, 1), path)
  expect_identical(read_scene(path), scene_axle(1, 1))
})

test_that("a full disk is an error, and leaves neither a part nor a temporary file", {
  on_tiny_disk("64k", function(disk) {
    long <- scene_axle(1, torque_knots(0:20000, sin(0:20000)))
    full <- function(expr) expect_error(expr, "disk is full", class = "rotdyn_error_file")
    files <- function() list.files(disk, all.files = TRUE, no.. = TRUE)
    full(write_scene(long, file.path(disk, "a.json")))
    full(metadata(file = file.path(disk, "a.sql")))
    expect_identical(files(), character())
    # A file that was there stays as it is.
    old <- file.path(disk, "old.json")
    writeLines("old", old)
    full(write_scene(long, old))
    expect_identical(readLines(old), "old")
    said <- cli("metadata", "--sql", "sqlite", "--out", old)
    expect_identical(said$status, 3L)
    expect_match(said$err, "cannot be written: the disk is full")
    expect_identical(readLines(old), "old")
    expect_identical(files(), "old.json")
    fill_disk(disk)
    full(install_cli(disk))
    expect_identical(files(), c("fill", "old.json"))
  })
})

test_that("pictures that do not fit are an error", {
  skip_if_not_installed("gifski")
  on_tiny_disk("64k", function(disk) {
    motion <- trajectory(scene_axle(body_disk(2, 0.25), 0.8), 0:4)
    file <- file.path(disk, "film.gif")
    fill_disk(disk)
    full <- function(expr) expect_error(expr, "disk is full", class = "rotdyn_error_file")
    full(animate_motion(motion, file, frames_per_s = 5))
    expect_false(file.exists(file))
    # Nor do the frames in the temporary folder.
    frames <- file.path(disk, "frames")
    dir.create(frames)
    grDevices::png(file.path(frames, "%d.png"), 200, 200)
    plot(1:10)
    grDevices::dev.off()
    full(encoded_bytes(frames, "gif", 200, 0.1, NULL))
  })
})

test_that("devices and pipes are written where they are, and checked", {
  skip_on_os("windows")
  skip_if(!file.exists("/dev/full"), "there is no /dev/full")
  wheel <- scene_axle(1, 1)
  expect_error(write_scene(wheel, "/dev/full"), "disk is full", class = "rotdyn_error_file")
  expect_error(metadata(file = "/dev/full"), "disk is full", class = "rotdyn_error_file")
  expect_no_error(write_scene(wheel, "/dev/null"))
  expect_true(.Call(ffi_file_special, "/dev/null"))
  expect_identical(cli("roll", "--out", "/dev/full")$status, 3L)
  expect_match(cli("roll", "--out", "/dev/full")$err, "disk is full")
  link <- tempfile(fileext = ".json")
  on.exit(unlink(link))
  file.symlink("/dev/full", link)
  expect_error(write_scene(wheel, link), "disk is full", class = "rotdyn_error_file")
  expect_identical(Sys.readlink(link), "/dev/full")
  pipe <- tempfile("pipe")
  skip_if(system2("mkfifo", shQuote(pipe)) != 0L, "no pipe can be made")
  copy <- tempfile()
  system(paste("cat", shQuote(pipe), ">", shQuote(copy)), wait = FALSE)
  write_scene(wheel, pipe)
  for (i in 1:100) if (file.exists(copy) && file.size(copy) > 0) break else Sys.sleep(0.1)
  skip_if_not_installed("yyjsonr")
  expect_identical(read_scene(copy), wheel)
  expect_true(.Call(ffi_file_special, pipe))
  unlink(c(pipe, copy))
})

test_that("a file that is replaced keeps its mode, its links and its folder", {
  skip_on_os("windows")
  folder <- tempfile("kept")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  file <- file.path(folder, "a.json")
  write_scene(scene_axle(1, 1), file)
  Sys.chmod(file, "0640", FALSE)
  link <- file.path(folder, "link.json")
  file.symlink("a.json", link)
  write_scene(scene_axle(2, 1), link)
  expect_identical(format(file.mode(file)), "640")
  expect_identical(Sys.readlink(link), "a.json")
  skip_if_not_installed("yyjsonr")
  expect_identical(read_scene(file), scene_axle(2, 1))
  expect_identical(list.files(folder, all.files = TRUE, no.. = TRUE), c("a.json", "link.json"))
  expect_error(write_scene(scene_axle(1, 1), folder), "folder", class = "rotdyn_error_file")
  # Braces in a name or in words of the system are no code.
  expect_error(
    write_scene(scene_axle(1, 1), file.path(folder, "{stop(1)}", "a")), "no folder.*stop\\(1\\)",
    class = "rotdyn_error_file"
  )
  long <- file.path(folder, strrep("a", 300))
  expect_error(write_scene(scene_axle(1, 1), long), class = "rotdyn_error_file")
  expect_identical(list.files(folder, all.files = TRUE, no.. = TRUE), c("a.json", "link.json"))
})

test_that("text of a file: compressed, with a mark, with a zero byte", {
  text <- '{"scene_axle":{"body":15}}'
  file <- tempfile(fileext = ".json")
  on.exit(unlink(file))
  con <- gzfile(file, "w")
  writeLines(text, con)
  close(con)
  expect_identical(file_text(file), paste0(text, "\n"))
  writeBin(c(as.raw(c(0xef, 0xbb, 0xbf)), charToRaw(text)), file)
  expect_identical(without_mark(file_text(file)), text)
  writeBin(c(charToRaw("{1"), as.raw(0), charToRaw("5}")), file)
  expect_identical(file_text(file), NA_character_)
})

test_that("a descriptor is written by its number: standard output of another process", {
  skip_on_os("windows")
  library <- dirname(find.package("rotdyn"))
  code <- sprintf(
    paste0(
      "loadNamespace('rotdyn', '%s'); ",
      "invisible(.Call(rotdyn:::ffi_file_write, 1L, c('one', 'two')))"
    ), library
  )
  said <- system2(
    file.path(R.home("bin"), "Rscript"), c("--vanilla", "-e", shQuote(code)), stdout = TRUE
  )
  expect_identical(utils::tail(said, 2), c("one", "two"))
})
