test_that("a law that draws random numbers is recognised at once, by its own class", {
  fails <- function(scene, ...) {
    expect_soon(
      expect_error(
        trajectory(scene, 10, ...), "two values for the same", class = "rotdyn_error_random"
      ),
      20
    )
  }
  set.seed(1)
  noise <- function(time_s) rnorm(1)
  of_state <- function(time_s, theta_rad, omega_rad_per_s) 1 + 1e-4 * rnorm(1)
  coin <- function(time_s, theta_rad, omega_rad_per_s) sample(c(-1, 1), 1)
  calls <- 0
  counter <- function(time_s, theta_rad, omega_rad_per_s) {
    calls <<- calls + 1
    sin(calls)
  }
  for (law in list(noise, of_state, coin, counter)) {
    fails(scene_axle(1, law))
    fails(scene_axle(1, torque_function(law, breaks_s = numeric())))
    fails(scene_drive(c(1, 1), coupling_shaft(10), torque = list(NULL, law)))
  }
  slips <- coupling_clutch(function(time_s) 2 + runif(1))
  fails(scene_drive(c(1, 1), slips, omega0_rad_per_s = 1:2))
  fails(scene_free(1:3, c(1, 1, 1), torque = function(time_s, omega, attitude) rnorm(3)))
  fails(scene_axle(1, of_state), model = "axle_radau")
  # From a rate on alone: the integrator sees it where its steps fail.
  late <- function(time_s, theta_rad, omega_rad_per_s) {
    1 + if (omega_rad_per_s > 5) rnorm(1) else 0
  }
  fails(scene_axle(1, torque_function(late, breaks_s = numeric())))
  expect_error(angular_impulse(noise, 0, 1), class = "rotdyn_error_random")
})

test_that("a law that counts its calls and repeats its values is none", {
  calls <- 0
  counted <- function(time_s, theta_rad, omega_rad_per_s) {
    calls <<- calls + 1
    -theta_rad
  }
  motion <- trajectory(scene_axle(1, counted, theta0_rad = 1), pi)
  expect_equal(motion$theta_rad, -1, tolerance = 1e-9)
  expect_gt(calls, 100)
  # An iterative solver that starts from its last result repeats itself to its tolerance.
  last <- 0
  warm <- function(time_s, theta_rad, omega_rad_per_s) {
    last <<- last * 1e-11
    last <<- last + cos(time_s)
    last
  }
  motion <- trajectory(scene_axle(1, torque_function(warm, breaks_s = numeric())), 1, 1e-6)
  expect_equal(motion$omega_rad_per_s, sin(1), tolerance = 1e-6)
})

test_that("the message names the first time at which the values differ", {
  calls <- 0
  late <- function(time_s) {
    calls <<- calls + 1
    ifelse(time_s > 5, calls, 1)
  }
  expect_error(
    trajectory(scene_axle(1, late), 10), "At 7.19 s it returned", class = "rotdyn_error_random"
  )
  expect_error(
    check_repeats(function(time_s) {
      calls <<- calls + 1
      calls + time_s
    }, 2, 12, NULL),
    "At 2 s it returned", class = "rotdyn_error_random"
  )
})
