# One of each class of table that the package makes.
tables <- function() {
  disk <- body_disk(2, 0.25)
  ball <- body_sphere(1, 0.1)
  motion <- spin_up(time_s = 0:8)
  nut <- scene_free(c(1, 2, 3), c(0.01, 4, 0.01))
  structure <- static_equilibrium(
    forces(load_force(c(0, -10), c(1, 0))),
    list(support_pin(c(0, 0)), support_roller(c(2, 0), c(0, 1)))
  )
  list(
    motion = motion, summary = summary(motion), glance = glance(motion), augment = augment(motion),
    events = motion_events(
      trajectory(scene_hoop(1, 1, 0, theta0_rad = 1, static_friction = 0.2), 0:9)
    ),
    first = time_when(motion, omega_rad_per_s = 10),
    all = time_when(motion, omega_rad_per_s = 10, occurrence = "all"),
    period = period_of(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1)),
    stop = stopping(
      scene_axle(2.5, resistance = resistance(coulomb_n_m = 1), omega0_rad_per_s = 9)
    ),
    choice = choose_model(scene_axle(disk), 0:2), audit = audit(motion), models = models(),
    shapes = shapes(), conserved = conserved(nut), free = trajectory(nut, 0:3),
    pivot = trajectory(scene_pivot(disk, c(0, 0, 60), pivot_m = c(0, 0, -0.1)), 0:3),
    incline = trajectory(scene_incline(ball, 20), 0:3),
    drive = trajectory(scene_drive(c(1, 2), coupling_shaft(5), torque = list(1, NULL)), 0:2),
    clutch = trajectory(scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)), 0:2),
    chain = trajectory(scene_chain(c(1, 1), 1, 0.1), 0:1),
    hanging = trajectory(scene_hanging_mass(disk, 1), 0:2),
    rolling = rolling_table(), inertia = inertia_table(), one_body = inertia_table(disk),
    race = roll_race(c("hoop", "sphere")), race_order = summary(roll_race(c("hoop", "sphere"))),
    tops = precession_table(), energies = energy_partition(c("hoop", "disk"), 3),
    kinematics = angular_motion(omega0_rad_per_s = 1, alpha_rad_per_s2 = 2, time_s = 3),
    point = point_motion(3, 0.5), coin = roll_disk(body_disk(0.006, 0.012), 0:1, 40),
    turntable = ball_on_turntable(ball, 0:2, 3, 0.3),
    collision = collide(ball, ball, velocity_1_m_per_s = c(2, 0, 0), normal = c(-1, 0, 0)),
    bounce = ball_bounce(ball, 2, -5), hit = hinged_hit(disk, 0.1, 0.2, 0.1, 5),
    lock = disks_lock(1, 3, 60, 0), ledger = collision_ledger(disks_lock(1, 3, 60, 0)),
    structure = structure, reactions = reactions(structure),
    resultant = resultant(forces(load_force(c(0, -10), c(1, 0)))),
    modes = shaft_modes(scene_rotors(c(1, 2, 3), 100)), flips = flip_time(nut),
    stability = spin_stability(body_box(1, 1, 2, 3)),
    axes = principal_axes(body_box(1, 1, 2, 3)), gears = gear_train(c(1, 2), 3, torque = c(1, 0)),
    spool = spool_pull(disk, 5, 10, 0.1), atwood = atwood_machine(2, 1, disk),
    friction = friction_needed(scene_incline(ball, 30, static_friction = 0.2)),
    attitude = attitude_from(c(1, 0, 0, 0.5), "axis_angle"),
    sweep = spin_up_table(data.frame(moment_of_inertia_kg_m2 = 1:3), 0.5, 4),
    inclines = incline_table(data.frame(
      beta = c(0.4, 0.5), radius_m = 0.1, incline_angle_deg = 20
    ), 2),
    tumbling = tumbling_table(data.frame(
      ixx_kg_m2 = 1:2, iyy_kg_m2 = 2, izz_kg_m2 = 2.5, omega_x_rad_per_s = 1,
      omega_y_rad_per_s = 0.1, omega_z_rad_per_s = 0.1
    ), 2),
    impulse = angular_impulse(2, 0, 1, body = 3), columns = metadata()$quantities,
    no_events = motion_events(motion), slow = rolling_disk_speed(body_disk(0.006, 0.012)),
    one_energy = energy_partition(disk, 3)
  )
}

