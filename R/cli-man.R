# The command line's manual pages, in roff, from the table of verbs.

# The page of a verb, or the overview.
cli_manual <- function(verbs, verb = NULL) {
  version <- utils::packageDescription("rotdyn", fields = "Version")
  name <- paste(c("rotdyn", verb$name), collapse = "-")
  head <- function(name, what) {
    c(
      paste0(".TH ", toupper(roff(name)), " 1 \"\" \"rotdyn ", version, "\" \"User Commands\""),
      ".SH NAME", paste(roff(name), "\\-", roff(what))
    )
  }
  status <- c(
    ".SH EXIT STATUS",
    unlist(Map(function(code, words) c(".TP", paste0(".B ", code), roff(words)), cli_status,
               cli_status_words[names(cli_status)]), use.names = FALSE)
  )
  if (is.null(verb)) {
    return(c(
      head("rotdyn", "rotational dynamics with an audit"),
      ".SH SYNOPSIS", ".B rotdyn", ".I VERB", roff("[FILE|-]... [--name value]..."),
      ".SH DESCRIPTION",
      roff("Data goes to standard output, words to standard error. `-` is standard input."),
      ".SH VERBS",
      unlist(lapply(unname(verbs), function(v) {
        c(".TP", paste0(".B ", roff(trimws(paste(v$name, v$usage)))), roff(v$help[1]))
      })),
      status,
      ".SH SEE ALSO",
      paste0(".BR rotdyn\\-", roff(names(verbs)), " (1)", c(rep(",", length(verbs) - 1L), ""))
    ))
  }
  text <- cli_option_texts(cli_options_of(verb))
  c(
    head(name, verb$help[1]),
    ".SH SYNOPSIS", paste(".B rotdyn", verb$name),
    roff(trimws(paste(verb$usage, "[--name value]..."))),
    if (length(verb$help) > 1L) c(".SH DESCRIPTION", roff(verb$help[-1L])),
    ".SH OPTIONS",
    unlist(Map(function(name, help) c(".TP", paste0(".B ", roff(name)), roff(help)), text$name,
               text$help), use.names = FALSE),
    if (length(verb$example)) c(".SH EXAMPLES", ".nf", roff(verb$example), ".fi"),
    status,
    ".SH SEE ALSO", ".BR rotdyn (1)"
  )
}

# Text as roff shows it unchanged: a backslash, a hyphen that can be copied, a dot or a quote at the
# start of a line.
roff <- function(text) {
  text <- gsub("\\", "\\e", text, fixed = TRUE)
  text <- gsub("-", "\\-", text, fixed = TRUE)
  sub("^([.'])", "\\\\&\\1", text)
}
