# Effects that may be left out, and what that can change at most. Exact before approximate: an
# effect is dropped only where no closed form takes the scene as it is.

droppable <- c("viscous", "quadratic", "friction", "spring", "gravity")

# The scene without some effects.
drop_effects <- function(scene, effects) {
  resistance <- scene$resistance
  loads <- scene$loads
  if ("viscous" %in% effects) resistance$viscous_n_m_s <- 0
  if ("quadratic" %in% effects) resistance$quadratic_n_m_s2 <- 0
  if ("friction" %in% effects) resistance[c("coulomb_n_m", "static_n_m")] <- 0
  loads$terms <- Filter(function(term) !term$kind %in% effects, loads$terms)
  scene$resistance <- resistance
  scene$loads <- loads
  scene$effects <- setdiff(scene$effects, effects)
  scene
}

# Largest |torque| from start to end of what does not depend on the motion, N m.
largest_drive <- function(scene, time_s) {
  loads <- scene$loads
  knots <- loads$knots
  parts <- vapply(loads$terms, function(term) {
    x <- term$x
    n <- x[1]
    switch(term$kind,
      sinusoid = abs(x[1]),
      exponential = abs(x[1]) * max(1, exp(-x[2] * (max(time_s) - x[3]))),
      curve = max(abs(x[-seq_len(1 + n)])),
      spring = 0,
      gravity = 0,
      Inf
    )
  }, double(1))
  max(abs(knots$torque_n_m), abs(knots$outside)) + sum(parts) +
    if (is.null(loads$law)) 0 else Inf
}

# Smallest moment of inertia anywhere.
least_inertia <- function(scene) {
  min(scene$moment_of_inertia_kg_m2, scene$inertia$moment_of_inertia_kg_m2)
}

# Largest |omega| that the scene can reach, by comparison: resistance only brakes, a torque D drives
# to D/I T or, against viscous resistance c, to D/c; a spring or gravity gives back no more than its
# energy. Inertia that shrinks speeds the body up: I omega is what the torque changes, and energy
# that goes to and fro between a spring and the body grows with all that shrinks.
largest_omega <- function(scene, time_s) {
  span <- time_span(scene, time_s)
  inertia <- least_inertia(scene)
  c <- viscous_of(scene) + motor_of(scene)
  drive <- largest_drive(scene, time_s)
  stored <- sum(vapply(scene$loads$terms, function(term) {
    x <- term$x
    switch(term$kind,
      spring = abs(x[1]) / inertia * (scene$theta0_rad - x[2])^2,
      gravity = 4 * abs(x[1]) / inertia,
      0
    )
  }, double(1)))
  reach <- drive / inertia * span
  start <- abs(scene$omega0_rad_per_s) * scene$moment_of_inertia_kg_m2 / inertia
  pumped <- if (stored == 0 || is.null(scene$inertia)) 1 else {
    exp(sum(pmax(0, -diff(log(scene$inertia$moment_of_inertia_kg_m2)))) / 2)
  }
  if (c > 0 && stored == 0 && is.null(scene$inertia)) reach <- min(reach, drive / c)
  (sqrt(start^2 + stored) + reach) * pumped * growth(scene, span)
}

time_span <- function(scene, time_s) {
  if (length(time_s)) max(abs(range(time_s) - scene$start_s)) else 0
}

# Where something drives with the motion, disturbances grow with it.
growth <- function(scene, span) {
  c <- viscous_of(scene) + motor_of(scene)
  gravity <- sum(vapply(terms_of(scene, "gravity"), function(term) abs(term$x[1]), double(1)))
  inertia <- least_inertia(scene)
  rising <- vapply(terms_of(scene, "curve"), function(term) {
    n <- term$x[1]
    max(0, diff(term$x[seq(2 + n, 1 + 2 * n)]) / diff(term$x[seq(2, 1 + n)]))
  }, double(1))
  # A spring of negative stiffness drives away from its rest.
  away <- sum(vapply(terms_of(scene, "spring"), function(term) max(0, -term$x[1]), double(1)))
  exp(span * (max(0, -c) / inertia + sum(rising) / inertia + sqrt((gravity + away) / inertia)))
}

