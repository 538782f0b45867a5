# `make gallery`: a picture of each class that autoplot() draws, and of each scene its drawing, its
# motion and a frame of its animation, as PNG files in gallery/, with index.html, a sheet of all.
# Run from the top folder, after the package is installed.
#
#   Rscript tools/gallery.R            all
#   Rscript tools/gallery.R PATTERN    those whose file name matches; the sheet has these alone
#
# tests/testthat/test-gallery.R and test-pictures.R read the first four lists: alist() computes
# nothing.

# An example of each class with an autoplot() method. A name after a dot tells two of a class apart.
classes <- alist(
  rot_trajectory = trajectory(wheel, seq(0, 8, length.out = 401)),
  rot_trajectory.small = trajectory(small, seq(0, 5, by = 0.01)),
  rot_runs = compare_runs(
    "no resistance" = trajectory(scene_axle(disk, 0.8), seq(0, 8, 0.05)),
    "0.03 N m s" = trajectory(scene_axle(disk, 0.8, resistance(0.03)), seq(0, 8, 0.05))
  ),
  rot_audit = audit(trajectory(wheel, 0:8)),
  rot_audit.rounding = audit(trajectory(small, 0:5)),
  rot_audit.free = audit(trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), 0:20)),
  rot_torque = torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)),
  rot_torque.sum = torque_motor(2, 300) + torque_pulse(1, 0.2, 3),
  rot_resistance = resistance(0.03, quadratic_n_m_s2 = 0.002, coulomb_n_m = 0.1, static_n_m = 0.15),
  rot_inertia_knots = inertia_knots(c(1, 2), c(5, 2)),
  rot_body = join_bodies(
    body_rod(0.5, 1), place_body(body_sphere(2, 0.1), c(0.6, 0, 0)),
    place_body(body_sphere(2, 0.1), c(-0.6, 0, 0)), name = "dumbbell"
  ),
  rot_body.box = place_body(
    body_box(10, 0.4, 0.6, 1), rotation = rotation_about("z", angle_deg = 30)
  ),
  rot_inertia_check = check_inertia(data.frame(
    object = c("arm", "lid"), ixx = 1, iyy = c(2, 1), izz = c(2.5, 3), ixy = 0, ixz = 0, iyz = 0
  )),
  rot_gear_train = gear_train(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4)),
  rot_shaft_modes = shaft_modes(scene_rotors(c(1, 2, 3), c(100, 300))),
  rot_rolling_table = rolling_table(),
  rot_race = roll_race(c("hoop", "disk", "sphere"), incline_angle_deg = 20, length_m = 1),
  rot_spin_up_table = spin_up_table(
    expand.grid(
      moment_of_inertia_kg_m2 = seq(0.05, 0.5, by = 0.05), viscous_n_m_s = c(0, 0.03, 0.3)
    ), torque_constant(0.8), time_s = 8
  ),
  rot_spin_up_table.three = spin_up_table(
    expand.grid(
      moment_of_inertia_kg_m2 = seq(0.05, 0.5, by = 0.05), viscous_n_m_s = c(0, 0.03, 0.3),
      coulomb_n_m = c(0, 0.2)
    ), torque_constant(0.8), time_s = 8
  ),
  rot_incline_table = incline_table(
    expand.grid(
      beta = c(2 / 5, 1 / 2, 1), radius_m = 0.1, incline_angle_deg = seq(5, 60, by = 5),
      static_friction = 0.3
    ), time_s = 2
  ),
  rot_sweep = sweep_run(sweep_plan(
    wheel, time_s = 60,
    design_sobol(4096, seed = 1, "resistance$viscous_n_m_s" = vary_lognormal(0.03, 1.2))
  )),
  rot_sweep.map = sweep_run(sweep_plan(
    wheel, time_s = 8, design_grid(
      "body$mass_kg" = seq(0.5, 4, by = 0.1), "resistance$viscous_n_m_s" = seq(0.01, 0.3, by = 0.01)
    ), outputs = "max_abs_omega_rad_per_s"
  )),
  rot_sweep.lines = sweep_run(sweep_plan(
    wheel, time_s = 8, design_grid(
      "body$mass_kg" = seq(0.5, 4, by = 0.1), "resistance$viscous_n_m_s" = c(0.01, 0.03, 0.1)
    )
  )),
  rot_sweep.indices = sweep_run(sweep_plan(
    wheel, time_s = 8, design_saltelli(
      1024, seed = 1, "body$mass_kg" = vary_normal(2, 0.1),
      "body$radius_m" = vary_normal(0.25, 0.01),
      "resistance$viscous_n_m_s" = vary_lognormal(0.03, 1.2)
    )
  )),
  rot_work_precision = work_precision(
    scene_pendulum(body_rod_end(0.2, 0.6), theta0_rad = 1), seq(0, 5, by = 0.5),
    accuracies = 10^-(3:10), min_batch_s = 0.002
  ),
  rot_equilibrium = static_equilibrium(
    forces(load_force(c(0, -490.3), c(2.4, 0.6)), load_force(c(0, -147.1), c(2, 0.5))),
    list(
      support_surface(c(0, 0), c(0, 1), friction = 0.4, name = "floor"),
      support_surface(c(4, 1), c(-0.2425, 0.9701), friction = 0, name = "edge")
    )
  ),
  rot_equilibrium.beam = static_equilibrium(
    forces(load_force(c(0, -10), c(1, 0))),
    list(support_pin(c(0, 0)), support_roller(c(2, 0), c(0, 1)))
  ),
  rot_collision = ball_bounce(
    body_sphere(0.06, 0.033), 20, -5, -300, restitution = 0.75, friction = 0.5
  ),
  rot_collision.two = collide(
    ball, ball, velocity_1_m_per_s = c(2, 0, 0), velocity_2_m_per_s = c(0, 0, 0),
    normal = c(-cos(0.5), sin(0.5), 0), restitution = 0.95, friction = 0.06
  ),
  rot_collision.hinge = hinged_hit(body_rod(2, 1.2), 0.6, 1.2, 0.05, 30),
  rot_collision.lock = disks_lock(1, 3, 60, 0),
  rot_ledger = collision_ledger(disks_lock(1, 3, 60, 0)),
  rot_curve_motion = roll_on_curve(function(x) 0.5 * (x - 2)^2, 0, 3, body = 2 / 5),
  rot_polhode = polhode(scene_free(c(1, 2, 3), c(0.5, 3, 0.5))),
  rot_axis_path = axis_path(trajectory(gyroscope, seq(0, 2, by = 0.005))),
  rot_foucault = foucault_pendulum(seq(0, 300, by = 0.2), 49, length_m = 67, east_m = 3),
  rot_rolled_disk = roll_disk(body_disk(0.006, 0.012), seq(0, 2, by = 0.01), 40, lean_deg = 20),
  rot_turntable = ball_on_turntable(
    body_sphere(0.033, 0.01), seq(0, 4, by = 0.02), 3.5, 0.3, vy_m_per_s = 0.1
  ),
  rot_record = motion_record(swing, time_s = time_s, theta_rad = theta_rad),
  rot_estimate = estimate_motion(filmed, inertia = disk),
  rot_coast_fit = fit_coast_down(coast, inertia = 0.0625),
  rot_fit = fit_scene(
    scene_axle(0.0625, resistance = resistance(0.006, 0, 0.05), omega0_rad_per_s = 20), coast,
    c("resistance$coulomb_n_m", "resistance$viscous_n_m_s", "omega0_rad_per_s")
  ),
  rot_fit_design = fit_design(
    fit_scene(
      scene_axle(0.0625, resistance = resistance(0.006, 0, 0.05), omega0_rad_per_s = 20), coast,
      c("resistance$coulomb_n_m", "resistance$viscous_n_m_s", "omega0_rad_per_s")
    ),
    list(
      again = planned_record(seq(0, 10, by = 0.1), "theta_rad"),
      longer = planned_record(seq(0, 40, by = 0.1), "theta_rad")
    )
  ),
  rot_swing_fit = fit_swing(motion_record(swing, time_s = time_s, theta_rad = theta_rad)),
  rot_pooled_periods = pool_periods(timed$time_s, swings = 10, group = timed$who),
  rot_uncertainty_budget = uncertainty_budget(
    function(m, r) m * r^2, m = measured(1, 0.01), r = measured(0.1, 1e-3)
  ),
  rot_inertia_measured = inertia_compound_pendulum(
    measured(1.4274, 0.0010, name = "period"), measured(1.55, 0.005, name = "mass"),
    measured(0.296, 0.001, name = "distance")
  ),
  rot_measured = measured(c(0.3358, 0.3361, 0.3362, 0.3359), name = "radius"),
  rot_pivots = fit_pivots(
    2 * pi * sqrt((1 / 12 + holes^2) / (9.81 * holes)) * (1 + c(2, -1, 60, -2, 1, 1) / 1000), holes
  ),
  rot_brake = brake(12, static_ratio = 1.3, from_s = 2, to_s = 3.5),
  rot_coupling = coupling_gear(-3, efficiency = 0.97),
  rot_coupling.clutch = coupling_clutch(
    torque_knots(c(0, 1), c(0, 30), outside = "hold"), static_ratio = 1.2
  ),
  rot_coupling.shaft = coupling_shaft(800, 0.05, ratio = 5),
  rot_coupling.direct = coupling_shaft(800),
  rot_rotor = rotor(c(0, 0, 1), 0.02, 300),
  rot_rotor.motor = rotor(c(1, 1, 0), 0.02, -300, 0.1),
  rot_support = support_surface(c(4, 0), normal = c(-1, 2), friction = 0.4, name = "floor"),
  rot_support.pin = support_pin(c(0, 0), name = "A"),
  rot_support.roller = support_roller(c(4, 0)),
  rot_support.fixed = support_fixed(c(0, 0)),
  rot_support.hinge = support_hinge(c(0, 0, 2), axis = "z", slides = TRUE, name = "upper hinge"),
  rot_support.cable = support_cable(c(3, 0), to_m = c(0, 2)),
  rot_domain = domain_cylinder(0.5, 2, inner_radius_m = 0.4, angle_rad = c(0, 5)),
  rot_domain.ellipsoid = domain_ellipsoid(3, 2, 1),
  rot_domain.inside = domain_inside(
    function(x, y, z) (sqrt(x^2 + y^2) - 2)^2 + z^2 < 0.25, c(-2.5, -2.5, -0.5), c(2.5, 2.5, 0.5)
  ),
  rot_domain.map = domain_map(
    function(r, t, p) cbind((2 + r * cos(t)) * cos(p), (2 + r * cos(t)) * sin(p), r * sin(t)),
    jacobian = function(r, t, p) r * (2 + r * cos(t)),
    lower = c(0, 0, 0), upper = c(0.5, 2 * pi, 2 * pi), periodic = c(FALSE, TRUE, TRUE)
  ),
  rot_inertia_tensor = inertia_tensor(place_body(
    body_box(10, 0.4, 0.6, 1), rotation = rotation_about("z", angle_deg = 30)
  )),
  rot_principal_axes = principal_axes(matrix(c(2, -0.5, 0, -0.5, 3, 0, 0, 0, 4), 3)),
  rot_principal_axes.disk = principal_axes(body_disk(2, 0.25)),
  rot_model_choice = choose_model(
    scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 0.3), time_s = 0:10
  ),
  rot_model_choice.one = choose_model(scene_incline(body_sphere(1, 0.1), 20), 0:2),
  rot_mesh_check = check_mesh(list(
    vertices = rbind(0, diag(3)), faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3))
  )),
  rot_falling_weight = falling_weight(mass_kg = 0.5, radius_m = 0.02, until_s = 3),
  rot_curve = curve_cycloid(1),
  rot_curve.table = curve_table(x_m = 0:4, y_m = c(2, 1.1, 0.6, 0.8, 0.4)),
  rot_force_function = force_function(function(time_s) if (time_s < 1) 20 else 0, breaks_s = 1),
  rot_rerun = records_rerun(records, run),
  rot_animation = animate_motion(
    roll_race(c("hoop", "disk", "sphere"), incline_angle_deg = 20, length_m = 1)
  )
)

