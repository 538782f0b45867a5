# Torque laws that are R functions: the cost of the default, of every other model that applies, and
# of deSolve's lsoda at the loosest tolerance with which its true error is no larger. 20 s, 201
# rows, accuracy 1e-9; laws of 0.5 to 500 us a call, of time and of state, smooth and kinked, their
# breaks given or looked for.

laws_times <- (0:200) / 10
laws_costs_us <- c(0.5, 5, 50, 500)

# Each law comes with a number of turns of an empty loop, which sets its cost. `told`: its breaks in
# time. `truth`: a torque that is solved in closed form; else rk8pd at 1e-13, stopped at `kink_rad`.
laws_scenes <- list(
  "f(t), smooth" = list(
    law = function(turns) {
      function(time_s) {
        for (i in seq_len(turns)) NULL
        0.5 * cos(2 * time_s) + 0.2 * cos(0.7 * time_s)
      }
    },
    told = numeric(),
    truth = function() rotdyn::torque_sinusoid(0.5, 2) + rotdyn::torque_sinusoid(0.2, 0.7)
  ),
  "f(t), kinked" = list(
    law = function(turns) {
      function(time_s) {
        for (i in seq_len(turns)) NULL
        (if (time_s < 3.3) 0.3 * time_s else 0.99) + 0.2 * cos(time_s)
      }
    },
    told = 3.3,
    truth = function() {
      rotdyn::torque_knots(c(0, 3.3, 20), c(0, 0.99, 0.99)) + rotdyn::torque_sinusoid(0.2, 1)
    }
  ),
  "f(state), smooth" = list(
    law = function(turns) {
      function(time_s, theta_rad, omega_rad_per_s) {
        for (i in seq_len(turns)) NULL
        -2 * sin(theta_rad) + 0.5 * cos(2 * time_s)
      }
    },
    told = numeric()
  ),
  "f(state), kinked" = list(
    law = function(turns) {
      function(time_s, theta_rad, omega_rad_per_s) {
        for (i in seq_len(turns)) NULL
        -2 * sin(theta_rad) - 3 * max(theta_rad - 0.5, 0) +
          0.5 * cos(2 * if (time_s < 3.3) time_s else 3.3)
      }
    },
    told = 3.3, kink_rad = 0.5
  )
)

laws_start <- c(0.8, 0)

laws_scene <- function(torque) rotdyn::scene_axle(1, torque, theta0_rad = laws_start[1])

# Theta and omega in columns.
laws_truth <- function(case) {
  if (!is.null(case$truth)) {
    return(laws_states(rotdyn::trajectory(laws_scene(case$truth()), laws_times, 1e-12)))
  }
  law <- case$law(0)
  run <- function(times, crossings) {
    scene <- laws_scene(rotdyn::torque_function(law, breaks_s = c(case$told, crossings)))
    suppressWarnings(rotdyn::trajectory(scene, times, 1e-13, model = "axle_rk8pd"))
  }
  crossings <- numeric()
  # Each run tells where theta crosses the kink; the next one stops there.
  for (k in if (is.null(case$kink_rad)) integer() else 1:4) {
    t <- seq(0, 20, length.out = 20001)
    m <- run(t, crossings)
    off <- m$theta_rad - case$kink_rad
    at <- which(off[-1] * off[-length(off)] <= 0)
    at <- ifelse(abs(off[at]) < abs(off[at + 1]), at, at + 1)
    # Newton's step with the acceleration: 0.5 ms at most.
    rate <- m$omega_rad_per_s[at]
    step <- -off[at] / rate
    step <- -off[at] / (rate + m$net_torque_n_m[at] * step / 2)
    crossings <- t[at] + step
  }
  laws_states(run(laws_times, crossings))
}

laws_states <- function(motion) cbind(motion$theta_rad, motion$omega_rad_per_s)

laws_error <- function(states, truth) {
  max(apply(abs(states - truth), 2, max) / apply(abs(truth), 2, max))
}

