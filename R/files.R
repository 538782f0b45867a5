# Names of files as arguments, and files that are written.

check_file_name <- function(file, call, arg = "file") {
  if (!rlang::is_string(file) || !nzchar(file)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be the name of a file.", x = "It is {describe_value(file)}."
    ), "type", call)
  }
  if (!is_readable_text(file)) abort_unreadable(file, arg, call)
  # It cuts a name that is too long for it.
  if (startsWith(file, "~") && nchar(file, "bytes") < 1000L) path.expand(file) else file
}

# Text as it is, in UTF-8.
write_file <- function(text, path, call) {
  force(path) # an error of its own is none of writing
  written <- tryCatch(
    suppressWarnings(writeBin(charToRaw(enc2utf8(text)), path)), error = identity
  )
  if (inherits(written, "error")) abort_unwritten(path, written, call)
}

abort_unwritten <- function(path, condition, call) {
  abort_rotdyn(
    c("The file {.file {path}} cannot be written.", x = conditionMessage(condition)), "file", call
  )
}
