# What can go wrong with the files of a sweep: nothing torn has a final name, what is damaged is
# found, and the next run ends with the same rows.

skip_if_not_installed("nanoparquet")
skip_if_not_installed("yyjsonr")

plan <- small_plan(2)
digest <- sweep_digest(sweep_run(plan))
# One chunk.
single <- small_plan(1)

# ---- a writer that fails ------------------------------------------------------------------------

# Calls of these functions are counted while the option is there, and fail at 0: before they do
# anything, or after all that they do.
faulty <- list(
  c("put_parquet", "rotdyn"), c("seal_file", "rotdyn"), c("hash_of_end", "rotdyn"),
  c("put_whole", "rotdyn"),
  c("check_still_there", "rotdyn"), c("canary_of", "rotdyn"), c("own_folder", "rotdyn"),
  c("file.rename", "base"), c("dir.create", "base"), c("read_parquet_info", "nanoparquet")
)
fail_next <- function() {
  left <- getOption("rotdyn_fault")
  if (is.null(left)) return(invisible())
  options(rotdyn_fault = left - 1)
  if (left == 1) stop("a fault")
}
with_faults <- function(code) {
  where <- function(one) if (one[2] == "base") baseenv() else asNamespace(one[2])
  on.exit({
    options(rotdyn_fault = NULL)
    for (one in faulty) suppressMessages(untrace(one[1], where = where(one)))
  })
  tracer <- bquote(.(fail_next)())
  for (one in faulty) {
    suppressMessages(trace(one[1], tracer, exit = tracer, print = FALSE, where = where(one)))
  }
  force(code)
}

test_that("a fault before or after any call of a writer leaves nothing torn", {
  skip_on_cran()
  faults <- 0
  wrong <- character()
  with_faults(for (k in seq(1, 1000, or_long(3, 1))) {
    folder <- tempfile("sweep-")
    options(rotdyn_fault = k)
    found <- tryCatch(sweep_run(plan, folder), error = identity)
    done <- getOption("rotdyn_fault") > 0
    options(rotdyn_fault = NULL)
    faults <- faults + inherits(found, "error")
    said <- fault_of_folder(folder, plan)
    again <- tryCatch(sweep_digest(sweep_run(plan, folder)), error = conditionMessage)
    if (nzchar(said) || again != digest) wrong <- c(wrong, paste(k, said, again))
    unlink(folder, recursive = TRUE)
    if (done) break
  })
  expect_identical(wrong, character())
  expect_gt(faults, or_long(15, 45))
})

# Bytes that a process may write to a file: a limit that it can raise again. What is beyond fails in
# the middle of a file, at a byte.
test_that("a file that ends in the middle of its bytes never gets its name", {
  skip_on_cran()
  skip_if(!nzchar(Sys.which("prlimit")), "no limit can be changed here")
  folder <- sweep_folder()
  sweep_run(plan, folder)
  sizes <- file.size(c(
    file.path(folder, "run.json"), rows_file(folder, 1:2), sums_file(folder, 1:2)
  ))
  set.seed(4)
  limits <- c(0, 1, sizes - 1, sizes, floor(stats::runif(or_long(8, 200), 0, max(sizes))))
  result <- tempfile()
  on.exit(unlink(result), add = TRUE)
  process <- start_process(before = "trap '' XFSZ;", plan = list(plan, limits), c(
    "limits <- plan[[2]]; plan <- plan[[1]]",
    "limit <- function(n) {",
    "  said <- system2('prlimit', c('--pid', Sys.getpid(), paste0('--fsize=', n, ':unlimited')))",
    "  if (said != 0) stop('no limit')",
    "}",
    "found <- lapply(limits, function(n) {",
    "  folder <- tempfile('sweep-', dirname(tempdir()))",
    "  limit(format(n, scientific = FALSE))",
    "  got <- tryCatch({ sweep_run(plan, folder); 'whole' }, error = function(e) class(e)[1])",
    "  limit('unlimited')",
    "  c(folder, got)",
    "})", sprintf("saveRDS(found, %s)", deparse(result))
  ))
  expect_true(wait_until(has_said(process, ended)))
  expect_identical(words_of(process), "ended ")
  found <- readRDS(result)
  for (i in seq_along(limits)) {
    at <- found[[i]][1]
    label <- paste("limit", limits[i])
    expect_identical(
      found[[i]][2], if (limits[i] < max(sizes)) "rotdyn_error_file" else "whole", label = label
    )
    expect_identical(fault_of_folder(at, plan), "", label = label)
    expect_identical(sweep_digest(sweep_run(plan, at)), digest, label = label)
    unlink(at, recursive = TRUE)
  }
})

