# Runs that fail in every way there is, 200 in all: under valgrind nothing may be lost.
library(rotdyn)

scene <- function(f) scene_axle(0.5, torque_function(f, breaks_s = numeric()))
# A law of the state called from within the integrator in C; a law of time alone is sampled from R.
run <- function(f, ..., model = "axle_rk8pd") {
  out <- tryCatch(
    suppressWarnings(trajectory(scene(f), (0:4) / 4, ..., model = model)),
    condition = function(c) class(c)[1]
  )
  if (is.data.frame(out)) "rows" else out
}
after <- function(limit, action) {
  force(action)
  calls <- 0
  function(t, theta, omega) {
    calls <<- calls + 1
    if (calls > limit) action()
    1
  }
}
custom <- structure(
  class = c("bearing_broken", "error", "condition"), list(message = "", call = NULL)
)

seen <- character()
for (i in 1:20) {
  seen <- c(
    seen,
    run(after(3 * i, function() stop("an R error"))),
    run(after(3 * i, function() stop(custom))),
    run(after(3 * i, function() tools::pskill(Sys.getpid(), tools::SIGINT))),
    run(function(t, theta, omega) if (t > i / 25) NA else 1),
    run(function(t) if (t > i / 25) "x" else 1, model = NULL),
    run(function(t, theta, omega) sin(1e4 * t), max_steps = i),
    run(function(t, theta, omega) if (t > i / 25) NaN else 1, on_fail = "truncate"),
    callCC(function(out) run(after(3 * i, function() out("jumped")))),
    tryCatch(
      trajectory(scene_axle(1, 1, resistance(-10)), c(0, 100 * i)),
      error = function(e) class(e)[1]
    ),
    tryCatch(rolling_table(data.frame(beta = c(i, -i))), error = function(e) class(e)[1])
  )
  setTimeLimit()
}
print(table(seen))
stopifnot(length(seen) == 200, sum(seen == "rows") == 20)

# A time limit, and the same limits with nothing wrong.
for (i in 1:2) {
  print(tryCatch(
    {
      setTimeLimit(elapsed = 0.5, transient = TRUE)
      trajectory(scene(function(t, theta, omega) {
        Sys.sleep(0.01)
        1
      }), (0:4000) / 4, model = "axle_rk8pd")
    },
    error = function(e) "time limit"
  ))
  setTimeLimit()
}
stopifnot(audit(spin_up())$verdict == "balanced")
stopifnot(audit(spin_up(time_s = 0:8, model = "axle_rk8pd"))$verdict == "balanced")

# Texts and hashes: odd strings and numbers, damaged texts; runs recorded and computed again.
odd <- list(
  b = c("a\"\\\n\001", NA, "\u00e9", ""), a = c(-0, NaN, Inf, 5e-324, NA), m = matrix(1:6, 2),
  n = NULL, l = list(), e = stats::setNames(list(), character()), t = c(TRUE, NA),
  z = strrep("x", 1e5)
)
json <- rotdyn:::json_canonical
stopifnot(identical(json(odd), json(odd[rev(names(odd))])))
for (n in c(0:20, 127:130, 159:162, 239:242, 1023:1026)) rotdyn:::hash_text(strrep("x", n))
if (requireNamespace("yyjsonr", quietly = TRUE)) {
  set.seed(10)
  text <- write_scene(scene_axle(body_disk(2, 0.25), torque_knots(0:2, c(0, 1, 0))), indent = 0)
  damaged <- vapply(1:100, function(i) {
    letters <- strsplit(text, "")[[1]]
    at <- sample(length(letters), 2)
    letters[at] <- sample(c("{", "}", "[", "\"", ",", "-", "1", "e"), 2)
    back <- tryCatch(
      read_scene(paste0("{", substring(paste(letters, collapse = ""), 2))),
      rotdyn_error_scene = function(e) NULL
    )
    is.null(back) || inherits(back, "rot_scene")
  }, NA)
  stopifnot(damaged)
  if (requireNamespace("RSQLite", quietly = TRUE)) {
    lab <- tempfile(fileext = ".sqlite")
    records_create(lab)
    for (i in 1:5) records_add(lab, spin_up())
    stopifnot(records_rerun(lab, records_list(lab)$run[1])$verdict == "identical",
      records_check(lab)$holds)
  }
}
cat("boundary: done\n")
