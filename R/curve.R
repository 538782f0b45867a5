#' Rolling along a curve
#'
#' A body rolls without slipping, or slides without friction, along a smooth curve under gravity:
#' times, speeds, the push of the track and the friction that rolling needs, until it arrives,
#' turns, leaves the track or slips.
#' \deqn{v^2 = v_0^2 + \frac{2 g (y_0 - y)}{1 + \beta},\quad t = \int \frac{ds}{v},\quad
#'   \frac{N}{m} = v^2 \kappa + g \cos\theta,\quad
#'   \frac{f}{m} = -\frac{\beta}{1 + \beta} g \sin\theta}{
#'   v^2 = v0^2 + 2 g (y0 - y)/(1 + beta),  t = int ds/v,  N/m = v^2 kappa + g cos(theta),
#'   f/m = -beta/(1 + beta) g sin(theta)}
#'
#' The curve is the path of the body's **centre**, at its radius from the track; y is up. The track
#' is to the right of the path as its parameter grows: below y(x), outside of a loop that is run
#' through counter-clockwise. The curvature kappa is positive where the path bends away from it.
#'
#' A start from rest is a singularity of the integral. It is removed by the substitution
#' u = u0 + (u1 - u0) s^2, with the drop as the mean of the slope where y0 - y would cancel; an end
#' at rest likewise. The quadrature halves its panels until two rules agree.
#'
#' Derivatives are taken from the function's own formula where R's [stats::D()] knows it; else give
#' them. A table is joined by a cubic spline.
#'
#' @param curve A function y(x) of one argument, or what `curve_function()`, `curve_path()`,
#'   `curve_table()`, `curve_circle()` or `curve_cycloid()` returned.
#' @param from,to Where the motion starts and ends: x of a function or a table, the parameter of a
#'   path, the angle in rad from the lowest point of a circle, of the rolling wheel of a cycloid.
#' @param body A `rot_body` that is round about its z axis; or one number, beta = I/(m r^2), for a
#'   body of 1 kg. 0 slides without friction.
#' @param v0_m_per_s Speed at the start, at least 0, in the direction from `from` to `to`.
#' @param friction Coefficient of static friction, at least 0; Inf: never slips.
#' @param rows Number of rows, at even steps of the parameter.
#' @param gravity_m_per_s2 Acceleration of gravity, greater than 0.
#' @param x,y Functions of one argument, for `curve_function()` y(x), for `curve_path()` of the
#'   parameter; vectorised.
#' @param slope,second First and second derivative of y(x), as functions.
#' @param derivatives A list of four functions: x', y', x'', y''.
#' @param x_m,y_m At least three points of a table, x increasing.
#' @param radius_m Radius of the circle of the body's centre, or of the wheel of a cycloid; > 0.
#' @param ... Not used: an unknown argument is an error.
#' @param object What `roll_on_curve()` returned.
#' @return `roll_on_curve()`: a tibble of class `rot_curve_motion` with rows from the start to where
#'   the motion ends, and `r describe_columns(curve_columns, curve_meanings[curve_shown])`
#'   The event of the last row is `"arrives"`, `"turns"` (it comes to rest and rolls back),
#'   `"leaves"` (the track would have to pull) or `"slips"`; the motion is not followed beyond it.
#'
#'   `summary()`: one row with `r describe_columns(curve_summary_columns, curve_meanings[curve_meant])`
#'
#'   The curves: objects of class `rot_curve`.
#' @section Errors: `rotdyn_error_value` for a start at rest on level ground or uphill, a curve that
#'   is not finite, or one that bends more than the body fits; `rotdyn_error_type`,
#'   `rotdyn_error_size`, `rotdyn_error_missing`, `rotdyn_error_argument`; `rotdyn_error_type` for a
#'   function whose derivative is unknown. Errors of the curve's functions are passed on.
#' @source Kleppner and Kolenkow, An Introduction to Mechanics, 2nd ed. (2014), chapter 7; for the
#'   brachistochrone Goldstein, Poole and Safko (2002), section 2.2.
#' @seealso [loop_start_height()], [scene_incline()] for a plane.
#' @concept brachistochrone
#' @concept loop
#' @examples
#' # A ball down a parabola: times, and the push of the track.
#' bowl <- roll_on_curve(function(x) 0.5 * (x - 2)^2, from = 0, to = 2, body = 2 / 5, rows = 5)
#' bowl
#' summary(bowl)
#' # From rest it comes to rest at the same height on the other side.
#' summary(roll_on_curve(function(x) 0.5 * (x - 2)^2, 0, 5, body = 2 / 5))
#' # The brachistochrone against a straight line, to the same point.
#' end <- c(pi, -2)
#' summary(roll_on_curve(curve_cycloid(1), 0, pi, body = 0))$time_s
#' summary(roll_on_curve(function(x) -2 * x / pi, 0, pi, body = 0))$time_s
#' # A ball off a sphere of 1 m: at cos = 2/(3 + beta) from the top.
#' summary(roll_on_curve(function(x) sqrt(1 - x^2), 1e-3, 0.9, body = 2 / 5))[c("event", "x_m")]
#' @export
roll_on_curve <- function(curve, from, to, body = 2 / 5, v0_m_per_s = 0, ..., friction = Inf,
                          rows = 101, gravity_m_per_s2 = 9.80665) {
  call <- check_no_dots(...)
  check_supplied(c("curve", "from", "to"), call)
  curve <- as_curve(curve, call)
  from <- check_number(from, "from", "1", call)
  to <- check_number(to, "to", "1", call)
  v0 <- check_number(v0_m_per_s, "v0_m_per_s", "m/s", call, lower = 0)
  g <- check_number(gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call, lower = 0, open = TRUE)
  if (!identical(friction, Inf)) {
    friction <- check_number(friction, "friction", "1", call, lower = 0)
  }
  rows <- check_number(rows, "rows", "1", call, lower = 2, upper = 1e5)
  if (from == to) abort_rotdyn("{.arg from} and {.arg to} must differ.", "value", call)
  check_curve_ends(curve, c(from, to), call)
  roller <- curve_roller(body, call)
  c2 <- 2 * g / (1 + roller$beta)
  run <- list(
    curve = curve, from = from, to = to, v0 = v0, g = g, c2 = c2, friction = friction,
    roller = roller, start = curve_values(curve, from, call), way = sign(to - from)
  )
  check_curve_start(run, call)
  end <- curve_end(run, call)
  new_curve_motion(run, end, seq(from, to, length.out = rows), call)
}

