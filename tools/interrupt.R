# Calls that take long, by name; run by tools/check-interrupt.sh. The parent starts each in a child
# (Rscript tools/interrupt.R NAME), which marks its start in a file and its end in another.

suppressPackageStartupMessages(library(rotdyn))

rotors <- function(n) {
  set.seed(1)
  scene_rotors(
    1 + stats::runif(n), 100 * (1 + stats::runif(n - 1L)), damping_n_m_s = stats::runif(n - 1L),
    resistance = stats::runif(n), omega0_rad_per_s = stats::runif(n)
  )
}

# A grid of squares, two triangles each, bent to a closed sheet.
sheet <- function(n) {
  at <- expand.grid(i = seq_len(n) - 1, j = seq_len(n) - 1)
  number <- function(i, j) as.integer((i %% n) + n * (j %% n) + 1L)
  u <- 2 * pi * at$i / n
  v <- 2 * pi * at$j / n
  list(
    vertices = cbind((2 + cos(v)) * cos(u), (2 + cos(v)) * sin(u), sin(v)),
    faces = rbind(
      cbind(number(at$i, at$j), number(at$i + 1, at$j), number(at$i + 1, at$j + 1)),
      cbind(number(at$i, at$j), number(at$i + 1, at$j + 1), number(at$i, at$j + 1))
    )
  )
}

long_sweep <- function(n) {
  sweep_plan(
    scene_axle(0.1, resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20), 400,
    design_random(n, seed = 1, omega0_rad_per_s = vary_normal(20, 1)), keep = "summary"
  )
}

