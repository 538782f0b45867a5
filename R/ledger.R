# Work, heat and impulse of a closed form, by quadrature of its own motion: Gauss-Kronrod panels
# between rows, breaks and events, halved where the two rules differ. The motion enters through omega
# and the torques only, so the balance with the kinetic energy tests it.

# Nodes and weights on [-1, 1], 15 of Kronrod around 7 of Gauss (Piessens et al. 1983, QUADPACK).
kronrod_node <- c(
  0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
  0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
  0.586087235467691130294144691693557, 0.405845151377397166906606412076961,
  0.207784955007898467600689403773245, 0
)
kronrod_weight <- c(
  0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
  0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
  0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
  0.204432940075298892414161999234649, 0.209482141084727828012999174891714
)
gauss_weight <- c(
  0, 0.129484966168869693270611432679082, 0, 0.279705391489276667901467771423780, 0,
  0.381830050505118944950369775488975, 0, 0.417959183673469387755102040816327
)

mirror <- function(x, sign) c(sign * x, rev(x[-8]))

ledger_names <- c(
  "work", "dissipated", "impulse", "viscous", "quadratic", "coulomb", "damping_impulse",
  "inertia_work"
)

# The eight integrands at some times, a column each.
ledger_rates <- function(scene, run, t) {
  order <- order(t)
  columns <- run(t[order])
  back <- order(order)
  omega <- columns$omega_rad_per_s[back]
  applied <- columns$applied_torque_n_m[back]
  damping <- columns$damping_torque_n_m[back]
  resistance <- scene$resistance
  viscous <- resistance$viscous_n_m_s * omega^2
  quadratic <- resistance$quadratic_n_m_s2 * abs(omega)^3
  coulomb <- resistance$coulomb_n_m * abs(omega)
  slope <- if (is.null(scene$inertia)) 0 else inertia_slope(scene$inertia, t)
  cbind(
    applied * omega, viscous + quadratic + coulomb, applied, viscous, quadratic, coulomb, damping,
    -0.5 * slope * omega^2
  )
}

inertia_slope <- function(knots, t) {
  n <- length(knots$time_s)
  i <- findInterval(t, knots$time_s)
  inside <- i >= 1L & i < n
  at <- pmin(pmax(i, 1L), n - 1L)
  rise <- diff(knots$moment_of_inertia_kg_m2)[at] / diff(knots$time_s)[at]
  ifelse(inside, rise, 0)
}

# Jumps of the inertia: times, and the moment before and after each.
inertia_jumps <- function(knots) {
  time <- knots$time_s
  again <- unique(time[duplicated(time)])
  list(
    time_s = again,
    before = knots$moment_of_inertia_kg_m2[match(again, time)],
    after = knots$moment_of_inertia_kg_m2[findInterval(again, time)]
  )
}

# At a jump the angular momentum stays; the energy does not. A row at the jump stands after it.
# momentum(t) is the angular momentum at times t.
jump_work <- function(scene, momentum, where) {
  jumps <- inertia_jumps(scene$inertia)
  at <- which(where(jumps$time_s))
  l <- if (length(at)) momentum(jumps$time_s[at])
  list(
    time_s = jumps$time_s[at],
    work = 0.5 * l * (l / jumps$after[at] - l / jumps$before[at]),
    size = 0.5 * l * (l / jumps$after[at] + l / jumps$before[at])
  )
}

# Integrals over each panel [from, to]: list(value, size, error), a row for each panel, a column for
# each integrand. `size` is the integral of the absolute value.
panel_integrals <- function(rates, from, to) {
  half <- (to - from) / 2
  middle <- from + half
  x <- mirror(kronrod_node, -1)
  t <- outer(half, x) + middle
  f <- rates(as.vector(t))
  n <- length(from)
  weigh <- function(y, w) rowSums(matrix(y, n) * rep(w, each = n)) * half
  kronrod <- mirror(kronrod_weight, 1)
  gauss <- mirror(gauss_weight, 1)
  value <- apply(f, 2, weigh, kronrod)
  size <- apply(abs(f), 2, weigh, kronrod)
  # Piessens' rule: the difference is the error of the Gauss rule; Kronrod's is far less.
  difference <- abs(value - apply(f, 2, weigh, gauss))
  shape <- function(y) matrix(y, n)
  value <- shape(value)
  size <- shape(size)
  difference <- shape(difference)
  error <- ifelse(
    size > 0, size * pmin(1, (200 * difference / pmax(size, 1e-300))^1.5), difference
  )
  list(value = value, size = size, error = error)
}

