# Two bodies and a clutch.
clutch_constraint <- function() {
  table_constraint(
    "clutch",
    models = list(clutch_exact = list(
      equations = "I1 omega1' = tau1 - T, I2 omega2' = tau2 + T; T = capacity sign(slip) or less",
      assumptions = paste(
        "rigid bodies; capacity constant while it slips; torques constant between jumps"
      ),
      limits = "not before the start; where a torque equals the static capacity, rounding decides",
      requires = "constant or stepped torques",
      source = "closed form between exact events; Shigley 2004, chapter 16"
    )),
    title = function(run) "Two bodies and a clutch",
    quick = TRUE,
    keys = c(
      "time_s", "theta_1_rad", "omega_1_rad_per_s", "theta_2_rad", "omega_2_rad_per_s", "heat_j"
    ),
    measures = list(
      theta = measure("rad", c("theta_1_rad", "theta_2_rad"), largest_distance),
      omega = measure("rad/s", c("omega_1_rad_per_s", "omega_2_rad_per_s"), largest_distance)
    ),
    time_scales = NULL,
    summary = function(x, run, call) {
      list(
        final_omega_1_rad_per_s = last(x[["omega_1_rad_per_s"]]),
        final_omega_2_rad_per_s = last(x[["omega_2_rad_per_s"]]),
        heat_j = last(x[["heat_j"]]),
        lock_time_s = if (isTRUE(x[["locked"]][1])) {
          x[["time_s"]][1]
        } else {
          c(run$events$time_s[run$events$event == "lock"], NA_real_)[1]
        }
      )
    },
    drawing = draw_clutch,
    frames = function(scene, rows) {
      shafting_frames(
        scene, rbind(rows$theta_1_rad, rows$theta_2_rad),
        rbind(rows$omega_1_rad_per_s, rows$omega_2_rad_per_s), draw_clutch
      )
    },
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

augment_clutch <- function(x, run, edges, call) {
  flows <- table_flows(core_table("clutch"), run, edges)$since
  if (is.null(flows)) return(NULL)
  power <- function(torque, omega) {
    if (is.null(torque)) 0 else knot_sides(torque_loads(torque)$knots, x$time_s)[, 2] * omega
  }
  c(
    list(
      power_w = power(run$scene$torque[[1]], x$omega_1_rad_per_s) +
        power(run$scene$torque[[2]], x$omega_2_rad_per_s)
    ),
    as.list(as.data.frame(if (nrow(flows)) sweep(flows, 2, flows[1, ]) else flows))
  )
}