#' @rdname roll_on_curve
#' @export
curve_function <- function(y, slope = NULL, second = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("y", call)
  curve_of_function(y, slope, second, "y", call)
}

#' @rdname roll_on_curve
#' @export
curve_path <- function(x, y, derivatives = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied(c("x", "y"), call)
  check_curve_function(x, "x", call)
  check_curve_function(y, "y", call)
  if (is.null(derivatives)) {
    dx <- derivative_of(x, call)
    dy <- derivative_of(y, call)
    derivatives <- list(
      dx, dy, derivative_of(dx, call), derivative_of(dy, call)
    )
  }
  if (!is.list(derivatives) || length(derivatives) != 4L) {
    abort_rotdyn(c(
      "{.arg derivatives} must be a list of four functions.",
      x = "It is {describe_value(derivatives)}."
    ), "type", call)
  }
  for (one in derivatives) check_curve_function(one, "derivatives", call)
  new_curve(x, y, derivatives[[1]], derivatives[[2]], derivatives[[3]], derivatives[[4]], "path")
}

#' @rdname roll_on_curve
#' @export
curve_table <- function(x_m, y_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("x_m", "y_m"), call)
  x_m <- check_finite(x_m, "x_m", "m", call)
  y_m <- check_finite(y_m, "y_m", "m", call)
  if (length(x_m) != length(y_m) || length(x_m) < 3L) {
    abort_rotdyn(c(
      "{.arg x_m} and {.arg y_m} must have the same length, at least 3.",
      x = "They have {length(x_m)} and {length(y_m)}."
    ), "size", call)
  }
  if (is.unsorted(x_m, strictly = TRUE)) {
    abort_rotdyn("{.arg x_m} must increase.", "value", call)
  }
  spline <- stats::splinefun(x_m, y_m, method = "natural")
  one <- function(u) rep(1, length(u))
  new_curve(
    function(u) u, function(u) spline(u), one, function(u) spline(u, deriv = 1),
    function(u) 0 * u, function(u) spline(u, deriv = 2), "table", x_m
  )
}

