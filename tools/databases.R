# Wrong rows for every constraint of the tables: refused by R, by SQLite and by PostgreSQL; for
# DuckDB the statements are written to a folder, for databases.js.
#
#   Rscript tools/databases.R FOLDER [SOCKET]
Sys.setenv(TZ = "UTC")
library(rotdyn)
ns <- asNamespace("rotdyn")
arguments <- commandArgs(TRUE)
folder <- arguments[1]
socket <- arguments[2]
tables <- ns$all_tables()
`%||%` <- function(a, b) if (is.null(a)) b else a

# ---- a database with one run --------------------------------------------------------------------

motion <- trajectory(
  scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = 0.03)), seq(0, 8, by = 0.1)
)
lab <- DBI::dbConnect(RSQLite::SQLite(), ":memory:")
invisible(records_create(lab))
invisible(records_add(lab, motion))
rows_of <- function(con, table) {
  sql <- paste("SELECT", paste(names(table$columns), collapse = ", "), "FROM", table$sql)
  ns$plain_rows(DBI::dbGetQuery(con, sql), table)
}
data <- lapply(tables, function(table) rows_of(lab, table))
stopifnot(nrow(ns$schema_faults(data, tables)) == 0)

# ---- rows that are right but for one thing ------------------------------------------------------

# A row of a table under a name of its own, where that has no reference.
another <- function(table, name) {
  filled <- rowSums(!is.na(data[[name]]))
  row <- as.list(data[[name]][which.max(filled), ])
  for (column in c(table$key, unlist(table$unique))) {
    of <- table$columns[[column]]
    if (!is.null(of$refers) || column %in% unlist(lapply(table$rules, `[[`, "columns"))) next
    row[[column]] <- if (of$type != "text") 1 + max(data[[name]][[column]], na.rm = TRUE) else {
      chars <- nchar(row[[column]])
      if (identical(of$check$wrong, "short")) strrep("f", chars) else paste0(row[[column]], " too")
    }
  }
  row
}

wrong <- list()
add <- function(name, what, row) {
  wrong[[length(wrong) + 1L]] <<- list(table = name, what = what, row = row)
}
for (name in names(tables)) {
  table <- tables[[name]]
  right <- another(table, name)
  with <- function(...) utils::modifyList(right, list(...), keep.null = TRUE)
  set <- function(column, value) {
    row <- right
    row[[column]] <- value
    row
  }
  for (column in names(table$columns)) {
    of <- table$columns[[column]]
    if (!of$null) add(name, paste(column, "NULL"), set(column, NA))
    if (!is.null(of$check)) add(name, of$check$sql(column), set(column, of$check$wrong))
    if (!is.null(of$refers)) {
      long <- if (column == "repeats" || of$refers == "runs") strrep("0", 36) else "no such"
      add(name, paste(column, "REFERENCES"), set(column, long))
    }
    if (of$type != "text") add(name, paste(column, "is no", of$type), set(column, "much"))
  }
  old <- as.list(data[[name]][which.max(rowSums(!is.na(data[[name]]))), ])
  add(name, "PRIMARY KEY", utils::modifyList(right, old[table$key]))
  for (columns in table$unique) {
    present <- which(!is.na(data[[name]][[columns[1]]]))[1]
    row <- right
    row[columns] <- as.list(data[[name]][present, ])[columns]
    add(name, paste("UNIQUE", paste(columns, collapse = ", ")), row)
  }
  for (rule in table$rules) {
    row <- right
    if (is.null(rule$refers)) {
      row[names(rule$wrong)] <- rule$wrong
    } else {
      row[rule$columns] <- as.list(data[[rule$refers]][1, rule$columns])
      row[[utils::tail(rule$columns, 1)]] <- "no such"
    }
    add(name, rule$sql %||% "FOREIGN KEY", row)
  }
}

literal <- function(x) {
  if (is.na(x)) return("NULL")
  if (is.character(x)) return(paste0("'", gsub("'", "''", x, fixed = TRUE), "'"))
  .Call(ns$ffi_text_numbers, as.double(x))
}
insert <- function(case) {
  paste0(
    "INSERT INTO ", tables[[case$table]]$sql, " (", paste(names(case$row), collapse = ", "),
    ") VALUES (", paste(vapply(case$row, literal, ""), collapse = ", "), ")"
  )
}

# ---- the verdicts -------------------------------------------------------------------------------

failed <- 0
report <- function(where, accepted) {
  failed <<- failed + length(accepted)
  for (case in accepted) cat("not ok -", where, "takes", case$table, ":", case$what, "\n")
  cat(
    if (length(accepted)) "not ok -" else "ok -", where, "refuses",
    length(wrong) - length(accepted), "of", length(wrong), "wrong rows\n"
  )
}

