# Equations of motion of the user's own: columns and measures are the states of the scene, under
# their names.
equations_constraint <- function() {
  table_constraint(
    "equations",
    models = integrated_words(
      "equations", equations = "y' = f(t, y)",
      assumptions = "f depends on the time and the states alone",
      requires = "a right-hand side"
    ),
    title = function(run) paste("Equations of", and_words(shown_states(run$scene))),
    drawing = draw_equations,
    columns = "time_s", keys = "time_s", measures = list(), more_names = NULL,
    of_scene = equations_of_scene, fault = equations_fault,
    form = list(
      f = "function", start = "numbers", positions = "numbers?", start_s = "number",
      conserved = list(.optional = TRUE, .each = "function")
    ),
    texts = list(scene_equations = text_form(equations_arguments, scene_equations)),
    periods = function(scene, call) {
      abort_no_closed_form("period", "{.fn time_when} gives the times of a value of a state.", call)
    },
    stops = function(scene, call) {
      abort_no_closed_form("time of a stop", "{.fn trajectory} shows the motion.", call)
    },
    slopes = equations_slopes, time_scales = equations_time_scales, call_laws = call_equations,
    summary = function(x, run, call) {
      states <- names(run$scene$start)
      lapply(stats::setNames(states, paste0("final_", states)), function(name) last(x[[name]]))
    },
    balances = equations_balances,
    conserved = function(scene) {
      if (is.null(scene$conserved)) {
        why <- "the equations do not say: name quantities by `conserved` of scene_equations()"
        return(list(statement("energy", NA_character_, NA, why)))
      }
      lapply(names(scene$conserved), function(name) {
        statement(name, NA_character_, TRUE, "named with the equations")
      })
    },
    augment = function(x, run, edges, call) {
      rows <- unclass(x)[constraint_of(run$scene)$keys]
      rows <- lapply(rows, `[`, match(edges, x$time_s))
      Map(function(f, name) {
        vapply(seq_along(edges), function(i) {
          invariant_of_row(f, name, lapply(rows, `[`, i), call)
        }, double(1))
      }, run$scene$conserved, names(run$scene$conserved))
    },
    panels = list(),
    remedies = list(
      budget = "Raise {.arg max_steps}, ask for less accuracy, or shorten the time.",
      step = "The motion grows without bound there, or {.arg f} changes faster than time can be
              resolved."
    )
  )
}

shown_states <- function(scene) {
  states <- gsub("_", " ", without_unit(names(scene$start)))
  if (length(states) > 4L) c(states[1:3], paste(length(states) - 3L, "others")) else states
}

# The record for one scene. A damaged one is reported by the checks.
equations_of_scene <- function(scene, record) {
  if (!is.null(equations_fault(scene))) return(record)
  states <- names(.subset2(scene, "start"))
  units <- vapply(states, unit_of_name, "")
  record$columns <- record$keys <- c("time_s", states)
  record$measures <- Map(measure, units, states)
  names(record$measures) <- states
  record$named <- stats::setNames(states, paste0("y_", seq_along(states)))
  record$panels <- state_panels(states, units)
  record
}

equations_fault <- function(scene) {
  start <- if (is.list(scene)) .subset2(scene, "start")
  states <- names(start)
  sound <- is.double(start) && length(start) %in% seq_len(max_states) && is.character(states) &&
    !anyNA(states) && all(nzchar(states)) && !anyDuplicated(states) &&
    !any(states %in% reserved_states)
  conserved <- .subset2(as.list(scene), "conserved")
  named <- is.null(conserved) || (is.character(names(conserved)) && all(nzchar(names(conserved))))
  if (!sound) "start" else if (!named) "conserved"
}

equations_arguments <- function(x) {
  x <- unclass(x)[c("f", "start", "positions", "conserved", "start_s")]
  if (!is.null(x$positions)) x$positions <- names(x$start)[x$positions]
  x
}

# A panel for the states of each unit; pure numbers have one each.
state_panels <- function(states, units) {
  groups <- unname(split(states, factor(ifelse(units == "1", states, units), unique(
    ifelse(units == "1", states, units)
  ))))
  lapply(groups, function(of) {
    unit <- units[[of[1]]]
    bare <- gsub("_", " ", without_unit(of))
    label <- if (length(of) > 3L) "states" else paste(bare, collapse = ", ")
    panel(
      paste0(label, if (unit != "1") paste0(" (", unit, ")")),
      stats::setNames(if (length(of) > 1L) bare else "", of)
    )
  })
}

abort_no_closed_form <- function(what, remedy, call) {
  abort_rotdyn(c(
    paste0("No closed form of the ", what, " follows from equations of one's own."), i = remedy
  ), "model", call)
}

