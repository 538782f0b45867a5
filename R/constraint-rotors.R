# Several rotors on one shaft. Rows in long form: by time, then rotor.
rotors_constraint <- function() {
  table_constraint(
    "rotors",
    models = list(
      rotors_rigid = list(
        equations = "sum(J) domega/dt = sum(tau) - sum(d) omega: all rotors turn as one",
        assumptions = "twists stay below the accuracy asked for: bounded by their energy",
        limits = paste(
          "a bound is known forward in time, or without damping; every piece needs a stiffness"
        ),
        requires = "constant torques, stiff shafts",
        source = "energy norm of the difference; Meirovitch 2001, section 7.5"
      ),
      rotors_modal = list(
        loses = "Stiff springs turn through many radians of phase, and large terms may cancel.",
        equations = "J theta'' + C theta' + K theta = tau, mean motion and twists in modes",
        assumptions = "rigid rotors, linear springs and dampers, constant torques",
        limits = paste(
          "constant torques; the error grows with the phase where rotors are damped unevenly"
        ),
        requires = "constant torques",
        source = "Meirovitch 2001, chapter 7; Higham 2005 (exponential of a matrix)"
      )
    ),
    form = form_of_rotors(),
    title = function(run) {
      n <- length(run$scene$moment_of_inertia_kg_m2)
      paste0(n, " rotor", if (n != 1L) "s", " on one shaft")
    },
    keys = c("time_s", "rotor", "theta_rad", "omega_rad_per_s", "shaft_torque_n_m"),
    time_scales = rotors_time_scales,
    periods = function(scene, call) periods_of_modes(shaft_modes(scene)$natural_rad_per_s),
    summary = function(x, run, call) {
      list(
        moment_of_inertia_kg_m2 = sum(run$scene$moment_of_inertia_kg_m2),
        max_angular_velocity_rad_per_s = largest(x[["omega_rad_per_s"]]),
        max_angular_momentum_kg_m2_per_s = largest(
          sum_of_rotors(x, "angular_momentum_kg_m2_per_s")
        ),
        max_rotational_kinetic_energy_j = largest(sum_of_rotors(x, "rotational_kinetic_energy_j")),
        final_theta_rad = last(x[["theta_rad"]])
      )
    },
    drawing = draw_shaft_rotors,
    frames = shafting_frames_long(draw_shaft_rotors),
    texts = list(scene_rotors = text_form(function(x) {
      zero <- function(x) if (any(x != 0)) x
      list(
        bodies = x$bodies,
        stiffness_n_m_per_rad = x$stiffness_n_m_per_rad,
        damping_n_m_s = zero(x$damping_n_m_s), torque = zero(x$torque),
        resistance = zero(x$resistance), theta0_rad = zero(x$theta0_rad),
        omega0_rad_per_s = zero(x$omega0_rad_per_s), start_s = x$start_s
      )
    }, scene_rotors)),
    augment = augment_rotors,
    panels = list(
      omega_panel(),
      panel("torque of the shaft behind it (N m)", c(shaft_torque_n_m = ""))
    )
  )
}

# (rows, column) => the sum over the rotors at each time; two sums where it stands twice.
sum_of_rotors <- function(x, column) {
  if (is.null(x[[column]])) return(NULL)
  moment <- match(x$time_s, x$time_s)
  row <- moment + length(moment) * as.double(x$rotor)
  if (anyDuplicated(row)) {
    moment <- moment + length(moment) * stats::ave(double(length(row)), row, FUN = seq_along)
  }
  drop(rowsum(x[[column]], moment, reorder = FALSE))
}

# A scene has a number for each rotor, and for each piece of shaft, where its inputs may be one.
form_of_rotors <- function() {
  form <- table_form(core_table("rotors"))
  between <- c("stiffness_n_m_per_rad", "damping_n_m_s")
  each <- c("torque", "resistance", "theta0_rad", "omega0_rad_per_s")
  form[between] <- "numbers=moment_of_inertia_kg_m2-1"
  form[each] <- "numbers=moment_of_inertia_kg_m2"
  form
}

draw_shaft_rotors <- function(scene, theta = NULL) {
  n <- length(scene$moment_of_inertia_kg_m2) - 1L
  draw_shafting(
    scene, scene$moment_of_inertia_kg_m2, list(kind = rep("spring", n), ratio = rep(1, n)),
    theta = theta
  )
}

# A rigid shaft has no twists.
rotors_time_scales <- function(scene, sizes, model) {
  inertia <- scene$moment_of_inertia_kg_m2
  time_scales <- .Call(ffi_scene_time_scales, "rotors", scene, sizes)
  if (model == "rotors_rigid") {
    time_scales$fades_s <- sum(inertia) / sum(scene$resistance)
    time_scales$swing_rad_per_s <- 0
  }
  time_scales$drifts <- any(scene$torque != 0) || sum(inertia * scene$omega0_rad_per_s) != 0
  time_scales
}

augment_rotors <- function(x, run, edges, call) {
  flows <- table_flows(core_table("rotors"), run, edges)$since
  if (is.null(flows)) return(NULL)
  if (nrow(flows)) flows <- sweep(flows, 2, flows[1, ])
  c(
    list(power_w = run$scene$torque[x$rotor] * x$omega_rad_per_s),
    as.list(as.data.frame(flows[, colnames(flows) != "elastic_energy_j", drop = FALSE]))
  )
}
