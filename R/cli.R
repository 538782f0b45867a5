# The command line: words, options, exit statuses. exec/rotdyn calls cli_main(). The verbs are a
# table in cli-verbs.R; what they return is written by cli-output.R.

cli_status <- c(done = 0L, no = 1L, usage = 2L, input = 3L, accuracy = 4L, fault = 70L,
                interrupted = 130L, reader_left = 141L)

cli_status_words <- c(
  done = "done", no = "done, and the answer is no", usage = "wrong usage",
  input = "unreadable or impossible input, or output that cannot be written",
  accuracy = "no model reaches the accuracy", fault = "a fault of rotdyn",
  interrupted = "interrupted", reader_left = "the reader of the output left"
)

cli_main <- function() quit("no", cli_run(commandArgs(TRUE)), FALSE)

# One command line. Data goes to `out`, words to `err`, both functions of lines; returns the status.
# Only interrupts and a reader that left pass through as conditions, and are caught here too.
cli_run <- function(arguments, out = cli_to_stdout, err = cli_to_stderr, input = "stdin",
                    terminal = isatty(stdout()), verbs = cli_verbs(), read = FALSE) {
  old <- options(
    cli.unicode = FALSE, cli.num_colors = 1L, cli.progress_show_after = Inf, width = 100L,
    OutDec = ".", scipen = 0L, digits = 7L
  )
  on.exit(options(old))
  state <- new.env(parent = emptyenv())
  state$status <- cli_status[["done"]]
  state$out <- out
  state$err <- err
  state$read <- read # whether standard input is taken
  state$json <- any(arguments %in% c("--json", "--format=json", "--format=jsonl")) ||
    any(arguments[-1L] %in% c("json", "jsonl") &
          arguments[-length(arguments)] == "--format")
  state$quiet <- "--quiet" %in% arguments
  said <- function(text) if (!state$quiet) err(text)
  tryCatch(
    withCallingHandlers(
      cli_dispatch(arguments, out, state, input, terminal, verbs),
      warning = function(w) {
        if (inherits(w, "rotdyn_warning_accuracy")) state$status <- cli_status[["accuracy"]]
        said(cli_words(w, "warning: "))
        invokeRestart("muffleWarning")
      },
      message = function(m) {
        said(cli_words(m))
        invokeRestart("muffleMessage")
      }
    ),
    interrupt = function(e) {
      state$status <- cli_status[["interrupted"]]
      err("rotdyn: interrupted")
    },
    error = function(e) {
      state$status <- cli_status_of(e)
      if (state$status != cli_status[["reader_left"]]) err(cli_fault(e, state))
    }
  )
  state$status
}

# R itself does not notice that standard output is full or closed. The launcher says by the variable
# that it was closed: another file would have its descriptor.
cli_to_stdout <- function(lines) {
  fault <- if (nzchar(Sys.getenv("ROTDYN_NO_STDOUT"))) "It is closed." else {
    .Call(ffi_file_write, 1L, enc2native(lines))
  }
  if (nzchar(fault)) abort_unwritten("standard output", fault)
}

cli_to_stderr <- function(lines) writeLines(lines, stderr())

# Usage errors: what is wrong, and the verb whose help says more.
abort_usage <- function(..., verb = NULL) {
  stop(structure(
    class = c("rotdyn_error_usage", "rotdyn_error", "error", "condition"),
    list(message = paste0(...), call = NULL, verb = verb)
  ))
}

abort_input <- function(...) {
  stop(structure(
    class = c("rotdyn_error_input", "rotdyn_error", "error", "condition"),
    list(message = paste0(...), call = NULL)
  ))
}

cli_status_of <- function(e) {
  kind <- sub("rotdyn_error_", "", class(e)[1], fixed = TRUE)
  if (reader_left(e)) return(cli_status[["reader_left"]])
  if (!inherits(e, "rotdyn_error")) return(cli_status[["fault"]])
  if (kind == "usage") return(cli_status[["usage"]])
  if (kind %in% c("accuracy", "model", "budget", "step", "range", "rhs", "torque", "random")) {
    return(cli_status[["accuracy"]])
  }
  cli_status[["input"]]
}

# A condition in plain lines, with those of its causes.
cli_words <- function(e, before = "") {
  text <- if (inherits(e, "rlang_error")) {
    rlang::cnd_message(e, inherit = TRUE, prefix = FALSE)
  } else {
    conditionMessage(e)
  }
  lines <- strsplit(cli::ansi_strip(text), "\n", fixed = TRUE)[[1]]
  lines[1] <- paste0(before, lines[1])
  c(paste0("rotdyn: ", lines[1]), paste0("  ", lines[-1L])[seq_along(lines[-1L])])
}

