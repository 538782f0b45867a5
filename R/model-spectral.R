# An axle under an R function of time, angle and rate, by collocation at Gauss's nodes on panels
# that are long: dozens of nodes, one call of the function for all of a panel's nodes.
#
#   theta' = omega, omega' = g(t),  g(t_i) = G(t_i, theta(t_i), omega(t_i)) at n nodes of a panel
#
# g is a polynomial; theta and omega are its integrals. Newton's method with derivatives of G by
# differences on the coarsest level, and by Broyden's update at each node after that. A polynomial
# of 32 coefficients over a panel has a fourth of the evaluations that an Adams method of order 12
# needs for the same digits, so four sweeps are as dear. What was evaluated before foresees the next
# panel where the law is near to powers or harmonics of the state: then one sweep or two.

# Nodes of a panel: on the way up from nothing, and where a good guess says how many it takes.
spectral_levels <- c(8L, 16L, 32L)
spectral_fine_levels <- c(8L, 12L, 16L, 20L, 24L, 28L, 32L)

# Sums of 32 terms have a noise of some 1e-15: below, neither tail nor Newton's step falls further.
spectral_floor <- 2e-14

# ---- matrices, made once ------------------------------------------------------------------------

spectral_cache <- new.env(parent = emptyenv())

# Legendre polynomials of degree 0 to n at x, a column each.
legendre <- function(x, n) {
  p <- matrix(1, length(x), n + 1L)
  if (n >= 1L) p[, 2] <- x
  for (k in seq_len(max(0L, n - 1L))) {
    p[, k + 2L] <- ((2 * k + 1) * x * p[, k + 1L] - k * p[, k]) / (k + 1)
  }
  p
}

# Coefficients of the integral from -1: one row more than there are columns.
legendre_integral <- function(n) {
  b <- matrix(0, n + 1L, n)
  b[1:2, 1] <- 1
  for (k in seq_len(n - 1L)) {
    b[k + 2L, k + 1L] <- 1 / (2 * k + 1)
    b[k, k + 1L] <- -1 / (2 * k + 1)
  }
  b
}

# Nodes x, `to`: values to coefficients, `once` and `twice`: values to the integrals at the nodes,
# `end`: to both integrals at x = 1 (two rows).
spectral_matrices <- function(n) {
  name <- as.character(n)
  kept <- spectral_cache[[name]]
  if (!is.null(kept)) {
    return(kept)
  }
  x <- -cos(pi * (seq_len(n) - 0.25) / (n + 0.5))
  for (i in 1:6) {
    p <- legendre(x, n)
    slope <- n * (x * p[, n + 1L] - p[, n]) / (x^2 - 1)
    x <- x - p[, n + 1L] / slope
  }
  x <- (x - rev(x)) / 2
  p <- legendre(x, n + 2L)
  slope <- n * (x * p[, n + 1L] - p[, n]) / (x^2 - 1)
  weight <- 2 / ((1 - x^2) * slope^2)
  to <- (2 * seq_len(n) - 1) / 2 * t(p[, seq_len(n)] * weight)
  first <- legendre_integral(n)
  second <- legendre_integral(n + 1L) %*% first
  made <- list(
    x = x, to = to, first = first, second = second, half = min(n, 4L),
    once = p[, seq_len(n + 1L)] %*% first %*% to,
    twice = p[, seq_len(n + 2L)] %*% second %*% to,
    end = rbind(colSums(second) %*% to, colSums(first) %*% to)
  )
  assign(name, made, envir = spectral_cache)
  made
}

# Values at the nodes of one level to values at others, x in [-1, 1] of the first.
spectral_move <- function(n, x) legendre(x, n - 1L) %*% spectral_matrices(n)$to

spectral_up <- function(n, finer) {
  name <- paste(n, finer)
  kept <- spectral_cache[[name]]
  if (is.null(kept)) {
    kept <- spectral_move(n, spectral_matrices(finer)$x)
    assign(name, kept, envir = spectral_cache)
  }
  kept
}

# ---- the right-hand side ------------------------------------------------------------------------

# All torques but the law and the resistance, at times inside one piece: no time is a break.
known_torque <- function(loads, time_s, theta, omega) {
  total <- knots_torque(loads$knots, time_s) - loads$motor_n_m_s * omega
  for (term in loads$terms) {
    acts <- time_s >= term$from_s & time_s < term$to_s
    total <- total + ifelse(acts, term_torque(term, time_s, theta), 0)
  }
  total
}