#' @rdname roll_on_curve
#' @export
curve_circle <- function(radius_m, ...) {
  call <- check_no_dots(...)
  check_supplied("radius_m", call)
  a <- check_number(radius_m, "radius_m", "m", call, lower = 0, open = TRUE)
  new_curve(
    function(u) a * sin(u), function(u) 2 * a * sin(u / 2)^2, function(u) a * cos(u),
    function(u) a * sin(u), function(u) -a * sin(u), function(u) a * cos(u), "circle"
  )
}

#' @rdname roll_on_curve
#' @export
curve_cycloid <- function(radius_m, ...) {
  call <- check_no_dots(...)
  check_supplied("radius_m", call)
  a <- check_number(radius_m, "radius_m", "m", call, lower = 0, open = TRUE)
  new_curve(
    function(u) a * (u - sin(u)), function(u) -2 * a * sin(u / 2)^2,
    function(u) 2 * a * sin(u / 2)^2, function(u) -a * sin(u), function(u) a * sin(u),
    function(u) -a * cos(u), "cycloid"
  )
}

#' @rdname roll_on_curve
#' @export
summary.rot_curve_motion <- function(object, ...) {
  call <- check_no_dots(...)
  run <- check_curve_motion(object, call)
  last <- run$last
  tibble::new_tibble(list(
    event = last$event, time_s = last$time_s, x_m = last$x_m, y_m = last$y_m,
    path_m = last$path_m, v_m_per_s = last$v_m_per_s, least_normal_n = run$least_normal,
    friction_needed = run$needed, error = run$error, error_kind = "estimate"
  ), nrow = 1L)
}

#' @export
print.rot_curve <- function(x, ...) {
  cat("<curve> ", if (is.list(x) && is.character(x$kind)) x$kind[1], "\n", sep = "")
  invisible(x)
}

#' Loops and hills
#'
#' The least height from which a rolling body runs through a loop, where it leaves the loop if it
#' starts lower, and where it leaves a hill.
#' \deqn{h = A \left(2 + \frac{1 + \beta}{2}\right),\quad
#'   \cos\varphi = -\frac{2 (h/A - 1)}{3 + \beta},\quad \cos\varphi = \frac{2}{3 + \beta}}{
#'   h = A (2 + (1 + beta)/2),  cos(phi) = -2 (h/A - 1)/(3 + beta),  cos(phi) = 2/(3 + beta)}
#'
#' @param beta I/(m r^2) of the body, at least 0: 0 slides, 2/5 for a ball.
#' @param radius_m Radius of the circle of the body's centre: that of the loop minus the body's.
#' @param height_m Height of the centre at the start, over its lowest place.
#' @param ... Not used: an unknown argument is an error.
#' @return `loop_start_height()`: m. `loop_leaving_angle()`: degrees from the lowest point, 180
#'   where it reaches the top in contact; NaN where it turns back before the side (`height_m` <=
#'   `radius_m`) and never leaves. `hill_leaving_angle()`: degrees from the top, from rest there.
#'   Columns of length 1 or n; NA stays.
#' @section Errors: `rotdyn_error_value`, `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Kleppner and Kolenkow, An Introduction to Mechanics, 2nd ed. (2014), chapter 7.
#' @seealso [roll_on_curve()] for the whole motion.
#' @examples
#' # A ball in a loop of 0.5 m: 2.7 times the radius of its centre's circle.
#' loop_start_height(2 / 5, 0.5 - 0.02)
#' loop_leaving_angle(2 / 5, 0.48, height_m = c(0.4, 1, 1.296))
#' hill_leaving_angle(c(0, 2 / 5))
#' @export
loop_start_height <- function(beta, radius_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("beta", "radius_m"), call)
  x <- loop_columns(list(beta = beta, radius_m = radius_m), call)
  x$radius_m * (2.5 + x$beta / 2)
}

