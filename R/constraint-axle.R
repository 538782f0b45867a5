# The axle: one body that turns about a fixed axis.
axle_constraint <- function() {
  table_constraint(
    "axle",
    models = axle_words(),
    makers = list(
      scene_pendulum = pendulum_maker(), scene_hanging_mass = hanging_maker(),
      scene_gears = gears_maker()
    ),
    title = function(run) {
      laws <- torque_loads(axle_torque(run$scene))$terms
      hangs <- any(vapply(laws, function(term) term$kind == "gravity", NA))
      paste0(
        if (hangs) "A pendulum: ", (if (hangs) identity else sentence)(scene_body(run$scene)),
        if (!is.null(changing_inertia(run$scene))) " whose moment of inertia changes,",
        " on a fixed axle"
      )
    },
    torque = given_torque,
    resistance = given_resistance,
    quick = TRUE,
    slopes = function(columns, scene) axle_slopes(columns, scene, columns$net_torque_n_m),
    call_laws = function(scene, call) {
      law <- torque_loads(given_torque(scene))$law
      if (is.null(law)) return(NULL)
      reader <- law_reader(law, scene, call)
      function() reader$at(scene$start_s)
    },
    more_events = axle_swing_events,
    summary = function(x, run, call) {
      names <- c(
        "omega_rad_per_s", "angular_momentum_kg_m2_per_s", "rotational_kinetic_energy_j"
      )
      extremes <- largest_values(x, run, names, call)
      value <- function(name) extremes$value[[name]] %||% NA_real_
      time <- function(name) extremes$time_s[[name]] %||% NA_real_
      list(
        moment_of_inertia_kg_m2 = run$scene$moment_of_inertia_kg_m2,
        max_angular_velocity_rad_per_s = value("omega_rad_per_s"),
        max_angular_velocity_time_s = time("omega_rad_per_s"),
        max_angular_momentum_kg_m2_per_s = value("angular_momentum_kg_m2_per_s"),
        max_rotational_kinetic_energy_j = value("rotational_kinetic_energy_j"),
        max_rotational_kinetic_energy_time_s = time("rotational_kinetic_energy_j"),
        final_theta_rad = last(x[["theta_rad"]])
      )
    },
    drawing = draw_axle,
    frames = axle_frames,
    periods = axle_periods, stops = axle_stops,
    augment = augment_axle,
    panels = list(
      panel("angle (rad)", c(theta_rad = "")),
      omega_panel(),
      panel("moment of inertia (kg m^2)", c(moment_of_inertia_kg_m2 = "")),
      panel(
        "angular momentum (kg m^2/s)", c(angular_momentum_kg_m2_per_s = ""),
        only_with = "moment_of_inertia_kg_m2"
      ),
      panel("torque (N m)", c(
        applied_torque_n_m = "applied", damping_torque_n_m = "damping", net_torque_n_m = "net"
      )),
      panel("kinetic energy (J)", c(rotational_kinetic_energy_j = "")),
      panel("tension (N)", c(
        tension_n = "", tension_1_n = "first mass", tension_2_n = "second mass"
      )),
      panel("energy of the masses (J)", c(
        mass_kinetic_energy_j = "kinetic", mass_potential_energy_j = "potential",
        mass_1_kinetic_energy_j = "kinetic, first", mass_2_kinetic_energy_j = "kinetic, second",
        mass_1_potential_energy_j = "potential, first",
        mass_2_potential_energy_j = "potential, second"
      ))
    )
  )
}

