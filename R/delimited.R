# Tables of numbers as text, from any instrument: encoding, separator, decimal mark and the place of
# the headings are found from the content.

missing_cells <- c("", "NA", "NaN", "nan", "-", "--", "null", "Z1 1:")
number_pattern <- "^[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]{1,4})?$"

# Bytes as UTF-8 text: UTF-8 and UTF-16 with or without a mark, else Latin-1.
decode_bytes <- function(bytes, file, call) {
  n <- length(bytes)
  starts <- function(...) {
    mark <- as.raw(c(...))
    n >= length(mark) && identical(bytes[seq_along(mark)], mark)
  }
  head <- bytes[seq_len(min(n, 2000L))]
  zero <- which(head == as.raw(0)) %% 2L
  if (starts(0xef, 0xbb, 0xbf)) {
    bytes <- bytes[-(1:3)]
  } else if (starts(0xff, 0xfe) || (length(zero) > length(head) / 4 && all(zero == 0L))) {
    return(decode_wide(bytes, "UTF-16LE", starts(0xff, 0xfe), file, call))
  } else if (starts(0xfe, 0xff) || (length(zero) > length(head) / 4 && all(zero == 1L))) {
    return(decode_wide(bytes, "UTF-16BE", starts(0xfe, 0xff), file, call))
  }
  if (any(bytes == as.raw(0))) abort_file("It has zero bytes: it is no text.", file, call)
  text <- rawToChar(bytes)
  if (validUTF8(text)) {
    Encoding(text) <- "UTF-8"
    return(text)
  }
  iconv(text, "latin1", "UTF-8")
}

decode_wide <- function(bytes, encoding, marked, file, call) {
  if (marked) bytes <- bytes[-(1:2)]
  if (length(bytes) %% 2L) bytes <- bytes[-length(bytes)]
  # A character of code 0 would end the text.
  if (any(colSums(matrix(as.integer(bytes), 2L)) == 0)) {
    abort_file("It has characters of code 0: it is no text.", file, call)
  }
  text <- iconv(list(bytes), encoding, "UTF-8")
  if (is.na(text)) abort_file("Its encoding is unknown.", file, call)
  text
}

abort_file <- function(why, file, call, remedy = NULL) {
  # The reason may quote the file, so it is no template; the remedy is one.
  abort_rotdyn(c("{.file {file}} cannot be read.", x = "{why}", i = remedy), "file", call)
}

read_bytes <- function(file, call) {
  check_name(file, "file", call)
  if (!is_readable_text(file)) abort_unreadable(file, "file", call)
  if (!file.exists(file) || dir.exists(file)) {
    abort_rotdyn("There is no file {.file {file}}.", "file", call)
  }
  size <- file.size(file)
  nothing <- function(e) NULL
  bytes <- tryCatch(readBin(file, "raw", size), error = nothing, warning = nothing)
  if (is.null(bytes)) abort_file("The system does not allow it.", file, call)
  if (!length(bytes)) abort_file("It is empty.", file, call)
  bytes
}

split_lines <- function(text) strsplit(text, "\r\n|\n|\r")[[1]]

# Cells of each line; quoted cells may contain separators.
split_cells <- function(lines, separator) {
  if (separator == " ") return(strsplit(trimws(lines), "[ \t]+"))
  # One pattern for all lines: trimws() of each cell takes ten times as long.
  bare <- gsub(paste0(" *", separator, " *"), separator, gsub("^ +| +$", "", lines))
  # strsplit() drops one empty cell at the end.
  out <- strsplit(paste0(bare, separator), separator, fixed = TRUE)
  quoted <- grep("\"", lines, fixed = TRUE)
  out[quoted] <- lapply(lines[quoted], function(line) {
    # Separators inside quotes become a character that no text has.
    parts <- strsplit(line, "\"", fixed = TRUE)[[1]]
    inside <- seq_along(parts) %% 2L == 0L
    parts[inside] <- gsub(separator, "\001", parts[inside], fixed = TRUE)
    whole <- paste0(paste(parts, collapse = ""), separator)
    trimws(gsub("\001", separator, strsplit(whole, separator, fixed = TRUE)[[1]], fixed = TRUE))
  })
  out
}

