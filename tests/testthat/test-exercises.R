# The exercises of inst/exercises: their files, what they draw, and the sets that are written.

source_lines <- function(file) readLines(file, encoding = "UTF-8")

# One drawing, without the package exams: list(env, text: the whole file with its numbers).
drawn_exercise <- function(file, seed) {
  lines <- source_lines(file)
  end <- which(lines == "```")[1]
  env <- new.env(parent = globalenv())
  set.seed(seed)
  eval(parse(text = lines[seq(2, end - 1)], keep.source = FALSE), env)
  text <- paste(lines[-seq_len(end)], collapse = "\n")
  at <- gregexpr("`r [^`]+`", text)
  regmatches(text, at) <- lapply(regmatches(text, at), function(found) {
    vapply(found, function(code) {
      value <- eval(parse(text = gsub("^`r |`$", "", code), keep.source = FALSE), env)
      stopifnot(length(value) == 1L, !is.na(value))
      as.character(value)
    }, "")
  })
  list(env = env, text = text)
}

# What is wrong with a drawing: character(0) if nothing is.
faults_of <- function(one, kind) {
  asked <- one$env$asked
  words <- sub("\nMeta-information\n.*", "", one$text)
  faults <- c(
    unfinished = grepl("`r |NULL|NaN|\\bNA\\b|\\bInf\\b", words),
    digits = grepl("[0-9][.][0-9]{7}", words)
  )
  if (!is.null(asked$value)) {
    faults <- c(faults,
      finite = !is.finite(asked$value),
      range = !(asked$value >= asked$range[1] && asked$value <= asked$range[2]),
      by_hand = !(abs(asked$value - asked$by_hand) <= asked$within / 100 * abs(asked$value)),
      error = !(asked$error <= asked$within / 100)
    )
  }
  if (kind == "num") {
    meta <- sub(".*\nexsolution: ([^\n]*)\nextol: ([^\n]*)\n?$", "\\1 \\2", one$text)
    meta <- as.double(strsplit(meta, " ")[[1]])
    faults <- c(faults,
      solution = !isTRUE(all.equal(meta[1], asked$value, tolerance = 1e-10)),
      tolerance = !isTRUE(all.equal(meta[2], asked$within * abs(asked$value), tolerance = 1e-9)),
      # Canvas rounds answers to four places.
      places = abs(asked$value) < 1e-2,
      stated = !grepl("to within [12]&nbsp;%[.]", words)
    )
  } else {
    faults <- c(faults,
      four = length(asked$text) != 4L, distinct = anyDuplicated(asked$text) > 0L,
      apart = !is.null(asked$values) && !one$env$apart(asked$values),
      # A platform that takes the number with its tolerance takes no wrong option.
      wrong = !is.null(asked$values) &&
        any(abs(asked$values[-1] - asked$value) <=
          asked$within * (abs(asked$values[-1]) + abs(asked$value)))
    )
  }
  names(faults)[faults]
}

test_that("there are exercises for every section and every lesson", {
  all <- exercises()
  expect_gte(nrow(all), 60)
  expect_setequal(all$section, exercise_sections)
  expect_identical(unique(all$section), exercise_sections)
  expect_gte(min(table(all$section)), 3)
  expect_identical(setdiff(names(all), column_table()$name), character())
  expect_false(anyNA(all[c("name", "kind", "title", "section", "topic", "file")]))
  expect_identical(anyDuplicated(all$name), 0L)
  expect_identical(anyDuplicated(all$title), 0L)
  expect_identical(paste0(all$name, ".Rmd"), basename(all$file))
  expect_setequal(all$kind, c("num", "schoice"))
  folder <- file.path(Sys.getenv("ROTDYN_ROOT", file.path("..", "..")), "vignettes")
  if (!dir.exists(folder)) folder <- system.file("doc", package = "rotdyn")
  pages <- list.files(folder, "[.]Rmd$", full.names = TRUE)
  skip_if(!length(pages), "no vignettes")
  name <- function(file) sub("[.]Rmd$", "", basename(file))
  expect_identical(setdiff(stats::na.omit(all$lesson), name(pages)), character())
  is_lesson <- function(file) any(grepl('^title: "[0-9]+ Lesson', source_lines(file)))
  lessons <- name(Filter(is_lesson, pages))
  expect_gt(length(lessons), 20L)
  few <- lessons[vapply(lessons, function(lesson) sum(all$lesson %in% lesson) < 2L, NA)]
  expect_identical(few, character())
})

