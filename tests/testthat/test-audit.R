test_that("the article's scene balances, with the work and heat of the closed form", {
  audit <- audited(spin_up())
  expect_equal(audit$verdict, "balanced")
  # Impulse: area under the torque. Heat and work against a fine trapezoid of the exact rows.
  expect_ulps(audit$torque_impulse_n_m_s, 3.6, 1)
  rows <- trajectory(article_scene(), seq(0, 8, length.out = 80001))
  trapezoid <- function(y) sum((y[-1] + y[-length(y)]) / 2) * 1e-4
  expect_equal(
    audit$work_j, trapezoid(rows$applied_torque_n_m * rows$omega_rad_per_s), tolerance = 1e-8
  )
  expect_equal(audit$dissipated_j, trapezoid(0.03 * rows$omega_rad_per_s^2), tolerance = 1e-8)
  expect_equal(audit$damping_impulse_n_m_s, -0.03 * 107.8586453330170947)
  expect_lt(abs(audit$energy_residual_j), 1e-12)
})

test_that("by hand: constant torque without resistance, and coasting", {
  # I = 2, tau = 3, t = 4: omega 6, theta 12, W = 36 = K.
  row <- audited(trajectory(scene_axle(2, 3), c(0, 4)))
  expect_equal(row$work_j, 36)
  expect_equal(row$dissipated_j, 0)
  expect_equal(row$kinetic_energy_change_j, 36)
  expect_equal(row$torque_impulse_n_m_s, 12)
  # Coasting with c/I = 0.5 for 3 s: K0 (1 - exp(-3)).
  coast <- scene_axle(2, resistance = resistance(1), omega0_rad_per_s = 5)
  row <- audited(trajectory(coast, c(0, 3)))
  expect_equal(row$dissipated_j, 25 * (1 - exp(-3)))
  expect_equal(row$work_j, 0)
  expect_equal(audited(trajectory(scene_axle(2, omega0_rad_per_s = 3), 0:3))$verdict, "balanced")
})

test_that("the rounding that an audit allows is some hundred roundings of its terms", {
  roundings <- function(motion, sizes) {
    a <- audit(motion)
    expect_true(all(abs(a$residual) <= a$rounding))
    max(a$rounding / sizes / .Machine$double.eps)
  }
  # 36 J and 12 kg m^2/s, as above.
  expect_lt(roundings(trajectory(scene_axle(2, 3), c(0, 4)), c(36, 12)), 100)
  # A spring of 100 N m/rad, 0.1 rad from its rest, after an eighth of its period.
  spring <- scene_axle(1, torque_spring(100), theta0_rad = 0.1)
  expect_lt(roundings(trajectory(spring, c(0, pi / 40)), c(0.25, sqrt(0.5))), 300)
  # A ball that rolls for 1 s: 5/7 of m g sin(30 degrees), and 2/5 m r v of its own.
  v <- 5 / 7 * 9.80665 / 2
  ball <- scene_incline(body_sphere(2, 0.1), 30, static_friction = 0.5)
  expect_lt(roundings(trajectory(ball, c(0, 1)), c(9.80665 * v / 2, 2 * v, 0.08 * v)), 300)
})

test_that("the integrator's ledger agrees with the closed form's", {
  exact <- audited(trajectory(article_scene(), 0:8))
  other <- audited(trajectory(article_scene(), 0:8, model = "axle_rk8pd"))
  expect_equal(other$work_j, exact$work_j, tolerance = 1e-11)
  expect_equal(other$dissipated_j, exact$dissipated_j, tolerance = 1e-11)
  expect_equal(other$verdict, "balanced")
})

test_that("fewer rows: the balance of what is left", {
  for (model in c("axle_linear", "axle_rk8pd")) {
    motion <- trajectory(article_scene(), 0:8, model = model)
    part <- audited(motion[3:6, ])
    whole <- audited(trajectory(article_scene(), 2:5, model = model))
    expect_equal(part$work_j, whole$work_j, tolerance = 1e-9)
    expect_equal(part$verdict, "balanced")
  }
  turned <- audited(trajectory(article_scene(), 0:8)[9:1, ])
  expect_equal(turned$work_j, -audited(trajectory(article_scene(), 0:8))$work_j)
  expect_equal(turned$verdict, "balanced")
})

