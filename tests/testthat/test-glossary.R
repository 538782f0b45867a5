# The table "Words of the code" in CONTRIBUTING.md, held against the sources beside it.

project_file <- function(...) {
  path <- file.path(Sys.getenv("ROTDYN_ROOT", "no such folder"), ...)
  if (!file.exists(path)) skip("no sources")
  path
}

# word, whether comments count, and the file names (without ending) where it may stand.
glossary <- function() {
  lines <- readLines(project_file("CONTRIBUTING.md"), encoding = "UTF-8")
  from <- match("| gone | say | stays where |", lines)
  rows <- lines[-seq_len(from + 1L)]
  cells <- strsplit(rows[seq_len(match(FALSE, startsWith(rows, "|")) - 1L)], "|", fixed = TRUE)
  do.call(rbind, lapply(cells, function(row) {
    words <- trimws(strsplit(sub("\\*", "", row[2], fixed = TRUE), ",")[[1]])
    stays <- if (length(row) < 4L) "" else row[4]
    data.frame(
      word = words, everywhere = grepl("*", row[2], fixed = TRUE), in_r = grepl("R:", stays),
      stays = I(rep(list(regmatches(stays, gregexpr("(?<=`)[^`]+(?=`)", stays, perl = TRUE))[[1]]),
                    length(words)))
    )
  }))
}

# Names in code (parts of them), and words of the whole text.
words_of <- function(file) {
  text <- paste(readLines(file, encoding = "UTF-8"), collapse = "\n")
  aside <- if (grepl("[.]R$", file)) {
    "#[^\n]*|\"(\\\\.|[^\"\\\\])*\"|'(\\\\.|[^'\\\\])*'"
  } else {
    "(?s)/\\*.*?\\*/|\"(\\\\.|[^\"\\\\])*\""
  }
  parts <- function(x) tolower(unlist(strsplit(x, "[^A-Za-z]+")))
  code <- gsub(aside, " ", text, perl = TRUE)
  names <- regmatches(code, gregexpr("[A-Za-z_.][A-Za-z0-9_.]*", code))[[1]]
  names <- names[!grepl("^(at_(most|least)|[a-z_]*least_squares|impact_least_0)$", names)]
  list(names = unique(parts(names)), all = unique(parts(text)))
}

standing_words <- function(files, glossary) {
  found <- character()
  for (file in files) {
    has <- words_of(file)
    short <- sub(".*/((src|R)/)", "\\1", file)
    for (i in seq_len(nrow(glossary))) {
      row <- glossary[i, ]
      if (row$in_r && grepl("[.]R$", file)) next
      if (any(vapply(row$stays[[1]], grepl, NA, x = short, fixed = TRUE))) next
      if (row$word %in% if (row$everywhere) has$all else has$names) {
        found <- c(found, paste0(basename(file), ": ", row$word))
      }
    }
  }
  found
}

test_that("words of the glossary are gone from the code", {
  table <- glossary()
  expect_gte(nrow(table), 20L)
  files <- c(
    list.files(project_file("src"), "[.][ch]$", full.names = TRUE, recursive = TRUE),
    list.files(project_file("R"), "[.]R$", full.names = TRUE)
  )
  expect_gt(length(files), 400L)
  expect_equal(standing_words(files, table), character())
})

test_that("a word that came back is found", {
  table <- glossary()
  file <- function(ending, text) {
    path <- tempfile(fileext = ending)
    writeLines(text, path)
    path
  }
  expect_length(standing_words(file(".c", "int rot_march_on;"), table), 1L)
  expect_length(standing_words(file(".c", "int n; /* up to the wall */"), table), 1L)
  expect_length(standing_words(file(".c", "int n; /* a way */"), table), 0L)
  expect_length(standing_words(file(".R", "max_grip <- 1 # at most"), table), 1L)
  expect_length(standing_words(file(".R", "at_most <- \"grip\""), table), 0L)
})
