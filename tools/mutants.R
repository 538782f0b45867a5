# Mutation tests: one place of the sources is changed at a time, and the tests of its topic run. A
# change that no test notices is a missing test, or code without effect.
#
#   Rscript tools/mutants.R SOURCES TESTS LIBRARY NUMBER SEED
#     SOURCES   a copy of the package, its objects in src/ and a Makevars there
#     TESTS     the folder of tests
#     LIBRARY   where the package is installed
#     NUMBER    of random changes, beside the fixed ones of tools/mutants-fixed.txt
#
# A change of R code needs no installation: the functions are replaced in the loaded namespace. For
# C one file is compiled again. Each change has a process of its own.
#
# Environment: MUTANTS_JOBS (processes at a time, 2), MUTANTS_FILES (a regular expression: files to
# draw from), MUTANTS_FIXED=no (without the fixed ones), MUTANTS_LIST (another file of fixed ones),
# MUTANTS_SHOW=all (what was noticed, and by which test).

suppressPackageStartupMessages(library(testthat))
arguments <- commandArgs(trailingOnly = TRUE)
sources <- normalizePath(arguments[1L])
tests <- normalizePath(arguments[2L])
library_path <- normalizePath(arguments[3L])
number <- as.integer(arguments[4L])
seed <- as.integer(arguments[5L])
jobs <- as.integer(Sys.getenv("MUTANTS_JOBS", "2"))
pattern <- Sys.getenv("MUTANTS_FILES", ".")
least_killed <- 0.95

source("tools/mutants-places.R")

# ---- which tests belong to a file ---------------------------------------------------------------

# tests/topics.txt: `FILE TEST... [+ TEST...]`; tests of C files behind + are testthat's.
read_topics <- function() {
  lines <- grep("^[^#]", readLines(file.path(tests, "topics.txt")), value = TRUE)
  words <- strsplit(trimws(lines), " +")
  stats::setNames(lapply(words, `[`, -1L), vapply(words, `[`, "", 1L))
}
topics <- read_topics()

# Paths of the programs and files that test `file`, in their order.
tests_of <- function(file) {
  topic <- sub("^(R/|src/(rot|ffi)_)(.*)[.][Rch]$", "\\3", file)
  listed <- topics[[sub("[.]h$", ".c", file)]]
  core <- startsWith(file, "src/rot_")
  first <- if (core) listed[cumsum(listed == "+") == 0L] else setdiff(listed, "+")
  after <- if (core) listed[cumsum(listed == "+") > 0L & listed != "+"]
  name <- function(kind, topics) {
    if (!length(topics)) return(character())
    path <- if (kind == "core") sprintf("core/test_%s.c", topics)
            else sprintf("testthat/test-%s.R", topics)
    path[file.exists(file.path(tests, path))]
  }
  kind <- if (core) "core" else "testthat"
  unique(c(name(kind, c(topic, first)), if (core) name("testthat", after)))
}

# ---- changes that are listed --------------------------------------------------------------------

# Blocks of `FILE`, `- before`, `+ after`, `= reason`; an empty line between them. Before and after
# are lines of code without their indentation.
read_listed <- function(file) {
  if (!file.exists(file)) return(list())
  lines <- readLines(file, encoding = "UTF-8")
  lines <- lines[!startsWith(lines, "#")]
  blocks <- split(lines, cumsum(lines == ""))
  blocks <- lapply(blocks, function(block) block[block != ""])
  lapply(unname(blocks[lengths(blocks) > 0L]), function(block) {
    part <- function(sign) squeeze(substring(block[startsWith(block, sign)], 3L))
    list(file = block[1L], before = part("- "), after = part("+ "), reason = part("= "))
  })
}

# A listed change as a mutant: the text of the file with the first place changed.
apply_listed <- function(listed) {
  lines <- readLines(file.path(sources, listed$file), encoding = "UTF-8")
  bare <- gsub("[[:space:]]+", " ", trimws(lines))
  at <- which(bare == listed$before)
  if (!length(at)) return(NULL)
  line <- at[1L]
  changed <- lines
  changed[line] <- listed$after
  list(
    file = listed$file, kind = "fixed", line = line, before = listed$before, after = listed$after,
    text = changed
  )
}

