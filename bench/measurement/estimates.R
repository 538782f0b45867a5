# What estimate_motion() promises, on records with fresh seeds: coverage of the bands, errors of
# two peers over ours, breaks. Prints each figure with its limits; ends with status 1 if one fails.
#   Rscript bench/measurement/estimates.R [RECORDS [SEED]]
# Two fifths of RECORDS for each class: 200 of 500.
suppressMessages(library(rotdyn))
here <- dirname(sub("^--file=", "", grep("^--file=", commandArgs(), value = TRUE)))
source(file.path(here, "records.R"))
source(file.path(here, "peers.R"))

given <- as.integer(commandArgs(TRUE))
records <- ceiling(0.4 * if (length(given) > 0) given[1] else 500)
seed <- if (length(given) > 1) given[2] else as.integer(as.double(Sys.time()) %% 1e9)
cat("seed", seed, "with", records, "records of each class\n")

failed <- passed <- 0
verdict <- function(what, value, low = -Inf, high = Inf, digits = 3) {
  holds <- is.finite(value) && value >= low && value <= high
  if (holds) passed <<- passed + 1 else failed <<- failed + 1
  cat(sprintf(
    "%-7s %-58s %s  (%s to %s)\n", if (holds) "ok" else "FAILED", what,
    format(value, digits = digits), format(low, digits = 3), format(high, digits = 3)
  ))
}

within <- function(truth, motion, stem, unit) {
  truth >= motion[[paste0(stem, "_low_", unit)]] & truth <= motion[[paste0(stem, "_high_", unit)]]
}

# Few samples warn: that is known here.
estimate <- function(data, ...) {
  withCallingHandlers(
    estimate_motion(data, turns = "counted", ...),
    rotdyn_warning_size = function(w) invokeRestart("muffleWarning")
  )
}

# ---- coverage and accuracy ----------------------------------------------------------------------

# The local cubic takes a second a record: for a part of them.
compared <- ceiling(records / 4)
for (class in names(seconds)) {
  set.seed(seed)
  held <- NULL
  ratio <- NULL
  for (i in seq_len(records)) {
    record <- random_record(class)
    motion <- estimate(record$data)
    truth <- record$truth
    k <- ceiling(0.03 * record$n)
    end <- seq_len(record$n) <= k | seq_len(record$n) > record$n - k
    omega <- within(truth$omega, motion, "omega", "rad_per_s")
    alpha <- within(truth$alpha, motion, "alpha", "rad_per_s2")
    held <- rbind(held, c(
      record$n, sum(omega), sum(alpha), sum(end), sum(omega[end]), sum(alpha[end])
    ))
    rmse <- function(x, of) sqrt(mean((x - of)^2))
    ours <- c(
      rmse(motion$omega_rad_per_s, truth$omega), rmse(motion$alpha_rad_per_s2, truth$alpha)
    )
    # The peers are spared the outliers.
    clean <- setdiff(seq_len(record$n), record$wrong)
    peers <- lapply(list(spline_few_knots, spline_peer, local_cubic), function(peer) {
      if (i > compared && identical(peer, local_cubic)) return(c(NA, NA))
      out <- peer(record$data$time_s[clean], record$data$theta_rad[clean], record$data$time_s)
      c(rmse(out$omega, truth$omega), rmse(out$alpha, truth$alpha)) / ours
    })
    ratio <- rbind(ratio, unlist(peers))
  }
  sums <- colSums(held)
  # Two standard errors of what these records give: their rows err together.
  apart <- function(x) 2 * stats::sd(x, na.rm = TRUE) / sqrt(sum(is.finite(x)))
  spare <- c(apart(held[, 2] / held[, 1]), apart(held[, 3] / held[, 1]))
  verdict(
    paste(class, "coverage of omega"), sums[2] / sums[1], 0.93 - spare[1], 0.985 + spare[1]
  )
  verdict(paste(class, "coverage of alpha"), sums[3] / sums[1], 0.93 - spare[2], 1)
  verdict(paste(class, "coverage of omega, first and last 3 %"), sums[5] / sums[4], 0.85)
  verdict(paste(class, "coverage of alpha, first and last 3 %"), sums[6] / sums[4], 0.85)
  least <- rbind(
    "smooth.spline" = c(2.4, 4.5), "smooth.spline, a knot a sample," = c(2.4, 4.5),
    "local cubic" = c(1.4, 1.6)
  )
  less <- matrix(exp(-apply(log(ratio), 2, apart)), ncol = 2, byrow = TRUE)
  mean_ratio <- matrix(exp(colMeans(log(ratio), na.rm = TRUE)), ncol = 2, byrow = TRUE)
  for (peer in 1:3) {
    for (what in 1:2) {
      verdict(
        paste0(
          class, " ", c("omega", "alpha")[what], ": ", rownames(least)[peer], " over ours"
        ), mean_ratio[peer, what], least[peer, what] * less[peer, what]
      )
    }
  }
}

# ---- gyroscopes ---------------------------------------------------------------------------------

set.seed(seed)
held <- vapply(seq_len(records), function(i) {
  record <- rate_record(names(seconds)[1 + i %% 4])
  motion <- estimate(record$data)
  mean(within(record$truth$theta - record$truth$theta[1], motion, "theta", "rad"))
}, 0)
verdict("rates: coverage of the angle integrated", mean(held), 0.92, 0.98)

# ---- breaks -------------------------------------------------------------------------------------

limits <- list(
  "impact" = c(time = 0.05, error = 1.5), "step" = c(time = 0.3, error = 3.5),
  "stop" = c(time = 0.7, error = 1.5)
)
tries <- ceiling(records / 2)
for (class in names(break_times)) {
  for (outliers in c(0, 0.02)) {
    set.seed(seed)
    found <- lapply(seq_len(tries), function(i) found_breaks(broken_record(class, outliers)))
    off <- do.call(cbind, lapply(found, `[[`, "off"))
    ratio <- vapply(found, function(x) x$found / x$given, 0)
    name <- paste0(class, if (outliers > 0) ", outliers")
    verdict(paste(name, "found, of 100"), 100 * mean(colSums(is.na(off)) == 0), 98)
    verdict(
      paste(name, "error of the time in spacings, median"),
      max(apply(off, 1, stats::median, na.rm = TRUE)), 0, limits[[class]]["time"]
    )
    verdict(
      paste(name, "error of omega over that with the time given"), exp(mean(log(ratio))), 0,
      limits[[class]]["error"]
    )
    most <- if (class == "impact" && outliers > 0) 20 else 3
    extra <- vapply(found, `[[`, 0, "extra")
    verdict(paste(name, "records with a break too many, of 100"), 100 * mean(extra > 0), 0, most)
  }
}
for (class in c("coast-down", "pendulum")) {
  set.seed(seed)
  extra <- vapply(seq_len(2 * tries), function(i) {
    record <- random_record(
      class, n = 50 * seconds[[class]], sigma = 1e-3, uneven = FALSE, quantised = FALSE,
      outliers = if (i %% 2) 0.02 else 0
    )
    nrow(motion_events(estimate(record$data)))
  }, 0)
  verdict(paste(class, "records with a false break, of 100"), 100 * mean(extra > 0), 0, 1)
}

cat("estimates:", passed, "passed,", failed, "failed, seed", seed, "\n")
quit(status = as.integer(failed > 0))
