# Metadata: what the package knows of itself (models, effects, shapes, columns), and the tables of
# inst/metadata.

#' Metadata: units, constants, models and what they assume
#'
#' All that can be said of the numbers of this package, as tables with keys. The same tables are in
#' the databases of [records_create()]. With `dialect` or `file` they are an SQL script: tables,
#' rows and views, for those without R.
#'
#' An **assumption** says how it is enforced: `"refused"`: [choose_model()] refuses a scene that
#' breaks it, such as the `counterexample` (text for [read_scene()]), with a reason that has the
#' words in `names`; `"dropped"`: the effect is left out only where a bound on what that changes is
#' below the accuracy asked; `"warned"`; or `"stated"`, by words alone.
#'
#' @param ... Not used; names after it must be given in full.
#' @param dialect `"sqlite"`, `"postgresql"` or `"duckdb"`: an SQL script for that database.
#' @param file Name of a file to which the script is written (SQLite's where no dialect is given).
#' @return A named list of tibbles. Every table has its key first:
#'   * `sources`, `units`, `constants` (with standard uncertainty), `conventions` (axis, sign, unit,
#'     order, frame, time), `concepts`, `relations`;
#'   * `quantities`: all columns that functions of the package return, with unit and meaning;
#'   * `constraints`, `effects`, `models` (of [models()]), `model_effects`: the effects that each
#'     model takes;
#'   * `assumptions`, `model_assumptions`: which model makes which;
#'   * `shapes` (of [shapes()]), `shape_names`: names and formulas of publications;
#'   * `programs`: published computations; `cases`: their cases, with text for [read_scene()] where
#'     there is a scene; `case_values`: given and published values.
#'
#'   With `dialect` or `file`: the script, one text, invisibly if it is written to a file.
#' @section Errors: `rotdyn_error_value` for an unknown dialect, `rotdyn_error_type`,
#'   `rotdyn_error_file`.
#' @source The article "Rotational Dynamics, Torque, and Angular Momentum" for the programs, and for
#'   the concepts, relations and cases that are in its data model.
#' @seealso [models()], [shapes()], [records_create()].
#' @concept dictionary
#' @concept units
#' @concept assumption
#' @examples
#' known <- metadata()
#' names(known)
#' known$constants
#' subset(known$assumptions, enforced == "refused")[c("constraint_kind", "statement")]
#' known$quantities
#' substr(metadata(dialect = "duckdb"), 1, 200)
#' @export
metadata <- function(..., dialect = NULL, file = NULL) {
  call <- check_no_dots(...)
  if (!is.null(dialect) || !is.null(file)) {
    return(metadata_sql(file, dialect %||% "sqlite", call))
  }
  if (is.null(registry_texts$metadata)) registry_texts$metadata <- build_metadata()
  registry_texts$metadata
}

# Types, missing values, ranges, keys and references of all rows, without a database, as a database
# checks them. Returns x.
check_metadata <- function(x = metadata(), call = rlang::caller_env()) {
  if (!is.list(x) || is.object(x) || is.null(names(x))) {
    abort_rotdyn(c(
      "{.arg x} must be a named list of tables, as {.fn metadata} gives them.",
      x = "It is {describe_value(x)}."
    ), "type", call)
  }
  faults <- schema_faults(x, all_tables())
  if (nrow(faults)) {
    shown <- utils::head(faults, 5L)
    lines <- sprintf(
      "%s%s: %s", shown$table, ifelse(is.na(shown$row), "", paste(", row", shown$row)), shown$fault
    )
    abort_rotdyn(c(
      "The metadata {cli::qty(nrow(faults))}{?has a fault/have {nrow(faults)} faults}.",
      stats::setNames(gsub("([{}])", "\\1\\1", lines), rep("x", length(lines)))
    ), "metadata", call, faults = faults)
  }
  invisible(x)
}

