# A run as rows of the database, and back.

# Identifier of a run: time in ms, counter, digits of a hash. Sorts by creation; does not touch
# .Random.seed.
new_run_name <- function() {
  count <- (registry_texts$runs %||% 0) + 1
  registry_texts$runs <- count
  time_ms <- floor(as.double(Sys.time()) * 1000)
  if (is.null(registry_texts$machine)) registry_texts$machine <- Sys.info()[["nodename"]]
  digits <- rlang::hash(
    list(time_ms, Sys.getpid(), count, tempdir(), registry_texts$machine, proc.time()[[1]])
  )
  sprintf(
    "%07x%s-%s-%04x-%s-%s", time_ms %/% 2^20, substr(sprintf("%05x", time_ms %% 2^20), 1L, 1L),
    substr(sprintf("%05x", time_ms %% 2^20), 2L, 5L), count %% 65536, substr(digits, 1L, 4L),
    substr(digits, 5L, 16L)
  )
}

# The software of this session.
own_software <- function() {
  if (is.null(registry_texts$software)) {
    library <- getLoadedDLLs()[["rotdyn"]][["path"]]
    parts <- list(
      rotdyn_version = own_version(),
      library_hash = tryCatch(rlang::hash_file(library), error = function(e) strrep("0", 32L)),
      r_version = paste(R.version$major, R.version$minor, sep = "."), platform = R.version$platform
    )
    registry_texts$software <- c(list(software = rlang::hash(parts)), parts)
  }
  registry_texts$software
}

# The hash of columns, by name, type and bits; the same on machines of either byte order.
hash_columns <- function(motion, columns) {
  values <- unclass(motion)[sort(columns, method = "radix")]
  heads <- paste0(names(values), "\003", vapply(values, typeof, ""), "\003")
  parts <- Map(function(head, x) {
    if (is.character(x)) {
      x <- charToRaw(enc2utf8(paste(ifelse(is.na(x), "\001", x), collapse = "\002")))
    }
    list(charToRaw(head), x)
  }, heads, values, USE.NAMES = FALSE)
  .Call(ffi_hash, unlist(parts, FALSE, FALSE))
}

# Times as text: a grid where it gives the same doubles.
times_text <- function(time_s) {
  n <- length(time_s)
  if (n > 2L) {
    step <- (time_s[n] - time_s[1]) / (n - 1)
    for (by in unique(c(step, signif(step, 15), time_s[2] - time_s[1]))) {
      if (identical(grid_times(time_s[1], by, n), time_s)) {
        return(json_canonical(list(from = time_s[1], step = by, n = n)))
      }
    }
  }
  json_canonical(list(at = I(time_s)))
}

grid_times <- function(from, step, n) from + (seq_len(n) - 1) * step

# `rows`: how many the run has, at least one for each time.
read_times <- function(text, call, rows = Inf) {
  x <- read_json(text, "times", "record", call)
  damaged <- function() abort_rotdyn("The times of this run are damaged.", "record", call)
  if (setequal(names(x), c("from", "step", "n"))) {
    if (!all(lengths(x) == 1L) || !all(vapply(x, is.double, NA)) ||
      !(x$n >= 0 && x$n <= min(rows, 2^31 - 1))) {
      damaged()
    }
    return(grid_times(x$from, x$step, x$n))
  }
  if (!identical(names(x), "at") || !(is.double(x$at) || !length(x$at))) damaged()
  if (length(x$at) > rows || !all(is.finite(as.double(x$at)))) damaged()
  as.double(x$at)
}

# The time of each row; of one rotor where a time has a row for each. Times may repeat.
times_of_rows <- function(values, run) {
  index <- constraint_of(run$scene)$index
  if (is.null(index) || !length(values$time_s)) return(values$time_s)
  values$time_s[values[[index]] == values[[index]][1]]
}

# Of columns that the dictionary has for the first body alone (theta_3_rad: theta_1_rad), and of
# others that it lacks, rows for the table of quantities.
more_quantities <- function(names) {
  known <- metadata()$quantities
  names <- setdiff(names, known$quantity)
  at <- match(first_of(names), known$quantity)
  number <- sub("^[^0-9]*_([0-9]+)_.*", "\\1", names)
  list(
    quantity = names, unit = known$unit[at],
    meaning = ifelse(
      startsWith(names, text_mark), "a hash of each text, in the rows where it changes", ifelse(
        is.na(at), "a computed column", mapply(
          function(number, text) gsub("\\b1\\b", number, text), number, known$meaning[at]
        )
      )
    )
  )
}

