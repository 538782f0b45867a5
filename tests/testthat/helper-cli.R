# The command line in this process: status, lines of standard output and of standard error.
cli <- function(..., input = NULL, terminal = FALSE, verbs = rotdyn:::cli_verbs()) {
  out <- err <- character()
  file <- tempfile()
  on.exit(unlink(file))
  writeLines(as.character(input), file)
  status <- rotdyn:::cli_run(
    c(...), function(lines) out <<- c(out, lines), function(lines) err <<- c(err, lines), file,
    terminal, verbs
  )
  list(status = status, out = out, err = err)
}

# The same as the lines of a golden test; `first` so many of standard output.
cli_golden <- function(..., masked = character(), first = Inf) {
  said <- cli(...)
  said$out <- utils::head(said$out, first)
  for (pattern in names(masked)) said$out <- gsub(pattern, masked[[pattern]], said$out)
  writeLines(c(paste("status", said$status), said$out, if (length(said$err)) {
    c("--- err", said$err)
  }))
}

wheel_json <- function(folder = ".") {
  path <- file.path(folder, "wheel.json")
  writeLines(c(
    '{"scene_axle": {"body": {"body_disk": {"mass_kg": 2, "radius_m": 0.25}},',
    ' "torque": {"torque_knots": {"time_s": [0, 1, 4, 6, 8], "torque_n_m": [0, 0.8, 0.8, 0, 0]}},',
    ' "resistance": {"viscous_n_m_s": 0.03}}}'
  ), path)
  path
}
