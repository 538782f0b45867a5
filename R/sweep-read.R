# A sweep read from its folder, checked, and the scene of any of its rows.

#' Read a sweep
#'
#' `sweep_read()`: the rows kept, and the sums of all. `sweep_scene()`: the scene of any row of a
#' plan, a sweep or a folder, to look at with [trajectory()]. `sweep_check()`: whether all parts are
#' as they were written, and whether some chunks come out the same again. `sweep_digest()`: a
#' fingerprint of all rows, kept or not: the same for the same sweep however it was computed.
#'
#' What is missing, cut, or of another chunk or sweep is found by [sweep_resume()], which computes
#' it again. Rows that changed since they were written are refused by `sweep_read()`; any bit that
#' changed is found by `sweep_check()`.
#'
#' @param folder Name of a folder with a sweep. `sweep_scene()`, `sweep_digest()`: also a sweep, and
#'   of the former a plan.
#' @param ... Not used; names after it must be given in full.
#' @param rows Most rows that are read; NULL: a million. The sums are always of all.
#' @param row Number of a row, from 1.
#' @param chunks How many chunks are computed again, spread over the sweep.
#' @param threads As in [sweep_run()].
#' @param trust As in [sweep_run()].
#' @return `sweep_read()`: a tibble of class `rot_sweep`, with the columns `row` (from 1), the
#'   design's and the derived inputs, the outputs, `error` and `status` (`"ok"`, or why the row has
#'   no numbers). [summary()][summary.rot_sweep] and `autoplot()` are of all rows.
#'   `sweep_scene()`: a scene. `sweep_check()`: a tibble with a row for each chunk that is not as it
#'   was written, which [sweep_chunk()] computes again, and the columns
#'   `r describe_columns(sweep_check_columns, sweep_check_meanings)`
#'   `sweep_digest()`: text.
#' @section Errors: `rotdyn_error_file` for a folder without a sweep, with parts that are missing
#'   ([sweep_resume()] computes them) or with rows that are not as they were written;
#'   `rotdyn_error_package`, `rotdyn_error_type`, `rotdyn_error_value`.
#' @source The layout of a folder: [sweep_run()].
#' @seealso [sweep_run()], [summary.rot_sweep()].
#' @concept parameter study
#' @examples
#' plan <- sweep_plan(
#'   scene_axle(0.0625, resistance = resistance(0.002), omega0_rad_per_s = 20), time_s = 60,
#'   design_random(1000, seed = 1, "omega0_rad_per_s" = vary_normal(20, 1))
#' )
#' sweep <- sweep_run(plan)
#' sweep_digest(sweep)
#' fastest <- which.max(sweep$final_theta_rad)
#' trajectory(sweep_scene(sweep, sweep$row[fastest]), c(0, 60))
#'
#' @examplesIf all(c("nanoparquet", "yyjsonr") %in% rownames(utils::installed.packages()))
#' folder <- tempfile("wheels-")
#' identical(sweep_digest(sweep_run(plan, folder)), sweep_digest(sweep))
#' sweep_check(folder)
#' sweep_read(folder, rows = 3)
#' unlink(folder, recursive = TRUE)
#' @export
sweep_read <- function(folder, ..., rows = NULL) {
  call <- check_no_dots(...)
  check_supplied("folder", call)
  if (!is.null(rows)) rows <- check_whole(rows, "rows", call, 0, 2^31 - 1)
  read_sweep(read_plan(folder, call), folder, rows, call)
}

read_sweep <- function(plan, folder, rows, call) {
  need_package("nanoparquet", "Reading a sweep", call)
  parts <- lapply(seq_len(n_chunks(plan)), function(chunk) read_sums_part(plan, folder, chunk))
  missing <- which(vapply(parts, is.null, NA))
  if (length(missing)) {
    abort_rotdyn(c(
      "{length(missing)} of {n_chunks(plan)} chunks of {.file {folder}}
       {cli::qty(length(missing))}{?is/are} not done.",
      i = "{.fn sweep_resume} computes {cli::qty(length(missing))}{?it/them}; {.fn sweep_status}
           says how far it is."
    ), "file", call)
  }
  sums <- .Call(ffi_sweep_join, lapply(parts, `[[`, "sums"))
  if (is.null(sums)) {
    abort_rotdyn(c(
      "The sums of {.file {folder}} are damaged.", i = "{.fn sweep_check} names the chunks."
    ), "file", call)
  }
  kept <- vapply(parts, `[[`, double(1), "kept")
  whole <- list(
    sums = sums, checksum = add_checksums(lapply(parts, `[[`, "checksum")), kept = sum(kept),
    rows = plan$n
  )
  about <- lapply(parts, `[[`, "about")
  new_sweep(plan, read_rows(plan, folder, kept, about, rows, call), whole, folder)
}

