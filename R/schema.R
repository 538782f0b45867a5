# The tables of metadata and records, described once: R checks rows by it (schema_faults()), and the
# tables of a database are made from it (table_sql()).
#
# A table: name in R, columns, key, other unique columns, rules of several columns. A column: type
# (text, integer, real), whether it may be missing, the check of its values, the table that it
# refers to (by the key there).

column <- function(type, ..., null = FALSE, check = NULL, refers = NULL) {
  check_dots_empty(...)
  list(type = type, null = null, check = check, refers = refers)
}

check_dots_empty <- function(...) if (...length()) stop("unused arguments")

text <- function(...) column("text", ...)
whole <- function(...) column("integer", ...)
decimal <- function(...) column("real", ...)
# The name of a row of another table.
key_of <- function(table, null = FALSE) text(null = null, refers = table)

# A check: `sql(name)`, `holds(x)` of values that are not missing, and a value that breaks it.
one_of <- function(...) {
  values <- c(...)
  quoted <- if (is.character(values)) paste0("'", values, "'") else values
  list(
    sql = function(name) paste0(name, " IN (", paste(quoted, collapse = ", "), ")"),
    holds = function(x) x %in% values, wrong = if (is.character(values)) "none" else 7
  )
}

between <- function(from, to) {
  list(
    sql = function(name) paste(name, "BETWEEN", from, "AND", to),
    holds = function(x) x >= from & x <= to, wrong = to + 1
  )
}

at_least <- function(from) {
  list(
    sql = function(name) paste(name, ">=", from), holds = function(x) x >= from, wrong = from - 1
  )
}

above <- function(from) {
  list(sql = function(name) paste(name, ">", from), holds = function(x) x > from, wrong = from)
}

some_text <- list(
  sql = function(name) paste0("length(", name, ") > 0"), holds = function(x) nchar(x) > 0L,
  wrong = ""
)

of_length <- function(n) {
  list(
    sql = function(name) paste0("length(", name, ") = ", n), holds = function(x) nchar(x) == n,
    wrong = "short"
  )
}

# `%` for any text, `_` for a character.
like <- function(...) {
  patterns <- c(...)
  regex <- utils::glob2rx(gsub("%", "*", gsub("_", "?", patterns)))
  list(
    sql = function(name) paste0(name, " LIKE '", patterns, "'", collapse = " OR "),
    holds = function(x) Reduce(`|`, lapply(regex, grepl, x)), wrong = "zz"
  )
}

json_like <- like("{%")
time_like <- like("____-__-__T__:__:__Z")
flag_check <- one_of(0, 1)
name_text <- text(check = some_text)

# A rule of several columns: SQL, the same in R of the table's columns, and values that break it.
rule <- function(sql, holds, wrong) list(sql = sql, holds = holds, wrong = wrong)

# `by_key`: SQLite keeps the rows by the key, without an index beside them.
db_table <- function(sql, key, columns, unique = list(), rules = list(), by_key = FALSE) {
  list(sql = sql, key = key, columns = columns, unique = unique, rules = rules, by_key = by_key)
}

