# A torque function of time alone, sampled before the run: Chebyshev polynomials between its breaks,
# halved until their tail is below what the accuracy asks. The integrator then never calls R: a
# sinusoid over 8 s takes some 130 samples where the integration would take 3500.

sample_degree <- 32L
most_samples <- 50000L

# list(at, calls, own): at(time_s) evaluates the law at many times, at the angle and rate where the
# scene starts, calls() counts the times so far, own is the law as src/glue/torque.h reads it.
law_reader <- function(law, scene, call) {
  f <- law$f
  state <- c(scene$theta0_rad, scene$omega0_rad_per_s)
  called <- 0
  # C fills in the arguments; an error of the function's own shows the call f(...).
  own <- list(
    as.call(c(quote(f), rep(list(NULL), law$arguments))), list2env(list(f = f), parent = baseenv()),
    function(value, time_s) abort_torque_value(value, time_s, call)
  )
  at <- function(time_s) {
    n <- length(time_s)
    called <<- called + n
    if (!law$vectorised) {
      .Call(ffi_torque_values, own, time_s, state)
    } else if (law$arguments == 1L) {
      check_torques(f(time_s), n, call)
    } else {
      check_torques(f(time_s, rep(state[1], n), rep(state[2], n)), n, call)
    }
  }
  beside <- function(theta_rad) {
    called <<- called + 1
    .Call(ffi_torque_values, own, scene$start_s, c(theta_rad, state[2]))
  }
  list(at = at, beside = beside, calls = function() called, own = own)
}

# What a vectorised law returned for n times, as doubles.
check_torques <- function(value, n, call) {
  number <- is.numeric(value) || (is.logical(value) && all(is.na(value)))
  if (!number || is.object(value) || length(value) != n) {
    abort_rotdyn(c(
      "The torque function must return one number in N m for each time.",
      x = "Called with {n} time{?s} it returned {describe_value(value)}.",
      i = "{.code torque_function(f, vectorised = FALSE)} calls it with one time each."
    ), "torque", call)
  }
  as.double(value)
}

abort_torque_value <- function(value, time_s, call) {
  abort_rotdyn(c(
    "The torque function must return one number in N m.",
    x = "At {format(time_s, digits = 17)} s it returned {describe_value(value)}."
  ), "torque", call)
}

# list(term, error, largest, impulse): the law as Chebyshev pieces over `span`, their largest error
# and value in N m, the integral of the error in N m s. NULL where the law is not finite or the
# pieces do not converge: then the integrator calls it.
sample_torque <- function(reader, span, breaks_s, accuracy) {
  if (!(span[2] > span[1])) return(NULL)
  edges <- c(span[1], breaks_s[breaks_s > span[1] & breaks_s < span[2]], span[2])
  from <- edges[-length(edges)]
  to <- edges[-1]
  done <- list()
  largest <- 0
  samples <- 0
  while (length(from)) {
    samples <- samples + (sample_degree + 1L) * length(from)
    fit <- if (samples <= most_samples) fit_pieces(reader$at, from, to)
    if (is.null(fit)) return(NULL)
    largest <- max(largest, fit$height)
    wanted <- largest * max(1e-3 * accuracy, 2e-14) # below, many laws have noise of their own
    good <- fit$tail <= wanted | to - from <= 1e-10 * diff(span)
    done[[length(done) + 1L]] <- lapply(fit, function(x) x[good, , drop = FALSE])
    middle <- (from + (to - from) / 2)[!good]
    from <- c(from[!good], middle)
    to <- c(middle, to[!good])
  }
  fit <- do.call(Map, c(rbind, done))
  error <- max(fit$tail)
  if (error > largest * max(accuracy, 1e-13)) return(NULL) # a jump that is no break
  order <- order(fit$from)
  ends <- c(fit$from[order], span[2])
  list(
    # Neighbours differ by rounding where they meet: a break, where the motion is still small.
    term = new_term(
      "chebyshev", c(length(order), sample_degree + 1, ends, t(fit$a[order, , drop = FALSE])),
      "samples", breaks_s = ends
    ),
    error = error + 4e-15 * largest,
    largest = largest,
    impulse = sum((fit$tail + 4e-15 * fit$height)[order] * diff(ends))
  )
}

# Matrices with a row for each piece: the coefficients a, the size of their tail, the largest value,
# where the piece begins. NULL where the law is not finite. The ends of a piece are never sampled: a
# law may jump there.
fit_pieces <- function(at, from, to) {
  n <- sample_degree + 1L
  odd <- 2 * rev(seq_len(n)) - 1 # the times of a piece increase
  half <- (to - from) / 2
  y <- matrix(at(as.vector(outer(half, cospi(odd / (2 * n))) + (from + half))), length(from))
  if (!all(is.finite(y))) return(NULL)
  # Whole turns are taken off as integers: else the rounding of 32 half turns is the largest error.
  a <- (2 / n) * y %*% cospi((outer(odd, 0:sample_degree) %% (4 * n)) / (2 * n))
  a[, 1] <- a[, 1] / 2
  # Coefficients of a smooth law fall geometrically: the last four stand for all that follow.
  tail <- 2 * apply(abs(a[, n - 0:3, drop = FALSE]), 1, max)
  a[abs(a) < 2.5e-16 * apply(abs(a), 1, max)] <- 0 # rounding: 33 of them would add up
  list(a = a, tail = cbind(tail), height = cbind(apply(abs(y), 1, max)), from = cbind(from))
}
