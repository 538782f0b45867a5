# Every vignette runs from what its reader sees: visible chunks alone. Lessons have their parts.

vignette_files <- function() {
  root <- Sys.getenv("ROTDYN_ROOT", file.path("..", ".."))
  folder <- file.path(root, "vignettes")
  if (!dir.exists(folder)) folder <- system.file("doc", package = "rotdyn")
  files <- list.files(folder, "[.]Rmd$", full.names = TRUE)
  if (!length(files)) skip("no vignettes")
  files
}

title_of <- function(lines) sub('^title: "(.*)"$', "\\1", grep("^title: ", lines, value = TRUE)[1])

# The chunks of R: whether a reader sees them, whether they run, whether they are meant to fail.
all_chunks <- function(lines) {
  starts <- grep("^```\\{r", lines)
  lapply(starts, function(start) {
    end <- start + which(lines[-seq_len(start)] == "```")[1]
    head <- lines[start]
    list(
      code = lines[seq_len(end - start - 1) + start],
      shown = !grepl("include *= *FALSE|echo *= *FALSE", head),
      run = !grepl("eval *= *FALSE", head), error = grepl("error *= *TRUE", head)
    )
  })
}
visible_chunks <- function(lines) {
  Filter(function(chunk) chunk$shown && chunk$run, all_chunks(lines))
}

# parse(text = NULL) reads standard input, which holds the commands of a parallel test process.
parsed <- function(code) parse(text = paste(code, collapse = "\n"), keep.source = FALSE)

# Names that code assigns, and all names that it has.
names_in <- function(code) all.names(parsed(code), unique = TRUE)
assigned_in <- function(code) {
  found <- character()
  walk <- function(x) {
    if (is.call(x)) {
      if (as.character(x[[1]])[1] %in% c("<-", "=", "<<-") && is.name(x[[2]])) {
        found <<- c(found, as.character(x[[2]]))
      }
      lapply(as.list(x), walk)
    } else if (is.expression(x)) lapply(as.list(x), walk)
    NULL
  }
  walk(parsed(code))
  unique(found)
}

# R CMD build has run each page. What a reader types gives the same where visible code uses no
# object, and no package, that comes from a hidden chunk alone.
hidden_needs <- function(lines) {
  shown <- unlist(lapply(visible_chunks(lines), `[[`, "code"))
  hidden <- unlist(lapply(all_chunks(lines), function(chunk) if (!chunk$shown) chunk$code))
  attached <- function(code) {
    found <- regmatches(code, regexpr("(library|require)\\([a-z0-9A-Z.]+", code))
    sub(".*\\(", "", found)
  }
  exported <- function(packages) {
    unlist(lapply(packages, function(package) {
      if (requireNamespace(package, quietly = TRUE)) getNamespaceExports(package)
    }))
  }
  missing <- setdiff(attached(hidden), attached(shown))
  own <- assigned_in(shown)
  hidden_objects <- c(setdiff(assigned_in(hidden), own), setdiff(exported(missing), own))
  intersect(hidden_objects, names_in(shown))
}

test_that("the visible code of every vignette needs nothing that is hidden", {
  for (file in vignette_files()) {
    expect_identical(
      hidden_needs(readLines(file, encoding = "UTF-8")), character(), info = basename(file)
    )
  }
})

test_that("a hidden object and a hidden package are found", {
  hidden <- c("```{r, include = FALSE}", "colours <- 1", "```", "```{r}", "colours + 1", "```")
  expect_identical(hidden_needs(hidden), "colours")
  expect_identical(hidden_needs(sub(", include = FALSE", "", hidden)), character())
  expect_identical(hidden_needs(sub("colours <- 1", "library(tools)", sub(
    "colours . 1", "file_ext(1)", hidden
  ))), "file_ext")
})