# What a torque of at most `size` N m, whatever its course, does to the motion at most. Against
# resistance that grows with omega two motions come together, so resistance may be left out here:
# |delta omega| <= size/I min(T, I/c), and no more than its whole impulse (of its size) over I.
disturbance <- function(scene, size, time_s, impulse = Inf, grow = NULL) {
  span <- time_span(scene, time_s)
  inertia <- least_inertia(scene)
  c <- viscous_of(scene) + motor_of(scene)
  oscillates <- any(c("spring", "gravity", "inertia") %in% scene$effects)
  reach <- if (c > 0 && !oscillates) min(span, inertia / c) else span
  if (is.null(grow)) {
    backward <- length(time_s) && min(time_s) < scene$start_s
    grow <- growth(scene, span) * if (backward) exp(max(0, c) / inertia * span) else 1
  }
  omega <- min(size * reach, impulse) / inertia * grow
  list(omega = omega, theta = omega * span)
}

# The torque of the effects left out, at most.
dropped_torque <- function(scene, effects, time_s) {
  omega <- largest_omega(scene, time_s)
  angle <- abs(scene$theta0_rad) + omega * time_span(scene, time_s)
  resistance <- scene$resistance
  vapply(effects, function(effect) {
    switch(effect,
      viscous = abs(resistance$viscous_n_m_s) * omega,
      quadratic = resistance$quadratic_n_m_s2 * omega^2,
      friction = resistance$static_n_m,
      spring = sum(vapply(terms_of(scene, "spring"), function(term) {
        abs(term$x[1]) * (angle + abs(term$x[2]))
      }, double(1))),
      gravity = sum(vapply(terms_of(scene, "gravity"), function(term) abs(term$x[1]), double(1)))
    )
  }, double(1))
}

# list(scene, effects, until_s, omega, theta: absolute bounds, error: relative to the motion's size)
# of the scene without `effects`, from its start to `until_s`; the sizes are those of the reduced motion at some times, which is
# at most its largest on the way.
drop_bound <- function(scene, effects, record, time_s, call) {
  if (!all(effects %in% droppable)) {
    return(NULL)
  }
  reduced <- drop_effects(scene, effects)
  if (!is.null(record$why_not(reduced, time_s))) {
    return(NULL)
  }
  none <- list(scene = reduced, effects = effects, error = Inf)
  # Backwards, what brakes drives: no bound is tried. Nor where static friction decides: whether a
  # body that comes to rest sticks or turns hangs on the last digit.
  resistance <- reduced$resistance
  if (length(time_s) == 0L || time_s[1] < scene$start_s ||
    resistance$static_n_m > resistance$coulomb_n_m) {
    return(none)
  }
  size <- dropped_torque(scene, effects, time_s)
  if (!all(is.finite(size))) {
    return(none)
  }
  bound <- disturbance(reduced, sum(size), time_s)
  ends <- c(min(scene$start_s, time_s), max(time_s))
  times <- seq(ends[1], ends[2], length.out = 65L)
  rows <- record$run(reduced, times, 1e-9, 1e6, call, TRUE)$columns
  relative <- function(bound, x) if (bound == 0) 0 else bound / max(abs(x))
  each <- vapply(seq_along(effects), function(i) {
    one <- disturbance(reduced, size[[i]], time_s)
    relative(one$omega, rows$omega_rad_per_s)
  }, double(1))
  list(
    scene = reduced, effects = effects, until_s = max(time_s),
    errors = c(theta = bound$theta, omega = bound$omega),
    error = max(
      relative(bound$omega, rows$omega_rad_per_s), relative(bound$theta, rows$theta_rad)
    ),
    each = each
  )
}
