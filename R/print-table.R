# Tables that functions return, printed so that no name is abbreviated: one row upright, with units;
# else the first columns that fit, and the names of the others.

# A tibble of the package; `nrow = NULL`: as its first column; `...`: attributes.
new_table <- function(x, nrow = NULL, class = NULL, ...) {
  tibble::new_tibble(x, ..., nrow = nrow, class = c(class, "rot_table"))
}

# As tibble::tibble().
as_table <- function(...) table_from(tibble::tibble(...))

# A data frame or a list of columns as a table of the package.
table_from <- function(x, class = NULL) {
  x <- tibble::as_tibble(x)
  class(x) <- unique(c(class, "rot_table", class(x)))
  x
}

#' Print a table
#'
#' The tables of this package are tibbles. A table of one row is printed upright: name, value, unit.
#' Any other shows as many columns as fit with their whole names, and names the rest below.
#' A component of a vector that is rounding noise beside the others is shown as 0.
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
#' @importFrom tibble tbl_sum
#' @export
print.rot_table <- function(x, ..., n = NULL, width = NULL) {
  if (!is.null(width) || !length(x)) return(NextMethod())
  shown <- without_noise(x)
  if (is_upright(x)) {
    writeLines(upright_lines(shown))
    return(invisible(x))
  }
  writeLines(table_lines(shown, n))
  invisible(x)
}

# Motions and other tables with a head of their own, and lists of two columns, stay rows.
is_upright <- function(x) {
  nrow(x) == 1L && length(x) > 2L && identical(names(tbl_sum(x)), "A tibble") &&
    all(vapply(unclass(x), is.atomic, NA))
}

#' @export
print.rot_trajectory <- print.rot_table

upright_lines <- function(x) {
  table <- column_table()
  units <- table$unit[match(names(x), table$name)]
  # Columns that are arguments have theirs in the name.
  other <- is.na(units)
  units[other] <- unit_in_name(names(x)[other])
  units[units == "1"] <- ""
  values <- vapply(unclass(x), function(value) {
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

# "rad/s" of `spin_rad_per_s`, by the columns whose names end alike; else "1".
unit_in_name <- function(names) {
  table <- column_table()
  known <- unique(stats::na.omit(table$unit))
  suffix <- gsub("^2", "2", gsub("*", "_", gsub("/", "_per_", known, fixed = TRUE), fixed = TRUE),
                 fixed = TRUE)
  suffix <- ifelse(known == "degree", "deg", tolower(gsub(" ", "_", suffix, fixed = TRUE)))
  vapply(names, function(name) {
    fits <- known != "1" & endsWith(name, paste0("_", suffix))
    if (any(fits)) known[fits][which.max(nchar(suffix[fits]))] else "1"
  }, "", USE.NAMES = FALSE)
}

# Lines of as many columns as fit without abbreviated names.
table_lines <- function(x, n) {
  width <- getOption("width")
  columns <- lapply(stats::setNames(seq_along(x), names(x)), function(i) .subset2(x, i))
  plain <- tibble::new_tibble(columns, nrow = nrow(x))
  body <- function(m) {
    lines <- format(plain[seq_len(m)], n = n, width = Inf)
    lines[!startsWith(cli::ansi_strip(lines), "#")]
  }
  # What does not fit is wrapped: more lines.
  one <- length(body(1L))
  fits <- function(m) length(body(m)) == one
  low <- 1L
  high <- min(length(x), 40L)
  while (low < high) {
    middle <- (low + high + 1L) %/% 2L
    if (fits(middle)) low <- middle else high <- middle - 1L
  }
  whole <- format(x, n = n, width = width)
  comment <- startsWith(cli::ansi_strip(whole), "#")
  head <- whole[cumsum(!comment) == 0L]
  rows <- grep("more row", whole[comment & cumsum(!comment) > 0L], value = TRUE)
  rows <- sub(
    ",? (and )?([0-9]+ more variables?|abbreviated variable names?).*$", "", cli::ansi_strip(rows)
  )
  others <- names(x)[-seq_len(low)]
  more <- if (length(others)) {
    strwrap(
      paste0(length(others), " more column", if (length(others) > 1L) "s", ": ",
             paste(others, collapse = ", ")),
      width - 1L, prefix = "#   ", initial = "# "
    )
  }
  c(head, body(low), rows, more)
}

# Columns named ..._x_..., ..._y_..., ..._z_... are components of one vector.
without_noise <- function(x) {
  stem <- sub("(^|_)[xyz](_|$)", "\\1?\\2", names(x))
  for (one in unique(stem[grepl("?", stem, fixed = TRUE)])) {
    at <- which(stem == one)
    numbers <- vapply(unclass(x)[at], is.double, NA)
    if (length(at) != 3L || !all(numbers)) next
    size <- do.call(pmax, c(lapply(unclass(x)[at], abs), na.rm = TRUE))
    for (i in at) {
      small <- !is.na(x[[i]]) & is.finite(size) & abs(x[[i]]) < 1e-14 * size
      x[[i]][small] <- 0
    }
  }
  x
}
