#' Periods timed by hand, and at several pivots
#'
#' `pool_periods()` pools readings of one period by several people. What a person adds at the start
#' and the stop is common to his readings, so the scatter inside a group is too small: the groups
#' get an error between them, from their own scatter (Paule and Mandel), and at least `type_b_s`
#' divided by the number of swings. A group whose period is far from the others and near a simple
#' fraction of theirs (one or two swings too many or too few, half swings) is a miscount and left
#' out.
#'
#' `fit_pivots()` takes the periods of one body about several pivots on a line through its centre of
#' mass,
#' \deqn{T_0^2 d = \frac{4 \pi^2}{g} (k^2 + d^2)}{T0^2 d = 4 pi^2/g (k^2 + d^2)}
#' with its radius of gyration k and g, by weighted least squares. A pivot whose deleted residual is
#' beyond the 95 % limit of the largest of so many is an outlier and left out, one at a time.
#'
#' @param time_s Readings in s.
#' @param swings Number of swings of each reading.
#' @param group Who timed, for each reading; NULL for one group.
#' @param ... Not used: an unknown argument is an error.
#' @param type_b_s Standard uncertainty of start and stop together, in s.
#' @param period_s Periods of small swings.
#' @param distance_m Distances of the pivots from the centre of mass.
#' @param distance_u_m,period_u_s Their standard uncertainties: numbers, or one for all. Each pivot
#'   has one of them, or none has.
#' @param gravity_m_per_s2 Acceleration of gravity, or NULL to fit it, too.
#' @param x A result.
#' @return `pool_periods()`: a list with `period_s` (a [measured()] number), `between_s` (the error
#'   between groups), `birge_ratio` (of the scatter between groups to that inside; 1 if all is in
#'   order) and `groups`, a tibble: `group`, `readings`, `period_s`, `u_s` (inside), `ratio` to the
#'   median, `status` (`"used"`, `"miscounted"` or `"apart"`).
#'
#'   `fit_pivots()`: a list with `gyration_square_m2`, `gravity_m_per_s2` (measured numbers) and
#'   `pivots`, a tibble: `distance_m`, `period_s`, `gravity_alone_m_per_s2` (g from this pivot with
#'   the k fitted), `residual` (deleted, in standard deviations; NA where the
#'   other pivots do not determine it), `status` (`"used"` or `"outlier"`).
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Paule and Mandel, J. Res. Natl. Bur. Stand. 87, 377 (1982); Birge, Phys. Rev. 40, 207
#'   (1932); Cook and Weisberg, Residuals and Influence in Regression (1982), for the outliers.
#' @seealso [fit_swing()] for records, [inertia_compound_pendulum()].
#' @concept period
#' @concept hand timing
#' @concept outlier
#' @examples
#' timed <- data.frame(
#'   who = rep(c("A", "B", "C", "D"), each = 4),
#'   time_s = c(17.63, 17.48, 17.59, 17.64, 17.71, 17.69, 17.66, 17.74,
#'     17.52, 17.49, 17.55, 17.50, 15.82, 15.86, 15.79, 15.80)
#' )
#' pool_periods(timed$time_s, swings = 10, group = timed$who)
#'
#' # A metre stick hung at five holes, one of them misread.
#' d <- c(0.1, 0.2, 0.3, 0.4, 0.45, 0.5)
#' times <- 2 * pi * sqrt((1 / 12 + d^2) / (9.81 * d)) * (1 + c(2, -1, 60, -2, 1, 1) / 1000)
#' fit_pivots(times, d)
#' @export
pool_periods <- function(time_s, swings = 1, group = NULL, ..., type_b_s = 0.03) {
  call <- check_no_dots(...)
  check_supplied("time_s", call)
  time <- check_finite(time_s, "time_s", "s", call)
  check_not_negative(time, "time_s", "s", call, open = TRUE)
  n <- length(time)
  swings <- check_finite(swings, "swings", "1", call)
  check_not_negative(swings, "swings", "1", call, open = TRUE)
  group <- if (is.null(group)) rep(1L, n) else group
  check_rows_fit(list(swings = swings), n, "time_s", call)
  if (!is.atomic(group) || length(group) != n || anyNA(group)) {
    abort_rotdyn("{.arg group} must have a value for each reading.", "size", call)
  }
  if (n < 2L) abort_rotdyn("{.arg time_s} must have two readings at least.", "size", call)
  type_b <- check_number(type_b_s, "type_b_s", "s", call, lower = 0)
  swings <- rep_len(swings, n)
  period <- time / swings
  who <- unique(group)
  at <- match(group, who)
  count <- tabulate(at, length(who))
  mean <- as.double(tapply(period, at, mean))
  u <- as.double(tapply(period, at, stats::sd)) / sqrt(count)
  number <- as.double(tapply(swings, at, stats::median))
  centre <- stats::median(mean)
  ratio <- mean / centre
  spread <- if (length(who) > 3L) stats::mad(mean) else 0
  far <- abs(mean - centre) > pmax(5 * spread, 3 * type_b / number) & length(who) > 2L &
    abs(ratio - 1) > 0.02
  miscount <- far & vapply(seq_along(who), function(g) {
    k <- c(-2, -1, 1, 2)
    simple <- c(0.5, 2, if (number[g] > 2) 1 + k / number[g])
    any(abs(ratio[g] - simple) < 0.04)
  }, NA)
  status <- ifelse(miscount, "miscounted", ifelse(far, "apart", "used"))
  good <- status == "used"
  # A group of one reading has the scatter of the others.
  typical <- stats::median(u[good & is.finite(u)] * sqrt(count[good & is.finite(u)]))
  if (!is.finite(typical)) typical <- 0
  u[!is.finite(u)] <- typical / sqrt(count[!is.finite(u)])
  y <- mean[good]
  inside <- u[good]
  between <- between_groups(y, inside)
  shared <- max(between, stats::median(type_b / number[good]))
  weight <- 1 / (inside^2 + shared^2)
  if (!all(is.finite(weight))) weight <- rep(1, length(y))
  pooled <- sum(weight * y) / sum(weight)
  birge <- if (length(y) > 1L && all(inside > 0)) {
    inner <- 1 / inside^2
    sqrt(sum(inner * (y - sum(inner * y) / sum(inner))^2) / (length(y) - 1))
  } else {
    NA_real_
  }
  dof <- if (length(y) > 1L) length(y) - 1 else max(sum(count[good]) - 1, 1)
  error <- if (shared > 0 || all(inside > 0)) 1 / sqrt(sum(weight)) else 0
  structure(
    list(
      period_s = new_measured(pooled, error, dof, "period"), between_s = shared,
      birge_ratio = birge,
      groups = as_table(
        group = who, readings = count, period_s = mean, u_s = u, ratio = ratio, status = status
      )
    ),
    class = "rot_pooled_periods"
  )
}

