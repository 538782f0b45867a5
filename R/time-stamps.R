# Times of day, with a date or without one, as seconds since the first row: cells of a log, and R's
# date-times.

clock_parts <- c("[0-9]{1,2}", "[0-5][0-9]", "[0-6][0-9]")
clock_pattern <- paste0(paste(clock_parts, collapse = ":"), "(?:[.:][0-9]+)?")
date_pattern <- "[0-9]{4}[-/.][0-9]{1,2}[-/.][0-9]{1,2}"
# The day, the month or the year first: see days_of_dates().
short_date_pattern <- "[0-9]{1,2}[-/.][0-9]{1,2}[-/.](?:[0-9]{4}|[0-9]{2})"
stamp_pattern <- paste0(
  "^(?:(", date_pattern, "|", short_date_pattern, ")T)?",
  paste0("(", clock_parts, ")", collapse = ":"), "(?:[.:]([0-9]+))?",
  "(AM|PM)?(?:Z|([+-][0-9]{2}):?([0-9]{2})?)?$"
)

is_stamp <- function(cells) grepl(stamp_pattern, cells, perl = TRUE)
is_lone_date <- function(cells) {
  grepl(paste0("^(?:", date_pattern, "|", short_date_pattern, ")$"), cells, perl = TRUE)
}

# Lines in which each stamp is one cell without blanks and with a decimal point, whatever the
# separator: "2026-03-01 10:11:12,5" is 2026-03-01T10:11:12.5. Logging programs put an arrow between
# the time and what was sent. Lines as they were where none of the first has a time of day.
join_stamps <- function(lines) {
  clock <- sub("[.:]", "[.,:]", clock_pattern, fixed = TRUE)
  head <- lines[seq_len(min(length(lines), 400L))]
  if (!any(grepl(clock, head, perl = TRUE))) return(lines)
  lines <- gsub(
    paste0("(", date_pattern, ")[ T]+(?=", clock, ")"), "\\1T", lines, perl = TRUE
  )
  lines <- gsub(
    paste0("(^|[^0-9])(", short_date_pattern, ")[ T]+(?=", clock, ")"), "\\1\\2T", lines,
    perl = TRUE
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

# Cells of a column of times of day, with the dates of a column of their own, the nearest one.
join_dates <- function(clock, at, dated, matrix) {
  if (!length(dated) || any(grepl("T", clock, fixed = TRUE))) return(clock)
  dates <- matrix[, dated[which.min(abs(dated - at))]]
  has <- !dates %in% missing_cells
  clock[has] <- paste0(dates[has], "T", clock[has])
  clock
}

# Day numbers of dates, NA for what is no date. The order of the parts of a short date is the one
# with which the largest number of them are dates. Orders with which as many are must count the same
# days between them.
days_of_dates <- function(dates, file, call) {
  day <- function(year, month, day) {
    days <- as.numeric(as.Date(sprintf("%d-%d-%d", year, month, day), "%Y-%m-%d", optional = TRUE))
    # as.Date() ignores the third digit of a day.
    ifelse(month <= 12 & day <= 31, days, NA_real_)
  }
  parts <- function(dates) matrix(as.integer(unlist(strsplit(dates, "[-/.]"))), 3L)
  out <- rep(NA_real_, length(dates))
  iso <- grepl("^[0-9]{4}", dates)
  if (any(iso)) {
    part <- parts(dates[iso])
    out[iso] <- day(part[1, ], part[2, ], part[3, ])
  }
  short <- which(!iso & nzchar(dates))
  if (!length(short)) return(out)
  part <- parts(dates[short])
  two_digits <- !grepl("[0-9]{4}$", dates[short])
  century <- function(year) ifelse(year < 100L, 2000L + year, year)
  first_day <- day(century(part[3, ]), part[2, ], part[1, ])
  first_month <- day(century(part[3, ]), part[1, ], part[2, ])
  first_year <- ifelse(two_digits, day(century(part[1, ]), part[2, ], part[3, ]), NA_real_)
  orders <- unname(cbind(first_day, first_month, first_year))
  valid <- colSums(!is.na(orders))
  best <- orders[, valid == max(valid), drop = FALSE]
  since <- if (any(iso)) best else {
    sweep(best, 2L, apply(best, 2L, function(days) days[!is.na(days)][1]))
  }
  if (any(apply(since, 2L, function(days) !identical(days, since[, 1])))) {
    abort_file(
      paste0(
        "Its dates change, and their order of day, month and year is unknown: ",
        quote_all(dates[short][c(1L, length(short))]), "."
      ), file, call, "Write the year first, with four digits: {.val 2026-03-01}."
    )
  }
  out[short] <- best[, 1]
  out
}

# Seconds since the first stamp, NA for other cells and for dates that do not exist. The day is
# apart from the seconds of the day: in seconds since 1970 a double ends at a quarter of a
# microsecond. A time without a date is of the day of the last date above it, and of the next day
# from a time on that is half a day before the one above.
stamp_seconds <- function(cells, file = "", call = NULL) {
  found <- regexpr(stamp_pattern, cells, perl = TRUE)
  fine <- which(found > 0L)
  out <- rep(NA_real_, length(cells))
  if (!length(fine)) return(out)
  start <- attr(found, "capture.start")
  end <- start + attr(found, "capture.length") - 1L
  dates <- substr(cells[fine], start[fine, 1], end[fine, 1])
  known <- unique(dates)
  day <- days_of_dates(known, file, call)[match(dates, known)]
  exists <- !nzchar(dates) | !is.na(day)
  day <- day[exists]
  fine <- fine[exists]
  if (!length(fine)) return(out)
  cells <- cells[fine]
  start <- start[fine, , drop = FALSE]
  end <- end[fine, , drop = FALSE]
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
  midnights <- cumsum(c(FALSE, diff(second) < -43200))
  dated <- which(!is.na(day))
  if (length(dated)) {
    from <- dated[pmax(findInterval(seq_along(day), dated), 1L)]
    day <- day[from] + midnights - midnights[from]
  } else {
    day <- midnights
  }
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
