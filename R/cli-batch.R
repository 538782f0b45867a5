# The command line: many command lines in one process.

cli_batch_verbs <- function() {
  list(cli_verb(
    "batch", "FILE|-", c(1, 1),
    c("runs a command line in each line of a file, in one process",
      "Words are separated by blanks, quoted as in a shell; # begins a comment.",
      "The output of a line is that of the command. A line that fails is named, the others run;",
      "the exit status is that of the first that did not end with 0."),
    list(cli_option("mark", "text", "written behind the output of each line, with its status")),
    cli_run_batch, NULL,
    c("rotdyn batch work.txt", "printf 'roll --beta 0.4\\nshapes\\n' | rotdyn batch - --json")
  ))
}

cli_run_batch <- function(words, options, state) {
  kept <- character()
  out <- if (is.null(options$out)) state$out else function(lines) kept <<- c(kept, lines)
  more <- c(
    if (!is.null(options$format)) c("--format", options$format),
    if (isTRUE(options$quiet)) "--quiet"
  )
  one <- function(line, at) {
    arguments <- if (!is.na(line)) cli_split(line)
    if (is.null(arguments)) {
      status <- cli_status[[if (is.na(line)) "input" else "usage"]]
      fault <- if (is.na(line)) "it has a zero byte: it is no text" else "a quote is not closed"
      state$err(paste0("rotdyn: ", at, ": ", fault))
    } else {
      if (identical(arguments[1], "rotdyn")) arguments <- arguments[-1L]
      if (!length(arguments)) return(invisible())
      # An option of the line comes before that of the batch.
      own <- sub("=.*", "", arguments)
      if (any(c("--format", "--json") %in% own)) {
        more <- setdiff(more, c("--format", options$format))
      }
      if ("--quiet" %in% own) more <- setdiff(more, "--quiet")
      nested <- identical(arguments[1], "batch")
      if (nested) state$err(paste0("rotdyn: ", at, ": a batch contains no batch"))
      status <- if (nested) cli_status[["usage"]] else {
        cli_run(c(arguments, more), out, function(text) {
          state$err(sub("^rotdyn: ", paste0("rotdyn: ", at, ": "), text))
        }, state$input, FALSE, state$verbs, state$read)
      }
    }
    if (!is.null(options$mark)) out(paste(options$mark, status))
    if (state$status == cli_status[["done"]]) state$status <- status
    status
  }
  cli_each_line(words, state, function(line, number) {
    state$file <- NULL
    status <- one(line, paste0(if (words == "-") "line " else paste0(words, ":"), number))
    !isTRUE(status %in% cli_status[c("interrupted", "reader_left")])
  })
  list(lines = kept)
}

# Calls of(line, number) for each line as it comes, until that is FALSE. A program may write a line
# to standard input, read the answer, and write the next.
cli_each_line <- function(path, state, of) {
  if (path == "-") {
    state$read <- TRUE
    connection <- file(state$input, raw = identical(state$input, "stdin"))
    on.exit(close(connection))
    open(connection, "r")
    number <- 0L
    while (length(line <- connection_lines(connection, 1L))) {
      number <- number + 1L
      if (!of(line, number)) break
    }
  } else {
    lines <- cli_read_text(path, state)
    for (number in seq_along(lines)) if (!of(lines[number], number)) break
  }
}

# The words of a line; NULL where a quote is not closed.
cli_split <- function(line) {
  characters <- strsplit(line, "")[[1]]
  words <- character()
  word <- NULL
  quote <- ""
  i <- 0L
  while (i < length(characters)) {
    i <- i + 1L
    one <- characters[i]
    if (nzchar(quote)) {
      if (one == quote) quote <- ""
      else if (one == "\\" && quote == "\"" && i < length(characters) &&
                 characters[i + 1L] %in% c("\"", "\\")) {
        i <- i + 1L
        word <- paste0(word, characters[i])
      } else word <- paste0(word, one)
    } else if (one %in% c("'", "\"")) {
      quote <- one
      word <- paste0(word, "")
    } else if (one == "\\" && i < length(characters)) {
      i <- i + 1L
      word <- paste0(word, characters[i])
    } else if (one %in% c(" ", "\t", "\r")) {
      words <- c(words, word)
      word <- NULL
    } else if (one == "#" && is.null(word)) {
      break
    } else {
      word <- paste0(word, one)
    }
  }
  if (nzchar(quote)) return(NULL)
  c(words, word)
}
