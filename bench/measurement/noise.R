# Coverage of estimate_motion() by kind of error: white, correlated in time, counters.
#   Rscript bench/measurement/noise.R [RECORDS [SEED]]
# For each kind and motion, RECORDS/10 records (of 500: 50): the share of rows whose interval of
# 68 % and of 95 % holds the true angle, rate and acceleration, over all records; of a counter's
# angle none. The verdict: 60 to 76 and 91 to 98.5, wider by two standard errors of the share where
# that is more than 1. What is outside must be in the print of the estimate:
#   - records that say that their intervals may not hold are not counted, nor those whose errors are
#     correlated over the time that the print calls motion or more (in brackets: how many; where
#     fewer than three are left, the shares of all are shown, without a verdict);
#   - shares above the windows must be said by the line on bands, 68 % up to the figure it gives
#     ("said"). Bands too narrow are not excused.
suppressMessages(library(rotdyn))
here <- dirname(sub("^--file=", "", grep("^--file=", commandArgs(), value = TRUE)))
source(file.path(here, "records.R"))

given <- suppressWarnings(as.integer(commandArgs(TRUE)))
records <- max(4, ceiling(0.1 * if (length(given) > 0) given[1] else 500))
seed <- if (length(given) > 1) given[2] else as.integer(as.double(Sys.time()) %% 1e9)
only <- commandArgs(TRUE)[-(1:2)]

cat("seed", seed, "with", records, "records of each kind and motion\n")

# Unit variance, even times.
autoregressive <- function(n, rho) {
  e <- stats::rnorm(n) * c(1, rep(sqrt(1 - rho^2), n - 1))
  as.vector(stats::filter(e, rho, "recursive"))
}
kinds <- list(
  "white" = function(n) stats::rnorm(n),
  "AR(1) 0.5" = function(n) autoregressive(n, 0.5),
  "AR(1) 0.8" = function(n) autoregressive(n, 0.8),
  "AR(1) 0.9" = function(n) autoregressive(n, 0.9),
  "half slow" = function(n) sqrt(0.5) * (stats::rnorm(n) + autoregressive(n, 0.93))
)
# Correlation from sample to sample of the slowest part.
slowest <- c("AR(1) 0.5" = 0.5, "AR(1) 0.8" = 0.8, "AR(1) 0.9" = 0.9, "half slow" = 0.93)
# A counter: turns/steps of it, by the number of counts a sample at the usual speed.
counters <- c(
  "counter, 2 a sample" = 2, "counter, 0.5 a sample" = 0.5, "counter, 0.1 a sample" = 0.1
)

one_record <- function(kind, class) {
  n <- round(exp(stats::runif(1, log(200), log(1000))))
  time <- seq(0, seconds[[class]], length.out = n)
  truth <- true_motion(class, time)
  theta <- if (kind %in% names(counters)) {
    step <- mean(abs(diff(truth$theta))) / counters[[kind]]
    step <- 2 * pi / max(4, round(2 * pi / step))
    step * round(truth$theta / step + stats::runif(1))
  } else {
    truth$theta + exp(stats::runif(1, log(2e-3), log(2e-2))) * kinds[[kind]](n)
  }
  list(data = data.frame(time_s = time, theta_rad = theta), truth = truth)
}

# What the print says: the time from which on errors count as motion, the largest share of a band of
# 68 % (NA: not said), whether intervals may not hold, whether a counter's angle has an offset.
said <- function(motion) {
  lines <- tibble::tbl_sum(motion)
  number <- function(name, pattern) {
    if (!name %in% names(lines) || !grepl(pattern, lines[[name]])) return(NA)
    as.numeric(sub(paste0("^.*", pattern, ".*$"), "\\1", lines[[name]]))
  }
  list(
    motion_s = number("Slow errors", "over ([0-9.e-]+) s or more count as motion"),
    most = number("Bands", "wide where the motion is smoother, .*68 % hold up to ([0-9]+) %"),
    open = any(grepl("may not hold|do not hold", lines)),
    offset = grepl("but for a constant", lines["Resolution"])
  )
}

# Shares of the rows whose error is within the bands of 68 and 95 %.
inside <- function(motion, what, unit, truth) {
  t <- stats::qt(c(0.84, 0.975), generics::glance(motion)$degrees)
  z <- abs(motion[[paste0(what, "_", unit)]] - truth) / motion[[paste0(what, "_se_", unit)]]
  c(mean(z <= t[1]), mean(z <= t[2]))
}

bad <- 0
total <- 0
low <- rep(c(60, 91), 3)
high <- rep(c(76, 98.5), 3)
for (kind in c(names(kinds), names(counters))) {
  if (length(only) && !kind %in% only) next
  for (class in names(seconds)) {
    set.seed(seed)
    held <- matrix(0, 0, 6)
    open <- logical()
    most <- 100
    for (i in seq_len(records)) {
      record <- one_record(kind, class)
      motion <- estimate_motion(record$data, turns = "counted")
      words <- said(motion)
      time <- record$data$time_s
      tau <- if (kind %in% names(slowest)) -time[2] / log(slowest[[kind]]) else 0
      open[i] <- words$open || isTRUE(tau >= words$motion_s)
      most <- min(most, words$most)
      angle <- if (kind %in% names(counters)) {
        if (words$offset) c(NA, NA) else c(0, 0)
      } else {
        inside(motion, "theta", "rad", record$truth$theta)
      }
      held <- rbind(held, 100 * c(
        angle, inside(motion, "omega", "rad_per_s", record$truth$omega),
        inside(motion, "alpha", "rad_per_s2", record$truth$alpha)
      ))
    }
    # Of fewer than three records there is no verdict; then all are shown.
    n <- sum(!open)
    judged <- n > 2
    if (judged) held <- held[!open, ]
    share <- colMeans(held)
    slack <- if (judged) pmax(2 * apply(held, 2, stats::sd) / sqrt(n), 1) - 1 else Inf
    narrow <- any(share < low - slack, na.rm = TRUE)
    wide <- any(share > high + slack, na.rm = TRUE)
    limit <- c(most, 100) + slack
    beyond <- wide && (is.na(most) || any(share > limit, na.rm = TRUE))
    fails <- narrow || beyond
    total <- total + 1
    bad <- bad + fails
    cat(sprintf(
      "%-7s %-22s %-11s angle %4.0f %5.1f  omega %4.0f %5.1f  alpha %4.0f %5.1f  [%d of %d]\n",
      if (fails) "FAILED" else if (wide || !judged) "said" else "ok", kind, class, share[1],
      share[2], share[3], share[4], share[5], share[6], sum(open), records
    ))
  }
}
cat("noise:", total - bad, "passed,", bad, "failed, seed", seed, "\n")
quit(status = as.integer(bad > 0))