knots_torque <- function(knots, time_s) {
  t <- knots$time_s
  n <- length(t)
  i <- findInterval(time_s, t)
  if (n < 2L) {
    return(knots$outside[1L + (i > 0L)])
  }
  at <- pmin(pmax(i, 1L), n - 1L)
  share <- (time_s - t[at]) / (t[at + 1L] - t[at])
  inside <- (1 - share) * knots$torque_n_m[at] + share * knots$torque_n_m[at + 1L]
  ifelse(i == 0L, knots$outside[1], ifelse(i == n, knots$outside[2], inside))
}

term_torque <- function(term, time_s, theta) {
  x <- term$x
  switch(term$kind,
    sinusoid = x[1] * cos(x[2] * time_s + x[3]),
    exponential = x[1] * exp(-x[2] * (time_s - x[3])),
    polynomial = polynomial_torque(x, time_s),
    spring = -x[1] * (theta - x[2]),
    gravity = -x[1] * sin(theta - x[2])
  )
}

polynomial_torque <- function(x, time_s) {
  pieces <- x[1]
  degree <- x[2]
  breaks <- x[2 + seq_len(pieces + 1)]
  a <- matrix(x[-seq_len(3 + pieces)], pieces, degree, byrow = TRUE)
  i <- findInterval(time_s, breaks)
  at <- pmin(pmax(i, 1L), pieces)
  s <- time_s - breaks[at]
  sum <- a[at, degree]
  for (k in rev(seq_len(degree - 1L))) sum <- sum * s + a[at, k]
  ifelse(i < 1L | i > pieces, 0, sum)
}

# The law at points, counted. It is called once for all of them where it takes vectors: found out at
# the first points, where it must give the same numbers as one by one.
spectral_law <- function(f, complain) {
  calls <- 0
  vectors <- NA
  one <- function(t, theta, omega) {
    value <- f(t, theta, omega)
    number <- is.numeric(value) || (is.logical(value) && identical(is.na(value), TRUE))
    if (!number || is.object(value) || length(value) != 1L) {
      return(as.double(complain(value, t)))
    }
    as.double(value)
  }
  one_by_one <- function(t, theta, omega) {
    calls <<- calls + length(t)
    vapply(seq_along(t), function(i) one(t[i], theta[i], omega[i]), double(1))
  }
  fits <- function(value, n) is.double(value) && length(value) == n && !is.object(value)
  at <- function(t, theta, omega) {
    n <- length(t)
    if (is.na(vectors)) {
      state <- list(theta0_rad = theta, omega0_rad_per_s = omega)
      value <- values_at_once(f, t, state)
      vectors <<- !is.null(value)
      if (vectors) {
        calls <<- calls + n
        probe <- c(1L, (n + 1L) %/% 2L, n)
        vectors <<- identical(value[probe], one_by_one(t[probe], theta[probe], omega[probe]))
      }
    } else if (vectors) {
      value <- f(t, theta, omega)
      calls <<- calls + n
      vectors <<- fits(value, n)
    }
    if (vectors) as.vector(value) else one_by_one(t, theta, omega)
  }
  list(at = at, calls = function() calls)
}

# ---- one panel ----------------------------------------------------------------------------------

# What the last four coefficients of g leave out: if those before them are not much larger, as much
# again and more.
coefficient_tail <- function(a) {
  n <- length(a)
  last <- max(abs(a[n - 0:3]))
  before <- max(abs(a[n - 4:7]), 1e-300)
  last * min(1, max(2 * last / before, 0.3))
}

# The state at the nodes.
state_on <- function(m, panel, g) {
  h <- panel$half
  list(
    theta = panel$theta + h * (m$x + 1) * panel$omega + h^2 * as.vector(m$twice %*% g),
    omega = panel$omega + h * as.vector(m$once %*% g)
  )
}

# Derivatives of G by differences: two more evaluations at each node, in one call.
differences <- function(rhs, t, state, g, scale) {
  n <- length(t)
  step <- 1e-6 * scale
  moved <- rhs(
    c(t, t), c(state$theta + step[1], state$theta), c(state$omega, state$omega + step[2])
  )
  list(
    theta = (moved[seq_len(n)] - g) / step[1],
    omega = (moved[n + seq_len(n)] - g) / step[2]
  )
}

# Broyden's update at each node: the smallest change, in the motion's own scales, that explains what
# G did between two sweeps.
learn <- function(slope, d_theta, d_omega, d_g, scale) {
  u <- d_theta / scale[1]
  v <- d_omega / scale[2]
  square <- u^2 + v^2
  miss <- d_g - slope$theta * d_theta - slope$omega * d_omega
  gain <- ifelse(square > 1e-24, miss / pmax(square, 1e-24), 0)
  list(theta = slope$theta + gain * u / scale[1], omega = slope$omega + gain * v / scale[2])
}

