# Sweeps carried out: in memory, in a folder, chunk by chunk, by this process or by several.

#' Run a sweep
#'
#' `sweep_run()` carries out a plan: in memory, or in a folder that survives whatever ends the
#' process. `sweep_resume()` goes on after that. `sweep_status()` says how far a folder is.
#' `sweep_chunk()` computes one chunk and commits it, `sweep_work()` one part of all chunks: what
#' array jobs and other schedulers call. `sweep_todo()` lists the chunks to compute.
#'
#' A folder has `run.json` (what the sweep is), `rows/` and `sums/` with a part for each chunk, and
#' `work/` with files that are being written. A part gets its name when it is whole. A chunk is done
#' if its part is in `sums/` and, unless the plan keeps only the summary, the part in `rows/` that
#' belongs to it; a part that is cut or damaged does not count. Any number of processes may compute
#' chunks of one folder at a time; a chunk computed twice has the same bits. Rows are Parquet files,
#' read by DuckDB, arrow and \pkg{nanoparquet}.
#'
#' Chunks are given to the daemons of \pkg{mirai} where you have set some (`mirai::daemons(2)`, on
#' this machine or on others), and only then. Rows do not depend on the number of threads, daemons
#' or jobs, to the last bit.
#'
#' @section Daemons:
#' Daemons may come and go during a run; there may be none at its start. Each writes its parts
#' itself: all hosts need the folder under the same path, and a daemon that does not see it ends the
#' run with an error. A daemon of another version, compiler or C library is found by its bits before
#' it writes (`rotdyn_error_canary`). The chunk of a daemon that is lost is computed by another one;
#' lost three times, it counts as failed. A chunk that takes ten times as long as others and a
#' minute is given out a second time. An error of R in a chunk is not tried again: the others go on.
#' A daemon that cannot load its packages needs the environment variable `R_LIBS` before it starts,
#' or `mirai::everywhere(.libPaths("..."))`; a message says so. An interrupt stops what is being
#' computed; [sweep_resume()] goes on.
#'
#' Where daemons have many cores, `threads` uses them: one daemon with all threads of a host, or one
#' for each core with one thread. A scheduler's array job needs no daemons: `rotdyn sweep work DIR
#' --part N --of M` in a shell, or `sweep_work()`.
#'
#' @param plan A plan of [sweep_plan()].
#' @param folder Name of a folder; NULL: in memory. It is made, or has this very sweep.
#' @param ... Not used; names after it must be given in full.
#' @param threads Most threads of each process.
#' @param compute The profile of \pkg{mirai}'s daemons; NULL: the default one, where it has daemons.
#' @param chunk Number of a chunk, from 1.
#' @param part,parts This is job `part` of `parts`: it computes every `parts`-th chunk.
#' @param trust TRUE: run the R functions that the folder has; they can do anything.
#' @return `sweep_run()`, `sweep_resume()`: the sweep, as [sweep_read()] returns it.
#'   `sweep_status()`: a tibble of one row with the columns
#'   `r describe_columns(sweep_status_columns, sweep_status_meanings)`
#'   `sweep_chunk()` and `sweep_work()`, invisibly: a tibble with a row for each chunk computed and
#'   the columns
#'   `r describe_columns(sweep_receipt_columns, sweep_receipt_meanings)`
#'   `sweep_todo()`: numbers of chunks.
#' @section Errors: `rotdyn_error_memory` for a plan that does not fit into memory;
#'   `rotdyn_error_folder` for a folder with another sweep, with the first difference, and for
#'   daemons that do not see it; `rotdyn_error_value` for R functions that use the session's
#'   workspace, which no other process has; `rotdyn_error_argument` for a profile without daemons;
#'   `rotdyn_error_canary` for a machine whose rows have other bits; `rotdyn_error_chunks` for
#'   chunks that failed, after all others are done; `rotdyn_error_file` where nothing can be
#'   written: what is committed stays. `rotdyn_error_package` without \pkg{nanoparquet} or
#'   \pkg{yyjsonr}, which a folder needs, and where no daemon can load its packages. A message of
#'   class `rotdyn_message_sweep` where no daemon is connected for a minute, or one cannot load its
#'   packages, and at an interrupt.
#' @source Apache Parquet format, version 2.9 (2021).
#' @seealso [sweep_plan()], [sweep_read()], [summary.rot_sweep()].
#' @concept parallel
#' @concept cluster
#' @concept restart
#' @examples
#' plan <- sweep_plan(
#'   scene_axle(0.0625, resistance = resistance(0.002), omega0_rad_per_s = 20), time_s = 60,
#'   design_grid("body" = c(0.05, 0.06, 0.07), "omega0_rad_per_s" = c(10, 20))
#' )
#' sweep_run(plan)
#'
#' @examplesIf all(c("nanoparquet", "yyjsonr") %in% rownames(utils::installed.packages()))
#' folder <- tempfile("wheels-")
#' sweep_run(plan, folder)
#' sweep_status(folder)
#' dir(folder, recursive = TRUE)
#' # A part is lost: it is computed again. So jobs of an array compute theirs.
#' unlink(file.path(folder, "sums", "part-00000001.parquet"))
#' sweep_todo(folder)
#' sweep_chunk(folder, 1)
#' sweep_work(folder, part = 1, parts = 3)
#' sweep_resume(folder)
#' unlink(folder, recursive = TRUE)
#' @export
sweep_run <- function(plan, folder = NULL, ..., threads = 1, compute = NULL) {
  call <- check_no_dots(...)
  check_supplied("plan", call)
  check_plan(plan, call)
  threads <- check_threads(threads, call)
  if (is.null(folder)) return(run_in_memory(plan, threads, call))
  check_file_name(folder, call, "folder", "folder")
  check_compute(compute, call)
  known <- file.exists(file.path(folder, "run.json"))
  kept <- make_sweep_folder(plan, folder, call)
  # The plan of this session has its functions; how it is cut into chunks the folder says.
  own <- c("hash", "canary", "chunk_rows", "row_s", "version", "made")
  plan[own] <- kept[own]
  if (known) check_canary(plan, folder, call)
  run_in_folder(plan, folder, threads, compute, call)
}

