# Rscript tools/examples.R NAME FILE: compares what a program of inst/examples printed with what R
# computes, bit by bit. Says which numbers differ; status 1 if any does.
suppressMessages(library(rotdyn))
arguments <- commandArgs(TRUE)
printed <- utils::read.csv(arguments[2])

knots <- torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
rolling <- function() {
  table <- rolling_table()
  c(table[c("beta", "acceleration_m_per_s2", "final_speed_m_per_s", "rotational_energy_fraction")],
    list(friction = rolling_friction_coefficient(table$beta, 20)))
}
# Two columns of a scene of each constraint.
scenes_by_name <- function() {
  time_s <- 0.05 * (0:40)
  of <- function(name, scene, columns) {
    motion <- trajectory(scene, time_s)
    data.frame(
      scene = name, time_s = motion$time_s, first = motion[[columns[1]]],
      second = motion[[columns[2]]]
    )
  }
  disk <- body_disk(2, 0.25)
  torque <- torque_motor(2, 300) + torque_pulse(c(0.5, 0.9), c(0.6, 0.3), c(1, -2)) +
    torque_knots(c(0, 1, 2), c(0, 0.8, 0), outside = "hold") + 0.1
  swing <- torque_gravity(1, 1) + torque_sinusoid(2, 3)
  steps <- torque_steps(c(0, 1.2), c(30, -10))
  closing <- torque_knots(c(0, 0.5), c(0, 60), outside = "hold")
  panels <- body_points(data.frame(mass_kg = 1, x_m = c(0, 0), y_m = c(-1.5, 1.5), z_m = 0))
  turn <- data.frame(time_s = c(0, 0.9, 1.1, 2), torque_n_m = c(0.1, 0.1, -0.1, -0.1))
  rbind(
    of("axle", scene_axle(disk, torque, resistance(0.03)), c("theta_rad", "omega_rad_per_s")),
    of("swing", scene_axle(body_rod_end(1, 2), swing, theta0_rad = 2.5),
      c("theta_rad", "applied_torque_n_m")),
    of("clutch", scene_clutch(
      body_disk(20, 0.15), 0.8, 60, static_capacity_n_m = 75, torque = list(steps, -5),
      omega0_rad_per_s = c(15, 0), engage_s = 0.25
    ), c("omega_1_rad_per_s", "heat_j")),
    of("drive", scene_drive(
      list(0.4, 2, body_disk(3, 0.5)),
      list(coupling_clutch(closing, static_ratio = 1.2), coupling_shaft(400, 0.4, ratio = 3)),
      torque = list(torque_motor(40, 200) + 1, NULL, -5),
      resistance = list(NULL, NULL, resistance(0.05, coulomb_n_m = 1)),
      brake = list(NULL, NULL, brake(12, from_s = 1.5)), omega0_rad_per_s = c(150, 0, 0)
    ), c("omega_rad_per_s", "heat_j")),
    of("rotors", scene_rotors(
      list(body_disk(4, 0.2), 0.005, 0.27), c(800, 1200), 0.05, torque = c(2, 0, -2)
    ), c("theta_rad", "shaft_torque_n_m")),
    of("incline", scene_incline(
      body_tensor(2, diag(3) * 0.05), 10, static_friction = 0.2, kinetic_friction = 0.15,
      radius_m = 0.25, v0_m_per_s = 3, omega0_rad_per_s = -2
    ), c("x_m", "omega_rad_per_s")),
    of("free", scene_free(c(1, 1.5, 2), c(0.01, 6, 0.02)), c("qw", "omega_y_rad_per_s")),
    of("satellite", scene_free(
      join_bodies(body_box(40, 0.6, 0.5, 0.8), place_body(panels, c(0.1, 0, 0))), c(0, 0, 0.01),
      rotors = rotor(c(0, 0, 1), 0.01, 0, turn)
    ), c("omega_z_rad_per_s", "rotor_1_omega_rad_per_s")),
    of("pivot", scene_pivot(
      body_tensor(0.5, diag(c(0.002, 0.002, 0.001)), centre_m = c(0, 0, 0.08)), c(0, 0, 60),
      attitude0 = c(0.8, 0.6, 0, 0)
    ), c("qw", "omega_x_rad_per_s"))
  )
}
# A motor, a clutch that closes, a load: a row for each time and rotor.
machine <- function() {
  closing <- torque_knots(c(0, 0.5), c(0, 60), outside = "hold")
  scene <- scene_drive(
    list(body_disk(8, 0.3), 2), coupling_clutch(closing, static_ratio = 1.2),
    torque = list(torque_motor(40, 200) + torque_sinusoid(3, 12), -5),
    resistance = list(NULL, resistance(0.02, coulomb_n_m = 1)), omega0_rad_per_s = c(150, 0)
  )
  trajectory(scene, (0:100) / 50)[
    c("time_s", "rotor", "omega_rad_per_s", "coupling_torque_n_m", "heat_j")
  ]
}
expected <- switch(
  arguments[1],
  "c" = , "c-static" = rolling(),
  "c-precession" = precession_table(utils::read.csv(
    system.file("extdata", "gyroscope_cases.csv", package = "rotdyn")
  ))[c("mass_kg", "gravity_torque_n_m", "spin_angular_momentum_kg_m2_per_s",
       "precession_rad_per_s", "precession_period_s")],
  cpp = trajectory(
    scene_axle(body_disk(2, 0.25), knots, resistance(0.03)), (0:800) / 100
  )[c("time_s", "theta_rad", "omega_rad_per_s", "rotational_kinetic_energy_j")],
  fortran = inertia_table(data.frame(
    shape = c("rod", "rod_end", "hoop", "disk", "sphere", "spherical_shell", "cylinder"),
    mass_kg = 1.5, radius_m = 0.3, length_m = 0.3
  ))[c("shape", "moment_of_inertia_kg_m2", "ixx_kg_m2", "iyy_kg_m2", "izz_kg_m2")],
  rust = spin_up_table(
    data.frame(moment_of_inertia_kg_m2 = 0.0625 * (1:20), viscous_n_m_s = 0.03), knots, 8
  )[c("moment_of_inertia_kg_m2", "final_theta_rad", "final_omega_rad_per_s",
      "max_omega_rad_per_s")],
  "python-scenes" = scenes_by_name(),
  "c-drive" = machine(),
  python = trajectory(
    scene_axle(1, torque_gravity(1, 1), theta0_rad = 3), 10 * (0:100) / 100
  )[c("time_s", "theta_rad", "omega_rad_per_s")],
  julia = {
    beta <- rolling_table()$beta
    table <- energy_partition(beta, rolling_final_speed(beta, 1), mass_kg = 1, radius_m = 0.1)
    names(table) <- sub("_kinetic_", "_", names(table))
    table[c("beta", "speed_m_per_s", "omega_rad_per_s", "translational_energy_j",
            "rotational_energy_j", "total_energy_j")]
  }
)
if (!identical(names(printed), names(expected)) || nrow(printed) != length(expected[[1]])) {
  cat("other columns or rows:", names(printed), "\n")
  quit(status = 1)
}
differ <- FALSE
for (name in names(printed)) {
  at <- which(!(printed[[name]] == expected[[name]] |
                  (is.na(printed[[name]]) & is.na(expected[[name]]))))
  if (!length(at)) next
  differ <- TRUE
  cat(sprintf("%s, row %d: printed %.17g, R has %.17g\n", name, at[1],
              as.double(printed[[name]][at[1]]), as.double(expected[[name]][at[1]])))
}
quit(status = if (differ) 1L else 0L)
