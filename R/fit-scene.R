# Unknown inputs of a scene from records of its motion: the problem that the core solves.

#' Fit a scene's unknowns to records
#'
#' Any inputs of any scene, found by least squares from any columns of its motion. The motion is
#' that of [trajectory()], events included: a stop, a slip or a lock inside the record bends no
#' derivative.
#'
#' With the observed columns `y_k` of the records, the motion `x_k` of the scene with the unknowns
#' `p`, and weights from the noise that the residuals show
#' \deqn{\sum_k \sum_i [y_k(t_i) - b_k - a_k\,x_k(t_i + s; p)]^2 / \sigma_k^2 = \min}{
#'   sum (y - b - a x(t + s; p))^2/sigma^2 = min}
#' where offset `b`, factor `a` and clock `s` of the instrument are fitted where asked for (0, 1
#' and 0 otherwise). Of a positive unknown the logarithm is fitted. Steps stay in the domain of each
#' input (see [sweep_inputs()]); an unknown that the record pushes to its edge is held there, and
#' its limit is where the sum of squares has grown as much as the level asks.
#'
#' A scene with R functions, and one that `build` makes, is run by [trajectory()] at each step: some
#' milliseconds where the core needs microseconds.
#'
#' Derivatives are differences of exact motions, with steps that follow from the error figure of the
#' motion. The noise of each column is white, or white and an Ornstein-Uhlenbeck process, by
#' restricted likelihood (REML); neighbours may be anticorrelated. Where its size grows or falls
#' over a record, samples weigh by it.
#'
#' **Outliers**: a sample whose residual, without the correlation of the noise, exceeds 4.5 standard
#' deviations and differs as much from the median of the four nearest is left out and named, as long
#' as no more than 3 % of a column are; more are no outliers but a law that does not fit.
#'
#' **Counters**: where a column has a resolution D (a counter, an encoder, few digits), its noise is
#' at least `D/sqrt(12)`. Of a record of that column alone that counts in one direction, where a
#' count repeats four times or more, the times at which it changes are fitted instead of the counts;
#' in others n equal counts weigh as one. Where other noise is below a fifth of D, errors are those
#' of a sawtooth of the fitted motion, for any zero of the counter: those of two samples are as
#' correlated as the motion between them makes them. If one wave of it causes a part of an unknown's
#' error, intervals of low level are those of a sine with a random phase and of normal errors.
#'
#' What a record does not tell is said: combinations of unknowns that change without changing the
#' motion have no standard error (`status` is `"not determined"`), and `glance()` has the condition
#' of the problem.
#'
#' @param scene A scene; its numbers are where the search starts. NULL with `build`.
#' @param records A data frame with `time_s` and columns of the scene's motion (`theta_rad`,
#'   `omega_x_rad_per_s`, `x_m`, ...; of several rows for each time `theta_rad[2]`, or these rows),
#'   a [motion_record()], or a list of them. NA: not measured. Each segment of a record is one of
#'   its own. Date-times become seconds since the first. Rows that repeat another exactly are left
#'   out, with a warning.
#' @param unknown Paths of inputs, see [sweep_inputs()]; a vector (`"omega0_rad_per_s"` of a free
#'   body) stands for its elements. With `build`, named numbers: where the search starts.
#' @param ... Not used: an unknown argument is an error.
#' @param build A function of a list of the unknowns by their names that returns a scene, instead of
#'   `scene`: for numbers that are in a law or in equations of one's own.
#' @param lower,upper Limits of unknowns, by their names, within the domains of the inputs. With a
#'   lower limit of 0 an unknown is positive, and its logarithm is fitted.
#' @param per_record Those of `unknown` that each record has for itself; the others are shared.
#' @param observed Columns to fit; NULL: all of the records that the motion has; of a computed
#'   motion those of its state, from which the others follow, with a message.
#' @param prior A list of [measured()] quantities, by the name of the unknown: what is known of it
#'   beforehand, with a standard uncertainty above 0. What is known exactly belongs to the scene.
#' @param offset,factor Observed columns whose instrument has an unknown zero, an unknown scale.
#' @param clock TRUE: the time of the records begins at an unknown moment, one for each of them.
#' @param noise `"find"`, `"white"` for uncorrelated residuals, or known standard deviations of
#'   white noise, named by the observed columns: then the sum of squares tests the law
#'   ([residual_tests()]).
#' @param outliers `"leave_out"`, or `"keep"`.
#' @param level Level of the intervals.
#' @param starts Further starts, spread over a tenth to ten times the scene's numbers, by which a
#'   second minimum is seen.
#' @param accuracy Of the motions, as in [trajectory()].
#' @return A tibble of class `rot_fit` with a row for each unknown and the columns
#'   `r describe_columns(fit_columns, fit_meanings)`
#'   `augment()` gives the records with the fitted motion, `glance()` and `summary()` one row,
#'   [predict()] the motion at any time, [as_scene()] the scene, [vcov()], [coef()], [confint()] and
#'   [residuals()][fit_verbs] what they are elsewhere.
#' @section Errors: `rotdyn_error_argument` for an unknown that is no input, is derived, or is there
#'   twice, and for a column that the motion lacks; `rotdyn_error_value` for a start outside the
#'   domain or its limits, an unknown without effect on what was observed (beyond rounding), a prior
#'   without uncertainty, and times before the scene's start; `rotdyn_error_size` for fewer samples
#'   than unknowns; `rotdyn_error_range` for a start whose motion or residuals leave double
#'   precision; `rotdyn_error_type`. An error of an R function is passed on; where `build` or the
#'   constructors in it refuse the numbers of a step, the step is shortened. A fit that does not
#'   converge, whose records repeat rows, or whose counts are rounded down, comes with a warning of
#'   class `rotdyn_warning_fit`.
#' @source More, Lecture Notes in Mathematics 630, 105 (1978) for the steps; Harville, J. Am. Stat.
#'   Assoc. 72, 320 (1977) for REML; Widrow and Kollar, Quantization Noise (2008) for counters.
#' @seealso [fit_coast_down()], [fit_swing()], [sweep_inputs()], [motion_record()].
#' @concept parameter estimation
#' @concept nonlinear regression
#' @concept measurement
#' @concept system identification
#' @examples
#' # A ball is bowled: it slips, then rolls.
#' lane <- scene_incline(
#'   body_sphere(6, 0.108), 0, static_friction = 0.12, v0_m_per_s = 8, omega0_rad_per_s = 0
#' )
#' set.seed(1)
#' film <- trajectory(lane, 0:90 / 30)[c("time_s", "x_m")]
#' film$x_m <- film$x_m + rnorm(91, 0, 0.01)
#' guess <- scene_incline(
#'   body_sphere(6, 0.108), 0, static_friction = 0.2, v0_m_per_s = 7, omega0_rad_per_s = 0
#' )
#' fit <- fit_scene(guess, film, c("static_friction", "v0_m_per_s"))
#' fit
#' as_scene(fit)
#'
#' # The law of a spring that stiffens, as an R function.
#' spring <- function(p) {
#'   law <- function(time_s, theta_rad, omega_rad_per_s) {
#'     -p$stiffness_n_m_per_rad * theta_rad - p$cubic_n_m_per_rad3 * theta_rad^3
#'   }
#'   scene_axle(0.01, law, theta0_rad = 1)
#' }
#' swing <- trajectory(spring(list(stiffness_n_m_per_rad = 2, cubic_n_m_per_rad3 = 1)), 0:40 / 40)
#' swing$theta_rad <- swing$theta_rad + rnorm(41, 0, 0.01)
#' fit_scene(
#'   build = spring, records = swing[c("time_s", "theta_rad")],
#'   unknown = c(stiffness_n_m_per_rad = 2.2, cubic_n_m_per_rad3 = 0.5),
#'   lower = c(stiffness_n_m_per_rad = 0)
#' )
#' @export
fit_scene <- function(scene, records, unknown, ..., build = NULL, lower = NULL, upper = NULL,
                      per_record = character(), observed = NULL, prior = list(),
                      offset = character(), factor = character(), clock = FALSE, noise = "find",
                      outliers = "leave_out", level = 0.95, starts = 0, accuracy = 1e-10) {
  call <- check_no_dots(...)
  check_supplied(c(if (is.null(build)) "scene", "records", "unknown"), call)
  about <- list(
    build = build, noise = noise,
    outliers = check_choice(outliers, "outliers", c("leave_out", "keep"), call),
    level = check_level(level, call),
    accuracy = check_number(accuracy, "accuracy", "1", call, lower = 0, open = TRUE)
  )
  starts <- floor(check_number(starts, "starts", "1", call, 0, 1000))
  if (is.null(build)) {
    about <- fit_of_scene(about, scene, unknown, call)
  } else if (missing(scene) || is.null(scene)) {
    about <- fit_of_build(about, build, unknown, call)
  } else {
    abort_rotdyn("{.arg scene} and {.arg build} are given: only one describes the motion.",
                 "argument", call)
  }
  scene <- about$scene
  about$known <- with_limits(about, lower, upper, call)
  if (is.character(per_record)) per_record <- with_elements(per_record, about$unknown)
  about$per_record <- check_among(per_record, "per_record", about$unknown, call)
  about$records <- fit_records(records, scene, observed, call)
  columns <- unique(unlist(lapply(about$records, function(r) names(r$series))))
  about$noise <- check_fit_noise(noise, columns, call)
  about$offset <- check_among(offset, "offset", columns, call)
  about$factor <- check_among(factor, "factor", columns, call)
  about$clock <- check_flag(clock, "clock", call)
  about$parameters <- fit_parameters(about)
  about$prior <- check_priors(prior, about, call)
  about$problem <- fit_problem(about, call)
  found <- solve_fit(about, starts, call)
  cleaned <- with_growing_noise(about, found)
  if (about$outliers != "keep") {
    cleaned <- without_outliers(cleaned$about, cleaned$found)
    cleaned <- with_growing_noise(cleaned$about, cleaned$found)
  }
  warn_rounded_down(cleaned$about, cleaned$found, call)
  new_scene_fit(cleaned$about, without_drift(cleaned$about, cleaned$found), call)
}

