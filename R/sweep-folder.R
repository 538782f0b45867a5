# The folder of a sweep: run.json says what it is, rows/ and sums/ have a part for each chunk, work/
# has files that are being written. A chunk is done when its parts are there and whole: there is no
# list.

sweep_format <- 1

# ---- run.json -----------------------------------------------------------------------------------

# What determines the result, as a list that JSON text and back leaves as it is.
plan_record <- function(plan) {
  list(
    sweep_format = sweep_format, scene = if (is_plain(plan)) plan$node,
    code = plan$code %||% if (!is_plain(plan)) "functions.rds", time_s = as.list(plan$time_s),
    design = design_record(plan$design),
    derived = lapply(plan$derived, `[[`, "text"), outputs = as.list(plan$outputs),
    model = plan$model, asked = plan$asked, accuracy = plan$accuracy, max_steps = plan$max_steps,
    kind = plan$kind, keep = plan$keep, condition = plan$condition$text,
    audit_rows = plan$audit_rows, shift = as.list(plan$shift), block_rows = plan$block_rows,
    group_rows = plan$group_rows, rows = plan$n
  )
}

# Without R functions.
is_plain <- function(plan) is.null(plan$build) && !has_functions(plan$node)

design_record <- function(design) {
  inputs <- lapply(design$inputs, function(law) lapply(unclass(law), as_list_of_many))
  design <- unclass(design)
  design$inputs <- inputs
  if (!is.null(design$correlation)) {
    design$correlation <- list(
      inputs = as.list(design$correlation$inputs), matrix = as.list(c(design$correlation$matrix))
    )
  }
  design
}

# A vector of one number and the number itself are the same text.
as_list_of_many <- function(x) if (length(x) == 1L) x else as.list(x)

design_of_record <- function(x) {
  x$inputs <- lapply(x$inputs, function(law) {
    law <- lapply(law, function(part) if (is.list(part)) unlist(part) else part)
    # Infinite numbers alone are read as text.
    numbers <- setdiff(names(law), c("kind", "unit"))
    structure(replace(law, numbers, lapply(law[numbers], as.double)), class = "rot_vary")
  })
  if (!is.null(x$correlation)) {
    names <- as.character(unlist(x$correlation$inputs))
    x$correlation <- list(
      inputs = names, matrix = matrix(as.double(unlist(x$correlation$matrix)), length(names))
    )
  }
  structure(x, class = "rot_design")
}

# The hash of what determines the result.
plan_hash <- function(plan) {
  code <- if (!is_plain(plan)) list(code = code_text(plan))
  hash_text(json_text(c(plan_record(plan), code)))
}

# R functions as text, for the hash: their bodies and arguments; and all that is beside them, which
# no text in run.json says.
code_text <- function(plan) {
  text <- function(x) {
    if (is.function(x)) return(paste(deparse(args(x)), deparse(body(x)), collapse = "\n"))
    if (is.list(x)) return(c(names(x), class(x), unlist(lapply(unname(unclass(x)), text))))
    if (!is.atomic(x) && !is.language(x)) return(class(x))
    deparse(x, control = c("keepNA", "keepInteger", "niceNames", "showAttributes", "hexNumeric"))
  }
  paste(text(list(plan$build, plan$given, plan$node)), collapse = "\n")
}

