# The motions of the examples of the help pages, as lines for web/tests/core.test.mjs:
#
#   START END ROWS ACCURACY SCENE
#
#   Rscript web/tests/examples.R FILE     in the package's folder, rotdyn installed
#
# Each motion that a verb computes is one, whichever verb. A scene with an R function is no text.
library(rotdyn)
file <- normalizePath(commandArgs(trailingOnly = TRUE)[1], mustWork = FALSE)
pages <- tools::Rd_db(dir = ".")
found <- character()
functions <- 0L
note <- function(scene, time_s, accuracy) {
  if (!length(time_s)) return()
  text <- tryCatch(write_scene(scene), rotdyn_error = function(e) NULL)
  if (is.null(text)) {
    functions <<- functions + 1L
    return()
  }
  numbers <- formatC(c(range(time_s), min(length(time_s), 401), accuracy), digits = 17, width = 1)
  line <- paste(c(numbers, gsub("[[:space:]]*\n[[:space:]]*", " ", text)), collapse = " ")
  found <<- union(found, line)
}
suppressMessages(trace(
  "run_trajectory", where = asNamespace("rotdyn"), print = FALSE,
  tracer = bquote(.(note)(scene, time_s, accuracy))
))

folder <- tempfile("examples")
dir.create(folder)
setwd(folder)
grDevices::pdf(NULL)
failed <- character()
for (page in names(pages)) {
  code <- tempfile(fileext = ".R")
  tools::Rd2ex(pages[[page]], code)
  if (!file.exists(code)) next
  said <- tryCatch({
    utils::capture.output(suppressWarnings(suppressMessages(
      source(code, local = new.env(), echo = FALSE)
    )))
    NULL
  }, error = conditionMessage)
  if (length(said)) failed <- c(failed, paste(page, said, sep = ": "))
}
writeLines(found, file)
cat(length(found), "motions;", functions, "with R functions;", length(failed), "pages failed\n")
if (length(failed)) writeLines(failed)
quit(status = as.integer(length(failed) > 0L))
