# The pages of the site: Rscript tools/site.R FOLDER [ARTICLES]. Formulas become MathML by pandoc.

arguments <- commandArgs(trailingOnly = TRUE)
site <- arguments[1]
only <- if (length(arguments) > 1 && nzchar(arguments[2])) strsplit(arguments[2], " ")[[1]]
options(pkgdown.internet = FALSE)
# Pages with examples are made in another folder, where a relative path leads nowhere.
templates <- normalizePath(file.path("tools", "site"))
pkg <- pkgdown::as_pkgdown(
  ".", override = list(destination = site, template = list(path = templates))
)
pkgdown::init_site(pkg)
pkgdown::build_home(pkg, preview = FALSE)
pkgdown::build_reference(pkg, lazy = FALSE, preview = FALSE, devel = FALSE,
                         examples = is.null(only))
pkgdown::build_news(pkg, preview = FALSE)
if (is.null(only)) {
  pkgdown::build_articles(pkg, preview = FALSE)
} else {
  for (name in only) pkgdown::build_article(name, pkg, quiet = TRUE)
  pkgdown::build_articles_index(pkg)
}
pkgdown::build_search(pkg)
# Sections without text have entries that are empty.
index <- file.path(site, "search.json")
entries <- Filter(function(entry) length(entry$title), jsonlite::read_json(index))
jsonlite::write_json(entries, index, auto_unbox = TRUE)

# ---- a lab in each lesson with a motion ----------------------------------------------------------

# tools/site/labs.csv: articles, and their scenes of web/scenes; one script for all.
folder <- file.path(site, "deps", "lab")
dir.create(folder, recursive = TRUE, showWarnings = FALSE)
script <- rotdyn:::lab_dependency()
invisible(file.copy(file.path(script$src$file, script$script), folder, overwrite = TRUE))
labs <- utils::read.csv(file.path("tools", "site", "labs.csv"))
for (i in seq_len(nrow(labs))) {
  page <- file.path(site, "articles", paste0(labs$article[i], ".html"))
  if (!file.exists(page)) next
  listed <- jsonlite::read_json(file.path("web", "scenes", paste0(labs$scene[i], ".json")))
  text <- function(x) jsonlite::toJSON(x, auto_unbox = TRUE, digits = NA, null = "null")
  attribute <- function(x) {
    gsub("'", "&#39;", gsub("&", "&amp;", text(x), fixed = TRUE), fixed = TRUE)
  }
  element <- c(
    "<div class=\"section level2\"><h2 id=\"try-it\">Try it</h2>",
    "<p>The numbers of this scene can be moved; the page computes.</p>",
    sprintf(
      "<rotdyn-lab scene='%s' settings='%s'></rotdyn-lab></div>", attribute(listed$scene),
      attribute(c(listed$settings, list(title = listed$title$en)))
    ),
    "<script src=\"../deps/lab/rotdyn-lab.js\"></script>"
  )
  lines <- readLines(page, encoding = "UTF-8", warn = FALSE)
  at <- grep("</main>", lines, fixed = TRUE)[1]
  stopifnot(!is.na(at))
  lines[at] <- sub(
    "</main>", paste0(paste(element, collapse = "\n"), "\n</main>"), lines[at], fixed = TRUE
  )
  writeLines(lines, page, useBytes = TRUE)
}

# ---- formulas ------------------------------------------------------------------------------------

# \( ... \), \[ ... \] and $$ ... $$ of a text.
formula <- paste0(
  "\\$\\$[^$]*\\$\\$|\\\\\\((?:[^\\\\]|\\\\(?!\\)))*\\\\\\)|",
  "\\\\\\[(?:[^\\\\]|\\\\(?!\\]))*\\\\\\]"
)
files <- list.files(site, "[.]html$", recursive = TRUE, full.names = TRUE)
files <- files[!startsWith(files, file.path(site, "lab"))]
read <- function(file) paste(readLines(file, encoding = "UTF-8", warn = FALSE), collapse = "\n")
texts <- vapply(files, read, "")
found <- unique(unlist(regmatches(texts, gregexpr(formula, texts, perl = TRUE))))
if (length(found)) {
  plain <- gsub("&amp;", "&", gsub("&lt;", "<", gsub("&gt;", ">", found)))
  inner <- gsub("\n", " ", substr(plain, 3, nchar(plain) - 2))
  # What pandoc does not know.
  inner <- gsub("\\Bigl", "\\left", gsub("\\Bigr", "\\right", inner, fixed = TRUE),
                fixed = TRUE)
  display <- !startsWith(plain, "\\(")
  mark <- ifelse(display, "$$", "$")
  source <- tempfile(fileext = ".md")
  writeLines(paste0("::: x\n\n", mark, trimws(inner), mark, "\n\n:::\n"), source, useBytes = TRUE)
  made <- tempfile(fileext = ".html")
  system2("pandoc", c("-f", "markdown", "-t", "html", "--mathml", source, "-o", made))
  out <- regmatches(read(made), gregexpr("<math.*?</math>", read(made), perl = TRUE))[[1]]
  stopifnot(length(out) == length(found))
  for (i in seq_along(files)) {
    at <- gregexpr(formula, texts[i], perl = TRUE)
    if (at[[1]][1] < 0) next
    regmatches(texts[i], at) <- list(out[match(regmatches(texts[i], at)[[1]], found)])
    writeLines(texts[i], files[i], useBytes = TRUE)
  }
}
cat("formulas:", length(found), "\n")
