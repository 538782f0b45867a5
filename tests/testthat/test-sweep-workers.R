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

test_that("a daemon with other bits, or another folder, says so before it writes", {
  folder <- tempfile("sweep-")
  made <- make_sweep_folder(plan, folder, environment())
  job <- function(nonce, hash = made$hash) {
    if (!is.null(nonce)) file.create(file.path(folder, "work", nonce))
    daemon_state$nonce <- NULL
    list(folder = folder, chunk = 1, threads = 1, nonce = nonce, hash = hash, wait_s = 0.2)
  }
  path <- file.path(folder, "run.json")
  right <- readLines(path)
  writeLines(sub("\"canary\": \"....", "\"canary\": \"0000", right), path)
  expect_identical(chunk_on_daemon(job("nonce-1"))$class[1], "rotdyn_error_canary")
  writeLines(right, path)
  expect_identical(chunk_on_daemon(job("nonce-2", "another"))$class[1], "rotdyn_error_folder")
  elsewhere <- job(NULL)
  elsewhere$nonce <- "nonce-of-another-host"
  expect_identical(chunk_on_daemon(elsewhere)$class[1], "rotdyn_error_folder")
  expect_identical(dir(file.path(folder, "sums")), character())
  receipt <- chunk_on_daemon(job("nonce-3"))
  expect_identical(receipt$rows, 2^16)
  expect_identical(dir(file.path(folder, "sums")), part_name(1))
  unlink(folder, recursive = TRUE)
})

# A coordinator of a folder, without daemons: receipts are given to it by hand.
coordinator <- function() {
  folder <- folder_of(parent.frame())
  made <- make_sweep_folder(plan, folder, environment())
  new_coordination(made, folder, as.double(1:7), 1, profile, environment())
}

error_value <- function(x) structure(as.integer(x), class = c("errorValue", "try-error"))

test_that("a chunk whose daemon is lost is given out again, twice; an error of R is not", {
  run <- coordinator()
  for (i in 1:2) {
    take_receipt(run, 3, error_value(19))
    expect_identical(run$again, rep(3, i))
  }
  expect_identical(run$left, 7L)
  take_receipt(run, 3, error_value(7))
  expect_identical(run$failed[[1]][[1]], 3)
  expect_match(conditionMessage(run$failed[[1]][[2]]), "lost, 3 times")
  take_receipt(run, 4, list(class = "simpleError", message = "no", who = "h"))
  expect_length(run$failed, 2)
  expect_identical(run$left, 5)
  # A late receipt of a chunk that is closed changes nothing.
  take_receipt(run, 4, list(chunk = 4, seconds = 1))
  expect_identical(run$left, 5)
  take_receipt(run, 5, list(chunk = 5, seconds = 1))
  expect_identical(run$left, 4)
  expect_error(abort_failed_chunks(run$failed, environment()), "2 chunks",
               class = "rotdyn_error_chunks")
  for (kind in c("canary", "file", "folder")) {
    bad <- list(class = c(paste0("rotdyn_error_", kind), "error"), message = "why", who = "h")
    expect_error(take_receipt(run, 6, bad), "h", class = bad$class[1])
  }
})

test_that("a chunk that takes too long is given out a second time, and what waits is not overdue", {
  run <- coordinator()
  run$seconds <- c(1, 2, 3)
  task <- function(chunk, since) list(task = NULL, chunk = chunk, since = since, doubled = FALSE)
  run$flight <- list(task(1, 0), task(2, 75))
  mark_overdue(run, 80)
  expect_identical(run$again, double())
  mark_overdue(run, 81)
  expect_identical(run$again, 1)
  mark_overdue(run, 120)
  expect_identical(run$again, 1)
  expect_identical(vapply(run$flight, `[[`, NA, "doubled"), c(TRUE, FALSE))
})

test_that("no daemon waits for the coordinator, which looks seldom where chunks are long", {
  run <- coordinator()
  for (chunk_s in c(0, 1e-3, 0.02, 0.3, 2, 1e4)) {
    take_receipt(run, 1, list(chunk = 1, seconds = chunk_s))
    run$open[1] <- TRUE
    at_hand_s <- run$ahead * chunk_s
    expect_lte(run$pause, max(0.001, at_hand_s / 2))
    expect_lte(run$ahead, 16)
    expect_gte(run$ahead, 1)
    expect_gte(run$pause, min(5, 0.125, 8 * chunk_s))
    expect_gte(run$pause, min(5, chunk_s / 2))
  }
  expect_identical(run$pause, 5)
})

test_that("the median of the last 99 receipts tells what is overdue", {
  run <- coordinator()
  for (chunk_s in c(rep(1e3, 99), 1:99)) {
    take_receipt(run, 1, list(chunk = 1, seconds = chunk_s))
    run$open[1] <- TRUE
  }
  expect_identical(sort(run$seconds), as.double(1:99))
})

test_that("a daemon without its packages gets a message, and all of them an error", {
  run <- coordinator()
  lacks <- list(class = c("rotdyn_error_package", "error"), message = "no rotdyn", who = "h 1")
  expect_message(take_receipt(run, 2, lacks), "R_LIBS", class = "rotdyn_message_sweep")
  expect_no_message(take_receipt(run, 2, lacks))
  expect_identical(run$again, c(2, 2))
  run$unable_since <- 100
  run$connections <- 2L
  expect_no_error(give_up_on_unable(run, 120))
  run$connections <- 1L
  expect_no_error(give_up_on_unable(run, 109))
  expect_error(give_up_on_unable(run, 110), "everywhere", class = "rotdyn_error_package")
  run$able <- TRUE
  expect_no_error(give_up_on_unable(run, 120))
})

test_that("a run without a daemon says so once, after a minute, and waits", {
  mirai::daemons(url = mirai::local_url(), .compute = profile)
  on.exit(mirai::daemons(0, .compute = profile))
  run <- coordinator()
  expect_no_message(look_at_daemons(run, 0))
  expect_no_message(look_at_daemons(run, 59))
  expect_message(
    look_at_daemons(run, 61), "interrupt.*launch_local.*sweep_resume",
    class = "rotdyn_message_sweep"
  )
  expect_no_message(look_at_daemons(run, 200))
})

test_that("a daemon that is there is counted, and a wait for one is over", {
  run <- coordinator()
  run$nobody_since <- 0
  with_daemon({
    mirai::call_mirai(mirai::mirai(1, .compute = profile))
    look_at_daemons(run, 100)
  })
  expect_identical(run$connections, 1L)
  expect_null(run$nobody_since)
})

test_that("a profile without daemons is refused", {
  folder <- tempfile("sweep-")
  expect_error(sweep_run(plan, folder, compute = "rotdyn-none"), class = "rotdyn_error_argument")
  unlink(folder, recursive = TRUE)
})
