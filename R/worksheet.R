# Worksheets: a sheet of paper for a lesson with drawn questions, and its key as another file.

worksheet_column_words <- list(c("points", "1", "points of a question"))

#' A worksheet for a lesson, with its key
#'
#' Writes a sheet to print: the objectives of a lesson, questions with drawn numbers and space to
#' answer, points. The key is a file of its own: answers, which numbers to accept, and worked
#' solutions.
#'
#' | `to` | files in `dir` | what they are |
#' |---|---|---|
#' | `"html"` | `<lesson>-sheet.html`, `<lesson>-key.html` | pages for A4, MathML |
#' | `"markdown"` | `<lesson>-sheet.md`, `<lesson>-key.md` | the same to edit, for Pandoc |
#'
#' With `n` versions the files are `<lesson>-sheet-1.html`, `<lesson>-key-1.html`, and so on. The
#' same seed gives the same sheets and keys, with the numbers of [write_exercises()] for the same
#' questions. The random numbers of the session are left as they were. The package \pkg{exams}
#' draws the questions.
#'
#' @param lesson The name of a lesson: [lesson()] lists them.
#' @param dir A folder for the files. It is made where it does not exist.
#' @param to `"html"` or `"markdown"`.
#' @param ... Not used: an unknown argument is an error.
#' @param questions Rows of [exercises()] or names of exercises, in the order of the sheet. NULL:
#'   those of the lesson.
#' @param n Number of versions, with other numbers in each.
#' @param seed Seed of the drawing, a whole number of at least 0.
#' @param overwrite TRUE to replace files that exist.
#' @return The key, invisibly: a tibble as that of [write_exercises()], with `points`. A question
#'   that asks for a number has 3 points, a choice 2.
#' @section Errors: `rotdyn_error_package` where the packages exams, knitr or rmarkdown, or pandoc
#'   (for `"html"`) are not installed; `rotdyn_error_value` for an unknown lesson or question, an
#'   unknown `to`, an impossible `n` or `seed`; `rotdyn_error_file` where a file exists or cannot be
#'   written, or the package was installed without its lessons; `rotdyn_error_type`,
#'   `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Gruen and Zeileis, Automatic generation of exams in R, Journal of Statistical Software
#'   29(10) (2009).
#' @seealso [write_exercises()] for learning platforms, [lesson()] for notebooks.
#' @concept worksheet
#' @concept homework
#' @concept answer key
#' @examplesIf requireNamespace("exams", quietly = TRUE) && rmarkdown::pandoc_available()
#' if (nzchar(system.file("doc", "motors.Rmd", package = "rotdyn"))) {
#'   folder <- tempfile("sheets")
#'   print(write_worksheet("motors", folder, seed = 7))
#'   list.files(folder)
#' }
#' @export
write_worksheet <- function(lesson, dir, to = c("html", "markdown"), ..., questions = NULL, n = 1,
                            seed = 1, overwrite = FALSE) {
  call <- check_no_dots(...)
  check_supplied(c("lesson", "dir"), call)
  pages <- lesson_pages(call)
  lesson <- check_lesson(lesson, pages, call)
  dir <- check_file_name(dir, call, "dir", "folder")
  to <- check_choice(to, "to", c("html", "markdown"), call)
  if (is.null(questions)) questions <- exercises(lesson = lesson)
  rows <- check_exercises(questions, call, "questions")
  n <- check_versions(n, call)
  seed <- check_drawing_seed(seed, call)
  overwrite <- check_flag(overwrite, "overwrite", call)
  need_drawing("A worksheet", call)
  if (to == "html" && !rmarkdown::pandoc_available()) {
    need_program("pandoc", "A worksheet as HTML", call, "{.code to = \"markdown\"} does without.")
  }
  make_folder(dir, call)
  ending <- if (to == "html") ".html" else ".md"
  version <- if (n > 1) paste0("-", seq_len(n))
  path <- function(kind) file.path(dir, paste0(lesson, kind, version, ending))
  check_not_there(c(path("-sheet"), path("-key")), overwrite, call)
  with_seed(seed, drawn <- draw_as_text(rows, n))
  key <- exercise_key(drawn, rows)
  key$points <- ifelse(key$kind == "num", 3, 2)
  for (i in seq_len(n)) {
    about <- list(
      title = lesson_title(pages[[lesson]]), version = if (n > 1) i, html = to == "html",
      objectives = lesson_objectives(pages[[lesson]]), key = key[key$version == i, ],
      drawn = unname(drawn[[i]]), seed = seed
    )
    put_page(sheet_lines(about), path("-sheet")[i], call)
    put_page(key_lines(about), path("-key")[i], call)
  }
  invisible(key)
}

