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

test_that("a damaged STL is refused", {
  refused <- function(content, says) expect_no_mesh_file(content, ".stl", says)
  refused(raw(40), "too short")
  refused(raw(84), "no triangles")
  # Truncated binary files are not taken for texts.
  whole <- tempfile(fileext = ".stl")
  write_stl(tetrahedron3d(), whole)
  bytes <- readBin(whole, "raw", 1e4)
  refused(bytes[-284], "4 triangles, which need 284\\s+bytes, but has\\s+283")
  refused(c(bytes, as.raw(1)), "285")
  bytes[81:84] <- as.raw(255)
  refused(bytes, "4,294,967,295")
  facet <- c("facet normal 0 0 1", "outer loop", rep("vertex 0 1 2", 3), "endloop", "endfacet")
  refused("solid nothing", "no facets")
  refused(c("solid", facet[-3]), "three vertices")
  refused(c("solid", facet, facet[1:4]), "truncated")
  refused(c("solid", sub("1 2", "1", facet)), "3 elements")
  refused(c("solid", sub("1 2", "1 x", facet)), "'x'")
})
