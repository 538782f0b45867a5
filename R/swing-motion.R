# The fit of a free motion to the samples of a interval, its noise, and the test of its law.

# In the order of the core. What each is called in a result.
swing_losses <- c("viscous", "coulomb", "quadratic")
swing_parts <- c(
  viscous = "decay_per_s", coulomb = "coulomb_rad_per_s2", quadratic = "quadratic_per_rad"
)
swing_parameters <- c(
  "theta", "omega", "omega0", "viscous", "coulomb", "quadratic", "offset"
)

swing_flags <- function(kind, restoring) {
  as.double(c(restoring == "spring", kind == "omega_rad_per_s"))
}

# Values at times and their derivatives by the seven parameters; NULL where there is no motion.
free_motion <- function(p, time, start, kind, restoring) {
  out <- .Call(ffi_swing_rows, as.double(p[1:6]), swing_flags(kind, restoring), start, time)
  if (out$status != 0) return(NULL)
  value <- out$value + p[[7]]
  derivative <- cbind(matrix(out$derivative, ncol = 6, byrow = TRUE), 1)
  if (!all(is.finite(value)) || !all(is.finite(derivative))) return(NULL)
  list(value = value, derivative = derivative)
}

# (times, their origin) => motion by its parameters, NULL away from the swings that were counted:
# their period is known to some per cent, and a half swing to a fifth of the one before is damped by
# less than half of omega0. Losses below 0 make limit cycles of any other omega0.
swing_model <- function(time, start, kind, restoring, best) {
  counted <- 2 * pi / best$period0
  function(p) {
    near <- p[[3]] > 0.8 * counted && p[[3]] < 1.25 * counted && abs(p[[4]]) < 0.6 * p[[3]]
    if (isTRUE(near)) free_motion(p, time, start, kind, restoring)
  }
}

# Levenberg and Marquardt with the core's derivatives, for the parameters `active`. NULL where it
# fails.
least_squares <- function(model, y, p, active, rounds = 60L) {
  now <- model(p)
  if (is.null(now)) return(NULL)
  floor <- length(y) * (4 * .Machine$double.eps * max(abs(y)))^2
  r <- y - now$value
  total <- sum(r^2)
  damp <- 1e-3
  for (round in seq_len(rounds)) {
    j <- now$derivative[, active, drop = FALSE]
    norm <- sqrt(colSums(j^2))
    norm[norm == 0] <- 1
    j <- sweep(j, 2, norm, "/")
    done <- FALSE
    for (try in 1:14) {
      a <- rbind(j, diag(sqrt(damp), length(active)))
      step <- qr.coef(qr(a, tol = 1e-14), c(r, rep(0, length(active))))
      if (!all(is.finite(step))) return(NULL)
      new <- p
      new[active] <- p[active] + step / norm
      trial <- model(new)
      sum <- if (is.null(trial)) Inf else sum((y - trial$value)^2)
      if (sum <= total) {
        small <- sum((j %*% step)^2) <= 1e-16 * total + floor
        p <- new
        now <- trial
        r <- y - now$value
        done <- damp < 1e-4 && (small || total - sum <= 1e-13 * total)
        total <- sum
        damp <- max(damp / 10, 1e-14)
        break
      }
      if (total <= floor || try == 14L) {
        done <- TRUE
        break
      }
      damp <- damp * 10
    }
    if (done) break
  }
  list(p = p, now = now, residual = r)
}

# ---- the noise ----------------------------------------------------------------------------------

# Means of `size` rows in a row: linear, so that a linear model stays one.
block_means <- function(x, size) {
  x <- as.matrix(x)
  if (size < 2L) return(x)
  group <- (seq_len(nrow(x)) - 1L) %/% size
  rowsum(x, group, reorder = FALSE) / as.vector(rowsum(rep(1, nrow(x)), group, reorder = FALSE))
}

whiten <- function(time, x, noise) {
  if (!(noise[["tau_s"]] > 0)) return(x)
  # The core takes a few columns at a time.
  for (first in seq(1L, ncol(x), by = 12L)) {
    some <- first:min(first + 11L, ncol(x))
    out <- .Call(ffi_whiten, time, as.double(t(x[, some])), unname(noise[c("tau_s", "white")]))
    x[, some] <- matrix(out, nrow(x), byrow = TRUE)
  }
  x
}

