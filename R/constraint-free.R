# A body that nothing holds.
free_constraint <- function() {
  list(
    id = "free",
    scene_class = "rot_scene_free",
    form = list(
      body = c(body_form, .optional = TRUE), moment_of_inertia_kg_m2 = "numbers:3",
      axes = "numbers:4", moment_error = "number", omega0_rad_per_s = "numbers:3",
      attitude0 = "numbers:4", torque_n_m = "numbers:3",
      knots = list(
        .optional = TRUE, time_s = "sorted", x_n_m = "numbers=time_s", y_n_m = "numbers=time_s",
        z_n_m = "numbers=time_s"
      ),
      law = list(.optional = TRUE, f = "function", arguments = "count"),
      in_space = "number", breaks_s = "sorted", damping_per_s = "number", start_s = "number",
      rotors = list(.optional = TRUE, .each = rotor_form)
    ),
    title = function(run) "A free body",
    models = free_models,
    columns = free_columns,
    more_names = rotor_names,
    quick = function(scene) {
      is.null(.subset2(scene, "law")) && is.null(.subset2(scene, "rotors")) &&
        known_to_rounding(scene)
    },
    keys = c("time_s", quaternion_columns, free_rates("")),
    measures = list(
      attitude = measure("rad", quaternion_columns, attitude_distance),
      omega = measure("rad/s", free_rates("")),
      angular_momentum = measure("kg m^2/s", free_momenta)
    ),
    pace = function(scene, sizes, model) {
      list(
        breaks_s = scene$breaks_s,
        fades_s = if (scene$damping_per_s > 0) 1 / scene$damping_per_s else Inf,
        swing_rad_per_s = 2 * sizes[["omega"]] + rotor_pace(scene)
      )
    },
    call_laws = function(scene, call) {
      laws <- Filter(Negate(is.null), free_laws(scene, call))
      if (!length(laws)) return(NULL)
      at <- c(scene$start_s, scene$omega0_rad_per_s, scene$attitude0)
      function() for (law in laws) law(at)
    },
    summary = function(x, run) {
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
        max_rotational_kinetic_energy_j = largest(x[["rotational_kinetic_energy_j"]]),
        flip_time_s = if (is.null(run$scene$rotors)) scene_flip_time(run$scene) else NA_real_
      )
    },
    texts = free_texts(),
    drawing = draw_free,
    solid = free_solid,
    balances = balance_free,
    conserved = conserved_free,
    augment = augment_free,
    panels = list(
      panel("angular velocity in the body (rad/s)",
            stats::setNames(c("x", "y", "z"), free_rates(""))),
      panel("angular velocity in space (rad/s)",
            stats::setNames(c("x", "y", "z"), free_rates("space_"))),
      panel("attitude as a quaternion", stats::setNames(c("w", "x", "y", "z"), quaternion_columns)),
      panel("rotational energy (J)", c(rotational_kinetic_energy_j = "")),
      panel("rotors, relative to the body (rad/s)",
            stats::setNames(paste("rotor", 1:16), sprintf("rotor_%d_omega_rad_per_s", 1:16)))
    )
  )
}

# The angle between attitudes; 1 from no attitude at all, the size of each.
attitude_distance <- function(got, want) {
  columns <- c(asplit(unname(got), 2), asplit(unname(want), 2))
  angle <- .Call(ffi_attitude_pair, 3, lapply(columns, as.double))[[1]]
  ifelse(rowSums(want^2) == 0, 1, angle)
}

