# Rows of the core against trajectory() of the scene that the constructors make: every constraint,
# every kind of input.

call <- environment()

# A plan for three values of one input; NULL where its constructor refuses them.
one_input <- function(scene, path, values, outputs, time_s) {
  design <- design_list(stats::setNames(data.frame(values), path))
  tryCatch(
    sweep_plan(scene, time_s, design, outputs = outputs, kernel = FALSE),
    rotdyn_error_value = function(e) NULL, rotdyn_error_model = function(e) NULL
  )
}

# The same rows by trajectory(), with the model asked for by name in both.
by_trajectory <- function(plan) {
  plan$asked <- !is.null(plan$model)
  core <- rows_of_sweep(plan, 1, plan$n, call = call)
  plan$kind <- "scene"
  list(core = core, r = rows_of_sweep(plan, 1, plan$n, call = call))
}

scenes <- list(
  axle = random_axle, pendulum = random_pendulum, hanging = random_hanging, gears = random_gears,
  rotors = random_rotors, clutch = random_clutch, drive = random_drive, free = random_free,
  pivot = random_pivot,
  incline = function() {
    scene_incline(
      one_of(body_disk(1, 0.2), body_sphere(1, 0.1)), stats::runif(1, 5, 40),
      static_friction = one_of(Inf, 0.1), rolling_arm_m = one_of(0, 0.002),
      v0_m_per_s = one_of(0, 1),
      resistance = one_of(NULL, resistance(drag_n_s2_per_m2 = 0.1))
    )
  },
  hoop = function() {
    scene_hoop(
      1, 0.5, 6, theta0_rad = 0.3, resistance = resistance(drag_n_s_per_m = one_of(0, 0.2)),
      static_friction = one_of(0, 0.1)
    )
  },
  chain = function() {
    scene_chain(c(1, 2), c(0.5, 0.4), theta0_rad = c(1, -0.5), resistance = one_of(0, 0.01))
  }
)

test_that("a row of the core is that of trajectory(), bit for bit", {
  set.seed(20261127)
  compared <- 0
  for (name in names(scenes)) for (i in seq_len(if (long_tests) 8 else 1)) {
    scene <- suppressMessages(scenes[[name]]())
    known <- sweep_inputs(scene)
    outputs <- sweep_outputs(scene)$output
    for (k in sample(nrow(known), min(6, nrow(known)))) {
      v <- if (is.nan(known$value[k])) stats::runif(1, 0.1, 1) else known$value[k]
      wanted <- sample(outputs, min(12, length(outputs)))
      plan <- suppressMessages(
        one_input(scene, known$input[k], c(v, v * 1.03 + 0.01, v * 0.9), wanted, c(1.5, 4))
      )
      if (is.null(plan)) next
      rows <- suppressMessages(by_trajectory(plan))
      both <- rows$core$status == 0L & rows$r$status == 0L
      # Laws that change a clutch into a drive are refused by the one, another model by the other.
      label <- paste(name, known$input[k])
      expect_identical(rows$core$status == 0L, rows$r$status == 0L, label = label)
      expect_identical(
        lapply(rows$core$output, `[`, both), lapply(rows$r$output, `[`, both), label = label
      )
      expect_identical(rows$core$error[both], rows$r$error[both])
      compared <- compared + sum(both)
    }
  }
  expect_gt(compared, if (long_tests) 1000 else 125)
})

test_that("a row does not depend on the piece that it is computed in, nor on threads", {
  wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03, 0.001, 0.01))
  plan <- sweep_plan(wheel, c(1, 5), design_random(3000, seed = 4,
    "body$mass_kg" = vary_uniform(1, 3), torque = vary_normal(0.8, 0.2)
  ))
  whole <- rows_of_sweep(plan, 1, 3000, call = call)
  for (i in c(1, 2, 257, 2999, 3000)) {
    one <- rows_of_sweep(plan, i, 1, call = call)
    expect_identical(one$output, lapply(whole$output, `[`, i))
    expect_identical(one$error, whole$error[i])
  }
  expect_identical(rows_of_sweep(plan, 1, 3000, threads = 2, call = call), whole)
  expect_true(all(whole$status == 0))
})

