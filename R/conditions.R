# Kinds of errors: the class is rotdyn_error_<kind>. The kinds of a failed run are those of
# ROT_STATUS_LIST in src/core/ground/status.h.
error_kinds <- c(
  missing = "a required argument is missing",
  argument = "an unknown argument or column, or an argument without its name",
  type = "an object of the wrong type",
  size = "incompatible lengths",
  value = "a number outside its domain",
  unit = "a quantity of another dimension",
  time = "times that are missing, infinite or not in order",
  inertia = "an inertia tensor that is not physical",
  point = "inertia tensors about different points, or in different axes",
  mesh = "a mesh that is open, inconsistently oriented or damaged",
  density = "a density that is below 0 or not finite",
  scene = "a text that is no scene, or a scene without a text",
  metadata = "rows of metadata that break a key or a check",
  database = "a database without the tables of records, or of another format",
  record = "no such record, or one that this version cannot compute again",
  file = "a file that cannot be read, or has another format",
  build = "a function of the user's that fails in a row of a sweep",
  folder = "a folder with another sweep",
  canary = "a machine that computes other bits than the one that began the sweep",
  chunks = "chunks of a sweep that cannot be computed",
  torque = "a torque law that gives no finite number",
  rhs = "an equation of motion that gives no finite number",
  random = "a torque law that gives two values for the same arguments",
  model = "no such model, or one that does not fit the scene",
  accuracy = "an accuracy that no model reaches",
  package = "a package that is not installed",
  range = "a state outside the range of double precision",
  budget = "the step budget does not suffice",
  step = "a step below the resolution of time",
  memory = "out of memory"
)

# The frame of the function that calls, whose call an error names. rlang has the same, but takes a
# quarter of the time in which a command of the shell starts.
current_env <- function() parent.frame()

abort_rotdyn <- function(message, kind, call, ..., .envir = parent.frame()) {
  cli::cli_abort(
    message,
    class = c(paste0("rotdyn_error_", kind), "rotdyn_error"),
    ...,
    call = call,
    .envir = .envir
  )
}

warn_rotdyn <- function(message, kind, call, ..., .envir = parent.frame()) {
  cli::cli_warn(
    message,
    class = c(paste0("rotdyn_warning_", kind), "rotdyn_warning"),
    ...,
    call = call,
    .envir = .envir
  )
}

# The package's errors in `expr` name the user's call.
in_call <- function(expr, call) {
  tryCatch(expr, rotdyn_error = function(e) {
    e$call <- rlang::error_call(call)
    rlang::cnd_signal(e)
  })
}

# Says which results are beyond double precision though the numbers of their row are finite.
# `values` and `given`: named columns, recycled to n rows.
warn_beyond <- function(values, given, n, call) {
  beyond <- Filter(function(x) any(is.infinite(x)), values)
  if (!length(beyond)) return(invisible())
  finite <- rep(TRUE, n)
  for (x in given) finite <- finite & !is.infinite(x)
  rows <- lapply(beyond, function(x) which(is.infinite(x) & finite))
  rows <- rows[lengths(rows) > 0L]
  if (!length(rows)) return(invisible())
  warn_rotdyn(c(
    "{.field {names(rows)}} exceed{?s/} double precision.",
    x = "{cli::qty(length(rows))}{?It is/They are} Inf or NaN in row {min(unlist(rows))}."
  ), "range", call)
}

# For warn_beyond(): Inf - Inf, or Inf times 0, of numbers that are known.
nan_as_inf <- function(x) replace(x, is.nan(x), Inf)

# As warn_rotdyn(), but of plain text, in 0.1 ms: cli's markup takes 15.
warn_quickly <- function(message, kind, call) {
  bullets <- c("", rep(paste0(cli::symbol$info, " "), length(message) - 1L))
  class <- c(paste0("rotdyn_warning_", kind), "rotdyn_warning", "warning", "condition")
  text <- paste0(bullets, message, collapse = "\n")
  warning(structure(class = class, list(message = text, call = rlang::error_call(call))))
}

# A message of plain text, in as little.
inform_quickly <- function(message, kind) {
  bullets <- c("", rep(paste0(cli::symbol$info, " "), length(message) - 1L))
  class <- c(paste0("rotdyn_message_", kind), "rotdyn_message", "message", "condition")
  text <- paste0(bullets, message, "\n", collapse = "")
  message(structure(class = class, list(message = text, call = NULL)))
}

need_package <- function(package, why, call) {
  if (!requireNamespace(package, quietly = TRUE)) {
    abort_rotdyn(c(
      "{why} needs the package {.pkg {package}}, which is not installed.",
      i = "Install it with {.code install.packages(\"{package}\")}."
    ), "package", call)
  }
}

# Loaded without a window; the option is then restored.
need_rgl <- function(why, call) {
  if (!isNamespaceLoaded("rgl")) {
    old <- options(rgl.useNULL = TRUE)
    on.exit(options(old))
  }
  need_package("rgl", why, call)
}
