# The plan of a sweep: which rows, which model computes them and how, what is kept, what it costs.

#' Plan a sweep
#'
#' Many scenes that differ in some numbers, a row each: `sweep_plan()` checks the inputs, chooses
#' one model for all rows, measures what a row costs, and says what the sweep will take.
#' [sweep_run()] carries it out.
#'
#' Rows are computed in one of three ways, named by the print. *core*: builder, model and outputs
#' in C, for every scene without R functions; each row has the bits of [trajectory()]. *table*: many
#' rows at a time by a kernel, for wheels with viscous resistance, inclines and tumbling bodies in
#' closed form, where the inputs are initial velocities, resistance, friction, slope or given
#' moments of inertia, and the outputs states at one time or their extremes, and the error; a row
#' agrees with [trajectory()] within both error figures. *scene*: a call of [trajectory()] for each
#' row, for scenes with R functions and for `build`.
#'
#' The model is that which takes the most of 256 rows, and of these the cheapest. A row that it does
#' not take, or whose scene a constructor refuses, gets a status and NaN.
#'
#' @param scene A scene (see [scene_axle()]), some numbers of which vary; NULL with `build`.
#' @param time_s Times at which each row is looked at, increasing. A row starts at the scene's
#'   `start_s`; the last time is where it ends. An input `time_s` of the design replaces the last
#'   time.
#' @param design The rows: see [design_sobol()]. The names of its inputs are paths of
#'   [sweep_inputs()], or names that `derive` uses.
#' @param outputs What is kept of each row: names of [sweep_outputs()]. NULL: the state at the end.
#' @param ... Not used; names after it must be given in full.
#' @param derive A named list of one-sided formulas of inputs: `list("body$mass_kg" = ~ density *
#'   volume)`. See [design_rows()] for what a formula may contain.
#' @param build A function of a row (a list of the design's inputs by their names) that returns a
#'   scene, instead of `scene`; all of one kind. It uses nothing but its argument, `given` and
#'   functions of packages.
#' @param given A named list of what else `build` uses.
#' @param accuracy As in [trajectory()]: one number.
#' @param model A model of [models()] for all rows; NULL: chosen.
#' @param kernel FALSE: without kernels, so that each row has the bits of [trajectory()].
#' @param keep `"rows"`; `"summary"`, see [summary.rot_sweep()]; or a one-sided formula of inputs
#'   and outputs: the rows for which it holds, and the summary of all.
#' @param audit_rows How many rows a summary computes again by [trajectory()] with another model,
#'   and audits.
#' @param chunk_rows Rows computed and committed at a time, a power of two, at least 65,536 of a
#'   closed form and 256 of what is integrated. NULL: about ten seconds of work.
#' @return A list of class `rot_sweep_plan`, with a print method. Its elements are not part of the
#'   interface.
#' @section Errors: `rotdyn_error_argument` for an input or output that the scene lacks, with the
#'   nearest ones; `rotdyn_error_value` for a law with probability outside the domain of its input,
#'   for a damaged formula and for a `build` with free variables; `rotdyn_error_model` where no
#'   model takes the rows; `rotdyn_error_build` where `build` or an R function of the scene fails
#'   in a row, with its number; `rotdyn_error_type`, `rotdyn_error_time`, `rotdyn_error_size`.
#' @source The choice of a model: [choose_model()].
#' @seealso [sweep_run()], [sweep_inputs()], [design_sobol()], [vary_normal()].
#' @concept parameter study
#' @concept Monte Carlo
#' @concept tolerance
#' @examples
#' wheel <- scene_axle(
#'   body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
#' )
#' plan <- sweep_plan(
#'   wheel, time_s = 400,
#'   design_sobol(2^10, seed = 42, "body$mass_kg" = vary_normal(2, 0.02),
#'     "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)),
#'   outputs = c("final_theta_rad", "stop_time_s")
#' )
#' plan
#' sweep_run(plan)
#' @export
sweep_plan <- function(scene, time_s, design, outputs = NULL, ..., derive = NULL, build = NULL,
                       given = list(), accuracy = 1e-9, model = NULL, kernel = TRUE,
                       keep = "rows", audit_rows = 100, chunk_rows = NULL) {
  call <- check_no_dots(...)
  check_supplied(c(if (is.null(build)) "scene", "time_s", "design"), call)
  n <- check_design(design, "design", call)
  time_s <- check_times(time_s, call)
  if (!length(time_s)) abort_rotdyn("{.arg time_s} must have a time.", "time", call)
  plan <- list(
    design = design, n = n, time_s = time_s,
    accuracy = check_number(accuracy, "accuracy", "1", call, lower = 0, open = TRUE),
    audit_rows = floor(check_number(audit_rows, "audit_rows", "1", call, 0, 1e6)),
    max_steps = 1e6
  )
  plan <- if (is.null(build)) {
    check_scene(scene, call)
    plan_of_scene(plan, scene, call)
  } else {
    if (!missing(scene) && !is.null(scene)) {
      abort_rotdyn("{.arg scene} and {.arg build} are given: only one describes the rows.",
                   "argument", call)
    }
    plan_of_function(plan, build, given, call)
  }
  plan$design <- design_in_si(plan, call)
  plan <- plan_derived(plan, derive, call)
  plan <- plan_bound(plan, call)
  first <- if (is.null(build)) scene else first_scene(plan, call)
  plan <- plan_outputs(plan, outputs, first, call)
  check_input_columns(plan, call)
  plan <- plan_model(plan, model, call)
  kernel <- check_flag(kernel, "kernel", call)
  if (kernel && plan$kind == "core" && .Call(ffi_sweep_is_table, core_sweep(plan))) {
    plan$kind <- "table"
  }
  plan <- plan_kept(plan, keep, call)
  class(plan) <- "rot_sweep_plan"
  plan <- plan_sums(plan)
  plan <- plan_cost(plan, call)
  plan$chunk_rows <- check_chunk_rows(chunk_rows, plan, call)
  plan
}

