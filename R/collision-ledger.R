# A collision: the columns of its function, with an attribute `collision`:
#   parties  by name, numbers before: mass_kg, second_moment_kg_m2 and attitude (rows of nine),
#            centre_m, v, omega (rows of three); after_v, after_omega: names of the columns after
#            ("": 0, with a minus: its negative), or numbers
#   outside  by name: point_m, and impulse (names of columns or numbers) of what is not in `parties`
#   about    points by name; the first is the usual one
#   normal, contact, and radius_m of a party: for drawings, or NULL
# Each has one row, or one for each collision. What changes rows leaves a plain tibble.
new_collision <- function(columns, n, parties, outside, about, call, normal = NULL,
                          contact = NULL) {
  warn_beyond(lapply(columns, nan_as_inf), list(), n, call)
  new_table(
    columns, nrow = n, class = "rot_collision",
    collision = list(
      parties = parties, outside = outside, about = about, normal = normal, contact = contact,
      rows = as.double(n),
      columns = names(columns)
    )
  )
}

collision_form <- list(
  rows = "number", columns = "texts", parties = list(.each = list(
    mass_kg = "numbers", second_moment_kg_m2 = "numbers", attitude = "numbers",
    centre_m = "values", v = "values", omega = "values"
  ))
)

reconstruct_collision <- function(x, from) {
  reconstruct_whole(
    x, from, "collision", intersect(attr(from, "collision")$columns, names(from))
  )
}

#' @export
`[.rot_collision` <- function(x, ...) reconstruct_collision(NextMethod(), x)

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_collision <- function(data, template) reconstruct_collision(data, template)

#' The ledger of a collision
#'
#' Momentum, angular momentum about a point, and energy before and after a collision; what an
#' obstacle or a hinge supplied; where the energy went. `audit()` draws the same balances up as
#' those of a motion.
#'
#' Before and after are taken from the velocities alone, impulses and losses from their own columns,
#' so a residual means something: it is explained where it is below `rounding`, what the rounding of
#' the terms can add up to. An edited velocity shows.
#'
#' @param x A collision, from [collide()], [ball_bounce()], [hinged_hit()], [disks_lock()] or
#'   [rims_meet()].
#' @param row The collision: a row of `x`.
#' @param about The point of the angular momentum: its name, such as `"the contact"`, or three
#'   numbers in m from the first of the points that the collision has, which is the default.
#' @param ... Not used; names after it must be given in full.
#' @return A tibble (class `rot_ledger`), a row for each component that is not 0 throughout, and one
#'   for the energy: `r describe_columns(ledger_columns)`
#'   `print()` shows it with the parts of the energy, `ggplot2::autoplot()` draws these.
#' @section Errors: `rotdyn_error_type` for what is no collision (rows that were filtered, sorted or
#'   joined are a plain tibble); `rotdyn_error_value`, `rotdyn_error_size`, `rotdyn_error_argument`.
#' @seealso [conserved()] for what is conserved and why, [audit()], [autoplot.rot_ledger()].
#' @concept energy balance
#' @concept conservation
#' @examples
#' ball <- body_sphere(0.06, 0.033)
#' bounce <- ball_bounce(
#'   ball, vx_m_per_s = 20, vy_m_per_s = -5, omega_rad_per_s = -300, restitution = 0.75,
#'   friction = 0.5
#' )
#' collision_ledger(bounce)
#' collision_ledger(bounce, about = "the centre")
#' audit(bounce)
#' @export
collision_ledger <- function(x, row = 1, about = NULL, ...) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  collision <- check_collision(x, call)
  row <- check_number(row, "row", "1", call, lower = 1, upper = max(1, nrow(x)))
  ledger <- draw_ledger(x, collision, floor(row), about, call)
  columns <- c("balance", audit_columns[-1])
  out <- stats::setNames(lapply(columns, function(name) {
    unlist(lapply(ledger$balances, `[[`, name), use.names = FALSE)
  }), columns)
  out <- c(
    out[c("balance", "about", "unit")], list(before = ledger$before, after = ledger$after),
    out[-(1:3)]
  )
  new_table(
    out, nrow = length(ledger$balances), class = "rot_ledger", energies = ledger$energies
  )
}

