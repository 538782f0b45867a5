# A body on an incline.
incline_constraint <- function() {
  list(
    id = "incline",
    scene_class = "rot_scene_incline",
    form = list(
      body = body_form, mass_kg = "number", radius_m = "number",
      moment_of_inertia_kg_m2 = "number", incline_angle_deg = "number",
      static_friction = "limit", kinetic_friction = "limit", rolling_arm_m = "number",
      x0_m = "number", v0_m_per_s = "number", theta0_rad = "number", omega0_rad_per_s = "number",
      drag_n_s_per_m = "number", drag_n_s2_per_m2 = "number",
      force = list(
        .optional = TRUE, f = "function", breaks_s = "numbers", arguments = "count"
      ),
      gravity_m_per_s2 = "number", start_s = "number"
    ),
    title = function(run) {
      paste("A body on an incline of", format_si(run$scene$incline_angle_deg), "degrees")
    },
    models = incline_models,
    columns = incline_columns,
    more_names = function(scene) if (has_outer_force(scene)) incline_force_columns,
    event_rows = TRUE,
    keys = c(
      "time_s", "x_m", "v_m_per_s", "theta_rad", "omega_rad_per_s", "slip_heat_j", "rolling_heat_j"
    ),
    measures = list(
      x = measure("m", "x_m"), v = measure("m/s", "v_m_per_s"),
      theta = measure("rad", "theta_rad"), omega = measure("rad/s", "omega_rad_per_s")
    ),
    slopes = slopes_incline,
    pace = pace_incline,
    summary = function(x, run) {
      first <- function(event) {
        c(run$events$time_s[run$events$event == event], NA_real_)[1]
      }
      # x is positive down a slope of positive angle; the level is equally high everywhere.
      down <- sign(run$scene$incline_angle_deg)
      most <- largest_values(
        x, run, c("x_m", "v_m_per_s", "omega_rad_per_s"), NULL, least = if (down > 0) "x_m"
      )
      if (down == 0) {
        most$value$x_m <- x[["x_m"]][1]
        most$time_s$x_m <- x[["time_s"]][1]
      }
      value <- function(name) most$value[[name]] %||% NA_real_
      time <- function(name) most$time_s[[name]] %||% NA_real_
      list(
        max_v_m_per_s = value("v_m_per_s"),
        max_v_time_s = time("v_m_per_s"),
        max_angular_velocity_rad_per_s = value("omega_rad_per_s"),
        max_angular_velocity_time_s = time("omega_rad_per_s"),
        highest_x_m = value("x_m"),
        highest_x_time_s = time("x_m"),
        final_x_m = last(x[["x_m"]]),
        final_v_m_per_s = last(x[["v_m_per_s"]]),
        final_omega_rad_per_s = last(x[["omega_rad_per_s"]]),
        slip_heat_j = last(x[["slip_heat_j"]]),
        rolling_heat_j = last(x[["rolling_heat_j"]]),
        roll_time_s = first("roll")
      )
    },
    texts = incline_texts(),
    drawing = draw_incline,
    frames = incline_frames,
    balances = balance_incline,
    conserved = conserved_incline,
    augment = augment_incline,
    panels = list(
      panel("velocity (m/s)", c(v_m_per_s = "centre", slip_speed_m_per_s = "slip")),
      panel("angular velocity (rad/s)", c(omega_rad_per_s = "")),
      panel("friction (N)", c(friction_force_n = "")),
      panel("energy (J)", c(
        translational_kinetic_energy_j = "translation", rotational_kinetic_energy_j = "rotation",
        slip_heat_j = "heat of slip", rolling_heat_j = "heat of rolling"
      ))
    )
  )
}

# What has the sign of the slopes: dv/dt of all forces, domega/dt of friction and resistance.
slopes_incline <- function(columns, scene) {
  m <- scene$mass_kg
  r <- scene$radius_m
  v <- columns$v_m_per_s
  omega <- columns$omega_rad_per_s
  friction <- columns$friction_force_n
  push <- m * scene$gravity_m_per_s2 * .Call(ffi_inertia_sine, scene$incline_angle_deg) + friction
  if (!is.null(columns[["drag_force_n"]])) {
    push <- push + columns$drag_force_n + columns$applied_force_n
  }
  normal <- m * scene$gravity_m_per_s2 *
    .Call(ffi_inertia_sine, 90 - abs(scene$incline_angle_deg))
  resists <- scene$rolling_arm_m * normal
  turns <- -friction * r - resists * sign(omega)
  # Held by the resistance, and about to turn.
  still <- omega == 0 & resists > 0
  turns[still] <- (sign(-friction) * pmax(0, abs(friction * r) - resists))[still]
  rolls <- columns$rolling
  turns[rolls] <- push[rolls]
  slip <- columns$slip_speed_m_per_s
  list(
    x_m = v, v_m_per_s = push, theta_rad = omega, omega_rad_per_s = turns,
    slip_speed_m_per_s = ifelse(rolls, 0, push / m - turns * r / scene$moment_of_inertia_kg_m2),
    translational_kinetic_energy_j = push * v, rotational_kinetic_energy_j = turns * omega,
    potential_energy_j = -sign(scene$incline_angle_deg) * v, slip_heat_j = abs(slip * friction)
  )
}

