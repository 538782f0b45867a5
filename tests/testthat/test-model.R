test_that("every model has a whole record", {
  table <- models()
  expect_equal(table$model[1:2], c("axle_free", "axle_linear"))
  expect_equal(anyDuplicated(table$model), 0L)
  expect_false(anyNA(table))
  text <- table[vapply(table, is.character, TRUE)]
  expect_true(all(vapply(text, function(x) all(nzchar(x)), TRUE)))
  expect_true(all(table$error_kind %in% c("bound", "estimate")))
})

test_that("the cheapest model that fits is chosen, and says why", {
  choice <- function(...) choose_model(scene_axle(0.5, ...), 0:10)
  chosen <- function(...) choice(...)$model[choice(...)$chosen]
  expect_equal(chosen(), "axle_free")
  expect_equal(chosen(torque_knots(0:1, c(0, 0))), "axle_free")
  expect_equal(chosen(2), "axle_linear")
  expect_equal(chosen(NULL, resistance(0.1)), "axle_linear")
  expect_equal(chosen(article_torque()), "axle_linear")
  expect_equal(chosen(function(t) t), "axle_rk8pd")

  table <- choice(2)
  row <- function(model) table[table$model == model, ]
  expect_false(row("axle_free")$applies)
  expect_match(row("axle_free")$reason, "does not take a torque")
  expect_false(row("axle_pendulum")$applies)
  expect_true(all(row("axle_rk8pd")$applies, row("axle_drag")$applies))
  expect_match(row("axle_rk8pd")$reason, "axle_linear is cheaper")
  expect_false(is.unsorted(table$cost_s))
  expect_equal(sum(table$chosen), 1)
})

test_that("each closed form is chosen for the scene it was made for", {
  model <- function(...) run_of(trajectory(scene_axle(...), c(0.5, 1)))$model
  steps <- torque_steps(c(0, 0.3), c(1, -1))
  expect_equal(model(1, torque_motor(1, 10) + article_torque(), resistance(0.1)), "axle_linear")
  expect_equal(model(1, torque_sinusoid(1, 2), resistance(0.1)), "axle_forced")
  expect_equal(model(1, torque_exponential(1, 2) + article_torque()), "axle_forced")
  expect_equal(model(1, torque_polynomial(c(0, 1), 1:17)), "axle_forced")
  expect_equal(model(1, torque_polynomial(c(0, 1), 1:18)), "axle_rk8pd")
  expect_equal(model(1, steps, resistance(0.1, 0.2, 0.3)), "axle_drag")
  expect_equal(model(1, article_torque(), resistance(0.1, coulomb_n_m = 0.3)), "axle_bands")
  expect_equal(model(1, torque_curve(c(0, 10), c(1, 0)), resistance(0.1)), "axle_bands")
  expect_equal(model(1, article_torque(), resistance(0.1, 0.2)), "axle_rk8pd")
  expect_equal(model(inertia_knots(0:1, 1:2), steps, NULL, 0, 1), "axle_skater")
  expect_equal(model(inertia_knots(0:1, 1:2), steps, resistance(0.1), 0, 1), "axle_rk8pd")
  expect_equal(model(1, torque_spring(3) + article_torque(), resistance(0.1)), "axle_oscillator")
  expect_equal(model(1, torque_spring(3) + torque_sinusoid(1, 2)), "axle_oscillator")
  expect_equal(model(1, torque_gravity(1, 2), NULL, 1), "axle_pendulum")
  expect_equal(model(1, torque_gravity(1, 2), resistance(0.1), 1), "axle_rk8pd")
  expect_equal(model(1, torque_gravity(1, 2) + 1, NULL, 1), "axle_rk8pd")
})

test_that("an accuracy beyond an estimate rules the integrator out", {
  scene <- scene_axle(0.5, function(t) t)
  expect_error(choose_model(scene, 0:1, 1e-14), class = "rotdyn_error_accuracy")
  expect_error(trajectory(scene, 0:1, 1e-14), class = "rotdyn_error_accuracy")
  table <- choose_model(scene_axle(0.5, 1), 0:1, 1e-14)
  expect_match(table$reason[table$model == "axle_rk8pd"], "exceeds the accuracy")
  expect_error(choose_model(scene_axle(0.5, 1), 0:1, 1e-16), class = "rotdyn_error_accuracy")
  for (bad in list(0, -1, 2, NA_real_, "a", c(0.1, 0.2))) {
    expect_error(choose_model(scene, 0:1, bad), class = "rotdyn_error")
  }
})

test_that("a model by name", {
  scene <- article_scene()
  expect_equal(run_of(trajectory(scene, 0:8, model = "axle_rk8pd"))$model, "axle_rk8pd")
  expect_error(trajectory(scene, 0:8, model = "axle_free"), class = "rotdyn_error_model")
  expect_error(trajectory(scene, 0:8, model = "euler"), class = "rotdyn_error_model")
  expect_error(trajectory(scene, 0:8, model = 2), class = "rotdyn_error_model")
  expect_error(choose_model("scene", 0:8), class = "rotdyn_error_type")
})

test_that("a choice prints the chosen model and its reason first, costs with a unit", {
  choice <- choose_model(article_scene(), 0:8)
  text <- capture.output(print(choice))
  expect_equal(text[1], "<rot_model_choice> axle_linear")
  expect_match(text[2], "why +piecewise-linear torque, viscous resistance: closed form")
  expect_match(text[4], "cost +[0-9.]+ (us|ns) predicted")
  heads <- match(c("also apply:", "do not apply:"), text)
  expect_true(all(diff(c(4, heads)) > 0))
  of <- function(lines) sub("^  ([a-z0-9_]+) .*", "\\1", grep("^  axle_", lines, value = TRUE))
  expect_equal(of(text[heads[1]:heads[2]]), choice$model[choice$applies & !choice$chosen])
  named <- choice$model[grepl("only where it is named", choice$reason)]
  expect_equal(of(text[heads[2]:length(text)]), setdiff(choice$model[!choice$applies], named))
  expect_equal(text[length(text)], "by name alone: axle_euler, axle_semi_implicit, axle_rk4")
  expect_true(all(nchar(text) <= 80))
  # Without its columns it is a tibble.
  expect_output(print(choice[c("model", "cost_s")]), "A tibble")
})

test_that("seconds are shown in the unit that suits them", {
  expect_equal(
    rotdyn:::format_seconds(c(1.234, 0.0567, 2.51e-6, 8.2e-7, 0)),
    c("1.2 s", "57 ms", "2.5 us", "820 ns", "0 ns")
  )
})

test_that("a choice prints as a table once columns or rows are gone", {
  choice <- choose_model(scene_axle(1, 0.3), 0:3)
  expect_output(print(choice), "<rot_model_choice> axle_")
  for (part in list(choice[c("model", "chosen")], choice[!choice$chosen, ], choice[0, ])) {
    said <- utils::capture.output(print(part))
    expect_false(any(grepl("<rot_model_choice>", said)))
  }
})

test_that("a motion without a size has the accuracy of 1e-9, whatever the unit asked for", {
  skip_if_not_installed("units")
  still <- trajectory(scene_axle(1), 0:2, units::set_units(1e-3, "rad"))
  expect_identical(glance(still)$accuracy, 1e-9)
})