balance_free <- function(x, run, call) {
  about <- "the centre of mass"
  momenta <- paste0("angular_momentum_", c("x", "y", "z"))
  rows <- c(which.min(x$time_s), which.max(x$time_s))
  scene <- run$scene
  run$call <- call
  ledger <- if (nrow(x)) {
    record_of(run)$ledger(scene, run, x$time_s[rows[1]], x$time_s[rows[2]])
  }
  if (is.null(ledger) || anyNA(ledger) || !all(rotor_names(scene) %in% names(x))) {
    return(c(
      list(no_balance("energy", NA_character_, "J")),
      lapply(momenta, no_balance, about, "kg m^2/s"),
      list(no_balance("quaternion_norm", NA_character_, "1"))
    ))
  }
  ends <- function(columns) do.call(cbind, unclass(x)[columns])[rows, , drop = FALSE]
  omega <- ends(free_rates(""))
  q <- ends(quaternion_columns)
  body <- omega %*% free_tensor(scene)
  change_of_energy <- 0.5 * sum((omega[2, ] - omega[1, ]) * colSums(body))
  spins <- rotor_balance(scene, ends, omega)
  body <- body + spins$momentum
  change_of_energy <- change_of_energy + spins$change
  # The turned vectors of a quaternion that is not of unit length show.
  space <- do.call(cbind, .Call(
    ffi_attitude_turn, lapply(c(asplit(q, 2), asplit(body, 2)), as.double), 1
  ))
  eps <- .Machine$double.eps
  errors <- run$info$errors
  size <- max(sqrt(rowSums(body^2)))
  heat <- ledger[["heat_j"]]
  work <- ledger[["work_j"]]
  motors <- if (!is.null(scene$rotors)) ledger[["motor_work_j"]]
  fastest <- max(sqrt(rowSums(omega^2)))
  # Steps are chosen for the worst measure, mostly the attitude. The error of one far below does not
  # fall as their order says: the distance of two runs shows it to a thousandth of that, not better.
  omega_error <- max(errors[["omega"]], 1e-3 * errors[["attitude"]] * fastest)
  energy_error <- 2 * size * (omega_error + 8 * eps * fastest) +
    8 * eps * sum(abs(c(heat, work, motors))) + ledger[["energy_rounding_j"]] +
    spins$speed * (2 * errors[["angular_momentum"]] + 16 * eps * spins$size)
  momentum_error <- 2 * errors[["angular_momentum"]] + 32 * eps * (size + spins$size) +
    ledger[["impulse_rounding_n_m_s"]]
  change <- unname(space[2, ] - space[1, ])
  impulse <- ledger[free_impulses("torque")]
  damping <- ledger[free_impulses("damping")]
  c(
    list(balance(
      "energy", NA_character_, "J",
      c("change of rotational energy" = change_of_energy),
      c("work of the torque" = work, "work of the motors" = motors),
      c("heat of the damping" = heat), energy_error
    )),
    lapply(1:3, function(k) {
      balance(
        momenta[k], about, "kg m^2/s", c("change of angular momentum" = change[[k]]),
        c("impulse of the torque" = impulse[[k]]), c("impulse of the damping" = -damping[[k]]),
        momentum_error
      )
    }),
    list(balance(
      "quaternion_norm", NA_character_, "1",
      c("change of the norm" = sum((q[2, ] - q[1, ]) * (q[2, ] + q[1, ])) / 2),
      double(), double(), 8 * eps
    ))
  )
}

# What rotors add at two rows to L in body axes, and to the change of the energy without its
# cancellation; sums of their sizes.
rotor_balance <- function(scene, ends, omega) {
  out <- list(momentum = 0, change = 0, size = 0, speed = 0)
  for (k in seq_along(scene$rotors)) {
    one <- scene$rotors[[k]]
    speed <- as.vector(ends(sprintf("rotor_%d_omega_rad_per_s", k)))
    along <- as.vector(omega %*% one$axis)
    out$momentum <- out$momentum + one$inertia_kg_m2 * outer(speed, one$axis)
    out$change <- out$change + one$inertia_kg_m2 *
      (diff(speed) * (mean(along) + mean(speed)) + mean(speed) * diff(along))
    out$size <- out$size + one$inertia_kg_m2 * max(abs(speed))
    out$speed <- out$speed + max(abs(speed)) + max(abs(along))
  }
  out
}

# A torque in space axes leaves the components of L alone that it has none along.
conserved_free <- function(scene) {
  open <- !is.null(scene$law)
  along <- vapply(1:3, function(k) {
    scene$torque_n_m[k] != 0 || any(scene$knots[[k + 1L]] != 0)
  }, NA)
  acts <- open || any(along)
  damped <- list("the damping acts" = scene$damping_per_s != 0)
  motors <- list("the motors of the rotors work" = has_motors(scene))
  c(
    list(keeps_unless(
      "energy", NA_character_, c(list("the torque works" = acts), damped, motors),
      "no torque acts: the energy of rotation stays"
    )),
    lapply(1:3, function(k) {
      keeps_unless(
        paste0("angular_momentum_", c("x", "y", "z")[k]), "the centre of mass",
        c(list("a torque acts" = open || (if (scene$in_space == 1) along[k] else acts)), damped),
        "no torque acts along it"
      )
    })
  )
}

