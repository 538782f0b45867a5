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

# list(con, dialect, version, close()). `made`: the tables must exist. `scene`: see
# records_version().
open_records <- function(con, call, made = TRUE, scene = "") {
  need_package("DBI", "Recording runs", call)
  own <- rlang::is_string(con)
  if (own) {
    need_package("RSQLite", "A file of records", call)
    con <- check_file_name(con, call, "con")
    if (made && !file.exists(con)) {
      abort_rotdyn(c(
        "There is no file {.file {con}}.", i = "{.fn records_create} makes one."
      ), "database", call)
    }
    path <- con
    # RSQLite itself would switch off the waiting for the disk.
    con <- tryCatch(
      suppressWarnings(DBI::dbConnect(
        RSQLite::SQLite(), path, loadable.extensions = FALSE, synchronous = NULL
      )),
      error = function(e) abort_database(e, call)
    )
  }
  db <- list(
    con = con, dialect = dialect_of(con, call),
    close = if (own) function() DBI::dbDisconnect(con) else function() NULL
  )
  tryCatch(
    {
      if (own) set_references(db, call)
      db$version <- records_version(db, scene)
      prepare_connection(db, call)
      if (made) check_format(db$version, call)
    },
    error = function(e) {
      db$close()
      rlang::cnd_signal(e)
    }
  )
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
      DBI::dbExecute(db$con, "PRAGMA foreign_keys = ON")
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

in_transaction <- function(db, call, code) {
  tryCatch(
    DBI::dbWithTransaction(db$con, force(code)),
    rotdyn_error = function(e) rlang::cnd_signal(e),
    error = function(e) abort_database(e, call)
  )
}

# NULL without the tables; else list(format, rotdyn_version, has_software: this one, has_scene: the
# one of the hash `scene`, kept: whether SQLite keeps references). One query: each takes 0.3 ms.
records_version <- function(db, scene) {
  kept <- if (db$dialect == "sqlite") "(SELECT foreign_keys FROM pragma_foreign_keys)" else "1"
  rows <- tryCatch(
    DBI::dbGetQuery(db$con, paste0(
      "SELECT format, rotdyn_version, ", kept, " AS kept, (SELECT COUNT(*) FROM rot_software ",
      "WHERE software = '", own_software()$software, "') AS software, ",
      "(SELECT COUNT(*) FROM rot_scene WHERE scene = '", scene, "') AS scene FROM rot_format"
    )),
    error = function(e) NULL
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
    DBI::dbExecute(
      db$con, placeholders("UPDATE rot_format SET rotdyn_version = ?", db$dialect),
      params = list(own_version())
    )
  })
}

# Columns that are all missing have the type of the table.
append_rows <- function(db, name, rows) {
  table <- all_table_list()[[name]]
  if (!length(rows[[1]])) return(invisible())
  rows <- rows[names(table$columns)]
  for (column in names(rows)) {
    type <- table$columns[[column]]$type
    rows[[column]] <- switch(type,
      text = enc2utf8(as.character(rows[[column]])),
      integer = if (max(abs(rows[[column]]), 0, na.rm = TRUE) < 2^31) {
        as.integer(rows[[column]])
      } else {
        as.double(rows[[column]])
      },
      as.double(rows[[column]])
    )
  }
  if (db$dialect == "sqlite" || length(rows[[1]]) == 1L) {
    DBI::dbExecute(db$con, insert_with(name, db$dialect), params = unname(as.list(rows)))
  } else {
    DBI::dbAppendTable(db$con, table$sql, as.data.frame(rows))
  }
  invisible()
}

# The statement that adds a row of a table, its values as parameters.
insert_with <- function(name, dialect) {
  kept <- paste("insert", name, dialect)
  if (is.null(registry_texts[[kept]])) {
    table <- all_table_list()[[name]]
    columns <- names(table$columns)
    registry_texts[[kept]] <- placeholders(paste0(
      "INSERT INTO ", table$sql, " (", paste(columns, collapse = ", "), ") VALUES (",
      paste(rep("?", length(columns)), collapse = ", "), ")"
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
