# Times of day, with a date or without one, as seconds since the first row: cells of a log, and R's
# date-times.

clock_parts <- c("[0-9]{1,2}", "[0-5][0-9]", "[0-6][0-9]")
clock_pattern <- paste0(paste(clock_parts, collapse = ":"), "(?:[.:][0-9]+)?")
date_pattern <- "[0-9]{4}[-/.][0-9]{1,2}[-/.][0-9]{1,2}"
# The day or the month first: which of them is not said.
short_date_pattern <- "[0-9]{1,2}[-/.][0-9]{1,2}[-/.](?:[0-9]{4}|[0-9]{2})"
stamp_pattern <- paste0(
  "^(?:(", date_pattern, ")T)?", paste0("(", clock_parts, ")", collapse = ":"), "(?:[.:]([0-9]+))?",
  "(AM|PM)?(?:Z|([+-][0-9]{2}):?([0-9]{2})?)?$"
)

is_stamp <- function(cells) grepl(stamp_pattern, cells, perl = TRUE)
is_lone_date <- function(cells) {
  grepl(paste0("^(?:", date_pattern, "|", short_date_pattern, ")$"), cells, perl = TRUE)
}

# Lines in which each stamp is one cell without blanks and with a decimal point, whatever the
# separator: "2026-03-01 10:11:12,5" is 2026-03-01T10:11:12.5. Logging programs put an arrow between
# the time and what was sent. Short dates go: the order of the times tells where a day ends. Lines
# as they were where none of the first has a time of day.
join_stamps <- function(lines) {
  clock <- sub("[.:]", "[.,:]", clock_pattern, fixed = TRUE)
  head <- lines[seq_len(min(length(lines), 400L))]
  if (!any(grepl(clock, head, perl = TRUE))) return(lines)
  lines <- gsub(
    paste0("(", date_pattern, ")[ T]+(?=", clock, ")"), "\\1T", lines, perl = TRUE
  )
  lines <- gsub(
    paste0("(^|[^0-9])", short_date_pattern, "[ T]+(?=", clock, ")"), "\\1", lines, perl = TRUE
  )
  lines <- gsub(
    paste0("(", clock, ") ?(AM|PM)\\b"), "\\1\\U\\2", lines, perl = TRUE, ignore.case = TRUE
  )
  # Between commas, a comma after the seconds is a separator.
  free <- grepl("[;\t]", lines)
  comma <- "([0-9]:[0-5][0-9]:[0-6][0-9]),([0-9]+)"
  lines[free] <- gsub(comma, "\\1.\\2", lines[free])
  arrow <- grepl("^[^,;\t]*[0-9] *-> *", lines)
  rest <- sub("^.*?-> *", "", lines[arrow], perl = TRUE)
  numbers <- grep("^[-+0-9.,;\t eE]+$", rest, value = TRUE)
  found <- regmatches(numbers, regexpr("[;\t, ]", numbers))
  separator <- if (length(found)) names(which.max(table(found))) else ","
  lines[arrow] <- paste0(sub(" *->.*$", "", lines[arrow]), separator, rest)
  lines
}

# Seconds since the first stamp, NA for other cells. The day is apart from the seconds of the day:
# in seconds since 1970 a double ends at a quarter of a microsecond. Without dates, a time that is
# half a day before the one above is of the next day.
stamp_seconds <- function(cells) {
  found <- regexpr(stamp_pattern, cells, perl = TRUE)
  fine <- which(found > 0L)
  out <- rep(NA_real_, length(cells))
  if (!length(fine)) return(out)
  cells <- cells[fine]
  start <- attr(found, "capture.start")[fine, , drop = FALSE]
  end <- start + attr(found, "capture.length")[fine, , drop = FALSE] - 1L
  part <- function(k) substr(cells, start[, k], end[, k])
  number <- function(k) as.numeric(paste0("0", part(k)))
  hour <- number(2)
  noon <- part(6)
  half_day <- nzchar(noon)
  hour[half_day] <- hour[half_day] %% 12 + 12 * (noon[half_day] == "PM")
  east <- part(7)
  offset <- as.numeric(paste0("0", substr(east, 2, 3))) * 3600 + number(8) * 60
  offset <- ifelse(startsWith(east, "-"), -offset, offset)
  second <- hour * 3600 + number(3) * 60 + number(4) - offset
  dates <- part(1)
  days <- unique(dates)
  day <- as.numeric(as.Date(chartr("/.", "--", days), "%Y-%m-%d", optional = TRUE))
  day <- day[match(dates, days)]
  if (anyNA(day)) day <- cumsum(c(FALSE, diff(second) < -43200))
  fraction <- as.numeric(paste0("0.", part(5)))
  # The fraction last: a second of a day has eleven digits behind the point.
  out[fine] <- ((day - day[1]) * 86400 + (second - second[1])) + (fraction - fraction[1])
  out
}

is_date_time <- function(x) inherits(x, c("POSIXct", "POSIXlt"))

seconds_since_first <- function(times) {
  seconds <- as.double(as.POSIXct(times))
  first <- which(is.finite(seconds))[1]
  if (is.na(first)) seconds else seconds - seconds[first]
}
