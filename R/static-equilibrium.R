#' Static equilibrium: the reactions of supports
#'
#' Finds the forces and couples of the supports that keep a loaded body at rest, in a plane or in
#' space; says whether they are determined, and how far the body is from tipping and sliding.
#' \deqn{\sum \vec F = 0,\qquad \sum \vec r \times \vec F + \sum \vec C = 0}{
#'   sum F = 0,  sum r x F + sum C = 0}
#'
#' **Determinate or not.** A plane has 3 equations, space 6. The rank of the equations follows from
#' their singular values, with forces in units of the largest load and lengths in units of the
#' body's extent: those below `rank_tolerance` times the largest count as 0.
#' * unknowns - rank = how many times the body is **redundant**: so many reactions could be chosen
#'   freely. Those that equilibrium does not determine are given as the solution of **minimum norm**
#'   (couples divided by the extent), which is a convention; real ones depend on stiffness.
#'   `reactions()` has what is determined nevertheless, and the range of the rest.
#' * equations - rank = **free motions** that no support prevents, as in a mechanism. The body is at
#'   rest only if the loads do no work on them.
#'
#' **Supports that only push or pull.** Surfaces only push and hold with friction, cables only pull.
#' The verdict is `"rests"` if any such reactions exist; `"slides"` if they would with unlimited
#' friction; `"tips"` if they would if all supports held both ways; `"moves"` if a free motion is
#' driven. Where the body rests, the table has such reactions: pushes are at least 0, friction is
#' within its circular cone, and equilibrium holds to rounding. Where they are not determined, they
#' are those of minimum norm among these. Where the body does not rest, the table has the reactions
#' that would be needed, and `motion` is the motion that begins. Ranges and limits are a linear
#' program, with a relative error of some 1e-10, with friction in space 1e-8.
#'
#' `load_factors()`: by which factors each load can be multiplied, the others unchanged, before the
#' body tips, slides or moves: the margin of a load of 1 is how far the factors are from 1.
#'
#' **Errors.** Reactions are refined with residuals of twice the precision. The error of each is
#' what half an ulp of each number given can change, by the inverse of the equations; it grows as
#' the structure comes near to a mechanism.
#'
#' @param loads Loads: what [forces()] takes.
#' @param supports A list of [supports]; names replace theirs.
#' @param ... Not used: an unknown argument is an error.
#' @param outline_m The body's outline for the drawing: a matrix of points by rows. By default the
#'   lines that join the points.
#' @param rank_tolerance Singular values below this share of the largest count as 0.
#' @param name Name of the structure.
#' @param x,object What `static_equilibrium()` returned.
#' @return `static_equilibrium()`: a tibble of class `rot_equilibrium` with a row for each support:
#'   the force and the couple *on the body*, `normal_x`, `normal_y` and in space `normal_z`, the
#'   unit vector along which a surface or roller pushes, and
#'   `r describe_columns(equilibrium_columns)`
#'   `normal_n` is the push of a surface or roller and the pull of a cable or rod; `friction_n` and
#'   what follows from it are NA without friction. With other rows, or without one of the columns,
#'   it is a plain tibble.
#'
#'   `summary()` and `glance()`: one row with
#'   `r describe_columns(equilibrium_summary_columns)`
#'   The margins are of the determined reactions.
#'
#'   `reactions()`: a row for each unknown, with
#'   `r describe_columns(reaction_columns, c(error = "bound of its error, in the same unit"))`
#'   The range has one value where the reaction is determined; it is NaN where the body does not
#'   rest.
#'
#'   `load_factors()`: a row for each name of a load, with
#'   `r describe_columns(load_factor_columns)`
#'   NA where no factor lets the body rest.
#' @section Errors: those of [forces()] and [supports]; `rotdyn_error_range` for reactions beyond
#'   double precision.
#' @source Hibbeler, Engineering Mechanics: Statics, 14th ed. (2016), chapter 5. Golub and Van Loan,
#'   Matrix Computations, 4th ed. (2013), section 5.5: singular values and minimum norm.
#' @seealso [autoplot.rot_equilibrium()] for the free-body drawing; `vignette("equilibrium")`.
#' @concept statics
#' @concept equilibrium
#' @concept free body diagram
#' @concept ladder
#' @concept seesaw
#' @concept lever
#' @concept support forces
#' @examples
#' # A beam of 20 kg and 4 m on two supports, with a box of 50 kg at 1 m.
#' static_equilibrium(
#'   forces(load_weight(20, c(2, 0), name = "beam"), load_weight(50, c(1, 0), name = "box")),
#'   list(left = support_pin(c(0, 0)), right = support_roller(c(4, 0)))
#' )
#'
#' # A ladder of 5 m at 60 degrees, against a smooth wall, on a floor with friction.
#' top <- 5 * c(cospi(1 / 3), sinpi(1 / 3))
#' ladder <- static_equilibrium(
#'   forces(load_weight(12, top / 2, name = "ladder"), load_weight(70, 0.8 * top, name = "man")),
#'   list(
#'     floor = support_surface(c(0, 0), friction = 0.5),
#'     wall = support_surface(top, normal = c(-1, 0))
#'   )
#' )
#' ladder
#' summary(ladder)
#' load_factors(ladder)
#'
#' # A door on two hinges: how they share its weight is not determined.
#' door <- static_equilibrium(
#'   load_weight(25, c(0.4, 0, 1)),
#'   list(bottom = support_pin(c(0, 0, 0.2)), top = support_pin(c(0, 0, 1.8)))
#' )
#' reactions(door)
#' @export
static_equilibrium <- function(loads, supports, ..., outline_m = NULL, rank_tolerance = 1e-12,
                               name = "structure") {
  call <- check_no_dots(...)
  check_supplied(c("loads", "supports"), call)
  loads <- as_forces(loads, "loads", call)
  plane <- is_plane(loads)
  supports <- check_supports(supports, plane, call)
  tolerance <- check_number(
    rank_tolerance, "rank_tolerance", "1", call, lower = 0, upper = 0.1, open = TRUE
  )
  name <- check_name(name, "name", call)
  outline <- check_outline(outline_m, plane, call)
  check_default_normals(supports, loads, outline$points, call)
  structure <- structure_of(loads, supports, tolerance)
  new_equilibrium(structure, outline, name, call)
}