# The noise of the residuals r, with columns as fixed effects.
find_noise <- function(time, columns, r) {
  n <- length(time)
  # A drift slower than the swings is noise here: the law has a test of its own.
  cap <- (time[n] - time[1]) / 3
  out <- .Call(ffi_noise, time, as.double(t(columns)), as.double(r), c(cap, 2))
  if (out[5] != 0 || !all(is.finite(out))) out <- c(0, 1, 0, 0, 0)
  stats::setNames(out[1:4], c("tau_s", "white", "gain", "at_cap"))
}

# What a wrong law leaves over: slow changes of phase and amplitude beyond those fitted, and another
# form of the swing. As many columns as the interval has swings for.
misfit_columns <- function(time, now, offset, swings, kind) {
  x <- 2 * (time - time[1]) / (time[length(time)] - time[1]) - 1
  slow <- cbind(
    (3 * x^2 - 1) / 2, (5 * x^3 - 3 * x) / 2, (35 * x^4 - 30 * x^2 + 3) / 8
  )
  slow <- slow[, seq_len(min(3, max(floor(swings / 2) - 1, 0))), drop = FALSE]
  level <- (now$value - offset) / max(abs(now$value - offset))
  # The derivative by the phase: by omega0 over the time since the start, but for its start values.
  phase <- c(0, diff(level) / diff(time))
  phase[1] <- phase[2]
  phase <- phase / max(abs(phase))
  cbind(slow * phase, slow * level, if (swings >= 2) cbind(level^2, level^3))
}

# ---- the fit ------------------------------------------------------------------------------------

# NULL where no free motion fits. `start`: parameters to begin with.
fit_free_motion <- function(time, y, kind, restoring, losses, best, start) {
  n <- length(y)
  span <- time[n] - time[1]
  if (n < 10L || span < 1.4 * best$period) return(NULL)
  origin <- time[1]
  model <- function(at) swing_model(at, origin, kind, restoring, best)
  wanted <- 3 + match(intersect(swing_losses, losses), swing_losses)
  always <- c(1L, 2L, 3L, 7L)
  # First a few swings with one loss, then more of them, so that the phase stays known.
  p <- start
  end <- 4 * best$period
  repeat {
    rows <- which(time - origin <= end)
    if (length(rows) > 4000L) rows <- rows[unique(round(seq(1, length(rows), length.out = 4000)))]
    if (length(rows) >= 8L) {
      first <- least_squares(model(time[rows]), y[rows], p, c(always, wanted[1])[
        seq_len(4L + (length(wanted) > 0L))], 30L)
      if (!is.null(first)) p <- first$p
    }
    if (end >= span) break
    end <- 3 * end
  }
  thin <- if (n > 20000L) unique(round(seq(1, n, length.out = 20000))) else seq_len(n)
  active <- sort(c(always, wanted))
  fit <- least_squares(model(time[thin]), y[thin], p, active)
  if (is.null(fit)) return(NULL)
  finish_fit(time, y, kind, restoring, fit$p, active, best, model(time))
}