build_metadata <- function() {
  tables <- metadata_tables()
  known <- lapply(list(
    sources = "sources", units = "units", constants = "constants", conventions = "conventions",
    concepts = "concepts", relations = "relations", programs = "programs",
    shape_names = "shape_names", cases = "cases", case_values = "case_values"
  ), function(name) read_table(name, tables[[name]]))
  known$case_values <- rbind(given_values(), known$case_values)
  columns <- column_table()
  known$quantities <- as_table(
    quantity = columns$name, unit = ifelse(nzchar(columns$unit), columns$unit, NA),
    meaning = columns$meaning
  )
  own <- all_constraints()
  words <- read_table("constraint_concepts")
  ids <- vapply(own, function(constraint) constraint$id, "", USE.NAMES = FALSE)
  at <- match(ids, words$constraint_kind)
  known$constraints <- as_table(
    constraint_kind = ids, concept = words$concept[at],
    meaning = ifelse(is.na(at), ids, words$meaning[at])
  )
  effects <- lapply(own, function(constraint) constraint$effects)
  known$effects <- as_table(
    constraint_kind = rep(ids, lengths(effects)),
    effect = unlist(lapply(effects, names), FALSE, FALSE),
    meaning = unlist(effects, FALSE, FALSE)
  )
  models <- models()
  models <- models[models$constraint %in% ids, ]
  known$models <- as_table(
    model = models$model, constraint_kind = models$constraint, equations = models$equations,
    assumptions = models$assumptions, limits = models$limits, requires = models$requires,
    error = models$error, error_kind = models$error_kind,
    source = cited_source(models$source, known$sources), cited = models$source
  )
  takes <- unlist(lapply(own, function(constraint) {
    lapply(constraint$models, function(model) as.character(model$handles))
  }), FALSE, FALSE)
  known$model_effects <- as_table(
    model = rep(models$model, lengths(takes)),
    constraint_kind = rep(models$constraint, lengths(takes)), effect = as.character(unlist(takes))
  )
  shapes <- shapes()
  known$shapes <- new_table(c(
    as.list(shapes)[c(
      "shape", "constructor", "dimension", "sizes", "ixx_formula", "iyy_formula", "izz_formula",
      "beta_formula", "origin", "axis", "formula"
    )],
    list(source = cited_source(shapes$source, known$sources), cited = shapes$source)
  ), nrow = nrow(shapes))
  known <- c(known, assumption_tables(known, tables))
  known[names(tables)]
}

# A table of inst/metadata: empty is missing. `table` says the types; the others are text.
read_table <- function(name, table = NULL) {
  file <- system.file("metadata", paste0(name, ".csv"), package = "rotdyn", mustWork = TRUE)
  rows <- utils::read.csv(
    file, colClasses = "character", na.strings = "", encoding = "UTF-8", check.names = FALSE
  )
  for (column in names(table$columns)) {
    type <- table$columns[[column]]$type
    if (type != "text") {
      convert <- if (type == "real") as.double else as.integer
      rows[[column]] <- convert(rows[[column]])
    }
  }
  table_from(rows)
}

# What is given of the article's cases: the data of the examples.
given_values <- function() {
  long <- function(file, cases, columns) {
    path <- system.file("extdata", file, package = "rotdyn", mustWork = TRUE)
    rows <- utils::read.csv(path)
    cases <- cases %||% rows$object
    parts <- lapply(names(columns), function(column) as_table(
      model_case = cases, quantity = columns[[column]], at_s = 0, role = "given",
      value = as.double(rows[[column]]), tolerance = 0, place = NA_integer_, note = NA_character_
    ))
    do.call(rbind, parts)
  }
  rolling <- c("beta", "mass_kg", "radius_m", "height_drop_m", "incline_angle_deg")
  rbind(
    long("rolling_cases.csv", NULL, stats::setNames(rolling, rolling)),
    long(
      "gyroscope_cases.csv", c("small_fast_rotor", "medium_rotor", "slow_heavy_rotor"),
      c(
        mass_kg = "mass_kg", lever_arm_m = "lever_arm_m",
        moment_of_inertia_kg_m2 = "moment_of_inertia_kg_m2", spin_rad_per_s = "omega_rad_per_s"
      )
    )
  )
}

