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
#' @param finest Width of the narrowest features that are looked for, as a share of the span between
#'   `from` and `to`: 1e-5 to 0.1. The cost grows as its inverse.
#' @param breaks Places (of the parameter) of narrow features, or of jumps of a derivative: looked
#'   at ever more closely from both sides.
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
#'   function whose derivative is unknown; `rotdyn_error_range` for a curve whose third powers of
#'   lengths exceed double precision. Errors of the curve's functions are passed on.
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
#' # A hill with its slope, and a track measured at five places.
#' hill <- curve_function(function(x) cos(x), slope = function(x) -sin(x))
#' summary(roll_on_curve(hill, 0.1, 3))
#' track <- curve_table(x_m = 0:4, y_m = c(2, 1.1, 0.6, 0.8, 0.4))
#' summary(roll_on_curve(track, 0, 4))
#' @export
roll_on_curve <- function(curve, from, to, body = 2 / 5, v0_m_per_s = 0, ..., friction = Inf,
                          rows = 101, gravity_m_per_s2 = 9.80665, finest = 1e-3,
                          breaks = double()) {
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
  finest <- check_number(finest, "finest", "1", call, lower = 1e-5, upper = 0.1)
  breaks <- check_finite(breaks, "breaks", "1", call)
  if (from == to) abort_rotdyn("{.arg from} and {.arg to} must differ.", "value", call)
  check_curve_ends(curve, c(from, to), call)
  roller <- curve_roller(body, call)
  c2 <- 2 * g / (1 + roller$beta)
  run <- list(
    curve = curve, from = from, to = to, v0 = v0, g = g, c2 = c2,
    friction = if (friction > max_size) Inf else friction, # no force reaches either
    roller = roller, start = curve_values(curve, from, call), direction = sign(to - from)
  )
  check_curve_start(run, call)
  check_curve_size(abs(to - from), "The distance from {.arg from} to {.arg to}", call)
  run$seen <- look_along(run, finest, breaks, call)
  check_curve_size(max(run$seen$at$speed), "The curve's derivative", call)
  run$reach <- mean_reach(run, run$from, run$seen$u, run$seen$at)
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
    function(u) a * sin(u), function(u) -a * sin(u), function(u) a * cos(u),
    paste("circle of radius", format_si(a), "m")
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
    function(u) -a * cos(u), paste("cycloid of radius", format_si(a), "m")
  )
}

#' @rdname roll_on_curve
#' @export
summary.rot_curve_motion <- function(object, ...) {
  call <- check_no_dots(...)
  run <- check_curve_motion(object, call)
  last <- run$last
  new_table(list(
    event = last$event, time_s = last$time_s, x_m = last$x_m, y_m = last$y_m,
    path_m = last$path_m, v_m_per_s = last$v_m_per_s, min_normal_n = run$min_normal,
    friction_needed = run$needed, error = run$error, error_kind = "estimate", finest = run$finest
  ), nrow = 1L)
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_curve_motion <- function(x, ...) {
  run <- attr(x, "run")
  if (is.null(run) || !is.null(.Call(ffi_form_fault, run, curve_run_form))) {
    return(c("Motion along a curve" = "damaged"))
  }
  c(
    "Motion along a curve" = run$along,
    "End" = paste0(
      run$last$event, " after ", format_si(signif(run$last$time_s, 4)), " s; least push ",
      format_si(signif(run$min_normal, 4)), " N, friction needed ",
      format_si(signif(run$needed, 4))
    ),
    Seen = if (is.na(run$finest)) {
      paste("not all: the curve changes faster than", max_places, "places show; see `breaks`")
    } else {
      paste("features narrower than", format_si(signif(run$finest, 3)),
            "of the span may be missed: see `finest`, `breaks`")
    }
  )
}

#' @export
print.rot_curve <- function(x, ...) {
  say("<rot_curve> ", if (is.list(x) && is.character(x$kind)) x$kind[1], "\n")
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
#' @param body A round body, a list of them, names of shapes such as `"sphere"`, or numbers: `beta =
#'   I/(m r^2)`, at least 0, where 0 slides.
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
#' @concept loop the loop
#' @concept roller coaster
#' @concept hill
#' @concept track
#' @examples
#' # A ball in a loop of 0.5 m: 2.7 times the radius of its centre's circle.
#' loop_start_height(body_sphere(0.1, 0.02), 0.5 - 0.02)
#' loop_leaving_angle("sphere", 0.48, height_m = c(0.4, 1, 1.296))
#' hill_leaving_angle(c(0, 2 / 5))
#' @export
loop_start_height <- function(body, radius_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "radius_m"), call)
  x <- loop_columns(list(body = body, radius_m = radius_m), call)
  x$radius_m * (2.5 + x$body / 2)
}

