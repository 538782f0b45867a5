# The axle: one body that turns about a fixed axis.
axle_constraint <- function() {
  list(
    id = "axle",
    scene_class = "rot_scene_axle",
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
    models = axle_models,
    without = axle_without,
    acting = axle_acting,
    rounding = axle_rounding,
    quick = function(scene) {
      is.null(.subset2(scene, "inertia")) && is.null(.subset2(scene, "rounding")) &&
        is.null(.subset2(scene, "rope")) && is.null(.subset2(scene, "train")) &&
        known_to_rounding(scene)
    },
    columns = trajectory_columns,
    more_columns = function(columns, scene, time_s) {
      if (!is.null(.subset2(scene, "inertia"))) {
        columns$moment_of_inertia_kg_m2 <- inertia_at(scene$inertia, time_s)
      }
      if (!is.null(.subset2(scene, "rope"))) columns <- hanging_columns(columns, scene)
      if (is.null(.subset2(scene, "train"))) return(columns)
      shaft_columns(geared_columns(columns, scene), scene)
    },
    ends = function(scene, columns) {
      if (!is.null(.subset2(scene, "rope"))) slack_rope(scene, columns)
    },
    more_names = function(scene) c(shaft_names(scene), hanging_names(.subset2(scene, "rope"))),
    keys = c("time_s", "theta_rad", "omega_rad_per_s"),
    measures = list(
      theta = measure("rad", "theta_rad"),
      omega = measure("rad/s", "omega_rad_per_s")
    ),
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
    pace = axle_pace,
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
    balances = balance_axle,
    conserved = conserved_axle,
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

# A torque that goes around with the angle swings as fast as the body turns.
axle_pace <- function(scene, sizes, model) {
  list(
    breaks_s = sort(unique(c(axle_breaks(scene), scene$loads$law$breaks_s))),
    fades_s = shortest_time(scene, sizes), swing_rad_per_s = fastest_swing(scene, sizes)
  )
}

fastest_swing <- function(scene, sizes) {
  inertia <- min(scene$moment_of_inertia_kg_m2, scene$inertia$moment_of_inertia_kg_m2)
  swing <- vapply(scene$loads$terms, function(term) {
    x <- abs(term$x)
    switch(term$kind,
      sinusoid = x[2],
      # A quotient of roots: that of the numbers may underflow.
      spring = sqrt(x[1]) / sqrt(inertia),
      gravity = max(2 * sqrt(x[1]) / sqrt(inertia), sizes[["omega"]]),
      0
    )
  }, double(1))
  max(0, swing)
}

# The scene without some effects.
axle_without <- function(scene, effects) {
  if ("viscous" %in% effects) scene$resistance$viscous_n_m_s <- 0
  if ("quadratic" %in% effects) scene$resistance$quadratic_n_m_s2 <- 0
  if ("friction" %in% effects) scene$resistance[c("coulomb_n_m", "static_n_m")] <- 0
  scene$loads$terms <- Filter(function(term) !term$kind %in% effects, scene$loads$terms)
  scene
}

# Springs and gravity keep the energy, kinetic and potential, unless they act for a time only.
conserved_axle <- function(scene) {
  loads <- scene$loads
  stores <- vapply(loads$terms, function(term) {
    term$kind %in% c("spring", "gravity") && term$from_s == -Inf && term$to_s == Inf
  }, NA)
  gears <- scene$gears
  lossy <- !is.null(gears) && (gears$forward_n_m != 0 || gears$backward_n_m != 0 ||
    scene$resistance$viscous_n_m_s != 0)
  applied <- loads
  applied$terms <- loads$terms[!stores]
  resistance <- resists(scene$resistance)
  if (!is.null(gears)) { # a curve and dry friction stand for their loss
    applied <- torque_loads(torque_constant(gears$applied_n_m))
    resistance <- gears$bearings_n_m_s != 0
  }
  acts <- loads_act(applied)
  hangs <- !is.null(.subset2(scene, "rope")) # gravity stores what the weights do
  list(
    keeps_unless("energy", NA_character_, list(
      "the torque works" = acts && !hangs, "the resistance dissipates" = resistance,
      "the gears dissipate" = lossy,
      "what changes the moment of inertia works" = !is.null(scene$inertia)
    ), if (hangs) {
      "gravity gives back what it takes: kinetic plus potential energy stays"
    } else if (any(stores)) {
      "springs and gravity give back what they take: kinetic plus potential energy stays"
    } else {
      "nothing works and nothing dissipates"
    }),
    keeps_unless("angular_momentum", "the axle", list(
      "a torque acts about the axle" = acts && !hangs,
      "the weights act about the axle" = acts && hangs,
      "springs or gravity act about the axle" = any(stores),
      "the resistance acts about the axle" = resistance, "the gears take a torque" = lossy
    ), "no torque acts about the axle")
  )
}

balance_axle <- function(x, run, call) {
  n <- nrow(x)
  if (n == 0L) {
    return(list(
      no_balance("energy", NA_character_, "J"),
      no_balance("angular_momentum", "the axle", "kg m^2/s")
    ))
  }
  scene <- run$solved
  t <- as.double(x$time_s[c(1L, n)])
  ledger <- run$ledger
  if (is.null(ledger)) {
    ledger <- record_of(run)$ledger(scene, c(run, call = call), min(t), max(t))
    if (t[2] < t[1]) { # rows in reverse order: the balance runs backward
      flows <- !grepl("_rounding_", names(ledger))
      ledger[flows] <- -ledger[flows]
    }
  }
  theta <- x$theta_rad[c(1L, n)]
  ledger <- geared_flows(ledger, scene, theta[2] - theta[1], t[2] - t[1])
  flow <- function(name) ledger[[name]]
  inertia <- if (is.null(scene$inertia)) {
    rep(scene$moment_of_inertia_kg_m2, 2L)
  } else {
    inertia_at(scene$inertia, t)
  }
  omega <- x$omega_rad_per_s[c(1L, n)]
  viscous <- scene$resistance$viscous_n_m_s
  linear <- scene$resistance$quadratic_n_m_s2 == 0 && scene$resistance$static_n_m == 0
  damping <- if (linear) -viscous * (theta[2] - theta[1]) else flow("damping_impulse_n_m_s")
  constant <- inertia[1] == inertia[2]
  kinetic <- if (constant) kinetic_change(inertia[1], omega[1], omega[2]) else
    0.5 * (inertia[2] * omega[2]^2 - inertia[1] * omega[1]^2)
  momentum <- if (constant) inertia[1] * (omega[2] - omega[1]) else
    inertia[2] * omega[2] - inertia[1] * omega[1]
  eps <- .Machine$double.eps
  errors <- run$info$errors
  omega_error <- errors[["omega"]] + eps * abs(omega)
  stored <- potential_change(scene, theta, errors[["theta"]] + eps * abs(theta))
  # What springs and gravity do is the change of their energy: the rest is the work of the others.
  work <- flow("work_j")
  if (!is.null(stored)) work <- if (potential_only(scene)) 0 else work + stored$change_j
  sizes <- abs(c(kinetic, flow("work_j"), flow("dissipated_j"), flow("inertia_work_j")))
  rope <- .subset2(scene, "rope")
  if (is.null(rope)) {
    kinetic <- c("change of kinetic energy" = kinetic)
  } else {
    kinetic <- hanging_kinetic_change(rope, omega)
    stored <- hanging_potential_change(rope, theta, errors[["theta"]] + eps * abs(theta))
  }
  list(
    balance(
      "energy", NA_character_, "J",
      c(
        kinetic,
        if (!is.null(stored)) c("change of potential energy" = stored$change_j)
      ),
      c(
        if (is.null(rope)) c("work of the torque" = work),
        "work of what changes the inertia" = flow("inertia_work_j")
      ),
      stats::setNames(
        c(flow("viscous_j"), flow("quadratic_j"), flow("coulomb_j")),
        c(
          "heat of viscous resistance", "heat of quadratic drag",
          if (is.null(scene$gears)) "heat of dry friction" else "loss of the gears"
        )
      ),
      flow("work_rounding_j") + flow("dissipated_rounding_j") + (stored$rounding_j %||% 0) +
        sum(inertia * abs(omega) * omega_error) + 2 * eps * sum(sizes) +
        if (is.null(scene$inertia)) 0 else 2 * eps * sum(inertia * omega^2)
    ),
    balance(
      "angular_momentum", "the axle", "kg m^2/s",
      c("change of angular momentum" = momentum),
      stats::setNames(
        flow("impulse_n_m_s"),
        if (is.null(rope)) "impulse of the torque" else "impulse of the weights"
      ),
      c("impulse of the resistance" = -damping),
      flow("impulse_rounding_n_m_s") + sum(inertia * omega_error) +
        abs(viscous) * sum(errors[["theta"]] + eps * abs(theta)) +
        2 * eps * (abs(momentum) + abs(flow("impulse_n_m_s")) + abs(damping))
    )
  )
}

augment_axle <- function(x, run, edges, call) {
  if (is.null(x[["applied_torque_n_m"]])) abort_missing_column("applied_torque_n_m", x, call)
  parts <- NULL
  if (length(edges) > 1L) {
    parts <- integrate_axle_flows(run, edges, call, run$scene)
    if (is.null(parts)) return(NULL)
  }
  if (!is.null(parts)) {
    turned <- diff(x$theta_rad[match(edges, x$time_s)])
    parts$value <- geared_flows(parts$value, run$scene, turned, diff(edges))
    omega <- x$omega_rad_per_s[match(edges, x$time_s)]
    parts$value <- hanging_flows(parts$value, .subset2(run$scene, "rope"), omega)
  }
  since_first <- function(flow) {
    c(0, if (!is.null(parts)) cumsum(unname(parts$value[, flow])))[seq_along(edges)]
  }
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
