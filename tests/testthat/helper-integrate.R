# Integration that shares no code with the package: Runge-Kutta of order 4 with even steps between
# the times at which a law jumps. f(t, y) is a rate; a law is read just inside of each piece.
rk4 <- function(f, y, from, to, breaks = double(), steps = 200L) {
  ends <- sort(unique(c(from, breaks[breaks > from & breaks < to], to)))
  for (i in seq_along(ends)[-1]) {
    h <- (ends[i] - ends[i - 1]) / steps
    inside <- function(t) min(max(t, ends[i - 1] + 1e-9 * h), ends[i] - 1e-9 * h)
    for (k in seq_len(steps)) {
      t <- ends[i - 1] + (k - 1) * h
      k1 <- f(inside(t), y)
      k2 <- f(inside(t + h / 2), y + h / 2 * k1)
      k3 <- f(inside(t + h / 2), y + h / 2 * k2)
      k4 <- f(inside(t + h), y + h * k3)
      y <- y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    }
  }
  y
}

cross3 <- function(a, b) {
  c(a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1])
}
skew <- function(w) matrix(c(0, w[3], -w[2], -w[3], 0, w[1], w[2], -w[1], 0), 3)

# The last state of a motion, as its columns have it: by rotor or link where it has those.
last_of <- function(motion, columns) {
  rows <- which(motion$time_s == motion$time_s[nrow(motion)])
  unlist(lapply(columns, function(column) motion[[column]][rows]), use.names = FALSE)
}
