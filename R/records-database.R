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

# A second writer waits for 60 s: many sessions may make or open one database at a time.
set_references <- function(db, call) {
  tryCatch(
    {
      RSQLite::sqliteSetBusyHandler(db$con, 60000L)
      execute(db, "PRAGMA foreign_keys = ON")
    },
    error = function(e) abort_database(e, call)
  )
}

abort_database <- function(e, call) {
  said <- database_words(conditionMessage(e))
  known <- names(database_remedies)[vapply(names(database_remedies), grepl, NA, said, TRUE)]
  abort_rotdyn(c(
    "The database refuses.", x = braces_doubled(said),
    i = if (length(known)) database_remedies[[known[1]]]
  ), "database", call)
}

# By what SQLite says.
database_remedies <- c(
  "is locked" = "Another connection writes to it, or did not end its transaction.",
  "readonly" = "The file, or its folder, is write-protected, or the connection only reads.",
  "unable to open" = "Its folder must exist, and the user may read the file and write to both.",
  "not a database" = "A file of records is made by {.fn records_create}.",
  "malformed" = "The file is damaged: take a copy, or what {.code sqlite3 FILE .recover} saves.",
  "no such column|no column named" =
    "The tables were changed: {.fn metadata} with a {.arg dialect} shows what they are.",
  "within a transaction" = "A transaction is open: commit it first."
)

# A full disk in the words of three databases.
database_words <- function(said) {
  full <- "disk is full|disk full|no space left|quota exceeded"
  if (grepl(full, said, ignore.case = TRUE)) "The disk is full." else said
}

# Integers of 64 bits as doubles; results of all drivers as plain columns. Text that is not valid
# has its bytes in angle brackets. The attribute "damaged" is TRUE if there is such text, or if a
# column has values of several types, of which the driver warns.
query <- function(db, sql, params = NULL, call) {
  warned <- FALSE
  rows <- tryCatch(
    withCallingHandlers(
      if (is.null(params)) DBI::dbGetQuery(db$con, sql) else {
        DBI::dbGetQuery(db$con, placeholders(sql, db$dialect), params = params)
      },
      warning = function(w) {
        warned <<- TRUE
        invokeRestart("muffleWarning")
      }
    ),
    error = function(e) abort_database(e, call)
  )
  readable_rows(rows, warned)
}

readable_rows <- function(rows, damaged = FALSE) {
  for (i in seq_along(rows)) {
    x <- rows[[i]]
    if (inherits(x, "integer64")) rows[[i]] <- big_integers(x)
    if (is.character(x) && !all(validUTF8(x))) {
      damaged <- TRUE
      rows[[i]] <- iconv(x, "UTF-8", "UTF-8", sub = "byte")
    }
  }
  attr(rows, "damaged") <- damaged
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
  result <- if (is.null(params)) DBI::dbSendStatement(db$con, sql) else {
    DBI::dbSendStatement(db$con, sql, params = params)
  }
  DBI::dbClearResult(result)
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
  # A database on a full disk has undone it already, and has no transaction any more.
  on.exit(if (!done) try(suppressWarnings(DBI::dbRollback(db$con)), silent = TRUE))
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
    suppressWarnings(DBI::dbGetQuery(db$con, paste0(
      "SELECT format, rotdyn_version, ", kept, " AS kept, (SELECT COUNT(*) FROM rot_software ",
      "WHERE software = '", own_software()$software, "') AS software, ",
      "(SELECT COUNT(*) FROM rot_scene WHERE scene = '", scene, "') AS scene FROM rot_format"
    ))),
    error = function(e) {
      # A file that is locked or no database may have tables of records.
      other <- db$dialect == "sqlite" && !grepl("no such table", conditionMessage(e), fixed = TRUE)
      if (other) abort_database(e, call)
    }
  )
  if (is.null(rows)) return(NULL)
  rows <- readable_rows(rows)
  list(
    format = max(as_numbers(rows$format), -Inf),
    rotdyn_version = if (is.character(rows$rotdyn_version)) rows$rotdyn_version[1] else "unknown",
    has_software = as_numbers(rows$software)[1] > 0, has_scene = as_numbers(rows$scene)[1] > 0,
    kept = as_numbers(rows$kept)[1]
  )
}

check_format <- function(found, call) {
  if (is.null(found)) {
    abort_rotdyn(c(
      "The database has no tables of records.", i = "{.fn records_create} makes them."
    ), "database", call)
  }
  if (!is.finite(found$format)) {
    abort_rotdyn("The database is damaged: its format is no number.", "database", call)
  }
  if (found$format > records_format) {
    abort_rotdyn(c(
      "The database has a newer format.",
      x = "It is {found$format}; this version of rotdyn reads {records_format}.",
      i = "rotdyn {found$rotdyn_version} or later reads it."
    ), "database", call)
  }
}

# Makes the tables unless another session has made them meanwhile; the names of what was made.
make_tables <- function(db, call) {
  made <- character()
  in_transaction(db, call, {
    lock_tables(db)
    if (!DBI::dbExistsTable(db$con, "rot_format")) {
      for (statement in schema_sql(db$dialect)) execute(db, statement)
      add_metadata(db)
      append_rows(db, "format", list(
        format = records_format, rotdyn_version = own_version(), created_utc = utc_now()
      ))
      made <- c(vapply(all_tables(), `[[`, "", "sql", USE.NAMES = FALSE), names(view_sql))
    }
  })
  made
}

# SQLite's transactions have the writer's lock from the beginning; PostgreSQL's take this one, which
# ends with the transaction.
lock_tables <- function(db) {
  if (db$dialect == "postgresql") {
    DBI::dbGetQuery(db$con, "SELECT CAST(pg_advisory_xact_lock(726174) AS TEXT)")
  }
}

# A file that appears with all of its tables, or not at all: made under another name beside it. NULL
# where another session was faster, or the disk has no second names for files.
make_file <- function(path, call) {
  folder <- tryCatch(suppressWarnings(dirname(path)), error = function(e) NULL)
  if (is.null(folder)) return(NULL) # too long for a path: connecting says so
  part <- tempfile(".rotdyn-", folder)
  on.exit(unlink(paste0(part, c("", "-journal"))))
  db <- connect_records(part, call, made = FALSE)
  made <- tryCatch(make_tables(db, call), finally = db$close())
  if (isTRUE(suppressWarnings(file.link(part, path)))) made
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
    lock_tables(db)
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
  sql <- function() insert_with(name, db$dialect, form)
  if (db$dialect == "sqlite" || length(rows[[1]]) == 1L) {
    execute(db, sql(), unname(rows))
  } else if (nzchar(form)) {
    for (i in seq_along(rows[[1]])) execute(db, sql(), unname(lapply(rows, `[`, i)))
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

# Of a database, in the types that the check of rows reads. What is of another type is NA.
plain_rows <- function(rows, table) {
  for (name in names(table$columns)) {
    x <- rows[[name]]
    rows[[name]] <- if (table$columns[[name]]$type != "text") {
      as_numbers(x)
    } else if (is.list(x)) {
      rep(NA_character_, length(x))
    } else {
      as.character(x)
    }
  }
  rows
}

as_numbers <- function(x) {
  if (is.list(x)) rep(NA_real_, length(x)) else suppressWarnings(as.double(x))
}
