# Functions of time among the inputs of a scene are sampled before a run, those of the state called.
counted <- function(f) {
  calls <- 0
  list(f = function(time_s) {
    calls <<- calls + 1
    f(time_s)
  }, calls = function() calls)
}
push <- function(t) c(sin(t), 0.3 * cos(2 * t), 0.1)
last_rates <- function(motion) {
  unlist(unclass(motion[nrow(motion), grep("omega", names(motion))]))
}

test_that("a law of time on a free body or a top takes few calls, and moves it as before", {
  of_state <- function(time_s, omega_rad_per_s, attitude) push(time_s)
  scenes <- list(
    function(law) scene_free(c(1, 2, 3), c(1, 2, 0.5), torque = law),
    function(law) scene_free(c(1, 2, 3), c(1, 2, 0.5), torque = law, torque_axes = "space"),
    function(law) {
      scene_pivot(
        c(1, 1, 2), c(0, 0, 5), mass_kg = 1, centre_m = c(0, 0, 0.1), torque = law
      )
    }
  )
  for (scene in scenes) {
    law <- counted(push)
    sampled <- trajectory(scene(law$f), seq(0, 10, by = 0.5))
    expect_lt(law$calls(), 500)
    called <- trajectory(scene(of_state), seq(0, 10, by = 0.5))
    error <- run_of(sampled)$info$error + run_of(called)$info$error
    size <- max(abs(last_rates(called)))
    expect_lte(max(abs(last_rates(sampled) - last_rates(called))), 2 * error * size)
    expect_true(all(audit(sampled)$verdict == "balanced"))
  }
})

# A body of equal moments: omega is the integral of the torque.
test_that("what lies between the samples is found, down to the resolution", {
  at <- function(width, height, ...) {
    pulse <- function(t) c(0, 0, if (abs(t - 6.3) < width / 2) height else 0)
    motion <- trajectory(scene_free(c(1, 1, 1), c(0, 0, 1), torque = pulse), c(0, 10), ...)
    motion$omega_z_rad_per_s[2]
  }
  expect_equal(at(0.06, 5), 1.3, tolerance = 1e-6)
  expect_equal(at(0.006, 50, resolution = 5e-4), 1.3, tolerance = 1e-6)
  bump <- function(t) c(0, 0, exp(-((t - 3) / 0.05)^2))
  motion <- trajectory(scene_free(c(1, 1, 1), c(0, 0, 0), torque = bump), c(0, 10))
  expect_equal(motion$omega_z_rad_per_s[2], 0.05 * sqrt(pi), tolerance = 1e-9)
})

test_that("a force over time pushes a sphere by its integral", {
  law <- counted(function(t) 2 + sin(t))
  ball <- function(f, ...) scene_incline(body_sphere(1, 0.1), 0, force = f, ...)
  motion <- trajectory(ball(law$f), c(0, 4))
  # It rolls: 7/5 m v' = force.
  expect_equal(motion$v_m_per_s[2], (8 + 1 - cos(4)) / 1.4, tolerance = 1e-9)
  expect_lt(law$calls(), 500)
  steps <- counted(function(t) if (t < 1) 2 else 5)
  motion <- trajectory(ball(force_function(steps$f, 1)), c(0, 3))
  expect_equal(motion$v_m_per_s[2], 12 / 1.4, tolerance = 1e-9)
  expect_lt(steps$calls(), 500)
})

test_that("the torques of a drive are sampled, what clutches grip with is called", {
  law <- counted(function(t) sin(3 * t))
  drive <- function(law) {
    scene_drive(
      c(1, 2), list(coupling_shaft(30, 0.1)),
      torque = list(torque_function(law, breaks_s = numeric()) + 0.5, NULL)
    )
  }
  motion <- trajectory(drive(law$f), c(0, 5))
  expect_lt(law$calls(), 500)
  exact <- trajectory(
    scene_drive(
      c(1, 2), list(coupling_shaft(30, 0.1)),
      torque = list(torque_sinusoid(1, 3, -pi / 2) + 0.5, NULL)
    ), c(0, 5), 1e-12
  )
  expect_equal(motion$omega_rad_per_s, exact$omega_rad_per_s, tolerance = 1e-8)
})

test_that("a law that is not smooth is called after a bounded search", {
  rough <- counted(function(t) c(0, 0, abs(sin(40 * t))))
  motion <- trajectory(scene_free(c(1, 1, 1), c(0, 0, 0), torque = rough$f), c(0, 10), 1e-6)
  whole <- floor(400 / pi)
  exact <- (2 * whole + 1 - cos(400 - whole * pi)) / 40
  expect_equal(motion$omega_z_rad_per_s[2], exact, tolerance = 1e-5)
})

test_that("what a law returns is checked where it is sampled, too", {
  free <- function(f) trajectory(scene_free(c(1, 2, 3), c(1, 1, 1), torque = f), 0:2)
  for (f in list(
    function(t) 1, function(t) "a", function(t) NULL, function(t) c(1, 2, 3, 4),
    function(t) Sys.Date() + 0:2
  )) {
    e <- expect_error(free(f), "three numbers", class = "rotdyn_error_torque")
    expect_identical(conditionCall(e)[[1]], quote(trajectory))
  }
  expect_error(free(function(t) c(0, 0, NaN)), class = "rotdyn_error_torque")
  expect_error(free(function(t) stop("mine")), "mine")
  expect_error(free(function(t) stats::rnorm(3)), class = "rotdyn_error_random")
  slope <- function(f) trajectory(scene_incline(body_sphere(1, 1), 10, force = f), 0:2)
  expect_error(slope(function(t) c(1, 2)), "one number", class = "rotdyn_error_torque")
})

test_that("a force that is another one each time is refused", {
  set.seed(1)
  scene <- scene_incline(body_sphere(1, 0.1), 10, force = function(time_s) stats::runif(1))
  expect_error(trajectory(scene, c(0, 1)), "two values", class = "rotdyn_error_random")
  # Before a model is chosen, where the law is sampled.
  expect_error(
    rotdyn:::sample_function(
      function(time_s) stats::runif(1), "force_n", list(form = "torque", unit = "N"), double(),
      0.005, c(0, 1), NULL
    ), "two values", class = "rotdyn_error_random"
  )
})
