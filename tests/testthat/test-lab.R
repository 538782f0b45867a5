error <- function(code, class) expect_error(code, class = paste0("rotdyn_error_", class))

page_state <- function(lines) {
  at <- which(lines == "<script type=\"application/json\" id=\"rotdyn-state\">")
  expect_length(at, 1)
  lines[at + 1L]
}

disk <- scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03))
by_function <- scene_axle(2, function(time_s, theta_rad, omega_rad_per_s) 1 - omega_rad_per_s)

test_that("the page without a scene is the file of the package", {
  path <- system.file("lab", "lab.html", package = "rotdyn")
  expect_identical(format(lab()), readLines(path, encoding = "UTF-8", warn = FALSE))
  expect_identical(page_state(format(lab())), "{}")
})

test_that("the page has the scene and its times, and loads nothing", {
  skip_if_not_installed("yyjsonr")
  lines <- format(lab(disk, end_s = 7, title = "A </script> disk", language = "de"))
  expect_no_match(page_state(lines), "<", fixed = TRUE)
  state <- yyjsonr::read_json_str(page_state(lines))
  expect_equal(state$end, 7)
  expect_identical(state$lang, "de")
  expect_identical(state$title, "A </script> disk")
  expect_identical(scene_hash(read_scene(state$scene)), scene_hash(disk))
  # The rest of the page is as it was.
  expect_identical(lines[lines != page_state(lines)], {
    plain <- format(lab())
    plain[plain != "{}"]
  })
  expect_false(any(grepl("(src|href)=\"(https?:|//)", lines[1:40])))
})

test_that("a motion gives its times and its accuracy", {
  state <- lab(trajectory(disk, seq(0, 5, 0.1)))$state
  expect_identical(state[c("end", "rows")], list(end = 5, rows = 51L))
  expect_null(state$start)
  expect_null(state$accuracy)
  state <- lab(trajectory(disk, seq(1, 3, length.out = 401), accuracy = 1e-6))$state
  expect_identical(state$start, 1)
  expect_identical(state$accuracy, 1e-6)
  expect_null(state$rows)
  later <- scene_axle(2, 1, start_s = 4)
  expect_identical(lab(later)$state$end, 14)
})

test_that("a scene with an R function comes as a recording of its motion", {
  skip_if_not_installed("yyjsonr")
  motion <- trajectory(by_function, seq(0, 4, 0.5))
  lines <- format(lab(motion))
  recording <- yyjsonr::read_json_str(page_state(lines))$recording
  expect_identical(as.double(unlist(recording$time)), motion$time_s)
  for (name in c("theta_rad", "omega_rad_per_s", "rotational_kinetic_energy_j")) {
    expect_identical(as.double(unlist(recording$columns[[name]])), motion[[name]])
  }
  run <- attr(motion, "run")
  expect_identical(recording$report$model, run$model)
  expect_identical(recording$report$error, run$info$error)
  expect_identical(recording$said$constructor, "scene_axle")
  expect_identical(recording$said$constraint, "axle")
  # By the number of the measure, for the units of the page.
  said <- lab(motion)$state$recording$said$columns
  measure <- vapply(said, function(one) as.double(one$measure), 0)
  names(measure) <- vapply(said, `[[`, "", "name")
  expect_identical(
    measure[c("theta_rad", "omega_rad_per_s", "applied_torque_n_m")],
    c(theta_rad = 0, omega_rad_per_s = 1, applied_torque_n_m = -1)
  )
  expect_null(lab(motion)$state$scene)
  # Of a scene, too.
  expect_length(lab(by_function, end_s = 2)$state$recording$time, 401)
})

test_that("recordings of several rows for each time", {
  pull <- function(time_s, theta_rad, omega_rad_per_s) sin(time_s)
  drive <- scene_drive(c(1, 2), coupling_shaft(5), torque = list(pull, NULL))
  recording <- lab(trajectory(drive, 0:3))$state$recording
  expect_identical(recording$said$rows_per_time, 2)
  expect_length(recording$columns$theta_rad, 8)
  expect_length(recording$time, 4)
})

