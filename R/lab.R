# The lab: a scene as a page that computes in the browser (inst/lab, made by `make lab` from web/
# and the core), or as an element of a document. Scenes with R functions come as recordings.

lab_rows <- 401L
lab_max_rows <- 4001L

#' A lab: a scene in the browser
#'
#' A page with a slider for each number of the scene. It computes with the same core, compiled for
#' the browser: curves and a picture that move, the model and its reason, the error, the audit,
#' events, the R code that gives the same numbers, a link that brings the set-up back, the rows as
#' CSV, pictures (SVG, PNG) and a film of the motion (WebM, or MP4 where the browser records that).
#' One file: it needs no server, no network and no R, and asks nobody for anything; so it can
#' be opened from a disk, put on a web server or uploaded to a course page. It needs a browser of
#' 2023 or later: Chrome and Edge 80, Firefox 113, Safari 16.4.
#'
#' In R Markdown, Quarto and the site a lab that a chunk returns is an element of the document; the
#' core is in the document once, however many labs it has. Where the document is not HTML, a
#' sentence stands for it.
#'
#' R functions do not run in the browser. A scene with one comes as a recording: its motion is
#' computed here, it plays and can be read, and its inputs are fixed; the page says so.
#'
#' @param x NULL: the page with its list of scenes, one for every constraint. A scene (see
#'   [scene_axle()]), or a motion from [trajectory()], from its first to its last time.
#' @param file NULL, or a file to write, ending in `.html`.
#' @param ... Not used; names after it must be given in full.
#' @param end_s NULL, or when the motion ends, in s; by default at the last time of a motion, and
#'   10 s after the start of a scene.
#' @param title NULL, or the title; by default what the scene is.
#' @param language NULL: the reader's; or `"en"`, `"de"`.
#' @return With a `file`, its path, invisibly. Otherwise a `rot_lab`: printed, it opens in the
#'   browser (interactive sessions) or says what it has; `format(x)` is the HTML of the page.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_time`,
#'   `rotdyn_error_file`, `rotdyn_error_unit`, `rotdyn_error_argument`, and, of a recording, those of
#'   [trajectory()].
#' @seealso [animate_motion()] for a film of a motion; [write_scene()] for the text of a scene.
#' @concept interactive
#' @concept html
#' @concept teaching
#' @examples
#' lab(scene_free(c(1, 2, 2.6), c(0.05, 6, 0.05)), end_s = 12)
#' page <- lab(scene_axle(0.5, 0.8), tempfile(fileext = ".html"), title = "Spin-up")
#' file.size(page)
#' @export
lab <- function(x = NULL, file = NULL, ..., end_s = NULL, title = NULL, language = NULL) {
  call <- check_no_dots(...)
  if (!is.null(file)) file <- check_lab_name(file, call)
  if (!is.null(title)) check_lab_title(title, call)
  if (!is.null(language)) check_lab_language(language, call)
  state <- if (is.null(x)) list() else lab_state(x, end_s, call)
  if (!is.null(title)) state$title <- title
  if (!is.null(language)) state$lang <- language
  out <- structure(list(state = state), class = "rot_lab")
  if (is.null(file)) return(out)
  write_file(format(out), file, call)
  invisible(file)
}

check_lab_name <- function(file, call) {
  path <- check_file_name(file, call)
  if (!grepl("\\.html?$", path, ignore.case = TRUE)) {
    abort_rotdyn(
      c("{.arg file} must end in {.file .html}.", x = "It is {.file {path}}."), "value", call
    )
  }
  path
}

check_lab_title <- function(title, call) {
  if (!rlang::is_string(title) || !is_readable_text(title)) {
    abort_rotdyn(
      c("{.arg title} must be one string.", x = "It is {describe_value(title)}."), "type", call
    )
  }
}

lab_languages <- c("en", "de")

check_lab_language <- function(language, call) {
  if (!rlang::is_string(language) || !language %in% lab_languages) {
    abort_rotdyn(c(
      "{.arg language} must be one of {.val {lab_languages}}.",
      x = "It is {describe_value(language)}."
    ), "value", call)
  }
}

