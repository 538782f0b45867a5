# Several rotors on one shaft. Rows in long form: by time, then rotor.
rotors_constraint <- function() {
  list(
    id = "rotors",
    scene_class = "rot_scene_rotors",
    form = list(
      bodies = bodies_form,
      moment_of_inertia_kg_m2 = "numbers",
      stiffness_n_m_per_rad = "numbers=moment_of_inertia_kg_m2-1",
      damping_n_m_s = "numbers=moment_of_inertia_kg_m2-1",
      viscous_n_m_s = "numbers=moment_of_inertia_kg_m2",
      torque_n_m = "numbers=moment_of_inertia_kg_m2",
      theta0_rad = "numbers=moment_of_inertia_kg_m2",
      omega0_rad_per_s = "numbers=moment_of_inertia_kg_m2", start_s = "number"
    ),
    title = function(run) "Rotors on one shaft",
    models = rotors_models,
    columns = rotors_columns,
    keys = c("time_s", "rotor", "theta_rad", "omega_rad_per_s", "shaft_torque_n_m"),
    index = "rotor",
    copies = function(scene) length(scene$moment_of_inertia_kg_m2),
    measures = list(
      theta = measure("rad", "theta_rad"),
      omega = measure("rad/s", "omega_rad_per_s")
    ),
    pace = rotors_pace,
    summary = function(x, run) {
      whole <- function(column) {
        if (!is.null(x[[column]])) rowsum(x[[column]], as.character(x$time_s))
      }
      list(
        moment_of_inertia_kg_m2 = sum(run$scene$moment_of_inertia_kg_m2),
        max_angular_velocity_rad_per_s = largest(x[["omega_rad_per_s"]]),
        max_angular_momentum_kg_m2_per_s = largest(whole("angular_momentum_kg_m2_per_s")),
        max_rotational_kinetic_energy_j = largest(whole("rotational_kinetic_energy_j")),
        final_theta_rad = last(x[["theta_rad"]])
      )
    },
    drawing = draw_shaft_rotors,
    frames = shafting_frames_long(draw_shaft_rotors),
    texts = list(scene_rotors = text_form(function(x) {
      zero <- function(x) if (any(x != 0)) x
      list(
        bodies = x$bodies %||% x$moment_of_inertia_kg_m2,
        stiffness_n_m_per_rad = x$stiffness_n_m_per_rad,
        damping_n_m_s = zero(x$damping_n_m_s), torque_n_m = zero(x$torque_n_m),
        viscous_n_m_s = zero(x$viscous_n_m_s), theta0_rad = zero(x$theta0_rad),
        omega0_rad_per_s = zero(x$omega0_rad_per_s), start_s = x$start_s
      )
    }, scene_rotors)),
    balances = balance_rotors,
    conserved = conserved_rotors,
    augment = augment_rotors,
    panels = list(
      panel("angular velocity (rad/s)", c(omega_rad_per_s = "")),
      panel("torque of the shaft behind it (N m)", c(shaft_torque_n_m = ""))
    )
  )
}

draw_shaft_rotors <- function(scene, theta = NULL) {
  n <- length(scene$moment_of_inertia_kg_m2) - 1L
  draw_shafting(
    scene, scene$moment_of_inertia_kg_m2, list(kind = rep("spring", n), ratio = rep(1, n)),
    theta = theta
  )
}

