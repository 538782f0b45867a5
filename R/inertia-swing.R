#' Moment of inertia from an oscillation
#'
#' The moment of inertia of a body that swings, from its period (or a record, or a fit) and measured
#' sizes, at the amplitude that it had, with its standard uncertainty and what contributes to it.
#'
#' * `inertia_torsion()`: on a wire or rod of torsional stiffness \eqn{\kappa}{kappa},
#'   \deqn{I = \kappa / (\omega^2 + \gamma^2)}{I = kappa/(omega^2 + gamma^2)}
#' * `inertia_compound_pendulum()`: about a pivot at the distance d from the centre of mass,
#'   \deqn{I = m g d / \omega_0^2,\quad I_c = I - m d^2}{I = m g d/omega0^2,  Ic = I - m d^2}
#'   The difference amplifies the errors: its factor is printed.
#' * `inertia_bifilar()`, `inertia_trifilar()`: on two or three wires of length L between an upper
#'   circle of radius R and a lower one of radius r, about the vertical through the centre (of two
#'   wires R and r are half the spacings),
#'   \deqn{I = m g R r T^2 / (4 \pi^2 h),\quad h^2 = L^2 - (R - r)^2}{I = m g R r T^2/(4 pi^2 h),
#'     h^2 = L^2 - (R - r)^2}
#'   for small swings. At an amplitude A the platform rises, and with \eqn{\sin(\theta/2) =
#'   \sin(A/2)
#'   \sin\phi}{sin(theta/2) = sin(A/2) sin(phi)} the period is
#'   \deqn{T = 4 \int_0^{\pi/2} \sqrt{\frac{(I + m h'^2)(h + h_A)}{2 m g R r (1 - \sin^2(A/2)
#'     \sin^2\phi)}}\,d\phi}{T = 4 int sqrt((I + m h'^2)(h + hA)/(2 m g R r (1 - sin^2(A/2)
#'     sin^2(phi)))) dphi}
#'   which is solved for I. h is the height, and not the length of the wires.
#'
#' Every size may be a [measured()] number. The same object in two results is one quantity: the
#' difference of a loaded and an empty platform has its mass, radii and wires counted once.
#'
#' @param swing A period in s (a number, or [measured()]), a [motion_record()], or what
#'   [fit_swing()] returned. Of a body on wires whose amplitude shows, each swing counts at its
#'   own.
#' @param stiffness_n_m_per_rad Torsional stiffness; of a rod \eqn{\pi d^4 G / (32 l)}{pi d^4 G/(32
#'   l)}.
#' @param mass_kg Mass of all that swings.
#' @param distance_m Distance of the centre of mass from the pivot.
#' @param length_m Length of the wires between their ends; or `height_m`, the height of the upper
#'   ends over the lower ones at rest.
#' @param upper_spacing_m,lower_spacing_m Distances of the two wires above and below.
#' @param upper_radius_m,lower_radius_m Radii of the circles of the three wires.
#' @param ... Not used: an unknown argument is an error.
#' @param amplitude_rad Amplitude of the swings, for a period; a record has its own.
#' @param decay_per_s Rate of decay of the amplitude, for a period; a record has its own.
#' @param gravity_m_per_s2 Acceleration of gravity.
#' @param height_m See `length_m`.
#' @param x A result.
#' @return A [measured()] number in kg m^2, of class `rot_inertia_measured`: besides, `method`,
#'   `amplitude_rad`, `contributions` (as in [uncertainty_budget()]), and of a compound pendulum
#'   `centre`, the moment about the parallel axis through the centre of mass, with `amplification`,
#'   the ratio of its relative uncertainty to that of I. It is a number for [scene_axle()] and all
#'   functions of the package; `as.double()` gives an entry of a tensor.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value` (sizes that do not fit together),
#'   `rotdyn_error_missing`, `rotdyn_error_argument`, and those of [fit_swing()].
#' @source Du Bois, Lieven and Adhikari, Experimental Mechanics 49, 533 (2009), for the trifilar
#'   pendulum; JCGM 100:2008 for the uncertainty.
#' @seealso [fit_swing()], [measured()], [pool_periods()], [parallel_axis()].
#' @concept moment of inertia
#' @concept trifilar pendulum
#' @concept torsion pendulum
#' @examples
#' # A wheel hung at its rim, timed by hand at small amplitude, and at 0.5 rad.
#' period <- measured(1.4274, 0.0010, name = "period")
#' mass <- measured(1.55, 0.005, name = "mass")
#' rim <- measured(0.296, 0.001, name = "distance")
#' hung <- inertia_compound_pendulum(period, mass, rim)
#' hung
#' hung$centre
#' inertia_compound_pendulum(period, mass, rim, amplitude_rad = 0.5)
#'
#' # A rod on two parallel wires of 1 m, 0.6 m apart.
#' inertia_bifilar(
#'   measured(1.1594, 0.001), mass_kg = 0.8, length_m = 1, upper_spacing_m = 0.6,
#'   lower_spacing_m = 0.6
#' )
#'
#' # A trifilar platform, empty and loaded: what they share counts once.
#' plate <- measured(0.512, 0.001, name = "plate")
#' load <- measured(1.204, 0.001, name = "load")
#' wires <- measured(0.600, 0.001, name = "wires")
#' R <- measured(0.120, 0.0005, name = "R")
#' r <- measured(0.050, 0.0005, name = "r")
#' empty <- inertia_trifilar(measured(1.5801, 0.002), plate, wires, R, r)
#' loaded <- inertia_trifilar(measured(1.2100, 0.002), plate + load, wires, R, r)
#' loaded - empty
#' scene_axle(loaded - empty, omega0_rad_per_s = 3)
#' @name inertia_swing
NULL

