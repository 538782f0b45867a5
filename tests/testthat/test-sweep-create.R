skip_if_not_installed("nanoparquet")
skip_if_not_installed("yyjsonr")

plan <- sweep_plan(
  scene_axle(0.0625, resistance = resistance(0.002), omega0_rad_per_s = 20), time_s = 60,
  design_grid(omega0_rad_per_s = c(10, 20))
)

test_that("the folder has no row, and all are computed afterwards", {
  folder <- tempfile("sweep")
  on.exit(unlink(folder, recursive = TRUE))
  expect_identical(expect_invisible(sweep_create(plan, folder)), folder)
  expect_identical(sweep_status(folder)$rows_done, 0)
  expect_equal(sweep_todo(folder), 1)
  # Again: nothing changes.
  before <- readLines(file.path(folder, "run.json"))
  sweep_create(plan, folder)
  expect_identical(readLines(file.path(folder, "run.json")), before)
  sweep_work(folder, 1, 2)
  expect_identical(sweep_digest(sweep_read(folder)), sweep_digest(sweep_run(plan)))
})

test_that("another plan, a folder with other files, and no plan are refused", {
  folder <- tempfile("sweep")
  on.exit(unlink(folder, recursive = TRUE))
  sweep_create(plan, folder)
  other <- sweep_plan(
    scene_axle(0.0625), time_s = 60, design_grid(omega0_rad_per_s = c(10, 20))
  )
  expect_error(sweep_create(other, folder), class = "rotdyn_error_folder")
  full <- tempfile("full")
  dir.create(full)
  on.exit(unlink(full, recursive = TRUE), add = TRUE)
  file.create(file.path(full, "a"))
  expect_error(sweep_create(plan, full), class = "rotdyn_error_file")
  expect_error(sweep_create(1, full), class = "rotdyn_error_type")
  expect_error(sweep_create(plan, full, 1), class = "rotdyn_error_argument")
})
