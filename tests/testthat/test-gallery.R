# The lists of tools/gallery.R, which are written so that reading them computes nothing.
gallery <- function() {
  path <- file.path(Sys.getenv("ROTDYN_ROOT", "no such folder"), "tools", "gallery.R")
  skip_if_not(file.exists(path), "the repository is not here")
  lists <- new.env(parent = baseenv())
  for (line in parse(path, keep.source = FALSE)) {
    listed <- is.call(line) && identical(line[[1]], quote(`<-`)) && is.call(line[[3]]) &&
      as.character(line[[3]][[1]]) %in% c("alist", "c")
    if (listed) eval(line, lists)
  }
  lists
}

class_of_entry <- function(names) unique(sub("[.].*", "", names))

test_that("every class with a picture is in the gallery, every other that prints has a reason", {
  lists <- gallery()
  shown <- class_of_entry(names(lists$classes))
  drawn <- sub("^autoplot[.]", "", ls(asNamespace("rotdyn"), pattern = "^autoplot[.]rot_"))
  expect_setequal(setdiff(drawn, c(shown, names(lists$exceptions))), "rot_scene")
  expect_setequal(setdiff(shown, drawn), character())
  prints <- ls(.BaseNamespaceEnv[[".__S3MethodsTable__."]], pattern = "^print[.]rot_")
  prints <- sub("^print[.]", "", prints)
  prints <- prints[!startsWith(prints, "rot_scene")]
  expect_setequal(setdiff(prints, c(drawn, names(lists$exceptions))), character())
  expect_true(all(nchar(lists$exceptions) > 20))
})

test_that("every scene is in the gallery", {
  scenes <- class_of_entry(names(gallery()$scenes))
  made <- grep("^scene_", getNamespaceExports("rotdyn"), value = TRUE)
  expect_setequal(scenes, setdiff(made, c("scene_hash", "scene_code")))
})
