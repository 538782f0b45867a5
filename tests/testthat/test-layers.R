# The layers of R/ (tests/layers.txt): no function calls one of a higher layer.
read_layers <- function(file) {
  lines <- grep("^#|^ *$", readLines(file), value = TRUE, invert = TRUE)
  at <- cumsum(!startsWith(lines, " "))
  files <- lapply(split(lines, at), function(part) unlist(strsplit(trimws(part[-1]), " +")))
  level <- rep(seq_along(files), lengths(files))
  stats::setNames(level, paste0(unlist(files, use.names = FALSE), ".R"))
}

# The file of R/ that assigns each name.
definitions <- function(folder) {
  files <- list.files(folder, "[.]R$")
  names_of <- function(file) {
    code <- parse(file.path(folder, file), keep.source = FALSE)
    is_named <- vapply(code, function(e) {
      is.call(e) && identical(e[[1L]], quote(`<-`)) && is.name(e[[2L]])
    }, NA)
    vapply(code[is_named], function(e) as.character(e[[2L]]), "")
  }
  named <- lapply(stats::setNames(files, files), names_of)
  stats::setNames(rep(files, lengths(named)), unlist(named, use.names = FALSE))
}

# Names that a value uses: functions, also those in lists. `named` has all that are written, in a
# tenth of the time; among them are local variables with the name of a function.
named <- function(f) c(all.names(body(f)), unlist(lapply(formals(f), all.names)))
uses <- function(x, of = named) {
  if (is.function(x)) return(of(x))
  if (is.list(x)) {
    return(unlist(lapply(unclass(x), function(part) if (!missing(part)) uses(part, of))))
  }
  character()
}

# A row for each use of a function of another file: caller, from, callee, to.
edges_of <- function(defined, namespace) {
  rows <- lapply(intersect(names(defined), ls(namespace, all.names = TRUE)), function(name) {
    to <- defined[intersect(uses(get(name, namespace)), names(defined))]
    to <- to[to != defined[[name]]]
    if (length(to)) {
      data.frame(caller = name, from = defined[[name]], callee = names(to), to = unname(to))
    }
  })
  do.call(rbind, rows)
}

# Of the upward edges those whose name is not a local variable's.
upward <- function(edges, layers, namespace) {
  up <- edges[layers[edges$from] < layers[edges$to], ]
  globals <- lapply(stats::setNames(nm = unique(up$caller)), function(name) {
    uses(get(name, namespace), codetools::findGlobals)
  })
  up <- up[as.logical(Map(function(caller, callee) callee %in% globals[[caller]], up$caller,
    up$callee)), ]
  sprintf("%s (%s) uses %s (%s)", up$caller, up$from, up$callee, up$to)
}

test_that("no file of R/ uses a higher layer", {
  skip_if_not_installed("codetools")
  root <- Sys.getenv("ROTDYN_ROOT")
  skip_if(!dir.exists(file.path(root, "R")), "the sources are not here")
  layers <- read_layers(file.path(root, "tests", "layers.txt"))
  expect_equal(anyDuplicated(names(layers)), 0L)
  defined <- definitions(file.path(root, "R"))
  expect_setequal(names(layers), unique(defined))
  edges <- edges_of(defined, asNamespace("rotdyn"))
  expect_gt(nrow(edges), 3000)
  expect_equal(upward(edges, layers, asNamespace("rotdyn")), character())
  # It finds what it looks for.
  layers[["plot.R"]] <- 9L
  expect_true(any(grepl("uses .* \\(plot[.]R\\)", upward(edges, layers, asNamespace("rotdyn")))))
})

test_that("no name is defined in two files of R/", {
  root <- Sys.getenv("ROTDYN_ROOT")
  skip_if(!dir.exists(file.path(root, "R")), "the sources are not here")
  defined <- names(definitions(file.path(root, "R")))
  expect_gt(length(defined), 2000)
  # The later file would win, without a word.
  expect_identical(setdiff(defined[duplicated(defined)], ".onLoad"), character())
})
