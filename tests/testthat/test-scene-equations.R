# Equations of the user's own: against closed forms and published values, in every verb, and what is
# refused.
swing <- function(theta_rad, omega_rad_per_s) c(omega_rad_per_s, -9.81 / 0.5 * sin(theta_rad))
start <- c(theta_rad = 0.2, omega_rad_per_s = 0)
circle <- function(...) {
  scene_equations(function(x, v) c(v, -x), c(x = 1, v = 0), positions = "x", ...)
}

# The largest error over the figure of its state.
over_figure <- function(motion, want) {
  errors <- run_of(motion)$info$errors
  max(vapply(names(want), function(name) {
    max(abs(motion[[name]] - want[[name]])) / (errors[[name]] + 4e-16 * max(abs(want[[name]])))
  }, double(1)))
}

test_that("figures cover the distance from closed forms, at all accuracies and both ways in time", {
  time_s <- c(-4, 0, 0.5, 3, 30)
  decay <- scene_equations(function(y) -y, c(y = 1))
  forced <- scene_equations(function(time_s, y) cos(time_s), c(y = 0), start_s = 1)
  for (accuracy in c(1e-4, 1e-7, 1e-10, 1e-12)) {
    motion <- trajectory(circle(), time_s, accuracy)
    expect_lte(over_figure(motion, list(x = cos(time_s), v = -sin(time_s))), 1)
    expect_lte(run_of(motion)$info$error, accuracy)
    expect_lte(over_figure(trajectory(decay, time_s, accuracy), list(y = exp(-time_s))), 1)
    late <- trajectory(forced, time_s, accuracy)
    expect_lte(over_figure(late, list(y = sin(time_s) - sin(1))), 1)
  }
  expect_named(motion, c("time_s", "x", "v"))
})

test_that("an orbit of eccentricity 0.9 keeps energy and angular momentum", {
  e <- 0.9
  orbit <- scene_equations(
    function(x, y, vx, vy) c(vx, vy, -c(x, y) / (x^2 + y^2)^1.5),
    c(x = 1 - e, y = 0, vx = 0, vy = sqrt((1 + e) / (1 - e))), positions = c("x", "y"),
    conserved = list(
      energy = function(x, y, vx, vy) (vx^2 + vy^2) / 2 - 1 / sqrt(x^2 + y^2),
      momentum = function(x, y, vx, vy) x * vy - y * vx
    )
  )
  motion <- trajectory(orbit, c(0, pi, 2 * pi))
  far <- c(1 - e, -1 - e, 1 - e)
  speed <- sqrt((1 + e) / (1 - e)) * c(1, -1 / 19, 1)
  expect_lte(over_figure(motion, list(x = far, y = 0 * far, vx = 0 * far, vy = speed)), 1)
  balances <- audit(motion)
  expect_equal(balances$balance, c("energy", "momentum"))
  expect_true(all(balances$verdict == "balanced"))
  expect_true(all(balances$conserved))
  expect_lt(max(abs(balances$residual)), 1e-7)
  motion$vx[3] <- 0.1
  expect_equal(audit(motion)$verdict[1], "unbalanced")
  # A figure that grows with the turns, not with a power for each.
  turns <- trajectory(orbit, 20 * pi * 0:1, 1e-8)
  whole <- list(x = far[c(1, 1)], y = c(0, 0), vx = c(0, 0), vy = speed[c(1, 1)])
  expect_lte(over_figure(turns, whole), 1)
  expect_lt(attr(turns, "run")$info$error, 2e-8)
  # Semi-implicit steps keep the angular momentum to rounding, explicit ones do not.
  step <- function(model) {
    motion <- trajectory(orbit, c(0, 2 * pi), 1, paste0("equations_", model), step_s = 1e-3)
    abs(diff(augment(motion)$momentum))
  }
  expect_lt(suppressWarnings(step("semi_implicit")), 1e-12)
  expect_gt(suppressWarnings(step("euler")), 1e-3)
})

