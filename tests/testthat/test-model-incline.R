ball <- function(...) body_sphere(6, 0.11, ...)

test_that("a bowling ball slides, then rolls", {
  # physicsforums.com 394359: a = 1.86 m/s^2, alpha = 42.3 rad/s^2; closed form for the rest.
  lane <- scene_incline(
    ball(), 0, static_friction = 0.19, v0_m_per_s = 8.1, omega0_rad_per_s = 0,
    gravity_m_per_s2 = 9.8
  )
  motion <- trajectory(lane, c(0, 1, 1.2429031765, 3), event_rows = TRUE)
  expect_named(motion, rotdyn:::columns_of_motion("incline"))
  # The event has a row of its own, between those asked for.
  expect_equal(motion$event, c(NA, NA, "roll", NA, NA))
  expect_equal(motion$x_m[3], 8.629299196, tolerance = 1e-9)
  expect_identical(motion$slip_speed_m_per_s[3], 0)
  motion <- motion[is.na(motion$event), ]
  expect_equal(8.1 - motion$v_m_per_s[2], 1.862, tolerance = 1e-14)
  expect_equal(motion$omega_rad_per_s[2], 42.31818182, tolerance = 1e-9)
  expect_equal(motion_events(motion)$event, "roll")
  expect_equal(motion_events(motion)$time_s, 1.242903176, tolerance = 1e-9)
  expect_equal(motion$x_m[3], 8.629299196, tolerance = 1e-9)
  expect_equal(motion$v_m_per_s[4], 5.785714286, tolerance = 1e-9)
  expect_equal(motion$rolling, c(FALSE, FALSE, TRUE, TRUE))
  # loss = (m/2) beta/(1 + beta) u^2
  expect_equal(motion$slip_heat_j[4], 3 * 0.4 / 1.4 * 8.1^2, tolerance = 1e-14)
  expect_equal(summary(motion)$roll_time_s, 1.242903176, tolerance = 1e-9)
})

test_that("a ball struck at 4/5 of its radius above the centre ends at 9/7 of the speed", {
  # omega0 = 5 v0 h/(2 R^2); BGU e_22_8_422
  struck <- scene_incline(
    ball(), 0, static_friction = 0.2, v0_m_per_s = 2, omega0_rad_per_s = 2.5 * 2 * 0.8 / 0.11
  )
  motion <- trajectory(struck, c(0, 60))
  expect_equal(motion$v_m_per_s[2], 2 * 9 / 7, tolerance = 1e-14)
})

test_that("the sphere of Drake's test, and rows of University Physics", {
  drake <- trajectory(scene_incline(
    body_sphere(0.1, 0.05), 15, static_friction = 1, kinetic_friction = 0.5,
    gravity_m_per_s2 = 9.81
  ), 1)
  expect_equal(drake$v_m_per_s, 1.813582023, tolerance = 1e-9)
  expect_equal(drake$friction_force_n, -0.07254328093, tolerance = 1e-9)
  # UP11-04, UP11-05: a = 3.5 m/s^2, 15.75 m after 3 s
  marble <- trajectory(scene_incline(body_sphere(1, 1), 30, gravity_m_per_s2 = 9.8), c(1, 3))
  expect_equal(marble$v_m_per_s[1], 3.5, tolerance = 1e-14)
  expect_equal(marble$x_m[2], 15.75, tolerance = 1e-14)
  # UP11-13, UP11-14: 8.34 m up the slope, 2.38 s
  up <- scene_incline(
    body_spherical_shell(1, 0.1), 30, v0_m_per_s = -7, gravity_m_per_s2 = 9.8
  )
  motion <- trajectory(up, c(0, 5), event_rows = TRUE)
  expect_equal(motion_events(motion)$time_s, 2.380952381, tolerance = 1e-9)
  expect_equal(motion$event, c(NA, "reverse", NA))
  expect_equal(motion$x_m[2], -8.333333333, tolerance = 1e-9)
  expect_equal(summary(motion)$highest_x_m, -8.333333333, tolerance = 1e-9)
})

test_that("the table of slip to roll, as a user would call it", {
  table <- utils::read.csv(shared("refs/slip_to_roll.csv"), colClasses = "character")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], as.numeric)
    # A disk on a radius that gives its beta.
    scene <- scene_incline(
      body_disk(r$m, r$R * sqrt(2 * r$beta)), r$theta * 180 / pi, radius_m = r$R,
      static_friction = r$mu, v0_m_per_s = r$v0, omega0_rad_per_s = r$omega0,
      gravity_m_per_s2 = r$g
    )
    rolls <- is.finite(r$t_roll) && r$mu >= r$mu_needed_to_keep_rolling
    motion <- trajectory(scene, if (rolls) r$t_roll * c(1, 1.001) else 100)
    events <- motion_events(motion)
    expect_identical("roll" %in% events$event, rolls)
    if (!rolls) next
    expect_equal(events$time_s[events$event == "roll"], r$t_roll, tolerance = 2e-13)
    info <- run_of(motion)$info
    motion <- motion[1, ]
    # The angle in degrees, and the time, are rounded.
    size <- max(abs(r$v0), abs(r$R * r$omega0), 2 * r$g * r$t_roll)
    expect_lte(abs(motion$v_m_per_s - r$v_roll), info$errors[["v"]] + 1e-15 * size)
    expect_lte(abs(motion$omega_rad_per_s - r$omega_roll),
      info$errors[["omega"]] + 1e-15 * size / r$R)
    expect_lte(abs(motion$x_m - r$x_roll), info$errors[["x"]] + 1e-15 * size * r$t_roll)
    expect_equal(motion$slip_heat_j, r$heat, tolerance = 1e-12)
  }
})