#' @rdname loop_start_height
#' @export
loop_leaving_angle <- function(body, radius_m, height_m, ...) {
  call <- check_no_dots(...)
  check_supplied(c("body", "radius_m", "height_m"), call)
  x <- loop_columns(list(body = body, radius_m = radius_m, height_m = height_m), call)
  cosine <- -2 * ((x$height_m - x$radius_m) / x$radius_m) / (3 + x$body)
  angle <- suppressWarnings(acos(pmax(cosine, -1))) * 180 / pi
  ifelse(!is.na(cosine) & cosine >= 0, NaN, angle)
}

#' @rdname loop_start_height
#' @export
hill_leaving_angle <- function(body, ...) {
  call <- check_no_dots(...)
  check_supplied("body", call)
  acos(2 / (3 + loop_columns(list(body = body), call)$body)) * 180 / pi
}

# A body by its beta.
loop_columns <- function(columns, call) {
  units <- c(body = "1", radius_m = "m", height_m = "m")
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

# Places at which the curve's functions are known, from `from` to `to`.
max_places <- 2e5

# Quintic Hermite interpolation of f at the middle of a panel of width h, from value and two
# derivatives at its ends: value and second derivative.
hermite_middle <- function(h, f0, f1, d0, d1, s0, s1) {
  list(
    value = (f0 + f1) / 2 + 5 * h / 32 * (d0 - d1) + h^2 / 64 * (s0 + s1),
    second = (d1 - d0) / h * 3 / 2 - (s0 + s1) / 4
  )
}

# A grid of which no panel is wider than a quarter of `finest`, with panels halved until the middle
# is what the ends say: list(u, at, refined, all), in the order of the motion. Places are beside
# those of an even grid, since a periodic curve may be in step with it.
look_along <- function(run, finest, breaks, call) {
  low <- min(run$from, run$to)
  span <- abs(run$to - run$from)
  n <- ceiling(4 / finest)
  i <- seq_len(n - 1)
  turn <- i * 0.6180339887498949
  near <- span * 2^-(1:40)
  marks <- c(run$curve$knots, breaks)
  u <- c(
    low, low + span * (i + 0.25 * (turn - floor(turn) - 0.5)) / n, low + span,
    low + 1e-9 * span, low + span - 1e-9 * span, marks, outer(near, breaks, "+"),
    outer(-near, breaks, "+")
  )
  u <- sort(unique(u[u >= low & u <= low + span]))
  at <- as.data.frame(curve_values(run$curve, u, call))
  scale <- vapply(at, function(x) max(x) - min(x), 0)
  size <- vapply(at, function(x) max(abs(x), 2^-960), 0) # or roundings of it would be 0
  resolved <- TRUE
  open <- seq_len(length(u) - 1L)
  left <- u[open]
  right <- u[open + 1L]
  a <- at[open, ]
  b <- at[open + 1L, ]
  refined <- list()
  for (level in 1:44) {
    middle <- left + (right - left) / 2
    m <- as.data.frame(curve_values(run$curve, middle, call))
    h <- right - left
    wrong <- rep(FALSE, length(h))
    for (k in c("x", "y")) {
      d <- paste0("d", k)
      s <- paste0("dd", k)
      said <- hermite_middle(h, a[[k]], b[[k]], a[[d]], b[[d]], a[[s]], b[[s]])
      maximum <- pmax(abs(a[[s]]), abs(b[[s]]), abs(m[[s]]))
      wrong <- wrong | abs(m[[k]] - said$value) > 1e-9 * scale[[k]] + 64 * 2^-52 * size[[k]] |
        abs(m[[s]] - said$second) > 1e-2 * maximum + 1e-6 * size[[s]] +
          64 * 2^-52 * size[[d]] / h
    }
    wrong <- wrong & h > 2^-40 * span
    if (!any(wrong)) break
    if (length(u) + sum(lengths(refined)) / 8 + sum(wrong) > max_places) {
      if (sum(h[wrong]) > span / 2) abort_unseen_curve(call)
      resolved <- FALSE
      break
    }
    refined[[level]] <- cbind(u = middle, m)[wrong, ]
    left <- c(left[wrong], middle[wrong])
    right <- c(middle[wrong], right[wrong])
    a <- rbind(a[wrong, ], m[wrong, ])
    b <- rbind(m[wrong, ], b[wrong, ])
  }
  refined <- do.call(rbind, refined)
  all <- rbind(cbind(u = u, at), refined)
  all <- all[order(all$u, decreasing = run$direction < 0), ]
  all <- all[!duplicated(all$u), ]
  list(u = all$u, at = as.list(all[-1]), refined = c(refined$u, breaks), finest = if (resolved)
    finest else NA_real_)
}

abort_unseen_curve <- function(call) {
  abort_rotdyn(c(
    "The curve changes faster than {format_si(max_places)} places along it show.",
    x = "More than half of the path from {.arg from} to {.arg to} is not resolved.",
    i = "Shorten the path: the motion along a periodic curve repeats."
  ), "range", call)
}

# Curvatures have the third power of the speed along the curve.
max_size <- 1e100
check_curve_size <- function(size, what, call) {
  if (size < max_size && size > 1 / max_size) return(invisible())
  abort_rotdyn(c(
    paste(what, "must be between 1e-100 and 1e100."), x = "It is {format(size, digits = 3)}.",
    i = "Choose another unit of length."
  ), "range", call)
}

# How far from the anchor the mean of the slope by 15 points is the difference of heights, at all
# places between: beyond that it misses a feature.
mean_reach <- function(run, a, u, at) {
  far <- order(abs(u - a))
  far <- far[u[far] != a]
  u <- u[far]
  y <- at$y[far]
  y_a <- run$curve$y(a)
  rates <- drop_rates(run$curve, u, a, y_a, y)
  # The rounding of y: of its terms, which may be larger, as that of its argument is. Up to each
  # place: the slope of a bump further on would hide where it begins.
  terms <- cummax(pmax(abs(y), abs(y_a))) + cummax(abs(at$dy[far])) * pmax(abs(u), abs(a))
  allowed <- 1e-12 * rates$size + 64 * 2^-52 * terms / abs(u - a)
  bad <- which(!(abs(rates$plain - rates$mean) <= allowed))
  # Near the anchor a difference has no digits, and a cusp no slope.
  bad <- bad[abs(u[bad] - a) > 1e-5 * abs(run$to - run$from)]
  if (length(bad)) (if (bad[1] > 1L) abs(u[bad[1] - 1L] - a) else 0) else Inf
}

drop_rates <- function(curve, u, a, y_a, y) {
  span <- u - a
  nodes <- (mirror(kronrod_node, -1) + 1) / 2
  slopes <- matrix(curve$dy(as.vector(outer(span, nodes) + a)), length(u))
  weigh <- function(y, w) as.vector(y %*% (mirror(w, 1) / 2))
  mean <- weigh(slopes, kronrod_weight)
  size <- weigh(abs(slopes), kronrod_weight)
  difference <- abs(mean - weigh(slopes, gauss_weight))
  list(
    plain = (y_a - y) / abs(span), mean = -mean * sign(span), size = size,
    error = size * pmin(1, (200 * difference / pmax(size, 1e-300))^1.5)
  )
}

# (y_a - y(u))/|u - a| and its error: the mean of the slope, by 15 points, where they resolve it or
# are better than the difference, which has the rounding of y: that may be a difference of large
# terms. `reach`: of mean_reach(). `dy`: the slope at u.
drop_rate <- function(curve, u, a, y_a, y, reach, dy = 0) {
  r <- drop_rates(curve, u, a, y_a, y)
  eps <- .Machine$double.eps
  span <- abs(u - a)
  better <- r$error <= eps * r$size | r$error < eps * pmax(abs(y_a), abs(y)) / span
  better <- better & is.finite(r$mean) & span != 0 & span <= reach
  # The terms of y may be larger than y: as the slope times x is.
  terms <- pmax(abs(y_a), abs(y)) + abs(dy) * pmax(abs(u), abs(a))
  error <- ifelse(better, r$error + eps * r$size, eps * terms / span)
  error[span == 0] <- 0
  r$plain[better] <- r$mean[better]
  r$plain[span == 0] <- -curve$dy(a) * sign(sum(u - a))
  list(rate = r$plain, error = error)
}

square_speed <- function(run, u, y = run$curve$y(u)) {
  rate <- drop_rate(run$curve, u, run$from, run$start$y, y, run$reach)$rate
  fall <- rate * abs(u - run$from)
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
  slope <- run$direction * at$dy / at$speed
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
  cosine <- at$dx / at$speed
  sine <- at$dy / at$speed
  bend <- (cosine * at$ddy - sine * at$ddx) / at$speed / at$speed
  b <- run$roller$beta
  list(
    normal = run$roller$mass * (v2 * bend + run$g * cosine),
    friction = run$roller$mass * b / (1 + b) * run$g * sine * run$direction, bend = bend
  )
}

# Where the motion ends: list(u, event), and the places with their v^2 and forces.
curve_end <- function(run, call) {
  u <- run$seen$u[-1]
  at <- lapply(run$seen$at, `[`, -1L)
  slip <- function(force) run$friction * force$normal - abs(force$friction)
  tests <- list(
    turns = function(u, at, force, v2) v2, leaves = function(u, at, force, v2) force$normal,
    slips = function(u, at, force, v2) {
      if (run$friction == Inf) rep(1, length(u)) else slip(force)
    }
  )
  state <- curve_state(run, u, at)
  check_bends(run, u, state, call)
  # Rounding of v^2; it counts where the path bends sharply, as near a cusp.
  slack <- 1e-14 * max(state$v2, 0)
  blur_of <- function(name, bend) {
    if (name == "turns") return(rep(slack, length(bend)))
    run$roller$mass * (slack * abs(bend) + 1e-14 * run$g) *
      if (name == "slips" && run$friction < Inf) 1 + run$friction else 1
  }
  # Minima between the places that may be below 0.
  more <- unlist(lapply(names(tests), function(name) {
    value <- tests[[name]](u, at, state$force, state$v2)
    low_places(run, u, value, ifelse(state$smooth, blur_of(name, state$force$bend), Inf),
               tests[[name]], call)
  }))
  if (length(more)) {
    all <- sort(unique(c(u, more)), decreasing = run$direction < 0)
    u <- all
    at <- curve_values(run$curve, u, call)
    state <- curve_state(run, u, at)
  }
  smooth <- state$smooth
  v2 <- state$v2
  # An end at rest within rounding is where it turns.
  rests <- v2[length(v2)] <= slack
  best <- list(u = run$to, event = if (rests) "turns" else "arrives", index = length(u) + 1L)
  for (name in names(tests)) {
    value <- tests[[name]](u, at, state$force, v2)
    bad <- which(value < -blur_of(name, state$force$bend) & (smooth | name == "turns"))
    if (!length(bad) || bad[1] > best$index) next
    i <- bad[1]
    root <- curve_root(run, tests[[name]], if (i == 1L) run$from else u[i - 1L], u[i], call)
    # Two in one step: the first of them.
    if ((root - best$u) * run$direction < 0) best <- list(u = root, event = name, index = i)
  }
  check_crests(run, best, u, v2, slack, call)
  on <- (best$u - u) * run$direction > 0
  c(best[c("u", "event")], list(places = c(run$from, u[on]), lowest = u[on][which.min(v2[on])]))
}

# A local minimum among the places, by a parabola through three, that may be below 0 between them:
# the place of the minimum itself.
low_places <- function(run, u, value, blur, test, call) {
  n <- length(u)
  if (n < 3L) return(NULL)
  i <- which(value[-c(1L, n)] <= pmin(value[-c(n - 1L, n)], value[-(1:2)])) + 1L
  i <- i[value[i] >= -blur[i] & is.finite(blur[i])]
  if (!length(i)) return(NULL)
  drop <- value[i] - parabola_low(u, value, i)
  i <- i[value[i] - 4 * drop <= blur[i]]
  vapply(utils::head(i, 200L), function(i) {
    stats::optimize(function(x) value_at(run, test, x, call), sort(u[i + c(-1L, 1L)]),
                    tol = 1e-9 * abs(u[i + 1L] - u[i - 1L]))$minimum
  }, 0)
}

parabola_low <- function(u, value, i) {
  h0 <- u[i] - u[i - 1L]
  h1 <- u[i + 1L] - u[i]
  s0 <- (value[i] - value[i - 1L]) / h0
  s1 <- (value[i + 1L] - value[i]) / h1
  second <- (s1 - s0) / (h0 + h1)
  first <- s0 + second * h0
  low <- value[i] - ifelse(second > 0, first^2 / (4 * second), 0)
  ifelse(is.finite(low), low, value[i])
}

curve_state <- function(run, u, at) {
  v2 <- square_speed(run, u, at$y)
  list(v2 = v2, force = curve_forces(run, u, at, v2), smooth = at$speed > 0)
}

check_bends <- function(run, u, state, call) {
  radius <- run$roller$radius
  if (is.na(radius)) return(invisible())
  sharp <- which(state$smooth & 1 + state$force$bend * radius <= 0)
  if (length(sharp)) {
    abort_rotdyn(c(
      "The path of the centre bends more than a body of this radius can roll.",
      x = "At {format(u[sharp[1]], digits = 4)} its radius is less than
           {format(radius, digits = 4)} m."
    ), "value", call)
  }
}

# On a crest without speed the motion is undetermined, and towards one it takes infinitely long.
check_crests <- function(run, end, u, v2, slack, call) {
  before <- (end$u - u) * run$direction > 0
  n <- length(u)
  low <- which(before & abs(v2) <= slack & v2 <= c(run$v0^2, v2[-n]) & v2 <= c(v2[-1], Inf))
  at <- if (length(low)) u[low[1]] else if (end$event == "turns") end$u
  if (is.null(at)) return(invisible())
  place <- curve_values(run$curve, at, call)
  if (!length(low) && !(place$speed > 0 && abs(place$dy) <= 1e-7 * place$speed)) {
    return(invisible())
  }
  abort_rotdyn(c(
    "The body reaches a crest with no speed left, within rounding: the time is undetermined.",
    x = "The crest is at {format(at, digits = 7)}.",
    i = "Change {.arg v0_m_per_s} or the start by some 1e-10, or end before the crest."
  ), "value", call)
}

value_at <- function(run, test, u, call) {
  at <- curve_values(run$curve, u, call)
  v2 <- square_speed(run, u, at$y)
  test(u, at, curve_forces(run, u, at, v2), v2)
}

# The zero between a place where it holds and one where it does not.
curve_root <- function(run, test, good, bad, call) {
  value <- function(u) value_at(run, test, u, call)
  first <- value(good)
  if (is.nan(first) || first <= 0) return(good)
  stats::uniroot(value, c(good, bad), tol = 1e-15 * max(abs(c(good, bad))), maxiter = 200)$root
}

# Time and path from panel to panel, on either side of the middle: the ends are where v may be 0.
# The third integral is the error of the time by the rounding of v^2, where it is a difference.
curve_integrals <- function(run, end, u, call) {
  last <- end$u
  span <- last - run$from
  eps <- .Machine$double.eps
  y_last <- run$curve$y(last)
  v_end <- if (end$event == "turns") 0 else max(square_speed(run, last), 0)
  places <- c(end$places, last)
  maximum <- max(square_speed(run, places[-1]), v_end, run$v0^2)
  slow_end <- v_end < 0.05 * maximum
  middle <- if (slow_end) run$from + span / 2 else last
  even <- run$from + span * seq_len(255) / 256
  inner <- c(run$curve$knots, run$seen$refined, even, end$lowest)
  # Beside the ends, where the integrand is smooth in s, places would be of few digits.
  edge <- 1e-4 * abs(span)
  inner <- inner[(inner - run$from) * run$direction > edge & (last - inner) * run$direction > edge]
  cuts <- sort(unique(c(u, middle, inner)), decreasing = run$direction < 0)
  tail <- if (end$event == "turns") gentle_until(run, cuts) else run$from
  reach <- c(mean_reach(run, last, places, curve_values(run$curve, places, call)), run$reach)
  rounding <- eps * c(if (end$event == "turns") 0 else run$v0^2 + run$c2 *
    max(abs(run$start$y - y_last), abs(y_last)), 0)
  rate_of <- function(from_start) {
    function(s) {
      length_s <- if (from_start) middle - run$from else middle - last
      anchor <- if (from_start) run$from else last
      at_u <- anchor + length_s * s^2
      at <- curve_values(run$curve, at_u, call)
      y_a <- if (from_start) run$start$y else y_last
      drop <- drop_rate(run$curve, at_u, anchor, y_a, at$y, reach[1 + from_start], at$dy)
      v_a2 <- if (from_start) run$v0^2 else v_end
      # v = s sqrt(v_a^2/s^2 + c M L): the s of du = 2 L s ds cancels.
      part <- run$c2 * drop$rate * abs(length_s)
      blur <- eps * v_a2 / s^2 + run$c2 * drop$error * abs(length_s) +
        rounding[1 + from_start] / s^2
      square <- pmax(v_a2 / s^2 + part, blur)
      slowness <- 1 / sqrt(square)
      slowness[!is.finite(slowness)] <- 0
      step <- at$speed * 2 * abs(length_s)
      error <- step * slowness * blur / square
      # The change of the time by that of v^2 at the end, where the slope is less.
      shift <- ifelse((tail - at_u) * run$direction > 0, step * slowness / (2 * s^2 * square), 0)
      cbind(step * slowness, step * s, ifelse(is.finite(error), error, 0),
            if (from_start) 0 else ifelse(is.finite(shift), shift, 0))
    }
  }
  side <- function(from_start) {
    anchor <- if (from_start) run$from else last
    mine <- cuts[(cuts - middle) * run$direction * (if (from_start) 1 else -1) <= 0]
    if (length(mine) < 2L) return(NULL)
    s <- sqrt(pmax((mine - anchor) / (middle - anchor), 0))
    n <- length(s)
    out <- if (from_start) integrate_panels(rate_of(TRUE), s[-n], s[-1], rough = 3) else
      integrate_panels(rate_of(FALSE), s[-1], s[-n], rough = 3)
    list(to = mine[-1], time = out$value[, 1], path = out$value[, 2], error = out$error,
         rounding = out$value[, 3], shift = out$value[, 4])
  }
  parts <- list(side(TRUE), if (slow_end) side(FALSE))
  parts <- Filter(Negate(is.null), parts)
  at <- unlist(lapply(parts, `[[`, "to"))
  time <- cumsum(unlist(lapply(parts, `[[`, "time")))
  path <- cumsum(unlist(lapply(parts, `[[`, "path")))
  error <- sum(vapply(parts, function(part) sum(part$error[, 1], part$rounding), 0))
  if (end$event == "turns") {
    shift <- sum(vapply(parts, function(part) sum(part$shift), 0)) +
      shift_beyond(run, tail, last, y_last)
    error <- error + turn_rounding(run, end, u, shift, call)
  }
  row <- match(u, at)
  list(
    time = ifelse(u == run$from, 0, time[row]), path = ifelse(u == run$from, 0, path[row]),
    error = error
  )
}

# The last of the cuts at which the slope is less than half of that where it turns. A turn on a
# steep and narrow barrier has few digits of v^2, which the whole way there shares.
gentle_until <- function(run, cuts) {
  slope <- abs(run$curve$dy(cuts))
  low <- which(!(slope >= slope[length(cuts)] / 2))
  if (length(low)) cuts[low[length(low)]] else cuts[1L]
}

# What a change of v^2 changes at most of the time from there to where the slope is that of the end.
shift_beyond <- function(run, tail, last, y_last) {
  y <- run$curve$y(tail)
  v2 <- square_speed(run, tail, y)
  if (v2 > 0) sqrt((run$curve$x(last) - run$curve$x(tail))^2 + (y_last - y)^2) / (2 * v2^1.5) else 0
}

# The rounding of v^2, and of the place itself, moves the place where it turns by du, and the times
# of the rows by ds/v, and by `shift` for a change of v^2 where the slope is another.
turn_rounding <- function(run, end, u, shift, call) {
  eps <- .Machine$double.eps
  at <- curve_values(run$curve, c(u, end$u), call)
  n <- length(u)
  fall <- abs(run$start$y - at$y[n + 1L])
  slope <- abs(at$dy[n + 1L])
  if (!(slope > 0)) slope <- fall / abs(end$u - run$from) # a cusp
  rounding <- eps * (run$v0^2 + run$c2 * max(fall, abs(at$y[n + 1L])))
  place <- 2 * eps * max(abs(end$u), abs(run$from))
  v <- sqrt(pmax(square_speed(run, u, at$y[seq_len(n)]), 0))
  moved <- (rounding / (run$c2 * slope) + place) * at$speed[seq_len(n)] / v
  max(0, moved[v > 0 & u != end$u]) + (rounding + run$c2 * slope * place) * shift
}

# The least push and the largest need of friction of the whole motion: of all places, and of the
# extremes beside the best ones.
curve_limits <- function(run, end, call) {
  u <- c(end$places, end$u)
  beside <- function(u) u + ifelse(run$curve$dx(u)^2 + run$curve$dy(u)^2 > 0, 0, 1e-7 *
    (end$u - run$from))
  forces <- function(u) {
    force <- curve_forces(run, beside(u), call = call)
    needed <- ifelse(
      force$friction == 0, 0, ifelse(force$normal > 0, abs(force$friction) / force$normal, Inf)
    )
    list(normal = force$normal, needed = needed)
  }
  all <- forces(u)
  lowest <- function(value, f) {
    i <- which.min(value)
    near <- u[pmin(pmax(i + c(-1L, 1L), 1L), length(u))]
    if (!is.finite(value[i])) return(value[i])
    min(value[i], stats::optimize(f, sort(near), tol = 1e-9 * abs(diff(near)))$objective)
  }
  # Where it leaves the track nothing but rounding is left of the push.
  lost <- end$event == "leaves" && all$needed[length(u)] > 0
  list(
    normal = max(lowest(all$normal, function(x) forces(x)$normal), 0),
    needed = if (lost) Inf else -lowest(-all$needed, function(x) -min(forces(x)$needed, 1e300))
  )
}

new_curve_motion <- function(run, end, u, call) {
  u <- u[(end$u - u) * run$direction > 0]
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
  limits <- curve_limits(run, end, call)
  total <- last$time_s
  run <- list(
    last = last, min_normal = limits$normal, needed = limits$needed,
    error = if (total > 0) sums$error / total + 1e-15 else NaN, shape = cbind(at$x, at$y),
    finest = run$seen$finest, along = run$curve$kind, direction = run$direction
  )
  new_table(columns, nrow = length(u), run = run, class = "rot_curve_motion")
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
