# Scenes and bodies as text. A node is a named list of one element: the name of a constructor, and
# its arguments by name. What is derived (loads, effects) is not in it. Each node is read back when
# it is written, and what comes back must be the object: else the next way of writing is tried.

scene_format <- 1

#' Scenes and bodies as text
#'
#' A scene as JSON: the names of constructors as keys, with their arguments. Numbers come back bit
#' for bit, and the scene read computes the same bits. A person can write such a file by hand: in
#' any order, with what has a default left out.
#'
#' Keys are the names of the functions of this package that make scenes, bodies, torque laws,
#' couplings, brakes, resistances and changes of inertia, and those of their arguments. Reading
#' calls these functions, so a text makes no scene that they refuse, and evaluates nothing. `Inf`,
#' `-Inf` and `NaN` are strings. A constant torque is a number.
#'
#' A body from a mesh, a density or a tensor that was moved is written by its mass, centre of mass
#' and second moment (key `rot_body`): it computes the same; a mesh's triangles, for its picture,
#' are left out.
#' So is one that was joined more than some 25 times, one inside the other.
#'
#' R functions have no text: forces and torque laws that are functions, or become one (laws along
#' the axes of a body in space), are refused.
#'
#' @param scene A scene (see [scene_axle()]), or a `rot_body`.
#' @param file Name of a file. `write_scene()`: NULL for none. `read_scene()`: also the text itself,
#'   which begins with a brace, or a connection, which is read to its end.
#' @param ... Not used: an unknown argument is an error.
#' @param indent Blanks for each level. 0: the canonical text, in one line, with sorted keys: the
#'   same for the same scene, whatever file it came from.
#' @return `write_scene()`: the text, one string, invisibly if it is written to a file.
#'   `read_scene()`: the scene or the body. `scene_hash()`: 32 hexadecimal digits, XXH128 of the
#'   canonical text.
#' @section Errors: `rotdyn_error_scene` for a text that is damaged, has unknown keys, or describes
#'   what a constructor refuses (its own error is the parent), and for a scene that has no text;
#'   `rotdyn_error_file`; `rotdyn_error_type`; `rotdyn_error_package`: reading needs
#'   \pkg{yyjsonr}.
#' @source RFC 8259 (2017) for JSON.
#' @seealso [scene_code()], [records_add()], [metadata()].
#' @concept JSON
#' @concept file
#' @examples
#' wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = 0.03))
#' cat(write_scene(wheel))
#' scene_hash(wheel)
#'
#' @examplesIf requireNamespace("yyjsonr", quietly = TRUE)
#' read_scene('{"scene_axle": {"body": {"body_disk": {"mass_kg": 2, "radius_m": 0.25}},
#'   "torque": {"torque_knots": {"time_s": [0, 1, 4], "torque_n_m": [0, 0.8, 0]}},
#'   "resistance": {"viscous_n_m_s": 0.03}}}')
#' @export
write_scene <- function(scene, file = NULL, ..., indent = 2) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  indent <- check_number(indent, "indent", "1", call, 0, 8)
  text <- json_text(scene_node(scene, call), as.integer(indent))
  if (is.null(file)) return(text)
  write_file(text, check_file_name(file, call), call)
  invisible(text)
}

#' @rdname write_scene
#' @export
read_scene <- function(file, ...) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  scene_of_text(scene_source(file, call), call)
}

#' @rdname write_scene
#' @export
scene_hash <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  hash_text(scene_text(scene, call))
}

# The text of a file, of a connection, or `file` itself.
scene_source <- function(file, call) {
  if (!inherits(file, "connection")) {
    if (rlang::is_string(file) && grepl("^[[:space:]]*[{[]", file, useBytes = TRUE)) {
      if (Encoding(file) == "latin1") return(enc2utf8(file))
      Encoding(file) <- "UTF-8"
      return(file)
    }
    path <- check_file_name(file, call)
  }
  text <- tryCatch(
    suppressWarnings(if (inherits(file, "connection")) connection_text(file) else file_text(path)),
    error = identity
  )
  if (inherits(text, "error")) {
    abort_rotdyn(c(
      if (inherits(file, "connection")) "The connection cannot be read." else
        "The file {.file {file}} cannot be read.",
      x = braces_doubled(conditionMessage(text))
    ), "file", call)
  }
  if (is.na(text)) {
    abort_rotdyn(c("The text is no scene.", x = "It has a zero byte."), "scene", call)
  }
  without_mark(text)
}

