# Rscript tools/check-spelling.R [write]: spells DESCRIPTION, help pages, README, NEWS and the
# lessons with aspell, where it is installed. inst/WORDLIST has the words of the field; `write` adds
# what is unknown to it: read the diff. The last line is `spelling: N passed, N failed, N skipped`.

if (!nzchar(Sys.which("aspell"))) {
  cat("skip - aspell is not installed\nspelling: 0 passed, 0 failed, 1 skipped\n")
  quit()
}
list_file <- "inst/WORDLIST"
known <- if (file.exists(list_file)) readLines(list_file) else character()

spelled <- function(files, filter) {
  found <- utils::aspell(files, filter, program = "aspell",
                         control = c("--master=en_GB", "-d en_GB"))
  unique(found$Original)
}
# Code, mathematics, links and their targets are no words.
plain_of <- function(path) {
  lines <- readLines(path, encoding = "UTF-8", warn = FALSE)
  fenced <- cumsum(grepl("^ *```", lines)) %% 2 == 1 | grepl("^ *```", lines)
  head <- grepl("[.]Rmd$", path) & cumsum(lines == "---") < 2
  lines <- lines[!fenced & !head]
  lines <- gsub("`[^`]*`", " ", lines)
  lines <- gsub("\\$[^$]*\\$", " ", lines)
  lines <- gsub("\\]\\([^)]*\\)|<[^>]*>|https?://[^ )]*|\\{[^}]*\\}", " ", lines)
  file <- tempfile(fileext = ".txt")
  writeLines(lines, file)
  file
}
texts <- c("README.md", "NEWS.md", list.files("vignettes", "[.]Rmd$", full.names = TRUE))
unknown <- c(
  spelled("DESCRIPTION", "dcf"),
  spelled(list.files("man", "[.]Rd$", full.names = TRUE), "Rd"),
  spelled(vapply(texts, plain_of, ""), NULL)
)
unknown <- sort(unique(setdiff(unknown, known)), method = "radix")
if ("write" %in% commandArgs(TRUE)) {
  writeLines(sort(unique(c(known, unknown)), method = "radix"), list_file)
  cat(length(unknown), "words added to", list_file, "\n")
  quit()
}
for (word in unknown) cat("not ok - not in the dictionary or inst/WORDLIST:", word, "\n")
cat(sprintf("spelling: %d passed, %d failed, 0 skipped\n", as.integer(!length(unknown)),
            length(unknown)))
quit(status = length(unknown) > 0L)