#' @exportS3Method tibble::tbl_sum
tbl_sum.rot_sweep <- function(x, ...) {
  sweep <- attr(x, "sweep", exact = TRUE)
  if (is.null(sweep$whole)) return(NextMethod())
  count <- function(n) format(n, big.mark = ",", scientific = FALSE)
  all <- sweep$whole$kept == sweep$whole$rows
  c("A rotdyn sweep" = paste0(
    count(nrow(x)), " x ", ncol(x), ", ", if (all) "all" else count(sweep$whole$kept), " kept of ",
    count(sweep$whole$rows), " rows",
    if (!is.null(sweep$folder)) paste(", in", basename(sweep$folder))
  ))
}

# The first rows kept, up to a million.
read_rows <- function(plan, folder, kept, about, rows, call) {
  limit <- rows %||% 1e6
  if (plan$keep == "summary") limit <- 0
  wanted <- which(cumsum(c(0, kept))[seq_along(kept)] < limit & kept > 0)
  if (plan$keep == "summary" || !length(wanted)) {
    none <- list(column = list(), row = double(), error = double(), status = integer())
    return(rows_table(plan, none))
  }
  if (is.null(rows) && sum(kept) > limit) {
    inform_quickly(c(
      paste0("The first ", format(limit, big.mark = ",", scientific = FALSE), " rows of ",
             format(sum(kept), big.mark = ",", scientific = FALSE), " are read."),
      "All: `rows`, or the Parquet files in `rows/` by DuckDB or arrow."
    ), "sweep")
  }
  read <- lapply(wanted, function(chunk) read_rows_part(folder, chunk, about[[chunk]]))
  bad <- wanted[vapply(read, is.null, NA)]
  if (length(bad)) {
    abort_rotdyn(c(
      "{cli::qty(length(bad))}The rows of chunk{?s} {some_names(whole_words(bad))} are damaged.",
      i = "Computed again: {.code sweep_chunk(\"{folder}\", {whole_words(bad[1])})}."
    ), "file", call)
  }
  all <- do.call(rbind, read)
  all$status <- row_statuses()[all$status + 1L]
  utils::head(all, limit)
}

#' @rdname sweep_read
#' @export
sweep_scene <- function(folder, row, ..., trust = FALSE) {
  call <- check_no_dots(...)
  check_supplied(c("folder", "row"), call)
  plan <- plan_of(folder, trust, call)
  row <- check_whole(row, "row", call, 1, plan$n)
  scene_of_row(plan, row, call)
}

# Of a plan, a sweep or a folder.
plan_of <- function(x, trust, call) {
  if (inherits(x, "rot_sweep_plan")) return(x)
  if (inherits(x, "rot_sweep")) {
    plan <- attr(x, "sweep")$plan
    if (isTRUE(plan$untrusted)) plan <- open_sweep(attr(x, "sweep")$folder, trust, call)
    return(plan)
  }
  open_sweep(x, trust, call)
}

#' @rdname sweep_read
#' @export
sweep_digest <- function(folder, ...) {
  call <- check_no_dots(...)
  check_supplied("folder", call)
  if (!inherits(folder, "rot_sweep")) {
    folder <- read_sweep(read_plan(folder, call), folder, 0, call)
  }
  whole <- attr(folder, "sweep", exact = TRUE)$whole
  if (is.null(whole)) abort_form("", "folder", "sweep", call)
  # The number of rows kept is not of the rows.
  kept <- whole$sums$quantity == -1L & whole$sums$kind == 3L
  whole$sums$value[kept] <- whole$rows
  hash_text(paste(columns_hash(whole$sums), checksum_text(whole$checksum)))
}

#' @rdname sweep_read
#' @export
sweep_check <- function(folder, ..., chunks = 3, threads = 1, trust = FALSE) {
  call <- check_no_dots(...)
  check_supplied("folder", call)
  plan <- read_plan(folder, call)
  need_package("nanoparquet", "Checking a sweep", call)
  chunks <- check_whole(chunks, "chunks", call, 0, 1e6)
  threads <- check_threads(threads, call)
  if (chunks > 0) plan <- open_sweep(folder, trust, call)
  all <- seq_len(n_chunks(plan))
  again <- if (chunks > 0) unique(floor(seq(1, length(all), length.out = min(chunks, length(all)))))
  faults <- lapply(all, function(chunk) {
    fault_of_chunk(plan, folder, chunk, chunk %in% again, threads, call)
  })
  bad <- which(!vapply(faults, is.null, NA))
  as_table(chunk = as.double(bad), fault = as.character(unlist(faults[bad])))
}

fault_of_chunk <- function(plan, folder, chunk, again, threads, call) {
  part <- look_at_part(plan, folder, chunk)
  if (!is.null(part$fault)) return(part$fault)
  if (plan$keep != "summary" && is.null(read_rows_part(folder, chunk, part$about))) {
    return("its rows are damaged")
  }
  if (!again) return(NULL)
  range <- chunk_range(plan, chunk)
  found <- chunk_of_sweep(plan, range[1], range[2], threads, NULL, call)
  same <- identical(found$checksum, part$checksum) &&
    identical(columns_hash(found$sums), columns_hash(part$sums))
  if (!same) "computed again, it has other bits"
}
