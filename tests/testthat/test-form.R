with_class <- function(...) structure(list(), class = c(...))

test_that("forged objects are refused at the door of every verb", {
  axle <- with_class("rot_scene_axle", "rot_scene")
  shaft <- with_class("rot_scene_rotors", "rot_scene")
  clutch <- with_class("rot_scene_clutch", "rot_scene")
  for (scene in list(axle, shaft, clutch)) {
    expect_error(trajectory(scene, 0:1), "valid scene of this version", class = "rotdyn_error_type")
    expect_error(choose_model(scene, 0:1), class = "rotdyn_error_type")
    expect_error(work_precision(scene, 0:1), class = "rotdyn_error_type")
    expect_error(print(scene), class = "rotdyn_error_type")
  }
  expect_error(stopping(axle), class = "rotdyn_error_type")
  expect_error(shaft_modes(shaft), class = "rotdyn_error_type")
  body <- with_class("rot_body")
  expect_error(print(body), "not a valid body of this version", class = "rotdyn_error_type")
  expect_error(moment_of_inertia(body, "z"), class = "rotdyn_error_type")
  expect_error(principal_axes(body), class = "rotdyn_error_type")
  expect_error(inertia_tensor(body), class = "rotdyn_error_type")
  expect_error(check_inertia(body), class = "rotdyn_error_type")
  expect_error(inertia_table(list(body)), class = "rotdyn_error_type")
  expect_error(join_bodies(body, body_disk(1, 1)), class = "rotdyn_error_type")
  expect_error(place_body(body, c(0, 0, 0)), class = "rotdyn_error_type")
  expect_error(scene_axle(body), class = "rotdyn_error_type")
  expect_error(scene_pendulum(body, 1), class = "rotdyn_error_type")
  expect_error(scene_rotors(list(1, body), 1), class = "rotdyn_error_type")
  expect_error(scene_axle(with_class("rot_inertia_knots")), class = "rotdyn_error_type")
  expect_error(scene_axle(1, with_class("rot_torque")), class = "rotdyn_error_type")
  expect_error(with_class("rot_torque") + 1, class = "rotdyn_error_type")
  expect_error(scene_axle(1, 1, with_class("rot_resistance")), class = "rotdyn_error_type")
  expect_error(
    body_density(function(x, y, z) 1, with_class("rot_domain")), class = "rotdyn_error_type"
  )
})

test_that("a forged inertia tensor is refused", {
  forged <- structure(diag(3), class = "rot_inertia_tensor")
  expect_error(principal_axes(forged), class = "rotdyn_error_type")
  expect_error(check_inertia(forged), class = "rotdyn_error_type")
  expect_error(body_tensor(1, forged), class = "rotdyn_error_type")
  expect_error(print(forged), class = "rotdyn_error_type")
  expect_error(2 * forged, class = "rotdyn_error_type")
  expect_error(-2 * with_class("rot_torque"), class = "rotdyn_error_type")
  expect_error(torque_polynomial(0:1, sin), class = "rotdyn_error_type")
})

test_that("a damaged part is named, at any depth", {
  scene <- scene_axle(1, torque_sinusoid(1, 2) + 3, resistance(1))
  cut <- scene
  cut$resistance$viscous_n_m_s <- "1"
  expect_error(trajectory(cut, 0:1), "resistance$viscous_n_m_s", fixed = TRUE)
  cut <- scene
  cut$torque$laws[[1]]$x <- 1 # the core would read two more
  expect_error(trajectory(cut, 0:1), "torque", fixed = TRUE)
  cut <- torque_motor(2, 300)
  cut$stall_torque_n_m <- Sys.Date() # R refuses its product
  expect_error(-2 * cut, "stall_torque_n_m|torque law", class = "rotdyn_error_type")
  cut <- scene
  cut$start_s <- NULL
  expect_error(trajectory(cut, 0:1), "start_s")
  cut <- scene_rotors(c(1, 2), 5)
  cut$resistance <- 1
  expect_error(trajectory(cut, 0:1), "resistance")
  knots <- torque_knots(0:1, 0:1)
  knots$time_s <- c(1, 0)
  expect_error(scene_axle(1, knots), class = "rotdyn_error_type")
  bowl <- body_hemisphere(1, 0.1)
  bowl$detail$centre_error_m <- list()
  expect_error(join_bodies(bowl, body_disk(1, 0.1)), "detail$centre_error_m", fixed = TRUE)
})

