# The model of a body on an incline.

incline_exact <- list(
  id = "incline_exact",
  equations = "m v' = m g sin - F, I omega' = F R - T; Coulomb friction F, rolling resistance T",
  assumptions = "rigid round body on a plane; centre of mass on its axis; constant coefficients",
  limits = "not before the start; where a force equals what friction holds, rounding decides",
  requires = "a body on an incline",
  source = "closed form between exact events; Goldstein 2002, section 2.4",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    result <- .Call(ffi_incline_run, scene, time_s, progress_bar("incline"))
    result$info <- void_error(result$info, result$columns)
    if (!is.null(result$event_rows)) result$event_rows <- list(columns = result$event_rows)
    result
  },
  ledger = function(scene, run, from_s, to_s) {
    .Call(ffi_incline_ledger, scene, c(from_s, to_s))
  }
)

# ---- integrated ---------------------------------------------------------------------------------

integrate_incline <- function(scene, time_s, accuracy, max_steps, call, method) {
  force <- scene$force
  called <- if (!is.null(force)) {
    f <- force$f
    # C fills in the arguments; an error of the function's own shows the call f(...).
    own <- list(
      as.call(c(quote(f), rep(list(NULL), force$arguments))),
      list2env(list(f = f), parent = baseenv()),
      function(value, time_s) abort_force_value(value, time_s, call)
    )
    list(law = own, stops = force$breaks_s)
  }
  result <- .Call(
    ffi_incline_integrate, scene, called, time_s,
    c(accuracy, max_steps, method, resolution_of(scene)),
    progress_bar("integrating")
  )
  errors <- result$ledger$errors
  sums <- result$ledger[names(result$ledger) != "errors"]
  rows <- result$event_rows
  result[c("columns", "ledger")] <- incline_ledger_rows(scene, result$columns, sums, errors)
  if (!is.null(rows)) {
    result$event_rows <- incline_ledger_rows(
      scene, rows[names(rows) %in% c("time_s", incline_columns)], rows[names(sums)], errors
    )
  }
  if (!is.null(force)) result$info$resolution <- resolution_of(scene)
  result$info <- void_error(result$info, result$columns)
  result
}

# list(columns, ledger) of rows: the columns that a force adds, and the sums since the start.
incline_ledger_rows <- function(scene, columns, sums, errors) {
  if (has_outer_force(scene)) columns[incline_force_columns] <- sums[incline_force_columns]
  n <- length(columns$time_s)
  sums <- sums[setdiff(names(sums), c("drag_force_n", "applied_force_n"))]
  list(columns = columns, ledger = cbind(
    do.call(cbind, c(
      list(time_s = columns$time_s), sums, list(path_m = columns$x_m - scene$x0_m)
    )),
    heat_error_j = rep(errors[1], n), work_error_j = rep(errors[2], n),
    impulse_error_n_s = rep(errors[3], n)
  ))
}

abort_force_value <- function(value, time_s, call) {
  abort_rotdyn(c(
    "The function {.arg force_n} must return one number in N.",
    x = "At {format(time_s, digits = 17)} s it returned {describe_value(value)}."
  ), "torque", call)
}

# Work and impulses between two times, from the run's own sums where it has these times.
integrated_incline_ledger <- function(scene, run, from_s, to_s) {
  known <- run$ledger
  if (is.null(known) || !all(c(from_s, to_s) %in% known[, "time_s"])) {
    again <- record_of(run)$run(
      scene, c(from_s, to_s), run$accuracy, run$max_steps + 2, run$call, TRUE
    )
    if (again$info$kind != "none") return(NULL)
    known <- again$ledger
  }
  ends <- known[match(c(from_s, to_s), known[, "time_s"]), , drop = FALSE]
  flow <- ends[2, ] - ends[1, ]
  pull <- scene$mass_kg * scene$gravity_m_per_s2 *
    .Call(ffi_inertia_sine, scene$incline_angle_deg)
  eps <- .Machine$double.eps
  c(
    flow[c(
      "applied_work_j", "drag_heat_j", "friction_impulse_n_s", "drag_impulse_n_s",
      "applied_impulse_n_s", "resistance_impulse_n_m_s"
    )],
    work_j = pull * flow[["path_m"]],
    work_rounding_j = ends[2, "work_error_j"][[1]] +
      2 * abs(pull) * (run$info$errors[["x"]] + 4 * eps * max(abs(ends[, "path_m"]))),
    gravity_impulse_n_s = pull * (to_s - from_s),
    friction_impulse_n_m_s = -scene$radius_m * flow[["friction_impulse_n_s"]],
    heat_error_j = ends[2, "heat_error_j"][[1]],
    impulse_rounding_n_s = ends[2, "impulse_error_n_s"][[1]] +
      16 * eps * abs(pull) * max(abs(c(from_s, to_s)))
  )
}

incline_integrator <- function(id, method, ...) {
  list(
    id = id,
    equations = paste(
      "m v' = m g sin - F - drag + force, I omega' = F R - T;",
      "Coulomb friction F, rolling resistance T"
    ),
    assumptions = "rigid round body on a plane; centre of mass on its axis; events in C",
    requires = "a body on an incline; any drag, any force along the slope",
    ...,
    adapts = TRUE,
    ran_as = function(info) {
      if (info$method %in% c("rk8pd", "radau")) paste0("incline_", info$method) else id
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      integrate_incline(scene, time_s, accuracy, max_steps, call, if (asked) method else 0)
    },
    ledger = integrated_incline_ledger
  )
}

incline_rk8pd <- incline_integrator(
  "incline_rk8pd", 1,
  limits = "not before the start; not stiff: a step is at most about 6 times the shortest decay",
  source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library"
)

incline_radau <- incline_integrator(
  "incline_radau", 2,
  limits = "not before the start; each step solves a system of equations",
  source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)"
)

incline_models <- list(incline_exact, incline_rk8pd, incline_radau)