test_that("a full disk is an error, and the sweep goes on when there is room", {
  on_tiny_disk("256k", function(disk) {
    folder <- file.path(disk, "sweep")
    wrong <- character()
    # Pages of 4 KiB that are left.
    for (left in or_long(c(0, 1, 2, 4, 5, 7, 9, 14), 0:20)) {
      fill_disk(disk)
      filled <- file.path(disk, "fill")
      bytes <- file.size(filled) - 4096 * left
      # Cut: so many bytes are free again.
      system2("truncate", c("-s", format(bytes, scientific = FALSE), shQuote(filled)))
      found <- tryCatch(sweep_run(plan, folder), error = identity)
      if (!inherits(found, c("rotdyn_error_file", "rot_sweep"))) wrong <- c(wrong, class(found)[1])
      wrong <- c(wrong, fault_of_folder(folder, plan))
      unlink(filled)
      wrong <- c(wrong, if (sweep_digest(sweep_run(plan, folder)) != digest) paste("left", left))
      unlink(folder, recursive = TRUE)
    }
    expect_identical(setdiff(wrong, ""), character())
  })
})

test_that("a plan that needs more than half of the free space is refused, with what takes less", {
  huge <- sweep_plan(
    scene_axle(0.1, 0.2), 3, design_random(2^48, seed = 1, omega0_rad_per_s = vary_normal(1, 1))
  )
  skip_if(is.na(free_bytes(tempdir())), "the free space is not known here")
  folder <- sweep_folder()
  expect_error(sweep_run(huge, folder), "more than half.*summary", class = "rotdyn_error_file")
  expect_false(dir.exists(folder))
  expect_error(sweep_run(huge), "summary", class = "rotdyn_error_memory")
})

test_that("what stands in the way of a folder or a part is named", {
  folder <- sweep_folder()
  writeLines("x", folder)
  expect_error(sweep_run(plan, folder), "is a file", class = "rotdyn_error_file")
  expect_error(sweep_status(folder), "is a file", class = "rotdyn_error_file")
  expect_error(sweep_run(plan, file.path(folder, "a")), "cannot be made",
               class = "rotdyn_error_file")
  expect_error(sweep_resume(tempfile("none")), "no such folder", class = "rotdyn_error_file")
  unlink(folder)
  sweep_create(plan, folder)
  for (kind in c("work", "rows", "sums")) {
    unlink(file.path(folder, kind), recursive = TRUE)
    writeLines("x", file.path(folder, kind))
    expect_error(sweep_resume(folder), "sweep_resume", class = "rotdyn_error_file")
    unlink(file.path(folder, kind))
    dir.create(file.path(folder, kind))
  }
  # A folder with the name of a part.
  dir.create(file.path(rows_file(folder, 2), "a"), recursive = TRUE)
  expect_error(sweep_resume(folder), "take its name", class = "rotdyn_error_file")
  expect_identical(sweep_todo(folder), 2)
  unlink(rows_file(folder, 2), recursive = TRUE)
  expect_whole_folder(folder, plan, digest)
})

test_that("a folder in which nothing can be written is read, when it is done", {
  folder <- sweep_folder()
  sweep_run(plan, folder)
  Sys.chmod(c(folder, file.path(folder, c("rows", "sums", "work"))), "555")
  on.exit(Sys.chmod(c(folder, file.path(folder, c("rows", "sums", "work"))), "755"), add = TRUE,
          after = FALSE)
  expect_identical(sweep_digest(sweep_resume(folder)), digest)
  expect_identical(nrow(sweep_check(folder)), 0L)
  skip_if(file.access(folder, 2L) == 0L, "this user writes everywhere")
  Sys.chmod(file.path(folder, "sums"), "755")
  unlink(sums_file(folder, 1))
  expect_error(sweep_resume(folder), class = "rotdyn_error_file")
})

# ---- a folder that changes during a run ---------------------------------------------------------

