skip_if_not_installed("mirai")
skip_if_not_installed("nanoparquet")
skip_if_not_installed("yyjsonr")
skip_on_cran()

wheel <- scene_axle(
  body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
)
plan <- sweep_plan(
  wheel, 400, design_sobol(6 * 2^16 + 5, seed = 42,
    "body$mass_kg" = vary_normal(2, 0.02), "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)
  ), outputs = "final_theta_rad", chunk_rows = 2^16, keep = "summary"
)
profile <- "rotdyn-tests"

# One daemon started by this process, ended with the test.
with_daemon <- function(code) {
  mirai::daemons(1, .compute = profile)
  on.exit(mirai::daemons(0, .compute = profile))
  force(code)
}

test_that("no daemon is used that the user has not set", {
  expect_false(has_daemons("rotdyn-none"))
})

test_that("daemons compute the rows that this process does, also when one is killed", {
  digest <- sweep_digest(sweep_run(plan))
  folder <- tempfile("sweep-")
  with_daemon({
    expect_true(has_daemons(profile))
    pid <- mirai::call_mirai(mirai::mirai(Sys.getpid(), .compute = profile))$data
    kept <- sweep_run(plan, folder, compute = profile)
    expect_false(identical(pid, Sys.getpid()))
    expect_identical(sweep_digest(kept), digest)
    expect_identical(dir(file.path(folder, "work")), character())
    expect_identical(sort(dir(folder)), c("rows", "run.json", "sums", "work"))
    # Two parts are lost, and the daemon with them; another one joins.
    unlink(file.path(folder, "sums", part_name(c(2, 5))))
    tools::pskill(pid, tools::SIGKILL)
    mirai::launch_local(1, .compute = profile)
    expect_identical(sweep_digest(sweep_resume(folder, compute = profile)), digest)
  })
  unlink(folder, recursive = TRUE)
})

test_that("a daemon with other bits stops the sweep; an error of a row's function does, too", {
  folder <- tempfile("sweep-")
  make_sweep_folder(plan, folder, environment())
  path <- file.path(folder, "run.json")
  writeLines(sub("\"canary\": \"....", "\"canary\": \"0000", readLines(path)), path)
  refused <- sweep_task(folder, 1, 1, "run.json")
  expect_identical(refused$kind, "rotdyn_error_canary")
  expect_identical(sweep_task(folder, 1, 1, "nonce")$kind, "rotdyn_error_file")
  expect_identical(dir(file.path(folder, "sums")), character())
  unlink(folder, recursive = TRUE)
  state <- list2env(list(
    queue = double(), flying = list(), tries = list(), failed = list(), took = double(), done = 0
  ))
  lost <- list(chunk = 3, task = list(data = structure(19L, class = c("errorValue", "try-error"))))
  take_landed(lost, state, folder, environment())
  take_landed(lost, state, folder, environment())
  expect_identical(state$queue, c(3, 3))
  take_landed(lost, state, folder, environment())
  expect_identical(state$failed[[1]][[1]], 3)
  bad <- list(chunk = 4, task = list(data = list(failed = "no", kind = "simpleError", host = "h")))
  take_landed(bad, state, folder, environment())
  expect_length(state$failed, 2)
  expect_error(abort_failed_chunks(state$failed, environment()), "2 chunks",
               class = "rotdyn_error_chunks")
  bad$task$data$kind <- "rotdyn_error_canary"
  expect_error(take_landed(bad, state, folder, environment()), class = "rotdyn_error_canary")
  bad$task$data$kind <- "no_rotdyn"
  expect_error(take_landed(bad, state, folder, environment()), class = "rotdyn_error_package")
})
