# The database of records: connections of three kinds, transactions, rows in and out.

own_version <- function() {
  if (is.null(registry_texts$version)) {
    registry_texts$version <- as.character(utils::packageVersion("rotdyn"))
  }
  registry_texts$version
}

utc_now <- function() format(Sys.time(), "%Y-%m-%dT%H:%M:%SZ", tz = "UTC")

# By the class of a connection.
dialects <- c(
  SQLiteConnection = "sqlite", PqConnection = "postgresql", duckdb_connection = "duckdb"
)

# A database whose tables are checked. `made`: they must exist.
open_records <- function(con, call, made = TRUE) {
  db <- connect_records(con, call, made)
  tryCatch(
    check_records(db, call, made),
    error = function(e) {
      db$close()
      rlang::cnd_signal(e)
    }
  )
}

# list(con, dialect, close()).
connect_records <- function(con, call, made = TRUE) {
  need_package("DBI", "Recording runs", call)
  if (!rlang::is_string(con)) {
    return(list(con = con, dialect = dialect_of(con, call), close = function() NULL))
  }
  need_package("RSQLite", "A file of records", call)
  path <- check_file_name(con, call, "con")
  if (made && !file.exists(path)) {
    abort_rotdyn(c(
      "There is no file {.file {path}}.", i = "{.fn records_create} makes one."
    ), "database", call)
  }
  # RSQLite itself would switch off the waiting for the disk.
  con <- tryCatch(
    suppressWarnings(DBI::dbConnect(
      RSQLite::SQLite(), path, loadable.extensions = FALSE, synchronous = NULL
    )),
    error = function(e) abort_database(e, call)
  )
  db <- list(con = con, dialect = "sqlite", close = function() DBI::dbDisconnect(con))
  tryCatch(
    set_references(db, call),
    error = function(e) {
      db$close()
      rlang::cnd_signal(e)
    }
  )
  db
}

# Adds the version; `scene`: see records_version().
check_records <- function(db, call, made = TRUE, scene = "") {
  db$version <- records_version(db, scene, call)
  prepare_connection(db, call)
  if (made) check_format(db$version, call)
  db
}

dialect_of <- function(con, call) {
  known <- dialects[intersect(class(con), names(dialects))]
  if (inherits(con, "PostgreSQLConnection")) {
    abort_rotdyn(c(
      "RPostgreSQL rounds numbers to 15 digits: nothing could be computed again.",
      i = "Connect with {.code DBI::dbConnect(RPostgres::Postgres(), ...)}."
    ), "database", call)
  }
  if (!length(known)) {
    abort_rotdyn(c(
      "{.arg con} must be the name of a file, or a DBI connection to SQLite, PostgreSQL or DuckDB.",
      x = "It is {describe_value(con)}.",
      i = "{.code DBI::dbConnect(RSQLite::SQLite(), \"lab.sqlite\")}"
    ), if (inherits(con, "DBIConnection")) "database" else "type", call)
  }
  if (!DBI::dbIsValid(con)) abort_rotdyn("The connection is closed.", "database", call)
  unname(known[1])
}

# SQLite keeps references only where each connection says so, and not within a transaction.
prepare_connection <- function(db, call) {
  if (db$dialect != "sqlite" || isTRUE(db$version$kept == 1)) return(invisible())
  set_references(db, call)
  if (query(db, "PRAGMA foreign_keys", call = call)[[1]] != 1) {
    abort_rotdyn(c(
      "SQLite does not check references on this connection.",
      i = "A transaction is open: commit it first."
    ), "database", call)
  }
}

# A second writer waits for 10 s.
set_references <- function(db, call) {
  tryCatch(
    {
      RSQLite::sqliteSetBusyHandler(db$con, 10000L)
      execute(db, "PRAGMA foreign_keys = ON")
    },
    error = function(e) abort_database(e, call)
  )
}

