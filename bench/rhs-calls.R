# Calls of the torque function at equal true error: rotdyn at accuracies from 1e-3 to 1e-11, and for
# each the fewest calls with which any of deSolve's methods comes at least as near, at whatever
# tolerance, known in hindsight. Evaluated points count as calls on both sides.

calls_accuracies <- 10^-c(3, 5, 7, 9, 11)

# A scene: the law that both sides call, what else acts, and where the truth comes from.
calls_scenes <- function() {
  pendulum <- function(t, theta, omega) -9.81 * sin(theta) - 0.02 * omega
  driven <- function(t, theta, omega) {
    2 * (1 - theta^2) * omega - theta + 0.5 * cos(1.3 * t)
  }
  # Neither powers nor harmonics: what rotdyn guesses of a law does not hold here.
  other <- function(t, theta, omega) {
    -4 * tanh(3 * theta) - 0.1 * omega + 0.3 * sin(t) * theta + 0.2 * cos(2.7 * t)
  }
  state_scene <- function(law, theta0) {
    rotdyn::scene_axle(1, rotdyn::torque_function(law, breaks_s = numeric()), theta0_rad = theta0)
  }
  list(
    "spin-up, f(t)" = list(
      scene = spin_scene(rotdyn::torque_function(spin_torque, breaks_s = c(1, 4, 6))),
      truth = spin_scene(rotdyn::torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))),
      rate = function(t, theta, omega) (spin_torque(t) - 0.03 * omega) / 0.0625,
      start = c(0, 0), stops = c(0, 1, 4, 6, 8)
    ),
    "pendulum, f(t, theta, omega)" = list(
      scene = state_scene(pendulum, 2.6), rate = pendulum, start = c(2.6, 0), stops = c(0, 20)
    ),
    "driven van der Pol, f(t, theta, omega)" = list(
      scene = state_scene(driven, 1), rate = driven, start = c(1, 0), stops = c(0, 20)
    ),
    "soft stop, driven twice, f(t, theta, omega)" = list(
      scene = state_scene(other, 0.8), rate = other, start = c(0.8, 0), stops = c(0, 20)
    )
  )
}

# deSolve's methods with the tolerances they are tried at: function(y, times, rate, tolerance).
calls_methods <- function() {
  steps <- function(to, by) 10^-seq(2, to, by = by)
  lsode <- function(mf) {
    function(y, t, f, tol) {
      deSolve::lsode(y, t, f, NULL, rtol = tol, atol = tol, mf = mf, hmax = 0, maxsteps = 1e5)
    }
  }
  rk <- function(name) {
    force(name)
    function(y, t, f, tol) {
      deSolve::rk(
        y, t, f, NULL, rtol = tol, atol = tol, method = deSolve::rkMethod(name),
        hmax = diff(range(t)), maxsteps = 20000
      )
    }
  }
  list(
    lsoda = list(steps(13.5, 0.25), function(y, t, f, tol) {
      deSolve::lsoda(y, t, f, NULL, rtol = tol, atol = tol, hmax = 0, maxsteps = 1e5)
    }),
    "lsoda, default hmax" = list(steps(12, 1), function(y, t, f, tol) {
      deSolve::lsoda(y, t, f, NULL, rtol = tol, atol = tol, maxsteps = 1e5)
    }),
    adams = list(steps(13.5, 0.25), lsode(10)),
    bdf = list(steps(10, 0.5), lsode(22)),
    vode = list(steps(13.5, 0.25), function(y, t, f, tol) {
      deSolve::vode(y, t, f, NULL, rtol = tol, atol = tol, mf = 10, hmax = 0, maxsteps = 1e5)
    }),
    ode45 = list(steps(9, 0.5), rk("ode45")),
    rk78f = list(steps(11, 0.5), rk("rk78f")),
    rk78dp = list(steps(11, 0.5), rk("rk78dp")),
    radau = list(steps(9, 0.5), function(y, t, f, tol) {
      deSolve::radau(y, t, f, NULL, rtol = tol, atol = tol, maxsteps = 1e5)
    })
  )
}

# Runs from stop to stop, so that deSolve is told the breaks too; and once over them.
calls_of_desolve <- function(case, times, truth, size, methods) {
  rows <- list()
  for (name in names(methods)) {
    # Runge-Kutta steps end at rows: with many of them there is nothing to gain.
    if (startsWith(name, "rk") && length(times) > 200L) next
    for (tolerance in methods[[name]][[1]]) {
      for (stops in unique(list(case$stops, range(case$stops)))) {
        run <- one_desolve(case, times, stops, methods[[name]][[2]], tolerance)
        if (is.null(run)) next
        off <- max(abs(run$theta - truth[, 1]) / size[1], abs(run$omega - truth[, 2]) / size[2])
        text <- paste0(name, ", ", format(tolerance, digits = 2))
        if (length(case$stops) > length(stops)) text <- paste0(text, ", over the breaks")
        rows[[length(rows) + 1L]] <- data.frame(text = text, error = off, calls = run$calls)
      }
    }
  }
  rows <- do.call(rbind, rows)
  rows[is.finite(rows$error), ]
}

