#' Moment of inertia reflected through a gear
#'
#' The moment of inertia J of a body on a shaft with `omega_out = omega_in/ratio` is `J/ratio^2` at
#' the input.
#'
#' @param moment_of_inertia_kg_m2 Moment of inertia on the output shaft, at least 0.
#' @param ratio `omega_in/omega_out`, not 0; negative for gears that turn opposite ways. For a belt
#'   it is `radius_out/radius_in`.
#' @param ... Not used: an unknown argument is an error.
#' @return Numbers in kg m^2, one for each row (arguments have length 1 or n). NA gives NA.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value`,
#'   `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), section 16-7.
#' @seealso [gear_train()], [scene_gears()].
#' @concept gear
#' @examples
#' reflected_inertia(0.5, ratio = c(1, 5, 10))
#' @export
reflected_inertia <- function(moment_of_inertia_kg_m2, ratio, ...) {
  call <- check_no_dots(...)
  check_supplied(c("moment_of_inertia_kg_m2", "ratio"), call)
  inertia <- check_column(moment_of_inertia_kg_m2, "moment_of_inertia_kg_m2", "kg*m^2", call)
  ratio <- check_column(ratio, "ratio", "1", call)
  n <- check_recyclable(list(moment_of_inertia_kg_m2 = inertia, ratio = ratio), call)
  check_not_negative(inertia, "moment_of_inertia_kg_m2", "kg*m^2", call)
  zero <- which(ratio == 0)
  if (length(zero)) {
    abort_rotdyn(c("{.arg ratio} must not be 0.", x = "It is in row {zero[1]}."), "value", call)
  }
  # Two divisions: the square of a ratio may overflow where the result does not.
  reflected <- rep_len(inertia, n) / ratio / ratio
  given <- list(inertia, ratio)
  warn_beyond(list(reflected_inertia_kg_m2 = reflected), given, n, call)
  reflected
}

