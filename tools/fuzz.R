# Calls of every exported function with arguments drawn by type, some of them evil, and of the verbs
# on what comes back; damaged files. Sourced by nothing; run by tools/check-fuzz.sh:
#
#   Rscript tools/fuzz.R MINUTES [SEED]           child processes, one after the other
#   Rscript tools/fuzz.R calls N SEED [FROM]      N calls in this process; FROM: print from this one
#
# A failure: a crash; a call that does not stop within 3 s of its time limit; an error or a warning
# that is not the package's own, unless it was raised in a function that was an argument; growth of
# the open files or of the memory. A time limit that stops a call is counted and is no failure: the
# arguments may ask for years of steps.

limit_s <- 5
grace_s <- 3
calls_per_child <- 1500L
most_fd_growth <- 3
most_memory_growth_mb <- 150

arguments <- commandArgs(trailingOnly = TRUE)

# ---- the parent ---------------------------------------------------------------------------------

run_children <- function(minutes, seed) {
  cat("seed ", seed, ", ", minutes, " minutes\n", sep = "")
  end <- Sys.time() + 60 * minutes
  script <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
  log <- tempfile()
  failures <- sums <- NULL
  repeat {
    last <- tempfile()
    # A child makes 1500 calls; with a time limit each, this is far beyond what they need.
    status <- suppressWarnings(system2(
      file.path(R.home("bin"), "Rscript"),
      c(shQuote(script), "calls", calls_per_child, seed, "0", shQuote(last)),
      stdout = log, stderr = log, timeout = 900
    ))
    lines <- readLines(log, warn = FALSE)
    failures <- c(failures, grep("^not ok", lines, value = TRUE))
    counted <- grep("^fuzz calls:", lines, value = TRUE)
    if (length(counted)) {
      sums <- c(sums, counted)
    } else {
      where <- if (file.exists(last)) readLines(last, warn = FALSE) else "the start"
      failures <- c(failures, paste0(
        "not ok - seed ", seed, ": the process ended with status ", status, " in ", where[1]
      ))
      cat(utils::tail(lines, 10), sep = "\n")
    }
    seed <- seed + 1
    if (Sys.time() > end) break
  }
  cat(unique(failures), sep = "\n")
  numbers <- lapply(regmatches(sums, gregexpr("-?[0-9.]+", sums)), as.numeric)
  numbers <- if (length(numbers)) do.call(rbind, numbers) else matrix(0, 0, 5)
  cat(sprintf(
    "%.0f calls in %d processes, %.0f of them stopped by the time limit\n",
    sum(numbers[, 1]), nrow(numbers), sum(numbers[, 2])
  ))
  cat(sprintf(
    "growth in a process: at most %.0f open files, %.0f MB\n",
    max(numbers[, 3], 0), max(numbers[, 4], 0)
  ))
  cat("fuzz: ", nrow(numbers), " passed, ", length(unique(failures)), " failed\n", sep = "")
  quit(status = length(failures) > 0)
}

if (!identical(arguments[1], "calls")) {
  minutes <- as.numeric(c(arguments, 30)[1])
  seed <- if (length(arguments) > 1L) as.numeric(arguments[2]) else
    as.integer(Sys.time()) %% 1e6 * 1000
  run_children(minutes, seed)
}

# ---- values -------------------------------------------------------------------------------------

suppressPackageStartupMessages(library(rotdyn))
has <- function(package) requireNamespace(package, quietly = TRUE)
number <- as.integer(arguments[2])
seed <- as.numeric(arguments[3])
print_from <- as.integer(c(arguments, 0)[4])
last_call <- if (length(arguments) > 4L) arguments[5]
set.seed(seed)

one_of <- function(x) x[[sample.int(length(x), 1L)]]
chance <- function(p) stats::runif(1) < p

user_error <- function(...) {
  stop(structure(
    class = c("user_error", "error", "condition"), list(message = "the user's", call = NULL)
  ))
}
user_warning <- function(...) {
  warning(structure(
    class = c("user_warning", "warning", "condition"), list(message = "the user's", call = NULL)
  ))
  1
}

bytes <- function(x) {
  Encoding(x) <- "bytes"
  x
}
latin <- function(x) {
  Encoding(x) <- "latin1"
  x
}

setClass("fuzz_s4", representation(x = "numeric"))

