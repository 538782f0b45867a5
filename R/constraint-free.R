# A body that nothing holds.
free_constraint <- function() {
  table_constraint(
    "free", free_models("free"),
    title = function(run) {
      paste("A free", sub("^an? ", "", scene_body(run$scene)))
    },
    quick = TRUE,
    keys = c("time_s", quaternion_columns, free_rates("")),
    bodies = rep("body", 3), # one for each principal moment
    measures = free_measures(),
    call_laws = call_free_laws,
    summary = function(x, run, call) {
      c(sizes_in_space(x), list(
        flip_time_s = if (length(acts_on_flips(run$scene))) NA_real_ else scene_flip_time(run$scene)
      ))
    },
    texts = list(scene_free = text_form(free_arguments, read_free)),
    drawing = draw_free,
    solid = free_solid,
    augment = augment_free,
    periods = free_periods,
    panels = free_panels()
  )
}

# ---- words --------------------------------------------------------------------------------------

# Of the models of free bodies, and those with a fixed point that solve the same equations.
free_models <- function(id) {
  pivot <- id == "pivot"
  gravity <- if (pivot) " + r x m g"
  held <- if (pivot) "held at its centre of mass (or no gravity), "
  equations <- paste0(
    "L' = L x omega", gravity, " + torque - damping L (body axes), q' = q (0, omega)/2"
  )
  beyond <- "beyond 1e15 rad no digit of the attitude is left"
  closed <- list(
    list(
      equations = "L' = L x omega - damping L (body axes), q' = q (0, omega)/2",
      assumptions = "rigid body; damping in proportion to the angular momentum",
      limits = beyond,
      requires = paste0(held, "no torque"),
      source = "Landau and Lifshitz, Mechanics, section 37; elliptic functions of DLMF 19 and 22"
    ),
    list(
      equations = "L' = L x omega, L = I omega + sum J W a (body axes), q' = q (0, omega)/2",
      assumptions = "rigid body; symmetric rotors, driven at constant speeds or free of friction",
      limits = beyond,
      requires = if (pivot) {
        paste0(held, "rotors along a principal axis, no torque")
      } else {
        "rotors along a principal axis, no torque, no damping"
      },
      source =
        "Hughes 1986, Spacecraft Attitude Dynamics, chapter 6; functions of DLMF 19 and 22"
    )
  )
  names(closed) <- paste0(id, if (pivot) c("_free", "_gyrostat") else c("_exact", "_gyrostat"))
  integrated <- integrated_words(
    id,
    equations = equations,
    assumptions = "rigid body; torques finite, and smooth between their breaks",
    requires = "moments of inertia greater than 0", fixed = FALSE
  )
  integrated[[2]]$limits <-
    "each step solves a system of equations: expensive for a motion that is not stiff"
  stepped <- fixed_words(
    id, equations = equations, assumptions = "rigid body; torques smooth between their breaks"
  )
  changed <- list(
    list(
      limits = "order 1; angular momentum and energy grow without bound",
      assumptions = "rigid body; a step goes on along the slopes at its start"
    ),
    list(
      limits = "order 1; without torque the angular momentum stays, the energy drifts",
      assumptions =
        "rigid body; a step changes L in space axes, then turns the body by the new rate"
    ),
    list(limits = "order 4; the energy drifts in proportion to time")
  )
  stepped[] <- Map(utils::modifyList, stepped, changed)
  split <- utils::modifyList(stepped[[3]], list(
    limits = "order 6; the energy stays within a bound, the phase drifts in proportion to time",
    source = paste(
      "McLachlan 1995; Kahan and Li 1997;",
      "Hairer, Lubich and Wanner 2006, section VII.5"
    ),
    assumptions = "rigid body; a step is composed of exact turns and of kicks by gravity"
  ))
  stepped <- c(stepped, stats::setNames(list(split), paste0(id, "_split")))
  positive <- "moments of inertia greater than 0"
  for (name in names(stepped)) stepped[[name]]$requires <- paste0("to be named; ", positive)
  stepped[[4]]$requires <-
    "to be named; no torque but gravity, no motors, no damping, moments greater than 0"
  c(closed, integrated, stepped)
}

free_panels <- function() {
  list(
    panel("angular velocity in the body (rad/s)",
          stats::setNames(c("x", "y", "z"), free_rates(""))),
    panel("angular velocity in space (rad/s)",
          stats::setNames(c("x", "y", "z"), free_rates("space_"))),
    panel("attitude as a quaternion", stats::setNames(c("w", "x", "y", "z"), quaternion_columns)),
    panel("rotational energy (J)", c(rotational_kinetic_energy_j = "")),
    panel("rotors, relative to the body (rad/s)",
          stats::setNames(paste("rotor", 1:16), sprintf("rotor_%d_omega_rad_per_s", 1:16)))
  )
}

# ---- questions ----------------------------------------------------------------------------------

free_measures <- function() {
  list(
    attitude = measure("rad", quaternion_columns, attitude_distance),
    omega = measure("rad/s", free_rates("")),
    angular_momentum = measure("kg m^2/s", free_momenta)
  )
}