test_that("stiff motions: published values, and another integrator's", {
  # Mazzia & Magherini, Test Set for Initial Value Problem Solvers 2.4 (2008), VDPOL.
  relax <- scene_equations(function(y, v) c(v, 1000 * (1 - y^2) * v - y), c(y = 2, v = 0))
  for (accuracy in c(1e-6, 1e-9)) {
    motion <- suppressWarnings(trajectory(relax, c(0, 2000), accuracy))
    expect_equal(run_of(motion)$model, "equations_radau")
    want <- list(y = c(2, 1.706167732170483), v = c(0, -8.928097010247975e-4))
    expect_lte(over_figure(motion, want), 1)
    expect_lt(run_of(motion)$info$error, 1e-5)
  }
  # Robertson's reaction: the same test set, problem ROBER, at 40 s by Hairer & Wanner 1996, IV.10.
  reaction <- scene_equations(
    function(a, b, c) {
      forth <- 0.04 * a - 1e4 * b * c
      c(-forth, forth - 3e7 * b^2, 3e7 * b^2)
    },
    c(a = 1, b = 0, c = 0), conserved = list(whole = function(a, b, c) a + b + c)
  )
  motion <- suppressWarnings(trajectory(reaction, c(0, 40)))
  expect_equal(motion$a[2], 0.7158270688, tolerance = 1e-9)
  expect_equal(motion$b[2] * 1e5, 0.9185534765, tolerance = 1e-9)
  expect_equal(audit(motion)$verdict, "balanced")
  # At 1e11 s, the test set's value: the figure is known though the maps of a step have 1e14.
  late <- list(a = c(1, 2.083340149701255e-08), b = c(0, 8.333360770334713e-14),
               c = c(0, 0.999999979166505))
  motion <- trajectory(reaction, c(0, 1e11), 1e-6)
  expect_lte(over_figure(motion, late), 1)
  expect_lt(run_of(motion)$info$error, 1e-6)
  # deSolve::ode(c(prey = 10, predator = 5), c(0, 10), function(t, y, p) list(c(y[1] - 0.1 * y[1] *
  # y[2], 0.075 * y[1] * y[2] - 1.5 * y[2])), NULL, "radau", rtol = 1e-13, atol = 1e-13)
  skip_if_not_installed("deSolve")
  rates <- function(prey, predator) {
    c(prey - 0.1 * prey * predator, 0.075 * prey * predator - 1.5 * predator)
  }
  hunt <- trajectory(scene_equations(rates, c(prey = 10, predator = 5)), c(0, 10), 1e-10)
  peer <- deSolve::ode(
    c(10, 5), c(0, 10), function(t, y, p) list(rates(y[1], y[2])), NULL, "radau",
    rtol = 1e-13, atol = 1e-13
  )
  expect_equal(c(hunt$prey[2], hunt$predator[2]), unname(peer[2, 2:3]), tolerance = 1e-9)
})

test_that("long stiff motions reach their accuracy", {
  scene <- scene_equations(
    function(time_s, x) -1e4 * (x - cos(time_s)) - sin(time_s), c(x = 1)
  )
  for (model in list(NULL, "equations_radau")) {
    time_s <- seq(0, 30, length.out = 31)
    expect_no_warning(run <- trajectory(scene, time_s, accuracy = 1e-9, model = model))
    expect_lt(glance(run)$error, 1e-9) # 1.4e-7 where the order of the steps counts
    expect_lt(max(abs(run$x - cos(time_s))), glance(run)$error)
  }
})