#' @rdname static_equilibrium
#' @export
reactions <- function(x, ...) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  rest <- check_equilibrium(x, "x", call)
  s <- rest$structure
  new_table(list(
    support = vapply(s$supports, `[[`, "", "name")[s$owner], component = s$component,
    value = rest$reaction, unit = ifelse(s$problem$is_couple > 0, "N m", "N"),
    determined = rest$determined, lowest = rest$lowest, highest = rest$highest, error = rest$error
  ), nrow = length(s$owner))
}

#' @rdname static_equilibrium
#' @export
load_factors <- function(x, ...) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  rest <- check_equilibrium(x, "x", call)
  s <- rest$structure
  names <- unique(s$loads$load)
  rows <- lapply(names, function(name) {
    chosen <- as.double(s$loads$load == name)
    out <- .Call(ffi_statics_factors, s$problem, chosen)
    check_statics_status(out[1], call)
    limits <- out[2:3]
    beyond <- vapply(1:2, function(side) verdict_beyond(s, chosen, limits[side], side, call), "")
    data.frame(
      load = name, lowest_factor = limits[1], highest_factor = limits[2], below = beyond[1],
      above = beyond[2]
    )
  })
  empty <- data.frame(
    load = character(), lowest_factor = double(), highest_factor = double(), below = character(),
    above = character()
  )
  tibble::as_tibble(do.call(rbind, c(list(empty), rows)))
}

#' @export
`[.rot_equilibrium` <- function(x, ...) reconstruct_whole(NextMethod(), x, "rest")

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_equilibrium <- function(data, template) {
  reconstruct_whole(data, template, "rest")
}

