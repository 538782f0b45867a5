# A drive: rotors in a chain. Rows in long form: by time, then rotor.
drive_constraint <- function() {
  list(
    id = "drive",
    scene_class = "rot_scene_drive",
    form = list(
      bodies = bodies_form,
      moment_of_inertia_kg_m2 = "numbers", torque = list(.each = torque_form),
      resistance = list(.each = resistance_form),
      rotors = list(.is = "list=moment_of_inertia_kg_m2", .each = list(
        moment_of_inertia_kg_m2 = "number", loads = loads_form, resistance = resistance_form,
        theta0_rad = "number", omega0_rad_per_s = "number", start_s = "number",
        brake = c(brake_form, .optional = TRUE)
      )),
      couplings = list(.is = "list=moment_of_inertia_kg_m2-1", .each = coupling_form),
      ratio_to_first = "numbers=moment_of_inertia_kg_m2",
      theta0_rad = "numbers=moment_of_inertia_kg_m2",
      omega0_rad_per_s = "numbers=moment_of_inertia_kg_m2", start_s = "number"
    ),
    fault = function(scene) if (any(vapply(scene$couplings, lacks_grip, NA))) "couplings",
    title = function(run) "A drive",
    models = list(drive_axle, drive_clutch, drive_modal, drive_rk8pd, drive_radau),
    columns = columns_of_motion("drive"),
    keys = c(
      "time_s", "rotor", "theta_rad", "omega_rad_per_s", "coupling_torque_n_m", "heat_j",
      "coupling_heat_j"
    ),
    index = "rotor",
    copies = function(scene) length(scene$rotors),
    measures = list(
      theta = measure("rad", "theta_rad"),
      omega = measure("rad/s", "omega_rad_per_s")
    ),
    pace = drive_pace,
    call_laws = function(scene, call) {
      brakes <- lapply(scene$rotors, `[[`, "brake")
      grips <- lapply(scene$couplings, `[[`, "grip")
      called <- Filter(function(part) !is.null(part$loads$law), c(scene$rotors, brakes, grips))
      if (!length(called)) return(NULL)
      readers <- lapply(called, function(part) law_reader(part$loads$law, part, call))
      function() for (reader in readers) reader$at(scene$start_s)
    },
    summary = function(x, run) {
      whole <- function(column) {
        if (!is.null(x[[column]])) rowsum(x[[column]], as.character(x$time_s))
      }
      heat <- vapply(c("heat_j", "coupling_heat_j"), function(column) {
        sum(x[[column]][x$time_s == last(x$time_s)], na.rm = TRUE)
      }, double(1))
      list(
        moment_of_inertia_kg_m2 = sum(run$scene$moment_of_inertia_kg_m2),
        max_angular_velocity_rad_per_s = largest(x[["omega_rad_per_s"]]),
        max_rotational_kinetic_energy_j = largest(whole("rotational_kinetic_energy_j")),
        final_theta_rad = last(x[["theta_rad"]]),
        heat_j = if (nrow(x)) sum(heat) else NA_real_
      )
    },
    texts = drive_texts(),
    drawing = draw_drive,
    frames = shafting_frames_long(draw_drive),
    balances = function(x, run, call) table_balances("drive", core_table("drive"), x, run),
    conserved = function(scene) table_keeps("drive", core_table("drive"), scene),
    augment = augment_drive,
    panels = list(
      panel("angular velocity (rad/s)", c(omega_rad_per_s = "")),
      panel("coupling torque (N m)", c(coupling_torque_n_m = "")),
      panel("heat of the rotor (J)", c(heat_j = "")),
      panel("coupling heat (J)", c(coupling_heat_j = ""))
    )
  )
}

draw_drive <- function(scene, theta = NULL) {
  of <- function(name) vapply(scene$couplings, `[[`, double(1), name)
  kind <- c("spring", "clutch", "gear")[of("kind") + 1]
  draw_shafting(
    scene, scene$moment_of_inertia_kg_m2, list(kind = kind, ratio = of("ratio")),
    drive_quantities(scene, kind), sprintf("T[%d]", seq_along(kind)),
    vapply(scene$rotors, function(rotor) !is.null(rotor$brake), NA), theta
  )
}