cli_fault <- function(e, state) {
  fault <- state$status == cli_status[["fault"]]
  if (state$json) {
    kind <- if (fault) "fault" else sub("rotdyn_error_", "", class(e)[1], fixed = TRUE)
    said <- sub("^rotdyn: ", "", trimws(cli_words(e)))
    return(json_text(c(
      list(error = kind, message = paste(said, collapse = " ")),
      if (!is.null(state$file)) list(file = state$file), list(status = state$status)
    )))
  }
  usage <- inherits(e, "rotdyn_error_usage")
  before <- if (fault) "internal fault: " else if (!usage && !is.null(state$file)) {
    paste0(state$file, ": ")
  }
  c(
    cli_words(e, before),
    if (usage) paste0("  Help: rotdyn help", if (!is.null(e$verb)) paste0(" ", e$verb))
  )
}

# ---- words and options --------------------------------------------------------------------------

# An option: type "flag", "text", "texts", "file", "number", "numbers", "times"; `choices`: the only
# values of a text; `values()`: those that completion offers.
cli_option <- function(name, type, help, default = NULL, choices = NULL, aka = NULL,
                       values = NULL) {
  list(name = name, type = type, help = help, default = default, choices = choices, aka = aka,
       values = values)
}

cli_common <- function() {
  list(
    cli_option("format", "text", "text on a terminal, else csv", NULL, cli_formats),
    cli_option("json", "flag", "the same as --format json"),
    cli_option("out", "file", "a file for the data, in place of standard output"),
    cli_option("quiet", "flag", "no warnings and no messages"),
    cli_option("help", "flag", "this text")
  )
}

# list(words, options by name): `--name value`, `--name=value`; `-` is a word, `--` ends options.
cli_parse <- function(arguments, verb) {
  known <- c(verb$options, cli_common())
  names(known) <- vapply(known, `[[`, "", "name")
  aka <- unlist(lapply(unname(known), function(o) {
    stats::setNames(rep(o$name, length(o$aka)), o$aka)
  }))
  words <- character()
  given <- list()
  i <- 1L
  while (i <= length(arguments)) {
    one <- arguments[i]
    i <- i + 1L
    if (one == "--") {
      words <- c(words, arguments[seq_along(arguments) >= i])
      break
    }
    if (one == "-h") one <- "--help"
    if (!grepl("^-.", one) || grepl("^-[0-9.]", one)) {
      words <- c(words, one)
      next
    }
    name <- sub("^--?([^=]*).*", "\\1", one)
    if (name %in% names(aka)) name <- aka[[name]]
    option <- if (startsWith(one, "--")) known[[name]]
    if (is.null(option)) {
      near <- near_names(name, names(known))
      abort_usage(
        "unknown option `", sub("=.*", "", one), "` of `", verb$name, "`",
        if (length(near)) paste0("; did you mean `--", near[1], "`?"), verb = verb$name
      )
    }
    if (name %in% names(given)) {
      abort_usage("`--", name, "` is given twice", verb = verb$name)
    }
    inline <- grepl("=", one, fixed = TRUE)
    if (option$type == "flag") {
      if (inline) abort_usage("`--", name, "` takes no value", verb = verb$name)
      given[[name]] <- TRUE
      next
    }
    if (inline) {
      value <- sub("^[^=]*=", "", one)
    } else if (i <= length(arguments)) {
      value <- arguments[i]
      i <- i + 1L
    } else {
      abort_usage("`--", name, "` needs a value", verb = verb$name)
    }
    given[[name]] <- cli_value(value, option, verb)
  }
  for (option in known) {
    if (is.null(given[[option$name]])) given[[option$name]] <- option$default
  }
  list(words = words, options = given)
}

cli_value <- function(text, option, verb) {
  wrong <- function(what) {
    abort_usage("`--", option$name, "` must be ", what, ", not `", text, "`", verb = verb$name)
  }
  if (!isTRUE(validUTF8(text))) {
    abort_usage("the value of `--", option$name, "` is not valid UTF-8", verb = verb$name)
  }
  one <- function(x) {
    if (grepl("^[-+]?[0-9]+,[0-9]+$", x)) return(NA_real_)
    suppressWarnings(as.numeric(x))
  }
  switch(option$type,
    file = ,
    text = {
      if (!nzchar(text)) wrong("a text")
      if (!is.null(option$choices) && !text %in% option$choices) {
        wrong(paste("one of", paste(option$choices, collapse = ", ")))
      }
      text
    },
    texts = {
      parts <- strsplit(text, ",", fixed = TRUE)[[1]]
      if (!length(parts) || !all(nzchar(parts))) wrong("names with commas between them")
      parts
    },
    number = {
      x <- one(text)
      if (!is_plain_number(text) || is.na(x)) wrong("a number with a point for decimals")
      x
    },
    numbers = {
      parts <- strsplit(text, ",", fixed = TRUE)[[1]]
      if (!length(parts) || !all(is_plain_number(parts))) {
        wrong("numbers with commas between them")
      }
      as.numeric(parts)
    },
    times = cli_times(text, wrong)
  )
}

is_plain_number <- function(text) {
  grepl("^[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?$|^[-+]?Inf$", text)
}

