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
    "stopifnot(identical(rolling(beta, 20), rotdyn::rolling_acceleration(beta, 20)))",
    "scene <- rotdyn::scene_axle(0.0625, NULL, rotdyn::resistance(0.03), omega0_rad_per_s = 10)",
    "motion <- rotdyn::trajectory(scene, seq(0, 4, 0.1))",
    "stopifnot(identical(coasting(0.0625, 0.03, 10, seq(0, 4, 0.1)), motion$omega_rad_per_s))",
    "cat(conditionMessage(tryCatch(coasting(0, 0.03, 10, 1), error = identity)), sep = '\n')",
    "cat('done')"
  ))
  expect_identical(said[1], paste(
    "an argument is not possible: body must be greater than 0; it is 0"
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

# ---- objects by name -----------------------------------------------------------------------------

# The object of a constructor and its arguments, as write_scene() has them: its place.
c_object <- function(constructor, arguments) {
  at <- .C("new_object", constructor, at = 0L, PACKAGE = "c_objects")$at
  for (name in names(arguments)) c_set(at, name, arguments[[name]], name)
  at
}

# Sets the input `key`, or adds an item to a list (""), of what the input `name` takes.
c_set <- function(at, key, value, name) {
  status <- if (is.null(value)) {
    .C("set_nothing", at, key, status = 0L, PACKAGE = "c_objects")$status
  } else if (is.character(value) && !value %in% c("Inf", "-Inf")) {
    .C("set_text", at, key, value, status = 0L, PACKAGE = "c_objects")$status
  } else if (!is.list(value) && is.null(dim(value))) {
    value <- as.double(value)
    .C("set_numbers", at, key, length(value), value, status = 0L, NAOK = TRUE,
       PACKAGE = "c_objects")$status
  } else {
    .C("set_object", at, key, c_value(value, name), status = 0L, PACKAGE = "c_objects")$status
  }
  expect_identical(status, 0L, label = name)
}

c_value <- function(value, name) {
  if (is.matrix(value)) value <- lapply(seq_len(nrow(value)), function(i) value[i, ])
  if (!is.null(names(value))) {
    known <- length(value) == 1L &&
      .C("is_object", names(value), answer = 0L, PACKAGE = "c_objects")$answer == 1L
    return(if (known) c_object(names(value), value[[1]]) else c_object(name, value))
  }
  list <- c_object("list", NULL)
  for (item in value) c_set(list, "", item, name)
  list
}

# The shim, loaded until the test ends.
load_objects <- function(envir = parent.frame()) {
  skip_without_compiler()
  folder <- tempfile("shim")
  dir.create(folder)
  later <- function(call) do.call(on.exit, list(call, add = TRUE, after = FALSE), envir = envir)
  later(bquote(unlink(.(folder), recursive = TRUE)))
  file.copy(test_path("c_objects.c"), folder)
  log <- suppressWarnings(system2(
    file.path(R.home("bin"), "R"), c("CMD", "SHLIB", shQuote(file.path(folder, "c_objects.c"))),
    stdout = TRUE, stderr = TRUE, env = paste0("PKG_CPPFLAGS=-I", shQuote(dirname(header)))
  ))
  if (!is.null(attr(log, "status"))) stop(paste(log, collapse = "\n"))
  library <- dyn.load(file.path(folder, paste0("c_objects", .Platform$dynlib.ext)))
  later(bquote(dyn.unload(.(library[["path"]]))))
  .C("begin", PACKAGE = "c_objects")
}

test_that("objects made by name in C compute R's bits and its error, for random scenes", {
  load_objects()
  set.seed(16)
  models <- replicate(or_long(60, 350), {
    scene <- one_of(
      random_axle, random_axle, random_pendulum, random_hanging, random_gears, random_rotors,
      random_clutch, random_drive, random_free, random_pivot
    )()
    time_s <- sort(stats::runif(sample(c(1, 7, 40), 1), scene$start_s, 6))
    accuracy <- sample(c(1e-12, 1e-9, 1e-6), 1)
    asked <- if (inherits(scene, "rot_scene_drive")) one_of(NULL, "drive_rk8pd", "drive_radau")
    motion <- suppressWarnings(trajectory(scene, time_s, accuracy, asked))
    node <- scene_node(scene, NULL)[-1]
    at <- c_object(names(node), node[[1]])
    # R adds the other shafts of a train.
    names <- setdiff(names(motion), c("time_s", "rotor"))
    # R adds those of the other shafts.
    if (inherits(scene, "rot_scene_gears")) names <- names[!grepl("_[2-9]_", names)]
    rows_per_time <- .C("check", at, rows_per_time = 0L, strrep(" ", 200),
      PACKAGE = "c_objects")$rows_per_time
    rows <- length(time_s) * rows_per_time
    from_c <- .C("run", at, length(time_s), time_s, accuracy, asked %||% "", length(names), names,
      rows, columns = double(length(names) * rows), error = 0, status = 0L,
      model = strrep(" ", 200), NAOK = TRUE, PACKAGE = "c_objects"
    )
    .C("free_all", PACKAGE = "c_objects")
    run <- run_of(motion)
    expect_identical(from_c[c("error", "status", "model")],
                     list(error = run$info$error, status = 0L, model = run$model))
    # NaN of C is NA of R: what the last rotor has not.
    expected <- as.double(unlist(unclass(motion)[names], use.names = FALSE))
    expect_identical(ifelse(is.nan(from_c$columns), NA, from_c$columns), expected)
    run$model
  })
  expect_gt(length(unique(models)), or_long(11L, 14L))
})

test_that("the audit of C is R's, number by number", {
  load_objects()
  set.seed(8)
  some <- function(maker) replicate(or_long(2, 12), maker(), simplify = FALSE)
  makers <- c(
    random_axle, random_axle, random_axle, random_pendulum, random_hanging, random_gears,
    random_rotors, random_clutch, random_drive, random_free, random_pivot
  )
  scenes <- c(unlist(lapply(makers, some), recursive = FALSE), list(
    scene_incline(body_sphere(2, 0.1), 30, static_friction = 0.1, v0_m_per_s = 2),
    scene_incline(body_disk(1, 0.2), 20, static_friction = 0.5,
      resistance = resistance(drag_n_s2_per_m2 = 0.3)),
    scene_hoop(1, 0.5, 6, theta0_rad = 0.3, resistance = resistance(drag_n_s_per_m = 0.2)),
    scene_hoop(1, 0.5, 3, theta0_rad = 1, static_friction = 0.2),
    scene_chain(c(1, 2), c(0.5, 0.4), theta0_rad = c(1, -0.5), resistance = 0.01)
  ))
  for (scene in scenes) {
    time_s <- scene$start_s + c(0.25, 1, 3)
    accuracy <- sample(c(1e-12, 1e-9, 1e-6), 1)
    want <- audit(suppressWarnings(trajectory(scene, time_s, accuracy)))
    node <- scene_node(scene, NULL)[-1]
    at <- c_object(names(node), node[[1]])
    for (k in seq_len(nrow(want))) {
      got <- .C("balance", at, 3L, time_s, accuracy, k - 1L,
        numbers = double(5), flags = integer(2), quantity = strrep(" ", 200),
        why = strrep(" ", 200), status = 0L, NAOK = TRUE, PACKAGE = "c_objects"
      )
      row <- want[k, ]
      expect_identical(got$status, 0L)
      expect_identical(
        got$numbers,
        c(row$change, row$supplied, row$dissipated, row$residual, row$rounding)
      )
      expect_identical(got$flags[1], match(row$verdict, c("unbalanced", "balanced")) - 1L)
      expect_identical(got$quantity, row$balance)
      expect_identical(got$flags[2] == 1L, row$conserved %in% TRUE)
    }
    done <- .C("balance", at, 3L, time_s, accuracy, nrow(want),
      double(5), integer(2), "", "", status = 0L, NAOK = TRUE, PACKAGE = "c_objects"
    )
    expect_identical(done$status, 11L)
    .C("free_all", PACKAGE = "c_objects")
  }
})
