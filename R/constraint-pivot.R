# A body with a fixed point, under gravity.
pivot_constraint <- function() {
  table_constraint(
    "pivot", c(pivot_words(), free_models("pivot")),
    title = function(run) pivot_title(run$scene),
    quick = TRUE,
    keys = c("time_s", quaternion_columns, free_rates("")),
    bodies = rep("body", 3), # one for each principal moment
    measures = free_measures(),
    call_laws = call_free_laws,
    summary = function(x, run, call) {
      nutation <- .Call(ffi_pivot_nutation, run$scene) %||% rep(NA_real_, 3)
      c(sizes_in_space(x), list(
        nutation_period_s = nutation[1], mean_precession_rad_per_s = nutation[3]
      ))
    },
    texts = list(scene_pivot = text_form(function(x) {
      of_body <- inherits(x$body, "rot_body")
      c(free_arguments(x), list(
        pivot_m = if (of_body) x$pivot_m, mass_kg = if (!of_body) x$mass_kg,
        centre_m = if (!of_body) x$centre_m, gravity_m_per_s2 = x$gravity_m_per_s2
      ))
    }, read_pivot)),
    periods = pivot_periods,
    drawing = draw_pivot,
    solid = pivot_solid,
    augment = augment_pivot,
    panels = c(
      list(panel("inclination (rad)", c(inclination_rad = ""))),
      free_panels()[1:2],
      list(panel("energy (J)", c(
        rotational_kinetic_energy_j = "kinetic", potential_energy_j = "potential"
      ))),
      utils::tail(free_panels(), 1)
    )
  )
}

# Of the models that free bodies do not have.
pivot_words <- function() {
  approximation <- function(leaves_out, ...) {
    list(
      ...,
      limits = "its error grows with time; not near the vertical",
      requires = "a symmetric top that spins, gravity, and nothing else",
      leaves_out = leaves_out,
      loses = "The bound on what this model leaves out grows with time: {.code model = NULL} picks
               one that is good enough."
    )
  }
  list(
    pivot_top = list(
      equations = "L' = L x omega + r x m g (body axes), q' = q (0, omega)/2, two moments equal",
      assumptions =
        "rigid body; the centre of mass on the axis of symmetry; no friction at the point",
      limits = "beyond 1e15 rad no digit of the attitude is left",
      requires = "a symmetric top, gravity, rotors on its axis, and nothing else",
      source = "Goldstein 2002, section 5.7; elliptic functions of DLMF 19 and 22"
    ),
    pivot_precession = approximation(
      "nutation, and what the precession adds to the angular momentum",
      equations = "theta' = 0, phi' = torque/(I3 omega3), psi' = omega3 - phi' cos(theta)",
      assumptions = "fast spin: the angular momentum is that of the spin",
      source = "Goldstein 2002, section 5.7 (fast top)"
    ),
    pivot_nutation = approximation(
      "the square of the change of the inclination",
      equations =
        "u'' = (f'(u0) + f''(u0) (u - u0))/2, u = cos(theta), u'^2 = f(u); phi', psi' linear",
      assumptions = "small nutation",
      source = "Goldstein 2002, section 5.7; Whittaker 1937, section 71"
    )
  )
}

augment_pivot <- function(x, run, edges, call) {
  out <- augment_free(x, run, edges, call)
  if (is.null(out) || !length(edges)) return(out)
  rates <- do.call(cbind, unclass(x)[free_rates("space_")])
  lever <- lever_in_space(run$scene, x)
  # Gravity's power is -d(potential energy)/dt.
  out$power_w <- out$power_w - (lever[, "y"] * rates[, 1] - lever[, "x"] * rates[, 2])
  out
}

# The lever of the weight in space, a row for each row of the columns, N m.
lever_in_space <- function(scene, columns) {
  own <- scene$lever_n_m
  if (scene$axes[1] != 1) {
    own <- unlist(.Call(ffi_attitude_turn, as.list(c(scene$axes, own)), 1), use.names = FALSE)
  }
  q <- lapply(unclass(columns)[quaternion_columns], as.double)
  out <- do.call(cbind, .Call(ffi_attitude_turn, unname(c(q, as.list(own))), 1))
  dimnames(out) <- list(NULL, c("x", "y", "z"))
  out
}

read_pivot <- function(body, omega0_rad_per_s, pivot_m = c(0, 0, 0), mass_kg = NULL,
                       centre_m = NULL, attitude0 = NULL, gravity_m_per_s2 = 9.80665,
                       torque = NULL, torque_axes = "body", resistance = NULL, rotors = NULL,
                       start_s = 0) {
  keep_attitude(scene_pivot(
    body, omega0_rad_per_s, pivot_m = pivot_m, mass_kg = mass_kg, centre_m = centre_m,
    attitude0 = attitude0, gravity_m_per_s2 = gravity_m_per_s2, torque = torque,
    torque_axes = torque_axes, resistance = resistance, rotors = rotors, start_s = start_s
  ), attitude0)
}

# A plane motion is that of a pendulum on an axle; that of a symmetric top is a precession with a
# nutation.
pivot_periods <- function(scene, call) {
  plane <- .Call(ffi_pivot_plane, scene)
  if (!is.null(plane)) {
    return(axle_periods(scene_axle(
      plane[1], torque_gravity(1, 1, gravity_m_per_s2 = plane[2]), theta0_rad = plane[3],
      omega0_rad_per_s = plane[4]
    ), call))
  }
  nutation <- .Call(ffi_pivot_nutation, scene)
  if (is.null(nutation)) {
    abort_no_period(scene, call, paste(
      "It takes a symmetric top or a swing about a horizontal principal axis, gravity, and nothing",
      "else; {.fn time_when} gives the times of its turning points."
    ))
  }
  if (is.nan(nutation[3])) {
    abort_rotdyn(c(
      "This top is balanced upright, and does not sleep: it falls from the smallest disturbance.",
      x = "It spins too slowly for that.",
      i = "{.fn precession_table} has the spin from which on it sleeps."
    ), "model", call)
  }
  list(
    period_s = c(2 * pi / abs(nutation[3]), nutation[1]),
    kind = c("precession", "nutation"),
    amplitude_rad = c(NaN, nutation[2])
  )
}
