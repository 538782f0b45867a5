# Constraints whose table in the core (src/core/engine/model.h) says all but words and pictures.

# The record of R/constraints.R. `models`: records of words, by the ids of the core's models; `...`:
# title, panels, drawing, summary, ...; `makers`: of these, what further constructors change.
table_constraint <- function(id, models, ..., makers = list()) {
  table <- core_table(id)
  state <- split(table$columns[!is.na(table$state)], table$state[!is.na(table$state)])
  record <- list(
    id = id,
    scene_class = paste0("rot_", names(table$makers)[1]),
    models = Map(table_model, id, names(models), models, USE.NAMES = FALSE),
    columns = c("time_s", table$index, table$columns[table$always]),
    more_names = if (!all(table$always)) function(scene) shown_names(id, scene),
    event_rows = if (table$event_rows) TRUE,
    keys = c("time_s", table$index, unlist(state[table$measures], use.names = FALSE)),
    index = table$index,
    rows_per_time = function(scene) .Call(ffi_scene_rows_per_time, id, scene),
    measures = lapply(state[table$measures], function(columns) {
      measure(table$units[match(columns[1], table$columns)], columns)
    }),
    time_scales = function(scene, sizes, model) {
      time_scales <- .Call(ffi_scene_time_scales, id, scene, as.double(sizes))
      inputs <- constraint_of(scene)$inputs
      times <- names(inputs)[vapply(inputs, function(input) input$form == "sorted", NA)]
      time_scales$breaks_s <- c(time_scales$breaks_s, as.double(unlist(unclass(scene)[times])))
      time_scales
    },
    call_laws = function(scene, call) call_table_laws(scene, call),
    summary = function(x, run, call) table_summary(unlist(state[table$measures]), x, run, call),
    balances = function(x, run, call) table_balances(id, table, x, run),
    conserved = function(scene) table_statements(id, table, scene),
    augment = function(x, run, edges, call) {
      flows <- table_flows(table, run, edges)$since
      if (length(flows)) flows <- sweep(flows, 2, flows[1, ])
      if (!is.null(flows)) as.list(as.data.frame(flows))
    }
  )
  own <- list(...)
  first <- made_by(table, names(table$makers)[1])
  record[names(first)] <- first
  record[names(own)] <- own
  record$makers <- Map(function(changes, constructor) {
    parts <- made_by(table, constructor)
    parts[names(changes)] <- changes
    parts
  }, makers, names(makers))
  if (length(makers)) names(record$makers) <- paste0("rot_", names(makers))
  record
}

# The parts of a record that follow from the inputs of a constructor.
made_by <- function(table, constructor) {
  maker <- table$makers[[constructor]]
  of_bodies <- c("body", "inertia", "changing", "bodies", "tensor")
  list(
    inputs = maker$inputs,
    derived = names(maker$derived),
    bodies = names(Filter(function(input) input$form %in% of_bodies, maker$inputs)),
    form = table_form(maker),
    texts = stats::setNames(list(table_text(maker, constructor)), constructor)
  )
}

# The columns that a scene has beside those of all scenes.
shown_names <- function(id, scene) {
  table <- core_table(id)
  table$columns[.Call(ffi_scene_shows, id, scene) & !table$always]
}

# The parts of a scene: its inputs, and what follows from them.
table_form <- function(maker) {
  forms <- Map(function(input) {
    optional <- !input$required && is.na(input$otherwise)
    of <- switch(input$form,
      body = body_form, torque = torque_form, tensor = tensor_form, torques = torques_form,
      laws = list(.each = torque_form), rotors = list(.each = rotor_form),
      resistance = resistance_form, resistances = list(.each = resistance_form),
      viscous = "numbers", force = list(.one_of = list("number", "function")),
      brakes = list(.each = c(brake_form, .optional = TRUE)),
      couplings = list(.each = coupling_form), inertia = list(.one_of = list(body_form, "number")),
      changing = list(.one_of = list(body_form, "number", inertia_knots_form)),
      vector_or_name = list(.one_of = list("text", "numbers:3")),
      bodies = list(.one_of = list(
        "numbers", list(.each = list(.one_of = list(body_form, "number")))
      ))
    )
    if (!is.null(of)) return(if (optional) c(of, .optional = TRUE) else of)
    paste0(input$form, if (optional) "?")
  }, maker$inputs)
  forms[names(maker$derived)] <- Map(function(name, n) {
    if (is.character(forms[[name]])) return(sub("?", "", forms[[name]], fixed = TRUE))
    # An input whose default follows is given.
    switch(as.character(n), `0` = "numbers", `1` = "number", paste0("numbers:", n))
  }, names(maker$derived), maker$derived)
  forms
}