# ---- one mutant, in a process of its own --------------------------------------------------------

# Reports the first failure to `run_tests()`, which stops there.
first_failure <- R6::R6Class("first_failure", inherit = testthat::Reporter, public = list(
  add_result = function(context, test, result) {
    if (inherits(result, c("expectation_failure", "expectation_error"))) {
      invokeRestart("mutant_killed", paste0(test, ": ", conditionMessage(result)))
    }
  }
))

# NULL, or what failed first.
run_test_file <- function(file, cpu_s) {
  withRestarts(
    {
      setTimeLimit(cpu = cpu_s)
      on.exit(setTimeLimit())
      said <- tryCatch({
        utils::capture.output(suppressWarnings(suppressMessages(test_file(
          file, package = "rotdyn", load_package = "installed",
          reporter = first_failure$new(), stop_on_failure = FALSE
        ))))
        NULL
      }, error = function(e) paste("error:", conditionMessage(e)))
      said
    },
    mutant_killed = function(said) said
  )
}

# All code of R/ anew, with the functions of one file changed: lists of functions and functions made
# by functions are made anew, too.
replace_code <- function(code) {
  space <- asNamespace("rotdyn")
  # The namespace takes no new names, as `names(x) <- ...` needs for a moment.
  fresh <- new.env(parent = space)
  for (file in code) for (expression in file) eval(expression, fresh)
  for (name in intersect(ls(fresh, all.names = TRUE), ls(space, all.names = TRUE))) {
    value <- fresh[[name]]
    if (is.function(value) && identical(environment(value), fresh)) environment(value) <- space
    unlockBinding(name, space)
    assign(name, value, envir = space)
  }
  space$.onLoad(dirname(system.file(package = "rotdyn")), "rotdyn")
  ours <- ls(space, all.names = TRUE)
  for (other in c("base", loadedNamespaces())) {
    table <- asNamespace(other)$.__S3MethodsTable__.
    for (name in intersect(ls(table, all.names = TRUE), ours)) {
      if (identical(environment(table[[name]]), space)) assign(name, space[[name]], envir = table)
    }
  }
  attached <- as.environment("package:rotdyn")
  for (name in intersect(ls(attached), ours)) {
    unlockBinding(name, attached)
    assign(name, space[[name]], envir = attached)
  }
}

# A folder for the files of one process: the tests, and for C the objects and a library in which
# everything but the shared object is a link.
slot_folder <- function(slot) file.path(tempdir(), paste0("slot", slot))
make_slot <- function(slot) {
  folder <- slot_folder(slot)
  dir.create(file.path(folder, "library", "rotdyn"), recursive = TRUE)
  file.copy(tests, folder, recursive = TRUE)
  file.copy(file.path(sources, "src"), folder, recursive = TRUE, copy.date = TRUE)
  installed <- setdiff(list.files(file.path(library_path, "rotdyn"), full.names = TRUE),
    file.path(library_path, "rotdyn", "libs"))
  file.symlink(installed, file.path(folder, "library", "rotdyn", basename(installed)))
  dir.create(file.path(folder, "library", "rotdyn", "libs"))
  folder
}

quietly <- function(command, cpu_s) {
  system2("sh", c("-c", shQuote(sprintf(
    "ulimit -t %d; exec %s", as.integer(ceiling(cpu_s)), command
  ))), stdout = FALSE, stderr = FALSE)
}

make_of <- function(folder) {
  quietly(sprintf(
    "sh -c 'cd %s && R CMD SHLIB -o rotdyn.so *.c'", shQuote(file.path(folder, "src"))
  ), 600)
}

# The files that are compiled anew where `file` changes.
compiled_with <- function(file) {
  if (endsWith(file, ".c")) return(basename(file))
  includes <- includers[[basename(file)]]
  includes
}