# What the page shows: the text of the scene and its times, or a recording.
lab_state <- function(x, end_s, call) {
  motion <- NULL
  if (inherits(x, "rot_trajectory")) {
    run <- check_trajectory(x, "x", call)
    motion <- x
    scene <- run$scene
    known <- x$time_s[is.finite(x$time_s)]
    ends <- if (length(known)) range(known) else c(0, 0)
    times <- length(unique(known))
  } else {
    check_scene(x, call)
    scene <- x
    ends <- scene$start_s + c(0, 10)
    times <- lab_rows
  }
  if (!is.null(end_s)) ends[2] <- check_number(end_s, "end_s", "s", call)
  if (!(ends[2] > ends[1])) {
    abort_rotdyn(c(
      "The motion must end after it begins.",
      x = "It would go from {format(ends[1], digits = 7)} to {format(ends[2], digits = 7)} s."
    ), "time", call)
  }
  rows <- min(max(times, 2L), lab_max_rows)
  text <- tryCatch(scene_text(scene, call), rotdyn_error_scene = function(e) NULL)
  if (!is.null(text)) {
    state <- list(scene = text, end = ends[2])
    if (ends[1] != scene$start_s) state$start <- ends[1]
    if (rows != lab_rows) state$rows <- rows
    if (!is.null(motion) && run$accuracy != 1e-9) state$accuracy <- run$accuracy
    return(state)
  }
  if (is.null(motion) || !is.null(end_s)) {
    accuracy <- if (is.null(motion)) 1e-9 else run$accuracy
    motion <- trajectory(scene, seq(ends[1], ends[2], length.out = rows), accuracy = accuracy)
  }
  list(recording = lab_recording(motion), end = ends[2])
}

# The motion as the page reads it from the core.
lab_recording <- function(motion) {
  run <- trajectory_run(motion)
  constraint <- constraint_of(run$scene)
  index <- constraint$index
  names <- setdiff(names(motion), c("time_s", index))
  columns <- unclass(motion)[names]
  columns <- columns[vapply(columns, function(x) is.double(x) || is.logical(x), NA)]
  state <- unlist(lapply(seq_along(constraint$measures), function(i) {
    stats::setNames(rep(i - 1, length(constraint$measures[[i]]$columns)),
                    constraint$measures[[i]]$columns)
  }))
  info <- run$info
  events <- motion_events(motion)
  time_s <- unique(motion$time_s)
  balances <- audit(motion)
  list(
    said = list(
      status = 0, constructor = sub("^rot_", "", class(run$scene)[1]), constraint = constraint$id,
      index = index, rows_per_time = length(motion$time_s) / length(time_s),
      columns = unname(lapply(names(columns), function(name) {
        list(name = name, flag = as.double(is.logical(columns[[name]])),
             measure = if (name %in% names(state)) state[[name]] else -1)
      }))
    ),
    report = list(
      status = 0, model = run$model, reason = "",
      error = info$error, error_is_bound = as.double(run$error_kind == "bound"),
      rows_done = length(time_s),
      measures = unname(Map(function(name, error, size) {
        list(name = name, error = error, largest = size)
      }, names(info$errors), unname(info$errors), unname(info$sizes))),
      n_events = nrow(events),
      events = unname(Map(function(name, time_s) list(name = name, time_s = time_s, place = 0),
                          as.character(events$event), events$time_s))
    ),
    why = constraint$models[[run$model]]$why,
    time = as.list(time_s),
    columns = lapply(columns, function(x) as.list(as.double(x))),
    audit = lapply(seq_along(balances$balance), function(k) lab_balance(balances, k))
  )
}

lab_balance <- function(balances, k) {
  verdict <- balances$verdict[k]
  terms <- balances$terms[[k]]
  role <- match(terms$role, c("supplied", "dissipated", "change")) - 1
  list(
    quantity = balances$balance[k], unit = balances$unit[k], change = balances$change[k],
    supplied = balances$supplied[k], dissipated = balances$dissipated[k],
    residual = balances$residual[k], explained = balances$rounding[k],
    balanced = if (is.na(verdict)) -1 else as.double(verdict == "balanced"),
    terms = unname(Map(function(words, value, role) {
      list(words = words, value = value, role = role)
    }, terms$term, terms$value, role))
  )
}

