# Scenes and records that version 0.5.0 wrote (it took other argument names): they are read, and
# computed again to the same bits. version-0.5.0.csv: texts, hashes, and columns at four times, in
# hexadecimal; version-0.5.0.sqlite.gz: records of these motions.

old_scenes <- function() {
  utils::read.csv(testthat::test_path("version-0.5.0.csv"), colClasses = "character")
}

test_that("scenes of 0.5.0 are read, and move as they did", {
  skip_if_not_installed("yyjsonr")
  all <- old_scenes()
  expect_length(unique(all$scene), 17)
  for (rows in split(all, all$scene)) {
    scene <- read_scene(rows$text[nzchar(rows$text)])
    motion <- trajectory(scene, c(0, 0.3, 1.1, 2))
    expect_identical(glance(motion)$model, rows$model[1], info = rows$scene[1])
    for (i in seq_len(nrow(rows))) {
      was <- strsplit(rows$values[i], " ", fixed = TRUE)[[1]]
      was <- as.double(replace(was, was == "NA", NA))
      now <- motion[[rows$column[i]]]
      info <- paste(rows$scene[i], rows$column[i])
      if (grepl("_(rk8pd|radau)$", rows$model[1])) {
        # Integrators have changed since: within the errors of both.
        expect_equal(now, was, tolerance = 1e-8, info = info)
      } else {
        # Modes of rotors were rounded more: of the shaft's torque at 1.1 s, 4.28321494527952720 N m
        # (mpmath 1.3.0), 0.5.0 had 4.28321494527948055.
        rounded <- if (rows$model[1] == "rotors_modal") 2e-14 else 4e-15
        expect_equal(now, was, tolerance = rounded, info = info)
      }
    }
    # Written anew, it comes back.
    expect_identical(read_scene(write_scene(scene)), scene)
  }
})

test_that("texts of scenes whose arguments kept their names are the same", {
  skip_if_not_installed("yyjsonr")
  all <- old_scenes()
  for (name in c("axle", "pendulum", "hanging", "drive", "incline", "free")) {
    row <- all[all$scene == name & nzchar(all$text), ]
    expect_identical(scene_hash(read_scene(row$text)), row$hash, info = name)
  }
})

test_that("a database of 0.5.0 is checked, listed, read and computed again", {
  for (package in c("yyjsonr", "DBI", "RSQLite")) skip_if_not_installed(package)
  file <- tempfile(fileext = ".sqlite")
  on.exit(unlink(file))
  packed <- gzfile(testthat::test_path("version-0.5.0.sqlite.gz"), "rb")
  writeBin(readBin(packed, "raw", 1e7), file)
  close(packed)
  runs <- records_list(file)
  expect_identical(nrow(runs), 17L)
  records_create(file) # the metadata of this version
  expect_true(all(records_check(file)$holds))
  for (run in runs$run) {
    expect_true(records_rerun(file, run)$verdict %in% c("identical", "within errors"), info = run)
  }
  expect_s3_class(records_read(file, runs$run[1])$scene, "rot_scene")
})
