# Turning points and passages of the rest angle, of what a spring or gravity pulls back. They are
# found when they are asked for; a run logs what dry friction does.

# list(time_s, event): "turn" where omega changes its sign, "passage" of the rest angle (any turn of
# it under gravity). Those of the run at the same time have a name already.
axle_swing_events <- function(x, run, call) {
  none <- list(time_s = double(), event = character())
  pulls <- setdiff(c("spring", "gravity"), run$solved$without)
  terms <- Filter(function(term) term$kind %in% pulls, torque_loads(axle_torque(run$solved))$terms)
  if (!length(terms) || nrow(x) < 2L || anyNA(x$time_s)) return(none)
  span <- range(x$time_s)
  grid <- if (span[1] < span[2]) search_times(run, span[1], span[2])
  if (is.null(grid)) return(none)
  rest <- unique(vapply(terms, rest_angle, double(1)))
  turns_count <- all(vapply(terms, function(term) term$kind == "gravity", NA))
  plain <- motion_reader(run, 1L, call)
  read <- function(time_s) {
    columns <- plain(time_s)
    away <- columns$theta_rad - rest[1]
    columns$away <- if (turns_count) sin(away / 2) else away
    columns$rate <- columns$omega_rad_per_s * if (turns_count) cos(away / 2) else 1
    columns
  }
  slopes <- function(columns) list(away = columns$rate, omega_rad_per_s = columns$net_torque_n_m)
  if (!is.null(changing_inertia(run$scene))) slopes <- NULL
  of <- function(column, event) {
    error <- column_error(run, if (event == "turn") "omega_rad_per_s" else "theta_rad")
    found <- passages(read, slopes, column, 0, grid, error)
    time_s <- found$time_s[found$direction != "reached"]
    list(time_s = time_s, event = rep(event, length(time_s)))
  }
  turn <- of("omega_rad_per_s", "turn")
  passage <- if (length(rest) == 1L) of("away", "passage") else none
  time_s <- c(turn$time_s, passage$time_s)
  event <- c(turn$event, passage$event)
  known <- vapply(time_s, function(t) any(abs(t - run$events$time_s) <= 1e-12 * abs(t)), NA)
  list(time_s = time_s[!known], event = event[!known])
}

# Where gravity pulls up, it rests half a turn further.
rest_angle <- function(term) {
  term$x[2] + if (term$kind == "gravity" && term$x[1] < 0) pi else 0
}

# The terms whose torque has a potential energy; none where one of them does not act at all times.
axle_conservative <- function(scene) {
  terms <- torque_loads(axle_torque(scene))$terms
  terms <- Filter(function(term) term$kind %in% c("spring", "gravity"), terms)
  always <- vapply(terms, function(term) term$from_s == -Inf && term$to_s == Inf, NA)
  if (all(always)) terms else list()
}

# The energy stored in springs and in the height, J; 0 at the rest angle. NULL where none acts at
# all times.
axle_potential <- function(scene, theta_rad) {
  terms <- axle_conservative(scene)
  if (!length(terms)) return(NULL)
  Reduce(`+`, lapply(terms, function(term) {
    away <- theta_rad - rest_angle(term)
    if (term$kind == "spring") return(0.5 * term$x[1] * away^2)
    2 * abs(term$x[1]) * sin(away / 2)^2
  }))
}
