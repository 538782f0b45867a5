# Speed and error beside other tools; see bench/README.md. From the top of the repository, with the
# package installed:
#
#   Rscript bench/run.R                       everything, a few minutes
#   Rscript bench/run.R spin-up mesh          some of the comparisons below
#   Rscript bench/run.R --rounds=5 rolling    fewer rounds than 21
#
# Rewrites what it ran in bench/results.csv and bench/README.md.

if (!file.exists("bench/run.R")) stop("run this from the top of the repository")
library(rotdyn)
for (file in c(
  "precise", "paired", "peers", "report", "rolling", "spin-up", "sweep", "function-torque",
  "laws", "calls", "shapes", "mesh", "inclines"
)) {
  source(file.path("bench", paste0(file, ".R")))
}

comparisons <- list(
  "rolling" = run_rolling,
  "spin-up" = run_spin_up,
  "sweep" = run_sweep,
  "function-torque" = run_function_torque,
  "laws" = run_laws,
  "calls" = run_calls,
  "shapes" = run_shapes,
  "mesh" = run_mesh,
  "inclines" = run_inclines
)

args <- commandArgs(trailingOnly = TRUE)
option <- grepl("^--rounds=[1-9][0-9]*$", args)
rounds <- if (any(option)) as.integer(sub("--rounds=", "", args[option][1])) else 21L
wanted <- args[!option]
if (length(bad <- setdiff(wanted, names(comparisons)))) {
  stop("no such comparison: ", bad[1], "; there are ", paste(names(comparisons), collapse = ", "))
}
if (!length(wanted)) wanted <- names(comparisons)

results <- do.call(rbind, lapply(wanted, function(name) {
  message(name)
  comparisons[[name]](rounds)
}))
results <- merge_results(results, names(comparisons))
write_results(results)
write_page(results, wanted)
message("results: ", results_file, " and ", readme_file)
unlink(scratch, recursive = TRUE)
