# A body on an incline.
incline_constraint <- function() {
  assumptions <- "rigid round body on a plane; centre of mass on its axis;"
  table_constraint(
    "incline",
    models = c(
      list(incline_exact = list(
        equations =
          "m v' = m g sin - F, I omega' = F R - T; Coulomb friction F, rolling resistance T",
        assumptions = paste(assumptions, "constant coefficients"),
        limits = "not before the start; where a force equals what friction holds, rounding decides",
        requires = "a body on an incline",
        source = "closed form between exact events; Goldstein 2002, section 2.4"
      )),
      integrated_words(
        "incline",
        equations = paste(
          "m v' = m g sin - F - drag + force, I omega' = F R - T;",
          "Coulomb friction F, rolling resistance T"
        ),
        assumptions = paste(assumptions, "events in C"),
        requires = "a body on an incline; any drag, any force along the slope"
      )
    ),
    title = function(run) {
      angle <- run$scene$incline_angle_deg
      paste(
        sentence(scene_body(run$scene)), if (angle == 0) "on a level plane" else
          paste("on an incline of", format_si(angle), "degrees")
      )
    },
    quick = TRUE,
    keys = c(
      "time_s", "x_m", "v_m_per_s", "theta_rad", "omega_rad_per_s", "slip_heat_j", "rolling_heat_j"
    ),
    slopes = slopes_incline,
    call_laws = function(scene, call) {
      f <- scene$force
      if (!is.function(f)) return(NULL)
      at <- list(scene$start_s, scene$x0_m, scene$v0_m_per_s)
      at <- at[seq_len(count_law_arguments(f, function(n) n))]
      function() do.call(f, at)
    },
    summary = function(x, run, call) {
      first <- function(event) {
        c(run$events$time_s[run$events$event == event], NA_real_)[1]
      }
      # x is positive down a slope of positive angle; the level is equally high everywhere.
      down <- sign(run$scene$incline_angle_deg)
      extremes <- largest_values(
        x, run, c("x_m", "v_m_per_s", "omega_rad_per_s"), call, minimum = if (down > 0) "x_m"
      )
      if (down == 0) {
        extremes$value$x_m <- x[["x_m"]][1]
        extremes$time_s$x_m <- x[["time_s"]][1]
      }
      value <- function(name) extremes$value[[name]] %||% NA_real_
      time <- function(name) extremes$time_s[[name]] %||% NA_real_
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
    stops = incline_stops,
    drawing = draw_incline,
    frames = incline_frames,
    augment = augment_incline,
    panels = list(
      panel("velocity (m/s)", c(v_m_per_s = "centre", slip_speed_m_per_s = "slip")),
      omega_panel(),
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

# Gravity and the force supply; friction and the rolling resistance turn.
augment_incline <- function(x, run, edges, call) {
  scene <- run$scene
  flows <- table_flows(core_table("incline"), run, edges)$since
  if (is.null(flows) || anyNA(flows)) return(NULL)
  if (nrow(flows)) flows <- sweep(flows, 2, flows[1, ])
  weight <- scene$mass_kg * scene$gravity_m_per_s2 *
    .Call(ffi_inertia_sine, scene$incline_angle_deg)
  force <- if (is.null(x[["applied_force_n"]])) 0 else x$applied_force_n
  heats <- c("slip_heat_j", "rolling_heat_j", "drag_heat_j")
  list(
    power_w = (weight + force) * x$v_m_per_s,
    work_j = flows[, "work_j"] + flows[, "applied_work_j"],
    dissipated_j = rowSums(flows[, heats, drop = FALSE]),
    torque_impulse_n_m_s = -scene$radius_m * flows[, "friction_impulse_n_s"],
    damping_impulse_n_m_s = -flows[, "resistance_impulse_n_m_s"]
  )
}

incline_stops <- function(scene, call) {
  found <- rest_of_motion(scene, c("v_m_per_s", "omega_rad_per_s"), call)
  if (!is.null(found)) {
    return(as_table(
      stop_time_s = found$time_s, stop_x_m = found$row$x_m, stop_theta_rad = found$row$theta_rad,
      terminal_v_m_per_s = 0
    ))
  }
  late <- scene$start_s + c(0.5, 1) * 4^10
  v <- tryCatch(
    compute_trajectory(scene, late, 1e-9, NULL, "abort", 1e6, call)$v_m_per_s,
    rotdyn_error = function(e) abort_no_stop(call)
  )
  steady <- abs(v[2] - v[1]) <= 1e-9 * abs(v[2])
  # Without drag the last acceleration is constant; with drag the speed tends to a balance.
  drags <- any(c("drag", "quadratic") %in% core_effects("incline", scene))
  fades <- drags && is.null(scene$force) && scene$incline_angle_deg == 0
  if (drags && !steady && !fades) abort_no_stop(call)
  as_table(
    stop_time_s = Inf, stop_x_m = NaN, stop_theta_rad = NaN,
    terminal_v_m_per_s = if (fades) 0 else if (steady) v[2] else sign(v[2]) * Inf
  )
}