# From the minimum for white noise: the noise, the minimum for it, the verdict on the law, and the
# motion whose losses are not below 0.
finish_fit <- function(time, y, kind, restoring, p, active, best, model) {
  n <- length(y)
  size <- sqrt(2) * stats::sd(y)
  swings <- (time[n] - time[1]) / best$period
  now <- model(p)
  if (is.null(now)) return(NULL)
  r <- y - now$value
  rms <- sqrt(mean(r^2))
  if (rms > 0.1 * size) return(NULL)
  dw <- durbin_watson(r)
  # Long records in blocks: a fortieth of a period at most.
  block <- max(1L, min(n %/% 4096L, floor(n / swings / 40)))
  at <- block_means(time, block)[, 1]
  reduced <- function(now, active) block_means(now$derivative[, active, drop = FALSE], block)
  j <- reduced(now, active)
  e <- block_means(y - now$value, block)[, 1]
  # Rounding is no noise with a correlation.
  exact <- rms < 1e-9 * size
  extra <- block_means(misfit_columns(time, now, p[[7]], swings, kind), block)
  room <- min((length(at) - ncol(j)) %/% 3L, 15L - ncol(j))
  extra <- extra[, seq_len(min(ncol(extra), max(room, 0L))), drop = FALSE]
  noise <- if (exact) {
    c(tau_s = 0, white = 1, gain = 0, at_cap = 0)
  } else {
    find_noise(at, cbind(j, extra), e)
  }
  found <- settle(at, y, p, active, noise, model, block)
  if (is.null(found)) return(NULL)
  active <- found$active
  law <- law_test(at, found, extra, noise, exact, best$period)
  dof <- min(swing_dof(at, noise, length(active), best$period), law$dof)
  # Loss of at least 0: the motion that is shown.
  shown <- physical_motion(at, y, found, noise, model, block)
  joint <- numbers_at(shown$p, at, y, found, noise, model, block)
  white <- solve_linear(at, joint$j, joint$e, c(tau_s = 0, white = 1))
  if (is.null(white)) return(NULL)
  names <- swing_parameters[active]
  dimnames(joint$covariance) <- list(names, names)
  joint$covariance <- joint$covariance * law$inflation
  shown$covariance <- shown$covariance * law$inflation
  list(
    p = stats::setNames(joint$p, swing_parameters), covariance = joint$covariance,
    best = stats::setNames(shown$p, swing_parameters), best_active = shown$active,
    best_covariance = shown$covariance, white = sqrt(white$covariance[3, 3]), rms = rms,
    durbin_watson = dw, noise = noise, dof = dof, law_p = law$p, swings = swings, size = size,
    exact = exact,
    floor = 4 * .Machine$double.eps * joint$p[3]
  )
}

# Generalised least squares for given noise; NULL where the columns are dependent.
solve_linear <- function(time, j, e, noise) {
  k <- ncol(j)
  norm <- sqrt(colSums(j^2))
  if (any(norm == 0)) return(NULL)
  w <- whiten(time, cbind(sweep(j, 2, norm, "/"), e), noise)
  q <- qr(w[, seq_len(k), drop = FALSE], tol = 1e-11)
  if (q$rank < k) return(NULL)
  rest <- qr.resid(q, w[, k + 1L])
  variance <- sum(rest^2) / max(length(e) - k, 1)
  list(
    step = qr.coef(q, w[, k + 1L]) / norm, sigma = sqrt(variance), rest = sum(rest^2),
    covariance = variance * chol2inv(qr.R(q)) / outer(norm, norm)
  )
}

# A few Gauss-Newton steps to the minimum for the noise. Losses whose columns depend on those of
# others are left out, the last first.
settle <- function(at, y, p, active, noise, model, block) {
  now <- model(p)
  for (round in 1:6) {
    solved <- NULL
    repeat {
      j <- block_means(now$derivative[, active, drop = FALSE], block)
      e <- block_means(y - now$value, block)[, 1]
      solved <- solve_linear(at, j, e, noise)
      losses <- intersect(active, 4:6)
      if (!is.null(solved) || !length(losses)) break
      p[max(losses)] <- 0
      active <- setdiff(active, max(losses))
      now <- model(p)
      if (is.null(now)) return(NULL)
    }
    if (is.null(solved)) return(NULL)
    small <- max(abs(solved$step) / sqrt(diag(solved$covariance))) < 1e-4
    if (round == 6L || isTRUE(small) || !all(is.finite(solved$step))) break
    new <- p
    new[active] <- p[active] + solved$step
    trial <- model(new)
    if (is.null(trial)) return(NULL)
    p <- new
    now <- trial
  }
  list(
    p = p, active = active, covariance = solved$covariance, sigma = solved$sigma, j = j, e = e,
    rest = solved$rest
  )
}

# Waves at the frequencies around that of the swings, beyond those that slow changes of phase and
# amplitude have: at most 16 of the record's own frequencies, 0.3 to 2.7 times that of the swings.
nearby_waves <- function(time, period) {
  span <- time[length(time)] - time[1]
  swings <- span / period
  order <- c(rbind(1:8 + 2.5, -(1:8) - 2.5))
  cycles <- swings + order
  cycles <- cycles[cycles > 0.3 * swings & cycles < 2.7 * swings & cycles < length(time) / 4]
  if (!length(cycles)) return(matrix(0, length(time), 0L))
  angle <- outer(time - time[1], 2 * pi * cycles / span)
  cbind(cos(angle), sin(angle))
}