# ---- the scene ----------------------------------------------------------------------------------

plan_of_scene <- function(plan, scene, call) {
  plan$node <- scene_node_with_functions(scene, call)
  plan$known <- inputs_that_vary(plan$node)
  plan$kind <- if (has_functions(plan$node)) "scene" else "core"
  plan$constraint <- constraint_of(scene)$id
  plan
}

has_functions <- function(x) {
  is.function(x) || is.object(x) || (is.list(x) && any(vapply(x, has_functions, NA)))
}

# A function that finds all it uses in its argument, `given` and packages.
plan_of_function <- function(plan, build, given, call) {
  check_function(build, "build", call)
  if (!is.list(given) || (length(given) && is.null(names(given)))) {
    abort_rotdyn("{.arg given} must be a named list.", "type", call)
  }
  if (length(formals(args(build))) < 1L) {
    abort_rotdyn("{.arg build} must be a function of a row.", "type", call)
  }
  free <- free_variables(build, names(given))
  if (length(free)) {
    abort_rotdyn(c(
      "{.arg build} uses {.code {free}}, which {?is/are} neither in its row nor in {.arg given}.",
      x = "Another process would not find {cli::qty(length(free))}{?it/them}.",
      i = "Give {cli::qty(length(free))}{?it/them}: {.code given = list({free[1]} = {free[1]})}."
    ), "value", call)
  }
  environment(build) <- list2env(given, parent = the_namespace())
  plan$build <- build
  plan$given <- given
  plan$kind <- "scene"
  plan
}

the_namespace <- function() environment(sys.function())

# Names in a function that are not its own, nor given, nor of a package.
free_variables <- function(f, given) {
  used <- all.names(body(f), unique = TRUE)
  own <- c(names(formals(f)), given, assigned_names(body(f)))
  found <- function(name) exists(name, envir = the_namespace(), inherits = TRUE) &&
    !exists(name, envir = globalenv(), inherits = FALSE)
  Filter(function(name) !found(name), setdiff(used[nzchar(used)], c(own, quoted_names(body(f)))))
}

# Functions of a scene, or beside one that builds scenes, find all that they use in another process:
# what is in a session's own workspace stays there.
check_session_variables <- function(plan, call) {
  functions <- function(x) {
    if (is.function(x)) return(list(x))
    if (is.list(x)) unlist(lapply(unname(unclass(x)), functions))
  }
  found <- unlist(lapply(functions(list(plan$node, plan$given)), function(f) {
    if (is.primitive(f)) return(NULL)
    Filter(function(name) !kept_with(name, environment(f)), free_variables(f, NULL))
  }))
  if (!length(found)) return(invisible())
  found <- unique(found)
  abort_rotdyn(c(
    "An R function of the sweep uses {.code {found}} of this session's workspace.",
    x = "Another process would not find {cli::qty(length(found))}{?it/them}.",
    i = "Make it where {cli::qty(length(found))}{?it is/they are} local: {.code local({{ {found[1]}
         <- {found[1]}; function(time_s) ... }})}."
  ), "value", call)
}

