# A package that calls the core through inst/include/rotdyn.h: built here as its author would build
# it, with the installed header and with headers of other versions.

header <- system.file("include", "rotdyn.h", package = "rotdyn")
source_of_client <- system.file("examples", "linkingto", package = "rotdyn")

# Builds the example with the header changed by `edit`, and runs code with it in another session.
client_says <- function(code, edit = identity) {
  folder <- tempfile("client")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  file.copy(source_of_client, folder, recursive = TRUE)
  client <- file.path(folder, "linkingto")
  writeLines(edit(readLines(header)), file.path(client, "src", "rotdyn.h"))
  writeLines("PKG_CPPFLAGS = -I.", file.path(client, "src", "Makevars"))
  R <- file.path(R.home("bin"), "R")
  env <- paste0("R_LIBS=", paste(c(folder, .libPaths()), collapse = .Platform$path.sep))
  log <- suppressWarnings(system2(R, c(
    "CMD", "INSTALL", "--no-docs", "--no-test-load", paste0("--library=", folder), client
  ), stdout = TRUE, stderr = TRUE, env = env))
  if (!is.null(attr(log, "status"))) stop(paste(log, collapse = "\n"))
  script <- file.path(folder, "script.R")
  writeLines(c("library(rotdynclient)", code), script)
  suppressWarnings(system2(
    R, c("--vanilla", "--no-echo", "-f", script), stdout = TRUE, stderr = TRUE, env = env
  ))
}

skip_without_compiler <- function() {
  skip_on_cran()
  skip_if(Sys.which("make") == "", "there is no make")
  skip_if(Sys.which("gcc") == "" && Sys.which("cc") == "", "there is no C compiler")
}

test_that("the header and the package have one version", {
  defined <- function(name) {
    line <- grep(paste0("^#define ", name, " "), readLines(header), value = TRUE)
    gsub(paste0("^#define ", name, "|/\\*.*|[ \"]"), "", line)
  }
  expect_identical(defined("ROTDYN_VERSION"), as.character(utils::packageVersion("rotdyn")))
  expect_identical(defined("ROTDYN_API_MAJOR"), "1")
})

test_that("a client package computes the bits that R computes", {
  skip_without_compiler()
  said <- client_says(c(
    "stopifnot(identical(c_interface(), c(1L, 0L)))",
    "beta <- c(1, 0.5, 0.4, 2/3, 0)",
    "stopifnot(identical(rolling(beta, 20), rotdyn::rolling_acceleration(beta, 20)))",
    "scene <- rotdyn::scene_axle(0.0625, NULL, rotdyn::resistance(0.03), omega0_rad_per_s = 10)",
    "motion <- rotdyn::trajectory(scene, seq(0, 4, 0.1))",
    "stopifnot(identical(coasting(0.0625, 0.03, 10, seq(0, 4, 0.1)), motion$omega_rad_per_s))",
    "cat(conditionMessage(tryCatch(coasting(0, 0.03, 10, 1), error = identity)), sep = '\n')",
    "cat('done')"
  ))
  expect_identical(said[1], paste(
    "an argument is not possible: body must be greater than 0; it is 0"
  ))
  expect_identical(said[2], "done")
})

test_that("a client of another major version says so", {
  skip_without_compiler()
  said <- client_says(
    "cat(conditionMessage(tryCatch(rolling(1, 20), error = identity)))",
    function(lines) sub("define ROTDYN_API_MAJOR 1", "define ROTDYN_API_MAJOR 2", lines)
  )
  expect_match(said, "built for version 2 of rotdyn's C interface", fixed = TRUE, all = FALSE)
})

test_that("a client of a newer header names the function that is missing", {
  skip_without_compiler()
  said <- client_says(
    "cat(conditionMessage(tryCatch(rolling(1, 20), error = identity)), sep = '\n')
     cat(coasting(2, 0, 10, 1))",
    function(lines) {
      # A newer version appends a function; here it is the one that the client calls.
      at <- grep("X(double, rolling_acceleration", lines, fixed = TRUE)
      list <- grep("define ROTDYN_FUNCTIONS", lines, fixed = TRUE)
      end <- list - 1L + which(!endsWith(lines[-seq_len(list - 1L)], "\\"))[1]
      filler <- sub("rolling_acceleration", "something_else      ", lines[at])
      call <- sub("\\\\$", "", lines[at])
      c(lines[seq_len(at - 1)], filler, lines[(at + 1):(end - 1)],
        paste(lines[end], "\\"), call, lines[-seq_len(end)])
    }
  )
  expect_match(said[1], "^rotdyn [0-9.]+ lacks rolling_acceleration\\(\\): install a newer rotdyn$")
  expect_identical(said[2], "10")
})

