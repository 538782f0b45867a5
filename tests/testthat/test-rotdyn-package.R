# ARCHITECTURE.md stands in the repository, not in the package: looked for from the tests' folder.
test_that("ARCHITECTURE.md names every file of R/ and src/", {
  root <- Sys.getenv("ROTDYN_ROOT", file.path("..", ".."))
  skip_if_not(file.exists(file.path(root, "ARCHITECTURE.md")), "no repository around")
  text <- readLines(file.path(root, "ARCHITECTURE.md"), encoding = "UTF-8")
  files <- c(
    list.files(file.path(root, "R"), "[.]R$"),
    list.files(file.path(root, "src"), "[.](c|h|in|win)$")
  )
  named <- vapply(files, function(file) {
    any(grepl(paste0("`", file, "`"), text, fixed = TRUE))
  }, TRUE)
  expect_equal(files[!named], character())
})