#' @rdname sweep_run
#' @export
sweep_resume <- function(folder, ..., threads = 1, compute = NULL, trust = FALSE) {
  call <- check_no_dots(...)
  check_supplied("folder", call)
  threads <- check_threads(threads, call)
  check_compute(compute, call)
  plan <- open_sweep(folder, trust, call)
  check_canary(plan, folder, call)
  run_in_folder(plan, folder, threads, compute, call)
}

#' @rdname sweep_run
#' @export
sweep_chunk <- function(folder, chunk, ..., threads = 1, trust = FALSE) {
  call <- check_no_dots(...)
  check_supplied(c("folder", "chunk"), call)
  plan <- open_sweep(folder, trust, call)
  chunk <- check_whole(chunk, "chunk", call, 1, n_chunks(plan))
  check_canary(plan, folder, call)
  receipt <- commit_chunk(plan, folder, chunk, check_threads(threads, call), NULL, call)
  invisible(receipts_table(list(receipt)))
}

#' @rdname sweep_run
#' @export
sweep_work <- function(folder, part, parts, ..., threads = 1, trust = FALSE) {
  call <- check_no_dots(...)
  check_supplied(c("folder", "part", "parts"), call)
  plan <- open_sweep(folder, trust, call)
  parts <- check_whole(parts, "parts", call, 1, 1e6)
  part <- check_whole(part, "part", call, 1, parts)
  check_canary(plan, folder, call)
  chunks <- chunks_to_do(plan, folder)
  mine <- chunks[(chunks - 1) %% parts == part - 1]
  threads <- check_threads(threads, call)
  receipts <- telling_how_far(plan, folder, run_here(plan, folder, mine, threads, call))
  invisible(receipts_table(receipts))
}

#' @rdname sweep_run
#' @export
sweep_todo <- function(folder, ...) {
  call <- check_no_dots(...)
  check_supplied("folder", call)
  need_package("nanoparquet", "Reading a sweep", call)
  chunks_to_do(read_plan(folder, call), folder)
}

#' @rdname sweep_run
#' @export
sweep_status <- function(folder, ...) {
  call <- check_no_dots(...)
  check_supplied("folder", call)
  need_package("nanoparquet", "Reading a sweep", call)
  plan <- read_plan(folder, call)
  done <- done_chunks(plan, folder)
  rows <- sum(vapply(done, function(chunk) chunk_range(plan, chunk)[2], double(1)))
  left <- (plan$n - rows) * plan$row_s
  owner <- read_owner(folder)
  as_table(
    rows_done = rows, rows = plan$n, chunks_done = length(done), chunks = n_chunks(plan),
    time_left_s = left, writing = length(dir(file.path(folder, "work"), "[.]parquet-")),
    owner = owner$who %||% NA_character_
  )
}

# ---- checks -------------------------------------------------------------------------------------

check_plan <- function(plan, call) {
  check_class(plan, "rot_sweep_plan", "plan", "Make one with {.fn sweep_plan}.", call)
}

check_threads <- function(threads, call) {
  floor(check_number(threads, "threads", "1", call, lower = 1))
}