# Newton's correction of g, and how g answers to a change of theta and of omega at the start.
linear_solve <- function(m, half, slope, residual) {
  a <- -half * slope$omega * m$once - half^2 * slope$theta * m$twice
  diag(a) <- diag(a) + 1
  answer <- tryCatch(
    solve.default(a, cbind(residual, slope$theta, slope$theta * half * (m$x + 1) + slope$omega)),
    error = function(e) NULL
  )
  if (is.null(answer) || !all(is.finite(answer))) NULL else answer
}

# Solves a panel = list(start, half, theta, omega). `tolerance`: the largest error in theta and
# omega, relative to their sizes; `scale`: the sizes so far. list(ok, ...): with ok = TRUE the
# polynomial and what is known of its error; else `shrink`, the factor to try next, and a guess.
solve_panel <- function(rhs, panel, guess, tolerance, scale, levels = spectral_levels) {
  top <- levels[length(levels)]
  half <- panel$half
  level <- guess$n
  g <- guess$g
  slope <- guess$slope
  rho <- guess$rho
  repeat {
    m <- spectral_matrices(level)
    t <- panel$start + half * (m$x + 1)
    before <- NULL
    sweep <- 0L
    repeat {
      sweep <- sweep + 1L
      state <- state_on(m, panel, g)
      here <- pmax(scale, c(max(abs(state$theta)), max(abs(state$omega))))
      value <- rhs(t, state$theta, state$omega)
      if (!all(is.finite(value))) {
        return(list(ok = FALSE, shrink = 0.3))
      }
      here <- pmax(here, 0.01 * max(abs(value)) * c(half^2, abs(half)), 1e-300)
      # By the size later, a motion that grows would be wrong from the start.
      wanted <- tolerance * ifelse(scale > 0, pmin(here, 4 * scale), here)
      spread <- pmax(
        c(diff(range(state$theta)), diff(range(state$omega))), 1e-3 * here, 1e-300
      )
      if (is.null(slope)) {
        slope <- differences(rhs, t, state, value, pmax(spread, here * 0.01))
      } else if (!is.null(before)) {
        slope <- learn(
          slope, state$theta - before$theta, state$omega - before$omega, value - before$value,
          spread
        )
      }
      answer <- linear_solve(m, half, slope, value - g)
      if (is.null(answer)) {
        return(list(ok = FALSE, shrink = 0.5))
      }
      step <- answer[, 1]
      g <- g + step
      moved <- max(
        half^2 * max(abs(m$twice %*% step)) / wanted[1],
        abs(half) * max(abs(m$once %*% step)) / wanted[2]
      )
      # Slopes that are far too steep make any step small: what is left over must be small, too.
      over <- value - g + step
      over <- max(
        half^2 * max(abs(m$twice %*% over)) / wanted[1],
        abs(half) * max(abs(m$once %*% over)) / wanted[2]
      )
      if (!is.null(before)) rho <- min(0.5, max(0.002, moved / before$moved))
      left <- moved * rho
      a <- as.vector(m$to %*% g)
      tail <- coefficient_tail(a)
      # In units of what is wanted: omega gains a factor 2 n by integration, theta another.
      open <- max(tail * c(half^2 / (4 * level^2), abs(half) / (2 * level)) / wanted)
      if (!is.finite(left + open)) {
        return(list(ok = FALSE, shrink = 0.3))
      }
      close <- max(left, 0.03 * rho * over)
      if (close <= 0.3 || (level < top && close <= 0.3 * open)) break
      if (sweep >= 8L || (!is.null(before) && moved > 0.7 * before$moved)) {
        return(list(ok = FALSE, shrink = 0.5))
      }
      before <- c(state, list(value = value, moved = moved))
    }
    if (open <= 1 && close <= 0.3) {
      return(list(
        ok = TRUE, n = level, a = a, g = g, slope = slope, answer = answer, tail = tail,
        open = open, left = left, rho = rho, state = state, t = t, value = value, sweeps = sweep,
        wanted = wanted, half = half,
        moved = max(moved, 0.1 * over)
      ))
    }
    # What the tail will be at the top, if it goes on falling as it does.
    size <- max(abs(a))
    fall <- (tail / size)^(1 / level)
    foreseen <- open * fall^(top - level)
    if (level >= top || (level >= 16L && foreseen > 100)) {
      shrink <- if (level >= top) 0.9 * open^(-1 / level) else 0.9 * foreseen^(-1 / top)
      return(list(
        ok = FALSE, shrink = min(0.85, max(0.3, shrink)), n = level, g = g, slope = slope, rho = rho
      ))
    }
    up <- levels[levels > level][1]
    move <- spectral_up(level, up)
    g <- as.vector(move %*% g)
    slope <- lapply(slope, function(s) as.vector(move %*% s))
    rho <- max(rho, 0.02)
    level <- up
  }
}

