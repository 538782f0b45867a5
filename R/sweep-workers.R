# Chunks given to the daemons of mirai: the coordinator gives out few at a time and collects their
# receipts; a daemon computes and commits. Nothing here changes a number.

has_daemons <- function(compute) {
  # Daemons are set by mirai alone: it is not loaded for the question.
  isNamespaceLoaded("mirai") && isTRUE(mirai::daemons_set(compute))
}

# Seconds: between looks at the connections, at least; without daemons before a message; beyond 10
# medians until a chunk is given out again; with no other daemons than those that lack the package;
# until a network file system shows a new file.
coordinator_times <- function() {
  list(look = 0.5, nobody = 60, overdue = 60, unable = 10, late_file = 5)
}

# Daemons that a chunk may lose before it counts as failed.
max_tries <- 3

run_by_daemons <- function(plan, folder, todo, threads, compute, call) {
  run <- new_coordination(plan, folder, todo, threads, compute, call)
  on.exit({
    mirai::stop_mirai(lapply(run$flight, `[[`, "task"))
    unlink(file.path(run$job$folder, "work", run$job$nonce))
  })
  bar <- progress_bar("sweep")
  while (run$left > 0) {
    look_at_daemons(run)
    give_out(run)
    collect_receipts(run)
    bar(1 - run$left / length(todo))
    # The last receipts are waited for.
    if (run$left > 0) Sys.sleep(if (run$given < length(todo)) run$pause else run$pause / 10)
  }
  abort_failed_chunks(run$failed, call)
}

# The state of a coordinator. Chunks: todo[given + 1], ... were never given out, `again` come first.
new_coordination <- function(plan, folder, todo, threads, compute, call) {
  run <- new.env(parent = emptyenv())
  run$plan <- plan
  run$compute <- compute
  run$call <- call
  run$times <- coordinator_times()
  run$todo <- todo
  run$given <- 0
  run$again <- double()
  run$left <- length(todo)
  run$open <- rep(FALSE, n_chunks(plan))
  run$open[todo] <- TRUE
  run$losses <- integer(n_chunks(plan))
  run$flight <- list()
  run$failed <- list()
  run$seconds <- double()
  run$receipts <- 0
  set_waits(run, plan$row_s * plan$chunk_rows)
  run$pause <- min(run$pause, 0.25)
  run$connections <- 0
  run$looked <- -Inf
  run$able <- FALSE
  run$unable <- character()
  nonce <- paste0(
    "nonce-", Sys.info()[["nodename"]], "-", process_tag(), "-", basename(tempfile(""))
  )
  run$job <- list(
    folder = normalizePath(folder, mustWork = TRUE), threads = threads, nonce = nonce,
    hash = plan$hash, wait_s = run$times$late_file
  )
  write_file(nonce, file.path(run$job$folder, "work", nonce), call)
  run
}

clock_s <- function() proc.time()[[3L]]

# Chunks at hand beside the one that a daemon computes, for 0.25 s of work; seconds between looks at
# the receipts: half of that work, so that no daemon waits.
set_waits <- function(run, chunk_s) {
  run$ahead <- min(16, max(1, ceiling(0.25 / chunk_s)))
  run$pause <- min(5, max(0.001, run$ahead * chunk_s / 2))
}

# ---- daemons ------------------------------------------------------------------------------------

look_at_daemons <- function(run, now = clock_s()) {
  if (now - run$looked < max(run$times$look, run$pause)) return()
  run$looked <- now
  known <- suppressWarnings(as.integer(mirai::status(run$compute)$connections))
  run$connections <- if (length(known) && !is.na(known[1])) known[1] else 0L
  if (run$connections > 0) {
    run$nobody_since <- NULL
    give_up_on_unable(run, now)
    mark_overdue(run, now)
    return()
  }
  # What waits for a daemon is not overdue.
  for (i in seq_along(run$flight)) run$flight[[i]]$since <- now
  if (is.null(run$nobody_since)) run$nobody_since <- now
  if (now - run$nobody_since > run$times$nobody && is.null(run$nobody_said)) {
    run$nobody_said <- TRUE
    inform_quickly(c(
      paste("No daemon is connected since", seconds_words(run$times$nobody), "- the sweep waits."),
      # This session is busy until then.
      paste0("To start some: interrupt, mirai::launch_local() or mirai::launch_remote(), ",
             "sweep_resume(\"", run$job$folder, "\")."),
      library_hints
    ), "sweep")
  }
}

