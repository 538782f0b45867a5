#' Equations of motion of one's own
#'
#' A system of the first order whose right-hand side is an R function,
#' \deqn{\dot y = f(t, y), \qquad y(t_0) = y_0,}{y' = f(t, y),  y(t0) = y0,}
#' as a scene: [trajectory()], [work_precision()], [time_when()], [audit()] and the other verbs work
#' on it as on any other. Equations of the second order, \eqn{\ddot q = a}{q'' = a}, are written
#' with their rates as states: \eqn{\dot q = v, \dot v = a}{q' = v, v' = a}.
#'
#' **The function** is called with numbers by name: `time_s` and the states. It lists those that it
#' uses: `function(theta_rad, omega_rad_per_s)`, `function(time_s, x)`. With `...` it takes all that
#' it does not list: of many states `y <- c(...)` is the named vector. It returns a number for each
#' state, its rate, in the order of `start`; names of the result do not count. `conserved` are
#' functions of the same kind that return one number.
#'
#' **Names** of states are the columns of the trajectory. A name that ends in a unit as this package
#' writes them (`theta_rad`, `v_m_per_s`, `energy_j`) has that unit; others are pure numbers.
#'
#' **Models.** No closed form is known, so that the motion is integrated, by explicit steps or,
#' where these turn out stiff, implicit ones. By name, with steps of fixed length `step_s` (1/1000
#' of the span, if it is not given): `equations_euler`, `equations_semi_implicit`, `equations_rk4`.
#' Semi-implicit steps take new values of all states but the `positions`, then the rates of the
#' positions at these values, and so call f twice.
#'
#' Changes of f in a narrow interval of time or of a state are looked for: see `resolution` of
#' [trajectory()]; not where the motion is stiff, or the steps are of fixed length. Each state is a
#' measure of its own: the error figure is the largest error of a state relative to its largest
#' value.
#'
#' @param f A function of `time_s` and the states that returns their rates per second.
#' @param start The states at `start_s`: a vector (or a list) of 1 to 16 numbers with different
#'   names, which may not be `time_s`, `event`, `direction`, `where`, `true` or `reference`.
#' @param ... Not used; names after it must be given in full.
#' @param positions NULL, or the names of the states that are positions, for semi-implicit steps; at
#'   least one state is none.
#' @param conserved NULL, or a list with names of functions of the states, such as
#'   `list(energy_j = function(theta_rad, omega_rad_per_s) ...)`, that do not change in the motion.
#'   [audit()] compares their change from the first row to the last with what rounding and the error
#'   figure explain; [augment()][augment.rot_trajectory] adds their values row by row.
#' @param start_s Time at which the state above holds; earlier times are reached backwards.
#' @return A `rot_scene_equations`, which is a `rot_scene`. Its trajectory has the columns `time_s`
#'   and the states, under their names. The error figure is an estimate. [period_of()] and
#'   [stopping()] have no closed form to go by and refuse it, [write_scene()] and [records_add()]
#'   since a function has no text; [motion_events()] has no row: [time_when()] gives the times at
#'   which a state has a value.
#' @section Errors: `rotdyn_error_type` (no function, no numbers; an argument of a function that is
#'   neither `time_s` nor a state), `rotdyn_error_size` (a wrong number of rates),
#'   `rotdyn_error_value` (a state that is NA, NaN or Inf; names missing, given twice or reserved),
#'   `rotdyn_error_rhs` where a function fails or gives a number that is not finite, at the start or
#'   in a run, whose message has the time; an error raised by the function is its parent;
#'   `rotdyn_error_random` for one that gives two values for the same arguments;
#'   `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993),
#'   and Hairer and Wanner, II, 2nd ed. (1996).
#' @seealso [trajectory()], [work_precision()]; [torque_function()] for a torque of one's own in
#'   another scene.
#' @concept differential equation
#' @concept ODE
#' @concept right-hand side
#' @concept equations of motion
#' @concept Euler
#' @examples
#' # A pendulum, written by hand.
#' swing <- function(theta_rad, omega_rad_per_s) {
#'   c(omega_rad_per_s, -9.81 / 0.5 * sin(theta_rad))
#' }
#' energy <- function(theta_rad, omega_rad_per_s) {
#'   omega_rad_per_s^2 / 2 - 9.81 / 0.5 * cos(theta_rad)
#' }
#' scene <- scene_equations(
#'   swing, start = c(theta_rad = 0.2, omega_rad_per_s = 0), positions = "theta_rad",
#'   conserved = list(energy = energy)
#' )
#' motion <- trajectory(scene, time_s = 0:10)
#' motion
#' audit(motion)
#' # Its own Euler steps: the energy grows.
#' by_euler <- trajectory(scene, 0:10, accuracy = 1, model = "equations_euler", step_s = 0.01)
#' augment(by_euler)$energy
#' time_when(scene, theta_rad = 0)
#' # A planet; all states by `...`.
#' kepler <- function(...) {
#'   y <- c(...)
#'   c(y["vx"], y["vy"], -y[c("x", "y")] / sum(y[c("x", "y")]^2)^1.5)
#' }
#' trajectory(scene_equations(kepler, c(x = 1, y = 0, vx = 0, vy = 1)), c(0, 2 * pi))
#' @export
scene_equations <- function(f, start, ..., positions = NULL, conserved = NULL, start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("f", "start"), call)
  start <- check_states(start, call)
  start_s <- check_number(start_s, "start_s", "s", call)
  check_state_function(f, "f", names(start), call)
  check_rates(f, start, start_s, call)
  finish_scene("equations", list(
    f = f, start = start, positions = check_positions(positions, names(start), call),
    start_s = start_s, conserved = check_invariants(conserved, start, start_s, call)
  ), call)
}

