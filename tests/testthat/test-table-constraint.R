# Constraints that their table in the core describes.
by_table <- function() Filter(function(one) !is.null(one$inputs), all_constraints())

test_that("constructors have the inputs of the core's table, with its defaults", {
  expect_true("hoop" %in% vapply(by_table(), `[[`, "", "id"))
  for (constraint in by_table()) {
    constructor <- formals(get(names(constraint$texts), mode = "function"))
    expect_setequal(setdiff(names(constructor), "..."), names(constraint$inputs))
    for (name in names(constraint$inputs)) {
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
    known <- rotdyn_columns()
    expect_equal(setdiff(table$columns, known$name), character())
    expect_identical(known$unit[match(table$columns, known$name)], table$units)
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
  control <- c(1e-9, 1e6, 0, 0, 0, 0)
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
  expect_null(.Call(ffi_scene_table, "axle"))
})