# ---- objects by name -----------------------------------------------------------------------------

one_of <- function(...) list(...)[[sample.int(...length(), 1L)]]

random_body <- function() {
  one_of(
    10^stats::runif(1, -1, 1), random_compound(), random_compound(),
    body_disk(stats::runif(1, 0.5, 4), stats::runif(1, 0.2, 1)),
    body_rod_end(1, stats::runif(1, 0.5, 2)), body_point(stats::runif(1), stats::runif(1, 0.5, 1)),
    body_cylinder(radius_m = 0.3, length_m = 0.8, density_kg_m3 = 500)
  )
}

# With moments about all axes, away from the origin.
random_compound <- function() {
  box <- body_box(3, 0.4, 0.5, 0.3)
  placed <- function(body) {
    turn <- one_of(NULL, rotation_about(stats::rnorm(3), angle_deg = stats::runif(1, 0, 180)))
    place_body(body, stats::rnorm(3, 0, 0.3), turn)
  }
  places <- data.frame(mass_kg = stats::runif(5), x_m = stats::rnorm(5), y_m = stats::rnorm(5))
  corners <- matrix(c(0, 2, 2.5, 1, 0, 0, 0.5, 2), 4)
  one_of(
    placed(box), join_bodies(placed(box), list(placed(body_disk(1, 0.2)), body_sphere(1, 0.1))),
    cut_body(box, place_body(body_sphere(0.01, 0.05), stats::runif(3, -0.1, 0.1))),
    body_points(places),
    body_points(cbind(places[-1], z_m = stats::rnorm(5)), mass_kg = 0.2),
    body_polygon(2, corners), body_polygon(vertices_m = corners, areal_density_kg_m2 = 3),
    placed(body_tetrahedron(1, rbind(diag(3), 0) + 0.1))
  )
}

# A sum of up to four laws, or NULL.
random_torque <- function() {
  stepped <- torque_steps(c(0, 2, 5), stats::rnorm(3))
  laws <- list(
    torque_constant(stats::rnorm(1)), stepped, torque_motor(stats::runif(1, 0.5, 2), 10),
    torque_knots(sort(round(stats::runif(4, 0, 8), 1)), stats::rnorm(4), outside = "hold"),
    torque_pulse(stats::runif(3, 0, 8), stats::runif(1, 0.1, 2), stats::rnorm(1)),
    torque_sinusoid(stats::rnorm(1), stats::runif(1, 0.1, 5), to_s = 4),
    torque_exponential(stats::rnorm(1), stats::runif(1, 0.1, 2)),
    torque_polynomial(c(0, 2, 5), matrix(stats::rnorm(6), 2)),
    torque_spring(stats::runif(1, 0.1, 9)),
    torque_gravity(stats::runif(1, 0.1, 2), stats::runif(1, 0.1, 1)),
    torque_curve(c(-10, 0, 3, 10), c(1, 1, 0.5, -1)), torque_motor(stats::runif(1, 0.5, 2), 20)
  )
  laws <- laws[sample.int(12L, sample(0:4, 1))]
  if (length(laws)) Reduce(`+`, laws)
}

random_resistance <- function() {
  one_of(NULL, resistance(
    one_of(0, stats::runif(1)), one_of(0, 0, stats::runif(1), 1e-12), one_of(0, 0, stats::runif(1))
  ))
}

random_axle <- function() {
  body <- random_body()
  if (stats::runif(1) < 0.15) body <- inertia_knots(c(0, 2, 5), stats::runif(3, 0.5, 2))
  # A point and a rod have an axis without moment of inertia.
  thick <- inherits(body, "rot_body") && !body$shape %in% c("point", "rod_end")
  axis <- if (thick) one_of("z", "x", stats::rnorm(3)) else "z"
  suppressMessages(scene_axle(
    body, random_torque(), random_resistance(), one_of(0, stats::rnorm(1)), one_of(0, 3),
    start_s = one_of(0, 1), axis = axis
  ))
}

