# A tumbling body and a heavy top beside integrators: error of the attitude, CPU time. The truth is
# the closed form in quadruple precision (bench/coverage/free.c). Needs gcc, GSL and libquadmath;
# deSolve and a python3 with scipy take part where they are installed.
#
#   Rscript bench/space.R                     from the top of the repository
suppressMessages(library(rotdyn))

if (!file.exists("bench/space.R")) stop("run this from the top of the repository")
build <- tempfile("space")
dir.create(build)
run <- function(command, ...) system2(command, c(...), stdout = TRUE)
gsl <- strsplit(paste(run("gsl-config", "--cflags", "--libs"), collapse = " "), " +")[[1]]
compile <- function(name, ...) {
  out <- file.path(build, name)
  code <- system2("gcc", c("-std=gnu11", "-O2", "-ffp-contract=off", "-Isrc", ..., gsl,
                           "-lquadmath", "-lm", "-o", out))
  if (code) stop("cannot compile ", name)
  out
}
truth_program <- compile("free", "bench/coverage/free.c", Sys.glob("src/rot_*.c"))
gsl_program <- compile("gsl", "bench/peers/space-gsl.c")

moments <- c(1, 2, 3)
omega0 <- c(0.01, 2, 0.01)
ends <- c(1e3, 1e5)
numbers <- function(...) sprintf("%.17g", c(...))
read_rows <- function(lines) utils::read.table(text = lines)
truth <- read_rows(run(truth_program, "truth", numbers(moments, omega0, ends)))

# The angle between attitudes; the quaternions of integrators are not of unit length.
off <- function(q, k) {
  as_row <- function(q) {
    q <- unname(unlist(q))
    q <- q / sqrt(sum(q^2))
    data.frame(qw = q[1], qx = q[2], qy = q[3], qz = q[4])
  }
  attitude_difference(as_row(q), as_row(truth[k, 2:5]))
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
say <- function(contender, span, error, seconds, calls) {
  cat(sprintf("%-34s %8s %12s %12s %12s\n", contender, span, error, seconds, calls))
}
line <- function(contender, span, error, seconds, calls = NA) {
  say(contender, format(span), sprintf("%.1e", error), sprintf("%.3g", seconds),
      if (is.na(calls)) "" else format(calls, big.mark = ","))
}

cat("Free body: I = (1, 2, 3) kg m^2, omega0 = (0.01, 2, 0.01) rad/s\n")
say("contender", "t, s", "off, rad", "CPU, s", "rhs")
scene <- scene_free(moments, omega0)
q_of <- function(x) unlist(x[nrow(x), c("qw", "qx", "qy", "qz")])
for (k in seq_along(ends)) {
  go <- function() trajectory(scene, ends[k])
  line("rotdyn, exact, from R", ends[k], off(q_of(go()), k), cpu(go))
}
spent <- system.time(
  x <- trajectory(scene, ends[1], accuracy = 1e-9, model = "free_rk8pd")
)[["user.self"]]
line("rotdyn, integrated at 1e-9", ends[1], off(q_of(x), 1), spent, attr(x, "run")$info$rhs_calls)
for (tolerance in c("1e-14", "1e-10")) {
  rows <- read_rows(run(gsl_program, tolerance, numbers(moments, omega0, ends)))
  for (k in seq_along(ends)) {
    line(paste("GSL rk8pd in C at", tolerance), ends[k], off(unlist(rows[k, 2:5]), k),
         rows[k, 6], rows[k, 7])
  }
}
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
if (requireNamespace("deSolve", quietly = TRUE)) {
  for (method in c("lsoda", "ode45")) {
    spent <- system.time(out <- deSolve::ode(
      c(1, 0, 0, 0, omega0), c(0, ends[1]), rates, NULL, method, rtol = 1e-12, atol = 1e-12,
      maxsteps = 1e7
    ))[["user.self"]]
    line(paste0("deSolve ", method, ", R function, 1e-12"), ends[1], off(out[2, 2:5], 1), spent,
         attr(out, "istate")[3])
  }
}
scipy <- '
import sys, time
from scipy.integrate import solve_ivp
i = [1.0, 2.0, 3.0]
def f(t, y):
    a, b, c, d, u, v, w = y
    return [.5*(-b*u-c*v-d*w), .5*(a*u+c*w-d*v), .5*(a*v+d*u-b*w), .5*(a*w+b*v-c*u),
            (i[1]-i[2])/i[0]*v*w, (i[2]-i[0])/i[1]*w*u, (i[0]-i[1])/i[2]*u*v]
s = time.process_time()
r = solve_ivp(f, (0, 1e3), [1, 0, 0, 0, .01, 2, .01], method="DOP853", rtol=1e-13, atol=1e-14)
print(*["%.17g" % x for x in r.y[:4, -1]], time.process_time() - s, r.nfev)
'
if (nzchar(Sys.which("python3")) &&
  system2("python3", c("-c", shQuote("import scipy")), stdout = FALSE, stderr = FALSE) == 0) {
  x <- scan(text = run("python3", "-c", shQuote(scipy)), quiet = TRUE)
  line("scipy DOP853 at 1e-13", ends[1], off(x[1:4], 1), x[5], x[6])
} else {
  cat("scipy: not installed\n")
}

cat("\nCPU time of an output from R, 1e6 outputs\n")
rows <- function(scene, span) {
  t <- seq(0, span, length.out = 1e6)
  best <- min(vapply(1:3, function(k) system.time(trajectory(scene, t))[["user.self"]], 0))
  best * 1e6 / 1e6
}
top <- function(spin) {
  scene_pivot(
    c(0.0042, 0.0042, 0.002), c(0, 0, spin), mass_kg = 0.5, centre_m = c(0, 0, 0.08),
    attitude0 = attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  )
}
cat(sprintf("  free body to 1e3 s               %.2f us\n", rows(scene, 1e3)))
for (spin in c(20, 1e4)) {
  cat(sprintf("  heavy top at %-6s rad/s, 100 s  %.2f us\n", format(spin), rows(top(spin), 100)))
}
unlink(build, recursive = TRUE)