make_sweep_folder <- function(plan, folder, call) {
  need_package("nanoparquet", "A sweep in a folder", call)
  need_package("yyjsonr", "A sweep in a folder", call)
  if (file.exists(file.path(folder, "run.json"))) {
    kept <- read_plan(folder, call)
    compare_plans(plan, kept, folder, call)
    return(kept)
  }
  check_session_variables(plan, call)
  plan$hash <- plan_hash(plan)
  check_free_folder(plan, folder, call)
  check_disk(plan, folder, call)
  for (path in c(folder, file.path(folder, c("rows", "sums", "work")))) {
    if (!dir.exists(path) && !suppressWarnings(dir.create(path, recursive = TRUE))) {
      abort_rotdyn(c(
        "The folder {.file {path}} cannot be made.",
        i = "Is a part of its path a file? May you write there?"
      ), "file", call)
    }
  }
  plan$canary <- canary_of(plan, call)
  code_hash <- NULL
  if (!is_plain(plan)) {
    code <- serialize(plan[c("node", "build", "given")], NULL, version = 3L)
    code_hash <- .Call(ffi_hash, list(code))
    write_file(code, file.path(folder, "functions.rds"), call)
  }
  record <- c(plan_record(plan), list(
    hash = plan$hash, canary = plan$canary, chunk_rows = plan$chunk_rows, row_s = plan$row_s,
    version = as.character(utils::packageVersion("rotdyn")), made = format(Sys.time(), tz = "UTC"),
    columns = lapply(stats::setNames(seq_along(plan$outputs), plan$outputs), function(i) {
      plan$output_unit[i]
    }), statuses = as.list(row_statuses()), code_hash = code_hash, check = ""
  ))
  text <- json_text(record, 2L)
  with_hash <- paste0("\"check\": \"", record_hash(text), "\"")
  text <- sub("\"check\": \"\"", with_hash, text, fixed = TRUE)
  # Last: a folder with it is whole.
  write_file(text, file.path(folder, "run.json"), call)
  plan
}

# Of the text of run.json, without this hash and without the canary, which shows a change itself.
record_hash <- function(text) {
  hash_text(gsub("\"(canary|check)\": \"[^\"]*\"|\r|\n+$", "", text))
}

# New, empty, or what is left of the making of this very sweep.
check_free_folder <- function(plan, folder, call) {
  if (file.exists(folder) && !dir.exists(folder)) {
    abort_rotdyn(c(
      "{.file {folder}} is a file, and no folder.", i = "Name another one."
    ), "file", call)
  }
  found <- dir(folder, all.files = TRUE, no.. = TRUE)
  own <- found %in% c("rows", "sums", "work", "functions.rds", "owner.json") |
    startsWith(found, ".rotdyn-")
  parts <- dir(file.path(folder, c("rows", "sums")))
  foreign <- vapply(dir(file.path(folder, "sums"), full.names = TRUE), function(path) {
    about <- sealed_about(path)
    !is.null(about) && about$run != plan$hash
  }, NA)
  if (all(own) && length(chunk_of_part(parts)) == length(parts) && !any(foreign)) return()
  abort_rotdyn(c(
    "The folder {.file {folder}} is not empty, and has no sweep.", i = "Name another one."
  ), "file", call)
}

# The plan of a folder. `trust`: its R functions may be run.
read_plan <- function(folder, call, trust = FALSE) {
  check_file_name(folder, call, "folder", "folder")
  path <- file.path(folder, "run.json")
  if (!file.exists(path)) {
    why <- if (!file.exists(folder)) "There is no such folder." else
      if (!dir.exists(folder)) "It is a file."
    abort_rotdyn(
      c("The folder {.file {folder}} has no sweep: there is no {.file run.json}.", x = why), "file",
      call
    )
  }
  damaged <- function(why, parent = NULL) {
    abort_rotdyn(c(
      "{.file {path}} is damaged{why}.",
      i = "Remove this file and call {.fn sweep_run} with the same plan: what is done is kept."
    ), "file", call, parent = parent)
  }
  text <- tryCatch(file_text(path), error = function(e) NA, warning = function(w) NA)
  if (is.na(text)) damaged(": it has a zero byte, or cannot be read")
  x <- read_json(text, "sweep", "file", call)
  if (!is.list(x) || is.null(names(x))) damaged("")
  if (!identical(x$sweep_format, sweep_format)) {
    abort_rotdyn(c(
      "The sweep has an unknown format.", x = "It is {describe_value(x$sweep_format)}."
    ), "file", call)
  }
  if (!identical(x$check, record_hash(text))) damaged(": it is not as it was written")
  plan <- tryCatch(plan_of_record(x), error = function(e) NULL)
  if (is.null(plan)) damaged("")
  if (is.null(plan$code)) return(plan)
  plan$untrusted <- !trust
  if (trust) plan_with_code(plan, folder, call) else plan
}

