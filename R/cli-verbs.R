# The verbs of the command line, a record each: help, completion and tests are made from this table.
#   name, usage (its words), words (least, most), help (lines), options, needs (options by name),
#   example, values (function of the verbs: words that completion offers first);
#   run(words, options, state) returns what cli-output.R writes.

cli_verb <- function(name, usage, words, help, options, run, needs = NULL, example = NULL,
                     values = NULL) {
  list(name = name, usage = usage, words = words, help = help, options = options, run = run,
       needs = needs, example = example, values = values)
}

cli_shape_names <- function(...) shape_table()$shape

cli_verbs <- function() {
  c(cli_motion_verbs(), cli_table_verbs(), cli_record_verbs(), cli_sweep_verbs(),
    cli_batch_verbs(), cli_list_verbs())
}

# ---- input --------------------------------------------------------------------------------------

# The text of a file, or of standard input, with a fault where there is none.
cli_read_text <- function(path, state) {
  standard <- path == "-"
  if (standard && isTRUE(state$read)) abort_usage("standard input can be read once")
  state$file <- if (standard) "standard input" else path
  if (!standard && dir.exists(path)) abort_input("this is a folder, not a file")
  if (!standard && !file.exists(path)) abort_input("there is no such file")
  if (standard) state$read <- TRUE
  text <- tryCatch(
    suppressWarnings(file_text(if (standard) state$input else path)), error = identity
  )
  if (inherits(text, "error")) abort_input("it cannot be read: ", conditionMessage(text))
  if (is.na(text)) abort_input("it has a zero byte: it is no text in UTF-8")
  if (!validUTF8(text)) abort_input("it is not valid UTF-8")
  lines <- strsplit(gsub("\r\n?", "\n", text), "\n", fixed = TRUE)[[1]]
  if (!any(nzchar(trimws(lines)))) abort_input("it is empty")
  sub("^\ufeff", "", lines)
}

# A table of comma-separated values, with names in its first line.
cli_read_table <- function(path, state) {
  lines <- cli_read_text(path, state)
  cli_table(lines)
}

cli_table <- function(lines) {
  cells <- cli_table_cells(lines)
  columns <- lapply(cells$columns, function(x) utils::type.convert(x, "NA", as.is = TRUE))
  new_table(stats::setNames(columns, cells$names))
}

# list(names =, columns =) of text. read.csv() shifts a row that has a cell too many, or makes two
# rows of it. Messages name the line in the file: of a row with line breaks in quotes, the last one.
cli_table_cells <- function(lines) {
  connection <- textConnection(lines, encoding = "UTF-8")
  on.exit(close(connection))
  # NA: the row continues on the next line.
  count <- utils::count.fields(
    connection, sep = ",", quote = "\"", blank.lines.skip = FALSE, comment.char = ""
  )
  cli_check_quotes(lines, count)
  used <- is.na(count) | count > 1L | nzchar(trimws(lines))
  cells <- scan(
    text = lines[used], what = "", sep = ",", quote = "\"", strip.white = TRUE, comment.char = "",
    na.strings = character(), encoding = "UTF-8", quiet = TRUE
  )
  line <- which(used & !is.na(count))
  count <- count[line]
  if (sum(count) != length(cells)) abort_input("it is no table with commas")
  header <- cli_table_names(cells[seq_len(count[1])], line[1])
  if (length(line) == 1L) abort_input("it has no row below its names")
  n <- length(header)
  names_said <- paste0("line ", line[1], " has ", cli_number_of(n, "name"))
  at <- sequence(count)
  row <- rep(seq_along(line), count)
  odd <- which(row > 1L & at > n & nzchar(cells))[1]
  if (!is.na(odd)) {
    abort_input("line ", line[row[odd]], ": cell ", at[odd], " has no name; ", names_said)
  }
  short <- which(count < n)[1]
  if (!is.na(short)) {
    cells_said <- cli_number_of(count[short], "cell")
    abort_input("line ", line[short], " has ", cells_said, "; ", names_said)
  }
  list(names = header, columns = lapply(seq_len(n), function(i) cells[at == i & row > 1L]))
}

