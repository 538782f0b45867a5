# Exercises for a first-year course: the list of them, and sets for learning platforms and paper.

# Sections in the order of the course.
exercise_sections <- c(
  "kinematics", "torque", "moment of inertia", "second law", "pulleys", "work and energy",
  "rolling", "angular momentum", "collisions", "equilibrium", "gears", "oscillations",
  "rotation in space", "measuring", "computing"
)

exercise_column_words <- list(
  c("title", "", "title of an exercise or of a lesson"),
  c("section", "", "section of the course"),
  c("topic", "", "what an exercise is about"),
  c("lesson", "", "lesson that an exercise belongs to: the name of a vignette"),
  c("file", "", "path of a file"),
  c("version", "1", "number of a version of a set of exercises"),
  c("number", "1", "number of a question in its set, of a lesson in the course"),
  c("answer", "", "right answer of a question, as text"),
  c("letter", "", "letter of the right option of a question"),
  c("tolerance", "1", "absolute tolerance of the answer, in its unit")
)

#' Exercises for a first-year course
#'
#' `exercises()` lists the exercises that the package brings, in the order of a first-year course.
#' Each draws its numbers anew, computes the answer with this package, and has a worked solution;
#' the wrong options of a choice come from common mistakes, which the solution names.
#'
#' An exercise is a file of the package exams (R/exams, in R Markdown): `file` can be copied,
#' changed, and given to the functions of that package. [write_exercises()] does so.
#'
#' @param section Names of sections, or NULL for all of them:
#'   `r paste0('"', exercise_sections, '"', collapse = ", ")`.
#' @param ... Not used: an unknown argument is an error.
#' @param lesson Names of lessons (`"rolling"` for `vignette("rolling")`), or NULL for all, and
#'   exercises without a lesson.
#' @return A tibble with a row for each exercise: `name`, `kind` (`"num"`: a number with a
#'   tolerance; `"schoice"`: one of four options), `title`, `section`, `topic`, `lesson` (NA where
#'   no lesson belongs to it), `file`.
#' @section Errors: `rotdyn_error_value` for a section or a lesson without exercises,
#'   `rotdyn_error_argument`.
#' @source Gruen and Zeileis, Automatic generation of exams in R, Journal of Statistical Software
#'   29(10) (2009), for the format of the files.
#' @seealso [write_exercises()]; `vignette("instructors")` for the lessons by weeks of a course.
#' @concept quiz
#' @concept homework
#' @concept exam
#' @examples
#' exercises()
#' exercises("rolling")
#' exercises(lesson = c("gears", "pendulum"))
#' @export
exercises <- function(section = NULL, ..., lesson = NULL) {
  call <- check_no_dots(...)
  all <- exercise_table()
  if (!is.null(section)) {
    all <- all[all$section %in% check_names_known(section, "section", exercise_sections, call), ]
  }
  if (!is.null(lesson)) {
    known <- unique(stats::na.omit(all$lesson))
    all <- all[all$lesson %in% check_names_known(lesson, "lesson", known, call), ]
  }
  all
}

check_names_known <- function(x, arg, known, call) {
  if (!is.character(x) || !length(x) || anyNA(x)) {
    abort_rotdyn(
      c("{.arg {arg}} must be one or more names.", x = "It is {describe_value(x)}."), "value", call
    )
  }
  other <- setdiff(x, known)
  if (length(other)) {
    abort_rotdyn(c(
      "No exercises belong to {.arg {arg}} {.val {other[1]}}.", i = "Known: {.val {known}}."
    ), "value", call)
  }
  x
}

exercise_folder <- function() system.file("exercises", package = "rotdyn")

