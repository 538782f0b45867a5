# Short batches: what is tested here does not depend on how well the cost is known.
measure <- function(scene = article_scene(), time_s = 0:8, ...) {
  work_precision(scene, time_s, ..., min_batch_s = 1e-4, batches = 2)
}
pendulum <- function() {
  scene_axle(
    2, torque_function(function(t, theta, omega) -5 * sin(theta), breaks_s = numeric()),
    theta0_rad = 1
  )
}

test_that("every model that fits, at every accuracy it promises", {
  measured <- measure(accuracies = 10^-c(6, 9, 14))
  expect_s3_class(measured, "rot_work_precision")
  expect_equal(names(measured), work_precision_columns)
  expect_setequal(setdiff(names(measured), column_table()$name), character())
  for (accuracy in 10^-c(6, 9, 14)) {
    choice <- choose_model(article_scene(), 0:8, accuracy)
    expect_setequal(measured$model[measured$accuracy == accuracy], choice$model[choice$applies])
  }
  closed <- measured[measured$model == "axle_linear", ]
  expect_equal(unique(closed$method), "closed form")
  expect_equal(unique(closed$error_kind), "bound")
  expect_true(all(closed$floor) && all(closed$rhs_calls == 0))
  stepped <- measured[measured$model == "axle_rk8pd", ]
  expect_equal(unique(stepped$method), "rk8pd")
  expect_true(all(measured$reference[measured$model != "axle_linear"] == "axle_linear"))
  expect_false("axle_linear" %in% closed$reference) # never itself
  expect_lt(stepped$reference_error[1], 1e-14)
  expect_true(all(measured$cost_s > 0 & measured$cost_s <= measured$cost_median_s))
  # A run's own figures.
  motion <- trajectory(article_scene(), 0:8, 1e-9, "axle_rk8pd")
  row <- stepped[stepped$accuracy == 1e-9, ]
  expect_identical(row$error, summary(motion)$error)
  expect_equal(row$rhs_calls, summary(motion)$rhs_calls)
  expect_equal(row$steps, summary(motion)$steps)
  balance <- audited(motion)
  # The work, 54 J in all, is the largest of the energies.
  expect_within(row$energy_residual, abs(balance$energy_residual_j) / balance$work_j, 1e-12)
})

test_that("models are names, whatever steps are asked for", {
  for (steps_s in list(NULL, c(0.1, 0.2))) {
    expect_error(
      work_precision(scene_axle(1), 0:1, models = 1e16, steps_s = steps_s),
      class = "rotdyn_error_model"
    )
  }
})

test_that("the true error is that of the rows against the reference", {
  measured <- measure(models = "axle_rk8pd", accuracies = 1e-6)
  exact <- trajectory(article_scene(), 0:8, 1e-14)
  motion <- trajectory(article_scene(), 0:8, 1e-6, "axle_rk8pd")
  far <- function(column) {
    size <- run_of(exact)$info$sizes[[sub("_.*", "", column)]]
    max(abs(motion[[column]] - exact[[column]])) / size
  }
  expect_within(measured$theta_error, far("theta_rad"), 1e-12)
  expect_within(measured$omega_error, far("omega_rad_per_s"), 1e-12)
  expect_identical(measured$true_error, max(measured$theta_error, measured$omega_error))
  expect_false(measured$floor)
  expect_true(measured$covered)
})

test_that("peers are measured alike: their errors, what they say, what cannot be told", {
  scene <- article_scene()
  exact <- trajectory(scene, 0:8, 1e-14)
  size <- run_of(exact)$info$sizes
  off <- function(theta, omega, ...) {
    function(scene, time_s, accuracy) {
      list(
        theta_rad = exact$theta_rad + c(theta * size[["theta"]], double(8)),
        omega_rad_per_s = exact$omega_rad_per_s - c(double(8), omega * size[["omega"]]), ...
      )
    }
  }
  measured <- measure(
    models = "axle_linear", accuracies = 1e-3,
    peers = list(
      silent = off(1e-5, 1e-7), honest = off(1e-5, 1e-4, error = 2e-4, rhs_calls = 7L, steps = 3),
      liar = off(1e-5, 0, error = 1e-6), exact = off(0, 0), lucky = off(0, 0, error = 1e-17)
    )
  )
  expect_equal(measured$model, c("axle_linear", "silent", "honest", "liar", "exact", "lucky"))
  expect_equal(measured$method, c("closed form", rep("peer", 5)))
  expect_equal(measured$theta_error[2:4], rep(1e-5, 3), tolerance = 1e-9)
  expect_equal(measured$omega_error[2:3], c(1e-7, 1e-4), tolerance = 1e-7)
  expect_equal(measured$true_error[2:4], c(1e-5, 1e-4, 1e-5), tolerance = 1e-7)
  expect_equal(measured$floor, c(TRUE, FALSE, FALSE, FALSE, TRUE, TRUE))
  expect_equal(measured$covered[-1], c(NA, TRUE, FALSE, NA, NA))
  expect_within(measured$true_error[5], 3 * measured$reference_error[5], 1e-12)
  expect_equal(measured$rhs_calls[2:3], c(NA, 7))
  expect_equal(measured$steps[2:3], c(NA, 3))
})