test_that("the list can be narrowed", {
  expect_identical(unique(exercises("rolling")$section), "rolling")
  expect_setequal(exercises(lesson = c("gears", "brake"))$lesson, c("gears", "brake"))
  expect_error(exercises("cooking"), class = "rotdyn_error_value")
  expect_error(exercises(1), class = "rotdyn_error_value")
  expect_error(exercises("rolling", lesson = "gears"), class = "rotdyn_error_value")
  expect_error(exercises(lessons = "gears"), class = "rotdyn_error_argument")
})

test_that("the files have their parts, in plain characters and short lines", {
  for (file in exercises()$file) {
    lines <- source_lines(file)
    expect_identical(lines[1], "```{r draw, include = FALSE}", info = basename(file))
    for (part in c("Question", "Solution", "Meta-information")) {
      expect_identical(sum(lines == part), 1L, info = basename(file))
    }
    expect_false(any(grepl("[^ -~]", lines)), info = basename(file))
    expect_lte(max(nchar(lines)), 130)
    # A drawing that is not used is left over from a change.
    code <- seq(2, which(lines == "```")[1] - 1)
    assigned <- "^ *([A-Za-z_0-9]+) <- .*"
    made <- sub(assigned, "\\1", grep(assigned, lines[code], value = TRUE))
    used <- vapply(unique(made), function(name) {
      length(unlist(gregexpr(paste0("\\b", name, "\\b"), paste(lines, collapse = "\n")))) > 1L
    }, NA)
    expect_identical(names(used)[!used], character(), info = basename(file))
    # Symbols of the field may be names of R's functions, other names not.
    hidden <- setdiff(intersect(made, ls(baseenv())), c("beta", "kappa", "q"))
    expect_identical(hidden, character(), info = basename(file))
  }
})

test_that("every drawing gives a finite answer in range that agrees with the formula", {
  all <- exercises()
  draws <- or_long(2L, 200L)
  for (i in seq_len(nrow(all))) {
    for (seed in seq_len(draws)) {
      one <- drawn_exercise(all$file[i], seed)
      expect_identical(
        faults_of(one, all$kind[i]), character(), info = paste(all$name[i], "seed", seed)
      )
    }
  }
})

test_that("drawings differ, and a seed gives the same one again", {
  all <- exercises()
  for (file in all$file[seq(1, nrow(all), by = or_long(7L, 1L))]) {
    texts <- vapply(1:6, function(seed) drawn_exercise(file, seed)$text, "")
    expect_gt(length(unique(texts)), 2)
    expect_identical(drawn_exercise(file, 1)$text, texts[1])
  }
})

test_that("a wrong drawing is noticed", {
  file <- exercises()$file[exercises()$name == "rim-speed"]
  one <- drawn_exercise(file, 1)
  expect_identical(faults_of(one, "schoice"), character())
  changed <- function(...) {
    env <- list2env(as.list(one$env))
    env$asked <- utils::modifyList(env$asked, list(...))
    faults_of(list(env = env, text = one$text), "schoice")
  }
  expect_identical(changed(value = 1e3), c("range", "by_hand"))
  expect_identical(changed(error = 1e-3), "error")
  expect_identical(changed(values = c(1, 1.01, 2, 3)), "apart")
  expect_identical(changed(text = c("a", "a", "b", "c")), "distinct")
})