# The name with the first body's number.
first_of <- function(names) sub("_[0-9]+_", "_1_", names)

# Columns of text have their values as numbers in the table of values: of each row that differs from
# the one before, the first 52 bits of a hash, under the name of the column with this before it.
text_mark <- "text of "
max_texts <- 10000L

hash_of_texts <- function(x) {
  known <- unique(x[!is.na(x)])
  digits <- vapply(known, hash_text, "", USE.NAMES = FALSE)
  number <- strtoi(substr(digits, 1L, 6L), 16L) * 2^28 + strtoi(substr(digits, 7L, 13L), 16L)
  number[match(x, known)]
}

# list(place, value); NULL of a column that changes too often.
kept_texts <- function(x) {
  code <- hash_of_texts(enc2utf8(x))
  n <- length(code)
  same <- code[-1] == code[-n] | is.na(code[-1]) & is.na(code[-n])
  place <- which(c(TRUE, !(same %in% TRUE))[seq_len(n)])
  if (length(place) <= max_texts) list(place = place, value = code[place])
}

# The rows in which columns of text are others than those of the record: a list by column; NULL for
# a column of which the record has no values.
differing_texts <- function(old, motion) {
  names <- unique(old$texts$quantity)
  lapply(stats::setNames(nm = names), function(name) {
    kept <- old$texts[old$texts$quantity == name, ]
    then <- kept$value[findInterval(seq_len(old$row_count), kept$row)]
    if (!is.character(motion[[name]]) || nrow(motion) != old$row_count) {
      return(seq_len(old$row_count))
    }
    now <- hash_of_texts(enc2utf8(motion[[name]]))
    which(!(now == then | is.na(now) & is.na(then)) %in% TRUE)
  })
}

# Rows to keep of each column: first, quarters, last, where it is largest.
kept_rows <- function(x, rows) {
  n <- length(x)
  if (rows == "all" || n <= 6L) return(seq_len(n))
  quarters <- c(1, 1 + (n - 1) %/% 4, 1 + (n - 1) %/% 2, n - (n - 1) %/% 4, n)
  # Of a logical column that is the row of an event, whose time has an error.
  largest <- if (is.numeric(x)) which.max(abs(x))
  if (length(largest) && !largest %in% quarters) c(quarters, largest) else quarters
}

special_of <- function(x) {
  out <- rep(NA_character_, length(x))
  odd <- which(!is.finite(x) | x == 0)
  y <- x[odd]
  out[odd] <- ifelse(
    is.nan(y), "NaN", ifelse(
      is.na(y), "NA", ifelse(is.infinite(y), as.character(y), ifelse(1 / y < 0, "-0", NA))
    )
  )
  out
}

value_of <- function(value, special) {
  known <- c("NA" = NA_real_, "NaN" = NaN, "Inf" = Inf, "-Inf" = -Inf, "-0" = -0)
  at <- !is.na(special)
  value[at] <- known[special[at]]
  as.double(value)
}

# Text and hash of the scene of a motion. Those of the last scene are kept: a text takes 0.5 ms.
text_of_motion <- function(motion, call) {
  scene <- check_trajectory(motion, "motion", call)$scene
  last <- registry_texts$last
  # The last one is kept, so that no other scene has its address. Comparing parts would take long
  # for bodies that share theirs.
  same <- !is.null(last) && rlang::obj_address(scene) == rlang::obj_address(last$scene)
  if (!same) {
    text <- scene_text(scene, call)
    last <- list(scene = scene, text = text, hash = hash_text(text))
    registry_texts$last <- last
  }
  last
}