made <- new.env()
made_tables <- function() {
  if (is.null(made$tables)) made$tables <- suppressWarnings(suppressMessages(tables()))
  made$tables
}

# Ledgers, choices and others have prints of their own.
prints_as_table <- function(x) {
  own <- Find(function(class) !is.null(utils::getS3method("print", class, TRUE)), class(x))
  isTRUE(own %in% c("rot_table", "rot_trajectory"))
}

test_that("no name is abbreviated, no line is too long, and the answer comes first", {
  all <- made_tables()
  for (width in c(80L, 60L)) {
    old <- options(width = width)
    for (name in names(all)) {
      x <- all[[name]]
      lines <- cli::ansi_strip(utils::capture.output(print(x)))
      info <- paste(name, width)
      if (prints_as_table(x)) {
        expect_true(all(nchar(lines) <= width | startsWith(lines, "# ")), info = info)
        # Every column is there, whole: shown, or named below.
        text <- gsub("\\s+", " ", gsub("\n# +", " ", paste(lines, collapse = "\n")))
        for (column in names(x)) {
          whole <- grepl(paste0("(^|[ ,])", column, "([ ,]|$)"), text)
          expect_true(whole, info = paste(info, column))
        }
      }
      rest <- lines[!startsWith(lines, "#")]
      expect_false(any(grepl("\u2026|~", utils::head(rest, 1))), info = info)
      head <- sum(cumsum(!startsWith(lines, "#")) == 0)
      expect_lte(head, if (inherits(x, "rot_trajectory")) 8 else 4)
    }
    options(old)
  }
})

# The answer of each table: a column, in the head of the rows or in the first five lines.
answers <- c(
  motion = "omega_rad_per_s", summary = "max_angular_velocity_rad_per_s", events = "event",
  glance = "max_angular_velocity_rad_per_s", augment = "omega_rad_per_s", first = "time_s",
  all = "time_s", period = "period_s", stop = "stop_time_s", models = "model", shapes = "shape",
  conserved = "conserved", free = "qw", pivot = "qw", incline = "v_m_per_s",
  drive = "omega_rad_per_s", clutch = "omega_1_rad_per_s", chain = "omega_rad_per_s",
  hanging = "omega_rad_per_s", rolling = "acceleration_m_per_s2",
  inertia = "moment_of_inertia_kg_m2", race = "x_m",
  race_order = "object", tops = "precession_rad_per_s", energies = "rotational_energy_fraction",
  kinematics = "omega_rad_per_s", point = "tangential_speed_m_per_s", coin = "contact_x_m",
  turntable = "vx_m_per_s", collision = "vx_1_m_per_s", bounce = "vx_m_per_s",
  hit = "omega_rad_per_s", lock = "common_omega_rad_per_s", structure = "fy_n",
  reactions = "value", resultant = "force_n", modes = "natural_rad_per_s",
  stability = "principal_moment_kg_m2", axes = "principal_moment_kg_m2",
  spool = "acceleration_m_per_s2", atwood = "tension_1_n", friction = "friction_needed",
  attitude = "qw", sweep = "final_theta_rad", inclines = "final_x_m",
  tumbling = "final_qw", impulse = "angular_impulse_n_m_s", columns = "unit",
  no_events = "time_s", slow = "min_speed_m_per_s", one_energy = "rotational_kinetic_energy_j"
)

test_that("the answer of a table is in its first columns, or in the first five lines", {
  all <- made_tables()
  expect_setequal(
    c(names(answers), "choice", "audit", "one_body", "ledger", "flips", "gears"), names(all)
  )
  for (width in c(80L, 60L)) {
    old <- options(width = width)
    for (name in names(answers)) {
      lines <- cli::ansi_strip(utils::capture.output(print(all[[name]])))
      rows <- !startsWith(lines, "#")
      shown <- if (any(rows)) utils::head(lines[rows], 4) else lines
      expect_match(
        paste(shown, collapse = "\n"), paste0("(^|\\s)", answers[[name]], "(\\s|,|$)"),
        info = paste(name, width)
      )
    }
    options(old)
  }
})

