# What tools/kill-sweep.R knows of a process: its number and kind, in a file of state/pids, and each
# chunk that it begins, in state/log. The profile of coordinators and daemons, sourced in jobs.
local({
  state <- Sys.getenv("ROTDYN_KILL_STATE")
  kind <- if (any(grepl("mirai::daemon", commandArgs(), fixed = TRUE))) "daemon" else "other"
  stat <- sub("^.*[)] ", "", readLines("/proc/self/stat", 1L))
  began <- strsplit(stat, " ", fixed = TRUE)[[1]][20]
  cat(paste0(kind, " ", began, "\n"), file = file.path(state, "pids", Sys.getpid()))
  setHook(packageEvent("rotdyn", "onLoad"), function(...) {
    space <- asNamespace("rotdyn")
    before <- function(name, note) {
      f <- get(name, space)
      unlockBinding(name, space)
      assign(name, function(...) {
        note(...)
        f(...)
      }, space)
    }
    before("commit_chunk", function(plan, folder, chunk, ...) {
      line <- paste(basename(folder), chunk, Sys.getpid())
      cat(line, "\n", sep = "", file = file.path(state, "log"), append = TRUE)
    })
    # The coordinator starts the daemons that the check asks for, as a file each.
    before("look_at_daemons", function(run, ...) {
      asked <- dir(state, "^daemon-wanted", full.names = TRUE)
      unlink(asked)
      if (length(asked)) mirai::launch_local(length(asked))
    })
  })
})
