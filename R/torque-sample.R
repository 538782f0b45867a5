# A function of time alone, sampled before the run: Chebyshev polynomials between its breaks,
# halved until their tail is below what the accuracy asks. The integrator then never calls R: a
# sinusoid over 8 s takes some 130 samples where the integration would take 3500.

sample_degree <- 32L
max_samples <- 50000L

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

# list(terms, error, largest, impulse): the law as Chebyshev pieces over `span`, a term for each
# number that it gives, their largest error and value in N m, the integral of the error in N m s.
# NULL where the law is not finite or the pieces do not converge: then the integrator calls it.
sample_torque <- function(reader, span, breaks_s, accuracy, maximum = max_samples) {
  if (!(span[2] > span[1])) return(NULL)
  edges <- c(span[1], breaks_s[breaks_s > span[1] & breaks_s < span[2]], span[2])
  from <- edges[-length(edges)]
  to <- edges[-1]
  fit <- NULL
  largest <- 0
  samples <- 0
  repeat {
    samples <- samples + (sample_degree + 1L) * length(from)
    now <- if (samples <= maximum) fit_pieces(reader$at, from, to)
    if (is.null(now)) return(NULL)
    largest <- max(largest, now$height)
    wanted <- largest * max(1e-3 * accuracy, 2e-14) # below, many laws have noise of their own
    good <- now$tail <= wanted | to - from <= 1e-10 * diff(span)
    found <- lapply(now, function(x) x[good, , drop = FALSE])
    fit <- if (is.null(fit)) found else Map(rbind, fit, found)
    halve <- !good
    if (all(good)) {
      error <- max(fit$tail)
      if (error > largest * max(accuracy, 1e-13)) return(NULL) # a jump that is no break
      order <- order(fit$from)
      fit <- lapply(fit, function(x) x[order, , drop = FALSE])
      from <- as.vector(fit$from)
      to <- c(from[-1], span[2])
      halve <- do_not_meet(fit, span, edges, reader$at, 8 * (error + 4e-15 * largest))
      if (!any(halve)) break
      fit <- lapply(fit, function(x) x[!halve, , drop = FALSE])
    }
    middle <- (from + (to - from) / 2)[halve]
    from <- c(from[halve], middle)
    to <- c(middle, to[halve])
  }
  ends <- c(from, span[2])
  width <- sample_degree + 1
  term <- function(k) {
    a <- fit$a[, (k - 1) * width + seq_len(width), drop = FALSE]
    # Neighbours differ by rounding where they meet: a break, where the motion is still small.
    new_term("chebyshev", c(length(from), width, ends, t(a)), "samples", breaks_s = ends)
  }
  list(
    terms = lapply(seq_len(ncol(fit$a) / width), term),
    error = error + 4e-15 * largest,
    largest = largest,
    impulse = sum((fit$tail + 4e-15 * fit$height) * diff(ends))
  )
}

# Which pieces, in order of time, are to be halved: a change of the law that begins between the last
# sample of a piece and its end, 1/1000 of its length, shows in the next piece alone. Of two that
# differ by more than `most` where they meet, the longer one; at a break, where the law may jump,
# those that differ from the law just inside.
do_not_meet <- function(fit, span, breaks_s, at, maximum) {
  n <- nrow(fit$a)
  from <- as.vector(fit$from)
  to <- c(from[-1L], span[2])
  at_end <- polynomials_at(fit, 1)
  at_start <- polynomials_at(fit, -1)
  difference <- rows_max(at_end[-n, , drop = FALSE] - at_start[-1L, , drop = FALSE])
  broken <- from[-1L] %in% breaks_s
  longer <- ifelse(difference > maximum & !broken, (to - from)[-n] / (to - from)[-1L], NA)
  halve <- seq_len(n) %in% c(which(longer > 1 - 1e-9), which(longer < 1 + 1e-9) + 1L)
  for (side in c(-1, 1)) {
    i <- which(broken) + (side < 0)
    if (!length(i)) break
    inside <- (to - from)[i] * 2^-17
    law <- as.matrix(at(if (side < 0) from[i] + inside else to[i] - inside))
    off <- rows_max(law - polynomials_at(fit, side * (1 - 2^-16))[i, , drop = FALSE])
    halve[i] <- halve[i] | !(off <= maximum)
  }
  halve
}

