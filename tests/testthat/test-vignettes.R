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

lessons <- function() {
  all <- lapply(vignette_files(), readLines, encoding = "UTF-8")
  names(all) <- basename(vignette_files())
  Filter(function(lines) grepl("^Lesson", title_of(lines)), all)
}

test_that("lesson 1 is there", {
  expect_match(title_of(lessons()[["first-motion.Rmd"]]), "^Lesson 1:")
})

test_that("each lesson has its parts", {
  for (name in names(lessons())) {
    lines <- lessons()[[name]]
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

test_that("lessons are numbered, listed for instructors, and lead to pages that exist", {
  numbers <- vapply(lessons(), function(lines) {
    as.integer(sub("^Lesson ([0-9]+):.*", "\\1", title_of(lines)))
  }, integer(1))
  expect_identical(sort(unname(numbers)), seq_along(numbers))
  files <- vignette_files()
  pages <- sub("[.]Rmd$", "", basename(files))
  text <- lapply(files, readLines, encoding = "UTF-8")
  listed <- grep("^\\|", text[[match("instructors", pages)]], value = TRUE)
  for (page in sub("[.]Rmd$", "", names(lessons()))) {
    expect_true(any(grepl(paste0("`", page, "`"), listed, fixed = TRUE)), info = page)
  }
  links <- unlist(regmatches(unlist(text), gregexpr("vignette\\(\"[a-z-]+\"", unlist(text))))
  expect_identical(setdiff(sub(".*\"([a-z-]+)\".*", "\\1", links), pages), character())
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
