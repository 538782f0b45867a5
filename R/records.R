# Records of motions in a database: the recipe (scene, times, model, accuracy), the versions, and
# the fingerprint of the result. Text from a database is read by read_scene(), and never evaluated.

records_format <- 1L

#' Records of motions in a database
#'
#' A record of a trajectory is what it takes to compute it again, years later and elsewhere: the
#' scene as text, the times, the model, the accuracy, the versions; and the fingerprint of the
#' result: its error figures, its audit, a hash of its columns, and the values of some rows.
#'
#' `con` is the name of a file, which becomes an SQLite database, or a DBI connection to SQLite,
#' PostgreSQL (package RPostgres) or DuckDB. `records_create()` makes the tables, with keys, fills
#' in [metadata()], and makes views with the names and the columns of the article's ten tables.
#' Where the tables exist it adds what is new in this version and changes nothing.
#'
#' `records_add()` writes one run in one transaction: an interruption leaves all of it or nothing.
#' The rows that are kept are the first, the last, those at the quarters, and those with the largest
#' values; with `rows = "all"` every row is. NA, NaN, Inf and -0 are kept as such, TRUE and FALSE as
#' 1 and 0; of columns of text a hash of each row's text, up to 10000 changes from row to row. The
#' length of steps that was asked for (`step_s`) is kept.
#'
#' `records_rerun()` computes a record anew from the database alone. The verdict is `"identical"` if
#' the hash of the columns is the same; `"within errors"` if the values kept differ by no more than
#' the two error figures allow and the texts are the same; otherwise `"differs"`. `not_compared`
#' names columns of which the record has no values: those of text that change more often, and in
#' records of older versions those of text and of later bodies (`theta_3_rad`). Other versions of
#' the package, of the compiler or of the processor may change last bits: `"within errors"` is what
#' to expect of them.
#'
#' `records_check()` looks at keys, checks and references in R, at types and encodings, at the
#' hashes of the scenes, whether every scene and the times of every run can be read and every run
#' has its values; and at what SQLite says of its file.
#'
#' `metadata(dialect = )` has tables, rows and views as a script, for those without R.
#'
#' @param con A DBI connection, or the name of an SQLite file.
#' @param motion The result of [trajectory()].
#' @param run Name of a run: 36 characters, as `records_add()` returned them, or their beginning, if
#'   it is that of no other run.
#' @param ... Not used: an unknown argument is an error.
#' @param note Any text, or NULL.
#' @param rows `"some"` or `"all"`: which rows to keep.
#' @param store For `records_rerun()`: whether to record the new run, too (it says what it
#'   repeats).
#' @return
#' * `records_create()`: the names of the tables and views that were made, invisibly.
#' * `records_add()`: the name of the run.
#' * `records_list()`: a tibble with a row for each run, the oldest first.
#' * `records_read()`: a list: the columns of `records_list()`, `scene_text`, `scene`, `times_s`,
#'   `model_asked`, `max_steps`, `step_s` (NULL where none was asked for), `columns`, `result_hash`,
#'   `errors` (a tibble: measure, size, error), `values` and `texts` (tibbles: quantity, row, value;
#'   of texts the first 52 bits of a hash, in the rows where it changes) and `software` (a list).
#' * `records_rerun()`: a list of class `rot_rerun`: `verdict`, `where` (a tibble with a row for
#'   each quantity: the row where it differs most, the two values, and what the errors allow; the
#'   worst first), `texts` (the rows in which texts differ, by column), `not_compared`, `run`,
#'   `model`, `versions` and `motion`, the new trajectory.
#' * `records_check()`: a tibble: check, holds, detail.
#' @section Errors: `rotdyn_error_database` (a driver that is not known, no tables of records, a
#'   newer format, what the database says), `rotdyn_error_time` (rows out of order),
#'   `rotdyn_error_record` (no such run, a model that exists no more), `rotdyn_error_scene`,
#'   `rotdyn_error_type`, `rotdyn_error_package`: \pkg{DBI} is needed, \pkg{RSQLite} for files,
#'   \pkg{yyjsonr} to read scenes. RPostgreSQL is refused: it rounds numbers to 15 digits.
#' @source <https://www.sqlite.org/stricttables.html>, <https://www.sqlite.org/foreignkeys.html>.
#' @seealso [write_scene()], [metadata()], [trajectory()].
#' @concept lab book
#' @concept reproducibility
#' @examplesIf all(vapply(c("DBI", "RSQLite", "yyjsonr"), requireNamespace, NA, quietly = TRUE))
#' lab <- tempfile(fileext = ".sqlite")
#' records_create(lab)
#' wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = 0.03))
#' run <- records_add(lab, trajectory(wheel, seq(0, 8, by = 0.1)), note = "bearing 3")
#' records_list(lab)
#' records_rerun(lab, run)
#' unlink(lab)
#' @export
records_create <- function(con, ...) {
  call <- check_no_dots(...)
  check_supplied("con", call)
  if (rlang::is_string(con) && con != ":memory:") {
    need_package("DBI", "Recording runs", call)
    need_package("RSQLite", "A file of records", call)
    path <- link_target(check_file_name(con, call, "con"))
    made <- if (!file.exists(path)) make_file(path, call)
    if (!is.null(made)) return(invisible(made))
  }
  db <- open_records(con, call, made = FALSE)
  on.exit(db$close())
  found <- db$version
  if (is.null(found)) return(invisible(make_tables(db, call)))
  check_format(found, call)
  if (!identical(found$rotdyn_version, own_version())) refresh_metadata(db, call)
  invisible(character())
}

