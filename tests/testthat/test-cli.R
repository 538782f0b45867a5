# A folder of inputs, in which each test runs.
in_folder <- function(code) {
  folder <- tempfile("cli")
  dir.create(folder)
  old <- setwd(folder)
  on.exit({
    setwd(old)
    unlink(folder, recursive = TRUE)
  })
  wheel_json()
  writeLines(c(
    gsub("\n", "", paste(readLines("wheel.json"), collapse = "")),
    '{"scene_axle": {"body": 0.5, "omega0_rad_per_s": 3, "resistance": {"coulomb_n_m": 0.2}}}'
  ), "two.jsonl")
  writeLines('{"scene_axle": {"bdy": 1}}', "bad.json")
  writeLines('{"body_disk": {"mass_kg": 2, "radius_m": 0.25}}', "body.json")
  writeLines("time_s,torque_n_m\n0,0\n1,0.8\n4,0.8\n6,0\n8,0", "torque.csv")
  writeLines("beta,incline_angle_deg\n0.4,10\n0.5,30", "balls.csv")
  writeLines("ixx,iyy,izz\n1,2,3\n1,2,9", "tensors.csv")
  writeLines(c(
    "ixx_kg_m2,iyy_kg_m2,izz_kg_m2,omega_x_rad_per_s,omega_y_rad_per_s,omega_z_rad_per_s",
    "1,2,2.5,0.01,1,0"
  ), "debris.csv")
  for (file in c("arm.urdf", "gyroscope_cases.csv", "rolling_cases.csv")) {
    file.copy(system.file("extdata", file, package = "rotdyn"), file)
  }
  file.create("empty")
  dir.create("folder")
  force(code)
}

test_that("each verb prints what it printed: tables", {
  skip_if_not_installed("yyjsonr")
  in_folder(expect_snapshot({
    cli_golden("roll")
    cli_golden("roll", "--beta=0.4", "--angle-deg", "20", "--height-m", "1", "--format", "json")
    cli_golden("roll", "rolling_cases.csv", "--format", "text")
    cli_golden("roll", "balls.csv", "--format", "jsonl")
    cli_golden("race", "--objects", "hoop,disk,sphere", "--angle-deg", "10")
    cli_golden("inertia", "disk", "--mass-kg", "2", "--radius-m", "0.25")
    cli_golden("check-inertia", "tensors.csv", "--format", "text")
    cli_golden("tumble", "debris.csv", "--time-s", "10", "--format", "text")
    cli_golden("precess", "gyroscope_cases.csv")
    writeLines(c("roll balls.csv --format text", "inertia disc", "roll --beta 0.4"), "work.txt")
    cli_golden("batch", "work.txt")
  }))
})

test_that("each verb prints what it printed: motions", {
  skip_if_not_installed("yyjsonr")
  in_folder(expect_snapshot({
    cli_golden("trajectory", "wheel.json", "--times", "0:8:4", "--format", "text")
    cli_golden("trajectory", "two.jsonl", "--times", "0,8", "--format", "jsonl")
    cli_golden("choose", "wheel.json", "--times", "0:8:1", "--format", "text")
    cli_golden("audit", "wheel.json", "--times", "0:8:1", "--format", "text")
    cli_golden("audit", "two.jsonl", "--times", "0:8:1")
  }))
})

test_that("each verb prints what it printed: lists and words", {
  expect_snapshot({
    cli_golden("help")
    cli_golden("help", "trajectory")
    cli_golden("completion", "bash", first = 12)
    cli_golden("man", "version", masked = c("rotdyn [0-9.]+\"" = "rotdyn VERSION\""))
    cli_golden("shapes", first = 4)
    cli_golden("models", "--format", "json", first = 3)
    cli_golden("columns", first = 4)
    cli_golden("version", masked = c("[0-9][0-9.]+" = "VERSION"))
  })
  expect_identical(cli("version")$out, paste0(
    "rotdyn ", utils::packageVersion("rotdyn"), ", R ", getRversion()
  ))
  for (verb in c("shapes", "models", "columns")) {
    said <- cli(verb, "--format", "jsonl")
    expect_identical(said$status, 0L)
    expect_true(all(grepl("^[{].*[}]$", said$out)))
  }
  expect_length(cli("shapes", "--format", "jsonl")$out, nrow(shapes()))
  expect_length(cli("models")$out, nrow(models()) + 1L)
})

test_that("metadata prints every table, with NA as nothing", {
  known <- metadata()
  all <- utils::read.csv(text = cli("metadata")$out)
  expect_identical(all$table, names(known))
  for (name in names(known)) {
    read <- utils::read.csv(text = cli("metadata", name)$out, colClasses = "character")
    expect_identical(dim(read), dim(known[[name]][!vapply(known[[name]], is.list, NA)]))
  }
  said <- cli("metadata", "unit")
  expect_identical(said$status, 2L)
  expect_match(said$err[1], "did you mean `units`?", fixed = TRUE)
})