# The same polynomial on the first part of a panel.
shrink_guess <- function(failed, shrink) {
  if (is.null(failed$g)) {
    return(NULL)
  }
  n <- failed$n
  move <- spectral_move(n, shrink * (spectral_matrices(n)$x + 1) - 1)
  list(
    n = n, g = as.vector(move %*% failed$g),
    slope = lapply(failed$slope, function(s) as.vector(move %*% s)), rho = 0.05
  )
}

# ---- a guess at the law -------------------------------------------------------------------------

# What was evaluated on the way tells what the law will be nearby, and on the next turn: least
# squares of G over the last points, in powers of the state or in harmonics of the angle, with
# powers of time or with one frequency. It gives first guesses, never a result: a wrong guess costs sweeps.
# The kind that foresaw the last panels best serves the next.
guess_kinds <- 4L
guess_points <- 160L

guess_state <- function(kind, theta, omega, scale) {
  u <- (theta - scale$theta[1]) / scale$theta[2]
  v <- (omega - scale$omega[1]) / scale$omega[2]
  if (kind %in% c(1L, 3L)) {
    cbind(1, u, v, u^2, u * v, v^2, u^3, u^2 * v, u * v^2, v^3, u^4, u^5)
  } else {
    a <- cos(theta)
    b <- sin(theta)
    cbind(
      1, a, b, v, v^2, a * v, b * v, v^3, a * v^2, b * v^2, cos(2 * theta), sin(2 * theta)
    )
  }
}

guess_time <- function(kind, t, scale, frequency) {
  s <- (t - scale$t[1]) / scale$t[2]
  if (kind < 3L) cbind(s, s^2, s^3) else cbind(cos(frequency * s), sin(frequency * s))
}

# The frequency (per unit of s, which goes from -1 to 1 over the points) of the wave that, with the
# state, leaves least of the values: on a grid, then between two of its points.
guess_frequency <- function(state, s, value) {
  decomposed <- qr.default(state, tol = 1e-6)
  if (!all(is.finite(decomposed$qr))) {
    return(1) # at rest: columns of nothing but zeros
  }
  q <- qr.Q(decomposed)
  off <- function(x) x - q %*% crossprod(q, x)
  rest <- off(value)
  # Sums of squares explained by a cosine and a sine of each frequency.
  gain <- function(f) {
    a <- off(cos(outer(s, f)))
    b <- off(sin(outer(s, f)))
    aa <- colSums(a^2) + 1e-9
    bb <- colSums(b^2) + 1e-9
    ab <- colSums(a * b)
    ay <- as.vector(crossprod(a, rest))
    by <- as.vector(crossprod(b, rest))
    (bb * ay^2 - 2 * ab * ay * by + aa * by^2) / pmax(aa * bb - ab^2, 1e-18)
  }
  grid <- 1.12^(0:34)
  best <- which.max(gain(grid))
  low <- grid[max(1L, best - 1L)]
  high <- grid[min(length(grid), best + 1L)]
  stats::optimize(gain, c(low, high), maximum = TRUE, tol = 1e-10 * high)$maximum
}

# A function(t, theta, omega) that guesses G.
guess_law <- function(kind, points) {
  spread <- function(x) {
    size <- max(x) - min(x)
    c(min(x) + size / 2, if (size > 0) size / 2 else 1)
  }
  scale <- lapply(points[c("t", "theta", "omega")], spread)
  state <- guess_state(kind, points$theta, points$omega, scale)
  frequency <- if (kind > 2L) {
    guess_frequency(state, (points$t - scale$t[1]) / scale$t[2], points$value)
  }
  weight <- qr.coef(
    qr.default(cbind(state, guess_time(kind, points$t, scale, frequency)), tol = 1e-6),
    points$value
  )
  weight[is.na(weight)] <- 0
  function(t, theta, omega) {
    basis <- cbind(guess_state(kind, theta, omega, scale), guess_time(kind, t, scale, frequency))
    as.vector(basis %*% weight)
  }
}

# Solves a panel of a guessed law: that is free, so the panel is made as long as it allows. NULL if
# it cannot be solved.
solve_guessed <- function(law, panel, guess, tolerance, scale) {
  for (i in 1:12) {
    solved <- solve_panel(law, panel, guess, tolerance, scale, spectral_fine_levels)
    if (solved$ok) {
      return(solved)
    }
    guess <- shrink_guess(solved, solved$shrink)
    if (is.null(guess)) guess <- fresh_guess(panel$last)
    panel$half <- panel$half * solved$shrink
  }
  NULL
}

fresh_guess <- function(value) list(n = 8L, g = rep(value, 8L), slope = NULL, rho = 0.3)