# FROM:TO:STEP, or single times, with commas between them.
cli_times <- function(text, wrong) {
  parts <- strsplit(text, ",", fixed = TRUE)[[1]]
  say <- "times such as 0:8:0.01 (from, to, step) or 0,1,2.5"
  if (!length(parts)) wrong(say)
  unlist(lapply(parts, function(part) {
    fields <- strsplit(part, ":", fixed = TRUE)[[1]]
    if (!length(fields) %in% c(1L, 3L) || !all(is_plain_number(fields))) wrong(say)
    x <- as.numeric(fields)
    if (length(x) == 1L) return(x)
    n <- floor((x[2] - x[1]) / x[3] * (1 + 1e-10))
    if (!is.finite(n) || n < 0) wrong(say)
    if (n >= 1e7) wrong("at most 1e7 times")
    x[1] + (0:n) * x[3]
  }))
}

# ---- dispatch -----------------------------------------------------------------------------------

cli_dispatch <- function(arguments, out, state, input, terminal, verbs) {
  names(verbs) <- vapply(verbs, `[[`, "", "name")
  arguments <- enc2native(as.character(arguments))
  if (!length(arguments)) abort_usage("there is no verb")
  if (arguments[1] %in% c("--help", "-h")) arguments[1] <- "help"
  if (arguments[1] == "--version") arguments[1] <- "version"
  verb <- verbs[[arguments[1]]]
  if (is.null(verb)) {
    near <- near_names(arguments[1], names(verbs))
    abort_usage(
      "unknown verb `", arguments[1], "`",
      if (length(near)) paste0("; did you mean `", near[1], "`?")
    )
  }
  parsed <- cli_parse(arguments[-1L], verb)
  options <- parsed$options
  if (isTRUE(options$help)) return(out(cli_help(verb)))
  if (length(parsed$words) < verb$words[1]) {
    abort_usage("`", verb$name, "` needs ", verb$usage, verb = verb$name)
  }
  if (length(parsed$words) > verb$words[2]) {
    abort_usage(
      "`", verb$name, "` takes no `", parsed$words[verb$words[2] + 1], "`", verb = verb$name
    )
  }
  if (!all(nzchar(parsed$words))) abort_usage("a word is empty", verb = verb$name)
  needed <- setdiff(verb$needs, names(options))
  if (length(needed)) abort_usage("`--", needed[1], "` is missing", verb = verb$name)
  state$input <- input
  state$verbs <- verbs
  if (isTRUE(options$json)) {
    if (!identical(options$format %||% "json", "json")) {
      abort_usage("`--json` and `--format ", options$format, "` exclude each other",
                  verb = verb$name)
    }
    options$format <- "json"
  }
  result <- verb$run(parsed$words, options, state)
  state$file <- NULL
  format <- options$format %||% (if (terminal && is.null(options$out)) "text" else "csv")
  lines <- cli_render(result, format)
  if (is.null(options$out)) {
    out(lines)
  } else {
    state$file <- options$out
    cli_write(lines, options$out)
  }
  if (isFALSE(result$answer) && state$status == cli_status[["done"]]) {
    state$status <- cli_status[["no"]]
  }
  invisible()
}

cli_write <- function(lines, path) {
  fault <- put_file(lines, path)
  if (nzchar(fault)) abort_unwritten("it", fault)
}

abort_unwritten <- function(what, fault) {
  fault <- paste0(tolower(substr(fault, 1L, 1L)), substring(fault, 2L))
  abort_input(what, " cannot be written: ", sub("[.]$", "", fault))
}

# ---- help ---------------------------------------------------------------------------------------

# Options as they are written, and what they say.
cli_option_texts <- function(options) {
  name <- vapply(options, function(o) {
    paste0("--", o$name, switch(o$type, flag = "", text = " TEXT", file = " FILE", texts = " A,B",
                                number = " X", numbers = " X,Y", times = " FROM:TO:STEP"))
  }, "")
  help <- vapply(options, function(o) {
    paste0(
      o$help, if (!is.null(o$choices)) paste0(": ", paste(o$choices, collapse = ", ")),
      if (!is.null(o$default)) {
        paste0(" (", paste(format(o$default, digits = 7), collapse = ","), ")")
      }
    )
  }, "")
  list(name = name, help = help)
}

cli_help <- function(verb) {
  text <- cli_option_texts(c(verb$options, cli_common()))
  c(
    trimws(paste("rotdyn", verb$name, verb$usage, "[--name value]..."), "right"), verb$help, "",
    "Options", paste0("  ", format(text$name), "  ", text$help),
    if (length(verb$example)) c("", "Examples", paste0("  ", verb$example))
  )
}

cli_overview <- function(verbs) {
  name <- vapply(verbs, function(v) trimws(paste(v$name, v$usage)), "")
  help <- vapply(verbs, function(v) v$help[1], "")
  codes <- paste0(cli_status, "  ", cli_status_words[names(cli_status)])
  c(
    "rotdyn VERB [FILE|-]... [--name value]...", "", "Verbs",
    paste0("  ", format(unname(name)), "  ", help), "",
    "Data goes to standard output, words to standard error. `-` is standard input.",
    "rotdyn help VERB says more.", "", "Exit status", paste0("  ", format(codes))
  )
}