test_that("work-precision measures", {
  skip_if_not_installed("yyjsonr")
  in_folder({
    said <- cli("work-precision", "wheel.json", "--times", "0:8:1", "--accuracies", "1e-3",
                "--min-batch-s", "0.001")
  })
  expect_identical(said$status, 0L)
  expect_match(said$out[1], "^model,method,accuracy,")
  expect_true(any(grepl("^axle_linear,", said$out)))
})

test_that("runs are recorded, listed and computed again", {
  for (need in c("yyjsonr", "DBI", "RSQLite")) skip_if_not_installed(need)
  in_folder({
    made <- cli("record", "lab.sqlite", "wheel.json", "two.jsonl", "--times", "0:8:2",
                "--note", "bearing 3")
    expect_identical(made$status, 0L)
    runs <- utils::read.csv(text = made$out)
    expect_identical(runs$scene, c("wheel.json", "two.jsonl:1", "two.jsonl:2"))
    expect_identical(runs$model, c("axle_linear", "axle_linear", "axle_drag"))
    said <- cli("trajectory", "wheel.json", "--times", "0,4", "--record", "lab.sqlite")
    expect_match(said$err[2], "^rotdyn: recorded as [0-9a-f-]{36}$")
    listed <- utils::read.csv(text = cli("runs", "lab.sqlite")$out)
    expect_true(all(runs$run %in% listed$run) && nrow(listed) == 4L)
    kept <- utils::read.csv(text = cli("runs", "lab.sqlite", runs$run[1])$out)
    expect_true(all(c("quantity", "row", "value") %in% names(kept)))
    scene <- cli("runs", "lab.sqlite", runs$run[1], "--scene")
    expect_identical(scene_hash(read_scene(paste(scene$out, collapse = "\n"))),
                     scene_hash(article_scene()))
    again <- cli("rerun", "lab.sqlite")
    expect_identical(again$status, 0L)
    expect_identical(utils::read.csv(text = again$out)$verdict, rep("identical", 4L))
    expect_identical(cli("runs", "lab.sqlite", "--check")$status, 0L)
    for (more in c(runs$run[1], "--scene")) {
      ignored <- cli("runs", "lab.sqlite", more, "--check")
      expect_identical(ignored$status, 2L)
      expect_match(ignored$err[1], "whole database")
    }
    # A value that somebody changed, and the hash: no longer within the errors.
    con <- DBI::dbConnect(RSQLite::SQLite(), "lab.sqlite")
    DBI::dbExecute(con, paste0(
      "UPDATE rot_run_value SET value = value * 1.001 WHERE run = '", runs$run[1],
      "' AND quantity = 'omega_rad_per_s'"
    ))
    DBI::dbExecute(con, paste0(
      "UPDATE rot_run SET result_hash = '", strrep("0", 32), "' WHERE run = '", runs$run[1], "'"
    ))
    DBI::dbDisconnect(con)
    again <- cli("rerun", "lab.sqlite", runs$run[1])
    expect_identical(again$status, 1L)
    expect_match(again$out[2], ",differs,axle_linear,omega_rad_per_s,")
    for (line in list(c("runs", "none.sqlite"), c("rerun", "none.sqlite"), c("runs", "empty"),
                      c("runs", "folder"), c("runs", "wheel.json"), c("runs", "lab.sqlite", "zzz"),
                      c("rerun", "lab.sqlite", "ffff"),
                      c("record", "folder", "wheel.json", "--times", "0,1"))) {
      said <- cli(line)
      expect_identical(said$status, 3L, info = paste(line, collapse = " "))
      expect_match(said$err[1], "^rotdyn: ")
    }
    expect_false(file.exists("none.sqlite"))
    expect_identical(cli("runs", "lab.sqlite", "--scene")$status, 2L)
  })
})

test_that("each verb prints what it printed: records and measurements", {
  for (need in c("yyjsonr", "DBI", "RSQLite")) skip_if_not_installed(need)
  # Names of runs, times of the clock, versions, seconds.
  mask <- c(
    "[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f-]{22}" = "RUN", "20[0-9-]{8}T[0-9:]{8}Z" = "WHEN",
    ",0[.][0-9]+[.][0-9.]+," = ",VERSION,"
  )
  in_folder(expect_snapshot({
    cli_golden("record", "lab.sqlite", "wheel.json", "--times", "0:8:2", masked = mask)
    cli_golden("runs", "lab.sqlite", masked = mask)
    cli_golden("runs", "lab.sqlite", "--check")
    cli_golden("rerun", "lab.sqlite", masked = mask)
    cli_golden("runs", "none.sqlite")
    cli_golden("metadata", "constants", "--format", "jsonl")
    cli_golden("work-precision", "wheel.json", "--times", "0:8:1", "--accuracies", "1e-6",
               "--min-batch-s", "0.001", masked = c("^([^,]*,[^,]*,[^,]*),.*" = "\\1"))
  }))
})