# Each makes its data first and returns the long call.
long_calls <- list(
  shaft_modes = function() {
    scene <- rotors(900L)
    function() shaft_modes(scene)
  },
  rotors_modal = function() {
    scene <- rotors(600L)
    function() trajectory(scene, 0:3)
  },
  rotors_audit = function() {
    scene <- rotors(400L)
    run <- attr(trajectory(rotors(3L), 0:1, model = "rotors_modal"), "run")
    record <- asNamespace("rotdyn")$record_of(run)
    function() record$ledger(scene, run, 0, 3)
  },
  rotors_rows = function() {
    scene <- rotors(60L)
    function() trajectory(scene, sort(stats::runif(1e5)), accuracy = 1e-12)
  },
  integrator = function() {
    scene <- scene_axle(1, torque_sinusoid(1, 3) + torque_gravity(1, 1), theta0_rad = 1)
    function() trajectory(scene, c(0, 1e6), max_steps = 1e9)
  },
  integrator_function = function() {
    law <- torque_function(function(time_s, theta_rad, omega_rad_per_s) -theta_rad, numeric())
    function() trajectory(scene_axle(1, law, theta0_rad = 1), c(0, 1e6), max_steps = 1e9)
  },
  integrator_stiff = function() {
    law <- torque_function(
      function(time_s, theta_rad, omega_rad_per_s) 1e6 * (sin(50 * time_s) - omega_rad_per_s),
      numeric()
    )
    function() trajectory(scene_axle(1, law), c(0, 1e5), model = "axle_radau", max_steps = 1e9)
  },
  scan = function() {
    law <- function(time_s) {
      for (i in 1:1e5) NULL
      sin(time_s)
    }
    function() trajectory(scene_axle(1, law), c(0, 1e5))
  },
  closed_form = function() {
    scene <- scene_axle(1, torque_gravity(1, 1), theta0_rad = 1)
    time_s <- seq(0, 1e3, length.out = 3e7)
    function() trajectory(scene, time_s)
  },
  closed_form_events = function() {
    scene <- scene_axle(1, torque_sinusoid(5, 2), resistance(0.1, 0.01, 1))
    function() trajectory(scene, c(0, 1e7), max_steps = 1e9)
  },
  audit_axle = function() {
    motion <- trajectory(scene_axle(1, torque_gravity(1, 1), theta0_rad = 1), c(0, 1e6))
    function() audit(motion)
  },
  augment_axle = function() {
    scene <- scene_axle(1, torque_gravity(1, 1), theta0_rad = 1)
    motion <- trajectory(scene, seq(0, 1e4, length.out = 3e5))
    function() augment(motion)
  },
  sweep = function() {
    rows <- data.frame(moment_of_inertia_kg_m2 = stats::runif(1e7, 1, 2))
    law <- torque_sinusoid(1, 2)
    function() spin_up_table(rows, law, time_s = 10)
  },
  # Sweeps: rows of C and of R, in memory and in a folder.
  sweep_memory = function() {
    plan <- long_sweep(2^28)
    function() sweep_run(plan)
  },
  sweep_threads = function() {
    plan <- long_sweep(2^28)
    function() sweep_run(plan, threads = 2)
  },
  sweep_folder = function() {
    plan <- long_sweep(2^28)
    function() sweep_run(plan, tempfile("sweep-"))
  },
  sweep_functions = function() {
    plan <- sweep_plan(
      NULL, 3, design_random(2^16, seed = 1, m = vary_uniform(1, 2)), keep = "summary",
      build = function(row) scene_axle(row$m, 0.2)
    )
    function() sweep_run(plan)
  },
  sweep_design = function() {
    design <- design_latin(
      2^40, seed = 1, a = vary_normal(0, 1), b = vary_normal(0, 1), c = vary_normal(0, 1)
    )
    function() design_rows(design, n = 1e8)
  },
  rolling_table = function() {
    objects <- data.frame(beta = stats::runif(3e7))
    function() for (i in 1:20) rolling_table(objects, incline_angle_deg = stats::runif(3e7, 0, 80))
  },
  mesh = function() {
    mesh <- sheet(2000L)
    function() for (i in 1:5) body_mesh(mesh, mass_kg = 1)
  },
  mesh_weld = function() {
    mesh <- sheet(2000L)
    function() for (i in 1:5) body_mesh(mesh, mass_kg = 1, weld_m = 1e-9)
  },
  # Two sheets through each other: all pairs of faces.
  mesh_crossing = function() {
    mesh <- sheet(700L)
    other <- mesh
    other$vertices[, 1] <- other$vertices[, 1] + 1e-5
    both <- list(
      vertices = rbind(mesh$vertices, other$vertices),
      faces = rbind(mesh$faces, other$faces + nrow(mesh$vertices))
    )
    function() for (i in 1:20) check_mesh(both)
  },
  # All faces twice.
  mesh_duplicates = function() {
    mesh <- sheet(1500L)
    mesh$faces <- rbind(mesh$faces, mesh$faces)
    function() for (i in 1:10) check_mesh(mesh)
  },
  check_mesh = function() {
    mesh <- sheet(2000L)
    function() for (i in 1:5) check_mesh(mesh)
  },
  density_quadrature = function() {
    f <- function(x, y, z) abs(sin(40 * x) * sin(40 * y) * sin(40 * z))
    box <- domain_box(c(0, 0, 0), c(1, 1, 1))
    function() for (i in 1:20) body_density(f, box)
  },
  density_points = function() {
    f <- function(x, y, z) 1 + x^2
    function() body_density(f, domain_ball(1), method = "monte_carlo", max_evaluations = 1e9)
  },
  points = function() {
    n <- 1e7
    data <- data.frame(
      mass_kg = stats::runif(n), x_m = stats::runif(n), y_m = stats::runif(n), z_m = stats::runif(n)
    )
    function() for (i in 1:20) body_points(data)
  },
  polygon = function() {
    angle <- seq(0, 2 * pi, length.out = 3e5)[-1]
    vertices <- cbind(cos(angle), sin(angle))
    function() for (i in 1:100) body_polygon(vertices, mass_kg = 1)
  },
  drive_integrator = function() {
    scene <- scene_drive(
      c(1, 2), coupling_shaft(100), torque = list(torque_sinusoid(3, 2), NULL),
      resistance = list(resistance(0, 0, 1), NULL)
    )
    function() trajectory(scene, c(0, 1e6), max_steps = 1e9)
  },
  drive_audit = function() {
    scene <- scene_drive(c(1, 2), coupling_shaft(1e4, 0.1), omega0_rad_per_s = c(1, 0))
    motion <- trajectory(scene, c(0, 1e4))
    function() for (i in 1:50) audit(motion)
  },
  incline_rows = function() {
    scene <- scene_incline(body_disk(1, 0.1), 10)
    time_s <- seq(0, 1e3, length.out = 3e7)
    function() trajectory(scene, time_s)
  },
  incline_table = function() {
    rows <- data.frame(incline_angle_deg = stats::runif(3e6, 1, 80), beta = 0.5, radius_m = 1)
    function() for (i in 1:20) incline_table(rows, time_s = 3)
  },
  free_integrator = function() {
    body <- body_box(1, 0.1, 0.2, 0.3)
    scene <- scene_free(body, c(1, 2, 3), torque = function(time_s) c(sin(time_s), 0, 0))
    function() trajectory(scene, c(0, 1e5), max_steps = 1e9)
  },
  free_rows = function() {
    scene <- scene_free(body_box(1, 0.1, 0.2, 0.3), c(1, 2, 3))
    time_s <- seq(0, 1e3, length.out = 1e7)
    function() trajectory(scene, time_s)
  },
  ball_bounce = function() {
    v <- stats::runif(1e7)
    function() for (i in 1:50) ball_bounce(body_sphere(1, 0.1), v, -1, 3, 0.5, friction = 0.3)
  },
  collide = function() {
    v <- cbind(stats::runif(3e5), 0, 0)
    ball <- body_sphere(1, 0.1)
    function() {
      for (i in 1:200) collide(ball, ball, velocity_1_m_per_s = v, normal = c(-1, 0, 0))
    }
  },
  work_precision = function() {
    scene <- scene_axle(1, torque_sinusoid(1, 3) + torque_gravity(1, 1), theta0_rad = 1)
    function() work_precision(scene, 0:200, min_batch_s = 10)
  }
)