forged_table <- function(class) {
  structure(
    list(time_s = 1), class = c(class, "tbl_df", "tbl", "data.frame"), row.names = 1L
  )
}

numbers <- list(
  0, -0, 1, -1, 0.5, 2, 3, 10, pi, NA_real_, NaN, Inf, -Inf, 1e308, -1e308, 1.7976931348623157e308,
  5e-324, -5e-324, 1e-310, 2.2250738585072014e-308, 1e-300, 1e300, 1e154, 1e-154, 1e16, 1e22, 1e-9,
  1 + 2^-52, 2^31, 2^53, 1L, 0L, -1L, NA_integer_, .Machine$integer.max, NA, TRUE
)
any_number <- function() one_of(numbers)

strange <- list(
  NULL, list(), list(1), list(a = 1, b = "x"), character(), numeric(), integer(), logical(),
  "", "x", NA_character_, "z", "{x}", "{.fn stop}", "%s", "a\nb", strrep("long ", 2000),
  bytes("a\xff"), latin("a\xe4"), "\u4e2d\u6587", "a\xff", c(a = 1), c("a", "b"),
  quote(x), quote(x + y), y ~ x, as.name("x"), expression(a), new.env(), globalenv(), sin, sum,
  `if`, function() 1, function(x) x, function(...) NULL, 1i, raw(2), as.raw(1:3), factor("a"),
  factor(c("1", NA)), Sys.Date(), as.POSIXct("2020-01-01", tz = "UTC"),
  structure(1, class = "difftime"),
  as.difftime(1, units = "mins"), data.frame(), data.frame(x = 1), data.frame(a = "x", b = 1:2),
  matrix(1, 2, 2), matrix(numeric(), 0, 3), array(1, c(1, 1, 1)), diag(3), matrix("a", 3, 3),
  structure(list(), class = "rot_body"),
  structure(list(), class = c("rot_scene_axle", "rot_scene")),
  structure(list(), class = "rot_torque"), structure(1, class = "rot_torque"),
  structure(list(), class = c("rot_scene_rotors", "rot_scene")), structure(1, class = "units"),
  structure(list(), class = c("rot_scene_clutch", "rot_scene")), structure(1, class = "nonsense"),
  structure(list(), class = c("unknown", "rot_scene")), structure(list(), class = "rot_resistance"),
  structure(list(), class = "rot_domain"), structure(list(), class = "rot_inertia_check"),
  structure(list(), class = "rot_inertia_knots"), structure(diag(3), class = "rot_inertia_tensor"),
  forged_table("rot_trajectory"), forged_table("rot_audit"), forged_table("rot_rolling_table"),
  forged_table("rot_inertia_check"), forged_table("rot_work_precision"),
  forged_table("rot_record"), structure(list(value = 1), class = "rot_measured"),
  structure(list(), class = "rot_swing_fit"), structure(list(), class = "mesh3d"),
  methods::new("fuzz_s4", x = 1),
  1:3 / 7,
  seq(0, 1, length.out = 1e5), rep(NA_real_, 1e4), as.list(1:20), stats::ts(1:3),
  numeric_version("1")
)

torque_functions <- list(
  function(time_s) 1, function(time_s) sin(3 * time_s), function(time_s) NA_real_,
  function(time_s) "a", function(time_s) numeric(), function(time_s) c(1, 2), function(t) NULL,
  user_error, user_warning, function(time_s) if (time_s > 0.5) user_error() else 1,
  function(time_s, theta_rad, omega_rad_per_s) -theta_rad - omega_rad_per_s,
  function(time_s, theta_rad, omega_rad_per_s) omega_rad_per_s^2,
  function(time_s, theta_rad, omega_rad_per_s) 1e300, function(time_s) 1e300 * time_s,
  function(time_s) ifelse(time_s > 0.3, 1, 0), function(time_s, theta_rad, omega_rad_per_s) Inf,
  function(time_s) stats::rnorm(1), function(time_s) structure(1, class = "units"), function(a, b) 1
)

with_unit <- function(x) {
  if (!has("units")) return(x)
  unit <- one_of(c("m", "kg", "s", "rad/s", "N*m", "1", "degree", "kg*m^2", "mm", "rpm"))
  units::set_units(x, unit, mode = "standard")
}