# The program of a core test, linked with the objects of the slot. Status 0: linked.
link_core <- function(folder, test) {
  name <- sub("[.]c$", "", basename(test))
  object <- file.path(folder, paste0(name, ".o"))
  if (!file.exists(object)) {
    status <- quietly(sprintf(
      "cc -std=c99 -O1 -I%s -I%s %s -c %s -o %s", file.path(folder, "src"),
      file.path(folder, "tests", "core"), gsl_flags, file.path(folder, "tests", test), object
    ), 600)
    if (status != 0L) return(status)
  }
  quietly(sprintf(
    "cc %s %s %s -lm -lpthread -o %s", object,
    paste(list.files(file.path(folder, "src"), "^rot_.*[.]o$", full.names = TRUE), collapse = " "),
    link_flags, file.path(folder, name)
  ), 600)
}

run_core <- function(folder, test, cpu_s) {
  status <- link_core(folder, test)
  if (status != 0L) return("does not link")
  status <- quietly(file.path(folder, sub("[.]c$", "", basename(test))), cpu_s)
  if (status == 0L) NULL else paste("status", status)
}

# The tests of a change, the first that fails ends it. `limits`: processor time by test.
run_all <- function(folder, files, code, limits, lib) {
  loaded <- FALSE
  for (test in files) {
    limit <- if (is.null(limits)) 900 else limits[[test]]
    if (startsWith(test, "core/")) {
      said <- run_core(folder, test, limit)
    } else {
      if (!loaded) {
        said <- tryCatch({
          library(rotdyn, lib.loc = lib)
          if (!is.null(code)) replace_code(code)
          NULL
        }, error = function(e) paste("does not load:", conditionMessage(e)))
        if (!is.null(said)) return(list(status = "killed", by = said))
        loaded <- TRUE
        setwd(file.path(folder, "tests", "testthat"))
      }
      said <- run_test_file(basename(test), limit)
    }
    if (!is.null(said)) return(list(status = "killed", by = paste0(test, ": ", said[1L])))
  }
  list(status = "survived")
}

# The first of the candidates that is a change at all: it compiles, and to something else.
run_mutant <- function(candidates, slot, limits) {
  folder <- slot_folder(slot)
  Sys.setenv(MAKEFLAGS = "", ROTDYN_MUTANT = "yes")
  for (mutant in candidates) {
    mutant$tests <- intersect(tests_of(mutant$file), names(limits))
    if (startsWith(mutant$file, "R/")) {
      changed <- tryCatch(parse(text = mutant$text, keep.source = FALSE), error = function(e) NULL)
      if (is.null(changed) || identical(as.list(changed), as.list(r_code[[mutant$file]]))) next
      code <- r_code
      code[[mutant$file]] <- changed
      done <- run_all(folder, mutant$tests, code, limits, library_path)
    } else {
      path <- file.path(folder, "src", basename(mutant$file))
      objects <- file.path(folder, "src", sub("[.]c$", ".o", compiled_with(mutant$file)))
      saved <- paste0(objects, ".kept")
      original <- paste0(path, ".kept")
      file.copy(path, original, copy.date = TRUE)
      file.rename(objects, saved)
      writeLines(mutant$text, path)
      status <- make_of(folder)
      same <- status == 0L &&
        identical(unname(tools::md5sum(objects)), unname(tools::md5sum(saved)))
      if (status == 0L && !same) {
        so <- file.path(folder, "library", "rotdyn", "libs", "rotdyn.so")
        unlink(so)
        file.copy(file.path(folder, "src", "rotdyn.so"), so)
        done <- run_all(folder, mutant$tests, NULL, limits, file.path(folder, "library"))
      }
      file.rename(saved, objects)
      file.rename(original, path)
      if (status != 0L || same) next
    }
    mutant$text <- NULL
    return(c(mutant, done))
  }
  list(status = "none", file = candidates[[1L]]$file)
}

# ---- the processes ------------------------------------------------------------------------------

cpu_of <- function(pid) {
  said <- suppressWarnings(system2("ps", c("-o", "time=", "-p", pid), stdout = TRUE))
  if (!length(said)) return(0)
  days <- if (grepl("-", said)) as.numeric(sub("-.*", "", trimws(said))) else 0
  parts <- as.numeric(strsplit(sub(".*-", "", trimws(said)), ":")[[1L]])
  days * 86400 + sum(parts * 60^(rev(seq_along(parts)) - 1))
}

