# Names of files as arguments, and files that are written.

check_file_name <- function(file, call, arg = "file", kind = "file") {
  if (!rlang::is_string(file) || !nzchar(file)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be the name of a {kind}.", x = "It is {describe_value(file)}."
    ), "type", call)
  }
  if (!is_readable_text(file)) abort_unreadable(file, arg, call)
  # It cuts a name that is too long for it.
  if (startsWith(file, "~") && nchar(file, "bytes") < 1000L) path.expand(file) else file
}

# Text or bytes (raw); each string of a text ends its line. All of it is written, or nothing: to a
# temporary file beside the target, which then takes the target's name.
write_file <- function(x, path, call) {
  force(path) # an error of its own is none of writing
  fault <- put_file(x, path)
  if (nzchar(fault)) {
    abort_rotdyn(
      c("The file {.file {path}} cannot be written.", x = braces_doubled(fault)), "file", call
    )
  }
}

# "", or what is wrong. `mode`: of a new file, NULL for the usual one.
put_file <- function(x, path, mode = NULL) {
  if (is.character(x)) x <- enc2utf8(x)
  tryCatch(
    suppressWarnings(put_whole(x, enc2native(path), mode)),
    error = function(e) {
      if (reader_left(e)) "The reader of the pipe left." else conditionMessage(e)
    }
  )
}

# R's own words where the reader of a pipe left: its handler of the signal raises them.
reader_left <- function(e) grepl("SIGPIPE", conditionMessage(e), fixed = TRUE)

put_whole <- function(x, path, mode) {
  target <- link_target(path)
  descriptor <- descriptor_of(target)
  if (!is.na(descriptor)) return(.Call(ffi_file_write, descriptor, x))
  if (dir.exists(target)) return("It is a folder.")
  folder <- dirname(target)
  if (!dir.exists(folder)) return(paste0("There is no folder \"", folder, "\"."))
  there <- file.exists(target)
  if (there && .Call(ffi_file_special, target)) return(.Call(ffi_file_write, target, x))
  if (there && file.access(target, 2L) != 0L) return("It may not be changed.")
  # A file in a folder that takes no new files is written where it is.
  if (there && file.access(folder, 2L) != 0L) return(.Call(ffi_file_write, target, x))
  part <- tempfile(".rotdyn-", folder)
  on.exit(unlink(part))
  fault <- .Call(ffi_file_write, part, x)
  if (nzchar(fault)) return(fault)
  if (is.null(mode) && there) mode <- file.mode(target)
  if (!is.null(mode)) Sys.chmod(part, mode, FALSE)
  if (file.rename(part, target)) "" else "Another file of this name is in the way."
}

# What a path names in the end, through links; a name in /dev or /proc stays: it may be a link to a
# descriptor of this process.
link_target <- function(path) {
  for (i in 1:40) {
    if (grepl("^/(dev|proc)/", path)) break
    link <- suppressWarnings(Sys.readlink(path))
    if (is.na(link) || !nzchar(link)) break
    path <- if (startsWith(link, "/")) link else file.path(dirname(path), link)
  }
  path
}

# Standard output and its like are written where they stand: opening them anew would empty the file
# that they lead to.
descriptor_of <- function(path) {
  names <- c("/dev/stdout" = 1L, "/dev/stderr" = 2L)
  if (path %in% names(names)) return(names[[path]])
  number <- sub("^(/dev/fd|/proc/self/fd)/([0-9]{1,9})$", "\\2", path)
  if (identical(number, path)) NA_integer_ else as.integer(number)
}

# Of words that are not ours: cli takes braces for code.
braces_doubled <- function(text) gsub("([{}])", "\\1\\1", text)

# ---- reading --------------------------------------------------------------------------------

# The text of a file, compressed or not, taken as UTF-8; NA where it has a zero byte, which R's own
# readers drop.
file_text <- function(path) {
  plain <- file.exists(path) && !.Call(ffi_file_special, path)
  con <- if (plain) gzfile(path, "rb") else file(path, "rb")
  on.exit(close(con))
  bytes_text(all_bytes(con))
}

# Without a byte order mark, of text that may not be valid.
without_mark <- function(text) sub("^\xef\xbb\xbf", "", text, useBytes = TRUE)

all_bytes <- function(con) {
  parts <- list()
  repeat {
    part <- readBin(con, "raw", 2^20)
    if (!length(part)) break
    parts[[length(parts) + 1L]] <- part
  }
  as.raw(unlist(parts))
}

bytes_text <- function(bytes) {
  if (any(bytes == as.raw(0))) return(NA_character_)
  text <- rawToChar(bytes)
  Encoding(text) <- "UTF-8"
  text
}

# Of a connection of the user's, which may be open for text: then readLines() warns of zero bytes,
# and of the end of the last line, in the language of the session.
connection_text <- function(con) {
  lines <- connection_lines(con)
  if (anyNA(lines)) return(NA_character_)
  text <- paste(lines, collapse = "\n")
  Encoding(text) <- "UTF-8"
  text
}

# The next n lines, or all; NA where one has a zero byte, behind which readLines() drops the rest.
connection_lines <- function(con, n = -1L) {
  said <- character()
  lines <- withCallingHandlers(
    readLines(con, n, encoding = "UTF-8"),
    warning = function(w) {
      said <<- c(said, conditionMessage(w))
      invokeRestart("muffleWarning")
    }
  )
  last <- sprintf(gettext("incomplete final line found on '%s'", domain = "R"),
                  summary(con)$description)
  if (length(setdiff(said, last))) NA_character_ else lines
}