# Cells with a decimal point. Where the decimal mark is a comma, a point may separate thousands or
# be a decimal point: such a cell is no number.
with_points <- function(cells, decimal) {
  if (decimal == ".") return(cells)
  ifelse(grepl(".", cells, fixed = TRUE), "x", sub(",", ".", cells, fixed = TRUE))
}

is_number_cell <- function(cells, decimal) grepl(number_pattern, with_points(cells, decimal))

cell_numbers <- function(cells, decimal) {
  cells <- with_points(cells, decimal)
  out <- rep(NA_real_, length(cells))
  fine <- grepl(number_pattern, cells)
  out[fine] <- as.numeric(cells[fine])
  out[is.infinite(out)] <- NA_real_
  out
}

# Cells of a row of numbers: a number, a time of day, or what says that there is none.
is_value_cell <- function(cells, decimal) is_number_cell(cells, decimal) | is_stamp(cells)
is_blank_cell <- function(cells) cells %in% missing_cells | is_lone_date(cells)

# The separator and decimal mark with which most lines are rows of as many numbers.
find_dialect <- function(lines, min_cells = 2L) {
  if (length(lines) > 400L) lines <- lines[unique(round(seq(1, length(lines), length.out = 400L)))]
  best <- list(score = 0)
  for (separator in c(",", ";", "\t", " ")) {
    cells <- split_cells(lines, separator)
    size <- lengths(cells)
    for (decimal in c(".", ",")) {
      if (decimal == separator) next
      flat <- unlist(cells)
      row <- rep(seq_along(cells), size)
      number <- is_value_cell(flat, decimal)
      fine <- number | is_blank_cell(flat)
      whole <- size >= min_cells & tabulate(row[!fine], length(cells)) == 0L &
        tabulate(row[number], length(cells)) > 0L
      if (!any(whole)) next
      counts <- table(size[whole])
      score <- max(counts)
      if (score > best$score) {
        best <- list(
          score = score, separator = separator, decimal = decimal,
          size = as.integer(names(counts)[which.max(counts)])
        )
      }
    }
  }
  best
}

