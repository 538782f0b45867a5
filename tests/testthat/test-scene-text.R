# Scenes of every constraint, with each kind of law, start and body.
scenes_of_all <- function() {
  tensor <- matrix(c(2, .1, .2, .1, 3, .3, .2, .3, 4), 3)
  tilt <- attitude_from(c(1, 0, 0, pi / 6), "axis_angle")
  knots <- torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0))
  joined <- join_bodies(body_disk(1, .1), place_body(body_sphere(1, .05), c(.1, 0, .2)))
  terms <- torque_polynomial(c(0, 1, 3), rbind(c(1, 2, 3), c(3, 2, 1))) +
    torque_exponential(1, .2) + torque_curve(c(0, 1, 2), c(3, 2, 1)) + torque_gravity(1, .3) +
    torque_pulse(1 / 3, .1, 2)
  list(
    scene_axle(body_disk(2, 0.25), knots, resistance(viscous_n_m_s = 0.03)),
    scene_axle(body_rod_end(1.5, 2), 0.8, theta0_rad = -0.1, omega0_rad_per_s = 1 / 3),
    scene_axle(
      0.3, torque_sinusoid(1, 2, 0.3, from_s = 1) - 2 * torque_spring(3) + torque_motor(2, 30),
      resistance(.1, .2, .3, .4), axis = c(.1, .2, .3)
    ),
    scene_axle(body_box(1, .1, .2, .3), axis = c(1, 2, 3), through = c(.1, .2, .3)),
    scene_axle(body_box(1, .1, .2, .3), through = "centre"),
    scene_axle(inertia_knots(c(0, 1), c(2, 1)), torque_steps(c(0, 2), c(1, 2)), start_s = -1),
    scene_axle(1, terms),
    scene_axle(0.5, torque_knots(0:1, c(0, 0))),
    scene_axle(0.5, torque_knots(0:1, c(-0, 0), outside = "hold"), start_s = -1),
    scene_pendulum(body_point(2, .7), torque = torque_steps(0:1, c(0, 0))),
    scene_hanging_mass(0.1, 3, .2),
    scene_clutch(2, 3, 12, torque = list(torque_knots(0:1, c(0, 0)), NULL),
      omega0_rad_per_s = c(1, 0)),
    scene_drive(c(1, 2), coupling_gear(3), torque = list(torque_knots(0:1, c(0, 0)), NULL)),
    scene_axle(
      2, 3 * torque_knots(c(0, 1), c(1, 2), outside = "hold"), resistance(coulomb_n_m = .1)
    ),
    scene_pendulum(body_rod_end(.1, 1), theta0_rad = pi / 2),
    scene_pendulum(body_point(2, .7), torque = torque_constant(2) + knots, gravity_m_per_s2 = 1.6),
    scene_hanging_mass(body_disk(1, .2), 3, .2, counter_mass_kg = 1),
    scene_hanging_mass(0.1, 3, .2, resistance = resistance(.1)),
    scene_gears(c(1, 2, 3), c(2, -3), efficiency = .9, torque = c(1, 0, 0), resistance = .1),
    scene_gears(list(body_disk(1, .2), 3), 2, omega0_rad_per_s = 2),
    scene_gears(2, numeric()),
    scene_rotors(c(1, 2), 1000, omega0_rad_per_s = c(1, .5)),
    scene_rotors(
      list(a = body_disk(4, .2), body_disk(1, .1), 3), c(800, 1200), .05, torque = c(2, 0, -2)
    ),
    scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)),
    scene_clutch(
      body_disk(20, .15), body_disk(40, .2), 60, static_capacity_n_m = 75,
      torque = list(torque_knots(c(0, 2, 2, 5), c(30, 30, -10, -10)), -5), engage_s = -1
    ),
    scene_drive(
      c(1, 2, 3),
      list(
        coupling_shaft(100, .1, ratio = 2),
        coupling_clutch(torque_knots(c(0, 1), c(0, 2)), static_ratio = 1.2, from_s = 0)
      ),
      torque = list(1, NULL, 2), resistance = list(NULL, resistance(.1, .2, .3, .4), NULL),
      brake = list(NULL, NULL, brake(3, from_s = 2)), omega0_rad_per_s = 5
    ),
    scene_drive(c(1, 2), coupling_gear(3), torque = list(torque_motor(2, 30), 0)),
    scene_drive(list(body_disk(1, .1)), torque = 3),
    scene_incline(body_sphere(1, .1), 30, static_friction = .2, kinetic_friction = .15),
    scene_hoop(.05, .2, -9, theta0_rad = 1, static_friction = .2, kinetic_friction = .1),
    scene_hoop(.05, .2, 9, theta0_rad = 1e-3, resistance = resistance(drag_n_s_per_m = .1),
      start_s = 1),
    scene_chain(c(.3, .2), c(1, 2), c(1, -2), resistance = c(0, .1)),
    scene_chain(rep(.1, 3), .5, 1e-6, links = "points", omega0_rad_per_s = 1e-5),
    scene_incline(body_disk(1, .1), 30, v0_m_per_s = 1,
      resistance = resistance(drag_n_s2_per_m2 = .01)),
    scene_free(body_box(1, .1, .2, .3), c(1, 2, 3)),
    scene_free(
      c(1, 2, 2.5), c(.1, 2, .3), attitude0 = tilt, torque_axes = "space",
      resistance = resistance(damping_per_s = .1),
      torque = data.frame(time_s = c(0, 1), x_n_m = 1:2, y_n_m = 0, z_n_m = 3)
    ),
    scene_free(tensor, c(1, 2, 3), attitude0 = c(.3, .2, .1, .9) / sqrt(.95)),
    scene_free(
      place_body(body_box(1, .1, .2, .3), rotation = rotation_about(c(1, 2, 3), angle_rad = .7)),
      c(1, 2, 3), torque = c(1, 2, 3)
    ),
    scene_free(c(1, 1, 2.5), c(.1, 2, .3), rotors = rotor(c(0, 0, 1), 0.02, 300)),
    scene_free(
      body_box(10, .1, .2, .3), c(1, 2, 3), resistance = resistance(damping_per_s = .1),
      rotors = list(
        rotor(c(1, 2, 3), 1e-4, 1 / 3, 0), rotor("y", 2e-4, -20, 0.01),
        rotor("z", 1e-4, 0, data.frame(time_s = c(0, 1 / 3), torque_n_m = c(0.1, 0.2)))
      )
    ),
    scene_pivot(
      c(.0042, .0042, .002), c(0, 0, 60), mass_kg = .5, centre_m = c(0, 0, .08), attitude0 = tilt
    ),
    scene_pivot(body_cone(1, .1, .3), c(0, 0, 60), pivot_m = c(0, 0, .1)),
    scene_pivot(joined, c(0, 0, 60), pivot_m = c(0, 0, -.1))
  )
}

