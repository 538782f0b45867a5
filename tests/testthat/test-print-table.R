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
    impulse = angular_impulse(2, 0, 1, body = 3), columns = metadata()$quantities
  )
}

# Ledgers, choices and others have prints of their own.
prints_as_table <- function(x) {
  own <- Find(function(class) !is.null(utils::getS3method("print", class, TRUE)), class(x))
  isTRUE(own %in% c("rot_table", "rot_trajectory"))
}

test_that("no name is abbreviated, no line is too long, and the answer comes first", {
  all <- suppressWarnings(suppressMessages(tables()))
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
})

test_that("a scene and its motion are introduced as what the user described", {
  disk <- body_disk(2, 0.25)
  level <- attitude_from(c(1, 0, 0, pi / 2), "axis_angle")
  said <- list(
    "a disk on a fixed axle" = scene_axle(disk, 1),
    "a body on a fixed axle" = scene_axle(0.1),
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
  listed <- grep("^scene_(?!hash)", getNamespaceExports("rotdyn"), value = TRUE, perl = TRUE)
  expect_setequal(makers, paste0("rot_", listed))
  for (words in names(said)) {
    first <- utils::capture.output(print(said[[words]]))[1]
    expect_match(first, paste0("^<rot_scene> ", words, "( from 0 s)?$"))
    expect_identical(tbl_sum(trajectory(said[[words]], 0:1))[["Scene"]], words)
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
})
