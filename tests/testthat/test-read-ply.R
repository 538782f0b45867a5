# A unit cube, off the origin: two quadrangles and eight triangles.
cube_places <- t(as.matrix(expand.grid(0:1, 0:1, 0:1))) / 7 + 0.1
cube_faces <- list(
  c(0, 2, 3, 1), c(4, 5, 7, 6), c(0, 1, 5), c(0, 5, 4), c(2, 6, 7), c(2, 7, 3), c(0, 4, 6),
  c(0, 6, 2), c(1, 3, 7), c(1, 7, 5)
)
ply_header_lines <- function(format, real = "double", many = "uchar", corner = "int",
                             list = "vertex_indices") {
  c(
    "ply", paste("format", format, "1.0"), "comment of a cube: property of none", "element odd 2",
    "property list uchar short pair", "property uchar alone", "element vertex 8",
    paste("property", real, "x"), "property uchar red", paste("property", real, "y"),
    paste("property", real, "z"), "element face 10", "property float quality",
    paste("property list", many, corner, list), "element edge 1", "property int v", "end_header"
  )
}

write_ply_binary <- function(path, endian, real = 8, many = 1, corner = 4) {
  con <- file(path, "wb")
  on.exit(close(con))
  type <- c("uchar", "ushort", NA, "uint")
  writeLines(ply_header_lines(
    paste0("binary_", endian, "_endian"), if (real == 8) "float64" else "float32", type[many],
    type[corner], "vertex_index"
  ), con)
  put <- function(x, size) writeBin(x, con, size = size, endian = endian)
  for (n in c(3L, 0L)) {
    put(n, 1)
    put(seq_len(n), 2)
    put(7L, 1)
  }
  for (i in 1:8) {
    put(cube_places[1, i], real)
    put(255L, 1)
    put(cube_places[2:3, i], real)
  }
  for (face in cube_faces) {
    put(0.5, 4)
    put(length(face), many)
    put(as.integer(face), corner)
  }
  put(9L, 4)
}

test_that("a PLY may be text or binary, of either end and any type", {
  cube <- function(body, tolerance) {
    expect_equal(body$mass_kg, 1 / 7^3, tolerance = tolerance)
    expect_equal(unname(body$centre_m), rep(0.1 + 1 / 14, 3), tolerance = tolerance)
    expect_equal(
      unname(body$inertia_kg_m2), diag(body$mass_kg / 6 / 49, 3),
      tolerance = tolerance
    )
    expect_equal(body$detail$faces, 12)
    expect_equal(body$detail$reader, "rotdyn")
  }
  path <- tempfile(fileext = ".ply")
  text <- c(
    ply_header_lines("ascii", list = "vertex_index"), "3 1 2 3 7", "0 7",
    sprintf("%.17g 255 %.17g %.17g", cube_places[1, ], cube_places[2, ], cube_places[3, ]),
    vapply(cube_faces, function(f) paste("0.5", length(f), paste(f, collapse = " ")), ""), "9"
  )
  for (line_end in c("\n", "\r\n")) {
    writeLines(text, path, sep = line_end)
    cube(body_mesh(path, density_kg_m3 = 1), 1e-14)
  }
  # Rows need no lines of their own.
  writeLines(c(text[1:17], paste(text[-(1:17)], collapse = " ")), path)
  cube(body_mesh(path, density_kg_m3 = 1), 1e-14)
  for (endian in c("little", "big")) {
    for (many in c(1, 2, 4)) {
      write_ply_binary(path, endian, 8, many, corner = 4)
      cube(body_mesh(path, density_kg_m3 = 1), 1e-14)
      write_ply_binary(path, endian, 4, many, corner = many)
      cube(body_mesh(path, density_kg_m3 = 1), 1e-6)
    }
  }
})

test_that("a damaged PLY is refused", {
  path <- tempfile(fileext = ".ply")
  expect_refused <- function(content, says) expect_no_mesh_file(content, ".ply", says)
  write_ply_binary(path, "little")
  bytes <- readBin(path, "raw", 1e5)
  head <- rawToChar(bytes[seq_len(grepRaw("end_header", bytes) + 10)])
  body <- bytes[-seq_len(nchar(head))]
  changed <- function(from, to) c(charToRaw(sub(from, to, head)), body)
  expect_refused(bytes[seq_len(length(bytes) - 5)], "truncated")
  expect_refused(bytes[seq_len(nchar(head) + 3)], "truncated")
  expect_refused(bytes[1:100], "header")
  expect_refused(changed("ply", "plx"), "header")
  expect_refused(changed("binary_little", "binary_middle"), "format")
  expect_refused(changed("float64 y", "float65 y"), "float65")
  expect_refused(changed("float64 y", "float64 u"), "vertices with x, y, z")
  expect_refused(changed("vertex_index", "vertices"), "faces with vertex_indices")
  expect_refused(changed("list uchar uint vertex_index", "uint vertex_index"), "a list")
  expect_refused(changed("face 10", "face 1e9"), "count is wrong")
  expect_refused(changed("element odd 2", "comment"), "precedes all elements")
  expect_refused(changed("face 10", "face -1"), "count is wrong")
  expect_refused(changed("face 10", "face ten"), "count is wrong")
  text <- c(
    "ply", "format ascii 1.0", "element vertex 3", "property float x", "property float y",
    "property float z", "element face 1", "property list uchar int vertex_indices", "end_header",
    "0 0 0", "1 0 0", "0 1 0"
  )
  as_text <- function(last) c(text, last)
  expect_refused(as_text("3 0 1"), "truncated")
  expect_refused(as_text("2 0 1"), "three corners")
  expect_refused(as_text("-3 0 1 2"), "truncated")
  expect_refused(as_text("2.5 0 1 2"), "truncated")
  expect_refused(as_text("3 0 1 b"), "'b'")
  with_nul <- function(at) c(charToRaw(paste0(text, "\n", collapse = "")), charToRaw(at), as.raw(0))
  expect_warning(expect_refused(with_nul("3 0 1 "), "truncated"), NA)
  writeLines(sub("(vertex|face) [31]", "\\1 0", text[1:9]), path)
  expect_error(body_mesh(path, mass_kg = 1), class = "rotdyn_error_mesh")
  writeLines(as_text("3 0 1 7"), path)
  expect_error(body_mesh(path, mass_kg = 1), class = "rotdyn_error_mesh")
})

test_that("names that occur twice are an error of the file", {
  header <- c("ply", "format ascii 1.0", "element vertex 1", "property float x")
  for (more in list(c("property float x"), c("property float y", "element vertex 2"))) {
    path <- tempfile(fileext = ".ply")
    writeLines(c(header, more, "end_header", "0"), path)
    expect_error(body_mesh(path, mass_kg = 1), "of one name", class = "rotdyn_error_file")
  }
})
