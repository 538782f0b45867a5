need <- function() {
  for (package in c("DBI", "RSQLite", "yyjsonr")) skip_if_not_installed(package)
}

new_lab <- function() {
  lab <- tempfile(fileext = ".sqlite")
  records_create(lab)
  lab
}

wheel <- function() {
  scene_axle(
    body_disk(2, 0.25), torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)),
    resistance(viscous_n_m_s = 0.03)
  )
}

asked <- function(lab, sql, ...) {
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  on.exit(DBI::dbDisconnect(con))
  DBI::dbExecute(con, "PRAGMA foreign_keys = ON")
  if (grepl("^SELECT", sql)) DBI::dbGetQuery(con, sql, ...) else DBI::dbExecute(con, sql, ...)
}

test_that("a run is recorded, listed, read and computed again", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  expect_identical(records_create(lab), character())
  motion <- trajectory(wheel(), seq(0, 8, by = 0.01))
  run <- records_add(lab, motion, note = "bearing 3 \u2014 it's \"new\"")
  expect_match(run, "^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$")
  listed <- records_list(lab)
  expect_identical(listed$run, run)
  expect_identical(listed$note, "bearing 3 \u2014 it's \"new\"")
  expect_identical(listed$row_count, 801)
  expect_identical(listed$scene_hash, scene_hash(wheel()))
  expect_identical(listed$verdict, "balanced")
  record <- records_read(lab, substr(run, 1, 8))
  expect_identical(record$scene, wheel())
  expect_identical(record$times_s, motion$time_s)
  expect_identical(record$error, attr(motion, "run")$info$error)
  at <- record$values[record$values$quantity == "omega_rad_per_s", ]
  expect_identical(at$value, motion$omega_rad_per_s[at$row])
  again <- records_rerun(lab, run)
  expect_identical(again$verdict, "identical")
  expect_true(all(again$where$difference == 0))
  expect_output(print(again), "identical")
  second <- records_rerun(lab, run, store = TRUE)$new_run
  expect_identical(records_list(lab)$repeats,
    c(NA, run)[match(records_list(lab)$run, c(run, second))])
  expect_true(all(records_check(lab)$holds))
})

test_that("what was tampered with is found: where most, and by how much", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  run <- records_add(lab, trajectory(wheel(), seq(0, 8, by = 0.5)))
  hash <- strrep("0", 32)
  asked(lab, "UPDATE rot_run SET result_hash = ?", params = list(hash))
  expect_identical(records_rerun(lab, run)$verdict, "within errors")
  asked(
    lab, "UPDATE rot_run_value SET value = value + 1e-6 WHERE quantity = 'omega_rad_per_s' AND
      place = (SELECT MAX(place) FROM rot_run_value)"
  )
  again <- records_rerun(lab, run)
  expect_identical(again$verdict, "differs")
  expect_identical(again$where$quantity[1], "omega_rad_per_s")
  expect_identical(again$where$row[1], 17)
  expect_equal(again$where$difference[1], 1e-6, tolerance = 1e-6)
  expect_output(print(again), "omega_rad_per_s in row 17")
  # Another scene under the hash of the first.
  asked(lab, "UPDATE rot_scene SET json = replace(json, '0.03', '0.04')")
  expect_identical(records_rerun(lab, run)$verdict, "differs")
  checked <- records_check(lab)
  expect_false(checked$holds[checked$check == "hashes of the scenes"])
})

test_that("scenes of every constraint come back identical in a new session", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  tilt <- attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  scenes <- list(
    wheel(), scene_rotors(c(1, 2), 1000, omega0_rad_per_s = c(1, .5)),
    scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)),
    scene_drive(
      c(1, 2), list(coupling_clutch(2)), omega0_rad_per_s = c(3, 0), brake = list(NULL, brake(1))
    ),
    scene_incline(body_sphere(1, .1), 30, static_friction = .1),
    scene_free(body_box(1, .1, .2, .3), c(1, 2, 3)),
    scene_pivot(
      c(.0042, .0042, .002), c(0, 0, 60), mass_kg = .5, centre_m = c(0, 0, .08), attitude0 = tilt
    ),
    scene_pendulum(body_rod_end(.1, 1), theta0_rad = 1),
    scene_gears(c(1, 2), 3, torque = c(1, 0))
  )
  for (scene in scenes) records_add(lab, trajectory(scene, c(0, sort(exp(-1:-9)), 2)))
  code <- sprintf(
    "library(rotdyn, lib.loc = '%s'); for (run in records_list('%s')$run)
      cat(records_rerun('%s', run)$verdict, '\n')",
    dirname(system.file(package = "rotdyn")), lab, lab
  )
  script <- tempfile(fileext = ".R")
  writeLines(code, script)
  r <- file.path(R.home("bin"), "Rscript")
  out <- system2(r, shQuote(script), stdout = TRUE, stderr = FALSE)
  expect_identical(trimws(out), rep("identical", length(scenes)))
  expect_true(all(records_check(lab)$holds))
})

