# Motions that a fit computes by trajectory(): of scenes with R functions, and of those that `build`
# makes.

# The inputs of what `build` makes: the unknowns, in the columns of inputs_that_vary().
unknown_of_build <- function(unknown, build, call) {
  check_function(build, "build", call)
  names <- names(unknown) %||% ""
  if (!is.numeric(unknown) || is.object(unknown) || !all(nzchar(names)) || anyDuplicated(names)) {
    abort_rotdyn(c(
      "With {.arg build}, {.arg unknown} must be named numbers: where the search starts.",
      x = "It is {describe_value(unknown)}.", i = "{.code unknown = c(stiffness = 3)}"
    ), "type", call)
  }
  data.frame(
    path = names, value = check_finite(unname(unknown), "unknown", "SI", call), low = -Inf,
    high = Inf, above = FALSE, unit = NA_character_
  )
}

# The scene with numbers for the unknowns that are inputs, by their names.
scene_of_numbers <- function(about, numbers, call) {
  if (is.null(about$build)) {
    return(scene_of_node(node_with(about$node, names(numbers), numbers, about$known), call))
  }
  scene <- about$build(as.list(numbers))
  if (!inherits(scene, "rot_scene")) {
    abort_rotdyn(c(
      "{.arg build} must return a scene.", x = "It returned {describe_value(scene)}."
    ), "type", call)
  }
  scene
}

# Columns of a motion by their names, `theta_rad[2]` of a body.
series_of_motion <- function(motion, index, names) {
  lapply(stats::setNames(names, names), function(name) {
    y <- motion[[without_place(name)]]
    if (is.null(index)) return(y)
    y[motion[[index]] == as.integer(sub("^.*\\[([0-9]+)\\]$", "\\1", name))]
  })
}

# What the core calls for a motion: the columns of a record at times, events up to each of them, the
# largest relative error; NULL where the numbers are refused. An error at the start is the user's.
run_for_fit <- function(about, call) {
  started <- FALSE
  model <- NULL
  motion_of <- function(record, numbers, time_s) {
    scene <- scene_of_numbers(about, stats::setNames(numbers, about$unknown), call)
    motion <- compute_trajectory(scene, time_s, about$accuracy, NULL, "abort", 1e6, call)
    constraint <- constraint_of(scene)
    names <- names(about$records[[record]]$series)
    columns <- series_of_motion(motion, constraint$index, names)
    lost <- names[lengths(columns) != length(time_s)]
    if (length(lost)) {
      abort_rotdyn("A motion of the fit lacks {.field {lost}}.", "argument", call)
    }
    run <- trajectory_run(motion)
    model <<- run$model
    list(
      value = as.double(unlist(columns, use.names = FALSE)),
      events = as.double(findInterval(time_s, sort(as.double(run$events$time_s)))),
      error = as.double(run$info$error)
    )
  }
  function(record, numbers, time_s) {
    found <- suppressMessages(suppressWarnings(
      if (started) {
        tryCatch(motion_of(record, numbers, time_s), rotdyn_error = function(e) NULL)
      } else {
        motion_of(record, numbers, time_s)
      }
    ))
    started <<- TRUE
    found
  }
}

# The model of the last motion.
model_of_run <- function(run) environment(run)$model
