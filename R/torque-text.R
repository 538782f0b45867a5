# Torque laws, resistances, changes of inertia, couplings and brakes as text.

law_readers <- function() {
  list(
    torque_constant = torque_constant, torque_knots = read_knots, torque_steps = torque_steps,
    torque_pulse = torque_pulse, torque_polynomial = torque_polynomial,
    torque_sinusoid = torque_sinusoid, torque_exponential = torque_exponential,
    torque_motor = torque_motor, torque_curve = torque_curve, torque_spring = torque_spring,
    torque_gravity = torque_gravity, torque_sum = read_sum, torque_term = read_term,
    resistance = resistance, inertia_knots = inertia_knots
  )
}

coupling_readers <- function() {
  list(
    coupling_shaft = coupling_shaft, coupling_clutch = coupling_clutch,
    coupling_gear = coupling_gear, brake = brake, principal_moments = read_principal,
    rotor = rotor
  )
}

node_or_abort <- function(x, forms, where, call) {
  first_that_fits(x, forms, where, call) %||% abort_rotdyn(c(
    "{.field {where}} of this scene has no text.",
    x = "Its constructor does not make it again: its parts were edited."
  ), "scene", call)
}

# A number for a constant torque.
#' @export
text_node.rot_torque_knots <- function(x, where, call) {
  constant <- !length(x$time_s)
  if (constant && identical(unclass(torque_constant(x$outside[1])), unclass(x))) {
    return(x$outside[1])
  }
  node_or_abort(x, list(torque_knots = text_form(function(x) {
    outside <- if (length(x$time_s) < 2L) {
      x$outside # read_knots(): the constructor takes no single knot
    } else if (all(x$outside == 0)) {
      "zero"
    } else if (identical(x$outside, x$torque_n_m[c(1L, length(x$time_s))])) {
      "hold"
    } else {
      x$outside
    }
    list(time_s = x$time_s, torque_n_m = x$torque_n_m, outside = outside)
  }, read_knots)), where, call)
}

# As torque_knots(), with what other laws make of knots: a single one, two numbers outside.
read_knots <- function(time_s, torque_n_m, outside = "zero") {
  call <- current_env()
  check_supplied(c("time_s", "torque_n_m"), call)
  if (is.character(outside)) return(torque_knots(time_s, torque_n_m, outside = outside))
  outside <- check_finite(outside, "outside", "N*m", call)
  if (length(outside) != 2L) abort_size_of(outside, "outside", 2L, call)
  if (length(time_s) < 2L) {
    time_s <- check_finite(time_s, "time_s", "s", call)
    torque_n_m <- check_finite(torque_n_m, "torque_n_m", "N*m", call)
    check_lengths(time_s, torque_n_m, call)
    return(new_knots(time_s, torque_n_m, outside))
  }
  law <- torque_knots(time_s, torque_n_m)
  law$outside <- outside
  law
}

#' @export
text_node.rot_torque_motor <- function(x, where, call) {
  node_or_abort(x, list(torque_motor = text_form(unclass, torque_motor)), where, call)
}

#' @export
text_node.rot_torque_function <- function(x, where, call) {
  if (isTRUE(registry_texts$functions)) return(x)
  abort_function_text(where, paste(
    "{.fn torque_knots}, {.fn torque_polynomial}, {.fn torque_curve} and their sums have one."
  ), call)
}

#' @export
text_node.rot_torque_sum <- function(x, where, call) {
  laws <- Map(function(law, i) text_node(law, paste0(where, "[[", i, "]]"), call), x$laws,
              seq_along(x$laws))
  list(torque_sum = list(laws = unname(laws)))
}

read_sum <- function(laws) {
  call <- current_env()
  check_supplied("laws", call)
  if (is.numeric(laws)) laws <- as.list(laws)
  if (!is.list(laws) || is.object(laws)) {
    abort_rotdyn("{.field laws} must be an array of torque laws.", "type", call)
  }
  do.call(sum_torques, lapply(unname(laws), as_torque, call))
}

# A spring multiplied by less than 0 keeps its numbers.
#' @export
text_node.rot_torque_term <- function(x, where, call) {
  form <- term_texts()[[x$kind]]
  as_term <- text_form(unclass, read_term)
  node_or_abort(x, c(form, list(torque_term = as_term)), where, call)
}

