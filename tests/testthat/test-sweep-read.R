skip_if_not_installed("nanoparquet")
skip_if_not_installed("yyjsonr")

wheel <- scene_axle(
  body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
)
design <- design_sobol(3 * 2^16 + 77, seed = 5,
  "body$mass_kg" = vary_normal(2, 0.02), "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)
)
plan <- sweep_plan(
  wheel, 400, design, outputs = c("final_theta_rad", "stop_time_s"), chunk_rows = 2^16
)

test_that("a folder has the rows of memory, by any chunks", {
  memory <- sweep_run(plan)
  folder <- folder_of()
  kept <- sweep_run(plan, folder)
  expect_identical(as.list(kept), as.list(memory), ignore_attr = TRUE)
  expect_identical(sweep_digest(kept), sweep_digest(memory))
  expect_identical(sweep_digest(folder), sweep_digest(memory))
  expect_identical(dir(file.path(folder, "work")), character())
  larger <- plan
  larger$chunk_rows <- 2^18
  expect_identical(sweep_digest(sweep_run(larger, folder_of())), sweep_digest(memory))
  expect_identical(sweep_digest(sweep_run(plan, threads = 2)), sweep_digest(memory))
  other <- sweep_plan(wheel, 3, design, outputs = c("final_theta_rad", "stop_time_s"))
  expect_false(identical(sweep_digest(sweep_run(other)), sweep_digest(memory)))
})

test_that("what is missing, cut or damaged is found and computed again", {
  folder <- folder_of()
  digest <- sweep_digest(sweep_run(plan, folder))
  expect_identical(nrow(sweep_check(folder, chunks = 4)), 0L)
  part <- function(kind, i) file.path(folder, kind, part_name(i))
  before <- file.mtime(part("sums", 4))
  unlink(part("sums", 1))
  bytes <- readBin(part("rows", 2), "raw", 1e8)
  writeBin(bytes[1:1000], part("rows", 2))
  writeBin(raw(), part("sums", 3))
  expect_identical(sweep_todo(folder), c(1, 2, 3))
  expect_error(sweep_read(folder), "3 of 4 chunks", class = "rotdyn_error_file")
  expect_identical(sweep_digest(sweep_resume(folder)), digest)
  expect_identical(file.mtime(part("sums", 4)), before)
  # A bit flipped among the numbers of the rows; in the sums.
  bytes <- readBin(part("rows", 2), "raw", 1e8)
  bytes[50000] <- xor(bytes[50000], as.raw(1))
  writeBin(bytes, part("rows", 2))
  expect_identical(sweep_check(folder, chunks = 0)$chunk, 2)
  bytes <- readBin(part("sums", 4), "raw", 1e8)
  bytes[length(bytes) %/% 2] <- xor(bytes[length(bytes) %/% 2], as.raw(4))
  writeBin(bytes, part("sums", 4))
  expect_identical(sweep_check(folder, chunks = 0)$chunk, c(2, 4))
})

test_that("a folder of another plan says what differs", {
  folder <- folder_of()
  sweep_run(plan, folder)
  other <- sweep_plan(wheel, 300, design, outputs = c("final_theta_rad", "stop_time_s"))
  expect_error(sweep_run(other, folder), "time_s", class = "rotdyn_error_folder")
  stranger <- folder_of()
  dir.create(stranger)
  writeLines("x", file.path(stranger, "x"))
  expect_error(sweep_run(plan, stranger), "not empty", class = "rotdyn_error_file")
  expect_error(sweep_read(stranger), "run.json", class = "rotdyn_error_file")
  writeLines("{}", file.path(stranger, "run.json"))
  expect_error(sweep_read(stranger), class = "rotdyn_error_file")
})

test_that("a machine with other bits is refused", {
  folder <- folder_of()
  sweep_run(plan, folder)
  path <- file.path(folder, "run.json")
  text <- sub("\"canary\": \"....", "\"canary\": \"0000", readLines(path))
  writeLines(text, path)
  unlink(file.path(folder, "sums", part_name(1)))
  expect_error(sweep_resume(folder), class = "rotdyn_error_canary")
  expect_error(sweep_chunk(folder, 1), class = "rotdyn_error_canary")
  expect_error(sweep_work(folder, 1, 2), class = "rotdyn_error_canary")
})

test_that("jobs of an array do all chunks, in any order", {
  folder <- folder_of()
  make_sweep_folder(plan, folder, environment())
  for (part in c(3, 1, 2)) {
    receipts <- sweep_work(folder, part, 3)
    expect_identical(receipts$chunk, if (part == 1) c(1, 4) else as.double(part))
  }
  expect_identical(sweep_todo(folder), double())
  status <- sweep_status(folder)
  expect_identical(c(status$rows_done, status$chunks_done), c(plan$n, 4))
  expect_identical(sweep_digest(folder), sweep_digest(sweep_run(plan)))
})

test_that("a process number that was given again is no writer, and no owner", {
  skip_if(!dir.exists("/proc/self"))
  folder <- folder_of()
  make_sweep_folder(plan, folder, environment())
  host <- Sys.info()[["nodename"]]
  lives <- paste0("1.", birth_of_process(1))
  skip_if(lives == "1.", "process 1 is not seen")
  own_folder(folder, environment())
  tags <- c(lives, "1.999999999999", "1", process_tag())
  names <- paste0("rows-part-00000001.parquet-", host, "-", tags, "-x")
  file.create(file.path(folder, "work", names))
  clear_work(folder)
  expect_identical(sort(dir(file.path(folder, "work"))), sort(names[c(1, 3)]))
  unlink(file.path(folder, "work", names))
  owner <- function(process) {
    text <- json_text(c(list(who = paste(host, "process 1")), process))
    writeLines(text, file.path(folder, "owner.json"))
    own_folder(folder, environment())
  }
  expect_no_warning(owner(list(process = tags[2])))
  expect_warning(owner(list(process = lives)), "at work", class = "rotdyn_warning_folder")
  expect_warning(owner(NULL), "at work", class = "rotdyn_warning_folder")
  expect_no_warning(owner(list(process = tags[2])))
})