evil <- function() {
  switch(sample.int(9L, 1L),
    any_number(), any_number(), any_number(),
    unlist(replicate(sample.int(5L, 1L), any_number())),
    one_of(strange), one_of(strange), with_unit(as.double(any_number())), spoil(pooled()),
    one_of(torque_functions)
  )
}

# ---- objects that were made, whole and damaged --------------------------------------------------

pool <- new.env()
kinds <- c(
  "body", "scene", "torque", "resistance", "motion", "domain", "record", "measured", "swing",
  "other"
)
kind_of <- function(x) {
  known <- c(
    rot_body = "body", rot_scene = "scene", rot_torque = "torque", rot_resistance = "resistance",
    rot_trajectory = "motion", rot_domain = "domain", rot_record = "record",
    rot_measured = "measured", rot_swing_fit = "swing"
  )
  c(known[inherits(x, names(known), which = TRUE) > 0], "other")[[1]]
}
keep <- function(x) {
  if (utils::object.size(x) > 2e6) return()
  kind <- kind_of(x)
  have <- pool[[kind]]
  if (length(have) < 24L) pool[[kind]] <- c(have, list(x)) else
    pool[[kind]][[sample.int(24L, 1L)]] <- list(x)[[1]]
}
for (kind in kinds) assign(kind, list(), envir = pool)
keep(body_disk(2, 0.25))
keep(scene_axle(1, 1, resistance(0.1)))
keep(scene_axle(1, torque_gravity(1, 1), theta0_rad = 1))
keep(scene_rotors(c(1, 2, 1), 5, 0.1, omega0_rad_per_s = c(1, 0, 0)))
keep(scene_clutch(1, 2, 3, omega0_rad_per_s = c(4, 0)))
keep(scene_incline(body_sphere(1, 0.1), 20, static_friction = 0.1, v0_m_per_s = -1))
keep(scene_drive(c(1, 2), coupling_shaft(5), omega0_rad_per_s = c(1, 0)))
keep(scene_free(c(1, 2, 3), c(0.1, 2, 0.1)))
keep(scene_free(c(1, 2, 3), c(0.1, 2, 0.1), rotors = rotor("z", 0.1, 5), torque = c(0, 1, 0)))
keep(scene_pivot(place_body(body_disk(2, 0.2), c(0, 0, 0.2)), c(1, 0, 60)))
keep(torque_sinusoid(1, 2))
keep(resistance(0.1, 0.1, 0.1))
keep(domain_ball(1))
keep(measured(2, 0.1))
keep(measured(c(1, 1.1, 0.9)))
swinging <- trajectory(scene_axle(1, torque_gravity(1, 1), theta0_rad = 1), seq(0, 9, by = 0.1))
keep(motion_record(swinging, time_s = time_s, theta_rad = theta_rad))
keep(motion_record(swinging, time_s = time_s, omega_rad_per_s = omega_rad_per_s))
keep(motion_record(data.frame(t = cumsum(1:9 / 10)), time_s = t, pulses = 2))
keep(fit_swing(pool$record[[1]]))
for (scene in get("scene", pool)) keep(trajectory(scene, 0:3))
keep(rolling_table())
keep(check_inertia(body_disk(1, 1)))
keep(inertia_tensor(body_disk(1, 1)))
keep(audit(spin_up(time_s = 0:2)))
pooled <- function(kind = one_of(kinds)) {
  have <- get(kind, envir = pool)
  if (length(have)) one_of(have)
}

# An object with a part lost, replaced, or of another class.
spoil <- function(x) {
  inside <- function(y) {
    if (is.list(y) && length(y) && chance(0.6)) {
      i <- sample.int(length(y), 1L)
      y <- unclass_data(y)
      y[i] <- list(inside(y[[i]]))
      y
    } else {
      one_of(list(NULL, any_number(), one_of(strange), "a", list()))
    }
  }
  unclass_data <- function(y) y
  # A data frame whose rows and columns disagree is not ours to print.
  table <- is.data.frame(x)
  tryCatch(switch(if (table) sample(2:3, 1L) else sample.int(6L, 1L),
    {
      keep_class <- attributes(x)
      y <- if (is.list(x)) inside(unclass(x)) else x
      if (is.list(y) && length(y) == length(x)) attributes(y) <- keep_class
      y
    },
    {
      name <- if (table) "run" else one_of(c(names(attributes(x)), "run"))
      attr(x, name) <- one_of(list(NULL, 1, "a", list()))
      x
    },
    {
      run <- attr(x, "run")
      if (is.list(run)) attr(x, "run") <- inside(run)
      x
    },
    { class(x) <- rev(class(x)); x },
    { y <- unclass(x)[-1]; class(y) <- class(x); y },
    structure(pooled(), class = class(x))
  ), error = function(e) x)
}