# One of each class with a print of its own, and what its first five lines must say.
others <- function() {
  disk <- body_disk(2, 0.25)
  box <- body_box(1, 1, 2, 3)
  ball <- body_sphere(1, 0.1)
  time_s <- seq(0, 10, 0.05)
  coast <- data.frame(time_s, theta_rad = 10 * (1 - exp(-time_s / 5)) + 1e-3 * sin(1e4 * time_s))
  swing <- data.frame(
    time_s, theta_rad = 0.1 * exp(-0.02 * time_s) * cos(3 * time_s) + 1e-4 * sin(1e4 * time_s)
  )
  start <- c(0.2, 0.3)
  motion <- spin_up(time_s = 0:8)
  tetrahedron <- list(
    vertices = rbind(0, diag(3)),
    faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  )
  list(
    list(torque_knots(c(0, 1, 4), c(0, 1, 0)), "0 to 1 N m"),
    list(torque_pulse(0, 1, 2), ", 2 N m"), list(torque_polynomial(0:1, 1:2), "N m"),
    list(torque_function(function(time_s) time_s, 1), "N m"),
    list(torque_curve(c(0, 10), c(1, 0)), "0 to 1 N m"),
    list(torque_motor(1, 10) + torque_constant(2), "N m"), list(torque_spring(1), "N m/rad"),
    list(force_function(function(time_s) 1), "in N"), list(resistance(0.1), "0.1 N m s"),
    list(brake(5), "5 N m"), list(rotor("z", 0.1, 3), "3 rad/s"),
    list(coupling_gear(2), "ratio 2"), list(coupling_shaft(5), "5 N m/rad"),
    list(inertia_knots(0:1, c(2, 1)), "kg m\\^2"), list(disk, "Izz 0.0625 kg m\\^2"),
    list(inertia_tensor(box), "kg m\\^2"), list(domain_ball(1), "ball: radius_m = 1"),
    list(curve_circle(1), "radius 1 m"),
    list(support_pin(c(0, 0)), "<support> pin at \\(0, 0\\) m"),
    list(support_pin(c(0, 0), name = "A"), "<support> A: pin at"),
    list(scene_axle(disk, 1), "torque +constant, 1 N m"),
    list(scene_axle(disk, brake = brake(3)), "on a fixed axle with a brake(.|\n)*3 N m"),
    list(scene_pendulum(body_rod_end(1, 0.5), theta0_rad = 1), "start +theta 1 rad"),
    list(scene_hanging_mass(disk, 1), "falls +with 4.9"), list(scene_gears(1:2, 3), "ratio"),
    list(scene_rotors(1:2, 100), "100 N m/rad"), list(scene_clutch(2, 3, 12), "12 N m"),
    list(scene_drive(1:2, coupling_shaft(5)), "shaft, 5 N m/rad"),
    list(scene_chain(c(1, 1), 1, 0.1), "theta0_rad +0.1 rad"),
    list(scene_hoop(1, 1, 2), "hoop_omega_rad_per_s +2 rad/s"),
    list(scene_equations(function(x) -x, c(x = 1)), "x"),
    list(animate_motion(trajectory(scene_hoop(1, 1, 2), 0:1)), "hoop"),
    list(scene_free(c(1, 2, 3), c(0, 4, 0)), "omega 0, 4, 0 rad/s"),
    list(scene_pivot(disk, c(0, 0, 60), pivot_m = c(0, 0, -0.1)), "omega 0, 0, 60 rad/s"),
    list(scene_incline(ball, 20), "never slips; rolling needs 0.104"),
    list(scene_incline(ball, 20, static_friction = 0.3), "0.3 static"),
    list(motion, "on a fixed axle"), list(audit(motion), "work of the torque +55.12 J"),
    list(choose_model(scene_axle(disk), 0:2), "axle_free"),
    list(collision_ledger(disks_lock(1, 3, 60, 0)),
         "energy \\(J\\)(: before)? +1800(, after)? +450"),
    list(principal_axes(box), "asymmetric"), list(check_inertia(diag(3)), "physical"),
    list(check_mesh(tetrahedron), "closed|bounds|solid"),
    list(measured(1.4, 1e-3), "1.4000\\(10\\)"),
    list(inertia_torsion(measured(1.4, 0.001), 2), "I = 0.0993?\\d*\\(\\d+\\) kg m\\^2"),
    list(pool_periods(c(14.1, 14.2, 14.05), 10), "period 1.41\\d*\\(\\d+\\) s"),
    list(fit_pivots(c(1.5, 1.4, 1.45, 1.6, 1.7), 2:6 / 10), "m/s\\^2"),
    list(uncertainty_budget(function(m, r) m * r^2, m = measured(1, 0.01), r = measured(0.1, 1e-3)),
         "y = 0.0100"),
    list(fit_coast_down(motion_record(coast, "time_s", "theta_rad"), inertia = 0.1), "viscous"),
    list(fit_swing(motion_record(swing, "time_s", "theta_rad")), "period"),
    list(fit_scene(scene_axle(0.1, resistance = resistance(0, 0, 0.05), omega0_rad_per_s = 9),
                   coast, "omega0_rad_per_s"), "omega0_rad_per_s .* rad/s"),
    list(planned_record(0:3, "theta_rad", noise = c(theta_rad = 0.01)),
         "4 times, 0 to 3 s, of theta_rad"),
    list(lab(scene_axle(0.1, 0.2)), "a scene with its inputs"),
    list(falling_weight(0.1, 0.02), "0.1 kg"), list(rolling_table(), "beta"),
    list(vary_normal(2, 0.02), "normal, mean 2, sd 0.02"),
    list(design_sobol(2^30, mass_kg = vary_uniform(1, 2)), "1,073,741,824 rows(.|\n)*uniform")
  )
}

