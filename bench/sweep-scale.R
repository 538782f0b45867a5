# What a row of a sweep costs beside the model that computes it, threads, designs, and a sweep of
# 1e9 rows. From the top of the repository, with the package installed:
#
#   Rscript bench/sweep-scale.R               ratios, a minute or two
#   Rscript bench/sweep-scale.R --rounds=21   more rounds than 7
#   Rscript bench/sweep-scale.R --billion     1e9 rows with a summary: time, peak memory, summary
#   Rscript bench/sweep-scale.R --rows=1e7    the same with other rows
#
# Contenders take turns, and a ratio is that of neighbouring turns (bench/paired.R). A limit that is
# missed says so; what could not run is "not measured".

if (!file.exists("bench/sweep-scale.R")) stop("run this from the top of the repository")
library(rotdyn)
for (file in c("paired", "peers")) source(file.path("bench", paste0(file, ".R")))

args <- commandArgs(trailingOnly = TRUE)
value_of <- function(name, otherwise) {
  at <- startsWith(args, paste0("--", name, "="))
  if (any(at)) as.numeric(sub(".*=", "", args[at][1])) else otherwise
}
rounds <- value_of("rounds", 7)

figure <- function(what, found, limit = NA, least = FALSE, unit = "") {
  verdict <- if (is.na(limit) || is.na(found)) {
    ""
  } else {
    sprintf(
      "%s %g: %s", if (least) "at least" else "at most", limit,
      if (if (least) found >= limit else found <= limit) "yes" else "no"
    )
  }
  shown <- if (is.na(found)) "not measured" else paste0(format(found, digits = 3), unit)
  cat(sprintf("%-66s %14s  %s\n", what, shown, verdict))
}

or_not_measured <- function(code) {
  tryCatch(code, error = function(e) {
    message("  not measured: ", conditionMessage(e))
    NA_real_
  })
}

# The option by which R compiles threads.
openmp <- function() {
  lines <- readLines(file.path(R.home("etc"), "Makeconf"))
  sub(".*= *", "", grep("^SHLIB_OPENMP_CFLAGS *=", lines, value = TRUE)[1])
}

# ---- rows in the core ---------------------------------------------------------------------------

# Time of rot_rows_run() over that of the builder and the model's own call, rows that vary alike.
core_rows <- function(program, n = 2048) {
  set.seed(1)
  u <- sample((seq_len(n) - 0.5) / n)
  for (model in c("incline_exact", "axle_linear", "axle_drag", "free_exact")) {
    way <- function(name) child(program, paste(name, model), u)
    rows <- c("theta_rad", "omega_rad_per_s")
    if (!identical(solve_child(way("core"))[rows], solve_child(way("own"))[rows])) {
      stop("rows of ", model, " differ from its runs")
    }
    result <- suppressMessages(paired("sweep-scale", model, list(
      contender("builder and own call", way("pair")), contender("row of a sweep", way("core")),
      contender("own call", way("own")), contender("builder", way("build"))
    ), rounds))
    ns <- result$median_us / n * 1e3
    cat(sprintf(
      "%s: a row %.0f ns, own call %.0f, builder %.0f\n", model, ns[2], ns[3], ns[4]
    ))
    ratio <- result$ratio_median # over builder and own call, of the same round
    figure("  over own call and builder", ratio[2], 1.3)
    figure("  less the builder, over the own call", (ratio[2] - ratio[4]) / ratio[3], 1.3)
  }
}

# Processors that share a clock or a core are slower when all are at work: two programs that know
# nothing of each other took 6.1 ms each where one alone took 3.6. So one thread is timed with the
# other processor at work.
with_other_busy <- function(busy, run) {
  command <- paste(c(shQuote(c(busy$command, busy$args)), "time 3 1e12 > /dev/null 2>&1 & echo $!"),
                   collapse = " ")
  pid <- as.integer(system(command, intern = TRUE))
  on.exit(tools::pskill(pid, tools::SIGKILL))
  Sys.sleep(0.05)
  run()
}