test_that("a damaged trajectory is refused by every verb", {
  motion <- spin_up(time_s = 0:2)
  verbs <- list(
    audit, augment, glance, summary, motion_events, function(x) predict(x, 1), format,
    if (requireNamespace("ggplot2", quietly = TRUE)) ggplot2::autoplot
  )
  damage <- list(
    function(run) NULL, function(run) 1,
    function(run) { run$scene <- NULL; run },
    function(run) { run$solved$resistance <- 1; run },
    function(run) { run$model <- "none"; run },
    function(run) { run$info$errors <- NULL; run }
  )
  for (spoil in damage) {
    bad <- motion
    attr(bad, "run") <- spoil(attr(bad, "run"))
    for (verb in Filter(Negate(is.null), verbs)) {
      expect_error(verb(bad), "not a valid trajectory of this version", class = "rotdyn_error_type")
    }
  }
})

test_that("every scene, body and law that the package makes has its form", {
  fault <- function(x, form) .Call(rotdyn:::ffi_form_fault, x, form)
  laws <- list(
    torque_constant(1), torque_knots(0:1, 0:1), torque_function(function(t) t),
    torque_gravity(1, 1), torque_motor(1, 1), torque_curve(0:1, 1:0), torque_pulse(0, 1, 1),
    torque_steps(0:1, 0:1),
    torque_exponential(1, 1), torque_polynomial(0:1, 1), torque_spring(1), torque_sinusoid(1, 1)
  )
  for (law in c(laws, list(Reduce(`+`, laws[-6])))) {
    expect_null(fault(law, rotdyn:::torque_form))
    expect_null(fault(scene_axle(1, law), rotdyn:::axle_constraint()$form))
  }
  for (shape in shapes()$shape) {
    make <- get0(paste0("body_", shape), asNamespace("rotdyn"))
    if (is.null(make)) next # a point that slides has a row in tables, and no body
    numbers <- rep(1, sum(names(formals(make)) != "..."))
    body <- tryCatch(do.call(make, as.list(numbers)), rotdyn_error = function(e) NULL)
    if (!is.null(body)) expect_null(fault(body, rotdyn:::body_form))
  }
})

test_that("what was dropped is looked at before it is printed", {
  motion <- trajectory(scene_axle(1, resistance = resistance(0.1), omega0_rad_per_s = 1), 0:2)
  attr(motion, "run")$dropped <- "nothing"
  expect_error(print(motion), "dropped", class = "rotdyn_error_type")
})

test_that("a trajectory of which any part was replaced prints, or is refused", {
  motion <- trajectory(scene_axle(1, torque_function(function(time_s) 1)), 0:2)
  run <- attr(motion, "run")
  for (part in c(names(run), "body", "step_s")) {
    forged <- motion
    attr(forged, "run")[[part]] <- 7
    printed <- tryCatch(utils::capture.output(print(forged)), rotdyn_error = identity)
    expect_true(is.character(printed) || inherits(printed, "rotdyn_error_type"), label = part)
  }
  for (part in c(names(run$info), "step_s")) {
    forged <- motion
    attr(forged, "run")$info[[part]] <- list()
    printed <- tryCatch(utils::capture.output(print(forged)), rotdyn_error = identity)
    expect_true(is.character(printed) || inherits(printed, "rotdyn_error_type"), label = part)
  }
})