test_that("a value that was edited is found out", {
  motion <- trajectory(article_scene(), 0:8)
  motion$omega_rad_per_s[9] <- motion$omega_rad_per_s[9] * (1 + 1e-12)
  expect_equal(audited(motion)$verdict, "unbalanced")
  motion <- trajectory(article_scene(), 0:8)
  motion$theta_rad[9] <- motion$theta_rad[9] + 1e-10
  expect_equal(audited(motion)$verdict, "unbalanced")
})

test_that("rows that are one or none; what is no trajectory", {
  expect_warning(one <- audit(trajectory(article_scene(), 3)), "time_s = c\\(0, 3\\)",
                 class = "rotdyn_warning_time")
  expect_equal(one$verdict, c("balanced", "balanced"))
  # At the start there is nothing to say; twice the same time may be a jump.
  expect_no_warning(audit(trajectory(article_scene(), 0)))
  expect_no_warning(audit(trajectory(article_scene(), c(3, 3))))
  expect_true(is.na(audited(trajectory(article_scene(), numeric()))$work_j))
  expect_error(audit(data.frame(time_s = 1)), class = "rotdyn_error_type")
})

test_that("a row for each balance, its terms nested", {
  for (motion in list(
    spin_up(time_s = 0:3), trajectory(scene_rotors(c(1, 2), 50, torque = c(3, 3)), 0:3),
    trajectory(scene_clutch(1, 2, 3, omega0_rad_per_s = c(9, 0)), 0:3)
  )) {
    a <- audit(motion)
    expect_s3_class(a, "rot_audit")
    expect_equal(names(a), c(rotdyn:::audit_columns, "terms"))
    expect_equal(a$balance, c("energy", "angular_momentum"))
    expect_equal(a$unit, c("J", "kg m^2/s"))
    residual <- a$change - a$supplied + a$dissipated
    expect_lte(max(abs(a$residual - residual)), 1e-6 * max(abs(residual)))
    for (i in 1:2) {
      sums <- tapply(a$terms[[i]]$value, a$terms[[i]]$role, sum)
      for (role in names(sums)) expect_equal(a[[role]][i], sums[[role]])
    }
    expect_setequal(setdiff(c(names(a), names(a$terms[[1]])), column_table()$name), character())
  }
})

test_that("an audit prints its balances", {
  # Round numbers: I = 2, tau = 3.
  expect_snapshot({
    audit(trajectory(scene_axle(2, 3), c(0, 4)))
    audit(trajectory(scene_rotors(c(1, 2), 8, torque = c(3, 3)), c(0, 1)))
    audit(trajectory(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)), c(0, 2)))
  })
})

test_that("where a balance cannot be drawn there is no verdict", {
  # K is beyond 1.8e308, omega is not.
  huge <- suppressWarnings(
    trajectory(scene_axle(2, resistance = resistance(-4), omega0_rad_per_s = 1), c(0, 200))
  )
  expect_true(is.na(audited(huge)$verdict))
})

test_that("a jump of the inertia does work, wherever it lies between the rows", {
  # I omega stays 10: the energy goes from 10 to 25 J.
  jump <- inertia_knots(c(1, 1), c(5, 2))
  for (model in list(NULL, "axle_rk8pd", "axle_radau")) {
    for (start in c(-1, 0, 1, 2)) {
      omega0 <- if (start < 1) 2 else 5
      scene <- scene_axle(jump, omega0_rad_per_s = omega0, start_s = start)
      for (t in list(c(0, 3), c(0, 1), c(1, 3), c(0, 1, 1, 3), 1)) {
        m <- trajectory(scene, t, model = model)
        a <- suppressWarnings(audited(m), "rotdyn_warning_time")
        done <- if (t[1] < 1) 15 else 0
        expect_equal(a$verdict, "balanced")
        expect_equal(a$inertia_work_j, done, tolerance = 1e-12)
        expect_equal(augment(m)$inertia_work_j[length(t)], done, tolerance = 1e-12)
      }
    }
  }
})

