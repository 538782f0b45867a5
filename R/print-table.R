# Tables that functions return, printed so that no name is abbreviated: one row upright, with units;
# else the first columns that fit, and the names of the others.

# A tibble of the package, without loading tibble; `nrow = NULL`: as its first column; `...`:
# attributes.
new_table <- function(x, nrow = NULL, class = NULL, ...) {
  x <- unclass(x)
  n <- nrow %||% if (length(x)) NROW(x[[1L]]) else 0L
  if (is.null(names(x))) names(x) <- character(length(x))
  given <- list(
    ...,
    row.names = .set_row_names(as.integer(n)),
    class = c(class, "rot_table", "tbl_df", "tbl", "data.frame")
  )
  all <- attributes(x)
  all[names(given)] <- given
  attributes(x) <- all
  x
}

# `x`: `from` after `[` or a verb of dplyr. If its rows or `columns` changed, a plain table without
# `attribute`, of which the verbs of the class speak.
reconstruct_whole <- function(x, from, attribute, columns = names(from)) {
  if (!is.data.frame(x)) return(x)
  same <- nrow(x) == nrow(from) && all(columns %in% names(x)) &&
    all(vapply(columns, function(name) identical(x[[name]], from[[name]]), NA))
  attr(x, attribute) <- if (same) attr(from, attribute)
  class(x) <- if (same) class(from) else class(from)[-1L]
  x
}

# As tibble::tibble(), but that no column is made from another by its name.
as_table <- function(...) {
  columns <- Filter(Negate(is.null), list(...))
  sizes <- vapply(columns, NROW, 0L)
  n <- c(sizes[sizes != 1L], 1L)[1L]
  if (any(sizes != n & sizes != 1L)) stop("internal: columns of other lengths")
  if (n != 1L) columns[sizes == 1L] <- lapply(columns[sizes == 1L], rep_len, n)
  new_table(columns, n)
}

# A data frame or a list of columns as a table of the package.
table_from <- function(x, class = NULL) {
  x <- tibble::as_tibble(x)
  class(x) <- unique(c(class, "rot_table", class(x)))
  x
}

#' Print a table
#'
#' The tables of this package are tibbles. A table of one row is printed upright: name, value, unit.
#' Any other shows as many columns as fit with their whole names, and names the rest below: the
#' answers first, columns without a value last. A component of a vector, or a rotor of a shaft, that
#' is rounding noise beside the others is shown as 0.
#'
#' @param x A tibble of this package.
#' @param ...,n,width As of `print()` of a tibble; a `width` that is given has tibble's own print.
#' @return `x`, invisibly.
#' @source Wickham, tidy tools manifesto (2023), for the printing of tibbles.
#' @seealso [trajectory()], [metadata()] for units and meanings of columns.
#' @concept wide table
#' @examples
#' period_of(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1))
#' summary(spin_up())
#' @export
print.rot_table <- function(x, ..., n = NULL, width = NULL) {
  unnamed <- is.null(names(x)) || anyNA(names(x))
  if (!is.null(width) || !length(x) || unnamed) return(NextMethod())
  shown <- without_noise(x)
  if (is_upright(x)) {
    writeLines(upright_lines(shown))
    return(invisible(x))
  }
  writeLines(table_lines(shown, n, x))
  invisible(x)
}

# Motions and other tables with a head of their own, and lists of two columns with words, stay rows.
is_upright <- function(x) {
  long <- length(x) > 2L || length(x) == 2L && all(vapply(unclass(x), is.numeric, NA))
  nrow(x) == 1L && long && identical(names(tibble::tbl_sum(x)), "A tibble") &&
    all(vapply(unclass(x), is.atomic, NA))
}

#' @export
print.rot_trajectory <- print.rot_table

# The columns that a print of its own reads are there, with values of their kinds.
has_kinds <- function(x, kinds) {
  all(vapply(names(kinds), function(name) {
    value <- unclass(x)[[name]]
    switch(kinds[[name]],
      numeric = is.numeric(value), character = is.character(value), logical = is.logical(value),
      list = is.list(value)
    )
  }, NA))
}

