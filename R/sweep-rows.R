# Rows of a sweep, computed in the way of its plan.

# The sweep as src/glue/block.c reads it.
core_sweep <- function(plan, threads = 1) {
  list(
    node = plan$node, inputs = plan$inputs, bound = plan$bound, time_s = plan$time_s,
    model = plan$model, table = as.double(plan$kind == "table"),
    asked = as.double(plan$asked), accuracy = plan$accuracy, max_steps = plan$max_steps,
    outputs = plan$outputs, design = plan$design,
    derived = unname(plan$derived),
    # A thread takes some milliseconds of work at a time.
    part = max(1, min(if (plan$kind == "table") 8192 else 1024,
                      floor(5e-3 / (plan$row_s %||% 1e-5)))), threads = as.double(threads)
  )
}

row_statuses <- function() {
  if (is.null(registry_texts$statuses)) {
    registry_texts$statuses <- .Call(ffi_sweep_statuses)
  }
  registry_texts$statuses
}

# Rows first .. first + n - 1, from 1, up to 2^16 => list(input, output, status, error): columns of
# the design's and the derived inputs, of the outputs, places of row_statuses() from 0, error
# figures.
rows_of_sweep <- function(plan, first, n, threads = 1, progress = NULL, call) {
  if (plan$kind == "scene") return(rows_of_scenes(plan, first, n, progress, call))
  found <- .Call(ffi_sweep_rows, core_sweep(plan, threads), first - 1, n, progress)
  if (!is.null(found$refused)) abort_refused(found, plan, call)
  found
}

input_columns <- function(plan, first, n) {
  input <- .Call(ffi_design_rows, plan$design, first - 1, n)
  for (program in plan$derived) input[[length(input) + 1L]] <- derived_values(program, input, n)
  input
}

all_inputs <- function(plan) c(names(plan$design$inputs), names(plan$derived))

# The scene of a row, from 1; `row`: its inputs by name, where they are known.
scene_of_row <- function(plan, i, call, row = NULL) {
  if (is.null(row)) {
    row <- lapply(input_columns(plan, i, 1), identity)
    names(row) <- all_inputs(plan)
  }
  if (!is.null(plan$build)) {
    scene <- tryCatch(plan$build(row), error = function(e) {
      if (inherits(e, "rotdyn_error") || is_time_limit(e)) rlang::cnd_signal(e)
      abort_rotdyn(
        "{.arg build} fails in row {whole_words(i)}.", "build", call, parent = e, row = i
      )
    })
    if (!inherits(scene, "rot_scene")) {
      abort_rotdyn(c(
        "{.arg build} must return a scene.",
        x = "Of row {whole_words(i)} it returned {describe_value(scene)}."
      ), "type", call, row = i)
    }
    kind <- constraint_of(scene)$id
    if (!is.null(plan$constraint) && kind != plan$constraint) {
      abort_rotdyn(c(
        "{.arg build} must return scenes of one kind.",
        x = "The first one is of the kind {.val {plan$constraint}}, that of row {whole_words(i)} of
             {.val {kind}}."
      ), "type", call, row = i)
    }
    return(scene)
  }
  paths <- setdiff(plan$inputs, if (!"time_s" %in% plan$known$path) "time_s")
  values <- unlist(row[paths], use.names = FALSE)
  scene_of_node(node_with(plan$node, paths, values, plan$known), call)
}

# The times of a row: the start, and those of the plan, as src/core/sweep/rows.c has them.
times_of_row <- function(plan, scene, row) {
  time_s <- plan$time_s
  if (is.null(plan$build) && "time_s" %in% plan$inputs && !"time_s" %in% plan$known$path) {
    last <- row$time_s
    time_s <- c(time_s[-length(time_s)], last)
    time_s <- c(time_s[-length(time_s)][time_s[-length(time_s)] <= last], last)
  }
  start <- scene$start_s %||% 0
  if (time_s[1] > start) c(start, time_s) else time_s
}

motion_of_row <- function(plan, scene, row) {
  trajectory(
    scene, times_of_row(plan, scene, row), accuracy = plan$accuracy,
    model = plan$model, max_steps = plan$max_steps
  )
}

rows_of_scenes <- function(plan, first, n, progress, call) {
  input <- input_columns(plan, first, n)
  names(input) <- all_inputs(plan)
  output <- matrix(NaN, n, length(plan$outputs))
  status <- integer(n)
  error <- rep(NaN, n)
  for (i in seq_len(n)) {
    row <- lapply(input, `[[`, i)
    found <- tryCatch(
      suppressWarnings({
        scene <- scene_of_row(plan, first + i - 1, call, row)
        motion <- motion_of_row(plan, scene, row)
        list(outputs_of_motion(motion, plan$outputs), trajectory_run(motion)$info$error)
      }),
      error = identity
    )
    if (inherits(found, "error")) {
      status[i] <- status_of_error(found, first + i - 1, call)
    } else {
      output[i, ] <- found[[1]]
      error[i] <- found[[2]]
    }
    if (!is.null(progress)) progress(i / n)
  }
  list(
    input = unname(input), output = lapply(seq_along(plan$outputs), function(k) output[, k]),
    status = status, error = error
  )
}

# An error of row i by the class of its condition; what is none of the statuses is a fault of the
# user's function and ends the sweep.
status_of_error <- function(e, i, call) {
  if (is_time_limit(e)) rlang::cnd_signal(e)
  kind <- sub("^rotdyn_error_", "", class(e)[startsWith(class(e), "rotdyn_error_")][1])
  same <- c(scene = "value", inertia = "value", accuracy = "model", time = "value")
  at <- match(if (kind %in% names(same)) same[[kind]] else kind, row_statuses())
  if (!is.na(at)) return(at - 1L)
  # Its message names the row.
  if (!is.null(e$row)) rlang::cnd_signal(e)
  abort_rotdyn(c(
    "An R function of the sweep fails in row {whole_words(i)}.",
    i = "A row that it cannot take: a torque of NaN, or a number that the constructor refuses, gives
         it a status."
  ), if (is.na(kind)) "build" else kind, call, parent = e)
}