# Calls work(item, slot) for each item, `jobs` at a time, each in a process of its own. A process
# that exceeds its limit of processor time or dies gives NULL. done(index, result) as they end.
in_processes <- function(items, work, limit_s, done) {
  running <- list()
  next_item <- 1L
  while (next_item <= length(items) || length(running)) {
    while (next_item <= length(items) && length(running) < jobs) {
      slot <- setdiff(seq_len(jobs), vapply(running, function(r) r$slot, 1L))[1L]
      item <- items[[next_item]]
      job <- parallel::mcparallel(work(item, slot), mc.set.seed = FALSE, silent = TRUE)
      running <- c(running, list(list(
        job = job, slot = slot, index = next_item, began = proc.time()[["elapsed"]], looked = 0
      )))
      next_item <- next_item + 1L
    }
    got <- parallel::mccollect(lapply(running, `[[`, "job"), wait = FALSE, timeout = 1)
    keep <- list()
    for (r in running) {
      name <- as.character(r$job$pid)
      if (name %in% names(got)) {
        parallel::mccollect(r$job, wait = TRUE, timeout = 1)
        restore_slot(r$slot)
        result <- got[[name]]
        done(r$index, if (inherits(result, "try-error")) NULL else result)
        next
      }
      age <- proc.time()[["elapsed"]] - r$began
      if (age - r$looked > 5) {
        r$looked <- age
        limit <- limit_s(items[[r$index]])
        if (cpu_of(r$job$pid) > limit || age > 30 * limit) {
          tools::pskill(r$job$pid, tools::SIGKILL)
          parallel::mccollect(r$job, wait = TRUE)
          restore_slot(r$slot)
          done(r$index, NULL)
          next
        }
      }
      keep <- c(keep, list(r))
    }
    running <- keep
  }
}

# What a process that was killed left: the sources and objects of the slot as they were.
restore_slot <- function(slot) {
  kept <- list.files(file.path(slot_folder(slot), "src"), "[.]kept$", full.names = TRUE)
  file.rename(kept, sub("[.]kept$", "", kept))
}

# ---- the run ------------------------------------------------------------------------------------

r_files <- file.path("R", sort(list.files(file.path(sources, "R"), "[.]R$"), method = "radix"))
c_files <- file.path("src", sort(list.files(file.path(sources, "src"), "^(rot|ffi)_.*[.][ch]$"),
  method = "radix"))
r_code <- lapply(stats::setNames(r_files, r_files), function(file) {
  parse(file.path(sources, file), keep.source = FALSE, encoding = "UTF-8")
})
includers <- includers_of(file.path(sources, "src"))
# Of headers, those that few files include.
few <- 4L
included <- lengths(includers[basename(c_files)])
c_files <- c_files[endsWith(c_files, ".c") | included %in% seq_len(few)]
makevars <- readLines(file.path(sources, "src", "Makevars"))
link_flags <- sub("^PKG_LIBS *= *", "", grep("^PKG_LIBS", makevars, value = TRUE))
link_flags <- gsub("\\$\\(SHLIB_OPENMP_CFLAGS\\)", "-fopenmp", link_flags)
gsl_flags <- sub("^PKG_CPPFLAGS *= *", "", grep("^PKG_CPPFLAGS", makevars, value = TRUE))

files <- grep(pattern, c(r_files, c_files), value = TRUE)
files <- files[lengths(lapply(files, tests_of)) > 0L]
equivalent <- read_listed("tools/mutants-equivalent.txt")
fixed <- if (Sys.getenv("MUTANTS_FIXED", "yes") == "no") list() else
  read_listed(Sys.getenv("MUTANTS_LIST", "tools/mutants-fixed.txt"))
fixed <- Filter(function(listed) grepl(pattern, listed$file), fixed)