random_pendulum <- function() {
  suppressMessages(scene_pendulum(
    one_of(body_rod_end(1.5, 2), body_point(2, 0.5), body_disk(1, 0.2), body_box(1, 0.2, 0.3, 0.4)),
    stats::runif(1, 0.1, 2), random_resistance(), stats::rnorm(1), one_of(0, 2),
    torque = one_of(NULL, NULL, random_torque()), start_s = one_of(0, 1),
    axis = one_of("z", "x", stats::rnorm(3)), gravity_m_per_s2 = one_of(9.80665, 1.62)
  ))
}

random_hanging <- function() {
  scene_hanging_mass(
    one_of(0, 0.3, body_disk(2, 0.1), body_disk(0, 0.1), body_thick_tube(2, 0.1, 0.05, 1)),
    stats::runif(1, 0.1, 3), stats::runif(1, 0.05, 0.5), random_resistance(), one_of(0, 1),
    stats::rnorm(1), counter_mass_kg = one_of(0, 0, stats::runif(1, 0.1, 3))
  )
}

random_gears <- function() {
  n <- sample(1:4, 1)
  scene_gears(
    one_of(as.list(stats::runif(n, 0.01, 1)), replicate(n, body_disk(1, 0.2), simplify = FALSE)),
    sample(c(-3, -0.7, 0.5, 2, 5.1), n - 1, TRUE),
    efficiency = if (n > 1) one_of(1, stats::runif(n - 1, 0.4, 1)) else 1,
    torque = round(stats::rnorm(n), 2), resistance = one_of(0, stats::runif(n, 0, 0.3)),
    omega0_rad_per_s = stats::rnorm(1, sd = 5), start_s = one_of(0, 1)
  )
}

random_rotors <- function() {
  n <- sample(2:4, 1)
  scene_rotors(
    lapply(seq_len(n), function(i) random_body()), 10^stats::runif(n - 1, 1, 9),
    one_of(0, stats::runif(n - 1)), torque = stats::rnorm(n), resistance = one_of(0, 0.1),
    theta0_rad = one_of(0, stats::rnorm(n)), omega0_rad_per_s = stats::rnorm(n)
  )
}

random_clutch <- function() {
  capacity <- stats::runif(1, 0, 12)
  steps <- torque_steps(c(1, 2, 4), stats::rnorm(3))
  scene_clutch(
    random_body(), random_body(), capacity, static_capacity_n_m = capacity * one_of(1, 1.4),
    torque = list(one_of(NULL, steps, steps + torque_pulse(c(0.5, 3), 1, 2) + 1),
      one_of(NULL, stats::rnorm(1))),
    omega0_rad_per_s = c(10, 0), engage_s = one_of(-Inf, 0.7)
  )
}

random_drive <- function() {
  capacity <- one_of(stats::runif(1, 0, 8), torque_knots(c(0, 0.5), c(0, 8), outside = "hold"))
  coupling <- one_of(
    coupling_shaft(stats::runif(1, 50, 800), 0.2, ratio = one_of(1, -3)), coupling_gear(2),
    coupling_clutch(capacity, static_ratio = one_of(1, 1.2), ratio = one_of(1, 0.5))
  )
  scene_drive(
    list(random_body(), 2, random_body()), list(coupling, coupling_shaft(300)),
    torque = list(random_torque(), NULL, 1), resistance = list(NULL, random_resistance(), NULL),
    brake = one_of(NULL, list(NULL, NULL, brake(capacity, from_s = 1))),
    omega0_rad_per_s = one_of(0, 3)
  )
}

random_torques <- function() {
  one_of(NULL, stats::rnorm(3), {
    data.frame(time_s = c(0, 1, 1, 4), x_n_m = stats::rnorm(4), y_n_m = 0, z_n_m = stats::rnorm(4))
  })
}

random_wheels <- function() {
  motor <- data.frame(time_s = c(0, 1, 1, 3), torque_n_m = 1e-3 * stats::rnorm(4))
  wheel <- function(torque) rotor(stats::rnorm(3), 1e-3, stats::rnorm(1, 0, 30), torque)
  one_of(
    NULL, NULL, wheel(NULL), list(wheel(NULL), rotor("y", 2e-3, 5, 0)),
    list(wheel(1e-3), rotor("z", 1e-3, 4, motor))
  )
}

random_attitude <- function() {
  one_of(NULL, attitude_from(c(stats::rnorm(3), stats::runif(1, 0, 3)), "axis_angle"))
}

