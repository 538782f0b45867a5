# Rscript tools/read-check.R FOLDER.Rcheck: prints what R CMD check found amiss, and closes with
# `check: N passed, N failed, N skipped`, one for each line of verdict.
#
# OK passes. ERROR, WARNING and NOTE fail, except the NOTE of every new submission (passes) and a
# NOTE that only says that a tool is missing on this machine (a skip), and that on examples which
# took long by the clock, not in processor time (passes), and that on the installed size up to
# 10.5 MB: byte code 3.4, lessons with their pictures 2.2, the core 1.7, the page of the lab 1.3.
# The stages that rebuild the vignettes do not count where --no-vignettes switches them off: R CMD
# build has built them.

folder <- commandArgs(trailingOnly = TRUE)[1L]
log <- readLines(file.path(folder, "00check.log"), warn = FALSE, encoding = "UTF-8")

starts <- grep("^\\* ", log)
blocks <- Map(function(from, to) log[from:to], starts, c(starts[-1L] - 1L, length(log)))

# The verdict stands at the end of the heading, or on a line of its own further down.
verdict_of <- function(block) {
  verdicts <- "(OK|NONE|NOTE|WARN|WARNING|ERROR|SKIPPED|Note_to_CRAN_maintainers)"
  timing <- "(\\[[^]]*\\] )?"
  found <- c(
    grep(paste0("^ ", timing, verdicts, "$"), sub("^.* \\.\\.\\.", "", block[1L]), value = TRUE),
    grep(paste0("^ *", timing, verdicts, "$"), block[-1L], value = TRUE)
  )
  if (length(found)) sub(paste0("^ *", timing), "", found[1L]) else ""
}

is_new_submission <- function(block) {
  said <- setdiff(trimws(block[-1L]), "")
  grepl("CRAN incoming feasibility", block[1L], fixed = TRUE) &&
    all(grepl("^(Maintainer: |New submission$)", said))
}
lacks_tool <- function(block) {
  said <- setdiff(trimws(block[-1L]), "")
  skips <- "^Skipping checking .*(unavailable|no command|not found)"
  (length(said) && all(grepl(skips, said, ignore.case = TRUE))) ||
    any(grepl("^Packages? suggested but not available for checking:", said))
}

# Examples are judged by their processor time: the elapsed time is that of a busy machine, too.
example_cpu_s <- 5
only_slow_by_the_clock <- function(block) {
  said <- setdiff(trimws(block[-1L]), "")
  said <- said[!grepl("^(Examples with CPU|user +system +elapsed$|\\[)", said)]
  said <- said[!grepl("^(OK|NOTE)$", said)]
  rows <- strsplit(said, " +")
  if (!grepl("checking examples", block[1L], fixed = TRUE) || !length(rows) ||
      !all(lengths(rows) == 4L)) {
    return(FALSE)
  }
  times <- suppressWarnings(vapply(rows, function(row) sum(as.numeric(row[2:3])), 0))
  !anyNA(times) && all(times <= example_cpu_s)
}

most_installed_mb <- 10.5
only_size <- function(block) {
  size <- regmatches(block, regexpr("(?<=installed size is )[ 0-9.]+(?=Mb)", block, perl = TRUE))
  grepl("checking installed package size", block[1L], fixed = TRUE) && length(size) == 1L &&
    as.numeric(size) <= most_installed_mb
}

left_to_build <- function(block) {
  grepl("R code from vignettes|re-building of vignette outputs", block[1L])
}

judge <- function(block) {
  switch(verdict_of(block),
    OK = , NONE = , Note_to_CRAN_maintainers = "passed",
    SKIPPED = if (left_to_build(block)) "none" else "skipped",
    NOTE = if (is_new_submission(block) || only_slow_by_the_clock(block) || only_size(block))
             "passed"
           else if (lacks_tool(block)) "skipped"
           else "failed",
    WARN = , WARNING = , ERROR = "failed",
    "none"
  )
}

verdicts <- vapply(blocks[grepl("^\\* checking", log[starts])], judge, "")
headed <- blocks[grepl("^\\* checking", log[starts])]
for (block in headed[verdicts %in% c("failed", "skipped")]) writeLines(block)
writeLines(grep("^Status: ", log, value = TRUE))

failed <- sum(verdicts == "failed")
# A check that stopped midway has no status line.
if (!any(grepl("^Status: ", log)) || (!failed && any(grepl("^Status: .*(ERROR|WARNING)", log)))) {
  said <- file.path(dirname(folder), "R-CMD-check.out")
  if (file.exists(said)) log <- readLines(said, warn = FALSE)
  writeLines(c("R CMD check did not come to its end:", tail(log, 20L)))
  failed <- failed + 1L
}
# What the failing tests printed is in files of their own, after R's greeting, between the echoed
# lines of the script.
for (file in list.files(folder, "\\.fail$", recursive = TRUE, full.names = TRUE)) {
  said <- readLines(file, warn = FALSE)
  echoed <- grepl("^[>+]( |$)", said)
  said <- tail(said[cumsum(echoed) > 0L & !echoed], 60L)
  writeLines(c(paste0("---- ", basename(file)), said))
}
cat(sprintf(
  "check: %d passed, %d failed, %d skipped\n", sum(verdicts == "passed"), failed,
  sum(verdicts == "skipped")
))
quit(status = failed > 0L)