# Scenes of a function that does something in a row of the second chunk.
meddling_plan <- function(n = 300) {
  plan <- sweep_plan(NULL, 3, design_list(data.frame(m = seq_len(n) / 100)), chunk_rows = 256,
    build = function(row) {
      if (row$m == 2.8) getOption("rotdyn_meddle", identity)(1)
      scene_axle(row$m, 0.2)
    }, outputs = "final_theta_rad"
  )
  plan$row_s <- 1e-6
  plan
}
meddling <- function(what, code) {
  options(rotdyn_meddle = function(x) {
    # Not where the canary has this row.
    names <- vapply(sys.calls(), function(one) deparse(one[[1]])[1], "")
    if ("commit_chunk" %in% names) what()
  })
  on.exit(options(rotdyn_meddle = NULL))
  force(code)
}

test_that("a folder that vanishes, or becomes that of another sweep, gets no part of this one", {
  built <- meddling_plan()
  wanted <- sweep_digest(sweep_run(built))
  error <- function(what, words) {
    meddling(what, expect_error(sweep_run(built, folder), words, class = "rotdyn_error_file"))
  }
  folder <- sweep_folder()
  sweep_create(built, folder)
  error(function() unlink(folder, recursive = TRUE), "was removed")
  expect_false(file.exists(folder))
  expect_whole_folder(folder, built, wanted)
  # run.json alone: what is done is taken over.
  unlink(sums_file(folder, 2))
  before <- file.mtime(sums_file(folder, 1))
  error(function() unlink(file.path(folder, "run.json")), "was removed")
  expect_identical(dir(file.path(folder, "sums")), part_name(1))
  expect_whole_folder(folder, built, wanted)
  expect_identical(file.mtime(sums_file(folder, 1)), before)
  # By another sweep: it is not touched.
  unlink(sums_file(folder, 2))
  other <- sweep_folder()
  sweep_create(plan, other)
  error(function() file.copy(file.path(other, "run.json"), folder, overwrite = TRUE), "replaced")
  expect_identical(dir(file.path(folder, "sums")), part_name(1))
  expect_whole_folder(folder, plan, digest)
  # With parts of another sweep and no run.json, it is not taken.
  unlink(file.path(folder, "run.json"))
  expect_error(sweep_run(built, folder), "not empty", class = "rotdyn_error_file")
  expect_whole_folder(folder, plan, digest)
})

# ---- damaged parts ------------------------------------------------------------------------------

test_that("parts cut at any length, empty, missing or too long are computed again", {
  folder <- sweep_folder()
  wanted <- sweep_digest(sweep_run(single, folder))
  set.seed(3)
  wrong <- character()
  for (path in c(rows_file(folder, 1), sums_file(folder, 1))) {
    bytes <- all_bytes_of(path)
    n <- length(bytes)
    lengths <- c(NA, 0, 1, 4, 8, n %/% 2, n - c(1, 4, 8, 9), sample(n - 1, or_long(4, 300)), n + 5)
    for (m in lengths) {
      unlink(path)
      if (!is.na(m)) writeBin(c(bytes, raw(5))[seq_len(m)], path)
      read <- tryCatch(sweep_read(folder), error = function(e) class(e)[1])
      fine <- identical(sweep_todo(folder), 1) && identical(read, "rotdyn_error_file") &&
        identical(sweep_check(folder, chunks = 0)$chunk, 1) &&
        identical(sweep_digest(sweep_resume(folder)), wanted) &&
        identical(all_bytes_of(path), bytes)
      if (!fine) wrong <- c(wrong, paste(path, m))
    }
  }
  expect_identical(wrong, character())
})

test_that("parts of another chunk, or of another sweep, are computed again", {
  folder <- sweep_folder()
  other <- sweep_folder()
  four <- small_plan(4)
  wanted <- sweep_digest(sweep_run(four, folder))
  sweep_run(small_plan(4, seed = 9), other)
  copy <- function(from, to) file.copy(from, to, overwrite = TRUE)
  for (file in list(rows_file, sums_file)) {
    copy(file(folder, 1), file(folder, 3))
    copy(file(other, 2), file(folder, 2))
    expect_identical(sweep_todo(folder), c(2, 3))
    expect_identical(sweep_check(folder, chunks = 0)$chunk, c(2, 3))
    expect_error(sweep_read(folder), "2 of 4", class = "rotdyn_error_file")
    expect_whole_folder(folder, four, wanted)
  }
  copy(rows_file(folder, 1), rows_file(folder, 3))
  copy(sums_file(folder, 1), sums_file(folder, 3))
  expect_match(sweep_check(folder, chunks = 0)$fault, "another chunk")
  copy(rows_file(other, 3), rows_file(folder, 3))
  copy(sums_file(other, 3), sums_file(folder, 3))
  expect_match(sweep_check(folder, chunks = 0)$fault, "another sweep")
  expect_whole_folder(folder, four, wanted)
  # Names that no chunk has are left alone.
  copy(sums_file(folder, 1), sums_file(folder, 99))
  copy(sums_file(folder, 1), file.path(folder, "sums", "part-1.parquet"))
  expect_identical(sweep_todo(folder), double())
  expect_identical(sweep_digest(folder), wanted)
})