axle_words <- function() {
  integrator <- function(id) {
    list(run = function(scene, time_s, accuracy, max_steps, call, asked, flows = TRUE) {
      integrate_axle(id, scene, time_s, accuracy, max_steps, call, asked)
    })
  }
  integrated <- integrated_words(
    "axle",
    equations = "d(I omega)/dt = torque(t, theta, omega) + resistance, integrated",
    assumptions = "rigid body; torque finite, and smooth between its breaks",
    requires = "any torque, any resistance"
  )
  c(list(
    axle_free = list(
      equations = "omega = omega0; theta = theta0 + omega0 t",
      assumptions = "rigid body; nothing acts about the axle",
      limits = "none in double precision",
      requires = "no torque, no resistance",
      source = "Goldstein 2002, section 1.1"
    ),
    axle_linear = list(
      equations = "I domega/dt = torque(t) - c omega, solved in closed form between the knots",
      assumptions = "rigid body; torque a piecewise-linear function of time; resistance -c omega",
      limits = "any c t/I from 0 to 1e300; the state must stay within double precision",
      requires = "constants, knots, steps, pulses, linear motors; viscous resistance or none",
      source = "Hochbruck & Ostermann 2010, section 2.1 (phi functions)"
    ),
    axle_skater = list(
      equations = "d(I(t) omega)/dt = torque, I piecewise linear in time",
      assumptions = "rigid but for the change of inertia, which needs no torque about the axle",
      limits = "none in double precision",
      requires = "inertia_knots(); a torque that is constant between its steps; no resistance",
      source = "Goldstein 2002, section 1.1"
    ),
    axle_pendulum = list(
      equations = "I domega/dt = -m g d sin(theta), in Jacobi's elliptic functions",
      assumptions = "rigid body; uniform gravity",
      limits = "any amplitude, rotation and the separatrix included",
      requires = "torque_gravity() and nothing else",
      source = "Landau & Lifshitz 1976, section 11; DLMF chapter 22"
    ),
    axle_oscillator = list(
      equations = "I domega/dt = -k (theta - rest) - c omega + torque(t)",
      assumptions = "rigid body; a spring that obeys Hooke's law",
      limits = "any damping; the state must stay within double precision",
      requires = "torque_spring(), constants, knots, steps, sinusoids, motors, viscous resistance",
      source = "Landau & Lifshitz 1976, sections 22 to 26"
    ),
    axle_forced = list(
      equations = "I domega/dt = torque(t) - c omega, solved term by term",
      assumptions = "rigid body; resistance -c omega",
      limits = "polynomials to degree 16; the state must stay within double precision",
      requires = paste(
        "sums of constants, knots, polynomials, sinusoids, exponentials, motors; viscous",
        "resistance"
      ),
      source =
        "Hochbruck & Ostermann 2010, section 2.1; McCurdy, Ng & Parlett 1984 (divided differences)"
    ),
    axle_drag = list(
      equations =
        "I domega/dt = torque - c omega - q omega |omega| - tau_c sign(omega); sticks at rest",
      assumptions = "rigid body; a torque that is constant between its steps",
      limits = "forward in time; c >= 0",
      requires = "constants, steps, pulses, a motor; viscous, quadratic and dry friction",
      source = "Riccati's equation; Armstrong-Helouvry 1991, chapter 2 (dry friction)"
    ),
    axle_bands = list(
      equations =
        "I domega/dt = torque(t) + curve(omega) - c omega - tau_c sign(omega); sticks at rest",
      assumptions = "rigid body; torque piecewise linear in time and in omega",
      limits = "forward in time",
      requires =
        "constants, knots, steps, pulses, motors, one torque_curve(); viscous and dry friction",
      source = "Armstrong-Helouvry 1991, chapter 2 (dry friction)"
    )
  ), Map(c, integrated[1:2], lapply(names(integrated)[1:2], integrator)), integrated[-(1:2)])
}

# Of a pendulum: what it changes in the record.
pendulum_maker <- function() {
  list(
    title = function(run) paste("A pendulum:", scene_body(run$scene), "on a fixed axle"),
    torque = function(scene) {
      gravity <- gravity_law(
        scene$body$mass_kg, scene$distance_m, scene$gravity_m_per_s2, 0, NULL
      )
      given <- given_torque(scene)
      if (torque_is_zero(given)) gravity else sum_torques(gravity, given)
    }
  )
}

# What has the sign of the slope of each column; `net`: that of the slope of omega.
axle_slopes <- function(columns, scene, net) {
  omega <- columns$omega_rad_per_s
  c(
    list(theta_rad = omega, angular_momentum_kg_m2_per_s = net),
    if (is.null(changing_inertia(scene))) {
      list(omega_rad_per_s = net, rotational_kinetic_energy_j = net * omega)
    }
  )
}

augment_axle <- function(x, run, edges, call) {
  if (is.null(x[["applied_torque_n_m"]])) abort_missing_column("applied_torque_n_m", x, call)
  table <- core_table("axle")
  flows <- if (is.null(run$dropped)) {
    table_flows(table, run, edges)$since
  } else if (length(edges)) { # those of all torques along the motion
    control <- c(run$accuracy, run$max_steps + length(edges), TRUE, 0, 2, FALSE, 0)
    again <- run_table_model("axle", run$model, run$solved, edges, control, call, looks = FALSE)
    if (again$info$kind == "none") again$ledger[, table$flows, drop = FALSE]
  }
  if (length(edges) && is.null(flows)) return(NULL)
  if (length(edges)) {
    flows <- sweep(flows, 2, flows[1, ])
    omega <- x$omega_rad_per_s[match(edges, x$time_s)]
    if (!is.null(x[["alpha_rad_per_s2"]])) flows <- hanging_flows(flows, run$scene, omega)
  }
  since_first <- function(flow) if (length(edges)) unname(flows[, flow]) else double()
  heat <- list(
    dissipated_viscous_j = since_first("viscous_j"),
    dissipated_quadratic_j = since_first("quadratic_j"),
    dissipated_coulomb_j = since_first("coulomb_j")
  )
  potential <- axle_potential(run$scene, x$theta_rad[match(edges, x$time_s)])
  c(
    list(
      power_w = x$applied_torque_n_m * x$omega_rad_per_s, work_j = since_first("work_j"),
      dissipated_j = heat[[1]] + heat[[2]] + heat[[3]]
    ),
    heat,
    if (!is.null(potential)) list(potential_energy_j = potential),
    list(
      inertia_work_j = since_first("inertia_work_j"),
      torque_impulse_n_m_s = since_first("impulse_n_m_s"),
      damping_impulse_n_m_s = since_first("damping_impulse_n_m_s")
    )
  )
}

axle_periods <- function(scene, call) {
  x <- .Call(ffi_axle_period, scene)
  if (!is.null(torque_loads(given_torque(scene))$law)) x$kind <- "unknown"
  if (x$kind == "unknown") {
    abort_no_period(scene, call, paste(
      "{.code time_when(scene, theta_rad = 0, until_s = ...)} gives the times of its passages."
    ))
  }
  names(x)[names(x) == "ratio"] <- "amplitude_ratio"
  x
}
