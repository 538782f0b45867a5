# The processor time of `expr` in units of a fixed piece of work (20 to 50 ms on one machine),
# measured before it and after it, so that a slow or busy machine slows both; the best of three
# attempts is to be `limit` units or fewer. Gives the value of `expr`.
expect_soon <- function(expr, limit) {
  quo <- rlang::enquo(expr)
  value <- NULL
  processor_s <- function(run) {
    start <- proc.time()
    run()
    sum((proc.time() - start)[1:2])
  }
  x <- as.double(1:1e4)
  piece <- function() vapply(1:1000, function(i) sum(sqrt(x)), 0)
  for (attempt in 1:3) {
    gc()
    before <- processor_s(piece)
    took <- processor_s(function() value <<- rlang::eval_tidy(quo))
    units <- took / max(before, processor_s(piece), 1e-3)
    if (units <= limit) break
  }
  testthat::expect_lte(units, limit)
  invisible(value)
}
