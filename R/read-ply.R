# PLY, text or binary: the coordinates of the vertices and the vertex numbers of the faces; other
# properties are skipped. The header lists the elements and their properties; the rows follow,
# element by element. A list property begins with its length. A text file is read as numbers, a
# binary file as bytes, and both are parsed alike: a number takes one place in a text, or its size
# in bytes.
#
# Source: Turk, The PLY polygon file format (Stanford, 1994).

read_ply <- function(path) {
  ply <- ply_header(readBin(path, "raw", file.size(path)))
  vertex <- ply$elements$vertex
  face <- ply$elements$face
  corners <- intersect(c("vertex_indices", "vertex_index"), face$name)
  if (!all(c("x", "y", "z") %in% vertex$name) || !length(corners)) {
    stop("it has no vertices with x, y, z, or no faces with vertex_indices", call. = FALSE)
  }
  place <- c("x", "y", "z")
  if (any(vertex$is_list[match(place, vertex$name)]) || !face$is_list[face$name == corners[1L]]) {
    stop("coordinates must be numbers, and the corners of a face a list", call. = FALSE)
  }
  ply$places <- ply_places(ply, path)
  rows <- ply_walk(ply)
  x <- t(vapply(place, function(name) {
    as.double(unlist(ply_values(rows$vertex, name, ply)))
  }, double(vertex$count)))
  polygons <- ply_values(rows$face, corners[1L], ply)
  if (any(vapply(polygons, nrow, 1L) < 3L)) {
    stop("a face has fewer than three corners", call. = FALSE)
  }
  triangles <- lapply(polygons, function(of_size) polygon_triangles(x, of_size + 1))
  structure(
    list(
      vb = x, it = do.call(cbind, c(list(matrix(0, 3L, 0L)), unname(triangles))),
      single = any(vertex$type[match(place, vertex$name)] != "double")
    ),
    class = "mesh3d"
  )
}

ply_sizes <- c(char = 1, uchar = 1, short = 2, ushort = 2, int = 4, uint = 4, float = 4, double = 8)
ply_types <- c(
  int8 = "char", uint8 = "uchar", int16 = "short", uint16 = "ushort", int32 = "int",
  uint32 = "uint", float32 = "float", float64 = "double"
)

# list(format, lines of the header, bytes after it, elements): for each element its count, and for
# each property the name, the type, whether it is a list, and the type of its length.
ply_header <- function(bytes) {
  end <- grepRaw("end_header[ \t]*\r?\n", bytes)
  if (!length(end) || !identical(rawToChar(bytes[1:3]), "ply")) {
    stop("it does not begin with \"ply\" and a header", call. = FALSE)
  }
  behind <- end - 1L + length(grepRaw("end_header[ \t]*\r?\n", bytes, value = TRUE))
  lines <- strsplit(rawToChar(bytes[seq_len(behind)]), "\r?\n")[[1L]]
  words <- strsplit(trimws(lines), "[[:space:]]+")
  elements <- list()
  format <- NA_character_
  for (word in words) {
    if (word[1L] == "format") {
      format <- word[2L]
    } else if (word[1L] == "element") {
      if (word[2L] %in% names(elements)) {
        stop("it has two elements of one name: ", word[2L], call. = FALSE)
      }
      elements[[word[2L]]] <- list(count = suppressWarnings(as.numeric(word[3L])))
    } else if (word[1L] == "property") {
      last <- length(elements)
      if (!last) stop("a property precedes all elements", call. = FALSE)
      elements[[last]] <- ply_property(elements[[last]], word)
    }
  }
  if (!format %in% c("ascii", "binary_little_endian", "binary_big_endian")) {
    stop("its format is unknown", call. = FALSE)
  }
  list(format = format, lines = length(lines), bytes = bytes[-seq_len(behind)], elements = elements)
}

ply_property <- function(element, word) {
  is_list <- word[2L] == "list"
  types <- if (is_list) word[3:4] else c(NA, word[2L])
  types <- ifelse(types %in% names(ply_types), ply_types[types], types)
  if (!types[2L] %in% names(ply_sizes) || is_list && !types[1L] %in% names(ply_sizes)) {
    stop("a property has an unknown type: ", paste(word, collapse = " "), call. = FALSE)
  }
  if (word[length(word)] %in% element$name) {
    stop("an element has two properties of one name: ", word[length(word)], call. = FALSE)
  }
  element$name <- c(element$name, word[length(word)])
  element$type <- c(element$type, unname(types[2L]))
  element$length_type <- c(element$length_type, unname(types[1L]))
  element$is_list <- c(element$is_list, is_list)
  element
}

