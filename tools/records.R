# Random scenes of every constraint recorded, and computed again in a new session from the database
# alone; SIGKILL at random moments of recording.
#
#   Rscript tools/records.R FOLDER [SCENES [KILLS [SEED]]]
library(rotdyn)
arguments <- commandArgs(TRUE)
folder <- arguments[1]
number <- function(i, default) if (is.na(arguments[i])) default else as.integer(arguments[i])
scenes <- number(2, 300L)
kills <- number(3, 50L)
set.seed(number(4, 16L))

quiet <- function(x) suppressWarnings(suppressMessages(x))
size <- function() exp(stats::runif(1, -2, 2))
sign_of <- function() sample(c(-1, 1), 1)
pick <- function(...) sample(list(...), 1)[[1]]
body <- function() {
  one <- pick(
    body_disk(size(), size()), body_sphere(size(), size()), body_rod(size(), size()),
    body_box(size(), size(), size(), size())
  )
  if (stats::runif(1) < 0.3) {
    one <- place_body(one, stats::runif(3), rotation_about(c(1, size(), 0), angle_rad = size()))
  }
  one
}
law <- function() {
  torque <- pick(
    sign_of() * size(), torque_knots(cumsum(stats::runif(4)), stats::rnorm(4)),
    torque_sinusoid(size(), size(), size()), torque_exponential(size(), size()),
    torque_motor(size(), 10 * size()), torque_spring(size()),
    torque_steps(c(0, 0.5, 1), stats::rnorm(3)), torque_curve(c(-5, 0, 5), c(1, 0.5, -1))
  )
  if (stats::runif(1) < 0.2) torque_constant(0.1) + torque else torque
}
resist <- function() {
  pick(NULL, resistance(size()), resistance(0, size()), resistance(0.1, 0, 0.1, 0.2))
}
round_body <- function() pick(body_disk(size(), size()), body_hollow_sphere(1, 0.2, 0.1))
makers <- list(
  axle = function() {
    scene_axle(body(), law(), resist(), omega0_rad_per_s = stats::rnorm(1), through = "centre")
  },
  pendulum = function() {
    scene_pendulum(body_rod_end(size(), size()), theta0_rad = stats::runif(1, -3, 3))
  },
  gears = function() scene_gears(c(size(), size()), size(), efficiency = 0.9, torque = c(1, 0)),
  rotors = function() {
    scene_rotors(
      c(size(), size(), size()), 100 * size(), size() / 10, omega0_rad_per_s = stats::rnorm(3)
    )
  },
  clutch = function() scene_clutch(size(), size(), size(), omega0_rad_per_s = c(5 * size(), 0)),
  drive = function() {
    scene_drive(
      c(size(), size(), size()),
      list(coupling_shaft(50 * size(), 0.1), pick(coupling_clutch(size()), coupling_gear(2))),
      torque = list(pick(1, law()), NULL, NULL), brake = list(NULL, NULL, pick(NULL, brake(0.1)))
    )
  },
  incline = function() {
    scene_incline(
      round_body(), stats::runif(1, 0, 60), static_friction = 0.3, v0_m_per_s = stats::rnorm(1),
      kinetic_friction = 0.2, omega0_rad_per_s = stats::rnorm(1)
    )
  },
  free = function() {
    scene_free(
      body_box(size(), size(), 1, 2), stats::rnorm(3), torque = pick(NULL, stats::rnorm(3) / 10),
      rotors = pick(NULL, rotor("z", 0.01, 100 * stats::rnorm(1)), list(
        rotor(stats::rnorm(3), 0.01, stats::rnorm(1), 0.01), rotor("x", 0.01, size())
      ))
    )
  },
  pivot = function() {
    scene_pivot(
      c(1, 1, 0.5) * size(), c(0, 0.1, 20), mass_kg = size(), centre_m = c(0, 0, 0.1),
      attitude0 = attitude_from(c(1, 0, 0, stats::runif(1)), "axis_angle")
    )
  },
  hoop = function() {
    scene_hoop(
      size(), size(), stats::rnorm(1, 0, 5), theta0_rad = stats::runif(1, -2, 2),
      resistance = resistance(drag_n_s_per_m = pick(0, 0.1)), static_friction = pick(0, 0.1)
    )
  },
  chain = function() {
    scene_chain(
      c(size(), size()), c(size(), size()), stats::runif(2, -1, 1),
      links = pick("rods", "points"), resistance = pick(0, 0.05)
    )
  }
)

lab <- file.path(folder, "lab.sqlite")
records_create(lab)
con <- DBI::dbConnect(RSQLite::SQLite(), lab)
left_out <- 0L
for (i in seq_len(scenes)) {
  repeat {
    scene <- quiet(makers[[1L + (i - 1L) %% length(makers)]]())
    motion <- tryCatch(
      quiet(trajectory(scene, sort(c(0, stats::runif(19, 0, 2))), accuracy = 1e-8)),
      rotdyn_error = function(e) NULL
    )
    if (!is.null(motion)) break
    left_out <- left_out + 1L
  }
  records_add(con, motion)
}
# Scenes of equations have an R function, which a database does not run.
kinds <- setdiff(metadata()$constraints$constraint_kind, "equations")
stopifnot(setequal(records_list(con)$constraint_kind, kinds))
DBI::dbDisconnect(con)
cat(scenes, "scenes recorded,", left_out, "without a motion left out\n")
again <- file.path(folder, "again.R")
writeLines(sprintf("library(rotdyn)
con <- DBI::dbConnect(RSQLite::SQLite(), '%s')
verdicts <- vapply(records_list(con)$run, function(run) records_rerun(con, run)$verdict, '')
print(table(verdicts))
quit(status = !all(verdicts == 'identical'))", lab), again)
r <- file.path(R.home("bin"), "Rscript")
failed <- system2(r, again) != 0L
cat(if (failed) "not ok -" else "ok -", "computed again in a new session\n")

# A process that records as fast as it can, killed within a second of its first records: R has
# compiled by then what they call.
writeLines(sprintf("library(rotdyn)
con <- DBI::dbConnect(RSQLite::SQLite(), '%s')
motion <- trajectory(scene_axle(body_disk(2, 0.25), 0.8), 0:99)
for (i in 1:3) records_add(con, motion)
cat(Sys.getpid(), file = '%s')
repeat records_add(con, motion)", lab, file.path(folder, "pid")), file.path(folder, "write.R"))
before <- nrow(records_list(lab))
for (i in seq_len(kills)) {
  unlink(file.path(folder, "pid"))
  system2(r, file.path(folder, "write.R"), wait = FALSE)
  while (!file.exists(file.path(folder, "pid"))) Sys.sleep(0.01)
  Sys.sleep(0.05 + stats::runif(1))
  tools::pskill(as.integer(readLines(file.path(folder, "pid"), warn = FALSE)), 9L)
  Sys.sleep(0.05)
}
checked <- records_check(lab)
sound <- all(checked$holds)
failed <- failed || !sound
cat(
  if (sound) "ok -" else "not ok -", kills, "kills:", nrow(records_list(lab)) - before,
  "runs recorded, none torn\n"
)
if (!sound) print(as.data.frame(checked[!checked$holds, ]))
quit(status = failed)
