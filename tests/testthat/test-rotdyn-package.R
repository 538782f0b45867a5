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

test_that("every help page leads to others, and a search for a question finds its page", {
  root <- Sys.getenv("ROTDYN_ROOT")
  pages <- if (nzchar(root)) tools::Rd_db(dir = root) else tools::Rd_db("rotdyn")
  expect_gt(length(pages), 50L)
  tags <- lapply(pages, function(page) vapply(page, attr, "", "Rd_tag"))
  expect_equal(names(Filter(function(tag) !"\\seealso" %in% tag, tags)), character())
  # The fields of help.search(): aliases, concepts, keywords, title.
  searched <- Map(function(page, tag) {
    tolower(unlist(page[tag %in% c("\\alias", "\\concept", "\\title", "\\name")]))
  }, pages, tags)
  finds <- function(word, page) {
    found <- names(Filter(function(text) any(grepl(word, text)), searched))
    expect_true(paste0(page, ".Rd") %in% found, info = paste(word, page))
  }
  finds("period", "period")
  finds("brake", "resistance")
  finds("disc", "body_plates")
  finds("ring", "body_plates")
  finds("flywheel", "scene_axle")
  finds("moment", "inertia_table")
})