library_hints <- c(
  "A daemon that cannot load its packages does not connect, or does no work. Two settings help:",
  "the environment variable R_LIBS, set before the daemons start;",
  "mirai::everywhere(.libPaths(\"...\")), after they started."
)

# Chunks that take longer than 10 medians and a minute are given out once more.
mark_overdue <- function(run, now) {
  typical <- if (length(run$seconds)) stats::median(run$seconds) else {
    run$plan$row_s * run$plan$chunk_rows
  }
  for (i in seq_along(run$flight)) {
    one <- run$flight[[i]]
    if (one$doubled || now - one$since <= 10 * typical + run$times$overdue) next
    run$flight[[i]]$doubled <- TRUE
    if (sum(vapply(run$flight, `[[`, double(1), "chunk") == one$chunk) < 2L) {
      run$again <- c(run$again, one$chunk)
    }
  }
}

# ---- chunks -------------------------------------------------------------------------------------

# One more than the daemons have at hand. Overdue ones do not count: they may never come back.
give_out <- function(run) {
  waiting <- sum(!vapply(run$flight, `[[`, NA, "doubled"))
  while (waiting < (1 + run$ahead) * run$connections + 1) {
    chunk <- next_chunk(run)
    if (is.null(chunk)) return()
    run$flight[[length(run$flight) + 1L]] <- list(
      task = chunk_task(c(run$job, chunk = chunk), run$compute), chunk = chunk, since = clock_s(),
      doubled = FALSE
    )
    waiting <- waiting + 1
  }
}

# NULL: all are given out.
next_chunk <- function(run) {
  repeat {
    if (length(run$again)) {
      chunk <- run$again[1]
      run$again <- run$again[-1]
    } else if (run$given < length(run$todo)) {
      run$given <- run$given + 1
      chunk <- run$todo[run$given]
    } else {
      return(NULL)
    }
    if (!run$open[chunk]) next
    # Another coordinator, or a daemon of one that was killed, may have committed it meanwhile.
    path <- file.path(run$job$folder, "sums", part_name(chunk))
    if (!file.exists(path) || is.null(read_sums_part(run$plan, run$job$folder, chunk))) {
      return(chunk)
    }
    close_chunk(run, chunk)
  }
}

close_chunk <- function(run, chunk) {
  if (!run$open[chunk]) return()
  run$open[chunk] <- FALSE
  run$left <- run$left - 1
  same <- vapply(run$flight, `[[`, double(1), "chunk") == chunk
  if (!any(same)) return()
  mirai::stop_mirai(lapply(run$flight[same], `[[`, "task"))
  run$flight <- run$flight[!same]
}

collect_receipts <- function(run) {
  ready <- !vapply(run$flight, function(one) mirai::unresolved(one$task), NA)
  if (!any(ready)) return()
  arrived <- run$flight[ready]
  run$flight <- run$flight[!ready]
  for (one in arrived) take_receipt(run, one$chunk, one$task$data)
}

take_receipt <- function(run, chunk, receipt) {
  if (!run$open[chunk]) return()
  if (inherits(receipt, "miraiError")) {
    return(fail_chunk(run, chunk, daemon_condition("error", as.character(receipt))))
  }
  if (mirai::is_error_value(receipt)) return(lose_chunk(run, chunk, receipt))
  if (is.null(receipt$class)) {
    run$able <- TRUE
    run$seconds[run$receipts %% 99 + 1] <- receipt$seconds
    run$receipts <- run$receipts + 1
    set_waits(run, receipt$seconds)
    return(close_chunk(run, chunk))
  }
  e <- daemon_condition(receipt$class, receipt$message)
  kind <- sub("^rotdyn_error_", "", receipt$class[1])
  if (kind == "package") return(note_unable(run, chunk, receipt, e))
  run$able <- TRUE
  why <- switch(kind,
    canary = "The daemon {receipt$who} computes other bits.",
    folder = "The daemon {receipt$who} does not see the folder {.file {run$job$folder}}.",
    file = "The daemon {receipt$who} cannot go on with the sweep."
  )
  if (is.null(why)) return(fail_chunk(run, chunk, e))
  abort_rotdyn(c(why, i = if (kind == "folder") {
    "Daemons write their parts themselves: all hosts need the same folder under the same path."
  }), kind, run$call, parent = e)
}