test_that("the last time of a row may vary, and a row may run backwards", {
  wheel <- scene_axle(0.1, 0.2, start_s = 1)
  plan <- sweep_plan(wheel, c(2, 9), design_list(data.frame(time_s = c(0.5, 1, 3))),
    outputs = c("final_theta_rad", "max_omega_rad_per_s", "min_omega_rad_per_s")
  )
  rows <- sweep_run(plan)
  expect_equal(rows$final_theta_rad, 0.5 * 2 * (c(0.5, 1, 3) - 1)^2, tolerance = 1e-14)
  expect_identical(rows$status, rep("ok", 3))
  # Of the start, unless the first time is before it, and the times up to the last one.
  expect_equal(rows$max_omega_rad_per_s, c(-1, 0, 4))
  expect_equal(rows$min_omega_rad_per_s, c(-1, 0, 0))
})

test_that("rows that a constructor or a model refuses have a status and no numbers", {
  wheel <- scene_axle(0.1, resistance = resistance(coulomb_n_m = 0.01, static_n_m = 0.02),
                      omega0_rad_per_s = 3)
  rows <- sweep_run(sweep_plan(wheel, 5, design_list(data.frame(
    "resistance$static_n_m" = c(0.02, 0.005, 0.01), check.names = FALSE
  ))))
  expect_identical(rows$status, c("ok", "value", "ok"))
  expect_identical(is.nan(rows$final_theta_rad), c(FALSE, TRUE, FALSE))
  expect_identical(is.nan(rows$error), c(FALSE, TRUE, FALSE))
  # A model without dry friction takes the rows without it.
  some <- sweep_run(sweep_plan(wheel, 5, model = "axle_linear", design_list(data.frame(
    "resistance$coulomb_n_m" = c(0, 0.01), "resistance$static_n_m" = c(0, 0.02),
    check.names = FALSE
  ))))
  expect_identical(some$status, c("ok", "model"))
})

test_that("R functions of a scene and a function that builds scenes are run row by row", {
  pushed <- scene_axle(0.1, function(time_s) 0.2 + 0 * time_s)
  rows <- sweep_run(sweep_plan(pushed, 3, design_list(data.frame(body = c(0.1, 0.2)))))
  expect_equal(rows$final_omega_rad_per_s, c(6, 3), tolerance = 1e-9)
  k <- 2
  built <- sweep_run(sweep_plan(NULL, 3, design_list(data.frame(m = c(0.1, 0.2))),
    build = function(row) scene_axle(k * row$m, 0.2), given = list(k = k)
  ))
  expect_equal(built$final_omega_rad_per_s, c(3, 1.5), tolerance = 1e-12)
  expect_identical(built$status, c("ok", "ok"))
  expect_error(
    sweep_plan(NULL, 3, design_list(data.frame(m = 1)), build = function(row) stop("no")),
    class = "rotdyn_error_build"
  )
  expect_error(
    sweep_plan(NULL, 3, design_list(data.frame(m = 1)), build = function(row) row$m),
    class = "rotdyn_error_type"
  )
})

test_that("an input without bound may be Inf", {
  slope <- scene_incline(body_disk(1, 0.2), 20, static_friction = Inf)
  plan <- sweep_plan(slope, 1, design_list(data.frame(static_friction = c(Inf, 0.01))))
  rows <- sweep_run(plan)
  expect_identical(rows$status, c("ok", "ok"))
  # Rolls with 2/3 of the acceleration of a body that slides without friction.
  expect_equal(rows$final_x_m[1], 9.80665 * sin(20 * pi / 180) / 3, tolerance = 1e-14)
  expect_gt(rows$final_x_m[2], rows$final_x_m[1])
  expect_identical(by_trajectory(plan)$r$status, c(0L, 0L))
})

