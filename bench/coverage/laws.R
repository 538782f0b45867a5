# Do the reported errors cover the true ones where the torque is an R function? Random laws of each
# class, judged by laws.c in quadruple precision.
#
#   Rscript bench/coverage/laws.R PROGRAM [SCENES of each class [SEED [CLASS ...]]]
#
# A miss: the true error of theta or omega exceeds the figure. A silent miss: by more than ten times
# the figure and ten times the accuracy asked, without a warning. Ends with status 1 where a class
# is covered in fewer than 95 of 100 scenes, or a miss is silent.
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args) > 1L) as.integer(args[2]) else 200L
seed <- if (length(args) > 2L) as.integer(args[3]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

parameters <- c(
  "inertia", "theta0", "omega0", "a", "b", "c", "w", "phase", "theta1", "kink_theta", "jump_theta",
  "omega1", "kink_omega", "jump_omega", "time1", "kink_time", "jump_time", "pulse", "pulse_s",
  "width_s"
)

power <- function(lo, hi) 10^stats::runif(1, lo, hi)
either <- function(x) x * sample(c(-1, 1), 1)
chance <- function(p) stats::runif(1) < p

# A smooth law: a pendulum, damped and driven, any of these at times absent.
base_law <- function() {
  x <- stats::setNames(numeric(length(parameters)), parameters)
  x[["inertia"]] <- power(-1, 1)
  x[["span_s"]] <- power(-0.3, 1.3)
  x[["theta0"]] <- either(stats::runif(1, 0, 2))
  x[["omega0"]] <- either(stats::runif(1, 0, 3))
  if (chance(0.7)) x[["a"]] <- x[["inertia"]] * power(-1, 1)
  if (chance(0.7)) x[["b"]] <- x[["inertia"]] * power(-2, 0.3)
  if (chance(0.7)) x[["c"]] <- either(x[["inertia"]] * power(-1, 1))
  x[["w"]] <- power(-0.5, 0.7)
  x[["phase"]] <- stats::runif(1, 0, 6)
  x[["theta1"]] <- x[["omega1"]] <- 1e9
  x[["time1"]] <- 1e9
  x[["width_s"]] <- 1
  x
}

classes <- list(
  smooth = identity,
  kink_state = function(x) {
    if (chance(0.5)) {
      x[["theta1"]] <- x[["theta0"]] + sign(x[["omega0"]]) * stats::runif(1, 0, 1)
      x[["kink_theta"]] <- either(x[["inertia"]] * power(-1, 1))
    } else {
      x[["omega1"]] <- stats::runif(1, -1, 1)
      x[["kink_omega"]] <- -x[["inertia"]] * power(-1, 0.5)
    }
    x
  },
  jump_state = function(x) {
    if (chance(0.5)) {
      x[["theta1"]] <- x[["theta0"]] + sign(x[["omega0"]]) * stats::runif(1, 0, 1)
      x[["jump_theta"]] <- either(x[["inertia"]] * power(-1, 0.5))
    } else {
      x[["omega1"]] <- stats::runif(1, -1, 1)
      x[["jump_omega"]] <- either(x[["inertia"]] * power(-1, 0.5))
    }
    x
  },
  kink_time = function(x) {
    x[["time1"]] <- x[["span_s"]] * stats::runif(1, 0.05, 0.95)
    x[["kink_time"]] <- either(x[["inertia"]] * power(-1, 1))
    x
  },
  jump_time = function(x) {
    x[["time1"]] <- x[["span_s"]] * stats::runif(1, 0.05, 0.95)
    x[["jump_time"]] <- either(x[["inertia"]] * power(-1, 0.5))
    x
  },
  pulse = function(x) {
    x[["pulse_s"]] <- x[["span_s"]] * stats::runif(1, 0.05, 0.95)
    x[["width_s"]] <- x[["span_s"]] * power(-2.3, -1)
    x[["pulse"]] <- either(x[["inertia"]] * power(-0.5, 1)) / x[["width_s"]]
    x
  }
)

law_of <- function(x) {
  x <- as.list(x)
  of_state <- x$a != 0 || x$b != 0 || x$theta1 < 1e9 || x$omega1 < 1e9
  in_time <- function(t) {
    y <- x$c * cos(x$w * t + x$phase)
    if (t >= x$time1) y <- y + x$kink_time * (t - x$time1) + x$jump_time
    if (x$pulse != 0) y <- y + x$pulse * exp(-((t - x$pulse_s) / x$width_s)^2)
    y
  }
  if (!of_state) return(function(time_s) in_time(time_s))
  function(time_s, theta_rad, omega_rad_per_s) {
    y <- in_time(time_s) - x$a * sin(theta_rad) - x$b * omega_rad_per_s
    if (theta_rad > x$theta1) y <- y + x$kink_theta * (theta_rad - x$theta1) + x$jump_theta
    if (omega_rad_per_s > x$omega1) {
      y <- y + x$kink_omega * (omega_rad_per_s - x$omega1) + x$jump_omega
    }
    y
  }
}

truths <- function(program, laws, rows) {
  lines <- mapply(function(x, t) {
    paste(sprintf("%.17g", c(x[parameters], length(t), t)), collapse = " ")
  }, laws, rows)
  answer <- system2(program, input = lines, stdout = TRUE)
  Map(function(line, t) {
    y <- scan(text = line, quiet = TRUE)
    if (length(y) == 2 * length(t)) matrix(y, ncol = 2, byrow = TRUE)
  }, answer, rows)
}

judge <- function(x, t, truth, accuracy, model) {
  scene <- scene_axle(
    x[["inertia"]], torque_function(law_of(x)), theta0_rad = x[["theta0"]],
    omega0_rad_per_s = x[["omega0"]]
  )
  warned <- FALSE
  motion <- tryCatch(
    withCallingHandlers(trajectory(scene, t, accuracy, model), warning = function(w) {
      warned <<- warned || !inherits(w, "rotdyn_warning_breaks")
      invokeRestart("muffleWarning")
    }),
    error = identity
  )
  if (inherits(motion, "error")) return(c(NA, NA, NA, NA))
  run <- attr(motion, "run")$info
  states <- cbind(motion$theta_rad, motion$omega_rad_per_s)
  off <- apply(abs(states - truth), 2, max)
  # The truth is written with 17 digits.
  off <- pmax(0, off - 2e-16 * apply(abs(truth), 2, max))
  held <- all(off <= run$errors)
  silent <- !warned &&
    any(off > 10 * run$errors & off > 10 * accuracy * apply(abs(truth), 2, max))
  c(held, silent, max(off / run$errors), run$rhs_calls)
}

if (!interactive() && length(args)) {
  bad <- FALSE
  judged <- silent <- 0
  wanted <- if (length(args) > 3L) args[-(1:3)] else names(classes)
  for (name in wanted) {
    laws <- lapply(seq_len(scenes), function(i) classes[[name]](base_law()))
    rows <- lapply(laws, function(x) c(0, sort(stats::runif(15, 0, x[["span_s"]]))))
    accuracy <- lapply(laws, function(x) power(-12, -3))
    truth <- truths(args[1], laws, rows)
    for (model in list(NULL, "axle_rk8pd", "axle_radau")) {
      found <- mapply(function(x, t, y, a) {
        if (is.null(y)) c(NA, NA, NA, NA) else judge(x, t, y, a, model)
      }, laws, rows, truth, accuracy)
      n <- sum(!is.na(found[1, ]))
      worst <- order(-found[3, ])[1:3]
      judged <- judged + n
      silent <- silent + sum(found[2, ], na.rm = TRUE)
      cat(sprintf(
        "%-10s %-10s %4d scenes, covered %5.1f %%, silent %d, calls %.0f; worst %s\n", name,
        if (is.null(model)) "chosen" else model, n, 100 * mean(found[1, ], na.rm = TRUE),
        sum(found[2, ], na.rm = TRUE), mean(found[4, ], na.rm = TRUE),
        paste0(worst, ": ", signif(found[3, worst], 2), collapse = ", ")
      ))
      bad <- bad || mean(found[1, ], na.rm = TRUE) < 0.95 || any(found[2, ] == 1, na.rm = TRUE)
    }
  }
  cat(sprintf("scenes: %d judged, %d silent; seed %d\n", judged, silent, seed))
  quit(status = as.integer(bad))
}