test_that("some rows, or none, are kept; the sums are of all", {
  outputs <- c("final_theta_rad", "stop_time_s")
  all <- sweep_run(plan)
  some <- sweep_plan(wheel, 400, design, outputs = outputs, keep = ~ final_theta_rad > 900)
  none <- sweep_plan(wheel, 400, design, outputs = outputs, keep = "summary")
  folder <- folder_of()
  kept <- sweep_run(some, folder)
  want <- all[all$final_theta_rad > 900, ]
  expect_gt(nrow(kept), 10)
  expect_identical(kept$row, want$row)
  expect_identical(kept$final_theta_rad, want$final_theta_rad)
  expect_identical(sweep_run(some)$row, want$row)
  expect_identical(nrow(sweep_run(none)), 0L)
  figures <- function(x) as.list(summary(x))[c("mean", "sd", "p50", "min_row")]
  expect_identical(figures(kept), figures(all))
  expect_identical(figures(sweep_run(none)), figures(all))
  expect_identical(nrow(sweep_read(folder, rows = 5)), 5L)
})

test_that("the scene of any row can be had back", {
  sweep <- sweep_run(plan)
  at <- which.max(sweep$final_theta_rad)
  again <- trajectory(sweep_scene(sweep, at), c(0, 400))
  expect_identical(again$theta_rad[2], sweep$final_theta_rad[at])
  expect_error(sweep_scene(sweep, 0), class = "rotdyn_error_value")
  expect_error(sweep_scene(sweep, plan$n + 1), class = "rotdyn_error_value")
})

test_that("R functions of a folder run where they are trusted", {
  folder <- folder_of()
  built <- sweep_plan(NULL, 3, design_list(data.frame(m = 1:300 / 100)),
    build = function(row) scene_axle(row$m, 0.2), chunk_rows = 256
  )
  digest <- sweep_digest(sweep_run(built, folder))
  unlink(file.path(folder, "sums", part_name(2)))
  expect_error(sweep_resume(folder), "trust", class = "rotdyn_error_folder")
  expect_identical(sweep_digest(sweep_resume(folder, trust = TRUE)), digest)
  expect_identical(sweep_scene(folder, 7, trust = TRUE)$body, 0.07)
  changed <- sweep_plan(NULL, 3, design_list(data.frame(m = 1:300 / 100)),
    build = function(row) scene_axle(row$m, 0.3), chunk_rows = 256
  )
  expect_error(sweep_run(changed, folder), class = "rotdyn_error_folder")
})

test_that("the parts are Parquet files that other readers take", {
  folder <- folder_of()
  sweep <- sweep_run(plan, folder)
  part <- nanoparquet::read_parquet(file.path(folder, "rows", part_name(2)))
  at <- 2^16 + seq_len(nrow(part))
  expect_identical(part$final_theta_rad, sweep$final_theta_rad[at])
  expect_identical(part$row, sweep$row[at])
  about <- nanoparquet::read_parquet_metadata(file.path(folder, "rows", part_name(2)))
  expect_true("rotdyn_run" %in% about$file_meta_data$key_value_metadata[[1]]$key)
})

test_that("parts have the doubles of memory to the last bit, also -0, NaN, Inf and denormals", {
  bits <- function(x) writeBin(x, raw(), endian = "little")
  edges <- c(20, 0, -0, 5e-324, -5e-324, 2.2e-308, -1e-310, 1e308, -20)
  n <- 2^16 + 77
  edge_plan <- sweep_plan(
    scene_axle(0.0625, resistance = resistance(0.1)), 1,
    design_list(data.frame(
      omega0_rad_per_s = rep_len(edges, n), theta0_rad = rep_len(c(0, -0, 1e-320, -1), n)
    )),
    outputs = c("final_theta_rad", "final_omega_rad_per_s", "stop_time_s"), chunk_rows = 2^16
  )
  memory <- sweep_run(edge_plan)
  outputs <- unlist(memory[edge_plan$outputs])
  expect_true(all(c(
    any(is.nan(outputs)), any(is.infinite(outputs)), any(1 / outputs == -Inf, na.rm = TRUE),
    any(outputs != 0 & abs(outputs) < 2^-1022, na.rm = TRUE)
  )))
  folder <- folder_of()
  kept <- sweep_run(edge_plan, folder)
  for (column in names(memory)[vapply(memory, is.double, NA)]) {
    expect_true(identical(bits(kept[[column]]), bits(memory[[column]])), label = column)
  }
  expect_identical(nrow(sweep_check(folder)), 0L)
})

test_that("a digest is of all rows, kept or not", {
  digest <- function(keep) {
    sweep_digest(sweep_run(sweep_plan(
      scene_axle(1, omega0_rad_per_s = 1), 1, design_grid(body = 1:3), keep = keep
    )))
  }
  expect_identical(digest("summary"), digest("rows"))
  expect_identical(digest(~ body > 1), digest("rows"))
})
