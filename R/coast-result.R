# From the runs to the fit: losses pooled over runs, bounds, intervals, words.

new_coast_fit <- function(runs, losses, load, inertia, runout, noise, level, call) {
  shared <- c(losses, if (length(load$unknown)) "load")
  pooled <- pool_runs(runs, shared, load)
  fit <- list(
    runs = runs, losses = losses, load = load, inertia = inertia, runout = runout, noise = noise,
    level = level, pooled = pooled
  )
  fit$limits <- stats::qt((1 + level) / 2, pooled$dof)
  rows <- coast_rows(fit)
  new_table(rows, nrow = length(rows$loss), class = "rot_coast_fit", fit = fit)
}

# Weighted by the inverse of each run's covariance, with a variance between the runs where they
# differ by more than their errors say. A run's load enters as its ratio to that of the first run.
pool_runs <- function(runs, shared, load) {
  values <- lapply(runs, function(run) run$p[shared])
  spreads <- lapply(runs, function(run) run$covariance[shared, shared, drop = FALSE])
  if (length(load$unknown)) {
    for (i in seq_along(runs)) {
      unit <- runs[[i]]$problem$load[1] / runs[[1]]$problem$load[1]
      values[[i]]["load"] <- values[[i]]["load"] * unit
      spreads[[i]]["load", ] <- spreads[[i]]["load", ] * unit
      spreads[[i]][, "load"] <- spreads[[i]][, "load"] * unit
    }
  }
  dof <- vapply(runs, function(run) run$dof, 0)
  if (length(runs) == 1L) {
    run <- runs[[1]]
    best <- run$best[shared]
    return(list(
      value = values[[1]], covariance = spreads[[1]], factor = run$factor[shared, , drop = FALSE],
      best = best, dof = rep(dof, length(shared)),
      between = stats::setNames(numeric(length(shared)), shared), birge = NA_real_, p = NA_real_
    ))
  }
  joint <- weigh(values, spreads)
  k <- length(shared)
  excess <- sum(vapply(seq_along(runs), function(i) {
    d <- values[[i]] - joint$value
    sum(d * scaled_solve(spreads[[i]], d))
  }, 0))
  free <- k * (length(runs) - 1)
  p <- stats::pchisq(excess, free, lower.tail = FALSE)
  # A difference that chance explains adds nothing.
  between <- stats::setNames(numeric(k), shared)
  if (p < 0.05) between[] <- between_variances(values, spreads)
  final <- weigh(values, lapply(spreads, function(s) s + diag(between, k)))
  # Few runs do not show which of the losses differs: all have the degrees of freedom of the runs.
  free_dof <- rep(if (any(between > 0)) length(runs) - 1 else sum(dof), k)
  best <- hold_at_zero(final$value, final$covariance, names(final$value) %in% coast_losses)$value
  list(
    value = final$value, covariance = final$covariance, factor = NULL, best = best, dof = free_dof,
    between = between, birge = sqrt(excess / free), p = p
  )
}

# solve() of a covariance matrix whose rows have different units. Correlations of 1 to rounding
# leave directions without information: they count as 1e-14 of the largest.
scaled_solve <- function(a, b = diag(nrow(a))) {
  s <- sqrt(diag(a))
  s[s == 0] <- 1
  parts <- eigen(t(t(a / s) / s), symmetric = TRUE)
  minimum <- 1e-14 * max(parts$values)
  inner <- parts$vectors %*% (crossprod(parts$vectors, b / s) / pmax(parts$values, minimum))
  inner / s
}

weigh <- function(values, spreads) {
  weights <- lapply(spreads, scaled_solve)
  total <- Reduce(`+`, weights)
  covariance <- scaled_solve((total + t(total)) / 2)
  value <- covariance %*% Reduce(`+`, Map(`%*%`, weights, values))
  names <- names(values[[1]])
  dimnames(covariance) <- list(names, names)
  list(value = stats::setNames(as.vector(value), names), covariance = covariance)
}

# The nearest point, by the covariance, with no loss below 0: those held, and the others given them.
hold_at_zero <- function(value, covariance, bounded) {
  index <- which(bounded)
  best <- NULL
  for (set in seq_len(2^length(index)) - 1L) {
    held <- index[bitwAnd(set, 2^(seq_along(index) - 1L)) > 0]
    moved <- value
    cost <- 0
    if (length(held)) {
      c_held <- covariance[held, held, drop = FALSE]
      y <- scaled_solve(c_held, value[held])
      moved <- value - as.vector(covariance[, held, drop = FALSE] %*% y)
      moved[held] <- 0
      cost <- sum(y * value[held])
    }
    if (all(moved[index] >= 0) && (is.null(best) || cost < best$cost)) {
      best <- list(value = moved, held = seq_along(value) %in% held, cost = cost)
    }
  }
  best
}

# Variances between the runs, one for each loss, by REML: (log|V_r| + |sum V_r^-1| + residuals) with
# V_r = C_r + diag(variances). In a run the losses are so correlated that each one's own scatter
# does not show which of them differs.
between_variances <- function(values, spreads) {
  k <- length(values[[1]])
  scale <- rowMeans(matrix(unlist(lapply(spreads, diag)), k))
  deviance <- function(x) {
    v <- lapply(spreads, function(s) s + diag(scale * 10^x, k))
    joint <- weigh(values, v)
    sum(vapply(seq_along(v), function(i) {
      d <- values[[i]] - joint$value
      log_det(v[[i]], scale) + sum(d * scaled_solve(v[[i]], d))
    }, 0)) - log_det(joint$covariance, scale)
  }
  best <- NULL
  # One loss that differs, at a time.
  for (start in seq_len(k)) {
    x <- rep(-4, k)
    x[start] <- 1
    found <- stats::nlminb(
      x, deviance, lower = -5, upper = 8, control = list(iter.max = 30, rel.tol = 1e-5)
    )
    if (is.null(best) || found$objective < best$objective) best <- found
  }
  ifelse(best$par < -3, 0, scale * 10^best$par)
}