#' @export
audit.rot_collision <- function(x, row = 1, about = NULL, ...) {
  call <- current_env()
  check_no_dots(...)
  collision <- check_collision(x, call)
  row <- check_number(row, "row", "1", call, lower = 1, upper = max(1, nrow(x)))
  new_audit(draw_ledger(x, collision, floor(row), about, call)$balances)
}

check_collision <- function(x, call) {
  collision <- attr(x, "collision")
  check_class(
    x, "rot_collision", "x",
    "{.fn collide} gives one; rows that were filtered or sorted are a plain tibble.", call
  )
  check_form(collision, collision_form, "x", "collision", call)
  if (nrow(x) != collision$rows || !all(collision$columns %in% names(x))) {
    abort_form("rows", "x", "collision", call)
  }
  collision
}

# Row `i` of a part: names of columns, or numbers with one row or many.
collision_row <- function(part, x, i) {
  if (is.character(part)) {
    return(vapply(part, function(name) {
      if (name == "") return(0)
      value <- as.double(x[[sub("^-", "", name)]][i])
      if (startsWith(name, "-")) -value else value
    }, double(1)))
  }
  if (is.matrix(part)) part[if (nrow(part) == 1L) 1L else i, ] else
    part[if (length(part) == 1L) 1L else i]
}

cross_product <- function(a, b) {
  c(a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1])
}

# The numbers of one collision.
collision_state <- function(x, collision, i) {
  lapply(collision$parties, function(party) {
    at <- function(name) unname(collision_row(party[[name]], x, i))
    turn <- matrix(at("attitude"), 3)
    second <- turn %*% matrix(at("second_moment_kg_m2"), 3) %*% t(turn)
    list(
      mass = at("mass_kg"), inertia = sum(diag(second)) * diag(3) - second, centre = at("centre_m"),
      v = list(at("v"), at("after_v")), omega = list(at("omega"), at("after_omega"))
    )
  })
}

ledger_point <- function(about, x, collision, i, call) {
  points <- collision$about
  if (is.null(about)) about <- names(points)[1]
  if (is.character(about)) {
    about <- check_string(about, "about", names(points), call)
    return(list(name = about, at = collision_row(points[[about]], x, i)))
  }
  about <- check_finite(about, "about", "m", call)
  if (length(about) != 3L) {
    abort_rotdyn(c(
      "{.arg about} must be one of {.or {.val {names(points)}}}, or three numbers in m."
    ), "size", call)
  }
  text <- paste0("(", paste(format_si(about), collapse = ", "), ") m")
  list(name = text, at = collision_row(points[[1]], x, i) + about)
}