test_that("NA, NaN, Inf and -0 are kept", {
  x <- c(1, NA, NaN, Inf, -Inf, -0, 0)
  special <- special_of(x)
  expect_identical(special, c(NA, "NA", "NaN", "Inf", "-Inf", "-0", NA))
  stored <- ifelse(is.na(special), x, NA)
  back <- value_of(stored, special)
  expect_identical(is.nan(back), is.nan(x))
  expect_identical(1 / back[6:7], c(-Inf, Inf))
  expect_identical(back[c(1, 4, 5)], x[c(1, 4, 5)])
})

test_that("times are a grid where that gives the same doubles", {
  skip_if_not_installed("yyjsonr")
  for (x in list(
    seq(0, 8, by = 0.01), seq(0, 1, length.out = 7), c(0, 0.1, 1), 3, double(), c(1, 0.5, 0),
    sort(exp(1:20)), c(0, 0.1, 0.2, 0.3), 1e9 + 0:5 / 3
  )) {
    expect_identical(read_times(times_text(x), NULL), x)
  }
  expect_match(times_text(seq(0, 8, by = 0.01)), "step")
  # The mean step is another double than the first one.
  thirds <- grid_times(0, 1 / 3, 26)
  expect_false(identical(grid_times(0, thirds[26] / 25, 26), thirds))
  expect_match(times_text(thirds), "step")
  expect_error(read_times("{\"from\":0,\"step\":1}", NULL), class = "rotdyn_error_record")
  expect_error(read_times("{\"at\":\"system('id')\"}", NULL), class = "rotdyn_error_record")
})

test_that("names of runs sort as they were made", {
  names <- vapply(1:500, function(i) new_run_name(), "")
  expect_true(all(grepl("^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$", names)))
  expect_false(is.unsorted(names))
  set.seed(1)
  first <- runif(1)
  set.seed(1)
  new_run_name()
  expect_identical(runif(1), first)
})

test_that("the user's own columns and a choice of columns do no harm", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  motion <- trajectory(wheel(), 0:8)
  motion$mine <- letters[1:9]
  run <- records_add(lab, motion)
  expect_false("mine" %in% records_read(lab, run)$columns)
  expect_identical(records_rerun(lab, run)$verdict, "identical")
  fewer <- motion[c("time_s", "theta_rad", "omega_rad_per_s")]
  expect_identical(records_rerun(lab, records_add(lab, fewer))$verdict, "identical")
  asked_model <- trajectory(wheel(), 0:8, model = "axle_rk8pd", accuracy = 1e-7)
  run <- records_add(lab, asked_model, rows = "all")
  expect_true(records_read(lab, run)$model_asked)
  expect_identical(records_rerun(lab, run)$verdict, "identical")
  kept <- records_read(lab, run)$values
  expect_identical(kept$value[kept$quantity == "theta_rad"], asked_model$theta_rad)
})

test_that("the article's tables are views, and its closing query runs unchanged", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  closing <- "SELECT
    relation_name,
    equation_text,
    interpretation
FROM physical_relations
ORDER BY relation_id;"
  expect_identical(nrow(asked(lab, closing)), 13L)
  # article-rows.csv: XXH128 of the names of the columns and of each row that the article's own
  # script makes in SQLite: cells with 17 digits, a bar between them.
  article <- utils::read.csv(test_path("article-rows.csv"), colClasses = "character")
  expect_identical(sum(article$row != "columns"), 66L)
  expect_length(unique(article$view), 10)
  for (view in unique(article$view)) {
    of <- article[article$view == view, ]
    found <- asked(lab, paste("SELECT * FROM", view, "ORDER BY 1"))
    rows <- found[match(of$row[-1], as.character(found[[1]])), ]
    if (view == "rolling_body_cases") {
      expect_identical(rows$beta[4], 2 / 3)
      rows$beta[4] <- 0.6666667
      expect_match(rows$notes[4], "; the published beta, 0.6666667, is 2/3", fixed = TRUE)
      rows$notes[4] <- sub(";.*", "", rows$notes[4])
    }
    cells <- lapply(rows, function(x) if (is.numeric(x)) sprintf("%.17g", as.double(x)) else x)
    lines <- c(paste(names(found), collapse = "|"), do.call(paste, c(unname(cells), sep = "|")))
    expect_identical(vapply(lines, hash_text, "", USE.NAMES = FALSE), of$hash, info = view)
  }
  rolling <- asked(lab, "SELECT * FROM rolling_body_cases ORDER BY body_id")
  expect_identical(rolling$beta, c(1, 0.5, 0.4, 2 / 3, 0))
  expect_match(rolling$notes[4], "0.6666667, is 2/3", fixed = TRUE)
  expect_identical(unique(rolling$incline_angle_deg), 20)
  expect_identical(
    asked(lab, "SELECT * FROM torque_time_profile ORDER BY point_id")$applied_torque_n_m,
    c(0, 0.4, 0.8, 0.8, 0.8, 0.8, 0.4, 0, 0, 0)
  )
  tops <- asked(lab, "SELECT * FROM gyroscope_cases WHERE case_id = 'slow_heavy_rotor'")
  expect_identical(unlist(tops[2:5], use.names = FALSE), c(2, 0.12, 0.02, 120))
  constants <- asked(lab, "SELECT * FROM constants WHERE constant_id <= 5 ORDER BY constant_id")
  expect_identical(constants$unit[3:5], c("kg m^2 s^-2", "kg m^2 s^-2", "kg m^2 s^-3"))
  expect_identical(constants$value, c(9.80665, 1, 1, 1, 1))
})