log_det <- function(covariance, scale) {
  s <- sqrt(scale)
  values <- eigen(t(t(covariance / s) / s), symmetric = TRUE, only.values = TRUE)$values
  sum(log(pmax(values, 1e-14 * max(values))))
}

# ---- rows ----------------------------------------------------------------------------------------

# What the load's multiplier says: name, unit, value and its derivative by the multiplier.
load_unknown <- function(fit) {
  load <- fit$load
  if (!length(load$unknown)) return(NULL)
  p <- fit$pooled$value[["load"]]
  ratios <- fit$runs[[1]]$problem$load
  r <- load$radius_m
  switch(load$unknown,
    inertia = {
      # T/I is m g r/I: the reference inertia from it.
      reference <- load$mass_kg * load$gravity_m_per_s2 * r / abs(ratios[1])
      list(name = "inertia", unit = "kg m^2", value = reference / p, slope = -reference / p^2)
    },
    mass = {
      reference <- abs(ratios[1]) * fit$inertia$value / (load$gravity_m_per_s2 * r)
      list(name = "mass", unit = "kg", value = reference * p, slope = reference)
    },
    gravity = {
      reference <- abs(ratios[1]) * fit$inertia$value / (load$mass_kg * r)
      list(name = "gravity", unit = "m/s^2", value = reference * p, slope = reference)
    }
  )
}

# The losses in the units shown: value, unbounded value, covariance of the latter, u by the inertia.
shown_losses <- function(fit) {
  pooled <- fit$pooled
  losses <- fit$losses
  at <- match(losses, names(pooled$value))
  out <- list(
    best = pooled$best[losses], value = pooled$value[losses],
    covariance = pooled$covariance[at, at, drop = FALSE], dof = pooled$dof[at],
    factor = pooled$factor[at, , drop = FALSE], unit = coast_units$rate[losses], u_inertia = NULL
  )
  unknown <- load_unknown(fit)
  if (identical(unknown$name, "inertia")) {
    # tau = a I with I = I_ref/p: the two estimates are correlated.
    all <- c(at, match("load", names(pooled$value)))
    jacobian <- cbind(diag(unknown$value, length(at)), out$value * unknown$slope)
    out$covariance <- jacobian %*% pooled$covariance[all, all] %*% t(jacobian)
    if (!is.null(out$factor)) out$factor <- jacobian %*% pooled$factor[all, ]
    out$best <- out$best * unknown$value
    out$value <- out$value * unknown$value
    out$unit <- coast_units$torque[losses]
  } else if (!is.null(fit$inertia)) {
    i <- fit$inertia$value
    out$best <- out$best * i
    out$value <- out$value * i
    out$covariance <- out$covariance * i^2
    if (!is.null(out$factor)) out$factor <- out$factor * i
    out$unit <- coast_units$torque[losses]
    out$u_inertia <- out$best * fit$inertia$u / i
  }
  out
}

coast_rows <- function(fit) {
  x <- shown_losses(fit)
  se <- sqrt(diag(x$covariance))
  half <- stats::qt((1 + fit$level) / 2, x$dof) * se
  # Where another loss is held at 0 the value may lie outside: the interval reaches to it.
  lower <- pmin(pmax(0, x$value - half), x$best)
  # An estimate far below 0 does not make the limit smaller than the record can show: at least that
  # of one standard error below 0 (power-constrained: Cowan, Cranmer, Gross and Vitells,
  # arXiv:1105.3166).
  upper <- pmax(half - se, x$value + half, x$best)
  rows <- list(
    loss = fit$losses, value = unname(x$best), standard_error = unname(se), lower = unname(lower),
    upper = unname(upper), status = coast_status(x, lower), unit = unname(x$unit)
  )
  if (!is.null(x$u_inertia)) rows$u_inertia <- unname(x$u_inertia)
  unknown <- load_unknown(fit)
  if (is.null(unknown)) return(rows)
  at <- match("load", names(fit$pooled$value))
  se <- abs(unknown$slope) * sqrt(fit$pooled$covariance[at, at])
  half <- stats::qt((1 + fit$level) / 2, fit$pooled$dof[at]) * se
  extra <- list(
    unknown$name, unknown$value, se, unknown$value - half, unknown$value + half, "fitted",
    unknown$unit
  )
  if (!is.null(x$u_inertia)) extra <- c(extra, NA_real_)
  Map(c, rows, extra)
}

coast_status <- function(x, lower) {
  k <- length(x$value)
  status <- ifelse(lower > 0, "acts", "at most")
  if (k < 2L) return(status)
  correlation <- correlations(x$covariance)
  for (i in which(lower <= 0)) {
    with <- which(abs(correlation[i, ]) > 0.99 & lower <= 0 & seq_len(k) != i)
    if (length(with)) {
      status[i] <- paste("not separable from", paste(names(x$value)[with], collapse = " and "))
    }
  }
  status
}

# 0 where a variance is 0, as that of data without any noise may be.
correlations <- function(covariance) {
  s <- sqrt(diag(covariance))
  s[!(s > 0)] <- 1
  t(t(covariance / s) / s)
}
