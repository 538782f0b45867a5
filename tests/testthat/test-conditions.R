test_that("errors carry their class and the user's own call", {
  error <- tryCatch(body_disk(-1, 2), error = identity)
  expect_s3_class(error, c("rotdyn_error_value", "rotdyn_error"), exact = FALSE)
  expect_equal(error$call[[1]], quote(body_disk))
  error <- tryCatch(trajectory(article_scene(), c(2, 1)), error = identity)
  expect_s3_class(error, "rotdyn_error_time")
  expect_equal(error$call[[1]], quote(trajectory))
})

test_that("messages say what is wrong, the value, and the remedy", {
  expect_snapshot(error = TRUE, {
    body_disk(-1, 2)
    body_disk(c(1, 2), 2)
    body_disk("1", 2)
    torque_knots(c(0, 2, 1), c(0, 0, 0))
    torque_knots(1, 2)
    torque_function(3)
    torque_function(function(a, b) 1)
    resistance(1, coulomb_n_m = 2, static_n_m = 1)
    scene_axle(body_disk(0, 1))
    scene_axle("disk")
    trajectory(article_scene(), c(1, NA))
    trajectory(article_scene(), 1, model = "axle_free")
    trajectory(article_scene(), 1, accuracy = 1e-17)
    rolling_table(data.frame(beta = c(1, -2)))
    rolling_table(data.frame(x = 1))
    inertia_table(data.frame(object = "blob", mass_kg = 1, radius_m = 1))
  })
})

test_that("every status of the core has a kind that the help lists", {
  # A range failure, a torque failure, a budget failure: kinds come through from C.
  expect_error(
    trajectory(scene_axle(1, 1, resistance(-10)), 1000), class = "rotdyn_error_range"
  )
  kinds <- c("range", "torque", "budget", "step", "memory")
  expect_true(all(kinds %in% names(rotdyn:::error_kinds)))
})

test_that("what an argument is not is said, and not evaluated", {
  expect_snapshot(error = TRUE, {
    body_disk(1, 2, colour = stop("evaluated"))
    body_disk(1, 2, 3)
    scene_axle(1, axle = 3, tau = 4)
  })
  expect_error(body_disk(1, 2, colour = 3), class = "rotdyn_error_argument")
})

test_that("errors of shortcuts show the shortcut that the user called", {
  call_of <- function(expr) tryCatch(expr, error = function(e) as.character(conditionCall(e)[[1]]))
  expect_equal(call_of(spin_up(body = "a")), "spin_up")
  expect_equal(call_of(spin_up(time_s = NA)), "spin_up")
  expect_equal(call_of(spin_up(resistance = "a")), "spin_up")
  expect_equal(call_of(spin_up(torque = function() 1)), "spin_up")
  expect_equal(call_of(scene_gears(1:2, 2, theta0_rad = "a")), "scene_gears")
  expect_equal(call_of(suppressWarnings(scene_gears(c(1e308, 1e308), 0.1))), "scene_gears")
  expect_equal(call_of(scene_axle(1, function() 1)), "scene_axle")
  expect_equal(call_of(scene_pendulum(body_point(1e200), 1e200)), "scene_pendulum")
  verb <- function() audit(1)
  expect_equal(call_of(verb()), "audit")
  expect_equal(call_of(audit()), "audit")
  expect_equal(call_of(motion_events()), "motion_events")
})

test_that("plain messages have their lines with their signs", {
  sign <- paste0(cli::symbol$info, " ")
  said <- tryCatch(
    warn_quickly(c("One.", "Two.", "Three."), "range", NULL), warning = function(w) w
  )
  expect_identical(conditionMessage(said), paste0("One.\n", sign, "Two.\n", sign, "Three."))
  expect_s3_class(said, c("rotdyn_warning_range", "rotdyn_warning"))
  said <- tryCatch(inform_quickly(c("One.", "Two."), "missing"), message = function(m) m)
  expect_identical(conditionMessage(said), paste0("One.\n", sign, "Two.\n"))
  expect_identical(
    conditionMessage(tryCatch(inform_quickly("One.", "missing"), message = function(m) m)),
    "One.\n"
  )
})

test_that("errors of scenes that are drives show the constructor that the user called", {
  call_of <- function(expr) tryCatch(expr, error = function(e) as.character(conditionCall(e)[[1]]))
  expect_equal(call_of(scene_rotors(c(1, 2), 10, brake = 0)), "scene_rotors")
  expect_equal(call_of(scene_rotors(c(1, 2), 10, brake = list(brake(1)))), "scene_rotors")
  expect_equal(call_of(scene_gears(c(1, 2), 2, brake = 0)), "scene_gears")
  expect_equal(call_of(scene_clutch(1, 2, 5, brake = 0)), "scene_clutch")
  expect_equal(call_of(scene_clutch(1, 2, 5, brake = brake(1), start_s = NA)), "scene_clutch")
})
