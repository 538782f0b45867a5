# STL files: separate triangles. Binary files are read by rgl, with the format given explicitly: rgl
# (1.3.36) takes a binary file that begins with "solid" for a text. Text files are read here.
#
# Source: 3D Systems, StereoLithography Interface Specification (1989), section 6.5.

# A binary file has 80 bytes, the number of triangles, and 50 bytes for each. A text begins with
# "solid", but so do some binary files, which are identified by their length. A text has no zero
# byte.
stl_is_binary <- function(path, call) {
  size <- file.size(path)
  con <- file(path, "rb")
  on.exit(close(con))
  head <- readBin(con, "raw", 84L)
  triangles <- sum(as.integer(head[81:84]) * 256^(0:3))
  if (isTRUE(triangles == 0 && size == 84)) abort_mesh_file(path, "It has no triangles.", call)
  if (isTRUE(size == 84 + 50 * triangles)) return(TRUE)
  if (!any(head == 0) && grepl("^[[:space:]]*solid", rawToChar(head), TRUE, useBytes = TRUE)) {
    return(FALSE)
  }
  abort_mesh_file(
    path,
    if (size < 84) {
      "It is not a text that begins with {.val solid}, and too short for a binary STL."
    } else {
      "It declares {format(triangles, big.mark = ',')} triangles, which need
       {format(84 + 50 * triangles, big.mark = ',')} bytes, but has
       {format(size, big.mark = ',')}: it is truncated or damaged."
    },
    call
  )
}

read_stl_binary <- function(path) {
  corners <- rgl::readSTL(path, ascii = FALSE, plot = FALSE)
  structure(list(vb = t(corners), it = matrix(seq_len(nrow(corners)), 3L)), class = "mesh3d")
}

# Three vertices for each facet; normals and other lines are skipped.
read_stl_text <- function(path) {
  lines <- readLines(path, warn = FALSE, skipNul = TRUE)
  lines <- lines[grepl("^[[:space:]]*(vertex|endloop)", lines, TRUE, useBytes = TRUE)]
  is_vertex <- grepl("^[[:space:]]*v", lines, TRUE, useBytes = TRUE)
  if (!length(lines)) stop("it has no facets", call. = FALSE)
  facets <- length(lines) %/% 4L
  if (!identical(is_vertex, rep(c(TRUE, TRUE, TRUE, FALSE), facets))) {
    stop("a facet does not have three vertices, or the file is truncated", call. = FALSE)
  }
  numbers <- sub("^[[:space:]]*[[:alpha:]]+", "", lines[is_vertex], useBytes = TRUE)
  places <- scan(text = numbers, what = list(0, 0, 0), multi.line = FALSE, quiet = TRUE)
  structure(
    list(vb = do.call(rbind, places), it = matrix(seq_len(3L * facets), 3L)), class = "mesh3d"
  )
}
