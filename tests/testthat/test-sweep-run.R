# Runs of sweeps: interrupts, two at a time, rows that fail, arguments.

need_folders <- function() {
  skip_if_not_installed("nanoparquet")
  skip_if_not_installed("yyjsonr")
}
wheel <- scene_axle(
  body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
)
rows_of <- function(...) design_list(data.frame(..., check.names = FALSE))

# ---- interrupts ---------------------------------------------------------------------------------

test_that("an interrupt in the first or the last chunk says how far it is, and loses no part", {
  skip_on_cran()
  skip_on_os("windows")
  need_folders()
  plan <- gated_plan()
  wanted <- sweep_digest(sweep_run(plan))
  begin <- function(row, done, before = character()) {
    folder <- tempfile("sweep-")
    gate <- new_gate(row, parent.frame(2))
    run <- sprintf("sweep_run(plan, %s)", deparse(folder))
    process <- start_process(c(gate$lines, before, run), plan)
    list(folder = folder, gate = gate, process = process, done = done)
  }
  runs <- list(begin(5, 0), begin(280, 1))
  if (requireNamespace("mirai", quietly = TRUE)) {
    runs <- c(runs, list(begin(280, 1, "mirai::daemons(1)")))
  }
  for (run in runs) {
    expect_true(wait_until(run$gate$waiting()))
    stop_process(run$process)
    expect_true(wait_until(has_said(run$process, ended)))
    said <- words_of(run$process)
    expect_match(said, paste(run$done, "of 2 chunks are done"))
    expect_match(said, "sweep_resume")
    expect_match(said, "interrupted")
    expect_identical(fault_of_parts(run$folder, plan), "")
    expect_length(dir(file.path(run$folder, "sums")), run$done)
    expect_identical(sweep_digest(sweep_resume(run$folder, trust = TRUE)), wanted)
    expect_identical(sort(dir(run$folder)), c("functions.rds", "rows", "run.json", "sums", "work"))
    expect_identical(dir(file.path(run$folder, "work")), character())
    unlink(run$folder, recursive = TRUE)
  }
})

test_that("an interrupt stops rows in memory, those of C and those of R", {
  skip_on_cran()
  skip_on_os("windows")
  gate <- new_gate(5)
  of_r <- start_process(c(gate$lines, "sweep_run(plan)"), gated_plan(20))
  # Some minutes of C, in one chunk.
  long <- sweep_plan(
    wheel, 400, design_random(2^28, seed = 1, omega0_rad_per_s = vary_normal(20, 1)),
    keep = "summary", chunk_rows = 2^28
  )
  begun <- tempfile()
  of_c <- start_process(c(
    sprintf("folder <- %s", deparse(begun)),
    "if (requireNamespace('nanoparquet', quietly = TRUE)) sweep_run(plan, folder)",
    "dir.create(folder)", "sweep_run(plan)"
  ), long)
  on.exit(unlink(begun, recursive = TRUE), add = TRUE)
  expect_true(wait_until(gate$waiting()))
  stop_process(of_r)
  begins <- if (requireNamespace("nanoparquet", quietly = TRUE)) "owner.json" else ""
  expect_true(wait_until(function() file.exists(file.path(begun, begins))))
  Sys.sleep(0.3)
  stop_process(of_c)
  expect_true(wait_until(has_said(of_r, ended)))
  expect_true(wait_until(has_said(of_c, ended)))
  expect_match(words_of(of_r), "interrupted")
  expect_match(words_of(of_c), "interrupted")
  expect_identical(dir(file.path(begun, c("work", "sums"))), character())
})

# ---- two at a time ------------------------------------------------------------------------------