write_record <- function(db, motion, scene, note, rows, repeats, call) {
  run <- trajectory_run(motion)
  verdict <- tryCatch(
    suppressWarnings(verdict_of_motion(motion, run, call)),
    rotdyn_error = function(e) "not audited"
  )
  columns <- computed_columns(motion, run)
  values <- unclass(motion)
  row_count <- nrow(motion)
  numbers <- columns[vapply(values[columns], function(x) is.numeric(x) || is.logical(x), NA)]
  kept <- lapply(values[numbers], kept_rows, rows)
  value <- Map(function(x, at) as.double(x)[at], values[numbers], kept)
  texts <- columns[vapply(values[columns], is.character, NA)]
  texts <- Filter(Negate(is.null), lapply(values[texts], kept_texts))
  names(texts) <- paste0(text_mark, names(texts), recycle0 = TRUE)
  kept <- c(kept, lapply(texts, `[[`, "place"))
  value <- c(value, lapply(texts, `[[`, "value"))
  # The length of steps is a value of the run: a database of an older version has no place for it
  # but this.
  if (!is.null(run$step_s) && row_count > 0L) {
    kept$step_s <- 1L
    value$step_s <- run$step_s
  }
  numbers <- names(kept)
  value <- unlist(value, FALSE, FALSE)
  special <- special_of(value)
  software <- own_software()
  name <- new_run_name()
  info <- run$info
  rows <- list(
    scenes = list(
      scene = scene$hash, constraint_kind = constraint_of(run$scene)$id,
      scene_format = scene_format, json = scene$text
    ),
    software = software, quantities = more_quantities(numbers),
    runs = list(
      run = name, scene = scene$hash, software = software$software, model = run$model,
      model_asked = as.integer(isTRUE(run$asked)), accuracy = run$accuracy,
      max_steps = run$max_steps, error = finite_or_na(info$error), error_kind = run$error_kind,
      verdict = verdict, row_count = row_count, times = times_text(times_of_rows(values, run)),
      column_names = paste(columns, collapse = " "), result_hash = hash_columns(motion, columns),
      errors = errors_text(info), recorded_utc = utc_now(), repeats = repeats,
      note = note %||% NA_character_
    ),
    run_values = list(
      run = rep(name, length(value)), quantity = rep(numbers, lengths(kept)),
      place = unlist(kept, FALSE, FALSE), value = ifelse(is.na(special), value, NA),
      special = special
    )
  )
  if (!add_at_once(db, rows, call)) add_checked(db, rows, call)
  registry_texts$recorded <- scene_place(db, scene$hash)
  name
}

# Without a look at the tables, which takes a tenth of a record's time, nor at the software's row:
# FALSE, and nothing is added, where the keys refuse the run.
add_at_once <- function(db, rows, call) {
  if (db$dialect != "sqlite") return(FALSE)
  tryCatch(
    {
      whole_or_none(db, {
        known <- identical(registry_texts$recorded, scene_place(db, rows$scenes$scene))
        if (!known) {
          append_rows(db, "scenes", rows$scenes, "new")
          append_rows(db, "quantities", rows$quantities, "new")
        }
        append_rows(db, "runs", rows$runs, "checked")
        append_rows(db, "run_values", rows$run_values)
      })
      TRUE
    },
    error = function(e) {
      if (grepl("locked", conditionMessage(e), fixed = TRUE)) abort_database(e, call)
      FALSE
    }
  )
}

# Where this session recorded a scene last.
scene_place <- function(db, hash) {
  if (db$dialect == "sqlite") c(db$con@dbname, hash)
}

add_checked <- function(db, rows, call) {
  db <- check_records(db, call, scene = rows$scenes$scene)
  if (!identical(db$version$rotdyn_version, own_version())) refresh_metadata(db, call)
  in_transaction(db, call, {
    # Another session may have added them meanwhile.
    if (!db$version$has_scene) append_rows(db, "scenes", rows$scenes, "new")
    if (!db$version$has_software) append_rows(db, "software", rows$software, "new")
    append_rows(db, "quantities", rows$quantities, "new")
    append_rows(db, "runs", rows$runs)
    append_rows(db, "run_values", rows$run_values)
  })
}

# Of all balances that can be drawn, from the first row to the last: they do not see an edited row
# between.
verdict_of_motion <- function(motion, run, call) {
  verdict <- vapply(balances_of(motion, run, call), `[[`, "", "verdict")
  if ("unbalanced" %in% verdict) return("unbalanced")
  edited <- is.na(run$info$error)
  if (length(verdict) && all(verdict %in% "balanced") && !edited) "balanced" else "not audited"
}

# By measure: its largest value and its error.
errors_text <- function(info) {
  pairs <- Map(c, as.double(info$sizes[names(info$errors)]), as.double(info$errors))
  json_canonical(stats::setNames(pairs, names(info$errors)))
}

read_errors <- function(text, call) {
  x <- read_json(text, "errors of a run", "record", call)
  fits <- vapply(x, function(pair) is.double(pair) && length(pair) == 2L, NA)
  if (!all(fits)) abort_rotdyn("The errors of this run are damaged.", "record", call)
  number <- function(i) vapply(x, `[`, double(1), i, USE.NAMES = FALSE)
  as_table(measure = names(x) %||% character(), size = number(1L), error = number(2L))
}

