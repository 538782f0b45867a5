# STL as text: three vertices a facet; normals, and what else is said, are passed over. rgl reads
# binary files only, and Rvcg in single precision.
#
# Source: 3D Systems, StereoLithography Interface Specification (1989), section 6.5.

read_stl_text <- function(path) {
  lines <- readLines(path, warn = FALSE, skipNul = TRUE)
  lines <- lines[grepl("^[[:space:]]*(vertex|endloop)", lines, TRUE, useBytes = TRUE)]
  is_vertex <- grepl("^[[:space:]]*v", lines, TRUE, useBytes = TRUE)
  if (!length(lines)) {
    stop("it has no facets", call. = FALSE)
  }
  facets <- length(lines) %/% 4L
  if (!identical(is_vertex, rep(c(TRUE, TRUE, TRUE, FALSE), facets))) {
    stop("a facet has not three vertices, or the file was cut off", call. = FALSE)
  }
  numbers <- sub("^[[:space:]]*[[:alpha:]]+", "", lines[is_vertex], useBytes = TRUE)
  places <- scan(text = numbers, what = list(0, 0, 0), multi.line = FALSE, quiet = TRUE)
  structure(
    list(vb = do.call(rbind, places), it = matrix(seq_len(3L * facets), 3L)),
    class = "mesh3d"
  )
}
