# What a fit of a scene says of its law: tests of the residuals, comparison with other laws.

# Tests of each series, with its place in time where the law fails.
verdict_rows <- function(fit) {
  noise <- noise_table(fit)
  known <- !is.character(fit$about$noise)
  left <- fit$about$outliers_at
  at <- 0
  rows <- list()
  s <- 0
  for (r in seq_along(fit$about$records)) {
    record <- fit$about$records[[r]]
    for (k in seq_along(record$series)) {
      s <- s + 1
      one <- noise[s, ]
      e <- fit$found$white[at + seq_along(record$time_s)]
      residual <- record$series[[k]] - fit$found$fitted[at + seq_along(record$time_s)]
      at <- at + length(record$time_s)
      here <- is.finite(e)
      scan <- scan_residuals(e[here])
      size <- if (known) sum(e[here]^2) else NA_real_
      p_size <- if (known) stats::pchisq(size, max(one$n, 1), lower.tail = FALSE) else NA_real_
      gone <- if (is.null(left)) integer() else left$row[left$record == r & left$column == k]
      reasons <- c(
        if (one$at_cap && one$gain > stats::qchisq(0.999, 2)) {
          "waves longer than a tenth of the record"
        },
        if (scan$p < 1e-3) "the residuals drift",
        if (known && p_size < 1e-3) paste0(
          "they are ", format(sqrt(size / one$n), digits = 2), " times the noise given"
        )
      )
      rows[[s]] <- data.frame(
        record = record$name, column = names(record$series)[k],
        test = c("correlation", "wrong law", "outliers", if (known) "size"),
        statistic = c(one$gain, scan$statistic, length(gone), if (known) size),
        p_value = c(
          if (one$gain > 0) stats::pchisq(one$gain, 2, lower.tail = FALSE) else NA_real_,
          scan$p, NA_real_, if (known) p_size
        ),
        finding = c(
          if (one$tau_s > 0 && one$white > 1) {
            "neighbours are anticorrelated: the errors allow for it"
          } else if (one$tau_s > 0) {
            paste0("correlated over ", format(one$tau_s, digits = 2),
                   " s: the errors allow for it")
          } else {
            "white"
          },
          if (length(reasons)) {
            weight <- record$weight[[k]] %||% rep(1, length(here))
            paste0("incomplete near ", format(worst_time(
              record$time_s[here], residual[here] / weight[here]
            ), digits = 3), " s: ", paste(reasons, collapse = ", "))
          } else {
            "none found"
          },
          if (length(gone)) {
            paste("left out: at", paste(format_each(signif(record$time_s[gone], 6)),
                                        collapse = ", "), "s")
          } else {
            "none found"
          },
          if (known) if (p_size < 1e-3) "larger than the noise given" else "as the noise given"
        )
      )
    }
  }
  do.call(rbind, rows)
}

# Where residuals are largest over a tenth of the record.
worst_time <- function(time_s, residual) {
  n <- length(residual)
  width <- max(1L, n %/% 10L)
  total <- c(0, cumsum(residual))
  first <- seq(0, n - width)
  i <- which.max(abs(total[first + width + 1] - total[first + 1]))
  mean(time_s[i + c(0, width - 1)])
}

#' @rdname residual_tests
#' @export
residual_tests.rot_fit <- function(fit, ...) {
  call <- current_env()
  check_no_dots(...)
  table_from(verdict_rows(fit_of(fit, call, "fit")))
}

#' @rdname compare_laws
#' @export
compare_laws.rot_fit <- function(fit, ...) {
  call <- current_env()
  fits <- list(fit, ...)
  said <- vapply(unname(as.list(substitute(list(fit, ...)))[-1L]), rlang::as_label, "")
  named <- rlang::have_name(fits)
  said[named] <- names(fits)[named]
  if (length(fits) < 2L) {
    abort_rotdyn(c(
      "{.fn compare_laws} needs two fits or more of the same records.",
      i = "{.code compare_laws(fit, other)}"
    ), "missing", call)
  }
  all <- lapply(unname(fits), fit_of, call, "...")
  samples <- lapply(all, function(one) measured_samples(one$about))
  same <- vapply(samples, identical, NA, samples[[1]])
  if (!all(same)) {
    abort_rotdyn(c(
      "Fits are compared by the same samples.",
      x = "{.code {said[!same]}} {?has/have} other records, columns or times than
           {.code {said[1]}}."
    ), "argument", call)
  }
  failed <- vapply(all, `[[`, NA, "failed")
  if (any(failed)) {
    abort_rotdyn("{.code {said[failed]}} did not converge.", "value", call)
  }
  # The noise is that of the law that fits best; a sample that one fit leaves out counts for none.
  best <- which.min(vapply(all, function(one) misfit_of(one$found), double(1)))
  gone <- do.call(rbind, lapply(all, function(one) one$about$outliers_at))
  scores <- vapply(all, function(one) {
    problem <- one$about$problem
    problem$start <- one$found$x
    problem$given <- all[[best]]$found$noise
    problem$records <- Map(function(record, of_best) {
      record$series <- Map(function(one, other) {
        one$weight <- other$weight
        one
      }, record$series, of_best$series)
      record
    }, problem$records, all[[best]]$about$problem$records)
    for (i in seq_len(nrow(gone) %||% 0L)) {
      problem$records[[gone$record[i]]]$series[[gone$column[i]]]$y[gone$row[i]] <- NaN
    }
    found <- .Call(ffi_fit, problem, NULL)
    c(found$numbers[2], found$numbers[4], nrow(one$about$parameters))
  }, double(3))
  squares <- scores[1, ]
  n <- scores[2, ]
  k <- scores[3, ]
  known <- !is.character(all[[best]]$about$noise)
  own <- if (known) squares else n * log(squares / n)
  # The size of the noise is a parameter, too, where it is not known.
  p <- k + !known
  aicc <- own + 2 * p * n / pmax(n - p - 1, 1)
  order <- order(aicc)
  as_table(
    law = said[order], parameters = as.integer(k[order]), aicc_difference = aicc[order] - min(aicc),
    relative_residual = sqrt(squares / pmax(n - k, 1))[order]
  )
}

# Times and values of the records, outliers among them.
measured_samples <- function(about) lapply(about$records, function(r) list(r$time_s, r$all))
