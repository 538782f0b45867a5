# Units and headings of measured columns, as instruments write them.

# Text (lower case, without blanks) to kind and factor to SI.
unit_table <- local({
  kind <- function(kind, ...) {
    factors <- c(...)
    data.frame(text = names(factors), kind = kind, factor = unname(factors))
  }
  turn <- 2 * pi
  deg <- pi / 180
  rbind(
    kind(
      "time", s = 1, sec = 1, secs = 1, second = 1, seconds = 1, ms = 1e-3, msec = 1e-3,
      millisecond = 1e-3, milliseconds = 1e-3, us = 1e-6, microseconds = 1e-6, ns = 1e-9,
      nanoseconds = 1e-9, min = 60, minutes = 60
    ),
    kind(
      "angle", rad = 1, rads = 1, radian = 1, radians = 1, mrad = 1e-3, deg = deg, degs = deg,
      degree = deg, degrees = deg, turn = turn, turns = turn, rev = turn, revs = turn,
      revolution = turn, revolutions = turn, rotation = turn, rotations = turn
    ),
    kind(
      "rate", "rad/s" = 1, "rads/s" = 1, "rad/sec" = 1, "radian/s" = 1, "radians/s" = 1,
      "radians/sec" = 1, "radians/second" = 1, "mrad/s" = 1e-3, "rad/ms" = 1e3, "deg/s" = deg,
      "degs/s" = deg, "deg/sec" = deg, "degree/s" = deg, "degrees/s" = deg, "degrees/sec" = deg,
      "degrees/second" = deg, dps = deg, mdps = deg / 1000, radps = 1, degps = deg,
      rpm = turn / 60, "rev/min" = turn / 60, "r/min" = turn / 60, rps = turn,
      "turn/s" = turn, "turns/s" = turn, "rev/s" = turn, "revs/s" = turn
    ),
    kind(
      "length", m = 1, cm = 1e-2, mm = 1e-3, um = 1e-6, km = 1e3, inch = 0.0254, inches = 0.0254,
      "in" = 0.0254, ft = 0.3048, foot = 0.3048, feet = 0.3048
    ),
    kind(
      "other", g = 9.80665, mg = 9.80665e-3, ut = 1e-6, "m/s" = 1, "m/s2" = 1, "cm/s" = 1e-2,
      "rad/s2" = 1, "deg/s2" = deg, n = 1, hz = 1, v = 1, hpa = 100, kg = 1, px = 1, pixel = 1,
      "%" = 0.01
    )
  )
})

# The kind of a unit and its factor, or NULL.
parse_unit <- function(text) {
  text <- gsub("\u00b0", "deg", trimws(text), fixed = TRUE)
  text <- gsub("[\u00b5\u03bc]", "u", text)
  text <- gsub("\u207b\u00b9|\\^\\(?-1\\)?", "-1", gsub("\u00b2|\\^2", "2", text))
  text <- gsub("\u207b2|\\^\\(?-2\\)?", "-2", text)
  text <- lower_case(text)
  # rad s-1 is rad/s.
  text <- sub("[ .*\u00b7]*\\bs(ec)?-([12])$", "/s\\2", text)
  text <- sub("/s1$", "/s", sub("[ ]*per[ ]*", "/", text))
  text <- gsub("[[:space:]]", "", text)
  at <- match(text, unit_table$text)
  if (is.na(at)) return(NULL)
  list(kind = unit_table$kind[at], factor = unit_table$factor[at], text = text)
}

# Names of a rate of turning, in small letters.
rate_names <- "gyr|omega|rate|velocity|speed|^w_?[xyz]?$"

