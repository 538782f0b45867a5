# Are narrow changes of a law found? Laws that are R functions, with a jump, a ramp or a bump in a
# narrow interval of time, of an angle or of a rate; axles, drives, inclines and free bodies, by
# each integrator. Every scene is one equation M u' = F(t, s, u), s' = u, in which F depends on one
# of its arguments alone, so that quadrature over smooth panels gives the truth.
#
#   Rscript bench/coverage/narrow.R [SCENES of each width [SEED]]
#
# Widths are parts of the range that the motion visits: from 1/200 to 1/20; from 1/2000 to 1/200
# with `resolution = 1/2000`; and the same without, which may be missed, since the head says so. A
# silent miss: the true error is more than ten times the figure and ten times the accuracy asked,
# without a warning. Ends with status 1 where one is found in the first two.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args)) as.integer(args[1]) else 300L
seed <- if (length(args) > 1L) as.integer(args[2]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

power <- function(lo, hi) 10^stats::runif(1, lo, hi)
pick <- function(x) x[[sample.int(length(x), 1)]]

# ---- truth --------------------------------------------------------------------------------------

legendre <- local({
  n <- 20
  i <- seq_len(n - 1)
  jacobi <- matrix(0, n, n)
  jacobi[cbind(i, i + 1)] <- jacobi[cbind(i + 1, i)] <- i / sqrt(4 * i^2 - 1)
  e <- eigen(jacobi, symmetric = TRUE)
  list(x = e$values, w = 2 * e$vectors[1, ]^2)
})

# The integral of f from a to b, from panel to panel.
integral <- function(f, a, b, edges) {
  if (b == a) return(0)
  inside <- edges[edges > min(a, b) & edges < max(a, b)]
  ends <- sort(unique(c(seq(a, b, length.out = 33), inside)))
  half <- diff(ends) / 2
  x <- outer(legendre$x, half) + rep(ends[-1] - half, each = length(legendre$x))
  total <- sum(half * colSums(legendre$w * matrix(f(as.vector(x)), nrow(x))))
  if (b > a) total else -total
}

solve_for <- function(f, lo, hi) stats::uniroot(f, c(lo, hi), tol = 1e-14)$root

# list(s, u): the final state; range: what the coordinate visits.
truth <- function(case) {
  mass <- case$mass
  end <- case$span_s
  u0 <- case$u0
  force <- case$force
  edges <- case$edges
  switch(case$of,
    time = list(
      u = u0 + integral(force, 0, end, edges) / mass,
      s = u0 * end + integral(function(t) (end - t) * force(t), 0, end, edges) / mass,
      range = end
    ),
    angle = {
      # The energy at each node of the quadrature over time, panel by panel.
      knots <- sort(unique(c(seq(0, case$most, length.out = 257), edges[edges < case$most])))
      steps <- vapply(seq_along(knots)[-1], function(i) {
        integral(force, knots[i - 1], knots[i], double())
      }, double(1))
      sum_at <- c(0, cumsum(steps))
      work <- function(s) {
        at <- findInterval(s, knots, all.inside = TRUE)
        sum_at[at] + vapply(seq_along(s), function(i) {
          half <- (s[i] - knots[at[i]]) / 2
          half * sum(legendre$w * force(knots[at[i]] + half * (1 + legendre$x)))
        }, double(1))
      }
      rate <- function(s) sqrt(u0^2 + 2 * work(s) / mass)
      takes <- vapply(seq_along(knots)[-1], function(i) {
        half <- diff(knots[i - 1:0]) / 2
        half * sum(legendre$w / rate(knots[i - 1] + half * (1 + legendre$x)))
      }, double(1))
      clock <- c(0, cumsum(takes))
      if (clock[length(clock)] <= end) return(NULL)
      i <- findInterval(end, clock)
      s <- solve_for(function(s) {
        half <- (s - knots[i]) / 2
        clock[i] + half * sum(legendre$w / rate(knots[i] + half * (1 + legendre$x))) - end
      }, knots[i], knots[i + 1])
      list(u = rate(s), s = s, range = s)
    },
    rate = {
      takes <- function(u) integral(function(v) mass / force(v), u0, u, edges)
      if (takes(case$most) <= end) return(NULL)
      u <- solve_for(function(u) takes(u) - end, u0, case$most)
      list(u = u, s = integral(function(v) mass * v / force(v), u0, u, edges), range = u - u0)
    }
  )
}

# ---- scenes -------------------------------------------------------------------------------------

shapes <- list(
  jump = function(x) as.double(abs(x) < 1),
  ramp = function(x) pmax(0, pmin(1, 2 - 2 * abs(x))),
  bump = function(x) ifelse(abs(x) < 1, (1 + cos(pi * x)) / 2, 0)
)
shape_edges <- list(jump = c(-1, 1), ramp = c(-1, -0.5, 0.5, 1), bump = c(-1, 1))

# A case with a change of `part` of the visited range.
draw_case <- function(part, kind) {
  of <- pick(c("time", "angle", "rate"))
  shape <- pick(names(shapes))
  mass <- power(-1, 1)
  span_s <- power(-0.5, 1.3)
  u0 <- power(-0.3, 1)
  if (kind == "free" && of == "angle") span_s <- 5 / (3 * u0)
  size <- mass * u0 / span_s
  a <- size * stats::runif(1, 0.1, 1)
  b <- stats::runif(1, -0.5, 0.5) * a
  k <- stats::runif(1, 0.5, 6)
  base <- switch(of,
    time = function(t) a + b * sin(k * t / span_s),
    angle = function(s) a + b * sin(k * s / (u0 * span_s)),
    rate = function(u) a + b * sin(k * u / u0)
  )
  plain <- list(
    of = of, mass = mass, u0 = u0, span_s = span_s, force = base, edges = double(),
    most = switch(of, time = NA, angle = 4 * u0 * span_s, rate = 4 * u0), kind = kind,
    shape = shape
  )
  motion <- truth(plain)
  if (is.null(motion)) return(NULL)
  from <- if (of == "rate") u0 else 0
  centre <- from + motion$range * stats::runif(1, 0.1, 0.9)
  half <- part * motion$range / 2
  height <- stats::runif(1, 0.3, 4) * a * if (of == "time") sample(c(-1, 1), 1) else 1
  feature <- shapes[[shape]]
  plain$force <- function(x) base(x) + height * feature((x - centre) / half)
  plain$edges <- centre + half * shape_edges[[shape]]
  plain$truth <- truth(plain)
  if (is.null(plain$truth)) return(NULL)
  plain$part <- 2 * half / plain$truth$range
  # Not beyond the range that is visited with the change.
  if (max(plain$edges) > from + plain$truth$range) return(NULL)
  plain
}

law_of <- function(case) {
  f <- case$force
  switch(case$of,
    time = function(time_s, theta_rad, omega_rad_per_s) f(time_s),
    angle = function(time_s, theta_rad, omega_rad_per_s) f(theta_rad),
    rate = function(time_s, theta_rad, omega_rad_per_s) f(omega_rad_per_s)
  )
}

scene_of <- function(case) {
  law <- law_of(case)
  if (case$of == "time" && stats::runif(1) < 0.5) law <- case$force
  given <- stats::runif(1) < 0.2
  switch(case$kind,
    axle = scene_axle(
      case$mass, if (given) torque_function(law, breaks_s = numeric()) else law,
      omega0_rad_per_s = case$u0
    ),
    drive = {
      ratio <- pick(c(-2, 0.5, 1, 3))
      scene_drive(
        c(0.7 * case$mass, 0.3 * case$mass * ratio^2), list(coupling_gear(ratio)),
        torque = list(law, NULL), omega0_rad_per_s = case$u0 / c(1, ratio)
      )
    },
    incline = {
      force <- law_of(case)
      scene_incline(
        body_sphere(case$mass / 1.4, 0.1), 0, static_friction = 1e6, kinetic_friction = 1e6,
        v0_m_per_s = case$u0,
        force = function(time_s, x_m, v_m_per_s) {
          force(time_s, x_m, v_m_per_s)
        }
      )
    },
    free = {
      f <- case$force
      moments <- case$mass * c(stats::runif(1, 0.55, 0.95), stats::runif(1, 0.55, 0.95), 1)
      scene_free(
        moments, c(0, 0, case$u0),
        torque = function(time_s, omega, attitude) {
          x <- switch(case$of,
            time = time_s,
            angle = 2 * atan2(attitude[4], attitude[1]) %% pi,
            rate = omega[3]
          )
          c(0, 0, f(x))
        }
      )
    }
  )
}

integrators <- list(
  axle = c("axle_rk8pd", "axle_radau"), drive = c("drive_rk8pd", "drive_radau"),
  incline = c("incline_rk8pd", "incline_radau"), free = c("free_rk8pd", "free_radau")
)

# ---- judgement ----------------------------------------------------------------------------------

judge <- function(case, resolution) {
  scene <- scene_of(case)
  accuracy <- pick(c(1e-4, 1e-6, 1e-9, 1e-9, 1e-11))
  model <- if (stats::runif(1) < 0.5) pick(integrators[[case$kind]])
  warned <- FALSE
  motion <- withCallingHandlers(
    trajectory(scene, c(0, case$span_s), accuracy, model, resolution = resolution),
    rotdyn_warning_accuracy = function(w) {
      warned <<- TRUE
      invokeRestart("muffleWarning")
    },
    rotdyn_warning_breaks = function(w) invokeRestart("muffleWarning")
  )
  last <- motion[nrow(motion), ]
  state <- switch(case$kind,
    axle = c(last$theta_rad, last$omega_rad_per_s),
    drive = unlist(motion[nrow(motion) - 1L, c("theta_rad", "omega_rad_per_s")]),
    incline = c(last$x_m, last$v_m_per_s),
    free = c(NA, last[["omega_z_rad_per_s"]])
  )
  true <- c(case$truth$s, case$truth$u)
  size <- pmax(abs(true), c(0, case$u0))
  error <- max(abs(state - true) / size, na.rm = TRUE)
  figure <- attr(motion, "run")$info$error
  list(
    error = error, figure = figure, accuracy = accuracy, model = attr(motion, "run")$model,
    covered = isTRUE(error <= figure + 1e-12),
    silent = !warned && !(error <= 10 * figure + 1e-11) && !(error <= 10 * accuracy)
  )
}

run_width <- function(name, lo, hi, resolution, may_miss) {
  done <- silent <- covered <- 0
  while (done < scenes) {
    case <- draw_case(exp(stats::runif(1, log(lo), log(hi))), pick(names(integrators)))
    if (is.null(case) || case$part < lo) next
    done <- done + 1
    seen <- tryCatch(judge(case, resolution), rotdyn_error = identity)
    if (inherits(seen, "error")) {
      cat(sprintf("  %s %d: %s %s %s: error: %s\n", name, done, case$kind, case$of, case$shape,
                  conditionMessage(seen)))
      silent <- silent + !may_miss
      next
    }
    covered <- covered + seen$covered
    silent <- silent + seen$silent
    if (seen$silent && !may_miss) {
      cat(sprintf(
        "  %s %d: %s %s %s by %s, width %.5f, accuracy %g: error %.2g, figure %.2g\n", name, done,
        case$kind, case$of, case$shape, seen$model, case$part, seen$accuracy, seen$error,
        seen$figure
      ))
    }
  }
  cat(sprintf("narrow, %s: %d scenes, %.1f %% covered, %d silent%s\n", name, scenes,
              100 * covered / scenes, silent, if (may_miss) ", as the head says" else ""))
  silent > 0 && !may_miss
}

cat("seed", seed, "\n")
bad <- c(
  run_width("from 1/200", 1 / 200, 1 / 20, 1 / 200, FALSE),
  run_width("from 1/2000, asked for", 1 / 2000, 1 / 200, 1 / 2000, FALSE),
  run_width("from 1/2000, not asked for", 1 / 2000, 1 / 200, 1 / 200, TRUE)
)
quit(status = as.integer(any(bad)))