# run(threads) => its microseconds; `busy`: a child that works on one processor. One thread over
# two, rounds in turn, with the other processor at work and without.
threads_figure <- function(what, run, busy) {
  ratio <- vapply(seq_len(rounds), function(round) {
    two <- run(2)
    c(with_other_busy(busy, function() run(1)), run(1)) / two
  }, double(2))
  figure(paste0(what, ": one thread over two"), stats::median(ratio[1, ]), 1.8, least = TRUE)
  figure("  with one processor idle meanwhile", stats::median(ratio[2, ]))
}

# Blocks of a Sobol design by one thread and by two.
core_threads <- function(program, n = 65536) {
  u <- (seq_len(n) - 0.5) / n
  for (model in c("axle_drag", "free_exact")) {
    way <- function(threads) child(program, paste(threads, model), u)
    if (!identical(solve_child(way(1)), solve_child(way(2)))) stop("threads change the rows")
    threads_figure(
      paste0(model, ", blocks of 65,536 rows"),
      function(threads) time_child(way(threads), 3, 1e4), way(1)
    )
  }
}

# ---- the package --------------------------------------------------------------------------------

wheel <- scene_axle(0.0625, 0.8, resistance(0.03))

three_inputs <- function(n) {
  design_sobol(
    n, seed = 1, omega0_rad_per_s = vary_uniform(0, 3), theta0_rad = vary_uniform(0, 1),
    "resistance$viscous_n_m_s" = vary_uniform(0.01, 0.05)
  )
}

seven <- c(
  "final_theta_rad", "final_omega_rad_per_s", "max_omega_rad_per_s", "min_omega_rad_per_s",
  "max_abs_omega_rad_per_s", "max_theta_rad", "error"
)

run_plan <- function(plan, threads) function() sweep_run(plan, threads = threads)

ratio_of <- function(base, other) {
  paired("sweep-scale", "", list(contender("base", base), contender("other", other)), rounds,
         batches = 2)$ratio_median[2]
}

package_sweeps <- function(program, n = 2^18) {
  plan <- or_not_measured(sweep_plan(wheel, 2, three_inputs(n), seven, keep = "summary"))
  table <- as.data.frame(design_rows(three_inputs(n), 1, n))
  kernel <- function() {
    spin_up_table(
      data.frame(
        moment_of_inertia_kg_m2 = 0.0625, omega0_rad_per_s = table$omega0_rad_per_s,
        theta0_rad = table$theta0_rad, viscous_n_m_s = table[["resistance$viscous_n_m_s"]]
      ),
      torque_steps(0, 0.8), 2, threads = 1
    )
  }
  of_plan <- function(code) if (is.list(plan)) or_not_measured(code) else NA
  figure(
    "3 Sobol inputs, 7 outputs, summary: sweep over spin_up_table()",
    of_plan(ratio_of(kernel, run_plan(plan, 1))), 2
  )
  # Some blocks for each thread.
  long <- or_not_measured(sweep_plan(wheel, 2, three_inputs(2^22), seven, keep = "summary"))
  if (!is.list(long)) return(invisible())
  u <- (seq_len(65536) - 0.5) / 65536
  run <- function(threads) time_batch(run_plan(long, threads), 1)
  run(2)
  threads_figure("the same of 2^22 rows", run, child(program, "1 axle_drag", u))
}

# Processor time of this process, s: of R's own thread, where the system tells (Linux), and of all,
# among them those in which mirai sends and receives.
processor_s <- function(code) {
  own <- function() {
    path <- sprintf("/proc/self/task/%d/schedstat", Sys.getpid())
    if (file.exists(path)) scan(path, quiet = TRUE)[1] / 1e9 else NA_real_
  }
  from <- own()
  took <- system.time(code)
  c(own = own() - from, all = took[["user.self"]] + took[["sys.self"]])
}

