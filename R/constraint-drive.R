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
    columns = drive_columns,
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
    balances = balance_drive,
    conserved = conserved_drive,
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

# From the rows of the first and the last time.
balance_drive <- function(x, run, call) {
  none <- list(
    no_balance("energy", NA_character_, "J"),
    no_balance("angular_momentum", "the axis", "kg m^2/s")
  )
  scene <- run$scene
  inertia <- scene$moment_of_inertia_kg_m2
  n <- length(inertia)
  if (nrow(x) == 0L) return(none)
  span <- range(x$time_s)
  ends <- lapply(span, function(time) {
    rows <- which(x$time_s == time)
    rows[match(seq_len(n), x$rotor[rows])]
  })
  if (anyNA(unlist(ends))) return(none)
  sums <- drive_sums(scene, c(run, call = call), span)
  if (is.null(sums)) return(none)
  at <- function(column) lapply(ends, function(rows) x[[column]][rows])
  flow <- function(name) sums[[2, name]] - sums[[1, name]]
  omega <- at("omega_rad_per_s")
  theta <- at("theta_rad")
  heat <- at("heat_j")
  coupling <- at("coupling_heat_j")
  kind <- vapply(scene$couplings, function(coupling) coupling$kind, double(1))
  behind <- function(which) sum((coupling[[2]] - coupling[[1]])[-n][which])
  eps <- .Machine$double.eps
  error <- run$info$errors[["omega"]] + eps * max(abs(unlist(omega)))
  twist <- drive_elastic(scene, omega, at("coupling_torque_n_m"), sums[1, "twist_error_rad"], error)
  momentum <- sum(inertia * (omega[[2]] - omega[[1]]))
  flows <- abs(sums[, c("work_j", drive_heats(sums))])
  impulses <- vapply(
    c("torque_impulse_n_m_s", "resistance_impulse_n_m_s", "housing_impulse_n_m_s"), flow, double(1)
  )
  list(
    balance(
      "energy", NA_character_, "J",
      c(
        "change of kinetic energy" = kinetic_change(inertia, omega[[1]], omega[[2]]),
        "change of elastic energy" = twist$change
      ),
      c("work of the torques" = flow("work_j")),
      c(
        "heat of resistance and brakes" = sum(heat[[2]] - heat[[1]]),
        "heat of dampers" = behind(kind == 0), "heat of clutches" = behind(kind == 1),
        if (any(vapply(scene$couplings, loses_power, NA))) c("heat of gears" = behind(kind == 2))
      ),
      sums[1, "work_error_j"] + sums[1, "heat_error_j"] + twist$rounding +
        sum(inertia * (abs(omega[[1]]) + abs(omega[[2]]))) * error + 8 * eps * sum(flows)
    ),
    balance(
      "angular_momentum", "the axis", "kg m^2/s",
      c("change of angular momentum" = momentum),
      c(
        "impulse of the torques" = impulses[[1]],
        "impulse of the gear housings" = impulses[[3]]
      ),
      c("impulse of resistance and brakes" = -impulses[[2]]),
      sums[1, "impulse_error_n_m_s"] + 2 * sum(inertia) * error +
        4 * eps * (n * sum(inertia * abs(omega[[2]])) + sum(abs(impulses)))
    )
  )
}

# From the torques of the shafts: the difference of two angles loses the twist of a stiff shaft.
drive_elastic <- function(scene, omega, torque, twist_error, omega_error) {
  out <- c(change = 0, rounding = 0)
  for (i in seq_along(scene$couplings)) {
    coupling <- scene$couplings[[i]]
    k <- coupling$stiffness_n_m_per_rad
    if (coupling$kind != 0 || k == 0) next
    c <- coupling$damping_n_m_s
    damped <- vapply(omega, function(w) c * (w[i] - coupling$ratio * w[i + 1L]), double(1))
    size <- vapply(omega, function(w) c * (abs(w[i]) + abs(coupling$ratio * w[i + 1L])), double(1))
    total <- c(torque[[1]][i], torque[[2]][i])
    spring <- total - damped
    off <- k * twist_error + c * (1 + abs(coupling$ratio)) * omega_error +
      4 * .Machine$double.eps * (abs(total) + size)
    out <- out + c(0.5 * (spring[2] - spring[1]) * (spring[2] + spring[1]) / k,
                   sum(abs(spring) * off) / k + sum(off^2) / k)
  }
  as.list(out)
}

augment_drive <- function(x, run, edges, call) {
  sums <- if (length(edges)) drive_sums(run$scene, c(run, call = call), edges)
  if (is.null(sums) && length(edges)) return(NULL)
  since_first <- function(names) {
    if (!length(edges)) return(double())
    total <- rowSums(sums[, names, drop = FALSE])
    total - total[1]
  }
  list(
    power_w = x[["applied_torque_n_m"]] * x$omega_rad_per_s,
    work_j = since_first("work_j"),
    dissipated_j = since_first(drive_heats(sums)),
    torque_impulse_n_m_s = since_first("torque_impulse_n_m_s"),
    damping_impulse_n_m_s = since_first("resistance_impulse_n_m_s")
  )
}

# Torques, resistance and brakes act from outside, and so do the housings of gears. A clutch may
# slip unless all that is joined turns together.
conserved_drive <- function(scene) {
  rotors <- scene$rotors
  any_of <- function(parts, f) any(vapply(parts, f, NA))
  causes <- list(
    "a torque acts on a rotor" = any_of(rotors, function(rotor) loads_act(rotor$loads)),
    "a resistance acts on a rotor" = any_of(rotors, function(rotor) resists(rotor$resistance)),
    "a brake acts on a rotor" = any_of(rotors, function(rotor) !is.null(rotor$brake))
  )
  couplings <- scene$couplings
  kind <- vapply(couplings, function(coupling) coupling$kind, double(1))
  list(
    keeps_unless("energy", NA_character_, c(causes, list(
      "a shaft is damped" = any_of(couplings, function(coupling) coupling$damping_n_m_s != 0),
      "a clutch may slip: heat" = any(kind == 1),
      "a gear has a loss" = any_of(couplings, loses_power)
    )), "the shafts give back what they take: kinetic plus elastic energy stays"),
    keeps_unless("angular_momentum", "the axis", c(causes, list(
      "the housings of the gears take a torque" =
        any_of(couplings, function(coupling) coupling$ratio != 1)
    )), "all torques act between the rotors")
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