# ---- checks -------------------------------------------------------------------------------------

# Columns that verbs put beside the states, and measures whose columns would be theirs.
reserved_states <- c("time_s", "event", "direction", "where", "true", "reference")
max_states <- 16L

check_states <- function(start, call) {
  remedy <- "Such as {.code start = c(theta_rad = 0.2, omega_rad_per_s = 0)}."
  numbers <- is_number(start) && !is.object(start) || (is.list(start) && !is.object(start))
  if (!numbers) {
    abort_rotdyn(c(
      "{.arg start} must be numbers with the names of the states.",
      x = "It is {describe_value(start)}.", i = remedy
    ), "type", call)
  }
  n <- length(start)
  if (n < 1L || n > max_states) {
    abort_rotdyn(c(
      "{.arg start} must have 1 to {max_states} states.", x = "It has {n}.", i = remedy
    ), "size", call)
  }
  check_own_names(names(start), "start", "states", remedy, call)
  values <- Map(function(x, name) {
    check_number(x, paste0("start$", name), gsub(" ", "*", unit_of_name(name)), call)
  }, unname(as.list(start)), names(start))
  stats::setNames(unlist(values, use.names = FALSE), names(start))
}

check_own_names <- function(names, arg, what, remedy, call) {
  fault <- if (is.null(names) || anyNA(names) || !all(nzchar(names))) {
    "One of them has no name."
  } else if (anyDuplicated(names)) {
    "{.val {names[duplicated(names)][1]}} is there twice."
  } else if (any(names %in% reserved_states)) {
    "{.val {intersect(names, reserved_states)}} {?is/are} a name of this package's own."
  }
  if (is.null(fault)) return(names)
  abort_rotdyn(c(
    paste0("The ", what, " in {.arg {arg}} must have different names."), x = fault, i = remedy
  ), "value", call)
}