cli_number_of <- function(n, word) paste0(n, " ", word, if (n != 1L) "s")

# Two stray quotes, such as signs for inches, would make one row of the lines between them: a row of
# several lines must have its open quote at the start of a cell.
cli_check_quotes <- function(lines, count) {
  own <- count[seq_along(lines)]
  opens <- which(is.na(own) & !is.na(c(0L, own[-length(own)])))
  # count.fields() counts an unfinished row beyond the last line.
  if (length(count) != length(lines)) {
    abort_input("line ", max(opens, 1L), ": a quote is not closed")
  }
  quoted <- "\\s*+\"[^\"]*+(?:\"\"[^\"]*+)*+"
  proper <- paste0("^(?:(?:", quoted, "\"\\s*+|[^\",]*+),)*+", quoted, "$")
  stray <- opens[!grepl(proper, lines[opens], perl = TRUE)][1]
  if (!is.na(stray)) abort_input("line ", stray, ": a quote is not at the start of a cell")
}

# Spreadsheets write commas behind the last name; R and pandas write row labels without a name.
cli_table_names <- function(names, line) {
  named <- which(nzchar(names))
  if (!length(named)) abort_input("line ", line, " has no names")
  if (length(named) == 1L && grepl("[;\t]", names[named])) {
    abort_input("line ", line, ": commas must separate the names")
  }
  names <- names[seq_len(max(named))]
  if (!nzchar(names[1])) names[1] <- "row_name"
  empty <- which(!nzchar(names))
  if (length(empty)) abort_input("line ", line, ": column ", empty[1], " has no name")
  twice <- names[duplicated(names)]
  if (length(twice)) abort_input("line ", line, ": two columns have the name `", twice[1], "`")
  names
}

# Scenes: named list. A file has one scene, or one in each line (JSON lines). Without a file, an
# axle by options.
cli_scenes <- function(words, options, state, verb) {
  if (!length(words)) {
    axle <- cli_axle(options, state, verb)
    return(list(axle = axle))
  }
  given <- intersect(names(options), cli_axle_names())
  if (length(given)) {
    abort_usage("`--", given[1], "` describes an axle, and there is a scene, too", verb = verb)
  }
  scenes <- lapply(words, function(path) {
    lines <- cli_read_text(path, state)
    lines <- lines[nzchar(trimws(lines))]
    each <- all(grepl("^\\s*[{].*[}]\\s*$", lines))
    texts <- if (each) lines else paste(lines, collapse = "\n")
    made <- lapply(texts, scene_of_text, NULL)
    if (any(vapply(made, inherits, NA, "rot_body"))) abort_input("a body is no scene")
    stats::setNames(
      made, if (length(made) > 1L) paste0(path, ":", seq_along(made)) else path
    )
  })
  unlist(scenes, recursive = FALSE)
}

# Runs `of(scene)` for each, and binds the tables, with a column `scene` where there are several.
cli_each_scene <- function(scenes, state, of) {
  results <- Map(function(scene, name) {
    state$file <- if (length(scenes) > 1L || name != "axle") name
    of(scene)
  }, scenes, names(scenes))
  if (length(results) == 1L) return(results[[1]])
  tables <- Map(function(result, name) {
    c(list(scene = rep(name, nrow(result$table))), cli_plain_table(result$table))
  }, results, names(scenes))
  answers <- lapply(results, `[[`, "answer")
  texts <- Map(function(result, name) c(name, result$text, ""), results, names(scenes))
  list(
    table = cli_bind(tables),
    text = if (!is.null(results[[1]]$text)) unlist(texts, use.names = FALSE),
    answer = if (any(vapply(answers, isFALSE, NA))) FALSE else answers[[1]]
  )
}

# Rows of tables below each other; a column that one lacks is NA there.
cli_bind <- function(tables) {
  names <- unique(unlist(lapply(tables, names)))
  columns <- lapply(names, function(name) {
    unlist(lapply(tables, function(table) table[[name]] %||% rep(NA, length(table[[1]]))),
           use.names = FALSE)
  })
  new_table(stats::setNames(columns, names), nrow = length(columns[[1]]))
}

# ---- an axle by options -------------------------------------------------------------------------

