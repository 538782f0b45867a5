# The models of a body with a fixed point.

# Gravity's impulses are integrals along the motion; its work is what the height gives.
pivot_ledger <- function(scene, run, from_s, to_s) {
  names <- c("work_j", "heat_j", free_impulses("torque"), free_impulses("damping"))
  if (!is.null(scene$rotors)) names <- c(names, "motor_work_j") # on the axis: none
  flow <- stats::setNames(double(length(names)), names)
  errors <- c(energy_rounding_j = 0, impulse_rounding_n_m_s = 0)
  if (!(from_s < to_s)) return(c(flow, errors))
  ends <- pivot_height_torque(scene, run, c(from_s, to_s))
  flow[["work_j"]] <- ends[1, "energy"] - ends[2, "energy"]
  rates <- function(t) pivot_height_torque(scene, run, t)[, c("x", "y"), drop = FALSE]
  turn <- 2 * max(run$info$sizes[["omega"]], 1e-300)
  panels <- min(max(1, ceiling((to_s - from_s) * turn)), 20000)
  edges <- seq(from_s, to_s, length.out = panels + 1)
  parts <- panel_integrals(rates, edges[-length(edges)], edges[-1])
  flow[free_impulses("torque")[1:2]] <- colSums(parts$value)
  size <- sqrt(sum(scene$lever_n_m^2))
  eps <- .Machine$double.eps
  off <- run$info$errors[["attitude"]]
  errors[["energy_rounding_j"]] <- size * (2 * off + 16 * eps)
  errors[["impulse_rounding_n_m_s"]] <- sum(parts$error) + size * (to_s - from_s) * (off + 16 * eps)
  c(flow, errors)
}

# A matrix with a row for each time: potential energy, gravity's torque along x and y of space.
pivot_height_torque <- function(scene, run, time_s) {
  order <- order(time_s)
  sorted <- time_s[order]
  result <- record_of(run)$run(scene, sorted, run$accuracy, 1e6, run$call, TRUE)
  out <- matrix(NA_real_, length(time_s), 3, dimnames = list(NULL, c("energy", "x", "y")))
  out[order, ] <- lever_in_space(scene, result$columns)[, c("z", "x", "y")]
  # r x F with F = (0, 0, -m g)
  cbind(energy = out[, "energy"], x = -out[, "y"], y = out[, "x"])
}

# The lever of the weight in space, a row for each row of the columns, N m.
lever_in_space <- function(scene, columns) {
  own <- scene$lever_n_m
  if (scene$axes[1] != 1) {
    own <- unlist(.Call(ffi_attitude_turn, as.list(c(scene$axes, own)), 1), use.names = FALSE)
  }
  q <- lapply(unclass(columns)[quaternion_columns], as.double)
  out <- do.call(cbind, .Call(ffi_attitude_turn, unname(c(q, as.list(own))), 1))
  dimnames(out) <- list(NULL, c("x", "y", "z"))
  out
}

pivot_top <- list(
  id = "pivot_top",
  equations = "L' = L x omega + r x m g (body axes), q' = q (0, omega)/2, two moments equal",
  assumptions = "rigid body; the centre of mass on the axis of symmetry; no friction at the point",
  limits = "beyond 1e15 rad no digit of the attitude is left",
  requires = "a symmetric top, gravity, rotors on its axis, and nothing else",
  source = "Goldstein 2002, section 5.7; elliptic functions of DLMF 19 and 22",
  run = function(scene, time_s, accuracy, max_steps, call, asked) {
    result <- .Call(ffi_pivot_top, scene, time_s, progress_bar("spinning"))
    result$info <- void_error(result$info, result$columns)
    result
  },
  ledger = pivot_ledger
)

# ---- approximate --------------------------------------------------------------------------------

# `rows(scene, time_s, bar)`: by C; `leaves_out`: said at the head of each trajectory.
pivot_approximation <- function(id, rows, leaves_out, ...) {
  list(
    id = id,
    ...,
    limits = "its error grows with time; not near the vertical",
    requires = "a symmetric top that spins, gravity, and nothing else",
    leaves_out = leaves_out,
    loses = "The bound on what this model leaves out grows with time: {.code model = NULL} picks
             one that is good enough.",
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      result <- rows(scene, time_s, progress_bar("spinning"))
      result$info <- void_error(result$info, result$columns)
      result
    },
    ledger = pivot_ledger
  )
}

pivot_precession <- pivot_approximation(
  "pivot_precession",
  function(scene, time_s, bar) .Call(ffi_pivot_precession, scene, time_s, bar),
  "nutation, and what the precession adds to the angular momentum",
  equations = "theta' = 0, phi' = torque/(I3 omega3), psi' = omega3 - phi' cos(theta)",
  assumptions = "fast spin: the angular momentum is that of the spin",
  source = "Goldstein 2002, section 5.7 (fast top)"
)

pivot_nutation <- pivot_approximation(
  "pivot_nutation",
  function(scene, time_s, bar) .Call(ffi_pivot_small_nutation, scene, time_s, bar),
  "the square of the change of the inclination",
  equations = "u'' = (f'(u0) + f''(u0) (u - u0))/2, u = cos(theta), u'^2 = f(u); phi', psi' linear",
  assumptions = "small nutation",
  source = "Goldstein 2002, section 5.7; Whittaker 1937, section 71"
)

# A record with some fields of its own.
model_like <- function(record, ...) {
  own <- list(...)
  record[names(own)] <- own
  record
}

pivot_free <- model_like(
  free_exact,
  id = "pivot_free",
  requires = "held at its centre of mass (or no gravity), no torque"
)

pivot_gyrostat <- model_like(
  free_gyrostat,
  id = "pivot_gyrostat",
  requires = "held at its centre of mass (or no gravity), rotors along a principal axis, no torque"
)

pivot_rk8pd <- model_like(
  free_rk8pd,
  id = "pivot_rk8pd",
  equations = "L' = L x omega + r x m g + torque - damping L (body axes), q' = q (0, omega)/2",
  ran_as = function(info) {
    if (info$method %in% c("rk8pd", "radau")) paste0("pivot_", info$method) else "pivot_rk8pd"
  }
)

pivot_radau <- model_like(
  free_radau,
  id = "pivot_radau", equations = pivot_rk8pd$equations, ran_as = pivot_rk8pd$ran_as
)

pivot_steppers <- lapply(
  list(free_euler, free_semi_implicit, free_rk4, free_split),
  function(record) {
    model_like(record, id = sub("^free", "pivot", record$id), equations = pivot_rk8pd$equations)
  }
)

pivot_models <- c(
  list(
    pivot_top, pivot_precession, pivot_nutation, pivot_free, pivot_gyrostat, pivot_rk8pd,
    pivot_radau
  ),
  pivot_steppers
)