test_that("two coordinators of one folder do no harm, and the second is warned", {
  skip_on_cran()
  need_folders()
  plan <- gated_plan()
  folder <- sweep_folder()
  gate <- new_gate(5)
  run <- c(gate$lines, sprintf("sweep_run(plan, %s)", deparse(folder)))
  first <- start_process(run, plan)
  expect_true(wait_until(gate$waiting()))
  second <- start_process(run, plan)
  expect_true(wait_until(gate$waiting(2)))
  expect_match(sweep_status(folder)$owner, readLines(second$pid))
  unlink(gate$file)
  expect_true(wait_until(has_said(first, ended)))
  expect_true(wait_until(has_said(second, ended)))
  expect_identical(words_of(first), "ended ")
  expect_match(words_of(second), paste("Another process.*process", readLines(first$pid)))
  expect_match(words_of(second), "ended")
  expect_whole_folder(folder, plan, sweep_digest(sweep_run(plan)))
})

test_that("the file of an owner counts while its process lives", {
  need_folders()
  plan <- small_plan(2)
  folder <- sweep_folder()
  digest <- sweep_digest(sweep_run(plan, folder))
  owner <- function(text, use) {
    unlink(sums_file(folder, 1))
    writeLines(text, file.path(folder, "owner.json"))
    use(expect_identical(sweep_digest(sweep_resume(folder)), digest))
    expect_false(file.exists(file.path(folder, "owner.json")))
  }
  of <- function(host, pid) sprintf("{\"who\": \"%s process %s\"}", host, pid)
  warned <- function(code) expect_warning(code, "Another process", class = "rotdyn_warning_folder")
  here <- Sys.info()[["nodename"]]
  # No process has this number on Linux.
  if (dir.exists("/proc/self")) owner(of(here, 2^22 + 1), expect_no_warning)
  owner(of(here, Sys.getpid()), expect_no_warning)
  owner(of("another-host", 1), warned)
  owner(of(here, 1), warned)
  for (torn in list("", "{\"who", "{\"who\": 3}", "{{.pkg x}}")) owner(torn, warned)
  # The file of a coordinator that came later stays.
  writeLines(of("another-host", 1), file.path(folder, "owner.json"))
  disown_folder(folder)
  expect_identical(sweep_status(folder)$owner, "another-host process 1")
})

test_that("what processes left in work/ is removed when they have ended", {
  need_folders()
  plan <- small_plan(2)
  folder <- sweep_folder()
  sweep_run(plan, folder)
  unlink(sums_file(folder, 1))
  here <- Sys.info()[["nodename"]]
  leave <- function(host, pid) {
    path <- file.path(folder, "work", paste0("rows-", part_name(1), "-", host, "-", pid, "-abc"))
    writeLines("x", path)
    path
  }
  ours <- leave(here, process_tag())
  dead <- leave(here, 2^22 + 1)
  alive <- leave(here, 1)
  new <- leave("another-host", 77)
  old <- leave("another-host", 78)
  Sys.setFileTime(old, Sys.time() - 7200)
  strange <- file.path(folder, "work", "notes.txt")
  writeLines("x", strange)
  expect_identical(sweep_status(folder)$writing, 5L)
  sweep_resume(folder)
  expect_identical(file.exists(c(ours, old)), c(FALSE, FALSE))
  expect_identical(file.exists(c(new, strange)), c(TRUE, TRUE))
  skip_if(!dir.exists("/proc/self"), "other processes are not known here")
  expect_identical(file.exists(c(dead, alive)), c(FALSE, TRUE))
})

# ---- rows that fail -----------------------------------------------------------------------------

# The status of each row is that of the error of sweep_scene() or of trajectory().
expect_same_failures <- function(plan, sweep) {
  for (i in seq_len(nrow(sweep))) {
    said <- tryCatch(
      {
        scene <- sweep_scene(sweep, i)
        motion <- suppressWarnings(trajectory(
          scene, c(0, plan$time_s), accuracy = plan$accuracy, max_steps = plan$max_steps,
          model = if (plan$asked || plan$kind != "scene") plan$model
        ))
        "ok"
      },
      rotdyn_error = function(e) row_statuses()[status_of_error(e, i, NULL) + 1L]
    )
    expect_identical(sweep$status[i], said, label = paste("row", i))
    if (said == "ok") {
      expect_identical(sweep[[plan$outputs[1]]][i], motion$theta_rad[nrow(motion)])
    } else {
      expect_true(is.nan(sweep[[plan$outputs[1]]][i]) && is.nan(sweep$error[i]))
    }
  }
}

