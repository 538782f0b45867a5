tetrahedron3d <- function() {
  vertices <- rbind(c(0, 1, 0, 0), c(0, 0, 2, 0), c(0, 0, 0, 3), 1)
  faces <- cbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  structure(list(vb = vertices, it = faces), class = c("mesh3d", "shape3d"))
}

as_pair <- function(mesh) list(vertices = t(mesh$vb[1:3, ]), faces = t(mesh$it))

test_that("a mesh3d is read as it is: triangles, quadrangles, a fourth coordinate", {
  one <- body_mesh(tetrahedron3d(), density_kg_m3 = 1)
  expect_equal(one$mass_kg, 1, tolerance = 1e-15)
  pair <- as_pair(tetrahedron3d())
  expect_equal(body_mesh(pair, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  scaled <- tetrahedron3d()
  scaled$vb <- scaled$vb * rep(c(2, 4, 0.5, 8), each = 4)
  expect_equal(body_mesh(scaled, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  flat <- tetrahedron3d()
  flat$vb <- flat$vb[1:3, ]
  expect_equal(body_mesh(flat, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  integers <- tetrahedron3d()
  storage.mode(integers$it) <- "integer"
  expect_equal(body_mesh(integers, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  cube <- structure(
    list(
      vb = rbind(t(expand.grid(0:1, 0:1, 0:1)), 1),
      ib = cbind(
        c(1, 3, 4, 2), c(5, 6, 8, 7), c(1, 2, 6, 5), c(3, 7, 8, 4), c(1, 5, 7, 3), c(2, 4, 8, 6)
      )
    ),
    class = "mesh3d"
  )
  body <- body_mesh(cube, density_kg_m3 = 6)
  expect_equal(unname(diag(body$inertia_kg_m2)), rep(1, 3), tolerance = 1e-15)
  # Both in one: a quadrangle as two triangles.
  cube$it <- matrix(c(2, 4, 8, 2, 8, 6), 3)
  cube$ib <- cube$ib[, -6]
  expect_equal(body_mesh(cube, density_kg_m3 = 6)$inertia_kg_m2, body$inertia_kg_m2)
  no_faces <- structure(list(vb = cube$vb), class = "mesh3d")
  expect_error(body_mesh(no_faces, mass_kg = 1), class = "rotdyn_error_mesh")
})

test_that("vertices come as a data frame, with units, and in an unnamed list", {
  pair <- as_pair(tetrahedron3d())
  one <- body_mesh(pair, density_kg_m3 = 1)
  frame <- stats::setNames(as.data.frame(pair$vertices), c("x_m", "y_m", "z_m"))
  unnamed <- list(frame, pair$faces)
  expect_equal(body_mesh(unnamed, density_kg_m3 = 1)$inertia_kg_m2, one$inertia_kg_m2)
  turned <- list(faces = as.data.frame(pair$faces), vertices = frame)
  expect_equal(body_mesh(turned, density_kg_m3 = 1)$mass_kg, 1, tolerance = 1e-15)
  expect_error(
    body_mesh(list(frame, pair$faces), mass_kg = 1, length_unit = "mm"),
    class = "rotdyn_error_unit"
  )
  names(frame) <- c("x", "y", "z")
  expect_equal(
    body_mesh(list(frame, pair$faces), density_kg_m3 = 1, length_unit = "mm")$mass_kg, 1e-9,
    tolerance = 1e-14
  )
  skip_if_not_installed("units")
  pair$vertices <- units::set_units(pair$vertices * 100, "cm")
  expect_equal(body_mesh(pair, density_kg_m3 = 1)$mass_kg, 1, tolerance = 1e-14)
  # Their own unit holds, whatever that of plain numbers is.
  expect_equal(
    body_mesh(pair, density_kg_m3 = 1, length_unit = "cm")$mass_kg, 1,
    tolerance = 1e-14
  )
  columns <- data.frame(x = pair$vertices[, 1], y = pair$vertices[, 2], z = pair$vertices[, 3])
  expect_equal(
    body_mesh(list(columns, pair$faces), density_kg_m3 = 1, length_unit = "mm")$mass_kg, 1,
    tolerance = 1e-14
  )
  pair$vertices <- units::set_units(units::drop_units(pair$vertices), "kg")
  expect_error(body_mesh(pair, mass_kg = 1), class = "rotdyn_error_unit")
})

test_that("what is no mesh is said so", {
  pair <- as_pair(tetrahedron3d())
  broken <- list(
    NULL, 1:3, data.frame(x = 1), list(1), list(points = 1, faces = 2),
    list(vertices = "a", faces = pair$faces),
    list(vertices = pair$vertices[, 1:2], faces = pair$faces),
    list(vertices = pair$vertices, faces = pair$faces[, 1:2]),
    list(vertices = pair$vertices, faces = pair$faces == 1),
    list(vertices = pair$vertices, faces = array(as.character(pair$faces), dim(pair$faces))),
    list(vertices = data.frame(x_m = 1, y_m = 2), faces = pair$faces),
    structure(list(vb = "a"), class = "mesh3d"),
    structure(list(vb = pair$vertices, it = 1:3), class = "mesh3d")
  )
  for (mesh in broken) {
    expect_error(body_mesh(mesh, mass_kg = 1), class = "rotdyn_error_type")
    expect_error(check_mesh(mesh), class = "rotdyn_error_type")
  }
})

test_that("what is wrong with a list or a matrix is told", {
  pair <- as_pair(tetrahedron3d())
  expect_error(body_mesh(c(pair, list(normals = 1)), mass_kg = 1), "normals")
  turned <- list(vertices = t(pair$vertices), faces = pair$faces)
  expect_error(body_mesh(turned, mass_kg = 1), "a 3 x 4 double matrix")
  several <- structure(list(tetrahedron3d(), tetrahedron3d()), class = "shapelist3d")
  expect_error(body_mesh(several, mass_kg = 1), "<shapelist3d> object")
})

test_that("units of length are known by name, or to the package units", {
  expect_equal(metres_in("in", NULL), 0.0254)
  expect_equal(metres_in("m", NULL), 1)
  skip_if_not_installed("units")
  expect_equal(metres_in("furlong", NULL), 201.168, tolerance = 1e-5)
  expect_error(metres_in("second", NULL), class = "rotdyn_error_unit")
  expect_error(metres_in("no such unit", NULL), class = "rotdyn_error_unit")
})

# ---- files --------------------------------------------------------------------------------------

# 80 bytes, the number of triangles; for each a normal, three corners, two bytes.
write_stl <- function(mesh, path, header = "solid as many begin") {
  con <- file(path, "wb")
  on.exit(close(con))
  writeBin(c(charToRaw(header), raw(80 - nchar(header))), con)
  writeBin(ncol(mesh$it), con, size = 4, endian = "little")
  for (i in seq_len(ncol(mesh$it))) {
    writeBin(c(0, 0, 0, as.vector(mesh$vb[1:3, mesh$it[, i]])), con, size = 4, endian = "little")
    writeBin(raw(2), con)
  }
}

write_obj <- function(mesh, path) {
  writeLines(c(
    "# a comment", "o thing",
    sprintf("v %.17g %.17g %.17g", mesh$vb[1, ], mesh$vb[2, ], mesh$vb[3, ]),
    sprintf("f %.0f %.0f %.0f", mesh$it[1, ], mesh$it[2, ], mesh$it[3, ])
  ), path)
}

skip_without_reader <- function(...) {
  found <- vapply(c(...), requireNamespace, logical(1), quietly = TRUE)
  if (!any(found)) skip(paste("none of these packages:", paste(c(...), collapse = ", ")))
}

# Without a display rgl needs to be told.
withr_null <- function(env = parent.frame()) {
  old <- options(rgl.useNULL = TRUE)
  do.call(on.exit, list(substitute(options(x), list(x = old)), add = TRUE), envir = env)
}

test_that("a binary STL is read in the numbers it has", {
  withr_null()
  skip_without_reader("rgl")
  mesh <- tetrahedron3d()
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] + 0.1
  path <- tempfile(fileext = ".STL")
  write_stl(mesh, path)
  body <- body_mesh(path, density_kg_m3 = 1)
  expect_equal(body$shape, basename(path))
  expect_equal(body$source, basename(path))
  # 0.1 and 1.1 in single precision, in the file.
  expect_equal(body$mass_kg, 1, tolerance = 1e-6)
  expect_gt(abs(body$mass_kg - 1), 1e-9)
  expect_lte(body$error, 1e-13)
  expect_equal(body$detail$reader, "rgl")
  expect_equal(body_mesh(path, density_kg_m3 = 1, length_unit = "mm")$mass_kg, body$mass_kg * 1e-9)
})

test_that("an OBJ keeps its digits", {
  mesh <- tetrahedron3d()
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] / 7 + 0.1
  path <- tempfile(fileext = ".obj")
  write_obj(mesh, path)
  expect_no_warning(body <- body_mesh(path, mass_kg = 2))
  expect_equal(body$inertia_kg_m2, body_mesh(mesh, mass_kg = 2)$inertia_kg_m2, tolerance = 1e-15)
  expect_equal(body$detail$reader, "rotdyn")
})

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

read_obj_text <- function(lines) {
  path <- tempfile(fileext = ".obj")
  on.exit(unlink(path))
  writeLines(lines, path)
  read_obj(path)
}

test_that("an OBJ may have polygons, negative numbers, colours, and lines that go on", {
  hexagon <- obj_body(prism_obj(cospi(0:5 / 3), sinpi(0:5 / 3), 1))
  expect_equal(hexagon$mass_kg, 1.5 * sqrt(3), tolerance = 1e-14)
  expect_equal(hexagon$detail$faces, 2 * 4 + 6 * 2)
  corner <- prism_obj(c(1, 2, 2, 0.5, 0.5, 0, 0), c(0, 0, 0.5, 0.5, 2, 2, 0), 1)
  angle <- obj_body(corner)
  expect_equal(angle$mass_kg, 1.75, tolerance = 1e-14)
  # Fans across the notch would count its area twice.
  expect_equal(angle$detail$area_m2, 2 * 1.75 + 8, tolerance = 1e-14)
  # Turned, so that no polygon lies along an axis.
  turned <- rotation_rpy(c(0.3, -0.7, 1.2)) %*% read_obj_text(corner)$vb
  lines <- c(
    sprintf("v %.17g %.17g %.17g", turned[1, ], turned[2, ], turned[3, ]),
    grep("^f", corner, value = TRUE)
  )
  expect_equal(obj_body(lines)$detail$area_m2, 11.5, tolerance = 1e-14)
  # A square in a square, cut open along one line: the corners there come twice.
  keyhole <- obj_body(prism_obj(
    c(0, 3, 3, 0, 0, 1, 1, 2, 2, 1), c(0, 0, 3, 3, 0, 1, 2, 2, 1, 1), 1
  ))
  expect_equal(keyhole$mass_kg, 8, tolerance = 1e-14)
  vertices <- c("v 0 0 0 1 0 0", "v 1 0 0 0 1 0", "v 0 2 0 0 0 1", "v 0 0 3 1 1 1")
  faces <- c("f -4/1/1 -2//1 -3/2", "f -4 -3 -1", "f -4 \\", "-1 -2", "f 2 3 4 # the last")
  expect_equal(obj_body(vertices, faces)$mass_kg, 1, tolerance = 1e-15)
  # Negative numbers count from the vertices so far.
  early <- obj_body(vertices, "f -4 -2 -3", "f -4 -3 -1", "f -4 -1 -2", "f -3 -2 -1", "v 9 9 9")
  expect_equal(early$mass_kg, 1, tolerance = 1e-15)
})

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
  expect_refused <- function(bytes, says) {
    writeBin(bytes, path)
    expect_no_warning(
      expect_error(body_mesh(path, mass_kg = 1), says, class = "rotdyn_error_file")
    )
  }
  write_ply_binary(path, "little")
  bytes <- readBin(path, "raw", 1e5)
  head <- rawToChar(bytes[seq_len(grepRaw("end_header", bytes) + 10)])
  body <- bytes[-seq_len(nchar(head))]
  changed <- function(from, to) c(charToRaw(sub(from, to, head)), body)
  expect_refused(bytes[seq_len(length(bytes) - 5)], "cut off")
  expect_refused(bytes[seq_len(nchar(head) + 3)], "cut off")
  expect_refused(bytes[1:100], "header")
  expect_refused(changed("ply", "plx"), "header")
  expect_refused(changed("binary_little", "binary_middle"), "format")
  expect_refused(changed("float64 y", "float65 y"), "float65")
  expect_refused(changed("float64 y", "float64 u"), "vertices with x, y, z")
  expect_refused(changed("vertex_index", "vertices"), "faces with vertex_indices")
  expect_refused(changed("list uchar uint vertex_index", "uint vertex_index"), "a list")
  expect_refused(changed("face 10", "face 1e9"), "count is wrong")
  expect_refused(changed("element odd 2", "comment"), "before all elements")
  expect_refused(changed("face 10", "face -1"), "count is wrong")
  expect_refused(changed("face 10", "face ten"), "count is wrong")
  text <- c(
    "ply", "format ascii 1.0", "element vertex 3", "property float x", "property float y",
    "property float z", "element face 1", "property list uchar int vertex_indices", "end_header",
    "0 0 0", "1 0 0", "0 1 0"
  )
  as_text <- function(last) charToRaw(paste(c(text, last, ""), collapse = "\n"))
  expect_refused(as_text("3 0 1"), "cut off")
  expect_refused(as_text("2 0 1"), "three corners")
  expect_refused(as_text("-3 0 1 2"), "cut off")
  expect_refused(as_text("3 0 1 b"), "'b'")
  writeBin(as_text("3 0 1 7"), path)
  expect_error(body_mesh(path, mass_kg = 1), class = "rotdyn_error_mesh")
})

test_that("files that are none are refused", {
  withr_null()
  odd <- tempfile(fileext = ".xyz")
  writeLines("1 2 3", odd)
  expect_error(body_mesh(odd, mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh(tempdir(), mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh(c(odd, odd), mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh(NA_character_, mass_kg = 1), class = "rotdyn_error_file")
  expect_error(body_mesh("not/there.stl", mass_kg = 1), class = "rotdyn_error_file")
  expect_file <- function(content, extension, says) {
    path <- tempfile(fileext = extension)
    writeBin(content, path)
    expect_no_warning(
      expect_error(body_mesh(path, mass_kg = 1), says, class = "rotdyn_error_file")
    )
  }
  expect_file(raw(), ".stl", "empty")
  expect_file(raw(), ".obj", "empty")
  expect_file(raw(), ".ply", "empty")
  expect_file(raw(40), ".stl", "too short")
  expect_file(raw(84), ".stl", "no triangles")
  expect_file(charToRaw("v 1 2\n"), ".obj", "fewer than three coordinates")
  expect_file(charToRaw("v 1 2 a\n"), ".obj", "no number: a")
  expect_file(charToRaw("v 1 2 3\nf 1 1\n"), ".obj", "fewer than three corners")
  # Binary files that were cut off are no texts.
  whole <- tempfile(fileext = ".stl")
  write_stl(tetrahedron3d(), whole)
  bytes <- readBin(whole, "raw", 1e4)
  expect_file(bytes[-284], ".stl", "4 triangles, which take 284\\s+bytes, and has\\s+283")
  expect_file(c(bytes, as.raw(1)), ".stl", "285")
  bytes[81:84] <- as.raw(255)
  expect_file(bytes, ".stl", "4,294,967,295")
  facet <- c("facet normal 0 0 1", "outer loop", rep("vertex 0 1 2", 3), "endloop", "endfacet")
  expect_text <- function(lines, says) {
    expect_file(charToRaw(paste(lines, collapse = "\n")), ".stl", says)
  }
  expect_text("solid nothing", "no facets")
  expect_text(c("solid", facet[-3]), "three vertices")
  expect_text(c("solid", facet, facet[1:4]), "cut off")
  expect_text(c("solid", sub("1 2", "1", facet)), "3 elements")
  expect_text(c("solid", sub("1 2", "1 x", facet)), "'x'")
})

test_that("an STL may be text", {
  mesh <- tetrahedron3d()
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] / 7 + 0.1
  facets <- apply(mesh$it, 2, function(corner) {
    c(
      " facet normal 0 0 0", "  outer loop",
      apply(mesh$vb[1:3, corner], 2, function(at) {
        sprintf("   VERTEX %.17g\t%.17e %.17g", at[1], at[2], at[3])
      }),
      "  endloop", " endfacet"
    )
  })
  path <- tempfile(fileext = ".STL")
  writeLines(c("solid a vertex of many", facets, "endsolid"), path, sep = "\r\n")
  body <- body_mesh(path, mass_kg = 2)
  want <- body_mesh(mesh, mass_kg = 2)
  expect_equal(body$second_moment_kg_m2, want$second_moment_kg_m2, tolerance = 1e-14)
  expect_equal(body$centre_m, want$centre_m, tolerance = 1e-14)
  expect_equal(body$detail$reader, "rotdyn")
})

test_that("the real meshes have their mass properties, and the bad ones are refused", {
  withr_null()
  skip_without_reader("rgl")
  known <- utils::read.csv(shared("data", "mesh", "mass_properties.csv"))
  expect_gte(nrow(known), 12)
  for (i in seq_len(nrow(known))) {
    want <- known[i, ]
    path <- shared("data", "mesh", want$file)
    if (grepl("^BAD", want$file)) {
      error <- tryCatch(body_mesh(path, density_kg_m3 = 1), error = identity)
      expect_s3_class(error, "rotdyn_error_mesh")
      counts <- error$check$count[error$check$verdict == "fails"]
      expect_equal(counts[1], want$bad_edges)
      next
    }
    body <- body_mesh(path, density_kg_m3 = 1, length_unit = "m")
    inertia <- matrix(
      unlist(want[c("Ixx", "Ixy", "Ixz", "Ixy", "Iyy", "Iyz", "Ixz", "Iyz", "Izz")]), 3
    )
    # The figures were made about the origin: misc_busted lies five of its sizes away from it.
    most <- if (want$file == "misc_busted.STL") 2e-14 else 4e-15
    expect_lte(max(abs(body$inertia_kg_m2 - inertia)) / sum(diag(inertia)), most)
    expect_equal(body$mass_kg, want$mass, tolerance = 4e-15)
    expect_equal(body$detail$area_m2, want$area, tolerance = 4e-15)
    expect_lte(max(abs(body$centre_m - unlist(want[c("cx", "cy", "cz")]))), 4e-15 * 30)
    expect_lte(body$error, 1e-12)
  }
})