#' @rdname inertia_swing
#' @export
inertia_torsion <- function(swing, stiffness_n_m_per_rad, ..., decay_per_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("swing", "stiffness_n_m_per_rad"), call)
  motion <- in_call(swing_inputs(swing, "spring", 0, decay_per_s, call), call)
  inputs <- list(
    stiffness_n_m_per_rad = as_measured(
      stiffness_n_m_per_rad, "stiffness_n_m_per_rad", "N*m", call, 0, open = TRUE
    )
  )
  inertia_result(motion, inputs, "torsion", function(omega_square, stiffness_n_m_per_rad) {
    stiffness_n_m_per_rad / omega_square
  }, call)
}

#' @rdname inertia_swing
#' @export
inertia_compound_pendulum <- function(swing, mass_kg, distance_m, ..., amplitude_rad = 0,
                                      gravity_m_per_s2 = 9.80665, decay_per_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("swing", "mass_kg", "distance_m"), call)
  motion <- in_call(swing_inputs(swing, "gravity", amplitude_rad, decay_per_s, call), call)
  inputs <- list(
    mass_kg = as_measured(mass_kg, "mass_kg", "kg", call, 0, open = TRUE),
    distance_m = as_measured(distance_m, "distance_m", "m", call, 0, open = TRUE),
    gravity_m_per_s2 = as_measured(
      gravity_m_per_s2, "gravity_m_per_s2", "m/s^2", call, 0, open = TRUE
    )
  )
  pivot <- function(omega_square, mass_kg, distance_m, gravity_m_per_s2) {
    mass_kg * gravity_m_per_s2 * distance_m / omega_square
  }
  out <- inertia_result(motion, inputs, "compound pendulum", pivot, call)
  centre <- inertia_result(motion, inputs, "compound pendulum, about the centre of mass",
    function(...) pivot(...) - list(...)$mass_kg * list(...)$distance_m^2, call)
  if (centre$value < 0) {
    abort_rotdyn(c(
      "The moment of inertia about the centre of mass is below 0.",
      x = "I = {format(out)} kg m^2 about the pivot is less than m d^2.",
      i = "The period, or the distance, is not that of this body."
    ), "value", call)
  }
  out$centre <- centre
  out$amplification <- if (out$u > 0) centre$u / centre$value / (out$u / out$value) else NA_real_
  out
}

