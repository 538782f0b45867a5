# What a verb of the command line returns, as text: list(table =, text =, lines =, answer =).
#   table    a data frame: csv, json, jsonl; as text unless `text` is there
#   text     lines for people
#   lines    lines in every format (help, versions)
#   answer   FALSE: done, and the answer is no

cli_formats <- c("csv", "json", "jsonl", "text")

cli_render <- function(result, format) {
  if (!is.null(result$lines)) return(result$lines)
  table <- cli_plain_table(result$table)
  switch(format,
    csv = cli_csv(table),
    json = cli_json(table),
    jsonl = cli_json_rows(table),
    text = result$text %||% cli_text(table)
  )
}

# Columns of numbers, texts and logicals: what a list column holds does not fit in a cell.
cli_plain_table <- function(table) {
  columns <- as.list(table)
  columns <- columns[!vapply(columns, function(x) is.list(x) && !is.object(x), NA)]
  lapply(columns, function(x) {
    if (is.factor(x) || (is.object(x) && !is.numeric(x))) return(as.character(x))
    if (is.matrix(x)) return(x[, 1])
    if (is.object(x)) as.double(x) else x
  })
}

# Every digit, NA as `missing`; strings in quotes where `quote`.
cli_cells <- function(x, missing, quote) {
  text <- if (is.character(x)) {
    quote(x)
  } else if (is.logical(x)) {
    c("false", "true")[x + 1L]
  } else {
    .Call(ffi_text_numbers, as.double(x))
  }
  text[is.na(x) & !is.nan(x)] <- missing
  text
}

cli_csv <- function(table) {
  quote <- function(x) {
    special <- grepl("[\",\n\r]", x) | x == ""
    ifelse(special, paste0("\"", gsub("\"", "\"\"", x, fixed = TRUE), "\""), x)
  }
  columns <- lapply(table, cli_cells, "", quote)
  c(
    paste(quote(names(table)), collapse = ","),
    if (length(table) && length(table[[1]])) do.call(paste, c(unname(columns), sep = ","))
  )
}

# An object for each row; what is no number of JSON is a string.
cli_json_rows <- function(table) {
  if (!length(table) || !length(table[[1]])) return(character())
  columns <- Map(function(x, name) {
    cells <- cli_cells(x, "null", json_string)
    if (is.double(x)) {
      odd <- is.infinite(x) | is.nan(x)
      cells[odd] <- paste0("\"", cells[odd], "\"")
    }
    paste0(json_string(name), ":", cells)
  }, table, names(table))
  paste0("{", do.call(paste, c(unname(columns), sep = ",")), "}")
}

cli_json <- function(table) {
  rows <- cli_json_rows(table)
  if (!length(rows)) return("[]")
  comma <- c(rep(",", length(rows) - 1L), "")
  c("[", paste0(rows, comma), "]")
}

# For people: seven digits, aligned.
cli_text <- function(table) {
  if (!length(table)) return(character())
  columns <- Map(function(x, name) {
    cells <- if (is.double(x)) {
      trimws(format(x, digits = 7))
    } else {
      cli_cells(x, "NA", identity)
    }
    cells <- gsub("[\n\r]", " ", cells)
    width <- max(nchar(c(name, cells), "width"))
    formatC(c(name, cells), width = if (is.numeric(x)) width else -width, flag = "")
  }, table, names(table))
  trimws(do.call(paste, c(unname(columns), sep = "  ")), "right")
}

# A print method's lines.
cli_printed <- function(x) {
  lines <- utils::capture.output(print(x))
  cli::ansi_strip(lines)
}
