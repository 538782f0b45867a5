# Bodies as text: by their constructor where it makes them again, else by their numbers.

#' @export
text_node.rot_body <- function(x, where, call) {
  # A body that is part of several is written once.
  address <- rlang::obj_address(x)
  known <- registry_texts$nodes[[address]]
  if (!is.null(known)) return(known$node)
  node <- first_that_fits(x, body_texts(x), where, call)
  if (!is.null(node) && !is.null(registry_texts$nodes)) {
    # With the body, so that no other one takes its address.
    registry_texts$nodes[[address]] <- list(node = node, body = x)
  }
  if (is.null(node)) {
    abort_rotdyn(c(
      "{sentence(where)} has no text.", x = "Its parts were edited: they make no body."
    ), "scene", call)
  }
  node
}

body_readers <- function() {
  if (is.null(registry_texts$bodies)) registry_texts$bodies <- list_body_readers()
  registry_texts$bodies
}

list_body_readers <- function() {
  shapes <- paste0("body_", shape_table()$shape)
  shapes <- intersect(shapes, getNamespaceExports("rotdyn"))
  c(
    mget(shapes, envir = topenv()),
    list(
      body_polygon = body_polygon, body_tetrahedron = body_tetrahedron, body_points = read_data,
      body_tensor = body_tensor, place_body = place_body, join_bodies = read_joined,
      cut_body = cut_body, rot_body = read_body
    )
  )
}

# A reader takes 100 levels. A body whose text would have more than this, or be much longer than the
# body (joined to itself again and again), is written by its numbers.
body_levels <- 80
body_leaves <- 512

text_is_short <- function(body) {
  if (is.null(.subset2(body$detail, "bodies"))) return(TRUE)
  size <- nested_size(body, 0, new.env(parent = emptyenv()))
  size[["levels"]] <= body_levels && size[["leaves"]] <= max(body_leaves, 2 * size[["objects"]])
}

# Levels and leaves of the text of a body, and how many bodies it consists of, each counted once.
nested_size <- function(body, above, seen) {
  address <- rlang::obj_address(body)
  known <- seen[[address]]
  if (!is.null(known)) return(c(known[c("levels", "leaves")], objects = 0))
  parts <- .subset2(body$detail, "bodies")
  own <- if (is.null(parts)) 2 else 3
  if (!is.null(.subset2(body$detail, "frame"))) own <- own + 2
  size <- c(levels = own, leaves = 1, objects = 1)
  if (above + own > body_levels) {
    size[["levels"]] <- Inf
  } else if (!is.null(parts)) {
    inner <- vapply(parts, nested_size, size, above + own, seen)
    size <- c(
      levels = own + max(inner["levels", ]), leaves = sum(inner["leaves", ]),
      objects = 1 + sum(inner["objects", ])
    )
  }
  seen[[address]] <- size
  size
}

# The forms that may fit a body, in order.
body_texts <- function(body) {
  forms <- list()
  frame <- .subset2(body$detail, "frame")
  own <- if (text_is_short(body)) own_text(body)
  if (!is.null(own) && is.null(frame)) forms[own$name] <- list(text_form(own$arguments, own$read))
  if (!is.null(own) && !is.null(frame)) {
    forms$place_body <- text_form(function(x) {
      unplaced <- make_quietly(own$read, Filter(Negate(is.null), own$arguments(x)))
      turned <- !identical(frame$turn, diag(3))
      list(body = unplaced, at_m = frame$at_m, rotation = if (turned) frame$turn)
    }, place_body)
  }
  c(forms, list(rot_body = text_form(body_numbers, read_body)))
}

# The constructor of a body that was not placed; NULL where there is none.
own_text <- function(body) {
  detail <- body$detail
  amount <- function(x) {
    given <- intersect(density_names, names(detail))
    if (length(given)) detail[given[1]] else list(mass_kg = x$mass_kg)
  }
  recipe <- function(name, arguments, read) list(name = name, arguments = arguments, read = read)
  if (body$provenance == "formula" && !is.null(detail$vertices_m)) {
    name <- paste0("body_", body$shape)
    if (!name %in% c("body_polygon", "body_tetrahedron")) return(NULL)
    return(recipe(name, function(x) {
      c(amount(x), list(vertices_m = detail$vertices_m))
    }, get(name, envir = topenv())))
  }
  name <- paste0("body_", body$shape)
  if (body$provenance == "formula" && name %in% names(body_readers())) {
    return(recipe(name, function(x) c(amount(x), as.list(x$size_m)), body_readers()[[name]]))
  }
  if (body$provenance == "tensor" && !is.null(detail$tensor)) {
    return(recipe("body_tensor", function(x) {
      tensor <- detail$tensor
      at <- detail$tensor_at_m
      moments <- identical(tensor, diag(diag(tensor)))
      list(
        mass_kg = x$mass_kg, inertia_kg_m2 = if (moments) diag(tensor) else tensor,
        centre_m = if (any(at != 0)) at, reach_m = if (!is.na(x$reach_m)) x$reach_m,
        name = if (x$shape != formals(body_tensor)$name) x$shape
      )
    }, body_tensor))
  }
  if (body$provenance == "compound" && all(detail$signs == 1)) {
    return(recipe("join_bodies", function(x) {
      list(bodies = detail$bodies, name = x$shape)
    }, read_joined))
  }
  if (body$provenance == "compound" && identical(detail$signs, c(1, -1))) {
    return(recipe("cut_body", function(x) {
      list(body = detail$bodies[[1]], hole = detail$bodies[[2]], name = x$shape)
    }, cut_body))
  }
  if (body$provenance == "points" && !is.null(detail$at) && is.null(detail$frame)) {
    return(recipe("body_points", function(x) {
      list(data = as.data.frame(detail$at), name = x$shape)
    }, read_data))
  }
}