test_that("every verb has a golden test", {
  files <- test_path("_snaps", c("cli.md", "cli-sweep.md"))
  lines <- unlist(lapply(files, readLines, encoding = "UTF-8"))
  called <- regmatches(lines, regexpr("(?<=cli_golden\\(\")[a-z-]+(?=\")", lines, perl = TRUE))
  expect_setequal(vapply(rotdyn:::cli_verbs(), `[[`, "", "name"), setdiff(called, "rol"))
  # Statuses 70, 130 and 141 have tests of their own.
  status <- unique(regmatches(lines, regexpr("(?<=^      status )[0-9]+$", lines, perl = TRUE)))
  expect_setequal(status, c("0", "1", "2", "3", "4"))
})

test_that("metadata as a script", {
  script <- cli("metadata", "--sql", "postgresql")
  expect_identical(script$status, 0L)
  expect_match(script$out, "^CREATE TABLE rot_unit", all = FALSE)
  expect_identical(cli("metadata", "units", "--sql", "sqlite")$status, 2L)
  expect_identical(cli("metadata", "--sql", "oracle")$status, 2L)
})

test_that("faults and statuses are what they were", {
  skip_if_not_installed("yyjsonr")
  in_folder(expect_snapshot({
    cli_golden()
    cli_golden("rol")
    cli_golden("roll", "--bta", "1")
    cli_golden("roll", "--beta")
    cli_golden("roll", "--beta", "0.4x")
    cli_golden("roll", "--beta", "1", "--beta", "2")
    cli_golden("roll", "--quiet=1")
    cli_golden("roll", "a", "b")
    cli_golden("roll", "--beta", "-1")
    cli_golden("roll", "--beta", "-1", "--format", "json")
    cli_golden("roll", "nothing.csv")
    cli_golden("roll", "empty")
    cli_golden("roll", "folder")
    cli_golden("roll", "-")
    cli_golden("roll", "--out", "folder/no/file.csv")
    cli_golden("trajectory", "wheel.json")
    cli_golden("trajectory", "--times", "0:8:1")
    cli_golden("trajectory", "wheel.json", "--times", "0:8")
    cli_golden("trajectory", "bad.json", "--times", "0:8:1")
    cli_golden("trajectory", "body.json", "--times", "0:8:1")
    cli_golden("trajectory", "wheel.json", "--times", "0:8:1", "--model", "axle_fre")
    cli_golden("trajectory", "wheel.json", "--times", "0:8:1", "--model", "axle_free")
    cli_golden("trajectory", "wheel.json", "--times", "0:8:1", "--shape", "disk")
    cli_golden("choose", "wheel.json", "--times", "0:8:1", "--accuracy", "1e-17")
    cli_golden("inertia", "disc", "--mass-kg", "1")
    cli_golden("inertia", "disk", "--mass-kg", "1")
    cli_golden("inertia", "disk", "--mass-kg", "1", "--radius-m", "1", "--edge-m", "2")
    cli_golden("completion", "ksh")
    cli_golden("roll", "--json", "--format", "csv")
  }))
})

test_that("a robot with a link that cannot exist is a no", {
  skip_if_not_installed("xml2")
  in_folder({
    said <- cli("check-inertia", "arm.urdf")
    both <- cli("check-inertia", "tensors.csv", "arm.urdf")
  })
  expect_identical(said$status, 1L)
  expect_match(said$out, "^arm.urdf,forearm,fails,\"triangle inequality", all = FALSE)
  expect_identical(both$status, 1L)
  expect_length(both$out, 1L + 2L + length(said$out) - 1L)
})

test_that("tensors come from standard input, too", {
  said <- cli("check-inertia", "-", input = c("ixx,iyy,izz", "1,2,9"))
  expect_identical(said$status, 1L)
  expect_match(said$out[2], "^-,row 1,fails,")
  expect_identical(cli("check-inertia", "-", "-", input = "x")$status, 2L)
})

test_that("the numbers are R's, to the last bit", {
  skip_if_not_installed("yyjsonr")
  in_folder({
    said <- cli("trajectory", "wheel.json", "--times", "0:8:0.01")
    options <- cli("trajectory", "--shape", "disk", "--mass-kg", "2", "--radius-m", "0.25",
                   "--torque-file", "torque.csv", "--viscous-n-m-s", "0.03", "--times", "0:8:0.01")
    piped <- cli("trajectory", "-", "--times", "0:8:0.01", input = readLines("wheel.json"))
  })
  expect_identical(options$out, said$out)
  expect_identical(piped$out, said$out)
  read <- utils::read.csv(text = said$out)
  motion <- trajectory(article_scene(), seq(0, 8, by = 0.01))
  expect_identical(names(read), names(motion))
  for (name in names(read)) expect_true(all(read[[name]] == motion[[name]]))
  five <- utils::read.csv(text = cli("roll")$out)
  expect_equal(five, as.data.frame(rolling_table()), tolerance = 0, ignore_attr = TRUE)
})

