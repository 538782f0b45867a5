# Constraints that their table in the core describes.
by_table <- function() Filter(function(one) !is.null(one$inputs), all_constraints())

test_that("constructors have the inputs of the core's table, with its defaults", {
  expect_true("hoop" %in% vapply(by_table(), `[[`, "", "id"))
  for (constraint in by_table()) {
    constructor <- formals(get(names(constraint$texts), mode = "function"))
    # Breaks are those of a law; what makes rotors, gears or a clutch a drive is no input of theirs.
    # A brake makes an axle a drive. What equations conserve is for R's audit alone.
    more <- switch(
      constraint$id, axle = "brake", rotors = , clutch = c("brake", "resistance"),
      equations = "conserved"
    )
    inputs <- setdiff(names(constraint$inputs), "breaks_s")
    expect_setequal(setdiff(names(constructor), c("...", more)), setdiff(inputs, more))
    for (name in inputs) {
      input <- constraint$inputs[[name]]
      none <- identical(constructor[[name]], quote(expr = ))
      expect_equal(none, input$required, info = name)
      if (!none && is.numeric(constructor[[name]])) {
        expect_identical(constructor[[name]], input$otherwise, info = name)
      }
    }
  }
})

test_that("the dictionary has the columns of the table, with their units", {
  for (constraint in by_table()) {
    table <- .Call(ffi_scene_table, constraint$id)
    known <- column_table()
    if (constraint$id == "equations") next # their user names them
    columns <- sub("^rotor_[0-9]+_", "rotor_1_", table$columns) # of all rotors, one entry
    expect_equal(setdiff(columns, known$name), character())
    expect_identical(known$unit[match(columns, known$name)], table$units)
  }
})

test_that("a record takes what it is given, and has the rest from the table", {
  for (constraint in by_table()) {
    expect_true(all(c("time_s", constraint$index) %in% constraint$keys))
    expect_true(all(constraint$keys %in% constraint$columns))
    models <- core_models()
    expect_setequal(names(constraint$models), models$model[models$constraint == constraint$id])
  }
})

test_that("calls of the glue with damaged scenes are errors", {
  bead <- scene_hoop(1, 2, 3)
  form <- constraint_of(bead)$form
  bead <- unclass(bead)
  expect_null(.Call(ffi_scene_fault, "hoop", form, bead))
  control <- c(1e-9, 1e6, 0, 0, 0, 0, 0)
  for (name in names(bead)) {
    for (bad in list("a", NaN, c(1, 2), list(), TRUE, -Inf)) {
      damaged <- bead
      damaged[[name]] <- bad
      expect_identical(.Call(ffi_scene_fault, "hoop", form, damaged), name)
      expect_error(.Call(ffi_scene_run, "hoop", damaged, "hoop_rk8pd", 0, control, NULL, NULL))
    }
  }
  expect_error(.Call(ffi_scene_run, "hoop", bead, "none", 0, control, NULL, NULL), "no such")
  expect_error(.Call(ffi_scene_table, "nothing"), "no such")
})

test_that("plain arguments, and those that R looks at first, give the same scene", {
  plain <- scene_hoop(0.05, 0.2, 9, theta0_rad = 1, static_friction = 0.1)
  named <- scene_hoop(c(m = 0.05), 0.2, 9, theta0_rad = 1L, static_friction = 0.1)
  expect_identical(named, plain)
  expect_identical(plain$kinetic_friction, 0.1)
  expect_type(scene_hoop(1L, 2L, 3L)$mass_kg, "double")
  ball <- body_sphere(6, 0.11)
  expect_identical(
    scene_incline(ball, 10L, v0_m_per_s = 2, force = NULL),
    scene_incline(ball, c(a = 10), v0_m_per_s = 2)
  )
  expect_identical(scene_incline(ball, 10, v0_m_per_s = 2)$omega0_rad_per_s, 2 / 0.11)
  chain <- scene_chain(c(1, 2), 1, 0.1)
  expect_identical(chain$links, "rods")
  expect_identical(scene_chain(c(a = 1, b = 2), 1, 0.1, links = "rods"), chain)
  if (requireNamespace("units", quietly = TRUE)) {
    expect_identical(
      scene_hoop(units::set_units(50, "g"), 0.2, 9, theta0_rad = 1, static_friction = 0.1), plain
    )
  }
  # Promises are evaluated once; what they raise arrives as it is.
  calls <- 0
  scene_hoop({
    calls <- calls + 1
    0.05
  }, 0.2, 9)
  expect_identical(calls, 1)
  expect_error(scene_hoop(stop("mine"), 0.2, 9), "mine")
  later <- function(mass) scene_hoop(mass, 0.2, 9)
  expect_error(later(), class = "rotdyn_error_missing")
  expect_error(scene_hoop(radius_m = 0.2, hoop_omega_rad_per_s = 9), class = "rotdyn_error_missing")
  expect_error(scene_hoop(TRUE, 0.2, 9), class = "rotdyn_error_type")
  expect_error(scene_hoop(NULL, 0.2, 9), class = "rotdyn_error_type")
})

test_that("the largest rate is in the summary of one body's angle alone", {
  largest <- function(...) any(startsWith(names(summary(trajectory(...))), "max_omega"))
  expect_true(largest(scene_hoop(1, 0.5, 6, theta0_rad = 0.3), 0:2, 1e-6))
  expect_false(largest(scene_chain(c(1, 1), c(1, 1), theta0_rad = c(1, 0.5)), 0:2, 1e-6))
})