test_that("every scene that has a text has a page", {
  scenes <- list(
    scene_rotors(c(1, 2), 100), scene_clutch(2, 3, 12), scene_incline(body_sphere(1, 0.1), 20),
    scene_free(c(1, 2, 3), c(1, 0, 0)), scene_hoop(1, 1, 3), scene_chain(c(1, 1), 1, 0.1),
    scene_gears(c(1, 2), 3), scene_hanging_mass(body_disk(1, 0.1), 1),
    scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 1), scene_drive(c(1, 2), coupling_shaft(5)),
    scene_pivot(body_cone(1, 0.1, 0.2), c(0, 0, 60))
  )
  for (scene in scenes) expect_identical(lab(scene)$state$scene, write_scene(scene, indent = 0))
})

test_that("a file is written, whole", {
  path <- tempfile(fileext = ".html")
  expect_identical(lab(disk, path), path)
  expect_identical(readLines(path, encoding = "UTF-8", warn = FALSE), format(lab(disk)))
})

test_that("it prints what it has", {
  expect_output(print(lab(disk, title = "Spin-up")), "<rot_lab> Spin-up\n.*inputs, up to 10 s")
  expect_output(print(lab(by_function)), "recording: the scene has an R function")
  expect_output(print(lab()), "a list of scenes")
})

test_that("in a document it is an element, and its script one dependency", {
  skip_if_not_installed("knitr")
  old <- knitr::opts_knit$get("rmarkdown.pandoc.to")
  on.exit(knitr::opts_knit$set(rmarkdown.pandoc.to = old))
  knitr::opts_knit$set(rmarkdown.pandoc.to = "html")
  out <- knit_print.rot_lab(lab(disk, title = "\"a\" & <b>"))
  expect_match(out, "<rotdyn-lab scene=\"{&quot;scene_axle&quot;", fixed = TRUE)
  expect_match(out, "&quot;\\\\&quot;a\\\\&quot; &amp; \\\\u003cb>")
  dependency <- attr(out, "knit_meta")[[1]]
  expect_s3_class(dependency, "html_dependency")
  script <- readLines(file.path(dependency$src$file, dependency$script), encoding = "UTF-8")
  expect_identical(script[1], "(() => {")
  expect_identical(script[length(script)], "})();")
  expect_true(all(script %in% format(lab())))
  knitr::opts_knit$set(rmarkdown.pandoc.to = "latex")
  expect_match(knit_print.rot_lab(lab(disk, title = "Spin-up")), "Spin-up: a lab")
})

test_that("two labs of a self-contained document share the script", {
  skip_if_not_installed("rmarkdown")
  skip_if_not(rmarkdown::pandoc_available())
  folder <- tempfile()
  dir.create(folder)
  document <- function(name, labs) {
    source <- file.path(folder, paste0(name, ".Rmd"))
    writeLines(c(
      "---", "title: labs", "output: html_document", "---", "", "```{r}", "library(rotdyn)", labs,
      "```"
    ), source)
    rmarkdown::render(source, quiet = TRUE)
    paste(readLines(sub("Rmd$", "html", source), warn = FALSE), collapse = "\n")
  }
  hoop <- "lab(scene_hoop(1, 1, 3))"
  one <- document("one", hoop)
  two <- document("two", c(hoop, "lab(scene_rotors(c(1, 2), 100))"))
  places <- function(what) lengths(regmatches(two, gregexpr(what, two, fixed = TRUE)))
  expect_identical(places("<rotdyn-lab scene="), 2L)
  expect_lt(nchar(two, "bytes") - nchar(one, "bytes"), 5000)
})

test_that("wrong arguments are refused by name", {
  error(lab(1), "type")
  error(lab(disk, "lab.txt"), "value")
  error(lab(disk, 1), "type")
  error(lab(disk, end_s = 0), "time")
  error(lab(disk, end_s = "a"), "type")
  error(lab(disk, title = 1), "type")
  error(lab(disk, language = "xx"), "value")
  error(lab(disk, tempfile(fileext = ".html"), 3), "argument")
  error(lab(trajectory(disk, 1)), "time")
  error(lab(disk, file.path(tempfile(), "no.html")), "file")
})
