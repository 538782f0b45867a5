test_that("every model has a whole record", {
  table <- models()
  expect_equal(table$model, c("axle_free", "axle_linear", "axle_rk8pd"))
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
  expect_equal(table$applies, c(FALSE, TRUE, TRUE))
  expect_match(table$reason[1], "torque is not zero")
  expect_match(table$reason[3], "costs more than axle_linear")
  expect_false(is.unsorted(table$cost))
  expect_equal(sum(table$chosen), 1)
})

test_that("an accuracy beyond an estimate rules the integrator out", {
  scene <- scene_axle(0.5, function(t) t)
  expect_error(choose_model(scene, 0:1, 1e-14), class = "rotdyn_error_accuracy")
  expect_error(trajectory(scene, 0:1, 1e-14), class = "rotdyn_error_accuracy")
  table <- choose_model(scene_axle(0.5, 1), 0:1, 1e-14)
  expect_match(table$reason[3], "exceeds the accuracy")
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
