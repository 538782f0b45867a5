# A tumbling body beside integrators and physics engines: error of the attitude, change of energy
# and angular momentum, CPU time; and the CPU time of an output, free body and heavy top, and of a
# row of tumbling_table(). The truth is the closed form in quadruple precision
# (bench/coverage/free.c). Needs libquadmath; deSolve, a python3 with scipy, and Bullet, ODE and
# Simbody (libbullet-dev, libode-dev, libsimbody-dev) take part where they are installed. Rewrites
# the block "space" of bench/README.md. Five to ten minutes.
#
#   Rscript bench/space.R [--short]           from the top of the repository; --short: 1e3 s alone
suppressMessages(library(rotdyn))

if (!file.exists("bench/space.R")) stop("run this from the top of the repository")
for (file in c("peers", "report")) source(file.path("bench", paste0(file, ".R")))
short <- "--short" %in% commandArgs(trailingOnly = TRUE)

moments <- c(1, 2, 3)
omega0 <- c(0.01, 2, 0.01)
ends <- if (short) 1e3 else c(1e3, 1e5)
numbers <- function(...) sprintf("%.17g", c(...))

# A program of C or C++, with the flags of a pkg-config module; NULL where that is not there.
compile <- function(name, source, module, compiler = "gcc -std=gnu11 -ffp-contract=off -Isrc/core",
                    libs = "-lm") {
  flags <- run_quietly("pkg-config", c("--cflags", "--libs", module))
  if (!flags$ok) return(NULL)
  program <- file.path(scratch, name)
  result <- run_quietly("sh", c("-c", shQuote(paste(
    compiler, "-O2", paste(source, collapse = " "), flags$out, libs, "-o", shQuote(program)
  ))))
  if (!result$ok) stop(name, " does not compile:\n", paste(result$out, collapse = "\n"))
  program
}
run_rows <- function(program, ...) {
  out <- run_quietly(program, c(...))
  if (!out$ok) stop(basename(program), " failed: ", paste(out$out, collapse = "\n"))
  utils::read.table(text = out$out)
}

truth_program <- compile(
  "free", c("bench/coverage/free.c", core_files()), "gsl", libs = "-lquadmath -lm"
)
truth <- run_rows(truth_program, "truth", numbers(moments, omega0, ends))

# ---- one body, far in time ----------------------------------------------------------------------

table <- NULL
left_out <- character()

# A line of the table, from the state at the end: quaternion, omega along the body's axes.
add <- function(contender, end, state, seconds, calls = NA_real_) {
  state <- unname(unlist(state))
  q <- state[1:4] / sqrt(sum(state[1:4]^2)) # integrators leave the unit length
  as_row <- function(q) data.frame(qw = q[1], qx = q[2], qy = q[3], qz = q[4])
  w <- state[5:7]
  turned <- attitude_to(as_row(q), "matrix")
  momentum <- matrix(unlist(turned[1, ]), 3, byrow = TRUE) %*% (moments * w)
  off <- function(x, x0) sqrt(sum((x - x0)^2) / sum(x0^2))
  energy <- sum(moments * w^2) / sum(moments * omega0^2) - 1
  table <<- rbind(table, data.frame(
    end, contender,
    angle = attitude_difference(as_row(q), as_row(unlist(truth[match(end, ends), 2:5]))),
    energy, momentum = off(momentum, moments * omega0), seconds, calls
  ))
  message(sprintf("  %-40s to %g s: off by %.1e rad, %.3g s", contender, end,
                  table$angle[nrow(table)], seconds))
}
add_rows <- function(contender, rows) {
  for (k in seq_len(nrow(rows))) add(contender, rows[k, 1], rows[k, 2:8], rows[k, 9], rows[k, 10])
}
cpu <- function(go, least_s = 0.2) {
  go()
  n <- 1
  repeat {
    spent <- system.time(for (i in seq_len(n)) go())[["user.self"]]
    if (spent >= least_s) return(spent / n)
    n <- n * max(2, ceiling(least_s / max(spent, 1e-3)))
  }
}

