# testthat is a suggestion: without it there is nothing to run.
if (requireNamespace("testthat", quietly = TRUE)) {
  library(testthat)
  library(rotdyn)
  test_check("rotdyn")
}