# The variance between groups at which the weighted scatter is what it should be.
between_groups <- function(y, inside) {
  n <- length(y)
  if (n < 2L) return(0)
  excess <- function(v) {
    w <- 1 / (inside^2 + v)
    sum(w * (y - sum(w * y) / sum(w))^2) - (n - 1)
  }
  top <- 10 * stats::var(y)
  low <- top * 1e-12
  if (!(top > 0) || excess(low) <= 0) return(0)
  sqrt(stats::uniroot(excess, c(low, top), tol = top * 1e-10)$root)
}

pooled_periods_form <- list(
  .class = "rot_pooled_periods", between_s = "number", birge_ratio = "values:1",
  groups = list(
    period_s = "numbers", u_s = "numbers=period_s", ratio = "numbers=period_s",
    status = "texts=period_s"
  )
)

check_pooled_periods <- function(x, arg, call) {
  check_class(x, "rot_pooled_periods", arg, "Make them with {.fn pool_periods}.", call)
  check_form(x, pooled_periods_form, arg, "table of pooled periods", call)
  check_measured(x$period_s, arg, call)
  whole <- length(x$groups$group) == length(x$groups$period_s) &&
    is.numeric(x$groups$readings) &&
    all(x$groups$status %in% c("used", "miscounted", "apart")) && any(x$groups$status == "used")
  if (!whole) abort_form("groups", arg, "table of pooled periods", call)
  x
}