# An example of each scene, with the times of its motion: its drawing, its motion and the middle
# frame of its animation, which equations of one's own do not have.
scenes <- alist(
  scene_axle = list(wheel, seq(0, 8, by = 0.02)),
  scene_axle.spring = list(
    scene_axle(0.05, torque_spring(2), resistance(0.02), theta0_rad = 1), seq(0, 5, by = 0.01)
  ),
  scene_axle.brake = list(
    scene_axle(disk, 0.5, omega0_rad_per_s = 10, brake = brake(2, from_s = 1)), seq(0, 3, by = 0.01)
  ),
  scene_axle.skater = list(
    scene_axle(inertia_knots(c(1, 2), c(5, 2)), omega0_rad_per_s = 2), seq(0, 3, by = 0.02)
  ),
  scene_pendulum = list(
    scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = pi / 3), seq(0, 4, by = 0.01)
  ),
  scene_hanging_mass = list(
    scene_hanging_mass(body_disk(2, 0.1), 1, counter_mass_kg = 0.6), seq(0, 2, by = 0.01)
  ),
  scene_hanging_mass.one = list(
    scene_hanging_mass(body_disk(2, 0.1), 1), seq(0, 2, by = 0.01)
  ),
  scene_gears = list(
    scene_gears(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4)), seq(0, 4, by = 0.02)
  ),
  scene_rotors = list(
    scene_rotors(c(1, 2, 3), c(100, 300), omega0_rad_per_s = c(10, 0, 0)), seq(0, 3, by = 0.005)
  ),
  scene_clutch = list(
    scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0)), seq(0, 2, by = 0.01)
  ),
  scene_drive = list(
    scene_drive(
      c(0.4, 2), coupling_clutch(torque_knots(c(0, 0.5), c(0, 60), outside = "hold")),
      torque = list(torque_motor(40, 200), -5), omega0_rad_per_s = c(150, 0)
    ), seq(0, 8, by = 0.02)
  ),
  scene_drive.geared = list(
    scene_drive(
      c(0.002, 0.5), coupling_shaft(4000, 0.4, ratio = 10),
      torque = list(torque_sinusoid(2, 5), NULL), brake = list(NULL, brake(4, from_s = 1))
    ), seq(0, 2, by = 0.005)
  ),
  scene_incline = list(
    scene_incline(body_sphere(1, 0.1), 20, static_friction = 0.3), seq(0, 2, by = 0.01)
  ),
  scene_incline.lane = list(
    scene_incline(
      body_sphere(6, 0.11), 0, static_friction = 0.19, v0_m_per_s = 8.1, omega0_rad_per_s = 0
    ), seq(0, 3, by = 0.01)
  ),
  scene_hoop = list(
    scene_hoop(0.05, 0.2, 9, theta0_rad = 0.1, resistance = resistance(drag_n_s_per_m = 0.05)),
    seq(0, 8, by = 0.02)
  ),
  scene_chain = list(
    scene_chain(c(0.3, 0.3), 0.1, c(2, 2.5), links = "points"), seq(0, 3, by = 0.01)
  ),
  scene_free = list(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), seq(0, 20, by = 0.05)),
  scene_pivot = list(gyroscope, seq(0, 2, by = 0.01)),
  scene_equations = list(
    scene_equations(
      function(theta_rad, omega_rad_per_s) c(omega_rad_per_s, -9.81 / 0.5 * sin(theta_rad)),
      start = c(theta_rad = 0.2, omega_rad_per_s = 0), positions = "theta_rad"
    ), seq(0, 5, by = 0.02)
  )
)

