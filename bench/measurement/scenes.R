# Coverage of the intervals of fit_scene(): simulated records of every constraint, events inside
# them, three kinds of noise.
#
#   Rscript bench/measurement/scenes.R [records] [seed]
#
# A line for each experiment: the share of intervals at 68 and 95 % that hold the true value, the
# records whose law was called incomplete though it is not, and what failed. Intervals may be too
# wide where the print says so. Over all: 68 % within 60 to 76, 95 % within 91 to 98.5. Where a
# record does not determine an unknown each fit must say so and claim no interval. With few records
# an experiment alone is judged by four standard errors of its share.

library(rotdyn)
arguments <- commandArgs(TRUE)
records <- if (length(arguments) > 0L) as.integer(arguments[1]) else 25L
seed <- if (length(arguments) > 1L) as.integer(arguments[2]) else 20261L
# One of n parts of the experiments, for several processes: PART=1 PARTS=2.
part <- as.integer(Sys.getenv("PART", "1"))
parts <- as.integer(Sys.getenv("PARTS", "1"))

ball <- body_sphere(6, 0.108)
rates <- paste0("omega_", c("x", "y", "z"), "_rad_per_s")
experiment <- function(scene, unknown, truth, guess, observed, end, n, sigma, counts = NULL,
                       determined = TRUE) {
  list(scene = scene, unknown = unknown, truth = truth, guess = guess, observed = observed,
       end = end, n = n, sigma = sigma, counts = counts, determined = determined)
}
path <- function(name, i) paste0(name, "[", i, "]")