check_state_function <- function(f, arg, states, call) {
  check_function(f, arg, call)
  known <- c("time_s", states)
  takes <- names(arguments_of(f))
  strange <- setdiff(required_arguments(f), known)
  # R would take a part of a name for it.
  if ("..." %in% takes) {
    listed <- setdiff(takes[seq_len(match("...", takes) - 1L)], known)
    passed <- setdiff(known, takes)
    strange <- union(strange, Filter(function(one) any(startsWith(one, passed)), listed))
  }
  if (!length(strange) && any(takes %in% c(known, "..."))) return(f)
  shape <- paste0("function(", paste(known, collapse = ", "), ")")
  abort_rotdyn(c(
    "{.arg {arg}} must be a function of {.code time_s} and the states, by name.",
    x = if (length(strange)) "Its argument{?s} {.arg {strange}} {?is/are} none of these." else
      "It takes none of them.",
    i = "Such as {.code {shape}}; what it does not use it need not list."
  ), "type", call)
}

check_positions <- function(positions, states, call) {
  if (is.null(positions)) return(NULL)
  if (!is.character(positions)) {
    abort_rotdyn(c(
      "{.arg positions} must be NULL or names of states.",
      x = "It is {describe_value(positions)}.", i = "The states are {.val {states}}."
    ), "type", call)
  }
  at <- match(unique(positions), states)
  if (anyNA(at)) {
    abort_rotdyn(c(
      "{.arg positions} must be names of states.",
      x = "{.val {setdiff(positions, states)}} {?is/are} none.",
      i = "The states are {.val {states}}."
    ), "value", call)
  }
  if (length(at) == length(states)) {
    abort_rotdyn(c(
      "{.arg positions} must leave a state that is no position.",
      i = "The others, such as velocities, take their new values first."
    ), "value", call)
  }
  if (length(at)) as.double(sort(at))
}

check_invariants <- function(conserved, start, start_s, call) {
  if (is.null(conserved)) return(NULL)
  remedy <- "Such as {.code conserved = list(energy_j = function(theta_rad, omega_rad_per_s) ...)}."
  if (!is.list(conserved) || is.object(conserved)) {
    abort_rotdyn(c(
      "{.arg conserved} must be NULL or a list of functions with names.",
      x = "It is {describe_value(conserved)}.", i = remedy
    ), "type", call)
  }
  if (!length(conserved)) return(NULL)
  taken <- intersect(names(conserved), names(start))
  if (length(taken)) {
    abort_rotdyn("{.val {taken}} in {.arg conserved} {?is/are} already {?a state/states}.", "value",
                 call)
  }
  check_own_names(names(conserved), "conserved", "functions", remedy, call)
  for (name in names(conserved)) {
    arg <- paste0("conserved$", name)
    check_state_function(conserved[[name]], arg, names(start), call)
    invariant_at(conserved[[name]], arg, start_s, start, call)
  }
  conserved
}

# The function is called twice at the start: what is wrong with it shows there.
check_rates <- function(f, start, start_s, call) {
  value <- values_at(f, "f", start_s, start, call)
  check_rates_value(value, start_s, names(start), call)
  if (!all(is.finite(value))) {
    bad <- which(!is.finite(value))[1]
    what <- paste(format(value[[bad]]), "for the rate of", quote_text(names(start)[bad]))
    abort_rhs("f", start_s, what, call)
  }
  again <- values_at(f, "f", start_s, start, call)
  if (!isTRUE(all.equal(as.double(value), as.double(again), tolerance = 1e-6))) {
    abort_rotdyn(c(
      "The function {.arg f} gives two values for the same arguments.", i = random_remedy
    ), "random", call)
  }
}

check_rates_value <- function(value, time_s, states, call) {
  n <- length(states)
  fits <- is_number(value) && !is.object(value)
  if (fits && length(value) == n) return(invisible())
  abort_rotdyn(c(
    "The function {.arg f} must return {n} number{?s}: the rate{?s} of {.val {states}}.",
    x = "At {format(time_s, digits = 17)} s it returned {describe_value(value)}.",
    i = if (is.list(value)) "Return {.code c(...)} alone, not in a list." else
      "In the order of {.arg start}, {.code c(...)}."
  ), if (fits) "size" else "type", call)
}

# ---- calls --------------------------------------------------------------------------------------