# Moving pictures that are no motion of a scene.
animations <- alist(
  race = roll_race(c("hoop", "disk", "sphere"), incline_angle_deg = 20, length_m = 1),
  bounce = ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, restitution = 0.75, friction = 0.5),
  hinge = hinged_hit(body_rod(2, 1.2), 0.6, 1.2, 0.05, 30),
  lock = disks_lock(1, 3, 60, 0)
)

# Classes that print and have no picture, and why.
exceptions <- c(
  rot_table = "rows of any kind: their columns are drawn by ggplot2 as one likes",
  rot_vary = "a law of one input: a line of text says it",
  rot_design = "a rule from numbers to inputs: design_rows() has its points",
  rot_sweep_plan = "a sweep before it is run: the sweep has the pictures",
  rot_planned_record = "a record that is not measured yet: fit_design() has the picture",
  rot_lab = "a page: its file has the pictures",
  rot_sweep_summary = "figures of a sweep: the sweep has the pictures"
)

# ---- what the examples share --------------------------------------------------------------------

prepare <- function(where = globalenv()) {
  evalq({
    disk <- body_disk(2, 0.25)
    ball <- body_sphere(0.17, 0.0286)
    wheel <- scene_axle(
      disk, torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)), resistance(viscous_n_m_s = 0.03)
    )
    small <- scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1e-5)
    gyroscope <- scene_pivot(
      c(0.02, 0.02, 0.03), c(0, 0, 60), mass_kg = 2, centre_m = c(0, 0, 0.1),
      attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle")
    )
    holes <- c(0.1, 0.2, 0.3, 0.4, 0.45, 0.5)
    records <- DBI::dbConnect(RSQLite::SQLite(), ":memory:")
    records_create(records)
    run <- records_add(records, trajectory(wheel, 0:8))
    set.seed(1)
    noisy <- function(scene, time_s, sd) {
      rows <- trajectory(scene, time_s)
      data.frame(time_s, theta_rad = rows$theta_rad + stats::rnorm(length(time_s), 0, sd))
    }
    swing <- noisy(
      scene_pendulum(body_rod_end(0.2, 0.6), resistance = resistance(0.002), theta0_rad = 0.8),
      seq(0, 12, by = 0.04), 0.002
    )
    coast <- noisy(
      scene_axle(0.0625, NULL, resistance(0.006, 2e-4, 0.05), omega0_rad_per_s = 20),
      seq(0, 12, by = 1 / 30), 0.005
    )
    filmed <- noisy(
      scene_axle(disk, torque_steps(c(0, 4), c(0.4, 0)), resistance(viscous_n_m_s = 0.02)),
      seq(0, 8, by = 1 / 30), 0.005
    )
    timed <- data.frame(who = rep(c("A", "B", "C", "D"), each = 4), time_s = c(
      17.63, 17.48, 17.59, 17.64, 17.71, 17.69, 17.66, 17.74,
      17.52, 17.49, 17.55, 17.50, 15.82, 15.86, 15.79, 15.80
    ))
  }, where)
}