# lsoda from stop to stop: each piece stays on its own side of a break.
laws_lsoda <- function(law, breaks, tolerance) {
  of_state <- length(formals(law)) == 3L
  stops <- c(0, breaks, 20)
  states <- matrix(0, length(laws_times), 2)
  y <- laws_start
  for (i in seq_along(stops)[-1]) {
    to <- if (i < length(stops)) stops[i] - 1e-12 else stops[i]
    rate <- if (of_state) {
      function(t, y, parms) list(c(y[2], law(if (t > to) to else t, y[1], y[2])))
    } else {
      function(t, y, parms) list(c(y[2], law(if (t > to) to else t)))
    }
    inside <- which(laws_times >= stops[i - 1] & laws_times <= stops[i])
    t <- unique(c(stops[i - 1], laws_times[inside], stops[i]))
    out <- deSolve::lsoda(
      y, t, rate, NULL, rtol = tolerance, atol = tolerance, hmax = 0, maxsteps = 1e5
    )
    states[inside, ] <- out[match(laws_times[inside], t), 2:3]
    y <- unname(out[nrow(out), 2:3])
  }
  states
}

# The loosest tolerance with which lsoda comes as near, else that of its smallest error; and that
# error.
laws_tolerance <- function(law, breaks, truth, error) {
  nearest <- c(NA_real_, Inf)
  for (tolerance in 10^-seq(5, 14, by = 0.25)) {
    states <- tryCatch(
      suppressWarnings(laws_lsoda(law, breaks, tolerance)), error = function(e) NULL
    )
    off <- if (is.null(states)) NaN else laws_error(states, truth)
    if (isTRUE(off < nearest[2])) nearest <- c(tolerance, off)
    if (isTRUE(off <= error)) break
  }
  nearest
}

# Turns of the empty loop that make a call last so long.
laws_turns <- function(case, cost_us) {
  us <- function(turns) {
    law <- case$law(turns)
    call <- if (length(formals(law)) == 3L) function() law(1, 0.1, 0.2) else function() law(1)
    calls <- calls_per_batch(call, 1e4)
    min(vapply(1:7, function(i) laws_batch(call, calls), double(1)))
  }
  base <- us(0)
  max(0, round((cost_us - base) / ((us(1e4) - base) / 1e4)))
}

# Processor time: other programs may share the machine. Microseconds of one of `calls`.
laws_batch <- function(run, calls) {
  now <- getNamespace("rotdyn")$ffi_clock_cpu
  from <- .Call(now)
  for (i in seq_len(calls)) run()
  (.Call(now) - from) * 1e6 / calls
}

# Microseconds of each, in turns: a row each round, at least one, for two seconds. What took three
# times as long as the first at its first call is not run again.
laws_time <- function(runs, rounds) {
  once <- vapply(runs, laws_batch, double(1), 1)
  quick <- once < 3 * once[1]
  calls <- pmax(1, ceiling(2e4 / once))
  us <- matrix(once, rounds, length(runs), byrow = TRUE)
  from <- clock_us()
  for (round in seq_len(rounds)) {
    for (i in which(quick)) us[round, i] <- laws_batch(runs[[i]], calls[i])
    if (clock_us() - from > 2e6) break
  }
  us[seq_len(round), , drop = FALSE]
}

laws_case <- function(name, case, cost_us, told, truth, rounds) {
  breaks <- if (told) case$told
  label <- paste0(name, ", ", cost_us, " us, breaks ", if (told) "given" else "looked for")
  scene_of <- function(law) laws_scene(rotdyn::torque_function(law, breaks_s = breaks))
  quick <- scene_of(case$law(0))
  move <- function(scene, model) {
    suppressWarnings(rotdyn::trajectory(scene, laws_times, model = model))
  }
  chosen <- summary(move(quick, NULL))$model
  table <- rotdyn::choose_model(quick, laws_times)
  models <- c(list(NULL), as.list(setdiff(table$model[table$applies], chosen)))
  found <- lapply(models, function(model) {
    motion <- move(quick, model)
    c(laws_error(laws_states(motion), truth), summary(motion)$rhs_calls)
  })
  error <- vapply(found, `[`, double(1), 1L)
  calls <- vapply(found, `[`, double(1), 2L)
  contender <- c(paste0("chosen, ", chosen), unlist(models))
  # What calls an expensive law three times as often takes three times as long: not run.
  keep <- cost_us < 50 | calls <= 3 * calls[1]
  models <- models[keep]
  error <- error[keep]
  calls <- calls[keep]
  contender <- contender[keep]

  law <- case$law(laws_turns(case, cost_us))
  scene <- scene_of(law)
  runs <- lapply(models, function(model) {
    force(model)
    function() move(scene, model)
  })
  if (has_package("deSolve")) {
    near <- laws_tolerance(case$law(0), breaks, truth, error[1])
    contender <- c(contender, paste0("lsoda, ", format(near[1], digits = 2)))
    runs <- c(runs, function() laws_lsoda(law, breaks, near[1]))
    counted <- 0
    counting <- case$law(0)
    body(counting) <- call("{", quote(counted <<- counted + 1), body(counting))
    environment(counting) <- list2env(list(turns = 0), parent = environment())
    laws_lsoda(counting, breaks, near[1])
    calls <- c(calls, counted)
    error <- c(error, near[2])
  }
  us <- laws_time(runs, rounds)
  blank <- rep(NA_real_, length(contender) - length(runs))
  quartile <- function(x, p) {
    c(apply(x, 2, stats::quantile, p, na.rm = TRUE, names = FALSE), blank)
  }
  ratio <- us / us[, 1]
  message("  ", label, ": ", round(quartile(us, 0.5)[1]), " us")
  data.frame(
    comparison = "laws", case = label, contender = contender, median_us = quartile(us, 0.5),
    q1_us = quartile(us, 0.25), q3_us = quartile(us, 0.75), error = error,
    error_pointwise = NA_real_, ratio_median = quartile(ratio, 0.5),
    ratio_q1 = quartile(ratio, 0.25), ratio_q3 = quartile(ratio, 0.75),
    rhs_calls = c(calls, rep(NA_real_, length(contender) - length(calls)))
  )
}

