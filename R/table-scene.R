# Scenes that are the list of their inputs, checked by the table of their constraint in the core.

core_tables <- new.env()

# The table of a constraint, see src/glue/scene.c.
core_table <- function(id) {
  if (is.null(core_tables[[id]])) core_tables[[id]] <- .Call(ffi_scene_table, id)
  core_tables[[id]]
}

# The columns of a motion; `more`: those that effects add.
columns_of_motion <- function(id, more = FALSE) {
  table <- core_table(id)
  if (more) return(table$columns[!table$always])
  c("time_s", table$index, table$columns[table$always], if (table$event_rows) "event")
}

# The scene that a constructor describes, from the environment of its arguments.
scene_of_inputs <- function(id, call, constructor = paste0("scene_", id)) {
  form <- registry[[paste0("rot_", constructor)]]$form
  scene <- .Call(ffi_scene_describe, constructor, form, call)
  if (!is.null(scene)) return(scene)
  inputs <- core_table(id)$makers[[constructor]]$inputs
  check_supplied(names(inputs)[vapply(inputs, `[[`, NA, "required")], call)
  scene <- Map(
    function(input, name) check_input(get(name, envir = call), name, input, call), inputs,
    names(inputs)
  )
  finish_scene(id, scene, call, constructor)
}

# The scene of checked inputs, with what follows from them.
finish_scene <- function(id, scene, call, constructor = paste0("scene_", id)) {
  makers <- core_table(id)$makers
  inputs <- makers[[constructor]]$inputs
  class(scene) <- unique(c(paste0("rot_", c(constructor, names(makers)[1])), "rot_scene"))
  follows <- .Call(ffi_scene_derived, id, scene)
  if (is.character(follows)) {
    law <- inherits(scene[[follows[1]]], "rot_torque")
    abort_rotdyn(c(
      "{.arg {follows[1]}} {follows[2]}.",
      x = if (law) "It is {describe_torque(scene[[follows[1]]])}."
    ), if (law) "torque" else "value", call)
  }
  scene[names(follows)] <- follows
  sound_scene(scene, call)
}

# One argument as the core takes it. The core's check is the last word; this one takes units, and
# says what is wrong as other constructors do.
check_input <- function(x, name, input, call) {
  choice <- input$form == "text" && !is.null(input$options)
  if (is.null(x) && !input$required && !choice) return(NULL)
  if (input$form == "body") return(check_body(x, call, name))
  if (input$form %in% c("inertia", "changing")) return(check_moment(x, name, input, call))
  if (input$form == "resistance") return(check_resistance(x, input$options, call))
  if (input$form == "viscous") return(viscous_of_each(x, NULL, call))
  if (input$form == "force") return(check_force(x, name, input, call))
  if (input$form == "vector_or_name") return(check_named_vector(x, name, input, call))
  if (input$form == "torque") return(check_torque(x, name, call))
  if (input$form == "laws") return(check_laws(x, name, call))
  if (input$form == "function") return(check_law(x, name, input, call))
  if (!is.null(input$options)) {
    return(if (identical(x, input$options)) x[1] else check_string(x, name, input$options, call))
  }
  bound <- function(x) if (abs(x) == .Machine$double.xmax) sign(x) * Inf else x
  low <- bound(input$low)
  high <- bound(input$high)
  if (!input$many) {
    if (input$limit && (identical(x, Inf) || identical(x, input$otherwise))) return(x)
    return(check_number(x, name, input$unit, call, low, high, input$above))
  }
  x <- check_finite(x, name, input$unit, call)
  if (input$form == "sorted") return(sort(unique(x)))
  outside <- which(x < low | x > high | (input$above & x == low))
  if (length(outside)) {
    abort_domain(x[outside[1]], name, input$unit, call, low, high, input$above, outside[1])
  }
  x
}

# A body, its moment of inertia, or how that changes.
check_moment <- function(x, name, input, call) {
  if (inherits(x, "rot_body")) return(check_body(x, call, name))
  if (is.numeric(x) || inherits(x, "rot_measured")) {
    return(check_number(x, name, input$unit, call, input$low, open = input$above))
  }
  if (input$form == "changing" && inherits(x, "rot_inertia_knots")) {
    return(check_form(x, inertia_knots_form, name, "change of inertia", call))
  }
  check_class(
    x, "rot_body", name,
    "Make one with {.fn body_disk}, or give the moment of inertia as one number in kg m^2.", call
  )
}

check_resistance <- function(x, takes, call) {
  x <- as_resistance(x, call, takes)
  if (resists(x)) x
}

# One of some names, or three numbers.
check_named_vector <- function(x, name, input, call) {
  if (is.character(x)) return(check_string(x, name, input$options, call))
  if (name == "axis") unit_axis(x, call) else check_vector(x, name, input$unit, call)
}

check_torque <- function(x, name, call) {
  torque <- as_torque(x, call, name)
  if (!torque_is_none(torque)) torque
}

# A number, or a function.
check_force <- function(x, name, input, call) {
  if (inherits(x, "rot_torque")) {
    abort_rotdyn(c(
      "{.arg {name}} must be a number in N, a function, or a {.fn force_function}.",
      x = "It is a torque law: {describe_torque(x)}."
    ), "type", call)
  }
  if (!is.function(x)) return(check_number(x, name, input$unit, call))
  check_law(x, name, input, call)
}

# A law for each body; the core counts them.
check_laws <- function(x, name, call) {
  if (!is.list(x) || is.object(x)) {
    abort_rotdyn(c(
      "{.arg {name}} must be a list with one entry for each body.",
      x = "It is {describe_value(x)}.",
      i = "What acts on the first alone: {.code list({name}, NULL)}."
    ), "type", call)
  }
  laws <- lapply(seq_along(x), function(i) as_torque(x[[i]], call, paste0(name, "[[", i, "]]")))
  if (!all(vapply(laws, torque_is_none, NA))) laws
}

# A function of the time alone, or of the time and the state.
check_law <- function(f, name, input, call) {
  refuse <- function(what, n = 0) {
    abort_rotdyn(c(
      "{.arg {name}} must be NULL or a function of the time alone, or of time and state.",
      x = what,
      i = "It is {input$words}."
    ), "type", call)
  }
  if (!is.function(f)) refuse("It is {describe_value(f)}.")
  if (name == "force") check_law_order(f, c("time_s", "x_m", "v_m_per_s"), name, "type", call)
  count_law_arguments(f, function(n) refuse("It has {n} argument{?s} without a default.", n))
  f
}

describe_input <- function(x) {
  if (is.character(x)) return(x)
  if (inherits(x, "rot_torque")) return(describe_torque(x))
  if (inherits(x, "rot_resistance")) return(describe_resistance(x))
  if (inherits(x, "rot_body")) return(paste0("a body, ", format_si(x$mass_kg), " kg"))
  format_si(x)
}

#' @export
print.rot_scene <- function(x, ...) {
  check_scene(x, current_env())
  constraint <- constraint_of(x)
  say("<rot_scene> ", scene_title(x), "\n")
  given <- Filter(Negate(is.null), unclass(x)[names(constraint$inputs)])
  for (name in names(given)) {
    unit <- constraint$inputs[[name]]$unit
    value <- describe_input(given[[name]])
    none <- unit %in% c("", "1") || is.list(given[[name]])
    unit <- if (none) "" else paste0(" ", plain_unit(unit))
    say(sprintf("  %-22s %s%s\n", name, paste(value, collapse = ", "), unit))
  }
  invisible(x)
}