test_that("scenes of every constraint are taken, alone and together", {
  skip_if_not_installed("yyjsonr")
  scenes <- list(
    rotors = scene_rotors(c(1, 2), stiffness_n_m_per_rad = 1000, omega0_rad_per_s = c(1, 0.5)),
    clutch = scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(10, 0)),
    drive = scene_drive(c(0.4, 2), coupling_shaft(400, 0.1), torque = list(5, -5)),
    incline = scene_incline(body_sphere(6, 0.11), 10, static_friction = 0.2),
    free = scene_free(body_box(1, 0.1, 0.2, 0.3), c(0.1, 5, 0.1)),
    pendulum = scene_pendulum(body_point(1, 1), 1, theta0_rad = 1)
  )
  in_folder({
    for (name in names(scenes)) {
      write_scene(scenes[[name]], name)
      for (verb in c("trajectory", "choose", "audit")) {
        said <- cli(verb, name, "--times", "0:2:1")
        expect_identical(said$status, 0L, info = paste(verb, name))
      }
    }
    rows <- utils::read.csv(text = cli("trajectory", names(scenes), "--times", "0,1")$out)
  })
  expect_identical(unique(rows$scene), names(scenes))
  # What a motion does not have is NA in its rows.
  expect_identical(is.na(rows$qw), rows$scene != "free")
})

test_that("options are taken in both forms, and words are words", {
  one <- cli("roll", "--beta=0.4")$out
  expect_identical(cli("roll", "--beta", "0.4")$out, one)
  expect_identical(cli("roll", "--beta", "4e-1")$out, one)
  expect_identical(cli("roll", "--incline-angle-deg", "20", "--beta", "+.4")$out, one)
  expect_identical(cli("roll", "--beta", "0.4", "--angle-deg", "-5")$status, 0L)
  expect_identical(cli("roll", "--", "--beta")$status, 3L) # a file of that name
  expect_identical(cli("--version")$out, cli("version")$out)
  expect_identical(cli("roll", "-h")$out, cli("help", "roll")$out)
  expect_identical(cli("roll", "-", input = c("beta", "0.4"))$out, one)
  # A file from elsewhere.
  expect_identical(cli("roll", "-", input = c("\ufeffbeta\r", "0.4\r"))$out, one)
})

test_that("formats: a terminal reads text, a pipe csv", {
  expect_identical(cli("roll", terminal = TRUE)$out, cli("roll", "--format", "text")$out)
  expect_identical(cli("roll")$out, cli("roll", "--format", "csv")$out)
  table <- list(
    x = c(1, NA, NaN, Inf, -0.1), word = c("a,b", NA, "q\"q", "", "line\nline"),
    yes = c(TRUE, NA, FALSE, TRUE, TRUE)
  )
  expect_identical(rotdyn:::cli_csv(table), c(
    "x,word,yes", "1,\"a,b\",true", ",,", "NaN,\"q\"\"q\",false", "Inf,\"\",true",
    "-0.1,\"line\nline\",true"
  ))
  expect_identical(rotdyn:::cli_json_rows(table), c(
    '{"x":1,"word":"a,b","yes":true}', '{"x":null,"word":null,"yes":null}',
    '{"x":"NaN","word":"q\\"q","yes":false}', '{"x":"Inf","word":"","yes":true}',
    '{"x":-0.1,"word":"line\\nline","yes":true}'
  ))
  expect_identical(rotdyn:::cli_json(list(x = double())), "[]")
  expect_identical(rotdyn:::cli_csv(list(x = double())), "x")
})

test_that("options that would be ignored are refused", {
  skip_if_not_installed("yyjsonr")
  refused <- function(words, ...) {
    said <- cli(...)
    expect_identical(said[c("status", "out")], list(status = 2L, out = character()))
    expect_match(said$err[1], words, fixed = TRUE)
  }
  refused("`--mass-kg` needs a shape", "inertia", "--mass-kg", "3")
  refused("`--radius-m` needs a shape", "inertia", "--radius-m", "2")
  expect_identical(cli("inertia")$status, 0L)
  sizes <- paste0("--", gsub("_", "-", rotdyn:::size_table()$name))
  in_folder(for (size in c("--mass-kg", sizes)) {
    refused(
      paste0("`", size, "` describes an axle, and there is a scene, too"),
      "trajectory", "wheel.json", "--times", "0,1", size, "3"
    )
    refused(
      paste0("`", size, "` and `--moment-of-inertia-kg-m2` exclude each other"),
      "choose", "--moment-of-inertia-kg-m2", "1", "--times", "0,1", size, "3"
    )
  })
})

