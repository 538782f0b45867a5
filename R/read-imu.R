#' @rdname read_motion
#' @export
read_imu <- function(file, ..., axis = NULL, headings = NULL, rate_hz = NULL,
                     quantity = NULL) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  imu_record(file, read_bytes(file, call), call, axis, headings, rate_hz, quantity)
}

imu_record <- function(file, bytes, call, axis = NULL, headings = NULL, rate_hz = NULL,
                       quantity = NULL) {
  if (is_zip(bytes) || is_ole(bytes) || is_tar(bytes)) {
    abort_file("It is no table of text.", file, call)
  }
  table <- read_delimited(decode_bytes(bytes, file, call), file, call)
  notes <- character()
  if (!is.null(quantity)) quantity <- check_string(quantity, "quantity", c("rate", "other"), call)
  table <- name_columns(table, headings, call)
  # Sensor Logger has the same headings, z before x and without units, for every sensor.
  heads <- table$headings
  parts <- c("x", "y", "z")
  if (all(c("seconds_elapsed", parts) %in% heads)) {
    if (is.null(quantity) && grepl("gyro", lower_case(basename(file)), fixed = TRUE)) {
      quantity <- "rate"
      notes <- "the file is called a gyroscope's: x, y, z are in rad/s"
    }
    if (is.null(quantity)) {
      abort_rotdyn(c(
        "{.arg quantity} is missing: the columns x, y and z have no units.",
        i = "Sensor Logger writes all its sensors alike: {.val rate} for the gyroscope."
      ), "missing", call)
    }
    if (quantity == "other") abort_file("It has no rotation.", file, call)
    table$headings[match(parts, heads)] <- paste0("Gyroscope ", parts, " (rad/s)")
    table$headings[match("seconds_elapsed", heads)] <- "Time (s)"
    keep <- heads != "time"
    table$headings <- table$headings[keep]
    table$columns <- table$columns[keep]
    table$odd <- table$odd[keep]
  }
  if (is.null(rate_hz) && !any(heading_table(table$headings)$kind %in% "time") &&
    length(table$headings)) {
    abort_file(
      paste("None of its headings says a time:", quote_all(table$headings)), file, call,
      "A log without times has a fixed rate: {.code rate_hz = }. Else name the column of the times
       in {.arg headings}."
    )
  }
  if (!is.null(rate_hz)) {
    rate_hz <- check_number(rate_hz, "rate_hz", "1", call, lower = 0, open = TRUE)
    other <- !heading_table(table$headings)$kind %in% "time"
    n <- length(table$columns[[1]])
    table$headings <- c("Time (s)", table$headings[other])
    table$columns <- c(list((seq_len(n) - 1) / rate_hz), table$columns[other])
    table$odd <- c(0L, table$odd[other])
    notes <- c(notes, paste(format(rate_hz), "rows a second, without gaps"))
  }
  record_from_table(
    table, call, file, paste0(basename(file), " (table)"), axis = axis, notes = notes,
    marks = "keep"
  )
}