# In an order in which every table refers to itself or to those before it.
metadata_tables <- function() {
  list(
    sources = db_table("rot_source", "source", list(
      source = name_text, place = whole(check = at_least(1)), title = name_text,
      organization = name_text, primary_role = name_text,
      role = text(check = one_of("mechanics", "numerics", "units", "data", "course", "software")),
      link = text(null = TRUE, check = like("https://%", "doi:%", "isbn:%")),
      cited_as = text(null = TRUE)
    ), unique = list("place")),
    units = db_table("rot_unit", "unit", list(
      unit = name_text, place = whole(null = TRUE, check = at_least(1)), name = name_text,
      in_base = name_text, kilogram = whole(check = between(-4, 4)),
      metre = whole(check = between(-8, 8)), second = whole(check = between(-8, 8)),
      angle = whole(check = between(-4, 4)), si_factor = decimal(check = above(0)),
      note = text(null = TRUE)
    ), unique = list("name")),
    quantities = db_table("rot_quantity", "quantity", list(
      quantity = name_text, unit = key_of("units", null = TRUE), meaning = name_text
    )),
    constants = db_table("rot_constant", "constant", list(
      constant = name_text, place = whole(check = at_least(1)), symbol = name_text,
      value = decimal(),
      unit = key_of("units"), exact = whole(check = flag_check),
      standard_uncertainty = decimal(check = at_least(0)), source = key_of("sources"),
      note = text(null = TRUE)
    ), unique = list("place"), rules = list(rule(
      "exact = 0 OR standard_uncertainty = 0",
      function(x) x$exact == 0 | x$standard_uncertainty == 0,
      list(exact = 1L, standard_uncertainty = 1)
    ))),
    conventions = db_table("rot_convention", "convention", list(
      convention = name_text,
      kind = text(check = one_of("axis", "sign", "unit", "order", "frame", "time")),
      statement = name_text
    )),
    concepts = db_table("rot_concept", "concept", list(
      concept = name_text, place = whole(check = at_least(1)), primary_use = name_text,
      key_quantity = text(null = TRUE), limitation = text(null = TRUE)
    ), unique = list("place")),
    relations = db_table("rot_relation", "relation", list(
      relation = name_text, place = whole(check = at_least(1)), equation = name_text,
      variables = name_text, interpretation = name_text, concept = key_of("concepts"),
      convention = key_of("conventions"), source = key_of("sources")
    ), unique = list("place")),
    constraints = db_table("rot_constraint", "constraint_kind", list(
      constraint_kind = name_text, concept = key_of("concepts", null = TRUE), meaning = name_text
    )),
    effects = db_table("rot_effect", c("constraint_kind", "effect"), list(
      constraint_kind = key_of("constraints"), effect = name_text, meaning = name_text
    )),
    models = db_table("rot_model", "model", list(
      model = name_text, constraint_kind = key_of("constraints"), equations = name_text,
      assumptions = name_text, limits = name_text, requires = name_text,
      error = decimal(check = above(0)), error_kind = text(check = one_of("bound", "estimate")),
      source = key_of("sources"), cited = name_text
    )),
    model_effects = db_table("rot_model_effect", c("model", "effect"), list(
      model = key_of("models"), constraint_kind = name_text, effect = name_text
    ), rules = list(refers_to("effects", c("constraint_kind", "effect")))),
    programs = db_table("rot_program", "program", list(
      program = name_text, place = whole(null = TRUE, check = at_least(1)),
      article_slug = text(null = TRUE), concept = key_of("concepts"),
      numerical_method = text(null = TRUE), parameter_summary = text(null = TRUE),
      output_summary = text(null = TRUE),
      created_at = text(null = TRUE, check = like("____-__-__"))
    )),
    assumptions = db_table("rot_assumption", "assumption", list(
      assumption = name_text, place = whole(check = at_least(1)),
      program = key_of("programs", null = TRUE),
      constraint_kind = key_of("constraints", null = TRUE),
      kind = text(check = one_of(
        "axis", "rigidity", "mass", "contact", "resistance", "load", "sign", "unit", "size", "start"
      )),
      statement = name_text, enforced = text(check = one_of(
        "refused", "dropped", "warned", "stated"
      )),
      effect = text(null = TRUE), names = text(null = TRUE),
      counterexample = text(null = TRUE, check = json_like)
    ), unique = list("place"), rules = list(
      rule(
        "enforced <> 'refused' OR (counterexample IS NOT NULL AND names IS NOT NULL)",
        function(x) x$enforced != "refused" | (!is.na(x$counterexample) & !is.na(x$names)),
        list(enforced = "refused", counterexample = NA)
      ),
      rule(
        "enforced <> 'dropped' OR effect IS NOT NULL",
        function(x) x$enforced != "dropped" | !is.na(x$effect),
        list(enforced = "dropped", effect = NA)
      ),
      refers_to("effects", c("constraint_kind", "effect"))
    )),
    model_assumptions = db_table("rot_model_assumption", c("model", "assumption"), list(
      model = key_of("models"), assumption = key_of("assumptions")
    )),
    shapes = db_table("rot_shape", "shape", list(
      shape = name_text, constructor = text(null = TRUE, check = some_text),
      dimension = whole(check = between(0, 3)), sizes = text(), ixx_formula = name_text,
      iyy_formula = name_text, izz_formula = name_text, beta_formula = text(null = TRUE),
      origin = name_text, axis = name_text, formula = name_text, source = key_of("sources"),
      cited = name_text
    )),
    shape_names = db_table("rot_shape_name", "name", list(
      name = name_text, place = whole(check = at_least(1)), shape = key_of("shapes"),
      beta_or_formula = name_text, axis = name_text, note = text(null = TRUE)
    ), unique = list("place")),
    cases = db_table("rot_case", "model_case", list(
      model_case = name_text, place = whole(check = at_least(1)), program = key_of("programs"),
      title = name_text, source = key_of("sources"),
      scene = text(null = TRUE, check = json_like), note = text(null = TRUE)
    ), unique = list("place")),
    case_values = db_table("rot_case_value", c("model_case", "quantity", "at_s", "role"), list(
      model_case = key_of("cases"), quantity = key_of("quantities"), at_s = decimal(),
      role = text(check = one_of("given", "published")), value = decimal(),
      tolerance = decimal(check = at_least(0)), place = whole(null = TRUE, check = at_least(1)),
      note = text(null = TRUE)
    ))
  )
}

