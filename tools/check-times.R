# Rscript tools/check-times.R FOLDER.Rcheck LIMIT: the processor time of R CMD check by part (run
# with _R_CHECK_TIMINGS_=0), and of the slowest files of tests and examples. Status 1: more than
# LIMIT seconds in all.

arguments <- commandArgs(trailingOnly = TRUE)
folder <- arguments[1L]
lines <- readLines(file.path(folder, "00check.log"), warn = FALSE, encoding = "UTF-8")

# `* checking tests ... [294s/310s]`, minutes as `m`; on a line of its own below a part that prints.
pattern <- "\\[([0-9.]+)([sm])/[0-9.]+[sm]\\]"
part <- NA
time <- numeric()
for (line in lines) {
  if (startsWith(line, "* ")) part <- sub("^\\* (checking )?", "", sub(" \\.\\.\\..*", "", line))
  found <- regmatches(line, regexec(pattern, line))[[1]]
  if (!length(found) || is.na(part) || part %in% names(time)) next
  time[[part]] <- as.numeric(found[2]) * if (found[3] == "m") 60 else 1
}
time <- sort(time, decreasing = TRUE)
for (one in names(time)[time >= 1]) cat(sprintf("  %7.1f s  %s\n", time[[one]], one))
cat(sprintf("  %7.1f s  all %d parts\n", sum(time), length(time)))

files <- list.files(file.path(folder, "tests"), "[.]Rout", full.names = TRUE)
said <- unlist(lapply(files, readLines, warn = FALSE))
slow <- grep("^processor time: ", said, value = TRUE)
if (length(slow)) {
  cat("  the slowest files of tests\n", paste0("   ", sub("[^:]*: ", "", slow), "\n"))
}
examples <- list.files(folder, "-Ex[.]timings$", full.names = TRUE)
if (length(examples)) {
  # The lines end in a tab that the heading has not.
  table <- utils::read.table(examples[1], skip = 1, sep = "\t", fill = TRUE)
  names(table)[1:3] <- c("name", "user", "system")
  cpu <- table$user + table$system
  over <- cpu >= 1
  cat(sprintf("  examples: %d of %d take 1 s or more\n", sum(over), nrow(table)))
  for (i in which(over)) cat(sprintf("    %5.1f s  %s\n", cpu[i], table$name[i]))
}
quit(status = !length(time) || sum(time) > as.numeric(arguments[2L]))