# f as a function of the time and all states, which are passed by name.
function_of_states <- function(f, states) {
  all <- c("time_s", states)
  takes <- names(arguments_of(f))
  if ("..." %in% takes || all(all %in% takes)) return(f)
  used <- intersect(all, takes)
  shell <- function() NULL
  formals(shell) <- stats::setNames(rep(list(quote(expr = )), length(all)), all)
  body(shell) <- as.call(c(quote(f), stats::setNames(lapply(used, as.name), used)))
  environment(shell) <- list2env(list(f = f), parent = baseenv())
  shell
}

# An error, unless it has a class of this package or ends the session's patience.
values_at <- function(f, arg, time_s, y, call) {
  arguments <- c(list(time_s = time_s), as.list(y))
  tryCatch(do.call(function_of_states(f, names(y)), arguments), error = function(e) {
    if (inherits(e, "rotdyn_error") || is_time_limit(e)) stop(e)
    abort_failed(arg, time_s, e, call)
  })
}

abort_failed <- function(arg, time_s, e, call) {
  abort_rotdyn(c(
    "The function {.arg {arg}} failed at {format(time_s, digits = 7)} s.",
    i = "Call it with the state there, or end {.arg time_s} before."
  ), "rhs", call, parent = e)
}

abort_rhs <- function(arg, time_s, what, call) {
  abort_rotdyn(c(
    "The function {.arg {arg}} must give finite numbers.",
    x = "At {format(time_s, digits = 7)} s it gave {what}.",
    i = "Look at it there, or end {.arg time_s} before."
  ), "rhs", call)
}

# One number of a conserved quantity.
invariant_at <- function(f, arg, time_s, y, call) {
  value <- values_at(f, arg, time_s, y, call)
  if (!is_number(value) || is.object(value) || length(value) != 1L) {
    abort_rotdyn(c(
      "The function {.arg {arg}} must return one number.",
      x = "At {format(time_s, digits = 7)} s it returned {describe_value(value)}."
    ), if (is_number(value) && !is.object(value)) "size" else "type", call)
  }
  if (!is.finite(value)) abort_rhs(arg, time_s, describe_value(value), call)
  as.double(value)
}

# How C calls the rates, see src/glue/torque.h.
rates_law <- function(f, scene, call) {
  states <- names(.subset2(scene, "start"))
  arguments <- stats::setNames(rep(list(NULL), length(states) + 1L), c("time_s", states))
  list(
    as.call(c(quote(f), arguments)),
    list2env(list(f = function_of_states(f, states)), parent = baseenv()),
    function(value, time_s) {
      check_rates_value(value, time_s, states, call)
      abort_rhs("f", time_s, describe_value(value), call)
    }
  )
}

# A run whose function of the states may fail: the error says when.
hear_rates <- function(run, call) {
  withCallingHandlers(run, error = function(e) {
    if (inherits(e, "rotdyn_error") || is_time_limit(e)) return()
    time_s <- NULL
    for (one in sys.calls()) {
      ours <- is.call(one) && identical(one[[1]], quote(f)) && is.double(one$time_s)
      if (ours) time_s <- one$time_s
    }
    if (!is.null(time_s)) abort_failed("f", time_s, e, call)
  })
}

#' @export
print.rot_scene_equations <- function(x, ...) {
  check_scene(x, current_env())
  states <- names(x$start)
  units <- vapply(states, unit_of_name, "")
  values <- paste0(states, " ", format_si(x$start), ifelse(units == "1", "", paste0(" ", units)))
  line <- function(what, text) {
    if (length(text)) say(strwrap(toString(text), initial = sprintf("  %-11s ", what),
                                  prefix = strrep(" ", 14), width = print_width()), sep = "\n")
  }
  say("<rot_scene> ", scene_title(x), "\n")
  line("rates", paste0("f(", toString(names(arguments_of(x$f))), ")"))
  line("start", c(values, paste("at", format_si(x$start_s), "s")))
  line("positions", states[x$positions])
  line("conserved", names(x$conserved))
  invisible(x)
}