# Two ratios of variances after whitening. `inflation`: that of the residuals near the frequency of
# the swings over that of all, 1 where chance (0.01) explains it, with its degrees of freedom.
# `p`: the probability that a complete law leaves over as much in the misfit columns, by that noise.
law_test <- function(at, found, extra, noise, exact, period) {
  k <- ncol(found$j)
  n <- length(found$e)
  out <- list(p = NA_real_, inflation = 1, dof = Inf)
  if (exact) return(out)
  near <- nearby_waves(at, period)
  near <- near[, seq_len(min(ncol(near), max((n - k - ncol(extra)) %/% 3L, 0L))), drop = FALSE]
  columns <- cbind(found$j, extra, near)
  norm <- sqrt(colSums(columns^2))
  norm[norm == 0] <- 1
  w <- whiten(at, cbind(sweep(columns, 2, norm, "/"), found$e), noise)
  fit <- function(last) {
    q <- qr(w[, seq_len(last), drop = FALSE], tol = 1e-9)
    list(rank = q$rank, rest = sum(qr.resid(q, w[, ncol(w)])^2))
  }
  few <- fit(k)
  some <- fit(k + ncol(extra))
  all <- fit(ncol(columns))
  free <- n - all$rank
  if (free < 4L || !(all$rest > 0)) return(out)
  waves <- all$rank - some$rank
  level <- all$rest / free
  if (waves > 3L) {
    ratio <- (some$rest - all$rest) / waves / level
    if (stats::pf(ratio, waves, free, lower.tail = FALSE) < 0.01) {
      out$inflation <- ratio
      out$dof <- waves
    }
  }
  more <- some$rank - few$rank
  if (more > 0L && n >= k + 2L * ncol(extra)) {
    other <- if (is.finite(out$dof)) out$dof else n - some$rank
    scale <- if (is.finite(out$dof)) level * out$inflation else some$rest / other
    out$p <- stats::pf((few$rest - some$rest) / more / scale, more, other, lower.tail = FALSE)
  }
  out
}

# Independent samples of the noise near the frequency of the swings, less what is fitted: those of
# the slow part by its own memory, or a period's quarter if that is longer.
swing_dof <- function(time, noise, fitted, period) {
  n <- length(time)
  if (noise[["tau_s"]] > 0 && noise[["white"]] < 1) {
    share <- 1 - noise[["white"]]
    memory <- min(2 * noise[["tau_s"]], period / 2)
    slow <- (time[n] - time[1]) / memory
    n <- 1 / (share^2 / min(slow, n) + (1 - share)^2 / n)
  }
  max(n - fitted, 2)
}

# The nearest motion with no loss below 0.
physical_motion <- function(at, y, found, noise, model, block) {
  p <- found$p
  active <- found$active
  covariance <- found$covariance
  for (round in 1:4) {
    bounded <- active %in% 4:6
    if (!any(p[active][bounded] < 0)) break
    names <- swing_parameters[active]
    held <- hold_at_zero(
      stats::setNames(p[active], names),
      matrix(covariance, length(active), dimnames = list(names, names)), bounded
    )
    if (is.null(held)) break
    p[active] <- held$value
    p[active[held$held]] <- 0
    active <- active[!held$held]
    again <- if (!is.null(model(p))) settle(at, y, p, active, noise, model, block)
    if (is.null(again)) break
    p <- again$p
    active <- again$active
    covariance <- again$covariance
  }
  p[4:6] <- pmax(p[4:6], 0)
  list(p = p, active = active, covariance = unname(covariance))
}

# What is reported, about the motion whose losses are not below 0: its frequency, and the losses
# without a bound, to first order. The frequency depends on the square of a loss. At losses without
# a bound, which may be hundreds of times the true ones where a few swings do not separate them, it
# is off by that square, and its error is not normal: of 150 thirds of records (4 to 10 swings) 81 %
# of the intervals at 68 % held the truth (bench/measurement/swings.R, class "thirds").
numbers_at <- function(p, at, y, found, noise, model, block) {
  if (identical(p, found$p)) return(found)
  now <- model(p)
  if (is.null(now)) return(found)
  j <- block_means(now$derivative[, found$active, drop = FALSE], block)
  e <- block_means(y - now$value, block)[, 1]
  solved <- solve_linear(at, j, e, noise)
  if (is.null(solved)) return(found)
  losses <- found$active %in% 4:6
  p[found$active[losses]] <- p[found$active[losses]] + solved$step[losses]
  list(p = p, covariance = solved$covariance, j = j, e = e)
}