# The visible code of each in a session of its own: `make check-long`.
run_visible <- function(lines) {
  script <- unlist(lapply(visible_chunks(lines), function(chunk) {
    if (chunk$error) c("try({", chunk$code, "}, silent = TRUE)") else chunk$code
  }))
  folder <- tempfile("vignette")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  file <- file.path(folder, "visible.R")
  writeLines(c("pdf(NULL)", script), file)
  libraries <- paste(.libPaths(), collapse = .Platform$path.sep)
  output <- suppressWarnings(system2(
    file.path(R.home("bin"), "Rscript"), c("--vanilla", shQuote(file)), stdout = TRUE,
    stderr = TRUE,
    env = c(paste0("R_LIBS=", shQuote(libraries)), "R_TESTS=", "LC_ALL=C.UTF-8")
  ))
  list(status = attr(output, "status") %||% 0L, output = output)
}

if (long_tests) test_that("the visible code of every vignette runs in a fresh session", {
  for (need in c("ggplot2", "dplyr", "deSolve", "xml2", "units", "yyjsonr", "DBI", "RSQLite")) {
    skip_if_not_installed(need)
  }
  for (file in vignette_files()) {
    ran <- run_visible(readLines(file, encoding = "UTF-8"))
    expect_identical(
      as.integer(ran$status), 0L,
      info = paste(c(basename(file), tail(ran$output, 5)), collapse = "\n")
    )
  }
})

# Titles begin with two digits: browseVignettes() orders by title.
number_of <- function(lines) as.integer(sub("^([0-9]{2}) .*", "\\1", title_of(lines)))

pages_with <- function(pattern) {
  all <- lapply(vignette_files(), readLines, encoding = "UTF-8")
  names(all) <- basename(vignette_files())
  all <- Filter(function(lines) grepl(pattern, title_of(lines)), all)
  all[order(vapply(all, number_of, 0L))]
}
lessons <- function() pages_with("^[0-9]{2} Lesson: ")
pages_named <- function(lines) {
  calls <- unlist(regmatches(lines, gregexpr("vignette\\(\"[a-z-]+\"", lines)))
  sub(".*\"([a-z-]+)\".*", "\\1", calls)
}

test_that("titles are numbered: introduction, lessons 1, 2, ..., articles, overview", {
  pages <- pages_with("")
  kind <- sub("^[0-9]{2} ([A-Za-z]+).*", "\\1", vapply(pages, title_of, ""))
  expect_identical(
    rle(unname(kind))$values, c("Introduction", "Lesson", "Article", "For")
  )
  numbers <- vapply(pages, number_of, 0L)
  expect_false(anyDuplicated(numbers) > 0)
  expect_identical(unname(numbers[kind == "Lesson"]), seq_len(sum(kind == "Lesson")))
  expect_identical(names(lessons())[1], "kinematics.Rmd")
  for (name in names(pages)) {
    entry <- paste0("\\VignetteIndexEntry{", title_of(pages[[name]]), "}")
    expect_true(any(grepl(entry, pages[[name]], fixed = TRUE)), info = name)
  }
})

# inst/doc/index.html replaces the index that R would write, which is in the order of file names.
test_that("the index of the help pages lists all pages in their order", {
  index <- file.path(Sys.getenv("ROTDYN_ROOT", "no such folder"), "inst", "doc", "index.html")
  if (!file.exists(index)) index <- system.file("doc", "index.html", package = "rotdyn")
  skip_if(!nzchar(index), "no index")
  rows <- grep("<li>", readLines(index, encoding = "UTF-8"), value = TRUE)
  pages <- pages_with("")
  expect_identical(
    sub(".*<a href=\"([^\"]+)\">.*", "\\1", rows), sub("[.]Rmd$", ".html", names(pages))
  )
  expect_identical(
    sub(".*\">(.*)</a>.*", "\\1", rows), unname(vapply(pages, title_of, ""))
  )
})

