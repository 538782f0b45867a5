# Time of fit_scene() beside other tools at equal result, and who is right where a stop falls inside
# the record. From the top of the repository, with the package installed:
#
#   Rscript bench/fit.R
#
# Peers: nls() around the closed form, and FME's modFit() (Levenberg-Marquardt, differences) around
# deSolve's lsoda with a compiled right-hand side. They start at the same numbers. Median processor
# time in ms; what could not run is "not measured". Errors are in standard errors of the fit.

if (!file.exists("bench/fit.R")) stop("run this from the top of the repository")
library(rotdyn)

milliseconds <- function(call, times = 7) {
  one <- function() {
    used <- system.time(call(), gcFirst = FALSE)
    1000 * (used[[1]] + used[[2]])
  }
  one()
  stats::median(replicate(times, one()))
}
line <- function(what, ms, ratio = NA, note = "") {
  cat(sprintf("%-62s %10.2f ms %8s  %s\n", what, ms,
              if (is.na(ratio)) "" else paste0(format(ratio, digits = 3), "x"), note))
}
noisy <- function(scene, time_s, column, sigma) {
  set.seed(1)
  out <- as.data.frame(trajectory(scene, time_s)[c("time_s", column)])
  out[[column]] <- out[[column]] + stats::rnorm(length(time_s), 0, sigma)
  out
}
standard <- function(fit, value) max(abs(value - fit$value) / fit$standard_error)

# ---- four unknowns, 1000 samples ----------------------------------------------------------------

wheel <- function(viscous, coulomb, theta0, omega0) {
  scene_axle(1, resistance = resistance(viscous, 0, coulomb), theta0_rad = theta0,
             omega0_rad_per_s = omega0)
}
unknown <- c("resistance$viscous_n_m_s", "resistance$coulomb_n_m", "theta0_rad",
             "omega0_rad_per_s")
moving <- noisy(wheel(0.1, 0.5, 0, 20), seq(0, 10, length.out = 1000), "theta_rad", 0.01)
guess <- c(viscous = 0.15, coulomb = 0.3, theta0 = 0.1, omega0 = 18)
start <- do.call(wheel, as.list(guess))
white <- function() fit_scene(start, moving, unknown, noise = "white")
fit <- white()
ours <- milliseconds(white)
cat("1000 angles, 4 unknowns, closed form\n")
line("fit_scene(), noise = \"white\"", ours, note = sprintf("%g runs", glance(fit)$runs))
found <- function() fit_scene(start, moving, unknown)
line("fit_scene()", milliseconds(found), note = sprintf("%g runs", glance(found())$runs))
given <- function() fit_scene(start, moving, unknown, noise = c(theta_rad = 0.01))
line("fit_scene(), noise given", milliseconds(given),
     note = sprintf("%g runs", glance(given())$runs))

angle <- function(t, viscous, coulomb, theta0, omega0) {
  rest <- coulomb / viscous
  theta0 - rest * t + (omega0 + rest) * -expm1(-viscous * t) / viscous
}
by_nls <- function() {
  stats::nls(theta_rad ~ angle(time_s, viscous, coulomb, theta0, omega0), moving,
             start = as.list(guess))
}
line("nls() of the closed form", milliseconds(by_nls), milliseconds(by_nls) / ours,
     sprintf("%.1e s.e. off", standard(fit, stats::coef(by_nls()))))

