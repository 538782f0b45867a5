# A torque function of time alone, sampled once and for all: Chebyshev polynomials between its
# breaks, halved until their tail is below what the accuracy asks. The integrator then never calls
# R: a sinusoid over 8 s takes some 130 samples where the integration would take 3500.

sample_degree <- 32L
most_samples <- 50000L

# Values of f at times; `scene` holds the angle and rate of a law of the state, NULL for one of time
# alone. A function that can take a vector is called once: it must give the same numbers as one by
# one.
values_of <- function(f, time_s, complain, scene = NULL) {
  one <- function(t) {
    value <- if (is.null(scene)) f(t) else f(t, scene$theta0_rad, scene$omega0_rad_per_s)
    number <- is.numeric(value) || (is.logical(value) && identical(is.na(value), TRUE))
    if (!number || is.object(value) || length(value) != 1L) {
      return(as.double(complain(value, t)))
    }
    as.double(value)
  }
  n <- length(time_s)
  if (n > 4L) {
    all <- values_at_once(f, time_s, scene)
    probe <- c(1L, (n + 1L) %/% 2L, n)
    if (!is.null(all) && identical(all[probe], vapply(time_s[probe], one, double(1)))) {
      return(all)
    }
  }
  vapply(time_s, one, double(1))
}

# All at once, or NULL where that cannot be. An angle and a rate of the scene may be one or n.
values_at_once <- function(f, time_s, scene = NULL) {
  if (!takes_vectors(f)) {
    return(NULL)
  }
  n <- length(time_s)
  value <- if (is.null(scene)) {
    f(time_s)
  } else {
    f(time_s, rep_len(scene$theta0_rad, n), rep_len(scene$omega0_rad_per_s, n))
  }
  if (is.double(value) && length(value) == n && !is.object(value)) as.vector(value)
}

# Functions of R that work element by element. A law made of these alone may be given many times at
# once. Trying it out is no way to know: `&&` of a vector ends the whole process where R CMD check
# is strict.
elementwise <- c(
  "{", "(", "<-", "=", "return", "+", "-", "*", "/", "^", "%%", "%/%", "<", "<=", ">", ">=", "==",
  "!=", "!", "&", "|", "ifelse", "sin", "cos", "tan", "sinpi", "cospi", "tanpi", "asin", "acos",
  "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "exp", "expm1", "log",
  "log10", "log2", "log1p", "sqrt", "abs", "sign", "floor", "ceiling", "trunc", "round", "pmin",
  "pmax", "is.na", "as.numeric", "as.double"
)

takes_vectors <- function(f, depth = 0L) {
  if (is.primitive(f)) {
    return(any(vapply(elementwise, function(name) {
      identical(f, get0(name, baseenv()))
    }, logical(1))))
  }
  calls_elementwise(body(f), environment(f), depth)
}

calls_elementwise <- function(x, env, depth) {
  if (is.symbol(x) || is.numeric(x) || is.logical(x) || is.null(x)) {
    return(TRUE)
  }
  if (!is.call(x) || !is.symbol(x[[1]])) {
    return(FALSE)
  }
  name <- as.character(x[[1]])
  called <- get0(name, env, mode = "function")
  known <- if (name %in% elementwise && identical(called, get0(name, baseenv()))) {
    TRUE
  } else {
    depth < 4L && is.function(called) && takes_vectors(called, depth + 1L)
  }
  known && all(vapply(as.list(x)[-1], function(part) {
    identical(part, quote(expr = )) || calls_elementwise(part, env, depth)
  }, logical(1)))
}

# list(term, error, impulse, calls): the law as Chebyshev pieces over `span`, the largest error of it
# in N m, the integral of the error in N m s, the times sampled. NULL where it is not finite or will not converge: then it must be called.
sample_torque <- function(f, span, breaks_s, accuracy) {
  if (!(span[2] > span[1])) {
    return(NULL)
  }
  inside <- breaks_s[breaks_s > span[1] & breaks_s < span[2]]
  edges <- c(span[1], inside, span[2])
  counted <- 0L
  # What is no number at all makes the values NaN; whoever calls the law will say where.
  at <- function(t) {
    counted <<- counted + length(t)
    values_of(f, t, function(value, t) NaN)
  }
  pieces <- cbind(edges[-length(edges)], edges[-1])
  done <- list()
  largest <- 0
  error <- 0
  impulse <- 0
  while (nrow(pieces)) {
    if (counted + (sample_degree + 1L) * nrow(pieces) > most_samples) {
      return(NULL)
    }
    fitted <- fit_pieces(at, pieces)
    if (is.null(fitted)) {
      return(NULL)
    }
    largest <- max(largest, fitted$largest)
    wanted <- largest * max(1e-3 * accuracy, 2e-14) # below, many laws have noise of their own
    good <- fitted$tail <= wanted | fitted$width <= 1e-10 * diff(span)
    if (any(good)) {
      done[[length(done) + 1L]] <- list(pieces[good, , drop = FALSE], fitted$a[good, , drop = FALSE])
      error <- max(error, fitted$tail[good])
      impulse <- impulse + sum(((fitted$tail + 4e-15 * fitted$height) * fitted$width)[good])
    }
    rest <- pieces[!good, , drop = FALSE]
    middle <- rest[, 1] + (rest[, 2] - rest[, 1]) / 2
    pieces <- rbind(cbind(rest[, 1], middle), cbind(middle, rest[, 2]))
  }
  if (error > largest * max(accuracy, 1e-13)) {
    return(NULL) # a jump that nobody told
  }
  pieces <- do.call(rbind, lapply(done, `[[`, 1L))
  a <- do.call(rbind, lapply(done, `[[`, 2L))
  order <- order(pieces[, 1])
  pieces <- pieces[order, , drop = FALSE]
  n <- nrow(pieces)
  x <- c(n, ncol(a), pieces[, 1], pieces[n, 2], t(a[order, , drop = FALSE]))
  list(
    # Neighbours differ by rounding where they meet: a break, where the motion is still small.
    term = new_term("chebyshev", x, "samples", breaks_s = c(pieces[, 1], pieces[n, 2])),
    error = error + 4e-15 * largest,
    impulse = impulse,
    calls = counted
  )
}

# Coefficients on each piece (a row each), and the size of their tails; NULL where
# not finite. The ends of a piece are never sampled: a function may jump there.
fit_pieces <- function(at, pieces) {
  degree <- sample_degree
  n <- degree + 1L
  odd <- 2 * seq_len(n) - 1
  node <- cospi(odd / (2 * n))
  middle <- pieces[, 1] + (pieces[, 2] - pieces[, 1]) / 2
  half <- (pieces[, 2] - pieces[, 1]) / 2
  t <- outer(half, node) + middle
  y <- matrix(at(as.vector(t)), nrow(t))
  if (!all(is.finite(y))) {
    return(NULL)
  }
  # Whole turns taken off as integers: else the rounding of 32 half turns is the largest error.
  a <- (2 / n) * y %*% cospi((outer(odd, 0:degree) %% (4 * n)) / (2 * n))
  a[, 1] <- a[, 1] / 2
  size <- apply(abs(a), 1, max)
  tail <- 2 * apply(abs(a[, degree - 0:3 + 1L, drop = FALSE]), 1, max)
  a[abs(a) < 2.5e-16 * size] <- 0 # rounding: 33 of them would add up
  list(
    a = a,
    largest = max(abs(y)),
    # Coefficients of a smooth law fall geometrically: the last ones stand for all that follow.
    tail = tail,
    height = apply(abs(y), 1, max),
    width = pieces[, 2] - pieces[, 1]
  )
}