# With the R functions of the folder, and what follows from the scene that has them.
plan_with_code <- function(plan, folder, call) {
  path <- file.path(folder, plan$code)
  code <- tryCatch(suppressWarnings({
    bytes <- readBin(path, "raw", file.size(path))
    if (identical(.Call(ffi_hash, list(bytes)), plan$code_hash)) unserialize(bytes)
  }), error = identity)
  kept <- c("node", "build", "given")
  if (is.list(code) && !inherits(code, "error")) plan[kept] <- code[kept]
  if (!identical(plan_hash(plan), plan$hash)) {
    abort_rotdyn(c(
      "{.file {path}} is missing or damaged.",
      i = "{.fn sweep_run} with the same plan needs no such file: copy it from another folder."
    ), "file", call, parent = if (inherits(code, "error")) code)
  }
  if (!is.null(plan$node)) {
    plan$known <- inputs_that_vary(plan$node)
    plan <- plan_bound(plan, call)
  }
  plan
}

plan_of_record <- function(x) {
  texts <- function(x) as.character(unlist(x))
  numbers <- function(x) as.double(unlist(x))
  plan <- list(
    design = design_of_record(x$design), n = x$rows, time_s = numbers(x$time_s),
    accuracy = x$accuracy, audit_rows = x$audit_rows, max_steps = x$max_steps, kind = x$kind,
    model = x$model, asked = isTRUE(x$asked), keep = x$keep, outputs = texts(x$outputs),
    output_unit = texts(x$columns), shift = numbers(x$shift), block_rows = x$block_rows,
    group_rows = x$group_rows, chunk_rows = x$chunk_rows, row_s = x$row_s, hash = x$hash,
    canary = x$canary, version = x$version, made = x$made, code = x$code,
    code_hash = x$code_hash
  )
  call <- current_env()
  check_design(plan$design, "design", call)
  if (!is.null(x$scene)) {
    scene <- x$scene
    at <- setdiff(names(scene), "scene_format")[1]
    plan$node <- node_of_json(scene, call)
    plan$known <- inputs_that_vary(plan$node)
    plan$constraint <- constraint_of_maker(at)
  }
  plan <- plan_derived(plan, if (length(x$derived)) x$derived, call)
  plan <- if (is.null(plan$node)) {
    plan$inputs <- character()
    plan$bound <- double()
    plan
  } else {
    plan_bound(plan, call)
  }
  if (!is.null(x$condition)) {
    plan$condition <- derived_input(x$condition, c(all_inputs(plan), plan$outputs), "keep", call)
  }
  structure(plan, class = "rot_sweep_plan")
}

# The scene that the text makes, as a node: numbers and arrays as write_scene() has them.
node_of_json <- function(x, call) {
  x$scene_format <- NULL
  scene_node(read_node(x, text_readers(), "the scene", call), call)
}

constraint_of_maker <- function(maker) {
  found <- Filter(function(one) {
    maker %in% c(names(one$texts), unlist(lapply(one$makers, function(m) names(m$texts))))
  }, all_constraints())
  found[[1]]$id
}

# The first field in which a plan differs from that of a folder.
compare_plans <- function(plan, kept, folder, call) {
  if (identical(plan_hash(plan), kept$hash)) return()
  a <- plan_record(plan)
  b <- plan_record(kept)
  names <- union(names(a), names(b))
  differs <- names[!vapply(names, function(name) {
    identical(json_text(list(a[[name]])), json_text(list(b[[name]])))
  }, NA)]
  abort_rotdyn(c(
    "The folder {.file {folder}} has another sweep.",
    x = if (length(differs)) "It differs in {.field {differs}}." else
      "Its R functions, or the numbers given to them, are others.",
    i = "Name another folder, or go on with that one: {.code sweep_resume(\"{folder}\")}."
  ), "folder", call)
}

# ---- room ---------------------------------------------------------------------------------------

check_disk <- function(plan, folder, call) {
  if (plan$keep != "rows") return()
  wanted <- plan$n * row_bytes(plan)
  free <- free_bytes(folder)
  if (is.na(free) || wanted <= free / 2) return()
  abort_rotdyn(c(
    "The rows take more than half of the free space of {.file {folder}}.",
    x = "{prefixed(wanted, 'B')} of {prefixed(free, 'B')}.",
    i = "{.code keep = \"summary\"} takes some MB; {.code keep = ~ condition} the rows for which it
         holds."
  ), "file", call)
}

