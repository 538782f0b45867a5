# Converts a mesh to a list of `vertices` (matrix of doubles), `faces` (matrix of integers, three
# for a face), `by_column` (whether vertices and faces are in columns, as in a mesh3d), `factor`
# (metres in a unit of the coordinates), and for a file the `reader` and whether the numbers have
# `single` precision.
as_mesh <- function(mesh, length_unit, call) {
  factor <- metres_in(length_unit, call)
  out <- if (is.character(mesh)) {
    mesh_from_file(mesh, call)
  } else if (inherits(mesh, "mesh3d")) {
    mesh_from_mesh3d(mesh, "mesh", call)
  } else if (is_pair(mesh)) {
    mesh_from_pair(mesh, length_unit, factor, call)
  } else {
    abort_rotdyn(c(
      "{.arg mesh} must be a {.cls mesh3d} object, a list of {.field vertices} and {.field faces},
       or the path of an STL, OBJ or PLY file.",
      x = "It is {describe_value(mesh)}."
    ), "type", call)
  }
  out$factor <- factor
  out
}

# A list with names but no class is accepted here, so that the message says which names it needs.
is_pair <- function(mesh) {
  is.list(mesh) && !is.data.frame(mesh) && if (is.object(mesh)) {
    setequal(names(mesh), c("vertices", "faces"))
  } else {
    length(mesh) == 2L || !is.null(names(mesh))
  }
}

describe_matrix <- function(x) {
  if (is.matrix(x)) {
    paste("a", nrow(x), "x", ncol(x), typeof(x), "matrix")
  } else {
    describe_value(x)
  }
}

# ---- units of length ----------------------------------------------------------------------------

length_units <- c(
  m = 1, km = 1e3, dm = 0.1, cm = 0.01, mm = 1e-3, um = 1e-6, nm = 1e-9,
  "in" = 0.0254, ft = 0.3048, yd = 0.9144, mi = 1609.344
)

metres_in <- function(length_unit, call) {
  if (!is.character(length_unit) || length(length_unit) != 1L || is.na(length_unit)) {
    abort_rotdyn(c(
      "{.arg length_unit} must be one unit of length.",
      x = "It is {describe_value(length_unit)}."
    ), "type", call)
  }
  if (!is_readable_text(length_unit)) abort_unreadable(length_unit, "length_unit", call)
  known <- length_units[match(length_unit, names(length_units))]
  if (!is.na(known)) return(unname(known))
  if (requireNamespace("units", quietly = TRUE)) {
    # A warning says that the text is more than a unit: "2 m", "log(m)".
    metres <- tryCatch({
      lengths <- units::set_units(c(1, 2), length_unit, mode = "standard")
      as.numeric(units::set_units(lengths, "m", mode = "standard"))
    }, error = function(e) NA, warning = function(w) NA)
    # Proportional: reciprocals (1/m) are convertible, too.
    if (isTRUE(is.finite(metres[1]) && metres[1] > 0 && metres[2] == 2 * metres[1])) {
      return(metres[1])
    }
  }
  abort_rotdyn(c(
    "{.arg length_unit} must be a unit of length.",
    x = "It is {.val {length_unit}}.",
    i = "Known are {.val {names(length_units)}}, and with the package {.pkg units} all its units
         of length."
  ), "unit", call)
}

# ---- objects ------------------------------------------------------------------------------------

mesh_from_mesh3d <- function(mesh, arg, call) {
  vertices <- mesh$vb
  if (!is.matrix(vertices) || !is_number(vertices) || !nrow(vertices) %in% 3:4) {
    abort_rotdyn(c(
      "The {.field vb} of a {.cls mesh3d} must be a numeric matrix of three or four rows.",
      x = "It is {describe_matrix(vertices)}."
    ), "type", call)
  }
  storage.mode(vertices) <- "double"
  if (nrow(vertices) == 4L && !isTRUE(all(vertices[4L, ] == 1))) {
    vertices <- vertices[1:3, , drop = FALSE] / rep(vertices[4L, ], each = 3L)
  }
  triangles <- mesh_indices(mesh$it, 3L, TRUE, paste0(arg, "$it"), call)
  quads <- mesh_indices(mesh$ib, 4L, TRUE, paste0(arg, "$ib"), call)
  list(
    vertices = vertices,
    faces = if (ncol(quads)) cbind(triangles, split_quads(quads)) else triangles,
    by_column = TRUE, reader = NA_character_
  )
}

# Columns of four corners into two of three.
split_quads <- function(quads) {
  matrix(quads[c(1L, 2L, 3L, 1L, 3L, 4L), ], 3L)
}

