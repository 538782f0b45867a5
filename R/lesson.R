# Lessons: the list of them, and each as a notebook to work in. The source is the vignette as
# installed.

lesson_column_words <- list(
  c("minutes", "1", "minutes that a lesson takes"),
  c("exercises", "1", "number of exercises() of a lesson")
)

#' A lesson as a notebook
#'
#' `lesson("slip")` writes the lesson of `vignette("slip")` as a notebook, `slip.Rmd`, into the
#' working folder: its text and its code, to run chunk by chunk, with places for the student's own
#' prediction and answers. The answers of the lesson are left out. `lesson()` lists the lessons in
#' the order of the course.
#'
#' A notebook needs no other file. It is knitted or previewed by \pkg{rmarkdown} (RStudio's button
#' Knit or Preview), a name that ends in `.qmd` by Quarto. Formulas become MathML, and the page
#' requests nothing from a network. Most lessons attach \pkg{ggplot2} and \pkg{dplyr}.
#'
#' @param lesson The name of a lesson, or NULL for the list of all.
#' @param file A file that ends in `.Rmd` or `.qmd`. NULL: `<lesson>.Rmd` in the working folder.
#' @param ... Not used: an unknown argument is an error.
#' @param overwrite TRUE to replace a file that exists. A student's work may be in it.
#' @param open Whether the notebook is opened in the editor ([utils::file.edit()]), in an
#'   interactive session.
#' @return The path of the notebook, invisibly. Without a `lesson` a tibble with a row for each:
#'   `number`, `lesson` (its name), `minutes`, `exercises` (how many [exercises()] belong to it),
#'   `title`, `section` (sections of those exercises, separated by commas).
#' @section Errors: `rotdyn_error_value` for an unknown lesson, or a `file` with another ending;
#'   `rotdyn_error_file` where the file exists or cannot be written, or the package was installed
#'   without its lessons; `rotdyn_error_type`, `rotdyn_error_argument`.
#' @source Xie, Dervieux and Riederer, R Markdown Cookbook (2020), for the format of notebooks.
#' @seealso [write_worksheet()] for paper, [exercises()]; `vignette("instructors")` for the lessons
#'   by weeks of a course.
#' @concept notebook
#' @concept course
#' @concept Quarto
#' @examplesIf nzchar(system.file("doc", "slip.Rmd", package = "rotdyn"))
#' lesson()
#' notebook <- lesson("slip", tempfile(fileext = ".Rmd"))
#' head(readLines(notebook), 20)
#' @export
lesson <- function(lesson = NULL, file = NULL, ..., overwrite = FALSE, open = interactive()) {
  call <- check_no_dots(...)
  overwrite <- check_flag(overwrite, "overwrite", call)
  open <- check_flag(open, "open", call)
  pages <- lesson_pages(call)
  if (is.null(lesson)) {
    if (!is.null(file)) abort_rotdyn("{.arg file} needs a {.arg lesson}.", "argument", call)
    return(lesson_table(pages))
  }
  name <- check_lesson(lesson, pages, call)
  path <- if (is.null(file)) paste0(name, ".Rmd") else check_file_name(file, call)
  if (!grepl("\\.(rmd|qmd)$", path, ignore.case = TRUE)) {
    abort_rotdyn(c(
      "{.arg file} must end in {.file .Rmd} or {.file .qmd}.", x = "It is {.file {path}}."
    ), "value", call)
  }
  check_not_there(path, overwrite, call)
  quarto <- grepl("\\.qmd$", path, ignore.case = TRUE)
  write_file(notebook_lines(pages[[name]], quarto, names(pages)), path, call)
  if (open && rlang::is_interactive()) utils::file.edit(path)
  invisible(path)
}

check_not_there <- function(paths, overwrite, call) {
  there <- paths[file.exists(paths)]
  if (length(there) && !overwrite) {
    abort_rotdyn(c(
      "The file {.file {there[1]}} exists.", i = "{.code overwrite = TRUE} replaces it."
    ), "file", call)
  }
}

check_lesson <- function(lesson, pages, call) {
  if (!rlang::is_string(lesson)) {
    abort_rotdyn(c(
      "{.arg lesson} must be the name of a lesson.", x = "It is {describe_value(lesson)}."
    ), "type", call)
  }
  if (!is_readable_text(lesson) || !lesson %in% names(pages)) {
    near <- if (is_readable_text(lesson)) near_names(lesson, names(pages))
    abort_rotdyn(c(
      "There is no lesson {quote_text(lesson)}.",
      i = if (length(near)) "Did you mean {.val {near}}?",
      i = "{.run rotdyn::lesson()} lists them."
    ), "value", call)
  }
  lesson
}

# ---- the lessons as installed -------------------------------------------------------------------

lesson_folder <- function() system.file("doc", package = "rotdyn")

lesson_title <- function(lines) {
  sub('^title: "(.*)"$', "\\1", grep("^title: ", lines, value = TRUE)[1])
}
lesson_mark <- "^([0-9]{2}) Lesson: "