test_that("any bit that changes is found by sweep_check(), and gives no wrong number", {
  folder <- sweep_folder()
  memory <- sweep_run(single, folder)
  set.seed(5)
  wrong <- character()
  for (path in c(rows_file(folder, 1), sums_file(folder, 1), file.path(folder, "run.json"))) {
    bytes <- all_bytes_of(path)
    of_run <- basename(path) == "run.json"
    # The end has what is said about the columns.
    n <- length(bytes)
    at <- c(1, 4, n, sample(n, min(n, or_long(9, 1500))), n - sample(1000, or_long(9, 500)))
    for (i in at) {
      bit <- sample(0:7, 1)
      flipped <- bytes
      flipped[i] <- xor(flipped[i], as.raw(2^bit))
      writeBin(flipped, path)
      found <- tryCatch(sweep_check(folder, chunks = 0)$chunk, error = function(e) class(e)[1])
      read <- tryCatch(sweep_read(folder), error = function(e) class(e)[1])
      known <- identical(found, if (of_run) "rotdyn_error_file" else 1)
      # The canary of run.json counts where something is computed.
      of_canary <- of_run && identical(found, double()) &&
        inherits(tryCatch(sweep_chunk(folder, 1), error = identity), "rotdyn_error_canary")
      right <- identical(read, "rotdyn_error_file") || identical(bits_of(read), bits_of(memory)) &&
        identical(sweep_digest(read), sweep_digest(memory))
      if (!(known || of_canary) || !right) wrong <- c(wrong, paste(basename(path), i, bit))
    }
    writeBin(bytes, path)
  }
  expect_identical(wrong, character())
  expect_identical(nrow(sweep_check(folder)), 0L)
})

test_that("a bit changed far from the end of a large part is found when it is read", {
  large <- sweep_plan(
    scene_axle(0.1, 0.2), 3, design_random(2^16, seed = 1, omega0_rad_per_s = vary_normal(1, 1))
  )
  folder <- sweep_folder()
  wanted <- sweep_digest(sweep_run(large, folder))
  path <- rows_file(folder, 1)
  bytes <- all_bytes_of(path)
  bytes[1e5] <- xor(bytes[1e5], as.raw(1))
  writeBin(bytes, path)
  # The sums know nothing of it.
  expect_identical(sweep_digest(folder), wanted)
  expect_error(sweep_read(folder), "sweep_chunk", class = "rotdyn_error_file")
  expect_match(sweep_check(folder, chunks = 0)$fault, "rows are damaged")
  sweep_chunk(folder, 1)
  expect_whole_folder(folder, large, wanted)
})

# ---- what the folder says of the sweep ----------------------------------------------------------

test_that("run.json is as it was written, or refused", {
  folder <- sweep_folder()
  sweep_run(plan, folder)
  path <- file.path(folder, "run.json")
  text <- readLines(path)
  refused <- function(words = NULL) {
    for (use in list(sweep_resume, sweep_status, sweep_digest)) {
      expect_error(use(folder), words, class = "rotdyn_error_file")
    }
    expect_error(sweep_run(plan, folder), words, class = "rotdyn_error_file")
    expect_error(sweep_scene(folder, 1), words, class = "rotdyn_error_file")
  }
  for (change in list(
    c("\"chunk_rows\": 256", "\"chunk_rows\": 512"), c("[400]", "[401]"), c("\"m\"", "\"s\""),
    c("\"rad\"", "\"deg\""), c("  \"rows\"", "  \"raws\"")
  )) {
    changed <- sub(change[1], change[2], text, fixed = TRUE)
    if (identical(changed, text)) next
    writeLines(changed, path)
    refused("is damaged")
  }
  for (half in list("", text[1:20], "{}", "[]", "3", "{\"sweep_format\": 2}", "\\")) {
    writeLines(half, path)
    refused()
  }
  writeBin(as.raw(c(123, 0, 125)), path)
  refused("zero byte")
  # Ends of lines of another system are no damage.
  con <- file(path, "wb")
  writeLines(text, con, sep = "\r\n")
  close(con)
  expect_identical(sweep_digest(folder), digest)
  # Removed: it is written again.
  unlink(path)
  expect_whole_folder(folder, plan, digest)
})