test_that("a row that fails has the status of the error of its scene or of its motion", {
  outputs <- "final_theta_rad"
  check <- function(plan, statuses) {
    sweep <- sweep_run(plan)
    expect_identical(sweep$status, statuses)
    expect_same_failures(plan, sweep)
    sweep
  }
  dry <- scene_axle(0.1, resistance = resistance(coulomb_n_m = 0.01, static_n_m = 0.02),
                    omega0_rad_per_s = 3)
  check(sweep_plan(dry, 5, outputs = outputs, rows_of(
    "resistance$static_n_m" = c(0.02, 0.005, 0.01)
  )), c("ok", "value", "ok"))
  check(sweep_plan(dry, 5, outputs = outputs, model = "axle_linear", rows_of(
    "resistance$coulomb_n_m" = c(0, 0.01), "resistance$static_n_m" = c(0, 0.02)
  )), c("ok", "model"))
  # Of derived inputs no law is known: their rows get the status of the constructor.
  sweep <- check(sweep_plan(wheel, 4, outputs = outputs, rows_of(a = c(4, -1, Inf, 0, NaN)[1:4]),
    derive = list(omega0_rad_per_s = ~ sqrt(a), "body$mass_kg" = ~ 1 + a - a)
  ), c("ok", "value", "value", "ok"))
  expect_identical(is.nan(sweep$omega0_rad_per_s), c(FALSE, TRUE, FALSE, FALSE))
  found <- attr(summary(sweep), "about")
  expect_identical(c(found$status[["ok"]], found$status[["value"]]), c(2, 2))
  expect_identical(found$failed, c(2, 3))
  # Steps.
  swing <- scene_pendulum(body_point(1), 1, resistance(viscous_n_m_s = 0.1), theta0_rad = 1)
  few <- sweep_plan(swing, 4, rows_of(theta0_rad = c(0.5, 1)), outputs = outputs)
  few$max_steps <- 3
  check(few, c("budget", "budget"))
  # R functions: of the scene, and one that builds scenes.
  bounded <- torque_function(
    function(time_s, theta_rad, omega_rad_per_s) ifelse(omega_rad_per_s > 5, NaN, 0.01), numeric()
  )
  check(sweep_plan(scene_axle(0.1, bounded), 3, rows_of(omega0_rad_per_s = c(1, 9, 2)),
                   outputs = outputs), c("ok", "torque", "ok"))
  check(sweep_plan(NULL, 3, rows_of(m = c(-1, 1, 0, 2)), outputs = outputs,
                   build = function(row) scene_axle(row$m, 0.2)), c("value", "ok", "value", "ok"))
})

test_that("an R function that stops ends the sweep, with the row", {
  stops <- torque_function(function(time_s, theta_rad, omega_rad_per_s) {
    if (any(omega_rad_per_s > 5)) stop("too fast")
    0.01
  }, numeric())
  expect_error(
    sweep_plan(scene_axle(0.1, stops), 3, rows_of(omega0_rad_per_s = c(1, 2, 9))),
    "row 3.*too fast", class = "rotdyn_error_build"
  )
  build <- function(row) if (row$m == 280) stop("bad luck") else scene_axle(row$m, 0.2)
  plan <- sweep_plan(NULL, 3, rows_of(m = c(1:250, rep(1, 50))), build = build, chunk_rows = 256)
  plan$design$inputs$m$x <- as.double(1:300)
  expect_error(sweep_run(plan), "row 280.*bad luck", class = "rotdyn_error_build")
  expect_error(
    sweep_run(sweep_plan(NULL, 3, rows_of(m = 1:3), build = function(row) {
      if (row$m == 2) "a" else scene_axle(row$m, 0.2)
    })), "row 2 it returned", class = "rotdyn_error_type"
  )
  # Of the wrong kind: the class of the constructor's error, and the row.
  expect_error(
    sweep_plan(NULL, 3, rows_of(m = 1:3), build = function(row) {
      scene_axle(if (row$m == 2) "a" else row$m, 0.2)
    }), "row 2", class = "rotdyn_error_type"
  )
  expect_error(sweep_plan(NULL, 3, rows_of(m = 1:3), build = function(row) scene_axle(-row$m)),
               "makes no scene", class = "rotdyn_error_value")
})

