#' Audit a trajectory
#'
#' The balances of a motion from its first row to its last, a row each: the change of a quantity
#' against what supplied it, less what dissipated it. Energy: the change of kinetic energy, and of
#' what springs, height and elastic shafts store, against the work of the other torques (and of what
#' changes the inertia) less the heat. Angular momentum: its change against the impulse of the
#' torques less that of the resistance. Work, heat and impulses are computed separately (in closed
#' form, or with the integration), never as what is missing, so a residual means something; each
#' comes with what rounding and the stated error could explain, and a verdict.
#' \deqn{\Delta\left(\tfrac12 I \omega^2 + U\right) = \int \tau\,\omega\,dt - Q, \quad
#'   \Delta(I \omega) = \int (\tau + \tau_r)\,dt}{
#'   change of I omega^2/2 + U = int tau omega dt - Q,  change of I omega = int (tau + tau_r) dt}
#' with the potential energy U, the heat Q and the torque \eqn{\tau_r}{tau_r} of the resistance.
#' With several bodies the sums are over all of them; torques between them have no part in the
#' angular momentum.
#'
#' The changes are taken from the rows as they are now: edit a value, and the audit says so. When
#' rows were dropped, the balance runs over the rows that are left. Of one time alone there is no
#' change, and a warning (class `rotdyn_warning_time`). Where [choose_model()] left an
#' effect out, the balance is that of the motion without it.
#'
#' Where a law is an R function, work and impulses are those of a second run, which looks at the law
#' four times as closely (`resolution` of [trajectory()]): a narrow change that the motion missed,
#' and that this run finds, is an unbalanced residual.
#'
#' `conserved` is the answer of [conserved()]: a quantity that is said to stay, and changes or is
#' dissipated by more than rounding and the stated error explain, is unbalanced.
#'
#' @param x A `rot_trajectory`; or a collision, with `row` and `about` as in [collision_ledger()].
#' @param ... Not used.
#' @return A `rot_audit`: a tibble with a row for each balance. `print(x, digits = 4)` shows its
#'   terms with so many significant digits, `ggplot2::autoplot()` draws them as bars. The columns:
#'   `r describe_columns(audit_columns)`
#'   `terms` holds, for each balance, a tibble with the columns
#'   `r describe_columns(c("term", "role", "value"))`
#'   In a file (`write.csv()`) and by `as.character()` they are text, such as
#'   `supplied: work 2 | dissipated: viscous heat 0.5 | change: kinetic energy 1.5`.
#'   The verdict is NA where a balance cannot be drawn: no rows, rotors missing from them, energies
#'   beyond double precision, or a motion whose error is not known.
#' @section Errors: `rotdyn_error_type` for what has no audit (a table that lost its columns is no
#'   trajectory); `rotdyn_error_time` for a missing time.
#' @seealso [augment.rot_trajectory()] for the same terms row by row, [summary.rot_trajectory()],
#'   [trajectory()].
#' @concept energy balance
#' @concept conservation
#' @concept conservation of energy
#' @concept conservation of angular momentum
#' @examples
#' wheel <- audit(spin_up())
#' wheel
#' all(wheel$verdict == "balanced")
#' wheel$terms[[1]]
#' @export
audit <- function(x, ...) {
  if (missing(x)) check_supplied("x", current_env())
  UseMethod("audit")
}

#' @export
audit.default <- function(x, ...) {
  check_class(x, "rot_trajectory", "x", "{.fn trajectory} gives one.", current_env())
}

#' @export
audit.rot_trajectory <- function(x, ...) {
  call <- current_env()
  check_no_dots(...)
  run <- check_trajectory(x, "x", call)
  audit <- new_audit(balances_of(x, run, call))
  warn_one_time(x, run, call)
  audit
}

# A time alone has no change: its balance is no answer. (A repeated time has one, at a jump.)
warn_one_time <- function(x, run, call) {
  keys <- intersect(c("time_s", constraint_of(run$scene)$index), names(x))
  rows <- unclass(x)[keys]
  one <- length(rows$time_s) && all(rows$time_s == rows$time_s[1]) &&
    !anyDuplicated(as.data.frame(rows))
  times <- sort(c(.subset2(run$scene, "start_s"), rows$time_s[1]))
  if (!one || times[1] == times[2]) return(invisible())
  warn_rotdyn(c(
    "The motion has one time, {format_si(rows$time_s[1])} s: nothing changes from its first row to
     its last.",
    i = "Give {.fn trajectory} its start and its end:
         {.code time_s = c({format_si(times[1])}, {format_si(times[2])})}."
  ), "time", call)
}

balances_of <- function(x, run, call) {
  constraint <- constraint_of(run$scene)
  run <- look_closer(run)
  check_rows(x, call, constraint$keys)
  balances <- withCallingHandlers(
    constraint$balances(x, run, call),
    rotdyn_warning_breaks = function(w) invokeRestart("muffleWarning") # the motion gave it
  )
  balances <- mark_conserved(balances, statements_of(run$solved))
  if (isTRUE(run$info$lost)) lapply(balances, without_verdict) else balances
}

# An error that is not known would explain any residual.
without_verdict <- function(one) {
  one[c("rounding", "verdict")] <- list(NA_real_, NA_character_)
  one
}