test_that("SQLite refuses what breaks a key, with or without this package", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  expect_error(asked(lab, "DELETE FROM rot_unit WHERE unit = 'm'"), "FOREIGN KEY")
  expect_error(asked(lab, "UPDATE rot_constant SET value = 'much'"), "REAL")
  expect_error(asked(lab, "UPDATE rot_constant SET standard_uncertainty = 1"), "CHECK")
})

test_that("what is no database of records is refused", {
  need()
  expect_error(records_list(tempfile()), "no file", class = "rotdyn_error_database")
  empty <- tempfile(fileext = ".sqlite")
  con <- DBI::dbConnect(RSQLite::SQLite(), empty)
  on.exit({
    DBI::dbDisconnect(con)
    unlink(c(empty, lab))
  })
  expect_error(records_list(con), "no tables", class = "rotdyn_error_database")
  expect_error(records_list(3), class = "rotdyn_error_type")
  lab <- new_lab()
  expect_error(records_read(lab, "abc"), "no run", class = "rotdyn_error_record")
  expect_error(records_read(lab, "x' OR 1"), class = "rotdyn_error_record")
  expect_error(records_add(lab, 3), class = "rotdyn_error_type")
  old <- structure(list(), class = "PostgreSQLConnection")
  expect_error(records_create(old), "15 digits", class = "rotdyn_error_database")
  # A model that exists no more, and a newer format.
  run <- records_add(lab, trajectory(wheel(), 0:2, model = "axle_linear"))
  asked(lab, "INSERT INTO rot_model SELECT 'axle_epicycles', constraint_kind, equations,
    assumptions, limits, requires, error, error_kind, source, cited FROM rot_model
    WHERE model = 'axle_linear'")
  asked(lab, "UPDATE rot_run SET model = 'axle_epicycles'")
  expect_error(records_rerun(lab, run), "axle_epicycles", class = "rotdyn_error_record")
  expect_identical(records_read(lab, run)$model, "axle_epicycles")
  asked(lab, "UPDATE rot_format SET format = 2")
  expect_error(records_list(lab), "newer format", class = "rotdyn_error_database")
  expect_error(records_create(lab), "newer format", class = "rotdyn_error_database")
})

test_that("a file that is made anew, or that another program made", {
  need()
  lab <- new_lab()
  con <- NULL
  on.exit({
    if (!is.null(con)) DBI::dbDisconnect(con)
    unlink(lab)
  })
  motion <- trajectory(wheel(), 0:8)
  for (i in 1:3) records_add(lab, motion)
  # The scene and the software are not in the new file.
  unlink(lab)
  records_create(lab)
  run <- records_add(lab, motion)
  expect_identical(records_list(lab)$run, run)
  expect_identical(records_rerun(lab, run)$verdict, "identical")
  # References that the connection does not keep are kept for the record.
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  DBI::dbExecute(con, "PRAGMA foreign_keys = OFF")
  records_add(con, motion)
  expect_identical(DBI::dbGetQuery(con, "PRAGMA foreign_keys")[[1]], 1L)
  # In the user's own transaction nothing is recorded, and nothing of it is lost.
  DBI::dbBegin(con)
  DBI::dbExecute(con, "UPDATE rot_run SET note = 'mine'")
  expect_error(records_add(con, motion), "transaction", class = "rotdyn_error_database")
  DBI::dbCommit(con)
  expect_identical(records_list(con)$note, rep("mine", 2))
  # Another version's rows are completed, tables with other columns are refused.
  DBI::dbExecute(con, "UPDATE rot_format SET rotdyn_version = '0.0.1'")
  records_add(con, motion)
  expect_identical(
    DBI::dbGetQuery(con, "SELECT rotdyn_version FROM rot_format")[[1]], own_version()
  )
  expect_true(all(records_check(con)$holds))
  DBI::dbExecute(con, "UPDATE rot_format SET format = 2")
  expect_error(records_add(con, motion), "newer format", class = "rotdyn_error_database")
  expect_error(records_add(lab, motion), "newer format", class = "rotdyn_error_database")
  DBI::dbExecute(con, "UPDATE rot_format SET format = 1")
  DBI::dbExecute(con, "ALTER TABLE rot_run RENAME COLUMN times TO moments")
  expect_error(records_add(lab, motion), "times", class = "rotdyn_error_database")
  expect_identical(nrow(records_list(con)), 3L)
  text <- tempfile()
  writeLines(rep("no database", 100), text)
  expect_error(records_add(text, motion), "not a database", class = "rotdyn_error_database")
  unlink(text)
})

test_that("the text that is kept of a scene is that of the same bits", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  hashes <- vapply(c(0, -0, 0, 1), function(omega) {
    scene <- scene_axle(body_disk(2, 0.25), 0.8, omega0_rad_per_s = omega)
    run <- records_add(lab, trajectory(scene, 0:8))
    expect_identical(records_read(lab, run)$scene_hash, scene_hash(scene))
    expect_identical(records_rerun(lab, run)$verdict, "identical")
    scene_hash(scene)
  }, "")
  expect_identical(hashes[1], hashes[3])
  expect_length(unique(hashes), 3)
})