#' @rdname inertia_swing
#' @export
inertia_bifilar <- function(swing, mass_kg, length_m = NULL, upper_spacing_m, lower_spacing_m, ...,
                            amplitude_rad = 0, gravity_m_per_s2 = 9.80665, decay_per_s = 0,
                            height_m = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("swing", "mass_kg", "upper_spacing_m", "lower_spacing_m"), call)
  half <- function(x, arg) {
    x <- as_measured(x, arg, "m", call, 0, open = TRUE) / 2
    x$name <- arg
    x
  }
  filar_inertia(
    swing, mass_kg, length_m, height_m, half(upper_spacing_m, "upper_spacing_m"),
    half(lower_spacing_m, "lower_spacing_m"), amplitude_rad, gravity_m_per_s2, decay_per_s,
    "bifilar", call
  )
}

#' @rdname inertia_swing
#' @export
inertia_trifilar <- function(swing, mass_kg, length_m = NULL, upper_radius_m, lower_radius_m, ...,
                             amplitude_rad = 0, gravity_m_per_s2 = 9.80665, decay_per_s = 0,
                             height_m = NULL) {
  call <- check_no_dots(...)
  check_supplied(c("swing", "mass_kg", "upper_radius_m", "lower_radius_m"), call)
  filar_inertia(
    swing, mass_kg, length_m, height_m,
    as_measured(upper_radius_m, "upper_radius_m", "m", call, 0, open = TRUE),
    as_measured(lower_radius_m, "lower_radius_m", "m", call, 0, open = TRUE), amplitude_rad,
    gravity_m_per_s2, decay_per_s, "trifilar", call
  )
}

filar_inertia <- function(swing, mass_kg, length_m, height_m, upper, lower, amplitude_rad, gravity,
                          decay_per_s, method, call) {
  if (is.null(length_m) == is.null(height_m)) {
    abort_rotdyn(c(
      "Give {.arg length_m} or {.arg height_m}.",
      i = "The length of the wires is longer than the height where the radii differ."
    ), if (is.null(length_m)) "missing" else "argument", call)
  }
  motion <- in_call(swing_inputs(swing, "filar", amplitude_rad, decay_per_s, call), call)
  arg <- if (is.null(length_m)) "height_m" else "length_m"
  wire <- as_measured(length_m %||% height_m, arg, "m", call, 0, open = TRUE)
  inputs <- list(
    mass_kg = as_measured(mass_kg, "mass_kg", "kg", call, 0, open = TRUE), wire, upper, lower,
    gravity_m_per_s2 = as_measured(gravity, "gravity_m_per_s2", "m/s^2", call, 0, open = TRUE)
  )
  names(inputs)[2:4] <- c(arg, "upper", "lower")
  square <- function(wire, upper, lower) {
    if (arg == "height_m") wire^2 else wire^2 - (upper - lower)^2
  }
  high <- max(motion$amplitude, motion$swings$amplitude_rad)
  minimum <- square(wire$value, upper$value, lower$value) -
    4 * upper$value * lower$value * sin(high / 2)^2
  if (!is.finite(minimum)) {
    abort_rotdyn("The squares of the lengths and radii exceed double precision.", "range", call)
  }
  if (minimum <= 0) {
    abort_rotdyn(c(
      "The wires do not reach from the upper to the lower circle.",
      x = "Length {format(wire)} m, radii {format(upper)} and {format(lower)} m, amplitude
           {format(high, digits = 3)} rad."
    ), "value", call)
  }
  if (!is.null(motion$swings)) {
    motion$square <- filar_square(
      motion, inputs$mass_kg$value, square(wire$value, upper$value, lower$value), upper$value,
      lower$value, inputs$gravity_m_per_s2$value, call
    )
  }
  solve <- function(omega_square, mass_kg, wire, upper, lower, gravity_m_per_s2) {
    # Wires that are too short within their uncertainty give NaN, which the budget reports.
    suppressWarnings(filar_solve(
      2 * pi / sqrt(omega_square), mass_kg, square(wire, upper, lower), upper, lower,
      motion$amplitude, gravity_m_per_s2
    ))
  }
  out <- inertia_result(motion, stats::setNames(inputs, c(
    "mass_kg", "wire", "upper", "lower", "gravity_m_per_s2"
  )), method, solve, call, labels = c(wire = arg))
  if (!(out$value > 0)) abort_short_period(call)
  out
}