test_that("an uphill launch with back-spin: rows do not depend on each other", {
  up <- scene_incline(
    ball(), 20, static_friction = 0.3, kinetic_friction = 0.05, v0_m_per_s = -8.1,
    omega0_rad_per_s = 30, rolling_arm_m = 0.005
  )
  time <- seq(0, 8, by = 0.25)
  motion <- trajectory(up, time)
  expect_equal(motion_events(motion)$event, c("roll", "reverse"))
  expect_identical(trajectory(up, time[20])$x_m, motion$x_m[20])
  expect_identical(predict(motion, time[c(9, 3)])$v_m_per_s, motion$v_m_per_s[c(9, 3)])
  expect_lte(run_of(motion)$info$error, 1e-13)
  expect_true(all(audit(motion)$verdict == "balanced"))
  # A rate that is wrong shows.
  motion$v_m_per_s[33] <- motion$v_m_per_s[33] * (1 + 1e-6)
  expect_equal(audit(motion)$verdict[1:2], c("unbalanced", "unbalanced"))
})

test_that("audits balance, friction stays in its cone, in random scenes", {
  set.seed(13)
  for (i in 1:60) {
    mu <- stats::runif(1, 0, 0.8)
    scene <- scene_incline(
      body_disk(stats::runif(1, 0.1, 9), 0.2), stats::runif(1, -70, 70), static_friction = mu,
      kinetic_friction = mu * stats::runif(1, 0.5, 1),
      rolling_arm_m = sample(c(0, 0.01, 0.1), 1), v0_m_per_s = stats::rnorm(1, 0, 4),
      omega0_rad_per_s = stats::rnorm(1, 0, 30), start_s = -1
    )
    motion <- trajectory(scene, seq(-1, 4, length.out = 41), event_rows = i %% 2 == 0)
    expect_true(all(audit(motion)$verdict == "balanced"))
    events <- motion_events(motion)
    if (i %% 2 == 0) {
      expect_true(all(events$time_s[events$time_s <= 4] %in% motion$time_s[!is.na(motion$event)]))
      expect_identical(
        motion$time_s, sort(unique(c(seq(-1, 4, length.out = 41), events$time_s)))
      )
    } else {
      expect_identical(motion$time_s, seq(-1, 4, length.out = 41))
    }
    normal <- scene$mass_kg * 9.80665 * cos(scene$incline_angle_deg * pi / 180)
    expect_lte(max(abs(motion$friction_force_n)), mu * normal * (1 + 1e-13))
    expect_true(all(motion$friction_force_n * motion$slip_speed_m_per_s <= 0))
    ledger <- augment(motion)
    expect_equal(ledger$dissipated_j, motion$slip_heat_j + motion$rolling_heat_j)
    expect_equal(ledger$work_j, -motion$potential_energy_j + motion$potential_energy_j[1],
      tolerance = 1e-12)
  }
})

test_that("before the start, and no rows", {
  scene <- scene_incline(ball(), 10, start_s = 1)
  expect_error(trajectory(scene, 0:2), class = "rotdyn_error_time")
  none <- trajectory(scene, double())
  expect_identical(nrow(none), 0L)
  expect_true(all(is.na(audit(none)$verdict)))
  expect_identical(nrow(augment(none)), 0L)
})

test_that("every verb knows the incline", {
  scene <- scene_incline(ball(), 10, static_friction = 0.2, rolling_arm_m = 1e-3)
  expect_equal(choose_model(scene, 0:3)$model[1], "incline_exact")
  motion <- trajectory(scene, 0:3)
  known <- column_table()$name
  for (table in list(motion, summary(motion), augment(motion), work_precision(scene, 0:3))) {
    expect_setequal(setdiff(names(table), c(known, "x_error", "v_error")), character())
  }
  expect_s3_class(generics::glance(motion), "tbl_df")
  expect_error(trajectory(scene, 0:3, accuracy = 1e-16), class = "rotdyn_error_accuracy")
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(motion), "ggplot")
})