# ---- checks -------------------------------------------------------------------------------------

fit_of_scene <- function(about, scene, unknown, call) {
  check_scene(scene, call)
  about$scene <- scene
  about$node <- scene_node_with_functions(scene, call)
  about$known <- inputs_that_vary(about$node)
  about$unknown <- check_unknown(unknown, about, call)
  about$node <- node_that_follows(about$node, about$unknown, about$known, call)
  about$calls_r <- has_functions(about$node)
  about
}

fit_of_build <- function(about, build, unknown, call) {
  about$known <- unknown_of_build(unknown, build, call)
  about$unknown <- about$known$path
  about$scene <- scene_of_numbers(
    about, stats::setNames(about$known$value, about$unknown), call
  )
  about$node <- scene_node_with_functions(about$scene, call)
  about$calls_r <- TRUE
  about
}

# The domains of the unknowns, narrowed by the limits that the caller gives.
with_limits <- function(about, lower, upper, call) {
  known <- about$known
  check_limits <- function(x, arg) {
    if (is.null(x)) return(double())
    check_among(names(x) %||% "", paste0("names(", arg, ")"), about$unknown, call)
    if (!is.numeric(x) || is.object(x) || anyNA(x)) {
      abort_rotdyn(c(
        "{.arg {arg}} must be numbers.", x = "It is {describe_value(x)}."
      ), "type", call)
    }
    x
  }
  lower <- check_limits(lower, "lower")
  upper <- check_limits(upper, "upper")
  at <- match(names(lower), known$path)
  # From 0 on: positive, as the inputs of scenes are.
  known$above[at] <- known$above[at] & lower <= known$low[at] | lower == 0
  known$low[at] <- pmax(known$low[at], lower)
  at <- match(names(upper), known$path)
  known$high[at] <- pmin(known$high[at], upper)
  empty <- known$path[known$low >= known$high & known$path %in% about$unknown]
  if (length(empty)) {
    abort_rotdyn("No number of {.field {empty}} is above its lower and below its upper limit.",
                 "value", call)
  }
  known
}

