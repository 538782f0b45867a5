# Does the reported error of roll_on_curve() cover the true one? Random curves
# y(x) = a + b x + c x^2 + d sin(k x + p), from rest or with a speed, judged by curves.c in
# quadruple precision: the times and lengths of all rows against the last.
#
#   Rscript bench/coverage/curves.R PROGRAM [SCENES [SEED]]
#
# Ends with status 1 where more than 5 in 100 miss, or one by more than ten times.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args) > 1L) as.integer(args[2]) else 200L
seed <- if (length(args) > 2L) as.integer(args[3]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

between <- function(lo, hi) stats::runif(1, lo, hi)
either <- function(x) x * sample(c(-1, 1), 1)

# A curve that falls from `from` on, as numbers of y(x) = a + b x + c x^2 + d sin(k x + p).
random_curve <- function() {
  repeat {
    size <- 10^between(-1, 1)
    k <- between(0.5, 6) / size
    at <- c(
      a = between(-2, 2) * size, b = between(-3, 0.5), c = between(-0.4, 0.4) / size,
      d = between(-0.3, 0.3) / k, k = k, p = between(-3, 3)
    )
    from <- if (stats::runif(1) < 0.3) 0 else between(-1, 1) * size
    rest <- stats::runif(1) < 0.6
    slope <- at[["b"]] + 2 * at[["c"]] * from + at[["d"]] * k * cos(k * from + at[["p"]])
    way <- if (rest) -sign(slope) else either(1)
    if (!rest || abs(slope) > 1e-3) break
  }
  list(
    numbers = at, from = from, to = from + way * size * 10^between(-3, 0.3),
    v0 = if (rest) 0 else sqrt(size) * 10^between(-2, 1), beta = between(0, 1),
    gravity = 10^between(-1, 2)
  )
}

curve_of <- function(numbers) {
  formula <- y ~ a + b * x + c * x^2 + d * sin(k * x + p)
  f <- function(x) NULL
  body(f) <- do.call(substitute, list(formula[[3]], as.list(numbers)))
  environment(f) <- baseenv()
  f
}

runs <- list()
while (length(runs) < scenes) {
  one <- random_curve()
  motion <- tryCatch(
    roll_on_curve(
      curve_of(one$numbers), one$from, one$to, one$beta, one$v0, rows = 9,
      gravity_m_per_s2 = one$gravity
    ), rotdyn_error_value = function(e) NULL # it bends more than the body fits
  )
  if (is.null(motion)) next
  # The last row of a motion that ends on its way has a place that is rounded.
  rows <- if (summary(motion)$event == "arrives") motion else motion[-nrow(motion), ]
  if (nrow(rows) < 2L) next
  runs[[length(runs) + 1L]] <- list(
    line = paste(sprintf("%.17g", c(
      one$numbers, one$from, one$v0, 2 * one$gravity / (1 + one$beta), nrow(rows), rows$x_m
    )), collapse = " "),
    time_s = rows$time_s, path_m = rows$path_m, error = summary(motion)$error, rest = one$v0 == 0,
    event = summary(motion)$event
  )
}

truths <- lapply(
  system2(args[1], input = vapply(runs, `[[`, "", "line"), stdout = TRUE),
  function(line) matrix(scan(text = line, quiet = TRUE), ncol = 4, byrow = TRUE)
)
share <- mapply(function(run, truth) {
  apart <- function(got, at) max(abs(got - truth[, at] - truth[, at + 1L])) / max(abs(got))
  max(apart(run$time_s, 1L), apart(run$path_m, 3L)) / run$error
}, runs, truths)
rest <- vapply(runs, `[[`, TRUE, "rest")
bad <- FALSE
for (from_rest in c(TRUE, FALSE)) {
  of <- share[rest == from_rest]
  missed <- sum(!(of <= 1))
  silent <- sum(!(of <= 10))
  cat(sprintf(
    "curves, %-12s %d scenes, covered %.1f %%, silent %d; the closest %s, seed %d\n",
    if (from_rest) "from rest" else "with a speed", length(of), 100 * mean(of <= 1), silent,
    paste(format(utils::head(sort(of, decreasing = TRUE), 4L), digits = 2), collapse = " "), seed
  ))
  bad <- bad || missed > 0.05 * length(of) || silent > 0
}
if (nzchar(Sys.getenv("COVERAGE_SHOW"))) {
  for (i in utils::head(order(-share), 5L)) cat(share[i], runs[[i]]$error, runs[[i]]$line, "\n")
}
quit(status = as.integer(bad))
