# Chunks given to the daemons of mirai.

# Whether the user has set daemons in the profile; none are started here.
has_daemons <- function(compute) {
  if (!isNamespaceLoaded("mirai")) return(FALSE)
  isTRUE(tryCatch(mirai::daemons_set(.compute = compute), error = function(e) FALSE))
}

# What a daemon does: the canary once for each process, then the chunk. A value of class
# rot_receipt, or the condition.
sweep_task <- function(folder, chunk, threads, nonce) {
  call <- rlang::current_env()
  tryCatch(
    {
      if (!file.exists(file.path(folder, nonce))) {
        abort_rotdyn("A daemon does not see the folder {.file {folder}}.", "file", call)
      }
      plan <- open_sweep(folder, TRUE, call)
      if (!identical(daemon_state$checked, plan$hash)) {
        check_canary(plan, folder, call)
        daemon_state$checked <- plan$hash
      }
      receipt <- commit_chunk(plan, folder, chunk, threads, NULL, call)
      receipt$host <- Sys.info()[["nodename"]]
      receipt
    },
    error = function(e) {
      list(failed = conditionMessage(e), kind = class(e)[1], host = Sys.info()[["nodename"]])
    }
  )
}

daemon_state <- new.env(parent = emptyenv())

# A lost connection, a timeout or a stopped task: the chunk is given out again.
lost_tasks <- c(5L, 7L, 19L)

run_by_daemons <- function(plan, folder, todo, threads, compute, call) {
  folder <- normalizePath(folder)
  nonce <- paste0("nonce-", basename(tempfile("")))
  file.create(file.path(folder, nonce))
  on.exit(unlink(file.path(folder, nonce)))
  give <- function(chunk) {
    mirai::mirai(
      {
        ready <- requireNamespace("rotdyn", quietly = TRUE)
        if (!ready) list(failed = "", kind = "no_rotdyn", host = Sys.info()[["nodename"]]) else
          asNamespace("rotdyn")$sweep_task(folder, chunk, threads, nonce)
      },
      folder = folder, chunk = chunk, threads = threads, nonce = nonce, .compute = compute
    )
  }
  state <- list2env(list(
    queue = todo, flying = list(), tries = list(), failed = list(), took = double(), done = 0
  ))
  on.exit(lapply(state$flying, function(task) mirai::stop_mirai(task$task)), add = TRUE)
  bar <- progress_bar("sweep")
  waited <- proc.time()[[3L]]
  said <- FALSE
  repeat {
    connections <- daemon_count(compute)
    while (length(state$queue) && length(state$flying) < 2 * connections + 1) {
      chunk <- state$queue[1]
      state$queue <- state$queue[-1]
      state$flying[[length(state$flying) + 1L]] <- list(
        chunk = chunk, task = give(chunk), since = proc.time()[[3L]]
      )
    }
    if (!length(state$flying)) break
    ready <- !vapply(state$flying, function(one) mirai::unresolved(one$task), NA)
    if (any(ready)) {
      waited <- proc.time()[[3L]]
      landed <- state$flying[ready]
      state$flying <- state$flying[!ready]
      for (one in landed) take_landed(one, state, folder, call)
      bar(state$done / length(todo))
    } else {
      if (!said && connections == 0 && proc.time()[[3L]] - waited > 60) {
        said <- TRUE
        inform_quickly(c(
          "No daemon is connected; the sweep waits for one.",
          "A daemon that cannot load its packages ends at once: set `R_LIBS` for it, or
           `.libPaths()` in its profile."
        ), "sweep")
      }
      give_again(state, give)
      Sys.sleep(0.01)
    }
  }
  abort_failed_chunks(state$failed, call)
}

daemon_count <- function(compute) {
  status <- tryCatch(mirai::status(.compute = compute)$connections, error = function(e) 0)
  if (is.numeric(status)) as.double(status)[1] else 0
}

# A task that takes ten times the usual time and a minute is given out a second time.
give_again <- function(state, give) {
  if (!length(state$took)) return()
  limit <- 10 * stats::median(state$took) + 60
  for (i in seq_along(state$flying)) {
    one <- state$flying[[i]]
    if (isTRUE(one$twice) || proc.time()[[3L]] - one$since < limit) next
    state$flying[[i]]$twice <- TRUE
    state$flying[[length(state$flying) + 1L]] <- list(
      chunk = one$chunk, task = give(one$chunk), since = proc.time()[[3L]], twice = TRUE
    )
  }
}

take_landed <- function(one, state, folder, call) {
  value <- one$task$data
  if (inherits(value, "errorValue")) {
    key <- as.character(one$chunk)
    state$tries[[key]] <- (state$tries[[key]] %||% 0) + 1
    if (as.integer(value) %in% lost_tasks && state$tries[[key]] < 3) {
      state$queue <- c(one$chunk, state$queue)
    } else {
      state$failed[[length(state$failed) + 1L]] <- list(
        one$chunk, simpleError(paste("the daemon was lost:", format(value)))
      )
    }
    return()
  }
  if (is.null(value$failed)) {
    state$done <- state$done + 1
    state$took <- c(state$took, value$seconds)
    # The other one that was given this chunk is not waited for.
    state$flying <- Filter(function(other) other$chunk != one$chunk, state$flying)
    return()
  }
  if (value$kind == "no_rotdyn") {
    abort_rotdyn(c(
      "A daemon on {value$host} cannot load rotdyn.",
      i = "Set {.envvar R_LIBS} before it starts, or {.code .libPaths()} in its {.file .Rprofile}."
    ), "package", call)
  }
  if (value$kind %in% c("rotdyn_error_file", "rotdyn_error_canary")) {
    abort_rotdyn(c(
      "The sweep stopped at chunk {one$chunk}, on {value$host}.",
      x = braces_doubled(value$failed), i = "What is committed stays: {.fn sweep_resume} goes on."
    ), sub("^rotdyn_error_", "", value$kind), call)
  }
  state$failed[[length(state$failed) + 1L]] <- list(one$chunk, simpleError(value$failed))
}
