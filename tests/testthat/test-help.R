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
    # One such part, and a check as CRAN's runs all examples of the package twice.
    expect_false(has_tag(pages[[name]], "\\donttest"), info = name)
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
  # A student's word, and the pages that answer it.
  pages_of_words <- list(
    ladder = c("static_equilibrium", "supports"), bowling = c("scene_incline", "impact"),
    bicycle = c("point_motion", "precession_table", "gear_train"),
    wheel = c("scene_axle", "point_motion", "body_plates"),
    power = c("augment.rot_trajectory", "torque"), rk4 = c("trajectory", "work_precision"),
    lever = c("torque_of_force", "static_equilibrium"),
    seesaw = c("static_equilibrium", "forces"), "yo-yo" = "relatives",
    pulley = c("scene_hanging_mass", "relatives"), flywheel = c("scene_axle", "kinetic_energy"),
    skater = "inertia_knots", gyroscope = c("scene_pivot", "precession_table"),
    "spinning top" = c("scene_pivot", "precession_table"),
    "merry-go-round" = c("scene_axle", "disks", "compound"),
    pendulum = c("scene_pendulum", "scene_chain", "period_of", "fit_swing"),
    brake = c("resistance", "couplings", "stopping"), motor = c("torque", "scene_axle"),
    gear = c("gear_train", "couplings"), clutch = c("scene_clutch", "clutch_engagement"),
    rpm = c("convert_angle", "angular_motion"),
    "moment of inertia" = c("inertia_tensor", "inertia_table", "parallel_axis", "body_points"),
    "parallel axis" = c("parallel_axis", "inertia_tensor", "compound"),
    torque = c("torque", "torque_of_force", "scene_axle"),
    "angular momentum" = c("torque_of_force", "angular_impulse", "conserved"),
    conservation = c("conserved", "audit", "disks"),
    collision = c("collide", "impact", "disks", "collision_ledger"),
    rolling = c("scene_incline", "rolling_table", "rolling_functions", "roll_race"),
    friction = c("resistance", "friction_needed", "scene_incline"),
    equilibrium = "static_equilibrium", coriolis = c("to_rotating_frame", "earth_projectile"),
    "tennis racket" = c("flip_time", "scene_free", "spin_stability"),
    period = c("period_of", "scene_pendulum"), disc = "body_plates",
    ring = c("body_plates", "body_shapes"),
    "kinetic energy" = c("kinetic_energy", "energy_partition")
  )
  for (word in names(pages_of_words)) expect_contains(word, pages_of_words[[word]])
  for (name in names(pages)) {
    expect_gt(length(parts_of(pages[[name]], "\\concept")), 0, label = paste("words for", name))
  }
})

test_that("every export is used in a lesson or in an example", {
  root <- Sys.getenv("ROTDYN_ROOT", file.path("..", ".."))
  lessons <- list.files(file.path(root, "vignettes"), "[.]Rmd$", full.names = TRUE)
  skip_if(!length(lessons), "no sources of the lessons")
  chunks <- unlist(lapply(lessons, function(file) {
    lines <- readLines(file, encoding = "UTF-8")
    fence <- grepl("^```", lines)
    inside <- cumsum(fence) %% 2 == 1 & !fence
    starts <- lines[fence][cumsum(fence)[inside]]
    lines[inside][grepl("^```\\{r", starts)]
  }))
  examples <- unlist(lapply(help_pages(), parts_of, "\\examples"))
  code <- sub("^\\s*#.*", "", unlist(strsplit(c(chunks, examples), "\n")))
  matches <- function(pattern) unlist(regmatches(code, gregexpr(pattern, code, perl = TRUE)))
  called <- matches("[A-Za-z_.][A-Za-z0-9_.]*(?=\\()")
  expect_identical(setdiff(getNamespaceExports("rotdyn"), called), character())
})

test_that("the site's index has every page, once", {
  file <- file.path(Sys.getenv("ROTDYN_ROOT"), "_pkgdown.yml")
  skip_if(!file.exists(file), "the sources are not here")
  text <- paste(readLines(file), collapse = " ")
  lists <- regmatches(text, gregexpr("contents: \\[[^]]*\\]", text))[[1]]
  listed <- unlist(strsplit(gsub("contents: \\[|\\]", "", lists), ", *"))
  listed <- trimws(listed)
  expect_identical(listed[duplicated(listed)], character())
  expect_setequal(listed, sub("[.]Rd$", "", names(help_pages())))
})

test_that("every column that a page describes is in the dictionary", {
  pages <- help_pages()
  for (name in names(pages)) {
    text <- paste(unlist(pages[[name]]), collapse = "")
    expect_false(grepl("NA (NA)", text, fixed = TRUE), info = name)
  }
  expect_error(describe_columns(c("time_s", "no_column")), "no_column")
  text <- describe_columns(design_columns, design_meanings)
  for (column in design_columns) expect_match(text, paste0("code{", column, "}"), fixed = TRUE)
})