# The lines of each lesson, by name, in the order of the course.
lesson_pages <- function(call) {
  files <- list.files(lesson_folder(), "\\.Rmd$", full.names = TRUE)
  pages <- lapply(files, readLines, encoding = "UTF-8", warn = FALSE)
  names(pages) <- sub("\\.Rmd$", "", basename(files))
  titles <- vapply(pages, lesson_title, "")
  titles <- sort(titles[grepl(lesson_mark, titles)], method = "radix")
  if (!length(titles)) {
    abort_rotdyn(c(
      "This installation of {.pkg rotdyn} has no lessons.",
      i = "They come with an installation from a source package that {.code R CMD build} made, or by
           {.code remotes::install_local(build_vignettes = TRUE)}."
    ), "file", call)
  }
  pages[names(titles)]
}

lesson_table <- function(pages) {
  titles <- vapply(pages, lesson_title, "", USE.NAMES = FALSE)
  minutes <- vapply(pages, function(lines) {
    as.double(sub(".*[*]{2}Time:[*]{2} ([0-9]+) minutes.*", "\\1", paste(lines, collapse = " ")))
  }, 0, USE.NAMES = FALSE)
  exercises <- exercise_table()
  sections <- split(exercises$section, factor(exercises$lesson, names(pages)))
  new_table(list(
    number = as.integer(substr(titles, 1L, 2L)), lesson = names(pages),
    minutes = minutes, exercises = unname(lengths(sections)),
    title = sub(lesson_mark, "", titles),
    section = vapply(sections, function(all) toString(unique(all)), "", USE.NAMES = FALSE)
  ), nrow = length(pages))
}

# ---- a notebook ---------------------------------------------------------------------------------

# `known`: names of the lessons.
notebook_lines <- function(lines, quarto, known) {
  body <- lines[-seq_len(which(lines == "---")[2])]
  setup <- hidden_setup(body)
  if (length(setup)) body <- body[-setup]
  body <- with_prediction(with_answers(as_shown(body)))
  onward <- grep("^Go on with ", body)
  for (name in known) {
    call <- paste0(c("vignette(\"", "lesson(\""), name, "\")")
    body[onward] <- gsub(call[1], call[2], body[onward], fixed = TRUE)
  }
  title <- sub(lesson_mark, "Lesson \\1: ", lesson_title(lines))
  without_double_blanks(c(
    notebook_header(title, figure_sizes(lines), quarto), "",
    "Run the chunks one after the other. Write your prediction before you run the motion, and your",
    "answers below the exercises. Change the numbers, and see what happens.", body
  ))
}

without_double_blanks <- function(lines) {
  blank <- !nzchar(lines)
  lines[!(blank & c(FALSE, blank[-length(blank)]))]
}

# The lines of the chunk that sets up the page of the package.
hidden_setup <- function(lines) {
  start <- grep("^```\\{r setup, *include *= *FALSE", lines)
  if (!length(start)) return(integer())
  seq(start[1], start[1] + which(lines[-seq_len(start[1])] == "```")[1])
}

# Pages of the package are also made without the suggested packages; a notebook has them, or says
# which one is missing.
as_shown <- function(lines) {
  head <- grep("^```\\{r", lines)
  lines[head] <- gsub(", *eval *= *has[^,}]*", "", lines[head])
  lines
}

# An empty chunk in place of each answer.
with_answers <- function(lines) {
  from <- which(lines == "<details>")
  to <- which(lines == "</details>")
  for (i in rev(seq_along(from))) {
    place <- c("**Your answer:**", "", paste0("```{r answer-", i, "}"), "", "```")
    lines <- c(lines[seq_len(from[i] - 1L)], place, lines[-seq_len(to[i])])
  }
  lines
}

with_prediction <- function(lines) {
  from <- grep("^## Predict", lines)
  if (!length(from)) return(lines)
  after <- grep("^## ", lines)
  end <- c(after[after > from[1]], length(lines) + 1L)[1] - 1L
  append(lines, c("**Your prediction:**", ""), end)
}

# Width and height of the pictures in inches, as the page has them.
figure_sizes <- function(lines) {
  sizes <- c(fig.width = 7, fig.height = 3.6)
  code <- lines[-seq_len(which(lines == "---")[2])]
  code <- paste(code[hidden_setup(code)], collapse = "\n")
  for (name in names(sizes)) {
    found <- regmatches(code, regexpr(paste0(name, " *= *[0-9.]+"), code))
    if (length(found)) sizes[name] <- as.double(sub(".*= *", "", found))
  }
  sizes
}

notebook_header <- function(title, sizes, quarto) {
  size <- function(mark) paste0("    fig", mark, c("width: ", "height: "), sizes)
  page <- c("    mathjax: null", "    pandoc_args: [\"--mathml\"]", size("_"))
  c(
    "---", paste0("title: \"", title, "\""), "author: \"Your name\"",
    if (quarto) {
      page <- c("    embed-resources: true", "    html-math-method: mathml", size("-"))
      c("format:", "  html:", page)
    } else {
      c("output:", "  html_document:", page, "  html_notebook:", page)
    },
    "---"
  )
}