finite_or_na <- function(x) ifelse(is.finite(x), x, NA_real_)

column_names <- function() metadata()$quantities$quantity

list_sql <- "SELECT r.run AS run, r.recorded_utc AS recorded_utc,
  s.constraint_kind AS constraint_kind, r.model AS model, r.accuracy AS accuracy,
  r.error AS error, r.error_kind AS error_kind,
  r.verdict AS verdict, r.row_count AS row_count, v.rotdyn_version AS rotdyn_version,
  r.scene AS scene_hash, r.repeats AS repeats, r.note AS note
FROM rot_run r JOIN rot_scene s ON s.scene = r.scene
  JOIN rot_software v ON v.software = r.software"

run_list <- function(rows) {
  for (name in c("accuracy", "error", "row_count")) rows[[name]] <- as_numbers(rows[[name]])
  for (name in setdiff(names(rows), c("accuracy", "error", "row_count"))) {
    rows[[name]] <- if (is.list(rows[[name]])) NA_character_ else as.character(rows[[name]])
  }
  attr(rows, "damaged") <- NULL
  table_from(rows)
}

# The full name of a run, from its beginning.
find_run <- function(db, run, call) {
  if (!rlang::is_string(run) || !grepl("^[0-9a-f-]{1,36}$", run)) {
    abort_rotdyn(c(
      "{.arg run} must be the name of a run.", x = "It is {describe_value(run)}.",
      i = "{.fn records_list} lists them."
    ), if (rlang::is_string(run)) "record" else "type", call)
  }
  found <- query(
    db, "SELECT run FROM rot_run WHERE run LIKE ? ORDER BY run LIMIT 3", list(paste0(run, "%")),
    call
  )$run
  if (length(found) != 1L) {
    abort_rotdyn(c(
      if (length(found)) "Several runs begin with {.val {run}}." else
        "There is no run {.val {run}}.",
      i = "{.fn records_list} lists them."
    ), "record", call)
  }
  found
}

read_record <- function(db, run, call) {
  name <- find_run(db, run, call)
  listed <- query(db, paste(list_sql, "WHERE r.run = ?"), list(name), call)
  # The rows of the run, in tables of their own, as the schema has them.
  tables <- record_tables()
  rows <- list()
  rows_of <- function(table, key, value, more = "") {
    sql <- paste(
      "SELECT", paste(names(tables[[table]]$columns), collapse = ", "), "FROM", tables[[table]]$sql,
      "WHERE", key, "= ?", more
    )
    found <- query(db, sql, list(value), call)
    rows[[table]] <<- plain_rows(found, tables[[table]])
    check_record_rows(rows[[table]], tables[[table]], table, name, call)
  }
  rows_of("runs", "run", name)
  if (!nrow(listed)) abort_damaged(name, "Its scene or its software is missing.", call)
  rows_of("scenes", "scene", rows$runs$scene)
  rows_of("software", "software", rows$runs$software)
  rows_of("run_values", "run", name, "ORDER BY quantity, place")
  more <- rows$runs
  values <- rows$run_values
  if (any(values$place > more$row_count)) {
    abort_damaged(name, "A value is of a row that the run has not.", call)
  }
  scene <- withCallingHandlers(
    scene_of_text(rows$scenes$json, call),
    rotdyn_message = function(m) rlang::cnd_muffle(m),
    rotdyn_warning = function(w) rlang::cnd_muffle(w)
  )
  if (!inherits(scene, "rot_scene")) {
    abort_rotdyn("The text of this run is no scene.", "record", call)
  }
  listed <- run_list(listed)
  number <- value_of(values$value, values$special)
  is_step <- values$quantity == "step_s"
  is_text <- startsWith(values$quantity, text_mark)
  of <- function(rows, names) {
    as_table(quantity = names[rows], row = values$place[rows], value = number[rows])
  }
  c(as.list(listed), list(
    scene_text = rows$scenes$json, scene = scene,
    times_s = read_times(more$times, call, more$row_count), model_asked = more$model_asked == 1,
    max_steps = more$max_steps, step_s = if (any(is_step)) number[is_step][1],
    columns = strsplit(more$column_names, " ", fixed = TRUE)[[1]], result_hash = more$result_hash,
    errors = read_errors(more$errors, call),
    values = of(!is_step & !is_text, values$quantity),
    texts = of(is_text, substring(values$quantity, nchar(text_mark) + 1L)),
    software = as.list(rows$software)[c(
      "rotdyn_version", "software", "library_hash", "r_version", "platform"
    )]
  ))
}

