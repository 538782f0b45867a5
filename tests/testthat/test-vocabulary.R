# The rules of names in the interface. naming_faults() judges one function, so that wrong ones can
# be tried as well as the exports.

exports <- function() {
  names <- sort(getNamespaceExports("rotdyn"))
  names[vapply(names, function(name) is.function(get(name, asNamespace("rotdyn"))), NA)]
}
# Generics of another package have its arguments.
functions <- function() {
  mget(setdiff(exports(), c("augment", "glance")), asNamespace("rotdyn"))
}
arguments_of <- function(functions) lapply(functions, function(f) names(formals(f)))

units_of_names <- c(
  "m", "m2", "kg", "s", "kg_m2_per_s", "rad", "deg", "n", "j", "w", "n_m", "n_s", "n_m_s",
  "n_m_s2", "kg_m", "kg_m2", "kg_m3", "rad_per_s", "rad_per_s2", "m_per_s", "m_per_s2", "per_s",
  "n_s_per_m", "n_s2_per_m2", "n_per_m", "n_m_per_rad", "hz", "px", "u", "rpm", "turns",
  "deg_per_s", "w_per_kg", "per_rad"
)
# The longest unit that a name ends with, or "".
unit_of_name <- function(names) {
  vapply(names, function(name) {
    fits <- units_of_names[endsWith(name, paste0("_", units_of_names))]
    if (length(fits)) fits[which.max(nchar(fits))] else ""
  }, "", USE.NAMES = FALSE)
}
# "omega" of omega0_rad_per_s and of omega_2_rad_per_s.
quantity_of_name <- function(names) {
  stem <- substr(names, 1, nchar(names) - nchar(unit_of_name(names)) - 1L)
  sub("(_[0-9]+|0)$", "", stem)
}
# Quantities in two units: of files in the unit of the instrument, of laws with coefficients of
# several kinds, of ranges in space and in time.
several_units <- list(
  amplitude = c("n_m", "rad"), angle = c("deg", "rad"), damping = c("n_m_s", "per_s"),
  drag = c("n_s2_per_m2", "n_s_per_m"), east = c("m", "m_per_s"), north = c("m", "m_per_s"),
  from = c("m", "s"), to = c("m", "s"), lean = c("deg", "rad_per_s"),
  omega = c("deg_per_s", "rad_per_s", "rpm"), rest = c("rad", "s"),
  theta = c("deg", "rad", "turns"), width = c("m", "px")
)
constants <- list(
  gravity_m_per_s2 = 9.80665, rotation_rad_per_s = 7.292115e-5, start_s = 0, threads = 1, seed = 1
)
words <- function() utils::read.csv("argument-words.csv", comment.char = "#")$argument
tidyverse_names <- function() utils::read.csv("tidyverse-names.csv", na.strings = "")
# Those that take anything: numbers, bodies, records, laws by name.
takes_anything <- c(
  "forces", "join_bodies", "uncertainty_budget", "compare_runs", "time_when", "design_grid",
  "design_random", "design_latin", "design_sobol", "design_saltelli"
)
old_words <- c(
  "omega1_rad_per_s", "omega2_rad_per_s", "theta1_rad", "theta2_rad", "torque_1", "torque_2",
  "inertia_1_kg_m2", "inertia_2_kg_m2", "force_breaks_s", "joint_n_m_s", "objects", "disk_1"
)

# An index without its place: omega1_rad_per_s, torque_n_m_2.
misplaced_index <- function(names) {
  with_index <- grep("[0-9]", sub(
    paste0("_(", paste(units_of_names, collapse = "|"), ")$"), "", names
  ), value = TRUE)
  unit <- unit_of_name(with_index)
  quantity <- ifelse(nzchar(unit), substr(with_index, 1, nchar(with_index) - nchar(unit) - 1L),
                     with_index)
  ends <- grepl("(^|_)[a-z]+0(_[a-z0-9]+)*$|_[0-9]+$|_[0-9]+_[a-z_]+$|^[a-z]+_[0-9]$", quantity)
  late <- grepl(paste0("_(", paste(units_of_names, collapse = "|"), ")_[0-9]+$"), with_index)
  with_index[!ends | late]
}

# Units of the arguments of functions, by quantity.
units_in_use <- function(functions) {
  names <- unique(unlist(arguments_of(functions)))
  unit <- unit_of_name(names)
  names <- names[nzchar(unit)]
  lapply(split(unit[nzchar(unit)], quantity_of_name(names)), unique)
}

