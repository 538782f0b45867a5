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
      list <- grep("define ROTDYN_FUNCTIONS", lines, fixed = TRUE)
      end <- list - 1L + which(!endsWith(lines[-seq_len(list - 1L)], "\\"))[1]
      filler <- sub("rolling_acceleration", "something_else      ", lines[at])
      call <- sub("\\\\$", "", lines[at])
      c(lines[seq_len(at - 1)], filler, lines[(at + 1):(end - 1)],
        paste(lines[end], "\\"), call, lines[-seq_len(end)])
    }
  )
  expect_match(said[1], "^rotdyn [0-9.]+ lacks rolling_acceleration\\(\\): install a newer rotdyn$")
  expect_identical(said[2], "10")
})

# Scenes of one to three laws, resistance of every kind, a changing inertia in some.
random_axle <- function() {
  one <- function(...) list(...)[[sample.int(...length(), 1L)]]
  laws <- list(
    torque_constant(stats::rnorm(1)), torque_knots(sort(stats::runif(4, 0, 8)), stats::rnorm(4)),
    torque_sinusoid(stats::rnorm(1), stats::runif(1, 0.1, 5)),
    torque_exponential(stats::rnorm(1), stats::runif(1, 0.1, 2)),
    torque_spring(stats::runif(1, 0.1, 9)), torque_motor(stats::runif(1, 0.5, 2), 10),
    torque_gravity(stats::runif(1, 0.1, 2), stats::runif(1, 0.1, 1)),
    torque_curve(c(-10, 0, 3, 10), c(1, 1, 0.5, -1))
  )
  law <- Reduce(`+`, laws[sample.int(8L, sample(0:2, 1))])
  drag <- resistance(
    one(0, stats::runif(1)), one(0, 0, stats::runif(1), 1e-12), one(0, 0, stats::runif(1))
  )
  body <- if (stats::runif(1) < 0.15) {
    inertia_knots(c(0, 2, 5), stats::runif(3, 0.5, 2))
  } else {
    10^stats::runif(1, -2, 2)
  }
  scene_axle(body, law, drag, one(0, stats::rnorm(1)), one(0, 3), start_s = one(0, 1))
}

test_that("C chooses R's model and computes R's bits and its error, for random axles", {
  skip_without_compiler()
  folder <- tempfile("shim")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  file.copy(test_path("axle_rows.c"), folder)
  log <- suppressWarnings(system2(
    file.path(R.home("bin"), "R"), c("CMD", "SHLIB", shQuote(file.path(folder, "axle_rows.c"))),
    stdout = TRUE, stderr = TRUE, env = paste0("PKG_CPPFLAGS=-I", shQuote(dirname(header)))
  ))
  if (!is.null(attr(log, "status"))) stop(paste(log, collapse = "\n"))
  library <- dyn.load(file.path(folder, paste0("axle_rows", .Platform$dynlib.ext)))
  on.exit(dyn.unload(library[["path"]]), add = TRUE, after = FALSE)
  .C("begin", PACKAGE = "axle_rows")
  set.seed(16)
  models <- replicate(150, {
    scene <- random_axle()
    time_s <- sort(stats::runif(sample(c(1, 7, 40), 1), scene$start_s, 9))
    accuracy <- sample(c(1e-12, 1e-9, 1e-6), 1)
    motion <- suppressWarnings(trajectory(scene, time_s, accuracy))
    loads <- scene$loads
    of_terms <- function(name, empty) c(unlist(lapply(loads$terms, `[[`, name)), empty)
    from_c <- .C("axle_rows",
      as.double(c(
        unlist(scene[c("moment_of_inertia_kg_m2", "start_s", "theta0_rad", "omega0_rad_per_s")]),
        unlist(scene$resistance), loads$motor_n_m_s, loads$knots$outside, accuracy
      )),
      length(loads$knots$time_s), c(loads$knots$time_s, 0), c(loads$knots$torque_n_m, 0),
      length(loads$terms), of_terms("kind", ""),
      as.integer(c(vapply(loads$terms, function(term) length(term$x), 1L), 0L)),
      of_terms("x", 0), of_terms("from_s", 0), of_terms("to_s", 0),
      length(scene$inertia$time_s), c(scene$inertia$time_s, 0),
      c(scene$inertia$moment_of_inertia_kg_m2, 0), length(time_s), time_s,
      columns = double(7 * length(time_s)), error = 0, status = 0L, model = strrep(" ", 100),
      NAOK = TRUE, PACKAGE = "axle_rows"
    )
    run <- run_of(motion)
    expect_identical(from_c[c("status", "model", "error")],
                     list(status = 0L, model = run$model, error = run$info$error))
    expect_identical(from_c$columns, unlist(motion[2:8], use.names = FALSE))
    run$model
  })
  expect_gt(length(unique(models)), 5L)
})