#' @rdname loop_start_height
#' @export
loop_leaving_angle <- function(beta, radius_m, height_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("beta", "radius_m", "height_m"), call)
  x <- loop_columns(list(beta = beta, radius_m = radius_m, height_m = height_m), call)
  cosine <- -2 * ((x$height_m - x$radius_m) / x$radius_m) / (3 + x$beta)
  angle <- suppressWarnings(acos(pmax(cosine, -1))) * 180 / pi
  ifelse(!is.na(cosine) & cosine >= 0, NaN, angle)
}

#' @rdname loop_start_height
#' @export
hill_leaving_angle <- function(beta, ...) {
  call <- check_no_dots(...)
  check_supplied("beta", call)
  acos(2 / (3 + loop_columns(list(beta = beta), call)$beta)) * 180 / pi
}

loop_columns <- function(columns, call) {
  units <- c(beta = "1", radius_m = "m", height_m = "m")
  columns <- check_columns_of(columns, units[names(columns)], call)
  check_recyclable(columns, call)
  for (name in names(columns)) {
    x <- columns[[name]]
    check_not_negative(x, name, units[[name]], call, open = name == "radius_m")
    bad <- which(is.infinite(x))
    if (length(bad)) abort_domain(x[bad[1]], name, units[[name]], call, -Inf, Inf, FALSE, bad[1])
  }
  columns
}

# ---- curves -------------------------------------------------------------------------------------

# `knots`: where a derivative jumps.
new_curve <- function(x, y, dx, dy, ddx, ddy, kind, knots = double()) {
  structure(
    list(x = x, y = y, dx = dx, dy = dy, ddx = ddx, ddy = ddy, kind = kind, knots = knots),
    class = "rot_curve"
  )
}

as_curve <- function(curve, call) {
  if (is.function(curve)) return(curve_of_function(curve, NULL, NULL, "curve", call))
  check_class(
    curve, "rot_curve", "curve", "Give a function y(x), or make one with {.fn curve_table}.", call
  )
  check_form(curve, curve_form, "curve", "curve", call)
  for (part in c("x", "y", "dx", "dy", "ddx", "ddy")) {
    if (!takes_arguments(curve[[part]], 1L)) abort_form(part, "curve", "curve", call)
  }
  curve
}

curve_of_function <- function(y, slope, second, arg, call) {
  check_curve_function(y, arg, call)
  slope <- slope %||% derivative_of(y, call)
  check_curve_function(slope, "slope", call)
  second <- second %||% derivative_of(slope, call)
  check_curve_function(second, "second", call)
  new_curve(
    function(u) u, y, function(u) rep(1, length(u)), slope, function(u) 0 * u, second, "y(x)"
  )
}

check_curve_function <- function(f, arg, call) {
  check_function(f, arg, call)
  if (takes_arguments(f, 1L)) return()
  abort_rotdyn(c(
    "{.arg {arg}} must be a function of one argument.",
    x = "It has {length(required_arguments(f))} argument{?s} without a default."
  ), "type", call)
}

