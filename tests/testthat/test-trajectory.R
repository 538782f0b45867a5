test_that("summary and glance: the article's row, then the run", {
  motion <- spin_up()
  row <- summary(motion)
  expect_equal(names(row), rotdyn:::summary_columns)
  expect_equal(nrow(row), 1)
  expect_equal(row$moment_of_inertia_kg_m2, 0.0625)
  # mpmath: the zero of omega' on the falling ramp, where no row is.
  expect_equal(row$max_angular_velocity_rad_per_s, 22.053944064363792175, tolerance = 1e-14)
  expect_equal(row$max_angular_velocity_time_s, 4.3459541951727157399, tolerance = 1e-14)
  few <- summary(spin_up(time_s = 0:8))
  expect_equal(few[2:6], row[2:6], tolerance = 1e-14)
  expect_equal(summary(spin_up(time_s = 0:4))$max_angular_velocity_time_s, 4)
  expect_equal(row$max_angular_momentum_kg_m2_per_s, 0.0625 * row$max_angular_velocity_rad_per_s)
  expect_equal(
    row$max_rotational_kinetic_energy_j, 0.03125 * row$max_angular_velocity_rad_per_s^2
  )
  expect_ulps(row$final_theta_rad, 107.8586453330170947, 2)
  expect_equal(row$model, "axle_linear")
  expect_equal(row$error_kind, "bound")
  expect_equal(glance(motion), row)
})

test_that("the maxima are over the rows, with their sign", {
  down <- trajectory(scene_axle(2, -3), 1:3)
  expect_equal(summary(down)$max_angular_velocity_rad_per_s, -1.5)
  expect_equal(summary(down)$max_rotational_kinetic_energy_j, 20.25)
  expect_true(is.na(summary(down[0, ])$final_theta_rad))
})

test_that("values that were edited are not those of the run", {
  motion <- trajectory(scene_axle(1, torque_sinusoid(1, 2)), 0:10 / 2)
  expect_equal(summary(motion)$max_angular_velocity_rad_per_s, 0.5, tolerance = 1e-14)
  edits <- list(
    within_column = function(x) {
      x$omega_rad_per_s[3] <- 7
      x
    },
    cell = function(x) {
      x[3, "omega_rad_per_s"] <- 7
      x
    },
    column = function(x) {
      x[["omega_rad_per_s"]] <- 0.7 * x$time_s * (x$time_s == 10) + 7
      x
    }
  )
  for (edit in edits) {
    edited <- edit(motion)
    expect_output(print(edited), "the values are not those of the run")
    expect_identical(summary(edited)$max_angular_velocity_rad_per_s, 7)
    expect_identical(summary(edited)$error, NA_real_)
  }
  # Columns of one's own, or fewer, are no edit.
  more <- motion
  more$note <- 1
  fewer <- more[setdiff(names(motion), "rotational_kinetic_energy_j")]
  for (same in list(more, fewer, more[3:5, ])) {
    expect_identical(summary(same)$error, summary(motion)$error)
  }
})

test_that("maxima of the rows alone, where the model does not run again, come with a warning", {
  on <- TRUE
  law <- function(time_s, theta_rad, omega_rad_per_s) if (on) cos(time_s) else NaN
  motion <- trajectory(scene_axle(1, law), c(0, 3))
  expect_equal(summary(motion)$max_angular_velocity_rad_per_s, 1, tolerance = 1e-9)
  on <- FALSE
  for (verb in list(summary, glance)) {
    expect_warning(row <- verb(motion), "those of the rows", class = "rotdyn_warning_failed")
    expect_equal(row$max_angular_velocity_rad_per_s, sin(3), tolerance = 1e-9)
  }
})

test_that("spin_up is a shortcut for a scene", {
  t <- c(0, 2.5, 7)
  expect_equal(
    tibble::as_tibble(spin_up(time_s = t)), tibble::as_tibble(trajectory(article_scene(), t))
  )
  other <- spin_up(
    body_hoop(2, 3), 6, 0, time_s = 4, theta0_rad = 1, omega0_rad_per_s = 2
  )
  expect_equal(other$theta_rad, 1 + 2 * 4 + 0.5 * (6 / 18) * 16)
  expect_equal(nrow(spin_up()), 1000)
})

