# Closed forms of a drive: those of the axle, the clutch and the rotors. Rotors joined by gears are
# one unit. With P_i, the product of all ratios before rotor i, the coordinate x = P_i theta_i makes
# every ratio 1: moments of inertia and coefficients count over P_i^2, torques over P_i.

drive_units <- function(scene) {
  kind <- vapply(scene$couplings, function(coupling) coupling$kind, double(1))
  unit <- cumsum(c(TRUE, kind != 2))
  between <- which(kind != 2)
  ratio <- scene$ratio_to_first
  coefficient <- vapply(scene$resistance, function(r) r$viscous_n_m_s, double(1))
  whole <- function(x) as.vector(rowsum(x, unit))
  list(
    n = length(unit), m = max(unit), unit = unit, kind = kind, between = between, ratio = ratio,
    inertia = whole(scene$moment_of_inertia_kg_m2 / ratio / ratio),
    viscous = whole(coefficient / ratio / ratio),
    omega = (scene$omega0_rad_per_s * ratio)[match(seq_len(max(unit)), unit)],
    torque = lapply(split(seq_along(unit), unit), function(rotors) {
      do.call(sum_torques, lapply(rotors, function(i) to_first(scene$torque[[i]], ratio[i])))
    })
  )
}

# A torque at the first shaft: over the ratio, a motor's speeds times it.
to_first <- function(torque, ratio) {
  if (inherits(torque, "rot_torque_sum")) {
    torque$laws <- lapply(torque$laws, to_first, ratio)
  } else if (inherits(torque, "rot_torque_motor")) {
    torque$stall_torque_n_m <- torque$stall_torque_n_m / ratio
    torque$no_load_omega_rad_per_s <- torque$no_load_omega_rad_per_s * ratio
  } else if (ratio != 1) {
    torque <- scale_torque(torque, 1 / ratio, NULL)
  }
  torque
}

all_loads <- function(scene, fits) {
  all(vapply(scene$rotors, function(rotor) fits(rotor$loads), NA))
}

of_time <- function(loads) {
  is.null(loads$law) && all(vapply(loads$terms, function(term) {
    term$kind %in% c("sinusoid", "exponential", "polynomial")
  }, NA))
}

stepped <- function(loads) {
  knots <- loads$knots
  apart <- which(diff(knots$time_s) > 0)
  is.null(loads$law) && !length(loads$terms) && loads$motor_n_m_s == 0 &&
    all(knots$torque_n_m[apart] == knots$torque_n_m[apart + 1L])
}

constant <- function(loads) stepped(loads) && !length(loads$knots$time_s)

# ---- the three solutions ------------------------------------------------------------------------
#
# Each: list(turned, rate: a row for each time, a column for each unit; torque: of the couplings
# between units, at the first shaft; locked; heat: of the clutch; info, events).

reduced_axle <- function(scene) {
  u <- drive_units(scene)
  scene_axle(
    u$inertia, u$torque[[1]], resistance(u$viscous), 0, u$omega, start_s = scene$start_s
  )
}

exact_model_of_axle <- function(axle, time_s) {
  table <- core_candidates("axle", axle, time_s, 1e-12)
  fits <- table$applies & table$error_kind == "bound" & vapply(table$dropped, is.null, NA)
  table$model[fits][1]
}

solve_as_axle <- function(scene, time_s, call) {
  axle <- reduced_axle(scene)
  id <- exact_model_of_axle(axle, time_s)
  result <- constraint_of(axle)$models[[id]]$run(axle, time_s, 1e-12, 1e6, call, TRUE)
  list(
    turned = cbind(result$columns$theta_rad), rate = cbind(result$columns$omega_rad_per_s),
    info = result$info
  )
}

reduced_clutch <- function(scene) {
  u <- drive_units(scene)
  coupling <- scene$couplings[[u$between]]
  capacity <- coupling$grip$loads$knots$outside[1] / abs(u$ratio[u$between])
  from <- coupling$grip$from_s
  # Rates that agree to rounding do not slip.
  alike <- abs(diff(u$omega)) <= 2 * .Machine$double.eps * abs(u$omega[1])
  if (alike) u$omega[2] <- u$omega[1]
  scene_clutch(
    u$inertia[1], u$inertia[2], capacity,
    static_capacity_n_m = coupling$grip$static_ratio * capacity, torque_1 = u$torque[[1]],
    torque_2 = u$torque[[2]], omega1_rad_per_s = u$omega[1], omega2_rad_per_s = u$omega[2],
    engage_s = if (from <= scene$start_s) -Inf else from, start_s = scene$start_s
  )
}