quiet <- function(x) suppressWarnings(suppressMessages(x))

expect_comes_back <- function(scene) {
  text <- write_scene(scene)
  back <- quiet(read_scene(text))
  expect_true(same_object(back, scene))
  expect_identical(write_scene(back), text)
  expect_identical(scene_hash(back), scene_hash(scene))
  expect_identical(hash_text(write_scene(back, indent = 0)), scene_hash(scene))
  invisible(back)
}

test_that("every scene comes back from text and computes the same bits", {
  skip_if_not_installed("yyjsonr")
  scenes <- quiet(scenes_of_all())
  known <- unlist(lapply(all_constraints(), function(constraint) {
    c(constraint$scene_class, names(constraint$makers))
  }))
  # An R function has no text.
  known <- setdiff(known, "rot_scene_equations")
  expect_setequal(unique(vapply(scenes, function(s) class(s)[1], "")), known)
  for (scene in scenes) {
    back <- expect_comes_back(scene)
    time_s <- scene$start_s + c(0, 0.3, 1)
    first <- quiet(trajectory(scene, time_s))
    second <- quiet(trajectory(back, time_s))
    columns <- function(x) lapply(seq_along(x), function(i) x[[i]])
    expect_identical(columns(second), columns(first))
    expect_identical(quiet(audit(second)), quiet(audit(first)))
  }
})

