# JSON: our own text, which is the same for the same values, and the reader of a package.
#
# Values: NULL, numbers, one string or several, TRUE and FALSE; a list with names is an object, one
# without is an array, and so is a vector, unless it has length 1; a matrix is an array of its rows.

# `indent` blanks for each level; 0 for the canonical text: keys sorted by bytes, no blanks.
json_text <- function(x, indent = 0L) {
  if (indent) json_lines(x, indent, 0L) else json_canonical(x)
}

json_canonical <- function(x) .Call(ffi_text_json, x, ",")

# What has no list in it stands on one line.
json_lines <- function(x, indent, level) {
  if (!is.list(x)) return(.Call(ffi_text_json, x, ", "))
  if (!length(x)) return(json_canonical(x))
  parts <- vapply(x, json_lines, "", indent, level + 1L)
  if (!is.null(names(x))) parts <- paste0(json_string(names(x)), ": ", parts)
  ends <- if (is.null(names(x))) c("[", "]") else c("{", "}")
  flat <- !any(vapply(x, is.list, NA)) && sum(nchar(parts) + 2L) + level * indent < 90L
  if (flat && level > 0L) return(paste0(ends[1], paste(parts, collapse = ", "), ends[2]))
  pad <- function(n) strrep(" ", n * indent)
  paste0(
    ends[1], "\n", paste0(pad(level + 1L), parts, collapse = ",\n"), "\n", pad(level), ends[2]
  )
}

json_string <- function(x) .Call(ffi_text_strings, x)

# The values of a text. Faults are errors of the class `kind`; `what` the text is of.
read_json <- function(text, what, kind, call) {
  need_package("yyjsonr", "Reading JSON", call)
  damaged <- function(why) {
    abort_rotdyn(c("The text is no {what}.", x = "{why}"), kind, call)
  }
  if (!isTRUE(validUTF8(text))) damaged("It is not valid UTF-8.")
  # The reader calls itself for each level, and cuts strings at a zero.
  outside <- gsub("\"(?:[^\"\\\\]|\\\\.)*+\"", "", text, perl = TRUE)
  open <- utf8ToInt(gsub("[^][{}]", "", outside))
  if (length(open) && max(cumsum(ifelse(open %in% utf8ToInt("[{"), 1L, -1L))) > 100L) {
    damaged("It has more than 100 levels.")
  }
  if (grepl("\\u0000", text, fixed = TRUE)) damaged("A string in it has the character 0.")
  why <- NULL
  # It prints where it failed.
  utils::capture.output(x <- tryCatch(
    yyjsonr::read_json_str(text, opts = yyjsonr::opts_read_json(
      obj_of_arrs_to_df = FALSE, arr_of_objs_to_df = FALSE, arr_of_arrs_to_matrix = FALSE,
      length1_array_asis = TRUE, str_specials = "string", num_specials = "string",
      int64 = "double"
    )),
    error = function(e) why <<- sub("^Error parsing JSON ", "", trimws(conditionMessage(e)))
  ))
  if (!is.null(why)) damaged(why)
  x <- plain_json(x)
  twice <- repeated_key(x)
  if (length(twice)) damaged(paste0("\"", twice[1], "\" is in it twice."))
  x
}

# Numbers are doubles; "Inf", "-Inf" and "NaN" among numbers are numbers; rows of one length are a
# matrix.
plain_json <- function(x) {
  if (is.null(x)) return(NULL)
  if (is.integer(x) || is.double(x)) return(as.double(x))
  if (!is.list(x)) return(as.vector(unclass(x)))
  row <- lengths(x) > 1L | vapply(x, inherits, NA, "AsIs") # arrays of one are AsIs
  x <- lapply(x, plain_json)
  if (!is.null(names(x)) || !length(x)) return(x)
  number <- vapply(x, is.double, NA)
  special <- vapply(x, is_special_number, NA)
  if (!all(number | special) || !any(number) || length(unique(lengths(x))) > 1L) return(x)
  x <- lapply(x, as.double)
  if (all(row)) do.call(rbind, x) else unlist(x)
}

special_numbers <- c("Inf", "-Inf", "NaN")

is_special_number <- function(x) is.character(x) && length(x) > 0L && all(x %in% special_numbers)

repeated_key <- function(x) {
  if (!is.list(x)) return(NULL)
  c(names(x)[duplicated(names(x))], unlist(lapply(x, repeated_key)))
}

# XXH128 of the bytes of a text.
hash_text <- function(text) .Call(ffi_hash, list(charToRaw(enc2utf8(text))))
