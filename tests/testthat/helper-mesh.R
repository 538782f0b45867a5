tetrahedron3d <- function() {
  vertices <- rbind(c(0, 1, 0, 0), c(0, 0, 2, 0), c(0, 0, 0, 3), 1)
  faces <- cbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  structure(list(vb = vertices, it = faces), class = c("mesh3d", "shape3d"))
}

as_pair <- function(mesh) list(vertices = t(mesh$vb[1:3, ]), faces = t(mesh$it))

skip_without_reader <- function(...) {
  found <- vapply(c(...), requireNamespace, logical(1), quietly = TRUE)
  if (!any(found)) skip(paste("none of these packages:", paste(c(...), collapse = ", ")))
}

# Without a display rgl needs to be told.
withr_null <- function(env = parent.frame()) {
  old <- options(rgl.useNULL = TRUE)
  do.call(on.exit, list(substitute(options(x), list(x = old)), add = TRUE), envir = env)
}

obj_body <- function(...) {
  path <- tempfile(fileext = ".obj")
  on.exit(unlink(path))
  writeLines(c(...), path)
  expect_no_warning(body <- body_mesh(path, density_kg_m3 = 1))
  body
}

# Walls between two copies of a polygon, which are `height` apart.
prism_obj <- function(x, y, height) {
  n <- length(x)
  after <- c(2:n, 1)
  c(
    paste("v", x, y, 0), paste("v", x, y, height),
    paste("f", paste(n:1, collapse = " ")), paste("f", paste(n + 1:n, collapse = " ")),
    paste("f", 1:n, after, after + n, 1:n + n)
  )
}

# A file of these bytes, or lines, is refused in these words.
expect_no_mesh_file <- function(content, extension, says) {
  path <- tempfile(fileext = extension)
  on.exit(unlink(path))
  if (is.character(content)) content <- charToRaw(paste0(content, "\n", collapse = ""))
  writeBin(content, path)
  expect_no_warning(
    expect_error(body_mesh(path, mass_kg = 1), says, class = "rotdyn_error_file")
  )
}