abort_short_period <- function(call) {
  abort_rotdyn(c(
    "The moment of inertia is below 0.", i = "The period is too short for these sizes."
  ), "value", call)
}

# The square of the angular frequency at motion$amplitude, from the periods of swings of other
# amplitudes: each has a moment of inertia, and that a period at this amplitude.
filar_square <- function(motion, mass, square, upper, lower, gravity, call) {
  swings <- motion$swings
  inertia <- filar_solve(
    swings$period_s, mass, square, upper, lower, swings$amplitude_rad, gravity
  )
  sound <- which(inertia > 0)
  if (!length(sound)) abort_short_period(call)
  swings <- swings[sound, ]
  swings$period0_s <- filar_period(
    inertia[sound], mass, square, upper, lower, motion$amplitude, gravity, 4096L
  )
  (2 * pi / period_of_swings(swings, motion$damping))^2
}

# The period of two or three wires by midpoints, which converge geometrically: the integrand is even
# and periodic. `square`: h(0)^2. All arguments are numbers or vectors of one length.
filar_period <- function(inertia, mass, square, upper, lower, amplitude, gravity, nodes) {
  k2 <- sin(amplitude / 2)^2
  top <- sqrt(square - 4 * upper * lower * k2)
  sum <- 0
  for (phi in (seq_len(nodes) - 0.5) * (pi / 2 / nodes)) {
    s2 <- k2 * sin(phi)^2
    h2 <- square - 4 * upper * lower * s2
    # h'^2 = (R r sin(theta)/h)^2 with sin^2(theta) = 4 s2 (1 - s2).
    rise <- (upper * lower)^2 * 4 * s2 * (1 - s2) / h2
    # Below 0 there is no period: 0 sends the search back.
    sum <- sum + sqrt(
      pmax(inertia + mass * rise, 0) * (sqrt(h2) + top) /
        (2 * mass * gravity * upper * lower * (1 - s2))
    )
  }
  4 * sum * (pi / 2 / nodes)
}

# The inertia at which the period is T. Nodes are doubled until they agree: 16 are exact to rounding
# for swings of 2 rad; wide ones, wires that nearly cross and compact bodies need more.
filar_solve <- function(period, mass, square, upper, lower, amplitude, gravity) {
  nodes <- 16L
  repeat {
    inertia <- filar_root(period, mass, square, upper, lower, amplitude, gravity, nodes)
    nodes <- 2L * nodes
    finer <- filar_period(inertia, mass, square, upper, lower, amplitude, gravity, nodes)
    agree <- abs(finer - period) <= 16 * .Machine$double.eps * period
    if (nodes > 4096L || all(agree, na.rm = TRUE)) return(inertia)
  }
}

# Secant steps in T^2, which is nearly linear in I.
filar_root <- function(period, mass, square, upper, lower, amplitude, gravity, nodes) {
  small <- mass * gravity * upper * lower * period^2 / (4 * pi^2 * sqrt(square))
  t2 <- function(i) {
    filar_period(i, mass, square, upper, lower, amplitude, gravity, nodes)^2 - period^2
  }
  a <- small * 0.98
  b <- small
  fa <- t2(a)
  fb <- t2(b)
  for (round in 1:40) {
    step <- fb * (b - a) / (fb - fa)
    step[!is.finite(step)] <- 0
    if (all(abs(step) <= 4 * .Machine$double.eps * small, na.rm = TRUE)) break
    a <- b
    fa <- fb
    b <- b - step
    # The root is above 0 unless the platform's own rise takes longer than the period.
    b <- pmax(b, -0.5 * small)
    fb <- t2(b)
  }
  b
}

# ---- what swings --------------------------------------------------------------------------------