# A body, a tensor, or three moments.
random_tensor <- function() {
  turn <- qr.Q(qr(matrix(stats::rnorm(9), 3)))
  tensor <- turn %*% diag(c(0.1, 0.15, 0.2)) %*% t(turn)
  one_of(
    random_compound(), random_compound(), c(0.11, 0.12, 0.2), tensor / 2 + t(tensor) / 2
  )
}

random_free <- function() {
  scene_free(
    random_tensor(), stats::rnorm(3), attitude0 = random_attitude(), torque = random_torques(),
    torque_axes = one_of("body", "space"),
    resistance = resistance(damping_per_s = one_of(0, 0.1)), rotors = random_wheels(),
    start_s = one_of(0, 1)
  )
}

random_pivot <- function() {
  top <- stats::runif(1) < 0.4
  body <- if (top) c(0.0042, 0.0042, 0.002) else random_tensor()
  own <- inherits(body, "rot_body")
  arguments <- list(
    body, if (top) c(0, 0, one_of(60, 600)) else stats::rnorm(3), attitude0 = random_attitude(),
    torque = if (!top) random_torques(),
    resistance = resistance(damping_per_s = if (top) 0 else one_of(0, 0.1)),
    rotors = if (!top) random_wheels(), gravity_m_per_s2 = one_of(9.8, 0)
  )
  where <- if (own) list(pivot_m = stats::rnorm(3)) else {
    list(mass_kg = 0.5, centre_m = if (top) c(0, 0, 0.08) else stats::rnorm(3))
  }
  do.call(scene_pivot, c(arguments, where))
}

# The object of a constructor and its arguments, as write_scene() has them: its place.
c_object <- function(constructor, arguments) {
  at <- .C("new_object", constructor, at = 0L, PACKAGE = "c_objects")$at
  for (name in names(arguments)) c_set(at, name, arguments[[name]], name)
  at
}

# Sets the input `key`, or adds an item to a list (""), of what the input `name` takes.
c_set <- function(at, key, value, name) {
  status <- if (is.null(value)) {
    .C("set_nothing", at, key, status = 0L, PACKAGE = "c_objects")$status
  } else if (is.character(value) && !value %in% c("Inf", "-Inf")) {
    .C("set_text", at, key, value, status = 0L, PACKAGE = "c_objects")$status
  } else if (!is.list(value) && is.null(dim(value))) {
    value <- as.double(value)
    .C("set_numbers", at, key, length(value), value, status = 0L, NAOK = TRUE,
       PACKAGE = "c_objects")$status
  } else {
    .C("set_object", at, key, c_value(value, name), status = 0L, PACKAGE = "c_objects")$status
  }
  expect_identical(status, 0L, label = name)
}

c_value <- function(value, name) {
  if (is.matrix(value)) value <- lapply(seq_len(nrow(value)), function(i) value[i, ])
  if (!is.null(names(value))) {
    known <- length(value) == 1L &&
      .C("is_object", names(value), answer = 0L, PACKAGE = "c_objects")$answer == 1L
    return(if (known) c_object(names(value), value[[1]]) else c_object(name, value))
  }
  list <- c_object("list", NULL)
  for (item in value) c_set(list, "", item, name)
  list
}

# The shim, loaded until the test ends.
load_objects <- function(envir = parent.frame()) {
  skip_without_compiler()
  folder <- tempfile("shim")
  dir.create(folder)
  later <- function(call) do.call(on.exit, list(call, add = TRUE, after = FALSE), envir = envir)
  later(bquote(unlink(.(folder), recursive = TRUE)))
  file.copy(test_path("c_objects.c"), folder)
  log <- suppressWarnings(system2(
    file.path(R.home("bin"), "R"), c("CMD", "SHLIB", shQuote(file.path(folder, "c_objects.c"))),
    stdout = TRUE, stderr = TRUE, env = paste0("PKG_CPPFLAGS=-I", shQuote(dirname(header)))
  ))
  if (!is.null(attr(log, "status"))) stop(paste(log, collapse = "\n"))
  library <- dyn.load(file.path(folder, paste0("c_objects", .Platform$dynlib.ext)))
  later(bquote(dyn.unload(.(library[["path"]]))))
  .C("begin", PACKAGE = "c_objects")
}

