#' @rdname read_motion
#' @export
read_vernier <- function(file, ..., run = NULL) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  vernier_record(file, read_bytes(file, call), call, run)
}

vernier_record <- function(file, bytes, call, run = NULL) {
  force(bytes) # the checks of the file come first
  source <- paste0(basename(file), " (Vernier)")
  if (is_tar(bytes)) {
    parts <- tar_files(bytes, file, call)
    at <- grep("[.]udm$", names(parts))
    if (!length(at)) abort_file("The archive has no data.udm.", file, call)
    bytes <- parts[[at[1]]]
  }
  text <- decode_bytes(bytes, file, call)
  if (grepl("^\\s*<", text)) {
    return(runs_record(vernier_sets(text, file, call), run, source, file, call))
  }
  runs_record(side_by_side(read_delimited(text, file, call), file, call), run, source, file, call)
}

# The data sets of a project: a table for each, named.
vernier_sets <- function(text, file, call) {
  document <- read_xml_bytes(charToRaw(enc2utf8(text)), file, call)
  sets <- xml2::xml_find_all(document, ".//DataSet")
  tables <- lapply(sets, function(set) {
    columns <- xml2::xml_find_all(set, ".//DataColumn")
    get <- function(name) {
      trimws(vapply(columns, function(x) {
        xml2::xml_text(xml2::xml_find_first(x, paste0("./", name)))
      }, ""))
    }
    unit <- get("ColumnUnits")
    name <- get("DataObjectName")
    cells <- lapply(columns, function(x) {
      text <- xml2::xml_text(xml2::xml_find_first(x, "./ColumnCells"))
      # A blank line between others is a cell without a value.
      text <- sub("^[ \t]*\n", "", gsub("\r\n?", "\n", text))
      if (is.na(text) || !nzchar(trimws(text))) return(character())
      trimws(strsplit(sub("\\s+$", "", text), "\n", fixed = TRUE)[[1]])
    })
    has <- lengths(cells) > 0L & !is.na(name)
    if (!any(has)) return(NULL)
    n <- max(lengths(cells[has]))
    cells <- lapply(cells[has], function(x) c(x, rep("", n - length(x))))
    numbers <- lapply(cells, cell_numbers, ".")
    list(
      headings = ifelse(is.na(unit[has]) | !nzchar(unit[has]), name[has],
        paste0(name[has], " (", unit[has], ")")),
      columns = numbers,
      odd = mapply(function(x, y) sum(is.na(y) & !x %in% missing_cells), cells, numbers),
      dropped = NULL
    )
  })
  label <- vapply(sets, function(set) {
    xml2::xml_text(xml2::xml_find_first(set, "./DataSetName"))
  }, "")
  label[is.na(label)] <- paste("Data Set", which(is.na(label)))
  names(tables) <- label
  Filter(function(table) !is.null(table), tables)
}

# ---- runs side by side, shared with PASCO -------------------------------------------------------

# A table whose headings name the run, before ("Run 1: Time (s)") or after ("Time (s) Run #1"), as a
# table for each run. A column without a run belongs to all.
side_by_side <- function(table, file, call) {
  if (!length(table$headings)) abort_file("It has no headings.", file, call)
  before <- "^\\s*([^:(]+?)\\s*:\\s*(.*)$"
  after <- "^(.*?)[, ]*\\b(Run\\s*#?\\s*[0-9]+)\\s*$"
  heads <- table$headings
  label <- rep("", length(heads))
  bare <- heads
  at <- grepl(after, heads, perl = TRUE)
  label[at] <- sub(after, "\\2", heads[at], perl = TRUE)
  bare[at] <- sub(after, "\\1", heads[at], perl = TRUE)
  at <- !at & grepl(before, heads, perl = TRUE)
  label[at] <- sub(before, "\\1", heads[at], perl = TRUE)
  bare[at] <- sub(before, "\\2", heads[at], perl = TRUE)
  runs <- unique(label[nzchar(label)])
  if (!length(runs)) {
    runs <- "all"
    label[] <- "all"
  }
  tables <- lapply(runs, function(run) {
    own <- which(label == run)
    shared <- which(!nzchar(label) & !bare %in% bare[own])
    take <- c(shared, own)
    list(
      headings = bare[take], columns = table$columns[take], odd = table$odd[take],
      dropped = table$dropped
    )
  })
  stats::setNames(tables, runs)
}

# One record of the runs chosen, each a segment.
runs_record <- function(tables, run, source, file, call) {
  turns <- vapply(tables, function(table) {
    kind <- heading_table(table$headings)$kind
    any(kind %in% "time") && any(kind %in% c("angle", "rate")) || all(c("x", "y") %in%
      heading_table(table$headings)$component[kind %in% "length"])
  }, NA)
  if (!any(turns)) {
    headings <- unique(unlist(lapply(tables, `[[`, "headings")))
    abort_file(
      paste("None of its runs has a time and an angle or a rate:", quote_all(headings)), file, call
    )
  }
  tables <- tables[turns]
  if (!is.null(run)) {
    at <- if (is_number(run)) {
      match(run, seq_along(tables))
    } else if (is.character(run)) {
      match(run, names(tables))
    }
    if (anyNA(at) || !length(at)) {
      abort_rotdyn(c(
        "{.arg run} must be among {.val {names(tables)}}, or their numbers.",
        x = "It is {describe_value(run)}."
      ), "value", call)
    }
    tables <- tables[at]
  }
  picked <- lapply(tables, function(table) {
    table_columns(table, heading_table(table$headings), file, call)
  })
  kinds <- lapply(picked, function(p) names(p$columns))
  same <- vapply(kinds, identical, NA, kinds[[1]])
  if (!all(same)) {
    abort_rotdyn(c(
      "The runs of {.file {file}} have different quantities.",
      i = "Choose some with {.arg run}: {.val {names(tables)}}."
    ), "missing", call)
  }
  if (is.matrix(picked[[1]]$columns$omega_rad_per_s$value)) {
    abort_file("It has rates about several axes.", file, call, "Read it with {.fn read_imu}.")
  }
  # Rows beyond the end of a shorter run have no cells at all.
  filled <- lapply(picked, function(p) {
    which(!Reduce(`&`, lapply(p$columns, function(x) is.na(x$value))))
  })
  columns <- lapply(stats::setNames(kinds[[1]], kinds[[1]]), function(name) {
    first <- picked[[1]]$columns[[name]]
    first$value <- unlist(Map(function(p, rows) p$columns[[name]]$value[rows], picked, filled),
      use.names = FALSE)
    first
  })
  bad <- unlist(Map(function(table, p) {
    table$odd[vapply(p$columns, `[[`, 0L, "at")]
  }, tables, picked))
  n <- length(columns$time_s$value)
  if (sum(bad) > n / 10) abort_file("It has cells that are no number.", file, call)
  notes <- unique(unlist(lapply(picked, `[[`, "notes")))
  if (sum(bad)) notes <- c(notes, missing_note(sum(bad)))
  if (length(tables) > 1L) {
    columns$segment <- list(
      value = rep(names(tables), lengths(filled)), heading = "run", arg = "segment"
    )
    notes <- c(notes, paste0("segments are the runs ", paste(names(tables), collapse = ", ")))
  }
  record <- build_record(columns, n, call, source = source, notes = notes, marks = "keep")
  cells <- tables[[1]]$dropped
  if (NROW(cells)) {
    info <- record_info(record)
    info$dropped <- rbind(cells, info$dropped)
    attr(record, "record") <- info
  }
  record
}
