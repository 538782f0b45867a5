#' Rotational dynamics with an audit
#'
#' Describe a *scene*: a body, its constraint, the torques and resistances. [trajectory()] chooses
#' the cheapest model that is accurate enough ([choose_model()] gives the reason), computes it in C,
#' and returns a tibble with its error and an [audit()].
#'
#' ```
#' describe  ->  choose  ->  compute  ->  present
#' body          model       C core       trajectory (a tibble)
#' torque        + reason                 summary, audit, autoplot, predict
#' resistance    + error
#' scene
#' ```
#'
#' @section Conventions:
#' * **Units** are SI, and every argument and column that has a unit carries it in its name:
#'   `mass_kg`, `omega_rad_per_s`. Torque is in N m and never in J. An object of the units package
#'   (or a difftime) is converted; a wrong dimension is an error.
#' * **Signs**: an angle, a rate, a torque and an angular momentum about an axle are positive in the
#'   right-handed sense about the axle's direction. A resisting torque is the torque on the body:
#'   its sign is opposite to that of the rate. `net = applied + damping`.
#' * **Axes** of a body: its own; `z` is the usual axis of rotation (the symmetry axis of a disk),
#'   and a rod lies along `x`.
#' * **Error figures** are relative: the largest error of theta over the rows, divided by the
#'   largest |theta| from the start to the last row; or the same of omega, if that is larger. A
#'   `"bound"` is never exceeded. An `"estimate"` compares the run with what it would have been with
#'   fewer points; it covers the true error in at least 95 of 100 scenes (`make check-coverage`).
#' * **Missing values**: functions of numbers give NA for NA, row by row. A description (a body, a
#'   torque, a scene, a grid of times) must be complete.
#'
#' @section Errors:
#' Every error of the package has the class `rotdyn_error` and one of
#' `r paste0("\\code{rotdyn_error_", names(error_kinds), "} (", error_kinds, ")", collapse = ", ")`.
#'
#' @seealso [scene_axle()] and [trajectory()] to begin with, [inertia_table()], [rolling_table()],
#'   [models()], [metadata()].
#' @keywords internal
#' @useDynLib rotdyn, .registration = TRUE
#' @importFrom generics glance augment
#' @importFrom rlang .data
"_PACKAGE"