cli_axle_options <- function() {
  list(
    cli_option("shape", "text", "of the body, one of `rotdyn shapes`, with its sizes",
               values = cli_shape_names),
    cli_option("moment-of-inertia-kg-m2", "number", "in place of a shape"),
    cli_option("mass-kg", "number", "of the shape"),
    cli_option("torque-n-m", "number", "a constant torque"),
    cli_option("torque-file", "file", "CSV with time_s,torque_n_m: straight lines, 0 outside"),
    cli_option("viscous-n-m-s", "number", "resistance per angular velocity"),
    cli_option("quadratic-n-m-s2", "number", "drag per angular velocity squared"),
    cli_option("coulomb-n-m", "number", "dry friction"),
    cli_option("theta0-rad", "number", "angle at the start"),
    cli_option("omega0-rad-per-s", "number", "angular velocity at the start")
  )
}

# Of every size that a shape may have.
cli_size_options <- function() {
  sizes <- size_table()
  Map(function(name, kind) {
    cli_option(gsub("_", "-", name), "number", if (kind == "count") "of a regular polygon" else
      "a size of the shape, in m")
  }, sizes$name, sizes$kind)
}

cli_axle_names <- function() {
  vapply(c(cli_axle_options(), unname(cli_size_options())), `[[`, "", "name")
}

cli_shape_options <- function() c("mass-kg", gsub("_", "-", size_table()$name))

cli_axle <- function(options, state, verb) {
  body <- options[["moment-of-inertia-kg-m2"]]
  if (is.null(body) == is.null(options$shape)) {
    abort_usage(
      "`", verb, "` needs a file with a scene, or `--shape`, or `--moment-of-inertia-kg-m2`",
      verb = verb
    )
  }
  of_shape <- intersect(names(options), cli_shape_options())
  if (!is.null(body) && length(of_shape)) {
    abort_usage(
      "`--", of_shape[1], "` and `--moment-of-inertia-kg-m2` exclude each other", verb = verb
    )
  }
  if (is.null(body)) body <- cli_body(options$shape, options, verb)
  torque <- options[["torque-n-m"]]
  if (!is.null(options[["torque-file"]])) {
    if (!is.null(torque)) {
      abort_usage("`--torque-n-m` and `--torque-file` exclude each other", verb = verb)
    }
    torque <- torque_knots(cli_read_table(options[["torque-file"]], state))
    state$file <- NULL
  }
  scene_axle(
    body, torque,
    resistance(
      options[["viscous-n-m-s"]] %||% 0, options[["quadratic-n-m-s2"]] %||% 0,
      options[["coulomb-n-m"]] %||% 0
    ),
    theta0_rad = options[["theta0-rad"]] %||% 0,
    omega0_rad_per_s = options[["omega0-rad-per-s"]] %||% 0
  )
}

# The row of inertia_table(), and the body, of a shape by options.
cli_shape <- function(shape, options, verb) {
  known <- shapes()
  at <- shape_ids(shape, shape_table())
  if (at == 0L) {
    near <- near_names(shape, known$shape)
    abort_usage(
      "unknown shape `", shape, "`", if (length(near)) paste0("; did you mean `", near[1], "`?"),
      verb = verb
    )
  }
  sizes <- size_table()$name
  given <- Filter(Negate(is.null), stats::setNames(options[gsub("_", "-", sizes)], sizes))
  needed <- shape_table()$names[[at]]
  lacking <- setdiff(needed, names(given))
  if (length(lacking)) {
    abort_usage("`--", gsub("_", "-", lacking[1]), "` is missing", verb = verb)
  }
  odd <- setdiff(names(given), needed)
  if (length(odd)) {
    abort_usage("`--", gsub("_", "-", odd[1]), "` is no size of `", shape, "`", verb = verb)
  }
  list(shape = shape_table()$shape[at], sizes = given[needed])
}

cli_body <- function(shape, options, verb) {
  found <- cli_shape(shape, options, verb)
  if (is.null(options[["mass-kg"]])) abort_usage("`--mass-kg` is missing", verb = verb)
  make <- get0(shape_constructor(found$shape) %||% "", topenv(), mode = "function")
  if (is.null(make)) abort_usage("`", shape, "` does not turn on an axle", verb = verb)
  do.call(make, c(list(mass_kg = options[["mass-kg"]]), found$sizes))
}