test_that("in a folder a chunk that fails leaves the others, with its number and the row", {
  need_folders()
  folder <- sweep_folder()
  plan <- gated_plan()
  sweep_create(plan, folder)
  # The row is in no canary's way: it fails in the chunk alone.
  old <- Sys.getenv(c("ROTDYN_GATE", "ROTDYN_GATE_ROW"))
  on.exit(do.call(Sys.setenv, as.list(old)), add = TRUE)
  plan$build <- function(row) {
    names <- vapply(sys.calls(), function(one) deparse(one[[1]])[1], "")
    if (row$m == 7 && "commit_chunk" %in% names) stop("bad luck")
    scene_axle(row$m, 0.2)
  }
  plan$hash <- read_plan(folder, NULL)$hash
  said <- expect_error(
    complete_folder(plan, folder, 1, NULL, NULL), "1 chunk of the sweep failed: 1",
    class = "rotdyn_error_chunks"
  )
  expect_match(conditionMessage(said$parent), "row 7")
  expect_identical(sweep_todo(folder), 1)
  expect_whole_folder(folder, gated_plan(), sweep_digest(sweep_run(gated_plan())))
})

test_that("sweeps of which every row fails, or no row is kept, are read and printed", {
  refusing <- sweep_plan(NULL, 3, rows_of(m = as.double(1:6)), build = function(row) {
    scene_axle(if (getOption("rotdyn_refuse", FALSE)) -1 else row$m, 0.2)
  })
  unkept <- sweep_plan(wheel, 4, keep = ~ omega0_rad_per_s < -1e9,
    design_random(300, seed = 1, omega0_rad_per_s = vary_normal(20, 1)))
  all_kept <- sweep_plan(wheel, 4, keep = ~ 1,
    design_random(300, seed = 1, omega0_rad_per_s = vary_normal(20, 1)))
  options(rotdyn_refuse = TRUE)
  on.exit(options(rotdyn_refuse = NULL))
  sweeps <- list(sweep_run(refusing), sweep_run(unkept), sweep_run(all_kept))
  expect_identical(vapply(sweeps, nrow, 1L), c(6L, 0L, 300L))
  expect_identical(unique(sweeps[[1]]$status), "value")
  expect_identical(sweeps[[3]]$row, as.double(1:300))
  for (k in 1:3) {
    sweep <- sweeps[[k]]
    expect_output(print(sweep), "rotdyn sweep")
    said <- capture.output(print(summary(sweep)))
    expect_identical(any(grepl("not computed (value): 6 rows, 100 %", said, fixed = TRUE)), k == 1)
    figures <- summary(sweep)
    expect_identical(figures$finite, rep(c(0, 300, 300)[k], 2))
    expect_identical(is.nan(figures$mean), rep(k == 1, 2))
    at <- quantile(sweep, c(0, 0.5))
    expect_type(at$value, "double")
    expect_identical(is.nan(at$value), rep(k == 1, 4))
    expect_identical(nrow(sweep_audit(sweep, 2)), 2L)
    expect_error(sweep_indices(sweep), class = "rotdyn_error_argument")
  }
  expect_identical(unique(sweep_audit(sweeps[[1]], 2)$verdict), "not computed")
  expect_identical(summary(sweeps[[2]])$mean, summary(sweeps[[3]])$mean)
  if (requireNamespace("nanoparquet", quietly = TRUE)) {
    for (k in 1:2) {
      folder <- sweep_folder()
      kept <- sweep_run(list(refusing, unkept)[[k]], folder)
      expect_identical(sweep_digest(kept), sweep_digest(sweeps[[k]]))
      expect_identical(names(sweep_read(folder)), names(sweeps[[k]]))
      expect_identical(vapply(sweep_read(folder), typeof, ""), vapply(sweeps[[k]], typeof, ""))
      expect_identical(nrow(sweep_check(folder, trust = TRUE)), 0L)
    }
  }
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::ggplot_build(ggplot2::autoplot(sweeps[[2]])), "ggplot_built")
  expect_error(ggplot2::autoplot(sweeps[[1]]), "No row", class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(sweeps[[2]], kind = "lines"), "keep", class = "rotdyn_error_value")
})