scene_text <- function(scene, call) json_text(scene_node(scene, call))

# The node of a scene whose R functions are left in it: no text can be made of such a node.
scene_node_with_functions <- function(scene, call) {
  registry_texts$functions <- TRUE
  on.exit(registry_texts$functions <- NULL)
  scene_node(scene, call)
}

# The node of a scene or a body, with the format.
scene_node <- function(scene, call) {
  if (is.null(registry_texts$nodes)) {
    registry_texts$nodes <- new.env(parent = emptyenv())
    on.exit(registry_texts$nodes <- NULL)
  }
  if (inherits(scene, "rot_body")) {
    check_body(scene, call, "scene")
    node <- text_node(scene, "body", call)
  } else {
    check_scene(scene, call)
    node <- first_that_fits(scene, constraint_of(scene)$texts, "", call)
    if (is.null(node)) {
      abort_rotdyn(c(
        "This scene has no text.",
        x = "Its constructor does not make it again from its parts: they were edited."
      ), "scene", call)
    }
  }
  c(list(scene_format = scene_format), node)
}

scene_of_text <- function(text, call) {
  x <- empty_places(read_json(text, "scene", "scene", call))
  if (!is.list(x) || is.null(names(x))) {
    abort_rotdyn(c(
      "The text is no scene.",
      i = "A scene begins like {.code {{\"scene_axle\": {{\"body\": ...}}}}}."
    ), "scene", call)
  }
  format <- x$scene_format
  if (!is.null(format) && !identical(format, scene_format)) {
    abort_rotdyn(c(
      "The scene has an unknown format.",
      x = "{.field scene_format} is {describe_value(format)}; this version reads {scene_format}.",
      i = "A newer version of rotdyn wrote it, perhaps."
    ), "scene", call)
  }
  x$scene_format <- NULL
  readers <- text_readers()
  readers <- readers[grepl("^(scene_|body_)|^(rot|place|join|cut)_bod", names(readers))]
  read_node(x, readers, "the scene", call)
}

# A null among numbers is an empty place of a list, not a missing number.
empty_places <- function(x) {
  if (is.list(x)) return(lapply(x, empty_places))
  gaps <- is.na(x) & !is.nan(x)
  if (!any(gaps) || !is.null(dim(x))) return(x)
  lapply(seq_along(x), function(i) if (!gaps[i]) x[[i]])
}

# ---- writing ------------------------------------------------------------------------------------

# A way to write an object: arguments(x) of a constructor by name, or NULL where it does not fit;
# read(...) makes the object of them.
text_form <- function(arguments, read) list(arguments = arguments, read = read)

# The node by the first of some forms from which the object comes back; NULL without one.
first_that_fits <- function(x, forms, where, call) {
  for (i in seq_along(forms)) {
    name <- names(forms)[i]
    arguments <- forms[[i]]$arguments(x)
    if (is.null(arguments)) next
    read <- forms[[i]]$read
    arguments <- arguments[!vapply(arguments, is.null, NA)]
    if (same_object(make_quietly(read, arguments), x)) {
      return(stats::setNames(list(argument_nodes(arguments, read, where, call)), name))
    }
  }
  NULL
}

make_quietly <- function(read, arguments) {
  tryCatch(
    suppressWarnings(suppressMessages(do.call(read, arguments, quote = TRUE))),
    rotdyn_error = function(e) NULL
  )
}

# An argument of 0 or 1 that is so by default is left out; -0 is not.
argument_nodes <- function(arguments, read, where, call) {
  defaults <- formals(read)
  plain <- vapply(names(arguments), function(name) {
    x <- arguments[[name]]
    (identical(x, 0, num.eq = FALSE) || identical(x, 1)) && identical(defaults[[name]], x)
  }, NA)
  arguments <- arguments[!plain]
  nodes <- Map(function(x, name) {
    text_node(x, paste0(where, if (nzchar(where)) "$", name), call)
  }, arguments, names(arguments))
  if (length(nodes)) nodes else stats::setNames(list(), character())
}

