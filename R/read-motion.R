#' Read measured motions from files
#'
#' `read_motion()` tells the format of a file from its content and reads it; the others read one
#' format. All return a [motion_record()].
#'
#' * **phyphox**: CSV with comma, semicolon or tab, decimal point or comma; the zip of these with
#'   the times of pauses; `.xls`.
#' * **Tracker**: exported text, or a `.trk` project, whose marks become positions in m by its axes
#'   (the picture's y is down), its angle and its scale. Units in the headings of a text are
#'   converted (`x (cm)`), positions without a unit are in m. Its column `frame` gives the times
#'   where `frame_rate_hz` is given; without that column the median step of time is one frame.
#' * **Vernier**: CSV and text of Logger Pro and Graphical Analysis, `.cmbl`, `.gambl`.
#' * **PASCO** Capstone: CSV or text, runs side by side.
#' * **IMU** logs: Sensor Logger, NGIMU, xio, and any table with units in its headings; in names
#'   without a slash, `gyro_z_rad_s` is a rate in rad/s.
#'
#' Times of day, with or without a date (`2026-03-01T10:11:12.5Z`, `10:11:12.5`), become seconds
#' since the first row. Without a date, a time half a day before the one above is of the next day.
#' A column of dates joins the nearest column of times of day without a date. The order of day and
#' month in `30/12/2026` follows from a day after the twelfth in any row; dates that change and do
#' not determine the order are an error (of two digits, the year may be first). A cell with a date
#' that does not exist is missing.
#' A column of seconds is read before one of times of day.
#'
#' In a file with decimal commas a cell with a point (`1.600`) is no number.
#'
#' Separators, decimal marks, the encoding and the line of the headings are found. Runs side by side
#' become segments. Rows with another number of cells than the first are dropped and named, never
#' shifted; more than a tenth of them is an error. Of an angle and a rate from one instrument, the
#' angle is read.
#'
#' Pauses of phyphox are not in its time column. They are found in the zip (`meta/time.csv`) or the
#' sheet of its Excel file, else only where a time appears twice.
#'
#' @param file Path of the file.
#' @param ... For `read_motion()`: arguments of the reader. Else not used: an unknown argument is an
#'   error.
#' @param axis For rates about three axes: `"x"`, `"y"`, `"z"`, `"principal"` or `"all"`, as in
#'   [motion_record()]. By default `"principal"`, but `"all"` where the motion is about no fixed
#'   axis.
#' @param sheet Name of the table to read, where a zip or an Excel file has several.
#' @param mark,centre For a project with several marks: name of the mark, and of the mark of the
#'   centre if that was tracked.
#' @param centre_m Centre of the rotation in m: two numbers, or `"fit"`.
#' @param frame_rate_hz Frames a second, where the file's is that of playback. By default the one in
#'   the file: Tracker takes it from the video.
#' @param angle_unit `"deg"` or `"rad"`: Tracker's angles have no unit in an export.
#' @param run Names or numbers of the runs to read; all by default.
#' @param headings Names for the columns, where the file has none or none with units:
#'   `c("time_s", "omega_deg_per_s")`.
#' @param rate_hz Rows a second, for a log without times; times that it has are not used.
#' @param quantity `"rate"` or `"other"`: what columns `x`, `y`, `z` without units are. By default a
#'   rate in rad/s if the file's name has `gyro`.
#' @return A [motion_record()].
#' @section Errors: `rotdyn_error_file` for a file that is missing, damaged or of another format, or
#'   has no time or no rotation; `rotdyn_error_missing` where a choice is needed (`angle_unit`,
#'   `mark`), `rotdyn_error_package` (readxl for `.xls`; xml2 for `.trk`, `.cmbl` and `.gambl`), and
#'   those of [motion_record()].
#' @source phyphox: export formats of RWTH Aachen's phyphox, version 1.1; Tracker: Brown, Open
#'   Source Physics, version 5; Vernier: data sets of Logger Pro 3 and Graphical Analysis.
#' @seealso [motion_record()] for data frames, [fit_swing()].
#' @concept measurement
#' @concept phyphox
#' @concept Tracker
#' @concept Vernier
#' @concept PASCO
#' @concept gyroscope
#' @examples
#' file <- tempfile(fileext = ".csv")
#' writeLines(c(
#'   "\"Time (s)\";\"Gyroscope x (rad/s)\";\"Gyroscope y (rad/s)\";\"Gyroscope z (rad/s)\"",
#'   "0,00E0;1,2E-2;-3,1E-3;5,01E0", "1,00E-2;1,1E-2;-3,3E-3;4,99E0",
#'   "2,00E-2;1,3E-2;-3,0E-3;4,98E0"
#' ), file)
#' read_motion(file)
#' read_phyphox(file, axis = "z")
#' # A table of a sensor in rpm, without times, at 50 rows a second.
#' writeLines(c("n,w (rpm)", "1,10", "2,20", "3,30"), file)
#' read_imu(file, rate_hz = 50)
#' # Exports of Tracker, Vernier's programs and PASCO Capstone.
#' writeLines(c("mass A", "t\tx\ty", "0\t0.2\t0", "0.1\t0.17\t0.1", "0.2\t0.1\t0.17"), file)
#' read_tracker(file, centre_m = c(0, 0))
#' writeLines(c("Latest: Time (s),Latest: Angle (deg)", "0,10", "0.1,20", "0.2,40"), file)
#' read_vernier(file)
#' writeLines(c("Time (s) Run #1,Angle (rad) Run #1", "0,0.1", "0.1,0.3", "0.2,0.6"), file)
#' read_pasco(file)
#' unlink(file)
#' @export
read_motion <- function(file, ...) {
  call <- current_env()
  check_supplied("file", call)
  bytes <- read_bytes(file, call)
  format <- motion_format(bytes, file, call)
  reader <- switch(format,
    phyphox = read_phyphox, tracker = read_tracker, vernier = read_vernier, pasco = read_pasco,
    imu = read_imu
  )
  given <- rlang::names2(list(...))
  known <- setdiff(names(formals(reader)), c("file", "..."))
  if (!all(given %in% known)) {
    abort_rotdyn(c(
      "{.arg {setdiff(given, known)}} {?is/are} not known to the reader of this file.",
      x = "It is a {format} file: its reader takes {.arg {known}}."
    ), "argument", call)
  }
  read_as(format, file, bytes, list(...), call)
}