# A reference by several columns; rows that miss one of them refer to nothing.
refers_to <- function(table, columns) list(refers = table, columns = columns)

record_tables <- function() {
  list(
    # An integer key would be SQLite's row number, and NULL the next one.
    format = db_table("rot_format", "rotdyn_version", list(
      format = whole(check = at_least(1)), rotdyn_version = name_text,
      created_utc = text(check = time_like)
    )),
    scenes = db_table("rot_scene", "scene", list(
      scene = text(check = of_length(32)), constraint_kind = key_of("constraints"),
      scene_format = whole(check = at_least(1)), json = text(check = json_like)
    )),
    software = db_table("rot_software", "software", list(
      software = text(check = of_length(32)), rotdyn_version = name_text,
      library_hash = text(check = of_length(32)), r_version = name_text, platform = name_text
    )),
    runs = db_table("rot_run", "run", list(
      run = text(check = of_length(36)), scene = key_of("scenes"), software = key_of("software"),
      model = key_of("models"), model_asked = whole(check = flag_check),
      accuracy = decimal(check = rule_of("accuracy > 0 AND accuracy <= 1", function(x) {
        x > 0 & x <= 1
      }, 2)),
      max_steps = decimal(check = at_least(1)), error = decimal(null = TRUE, check = at_least(0)),
      error_kind = text(check = one_of("bound", "estimate")),
      verdict = text(check = one_of("balanced", "unbalanced", "not audited")),
      row_count = whole(check = at_least(0)), times = text(check = json_like),
      column_names = name_text, result_hash = text(check = of_length(32)),
      errors = text(check = json_like),
      recorded_utc = text(check = time_like), repeats = key_of("runs", null = TRUE),
      note = text(null = TRUE)
    )),
    run_values = db_table("rot_run_value", c("run", "quantity", "place"), list(
      run = key_of("runs"), quantity = key_of("quantities"), place = whole(check = at_least(1)),
      value = decimal(null = TRUE),
      special = text(null = TRUE, check = one_of("NA", "NaN", "Inf", "-Inf", "-0"))
    ), rules = list(rule(
      "(value IS NULL) = (special IS NOT NULL)", function(x) is.na(x$value) == !is.na(x$special),
      list(value = NA, special = NA)
    )), by_key = TRUE)
  )
}

rule_of <- function(sql, holds, wrong) {
  list(sql = function(name) sql, holds = holds, wrong = wrong)
}

all_tables <- function() c(metadata_tables(), record_tables())

# ---- rows, in R ---------------------------------------------------------------------------------

# The faults of some tables by name: a tibble of table, row (NA: all), fault. `tables`: all that the
# rows may refer to.
schema_faults <- function(x, tables) {
  faults <- list()
  report <- function(table, rows, fault) {
    if (length(rows)) faults[[length(faults) + 1L]] <<- list(
      table = rep(table, length(rows)), row = as.integer(rows), fault = rep(fault, length(rows))
    )
  }
  for (name in names(x)) {
    table <- tables[[name]]
    if (is.null(table)) {
      report(name, NA, "no such table")
      next
    }
    rows <- x[[name]]
    if (!is.data.frame(rows) || !setequal(names(rows), names(table$columns))) {
      report(name, NA, paste("the columns must be", paste(names(table$columns), collapse = ", ")))
      next
    }
    check_table_rows(rows, table, x, tables, function(at, fault) report(name, at, fault))
  }
  parts <- function(part, none) c(none, unlist(lapply(faults, `[[`, part)))
  as_table(
    table = parts("table", character()), row = parts("row", integer()),
    fault = parts("fault", character())
  )
}

