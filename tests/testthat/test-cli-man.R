verbs <- rotdyn:::cli_verbs()
names(verbs) <- vapply(verbs, `[[`, "", "name")

test_that("every verb has a page with all that its help says", {
  plain <- function(lines) gsub("\\e", "\\", gsub("\\-", "-", lines, fixed = TRUE), fixed = TRUE)
  for (verb in verbs) {
    said <- cli("man", verb$name)
    expect_identical(said$status, 0L)
    page <- plain(said$out)
    expect_match(page[1], paste0("^.TH ROTDYN-", toupper(verb$name), " 1 "))
    said <- rotdyn:::cli_option_texts(rotdyn:::cli_options_of(verb))
    at <- match(paste(".B", said$name), page)
    expect_false(anyNA(at), info = verb$name)
    expect_identical(page[at + 1L], unname(said$help))
    expect_true(all(verb$example %in% page), info = verb$name)
    expect_true(all(verb$help[-1] %in% page), info = verb$name)
    expect_identical(".SH DESCRIPTION" %in% page, length(verb$help) > 1L)
    expect_true(all(paste(".B", rotdyn:::cli_status) %in% page))
  }
})

test_that("the overview lists the verbs, and unknown ones are refused", {
  page <- cli("man")$out
  for (name in names(verbs)) {
    expect_true(any(grepl(paste0("rotdyn\\-", gsub("-", "\\-", name, fixed = TRUE), " (1)"), page,
                          fixed = TRUE)), info = name)
  }
  expect_identical(cli("man", "rol")$status, 2L)
})

test_that("text of any kind is shown unchanged", {
  expect_identical(rotdyn:::roff(c(".a", "'b", "c-d", "e\\f", "plain.")),
                   c("\\&.a", "\\&'b", "c\\-d", "e\\ef", "plain."))
})

test_that("man renders the pages without a warning", {
  skip_if(!nzchar(Sys.which("groff")), "groff is not installed")
  file <- tempfile(fileext = ".1")
  on.exit(unlink(file))
  for (name in list(NULL, "trajectory", "sweep", "batch", "metadata")) {
    writeLines(cli("man", name)$out, file)
    said <- suppressWarnings(system2(
      "groff", c("-man", "-Tascii", "-ww", "-z", file), stdout = TRUE, stderr = TRUE
    ))
    expect_identical(as.character(said), character(), info = name)
  }
})