test_that("every constructor of scenes is written by some scene", {
  keys <- vapply(quiet(scenes_of_all()), function(s) names(scene_node(s, NULL))[2], "")
  written <- setdiff(grep("^scene_", names(text_readers()), value = TRUE), "scene_equations")
  expect_setequal(unique(keys), written)
})

test_that("every body comes back", {
  skip_if_not_installed("yyjsonr")
  disk <- body_disk(2, 0.25)
  corners <- cbind(c(0, 1, 1), c(0, 0, 2))
  turned <- place_body(body_box(1, .1, .2, .3), c(1, 2, 3), rotation_about("x", angle_deg = 30))
  shapes <- intersect(paste0("body_", shapes()$shape), getNamespaceExports("rotdyn"))
  expect_gt(length(shapes), 35)
  standard <- lapply(shapes, function(name) {
    make <- get(name, asNamespace("rotdyn"))
    need <- setdiff(names(formals(make)), c("...", "mass_kg"))
    need <- need[vapply(formals(make)[need], rlang::is_missing, NA)]
    value <- seq(0.9, 0.3, length.out = length(need))
    value[grepl("sides|corners|count", need)] <- 5
    do.call(make, c(list(mass_kg = 1.7), stats::setNames(as.list(value), need)))
  })
  bodies <- c(standard, list(
    body_disk(radius_m = .2, areal_density_kg_m2 = 3), turned, place_body(turned, c(.1, 0, 0)),
    join_bodies(disk, turned, name = "two"), place_body(join_bodies(disk, turned), c(0, 0, 1)),
    cut_body(disk, place_body(body_disk(.1, .05), c(.1, 0, 0))),
    body_polygon(1, corners), place_body(body_polygon(1, corners), c(1, 2, 3)),
    body_tetrahedron(1, rbind(0, diag(3))),
    body_points(data.frame(mass_kg = c(1, 2), x_m = 1:2, y_m = 0, z_m = c(0, 1))),
    body_tensor(diag(c(1, 2, 2.5)), mass_kg = 1), body_point(1, .5),
    body_density(function(x, y, z) 1 + x^2, domain_box(c(0, 0, 0), c(1, 2, 3))),
    place_body(body_rod_end(1, 2), c(0, 1, 0), rotation_about("y", angle_deg = 90))
  ))
  for (body in bodies) {
    back <- expect_comes_back(body)
    expect_identical(back$inertia_kg_m2, body$inertia_kg_m2)
    expect_identical(back$centre_m, body$centre_m)
  }
  expect_comes_back(scene_axle(turned, through = "origin"))
})

test_that("a person can write a scene: blanks, any order, defaults left out", {
  skip_if_not_installed("yyjsonr")
  text <- "
    {\"scene_axle\": {
      \"resistance\": {\"viscous_n_m_s\": 0.03},
      \"torque\": {\"torque_knots\": {\"torque_n_m\": [0, 0.8, 0.8, 0, 0],
                                      \"time_s\": [0, 1, 4, 6, 8]}},
      \"body\": {\"body_disk\": {\"mass_kg\": 2, \"radius_m\": 0.25}}}}"
  want <- scene_axle(
    body_disk(2, 0.25), torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)),
    resistance(viscous_n_m_s = 0.03)
  )
  expect_identical(scene_hash(read_scene(text)), scene_hash(want))
  file <- tempfile(fileext = ".json")
  on.exit(unlink(file))
  expect_identical(read_scene(write_scene(want, file)), want)
  expect_identical(read_scene(file), want)
  con <- textConnection(readLines(file))
  expect_identical(read_scene(con), want)
  close(con)
  expect_s3_class(
    read_scene("{\"scene_rotors\": {\"bodies\": [1, {\"body_disk\": {\"mass_kg\": 2,
      \"radius_m\": 0.5}}], \"stiffness_n_m_per_rad\": 100}}"), "rot_scene_rotors"
  )
})

