# Are the pages whole? Each chunk of a vignette that prints or draws must have done so in its page.
# Prints counts for each page and what is missing, then `lessons: N passed, N failed`.
#
#   Rscript tools/lessons.R VIGNETTES PAGES     folders of the sources and of the pages

folders <- commandArgs(TRUE)

chunks_of <- function(lines) {
  lapply(grep("^```\\{r", lines), function(start) {
    end <- start + which(lines[-seq_len(start)] == "```")[1]
    list(head = lines[start], code = lines[seq_len(end - start - 1L) + start])
  })
}

# Whether the value of an expression is seen: no assignment, no call that returns invisibly.
is_seen <- function(one) {
  if (is.symbol(one)) return(TRUE)
  if (!is.call(one)) return(TRUE)
  name <- paste(deparse(one[[1]]), collapse = "")
  if (name == "|>") return(is_seen(one[[3]]))
  !name %in% c("<-", "=", "library", "dir.create", "invisible", "edit", "writeLines", "set.seed",
               "records_create", "records_add", "for", "write_scene", "DBI::dbDisconnect", "unlink",
               "if")
}

entities <- function(x) {
  names <- c("&" = "&amp;", "<" = "&lt;", ">" = "&gt;", "\"" = "&quot;", "'" = "&#39;")
  for (one in names(names)) x <- gsub(one, names[[one]], x, fixed = TRUE)
  x
}

passed <- failed <- 0L
for (file in list.files(folders[1], "[.]Rmd$")) {
  page <- file.path(folders[2], sub("[.]Rmd$", ".html", file))
  missing <- character()
  if (!file.exists(page)) {
    missing <- "the page"
  } else {
    html <- paste(readLines(page, encoding = "UTF-8", warn = FALSE), collapse = "\n")
    at <- 1L
    counts <- c(outputs = 0L, pictures = 0L, moving = 0L)
    for (chunk in chunks_of(readLines(file.path(folders[1], file), encoding = "UTF-8"))) {
      if (grepl("include *= *FALSE|echo *= *FALSE|eval *= *FALSE", chunk$head)) next
      first <- paste0("<code>", entities(trimws(chunk$code[nzchar(chunk$code)][1], "right")))
      found <- regexpr(first, substring(html, at), fixed = TRUE)
      if (found < 0L) {
        missing <- c(missing, paste("code:", chunk$code[1]))
        next
      }
      at <- at + found + nchar(first) - 1L
      # What follows until the next text: the rest of the code, its output, its pictures.
      after <- substring(html, at)
      stop <- regexpr("\n<(p|h2|h3|ul|ol|table|details|/details|/section)[ >]", after)
      after <- if (stop > 0L) substr(after, 1L, stop) else after
      whole <- paste(c(chunk$head, chunk$code), collapse = "\n")
      draws <- grepl("fig.alt|ggplot\\(|autoplot\\(", whole)
      if (any(grepl("animate_motion(", chunk$code, fixed = TRUE))) {
        ok <- grepl("rotdyn-film", after, fixed = TRUE)
        counts["moving"] <- counts["moving"] + ok
        if (!ok) missing <- c(missing, paste("moving picture:", chunk$code[1]))
      } else if (draws) {
        ok <- grepl("<svg class=\"pic\"|<img ", after)
        counts["pictures"] <- counts["pictures"] + ok
        if (!ok) missing <- c(missing, paste("picture:", chunk$code[1]))
      } else {
        code <- parse(text = chunk$code, keep.source = FALSE)
        if (!any(vapply(as.list(code), is_seen, NA))) next
        ok <- grepl("#&gt;", after, fixed = TRUE)
        counts["outputs"] <- counts["outputs"] + ok
        if (!ok) missing <- c(missing, paste("output:", chunk$code[1]))
      }
    }
    cat(sprintf("%-34s %3d outputs %3d pictures %2d moving\n", sub("[.]Rmd$", "", file),
                counts[1], counts[2], counts[3]))
  }
  if (length(missing)) cat(paste0("  missing ", missing, "\n"), sep = "")
  passed <- passed + !length(missing)
  failed <- failed + !!length(missing)
}
cat("lessons: ", passed, " passed, ", failed, " failed\n", sep = "")
quit(status = failed > 0L)
