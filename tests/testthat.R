# Runs the tests: in R CMD check, and from the scripts in tools/. All of them where NOT_CRAN is
# "true", else those of quick.txt. The closing line is
# `testthat: N passed, N failed, N skipped`, counted in test_that() blocks; a file that is skipped
# as a whole counts once. testthat is a suggestion: without it there is nothing to run.
if (requireNamespace("testthat", quietly = TRUE)) {
  library(testthat)
  library(rotdyn)
  some <- if (Sys.getenv("NOT_CRAN") != "true") {
    quick <- scan("quick.txt", "", comment.char = "#", quiet = TRUE)
    paste0("^(", paste(quick, collapse = "|"), ")$")
  }
  blocks <- as.data.frame(test_check("rotdyn", filter = some, stop_on_failure = FALSE))
  failed <- blocks$failed > 0 | blocks$error
  skipped <- !failed & blocks$skipped & blocks$passed == 0
  files <- sub("^test-(.*)[.]R$", "\\1", list.files("testthat", "^test.*[.]R$"))
  if (!is.null(some)) files <- grep(some, files, value = TRUE)
  files <- setdiff(sprintf("test-%s.R", files), blocks$file)
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
