# Lessons: the list, and notebooks made of the vignettes as they are.

new_folder <- function() {
  folder <- tempfile("lesson")
  dir.create(folder)
  folder
}

source_of <- function(name) {
  readLines(file.path(lessons_at(), paste0(name, ".Rmd")), encoding = "UTF-8")
}

# The code of each chunk, by its label (numbers for those without).
chunks_of <- function(lines) {
  starts <- grep("^```\\{r", lines)
  code <- lapply(starts, function(start) {
    lines[start + seq_len(which(lines[-seq_len(start)] == "```")[1] - 1L)]
  })
  label <- sub("^```\\{r *([a-z0-9-]*).*", "\\1", lines[starts])
  label[!nzchar(label)] <- seq_along(label)[!nzchar(label)]
  stats::setNames(code, label)
}

test_that("the lessons are listed in the order of the course", {
  all <- with_lessons(lesson())
  expect_s3_class(all, "tbl_df")
  expect_named(all, c("number", "lesson", "minutes", "exercises", "title", "section"))
  expect_identical(setdiff(names(all), column_table()$name), character())
  expect_identical(all$number, seq_len(nrow(all)))
  expect_gt(nrow(all), 20)
  expect_identical(all$lesson[c(1, 11)], c("kinematics", "slip"))
  expect_identical(all$title[11], "when does slipping end?")
  expect_true(all(all$minutes >= 10 & all$minutes <= 120))
  expect_identical(all$exercises[11], nrow(exercises(lesson = "slip")))
  expect_true(all(all$exercises >= 2))
  expect_identical(all$section[11], "rolling")
  expect_identical(setdiff(unlist(strsplit(all$section, ", ")), exercise_sections), character())
})

test_that("a notebook has the lesson's text and code, without its answers", {
  for (name in with_lessons(lesson()$lesson)) {
    file <- file.path(new_folder(), "notebook.Rmd")
    expect_identical(
      with_lessons(withVisible(lesson(name, file))), list(value = file, visible = FALSE)
    )
    lines <- readLines(file, encoding = "UTF-8")
    expect_no_match(
      paste(lines, collapse = "\n"), "details>|summary>|Vignette|html_vignette|pictures[.]R|has_",
      info = name
    )
    expect_true(startsWith(lines[2], "title: \"Lesson "), info = name)
    expect_false(any(grepl("eval *=", grep("^```\\{", lines, value = TRUE))), info = name)
    from <- source_of(name)
    answers <- sum(from == "<details>")
    chunks <- chunks_of(lines)
    expect_identical(anyDuplicated(names(chunks)), 0L, info = name)
    empty <- grepl("^answer-[0-9]+$", names(chunks))
    expect_identical(names(chunks)[empty], paste0("answer-", seq_len(answers)), info = name)
    expect_true(all(lengths(chunks[empty]) == 1L & !nzchar(unlist(chunks[empty]))), info = name)
    # What is left is the code of the page outside its answers, unchanged.
    inside <- cumsum(from == "<details>") > cumsum(from == "</details>")
    page <- chunks_of(from[!inside])
    expect_identical(unname(chunks[!empty]), unname(page[names(page) != "setup"]), info = name)
    expect_true(any(unlist(chunks) == "library(rotdyn)"), info = name)
    # Under the heading that asks for it.
    own <- which(lines == "**Your prediction:**")
    headings <- grep("^## ", lines)
    expect_length(own, 1L)
    expect_match(lines[max(headings[headings < own])], "^## Predict", info = name)
    expect_identical(sum(grepl("^\\*\\*[0-9]+[.]", lines)), sum(grepl("^\\*\\*[0-9]+[.]", from)))
  }
})

test_that("headers are those of R Markdown and of Quarto", {
  skip_if_not_installed("rmarkdown")
  folder <- new_folder()
  with_lessons({
    lesson("spin-up", file.path(folder, "a.Rmd"))
    lesson("spin-up", file.path(folder, "a.qmd"))
  })
  plain <- rmarkdown::yaml_front_matter(file.path(folder, "a.Rmd"))
  expect_identical(plain$title, "Lesson 05: a motor, a disk, and friction")
  expect_named(plain$output, c("html_document", "html_notebook"))
  page <- list(mathjax = NULL, pandoc_args = "--mathml", fig_width = 7L, fig_height = 3.8)
  expect_identical(plain$output$html_document, page)
  expect_identical(plain$output$html_notebook, page)
  quarto <- rmarkdown::yaml_front_matter(file.path(folder, "a.qmd"))
  expect_identical(quarto$title, plain$title)
  expect_identical(quarto$format$html, list(
    "embed-resources" = TRUE, "html-math-method" = "mathml", "fig-width" = 7L, "fig-height" = 3.8
  ))
  body <- function(file) {
    lines <- readLines(file.path(folder, file))
    lines[-seq_len(which(lines == "---")[2])]
  }
  expect_identical(body("a.Rmd"), body("a.qmd"))
  expect_true(any(grepl("^Go on with `lesson\\(\"brake\"\\)`", body("a.Rmd"))))
})