#' A rigid gear train
#'
#' Shafts 1, 2, ..., n, each geared to the next with `ratio = omega_i/omega_(i+1)`. `gear_train()`
#' gives the contribution of each shaft at the first: with `N_i = omega_1/omega_i`, the product of
#' the ratios before it, inertia `J_i/N_i^2`, viscous coefficient `d_i/N_i^2`, torque `tau_i/N_i`:
#' \deqn{\sum_i \frac{J_i}{N_i^2}\, \dot\omega_1 =
#'   \sum_i \Bigl(\frac{\tau_i}{N_i} - \frac{d_i}{N_i^2}\, \omega_1\Bigr)}{
#'   sum(J_i/N_i^2) omega_1' = sum(tau_i/N_i - d_i/N_i^2 omega_1)}
#' `scene_gears()` makes a [scene_axle()] of the first shaft with their sums. Torque laws, friction,
#' elastic shafts, clutches, and the motion of each shaft: see [scene_drive()].
#'
#' **Efficiency.** Of the power that enters a mesh, the share `efficiency` leaves it, whichever of
#' its two shafts it comes from. It is all of the power through the mesh: what the inertia behind it
#' takes or gives counts, and so do viscous torques. With the torques `u_i` that shaft i gives and
#' `v_i` that shaft i + 1 takes, both at the first shaft, and \eqn{\eta}{eta} the efficiency:
#' \deqn{\frac{J_i}{N_i^2}\dot\omega_1 = \frac{\tau_i}{N_i} - \frac{d_i}{N_i^2}\omega_1
#'   + v_{i-1} - u_i,\quad v_i = \eta u_i \mbox{ where } u_i\omega_1 > 0,\quad
#'   u_i = \eta v_i \mbox{ where } u_i\omega_1 < 0}{
#'   J_i/N_i^2 omega_1' = tau_i/N_i - d_i/N_i^2 omega_1 + v_(i-1) - u_i,
#'   v_i = eta u_i where u_i omega_1 > 0,  u_i = eta v_i where u_i omega_1 < 0}
#' At constant torques the acceleration is piecewise linear in \eqn{\omega_1}{omega_1}, so that the
#' motion has a closed form. A loss resists either rotation: at rest it acts like dry friction that
#' differs between the two senses, and a train whose torques it exceeds stays at rest.
#' `reflected_torque_n_m` is for steady forward rotation, with the power flows of these torques;
#' inertia and viscous coefficients are reflected without loss.
#'
#' @param bodies A list of `rot_body` (their Izz counts), or moments of inertia in kg m^2, one for
#'   each shaft; greater than 0.
#' @param ratios One for each stage (`n - 1`), or one for all; not 0. For a single shaft:
#'   `numeric()`.
#' @param ... Not used; names after it must be given in full.
#' @param efficiency Of each stage, in (0, 1]: one number or `n - 1`.
#' @param torque_n_m Torque on each shaft: `n` numbers, or 0.
#' @param viscous_n_m_s Viscous coefficient on each shaft, at least 0: one number or `n`.
#' @return `gear_train()`: a tibble (class `rot_gear_train`, which `ggplot2::autoplot()` draws) with
#'   one row for each shaft:
#'   `r describe_columns(gear_columns)`
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` (NA, NaN and Inf
#'   included), `rotdyn_error_unit`.
#' @source Shigley, Mechanical Engineering Design, 7th ed. (2004), sections 13-13 and 16-7.
#' @seealso [scene_drive()] for torque laws and elastic shafts, [reflected_inertia()],
#'   [autoplot.rot_gear_train()].
#' @concept gear
#' @concept transmission
#' @examples
#' gear_train(c(0.01, 0.5), ratios = 5, efficiency = 0.9, torque_n_m = c(2, -4))
#' scene <- scene_gears(c(0.01, 0.5), ratios = 5, efficiency = 0.9, torque_n_m = c(2, -4))
#' trajectory(scene, time_s = 0:3)
#' @export
gear_train <- function(bodies, ratios, ..., efficiency = 1, torque_n_m = 0, viscous_n_m_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("bodies", "ratios"), call)
  train_of(bodies, ratios, efficiency, torque_n_m, viscous_n_m_s, call)
}

train_of <- function(bodies, ratios, efficiency, torque_n_m, viscous_n_m_s, call) {
  inertia <- check_inertias(bodies, "bodies", call)
  n <- length(inertia)
  ratios <- check_between(ratios, "ratios", "1", n - 1L, -Inf, call)
  efficiency <- check_each(efficiency, "efficiency", "1", n - 1L, 0, call)
  torque <- check_torque_each(torque_n_m, "torque_n_m", n, call)
  viscous <- check_each(viscous_n_m_s, "viscous_n_m_s", "N*m*s", n, 0, call)
  if (any(ratios == 0)) abort_rotdyn("{.arg ratios} must not be 0.", "value", call)
  bad <- which(efficiency <= 0 | efficiency > 1)
  if (length(bad)) abort_domain(efficiency[bad[1]], "efficiency", "1", call, 0, 1, TRUE)
  ratio <- cumprod(c(1, ratios))
  felt <- torque / ratio
  train <- list(
    shaft = seq_len(n),
    ratio_to_first = ratio,
    moment_of_inertia_kg_m2 = inertia,
    reflected_inertia_kg_m2 = inertia / ratio / ratio,
    reflected_viscous_n_m_s = viscous / ratio / ratio,
    reflected_torque_n_m = felt * mesh_gains(-felt, efficiency)
  )
  warn_beyond(train[-1], list(), n, call)
  tibble::new_tibble(
    train, nrow = n, torque_n_m = torque, efficiency = rep_len(efficiency, n - 1L),
    class = "rot_gear_train"
  )
}

# ---- power through the meshes --------------------------------------------------------------------
#
# All at the first shaft, turning forward. X_i = J_i a - f_i + d_i w + u_i is what shaft i takes
# from the mesh before it, u_i = X_(i+1)/eta where that is positive (power forward), else
# eta X_(i+1); X_1 = 0 is the equation of motion. u is convex in X, so that X_1 is convex in a and
# w, and a is the smallest of the accelerations that the 2^(n-1) sets of power flows give: concave
# in w. Backward: a(w; f) = -a(-w; -f).

# The product of the factors u/X of the meshes before each shaft, where each shaft takes `x` itself.
mesh_gains <- function(x, efficiency) {
  n <- length(x)
  factor <- double(n - 1L)
  taken <- x[n]
  for (i in rev(seq_len(n - 1L))) {
    factor[i] <- if (taken > 0) 1 / efficiency[i] else efficiency[i]
    taken <- x[i] + factor[i] * taken
  }
  cumprod(c(1, factor))
}

# list(a, start, slope, inertia, w): the acceleration at w >= 0, the line start + slope w of these
# power flows, and their inertia. Newton's iteration, which a convex function of finitely many lines
# ends.
mesh_line <- function(at, w) {
  a <- (sum(at$force) - sum(at$viscous) * w) / sum(at$inertia)
  for (turn in seq_len(10L + 4L * length(at$force))) {
    gain <- mesh_gains(at$inertia * a - at$force + at$viscous * w, at$efficiency)
    inertia <- sum(at$inertia * gain)
    start <- sum(at$force * gain) / inertia
    slope <- -sum(at$viscous * gain) / inertia
    now <- start + slope * w
    if (now >= a && turn > 1L) break # it falls to the zero from above
    a <- now
  }
  list(a = a, start = start, slope = slope, inertia = inertia, w = w)
}

# Where two lines of the concave a(w) meet, between w1 and w2 and recursively: the rates at which a
# power flow changes its direction.
mesh_bends <- function(at, left, right) {
  eps <- .Machine$double.eps
  fall <- left$slope - right$slope
  if (!(fall > 2 * eps * abs(right$slope))) return(double())
  w <- (right$start - left$start) / fall
  if (!(w > left$w && w < right$w)) return(double())
  here <- mesh_line(at, w)
  is_line <- function(one) here$slope == one$slope && here$start == one$start
  below <- left$start + left$slope * w - here$a
  if (is_line(left) || is_line(right) ||
      below <= 8 * eps * (abs(left$start) + abs(left$slope * w))) return(w)
  c(mesh_bends(at, left, here), mesh_bends(at, here, right))
}

# The acceleration from rest, forward: list(a, bends, last), `last` the slope at high rates.
mesh_side <- function(at) {
  first <- mesh_line(at, 0)
  still <- at
  still$force[] <- 0
  last <- mesh_line(still, 1)$slope
  if (last == 0 || all(at$force == 0)) {
    return(list(a = first$a, bends = double(), last = last, least = abs(last)))
  }
  # Beyond all bends: the resistance exceeds the torques by far.
  gain <- prod(at$efficiency)
  far <- 1e3 * sum(abs(at$force)) / gain^2 / sum(at$viscous)
  near <- 1e-15 * far
  for (turn in 1:40) {
    line <- mesh_line(at, far)
    if (!is.finite(far) || far == 0 || line$slope == last) break
    far <- 8 * far
  }
  # Just above rest a mesh without power at rest has its direction.
  beside <- mesh_line(at, near)
  bends <- if (far > 0 && is.finite(far)) mesh_bends(at, beside, line) else double()
  list(a = first$a, bends = bends, last = last, least = abs(beside$slope))
}

# What a train does at its first shaft, as torque, resistance and dry friction of an axle of the
# inertia of all: list(torque, viscous, dry, rounding, gears). The acceleration of both senses,
# times the inertia, is torque - viscous w, the dry friction, and a torque-speed curve where power
# flows change with the rate.
train_law <- function(train) {
  felt <- attr(train, "torque_n_m") / train$ratio_to_first
  at <- list(
    inertia = train$reflected_inertia_kg_m2, viscous = train$reflected_viscous_n_m_s,
    force = felt, efficiency = attr(train, "efficiency")
  )
  applied <- exact_total(as.list(felt))
  bearings <- sum(at$viscous)
  if (all(at$efficiency == 1)) {
    return(list(
      torque = torque_constant(applied), viscous = bearings, dry = 0,
      rounding = train_rounding(at, 0)
    ))
  }
  back <- at
  back$force <- -at$force
  inertia <- sum(at$inertia)
  ahead <- mesh_side(at)
  behind <- mesh_side(back)
  forward <- inertia * ahead$a
  backward <- -inertia * behind$a
  viscous <- -inertia * ahead$last
  dry <- max((backward - forward) / 2, 0)
  # A loss that rounding alone makes is none.
  if (dry <= 8 * .Machine$double.eps * sum(abs(felt))) dry <- 0
  mean <- if (dry > 0) (forward + backward) / 2 else applied
  side <- function(one, at) {
    vapply(one$bends, function(w) inertia * (mesh_line(at, w)$a - one$a) + viscous * w, double(1))
  }
  constant <- torque_constant(mean)
  up <- ahead$bends
  down <- behind$bends
  list(
    torque = if (length(up) || length(down)) {
      sum_torques(constant, torque_curve(
        c(-rev(down), 0, up), c(-rev(side(behind, back)), 0, side(ahead, at))
      ))
    } else {
      constant
    },
    viscous = viscous, dry = dry, rounding = train_rounding(at, max(abs(c(ahead$a, behind$a)))),
    gears = list(
      applied_n_m = applied, forward_n_m = max(applied - (mean - dry), 0),
      backward_n_m = max((mean + dry) - applied, 0), bearings_n_m_s = bearings,
      least_n_m_s = inertia * min(ahead$least, behind$least)
    )
  )
}

# The rounding of these sums, as a torque and as a viscous coefficient, by a count of roundings: 3 n
# of the ratios and gains of each term, and of the sums; times what the meshes amplify.
train_rounding <- function(at, alpha) {
  n <- length(at$force)
  gain <- cumprod(c(1, 1 / at$efficiency))
  share <- sum(at$inertia) / sum(at$inertia / gain)
  count <- .Machine$double.eps / 2 * (3 * n + 3)
  lossy <- any(at$efficiency < 1)
  count * (if (lossy) share else 1) * c(
    sum(gain * (abs(at$force) + (if (lossy) abs(alpha) else 0) * at$inertia)) +
      (if (lossy) 0 else abs(sum(at$force))),
    sum(gain * at$viscous)
  )
}

# Of a motion of the first shaft: angle and rate of the others, theta/N and omega/N.
shaft_columns <- function(columns, scene) {
  ratio <- scene$train$ratio_to_first[-1]
  names <- shaft_names(scene)
  of <- function(column) lapply(ratio, function(one) column / one)
  columns[names] <- c(of(columns$theta_rad), of(columns$omega_rad_per_s))
  columns
}

shaft_names <- function(scene) {
  others <- seq_along(.subset2(scene, "train")$ratio_to_first)[-1]
  c(
    sprintf("theta_%d_rad", others), sprintf("omega_%d_rad_per_s", others)
  )
}

# Of omega and the net torque: what has the sign of the slope of each of these columns.
shaft_slopes <- function(omega, net, scene) {
  if (is.null(.subset2(scene, "train"))) return(NULL)
  ratio <- scene$train$ratio_to_first[-1]
  slopes <- c(lapply(sign(ratio), `*`, omega), lapply(sign(ratio), `*`, net))
  stats::setNames(slopes, shaft_names(scene))
}

describe_gears <- function(gears) {
  paste0(
    "loss of ", format_si(gears$forward_n_m), " N m forward, ", format_si(gears$backward_n_m),
    " N m backward, from rest"
  )
}

# A line for each shaft of a scene's train.
describe_shafts <- function(train) {
  shown <- seq_len(min(8L, length(train$shaft)))
  efficiency <- c(1, attr(train, "efficiency"))[shown]
  c(
    paste0(
      "  ", format(paste("shaft", train$shaft[shown]), width = 11L), " ",
      format_si(train$moment_of_inertia_kg_m2[shown]), " kg m^2, ratio to the first ",
      format_si(train$ratio_to_first[shown]),
      ifelse(efficiency < 1, paste0(", by a mesh of efficiency ", format_si(efficiency)), ""),
      "\n", recycle0 = TRUE
    ),
    if (length(train$shaft) > 8L) "  ...\n"
  )
}

#' @rdname gear_train
#' @inheritParams scene_axle
#' @param theta0_rad,omega0_rad_per_s Angle and angular velocity of the first shaft at `start_s`.
#' @return `scene_gears()`: a `rot_scene_axle` of the first shaft. Its motion has a column for the
#'   angle and one for the angular velocity of each other shaft: `theta_2_rad`, `omega_2_rad_per_s`,
#'   ...; all angles are 0 where that of the first is.
#' @export
scene_gears <- function(bodies, ratios, ..., efficiency = 1, torque_n_m = 0, viscous_n_m_s = 0,
                        theta0_rad = 0, omega0_rad_per_s = 0, start_s = 0) {
  call <- check_no_dots(...)
  check_supplied(c("bodies", "ratios"), call)
  train <- train_of(bodies, ratios, efficiency, torque_n_m, viscous_n_m_s, call)
  n <- nrow(train)
  law <- train_law(train)
  inertia <- sum(train$reflected_inertia_kg_m2)
  check_turns(inertia, call, computed = TRUE)
  scene <- new_scene_axle(
    NULL, inertia, NULL, c(0, 0, 1), law$torque, new_resistance(law$viscous, 0, law$dry, law$dry),
    check_number(theta0_rad, "theta0_rad", "rad", call),
    check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
    check_number(start_s, "start_s", "s", call)
  )
  scene$rounding <- law$rounding
  scene$gears <- law$gears
  scene$train <- train # for the drawing
  # For the text.
  scene$given <- list(
    bodies = plain_bodies(bodies, train$moment_of_inertia_kg_m2) %||%
      train$moment_of_inertia_kg_m2,
    ratios = check_between(ratios, "ratios", "1", n - 1L, -Inf, call),
    efficiency = check_each(efficiency, "efficiency", "1", n - 1L, 0, call),
    torque_n_m = check_torque_each(torque_n_m, "torque_n_m", n, call),
    viscous_n_m_s = check_each(viscous_n_m_s, "viscous_n_m_s", "N*m*s", n, 0, call)
  )
  scene
}