# ---- the pictures -------------------------------------------------------------------------------

# An entry of the sheet: the file and a function that makes the ggplot.
entries <- function() {
  one <- function(group, name, make) list(group = group, name = name, make = make)
  of_list <- function(group, list, make) {
    lapply(names(list), function(name) {
      force(name)
      one(group, paste0(group, "-", name), function() make(eval(list[[name]], globalenv())))
    })
  }
  middle <- function(x) {
    film <- animate_motion(x)
    times <- film$film$time_s
    ggplot2::autoplot(film, time_s = times[(length(times) + 1) %/% 2])
  }
  motion <- function(x) trajectory(x[[1]], x[[2]])
  c(
    of_list("class", classes, ggplot2::autoplot),
    of_list("scene", scenes, function(x) ggplot2::autoplot(x[[1]])),
    of_list("motion", scenes, function(x) ggplot2::autoplot(motion(x))),
    of_list("frame", scenes[names(scenes) != "scene_equations"], function(x) middle(motion(x))),
    of_list("frame", animations, middle)
  )
}

escape <- function(text) {
  for (one in list(c("&", "&amp;"), c("<", "&lt;"), c(">", "&gt;"), c("\"", "&quot;"))) {
    text <- gsub(one[1], one[2], text, fixed = TRUE)
  }
  text
}