term_texts <- function() {
  window <- function(x) {
    list(
      from_s = if (x$from_s != -Inf) x$from_s, to_s = if (x$to_s != Inf) x$to_s
    )
  }
  list(
    polynomial = list(torque_polynomial = text_form(function(x) {
      n <- x$x[1]
      a <- matrix(x$x[-seq_len(n + 3)], n, byrow = TRUE)
      list(breaks_s = x$breaks_s, coefficients = if (n == 1) a[1, ] else a)
    }, torque_polynomial)),
    sinusoid = list(torque_sinusoid = text_form(function(x) {
      c(list(
        amplitude_n_m = x$x[1], angular_frequency_rad_per_s = x$x[2], phase_rad = x$x[3]
      ), window(x))
    }, torque_sinusoid)),
    exponential = list(torque_exponential = text_form(function(x) {
      c(list(torque_n_m = x$x[1], decay_per_s = x$x[2]), window(x))
    }, torque_exponential)),
    curve = list(torque_curve = text_form(function(x) {
      n <- x$x[1]
      list(omega_rad_per_s = x$x[1 + seq_len(n)], torque_n_m = x$x[1 + n + seq_len(n)])
    }, torque_curve)),
    spring = list(torque_spring = text_form(function(x) {
      list(stiffness_n_m_per_rad = x$x[1], rest_rad = x$x[2])
    }, torque_spring)),
    gravity = list(torque_gravity = text_form(function(x) {
      if (is.null(x$parts)) return(NULL)
      list(
        mass_kg = x$parts[1], distance_m = x$parts[2], rest_rad = x$x[2],
        gravity_m_per_s2 = x$parts[3]
      )
    }, torque_gravity))
  )
}

read_term <- function(kind, x, text, from_s = -Inf, to_s = Inf, breaks_s = numeric()) {
  call <- current_env()
  check_supplied(c("kind", "x", "text"), call)
  window <- check_window(from_s, to_s, call)
  kind <- check_string(kind, "kind", term_kinds, call)
  term <- new_term(
    kind, check_finite(x, "x", "1", call), check_name(text, "text", call), window[1], window[2],
    check_finite(breaks_s, "breaks_s", "s", call)
  )
  check_form(term, term_form, "torque_term", "torque law", call)
}

term_kinds <- c("polynomial", "sinusoid", "exponential", "curve", "spring", "gravity")

# Without the name of its constructor, which is that of the argument.
#' @export
text_node.rot_resistance <- function(x, where, call) {
  node_or_abort(x, list(resistance = text_form(function(x) {
    x <- unclass(x)
    if (x$static_n_m == x$coulomb_n_m) x$static_n_m <- NULL
    x
  }, resistance)), where, call)[[1]]
}

#' @export
text_node.rot_inertia_knots <- function(x, where, call) {
  node_or_abort(x, list(inertia_knots = text_form(unclass, inertia_knots)), where, call)
}

friction_arguments <- function(friction) {
  list(
    capacity_n_m = friction$capacity_n_m, static_ratio = friction$static_ratio,
    from_s = if (friction$from_s != -Inf) friction$from_s,
    to_s = if (friction$to_s != Inf) friction$to_s
  )
}

#' @export
text_node.rot_brake <- function(x, where, call) {
  node_or_abort(x, list(brake = text_form(friction_arguments, brake)), where, call)[[1]]
}

#' @export
text_node.rot_coupling <- function(x, where, call) {
  node_or_abort(x, list(
    coupling_shaft = text_form(unclass, coupling_shaft),
    coupling_clutch = text_form(function(x) {
      c(friction_arguments(x), list(ratio = x$ratio))
    }, coupling_clutch),
    coupling_gear = text_form(function(x) {
      c(list(ratio = x$ratio), list(efficiency = x$efficiency)[loses_power(x)])
    }, coupling_gear)
  )[sub("^rot_", "", class(x)[1])], where, call)
}

#' @export
text_node.rot_rotor <- function(x, where, call) {
  if (is.function(x$torque_n_m)) abort_function_text(paste0(where, "$torque_n_m"), NULL, call)
  node_or_abort(x, list(rotor = text_form(rotor_arguments, rotor)), where, call)
}