test_that("an open transaction and an interruption leave nothing of a run", {
  need()
  lab <- new_lab()
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  on.exit({
    DBI::dbDisconnect(con)
    unlink(lab)
  })
  motion <- trajectory(wheel(), 0:8)
  db <- open_records(con, NULL)
  expect_error(
    in_transaction(db, NULL, {
      append_rows(db, "software", c(own_software()))
      stop("pulled the plug")
    }), "pulled the plug", class = "rotdyn_error_database"
  )
  expect_identical(nrow(DBI::dbGetQuery(con, "SELECT * FROM rot_software")), 0L)
  run <- records_add(con, motion)
  expect_identical(records_list(con)$run, run)
  expect_true(DBI::dbIsValid(con))
})

test_that("two sessions record at once", {
  need()
  lab <- new_lab()
  files <- tempfile(c("write", "begun", "ended"))
  on.exit(unlink(c(lab, files)))
  writeLines(sprintf(
    "library(rotdyn, lib.loc = '%s')
    motion <- trajectory(scene_axle(1, 1), 0:9)
    invisible(file.create('%s'))
    for (i in 1:20) records_add('%s', motion)
    invisible(file.create('%s'))",
    dirname(system.file(package = "rotdyn")), files[2], lab, files[3]
  ), files[1])
  system2(file.path(R.home("bin"), "Rscript"), shQuote(files[1]), wait = FALSE)
  wait_for <- function(file) {
    for (i in 1:600) if (file.exists(file)) break else Sys.sleep(0.1)
  }
  wait_for(files[2])
  motion <- trajectory(scene_axle(2, 1), 0:9)
  for (i in 1:20) records_add(lab, motion)
  wait_for(files[3])
  expect_identical(nrow(records_list(lab)), 40L)
  expect_length(unique(records_list(lab)$scene_hash), 2)
  expect_true(all(records_check(lab)$holds))
})

test_that("metadata of another version are completed", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  asked(lab, "DELETE FROM rot_model_assumption WHERE model = 'axle_free'")
  asked(lab, "DELETE FROM rot_model_effect WHERE model = 'axle_linear'")
  checked <- records_check(lab)
  expect_false(checked$holds[checked$check == "metadata of this version"])
  asked(lab, "UPDATE rot_format SET rotdyn_version = '0.0.1'")
  expect_identical(records_create(lab), character())
  expect_true(all(records_check(lab)$holds))
})

test_that("the script makes the same tables and rows", {
  need()
  script <- metadata(dialect = "sqlite")
  undated <- function(x) gsub("[0-9-]+T[0-9:]+Z", "a time", x)
  expect_match(metadata(dialect = "postgresql"), "DOUBLE PRECISION")
  expect_error(metadata(dialect = "oracle"), class = "rotdyn_error_value")
  file <- tempfile(fileext = ".sql")
  expect_identical(undated(metadata(file = file)), undated(script))
  written <- paste(readLines(file, encoding = "UTF-8"), collapse = "\n")
  expect_identical(undated(written), undated(trimws(script)))
  con <- DBI::dbConnect(RSQLite::SQLite(), ":memory:")
  on.exit({
    DBI::dbDisconnect(con)
    unlink(file)
  })
  for (statement in strsplit(script, ";\n", fixed = TRUE)[[1]]) DBI::dbExecute(con, statement)
  known <- metadata()
  tables <- metadata_tables()
  for (name in names(known)) {
    rows <- DBI::dbGetQuery(con, paste("SELECT * FROM", tables[[name]]$sql))
    expect_equal(as.list(rows), lapply(as.list(known[[name]]), unname), tolerance = 0)
  }
  run <- records_add(con, trajectory(wheel(), 0:8))
  expect_identical(records_rerun(con, run)$verdict, "identical")
})

test_that("without the packages the error says what is missing", {
  for (package in c("DBI", "RSQLite", "yyjsonr")) {
    expect_error(
      need_package(paste0(package, "NotThere"), "Recording runs", NULL), "install",
      class = "rotdyn_error_package"
    )
  }
})