test_that("rows of events: one for each, none twice, and every verb keeps them", {
  up <- scene_incline(
    ball(), 20, static_friction = 0.3, kinetic_friction = 0.2, v0_m_per_s = -3,
    omega0_rad_per_s = 20
  )
  motion <- trajectory(up, seq(0, 3, by = 0.5), event_rows = TRUE)
  at <- motion_events(motion)$time_s
  expect_identical(motion$time_s, sort(c(seq(0, 3, by = 0.5), at)))
  expect_identical(motion$event[motion$time_s %in% at], c("roll", "reverse"))
  # Asked for, it is there as often as it was asked for; outside the rows it is not.
  again <- trajectory(up, c(0, at[1], at[1], 3), event_rows = TRUE)
  expect_identical(again$time_s, c(0, at[1], at[1], at[2], 3))
  expect_identical(nrow(trajectory(up, c(1, 3), event_rows = TRUE)), 2L)
  # Without the argument there are the rows that were asked for, and the same values.
  expect_identical(
    tibble::as_tibble(trajectory(up, seq(0, 3, by = 0.5))),
    tibble::as_tibble(motion)[!motion$time_s %in% at, ]
  )
  expect_identical(
    tibble::as_tibble(trajectory(up, motion$time_s)), tibble::as_tibble(motion)
  )
  expect_identical(trajectory(up, at[1])$event, "roll")
  # Other rows do not change.
  expect_identical(motion[motion$time_s == 2, "x_m"], trajectory(up, 2)[1, "x_m"])
  rest <- motion[is.na(motion$event), ]
  expect_s3_class(rest, "rot_trajectory")
  expect_true(all(audit(rest)$verdict == "balanced"))
  expect_identical(nrow(augment(motion)), nrow(motion))
  there <- predict(motion, rev(c(0.1, at)))
  expect_identical(there$event, c("reverse", "roll", NA))
  expect_identical(there$time_s, rev(c(0.1, at)))
  # Two events at one time are one row: over-spin that stops and turns back.
  measured <- work_precision(up, seq(0, 3, by = 0.5), accuracies = 1e-9, min_batch_s = 1e-3)
  expect_setequal(measured$model, c("incline_exact", "incline_rk8pd", "incline_radau"))
  expect_true(all(measured$true_error <= 1e-9))
  expect_true(all(measured$covered %in% c(TRUE, NA)))
})

test_that("time_when() and the summary find what lies between the rows", {
  # v = -3 + g sin t/1.4 (rolling): up to 0.857 s, then down.
  up <- scene_incline(ball(), 30, v0_m_per_s = -3, gravity_m_per_s2 = 9.8)
  a <- 9.8 * 0.5 / 1.4
  motion <- trajectory(up, c(0, 5))
  expect_equal(time_when(motion, v_m_per_s = 0)$time_s, 3 / a, tolerance = 1e-14)
  expect_equal(time_when(up, x_m = 0, occurrence = "all", until_s = 9)$time_s, c(0, 6 / a),
    tolerance = 1e-13)
  expect_equal(time_when(up, x_m = -1)$time_s, (3 - sqrt(9 - 2 * a)) / a, tolerance = 1e-13)
  s <- summary(motion)
  expect_equal(c(s$highest_x_m, s$highest_x_time_s), c(-4.5 / a, 3 / a), tolerance = 1e-13)
  expect_equal(c(s$max_v_m_per_s, s$max_v_time_s), c(-3 + 5 * a, 5), tolerance = 1e-14)
  # Back-spin: omega is largest at the start, v at the end of the slip.
  lane <- scene_incline(ball(), 0, static_friction = 0.2, omega0_rad_per_s = 40)
  s <- summary(trajectory(lane, c(0, 5)))
  expect_equal(s$max_angular_velocity_rad_per_s, 40)
  expect_equal(s$max_v_m_per_s, 0.4 / 1.4 * 0.11 * 40, tolerance = 1e-14)
  expect_identical(time_when(lane, x_m = -1)$time_s, NA_real_)
})

test_that("air drag: the closed form of rolling with quadratic drag", {
  # M v' = m g sin - c v^2, M = 1.4 m: v = vt tanh(c vt t/M), x = M/c log cosh(...)
  scene <- scene_incline(ball(), 30, resistance = resistance(drag_n_s2_per_m2 = 0.5),
    gravity_m_per_s2 = 9.8)
  motion <- trajectory(scene, 0:8, accuracy = 1e-11)
  expect_identical(run_of(motion)$model, "incline_rk8pd")
  top <- sqrt(6 * 9.8 * 0.5 / 0.5)
  s <- 0.5 * top * (0:8) / 8.4
  expect_equal(motion$v_m_per_s, top * tanh(s), tolerance = 1e-11)
  expect_equal(motion$x_m, 8.4 / 0.5 * log(cosh(s)), tolerance = 1e-11)
  expect_equal(motion$drag_force_n, -0.5 * motion$v_m_per_s^2, tolerance = 1e-14)
  expect_true(all(audit(motion)$verdict == "balanced"))
  expect_equal(time_when(scene, v_m_per_s = 5)$time_s, 8.4 / 0.5 / top * atanh(5 / top),
    tolerance = 1e-8)
  ledger <- augment(motion)
  expect_equal(ledger$dissipated_j, motion$drag_heat_j)
  expect_setequal(setdiff(names(ledger), column_table()$name), character())
  # A rate that is wrong shows.
  motion$v_m_per_s[9] <- motion$v_m_per_s[9] * (1 + 1e-6)
  expect_equal(audit(motion)$verdict[1:2], c("unbalanced", "unbalanced"))
})