# Is a name in the environments that are written with a function?
kept_with <- function(name, env) {
  while (!identical(env, globalenv()) && !identical(env, emptyenv()) && !isNamespace(env) &&
    !identical(env, baseenv())) {
    if (exists(name, envir = env, inherits = FALSE)) return(TRUE)
    env <- parent.env(env)
  }
  isNamespace(env) && exists(name, envir = env)
}

# The names on the left of assignments, of loops, and the arguments of functions inside.
assigned_names <- function(x) {
  if (!is.call(x)) return(if (is.pairlist(x)) names(x))
  head <- function_called(x)
  own <- if (head %in% c("<-", "=", "for") && is.name(x[[2]])) as.character(x[[2]])
  if (head == "function") own <- names(x[[2]])
  c(own, unlist(lapply(as.list(x), assigned_names)))
}

# The name of the function that a call calls; "" of `stats::sd(x)`, whose function is a call, too.
function_called <- function(x) if (is.name(x[[1]])) as.character(x[[1]]) else ""

# What stands behind `$` and `::` is no variable.
quoted_names <- function(x) {
  if (!is.call(x)) return(NULL)
  head <- function_called(x)
  if (head %in% c("$", "@", "::", ":::")) {
    return(c(as.character(x[[3]]), if (head %in% c("::", ":::")) as.character(x[[2]]),
             quoted_names(x[[2]])))
  }
  unlist(lapply(as.list(x), quoted_names))
}

# ---- inputs -------------------------------------------------------------------------------------

# The design with all laws in SI units: that of the scene's input, or of the name.
design_in_si <- function(plan, call) {
  design <- plan$design
  for (name in names(design$inputs)) {
    law <- design$inputs[[name]]
    if (is.null(law$unit)) next
    need_package("units", "An input with a unit", call)
    unit <- plan$known$unit[match(name, plan$known$path)]
    if (!length(unit) || is.na(unit)) unit <- gsub(" ", "*", unit_in_name(name), fixed = TRUE)
    numbers <- setdiff(names(law)[vapply(law, is.numeric, NA)], c("factor", "weights"))
    law[numbers] <- lapply(law[numbers], function(x) {
      as.double(as_si(units::set_units(x, law$unit, mode = "standard"), unit, name, call))
    })
    law$unit <- NULL
    design$inputs[[name]] <- law
  }
  design
}

plan_derived <- function(plan, derive, call) {
  inputs <- names(plan$design$inputs)
  if (is.null(derive)) derive <- list()
  if (!is.list(derive) || (length(derive) && !all(rlang::have_name(derive)))) {
    abort_rotdyn("{.arg derive} must be a named list of formulas.", "type", call)
  }
  twice <- unique(names(derive)[names(derive) %in% inputs | duplicated(names(derive))])
  if (length(twice)) {
    abort_rotdyn("{.field {twice}} {?is/are} derived, and an input or derived before.", "argument",
                 call)
  }
  programs <- list()
  for (name in names(derive)) {
    programs[[name]] <- derived_input(
      derive[[name]], c(inputs, names(programs)), paste0("derive$", name), call
    )
  }
  plan$derived <- programs
  plan
}

# Which of the design's inputs and derived ones are inputs of the scene.
plan_bound <- function(plan, call) {
  all <- c(names(plan$design$inputs), names(plan$derived))
  if (!is.null(plan$build)) {
    plan$inputs <- character()
    plan$bound <- double()
    return(plan)
  }
  known <- c(plan$known$path, if (!"time_s" %in% plan$known$path) "time_s")
  code <- match("input", names(.Call(ffi_formula_operations))) - 1L
  used <- all[unlist(lapply(plan$derived, function(program) {
    program$arg[program$op == code] + 1L
  }))]
  bound <- which(all %in% known)
  unknown <- setdiff(all[!seq_along(all) %in% bound], used)
  if (length(unknown)) abort_unknown_input(unknown, plan, known, call)
  check_domains(plan, all, bound, call)
  plan$inputs <- all[bound]
  plan$node <- node_that_follows(plan$node, plan$inputs, plan$known, call)
  plan$bound <- as.double(bound - 1L)
  plan
}

