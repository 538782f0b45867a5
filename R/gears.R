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
#' **Efficiency.** A stage transmits the share `efficiency` of its input power, in the direction of
#' the power flow: with `eta` the product of the efficiencies between, a torque that drives acts on
#' the first shaft as `eta tau_i/N_i`, one that loads as `tau_i/(N_i eta)`. In the sense of rotation
#' a torque with `tau_i/N_i > 0` drives, the others load; backwards it is the other way round.
#' `reflected_torque_n_m` is for the positive sense. The loss resists either rotation, so it acts
#' like dry friction that differs between the two senses, and a train whose torques it exceeds stays
#' at rest. Inertia and viscous torques are reflected without losses.
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
  passed <- cumprod(c(1, efficiency))
  felt <- torque / ratio
  train <- list(
    shaft = seq_len(n),
    ratio_to_first = ratio,
    moment_of_inertia_kg_m2 = inertia,
    reflected_inertia_kg_m2 = inertia / ratio / ratio,
    reflected_viscous_n_m_s = viscous / ratio / ratio,
    reflected_torque_n_m = ifelse(felt > 0, felt * passed, felt / passed)
  )
  warn_beyond(train[-1], list(), n, call)
  tibble::new_tibble(train, nrow = n, torque_n_m = torque, class = "rot_gear_train")
}

# The loss of the gears of a train, as torques at the first shaft: `applied_n_m` is the sum without
# loss, which resists with forward_n_m while the shaft turns forward, with backward_n_m while it
# turns backward. With F applied, that is the torque F + (backward - forward)/2 and dry friction of
# (forward + backward)/2.
gear_loss <- function(train, torque, efficiency) {
  felt <- torque / train$ratio_to_first
  share <- cumprod(c(1, rep_len(efficiency, length(felt) - 1L)))
  driving <- abs(felt) * (1 - share)
  loading <- abs(felt) * ((1 - share) / share)
  list(
    applied_n_m = sum(felt),
    forward_n_m = sum(ifelse(felt > 0, driving, loading)),
    backward_n_m = sum(ifelse(felt > 0, loading, driving))
  )
}

# What a scene's gears take from its torque so that dry friction can stand for the rest: applied
# without loss, less the torque that is solved.
gear_shift <- function(scene) {
  gears <- .subset2(scene, "gears")
  if (is.null(gears)) 0 else (gears$forward_n_m - gears$backward_n_m) / 2
}

# The rounding of a train's sums, as a torque and as a viscous coefficient, by a count of roundings:
# shaft i has a ratio of i - 2 products, and a share that the gears pass on of as many.
gear_rounding <- function(train, loss, efficiency, viscous) {
  n <- length(train$shaft)
  stage <- seq_len(n) - 1
  felt <- abs(attr(train, "torque_n_m") / train$ratio_to_first)
  share <- cumprod(c(1, rep_len(efficiency, n - 1L)))
  lost <- felt * (1 - share) + felt * ((1 - share) / share)
  both <- loss$forward_n_m + loss$backward_n_m
  torque <- sum(stage * felt) + n * sum(felt) +
    sum(pmax(stage - 1, 0) * felt * (1 + 1 / share)) + sum((stage + 3) * lost) + (n + 1) * both
  # A sum of moments of inertia that is off counts as a torque that is.
  net <- abs(loss$applied_n_m) + max(loss$forward_n_m, loss$backward_n_m)
  most <- 2 * (n - 1) + n - 1
  .Machine$double.eps / 2 * c(torque + most * net, 2 * most * viscous)
}

# Columns of the solved torques: the loss belongs to the resistance.
geared_columns <- function(columns, scene) {
  if (is.null(.subset2(scene, "gears"))) return(columns)
  shift <- gear_shift(scene)
  if (shift == 0) return(columns)
  columns$applied_torque_n_m <- scene$gears$applied_n_m + 0 * columns$applied_torque_n_m
  columns$damping_torque_n_m <- columns$damping_torque_n_m - shift
  still <- columns$net_torque_n_m == 0
  columns$damping_torque_n_m[still] <- -columns$applied_torque_n_m[still]
  columns
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

# What that adds to the flows of the solved torques, a column each.
geared_flows <- function(scene, turned_rad, span_s) {
  shift <- gear_shift(scene)
  cbind(
    work_j = shift * turned_rad, coulomb_j = shift * turned_rad, dissipated_j = shift * turned_rad,
    impulse_n_m_s = shift * span_s, damping_impulse_n_m_s = -shift * span_s
  )
}

describe_gears <- function(gears) {
  paste0(
    "loss of ", format_si(gears$forward_n_m), " N m forward, ", format_si(gears$backward_n_m),
    " N m backward"
  )
}

# A line for each shaft of a scene's train.
describe_shafts <- function(train) {
  shown <- seq_len(min(8L, length(train$shaft)))
  c(
    paste0(
      "  ", format(paste("shaft", train$shaft[shown]), width = 11L), " ",
      format_si(train$moment_of_inertia_kg_m2[shown]), " kg m^2, ratio to the first ",
      format_si(train$ratio_to_first[shown]), "\n", recycle0 = TRUE
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
  loss <- gear_loss(
    train, check_torque_each(torque_n_m, "torque_n_m", n, call),
    check_each(efficiency, "efficiency", "1", n - 1L, 0, call)
  )
  dry <- (loss$forward_n_m + loss$backward_n_m) / 2
  inertia <- sum(train$reflected_inertia_kg_m2)
  check_turns(inertia, call, computed = TRUE)
  scene <- new_scene_axle(
    NULL, inertia, NULL, c(0, 0, 1),
    as_torque(loss$applied_n_m + (loss$backward_n_m - loss$forward_n_m) / 2, call),
    new_resistance(sum(train$reflected_viscous_n_m_s), 0, dry, dry),
    check_number(theta0_rad, "theta0_rad", "rad", call),
    check_number(omega0_rad_per_s, "omega0_rad_per_s", "rad/s", call),
    check_number(start_s, "start_s", "s", call)
  )
  scene$rounding <- gear_rounding(train, loss, efficiency, scene$resistance$viscous_n_m_s)
  if (dry > 0) scene$gears <- loss
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