rows_max <- function(x) apply(abs(x), 1L, max)

# The polynomials of each piece at x, from -1 to 1: a column for each number of the law.
polynomials_at <- function(fit, x) {
  width <- sample_degree + 1L
  basis <- cos((seq_len(width) - 1) * acos(x))
  each <- lapply(seq_len(ncol(fit$a) / width), function(k) {
    fit$a[, (k - 1L) * width + seq_len(width), drop = FALSE] %*% basis
  })
  do.call(cbind, each)
}

# Matrices with a row for each piece: the coefficients a of each number of the law, side by side,
# the size of their tail, the largest value, where the piece begins. NULL where the law is not
# finite. The ends of a piece are never sampled: a law may jump there.
fit_pieces <- function(at, from, to) {
  n <- sample_degree + 1L
  odd <- 2 * rev(seq_len(n)) - 1 # the times of a piece increase
  half <- (to - from) / 2
  value <- as.matrix(at(as.vector(outer(half, cospi(odd / (2 * n))) + (from + half))))
  if (!all(is.finite(value))) return(NULL)
  # Whole turns are taken off as integers: else the rounding of 32 half turns is the largest error.
  turn <- cospi((outer(odd, 0:sample_degree) %% (4 * n)) / (2 * n))
  each <- lapply(seq_len(ncol(value)), function(k) {
    y <- matrix(value[, k], length(from))
    a <- (2 / n) * y %*% turn
    a[, 1] <- a[, 1] / 2
    # Coefficients of a smooth law fall geometrically: the last four stand for all that follow.
    tail <- 2 * apply(abs(a[, n - 0:3, drop = FALSE]), 1, max)
    a[abs(a) < 2.5e-16 * apply(abs(a), 1, max)] <- 0 # rounding: 33 of them would add up
    list(a = a, tail = tail, height = apply(abs(y), 1, max))
  })
  worst <- function(name) cbind(do.call(pmax, lapply(each, `[[`, name)))
  list(
    a = do.call(cbind, lapply(each, `[[`, "a")), tail = worst("tail"), height = worst("height"),
    from = cbind(from)
  )
}

# The samples of a law, compared with the law on the grid of its scan. What lies between the nodes
# of the samples shows there, and the law is sampled anew around it. NULL as sample_torque().
sample_and_compare <- function(reader, resolution, span, seen, accuracy, maximum = max_samples) {
  stops <- seen$stops
  time_s <- seen$time_s
  value <- seen$torque_n_m
  for (round in 1:8) {
    sampled <- sample_torque(reader, span, stops, accuracy, maximum)
    if (is.null(sampled)) return(NULL)
    if (is.null(time_s)) { # breaks were given: not the grid's own points, which they may be
      n <- scan_points_of(resolution)
      time_s <- span[1] + diff(span) * (seq_len(n) - 0.5) / n
      value <- reader$at(time_s)
    }
    agrees <- abs(as.matrix(value) - samples_at(sampled, time_s)) <= 8 * sampled$error
    # A time at a break has two values.
    missed <- which(rowSums(!(agrees & !is.na(agrees))) > 0 & !time_s %in% stops)
    if (!length(missed)) {
      sampled$stops <- stops
      return(sampled)
    }
    beside <- c(missed - 1L, missed, missed + 1L)
    beside <- unique(beside[beside >= 1L & beside <= length(time_s)])
    stops <- in_order(unique(c(stops, time_s[beside])))
  }
  NULL
}

# The samples as a law of one number, with the stops of the integrator and their error.
sampled_law <- function(sampled) {
  term <- sampled$terms[[1]]
  term$stops_s <- as.double(sampled$stops)
  term$noise_n_m <- sampled$error
  term
}

# A column for each number of the law.
samples_at <- function(sampled, time_s) {
  each <- lapply(sampled$terms, function(term) .Call(ffi_law_values, term, time_s))
  matrix(unlist(each), length(time_s))
}
