# Writes inst/doc/index.html: the vignettes in the order of the numbers in their titles.
# Without it R makes an index in the order of file names; browseVignettes() orders by title.
#
#   Rscript tools/vignette-index.R

files <- list.files("vignettes", "[.]Rmd$", full.names = TRUE)
titles <- vapply(files, function(file) {
  lines <- readLines(file, encoding = "UTF-8")
  sub('^title: "(.*)"$', "\\1", grep("^title: ", lines, value = TRUE)[1])
}, "")
files <- files[order(titles, method = "radix")]
titles <- sort(titles, method = "radix")
pages <- sub("[.]Rmd$", ".html", basename(files))

dir.create(file.path("inst", "doc"), showWarnings = FALSE)
writeLines(c(
  "<!DOCTYPE html>", "<html lang=\"en\">", "<head>", "<meta charset=\"utf-8\">",
  "<title>rotdyn: lessons and articles</title>",
  "<link rel=\"stylesheet\" type=\"text/css\" href=\"../../../doc/html/R.css\">", "</head>",
  "<body>", "<h2>rotdyn: lessons and articles</h2>",
  "<p>The pages are there if the package was built with its vignettes.</p>", "<ul>",
  sprintf("<li><a href=\"%s\">%s</a></li>", pages, titles), "</ul>", "</body>", "</html>"
), file.path("inst", "doc", "index.html"))