# A right-hand side in C, for lsoda.
slowing <- function() {
  folder <- tempfile("fit")
  dir.create(folder)
  source <- file.path(folder, "slowing.c")
  writeLines(c(
    "#include <R.h>", "static double p[2];",
    "void begin(void (*of)(int *, double *)) { int n = 2; of(&n, p); }",
    "void slowing(int *n, double *t, double *y, double *dy, double *out, int *ip) {",
    "  dy[0] = y[1];",
    "  dy[1] = -p[0] * y[1] - (y[1] > 0 ? p[1] : y[1] < 0 ? -p[1] : 0);", "}"
  ), source)
  old <- setwd(folder)
  on.exit(setwd(old))
  system2(file.path(R.home("bin"), "R"), c("CMD", "SHLIB", "slowing.c"), stdout = FALSE)
  dyn.load(file.path(folder, paste0("slowing", .Platform$dynlib.ext)))
}
has_fme <- requireNamespace("FME", quietly = TRUE) && requireNamespace("deSolve", quietly = TRUE)
by_fme <- function(record, p, tolerance = 1e-8) {
  residual <- function(p) {
    y <- deSolve::lsoda(
      c(p[["theta0"]], p[["omega0"]]), record$time_s, "slowing", p[c("viscous", "coulomb")],
      dllname = "slowing", initfunc = "begin", rtol = tolerance, atol = tolerance
    )
    y[, 2] - record$theta_rad
  }
  FME::modFit(residual, p, lower = c(0, 0, -Inf, -Inf))
}
if (has_fme) {
  slowing()
  peer <- suppressWarnings(by_fme(moving, guess))
  ms <- milliseconds(function() suppressWarnings(by_fme(moving, guess)), 3)
  line("modFit() around lsoda, compiled", ms, ms / ours,
       sprintf("%.1e s.e. off", standard(fit, stats::coef(peer))))
} else {
  cat("modFit() around lsoda: not measured (FME, deSolve)\n")
}

# ---- a stop inside the record -------------------------------------------------------------------

# Viscous loss is known from elsewhere: the stop tells the dry friction.
cat("\n200 angles, stop at 0.62 of the record, 3 unknowns\n")
stops <- noisy(wheel(0.1, 1, 0, 8), seq(0, 10, length.out = 200), "theta_rad", 0.01)
of_stop <- function() {
  fit_scene(wheel(0.1, 0.7, 0.1, 7), stops, unknown[2:4], noise = c(theta_rad = 0.01))
}
fit <- of_stop()
truth <- c(1, 0, 8)
line("fit_scene()", milliseconds(of_stop),
     note = sprintf("chi^2 %.1f, truth %.1f s.e. off", fit_squares <- sum(augment(fit)$residual^2) /
                      1e-4, standard(fit, truth)))
if (has_fme) {
  fixed <- function(tolerance) {
    residual <- function(p) {
      y <- deSolve::lsoda(
        c(p[["theta0"]], p[["omega0"]]), stops$time_s, "slowing", c(0.1, p[["coulomb"]]),
        dllname = "slowing", initfunc = "begin", rtol = tolerance, atol = tolerance
      )
      y[, 2] - stops$theta_rad
    }
    FME::modFit(residual, c(coulomb = 0.7, theta0 = 0.1, omega0 = 7), lower = c(0, -Inf, -Inf))
  }
  for (tolerance in c(1e-6, 1e-9)) {
    peer <- tryCatch(suppressWarnings(fixed(tolerance)), error = function(e) NULL)
    if (is.null(peer)) {
      cat("modFit(), tolerance", tolerance, ": fails\n")
      next
    }
    ms <- milliseconds(function() suppressWarnings(fixed(tolerance)), 1)
    spread <- tryCatch(suppressWarnings(summary(peer)$par[, 2]), error = function(e) rep(NaN, 3))
    line(sprintf("modFit(), tolerance %g", tolerance), ms, ms / milliseconds(of_stop),
         sprintf("chi^2 %.1f, %.2g s.e. off; its s.e. over ours %s", sum(peer$residuals^2) / 1e-4,
                 standard(fit, stats::coef(peer)),
                 paste(format(spread / fit$standard_error, digits = 2), collapse = ", ")))
  }
}

# ---- integrated ---------------------------------------------------------------------------------

cat("\nintegrated: a damped pendulum from 2 rad, 300 angles, 2 unknowns\n")
swing <- function(length, viscous) {
  scene_pendulum(body_point(1), length, resistance = resistance(viscous), theta0_rad = 2)
}
damped <- noisy(swing(1, 0.2), seq(0, 20, length.out = 300), "theta_rad", 0.01)
of_swing <- function() {
  fit_scene(swing(1.02, 0.15), damped, c("distance_m", "resistance$viscous_n_m_s"),
            noise = c(theta_rad = 0.01))
}
line("fit_scene()", milliseconds(of_swing, 3),
     note = sprintf("%g runs, model %s", glance(of_swing())$runs, glance(of_swing())$model))