# A profile that is named has daemons.
check_compute <- function(compute, call) {
  if (is.null(compute)) return()
  if (!is.character(compute) || length(compute) != 1L || is.na(compute)) {
    abort_rotdyn(c(
      "{.arg compute} must be the name of a profile.", x = "It is {describe_value(compute)}."
    ), "type", call)
  }
  need_package("mirai", "A profile of daemons", call)
  if (!has_daemons(compute)) {
    abort_rotdyn(c(
      "The profile {.val {compute}} has no daemons.",
      i = "Set some: {.code mirai::daemons(2, .compute = \"{compute}\")}."
    ), "argument", call)
  }
}

# The plan of a folder, whose functions may be run.
open_sweep <- function(folder, trust, call) {
  trust <- check_flag(trust, "trust", call)
  need_package("nanoparquet", "A sweep in a folder", call)
  plan <- read_plan(folder, call, trust)
  if (isTRUE(plan$untrusted)) {
    abort_rotdyn(c(
      "The sweep in {.file {folder}} has R functions, which can do anything.",
      i = "If you trust who made it: {.code trust = TRUE}."
    ), "folder", call)
  }
  plan
}

receipts_table <- function(receipts) {
  column <- function(name) vapply(receipts, `[[`, double(1), name)
  new_table(stats::setNames(lapply(sweep_receipt_columns, column), sweep_receipt_columns),
            nrow = length(receipts))
}

# ---- in memory ----------------------------------------------------------------------------------

run_in_memory <- function(plan, threads, call) {
  bytes <- if (plan$keep == "rows") 2.5 * plan$n * row_bytes(plan) else 1e8
  free <- free_memory()
  if (!is.na(free) && bytes > free) {
    abort_rotdyn(c(
      "The rows do not fit into memory: {prefixed(bytes, 'B')} of {prefixed(free, 'B')}.",
      i = "Give a folder: {.code sweep_run(plan, \"name\")}.",
      i = "Or keep less: {.code keep = \"summary\"}, {.code keep = ~ condition}."
    ), "memory", call)
  }
  progress <- progress_bar("sweep")
  found <- chunk_of_sweep(plan, 1, plan$n, threads, progress, call)
  new_sweep(plan, rows_table(plan, found), list(
    sums = found$sums, checksum = found$checksum, kept = length(found$row), rows = plan$n
  ), NULL)
}

# Bytes; NA where the system does not say.
free_memory <- function() {
  if (!file.exists("/proc/meminfo")) return(NA_real_)
  line <- grep("^MemAvailable:", readLines("/proc/meminfo"), value = TRUE)
  as.double(sub("^MemAvailable: *([0-9]+) kB$", "\\1", line)) * 1024
}

# The sweep as a table of its kept rows. `whole`: sums, checksum, numbers of rows.
new_sweep <- function(plan, rows, whole, folder) {
  new_table(as.list(rows), nrow = nrow(rows), class = "rot_sweep",
            sweep = list(plan = plan, whole = whole, folder = folder))
}

# ---- in a folder --------------------------------------------------------------------------------

run_in_folder <- function(plan, folder, threads, compute, call) {
  complete_folder(plan, folder, threads, compute, call)
  read_sweep(plan, folder, NULL, call)
}

complete_folder <- function(plan, folder, threads, compute, call) {
  todo <- chunks_to_do(plan, folder)
  # A sweep that is done is read where nothing can be written, too.
  if (!length(todo)) return(clear_work(folder))
  own_folder(folder, call)
  on.exit(disown_folder(folder))
  clear_work(folder)
  telling_how_far(plan, folder, {
    if (has_daemons(compute)) {
      run_by_daemons(plan, folder, todo, threads, compute, call)
    } else {
      run_here(plan, folder, todo, threads, call)
    }
  })
  clear_work(folder)
}

# An interrupt goes on after the message.
telling_how_far <- function(plan, folder, code) {
  withCallingHandlers(code, interrupt = function(e) {
    inform_quickly(c(
      paste0(length(done_chunks(plan, folder)), " of ", n_chunks(plan), " chunks are done."),
      paste0("sweep_resume(\"", folder, "\") goes on.")
    ), "sweep")
  })
}

# => receipts
run_here <- function(plan, folder, todo, threads, call) {
  bar <- progress_bar("sweep")
  failed <- list()
  receipts <- lapply(seq_along(todo), function(i) {
    progress <- function(fraction) bar((i - 1 + fraction) / length(todo))
    tryCatch(
      commit_chunk(plan, folder, todo[i], threads, progress, call),
      error = function(e) {
        # No room, no folder: the next chunk fails, too.
        if (inherits(e, "rotdyn_error_file") || is_time_limit(e)) rlang::cnd_signal(e)
        failed[[length(failed) + 1L]] <<- list(todo[i], e)
        NULL
      }
    )
  })
  abort_failed_chunks(failed, call)
  receipts
}