solve_as_clutch <- function(scene, time_s, call) {
  clutch <- reduced_clutch(scene)
  result <- constraint_of(clutch)$models$clutch_exact$run(clutch, time_s, 1e-12, 1e6, call, TRUE)
  columns <- result$columns
  engaged <- result$events$time_s >= clutch$engage_s # open, it has no events
  where <- paste("coupling", drive_units(scene)$between)
  list(
    turned = cbind(columns$theta_1_rad, columns$theta_2_rad),
    rate = cbind(columns$omega_1_rad_per_s, columns$omega_2_rad_per_s),
    torque = cbind(columns$clutch_torque_n_m), locked = columns$locked, heat = columns$heat_j,
    info = result$info,
    events = list(
      time_s = as.double(result$events$time_s[engaged]),
      event = as.character(result$events$event[engaged]), where = rep(where, sum(engaged))
    )
  )
}

# The twist of each shaft at the start, at the first shaft.
start_twist <- function(scene, u) {
  theta <- scene$theta0_rad
  vapply(u$between, function(j) {
    u$ratio[j] * (theta[j] - scene$couplings[[j]]$ratio * theta[j + 1L])
  }, double(1))
}

solve_as_rotors <- function(scene, time_s, call) {
  u <- drive_units(scene)
  of <- function(name) {
    vapply(scene$couplings[u$between], function(coupling) coupling[[name]], double(1)) /
      u$ratio[u$between]^2
  }
  start <- -cumsum(c(0, start_twist(scene, u)))
  rotors <- scene_rotors(
    u$inertia, of("stiffness_n_m_per_rad"), of("damping_n_m_s"),
    torque_n_m = vapply(u$torque, function(t) torque_loads(t)$knots$outside[1], double(1)),
    viscous_n_m_s = u$viscous, theta0_rad = start, omega0_rad_per_s = u$omega,
    start_s = scene$start_s
  )
  result <- constraint_of(rotors)$models$rotors_modal$run(rotors, time_s, 1e-12, 1e6, call, TRUE)
  rows <- function(name) matrix(result$columns[[name]], ncol = u$m, byrow = TRUE)
  list(
    turned = rows("theta_rad") - rep(start, each = length(time_s)),
    rate = rows("omega_rad_per_s"), torque = rows("shaft_torque_n_m")[, -u$m, drop = FALSE],
    info = result$info
  )
}

# ---- rows ---------------------------------------------------------------------------------------

# What acts in the rows of a solution: matrices with a row for each time, a column for each rotor or
# coupling. Inside a unit the gears carry what the rotors' own balance leaves.
drive_actions <- function(scene, u, time_s, solution) {
  n <- u$n
  over <- function(x, i) x[, u$unit[i]] / u$ratio[i]
  theta <- omega <- applied <- damping <- matrix(0, length(time_s), n)
  torque <- matrix(0, length(time_s), max(n - 1L, 0L))
  for (i in seq_len(n)) {
    theta[, i] <- scene$theta0_rad[i] + over(solution$turned, i)
    omega[, i] <- over(solution$rate, i)
    acts <- .Call(ffi_axle_torques, scene$rotors[[i]], time_s, theta[, i], omega[, i])
    applied[, i] <- acts$applied_torque_n_m
    damping[, i] <- acts$damping_torque_n_m
  }
  force <- vapply(seq_len(u$m), function(k) {
    rotors <- which(u$unit == k)
    as.vector((applied + damping)[, rotors, drop = FALSE] %*% (1 / u$ratio[rotors]))
  }, double(length(time_s)))
  dim(force) <- c(length(time_s), u$m)
  between <- solution$torque
  if (!is.null(solution$locked)) { # of the torques of the row, at a jump too
    held <- (u$inertia[2] * force[, 1] - u$inertia[1] * force[, 2]) / sum(u$inertia)
    between[solution$locked] <- held[solution$locked]
  }
  torque[, u$between] <- between * rep(u$ratio[u$between], each = length(time_s))
  ratio <- vapply(scene$couplings, function(coupling) coupling$ratio, double(1))
  into <- function(i) if (i > 1L) ratio[i - 1L] * torque[, i - 1L] else 0
  for (k in seq_len(u$m)) {
    rotors <- which(u$unit == k)
    last <- rotors[length(rotors)]
    net <- force[, k] + into(rotors[1]) / u$ratio[rotors[1]]
    if (last < n) net <- net - torque[, last] / u$ratio[last]
    for (i in rotors[-length(rotors)]) {
      alpha <- net / u$inertia[k] / u$ratio[i]
      torque[, i] <- applied[, i] + damping[, i] + into(i) -
        scene$moment_of_inertia_kg_m2[i] * alpha
    }
  }
  list(theta = theta, omega = omega, applied = applied, damping = damping, torque = torque,
       ratio = ratio)
}