draw_ledger <- function(x, collision, i, about, call) {
  if (nrow(x) == 0L) abort_rotdyn("{.arg x} has no collision: no rows.", "value", call)
  point <- ledger_point(about, x, collision, i, call)
  state <- collision_state(x, collision, i)
  eps <- .Machine$double.eps
  norm <- function(v) sqrt(sum(v^2))
  each <- function(f) lapply(state, f)
  momentum <- each(function(s) lapply(s$v, function(v) s$mass * v))
  angular <- each(function(s) {
    Map(function(v, w) {
      drop(s$inertia %*% w) + cross_product(s$centre - point$at, s$mass * v)
    }, s$v, s$omega)
  })
  outside <- lapply(collision$outside, function(o) {
    p <- unname(collision_row(o$impulse, x, i))
    list(p = p, l = cross_product(collision_row(o$point_m, x, i) - point$at, p))
  })
  # Largest terms: a velocity that cancels in a component is rounded by its size.
  speed <- vapply(state, function(s) max(norm(s$v[[1]]), norm(s$v[[2]])), double(1))
  turn <- vapply(state, function(s) max(norm(s$omega[[1]]), norm(s$omega[[2]])), double(1))
  mass <- vapply(state, function(s) s$mass, double(1))
  moment <- vapply(state, function(s) max(abs(s$inertia)), double(1))
  arm <- vapply(state, function(s) norm(s$centre - point$at), double(1))
  reach <- vapply(state, function(s) norm(s$centre), double(1))
  pushes <- sum(mass * speed, vapply(outside, function(o) norm(o$p), double(1)))
  turns <- sum(moment * turn, arm * mass * speed, arm * pushes)

  balances <- list()
  before <- after <- double()
  add <- function(name, about, unit, values, supplied, size) {
    for (k in 1:3) {
      from <- vapply(values, function(v) v[[1]][k], double(1))
      to <- vapply(values, function(v) v[[2]][k], double(1))
      given <- vapply(supplied, function(v) v[k], double(1))
      if (all(c(from, to, given) %in% 0)) next
      balances[[length(balances) + 1L]] <<- balance(
        paste0(name, "_", c("x", "y", "z")[k]), about, unit,
        stats::setNames(to - from, paste("change of", names(state))),
        if (length(given)) stats::setNames(given, paste("impulse of", names(given))) else double(),
        double(), size
      )
      before <<- c(before, sum(from))
      after <<- c(after, sum(to))
    }
  }
  add("momentum", NA_character_, "kg m/s", momentum, lapply(outside, `[[`, "p"), 16 * eps * pushes)
  add(
    "angular_momentum", point$name, "kg m^2/s", angular, lapply(outside, `[[`, "l"),
    32 * eps * turns
  )
  kinetic <- each(function(s) {
    quadratic <- function(w) sum(w * (s$inertia %*% w))
    list(
      c(0.5 * s$mass * sum(s$v[[1]]^2), 0.5 * quadratic(s$omega[[1]])),
      c(0.5 * s$mass * sum(s$v[[2]]^2), 0.5 * quadratic(s$omega[[2]])),
      c(
        0.5 * s$mass * sum((s$v[[2]] - s$v[[1]]) * (s$v[[2]] + s$v[[1]])),
        0.5 * sum((s$omega[[2]] - s$omega[[1]]) * (s$inertia %*% (s$omega[[2]] + s$omega[[1]])))
      )
    )
  })
  parts <- paste(c("translation of", "rotation of"), rep(names(state), each = 2))
  column <- function(k) unlist(lapply(kinetic, `[[`, k), use.names = FALSE)
  loss <- function(name) if (is.null(x[[name]])) 0 else as.double(x[[name]][i])
  losses <- c("lost to restitution" = loss("normal_loss_j"), "lost to friction" =
                loss("friction_loss_j"))
  impulse <- sum(vapply(momentum, function(m) norm(m[[2]] - m[[1]]), double(1)))
  balances[[length(balances) + 1L]] <- balance(
    "energy", NA_character_, "J", stats::setNames(column(3), parts), double(), losses,
    32 * eps * (sum(column(1), column(2), abs(losses)) + impulse * sum(speed + reach * turn))
  )
  # What comes from outside, by component: an impulse of 0 is none.
  from_outside <- function(part, k) {
    names(outside)[vapply(outside, function(o) !o[[part]][k] %in% 0, NA)]
  }
  statements <- lapply(balances, function(b) {
    if (b$balance == "energy") {
      return(conserved_unless(b$balance, b$about, list(
        "the restitution takes energy" = !losses[[1]] %in% 0,
        "friction takes energy" = !losses[[2]] %in% 0
      ), "nothing is lost to restitution or friction"))
    }
    axis <- sub("^.*_", "", b$balance)
    turns <- startsWith(b$balance, "angular")
    part <- if (turns) "l" else "p"
    k <- match(axis, c("x", "y", "z"))
    by <- from_outside(part, k)
    if (length(by) > 1L && sum(vapply(outside, function(o) o[[part]][k], double(1))) %in% 0) {
      return(statement(
        b$balance, b$about, TRUE, paste("the impulses of", paste(by, collapse = " and "), "cancel")
      ))
    }
    what <- if (turns) "an angular impulse about" else "an impulse along"
    statement(b$balance, b$about, !length(by), if (length(by)) {
      paste(paste(by, collapse = " and "), if (length(by) > 1L) "give" else "gives", what, axis)
    } else if (length(outside)) {
      paste("what comes from outside gives no", sub("^an ", "", what), axis)
    } else {
      "all impulses act between the bodies"
    })
  })
  list(
    balances = mark_conserved(balances, statements), statements = statements,
    before = c(before, sum(column(1))), after = c(after, sum(column(2))),
    energies = as_table(
      term = c(parts, names(losses)), before = c(column(1), 0, 0), after = c(column(2), losses)
    )
  )
}