test_that("whatever has a print says the answer in its first five lines, with units", {
  all <- suppressWarnings(suppressMessages(others()))
  seen <- character()
  for (width in c(80L, 60L)) {
    old <- options(width = width)
    for (one in all) {
      lines <- cli::ansi_strip(utils::capture.output(print(one[[1]])))
      # Lines are folded where the console is narrow.
      said <- paste(utils::head(lines, if (width < 80L) 8L else 5L), collapse = "\n")
      expect_match(gsub("\n +", " ", said), one[[2]])
      expect_false(any(grepl("[0-9]e-(1[7-9]|[2-9][0-9])", lines)), info = one[[2]])
      seen <- union(seen, class(one[[1]]))
    }
    options(old)
  }
  # Every class that has a print is here; that of a record computed again is in test-records.R,
  # those of sweeps are in test-sweep-plan.R and test-sweep-summary.R.
  methods <- ls(.BaseNamespaceEnv[[".__S3MethodsTable__."]], pattern = "^print\\.rot_")
  expect_identical(setdiff(sub("^print\\.", "", methods), seen),
                   c("rot_rerun", "rot_sweep_plan", "rot_sweep_summary"))
})

test_that("a motion whose noise is shown as 0 keeps its error figure", {
  # After whole periods of the relative swing the second rotor rests.
  time_s <- 0:2 * 2 * pi / sqrt(120)
  motion <- trajectory(scene_rotors(c(1, 5), 100, omega0_rad_per_s = c(1, 0)), time_s)
  resting <- motion$omega_rad_per_s[motion$rotor == 2]
  expect_gt(max(abs(resting)), 0)
  expect_lt(max(abs(resting)), 1e-15)
  lines <- utils::capture.output(print(motion))
  expect_match(lines[5], "^# Error: +about")
  expect_match(lines[11], "^4 +0.574 +2 +0.0956 +0 +0")
  expect_false(any(grepl("e-17|e\\+ 0", lines)))
  # Rolling upright along x: y is noise beside x, the contact's beside the centre's.
  coin <- roll_disk(body_disk(0.006, 0.012), 0:1, 40)
  expect_gt(max(abs(coin$contact_y_m)), 0)
  expect_false(any(grepl("e-1[0-9]", utils::capture.output(print(coin)))))
})

test_that("columns without a value come last, without a unit; an empty table names its columns", {
  lines <- utils::capture.output(print(inertia_table(body_disk(2, 0.25))))
  expect_match(lines[length(lines)], "^ +length_m +NA$")
  lines <- utils::capture.output(print(period_of(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)))))
  expect_match(lines[4], "^ +amplitude_rad +NaN$")
  empty <- utils::capture.output(print(motion_events(spin_up(time_s = 0:2))))
  expect_identical(empty[2], "# 2 columns: time_s, event")
  expect_match(empty[1], "^# A tibble: 0")
})