abort_failed_chunks <- function(failed, call) {
  if (!length(failed)) return()
  chunks <- vapply(failed, function(f) as.double(f[[1]]), double(1))
  abort_rotdyn(c(
    "{length(chunks)} chunk{?s} of the sweep failed: {some_names(whole_words(chunks))}.",
    i = "All others are done. {.fn sweep_resume} tries {cli::qty(length(chunks))}{?it/them} again."
  ), "chunks", call, parent = if (inherits(failed[[1]][[2]], "error")) failed[[1]][[2]])
}

# Who coordinates, as advice: a second one is warned, and does no harm.
own_folder <- function(folder, call) {
  owner <- read_owner(folder)
  me <- this_process()
  if (!is.null(owner) && !identical(owner$who, me) && !has_ended(owner)) {
    warn_rotdyn(c(
      "Another process may be at work on {.file {folder}}: {owner$who}.",
      i = "Both may go on: the rows are the same, some are computed twice."
    ), "folder", call)
  }
  owner <- list(who = me, process = process_tag())
  write_file(json_text(owner), file.path(folder, "owner.json"), call)
}

this_process <- function() paste0(Sys.info()[["nodename"]], " process ", Sys.getpid())

# The file of another coordinator, which came later, stays.
disown_folder <- function(folder) {
  owner <- read_owner(folder)
  if (identical(owner$who, this_process())) unlink(file.path(folder, "owner.json"))
}

# NULL: nobody.
read_owner <- function(folder) {
  path <- file.path(folder, "owner.json")
  if (!file.exists(path)) return(NULL)
  text <- tryCatch(file_text(path), error = function(e) NA, warning = function(w) NA)
  field <- function(name, otherwise) {
    pattern <- paste0("^.*\"", name, "\": *\"([^\"]*)\".*$")
    if (is.na(text) || !grepl(pattern, text)) otherwise else sub(pattern, "\\1", text)
  }
  list(who = field("who", "a process without a name"), process = field("process", ""))
}

# Is it a process of this host that is no more?
has_ended <- function(owner) {
  pattern <- "^(.*) process ([0-9]+)$"
  if (!grepl(pattern, owner$who)) return(FALSE)
  process <- if (nzchar(owner$process)) owner$process else sub(pattern, "\\2", owner$who)
  sub(pattern, "\\1", owner$who) == Sys.info()[["nodename"]] && !process_lives(process)
}

# Removes what no process is writing any more: files of this host whose process has ended, and files
# of others an hour older, by the clock of their file system, than the file of the owner.
clear_work <- function(folder) {
  files <- dir(file.path(folder, "work"), full.names = TRUE)
  pattern <- "^.*-part-[0-9]+[.]parquet-(.*)-([0-9.]+)-[^-]*$|^nonce-(.*)-([0-9.]+)-[^-]*$"
  files <- files[grepl(pattern, basename(files))]
  if (!length(files)) return(invisible())
  here <- sub(pattern, "\\1\\3", basename(files)) == Sys.info()[["nodename"]]
  process <- sub(pattern, "\\2\\4", basename(files))
  age <- as.double(file.mtime(file.path(folder, "owner.json"))) - as.double(file.mtime(files))
  gone <- ifelse(
    here, process == process_tag() | !process_lives(process), !is.na(age) & age > 3600
  )
  unlink(files[gone])
}

# The number of this process and, where the system says it, when it began: after a restart, or a
# while, its number is that of another one.
process_tag <- function() {
  began <- birth_of_process("self")
  paste(c(Sys.getpid(), if (nzchar(began)) began), collapse = ".")
}

# By tags of processes of this host, or their numbers alone.
process_lives <- function(tag) {
  if (!dir.exists("/proc/self")) return(rep(TRUE, length(tag)))
  vapply(strsplit(tag, ".", fixed = TRUE), function(part) {
    began <- birth_of_process(part[1])
    nzchar(began) && (length(part) < 2L || part[2] == began)
  }, NA, USE.NAMES = FALSE)
}

# When a process began, in ticks of the system; "": it has ended. One whose parent has not noticed
# that (Z) writes no more.
birth_of_process <- function(pid) {
  stat <- tryCatch(
    suppressWarnings(readLines(file.path("/proc", pid, "stat"), 1L)), error = function(e) ""
  )
  # Behind the name, which may have any characters.
  fields <- strsplit(sub("^.*[)] ", "", c(stat, "")[1]), " ", fixed = TRUE)[[1]]
  if (length(fields) < 20L || fields[1] %in% c("Z", "X")) "" else fields[20]
}
