# Does the reported error of roll_on_curve() cover the true one? Random curves
# y(x) = a + b x + c x^2 + d sin(k x + p) + h exp(-((x - m)/w)^2), from rest or with a speed, judged
# by curves.c in quadruple precision: the times and lengths of all rows against the last, and how
# and where the motion ends.
#
#   Rscript bench/coverage/curves.R PROGRAM [SCENES [SEED]]
#
# Half of the scenes have no bump. A quarter has a bump or dip with w from 1/1000 of the span, the
# width that is looked for by default, to 1/20: some reflect the body, from some it leaves the
# track. A quarter has one from 1/10000 to 1/1000, with `finest` = 1/10000. Ends with status 1 where
# more than 5 in 100 miss, or one by more than ten times; a wrong event is such a miss.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args) > 1L) as.integer(args[2]) else 200L
seed <- if (length(args) > 2L) as.integer(args[3]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

between <- function(lo, hi) stats::runif(1, lo, hi)
either <- function(x) x * sample(c(-1, 1), 1)

# By widths as parts of the span, and what is looked for.
classes <- list(
  "from rest" = list(), "with a speed" = list(),
  "narrow from 1/1000" = list(low = -3, high = -1.3, finest = 1e-3),
  "from 1/10000, asked for" = list(low = -4, high = -3, finest = 1e-4)
)

# A curve that falls from `from` on, as numbers of y(x) = a + b x + c x^2 + d sin(k x + p).
random_curve <- function(class) {
  rest <- class == "from rest" || (class != "with a speed" && stats::runif(1) < 0.6)
  repeat {
    size <- 10^between(-1, 1)
    k <- between(0.5, 6) / size
    at <- c(
      a = between(-2, 2) * size, b = between(-3, 0.5), c = between(-0.4, 0.4) / size,
      d = between(-0.3, 0.3) / k, k = k, p = between(-3, 3)
    )
    from <- if (stats::runif(1) < 0.3) 0 else between(-1, 1) * size
    slope <- at[["b"]] + 2 * at[["c"]] * from + at[["d"]] * k * cos(k * from + at[["p"]])
    way <- if (rest) -sign(slope) else either(1)
    if (!rest || abs(slope) > 1e-3) break
  }
  to <- from + way * size * 10^between(-3, 0.3)
  width <- classes[[class]]
  bump <- c(h = 0, m = 0, w = 1)
  if (length(width)) {
    w <- 10^between(width$low, width$high)
    bump <- c(
      h = either(10^between(-2.5, 0.5) * abs(to - from)), m = from + (to - from) *
        between(min(0.4, 9 * w), 1 - min(0.4, 9 * w)), w = w * abs(to - from)
    )
  }
  list(
    numbers = c(at, bump), from = from, to = to, class = class,
    finest = width$finest, v0 = if (rest) 0 else sqrt(size) * 10^between(-2, 1),
    beta = between(0, 1),
    gravity = 10^between(-1, 2)
  )
}

curve_of <- function(numbers) {
  formula <- y ~ a + b * x + c * x^2 + d * sin(k * x + p)
  if (numbers[["h"]] != 0) {
    formula <- y ~ a + b * x + c * x^2 + d * sin(k * x + p) + h * exp(-((x - m) / w)^2)
  }
  f <- function(x) NULL
  body(f) <- do.call(substitute, list(formula[[3]], as.list(numbers)))
  environment(f) <- baseenv()
  f
}

runs <- list()
while (length(runs) < scenes) {
  one <- random_curve(names(classes)[c(1L, 2L, 1L, 2L, 3L, 3L, 4L, 4L)][length(runs) %% 8L + 1L])
  motion <- tryCatch(
    roll_on_curve(
      curve_of(one$numbers), one$from, one$to, one$beta, one$v0, rows = 9,
      gravity_m_per_s2 = one$gravity, finest = if (is.null(one$finest)) 1e-3 else one$finest
    ), rotdyn_error_value = function(e) NULL # it bends more than the body fits
  )
  if (is.null(motion)) next
  # The last row of a motion that ends on its way has a place that is rounded.
  rows <- if (summary(motion)$event == "arrives") motion else motion[-nrow(motion), ]
  if (nrow(rows) < 2L) next
  runs[[length(runs) + 1L]] <- list(
    line = paste(sprintf("%.17g", c(
      one$numbers, one$from, one$to, one$v0, one$gravity, 2 * one$gravity / (1 + one$beta),
      nrow(rows), rows$x_m
    )), collapse = " "),
    time_s = rows$time_s, path_m = rows$path_m, error = summary(motion)$error, class = one$class,
    event = summary(motion)$event, x_m = summary(motion)$x_m, span = abs(one$to - one$from)
  )
}

truths <- lapply(
  system2(args[1], input = vapply(runs, `[[`, "", "line"), stdout = TRUE),
  function(line) scan(text = line, quiet = TRUE)
)
# The error over the figure; Inf where the motion ends otherwise.
share <- mapply(function(run, truth) {
  n <- length(truth)
  end <- truth[n - 2:0]
  rows <- matrix(truth[seq_len(n - 3L)], ncol = 4, byrow = TRUE)
  event <- c("arrives", "turns", "leaves")[end[1] + 1]
  if (event != run$event || abs(end[2] - run$x_m) > 1e-7 * run$span) return(Inf)
  apart <- function(got, at) max(abs(got - rows[, at] - rows[, at + 1L])) / max(abs(got))
  max(apart(run$time_s, 1L), apart(run$path_m, 3L)) / run$error
}, runs, truths)
class <- vapply(runs, `[[`, "", "class")
bad <- FALSE
for (name in names(classes)) {
  of <- share[class == name]
  if (!length(of)) next
  missed <- sum(!(of <= 1))
  silent <- sum(!(of <= 10))
  events <- table(vapply(runs[class == name], `[[`, "", "event"))
  cat(sprintf(
    "curves, %s: %d scenes (%s), covered %.1f %%, silent %d; the closest %s, seed %d\n", name,
    length(of), paste(names(events), events, collapse = ", "), 100 * mean(of <= 1), silent,
    paste(format(utils::head(sort(of, decreasing = TRUE), 4L), digits = 2), collapse = " "), seed
  ))
  bad <- bad || missed > 0.05 * length(of) || silent > 0
}
if (nzchar(Sys.getenv("COVERAGE_SHOW"))) {
  for (i in utils::head(order(-share), 5L)) {
    cat(share[i], runs[[i]]$error, runs[[i]]$event, runs[[i]]$x_m, runs[[i]]$line, "\n ",
        utils::tail(truths[[i]], 3L), "\n")
  }
}
quit(status = as.integer(bad))