# Without gravity and drag the motion has no time of its own.
pace_incline <- function(scene, sizes, model) {
  m <- scene$mass_kg
  speed <- max(sizes[["v"]], scene$radius_m * sizes[["omega"]])
  drag <- (scene$drag_n_s_per_m + scene$drag_n_s2_per_m2 * speed) / m
  falls <- speed / scene$gravity_m_per_s2
  times <- c(if (drag > 0) 1 / drag, if (is.finite(falls) && falls > 0) falls)
  list(
    breaks_s = as.double(scene$force$breaks_s),
    fades_s = if (length(times)) min(times) else Inf, swing_rad_per_s = 0
  )
}

balance_incline <- function(x, run, call) {
  centre <- "the centre of mass"
  rows <- c(which.min(x$time_s), which.max(x$time_s))
  scene <- run$scene
  ledger <- if (nrow(x)) {
    record_of(run)$ledger(scene, run, x$time_s[rows[1]], x$time_s[rows[2]])
  }
  if (is.null(ledger) || anyNA(ledger)) {
    return(list(
      no_balance("energy", NA_character_, "J"),
      no_balance("momentum_along_slope", NA_character_, "kg m/s"),
      no_balance("angular_momentum", centre, "kg m^2/s")
    ))
  }
  m <- scene$mass_kg
  inertia <- scene$moment_of_inertia_kg_m2
  ends <- function(column) x[[column]][rows]
  flow <- function(name) if (name %in% names(ledger)) ledger[[name]] else 0
  v <- ends("v_m_per_s")
  omega <- ends("omega_rad_per_s")
  forces <- c(drag_heat_j = "heat of air drag")[is_integrated(ledger)]
  heats <- c(
    "heat of friction" = diff(ends("slip_heat_j")),
    "heat of rolling resistance" = diff(ends("rolling_heat_j")),
    if (length(forces)) stats::setNames(flow("drag_heat_j"), forces)
  )
  eps <- .Machine$double.eps
  errors <- run$info$errors
  v_error <- errors[["v"]] + eps * max(abs(v))
  omega_error <- errors[["omega"]] + eps * max(abs(omega))
  normal <- m * scene$gravity_m_per_s2
  # A path that is off by x counts in the heat by what friction does along it.
  sizes <- errors[["x"]] + scene$radius_m * errors[["theta"]]
  mu <- c(scene$kinetic_friction, scene$rolling_arm_m / scene$radius_m)
  heat_error <- sum(ifelse(heats[1:2] == 0, 0, pmin(mu, 1e300) * normal * 4 * sizes)) +
    flow("heat_error_j")
  list(
    balance(
      "energy", NA_character_, "J",
      c(
        "change of translational energy" = kinetic_change(m, v[1], v[2]),
        "change of rotational energy" = kinetic_change(inertia, omega[1], omega[2])
      ),
      c(
        "work of gravity" = ledger[["work_j"]],
        if (length(forces)) c("work of the force" = flow("applied_work_j"))
      ),
      heats,
      ledger[["work_rounding_j"]] + m * sum(abs(v)) * v_error +
        inertia * sum(abs(omega)) * omega_error + heat_error +
        16 * eps * sum(abs(ends("slip_heat_j")), abs(ends("rolling_heat_j")))
    ),
    balance(
      "momentum_along_slope", NA_character_, "kg m/s",
      c("change of momentum" = m * diff(v)),
      c(
        "impulse of gravity" = ledger[["gravity_impulse_n_s"]],
        "impulse of friction" = ledger[["friction_impulse_n_s"]],
        if (length(forces)) {
          c(
            "impulse of air drag" = flow("drag_impulse_n_s"),
            "impulse of the force" = flow("applied_impulse_n_s")
          )
        }
      ),
      double(),
      2 * m * v_error + ledger[["impulse_rounding_n_s"]]
    ),
    balance(
      "angular_momentum", centre, "kg m^2/s",
      c("change of angular momentum" = inertia * diff(omega)),
      c("impulse of friction" = ledger[["friction_impulse_n_m_s"]]),
      c("impulse of rolling resistance" = ledger[["resistance_impulse_n_m_s"]]),
      2 * inertia * omega_error + scene$radius_m * ledger[["impulse_rounding_n_s"]]
    )
  )
}

