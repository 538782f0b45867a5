# What the residuals of a fit say of the noise of its record.

# Degrees of freedom of n samples over a time, by their noise. Of the slow part of the noise a run
# of length T has as many independent samples as its mean would show, T/(2 tau) (Bayley and
# Hammersley, J. R. Stat. Soc. B 8, 184, 1946); the two parts are weighed by their power at low
# frequency. With n - p instead the intervals cover 1 to 2 % less (bench/measurement/coast.R, AR(1)
# 0.9 and half slow noise). Of anticorrelated noise the power at low frequency is a small
# difference: where it is (1 - a)^2/(1 + a^2) of the variance, as of e_i - a e_(i-1), its error is
# that of n (1 - a)/(2 (1 + a)) squares (Brockwell and Davis, Time Series, 1991, example 8.8.1).
noise_dof <- function(n, span, tau, white) {
  if (!(tau > 0) || white == 1 || n < 2) return(n)
  if (white > 1) {
    power <- max(white - (white - 1) / tanh(span / (n - 1) / (2 * tau)), 0)
    return(n / 2 * sqrt(power / (2 - power)))
  }
  slow <- (1 - white) * 2 * tau
  part <- slow / (slow + white * span / (n - 1))
  1 / (part^2 * 2 * tau / span + (1 - part)^2 / n)
}

# Sums of whitened residuals over windows of 4, 8, 16, ... samples that overlap by half: the largest
# in standard deviations, and the chance of one as large (union bound over windows and widths).
scan_residuals <- function(e) {
  n <- length(e)
  total <- c(0, cumsum(e))
  best <- 0
  p <- 1
  widths <- 0
  width <- 4L
  while (width <= n) {
    first <- seq(0, n - width, by = width %/% 2L)
    z <- max(abs(total[first + width + 1] - total[first + 1])) / sqrt(width)
    chance <- min(1, 2 * length(first) * stats::pnorm(z, lower.tail = FALSE))
    if (chance < p) {
      p <- chance
      best <- z
    }
    width <- 2L * width
    widths <- widths + 1
  }
  list(statistic = best, p = min(1, p * max(widths, 1)))
}

# The slope of the logarithm of the noise's s.d. over time; 0 where chance explains it, for exact
# data, and where the law fails.
trend_of <- function(time_s, e, fitted, y) {
  here <- is.finite(e)
  x <- time_s[here] - mean(time_s[here])
  size <- abs(e[here])
  if (length(x) < 30L || max(abs(y - fitted)[here]) < 1e-9 * max(abs(y[here]))) return(0)
  spread <- sqrt(sum(x^2))
  slope <- sum(x * log(pmax(size, 0.01 * mean(size)))) / spread^2
  # The logarithm of a normal number's size has the s.d. pi/sqrt(8).
  if (!isTRUE(abs(slope) * spread > 4 * pi / sqrt(8))) return(0)
  even <- e[here] * exp(-slope * x)
  if (scan_residuals(even / sqrt(mean(even^2)))$p < 1e-3) 0 else slope
}