# Of the file system of a folder, or of the one that it will be in; NA where it is not known.
free_bytes <- function(folder) {
  folder <- normalizePath(folder, mustWork = FALSE)
  while (!dir.exists(folder) && dirname(folder) != folder) folder <- dirname(folder)
  if (!nzchar(Sys.which("df"))) return(NA_real_)
  said <- tryCatch(
    suppressWarnings(system2("df", c("-Pk", shQuote(folder)), stdout = TRUE, stderr = FALSE)),
    error = function(e) character()
  )
  # Names before and behind these numbers may have blanks.
  pattern <- "^.* [0-9]+ +[0-9]+ +([0-9]+) +[0-9]+% .*$"
  line <- grep(pattern, said, value = TRUE)
  if (length(line)) as.double(sub(pattern, "\\1", line[1])) * 1024 else NA_real_
}

# ---- parts --------------------------------------------------------------------------------------

part_name <- function(chunk) sprintf("part-%08.0f.parquet", chunk)

chunk_of_part <- function(names) {
  as.double(sub("^part-([0-9]{8,16})[.]parquet$", "\\1",
                grep("^part-[0-9]{8,16}[.]parquet$", names, value = TRUE)))
}

chunk_range <- function(plan, chunk) {
  first <- (chunk - 1) * plan$chunk_rows + 1
  c(first, min(plan$chunk_rows, plan$n - first + 1))
}

# Plain: a dictionary takes 0 and -0 for one value.
put_parquet <- function(x, path, metadata) {
  nanoparquet::write_parquet(
    x, path, compression = "uncompressed", encoding = "PLAIN", metadata = metadata,
    options = nanoparquet::parquet_options(
      num_rows_per_row_group = 2^17, write_arrow_metadata = FALSE
    )
  )
}

# Damaged files may end R in their reader: nothing is read by it before a hash of all bytes is found
# right. That of rows is in the sums. The sums have their own, the seal, among their metadata: of
# the file with zeros in its place.
seal_mark <- "xxh128:"
open_seal <- paste0(seal_mark, strrep("0", 32L))

# The pair of a sums file with what it says of its chunk, a JSON object without others in it.
about_key <- "rotdyn_about"

# NULL, or list(bytes, at, found, wanted): the file's, the place of the seal, what stands there, and
# what should.
seal_of <- function(path) {
  bytes <- readBin(path, "raw", file.size(path))
  at <- grepRaw(seal_mark, bytes, fixed = TRUE, all = TRUE) + nchar(seal_mark)
  if (length(at) != 1L || at + 31L > length(bytes)) return(NULL)
  digits <- at + 0:31
  found <- bytes[digits]
  bytes[digits] <- charToRaw("0")
  list(bytes = bytes, at = at, found = found, wanted = charToRaw(.Call(ffi_hash, list(bytes))))
}

seal_file <- function(path) {
  seal <- seal_of(path)
  con <- file(path, "r+b")
  on.exit(close(con))
  seek(con, seal$at - 1, rw = "write")
  writeBin(seal$wanted, con)
}

# What a sums file says of its chunk, a list of texts; NULL where the seal is broken. Its bytes are
# at hand: nanoparquet::read_parquet_metadata() takes 3.3 ms of the 4.1 that a part would take.
sealed_about <- function(path) {
  tryCatch(suppressWarnings({
    seal <- seal_of(path)
    if (!is.null(seal) && identical(seal$found, seal$wanted)) {
      key <- grepRaw(about_key, seal$bytes, fixed = TRUE)
      from <- grepRaw("{", seal$bytes, fixed = TRUE, offset = key)
      to <- grepRaw("}", seal$bytes, fixed = TRUE, offset = from)
      yyjsonr::read_json_str(rawToChar(seal$bytes[from:to]))
    }
  }), error = function(e) NULL)
}

