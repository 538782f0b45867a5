# Sweeps in folders: small ones, what a folder must have, other processes that run them.

# A closed form in chunks of 256 rows, the last one shorter.
small_plan <- function(chunks = 3, keep = "rows", seed = 8) {
  wheel <- scene_axle(
    body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
  )
  plan <- sweep_plan(
    wheel, 400, design_random(256 * chunks - 179, seed = seed,
      "body$mass_kg" = vary_normal(2, 0.02), "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)
    ), outputs = c("final_theta_rad", "stop_time_s"), keep = keep
  )
  plan$block_rows <- plan$chunk_rows <- 2^8
  # Not what the clock says: so the files of two plans have the same lengths.
  plan$row_s <- 1e-6
  plan
}

sweep_folder <- function(env = parent.frame()) {
  folder <- tempfile("sweep-")
  do.call(on.exit, list(bquote(unlink(.(folder), recursive = TRUE)), add = TRUE), envir = env)
  folder
}

rows_file <- function(folder, chunk) file.path(folder, "rows", part_name(chunk))
sums_file <- function(folder, chunk) file.path(folder, "sums", part_name(chunk))
bits_of <- function(x) lapply(unclass(x), writeBin, raw())
all_bytes_of <- function(path) readBin(path, "raw", file.size(path))

# After a fault: what has a final name is whole; of a folder also that nothing is being written. ""
# or what is wrong.
fault_of_parts <- function(folder, plan) {
  if (!dir.exists(folder)) return("")
  wrong <- character()
  path <- file.path(folder, "run.json")
  if (file.exists(path)) {
    kept <- tryCatch(read_plan(folder, NULL), error = function(e) NULL)
    if (is.null(kept)) wrong <- c(wrong, "run.json")
  }
  plan$hash <- plan_hash(plan)
  for (chunk in chunk_of_part(dir(file.path(folder, "sums")))) {
    path <- sums_file(folder, chunk)
    whole <- identical(sealed_about(path)$run, plan$hash)
    if (!whole) wrong <- c(wrong, paste("sums", chunk))
  }
  for (chunk in chunk_of_part(dir(file.path(folder, "rows")))) {
    range <- chunk_range(plan, chunk)
    rows <- tryCatch(nanoparquet::read_parquet(rows_file(folder, chunk)), error = function(e) NULL)
    whole <- !is.null(rows) && identical(rows$row, seq(range[1], length.out = range[2]))
    if (!whole) wrong <- c(wrong, paste("rows", chunk))
  }
  paste(wrong, collapse = ", ")
}

fault_of_folder <- function(folder, plan) {
  left <- c(dir(file.path(folder, "work")), dir(folder, "^[.]rotdyn-", all.files = TRUE))
  wrong <- c(fault_of_parts(folder, plan), left)
  paste(wrong[nzchar(wrong)], collapse = ", ")
}

expect_whole_folder <- function(folder, plan, digest, label = folder) {
  expect_identical(sweep_digest(sweep_run(plan, folder)), digest, label = label)
  expect_identical(nrow(sweep_check(folder, chunks = 0, trust = TRUE)), 0L, label = label)
  files <- setdiff(dir(folder, all.files = TRUE, no.. = TRUE), "functions.rds")
  expect_identical(sort(files), c("rows", "run.json", "sums", "work"), label = label)
  expect_identical(dir(file.path(folder, "work")), character(), label = label)
}

# ---- other processes ----------------------------------------------------------------------------

