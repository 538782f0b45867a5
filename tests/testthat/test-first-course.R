# Fifty questions of a first-year course (OpenStax, University Physics 1, chapters 10 and 11), in
# first-course.csv. A row: the call that somebody who knows how names are made types first, without
# help (`first`); the call after its message (`second`); where the answer is read in the result x
# (`read`); the answer by hand (`formula`, with g; `expected`), its relative tolerance; what became
# of it (`outcome`), and what became of the first call when the list was written (`before`).
#
# Outcomes: "at once"; "after the message" (an error, a warning or a message led to `second`);
# "no answer"; "wrong": another number, and nothing was said.
questions <- function() {
  utils::read.csv(test_path("first-course.csv"), colClasses = c(section = "character"))
}

# list(x, said: conditions that were shown); x is NULL after an error. As typed in a new session.
typed <- function(call) {
  said <- character()
  hear <- function(restart) function(condition) {
    said <<- c(said, cli::ansi_strip(conditionMessage(condition)))
    invokeRestart(restart)
  }
  x <- tryCatch(
    withCallingHandlers(
      eval(parse(text = call), new.env(parent = globalenv())),
      message = hear("muffleMessage"), warning = hear("muffleWarning")
    ),
    error = function(e) {
      said <<- c(said, cli::ansi_strip(conditionMessage(e)))
      NULL
    }
  )
  list(x = x, said = said)
}

# "answer", "none" (there is no such number in the result), "other".
judged <- function(x, row) {
  value <- if (!is.null(x)) suppressWarnings(tryCatch(
    eval(parse(text = row$read), list(x = x), asNamespace("rotdyn")), error = function(e) NULL
  ))
  if (!is.numeric(value) || length(value) != 1L || !is.finite(value)) return("none")
  right <- abs(value - row$expected) <= row$tolerance * abs(row$expected)
  if (right) "answer" else "other"
}

outcome_of <- function(row) {
  first <- typed(row$first)
  found <- judged(first$x, row)
  if (!length(first$said)) {
    return(switch(found, answer = "at once", none = "no answer", other = "wrong"))
  }
  if (!nzchar(row$second)) return(if (found == "answer") "at once" else "no answer")
  second <- typed(row$second)
  found <- judged(second$x, row)
  if (found == "answer") return("after the message")
  if (found == "other" && !length(second$said)) "wrong" else "no answer"
}

test_that("the expected answers are those of the formulas", {
  rows <- questions()
  expect_equal(nrow(rows), 50)
  sections <- c(paste0("10.", 1:8), paste0("11.", 1:4))
  expect_setequal(rows$section, sections)
  expect_gte(min(table(rows$section)), 3)
  by_hand <- vapply(rows$formula, function(formula) {
    eval(parse(text = formula), list(g = 9.80665))
  }, 0)
  expect_equal(unname(by_hand), rows$expected, tolerance = 1e-9)
})

test_that("at least 45 of the questions are answered, and none is silently wrong", {
  rows <- questions()
  found <- vapply(seq_len(nrow(rows)), function(i) outcome_of(rows[i, ]), "")
  for (i in seq_along(found)) expect_identical(found[i], rows$outcome[i], info = rows$first[i])
  expect_gte(sum(found %in% c("at once", "after the message")), 45)
  expect_false("wrong" %in% found)
})