# Writes a table under a temporary name, reads its footer back, and gives it its name. Nothing is
# left of what fails. => list(size, hash, end): bytes, hash of the file, hash of its end.
write_part <- function(x, folder, kind, chunk, metadata, call, sealed = FALSE) {
  work <- file.path(folder, "work", paste0(
    kind, "-", part_name(chunk), "-", Sys.info()[["nodename"]], "-", process_tag(), "-",
    basename(tempfile(""))
  ))
  on.exit(unlink(work))
  written <- NULL
  fault <- tryCatch(
    suppressWarnings({
      put_parquet(x, work, c(metadata, if (sealed) c(rotdyn_seal = open_seal)))
      if (sealed) seal_file(work)
      read <- nanoparquet::read_parquet_info(work)
      written <- list(
        size = file.size(work), hash = rlang::hash_file(work), end = hash_of_end(work)
      )
      whole <- read$num_rows == nrow(x) && (!sealed || !is.null(sealed_about(work)))
      if (whole) "" else "It was not written whole."
    }),
    error = function(e) conditionMessage(e)
  )
  if (nzchar(fault)) abort_unwritten_part(file.path(folder, kind), fault, call)
  to <- file.path(folder, kind, part_name(chunk))
  if (!suppressWarnings(file.rename(work, to))) {
    abort_unwritten_part(to, "It cannot take its name.", call)
  }
  written
}

# The last 64 KiB have the metadata, and so the number of the chunk: a file of another chunk or run
# is recognised without reading all of it.
hash_of_end <- function(path) {
  con <- file(path, "rb")
  on.exit(close(con))
  size <- file.size(path)
  seek(con, max(0, size - 2^16))
  .Call(ffi_hash, list(readBin(con, "raw", 2^16)))
}

abort_unwritten_part <- function(path, fault, call) {
  abort_rotdyn(c(
    "{.file {path}} cannot be written.", x = braces_doubled(fault),
    i = "What is committed stays: {.fn sweep_resume} goes on when there is room."
  ), "file", call)
}

columns_hash <- function(x) .Call(ffi_hash, lapply(unname(as.list(x)), identity))

# Computes a chunk and commits it. A receipt: chunk, rows, kept, bytes, seconds, failed.
commit_chunk <- function(plan, folder, chunk, threads, progress, call) {
  start <- proc.time()[[3L]]
  range <- chunk_range(plan, chunk)
  found <- chunk_of_sweep(plan, range[1], range[2], threads, progress, call)
  check_still_there(plan, folder, call)
  number <- function(x) format(x, scientific = FALSE, digits = 17)
  kept <- length(found$row)
  file <- list(size = 0, hash = "", end = "")
  rows_hash <- ""
  if (plan$keep != "summary") {
    rows <- rows_table(plan, found)
    rows$status <- found$status
    rows_hash <- columns_hash(rows)
    file <- write_part(rows, folder, "rows", chunk, c(
      rotdyn_run = plan$hash, rotdyn_chunk = number(chunk),
      rotdyn_units = json_text(as.list(stats::setNames(plan$output_unit, plan$outputs)))
    ), call)
  }
  sums <- as.data.frame(found$sums)
  about <- list(
    run = plan$hash, chunk = number(chunk), rows_kept = number(kept),
    rows_bytes = number(file$size), rows_hash = rows_hash, rows_file = file$hash,
    rows_end = file$end, checksum = checksum_text(found$checksum)
  )
  write_part(
    sums, folder, "sums", chunk, stats::setNames(json_text(about), about_key), call, sealed = TRUE
  )
  list(
    chunk = chunk, rows = range[2], kept = kept, bytes = file$size,
    seconds = proc.time()[[3L]] - start
  )
}

# A folder that was removed, or given to another sweep, during the run gets no part of this one.
check_still_there <- function(plan, folder, call) {
  path <- file.path(folder, "run.json")
  text <- tryCatch(file_text(path), error = function(e) NA, warning = function(w) NA)
  own <- paste0("\"hash\": \"", plan$hash, "\"")
  if (!is.na(text) && grepl(own, text, fixed = TRUE)) return()
  abort_rotdyn(c(
    "{.file {path}} is no longer that of this sweep: it was {if (is.na(text)) 'removed' else
     'replaced'} during the run.",
    i = "{.fn sweep_run} with the same plan goes on, in this folder or in another one."
  ), "file", call)
}