test_that("predict: any order, between the rows, NA for NA", {
  for (model in c("axle_linear", "axle_rk8pd")) {
    motion <- trajectory(article_scene(), 0:8, model = model)
    ahead <- predict(motion, c(5.3, NA, 0.2, 9, 5.3))
    expect_equal(ahead$time_s, c(5.3, NA, 0.2, 9, 5.3))
    expect_true(is.na(ahead$omega_rad_per_s[2]))
    expect_equal(ahead$omega_rad_per_s[1], ahead$omega_rad_per_s[5])
    exact <- trajectory(article_scene(), c(0.2, 5.3, 9))
    expect_equal(ahead$theta_rad[c(3, 1, 4)], exact$theta_rad, tolerance = 1e-9)
    expect_equal(nrow(predict(motion, numeric())), 0)
    expect_error(predict(motion, Inf), class = "rotdyn_error_time")
    expect_error(predict(motion, "a"), class = "rotdyn_error_type")
  }
})

test_that("base R: rows and columns keep the class while the key columns stand", {
  motion <- spin_up(time_s = 0:8)
  expect_s3_class(motion[1:3, ], "rot_trajectory")
  expect_s3_class(motion[1:3], "rot_trajectory")
  expect_s3_class(head(motion, 2), "rot_trajectory")
  expect_false(inherits(motion[c(1, 2)], "rot_trajectory"))
  expect_type(motion[["theta_rad"]], "double")
  expect_type(motion[, "theta_rad", drop = TRUE], "double")
  renamed <- motion
  names(renamed)[1] <- "t"
  expect_false(inherits(renamed, "rot_trajectory"))
  motion$label <- "a"
  expect_s3_class(motion, "rot_trajectory")
  expect_false(is.null(run_of(motion)))
  motion$omega_rad_per_s <- NULL
  expect_equal(class(motion), c("tbl_df", "tbl", "data.frame"))
  expect_null(run_of(motion))
  expect_false(inherits(tibble::as_tibble(spin_up(time_s = 0:8)), "rot_trajectory"))
})

test_that("dplyr verbs keep the class while the key columns stand", {
  skip_if_not_installed("dplyr")
  motion <- spin_up(time_s = 0:8)
  expect_s3_class(dplyr::filter(motion, time_s > 2), "rot_trajectory")
  expect_s3_class(dplyr::mutate(motion, rpm = omega_rad_per_s * 9.549297), "rot_trajectory")
  expect_s3_class(dplyr::arrange(motion, dplyr::desc(time_s)), "tbl_df")
  expect_equal(class(dplyr::select(motion, time_s)), c("tbl_df", "tbl", "data.frame"))
  expect_equal(class(dplyr::summarise(motion, n = dplyr::n())), c("tbl_df", "tbl", "data.frame"))
  expect_equal(class(dplyr::rename(motion, t = time_s)), c("tbl_df", "tbl", "data.frame"))
})

test_that("the error figure holds for any of the rows; of changed values it is unknown", {
  motion <- spin_up(time_s = 0:8)
  expect_identical(run_of(motion[1:2, ])$info$error, run_of(motion)$info$error)
  motion$omega_rad_per_s[3] <- 1
  expect_true(is.na(run_of(motion)$info$error))
  expect_match(tibble::tbl_sum(motion)[["Error"]], "unknown")
})

test_that("the header says model and error", {
  expect_snapshot(cat(format(spin_up(time_s = 0:2))[1:5], sep = "\n"))
})

test_that("a row at rest is no infinite error; large terms that cancel are a warning", {
  stopping <- scene_axle(2, -3, omega0_rad_per_s = 6)
  expect_silent(motion <- trajectory(stopping, 4))
  expect_equal(motion$omega_rad_per_s, 0)
  expect_lte(run_of(motion)$info$error, 1e-14)
  # theta oscillates with growing swings and ends where it began: each swing leaves its rounding.
  swing <- torque_knots(c(0, 1, 1, 3, 3, 4), c(1, 1, -1, -1, 1, 1) * 1e3)
  expect_warning(
    trajectory(scene_axle(1, swing), c(0, 4), accuracy = 2.5e-15), class = "rotdyn_warning_accuracy"
  )
})

test_that("an accuracy in degrees or rpm is one of the angle or of the speed", {
  skip_if_not_installed("units")
  # 600 rad and 60 rad/s or so.
  scene <- scene_axle(body_disk(2, 0.25), 1.8, resistance(0.03))
  t <- c(0, 10, 20)
  exact <- trajectory(scene, t)
  size <- max(exact$theta_rad)
  turned <- trajectory(scene, t, accuracy = units::set_units(0.1, "degree", mode = "standard"))
  wanted <- 0.1 * pi / 180
  expect_equal(attr(turned, "run")$accuracy * size / wanted, 0.9, tolerance = 1e-2)
  fast <- max(exact$omega_rad_per_s)
  speed <- trajectory(scene, t, accuracy = units::set_units(1, "rpm", mode = "standard"))
  expect_equal(attr(speed, "run")$accuracy * fast / (2 * pi / 60), 0.9, tolerance = 1e-2)
  expect_error(
    trajectory(scene, t, accuracy = units::set_units(1, "kg", mode = "standard")),
    class = "rotdyn_error_unit"
  )
})