abort_database <- function(e, call) {
  abort_rotdyn(
    c("The database refuses.", x = gsub("([{}])", "\\1\\1", conditionMessage(e))), "database", call
  )
}

# Integers of 64 bits as doubles; results of all drivers as plain columns.
query <- function(db, sql, params = NULL, call) {
  rows <- tryCatch(
    if (is.null(params)) DBI::dbGetQuery(db$con, sql) else {
      DBI::dbGetQuery(db$con, placeholders(sql, db$dialect), params = params)
    },
    error = function(e) abort_database(e, call)
  )
  rows[] <- lapply(rows, function(x) if (inherits(x, "integer64")) big_integers(x) else x)
  rows
}

big_integers <- function(x) as.double(format(x))

# `?` in the SQL of this file.
placeholders <- function(sql, dialect) {
  if (dialect != "postgresql") return(sql)
  parts <- strsplit(sql, "?", fixed = TRUE)[[1]]
  n <- length(parts) - 1L
  if (endsWith(sql, "?")) n <- n + 1L
  paste0(parts, c(sprintf("$%d", seq_len(n)), "")[seq_along(parts)], collapse = "")
}

# A statement without rows; DBI::dbExecute() would count those that it changes.
execute <- function(db, sql, params = NULL) {
  DBI::dbClearResult(if (is.null(params)) DBI::dbSendStatement(db$con, sql) else {
    DBI::dbSendStatement(db$con, sql, params = params)
  })
}

in_transaction <- function(db, call, code) {
  tryCatch(
    whole_or_none(db, code),
    rotdyn_error = function(e) rlang::cnd_signal(e),
    error = function(e) abort_database(e, call)
  )
}

# An error or an interruption in `code` undoes it. SQLite's writer waits at the beginning alone.
whole_or_none <- function(db, code) {
  if (db$dialect == "sqlite") execute(db, "BEGIN IMMEDIATE") else DBI::dbBegin(db$con)
  done <- FALSE
  on.exit(if (!done) DBI::dbRollback(db$con))
  force(code)
  if (db$dialect == "sqlite") execute(db, "COMMIT") else DBI::dbCommit(db$con)
  done <- TRUE
  invisible()
}

# NULL without the tables; else list(format, rotdyn_version, has_software: this one, has_scene: the
# one of the hash `scene`, kept: whether SQLite keeps references). One query: each takes 0.3 ms.
records_version <- function(db, scene, call) {
  kept <- if (db$dialect == "sqlite") "(SELECT foreign_keys FROM pragma_foreign_keys)" else "1"
  rows <- tryCatch(
    DBI::dbGetQuery(db$con, paste0(
      "SELECT format, rotdyn_version, ", kept, " AS kept, (SELECT COUNT(*) FROM rot_software ",
      "WHERE software = '", own_software()$software, "') AS software, ",
      "(SELECT COUNT(*) FROM rot_scene WHERE scene = '", scene, "') AS scene FROM rot_format"
    )),
    error = function(e) {
      # A file that is locked or no database may have tables of records.
      other <- db$dialect == "sqlite" && !grepl("no such table", conditionMessage(e), fixed = TRUE)
      if (other) abort_database(e, call)
    }
  )
  if (is.null(rows)) return(NULL)
  number <- function(x) as.double(if (inherits(x, "integer64")) big_integers(x) else x)
  list(
    format = max(number(rows$format)), rotdyn_version = rows$rotdyn_version[1],
    has_software = number(rows$software)[1] > 0, has_scene = number(rows$scene)[1] > 0,
    kept = number(rows$kept)[1]
  )
}

check_format <- function(found, call) {
  if (is.null(found)) {
    abort_rotdyn(c(
      "The database has no tables of records.", i = "{.fn records_create} makes them."
    ), "database", call)
  }
  if (!is.finite(found$format) || found$format > records_format) {
    abort_rotdyn(c(
      "The database has a newer format.",
      x = "It is {found$format}; this version of rotdyn reads {records_format}.",
      i = "rotdyn {found$rotdyn_version} or later reads it."
    ), "database", call)
  }
}