# The square of the angular frequency without damping, of small swings under gravity, as a measured
# number; the amplitude that remains to be corrected for. `swings`: those whose periods are to be
# reduced to it, or NULL.
swing_inputs <- function(swing, restoring, amplitude_rad, decay_per_s, call) {
  law <- if (restoring == "gravity") "gravity" else "spring"
  amplitude <- check_number(amplitude_rad, "amplitude_rad", "rad", call, lower = 0, upper = 3.1)
  decay <- as_measured(decay_per_s, "decay_per_s", "1/s", call, lower = 0)
  notes <- character()
  swings <- damping <- NULL
  if (inherits(swing, "rot_record")) {
    # Of wires several losses would stand for what makes them no spring.
    losses <- if (restoring == "filar") "viscous" else swing_losses
    swing <- swing_fit_of(swing, "swing", law, losses, c(-Inf, Inf), call)
  }
  if (inherits(swing, "rot_swing_fit")) {
    check_swing_fit(swing, "swing", call)
    if (swing$restoring != law) {
      abort_rotdyn(c(
        "{.arg swing} was fitted with another restoring torque.",
        x = "It is {.val {swing$restoring}}; {.val {law}} is needed here."
      ), "value", call)
    }
    used <- swing$swings[swing$swings$used, ]
    if (!nrow(used)) used <- swing$swings
    omega <- swing$omega0_rad_per_s %||% (2 * pi / swing$period_s)
    amplitude <- sqrt(mean(used$amplitude_rad^2))
    square <- omega^2
    correct <- restoring == "filar"
    # Wires are no spring: where that shows, the swings have each a period of their own.
    if (correct && !swing$law_complete) swings <- used
    damping <- swing$damping
  } else {
    period <- as_measured(swing, "swing", "s", call, 0, open = TRUE)
    if (is_unnamed(period)) period$parts$name <- "period_s"
    if (restoring == "gravity" && amplitude > 0) {
      period <- period * small_swing_ratio(amplitude, "gravity")
    }
    square <- (2 * pi / period)^2 + decay^2
    if (amplitude == 0 && restoring != "spring") notes <- "small swings are assumed"
    correct <- restoring == "filar"
  }
  list(
    square = square, amplitude = if (correct) amplitude else 0, shown = amplitude, notes = notes,
    swings = swings, damping = damping
  )
}

# A number typed in has a label that is no name.
is_unnamed <- function(x) nrow(x$parts) == 1L && x$parts$name != make.names(x$parts$name)

inertia_result <- function(motion, inputs, method, f, call, labels = NULL) {
  inputs <- c(list(omega_square = motion$square), inputs)
  # Contributions under the names that the user gave, else under those of the arguments.
  for (name in names(inputs)[-1]) {
    if (!is_unnamed(inputs[[name]])) next
    inputs[[name]]$parts$name <- if (name %in% names(labels)) labels[[name]] else name
  }
  budget <- budget_of(f, inputs, names(inputs), NULL, 0.95, 0, 1, call)
  out <- budget$results[[1]]
  measured_from_parts(
    out$value, out$parts, "I", class = "rot_inertia_measured", method = method,
    amplitude_rad = motion$shown, contributions = budget$contributions[-1], notes = motion$notes
  )
}

inertia_measured_form <- list(
  method = "text", amplitude_rad = "number", notes = "texts",
  contributions = list(input = "texts", contribution = "values=input", share = "values=input")
)

#' @rdname inertia_swing
#' @export
print.rot_inertia_measured <- function(x, ...) {
  call <- current_env()
  check_measured(x, "x", call)
  check_form(unclass(x), inertia_measured_form, "x", "measured moment of inertia", call)
  if (!is.null(x$centre)) check_measured(x$centre, "x", call)
  say("I = ", format.rot_measured(x), " kg m^2\n  ", x$method, ", amplitude ",
    format_si(x$amplitude_rad, 3), " rad\n")
  if (!is.null(x$centre)) {
    say("about the centre of mass ", format.rot_measured(x$centre), " kg m^2\n", if (
      is.finite(x$amplification)) {
      paste0("  relative uncertainty ", format(x$amplification, digits = 2), " times that of I\n")
    })
  }
  rows <- x$contributions[order(-abs(x$contributions$contribution)), ]
  if (nrow(rows)) {
    lines <- paste0(
      "  ", format(rows$input), "  ", format(paste(round(100 * rows$share, 1), "%"),
        justify = "right"), " of the variance"
    )
    say(lines, sep = "\n")
  }
  for (note in x$notes) say("  ", note, "\n")
  invisible(x)
}