# A vector stands for its elements: omega0_rad_per_s for omega0_rad_per_s[1] to [3].
with_elements <- function(names, paths) {
  vector <- without_place(paths)
  vector[vector == paths] <- NA
  unlist(lapply(names, function(name) {
    own <- paths[vector %in% name]
    if (name %in% paths || !length(own)) name else own
  }))
}

check_unknown <- function(unknown, about, call) {
  if (!is.character(unknown) || !length(unknown) || anyNA(unknown)) {
    abort_rotdyn("{.arg unknown} must be paths of {.fn sweep_inputs}.", "type", call)
  }
  unknown <- with_elements(unknown, about$known$path)
  if (anyDuplicated(unknown)) {
    abort_rotdyn("{.field {unknown[duplicated(unknown)]}} {?is/are} in {.arg unknown} twice.",
                 "argument", call)
  }
  missing <- setdiff(unknown, about$known$path)
  if (length(missing)) abort_unknown_input(missing, NULL, about$known$path, call)
  at <- match(unknown, about$known$path)
  none <- unknown[!is.finite(about$known$value[at])]
  if (length(none)) {
    abort_rotdyn(c(
      "{.field {none}} {?has/have} no number in the scene to start from.",
      i = "Describe the scene with one."
    ), "value", call)
  }
  unknown
}

