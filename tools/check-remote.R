# Daemons through SSH and TLS compute a sweep in a folder. Called by tools/check-remote.sh, which
# has started an sshd.
#
#   Rscript tools/check-remote.R FOLDER PORT                      the check
#   Rscript tools/check-remote.R FOLDER PORT coordinate early     daemons are there at the start
#   Rscript tools/check-remote.R FOLDER PORT coordinate late      none is
suppressPackageStartupMessages(library(rotdyn))
options(cli.progress_show_after = 1e9)
arguments <- commandArgs(TRUE)
work <- arguments[1]
port <- arguments[2]
when <- arguments[4]
r <- file.path(R.home("bin"), "Rscript")
chunks <- 40
plan <- sweep_plan(
  scene_axle(
    body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
  ),
  time_s = 400,
  design_random(chunks * 2^16, seed = 42, "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)),
  outputs = "final_theta_rad", chunk_rows = 2^16
)
folder_of <- function(when) file.path(work, paste0("sweep-", when))

# ---- a coordinator ------------------------------------------------------------------------------

if (!is.na(when)) {
  url <- sub("//.*:0$", "//127.0.0.1:0", mirai::host_url(tls = TRUE)[1])
  through <- function(command) {
    mirai::ssh_config(paste0("ssh://127.0.0.1:", port), command = command, rscript = r)
  }
  if (when == "early") {
    mirai::daemons(2, url = url, remote = through(file.path(work, "ssh")))
  } else {
    mirai::daemons(url = url)
    commands <- as.character(mirai::launch_remote(2, remote = through(NULL)))
    saveRDS(commands, file.path(work, "commands.rds"))
  }
  sweep_run(plan, folder_of(when))
  pids <- unlist(lapply(mirai::everywhere(
    list(Sys.getpid(), nzchar(Sys.getenv("SSH_CONNECTION")))
  ), function(task) {
    said <- mirai::call_mirai(task)$data
    paste(said[[1]], said[[2]])
  }))
  cat(mirai::status()$daemons, "\n", pids, "\n", sep = " ", file = file.path(work, "said"))
  mirai::daemons(0)
  quit()
}

# ---- the check ----------------------------------------------------------------------------------

failed <- 0
verdict <- function(good, ...) {
  if (!good) failed <<- failed + 1
  cat(if (good) "ok - " else "not ok - ", ..., "\n", sep = "")
}
wait_for <- function(what, condition, limit_s = 300) {
  end <- proc.time()[[3]] + limit_s
  while (!condition()) {
    if (proc.time()[[3]] > end) stop("no ", what, " after ", limit_s, " s", call. = FALSE)
    Sys.sleep(0.01)
  }
}
lives <- function(pid) {
  stat <- tryCatch(suppressWarnings(readLines(file.path("/proc", pid, "stat"), 1L)),
                   error = function(e) "")
  length(stat) == 1L && nzchar(stat) && !grepl("^.*[)] [ZX] ", stat)
}
pids_file <- function(pid) file.path(work, "state", "pids", pid)
daemons_seen <- function() {
  pids <- dir(file.path(work, "state", "pids"))
  as.integer(Filter(function(pid) {
    grepl("^daemon", c(readLines(pids_file(pid), warn = FALSE), "")[1])
  }, pids))
}
done <- function(folder) length(dir(file.path(folder, "sums")))
start <- function(when) {
  said <- file.path(work, paste0("pid-", when))
  line <- paste(
    "echo $$ >", shQuote(said), "; touch", paste0(shQuote(pids_file("")), "$$;"), "exec",
    shQuote(r), "tools/check-remote.R", shQuote(work), port, "coordinate", when, ">",
    shQuote(file.path(work, paste0("log-", when))), "2>&1 < /dev/null"
  )
  system2("sh", c("-c", shQuote(line)), wait = FALSE)
  wait_for("process", function() {
    file.exists(said) && length(readLines(said, warn = FALSE)) == 1L
  })
  as.integer(readLines(said))
}
examine <- function(when, folder) {
  log <- readLines(file.path(work, paste0("log-", when)), warn = FALSE)
  fault <- any(grepl("^Error", log))
  verdict(!fault, when, " daemons: the coordinator ends without an error")
  if (fault) return(writeLines(paste("  ", log)))
  verdict(identical(sweep_digest(folder), digest), when,
          " daemons: the digest is that of one process")
  verdict(
    identical(dir(folder, all.files = TRUE, no.. = TRUE), c("rows", "run.json", "sums", "work")) &&
      !length(dir(file.path(folder, "work"), all.files = TRUE, no.. = TRUE)),
    when, " daemons: work/ is empty"
  )
}

digest <- sweep_digest(sweep_run(plan))
folder <- folder_of("early")
clock <- proc.time()[[3]]
coordinator <- start("early")
wait_for("end of the sweep", function() !lives(coordinator))
cat(sprintf("  %.1f s for %d chunks, with the start of daemons\n", proc.time()[[3]] - clock,
            done(folder)))
examine("early", folder)
said <- strsplit(readLines(file.path(work, "said"), warn = FALSE), " +")
verdict(
  startsWith(trimws(paste(said[[1]], collapse = "")), "tls+tcp://127.0.0.1:") &&
    length(daemons_seen()) == 2L && setequal(said[[2]][said[[2]] != ""], c(daemons_seen(), "TRUE")),
  "two daemons, through SSH, by TLS"
)
wait_for("end of the daemons", function() !any(vapply(daemons_seen(), lives, NA)))
unlink(pids_file(daemons_seen()))

# No daemon at the start; two come later, and one of them is killed.
folder <- folder_of("late")
coordinator <- start("late")
wait_for("owner", function() {
  file.exists(file.path(folder, "owner.json")) || !lives(coordinator)
})
Sys.sleep(3)
verdict(lives(coordinator) && done(folder) == 0L, "without daemons the sweep waits")
for (command in readRDS(file.path(work, "commands.rds"))) {
  system2(file.path(work, "ssh"), c("-fTp", port, "127.0.0.1", shQuote(command)), wait = FALSE)
}
killed <- NA
wait_for("chunk of both daemons", function() {
  log <- file.path(work, "state", "log")
  began <- if (file.exists(log)) readLines(log, warn = FALSE)
  at_work <- sub("^.* ", "", grep("late", began, value = TRUE))
  if (length(unique(at_work)) == 2L) killed <<- as.integer(at_work[length(at_work)])
  !is.na(killed) || !lives(coordinator)
})
if (!is.na(killed)) {
  before <- done(folder)
  tools::pskill(killed, tools::SIGKILL)
  cat("  a daemon is killed after", before, "chunks\n")
}
wait_for("end of the sweep", function() !lives(coordinator))
verdict(!is.na(killed) && before < chunks, "one of two late daemons is killed during the sweep")
examine("late", folder)
cat("remote:", if (failed) paste(failed, "failed") else "all passed", "\n")
quit(status = failed > 0)