test_that("damaged couplings and brakes are refused", {
  forged <- coupling_clutch(2)
  forged["capacity_n_m"] <- list(NULL)
  expect_error(print(forged), class = "rotdyn_error_type")
  expect_error(scene_drive(c(1, 2), forged), "coupling", class = "rotdyn_error_type")
  scene <- scene_drive(c(1, 2), coupling_clutch(2), brake = list(brake(1), NULL))
  damaged <- scene
  damaged$couplings[[1]]["capacity_n_m"] <- list(NULL)
  expect_error(trajectory(damaged, 1), "couplings", class = "rotdyn_error_type")
  # What the form takes and the core does not, and a class that is no part.
  damaged <- scene
  damaged$couplings[[1]]$static_ratio <- 0.5
  expect_error(trajectory(damaged, 1), "couplings", class = "rotdyn_error_type")
  damaged <- scene
  class(damaged$couplings[[1]]) <- c("rot_coupling_chain", "rot_coupling")
  expect_error(trajectory(damaged, 1), "couplings", class = "rotdyn_error_type")
  damaged <- scene
  damaged$brake[[1]]$from_s <- NaN
  expect_error(trajectory(damaged, 1), "brake", class = "rotdyn_error_type")
})

test_that("damaged bodies, laws and fits are refused, or have no outline", {
  body <- body_disk(2, 0.1)
  body$mass_kg <- -1
  expect_error(print(body), "mass_kg", class = "rotdyn_error_type")
  scene <- scene_rotors(list(body_disk(2, 0.1), 3), 10)
  scene$bodies <- function() 1
  expect_error(trajectory(scene, 1), "bodies", class = "rotdyn_error_type")
  body <- body_disk(2, 0.1)
  body$size_m <- double()
  expect_null(rotdyn:::body_solids(body))
  time_s <- seq(0, 10, by = 0.1)
  omega <- 20 * exp(-time_s / 5) + 0.01 * sin(seq_along(time_s))
  fit <- fit_coast_down(data.frame(time_s = time_s, omega_rad_per_s = omega))
  for (part in c("runs", "losses")) {
    forged <- fit
    attr(forged, "fit")[[part]] <- switch(part, runs = list(), losses = "nonsense")
    expect_error(print(forged), part, class = "rotdyn_error_type")
  }
  law <- torque_function(function(time_s) time_s)
  law$arguments <- NA
  skip_if_not_installed("ggplot2")
  expect_error(ggplot2::autoplot(law), "torque law", class = "rotdyn_error_type")
})

test_that("a number that is none is refused in each part that is a number", {
  damped <- resistance(0.1, 0.2, 0.3, 0.4)
  for (part in names(damped)) {
    for (wrong in list(NaN, NA_real_, Inf, c(1, 2), double())) {
      forged <- damped
      forged[[part]] <- wrong
      expect_error(print(forged), part, class = "rotdyn_error_type")
    }
  }
})

test_that("whole numbers and flags with a class are no numbers of a form", {
  takes <- function(x, kind) {
    is.list(rotdyn:::check_form(list(x = x), list(x = kind), "x", "thing", rlang::current_env()))
  }
  expect_true(takes(3L, "count"))
  expect_true(takes(TRUE, "flag"))
  for (x in list(factor(3L), structure(3L, class = "odd"), Sys.Date())) {
    expect_error(takes(x, "count"), class = "rotdyn_error_type")
  }
  expect_error(takes(structure(TRUE, class = "odd"), "flag"), class = "rotdyn_error_type")
})

test_that("a tensor of other numbers or another shape is none", {
  tensor <- inertia_tensor(body_box(1, 0.1, 0.2, 0.3))
  whole <- tensor
  storage.mode(whole) <- "integer"
  expect_error(principal_axes(whole), class = "rotdyn_error_type")
  flat <- tensor
  attr(flat, "dim") <- c(1L, 9L)
  expect_error(principal_axes(flat), class = "rotdyn_error_type")
})
