# Chunks given to the daemons of mirai.

has_daemons <- function(compute) FALSE

run_by_daemons <- function(plan, folder, todo, threads, compute, call) NULL