# ---- motions ------------------------------------------------------------------------------------

cli_motion_verbs <- function() {
  times <- cli_option("times", "times", "output times in s", aka = "time-s")
  accuracy <- cli_option("accuracy", "number", "largest relative error wanted", 1e-9)
  model <- cli_option("model", "text", "one of `rotdyn models`; without it the cheapest that fits",
                      values = function() models()$model)
  axle <- c(cli_axle_options(), unname(cli_size_options()))
  list(
    cli_verb(
      "trajectory", "[SCENE...]", c(0, Inf),
      c("the motion of scenes", "A scene is a file of JSON, `-`, or an axle by options."),
      c(list(times, accuracy, model), axle, list(
        cli_option("record", "file", "a database (SQLite file) that records the runs, too")
      )), cli_run_trajectory, "times",
      c("rotdyn trajectory wheel.json --times 0:8:0.01 > wheel.csv",
        "rotdyn trajectory --shape disk --mass-kg 2 --radius-m 0.25 --torque-n-m 0.8 --times 0:8:1")
    ),
    cli_verb(
      "choose", "[SCENE...]", c(0, Inf), "which model a scene takes, and why",
      c(list(times, accuracy), axle), cli_run_choose, "times",
      "rotdyn choose wheel.json --times 0:8:0.01 --accuracy 1e-12"
    ),
    cli_verb(
      "audit", "[SCENE...]", c(0, Inf),
      c("balances of energy and momentum", "Exit status 1 if any is unbalanced."),
      c(list(times, accuracy, model), axle), cli_run_audit, "times",
      "rotdyn audit wheel.json --times 0:8:0.01"
    ),
    cli_verb(
      "work-precision", "[SCENE...]", c(0, Inf), "cost and true error of every model, measured",
      c(list(
        times, cli_option("accuracies", "numbers", "accuracies to ask for", 10^-c(3, 6, 9, 12)),
        cli_option("min-batch-s", "number", "processor time of a batch", 0.02)
      ), axle), cli_run_work_precision, "times",
      "rotdyn work-precision wheel.json --times 0:8:0.1 --accuracies 1e-3,1e-9"
    )
  )
}

cli_model <- function(options, verb) {
  model <- options$model
  known <- models()$model
  if (!is.null(model) && !model %in% known) {
    near <- near_names(model, known)
    abort_usage(
      "unknown model `", model, "`", if (length(near)) paste0("; did you mean `", near[1], "`?"),
      verb = verb
    )
  }
  model
}

cli_run_trajectory <- function(words, options, state) {
  model <- cli_model(options, "trajectory")
  cli_each_scene(cli_scenes(words, options, state, "trajectory"), state, function(scene) {
    motion <- trajectory(scene, options$times, options$accuracy, model)
    run <- attr(motion, "run")
    message(run$model, ", error ", sub(" \\(.*\\)$", "", describe_error(run)))
    if (!is.null(options$record)) message("recorded as ", cli_record(options$record, motion))
    list(table = motion)
  })
}

cli_run_choose <- function(words, options, state) {
  cli_each_scene(cli_scenes(words, options, state, "choose"), state, function(scene) {
    choice <- choose_model(scene, options$times, options$accuracy)
    list(table = choice, text = cli_printed(choice))
  })
}

cli_run_audit <- function(words, options, state) {
  model <- cli_model(options, "audit")
  cli_each_scene(cli_scenes(words, options, state, "audit"), state, function(scene) {
    found <- audit(trajectory(scene, options$times, options$accuracy, model))
    list(
      table = found, text = cli_printed(found), answer = !any(found$verdict %in% "unbalanced")
    )
  })
}

cli_run_work_precision <- function(words, options, state) {
  cli_each_scene(cli_scenes(words, options, state, "work-precision"), state, function(scene) {
    list(table = work_precision(
      scene, options$times, accuracies = options$accuracies,
      min_batch_s = options[["min-batch-s"]]
    ))
  })
}