test_that("the period of a row is that of its scene", {
  pendulum <- scene_pendulum(body_disk(1.5, 0.1), 0.3, theta0_rad = 1)
  plan <- sweep_plan(pendulum, 1, design_list(data.frame(theta0_rad = c(0.1, 1, 3))), "period_s")
  rows <- sweep_run(plan)
  # 2/pi K(sin^2(1/2)) by mpmath; the small swing is 2 pi sqrt(I/(m g d)).
  small <- 2 * pi * sqrt((0.5 * 1.5 * 0.1^2 + 1.5 * 0.3^2) / (1.5 * 9.80665 * 0.3))
  expect_equal(rows$period_s[2] / small, 1.06633424557996305, tolerance = 1e-14)
  for (i in 1:3) expect_identical(rows$period_s[i], period_of(sweep_scene(plan, i))$period_s)
  brick <- scene_free(c(2, 2.5, 3), c(0.1, 1, 0.2))
  turns <- sweep_plan(brick, 1, design_list(data.frame(
    "body[2]" = c(2.2, 2.5, 2.8), check.names = FALSE
  )), "period_s")
  rows <- sweep_run(turns)
  for (i in 1:3) expect_identical(rows$period_s[i], period_of(sweep_scene(turns, i))$period_s)
  # A drag has none; a clutch has no such output.
  oiled <- scene_axle(1, resistance = resistance(0.1), omega0_rad_per_s = 2)
  expect_identical(
    sweep_run(sweep_plan(oiled, 1, design_list(data.frame(body = 1)), "period_s"))$period_s, NaN
  )
  expect_false("period_s" %in% sweep_outputs(scene_incline(body_disk(1, 0.2), 20))$output)
})

test_that("the balance of a row is of its first time, where the moment of inertia is another", {
  arms <- scene_axle(inertia_knots(c(0, 1, 2), c(2, 1, 1)), omega0_rad_per_s = 3)
  sweep <- sweep_run(sweep_plan(
    arms, c(0, 0.5), design_list(data.frame(omega0_rad_per_s = c(3, 4))),
    outputs = c("supplied_j", "lost_j", "balanced")
  ))
  for (row in 1:2) {
    scene <- update(arms, omega0_rad_per_s = c(3, 4)[row])
    energy <- audit(trajectory(scene, c(0, 0.5)))[1, ]
    expect_equal(sweep$supplied_j[row], energy$supplied, tolerance = 1e-12)
    expect_gt(sweep$supplied_j[row], 1)
  }
  expect_true(all(sweep$balanced == 1))
})

test_that("the balance of an integrated row is that of its run at all times", {
  fan <- scene_axle(1, torque_sinusoid(3, 4), resistance(0.1, 0.2), omega0_rad_per_s = 2)
  times <- c(0, 0.4, 1.1, 3)
  rates <- c(2, 5)
  plan <- sweep_plan(
    fan, times, design_list(data.frame(omega0_rad_per_s = rates)),
    outputs = c("supplied_j", "lost_j"), accuracy = 1e-6
  )
  sweep <- sweep_run(plan)
  expect_identical(plan$model, "axle_rk8pd")
  for (row in 1:2) {
    run <- trajectory(update(fan, omega0_rad_per_s = rates[row]), times, accuracy = 1e-6)
    energy <- audit(run)[1, ]
    expect_equal(sweep$supplied_j[row], energy$supplied, tolerance = 1e-14)
    expect_equal(sweep$lost_j[row], energy$dissipated, tolerance = 1e-14)
  }
})

test_that("a time that varies is the last of its row: times of the plan after it are left out", {
  scene <- scene_axle(2, 3, start_s = 0.25)
  design <- design_list(data.frame(time_s = c(0.5, 2, 9)))
  plan <- sweep_plan(scene, c(1, 3, 4), design, outputs = "final_omega_rad_per_s")
  times <- lapply(c(0.5, 2, 9), function(last) times_of_row(plan, scene, list(time_s = last)))
  expect_equal(times, list(c(0.25, 0.5), c(0.25, 1, 2), c(0.25, 1, 3, 9)))
})