# A file for each exercise, in the folder of the session. They are installed by section: 91 files
# of 2 kB would take 4 kB each.
exercise_files <- function() {
  to <- file.path(tempdir(), "rotdyn-exercises")
  dir.create(to, showWarnings = FALSE)
  mark <- "^<!-- exercise ([a-z0-9-]+) -->$"
  for (section in list.files(exercise_folder(), "[.]Rmd$", full.names = TRUE)) {
    lines <- readLines(section, encoding = "UTF-8")
    starts <- grep(mark, lines)
    files <- file.path(to, paste0(sub(mark, "\\1", lines[starts]), ".Rmd"))
    parts <- split(lines, findInterval(seq_along(lines), starts))
    for (i in which(!file.exists(files))) writeLines(parts[[i]][-1L], files[i], useBytes = TRUE)
  }
  sort(list.files(to, "[.]Rmd$", full.names = TRUE), method = "radix")
}

# All of them, by what their files say.
exercise_table <- function() {
  files <- exercise_files()
  rows <- lapply(files, exercise_meta)
  field <- function(name) vapply(rows, function(row) unname(row[name]), "")
  table <- list(
    name = field("exname"), kind = field("extype"), title = field("extitle"),
    section = field("exsection"), topic = field("exextra[topic]"),
    lesson = field("exextra[lesson]"), file = files
  )
  order <- order(match(table$section, exercise_sections), seq_along(files))
  new_table(lapply(table, `[`, order), nrow = length(files))
}

# The lines `field: value` below the heading Meta-information, as a named character vector.
exercise_meta <- function(file) {
  lines <- readLines(file, encoding = "UTF-8")
  lines <- lines[seq_along(lines) > match("Meta-information", lines)]
  lines <- grep("^ex[^:]*: ", lines, value = TRUE)
  stats::setNames(sub("^[^:]*: *", "", lines), sub(":.*", "", lines))
}

#' Write a set of exercises with its key
#'
#' Draws the numbers of exercises and writes them for a learning platform or for paper, with the
#' answers beside them. The package exams does the writing.
#'
#' | `to` | files in `dir` | what they are |
#' |---|---|---|
#' | `"html"` | `<name>1.html`, `<name>-solutions1.html`, ... | a page for each version; MathML |
#' | `"pdf"` | `<name>1.pdf`, `<name>-solutions1.pdf`, ... | the same on paper; needs LaTeX |
#' | `"moodle"` | `<name>.xml` | question bank of Moodle: `n` variants, solutions as feedback |
#' | `"canvas"` | `<name>.zip` | quiz of Canvas (QTI 1.2), which draws one of `n` variants |
#'
#' Each set has a key, `<name>-key.csv`: the table that is returned. The same seed gives the same
#' numbers, whatever `to` is. The random numbers of the session are left as they were.
#'
#' @param x Rows of [exercises()], or names of exercises.
#' @param dir A folder for the files. It is made where it does not exist.
#' @param to `"html"`, `"pdf"`, `"moodle"` or `"canvas"`.
#' @param ... Not used: an unknown argument is an error.
#' @param n Number of versions: sheets of paper with other numbers, or variants of each question.
#' @param seed Seed of the drawing, a whole number of at least 0.
#' @param name Beginning of the names of the files: letters, digits, `-` and `_`.
#' @return The key, invisibly: a tibble with a row for each question of each version: `version`,
#'   `number`, `name` (of the exercise), `answer` (text: the number, or the option that is right),
#'   `letter` (of this option as printed, NA for numbers; platforms mix the options again),
#'   `tolerance` (absolute, NA for choices), `title`, `section`, `lesson`, `kind`.
#' @section Errors: `rotdyn_error_package` where the package exams, pandoc, LaTeX (for `"pdf"`) or
#'   zip (for `"canvas"`) is not installed; `rotdyn_error_value` for an unknown exercise, an unknown
#'   `to`, no rows, or an impossible `n`, `seed` or `name`; `rotdyn_error_type`;
#'   `rotdyn_error_file` where the files cannot be written; `rotdyn_error_missing`,
#'   `rotdyn_error_argument`.
#' @source Zeileis, Umlauf and Leisch, Flexible generation of e-learning exams in R, Journal of
#'   Statistical Software 58(1) (2014).
#' @seealso [exercises()].
#' @concept quiz
#' @concept worksheet
#' @concept learning platform
#' @examplesIf requireNamespace("exams", quietly = TRUE) && rmarkdown::pandoc_available()
#' folder <- tempfile("set")
#' key <- write_exercises(c("wrench-torque", "seesaw-balance"), folder, to = "moodle")
#' key
#' list.files(folder)
#' @export
write_exercises <- function(x, dir, to = c("html", "pdf", "moodle", "canvas"), ..., n = 1, seed = 1,
                            name = "exercises") {
  call <- check_no_dots(...)
  check_supplied(c("x", "dir"), call)
  rows <- check_exercises(x, call)
  dir <- check_file_name(dir, call, "dir", "folder")
  to <- check_choice(to, "to", c("html", "pdf", "moodle", "canvas"), call)
  n <- check_versions(n, call)
  seed <- check_drawing_seed(seed, call)
  if (!rlang::is_string(name) || !grepl("^[A-Za-z0-9_-]+$", name)) {
    abort_rotdyn(c(
      "{.arg name} must be one word of letters, digits, - and _.",
      x = "It is {describe_value(name)}."
    ), "value", call)
  }
  need_drawing("Writing exercises", call)
  if (!rmarkdown::pandoc_available()) need_program("pandoc", "Writing exercises", call)
  if (to == "pdf" && !nzchar(Sys.which("pdflatex"))) need_program("LaTeX", "A set as PDF", call)
  if (to == "canvas" && !nzchar(Sys.which(Sys.getenv("R_ZIPCMD", "zip")))) {
    need_program("zip", "A set for Canvas", call)
  }
  make_folder(dir, call)
  with_seed(seed, key <- write_set(rows, dir, to, n, name, seed))
  path <- file.path(dir, paste0(name, "-key.csv"))
  utils::write.csv(as.data.frame(key), path, row.names = FALSE, fileEncoding = "UTF-8")
  invisible(key)
}