abort_unknown_input <- function(unknown, plan, known, call) {
  last <- sub("^.*\\$", "", unknown[1])
  near <- unique(c(
    known[sub("^.*\\$", "", known) == last], near_names(unknown, known),
    near_names(last, known)
  ))
  stem <- if (grepl("$", unknown[1], fixed = TRUE)) sub("\\$[^$]*$", "", unknown[1])
  from <- if (is.null(stem)) grep("^bod(y|ies).*[$]", known, value = TRUE) else
    known[startsWith(known, paste0(stem, "$"))]
  derived <- last %in% derived_numbers
  absent <- !is.null(stem) && !length(from)
  abort_rotdyn(c(
    "{.field {some_names(unknown)}} {?is/are} no input{?s} of this scene.",
    i = if (derived) "{.field {last}} is derived{if (length(from)) ' from'}
      {if (length(from)) cli::format_inline('{.field {utils::head(from, 6)}}')}: vary these.",
    i = if (absent && !derived) "The scene has no {.field {stem}} made of parts: describe it with
      them first.",
    i = if (length(near)) "Did you mean {.field {utils::head(near, 4)}}?",
    i = "{.fn sweep_inputs} lists those that it has."
  ), "argument", call)
}

# Numbers that constructors derive.
derived_numbers <- c(
  "moment_of_inertia_kg_m2", "inertia_kg_m2", "second_moment_kg_m2", "beta", "reach_m", "error",
  "centre_m", "loads", "lever_m"
)

# The laws of inputs against their domains: a share of rows outside is an error.
check_domains <- function(plan, all, bound, call) {
  laws <- plan$design$inputs
  for (name in intersect(all[bound], names(laws))) {
    i <- match(name, plan$known$path)
    # The last time, which is no number of the scene, is finite.
    low <- if (is.na(i)) -.Machine$double.xmax else plan$known$low[i]
    high <- if (is.na(i)) .Machine$double.xmax else plan$known$high[i]
    outside <- design_probability_outside(laws[[name]], low, high)
    # A value or two in 1e12 rows get their status.
    if (!(outside > 1e-12)) next
    domain <- domain_words(low, high, !is.na(i) && plan$known$above[i])
    if (domain == "any") domain <- "any finite number"
    listed <- laws[[name]]$kind %in% c("values", "column", "fixed")
    abort_rotdyn(c(
      "The law of {.field {name}} leaves the domain of this input, {domain}.",
      x = "{format(100 * outside, digits = 2)} % of its rows are outside.",
      i = if (listed) "Leave these values out." else
        "Cut it off: {.code vary_truncated(law, low, high)}."
    ), "value", call)
  }
}

# ---- outputs ------------------------------------------------------------------------------------

plan_outputs <- function(plan, outputs, first, call) {
  constraint <- constraint_of(first)
  plan$constraint <- constraint$id
  known <- outputs_of_scene(first, call)
  if (is.null(outputs)) {
    state <- paste0("final_", unlist(lapply(constraint$measures, `[[`, "columns")))
    outputs <- known$path[without_place(known$path) %in% state]
  }
  if (!is.character(outputs) || !length(outputs) || anyNA(outputs)) {
    abort_rotdyn("{.arg outputs} must be names of {.fn sweep_outputs}.", "type", call)
  }
  unknown <- setdiff(outputs, known$path)
  if (length(unknown)) {
    near <- near_names(unknown, known$path)
    abort_rotdyn(c(
      "{.field {some_names(unknown)}} {?is/are} no output{?s} of this scene.",
      i = if (length(near)) "Did you mean {.field {near}}?",
      i = "{.fn sweep_outputs} lists those that it has."
    ), "argument", call)
  }
  plan$outputs <- unique(outputs)
  plan$output_unit <- known$unit[match(plan$outputs, known$path)]
  plan
}

# The rows have columns of these names beside those of the inputs.
check_input_columns <- function(plan, call) {
  twice <- intersect(all_inputs(plan), c("row", "error", "status", plan$outputs))
  if (!length(twice)) return(invisible())
  abort_rotdyn(c(
    "{.field {twice}} {?is an input/are inputs}, and {?a column/columns} of the rows beside the
     inputs.",
    i = "Give {cli::qty(length(twice))}{?it another name/them other names}."
  ), "argument", call)
}

# Of a row that has one.
first_scene <- function(plan, call) {
  refused <- NULL
  for (i in spread_rows(plan, 16)) {
    scene <- tryCatch(scene_of_row(plan, i, call), rotdyn_error_value = identity)
    if (!inherits(scene, "error")) return(scene)
    refused <- refused %||% scene
  }
  abort_rotdyn(
    "{.arg build} makes no scene of the rows looked at.", "value", call, parent = refused
  )
}