test_that("a force of one's own: it breaks the rest, then the grip", {
  # On a level floor: rolls from F = m g b/R, slips from (beta F/m + g b/R)/(1 + beta) = mu_s g.
  push <- scene_incline(
    ball(), 0, static_friction = 0.3, kinetic_friction = 0.2, rolling_arm_m = 0.0022,
    force = function(time_s) 20 * time_s, gravity_m_per_s2 = 10
  )
  motion <- trajectory(push, 0:5)
  expect_equal(motion_events(motion)$event, c("roll", "slip"))
  expect_equal(motion_events(motion)$time_s, c(6 * 0.2 / 20, 6 * (3 * 1.4 - 0.2) / 0.4 / 20),
    tolerance = 1e-10)
  expect_true(all(audit(motion)$verdict == "balanced"))
  expect_equal(motion$applied_force_n, 20 * motion$time_s, tolerance = 1e-14)
  # Of the state: a spring, m' x'' = -k x with 1.4 times the mass.
  spring <- scene_incline(
    ball(), 0, v0_m_per_s = 1, force = function(time_s, x_m, v_m_per_s) -8.4 * 4 * x_m
  )
  swing <- trajectory(spring, seq(0, 6, by = 0.5), accuracy = 1e-10, event_rows = TRUE)
  asked <- is.na(swing$event)
  expect_equal(swing$x_m[asked], sin(2 * swing$time_s[asked]) / 2, tolerance = 1e-9)
  expect_equal(motion_events(swing)$time_s, pi / 4 + pi / 2 * 0:3, tolerance = 1e-9)
  expect_error(
    trajectory(scene_incline(ball(), 0, force = function(time_s) "a"), 0:1), "one number in N",
    class = "rotdyn_error_torque"
  )
  expect_error(
    trajectory(scene_incline(ball(), 0, force = function(time_s) NaN), 0:1),
    class = "rotdyn_error_rhs"
  )
  expect_error(scene_incline(ball(), 0, force = "3"), class = "rotdyn_error_type")
  # A number is constant: it rolls with 5/7 of force/m.
  even <- trajectory(scene_incline(ball(), 0, force = 3), c(0, 2))
  expect_equal(even$v_m_per_s[2], 2 * 3 * 5 / 7 / ball()$mass_kg, tolerance = 1e-12)
  expect_error(scene_incline(ball(), 0, force = function(a, b) 1), class = "rotdyn_error_type")
  expect_null(scene_incline(ball(), 0, force = 0)$force)
  expect_error(force_function(3), class = "rotdyn_error_type")
  expect_error(force_function(function(a, b) 1), class = "rotdyn_error_type")
  expect_output(print(force_function(function(t) t, 2)), "breaks at 2 s")
  expect_error(scene_incline(ball(), 0, resistance = resistance(drag_n_s_per_m = -1)),
    class = "rotdyn_error_value")
  expect_output(print(push), "an R function")
})

# Back-spin that ends before the slip does, with a rolling resistance: stretch by stretch in 40
# digits (mpmath).
test_that("a spin that passes zero while the contact slips leaves the rolling speed as it is", {
  body <- body_tensor(0.83769493094649672, c(1, 1, 0.21784961436059055))
  scene <- scene_incline(
    body, 2.1507984504569322, static_friction = 0.67263728453644123,
    kinetic_friction = 0.51877622380519928, rolling_arm_m = 0.0023515890459974119,
    radius_m = 0.72119125486703872, v0_m_per_s = -3.96146692196867,
    omega0_rad_per_s = 7.4924068910292352, x0_m = 0.89758620457723737,
    gravity_m_per_s2 = 9.8066499999999994, start_s = 15.655715756812809
  )
  at_s <- c(16.618295519926249, 17.520685559928712, 19.773966183516492)
  motion <- trajectory(scene, at_s)
  v <- c(-0.60564107254111315423, -0.36500694786575777178, 0.19817598346788472454)
  omega <- c(-0.83977872506617014707, -0.50611671370453832894, 0.27478977612453318537)
  errors <- attr(motion, "run")$info$errors
  motion <- motion[match(at_s, motion$time_s), ]
  expect_lte(max(abs(motion$v_m_per_s - v)), errors[["v"]])
  expect_lte(max(abs(motion$omega_rad_per_s - omega)), errors[["omega"]])
  # The spin's end moved the rolling speed by 9.5e-15.
  expect_lte(max(abs(motion$v_m_per_s - v)), 5e-15)
})