# The loop of a solver: the right-hand side, its integral, and the states back to it.
draw_equations <- function(scene) {
  d <- new_drawing()
  d$add(mark("fill", draw_box(-0.65, 0.3, 0.9, 0.6), "body"))
  d$add(mark("fill", draw_box(0.75, 0.3, 0.9, 0.6), "body"))
  d$add(mark("arrow", rbind(c(-0.2, 0.3), c(0.3, 0.3)), "speed"))
  back <- rbind(c(1.2, 0.3), c(1.5, 0.3), c(1.5, -0.5), c(-1.5, -0.5), c(-1.5, 0.3), c(-1.1, 0.3))
  d$add(mark("arrow", back, "speed"))
  d$say("f", -0.65, 0.3)
  d$say("integral()", 0.75, 0.3)
  d$say("dot(y)", 0.05, 0.5)
  d$say("y", 1.37, 0.5)
  d$key(quantity("f", "right-hand side f(t, y)", ""))
  d$key(quantity("integral()", "the integrator", ""))
  d$key(quantity("dot(y)", "rates of the states", "", "speed"))
  d$key(quantity("y", "states", "", "speed"))
  for (name in names(scene$start)) {
    d$key(quantity("", paste0(without_unit(name), " at start"), value_text(
      scene$start[[name]], sub("^1$", "", unit_of_name(name))
    )))
  }
  if (length(scene$conserved)) {
    d$key(quantity("", "conserved", toString(gsub("_", " ", names(scene$conserved)))))
  }
  d$done(c(-1.65, 1.65, -1.1, 1.1))
}

# ---- calls --------------------------------------------------------------------------------------

# The rates at rows, a column for each state.
equations_slopes <- function(columns, scene) {
  states <- names(scene$start)
  f <- function_of_states(scene$f, states)
  rows <- unname(as.list(columns[c("time_s", states)]))
  rates <- vapply(seq_along(rows[[1]]), function(i) {
    row <- stats::setNames(lapply(rows, `[`, i), c("time_s", states))
    as.double(do.call(f, row))
  }, double(length(states)))
  rates <- matrix(rates, nrow = length(states))
  stats::setNames(lapply(seq_along(states), function(k) rates[k, ]), states)
}

call_equations <- function(scene, call) {
  f <- function_of_states(scene$f, names(scene$start))
  row <- c(list(time_s = scene$start_s), as.list(scene$start))
  function() do.call(f, row)
}

# The times of the linear system at the start, by central differences; unknown where f has no values
# around it.
equations_time_scales <- function(scene, sizes, model) {
  states <- names(scene$start)
  rates <- function(y) {
    unlist(equations_slopes(c(list(time_s = scene$start_s), as.list(y)), scene), use.names = FALSE)
  }
  scale <- pmax(abs(scene$start), if (length(sizes) == length(states)) unname(sizes) else 0)
  scale[!is.finite(scale) | scale == 0] <- max(scale[is.finite(scale)], 1e-300)
  values <- tryCatch(suppressWarnings({
    derivative <- vapply(seq_along(states), function(k) {
      step <- replace(double(length(states)), k, 1e-5 * scale[k])
      (rates(scene$start + step) - rates(scene$start - step)) / (2e-5 * scale[k])
    }, double(length(states)))
    eigen(matrix(derivative, length(states)), only.values = TRUE)$values
  }), error = function(e) if (is_time_limit(e)) stop(e) else 0)
  fades <- max(0, -Re(values))
  list(
    breaks_s = double(), fades_s = if (fades > 0) 1 / fades else Inf,
    swing_rad_per_s = max(abs(Im(values))), drifts = TRUE
  )
}

# ---- what is conserved --------------------------------------------------------------------------

invariant_of_row <- function(f, name, row, call) {
  invariant_at(f, paste0("conserved$", name), row$time_s, unlist(row[names(row) != "time_s"]), call)
}

# What the errors explain: how far the quantity moves where each state is off by twice its error.
equations_balances <- function(x, run, call) {
  scene <- run$solved
  states <- names(scene$start)
  n <- length(x$time_s)
  lapply(names(scene$conserved), function(name) {
    unit <- unit_of_name(name)
    rows <- unclass(x)[c("time_s", states)]
    if (!n || anyNA(unlist(lapply(rows, `[`, c(1L, n))))) {
      return(no_balance(name, NA_character_, unit))
    }
    at <- function(i, state = NULL, by = 0) {
      row <- lapply(rows, `[`, i)
      if (!is.null(state)) row[[state]] <- row[[state]] + by
      invariant_of_row(scene$conserved[[name]], name, row, call)
    }
    value <- c(at(1L), at(n))
    moved <- vapply(states, function(state) {
      vapply(1:2, function(end) {
        i <- c(1L, n)[end]
        by <- 2 * run$info$errors[[state]] + .Machine$double.eps * abs(rows[[state]][i])
        max(abs(c(at(i, state, by), at(i, state, -by)) - value[end]))
      }, double(1))
    }, double(2))
    words <- gsub("_", " ", without_unit(name))
    change <- stats::setNames(
      c(value[2], -value[1]), c(paste(words, "at the end"), paste("less", words, "at the start"))
    )
    balance(
      name, NA_character_, unit, change, double(), double(),
      sum(moved) + 8 * .Machine$double.eps * sum(abs(value))
    )
  })
}
