# Kills processes of sweeps in folders at random moments and examines what comes of it.
#
#   Rscript tools/kill-sweep.R FOLDER KILLS SEED         the check (called by tools/kill-sweep.sh)
#   Rscript tools/kill-sweep.R coordinate KEEP FOLDER    a coordinator with two daemons
suppressPackageStartupMessages(library(rotdyn))
options(cli.progress_show_after = 1e9)
arguments <- commandArgs(TRUE)
state <- Sys.getenv("ROTDYN_KILL_STATE")
stopifnot(nzchar(state))

chunks <- 80
plan_with <- function(keep) {
  sweep_plan(
    scene_axle(
      body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
    ),
    time_s = 400,
    design_random((chunks - 1) * 2^16 + 77, seed = 42,
      "body$mass_kg" = vary_normal(2, 0.02), "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)
    ),
    outputs = c("final_theta_rad", "stop_time_s"), chunk_rows = 2^16,
    keep = if (keep == "some") ~ stop_time_s > 110 else keep
  )
}

# ---- a coordinator ------------------------------------------------------------------------------

if (arguments[1] == "coordinate") {
  folder <- arguments[3]
  mirai::daemons(2)
  file.create(file.path(state, paste0("ready-", Sys.getpid())))
  known <- file.exists(file.path(folder, "run.json"))
  done <- if (known) sweep_resume(folder) else sweep_run(plan_with(arguments[2]), folder)
  mirai::daemons(0)
  quit()
}

# ---- processes ----------------------------------------------------------------------------------

work <- arguments[1]
kills_wanted <- as.integer(arguments[2])
set.seed(as.integer(arguments[3]))
failed <- 0
verdict <- function(good, ...) {
  if (!good) failed <<- failed + 1
  cat(if (good) "ok - " else "not ok - ", ..., "\n", sep = "")
}

# When a process began, in ticks since the machine did; NA: it has ended. A number and this are of
# one process alone, also after its number was given to another one.
birth <- function(pid) {
  stat <- tryCatch(suppressWarnings(readLines(file.path("/proc", pid, "stat"), 1L)),
                   error = function(e) "")
  if (!length(stat) || !nzchar(stat) || grepl("^.*[)] [ZX] ", stat)) return(NA_character_)
  strsplit(sub("^.*[)] ", "", stat), " ", fixed = TRUE)[[1]][20]
}
born <- character()
lives <- function(pid) isTRUE(birth(pid) == born[as.character(pid)])

# Waits for what comes surely; the limit is there so that a fault ends the check.
wait_for <- function(what, condition, pause = 0.01, limit_s = 300) {
  end <- proc.time()[[3]] + limit_s
  while (!condition()) {
    if (proc.time()[[3]] > end) stop("no ", what, " after ", limit_s, " s", call. = FALSE)
    Sys.sleep(pause)
  }
}

# The number of the process is known before it becomes R.
start <- function(command, log, environment) {
  said <- tempfile("pid-", work)
  line <- paste0(
    "echo $$ > ", shQuote(said), "; touch ", shQuote(file.path(state, "pids")), "/$$; ",
    "exec env ", environment, " ", command, " > ", shQuote(log), " 2>&1 < /dev/null"
  )
  system2("sh", c("-c", shQuote(line)), wait = FALSE)
  wait_for("process", function() length(readLines_if(said)) == 1L, 0.002)
  pid <- as.integer(readLines(said))
  born[[as.character(pid)]] <<- birth(pid)
  pid
}
readLines_if <- function(path) if (file.exists(path)) readLines(path, warn = FALSE)

profile <- paste0("R_PROFILE_USER=", shQuote(normalizePath("tools/kill-sweep-profile.R")))
start_coordinator <- function(keep, folder, log) {
  command <- paste(
    shQuote(file.path(R.home("bin"), "Rscript")), "tools/kill-sweep.R coordinate", keep,
    shQuote(folder)
  )
  start(command, log, profile)
}
start_job <- function(part, folder, log) {
  start(paste("sh", shQuote(system.file("exec/rotdyn", package = "rotdyn")), "sweep work",
              shQuote(folder), "--part", part, "--of 2"),
        log, paste0("ROTDYN_R=", shQuote(file.path(work, "R-with-log"))))
}

# Daemons write when they began themselves.
daemons_alive <- function() {
  Filter(function(pid) {
    said <- strsplit(c(readLines_if(file.path(state, "pids", pid)), "")[1], " ")[[1]]
    if (!identical(said[1], "daemon")) return(FALSE)
    born[[as.character(pid)]] <<- said[2]
    lives(pid)
  }, as.integer(dir(file.path(state, "pids"))))
}

# ---- what is seen of a folder -------------------------------------------------------------------

