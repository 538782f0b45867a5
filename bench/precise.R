# Numbers of about 31 digits, each the sum of two doubles, after Dekker (1971). Vectors, nothing but
# R's own arithmetic: the reference values share no code with what they judge.

pair <- function(hi, lo = 0 * hi) list(hi = hi, lo = lo)

two_sum <- function(a, b) {
  s <- a + b
  v <- s - a
  pair(s, (a - (s - v)) + (b - v))
}

two_prod <- function(a, b) {
  split <- function(x) {
    high <- 134217729 * x
    high <- high - (high - x)
    list(high, x - high)
  }
  x <- split(a)
  y <- split(b)
  p <- a * b
  pair(p, ((x[[1]] * y[[1]] - p) + x[[1]] * y[[2]] + x[[2]] * y[[1]]) + x[[2]] * y[[2]])
}

as_pair <- function(x) if (is.list(x)) x else pair(x)

plus <- function(x, y) {
  x <- as_pair(x)
  y <- as_pair(y)
  s <- two_sum(x$hi, y$hi)
  lo <- two_sum(x$lo, y$lo)
  s <- two_sum(s$hi, s$lo + lo$hi)
  two_sum(s$hi, s$lo + lo$lo)
}

minus <- function(x, y) {
  y <- as_pair(y)
  plus(x, pair(-y$hi, -y$lo))
}

times <- function(x, y) {
  x <- as_pair(x)
  y <- as_pair(y)
  p <- two_prod(x$hi, y$hi)
  two_sum(p$hi, p$lo + (x$hi * y$lo + x$lo * y$hi))
}

over <- function(x, y) {
  x <- as_pair(x)
  y <- as_pair(y)
  q <- pair(x$hi / y$hi)
  for (i in 1:2) q <- plus(q, minus(x, times(q, y))$hi / y$hi)
  q
}

root <- function(x) {
  r <- pair(sqrt(x$hi))
  for (i in 1:2) r <- plus(r, minus(x, times(r, r))$hi / (2 * r$hi))
  r
}

# Taylor series, for arguments of moderate size.
exp_pair <- function(x) {
  sum <- term <- pair(rep(1, length(x$hi)))
  for (k in 1:60) {
    term <- over(times(term, x), k)
    sum <- plus(sum, term)
  }
  sum
}

sin_degrees <- function(degrees) {
  pi_pair <- pair(3.141592653589793116, 1.224646799147353207e-16)
  sum <- term <- x <- over(times(pi_pair, degrees), 180)
  minus_square <- minus(0, times(x, x))
  for (k in 1:20) {
    term <- over(times(term, minus_square), 2 * k * (2 * k + 1))
    sum <- plus(sum, term)
  }
  sum
}

# Difference of doubles to a reference, rounded once.
off_by <- function(x, reference) abs((x - reference$hi) - reference$lo)