# The formats by name: each has a function of the file's name, its bytes, the arguments and the
# call.
read_as <- function(format, file, bytes, arguments, call) {
  read <- switch(format,
    phyphox = phyphox_record, tracker = tracker_record, vernier = vernier_record,
    pasco = pasco_record, imu = imu_record
  )
  do.call(read, c(list(file, bytes, call), arguments))
}

starts_with_bytes <- function(bytes, ...) {
  mark <- as.raw(c(...))
  length(bytes) >= length(mark) && identical(bytes[seq_along(mark)], mark)
}

is_zip <- function(bytes) starts_with_bytes(bytes, 0x50, 0x4b, 0x03, 0x04)
is_ole <- function(bytes) starts_with_bytes(bytes, 0xd0, 0xcf, 0x11, 0xe0)
is_tar <- function(bytes) {
  length(bytes) > 512L && identical(bytes[258:262], charToRaw("ustar"))
}

motion_format <- function(bytes, file, call) {
  if (is_ole(bytes)) return("phyphox")
  if (is_zip(bytes)) {
    names <- zip_names(file, call)
    return(if (any(grepl("[.]trk$", names))) "tracker" else "phyphox")
  }
  if (is_tar(bytes)) return("vernier")
  text <- decode_bytes(bytes, file, call)
  head <- substr(text, 1L, 5000L)
  if (grepl("^\\s*<", head)) {
    if (grepl("opensourcephysics", head, fixed = TRUE)) return("tracker")
    if (grepl("<ColumnCells>", text, fixed = TRUE)) return("vernier")
    abort_file("It is XML, but no project of Tracker or Vernier.", file, call)
  }
  if (grepl("Vernier Format|(Latest|Data Set( [0-9]+)?|Run [0-9]+) ?: ?[^,;\t\n]*[(]", head)) {
    return("vernier")
  }
  if (grepl("Run #[0-9]+", head)) return("pasco")
  first <- split_lines(head)
  first <- first[nzchar(trimws(first))]
  if (grepl("^\"?(Time|t) \\(s\\)\"?[,;\t]\"?(Gyroscope|Gyro|Angular velocity|Gyroskop)[^0-9]*x",
    first[1])) {
    return("phyphox")
  }
  # A line of names of tracks, then one that begins with t.
  time <- "^\"?t\"?[ ]?(\\([a-z]+\\))?[,;\t ]+\"?"
  if (length(first) > 2L && any(grepl(paste0(time, "[xyr\u03b8]"), first[1:2])) &&
    (grepl(time, first[2]) || !grepl("[(]", first[1]))) {
    return("tracker")
  }
  "imu"
}

