# Two bodies and a clutch.
clutch_constraint <- function() {
  list(
    id = "clutch",
    scene_class = "rot_scene_clutch",
    form = list(
      bodies = bodies_form,
      moment_of_inertia_kg_m2 = "numbers:2", capacity_n_m = "number",
      static_capacity_n_m = "number", torque = list(.each = torque_form),
      steps = list(.each = list(time_s = "sorted", torque_n_m = "numbers")),
      omega0_rad_per_s = "numbers:2", theta0_rad = "numbers:2", engage_s = "limit",
      start_s = "number"
    ),
    title = function(run) "Two bodies and a clutch",
    models = clutch_models,
    columns = clutch_columns,
    keys = c(
      "time_s", "theta_1_rad", "omega_1_rad_per_s", "theta_2_rad", "omega_2_rad_per_s", "heat_j"
    ),
    measures = list(
      theta = measure("rad", c("theta_1_rad", "theta_2_rad"), largest_distance),
      omega = measure(
        "rad/s", c("omega_1_rad_per_s", "omega_2_rad_per_s"), largest_distance
      )
    ),
    summary = function(x, run) {
      list(
        final_omega_1_rad_per_s = last(x[["omega_1_rad_per_s"]]),
        final_omega_2_rad_per_s = last(x[["omega_2_rad_per_s"]]),
        heat_j = last(x[["heat_j"]]),
        lock_time_s = c(run$events$time_s[run$events$event == "lock"], NA_real_)[1]
      )
    },
    texts = clutch_texts(),
    drawing = draw_clutch,
    frames = function(scene, rows) {
      shafting_frames(
        scene, rbind(rows$theta_1_rad, rows$theta_2_rad),
        rbind(rows$omega_1_rad_per_s, rows$omega_2_rad_per_s), draw_clutch
      )
    },
    balances = balance_clutch,
    conserved = conserved_clutch,
    augment = augment_clutch,
    panels = list(
      panel("angular velocity (rad/s)", c(
        omega_1_rad_per_s = "body 1", omega_2_rad_per_s = "body 2"
      )),
      panel("torque of the clutch (N m)", c(clutch_torque_n_m = "clutch")),
      panel("heat (J)", c(heat_j = "clutch"))
    )
  )
}

draw_clutch <- function(scene, theta = NULL) {
  draw_shafting(
    scene, scene$moment_of_inertia_kg_m2, list(kind = "clutch", ratio = 1), clutch_labels = "T",
    theta = theta
  )
}

# The error of the measure holds for each body, not for both together.
largest_distance <- function(got, want) apply(abs(got - want), 1, max)

balance_clutch <- function(x, run, call) {
  if (nrow(x) == 0L) {
    return(list(
      no_balance("energy", NA_character_, "J"),
      no_balance("angular_momentum", "the axle", "kg m^2/s")
    ))
  }
  scene <- run$scene
  inertia <- scene$moment_of_inertia_kg_m2
  rows <- c(which.min(x$time_s), which.max(x$time_s))
  time <- x$time_s[rows]
  omega <- rbind(x$omega_1_rad_per_s[rows], x$omega_2_rad_per_s[rows])
  ledger <- record_of(run)$ledger(scene, run, time[1], time[2])
  work <- ledger[["work_j"]]
  eps <- .Machine$double.eps
  error <- run$info$errors[["omega"]] + eps * max(abs(omega))
  heat <- x$heat_j[rows[2]] - x$heat_j[rows[1]]
  impulses <- vapply(scene$steps, steps_impulse, double(2), time[1], time[2])
  list(
    balance(
      "energy", NA_character_, "J",
      c("change of kinetic energy" = kinetic_change(inertia, omega[, 1], omega[, 2])),
      c("work of the torques" = work),
      c("heat of the clutch" = heat),
      ledger[["work_rounding_j"]] + sum(inertia * abs(omega)) * error +
        16 * eps * abs(x$heat_j[rows[2]]) +
        4 * scene$static_capacity_n_m * run$info$errors[["theta"]] + 4 * eps * (abs(work) + heat)
    ),
    balance(
      "angular_momentum", "the axle", "kg m^2/s",
      c("change of angular momentum" = sum(inertia * (omega[, 2] - omega[, 1]))),
      c("impulse of the torques" = sum(impulses[1, ])),
      double(),
      2 * sum(inertia) * error + 8 * eps * sum(impulses[2, ]) +
        4 * eps * sum(inertia * abs(omega))
    )
  )
}

# Time integral of a stepped torque, and of its absolute value.
steps_impulse <- function(steps, from_s, to_s) {
  ends <- pmin(pmax(c(from_s, steps[[1]], to_s), from_s), to_s)
  parts <- steps[[2]] * diff(ends)
  c(sum(parts), sum(abs(parts)))
}

augment_clutch <- function(x, run, edges, call) {
  scene <- run$scene
  record <- record_of(run)
  torque <- function(steps) steps[[2]][findInterval(x$time_s, steps[[1]]) + 1L]
  first <- match(edges, x$time_s)
  list(
    power_w = torque(scene$steps[[1]]) * x$omega_1_rad_per_s +
      torque(scene$steps[[2]]) * x$omega_2_rad_per_s,
    work_j = vapply(
      edges, function(edge) record$ledger(scene, run, edges[1], edge)[["work_j"]], double(1)
    ),
    dissipated_j = x$heat_j[first] - x$heat_j[first[1]],
    torque_impulse_n_m_s = vapply(edges, function(edge) {
      sum(vapply(scene$steps, function(s) steps_impulse(s, edges[1], edge)[1], double(1)))
    }, double(1))
  )
}

# The clutch acts between the bodies, and dissipates while it slips.
conserved_clutch <- function(scene) {
  driven <- any(vapply(scene$steps, function(steps) any(steps[[2]] != 0), NA))
  causes <- list("a torque acts on a body" = driven)
  slips <- scene$capacity_n_m > 0 && diff(scene$omega0_rad_per_s) != 0
  list(
    keeps_unless(
      "energy", NA_character_, c(causes, list("the clutch slips: heat" = slips)),
      "the clutch does not slip"
    ),
    keeps_unless("angular_momentum", "the axle", causes, "the clutch acts between the bodies")
  )
}

clutch_texts <- function() {
  list(scene_clutch = text_form(function(x) {
    law <- function(i) if (!torque_is_none(x$torque[[i]])) x$torque[[i]]
    list(
      body_1 = x$bodies[[1]], body_2 = x$bodies[[2]], capacity_n_m = x$capacity_n_m,
      static_capacity_n_m = if (x$static_capacity_n_m != x$capacity_n_m) x$static_capacity_n_m,
      torque_1 = law(1), torque_2 = law(2), omega1_rad_per_s = x$omega0_rad_per_s[1],
      omega2_rad_per_s = x$omega0_rad_per_s[2], theta1_rad = x$theta0_rad[1],
      theta2_rad = x$theta0_rad[2], engage_s = if (x$engage_s != -Inf) x$engage_s,
      start_s = x$start_s
    )
  }, scene_clutch))
}