test_that("one row stands upright with units", {
  lines <- utils::capture.output(print(stopping(
    scene_axle(2.5, resistance = resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
  )))
  # I omega/f = 50 s, I omega^2/(2 f) = 250 rad.
  expect_identical(trimws(lines), c(
    "# One row, 3 columns", "stop_time_s               50 s", "stop_theta_rad            250 rad",
    "terminal_omega_rad_per_s  0 rad/s"
  ))
  # A width that is given, and rows that remain tibbles.
  table <- rolling_table()
  expect_true(any(grepl("A tibble: 5", utils::capture.output(print(table, width = 60)))))
  expect_s3_class(table[1:2], "rot_table")
  expect_s3_class(table[["beta"]] + 1, NA)
})

test_that("components that are rounding noise beside the others show as 0", {
  x <- new_table(list(
    omega_x_rad_per_s = c(1, 1e-17), omega_y_rad_per_s = c(1e-17, 2),
    omega_z_rad_per_s = c(0, 1e-9),
    other = c(1e-17, 1)
  ), nrow = 2L)
  shown <- without_noise(x)
  expect_identical(shown$omega_x_rad_per_s, c(1, 0))
  expect_identical(shown$omega_y_rad_per_s, c(0, 2))
  expect_identical(shown$omega_z_rad_per_s, c(0, 1e-9))
  expect_identical(shown$other, x$other)
  # Below 1e-14 of the largest, in columns and among bodies at one time.
  edge <- new_table(list(vx_m_per_s = c(1, 1), vy_m_per_s = c(0.9e-14, -1.1e-14)), nrow = 2L)
  expect_identical(without_noise(edge)$vy_m_per_s, c(0, -1.1e-14))
  bodies <- new_table(
    list(time_s = c(0, 0, 0), rotor = 1:3, omega_rad_per_s = c(1, -0.9e-14, 1.1e-14)), nrow = 3L
  )
  expect_identical(without_noise(bodies)$omega_rad_per_s, c(1, 0, 1.1e-14))
})

test_that("a scene and its motion are introduced as what the user described", {
  disk <- body_disk(2, 0.25)
  level <- attitude_from(c(1, 0, 0, pi / 2), "axis_angle")
  said <- list(
    "a disk on a fixed axle" = scene_axle(disk, 1),
    "a body on a fixed axle" = scene_axle(0.1),
    "a body on a fixed axle with a brake" = scene_axle(disk, brake = brake(3)),
    "a body whose moment of inertia changes, on a fixed axle" =
      scene_axle(inertia_knots(0:1, c(2, 1)), omega0_rad_per_s = 3),
    "a pendulum: a rod on a fixed axle" = scene_pendulum(body_rod_end(1, 0.5), theta0_rad = 1),
    "a pendulum: a point mass on a fixed axle" = scene_pendulum(body_point(1), 0.8, theta0_rad = 1),
    "a mass hanging from a pulley" = scene_hanging_mass(disk, 1),
    "two masses hanging from a pulley" = scene_hanging_mass(disk, 2, counter_mass_kg = 1),
    "a gear train of 2 shafts" = scene_gears(c(1, 2), 3, torque = c(1, 0)),
    "3 rotors on one shaft" = scene_rotors(c(1, 2, 3), 100),
    "two bodies and a clutch" = scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)),
    "a drive of 2 rotors" = scene_drive(c(1, 2), coupling_shaft(5)),
    "a double pendulum: two rods" = scene_chain(c(1, 1), 1, 0.1),
    "a chain of 3 point masses" = scene_chain(rep(1, 3), 1, 0.1, links = "points"),
    "a bead on a hoop that turns at 2 rad/s" = scene_hoop(1, 1, 2, theta0_rad = 0.1),
    "equations of x and v" = scene_equations(function(x, v) c(v, -x), c(x = 1, v = 0)),
    "a free box" = scene_free(body_box(1, 0.1, 0.2, 0.3), c(0, 4, 0.1)),
    "a free body" = scene_free(c(1, 2, 3), c(0, 4, 0.1)),
    "a gyroscope or top: a disk with a fixed point" =
      scene_pivot(disk, c(0, 0, 60), pivot_m = c(0, 0, -0.1), attitude0 = level),
    "a disk with a fixed point" = scene_pivot(disk, c(1, 0, 0), pivot_m = c(0, 0, -0.1)),
    "a body with a fixed point" =
      scene_pivot(c(1, 2, 3), c(0, 0, 6), mass_kg = 1, centre_m = c(0, 0, 0.1)),
    "a sphere on an incline of 20 degrees" = scene_incline(body_sphere(1, 0.1), 20),
    "a sphere on a level plane" =
      scene_incline(body_sphere(6, 0.11), 0, static_friction = 0.1, v0_m_per_s = 7,
                    omega0_rad_per_s = 0)
  )
  makers <- unique(vapply(said, function(scene) class(scene)[1], ""))
  listed <- grep("^scene_(?!hash|code)", getNamespaceExports("rotdyn"), value = TRUE, perl = TRUE)
  expect_setequal(makers, paste0("rot_", listed))
  for (words in names(said)) {
    first <- utils::capture.output(print(said[[words]]))[1]
    expect_match(first, paste0("^<rot_scene> ", words, "( from 0 s)?$"))
    expect_identical(tibble::tbl_sum(trajectory(said[[words]], 0:1))[["Scene"]], words)
  }
  loop <- roll_on_curve(curve_circle(1), 0, 1, body_sphere(1, 0.1), v0_m_per_s = 8)
  expect_match(utils::capture.output(print(loop))[1], "Motion along a curve: circle of radius 1 m")
  # From rest with (m1 - m2) g/(m1 + m2 + I/r^2).
  expect_output(
    print(scene_hanging_mass(disk, 2, counter_mass_kg = 1)),
    "falls +with 2.45166\\d* m/s\\^2, the first"
  )
})