# The source that a text cites first; by definition where it cites none.
cited_source <- function(texts, sources) {
  cited <- sources[!is.na(sources$cited_as), ]
  vapply(texts, function(text) {
    at <- vapply(cited$cited_as, function(word) regexpr(word, text, fixed = TRUE)[1], 1L)
    if (all(at < 0)) "definition" else cited$source[at > 0][which.min(at[at > 0])]
  }, "", USE.NAMES = FALSE)
}

# An assumption for each effect that some model of a constraint does not take, those that models()
# says in words, and those of inst/metadata/assumptions.csv.
assumption_tables <- function(known, tables) {
  given <- read_table("assumptions", tables$assumptions)
  takes <- paste(known$model_effects$model, known$model_effects$effect)
  models_of <- function(constraint) known$models$model[known$models$constraint_kind == constraint]
  without <- function(constraint, effect) {
    models <- models_of(constraint)
    models[!paste(models, effect) %in% takes]
  }
  examples <- read_table("counterexamples")
  at <- match(
    paste(known$effects$constraint_kind, known$effects$effect),
    paste(examples$constraint_kind, examples$effect)
  )
  missed <- Map(without, known$effects$constraint_kind, known$effects$effect)
  use <- which(lengths(missed) > 0L)
  effects <- known$effects[use, ]
  at <- at[use]
  what <- sub("^an? ", "", effects$meaning)
  refused <- as_table(
    assumption = paste0(effects$constraint_kind, "_no_", effects$effect), place = NA_integer_,
    program = NA_character_, constraint_kind = effects$constraint_kind,
    kind = ifelse(is.na(at), "load", examples$kind[at]), statement = paste0("No ", what, "."),
    enforced = ifelse(is.na(at), "stated", "refused"), effect = effects$effect,
    names = ifelse(is.na(at), NA, ifelse(is.na(examples$names[at]), what, examples$names[at])),
    counterexample = examples$scene[at]
  )
  words <- strsplit(known$models$assumptions, "; ", fixed = TRUE)
  of <- rep(known$models$constraint_kind, lengths(words))
  said <- unlist(words)
  key <- paste0(of, "_", gsub("[^a-z]+", "_", tolower(said)))
  first <- !duplicated(key)
  stated <- as_table(
    assumption = key[first], place = NA_integer_, program = NA_character_,
    constraint_kind = of[first], kind = kind_of_words(said[first]),
    statement = paste0(sentence(said[first]), "."), enforced = "stated", effect = NA_character_,
    names = NA_character_, counterexample = NA_character_
  )
  # What a counterexample breaks, too.
  enforced <- read_table("said")
  at <- match(enforced$assumption, stated$assumption)
  stated[at, c("names", "counterexample")] <- enforced[c("names", "counterexample")]
  stated$enforced[at] <- "refused"
  assumptions <- rbind(given, refused, stated)
  assumptions$place <- seq_len(nrow(assumptions))
  # Those of the file: of all models of the constraint, or of those without the effect.
  of_file <- Map(function(constraint, effect, enforced) {
    if (is.na(constraint)) return(character())
    if (is.na(effect)) models_of(constraint) else without(constraint, effect)
  }, given$constraint_kind, given$effect, given$enforced)
  rows <- c(stats::setNames(of_file, given$assumption),
            stats::setNames(missed[use], refused$assumption))
  links <- as_table(
    model = c(as.character(unlist(rows)), rep(known$models$model, lengths(words))),
    assumption = c(rep(names(rows), lengths(rows)), key)
  )
  list(assumptions = assumptions, model_assumptions = unique(links))
}

kind_of_words <- function(words) {
  kinds <- c(
    rigidity = "rigid (body|bodies|rotors|round)|twist|spring", load = "torque|gravity|acts",
    resistance = "damping|resistance|friction", contact = "gears|capacity|plane|backlash",
    mass = "centre of mass|inertia"
  )
  out <- rep("size", length(words))
  for (kind in rev(names(kinds))) out[grepl(kinds[[kind]], words)] <- kind
  out
}