test_that("names of files that are no text", {
  for (need in c("DBI", "RSQLite")) skip_if_not_installed(need)
  bytes <- "a\xff"
  Encoding(bytes) <- "bytes"
  expect_error(records_check(bytes), class = "rotdyn_error_type")
  expect_error(records_create(bytes), class = "rotdyn_error_type")
  expect_error(records_check(""), class = "rotdyn_error_type")
  long <- strrep("a", 2e5)
  expect_error(expect_no_warning(records_create(long)), class = "rotdyn_error_database")
  expect_error(expect_no_warning(records_check(long)), class = "rotdyn_error_database")
})

test_that("repeated times are recorded as often as they were asked for", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  times <- c(0, 1, 1, 2, 2.5, 2.5, 2.5)
  motions <- list(
    trajectory(wheel(), times), trajectory(scene_rotors(list(1, 2, 3), c(10, 20),
      omega0_rad_per_s = c(1, 0, 0)), times),
    trajectory(scene_drive(list(1, 2), coupling_shaft(5), torque = list(1, NULL)), times)
  )
  for (motion in motions) {
    run <- records_add(lab, motion)
    expect_identical(records_read(lab, run)$times_s, times)
    again <- records_rerun(lab, run)
    expect_identical(again$verdict, "identical")
    expect_identical(as.list(again$motion), as.list(motion))
  }
})