# ---- the page and its script ---------------------------------------------------------------------

# The lines of inst/lab/lab.html.
lab_page <- function() {
  path <- system.file("lab", "lab.html", package = "rotdyn")
  readLines(path, encoding = "UTF-8", warn = FALSE)
}

lab_json <- function(x) {
  # No "</script>" in a script; what is not finite is none of JSON.
  text <- gsub("<", "\\u003c", json_text(x), fixed = TRUE)
  gsub("\"(NaN|NA|-?Inf)\"(?=[],}])", "null", text, perl = TRUE)
}

#' @export
format.rot_lab <- function(x, ...) {
  check_no_dots(...)
  lines <- lab_page()
  at <- which(lines == "<script type=\"application/json\" id=\"rotdyn-state\">")[1] + 1L
  lines[at] <- if (length(x$state)) lab_json(x$state) else "{}"
  lines
}

#' @export
print.rot_lab <- function(x, ...) {
  check_no_dots(...)
  state <- x$state
  what <- if (!length(state)) {
    "a list of scenes"
  } else if (!is.null(state$recording)) {
    "a recording: the scene has an R function"
  } else {
    "a scene with its inputs"
  }
  title <- if (is.null(state$title)) "" else paste0(" ", escape_controls(state$title))
  say("<rot_lab>", title, "\n")
  say("  ", what, if (!is.null(state$end)) paste0(", up to ", format_si(state$end), " s"), "\n")
  say("  A file of it: lab(scene, \"lab.html\").\n")
  if (interactive()) show_page(format(x), current_env())
  invisible(x)
}

# ---- in documents --------------------------------------------------------------------------------

# The script alone, in a folder of this session: the dependency of a document.
lab_dependency <- function() {
  folder <- file.path(tempdir(), "rotdyn-lab")
  path <- file.path(folder, "rotdyn-lab.js")
  if (!file.exists(path)) {
    lines <- lab_page()
    from <- which(lines == "<script id=\"rotdyn-lab\">")[1]
    to <- which(lines == "</script>")
    dir.create(folder, showWarnings = FALSE)
    write_file(lines[seq(from + 1L, min(to[to > from]) - 1L)], path, current_env())
  }
  structure(
    list(
      name = "rotdyn-lab", version = as.character(utils::packageVersion("rotdyn")),
      src = list(file = folder), script = "rotdyn-lab.js", all_files = TRUE
    ),
    class = "html_dependency"
  )
}

# The element; of the page with its list, its first scene.
lab_element <- function(x) {
  state <- x$state
  attribute <- function(name, value) {
    if (!is.null(value)) paste0(" ", name, "=\"", html_text_plain(value), "\"")
  }
  settings <- state[setdiff(names(state), c("scene", "lang"))]
  paste0(
    "<rotdyn-lab", attribute("scene", state$scene),
    attribute("settings", if (length(settings)) lab_json(settings)),
    attribute("lang", state$lang), "></rotdyn-lab>"
  )
}

html_text_plain <- function(x) {
  x <- gsub("&", "&amp;", enc2utf8(x), fixed = TRUE)
  gsub("<", "&lt;", gsub("\"", "&quot;", x, fixed = TRUE), fixed = TRUE)
}

#' @exportS3Method knitr::knit_print
knit_print.rot_lab <- function(x, ...) {
  if (!knitr::is_html_output(excludes = c("markdown", "gfm", "epub"))) {
    title <- if (is.null(x$state$title)) "A scene" else x$state$title
    return(knitr::asis_output(paste0("\n\n", title, ": a lab, in documents of HTML.\n\n")))
  }
  knitr::asis_output(
    paste0("\n\n```{=html}\n", lab_element(x), "\n```\n\n"), meta = list(lab_dependency())
  )
}