test_that("--out writes the data, --quiet keeps the words", {
  skip_if_not_installed("yyjsonr")
  in_folder({
    said <- cli("trajectory", "wheel.json", "--times", "0:8:4", "--out", "rows.csv")
    expect_length(said$out, 0L)
    expect_match(said$err, "axle_linear, error at most")
    expect_identical(readLines("rows.csv"), cli("trajectory", "wheel.json", "--times", "0:8:4")$out)
    expect_length(cli("trajectory", "wheel.json", "--times", "0:8:4", "--quiet")$err, 0L)
  })
})

test_that("input with a zero byte is refused", {
  in_folder({
    writeBin(c(charToRaw("beta\n0."), as.raw(0), charToRaw("4\n")), "zero.csv")
    said <- cli("roll", "zero.csv")
    expect_identical(said$status, 3L)
    expect_match(said$err, "zero byte")
    writeBin(charToRaw("beta\r0.4\r"), "mac.csv")
    expect_identical(cli("roll", "mac.csv")$out, cli("roll", "--beta", "0.4")$out)
  })
})

test_that("a column named as an option replaces it; nearly so, it is refused", {
  acceleration <- function(...) {
    utils::read.csv(text = cli(..., "-", input = lines)$out)$acceleration_m_per_s2
  }
  for (name in c("angle_deg", "incline_angle_deg")) {
    lines <- c(paste0("beta,", name), "0.4,30", "0.4,-30")
    expect_equal(acceleration("roll"), c(1, -1) * 9.80665 * 0.5 / 1.4, tolerance = 1e-15)
    lines <- lines[1:2]
    expect_equal(acceleration("race"), 9.80665 * 0.5 / 1.4, tolerance = 1e-15)
  }
  for (name in c("height_m", "height_drop_m")) {
    said <- cli("roll", "-", input = c(paste0("beta,", name), "0.4,2"))
    expect_identical(said$status, 0L)
    expect_equal(
      utils::read.csv(text = said$out)$final_speed_m_per_s, sqrt(4 * 9.80665 / 1.4),
      tolerance = 1e-15
    )
  }
  lines <- c("beta,gravity_m_per_s2,angle_deg", "1,1.62,90")
  expect_equal(acceleration("roll"), 0.81, tolerance = 1e-15)
  expect_equal(acceleration("race"), 0.81, tolerance = 1e-15)
  refused <- function(verb, name, words = paste("unknown column", name)) {
    row <- if (grepl(",", name)) "0.4,30,20" else "0.4,30"
    said <- cli(verb, "-", input = c(paste0("beta,", name), row))
    expect_identical(said[c("status", "out")], list(status = 3L, out = character()), info = name)
    expect_match(said$err[1], words, fixed = TRUE)
  }
  for (verb in c("roll", "race")) {
    for (name in c("angle_dg", "angle-deg", "angle", "incline_angle", "gravity")) {
      refused(verb, name)
    }
    refused(verb, "angle_deg,incline_angle_deg", "exclude each other")
  }
  refused("roll", "heigth_m")
  refused("race", "frames", "`frames` is no column of bodies")
  # Other columns are kept.
  said <- cli("roll", "-", input = c("beta,temperature_k,object", "0.4,300,ball"))
  expect_match(said$out[2], "^0.4,300,ball,2.39576")
})

test_that("tumble takes one time, by option or by column", {
  names <- "ixx_kg_m2,iyy_kg_m2,izz_kg_m2,omega_x_rad_per_s,omega_y_rad_per_s,omega_z_rad_per_s"
  row <- "1,2,2.5,0.01,1,0"
  last <- function(...) {
    rows <- utils::read.csv(text = cli("tumble", "-", ...)$out)
    rows[c("final_qx", "final_omega_y_rad_per_s")]
  }
  both <- last(input = c(paste0(names, ",time_s"), paste0(row, ",10"), paste0(row, ",77")))
  for (i in 1:2) {
    one <- last("--time-s", c("10", "77")[i], input = c(names, row))
    expect_identical(unlist(both[i, ]), unlist(one))
  }
  said <- cli("tumble", "-", input = c(names, row))
  expect_identical(said$status, 2L)
  expect_match(said$err[1], "`--time-s` is missing", fixed = TRUE)
  table <- paste0(c(names, row), c(",time_s", ",1"))
  said <- cli("tumble", "-", "--time-s", "1", input = table)
  expect_identical(said[c("status", "out")], list(status = 2L, out = character()))
  expect_match(said$err[1], "exclude each other", fixed = TRUE)
})

test_that("a scene's text names no file", {
  skip_if_not_installed("yyjsonr")
  in_folder({
    for (text in c("wheel.json", "null", "5")) {
      writeLines(text, "name.json")
      said <- cli("trajectory", "name.json", "--times", "0,1")
      expect_identical(said[c("status", "out")], list(status = 3L, out = character()))
      expect_match(said$err[1], "name.json: The text is no scene", fixed = TRUE)
    }
  })
})