# A heading apart: the name, and the unit where it has one: "Time (s)", "Angle/rad", "omega [rpm]",
# "theta_deg". `said` is what stood in the place of a unit, known or not.
parse_heading <- function(heading) {
  plain <- function(name, unit = NULL, said = NULL) {
    # omega_rads is a rate.
    if (!is.null(unit) && unit$text %in% c("rads", "degs") && grepl(rate_names, lower_case(name))) {
      unit <- parse_unit(sub("s$", "/s", unit$text))
    }
    list(name = trimws(name), unit = unit, said = said %||% unit$text)
  }
  whole <- parse_unit(heading)
  if (identical(whole$kind, "rate")) return(plain(heading, whole))
  # Zeit in s
  worded <- regmatches(heading, regexec("^(.+) in ([^ ]+)$", heading))[[1]]
  unit <- if (length(worded)) parse_unit(worded[3])
  if (!is.null(unit)) return(plain(worded[2], unit))
  found <- regmatches(heading, gregexpr("[(][^()]*[)]|\\[[^][]*\\]", heading))[[1]]
  for (part in rev(found)) {
    inside <- substr(part, 2, nchar(part) - 1)
    unit <- parse_unit(inside)
    if (!is.null(unit)) return(plain(sub(part, "", heading, fixed = TRUE), unit))
  }
  slash <- regexpr("/", heading, fixed = TRUE)
  if (slash > 1) {
    unit <- parse_unit(substring(heading, slash + 1))
    if (!is.null(unit)) return(plain(substr(heading, 1, slash - 1), unit))
  }
  words <- strsplit(heading, "_", fixed = TRUE)[[1]]
  for (k in seq_along(words)[-1]) {
    name <- paste(words[seq_len(k - 1)], collapse = "_")
    # A name has no slash: gyro_z_rad_s is in rad/s.
    last <- sub("( per)? (s2?|sec|second)$", "/\\2", paste(words[k:length(words)], collapse = " "))
    # omega_in is the rate of an input, not in inches.
    unit <- if (last != "in") parse_unit(last)
    if (!is.null(unit)) return(plain(name, unit))
  }
  if (length(found)) {
    last <- found[length(found)]
    return(plain(sub(last, "", heading, fixed = TRUE), NULL, substr(last, 2, nchar(last) - 1)))
  }
  plain(heading)
}

# What the columns of a table are by their headings: kind ("time", "angle", "rate", "length",
# "other" or NA), factor to SI, component ("x", "y", "z", "absolute" or NA).
heading_table <- function(headings) {
  parsed <- lapply(headings, parse_heading)
  words <- vapply(parsed, function(p) lower_case(p$name), "")
  kind <- vapply(parsed, function(p) {
    if (!is.null(p$unit)) p$unit$kind else if (!is.null(p$said)) "other" else NA_character_
  }, "")
  factor <- vapply(parsed, function(p) p$unit$factor %||% NA_real_, 0)
  times <- c("t", "time", "seconds_elapsed", "elapsed", "elapsed time", "zeit", "temps", "tiempo")
  bare <- is.na(kind) & words %in% times
  kind[bare] <- "time"
  # Names of the clocks of microcontrollers.
  clock <- match(words, c("millis", "micros"))
  clocked <- is.na(kind) & !is.na(clock)
  kind[clocked] <- "time"
  factor[clocked] <- c(1e-3, 1e-6)[clock[clocked]]
  unit <- vapply(parsed, function(p) p$unit$text %||% p$said %||% NA_character_, "")
  unit[clocked] <- c("ms", "us")[clock[clocked]]
  component <- rep(NA_character_, length(headings))
  axis <- regmatches(words, regexec("(^|[^a-z0-9])([xyz])([^a-z0-9]|$)", words))
  axis <- vapply(axis, function(m) if (length(m)) m[3] else NA_character_, "")
  # gyroX, gyrox, gx, wx
  short <- regmatches(words, regexec("^(g|gyr|gyro(scope)?|omega|w|rot(ation)?)_?([xyz])$", words))
  short <- vapply(short, function(m) if (length(m)) m[length(m)] else NA_character_, "")
  component <- ifelse(is.na(axis), short, axis)
  component[grepl("absolute|magnitude|betrag|norm$", words)] <- "absolute"
  data.frame(
    heading = headings, name = vapply(parsed, `[[`, "", "name"), kind = kind, factor = factor,
    unit = unit, component = component
  )
}