by_r <- Filter(function(case) {
  rows <- data[[case$table]]
  rows[nrow(rows) + 1L, ] <- case$row[names(rows)]
  data[[case$table]] <- rows
  refused <- tryCatch(
    {
      rotdyn:::check_metadata(data)
      FALSE
    },
    rotdyn_error_metadata = function(e) any(e$faults$table == case$table)
  )
  !refused
}, wrong)
report("check_metadata()", by_r)

# `con` has metadata and a run: it must be able to take a right row, and no wrong one.
try_database <- function(where, con) {
  accepted <- Filter(function(case) {
    tryCatch(
      {
        DBI::dbExecute(con, insert(case))
        TRUE
      },
      error = function(e) FALSE
    )
  }, wrong)
  report(where, accepted)
}
# The rows that the wrong ones were made from, of tables whose key is a name of their own.
right_rows <- function(con) {
  own <- Filter(function(name) {
    table <- tables[[name]]
    listed <- unlist(lapply(table$rules, `[[`, "columns"))
    all(vapply(table$columns[table$key], function(of) is.null(of$refers), NA)) &&
      !any(table$key %in% listed)
  }, names(tables))
  for (name in own) {
    DBI::dbExecute(con, insert(list(table = name, row = another(tables[[name]], name))))
  }
  cat("ok -", length(own), "rows that are right are taken\n")
}
same <- function(where, con) {
  off <- Filter(function(name) {
    got <- rows_of(con, tables[[name]])
    want <- as.data.frame(metadata()[[name]])
    key <- function(x) do.call(order, c(unname(x[tables[[name]]$key]), method = "radix"))
    !isTRUE(all.equal(
      lapply(got[key(got), ], as.vector), lapply(want[key(want), names(got)], as.vector),
      tolerance = 0, check.attributes = FALSE
    ))
  }, names(metadata()))
  failed <<- failed + length(off)
  cat(if (length(off)) "not ok -" else "ok -", where, "has the rows of metadata()", off, "\n")
}
views <- function(where, con) {
  counts <- vapply(names(ns$view_sql), function(view) {
    as.double(DBI::dbGetQuery(con, paste("SELECT COUNT(*) AS n FROM", view))$n)
  }, 0)
  least <- c(5, 5, 6, 10, 3, 13, 6, 8, 6, 4)
  closing <- DBI::dbGetQuery(
    con, "SELECT relation_name, equation_text, interpretation FROM physical_relations
    ORDER BY relation_id;"
  )
  good <- all(counts >= least) && nrow(closing) == 13L
  if (!good) failed <<- failed + 1
  cat(if (good) "ok -" else "not ok -", where, "has the article's views\n")
}

cat("==== SQLite", DBI::dbGetQuery(lab, "SELECT sqlite_version() AS v")$v, "\n")
same("SQLite", lab)
views("SQLite", lab)
try_database("SQLite", lab)
right_rows(lab)

if (!is.na(socket)) {
  cat("==== PostgreSQL\n")
  con <- DBI::dbConnect(
    RPostgres::Postgres(), host = socket, port = 54329, dbname = "postgres", user = "postgres",
    bigint = "numeric"
  )
  cat(DBI::dbGetQuery(con, "SELECT version() AS v")$v, "\n")
  invisible(records_create(con))
  same("PostgreSQL", con)
  views("PostgreSQL", con)
  run <- records_add(con, motion)
  again <- records_rerun(con, run)
  good <- again$verdict == "identical" && all(records_check(con)$holds) &&
    nrow(records_list(con)) == 1
  if (!good) failed <- failed + 1
  cat(if (good) "ok -" else "not ok -", "a run recorded and computed again:", again$verdict, "\n")
  # The run whose names wrong rows repeat.
  for (name in c("runs", "run_values")) {
    for (sql in ns$insert_sql(data[[name]], tables[[name]]$sql)) DBI::dbExecute(con, sql)
  }
  try_database("PostgreSQL", con)
  right_rows(con)
  DBI::dbDisconnect(con)
}

# DuckDB: the script, the rows of a run, and the wrong rows, a statement a line.
script <- strsplit(metadata(dialect = "duckdb"), ";\n", fixed = TRUE)[[1]]
script <- c(script[!grepl("^(--|PRAGMA|BEGIN|COMMIT)", script)], unlist(lapply(
  c("scenes", "software", "runs", "run_values"), function(name) {
    ns$insert_sql(data[[name]], tables[[name]]$sql)
  }
)))
first <- metadata(dialect = "duckdb")
script <- c(sub("^--[^\n]*\nBEGIN;\n", "", strsplit(first, ";\nCREATE", fixed = TRUE)[[1]][1]),
            script)
writeLines(ns$json_canonical(list(
  script = I(script[nzchar(script)]), wrong = I(vapply(wrong, insert, "")),
  what = I(vapply(wrong, function(case) paste(case$table, case$what), "")),
  views = I(names(ns$view_sql))
)), file.path(folder, "duckdb.json"))
cat("databases in R:", failed, "failed\n")
quit(status = if (failed) 1L else 0L)
