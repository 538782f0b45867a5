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
# The tests run first without a change: they must pass, and which functions of R/ each block calls
# is recorded. A change of a function then runs the blocks of its topic that call it, cheap files
# first; a change of src/glue those that call its functions.
#
# Environment: MUTANTS_JOBS (processes at a time, 2), MUTANTS_FILES (a regular expression: files to
# draw from), MUTANTS_FIXED=no (without the fixed ones), MUTANTS_LIST (another file of fixed ones),
# MUTANTS_SHOW=all (what was noticed, and by which test), MUTANTS_CALLS (a file that keeps the
# record of calls for the next run; a test is recorded again where it or R code it calls changed).

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

# Tests of whatever the package has: those of their blocks run that call the changed function.
general <- c("signatures", "pictures", "print-table", "wrong-arguments")
general_core <- "api/figures"

# Paths of the programs and files that test `file`, in their order.
tests_of <- function(file) {
  topic <- sub("^(R|src/core|src/glue)/(.*)[.][Rch]$", "\\2", file)
  # Of a header, those of the file that it belongs to.
  listed <- topics[[if (is.null(topics[[file]])) sub("[.]h$", ".c", file) else file]]
  core <- startsWith(file, "src/core/")
  first <- if (core) listed[cumsum(listed == "+") == 0L] else setdiff(listed, "+")
  after <- if (core) listed[cumsum(listed == "+") > 0L & listed != "+"]
  name <- function(kind, topics) {
    if (!length(topics)) return(character())
    path <- if (kind == "core") paste0("core/", sub("([^/]*)$", "test_\\1.c", topics))
            else sprintf("testthat/test-%s.R", topics)
    path[file.exists(file.path(tests, path))]
  }
  kind <- if (core) "core" else "testthat"
  unique(c(
    name(kind, c(topic, first, if (core) general_core)), if (core) name("testthat", after),
    if (startsWith(file, "R/")) name("testthat", general)
  ))
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

# The blocks of a test file that run, by number; all where `wanted` is NULL. begin() and end() are
# called around each.
test_environment <- function(wanted, begin = function() NULL, end = function() NULL) {
  env <- new.env(parent = asNamespace("rotdyn"))
  number <- 0L
  env$test_that <- function(desc, code) {
    number <<- number + 1L
    if (!is.null(wanted) && !number %in% wanted) return(invisible())
    begin()
    eval(as.call(list(testthat::test_that, desc, substitute(code))), parent.frame())
    end()
  }
  env
}

# NULL, or what failed first.
run_test_file <- function(file, cpu_s, env = test_environment(NULL)) {
  # Blocks that do not run would lose their snapshots.
  snapshots <- file.path("_snaps", sub("^test-(.*)[.]R$", "\\1.md", file))
  kept <- file.path(tests, "testthat", snapshots)
  if (file.exists(kept)) file.copy(kept, snapshots, overwrite = TRUE)
  withRestarts(
    {
      setTimeLimit(cpu = cpu_s)
      on.exit(setTimeLimit())
      said <- tryCatch({
        utils::capture.output(suppressWarnings(suppressMessages(test_file(
          file, package = "rotdyn", load_package = "installed", env = env,
          reporter = first_failure$new(), stop_on_failure = FALSE
        ))))
        NULL
      }, error = function(e) paste("error:", conditionMessage(e)))
      said
    },
    mutant_killed = function(said) said
  )
}

# ---- which functions a block of a test calls ----------------------------------------------------

hits <- new.env()

# The code of a file of R/ in which every function first records its lines in `hits`.
recorded_code <- function(file) {
  walk <- function(node) {
    if (!is.call(node)) return(node)
    if (identical(node[[1L]], quote(`function`))) {
      at <- as.integer(node[[4L]])
      name <- sprintf("%s:%d:%d", file, at[1L], at[3L])
      return(as.call(list(node[[1L]], as.pairlist(walk_all(node[[2L]])), call(
        "{", as.call(list(base::assign, name, TRUE, envir = hits)), walk(node[[3L]])
      ), NULL)))
    }
    walk_all(node)
  }
  walk_all <- function(parts) {
    for (i in seq_along(parts)) {
      if (is.call(parts[[i]])) parts[[i]] <- walk(parts[[i]])
    }
    parts
  }
  code <- parse(file.path(sources, file), keep.source = TRUE, encoding = "UTF-8")
  as.expression(lapply(code, walk))
}

# Functions called by each block of a test file and outside of them, and its processor time in s.
record_calls <- function(file) {
  now <- function() sum(proc.time()[-3L])
  seen <- function() {
    names <- ls(hits, all.names = TRUE)
    rm(list = names, envir = hits)
    names
  }
  outside <- character()
  blocks <- list()
  began <- 0
  env <- test_environment(
    NULL,
    function() {
      outside <<- union(outside, seen())
      began <<- now()
    },
    function() blocks[[length(blocks) + 1L]] <<- list(calls = seen(), cpu_s = now() - began)
  )
  begun <- now()
  said <- run_test_file(file, 900, env)
  list(said = said, outside = union(outside, seen()), blocks = blocks, cpu_s = now() - begun)
}

# Functions around a line of a file: the innermost, and those that begin or end in it.
functions_at <- function(file, line) {
  lines <- function_lines[[file]]
  around <- lines[lines$from <= line & lines$to >= line, ]
  around <- around[order(around$to - around$from), ]
  inside <- which(around$from < line & around$to > line)
  if (length(inside)) around <- around[seq_len(inside[1L]), ]
  around$name
}

# Blocks of `test` that a change can reach: their numbers, and their processor time with that of the
# code outside of blocks. `names`: functions of R/, NULL: any.
blocks_of <- function(test, names) {
  known <- calls[[test]]
  costs <- vapply(known$blocks, `[[`, 0, "cpu_s")
  # A block that calls nothing looks at the functions themselves.
  wanted <- if (is.null(names) || any(names %in% known$outside)) seq_along(costs) else
    which(vapply(known$blocks, function(block) {
      !length(block$calls) || any(names %in% block$calls)
    }, NA))
  list(
    wanted = wanted, cpu_s = sum(costs[wanted]) + max(0, known$cpu_s - sum(costs)),
    limit_s = 10 + 5 * (sum(costs[wanted]) + max(0, known$cpu_s - sum(costs)))
  )
}

# What runs for a mutant: paths of tests with `wanted` and `limit_s`, core programs first, then the
# cheap files. Files without a block that calls the function are left out.
plan_of <- function(mutant) {
  paths <- intersect(tests_of(mutant$file), names(calls))
  names <- functions_of(mutant)
  plan <- lapply(paths, function(test) {
    all <- !length(names) || names_entry(test, mutant$file)
    c(list(test = test), blocks_of(test, if (!all) names))
  })
  core <- startsWith(paths, "core/")
  c(plan[core], cheap_first(plan[!core]), other_topics(mutant, names))
}

# Functions of R/ that a change concerns; none: all, as of code outside of functions.
functions_of <- function(mutant) {
  if (startsWith(mutant$file, "R/")) return(functions_at(mutant$file, mutant$line))
  if (startsWith(mutant$file, "src/glue/")) callers_of(mutant$file)
}

cheap_first <- function(plan) {
  plan <- plan[lengths(lapply(plan, `[[`, "wanted")) > 0L]
  plan[order(vapply(plan, `[[`, 0, "cpu_s"))]
}

# What runs where the topic's own tests notice nothing: the blocks of other topics that call the
# function, the cheap ones first, up to a minute of processor time.
other_topics <- function(mutant, names) {
  if (!length(names)) return(list())
  tests <- setdiff(grep("^testthat/", names(calls), value = TRUE), tests_of(mutant$file))
  tests <- Filter(function(test) {
    any(names %in% c(calls[[test]]$outside, unlist(lapply(calls[[test]]$blocks, `[[`, "calls"))))
  }, tests)
  plan <- cheap_first(lapply(tests, function(test) {
    c(list(test = test, other = TRUE), blocks_of(test, names))
  }))
  plan[cumsum(vapply(plan, `[[`, 0, "cpu_s")) <= 60]
}

# The entries of a file of src/glue.
entries_of <- function(file) {
  lines <- readLines(file.path(sources, file))
  regmatches(lines, regexpr("(?<=^SEXP )ffi_[a-z_0-9]+(?=\\()", lines, perl = TRUE))
}

# Whether a test calls one of them itself.
names_entry <- function(test, file) {
  if (!startsWith(file, "src/glue/") || startsWith(test, "core/")) return(FALSE)
  text <- paste(readLines(file.path(tests, test), encoding = "UTF-8"), collapse = "\n")
  any(vapply(entries_of(file), function(entry) {
    grepl(paste0(":::", entry, "\\b"), text)
  }, NA))
}

# Functions of R/ that call one of a file of src/glue.
callers_of <- function(file) {
  defined <- entries_of(file)
  found <- lapply(r_files, function(r) {
    text <- readLines(file.path(sources, r), encoding = "UTF-8")
    at <- which(vapply(regmatches(text, gregexpr("ffi_[a-z_0-9]+", text)), function(words) {
      any(words %in% defined)
    }, NA))
    unlist(lapply(at, function(line) functions_at(r, line)))
  })
  unique(unlist(found))
}

# All code of R/ anew, with the functions of one file changed: lists of functions and functions made
# by functions are made anew, too.
replace_code <- function(code) {
  space <- asNamespace("rotdyn")
  # The namespace takes no new names, as `names(x) <- ...` needs for a moment.
  fresh <- new.env(parent = space)
  defines <- function(expression) is.call(expression) && identical(expression[[1L]], quote(`<-`))
  for (file in code) for (expression in file) if (defines(expression)) eval(expression, fresh)
  for (name in intersect(ls(fresh, all.names = TRUE), ls(space, all.names = TRUE))) {
    value <- fresh[[name]]
    # What did not change stays: it is compiled.
    if (is.function(value) && identical(environment(space[[name]]), space) &&
        identical(value, space[[name]], ignore.bytecode = TRUE, ignore.environment = TRUE)) next
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
# Not in R's own temporary folder, which a process that crashes removes for all others.
scratch <- file.path(dirname(tempdir()), paste0("mutants", Sys.getpid()))
slot_folder <- function(slot) file.path(scratch, paste0("slot", slot))
make_slot <- function(slot) {
  folder <- slot_folder(slot)
  dir.create(file.path(folder, "library", "rotdyn"), recursive = TRUE)
  file.copy(tests, folder, recursive = TRUE)
  file.copy(file.path(sources, c("src", "inst")), folder, recursive = TRUE, copy.date = TRUE)
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
    "sh -c 'cd %s && R CMD SHLIB -o rotdyn.so init.c'", shQuote(file.path(folder, "src"))
  ), 600)
}

# The files that are compiled anew where `file` changes.
compiled_with <- function(file) {
  below <- sub("^src/", "", file)
  if (endsWith(file, ".c")) below else includers[[below]]
}

# The program of a core test, linked with the objects of the slot. Status 0: linked.
link_core <- function(folder, test) {
  name <- gsub("/", "-", sub("[.]c$", "", test))
  object <- file.path(folder, paste0(name, ".o"))
  # One that was compiled before a header changed, or changed back, is not the test's.
  headers <- list.files(
    file.path(folder, "src", "core"), "[.]h$", full.names = TRUE, recursive = TRUE
  )
  if (!file.exists(object) || any(file.mtime(headers) >= file.mtime(object))) {
    status <- quietly(sprintf(
      "cc -std=c99 -O1 -I%s -I%s %s -c %s -o %s", file.path(folder, "src", "core"),
      file.path(folder, "tests", "core"), gsl_flags, file.path(folder, "tests", test), object
    ), 600)
    if (status != 0L) return(status)
  }
  quietly(sprintf(
    "cc %s %s %s -lm -lpthread -o %s", object,
    paste(list.files(
      file.path(folder, "src", "core"), "[.]o$", full.names = TRUE, recursive = TRUE
    ), collapse = " "),
    link_flags, file.path(folder, name)
  ), 600)
}

run_core <- function(folder, test, cpu_s) {
  status <- link_core(folder, test)
  if (status != 0L) return("does not link")
  status <- quietly(file.path(folder, gsub("/", "-", sub("[.]c$", "", test))), cpu_s)
  if (status == 0L) NULL else paste("status", status)
}

# The package with other code in folder/tests: NULL, or what is wrong.
load_package <- function(folder, code, lib) {
  said <- tryCatch({
    library(rotdyn, lib.loc = lib)
    if (!is.null(code)) replace_code(code)
    NULL
  }, error = function(e) paste("does not load:", conditionMessage(e)))
  setwd(file.path(folder, "tests", "testthat"))
  said
}

# The parent ends a process whose processor time exceeds what its file in the slot says: C code does
# not look at R's own limit.
set_deadline <- function(folder, cpu_s) {
  writeLines(format(sum(proc.time()[1:2]) + cpu_s), file.path(folder, "deadline"))
}

# The tests of a change by its plan, the first that fails ends it.
run_all <- function(folder, plan, code, lib) {
  loaded <- FALSE
  for (part in plan) {
    test <- part$test
    set_deadline(folder, part$limit_s + 10)
    if (startsWith(test, "core/")) {
      said <- run_core(folder, test, part$limit_s)
    } else {
      if (!loaded) {
        said <- load_package(folder, code, lib)
        if (!is.null(said)) return(list(status = "killed", by = said))
        loaded <- TRUE
      }
      said <- run_test_file(basename(test), part$limit_s, test_environment(part$wanted))
    }
    if (!is.null(said)) {
      by <- paste0(test, ": ", said[1L])
      return(list(status = "killed", by = by, other = isTRUE(part$other)))
    }
  }
  list(status = "survived")
}

# The first of the candidates that is a change at all: it compiles, and to something else.
run_mutant <- function(candidates, slot) {
  folder <- slot_folder(slot)
  Sys.setenv(MAKEFLAGS = "")
  for (mutant in candidates) {
    plan <- plan_of(mutant)
    set_deadline(folder, 600)
    if (startsWith(mutant$file, "R/")) {
      changed <- tryCatch(parse(text = mutant$text, keep.source = FALSE), error = function(e) NULL)
      if (is.null(changed) || identical(as.list(changed), as.list(r_code[[mutant$file]]))) next
      code <- r_code
      code[[mutant$file]] <- changed
      done <- run_all(folder, plan, code, library_path)
    } else {
      path <- file.path(folder, mutant$file)
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
        done <- run_all(folder, plan, NULL, file.path(folder, "library"))
      }
      file.rename(saved, objects)
      file.rename(original, path)
      if (status != 0L || same) next
    }
    mutant$text <- NULL
    mutant$ran <- vapply(plan, function(part) {
      if (length(part$wanted)) sprintf("%s (%d)", part$test, length(part$wanted)) else part$test
    }, "")
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
# that exceeds its deadline of processor time or dies gives NULL. done(index, result) as they end.
in_processes <- function(items, work, done) {
  running <- list()
  next_item <- 1L
  while (next_item <= length(items) || length(running)) {
    while (next_item <= length(items) && length(running) < jobs) {
      slot <- setdiff(seq_len(jobs), vapply(running, function(r) r$slot, 1L))[1L]
      item <- items[[next_item]]
      set_deadline(slot_folder(slot), 1800)
      job <- parallel::mcparallel({
        tempdir(check = TRUE) # a new one, if it is gone
        work(item, slot)
      }, mc.set.seed = FALSE, silent = TRUE)
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
      if (age - r$looked > 3) {
        r$looked <- age
        limit <- as.numeric(readLines(file.path(slot_folder(r$slot), "deadline")))
        if (length(limit) && cpu_of(r$job$pid) > limit) {
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
  kept <- list.files(
    file.path(slot_folder(slot), "src"), "[.]kept$", full.names = TRUE, recursive = TRUE
  )
  file.rename(kept, sub("[.]kept$", "", kept))
}

# ---- the run ------------------------------------------------------------------------------------

r_files <- file.path("R", sort(list.files(file.path(sources, "R"), "[.]R$"), method = "radix"))
c_files <- file.path("src", sort(setdiff(
  list.files(file.path(sources, "src"), "[.][ch]$", recursive = TRUE), "init.c"
), method = "radix"))
r_code <- lapply(stats::setNames(r_files, r_files), function(file) {
  parse(file.path(sources, file), keep.source = FALSE, encoding = "UTF-8")
})
# Lines of every function, by file.
function_lines <- lapply(stats::setNames(r_files, r_files), function(file) {
  parsed <- parse(file.path(sources, file), keep.source = TRUE, encoding = "UTF-8")
  data <- utils::getParseData(parsed)
  heads <- data[data$token %in% c("FUNCTION", "'\\\\'"), ]
  own <- data[match(heads$parent, data$id), ]
  unique(data.frame(
    from = own$line1, to = own$line2, name = sprintf("%s:%d:%d", file, own$line1, own$line2)
  ))
})
includers <- includers_of(file.path(sources, "src"))
# Of headers, those that few files include.
few <- 4L
included <- lengths(includers[sub("^src/", "", c_files)])
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
# has places for, then the place. A few further candidates where a change turns out to be none. The
# order is that of hashes of what is drawn, so that a change of the sources leaves the draws from
# other places as they are.
first_by_hash <- function(n, key) order(vapply(seq_len(n), key, ""), method = "radix")[1L]
draws <- list()
pass <- 0L
while (length(draws) < number && length(files)) {
  pass <- pass + 1L
  for (file in files[order(vapply(files, function(f) rlang::hash(list(seed, pass, f)), ""),
                            method = "radix")]) {
    places <- places_of(file.path(sources, file))
    if (!length(places$edits)) next
    kinds <- vapply(places$edits, `[[`, "", "kind")
    one <- function(i) {
      known <- unique(kinds)
      kind <- known[first_by_hash(length(known), function(k) {
        rlang::hash(list(seed, pass, i, file, known[k]))
      })]
      among <- places$edits[kinds == kind]
      edit <- among[[first_by_hash(length(among), function(k) {
        e <- among[[k]]
        around <- substr(places$whole, max(1L, e$from - 40L), e$to + 40L)
        rlang::hash(list(seed, pass, i, around, e$new))
      })]]
      place(file, edit$kind, places$whole, edit$from, edit$to, edit$new)
    }
    candidates <- lapply(1:6, one)
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

# The tests without a change: they must pass; the functions that they call.
needed <- unique(unlist(lapply(items, function(candidates) {
  lapply(candidates, function(mutant) tests_of(mutant$file))
})))
kept_file <- Sys.getenv("MUTANTS_CALLS")
kept <- if (nzchar(kept_file) && file.exists(kept_file)) readRDS(kept_file) else list()
recorded_tests <- union(needed, names(kept))
recorded_tests <- recorded_tests[file.exists(file.path(tests, recorded_tests))]
sums <- tools::md5sum(c(file.path(sources, r_files), file.path(tests, recorded_tests)))
names(sums) <- c(r_files, recorded_tests)
calls <- Filter(function(known) {
  all(names(known$sums) %in% names(sums)) && identical(known$sums, sums[names(known$sums)])
}, kept)
needed <- setdiff(needed, names(calls))
recorded <- if (length(needed)) lapply(stats::setNames(r_files, r_files), recorded_code)
broken <- character()
in_processes(
  as.list(needed),
  function(test, slot) {
    folder <- slot_folder(slot)
    if (startsWith(test, "core/")) {
      said <- link_core(folder, test)
      before <- sum(proc.time()[-3L])
      if (said == 0L) said <- run_core(folder, test, 900)
      return(list(said = said, cpu_s = sum(proc.time()[-3L]) - before))
    }
    said <- load_package(folder, recorded, library_path)
    if (is.null(said)) record_calls(basename(test)) else list(said = said)
  },
  function(index, result) {
    test <- needed[index]
    if (is.null(result) || !is.null(result$said)) {
      broken <<- c(broken, paste(test, result$said[1L]))
      return()
    }
    files <- c(result$outside, unlist(lapply(result$blocks, `[[`, "calls")))
    result$sums <- sums[c(test, sort(unique(sub(":.*", "", files))))]
    calls[[test]] <<- result
    if (nzchar(kept_file)) {
      kept[[test]] <<- result
      saveRDS(kept, kept_file)
    }
  }
)
if (length(broken)) {
  writeLines(c("These tests fail without a change, and are left out:", broken))
  # Without most tests the rest says nothing.
  if (length(broken) > length(calls)) quit(status = 2L)
}

killed <- survived <- none <- others <- 0L
report <- function(mutant) {
  cat(sprintf(
    "%s, line %d (%s)\n%s\n- %s\n+ %s\n", if (mutant$status == "killed") "killed" else "SURVIVED",
    mutant$line, mutant$kind, mutant$file, mutant$before, mutant$after
  ))
  if (mutant$status == "killed") cat("by", substr(mutant$by, 1L, 200L), "\n\n")
  else cat("ran:", if (length(mutant$ran)) mutant$ran else "no test calls it", "\n\n")
  # Into a file each verdict at once: a run takes an hour.
  flush(stdout())
}
by_kind <- list()
in_processes(
  items, run_mutant,
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
    if (isTRUE(result$other)) {
      others <<- others + 1L
      cat(sprintf("by another topic: %s line %d, %s\n", result$file, result$line,
                  sub(": .*", "", result$by)))
    }
    if (result$status != "killed" || Sys.getenv("MUTANTS_SHOW") == "all") report(result)
  }
)
for (l in lost) {
  cat(sprintf("SURVIVED: the place of a fixed change is gone\n%s\n- %s\n\n", l$file, l$before))
  survived <- survived + 1L
}
for (kind in sort(names(by_kind))) {
  cat(sprintf("%-10s %d of %d\n", kind, by_kind[[kind]][1L], by_kind[[kind]][2L]))
}
if (others) cat(others, "noticed by tests of another topic alone\n")
if (none) cat(none, "files without a place that changes anything\n")
share <- killed / max(1L, killed + survived)
cat(sprintf(
  "mutants: %d killed of %d (%.1f %%), seed %d, %d fixed\n", killed, killed + survived,
  100 * share, seed, length(fixed)
))
unlink(scratch, recursive = TRUE)
quit(status = as.integer(share < least_killed || killed + survived == 0L || length(broken) > 0L))