# Lines of R in a process of their own, with the plan of `plan`; `before` of a shell. Its files:
# `said` (messages, warnings, the end), `pid`. `alone`: the one library that it sees.
start_process <- function(lines, plan = NULL, before = NULL, alone = NULL) {
  folder <- tempfile("process-")
  dir.create(folder)
  files <- list(
    script = file.path(folder, "script.R"), plan = file.path(folder, "plan.rds"),
    said = file.path(folder, "said"), pid = file.path(folder, "pid")
  )
  saveRDS(plan, files$plan)
  writeLines(c(
    if (is.null(alone)) {
      sprintf(".libPaths(c(%s, .libPaths()))", deparse(dirname(system.file(package = "rotdyn"))))
    } else {
      sprintf(".libPaths(%s, include.site = FALSE)", deparse(alone))
    },
    # For daemons that it starts.
    "Sys.setenv(R_LIBS = paste(.libPaths(), collapse = .Platform$path.sep))",
    "suppressPackageStartupMessages(library(rotdyn))", "ns <- asNamespace('rotdyn')",
    sprintf("plan <- readRDS(%s)", deparse(files$plan)),
    sprintf("said <- function(...) cat(..., '\\n', file = %s, append = TRUE)", deparse(files$said)),
    sprintf("writeLines(as.character(Sys.getpid()), %s)", deparse(files$pid)),
    "tryCatch(withCallingHandlers({", lines, "said('ended')", "},",
    # Not those of a progress bar.
    "message = function(m) if (inherits(m, 'rotdyn_message_sweep')) {",
    "  said('message:', conditionMessage(m))", "},",
    "warning = function(w) {",
    "  said('warning:', conditionMessage(w))", "  invokeRestart('muffleWarning')", "}),",
    "interrupt = function(e) said('interrupted'),",
    "error = function(e) said('error:', class(e)[1], conditionMessage(e)))"
  ), files$script)
  rscript <- file.path(R.home("bin"), "Rscript")
  if (is.null(before)) {
    system2(rscript, shQuote(files$script), FALSE, FALSE, wait = FALSE)
  } else {
    command <- paste(before, "exec", shQuote(rscript), shQuote(files$script))
    system2("sh", c("-c", shQuote(command)), FALSE, FALSE, wait = FALSE)
  }
  files
}

# Until `this` is true: no limit of any use to a busy machine is shorter.
wait_until <- function(this, seconds = 120) {
  end <- Sys.time() + seconds
  while (!isTRUE(this()) && Sys.time() < end) Sys.sleep(0.02)
  isTRUE(this())
}

words_of <- function(process) {
  if (file.exists(process$said)) paste(readLines(process$said), collapse = "\n") else ""
}
has_said <- function(process, pattern) function() grepl(pattern, words_of(process))
ended <- "(^|\n)(ended|interrupted|error:)"

# ---- a run that can be stopped ------------------------------------------------------------------

# Scenes of a function, 256 rows and 44; where the environment variable ROTDYN_GATE names a file,
# the row of ROTDYN_GATE_ROW waits for its end, in a chunk, and says so by a file.
gated_plan <- function(n = 300) {
  plan <- sweep_plan(NULL, 3, design_list(data.frame(m = seq_len(n))), outputs = "final_theta_rad",
    chunk_rows = 256, build = function(row) {
      gate <- Sys.getenv("ROTDYN_GATE")
      if (nzchar(gate) && identical(Sys.getenv("ROTDYN_GATE_ROW"), as.character(row$m))) {
        names <- vapply(sys.calls(), function(one) deparse(one[[1]])[1], "")
        # Not where the canary, or a plan, has this row.
        if (any(c("commit_chunk", "run_in_memory") %in% names)) {
          file.create(paste0(gate, "-", Sys.getpid()))
          while (file.exists(gate)) Sys.sleep(0.01)
        }
      }
      scene_axle(row$m, 0.2)
    }
  )
  plan$row_s <- 1e-6
  plan
}

new_gate <- function(row, env = parent.frame()) {
  gate <- tempfile("gate")
  file.create(gate)
  do.call(on.exit, list(bquote(unlink(c(.(gate), Sys.glob(paste0(.(gate), "-*"))))), add = TRUE),
          envir = env)
  list(
    file = gate, waiting = function(n = 1) function() length(Sys.glob(paste0(gate, "-*"))) >= n,
    lines = sprintf("Sys.setenv(ROTDYN_GATE = %s, ROTDYN_GATE_ROW = '%s')", deparse(gate), row)
  )
}

stop_process <- function(process) tools::pskill(as.integer(readLines(process$pid)), tools::SIGINT)
