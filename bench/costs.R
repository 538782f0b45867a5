# Predicted time of every model on scenes of each kind, beside its measured one: how the
# coefficients in src/core/scene/*/models.c hold. From the top of the repository, with the package
# installed:
#
#   Rscript bench/costs.R
#
# One line for each model that applies: predicted, measured (processor time of trajectory(), less
# that of a trajectory of as many rows that costs the core nothing), their ratio. Then, scene by
# scene, how much slower than the fastest the model is that was predicted to be the cheapest.

library(rotdyn)

cost_scenes <- function() {
  knots <- torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
  many <- torque_knots(seq(0, 8, length.out = 401), sin(seq(0, 8, length.out = 401)))
  steps <- torque_steps(c(0, 3), c(0.8, -0.2))
  state <- function(time_s, theta_rad, omega_rad_per_s) cos(time_s) - 0.1 * theta_rad
  oil <- resistance(0.03)
  list(
    "constant torque" = scene_axle(0.5, 1),
    "slip to roll" = scene_incline(
      body_sphere(6, 0.11), 0, static_friction = 0.19, v0_m_per_s = 8.1, omega0_rad_per_s = 0
    ),
    "knots" = scene_axle(0.0625, knots, oil),
    "401 knots" = scene_axle(0.0625, many, oil),
    "a skater" = scene_axle(inertia_knots(0:4, c(5, 3, 2, 1, 1)), steps, omega0_rad_per_s = 1),
    "a skater in oil" = scene_axle(inertia_knots(0:4, c(5, 3, 2, 1, 1)), steps, oil),
    "steps, all friction" = scene_axle(0.0625, steps, resistance(0.03, 1e-3, 0.1)),
    "knots, dry friction" = scene_axle(0.0625, knots, resistance(0.03, 0, 0.1)),
    "knots, quadratic" = scene_axle(0.0625, knots, resistance(0.03, 0.01)),
    "a curve" = scene_axle(0.0625, torque_curve(c(0, 5, 10), c(1, 0.8, 0)), oil),
    "a sinusoid" = scene_axle(0.0625, torque_sinusoid(1, 2), oil),
    "three terms" = scene_axle(
      0.0625, torque_sinusoid(1, 2) + torque_sinusoid(1, 3) + torque_exponential(1, 2), oil
    ),
    "a polynomial" = scene_axle(0.0625, torque_polynomial(c(0, 8), 1:4), oil),
    "a spring" = scene_axle(0.0625, torque_spring(3) + knots, oil, 1),
    "a spring, driven" = scene_axle(0.0625, torque_spring(3) + torque_sinusoid(1, 2), oil, 1),
    "a pendulum" = scene_axle(1, torque_gravity(1, 1), NULL, 1),
    "a pendulum in oil" = scene_axle(1, torque_gravity(1, 1), resistance(0.1), 1),
    "a law of the state" = scene_axle(1, torque_function(state, breaks_s = double())),
    "stiff" = scene_axle(0.01, torque_knots(c(0, 8), c(0, 1)), resistance(10, 1)),
    "8 rotors" = scene_rotors(as.list(rep(1, 8)), 1e4, 0, torque = c(1, rep(0, 7))),
    "8 rotors, damped" = scene_rotors(
      as.list(rep(1, 8)), 1e4, 1, torque = c(1, rep(0, 7)), resistance = (1:8) / 10
    ),
    "a clutch" = scene_clutch(1, 2, 5, torque = list(1, NULL), omega0_rad_per_s = c(10, 0))
  )
}

# Fastest of some batches, s of processor time.
fastest_s <- function(run, batches = 5, batch_s = 0.02) {
  clock <- function() .Call(rotdyn:::ffi_clock_cpu)
  calls <- 1
  repeat {
    from <- clock()
    for (i in seq_len(calls)) run()
    took <- clock() - from
    if (took >= batch_s) break
    calls <- calls * 4
  }
  min(took, vapply(seq_len(batches), function(batch) {
    from <- clock()
    for (i in seq_len(calls)) run()
    clock() - from
  }, double(1))) / calls
}

rows_of <- c(1, 1000)
results <- do.call(rbind, lapply(names(cost_scenes()), function(name) {
  scene <- cost_scenes()[[name]]
  constraint <- sub("rot_scene_", "", class(scene)[1])
  do.call(rbind, lapply(rows_of, function(rows) {
    t <- seq(8 / rows, 8, length.out = rows)
    free <- scene_axle(1)
    call_s <- fastest_s(function() trajectory(free, t))
    table <- rotdyn:::core_candidates(constraint, scene, t, 1e-9)
    # A model may turn out not to reach the accuracy: an error on trial, else a warning.
    reaches <- function(model) {
      tryCatch(nrow(trajectory(scene, t, model = model)) > 0, condition = function(e) FALSE)
    }
    fit <- which(table$applies)
    fit <- fit[vapply(table$model[fit], reaches, TRUE)]
    measured <- vapply(table$model[fit], function(model) {
      run <- function() trajectory(scene, t, model = model)
      max(fastest_s(run) - call_s, 0)
    }, double(1))
    data.frame(
      scene = name, rows = rows, model = table$model[fit], predicted_us = 1e6 * table$cost_s[fit],
      measured_us = 1e6 * measured, row.names = NULL
    )
  }))
}))
results$ratio <- results$predicted_us / results$measured_us
print(format(results, digits = 3), row.names = FALSE)

by_case <- split(results, list(results$scene, results$rows), drop = TRUE)
slower <- vapply(by_case, function(x) x$measured_us[1] / min(x$measured_us), double(1))
cat("\nMeasured time of the model predicted to be cheapest, over that of the fastest:\n")
print(sort(slower[slower > 1], decreasing = TRUE), digits = 3)