scene <- scene_free(moments, omega0)
columns <- c("qw", "qx", "qy", "qz", paste0("omega_", c("x", "y", "z"), "_rad_per_s"))
last <- function(x) unlist(x[nrow(x), columns])
for (end in ends) {
  go <- function() trajectory(scene, end)
  add("rotdyn, exact, from R", end, last(go()), cpu(go))
}
spent <- system.time(
  x <- trajectory(scene, ends[1], accuracy = 1e-9, model = "free_rk8pd")
)[["user.self"]]
add("rotdyn, integrated at 1e-9, from R", ends[1], last(x), spent, attr(x, "run")$info$rhs_calls)

gsl_program <- compile("gsl", "bench/peers/space-gsl.c", "gsl")
for (tolerance in c("1e-14", "1e-10")) {
  add_rows(paste0("GSL rk8pd in C, ", tolerance),
           run_rows(gsl_program, tolerance, numbers(moments, omega0, ends)))
}

if (has_package("deSolve")) {
  copied <- file.path(scratch, "space-desolve.c")
  file.copy("bench/peers/space-desolve.c", copied)
  object <- file.path(scratch, paste0("space-desolve", .Platform$dynlib.ext))
  built <- run_quietly(
    file.path(R.home("bin"), "R"), c("CMD", "SHLIB", "-o", shQuote(object), shQuote(copied)),
    env = c("MAKEFLAGS=", "MAKELEVEL=")
  )
  if (!built$ok) stop("space-desolve.c does not compile:\n", paste(built$out, collapse = "\n"))
  dyn.load(object)
  rates <- function(t, y, parms) {
    w <- y[5:7]
    list(c(
      0.5 * (-y[2] * w[1] - y[3] * w[2] - y[4] * w[3]),
      0.5 * (y[1] * w[1] + y[3] * w[3] - y[4] * w[2]),
      0.5 * (y[1] * w[2] + y[4] * w[1] - y[2] * w[3]),
      0.5 * (y[1] * w[3] + y[2] * w[2] - y[3] * w[1]),
      (moments[2] - moments[3]) / moments[1] * w[2] * w[3],
      (moments[3] - moments[1]) / moments[2] * w[3] * w[1],
      (moments[1] - moments[2]) / moments[3] * w[1] * w[2]
    ))
  }
  by_desolve <- function(contender, end, func, ...) {
    spent <- system.time(out <- deSolve::ode(
      c(1, 0, 0, 0, omega0), c(0, end), func, moments, "lsoda", rtol = 1e-12, atol = 1e-12,
      maxsteps = 1e9, ...
    ))[["user.self"]]
    add(contender, end, out[2, -1], spent, attr(out, "istate")[3])
  }
  by_desolve("deSolve lsoda, R function, 1e-12", ends[1], rates)
  for (end in ends) {
    by_desolve("deSolve lsoda, compiled, 1e-12", end, "space_rates", dllname = "space-desolve",
               initfunc = "space_begin")
  }
} else {
  left_out <- c(left_out, "deSolve")
}

if (is.null(scipy)) {
  left_out <- c(left_out, "scipy")
} else {
  rows <- run_rows(scipy$command, "bench/peers/space-scipy.py", "DOP853", "1e-13",
                   numbers(moments, omega0, ends))
  add_rows("scipy DOP853, 1e-13", rows)
}

# ---- engines, torque-free, as a game or a simulation steps them ---------------------------------