# What is drawn, in the Markdown of the exercises: by version and question.
draw_as_text <- function(rows, n) {
  exams::xexams(as.list(rows$file), n, driver = list(
    sweave = list(quiet = TRUE, encoding = "UTF-8"), read = NULL, transform = NULL, write = NULL
  ))
}

# The list below the heading.
lesson_objectives <- function(lines) {
  from <- match("## Objectives", lines)
  if (is.na(from)) return(character())
  rest <- lines[-seq_len(from)]
  rest[seq_len(match(TRUE, grepl("^(\\*\\*Before|## )", rest), length(rest) + 1L) - 1L)]
}

# ---- the two pages ------------------------------------------------------------------------------

page_head <- function(about, kind) {
  version <- if (length(about$version)) paste0(" (version ", about$version, ")")
  c(paste0("# ", sub(lesson_mark, paste(kind, "\\1: "), about$title), version), "")
}

# What makes the same numbers again.
origin_of <- function(about) {
  version <- if (length(about$version)) paste0(", version ", about$version)
  seed <- format(about$seed, scientific = FALSE)
  paste0("rotdyn ", utils::packageVersion("rotdyn"), ", seed ", seed, version)
}

sheet_lines <- function(about) {
  c(
    page_head(about, "Worksheet"), name_lines(about), "",
    "**Objectives**", "", about$objectives, "",
    unlist(lapply(seq_along(about$drawn), function(i) {
      number <- about$key$kind[i] == "num"
      question_box(about$html, c(
        question_heading(about, i), "", about$drawn[[i]]$question, "", options_of(about$drawn[[i]]),
        if (!number) c(paste("**Letter:**", blank_line(about$html), "**Reason:**"), ""),
        space_lines(about$html, if (number) 55 else 30),
        if (number) paste("**Answer:**", blank_line(about$html))
      ))
    })),
    if (about$html) paste0("<footer>", origin_of(about), "</footer>")
  )
}

key_lines <- function(about) {
  key <- about$key
  c(
    page_head(about, "Key to worksheet"), paste0("Numbers drawn by ", origin_of(about), "."), "",
    "A number: 2 points for the derivation, 1 for the number with its unit. A choice: 1 point for",
    "the letter, 1 for the reason.", "",
    "| question | answer | accept | points |", "|---|---|---|---|",
    paste0(
      "| ", seq_len(nrow(key)), " | ", vapply(seq_len(nrow(key)), answer_of, "", about), " | ",
      vapply(seq_len(nrow(key)), accepted_of, "", about), " | ", key$points, " |"
    ), "",
    unlist(lapply(seq_along(about$drawn), function(i) {
      one <- about$drawn[[i]]
      question_box(about$html, c(
        question_heading(about, i), "", one$question, "", options_of(one),
        paste0("**Answer:** ", answer_of(i, about)), "", "**Solution**", "", one$solution, "",
        if (length(one$solutionlist)) options_of(one, one$solutionlist)
      ))
    }))
  )
}

name_lines <- function(about) {
  total <- sum(about$key$points)
  if (!about$html) {
    blank <- blank_line(FALSE)
    return(paste0("Name: ", blank, "  Date: ", blank, "  Points: ", blank, " of ", total))
  }
  paste0(
    "<p class=\"name\"><span>Name:</span><span>Date:</span><span>Points: <span>of ", total,
    "</span></span></p>"
  )
}

question_heading <- function(about, i) {
  paste0("## ", i, ". ", about$key$title[i], " (", about$key$points[i], " points)")
}

options_of <- function(one, texts = one$questionlist) {
  if (!length(texts)) return(character())
  c(paste0(letters[seq_along(texts)], ". ", texts), "")
}