#' @rdname pool_periods
#' @export
print.rot_pooled_periods <- function(x, ...) {
  check_pooled_periods(x, "x", current_env())
  g <- x$groups
  say("period ", format(x$period_s), " s from ", sum(g$status == "used"), " of ", nrow(g),
    " groups\n")
  print_field("between", paste0(
    format_si(x$between_s, 2), " s between groups, in the error of each; Birge ratio ",
    format(x$birge_ratio, digits = 2)
  ))
  for (k in which(g$status != "used")) {
    print_field("left out", paste0(
      "group ", format(g$group[k]), ": ", format_si(g$period_s[k], 4), " s, ",
      format(g$ratio[k], digits = 3), " of the median: ", g$status[k]
    ))
  }
  invisible(x)
}

#' @rdname pool_periods
#' @export
fit_pivots <- function(period_s, distance_m, ..., distance_u_m = 0, period_u_s = 0,
                       gravity_m_per_s2 = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("period_s", "distance_m"), call)
  period <- check_finite(period_s, "period_s", "s", call)
  check_not_negative(period, "period_s", "s", call, open = TRUE)
  n <- length(period)
  d <- check_finite(distance_m, "distance_m", "m", call)
  check_not_negative(d, "distance_m", "m", call, open = TRUE)
  du <- check_finite(distance_u_m, "distance_u_m", "m", call)
  check_not_negative(du, "distance_u_m", "m", call)
  tu <- check_finite(period_u_s, "period_u_s", "s", call)
  check_not_negative(tu, "period_u_s", "s", call)
  if (length(d) != n) {
    abort_rotdyn("{.arg distance_m} must have a number for each period.", "size", call)
  }
  check_rows_fit(list(distance_u_m = du, period_u_s = tu), n, "period_s", call)
  check_pivot_errors(period, d, rep_len(tu, n), rep_len(du, n), call)
  g <- if (!is.null(gravity_m_per_s2)) {
    check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call, lower = 0, open = TRUE)
  }
  unknowns <- if (is.null(g)) 2L else 1L
  if (n < unknowns + 2L) {
    abort_rotdyn(c(
      "At least {unknowns + 2L} pivots are needed.", x = "{n} {?is/are} given."
    ), "size", call)
  }
  used <- rep(TRUE, n)
  repeat {
    fit <- pivots_least_squares(period, d, rep_len(tu, n), rep_len(du, n), g, used)
    if (is.null(fit)) {
      abort_rotdyn(c(
        "The periods do not determine the radius of gyration.",
        i = "Pivots at different distances are needed."
      ), "value", call)
    }
    m <- sum(used)
    if (m - unknowns < 3L) break
    limit <- stats::qt(1 - 0.025 / m, m - unknowns - 1)
    worst <- which.max(ifelse(used, abs(fit$deleted), 0))
    if (!isTRUE(abs(fit$deleted[worst]) > limit)) break
    used[worst] <- FALSE
  }
  gravity <- fit$gravity
  k2 <- fit$k2
  structure(
    list(
      gyration_square_m2 = k2, gravity_m_per_s2 = gravity,
      pivots = as_table(
        distance_m = d, period_s = period,
        gravity_alone_m_per_s2 = 4 * pi^2 * (k2$value + d^2) / (period^2 * d),
        residual = fit$deleted, status = ifelse(used, "used", "outlier")
      )
    ),
    class = "rot_pivots"
  )
}

