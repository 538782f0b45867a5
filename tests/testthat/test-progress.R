test_that("a fraction from which no time can be estimated does not end a run", {
  old <- options(cli.progress_show_after = 0, cli.dynamic = FALSE)
  on.exit(options(old))
  run <- function(fractions) {
    progress <- rotdyn:::progress_bar("testing")
    environment(progress)$start <- proc.time()[[3]] - 10
    for (fraction in fractions) progress(fraction)
    TRUE
  }
  expect_true(suppressMessages(run(c(0, 1e-300, 1e-20, NaN, Inf, -1, 1))))
  for (fraction in c(0, 1e-300, 1e-20, NaN, Inf, -1, 1.5)) {
    progress <- rotdyn:::progress_bar("testing")
    state <- environment(progress)
    state$start <- proc.time()[[3]] - 10
    expect_no_message(progress(fraction))
    expect_null(state$bar)
    suppressMessages(progress(0.5))
    expect_false(is.null(state$bar) || state$failed)
  }
  # A second phase after the first is complete.
  expect_true(suppressMessages(run(c(0.5, 1, 0.2, 1))))
})

test_that("a bar comes a second after the first call", {
  old <- options(cli.progress_show_after = 0, cli.dynamic = FALSE)
  on.exit(options(old))
  progress <- rotdyn:::progress_bar("testing")
  before <- proc.time()[["elapsed"]]
  suppressMessages(progress(0.1))
  # By the clock, not by the processor's time.
  expect_gte(environment(progress)$start, before)
  expect_null(environment(progress)$bar)
  environment(progress)$start <- environment(progress)$start - 1
  suppressMessages(progress(0.2))
  expect_false(is.null(environment(progress)$bar))
})

test_that("a display that fails is given up", {
  progress <- rotdyn:::progress_bar("testing")
  state <- environment(progress)
  state$start <- proc.time()[[3]] - 10
  state$bar <- "no such bar"
  expect_silent(for (fraction in c(0.1, 0.2)) progress(fraction))
  expect_true(state$failed)
})

test_that("a time limit that ends within the display ends the run", {
  progress <- rotdyn:::progress_bar("testing")
  state <- environment(progress)
  state$start <- proc.time()[[3]] - 10
  rm("bar", envir = state)
  makeActiveBinding("bar", function() {
    setTimeLimit(elapsed = 0.05, transient = TRUE)
    repeat NULL
  }, state)
  expect_error(progress(0.1), gettext("reached elapsed time limit", domain = "R"), fixed = TRUE)
  setTimeLimit(elapsed = Inf)
  expect_false(state$failed)
})

test_that("a page that is rendered has no bar", {
  skip_if_not_installed("knitr")
  old <- options(cli.progress_show_after = 0, knitr.in.progress = TRUE)
  on.exit(options(old))
  progress <- rotdyn:::progress_bar("testing")
  environment(progress)$start <- proc.time()[[3]] - 10
  expect_no_message(for (fraction in c(0.1, 0.2)) progress(fraction))
  expect_null(environment(progress)$bar)
})

# With a bar from the first call on: a NaN fraction, a time left beyond 2^31 years, two phases.
test_that("runs end with their own errors and rows, not with the display's", {
  old <- options(cli.progress_show_after = 0, cli.dynamic = FALSE)
  on.exit(options(old))
  at_once <- function(expr) suppressMessages(expr)
  noise <- scene_axle(1, function(t) sin(1e14 * t), resistance(0.1)) # of the times' last bits
  rows <- at_once(suppressWarnings(
    trajectory(noise, c(0, 5), max_steps = 500, on_fail = "truncate")
  ))
  expect_equal(rows$time_s[1], 0)
  swing <- scene_axle(1, torque_sinusoid(1, 3) + torque_gravity(1, 1), theta0_rad = 1)
  expect_error(
    at_once(trajectory(swing, c(0, 1e22), max_steps = 1e4)), class = "rotdyn_error_budget"
  )
  pulse <- torque_function(function(time_s, theta_rad, omega_rad_per_s) {
    exp(-((time_s - 62.86) / 2.75)^2) + 0 * omega_rad_per_s
  }, numeric())
  # The whole pulse: 2.75 sqrt(pi)
  expect_equal(
    at_once(trajectory(scene_axle(1, pulse), 100))$omega_rad_per_s, 2.75 * sqrt(pi),
    tolerance = 1e-9
  )
})

test_that("a time limit ends a run at the poll after it, not six polls later", {
  n <- 300
  scene <- scene_rotors(rep(1:2, n / 2), rep(100, n - 1), resistance = rep(0.1, n))
  polls <- 0
  gc() # before the limit: one that ends in a finalizer is lost
  setTimeLimit(elapsed = 0.12, transient = TRUE)
  on.exit(setTimeLimit(elapsed = Inf))
  expect_error(
    .Call(rotdyn:::ffi_rotors_frequencies, scene, function(fraction) polls <<- polls + 1),
    gettext("reached elapsed time limit", domain = "R"), fixed = TRUE
  )
  expect_lte(polls, 3)
})

test_that("an error of a law after an event is the law's, and no part of the motion is returned", {
  law <- function(time_s, theta_rad, omega_rad_per_s) {
    if (time_s > 5) stop("the motor is gone")
    0
  }
  scene <- scene_axle(
    1, torque_function(law, breaks_s = 5), resistance(coulomb_n_m = 1), omega0_rad_per_s = 2
  )
  expect_identical(motion_events(trajectory(scene, c(0, 4)))$event, "stick")
  expect_error(trajectory(scene, c(0, 10)), "the motor is gone")
})