# The same over panels halved until the error is below rounding or 24 halvings are done.
integrate_panels <- function(rates, from, to) {
  n <- length(from)
  owner <- seq_len(n)
  value <- size <- error <- matrix(0, n, length(ledger_names))
  total <- NULL
  for (halving in 0:24) {
    panels <- panel_integrals(rates, from, to)
    if (is.null(total)) total <- colSums(panels$size)
    allowed <- 1e-15 * rep(total, each = length(from))
    good <- rowSums(panels$error > allowed | is.na(panels$error)) == 0 | halving == 24L |
      (to - from) < 4 * .Machine$double.eps * pmax(abs(from), abs(to))
    add <- function(sum, x) {
      part <- rowsum(x[good, , drop = FALSE], owner[good])
      at <- as.integer(rownames(part))
      sum[at, ] <- sum[at, ] + part
      sum
    }
    if (any(good)) {
      value <- add(value, panels$value)
      size <- add(size, panels$size)
      error <- add(error, panels$error)
    }
    if (all(good)) break
    middle <- (from + (to - from) / 2)[!good]
    owner <- rep(owner[!good], 2L)
    to <- c(middle, to[!good])
    from <- c(from[!good], middle)
  }
  list(value = value, size = size, error = error)
}

# Times where omega passes a point of a torque-speed curve: next to the end of a panel no node of it
# would see the kink.
curve_kinks <- function(scene, rows_at, edges) {
  points <- unlist(lapply(terms_of(scene, "curve"), function(term) term$x[1 + seq_len(term$x[1])]))
  if (length(points) == 0L || length(edges) < 2L) {
    return(double())
  }
  n <- length(edges) - 1L
  t <- sort(unique(c(edges, outer(diff(edges), seq_len(15L) / 16) + edges[seq_len(n)])))
  above <- outer(rows_at(t)$omega_rad_per_s, points, `>`)
  at <- which(diff(above) != 0, arr.ind = TRUE)
  if (nrow(at) == 0L) {
    return(double())
  }
  from <- t[at[, 1]]
  to <- t[at[, 1] + 1L]
  point <- points[at[, 2]]
  rises <- above[at + rep(c(1L, 0L), each = nrow(at))]
  for (halving in 1:60) {
    middle <- from + (to - from) / 2
    order <- order(middle)
    omega <- rows_at(middle[order])$omega_rad_per_s[order(order)]
    passed <- (omega > point) == rises
    to[passed] <- middle[passed]
    from[!passed] <- middle[!passed]
  }
  to
}

# Integrals between consecutive edges, breaks and events inside them minded.
integrate_motion <- function(scene, record, run, edges) {
  rows_at <- function(t) {
    result <- record$run(scene, t, run$accuracy, 1e6 + length(t), run$call, TRUE)
    if (result[[2]]$kind != "none") stop_ledger()
    result[[1]]
  }
  inner <- c(axle_breaks(scene), scene$start_s, run$events$time_s)
  inner <- inner[inner > edges[1] & inner < edges[length(edges)]]
  all <- sort(unique(c(edges, inner)))
  if (record$error_kind == "bound") all <- sort(unique(c(all, curve_kinks(scene, rows_at, all))))
  panels <- integrate_panels(
    function(t) ledger_rates(scene, rows_at, t), all[-length(all)], all[-1]
  )
  owner <- findInterval(all[-length(all)], edges)
  sums <- lapply(panels, function(x) rowsum(x, factor(owner, levels = seq_len(length(edges) - 1L))))
  if (is.null(scene$inertia)) {
    return(sums)
  }
  jumps <- jump_work(
    scene,
    function(t) rows_at(t)$omega_rad_per_s * inertia_at(scene$inertia, t),
    function(t) t > edges[1] & t <= edges[length(edges)]
  )
  owner <- findInterval(jumps$time_s, edges, left.open = TRUE)
  column <- match("inertia_work", ledger_names)
  for (i in seq_along(owner)) {
    sums$value[owner[i], column] <- sums$value[owner[i], column] + jumps$work[i]
    sums$size[owner[i], column] <- sums$size[owner[i], column] + jumps$size[i]
  }
  sums
}

