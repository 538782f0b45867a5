# The rules of names in the interface.

exports <- function() {
  names <- sort(getNamespaceExports("rotdyn"))
  names[vapply(names, function(name) is.function(get(name, asNamespace("rotdyn"))), NA)]
}
# Generics of other packages have their arguments.
own <- function() {
  setdiff(exports(), c("augment", "glance", "audit", "as_scene", "conserved", "motion_events"))
}
arguments_by_function <- function() {
  lapply(stats::setNames(own(), own()), function(name) {
    formals(get(name, asNamespace("rotdyn")))
  })
}

test_that("nothing hides a function of the tidyverse or of base R", {
  for (package in c(
    "dplyr", "ggplot2", "tibble", "purrr", "lubridate", "stringr", "tidyr", "readr", "forcats",
    "base", "stats", "utils", "graphics"
  )) {
    # lubridate asks the system for its time zone.
    if (!suppressWarnings(requireNamespace(package, quietly = TRUE))) next
    same <- intersect(exports(), getNamespaceExports(package))
    same <- Filter(function(name) {
      !identical(get(name, asNamespace("rotdyn")), getExportedValue(package, name))
    }, same)
    expect_identical(same, character(), info = package)
  }
  # Those that are not installed here: names of tidyr, readr and forcats that could be ours.
  never <- c(
    "fill", "nest", "pack", "chop", "complete", "expand", "separate", "unite", "spread", "gather",
    "spec", "period", "when", "rerun", "interval", "duration", "cross", "detect", "keep", "map",
    "accumulate", "every", "some", "none", "pluck", "lift", "transpose", "date", "second", "force"
  )
  expect_identical(intersect(exports(), never), character())
})

test_that("every export has one place in the reference index", {
  table <- reference_table()
  expect_setequal(table$name, getNamespaceExports("rotdyn"))
  expect_identical(anyDuplicated(table$name), 0L)
})

test_that("an index stands before the unit, and units are those of the dictionary", {
  known <- c(
    "m", "m2", "kg", "s", "kg_m2_per_s", "rad", "deg", "n", "j", "w", "n_m", "n_s", "n_m_s",
    "n_m_s2", "kg_m", "kg_m2", "kg_m3", "rad_per_s", "rad_per_s2", "m_per_s", "m_per_s2", "per_s",
    "n_s_per_m", "n_s2_per_m2", "n_per_m", "n_m_per_rad", "hz", "px", "u", "rpm", "turns",
    "deg_per_s"
  )
  is_unit <- paste0("_(", paste(known, collapse = "|"), ")$")
  columns <- metadata()$quantities$quantity
  named <- unique(c(unlist(lapply(arguments_by_function(), names)), columns))
  # omega1_rad_per_s, torque_n_m_2: a number elsewhere than between the quantity and its unit.
  with_index <- grep("[0-9]", sub(is_unit, "", named), value = TRUE)
  quantity <- sub(is_unit, "", with_index)
  ends <- grepl("(^|_)[a-z]+0(_[a-z0-9]+)*$|_[0-9]+$|_[0-9]+_[a-z_]+$|^[a-z]+_[0-9]$", quantity)
  # Elements of a matrix; a logarithm.
  expect_setequal(with_index[!ends], c("r11", "log10_smoothness"))
})

# The words of arguments without a unit in their name, with their one meaning.
words <- c(
  "scene", "body", "bodies", "x", "data", "file", "con", "motion", "record", "records", "fit",
  "torque", "force", "resistance", "brake", "couplings", "rotors", "ratios", "ratio", "efficiency",
  "restitution", "friction", "static_friction", "kinetic_friction", "attitude0", "attitude",
  "accuracy", "model", "max_steps", "on_fail", "axis", "through", "level", "seed", "draws", "name",
  "threads", "parameters"
)
test_that("old words are gone", {
  all <- unlist(lapply(arguments_by_function(), names))
  old <- c(
    "omega1_rad_per_s", "omega2_rad_per_s", "theta1_rad", "theta2_rad", "torque_1", "torque_2",
    "inertia_1_kg_m2", "inertia_2_kg_m2", "force_breaks_s", "joint_n_m_s", "objects", "disk_1"
  )
  expect_identical(intersect(all, old), character())
  expect_true(all(words %in% all))
  scenes <- arguments_by_function()[grep("^scene_", own(), value = TRUE)]
  scenes$scene_hash <- NULL
  for (name in names(scenes)) {
    terms <- setdiff(names(resistance_terms), "damping_n_m_s")
    expect_identical(
      intersect(names(scenes[[name]]), c(terms, "breaks_s", "force_n", "torque_n_m")), character(),
      info = name
    )
    expect_true("start_s" %in% names(scenes[[name]]), info = name)
  }
})

test_that("what is required comes first, and the dots are there and checked", {
  for (name in own()) {
    arguments <- arguments_by_function()[[name]]
    needed <- vapply(arguments, function(x) identical(x, quote(expr = )), NA)
    if (!length(arguments)) next
    before <- names(arguments)[cumsum(names(arguments) == "...") == 0L]
    # Required, then optional, then dots.
    first_optional <- match(FALSE, needed[before], nomatch = length(before) + 1L)
    late <- before[seq_along(before) > first_optional & needed[before]]
    # The length of the wires, or instead of it the height, which stands behind.
    if (!name %in% c("inertia_bifilar", "inertia_trifilar")) {
      expect_identical(late, before[0], info = name)
    }
    takes_dots <- "..." %in% names(arguments)
    expect_true(takes_dots || name == "inertia_repairs", info = name)
  }
})

test_that("a mistyped argument is refused by every function with dots of its own", {
  # Those that take anything: numbers, bodies, records, laws by name.
  open <- c(
    "forces", "join_bodies", "uncertainty_budget", "compare_runs", "time_when", "update"
  )
  for (name in setdiff(own(), open)) {
    f <- get(name, asNamespace("rotdyn"))
    if (!"..." %in% names(formals(f))) next
    error <- tryCatch(f(colour_of_it = 1), error = identity)
    expect_s3_class(error, "rotdyn_error_argument")
    expect_match(conditionMessage(error), "colour_of_it", info = name)
  }
})