# ---- arguments by name --------------------------------------------------------------------------

few <- function(n = sample.int(4L, 1L)) round(stats::runif(n, 0.1, 5), 2)
times <- function() one_of(list(0:3, c(0, 0.5, 2), 1, numeric(), c(-1, 0, 1), c(0, 100), 5))
plausible <- function(name, of) {
  if (name %in% c("scene")) return(pooled("scene"))
  if (startsWith(of, "read_") && !of %in% c("read_links") && name == "file") {
    return(damaged_record_file())
  }
  if (of == "motion_record" && name %in% names(motion_arguments)) return(motion_arguments[[name]])
  if (of == "uncertainty_budget" && name == "f") return(function(...) sum(..., 1))
  if (of == "uncertainty_budget" && name == "draws") return(100)
  of_motion <- of %in% c("audit", "augment", "glance", "motion_events")
  if (of_motion && name %in% c("object", "x", "motion")) return(pooled("motion"))
  switch(name,
    record = , records = pooled("record"),
    swing = one_of(list(2, pooled("measured"), pooled("swing"), pooled("record"))),
    restoring = one_of(list("gravity", "spring")), losses = one_of(list("viscous", "coulomb")),
    frame_rate_hz = 30, angle_unit = "deg", headings = c("time_s", "theta_rad"), run = 1,
    sheet = NULL, mark = NULL, centre = NULL, quantity = "rate", correlation = diag(1),
    body = , body_1 = , body_2 = one_of(list(pooled("body"), pooled("body"), 1)),
    bodies = one_of(list(c(1, 2, 3), list(pooled("body"), 2), c(0.5, 1))),
    torque = , torque_1 = , torque_2 =
      one_of(list(pooled("torque"), 1, NULL, one_of(torque_functions))),
    resistance = one_of(list(NULL, pooled("resistance"))),
    domain = pooled("domain"),
    f = , map = , jacobian = , inside = one_of(c(torque_functions, list(
      function(x, y, z) 1, function(x, y, z) x > 0, function(x, y, z) cbind(x, y, z)
    ))),
    time_s = if (grepl("knots|steps", of)) sort(few(3L)) else times(),
    torque_n_m = if (grepl("knots|steps|curve", of)) few(3L) else one_of(list(1, few())),
    breaks_s = one_of(list(NULL, numeric(), 1, c(0, 1))),
    coefficients = one_of(list(1, c(1, 2), diag(2))),
    accuracy = one_of(list(1e-9, 1e-3, 1e-12)),
    accuracies = 10^-c(3, 9), models = NULL, model = NULL,
    min_batch_s = 0, batches = 1, peers = list(), reference = "none", max_steps = 1e4,
    threads = one_of(list(1, 2)), axis = one_of(list("z", "x", c(0, 1, 1))),
    through = one_of(list("centre", "origin", c(0, 0, 1))),
    parameters = data.frame(moment_of_inertia_kg_m2 = few(3L), time_s = 1),
    objects = one_of(list(inertia_table(), rolling_table(), data.frame(beta = 0.5))),
    vertices_m = , vertices = rbind(c(0, 0), c(1, 0), c(0, 1)),
    data = data.frame(mass_kg = few(3L), x_m = few(3L), y_m = 0, z_m = 1),
    mesh = , file = damaged_file(of == "read_links"),
    inertia_kg_m2 = diag(few(3L) + 5), check = pooled("other"), sides = 5,
    lower_m = , lower = c(0, 0, 0), upper_m = , upper = c(1, 1, 1), ratios = 2,
    efficiency = 0.9, points = 1e3, seed = 1, name = "a name", products = "negative",
    moment_of_inertia_kg_m2 = if (of == "inertia_knots") few(3L) else few(1L),
    x = one_of(list(pooled("body"), diag(3), pooled("motion"))),
    angle_rad = 1, angle_deg = NULL,
    one_of(list(few(1L), few(1L), few()))
  )
}

# ---- damaged files ------------------------------------------------------------------------------

