# A constraint of its own: a body dropped in air, m v' = m g - k v |v|, height above the ground. It
# joins through the contract alone; every verb works on it.
G <- 9.8

scene_drop <- function(height_m, mass_kg = 2, drag_kg_per_m = 0.1, speed_m_per_s = 0) {
  structure(
    list(
      height_m = height_m, mass_kg = mass_kg, drag_kg_per_m = drag_kg_per_m,
      speed_m_per_s = speed_m_per_s, start_s = 0
    ),
    class = c("rot_scene_drop", "rot_scene")
  )
}

drop_columns <- function(scene, t, height, speed) {
  list(
    time_s = t, height_m = height, fall_speed_m_per_s = speed,
    drag_force_n = scene$drag_kg_per_m * speed * abs(speed)
  )
}

drop_result <- function(scene, t, height, speed, errors, kind = "none", done = length(t),
                        steps = 1, calls = 0) {
  sizes <- c(height = scene$height_m, speed = max(abs(c(scene$speed_m_per_s, speed))))
  crossed <- which(height[-1] < 0 & height[-length(height)] >= 0)
  list(
    columns = drop_columns(scene, t, height, speed),
    info = list(
      kind = kind, text = if (kind == "none") "ok" else "the step budget is used up",
      time_s = t[max(done, 1L)], rows_done = done, steps = steps, rejected = 0, rhs_calls = calls,
      errors = errors, sizes = sizes,
      error = if (length(t)) .Call(ffi_error_figure, errors, sizes) else 0
    ),
    events = if (length(crossed)) list(time_s = drop_ground(scene), event = "ground"),
    ledger = NULL
  )
}

drop_terminal <- function(scene) sqrt(scene$mass_kg * G / scene$drag_kg_per_m)

drop_ground <- function(scene) {
  if (scene$drag_kg_per_m == 0) {
    return(sqrt(2 * scene$height_m / G))
  }
  acosh(exp(scene$height_m * scene$drag_kg_per_m / scene$mass_kg)) * drop_terminal(scene) / G
}

drop_model <- function(id, ..., error_kind = "bound", handles, seconds,
                       why_not = function(scene, time_s) NULL, error = function(accuracy) 1e-14) {
  list(
    id = id, equations = "m v' = m g - k v |v|", assumptions = "still air", limits = "none",
    requires = "a body that falls", source = "elementary", error_kind = error_kind,
    handles = handles, why_not = why_not, why = "it falls", error = error,
    cost = function(scene, rows, accuracy) seconds * (1 + rows), ...,
    ledger = function(scene, run, from_s, to_s) {
      t <- seq(from_s, to_s, length.out = 1001)
      record <- rotdyn:::record_of(run)
      v <- record$run(scene, t, run$accuracy, 1e6, NULL, TRUE)$columns$fall_speed_m_per_s
      rule <- c(1, rep(c(4, 2), 499), 4, 1) * (to_s - from_s) / 3000
      c(
        work_j = sum(rule * v) * scene$mass_kg * G,
        heat_j = sum(rule * abs(v)^3) * scene$drag_kg_per_m
      )
    }
  )
}

