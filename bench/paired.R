# Paired timing. The contenders of a case take turns, round after round, and a ratio is taken within
# its round: what slows the machine for a while slows both sides of it.
#
# A turn is some batches of calls. The first batch warms up and is thrown away; the turn counts as
# the fastest of the others. A contender that is another program (peers.R) takes its turn as a child
# process, which does the same with a clock of its own and prints the result.

contender <- function(name, run, error = NA_real_, pointwise = NA_real_, rhs_calls = NA_real_) {
  list(name = name, run = run, error = error, pointwise = pointwise, rhs_calls = rhs_calls)
}

# Calls that fill a batch.
calls_per_batch <- function(run, batch_us) {
  run()
  run() # R compiles a closure at its second call
  calls <- 1
  repeat {
    us <- time_batch(run, calls)
    if (us * calls >= batch_us / 4) {
      return(max(1, ceiling(batch_us / us)))
    }
    calls <- calls * 4
  }
}

# Microseconds per call.
time_batch <- function(run, calls) {
  from <- clock_us()
  for (i in seq_len(calls)) run()
  (clock_us() - from) / calls
}

take_turn <- function(run, calls, batches, collect) {
  us <- vapply(seq_len(batches), function(b) {
    if (collect || b == 1) gc(FALSE)
    time_batch(run, calls)
  }, double(1))
  min(us[-1])
}

# One row for each contender. The first is the base of the ratios: it takes a turn beside each turn
# of every other, before it in one round and after it in the next, and the two make one ratio.
# `collect`: the garbage is collected before each batch and not just before each turn, for results
# of hundreds of megabytes.
paired <- function(comparison, case, contenders, rounds, batches = 4, batch_us = 1e4,
                   collect = FALSE) {
  turn <- lapply(contenders, function(x) {
    if (inherits(x$run, "child")) {
      return(function() time_child(x$run, batches, batch_us))
    }
    calls <- calls_per_batch(x$run, batch_us)
    function() take_turn(x$run, calls, batches, collect)
  })
  others <- seq_along(turn)[-1]
  us <- base_us <- matrix(NA_real_, rounds, length(turn))
  for (round in seq_len(rounds)) {
    if (!length(others)) base_us[round, 1] <- turn[[1]]()
    for (i in if (round %% 2) others else rev(others)) {
      if (round %% 2) base_us[round, i] <- turn[[1]]()
      us[round, i] <- turn[[i]]()
      if (round %% 2 == 0) base_us[round, i] <- turn[[1]]()
    }
  }
  ratio <- us / base_us
  ratio[, 1] <- 1
  us <- c(list(base_us), lapply(others, function(i) us[, i]))
  quartile <- function(x, p) vapply(x, stats::quantile, double(1), p, na.rm = TRUE, names = FALSE)
  field <- function(name) vapply(contenders, function(x) as.double(x[[name]]), double(1))
  message(
    "  ", case, ": ", round(quartile(us[1], 0.5)), " us",
    if (length(others)) paste0("; ", rounds, " rounds against ", length(others))
  )
  data.frame(
    comparison = comparison,
    case = case,
    contender = vapply(contenders, function(x) x$name, character(1)),
    median_us = quartile(us, 0.5),
    q1_us = quartile(us, 0.25),
    q3_us = quartile(us, 0.75),
    error = field("error"),
    error_pointwise = field("pointwise"),
    ratio_median = apply(ratio, 2, stats::median),
    ratio_q1 = apply(ratio, 2, stats::quantile, 0.25, names = FALSE),
    ratio_q3 = apply(ratio, 2, stats::quantile, 0.75, names = FALSE),
    rhs_calls = field("rhs_calls")
  )
}