# A rigid shaft has no twists.
rotors_pace <- function(scene, sizes, model) {
  inertia <- scene$moment_of_inertia_kg_m2
  rigid <- model == "rotors_rigid"
  ratio <- rep(1, length(inertia) - 1L)
  fades <- if (rigid) {
    sum(scene$viscous_n_m_s) / sum(inertia)
  } else {
    largest_rate(scene$damping_n_m_s, ratio, inertia) + max(scene$viscous_n_m_s / inertia)
  }
  list(
    breaks_s = double(), fades_s = 1 / fades,
    swing_rad_per_s = if (rigid) 0 else
      sqrt(largest_rate(scene$stiffness_n_m_per_rad, ratio, inertia)),
    drifts = any(scene$torque_n_m != 0) || sum(inertia * scene$omega0_rad_per_s) != 0
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

# From the rows of the first and the last time.
balance_rotors <- function(x, run, call) {
  none <- list(
    no_balance("energy", NA_character_, "J"),
    no_balance("angular_momentum", "the shaft", "kg m^2/s")
  )
  scene <- run$scene
  inertia <- scene$moment_of_inertia_kg_m2
  n <- length(inertia)
  if (nrow(x) == 0L) return(none)
  span <- range(x$time_s)
  state <- function(time) {
    rows <- which(x$time_s == time)
    rows <- rows[match(seq_len(n), x$rotor[rows])]
    if (anyNA(rows)) NULL else list(
      theta = x$theta_rad[rows], omega = x$omega_rad_per_s[rows],
      shaft = x$shaft_torque_n_m[rows][-n]
    )
  }
  from <- state(span[1])
  to <- state(span[2])
  if (is.null(from) || is.null(to)) return(none)
  record <- record_of(run)
  ledger <- record$ledger(scene, run, span[1], span[2])
  eps <- .Machine$double.eps
  rate <- c(from$omega, to$omega)
  error <- run$info$errors[["omega"]] + eps * max(abs(rate))
  twist <- elastic_energy(scene, from, to, rigid = record$id == "rotors_rigid")
  momentum <- sum(inertia * (to$omega - from$omega))
  turned_error <- 2 * run$info$errors[["theta"]] + eps * max(abs(c(from$theta, to$theta)))
  list(
    balance(
      "energy", NA_character_, "J",
      c(
        "change of kinetic energy" = kinetic_change(inertia, from$omega, to$omega),
        "change of elastic energy" = twist$change
      ),
      c("work of the torques" = ledger[["work_j"]]),
      c("heat of dampers and bearings" = ledger[["dissipated_j"]]),
      # The error of the twists has the energy norm of that of omega.
      ledger[["work_rounding_j"]] + ledger[["dissipated_rounding_j"]] +
        sum(inertia * abs(rate)) * error + sqrt(2 * sum(inertia)) * twist$root * error +
        twist$rounding + 4 * eps * (abs(ledger[["work_j"]]) + ledger[["dissipated_j"]])
    ),
    balance(
      "angular_momentum", "the shaft", "kg m^2/s",
      c("change of angular momentum" = momentum),
      c("impulse of the torques" = sum(scene$torque_n_m) * diff(span)),
      c("impulse of the bearings" = sum(scene$viscous_n_m_s * (to$theta - from$theta))),
      2 * sum(inertia) * error + sum(scene$viscous_n_m_s) * turned_error +
        4 * eps * (n * sum(inertia * abs(rate)) + sum(abs(scene$torque_n_m)) * diff(span))
    )
  )
}

# From the torque of the shaft: the difference of two angles loses the twist of a stiff shaft. A
# rigid shaft has none.
elastic_energy <- function(scene, from, to, rigid) {
  k <- scene$stiffness_n_m_per_rad
  if (rigid || all(k == 0)) return(list(change = 0, root = 0, rounding = 0))
  damped <- function(state) scene$damping_n_m_s * -diff(state$omega)
  spring <- function(state) (state$shaft - damped(state))[k > 0]
  size <- function(state) {
    (abs(state$shaft) + scene$damping_n_m_s * max(abs(state$omega)))[k > 0]
  }
  k_used <- k[k > 0]
  before <- spring(from)
  after <- spring(to)
  list(
    change = sum(0.5 * (after - before) * (after + before) / k_used),
    root = sqrt(sum(before^2 / k_used)) + sqrt(sum(after^2 / k_used)),
    rounding = 8 * .Machine$double.eps *
      sum((abs(before) * size(from) + abs(after) * size(to)) / k_used)
  )
}

augment_rotors <- function(x, run, edges, call) {
  scene <- run$scene
  record <- record_of(run)
  ledger <- vapply(edges, function(edge) {
    record$ledger(scene, run, edges[1], edge)[c("work_j", "dissipated_j")]
  }, double(2))
  list(
    power_w = scene$torque_n_m[x$rotor] * x$omega_rad_per_s,
    work_j = ledger[1, ],
    dissipated_j = ledger[2, ],
    torque_impulse_n_m_s = sum(scene$torque_n_m) * (edges - edges[1])
  )
}

# Shafts twist and give back; they act between the rotors.
conserved_rotors <- function(scene) {
  causes <- list(
    "a torque acts on a rotor" = any(scene$torque_n_m != 0),
    "the viscous resistance acts on a rotor" = any(scene$viscous_n_m_s != 0)
  )
  list(
    keeps_unless(
      "energy", NA_character_,
      c(causes, list("the shafts are damped" = any(scene$damping_n_m_s != 0))),
      "the shafts give back what they take: kinetic plus elastic energy stays"
    ),
    keeps_unless(
      "angular_momentum", "the shaft", causes, "all torques act between the rotors"
    )
  )
}
