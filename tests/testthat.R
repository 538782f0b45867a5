# Runs the tests: in R CMD check, and from the scripts in tools/. The closing line is
# `testthat: N passed, N failed, N skipped`, counted in test_that() blocks; a file that is skipped
# as a whole counts once. testthat is a suggestion: without it there is nothing to run.
if (requireNamespace("testthat", quietly = TRUE)) {
  library(testthat)
  library(rotdyn)
  blocks <- as.data.frame(test_check("rotdyn", stop_on_failure = FALSE))
  failed <- blocks$failed > 0 | blocks$error
  skipped <- !failed & blocks$skipped & blocks$passed == 0
  files <- setdiff(list.files("testthat", "^test.*[.]R$"), blocks$file)
  # For tools/check-times.R. Of files that run at the same time testthat has no processor time.
  if (Sys.getenv("TESTTHAT_PARALLEL") != "true") {
    time <- sort(tapply(blocks$user + blocks$system, blocks$file, sum), decreasing = TRUE)
    time <- utils::head(time, 12)
    cat(sprintf("processor time: %6.1f s  %s\n", time, names(time)), sep = "")
  }
  cat(sprintf(
    "testthat: %d passed, %d failed, %d skipped\n",
    sum(!failed & !skipped), sum(failed), sum(skipped) + length(files)
  ))
  quit(status = any(failed))
}