test_that("rows that are no longer numbers are refused by name", {
  m <- spin_up(time_s = 0:3)
  edited <- function(name, value) {
    m[[name]] <- value
    m
  }
  for (f in list(audit, augment.rot_trajectory)) {
    expect_error(f(edited("time_s", "a")), class = "rotdyn_error_type")
    expect_error(f(edited("omega_rad_per_s", "a")), class = "rotdyn_error_type")
    expect_error(f(edited("time_s", NA_real_)), class = "rotdyn_error_time")
  }
  expect_error(augment(m[, 1:3]), class = "rotdyn_error_type")
  expect_equal(audited(edited("time_s", 0:3))$verdict, "balanced") # integers
})

test_that("an audit prints four digits, or as many as asked", {
  wheel <- audit(spin_up())
  expect_match(capture.output(print(wheel))[3], "work of the torque +55.12 J")
  expect_match(capture.output(print(wheel, digits = 8))[3], "work of the torque +55.117706 J")
  expect_error(print(wheel, digits = 0), class = "rotdyn_error_value")
  expect_output(print(wheel["balance"]), "A tibble")
})

test_that("energies beyond double precision give a verdict of NA, soon", {
  motion <- suppressWarnings(
    spin_up(torque = torque_exponential(1, 2), omega0_rad_per_s = 1e200, time_s = c(0, 8))
  )
  expect_identical(expect_soon(audit(motion)$verdict[1], 20), NA_character_)
})

test_that("an audit does not repeat the warning of breaks", {
  scene <- scene_axle(1, function(t) if (t < pi) 1 else 0)
  motion <- suppressWarnings(trajectory(scene, 0:5))
  expect_no_warning(balances <- audit(motion))
  expect_identical(balances$verdict, c("balanced", "balanced"))
})

test_that("an audit looks more closely at a law than the motion did", {
  # A change of 1/500 of the range between the probes of the motion: 0.2 rad of 100 rad.
  missed <- 0
  for (at in 50 + seq(0, 0.36, 0.06)) {
    law <- function(time_s, theta_rad, omega_rad_per_s) ifelse(abs(theta_rad - at) < 0.1, 4, 0)
    motion <- trajectory(scene_axle(1, law, omega0_rad_per_s = 10), c(0, 10))
    found <- abs(motion$omega_rad_per_s[2] - sqrt(100 + 2 * 0.8)) < 1e-8
    missed <- missed + !found
    expect_identical(audit(motion)$verdict, rep(if (found) "balanced" else "unbalanced", 2))
    if (!found) expect_equal(audit(motion)$supplied[1], 0.8, tolerance = 1e-9)
  }
  expect_gt(missed, 0)
  push <- function(t, x, v) ifelse(abs(x - 5.03) < 0.01, 4, 0)
  ball <- scene_incline(body_sphere(1, 0.1), 0, static_friction = 1, v0_m_per_s = 1, force = push)
  coarse <- trajectory(ball, c(0, 10), resolution = 0.02)
  expect_identical(coarse$v_m_per_s[2], 1)
  closer <- trajectory(ball, c(0, 10), resolution = 0.001)
  expect_equal(closer$v_m_per_s[2], sqrt(1 + 2 * 0.08 / 1.4), tolerance = 1e-9)
  expect_identical(audit(closer)$verdict, rep("balanced", 3))
})

