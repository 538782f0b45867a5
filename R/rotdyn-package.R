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
#' @section What do you want to do:
#' `r reference_index()`
#' Every object has a `print()`; scenes, bodies, laws, motions and tables have `autoplot()`, motions
#' and fits `summary()` or `glance()`. [update()] changes one thing of a scene or of a body.
#'
#' @section Errors:
#' Every error of the package has the class `rotdyn_error` and one of
#' `r paste0("\\code{rotdyn_error_", names(error_kinds), "} (", error_kinds, ")", collapse = ", ")`.
#'
#' @seealso [scene_axle()] and [trajectory()] to begin with, [inertia_table()], [rolling_table()],
#'   [models()], [metadata()].
#' @concept rotational dynamics
#' @concept rotational motion
#' @concept physics
#' @keywords internal
#' @useDynLib rotdyn, .registration = TRUE
#' @importFrom generics glance augment
"_PACKAGE"

# The pronoun of aesthetics, which ggplot2 evaluates.
utils::globalVariables(".data")

# What users do, and the functions for it: inst/metadata/reference.csv, with * for any ending.
reference_table <- function() {
  rows <- read_table("reference")
  exports <- sort(getNamespaceExports("rotdyn"))
  found <- lapply(rows$functions, function(pattern) {
    exports[grepl(utils::glob2rx(pattern), exports)]
  })
  new_table(
    list(section = rep(rows$section, lengths(found)), name = unlist(found)),
    nrow = sum(lengths(found))
  )
}

reference_index <- function() {
  rows <- reference_table()
  links <- tapply(
    paste0("\\code{\\link{", rows$name, "}}"), factor(rows$section, unique(rows$section)), paste,
    collapse = ", "
  )
  paste0(
    "\\describe{\n",
    paste0("\\item{", sentence(names(links)), "}{", links, "}", collapse = "\n"), "\n}"
  )
}