# A table: `headings` (character(0) if the file has none), `columns` (doubles), `above` (lines above
# the headings), `dropped` (rows and why). Rows with another number of cells than headings are
# dropped, never shifted; more than a tenth of them is an error, and so are cells that are no
# number.
read_delimited <- function(text, file, call) {
  lines <- split_lines(text)
  lines <- lines[nzchar(trimws(lines))]
  if (length(lines) < 2L) abort_file("It has fewer than two lines.", file, call)
  lines <- join_stamps(lines)
  dialect <- find_dialect(lines)
  # A log of one column: what a counter of a known rate writes.
  if (dialect$score < 2) dialect <- find_dialect(lines, 1L)
  if (dialect$score < 2) {
    abort_file("It is not a table of numbers, whatever the separator.", file, call)
  }
  cells <- split_cells(lines, dialect$separator)
  size <- lengths(cells)
  # A separator at the end of each line is no column.
  blank_end <- vapply(cells, function(row) length(row) > 0L && !nzchar(row[length(row)]), NA)
  numeric_row <- function(row) {
    value <- is_value_cell(row, dialect$decimal)
    any(value) && all(value | is_blank_cell(row))
  }
  first <- 1L
  while (first <= length(cells) && !(size[first] == dialect$size && numeric_row(cells[[first]]))) {
    first <- first + 1L
  }
  if (first > length(cells)) abort_file("It has no row of numbers.", file, call)
  top <- first - 1L
  while (top >= 1L && abs(size[top] - dialect$size) <= blank_end[first] && size[top] > 1L) {
    top <- top - 1L
  }
  # Of one column any line above could be a heading: the last one is.
  if (dialect$size == 1L) top <- max(first - 2L, 0L)
  head <- cells[seq_len(first - 1L)[-seq_len(top)]]
  if (!top) head <- cells[seq_len(first - 1L)]
  width <- dialect$size
  if (length(head) && all(blank_end[first:length(cells)]) &&
    (length(head[[1]]) == width - 1L || !nzchar(head[[1]][width]))) {
    width <- width - 1L
    cells <- lapply(cells, function(row) row[-length(row)])
    size <- lengths(cells)
    head <- lapply(head, function(row) row[seq_len(width)])
  }
  headings <- join_headings(head, width)
  if (!length(headings) && first > 1L && size[first - 1L] > 1L && size[first - 1L] != width) {
    abort_file(
      paste0(
        "Line ", first - 1L, " has ", size[first - 1L], " headings, the rows below have ", width,
        " cells."
      ), file, call
    )
  }
  rows <- first:length(cells)
  fits <- size[rows] == width
  wrong <- which(!fits)
  if (length(wrong) > length(rows) / 10) {
    abort_file(
      paste0(
        length(wrong), " of ", length(rows), " rows have another number of cells than the first (",
        width, "): columns may be shifted."
      ), file, call
    )
  }
  matrix <- matrix(unlist(cells[rows[fits]]), ncol = width, byrow = TRUE)
  # A column is of times of day by most of its first cells.
  few <- matrix[seq_len(min(nrow(matrix), 400L)), , drop = FALSE]
  clock <- which(colMeans(array(is_stamp(few), dim(few))) > 0.5)
  # Of dates, by most of those that are not empty: a date may be written where it changes.
  full <- colSums(array(!few %in% missing_cells, dim(few)))
  dated <- which(colSums(array(is_lone_date(few), dim(few))) > 0.5 * full)
  columns <- lapply(seq_len(width), function(k) {
    if (k %in% clock) {
      stamps <- join_dates(matrix[, k], k, dated, matrix)
      # Dates of unknown order are an error only where the column is read.
      return(tryCatch(stamp_seconds(stamps, file, call), rotdyn_error_file = function(e) {
        structure(rep(NA_real_, length(stamps)), fault = e)
      }))
    }
    cell_numbers(matrix[, k], dialect$decimal)
  })
  odd <- vapply(seq_len(width), function(k) {
    sum(is.na(columns[[k]]) & !matrix[, k] %in% missing_cells)
  }, 0L)
  full <- lapply(columns, function(x) {
    out <- rep(NA_real_, length(rows))
    out[fits] <- x
    attr(out, "fault") <- attr(x, "fault")
    out
  })
  if (length(headings)) headings[clock] <- paste0(headings[clock], clock_mark)
  list(
    headings = headings, columns = full, odd = odd, clock = clock, above = lines[seq_len(top)],
    dropped = as_table(
      row = wrong,
      why = rep(paste("another number of cells than", width), length(wrong))
    ),
    dialect = dialect
  )
}

# Behind the heading of a column of times of day, whatever its name: its numbers are in s.
clock_mark <- " [time of day] (s)"
is_clock <- function(headings) endsWith(headings, clock_mark)
file_headings <- function(headings) sub(clock_mark, "", headings, fixed = TRUE)

# One heading a column from the lines above the numbers: names, short names, units.
join_headings <- function(head, width) {
  head <- head[lengths(head) == width]
  if (!length(head)) return(character())
  last <- head[[length(head)]]
  unit <- vapply(last, function(cell) !nzchar(cell) || !is.null(parse_unit(cell)), NA)
  if (length(head) > 1L && all(unit) && any(nzchar(last))) {
    names <- head[[if (length(head) > 2L) length(head) - 2L else 1L]]
    return(ifelse(nzchar(last), paste0(names, " (", last, ")"), names))
  }
  last
}