# Draws: each file once in a random order, then again; the kind of change among those that the file
# has places for, then the place. A few further candidates where a change turns out to be none.
suppressWarnings(RNGversion("4.0.0"))
set.seed(seed)
draws <- list()
while (length(draws) < number && length(files)) {
  for (file in sample(files)) {
    places <- places_of(file.path(sources, file))
    if (!length(places$edits)) next
    kinds <- vapply(places$edits, `[[`, "", "kind")
    one <- function() {
      kind <- sample(rep(unique(kinds), 2L), 1L)
      among <- which(kinds == kind)
      edit <- places$edits[[among[sample.int(length(among), 1L)]]]
      place(file, edit$kind, places$whole, edit$from, edit$to, edit$new)
    }
    candidates <- lapply(1:6, function(i) one())
    is_equivalent <- vapply(candidates, function(m) {
      any(vapply(equivalent, function(e) {
        e$file == m$file && e$before == m$before && e$after == m$after
      }, NA))
    }, NA)
    if (is_equivalent[1L]) {
      cat("equivalent:", file, "line", candidates[[1L]]$line, "\n")
    }
    candidates <- candidates[!is_equivalent]
    if (length(candidates)) draws <- c(draws, list(candidates))
    if (length(draws) == number) break
  }
}
listed <- lapply(fixed, apply_listed)
lost <- fixed[vapply(listed, is.null, NA)]
items <- c(lapply(listed[!vapply(listed, is.null, NA)], list), draws)

# Packages that tests load, here once.
for (package in c("ggplot2", "dplyr", "tibble", "rlang", "cli", "xml2", "units", "yyjsonr", "DBI",
  "RSQLite", "deSolve")) {
  suppressWarnings(requireNamespace(package, quietly = TRUE))
}
invisible(lapply(seq_len(jobs), make_slot))

# The tests without a change: they must pass, and their processor time sets the limits.
needed <- unique(unlist(lapply(items, function(candidates) {
  lapply(candidates, function(mutant) tests_of(mutant$file))
})))
limits <- list()
broken <- character()
in_processes(
  as.list(needed),
  function(test, slot) {
    folder <- slot_folder(slot)
    before <- sum(proc.time()[-3L])
    done <- run_all(folder, test, r_code, NULL, library_path)
    c(done, list(cpu_s = sum(proc.time()[-3L]) - before))
  },
  function(test) 1800,
  function(index, result) {
    if (is.null(result) || result$status != "survived") {
      broken <<- c(broken, paste(needed[index], result$by))
    } else {
      limits[[needed[index]]] <<- 10 + 10 * result$cpu_s
    }
  }
)
if (length(broken)) {
  writeLines(c("These tests fail without a change, and are left out:", broken))
}

killed <- survived <- none <- 0L
report <- function(mutant) {
  cat(sprintf(
    "%s, line %d (%s)\n%s\n- %s\n+ %s\n\n", if (mutant$status == "killed") "killed" else "SURVIVED",
    mutant$line, mutant$kind, mutant$file, mutant$before, mutant$after
  ))
}
by_kind <- list()
in_processes(
  items, function(candidates, slot) run_mutant(candidates, slot, limits),
  function(candidates) {
    60 + 2 * sum(unlist(limits[tests_of(candidates[[1L]]$file)]))
  },
  function(index, result) {
    # A process that died or ran out of time is a change that was noticed.
    if (is.null(result)) result <- c(items[[index]][[1L]], list(status = "killed", by = "process"))
    if (result$status == "none") {
      none <<- none + 1L
      return()
    }
    kind <- result$kind
    by_kind[[kind]] <<- (if (is.null(by_kind[[kind]])) c(0L, 0L) else by_kind[[kind]]) +
      c(result$status == "killed", 1L)
    if (result$status == "killed") killed <<- killed + 1L else survived <<- survived + 1L
    if (result$status != "killed" || Sys.getenv("MUTANTS_SHOW") == "all") {
      report(result)
      if (result$status == "killed") cat("by", substr(result$by, 1L, 200L), "\n\n")
    }
  }
)
for (l in lost) {
  cat(sprintf("SURVIVED: the place of a fixed change is gone\n%s\n- %s\n\n", l$file, l$before))
  survived <- survived + 1L
}
for (kind in sort(names(by_kind))) {
  cat(sprintf("%-10s %d of %d\n", kind, by_kind[[kind]][1L], by_kind[[kind]][2L]))
}
if (none) cat(none, "files without a place that changes anything\n")
share <- killed / max(1L, killed + survived)
cat(sprintf(
  "mutants: %d killed of %d (%.1f %%), seed %d, %d fixed\n", killed, killed + survived,
  100 * share, seed, length(fixed)
))
quit(status = as.integer(share < least_killed || killed + survived == 0L || length(broken) > 0L))
