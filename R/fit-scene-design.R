# Which measurement next: what further records would do to the errors of a fit.

#' Which measurement next?
#'
#' How much each of several further records would reduce the standard errors of a fit, before any is
#' measured: a longer or faster record, another start, another column, a better instrument.
#'
#' With the Jacobian `J` of the fit, weighed by its noise, and `K` that of a further record at the
#' values found, the covariance would be
#' \deqn{(J^\mathsf{T} J + K^\mathsf{T} K)^{-1}}{inverse(J'J + K'K)}
#' to first order. It does not depend on what would be measured. An unknown of `per_record` is a new
#' one in the further record, as is its clock; offsets and factors are those of the same instrument.
#'
#' @param fit A [fit_scene()].
#' @param candidates A [planned_record()], or a list of them; their names are those of the table.
#' @param ... Not used: an unknown argument is an error.
#' @param time_s Times of the samples.
#' @param observed Columns of the motion.
#' @param inputs Numbers of the scene that would be others, by their paths, see [sweep_inputs()]: a
#'   list or a named vector. An unknown that all records have in common cannot be another.
#' @param noise Standard deviations of white noise, named by the columns; those that are not given
#'   have the noise which the fit found in that column.
#' @return `fit_design()`: a tibble of class `rot_fit_design` with a row for each candidate and each
#'   unknown of the fit, and the columns
#'   `r describe_columns(design_columns, design_meanings)`
#'   `planned_record()`: a list of class `rot_planned_record`.
#' @section Errors: `rotdyn_error_argument` for a column or an input that the scene lacks, for an
#'   input that all records have in common, and for a column whose noise is not known;
#'   `rotdyn_error_value` for a fit that did not converge and for times before the scene's start;
#'   `rotdyn_error_type`, `rotdyn_error_time`.
#' @source Atkinson, Donev and Tobias, Optimum Experimental Designs, with SAS (2007), chapter 17.
#' @seealso [fit_scene()], [uncertainty_budget()].
#' @concept optimal design
#' @concept Fisher information
#' @concept uncertainty
#' @examples
#' # A wheel runs down: is it better to measure longer, or with a better encoder?
#' wheel <- scene_axle(0.5, resistance = resistance(0.02, 0, 0.05), omega0_rad_per_s = 10)
#' set.seed(1)
#' record <- trajectory(wheel, 0:100 / 10)[c("time_s", "theta_rad")]
#' record$theta_rad <- record$theta_rad + rnorm(101, 0, 0.01)
#' unknown <- c("resistance$viscous_n_m_s", "resistance$coulomb_n_m", "omega0_rad_per_s")
#' fit <- fit_scene(wheel, record, unknown, per_record = "omega0_rad_per_s")
#' fit_design(fit, list(
#'   longer = planned_record(0:300 / 10, "theta_rad"),
#'   better = planned_record(0:100 / 10, "theta_rad", noise = c(theta_rad = 0.001)),
#'   slower = planned_record(0:100 / 10, "theta_rad", inputs = c(omega0_rad_per_s = 3))
#' ))
#' @export
fit_design <- function(fit, candidates, ...) {
  call <- check_no_dots(...)
  check_supplied(c("fit", "candidates"), call)
  table <- fit
  fit <- fit_of(fit, call, "fit")
  if (inherits(candidates, "rot_planned_record")) candidates <- list(candidates)
  if (!is.list(candidates) || !length(candidates) ||
      !all(vapply(candidates, inherits, NA, "rot_planned_record"))) {
    abort_rotdyn(c(
      "{.arg candidates} must be a list of {.fn planned_record}.",
      x = "It is {describe_value(candidates)}."
    ), "type", call)
  }
  if (fit$failed) abort_rotdyn("The fit did not converge.", "value", call)
  label <- names(candidates) %||% rep("", length(candidates))
  label <- ifelse(nzchar(label), label, as.character(seq_along(candidates)))
  now <- information_of_fit(fit)
  rows <- Map(function(one, name) {
    planned <- errors_with(fit, now, information_of(fit, one, call))
    data.frame(
      candidate = name, unknown = fit$about$parameters$name,
      standard_error = table$standard_error, planned_error = planned,
      ratio = ifelse(is.nan(table$standard_error) & !is.nan(planned), 0,
                     planned / table$standard_error)
    )
  }, candidates, label)
  rows <- do.call(rbind, unname(rows))
  new_table(as.list(rows), nrow = nrow(rows), class = "rot_fit_design")
}