# The derivative of a function that is one formula. Primitives such as sin are taken by name.
derivative_of <- function(f, call) {
  known <- c("sin", "cos", "tan", "sinh", "cosh", "exp", "sqrt")
  name <- "x"
  formula <- attr(f, "formula")
  if (is.primitive(f)) {
    same <- vapply(known, function(one) identical(f, get(one, baseenv())), NA)
    if (any(same)) formula <- base::call(known[same][1], as.name(name))
    where <- baseenv()
  } else {
    name <- names(formals(f))[1]
    formula <- formula %||% body(f)
    while (is.call(formula) && identical(formula[[1]], as.name("{")) && length(formula) == 2L) {
      formula <- formula[[2]]
    }
    where <- environment(f)
  }
  formula <- fold_constants(formula, name, where)
  slope <- tryCatch(stats::D(formula, name), error = function(e) NULL)
  if (is.null(formula) || is.null(slope)) {
    abort_rotdyn(c(
      "A derivative of the curve is unknown.",
      x = "{.fn stats::D} cannot take it from the function's formula.",
      i = "Give derivatives with {.fn curve_function} or {.fn curve_path}, or a table."
    ), "type", call)
  }
  out <- function(u) NULL
  formals(out) <- stats::setNames(alist(u = ), name)
  body(out) <- as.call(list(rep_len, slope, as.call(list(length, as.name(name)))))
  environment(out) <- where
  structure(out, formula = slope)
}

# Parts of a formula without the variable, such as k[2], as their values.
fold_constants <- function(formula, name, where) {
  if (!is.call(formula)) return(formula)
  if (!name %in% all.vars(formula)) {
    value <- tryCatch(eval(formula, where), error = function(e) NULL)
    return(if (is.numeric(value) && length(value) == 1L) as.double(value) else formula)
  }
  formula[-1] <- lapply(as.list(formula)[-1], fold_constants, name, where)
  formula
}

# Values at u, finite.
curve_values <- function(curve, u, call) {
  out <- lapply(curve[c("x", "y", "dx", "dy", "ddx", "ddy")], function(f) {
    value <- f(u)
    if (!is.numeric(value) || length(value) != length(u)) {
      abort_rotdyn(c(
        "The curve's functions must return a number for each of theirs.",
        x = "One returned {describe_value(value)} for {length(u)}."
      ), "size", call)
    }
    as.double(value)
  })
  bad <- which(!Reduce(`&`, lapply(out, is.finite)))
  if (length(bad)) {
    abort_rotdyn(c(
      "The curve must be finite, with its derivatives, between {.arg from} and {.arg to}.",
      x = "It is not at {format(u[bad[1]], digits = 7)}."
    ), "value", call)
  }
  out$speed <- sqrt(out$dx^2 + out$dy^2)
  out
}

check_curve_ends <- function(curve, ends, call) {
  if (!length(curve$knots)) return(invisible())
  beyond <- ends[ends < min(curve$knots) | ends > max(curve$knots)]
  if (length(beyond)) {
    abort_rotdyn(c(
      "{.arg from} and {.arg to} must lie in the table.",
      x = "{beyond[1]} is outside of {min(curve$knots)} to {max(curve$knots)}."
    ), "value", call)
  }
}

# ---- the body -----------------------------------------------------------------------------------

curve_roller <- function(body, call) {
  if (inherits(body, "rot_body")) {
    check_body(body, call)
    inertia <- one_inertia(body, "body", call)
    radius <- rolling_radius(body, inertia, call)
    return(list(
      beta = inertia / body$mass_kg / radius / radius, mass = body$mass_kg, radius = radius
    ))
  }
  beta <- check_number(body, "body", "1", call, lower = 0)
  list(beta = beta, mass = 1, radius = NA_real_)
}

# ---- the motion ---------------------------------------------------------------------------------

