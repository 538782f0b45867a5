# Do the figures of integrated motions hold where rounding or two loose runs decide? Orbits by
# scene_equations(), of eccentricities of 0.3 to 0.97 over 5 to 80 s at accuracies of 1e-11 to 1e-5,
# beside Kepler's equation; and damped, driven pendulums, by an axle or by equations, over 2 to 60 s
# at accuracies of 1e-4 to 0.1, beside Taylor series of order 24 in steps of 0.05 s.
#
#   Rscript bench/coverage/equations.R [SCENES of each [SEED]]
#
# A line for each: figures that are not known, figures that the truth exceeds, by how much at most,
# and the calls of the right-hand side. Ends with status 1 where more than one of a hundred are
# exceeded or unknown, or one by more than ten times.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args)) as.integer(args[1]) else 300L
seed <- if (length(args) > 1L) as.integer(args[2]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

between <- function(low, high) stats::runif(1, low, high)

# Position and velocity at time t after the pericentre; mean motion and semi-major axis 1.
kepler <- function(e, t) {
  anomaly <- stats::uniroot(function(x) x - e * sin(x) - t, t + c(-1, 1), tol = 1e-15)$root
  for (k in 1:3) {
    anomaly <- anomaly - (anomaly - e * sin(anomaly) - t) / (1 - e * cos(anomaly))
  }
  far <- 1 - e * cos(anomaly)
  c(x = cos(anomaly) - e, y = sqrt(1 - e^2) * sin(anomaly),
    vx = -sin(anomaly) / far, vy = sqrt(1 - e^2) * cos(anomaly) / far)
}

orbit <- function() {
  e <- between(0.3, 0.97)
  end_s <- between(5, 80)
  scene <- scene_equations(
    function(x, y, vx, vy) c(vx, vy, -c(x, y) / (x^2 + y^2)^1.5),
    c(x = 1 - e, y = 0, vx = 0, vy = sqrt((1 + e) / (1 - e)))
  )
  list(scene = scene, end_s = end_s, accuracy = 10^between(-11, -5), truth = kepler(e, end_s))
}

# x'' = -gravity sin(x) - friction x' + push cos(rate t)
pendulum_by_series <- function(p, end_s, order = 24L) {
  steps <- ceiling(end_s / 0.05)
  h <- end_s / steps
  x <- c(p$angle, 0)
  powers <- h^(0:order)
  for (n in seq_len(steps) - 1L) {
    a <- v <- sine <- cosine <- double(order + 1L)
    a[1] <- x[1]
    v[1] <- x[2]
    sine[1] <- sin(a[1])
    cosine[1] <- cos(a[1])
    k <- 0:order
    push <- p$push * p$rate^k / factorial(k) * cos(p$rate * n * h + k * pi / 2)
    for (j in seq_len(order)) {
      i <- seq_len(j)
      a[j + 1] <- v[j] / j
      v[j + 1] <- (-p$gravity * sine[j] - p$friction * v[j] + push[j]) / j
      sine[j + 1] <- sum(i * a[i + 1] * cosine[j + 1 - i]) / j
      cosine[j + 1] <- -sum(i * a[i + 1] * sine[j + 1 - i]) / j
    }
    x <- c(sum(a * powers), sum(v * powers))
  }
  x
}

driven <- function() {
  p <- list(push = between(0, 3), rate = between(0.3, 4), friction = 10^between(-2, 0),
            gravity = between(0.5, 5), angle = between(-3, 3))
  end_s <- between(2, 60)
  if (stats::runif(1) < 0.5) {
    law <- torque_gravity(p$gravity, 1, gravity_m_per_s2 = 1) + torque_sinusoid(p$push, p$rate)
    scene <- scene_axle(1, law, resistance(p$friction), theta0_rad = p$angle)
    names <- c("theta_rad", "omega_rad_per_s")
  } else {
    scene <- scene_equations(
      function(time_s, x, v) {
        c(v, -p$gravity * sin(x) - p$friction * v + p$push * cos(p$rate * time_s))
      },
      c(x = p$angle, v = 0)
    )
    names <- c("x", "v")
  }
  list(scene = scene, end_s = end_s, accuracy = 10^between(-4, -1),
       truth = stats::setNames(pendulum_by_series(p, end_s), names))
}

judge <- function(name, draw) {
  calls <- 0
  over <- vapply(seq_len(scenes), function(k) {
    one <- draw()
    motion <- suppressWarnings(trajectory(one$scene, c(0, one$end_s), one$accuracy))
    run <- attr(motion, "run")$info
    calls <<- calls + run$rhs_calls
    last <- unlist(motion[nrow(motion), names(one$truth)])
    max(abs(last - one$truth) / unlist(run$sizes)[seq_along(last)]) / run$error
  }, double(1))
  unknown <- sum(is.na(over))
  exceeded <- sum(over > 1, na.rm = TRUE)
  cat(sprintf(
    "%-17s %d scenes: %d figures unknown, %d exceeded, by %.3g at most; median %.2g; %.0f calls\n",
    name, scenes, unknown, exceeded, max(over, na.rm = TRUE), stats::median(over, na.rm = TRUE),
    calls
  ))
  unknown + exceeded > 0.01 * scenes || max(over, na.rm = TRUE) > 10
}

bad <- c(judge("orbits", orbit), judge("driven pendulums", driven))
cat("equations, seed ", seed, if (any(bad)) ": outside\n" else ": ok\n", sep = "")
quit(status = as.integer(any(bad)))