test_that("numbers are drawn and written as the helpers promise", {
  helpers <- new.env()
  sys.source(system.file("exercises", "helpers.R", package = "rotdyn"), helpers)
  set.seed(1)
  expect_setequal(replicate(200, helpers$draw(0.1, 0.4, 0.1)), c(0.1, 0.2, 0.3, 0.4))
  expect_identical(helpers$say(2.5, "kg m^2"), "2.5&nbsp;kg&nbsp;m^2^")
  expect_identical(helpers$say(-0.0000123456), "$-1.23$&nbsp;&times;&nbsp;10^-5^")
  expect_identical(helpers$say(123456, "J"), "1.23&nbsp;&times;&nbsp;10^5^&nbsp;J")
  expect_identical(helpers$tex(1 / 3, "rad/s^2"), "0.333\\,\\mathrm{rad/s^2}")
  expect_identical(helpers$tex(30, "deg"), "30^\\circ")
  expect_identical(helpers$tex(5e-5), "5 \\cdot 10^{-5}")
  expect_identical(helpers$plain(123456789), "123456789")
  expect_true(helpers$apart(c(1, 2, 3)))
  expect_false(helpers$apart(c(1, 2, 1.05)))
})

# ---- sets ------------------------------------------------------------------------------------

need_writers <- function() {
  skip_if_not_installed("exams")
  skip_if_not_installed("xml2")
  skip_if(!rmarkdown::pandoc_available(), "no pandoc")
}

new_folder <- function() {
  folder <- tempfile("set")
  dir.create(folder)
  folder
}

few <- c("rim-speed", "seesaw-balance", "possible-moments", "slip-heat")

test_that("a Moodle set parses and has the answers of its key", {
  need_writers()
  folder <- new_folder()
  names <- or_long(few, exercises()$name)
  before <- get0(".Random.seed", globalenv())
  key <- write_exercises(names, folder, to = "moodle", n = 2, seed = 5)
  expect_identical(get0(".Random.seed", globalenv()), before)
  expect_identical(nrow(key), 2L * length(names))
  expect_identical(setdiff(names(key), column_table()$name), character())
  xml <- xml2::read_xml(file.path(folder, "exercises.xml"))
  questions <- xml2::xml_find_all(xml, "//question[@type='numerical' or @type='multichoice']")
  expect_length(questions, nrow(key))
  numerical <- xml2::xml_find_all(xml, "//question[@type='numerical']")
  answers <- as.double(xml2::xml_text(xml2::xml_find_first(numerical, "./answer/text")))
  tolerances <- as.double(xml2::xml_text(xml2::xml_find_first(numerical, "./answer/tolerance")))
  expect_equal(sort(answers), sort(as.double(key$answer[key$kind == "num"])), tolerance = 1e-9)
  expect_equal(sort(tolerances), sort(key$tolerance[key$kind == "num"]), tolerance = 1e-9)
  expect_true(all(nzchar(xml2::xml_text(xml2::xml_find_all(questions, "./generalfeedback/text")))))
  written <- utils::read.csv(file.path(folder, "exercises-key.csv"), colClasses = "character")
  expect_identical(written$answer, key$answer)
})

test_that("a Canvas set parses and has a question for each exercise", {
  need_writers()
  folder <- new_folder()
  names <- or_long(few, exercises()$name)
  key <- write_exercises(names, folder, to = "canvas", seed = 5, name = "week-3")
  expect_true(file.exists(file.path(folder, "week-3.zip")))
  utils::unzip(file.path(folder, "week-3.zip"), exdir = folder)
  files <- list.files(folder, "[.]xml$", recursive = TRUE, full.names = TRUE)
  expect_true("imsmanifest.xml" %in% basename(files))
  pages <- lapply(files, xml2::read_xml)
  items <- unlist(lapply(pages, function(page) {
    xml2::xml_name(xml2::xml_find_all(page, "//*[local-name()='item']"))
  }))
  expect_length(items, nrow(key))
  # Numbers: the limits that are accepted, in the order of the questions.
  quiz <- pages[[which(vapply(pages, xml2::xml_name, "") == "questestinterop")]]
  numbers <- function(tag) {
    as.double(xml2::xml_text(xml2::xml_find_all(quiz, paste0("//*[local-name()='", tag, "']"))))
  }
  asked <- key[key$kind == "num", ]
  value <- as.double(asked$answer)
  expect_equal(numbers("vargte"), value - asked$tolerance, tolerance = 1e-9)
  expect_equal(numbers("varlte"), value + asked$tolerance, tolerance = 1e-9)
  expect_true(all(abs(value) >= 1e-2))
})

