# Worksheets: sheets without answers, keys with them, the numbers of write_exercises().

write_sheet <- function(..., folder = lessons_at()) with_lessons(write_worksheet(...), folder)

need_writers <- function() {
  for (package in c("exams", "knitr", "rmarkdown", "xml2")) skip_if_not_installed(package)
  skip_if(!rmarkdown::pandoc_available(), "no pandoc")
}

new_folder <- function() {
  folder <- tempfile("sheets")
  dir.create(folder)
  folder
}

read_lines <- function(...) readLines(file.path(...), encoding = "UTF-8")

test_that("a sheet has the questions, and the key the answers, with the numbers of a set", {
  need_writers()
  folder <- new_folder()
  before <- get0(".Random.seed", globalenv())
  key <- with_lessons(withVisible(write_worksheet("slip", folder, n = 2, seed = 5)))
  expect_false(key$visible)
  key <- key$value
  expect_identical(get0(".Random.seed", globalenv()), before)
  expect_setequal(
    list.files(folder), paste0("slip-", c("sheet-1", "sheet-2", "key-1", "key-2"), ".html")
  )
  set <- write_exercises(exercises(lesson = "slip"), new_folder(), to = "moodle", n = 2, seed = 5)
  expect_identical(key[names(set)], set)
  expect_identical(key$points, ifelse(key$kind == "num", 3, 2))
  expect_identical(setdiff(names(key), column_table()$name), character())
  for (version in 1:2) {
    rows <- key[key$version == version, ]
    sheet <- xml2::read_html(file.path(folder, paste0("slip-sheet-", version, ".html")))
    solved <- xml2::read_html(file.path(folder, paste0("slip-key-", version, ".html")))
    text <- function(page, at) trimws(xml2::xml_text(xml2::xml_find_all(page, at)))
    headings <- paste0(rows$number, ". ", rows$title, " (", rows$points, " points)")
    expect_identical(text(sheet, "//h2"), headings)
    expect_identical(text(solved, "//h2"), headings)
    # The same questions, with the same numbers.
    question <- "//section/p[1]"
    expect_identical(text(sheet, question), text(solved, question))
    expect_length(text(sheet, "//div[@class='space']"), nrow(rows))
    expect_no_match(xml2::xml_text(sheet), "Solution|Right[.]|accept")
    expect_match(xml2::xml_text(sheet), paste0("of\\s+", sum(rows$points)))
    expect_match(xml2::xml_text(sheet), "Say in which direction friction acts")
    expect_match(text(sheet, "//h1"), paste0("Worksheet 11: .*version ", version))
    table <- text(solved, "//td[2]")
    numbers <- rows$kind == "num"
    expect_equal(
      as.double(sub(" .*", "", table[numbers])), as.double(rows$answer[numbers]), tolerance = 1e-3
    )
    expect_identical(
      gsub("\u00a0", " ", table[!numbers]),
      paste0(rows$letter, ". ", rows$answer)[!numbers]
    )
    limits <- strsplit(sub(" [^ ]*$", "", text(solved, "//td[3]")[numbers]), " to ")
    limits <- vapply(limits, as.double, c(0, 0))
    expect_equal(
      colMeans(limits), as.double(rows$answer[numbers]), tolerance = 1e-3
    )
    expect_equal(
      limits[2, ] - limits[1, ], 2 * rows$tolerance[numbers], tolerance = 0.06
    )
  }
})

test_that("the pages are whole: no script, nothing from elsewhere, formulas in MathML", {
  need_writers()
  folder <- new_folder()
  write_sheet("kinematics", folder)
  expect_setequal(list.files(folder), c("kinematics-sheet.html", "kinematics-key.html"))
  for (name in list.files(folder)) {
    lines <- read_lines(folder, name)
    page <- xml2::read_html(file.path(folder, name))
    count <- function(what) length(xml2::xml_find_all(page, what))
    expect_identical(count("//script | //link | //iframe | //img[not(@alt)]"), 0L)
    expect_identical(count("//*[@src] | //*[@href]"), 0L)
    links <- unlist(regmatches(lines, gregexpr("(https?:|url\\()[^\"]*", lines)))
    expect_identical(setdiff(links, "http://www.w3.org/1998/Math/MathML"), character())
    expect_identical(lines[1:2], c("<!DOCTYPE html>", "<html lang=\"en\">"))
    expect_identical(count("//h1"), 1L)
    expect_identical(count("//title"), 1L)
    xml2::xml_remove(xml2::xml_find_all(page, "//*[local-name()='annotation']"))
    expect_no_match(xml2::xml_text(xml2::xml_find_first(page, "//main")), "[$^`]")
    if (grepl("key", name)) expect_gt(count("//*[local-name()='math']"), 10)
  }
})