test_that("what is an argument has the unit of its name", {
  expect_identical(
    unit_in_name(c("spin_rad_per_s", "transverse_moment_kg_m2", "axis_angle_deg", "beta", "x_m")),
    c("rad/s", "kg m^2", "degree", "1", "m")
  )
  # Inverse units and those of no column.
  expect_identical(
    unit_in_name(c("decay_per_s", "quadratic_per_rad", "flow_kg_per_s", "shaft_n_m_per_rad",
                   "quadratic_n_m_s2", "impulse_n_s", "alpha_rad_per_s2", "s")),
    c("1/s", "1/rad", "kg/s", "N m/rad", "N m s^2", "N s", "rad/s^2", "1")
  )
  table <- column_table()
  named <- table[!table$unit %in% c("", "1", "(rad/s)^2") & grepl("_", table$name), ]
  expect_identical(unit_in_name(named$name), named$unit)
  expect_identical(column_label("decay_per_s"), "decay (1/s)")
  expect_identical(column_label("normal_impulse_n_s"), "normal impulse (N s)")
  expect_identical(column_label("alpha_rad_per_s2"), "alpha (rad/s^2)")
  expect_identical(column_label("rolling_heat"), "rolling heat")
  swing <- new_table(list(decay_per_s = 0.1, decay_per_s_se = 0.01), nrow = 1L)
  expect_output(print(swing), "decay_per_s +0.1 1/s\n +decay_per_s_se +0.01 1/s$")
})

test_that("the summary of a fit and of an estimate is one row, not quartiles of its columns", {
  time_s <- seq(0, 10, 0.05)
  noise <- 1e-3 * sin(1e4 * time_s)
  coast <- motion_record(
    data.frame(time_s, theta_rad = 10 * (1 - exp(-time_s / 5)) + noise), "time_s", "theta_rad"
  )
  swing <- motion_record(
    data.frame(time_s, theta_rad = exp(-0.02 * time_s) * cos(3 * time_s) + noise),
    "time_s", "theta_rad"
  )
  for (one in list(estimate_motion(coast), fit_coast_down(coast, 0.1), fit_swing(swing))) {
    expect_identical(summary(one), glance(one))
    expect_identical(nrow(summary(one)), 1L)
    expect_error(summary(one, colour_of_it = 1), class = "rotdyn_error_argument")
  }
})

# Numbers of the level of rounding differ between machines.
printed <- function(x) {
  lines <- cli::ansi_strip(utils::capture.output(print(x)))
  gsub(" *[-+]?[0-9][0-9.]*e-(1[1-9]|[2-9][0-9]|[1-3][0-9][0-9])", " <rounding>", lines)
}

# Columns that a print leaves out: their ends, range and mean.
columns_text <- function(x) {
  if (!is.data.frame(x) || nrow(x) < 2L) return(NULL)
  numbers <- Filter(function(column) is.double(column) && is.null(dim(column)), as.list(x))
  unlist(lapply(names(numbers), function(name) {
    known <- numbers[[name]][is.finite(numbers[[name]])]
    if (!length(known)) return(NULL)
    size <- max(abs(known))
    if (size < 1e-9) return(NULL)
    said <- c(known[1], known[length(known)], min(known), max(known), mean(known))
    said[abs(said) < 1e-9 * size] <- 0
    # What is halfway between two texts is the same one everywhere.
    paste0(name, ": ", paste(format(said * (1 + 1e-10), digits = 6, trim = TRUE), collapse = ", "))
  }))
}