# The published numbers of ../shared/cases, called as a user would, with their own inputs.
test_that("the cases of slip to roll, each against its published or computed value", {
  rows <- published("rolling_slip_transition")
  x <- inputs_of(rows[["bowl1"]])
  lane <- scene_incline(
    body_sphere(6, x$r), 0, static_friction = x$mu, v0_m_per_s = x$v0, omega0_rad_per_s = 0,
    gravity_m_per_s2 = x$g
  )
  motion <- trajectory(lane, c(0, 1, 3), event_rows = TRUE)
  roll <- which(motion$event == "roll")
  cue <- function(h_over_r) {
    struck <- scene_incline(
      body_sphere(1, 0.03), 0, static_friction = 0.2, v0_m_per_s = 1,
      omega0_rad_per_s = 2.5 * h_over_r / 0.03
    )
    trajectory(struck, 30)$v_m_per_s - 9 / 7
  }
  drake <- inputs_of(rows[["drake_v"]])
  ball <- trajectory(scene_incline(
    body_sphere(inputs_of(rows[["drake_f"]])$m, 0.05), drake$theta_deg,
    static_friction = 1, kinetic_friction = 0.5, gravity_m_per_s2 = drake$g
  ), drake$t)
  got <- c(
    bowl1 = 8.1 - motion$v_m_per_s[2], bowl2 = motion$omega_rad_per_s[2],
    bowl3 = motion$time_s[roll], bowl4 = motion$x_m[roll], bowl5 = motion$v_m_per_s[roll],
    bgu = stats::uniroot(cue, c(0.5, 1), tol = 1e-12)$root, drake_v = ball$v_m_per_s,
    drake_f = abs(ball$friction_force_n)
  )
  expect_setequal(names(got), names(rows))
  for (id in names(got)) {
    expect_equal(got[[id]], as.numeric(rows[[id]]$computed), tolerance = 2e-9)
    if (nzchar(rows[[id]]$published)) {
      expect_lte(abs(got[[id]] - as.numeric(rows[[id]]$published)), as.numeric(rows[[id]]$tol))
    }
  }
})

test_that("the rows of University Physics and College Physics about rolling", {
  rows <- published("openstax_rotation")
  input <- function(id) inputs_of(rows[[id]])
  of_beta <- function(beta) body_disk(1, 0.1 * sqrt(2 * beta))
  scene <- function(x, ...) {
    scene_incline(of_beta(x$beta), x$theta_deg, radius_m = 0.1, gravity_m_per_s2 = x$g, ...)
  }
  marble <- trajectory(scene(input("UP11-04")), c(1, input("UP11-05")$t))
  stops <- input("UP11-09")
  cylinder <- scene_incline(body_cylinder(stops$m, 0.3, 1), 0, v0_m_per_s = stops$v)
  moving <- trajectory(cylinder, 1)
  up <- input("UP11-13")
  top <- time_when(scene(up, v0_m_per_s = -up$v), v_m_per_s = 0)
  # On a truck that accelerates by a, the force on the cylinder is -m a in the truck's frame.
  bed <- scene_incline(of_beta(input("UP11-16")$beta), 0, radius_m = 0.1,
    force = function(time_s) -1.7)
  truck <- trajectory(bed, 4)
  got <- c(
    "UP11-01" = friction_needed(scene_incline(body_hoop(1, 1), input("UP11-01")$theta_deg))$
      friction_needed,
    "UP11-02" = rolling_friction_coefficient(input("UP11-02")$beta, input("UP11-02")$theta_deg),
    "UP11-04" = marble$v_m_per_s[1], "UP11-05" = marble$x_m[2],
    "UP11-09" = -(moving$translational_kinetic_energy_j + moving$rotational_kinetic_energy_j),
    # The hoop's speed at 1 m lifts the hollow sphere to (1 + beta)/2.
    "UP11-11" = (rolling_final_speed(1, 1) / rolling_final_speed(input("UP11-11")$beta, 1))^2,
    "UP11-13" = -top$x_m, "UP11-14" = top$time_s,
    "UP11-16" = 1.7 * 16 / 2 / -truck$x_m,
    "CP10-08" = rolling_table("cylinder", 30, input("CP10-08")$h, input("CP10-08")$g)$
      final_speed_m_per_s
  )
  expect_setequal(names(got), names(Filter(function(row) grepl("^rolling", row$domain), rows)))
  for (id in names(got)) expect_published(got[[id]], rows[[id]])
})

test_that("friction and contact hold along every trajectory, closed form and integrated", {
  set.seed(131)
  for (i in 1:40) {
    mu <- stats::runif(1, 0, 0.8)
    forced <- i %% 2 == 0
    push <- stats::rnorm(1, 0, 4)
    scene <- scene_incline(
      body_sphere(2, 0.2), stats::runif(1, -70, 70), static_friction = mu,
      kinetic_friction = mu * stats::runif(1, 0.5, 1), rolling_arm_m = sample(c(0, 0.01), 1),
      v0_m_per_s = stats::rnorm(1, 0, 3), omega0_rad_per_s = stats::rnorm(1, 0, 15),
      resistance = resistance(drag_n_s_per_m = if (forced) 0.4 else 0),
      force = if (forced) function(time_s) push * sin(2 * time_s)
    )
    motion <- trajectory(scene, seq(0, 4, length.out = 81))
    expect_true(all(audit(motion)$verdict == "balanced"))
    normal <- 2 * 9.80665 * cos(scene$incline_angle_deg * pi / 180)
    expect_gte(normal, 0)
    friction <- motion$friction_force_n
    slip <- motion$slip_speed_m_per_s
    rolls <- motion$rolling
    expect_lte(max(abs(friction[rolls]), 0), mu * normal * (1 + 1e-9))
    sliding <- !rolls & slip != 0
    expect_equal(friction[sliding], -scene$kinetic_friction * normal * sign(slip[sliding]),
      tolerance = 1e-12)
    expect_true(all(slip[rolls] == 0))
    expect_true(all(diff(motion$slip_heat_j) >= 0 & diff(motion$rolling_heat_j) >= 0))
  }
})