test_that("without a closed form the integrator at its best is the truth, with its own error", {
  measured <- measure(pendulum(), accuracies = c(1e-4, 1e-12))
  first <- measured[1, ]
  best <- summary(trajectory(pendulum(), 0:8, 1e-13, first$reference))
  expect_equal(best$error_kind, "estimate")
  expect_identical(first$reference_error, best$error)
  stepped <- measured[measured$model == "axle_rk8pd", ]
  expect_equal(stepped$floor, c(FALSE, TRUE))
  expect_true(stepped$covered[1])
  # Period 4 sqrt(I/5) K(sin(1/2)): at rest again where it started (mpmath, 50 digits).
  period <- 4 * sqrt(2 / 5) * 1.6749939160926131782
  home <- measure(
    pendulum(), c(0, period), models = character(),
    peers = list(home = function(scene, time_s, accuracy) {
      list(theta_rad = c(1, 1), omega_rad_per_s = c(0, 0))
    }), accuracies = 1
  )
  expect_lt(home$true_error, 1e-12)
})

test_that("a reference of one's own", {
  scene <- article_scene()
  exact <- trajectory(scene, 0:8, 1e-14)
  mine <- list(
    theta_rad = exact$theta_rad * (1 + 1e-3), omega_rad_per_s = exact$omega_rad_per_s, error = 1e-5
  )
  measured <- measure(models = "axle_linear", accuracies = 1e-6, reference = mine)
  largest <- max(abs(exact$theta_rad))
  expect_equal(measured$theta_error, 1e-3 / 1.001, tolerance = 1e-9)
  expect_equal(measured$omega_error, 3e-5)
  expect_equal(measured$reference, "given")
  expect_false(measured$covered)
  coarse <- trajectory(scene, 0:8, 1e-3, "axle_rk8pd")
  by_run <- measure(models = "axle_linear", accuracies = 1e-6, reference = coarse)
  expect_equal(by_run$reference_error, summary(coarse)$error)
  expect_true(by_run$floor)
  expect_error(measure(reference = exact[1:3, ]), class = "rotdyn_error_size")
  expect_error(measure(reference = list(1)), class = "rotdyn_error_type")
  expect_error(measure(reference = 3), class = "rotdyn_error_type")
  mine$error <- -1
  expect_error(measure(reference = mine), class = "rotdyn_error_value")
  mine$theta_rad <- 1
  expect_error(measure(reference = mine), class = "rotdyn_error_size")
  exact$theta_rad[3] <- 0
  expect_error(measure(reference = exact), class = "rotdyn_error_value")
})

test_that("an accuracy that nobody promises has no row; nothing at all is a table too", {
  measured <- measure(accuracies = c(1e-15, 1e-6))
  expect_equal(unique(measured$accuracy), 1e-6)
  none <- measure(accuracies = 1e-15)
  expect_equal(dim(none), c(0L, length(work_precision_columns)))
  expect_type(none$floor, "logical")
  expect_type(none$model, "character")
  expect_output(print(none), "Work and precision")
})

test_that("warnings come once, failures are named and cost no other row", {
  unknown <- scene_axle(1, torque_function(function(t) if (t < pi) 1 else 0))
  warned <- testthat::capture_warnings(measured <- measure(unknown, 0:5, accuracies = 10^-c(3, 6)))
  expect_length(warned, 1)
  expect_match(warned, "breaks_s")
  expect_gt(nrow(measured), 1)
  sometimes <- function(scene, time_s, accuracy) {
    if (accuracy < 1e-4) stop("no {brace} today")
    list(theta_rad = 0 * time_s, omega_rad_per_s = 0 * time_s)
  }
  failed <- expect_warning(
    measured <- measure(
      models = "axle_linear", accuracies = 10^-c(3, 6),
      peers = list(sometimes = sometimes, short = function(...) list(theta_rad = 1))
    ),
    class = "rotdyn_warning_failed"
  )
  expect_match(conditionMessage(failed), "3 runs failed")
  expect_match(conditionMessage(failed), "no {brace} today", fixed = TRUE)
  expect_equal(measured$model, c("axle_linear", "axle_linear", "sometimes"))
  expect_error(
    measure(scene_axle(1, torque_function(function(t) stop("mine"), numeric())), 0:1), "mine"
  )
})

