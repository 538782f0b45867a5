# Lessons for the tests of notebooks and worksheets.

# The lessons as installed, else (after an installation without vignettes) those of the sources.
lessons_at <- function() {
  folder <- system.file("doc", package = "rotdyn")
  if (!length(list.files(folder, "[.]Rmd$"))) {
    folder <- file.path(Sys.getenv("ROTDYN_ROOT", file.path("..", "..")), "vignettes")
  }
  if (!length(list.files(folder, "[.]Rmd$"))) skip("no lessons")
  folder
}

# Evaluates `code` with the lessons of another folder.
with_lessons <- function(code, folder = lessons_at()) {
  here <- asNamespace("rotdyn")
  put <- function(f) {
    unlockBinding("lesson_folder", here)
    assign("lesson_folder", f, here)
    lockBinding("lesson_folder", here)
  }
  old <- get("lesson_folder", here)
  on.exit(put(old))
  put(function() folder)
  force(code)
}
