# Words about a fit.

# Why the law is incomplete: a list of sentences.
law_faults <- function(fit) {
  capped <- vapply(fit$runs, has_long_waves, NA)
  below <- loss_below(fit)
  c(
    if (any(capped)) {
      paste(
        "The law is incomplete: the residuals are correlated over a tenth of the run or more,",
        "which is no noise."
      )
    },
    if (!is.null(below)) {
      paste0(
        "The law is incomplete: without a bound the ", below$loss, " loss would be ",
        with_error(below$value, below$se), " ", below$unit,
        ", below 0. A slope, a draught or a wobble may act."
      )
    }
  )
}

# The loss that is most standard errors below 0, if that are more than two; or NULL.
loss_below <- function(fit) {
  x <- shown_losses(fit)
  se <- sqrt(diag(x$covariance))
  below <- which(x$value < -2 * se)
  if (!length(below)) return(NULL)
  i <- below[which.min(x$value[below] / se[below])]
  list(loss = fit$losses[i], value = x$value[[i]], se = se[[i]], unit = x$unit[[i]])
}

# Were neighbouring residuals alike although white noise was asked for?
are_alike <- function(fit, watson) identical(fit$noise, "white") && watson < 1.5

# A correlation time at its cap. White noise has it by chance in 2 of 100 runs, with twice the log
# likelihood gained up to 5; laws that lack a loss gain 50 and more.
has_long_waves <- function(run) run$numbers[["at_cap"]] > 0 && run$numbers[["gain"]] > 12

# "0.2144(21)": the error in units of the last digit.
with_error <- function(value, se) {
  if (!is.finite(se) || se <= 0) return(format_si(value, 6))
  digits <- 1 - floor(log10(se))
  last <- round(se * 10^digits)
  if (last >= 100) {
    digits <- digits - 1
    last <- round(se * 10^digits)
  }
  size <- floor(log10(max(abs(value), se)))
  if (size < -3 || size > 5) {
    return(paste0(
      formatC(round(value / 10^size, digits + size), digits = max(0, digits + size), format = "f"),
      "(", last, ")e", size
    ))
  }
  if (digits <= 0) return(paste0(format(round(value)), "(", round(se), ")"))
  paste0(formatC(value, digits = digits, format = "f"), "(", last, ")")
}

coast_pairs <- function(fit) {
  if (length(fit$losses) < 2L) return(NULL)
  x <- shown_losses(fit)
  r <- correlations(x$covariance)
  lower <- coast_rows(fit)$lower
  pairs <- which(upper.tri(r) & abs(r) > 0.99, arr.ind = TRUE)
  keep <- lower[pairs[, 1]] <= 0 | lower[pairs[, 2]] <= 0
  pairs <- pairs[keep, , drop = FALSE]
  if (!nrow(pairs)) return(NULL)
  worst <- pairs[order(-abs(r[pairs])), , drop = FALSE]
  vapply(seq_len(nrow(worst)), function(k) {
    i <- worst[k, ]
    paste0(
      fit$losses[i[1]], " and ", fit$losses[i[2]], " (correlation ",
      formatC(r[i[1], i[2]], digits = 4, format = "f"), ")"
    )
  }, "")
}

#' @export
print.rot_coast_fit <- function(x, ...) {
  fit <- coast_fit(x, "x", current_env())
  say(coast_words(x, fit), sep = "\n")
  invisible(x)
}

