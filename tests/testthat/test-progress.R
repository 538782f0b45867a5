test_that("a fraction from which no time can be estimated does not end a run", {
  old <- options(cli.progress_show_after = 0, cli.dynamic = FALSE)
  on.exit(options(old))
  run <- function(fractions) {
    progress <- rotdyn:::progress_bar("testing")
    environment(progress)$start <- proc.time()[[3]] - 10
    for (fraction in fractions) progress(fraction)
    TRUE
  }
  expect_true(suppressMessages(run(c(0, 1e-300, 1e-20, NaN, Inf, -1, 1))))
  # A second phase after the first is complete.
  expect_true(suppressMessages(run(c(0.5, 1, 0.2, 1))))
})

test_that("a display that fails is given up", {
  progress <- rotdyn:::progress_bar("testing")
  state <- environment(progress)
  state$start <- proc.time()[[3]] - 10
  state$bar <- "no such bar"
  expect_silent(for (fraction in c(0.1, 0.2)) progress(fraction))
  expect_true(state$failed)
})

test_that("a page that is rendered has no bar", {
  old <- options(cli.progress_show_after = 0, knitr.in.progress = TRUE)
  on.exit(options(old))
  progress <- rotdyn:::progress_bar("testing")
  environment(progress)$start <- proc.time()[[3]] - 10
  expect_no_message(for (fraction in c(0.1, 0.2)) progress(fraction))
  expect_null(environment(progress)$bar)
})