constraint_place <- function(id) match(id, vapply(all_constraints(), `[[`, "", "id"))

# ---- the model ----------------------------------------------------------------------------------

# Numbers of up to m rows, from 1, spread over the design.
spread_rows <- function(plan, m) unique(floor(seq(1, plan$n, length.out = min(m, plan$n))))

plan_model <- function(plan, model, call) {
  plan$asked <- !is.null(model)
  if (plan$kind == "scene") {
    plan$model <- if (plan$asked) check_string(model, "model", NULL, call)
    return(plan)
  }
  if (plan$asked) {
    ids <- names(all_constraints()[[constraint_place(plan$constraint)]]$models)
    plan$model <- check_string(model, "model", ids, call)
    return(plan)
  }
  rows <- spread_rows(plan, 256)
  found <- .Call(ffi_sweep_model, core_sweep(plan), rows - 1)
  if (!is.null(found$refused)) abort_refused(found, plan, call)
  if (is.null(found$model)) {
    abort_no_row(plan, match("model", row_statuses()) - 1L, call)
  }
  plan$model <- found$model
  plan$taken <- found$taken / length(rows)
  plan
}

abort_refused <- function(found, plan, call) {
  at <- found$at + 1
  name <- c(plan$inputs, plan$outputs)[at]
  abort_rotdyn(c(
    "The rows cannot be computed: {found$refused}.", i = if (!is.na(name)) "At {.field {name}}."
  ), "argument", call)
}

# ---- what is kept -------------------------------------------------------------------------------

plan_kept <- function(plan, keep, call) {
  if (inherits(keep, "formula")) {
    names <- c(names(plan$design$inputs), names(plan$derived), plan$outputs)
    plan$condition <- derived_input(keep, names, "keep", call)
    plan$keep <- "some"
  } else {
    if (!is.character(keep)) {
      abort_rotdyn(c(
        "{.arg keep} must be \"rows\", \"summary\" or a formula.",
        x = "It is {describe_value(keep)}.",
        i = "For example {.code keep = ~ {plan$outputs[1]} > 0}."
      ), "type", call)
    }
    plan$keep <- check_string(keep, "keep", c("rows", "summary"), call)
  }
  plan
}

# ---- cost ---------------------------------------------------------------------------------------

# Seconds for a row, measured on rows spread over the design.
plan_cost <- function(plan, call) {
  plan$row_s <- 1e-6
  # What is done once is not counted.
  rows_of_sweep(plan, 1, 1, call = call)
  start <- proc.time()[[3L]]
  rows <- 0
  spent <- 0
  pieces <- spread_rows(plan, 16)
  size <- 4
  seen <- list()
  status <- integer()
  repeat {
    for (first in pieces) {
      m <- min(size, plan$n - first + 1)
      before <- .Call(ffi_clock_cpu)
      found <- rows_of_sweep(plan, first, m, call = call)
      took <- .Call(ffi_clock_cpu) - before
      # All of the first pass: what follows from it does not depend on the clock.
      if (size == 4) {
        seen[[length(seen) + 1L]] <- found$output
        status <- c(status, found$status)
      }
      rows <- rows + m
      spent <- spent + took
      if (size > 4 && proc.time()[[3L]] - start > 0.5) break
    }
    if (spent > 0.02 || size > 4096 || proc.time()[[3L]] - start > 0.5) break
    size <- size * 8
  }
  if (all(status != 0L)) abort_no_row(plan, status[1], call)
  plan$row_s <- max(spent, 1e-4) / rows
  # Near the mean, for the sums of squares.
  plan$shift <- vapply(seq_along(plan$outputs), function(k) {
    x <- unlist(lapply(seen, `[[`, k))
    x <- x[is.finite(x)]
    if (length(x)) signif(mean(x), 6) else 0
  }, double(1))
  plan
}

# None of the rows looked at has numbers: why the first one has none.
abort_no_row <- function(plan, status, call) {
  said <- tryCatch(
    {
      input <- lapply(input_columns(plan, 1, 1), identity)
      names(input) <- all_inputs(plan)
      suppressWarnings(motion_of_row(plan, scene_of_row(plan, 1, call, input), input))
      NULL
    },
    rotdyn_error = identity
  )
  abort_rotdyn(
    "None of the rows looked at can be computed ({row_statuses()[status + 1L]}).",
    if (row_statuses()[status + 1L] == "model") "model" else "value", call, parent = said
  )
}