test_that("the head says why the model was chosen, in one line", {
  why <- function(motion) grep("Why", format(motion), value = TRUE)
  expect_match(why(spin_up(time_s = 0:2)), "piecewise-linear torque, viscous resistance")
  expect_match(why(trajectory(article_scene(), 0:2, model = "axle_rk8pd")), "named in the call")
  # 23 characters stand before the reason.
  expect_true(all(nchar(rotdyn:::core_models()$why) <= 57))
})

test_that("a column beyond double precision has no finite error figure", {
  beyond <- list(
    scene_axle(1, omega0_rad_per_s = 1e200),
    scene_axle(1e200, 1e308),
    scene_axle(1, torque_spring(1e200), theta0_rad = 1e150),
    scene_axle(1e300, torque_motor(1e300, 1e-5), omega0_rad_per_s = 1e100),
    scene_axle(1, function(time_s) 1e200, omega0_rad_per_s = 1e100),
    scene_axle(inertia_knots(0:1, c(1e200, 1e-100)), omega0_rad_per_s = 1e-10),
    scene_rotors(c(1, 1e200), 1, omega0_rad_per_s = 1e200),
    scene_clutch(1, 1, 1e300, omega0_rad_per_s = c(1e300, 0))
  )
  for (scene in beyond) {
    expect_warning(x <- trajectory(scene, 0:1), "Beyond double", class = "rotdyn_warning_accuracy")
    expect_equal(summary(x)$error, Inf)
    expect_equal(audit(x)$verdict[1], NA_character_)
  }
  expect_silent(trajectory(scene_axle(1, 1, omega0_rad_per_s = 1e100), 0:1))
})

test_that("the largest values are those on the way, not those of the rows", {
  # The row is at the end of a period, where omega = 2 sin(10 t)/4 passes through zero.
  quiet <- expect_silent(trajectory(scene_axle(1, torque_sinusoid(5, 10)), 2 * pi * 100))
  expect_lte(summary(quiet)$error, 1e-11)
  swing <- expect_silent(trajectory(scene_axle(2, torque_spring(8), theta0_rad = 1), pi / 4 * 101))
  expect_lte(summary(swing)$error, 1e-12)
  still <- expect_silent(trajectory(scene_axle(2, torque_spring(8)), c(0, 10)))
  expect_lte(summary(still)$error, 1e-12)
  still <- expect_silent(trajectory(scene_axle(2, torque_spring(8, 0.3), theta0_rad = 0.3), 10))
  expect_lte(summary(still)$error, 1e-12)
})

test_that("the head says what the uncertainty of the body does to the motion", {
  set.seed(1)
  body <- body_density(
    function(x, y, z) 1 + x^2, domain_box(c(-1, -1, -1), c(1, 1, 1)), method = "monte_carlo",
    max_evaluations = 1000, accuracy = 0.5
  )
  on_axle <- function(...) scene_axle(body, ..., through = "centre")
  x <- trajectory(on_axle(1), c(0, 5))
  effect <- run_of(x)$body
  # theta = t^2/(2 I): a change of I by e changes the angle by e/(1 + e) of itself.
  expect_equal(effect$effect, effect$inertia / (1 + effect$inertia), tolerance = 1e-9)
  expect_gte(effect$inertia, body$error)
  expect_match(tibble::tbl_sum(x)[["Body"]], "changes the motion by about")
  expect_match(tibble::tbl_sum(x)[["Error"]], "bound")
  expect_null(run_of(trajectory(scene_axle(body_disk(2, 0.25), 1), 1))$body)
  expect_null(run_of(trajectory(scene_axle(0.3, 1), 1))$body)
  # On an incline a = g sin/(1 + I/(m r^2)).
  rough <- body_tensor(1, diag(c(0.004, 0.004, 0.004)))
  rough$error <- 1e-6
  effect <- run_of(trajectory(scene_incline(rough, 10, radius_m = 0.1), c(0, 5)))$body
  expect_equal(effect$inertia, 1.5e-6)
  expect_equal(effect$effect, 1.5e-6 * 0.4 / 1.4, tolerance = 1e-5)
  # Over many swings it grows with the phase.
  spring <- function(to) run_of(trajectory(on_axle(torque_spring(1e-4), NULL, 1), to))$body
  expect_gt(spring(4000)$effect, spring(40)$effect)
  expect_false(is.null(run_of(trajectory(scene_rotors(list(body, body), 10, torque = c(1, 0)),
                                         0:3))$body))
  expect_false(is.null(run_of(trajectory(scene_clutch(body, 3, 1, omega0_rad_per_s = c(4, 0)),
                                         0:3))$body))
})