test_that("cost is processor time of one call", {
  skip_on_cran()
  spin <- function(seconds) {
    end <- .Call(ffi_clock_cpu) + seconds
    while (.Call(ffi_clock_cpu) < end) NULL
  }
  still <- function(time_s) list(theta_rad = 0 * time_s, omega_rad_per_s = 0 * time_s)
  measured <- work_precision(
    article_scene(), 0:8, character(), 1,
    peers = list(
      short = function(scene, time_s, accuracy) {
        spin(0.002)
        still(time_s)
      },
      long = function(scene, time_s, accuracy) {
        spin(0.02)
        still(time_s)
      },
      asleep = function(scene, time_s, accuracy) {
        Sys.sleep(0.02)
        still(time_s)
      }
    ),
    min_batch_s = 0.004, batches = 3
  )
  expect_true(all(measured$cost_s[1:2] >= c(0.002, 0.02)))
  expect_true(all(measured$cost_s[1:2] < 1.5 * c(0.002, 0.02)))
  expect_lt(measured$cost_s[3], 0.01)
})

test_that("steps of fixed length, each length a run: their errors fall as their orders say", {
  block <- scene_free(c(1, 2, 3), c(0.1, 2, 0.1))
  run <- function(...) {
    work_precision(block, 0:5, accuracies = 1e-9, min_batch_s = 1e-4, batches = 1, ...)
  }
  steps <- c(0.02, 0.01)
  measured <- run(steps_s = steps)
  fixed <- measured[is.na(measured$accuracy), ]
  expect_setequal(fixed$model, c("free_euler", "free_semi_implicit", "free_rk4", "free_split"))
  expect_equal(fixed$step_s, rep(steps, 4))
  expect_true(all(is.na(measured$step_s[!is.na(measured$accuracy)])))
  expect_true(all(fixed$reference == "free_exact"))
  order <- function(model) log2(Reduce(`/`, fixed$true_error[fixed$model == model]))
  expect_equal(order("free_euler"), 1, tolerance = 0.1)
  expect_equal(order("free_semi_implicit"), 1, tolerance = 0.1)
  expect_equal(order("free_rk4"), 4, tolerance = 0.1)
  # Only those named; without lengths the step that trajectory() takes.
  named <- run(models = c("free_exact", "free_rk4"))
  expect_equal(named$model, c("free_exact", "free_rk4"))
  alone <- suppressWarnings(trajectory(block, 0:5, model = "free_rk4"), "rotdyn_warning_accuracy")
  expect_equal(named$step_s[2], run_of(alone)$info$step_s)
  skip_if_not_installed("ggplot2")
  plot <- ggplot2::autoplot(measured)
  labels <- ggplot2::layer_data(plot, length(plot$layers))$label
  expect_true("  2e-2 s to 1e-2 s" %in% labels)
})

test_that("bad arguments", {
  expect_error(measure(models = "axle_linear", steps_s = 0.1), class = "rotdyn_error_model")
  expect_error(measure(steps_s = 0), class = "rotdyn_error_value")
  expect_error(work_precision(), class = "rotdyn_error_missing")
  expect_error(work_precision(1, 0:8), class = "rotdyn_error_type")
  expect_error(measure(time_s = double()), class = "rotdyn_error_size")
  expect_error(measure(models = "axle_magic"), class = "rotdyn_error_model")
  expect_error(measure(models = 1), class = "rotdyn_error_model")
  expect_error(measure(accuracies = 0), class = "rotdyn_error_value")
  expect_error(measure(accuracies = NA), class = "rotdyn_error_value")
  expect_error(measure(peers = list(function(...) 1)), class = "rotdyn_error_type")
  expect_error(measure(peers = list(a = 1)), class = "rotdyn_error_type")
  expect_error(work_precision(article_scene(), 0:8, batches = 0), class = "rotdyn_error_value")
  expect_error(measure(peer = 1), class = "rotdyn_error_argument")
})

test_that("the header says what was measured, and stays with the rows", {
  measured <- measure(accuracies = 1e-6)
  header <- tibble::tbl_sum(measured)
  expect_match(header[["Reference"]], "axle_linear, error")
  expect_match(header[["Cost"]], "9 rows, 2 batches of 0.1 ms, torque in C")
  expect_match(tibble::tbl_sum(measured[nrow(measured), ])[["Reference"]], "axle_linear")
  expect_false("Reference" %in% names(tibble::tbl_sum(measured[c("model", "cost_s")])))
  expect_match(tibble::tbl_sum(measured["reference"])[["Reference"]], "axle_linear")
  expect_match(
    tibble::tbl_sum(measure(pendulum(), 0:1, accuracies = 1e-3))[["Cost"]], "an R function"
  )
})

test_that("an error of the choice shows the user's call", {
  scene <- scene_axle(1, 1, resistance(coulomb_n_m = 0.1))
  e <- expect_error(work_precision(scene, -1), class = "rotdyn_error_time")
  expect_equal(as.character(conditionCall(e)[[1]]), "work_precision")
})

test_that("more batches than anybody waits for are refused", {
  expect_error(work_precision(scene_axle(1), 1, batches = 1e16), class = "rotdyn_error_value")
  expect_error(work_precision(scene_axle(1), 1, min_batch_s = 1e9), class = "rotdyn_error_value")
})