# "find", "white", or the s.d. of each column.
check_fit_noise <- function(noise, columns, call) {
  if (is.character(noise)) return(check_choice(noise, "noise", c("find", "white"), call))
  names <- names(noise) %||% ""
  noise <- check_finite(noise, "noise", "SI", call)
  odd <- noise[!(noise > 0)]
  if (length(odd)) {
    abort_rotdyn(c(
      "{.arg noise} must be standard deviations, above 0.", x = "It is {format(odd[1])}."
    ), "value", call)
  }
  check_among(names, "names(noise)", columns, call)
  missing <- setdiff(columns, names)
  if (length(missing) || anyDuplicated(names)) {
    abort_rotdyn("{.arg noise} must have a number for each of {.field {columns}}.", "argument",
                 call)
  }
  stats::setNames(noise, names)
}

check_among <- function(x, arg, of, call) {
  if (is.null(x)) return(character())
  odd <- if (is.character(x)) setdiff(x, of) else "?"
  if (!is.character(x) || length(odd)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be among {.or {.val {of}}}.", x = "It is {describe_value(x)}."
    ), if (is.character(x)) "argument" else "type", call)
  }
  unique(x)
}

check_priors <- function(prior, about, call) {
  names <- about$parameters$name
  if (!is.list(prior) || (length(prior) && !all(rlang::have_name(prior)))) {
    abort_rotdyn("{.arg prior} must be a named list of {.fn measured} quantities.", "type", call)
  }
  check_among(names(prior) %||% character(), "names(prior)", names, call)
  prior <- lapply(prior, function(x) as_measured(x, "prior", "1", call))
  exact <- names(prior)[vapply(prior, function(x) !all(x$u > 0), NA)]
  if (length(exact)) {
    abort_rotdyn(c(
      "{.arg prior} needs a standard uncertainty above 0 for {.field {exact}}.",
      i = "What is known exactly is no unknown: give it to the scene and leave it out of
           {.arg unknown}.",
      i = "Else give {.code measured(value, u)}."
    ), "value", call)
  }
  prior
}