test_that("the allowance is that of the error figure: not more, for each constraint", {
  # Scene, sizes of energy (J) and of angular momentum, the largest allowance beside these. The last
  # is 10 to 30 times the figure of the motion.
  tilted <- attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  driven <- function(time_s) 3 * sin(time_s)
  cases <- list(
    list(scene_clutch(2, 0.5, 3, torque = list(1, NULL), omega0_rad_per_s = c(20, 0)), c(400, 40),
      1e-13),
    list(scene_drive(c(1, 0.4), coupling_gear(2), torque = list(3, NULL)), c(100, 15), 1e-13),
    list(
      scene_drive(
        c(1, 0.4, 0.2), list(coupling_clutch(2), coupling_shaft(30, 0.1)),
        torque = list(driven, NULL, NULL)
      ), c(10, 5), 3e-11
    ),
    list(
      scene_incline(body_sphere(2, 0.1), 30, static_friction = 0.1, v0_m_per_s = 2), c(200, 40),
      1e-13
    ),
    list(
      scene_incline(body_sphere(2, 0.1), 30, v0_m_per_s = 2,
        resistance = resistance(drag_n_s2_per_m2 = 0.3)), c(200, 40),
      3e-11
    ),
    list(
      scene_pivot(
        c(.0042, .0042, .002), c(0, 0, 60), mass_kg = .5, centre_m = c(0, 0, .08),
        attitude0 = tilted
      ), c(3.6, 0.12), 1e-12
    ),
    list(
      scene_pivot(
        c(1, 1.5, 2), c(3, 1, 2), mass_kg = 1, centre_m = c(.1, .2, .3), torque = c(-1, 2, 0.5)
      ), c(10, 6), 1e-9
    )
  )
  for (case in cases) {
    a <- audit(trajectory(case[[1]], c(0, 0.7, 5), 1e-9))
    expect_true(all(a$verdict == "balanced"))
    size <- ifelse(a$unit == "J", case[[2]][1], case[[2]][2])
    expect_lt(max((a$rounding / size)[a$unit != "1"]), case[[3]])
  }
})

test_that("the work of few steps is known no better than their error tests say", {
  # Errors of the steps cancel in the distance of two runs and not in the work: residuals of 2.6 and
  # 4.5 times what was allowed.
  scene <- scene_axle(1.16, function(time_s) 8 * sin(2.83 * time_s) + 4, omega0_rad_per_s = 0.155)
  for (accuracy in c(5.01e-5, 5.62e-5)) {
    a <- audit(trajectory(scene, c(0, 0.5, 1.4, 3.1, 5.08), accuracy))
    expect_identical(a$verdict, c("balanced", "balanced"))
    expect_lt(a$rounding[1], 1e-5 * abs(a$terms[[1]]$value[1]))
  }
})

test_that("a law that was looked at between times is looked at four times as closely", {
  run <- list(
    info = list(resolution = 0.25), scene = list(resolution = NULL), solved = list(a = 1),
    ledger = 3
  )
  closer <- rotdyn:::look_closer(run)
  expect_identical(closer$scene$resolution, 0.0625)
  expect_identical(closer$solved$resolution, 0.0625)
  expect_null(closer$ledger)
  for (resolution in list(NULL, 1, 1.5)) {
    run$info["resolution"] <- list(resolution)
    expect_identical(rotdyn:::look_closer(run), run)
  }
})

test_that("an audit prints one digit where one is asked for, and none is refused", {
  a <- audit(trajectory(scene_axle(2, 3), c(0, 4)))
  expect_output(print(a, digits = 1), "balanced")
  expect_error(print(a, digits = 0), class = "rotdyn_error_value")
  expect_error(print(a, digits = 23), class = "rotdyn_error_value")
})

test_that("an audit is written as a table, its terms as text", {
  a <- audit(spin_up(time_s = 0:3))
  file <- tempfile(fileext = ".csv")
  on.exit(unlink(file))
  write.csv(a, file, row.names = FALSE)
  read <- read.csv(file)
  expect_identical(names(read), names(a))
  expect_equal(read$residual, a$residual)
  expect_match(read$terms[2], "^supplied: impulse of the torque [0-9.]+ [|] dissipated: ")
  # Each value reads back, zeros included.
  values <- as.double(regmatches(read$terms[1], gregexpr("-?[0-9][0-9.e+-]*", read$terms[1]))[[1]])
  expect_identical(values, a$terms[[1]]$value)
  expect_s3_class(a[2, ]$terms[[1]], "tbl_df")
  expect_identical(as.character(a[2, ]$terms), read$terms[2])
  expect_identical(as.character(rbind(a, a)$terms), rep(read$terms, 2))
})

test_that("an audit without rows says so", {
  empty <- audit(spin_up(time_s = 0:3)[0, ])
  expect_identical(capture.output(print(empty)), c(
    "<rot_audit> no verdict", "energy",
    "  no values: rows, or energies in double precision, are missing",
    "angular momentum about the axle",
    "  no values: rows, or energies in double precision, are missing"
  ))
})