# Integrals since the start, a row for each time: work, the three impulses, the heat of each rotor
# and of each coupling; with the sizes of what was added. By quadrature of the motion.
drive_integrals <- function(scene, u, solve, time_s, call) {
  rates <- function(t) {
    order <- order(t)
    at <- drive_actions(scene, u, t[order], solve(scene, t[order], call))
    n <- u$n
    slip <- at$omega[, -n, drop = FALSE] -
      at$omega[, -1L, drop = FALSE] * rep(at$ratio, each = length(t))
    damper <- vapply(scene$couplings, function(c) c$damping_n_m_s, double(1))
    heat <- slip^2 * rep(damper, each = length(t))
    if (any(u$kind == 1)) heat[, u$kind == 1] <- (slip * at$torque)[, u$kind == 1]
    cbind(
      rowSums(at$applied * at$omega), rowSums(at$applied), rowSums(at$damping),
      rowSums(at$torque * rep(at$ratio - 1, each = length(t))), -at$damping * at$omega, heat
    )[order(order), , drop = FALSE]
  }
  start <- scene$start_s
  edges <- sort(unique(c(start, time_s)))
  width <- 4L + 2L * u$n - 1L
  if (length(edges) < 2L) {
    none <- matrix(0, length(time_s), width)
    return(list(value = none, error = rep(0, width), size = rep(0, width)))
  }
  ends <- c(
    unlist(lapply(scene$rotors, axle_breaks)), unlist(lapply(scene$couplings, function(coupling) {
      coupling$grip$from_s
    })), solve(scene, edges, call)$events$time_s
  )
  inner <- ends[is.finite(ends) & ends > edges[1] & ends < edges[length(edges)]]
  all <- sort(unique(c(edges, inner)))
  # Heat and impulses of rounding are as small as that of the whole motion.
  seen <- drive_actions(scene, u, all, solve(scene, all, call))$omega
  inertia <- scene$moment_of_inertia_kg_m2
  least <- c(max(seen^2 %*% inertia), max(abs(seen) %*% inertia))[c(1, 2, 2, 2, rep(1, width - 4L))]
  least[!is.finite(least)] <- 0
  panels <- integrate_panels(rates, all[-length(all)], all[-1], least)
  total <- rbind(0, apply(panels$value, 2, cumsum))
  dim(total) <- c(length(all), width)
  total <- total - rep(total[match(start, all), ], each = length(all))
  list(
    value = total[match(time_s, all), , drop = FALSE], error = colSums(panels$error),
    size = colSums(panels$size)
  )
}