test_that("a condition that is not a number keeps no row", {
  one <- function(keep) {
    sweep_run(sweep_plan(wheel, 4, keep = keep,
      rows_of(a = c(-1, 0, 1, Inf, -Inf, 4)), derive = list(theta0_rad = ~ 0 * pmin(a, 1e9))
    ))$row
  }
  expect_identical(one(~ sqrt(a)), c(3, 4, 6))
  expect_identical(one(~ sqrt(a) >= 0), c(2, 3, 4, 6))
  expect_identical(one(~ sqrt(a) < 0), double())
  expect_identical(one(~ a - a == 0), c(1, 2, 3, 6))
  # Rows without numbers are kept where the condition is of their inputs.
  expect_identical(one(~ a < 0), c(1, 5))
  expect_identical(one(~ final_theta_rad > -1e9), c(1, 2, 3, 4, 6))
})

# ---- arguments ----------------------------------------------------------------------------------

test_that("threads from one to as many as there are", {
  plan <- sweep_plan(wheel, 4, keep = "summary",
    design_random(5000, seed = 1, omega0_rad_per_s = vary_normal(20, 1)))
  wanted <- sweep_digest(sweep_run(plan))
  for (threads in c(1.7, 2, 4097, 1e9, 1e300)) {
    expect_identical(sweep_digest(sweep_run(plan, threads = threads)), wanted)
  }
  for (threads in list(0, -1, NaN, Inf)) {
    expect_error(sweep_run(plan, threads = threads), class = "rotdyn_error_value")
  }
  expect_error(sweep_run(plan, threads = "2"), class = "rotdyn_error_type")
  expect_error(sweep_run(plan, threads = 1:2), class = "rotdyn_error_size")
})

test_that("chunks, parts and rows out of range are named with their range", {
  need_folders()
  folder <- sweep_folder()
  sweep_create(small_plan(2), folder)
  refused <- function(code, words = NULL) expect_error(code, words, class = "rotdyn_error_value")
  refused(sweep_chunk(folder, 3), "between 1 and 2")
  for (chunk in list(0, -1, 1.5, NaN, Inf)) refused(sweep_chunk(folder, chunk), "chunk")
  refused(sweep_work(folder, 3, 2), "between 1 and 2")
  for (part in list(0, 1.5, NaN)) refused(sweep_work(folder, part, 2), "part")
  for (parts in list(0, 1e7, NaN)) refused(sweep_work(folder, 1, parts), "parts")
  for (row in list(0, 1.5, NaN, 334)) refused(sweep_scene(folder, row), "row")
  for (rows in list(-1, 1.5, 2^31)) refused(sweep_read(folder, rows = rows), "rows")
  for (chunks in list(-1, 1.5, NaN)) refused(sweep_check(folder, chunks = chunks), "chunks")
  expect_error(sweep_chunk(folder, "1"), class = "rotdyn_error_type")
  expect_identical(sweep_todo(folder), c(1, 2))
  # More jobs than chunks: most have nothing to do.
  expect_identical(nrow(sweep_work(folder, 99, 1e6)), 0L)
  expect_identical(sweep_work(folder, 2, 1e6)$chunk, 2)
  expect_error(sweep_digest(structure(list(), class = "rot_sweep")), class = "rotdyn_error_type")
  expect_error(sweep_run(small_plan(2), 3), class = "rotdyn_error_type")
})