test_that("R functions are refused by the name of the part", {
  f <- function(time_s) time_s
  refused <- function(scene, part) {
    expect_error(write_scene(scene), part, class = "rotdyn_error_scene", fixed = TRUE)
    expect_error(scene_hash(scene), part, class = "rotdyn_error_scene", fixed = TRUE)
  }
  refused(scene_axle(1, f), "torque")
  refused(scene_axle(1, torque_constant(1) + f), "torque[[2]]")
  refused(scene_incline(body_disk(1, .1), 10, force = f), "force")
  refused(scene_free(c(1, 2, 2.5), c(1, 0, 0), torque = function(t) c(0, 0, 0)), "torque")
  refused(
    scene_free(c(1, 2, 2.5), c(1, 0, 0), rotors = list(rotor("x", 0.1, 1), rotor("z", 0.1, 1, f))),
    "rotors[[2]]$torque"
  )
  refused(
    scene_drive(c(1, 2), list(coupling_clutch(f))), "couplings[[1]]$capacity_n_m"
  )
})

test_that("what constructors refuse, and unknown keys, are refused with the name", {
  skip_if_not_installed("yyjsonr")
  refused <- function(text, says) {
    expect_error(read_scene(text), says, class = "rotdyn_error_scene")
  }
  refused("{\"scene_axle\": {\"body\": {\"body_disk\": {\"mass_kg\": -2, \"radius_m\": 1}}}}",
          "body_disk")
  refused("{\"scene_axle\": {\"body\": {\"body_disc\": {\"mass_kg\": 2}}}}", "body_disk")
  refused("{\"scene_axle\": {\"body\": 1, \"friction\": 2}}", "friction")
  # Latin-1 and UTF-8 alike; a session's own strings count as UTF-8.
  key <- "{\"scene_axle\": {\"body\": 1, \"tor\u00e7ue\": 2}}"
  refused(key, "tor\u00e7ue")
  refused(iconv(key, "UTF-8", "latin1"), "tor\u00e7ue")
  unmarked <- key
  Encoding(unmarked) <- "unknown"
  refused(unmarked, "tor\u00e7ue")
  refused("{\"scene_axel\": {\"body\": 1}}", "scene_axle")
  refused("{\"scene_axle\": {}}", "scene_axle")
  refused("{\"scene_axle\": 3}", "object")
  refused("{\"scene_format\": 2, \"scene_axle\": {\"body\": 1}}", "scene_format")
  refused("{\"scene_axle\": {\"body\": 1}, \"scene_free\": {}}", "one key")
  refused("[1, 2]", "no scene")
  refused("{\"system\": {\"command\": \"id\"}}", "Unknown key")
  refused("{\"torque_constant\": {\"torque_n_m\": 1}}", "Unknown key")
  refused("{\"scene_axle\": {\"body\": 1, \"torque\": {\"torque_function\": {\"f\": \"q()\"}}}}",
          "Unknown key")
  # A body's numbers must be those of a body, and of its shape.
  numbers <- function(...) json_text(list(rot_body = list(
    shape = "disk", mass_kg = 1, centre_m = c(0, 0, 0), ...
  )))
  refused(numbers(second_moment_kg_m2 = diag(c(1, -1, 1))), "rot_body")
  refused(numbers(second_moment_kg_m2 = matrix(1:9, 3)), "symmetric")
  refused(
    numbers(
      second_moment_kg_m2 = diag(c(1, 1, 0)), size_m = list(radius_m = 1), provenance = "formula"
    ), "disk"
  )
  expect_error(read_scene("no-such-file.json"), class = "rotdyn_error_file")
  expect_error(read_scene(3), class = "rotdyn_error_type")
  expect_error(write_scene(3), class = "rotdyn_error_type")
})