test_that("a square wave of force needs no breaks, from its first jump on", {
  t <- seq(0, 6, by = 0.5)
  wave <- function(time_s) 5 * sign(sin(2 * time_s)) # 0 at the start, a jump there
  for (lane in list(c(0.05, 0, 0), c(0.05, 10, 0), c(0.2, 10, 0.002), c(0.6, 0, 0.002))) {
    scene <- function(breaks) {
      scene_incline(
        body_sphere(1, 0.1), lane[2], static_friction = lane[1], rolling_arm_m = lane[3],
        force = force_function(wave, breaks)
      )
    }
    found <- trajectory(scene(NULL), t)
    given <- trajectory(scene(seq(0, 6, by = pi / 2)), t)
    expect_equal(found$x_m, given$x_m, tolerance = 1e-11)
    expect_equal(found$omega_rad_per_s, given$omega_rad_per_s, tolerance = 1e-11)
  }
  # Before the second jump it slips under a constant force: v = (F/m - mu g) t.
  slips <- trajectory(
    scene_incline(body_sphere(1, 0.1), 0, static_friction = 0.05, force = wave), c(0, 1.5)
  )
  expect_equal(slips$v_m_per_s[2], (5 - 0.05 * 9.80665) * 1.5, tolerance = 1e-12)
})

test_that("a force that leaves rest by a jump slips where the jump is beyond the grip", {
  # At rest until 1 s; then 30 N on 1 kg: to roll it needs 2/7 of that, friction gives 2.9 N.
  push <- function(time_s) if (time_s < 1) 0 else 30
  motion <- trajectory(scene_incline(
    body_sphere(1, 0.1), 0, static_friction = 0.3, rolling_arm_m = 0.001, force = push
  ), c(0, 0.5, 2))
  expect_equal(motion$v_m_per_s[motion$time_s == 2], 30 - 0.3 * 9.80665, tolerance = 1e-10)
})