# The numbers of a text file, or the bytes of a binary file as integers.
ply_places <- function(ply, path) {
  if (ply$format == "ascii") {
    scan(path, skip = ply$lines, quiet = TRUE, skipNul = TRUE)
  } else {
    as.integer(ply$bytes)
  }
}

# The place of each value: for each element and property the place before it, row by row, and the
# number of values.
ply_walk <- function(ply) {
  text <- ply$format == "ascii"
  at <- 0
  for (name in names(ply$elements)) {
    element <- ply$elements[[name]]
    n <- element$count
    if (!isTRUE(n >= 0 && n == floor(n) && n <= length(ply$places))) {
      stop("it is truncated, or a count is wrong", call. = FALSE)
    }
    one <- rep(1, length(element$type))
    element$size <- if (text) one else unname(ply_sizes[element$type])
    element$length_size <- if (text) one else unname(ply_sizes[element$length_type])
    element$length_size[!element$is_list] <- 0
    walked <- ply_even_rows(element, at, ply)
    if (is.null(walked)) walked <- ply_uneven_rows(element, at, ply)
    if (!isTRUE(walked$end <= length(ply$places))) {
      stop("it is truncated, or a count is wrong", call. = FALSE)
    }
    at <- walked$end
    ply$elements[[name]] <- c(element, walked)
  }
  ply$elements
}

# Rows that are all as long as the first (the usual case); NULL if they are not.
ply_even_rows <- function(element, at, ply) {
  n <- element$count
  if (n == 0) {
    none <- lapply(element$size, function(one) double())
    return(list(before = none, values = none, end = at))
  }
  first <- ply_row(element, at, ply)
  start <- at + (seq_len(n) - 1) * (first$end - at)
  if (!isTRUE(start[n] + first$end - at <= length(ply$places))) return(NULL)
  for (k in which(element$is_list)) {
    off <- first$before[k] - at - element$length_size[k]
    if (!all(ply_length(ply, start + off, element$length_size[k]) %in% first$values[k])) {
      return(NULL)
    }
  }
  list(
    before = lapply(first$before, function(before) start + (before - at)),
    values = lapply(first$values, rep, n),
    end = start[n] + first$end - at
  )
}

ply_uneven_rows <- function(element, at, ply) {
  before <- values <- matrix(0, length(element$size), element$count)
  for (i in seq_len(element$count)) {
    row <- ply_row(element, at, ply)
    before[, i] <- row$before
    values[, i] <- row$values
    at <- row$end
    if (!isTRUE(at <= length(ply$places))) break
  }
  columns <- seq_along(element$size)
  list(
    before = lapply(columns, function(k) before[k, ]),
    values = lapply(columns, function(k) values[k, ]),
    end = at
  )
}

ply_row <- function(element, at, ply) {
  before <- values <- element$size
  for (k in seq_along(before)) {
    values[k] <- 1
    if (element$is_list[k]) {
      values[k] <- ply_length(ply, at, element$length_size[k])
      at <- at + element$length_size[k]
    }
    before[k] <- at
    at <- at + values[k] * element$size[k]
  }
  counts <- isTRUE(all(values >= 0 & values == floor(values)))
  list(before = before, values = values, end = if (counts) at else Inf)
}

# Lengths of lists that begin after the places `at`.
ply_length <- function(ply, at, size) {
  sum <- 0
  order <- if (ply$format == "binary_big_endian") seq_len(size) else rev(seq_len(size))
  for (i in order) sum <- 256 * sum + ply$places[at + i]
  sum
}

# The values of a property: a matrix for all rows with the same number of values, rows in columns.
ply_values <- function(element, name, ply) {
  k <- match(name, element$name)
  rows <- split(seq_len(element$count), element$values[[k]])
  lapply(rows, function(row) {
    many <- element$values[[k]][row[1L]]
    before <- element$before[[k]][row]
    at <- rep(before, each = many * element$size[k]) + seq_len(many * element$size[k])
    matrix(ply_numbers(at, element$type[k], many * length(row), ply), many)
  })
}

ply_numbers <- function(at, type, count, ply) {
  if (ply$format == "ascii") return(ply$places[at])
  endian <- if (ply$format == "binary_little_endian") "little" else "big"
  what <- if (type %in% c("float", "double")) "double" else "integer"
  size <- unname(ply_sizes[type])
  x <- readBin(
    ply$bytes[at], what, count,
    size = size, signed = !(type %in% c("uchar", "ushort")), endian = endian
  )
  if (type == "uint") ifelse(x < 0, x + 2^32, x) else x
}