drive_exact_sums <- function(scene, solve, time_s, info, call) {
  u <- drive_units(scene)
  sums <- drive_integrals(scene, u, solve, time_s, call)
  error <- .Call(ffi_error_figure, info$errors, info$sizes) # info$error is NA once a row was edited
  off <- sums$error + (1e-14 + 3 * error) * sums$size
  rotors <- 4L + seq_len(u$n)
  couplings <- 4L + u$n + seq_len(u$n - 1L)
  # The torque of a stiff shaft may err by more than the motion.
  shafts <- vapply(scene$couplings, function(c) {
    abs(c$ratio - 1) * (1 + abs(c$ratio)) *
      (c$stiffness_n_m_per_rad * info$errors[["theta"]] + c$damping_n_m_s * info$errors[["omega"]])
  }, double(1))
  span <- diff(range(scene$start_s, time_s))
  whole <- function(at) rowSums(sums$value[, at, drop = FALSE])
  cbind(
    time_s = time_s, work_j = sums$value[, 1], resistance_j = whole(rotors), brake_j = 0,
    damper_j = whole(couplings[u$kind == 0]), clutch_j = whole(couplings[u$kind == 1]), mesh_j = 0,
    torque_impulse_n_m_s = sums$value[, 2], resistance_impulse_n_m_s = sums$value[, 3],
    housing_impulse_n_m_s = sums$value[, 4], work_error_j = off[1],
    heat_error_j = sum(off[c(rotors, couplings)]),
    impulse_error_n_m_s = sum(off[2:4]) + span * sum(shafts),
    twist_error_rad = 2 * info$errors[["theta"]]
  )
}

# ---- the models ---------------------------------------------------------------------------------

run_drive_exact <- function(scene, time_s, solve, call) {
  u <- drive_units(scene)
  solution <- solve(scene, time_s, call)
  at <- drive_actions(scene, u, time_s, solution)
  n <- u$n
  long <- function(x) as.vector(t(x))
  inertia <- rep.int(scene$moment_of_inertia_kg_m2, length(time_s))
  omega <- long(at$omega)
  heat <- matrix(0, length(time_s), n)
  behind <- matrix(0, length(time_s), n)
  lossy <- any(u$viscous != 0, vapply(scene$couplings, function(c) c$damping_n_m_s, double(1)) != 0)
  if (lossy && length(time_s)) {
    sums <- drive_integrals(scene, u, solve, time_s, call)$value
    heat <- sums[, 4L + seq_len(n), drop = FALSE]
    behind[, -n] <- sums[, 4L + n + seq_len(n - 1L)]
  }
  locked <- matrix(FALSE, length(time_s), n)
  locked[, n] <- NA
  if (!is.null(solution$locked)) {
    behind[, u$between] <- solution$heat
    locked[, u$between] <- solution$locked
  }
  behind[, n] <- NA
  columns <- list(
    time_s = rep(time_s, each = n), rotor = rep.int(seq_len(n), length(time_s)),
    theta_rad = long(at$theta), omega_rad_per_s = omega,
    angular_momentum_kg_m2_per_s = inertia * omega,
    rotational_kinetic_energy_j = 0.5 * inertia * omega^2,
    applied_torque_n_m = long(at$applied), damping_torque_n_m = 0 + long(at$damping),
    coupling_torque_n_m = long(cbind(at$torque, rep(NA_real_, length(time_s)))),
    locked = long(locked), heat_j = long(heat), coupling_heat_j = long(behind)
  )
  list(
    columns = columns, info = drive_errors(scene, u, solution$info, columns),
    events = solution$events %||%
      list(time_s = double(), event = character(), where = character())
  )
}

# Those of the coordinates over the smallest ratio; sizes are those of the rows and the start, or
# of the fastest rotor of a single unit.
drive_errors <- function(scene, u, info, columns) {
  scale <- min(abs(u$ratio))
  eps <- 4 * .Machine$double.eps
  largest <- function(x, start) max(abs(c(x, start)))
  sizes <- c(
    theta = largest(columns$theta_rad, scene$theta0_rad),
    omega = largest(columns$omega_rad_per_s, scene$omega0_rad_per_s)
  )
  if (u$m == 1L) sizes[["omega"]] <- max(sizes[["omega"]], info$sizes[["omega"]] / scale)
  info$errors <- c(
    theta = info$errors[["theta"]] / scale + eps * sizes[["theta"]],
    omega = info$errors[["omega"]] / scale + eps * sizes[["omega"]]
  )
  info$sizes <- sizes
  info$error <- .Call(ffi_error_figure, info$errors, info$sizes)
  info
}

