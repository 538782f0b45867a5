test_that("all keys, ranges and references of the metadata hold", {
  known <- metadata()
  expect_silent(check_metadata())
  expect_identical(check_metadata(known), known)
  expect_true(all(c(
    "units", "quantities", "constants", "conventions", "relations", "models", "assumptions",
    "shapes", "sources", "cases"
  ) %in% names(known)))
  for (table in known) expect_s3_class(table, "tbl_df")
})

test_that("what the package knows is read from there", {
  known <- metadata()
  expect_identical(known$quantities$quantity, column_table()$name)
  expect_identical(known$shapes$shape, shapes()$shape)
  own <- models()
  expect_true(all(known$models$model %in% own$model))
  at <- match(known$models$model, own$model)
  expect_identical(known$models$equations, own$equations[at])
  expect_setequal(known$models$constraint_kind, known$constraints$constraint_kind)
  for (constraint in constraint_list()) {
    record <- constraint_of(structure(list(), class = constraint$scene_class))
    for (model in record$models) {
      takes <- known$model_effects$effect[known$model_effects$model == model$id]
      expect_setequal(takes, model$handles)
    }
  }
})

test_that("N m and J are two units; constants have uncertainty and source", {
  known <- metadata()
  two <- known$units[known$units$unit %in% c("N m", "J"), ]
  expect_identical(nrow(two), 2L)
  expect_identical(two$in_base[1], two$in_base[2])
  g <- known$constants[known$constants$symbol == "g", ]
  expect_identical(g$value, 9.80665)
  expect_identical(g$standard_uncertainty, 0)
  expect_true(all(known$constants$source %in% known$sources$source))
  # The value that functions take by default.
  expect_identical(formals(scene_incline)$gravity_m_per_s2, g$value)
  expect_identical(
    eval(formals(earth_drop)$rotation_rad_per_s),
    known$constants$value[known$constants$symbol == "Omega"]
  )
})

test_that("at least half of the assumptions are enforced by more than words", {
  enforced <- metadata()$assumptions$enforced
  expect_gte(sum(enforced != "stated"), length(enforced) / 2)
})

test_that("every counterexample is refused, with a reason that names the assumption", {
  skip_if_not_installed("yyjsonr")
  known <- metadata()
  refused <- known$assumptions[known$assumptions$enforced == "refused", ]
  expect_gt(nrow(refused), 35)
  for (i in seq_len(nrow(refused))) {
    scene <- read_scene(refused$counterexample[i])
    choice <- suppressWarnings(choose_model(scene, c(0, 1)))
    links <- known$model_assumptions
    models <- links$model[links$assumption == refused$assumption[i]]
    expect_gt(length(models), 0)
    rows <- choice[match(models, choice$model), ]
    expect_false(any(rows$applies), info = refused$assumption[i])
    expect_true(
      all(grepl(refused$names[i], rows$reason, fixed = TRUE)), info = refused$assumption[i]
    )
  }
})

test_that("what is dropped has a bound, and what is warned of warns", {
  # No closed form takes a spring and drag.
  weak <- scene_axle(1, torque_spring(4), resistance(quadratic_n_m_s2 = 1e-16), theta0_rad = 1)
  expect_match(
    paste(choose_model(weak, c(0, 1))$reason, collapse = " "),
    "quadratic drag ignored: it changes omega by at most", fixed = TRUE
  )
  expect_warning(scene_free(c(1, 1, 3), c(1, 0, 0)), class = "rotdyn_warning_inertia")
})

test_that("published values are those of the scenes", {
  skip_if_not_installed("yyjsonr")
  known <- metadata()
  values <- known$case_values[known$case_values$role == "published", ]
  scenes <- stats::setNames(known$cases$scene, known$cases$model_case)
  expect_gt(nrow(values), 10)
  for (i in seq_len(nrow(values))) {
    motion <- trajectory(read_scene(scenes[[values$model_case[i]]]), values$at_s[i])
    expect_lte(abs(motion[[values$quantity[i]]] - values$value[i]), values$tolerance[i])
  }
})

test_that("rows that break a key or a check are refused", {
  known <- metadata()
  broken <- function(says, table, ...) {
    edits <- list(...)
    for (name in names(edits)) known[[table]][[name]][1] <- edits[[name]]
    error <- expect_error(check_metadata(known), says, class = "rotdyn_error_metadata")
    expect_gt(nrow(error$faults), 0)
    expect_true(table %in% error$faults$table)
  }
  broken("unit is not in units", "quantities", unit = "furlong")
  broken("twice", "units", unit = known$units$unit[2])
  broken("name is there twice", "units", name = known$units$name[2])
  broken("si_factor > 0", "units", si_factor = 0)
  broken("exact = 0 OR", "constants", standard_uncertainty = 1)
  broken("missing", "relations", equation = NA)
  broken("convention is not in", "relations", convention = "none")
  broken("kind IN", "conventions", kind = "wish")
  broken("not in effects", "model_effects", effect = "magnetism")
  broken("counterexample IS NOT NULL", "assumptions", counterexample = NA)
  broken("LIKE", "assumptions", counterexample = "none")
  broken("BETWEEN", "shapes", dimension = 4L)
  broken("no whole number", "shapes", dimension = 1.5)
  known$units <- known$units[-1]
  expect_error(check_metadata(known), "columns", class = "rotdyn_error_metadata")
  expect_error(check_metadata(3), class = "rotdyn_error_type")
  expect_error(check_metadata(list(wishes = 1)), "no such table", class = "rotdyn_error_metadata")
})

test_that("what is no named list of tables is refused for that", {
  for (x in list(1, c(a = 1), list(1), data.frame(a = 1), metadata()[[1]], NULL, "a")) {
    expect_error(check_metadata(x), "named list of tables", class = "rotdyn_error_type")
  }
})

test_that("the kind of an assumption is that of its first word, by the order of kinds", {
  expect_identical(
    kind_of_words(c(
      "torque of the motor", "centre of mass", "a plane", "length", "friction of the gears",
      "rigid bodies"
    )),
    c("load", "mass", "contact", "size", "resistance", "rigidity")
  )
})

test_that("a dialect alone, or a file alone, gives statements", {
  text <- metadata(dialect = "sqlite")
  expect_type(text, "character")
  file <- tempfile(fileext = ".sql")
  on.exit(unlink(file))
  metadata(file = file)
  # But for the second at which each was made.
  plain <- function(lines) gsub("'[0-9-]+T[0-9:]+Z'", "'now'", paste(lines, collapse = "\n"))
  expect_match(plain(text), "'now'")
  expect_identical(plain(readLines(file, encoding = "UTF-8")), sub("\n$", "", plain(text)))
})
