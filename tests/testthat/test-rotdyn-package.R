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
  finds("period", "period_of")
  finds("brake", "resistance")
  finds("disc", "body_plates")
  finds("ring", "body_plates")
  finds("flywheel", "scene_axle")
  finds("moment", "inertia_table")
})