is_integrated <- function(ledger) "drag_impulse_n_s" %in% names(ledger)

augment_incline <- function(x, run, edges, call) {
  scene <- run$scene
  weight <- scene$mass_kg * scene$gravity_m_per_s2 *
    .Call(ffi_inertia_sine, scene$incline_angle_deg)
  flows <- c(
    "work_j", "friction_impulse_n_m_s", "resistance_impulse_n_m_s", "applied_work_j", "drag_heat_j"
  )
  ledger <- vapply(edges, function(edge) {
    one <- record_of(run)$ledger(scene, run, edges[1], edge)
    if (!is_integrated(one)) one <- c(one, applied_work_j = 0, drag_heat_j = 0)
    one[flows]
  }, double(5))
  if (anyNA(ledger)) return(NULL)
  ledger <- matrix(ledger, nrow = 5)
  first <- match(edges, x$time_s)
  heat <- x$slip_heat_j + x$rolling_heat_j
  force <- if (is.null(x[["applied_force_n"]])) 0 else x$applied_force_n
  list(
    power_w = (weight + force) * x$v_m_per_s,
    work_j = ledger[1, ] + ledger[4, ],
    dissipated_j = heat[first] - heat[first[1]] + ledger[5, ],
    torque_impulse_n_m_s = ledger[2, ],
    damping_impulse_n_m_s = -ledger[3, ]
  )
}

# Friction dissipates where the contact slips: from the start, or where the grip does not suffice.
conserved_incline <- function(scene) {
  acts <- scene$gravity_m_per_s2 != 0
  level <- !acts || scene$incline_angle_deg == 0
  slope <- abs(.Call(ffi_inertia_sine, scene$incline_angle_deg))
  across <- .Call(ffi_inertia_sine, 90 - abs(scene$incline_angle_deg))
  beta <- scene$moment_of_inertia_kg_m2 / scene$mass_kg / scene$radius_m^2
  rack <- is.infinite(scene$static_friction)
  grips <- scene$v0_m_per_s == scene$radius_m * scene$omega0_rad_per_s &&
    (rack || slope * beta / (1 + beta) <= scene$static_friction * across)
  # No normal force on a vertical slope.
  smooth <- !acts || (!rack && scene$static_friction * across == 0)
  arm <- acts && scene$rolling_arm_m * across != 0
  pushed <- list(
    "air drag acts" = scene$drag_n_s_per_m != 0 || scene$drag_n_s2_per_m2 != 0,
    "a force acts along the slope" = !is.null(scene$force)
  )
  slips <- !smooth && !grips && scene$kinetic_friction != 0
  gravity <- list("gravity acts along the slope" = !level)
  rolls <- list("the rolling resistance acts" = arm)
  list(
    keeps_unless(
      "energy", NA_character_,
      c(list("the contact slips: heat" = slips, "the rolling resistance dissipates" = arm), pushed),
      if (smooth) "no friction acts: kinetic plus potential energy stays" else
        "the contact grips, so friction does no work: kinetic plus potential energy stays"
    ),
    keeps_unless(
      "momentum_along_slope", NA_character_,
      c(gravity, list("friction acts along the slope" = slips), rolls, pushed),
      "no force acts along the slope"
    ),
    keeps_unless(
      "angular_momentum", "the centre of mass",
      c(list("friction acts at the rim" = slips || (!level && !smooth) || (grips && any(
        unlist(pushed)
      ))), rolls),
      "no torque acts about the centre of mass"
    ),
    keeps_unless(
      "angular_momentum", "a point of the slope", c(gravity, rolls, pushed),
      "friction acts along a line through it, gravity and the normal force cancel"
    )
  )
}

incline_texts <- function() {
  list(scene_incline = text_form(function(x) {
    infinite <- x$static_friction == Inf
    list(
      body = x$body, incline_angle_deg = x$incline_angle_deg,
      static_friction = if (!infinite) x$static_friction,
      kinetic_friction = if (x$kinetic_friction != x$static_friction) x$kinetic_friction,
      rolling_arm_m = x$rolling_arm_m, radius_m = x$radius_m, v0_m_per_s = x$v0_m_per_s,
      omega0_rad_per_s = x$omega0_rad_per_s, x0_m = x$x0_m, theta0_rad = x$theta0_rad,
      drag_n_s_per_m = x$drag_n_s_per_m, drag_n_s2_per_m2 = x$drag_n_s2_per_m2,
      force_n = x$force$f, force_breaks_s = if (length(x$force$breaks_s)) x$force$breaks_s,
      gravity_m_per_s2 = x$gravity_m_per_s2, start_s = x$start_s
    )
  }, scene_incline))
}