#' @rdname fit_design
#' @export
planned_record <- function(time_s, observed, ..., inputs = list(), noise = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("time_s", "observed"), call)
  time_s <- check_times(time_s, call)
  if (!length(time_s)) abort_rotdyn("{.arg time_s} must have a time.", "time", call)
  if (!is.character(observed) || !length(observed) || anyNA(observed)) {
    abort_rotdyn("{.arg observed} must be names of columns.", "type", call)
  }
  structure(
    list(
      time_s = time_s, observed = unique(observed),
      inputs = planned_numbers(inputs, "inputs", call),
      noise = planned_numbers(noise, "noise", call, TRUE)
    ),
    class = "rot_planned_record"
  )
}

planned_numbers <- function(x, arg, call, positive = FALSE) {
  x <- as.list(x)
  if (length(x) && !all(rlang::have_name(x))) {
    abort_rotdyn("{.arg {arg}} must be numbers with names.", "type", call)
  }
  vapply(x, function(one) {
    check_number(one, arg, "SI", call, lower = if (positive) 0 else -Inf, open = positive)
  }, double(1))
}

#' @export
print.rot_planned_record <- function(x, ...) {
  say("<rot_planned_record> ", length(x$time_s), " times, ", format(x$time_s[1]), " to ",
      format(x$time_s[length(x$time_s)]), " s, of ", paste(x$observed, collapse = ", "), "\n")
  if (length(x$inputs)) {
    say(paste0("  ", names(x$inputs), " = ", format_each(x$inputs)), sep = "\n")
  }
  if (length(x$noise)) {
    say(paste0("  noise of ", names(x$noise), ": ", format_each(x$noise)), sep = "\n")
  }
  invisible(x)
}

# ---- information --------------------------------------------------------------------------------

# A matrix whose square is the information, columns: the fit's variables. That of a fit is the
# inverse of its covariance; where not all is determined, scaled as that is.
information_of_fit <- function(fit) {
  m <- nrow(fit$about$parameters)
  triangle <- matrix(fit$found$triangle, m, byrow = TRUE)
  factor <- matrix(fit$found$factor, m, byrow = TRUE)
  moved <- fit$found$held == 0
  if (is.null(fit$free) && any(moved)) {
    triangle[moved, moved] <- solve(factor[moved, moved], tol = 0)
    return(triangle)
  }
  factor <- diag(factor)
  first <- which(factor > 0)
  if (length(first)) triangle / (factor[first[1]] * triangle[first[1], first[1]]) else triangle
}

