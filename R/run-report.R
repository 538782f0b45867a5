# The report of a run: its errors, what is beyond double precision, the words for one that failed.

# Errors larger than the motion: the figure has no digit left, as of a chaotic pendulum.
is_lost <- function(info) is.finite(info$error) && info$error > 1

# Columns with values beyond double precision.
beyond_doubles <- function(columns) {
  names(Filter(function(x) is.double(x) && any(is.infinite(x)), columns))
}

# `by`: named numbers, added to the errors of the measures.
widen_error <- function(info, by) {
  info$errors <- info$errors + unlist(by)[names(info$errors)]
  if (is.infinite(info$error)) return(info)
  info$error <- .Call(ffi_error_figure, info$errors, info$sizes)
  info
}

failed_run <- function(info, n, on_fail, call) {
  message <- c(
    "The run failed at {format(info$time_s, digits = 7)} s: {info$text}.",
    i = "{info$rows_done} of {n} rows were done before."
  )
  remedy <- info$remedy %||% switch(info$kind,
    torque = "Look at the torque function there, or end {.arg time_s} before.",
    budget = "Raise {.arg max_steps}, ask for less accuracy, or shorten the time. A body that
              turns by very many radians in that time takes many steps, and so does resistance that
              acts much faster (inertia/viscous).",
    step = "The torque changes faster than time can be resolved (give its {.arg breaks_s}), or the
            motion grows without bound there.",
    rhs = "Look at the function there, or end {.arg time_s} before.",
    range = "The motion or its energy grows beyond 1.8e308: shorten the time, or start slower.",
    random = random_remedy,
    NULL
  )
  message <- c(message, i = remedy)
  if (on_fail == "truncate") {
    warn_rotdyn(message, "truncated", call, info = info)
  } else {
    message <- c(message, i = "{.code on_fail = \"truncate\"} keeps the good rows.")
    abort_rotdyn(message, info$kind, call, info = info)
  }
}
