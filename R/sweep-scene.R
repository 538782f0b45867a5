# The scene of a row: the numbers of a sweep's inputs, set in the node of its scene by their paths.

# "bodies[2]$mass_kg" => list("bodies", 2, "mass_kg")
path_steps <- function(path) {
  parts <- regmatches(path, gregexpr("[^][$]+|\\[[0-9]+\\]", path))[[1]]
  lapply(parts, function(part) {
    if (startsWith(part, "[")) as.integer(substr(part, 2L, nchar(part) - 1L)) else part
  })
}

# The node of a scene with numbers in the place of others, or without them (NULL); `known`:
# inputs_that_vary(node), for the numbers of vectors that the node lacks.
node_with <- function(node, paths, values, known) {
  at <- setdiff(names(node), "scene_format")[1]
  for (i in seq_along(paths)) {
    node[[at]] <- set_in(node[[at]], path_steps(paths[i]), values[[i]], paths[i], known)
  }
  node
}

set_in <- function(x, steps, value, path, known) {
  step <- steps[[1]]
  rest <- steps[-1]
  if (!length(rest)) {
    x[[step]] <- value
    return(x)
  }
  inner <- if (is.character(step) || step <= length(x)) x[[step]]
  if (is.null(inner)) {
    stem <- without_place(path)
    inner <- known$value[startsWith(known$path, paste0(stem, "["))]
  }
  if (is.matrix(inner)) {
    inner[rest[[1]], rest[[2]]] <- value
    x[[step]] <- inner
    return(x)
  }
  one <- is.list(inner) && length(inner) == 1L && names(inner) %in% names(text_readers())
  if (isTRUE(one)) {
    inner[[1]] <- set_in(inner[[1]], rest, value, path, known)
  } else {
    inner <- set_in(inner, rest, value, path, known)
  }
  x[[step]] <- inner
  x
}

# The scene that the constructors make of a node; functions in it stay as they are.
scene_of_node <- function(node, call) {
  node$scene_format <- NULL
  read_node(node, text_readers(), "the scene", call)
}

# The node without the numbers that constructors made of others, as omega0 = v0/radius: they follow
# when those vary. Such a number is of an argument whose default is NULL, and the constructors say
# the same without it (as in changed_object()). `paths`: what varies.
node_that_follows <- function(node, paths, known, call) {
  stem <- function(path) sub("(\\[[0-9]+\\])+$", "", path)
  made <- setdiff(stem(known$path[!is.nan(known$value)]), stem(paths))
  out <- node
  for (path in made[vapply(made, is_null_by_default, NA, node)]) {
    shorter <- node_with(out, path, list(NULL), known)
    scene <- make_quietly(scene_of_node, list(shorter, call))
    if (!is.null(scene) && identical(scene_node_with_functions(scene, call), node)) out <- shorter
  }
  out
}

# Whether the argument that a path names is NULL in the usage of its constructor.
is_null_by_default <- function(path, node) {
  known <- names(text_readers())
  inside <- node[setdiff(names(node), "scene_format")[1]]
  steps <- path_steps(path)
  for (i in seq_along(steps)) {
    if (length(inside) == 1L && isTRUE(names(inside) %in% known)) {
      constructor <- names(inside)
      inside <- inside[[1]]
    }
    if (i < length(steps)) inside <- inside[[steps[[i]]]]
  }
  usage <- formals(text_readers()[[constructor]])
  steps[[i]] %in% names(usage) && is.null(usage[[steps[[i]]]])
}

# ---- outputs of a motion ------------------------------------------------------------------------

# The outputs of a trajectory by their names, as src/core/sweep/outputs.c has them.
outputs_of_motion <- function(motion, outputs) {
  run <- trajectory_run(motion)
  constraint <- constraint_of(run$scene)
  index <- constraint$index
  audits <- intersect(outputs, c("supplied_j", "lost_j", "balanced"))
  audited <- if (length(audits)) audit(motion)
  values <- vapply(outputs, function(output) {
    place <- as.integer(sub("^.*\\[([0-9]+)\\]$", "\\1", output))
    place <- if (grepl("\\[[0-9]+\\]$", output)) place
    base <- without_place(output)
    switch(base,
      error = return(run$info$error), steps = return(as.double(run$info$steps)),
      supplied_j = return(sum(audited$supplied[audited$balance == "energy"])),
      lost_j = return(sum(audited$dissipated[audited$balance == "energy"])),
      balanced = return(as.double(all(audited$verdict == "balanced"))),
      stop_time_s = return(stop_of_motion(motion, run, constraint)),
      period_s = return(period_of_row(run$scene, constraint))
    )
    if (grepl("^first_.*_time_s$|^n_", base)) return(event_of_motion(run, base, place))
    kind <- sub("^(final|max_abs|max|min)_.*$", "\\1", base)
    x <- motion[[sub("^(final|max_abs|max|min)_", "", base)]]
    if (!is.null(index)) x <- x[motion[[index]] == place]
    x <- as.double(x)
    switch(kind,
      final = if (length(x)) x[length(x)] else NaN, max = largest_known(x),
      min = -largest_known(-x), max_abs = largest_known(abs(x))
    )
  }, double(1), USE.NAMES = FALSE)
  replace(values, is.na(values), NaN)
}

# NaN where there is none in closed form.
period_of_row <- function(scene, constraint) {
  tryCatch(constraint$periods(scene, current_env())$period_s[1],
           rotdyn_error_model = function(e) NaN)
}

# NaN where all are.
largest_known <- function(x) {
  x <- x[!is.nan(x) & !is.na(x)]
  if (length(x)) max(x) else NaN
}

event_of_motion <- function(run, base, place) {
  events <- run$events
  name <- sub("_time_s$", "", sub("^(first|n)_", "", base))
  of <- events$event == name
  if (!is.null(place)) of <- of & events$place == place
  if (startsWith(base, "n_")) sum(of) else min(events$time_s[of], Inf)
}

stop_of_motion <- function(motion, run, constraint) {
  rates <- unlist(lapply(constraint$measures[c("omega", "v")], `[[`, "columns"))
  last <- motion$time_s == motion$time_s[nrow(motion)]
  if (any(unlist(unclass(motion)[rates])[rep(last, length(rates))] != 0)) return(Inf)
  stuck <- run$events$time_s[run$events$event == "stick"]
  if (length(stuck)) max(stuck) else motion$time_s[1]
}
