# The script that writes src/Makevars, in copies of the sources.
skip_on_cran()
skip_on_os("windows")
root <- Sys.getenv("ROTDYN_ROOT")
skip_if(!file.exists(file.path(root, "configure")), "the sources are not here")

# What configure says and writes: list(status, said, makevars). `cflags`: those of R's own Makevars;
# `set`: environment variables, "NAME=value".
configured <- function(cflags = NULL, set = character()) {
  dir <- tempfile("configure")
  dir.create(file.path(dir, "src", "core"), recursive = TRUE)
  on.exit(unlink(dir, recursive = TRUE))
  file.copy(file.path(root, "configure"), dir)
  file.copy(file.path(root, "src", "Makevars.in"), file.path(dir, "src"))
  file.copy(file.path(root, "src", "core", "ground"), file.path(dir, "src", "core"),
            recursive = TRUE)
  own <- file.path(dir, "own")
  writeLines(if (length(cflags)) paste("CFLAGS =", cflags) else character(), own)
  command <- paste(
    "cd", shQuote(dir), "&& env", paste(shQuote(c(paste0("R_MAKEVARS_USER=", own), set)),
      collapse = " "), "sh ./configure 2>&1"
  )
  said <- suppressWarnings(system2("sh", c("-c", shQuote(command)), stdout = TRUE))
  made <- file.path(dir, "src", "Makevars")
  list(
    status = attr(said, "status") %||% 0L, said = paste(said, collapse = "\n"),
    makevars = if (file.exists(made)) paste(readLines(made), collapse = "\n")
  )
}
`%||%` <- function(x, y) if (is.null(x)) y else x

test_that("GSL is found, and nothing of the template stays", {
  found <- configured("-O2")
  expect_identical(found$status, 0L)
  expect_match(found$said, "configure: GSL by ")
  expect_match(found$makevars, "-lgsl")
  expect_no_match(found$makevars, "@[A-Z_]+@")
  if (grepl("gcc|clang", system2(file.path(R.home("bin"), "R"), c("CMD", "config", "CC"), TRUE))) {
    expect_match(found$makevars, "PKG_CFLAGS = .*-ffp-contract=off")
    expect_no_match(found$makevars, "slp-vectorize")
  }
})

test_that("the vectorizer makes no fused operations where CFLAGS have them", {
  skip_if(!grepl("x86_64|x86-64", R.version$arch), "another processor")
  cc <- system2(file.path(R.home("bin"), "R"), c("CMD", "config", "CC"), TRUE)
  macros <- system2("sh", c("-c", shQuote(paste("echo |", cc, "-dM -E -"))), stdout = TRUE)
  skip_if(any(grepl("__clang__", macros)) || !any(grepl("__GNUC__", macros)), "another compiler")
  expect_match(configured("-O2 -mfma")$makevars, "-ffp-contract=off -fno-tree-slp-vectorize")
})

test_that("a GSL that is not there is named, with what was tried", {
  none <- configured(set = c(
    "GSL_LIBS=-lno_such_gsl", "PKG_CONFIG=no-pkg-config", "GSL_CONFIG=no-gsl-config"
  ))
  # The bare libraries are taken where the compiler finds them.
  expect_match(none$said, "the GSL asked for by GSL_CFLAGS/GSL_LIBS, .* is not used")
  if (none$status != 0L) {
    expect_match(none$said, "no-pkg-config is absent")
    expect_match(none$said, "apt-get install libgsl-dev")
    expect_null(none$makevars)
  } else {
    expect_match(none$said, "GSL by -lgsl -lgslcblas -lm")
  }
})