test_that("an error figure refers to the largest values of the motion, not of its rows", {
  # theta = -sin(t), in closed form: 1e-4 at the only other row.
  scene <- scene_axle(1, torque_sinusoid(1, 1, -pi / 2), omega0_rad_per_s = -1)
  motion <- trajectory(scene, c(0, 2 * pi + 1e-4))
  expect_equal(motion$theta_rad[2], -sin(1e-4), tolerance = 1e-9)
  expect_gt(run_of(motion)$info$sizes[["theta"]], 0.9)
  expect_lt(run_of(motion)$info$error, 1e-13)
})

test_that("rows of one rotor are rows of the run, rows with another's number are not", {
  motion <- trajectory(scene_rotors(c(1, 2), 9, omega0_rad_per_s = c(1, 0)), 0:2)
  second <- motion[motion$rotor == 2, ]
  expect_identical(run_of(second)$info$error, run_of(motion)$info$error)
  motion$rotor <- rev(motion$rotor)
  expect_identical(run_of(motion)$info$error, NA_real_)
})

test_that("an error larger than the motion is not known, and every verb says so", {
  chaotic <- scene_axle(
    1, torque_gravity(1, 1, gravity_m_per_s2 = 1) + torque_sinusoid(1.5, 2 / 3), resistance(0.5),
    theta0_rad = 0.2
  )
  expect_warning(
    motion <- trajectory(chaotic, c(0, 200, 600)), "not known", class = "rotdyn_warning_accuracy"
  )
  expect_output(print(motion), "Error: +not known")
  expect_identical(glance(motion)$error, NA_real_)
  expect_identical(summary(motion)$error, NA_real_)
  found <- audit(motion)
  expect_identical(found$verdict, rep(NA_character_, 2))
  expect_identical(found$rounding, rep(NA_real_, 2))
  expect_output(print(found), "<rot_audit> no verdict")
  expect_identical(dim(augment(motion))[1], 3L)
  # Within the growth the figure is a number.
  expect_lt(glance(trajectory(chaotic, c(0, 20)))$error, 1e-9)
})

test_that("a body of one's own is not damped unless that is asked", {
  expect_equal(spin_up(2, torque = 3, time_s = 2)$omega_rad_per_s, 3)
  expect_equal(spin_up(2, 3, time_s = 2, resistance = 0.5)$damping_torque_n_m,
               -0.5 * 6 * (1 - exp(-0.5)))
  expect_false(all(spin_up(time_s = 0:2)$damping_torque_n_m == 0))
})

test_that("a motion is lost where its error is larger than the motion, and known", {
  lost <- rotdyn:::is_lost
  expect_true(lost(list(error = 1.5)))
  expect_true(lost(list(error = 1 + 1e-9)))
  expect_false(lost(list(error = 1)))
  expect_false(lost(list(error = Inf)) || lost(list(error = NaN)))
})

test_that("the end of a summary is the latest time, in whatever order the rows are", {
  final <- function(motion) glance(motion)$final_theta_rad
  reversed <- function(motion) motion[rev(seq_len(nrow(motion))), ]
  expect_equal(final(reversed(trajectory(scene_axle(0.5, torque = 2), 0:2))), 8)
  shaft <- trajectory(scene_rotors(1:2, 10, omega0_rad_per_s = 1:0), 0:2)
  expect_equal(final(reversed(shaft)), final(shaft))
})

test_that("times are a plain column, whatever they come in", {
  wheel <- scene_axle(1, 1)
  plain <- trajectory(wheel, c(1, 2, 3, 4))
  for (time_s in list(matrix(c(1, 2, 3, 4), 2), c(a = 1, b = 2, c = 3, d = 4), 1:4)) {
    motion <- trajectory(wheel, time_s)
    expect_null(attributes(motion$time_s))
    expect_identical(motion$time_s, plain$time_s)
    expect_identical(spin_up(1, 1, time_s = time_s)$theta_rad, plain$theta_rad)
    expect_null(attributes(spin_up(1, 1, time_s = time_s)$time_s))
  }
})