# The angle between attitudes; 1 from no attitude at all, the size of each.
attitude_distance <- function(got, want) {
  columns <- c(asplit(unname(got), 2), asplit(unname(want), 2))
  angle <- .Call(ffi_attitude_pair, 3, lapply(columns, as.double))[[1]]
  ifelse(rowSums(want^2) == 0, 1, angle)
}

call_free_laws <- function(scene, call) {
  laws <- Filter(is.function, c(list(scene$torque), lapply(scene$rotors, `[[`, "torque")))
  if (!length(laws)) return(NULL)
  at <- list(scene$start_s, scene$omega0_rad_per_s, scene$attitude0)
  function() for (f in laws) do.call(f, at[seq_len(count_law_arguments(f, function(n) n))])
}

sizes_in_space <- function(x) {
  size <- function(columns) {
    if (all(columns %in% names(x))) {
      largest(sqrt(rowSums(do.call(cbind, unclass(x)[columns])^2)))
    } else {
      NA_real_
    }
  }
  list(
    max_angular_velocity_rad_per_s = size(free_rates("")),
    max_angular_momentum_kg_m2_per_s = size(free_momenta),
    max_rotational_kinetic_energy_j = largest(x[["rotational_kinetic_energy_j"]])
  )
}

# Power and the sums since the first time.
augment_free <- function(x, run, edges, call) {
  scene <- run$scene
  run$call <- call
  since <- table_flows(core_table(constraint_of(scene)$id), run, edges)$since
  if (is.null(since)) return(NULL)
  if (nrow(since)) since <- sweep(since, 2, since[1, ])
  colnames(since)[colnames(since) == "heat_j"] <- "dissipated_j"
  if (is.null(scene$rotors)) since <- since[, colnames(since) != "motor_work_j", drop = FALSE]
  rates <- free_rates(if (scene$torque_axes == "space") "space_" else "")
  power <- rowSums(free_torque_at(scene, x) * do.call(cbind, unclass(x)[rates]))
  c(list(power_w = power), as.list(as.data.frame(since)))
}

# The torque at each row, in its axes: a matrix of three columns.
free_torque_at <- function(scene, x) {
  n <- nrow(x)
  torque <- scene$torque
  if (!n) return(matrix(0, 0, 3))
  if (is.function(torque)) {
    state <- do.call(cbind, unclass(x)[c("time_s", free_rates(""), quaternion_columns)])
    all <- count_law_arguments(torque, function(n) n) == 3L
    return(t(apply(state, 1, function(at) {
      if (all) torque(at[[1]], unname(at[2:4]), unname(at[5:8])) else torque(at[[1]])
    })))
  }
  if (is.list(torque)) {
    return(vapply(torque[-1], between_knots, double(n), at = torque$time_s, time_s = x$time_s))
  }
  matrix(torque %||% 0, n, 3, byrow = TRUE)
}

# As rot_free_between_knots() in src/core/scene/free/torque.c: 0 outside, the later value at a jump.
between_knots <- function(y, at, time_s) {
  i <- pmin(pmax(findInterval(time_s, at), 1L), length(at) - 1L)
  width <- at[i + 1L] - at[i]
  part <- ifelse(width > 0, (time_s - at[i]) / width, 1)
  value <- ifelse(part < 1, y[i] + (y[i + 1L] - y[i]) * part, y[i + 1L])
  ifelse(time_s < at[1] | time_s > at[length(at)], 0, value)
}

# Those of scene_free(), of a scene with its fields.
free_arguments <- function(x) {
  upright <- identical(x$attitude0, c(1, 0, 0, 0))
  # The breaks of rotors are theirs.
  own <- setdiff(x$breaks_s, unlist(lapply(x$rotors, `[[`, "breaks_s")))
  list(
    body = x$body, omega0_rad_per_s = x$omega0_rad_per_s, attitude0 = if (!upright) x$attitude0,
    torque = law_with_breaks(list(torque = x$torque, breaks_s = own)),
    torque_axes = if (x$torque_axes == "space") "space", resistance = x$resistance,
    rotors = x$rotors, start_s = x$start_s
  )
}

read_free <- function(body, omega0_rad_per_s, attitude0 = NULL, torque = NULL,
                      torque_axes = "body", resistance = NULL, rotors = NULL, start_s = 0) {
  keep_attitude(scene_free(
    body, omega0_rad_per_s, attitude0 = attitude0, torque = torque, torque_axes = torque_axes,
    resistance = resistance, rotors = rotors, start_s = start_s
  ), attitude0)
}

# A unit quaternion keeps its bits.
keep_attitude <- function(scene, attitude) {
  if (is.double(attitude) && length(attitude) == 4L &&
    max(abs(attitude - scene$attitude0)) <= 4 * .Machine$double.eps) {
    scene$attitude0 <- as.double(attitude)
  }
  scene
}

free_periods <- function(scene, call) {
  if (length(core_effects("free", scene))) {
    abort_no_period(scene, call, "{.fn trajectory} and {.fn time_when} show the motion.")
  }
  .Call(ffi_free_period, scene)
}