# How many versions of a set.
check_versions <- function(n, call) {
  n <- check_number(n, "n", "1", call, lower = 1, upper = 1000)
  if (n != round(n)) {
    abort_rotdyn("{.arg n} must be a whole number: it is {format(n)}.", "value", call)
  }
  n
}

check_drawing_seed <- function(seed, call) {
  seed <- check_number(seed, "seed", "1", call, lower = 0, upper = .Machine$integer.max)
  if (seed != round(seed)) {
    abort_rotdyn("{.arg seed} must be a whole number: it is {format(seed)}.", "value", call)
  }
  seed
}

# The packages that draw, and find pandoc.
need_drawing <- function(why, call) {
  for (package in c("exams", "knitr", "rmarkdown")) need_package(package, why, call)
}

make_folder <- function(dir, call) {
  suppressWarnings(dir.create(dir, FALSE, TRUE))
  if (file.access(dir, 2L) != 0L) {
    abort_rotdyn("The folder {.file {dir}} cannot be written to.", "file", call)
  }
}

check_exercises <- function(x, call, arg = "x") {
  all <- exercise_table()
  names <- if (is.data.frame(x)) x[["name"]] else x
  if (!is.character(names) || anyNA(names)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be rows of {.fn exercises} or names of exercises.",
      x = "It is {describe_value(x)}."
    ), "type", call)
  }
  if (!length(names)) abort_rotdyn("{.arg {arg}} has no exercises.", "value", call)
  other <- setdiff(names, all$name)
  if (length(other)) {
    abort_rotdyn(c(
      "There is no exercise {.val {other[1]}}.", i = "{.fn exercises} lists them."
    ), "value", call)
  }
  all[match(names, all$name), ]
}

need_program <- function(program, why, call, hint = NULL) {
  abort_rotdyn(
    c("{why} needs {program}, which is not installed.", i = hint), "package", call
  )
}