# What is wrong with an exported function, one text for each fault.
naming_faults <- function(name, f, in_use = units_in_use(functions())) {
  faults <- character()
  fault <- function(bad, text) if (any(bad)) faults <<- c(faults, text)
  fault(!grepl("^[a-z][a-z0-9]*(_[a-z0-9]+)*$", name), "a name that is not lower_case")
  hidden <- tidyverse_names()
  fault(name %in% hidden$name, paste("hides", hidden$package[match(name, hidden$name)]))
  patterns <- utils::glob2rx(read_table("reference")$functions)
  places <- sum(vapply(patterns, grepl, NA, name))
  fault(places != 1L, paste(places, "places in the reference index"))

  arguments <- setdiff(names(formals(f)), "...")
  unit <- unit_of_name(arguments)
  unknown <- arguments[!nzchar(unit) & !sub("_[0-9]$", "", arguments) %in% words()]
  fault(length(unknown), paste("no unit, or a word that is not in use:", toString(unknown)))
  index <- misplaced_index(arguments)
  fault(length(index), paste("an index that is not before the unit:", toString(index)))
  fault(arguments %in% old_words, "an old word")
  quantity <- quantity_of_name(arguments)
  for (one in unique(quantity[nzchar(unit)])) {
    units <- unique(c(unit[nzchar(unit) & quantity == one], in_use[[one]]))
    fault(length(setdiff(units, several_units[[one]] %||% units[1])),
          paste(one, "in several units:", toString(units)))
  }
  for (one in intersect(names(constants), arguments)) {
    value <- as.list(formals(f))[one]
    fault(is.numeric(value[[1]]) && value[[1]] != constants[[one]], paste("a default of", one))
  }

  needed <- vapply(formals(f), function(x) identical(x, quote(expr = )), NA)
  before <- names(formals(f))[cumsum(names(formals(f)) == "...") == 0L]
  first_optional <- match(FALSE, needed[before], nomatch = length(before) + 1L)
  late <- before[seq_along(before) > first_optional & needed[before]]
  # The length of the wires, or instead of it the height, which stands behind.
  fault(length(late) && !name %in% c("inertia_bifilar", "inertia_trifilar"),
        paste("required after optional:", toString(late)))
  worked_on <- intersect(c("scene", "con", "x", "fit", "record"), before[needed[before]])
  fault(length(worked_on) && !before[1] %in% worked_on, "the thing worked on is not the first")
  fault(length(arguments) && !"..." %in% names(formals(f)), "no dots")
  generic <- any(grepl("UseMethod", deparse(body(f))))
  if ("..." %in% names(formals(f)) && !name %in% takes_anything && !generic) {
    error <- tryCatch(f(colour_of_it = 1), error = identity)
    said <- inherits(error, "rotdyn_error_argument") &&
      grepl("colour_of_it", conditionMessage(error), fixed = TRUE)
    fault(!said, "a mistyped argument is not refused")
  }
  faults
}

test_that("every export keeps the rules of names", {
  all_functions <- functions()
  in_use <- units_in_use(all_functions)
  for (name in names(all_functions)) {
    expect_identical(naming_faults(name, all_functions[[name]], in_use), character(), info = name)
  }
})

test_that("a wrong export is noticed, whatever is wrong with it", {
  checked <- function(f) {
    body(f) <- quote(rotdyn:::check_no_dots(...))
    f
  }
  tried <- function(name, f) naming_faults(name, checked(f))
  expect_identical(tried("torque_constant", function(torque_n_m, ...) 1), character())
  for (one in list(
    list("filter", function(x, ...) 1, "hides dplyr"),
    list("fct_count", function(x, ...) 1, "hides forcats"),
    list("fill", function(x, ...) 1, "hides tidyr"),
    list("read_table", function(file, ...) 1, "hides readr"),
    list("period", function(scene, ...) 1, "hides lubridate"),
    list("who", function(scene, ...) 1, "hides tidyr"),
    list("bodyDisk", function(body, ...) 1, "lower_case"),
    list("wheel_turn", function(body, ...) 1, "0 places"),
    list("body_odd", function(mass, ...) 1, "no unit.*mass"),
    list("body_odd", function(radius_cm, ...) 1, "no unit.*radius_cm"),
    list("body_odd", function(time_ms, ...) 1, "no unit.*time_ms"),
    list("body_odd", function(omega2_rad_per_s, ...) 1, "index.*omega2"),
    list("body_odd", function(mass_kg_2, ...) 1, "index.*mass_kg_2"),
    list("body_odd", function(length_deg, ...) 1, "length in several units"),
    list("body_odd", function(mass_n, ...) 1, "mass in several units"),
    list("body_odd", function(body, ..., gravity_m_per_s2 = 9.81) 1, "default of gravity"),
    list("body_odd", function(time_s, scene, ...) 1, "not the first"),
    list("body_odd", function(level = 1, body, ...) 1, "required after optional"),
    list("body_odd", function(objects, ...) 1, "old word")
  )) {
    expect_match(paste(tried(one[[1]], one[[2]]), collapse = "; "), one[[3]], info = one[[3]])
  }
  expect_match(naming_faults("body_odd", function(body) body), "no dots", all = FALSE)
  expect_match(naming_faults("body_odd", function(body, ...) 1), "not refused", all = FALSE)
})

