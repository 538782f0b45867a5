#' Where a bead on a turning hoop may rest
#'
#' The angles at which gravity and the centrifugal force balance along the hoop, without friction:
#' the lowest and the highest point, and for \eqn{\Omega^2 > g/R}{W^2 > g/R} the two at
#' \eqn{\cos\theta = g/(R\Omega^2)}{cos(theta) = g/(R W^2)}.
#'
#' @param scene A [scene_hoop()]; its start and its friction do not count.
#' @param ... Not used: an unknown argument is an error.
#' @return A tibble with a row for each equilibrium:
#'   `r describe_columns(hoop_equilibrium_columns)`
#'   A small swing about a stable one has the rate `swing_rad_per_s`; a small distance from an
#'   unstable one grows as `exp(growth_per_s t)`. At \eqn{\Omega^2 = g/R}{W^2 = g/R} the lowest
#'   point is stable with the rate 0.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Strogatz, Nonlinear Dynamics and Chaos (1994), section 3.5.
#' @seealso [scene_hoop()].
#' @concept bifurcation
#' @examples
#' hoop_equilibria(scene_hoop(0.05, 0.2, hoop_omega_rad_per_s = 6))
#' hoop_equilibria(scene_hoop(0.05, 0.2, hoop_omega_rad_per_s = 9))
#' @export
hoop_equilibria <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene_of(scene, "hoop", call)
  turn <- scene$hoop_omega_rad_per_s^2
  pull <- scene$gravity_m_per_s2 / scene$radius_m
  # Of the square, 1 - (g/(R W^2))^2 keeps its digits as a product.
  aside <- if (turn > pull) atan2(sqrt((turn - pull) * (turn + pull)), pull) else double()
  theta <- c(0, pi, aside, -aside)
  # Minus the slope of the acceleration along the hoop.
  square <- c(pull - turn, -pull - turn, rep((turn - pull) * (1 + pull / turn), 2 * length(aside)))
  order <- order(theta)
  stable <- square > 0 | (theta == 0 & square == 0)
  new_table(list(
    theta_rad = theta[order], stable = stable[order],
    swing_rad_per_s = ifelse(stable, sqrt(pmax(square, 0)), NA_real_)[order],
    growth_per_s = ifelse(stable, NA_real_, sqrt(pmax(-square, 0)))[order]
  ), nrow = length(theta))
}

hoop_equilibrium_columns <- c("theta_rad", "stable", "swing_rad_per_s", "growth_per_s")
equilibrium_column_words <- list(
  c("stable", "", "whether a small distance from an equilibrium stays small"),
  c("swing_rad_per_s", "rad/s", "rate of small swings about a stable equilibrium"),
  c("growth_per_s", "1/s", "rate at which a small distance from an unstable equilibrium grows")
)