# theta, omega and g of a solved panel at x in [-1, 1]; `from`: the state at its start.
panel_at <- function(solved, from, x) {
  m <- spectral_matrices(solved$n)
  p <- legendre(x, solved$n + 1L)
  half <- solved$half
  list(
    theta = from$theta + half * (x + 1) * from$omega +
      half^2 * as.vector(p %*% (m$second %*% solved$a)),
    omega = from$omega + half * as.vector(p[, seq_len(solved$n + 1L)] %*% (m$first %*% solved$a)),
    g = as.vector(p[, seq_len(solved$n), drop = FALSE] %*% solved$a)
  )
}

# What a guessed law misses is smoother than the law: eight points of the panel, then sixteen, tell
# most of it. list(solved, miss: how far the law was off at the first points)
correct_guess <- function(law, solved, panel, rhs, tolerance, scale) {
  miss <- NULL
  counts <- c(8L, 8L, 16L)
  for (n in counts[counts < solved$n]) {
    x <- spectral_matrices(n)$x
    panel$half <- solved$half
    t <- panel$start + panel$half * (x + 1)
    at <- panel_at(solved, panel, x)
    off <- rhs(t, at$theta, at$omega) - law(t, at$theta, at$omega)
    if (!all(is.finite(off))) break
    size <- max(abs(off)) / max(abs(solved$g), 1e-300)
    if (is.null(miss)) miss <- size
    law <- add_in_time(law, as.vector(spectral_matrices(n)$to %*% off), panel)
    better <- solve_guessed(
      law, panel, list(n = solved$n, g = solved$g, slope = NULL, rho = 0.05), tolerance, scale
    )
    if (is.null(better)) break
    solved <- better
    if (size < 30 * tolerance) break
  }
  list(solved = solved, miss = miss)
}

add_in_time <- function(law, a, panel) {
  force(law) # or it would be the sum itself, later
  force(panel)
  degree <- length(a) - 1L
  function(t, theta, omega) {
    x <- (t - panel$start) / panel$half - 1
    law(t, theta, omega) + as.vector(legendre(x, degree) %*% a)
  }
}

# ---- the march ----------------------------------------------------------------------------------

# What one run carries from panel to panel.
new_march <- function(rhs, tolerance) {
  march <- new.env(parent = emptyenv())
  march$rhs <- rhs
  march$tolerance <- tolerance
  march$panels <- list()
  march$rejected <- 0L
  march$size <- NULL
  march$error <- c(0, 0)
  march
}

forget <- function(march) {
  march$points <- NULL
  march$score <- rep(1, guess_kinds)
  march$judged <- 0L
  march$rho <- 0.1
  march$skip <- FALSE
}

remember <- function(march, seen) {
  last <- function(x) x[seq.int(max(1L, length(x) - guess_points + 1L), length(x))]
  # A sweep that went astray may have seen what is no state; nothing is learnt from it.
  good <- Reduce(`&`, lapply(seen, function(x) abs(x) < 1e150)) # NaN is not
  good <- good & !is.na(good)
  if (!any(good)) {
    return()
  }
  seen <- lapply(seen, `[`, good)
  march$points <- lapply(if (is.null(march$points)) seen else Map(c, march$points, seen), last)
}

# A panel's guess from the law guessed, or from nothing.
guess_panel <- function(march, panel, rest) {
  laws <- NULL
  if (length(march$points$t) >= 24L) {
    # A wave is looked for where powers of time do not do.
    kinds <- if (min(march$score[1:2]) < 1e-6) 1:2 else seq_len(guess_kinds)
    if (march$judged > 5L) kinds <- order(march$score[kinds])[1:2]
    laws <- vector("list", guess_kinds)
    laws[kinds] <- lapply(kinds, guess_law, march$points)
    best <- kinds[which.min(march$score[kinds])]
  }
  solved <- NULL
  if (!is.null(laws) && march$score[best] < 0.1) {
    long <- panel
    long$half <- sign(panel$half) * min(1.5 * abs(panel$half), abs(rest) / 2)
    solved <- solve_guessed(
      laws[[best]], long, fresh_guess(panel$last), march$tolerance, march$size
    )
  }
  if (is.null(solved)) {
    return(list(panel = panel, guess = fresh_guess(panel$last), laws = laws))
  }
  miss <- NULL
  if (!march$skip) {
    long$half <- solved$half
    corrected <- correct_guess(
      laws[[best]], solved, long, march$seeing, march$tolerance, march$size
    )
    solved <- corrected$solved
    miss <- corrected$miss
  }
  panel$half <- solved$half
  # Derivatives at every node are free here. Those from eight nodes make a flow that is off by a
  # hundredth, and after 20 panels an error figure that is 1e4 times too large.
  x <- spectral_matrices(solved$n)$x
  at <- panel_at(solved, panel, x)
  t <- panel$start + panel$half * (x + 1)
  spread <- pmax(c(diff(range(at$theta)), diff(range(at$omega))), 1e-3 * march$size, 1e-300)
  slope <- differences(
    laws[[best]], t, at, laws[[best]](t, at$theta, at$omega), 10 * spread
  )
  guess <- list(n = solved$n, g = solved$g, slope = slope, rho = march$rho)
  list(panel = panel, guess = guess, laws = laws, miss = miss, guessed = TRUE)
}

