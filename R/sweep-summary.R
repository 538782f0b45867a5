# Figures of a sweep from its sums: means, quantiles, extremes, indices, what is not known; an audit
# of some rows.

#' Summarise a sweep
#'
#' Of all rows, kept or not, from the sums that each chunk leaves. `summary()`: mean, standard
#' deviation, extremes with their rows, quantiles. `quantile()`: any quantiles, with their bounds.
#' `sweep_indices()`: Sobol indices of a [design_saltelli()]: the share of an output's variance that
#' each input explains alone (`first`) and with all its interactions (`total`). `sweep_audit()`:
#' some rows computed again by another model, and audited.
#'
#' Quantiles come from a histogram with 256 bins in each factor of two: that of rank `ceiling(p n)`
#' lies between `low` and `high`, at most 2^-8 apart, so `value` is within 0.2 %: a bound. Rows that
#' failed enter nothing but their count. Infinite values enter quantiles, not means. A mean of a
#' Sobol design has a smaller error than `mean_error`, which takes its sixteen parts as independent;
#' so have its indices.
#'
#' The print names first what is not known: rows without numbers, and the share of rows whose error
#' exceeds the accuracy. Chaotic scenes have them.
#'
#' @param object,x A sweep of [sweep_run()] or [sweep_read()].
#' @param probs Probabilities, from 0 to 1.
#' @param rows How many rows, spread over the sweep; NULL: as the plan says.
#' @param ... Not used; names after it must be given in full.
#' @param trust As in [sweep_run()], of a sweep that [sweep_read()] returned.
#' @return `summary()`: a tibble of class `rot_sweep_summary`, a row for each output, with the
#'   columns
#'   `r describe_columns(sweep_summary_columns, sweep_summary_meanings)`
#'   and one for each of `probs`, such as `p50`. `quantile()`: a tibble with the columns
#'   `r describe_columns(sweep_quantile_columns, sweep_quantile_meanings)`
#'   `sweep_indices()`: a tibble with the columns
#'   `r describe_columns(sweep_index_columns, sweep_index_meanings)`
#'   `sweep_audit()`: a tibble with a row for each row looked at, and the columns
#'   `r describe_columns(sweep_audit_columns, sweep_audit_meanings)`
#' @section Warnings: `rotdyn_warning_range` where the sum of finite values, or of their squares, is
#'   beyond double precision: their mean, or their deviation, is Inf.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`; `rotdyn_error_argument` for indices
#'   of another design.
#' @source Jansen, Computer Physics Communications 117 (1999) 35; Saltelli and others, Computer
#'   Physics Communications 181 (2010) 259; Owen, Monte Carlo theory, methods and examples (2013).
#' @seealso [sweep_run()], [sweep_scene()].
#' @concept sensitivity analysis
#' @concept tolerance
#' @examples
#' wheel <- scene_axle(
#'   0.0625, resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
#' )
#' plan <- sweep_plan(
#'   wheel, time_s = 400, design_saltelli(512, seed = 1,
#'     "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2),
#'     "omega0_rad_per_s" = vary_normal(20, 0.5)),
#'   outputs = "final_theta_rad", keep = "summary"
#' )
#' sweep <- sweep_run(plan)
#' summary(sweep)
#' quantile(sweep, c(0.01, 0.99))
#' sweep_indices(sweep)
#' sweep_audit(sweep, rows = 3)
#' @export
summary.rot_sweep <- function(object, probs = c(0.05, 0.5, 0.95), ...) {
  call <- check_no_dots(...)
  probs <- check_probs(probs, call)
  sweep <- attr(object, "sweep")
  figures <- sweep_figures(object, probs, call)
  column <- as.data.frame(figures$column)
  warn_beyond(column[c("mean", "mean_error", "sd")], list(), nrow(column), call)
  value <- middle_of(figures$low, figures$high)
  names <- paste0("p", format_each(100 * probs), recycle0 = TRUE)
  out <- c(
    list(output = sweep$plan$outputs, unit = plain_units(sweep$plan$output_unit)),
    column[c("mean", "mean_error", "sd", "min", "min_row", "max", "max_row")],
    stats::setNames(lapply(seq_along(probs), function(i) value[, i]), names),
    list(finite = column$finite, infinite = column$plus_inf + column$minus_inf)
  )
  status <- figures$status
  names(status) <- c(row_statuses(), rep("", length(status) - length(row_statuses())))
  new_table(out, nrow = length(sweep$plan$outputs), class = "rot_sweep_summary", about = list(
    n = figures$whole[1], kept = figures$whole[2], above = figures$whole[3],
    unknown = figures$whole[4], error = figures$whole[5], error_row = figures$whole[6],
    status = status[status > 0], failed = figures$failed[!is.nan(figures$failed)],
    accuracy = sweep$plan$accuracy
  ))
}

sweep_figures <- function(x, probs, call) {
  sweep <- attr(x, "sweep")
  found <- .Call(
    ffi_sweep_figures,
    list(sums = sweep$whole$sums, columns = as.double(length(sweep$plan$outputs))), probs
  )
  if (is.null(found)) abort_form("", "object", "sweep", call)
  found
}

check_probs <- function(probs, call) {
  probs <- check_finite(probs, "probs", "1", call)
  outside <- which(probs < 0 | probs > 1)
  if (length(outside)) abort_domain(probs[outside[1]], "probs", "1", call, 0, 1, FALSE, outside[1])
  probs
}

# Of an interval; an end that is infinite is both.
middle_of <- function(low, high) {
  same <- !is.nan(low) & low == high
  middle <- low + (high - low) / 2
  middle[same] <- low[same]
  middle
}