test_that("a null among numbers is an empty place of a list", {
  skip_if_not_installed("yyjsonr")
  text <- function(torque) {
    paste0("{\"scene_drive\": {\"bodies\": [1, 2], \"torque\": ", torque,
           ", \"couplings\": {\"coupling_gear\": {\"ratio\": 2}}}}")
  }
  drive <- function(...) scene_drive(c(1, 2), coupling_gear(2), torque = list(...))
  expect_identical(read_scene(text("[2.5, null]")), drive(2.5, NULL))
  expect_identical(read_scene(text("[null, 2]")), drive(NULL, 2))
  expect_identical(read_scene(text("[null, null]")), drive(NULL, NULL))
  expect_error(read_scene("{\"scene_axle\": {\"body\": 1, \"torque\": [1, null]}}"), "torque",
               class = "rotdyn_error_scene")
})

test_that("damaged texts are refused, or are scenes", {
  skip_if_not_installed("yyjsonr")
  set.seed(16)
  texts <- vapply(quiet(scenes_of_all()), write_scene, "", indent = 0)
  words <- c("{", "}", "[", "]", ",", ":", "\"", "null", "true", "-", "1e400", "\"Inf\"", "{}", "")
  outcome <- vapply(seq_len(or_long(60, 500)), function(i) {
    letters <- strsplit(texts[sample(length(texts), 1)], "")[[1]]
    at <- sample(length(letters), sample(3, 1))
    letters[at] <- switch(sample(4, 1),
      sample(words, length(at), TRUE), "", letters[sample(length(letters), length(at))],
      sample(c(0:9, letters[1:30]), length(at), TRUE)
    )
    if (runif(1) < 0.1) letters <- letters[seq_len(sample(length(letters), 1))]
    text <- paste(letters, collapse = "")
    result <- tryCatch(quiet(read_scene(paste0(" {", sub("^ *[{]", "", text)))), error = identity)
    if (inherits(result, c("rot_scene", "rot_body"))) return("scene")
    class(result)[1]
  }, "")
  expect_setequal(unique(outcome), c("scene", "rotdyn_error_scene"))
})

test_that("an edited scene is refused, or written as it is", {
  scene <- scene_axle(body_disk(2, 0.25), 1)
  scene$omega0_rad_per_s <- 5
  expect_match(write_scene(scene), "\"omega0_rad_per_s\": 5")
  scene$moment_of_inertia_kg_m2 <- 7
  expect_error(write_scene(scene), "moment_of_inertia_kg_m2", class = "rotdyn_error_type")
})

test_that("a zero byte is no blank", {
  skip_if_not_installed("yyjsonr")
  file <- tempfile()
  on.exit(unlink(file))
  writeBin(c(charToRaw('{"scene_axle":{"body":1'), as.raw(0), charToRaw("5}}")), file)
  refused <- function(expr) expect_error(expr, "zero byte", class = "rotdyn_error_scene")
  refused(read_scene(file))
  for (mode in c("", "r", "rb")) {
    con <- file(file, mode)
    refused(read_scene(con))
    close(con)
  }
  # The last line need not end.
  cat('{"scene_axle":\n{"body":15}}', file = file)
  con <- file(file)
  on.exit(close(con), add = TRUE, after = FALSE)
  expect_identical(read_scene(con), scene_axle(15))
  expect_identical(read_scene(file), scene_axle(15))
})

test_that("ten thousand unknown keys are refused at once", {
  skip_if_not_installed("yyjsonr")
  keys <- paste0("\"key_", seq_len(10000), "_rad\":1", collapse = ",")
  texts <- c(
    paste0("{\"scene_axle\":{", keys, "}}"), paste0("{", keys, "}"),
    paste0("{\"scene_axle\":{\"body\":{", keys, "}}}")
  )
  for (text in texts) {
    expect_soon(
      expect_error(read_scene(text), "key_10_rad", class = "rotdyn_error_scene"), 20
    )
  }
  # A key's place is named in words, not in markup.
  expect_error(read_scene('{"scene_axle":{"body":{"disk":1}}}'), "in \"body\"", fixed = TRUE)
})