test_that("objects made by name in C compute R's bits and its error, for random scenes", {
  load_objects()
  set.seed(16)
  models <- replicate(or_long(120, 350), {
    scene <- one_of(
      random_axle, random_axle, random_pendulum, random_hanging, random_gears, random_rotors,
      random_clutch, random_drive, random_free, random_pivot
    )()
    time_s <- sort(stats::runif(sample(c(1, 7, 40), 1), scene$start_s, 6))
    accuracy <- sample(c(1e-12, 1e-9, 1e-6), 1)
    asked <- if (inherits(scene, "rot_scene_drive")) one_of(NULL, "drive_rk8pd", "drive_radau")
    motion <- suppressWarnings(trajectory(scene, time_s, accuracy, asked))
    node <- scene_node(scene, NULL)[-1]
    at <- c_object(names(node), node[[1]])
    # R adds the other shafts of a train.
    names <- setdiff(names(motion), c("time_s", "rotor"))
    # R adds those of the other shafts.
    if (inherits(scene, "rot_scene_gears")) names <- names[!grepl("_[2-9]_", names)]
    rows_per_time <- .C("check", at, rows_per_time = 0L, strrep(" ", 200),
      PACKAGE = "c_objects")$rows_per_time
    rows <- length(time_s) * rows_per_time
    from_c <- .C("run", at, length(time_s), time_s, accuracy, asked %||% "", length(names), names,
      rows, columns = double(length(names) * rows), error = 0, status = 0L,
      model = strrep(" ", 200), NAOK = TRUE, PACKAGE = "c_objects"
    )
    .C("free_all", PACKAGE = "c_objects")
    run <- run_of(motion)
    expect_identical(from_c[c("error", "status", "model")],
                     list(error = run$info$error, status = 0L, model = run$model))
    # NaN of C is NA of R: what the last rotor has not.
    expected <- as.double(unlist(unclass(motion)[names], use.names = FALSE))
    expect_identical(ifelse(is.nan(from_c$columns), NA, from_c$columns), expected)
    run$model
  })
  expect_gt(length(unique(models)), 14L)
})

test_that("the audit of C is R's, number by number", {
  load_objects()
  set.seed(8)
  some <- function(maker) replicate(or_long(4, 12), maker(), simplify = FALSE)
  makers <- c(
    random_axle, random_axle, random_axle, random_pendulum, random_hanging, random_gears,
    random_rotors, random_clutch, random_drive, random_free, random_pivot
  )
  scenes <- c(unlist(lapply(makers, some), recursive = FALSE), list(
    scene_incline(body_sphere(2, 0.1), 30, static_friction = 0.1, v0_m_per_s = 2),
    scene_incline(body_disk(1, 0.2), 20, static_friction = 0.5,
      resistance = resistance(drag_n_s2_per_m2 = 0.3)),
    scene_hoop(1, 0.5, 6, theta0_rad = 0.3, resistance = resistance(drag_n_s_per_m = 0.2)),
    scene_hoop(1, 0.5, 3, theta0_rad = 1, static_friction = 0.2),
    scene_chain(c(1, 2), c(0.5, 0.4), theta0_rad = c(1, -0.5), resistance = 0.01)
  ))
  for (scene in scenes) {
    time_s <- scene$start_s + c(0.25, 1, 3)
    accuracy <- sample(c(1e-12, 1e-9, 1e-6), 1)
    want <- audit(suppressWarnings(trajectory(scene, time_s, accuracy)))
    node <- scene_node(scene, NULL)[-1]
    at <- c_object(names(node), node[[1]])
    for (k in seq_len(nrow(want))) {
      got <- .C("balance", at, 3L, time_s, accuracy, k - 1L,
        numbers = double(5), flags = integer(2), quantity = strrep(" ", 200),
        why = strrep(" ", 200), status = 0L, NAOK = TRUE, PACKAGE = "c_objects"
      )
      row <- want[k, ]
      expect_identical(got$status, 0L)
      expect_identical(
        got$numbers,
        c(row$change, row$supplied, row$dissipated, row$residual, row$rounding)
      )
      expect_identical(got$flags[1], match(row$verdict, c("unbalanced", "balanced")) - 1L)
      expect_identical(got$quantity, row$balance)
      expect_identical(got$flags[2] == 1L, row$conserved %in% TRUE)
    }
    done <- .C("balance", at, 3L, time_s, accuracy, nrow(want),
      double(5), integer(2), "", "", status = 0L, NAOK = TRUE, PACKAGE = "c_objects"
    )
    expect_identical(done$status, 11L)
    .C("free_all", PACKAGE = "c_objects")
  }
})
