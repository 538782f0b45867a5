#' @rdname read_motion
#' @export
read_phyphox <- function(file, ..., axis = NULL, sheet = NULL) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  phyphox_record(file, read_bytes(file, call), call, axis, sheet)
}

phyphox_record <- function(file, bytes, call, axis = NULL, sheet = NULL) {
  if (is_zip(bytes) || is_ole(bytes)) {
    tables <- if (is_ole(bytes) || any(grepl("^xl/", zip_names(file, call)))) {
      phyphox_sheets(excel_sheets(file, call))
    } else {
      phyphox_zip(file, call)
    }
    table <- choose_table(tables$data, sheet, file, call)
    pauses <- phyphox_pauses(tables$time)
  } else {
    table <- read_delimited(decode_bytes(bytes, file, call), file, call)
    pauses <- NULL
  }
  time <- which(heading_table(table$headings)$kind %in% "time")[1]
  breaks <- NULL
  if (length(pauses) && !is.na(time)) {
    seconds <- table$columns[[time]]
    row <- vapply(pauses, function(p) which(seconds > p * (1 - 1e-9))[1], 0L)
    breaks <- data.frame(row = row, why = rep("a pause", length(row)))[!is.na(row), ]
  }
  notes <- if (is.null(pauses)) {
    "the file does not say whether the measurement was paused"
  }
  record_from_table(
    table, call, file, paste0(basename(file), " (phyphox)"), axis = axis, notes = notes,
    breaks = breaks
  )
}

# The table of the rotation among several, by name or by its units.
choose_table <- function(tables, sheet, file, call) {
  if (!is.null(sheet)) {
    check_name(sheet, "sheet", call)
    at <- match(sheet, names(tables))
    if (is.na(at)) {
      abort_rotdyn(c(
        "{.arg sheet} must be one of {.or {.val {names(tables)}}}.", x = "It is {.val {sheet}}."
      ), "value", call)
    }
    return(tables[[at]])
  }
  turns <- vapply(tables, function(table) {
    any(heading_table(table$headings)$kind %in% c("angle", "rate"))
  }, NA)
  if (sum(turns) != 1L) {
    abort_file(
      if (any(turns)) {
        paste0("It has several tables of rotations: ", toString(names(tables)[turns]), ".")
      } else {
        paste0("None of its tables (", toString(names(tables)), ") has an angle or a rate.")
      }, file, call, if (any(turns)) "Name one with {.arg sheet}."
    )
  }
  tables[[which(turns)]]
}

phyphox_zip <- function(file, call) {
  names <- zip_names(file, call)
  csv <- names[grepl("[.](csv|txt)$", lower_case(names)) & !grepl("(^|/)meta/", names)]
  if (!length(csv)) abort_file("The archive has no table.", file, call)
  read <- function(name) {
    read_delimited(decode_bytes(zip_bytes(file, name, call), file, call), file, call)
  }
  data <- stats::setNames(
    lapply(csv, function(name) {
      tryCatch(read(name), rotdyn_error_file = function(e) {
        list(headings = character(), failed = e)
      })
    }), sub("[.][a-zA-Z]+$", "", basename(csv))
  )
  failed <- vapply(data, function(table) !is.null(table$failed), NA)
  if (all(failed)) stop(data[[1]]$failed)
  time <- names[grepl("(^|/)meta/time[.]csv$", names)]
  list(
    data = data[!failed],
    time = if (length(time)) {
      split_lines(decode_bytes(zip_bytes(file, time[1], call), file, call))
    }
  )
}

# Times of the events PAUSE that are followed by a START.
phyphox_pauses <- function(lines) {
  if (is.null(lines)) return(NULL)
  event <- toupper(gsub("^\\s*\"?([A-Za-z]*).*$", "\\1", lines))
  rest <- sub("^\\s*\"?[A-Za-z]+\"?[,;\t]\\s*\"?", "", lines)
  number <- regmatches(rest, regexpr("^[-+]?[0-9]+([.,][0-9]+)?([eE][-+]?[0-9]+)?", rest))
  has <- grepl("^[-+]?[0-9]", rest)
  time <- rep(NA_real_, length(lines))
  time[has] <- as.numeric(sub(",", ".", number, fixed = TRUE))
  events <- data.frame(event, time)[event %in% c("START", "PAUSE") & !is.na(time), ]
  again <- which(events$event == "PAUSE" & c(events$event[-1], "") == "START")
  events$time[again]
}

# Sheets of an Excel file, as data frames of text by their names; NULL for one that cannot be read.
excel_sheets <- function(file, call) {
  need_package("readxl", "Reading an Excel file", call)
  broken <- function(e) NULL
  names <- tryCatch(suppressWarnings(readxl::excel_sheets(file)), error = broken)
  if (!length(names)) abort_file("It is a damaged Excel file.", file, call)
  lapply(stats::setNames(nm = names), function(name) {
    tryCatch(
      suppressMessages(suppressWarnings(
        readxl::read_excel(file, name, col_types = "text", .name_repair = "minimal")
      )), error = broken
    )
  })
}

# The sheets of an Excel export: those with data as tables of numbers, that of the times as lines.
phyphox_sheets <- function(sheets) {
  names <- lower_case(names(sheets))
  data <- lapply(sheets[!startsWith(names, "metadata")], function(cells) {
    if (!NCOL(cells) || !NROW(cells)) return(list(headings = character()))
    columns <- lapply(cells, function(x) cell_numbers(trimws(ifelse(is.na(x), "", x)), "."))
    list(
      headings = names(cells), columns = unname(columns),
      odd = unname(mapply(function(x, y) sum(is.na(x) & !is.na(y) & !y %in% missing_cells),
        columns, cells)),
      dropped = NULL
    )
  })
  time <- sheets[names == "metadata time"]
  list(
    data = Filter(function(table) length(table$headings) > 0L, data),
    time = if (length(time) && NCOL(time[[1]]) > 1L) {
      paste(time[[1]][[1]], time[[1]][[2]], sep = ",")
    }
  )
}