check_table_rows <- function(rows, table, x, tables, report) {
  typed <- TRUE
  for (name in names(table$columns)) {
    column <- table$columns[[name]]
    values <- rows[[name]]
    fits <- switch(column$type,
      text = is.character(values), is.numeric(values) || is.logical(values) && all(is.na(values))
    )
    if (!fits && !(all(is.na(values)) && is.logical(values))) {
      report(NA, paste0(name, " is no ", column$type))
      typed <- FALSE
      next
    }
    missing <- is.na(values)
    if (!column$null) report(which(missing), paste(name, "is missing"))
    if (column$type == "integer") {
      report(which(!missing & values != round(values)), paste(name, "is no whole number"))
    }
    if (!is.null(column$check)) {
      held <- missing | column$check$holds(values)
      report(which(!held), paste("not", column$check$sql(name)))
    }
    if (!is.null(column$refers)) {
      of <- tables[[column$refers]]
      known <- missing | values %in% x[[column$refers]][[of$key]]
      report(which(!known), paste(name, "is not in", column$refers))
    }
  }
  if (!typed) return()
  joined <- function(columns, rows) do.call(paste, c(lapply(columns, function(name) {
    values <- rows[[name]]
    if (is.double(values)) sprintf("%.17g", values) else as.character(values)
  }), sep = "\r"))
  for (columns in c(list(table$key), table$unique)) {
    present <- stats::complete.cases(rows[columns])
    at <- duplicated(joined(columns, rows)) & present
    report(which(at), paste(paste(columns, collapse = ", "), "is there twice"))
  }
  for (rule in table$rules) {
    if (!is.null(rule$refers)) {
      present <- stats::complete.cases(rows[rule$columns])
      known <- joined(rule$columns, rows) %in% joined(rule$columns, x[[rule$refers]])
      at <- which(present & !known)
      report(at, paste(paste(rule$columns, collapse = ", "), "is not in", rule$refers))
    } else {
      report(which(!(rule$holds(rows) %in% c(TRUE, NA))), paste("not", rule$sql))
    }
  }
}

# ---- SQL ----------------------------------------------------------------------------------------

sql_types <- list(
  sqlite = c(text = "TEXT", integer = "INTEGER", real = "REAL"),
  postgresql = c(text = "TEXT", integer = "BIGINT", real = "DOUBLE PRECISION"),
  duckdb = c(text = "TEXT", integer = "BIGINT", real = "DOUBLE")
)

# The statement that makes a table.
table_sql <- function(table, tables, dialect) {
  types <- sql_types[[dialect]]
  names <- names(table$columns)
  columns <- vapply(names, function(name) {
    column <- table$columns[[name]]
    of <- if (!is.null(column$refers)) tables[[column$refers]]
    paste0(
      name, " ", types[[column$type]], if (!column$null) " NOT NULL",
      if (!is.null(column$check)) paste0(" CHECK (", column$check$sql(name), ")"),
      if (!is.null(of)) paste0(" REFERENCES ", of$sql, " (", of$key, ")")
    )
  }, "")
  listed <- function(columns) paste0("(", paste(columns, collapse = ", "), ")")
  more <- c(
    paste("PRIMARY KEY", listed(table$key)),
    vapply(table$unique, function(columns) paste("UNIQUE", listed(columns)), ""),
    vapply(table$rules, function(rule) {
      if (is.null(rule$refers)) return(paste0("CHECK (", rule$sql, ")"))
      of <- listed(rule$columns)
      paste("FOREIGN KEY", of, "REFERENCES", tables[[rule$refers]]$sql, of)
    }, "")
  )
  paste0(
    "CREATE TABLE ", table$sql, " (\n  ", paste(c(columns, more), collapse = ",\n  "), "\n)",
    if (dialect == "sqlite") if (table$by_key) " STRICT, WITHOUT ROWID" else " STRICT"
  )
}

# Statements that make all tables and views.
schema_sql <- function(dialect) {
  tables <- all_tables()
  c(
    vapply(tables, table_sql, "", tables, dialect),
    "CREATE INDEX rot_run_scene ON rot_run (scene)", view_sql
  )
}