# Parts of sums/ with their inode and time of change, as text.
committed <- function(folder) {
  parts <- file.path(folder, "sums")
  listed <- suppressWarnings(system2("ls", c("-i", shQuote(parts)), stdout = TRUE))
  fields <- strsplit(trimws(listed), " +")
  names <- vapply(fields, `[`, "", 2L)
  stats::setNames(
    sprintf("%s %.7f", vapply(fields, `[`, "", 1L), as.double(file.mtime(file.path(parts, names)))),
    names
  )
}

files_in_work <- function(folder) dir(file.path(folder, "work"), "part-[0-9]+[.]parquet")
process_of <- function(names) as.integer(sub("^.*-([0-9]+)[.0-9]*-[^-]*$", "\\1", names))

# ---- a round ------------------------------------------------------------------------------------

# When and whom: numbers of committed chunks, then a part of a chunk's time, or a file in work/.
moments <- function(kills, coordinators) {
  spread <- 0.85 * chunks / kills
  who <- sample(rep(c("coordinator", "worker"), c(coordinators, kills - coordinators)))
  writing <- rep(FALSE, kills)
  writing[who == "worker"] <- rep_len(c(TRUE, FALSE), sum(who == "worker"))
  data.frame(
    at = floor((seq_len(kills) - 1) * spread + stats::runif(kills, 0, 0.3 * spread)), who = who,
    writing = writing, delay = stats::runif(kills, 0, 2), wait = stats::runif(kills) < 0.6,
    pick = stats::runif(kills)
  )
}

# => kills made
one_round <- function(number, by, keep, kills, reference) {
  force(reference)
  folder <- file.path(work, paste0("sweep-", number))
  title <- paste0("round ", number, " (", if (by == "daemons") "two daemons" else "two jobs",
                  ", keep: ", keep, "): ")
  unlink(file.path(state, "log"))
  logs <- character()
  new_log <- function() {
    logs <<- c(logs, file.path(work, paste0("log-", number, "-", length(logs))))
    logs[length(logs)]
  }
  todo <- moments(kills, if (by == "daemons") ceiling(0.4 * kills) else 0)
  seen <- character()
  changed <- 0
  allowed <- 0
  ended <- 0
  left_behind <- 0
  made <- c(coordinator = 0, worker = 0)
  clock <- proc.time()[[3]]
  look <- function() {
    now <- committed(folder)
    other <- setdiff(names(seen), names(now)[now == seen[names(now)]])
    if (length(other)) {
      shown <- utils::head(other, 5)
      cat(paste0("  ", shown, ": ", seen[shown], ", then ", now[shown], "\n"), sep = "")
    }
    changed <<- changed + length(other)
    seen <<- now
  }
  coordinator <- NA
  jobs <- c(NA, NA)
  begin <- function() {
    if (by == "daemons") {
      coordinator <<- start_coordinator(keep, folder, new_log())
    } else {
      for (i in which(is.na(jobs))) jobs[i] <<- start_job(i, folder, new_log())
    }
  }
  workers <- function() if (by == "daemons") daemons_alive() else Filter(lives, jobs[!is.na(jobs)])
  is_over <- function() !(if (by == "daemons") lives(coordinator) else any(vapply(jobs, lives, NA)))
  is_ready <- function() {
    by == "jobs" || file.exists(file.path(state, paste0("ready-", coordinator)))
  }
  if (by == "jobs") invisible(sweep_create(plan_with(keep), folder))
  begin()
  if (by == "daemons") {
    wait_for("folder", function() file.exists(file.path(folder, "run.json")) || is_over())
  }
  chunk_s <- reference$chunk_s
  for (i in seq_len(kills)) {
    one <- todo[i, ]
    victim <- NA
    wait_for("chunk", function() {
      if (is_over()) return(TRUE)
      done <- length(dir(file.path(folder, "sums")))
      if (done > length(seen)) look()
      done >= one$at && is_ready() && length(workers()) > 0L
    })
    if (is_over()) break
    alive <- workers()
    if (one$writing) {
      wait_for("file in work/", function() {
        victim <<- intersect(process_of(files_in_work(folder)), alive)[1]
        # At once: a file is there for some milliseconds.
        if (!lives(victim)) victim <<- NA
        if (is.na(victim)) return(is_over())
        tools::pskill(victim, tools::SIGKILL)
      }, 0.0005)
      if (is.na(victim)) break
    } else {
      Sys.sleep(one$delay * chunk_s)
      victim <- if (one$who == "coordinator") coordinator else {
        alive[1 + floor(one$pick * length(alive))]
      }
      if (!lives(victim)) next
      tools::pskill(victim, tools::SIGKILL)
    }
    made[one$who] <- made[one$who] + 1
    wait_for("end of what was killed", function() !lives(victim), 0.001)
    mine <- process_of(files_in_work(folder)) == victim
    left_behind <- left_behind + sum(mine)
    if (sum(mine) > 1L) verdict(FALSE, title, "a worker that was killed left ", sum(mine), " files")
    cat(sprintf(
      "  %5.1f s, %2d chunks: killed the %s %d%s\n", proc.time()[[3]] - clock,
      length(dir(file.path(folder, "sums"))), one$who, victim, if (any(mine)) ", writing" else ""
    ))
    if (one$who == "worker") {
      ended <- ended + 1
      if (by == "daemons") {
        file.create(file.path(state, paste0("daemon-wanted-", i)))
      } else {
        jobs[jobs %in% victim] <- NA
        begin()
      }
    } else {
      # Daemons without a coordinator finish their chunks. Where another coordinator starts at once,
      # it may give out the same ones.
      unlink(dir(state, "^daemon-wanted", full.names = TRUE))
      ended <- ended + length(alive)
      if (one$wait) {
        wait_for("end of daemons without a coordinator", function() !length(daemons_alive()))
        look()
      } else {
        allowed <- allowed + length(alive)
      }
      begin()
    }
  }
  wait_for("end of the sweep", function() {
    if (length(dir(file.path(folder, "sums"))) > length(seen)) look()
    is_over()
  })
  if (by == "jobs") {
    verdict(!length(sweep_todo(folder)), title, "the jobs leave no chunk to do")
    suppressMessages(sweep_resume(folder))
  }
  look()

  said <- unlist(lapply(logs, readLines, warn = FALSE))
  fault <- grep("^Error|Another process", said, value = TRUE)
  verdict(!length(fault), title, "no process complains", if (length(fault)) paste0(": ", fault[1]))
  if (length(fault)) writeLines(paste("  ", utils::head(said, 40)))
  verdict(identical(sweep_digest(folder), reference$digest), title,
          "the digest is that of one process")
  verdict(
    length(seen) == chunks && changed <= allowed, title, "no committed part was written again",
    if (allowed) paste0(
      ", but ", changed, " by daemons whose coordinator was started again at once (at most ",
      allowed, ")"
    )
  )
  began <- length(readLines(file.path(state, "log")))
  verdict(
    began - chunks <= ended, title, began - chunks, " chunks lost, ", ended, " workers (",
    made[["worker"]], " killed), ", left_behind, " files left in work/"
  )
  entries <- sort(dir(folder, all.files = TRUE, no.. = TRUE))
  verdict(
    identical(entries, c("rows", "run.json", "sums", "work")) &&
      !length(dir(file.path(folder, "work"), all.files = TRUE, no.. = TRUE)) &&
      length(dir(file.path(folder, "rows"))) == if (keep == "summary") 0 else chunks,
    title, "run.json, rows/, sums/ and an empty work/ are there"
  )
  rows <- sweep_read(folder, rows = chunks * 2^16)
  verdict(nrow(sweep_check(folder, chunks = 2)) == 0L, title, "sweep_check() finds nothing")
  verdict(identical(lapply(rows, identity), reference$rows), title,
          nrow(rows), " rows kept are those of one process")
  unlink(folder, recursive = TRUE)
  made
}

