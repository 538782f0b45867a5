# Steps of fixed length in every constraint that integrates: explicit Euler, semi-implicit Euler,
# RK4.
stepped_scenes <- function() {
  disk <- body_disk(2, 0.25)
  ball <- body_sphere(1, 0.1)
  list(
    spin_up = scene_axle(disk, 0.8, resistance(0.03)),
    law = scene_axle(1, function(time_s, theta_rad, omega_rad_per_s) sin(time_s) - 4 * theta_rad,
      theta0_rad = 1),
    drag = scene_axle(1, 2, resistance(quadratic_n_m_s2 = 0.1, coulomb_n_m = 0.2)),
    skater = scene_axle(inertia_knots(c(1, 2), c(5, 2)), 0.3, omega0_rad_per_s = 2),
    pendulum = scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1),
    rubbed = scene_axle(1, torque_spring(4), resistance(coulomb_n_m = 0.4), theta0_rad = 2),
    drive = scene_drive(c(1, 2), coupling_shaft(50, 0.1), torque = list(1, NULL)),
    clutch = scene_drive(c(1, 2), coupling_clutch(5), omega0_rad_per_s = c(10, 0)),
    incline = scene_incline(
      ball, 20, static_friction = 0.1, resistance = resistance(drag_n_s2_per_m2 = 0.2)
    ),
    hoop = scene_hoop(1, 1, 3, theta0_rad = 1, static_friction = 0.02),
    chain = scene_chain(c(1, 1), 1, c(0.3, 0.5)),
    equations = scene_equations(
      function(theta_rad, omega_rad_per_s) c(omega_rad_per_s, -4 * sin(theta_rad)),
      c(theta_rad = 1, omega_rad_per_s = 0), positions = "theta_rad"
    ),
    free = scene_free(c(1, 2, 3), c(0.1, 2, 0.1)),
    top = scene_pivot(disk, c(0, 0, 60), pivot_m = c(0, 0, -0.1),
      attitude0 = attitude_from(c(1, 0, 0, 0.3), "axis_angle"))
  )
}
ladder <- c("euler", "semi_implicit", "rk4")

# The largest distance from `true`, relative to the largest size of each measure.
distance_from <- function(motion, true, scene) {
  max(vapply(constraint_of(scene)$measures, function(m) {
    columns <- lapply(m$columns, function(name) motion[[name]] - true[[name]])
    wanted <- lapply(m$columns, function(name) true[[name]])
    by_row <- function(x) sqrt(Reduce(`+`, lapply(x, function(one) one^2)))
    if (!length(columns) || m$unit == "rad" && length(columns) == 4L) return(0)
    max(by_row(columns)) / max(by_row(wanted))
  }, double(1)))
}

test_that("each method converges with its order, and its figure covers the true error", {
  time_s <- seq(0, 2, 0.25)
  for (name in names(stepped_scenes())) {
    scene <- stepped_scenes()[[name]]
    true <- trajectory(scene, time_s, accuracy = 1e-11)
    for (method in ladder) {
      model <- paste0(constraint_of(scene)$id, "_", method)
      order <- if (method == "rk4") 4 else 1
      steps <- if (name == "top") 2^-(10:11) else 2^-(6:7)
      off <- vapply(steps, function(step_s) {
        motion <- suppressWarnings(trajectory(scene, time_s, model = model, step_s = step_s))
        off <- distance_from(motion, true, scene)
        figure <- glance(motion)$error
        info <- paste(name, model, step_s)
        expect_identical(attr(motion, "run")$info$step_s, step_s, info = info)
        # The figure is relative to what was largest between the rows, too.
        expect_lte(off, 1.2 * figure + 1e-12)
        if (!name %in% c("free", "top")) expect_true(all(audit(motion)$verdict == "balanced"),
          info = info)
        off
      }, double(1))
      if (off[2] > 1e-11) {
        gain <- log2(off[1] / off[2])
        expect_gt(gain, order - 0.4)
        if (method == "euler") expect_lt(gain, 1.6)
      }
    }
  }
})