#' @rdname records_create
#' @export
records_add <- function(con, motion, ..., note = NULL, rows = "some") {
  call <- check_no_dots(...)
  check_supplied(c("con", "motion"), call)
  check_class(motion, "rot_trajectory", "motion", "Compute one with {.fn trajectory}.", call)
  if (!is.null(note)) note <- check_name(note, "note", call)
  rows <- check_string(rows, "rows", c("some", "all"), call)
  scene <- text_of_motion(motion, call)
  if (is.unsorted(motion$time_s)) {
    abort_rotdyn(c(
      "The rows of {.arg motion} must be in the order of their times, as a run gives them.",
      i = "{.code motion[order(motion$time_s), ]}"
    ), "time", call)
  }
  db <- connect_records(con, call)
  on.exit(db$close())
  write_record(db, motion, scene, note, rows, NA_character_, call)
}

#' @rdname records_create
#' @export
records_list <- function(con, ...) {
  call <- check_no_dots(...)
  check_supplied("con", call)
  db <- open_records(con, call)
  on.exit(db$close())
  run_list(query(db, paste(list_sql, "ORDER BY r.recorded_utc, r.run"), call = call))
}

#' @rdname records_create
#' @export
records_read <- function(con, run, ...) {
  call <- check_no_dots(...)
  check_supplied(c("con", "run"), call)
  db <- open_records(con, call)
  on.exit(db$close())
  read_record(db, run, call)
}

#' @rdname records_create
#' @export
records_rerun <- function(con, run, ..., store = FALSE) {
  call <- check_no_dots(...)
  check_supplied(c("con", "run"), call)
  store <- check_flag(store, "store", call)
  db <- open_records(con, call)
  on.exit(db$close())
  old <- read_record(db, run, call)
  known <- names(constraint_of(old$scene)$models)
  if (old$model_asked && !old$model %in% known) {
    abort_rotdyn(c(
      "The model of this run exists no more.",
      x = "It is {.val {old$model}}; {.val {known}} {?is/are} known to rotdyn {own_version()}.",
      i = "{.fn records_read} gives the scene, for another model."
    ), "record", call)
  }
  motion <- withCallingHandlers(
    compute_trajectory(
      old$scene, old$times_s, old$accuracy, if (old$model_asked) old$model, "abort",
      old$max_steps, call, old$step_s, if ("event" %in% old$columns) NA else FALSE
    ),
    rotdyn_warning_accuracy = function(w) rlang::cnd_muffle(w)
  )
  result <- compare_record(old, motion)
  if (store) {
    scene <- text_of_motion(motion, call)
    result$new_run <- write_record(db, motion, scene, NULL, "some", old$run, call)
  }
  result
}