# The table of a file that has been read by a reader, as a record. `headings` replaces those of the
# file. Of an angle and a rate, the angle is used: instruments compute the rate from it.
record_from_table <- function(table, call, file, source, axis = NULL, notes = character(),
                              breaks = NULL, headings = NULL, segment = NULL, ...) {
  table <- name_columns(table, headings, call)
  if (!length(table$headings)) {
    abort_file(
      "It has no headings.", file, call,
      "Name its columns: {.code headings = c(\"time_s\", \"theta_rad\")}."
    )
  }
  heads <- heading_table(table$headings)
  columns <- table_columns(table, heads, file, call)
  if (anyDuplicated(names(columns))) {
    abort_file("Two of its columns are the same quantity.", file, call)
  }
  notes <- c(notes, columns$notes)
  record <- columns$columns
  used <- unlist(lapply(record, `[[`, "at"))
  odd <- used[table$odd[used] > 0L]
  rows <- length(table$columns[[1]])
  if (any(table$odd[odd] > rows / 10)) {
    abort_file(
      paste0(
        "Column ", quote_all(table$headings[odd[which.max(table$odd[odd])]]),
        " has cells that are no number."
      ), file, call,
      if (identical(table$dialect$decimal, ",")) {
        "The decimal mark is a comma: a number with a point, as {.val 1.600}, may be 1600 or 1.6.
         Write it without the point."
      }
    )
  }
  if (length(odd)) notes <- c(notes, missing_note(sum(table$odd[odd])))
  if (!is.null(segment)) record$segment <- list(value = segment, heading = "run", arg = "segment")
  omega <- record$omega_rad_per_s$value
  if (!is.matrix(omega)) axis <- NULL
  if (is.matrix(omega) && is.null(axis)) {
    square <- crossprod(omega[stats::complete.cases(omega), , drop = FALSE])
    about_one <- part_across(square, principal_rate(square)) <= across_limit
    axis <- if (about_one) "principal" else "all"
    if (!about_one) notes <- c(notes, "no fixed axis: the rates about all axes")
  }
  build_record(
    record, rows, call,
    axis = axis, source = source, notes = notes,
    breaks = breaks, dropped = table$dropped, ...
  )
}

missing_note <- function(n) {
  paste(n, if (n == 1L) "cell is" else "cells are", "no number: missing")
}

quote_all <- function(x) toString(encodeString(file_headings(x), quote = "\""))

renaming <- "{.fn read_imu} takes other names for its columns: {.arg headings}."