test_that("the same pendulum as a scene of the package, at the same digits", {
  mine <- scene_equations(swing, start, positions = "theta_rad")
  exact <- scene_pendulum(
    body_point(1), 0.5, theta0_rad = 0.2, gravity_m_per_s2 = 9.81
  )
  time_s <- 0:8
  want <- trajectory(exact, time_s)
  expect_lte(over_figure(trajectory(mine, time_s), want[c("theta_rad", "omega_rad_per_s")]), 1)
  table <- work_precision(
    mine, time_s, accuracies = c(1e-6, 1e-9), steps_s = 0.002, reference = want,
    min_batch_s = 1e-4, batches = 1
  )
  expect_setequal(
    table$model, paste0("equations_", c("rk8pd", "radau", "euler", "semi_implicit", "rk4"))
  )
  # The figure is relative to what the run itself grew to.
  expect_true(all(table$true_error <= 1.2 * table$error))
  expect_true(all(is.na(table$energy_residual)))
  # A function of the times as reference.
  table <- work_precision(
    circle(), time_s, accuracies = 1e-9, steps_s = c(0.01, 0.005), min_batch_s = 1e-4,
    batches = 1, reference = function(t) list(x = cos(t), v = -sin(t))
  )
  expect_true(all(table$covered))
  euler <- table$true_error[table$model == "equations_euler"]
  expect_equal(euler[1] / euler[2], 2, tolerance = 0.05)
  expect_error(
    work_precision(circle(), 0:1, reference = function(t) 1), class = "rotdyn_error_type"
  )
  expect_error(
    work_precision(circle(), 0:1, reference = trajectory(exact, 0:1)),
    class = "rotdyn_error_value"
  )
})

test_that("every verb", {
  scene <- scene_equations(
    swing, start, positions = "theta_rad",
    conserved = list(energy_j = function(theta_rad, omega_rad_per_s) {
      omega_rad_per_s^2 / 2 - 9.81 / 0.5 * cos(theta_rad)
    })
  )
  motion <- trajectory(scene, 0:4)
  expect_output(print(scene), "equations of theta and omega.*f\\(theta_rad.*energy_j")
  expect_equal(names(summary(motion))[1:2], c("final_theta_rad", "final_omega_rad_per_s"))
  expect_equal(predict(motion, c(3, NA))$theta_rad, c(motion$theta_rad[4], NA), tolerance = 1e-9)
  expect_identical(nrow(motion_events(motion)), 0L)
  expect_equal(audit(motion)$unit, "J")
  expect_equal(diff(range(augment(motion)$energy_j)), 0, tolerance = 1e-8)
  expect_true(conserved(scene)$conserved)
  expect_true(is.na(conserved(update(scene, conserved = NULL))$conserved))
  expect_identical(update(scene), scene)
  expect_identical(update(scene, start_s = 2)$start_s, 2)
  passes <- time_when(scene, theta_rad = 0, occurrence = "all", until_s = 3)
  exact <- period_of(
    scene_pendulum(body_point(1), 0.5, theta0_rad = 0.2, gravity_m_per_s2 = 9.81)
  )$period_s
  expect_equal(passes$time_s, exact * c(1, 3, 5, 7) / 4, tolerance = 1e-9)
  expect_equal(time_when(scene, theta_rad = 0)$time_s, exact / 4, tolerance = 1e-9)
  choice <- choose_model(scene, 0:4)
  expect_match(choice$reason[choice$chosen], "no closed form")
  for (verb in list(period_of, stopping)) expect_error(verb(scene), class = "rotdyn_error_model")
  expect_error(write_scene(scene), "R function", class = "rotdyn_error_scene")
  none <- trajectory(circle(), 0:1)
  expect_identical(nrow(audit(none)), 0L)
  expect_identical(names(audit(none)), names(audit(motion)))
  expect_output(print(audit(none)), "does not name what is conserved")
  expect_error(
    trajectory(update(scene, positions = NULL), 0:1, 1, "equations_semi_implicit"), "positions",
    class = "rotdyn_error_model"
  )
  skip_if_not_installed("units")
  angle <- trajectory(scene, 0:2, units::set_units(0.1, "degree"))
  expect_equal(run_of(angle)$accuracy, 0.9 * pi / 1800 / 0.2, tolerance = 1e-3)
  expect_identical(
    scene_equations(swing, list(
      theta_rad = units::set_units(180, "degree"), omega_rad_per_s = 0
    ))$start[["theta_rad"]], pi
  )
  skip_if_not_installed("ggplot2")
  plot <- ggplot2::autoplot(motion)
  expect_silent(ggplot2::ggplot_build(plot))
  expect_equal(levels(plot$data$panel), c("theta (rad)", "omega (rad/s)"))
  expect_s3_class(ggplot2::autoplot(audit(motion)), "ggplot")
  expect_error(ggplot2::autoplot(audit(none)), class = "rotdyn_error_value")
})