# A column of one number is a number in a text.
read_data <- function(data, mass_kg = NULL, name = "points") {
  if (is.list(data)) data <- tibble::as_tibble(data)
  body_points(data, mass_kg = mass_kg, name = name)
}

read_joined <- function(bodies, name = "compound") {
  call <- current_env()
  check_supplied("bodies", call)
  if (!is.list(bodies) || is.object(bodies)) {
    abort_rotdyn("{.field bodies} must be a list of bodies.", "type", call)
  }
  do.call(join_bodies, c(unname(bodies), list(name = name)), quote = TRUE)
}

# All of a body but what follows from it.
body_numbers <- function(x) {
  known <- function(x) if (is.na(x)) NULL else x
  words <- function(x) if (nzchar(x)) x
  frame <- .subset2(x$detail, "frame")
  list(
    shape = x$shape, mass_kg = x$mass_kg, centre_m = as.double(x$centre_m),
    second_moment_kg_m2 = unname(x$second_moment_kg_m2),
    size_m = if (length(x$size_m)) sizes_text(x$size_m), reach_m = known(x$reach_m),
    beta = known(x$beta), formula = words(x$formula), source = words(x$source),
    provenance = x$provenance, method = .subset2(x$detail, "method"), error = known(x$error),
    error_kind = x$error_kind, centre_error_m = .subset2(x$detail, "centre_error_m"),
    frame_at_m = frame$at_m, frame_turn = frame$turn
  )
}

# The body of these numbers, if there is one.
read_body <- function(shape, mass_kg, centre_m, second_moment_kg_m2, size_m = NULL,
                      reach_m = NA_real_, beta = NA_real_, formula = "", source = "",
                      provenance = "tensor", method = NULL, error = NA_real_,
                      error_kind = "estimate", centre_error_m = NULL, frame_at_m = NULL,
                      frame_turn = NULL) {
  call <- current_env()
  check_supplied(c("shape", "mass_kg", "centre_m", "second_moment_kg_m2"), call)
  shape <- check_name(shape, "shape", call)
  mass <- check_number(mass_kg, "mass_kg", "kg", call, 0)
  centre <- check_vector(centre_m, "centre_m", "m", call)
  second <- check_finite(second_moment_kg_m2, "second_moment_kg_m2", "kg*m^2", call)
  if (length(second) != 9L || !identical(dim(second_moment_kg_m2), c(3L, 3L)) ||
    !isSymmetric(second_moment_kg_m2, tol = 0)) {
    abort_rotdyn(
      "{.field second_moment_kg_m2} must be a symmetric 3 x 3 array of numbers.", "value", call
    )
  }
  number_or <- function(x, arg, unit) {
    if (identical(x, NA_real_) || identical(x, Inf)) x else check_number(x, arg, unit, call, 0)
  }
  reach <- number_or(reach_m, "reach_m", "m")
  turn <- frame_turn %||% diag(3)
  if (!is.null(frame_at_m)) {
    frame_at_m <- check_vector(frame_at_m, "frame_at_m", "m", call)
    as_rotation(turn, "frame_turn", call)
  }
  detail <- list(
    method = if (!is.null(method)) check_string(method, "method", names(mesh_words), call),
    centre_error_m = if (!is.null(centre_error_m)) {
      check_number(centre_error_m, "centre_error_m", "m", call, 0)
    },
    frame = if (!is.null(frame_at_m)) list(turn = turn, at_m = frame_at_m)
  )
  provenances <- c(names(provenance_words), "mesh")
  body <- new_body(
    shape, mass, matrix(second, 3), centre, read_sizes(size_m, call), reach,
    number_or(beta, "beta", "1"), check_name(formula, "formula", call),
    check_name(source, "source", call),
    check_string(provenance, "provenance", provenances, call), Filter(Negate(is.null), detail),
    number_or(error, "error", "1"),
    check_string(error_kind, "error_kind", c("bound", "estimate"), call), call
  )
  check_inertia_or_abort(
    body$inertia_kg_m2, mass, call, reach_m = if (is.finite(reach)) reach, given_by_user = FALSE
  )
  check_shape_numbers(check_body(body, call), call)
}

sizes_text <- function(x) if (is.null(names(x))) as.double(x) else as.list(x)

read_sizes <- function(x, call) {
  if (is.null(x)) return(numeric())
  if (is.double(x)) return(check_finite(x, "size_m", "m", call))
  if (!is.list(x) || !all(lengths(x) == 1L) || !all(vapply(x, is.double, NA))) {
    abort_rotdyn("{.field size_m} must be an object of numbers.", "value", call)
  }
  unlist(x)
}

# A body that says to be a standard shape has that shape's moments, in whatever axes.
check_shape_numbers <- function(body, call) {
  name <- paste0("body_", body$shape)
  if (body$provenance != "formula" || !name %in% names(body_readers()) ||
    name %in% c("body_polygon", "body_tetrahedron")) {
    return(body)
  }
  own <- do.call(
    body_readers()[[name]], c(list(mass_kg = body$mass_kg), as.list(body$size_m)), quote = TRUE
  )
  moments <- function(x) sort(eigen(x$second_moment_kg_m2, TRUE, TRUE)$values)
  off <- max(abs(moments(body) - moments(own)))
  if (!(off <= 1e-9 * sum(moments(own)))) {
    abort_rotdyn(c(
      "The numbers are not those of a {body$shape} of this mass and these sizes.",
      i = "{.val {name}} with mass and sizes alone makes one."
    ), "value", call)
  }
  body
}