# An error of a daemon, whose text is all that is left of it.
daemon_condition <- function(class, message) {
  kinds <- class[startsWith(class, "rotdyn_error")]
  structure(
    class = c(kinds, "error", "condition"),
    list(message = paste(cli::ansi_strip(message), collapse = "\n"), call = NULL)
  )
}

fail_chunk <- function(run, chunk, e) {
  run$failed[[length(run$failed) + 1L]] <- list(chunk, e)
  close_chunk(run, chunk)
}

# 19: the connection is lost; 7: closed; 5: a time limit of the user's.
lose_chunk <- function(run, chunk, value) {
  run$losses[chunk] <- run$losses[chunk] + 1L
  if (run$losses[chunk] < max_tries) {
    run$again <- c(run$again, chunk)
    return()
  }
  fail_chunk(run, chunk, daemon_condition(
    "error", paste0("Its daemons were lost, ", max_tries, " times: the last by ",
                    utils::capture.output(print(value))[1], ".")
  ))
}

note_unable <- function(run, chunk, receipt, e) {
  run$again <- c(run$again, chunk)
  if (!length(run$unable)) {
    run$unable_since <- clock_s()
    run$unable_error <- e
    inform_quickly(c(
      paste0("The daemon ", receipt$who, " lacks a package: ", e$message), library_hints
    ), "sweep")
  }
  run$unable <- union(run$unable, receipt$who)
}

give_up_on_unable <- function(run, now) {
  if (run$able || length(run$unable) < run$connections ||
      now - run$unable_since < run$times$unable) {
    return()
  }
  abort_rotdyn(c(
    "No daemon can load what it needs.", i = "Set {.envvar R_LIBS} before the daemons start.",
    i = "Or, after they started: {.code mirai::everywhere(.libPaths(\"...\"))}."
  ), "package", run$call, parent = run$unable_error)
}

# ---- on a daemon --------------------------------------------------------------------------------

# The code that a daemon runs finds this package itself: the session's functions stay here. One that
# lacks it waits, so that others get the chunk.
chunk_task <- function(job, compute) {
  mirai::mirai({
    found <- tryCatch(
      get("chunk_on_daemon", asNamespace("rotdyn")), error = function(e) conditionMessage(e)
    )
    if (is.function(found)) found(job) else {
      Sys.sleep(0.5)
      list(
        class = "rotdyn_error_package",
        message = paste0(found, " (libraries: ", paste(.libPaths(), collapse = ", "), ")"),
        who = paste(Sys.info()[["nodename"]], "process", Sys.getpid())
      )
    }
  }, .args = list(job = job), .compute = compute)
}

# A receipt, or list(class, message, who) of what went wrong.
chunk_on_daemon <- function(job) {
  tryCatch(
    {
      plan <- plan_on_daemon(job)
      commit_chunk(plan, job$folder, job$chunk, job$threads, NULL, NULL)
    },
    error = function(e) {
      if (inherits(e, "rotdyn_error_package")) Sys.sleep(0.5)
      list(
        class = class(e), message = if (inherits(e, "rlang_error")) {
          rlang::cnd_message(e, inherit = TRUE, prefix = FALSE)
        } else {
          conditionMessage(e)
        },
        who = paste(Sys.info()[["nodename"]], "process", Sys.getpid())
      )
    }
  )
}

# The plan of the run that this process has looked at.
daemon_state <- new.env(parent = emptyenv())

# A process looks once at a run: does it see the folder, does it compute the same bits? Who gives
# out the chunks of a sweep trusts its functions.
plan_on_daemon <- function(job) {
  if (identical(daemon_state$nonce, job$nonce)) return(daemon_state$plan)
  for (package in c("nanoparquet", "yyjsonr")) need_package(package, "A sweep in a folder", NULL)
  end <- clock_s() + job$wait_s
  nonce <- file.path(job$folder, "work", job$nonce)
  while (!file.exists(nonce) && clock_s() < end) Sys.sleep(0.1)
  if (!file.exists(nonce)) {
    abort_rotdyn("There is no {.file {nonce}} on {Sys.info()[['nodename']]}.", "folder", NULL)
  }
  plan <- read_plan(job$folder, NULL, trust = TRUE)
  if (!identical(plan$hash, job$hash)) {
    abort_rotdyn("The folder has another sweep on {Sys.info()[['nodename']]}.", "folder", NULL)
  }
  check_canary(plan, job$folder, NULL)
  daemon_state$plan <- plan
  daemon_state$nonce <- job$nonce
  plan
}
