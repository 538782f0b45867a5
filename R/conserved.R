#' What is conserved, and why
#'
#' Which of momentum, angular momentum (about which point) and energy a scene, a motion or a
#' collision conserves, with the reason. It follows from what acts, not from the numbers:
#'
#' * momentum along a direction, where no impulse from outside has a component along it;
#' * angular momentum about a point, where no torque from outside acts about it. Torques between the
#'   bodies, of shafts, springs and clutches, do not count;
#' * energy, kinetic plus potential, where nothing dissipates and nothing but springs and gravity
#'   works.
#'
#' [audit()] has the same answer in its column `conserved`, and is "unbalanced" where a conserved
#' quantity changes by more than rounding and the stated error explain.
#'
#' @param x A scene, a `rot_trajectory`, or a collision such as [collide()] returns.
#' @param row,about For a collision, as in [collision_ledger()].
#' @param ... Not used; names after it must be given in full.
#' @return A tibble: `r describe_columns(conserved_columns)`
#'   FALSE says that something acts that can change the quantity. A trajectory has the answer of the
#'   scene that was solved, without the effects that the model ignores.
#' @section Errors: `rotdyn_error_type` for anything else; those of [collision_ledger()].
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), sections 1.1 and 1.2.
#' @seealso [audit()], [collision_ledger()].
#' @concept conservation
#' @concept conservation of angular momentum
#' @concept conservation of energy
#' @examples
#' # A skater pulls in her arms: angular momentum stays, energy does not.
#' conserved(scene_axle(inertia_knots(c(0, 2), c(4, 1.2)), omega0_rad_per_s = 3))
#' # A clutch: the heat goes out of the energy, the torques are internal.
#' conserved(scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0)))
#' # A ball on a floor, about the contact and about its centre.
#' bounce <- ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, 0.75, friction = 0.5)
#' conserved(bounce)
#' conserved(bounce, about = "the centre")
#' @export
conserved <- function(x, ...) {
  if (missing(x)) check_supplied("x", current_env())
  UseMethod("conserved")
}

#' @export
conserved.default <- function(x, ...) {
  check_class(
    x, "rot_scene", "x", "{.fn scene_axle} makes one; a trajectory or a collision will do, too.",
    current_env()
  )
}

#' @export
conserved.rot_scene <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  check_scene(x, call)
  conserved_table(statements_of(x))
}

#' @export
conserved.rot_trajectory <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  conserved_table(statements_of(check_trajectory(x, "x", call)$solved))
}

# One statement of a constraint: the quantity and the point, as its balances name them; whether it
# is conserved; the reason in words.
statement <- function(quantity, about, conserved, why) {
  list(quantity = quantity, about = about, conserved = conserved, why = why)
}

# Of a quantity that `causes` may change: what acts, in words by condition; `otherwise`, the reason
# where none does.
conserved_unless <- function(quantity, about, causes, otherwise) {
  acts <- names(causes)[vapply(causes, isTRUE, NA)]
  if (!length(acts)) return(statement(quantity, about, TRUE, otherwise))
  statement(quantity, about, FALSE, paste(acts, collapse = "; "))
}

statements_of <- function(scene) {
  statements <- constraint_of(scene)$conserved
  if (!is.null(statements)) return(statements(scene))
  list(statement("energy", NA_character_, NA, "the constraint does not say"))
}

conserved_table <- function(statements) {
  columns <- lapply(conserved_columns, function(name) {
    unlist(lapply(statements, `[[`, name), use.names = FALSE)
  })
  names(columns) <- conserved_columns
  new_table(columns, nrow = length(statements))
}

# Each balance with the statement of its quantity. Conserved: nothing may be dissipated, and a
# momentum may not change, beyond what rounding and the stated error explain.
mark_conserved <- function(balances, statements) {
  # About nothing is NA in both.
  key <- function(quantity, about) paste(quantity, about, sep = "\r")
  known <- vapply(statements, function(s) key(s$quantity, s$about), "")
  lapply(balances, function(b) {
    at <- match(key(b$balance, b$about), known)
    b$conserved <- if (is.na(at)) NA else statements[[at]]$conserved
    if (isTRUE(b$conserved)) {
      moved <- abs(c(b$dissipated, if (b$balance != "energy") b$change))
      if (isTRUE(any(moved > b$rounding))) b$verdict <- "unbalanced"
    }
    b
  })
}