test_that("columns of all bodies are kept and compared, logical ones too", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  craft <- scene_free(
    c(1, 2, 3), c(1, 2, 0.1), rotors = list(rotor(c(1, 0, 0), 0.1, 5), rotor(c(0, 1, 0), 0.1, 7))
  )
  motion <- trajectory(craft, c(0, 1, 3))
  run <- records_add(lab, motion)
  kept <- records_read(lab, run)$values
  expect_setequal(kept$quantity, names(motion))
  expect_identical(
    kept$value[kept$quantity == "rotor_2_omega_rad_per_s"], motion$rotor_2_omega_rad_per_s
  )
  words <- asked(lab, "SELECT unit, meaning FROM rot_quantity WHERE quantity =
    'rotor_2_omega_rad_per_s'")
  expect_identical(words$unit, "rad/s")
  expect_match(words$meaning, "rotor 2")
  expect_true(all(records_check(lab)$holds))
  again <- records_rerun(lab, run)
  expect_identical(again$verdict, "identical")
  expect_identical(again$not_compared, character())
  # One value of the second rotor is another one, the hash is lost.
  lose_hash <- function() {
    asked(lab, "UPDATE rot_run SET result_hash = ?", params = list(strrep("0", 32)))
  }
  lose_hash()
  expect_identical(records_rerun(lab, run)$verdict, "within errors")
  asked(lab, "UPDATE rot_run_value SET value = value * 1.00001 WHERE quantity =
    'rotor_2_omega_rad_per_s' AND place = 2")
  again <- records_rerun(lab, run)
  expect_identical(again$verdict, "differs")
  expect_identical(again$where$quantity[1], "rotor_2_omega_rad_per_s")
  # A column of a record without values says so.
  asked(lab, "DELETE FROM rot_run_value WHERE quantity = 'rotor_2_omega_rad_per_s'")
  again <- records_rerun(lab, run)
  expect_identical(again$not_compared, "rotor_2_omega_rad_per_s")
  expect_output(print(again), "unknown +rotor_2_omega_rad_per_s")
  # Whether a clutch is locked.
  run <- records_add(lab, trajectory(scene_clutch(1, 2, 3, omega0_rad_per_s = c(10, 0)), 0:8))
  lose_hash()
  expect_identical(records_rerun(lab, run)$verdict, "within errors")
  asked(lab, "UPDATE rot_run_value SET value = 1 - value WHERE quantity = 'locked' AND place = 9")
  expect_identical(records_rerun(lab, run)$verdict, "differs")
})

test_that("what the dictionary lacks is described by the first body's column", {
  words <- more_quantities(c("time_s", "theta_3_rad", "rotor_12_omega_rad_per_s", "no_such_thing"))
  expect_identical(words$quantity, c("theta_3_rad", "rotor_12_omega_rad_per_s", "no_such_thing"))
  expect_identical(words$unit, c("rad", "rad/s", NA))
  expect_identical(words$meaning[1], "angle of body 3")
  expect_length(more_quantities("time_s")$quantity, 0L)
})

test_that("sessions that make one database at once lose no run", {
  need()
  skip_on_cran()
  folder <- tempfile("lab")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  lab <- file.path(folder, "new.sqlite")
  writeLines(sprintf(
    "library(rotdyn, lib.loc = '%s')
    arguments <- commandArgs(TRUE)
    motion <- trajectory(scene_axle(1, 1), 0:9)
    file.create(file.path('%s', paste0('ready', arguments)))
    while (!file.exists(file.path('%s', 'go'))) Sys.sleep(0.001)
    records_create('%s')
    records_add('%s', motion)
    file.create(file.path('%s', paste0('done', arguments)))",
    dirname(system.file(package = "rotdyn")), folder, folder, lab, lab, folder
  ), file.path(folder, "one.R"))
  for (i in 1:4) {
    system2(
      file.path(R.home("bin"), "Rscript"), c(shQuote(file.path(folder, "one.R")), i), FALSE, FALSE,
      wait = FALSE
    )
  }
  wait <- function(pattern) {
    for (i in 1:1200) {
      if (length(list.files(folder, pattern)) == 4L) break
      Sys.sleep(0.1)
    }
  }
  wait("^ready")
  file.create(file.path(folder, "go"))
  wait("^done")
  expect_length(list.files(folder, "^done"), 4L)
  expect_identical(nrow(records_list(lab)), 4L)
  expect_true(all(records_check(lab)$holds))
  expect_length(list.files(folder, "rotdyn-", all.files = TRUE), 0L)
  # Two connections of one process: the tables that are there are kept.
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  expect_identical(make_tables(list(con = con, dialect = "sqlite"), NULL), character())
  DBI::dbDisconnect(con)
  expect_identical(nrow(records_list(lab)), 4L)
})

test_that("a full disk is named, and leaves no run and no file", {
  need()
  on_tiny_disk("600k", function(disk) {
    full <- function(expr) expect_error(expr, "disk is full", class = "rotdyn_error_database")
    lab <- file.path(disk, "lab.sqlite")
    records_create(lab)
    run <- records_add(lab, trajectory(wheel(), 0:8))
    long <- trajectory(wheel(), seq(0, 8, length.out = 20000))
    full(records_add(lab, long, rows = "all"))
    expect_identical(records_list(lab)$run, run)
    con <- DBI::dbConnect(RSQLite::SQLite(), lab)
    full(records_add(con, long, rows = "all"))
    expect_identical(records_list(con)$run, run)
    DBI::dbDisconnect(con)
    full(records_create(file.path(disk, "new.sqlite")))
    expect_identical(list.files(disk, all.files = TRUE, no.. = TRUE), "lab.sqlite")
    said <- cli("record", file.path(disk, "new.sqlite"), "--moment-of-inertia-kg-m2", "1",
                "--times", "0:8:1")
    expect_identical(said$status, 3L)
    expect_match(said$err, "disk is full", all = FALSE)
  })
})

test_that("damaged databases end in errors of the package", {
  need()
  lab <- new_lab()
  on.exit(unlink(c(lab, copy)))
  copy <- tempfile(fileext = ".sqlite")
  motion <- trajectory(wheel(), 0:8)
  run <- records_add(lab, motion, note = "a")
  # Without the types and checks of the tables.
  kept <- c("rot_run", "rot_run_value", "rot_scene", "rot_software", "rot_format")
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  DBI::dbExecute(con, "PRAGMA writable_schema = ON")
  DBI::dbExecute(con, paste0(
    "UPDATE sqlite_schema SET sql = replace(replace(replace(replace(replace(sql, ",
    "' STRICT, WITHOUT', ' WITHOUT'), ' STRICT', ''), 'TEXT NOT NULL', 'TEXT'), ",
    "'REAL NOT NULL', 'REAL'), 'INTEGER NOT NULL', 'INTEGER') WHERE name IN ('",
    paste(kept, collapse = "', '"), "')"
  ))
  DBI::dbDisconnect(con)
  damage <- function(table, column, value, where = "") {
    file.copy(lab, copy, overwrite = TRUE)
    con <- DBI::dbConnect(RSQLite::SQLite(), copy)
    on.exit(DBI::dbDisconnect(con))
    DBI::dbExecute(con, "PRAGMA ignore_check_constraints = ON")
    DBI::dbExecute(con, paste("UPDATE", table, "SET", column, "=", value, where))
  }
  outcome <- function(expr) {
    tryCatch({
      expr
      "done"
    }, rotdyn_error = function(e) sub("rotdyn_error_", "", class(e)[1]))
  }
  text <- "CAST(x'fffe41' AS TEXT)"
  first <- "WHERE quantity = 'theta_rad' AND place = 1"
  cases <- list(
    list("rot_run", "note", text), list("rot_run", "row_count", "-1"),
    list("rot_run", "row_count", "'many'"), list("rot_run", "model_asked", "NULL"),
    list("rot_run", "accuracy", "'small'"), list("rot_run", "max_steps", "x'00'"),
    list("rot_run", "times", "'{\"from\":0,\"step\":1,\"n\":2e9}'"),
    list("rot_run", "times", "'{\"at\":[1,\"x\"]}'"), list("rot_run", "times", text),
    list("rot_run", "times", "'{\"at\":[0,1,2,3,4,5,6,7,8,9,10]}'"),
    list("rot_run", "errors", "'{\"theta\":\"much\"}'"), list("rot_run", "errors", "'{'"),
    list("rot_scene", "json", text), list("rot_scene", "json", "'{\"scene_axle\":7}'"),
    list("rot_software", "platform", "x'ff'"), list("rot_run_value", "place", "-1", first),
    list("rot_run_value", "place", "1e300", first), list("rot_run_value", "value", "'x'", first),
    list("rot_run_value", "special", "'none'", first)
  )
  for (case in cases) {
    do.call(damage, case)
    expect_no_warning({
      expect_true(outcome(records_read(copy, run)) %in% c("record", "scene"), label = case)
      expect_true(outcome(records_rerun(copy, run)) %in% c("record", "scene"))
      expect_identical(outcome(records_list(copy)), "done")
      expect_false(all(records_check(copy)$holds) && !identical(case[[2]], "times") &&
                     !identical(case[[2]], "errors"))
    })
  }
  for (value in c(text, "NULL", "'one'", "x'ff'")) {
    damage("rot_format", "format", value)
    expect_no_warning(expect_identical(outcome(records_list(copy)), "database"))
    expect_no_warning(expect_identical(outcome(records_add(copy, motion)), "database"))
    damage("rot_format", "rotdyn_version", value)
    expect_no_warning(expect_identical(outcome(records_list(copy)), "done"))
    expect_no_warning(expect_identical(outcome(records_add(copy, motion)), "done"))
  }
})

test_that("a scene that cannot be read is found by the check", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  records_add(lab, trajectory(wheel(), 0:8))
  text <- "{\"scene_axle\":{\"body\":-1}}"
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  DBI::dbExecute(con, "UPDATE rot_scene SET json = ?, scene = ?", list(text, hash_text(text)))
  DBI::dbDisconnect(con)
  found <- records_check(lab)
  expect_false(found$holds[found$check == "every scene can be read"])
  expect_true(found$holds[found$check == "hashes of the scenes"])
})

