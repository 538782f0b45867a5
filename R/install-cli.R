#' The command line
#'
#' Writes a command, `rotdyn`, that runs this package from a shell, with this R and these libraries.
#' `rotdyn help` lists its verbs: motions of scenes, the choice of a model, audits, rolling,
#' inertia, records; `rotdyn batch` runs many lines in one process, `rotdyn man` writes manual
#' pages, `rotdyn completion` completes words in bash, zsh and fish. `vignette("records")` shows
#' them.
#'
#' Data goes to standard output, words to standard error. Neither the user's nor the site's profile
#' is read. Exit status: 0 done; 1 done, and the answer is no; 2 wrong usage; 3 unreadable or
#' impossible input, or output that cannot be written (a full disk); 4 no model reaches the
#' accuracy; 70 a fault of this package; 130 interrupted; 141 the reader of the output left.
#'
#' @param dir A folder, better one on the PATH, such as `"~/.local/bin"`. It is made where it does
#'   not exist.
#' @param ... Not used: an unknown argument is an error.
#' @param overwrite TRUE to replace a file that `install_cli()` did not write.
#' @return The path of the command, invisibly.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_file` where the command cannot be written, or
#'   another file of its name is there.
#' @seealso [write_scene()] and [read_scene()] for scenes as files, [trajectory()],
#'   [choose_model()], [rolling_table()], [records_add()].
#' @concept shell
#' @concept terminal
#' @examples
#' command <- install_cli(tempfile("bin"))
#' if (interactive()) {
#'   system2(command, c("roll", "--beta", "0.4", "--angle-deg", "20", "--height-m", "1"))
#' }
#' @export
install_cli <- function(dir, ..., overwrite = FALSE) {
  call <- check_no_dots(...)
  dir <- check_file_name(dir, call, "dir", "folder")
  if (!isTRUE(overwrite) && !isFALSE(overwrite)) {
    abort_rotdyn(c(
      "{.arg overwrite} must be TRUE or FALSE.", x = "It is {describe_value(overwrite)}."
    ), "type", call)
  }
  windows <- .Platform$OS.type == "windows"
  path <- file.path(dir, if (windows) "rotdyn.cmd" else "rotdyn")
  if (file.exists(path) && !overwrite && !is_own_command(path)) {
    abort_rotdyn(c(
      "{.file {path}} is another file.", i = "{.code overwrite = TRUE} replaces it."
    ), "file", call)
  }
  suppressWarnings(dir.create(dirname(path), FALSE, TRUE))
  end <- if (windows) "\r" else ""
  fault <- put_file(paste0(cli_launcher(windows), end), path, "0755")
  if (nzchar(fault)) {
    abort_rotdyn(c("{.file {path}} cannot be written.", x = braces_doubled(fault)), "file", call)
  }
  invisible(path)
}

is_own_command <- function(path) {
  lines <- tryCatch(
    suppressWarnings(readLines(path, 3L, skipNul = TRUE)), error = function(e) NULL
  )
  any(grepl(cli_mark, lines, fixed = TRUE, useBytes = TRUE))
}

cli_mark <- "written by rotdyn::install_cli()"

cli_call <- paste0(
  "options(rotdyn.tables=FALSE);",
  'tryCatch(rotdyn:::cli_main(),interrupt=function(e)quit("no",130L))'
)

# Where standard output or error is closed, files that R opens would have its place.
cli_closed <- c(
  "( : 3>&1 ) 2> /dev/null || { ROTDYN_NO_STDOUT=yes; export ROTDYN_NO_STDOUT; exec > /dev/null; }",
  "( : 3>&2 ) 2> /dev/null || exec 2> /dev/null"
)

cli_flags <- "--no-echo --no-save --no-restore --no-site-file --no-init-file"

# What starts R, with the libraries of this session.
cli_launcher <- function(windows) {
  libraries <- paste(normalizePath(.libPaths(), mustWork = FALSE), collapse = .Platform$path.sep)
  R <- file.path(R.home("bin"), "R")
  if (windows) {
    return(c(
      paste("@rem rotdyn on the command line,", cli_mark), paste0("@set R_LIBS=", libraries),
      "@set R_DEFAULT_PACKAGES=NULL", "@set LANGUAGE=en",
      paste0("@\"", R, "\" ", cli_flags, " -e \"", gsub("\"", "'", cli_call), "\" --args %*")
    ))
  }
  c(
    "#!/bin/sh", paste("# rotdyn on the command line,", cli_mark),
    paste0("R_LIBS=", shQuote(libraries), " R_DEFAULT_PACKAGES=NULL LANGUAGE=en"),
    "export R_LIBS R_DEFAULT_PACKAGES LANGUAGE",
    # No complaint of R's about a locale that is not installed.
    "test \"$(LC_ALL=C.UTF-8 locale charmap 2> /dev/null)\" != UTF-8 || LC_ALL=C.UTF-8",
    "test -z \"$LC_ALL\" || export LC_ALL",
    cli_closed,
    paste("exec", shQuote(R), cli_flags, "-e", shQuote(cli_call), "--args \"$@\"")
  )
}