test_that("names that are empty are wrong usage", {
  for (names in c("", ",", "hoop,,disk")) {
    said <- cli("roll", "--objects", names)
    expect_identical(said[c("status", "out")], list(status = 2L, out = character()))
    expect_match(said$err[1], "`--objects` must be names with commas", fixed = TRUE)
  }
})

test_that("cells beyond the names are refused, and dropped where all are empty", {
  roll <- function(...) cli("roll", "-", input = c(...))
  plain <- roll("beta,incline_angle_deg", "0.4,20", "0.5,30")
  expect_identical(plain$status, 0L)
  expect_identical(roll("beta,incline_angle_deg", "0.4,20,", "0.5,30,"), plain)
  expect_identical(roll("beta,incline_angle_deg,", "0.4,20,", "0.5,30"), plain)
  expect_identical(roll("beta,incline_angle_deg,,", "", "0.4,20,,", "  ", "0.5,30, ,,"), plain)
  refused <- function(said, words) {
    expect_identical(said[c("status", "out")], list(status = 3L, out = character()))
    expect_match(said$err[1], words, fixed = TRUE)
  }
  refused(
    roll("beta,incline_angle_deg", rep("0.4,20", 6), "0.5,30,7"),
    "line 8: cell 3 has no name; line 1 has 2 names"
  )
  # R's table with row names, one name less than columns.
  refused(roll("beta", "1,0.4", "2,0.5"), "line 2: cell 2 has no name; line 1 has 1 name")
  refused(roll("", "beta,incline_angle_deg,", "0.4,20,x"), "line 3: cell 3 has no name; line 2 has")
  refused(
    roll("beta,incline_angle_deg", "0.4,20", "", "0.5"), "line 4 has 1 cell; line 1 has 2 names"
  )
  refused(roll("beta,,x", "1,2,3"), "line 1: column 2 has no name")
  refused(roll(",", ","), "line 1 has no names")
  refused(roll("beta,x,beta", "1,2,3"), "line 1: two columns have the name `beta`")
  refused(roll("beta;x", "1;2"), "line 1: commas must separate the names")
  refused(roll("beta,", ""), "no row below its names")
})

test_that("every reader of tables takes empty cells behind its lines, and no others", {
  axis <- c("x", "y", "z")
  lines <- list(
    tumble = c(paste(c(paste0("i", axis, axis, "_kg_m2"), paste0("omega_", axis, "_rad_per_s")),
                     collapse = ","), "1,2,2.5,0.01,1,0", "1,2,2.5,0.01,1,0"),
    precess = c("mass_kg,lever_arm_m,moment_of_inertia_kg_m2,spin_rad_per_s", "1,0.1,0.002,500"),
    inertia = c("shape,mass_kg,radius_m", "disk,1,2", "disk,1,2"),
    "check-inertia" = c("ixx,iyy,izz", "1,2,3", "1,2,3"),
    trajectory = c("time_s,torque_n_m", "0,0", "1,1")
  )
  more <- list(tumble = c("--time-s", "10"))
  for (verb in names(lines)) {
    words <- c(verb, if (verb == "trajectory") {
      c("--moment-of-inertia-kg-m2", "1", "--times", "0:1:1", "--torque-file")
    }, "-", more[[verb]])
    text <- lines[[verb]]
    plain <- cli(words, input = text)
    expect_identical(plain$status, 0L, info = verb)
    expect_identical(cli(words, input = paste0(text, ",")), plain, info = verb)
    expect_identical(cli(words, input = c(text[1], paste0(text[-1], ",,"))), plain, info = verb)
    at <- length(text)
    for (last in c(paste0(text[at], ",7"), sub(",[^,]*$", "", text[at]))) {
      said <- cli(words, input = c(text[-at], last))
      expect_identical(said$status, 3L, info = verb)
      expect_match(said$err[1], paste0("standard input: line ", at, "( |:)"), info = verb)
    }
    # Row labels as R and pandas write them.
    labels <- paste0(c("", seq_len(at - 1L)), ",", text)
    expect_identical(cli(words, input = labels)$status, 0L, info = verb)
  }
})

test_that("quoted cells, and the types of columns, are read.csv()'s", {
  lines <- c(
    " beta , object,yes,none,n", "0.4,\"a,b\",TRUE,,1", "", "NA,\"say \"\"x\"\"\",NA,,2",
    "1e-3,\"two", "", "lines\",F,, 3 ", "\"0.5\",it's #1,T,,", "Inf,\u00e9 ,T,,4"
  )
  read <- utils::read.csv(
    text = lines, check.names = FALSE, strip.white = TRUE, encoding = "UTF-8"
  )
  expect_identical(as.list(rotdyn:::cli_table(lines)), as.list(read))
  refused <- function(...) {
    said <- cli("roll", "-", input = c("beta,object", ...))
    expect_identical(said$status, 3L)
    said$err
  }
  expect_match(refused("0.4,\"a", "0.5,b"), "line 2: a quote is not closed")
  expect_match(refused("0.4,a", "0.5,b", "0.5,\"b"), "line 4: a quote is not closed")
  # Inches: read.csv() makes one row of the two lines.
  expect_match(
    refused("0.4,5\" pipe", "0.5,7\" pipe"), "line 2: a quote is not at the start of a cell"
  )
})