test_that("plans of every kind are read as they were written", {
  wheel <- scene_axle(body_disk(2, 0.25), omega0_rad_per_s = 20)
  both <- c("body$mass_kg", "omega0_rad_per_s")
  r <- matrix(c(1, 0.5, 0.5, 1), 2, dimnames = list(both, both))
  laws <- list("body$mass_kg" = vary_uniform(1, 2), omega0_rad_per_s = vary_normal(1, 5))
  list_of <- function(...) design_list(data.frame(..., check.names = FALSE))
  plans <- list(
    sweep_plan(wheel, 4, design_grid(theta0_rad = c(-0, 1), omega0_rad_per_s = c(0, -0, 3))),
    sweep_plan(wheel, 4, list_of(theta0_rad = -0)),
    sweep_plan(wheel, 4, list_of(a = Inf), derive = list(omega0_rad_per_s = ~ 1 / a)),
    sweep_plan(wheel, 4, list_of(a = c(Inf, -Inf)), derive = list(omega0_rad_per_s = ~ 1 / a)),
    sweep_plan(wheel, 4, list_of(a = c(Inf, 1)), derive = list(omega0_rad_per_s = ~ 1 / a)),
    sweep_plan(wheel, 4, design_random(9, seed = 2^53,
      omega0_rad_per_s = vary_values(c(1, 5, -0), c(1, 2, 3)), theta0_rad = vary_values(3))),
    sweep_plan(wheel, c(1, 4), correlate(do.call(design_sobol, c(9, laws, seed = 2^53 - 1)), r),
      keep = ~ omega0_rad_per_s > 0),
    sweep_plan(wheel, 4, do.call(design_saltelli, c(4, laws, seed = 0)), keep = "summary",
      derive = list(theta0_rad = ~ omega0_rad_per_s^2 - 1e-300), accuracy = 1e-3),
    sweep_plan(wheel, 4, do.call(design_latin, c(1, laws, seed = 7)))
  )
  for (one in plans) {
    folder <- sweep_folder()
    in_memory <- sweep_run(one)
    expect_identical(sweep_digest(sweep_run(one, folder)), sweep_digest(in_memory))
    kept <- read_plan(folder, NULL)
    expect_identical(plan_hash(kept), kept$hash)
    unlink(sums_file(folder, 1))
    again <- sweep_resume(folder)
    expect_identical(bits_of(again), bits_of(in_memory))
    expect_identical(1 / again$row, 1 / in_memory$row)
  }
})

test_that("a sweep of a scene with R functions goes on in its folder", {
  pushed <- function(k, body = 0.1) {
    law <- function(time_s) 0.2 + 0 * time_s
    sweep_plan(
      scene_axle(body, law, omega0_rad_per_s = k), 3,
      design_list(data.frame(body = 1:20 / 100))
    )
  }
  one <- pushed(1)
  folder <- sweep_folder()
  in_memory <- sweep_run(one)
  expect_identical(sweep_digest(sweep_run(one, folder)), sweep_digest(in_memory))
  unlink(sums_file(folder, 1))
  expect_error(sweep_resume(folder), "trust", class = "rotdyn_error_folder")
  expect_identical(sweep_digest(sweep_resume(folder, trust = TRUE)), sweep_digest(in_memory))
  expect_whole_folder(folder, one, sweep_digest(in_memory))
  read <- sweep_read(folder)
  expect_error(sweep_audit(read), "trust", class = "rotdyn_error_folder")
  expect_identical(sweep_audit(read, 2, trust = TRUE)$verdict, rep("balanced", 2))
  again <- trajectory(sweep_scene(folder, 7, trust = TRUE), c(0, 3))
  expect_identical(again$theta_rad[2], in_memory$final_theta_rad[7])
  # Numbers beside the functions make another sweep.
  expect_error(sweep_run(pushed(2), folder), class = "rotdyn_error_folder")
  # Its functions cut, flipped or gone.
  path <- file.path(folder, "functions.rds")
  bytes <- all_bytes_of(path)
  for (change in list(
    function() writeBin(bytes[1:50], path), function() unlink(path),
    function() writeBin(replace(bytes, 300, xor(bytes[300], as.raw(1))), path),
    function() writeBin(serialize(list(node = 3), NULL), path)
  )) {
    change()
    expect_error(sweep_resume(folder, trust = TRUE), "functions.rds", class = "rotdyn_error_file")
  }
})