test_that("tables print this, and have these columns", {
  all <- made_tables()
  # Residuals of rounding are an exact 0 on some machines.
  all[c("columns", "models", "structure", "reactions")] <- NULL
  text <- unlist(lapply(names(all), function(name) {
    c("", toupper(name), printed(all[[name]]), columns_text(all[[name]]))
  }))
  expect_snapshot(writeLines(text))
})

test_that("other objects print this", {
  all <- suppressWarnings(suppressMessages(others()))
  # Fits of scenes have test-fit-scene.R.
  all <- Filter(function(one) !inherits(one[[1]], "rot_fit"), all)
  text <- unlist(lapply(all, function(one) c("", printed(one[[1]]))))
  expect_snapshot(writeLines(text))
})

test_that("columns end where letters of any width and language say", {
  wide <- table_from(list(
    word = c("Gr\u00f6\u00dfe \u00e9", "b", "\u65e5\u672c\u8a9e"), omega_rad_per_s = c(1, 22, 333),
    note = c("long text with spaces", "b b", "c"), long_name_of_a_column_m = 1:3
  ))
  old <- options(width = 44)
  on.exit(options(old))
  skip_if_not(l10n_info()[["UTF-8"]])
  expect_silent(lines <- cli::ansi_strip(utils::capture.output(print(wide))))
  expect_identical(lines[4:6], c(
    "1 Gr\u00f6\u00dfe \u00e9               1", "2 b                    22",
    "3 \u65e5\u672c\u8a9e              333"
  ))
  expect_false(any(grepl("b b", lines, fixed = TRUE)))
})

test_that("a command loads neither tibble nor rlang, and a session prints tables as tibbles", {
  child <- function(...) {
    file <- tempfile("child", fileext = ".R")
    on.exit(unlink(file))
    libraries <- deparse(c(dirname(system.file(package = "rotdyn")), .libPaths()))
    writeLines(c(sprintf(".libPaths(%s)", paste(libraries, collapse = "")), ...), file)
    rscript <- file.path(R.home("bin"), "Rscript")
    system2(rscript, c("--vanilla", shQuote(file)), stdout = TRUE, stderr = TRUE)
  }
  verbs <- c(
    "rotdyn::rolling_table(data.frame(beta = 0.4))", "rotdyn::shapes()", "rotdyn::models()",
    "rotdyn::audit(rotdyn::spin_up())", "rotdyn::glance(rotdyn::spin_up())",
    "rotdyn::trajectory(rotdyn::scene_pendulum(rotdyn::body_rod_end(1, 1), theta0_rad = 1), 0:3)"
  )
  said <- child(
    "options(rotdyn.tables = FALSE)", paste0("x <- ", verbs),
    'cat(intersect(c("rotdyn", "rlang", "tibble"), loadedNamespaces()))'
  )
  expect_identical(said, "rotdyn")
  expect_match(child("rotdyn::rolling_table()")[1], "# A tibble: 5")
  expect_match(child("rotdyn::spin_up()")[1], "# A rotdyn trajectory: ")
})

test_that("the lines of free and pivoted bodies and of a falling weight fit the console", {
  turned <- rotation_about("x", angle_deg = 60)
  disk <- body_disk(1, 0.1)
  scenes <- list(
    scene_free(disk, c(0.1, 0.2, 300), attitude0 = turned),
    scene_pivot(disk, c(0.1, 0.2, 300), pivot_m = c(0, 0, -0.05), attitude0 = turned),
    falling_weight(0.5, 0.02)
  )
  for (width in c(80L, 60L)) {
    old <- options(width = width)
    for (one in scenes) {
      lines <- utils::capture.output(print(one))
      expect_true(all(nchar(lines) <= width), info = paste(class(one)[1], width))
    }
    options(old)
  }
  expect_match(utils::capture.output(print(scenes[[2]])), "^ {12}0 at 0 s$", all = FALSE)
})