# The weights are by the errors: none of them is 0 where others are not, nor so small that its
# square is no double.
check_pivot_errors <- function(period, d, tu, du, call) {
  relative <- pmax(tu / period, du / d)
  bad <- which(!(relative > 1e-100 & relative < 1e100))
  if (all(relative == 0) || !length(bad)) return(invisible())
  abort_rotdyn(c(
    "Each pivot needs an error in {.arg period_u_s} or {.arg distance_u_m}, or none has one.",
    x = "Those of pivot {bad[1]} are {format(tu[bad[1]])} s and {format(du[bad[1]])} m."
  ), "value", call)
}

# T^2 = b k^2/d + b d with b = 4 pi^2/g, in T: weights by the errors of T and d, twice.
pivots_least_squares <- function(period, d, tu, du, g, used) {
  x <- cbind(1 / d, d)
  y <- period^2
  weight <- rep(1, length(y))
  exact <- all(tu == 0) && all(du == 0)
  for (round in 1:3) {
    fitted <- weight
    w <- sqrt(weight[used])
    if (is.null(g)) {
      q <- qr(w * x[used, ])
      if (q$rank < 2L) return(NULL)
      p <- qr.coef(q, w * y[used])
      r <- y - drop(x %*% p)
      inverse <- chol2inv(qr.R(q))
    } else {
      b <- 4 * pi^2 / g
      z <- x[, 1]
      inverse <- matrix(1 / sum((w * z[used])^2))
      p <- drop(inverse) * sum(weight[used] * z[used] * (y - b * d)[used])
      r <- y - b * d - z * p
      p <- c(p, b)
    }
    # Var(T^2): relative errors of the periods where none are given.
    slope <- -p[1] / d^2 + p[2]
    variance <- if (exact) y^2 else (2 * period * tu)^2 + (slope * du)^2
    weight <- 1 / variance
  }
  m <- sum(used)
  k <- if (is.null(g)) 2L else 1L
  columns <- if (is.null(g)) x else x[, 1, drop = FALSE]
  weight <- fitted # the next ones may differ much
  lever <- weight * rowSums((columns %*% inverse) * columns)
  e <- sqrt(weight) * r
  s2 <- sum(e[used]^2) / (m - k)
  if (!all(is.finite(c(s2, inverse, p, p[1] / p[2], 4 * pi^2 / p[2])))) return(NULL)
  # Deleted residuals; of a pivot left out, its distance from the fit of the others.
  # NA where a used one alone determines a coefficient: the others say nothing about it.
  free <- 1 - lever
  free[used & !(free > 64 * .Machine$double.eps)] <- NA
  rest <- (sum(e[used]^2) - e^2 / free) / (m - k - 1)
  deleted <- e / sqrt(ifelse(used, pmax(rest, 1e-300) * free, s2 * (1 + lever)))
  if (is.null(g)) {
    cov <- s2 * inverse
    u <- stats::setNames(sqrt(diag(cov)), c("first", "second"))
    r <- cov / outer(u, u)
    r[!is.finite(r)] <- 0
    pair <- measured_jointly(c(first = p[[1]], second = p[[2]]), u, r, m - k)
    gravity <- 4 * pi^2 / pair$second
    k2 <- pair$first / pair$second
  } else {
    gravity <- new_measured(g, 0, Inf, "g")
    k2 <- new_measured(p[1], sqrt(s2 * drop(inverse)), m - k, "first") / p[2]
  }
  gravity$name <- "g"
  k2$name <- "k^2"
  list(gravity = gravity, k2 = k2, deleted = deleted)
}

#' @rdname pool_periods
#' @export
print.rot_pivots <- function(x, ...) {
  say("k^2 = ", format(x$gyration_square_m2), " m^2, g = ", format(x$gravity_m_per_s2),
    " m/s^2\n")
  for (k in which(x$pivots$status == "outlier")) {
    print_field("left out", paste0(
      "the pivot at ", format_si(x$pivots$distance_m[k], 4), " m: ",
      format(x$pivots$residual[k], digits = 2), " standard deviations from the others, g alone ",
      format(x$pivots$gravity_alone_m_per_s2[k], digits = 3), " m/s^2"
    ))
  }
  invisible(x)
}