test_that("a lesson needs earlier ones alone, and leads to the next", {
  course <- sub("[.]Rmd$", "", names(lessons()))
  for (i in seq_along(course)) {
    text <- paste(lessons()[[i]], collapse = " ")
    before <- sub(".*[*]{2}Before:[*]{2}(.*)[*]{2}Time:.*", "\\1", text)
    expect_identical(
      setdiff(pages_named(before), c("rotdyn", course[seq_len(i - 1)])), character(),
      info = course[i]
    )
    onward <- grep("^Go on with ", lessons()[[i]], value = TRUE)
    expect_length(onward, 1)
    if (i < length(course)) expect_identical(pages_named(onward)[1], course[i + 1])
  }
})

# Words of a page without code, equations and tags.
words_of_page <- function(lines) {
  text <- paste(lines[-seq_len(which(lines == "---")[2])], collapse = "\n")
  for (part in c("(?s)```.*?```", "(?s)\\$\\$.*?\\$\\$", "<[^>]*>")) {
    text <- gsub(part, "", text, perl = TRUE)
  }
  length(strsplit(trimws(text), "\\s+")[[1]])
}

test_that("a lesson has at most 1000 words", {
  words <- vapply(lessons(), words_of_page, 0L)
  expect_identical(names(words)[words > 1000], character())
})

test_that("each lesson has its parts, and so has each article that states objectives", {
  articles <- Filter(function(lines) "## Objectives" %in% lines, pages_with("Article: "))
  expect_gt(length(articles), 5)
  parted <- c(lessons(), articles)
  for (name in names(parted)) {
    lines <- parted[[name]]
    has <- function(pattern) any(grepl(pattern, lines))
    expect_true(has("^## Objectives$"), info = name)
    expect_true(has("\\*\\*Before:\\*\\*"), info = name)
    expect_true(has("\\*\\*Time:\\*\\* [0-9]+ minutes"), info = name)
    expect_true(has("^## Predict"), info = name)
    expect_true(has("^## (A c|C)ommon misconception"), info = name)
    expect_true(has("^## Exercise"), info = name)
    expect_gt(sum(lines == "<details>"), 0)
    expect_identical(sum(lines == "<details>"), sum(lines == "</details>"), info = name)
    expect_identical(
      sum(lines == "<details>"), sum(lines == "<summary>Answer</summary>"), info = name
    )
    seen <- unlist(lapply(visible_chunks(lines), `[[`, "code"))
    expect_true(any(grepl("^```\\{r drawing", lines)), info = name)
    expect_true(any(grepl("autoplot\\(", seen)), info = name)
  }
})

test_that("every page is listed for instructors, and links lead to pages that exist", {
  files <- vignette_files()
  pages <- sub("[.]Rmd$", "", basename(files))
  text <- lapply(files, readLines, encoding = "UTF-8")
  names(text) <- pages
  for (page in setdiff(pages, "instructors")) {
    expect_true(any(grepl(paste0("`", page, "`"), text$instructors, fixed = TRUE)), info = page)
  }
  expect_identical(setdiff(pages_named(unlist(text)), pages), character())
  sheets <- grep("^## Worksheet", text$instructors, value = TRUE)
  expect_identical(
    as.integer(sub("^## Worksheet ([0-9]+):.*", "\\1", sheets))[seq_along(lessons())],
    seq_along(lessons())
  )
})