# How well each guessed law foresaw what was then seen.
judge <- function(march, laws, seen) {
  first <- seq_len(min(32L, length(seen$t)))
  spread <- stats::sd(march$points$value)
  march$judged <- march$judged + 1L
  for (i in which(lengths(laws) > 0L)) {
    off <- laws[[i]](seen$t[first], seen$theta[first], seen$omega[first]) - seen$value[first]
    off <- sqrt(mean(off^2)) / max(spread, 1e-300)
    march$score[i] <- sqrt(min(10, max(1e-12, off)) * march$score[i])
  }
}

# From the state (t, theta, omega) to `to`, with no break in between. The state there, or NULL.
march_stretch <- function(march, from, to, half, tell) {
  forget(march)
  guess <- NULL
  while (from$t != to) {
    rest <- to - from$t
    seen <- NULL
    march$seeing <- function(t, theta, omega) {
      value <- march$rhs(t, theta, omega)
      new <- list(t = t, theta = theta, omega = omega, value = value)
      seen <<- if (is.null(seen)) new else Map(c, seen, new)
      value
    }
    panel <- list(
      start = from$t, half = sign(rest) * min(abs(half), abs(rest) / 2), theta = from$theta,
      omega = from$omega, last = from$last
    )
    plan <- list(panel = panel, guess = guess)
    if (is.null(guess)) plan <- guess_panel(march, panel, rest)
    panel <- plan$panel
    solved <- solve_panel(march$seeing, panel, plan$guess, march$tolerance, march$size,
                          if (isTRUE(plan$guessed)) spectral_fine_levels else spectral_levels)
    if (!is.null(plan$laws) && all(is.finite(seen$value))) judge(march, plan$laws, seen)
    if (all(is.finite(seen$value))) remember(march, seen)
    march$skip <- FALSE
    if (!solved$ok) {
      march$rejected <- march$rejected + 1L
      half <- panel$half * solved$shrink
      guess <- shrink_guess(solved, solved$shrink)
      tiny <- abs(half) <= 1e-9 * abs(rest) && abs(half) < 1e-9 * march$span
      if (tiny || march$rejected > 25L + length(march$panels) / 2 || march$spent()) {
        return(NULL)
      }
      next
    }
    guess <- NULL
    if (isTRUE(plan$guessed)) {
      if (solved$sweeps > 1L) march$rho <- max(0.01, min(0.2, solved$rho))
      # As good as the law itself: the next panel needs no look before.
      march$skip <- solved$sweeps == 1L && (is.null(plan$miss) || plan$miss < 30 * march$tolerance)
    }
    half <- panel$half * min(1.3, 0.92 * (solved$open + 1e-6)^(-1 / solved$n))
    from <- accept_panel(march, panel, solved, to)
    tell(from$t)
    if (march$error_figure() > march$accuracy || march$spent()) {
      return(NULL)
    }
  }
  from
}

# The state at the end of a panel; its error and those before it carried there.
accept_panel <- function(march, panel, solved, to) {
  m <- spectral_matrices(solved$n)
  h <- panel$half
  state <- solved$state
  end <- m$end %*% cbind(solved$g, solved$answer[, 2:3])
  theta <- panel$theta + 2 * h * panel$omega + h^2 * end[1, 1]
  omega <- panel$omega + h * end[2, 1]
  largest <- pmax(
    abs(c(theta, omega)), c(max(abs(state$theta)), max(abs(state$omega)))
  )
  march$size <- pmax(march$size, largest)
  # The linear flow, to the end and to nodes on the way.
  answer <- solved$answer[, 2:3]
  flow <- rbind(c(1, 2 * h), c(0, 1)) + rbind(h^2 * end[1, 2:3], h * end[2, 2:3])
  local <- local_error(panel, solved, largest)
  at <- c(1L, solved$n %/% 4L, solved$n %/% 2L, (3L * solved$n) %/% 4L, solved$n)
  of_theta <- cbind(1, h * (m$x + 1))[at, ] + h^2 * (m$twice[at, ] %*% answer)
  of_omega <- cbind(0, rep(1, 5)) + h * (m$once[at, ] %*% answer)
  if (length(march$sources)) {
    inside <- c(
      max(rowSums(abs(of_theta %*% march$sources))), max(rowSums(abs(of_omega %*% march$sources)))
    )
  } else {
    inside <- c(0, 0)
  }
  march$sources <- cbind(flow %*% march$sources, diag(local$end))
  if (ncol(march$sources) > 400L) march$sources <- merge_sources(march$sources)
  march$error <- pmax(march$error, inside + local$inside, rowSums(abs(march$sources)))
  end_t <- panel$start + 2 * h
  if (abs(to - end_t) <= 1e-12 * abs(h)) end_t <- to
  march$panels[[length(march$panels) + 1L]] <- list(
    start = panel$start, end = end_t, half = h, theta = panel$theta, omega = panel$omega,
    n = solved$n, a = solved$a, largest = largest
  )
  list(t = end_t, theta = theta, omega = omega, last = sum(solved$a))
}

