# A drive: rotors in a chain. Rows in long form: by time, then rotor.
drive_constraint <- function() {
  table_constraint(
    "drive",
    models = drive_words(),
    title = function(run) {
      n <- length(run$scene$moment_of_inertia_kg_m2)
      if (n == 1L && !is.null(run$scene$brake[[1]])) return("A body on a fixed axle with a brake")
      paste0("A drive of ", n, " rotor", if (n != 1L) "s")
    },
    keys = c(
      "time_s", "rotor", "theta_rad", "omega_rad_per_s", "coupling_torque_n_m", "heat_j",
      "coupling_heat_j"
    ),
    time_scales = function(scene, sizes, model) {
      c(.Call(ffi_scene_time_scales, "drive", scene, as.double(sizes)), list(drifts = TRUE))
    },
    periods = drive_periods,
    stops = stops_at_rest(stop_theta_rad = "theta_rad", goes_on = drive_goes_on),
    summary = function(x, run, call) {
      end <- which(x$time_s == last(x$time_s))
      end <- end[!duplicated(x$rotor[end], fromLast = TRUE)]
      heat <- vapply(c("heat_j", "coupling_heat_j"), function(column) {
        sum(x[[column]][end], na.rm = TRUE)
      }, double(1))
      list(
        moment_of_inertia_kg_m2 = sum(run$scene$moment_of_inertia_kg_m2),
        max_angular_velocity_rad_per_s = largest(x[["omega_rad_per_s"]]),
        max_rotational_kinetic_energy_j = largest(sum_of_rotors(x, "rotational_kinetic_energy_j")),
        final_theta_rad = last(x[["theta_rad"]]),
        heat_j = if (nrow(x)) sum(heat) else NA_real_
      )
    },
    texts = list(scene_drive = text_form(drive_arguments, read_drive)),
    drawing = draw_drive,
    frames = shafting_frames_long(draw_drive),
    augment = augment_drive,
    panels = list(
      omega_panel(),
      panel("coupling torque (N m)", c(coupling_torque_n_m = "")),
      panel("heat of the rotor (J)", c(heat_j = "")),
      panel("coupling heat (J)", c(coupling_heat_j = ""))
    )
  )
}

drive_words <- function() {
  c(
    list(
      drive_axle = list(
        equations = "sum(J/P^2) omega' = sum(tau/P) - sum(c/P^2) omega, at the first shaft",
        assumptions = "rigid gears without backlash",
        limits = "those of the axle's closed forms",
        requires = "gears alone; torques of time, motors; viscous resistance or none",
        source = "the axle's closed forms; Shigley 2004, section 16-7"
      ),
      drive_clutch = list(
        equations = paste(
          "J1 omega1' = tau1 - T, J2 omega2' = tau2 + T at the first shaft, gears in J and tau"
        ),
        assumptions = "rigid gears; capacity constant; torques constant between jumps",
        limits =
          "not before the start; where a torque equals the static capacity, rounding decides",
        requires =
          "one clutch of constant capacity; constant or stepped torques; no resistance",
        source = "closed form between exact events; Shigley 2004, chapter 16"
      ),
      drive_modal = list(
        loses = "Stiff springs turn through many radians of phase, and large terms may cancel.",
        equations = "J x'' + C x' + K x = tau at the first shaft, mean motion and twists in modes",
        assumptions = "rigid gears, linear springs and dampers, constant torques",
        limits = paste(
          "constant torques; the error grows with the phase where rotors are damped unevenly"
        ),
        requires = "shafts and gears; constant torques; viscous resistance or none",
        source = "Meirovitch 2001, chapter 7; Higham 2005 (exponential of a matrix)"
      )
    ),
    integrated_words(
      "drive",
      equations = "J omega' = torque + resistance + ratio T(before) - T(behind); stick and slip",
      assumptions = "rigid rotors; torques finite, and smooth between their breaks",
      requires = "any torque, any resistance"
    )
  )
}

coupling_kinds <- function(scene) {
  drawn <- c(
    rot_coupling_shaft = "spring", rot_coupling_clutch = "clutch", rot_coupling_gear = "gear"
  )
  vapply(scene$couplings, function(one) drawn[[class(one)[1]]], "")
}

# A number of each coupling, 0 where it has none of this name.
of_couplings <- function(scene, name) {
  vapply(scene$couplings, function(one) one[[name]] %||% 0, double(1))
}

has_brake <- function(scene) {
  vapply(seq_along(scene$moment_of_inertia_kg_m2), function(i) !is.null(scene$brake[[i]]), NA)
}

draw_drive <- function(scene, theta = NULL) {
  kind <- coupling_kinds(scene)
  draw_shafting(
    scene, scene$moment_of_inertia_kg_m2, list(kind = kind, ratio = of_couplings(scene, "ratio")),
    drive_quantities(scene, kind), sprintf("T[%d]", seq_along(kind)), has_brake(scene), theta
  )
}

# What couples the rotors and holds them, for the drawing.
drive_quantities <- function(scene, kind) {
  ratio <- of_couplings(scene, "ratio")
  shafts <- kind == "spring"
  gears <- ratio != 1
  each <- function(which, symbol, name, parts) {
    do.call(rbind, lapply(which, function(i) {
      text <- paste0(torque_text(parts[[i]]$capacity_n_m), acting_text(parts[[i]]))
      quantity(sprintf("%s[%d]", symbol, i), name, text, "resistance")
    }))
  }
  rbind(
    if (any(shafts)) {
      stiffness <- of_couplings(scene, "stiffness_n_m_per_rad")[shafts]
      quantity("k[i]", "stiffness", value_text(stiffness, "N m/rad"), "spring")
    },
    each(which(kind == "clutch"), "T", "clutch", scene$couplings),
    each(which(has_brake(scene)), "B", "brake", scene$brake),
    if (any(gears)) quantity("", "ratio", value_text(ratio[gears], ""))
  )
}

