# Does audit() find correct motions balanced, by an allowance that is not too large? Random scenes
# of each constraint, with torques that do work, at accuracies of 1e-3 to 1e-12.
#
#   Rscript bench/coverage/audits.R [SCENES of each class [SEED [CLASS ...]]]
#
# In one scene of four an error of 1000 times the allowance is planted: the last rate of the rows is
# changed. Ends with status 1 where a correct motion is called unbalanced, a planted error is not,
# one in five scenes fails, or the allowances of a class, over the error figure of the motion times
# the largest work or impulse of the balance, are more than 30 in the middle or 1000 at 95 in 100 (a
# body that hardly changes has more energy than that). COVERAGE_SHOW=yes prints what failed.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args)) as.integer(args[1]) else 200L
seed <- if (length(args) > 1L) as.integer(args[2]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

power <- function(lo, hi) 10^stats::runif(1, lo, hi)
either <- function(x) x * sample(c(-1, 1), length(x), TRUE)
chance <- function(p) stats::runif(1) < p
between <- function(lo, hi, n = 1L) stats::runif(n, lo, hi)

# Moments that a body has.
moments <- function() {
  x <- between(0.3, 1, 3L)
  (sum(x) - x) * power(-2, 1)
}

attitude <- function() attitude_from(c(between(-1, 1, 3L), between(0, 3)), "axis_angle")

# A torque on a body in space: constant, a table, a function; in body or space axes.
torque <- function(size, span) {
  kind <- sample(3L, 1L)
  if (kind == 1L) return(size * between(-1, 1, 3L))
  if (kind == 2L) {
    at <- sort(between(0, span, 4L))
    return(data.frame(
      time_s = at, x_n_m = size * between(-1, 1, 4L), y_n_m = size * between(-1, 1, 4L),
      z_n_m = size * between(-1, 1, 4L)
    ))
  }
  wave <- size * between(-1, 1, 3L)
  rate <- power(-0.5, 0.7)
  function(time_s) wave * sin(rate * time_s + 1:3)
}

axle_law <- function(size, span) {
  switch(sample(4L, 1L),
    torque_constant(either(size)),
    torque_sinusoid(size, power(-0.5, 1), between(-3, 3)) + torque_constant(either(size) / 3),
    local({
      rate <- power(-0.5, 0.7)
      function(time_s) size * sin(rate * time_s) + size / 2
    }),
    local({
      pull <- size * between(0.1, 1)
      function(time_s, theta_rad, omega_rad_per_s) size * cos(time_s) - pull * omega_rad_per_s
    })
  )
}

classes <- list(
  free = function() {
    i <- moments()
    omega <- between(-5, 5, 3L)
    span <- power(-0.5, 1)
    list(scene_free(
      i, omega, attitude0 = attitude(), torque = torque(max(i) * power(-1, 1.5), span),
      torque_axes = sample(c("body", "space"), 1L),
      resistance = resistance(damping_per_s = if (chance(0.3)) power(-2, 0) else 0)
    ), span)
  },
  free_rotors = function() {
    i <- moments()
    span <- power(-0.5, 1)
    axis <- between(-1, 1, 3L)
    spin <- min(i) * between(0.01, 0.2)
    list(scene_free(
      i, between(-3, 3, 3L), attitude0 = attitude(),
      torque = if (chance(0.5)) torque(max(i) * power(-1, 0.7), span),
      rotors = rotor(axis, spin, between(-20, 20), torque = spin * between(-5, 5))
    ), span)
  },
  pivot = function() {
    i <- moments()
    span <- power(-0.5, 1)
    list(scene_pivot(
      i, between(-5, 5, 3L), mass_kg = max(i) * power(-0.5, 0.5),
      centre_m = between(-0.5, 0.5, 3L), attitude0 = attitude(),
      torque = if (chance(0.6)) torque(max(i) * power(-1, 1), span),
      resistance = resistance(damping_per_s = if (chance(0.3)) power(-2, 0) else 0)
    ), span)
  },
  axle = function() {
    i <- power(-2, 1)
    span <- power(-0.5, 1.3)
    r <- resistance(
      viscous = if (chance(0.6)) i * power(-1.5, 0.3) else 0,
      quadratic = if (chance(0.5)) i * power(-1.5, 0) else 0,
      coulomb = if (chance(0.4)) i * power(-1.5, 0) else 0
    )
    list(scene_axle(
      i, axle_law(i * power(-0.5, 1), span), r, theta0_rad = between(-2, 2),
      omega0_rad_per_s = either(power(-1, 1))
    ), span)
  },
  rotors = function() {
    n <- sample(2:4, 1L)
    i <- vapply(seq_len(n), function(k) power(-1.5, 1), 0)
    list(scene_rotors(
      i, i[-n] * vapply(seq_len(n - 1L), function(k) power(0, 3), 0),
      damping_n_m_s = if (chance(0.5)) i[-n] * power(-2, 0.3) else 0 * i[-n],
      torque = i * between(-3, 3, n), resistance = i * between(0, 0.5, n),
      omega0_rad_per_s = between(-5, 5, n)
    ), power(-1, 2))
  },
  clutch = function() {
    i <- vapply(1:2, function(k) power(-1, 1), 0)
    list(scene_clutch(
      i[1], i[2], capacity_n_m = min(i) * power(0, 1),
      torque = list(if (chance(0.5)) i[1] * between(-3, 3), NULL),
      omega0_rad_per_s = c(either(power(0, 1.3)), between(-3, 3))
    ), power(-0.5, 1))
  },
  drive = function() {
    n <- sample(2:3, 1L)
    i <- vapply(seq_len(n), function(k) power(-1, 0.7), 0)
    span <- power(-0.5, 1)
    list(scene_drive(
      i, lapply(seq_len(n - 1L), function(k) {
        switch(sample(3L, 1L), coupling_gear(either(between(0.4, 2.5))),
               coupling_shaft(i[k] * power(0, 2), i[k] * power(-2, 0)),
               coupling_clutch(i[k] * power(0, 1)))
      }),
      torque = lapply(i, function(one) axle_law(one * power(-0.5, 0.7), span)),
      resistance = lapply(i, function(one) resistance(one * between(0, 0.5))),
      omega0_rad_per_s = rep(0, n)
    ), span)
  },
  incline = function() {
    radius <- power(-1.5, 0)
    body <- list(body_sphere, body_disk, body_hoop)[[sample.int(3L, 1L)]](power(-1, 1), radius)
    list(scene_incline(
      body, between(5, 70), static_friction = power(-1.5, 0.3), v0_m_per_s = either(power(-0.5, 1)),
      omega0_rad_per_s = either(power(-0.5, 1)) / radius
    ), power(-0.5, 1))
  }
)

# The motion with its last rate off by so much that one balance is off by 1000 times its allowance:
# "none" where no balance has that rate, else whether that balance is called unbalanced.
planted <- function(motion, out) {
  rate <- grep("^omega_.*rad_per_s$|^omega_rad_per_s$|^v_m_per_s$", names(motion), value = TRUE)
  rate <- rate[sample.int(length(rate), 1L)]
  last <- nrow(motion)
  residual_of <- function(off) {
    motion[[rate]][last] <- motion[[rate]][last] + off
    audit(motion)
  }
  x <- motion[[rate]][last]
  small <- 1e-3 * max(abs(motion[[rate]])) * if (x < 0) -1 else 1
  moved <- abs(residual_of(small)$residual - out$residual)
  able <- which(out$rounding > 0 & out$verdict %in% "balanced" & moved > 0 & out$unit != "1")
  if (!length(able)) return("none")
  i <- able[sample.int(length(able), 1L)]
  again <- residual_of(small * 1000 * out$rounding[i] / moved[i])
  if (!(abs(again$residual[i] - out$residual[i]) > 100 * out$rounding[i])) return("none")
  if (again$verdict[i] %in% "unbalanced") "found" else sprintf(
    "%s in %s: residual %.2g, allowed %.2g, before %.2g", rate, out$balance[i], again$residual[i],
    again$rounding[i], out$rounding[i]
  )
}

if (length(args) > 2L) classes <- classes[args[-(1:2)]]
worst <- 0L
for (name in names(classes)) {
  called <- failed <- audits <- plants <- passed <- 0L
  closest <- 0
  ratios <- 0
  for (k in seq_len(scenes)) {
    drawn <- tryCatch(classes[[name]](), rotdyn_error = function(e) e)
    accuracy <- power(-12, -3)
    motion <- if (inherits(drawn, "error")) drawn else tryCatch(
      suppressWarnings(
        trajectory(drawn[[1]], c(0, sort(between(0, drawn[[2]], 3L)), drawn[[2]]), accuracy)
      ),
      rotdyn_error = function(e) e
    )
    if (inherits(motion, "error")) {
      failed <- failed + 1L
      if (nzchar(Sys.getenv("COVERAGE_SHOW"))) cat(name, k, conditionMessage(motion)[1], "\n")
      next
    }
    out <- audit(motion)
    audits <- audits + 1L
    bad <- out$verdict %in% "unbalanced"
    called <- called + any(bad)
    if (any(bad)) {
      cat(sprintf("unbalanced: %s, scene %d, %s at %.1e: residual %.2g, allowed %.2g\n", name, k,
                  out$balance[bad], accuracy, out$residual[bad], out$rounding[bad]), sep = "")
    }
    if (k %% 4L == 0L && !any(bad)) {
      found <- planted(motion, out)
      plants <- plants + (found != "none")
      if (!found %in% c("none", "found")) {
        passed <- passed + 1L
        cat(sprintf("error not found: %s, scene %d at %.1e, %s\n", name, k, accuracy, found))
      }
    }
    ok <- out$rounding > 0 & out$residual != 0
    closest <- max(closest, abs(out$residual[ok]) / out$rounding[ok], na.rm = TRUE)
    # The allowance beside the largest terms of its unit, times the figure and some roundings.
    size <- vapply(out$terms, function(terms) sum(abs(terms$value)), 0)
    size <- unname(tapply(size, out$unit, max)[out$unit])
    figure <- glance(motion)$error + 1e-14
    real <- is.finite(size) & size > 1e-3 * max(size, na.rm = TRUE) & out$unit != "1"
    ratios <- c(ratios, (out$rounding / (size * figure))[real])
  }
  cat(sprintf(paste(
    "%-12s %d of %d correct motions unbalanced; residual at most %.2f of what is allowed, which is",
    "%.2g of the figure in the middle, %.2g at 95 %%; %d failed; %d of %d planted errors found\n"
  ), name, called, audits, closest, stats::median(ratios, na.rm = TRUE),
  stats::quantile(ratios, 0.95, na.rm = TRUE), failed, plants - passed,
  plants))
  worst <- worst + called + passed + (audits < 0.8 * scenes) +
    (stats::median(ratios, na.rm = TRUE) > 30) +
    (stats::quantile(ratios, 0.95, na.rm = TRUE) > 1000)
}
cat("audits, seed ", seed, ": ", if (worst) "FAILED" else "ok", "\n", sep = "")
quit(status = as.integer(worst > 0))