table_model <- function(id, model, words) {
  c(list(id = model), words, list(
    adapts = if (grepl("_(rk8pd|radau)$", model)) TRUE,
    ran_as = function(info) {
      if (info$method %in% c("rk8pd", "radau")) paste0(id, "_", info$method) else model
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked, flows = FALSE,
                   event_rows = FALSE) {
      run_table_model(
        id, model, scene, time_s, c(accuracy, max_steps, asked, 0, flows, event_rows, 0), call,
        looks = !isFALSE(words$adapts)
      )
    },
    run_with_step = if (isFALSE(words$adapts)) {
      function(scene, time_s, step_s, max_steps, call) {
        control <- c(1, max_steps, TRUE, 0, TRUE, FALSE, step_s)
        run_table_model(id, model, scene, time_s, control, call, looks = FALSE)
      }
    }
  ))
}

# `control`: see ffi_scene_run(). `looks`: changes of laws are looked for.
run_table_model <- function(id, model, scene, time_s, control, call, looks) {
  laws <- table_laws(scene, call)
  looks <- looks && length(laws)
  solved <- scene
  if (looks) {
    control[4] <- resolution_of(scene)
    solved <- with_found_breaks(scene, range(scene$start_s, time_s), call)
    laws <- table_laws(solved, call)
  }
  run <- function() {
    .Call(ffi_scene_run, id, solved, model, time_s, control, laws, progress_bar("integrating"))
  }
  constraint <- constraint_of(scene)
  calls_rates <- length(laws) &&
    any(vapply(constraint$inputs, function(input) input$form == "rates", NA))
  result <- if (calls_rates) hear_rates(run(), call) else run()
  result$info$remedy <- constraint$remedies[[result$info$kind]]
  if (!is.null(constraint$named)) result <- with_own_names(result, constraint$named)
  if (looks && !(calls_rates && result$info$method == "radau")) {
    result$info$resolution <- control[4]
  }
  between <- core_table(id)$between
  if (!is.null(between)) result$events <- with_places(result$events, core_table(id)$index, between)
  result
}

# Columns and measures under the names that the scene has for them.
with_own_names <- function(result, named) {
  own <- function(x) {
    at <- match(names(x), names(named))
    names(x)[!is.na(at)] <- named[at[!is.na(at)]]
    x
  }
  result$columns <- own(result$columns)
  result$info[c("errors", "sizes")] <- lapply(result$info[c("errors", "sizes")], own)
  result
}

# Where events happen, in words: of a constraint with several bodies, or what couples them.
with_places <- function(events, rows_per_time, between) {
  place <- as.integer(events$place)
  list(
    time_s = as.double(events$time_s), event = as.character(events$event),
    where = paste(ifelse(place > 0L, rows_per_time, between), abs(place), recycle0 = TRUE)
  )
}

# Words of the two models that integrate; `...`: those that both share.
integrated_words <- function(id, ..., fixed = TRUE) {
  adaptive <- stats::setNames(list(
    list(
      ..., limits = "not stiff: a step is at most about 6 times the shortest decay",
      source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library"
    ),
    list(
      ..., limits = "each step solves a system of equations",
      source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)"
    )
  ), paste0(id, c("_rk8pd", "_radau")))
  words <- list(...)
  words$requires <- NULL
  c(adaptive, if (fixed) do.call(fixed_words, c(id, words)))
}

# Words of the models with steps of fixed length, given the equations and the assumptions.
fixed_words <- function(id, ...) {
  steps <- function(limits, source, ...) {
    list(
      ..., limits = limits, requires = "to be named", source = source, adapts = FALSE,
      loses = "Its steps are of fixed length: {.arg step_s} makes them shorter."
    )
  }
  stats::setNames(list(
    steps("order 1; the energy of a swing grows without bound",
          "Hairer, Norsett and Wanner 1993, section I.7", ...),
    steps("order 1; the energy of a swing without friction stays within a bound",
          "Hairer, Lubich and Wanner 2006, section I.1", ...),
    steps("order 4; the energy of a swing drifts in proportion to time",
          "Hairer, Norsett and Wanner 1993, section II.1", ...)
  ), paste0(id, c("_euler", "_semi_implicit", "_rk4")))
}