engine <- function(module, name, source, compiler, runs) {
  program <- compile(module, source, module, compiler)
  if (is.null(program)) {
    left_out <<- c(left_out, name)
    return(invisible())
  }
  version <- run_quietly("pkg-config", c("--modversion", module))$out
  for (run in runs) {
    rows <- run_rows(program, numbers(run$how), numbers(moments, omega0, run$ends))
    add_rows(paste0(name, " ", version, ", ", run$label), rows)
  }
}
steps <- list(
  list(label = "steps of 1/240 s", how = 1 / 240, ends = ends),
  list(label = "steps of 1 ms", how = 1e-3, ends = ends)
)
engine("bullet", "Bullet", "bench/peers/space-bullet.cpp", "g++", steps)
engine("ode", "ODE", "bench/peers/space-ode.c", "gcc", steps)
engine("simbody", "Simbody", "bench/peers/space-simbody.cpp", "g++", list(
  list(label = "its default, 1e-3", how = c(0, 1e-3), ends = ends),
  list(label = "1e-6", how = c(0, 1e-6), ends = ends),
  list(label = "1e-9", how = c(0, 1e-9), ends = ends[1]),
  list(label = "steps of 1/240 s", how = c(1 / 240, 1), ends = ends[1])
))

# ---- many outputs, many bodies ------------------------------------------------------------------

us_per_row <- function(go) {
  best <- min(vapply(1:5, function(k) system.time(go())[["user.self"]], 0))
  best * 1e6 / 1e6
}
top <- function(spin) {
  scene_pivot(
    c(0.0042, 0.0042, 0.002), c(0, 0, spin), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
    attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  )
}
outputs <- function(scene, span) {
  t <- seq(0, span, length.out = 1e6)
  us_per_row(function() trajectory(scene, t))
}
set.seed(1)
draw <- function(low, high) stats::runif(1e6, low, high)
bodies <- data.frame(
  ixx_kg_m2 = draw(1, 2), iyy_kg_m2 = draw(1, 2), izz_kg_m2 = draw(1, 2),
  omega_x_rad_per_s = draw(-1, 1), omega_y_rad_per_s = draw(-1, 1), omega_z_rad_per_s = draw(-1, 1)
)
at <- 1e4
by_row <- us_per_row(function() tumbling_table(bodies, at))
same <- vapply(c(2, 3, 8), function(threads) {
  identical(tumbling_table(bodies, at, threads = threads), tumbling_table(bodies, at))
}, NA)
if (!all(same)) stop("tumbling_table() depends on the number of threads")
speed <- data.frame(
  what = c(
    "`trajectory()`, free body as above, 1e6 outputs to 1e3 s",
    "`trajectory()`, heavy top at 20 rad/s, 1e6 outputs to 100 s",
    "`trajectory()`, heavy top at 1e4 rad/s, 1e6 outputs to 100 s",
    "`tumbling_table()`, 1e6 random bodies to 1e4 s, one thread"
  ),
  us = c(outputs(scene, 1e3), outputs(top(20), 100), outputs(top(1e4), 100), by_row)
)

# ---- the page -----------------------------------------------------------------------------------

table <- table[order(table$end), ]
first <- !duplicated(table$end)
change <- function(x) {
  ifelse(abs(x) < 1e-3, small(x), paste(trimws(formatC(100 * x, 2, format = "fg")), "%"))
}
lines <- c(
  markdown(list(
    "to, s" = ifelse(first, formatC(table$end, format = "d", big.mark = ","), ""),
    "contender" = table$contender,
    "attitude off, rad" = small(table$angle),
    "energy" = change(table$energy),
    "angular momentum" = change(table$momentum),
    "CPU, s" = trimws(formatC(table$seconds, digits = 2, format = "g")),
    "right-hand sides or steps" = number(table$calls, 6)
  )),
  "",
  if (length(left_out)) c(paste0("Not installed: ", paste(left_out, collapse = ", "), "."), ""),
  markdown(list("from R" = speed$what, "CPU of a row, us" = number(speed$us, 2))),
  "", describe_machine()
)
cat(lines, sep = "\n")
if (!short) writeLines(replace_block(readLines(readme_file), "space", lines), readme_file)
unlink(scratch, recursive = TRUE)