test_that("times", {
  times <- function(text) rotdyn:::cli_times(text, function(what) stop(what))
  expect_identical(times("0:1:0.1"), 0 + 0:10 * 0.1)
  expect_identical(times("0,1e-3,2:3:0.5"), c(0, 1e-3, 2, 2.5, 3))
  expect_identical(times("-1"), -1)
  for (bad in c("", "0:1", "0:1:0", "0:1:-1", "a", "0:1:0.1:2", "0:Inf:1", "0:1e9:1", "1;2")) {
    expect_error(times(bad))
  }
  # With its first, these are 1e7 + 1.
  expect_error(times("0:1e7:1"), "at most 1e7 times")
})

test_that("an internal fault is status 70, an unread pipe 141, an interrupt 130", {
  broken <- function(e) {
    list(rotdyn:::cli_verb("broken", "", c(0, 0), "it fails", list(), function(...) stop(e)))
  }
  said <- cli("broken", verbs = broken("no such thing"))
  expect_identical(said$status, 70L)
  expect_match(said$err, "internal fault: no such thing")
  expect_identical(
    cli("broken", "--format", "json", verbs = broken("x"))$err,
    '{"error":"fault","message":"x","status":70}'
  )
  expect_identical(cli("broken", verbs = broken("ignoring SIGPIPE signal"))$status, 141L)
  stopped <- structure(class = c("interrupt", "condition"), list(message = "", call = NULL))
  said <- cli("broken", verbs = broken(stopped))
  expect_identical(said[c("status", "err")], list(status = 130L, err = "rotdyn: interrupted"))
})

test_that("an error figure beyond the accuracy is status 4, with the rows", {
  warns <- list(rotdyn:::cli_verb("coarse", "", c(0, 0), "x", list(), function(...) {
    rotdyn:::warn_rotdyn("The bound is too large.", "accuracy", NULL)
    list(table = list(x = 1))
  }))
  expect_identical(cli("coarse", verbs = warns), list(
    status = 4L, out = c("x", "1"), err = "rotdyn: warning: The bound is too large."
  ))
})

test_that("every verb has help, and its examples parse", {
  verbs <- rotdyn:::cli_verbs()
  for (verb in verbs) {
    expect_identical(cli(verb$name, "--help")$out, cli("help", verb$name)$out)
    names <- vapply(c(verb$options, rotdyn:::cli_common()), `[[`, "", "name")
    expect_false(anyDuplicated(names) > 0)
    for (example in verb$example) {
      if (!startsWith(example, "rotdyn ")) next
      words <- strsplit(sub(" >.*", "", example), " ")[[1]]
      expect_identical(words[2], verb$name)
      words <- sub("^[$][A-Z_]+$", "1", words)
      expect_no_error(rotdyn:::cli_parse(words[-(1:2)], verb))
    }
  }
})

# Random command lines: words, options and files that are right, wrong and odd.
random_lines <- function(n, seed) {
  set.seed(seed)
  verbs <- rotdyn:::cli_verbs()
  verbs <- Filter(function(verb) verb$name != "work-precision", verbs)
  odd <- c("", "-", "--", "-x", "--=", "--beta=", "0,4", "1e400", "NaN", "NA", "-1", "\u00e9",
           "a b", "'", "\"", "\\", "{}", "*", "%s", "`x`", "{x}", "\xff\xfe")
  values <- c(odd, "0.4", "2", "1,2,3", "0:8:1", "0,1", "hoop,disk", "disk", "sphere", "1e-6",
              "csv", "json", "text", "axle_linear", "bash", "roll")
  files <- c("wheel.json", "two.jsonl", "bad.json", "body.json", "torque.csv", "balls.csv",
             "tensors.csv", "debris.csv", "arm.urdf", "empty", "folder", "none", "-")
  lapply(seq_len(n), function(i) {
    verb <- verbs[[sample(length(verbs), 1)]]
    options <- setdiff(vapply(c(verb$options, rotdyn:::cli_common()), `[[`, "", "name"), "out")
    parts <- replicate(sample(0:4, 1), simplify = FALSE, {
      option <- paste0("--", sample(options, 1))
      switch(sample(5, 1), sample(files, 1), sample(odd, 1), option,
             c(option, sample(values, 1)), paste0(option, "=", sample(values, 1)))
    })
    c(if (runif(1) < 0.95) verb$name else sample(odd, 1), unlist(parts),
      if ("times" %in% verb$needs && runif(1) < 0.7) c("--times", "0:8:2"))
  })
}