# The columns that a record reads: time and an angle, or rates, or positions.
table_columns <- function(table, heads, file, call) {
  pick <- function(kind) which(heads$kind %in% kind)
  time <- pick("time")
  # Seconds before times of day.
  time <- time[order(is_clock(table$headings[time]))]
  elapsed <- which(heads$name %in% c("seconds_elapsed", "seconds"))
  if (length(elapsed)) time <- elapsed[1]
  if (!length(time)) {
    abort_file(
      paste("None of its headings says a time:", quote_all(table$headings)), file, call, renaming
    )
  }
  notes <- character()
  take <- function(at, arg, factor = heads$factor[at]) {
    list(
      value = table$columns[[at]] * (if (is.na(factor)) 1 else factor),
      heading = file_headings(table$headings[at]), arg = arg,
      unit = if (is.na(heads$unit[at])) record_arguments[[arg]][[2]] else heads$unit[at], at = at
    )
  }
  time <- time[1]
  fault <- attr(table$columns[[time]], "fault")
  if (!is.null(fault)) stop(fault)
  columns <- list(time_s = take(time, "time_s"))
  if (is.na(heads$factor[time])) {
    if (any(abs(columns$time_s$value) > 1e8, na.rm = TRUE)) {
      abort_file(
        paste0(
          "The unit of \"", table$headings[time], "\" is unknown: the numbers are no seconds."
        ),
        file, call, "Give it in {.code headings = }, for instance as {.val time (ns)}."
      )
    }
    if (!heads$name[time] %in% elapsed) notes <- "times without a unit are in s"
  }
  if (is_clock(table$headings[time])) {
    notes <- c(notes, "times of day: seconds since the first row")
  }
  # Date stamps: the difference in their own unit is exact, in s each is rounded to 2e-7.
  first <- which(!is.na(columns$time_s$value))[1]
  if (isTRUE(abs(columns$time_s$value[first]) > 1e8)) {
    factor <- if (is.na(heads$factor[time])) 1 else heads$factor[time]
    stamps <- table$columns[[time]]
    columns$time_s$value <- (stamps - stamps[first]) * factor
    notes <- c(notes, "times are since the first row")
  }
  angle <- pick("angle")
  rate <- setdiff(pick("rate"), which(heads$component %in% "absolute"))
  bare <- which(is.na(heads$kind) & grepl("^(omega|angular[_ ]?velocity)$", lower_case(heads$name)))
  if (!length(angle) && !length(rate) && length(bare) == 1L) {
    rate <- bare
    heads$factor[bare] <- 1
    notes <- c(notes, paste0("\"", table$headings[bare], "\", without a unit, is in rad/s"))
  }
  if (length(angle) == 1L) {
    columns$theta_rad <- take(angle, "theta_rad")
    if (length(rate)) {
      notes <- c(notes, paste0(
        "not used: ", paste0("\"", table$headings[rate], "\"", collapse = ", "),
        " (computed from the angle, as a rule)"
      ))
    }
  } else if (length(angle) > 1L) {
    abort_file(
      paste0(
        "It has several angles: ", quote_all(table$headings[angle]), "."
      ), file, call, "Take one of them with {.fn motion_record}."
    )
  } else if (length(rate) == 1L) {
    columns$omega_rad_per_s <- take(rate, "omega_rad_per_s")
  } else if (length(rate) > 1L) {
    gyro <- rate[grepl("gyr", lower_case(heads$name[rate]), fixed = TRUE)]
    if (length(gyro) >= 2L) rate <- gyro
    part <- heads$component[rate]
    if (length(rate) > 3L || anyNA(part) || anyDuplicated(part)) {
      abort_file(
        paste0(
          "It has several rates: ", quote_all(table$headings[rate]), "."
        ), file, call, "Take those of one sensor with {.fn motion_record}."
      )
    }
    rate <- rate[order(part)]
    columns$omega_rad_per_s <- list(
      value = vapply(rate, function(at) take(at, "omega_rad_per_s")$value,
        double(length(table$columns[[1]]))),
      heading = table$headings[rate], arg = "omega_rad_per_s", unit = heads$unit[rate[1]], at = rate
    )
  } else {
    x <- which(heads$kind %in% "length" & heads$component %in% "x")
    y <- which(heads$kind %in% "length" & heads$component %in% "y")
    if (length(x) != 1L || length(y) > 1L) {
      abort_file(
        paste("None of its headings says an angle or a rate:", quote_all(table$headings)), file,
        call, paste("A heading has its unit: {.val theta (deg)}, {.val gyro_z_rad_s}.", renaming)
      )
    }
    columns$x_m <- take(x, "x_m")
    if (length(y)) columns$y_m <- take(y, "y_m")
  }
  turns <- intersect(c("theta_rad", "omega_rad_per_s"), names(columns))
  beside <- which(heads$kind %in% "length" & heads$component %in% c("x", "y"))
  if (length(turns) && length(beside)) {
    notes <- c(notes, paste("not used beside the rotation:", quote_all(table$headings[beside])))
  }
  list(columns = columns, notes = notes)
}

# The headings that the user gives in place of those of the file.
name_columns <- function(table, headings, call) {
  if (is.null(headings)) return(table)
  if (!is.character(headings) || length(headings) != length(table$columns) || anyNA(headings)) {
    abort_rotdyn(c(
      "{.arg headings} must be text, one for each of the {length(table$columns)} columns.",
      x = "It is {describe_value(headings)}."
    ), "size", call)
  }
  headings[table$clock] <- paste0(headings[table$clock], clock_mark)
  table$headings <- headings
  table
}