test_that("nothing hides what is attached: the tidyverse as installed, and R", {
  for (package in c(
    unique(tidyverse_names()$package), "base", "stats", "utils", "graphics", "grDevices",
    "methods", "datasets"
  )) {
    # lubridate asks the system for its time zone.
    if (!suppressWarnings(requireNamespace(package, quietly = TRUE))) next
    theirs <- if (package == "base") ls(baseenv()) else getNamespaceExports(package)
    if (package == "datasets") theirs <- ls("package:datasets")
    same <- Filter(function(name) {
      !identical(get(name, asNamespace("rotdyn")), getExportedValue(package, name))
    }, intersect(getNamespaceExports("rotdyn"), theirs))
    expect_identical(same, character(), info = package)
  }
  # Those that are not installed here, and data sets: the names of CRAN's versions of November 2026
  # and of those before.
  packages <- table(tidyverse_names()$package)
  expect_setequal(names(packages), c(
    "dplyr", "forcats", "ggplot2", "lubridate", "purrr", "readr", "stringr", "tibble", "tidyr"
  ))
  expect_true(all(packages > 35))
  generics <- c("augment", "glance")
  expect_identical(
    intersect(getNamespaceExports("rotdyn"), setdiff(tidyverse_names()$name, generics)),
    character()
  )
  # Names that were theirs.
  never <- c("when", "rerun", "cross", "lift", "interval", "duration", "second", "force")
  expect_identical(intersect(exports(), never), character())
})

test_that("every export has one place in the reference index", {
  table <- reference_table()
  expect_setequal(table$name, getNamespaceExports("rotdyn"))
  expect_identical(anyDuplicated(table$name), 0L)
  listed <- utils::read.csv(system.file("metadata", "reference.csv", package = "rotdyn"))
  listed <- listed[!grepl("*", listed$functions, fixed = TRUE), ]
  expect_identical(table$section[match(listed$functions, table$name)], listed$section)
  # In the help of the package: a line for each section, with a link to each function.
  lines <- strsplit(reference_index(), "\n", fixed = TRUE)[[1]]
  lines <- lines[startsWith(lines, "\\item{")]
  expect_identical(length(lines), length(unique(table$section)))
  links <- regmatches(lines, gregexpr("(?<=\\\\link[{])[^}]+", lines, perl = TRUE))
  expect_identical(unlist(links), table$name)
  expect_identical(lengths(links), as.integer(table(factor(table$section, unique(table$section)))))
  expect_true(all(startsWith(lines, paste0("\\item{", sentence(unique(table$section)), "}{"))))
})

test_that("columns have their index before the unit", {
  # Elements of a matrix; a logarithm.
  expect_setequal(
    misplaced_index(metadata()$quantities$quantity), c("r11", "log10_smoothness")
  )
})

test_that("every word of an argument has one meaning, and is in use", {
  meanings <- utils::read.csv("argument-words.csv", comment.char = "#")
  expect_identical(anyDuplicated(meanings$argument), 0L)
  expect_identical(anyDuplicated(meanings$meaning), 0L)
  expect_true(all(nzchar(meanings$meaning)))
  expect_setequal(
    meanings$argument[grepl(";", meanings$meaning)], c("first", "order", "rows", "second", "y")
  )
  used <- unique(unlist(arguments_of(functions())))
  expect_identical(setdiff(meanings$argument, used), character())
})

test_that("scenes have the same words", {
  scenes <- functions()
  scenes <- scenes[grepl("^scene_(?!hash|code)", names(scenes), perl = TRUE)]
  terms <- setdiff(names(resistance_terms), "damping_n_m_s")
  for (name in names(scenes)) {
    arguments <- names(formals(scenes[[name]]))
    expect_identical(
      intersect(arguments, c(terms, "breaks_s", "force_n", "torque_n_m")), character(), info = name
    )
    expect_true("start_s" %in% arguments, info = name)
  }
})

test_that("verbs refuse what they do not know, too", {
  motion <- spin_up(time_s = 0:2)
  for (verb in list(
    audit, augment, glance, conserved, motion_events, summary, stats::predict, inertia_repairs
  )) {
    error <- expect_error(verb(motion, colour_of_it = 1), class = "rotdyn_error_argument")
    expect_match(conditionMessage(error), "colour_of_it")
  }
  fit <- structure(list(), class = "rot_coast_fit")
  expect_error(as_scene(fit, colour_of_it = 1), "colour_of_it", class = "rotdyn_error_argument")
})