drop_constraint <- function() {
  free <- drop_model(
    "drop_free", handles = character(), seconds = 1e-6,
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      drop_result(
        scene, time_s, scene$height_m - G * time_s^2 / 2, G * time_s,
        c(height = 1e-15 * scene$height_m, speed = 1e-15)
      )
    }
  )
  exact <- drop_model(
    "drop_exact", handles = "drag", seconds = 2e-6,
    why_not = function(scene, time_s) {
      if (length(time_s) && time_s[1] < 0) "it cannot run backward from rest"
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      vt <- drop_terminal(scene)
      x <- G * time_s / vt
      fallen <- scene$mass_kg / scene$drag_kg_per_m * (x + log1p(exp(-2 * x)) - log(2))
      drop_result(
        scene, time_s, scene$height_m - fallen, vt * tanh(x),
        c(height = 4e-15 * scene$height_m, speed = 4e-15 * vt)
      )
    }
  )
  stepped <- drop_model(
    "drop_rk4", handles = c("drag", "push"), error_kind = "estimate", seconds = 1e-3, adapts = TRUE,
    error = function(accuracy) max(accuracy, 1e-10),
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      n <- 2 * ceiling(accuracy^-0.25)
      if (n * length(time_s) > max_steps) {
        done <- floor(max_steps / n)
        time_s <- time_s[seq_len(done)]
      } else {
        done <- NULL
      }
      rate <- function(y) c(-y[2], G - scene$drag_kg_per_m / scene$mass_kg * y[2] * abs(y[2]))
      to <- function(n) {
        y <- c(scene$height_m, scene$speed_m_per_s)
        at <- 0
        vapply(time_s, function(t) {
          h <- (t - at) / n
          for (i in seq_len(n)) {
            k1 <- rate(y)
            k2 <- rate(y + h / 2 * k1)
            k3 <- rate(y + h / 2 * k2)
            k4 <- rate(y + h * k3)
            y <<- y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
          }
          at <<- t
          y
        }, double(2))
      }
      fine <- to(2 * n)
      apart <- 2e-15 * scene$height_m + apply(abs(fine - to(n)), 1, max)
      drop_result(
        scene, time_s, fine[1, ], fine[2, ], stats::setNames(apart, c("height", "speed")),
        kind = if (is.null(done)) "none" else "budget", done = done %||% length(time_s),
        steps = 2 * n * length(time_s), calls = 12 * n * length(time_s)
      )
    }
  )
  list(
    id = "drop", scene_class = "rot_scene_drop",
    title = function(run) "A body dropped in air",
    models = list(stepped, exact, free), # not in the order of cost
    effects = c(drag = "drag of the air", push = "a speed at the start"),
    effects_of = function(scene) {
      c(if (scene$drag_kg_per_m != 0) "drag", if (scene$speed_m_per_s != 0) "push")
    },
    without = function(scene, effects) {
      if ("drag" %in% effects) scene$drag_kg_per_m <- 0
      scene
    },
    drop_bound = function(scene, effects, record, time_s, call) {
      if (!identical(effects, "drag") || length(time_s) == 0L) {
        return(NULL)
      }
      t <- max(time_s)
      speed <- scene$drag_kg_per_m / scene$mass_kg * G^2 * t^3 / 3
      errors <- c(height = speed * t / 4, speed = speed)
      list(
        effects = effects, until_s = t, errors = errors,
        error = max(errors / c(scene$height_m, G * t)), each = speed / (G * t)
      )
    },
    columns = c("time_s", "height_m", "fall_speed_m_per_s", "drag_force_n"),
    keys = c("time_s", "height_m", "fall_speed_m_per_s"),
    measures = list(
      height = rotdyn:::measure("m", "height_m"),
      speed = rotdyn:::measure("m/s", "fall_speed_m_per_s")
    ),
    summary = function(x, run) {
      list(max_fall_speed_m_per_s = rotdyn:::largest(x$fall_speed_m_per_s))
    },
    balances = function(x, run, call) {
      ends <- x[c(1L, nrow(x)), ]
      ledger <- rotdyn:::record_of(run)$ledger(run$solved, run, ends$time_s[1], ends$time_s[2])
      v <- ends$fall_speed_m_per_s
      list(rotdyn:::balance(
        "energy", NA_character_, "J",
        c("change of kinetic energy" = 0.5 * run$scene$mass_kg * (v[2] - v[1]) * (v[2] + v[1])),
        c("work of the weight" = ledger[["work_j"]]), c("heat of the drag" = ledger[["heat_j"]]),
        1e-9 * max(1, ledger)
      ))
    },
    augment = function(x, run, edges, call) {
      list(
        power_w = run$scene$mass_kg * G * x$fall_speed_m_per_s,
        work_j = run$scene$mass_kg * G * (x$height_m[1] - x$height_m[match(edges, x$time_s)])
      )
    },
    panels = list(
      rotdyn:::panel("height (m)", c(height_m = "")),
      rotdyn:::panel("speed (m/s)", c(fall_speed_m_per_s = ""))
    )
  )
}

rotdyn:::join_constraint(drop_constraint())