# Of many small errors, the older half as two that are as large along each axis.
merge_sources <- function(sources) {
  half <- ncol(sources) %/% 2L
  old <- rowSums(abs(sources[, seq_len(half)]))
  cbind(diag(old), sources[, -seq_len(half)])
}

# Errors that a panel adds inside and at its end: what the coefficients leave out, what Newton left,
# and rounding, of times too. Gauss's nodes integrate the tail to twice the order, so less of it
# arrives at the end.
local_error <- function(panel, solved, largest) {
  h <- abs(panel$half)
  n <- solved$n
  cut <- 2 * solved$tail * c(h^2 / (4 * n^2), h / (2 * n))
  left <- solved$moved * max(3 * solved$rho, 0.02) * solved$wanted
  rate <- c(largest[2], max(abs(solved$value)))
  rounding <- 4e-16 * largest + 1.2e-16 * (abs(panel$start) + h) * rate
  list(inside = cut + left + 3 * rounding, end = 0.3 * cut + left + rounding)
}

# How long the first panel may be: the rates of the law at the start.
first_half <- function(rhs, from, to) {
  t <- from$t + 1e-9 * (to - from$t)
  step <- 1e-6 * c(max(1, abs(from$theta)), max(1, abs(from$omega)))
  value <- rhs(rep(t, 3L), from$theta + c(0, step[1], 0), from$omega + c(0, 0, step[2]))
  if (!all(is.finite(value))) {
    return(NULL)
  }
  rate <- max(sqrt(abs(value[2] - value[1]) / step[1]), abs(value[3] - value[1]) / step[2])
  list(half = min(abs(to - from$t) / 2, 1.5 / rate), value = value[1])
}

# ---- a run --------------------------------------------------------------------------------------

# Panels over all times asked for, backwards from the start and forwards; NULL where it is not to
# be had.
march_spectral <- function(scene, rhs, breaks, time_s, accuracy, tolerance, spent) {
  march <- new_march(rhs, tolerance)
  march$accuracy <- accuracy
  march$spent <- spent
  start <- list(t = scene$start_s, theta = scene$theta0_rad, omega = scene$omega0_rad_per_s)
  march$size <- abs(c(start$theta, start$omega))
  march$span <- diff(range(start$t, time_s))
  march$error_figure <- function() max(ifelse(march$error > 0, march$error / march$size, 0))
  bar <- progress_bar("collocation")
  done <- 0
  worst <- c(0, 0)
  for (target in range(time_s)) {
    forward <- target > start$t
    if (target == start$t || (forward && target != max(time_s)) ||
          (!forward && target != min(time_s))) {
      next
    }
    stops <- breaks[breaks > min(start$t, target) & breaks < max(start$t, target)]
    stops <- c(sort(stops, decreasing = !forward), target)
    from <- start
    march$sources <- matrix(0, 2L, 0L)
    half <- Inf
    for (stop in stops) {
      first <- first_half(rhs, from, stop)
      if (is.null(first)) {
        return(NULL)
      }
      from$last <- first$value
      begun <- from$t
      from <- march_stretch(march, from, stop, min(half, first$half), function(t) {
        bar((done + abs(t - begun)) / march$span)
      })
      if (is.null(from)) {
        return(if (march$error_figure() > accuracy && !spent()) march)
      }
      done <- done + abs(stop - begun)
    }
  }
  march$complete <- TRUE
  march
}

