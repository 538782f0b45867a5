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