test_that("the cheapest model that fits is chosen, whatever the order of the list", {
  scene <- scene_drop(100)
  choice <- choose_model(scene, 0:3)
  expect_equal(choice$model, c("drop_free", "drop_exact", "drop_rk4"))
  expect_equal(choice$applies, c(FALSE, TRUE, TRUE))
  expect_equal(choice$model[choice$chosen], "drop_exact")
  expect_match(choice$reason[1], "does not take drag of the air")
  expect_match(choice$reason[3], "drop_exact is cheaper")
  pushed <- choose_model(scene_drop(100, speed_m_per_s = 1), 0:3)
  expect_equal(pushed$model[pushed$chosen], "drop_rk4")
  expect_true(all(c("drop_free", "drop_exact", "drop_rk4") %in% models()$model))
  expect_equal(models()$constraint[models()$model == "drop_free"], "drop")
  expect_error(trajectory(scene, 0:3, model = "axle_free"), class = "rotdyn_error_model")
  expect_error(trajectory(scene, 0:3, model = "drop_free"), class = "rotdyn_error_model")
  expect_error(
    trajectory(scene_drop(9, speed_m_per_s = 1), 0:3, 1e-12),
    class = "rotdyn_error_accuracy"
  )
})

test_that("an effect is left out with its bound where nothing exact takes the scene", {
  constraint <- drop_constraint()
  constraint$models <- constraint$models[-2]
  rotdyn:::join_constraint(constraint)
  on.exit(rotdyn:::join_constraint(drop_constraint()))
  thin <- scene_drop(100, drag_kg_per_m = 1e-9)
  motion <- trajectory(thin, 0:3, 1e-6)
  expect_equal(run_of(motion)$model, "drop_free")
  expect_match(format(motion)[6], "drag of the air ignored")
  true <- thin$height_m - 2 / 1e-9 * log(cosh(G * 3 / drop_terminal(thin)))
  expect_gt(run_of(motion)$info$error, abs(motion$height_m[4] - true) / 100)
  expect_equal(run_of(trajectory(thin, 0:3, 1e-9))$model, "drop_rk4")
  expect_s3_class(predict(motion, c(30, 1)), "tbl_df") # beyond the rows the bound is made anew
})

test_that("every verb works on it", {
  scene <- scene_drop(50)
  motion <- trajectory(scene, seq(0, 6, by = 0.5))
  expect_s3_class(motion, "rot_trajectory")
  vt <- sqrt(2 * G / 0.1)
  expect_equal(motion$fall_speed_m_per_s, vt * tanh(G * motion$time_s / vt), tolerance = 1e-14)
  row <- summary(motion)
  expect_equal(row$max_fall_speed_m_per_s, max(motion$fall_speed_m_per_s))
  expect_equal(row$model, "drop_exact")
  expect_equal(generics::glance(motion), row)
  # Where log cosh(g t / vt) = h k/m.
  events <- motion_events(motion)
  expect_equal(events$event, "ground")
  expect_equal(log(cosh(G * events$time_s / vt)), 2.5, tolerance = 1e-12)
  expect_match(paste(format(motion), collapse = " "), "Events.*ground at")
  a <- audit(motion)
  expect_equal(a$balance, "energy")
  expect_equal(a$verdict, "balanced")
  expect_output(print(a), "work of the weight.*heat of the drag.*kinetic energy")
  motion$fall_speed_m_per_s[13] <- 40
  expect_equal(audit(motion)$verdict, "unbalanced")
  expect_true(is.na(run_of(motion)$info$error))
  motion <- trajectory(scene, c(0, 2, 4))
  expect_equal(generics::augment(motion)$work_j, 2 * G * (50 - motion$height_m))
  ahead <- predict(motion, c(1, NA, 0.5))
  expect_equal(ahead$fall_speed_m_per_s, vt * tanh(G * c(1, NA, 0.5) / vt), tolerance = 1e-14)
  expect_error(predict(motion, -1), class = "rotdyn_error_time")
})

