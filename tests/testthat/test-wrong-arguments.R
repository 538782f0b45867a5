# What every function of the gallery's examples says of a text and of five numbers as each of its
# arguments: the class of its error, or "taken". Never an error of base R. Where that changes on
# purpose, call testthat::snapshot_accept("wrong-arguments").
skip_if_not_installed("ggplot2")

path <- file.path(Sys.getenv("ROTDYN_ROOT", "no such folder"), "tools", "gallery.R")
skip_if_not(file.exists(path), "the repository is not here")
lists <- new.env(parent = asNamespace("rotdyn"))
sys.source(path, lists)
place <- new.env(parent = asNamespace("rotdyn"))
for (package in c("DBI", "RSQLite")) skip_if_not_installed(package)
lists$prepare(place)

# Of these a call takes long, writes or draws random numbers.
left_out <- c(
  "work_precision", "animate_motion", "sweep_run", "sweep_plan", "fit_coast_down", "fit_swing",
  "fit_scene", "estimate_motion", "records_rerun", "design_saltelli", "design_sobol",
  "design_grid", "domain_inside", "domain_map", "uncertainty_budget"
)

# The first call of each function: a list by name.
calls_in <- function(code, found = list()) {
  if (is.call(code)) {
    name <- if (is.name(code[[1]])) as.character(code[[1]]) else ""
    ours <- name %in% getNamespaceExports("rotdyn") && !name %in% left_out
    if (ours && is.null(found[[name]])) {
      found[[name]] <- match.call(get(name, asNamespace("rotdyn")), code, expand.dots = FALSE)
    }
    for (part in as.list(code)[-1]) if (is.call(part)) found <- calls_in(part, found)
  }
  found
}
examples <- list()
for (code in c(lists$classes, lists$scenes, lists$animations)) examples <- calls_in(code, examples)

wrong <- list("wrong", c(0.3, 0.7, 0.2, 0.6, 0.1))

answer <- function(code) {
  tryCatch(
    {
      suppressWarnings(suppressMessages(eval(code, place)))
      "taken"
    },
    error = function(e) {
      kind <- grep("^rotdyn_error_", class(e), value = TRUE)
      if (length(kind)) sub("rotdyn_error_", "", kind[1]) else paste("R:", conditionMessage(e))
    }
  )
}

for (name in sort(names(examples), method = "radix")) {
  test_that(paste("wrong arguments of", name), {
    code <- examples[[name]]
    arguments <- setdiff(names(formals(get(name, asNamespace("rotdyn")))), "...")
    text <- vapply(arguments, function(argument) {
      said <- vapply(wrong, function(value) {
        changed <- code
        changed[argument] <- list(value)
        answer(changed)
      }, "")
      paste0(argument, ": ", paste(said, collapse = ", "))
    }, "")
    expect_false(any(grepl("R: ", text, fixed = TRUE)), info = paste(text, collapse = "\n"))
    expect_snapshot(writeLines(text))
  })
}