add_metadata <- function(db) {
  known <- metadata()
  for (name in names(known)) append_rows(db, name, known[[name]])
}

# Adds the rows whose key is not there yet.
refresh_metadata <- function(db, call) {
  known <- metadata()
  tables <- metadata_tables()
  in_transaction(db, call, {
    for (name in names(known)) {
      key <- tables[[name]]$key
      there <- query(
        db, paste("SELECT", paste(key, collapse = ", "), "FROM", tables[[name]]$sql), call = call
      )
      joined <- function(rows) do.call(paste, c(lapply(rows[key], as.character), sep = "\r"))
      rows <- known[[name]][!joined(known[[name]]) %in% joined(there), ]
      # Another row may have the place that a new one has here.
      if (nrow(rows) && "place" %in% names(rows) && !anyNA(rows$place)) {
        last <- query(db, paste("SELECT MAX(place) AS n FROM", tables[[name]]$sql), call = call)$n
        rows$place <- as.integer(last) + seq_len(nrow(rows))
      }
      append_rows(db, name, rows)
    }
    execute(
      db, placeholders("UPDATE rot_format SET rotdyn_version = ?", db$dialect), list(own_version())
    )
  })
}

# Columns that are all missing have the type of the table. `form`: see insert_with().
append_rows <- function(db, name, rows, form = "") {
  table <- all_table_list()[[name]]
  if (!length(rows[[1]])) return(invisible())
  columns <- table$columns
  rows <- lapply(stats::setNames(nm = names(columns)), function(column) {
    x <- rows[[column]]
    switch(columns[[column]]$type,
      text = enc2utf8(as.character(x)),
      integer = if (is.integer(x)) x else if (max(abs(x), 0, na.rm = TRUE) < 2^31) {
        as.integer(x)
      } else {
        as.double(x)
      },
      as.double(x)
    )
  })
  if (db$dialect == "sqlite" || length(rows[[1]]) == 1L) {
    execute(db, insert_with(name, db$dialect, form), unname(rows))
  } else {
    DBI::dbAppendTable(db$con, table$sql, as.data.frame(rows))
  }
  invisible()
}

# The statement that adds a row of a table, its values as parameters. Forms: "new" passes over a row
# whose key is there; "checked", in SQLite, makes the key NULL, which is refused, unless the
# connection keeps references and the tables are those of this version.
insert_with <- function(name, dialect, form = "") {
  kept <- paste("insert", name, dialect, form)
  if (is.null(registry_texts[[kept]])) {
    table <- all_table_list()[[name]]
    columns <- names(table$columns)
    values <- rep("?", length(columns))
    if (form == "checked") {
      values[1] <- paste0(
        "CASE WHEN (SELECT foreign_keys FROM pragma_foreign_keys) AND (SELECT MAX(format) FROM ",
        "rot_format) = ", records_format, " AND (SELECT rotdyn_version FROM rot_format) = '",
        own_version(), "' THEN ? END"
      )
    }
    registry_texts[[kept]] <- placeholders(paste0(
      "INSERT INTO ", table$sql, " (", paste(columns, collapse = ", "), ") VALUES (",
      paste(values, collapse = ", "), ")", if (form == "new") " ON CONFLICT DO NOTHING"
    ), dialect)
  }
  registry_texts[[kept]]
}

all_table_list <- function() {
  if (is.null(registry_texts$tables)) registry_texts$tables <- all_tables()
  registry_texts$tables
}

# Of a database, in the types that the check of rows reads.
plain_rows <- function(rows, table) {
  for (name in names(table$columns)) {
    rows[[name]] <- if (table$columns[[name]]$type == "text") {
      as.character(rows[[name]])
    } else {
      as.double(rows[[name]])
    }
  }
  rows
}