# As the C ledgers: work, dissipated, impulse, their roundings, viscous, quadratic, coulomb, damping
# impulse, work of the inertia.
ledger_by_quadrature <- function(scene, run, from_s, to_s) {
  if (from_s == to_s) {
    return(double(11))
  }
  record <- record_of(run)
  parts <- tryCatch(
    integrate_motion(scene, record, run, c(from_s, to_s)),
    rotdyn_ledger = function(e) NULL
  )
  if (is.null(parts)) {
    return(rep(NA_real_, 11))
  }
  value <- parts$value[1, ]
  size <- parts$size[1, ]
  # What the motion's own error does: omega's to the rates, linear in each.
  omega <- run$info$errors[["omega"]] / max(run$info$sizes[["omega"]], 1e-300)
  rounding <- parts$error[1, ] + (4e-15 + 3 * omega) * size
  c(
    value[1:3], rounding[1] + rounding[8], rounding[2], rounding[3] + rounding[7], value[4:6],
    value[7], value[8]
  )
}

# The key columns as they stand: numbers, and no time missing.
check_rows <- function(x, call, columns = key_columns) {
  for (name in columns) {
    check_column(x[[name]], name, "1", call)
  }
  if (anyNA(x$time_s)) {
    abort_rotdyn("{.field time_s} must not be missing.", "time", call)
  }
}

stop_ledger <- function() {
  stop(structure(
    class = c("rotdyn_ledger", "error", "condition"),
    list(message = "the motion could not be computed", call = NULL)
  ))
}

#' Work, heat and impulse row by row
#'
#' The ledger of a trajectory as columns: since the first row, the work of the torque, what each
#' kind of resistance took, the work of what changes the inertia, both impulses; and the power of
#' the torque at each row.
#'
#' Each is an integral of the computed motion between the rows by Gauss-Kronrod quadrature to some
#' 1e-14 of the whole; none is a difference of others.
#'
#' @param x A `rot_trajectory` whose rows are in the order of time.
#' @param ... Not used.
#' @return The trajectory with the columns `r describe_columns(augment_columns)`
#'   Without rows they are empty.
#' @section Errors: `rotdyn_error_time` if the rows are not in the order of time;
#'   `rotdyn_error_range` where the motion could not be computed again.
#' @examples
#' augment(spin_up(time_s = 0:8))[, c("time_s", "power_w", "work_j", "dissipated_j")]
#' @aliases augment
#' @rawNamespace export(augment)
#' @export
augment.rot_trajectory <- function(x, ...) {
  call <- rlang::current_env()
  check_no_dots(...)
  run <- trajectory_run(x)
  if (is.null(x[["applied_torque_n_m"]])) {
    abort_missing_column("applied_torque_n_m", x, call)
  }
  check_rows(x, call)
  t <- x$time_s
  n <- length(t)
  if (is.unsorted(t)) {
    abort_rotdyn("The rows must be in the order of time to be added up.", "time", call)
  }
  edges <- unique(t)
  sums <- matrix(0, length(edges), length(ledger_names))
  if (length(edges) > 1L) {
    parts <- tryCatch(
      integrate_motion(run$solved, record_of(run), c(run, call = call), edges),
      rotdyn_ledger = function(e) {
        abort_rotdyn("The motion between the rows could not be computed.", "range", call)
      }
    )
    sums[-1, ] <- apply(parts$value, 2, cumsum)
  }
  sums <- sums[match(t, edges), , drop = FALSE]
  column <- function(name) as.vector(sums[, match(name, ledger_names)])
  x$power_w <- x$applied_torque_n_m * x$omega_rad_per_s
  x$work_j <- column("work")
  x$dissipated_j <- column("dissipated")
  x$dissipated_viscous_j <- column("viscous")
  x$dissipated_quadratic_j <- column("quadratic")
  x$dissipated_coulomb_j <- column("coulomb")
  x$inertia_work_j <- column("inertia_work")
  x$torque_impulse_n_m_s <- column("impulse")
  x$damping_impulse_n_m_s <- column("damping_impulse")
  x
}

#' What happened on the way
#'
#' The events of a trajectory: where dry friction brought the body to rest (`stick`), where it broke
#' loose (`slip`), where it passed through rest (`reverse`); for a clutch, where it locked (`lock`),
#' slipped (`slip`), and where the slip passed through zero (`reverse`). Their times are exact for a
#' closed form, and good to the accuracy asked for an integration.
#'
#' @param x What [trajectory()] gave.
#' @return A tibble with the columns `r describe_columns(c("time_s", "event"))`
#'   Models without events give none.
#' @section Errors: `rotdyn_error_type`.
#' @examples
#' wheel <- scene_axle(2, resistance = resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
#' motion_events(trajectory(wheel, time_s = 0:60))
#' @export
motion_events <- function(x) {
  call <- rlang::current_env()
  check_class(x, c("rot_trajectory", "rot_motion"), "x", "{.fn trajectory} gives one.", call)
  events <- trajectory_run(x)$events
  tibble::tibble(
    time_s = as.double(events$time_s), event = as.character(events$event)
  )
}
