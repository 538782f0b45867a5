# What the pictures of tools/gallery.R draw and their objects print, as text. Layers of one kind
# with the same constants are a line; of each aesthetic it has the number of values, their range and
# mean, and the mean of value times place (-1 for the first to 1 for the last), so that an exchange
# shows. Numbers have three digits, those at the level of rounding none. Where a picture changes on
# purpose, look at `make gallery`, then call testthat::snapshot_accept("pictures").
skip_if_not_installed("ggplot2")

gallery_lists <- function() {
  path <- file.path(Sys.getenv("ROTDYN_ROOT", "no such folder"), "tools", "gallery.R")
  skip_if_not(file.exists(path), "the repository is not here")
  found <- new.env(parent = asNamespace("rotdyn"))
  sys.source(path, found)
  # Times of computers, and residuals that are rounding alone.
  found$classes[c("rot_work_precision", "rot_audit.rounding", "rot_animation")] <- NULL
  # Fits of scenes have test-fit-scene.R.
  found$classes[startsWith(names(found$classes), "rot_fit")] <- NULL
  found
}

# Numbers of the level of rounding differ between machines.
without_rounding <- function(text) {
  gsub(" *[-+]?[0-9][0-9.]*e-(1[1-9]|[2-9][0-9]|[1-3][0-9][0-9])", " <rounding>", text)
}

numbers_text <- function(x) {
  size <- max(abs(x[is.finite(x)]), 0)
  text <- function(x) {
    x[is.finite(x) & abs(x) < 1e-4 * size] <- 0
    x <- x * (1 + 1e-7) # 2.125 is the same three digits where it is computed as a little less
    paste(format(signif(x, 3), digits = 3, trim = TRUE), collapse = " ")
  }
  if (length(x) <= 4L) return(text(x))
  known <- x[is.finite(x)]
  place <- seq(-1, 1, length.out = length(known))
  sprintf(
    "%d in %s to %s, mean %s, %s", length(x), text(min(known)), text(max(known)),
    text(mean(known)), text(mean(known * place))
  )
}

value_as_text <- function(x) {
  if (inherits(x, "AsIs")) class(x) <- setdiff(class(x), "AsIs")
  if (is.list(x) || is.expression(x)) x <- vapply(x, deparse1, "")
  if (is.numeric(x)) return(numbers_text(as.double(x)))
  paste(utils::head(unique(as.character(x)), 8L), collapse = "; ")
}

# The geom with its constants, and the values of its aesthetics.
layer_parts <- function(layer, plot) {
  data <- layer$data
  if (is.function(data)) data <- data(plot$data)
  if (!is.data.frame(data)) data <- plot$data
  mapping <- if (layer$inherit.aes) plot$mapping else list()
  mapping[names(layer$mapping)] <- layer$mapping
  constants <- vapply(layer$aes_params, value_as_text, "")
  constants <- constants[constants != "solid"]
  list(
    kind = paste(c(class(layer$geom)[1], paste(names(constants), constants)), collapse = ", "),
    values = Filter(Negate(is.null), lapply(mapping, function(one) {
      tryCatch(rlang::eval_tidy(one, data), error = function(e) NULL)
    }))
  )
}

layers_text <- function(plot) {
  parts <- lapply(plot$layers, layer_parts, plot)
  kinds <- vapply(parts, `[[`, "", "kind")
  unlist(lapply(unique(kinds), function(kind) {
    values <- lapply(parts[kinds == kind], `[[`, "values")
    names <- unique(unlist(lapply(values, names)))
    text <- vapply(names, function(name) {
      one <- lapply(values, `[[`, name)
      if (is.factor(one[[1L]])) one <- lapply(one, as.character)
      value_as_text(if (is.list(one[[1L]])) do.call(c, one) else unlist(one))
    }, "")
    times <- if (sum(kinds == kind) > 1L) paste(sum(kinds == kind), "times ")
    paste0(times, kind, ": ", paste0(names, " (", text, ")", collapse = ", "))
  }))
}

scale_text <- function(scale) {
  said <- list(
    limits = scale$limits, breaks = scale$breaks, labels = scale$labels,
    values = tryCatch(scale$palette(3L), error = function(e) NULL),
    expand = if (is.numeric(scale$expand)) scale$expand
  )
  said <- Filter(function(x) {
    !is.null(x) && !inherits(x, "waiver") && !is.function(x) && !identical(x, 3L)
  }, said)
  if (!length(said)) return(NULL)
  said <- vapply(said, value_as_text, "")
  paste0("scale of ", scale$aesthetics[1], ": ", paste(names(said), said, collapse = ", "))
}

picture_text <- function(plot) {
  texts <- unlist(plot$labels[c("title", "subtitle", "caption", "alt")])
  facets <- names(c(plot$facet$params$facets, plot$facet$params$rows, plot$facet$params$cols))
  limits <- unlist(plot$coordinates$limits)
  without_rounding(gsub("\n", " ", c(
    paste0(names(texts), ": ", texts), layers_text(plot),
    unlist(lapply(plot$scales$scales, scale_text)), if (length(facets)) paste("facets:", facets),
    if (length(limits)) paste("limits:", value_as_text(limits))
  ), fixed = TRUE))
}

# Their prints say when a run was, or how long one takes.
says_times <- c("rot_rerun", "rot_sweep", "rot_sweep.map", "rot_sweep.lines", "rot_sweep.indices")

lists <- gallery_lists()
place <- new.env(parent = asNamespace("rotdyn"))
needs <- c("DBI", "RSQLite")
for (package in needs) skip_if_not_installed(package)
lists$prepare(place)
made <- function(expression) suppressWarnings(suppressMessages(eval(expression, place)))

middle_frame <- function(x) {
  film <- animate_motion(x, frames_per_s = 2)
  times <- film$film$time_s
  ggplot2::autoplot(film, time_s = times[(length(times) + 1) %/% 2])
}

for (name in names(lists$classes)) {
  test_that(paste("the picture and the print of", name), {
    if (name == "rot_rerun") skip_if_not_installed("yyjsonr")
    object <- made(lists$classes[[name]])
    printed <- if (!name %in% says_times) cli::ansi_strip(utils::capture.output(print(object)))
    text <- c(picture_text(ggplot2::autoplot(object)), "", without_rounding(printed))
    expect_snapshot(writeLines(text))
  })
}

for (name in names(lists$scenes)) {
  test_that(paste("the pictures of", name), {
    scene <- made(lists$scenes[[name]])
    motion <- trajectory(scene[[1]], scene[[2]])
    frame <- if (name != "scene_equations") picture_text(middle_frame(motion))
    text <- c(
      picture_text(ggplot2::autoplot(scene[[1]])), "", picture_text(ggplot2::autoplot(motion)), "",
      frame
    )
    expect_snapshot(writeLines(text))
  })
}

for (name in names(lists$animations)) {
  test_that(paste("a frame of", name), {
    text <- picture_text(middle_frame(made(lists$animations[[name]])))
    expect_snapshot(writeLines(text))
  })
}