# The flows that are heat.
drive_heats <- c("resistance_j", "brake_j", "damper_j", "clutch_j", "mesh_j")

augment_drive <- function(x, run, edges, call) {
  flows <- if (length(edges)) table_flows(core_table("drive"), run, edges)$since
  if (is.null(flows) && length(edges)) return(NULL)
  since_first <- function(names) {
    if (!length(edges)) return(double())
    total <- rowSums(flows[, names, drop = FALSE])
    total - total[1]
  }
  list(
    power_w = x[["applied_torque_n_m"]] * x$omega_rad_per_s,
    work_j = since_first("work_j"),
    dissipated_j = since_first(drive_heats),
    torque_impulse_n_m_s = since_first("torque_impulse_n_m_s"),
    damping_impulse_n_m_s = since_first("resistance_impulse_n_m_s")
  )
}

# The rates of the others follow through the ratios.
drive_arguments <- function(x) {
  first <- function(values) {
    if (identical(values, values[1] / x$ratio_to_first)) values[1] else values
  }
  list(
    bodies = x$bodies, couplings = if (length(x$couplings)) x$couplings, torque = x$torque,
    resistance = x$resistance, brake = x$brake, theta0_rad = first(x$theta0_rad),
    omega0_rad_per_s = first(x$omega0_rad_per_s), start_s = x$start_s
  )
}

# An array of numbers is a list of constant torques.
read_drive <- function(bodies, couplings = list(), torque = NULL, resistance = NULL, brake = NULL,
                       theta0_rad = 0, omega0_rad_per_s = 0, start_s = 0) {
  if (is.double(torque)) torque <- as.list(torque)
  scene_drive(
    bodies, couplings, torque = torque, resistance = resistance, brake = brake,
    theta0_rad = theta0_rad, omega0_rad_per_s = omega0_rad_per_s, start_s = start_s
  )
}

# Why a drive under laws that no longer change never rests once it moves, or NULL: where friction
# holds no rotor of a part of it and nothing damps that part, it swings on between those that are
# held; constant torques beyond all friction drive it on.
drive_goes_on <- function(scene) {
  kind <- coupling_kinds(scene)
  # A clutch takes the speeds of rotors that turn against each other.
  why <- if (!any(kind == "clutch")) nothing_holds(scene)
  if (!is.null(why)) return(why)
  rotors <- seq_along(scene$moment_of_inertia_kg_m2)
  unit <- cumsum(c(TRUE, kind != "gear"))
  friction_n_m <- vapply(rotors, function(i) {
    brake <- scene$brake[[i]]
    law <- brake$capacity_n_m
    capacity <- if (is.null(brake)) 0 else if (is_knots(law)) law$outside[2] else Inf
    max(0, capacity) * (brake$static_ratio %||% 1) + (scene$resistance[[i]]$static_n_m %||% 0)
  }, double(1))
  steady <- vapply(rotors, function(i) {
    is.null(scene$torque[[i]]) || is_knots(scene$torque[[i]])
  }, NA)
  resists <- c("viscous_n_m_s", "quadratic_n_m_s2")
  damps <- !steady | vapply(rotors, function(i) any(unlist(scene$resistance[[i]][resists]) > 0), NA)
  at <- function(which) unit %in% c(unit[-length(unit)][which], unit[-1][which])
  damps <- damps | at(of_couplings(scene, "damping_n_m_s") > 0)
  lossy <- kind == "gear" & of_couplings(scene, "efficiency") < 1
  held <- unit %in% unit[friction_n_m > 0] | at(kind == "clutch")
  part <- cumsum(c(TRUE, unit[-1] != unit[-length(unit)] & (held[-1] | held[-length(held)])))
  loose <- which(!(held | part %in% part[damps | at(lossy)]))
  if (length(loose)) return(paste0("no friction holds rotor ", loose[1], ", and nothing damps it"))
  if (any(kind == "clutch" | lossy) || !all(steady)) return(NULL)
  torque_n_m <- vapply(rotors, function(i) scene$torque[[i]]$outside[2] %||% 0, double(1))
  driven_n_m <- abs(sum(torque_n_m / scene$ratio_to_first))
  if (driven_n_m > (1 + 1e-9) * sum(abs(friction_n_m / scene$ratio_to_first))) {
    "the torques are more than all friction holds"
  }
}

is_knots <- function(law) inherits(law, "rot_torque_knots")

# Rotors joined by gears turn as one. With the product P of all ratios before a rotor, inertias to
# the first shaft are J/P^2 and springs k/P^2.
drive_periods <- function(scene, call) {
  kind <- coupling_kinds(scene)
  if ("clutch" %in% kind) {
    abort_no_period(scene, call, "A clutch that slips ends every swing: {.fn trajectory} shows it.")
  }
  ratio <- vapply(scene$couplings, function(one) one$ratio %||% 1, double(1))
  product <- cumprod(c(1, ratio))
  unit <- cumsum(c(TRUE, kind != "gear"))
  inertia <- as.double(rowsum(scene$moment_of_inertia_kg_m2 / product^2, unit))
  spring <- kind == "spring"
  if (!any(spring)) {
    abort_no_period(scene, call, "Gears alone turn as one body: it needs a {.fn coupling_shaft}.")
  }
  stiffness <- of_couplings(scene, "stiffness_n_m_per_rad")[spring] /
    product[-length(product)][spring]^2
  shaft <- scene_rotors(inertia, stiffness)
  periods_of_modes(shaft_modes(shaft)$natural_rad_per_s)
}
