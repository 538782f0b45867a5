# The command line: a sweep's folder.

cli_sweep_verbs <- function() {
  list(cli_verb(
    "sweep", "work|status|resume DIR", c(2, 2),
    c("computes the rows of a sweep's folder; how far it is",
      "DIR is made by sweep_run() in R. `work` computes the chunks of job N of M, as the jobs of a",
      "scheduler's array do; `resume` computes all that are not done; `status` computes none.",
      "Any number of processes may work on one folder, and may be ended at any time."),
    list(
      cli_option("part", "number", "of `work`: the number of this job, from 1"),
      cli_option("of", "number", "of `work`: how many jobs there are"),
      cli_option("threads", "number", "of `work` and `resume`: threads, at most (1)"),
      cli_option("trust", "flag", "runs the R functions that the folder has; they can do anything")
    ), cli_run_sweep, NULL,
    c("rotdyn sweep work wheels --part $SLURM_ARRAY_TASK_ID --of 100", "rotdyn sweep status wheels",
      "rotdyn sweep resume wheels --threads 4")
  ))
}

# Which options an action takes, and those that it needs.
cli_sweep_actions <- list(
  work = list(takes = c("part", "of", "threads", "trust"), needs = c("part", "of")),
  status = list(takes = character(), needs = character()),
  resume = list(takes = c("threads", "trust"), needs = character())
)

cli_run_sweep <- function(words, options, state) {
  action <- words[1]
  known <- cli_sweep_actions[[action]]
  if (is.null(known)) {
    near <- near_names(action, names(cli_sweep_actions))
    abort_usage(
      "`sweep` takes `work`, `status` or `resume`, not `", action, "`",
      if (length(near)) paste0("; did you mean `", near[1], "`?"), verb = "sweep"
    )
  }
  odd <- setdiff(intersect(names(options), cli_sweep_actions$work$takes), known$takes)
  if (length(odd)) {
    abort_usage("`sweep ", action, "` takes no `--", odd[1], "`", verb = "sweep")
  }
  lacking <- setdiff(known$needs, names(options))
  if (length(lacking)) abort_usage("`--", lacking[1], "` is missing", verb = "sweep")
  folder <- cli_folder(words[2], state)
  threads <- options$threads %||% 1
  trust <- isTRUE(options$trust)
  list(table = switch(action,
    work = sweep_work(folder, options$part, options$of, threads = threads, trust = trust),
    status = sweep_status(folder),
    resume = {
      cli_complete_sweep(folder, threads, trust)
      sweep_status(folder)
    }
  ))
}

# sweep_resume() without reading rows.
cli_complete_sweep <- function(folder, threads, trust) {
  call <- current_env()
  threads <- check_threads(threads, call)
  plan <- open_sweep(folder, trust, call)
  check_canary(plan, folder, call)
  complete_folder(plan, folder, threads, NULL, call)
}

cli_folder <- function(path, state) {
  state$file <- path
  if (path == "-") abort_usage("a folder is no standard input", verb = "sweep")
  if (!file.exists(path)) abort_input("there is no such folder")
  if (!dir.exists(path)) abort_input("this is a file, not a folder")
  path
}
