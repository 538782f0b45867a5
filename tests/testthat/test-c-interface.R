# A package that calls the core through inst/include/rotdyn.h: built here as its author would build
# it, with the installed header and with headers of other versions.

header <- system.file("include", "rotdyn.h", package = "rotdyn")
source_of_client <- system.file("examples", "linkingto", package = "rotdyn")

# Builds the example with the header changed by `edit`, and runs code with it in another session.
client_says <- function(code, edit = identity) {
  folder <- tempfile("client")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  file.copy(source_of_client, folder, recursive = TRUE)
  client <- file.path(folder, "linkingto")
  writeLines(edit(readLines(header)), file.path(client, "src", "rotdyn.h"))
  writeLines("PKG_CPPFLAGS = -I.", file.path(client, "src", "Makevars"))
  R <- file.path(R.home("bin"), "R")
  env <- paste0("R_LIBS=", paste(c(folder, .libPaths()), collapse = .Platform$path.sep))
  log <- suppressWarnings(system2(R, c(
    "CMD", "INSTALL", "--no-docs", "--no-test-load", paste0("--library=", folder), client
  ), stdout = TRUE, stderr = TRUE, env = env))
  if (!is.null(attr(log, "status"))) stop(paste(log, collapse = "\n"))
  script <- file.path(folder, "script.R")
  writeLines(c("library(rotdynclient)", code), script)
  suppressWarnings(system2(
    R, c("--vanilla", "--no-echo", "-f", script), stdout = TRUE, stderr = TRUE, env = env
  ))
}

skip_without_compiler <- function() {
  skip_on_cran()
  skip_if(Sys.which("make") == "", "there is no make")
  skip_if(Sys.which("gcc") == "" && Sys.which("cc") == "", "there is no C compiler")
}

test_that("the header and the package have one version", {
  defined <- function(name) {
    line <- grep(paste0("^#define ", name, " "), readLines(header), value = TRUE)
    gsub(paste0("^#define ", name, "|/\\*.*|[ \"]"), "", line)
  }
  expect_identical(defined("ROTDYN_VERSION"), as.character(utils::packageVersion("rotdyn")))
  expect_identical(defined("ROTDYN_API_MAJOR"), "1")
})

test_that("a client package computes the bits that R computes", {
  skip_without_compiler()
  said <- client_says(c(
    "stopifnot(identical(c_interface(), c(1L, 0L)))",
    "beta <- c(1, 0.5, 0.4, 2/3, 0)",
    "stopifnot(identical(rolling(beta, 20), rotdyn::rolling_acceleration(beta)))",
    "scene <- rotdyn::scene_axle(0.0625, NULL, rotdyn::resistance(0.03), omega0_rad_per_s = 10)",
    "motion <- rotdyn::trajectory(scene, seq(0, 4, 0.1))",
    "stopifnot(identical(coasting(0.0625, 0.03, 10, seq(0, 4, 0.1)), motion$omega_rad_per_s))",
    "cat(conditionMessage(tryCatch(coasting(0, 0.03, 10, 1), error = identity)), sep = '\n')",
    "cat('done')"
  ))
  expect_identical(said[1], paste(
    "an argument is not possible: `inertia_kg_m2` must be greater than 0 and finite"
  ))
  expect_identical(said[2], "done")
})

test_that("a client of another major version says so", {
  skip_without_compiler()
  said <- client_says(
    "cat(conditionMessage(tryCatch(rolling(1, 20), error = identity)))",
    function(lines) sub("define ROTDYN_API_MAJOR 1", "define ROTDYN_API_MAJOR 2", lines)
  )
  expect_match(said, "built for version 2 of rotdyn's C interface", fixed = TRUE, all = FALSE)
})

test_that("a client of a newer header names the function that is missing", {
  skip_without_compiler()
  said <- client_says(
    "cat(conditionMessage(tryCatch(rolling(1, 20), error = identity)), sep = '\n')
     cat(coasting(2, 0, 10, 1))",
    function(lines) {
      # A newer version appends a function; here it is the one that the client calls.
      at <- grep("X(double, rolling_acceleration", lines, fixed = TRUE)
      end <- grep("rotdyn_sweep_out *out, rotdyn_info *info))", lines, fixed = TRUE)
      filler <- sub("rolling_acceleration", "something_else      ", lines[at])
      call <- sub("\\\\$", "", lines[at])
      c(lines[seq_len(at - 1)], filler, lines[(at + 1):(end - 1)],
        paste(lines[end], "\\"), call, lines[-seq_len(end)])
    }
  )
  expect_match(said[1], "^rotdyn [0-9.]+ lacks rolling_acceleration\\(\\): install a newer rotdyn$")
  expect_identical(said[2], "10")
})