# ---- the check ----------------------------------------------------------------------------------

cat("kills at random moments of sweeps of", chunks, "chunks, seed", arguments[3], "\n")
references <- new.env()
reference_of <- function(keep) {
  if (is.null(references[[keep]])) {
    time <- system.time(sweep <- sweep_run(plan_with(keep)))[[3]]
    references[[keep]] <- list(
      digest = sweep_digest(sweep), rows = lapply(sweep, identity), chunk_s = time / chunks
    )
  }
  references[[keep]]
}
rounds <- if (nzchar(Sys.getenv("ONLYJOBS"))) list(c("jobs","rows")) else list(
  c("daemons", "rows"), c("daemons", "some"), c("daemons", "summary"), c("jobs", "rows"),
  c("jobs", "some")
)
made <- c(coordinator = 0, worker = 0)
number <- 0
# A round whose sweep ends before its last kill leaves it to the next ones.
while (sum(made) < kills_wanted && number < 5 + kills_wanted) {
  kind <- rounds[[number %% length(rounds) + 1L]]
  number <- number + 1
  most <- if (kind[1] == "daemons") 8 else 4
  left <- kills_wanted - sum(made)
  made <- made + one_round(number, kind[1], kind[2], min(most, left), reference_of(kind[2]))
}
enough <- floor(0.27 * kills_wanted)
verdict(
  sum(made) == kills_wanted && made[["coordinator"]] >= enough, sum(made), " kills, ",
  made[["coordinator"]], " of the coordinator"
)
cat("kill-sweep:", if (failed) paste(failed, "failed") else "all passed", "\n")
quit(status = failed > 0)