# ---- tables -------------------------------------------------------------------------------------

cli_table_verbs <- function() {
  gravity <- cli_option("gravity-m-per-s2", "number", "acceleration of gravity", 9.80665)
  angle <- cli_option(
    "angle-deg", "number", "angle of the incline", 20, aka = "incline-angle-deg"
  )
  bodies <- list(
    cli_option("beta", "numbers", "I/(m r^2); without bodies the five of the textbooks"),
    cli_option("objects", "texts", "names of shapes, such as hoop,sphere",
               values = cli_shape_names)
  )
  list(
    cli_verb(
      "roll", "[CSV]", c(0, 1),
      c("bodies that roll down an incline: accelerations, speeds, energies",
        "Columns of the table replace the options."),
      c(bodies, list(
        angle,
        cli_option("height-m", "number", "height lost", 1, aka = "height-drop-m"), gravity
      )), cli_run_roll, NULL,
      c("rotdyn roll", "rotdyn roll --beta 0.4 --angle-deg 20 --height-m 1")
    ),
    cli_verb(
      "race", "[CSV]", c(0, 1),
      c("bodies released together on an incline, in the order of the finish",
        "Columns of the table replace the options."),
      c(bodies, list(
        angle, cli_option("length-m", "number", "length of the incline", 1),
        cli_option("static-friction", "number", "its coefficient; Inf: no body slips", Inf),
        gravity,
        cli_option("frames", "number", "rows in time for each body, in place of the finish")
      )), cli_run_race, NULL, "rotdyn race --objects hoop,disk,sphere --angle-deg 10"
    ),
    cli_verb(
      "inertia", "[SHAPE|CSV]", c(0, 1), "moments of inertia",
      c(list(cli_option("mass-kg", "number", "mass of the shape")), unname(cli_size_options())),
      cli_run_inertia, NULL,
      c("rotdyn inertia disk --mass-kg 2 --radius-m 0.25", "rotdyn inertia bodies.csv"),
      cli_shape_names
    ),
    cli_verb(
      "check-inertia", "FILE...", c(1, Inf),
      c("whether tensors of inertia are physical: robot descriptions (URDF, SDF), CSV",
        "Exit status 1 if any is impossible."),
      list(), cli_run_check_inertia, NULL, "rotdyn check-inertia arm.urdf"
    ),
    cli_verb(
      "tumble", "CSV", c(1, 1),
      c("free bodies at a time, a row each",
        "Columns: ixx_kg_m2, ..., omega_x_rad_per_s, ..., perhaps qw, qx, qy, qz.",
        "A column time_s replaces the option."),
      list(cli_option("time-s", "number", "time since the start")), cli_run_tumble, NULL,
      "rotdyn tumble debris.csv --time-s 86400"
    ),
    cli_verb(
      "precess", "CSV", c(1, 1),
      c("rates of tops and gyroscopes",
        "Columns: mass_kg, lever_arm_m, moment_of_inertia_kg_m2, spin_rad_per_s.",
        "Columns of the names of the options replace these."),
      list(
        cli_option("axis-angle-deg", "number", "angle of the axis from the vertical", 90),
        cli_option("transverse-moment-kg-m2", "number", "about a line across the axis"), gravity
      ), cli_run_precess, NULL, "rotdyn precess tops.csv --axis-angle-deg 30"
    )
  )
}

# A table with the columns that R's function has. `arguments`: their names, by option; a column may
# have the name of the option, too. The function is given the options' defaults as arguments, and
# then takes no column for a misspelt argument: that is looked for here.
cli_option_columns <- function(table, arguments) {
  own <- stats::setNames(unname(arguments), gsub("-", "_", names(arguments)))
  own <- own[names(own) != own]
  for (name in intersect(names(own), names(table))) {
    if (own[[name]] %in% names(table)) {
      abort_input("the columns `", name, "` and `", own[[name]], "` exclude each other")
    }
    names(table)[names(table) == name] <- own[[name]]
  }
  check_near_columns(
    table, c(names(own), unname(arguments)), c(names(table), names(own)[own %in% names(table)]),
    column_table()$name, current_env()
  )
  table
}