# ---- the problem --------------------------------------------------------------------------------

# A row for each number that is fitted: kind ("input", "offset", "factor", "clock"), what it is of
# (a path or a column), the record that has it for itself (0: all).
fit_parameters <- function(about) {
  records <- seq_along(about$records)
  each <- lapply(about$unknown, function(path) if (path %in% about$per_record) records else 0L)
  others <- c(about$offset, about$factor)
  clocks <- if (about$clock) records
  rows <- list(
    kind = rep(c("input", "offset", "factor", "clock"), c(
      sum(lengths(each)), length(about$offset), length(about$factor), length(clocks)
    )),
    of = c(rep(about$unknown, lengths(each)), others, rep("time_s", length(clocks))),
    record = c(unlist(each), rep(0L, length(others)), clocks)
  )
  rows <- list2DF(rows)
  rows$label <- ifelse(rows$kind == "input", rows$of, paste(rows$kind, "of", rows$of))
  single <- rows$record == 0L | length(records) == 1L
  rows$name <- ifelse(single, rows$label, paste0(rows$label, " (", rows$record, ")"))
  at <- match(rows$of, about$known$path)
  input <- rows$kind == "input"
  largest <- .Machine$double.xmax
  rows$low <- ifelse(input, pmax(about$known$low[at], -largest), -largest)
  # No time of a record is before the scene's start.
  for (i in which(rows$kind == "clock")) {
    rows$low[i] <- (about$scene$start_s %||% 0) - about$records[[rows$record[i]]]$time_s[1]
  }
  rows$high <- ifelse(input, pmin(about$known$high[at], largest), largest)
  rows$above <- input & about$known$above[at] %in% TRUE
  rows$start <- ifelse(input, about$known$value[at], as.double(rows$kind == "factor"))
  rows$unit <- ifelse(input, plain_units(about$known$unit[at]), NA)
  rows$log <- rows$above & rows$low == 0
  rows
}

fit_problem <- function(about, call) {
  p <- about$parameters
  outside <- p$start < p$low | p$start > p$high | (p$above & p$start == p$low)
  if (any(outside)) {
    abort_rotdyn("{.field {p$name[outside]}} start{?s/} outside {?its/their} domain.", "value",
                 call)
  }
  place <- function(kind, of, r) {
    at <- which(p$kind == kind & p$of == of & p$record %in% c(0L, r))
    if (length(at)) at[1] - 1 else -1
  }
  p$unit[p$kind == "offset"] <- unit_of_column(p$of[p$kind == "offset"])
  p$unit[p$kind == "factor"] <- "1"
  p$unit[p$kind == "clock"] <- "s"
  prior <- function(what) vapply(p$name, function(name) {
    about$prior[[name]][[what]] %||% NaN
  }, double(1), USE.NAMES = FALSE)
  list(
    node = about$node, run = if (about$calls_r) run_for_fit(about, call), inputs = about$unknown,
    start = p$start, logarithm = as.double(p$log),
    low = p$low, high = p$high, given = given_noise(about), prior = prior("value"),
    prior_sd = prior("u"), unit = p$unit, accuracy = about$accuracy, max_steps = 1e6,
    threshold = if (identical(about$noise, "find")) 2 else Inf,
    records = lapply(seq_along(about$records), function(r) {
      record <- about$records[[r]]
      list(
        time_s = record$time_s, shift = place("clock", "time_s", r),
        unknown = vapply(about$unknown, function(path) place("input", path, r), double(1)),
        value = about$known$value[match(about$unknown, about$known$path)],
        series = unname(Map(function(y, name) {
          index <- if (grepl("\\[[0-9]+\\]$", name)) {
            as.double(sub("^.*\\[([0-9]+)\\]$", "\\1", name))
          } else {
            0
          }
          list(
            column = without_place(name), place = index, y = y,
            offset = place("offset", name, r), factor = place("factor", name, r),
            weight = record$weight[[name]],
            rounding = 4 * .Machine$double.eps * max(abs(y[is.finite(y)]), 0),
            floor = record$floor[[name]], count = record$count[[name]] %||% 0
          )
        }, record$series, names(record$series)))
      )
    })
  )
}