# (y_a - y(u))/|u - a|: the mean of the slope, by 15 points, where they resolve it or are better
# than the difference, which has the rounding of y: that may be a difference of large terms.
drop_rate <- function(curve, u, a, y_a, y) {
  span <- u - a
  plain <- (y_a - y) / abs(span)
  nodes <- (mirror(kronrod_node, -1) + 1) / 2
  slopes <- matrix(curve$dy(as.vector(outer(span, nodes) + a)), length(u))
  weigh <- function(y, w) as.vector(y %*% (mirror(w, 1) / 2))
  mean <- weigh(slopes, kronrod_weight)
  size <- weigh(abs(slopes), kronrod_weight)
  apart <- abs(mean - weigh(slopes, gauss_weight))
  error <- size * pmin(1, (200 * apart / pmax(size, 1e-300))^1.5)
  eps <- .Machine$double.eps
  better <- error <= eps * size | error < eps * pmax(abs(y_a), abs(y)) / abs(span)
  better <- better & is.finite(mean) & span != 0
  plain[better] <- (-mean * sign(span))[better]
  plain
}

square_speed <- function(run, u, y = run$curve$y(u)) {
  fall <- drop_rate(run$curve, u, run$from, run$start$y, y) * abs(u - run$from)
  fall[u == run$from] <- 0
  run$v0^2 + run$c2 * fall
}

check_curve_start <- function(run, call) {
  if (run$v0 > 0) return(invisible())
  at <- run$start
  # A cusp has no slope: look a little further on.
  if (!(at$speed > 0)) {
    at <- curve_values(run$curve, run$from + 1e-6 * (run$to - run$from), call)
  }
  slope <- run$way * at$dy / at$speed
  if (abs(slope) <= 1e-12) {
    abort_rotdyn(c(
      "The body starts at rest where the curve is level: it stays there.",
      i = "Start beside that place, or with a speed {.arg v0_m_per_s}."
    ), "value", call)
  }
  if (slope > 0) {
    abort_rotdyn(c(
      "From rest the body rolls away from {.arg to}: the curve rises towards it.",
      i = "Exchange the ends, or give a speed {.arg v0_m_per_s}."
    ), "value", call)
  }
}

# What the track must do, row by row.
curve_forces <- function(run, u, at = NULL, v2 = NULL, call = NULL) {
  at <- at %||% curve_values(run$curve, u, call)
  v2 <- v2 %||% square_speed(run, u, at$y)
  bend <- (at$dx * at$ddy - at$dy * at$ddx) / at$speed^3
  cosine <- at$dx / at$speed
  sine <- at$dy / at$speed
  b <- run$roller$beta
  list(
    normal = run$roller$mass * (v2 * bend + run$g * cosine),
    friction = run$roller$mass * b / (1 + b) * run$g * sine, bend = bend
  )
}