test_that("rows survive a file, dplyr and a selection by their own bits", {
  times <- c(0, 1, 1 + 8 * .Machine$double.eps, 2)
  motion <- trajectory(scene_drop(100), times)
  path <- tempfile()
  saveRDS(motion, path)
  back <- readRDS(path)
  expect_identical(as.data.frame(back), as.data.frame(motion))
  expect_equal(audit(back), audit(motion))
  expect_false(is.na(run_of(back[c(3, 2), ])$info$error))
  swapped <- back
  swapped$time_s[2:3] <- swapped$time_s[3:2] # equal to 15 digits, other rows
  expect_true(is.na(run_of(swapped)$info$error))
  skip_if_not_installed("dplyr")
  some <- dplyr::filter(back, time_s > 0.5)
  expect_s3_class(some, "rot_trajectory")
  expect_false(is.na(run_of(some)$info$error))
  expect_false(inherits(dplyr::select(back, height_m), "rot_trajectory"))
})

test_that("accuracies with units, failures and budgets mean the same", {
  skip_if_not_installed("units")
  scene <- scene_drop(100, speed_m_per_s = 1)
  motion <- trajectory(scene, 0:2, units::set_units(1, "mm", mode = "standard"))
  expect_equal(run_of(motion)$accuracy, 0.9 * 1e-3 / 100)
  fast <- trajectory(scene, 0:2, units::set_units(1, "km/h", mode = "standard"))
  expect_equal(
    run_of(fast)$accuracy, 0.9 / 3.6 / max(abs(fast$fall_speed_m_per_s)), tolerance = 1e-3
  )
  failed <- expect_error(
    trajectory(scene, 0:9, 1e-8, max_steps = 1000), class = "rotdyn_error_budget"
  )
  expect_equal(failed$info$kind, "budget")
  expect_warning(
    part <- trajectory(scene, 0:9, 1e-8, max_steps = 1000, on_fail = "truncate"),
    class = "rotdyn_warning_truncated"
  )
  expect_equal(part$time_s, 0:4)
})

test_that("it is measured beside its other models, and drawn", {
  expect_warning(measured <- work_precision(
    scene_drop(100), 0:3, accuracies = c(1e-2, 1e-4), min_batch_s = 1e-4, batches = 2
  ), NA)
  expect_true(all(c("height_error", "speed_error") %in% names(measured)))
  expect_equal(unique(measured$model), c("drop_exact", "drop_rk4"))
  # Each against the other.
  expect_equal(unique(measured$reference[measured$model == "drop_exact"]), "drop_rk4")
  expect_equal(unique(measured$reference[measured$model == "drop_rk4"]), "drop_exact")
  expect_true(all(measured$covered[measured$model == "drop_rk4"]))
  skip_if_not_installed("ggplot2")
  falls <- trajectory(scene_drop(100), seq(0, 6, by = 0.5))
  expect_error(
    animate_motion(falls, "a.gif"), "moving pictures.*rot_scene_drop", class = "rotdyn_error_type"
  )
  plot <- ggplot2::autoplot(falls)
  expect_silent(built <- ggplot2::ggplot_build(plot))
  expect_equal(levels(plot$data$panel), c("height (m)", "speed (m/s)"))
  expect_equal(plot$labels$title, "A body dropped in air")
})

test_that("the columns of a run are those that its constraint lists", {
  scenes <- list(
    scene_axle(1, 2), scene_rotors(c(1, 2), 9), scene_clutch(1, 2, 3), scene_drop(9)
  )
  for (scene in scenes) {
    constraint <- rotdyn:::constraint_of(scene)
    expect_equal(names(trajectory(scene, c(0, 1))), constraint$columns)
    expect_true(all(constraint$keys %in% constraint$columns))
  }
})

test_that("a scene that no constraint has is an error", {
  rm("rot_scene_drop", envir = rotdyn:::registry)
  expect_error(trajectory(scene_drop(1), 0), class = "rotdyn_error_type")
})

test_that("the package's constraints are listed first, in their order, then those that joined", {
  listed <- names(rotdyn:::own_constraints())
  expect_identical(head(names(rotdyn:::all_constraints()), length(listed)), listed)
  assign("a_toy_of_this_test", list(), envir = rotdyn:::registry)
  on.exit(rm("a_toy_of_this_test", envir = rotdyn:::registry))
  all <- names(rotdyn:::all_constraints())
  expect_identical(head(all, length(listed)), listed)
  expect_true("a_toy_of_this_test" %in% utils::tail(all, -length(listed)))
})