# ---- archives -----------------------------------------------------------------------------------

zip_names <- function(file, call) {
  found <- tryCatch(
    suppressWarnings(utils::unzip(file, list = TRUE)), error = function(e) NULL
  )
  if (is.null(found) || !nrow(found)) abort_file("It is a damaged zip archive.", file, call)
  as.character(found$Name)
}

# The bytes of one file of a zip.
zip_bytes <- function(file, name, call) {
  folder <- tempfile("rotdyn")
  made <- dir.create(folder, showWarnings = FALSE)
  on.exit(unlink(folder, recursive = TRUE))
  out <- if (made) unzip_one(file, name, folder)
  size <- zip_size(file, name)
  # On a full disk there may be a part of it.
  whole <- length(out) == 1L && file.exists(out) && (is.na(size) || file.size(out) == size)
  if (whole) return(readBin(out, "raw", file.size(out)))
  fault <- if (made) fault_of_writing(folder, size) else "The folder cannot be made."
  if (nzchar(fault)) {
    abort_rotdyn(c(
      "A part of the file {.file {file}} cannot be written to the folder of temporary files.",
      x = braces_doubled(fault),
      i = "The folder is {.file {dirname(folder)}}; the environment variable {.envvar TMPDIR} names
           another one before R starts."
    ), "file", call)
  }
  abort_file(paste0("Its part \"", name, "\" is damaged."), file, call)
}

unzip_one <- function(file, name, folder) {
  tryCatch(
    suppressWarnings(utils::unzip(file, files = name, exdir = folder, junkpaths = TRUE)),
    error = function(e) NULL
  )
}

# Its size unpacked, as the archive says; NA where it does not.
zip_size <- function(file, name) {
  listed <- utils::unzip(file, list = TRUE)
  as.double(listed$Length[match(name, listed$Name)])
}

# "", or why so many bytes cannot be written there: R's unzip() does not say.
fault_of_writing <- function(folder, bytes) {
  trial <- file.path(folder, "trial")
  on.exit(unlink(trial))
  unlink(list.files(folder, full.names = TRUE))
  put_file(raw(min(bytes, 2^30, na.rm = TRUE)), trial)
}

# The files of a tar archive: a list of raw vectors by name.
tar_files <- function(bytes, file, call) {
  out <- list()
  at <- 0
  field <- function(from, n) {
    raw <- bytes[at + from + seq_len(n)]
    zero <- match(as.raw(0), raw, nomatch = n + 1L)
    text <- rawToChar(raw[seq_len(zero - 1L)])
    if (validUTF8(text)) trimws(text) else ""
  }
  while (at + 512 <= length(bytes) && bytes[at + 1] != as.raw(0)) {
    size <- field(124, 12)
    size <- if (grepl("^[0-7]+$", size)) strtoi(size, 8L) else NA
    if (is.na(size) || at + 512 + size > length(bytes)) {
      abort_file("It is a damaged tar archive.", file, call)
    }
    name <- field(0, 100)
    if (nzchar(name)) out[[name]] <- bytes[at + 512 + seq_len(size)]
    at <- at + 512 + 512 * ceiling(size / 512)
  }
  out
}

# XML, without the network and with bounded depth. Bytes in UTF-8 are read as such, whatever the
# declaration says; others as declared, or as Latin-1 where they are not what is declared.
read_xml_bytes <- function(bytes, file, call) {
  need_package("xml2", "Reading this file", call)
  read <- function(encoding) {
    tryCatch(
      suppressWarnings(
        xml2::read_xml(bytes, encoding, options = c("NONET", "NOERROR", "NOWARNING"))
      ),
      error = function(e) NULL
    )
  }
  zero <- any(bytes[seq_len(min(length(bytes), 2000L))] == as.raw(0))
  out <- if (!zero && validUTF8(rawToChar(bytes[bytes != as.raw(0)]))) read("UTF-8") else read("")
  if (is.null(out) && !zero) out <- read("latin1")
  if (is.null(out)) abort_file("It is damaged XML.", file, call)
  out
}
