# Speed of estimate_motion() beside its limits: Rscript bench/estimates.R, from the top of the
# repository, with the package installed. Needs gcc for the likelihood alone. Processor time, the
# least of several calls: other work of the machine counts little.
suppressMessages(library(rotdyn))
source("bench/measurement/records.R")

say <- function(what, found, limit, unit) {
  cat(sprintf(
    "%-58s %8.3g %s  (at most %g) %s\n", what, found, unit, limit,
    if (found <= limit) "yes" else "NO"
  ))
}
least_ms <- function(call, times = 7) {
  1e3 * min(vapply(seq_len(times), function(i) sum(system.time(call())[1:2]), 0))
}

program <- tempfile()
flags <- paste(
  "-O2 -ffp-contract=off -Isrc/core bench/peers/smooth-core.c src/core/measure/smooth.c",
  "src/core/measure/smooth_fit.c src/core/ground/status.c -lgsl -lgslcblas -lm -o", program
)
if (nzchar(Sys.which("gcc")) && system(paste("gcc", flags)) == 0) {
  each <- scan(text = system(program, intern = TRUE), quiet = TRUE)
  say("likelihood, 1e5 even samples, a sample", each[1], 40, "ns")
  say("likelihood, 1e5 uneven samples, a sample", each[2], 800, "ns")
}

set.seed(1)
for (uneven in c(FALSE, TRUE)) {
  record <- random_record(
    "spin-up", n = 1000, sigma = 1e-3, uneven = uneven, quantised = FALSE, outliers = 0
  )$data
  name <- paste0("1000 ", if (uneven) "uneven ", "samples")
  say(paste(name, "without breaks"), least_ms(function() {
    estimate_motion(record, breaks = "none")
  }), 25, "ms")
  say(paste(name, "with breaks looked for"), least_ms(function() {
    estimate_motion(record)
  }), 250, "ms")
}
for (class in names(break_times)) {
  time <- seq(0, break_seconds[[class]], length.out = 1000)
  record <- data.frame(
    time_s = time, theta_rad = broken_motion(class, time)$theta + stats::rnorm(1000, sd = 1e-3)
  )
  say(paste0("1000 samples, breaks found: ", class), least_ms(function() estimate_motion(record)),
      250, "ms")
}
n <- 1e5
record <- data.frame(time_s = seq_len(n) / 100)
record$theta_rad <- 20 * sin(0.3 * record$time_s) + stats::rnorm(n, sd = 1e-3)
say("1e5 samples, breaks looked for", least_ms(function() estimate_motion(record), 2), 3000, "ms")
