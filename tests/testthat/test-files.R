test_that("names of files", {
  bytes <- "a\xff"
  Encoding(bytes) <- "bytes"
  for (name in list(1, "", NA_character_, c("a", "b"), NULL, bytes)) {
    expect_error(write_scene(scene_axle(1, 1), name %||% list()), class = "rotdyn_error_type")
    expect_error(metadata_sql(name %||% list()), class = "rotdyn_error_type")
  }
})

test_that("what cannot be written says so, without a warning of R's own", {
  skip_if_not_installed("yyjsonr")
  for (name in c(file.path(tempfile("none"), "a"), strrep("long ", 2000))) {
    expect_error(
      expect_no_warning(write_scene(scene_axle(1, 1), name)), class = "rotdyn_error_file"
    )
    expect_error(expect_no_warning(metadata_sql(name)), class = "rotdyn_error_file")
  }
  path <- tempfile()
  write_scene(scene_axle(1, 1), path)
  expect_identical(read_scene(path), scene_axle(1, 1))
})
