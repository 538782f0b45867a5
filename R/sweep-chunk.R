# One chunk of a sweep: its rows kept, its sums, its checksum; and the sums of several.

# Rows first .. first + n - 1, from 1 => list(column, row, error, status, sums, checksum), as
# src/glue/chunk.c makes it.
chunk_of_sweep <- function(plan, first, n, threads = 1, progress = NULL, call,
                           summed = TRUE) {
  how <- list(
    first = first - 1, n = n, block_rows = plan$block_rows, summed = as.double(summed),
    keep = match(plan$keep, c("summary", "rows", "some")) - 1, condition = plan$condition,
    shift = plan$shift %||% double(length(plan$outputs)), replicates = 16, run = plan$group_rows
  )
  rows <- if (plan$kind == "scene") rows_of_scenes(plan, first, n, progress, call)
  found <- .Call(ffi_sweep_chunk, core_sweep(plan, threads), how, rows, progress)
  if (!is.null(found$refused)) abort_refused(found, plan, call)
  found
}

# What follows from the design of how sums are made: rows of a block, and how many rows, or base
# points, in a row are of one group of the standard errors.
plan_sums <- function(plan) {
  adaptive <- plan$kind == "scene" || is_adaptive(plan)
  plan$block_rows <- if (adaptive) 2^8 else 2^16
  points <- if (plan$design$kind == "saltelli") plan$design$n else plan$n
  plan$group_rows <- if (plan$design$kind %in% c("random", "latin")) 1 else ceiling(points / 16)
  plan
}

is_adaptive <- function(plan) {
  models <- all_constraints()[[constraint_place(plan$constraint)]]$models
  is.null(plan$model) || isTRUE(models[[plan$model]]$adapts)
}

# ---- checksums ----------------------------------------------------------------------------------

# Of 64 bits, in two halves.
add_checksums <- function(sums) {
  low <- sum(vapply(sums, `[`, double(1), 2L))
  high <- sum(vapply(sums, `[`, double(1), 1L)) + low %/% 2^32
  c(high %% 2^32, low %% 2^32)
}

checksum_text <- function(sum) {
  hex <- function(x) sprintf("%04x%04x", as.integer(x %/% 65536), as.integer(x %% 65536))
  paste0(hex(sum[1]), hex(sum[2]))
}

checksum_of_text <- function(text) {
  part <- function(from) {
    digits <- substring(text, from, from + 3L)
    strtoi(digits, 16L)
  }
  c(part(1) * 65536 + part(5), part(9) * 65536 + part(13))
}

# ---- the table of rows --------------------------------------------------------------------------

# A chunk's rows as a data frame: row, inputs, outputs, error, status (text).
rows_table <- function(plan, chunk) {
  columns <- chunk$column
  # Of a summary no rows are kept.
  if (!length(columns)) {
    columns <- rep(list(double()), length(all_inputs(plan)) + length(plan$outputs))
  }
  names(columns) <- c(all_inputs(plan), plan$outputs)
  if (!"error" %in% plan$outputs) columns$error <- chunk$error
  as.data.frame(
    c(list(row = chunk$row + 1), columns, list(status = row_statuses()[chunk$status + 1L])),
    optional = TRUE
  )
}