# Of a law that is an R function: work and impulses come from a run that looks at it four times as
# closely, so that a change which the motion missed is no part of both.
look_closer <- function(run) {
  resolution <- run$info$resolution
  if (is.null(resolution) || resolution >= 1) return(run)
  run$scene$resolution <- run$solved$resolution <- resolution / 4
  run$ledger <- NULL
  run
}

new_audit <- function(balances) {
  if (!length(balances)) return(new_audit(list(no_balance("", NA_character_, "")))[0L, ])
  column <- function(name) {
    unlist(lapply(balances, `[[`, name), use.names = FALSE)
  }
  columns <- lapply(audit_columns, column)
  names(columns) <- audit_columns
  columns$terms <- new_terms(lapply(balances, `[[`, "terms"))
  new_table(columns, nrow = length(balances), class = "rot_audit")
}

# One balance: change = supplied - dissipated, each numbers named in words. `about`: the point or
# axis of a momentum.
balance <- function(name, about, unit, change, supplied, dissipated, rounding) {
  residual <- (sum(change) - sum(supplied)) + sum(dissipated)
  balanced <- if (is.finite(residual) && is.finite(rounding)) abs(residual) <= rounding else NA
  parts <- c(supplied, dissipated, change)
  list(
    balance = name, about = about, unit = unit,
    change = sum(change), supplied = sum(supplied), dissipated = sum(dissipated),
    residual = residual, rounding = rounding,
    conserved = NA,
    verdict = if (is.na(balanced)) NA_character_ else if (balanced) "balanced" else "unbalanced",
    terms = new_table(list(
      term = names(parts) %||% rep(NA_character_, length(parts)),
      role = rep(
        c("supplied", "dissipated", "change"), lengths(list(supplied, dissipated, change))
      ),
      value = unname(parts)
    ), nrow = length(parts))
  )
}

# A balance without the rows that it needs.
no_balance <- function(name, about, unit) {
  balance(name, about, unit, NA_real_, NA_real_, NA_real_, NA_real_)
}

# The terms of several balances, a tibble each: a list that writes itself as text.
new_terms <- function(x) structure(x, class = c("rot_terms", "list"))

#' @export
`[.rot_terms` <- function(x, i) new_terms(unclass(x)[i])

#' @export
c.rot_terms <- function(...) new_terms(unlist(lapply(list(...), unclass), recursive = FALSE))

# Without separators of files: write.csv() puts no quotes round it.
#' @export
as.character.rot_terms <- function(x, ...) {
  vapply(unclass(x), function(terms) {
    if (is.null(terms)) return(NA_character_)
    said <- paste(terms$term, .Call(ffi_text_numbers, as.double(terms$value)))
    said <- tapply(said, factor(terms$role, unique(terms$role)), paste, collapse = " + ")
    gsub("[,;]", "", paste0(names(said), ": ", said, collapse = " | "))
  }, "")
}

#' @export
print.rot_audit <- function(x, ..., digits = 4) {
  call <- current_env()
  digits <- check_number(digits, "digits", "1", call, lower = 1, upper = 22)
  kinds <- c(
    balance = "character", about = "character", unit = "character", residual = "numeric",
    rounding = "numeric", terms = "list"
  )
  if (!all(audit_columns %in% names(x)) || !has_kinds(x, kinds)) {
    print(drop_class(x, "rot_audit"), ...)
    return(invisible(x))
  }
  wide <- as.integer(digits) + 8L
  line <- function(text, value, unit) {
    room <- print_width() - wide - nchar(unit) - 4L
    text <- if (nchar(text) <= room) text else strwrap(text, max(room, 16L), 0L, 4L)
    last <- sprintf("  %-*s %*s %s", max(min(38L, room), 0L), text[length(text)], wide,
                    format(value, digits = digits), unit)
    cat(c(sprintf("  %s", text[-length(text)]), last), sep = "\n")
  }
  verdict <- if (all(x$verdict %in% "balanced")) "balanced" else
    if ("unbalanced" %in% x$verdict) "unbalanced" else "no verdict"
  if (!nrow(x)) {
    say("<rot_audit> nothing to balance: the scene does not name what is conserved")
    return(invisible(x))
  }
  cat("<rot_audit> ", verdict, "\n", sep = "")
  for (i in seq_len(nrow(x))) {
    unit <- x$unit[i]
    about <- if (!is.na(x$about[i])) paste(" about", x$about[i])
    kept <- if (isTRUE(x$conserved[i])) ": conserved"
    say(gsub("_", " ", x$balance[i]), about, kept)
    terms <- x$terms[[i]]
    if (all(is.na(terms$value))) {
      say("  no values: rows, or energies in double precision, are missing")
      next
    }
    for (role in c("supplied", "dissipated", "change")) {
      part <- terms[terms$role == role, ]
      shown <- part[!part$value %in% 0, ]
      if (nrow(shown) == 0L) shown <- part[seq_len(min(1L, nrow(part))), ]
      sign <- c(supplied = "+", dissipated = "-", change = "=")[[role]]
      for (k in seq_len(nrow(shown))) {
        first <- k == 1L && role != "dissipated"
        mark <- if (!first) sub("=", "+", sign) else if (role == "change") "=" else " "
        line(paste(mark, shown$term[k]), shown$value[k], unit)
      }
    }
    line("  residual", signif(x$residual[i], 2), unit)
    line("  explained by rounding and error", signif(x$rounding[i], 2), unit)
  }
  invisible(x)
}