test_that("pictures have the size that the page sets, else 7 x 3.6 inches", {
  page <- function(setup) {
    figure_sizes(c("---", "title: a", "---", "```{r setup, include = FALSE}", setup, "```"))
  }
  expect_equal(page("library(rotdyn)"), c(fig.width = 7, fig.height = 3.6))
  expect_equal(
    page("knitr::opts_chunk$set(fig.height = 4.2)"), c(fig.width = 7, fig.height = 4.2)
  )
})

test_that("a notebook runs by itself", {
  for (package in c("knitr", "ggplot2", "dplyr")) skip_if_not_installed(package)
  folder <- new_folder()
  names <- with_lessons(or_long(c("kinematics", "slip", "gears"), lesson()$lesson))
  with_lessons(for (name in names) lesson(name, file.path(folder, paste0(name, ".Rmd"))))
  script <- file.path(folder, "knit.R")
  writeLines(c(
    paste0("setwd('", normalizePath(folder, "/"), "')"),
    "for (file in commandArgs(TRUE)) {",
    "  knitr::opts_chunk$restore()", "  knitr::opts_chunk$set(error = FALSE)",
    "  knitr::knit(file, quiet = TRUE, envir = new.env())", "}"
  ), script)
  libraries <- paste(.libPaths(), collapse = .Platform$path.sep)
  output <- suppressWarnings(system2(
    file.path(R.home("bin"), "Rscript"),
    c("--vanilla", shQuote(script), paste0(names, ".Rmd")), stdout = TRUE, stderr = TRUE,
    env = c(paste0("R_LIBS=", shQuote(libraries)), "R_TESTS=", "LC_ALL=C.UTF-8")
  ))
  expect_identical(
    attr(output, "status") %||% 0L, 0L, info = paste(tail(output, 5), collapse = "\n")
  )
  expect_true(all(file.exists(file.path(folder, paste0(names, ".md")))))
})

test_that("a student's file is not replaced", {
  folder <- new_folder()
  old <- setwd(folder)
  on.exit(setwd(old))
  expect_identical(with_lessons(lesson("slip")), "slip.Rmd")
  writeLines("mine", "slip.Rmd")
  expect_error(
    with_lessons(lesson("slip")), "exists.*overwrite = TRUE", class = "rotdyn_error_file"
  )
  expect_identical(readLines("slip.Rmd"), "mine")
  with_lessons(lesson("slip", overwrite = TRUE))
  expect_gt(length(readLines("slip.Rmd")), 100)
  expect_identical(list.files(folder), "slip.Rmd")
})

test_that("a notebook is opened where that is asked, in an interactive session alone", {
  opened <- character()
  old <- options(editor = function(name, file, ...) opened <<- c(opened, file))
  on.exit(options(old))
  open <- function(interactive, ...) {
    rlang::with_interactive(
      with_lessons(lesson("slip", tempfile(fileext = ".Rmd"), ...)), interactive
    )
  }
  open(FALSE, open = TRUE)
  open(TRUE, open = FALSE)
  expect_length(opened, 0)
  path <- open(TRUE, open = TRUE)
  expect_identical(basename(opened), basename(path))
})

test_that("what cannot be written is refused by class", {
  refused <- function(class, message, ...) {
    expect_error(with_lessons(lesson(...)), message, class = paste0("rotdyn_error_", class))
  }
  refused("value", "Did you mean \"slip\"", "slp")
  refused("value", "Did you mean \"gyroscope\"", "gyroscop")
  refused("value", "no lesson \"cooking\".*lists them", "cooking")
  refused("value", "no lesson \"tensors\"", "tensors") # an article
  refused("value", "no lesson", "{stop(1)}")
  refused("type", "name of a lesson", 3)
  refused("type", "name of a lesson", c("slip", "gears"))
  refused("value", "must end in", "slip", "slip.html")
  refused("type", "name of a file", "slip", 3)
  refused("file", "no folder", "slip", file.path(tempdir(), "no folder", "slip.Rmd"))
  refused("argument", "needs a", NULL, "slip.Rmd")
  refused("argument", "format", "slip", format = "qmd")
  refused("type", "overwrite", "slip", overwrite = NA)
  refused("type", "open", "slip", open = 1)
  expect_error(
    with_lessons(lesson(), new_folder()), "has no lessons.*build", class = "rotdyn_error_file"
  )
})