# Bodies that roll: a table, betas, names, or the five.
cli_rolling_bodies <- function(words, options, state, verb, arguments) {
  given <- c(length(words) > 0L, !is.null(options$beta), !is.null(options$objects))
  if (sum(given) > 1L) {
    abort_usage("a table, `--beta` and `--objects` exclude each other", verb = verb)
  }
  if (given[1]) return(cli_option_columns(cli_read_table(words, state), arguments))
  if (given[2]) return(as_table(beta = options$beta))
  if (given[3]) return(options$objects)
  rolling_objects()
}

cli_run_roll <- function(words, options, state) {
  columns <- c(
    "angle-deg" = "incline_angle_deg", "height-m" = "height_drop_m",
    "gravity-m-per-s2" = "gravity_m_per_s2"
  )
  objects <- cli_rolling_bodies(words, options, state, "roll", columns)
  arguments <- stats::setNames(options[names(columns)], columns)
  if (is.data.frame(objects)) arguments <- arguments[setdiff(names(arguments), names(objects))]
  list(table = do.call(rolling_table, c(list(objects), arguments), quote = TRUE))
}

cli_run_race <- function(words, options, state) {
  columns <- c(
    "angle-deg" = "incline_angle_deg", "length-m" = "length_m",
    "static-friction" = "static_friction", "gravity-m-per-s2" = "gravity_m_per_s2"
  )
  objects <- cli_rolling_bodies(words, options, state, "race", columns)
  if (is.data.frame(objects) && "frames" %in% names(objects)) {
    abort_input("`frames` is no column of bodies; the option `--frames` is for all of them")
  }
  arguments <- stats::setNames(options[names(columns)], columns)
  race <- do.call(
    roll_race, c(list(objects), arguments, list(frames = options$frames %||% 2)), quote = TRUE
  )
  list(table = if (is.null(options$frames)) summary(race) else race)
}

cli_run_inertia <- function(words, options, state) {
  given <- intersect(names(options), cli_shape_options())
  if (length(words) && (words == "-" || file.exists(words) || grepl("[.]csv$", words))) {
    if (length(given)) {
      abort_usage("a table excludes `--", given[1], "`", verb = "inertia")
    }
    return(list(table = inertia_table(cli_read_table(words, state))))
  }
  if (!length(words)) {
    if (length(given)) abort_usage("`--", given[1], "` needs a shape", verb = "inertia")
    return(list(table = inertia_table()))
  }
  found <- cli_shape(words, options, "inertia")
  if (is.null(options[["mass-kg"]])) abort_usage("`--mass-kg` is missing", verb = "inertia")
  row <- c(list(shape = found$shape, mass_kg = options[["mass-kg"]]), found$sizes)
  list(table = inertia_table(new_table(row, nrow = 1L)))
}

cli_run_check_inertia <- function(words, options, state) {
  if (length(words) > 1L && "-" %in% words) {
    abort_usage("standard input stands alone", verb = "check-inertia")
  }
  checked <- lapply(words, function(path) {
    lines <- cli_read_text(path, state)
    if (any(grepl("^\\s*<", lines[nzchar(trimws(lines))][1]))) {
      file <- tempfile(fileext = ".xml")
      on.exit(unlink(file))
      write_file(lines, file, NULL)
      links <- read_links(file)
      return(list(
        file = rep(path, nrow(links)), object = links$link, verdict = links$verdict,
        fault = links$fault, suggestion = links$suggestion
      ))
    }
    check <- check_inertia(cli_table(lines))
    rows <- split(seq_len(nrow(check)), check$row)
    one <- function(of) unname(vapply(rows, of, ""))
    list(
      file = rep(path, length(rows)),
      object = one(function(i) check$object[i[1]] %|NA|% paste("row", check$row[i[1]])),
      verdict = one(function(i) worst_verdict(check$verdict[i])),
      fault = one(function(i) {
        if ("fails" %in% check$verdict[i]) link_fault(check[i, ]) else NA_character_
      }),
      suggestion = one(function(i) c(check$suggestion[i][!is.na(check$suggestion[i])], NA)[1])
    )
  })
  table <- cli_bind(checked)
  list(table = table, answer = !any(table$verdict == "fails"))
}

