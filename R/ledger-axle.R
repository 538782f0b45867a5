# The ledger of an axle by quadrature of its own motion, between rows, breaks and events. The motion
# enters through omega and the torques only, so the balance with the kinetic energy tests it.

# As the C ledger has them.
axle_flows <- c(
  "work_j", "viscous_j", "quadratic_j", "coulomb_j", "impulse_n_m_s", "damping_impulse_n_m_s",
  "inertia_work_j"
)

# The integrands at some times, a column each.
axle_flow_rates <- function(scene, rows_at, t) {
  order <- order(t)
  columns <- rows_at(t[order])
  back <- order(order)
  omega <- columns$omega_rad_per_s[back]
  applied <- columns$applied_torque_n_m[back]
  resistance <- scene$resistance
  slope <- if (is.null(scene$inertia)) 0 else inertia_slope(scene$inertia, t)
  cbind(
    applied * omega, resistance$viscous_n_m_s * omega^2,
    resistance$quadratic_n_m_s2 * abs(omega)^3, resistance$coulomb_n_m * abs(omega), applied,
    columns$damping_torque_n_m[back], -0.5 * slope * omega^2
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

# Jumps of the inertia do work: at a jump the angular momentum stays, the energy does not. A row at
# the jump is after it. momentum(t) is the angular momentum; where(t) selects the jumps that count.
jump_work <- function(scene, momentum, where) {
  knots <- scene$inertia
  time_s <- unique(knots$time_s[duplicated(knots$time_s)])
  time_s <- time_s[where(time_s)]
  before <- knots$moment_of_inertia_kg_m2[match(time_s, knots$time_s)]
  after <- knots$moment_of_inertia_kg_m2[findInterval(time_s, knots$time_s)]
  l <- if (length(time_s)) momentum(time_s)
  list(
    time_s = time_s,
    work = 0.5 * l * (l / after - l / before),
    size = 0.5 * l * (l / after + l / before)
  )
}

# Times where omega passes a point of a torque-speed curve: panels end at these kinks.
curve_kinks <- function(scene, rows_at, edges) {
  curves <- Filter(function(term) term$kind == "curve", scene$loads$terms)
  points <- unlist(lapply(curves, function(term) term$x[1 + seq_len(term$x[1])]))
  if (length(points) == 0L || length(edges) < 2L) return(double())
  n <- length(edges) - 1L
  t <- sort(unique(c(edges, outer(diff(edges), seq_len(15L) / 16) + edges[seq_len(n)])))
  above <- outer(rows_at(t)$omega_rad_per_s, points, `>`)
  at <- which(diff(above) != 0, arr.ind = TRUE)
  if (nrow(at) == 0L) return(double())
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

# Times where a torque or the inertia jumps or kinks.
axle_breaks <- function(scene) {
  terms <- lapply(scene$loads$terms, function(term) term$breaks_s)
  sort(unique(c(scene$loads$knots$time_s, unlist(terms), scene$inertia$time_s)))
}

# The shortest time in which the rates change, s; Inf if they do not.
shortest_time <- function(scene, sizes) {
  inertia <- min(scene$moment_of_inertia_kg_m2, scene$inertia$moment_of_inertia_kg_m2)
  resistance <- scene$resistance
  falls <- abs(resistance$viscous_n_m_s) + abs(scene$loads$motor_n_m_s) +
    2 * resistance$quadratic_n_m_s2 * sizes[["omega"]]
  of_term <- function(term) {
    x <- abs(term$x)
    switch(term$kind,
      sinusoid = , exponential = x[2],
      spring = sqrt(x[1]) / sqrt(inertia),
      gravity = 2 * sqrt(x[1]) / sqrt(inertia),
      curve = {
        n <- x[1]
        max(abs(diff(term$x[1 + n + seq_len(n)]) / diff(term$x[1 + seq_len(n)])), 0) / inertia
      },
      0
    )
  }
  1 / max(falls / inertia, vapply(scene$loads$terms, of_term, double(1)))
}

# Times that double their distance from where the motion is disturbed: a panel much longer than the
# shortest time would miss what fades after it. `anchors`: breaks, events and the start, increasing.
graded_times <- function(anchors, start_s, shortest_s, from_s, to_s) {
  if (!is.finite(shortest_s)) return(double())
  anchors <- c(min(from_s, anchors[1]), anchors, max(to_s, anchors[length(anchors)]))
  begin <- anchors[-length(anchors)]
  end <- anchors[-1]
  long <- end - begin > 50 * shortest_s & end > from_s & begin < to_s
  unlist(Map(function(begin, end) {
    first <- max(shortest_s, (end - begin) * 2^-1000) # 2^1024 is no double
    away <- first * 2^seq.int(-1, floor(log2((end - begin) / first)))
    if (end <= start_s) end - away else begin + away
  }, begin[long], end[long]))
}

# Integrals between consecutive edges, with panels that end at breaks and events: list(value, size,
# error), a row for each interval; NULL where the motion could not be computed again. `scene`: that
# of the torques, where the motion left effects out the solved or the whole one.
integrate_axle_flows <- function(run, edges, call, scene = run$solved) {
  record <- record_of(run)
  failed <- FALSE
  whole <- !is.null(run$dropped) && !identical(scene, run$solved)
  rows_at <- function(t) {
    result <- record$run(run$solved, t, run$accuracy, 1e6 + length(t), call, TRUE)
    failed <<- failed || result$info$kind != "none"
    if (whole) axle_acting(result$columns, scene, t) else result$columns
  }
  breaks <- axle_breaks(scene)
  inner <- c(breaks, scene$start_s, run$events$time_s)
  n_edges <- length(edges)
  inner <- c(inner, graded_times(
    sort(unique(inner)), scene$start_s, shortest_time(scene, run$info$sizes), edges[1],
    edges[n_edges]
  ))
  inner <- inner[inner > edges[1] & inner < edges[length(edges)]]
  all <- sort(unique(c(edges, inner)))
  if (record$error_kind == "bound") all <- sort(unique(c(all, curve_kinks(scene, rows_at, all))))
  panels <- integrate_panels(
    function(t) axle_flow_rates(scene, rows_at, t), all[-length(all)], all[-1]
  )
  owner <- findInterval(all[-length(all)], edges)
  sums <- lapply(panels[c("value", "size", "error")], function(x) {
    x <- rowsum(x, factor(owner, levels = seq_len(length(edges) - 1L)))
    colnames(x) <- axle_flows
    x
  })
  if (!is.null(scene$inertia)) {
    jumps <- jump_work(
      scene,
      function(t) rows_at(t)$omega_rad_per_s * inertia_at(scene$inertia, t),
      function(t) t > edges[1] & t <= edges[length(edges)]
    )
    owner <- findInterval(jumps$time_s, edges, left.open = TRUE)
    for (i in seq_along(owner)) {
      at <- cbind(owner[i], match("inertia_work_j", axle_flows))
      sums$value[at] <- sums$value[at] + jumps$work[i]
      sums$size[at] <- sums$size[at] + jumps$size[i]
    }
  }
  sums$spent <- panels$spent
  if (!failed) sums
}

# The ledger from one time to another, as C makes it.
axle_ledger_by_quadrature <- function(run, from_s, to_s) {
  parts <- if (from_s < to_s) integrate_axle_flows(run, c(from_s, to_s), run$call)
  if (is.null(parts)) return(empty_axle_ledger(if (from_s < to_s) NA_real_ else 0))
  value <- parts$value[1, ]
  # The effect of the motion's own error: that of omega on the rates, to first order.
  omega <- run$info$errors[["omega"]] / max(run$info$sizes[["omega"]], 1e-300)
  # Of a motion that the panels do not resolve there is no verdict.
  if (parts$spent) parts$error[] <- NA
  rounding <- parts$error[1, ] + (4e-15 + 3 * omega) * parts$size[1, ]
  heat <- c("viscous_j", "quadratic_j", "coulomb_j")
  impulses <- c("impulse_n_m_s", "damping_impulse_n_m_s")
  c(
    value,
    dissipated_j = sum(value[heat]),
    work_rounding_j = sum(rounding[c("work_j", "inertia_work_j")]),
    dissipated_rounding_j = sum(rounding[heat]),
    impulse_rounding_n_m_s = sum(rounding[impulses])
  )
}

empty_axle_ledger <- function(value) {
  names <- c(
    axle_flows, "dissipated_j", "work_rounding_j", "dissipated_rounding_j", "impulse_rounding_n_m_s"
  )
  stats::setNames(rep(value, length(names)), names)
}

# The torques of the whole scene in the states of a motion that left effects out.
axle_acting <- function(columns, scene, time_s) {
  torques <- .Call(
    ffi_axle_torques, scene, time_s, columns$theta_rad, columns$omega_rad_per_s
  )
  columns[names(torques)] <- torques
  columns
}