# Numbers of the noise of a series: samples, s.d., correlation time, white part, whether that time
# is at its cap, gain of the likelihood.
noise_numbers <- 6L

given_noise <- function(about) {
  if (is.character(about$noise)) return(NULL)
  unlist(lapply(about$records, function(record) {
    Map(function(y, name) c(sum(is.finite(y)), about$noise[[name]], 0, 1, 0, 0), record$series,
        names(record$series))
  }), use.names = FALSE)
}

# The best of the fits from the scene's numbers and from further starts.
solve_fit <- function(about, starts, call) {
  p <- about$parameters
  samples <- sum(vapply(about$records, function(r) sum(vapply(r$series, function(y) {
    sum(is.finite(y))
  }, 0L)), 0L)) + length(about$prior)
  if (samples <= nrow(p)) {
    abort_rotdyn(c(
      "There are too few samples for {nrow(p)} unknown{?s}.", x = "There {?is/are} {samples}."
    ), "size", call)
  }
  if (nrow(p) > 14L) {
    abort_rotdyn("{.fn fit_scene} fits at most 14 numbers at a time, not {nrow(p)}.", "size", call)
  }
  problem <- about$problem
  one <- function(start) {
    problem$start <- start
    .Call(ffi_fit, problem, progress_bar("fit"))
  }
  found <- one(p$start)
  if (!is.null(found$refused)) abort_refused_fit(found, about, call)
  found$others <- double()
  if (starts > 0) {
    varied <- which(p$kind == "input")
    laws <- lapply(varied, function(k) {
      size <- if (p$start[k] == 0) 1 else abs(p$start[k])
      if (p$log[k]) return(vary_loguniform(size / 10, size * 10))
      vary_uniform(max(p$low[k], p$start[k] - 3 * size), min(p$high[k], p$start[k] + 3 * size))
    })
    names(laws) <- paste0("u", varied)
    design <- do.call(design_sobol, c(list(2^ceiling(log2(starts + 1)), seed = 1), laws))
    rows <- as.matrix(design_rows(design, 1, starts)[names(laws)])
    for (i in seq_len(starts)) {
      start <- p$start
      start[varied] <- rows[i, ]
      again <- tryCatch(one(start), rotdyn_error = function(e) NULL)
      if (is.null(again) || !is.null(again$refused) || again$numbers[1] != 0) next
      found$others <- c(found$others, misfit_of(again))
      if (found$numbers[1] != 0 || misfit_of(again) < misfit_of(found)) {
        again$others <- found$others
        found <- again
      }
    }
  }
  if (found$numbers[1] != 0 && found$numbers[5] == 0) {
    abort_rotdyn(c(
      "The search cannot begin: at its start the motion needs too many steps, or it or its residuals
       leave double precision.",
      i = "Give the scene a start whose motion is of the size of the record."
    ), "range", call)
  }
  found
}

# Minus the logarithm of the likelihood, with the noise that was found or given, but for what all
# have.
misfit_of <- function(found) {
  noise <- matrix(found$noise, noise_numbers)
  sum(noise[1L, ] * log(noise[2L, ])) + found$numbers[2] / 2
}