experiments <- list(
  "axle, stop inside" = experiment(
    function(p) scene_axle(0.5, resistance = resistance(coulomb_n_m = p[1]),
                           omega0_rad_per_s = p[2]),
    c("resistance$coulomb_n_m", "omega0_rad_per_s"), c(0.5, 6), c(0.7, 5), "theta_rad", 8, 120,
    0.02, 2 * pi / 60
  ),
  "axle, three losses" = experiment(
    function(p) scene_axle(0.5, resistance = resistance(p[1], p[2], p[3]), omega0_rad_per_s = 30),
    c("resistance$viscous_n_m_s", "resistance$quadratic_n_m_s2", "resistance$coulomb_n_m"),
    c(0.05, 0.004, 0.3), c(0.1, 0.01, 0.1), "omega_rad_per_s", 8, 150, 0.02, 0.1
  ),
  "motor, spin-up" = experiment(
    function(p) scene_axle(0.2, torque_motor(p[1], 100), resistance(p[2])),
    c("torque$stall_torque_n_m", "resistance$viscous_n_m_s"), c(3, 0.01), c(2, 0.02),
    "omega_rad_per_s", 10, 120, 0.5, 1
  ),
  "hanging mass" = experiment(
    function(p) scene_hanging_mass(p[1], 0.2, radius_m = 0.05, resistance = resistance(0, 0, p[2]),
                                   omega0_rad_per_s = -30),
    c("body", "resistance$coulomb_n_m"), c(0.002, 0.02), c(0.003, 0.01), "theta_rad", 2, 80, 0.02,
    2 * pi / 40
  ),
  "pendulum" = experiment(
    function(p) scene_pendulum(body_point(1), p[1], theta0_rad = p[2]),
    c("distance_m", "theta0_rad"), c(1, 0.8), c(1.02, 0.7), "theta_rad", 6, 120, 0.01, 0.02
  ),
  "pendulum, damped" = experiment(
    function(p) scene_pendulum(body_point(1), p[1], resistance(p[2]), theta0_rad = 1.5),
    c("distance_m", "resistance$viscous_n_m_s"), c(1, 0.3), c(1.02, 0.2), "theta_rad", 8, 100,
    0.01, 0.02
  ),
  "incline, rolls" = experiment(
    function(p) suppressMessages(scene_incline(ball, p[1], v0_m_per_s = p[2])),
    c("incline_angle_deg", "v0_m_per_s"), c(5, 1), c(8, 0.5), "x_m", 3, 90, 0.01, 0.02
  ),
  "incline, slips, then rolls" = experiment(
    function(p) scene_incline(ball, 0, static_friction = p[1], v0_m_per_s = p[2],
                              omega0_rad_per_s = 0),
    c("static_friction", "v0_m_per_s"), c(0.12, 8), c(0.2, 7), "x_m", 4, 100, 0.01, 0.05
  ),
  "thrown body, ratios" = experiment(
    function(p) scene_free(c(1, p[1], p[2]), c(0.3, p[3], 0.5)),
    c(path("body", 2), path("body", 3), path("omega0_rad_per_s", 2)), c(2, 2.6, 8),
    c(1.8, 2.5, 8.2), rates, 1, 80, 0.02, 0.05
  ),
  "heavy top" = experiment(
    function(p) scene_pivot(c(0.02, 0.02, 0.01), c(0, 1, p[2]), mass_kg = p[1],
                            centre_m = c(0, 0, 0.1), attitude0 = attitude_from(
                              c(1, 0, 0, 0.5), "axis_angle")),
    c("mass_kg", path("omega0_rad_per_s", 3)), c(1, 40), c(1.1, 39.5), rates[1:2], 1, 100, 0.02,
    0.05
  ),
  "clutch, locks inside" = experiment(
    function(p) scene_clutch(2, 3, p[1], omega0_rad_per_s = c(p[2], 0)),
    c("capacity_n_m", path("omega0_rad_per_s", 1)), c(12, 20), c(10, 19),
    paste0("omega_", 1:2, "_rad_per_s"), 4, 100, 0.1, 0.2
  ),
  "rotors on a shaft" = experiment(
    function(p) scene_rotors(c(1, 2), p[1], p[2], omega0_rad_per_s = c(1, 0)),
    c("stiffness_n_m_per_rad", "damping_n_m_s"), c(50, 0.4), c(48, 0.3),
    path("theta_rad", 1), 5, 150, 0.005, 0.01
  ),
  "gears, with losses" = experiment(
    function(p) scene_gears(c(0.2, 3), 5, efficiency = p[1], torque = c(4, 0), resistance = list(
      NULL, resistance(p[2]))),
    c("efficiency", path("resistance", 2)), c(0.9, 1.5), c(0.8, 1), "omega_rad_per_s", 6, 120, 0.1,
    0.2
  ),
  "motor, shaft, load" = experiment(
    function(p) scene_drive(c(0.1, 2), coupling_shaft(p[1], p[2], ratio = 4),
                            torque = list(torque_motor(3, 150), NULL)),
    paste0("couplings[1]$", c("stiffness_n_m_per_rad", "damping_n_m_s")), c(40, 0.8), c(30, 0.4),
    path("omega_rad_per_s", 1:2), 3, 150, 0.05, 0.1
  ),
  "bead on a hoop" = experiment(
    function(p) scene_hoop(0.1, p[1], 5, theta0_rad = p[2]),
    c("radius_m", "theta0_rad"), c(0.8, 1), c(0.82, 0.9), "theta_rad", 4, 100, 0.01, 0.02
  ),
  "double pendulum" = experiment(
    function(p) scene_chain(c(p[1], p[2]), 1, c(0.4, 0.2)),
    path("length_m", 1:2), c(1, 0.7), c(1.03, 0.72), path("theta_rad", 1:2), 3, 80, 0.01, 0.02
  ),
  "planet, equations" = experiment(
    function(p) scene_equations(
      function(x, y, vx, vy) c(vx, vy, -c(x, y) / (x^2 + y^2)^1.5),
      start = c(x = 1, y = 0, vx = 0, vy = p[1]), positions = c("x", "y")),
    "start[4]", 1.1, 1.05, c("x", "y"), 8, 60, 0.01, 0.02
  ),
  # Its record does not determine them: the ratios alone.
  "thrown body, moments" = experiment(
    function(p) scene_free(c(p[1], p[2], p[3]), c(0.3, 8, 0.5)),
    path("body", 1:3), c(1, 2, 2.6), c(0.5, 1.1, 1.4), rates, 1, 80, 0.02, 0.05, FALSE
  )
)

noisy <- function(x, kind, sigma, step) {
  n <- length(x)
  switch(kind,
    white = x + stats::rnorm(n, 0, sigma),
    slow = {
      rho <- 0.6
      e <- stats::rnorm(n) * sqrt(1 - rho^2)
      e[1] <- stats::rnorm(1)
      x + sigma * as.vector(stats::filter(e, rho, "recursive"))
    },
    # The zero of a counter is anywhere in a step.
    counter = {
      zero <- stats::runif(1, 0, step)
      step * round((x + zero) / step) - zero
    }
  )
}