scratch <- tempfile("fuzz")
dir.create(scratch)
cube_ply <- c(
  "ply", "format ascii 1.0", "element vertex 4", "property float x", "property float y",
  "property float z", "element face 4", "property list uchar int vertex_indices", "end_header",
  "0 0 0", "1 0 0", "0 1 0", "0 0 1", "3 0 2 1", "3 0 1 3", "3 0 3 2", "3 1 2 3"
)
cube_obj <- c(
  "v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1", "f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"
)
corners <- list(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
cube_stl <- unlist(c("solid s", lapply(corners, function(f) {
  v <- c("0 0 0", "1 0 0", "0 1 0", "0 0 1")[f]
  c("facet normal 0 0 0", "outer loop", paste("vertex", v), "endloop", "endfacet")
}), "endsolid s"))
ply_binary <- function() {
  header <- c(
    "ply", "format binary_little_endian 1.0", "element vertex 4", "property float x",
    "property float y", "property float z", "element face 4",
    "property list uchar int vertex_indices", "end_header"
  )
  corners <- rbind(c(0, 0, 0), c(1, 0, 0), c(0, 1, 0), c(0, 0, 1))
  faces <- rbind(c(0L, 2L, 1L), c(0L, 1L, 3L), c(0L, 3L, 2L), c(1L, 2L, 3L))
  c(
    charToRaw(paste0(paste(header, collapse = "\n"), "\n")),
    writeBin(as.vector(t(corners)), raw(), size = 4L),
    unlist(lapply(1:4, function(i) c(as.raw(3), writeBin(faces[i, ], raw(), size = 4L))))
  )
}
urdf <- readLines(system.file("extdata", "arm.urdf", package = "rotdyn"), warn = FALSE)

damaged_file <- function(links = FALSE) {
  kind <- if (links) "urdf" else one_of(c("ply", "obj", "stl", "plyb"))
  content <- switch(kind,
    ply = cube_ply, obj = cube_obj, stl = cube_stl, urdf = urdf, plyb = NULL
  )
  bytes <- if (is.null(content)) ply_binary() else
    charToRaw(paste0(paste(content, collapse = "\n"), "\n"))
  for (i in seq_len(sample(0:4, 1L))) {
    n <- length(bytes)
    if (n < 2L) break
    at <- sample.int(n, 1L)
    bytes <- switch(sample.int(6L, 1L),
      replace(bytes, at, as.raw(sample(0:255, 1L))),
      bytes[seq_len(at)],
      bytes[-at],
      append(bytes, charToRaw(one_of(c("-", "9999999", "nan", "1e999", "<", "\n", " ", "&"))), at),
      append(bytes, bytes[seq(at, sample.int(n, 1L))], at),
      replace(bytes, at, as.raw(0))
    )
  }
  path <- file.path(scratch, paste0("file.", sub("plyb", "ply", kind)))
  writeBin(bytes, path)
  path
}

# Files of instruments, from the tests' own writers: a few changes of bytes, separators or rows.
tests <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
tests <- file.path(dirname(tests), "..", "tests", "testthat", "helper-files.R")
record_files <- local({
  source(tests, local = TRUE)
  lapply(dialect_files(), function(file) {
    list(name = basename(file), bytes = readBin(file, "raw", 1e6))
  })
})

damaged_record_file <- function() {
  file <- one_of(record_files)
  bytes <- file$bytes
  for (i in seq_len(sample(0:3, 1L))) {
    n <- length(bytes)
    if (n < 2L) break
    at <- sample.int(n, 1L)
    bytes <- switch(sample.int(6L, 1L),
      replace(bytes, sample.int(n, min(n, 5L)), as.raw(sample(0:255, min(n, 5L), TRUE))),
      bytes[seq_len(at)],
      bytes[-sample.int(n, max(1L, n %/% 50L))],
      {
        marks <- charToRaw(one_of(c(",;", ".,", ";\t", "\n ", "\"x", ",.", "E,")))
        replace(bytes, which(bytes == marks[1]), marks[2])
      },
      append(bytes, bytes[seq(at, sample.int(n, 1L))], at),
      as.raw(rbind(as.integer(bytes), 0L))
    )
  }
  path <- file.path(scratch, file$name)
  writeBin(bytes, path)
  path
}
motion_arguments <- list(
  data = data.frame(time_s = 0:9, theta_rad = cumsum(1:10), x_m = cos(0:9), y_m = sin(0:9)),
  time_s = "time_s", theta_rad = "theta_rad", theta_deg = NULL, theta_turns = NULL, counts = NULL,
  omega_rad_per_s = NULL, omega_deg_per_s = NULL, omega_rpm = NULL, pulses = NULL, x_m = NULL,
  y_m = NULL, counts_per_turn = 100, segment = NULL, source = "a table"
)

# ---- calls --------------------------------------------------------------------------------------

# Some write a file of any name that they are given.
setwd(tempdir())

# install_cli() would write into the home of who runs this.
exports <- setdiff(sort(getNamespaceExports("rotdyn")), "install_cli")

draw_call <- function() {
  of <- one_of(exports)
  f <- get(of, asNamespace("rotdyn"))
  wanted <- setdiff(names(formals(f)), "...")
  needed <- vapply(formals(f)[wanted], function(x) is.name(x) && !nzchar(x), NA)
  given <- wanted[needed | stats::runif(length(wanted)) < 0.3]
  values <- lapply(given, plausible, of)
  names(values) <- given
  many <- length(given)
  spoilt <- if (chance(0.7)) which(stats::runif(many) < 1.2 / max(many, 1))
  for (i in spoilt) values[i] <- list(evil())
  if (chance(0.03) && length(values)) values <- values[-sample.int(length(values), 1L)]
  if (chance(0.02) && "..." %in% names(formals(f))) values <- c(values, list(nonsense = evil()))
  list(of = of, f = f, values = values)
}

quietly <- function(expr) {
  sink(nullfile())
  on.exit(sink())
  force(expr)
}

verbs <- list(
  print = function(x) quietly(print(x)),
  format = function(x) format(x),
  summary = function(x) summary(x),
  audit = function(x) quietly(print(audit(x))),
  augment = function(x) augment(x),
  glance = function(x) glance(x),
  predict = function(x) stats::predict(x, times()),
  events = function(x) motion_events(x),
  rows = function(x) if (nrow(x)) quietly(print(x[1, ])),
  edited = function(x) {
    x[[2]] <- rev(x[[2]])
    quietly(print(x))
    audit(x)
  },
  autoplot = function(x) if (has("ggplot2")) ggplot2::ggplot_build(ggplot2::autoplot(x)),
  saved = function(x) {
    path <- file.path(scratch, "saved.rds")
    saveRDS(x, path)
    quietly(print(readRDS(path)))
  },
  run = function(x) trajectory(x, times(), max_steps = 1e4),
  choose = function(x) choose_model(x, times()),
  stops = function(x) stopping(x),
  period = function(x) period_of(x),
  when = function(x) time_when(x, theta_rad = 1, until_s = 1),
  modes = function(x) shaft_modes(x),
  add = function(x) x + x,
  scale = function(x) -2 * x / 3,
  scene = function(x) trajectory(scene_axle(1, x), times(), max_steps = 1e4),
  tensor = function(x) inertia_tensor(x),
  axes = function(x) principal_axes(x),
  moved = function(x) place_body(x, c(1, 0, 0)),
  joined = function(x) join_bodies(x, body_disk(1, 1)),
  check = function(x) check_inertia(x),
  product = function(x) quietly(print(sqrt(abs(x * 2 - x / 3)))),
  swings = function(x) quietly(print(fit_swing(x)))
)
verbs_for <- function(x) {
  common <- c("print", "saved")
  c(common, switch(kind_of(x),
    motion = c(
      "format", "summary", "audit", "augment", "glance", "predict", "events", "rows", "edited",
      "autoplot"
    ),
    scene = c("run", "choose", "stops", "modes", "period", "when"),
    torque = c("add", "scale", "scene"),
    record = c("rows", "swings"),
    measured = "product",
    body = c("tensor", "axes", "moved", "joined", "check", "autoplot"),
    if (is.data.frame(x)) "format"
  ))
}

# R's own operators on what has become of another class are R's to refuse.
arithmetic <- c(add = "rot_torque", scale = "rot_torque", product = "rot_measured")

failures <- character()
limited <- 0L
done <- 0L

condition_text <- function(e) {
  text <- tryCatch(conditionMessage(e), error = function(e) "(no message)")
  text <- iconv(gsub("\\s+", " ", iconv(text, sub = "byte")), sub = "byte")
  paste0("[", class(e)[1], "] ", substr(text, 1, 160))
}

# What is not the package's own. Generics of other packages say that they have no method.
is_foreign <- function(e) {
  if (inherits(e, c("rotdyn_error", "rotdyn_warning", "user_error", "user_warning"))) return(FALSE)
  # A generic of another package that has no method for the class.
  !grepl(
    "no applicable method for '(glance|augment|autoplot|predict)'|not supported by autoplot",
    condition_text(e)
  )
}

attempt <- function(label, expr, shown) {
  done <<- done + 1L
  if (!is.null(last_call)) writeLines(paste0("call ", done, ", ", label), last_call)
  if (print_from > 0L && done >= print_from) {
    message(done, " ", label)
    utils::str(shown, give.attr = FALSE)
  }
  note <- function(e, what) {
    failures <<- c(failures, paste0(
      "not ok - ", label, " (seed ", seed, ", call ", done, "): ", what, condition_text(e)
    ))
  }
  start <- proc.time()
  setTimeLimit(elapsed = limit_s, transient = TRUE)
  value <- tryCatch(
    withCallingHandlers(
      suppressMessages(expr),
      warning = function(w) {
        if (is_foreign(w)) note(w, "")
        tryInvokeRestart("muffleWarning")
      }
    ),
    error = function(e) {
      setTimeLimit(elapsed = Inf)
      # Other packages wrap the error of the time limit in their own; the clocks differ by some ms.
      if (proc.time()[[3]] - start[[3]] >= limit_s - 0.05) {
        limited <<- limited + 1L
      } else if (is_foreign(e)) {
        note(e, "")
      }
      NULL
    }
  )
  setTimeLimit(elapsed = Inf)
  # By processor time, so that a busy machine is no hang; the parent stops a call that waits for
  # good.
  seconds <- sum(proc.time()[1:2]) - sum(start[1:2])
  if (seconds > limit_s + grace_s) {
    note(simpleError(sprintf("it stopped after %.1f s", seconds)), "slow: ")
  }
  value
}

open_files <- function() length(list.files("/proc/self/fd"))
memory_mb <- function() {
  gc(verbose = FALSE)
  status <- tryCatch(readLines("/proc/self/status"), error = function(e) "VmRSS: 0")
  as.numeric(gsub("[^0-9]", "", grep("^VmRSS", status, value = TRUE))) / 1024
}

make_calls <- function(until) {
  while (done < until) {
    call <- draw_call()
    value <- attempt(call$of, do.call(call$f, call$values, quote = TRUE), call$values)
    if (is.null(value)) next
    keep(value)
    use <- if (chance(0.15)) spoil(value) else value
    for (verb in sample(verbs_for(value), min(3L, length(verbs_for(value))))) {
      # A value that is none of the package's classes is not its to print.
      if (!identical(use, value) && !any(grepl("^rot_", class(use)))) break
      if (verb %in% names(arithmetic) && !inherits(use, arithmetic[[verb]])) next
      attempt(paste0(verb, " of ", call$of), verbs[[verb]](use), use)
    }
  }
}

make_calls(number / 3)
files_before <- open_files()
memory_before <- memory_mb()
make_calls(number)
files <- open_files() - files_before
memory <- memory_mb() - memory_before
if (files > most_fd_growth) failures <- c(failures, paste("not ok -", files, "files left open"))
# One call of 300 MB leaves a heap with holes that malloc() keeps but uses again: what is lost is
# lost a second time by as many calls more.
if (memory > most_memory_growth_mb) {
  memory_before <- memory_mb()
  make_calls(2 * number)
  again <- memory_mb() - memory_before
  if (again > most_memory_growth_mb) {
    failures <- c(failures, sprintf(
      "not ok - memory grew by %.0f MB, then by %.0f MB (seed %.0f)", memory, again, seed
    ))
  }
  memory <- min(memory, again)
}
unlink(scratch, recursive = TRUE)
cat(unique(failures), sep = "\n")
cat(sprintf("fuzz calls: %d, limited %d, files %d, memory %.0f\n", done, limited, files, memory))
if (is.null(last_call)) {
  cat("fuzz: ", as.integer(!length(failures)), " passed, ", length(failures), " failed\n", sep = "")
}
quit(status = length(failures) > 0)