# Milliseconds of a coordinator of two daemons for a further chunk, of reading its sums, and of a
# task of mirai alone, given out as chunks are: when another one is done.
coordinator <- function() {
  mirai::daemons(2)
  on.exit(mirai::daemons(0))
  mirai::everywhere(loadNamespace("rotdyn"))[]
  internal <- getNamespace("rotdyn")
  chunks <- function(n) {
    folder <- tempfile("coordinator-", scratch)
    plan <- sweep_plan(wheel, 2, three_inputs(n * 65536), seven[1], keep = "summary",
                       chunk_rows = 65536)
    sweep_create(plan, folder)
    made <- internal$read_plan(folder, NULL)
    list(
      processor_s(internal$complete_folder(made, folder, 1, NULL, NULL)),
      processor_s(sweep_read(folder))
    )
  }
  # As long as a chunk of 65,536 rows of the wheel.
  task <- function() mirai::mirai(Sys.sleep(0.015), .args = list(job = list()))
  tasks <- function(n) {
    flight <- lapply(1:5, function(i) task())
    took <- processor_s(for (i in seq_len(n)) {
      flight[[1]][]
      flight <- c(flight[-1], task())
    })
    lapply(flight, mirai::call_mirai)
    list(took)
  }
  further <- function(run, few, many) {
    run(few)
    Map(function(a, b) (b - a) / (many - few) * 1e3, run(few), run(many))
  }
  c(further(chunks, 128, 1024), further(tasks, 128, 1024))
}

# Numbers of Sobol's sequence in the core, and rows of a design in R.
designs <- function(program, n = 65536) {
  u <- (seq_len(n) - 0.5) / n
  time <- function(how) {
    us <- suppressMessages(paired("sweep-scale", how, list(
      contender(how, child(program, paste("sobol", how), u))
    ), rounds))$median_us
    us / (2 * n) * 1e3
  }
  figure("Sobol's sequence, scrambled: a number", time("scrambled"), 3, unit = " ns")
  figure("  not scrambled", time("plain"), 3, unit = " ns")
  figure("  a row of two numbers by itself, of 2^40", 2 * time("one") / 1e3, 1, unit = " us")
  n <- 2^20
  design <- three_inputs(2^40)
  rows <- function() design_rows(design, 1, n)
  rows()
  ns <- min(replicate(rounds, system.time(rows())[["elapsed"]])) / (3 * n) * 1e9
  figure("design_rows() of three uniform inputs: a number", ns, unit = " ns")
  one <- function() for (i in 1:100) design_rows(design, 2^39, 1)
  first_us <- min(replicate(rounds, system.time(one())[["elapsed"]])) * 1e4
  figure("  row 2^39 alone", first_us, unit = " us")
}

# Peak memory of this process in MB; NA where the system does not tell.
peak_mb <- function() {
  if (!file.exists("/proc/self/status")) return(NA_real_)
  line <- grep("^VmHWM", readLines("/proc/self/status"), value = TRUE)
  as.numeric(gsub("[^0-9]", "", line)) / 1024
}

many_rows <- function(n) {
  plan <- sweep_plan(wheel, 2, three_inputs(n), seven, keep = "summary")
  before <- peak_mb()
  took <- system.time(sweep <- sweep_run(plan, threads = 2))[["elapsed"]]
  figure(paste(format(n, big.mark = ","), "rows with a summary"), took, unit = " s")
  figure("  a row", took / n * 1e9, unit = " ns")
  if (n < 1e9) figure("  1e9 rows at this rate", took / n * 1e9 / 60, unit = " min")
  figure("  peak memory above the session", peak_mb() - before, unit = " MB")
  print(summary(sweep))
}

if ("--billion" %in% args || any(startsWith(args, "--rows="))) {
  many_rows(value_of("rows", 1e9))
} else {
  program <- compile_program("rows-core", c(core_files(), openmp()))
  core_rows(program)
  core_threads(program)
  designs(program)
  package_sweeps(program)
  of_two <- or_not_measured(coordinator())
  if (is.list(of_two)) {
    figure("two daemons: the coordinator for a chunk", of_two[[1]]["own"], 0.5, unit = " ms")
    figure("  with the threads of mirai", of_two[[1]]["all"], unit = " ms")
    figure("  reading the sums of a chunk", of_two[[2]]["all"], unit = " ms")
    figure("  mirai alone for a task", of_two[[3]]["own"], unit = " ms")
    figure("    with its threads", of_two[[3]]["all"], unit = " ms")
  }
}
unlink(scratch, recursive = TRUE)