# Along directions in which the motion does not change the search drifts: with one unknown of each
# held at its start (`hold`) the fit is that nearest to it. Columns of what is held follow from
# J v = 0.
without_drift <- function(about, found) {
  p <- about$parameters
  free <- if (found$numbers[1] == 0) free_directions(found, about)
  if (is.null(free)) return(found)
  found$free <- free
  v <- free$v
  hold <- integer()
  for (k in seq_len(ncol(v))) {
    hold[k] <- which.max(abs(v[, k]) * !seq_len(nrow(v)) %in% hold)
  }
  if (kappa(v[hold, , drop = FALSE]) > 1e6) return(found)
  variable <- function(x) ifelse(p$log, log(x), x)
  along <- solve(v[hold, , drop = FALSE], (variable(p$start) - variable(found$x))[hold])
  u <- variable(found$x) + drop(v %*% along)
  problem <- about$problem
  problem$start <- pmin(pmax(ifelse(p$log, exp(u), u), problem$low), problem$high)
  problem$start[hold] <- problem$low[hold] <- problem$high[hold] <- p$start[hold]
  again <- .Call(ffi_fit, problem, NULL)
  if (!is.null(again$refused) || again$numbers[1] != 0) return(found)
  triangle <- matrix(again$triangle, nrow(p), byrow = TRUE)
  rest <- -triangle[, -hold, drop = FALSE] %*% v[-hold, , drop = FALSE]
  triangle[, hold] <- rest %*% solve(v[hold, , drop = FALSE])
  again$triangle <- as.double(t(triangle))
  again$held[hold] <- 0
  again$numbers[3] <- found$numbers[3]
  again$numbers[5:6] <- again$numbers[5:6] + found$numbers[5:6]
  again$others <- found$others
  again$free <- free
  again
}

# ---- outliers -----------------------------------------------------------------------------------

# The fit without the samples that are too far off, and where they were: about$outliers_at, rows of
# record, column (place in the series) and row. Many of them are kept: the law does not fit.
without_outliers <- function(about, found) {
  first <- list(about = about, found = found)
  left <- NULL
  for (round in 1:6) {
    if (found$numbers[1] != 0) break
    new <- outliers_of(about, found)
    if (!nrow(new)) break
    left <- rbind(left, new)
    for (i in seq_len(nrow(new))) {
      r <- new$record[i]
      k <- new$column[i]
      about$records[[r]]$series[[k]][new$row[i]] <- NaN
      about$problem$records[[r]]$series[[k]]$y[new$row[i]] <- NaN
    }
    size <- lengths(lapply(about$records, `[[`, "time_s"))
    many <- tabulate(left$record, length(size)) > pmax(1, 0.03 * size * lengths(lapply(
      about$records, `[[`, "series"
    )))
    if (any(many)) return(first)
    problem <- about$problem
    problem$start <- found$x
    again <- .Call(ffi_fit, problem, NULL)
    if (!is.null(again$refused)) return(first)
    again$others <- found$others
    found <- again
  }
  about$outliers_at <- left
  list(about = about, found = found)
}

# Residuals beyond 4.5 s.d. that are as far from the median of the four nearest, too: where the law
# fails its neighbours are off with a sample. Outliers make the noise that was found larger: it
# counts by the median.
outliers_of <- function(about, found) {
  at <- 0
  rows <- list()
  for (r in seq_along(about$records)) {
    record <- about$records[[r]]
    for (k in seq_along(record$series)) {
      n <- length(record$time_s)
      e <- found$white[at + seq_len(n)]
      at <- at + n
      known <- which(is.finite(e))
      m <- length(known)
      if (m < 12L) next
      e <- e[known]
      size <- max(min(1, stats::median(abs(e)) / stats::qnorm(0.75)), 0.2)
      for (i in which(abs(e) > 4.5 * size)) {
        near <- seq(min(max(i - 2L, 1L), m - 4L), length.out = 5L)
        if (abs(e[i] - stats::median(e[setdiff(near, i)])) > 4.5 * size) {
          rows[[length(rows) + 1L]] <- data.frame(record = r, column = k, row = known[i])
        }
      }
    }
  }
  do.call(rbind, rows) %||% data.frame(record = integer(), column = integer(), row = integer())
}