# `solve`: one of the above. `seconds`: predicted time of a run and of a row of a rotor; the heat of
# resistance and dampers takes 15 nodes of quadrature in each interval of the rows.
drive_exact <- function(id, solve, ..., seconds) {
  list(
    id = id, ...,
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      run_drive_exact(scene, time_s, solve, call)
    },
    sums = function(scene, run, time_s) {
      drive_exact_sums(scene, solve, time_s, run$info, run$call)
    },
    ledger = function(scene, run, from_s, to_s) drive_ledger(scene, run, from_s, to_s),
    on_trial = FALSE,
    cost = function(scene, rows, accuracy) {
      lossy <- "viscous" %in% constraint_of(scene)$effects_of(scene) ||
        any(vapply(scene$couplings, function(c) c$damping_n_m_s, double(1)) > 0)
      seconds[1] + rows * length(scene$rotors) * seconds[2] * (if (lossy) 30 else 1)
    }
  )
}

drive_axle <- drive_exact(
  "drive_axle", solve_as_axle,
  equations = "sum(J/P^2) omega' = sum(tau/P) - sum(c/P^2) omega, at the first shaft",
  assumptions = "rigid gears without backlash",
  limits = "those of the axle's closed forms",
  requires = "gears alone; torques of time, motors; viscous resistance or none",
  source = "the axle's closed forms; Shigley 2004, section 16-7",
  error_kind = "bound",
  handles = c("torque", "law", "gear", "viscous"),
  why = "rigid gears: one body with a closed form",
  why_not = function(scene, time_s) {
    if (max(drive_units(scene)$unit) > 1L) return("it takes rigid gears alone")
    if (!all_loads(scene, of_time)) return("it takes torques of time, and motors")
    if (is.na(exact_model_of_axle(reduced_axle(scene), time_s))) "no closed form takes its torque"
  },
  error = function(accuracy) 2e-14,
  seconds = c(1e-6, 60e-9)
)

drive_clutch <- drive_exact(
  "drive_clutch", solve_as_clutch,
  equations = "J1 omega1' = tau1 - T, J2 omega2' = tau2 + T at the first shaft, gears in J and tau",
  assumptions = "rigid gears; capacity constant; torques constant between jumps",
  limits = "not before the start; where a torque equals the static capacity, rounding decides",
  requires = "one clutch of constant capacity; constant or stepped torques; no resistance",
  source = "closed form between exact events; Shigley 2004, chapter 16",
  error_kind = "bound",
  handles = c("torque", "law", "clutch", "gear"),
  why = "one clutch, all torques constant between events",
  why_not = function(scene, time_s) {
    u <- drive_units(scene)
    if (u$m != 2L || u$kind[u$between] != 1) return("it takes one clutch, and gears")
    grip <- scene$couplings[[u$between]]$grip
    if (!constant(grip$loads) || grip$to_s < Inf) return("it takes a constant capacity")
    if (!all_loads(scene, stepped)) return("it takes torques that are constant between jumps")
    if (length(time_s) && time_s[1] < scene$start_s) {
      "it cannot run backwards from the scene's start"
    }
  },
  error = function(accuracy) 2e-14,
  seconds = c(1e-6, 90e-9)
)

drive_modal <- drive_exact(
  "drive_modal", solve_as_rotors,
  loses = "Stiff springs turn through many radians of phase, and large terms may cancel.",
  equations = "J x'' + C x' + K x = tau at the first shaft, mean motion and twists in modes",
  assumptions = "rigid gears, linear springs and dampers, constant torques",
  limits = "constant torques; the error grows with the phase where rotors are damped unevenly",
  requires = "shafts and gears; constant torques; viscous resistance or none",
  source = "Meirovitch 2001, chapter 7; Higham 2005 (exponential of a matrix)",
  error_kind = "estimate",
  handles = c("torque", "shaft", "gear", "viscous"),
  why = "the equations are linear: solved in modes",
  why_not = function(scene, time_s) {
    u <- drive_units(scene)
    if (u$m < 2L || any(u$kind[u$between] != 0)) return("it takes elastic shafts, and gears")
    if (!all_loads(scene, constant)) "it takes constant torques"
  },
  error = function(accuracy) 1e-13,
  seconds = c(4e-6, 120e-9)
)