# That of a planned record, with columns behind those of the fit for what is unknown in it alone.
information_of <- function(fit, planned, call) {
  about <- fit$about
  shared <- about$parameters$record == 0L
  common <- intersect(names(planned$inputs), setdiff(about$unknown, about$per_record))
  if (length(common)) {
    abort_rotdyn(c(
      "{.field {common}} {?is/are} one unknown of all records: no record has its own number.",
      i = "{.code fit_scene(..., per_record = \"{common[1]}\")} gives each its own."
    ), "argument", call)
  }
  missing <- setdiff(names(planned$inputs), about$known$path)
  if (length(missing)) abort_unknown_input(missing, NULL, about$known$path, call)
  columns <- fit_observables(about$scene, call)
  missing <- setdiff(planned$observed, columns)
  if (length(missing)) {
    abort_rotdyn(c(
      "{.field {missing}} {?is/are} no column{?s} of the motion.",
      i = "The motion has {.field {columns}}."
    ), "argument", call)
  }
  check_among(names(planned$noise) %||% character(), "names(noise)", planned$observed, call)
  start <- about$scene$start_s %||% 0
  if (planned$time_s[1] < start) {
    abort_rotdyn("The planned record begins before the scene does, at {start} s.", "value", call)
  }
  fixed <- setdiff(names(planned$inputs), about$unknown)
  if (is.null(about$build)) {
    about$node <- node_with(about$node, fixed, planned$inputs[fixed], about$known)
  }
  about$records <- list(list(
    name = "planned", time_s = planned$time_s,
    series = stats::setNames(rep(list(rep(0, length(planned$time_s))), length(planned$observed)),
                             planned$observed),
    floor = stats::setNames(rep(list(0), length(planned$observed)), planned$observed)
  ))
  about$offset <- intersect(about$offset, planned$observed)
  about$factor <- intersect(about$factor, planned$observed)
  p <- about$parameters <- fit_parameters(about)
  at <- match_parameters(p, fit$about$parameters)
  first <- match(p$of, fit$about$parameters$of)
  x <- ifelse(is.na(at), ifelse(p$kind == "clock", 0, fit$found$x[first]), fit$found$x[at])
  own <- is.na(at) & p$of %in% names(planned$inputs)
  x[own] <- planned$inputs[p$of[own]]
  about$parameters$start <- x
  about$prior <- list()
  about$noise <- "white"
  problem <- fit_problem(about, call)
  values <- predicted_series(about, x, 1L, planned$time_s, call)
  for (k in seq_along(values)) problem$records[[1]]$series[[k]]$y <- values[[k]]
  problem$given <- planned_noise(fit, planned, call)
  # Each unknown has an effect, and there are more rows than unknowns: a prior that says nothing.
  problem$prior <- x
  problem$prior_sd <- 1e6 * ifelse(x == 0, 1, abs(x))
  found <- .Call(ffi_fit, problem, NULL)
  if (!is.null(found$refused)) abort_refused_fit(found, about, call)
  triangle <- matrix(found$triangle, nrow(p), byrow = TRUE)
  m <- nrow(fit$about$parameters)
  at[is.na(at)] <- m + seq_len(sum(is.na(at)))
  out <- matrix(0, nrow(p), max(m, at))
  out[, at] <- triangle
  # An unknown that the fit holds at an edge stays there.
  out[, which(fit$found$held != 0)] <- 0
  out
}

# Rows of the fit's parameters that those of a further record are; NA: new ones.
match_parameters <- function(p, of) {
  key <- function(q) paste(q$kind, q$of)
  ifelse(p$record == 0L, match(key(p), ifelse(of$record == 0L, key(of), NA)), NA_integer_)
}

# n, sigma, tau, white, cap, gain of each column: as given, else as found.
planned_noise <- function(fit, planned, call) {
  known <- noise_table(fit)
  unlist(lapply(planned$observed, function(column) {
    n <- length(planned$time_s)
    if (column %in% names(planned$noise)) return(c(n, planned$noise[[column]], 0, 1, 0, 0))
    at <- match(column, known$column)
    if (is.na(at)) {
      abort_rotdyn(c(
        "The noise of {.field {column}} is not known: the fit has no such column.",
        i = "{.code planned_record(..., noise = c({column} = ))}"
      ), "argument", call)
    }
    c(n, known$sigma[at], known$tau_s[at], known$white[at], 0, 0)
  }))
}

# Standard errors of the fit's parameters with a further record; NaN: not determined, or held.
errors_with <- function(fit, now, further) {
  p <- fit$about$parameters
  m <- nrow(p)
  total <- rbind(cbind(now, matrix(0, nrow(now), ncol(further) - m)), further)
  moved <- which(colSums(abs(total)) > 0)
  total <- total[, moved, drop = FALSE]
  length <- sqrt(colSums(total^2))
  parts <- svd(t(t(total) / length))
  # Directions that neither has are off by the errors of differences, 1e-7 of the largest each: of
  # a thrown body 6e-7.
  some <- parts$d > max(parts$d) * 1e-5
  spread <- parts$v[, some, drop = FALSE] %*% diag(1 / parts$d[some], sum(some)) / length
  error <- rep(NaN, ncol(further))
  error[moved] <- sqrt(rowSums(spread^2))
  if (!all(some)) {
    lost <- rowSums(abs(parts$v[, !some, drop = FALSE])) > 1e-3
    error[moved[lost]] <- NaN
  }
  error[seq_len(m)] * ifelse(p$log, fit$found$x, 1)
}
