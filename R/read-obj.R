# Wavefront OBJ: the vertices and faces of a file; other statements are skipped. A face may have any
# number of corners, count them from the last vertex read (negative numbers), and have textures and
# normals after slashes. rgl::readOBJ() flips some polygons and does not accept negative numbers.
#
# Source: Wavefront, Advanced Visualizer manual, appendix B1 (object files).

read_obj <- function(path) {
  lines <- obj_lines(path)
  is_vertex <- grepl("^[[:space:]]*v[[:space:]]", lines, useBytes = TRUE)
  is_face <- grepl("^[[:space:]]*f[[:space:]]", lines, useBytes = TRUE)
  vertices <- obj_vertices(lines[is_vertex])
  faces <- obj_faces(lines[is_face], cumsum(is_vertex)[is_face])
  triangles <- lapply(split(faces, lengths(faces)), function(of_size) {
    polygon_triangles(vertices, matrix(unlist(of_size), length(of_size[[1L]])))
  })
  structure(
    list(vb = vertices, it = do.call(cbind, c(list(matrix(0, 3L, 0L)), unname(triangles)))),
    class = "mesh3d"
  )
}

# Without comments; lines that end with a backslash are joined with the next.
obj_lines <- function(path) {
  lines <- readLines(path, warn = FALSE, skipNul = TRUE)
  lines <- sub("#.*$", "", lines, useBytes = TRUE)
  goes_on <- grepl("\\\\[[:space:]]*$", lines, useBytes = TRUE)
  if (any(goes_on)) {
    first <- cumsum(c(TRUE, !goes_on[-length(lines)]))
    lines <- sub("\\\\[[:space:]]*$", " ", lines, useBytes = TRUE)
    lines <- vapply(split(lines, first), paste, "", collapse = "", USE.NAMES = FALSE)
  }
  lines
}

obj_words <- function(lines) {
  words <- strsplit(lines, "[[:space:]]+", useBytes = TRUE)
  # Without leading space and the keyword.
  lapply(words, function(line) line[-seq_len(if (nzchar(line[1L])) 1L else 2L)])
}

# A weight or a colour may follow the three coordinates.
obj_vertices <- function(lines) {
  words <- obj_words(lines)
  if (any(lengths(words) < 3L)) stop("a vertex has fewer than three coordinates", call. = FALSE)
  text <- unlist(lapply(words, `[`, 1:3))
  x <- suppressWarnings(as.numeric(text))
  bad <- is.na(x) & !grepl("^[-+]?nan", text, ignore.case = TRUE, useBytes = TRUE)
  if (any(bad)) stop("a coordinate is not a number: ", encodeString(text[bad][1L]), call. = FALSE)
  matrix(x, 3L)
}

# `before`: the number of vertices before each face. Other text becomes an invalid vertex number.
obj_faces <- function(lines, before) {
  words <- obj_words(lines)
  sizes <- lengths(words)
  if (any(sizes < 3L)) stop("a face has fewer than three corners", call. = FALSE)
  corner <- suppressWarnings(as.numeric(sub("/.*$", "", unlist(words), useBytes = TRUE)))
  before <- rep(before, sizes)
  back <- which(corner < 0)
  corner[back] <- before[back] + corner[back] + 1
  unname(split(corner, rep(seq_along(sizes), sizes)))
}
