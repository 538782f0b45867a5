# The command line in shells: completion of verbs, options and their values, made from the table of
# verbs for bash, zsh and fish.

cli_shells <- c("bash", "zsh", "fish")

# What an option takes, for completion: "flag", "files", a list of values, or "" (a number, a text).
cli_takes <- function(option) {
  if (option$type == "flag") return("flag")
  if (option$type == "file") return("files")
  as.character(option$choices %||% (if (!is.null(option$values)) option$values()) %||% "")
}

# What every option takes, by patterns of bash: `*:--name`, or `verb:--name` where verbs differ.
cli_option_patterns <- function(verbs) {
  each <- lapply(verbs, function(verb) {
    options <- cli_options_of(verb)
    stats::setNames(lapply(options, cli_takes), vapply(options, `[[`, "", "name"))
  })
  takes <- unlist(unname(each), FALSE)
  verb <- rep(names(verbs), lengths(each))
  one <- vapply(names(takes), function(name) {
    length(unique(takes[names(takes) == name])) == 1L
  }, NA)
  names(takes) <- paste0(ifelse(one, "*", verb), ":--", names(takes))
  takes[!duplicated(names(takes))]
}

cli_options_of <- function(verb) c(unname(verb$options), cli_common())

cli_first_words <- function(verb, verbs) {
  if (is.function(verb$values)) verb$values(verbs) else character()
}

cli_completion <- function(verbs, shell) {
  switch(shell,
    bash = cli_completion_bash(verbs),
    zsh = cli_completion_zsh(verbs),
    fish = cli_completion_fish(verbs)
  )
}

# ---- bash ---------------------------------------------------------------------------------------

# bash has `--name=value` as three words. Without words readline completes files (-o default).
cli_completion_bash <- function(verbs) {
  takes <- cli_option_patterns(verbs)
  kind <- vapply(takes, function(x) if (length(x) == 1L) x else "values", "")
  pattern <- function(of) paste(names(takes)[kind == of], collapse = "|")
  values <- paste0(
    "    ", names(takes), ") words=\"", vapply(takes, paste, "", collapse = " "), "\" ;;"
  )
  each <- vapply(verbs, function(verb) {
    options <- vapply(cli_options_of(verb), `[[`, "", "name")
    paste0("    ", verb$name, ") options=\"", paste0("--", options, collapse = " "), "\" ;;")
  }, "")
  first <- lapply(verbs, cli_first_words, verbs)
  first <- first[lengths(first) > 0L]
  c(
    "# Completion of rotdyn for bash: source <(rotdyn completion bash)",
    "_rotdyn() {",
    "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words options",
    "  COMPREPLY=()",
    "  if test \"$word\" = \"=\"; then word=",
    "  elif test \"$before\" = \"=\"; then before=${COMP_WORDS[COMP_CWORD-2]}; fi",
    "  case ${COMP_WORDS[1]} in",
    unname(each),
    "    *) options= ;;",
    "  esac",
    "  case ${COMP_WORDS[1]}:$before in",
    values[kind == "values"],
    paste0("    ", pattern("files"), ") return ;;"),
    paste0("    ", pattern(""), ") compopt +o default 2> /dev/null; return ;;"),
    "    *)",
    "      case $COMP_CWORD:${COMP_WORDS[1]} in",
    paste0("        1:*) words=\"", paste(names(verbs), collapse = " "), "\" ;;"),
    paste0("        2:", names(first), ") words=\"", vapply(first, paste, "", collapse = " "),
           "\" ;;"),
    "        *) words= ;;",
    "      esac",
    "      case $word in -*) words=$options ;; esac ;;",
    "  esac",
    "  test -z \"$words\" || COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))",
    "}",
    "complete -o default -F _rotdyn rotdyn"
  )
}

# ---- zsh ----------------------------------------------------------------------------------------

cli_completion_zsh <- function(verbs) {
  quote <- function(text) paste0("'", gsub("'", "'\\''", text, fixed = TRUE), "'")
  # In a specification of _arguments a colon ends a field, brackets the help.
  field <- function(text) gsub("([\\[\\]:\\\\])", "\\\\\\1", text, perl = TRUE)
  one <- function(option) {
    takes <- cli_takes(option)
    what <- paste0("--", option$name, if (!identical(takes, "flag")) "=", "[", field(option$help),
                   "]")
    action <- if (identical(takes, "flag")) "" else if (identical(takes, "files")) {
      paste0(":", option$name, ":_files")
    } else {
      paste0(":", option$name, ":", if (any(nzchar(takes))) {
        paste0("(", paste(takes, collapse = " "), ")")
      } else " ")
    }
    quote(paste0(what, action))
  }
  each <- lapply(verbs, function(verb) {
    first <- cli_first_words(verb, verbs)
    c(
      paste0("    ", verb$name, ") _arguments \\"),
      paste0("      ", vapply(cli_options_of(verb), one, ""), " \\"),
      if (length(first)) {
        words <- quote(paste0("word:word:(", paste(first, collapse = " "), ")"))
        action <- paste0("1:word:{_alternative ", words, " 'file:file:_files'}")
        paste0("      ", quote(action), " \\")
      },
      paste0("      ", quote("*:file:_files"), " ;;")
    )
  })
  c(
    "#compdef rotdyn",
    "# Completion of rotdyn for zsh: source <(rotdyn completion zsh)",
    "_rotdyn() {",
    "  local -a verbs",
    "  verbs=(",
    paste0("    ", vapply(verbs, function(verb) {
      quote(paste0(verb$name, ":", gsub(":", "\\:", verb$help[1], fixed = TRUE)))
    }, "")),
    "  )",
    "  if (( CURRENT == 2 )); then",
    "    _describe verb verbs",
    "    return",
    "  fi",
    "  shift words",
    "  (( CURRENT-- ))",
    "  case $words[1] in",
    unlist(each, use.names = FALSE),
    "  esac",
    "}",
    "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then",
    "  _rotdyn \"$@\"",
    "else",
    "  compdef _rotdyn rotdyn",
    "fi"
  )
}

# ---- fish ---------------------------------------------------------------------------------------

cli_completion_fish <- function(verbs) {
  quote <- function(text) {
    paste0("'", gsub("'", "\\'", gsub("\\", "\\\\", text, fixed = TRUE), fixed = TRUE), "'")
  }
  each <- lapply(verbs, function(verb) {
    when <- paste0("complete -c rotdyn -n '__fish_seen_subcommand_from ", verb$name, "' ")
    first <- cli_first_words(verb, verbs)
    c(
      paste0("complete -c rotdyn -n __fish_use_subcommand -f -a ", verb$name, " -d ",
             quote(verb$help[1])),
      if (length(first)) paste0(when, "-a ", quote(paste(first, collapse = " "))),
      vapply(cli_options_of(verb), function(option) {
        takes <- cli_takes(option)
        paste0(
          when, "-l ", option$name,
          if (identical(takes, "files")) " -r -F" else if (!identical(takes, "flag")) " -x",
          if (length(takes) > 1L) paste0(" -a ", quote(paste(takes, collapse = " "))),
          " -d ", quote(option$help)
        )
      }, "")
    )
  })
  c(
    "# Completion of rotdyn for fish: rotdyn completion fish | source",
    unlist(each, use.names = FALSE)
  )
}