test_that("a run is the loop that a student writes", {
  h <- 0.01
  n <- 200
  byhand <- function(method) {
    theta <- 1
    omega <- 0
    for (k in seq_len(n)) {
      alpha <- -9.80665 * sin(theta)
      if (method == "euler") {
        theta <- theta + h * omega
        omega <- omega + h * alpha
      } else {
        omega <- omega + h * alpha
        theta <- theta + h * omega
      }
    }
    c(theta, omega)
  }
  scene <- scene_axle(
    1, function(time_s, theta_rad, omega_rad_per_s) -9.80665 * sin(theta_rad), theta0_rad = 1
  )
  for (method in c("euler", "semi_implicit")) {
    last <- suppressWarnings(
      trajectory(scene, c(0, n * h), model = paste0("axle_", method), step_s = h)
    )[2, ]
    expect_equal(c(last$theta_rad, last$omega_rad_per_s), byhand(method), tolerance = 1e-12)
  }
  # The energy of explicit Euler grows in every step, by 1 + h^2 k/I of a spring.
  spring <- scene_axle(2, torque_spring(8), theta0_rad = 1)
  last <- suppressWarnings(trajectory(spring, c(0, 5), model = "axle_euler", step_s = 0.05))[2, ]
  energy <- last$rotational_kinetic_energy_j + 4 * last$theta_rad^2
  expect_equal(energy, 4 * (1 + 0.05^2 * 4)^100, tolerance = 1e-12)
})

test_that("they are never chosen, and say what they are", {
  for (scene in stepped_scenes()) {
    choice <- choose_model(scene, 0:2)
    fixed <- grepl("_(euler|semi_implicit|rk4)$", choice$model)
    expect_gte(sum(fixed), 3L)
    expect_false(any(choice$chosen[fixed]))
    expect_true(all(choice$cost_s[fixed] > 0))
  }
  expect_warning(
    trajectory(scene_axle(1, torque_spring(4), theta0_rad = 1), 0:2, model = "axle_euler"),
    class = "rotdyn_warning_accuracy"
  )
  # Where no step is given: 1/64 of the shortest time scale, 1/1000 of the span where there is none.
  step <- function(scene, time_s) {
    motion <- suppressWarnings(trajectory(scene, time_s, model = "axle_euler"))
    attr(motion, "run")$info$step_s
  }
  expect_equal(step(scene_axle(1, torque_spring(4), theta0_rad = 1), 0:2), 0.5 / 64)
  expect_equal(step(scene_axle(1, 3), c(0, 5)), 0.005)
  expect_error(
    trajectory(scene_axle(1, 3), 0:2, model = "axle_rk8pd", step_s = 0.1),
    class = "rotdyn_error_model"
  )
  expect_error(
    trajectory(scene_axle(1, torque_spring(4), theta0_rad = 1), c(0, 1e6), model = "axle_euler",
               step_s = 0.5),
    class = "rotdyn_error"
  )
})

test_that("work_precision() shows the ladder beside the closed form", {
  scene <- scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1)
  table <- work_precision(
    scene, 0:4, accuracies = 1e-9, steps_s = c(0.01, 0.005), min_batch_s = 0.001, batches = 1
  )
  fixed <- table[!is.na(table$step_s), ]
  expect_setequal(fixed$model, paste0("axle_", ladder))
  expect_true(all(fixed$covered))
  expect_gt(min(table$true_error[table$model == "axle_euler"]), 0.1)
  expect_lt(max(table$true_error[table$model == "axle_rk4"]), 1e-5)
})

test_that("equal rises round alike, and the error figure knows it", {
  for (omega in c(3, 1.7, 0.123, 9.81)) {
    scene <- scene_axle(1, 0, omega0_rad_per_s = omega)
    for (model in c("axle_euler", "axle_semi_implicit", "axle_rk4")) {
      motion <- trajectory(scene, c(0, 2), model = model, step_s = 0.001)
      off <- abs(motion$theta_rad[2] / (2 * omega) - 1)
      expect_lte(off, glance(motion)$error)
      expect_lte(glance(motion)$error, 4e-13)
    }
  }
})