test_that("the length of the steps is kept, and a run by steps is computed again", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  scene <- scene_free(c(1, 2, 3), c(0.1, 2, 0.1))
  motion <- trajectory(scene, c(0, 1, 2), 1e-3, model = "free_rk4", step_s = 0.05)
  run <- records_add(lab, motion)
  expect_identical(records_read(lab, run)$step_s, 0.05)
  expect_false("step_s" %in% records_read(lab, run)$values$quantity)
  again <- records_rerun(lab, run, store = TRUE)
  expect_identical(again$verdict, "identical")
  expect_identical(again$motion$omega_x_rad_per_s, motion$omega_x_rad_per_s)
  expect_identical(records_rerun(lab, again$new_run)$verdict, "identical")
  expect_true(all(records_check(lab)$holds))
  # Without it, as version 0.5.0 recorded: other steps.
  asked(lab, "DELETE FROM rot_run_value WHERE quantity = 'step_s'")
  expect_null(records_read(lab, run)$step_s)
  expect_false(records_rerun(lab, run)$verdict == "identical")
})

test_that("a motion with rows at its events is found again", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  scenes <- list(
    scene_axle(2, NULL, resistance(coulomb_n_m = 4), omega0_rad_per_s = 5),
    scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0)),
    scene_axle(1, torque_spring(4), theta0_rad = 0.1)
  )
  for (scene in scenes) {
    motion <- trajectory(scene, c(0, 0.5, 3), event_rows = TRUE)
    expect_gt(nrow(motion), 3L)
    expect_identical(records_rerun(lab, records_add(lab, motion))$verdict, "identical")
  }
})

test_that("texts are compared row by row", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  scene <- scene_incline(
    body_sphere(1, 0.1), 0, static_friction = 0.2, v0_m_per_s = 3, omega0_rad_per_s = 0
  )
  motion <- trajectory(scene, seq(0, 2, by = 0.25), event_rows = TRUE)
  expect_true("event" %in% names(motion))
  run <- records_add(lab, motion)
  again <- records_rerun(lab, run)
  expect_identical(again$verdict, "identical")
  expect_identical(again$not_compared, character())
  expect_length(again$texts, 0L)
  named <- which(!is.na(motion$event))
  texts <- records_read(lab, run)$texts
  expect_identical(unique(texts$quantity), "event")
  # A record with another text in that row, and another hash.
  asked(lab, "UPDATE rot_run SET result_hash = ?", params = list(strrep("0", 32)))
  expect_identical(records_rerun(lab, run)$verdict, "within errors")
  asked(lab, paste(
    "UPDATE rot_run_value SET value = value + 1 WHERE quantity = 'text of event' AND place =",
    named[1]
  ))
  again <- records_rerun(lab, run)
  expect_identical(again$verdict, "differs")
  expect_identical(again$texts, list(event = named[1]))
  expect_output(print(again), paste("event is another one in row", named[1]), fixed = TRUE)
  # A record of version 0.5.0 has no texts.
  asked(lab, "DELETE FROM rot_run_value WHERE quantity = 'text of event'")
  again <- records_rerun(lab, run)
  expect_identical(again$not_compared, "event")
  expect_identical(again$verdict, "within errors")
})

