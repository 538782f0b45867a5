#' Work, heat and impulse row by row
#'
#' The ledger of a trajectory as columns: since the first row, the work of the torques, what each
#' kind of resistance dissipated, the work of what changes the inertia, both impulses; and the power
#' of the torque at each row. With several bodies, work, heat and impulse are those of all of them;
#' the power is that of the torque on the body of the row.
#'
#' On an axle each is an integral of the computed motion between the rows by Gauss-Kronrod
#' quadrature to some 1e-14 of the whole; none is a difference of others. Elsewhere they are closed
#' forms.
#'
#' @param x A `rot_trajectory` whose rows are in the order of time.
#' @param ... Not used.
#' @return The trajectory with the columns `r describe_columns(augment_columns)`
#'   With springs or gravity on an axle also `potential_energy_j`: `k (theta - rest)^2/2`, and
#'   `m g d (1 - cos(theta - rest))` above the rest angle; the work includes theirs. With several
#'   rotors or a clutch, those of them that are known: power, work, heat and the
#'   impulse of the torques. Without rows they are empty.
#' @section Errors: `rotdyn_error_time` if the rows are not in the order of time;
#'   `rotdyn_error_range` where the motion could not be computed again.
#' @seealso [audit()] for the totals, [trajectory()].
#' @concept work
#' @concept heat
#' @concept power
#' @examples
#' augment(spin_up(time_s = 0:8))[, c("time_s", "power_w", "work_j", "dissipated_j")]
#' @aliases augment
#' @rawNamespace export(augment)
#' @export
augment.rot_trajectory <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  run <- check_trajectory(x, "x", call)
  constraint <- constraint_of(run$scene)
  check_rows(x, call, constraint$keys)
  if (is.unsorted(x$time_s)) {
    abort_rotdyn("The rows must be in the order of time to be added up.", "time", call)
  }
  edges <- unique(as.double(x$time_s))
  columns <- constraint$augment(x, run, edges, call)
  if (is.null(columns)) {
    abort_rotdyn("The motion between the rows could not be computed.", "range", call)
  }
  at <- match(x$time_s, edges)
  per_row <- names(columns) == "power_w"
  x[names(columns)] <- c(columns[per_row], lapply(columns[!per_row], `[`, at))
  x
}

# The key columns as they are now: numbers, and no time missing.
check_rows <- function(x, call, columns) {
  for (name in columns) {
    check_column(x[[name]], name, "1", call)
  }
  if (anyNA(x$time_s)) abort_rotdyn("{.field time_s} must not be missing.", "time", call)
}

# Objects of other packages keep the methods of these: one for all others is set where none is.
#' @noRd
set_default_verbs <- function() {
  generics <- asNamespace("generics")
  verbs <- list(augment = augment_unknown, glance = glance_unknown)
  for (verb in names(verbs)) {
    # As utils::getS3method() finds it, which loads tools: a fifth of the time to load the package.
    method <- paste0(verb, ".default")
    if (is.null(generics[[".__S3MethodsTable__."]][[method]]) && is.null(generics[[method]])) {
      registerS3method(verb, "default", verbs[[verb]], envir = generics)
    }
  }
}

augment_unknown <- function(x, ...) {
  abort_unknown(x, "a trajectory, an estimate or a fit", current_env())
}

glance_unknown <- function(x, ...) {
  abort_unknown(x, "a trajectory, an equilibrium, an estimate or a fit", current_env())
}

abort_unknown <- function(x, known, call) {
  if (missing(x)) check_supplied("x", call)
  abort_rotdyn(c(
    paste("{.arg x} must be", known, "of this package."), x = "It is {describe_value(x)}."
  ), "type", call)
}