coast_words <- function(x, fit) {
  first <- fit$runs[[1]]
  samples <- sum(vapply(fit$runs, function(run) length(run$time_s), 0L))
  kind <- c("angles", "rates", "pulses")[first$kind + 1]
  range <- speed_range(fit)
  spans <- vapply(fit$runs, function(run) diff(range(run$time_s)), 0)
  runs <- length(fit$runs)
  rows <- coast_rows(fit)
  known <- seq_along(rows$loss)
  free <- shown_losses(fit)$value
  value <- vapply(known, function(i) {
    # A loss that may be 0 has its limit; one that follows from a bound has no error of its own.
    if (rows$upper[i] == 0) {
      "0"
    } else if (i <= length(fit$losses) && rows$status[i] != "acts") {
      paste("at most", format(rows$upper[i], digits = 2))
    } else if (i <= length(fit$losses) && abs(free[i] - rows$value[i]) > rows$standard_error[i]) {
      format(rows$value[i], digits = 3)
    } else {
      with_error(rows$value[i], rows$standard_error[i])
    }
  }, "")
  interval <- paste0(
    format_si(signif(rows$lower, 4), 4), " to ", format_si(signif(rows$upper, 4), 4)
  )
  labels <- format(c(rows$loss, "together", "noise", "u(I)/I"))
  label <- function(name) paste0("  ", labels[trimws(labels) == name][1], "  ")
  table <- paste0(
    "  ", labels[known], "  ", format(value), "  ", format(rows$unit), "  ",
    format(paste0("[", interval, "]"))
  )
  # A line too long for the console has its last column below.
  beside <- max(nchar(table) + 2L + nchar(rows$status)) <= getOption("width")
  table <- if (beside) paste0(table, "  ", rows$status) else
    paste0(sub(" +$", "", table), "\n      ", rows$status)
  sigma <- max(vapply(fit$runs, function(run) run$numbers[["sigma"]], 0))
  tau <- vapply(fit$runs, function(run) run$numbers[["tau_s"]], 0)
  longest <- which.max(tau)
  trend <- vapply(fit$runs, `[[`, 1, "trend")
  slow <- 1 - fit$runs[[longest]]$numbers[["white"]]
  middle <- mean(range)
  torque <- retarding_torque(x, middle)
  unit <- if (is.na(coast_inertia(fit))) "rad/s^2" else "N m"
  c(
    paste0(
      "<rot_coast_fit> ", if (runs > 1L) paste0(runs, " runs, "), samples, " ", kind, ", ",
      format_si(sum(spans), 4), " s, from ", format_si(range[2], 4), " to ", format_si(range[1], 4),
      " rad/s"
    ),
    sub(" +$", "", table),
    paste0(
      label("together"), with_error(torque[[2]], torque$standard_error), " ", unit, " at ",
      format_si(middle, 3), " rad/s"
    ),
    if (!is.null(fit$inertia) && fit$inertia$u > 0) {
      paste0(
        label("u(I)/I"), format(100 * fit$inertia$u / fit$inertia$value, digits = 2),
        " %, a factor common to all, not in these errors"
      )
    },
    paste0(
      label("noise"), format(sigma, digits = 3), " ", c("rad", "rad/s", "s")[first$kind + 1],
      if (any(tau > 0)) {
        paste0(
          ", ", if (slow < 0) "neighbours anti",
          if (slow > 0 && slow < 0.95) paste0(round(100 * slow), " % of its variance "),
          "correlated over ", format(max(tau), digits = 2), " s"
        )
      } else {
        ", white"
      },
      if (any(trend != 1)) {
        paste0(", ", format(trend[which.max(abs(log(trend)))], digits = 2),
               " times as large at the end")
      }
    ),
    vapply(coast_findings(fit), function(text) {
      paste(strwrap(text, 78, initial = "* ", prefix = "  "), collapse = "\n")
    }, "", USE.NAMES = FALSE)
  )
}

coast_findings <- function(fit) {
  pairs <- coast_pairs(fit)
  p <- vapply(fit$runs, runout_p, 0)
  uneven <- which(p < 0.01)
  watson <- min(vapply(fit$runs, function(run) durbin_watson(run$residual), 0))
  unweighed <- any(vapply(fit$runs, function(run) {
    run$trend != 1 && is.null(run$problem$weight)
  }, NA))
  c(
    if (unweighed) {
      paste(
        "Correlated noise grows or falls over the run, and samples do not weigh by it: the",
        "intervals may not hold."
      )
    },
    if (are_alike(fit, watson)) {
      paste0(
        "Neighbouring residuals are alike (Durbin-Watson ", format(watson, digits = 2),
        "): these errors, of white noise, are too small."
      )
    },
    if (length(pairs)) {
      paste0("This record does not separate ", paste(pairs, collapse = ", "), ".")
    },
    law_faults(fit),
    if (length(uneven)) {
      run <- fit$runs[[uneven[1]]]
      paste0(
        "The residuals repeat every turn (", format(run$numbers[["runout_1"]], digits = 2),
        " and ", format(run$numbers[["runout_2"]], digits = 2),
        " rad in the first and second harmonic): runout = \"fit\" removes it."
      )
    },
    if (length(fit$runs) > 1L) {
      paste0(
        "Between the runs: Birge ratio ", format(fit$pooled$birge, digits = 3),
        if (any(fit$pooled$between > 0)) "; the errors include a variance between runs." else "."
      )
    }
  )
}