test_that("a value that is missing in the record does not hide how far others are off", {
  scene <- scene_axle(1, 0.3)
  motion <- trajectory(scene, c(0, 1, 2))
  run <- rotdyn:::trajectory_run(motion)
  old <- list(
    errors = data.frame(measure = character(), error = double()), error = 0,
    values = data.frame(
      quantity = "omega_rad_per_s", row = 1:3, value = c(-Inf, 0.3, 0.6 + 1e-9)
    )
  )
  where <- rotdyn:::compare_values(old, motion, run)
  expect_identical(where$difference, Inf)
  expect_lt(where$allowed, 1e-14)
  old$values$value <- c(0, 0.3, 0.6 + 1e-9)
  where <- rotdyn:::compare_values(old, motion, run)
  expect_equal(where$difference, 1e-9, tolerance = 1e-6)
  expect_lt(where$allowed, 1e-14)
})

test_that("energies may differ by four times what the state may, and by four roundings", {
  motion <- trajectory(scene_axle(1, 0.3), c(0, 1, 2))
  run <- rotdyn:::trajectory_run(motion)
  run$info$error <- 1e-9
  old <- list(
    errors = data.frame(measure = character(), error = double()), error = 0,
    values = data.frame(
      quantity = "rotational_kinetic_energy_j", row = 3,
      value = motion$rotational_kinetic_energy_j[3]
    )
  )
  size <- 0.5 * 0.6^2
  eps <- .Machine$double.eps
  allowed <- function() rotdyn:::compare_values(old, motion, run)$allowed
  expect_within(allowed(), 4e-9 * size + 4 * eps * size, 1e-12)
  run$info$error <- 0
  expect_within(allowed(), 4 * eps * size, 1e-12)
})

test_that("a motion with an edited row is not recorded as balanced", {
  for (need in c("yyjsonr", "DBI", "RSQLite")) skip_if_not_installed(need)
  lab <- tempfile(fileext = ".sqlite")
  on.exit(unlink(lab))
  records_create(lab)
  motion <- edited <- trajectory(scene_axle(1, torque_sinusoid(1, 2)), 0:10 / 2)
  edited$omega_rad_per_s[3] <- 7
  last <- own <- motion
  own$note <- 1
  last[nrow(last), "omega_rad_per_s"] <- 7
  for (x in list(motion, motion[3:6, ], own, edited, last)) {
    records_add(lab, x)
  }
  expect_identical(
    records_list(lab)$verdict, rep(c("balanced", "not audited", "unbalanced"), c(3, 1, 1))
  )
})

test_that("damaged times show in the check, rows out of order are no record", {
  need()
  lab <- new_lab()
  on.exit(unlink(lab))
  motion <- trajectory(wheel(), 0:4)
  run <- records_add(lab, motion)
  expect_error(records_add(lab, motion[5:1, ]), "order of their times", class = "rotdyn_error_time")
  expect_identical(records_add(lab, motion[c(1, 3, 3), ]), records_list(lab)$run[2])
  expect_true(all(records_check(lab)$holds))
  for (times in c('{"at":[1,null]}', "{}", '{"from":0,"n":-1,"step":1}')) {
    asked(lab, "UPDATE rot_run SET times = ? WHERE run = ?", params = list(times, run))
    check <- records_check(lab)
    expect_identical(check$detail[!check$holds], run, info = times)
    expect_match(check$check[!check$holds], "times of every run")
  }
})

test_that("what a database refuses comes with a remedy", {
  need()
  motion <- trajectory(wheel(), 0:4)
  expect_error(records_create(file.path(tempdir(), "none", "a.sqlite")), "Its folder must exist",
               class = "rotdyn_error_database")
  text <- tempfile()
  on.exit(unlink(text))
  writeLines(strrep("no database ", 20), text)
  expect_error(records_list(text), "records_create", class = "rotdyn_error_database")
  lab <- new_lab()
  con <- DBI::dbConnect(RSQLite::SQLite(), lab, flags = RSQLite::SQLITE_RO)
  expect_error(records_add(con, motion), "only reads", class = "rotdyn_error_database")
  DBI::dbDisconnect(con)
  con <- DBI::dbConnect(RSQLite::SQLite(), lab)
  records_list(con)
  DBI::dbBegin(con)
  expect_error(records_add(con, motion), "commit it first", class = "rotdyn_error_database")
  DBI::dbRollback(con)
  DBI::dbExecute(con, "ALTER TABLE rot_run RENAME COLUMN note TO notes")
  expect_error(records_list(con), "tables were changed", class = "rotdyn_error_database")
  DBI::dbDisconnect(con)
})