test_that("arguments of functions are names of states, in any order, or dots", {
  last <- function(f) {
    as.list(tibble::as_tibble(trajectory(scene_equations(f, c(x = 1, v = 0)), c(0, 2))))
  }
  want <- last(function(x, v) c(v, -x))
  expect_identical(last(function(v, time_s, x) c(v, -x)), want)
  expect_identical(last(function(...) c(..3, -..2)), want)
  expect_identical(last(function(x, ...) c(list(...)$v, -x)), want)
  expect_identical(last(function(v, x, k = 1) c(v, -k * x)), want)
  expect_identical(last(function(x, v) c(b = v, a = -x)), want)
  for (f in list(
    function(t, y, parms) 1, function(time_s, theta) c(0, 0), function() c(0, 0),
    function(velocity = 1) c(0, 0), function(x_m = 3, ...) c(0, 0)
  )) {
    expect_error(scene_equations(f, c(x = 1, v = 0)), class = "rotdyn_error_type")
  }
})

test_that("what is wrong is refused when the scene is made, with the user's call", {
  refused <- function(kind, ..., f = swing, from = start) {
    e <- expect_error(scene_equations(f, from, ...), class = paste0("rotdyn_error_", kind))
    expect_identical(as.character(conditionCall(e)[[1]]), "scene_equations")
    invisible(conditionMessage(e))
  }
  refused("type", f = 1)
  refused("type", from = "a")
  refused("size", from = double())
  refused("size", from = stats::setNames(double(17), letters[1:17]))
  for (from in list(c(1, 2), c(a = 1, a = 2), c(time_s = 1, b = 2), c(a = NA, b = 1),
                    c(a = Inf, b = 1))) {
    refused("value", from = from)
  }
  expect_match(refused("type", f = function(...) list(c(0, 0))), "not in a list")
  refused("size", f = function(theta_rad) theta_rad)
  refused("type", f = function(theta_rad) c("a", "b"))
  expect_match(refused("rhs", f = function(theta_rad) c(NaN, 0)), "theta_rad")
  e <- expect_error(
    scene_equations(function(theta_rad) stop("{mine}"), start), class = "rotdyn_error_rhs"
  )
  expect_match(conditionMessage(e$parent), "{mine}", fixed = TRUE)
  refused("random", f = function(theta_rad) stats::rnorm(2))
  refused("type", positions = 1)
  refused("value", positions = "theta")
  refused("value", positions = names(start))
  refused("type", conserved = swing)
  refused("value", conserved = list(swing))
  refused("value", conserved = list(theta_rad = function(theta_rad) 1))
  refused("size", conserved = list(a = swing))
  refused("type", conserved = list(a = function(x) 1))
  refused("rhs", conserved = list(a = function(theta_rad) 1 / 0))
  expect_error(scene_equations(swing), class = "rotdyn_error_missing")
  expect_error(scene_equations(swing, start, start = 1), ".*")
  expect_error(scene_equations(swing, start, mass_kg = 1), class = "rotdyn_error_argument")
})