# From the equations alone: m v' = m g sin + mu N, I omega' = -mu N R while v < R omega.
test_that("a slip that passes zero without grip is an event, closed form and integrated", {
  scene <- function(...) {
    scene_incline(
      body_disk(2, 0.1), 60, static_friction = 0.3, kinetic_friction = 0.2, v0_m_per_s = 1,
      omega0_rad_per_s = 40, gravity_m_per_s2 = 9.8, ...
    )
  }
  pull <- 9.8 * sqrt(0.75)
  at <- 3 / (pull + 0.98 + 2 * 0.98)
  for (model in c("incline_exact", "incline_rk8pd", "incline_radau")) {
    motion <- trajectory(scene(), c(0, 1), model = model, event_rows = TRUE)
    expect_identical(motion_events(motion)$event, "slip_reverse")
    expect_identical(motion$event, c(NA, "slip_reverse", NA))
    row <- as.list(motion[2, ])
    expect_equal(row$time_s, at, tolerance = 1e-9)
    expect_equal(row$v_m_per_s, 1 + (pull + 0.98) * at, tolerance = 1e-9)
    expect_equal(row$omega_rad_per_s, 40 - 2 * 0.98 / 0.1 * at, tolerance = 1e-9)
    expect_equal(row$slip_heat_j, 2 * 0.98 * 3 * at / 2, tolerance = 1e-8)
    expect_equal(row$friction_force_n, -2 * 0.98, tolerance = 1e-12)
    expect_false(row$rolling)
    expect_equal(motion$v_m_per_s[3], row$v_m_per_s + (pull - 0.98) * (1 - at), tolerance = 1e-9)
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
  # With drag, too.
  pushed <- trajectory(scene(resistance = resistance(drag_n_s_per_m = 0.01)), c(0, 1),
    event_rows = TRUE)
  expect_identical(pushed$event, c(NA, "slip_reverse", NA))
  expect_equal(pushed$time_s[2], at, tolerance = 1e-2)
  ledger <- augment(pushed)
  expect_equal(ledger$dissipated_j, pushed$slip_heat_j + pushed$drag_heat_j, tolerance = 1e-12)
})

test_that("the highest place is the highest, for each sign of the slope", {
  # Up the slope at 2 m/s: 2^2/2 (1 + beta)/(g sin) along it.
  reach <- 4 / 2 * 1.4 / (9.80665 * 0.5)
  for (side in c(1, -1)) {
    up <- scene_incline(body_sphere(1, 0.1), 30 * side, v0_m_per_s = -2 * side, x0_m = 7)
    s <- summary(trajectory(up, c(0, 3)))
    expect_equal(s$highest_x_m, 7 - side * reach, tolerance = 1e-13)
    expect_equal(s$highest_x_time_s, 2 * 1.4 / (9.80665 * 0.5), tolerance = 1e-13)
  }
  level <- summary(trajectory(scene_incline(body_sphere(1, 0.1), 0, v0_m_per_s = -2), c(1, 3)))
  expect_equal(c(level$highest_x_m, level$highest_x_time_s), c(-2, 1))
})

test_that("infinite friction holds at 90 degrees, finite friction has no force there", {
  rack <- scene_incline(body_hoop(1, 0.1), 90)
  motion <- trajectory(rack, c(0, 2))
  expect_equal(motion$v_m_per_s[2], 9.80665, tolerance = 1e-14)
  expect_true(all(motion$rolling))
  expect_equal(friction_needed(rack)$from_rest, "rolls")
  expect_equal(friction_needed(rack)$acceleration_m_per_s2, 9.80665 / 2, tolerance = 1e-14)
  expect_true(conserved(rack)$conserved[1])
  expect_true(all(audit(motion)$verdict == "balanced"))
  damped <- trajectory(scene_incline(body_hoop(1, 0.1), 90,
    resistance = resistance(drag_n_s_per_m = 1e-13)), c(0, 2))
  expect_equal(damped$v_m_per_s[2], 9.80665, tolerance = 1e-9)
  rows <- data.frame(beta = 1, radius_m = 0.1, incline_angle_deg = c(90, -90))
  expect_equal(incline_table(rows, 2)$final_v_m_per_s, c(1, -1) * 9.80665, tolerance = 1e-14)
  race <- roll_race(data.frame(beta = 1), 90, time_s = c(0, 2), length_m = 100)
  expect_equal(race$v_m_per_s[2], 9.80665, tolerance = 1e-14)
  falls <- scene_incline(body_hoop(1, 0.1), 90, static_friction = 5)
  motion <- trajectory(falls, c(0, 2))
  expect_equal(motion$v_m_per_s[2], 2 * 9.80665)
  expect_equal(motion$omega_rad_per_s[2], 0)
  expect_true(conserved(falls)$conserved[1])
})

test_that("times of 1e300 s where the answer is a double", {
  ball <- body_sphere(1, 1)
  at <- function(scene, columns) {
    motion <- trajectory(scene, c(0, 1, 1e300))
    expect_lte(run_of(motion)$info$error, 1e-14)
    expect_true(all(audit(motion)$verdict == "balanced"))
    expect_false(anyNA(augment(motion)$work_j))
    unlist(motion[3, columns], use.names = FALSE)
  }
  expect_equal(at(scene_incline(ball, 0, v0_m_per_s = 1), c("x_m", "v_m_per_s")), c(1e300, 1))
  expect_equal(at(scene_incline(ball, 5, rolling_arm_m = 0.1), c("x_m", "v_m_per_s")), c(0, 0))
  slow <- scene_incline(ball, 30, gravity_m_per_s2 = 1e-300)
  expect_equal(at(slow, c("x_m", "v_m_per_s")), c(1e300 / 4, 1 / 2) / 1.4, tolerance = 1e-14)
  # Slip that ends after 2/7 of v0/(mu g), with the heat (m/2) beta/(1 + beta) v0^2.
  lane <- scene_incline(ball, 0, static_friction = 0.1, v0_m_per_s = 1, omega0_rad_per_s = 0)
  expect_equal(at(lane, c("v_m_per_s", "slip_heat_j")), c(1 / 1.4, 0.2 / 1.4), tolerance = 1e-14)
  rows <- data.frame(
    beta = 0.4, radius_m = 1, incline_angle_deg = 30, gravity_m_per_s2 = 1e-300
  )
  expect_equal(incline_table(rows, 1e300)$final_x_m, 1e300 / 4 / 1.4, tolerance = 1e-14)
  race <- roll_race(
    data.frame(beta = 0.4), 30, gravity_m_per_s2 = 1e-300, time_s = 1e160, length_m = 1e100
  )
  expect_equal(race$x_m, 1e20 / 4 / 1.4, tolerance = 1e-14)
})

test_that("friction_needed() of a body that rests is what rest needs, |tan(angle)|", {
  held <- friction_needed(scene_incline(body_disk(1, 0.1), -10, rolling_arm_m = 0.02))
  expect_equal(held$from_rest, "rests")
  expect_equal(held$friction_needed, tanpi(10 / 180), tolerance = 1e-14)
  # It is the border between rest and slip.
  side <- function(factor) {
    friction_needed(scene_incline(
      body_disk(1, 0.1), 10, rolling_arm_m = 0.02, static_friction = factor * tanpi(10 / 180)
    ))$from_rest
  }
  expect_equal(c(side(1 + 1e-9), side(1 - 1e-9)), c("rests", "slides"))
  # Rolling needs (beta tan + b/R)/(1 + beta).
  rolls <- friction_needed(scene_incline(body_disk(1, 0.1), 20, rolling_arm_m = 0.02))
  expect_equal(rolls$friction_needed, (tanpi(20 / 180) / 2 + 0.2) / 1.5, tolerance = 1e-14)
})

test_that("event rows are for every scene", {
  expect_error(
    trajectory(scene_incline(ball(), 10), 0:1, event_rows = 2), class = "rotdyn_error"
  )
  # Dry friction stops a wheel after I omega/M = 2.5 s; without events there is only a column more.
  wheel <- scene_axle(2, NULL, resistance(coulomb_n_m = 4), omega0_rad_per_s = 5)
  motion <- trajectory(wheel, c(0, 2, 4), event_rows = TRUE)
  expect_identical(motion$time_s, c(0, 2, 2.5, 4))
  expect_identical(motion$event, c(NA, NA, "stick", NA))
  expect_equal(motion$theta_rad[3:4], rep(5 * 2.5 / 2, 2), tolerance = 1e-14)
  skip_if_not_installed("dplyr")
  expect_identical(
    dplyr::select(motion, -event)[-3, ], tibble::as_tibble(trajectory(wheel, c(0, 2, 4))),
    ignore_attr = TRUE
  )
  expect_true(all(audit(motion)$verdict == "balanced"))
  free <- trajectory(scene_axle(1, torque_constant(1)), 0:1, event_rows = TRUE)
  expect_identical(free$event, c(NA_character_, NA))
  # Rows of several bodies stay together; a repeated time keeps its rows.
  two <- scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0))
  motion <- trajectory(two, c(0, 0.5, 0.5, 3), event_rows = TRUE)
  expect_identical(motion$event, c(NA, NA, NA, "lock", NA))
  expect_equal(motion$time_s[4], 1, tolerance = 1e-15)
  expect_equal(motion$omega_1_rad_per_s[4], 4, tolerance = 1e-14)
  belt <- scene_drive(c(2, 3), list(coupling_clutch(12)), omega0_rad_per_s = c(10, 0))
  motion <- trajectory(belt, c(0, 0.5, 3), event_rows = TRUE)
  expect_identical(motion$rotor, rep(1:2, 4))
  expect_identical(which(!is.na(motion$event)), 5:6)
  expect_equal(motion$omega_rad_per_s[5:6], c(4, 4), tolerance = 1e-9)
  expect_true(all(audit(motion)$verdict == "balanced"))
  # A bead that dry friction stops.
  bead <- scene_hoop(1, 1, 0, theta0_rad = 0.5, static_friction = 0.3)
  motion <- trajectory(bead, c(0, 1, 5), event_rows = TRUE)
  expect_true("stick" %in% motion$event)
  expect_true(all(audit(motion)$verdict == "balanced"))
  # Events that are looked for in the motion: theta = 0.1 cos(2 t) turns at pi/2 and passes 0 at
  # odd quarters of pi.
  spring <- scene_axle(1, torque_spring(4), theta0_rad = 0.1)
  motion <- trajectory(spring, c(0, 1, 3), event_rows = TRUE)
  expect_equal(motion$time_s, c(0, pi / 4, 1, pi / 2, 3 * pi / 4, 3), tolerance = 1e-14)
  expect_identical(motion$event, c(NA, "passage", NA, "turn", "passage", NA))
  expect_equal(motion$theta_rad, 0.1 * cos(2 * motion$time_s), tolerance = 1e-14)
  expect_identical(motion_events(motion)$time_s, motion$time_s[!is.na(motion$event)])
  expect_true(all(audit(motion)$verdict == "balanced"))
})