test_that("accuracies that no model reaches are refused, and the crudest is taken", {
  for (accuracy in c(5e-324, 1e-300, 1e-16)) {
    expect_error(
      sweep_plan(wheel, 4, rows_of(omega0_rad_per_s = 1:3), accuracy = accuracy), "The best",
      class = "rotdyn_error_model"
    )
  }
  for (accuracy in list(0, -1, NaN, Inf)) {
    expect_error(sweep_plan(wheel, 4, rows_of(omega0_rad_per_s = 1:3), accuracy = accuracy),
                 class = "rotdyn_error_value")
  }
  plan <- sweep_plan(wheel, 4, rows_of(omega0_rad_per_s = 1:3), accuracy = 1e300)
  expect_identical(sweep_run(plan)$status, rep("ok", 3))
})

test_that("the bar of a sweep goes through its chunks, from 0 to 1", {
  space <- asNamespace("rotdyn")
  put <- function(name, f) {
    unlockBinding(name, space)
    assign(name, f, envir = space)
  }
  own <- mget(c("progress_bar", "commit_chunk"), envir = space)
  on.exit(for (name in names(own)) put(name, own[[name]]))
  seen <- double()
  put("progress_bar", function(name) function(fraction) seen <<- c(seen, fraction))
  put("commit_chunk", function(plan, folder, chunk, threads, progress, call) {
    progress(0)
    progress(0.5)
    progress(1)
    chunk
  })
  expect_equal(rotdyn:::run_here(NULL, NULL, c(3, 1), 1, NULL), list(3, 1))
  expect_equal(seen, c(0, 0.25, 0.5, 0.5, 0.75, 1))
})

test_that("status, todo and read agree on which chunks are done", {
  need_folders()
  plan <- function(keep) {
    plan <- sweep_plan(wheel, 60, rows_of(omega0_rad_per_s = 1:600 / 20), keep = keep)
    plan$block_rows <- plan$chunk_rows <- 2^8
    plan
  }
  done <- function(folder) {
    as.double(c(sweep_status(folder)$chunks_done, length(sweep_todo(folder))))
  }
  for (keep in list("rows", ~ omega0_rad_per_s > 29)) {
    folder <- tempfile("sweep-")
    sweep_run(plan(keep), folder)
    expect_identical(done(folder), c(3, 0))
    rows <- file.path(folder, "rows", part_name(1:3))
    unlink(rows[2])
    expect_identical(done(folder), c(2, 1))
    expect_identical(sweep_status(folder)$rows_done, 344)
    writeLines("cut", rows[3])
    expect_identical(done(folder), c(1, 2))
    expect_error(sweep_read(folder), "2 of 3 chunks", class = "rotdyn_error_file")
    sweep_resume(folder)
    expect_identical(done(folder), c(3, 0))
    writeLines("cut", file.path(folder, "sums", part_name(1)))
    expect_identical(done(folder), c(2, 1))
    unlink(folder, recursive = TRUE)
  }
  # A summary has no rows, and is done without.
  folder <- tempfile("sweep-")
  sweep_run(plan("summary"), folder)
  unlink(file.path(folder, "rows"), recursive = TRUE)
  expect_identical(done(folder), c(3, 0))
  expect_identical(sweep_status(folder)$rows_done, 600)
  expect_identical(nrow(sweep_read(folder)), 0L)
  unlink(folder, recursive = TRUE)
})

test_that("numbers of a chunk that no plan has are refused", {
  plan <- sweep_plan(wheel, 1, rows_of(omega0_rad_per_s = c(1, 2)))
  how <- list(
    first = 0, n = 2, block_rows = 256, summed = 1, keep = 1, condition = NULL,
    shift = double(length(plan$outputs)), replicates = 16, run = 1
  )
  chunk <- function(...) {
    .Call(rotdyn:::ffi_sweep_chunk, rotdyn:::core_sweep(plan, 1), utils::modifyList(how, list(...)),
          NULL, NULL)
  }
  expect_identical(chunk()$column[[1]], c(1, 2))
  expect_identical(chunk(replicates = 4096)$column, chunk()$column)
  for (n in c(0, 4097, NaN)) expect_error(chunk(replicates = n), "replicates")
  for (n in c(255, 65537)) expect_error(chunk(block_rows = n), "block_rows")
  for (n in c(-1, 0.5, 3)) expect_error(chunk(keep = n), "keep")
})