# Types, missing values and ranges of the rows of a run; references are the database's.
check_record_rows <- function(rows, table, name, run, call) {
  if (isTRUE(attr(rows, "damaged"))) {
    abort_damaged(run, "It has values of a wrong type, or text that is not UTF-8.", call)
  }
  if (name != "run_values" && nrow(rows) != 1L) {
    abort_damaged(run, paste0("It has ", nrow(rows), " rows in the table of ", name, "."), call)
  }
  table$columns <- lapply(table$columns, function(column) {
    column["refers"] <- list(NULL)
    column
  })
  tables <- stats::setNames(list(table), name)
  faults <- schema_faults(stats::setNames(list(as.data.frame(rows)), name), tables)
  if (nrow(faults)) {
    abort_damaged(run, paste0("In the table of ", name, ": ", faults$fault[1], "."), call)
  }
}

abort_damaged <- function(run, why, call) {
  abort_rotdyn(c("The record {.val {run}} is damaged.", x = braces_doubled(why)), "record", call)
}

can_be_read <- function(text) {
  tryCatch({
    suppressWarnings(suppressMessages(scene_of_text(text, NULL)))
    TRUE
  }, error = function(e) FALSE)
}

# The record and a new motion: verdict and where they differ most.
compare_record <- function(old, motion) {
  run <- trajectory_run(motion)
  present <- all(old$columns %in% names(motion)) && nrow(motion) == old$row_count
  same <- present && identical(hash_columns(motion, old$columns), old$result_hash)
  where <- compare_values(old, motion, run)
  texts <- differing_texts(old, motion)
  verdict <- if (same) {
    "identical"
  } else if (present && all(where$difference <= where$allowed) && !any(lengths(texts))) {
    "within errors"
  } else {
    "differs"
  }
  compared <- if (old$row_count > 0) c(old$values$quantity, names(texts)) else old$columns
  result <- list(
    verdict = verdict, where = where, run = old$run, model = c(then = old$model, now = run$model),
    versions = c(then = old$rotdyn_version, now = own_version()),
    texts = Filter(length, texts), not_compared = setdiff(old$columns, compared), motion = motion
  )
  class(result) <- "rot_rerun"
  result
}

# What the errors allow of a column: those of its measure, else those of all, relative to its size.
compare_values <- function(old, motion, run) {
  measures <- constraint_of(run$scene)$measures
  owner <- unlist(lapply(names(measures), function(name) {
    stats::setNames(rep(name, length(measures[[name]]$columns)), measures[[name]]$columns)
  }))
  then_error <- stats::setNames(old$errors$error, old$errors$measure)
  eps <- .Machine$double.eps
  worst <- max(old$error, run$info$error, 0, na.rm = TRUE)
  rows <- lapply(unique(old$values$quantity), function(name) {
    kept <- old$values[old$values$quantity == name, ]
    now <- if (name %in% names(motion)) as.double(motion[[name]])[kept$row] else NA_real_
    now <- rep_len(now, nrow(kept))
    then <- kept$value
    difference <- abs(now - then)
    both <- (is.na(now) & is.na(then) & is.nan(now) == is.nan(then)) | (now == then) %in% TRUE
    difference[both] <- 0
    difference[is.na(difference)] <- Inf
    size <- max(abs(c(then, now))[is.finite(c(then, now))], 0)
    of <- if (name %in% names(owner)) owner[name] else owner[first_of(name)]
    allowed <- if (name %in% c("time_s", constraint_of(run$scene)$index) ||
      is.logical(motion[[name]])) {
      0
    } else if (!is.na(of)) {
      sum(then_error[of], run$info$errors[of], na.rm = TRUE) + 2 * eps * size
    } else {
      # Energies and torques are of second order in the state.
      4 * worst * size + 4 * eps * size
    }
    at <- which.max(difference)
    list(
      quantity = name, row = kept$row[at], time_s = motion$time_s[kept$row[at]] %||% NA_real_,
      then = then[at], now = now[at], difference = difference[at], allowed = allowed
    )
  })
  where <- do.call(rbind, lapply(rows, table_from))
  if (is.null(where)) {
    where <- as_table(
      quantity = character(), row = double(), time_s = double(), then = double(), now = double(),
      difference = double(), allowed = double()
    )
  }
  excess <- where$difference / pmax(where$allowed, .Machine$double.xmin)
  where[order(excess, decreasing = TRUE), ]
}