#' @export
print.rot_sweep_summary <- function(x, ...) {
  about <- attr(x, "about")
  if (!is.null(about)) {
    count <- function(n) format(n, big.mark = ",", scientific = FALSE)
    share <- function(n) paste0(format(100 * n / about$n, digits = 2), " %")
    say("# ", count(about$n), " rows", if (about$kept < about$n) {
      paste0(", ", count(about$kept), " kept")
    }, "\n")
    bad <- about$status[names(about$status) != "ok"]
    for (name in names(bad)) {
      say("# not computed (", name, "): ", count(bad[[name]]), " rows, ", share(bad[[name]]), "\n")
    }
    if (length(about$failed)) {
      first <- paste(whole_words(utils::head(about$failed, 5)), collapse = ", ")
      say("#   the first of them: row ", first, "\n")
    }
    if (about$above > 0) {
      say("# error above ", format(about$accuracy), ": ", count(about$above), " rows, ",
          share(about$above), if (about$unknown > 0) {
            paste0(" (", count(about$unknown), " not known)")
          }, "\n")
    }
    if (!is.nan(about$error)) {
      say("# largest error ", format(about$error, digits = 2), " (row ", count(about$error_row),
          ")\n")
    }
  }
  NextMethod()
}

#' @rdname summary.rot_sweep
#' @importFrom stats quantile
#' @export
quantile.rot_sweep <- function(x, probs = c(0, 0.25, 0.5, 0.75, 1), ...) {
  call <- check_no_dots(...)
  probs <- check_probs(probs, call)
  figures <- sweep_figures(x, probs, call)
  outputs <- attr(x, "sweep")$plan$outputs
  low <- c(t(figures$low))
  high <- c(t(figures$high))
  as_table(
    output = rep(outputs, each = length(probs)), p = rep(probs, length(outputs)),
    value = middle_of(low, high), low = low, high = high
  )
}

#' @rdname summary.rot_sweep
#' @export
sweep_indices <- function(x, ...) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  check_class(x, "rot_sweep", "x", "Make one with {.fn sweep_run}.", call)
  sweep <- attr(x, "sweep")
  laws <- sweep$plan$design$inputs
  inputs <- names(laws)[vapply(laws, function(law) law$kind != "fixed", NA)]
  found <- lapply(seq_along(sweep$plan$outputs), function(i) {
    .Call(ffi_sweep_indices, sweep$whole$sums, i - 1)
  })
  if (is.null(found[[1]])) {
    abort_rotdyn(c(
      "Indices need a design made for them: {.fn design_saltelli}.",
      x = "This one is a {sweep$plan$design$kind} design."
    ), "argument", call)
  }
  all <- do.call(rbind, found)
  as_table(
    output = rep(sweep$plan$outputs, each = length(inputs)),
    input = rep(inputs, length(sweep$plan$outputs)), first = all[, 1], first_error = all[, 2],
    total = all[, 3], total_error = all[, 4]
  )
}

# ---- the audit ----------------------------------------------------------------------------------

#' @rdname summary.rot_sweep
#' @export
sweep_audit <- function(x, rows = NULL, ..., trust = FALSE) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  check_class(x, "rot_sweep", "x", "Make one with {.fn sweep_run}.", call)
  plan <- plan_of(x, trust, call)
  rows <- if (is.null(rows)) plan$audit_rows else check_whole(rows, "rows", call, 1, 1e6)
  bar <- progress_bar("audit")
  at <- spread_rows(plan, rows)
  found <- lapply(seq_along(at), function(i) {
    bar(i / length(at))
    tryCatch(audit_row(plan, at[i], call), rotdyn_error = function(e) {
      list(model = NA_character_, other = NA_character_, verdict = "not computed", share = NaN)
    })
  })
  as_table(
    row = at, model = vapply(found, `[[`, "", "model"), other = vapply(found, `[[`, "", "other"),
    verdict = vapply(found, `[[`, "", "verdict"),
    difference = vapply(found, `[[`, double(1), "share")
  )
}

# A row's motion, its audit, and the same by another model: the difference at the end as a share of
# what both errors allow.
audit_row <- function(plan, i, call) {
  input <- lapply(input_columns(plan, i, 1), identity)
  names(input) <- all_inputs(plan)
  scene <- scene_of_row(plan, i, call, input)
  motion <- suppressWarnings(motion_of_row(plan, scene, input))
  run <- trajectory_run(motion)
  verdicts <- suppressWarnings(audit(motion))$verdict
  fits <- choose_model(scene, times_of_row(plan, scene, input), accuracy = plan$accuracy)
  other <- setdiff(fits$model[fits$applies], run$model)[1]
  share <- NaN
  if (!is.na(other)) {
    again <- suppressWarnings(trajectory(
      scene, times_of_row(plan, scene, input), accuracy = plan$accuracy, model = other
    ))
    share <- difference_of(motion, again)
  }
  list(
    model = run$model, other = other,
    verdict = c(setdiff(verdicts, "balanced"), "balanced")[1],
    share = share
  )
}

difference_of <- function(a, b) {
  measures <- constraint_of(trajectory_run(a)$scene)$measures
  last <- nrow(a)
  shares <- vapply(names(measures), function(name) {
    columns <- measures[[name]]$columns
    got <- as.matrix(as.data.frame(unclass(a)[columns]))[last, , drop = FALSE]
    want <- as.matrix(as.data.frame(unclass(b)[columns]))[nrow(b), , drop = FALSE]
    allowed <- trajectory_run(a)$info$errors[[name]] + trajectory_run(b)$info$errors[[name]]
    distance <- measures[[name]]$distance(got, want)
    if (distance == 0) 0 else distance / allowed
  }, double(1))
  max(shares)
}