# Without what only prints and pictures use.
same_object <- function(a, b) {
  identical(a, b) || identical(without_pictures(a), without_pictures(b))
}

without_pictures <- function(x) {
  if (!is.list(x) || is.data.frame(x)) return(x)
  if (inherits(x, "rot_body")) {
    used <- intersect(c("centre_error_m", "frame"), names(x$detail))
    x$detail <- if (length(used)) x$detail[used] else list()
    if (!is.null(names(x$size_m))) x$size_m <- x$size_m[order(names(x$size_m))]
    return(x)
  }
  if (!is.null(x[["about"]])) x["about"] <- NULL
  kept <- attributes(x)
  x <- lapply(x, without_pictures)
  attributes(x) <- kept[intersect(names(kept), c("names", "class"))]
  x
}

# What stands for an argument in a text: a node, or a plain value.
text_node <- function(x, where, call) UseMethod("text_node")

#' @export
text_node.default <- function(x, where, call) {
  if (is.function(x)) {
    if (isTRUE(registry_texts$functions)) return(x)
    abort_function_text(where, NULL, call)
  }
  if (is.data.frame(x)) return(as.list(x))
  if (is.list(x)) {
    parts <- if (is.null(names(x))) sprintf("[[%d]]", seq_along(x)) else paste0("$", names(x))
    return(Map(function(part, name) text_node(part, paste0(where, name), call), x, parts))
  }
  x
}

abort_function_text <- function(where, instead, call) {
  abort_rotdyn(c(
    "An R function has no text.",
    x = "{.field {where}} of this scene is one.",
    i = instead
  ), "scene", call)
}

# ---- reading ------------------------------------------------------------------------------------

# The closed list of keys: functions by name, those of the constraints among them.
text_readers <- function() {
  if (is.null(registry_texts$readers)) {
    texts <- lapply(unname(all_constraints()), function(constraint) {
      c(constraint$texts, unlist(unname(lapply(constraint$makers, `[[`, "texts")), FALSE))
    })
    scenes <- lapply(unlist(texts, recursive = FALSE), `[[`, "read")
    readers <- c(scenes, body_readers(), law_readers(), coupling_readers())
    registry_texts$readers <- readers[!duplicated(names(readers))]
  }
  registry_texts$readers
}

registry_texts <- new.env(parent = emptyenv())

# Arguments that stand for their constructor without its name.
direct_readers <- function() list(resistance = resistance, brake = brake)

# An object of one key that names a reader.
read_node <- function(x, readers, where, call) {
  name <- names(x)
  if (length(x) != 1L || !name %in% names(readers)) {
    unknown <- setdiff(name, names(readers))
    near <- near_names(unknown, names(readers))
    abort_rotdyn(c(
      if (length(unknown)) "Unknown key {.val {some_names(unknown)}} in {where}." else
        "{sentence(where)} must have one key: it has {length(x)}.",
      i = if (length(near)) "Did you mean {.val {near}}?",
      i = "Known: {.val {utils::head(names(readers), 12)}}{if (length(readers) > 12) ', ...'}."
    ), "scene", call)
  }
  read_arguments(name, readers[[name]], x[[1]], call)
}

read_arguments <- function(name, read, x, call) {
  known <- setdiff(names(formals(read)), "...")
  if (length(x) && (!is.list(x) || is.null(names(x)))) {
    abort_rotdyn(c(
      "The arguments of {.val {name}} must be an object.",
      i = "Its keys are {.val {known}}."
    ), "scene", call)
  }
  x <- of_this_version(name, x)
  unknown <- setdiff(names(x), known)
  if (length(unknown)) {
    near <- near_names(unknown, known)
    abort_rotdyn(c(
      "Unknown key {.val {some_names(unknown)}} in {.val {name}}.",
      i = if (length(near)) "Did you mean {.val {near}}?",
      unit_hints(some_names(unknown)), i = "Known: {.val {known}}."
    ), "scene", call)
  }
  arguments <- Map(read_argument, x, names(x), list(call))
  tryCatch(
    withCallingHandlers(do.call(read, arguments, quote = TRUE), rotdyn_warning = function(w) {
      w$call <- rlang::error_call(call)
      warning(w)
      invokeRestart("muffleWarning")
    }),
    rotdyn_error_scene = function(e) rlang::cnd_signal(e),
    rotdyn_error = function(e) {
      abort_rotdyn("{.val {name}} refuses what the text says.", "scene", call, parent = e)
    }
  )
}