# The largest rate between the rows, too, of one body; the last values.
table_summary <- function(state, x, run, call) {
  extremes <- if ("omega_rad_per_s" %in% state && is.null(constraint_of(run$scene)$index)) {
    found <- largest_values(x, run, "omega_rad_per_s", call)
    list(
      max_omega_rad_per_s = found$value[["omega_rad_per_s"]] %||% NA_real_,
      max_omega_time_s = found$time_s[["omega_rad_per_s"]] %||% NA_real_
    )
  }
  c(extremes, lapply(
    stats::setNames(state, paste0("final_", state)), function(column) last(x[[column]])
  ))
}

# How a scene is written: its inputs, without those whose default is another input of this value,
# and without infinite defaults, which a text does not have.
table_text <- function(maker, constructor) {
  constructor <- get(constructor, mode = "function")
  given <- formals(constructor)[names(maker$inputs)]
  follows <- Filter(is.name, given)
  follows <- Filter(nzchar, vapply(follows, as.character, ""))
  text_form(function(x) {
    x <- unclass(x)[names(maker$inputs)]
    same <- vapply(names(follows), function(name) identical(x[[name]], x[[follows[[name]]]]), NA)
    infinite <- vapply(names(x), function(name) {
      length(x[[name]]) == 1L && is.numeric(x[[name]]) && is.infinite(x[[name]]) &&
        identical(x[[name]], maker$inputs[[name]]$otherwise)
    }, NA)
    x <- x[setdiff(names(x)[!infinite], names(follows)[same])]
    if (!is.null(x$axis) && identical(x$axis, eval(given$axis))) x$axis <- NULL
    x
  }, constructor)
}

# ---- balances -----------------------------------------------------------------------------------

# list(since, errors): matrices with a row for each time and a column for each flow, since the
# scene's start, and the errors of these; NULL where the motion could not be computed again.
table_flows <- function(table, run, time_s) {
  known <- run$ledger
  columns <- c("time_s", table$flows, paste0(table$flows, "_error"))
  # A version before may have recorded others.
  if (!all(columns %in% colnames(known)) || !all(time_s %in% known[, "time_s"])) {
    times <- sort(unique(time_s))
    again <- record_of(run)$run(
      run$solved, times, run$accuracy, run$max_steps + length(times), run$call, TRUE, TRUE
    )
    if (again$info$kind != "none") return(NULL)
    known <- again$ledger
  }
  rows <- known[match(time_s, known[, "time_s"]), , drop = FALSE]
  list(
    since = rows[, table$flows, drop = FALSE],
    errors = rows[, paste0(table$flows, "_error"), drop = FALSE]
  )
}

# The cells of the rows at one time, of a list of columns: by column, each with its copies; NULL
# where rows are missing.
table_cells <- function(table, x, time_s, rows_per_time) {
  rows <- which(x$time_s == time_s)
  rows <- if (is.null(table$index)) rows[1] else {
    rows[match(seq_len(rows_per_time), x[[table$index]][rows])]
  }
  if (anyNA(rows)) return(NULL)
  unlist(lapply(table$columns, function(column) {
    as.double(x[[column]] %||% rep(NA_real_, length(x$time_s)))[rows]
  }), use.names = FALSE)
}

table_balances <- function(id, table, x, run) {
  scene <- run$solved
  x <- unclass(x) # columns of a tibble take 5 us each
  of <- .Call(ffi_scene_conserved, id, scene)
  balanced <- seq_along(table$balances)
  none <- Map(
    no_balance, table$balances, of$about[balanced], of$unit[balanced], USE.NAMES = FALSE
  )
  if (!length(x$time_s)) return(none)
  ends <- as.double(x$time_s[c(1L, length(x$time_s))])
  rows_per_time <- .Call(ffi_scene_rows_per_time, id, scene)
  first <- table_cells(table, x, ends[1], rows_per_time)
  final <- table_cells(table, x, ends[2], rows_per_time)
  flows <- table_flows(table, run, ends)
  if (is.null(first) || is.null(final) || is.null(flows)) return(none)
  terms <- .Call(
    ffi_scene_audit, id, scene, ends, first, final, flows$since[2, ] - flows$since[1, ],
    flows$errors[2, ], as.double(run$info$errors)
  )
  lapply(balanced, function(k) {
    role <- function(which) {
      is <- terms$balance == k & terms$role == which & !is.na(terms$words)
      stats::setNames(terms$value[is], terms$words[is])
    }
    balance(
      table$balances[k], of$about[k], of$unit[k], role(3L), role(1L), role(2L), terms$explained[k]
    )
  })
}

table_statements <- function(id, table, scene) {
  of <- lapply(.Call(ffi_scene_conserved, id, scene), `[`, seq_along(table$kept))
  Map(statement, table$kept, of$about, of$conserved, of$why, USE.NAMES = FALSE)
}