# Where the motion ends: list(u, event).
curve_end <- function(run, call) {
  edge <- 1e-9 * (run$to - run$from)
  u <- sort(unique(c(
    seq(run$from, run$to, length.out = 1001L), run$from + edge, run$to - edge,
    run$curve$knots[run$curve$knots > min(run$from, run$to) &
      run$curve$knots < max(run$from, run$to)]
  )), decreasing = run$way < 0)[-1]
  at <- curve_values(run$curve, u, call)
  tests <- list(
    turns = function(u, at, force, v2) v2,
    leaves = function(u, at, force, v2) force$normal,
    slips = function(u, at, force, v2) {
      if (run$friction == Inf) rep(1, length(u)) else run$friction * force$normal -
        abs(force$friction)
    }
  )
  v2 <- square_speed(run, u, at$y)
  smooth <- at$speed > 0
  force <- curve_forces(run, u, at, v2)
  radius <- run$roller$radius
  if (!is.na(radius) && any(1 + force$bend[smooth] * radius <= 0)) {
    first <- u[smooth][which(1 + force$bend[smooth] * radius <= 0)[1]]
    abort_rotdyn(c(
      "The path of the centre bends more than a body of this radius can roll.",
      x = "At {format(first, digits = 4)} its radius is less than {format(radius, digits = 4)} m."
    ), "value", call)
  }
  # An end at rest within rounding is where it turns.
  slack <- 1e-14 * max(v2, 0)
  rests <- v2[length(v2)] <= slack
  best <- list(u = run$to, event = if (rests) "turns" else "arrives", index = length(u) + 1L)
  for (name in names(tests)) {
    value <- tests[[name]](u, at, force, v2)
    # Rounding of v^2 counts where the path bends sharply, as near a cusp.
    blur <- if (name == "turns") slack else {
      run$roller$mass * (slack * abs(force$bend) + 1e-14 * run$g) *
        if (name == "slips" && run$friction < Inf) 1 + run$friction else 1
    }
    bad <- which(value < -blur & (smooth | name == "turns"))
    if (!length(bad) || bad[1] > best$index) next
    i <- bad[1]
    root <- curve_root(run, tests[[name]], if (i == 1L) run$from else u[i - 1L], u[i], call)
    # Two in one step: the first of them.
    if ((root - best$u) * run$way < 0) best <- list(u = root, event = name, index = i)
  }
  best
}

# The zero between a place where it holds and one where it does not.
curve_root <- function(run, test, good, bad, call) {
  value <- function(u) {
    at <- curve_values(run$curve, u, call)
    v2 <- square_speed(run, u, at$y)
    test(u, at, curve_forces(run, u, at, v2), v2)
  }
  first <- value(good)
  if (is.nan(first) || first <= 0) return(good)
  stats::uniroot(value, c(good, bad), tol = 1e-15 * max(abs(c(good, bad))), maxiter = 200)$root
}

# Time and path from panel to panel, on either side of the middle: the ends are where v may be 0.
curve_integrals <- function(run, end, u, call) {
  last <- end$u
  span <- last - run$from
  v_end <- if (end$event == "turns") 0 else max(square_speed(run, last), 0)
  most <- max(square_speed(run, u[-1]), v_end, run$v0^2)
  slow_end <- v_end < 0.05 * most
  middle <- if (slow_end) run$from + span / 2 else last
  knots <- run$curve$knots
  inner <- knots[(knots - run$from) * run$way > 0 & (last - knots) * run$way > 0]
  cuts <- sort(unique(c(u, middle, inner)), decreasing = run$way < 0)
  y_last <- run$curve$y(last)
  rate_of <- function(from_start) {
    function(s) {
      length_s <- if (from_start) middle - run$from else middle - last
      anchor <- if (from_start) run$from else last
      at_u <- anchor + length_s * s^2
      at <- curve_values(run$curve, at_u, call)
      y_a <- if (from_start) run$start$y else y_last
      rate <- drop_rate(run$curve, at_u, anchor, y_a, at$y)
      v_a2 <- if (from_start) run$v0^2 else v_end
      # v = s sqrt(v_a^2/s^2 + c M L): the s of du = 2 L s ds cancels.
      slowness <- 1 / sqrt(v_a2 / s^2 + run$c2 * rate * abs(length_s))
      slowness[!is.finite(slowness)] <- 0
      cbind(at$speed * 2 * abs(length_s) * slowness, at$speed * 2 * abs(length_s) * s)
    }
  }
  side <- function(from_start) {
    anchor <- if (from_start) run$from else last
    mine <- cuts[(cuts - middle) * run$way * (if (from_start) 1 else -1) <= 0]
    if (length(mine) < 2L) return(NULL)
    s <- sqrt(pmax((mine - anchor) / (middle - anchor), 0))
    n <- length(s)
    out <- if (from_start) integrate_panels(rate_of(TRUE), s[-n], s[-1]) else
      integrate_panels(rate_of(FALSE), s[-1], s[-n])
    list(to = mine[-1], time = out$value[, 1], path = out$value[, 2], error = out$error)
  }
  parts <- list(side(TRUE), if (slow_end) side(FALSE))
  parts <- Filter(Negate(is.null), parts)
  at <- unlist(lapply(parts, `[[`, "to"))
  time <- cumsum(unlist(lapply(parts, `[[`, "time")))
  path <- cumsum(unlist(lapply(parts, `[[`, "path")))
  error <- sum(vapply(parts, function(part) sum(part$error[, 1]), 0))
  if (slow_end) error <- error + slow_rounding(run, end, u, span, call)
  row <- match(u, at)
  list(
    time = ifelse(u == run$from, 0, time[row]), path = ifelse(u == run$from, 0, path[row]),
    error = error
  )
}