# Keys that version 0.5.0 wrote, by the names of this one.
of_this_version <- function(name, x) {
  old <- old_keys[[name]]
  if (is.null(old)) return(x)
  for (key in intersect(names(old), names(x))) {
    to <- old[[key]]
    if (startsWith(to, "resistance$")) {
      x$resistance[[sub("resistance$", "", to, fixed = TRUE)]] <- x[[key]]
      x[[key]] <- NULL
    } else if (nzchar(to) && !to %in% names(x)) {
      names(x)[names(x) == key] <- to
    } else if (!nzchar(to)) {
      x[[key]] <- NULL
    }
  }
  pair <- function(first, second) list(x[[first]] %||% 0, x[[second]] %||% 0)
  if (name == "scene_clutch") {
    pairs <- list(
      torque = c("torque_1", "torque_2"), theta0_rad = c("theta1_rad", "theta2_rad"),
      omega0_rad_per_s = c("omega1_rad_per_s", "omega2_rad_per_s")
    )
    for (to in names(pairs)) {
      if (!any(pairs[[to]] %in% names(x))) next
      both <- pair(pairs[[to]][1], pairs[[to]][2])
      if (all(vapply(both, is.double, NA))) both <- unlist(both)
      x[pairs[[to]]] <- NULL
      x[[to]] <- both
    }
  }
  x
}

# The times of tables follow from these.
old_keys <- list(
  scene_free = c(
    torque_n_m = "torque", damping_per_s = "resistance$damping_per_s", breaks_s = ""
  ),
  scene_pivot = c(
    torque_n_m = "torque", damping_per_s = "resistance$damping_per_s", breaks_s = ""
  ),
  rotor = c(inertia_kg_m2 = "moment_of_inertia_kg_m2", torque_n_m = "torque"),
  scene_incline = c(
    drag_n_s_per_m = "resistance$drag_n_s_per_m",
    drag_n_s2_per_m2 = "resistance$drag_n_s2_per_m2"
  ),
  scene_rotors = c(torque_n_m = "torque", viscous_n_m_s = "resistance"),
  scene_gears = c(torque_n_m = "torque", viscous_n_m_s = "resistance"),
  scene_clutch = character()
)

# Of these, strings are never numbers.
texts_of_names <- c("name", "shape", "formula", "source", "text", "kind", "method")

read_argument <- function(x, name, call) {
  # Of a node, not of a text: an R function, a list of them, or a law that has one.
  if (is.function(x) || is.object(x)) return(x)
  if (is.list(x) && length(x) && all(vapply(x, is.function, NA))) return(x)
  if (is_special_number(x) && !name %in% texts_of_names) return(as.double(x))
  if (!is.list(x)) return(x)
  if (is.null(names(x))) {
    if (!length(x)) return(if (name %in% c("laws", "bodies", "couplings")) list() else numeric())
    return(lapply(unname(x), read_argument, name, call))
  }
  readers <- text_readers()
  if (length(x) == 1L && names(x) %in% names(readers)) {
    return(read_node(x, readers, paste0("\"", name, "\""), call))
  }
  direct <- direct_readers()[[name]]
  if (!is.null(direct)) return(read_arguments(name, direct, x, call))
  if (name %in% c("data", "size_m") || (name == "torque" && !is.null(x[["time_s"]]))) {
    return(lapply(x, read_special))
  }
  read_node(x, readers, paste0("\"", name, "\""), call)
}

read_special <- function(x) if (is_special_number(x)) as.double(x) else x
