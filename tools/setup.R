# What R has, said by R itself. Called by tools/setup.sh and the scripts beside it.
#
#   Rscript tools/setup.R imports         names in DESCRIPTION's Imports
#   Rscript tools/setup.R suggests        names in DESCRIPTION's Suggests
#   Rscript tools/setup.R lessons         those of them that vignettes/ names
#   Rscript tools/setup.R missing PKG...  those of PKG that R cannot load, or only too old a one
#   Rscript tools/setup.R install PKG...  installs them from CRAN
#   Rscript tools/setup.R library         the first library that can be written, made if need be

fields <- read.dcf("DESCRIPTION", fields = c("Imports", "Suggests"))[1L, ]
base <- rownames(installed.packages(.Library, priority = "base"))

entries <- function(field) {
  all <- trimws(strsplit(paste(field[!is.na(field)], collapse = ","), ",")[[1L]])
  all[nzchar(all)]
}
names_of <- function(field) setdiff(sub("[ (].*", "", gsub("\\s+", " ", entries(field))), base)

named_in_lessons <- function(packages) {
  text <- unlist(lapply(list.files("vignettes", "[.](Rmd|R|yml)$", full.names = TRUE), readLines))
  Filter(function(name) {
    any(grepl(sprintf("\"%1$s\"|library\\(%1$s\\)|\\b%1$s::", name), text))
  }, packages)
}

# The minimum version that DESCRIPTION asks for, "0" if it asks for none.
minimum <- function(pkg) {
  asked <- grep(paste0("^", pkg, "\\s*\\("), entries(fields), value = TRUE)
  if (length(asked)) gsub(".*>=\\s*|\\)", "", asked[1L]) else "0"
}

# Loading, not finding: a package is also missing if one that it needs is absent or too old.
loads <- function(pkg) {
  suppressWarnings(suppressPackageStartupMessages(requireNamespace(pkg, quietly = TRUE))) &&
    getNamespaceVersion(pkg) >= minimum(pkg)
}

first_library <- function() {
  open <- .libPaths()[file.access(.libPaths(), 2L) == 0L]
  if (length(open)) return(open[1L])
  own <- strsplit(Sys.getenv("R_LIBS_USER"), .Platform$path.sep, fixed = TRUE)[[1L]][1L]
  if (is.na(own) || !dir.create(path.expand(own), recursive = TRUE)) {
    stop("no R library can be written, and R_LIBS_USER names none that can be made", call. = FALSE)
  }
  path.expand(own)
}

install <- function(pkgs) {
  if (identical(unname(getOption("repos")["CRAN"]), "@CRAN@") || !length(getOption("repos"))) {
    utils::chooseCRANmirror(ind = 1L, local.only = TRUE)
  }
  options(timeout = max(900, getOption("timeout")))
  cores <- max(1L, parallel::detectCores(), na.rm = TRUE)
  lib <- first_library()
  # Where the library was made a moment ago, R does not look yet.
  .libPaths(c(lib, .libPaths()))
  utils::install.packages(pkgs, lib = lib, Ncpus = cores, quiet = TRUE)
}

args <- commandArgs(trailingOnly = TRUE)
switch(args[1L],
  imports = writeLines(names_of(fields["Imports"])),
  suggests = writeLines(names_of(fields["Suggests"])),
  lessons = writeLines(named_in_lessons(names_of(fields["Suggests"]))),
  missing = writeLines(Filter(Negate(loads), unique(args[-1L]))),
  install = install(args[-1L]),
  library = writeLines(first_library()),
  stop("tools/setup.R does not know '", args[1L], "'", call. = FALSE)
)