test_that("one seed makes one sheet; Markdown has the same numbers", {
  need_writers()
  folders <- replicate(3, new_folder())
  keys <- Map(function(folder, seed) {
    write_sheet("motors", folder, seed = seed)
  }, folders, c(7, 7, 8))
  for (name in list.files(folders[1])) {
    expect_identical(read_lines(folders[1], name), read_lines(folders[2], name))
  }
  expect_false(any(keys[[3]]$answer == keys[[1]]$answer))
  text <- write_sheet("motors", folders[1], to = "markdown", seed = 7)
  expect_identical(text, keys[[1]])
  expect_true(all(file.exists(file.path(folders[1], c("motors-sheet.md", "motors-key.md")))))
  lines <- read_lines(folders[1], "motors-sheet.md")
  expect_identical(lines[1], "# Worksheet 07: a motor meets its load")
  expect_no_match(lines, "<", all = FALSE, fixed = TRUE)
})

test_that("every lesson has a worksheet", {
  need_writers()
  folder <- new_folder()
  names <- or_long(c("inertia", "eulers-step"), unique(exercises()$lesson))
  names <- intersect(names, sub("[.]Rmd$", "", list.files(lessons_at(), "[.]Rmd$")))
  for (name in names) {
    lines <- readLines(file.path(lessons_at(), paste0(name, ".Rmd")), encoding = "UTF-8")
    if (!any(grepl("^title: \"[0-9]+ Lesson", lines))) next
    key <- write_sheet(name, folder, to = "markdown")
    set <- write_exercises(exercises(lesson = name), new_folder(), to = "moodle")
    expect_identical(key[names(set)], set, info = name)
    solved <- read_lines(folder, paste0(name, "-key.md"))
    expect_identical(sum(solved == "**Solution**"), nrow(key), info = name)
  }
})

test_that("questions can be chosen, and files are not replaced", {
  need_writers()
  folder <- new_folder()
  chosen <- c("rim-speed", "slip-heat")
  key <- write_sheet("slip", folder, to = "markdown", questions = chosen)
  expect_identical(key$name, chosen)
  expect_error(
    write_sheet("slip", folder, to = "markdown"), "overwrite = TRUE", class = "rotdyn_error_file"
  )
  expect_identical(sum(grepl("^## ", read_lines(folder, "slip-sheet.md"))), 2L)
  write_sheet("slip", folder, to = "markdown", overwrite = TRUE)
  expect_identical(sum(grepl("^## ", read_lines(folder, "slip-sheet.md"))), 4L)
})

test_that("what cannot be written is refused by class", {
  folder <- new_folder()
  refused <- function(class, ...) {
    expect_error(write_sheet(...), class = paste0("rotdyn_error_", class))
  }
  refused("missing", "slip")
  refused("value", "slp", folder)
  refused("type", 3, folder)
  refused("type", "slip", 3)
  refused("value", "slip", folder, to = "pdf")
  refused("value", "slip", folder, questions = "no-such-exercise")
  refused("value", "slip", folder, questions = character())
  refused("type", "slip", folder, questions = 3)
  refused("value", "slip", folder, n = 0)
  refused("value", "slip", folder, n = 1.5)
  refused("value", "slip", folder, seed = 0.5)
  refused("type", "slip", folder, overwrite = NA)
  refused("argument", "slip", folder, format = "html")
  expect_error(
    write_sheet("slip", folder, folder = new_folder()), "no lessons", class = "rotdyn_error_file"
  )
  if (!requireNamespace("exams", quietly = TRUE)) {
    expect_error(write_sheet("slip", folder), "exams", class = "rotdyn_error_package")
  }
  expect_error(
    need_program("pandoc", "A sheet", quote(f()), "{.code to = \"markdown\"} does without."),
    "pandoc.*markdown", class = "rotdyn_error_package"
  )
})

test_that("small pieces of the pages", {
  one <- list(question = "How? Give the answer in rad/s^2^,&nbsp;to within 1&nbsp;%.")
  expect_identical(unit_asked(one), "rad/s^2^")
  expect_identical(unit_asked(list(question = c("Which?", "Give the number, to within 1 %."))), "")
  accepted <- function(value, tolerance) {
    accepted_of(1L, list(
      key = data.frame(kind = "num"),
      drawn = list(list(question = "", metainfo = list(solution = value, tolerance = tolerance)))
    ))
  }
  expect_identical(accepted(-2, 0.02), "-2.02 to -1.98")
  expect_identical(accepted(123456, 1234.56), "122221 to 124691")
  expect_identical(accepted(0.0123, 1.23e-4), "0.01218 to 0.01242")
  expect_identical(lesson_objectives(c("## Objectives", "", "* a", "", "**Before:** b")), c(
    "", "* a", ""
  ))
  expect_identical(plain_of_html("$-1.2$&nbsp;&times;&nbsp;10^-4^"), "-1.2 x 10^-4")
})