#' @export
print.rot_ledger <- function(x, ..., digits = 4) {
  call <- current_env()
  digits <- check_number(digits, "digits", "1", call, lower = 1, upper = 22)
  energies <- attr(x, "energies")
  if (!all(ledger_columns %in% names(x)) || is.null(energies)) {
    print(drop_class(x, "rot_ledger"), ...)
    return(invisible(x))
  }
  wide <- as.integer(digits) + 8L
  show <- function(value, unit) {
    value[abs(value) <= 1e-14 * max(abs(value), 0, na.rm = TRUE)] <- 0
    formatC(value, digits = digits, format = "g", width = wide)
  }
  at <- which(x$balance == "energy")
  shown <- energies[!(energies$before %in% 0 & energies$after %in% 0), ]
  names <- paste0(gsub("_", " ", x$balance), " (", x$unit, ")")
  names[at] <- "energy (J)"
  label <- max(nchar(c(names, paste0("  ", shown$term))))
  heads <- c("before", "after", "outside", "lost")
  narrow <- 2L + label + 4L * wide > print_width()
  line <- function(text, values) {
    if (!narrow) return(cat("  ", formatC(text, width = -label), values, "\n", sep = ""))
    values <- trimws(values)
    given <- which(nzchar(values))
    if (nzchar(text)) say("  ", text, ": ", toString(paste(heads[given], values[given])))
  }
  cat("<rot_ledger> ", ledger_verdict(x$verdict), "\n", sep = "")
  line("", formatC(heads, width = wide))
  for (i in seq_len(nrow(x))) {
    if (x$balance[i] %in% "energy") next
    line(names[i], show(c(x$before[i], x$after[i], x$supplied[i])))
    if (!is.na(x$about[i]) && !identical(x$about[i], x$about[i + 1L])) {
      cat("    about ", x$about[i], "\n", sep = "")
    }
  }
  if (length(at)) line(names[at], show(c(x$before[at], x$after[at], 0, x$dissipated[at])))
  lost <- startsWith(shown$term, "lost")
  for (i in seq_len(nrow(shown))) {
    value <- if (lost[i]) c("", "", "", show(shown$after[i])) else
      show(c(shown$before[i], shown$after[i]))
    line(paste0("  ", shown$term[i]), formatC(value, width = wide))
  }
  invisible(x)
}

ledger_verdict <- function(verdict) {
  if (all(verdict %in% "balanced")) "balanced" else
    if ("unbalanced" %in% verdict) "unbalanced" else "not known"
}

#' @rdname conserved
#' @export
conserved.rot_collision <- function(x, row = 1, about = NULL, ...) {
  call <- current_env()
  check_no_dots(...)
  collision <- check_collision(x, call)
  row <- check_number(row, "row", "1", call, lower = 1, upper = max(1, nrow(x)))
  conserved_table(draw_ledger(x, collision, floor(row), about, call)$statements)
}