test_that("random command lines end with a status and words, never in a fault of ours", {
  skip_on_cran() # exhaustive: `make test` runs it
  skip_if_not_installed("yyjsonr")
  n <- as.integer(Sys.getenv(
    "ROTDYN_CLI_LINES", or_long("200", "1000")
  ))
  statuses <- integer()
  in_folder(for (line in random_lines(n, 20261122)) {
    said <- cli(line, input = "x")
    statuses <- c(statuses, said$status)
    bad <- !said$status %in% 0:4 ||
      !all(grepl("^(rotdyn: |  |[{])", said$err, useBytes = TRUE)) ||
      (said$status %in% 2:3 && !length(said$err))
    if (bad) {
      fail(paste(c("rotdyn", encodeString(line, quote = "'"), "->", said$status, said$err),
                 collapse = " "))
    }
  })
  expect_true(all(c(0L, 2L, 3L) %in% statuses))
})

# ---- as a process -------------------------------------------------------------------------------

# Runs a line of sh in which `rotdyn` is the command of the installed package.
in_shell <- function(line, folder, env = character()) {
  rotdyn <- system.file("exec", "rotdyn", package = "rotdyn")
  env <- c(
    env, paste0("R_LIBS=", shQuote(paste(.libPaths(), collapse = ":"))),
    paste0("ROTDYN_R=", shQuote(file.path(R.home("bin"), "R"))), "R_TESTS="
  )
  script <- c(paste0("cd ", shQuote(folder)), paste0("export ", paste(env, collapse = " ")),
              paste0("rotdyn() { ", shQuote(rotdyn), " \"$@\"; }"), line)
  file <- tempfile(fileext = ".sh")
  on.exit(unlink(file))
  writeLines(script, file)
  suppressWarnings(system2("sh", file, stdout = TRUE, stderr = TRUE))
}

test_that("the command in a shell: pipes, profiles, locales, interrupts", {
  skip_on_cran()
  skip_on_os("windows")
  folder <- tempfile("shell")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  wheel_json(folder)
  writeLines(c('cat("NOISE\n")', "options(OutDec = ',')"), file.path(folder, ".Rprofile"))
  five <- rotdyn:::cli_csv(as.list(rolling_table()))
  expect_identical(in_shell("rotdyn roll; echo $?", folder), c(five, "0"))
  expect_identical(
    in_shell("rotdyn roll", folder, c("LC_ALL=de_DE.UTF-8", "R_PROFILE_USER=.Rprofile")), five
  )
  expect_identical(in_shell("rotdyn roll 2>&1 >/dev/null", folder), character())
  expect_identical(
    in_shell("printf 'beta\\n0.4\\n' | rotdyn roll - | tail -n 1 | cut -d, -f1", folder), "0.4"
  )
  expect_identical(
    in_shell("rotdyn roll - < /dev/null; echo $?", folder),
    c("rotdyn: standard input: it is empty", "3")
  )
  # R itself takes none of these.
  expect_identical(
    in_shell(
      "for o in -e --args -g --vanilla -f; do rotdyn $o 1 2> /dev/null; echo $?; done", folder
    ),
    rep("2", 5)
  )
  # The reader leaves: no words of R's, status 141.
  said <- in_shell(paste(
    "{ rotdyn trajectory --moment-of-inertia-kg-m2 1 --times 0:1:0.00001 --quiet; echo $? >&2; } |",
    "head -n 1"
  ), folder)
  expect_identical(sort(said), sort(c(
    "141", paste(names(trajectory(scene_axle(1), 0)), collapse = ",")
  )))
  # Standard output is closed, or its disk is full; what stands there is kept.
  closed <- "rotdyn: standard output cannot be written: it is closed"
  expect_identical(in_shell("rotdyn roll 2>&1 >&- ; echo $?", folder), c(closed, "3"))
  expect_identical(in_shell("rotdyn roll --out a.csv >&- 2>&- ; echo $?", folder), "0")
  expect_identical(readLines(file.path(folder, "a.csv")), five)
  expect_identical(
    in_shell("echo old > b.csv; rotdyn roll --out /dev/stdout >> b.csv; cat b.csv", folder),
    c("old", five)
  )
  if (file.exists("/dev/full")) {
    full <- "rotdyn: standard output cannot be written: the disk is full"
    expect_identical(in_shell("rotdyn roll 2>&1 > /dev/full; echo $?", folder), c(full, "3"))
    expect_identical(in_shell("rotdyn help 2>&1 > /dev/full; echo $?", folder), c(full, "3"))
  }
  skip_if(Sys.which("timeout") == "", "there is no timeout")
  command <- shQuote(system.file("exec", "rotdyn", package = "rotdyn"))
  said <- in_shell(paste(
    "timeout --preserve-status -s INT 2 ", command,
    "work-precision --moment-of-inertia-kg-m2 1 --times 0,1 --min-batch-s 60; echo $?"
  ), folder)
  # Without words where it comes before R has begun.
  expect_identical(said[length(said)], "130")
  expect_identical(setdiff(said, "130"), "rotdyn: interrupted"[length(said) > 1L])
})