# ---- noise that grows ---------------------------------------------------------------------------

# The fit with weights for a noise whose s.d. grows or falls over a record as exp(slope t): its
# factor from the first sample to the last in record$trend. Of a counter the counts give them.
with_growing_noise <- function(about, found) {
  if (!is.character(about$noise)) return(list(about = about, found = found))
  for (round in 1:4) {
    before <- list(about = about, found = found)
    if (found$numbers[1] != 0) break
    at <- 0
    for (r in seq_along(about$records)) {
      record <- about$records[[r]]
      for (k in seq_along(record$series)) {
        rows <- at + seq_along(record$time_s)
        at <- at + length(record$time_s)
        if (record$floor[[k]] > 0) next
        slope <- trend_of(record$time_s, found$white[rows], found$fitted[rows], record$series[[k]])
        if (slope == 0) next
        name <- names(record$series)[k]
        x <- record$time_s - mean(record$time_s[is.finite(found$white[rows])])
        weight <- exp(slope * x) * (record$weight[[name]] %||% 1)
        about$records[[r]]$weight[[name]] <- about$problem$records[[r]]$series[[k]]$weight <- weight
        about$records[[r]]$trend[[name]] <- weight[length(weight)] / weight[1]
      }
    }
    if (identical(about, before$about)) break
    problem <- about$problem
    problem$start <- found$x
    again <- .Call(ffi_fit, problem, NULL)
    if (!is.null(again$refused) || again$numbers[1] != 0) return(before)
    again$others <- found$others
    found <- again
  }
  list(about = about, found = found)
}

# Counts that are rounded down are half a count from the angle: with an offset of this size, which
# is not fitted, the motion fits better.
warn_rounded_down <- function(about, found, call) {
  columns <- unlist(lapply(about$records, function(r) {
    names(r$series)[unlist(r$floor, use.names = FALSE) > 0]
  }))
  if (found$numbers[1] != 0 || nrow(about$parameters) >= 14L) return(invisible())
  for (column in setdiff(columns, about$offset)) {
    more <- about
    more$offset <- c(about$offset, column)
    more$parameters <- fit_parameters(more)
    known <- match(about$parameters$name, more$parameters$name)
    more$parameters$start[known] <- found$x
    problem <- fit_problem(more, call)
    again <- tryCatch(.Call(ffi_fit, problem, NULL), rotdyn_error = function(e) NULL)
    if (is.null(again) || !is.null(again$refused) || again$numbers[1] != 0) next
    k <- setdiff(seq_len(nrow(more$parameters)), known)
    u <- sqrt(matrix(again$covariance, nrow(more$parameters))[k, k])
    half <- max(vapply(about$records, function(r) r$floor[[column]] %||% 0, 0)) * sqrt(3)
    # Not the half count of a law that fails.
    if (!isTRUE(u < half / 6 && abs(abs(again$x[k]) - half) < 3 * u + half / 5)) next
    warn_rotdyn(c(
      "The zero of {.field {column}} is off by half a count: the counts may be rounded down.",
      i = "An offset of {format_si(again$x[k], 3)} fits better: give {.code offset = \"{column}\"},
           or {.code floor = TRUE} to {.fn motion_record}."
    ), "fit", call)
  }
}

abort_refused_fit <- function(found, about, call) {
  at <- found$at + 1
  n <- length(about$unknown)
  if (at > n + 1) {
    abort_rotdyn(c(
      "{.field {about$parameters$name[at - n - 1]}} has no effect on what was observed.",
      x = "It has none at the scene's numbers, where the fit begins.",
      i = "Leave it out of {.arg unknown}, or begin from other numbers."
    ), "value", call)
  }
  name <- about$unknown[at]
  abort_rotdyn(c(
    "The fit cannot begin: {found$refused}.", i = if (!is.na(name)) "At {.field {name}}."
  ), "argument", call)
}