# A row: the section of a course, its topic, the page, and its heading or exercise.
test_that("every topic of a first course is taught where the table says", {
  topics <- read.csv(
    system.file("extdata", "first_course.csv", package = "rotdyn"), colClasses = "character"
  )
  expect_identical(names(topics), c("course", "section", "topic", "page", "place"))
  expect_setequal(
    topics$section[topics$course == "OpenStax"],
    c(paste0("10.", 1:8), paste0("11.", 1:4), "12.1", "12.2", "15.4", "15.5", "15.6")
  )
  expect_setequal(topics$section[topics$course == "MIT 8.01"], paste("week", 10:12))
  first_course <- c(lessons(), pages_with("Introduction"))
  expect_identical(setdiff(paste0(topics$page, ".Rmd"), names(first_course)), character())
  found <- mapply(function(page, place) {
    lines <- first_course[[paste0(page, ".Rmd")]]
    if (!grepl("^exercise ", place)) return(paste("##", place) %in% lines)
    exercises <- lines[-seq_len(grep("^## Exercise", lines))]
    any(startsWith(exercises, sub("^exercise ", "**", paste0(place, "."))))
  }, topics$page, topics$place)
  expect_identical(paste(topics$page, topics$place)[!found], character())
})

# What pages call stays what the package exports. (Every export is used: test-help.R.)
test_that("functions that pages name in their text exist", {
  known <- c(
    getNamespaceExports("rotdyn"), ls(baseenv()), ls("package:stats"), ls("package:utils"),
    "library", "mutate", "autoplot", "object_at", "input_at", "column_at" # dplyr, ggplot2, rotdyn.h
  )
  for (file in vignette_files()) {
    lines <- readLines(file, encoding = "UTF-8")
    text <- gsub("(?s)```.*?```", "", paste(lines, collapse = "\n"), perl = TRUE)
    calls <- regmatches(text, gregexpr("`[a-z_0-9]+(?=\\()", text, perl = TRUE))[[1]]
    made <- assigned_in(unlist(lapply(visible_chunks(lines), `[[`, "code")))
    expect_identical(
      setdiff(sub("`", "", calls), c(known, made)), character(), info = basename(file)
    )
  }
})

test_that("what the first lessons said wrongly", {
  text <- unlist(lapply(vignette_files(), readLines, encoding = "UTF-8"))
  text <- paste(text, collapse = " ")
  expect_no_match(text, "three models")
  expect_no_match(text, "[Oo]nly the angle of an incline")
})

test_that("lessons mask no function or constant of base R", {
  for (name in names(lessons())) {
    seen <- unlist(lapply(visible_chunks(lessons()[[name]]), `[[`, "code"))
    assigned <- "^ *([A-Za-z_.0-9]+) <- .*"
    made <- sub(assigned, "\\1", grep(assigned, seen, value = TRUE))
    taken <- c(ls(baseenv()), "df", "sd", "var")
    expect_identical(intersect(made, taken), character(), info = name)
  }
})

# Where a suggested package is missing, its chunks are not run, but inline code is.
if (long_tests) test_that("pages can be made without the suggested packages", {
  skip_if_not_installed("knitr")
  script <- tempfile(fileext = ".R")
  on.exit(unlink(script))
  writeLines(c(
    "has <- base::requireNamespace",
    "unlockBinding('requireNamespace', baseenv())",
    "gone <- c('ggplot2', 'dplyr', 'deSolve', 'xml2', 'units', 'yyjsonr')",
    "assign('requireNamespace', function(package, ...) {",
    "  !package %in% gone && has(package, ...)", "}, baseenv())",
    paste0("setwd('", tempdir(), "')"),
    "for (file in commandArgs(TRUE)) {", "  knitr::opts_chunk$restore()",
    "  knitr::knit(file, tempfile(), quiet = TRUE, envir = new.env())", "}"
  ), script)
  libraries <- paste(.libPaths(), collapse = .Platform$path.sep)
  output <- suppressWarnings(system2(
    file.path(R.home("bin"), "Rscript"),
    c("--vanilla", shQuote(script), shQuote(normalizePath(vignette_files()))),
    stdout = TRUE, stderr = TRUE,
    env = c(paste0("R_LIBS=", shQuote(libraries)), "R_TESTS=", "LC_ALL=C.UTF-8")
  ))
  expect_identical(
    attr(output, "status") %||% 0L, 0L, info = paste(tail(output, 5), collapse = "\n")
  )
})
