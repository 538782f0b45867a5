# The axle: one body that turns about a fixed axis.
axle_constraint <- function() {
  table_constraint(
    "axle",
    models = axle_words(),
    bodies = NULL, inputs = NULL, # its scenes are not read by them
    form = list(
      body = list(.one_of = list(body_form, inertia_knots_form), .optional = TRUE),
      moment_of_inertia_kg_m2 = "number",
      inertia = c(inertia_knots_form, .optional = TRUE), axis = "numbers:3", torque = torque_form,
      loads = loads_form, resistance = resistance_form, theta0_rad = "number",
      omega0_rad_per_s = "number", start_s = "number", inertia_lo = "number?",
      rounding = "numbers:2?",
      gears = list(
        .optional = TRUE, applied_n_m = "number", forward_n_m = "number", backward_n_m = "number",
        bearings_n_m_s = "number", least_n_m_s = "number"
      ),
      rope = list(
        .optional = TRUE, mass_kg = "numbers:2", radius_m = "number",
        moment_of_inertia_kg_m2 = "number", gravity_m_per_s2 = "number"
      ),
      train = list(
        .optional = TRUE, ratio_to_first = "numbers",
        moment_of_inertia_kg_m2 = "numbers=ratio_to_first"
      )
    ),
    title = function(run) {
      if (!is.null(.subset2(run$scene, "train"))) return("A gear train")
      if (!is.null(.subset2(run$scene, "rope"))) return(sentence(hanging_title(run$scene$rope)))
      paste(sentence(with_article(run$scene$body$shape %||% "body")), "on a fixed axle")
    },
    rounding = axle_rounding,
    quick = function(scene) {
      is.null(.subset2(scene, "inertia")) && is.null(.subset2(scene, "rounding")) &&
        is.null(.subset2(scene, "rope")) && is.null(.subset2(scene, "train")) &&
        known_to_rounding(scene)
    },
    more_columns = function(columns, scene, time_s) {
      if (is.null(.subset2(scene, "train"))) columns else shaft_columns(columns, scene)
    },
    ends = function(scene, columns) {
      if (!is.null(.subset2(scene, "rope"))) slack_rope(scene, columns)
    },
    more_names = function(scene) c(shown_names("axle", scene), shaft_names(scene)),
    slopes = function(columns, scene) {
      omega <- columns$omega_rad_per_s
      # The net torque is that on the pulley alone, and 0 where it has no inertia.
      hangs <- !is.null(.subset2(scene, "rope"))
      net <- columns[[if (hangs) "alpha_rad_per_s2" else "net_torque_n_m"]]
      c(
        if (hangs) hanging_slopes(omega, net, scene$rope),
        list(theta_rad = omega, angular_momentum_kg_m2_per_s = net),
        shaft_slopes(omega, net, scene),
        if (is.null(.subset2(scene, "inertia"))) {
          list(omega_rad_per_s = net, rotational_kinetic_energy_j = net * omega)
        }
      )
    },
    call_laws = function(scene, call) {
      law <- scene$loads$law
      if (is.null(law)) return(NULL)
      reader <- law_reader(law, scene, call)
      function() reader$at(scene$start_s)
    },
    more_events = axle_swing_events,
    summary = function(x, run) {
      names <- c(
        "omega_rad_per_s", "angular_momentum_kg_m2_per_s", "rotational_kinetic_energy_j"
      )
      most <- largest_values(x, run, names, NULL)
      value <- function(name) most$value[[name]] %||% NA_real_
      time <- function(name) most$time_s[[name]] %||% NA_real_
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
    texts = axle_texts(),
    augment = augment_axle,
    panels = list(
      panel("angle (rad)", c(theta_rad = "")),
      panel("angular velocity (rad/s)", c(omega_rad_per_s = "")),
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
  ), Map(c, integrated, lapply(names(integrated), integrator)))
}

# A scene on an axle as text, by the function that made it.
axle_texts <- function() {
  start <- c("theta0_rad", "omega0_rad_per_s", "start_s")
  law <- function(torque) if (!torque_is_none(torque)) torque
  resisted <- function(x) if (resists(x$resistance)) list(resistance = x$resistance)
  axis <- function(x) if (!identical(x$axis, c(0, 0, 1))) list(axis = x$axis)
  special <- function(x) !is.null(.subset2(x, "given"))
  plain <- function(x) {
    if (special(x)) return(NULL)
    c(
      list(
        body = x$inertia %||% x$body %||% x$moment_of_inertia_kg_m2, torque = law(x$torque)
      ),
      resisted(x), unclass(x)[start], axis(x)
    )
  }
  list(
    scene_axle = text_form(plain, scene_axle),
    scene_axle = text_form(function(x) {
      if (!is.null(x$through)) c(plain(x), list(through = x$through))
    }, scene_axle),
    scene_pendulum = text_form(function(x) {
      if (is.null(x$hang)) return(NULL)
      c(
        list(body = x$body), x$hang[c("distance_m", "gravity_m_per_s2")],
        list(torque = law(x$given$torque)), resisted(x), unclass(x)[start], axis(x)
      )
    }, scene_pendulum),
    scene_hanging_mass = text_form(function(x) {
      if (is.null(x$rope)) return(NULL)
      c(
        list(
          body = x$body %||% x$rope$moment_of_inertia_kg_m2, mass_kg = x$rope$mass_kg[1],
          counter_mass_kg = x$rope$mass_kg[2], radius_m = x$rope$radius_m,
          gravity_m_per_s2 = x$rope$gravity_m_per_s2
        ),
        resisted(x), unclass(x)[start], axis(x)
      )
    }, scene_hanging_mass),
    scene_gears = text_form(function(x) {
      if (!is.null(x$train)) c(x$given, unclass(x)[start])
    }, scene_gears)
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
    flows <- hanging_flows(flows, .subset2(run$scene, "rope"), omega)
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

# The rounding of a scene's own coefficients, as a torque E in N m (and in N m s, times omega).
# Resistance that does not fall with the speed brings two motions together: E changes omega by at
# most E min(t/I, 1/c), backwards in time by E (exp(c t/I) - 1)/c.
axle_rounding <- function(scene, time_s, sizes) {
  off <- .subset2(scene, "rounding")
  if (is.null(off) || sizes[["omega"]] == 0) return(NULL) # at rest, held or without a torque
  off <- off[1] + off[2] * sizes[["omega"]]
  inertia <- scene$moment_of_inertia_kg_m2
  viscous <- scene$resistance$viscous_n_m_s
  least <- .subset2(scene, "gears")$least_n_m_s %||% viscous # of a train with a torque-speed curve
  span <- max(abs(time_s - scene$start_s), 0)
  back <- max(scene$start_s - time_s, 0)
  lag <- if (viscous > 0 && back > 0) {
    max(span / inertia, expm1(viscous * back / inertia) / viscous)
  } else {
    min(span / inertia, if (least > 0) 1 / least)
  }
  most <- if (back > 0) lag else min(span / inertia / 2, lag)
  list(theta = off * span * most, omega = off * lag)
}

# From when on the rope would be slack, in words; NULL: it is taut. Forward it is slack from the
# start on or never: a tension falls below 0 with the rate, which decreases or tends to that of a
# taut rope. Rows before the start are looked at.
slack_rope <- function(scene, columns) {
  from <- scene$start_s
  start <- run_table_model(
    "axle", "axle_rk8pd", scene, from, c(1, 1, TRUE, 0, FALSE, FALSE, 0), NULL, looks = FALSE
  )$columns
  lowest <- function(columns) {
    do.call(pmin, unname(unclass(columns)[grepl("^tension(_[12])?_n$", names(columns))]))
  }
  rounding <- 16 * .Machine$double.eps * sum(scene$rope$mass_kg) * abs(scene$rope$gravity_m_per_s2)
  tension <- lowest(start)
  if (!(tension < -rounding) && any(grepl("^tension", names(columns)))) {
    row <- match(TRUE, lowest(columns) < -rounding)
    if (is.na(row)) return(NULL)
    from <- columns$time_s[row]
    tension <- lowest(columns)[row]
  }
  if (!(tension < -rounding)) return(NULL)
  paste0(
    "the rope would be slack from ", format_si(from), " s on (its tension would be ",
    format_si(tension), " N there): the motion is that of a rope that can push"
  )
}
