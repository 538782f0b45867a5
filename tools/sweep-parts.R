# Parts of sweeps for other readers: folders with values at the edges of doubles, and what memory
# has of them, bit by bit, for sweep-parts.js. nanoparquet is examined here.
#
#   Rscript tools/sweep-parts.R FOLDER
suppressPackageStartupMessages(library(rotdyn))
options(cli.progress_show_after = 1e9)
folder <- commandArgs(TRUE)[1]
ns <- asNamespace("rotdyn")
failed <- 0
verdict <- function(good, ...) {
  if (!good) failed <<- failed + 1
  cat(if (good) "ok - " else "not ok - ", ..., "\n", sep = "")
}

# ---- sweeps -------------------------------------------------------------------------------------

edges <- c(20, 0, -0, 5e-324, -5e-324, 2.2e-308, -1e-310, 1e308, -20, 1 + 2^-52, pi, 1e-300)
starts <- expand.grid(omega0_rad_per_s = edges, theta0_rad = edges[abs(edges) < 1e3])
n <- 3 * 2^16 + 77
wheel <- scene_axle(0.0625, resistance = resistance(0.1), omega0_rad_per_s = 20)
outputs <- c("final_theta_rad", "stop_time_s", "final_omega_rad_per_s")
plans <- list(
  edges = sweep_plan(
    wheel, 1, design_list(starts[rep_len(seq_len(nrow(starts)), n), ]), outputs = outputs,
    chunk_rows = 2^16
  ),
  # Two of the four parts have no row.
  some = sweep_plan(
    wheel, 1, design_list(data.frame(omega0_rad_per_s = seq(-1, 1, length.out = n))),
    outputs = outputs, keep = ~ final_theta_rad > 0.05, chunk_rows = 2^16
  ),
  functions = sweep_plan(
    NULL, 1, design_list(data.frame(m = rep_len(c(1, -1, 5e-324, -0, 2, 1e-310), 600))),
    build = function(row) scene_axle(row$m, 0.2), chunk_rows = 256
  ),
  # Row numbers beyond 2^31.
  far = sweep_plan(
    wheel, 1, design_random(2^32, seed = 1, omega0_rad_per_s = vary_normal(20, 1)),
    outputs = outputs, keep = ~ omega0_rad_per_s > 22, chunk_rows = 2^16
  )
)
far_chunks <- c(1, 2^15, 2^15 + 1, 2^16)

# Rows as memory has them, with the statuses as the numbers that parts have.
in_memory <- function(name, plan) {
  rows <- if (name == "far") {
    do.call(rbind, lapply(far_chunks, function(chunk) {
      range <- ns$chunk_range(plan, chunk)
      ns$rows_table(plan, ns$chunk_of_sweep(plan, range[1], range[2], 1, NULL, environment()))
    }))
  } else {
    sweep_run(plan)
  }
  rows <- lapply(rows, identity)
  rows$status <- match(rows$status, ns$row_statuses()) - 1L
  rows
}
bits <- function(x) writeBin(x, raw(), endian = "little")

records <- list()
kinds <- c(nan = 0, infinite = 0, minus_zero = 0, denormal = 0)
for (name in names(plans)) {
  plan <- plans[[name]]
  to <- file.path(folder, name)
  if (name == "far") {
    sweep_create(plan, to)
    for (chunk in far_chunks) sweep_chunk(to, chunk)
  } else {
    sweep_run(plan, to)
  }
  memory <- in_memory(name, plan)
  doubles <- unlist(memory[vapply(memory, is.double, NA)], use.names = FALSE)
  kinds <- kinds + c(
    sum(is.nan(doubles)), sum(is.infinite(doubles)),
    sum(doubles == 0 & 1 / doubles < 0, na.rm = TRUE),
    sum(doubles != 0 & abs(doubles) < 2^-1022, na.rm = TRUE)
  )
  for (kind in c("rows", "sums")) {
    files <- sort(dir(file.path(to, kind), full.names = TRUE))
    parts <- lapply(files, function(file) as.list(nanoparquet::read_parquet(file)))
    size <- vapply(parts, function(part) length(part[[1]]), 0L)
    if (kind == "rows") {
      same <- identical(names(parts[[1]]), names(memory)) &&
        all(vapply(names(memory), function(column) {
          identical(bits(unlist(lapply(parts, `[[`, column))), bits(memory[[column]]))
        }, NA))
      verdict(same, "nanoparquet reads ", sum(size), " rows of ", length(files), " parts, ", name,
              ", bit for bit as in memory")
    }
    file <- file.path(folder, paste0(name, "-", kind, ".bits"))
    con <- file(file, "wb")
    for (part in parts) for (column in part) writeBin(column, con, endian = "little")
    close(con)
    records[[length(records) + 1L]] <- list(
      name = paste0(name, "/", kind), files = I(files), size = I(size), bits = file,
      glob = file.path(to, kind, "*.parquet"), columns = I(names(parts[[1]])),
      types = I(vapply(parts[[1]], typeof, ""))
    )
  }
}
verdict(all(kinds > 0), paste(kinds, names(kinds), collapse = ", "), " values are among them")
writeLines(ns$json_canonical(records), file.path(folder, "sweep-parts.json"))
quit(status = failed > 0)