# Where the body becomes slow, the rounding of v^2, which is a difference there, moves the end of
# the motion, and so does that of the place where it turns: by du, the times of the rows by ds/v.
slow_rounding <- function(run, end, u, span, call) {
  eps <- .Machine$double.eps
  at <- curve_values(run$curve, c(u, end$u), call)
  n <- length(u)
  fall <- abs(run$start$y - at$y[n + 1L])
  slope <- max(abs(at$dy[n + 1L]), fall / abs(span))
  rounding <- eps * (run$v0^2 + run$c2 * fall)
  turns <- if (end$event == "turns") 2 * eps * max(abs(end$u), abs(run$from)) else 0
  v <- sqrt(pmax(square_speed(run, u, at$y[seq_len(n)]), 0))
  moved <- (rounding / (run$c2 * slope) + turns) * at$speed[seq_len(n)] / v
  max(0, moved[v > 0 & u != end$u])
}

new_curve_motion <- function(run, end, u, call) {
  u <- u[(end$u - u) * run$way > 0]
  u <- c(u, end$u)
  if (length(u) < 2L) {
    abort_rotdyn(c(
      "The motion ends where it starts: it {end$event}.",
      i = "Look at the push and the friction there, or start elsewhere."
    ), "value", call)
  }
  sums <- curve_integrals(run, end, u, call)
  at <- curve_values(run$curve, u, call)
  v2 <- pmax(square_speed(run, u, at$y), 0)
  if (end$event == "turns") v2[length(u)] <- 0
  # A cusp has no direction: that of a place beside it.
  beside <- u + ifelse(at$speed > 0, 0, 1e-7 * (end$u - run$from))
  force <- curve_forces(run, beside, call = call)
  needed <- ifelse(
    force$friction == 0, 0, ifelse(force$normal > 0, abs(force$friction) / force$normal, Inf)
  )
  v <- sqrt(v2)
  columns <- list(
    time_s = sums$time, x_m = at$x, y_m = at$y, path_m = sums$path, v_m_per_s = v,
    omega_rad_per_s = v / run$roller$radius, normal_n = force$normal,
    friction_force_n = force$friction, friction_needed = needed,
    event = c(rep(NA_character_, length(u) - 1L), end$event)
  )
  last <- lapply(columns, function(x) x[length(x)])
  total <- last$time_s
  run <- list(
    last = last, least_normal = min(force$normal), needed = max(needed),
    error = if (total > 0) sums$error / total + 1e-15 else NaN, shape = cbind(at$x, at$y)
  )
  tibble::new_tibble(columns, nrow = length(u), run = run, class = "rot_curve_motion")
}

check_curve_motion <- function(x, call) {
  check_form(attr(x, "run"), curve_run_form, "object", "motion along a curve", call)
  run <- attr(x, "run")
  numbers <- c("time_s", "x_m", "y_m", "path_m", "v_m_per_s")
  whole <- is.character(run$last$event) && length(run$last$event) == 1L &&
    all(vapply(run$last[numbers], function(v) is.double(v) && length(v) == 1L, NA))
  if (!whole) abort_form("last", "object", "motion along a curve", call)
  run
}