row_bytes <- function(plan) {
  8 * (length(names(plan$design$inputs)) + length(plan$derived) + length(plan$outputs) + 1) + 12
}

# Each is a file or two; all their names are listed at a time.
max_chunks <- 2^20

check_chunk_rows <- function(chunk_rows, plan, call) {
  if (is.null(chunk_rows)) {
    limit <- if (plan$keep == "rows") 2^22 else 2^26
    rows <- 2^round(log2(10 / plan$row_s))
    return(max(min(rows, limit), plan$block_rows, 2^ceiling(log2(plan$n / 65536))))
  }
  smallest <- max(plan$block_rows, 2^ceiling(log2(plan$n / max_chunks)))
  largest <- max(2^30, smallest)
  chunk_rows <- check_number(chunk_rows, "chunk_rows", "1", call, plan$block_rows, largest)
  if (chunk_rows < smallest) {
    abort_rotdyn(c(
      "A sweep has at most {max_chunks} chunks.",
      x = "With {.code chunk_rows = {whole_words(chunk_rows)}} it has
           {whole_words(ceiling(plan$n / chunk_rows))}.",
      i = "At least {.code chunk_rows = {whole_words(smallest)}}; NULL: about ten seconds of work."
    ), "value", call)
  }
  if (chunk_rows != 2^round(log2(chunk_rows))) {
    abort_rotdyn(c(
      "{.arg chunk_rows} must be a power of two.", x = "It is {format(chunk_rows)}.",
      i = "Near it: {format(2^round(log2(chunk_rows)))}."
    ), "value", call)
  }
  chunk_rows
}

n_chunks <- function(plan) ceiling(plan$n / plan$chunk_rows)

#' @export
print.rot_sweep_plan <- function(x, ...) {
  count <- function(n) format(n, big.mark = ",", scientific = FALSE)
  model <- if (is.null(x$model)) "the cheapest model of each row" else x$model
  say("<rot_sweep_plan> ", count(x$n), " rows, ", if (is.null(x$build)) {
    setdiff(names(x$node), "scene_format")[1]
  } else "scenes of a function", ", ", model, "\n")
  fields <- c(
    inputs = paste(names(x$design$inputs), collapse = ", "),
    derived = paste(names(x$derived), collapse = ", "),
    outputs = paste(x$outputs, collapse = ", "),
    kind = kind_words(x),
    takes = if (!is.null(x$taken) && x$taken < 1) {
      paste0("the model takes ", format(100 * x$taken, digits = 3), " % of the rows looked at")
    },
    time = paste0(seconds_words(x$n * x$row_s), " in one thread (",
                  prefixed(x$row_s, "s"), " a row, measured)"),
    kept = kept_words(x),
    chunks = paste0(count(n_chunks(x)), " of ", count(x$chunk_rows), " rows (",
                    seconds_words(x$chunk_rows * x$row_s), "): what a lost worker costs")
  )
  for (name in names(fields)[nzchar(fields)]) {
    lines <- strwrap(fields[[name]], min(69L, print_width() - 10L))
    say(sprintf("  %-8s %s\n", c(name, rep("", length(lines) - 1L)), lines))
  }
  invisible(x)
}

kind_words <- function(plan) {
  switch(plan$kind,
    core = "core: scene and model in C, row by row",
    table = "table: many rows at a time by a kernel",
    scene = "scene: trajectory() for each row"
  )
}

kept_words <- function(plan) {
  bytes <- function(n) prefixed(n, "B")
  all <- bytes(plan$n * row_bytes(plan))
  switch(plan$keep,
    rows = paste0("all rows: ", all),
    some = paste0("the rows where ", plan$condition$text, ", and a summary of all"),
    summary = paste0("a summary (all rows: ", all, ")")
  )
}

# "2.2 us", "14 MB"
prefixed <- function(x, unit) {
  power <- if (x > 0) min(max(floor(log10(x * 1.0005) / 3), -3), 5) else 0
  prefix <- c("n", "u", "m", "", "k", "M", "G", "T", "P")[power + 4]
  paste0(format(signif(x / 1000^power, 3), digits = 3), " ", prefix, unit)
}

seconds_words <- function(s) {
  if (s < 1) return("less than a second")
  if (s < 120) return(paste(format(s, digits = 2), "s"))
  if (s < 7200) return(paste(format(s / 60, digits = 2), "min"))
  if (s < 172800) return(paste(format(s / 3600, digits = 2), "h"))
  paste(format(s / 86400, digits = 2), "days")
}
