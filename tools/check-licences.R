# Rscript tools/check-licences.R TARBALL: compares inst/COPYRIGHTS with the files of a tarball.
# Every file has a line, and every line a file. The last line is `licences: N passed, N failed`.

tarball <- commandArgs(trailingOnly = TRUE)[1L]
files <- grep("/$", utils::untar(tarball, list = TRUE), invert = TRUE, value = TRUE)
files <- sub("^[^/]*/", "", files)
paragraphs <- as.data.frame(read.dcf("inst/COPYRIGHTS"))
paragraphs <- paragraphs[!is.na(paragraphs$Files), ]
patterns <- strsplit(trimws(paragraphs$Files), "[[:space:]]+")
# A star stands for any text, with slashes: `src/*` is all below src.
matches <- function(pattern) {
  grepl(paste0("^", gsub("[*]", ".*", gsub("[.]", "[.]", pattern)), "$"), files)
}

found <- lapply(unlist(patterns), matches)
# build/ is there with vignettes alone.
idle <- unlist(patterns)[!vapply(found, any, NA)]
idle <- setdiff(idle, "build/*")
bare <- files[!Reduce(`|`, found)]
for (file in bare) cat("not ok - no licence line:", file, "\n")
for (pattern in idle) cat("not ok - no file:", pattern, "\n")
licence <- character(length(files))
for (i in seq_along(patterns)) {
  for (pattern in patterns[[i]]) licence[matches(pattern)] <- paragraphs$License[i]
}
for (one in setdiff(sort(unique(licence)), "")) {
  cat(sprintf("  %-26s %4d files\n", one, sum(licence == one)))
}
failed <- length(bare) + length(idle)
cat(sprintf("licences: %d passed, %d failed\n", length(files) - length(bare), failed))
quit(status = failed > 0L)