mesh_from_pair <- function(mesh, length_unit, factor, call) {
  if (!is.null(names(mesh)) && !setequal(names(mesh), c("vertices", "faces"))) {
    abort_rotdyn(c(
      "A list {.arg mesh} must have {.field vertices} and {.field faces}.",
      x = "It has {.field {names(mesh)}}."
    ), "type", call)
  }
  if (is.null(names(mesh))) names(mesh) <- c("vertices", "faces")
  faces <- mesh$faces
  if (is.data.frame(faces)) faces <- as.matrix(faces)
  corners <- if (is.matrix(faces) && ncol(faces) == 4L) 4L else 3L
  faces <- mesh_indices(faces, corners, FALSE, "mesh$faces", call)
  if (corners == 4L) faces <- t(split_quads(t(faces)))
  list(
    vertices = mesh_vertices(mesh$vertices, length_unit, factor, call), faces = faces,
    by_column = FALSE, reader = NA_character_
  )
}

# Units objects are converted to `length_unit`, the unit of plain numbers.
mesh_vertices <- function(x, length_unit, factor, call) {
  if (is.data.frame(x)) {
    named <- Filter(function(names) all(names %in% names(x)), list(place_columns, c("x", "y", "z")))
    if (!length(named)) abort_missing_column(setdiff(place_columns, names(x))[1L], x, call)
    if (identical(named[[1L]], place_columns) && length_unit != "m") {
      abort_rotdyn(c(
        "Columns {.field {place_columns}} are in metres.",
        x = "{.arg length_unit} is {.val {length_unit}}.",
        i = "Call them {.field x}, {.field y} and {.field z}."
      ), "unit", call)
    }
    x <- lapply(named[[1L]], function(name) {
      own <- is.object(x[[name]])
      check_column(x[[name]], name, "m", call) / if (own) factor else 1
    })
    return(matrix(unlist(x), ncol = 3L))
  }
  if (inherits(x, "units")) {
    size <- dim(x)
    x <- as_si(x, "m", "mesh$vertices", call) / factor
    dim(x) <- size
  }
  if (!is.matrix(x) || !is_number(x) || ncol(x) != 3L) {
    abort_rotdyn(c(
      "{.code mesh$vertices} must be a numeric matrix of three columns, or a data frame of
       {.field x_m}, {.field y_m} and {.field z_m}.",
      x = "It is {describe_matrix(x)}."
    ), "type", call)
  }
  dimnames(x) <- NULL
  storage.mode(x) <- "double"
  x
}

# Vertex numbers. Those that are not whole become NA, and are counted as invalid later.
mesh_indices <- function(x, corners, by_column, arg, call) {
  if (is.null(x)) return(if (by_column) matrix(0L, corners, 0L) else matrix(0L, 0L, corners))
  missing <- is.logical(x) && all(is.na(x))
  if (!is.matrix(x) || !(is_number(x) || missing) || dim(x)[2L - by_column] != corners) {
    abort_rotdyn(c(
      "{.code {arg}} must be a matrix of vertex numbers with {corners}
       {if (by_column) 'rows' else 'columns'}.",
      x = "It is {describe_matrix(x)}."
    ), "type", call)
  }
  if (is.double(x)) x[!is.finite(x) | x != floor(x) | abs(x) > .Machine$integer.max] <- NA
  dimnames(x) <- NULL
  storage.mode(x) <- "integer"
  x
}

# ---- files --------------------------------------------------------------------------------------

mesh_from_file <- function(path, call) {
  if (length(path) == 1L && !is_readable_text(path)) abort_unreadable(path, "mesh", call)
  if (length(path) != 1L || is.na(path) || !file.exists(path) || dir.exists(path)) {
    abort_rotdyn(
      c("{.arg mesh} must be the path of one file.", x = "There is no file {.file {path}}."),
      "file", call
    )
  }
  format <- lower_case(sub("^.*[.]", "", basename(path)))
  if (!format %in% c("stl", "obj", "ply")) {
    abort_rotdyn(c(
      "A mesh is read from an STL, OBJ or PLY file.",
      x = "The extension of {.file {basename(path)}} must be one of
           {.val {c('.stl', '.obj', '.ply')}}."
    ), "file", call)
  }
  if (isTRUE(file.size(path) == 0)) abort_mesh_file(path, "It is empty.", call)
  binary <- format == "stl" && stl_is_binary(path, call)
  if (binary) need_rgl("A binary STL file", call)
  read <- tryCatch(
    switch(format,
      stl = if (binary) read_stl_binary(path) else read_stl_text(path),
      obj = read_obj(path),
      ply = read_ply(path)
    ),
    error = function(e) {
      reason <- encodeString(conditionMessage(e))
      abort_mesh_file(path, "The reader reports: {reason}.", call)
    }
  )
  out <- mesh_from_mesh3d(read, "mesh", call)
  out$file <- path
  out$format <- format
  out$reader <- if (binary) "rgl" else "rotdyn"
  out$single <- if (format == "ply") read$single else format == "stl"
  out
}

abort_mesh_file <- function(path, why, call, .envir = parent.frame()) {
  why <- cli::format_inline(why, .envir = .envir)
  abort_rotdyn(c("{.file {basename(path)}} cannot be read as a mesh.", x = "{why}"), "file", call)
}