test_that("an R function that uses what is in the workspace alone gets no folder", {
  folder <- sweep_folder()
  assign("rotdyn_slope", 0.2, globalenv())
  on.exit(rm("rotdyn_slope", envir = globalenv()), add = TRUE)
  law <- function(time_s) rotdyn_slope + 0 * time_s
  plan_of_law <- function(law) {
    sweep_plan(scene_axle(0.1, law), 3, design_list(data.frame(body = 1:3)))
  }
  for (env in list(globalenv(), new.env(parent = globalenv()))) {
    environment(law) <- env
    plan <- plan_of_law(law)
    # In this session it is there.
    expect_identical(sweep_run(plan)$status, rep("ok", 3))
    expect_error(sweep_run(plan, folder), "rotdyn_slope", class = "rotdyn_error_value")
    expect_false(dir.exists(folder))
  }
  environment(law) <- list2env(list(rotdyn_slope = 0.2), parent = globalenv())
  expect_identical(sweep_digest(sweep_run(plan_of_law(law), folder)),
                   sweep_digest(sweep_run(plan_of_law(law))))
  helper <- function(x) rotdyn_slope * x
  environment(helper) <- globalenv()
  built <- sweep_plan(NULL, 3, design_list(data.frame(m = 1:2)), given = list(f = helper),
    build = function(row) scene_axle(row$m, f(1)))
  expect_error(sweep_create(built, tempfile()), "rotdyn_slope", class = "rotdyn_error_value")
})

test_that("what is given to a function that builds scenes is a part of the sweep", {
  built <- function(k, f = sin) {
    sweep_plan(NULL, 3, design_list(data.frame(m = 1:2)), outputs = "final_theta_rad",
      build = function(row) scene_axle(row$m, 0 * f(k)), given = list(k = k, f = f))
  }
  folder <- sweep_folder()
  sweep_run(built(3), folder)
  expect_error(sweep_run(built(4), folder), "given to them", class = "rotdyn_error_folder")
  expect_error(sweep_run(built(3, function(x) 2 * x), folder), class = "rotdyn_error_folder")
  expect_error(sweep_run(built("3"), folder), class = "rotdyn_error")
  expect_s3_class(sweep_run(built(3), folder), "rot_sweep")
})

test_that("without the reader of parts nothing is read, and nothing removed", {
  skip_on_cran()
  skip_on_os("windows")
  folder <- sweep_folder()
  sweep_run(plan, folder)
  library <- tempfile("library")
  dir.create(library)
  on.exit(unlink(library, recursive = TRUE), add = TRUE)
  for (path in .libPaths()) {
    for (package in setdiff(dir(path), c("nanoparquet", dir(library)))) {
      file.symlink(file.path(path, package), file.path(library, package))
    }
  }
  lines <- c(
    sprintf("for (use in list(sweep_resume, sweep_todo, sweep_read, sweep_check, sweep_digest)) {"),
    sprintf("  said(tryCatch(use(%s), error = function(e) class(e)[1]))", deparse(folder)), "}"
  )
  process <- start_process(lines, plan, paste0(
    "R_LIBS=", shQuote(library), " R_LIBS_SITE=", shQuote(library), " R_LIBS_USER=",
    shQuote(library), " R_ENVIRON=/dev/null R_ENVIRON_USER=/dev/null;",
    " export R_LIBS R_LIBS_SITE R_LIBS_USER R_ENVIRON R_ENVIRON_USER;"
  ), alone = library)
  expect_true(wait_until(has_said(process, ended)))
  expect_identical(
    words_of(process), paste(c(rep("rotdyn_error_package ", 5), "ended "), collapse = "\n")
  )
  expect_identical(sweep_todo(folder), double())
  expect_identical(sweep_digest(folder), digest)
})