test_that("scenes beyond double precision are refused where they are made", {
  beyond <- function(expr) expect_error(expr, "double precision", class = "rotdyn_error")
  for (friction in c(0.5, Inf)) {
    beyond(scene_incline(
      body_sphere(1, 1e-10), 20, static_friction = friction, v0_m_per_s = 1e300
    ))
  }
  # Whatever follows from the arguments.
  scene <- scene_axle(1, 1)
  expect_identical(sound_scene(scene, NULL), scene)
  scene$omega0_rad_per_s <- Inf
  expect_error(sound_scene(scene, NULL), "omega0_rad_per_s.*Inf", class = "rotdyn_error_range")
  skip_if_not_installed("yyjsonr")
  text <- '{"scene_incline":{"body":{"body_sphere":{"mass_kg":1,"radius_m":1e-10}},
    "incline_angle_deg":20,"v0_m_per_s":1e300}}'
  expect_error(read_scene(text), class = "rotdyn_error_scene")
})

test_that("bodies joined deeply, or to themselves, have a short text that computes the same", {
  skip_if_not_installed("yyjsonr")
  ball <- place_body(body_sphere(1, 0.1), c(0.3, 0, 0))
  deep <- function(n) Reduce(function(body, i) join_bodies(body, ball), seq_len(n), body_disk(1, 1))
  levels <- function(text) {
    letters <- strsplit(gsub("[^][{}]", "", text), "")[[1]]
    max(cumsum(ifelse(letters %in% c("[", "{"), 1, -1)))
  }
  for (n in or_long(c(10, 25, 26, 100), c(10, 25, 26, 27, 31, 100, 400))) {
    body <- deep(n)
    scene <- scene_axle(body, 0.8, through = "centre")
    text <- write_scene(scene, indent = 0)
    expect_lte(levels(text), 90)
    expect_identical(grepl("join_bodies", text), n <= 25)
    back <- read_scene(text)
    expect_identical(back$moment_of_inertia_kg_m2, scene$moment_of_inertia_kg_m2)
    expect_identical(scene_hash(back), scene_hash(scene))
  }
  # Far beyond what R's own stack holds, and what it takes to look at them ends long before.
  expect_false(text_is_short(deep(3000)))
  placed <- Reduce(
    function(body, i) place_body(join_bodies(body, ball), c(0.1, 0, 0)), 1:40, body_disk(1, 1)
  )
  expect_identical(scene_hash(read_scene(write_scene(placed))), scene_hash(placed))
  # 2^8 and 2^40 disks: mass exact, time not.
  doubled <- function(n) {
    Reduce(function(body, i) join_bodies(body, place_body(body, c(i, 0, 0))), seq_len(n),
           body_disk(1, 1))
  }
  for (n in c(8, 9, 10, 40)) {
    body <- doubled(n)
    text <- expect_soon(write_scene(body, indent = 0), 20)
    expect_identical(grepl("join_bodies", text), n <= 9)
    if (n != 9) expect_identical(read_scene(text)$mass_kg, 2^n)
  }
  # Many bodies side by side are written as they are.
  flat <- join_bodies(lapply(1:600, function(i) place_body(body_disk(1, 1), c(i, 0, 0))))
  expect_true(grepl("join_bodies", write_scene(flat)))
})

test_that("a polynomial of several pieces is written as one, row by row", {
  file <- tempfile(fileext = ".json")
  on.exit(unlink(file))
  write_scene(
    scene_axle(1, torque_polynomial(c(0, 1, 3), rbind(c(1, 2, 3), c(4, 5, 6)))), file
  )
  text <- gsub("[[:space:]]", "", paste(readLines(file), collapse = ""))
  expect_match(text, '"torque_polynomial"', fixed = TRUE)
  expect_match(text, "[[1,2,3],[4,5,6]]", fixed = TRUE)
  constant <- scene_axle(1, torque_polynomial(c(0, 1, 2), rbind(1, 2)))
  expect_identical(read_scene(write_scene(constant)), constant)
})

