# The help pages: what each one has, and the words by which they are found.

help_pages <- function() {
  folder <- file.path(Sys.getenv("ROTDYN_ROOT", file.path("..", "..")), "man")
  if (!dir.exists(folder)) return(tools::Rd_db("rotdyn"))
  files <- list.files(folder, "[.]Rd$", full.names = TRUE)
  stats::setNames(lapply(files, tools::parse_Rd), basename(files))
}

# The text of the parts of a page with a tag, at its top level.
parts_of <- function(page, tag) {
  tags <- vapply(page, function(part) attr(part, "Rd_tag"), "")
  vapply(page[tags == tag], function(part) paste(unlist(part), collapse = ""), "")
}

# A tag anywhere in a page.
has_tag <- function(part, tag) {
  identical(attr(part, "Rd_tag"), tag) ||
    (is.list(part) && any(vapply(part, has_tag, NA, tag)))
}

test_that("every page has a See Also, and examples that run something", {
  pages <- help_pages()
  expect_gt(length(pages), 50)
  for (name in names(pages)) {
    expect_true(any(nzchar(trimws(parts_of(pages[[name]], "\\seealso")))), info = name)
    if (name == "rotdyn-package.Rd") next
    examples <- parts_of(pages[[name]], "\\examples")
    code <- trimws(sub("#.*", "", unlist(strsplit(examples, "\n"))))
    expect_gt(sum(nzchar(code)), 0)
  }
})

test_that("no description ends in the middle of a sentence", {
  pages <- help_pages()
  for (name in names(pages)) {
    for (tag in c("\\description", "\\details")) {
      text <- trimws(parts_of(pages[[name]], tag))
      expect_false(
        any(grepl("(\\b(the|of|and|with|an?|is|are|by|where|while)|,)$", text)),
        info = paste(name, tag)
      )
    }
  }
})

test_that("the equations of motion are set as equations", {
  pages <- help_pages()
  needed <- c(
    "scene_axle", "scene_pendulum", "scene_rotors", "scene_clutch", "scene_drive", "gear_train",
    "scene_hanging_mass", "scene_incline", "inertia_knots", "resistance", "stopping", "period_of",
    "clutch_engagement", "energy_partition", "rolling_table", "angular_motion", "inertia_tensor",
    "parallel_axis", "audit", "torque_of_force"
  )
  for (name in paste0(needed, ".Rd")) {
    expect_true(any(vapply(pages[[name]], has_tag, NA, "\\deqn")), info = name)
  }
})

# What help.search() looks through: aliases, titles, concepts.
test_that("the words that people look for lead to the pages", {
  pages <- help_pages()
  words <- lapply(pages, function(page) {
    tolower(c(parts_of(page, "\\alias"), parts_of(page, "\\title"), parts_of(page, "\\concept")))
  })
  found <- function(word) sub("[.]Rd$", "", names(pages)[vapply(words, function(w) {
    any(grepl(word, w, fixed = TRUE))
  }, NA)])
  expect_contains <- function(word, page) {
    expect_true(all(page %in% found(word)), info = paste(word, "->", toString(found(word))))
  }
  expect_contains("period", c("period_of", "scene_pendulum"))
  expect_contains("brake", c("resistance", "couplings", "stopping"))
  expect_contains("disc", "body_plates")
  expect_contains("ring", c("body_plates", "body_shapes"))
  expect_contains("flywheel", "scene_axle")
  expect_contains("moment", c("inertia_tensor", "inertia_table"))
})