# Evaluates `code` with random numbers of its own.
with_seed <- function(seed, code) {
  old <- get0(".Random.seed", globalenv(), inherits = FALSE)
  on.exit(
    if (is.null(old)) rm(".Random.seed", envir = globalenv()) else
      assign(".Random.seed", old, envir = globalenv())
  )
  set.seed(seed, "Mersenne-Twister", "Inversion", "Rejection")
  force(code)
}

# The files, and the key of what was drawn. A sheet and its solutions are drawn twice from one seed.
write_set <- function(rows, dir, to, n, name, seed) {
  again <- function() set.seed(seed, "Mersenne-Twister", "Inversion", "Rejection")
  files <- as.list(rows$file)
  template <- function(file) file.path(exercise_folder(), file)
  drawn <- switch(to,
    html = {
      sheet <- function(name, solution) {
        exams::exams2html(
          files, n, dir = dir, name = name, template = template("sheet.html"), mathjax = FALSE,
          converter = "pandoc-mathml", question = "", solution = solution, verbose = FALSE
        )
      }
      sheet(name, FALSE)
      again()
      sheet(paste0(name, "-solutions"), "<h4>Solution</h4>")
    },
    pdf = exams::exams2pdf(
      files, n, dir = dir, template = template(c("sheet.tex", "solutions.tex")),
      name = paste0(name, c("", "-solutions")), verbose = FALSE
    ),
    moodle = exams::exams2moodle(files, n, dir = dir, name = name, quiet = TRUE),
    canvas = quiet_zip(exams::exams2canvas(files, n, dir = dir, name = name))
  )
  exercise_key(drawn, rows)
}

# The program zip takes options from a variable: no lines about what it adds.
quiet_zip <- function(code) {
  old <- Sys.getenv("ZIPOPT", NA)
  Sys.setenv(ZIPOPT = "-q")
  on.exit(if (is.na(old)) Sys.unsetenv("ZIPOPT") else Sys.setenv(ZIPOPT = old))
  code
}

# What exams drew, by version and exercise, as the table of answers.
exercise_key <- function(drawn, rows) {
  each <- unlist(lapply(drawn, unname), recursive = FALSE)
  number <- rep(seq_len(nrow(rows)), length(drawn))
  is_number <- rows$kind[number] == "num"
  each <- unname(each)
  answer <- vapply(each, function(one) {
    solution <- one$metainfo$solution
    if (is.numeric(solution)) return(format(solution, digits = 12))
    plain_of_html(one$questionlist[solution])
  }, "")
  letter <- vapply(each, function(one) {
    solution <- one$metainfo$solution
    if (is.logical(solution)) letters[which(solution)] else NA_character_
  }, "")
  tolerance <- vapply(each, function(one) {
    if (is.numeric(one$metainfo$solution)) as.double(one$metainfo$tolerance[1]) else NA_real_
  }, 0)
  new_table(list(
    version = rep(seq_along(drawn), each = nrow(rows)), number = number,
    name = rows$name[number], answer = answer, letter = letter, tolerance = tolerance,
    title = rows$title[number], section = rows$section[number], lesson = rows$lesson[number],
    kind = rows$kind[number]
  ), nrow = length(each))
}

# "2 kg m^2" of "2 kg m<sup>2</sup>", and of the Markdown "2 kg m^2^".
plain_of_html <- function(text) {
  text <- paste(text, collapse = " ")
  text <- gsub("\\^(-?[0-9]+)\\^", "^\\1", gsub("\\$(-[0-9.]+)\\$", "\\1", text))
  text <- gsub("<sup>|\\\\textsuperscript\\{", "^", text)
  text <- gsub("<[^>]*>|[{}]", "", text)
  for (entity in list(c("&nbsp;|&#160;|~", " "), c("&minus;", "-"), c("&times;", "x"),
                      c("&lt;", "<"), c("&gt;", ">"), c("&amp;", "&"))) {
    text <- gsub(entity[1], entity[2], text)
  }
  trimws(gsub("[\u00a0 ]+", " ", gsub("\u2212", "-", gsub("\u00d7", "x", text))))
}
