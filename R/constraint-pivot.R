# A body with a fixed point, under gravity.
pivot_constraint <- function() {
  free <- free_constraint()
  summary_free <- free$summary
  own <- list(
    id = "pivot",
    quick = NULL,
    scene_class = "rot_scene_pivot",
    form = c(free$form, list(
      mass_kg = "number", centre_m = "numbers:3", lever_n_m = "numbers:3",
      gravity_m_per_s2 = "number"
    )),
    title = function(run) "A body with a fixed point",
    models = pivot_models,
    columns = pivot_columns,
    more_columns = function(columns, scene, time_s) {
      lever <- lever_in_space(scene, columns)
      columns$potential_energy_j <- lever[, "z"]
      across <- sqrt(lever[, "x"]^2 + lever[, "y"]^2)
      inclination <- atan2(across, lever[, "z"])
      inclination[across == 0 & lever[, "z"] == 0] <- NaN # held at its centre of mass
      columns$inclination_rad <- inclination
      columns
    },
    pace = function(scene, sizes, model) {
      least <- min(scene$moment_of_inertia_kg_m2[scene$moment_of_inertia_kg_m2 > 0])
      swing <- sqrt(sqrt(sum(scene$lever_n_m^2)) / least)
      list(
        breaks_s = scene$breaks_s,
        fades_s = if (scene$damping_per_s > 0) 1 / scene$damping_per_s else Inf,
        swing_rad_per_s = 2 * sizes[["omega"]] + swing + rotor_pace(scene)
      )
    },
    summary = function(x, run) {
      shown <- summary_free(x, run)
      shown$flip_time_s <- NULL
      nutation <- .Call(ffi_pivot_nutation, run$scene) %||% rep(NA_real_, 4)
      c(shown, list(
        nutation_period_s = nutation[1], mean_precession_rad_per_s = nutation[4] / nutation[1]
      ))
    },
    texts = pivot_texts(),
    drawing = draw_pivot,
    solid = pivot_solid,
    balances = balance_pivot,
    conserved = conserved_pivot,
    augment = augment_pivot,
    panels = c(
      list(panel("inclination (rad)", c(inclination_rad = ""))),
      free$panels[1:2],
      list(panel("energy (J)", c(
        rotational_kinetic_energy_j = "kinetic", potential_energy_j = "potential"
      ))),
      utils::tail(free$panels, 1)
    )
  )
  free[names(own)] <- own
  free
}

balance_pivot <- function(x, run, call) {
  out <- balance_free(x, run, call)
  lapply(out, function(one) {
    if (identical(one$about, "the centre of mass")) one$about <- "the fixed point"
    one
  })
}

# Gravity is vertical: the vertical component stays, and the sum of the energies.
conserved_pivot <- function(scene) {
  weight <- any(scene$lever_n_m != 0)
  about <- "the fixed point"
  reason <- list("gravity has a torque across the vertical" = weight)
  none <- scene$damping_per_s == 0 && is.null(scene$law) && is.null(scene$knots) &&
    all(scene$torque_n_m == 0)
  acts <- list("a torque or the damping acts" = !none)
  motors <- list("the motors of the rotors work" = has_motors(scene))
  c(
    list(keeps_unless(
      "energy", NA_character_, c(acts, motors),
      "gravity gives back what it takes: kinetic plus potential energy stays"
    )),
    lapply(1:3, function(k) {
      keeps_unless(
        paste0("angular_momentum_", c("x", "y", "z")[k]), about,
        c(if (k < 3) reason, acts), "no torque acts along it"
      )
    })
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

pivot_texts <- function() {
  list(scene_pivot = text_form(function(x) {
    of_body <- !is.null(x$body)
    c(free_arguments(x), list(
      pivot_m = if (of_body) x$pivot_m, mass_kg = if (!of_body) x$mass_kg,
      centre_m = if (!of_body) x$centre_m, gravity_m_per_s2 = x$gravity_m_per_s2
    ))
  }, read_pivot))
}

read_pivot <- function(body, omega0_rad_per_s, pivot_m = c(0, 0, 0), mass_kg = NULL,
                       centre_m = NULL, attitude0 = NULL, gravity_m_per_s2 = 9.80665,
                       torque_n_m = NULL, torque_axes = "body", damping_per_s = 0,
                       rotors = NULL, breaks_s = NULL, start_s = 0) {
  keep_attitude(scene_pivot(
    body, omega0_rad_per_s, pivot_m = pivot_m, mass_kg = mass_kg, centre_m = centre_m,
    attitude0 = attitude0, gravity_m_per_s2 = gravity_m_per_s2, torque_n_m = torque_n_m,
    torque_axes = torque_axes, damping_per_s = damping_per_s, rotors = rotors,
    breaks_s = breaks_s, start_s = start_s
  ), attitude0)
}