test_that("prints fit a narrow console", {
  old <- options(width = 40)
  on.exit(options(old))
  fits <- function(x) {
    lines <- capture.output(print(x))
    expect_lte(max(nchar(lines, "width")), 40, label = class(x)[1])
    lines
  }
  disk <- body_disk(2, 0.25)
  wheel <- scene_axle(disk, torque_sinusoid(1.123456, 3.1234), resistance(
    viscous_n_m_s = 0.0312345, quadratic_n_m_s2 = 0.123456, coulomb_n_m = 0.1234
  ))
  motion <- trajectory(wheel, 0:2)
  pendulum <- scene_pendulum(body_rod_end(1.2345, 0.98765), theta0_rad = 2.123456)
  spun <- rotor(c(0, 0.6, 0.8), 0.123456, omega_rad_per_s = 123.4567)
  drive <- scene_drive(
    list(disk, 1.23456789, 2),
    list(coupling_shaft(123.4567, 0.1234), coupling_clutch(12.345, static_ratio = 1.2)),
    torque = list(torque_sinusoid(1.1234, 3), NULL, NULL),
    brake = list(NULL, NULL, brake(1.23456))
  )
  some <- list(
    disk, wheel, audit(motion), audit(motion[0, ]), pendulum, drive, spun,
    drive$couplings[[1]], drive$brake[[3]], wheel$torque, wheel$resistance,
    inertia_knots(c(0, 1.2345678, 2), c(1.23456789, 2, 3)),
    choose_model(drive, 0:8), principal_axes(body_box(1.23456, 1, 2, 3)),
    scene_clutch(1.234567, 2.3456789, 3, omega0_rad_per_s = c(9.12345, 1.2345)),
    scene_rotors(c(1.23456, 2.3456), 123.4567, damping_n_m_s = 0.1234),
    scene_hanging_mass(disk, 1.23456, 0.123456),
    scene_incline(body_sphere(2, 0.12345), 12.34567, static_friction = 0.123456),
    scene_free(body_box(1.23456, 1, 2, 3), omega0_rad_per_s = c(1.234, 2.345, 3.456)),
    scene_pivot(body_cone(1.2345, 0.12345, 0.23456), omega0_rad_per_s = c(0, 0, 123.456)),
    force_function(function(t, x, v) -x * 1.23456789 + 0.123456789 * v * sin(t), breaks_s = 1:9),
    support_hinge(c(1.23456, 2, 3), axis = c(0, 0, 1)), falling_weight(1.2345, 0.0123456),
    lab(pendulum), design_sobol(100, theta0_rad = vary_uniform(1, 2.345678)),
    check_inertia(c(1, 2, 30.12345)), measured(1.23456789, 0.0123456, dof = 12)
  )
  for (x in some) fits(x)
  hit <- ball_bounce(
    body_sphere(0.06, 0.033), vx_m_per_s = 20, vy_m_per_s = -5, omega_rad_per_s = -300,
    restitution = 0.75, friction = 0.5
  )
  lines <- fits(collision_ledger(hit))
  expect_true("    lost to restitution: lost 0.3281" %in% lines)
  # What stands in a column goes on there, a number beside its unit.
  skip_if_not(l10n_info()$`UTF-8`)
  expect_identical(folded("  start     theta 0.123 rad, omega 0.5 rad/s at 0 s"), c(
    "  start     theta 0.123 rad, omega", "            0.5 rad/s at 0 s"
  ))
  expect_identical(
    folded("  torque    of 12.345678901 and of 1 N m s"),
    c("  torque    of 12.345678901 and of", "            1 N m s")
  )
})

test_that("the columns that a print shows first are columns of the table", {
  x <- energy_partition(c("disk", "hoop"), 1:2, mass_kg = 1, radius_m = 1)
  first <- attr(x, "first")
  expect_gt(length(first), 1L)
  other <- setdiff(names(x), first)
  expect_null(attr(x[other], "first"))
  expect_identical(attr(x[, c(first[1], other)], "first"), first[1])
  expect_identical(attr(x[1, ], "first"), first)
  expect_s3_class(x[other], "rot_table")
  expect_identical(x[[1]][1], x[1, 1, drop = TRUE])
  skip_if_not_installed("dplyr")
  expect_null(attr(dplyr::select(x, dplyr::all_of(other)), "first"))
  expect_null(attr(dplyr::mutate(x, n = 1, .keep = "none"), "first"))
  expect_identical(attr(dplyr::filter(x, FALSE), "first"), first)
})
