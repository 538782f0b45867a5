# Rscript tools/link-imports.R FOLDER: fills FOLDER with links to the installed packages that the
# imports and testthat need, and nothing else. With --verify, run inside that library: names the
# suggested packages that can be seen all the same, which is no failure where they belong to R.

args <- commandArgs(trailingOnly = TRUE)
fields <- read.dcf("DESCRIPTION", fields = c("Imports", "Suggests"))[1L, ]
names_of <- function(field) {
  trimws(sub("\\(.*", "", trimws(strsplit(paste0(field, ""), ",")[[1L]])))
}

if ("--verify" %in% args) {
  is_seen <- function(pkg) length(find.package(pkg, quiet = TRUE)) > 0L
  seen <- Filter(is_seen, names_of(fields["Suggests"]))
  cat("library:", length(list.files(args[1L])), "packages; suggested ones among them:",
      paste(seen, collapse = ", "), "\n")
} else {
  have <- installed.packages()
  have <- have[!duplicated(rownames(have)), ]
  wanted <- c(names_of(fields["Imports"]), "testthat")
  all <- unique(c(wanted, unlist(tools::package_dependencies(
    wanted, have, which = c("Depends", "Imports", "LinkingTo"), recursive = TRUE
  ))))
  all <- setdiff(intersect(all, rownames(have)), rownames(have)[have[, "Priority"] %in% "base"])
  from <- file.path(have[all, "LibPath"], all)
  stopifnot(file.symlink(from, file.path(args[1L], all)))
}
