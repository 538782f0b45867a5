#' Change a scene or a body
#'
#' The scene, or the body, that its constructor makes with some arguments changed: the others keep
#' what they were given.
#'
#' An argument that had its default follows the change: of a ball that rolls from the start the
#' angular velocity follows a new `v0_m_per_s`, and kinetic friction follows static friction. Rates
#' of a drive that turns at its ratios follow new ratios. A mass replaces a density, and the
#' reverse.
#'
#' @param object A scene, such as [scene_axle()], or a body.
#' @param ... Arguments of its constructor, by name. NULL, where the constructor takes it, removes
#'   what was given.
#' @return An object of the same class, checked as the constructor checks it.
#' @section Errors: `rotdyn_error_argument` for an argument that the constructor does not have;
#'   `rotdyn_error_type` for a body that no constructor makes (from a mesh or a density, or joined);
#'   those of the constructor.
#' @source Chambers and Hastie, Statistical Models in S (1992), chapter 2 (`update()`).
#' @seealso [scene_axle()], [body_shapes], [write_scene()].
#' @concept change
#' @concept parameter
#' @concept change one thing
#' @importFrom stats update
#' @examples
#' wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03))
#' update(wheel, omega0_rad_per_s = 20, torque = NULL)
#' ball <- body_sphere(6, 0.11)
#' lane <- scene_incline(ball, 10, v0_m_per_s = 3, static_friction = 0.2)
#' update(lane, v0_m_per_s = 4)$omega0_rad_per_s * 0.11
#' update(lane, body = update(ball, mass_kg = 5))
#' @name update
NULL

#' @rdname update
#' @export
update.rot_scene <- function(object, ...) {
  call <- current_env()
  check_scene(object, call)
  constraint <- constraint_of(object)
  texts <- constraint$texts
  changed_object(object, names(texts)[1], texts[[1]]$arguments(object), list(...), call)
}

#' @rdname update
#' @export
update.rot_body <- function(object, ...) {
  call <- current_env()
  check_body(object, call, "object")
  forms <- body_texts(object)
  name <- names(forms)[1]
  if (name == "rot_body" || !exists(name, envir = topenv(), mode = "function")) {
    abort_rotdyn(c(
      "No constructor makes this body from sizes: it is a {.val {object$shape}}.",
      i = if (name == "rot_body") remade_by(object$provenance) else "Make it anew from its parts."
    ), "type", call)
  }
  changed_object(object, name, forms[[1]]$arguments(object), list(...), call)
}

# Where a body of no shape comes from.
remade_by <- function(provenance) {
  if (provenance %in% c("quadrature", "monte_carlo")) provenance <- "density"
  if (!provenance %in% c("tensor", "mesh", "density", "points")) {
    return("Make it anew from its parts.")
  }
  paste0("Make it anew with {.fn body_", provenance, "}.")
}

# Arguments of other constructors whose scene is a drive where a brake or a law asks for it.
parts_of_drive <- c(
  body = "bodies", body_1 = "bodies", body_2 = "bodies", axis = "bodies", through = "bodies",
  ratios = "couplings", efficiency = "couplings", stiffness_n_m_per_rad = "couplings",
  damping_n_m_s = "couplings", capacity_n_m = "couplings", static_capacity_n_m = "couplings",
  engage_s = "couplings"
)

changed_object <- function(object, name, arguments, changes, call) {
  constructor <- get(name, envir = topenv(), mode = "function")
  known <- setdiff(names(formals(constructor)), "...")
  wrong <- setdiff(names(changes) %||% rep("", length(changes)), known)
  if (length(wrong)) {
    near <- near_names(wrong[nzchar(wrong)], known)
    part <- if (name == "scene_drive") stats::na.omit(parts_of_drive[wrong])
    if (length(part)) near <- NULL
    abort_rotdyn(c(
      if (all(nzchar(wrong))) "{.fn {name}} has no argument {.arg {wrong}}." else
        "Arguments to change must be given by name.",
      i = if (length(near)) "Did you mean {.arg {near}}?",
      i = if (length(part)) {
        "A brake or a torque law made this scene a {.fn scene_drive}: {.arg {names(part)[1]}} is in
         its {.arg {part[[1]]}}."
      },
      i = "The arguments are {.arg {known}}."
    ), "argument", call)
  }
  make <- function(arguments) do.call(constructor, arguments, quote = TRUE)
  arguments <- arguments[!vapply(arguments, is.null, NA)]
  # What the constructor finds again without it was not given.
  for (one in setdiff(names(arguments), names(changes))) {
    if (identical(formals(constructor)[[one]], quote(expr = ))) next
    without <- make_quietly(make, list(arguments[setdiff(names(arguments), one)]))
    if (same_object(without, object)) arguments[[one]] <- NULL
  }
  # A body has a mass or a density.
  amounts <- c("mass_kg", density_names[nzchar(density_names)])
  if (inherits(object, "rot_body") && any(names(changes) %in% amounts)) {
    changes <- changes[!(names(changes) %in% amounts & vapply(changes, is.null, NA))]
    if (any(names(changes) %in% amounts)) arguments[amounts] <- NULL
  }
  arguments[names(changes)] <- changes
  in_call(make(arguments), call)
}