# `first` names columns that are there.
first_that_are <- function(x) {
  first <- attr(x, "first", exact = TRUE)
  if (is.data.frame(x) && !all(first %in% names(x))) {
    left <- intersect(first, names(x))
    attr(x, "first") <- if (length(left)) left
  }
  x
}

#' @export
`[.rot_table` <- function(x, ...) first_that_are(NextMethod())

#' @exportS3Method dplyr::dplyr_reconstruct
dplyr_reconstruct.rot_table <- function(data, template) first_that_are(NextMethod())

# Columns in the order of a print: those that `first` names, the others, those without a value.
print_order <- function(x) {
  empty <- nrow(x) > 0L & vapply(unclass(x), function(value) {
    is.atomic(value) && all(is.na(value))
  }, NA)
  order(empty, !names(x) %in% attr(x, "first", exact = TRUE))
}

upright_lines <- function(x) {
  table <- column_table()
  columns <- unclass(x)[print_order(x)]
  x <- columns
  units <- table$unit[match(names(x), table$name)]
  # Columns that are arguments have theirs in the name.
  other <- is.na(units)
  units[other] <- unit_in_name(sub("_se$", "", names(x)[other]))
  units[units == "1" | vapply(x, is.na, NA)] <- ""
  values <- vapply(x, function(value) {
    if (is.double(value)) format(signif(as.double(value), 7), digits = 7) else
      escape_controls(format(value))
  }, "")
  width <- getOption("width")
  name <- formatC(names(x), width = -max(nchar(names(x))))
  lines <- trimws(paste0("  ", name, "  ", values, ifelse(nzchar(units), " ", ""), units), "right")
  long <- nchar(lines) > width
  lines[long] <- vapply(lines[long], function(line) {
    paste(strwrap(line, width, exdent = 4), collapse = "\n")
  }, "")
  c(paste0("# One row, ", length(x), " columns"), lines)
}

# Lines of as many columns as fit without abbreviated names. `of`: the object, for the head, since a
# motion with other values has no error figure.
table_lines <- function(x, n, of = x) {
  width <- getOption("width")
  in_order <- print_order(x)
  columns <- lapply(stats::setNames(in_order, names(x)[in_order]), function(i) .subset2(x, i))
  plain <- tibble::new_tibble(columns, nrow = nrow(x))
  listed <- function(names, text) {
    strwrap(paste0(length(names), text, if (length(names) > 1L) "s", ": ", toString(names)),
            width - 1L, prefix = "#   ", initial = "# ")
  }
  if (!nrow(x)) {
    whole <- cli::ansi_strip(format(of, n = n, width = width))
    return(c(whole[cumsum(grepl("[0-9]+ variable", whole)) == 0L], listed(names(x), " column")))
  }
  # No more columns fit than their names.
  room <- max(1L, sum(cumsum(nchar(names(columns), "width") + 1L) <= width))
  lines <- unwrapped(plain[seq_len(room)], n)
  comment <- startsWith(cli::ansi_strip(lines), "#")
  body <- lines[!comment]
  ends <- column_ends(cli::ansi_strip(body), names(columns)[seq_len(room)])
  fit <- max(1L, sum(ends <= width))
  head <- format(of, n = 0L, width = width)
  head <- head[cumsum(grepl("^# .*(more row|more variable)", cli::ansi_strip(head))) == 0L]
  rows <- grep("more row", lines[comment], value = TRUE)
  others <- names(columns)[-seq_len(fit)]
  c(
    head, if (fit < room) cli::ansi_strtrim(body, ends[fit], "") else body, cli::ansi_strip(rows),
    if (length(others)) listed(others, " more column")
  )
}

# format() costs 8 ms for each column of ten rows; once, with all columns side by side.
unwrapped <- function(x, n) {
  old <- options(width = 9999L)
  on.exit(options(old))
  format(x, n = n, width = Inf)
}