#' @rdname static_equilibrium
#' @param ... Not used: an unknown argument is an error.
#' @export
summary.rot_equilibrium <- function(object, ...) {
  call <- check_no_dots(...)
  rest <- check_equilibrium(object, "object", call)
  state <- state_of(rest)
  new_table(c(
    list(verdict = state$verdict, unknowns = length(rest$reaction),
         rank = rest$rank, redundant = state$redundant, free_motions = state$free),
    list(condition_number = state$condition), margins_of(rest), list(
      motion = motion_text(rest), residual_force_n = rest$residual_force,
      residual_torque_n_m = rest$residual_torque
    )
  ), nrow = 1L)
}

#' @rdname static_equilibrium
#' @export
glance.rot_equilibrium <- function(x, ...) {
  check_no_dots(...)
  summary(x)
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_equilibrium <- function(x, ...) {
  rest <- attr(x, "rest")
  if (is.null(rest) || !is.null(.Call(ffi_form_fault, rest, rest_form))) {
    return(c(Equilibrium = "damaged"))
  }
  state <- state_of(rest)
  counts <- sprintf("%d unknowns, %d equations", length(rest$reaction), rest$equations)
  open <- if (any(!rest$determined)) {
    how <- if (rest$projected) "minimum norm among those that only push" else "minimum norm"
    paste0(listed(open_reactions(rest)), " (given: ", how, ")")
  }
  escape_controls(c(
    Equilibrium = paste0(rest$name, " ", verdict_words[[state$verdict]]),
    Determinacy = paste0(
      if (state$redundant) paste("redundant", times_word(state$redundant)) else
        if (state$free) "movable" else "determinate", ": ", counts
    ),
    Normals = normals_text(rest$structure$supports),
    "Not determined" = open,
    "Free motion" = if (state$free && state$verdict == "rests") {
      paste0(motion_text(rest), if (state$free > 1) paste0(" (one of ", state$free, ")"))
    },
    Motion = if (state$verdict != "rests") motion_text(rest),
    Margins = if (state$verdict == "rests") margins_text(margins_of(rest))
  ))
}

# Unit vectors along which surfaces and rollers push.
normals_of <- function(supports) {
  vapply(supports, function(one) {
    if (!one$kind %in% c("surface", "roller")) return(rep(NA_real_, 3L))
    normal <- c(one$normal / max(abs(one$normal)), 0)[1:3]
    normal / length_of(normal)
  }, double(3))
}

normals_text <- function(supports) {
  n <- normals_of(supports)
  directed <- which(!is.na(n[1, ]))
  if (!length(directed)) return(NULL)
  listed(vapply(directed, function(i) {
    paste0(supports[[i]]$name, " ", normal_text(n[, i], length(supports[[i]]$at_m)))
  }, ""))
}

normal_text <- function(normal, size) {
  paste0("(", paste(format_si(signif(normal[seq_len(size)], 3) + 0), collapse = ", "), ")")
}

margins_text <- function(margins) {
  said <- c(
    if (is.finite(margins$tipping_margin_n)) {
      paste0("least push or pull ", format_si(signif(margins$tipping_margin_n, 4)), " N")
    },
    if (is.finite(margins$sliding_margin)) {
      paste0("friction left ", format_si(signif(100 * margins$sliding_margin, 3)), " %")
    }
  )
  if (length(said)) paste(said, collapse = ", ")
}

# ---- the problem in numbers ---------------------------------------------------------------------

structure_of <- function(loads, supports, tolerance) {
  parts <- lapply(supports, reactions_of)
  all <- unlist(parts, recursive = FALSE)
  owner <- rep(seq_along(parts), lengths(parts))
  first <- cumsum(c(0, lengths(parts)))[seq_along(parts)]
  rough <- vapply(supports, function(one) one$kind == "surface" && one$friction > 0, NA)
  normals <- lapply(supports[rough], function(one) {
    normal <- c(one$normal, 0)[1:3]
    normal <- normal / max(abs(normal))
    normal / sqrt(sum(normal^2))
  })
  system <- system_of(loads)
  numbers <- function(name) as.double(unlist(lapply(all, `[[`, name)))
  problem <- list(
    plane = as.double(is_plane(loads)), at = numbers("at"), from = numbers("from"),
    to = numbers("to"), is_couple = numbers("couple"), one_sided = numbers("one_sided"),
    first = as.double(first[rough]), normal = as.double(unlist(normals)),
    friction = as.double(vapply(supports[rough], `[[`, 0, "friction")),
    load_at = as.double(system$at), load_force = as.double(system$force),
    load_couple = as.double(system$couple), rank_tolerance = tolerance
  )
  list(
    loads = loads, supports = supports, owner = as.double(owner),
    component = as.character(unlist(lapply(all, `[[`, "component"))), problem = problem
  )
}

solve_statics <- function(structure, call) {
  out <- .Call(ffi_statics_solve, structure$problem)
  state <- out$state
  check_statics_status(state[1], call)
  list(
    reaction = out$reaction, error = out$error, determined = out$determined > 0,
    lowest = out$lowest, highest = out$highest, sigma = out$sigma, about_m = out$about,
    velocity = out$velocity, omega = out$omega, equations = as.integer(state[2]),
    rank = as.integer(state[3]), driven = state[4] > 0, rests = state[5] > 0,
    sticks = state[6] > 0, projected = state[7] > 0, residual_force = state[8],
    residual_torque = state[9]
  )
}

check_statics_status <- function(status, call) {
  if (status == 0) return(invisible())
  abort_rotdyn(c(
    "The reactions could not be found.",
    x = "The search for reactions that only push did not end, or a number is not finite."
  ), "range", call)
}

# `rest`: what the verbs read.
new_equilibrium <- function(structure, outline, name, call) {
  rest <- solve_statics(structure, call)
  if (!all(is.finite(rest$reaction))) abort_beyond("A reaction", call)
  rest <- c(rest, list(structure = structure, outline = outline, name = name))
  new_table(
    support_rows(rest), nrow = length(structure$supports), rest = rest, class = "rot_equilibrium"
  )
}

check_equilibrium <- function(x, arg, call) {
  check_class(
    x, "rot_equilibrium", arg, "{.fn static_equilibrium} makes one.", call
  )
  rest <- check_form(attr(x, "rest"), rest_form, arg, "result of static_equilibrium()", call)
  # The problem in numbers must be that of the loads and supports: it is made anew and compared.
  s <- rest$structure
  whole <- all(vapply(s$supports, support_is_whole, NA)) && tryCatch(
    identical(structure_of(s$loads, s$supports, s$problem$rank_tolerance), s),
    error = function(e) FALSE
  )
  if (!whole || length(rest$reaction) != length(s$owner)) {
    abort_form("structure", arg, "result of static_equilibrium()", call)
  }
  rest
}

# ---- what it means ------------------------------------------------------------------------------

verdict_words <- c(
  rests = "rests", slides = "slides: more friction is needed",
  tips = "tips: a support would have to pull, or a cable to push",
  moves = "moves: no support prevents it"
)

times_word <- function(n) if (n == 1) "once" else paste(n, "times")

listed <- function(x, maximum = 6L) {
  if (length(x) > maximum) x <- c(utils::head(x, maximum), paste(length(x) - maximum, "more"))
  paste(x, collapse = ", ")
}

rest_verdict <- function(rest) {
  if (rest$driven) "moves" else if (rest$rests) "rests" else if (rest$sticks) "slides" else "tips"
}

state_of <- function(rest) {
  nonzero <- utils::tail(rest$sigma, rest$rank)
  list(
    verdict = rest_verdict(rest), redundant = length(rest$reaction) - rest$rank,
    free = rest$equations - rest$rank,
    condition = if (length(nonzero)) max(nonzero) / min(nonzero) else NA_real_
  )
}

open_reactions <- function(rest) {
  s <- rest$structure
  names <- vapply(s$supports, `[[`, "", "name")[s$owner]
  paste(names, s$component)[!rest$determined]
}

# Unit vectors of the reactions, by columns.
reaction_directions <- function(problem) {
  along <- matrix(problem$to, 3L) - matrix(problem$from, 3L)
  apply(along, 2L, function(v) v / max(abs(v)) / sqrt(sum((v / max(abs(v)))^2)))
}

support_rows <- function(rest) {
  s <- rest$structure
  plane <- s$problem$plane > 0
  n <- length(s$supports)
  k <- length(s$owner)
  force <- couple <- matrix(0, 3L, n)
  if (k) {
    vectors <- matrix(reaction_directions(s$problem), 3L) * rep(rest$reaction, each = 3L)
    for (j in seq_len(k)) {
      i <- s$owner[j]
      if (s$problem$is_couple[j] > 0) couple[, i] <- couple[, i] + vectors[, j] else
        force[, i] <- force[, i] + vectors[, j]
    }
  }
  worst <- function(is_couple) vapply(seq_len(n), function(i) {
    max(0, rest$error[s$owner == i & (s$problem$is_couple > 0) == is_couple])
  }, 0)
  contact <- contacts_of(rest, force)
  at <- vapply(s$supports, function(one) c(one$at_m, 0)[1:3], numeric(3))
  at <- matrix(at, 3L)
  keep <- seq_len(3L - plane)
  out <- list(
    support = vapply(s$supports, `[[`, "", "name"), kind = vapply(s$supports, `[[`, "", "kind")
  )
  out[point_axes(plane)] <- lapply(keep, function(j) at[j, ])
  out[force_columns(plane)] <- lapply(keep, function(j) force[j, ])
  out[couple_columns(plane)] <- if (plane) list(couple[3, ]) else
    lapply(1:3, function(j) couple[j, ])
  normal <- matrix(normals_of(s$supports), 3L)
  c(out, list(
    force_n = apply(force, 2L, length_of), normal_n = contact$normal,
    friction_n = contact$friction, friction_needed = contact$needed,
    sliding_margin = contact$margin,
    determined = vapply(seq_len(n), function(i) all(rest$determined[s$owner == i]), NA),
    error_n = worst(FALSE), error_n_m = worst(TRUE), state = contact$state
  ), stats::setNames(lapply(keep, function(j) normal[j, ]), normal_columns(plane)))
}

# Push and friction of each support, and whether it can bear them.
contacts_of <- function(rest, force) {
  s <- rest$structure
  n <- length(s$supports)
  blank <- rep(NA_real_, n)
  out <- list(
    normal = blank, friction = blank, needed = blank, margin = blank, state = rep("holds", n)
  )
  for (i in seq_len(n)) {
    one <- s$supports[[i]]
    mine <- s$owner == i
    slack <- sum(rest$error[mine])
    if (one$kind %in% c("cable", "rod", "roller") ||
      (one$kind == "surface" && one$friction == 0)) {
      out$normal[i] <- rest$reaction[mine]
      if (one$kind %in% c("cable", "surface") && out$normal[i] < -slack) {
        out$state[i] <- if (one$kind == "cable") "slack" else "lifts"
      }
      next
    }
    if (one$kind != "surface") next
    unit <- c(one$normal, 0)[1:3]
    unit <- unit / max(abs(unit))
    unit <- unit / sqrt(sum(unit^2))
    push <- sum(force[, i] * unit)
    tangential <- length_of(force[, i] - push * unit)
    if (tangential <= slack) tangential <- 0
    if (rest$rests) push <- max(push, 0)
    out$normal[i] <- push
    out$friction[i] <- tangential
    out$needed[i] <- if (tangential == 0) 0 else if (push > slack) tangential / push else Inf
    out$margin[i] <- if (tangential == 0) 1 else if (one$friction == Inf && push >= -slack) 1 else
      if (push > slack) 1 - out$needed[i] / one$friction else -Inf
    if (rest$rests) { # at the limit within the error
      out$needed[i] <- min(out$needed[i], one$friction)
      out$margin[i] <- max(out$margin[i], 0)
    }
    if (push < -slack) {
      out$state[i] <- "lifts"
    } else if (
      one$friction < Inf && tangential > one$friction * push + (1 + one$friction) * slack
    ) {
      out$state[i] <- "slides"
    }
  }
  if (rest$rests) out$state[] <- "holds"
  out
}

margins_of <- function(rest) {
  s <- rest$structure
  rows <- support_rows(rest)
  pushes <- vapply(s$supports, function(one) one$kind %in% c("surface", "cable"), NA)
  minimum <- function(x) if (length(x)) min(x) else NA_real_
  known <- rows$determined & pushes
  list(
    tipping_margin_n = minimum(rows$normal_n[known]),
    sliding_margin = minimum(rows$sliding_margin[known & !is.na(rows$sliding_margin)])
  )
}

# The motion that begins, or that is free: where it turns, which way.
motion_text <- function(rest) {
  v <- rest$velocity
  w <- rest$omega
  if (all(v == 0) && all(w == 0)) return(NA_character_)
  plane <- rest$structure$problem$plane > 0
  said <- function(x) {
    x <- signif(x, 4)
    if (plane) x <- x[1:2]
    paste0("(", paste(format_si(x + 0), collapse = ", "), ")")
  }
  speed <- length_of(w)
  if (speed == 0) return(paste("translation along", said(v / length_of(v))))
  u <- w / speed
  along <- sum(v * u) / speed
  arm <- c(u[2] * v[3] - u[3] * v[2], u[3] * v[1] - u[1] * v[3], u[1] * v[2] - u[2] * v[1]) / speed
  arm[abs(arm) < 1e-9 * length_of(c(arm, rest$about_m))] <- 0
  at <- said(rest$about_m + arm)
  if (plane) {
    return(paste0(
      "rotation about ", at, " m, ", if (w[3] > 0) "counter-clockwise" else "clockwise"
    ))
  }
  turning <- paste0("rotation about the axis through ", at, " m along ", said(u))
  if (abs(along) <= 1e-9 * length_of(v) / speed) return(turning)
  paste0(turning, ", advancing ", format_si(signif(along, 4)), " m/rad")
}

# What happens a little beyond a limit: further on where the search has no answer so close to it.
verdict_beyond <- function(structure, chosen, limit, side, call, step = 1e-6) {
  if (!is.finite(limit)) return(NA_character_)
  sign <- if (side == 1L) -1 else 1
  beyond <- limit + sign * step * max(abs(limit), 1)
  factor <- rep(ifelse(chosen > 0, beyond, 1), each = 3L)
  moved <- structure
  moved$problem$load_force <- structure$problem$load_force * factor
  moved$problem$load_couple <- structure$problem$load_couple * factor
  tryCatch(rest_verdict(solve_statics(moved, call)), rotdyn_error_range = function(e) {
    if (step > 1e-3) rlang::cnd_signal(e)
    verdict_beyond(structure, chosen, limit, side, call, 10 * step)
  })
}

check_outline <- function(outline_m, plane, call) {
  if (is.null(outline_m)) return(list())
  if (is.data.frame(outline_m)) outline_m <- as.matrix(outline_m)
  size <- if (plane) 2L else 3L
  if (!is.matrix(outline_m) || !is_number(outline_m) || ncol(outline_m) != size) {
    abort_rotdyn(c(
      "{.arg outline_m} must be a matrix of points with {size} columns.",
      x = "It is {describe_value(outline_m)}."
    ), "type", call)
  }
  broken <- rowSums(is.na(outline_m)) == size
  check_finite(as.double(outline_m[!broken, ]), "outline_m", "m", call)
  storage.mode(outline_m) <- "double"
  list(points = unname(outline_m))
}
