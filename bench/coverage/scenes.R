# Do the reported errors cover the true ones in gears, drives, rotors, dry friction, inclines, long
# spans and short pulses? Random scenes of each class, judged by chains.c in quadruple precision.
#
#   Rscript bench/coverage/scenes.R PROGRAM [SCENES of each class [SEED [CLASS ...]]]
#
# A miss: the true error of a measure exceeds the figure. A silent miss: by more than ten times the
# figure and ten times the accuracy asked, without a warning. Ends with status 1 where a class has a
# miss of a bound, more than 5 in 100 of its estimates miss, a miss is silent, or a scene fails.
# COVERAGE_SHOW=yes prints the misses; COVERAGE_KEEP=FILE saves them.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args) > 1L) as.integer(args[2]) else 200L
seed <- if (length(args) > 2L) as.integer(args[3]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

power <- function(lo, hi) 10^stats::runif(1, lo, hi)
either <- function(x) x * sample(c(-1, 1), length(x), TRUE)
chance <- function(p) stats::runif(1) < p
between <- function(lo, hi) stats::runif(1, lo, hi)

# ---- a scene as chains.c reads it ---------------------------------------------------------------

rotor_line <- function(
  inertia, theta0 = 0, omega0 = 0, viscous = 0, quadratic = 0, sliding = 0, holding = sliding,
  stiffness = 0, rest = 0, gravity = c(0, 0, 0), constant = 0, amplitude = 0, frequency = 1,
  phase = 0, brake = 0, brake_ratio = 1, from = -Inf, to = Inf, pulses = NULL
) {
  c(
    inertia, theta0, omega0, viscous, quadratic, sliding, holding, stiffness, rest, gravity,
    constant, amplitude, frequency, phase, brake, brake_ratio, from, to, length(pulses) / 3, pulses
  )
}

coupling_line <- function(kind, ratio = 1, stiffness = 0, damping = 0, capacity = 0,
                          capacity_ratio = 1, from = -Inf, to = Inf, efficiency = 1) {
  c(kind, ratio, stiffness, damping, capacity, capacity_ratio, from, to, efficiency)
}

chain_line <- function(start, rotors, couplings, rows, degrees = NaN) {
  x <- c(
    start, length(rotors), degrees, unlist(rotors), unlist(couplings), length(rows), rows
  )
  paste(sprintf("%.17g", x), collapse = " ")
}

truths <- function(program, lines) {
  lapply(system2(program, input = lines, stdout = TRUE), function(line) {
    x <- scan(text = line, quiet = TRUE)
    if (length(x)) matrix(x, ncol = 4, byrow = TRUE) # theta, what it lacks, omega, what it lacks
  })
}

# Rows in time after the start.
rows_of <- function(start, span, n = 12L) start + c(0, sort(stats::runif(n, 0, span)))

# What acts on one rotor, as the package takes it and as the line says it.
driven <- function(inertia, span, sinusoid = 0.6, pulses = 0) {
  size <- inertia * power(-0.5, 1)
  constant <- if (chance(0.6)) either(size) else 0
  amplitude <- if (chance(sinusoid)) size * power(-0.5, 0.7) else 0
  frequency <- power(-0.5, 1)
  phase <- between(-3, 3)
  law <- torque_constant(constant)
  if (amplitude != 0) law <- law + torque_sinusoid(amplitude, frequency, phase)
  list(
    law = law, size = size, constant = constant, amplitude = amplitude, frequency = frequency,
    phase = phase
  )
}

# ---- classes ------------------------------------------------------------------------------------

classes <- list(
  gears = function() {
    n <- sample(2:4, 1L)
    inertia <- vapply(seq_len(n), function(i) power(-2, 1), 0)
    ratios <- either(vapply(seq_len(n - 1L), function(i) power(-0.7, 0.7), 0))
    efficiency <- if (chance(0.8)) stats::runif(n - 1L, 0.6, 1) else rep(1, n - 1L)
    over <- cumprod(c(1, ratios))
    whole <- sum(inertia / over^2)
    torque <- either(whole * vapply(seq_len(n), function(i) power(-1, 0.7), 0) * abs(over))
    torque[stats::runif(n) < 0.3] <- 0
    viscous <- if (chance(0.5)) inertia * power(-2, 0.3) else rep(0, n)
    omega0 <- if (chance(0.8)) either(power(-1, 1)) else 0
    theta0 <- either(power(-1, 0.5))
    start <- if (chance(0.5)) 0 else either(power(-1, 2))
    rows <- rows_of(start, power(-1, 1.3))
    rotors <- lapply(seq_len(n), function(i) {
      rotor_line(
        inertia[i], if (i == 1L) theta0 else 0, if (i == 1L) omega0 else 0, viscous[i],
        constant = torque[i]
      )
    })
    list(
      scene = scene_gears(
        inertia, ratios, efficiency = efficiency, torque = torque, resistance = viscous,
        theta0_rad = theta0, omega0_rad_per_s = omega0, start_s = start
      ),
      line = chain_line(start, rotors, lapply(seq_len(n - 1L), function(i) {
        coupling_line(2, ratios[i], efficiency = efficiency[i])
      }), rows),
      rows = rows, shown = 1L
    )
  },

  # Shafts and gears under torques of time: no contact.
  drive = function() {
    n <- sample(2:4, 1L)
    inertia <- vapply(seq_len(n), function(i) power(-1.5, 0.7), 0)
    geared <- stats::runif(n - 1L) < 0.4
    ratio <- ifelse(stats::runif(n - 1L) < 0.5, 1, either(stats::runif(n - 1L, 0.3, 3)))
    over <- cumprod(c(1, ratio))
    start <- if (chance(0.5)) 0 else either(power(-1, 2))
    span <- power(-1, 0.9)
    rows <- rows_of(start, span)
    acts <- lapply(inertia, driven, span)
    viscous <- if (chance(0.7)) inertia * stats::runif(n, 0, 1) else rep(0, n)
    quadratic <- if (chance(0.3)) inertia * stats::runif(n, 0, 0.3) else rep(0, n)
    omega <- either(vapply(seq_len(n), function(i) power(-1, 0.7), 0))
    for (i in which(geared)) omega[i + 1L] <- omega[i] / ratio[i]
    theta <- stats::runif(n, -1, 1)
    stiffness <- vapply(seq_len(n - 1L), function(i) inertia[i] * power(0, 2.5), 0)
    damping <- if (chance(0.6)) stiffness * power(-3, -1) else 0 * stiffness
    list(
      scene = scene_drive(
        inertia, lapply(seq_len(n - 1L), function(i) {
          if (geared[i]) coupling_gear(ratio[i]) else
            coupling_shaft(stiffness[i], damping[i], ratio[i])
        }),
        torque = lapply(acts, `[[`, "law"),
        resistance = lapply(seq_len(n), function(i) resistance(viscous[i], quadratic[i])),
        theta0_rad = theta, omega0_rad_per_s = omega, start_s = start
      ),
      line = chain_line(start, lapply(seq_len(n), function(i) {
        a <- acts[[i]]
        rotor_line(
          inertia[i], theta[i], omega[i], viscous[i], quadratic[i], constant = a$constant,
          amplitude = a$amplitude, frequency = a$frequency, phase = a$phase
        )
      }), lapply(seq_len(n - 1L), function(i) {
        if (geared[i]) coupling_line(2, ratio[i]) else
          coupling_line(0, ratio[i], stiffness[i], damping[i])
      }), rows),
      rows = rows, shown = seq_len(n)
    )
  },

  # A clutch, a brake, dry friction: no two that hold the same.
  drive_friction = function() {
    n <- sample(2:3, 1L)
    inertia <- vapply(seq_len(n), function(i) power(-1, 0.7), 0)
    kind <- sample(0:2, n - 1L, TRUE, c(0.3, 0.5, 0.2))
    ratio <- ifelse(stats::runif(n - 1L) < 0.5, 1, either(stats::runif(n - 1L, 0.4, 2.5)))
    start <- if (chance(0.6)) 0 else either(power(-1, 1))
    span <- power(-0.3, 1)
    rows <- rows_of(start, span)
    acts <- lapply(inertia, driven, span)
    omega <- ifelse(stats::runif(n) < 0.3, 0, either(stats::runif(n, 0.3, 5)))
    for (i in which(kind == 2)) omega[i + 1L] <- omega[i] / ratio[i]
    theta <- stats::runif(n, -1, 1)
    stiffness <- inertia[-n] * power(0, 2)
    damping <- if (chance(0.5)) stiffness * power(-3, -1) else 0 * stiffness
    # Units joined by a clutch: friction to ground on one of them.
    unit <- cumsum(c(1L, kind != 2))
    group <- cumsum(c(1L, kind == 0))
    grounded <- tapply(seq_len(n), group, function(of) of[sample.int(length(of), 1L)])
    dry <- seq_len(n) %in% grounded & stats::runif(n) < 0.7
    brakes <- seq_len(n) %in% grounded & stats::runif(n) < 0.4
    size <- vapply(acts, `[[`, 0, "size")
    sliding <- ifelse(dry, size * stats::runif(n, 0.1, 2), 0)
    holding <- sliding * ifelse(stats::runif(n) < 0.5, 1, stats::runif(n, 1, 1.5))
    brake_n_m <- ifelse(brakes, size * stats::runif(n, 0.2, 3), 0)
    brake_ratio <- stats::runif(n, 1, 1.4)
    brake_from <- start + span * stats::runif(n, -0.3, 0.6)
    brake_to <- brake_from + span * stats::runif(n, 0.1, 0.6)
    capacity <- size[-n] * stats::runif(n - 1L, 0.3, 4)
    capacity_ratio <- ifelse(stats::runif(n - 1L) < 0.5, 1, stats::runif(n - 1L, 1, 1.5))
    engages <- ifelse(stats::runif(n - 1L) < 0.5, -Inf, start + span * stats::runif(n - 1L, 0, 0.4))
    viscous <- if (chance(0.6)) inertia * stats::runif(n, 0, 0.5) else rep(0, n)
    list(
      scene = scene_drive(
        inertia, lapply(seq_len(n - 1L), function(i) {
          switch(kind[i] + 1L,
            coupling_shaft(stiffness[i], damping[i], ratio[i]),
            coupling_clutch(
              capacity[i], static_ratio = capacity_ratio[i], ratio = ratio[i], from_s = engages[i]
            ),
            coupling_gear(ratio[i])
          )
        }),
        torque = lapply(acts, `[[`, "law"),
        resistance = lapply(seq_len(n), function(i) {
          resistance(viscous[i], 0, sliding[i], holding[i])
        }),
        brake = lapply(seq_len(n), function(i) {
          if (brakes[i]) brake(
            brake_n_m[i], static_ratio = brake_ratio[i], from_s = brake_from[i], to_s = brake_to[i]
          )
        }),
        theta0_rad = theta, omega0_rad_per_s = omega, start_s = start
      ),
      line = chain_line(start, lapply(seq_len(n), function(i) {
        a <- acts[[i]]
        rotor_line(
          inertia[i], theta[i], omega[i], viscous[i], 0, sliding[i], holding[i],
          constant = a$constant, amplitude = a$amplitude, frequency = a$frequency, phase = a$phase,
          brake = brake_n_m[i], brake_ratio = brake_ratio[i], from = brake_from[i],
          to = brake_to[i]
        )
      }), lapply(seq_len(n - 1L), function(i) {
        switch(kind[i] + 1L,
          coupling_line(0, ratio[i], stiffness[i], damping[i]),
          coupling_line(1, ratio[i], 0, 0, capacity[i], capacity_ratio[i], engages[i]),
          coupling_line(2, ratio[i])
        )
      }), rows),
      rows = rows, shown = seq_len(n)
    )
  },

  rotors = function() {
    n <- sample(2:4, 1L)
    inertia <- vapply(seq_len(n), function(i) power(-1.5, 1), 0)
    stiffness <- vapply(seq_len(n - 1L), function(i) inertia[i] * power(0, 4), 0)
    damping <- if (chance(0.5)) stiffness * power(-4, -1) else 0 * stiffness
    viscous <- if (chance(0.5)) inertia * stats::runif(n, 0, 0.5) else rep(0, n)
    torque <- if (chance(0.6)) either(inertia * stats::runif(n, 0, 3)) else rep(0, n)
    start <- either(power(-2, 3))
    theta <- stats::runif(n, -1, 1)
    omega <- either(stats::runif(n, 0, 5))
    rows <- rows_of(start, power(-1, 5))
    list(
      scene = scene_rotors(
        inertia, stiffness, damping, torque = torque, resistance = viscous, theta0_rad = theta,
        omega0_rad_per_s = omega, start_s = start
      ),
      line = chain_line(start, lapply(seq_len(n), function(i) {
        rotor_line(inertia[i], theta[i], omega[i], viscous[i], constant = torque[i])
      }), lapply(seq_len(n - 1L), function(i) {
        coupling_line(0, 1, stiffness[i], damping[i])
      }), rows),
      rows = rows, shown = seq_len(n)
    )
  },

  # An axle with dry friction: held at first, sliding, or sticking at each turn.
  friction = function() {
    inertia <- power(-1, 1)
    span <- power(-0.3, 1.5)
    a <- driven(inertia, span, sinusoid = 1)
    level <- abs(a$constant) + abs(a$amplitude)
    coulomb <- level * power(-1.5, 0.1)
    holding <- coulomb * if (chance(0.5)) 1 else between(1, 1.5)
    viscous <- if (chance(0.5)) inertia * power(-2, 0) else 0
    quadratic <- if (chance(0.4)) inertia * power(-2, -0.3) else 0
    gravity <- if (chance(0.3)) c(inertia * power(-0.5, 1), between(0.1, 1), 9.80665) else
      c(0, 0, 0)
    theta <- between(-1, 1)
    omega <- if (chance(0.4)) 0 else either(power(-1, 0.7))
    start <- if (chance(0.5)) 0 else either(power(-1, 1))
    rows <- rows_of(start, span)
    law <- a$law
    if (gravity[1] > 0) law <- law + torque_gravity(gravity[1], gravity[2])
    list(
      scene = scene_axle(
        inertia, law, resistance(viscous, quadratic, coulomb, holding), theta0_rad = theta,
        omega0_rad_per_s = omega, start_s = start
      ),
      line = chain_line(start, list(rotor_line(
        inertia, theta, omega, viscous, quadratic, coulomb, holding, gravity = gravity,
        constant = a$constant, amplitude = a$amplitude, frequency = a$frequency, phase = a$phase
      )), NULL, rows),
      rows = rows, shown = 1L
    )
  },

  incline = function() {
    mass <- power(-1, 1)
    radius <- round(2^20 * power(-1.5, 0)) * 2^-20
    body <- list(body_sphere, body_disk, body_hoop)[[sample.int(3L, 1L)]](mass, radius)
    angle <- if (chance(0.1)) 0 else either(stats::runif(1, 0, 85))
    static <- power(-1.5, 0.3)
    kinetic <- static * if (chance(0.5)) 1 else between(0.3, 1)
    arm <- if (chance(0.5)) radius * power(-3, -0.5) else 0
    # A start that rolls without rounding: v = R omega is a double.
    omega0 <- if (chance(0.3)) 0 else either(round(2^20 * power(-0.5, 1) / radius) * 2^-20)
    v0 <- if (chance(0.4)) radius * omega0 else if (chance(0.3)) 0 else either(power(-0.5, 1))
    start <- if (chance(0.5)) 0 else either(power(-1, 2))
    rows <- rows_of(start, power(-1, 1))
    gravity <- if (chance(0.7)) 9.80665 else power(0, 1.3)
    x0 <- between(-1, 1)
    theta0 <- between(-1, 1)
    scene <- scene_incline(
      body, angle, static_friction = static, kinetic_friction = kinetic, rolling_arm_m = arm,
      v0_m_per_s = v0, omega0_rad_per_s = omega0, x0_m = x0, theta0_rad = theta0,
      gravity_m_per_s2 = gravity, start_s = start
    )
    list(
      scene = scene,
      line = chain_line(start, list(
        rotor_line(scene$mass_kg, x0, v0, amplitude = gravity),
        rotor_line(
          scene$moment_of_inertia_kg_m2, theta0, omega0, sliding = arm
        )
      ), list(coupling_line(1, scene$radius_m, 0, 0, kinetic, static)), rows, angle),
      rows = rows, shown = 1:2
    )
  },

  # Pendulums, oscillators and driven axles over thousands to millions of seconds.
  long = function() {
    inertia <- power(-1, 1)
    start <- if (chance(0.5)) 0 else either(power(-1, 3))
    rows <- rows_of(start, power(2, 7))
    theta <- between(-2, 2)
    omega <- either(power(-1, 0.7))
    kind <- sample.int(3L, 1L)
    if (kind == 1L) {
      gravity <- c(power(-1, 1), power(-1, 0.3), 9.80665)
      inertia <- gravity[1] * gravity[2]^2 * between(1, 3)
      if (chance(0.3)) omega <- either(power(-1, 0.5)) * 2 * sqrt(prod(gravity) / inertia)
      rest <- if (chance(0.5)) 0 else between(-2, 2)
      law <- torque_gravity(gravity[1], gravity[2], rest)
      line <- rotor_line(inertia, theta, omega, rest = rest, gravity = gravity)
      viscous <- 0
    } else {
      a <- driven(inertia, 1)
      stiffness <- if (kind == 2L) inertia * power(-1, 1.5) else 0
      rest <- if (chance(0.5)) 0 else between(-1, 1)
      viscous <- if (chance(0.7)) inertia * power(-6, 1) else 0
      law <- a$law
      if (kind == 2L) law <- law + torque_spring(stiffness, rest)
      line <- rotor_line(
        inertia, theta, omega, viscous, stiffness = stiffness, rest = rest, constant = a$constant,
        amplitude = a$amplitude, frequency = a$frequency, phase = a$phase
      )
    }
    list(
      scene = scene_axle(
        inertia, law, resistance(viscous), theta0_rad = theta, omega0_rad_per_s = omega,
        start_s = start
      ),
      line = chain_line(start, list(line), NULL, rows), rows = rows, shown = 1L
    )
  },

  # Rows inside and around short pulses, none in the unit of time in which the end is rounded.
  pulse = function() {
    inertia <- power(-1, 1)
    n <- sample(1:3, 1L)
    start <- if (chance(0.7)) 0 else either(power(-1, 2))
    from <- start + sort(vapply(seq_len(n), function(i) power(-1, 4), 0))
    lasts <- vapply(seq_len(n), function(i) power(-6, -0.5), 0)
    level <- either(inertia * vapply(seq_len(n), function(i) power(-0.5, 1), 0) / lasts)
    theta <- between(-1, 1)
    omega <- if (chance(0.3)) 0 else either(power(-1, 0.5))
    rows <- sort(c(start, from[1] + lasts[1] * stats::runif(5), from[n] + lasts[n] * c(0.5, 1.5),
                   start + 2 * (from - start)))
    viscous <- if (chance(0.6)) inertia * power(-5, 0) else 0
    kind <- sample.int(4L, 1L)
    quadratic <- if (kind == 2L) inertia * power(-4, -1) else 0
    coulomb <- if (kind == 3L) inertia * power(-2, 0.5) else 0
    stiffness <- if (kind == 4L) inertia * power(-1, 1) else 0
    law <- torque_pulse(from, lasts, level)
    if (stiffness > 0) law <- law + torque_spring(stiffness)
    pulses <- as.vector(rbind(from, lasts, level))
    list(
      scene = scene_axle(
        inertia, law, resistance(viscous, quadratic, coulomb), theta0_rad = theta,
        omega0_rad_per_s = omega, start_s = start
      ),
      line = chain_line(start, list(rotor_line(
        inertia, theta, omega, viscous, quadratic, coulomb, stiffness = stiffness, pulses = pulses
      )), NULL, rows),
      rows = rows, shown = 1L
    )
  },

  clutch = function() {
    inertia <- c(power(-1, 1), power(-1, 1))
    start <- if (chance(0.5)) 0 else either(power(-1, 2))
    span <- power(-1, 1.3)
    size <- min(inertia) * power(-0.3, 1)
    capacity <- size * between(0.3, 3)
    static <- capacity * if (chance(0.5)) 1 else between(1, 1.5)
    engage <- if (chance(0.5)) -Inf else start + span * between(0, 0.5)
    omega <- either(stats::runif(2, 0, 5))
    theta <- stats::runif(2, -1, 1)
    n <- sample.int(3L, 1L)
    at <- round(2^24 * (start + span * sort(stats::runif(n + 1L)))) * 2^-24 # exact differences
    level <- either(size * stats::runif(n, 0, 3))
    torque_2 <- either(size * between(0, 2))
    rows <- rows_of(start, span)
    law <- torque_steps(at, c(level, 0))
    # The lengths of the steps are those of their rounded ends: in two parts each.
    line <- unlist(lapply(seq_len(n), function(i) c(at[i], at[i + 1L] - at[i], level[i])))
    exact <- all((at[-1] - at[-(n + 1L)]) + at[-(n + 1L)] == at[-1])
    if (!exact) return(classes$clutch())
    list(
      scene = scene_clutch(
        inertia[1], inertia[2], capacity, static_capacity_n_m = static,
        torque = list(law, torque_2), omega0_rad_per_s = c(omega[1], omega[2]),
        theta0_rad = c(theta[1], theta[2]), engage_s = engage, start_s = start
      ),
      line = chain_line(start, list(
        rotor_line(inertia[1], theta[1], omega[1], pulses = line),
        rotor_line(inertia[2], theta[2], omega[2], constant = torque_2)
      ), list(coupling_line(1, 1, 0, 0, capacity, static / capacity, engage)), rows),
      rows = rows, shown = 1:2
    )
  }
)

# ---- judging ------------------------------------------------------------------------------------

# States by measure: a matrix with a row for each time, a column for each rotor.
states_of <- function(motion, shown) {
  if ("event" %in% names(motion)) motion <- motion[is.na(motion$event), ] # rows that were asked for
  n <- length(shown)
  by_rotor <- function(x) matrix(x, ncol = n, byrow = TRUE)
  if ("x_m" %in% names(motion)) {
    list(
      x = cbind(motion$x_m), v = cbind(motion$v_m_per_s), theta = cbind(motion$theta_rad),
      omega = cbind(motion$omega_rad_per_s)
    )
  } else if ("theta_1_rad" %in% names(motion)) {
    list(
      theta = cbind(motion$theta_1_rad, motion$theta_2_rad),
      omega = cbind(motion$omega_1_rad_per_s, motion$omega_2_rad_per_s)
    )
  } else {
    list(theta = by_rotor(motion$theta_rad), omega = by_rotor(motion$omega_rad_per_s))
  }
}

# Truth has a row for each time and rotor of the chain.
truth_of <- function(truth, n, shown, measures) {
  part <- function(i, at) matrix(truth[, at], ncol = n, byrow = TRUE)[, i, drop = FALSE]
  both <- function(i, at) list(high = part(i, at), low = part(i, at + 1L))
  if ("x" %in% measures) {
    return(list(x = both(1L, 1L), v = both(1L, 3L), theta = both(2L, 1L), omega = both(2L, 3L)))
  }
  list(theta = both(shown, 1L), omega = both(shown, 3L))
}

judge <- function(sample, truth, accuracy) {
  warned <- FALSE
  motion <- tryCatch(
    withCallingHandlers(
      trajectory(sample$scene, sample$rows, accuracy, max_steps = 1e7),
      warning = function(w) {
        warned <<- TRUE
        invokeRestart("muffleWarning")
      }
    ),
    error = identity
  )
  if (inherits(motion, "error")) {
    return(list(failed = conditionMessage(motion), kind = "none", model = "none"))
  }
  run <- attr(motion, "run")
  states <- states_of(motion, sample$shown)
  n <- nrow(truth) / length(sample$rows)
  true <- truth_of(truth, n, sample$shown, names(states))
  off <- vapply(names(states), function(name) {
    max(abs((states[[name]] - true[[name]]$high) - true[[name]]$low))
  }, 0)
  size <- vapply(true, function(x) max(abs(x$high)), 0)
  off[] <- pmax(0, off - 1e-24 - 1e-22 * size) # less that of the truth
  said <- run$info$errors[names(states)]
  list(
    failed = NULL, kind = run$error_kind, model = run$model, held = all(off <= said),
    silent = !warned && any(off > 10 * said & off > 10 * accuracy * size),
    off = off, said = said, ratio = max(ifelse(off > 0, off / said, 0))
  )
}

if (!interactive() && length(args)) {
  bad <- FALSE
  judged <- silent <- without <- 0L
  kept <- list()
  wanted <- if (length(args) > 3L) args[-(1:3)] else names(classes)
  for (name in wanted) {
    samples <- lapply(seq_len(scenes), function(i) c(classes[[name]](), accuracy = power(-12, -3)))
    truth <- truths(args[1], vapply(samples, `[[`, "", "line"))
    verdicts <- Map(function(sample, truth) {
      if (!is.null(truth)) judge(sample, truth, sample$accuracy)
    }, samples, truth)
    has <- !vapply(verdicts, is.null, NA)
    without <- without + sum(!has)
    failed <- vapply(verdicts[has], function(v) !is.null(v$failed), NA)
    if (any(failed)) {
      bad <- TRUE
      for (i in which(has)[failed]) cat(name, i, "failed:", verdicts[[i]]$failed, "\n")
    }
    good <- which(has)[!failed]
    judged <- judged + length(good)
    of <- function(what, mode) vapply(verdicts[good], `[[`, mode, what)
    kind <- of("kind", "")
    for (this in sort(unique(kind))) {
      at <- good[kind == this]
      held <- of("held", NA)[kind == this]
      ratio <- of("ratio", 0)[kind == this]
      quiet <- of("silent", NA)[kind == this]
      cat(sprintf(
        paste0(
          "%-15s %-8s %5d scenes, covered %6.2f %%, silent %d; ",
          "true/reported: median %.2g, worst %.3g\n"
        ),
        name, this, length(at), 100 * mean(held), sum(quiet), stats::median(ratio), max(ratio)
      ))
      silent <- silent + sum(quiet)
      allowed <- if (this == "bound") 0 else max(1, 0.05 * length(at)) # one is no share of a few
      bad <- bad || any(quiet) || sum(!held) > allowed
      for (i in at[!held]) {
        v <- verdicts[[i]]
        kept <- c(kept, list(c(samples[[i]], v, class = name)))
        if (nzchar(Sys.getenv("COVERAGE_SHOW"))) {
          cat(sprintf(
            "  %s %d, %s, accuracy %.1e: %s%s\n", name, i, v$model, samples[[i]]$accuracy,
            paste0(names(v$off), " ", signif(v$off, 3), " of ", signif(v$said, 3), collapse = ", "),
            if (v$silent) " SILENT" else ""
          ))
        }
      }
    }
    if (!all(has)) cat(sprintf("%-15s %5d scenes without a truth\n", name, sum(!has)))
  }
  cat(sprintf(
    "scenes: %d judged, %d silent, %d without a truth; seed %d\n", judged, silent, without, seed
  ))
  if (nzchar(Sys.getenv("COVERAGE_KEEP"))) saveRDS(kept, Sys.getenv("COVERAGE_KEEP"))
  quit(status = as.integer(bad))
}
