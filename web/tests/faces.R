# Scenes by R: a line of JSON for each line of the file, {"scene": text, "times": [...]}.
library(rotdyn)
hex <- function(x) {
  bytes <- matrix(as.character(writeBin(as.double(x), raw(), endian = "big")), 8L)
  apply(bytes, 2L, paste, collapse = "")
}
quoted <- function(x) encodeString(x, quote = "\"")
list_of <- function(x) paste0("[", paste(x, collapse = ","), "]")
lines <- readLines(commandArgs(TRUE)[1])
for (line in lines) {
  scene <- read_scene(sub("^[^\t]*\t", "", line))
  times <- as.double(strsplit(sub("\t.*$", "", line), " ")[[1]])
  motion <- suppressWarnings(trajectory(scene, times))
  choice <- suppressWarnings(choose_model(scene, times))
  columns <- Filter(function(x) is.double(x) || is.logical(x), as.list(motion))
  cat(
    "{\"model\":", quoted(attr(motion, "run")$model), ",\"models\":", list_of(paste0(
      "[", quoted(choice$model), ",", tolower(choice$applies), ",", quoted(choice$reason), "]"
    )), ",\"columns\":{", paste0(
      quoted(names(columns)), ":", vapply(columns, function(x) list_of(quoted(hex(x))), ""),
      collapse = ","
    ), "}}\n", sep = ""
  )
}