test_that("pages hold the questions, and the solutions beside them", {
  need_writers()
  folder <- new_folder()
  key <- write_exercises(exercises()[exercises()$name %in% few, ], folder, n = 2, seed = 5)
  expect_setequal(list.files(folder), c(
    "exercises1.html", "exercises2.html", "exercises-solutions1.html",
    "exercises-solutions2.html", "exercises-key.csv"
  ))
  page <- xml2::read_html(file.path(folder, "exercises1.html"))
  solved <- xml2::read_html(file.path(folder, "exercises-solutions1.html"))
  count <- function(page, what) length(xml2::xml_find_all(page, what))
  expect_identical(count(page, "//h4"), 0L)
  expect_identical(count(solved, "//h4"), 4L)
  expect_gt(count(solved, "//*[local-name()='math']"), 4)
  expect_identical(count(solved, "//script"), 0L)
  expect_match(xml2::xml_text(solved), "parallel|second moments")
  # The questions of both pages have the same numbers.
  expect_true(startsWith(xml2::xml_text(xml2::xml_find_first(solved, "//ol/li/p")), "A wheel"))
  expect_identical(
    xml2::xml_text(xml2::xml_find_first(page, "//ol/li/p")),
    xml2::xml_text(xml2::xml_find_first(solved, "//ol/li/p"))
  )
})

test_that("one seed draws one set, whatever it is written for", {
  need_writers()
  pages <- write_exercises(few, new_folder(), n = 2, seed = 5)
  bank <- write_exercises(few, new_folder(), to = "moodle", n = 2, seed = 5)
  expect_identical(bank$answer, pages$answer)
  other <- write_exercises(few, new_folder(), to = "moodle", n = 2, seed = 6)
  expect_false(any(other$answer == bank$answer))
  expect_false(any(bank$answer[bank$version == 1] == bank$answer[bank$version == 2]))
})

test_that("what cannot be written is refused by class", {
  folder <- new_folder()
  refused <- function(class, ...) {
    expect_error(write_exercises(...), class = paste0("rotdyn_error_", class))
  }
  refused("missing", few)
  refused("value", "no-such-exercise", folder)
  refused("value", character(), folder)
  refused("type", 3, folder)
  refused("type", few, 3)
  refused("value", few, folder, to = "word")
  refused("value", few, folder, n = 0)
  refused("value", few, folder, n = 1.5)
  refused("value", few, folder, seed = -1)
  refused("value", few, folder, seed = 0.5)
  refused("value", few, folder, name = "a/b")
  refused("argument", few, folder, format = "html")
})

test_that("a missing package, pandoc or LaTeX is named", {
  if (!requireNamespace("exams", quietly = TRUE)) {
    expect_error(write_exercises(few, new_folder()), "exams", class = "rotdyn_error_package")
  } else if (!rmarkdown::pandoc_available() || !nzchar(Sys.which("pdflatex"))) {
    expect_error(
      write_exercises(few, new_folder(), to = "pdf"), "LaTeX|pandoc", class = "rotdyn_error_package"
    )
  } else {
    folder <- new_folder()
    write_exercises(few, folder, to = "pdf")
    pages <- list.files(folder, "[.]pdf$", full.names = TRUE)
    expect_identical(basename(pages), c("exercises-solutions1.pdf", "exercises1.pdf"))
    expect_gt(file.size(pages[1]), file.size(pages[2]))
  }
  expect_error(need_program("LaTeX", "A set", quote(f())), "LaTeX", class = "rotdyn_error_package")
})

test_that("options are written as plain text in the key", {
  expect_identical(plain_of_html("2.5\u00a0kg\u00a0m<sup>2</sup>"), "2.5 kg m^2")
  expect_identical(plain_of_html("\u22121.2&nbsp;\u00d7 10<sup>-4</sup>"), "-1.2 x 10^-4")
})