`%|NA|%` <- function(x, y) if (is.na(x)) y else x

cli_run_tumble <- function(words, options, state) {
  bodies <- cli_read_table(words, state)
  time_s <- options[["time-s"]]
  if (is.null(time_s) == is.null(bodies[["time_s"]])) {
    abort_usage(
      if (is.null(time_s)) "`--time-s` is missing" else
        "`--time-s` and a column `time_s` exclude each other", verb = "tumble"
    )
  }
  list(table = tumbling_table(bodies, time_s %||% bodies[["time_s"]]))
}

cli_run_precess <- function(words, options, state) {
  tops <- cli_read_table(words, state)
  list(table = precession_table(
    tops, options[["axis-angle-deg"]], options[["transverse-moment-kg-m2"]] %||% NA_real_,
    options[["gravity-m-per-s2"]]
  ))
}

# ---- records ------------------------------------------------------------------------------------

cli_record_verbs <- function() {
  motion <- Filter(function(option) {
    option$name != "record"
  }, cli_motion_verbs()[[1]]$options)
  list(
    cli_verb(
      "record", "DB [SCENE...]", c(1, Inf),
      c("computes scenes and records recipe and fingerprint in a database",
        "DB is an SQLite file, made where there is none."),
      c(motion, list(
        cli_option("note", "text", "any text"),
        cli_option("rows", "text", "which rows to keep", "some", c("some", "all"))
      )), cli_run_record, "times", "rotdyn record lab.sqlite wheel.json --times 0:8:0.01"
    ),
    cli_verb(
      "runs", "DB [RUN]", c(1, 2), c("the runs of a database; the values kept of one run",
                                     "With --check exit status 1 if the database is not sound."),
      list(cli_option("check", "flag", "keys, references, hashes of the database"),
           cli_option("scene", "flag", "the scene of the run, as text")),
      cli_run_runs, NULL, c("rotdyn runs lab.sqlite", "rotdyn runs lab.sqlite 3f2a --scene")
    ),
    cli_verb(
      "rerun", "DB [RUN...]", c(1, Inf),
      c("computes runs again from the database alone, and compares; without names all",
        "Exit status 1 if any differs by more than the errors allow."),
      list(cli_option("record", "flag", "records the new runs, too")), cli_run_rerun, NULL,
      "rotdyn rerun lab.sqlite"
    )
  )
}

cli_record <- function(db, motion, note = NULL, rows = "some") {
  if (!file.exists(db) || file.size(db) == 0) records_create(db)
  records_add(db, motion, note = note, rows = rows)
}

cli_database <- function(path, state) {
  state$file <- path
  if (dir.exists(path)) abort_input("this is a folder, not a database")
  if (!file.exists(path)) abort_input("there is no such file")
  path
}

cli_run_record <- function(words, options, state) {
  model <- cli_model(options, "record")
  db <- words[1]
  if (dir.exists(db)) cli_database(db, state)
  cli_each_scene(cli_scenes(words[-1L], options, state, "record"), state, function(scene) {
    motion <- trajectory(scene, options$times, options$accuracy, model)
    run <- cli_record(db, motion, options$note, options$rows)
    known <- records_list(db)
    list(table = known[known$run == run, ])
  })
}

cli_run_runs <- function(words, options, state) {
  db <- cli_database(words[1], state)
  if (isTRUE(options$check)) {
    if (length(words) > 1L || isTRUE(options$scene)) {
      abort_usage("`--check` is of the whole database: without a run", verb = "runs")
    }
    found <- records_check(db)
    return(list(table = found, answer = all(found$holds)))
  }
  if (length(words) == 1L) {
    if (isTRUE(options$scene)) abort_usage("`--scene` needs the name of a run", verb = "runs")
    return(list(table = records_list(db)))
  }
  run <- records_read(db, words[2])
  if (isTRUE(options$scene)) {
    return(list(lines = strsplit(write_scene(run$scene), "\n", fixed = TRUE)[[1]]))
  }
  list(table = run$values)
}

