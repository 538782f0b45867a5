# Rscript tools/run-testthat.R FOLDER: runs the tests in FOLDER against the installed package and
# closes with `testthat: N passed, N failed, N skipped`, counted one expectation at a time.

folder <- commandArgs(trailingOnly = TRUE)[1L]

results <- testthat::test_dir(
  folder,
  package = "rotdyn", load_package = "installed", reporter = "check",
  stop_on_failure = FALSE, stop_on_warning = FALSE
)

outcomes <- unlist(lapply(results, `[[`, "results"), recursive = FALSE)
count <- function(...) {
  sum(vapply(outcomes, inherits, logical(1L), what = paste0("expectation_", c(...))))
}
if (count("warning")) cat("testthat:", count("warning"), "warnings\n")
failed <- count("failure", "error")
# Nothing run is no success.
if (!length(outcomes)) failed <- 1L
cat(sprintf(
  "testthat: %d passed, %d failed, %d skipped\n", count("success"), failed, count("skip")
))
quit(status = failed > 0L)