# The sums of a committed chunk: list(sums, checksum, kept, about); or list(fault), in words.
look_at_part <- function(plan, folder, chunk) {
  path <- file.path(folder, "sums", part_name(chunk))
  if (!file.exists(path)) return(list(fault = "not done"))
  about <- sealed_about(path)
  if (is.null(about)) return(list(fault = "its sums are damaged"))
  sums <- tryCatch(as.list(nanoparquet::read_parquet(path)), error = function(e) NULL)
  if (is.null(sums)) return(list(fault = "its sums cannot be read"))
  if (about$run != plan$hash) return(list(fault = "its sums are of another sweep"))
  if (as.double(about$chunk) != chunk) return(list(fault = "its sums are of another chunk"))
  if (plan$keep != "summary") {
    rows <- file.path(folder, "rows", part_name(chunk))
    if (!file.exists(rows)) return(list(fault = "its rows are missing"))
    if (!identical(file.size(rows), as.double(about$rows_bytes))) {
      return(list(fault = "its rows are cut, or of another chunk"))
    }
    end <- tryCatch(hash_of_end(rows), error = function(e) "")
    if (end != about$rows_end) {
      return(list(fault = "its rows are damaged, or of another chunk"))
    }
  }
  list(
    sums = sums, checksum = checksum_of_text(about$checksum),
    kept = as.double(about$rows_kept), about = about
  )
}

# NULL where its parts are missing, cut, damaged or of another run or chunk.
read_sums_part <- function(plan, folder, chunk) {
  part <- look_at_part(plan, folder, chunk)
  if (is.null(part$fault)) part
}

# The rows kept of a chunk, as they were written; NULL where they were not.
read_rows_part <- function(folder, chunk, about) {
  path <- file.path(folder, "rows", part_name(chunk))
  file <- tryCatch(rlang::hash_file(path), error = function(e) "")
  if (file != about$rows_file) return(NULL)
  rows <- tryCatch(as.data.frame(nanoparquet::read_parquet(path)), error = function(e) NULL)
  if (!is.null(rows) && columns_hash(rows) == about$rows_hash) rows
}

# Chunks that are done: their part of sums/ can be used, and so can that of rows/, where the plan
# has rows.
done_chunks <- function(plan, folder) {
  chunks <- chunk_of_part(dir(file.path(folder, "sums")))
  chunks <- sort(chunks[chunks >= 1 & chunks <= n_chunks(plan)])
  chunks[vapply(chunks, function(chunk) !is.null(read_sums_part(plan, folder, chunk)), NA)]
}

# Chunks to compute: all others. Parts that cannot be used stay until the new ones take their names.
# Nothing is removed on the word of a reader that may have failed itself.
chunks_to_do <- function(plan, folder) {
  setdiff(as.double(seq_len(n_chunks(plan))), done_chunks(plan, folder))
}

# ---- the canary ---------------------------------------------------------------------------------

# The checksum of 256 rows spread over the design: another version, compiler or C library that
# changes a bit of one of them is found before anything is written.
canary_of <- function(plan, call) {
  plan$keep <- "summary"
  first <- unique(floor(seq(1, max(1, plan$n - 15), length.out = 16)))
  sums <- lapply(first, function(i) {
    chunk_of_sweep(plan, i, min(16, plan$n - i + 1), call = call, summed = FALSE)$checksum
  })
  checksum_text(add_checksums(sums))
}

check_canary <- function(plan, folder, call) {
  if (identical(canary_of(plan, call), plan$canary)) return()
  abort_rotdyn(c(
    "This machine computes other bits than the one that made {.file {folder}}.",
    x = "Here it is version {utils::packageVersion('rotdyn')} on {Sys.info()[['nodename']]}; the
         sweep was made by version {plan$version}.",
    i = "A sweep goes on with the same version, compiler and C library."
  ), "canary", call)
}