arguments <- commandArgs(trailingOnly = TRUE)

if (length(arguments) == 3L) {
  run <- long_calls[[arguments[1]]]()
  writeLines(as.character(Sys.getpid()), arguments[2])
  verdict <- tryCatch(
    {
      run()
      "ended"
    },
    interrupt = function(e) "interrupted",
    error = function(e) paste("error:", conditionMessage(e))
  )
  writeLines(c(verdict, format(as.numeric(Sys.time()), digits = 17)), arguments[3])
  quit(save = "no")
}

script <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
wanted <- if (length(arguments)) arguments else names(long_calls)
passed <- failed <- skipped <- 0L
wait_for <- function(path, seconds) {
  end <- Sys.time() + seconds
  while (!file.exists(path) || file.size(path) == 0) {
    if (Sys.time() > end) return(FALSE)
    Sys.sleep(0.01)
  }
  Sys.sleep(0.02)
  TRUE
}
for (name in wanted) {
  started <- tempfile()
  stopped <- tempfile()
  system2(
    file.path(R.home("bin"), "Rscript"), c(shQuote(script), name, started, stopped),
    wait = FALSE, stdout = FALSE, stderr = FALSE
  )
  if (!wait_for(started, 120)) {
    cat("not ok -", name, "did not start\n")
    failed <- failed + 1L
    next
  }
  pid <- as.integer(readLines(started))
  Sys.sleep(1)
  sent <- as.numeric(Sys.time())
  tools::pskill(pid, tools::SIGINT)
  if (!wait_for(stopped, 20)) {
    tools::pskill(pid, tools::SIGKILL)
    cat("not ok -", name, "did not stop in 20 s\n")
    failed <- failed + 1L
    next
  }
  verdict <- readLines(stopped)
  took <- suppressWarnings(as.numeric(verdict[2])) - sent
  if (verdict[1] == "interrupted" && took <= 1) {
    cat(sprintf("ok - %s stopped after %.2f s\n", name, took))
    passed <- passed + 1L
  } else if (verdict[1] == "ended" && took <= 0) {
    cat("skip -", name, "ended before\n")
    skipped <- skipped + 1L
  } else {
    cat(sprintf("not ok - %s: %s after %.2f s\n", name, verdict[1], took))
    failed <- failed + 1L
  }
}
cat("interrupt: ", passed, " passed, ", failed, " failed, ", skipped, " skipped\n", sep = "")
quit(status = failed > 0)
