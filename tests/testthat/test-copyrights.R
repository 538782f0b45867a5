# inst/COPYRIGHTS: paragraphs of file names, their holders and licence.
copyrights <- function() {
  as.data.frame(read.dcf(system.file("COPYRIGHTS", package = "rotdyn")))
}
listed <- function(table) {
  files <- table$Files[!is.na(table$Files)]
  unlist(strsplit(trimws(files), "[[:space:]]+"))
}

test_that("every installed file of data has a line of its own, and every line a file", {
  folders <- c("extdata", "metadata")
  here <- unlist(lapply(folders, function(folder) {
    file.path("inst", folder, list.files(system.file(folder, package = "rotdyn")))
  }))
  names <- listed(copyrights())
  expect_setequal(
    here, names[grepl("^inst/(extdata|metadata)/", names)]
  )
  # Data of the tests, too.
  data <- list.files(test_path(), "[.](csv|gz|sqlite|json)$")
  expect_setequal(file.path("tests/testthat", data),
                  names[grepl("^tests/testthat/", names)])
})

test_that("every paragraph names a holder and a licence whose text is there", {
  table <- copyrights()
  files <- table[!is.na(table$Files), ]
  expect_false(anyNA(files$Copyright))
  given <- unique(unlist(strsplit(files$License, " and ", fixed = TRUE)))
  texts <- table$License[is.na(table$Files) & !is.na(table$License)]
  expect_setequal(given, sub("\n.*", "", texts))
  # Data of others, with the authors as the record of the data names them.
  cart <- files[grepl("measured_cart", files$Files), ]
  expect_match(cart$License, "CC-BY-4.0", fixed = TRUE)
  readme <- readLines(system.file("extdata", "README.md", package = "rotdyn"))
  readme <- paste(readme, collapse = " ")
  for (author in strsplit(sub("^2021 ", "", cart$Copyright), ", ", fixed = TRUE)[[1]]) {
    expect_match(readme, author, fixed = TRUE)
  }
})

test_that("citation() names the package and its version", {
  entry <- citation("rotdyn")
  expect_match(entry$title, "rotdyn")
  expect_match(entry$note, as.character(packageVersion("rotdyn")), fixed = TRUE)
})