test_that("a time at which the closed form leaves the doubles is an error, not a row", {
  slides <- scene_incline(body_sphere(1, 0.1), 30, static_friction = 0.2)
  expect_error(trajectory(slides, c(1, 1e200)), class = "rotdyn_error_range")
})

test_that("a body that a force nearly balances keeps the digits of a slow motion", {
  # Closed forms with 40 digits (mpmath 1.3.0) from these doubles, m g sin(20 deg) N up the slope:
  # without drag, with 0.5 N s/m, and sliding. The rounding of g sin(20 deg) moved it by 3e-14 m/s.
  ball <- body_sphere(2, 0.1)
  slow <- function(at_s, ...) {
    scene <- suppressMessages(scene_incline(ball, 20, v0_m_per_s = 1e-12, ...))
    motion <- trajectory(scene, c(0, at_s))
    c(motion$v_m_per_s[2], glance(motion)$error * 1e-12)
  }
  rolls <- slow(20, force = -0x1.ad5239db7df1fp+2)
  expect_lt(abs(rolls[1] - 1.000341057551066985e-12), rolls[2])
  expect_lt(rolls[2], 1e-25)
  drags <- slow(
    20, force = -0x1.ad5239db7df1fp+2, resistance = resistance(drag_n_s_per_m = 0.5)
  )
  expect_lt(abs(drags[1] - 2.8208470927013827268e-14), drags[2])
  expect_lt(drags[2], 1e-20)
  slides <- slow(0.1, force = -0x1.82d280988fbd0p+1, static_friction = 0.2, omega0_rad_per_s = -10)
  expect_lt(abs(slides[1] - 1.0000108174349689883e-12), 1e-26)
  # Of a function, which is sampled, the figure has the rounding.
  push <- -0x1.ad5239db7df1fp+2
  scene <- scene_incline(ball, 20, v0_m_per_s = 1e-8, force = function(time_s) push)
  expect_warning(motion <- trajectory(scene, c(0, 20)), class = "rotdyn_warning_accuracy")
  expect_lt(abs(motion$v_m_per_s[2] - (1e-8 + 3.41e-16)), glance(motion)$error * 1e-8)
})