augment_free <- function(x, run, edges, call) {
  flows <- c("work_j", "heat_j", free_impulses("torque"), free_impulses("damping"))
  names <- c("work_j", "dissipated_j", free_impulses("torque"), free_impulses("damping"))
  if (!is.null(run$scene$rotors)) {
    flows <- c(flows, "motor_work_j")
    names <- c(names, "motor_work_j")
  }
  none <- stats::setNames(rep(list(double()), length(names)), names)
  if (!length(edges)) return(c(list(power_w = double()), none))
  run$call <- call
  scene <- run$scene
  sums <- if (is.null(record_of(run)$adapts)) {
    t(vapply(edges, function(edge) {
      record_of(run)$ledger(scene, run, edges[1], edge)[flows]
    }, double(length(flows))))
  } else {
    all <- free_sums(scene, run, edges)
    if (is.null(all)) return(NULL)
    sweep(all[, flows, drop = FALSE], 2, all[1, flows])
  }
  power <- rowSums(free_torque_at(scene, x) * do.call(cbind, unclass(x)[
    free_rates(if (scene$in_space == 1) "space_" else "")
  ]))
  c(list(power_w = power), stats::setNames(lapply(seq_along(flows), function(k) sums[, k]), names))
}

# The torque at each row, in its axes: a matrix of three columns.
free_torque_at <- function(scene, x) {
  n <- nrow(x)
  out <- matrix(scene$torque_n_m, n, 3, byrow = TRUE)
  if (!is.null(scene$knots)) {
    for (k in 1:3) {
      out[, k] <- out[, k] + between_knots(scene$knots$time_s, scene$knots[[k + 1L]], x$time_s)
    }
  }
  if (!is.null(scene$law) && n) {
    f <- free_law(scene$law, NULL)
    state <- do.call(cbind, unclass(x)[c("time_s", free_rates(""), quaternion_columns)])
    out <- out + t(apply(state, 1, f))
  }
  out
}

# As rot_free_between_knots() in src/core/scene/free/torque.c: 0 outside, the later value at a jump.
between_knots <- function(at, y, time_s) {
  i <- pmin(pmax(findInterval(time_s, at), 1L), length(at) - 1L)
  width <- at[i + 1L] - at[i]
  part <- ifelse(width > 0, (time_s - at[i]) / width, 1)
  value <- ifelse(part < 1, y[i] + (y[i + 1L] - y[i]) * part, y[i + 1L])
  ifelse(time_s < at[1] | time_s > at[length(at)], 0, value)
}

free_texts <- function() {
  list(scene_free = text_form(free_arguments, read_free))
}

# Those of scene_free(), of a scene with its fields.
free_arguments <- function(x) {
  upright <- identical(x$attitude0, c(1, 0, 0, 0))
  torque <- if (!is.null(x$law)) x$law$f else x$knots %||% if (any(x$torque_n_m != 0)) x$torque_n_m
  list(
    body = free_body_text(x), omega0_rad_per_s = x$omega0_rad_per_s,
    attitude0 = if (!upright) x$attitude0, torque_n_m = torque,
    torque_axes = if (x$in_space == 1) "space", damping_per_s = x$damping_per_s,
    rotors = x$rotors, breaks_s = if (length(x$breaks_s)) x$breaks_s, start_s = x$start_s
  )
}

# The body, its moments about its own axes, or those about principal axes in another attitude.
free_body_text <- function(x) {
  if (!is.null(x$body)) return(x$body)
  if (x$moment_error == 0) return(x$moment_of_inertia_kg_m2)
  new_principal(x$moment_of_inertia_kg_m2, x$axes)
}

read_free <- function(body, omega0_rad_per_s, attitude0 = NULL, torque_n_m = NULL,
                      torque_axes = "body", damping_per_s = 0, rotors = NULL, breaks_s = NULL,
                      start_s = 0) {
  keep_attitude(scene_free(
    body, omega0_rad_per_s, attitude0 = attitude0, torque_n_m = torque_n_m,
    torque_axes = torque_axes, damping_per_s = damping_per_s, rotors = rotors,
    breaks_s = breaks_s, start_s = start_s
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