# A line of the text of a question: "Give the answer in rad/s, to within 1 %."
unit_asked <- function(one) {
  text <- gsub("&nbsp;", " ", paste(one$question, collapse = " "), fixed = TRUE)
  found <- regmatches(text, regexpr("Give the answer in .*?, to within", text))
  if (length(found)) sub("Give the answer in (.*), to within", "\\1", found) else ""
}

with_unit <- function(text, one) trimws(paste(text, unit_asked(one)))

answer_of <- function(i, about) {
  one <- about$drawn[[i]]
  if (about$key$kind[i] == "num") {
    return(with_unit(format(signif(one$metainfo$solution, 4), digits = 4), one))
  }
  right <- which(one$metainfo$solution)
  paste0(letters[right], ". ", one$questionlist[right])
}

# The numbers that a learning platform accepts.
accepted_of <- function(i, about) {
  if (about$key$kind[i] != "num") return("")
  one <- about$drawn[[i]]
  value <- one$metainfo$solution
  ends <- sort(value + c(-1, 1) * one$metainfo$tolerance[1])
  digits <- max(0, 3 - floor(log10(abs(value))))
  with_unit(paste(format(round(ends, digits), trim = TRUE), collapse = " to "), one)
}

question_box <- function(html, lines) {
  if (html) c("<section class=\"question\">", "", lines, "", "</section>", "") else c(lines, "")
}

# Millimetres to write in.
space_lines <- function(html, mm) {
  if (html) return(c(paste0("<div class=\"space\" style=\"height: ", mm, "mm\"></div>"), ""))
  rep(c("&nbsp;", ""), round(mm / 8))
}

blank_line <- function(html) {
  if (html) "<span class=\"blank\"></span>" else strrep("\\_", 12)
}

# ---- Markdown and HTML --------------------------------------------------------------------------

put_page <- function(lines, path, call) {
  lines <- without_double_blanks(lines)
  write_file(if (grepl("\\.md$", path)) lines else html_page(lines), path, call)
}

html_page <- function(lines) {
  from <- tempfile(fileext = ".md")
  to <- sub("md$", "html", from)
  on.exit(unlink(c(from, to)))
  writeLines(enc2utf8(lines), from, useBytes = TRUE)
  rmarkdown::pandoc_convert(from, "html5", "markdown-auto_identifiers", to, options = "--mathml")
  c(
    "<!DOCTYPE html>", "<html lang=\"en\">", "<head>", "<meta charset=\"utf-8\">",
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">",
    paste0("<title>", html_text(sub("^# ", "", lines[1])), "</title>"),
    "<style>", worksheet_style, "</style>", "</head>",
    "<body>", "<main>", readLines(to, encoding = "UTF-8"), "</main>", "</body>", "</html>"
  )
}

worksheet_style <- c(
  "@page { size: A4; margin: 16mm 18mm; }",
  "body { font: 11pt/1.4 sans-serif; color: #111; max-width: 174mm; margin: 8mm auto; }",
  "h1 { font-size: 17pt; margin: 0 0 4mm; }",
  "h2 { font-size: 12pt; margin: 0 0 1.5mm; }",
  "p, ul, ol { margin: 0 0 2mm; }",
  ".name { display: flex; gap: 8mm; margin-bottom: 4mm; }",
  ".name > span { flex: 2; border-bottom: 1px solid #111; }",
  ".name > span:last-child { flex: 1; display: flex; justify-content: space-between; }",
  ".question { break-inside: avoid; margin-top: 6mm; }",
  ".space { border: 1px solid #999; margin: 2mm 0; }",
  ".blank { display: inline-block; width: 50mm; border-bottom: 1px solid #111; }",
  "table { border-collapse: collapse; margin: 3mm 0; }",
  "th, td { border: 1px solid #999; padding: 1mm 3mm; text-align: left; }",
  "math[display=\"block\"] { margin: 2mm 0; }",
  "sup { font-size: 75%; line-height: 0; }",
  # Browsers set single letters of a unit in italics.
  "mstyle[mathvariant=\"normal\"] mi { text-transform: none; }",
  "footer { margin-top: 6mm; font-size: 8pt; color: #555; }",
  "@media print { body { margin: 0; max-width: none; } }"
)