one_desolve <- function(case, times, stops, method, tolerance) {
  calls <- 0
  inner <- c(-Inf, Inf)
  # As rotdyn does, each piece stays on its own side of a break.
  rate <- function(t, y, parms) {
    calls <<- calls + 1
    if (calls > 30000) stop("too many calls")
    t <- min(max(t, inner[1]), inner[2])
    list(c(y[2], case$rate(t, y[1], y[2])))
  }
  theta <- omega <- double(length(times))
  y <- case$start
  for (i in seq_along(stops)[-1]) {
    inside <- times > stops[i - 1] & times <= stops[i]
    if (i == 2L) inside <- inside | times == stops[1]
    t <- unique(c(stops[i - 1], times[inside], stops[i]))
    if (length(stops) > 2L) inner <- stops[c(i - 1, i)] + c(1e-12, -1e-12)
    got <- tryCatch(
      {
        utils::capture.output(got <- suppressWarnings(method(y, t, rate, tolerance)))
        got
      },
      error = function(e) NULL
    )
    if (is.null(got) || nrow(got) != length(t)) {
      return(NULL)
    }
    at <- match(times[inside], t)
    theta[inside] <- got[at, 2]
    omega[inside] <- got[at, 3]
    y <- unname(got[length(t), 2:3])
  }
  list(theta = theta, omega = omega, calls = calls)
}

calls_row <- function(case, contender, error, calls, ratio) {
  data.frame(
    comparison = "rhs-calls", case = case, contender = contender, median_us = NA_real_,
    q1_us = NA_real_, q3_us = NA_real_, error = error, error_pointwise = NA_real_,
    ratio_median = ratio, ratio_q1 = NA_real_, ratio_q3 = NA_real_, rhs_calls = calls
  )
}

# Two rows for each accuracy: rotdyn's, and the cheapest of deSolve's that comes as near, with the
# ratio of the calls.
run_rhs_calls <- function(rounds) {
  if (!has_package("deSolve")) {
    return(NULL)
  }
  methods <- calls_methods()
  scenes <- calls_scenes()
  rows <- list()
  for (n in c(100, 1000)) {
    for (name in names(scenes)) {
      case <- scenes[[name]]
      label <- paste0(name, ", ", n, " rows")
      times <- seq(case$stops[1], case$stops[length(case$stops)], length.out = n)
      exact <- if (is.null(case$truth)) {
        rotdyn::trajectory(case$scene, times, 1e-13, model = "axle_rk8pd")
      } else {
        rotdyn::trajectory(case$truth, times, 1e-13)
      }
      truth <- cbind(exact$theta_rad, exact$omega_rad_per_s)
      size <- apply(abs(truth), 2, max)
      others <- calls_of_desolve(case, times, truth, size, methods)
      for (accuracy in calls_accuracies) {
        motion <- rotdyn::trajectory(case$scene, times, accuracy)
        off <- max(
          abs(motion$theta_rad - truth[, 1]) / size[1],
          abs(motion$omega_rad_per_s - truth[, 2]) / size[2]
        )
        calls <- attr(motion, "run")$info$rhs_calls
        near <- others[others$error <= off, ]
        best <- near[which.min(near$calls), ]
        asked <- format(accuracy)
        rows[[length(rows) + 1L]] <- calls_row(label, paste0("rotdyn, ", asked), off, calls, NA)
        rows[[length(rows) + 1L]] <- if (nrow(best)) {
          calls_row(
            label, paste0("deSolve for ", asked, ": ", best$text), best$error, best$calls,
            calls / best$calls
          )
        } else {
          calls_row(label, paste0("deSolve for ", asked, ": none comes as near"), NA, NA, NA)
        }
      }
      message("  ", label)
    }
  }
  do.call(rbind, rows)
}

# rotdyn and its match side by side.
calls_table <- function(rows) {
  ours <- rows[startsWith(rows$contender, "rotdyn"), ]
  theirs <- rows[startsWith(rows$contender, "deSolve"), ]
  markdown(list(
    "scene" = ifelse(duplicated(ours$case), "", ours$case),
    "accuracy asked" = sub("rotdyn, ", "", ours$contender),
    "true error" = small(ours$error),
    "calls" = number(ours$rhs_calls, 6),
    "deSolve's cheapest that is as near" = sub("deSolve for [^:]*: ", "", theirs$contender),
    "its true error" = small(theirs$error),
    "its calls" = number(theirs$rhs_calls, 6),
    "calls / deSolve's" = number(theirs$ratio_median, 2)
  ))
}
