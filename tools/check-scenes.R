# Every scene and body that the tests make, as text and back: it must be the same, and compute the
# same bits. What has an R function in it must be refused with these words.
#
#   Rscript tools/check-scenes.R FOLDER [FILTER]     FOLDER of tests; FILTER: a part of their names
library(testthat)
library(rotdyn)
ns <- asNamespace("rotdyn")
folder <- commandArgs(TRUE)[1]
filter <- commandArgs(TRUE)[2]

made <- new.env()
keep <- function(x) {
  if (!inherits(x, c("rot_scene", "rot_body"))) return(invisible())
  name <- rlang::hash(ns$without_pictures(x))
  if (is.null(made[[name]])) assign(name, x, made)
  invisible()
}
constructors <- grep("^(scene|body)_|_bod(y|ies)$", getNamespaceExports("rotdyn"), value = TRUE)
for (name in setdiff(constructors, c("scene_hash", "scene_code"))) {
  f <- ns[[name]]
  body(f) <- bquote({
    on.exit(.(keep)(returnValue()))
    .(body(f))
  })
  unlockBinding(name, ns)
  assign(name, f, ns)
}
test_dir(
  folder, package = "rotdyn", load_package = "installed", reporter = "silent",
  filter = if (!is.na(filter)) filter, stop_on_failure = FALSE
)

quiet <- function(x) suppressWarnings(suppressMessages(x))
said <- function(x) tryCatch(quiet(x), error = function(e) class(e)[1])
columns <- function(x) if (is.data.frame(x)) lapply(unclass(x), identity) else x
bits <- function(x) {
  if (is.character(x)) return(x)
  x <- columns(x)
  lapply(stats::setNames(seq_along(x), names(x)), function(i) {
    if (is.double(x[[i]])) writeBin(as.vector(x[[i]]), raw()) else x[[i]]
  })
}
motion <- function(scene) bits(said(trajectory(scene, scene$start_s + c(0, 0.03, 0.3))))
outcome <- vapply(mget(ls(made), made), function(x) {
  text <- tryCatch(quiet(write_scene(x)), error = identity)
  if (inherits(text, "error")) {
    function_inside <- grepl("R function has no text", conditionMessage(text), fixed = TRUE)
    return(if (function_inside) "an R function" else paste("not written:", class(x)[1]))
  }
  back <- tryCatch(quiet(read_scene(text)), error = identity)
  if (inherits(back, "error")) return(paste("not read:", class(x)[1]))
  same <- ns$same_object(back, x) && identical(scene_hash(back), scene_hash(x)) &&
    (inherits(x, "rot_body") || identical(motion(back), motion(x)))
  paste(if (same) "same:" else "other bits:", class(x)[1])
}, "")
print(table(outcome))
bad <- grep("^(not|other)", outcome)
for (name in names(outcome)[bad]) {
  cat("not ok -", outcome[[name]], "\n")
  str(made[[name]], 1)
}
cat("scenes:", length(outcome) - length(bad), "passed,", length(bad), "failed\n")
quit(status = length(bad) > 0L)