# With the names and the columns that the article's tables have.
view_sql <- c(
  constants = "CREATE VIEW constants AS
SELECT c.place AS constant_id, c.constant AS constant_name, c.symbol AS symbol, c.value AS value,
  u.in_base AS unit, c.note AS notes
FROM rot_constant c JOIN rot_unit u ON u.unit = c.unit
UNION ALL
SELECT place, name, unit, si_factor, in_base, note FROM rot_unit WHERE place IS NOT NULL",
  rolling_body_cases = "CREATE VIEW rolling_body_cases AS
SELECT c.place AS body_id, c.model_case AS object_name,
  MAX(CASE WHEN v.quantity = 'beta' THEN v.value END) AS beta,
  MAX(CASE WHEN v.quantity = 'mass_kg' THEN v.value END) AS mass_kg,
  MAX(CASE WHEN v.quantity = 'radius_m' THEN v.value END) AS radius_m,
  MAX(CASE WHEN v.quantity = 'height_drop_m' THEN v.value END) AS height_drop_m,
  MAX(CASE WHEN v.quantity = 'incline_angle_deg' THEN v.value END) AS incline_angle_deg,
  c.note AS notes
FROM rot_case c JOIN rot_case_value v ON v.model_case = c.model_case
WHERE c.program = 'rolling_body_comparison' AND v.role = 'given'
GROUP BY c.place, c.model_case, c.note",
  moment_of_inertia_shapes = "CREATE VIEW moment_of_inertia_shapes AS
SELECT place AS shape_id, name AS shape_name, beta_or_formula, axis, note AS notes
FROM rot_shape_name",
  torque_time_profile = "CREATE VIEW torque_time_profile AS
SELECT place AS point_id, at_s AS time_s, value AS applied_torque_n_m, note AS notes
FROM rot_case_value
WHERE model_case = 'torque_profile' AND quantity = 'applied_torque_n_m'",
  gyroscope_cases = "CREATE VIEW gyroscope_cases AS
SELECT c.model_case AS case_id,
  MAX(CASE WHEN v.quantity = 'mass_kg' THEN v.value END) AS mass_kg,
  MAX(CASE WHEN v.quantity = 'lever_arm_m' THEN v.value END) AS lever_arm_m,
  MAX(CASE WHEN v.quantity = 'moment_of_inertia_kg_m2' THEN v.value END)
    AS moment_of_inertia_kg_m2,
  MAX(CASE WHEN v.quantity = 'omega_rad_per_s' THEN v.value END) AS spin_omega_rad_per_s,
  c.note AS notes
FROM rot_case c JOIN rot_case_value v ON v.model_case = c.model_case
WHERE c.program = 'gyroscope_precession_scaffold' AND v.role = 'given'
GROUP BY c.place, c.model_case, c.note",
  physical_relations = "CREATE VIEW physical_relations AS
SELECT place AS relation_id, relation AS relation_name, equation AS equation_text, variables,
  interpretation
FROM rot_relation",
  model_metadata = "CREATE VIEW model_metadata AS
SELECT place AS model_id, concept AS model_or_concept, primary_use, key_quantity, limitation
FROM rot_concept",
  source_notes = "CREATE VIEW source_notes AS
SELECT place AS source_id, title AS source_title, organization, primary_role, link AS url
FROM rot_source WHERE link IS NOT NULL",
  model_assumptions = "CREATE VIEW model_assumptions AS
SELECT place AS assumption_id, COALESCE(program, constraint_kind, 'all') AS model_name,
  statement AS assumption_text
FROM rot_assumption",
  simulation_runs = "CREATE VIEW simulation_runs AS
SELECT place AS run_id, article_slug, program AS model_name, numerical_method, parameter_summary,
  output_summary, created_at
FROM rot_program WHERE place IS NOT NULL
UNION ALL
SELECT p.n + ROW_NUMBER() OVER (ORDER BY r.recorded_utc, r.run), 'rotdyn', r.model, r.error_kind,
  s.json, r.column_names, r.recorded_utc
FROM rot_run r JOIN rot_scene s ON s.scene = r.scene
  CROSS JOIN (SELECT MAX(place) AS n FROM rot_program) p"
)