#' @rdname records_create
#' @export
records_check <- function(con, ...) {
  call <- check_no_dots(...)
  check_supplied("con", call)
  db <- open_records(con, call)
  on.exit(db$close())
  checks <- list()
  say <- function(check, holds, detail = "") {
    checks[[length(checks) + 1L]] <<- list(check = check, holds = holds, detail = detail)
  }
  first <- function(x) if (length(x)) x[1] else ""
  tables <- all_tables()
  data <- lapply(tables, function(table) {
    columns <- paste(names(table$columns), collapse = ", ")
    plain_rows(query(db, paste("SELECT", columns, "FROM", table$sql), call = call), table)
  })
  invalid <- names(Filter(function(rows) isTRUE(attr(rows, "damaged")), data))
  say("types and encodings of values", !length(invalid), first(invalid))
  faults <- schema_faults(data, tables)
  say(
    "keys, checks and references", nrow(faults) == 0L,
    first(sprintf("%s, row %s: %s", faults$table, faults$row, faults$fault))
  )
  hashes <- vapply(as.character(data$scenes$json), hash_text, "", USE.NAMES = FALSE)
  wrong <- data$scenes$scene[hashes != data$scenes$scene]
  say("hashes of the scenes", !length(wrong), first(wrong))
  lost <- data$scenes$scene[!vapply(data$scenes$json, can_be_read, NA, USE.NAMES = FALSE)]
  say("every scene can be read", !length(lost), first(lost))
  timeless <- data$runs$run[!as.logical(Map(function(text, rows) {
    if (is.na(rows)) rows <- Inf
    tryCatch(is.double(read_times(text, call, rows)), rotdyn_error = function(e) FALSE)
  }, data$runs$times, data$runs$row_count))]
  say("the times of every run can be read", !length(timeless), first(timeless))
  without <- setdiff(data$runs$run[data$runs$row_count > 0], data$run_values$run)
  say("every run has its values", !length(without), first(without))
  rows <- data$runs$row_count[match(data$run_values$run, data$runs$run)]
  beyond <- data$run_values$run[(data$run_values$place > rows) %in% TRUE]
  say("values are of rows of their run", !length(beyond), first(beyond))
  own <- metadata()
  missing <- unlist(lapply(names(own), function(name) {
    key <- tables[[name]]$key
    lost <- setdiff(do.call(paste, own[[name]][key]), do.call(paste, data[[name]][key]))
    if (length(lost)) paste(name, lost)
  }))
  say("metadata of this version", !length(missing), first(missing))
  if (db$dialect == "sqlite") {
    whole <- as.character(query(db, "PRAGMA integrity_check", call = call)[[1]])
    sound <- identical(whole, "ok")
    say("integrity of the file", sound, if (sound) "" else whole[1])
    broken <- query(db, "PRAGMA foreign_key_check", call = call)
    say("references of the file", nrow(broken) == 0L, first(as.character(broken[[1]])))
  }
  do.call(rbind, lapply(checks, table_from))
}

# Tables, rows and views as a script.
metadata_sql <- function(file, dialect, call) {
  dialect <- check_string(dialect, "dialect", c("sqlite", "postgresql", "duckdb"), call)
  known <- metadata()
  tables <- metadata_tables()
  rows <- unlist(lapply(names(known), function(name) insert_sql(known[[name]], tables[[name]]$sql)))
  format <- sprintf(
    "INSERT INTO rot_format VALUES (%d, '%s', '%s')", records_format, own_version(), utc_now()
  )
  script <- paste0(
    "-- Metadata and empty tables of records, rotdyn ", own_version(), ", for ", dialect, ".\n",
    if (dialect == "sqlite") "PRAGMA foreign_keys = ON;\n", "BEGIN;\n",
    paste0(c(schema_sql(dialect), rows, format), ";\n", collapse = ""), "COMMIT;\n"
  )
  if (is.null(file)) return(script)
  write_file(charToRaw(enc2utf8(script)), check_file_name(file, call), call)
  invisible(script)
}

# One statement for each row, with all digits.
insert_sql <- function(rows, table) {
  values <- vapply(rows, function(x) {
    written <- if (is.character(x)) {
      paste0("'", gsub("'", "''", enc2utf8(x), fixed = TRUE), "'")
    } else {
      .Call(ffi_text_numbers, as.double(x))
    }
    ifelse(is.na(x), "NULL", written)
  }, character(nrow(rows)))
  values <- matrix(values, nrow(rows))
  paste0(
    "INSERT INTO ", table, " (", paste(names(rows), collapse = ", "), ") VALUES (",
    apply(values, 1, paste, collapse = ", "), ")"
  )
}

#' @export
print.rot_rerun <- function(x, ...) {
  say("<rot_rerun> ", x$verdict, "\n")
  say("  run      ", x$run, "\n")
  say("  model    ", paste(unique(x$model), collapse = " then, now "), "\n")
  say("  rotdyn   ", paste(unique(x$versions), collapse = " then, now "), "\n")
  worst <- x$where[1L, ]
  if (x$verdict != "identical" && length(x$not_compared)) {
    say("  unknown  ", paste(x$not_compared, collapse = ", "), ": no values are kept\n")
  }
  for (name in names(x$texts)) {
    rows <- x$texts[[name]]
    say(
      "  text     ", name, " is another one in row", if (length(rows) > 1L) "s", " ",
      paste(rows[seq_len(min(6L, length(rows)))], collapse = ", "),
      if (length(rows) > 6L) paste(" and", length(rows) - 6L, "more"), "\n"
    )
  }
  if (x$verdict != "identical" && nrow(x$where)) {
    say(
      "  most     ", worst$quantity, " in row ", worst$row, ": ", format(worst$then, digits = 17),
      " then, ", format(worst$now, digits = 17), " now; allowed ",
      format(worst$allowed, digits = 2), "\n"
    )
  }
  invisible(x)
}
