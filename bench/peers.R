# The other programs: compiled into a scratch folder, run as children that time themselves.
#
# A child is called as  PROGRAM [SCRIPT] HOW FILE solve           to print theta and omega by row
#                                                                 and then its right-hand sides
# and as                PROGRAM [SCRIPT] HOW FILE time BATCHES US to print microseconds per call,
# FILE holding the output times. Numbers travel in hexadecimal, so none is rounded on the way.

scratch <- tempfile("rotdyn-bench-")
dir.create(scratch)

child <- function(command, how, times, script = NULL) {
  file <- file.path(scratch, "times.txt")
  writeLines(sprintf("%a", times), file)
  structure(list(command = command, args = c(script, how, file)), class = "child")
}

ask_child <- function(x, ...) {
  out <- suppressWarnings(system2(x$command, c(shQuote(x$args), ...), stdout = TRUE))
  if (!is.null(attr(out, "status"))) stop("a child failed: ", paste(out, collapse = "\n"))
  out
}

time_child <- function(x, batches, batch_us) {
  as.numeric(ask_child(x, "time", batches, format(batch_us, scientific = FALSE)))
}

solve_child <- function(x) {
  out <- ask_child(x, "solve")
  n <- length(out)
  rows <- matrix(scan(text = out[-n], quiet = TRUE), nrow = 2)
  list(theta_rad = rows[1, ], omega_rad_per_s = rows[2, ], rhs_calls = as.numeric(out[n]))
}

# ---- compilers and interpreters -----------------------------------------------------------------

run_quietly <- function(command, args, env = character()) {
  out <- suppressWarnings(tryCatch(
    system2(command, args, stdout = TRUE, stderr = TRUE, env = env),
    error = function(e) structure(conditionMessage(e), status = 1L)
  ))
  list(ok = is.null(attr(out, "status")), out = as.vector(out))
}

r_config <- function(name) run_quietly(file.path(R.home("bin"), "R"), c("CMD", "config", name))$out

ask_gsl <- function(pkg_config, gsl_config, otherwise) {
  for (ask in list(c("pkg-config", pkg_config, "gsl"), c("gsl-config", gsl_config))) {
    answer <- run_quietly(ask[1], ask[-1])
    if (answer$ok) return(paste(answer$out, collapse = " "))
  }
  otherwise
}

peer_warnings <- "-Wall -Wextra"

# The sources of the C core.
core_files <- function() list.files("src/core", "[.]c$", recursive = TRUE, full.names = TRUE)

# A program from bench/peers, with the compiler and the options that R compiles packages with.
compile_program <- function(name, sources = character()) {
  program <- file.path(scratch, name)
  result <- run_quietly(
    "sh",
    c("-c", shQuote(paste(
      r_config("CC"), r_config("CFLAGS"), peer_warnings, ask_gsl("--cflags", "--cflags", ""),
      "-Isrc/core", file.path("bench/peers", paste0(name, ".c")), paste(sources, collapse = " "),
      "-o", shQuote(program), ask_gsl("--libs", "--libs", "-lgsl -lgslcblas"), "-lm"
    )))
  )
  if (!result$ok) stop(name, " does not compile:\n", paste(result$out, collapse = "\n"))
  program
}

# Code that R itself loads: the clock, and deSolve's right-hand side.
load_shared <- function() {
  copied <- file.path(scratch, c("shared.c", "spin-up.h", "clock.h"))
  file.copy(file.path("bench/peers", basename(copied)), copied)
  object <- file.path(scratch, paste0("shared", .Platform$dynlib.ext))
  # R calls make; if make called us, that one must not inherit its options.
  result <- run_quietly(
    file.path(R.home("bin"), "R"),
    c("CMD", "SHLIB", "-o", shQuote(object), shQuote(copied[1])),
    env = c(paste0("PKG_CFLAGS='", peer_warnings, "'"), "MAKEFLAGS=", "MAKELEVEL=")
  )
  if (!result$ok) stop("shared.c does not compile:\n", paste(result$out, collapse = "\n"))
  dyn.load(object)
}

load_shared()
clock <- getNativeSymbolInfo("bench_clock_us", "shared")
clock_us <- function() .C(clock, us = 0)$us

# The first python3 that can import scipy, with the versions; NULL if there is none.
find_scipy <- function() {
  folders <- c(strsplit(Sys.getenv("PATH"), .Platform$path.sep)[[1]], "/usr/bin", "/usr/local/bin")
  candidates <- unique(c(Sys.getenv("PYTHON"), file.path(folders, "python3")))
  code <- "import sys, scipy.integrate; print(sys.version.split()[0], scipy.__version__)"
  for (python in candidates[file.exists(candidates)]) {
    answer <- run_quietly(python, c("-c", shQuote(code)))
    if (answer$ok) {
      versions <- strsplit(answer$out[length(answer$out)], " ")[[1]]
      return(list(command = python, python = versions[1], scipy = versions[2]))
    }
  }
  NULL
}

scipy <- find_scipy()
has_package <- function(name) requireNamespace(name, quietly = TRUE)

# What ran, in general words.
describe_machine <- function() {
  cc <- strsplit(r_config("CC"), " ")[[1]][1]
  compiler <- sub(" *\\(.*\\)", "", run_quietly(cc, "--version")$out[1])
  gsl <- paste("GSL", ask_gsl("--modversion", "--version", "of unknown version"))
  level <- regmatches(r_config("CFLAGS"), regexpr("-O[0-9sz]", r_config("CFLAGS")))
  version <- function(name) {
    paste(name, if (has_package(name)) utils::packageVersion(name) else "not there")
  }
  python <- if (is.null(scipy)) {
    "scipy not there"
  } else {
    paste0("scipy ", scipy$scipy, " (Python ", scipy$python, ")")
  }
  paste0(
    parallel::detectCores(), " cores (", R.version$arch, "), of which one is used; ",
    paste(c(
      paste(compiler, level), paste0("R ", getRversion()), version("rotdyn"), version("tibble"),
      version("dplyr"), version("deSolve"), gsl, python
    ), collapse = ", "), "."
  )
}