cli_run_rerun <- function(words, options, state) {
  db <- cli_database(words[1], state)
  runs <- if (length(words) > 1L) words[-1L] else records_list(db)$run
  again <- lapply(runs, function(run) {
    result <- records_rerun(db, run, store = isTRUE(options$record))
    worst <- if (nrow(result$where)) result$where[1, ]
    list(
      run = result$run, verdict = result$verdict, model = result$model[["now"]],
      quantity = worst$quantity %||% NA_character_, row = as.double(worst$row %||% NA),
      then = worst$then %||% NA_real_, now = worst$now %||% NA_real_,
      allowed = worst$allowed %||% NA_real_, new_run = result$new_run %||% NA_character_
    )
  })
  if (!length(again)) abort_input("it has no run")
  table <- cli_bind(again)
  list(table = table, answer = !any(table$verdict == "differs"))
}

# ---- lists --------------------------------------------------------------------------------------

cli_list_verbs <- function() {
  plain <- function(name, help, table) {
    cli_verb(name, "", c(0, 0), help, list(), function(words, options, state) {
      list(table = table())
    })
  }
  list(
    plain("shapes", "the standard shapes, with their formulas", function() shapes()),
    plain("models", "every model, with its equations and limits", function() models()),
    plain("columns", "the columns of all tables: unit, meaning", function() {
      new_table(column_table())
    }),
    cli_verb(
      "metadata", "[TABLE]", c(0, 1),
      "tables of units, constants, conventions, models, assumptions, cases",
      list(cli_option(
        "sql", "text", "all tables as a script for", NULL, c("sqlite", "postgresql", "duckdb")
      )),
      function(words, options, state) {
        if (!is.null(options$sql)) {
          if (length(words)) abort_usage("`--sql` writes all tables", verb = "metadata")
          return(list(lines = strsplit(metadata(dialect = options$sql), "\n", TRUE)[[1]]))
        }
        known <- metadata()
        if (!length(words)) {
          return(list(table = list(
            table = names(known), rows = unname(vapply(known, nrow, 1L))
          )))
        }
        if (!words %in% names(known)) {
          near <- near_names(words, names(known))
          abort_usage(
            "unknown table `", words, "`",
            if (length(near)) paste0("; did you mean `", near[1], "`?"), verb = "metadata"
          )
        }
        list(table = known[[words]])
      },
      example = c("rotdyn metadata units --format text",
                  "rotdyn metadata --sql sqlite | sqlite3 lab.sqlite"),
      values = function(verbs) names(metadata())
    ),
    cli_verb(
      "version", "", c(0, 0), "versions of this package and of R", list(),
      function(words, options, state) {
        list(lines = paste0(
          "rotdyn ", utils::packageVersion("rotdyn"), ", R ", getRversion()
        ))
      }
    ),
    cli_verb(
      "completion", "bash|zsh|fish", c(1, 1),
      "a script that completes verbs, options and their values", list(),
      function(words, options, state) {
        if (!words %in% cli_shells) {
          abort_usage("completion is for ", paste0("`", cli_shells, "`", collapse = ", "),
                      verb = "completion")
        }
        list(lines = cli_completion(state$verbs, words))
      },
      example = c("source <(rotdyn completion bash)", "rotdyn completion fish | source"),
      values = function(verbs) cli_shells
    ),
    cli_verb(
      "man", "[VERB]", c(0, 1), "a manual page in roff: of this command, or of a verb", list(),
      function(words, options, state) {
        verb <- if (length(words)) state$verbs[[words]]
        if (length(words) && is.null(verb)) {
          abort_usage("unknown verb `", words, "`", verb = "man")
        }
        list(lines = cli_manual(state$verbs, verb))
      },
      example = "rotdyn man trajectory > rotdyn-trajectory.1", values = names
    ),
    cli_verb("help", "[VERB]", c(0, 1), "this overview, or a verb's options", list(),
      function(words, options, state) {
        if (!length(words)) return(list(lines = cli_overview(state$verbs)))
        verb <- state$verbs[[words]]
        if (is.null(verb)) abort_usage("unknown verb `", words, "`")
        list(lines = cli_help(verb))
      }, values = names
    )
  )
}