test_that("a function that fails in a run ends it with the time and its own error", {
  late <- function(what) {
    function(time_s, theta_rad, omega_rad_per_s) {
      if (time_s > 2.5) what() else c(omega_rad_per_s, -theta_rad)
    }
  }
  run <- function(what, ...) {
    trajectory(scene_equations(late(what), start, positions = "theta_rad"), 0:5, ...)
  }
  broken <- function() stop("no {glue}", call. = FALSE)
  for (model in c("rk8pd", "radau", "euler", "semi_implicit", "rk4")) {
    e <- expect_error(
      run(broken, accuracy = if (model %in% c("rk8pd", "radau")) 1e-9 else 1,
          model = paste0("equations_", model)),
      "at 2\\.[5-9]", class = "rotdyn_error_rhs"
    )
    expect_identical(conditionMessage(e$parent), "no {glue}")
  }
  expect_error(run(function() 1), "2 numbers", class = "rotdyn_error_size")
  expect_error(run(function() "a"), class = "rotdyn_error_type")
  e <- expect_error(run(function() c(NaN, 0)), class = "rotdyn_error_rhs")
  expect_equal(e$info$time_s, 2.5, tolerance = 0.1)
  expect_warning(
    part <- run(function() c(NaN, 0), on_fail = "truncate"), class = "rotdyn_warning_truncated"
  )
  expect_equal(part$time_s, 0:2)
  expect_error(
    trajectory(scene_equations(function(y) y^2, c(y = 1)), 0:2), "without bound",
    class = "rotdyn_error_step"
  )
  expect_error(
    trajectory(scene_equations(swing, start), c(0, 1e4), max_steps = 9), "max_steps",
    class = "rotdyn_error_budget"
  )
})

test_that("damaged scenes are no scenes", {
  scene <- circle()
  for (part in c("f", "start", "start_s")) {
    for (bad in list("a", NaN, list(1))) {
      damaged <- scene
      damaged[[part]] <- bad
      expect_error(trajectory(damaged, 0:1), class = "rotdyn_error_type")
    }
  }
  damaged <- scene
  names(damaged$start) <- c("x", "x")
  expect_error(trajectory(damaged, 0:1), class = "rotdyn_error_type")
  damaged <- structure(1, class = class(scene))
  expect_error(trajectory(damaged, 0:1), class = "rotdyn_error_type")
  motion <- trajectory(scene, 0:1)
  names(motion)[2] <- "z"
  expect_false(inherits(motion, "rot_trajectory"))
})

test_that("units of names", {
  expect_identical(
    vapply(
      c("theta_rad", "v_m_per_s", "h_kg_m2_per_s", "prey", "x_1", "energy_j"), unit_of_name, ""
    ),
    c(theta_rad = "rad", v_m_per_s = "m/s", h_kg_m2_per_s = "kg m^2/s", prey = "1", x_1 = "1",
      energy_j = "J")
  )
  expect_identical(without_unit(c("theta_rad", "prey", "v_m_per_s")), c("theta", "prey", "v"))
})

test_that("equations are drawn as a loop, with the states at the start", {
  skip_if_not_installed("ggplot2")
  scene <- scene_equations(
    function(x_m, v_m_per_s) c(v_m_per_s, -x_m), c(x_m = 0.2, v_m_per_s = 3), positions = "x_m",
    conserved = list(energy_j = function(x_m, v_m_per_s) x_m^2 + v_m_per_s^2)
  )
  alt <- ggplot2::autoplot(scene)$labels$alt
  expect_match(alt, "Equations of x and v.*x at start 0.2 m; v at start 3 m/s; conserved energy")
})

test_that("the time scales of equations need the sizes of their own states", {
  stiff <- scene_equations(function(y) -1e3 * y, c(y = 0), positions = character())
  scales <- function(sizes) {
    rotdyn:::equations_time_scales(
      scene_equations(function(x, v) c(v, -4 * x - x^3), c(x = 0, v = 0)), sizes, NULL
    )
  }
  expect_equal(scales(c(x = 1, v = 2))$swing_rad_per_s, 2, tolerance = 1e-6)
  # A step of 1e-5 of the size of x, of which the cube is no part.
  expect_equal(scales(c(x = 1e3, v = 2e3))$swing_rad_per_s, sqrt(4 + 1e-4), tolerance = 1e-9)
  expect_equal(scales(7)$swing_rad_per_s, 2, tolerance = 1e-9)
})
