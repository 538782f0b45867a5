#' @rdname read_motion
#' @export
read_pasco <- function(file, ..., run = NULL) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  pasco_record(file, read_bytes(file, call), call, run)
}

# Capstone writes the runs side by side, "Time (s) Run #1", with empty cells below a shorter one; of
# sensors with different rates, with empty cells between.
pasco_record <- function(file, bytes, call, run = NULL) {
  if (is_zip(bytes) || is_ole(bytes) || is_tar(bytes)) {
    abort_file("It is no text: export the table from Capstone.", file, call)
  }
  table <- read_delimited(decode_bytes(bytes, file, call), file, call)
  runs_record(
    side_by_side(table, file, call), run, paste0(basename(file), " (PASCO Capstone)"), file, call
  )
}
