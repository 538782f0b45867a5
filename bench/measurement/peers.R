# What is used today: a local cubic with a cross-validated window, and stats::smooth.spline().

# Least squares of a cubic in the k nearest samples; k by leave-one-out cross-validation.
local_cubic <- function(time, theta, at) {
  n <- length(time)
  widths <- unique(pmin(n, round(exp(seq(log(7), log(max(8, n / 2)), length.out = 10)))))
  score <- vapply(widths, function(k) mean(local_fit(time, theta, time, k, TRUE)$left^2), 0)
  local_fit(time, theta, at, widths[which.min(score)], FALSE)
}

local_fit <- function(time, theta, at, k, leave_out) {
  n <- length(time)
  m <- length(at)
  out <- list(omega = double(m), alpha = double(m), left = double(if (leave_out) m else 0))
  # For the score every third sample is enough.
  rows <- if (leave_out) seq(1, m, by = max(1, m %/% 200)) else seq_len(m)
  for (i in rows) {
    centre <- findInterval(at[i], time)
    low <- min(max(1, centre - k %/% 2), n - k + 1)
    use <- seq.int(low, length.out = k)
    u <- time[use] - at[i]
    x <- cbind(1, u, u^2, u^3)
    fit <- stats::lm.fit(x, theta[use])
    out$omega[i] <- fit$coefficients[2]
    out$alpha[i] <- 2 * fit$coefficients[3]
    if (leave_out) {
      here <- match(i, use)
      q <- qr.Q(fit$qr)[here, ]
      out$left[i] <- (theta[i] - fit$coefficients[1]) / (1 - sum(q^2))
    }
  }
  out$left <- out$left[if (leave_out) rows else 0]
  out
}

spline_peer <- function(time, theta, at) {
  fit <- stats::smooth.spline(time, theta)
  list(
    omega = stats::predict(fit, at, deriv = 1)$y, alpha = stats::predict(fit, at, deriv = 2)$y
  )
}