# Time of the default over that of `others`, largest over the cases: a row for the goals.
laws_worst <- function(rows, text, others, keep) {
  worst <- vapply(split(rows, rows$case), function(x) {
    if (!keep(x$case[1])) return(NA_real_)
    max(1 / x$ratio_median[others(x)], -Inf, na.rm = TRUE)
  }, double(1))
  row <- rows[1, ]
  row[] <- NA
  row$comparison <- "laws"
  row$case <- "all"
  row$contender <- text
  row$ratio_median <- max(worst, na.rm = TRUE)
  row
}

run_laws <- function(rounds) {
  rows <- list()
  for (name in names(laws_scenes)) {
    case <- laws_scenes[[name]]
    truth <- laws_truth(case)
    for (cost_us in laws_costs_us) {
      for (told in c(FALSE, TRUE)) {
        rows[[length(rows) + 1L]] <- laws_case(name, case, cost_us, told, truth, rounds)
      }
    }
  }
  rows <- do.call(rbind, rows)
  rbind(
    rows,
    laws_worst(rows, "time / fastest of ours that reaches the accuracy", function(x) {
      !startsWith(x$contender, "lsoda") & x$error <= 1e-9
    }, function(case) TRUE),
    laws_worst(rows, "time / lsoda's, laws below 10 us", function(x) {
      startsWith(x$contender, "lsoda")
    }, function(case) grepl(", (0.5|5) us", case))
  )
}

laws_table <- function(rows) {
  cases <- split(rows, factor(rows$case, unique(rows$case)))
  cases$all <- NULL
  line <- function(x) {
    lsoda <- startsWith(x$contender, "lsoda")
    ours <- !lsoda & x$error <= 1e-9
    data.frame(
      law = sub(", breaks.*", "", x$case[1]), breaks = sub(".*, breaks ", "", x$case[1]),
      chosen = sub("chosen, ", "", x$contender[1]), ms = x$median_us[1] / 1000,
      error = x$error[1], calls = x$rhs_calls[1],
      best = if (any(ours)) max(1 / x$ratio_median[ours]) else NA_real_,
      others = paste0(
        x$contender[!lsoda][-1], " ", number(x$median_us[!lsoda][-1] / 1000),
        ifelse(x$error[!lsoda][-1] <= 1e-9, "", " (misses)"), collapse = ", "
      ),
      lsoda = sub("lsoda[:,] ", "", c(x$contender[lsoda], "")[1]),
      lsoda_error = c(x$error[lsoda], NA)[1], lsoda_calls = c(x$rhs_calls[lsoda], NA)[1],
      beside = 1 / c(x$ratio_median[lsoda], NA)[1]
    )
  }
  x <- do.call(rbind, lapply(cases, line))
  markdown(list(
    "law" = ifelse(duplicated(x$law), "", x$law), "breaks" = x$breaks, "chosen" = x$chosen,
    "ms" = number(x$ms), "true error" = small(x$error), "calls" = number(x$calls, 6),
    "others, ms" = x$others, "time / fastest of ours" = number(x$best, 2),
    "lsoda's tolerance" = x$lsoda, "its true error" = small(x$lsoda_error),
    "its calls" = number(x$lsoda_calls, 6), "time / lsoda's" = number(x$beside, 2)
  ))
}