sheet <- function(rows) {
  titles <- c(
    class = "Classes", scene = "Scenes", motion = "Motions",
    frame = "Animations, the middle frame"
  )
  body <- unlist(lapply(intersect(names(titles), rows$group), function(group) {
    here <- rows[rows$group == group, ]
    c(
      sprintf("<h2>%s</h2>", titles[[group]]), "<div>",
      sprintf(
        "<figure><a href=\"%s\"><img src=\"%s\" alt=\"%s\" width=\"480\" height=\"270\"></a>%s",
        here$file, here$file, escape(here$alt),
        sprintf(
          "<figcaption><b>%s</b>: %s<details><summary>alt text</summary>%s</details></figcaption>",
          escape(sub("^[a-z]+-", "", here$name)), escape(here$title), escape(here$alt)
        )
      ),
      "</div>"
    )
  }))
  c(
    "<!DOCTYPE html>", "<html lang=\"en\"><head><meta charset=\"utf-8\">",
    "<title>Pictures of rotdyn</title>", "<style>",
    "body { font-family: sans-serif; margin: 1.5em; color: #222; }",
    "div { display: flex; flex-wrap: wrap; gap: 1em; }",
    "figure { margin: 0; width: 480px; } img { border: 1px solid #ccc; }",
    "figcaption { font-size: 0.85em; }", "</style></head>", "<body>",
    "<h1>Pictures of rotdyn</h1>", body, "</body></html>"
  )
}

# 8 x 4.5 inches at 240 dots an inch fill a slide of 1920 x 1080.
write_gallery <- function(pattern, folder = "gallery") {
  prepare()
  dir.create(folder, showWarnings = FALSE)
  rows <- lapply(Filter(function(one) grepl(pattern, one$name), entries()), function(one) {
    plot <- tryCatch(one$make(), error = function(e) {
      stop(one$name, ": ", conditionMessage(e), call. = FALSE)
    })
    file <- paste0(one$name, ".png")
    ggplot2::ggsave(file.path(folder, file), plot, width = 8, height = 4.5, dpi = 240, bg = "white")
    labels <- plot$labels
    lost <- setdiff(c("title", "alt"), names(labels))
    if (length(lost)) stop("the picture ", one$name, " has no ", lost[1], call. = FALSE)
    data.frame(
      group = one$group, name = one$name, file = file, alt = labels$alt,
      title = gsub("\n", " ", labels$title)
    )
  })
  rows <- do.call(rbind, rows)
  writeLines(sheet(rows), file.path(folder, "index.html"), useBytes = TRUE)
  cat(nrow(rows), " pictures in ", folder, "/, on one sheet in ", folder, "/index.html\n", sep = "")
}

if (sys.nframe() == 0L) {
  library(rotdyn)
  write_gallery(c(commandArgs(trailingOnly = TRUE), "")[1])
}
