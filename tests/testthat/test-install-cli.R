test_that("install_cli() writes a command that runs with these libraries", {
  folder <- file.path(tempfile("bin"), "with a blank")
  on.exit(unlink(dirname(folder), recursive = TRUE))
  path <- install_cli(folder)
  expect_identical(basename(path), if (.Platform$OS.type == "windows") "rotdyn.cmd" else "rotdyn")
  expect_true(file.access(path, 1) == 0)
  expect_invisible(install_cli(folder)) # again, over its own
  skip_on_cran()
  skip_on_os("windows")
  said <- suppressWarnings(system2(path, c("roll", "--beta", "0.4"), TRUE, TRUE, env = "R_TESTS="))
  expect_identical(said, cli("roll", "--beta", "0.4")$out)
  said <- suppressWarnings(system2(path, "rol", TRUE, TRUE, env = "R_TESTS="))
  expect_identical(attr(said, "status"), 2L)
})

test_that("install_cli() replaces no other file", {
  folder <- tempfile("bin")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  path <- file.path(folder, if (.Platform$OS.type == "windows") "rotdyn.cmd" else "rotdyn")
  writeLines("something else", path)
  expect_error(install_cli(folder), "another file", class = "rotdyn_error_file")
  expect_identical(readLines(path), "something else")
  expect_no_error(install_cli(folder, overwrite = TRUE))
  expect_error(install_cli(path), class = "rotdyn_error_file") # a folder below a file
  expect_error(install_cli(1), class = "rotdyn_error_type")
  expect_error(install_cli(), "dir") # no folder of the user's is chosen
  bytes <- "a\xff"
  Encoding(bytes) <- "bytes"
  expect_error(install_cli(bytes), "encoding", class = "rotdyn_error_type")
  # A folder has the name of the command.
  taken <- tempfile("bin")
  dir.create(file.path(taken, basename(path)), recursive = TRUE)
  expect_error(install_cli(taken), class = "rotdyn_error_file")
  expect_error(install_cli(taken, overwrite = TRUE), "folder", class = "rotdyn_error_file")
  expect_error(install_cli(folder, overwrite = NA), class = "rotdyn_error_type")
  expect_error(install_cli(folder, TRUE), class = "rotdyn_error_argument")
})

test_that("the launcher of the package and the written one start R alike", {
  shipped <- readLines(system.file("exec", "rotdyn", package = "rotdyn"))
  for (part in c(rotdyn:::cli_call, rotdyn:::cli_closed, "--no-site-file --no-init-file")) {
    expect_true(any(grepl(part, shipped, fixed = TRUE)))
    expect_true(any(grepl(part, rotdyn:::cli_launcher(FALSE), fixed = TRUE)))
  }
  expect_true(any(grepl("--args %*", rotdyn:::cli_launcher(TRUE), fixed = TRUE)))
})