record_of <- function(one, kind) {
  time_s <- seq(0, one$end, length.out = one$n)
  motion <- trajectory(one$scene(one$truth), time_s)
  out <- list(time_s = time_s)
  for (name in one$observed) {
    y <- motion[[sub("\\[.*", "", name)]]
    if (grepl("\\[", name)) {
      y <- matrix(y, nrow = length(y) / length(time_s))[as.integer(gsub("[^0-9]", "", sub(
        ".*\\[", "", name))), ]
    }
    out[[name]] <- noisy(y, kind, one$sigma, one$counts)
  }
  as.data.frame(out, check.names = FALSE, optional = TRUE)
}

cases <- expand.grid(kind = c("white", "slow", "counter"), name = names(experiments),
                     stringsAsFactors = FALSE)
cases <- cases[seq_len(nrow(cases)) %% parts == part - 1L, ]
all68 <- all95 <- logical()
passed <- 0
alarms <- 0
cat(sprintf("%-28s %-7s %6s %6s %6s %6s\n", "experiment", "noise", "68 %", "95 %", "alarms",
            "failed"))
for (i in seq_len(nrow(cases))) {
  one <- experiments[[cases$name[i]]]
  set.seed(seed + 1000 * match(cases$name[i], names(experiments)) + match(cases$kind[i], c(
    "white", "slow", "counter")))
  in68 <- in95 <- logical()
  failed <- incomplete <- claims <- wide <- 0
  for (k in seq_len(records)) {
    film <- record_of(one, cases$kind[i])
    fit_at <- function(level) tryCatch(suppressWarnings(suppressMessages(
      fit_scene(one$scene(one$guess), film, one$unknown, level = level)
    )), error = function(e) e)
    fit <- fit_at(0.95)
    if (inherits(fit, "error")) {
      failed <- failed + 1
      if (failed == 1) message(cases$name[i], ": ", conditionMessage(fit))
      next
    }
    if (!one$determined) {
      claims <- claims + any(!is.nan(fit$standard_error)) + any(!is.nan(fit$lower))
      next
    }
    if (any(is.nan(fit$standard_error))) {
      failed <- failed + 1
      next
    }
    tests <- residual_tests(fit)
    incomplete <- incomplete + any(tests$test == "wrong law" & tests$finding != "none found")
    inside <- function(fit) fit$lower <= one$truth & one$truth <= fit$upper
    in68 <- c(in68, inside(fit_at(0.68)))
    in95 <- c(in95, inside(fit))
    wide <- wide + any(grepl("may be too wide", utils::capture.output(print(fit))))
  }
  good <- if (one$determined) {
    # Unknowns of a record are correlated: each counts as half a record.
    n <- max(length(in68) / 2, 1)
    within <- function(x, p) {
      off <- mean(x) - p
      abs(off) <= 4 * sqrt(p * (1 - p) / n) + 0.01 || off > 0 && wide > records / 2
    }
    length(in68) > 0 && within(in68, 0.68) && within(in95, 0.95) && failed <= 0.04 * records
  } else {
    claims == 0 && failed == 0
  }
  passed <- passed + good
  alarms <- alarms + incomplete
  all68 <- c(all68, in68)
  all95 <- c(all95, in95)
  cat(sprintf("%-28s %-7s %6s %6s %6d %6d  %s\n", cases$name[i], cases$kind[i],
              if (one$determined) sprintf("%.2f", mean(in68)) else "none",
              if (one$determined) sprintf("%.2f", mean(in95)) else "none", incomplete, failed,
              if (good) "" else "outside"))
}
ends <- mean(all68) >= 0.60 && mean(all68) <= 0.76 && mean(all95) >= 0.91 && mean(all95) <= 0.985
cat(sprintf(
  "all: 68 %% intervals hold %.3f, 95 %% hold %.3f: %s; laws called incomplete: %d of %d\n",
  mean(all68), mean(all95), if (ends) "within" else "outside", alarms, records * nrow(cases)
))
cat(passed, "of", nrow(cases), "experiments passed\n")
quit(status = as.integer(!ends || passed < nrow(cases)))