# Where the columns of a printed table end, in places of the terminal: the first line has the names.
# Between two names one place is blank in all lines, next to the later name or to the numbers that
# reach further to the left than it.
column_ends <- function(lines, names) {
  blank <- lapply(strsplit(lines, ""), function(letters) {
    rep(letters, nchar(letters, "width")) == " "
  })
  size <- max(lengths(blank))
  blank <- Reduce(`&`, lapply(blank, function(x) c(x, rep(TRUE, size - length(x)))))
  starts <- integer(length(names))
  from <- 1L
  for (i in seq_along(names)) {
    at <- from - 1L + regexpr(names[i], substring(lines[1L], from), fixed = TRUE)
    before <- nchar(substr(lines[1L], 1L, at - 1L), "width")
    starts[i] <- max(0L, which(blank[seq_len(before + 1L)])) + 1L
    from <- at + nchar(names[i])
  }
  c(starts[-1L] - 2L, size)
}

# Columns named ..._x_..., ..._y_..., ..._z_... are components; those of one unit are compared. Of
# rows with an index the bodies at one time are.
without_noise <- function(x) {
  is_component <- grepl("(^|_)[fv]?[xyz](_|$)", names(x)) & vapply(unclass(x), is.double, NA)
  unit <- unit_in_name(names(x))
  for (one in unique(unit[is_component])) {
    at <- which(is_component & unit == one)
    if (length(at) < 2L) next
    size <- do.call(pmax, c(lapply(unclass(x)[at], abs), na.rm = TRUE))
    for (i in at) x[[i]] <- noise_as_0(x[[i]], size)
  }
  index <- intersect(c("rotor", "link"), names(x))
  if (length(index) != 1L || !is.double(x[["time_s"]]) || !nrow(x)) return(x)
  # More rows are not shown.
  rows <- seq_len(min(nrow(x), 10000L))
  moment <- match(x[["time_s"]][rows], unique(x[["time_s"]][rows]))
  for (i in setdiff(which(vapply(unclass(x), is.double, NA)), match("time_s", names(x)))) {
    largest <- vapply(split(abs(x[[i]][rows]), moment), max, 0)
    x[[i]][rows] <- noise_as_0(x[[i]][rows], unname(largest[moment]))
  }
  x
}

noise_as_0 <- function(value, size) {
  value[!is.na(value) & is.finite(size) & abs(value) < 1e-14 * size] <- 0
  value
}

# ---- lines --------------------------------------------------------------------------------------

# The console's width, at most 98.
print_width <- function() {
  min(getOption("width", 80L), 98L)
}

# cat() of whole lines, those wider than the console folded.
say <- function(..., sep = "") {
  force(list(...))
  lines <- unlist(lapply(utils::capture.output(cat(..., sep = sep)), folded))
  if (length(lines)) cat(lines, sep = "\n")
}

# A line as several, no wider than the console where its words allow it. They go on under the text
# of a line "  name  text", else two columns further in.
folded <- function(line) {
  room <- print_width()
  if (nchar(line, "width") <= room) return(line)
  line <- join_units(line)
  own <- nchar(sub("^( *).*", "\\1", line))
  head <- regmatches(line, regexpr("^ *\\S+( \\S+)?  +(?=\\S)", line, perl = TRUE))
  if (!length(head) || nchar(head) > room / 2) {
    text <- strwrap(line, room + 1L, indent = own, exdent = min(own + 2L, room %/% 2L))
    return(chartr(fixed_space, " ", text))
  }
  text <- strwrap(substring(line, nchar(head) + 1L), room + 1L - nchar(head))
  chartr(fixed_space, " ", paste0(c(head, rep(strrep(" ", nchar(head)), length(text) - 1L)), text))
}

fixed_space <- "\u00a0"

# A number and its unit stay on one line, where the encoding has a space for it.
join_units <- function(line) {
  if (!l10n_info()$`UTF-8`) return(line)
  parts <- c("(?<=[0-9]) (?=[A-Za-z])", "(?<=\\bN|\\bm|kg) (?=(?:m|s)\\b)")
  for (part in parts) line <- gsub(part, fixed_space, line, perl = TRUE)
  line
}