run_spectral <- function(scene, time_s, accuracy, max_steps, call) {
  torque <- scene$loads$law
  complain <- function(value, time_s) abort_torque_value(value, time_s, call)
  own <- torque_breaks(torque, scene, time_s, complain, call)
  scene$loads$law$breaks_s <- own # looked for once, whoever runs on
  law <- spectral_law(torque$f, complain)
  inertia <- scene$moment_of_inertia_kg_m2
  viscous <- viscous_of(scene)
  loads <- scene$loads
  plain <- length(loads$terms) == 0L && length(loads$knots$time_s) == 0L &&
    all(loads$knots$outside == 0) && loads$motor_n_m_s == 0
  rhs <- function(t, theta, omega) {
    value <- law$at(t, theta, omega)
    if (!plain) value <- value + known_torque(loads, t, theta, omega)
    (value - viscous * omega) / inertia
  }
  spent <- function() law$calls() > max_steps
  march <- NULL
  if (length(time_s) && any(time_s != scene$start_s)) {
    breaks <- sort(unique(c(axle_breaks(scene), own)))
    # A digit more costs a tenth more, a second run as much again: so ask for more at once.
    tolerance <- max(0.003 * accuracy, spectral_floor)
    repeat {
      march <- march_spectral(scene, rhs, breaks, time_s, accuracy, tolerance, spent)
      if (is.null(march) || isTRUE(march$complete) || tolerance <= spectral_floor) break
      tolerance <- max(tolerance / 30, spectral_floor)
    }
  }
  if (!isTRUE(march$complete)) {
    result <- integrate_axle(scene, time_s, accuracy, max_steps, call, 0)
    result[[2]]$rhs_calls <- result[[2]]$rhs_calls + law$calls()
    return(result)
  }
  columns <- spectral_columns(scene, march, time_s)
  rows <- c(max(abs(columns$theta_rad)), max(abs(columns$omega_rad_per_s)))
  march$size <- pmax(march$size, rows) # between nodes it may be larger
  list(columns, spectral_info(march, time_s, law$calls()), NULL, NULL)
}

spectral_columns <- function(scene, march, time_s) {
  from <- vapply(march$panels, function(p) min(p$start, p$end), double(1))
  order <- order(from)
  panels <- march$panels[order]
  of <- pmax(1L, findInterval(time_s, from[order]))
  theta <- omega <- g <- double(length(time_s))
  for (rows in split(seq_along(time_s), of)) {
    panel <- panels[[of[rows[1]]]]
    x <- (time_s[rows] - panel$start) / panel$half - 1
    at <- panel_at(panel, panel, pmin(1, pmax(-1, x)))
    theta[rows] <- at$theta
    omega[rows] <- at$omega
    g[rows] <- at$g
  }
  start <- time_s == scene$start_s # a polynomial is exact nowhere
  theta[start] <- scene$theta0_rad
  omega[start] <- scene$omega0_rad_per_s
  inertia <- scene$moment_of_inertia_kg_m2
  net <- inertia * g
  damping <- 0 - viscous_of(scene) * omega
  list(
    time_s = time_s, theta_rad = theta, omega_rad_per_s = omega,
    applied_torque_n_m = net - damping, damping_torque_n_m = damping, net_torque_n_m = net,
    angular_momentum_kg_m2_per_s = inertia * omega,
    rotational_kinetic_energy_j = inertia * omega^2 / 2
  )
}

spectral_info <- function(march, time_s, calls) {
  info <- list(
    kind = "none", text = "ok", time_s = time_s[length(time_s)],
    rows_done = as.double(length(time_s)), steps = as.double(length(march$panels)),
    rejected = as.double(march$rejected), rhs_calls = as.double(calls),
    theta_error = march$error[1], omega_error = march$error[2],
    theta_max = march$size[1], omega_max = march$size[2], error = 0,
    tolerance = march$tolerance, method = "spectral"
  )
  info$error <- error_of_run(info)
  info
}

axle_spectral <- list(
  id = "axle_spectral", constraint = "axle",
  equations = "I domega/dt = torque(t, theta, omega) - c omega, by collocation on long panels",
  assumptions = "rigid body; torque finite, and smooth between its breaks in time",
  limits = "where the law is not smooth in angle and rate it hands over to axle_rk8pd",
  requires = "an R function of time, angle and rate; no friction, no quadratic drag",
  source = "Hairer, Lubich & Wanner 2006, section II.1 (Gauss collocation)",
  error_kind = "estimate",
  handles = c(
    "torque", "ramp", "sinusoid", "exponential", "polynomial", "spring", "gravity", "function",
    "viscous", "motor"
  ),
  why_not = function(scene, time_s) {
    law <- scene$loads$law
    if (is.null(law) || law$arguments != 3L) {
      "it is for a torque that is an R function of time, angle and rate"
    }
  },
  why = function(scene) {
    paste(
      "the torque is an R function of the state: long panels call it least often;",
      "where a call takes less than some 10 us, axle_rk8pd calls more and is done sooner"
    )
  },
  error = function(accuracy) max(accuracy, 1e-12),
  cost = function(scene, rows, accuracy) {
    panels <- 10 + length(axle_breaks(scene))
    2000 * 20 * max(1, -log10(accuracy)) * panels + 100 * rows
  },
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    run_spectral(scene, time_s, accuracy, max_steps, call)
  },
  ledger = function(scene, run, from_s, to_s) ledger_by_quadrature(scene, run, from_s, to_s)
)