# What couples the rotors and holds them, for the drawing.
drive_quantities <- function(scene, kind) {
  of <- function(name) vapply(scene$couplings, `[[`, double(1), name)
  shafts <- kind == "spring"
  gears <- of("ratio") != 1
  each <- function(which, symbol, name, text) {
    do.call(rbind, lapply(which, function(i) {
      quantity(sprintf("%s[%d]", symbol, i), name, text(i), "resistance")
    }))
  }
  brakes <- which(vapply(scene$rotors, function(rotor) !is.null(rotor$brake), NA))
  rbind(
    if (any(shafts)) {
      quantity(
        "k[i]", "stiffness", value_text(of("stiffness_n_m_per_rad")[shafts], "N m/rad"), "spring"
      )
    },
    each(which(kind == "clutch"), "T", "clutch", function(i) {
      torque_text(scene$couplings[[i]]$grip$capacity)
    }),
    each(brakes, "B", "brake", function(i) torque_text(scene$rotors[[i]]$brake$capacity)),
    if (any(gears)) quantity("", "ratio", value_text(of("ratio")[gears], ""))
  )
}

drive_pace <- function(scene, sizes, model) {
  of <- function(name) vapply(scene$couplings, `[[`, double(1), name)
  inertia <- scene$moment_of_inertia_kg_m2
  grips <- c(
    lapply(scene$couplings, `[[`, "grip"), lapply(scene$rotors, function(rotor) rotor$brake)
  )
  loaded <- c(scene$rotors, Filter(Negate(is.null), grips))
  marks <- unlist(lapply(loaded, function(one) {
    c(axle_breaks(one), one$loads$law$breaks_s, one$from_s, one$to_s)
  }))
  rate <- function(k) largest_rate(k, of("ratio"), inertia)
  fades <- vapply(scene$rotors, function(rotor) 1 / shortest_time(rotor, sizes), double(1))
  swings <- vapply(loaded, fastest_swing, double(1), sizes)
  list(
    breaks_s = sort(unique(marks[is.finite(marks)])),
    fades_s = 1 / (max(fades) + rate(of("damping_n_m_s"))),
    swing_rad_per_s = max(swings, sqrt(rate(of("stiffness_n_m_per_rad")))), drifts = TRUE
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

drive_texts <- function() {
  some <- function(x, none) if (!all(vapply(x, none, NA))) x
  list(scene_drive = text_form(function(x) {
    brakes <- lapply(x$rotors, function(rotor) rotor$brake)
    # The rates of the others follow through the ratios.
    first <- function(values) {
      if (identical(values, values[1] / x$ratio_to_first)) values[1] else values
    }
    list(
      bodies = x$bodies %||% x$moment_of_inertia_kg_m2,
      couplings = if (length(x$couplings)) x$couplings,
      torque = some(x$torque, torque_is_none),
      resistance = some(x$resistance, Negate(resists)), brake = some(brakes, is.null),
      theta0_rad = first(x$theta0_rad), omega0_rad_per_s = first(x$omega0_rad_per_s),
      start_s = x$start_s
    )
  }, read_drive))
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

# A bound on the largest eigenvalue of J^-1/2 K J^-1/2 (Gershgorin), with K of springs or dampers
# between neighbours, each behind a gear: k (theta_i - ratio theta_(i+1))^2/2. Gears that hold
# rotors together only lessen it.
largest_rate <- function(k, ratio, inertia) {
  n <- length(inertia)
  if (n < 2L) return(0)
  across <- k * abs(ratio) / sqrt(inertia[-n]) / sqrt(inertia[-1])
  max(c(k / inertia[-n] + across, 0) + c(0, k * ratio^2 / inertia[-1] + across))
}