test_that("a body of a standard shape has the moments of its sizes, in any axes", {
  check <- function(factor) {
    body <- body_disk(2, 0.25)
    body$second_moment_kg_m2 <- body$second_moment_kg_m2[c(3, 1, 2), c(3, 1, 2)] * factor
    rotdyn:::check_shape_numbers(body, NULL)
  }
  for (factor in 1 + c(0, 1e-11)) expect_s3_class(check(factor), "rot_body")
  for (factor in 1 + c(-1e-7, 1e-7)) {
    expect_error(check(factor), "not those of a disk", class = "rotdyn_error_value")
  }
})

test_that("texts are indented by at most eight blanks", {
  scene <- scene_axle(1)
  expect_match(write_scene(scene, indent = 8), "\n        \"", fixed = TRUE)
  for (indent in c(-1, 9)) {
    expect_error(write_scene(scene, indent = indent), class = "rotdyn_error_value")
  }
})

test_that("scenes are written like this", {
  text <- unlist(lapply(suppressWarnings(scenes_of_all()), write_scene))
  # Twelve digits: sines and cosines differ in the last between machines.
  number <- "-?[0-9]+[.][0-9]{12,}(e[-+]?[0-9]+)?"
  at <- gregexpr(number, text)
  regmatches(text, at) <- lapply(regmatches(text, at), function(x) {
    format(as.numeric(x) * (1 + 1e-15), digits = 12, trim = TRUE)
  })
  expect_snapshot(writeLines(text))
})

test_that("each law of torque is written by the arguments of its constructor", {
  laws <- list(
    torque_polynomial = torque_polynomial(c(0, 1, 3), rbind(c(1, 2, 3), c(3, 2, 1))),
    torque_sinusoid = torque_sinusoid(1, 2, 0.3, from_s = 1),
    torque_exponential = torque_exponential(1, 0.2),
    torque_curve = torque_curve(c(0, 1, 4), c(3, 2, 1)), torque_spring = torque_spring(2, 0.5)
  )
  for (name in names(laws)) {
    text <- write_scene(scene_axle(1, laws[[name]]))
    expect_match(text, paste0("\"", name, "\""), fixed = TRUE)
  }
  text <- gsub("\\s", "", write_scene(scene_axle(1, laws$torque_curve)))
  expect_match(text, "\"omega_rad_per_s\":[0,1,4],\"torque_n_m\":[3,2,1]", fixed = TRUE)
})

test_that("a law or a resistance of zeros alone is the scene without it", {
  bare <- scene_hash(scene_axle(1))
  zeros <- list(
    scene_axle(1, 0), scene_axle(1, torque_constant(0)), scene_axle(1, resistance = resistance()),
    scene_axle(1, torque_constant(0), resistance(0, 0, 0))
  )
  expect_identical(vapply(zeros, scene_hash, ""), rep(bare, 4))
  # What begins or ends with zero is a law.
  expect_false(scene_hash(scene_axle(1, torque_knots(c(0, 1), c(0, 1)))) == bare)
})

test_that("warnings of the constructors name the call that reads", {
  text <- '{"scene_format": 1, "scene_free": {"body": [1, 2, 3], "omega0_rad_per_s": [1, 0, 0],
    "attitude0": [0.9, 0.1, 0, 0]}}'
  file <- tempfile(fileext = ".json")
  on.exit(unlink(file))
  writeLines(text, file)
  said <- expect_warning(scene <- read_scene(file), class = "rotdyn_warning_normalised")
  expect_identical(conditionCall(said), quote(read_scene(file)))
  expect_equal(scene$attitude0[1], 0.9 / sqrt(0.82), tolerance = 1e-15)
})
