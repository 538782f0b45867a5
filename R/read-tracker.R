#' @rdname read_motion
#' @export
read_tracker <- function(file, ..., mark = NULL, centre = NULL, centre_m = "fit",
                         frame_rate_hz = NULL, angle_unit = NULL) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  tracker_record(
    file, read_bytes(file, call), call, mark, centre, centre_m, frame_rate_hz, angle_unit
  )
}

tracker_record <- function(file, bytes, call, mark = NULL, centre = NULL, centre_m = "fit",
                           frame_rate_hz = NULL, angle_unit = NULL) {
  if (!is.null(frame_rate_hz)) {
    frame_rate_hz <- check_number(frame_rate_hz, "frame_rate_hz", "1", call, 0, open = TRUE)
  }
  if (!is.null(angle_unit)) {
    angle_unit <- check_string(angle_unit, "angle_unit", c("deg", "rad"), call)
  }
  if (is_zip(bytes)) {
    names <- zip_names(file, call)
    bytes <- zip_bytes(file, names[grepl("[.]trk$", names)][1], call)
  }
  head <- bytes[seq_len(min(length(bytes), 200L))]
  head <- rawToChar(head[head != as.raw(0)])
  if (grepl("<", head, fixed = TRUE, useBytes = TRUE)) {
    return(tracker_project(file, bytes, call, mark, centre, centre_m, frame_rate_hz))
  }
  tracker_text(file, bytes, call, mark, centre_m, frame_rate_hz, angle_unit)
}

# ---- projects -----------------------------------------------------------------------------------

# The object in a property of an object: NULL where there is none.
trk_object <- function(node, name) {
  found <- xml2::xml_find_first(node, paste0("./property[@name='", name, "']/object"))
  if (inherits(found, "xml_missing")) NULL else found
}

trk_number <- function(node, name) {
  if (is.null(node)) return(NA_real_)
  text <- xml2::xml_text(xml2::xml_find_first(node, paste0("./property[@name='", name, "']")))
  suppressWarnings(as.numeric(text))
}

trk_text <- function(node, name) {
  xml2::xml_text(xml2::xml_find_first(node, paste0("./property[@name='", name, "']")))
}

# A frame's number and object: the properties [0], [1], ... of an array.
trk_frames <- function(node) {
  items <- xml2::xml_find_all(node, "./property[@name='framedata']/property")
  frame <- suppressWarnings(as.integer(gsub("[^0-9]", "", xml2::xml_attr(items, "name"))))
  data <- lapply(items, function(item) xml2::xml_find_first(item, "./object"))
  keep <- !is.na(frame) & !vapply(data, inherits, NA, "xml_missing")
  list(frame = frame[keep], data = data[keep])
}

tracker_project <- function(file, bytes, call, mark, centre, centre_m, frame_rate_hz) {
  panel <- read_xml_bytes(bytes, file, call)
  class <- xml2::xml_attr(panel, "class")
  if (is.na(class) || !endsWith(class, "TrackerPanel")) {
    found <- xml2::xml_find_first(panel, ".//object[contains(@class, 'TrackerPanel')]")
    if (inherits(found, "xml_missing")) abort_file("It is no project of Tracker.", file, call)
    panel <- found
  }
  tracks <- xml2::xml_find_all(
    panel, "./property[@name='tracks']/property/object[contains(@class, 'PointMass')]"
  )
  names <- vapply(tracks, trk_text, "", "name")
  if (!length(tracks)) abort_file("It has no point mass: no marks.", file, call)
  one <- choose_mark(mark, names, "mark", setdiff(names, centre), call)
  clip <- trk_object(panel, "videoclip")
  dt <- trk_number(trk_object(panel, "clipcontrol"), "delta_t")
  if (is.na(dt)) dt <- trk_number(if (!is.null(clip)) trk_object(clip, "video"), "delta_t")
  start <- trk_number(clip, "startframe")
  from <- trk_number(clip, "starttime")
  if (is.na(start)) start <- 0
  if (is.na(from)) from <- 0
  notes <- character()
  if (is.null(frame_rate_hz)) {
    if (is.na(dt) || dt <= 0) {
      abort_file("It has no frame rate.", file, call, "Give {.arg frame_rate_hz}.")
    }
    frame_rate_hz <- 1000 / dt
    notes <- paste0(
      format(frame_rate_hz, digits = 6), " frames a second, as the file says; of a slow-motion ",
      "video that may be the playback's"
    )
  }
  axes <- trk_axes(panel, file, call)
  if (!isTRUE(trk_text(panel, "length_unit") %in% c("m", NA))) {
    factor <- parse_unit(trk_text(panel, "length_unit"))
    if (is.null(factor) || factor$kind != "length") {
      abort_file("Its unit of length is unknown.", file, call)
    }
    axes$scale <- axes$scale / factor$factor
  }
  place <- trk_positions(tracks[[one]], axes, file, call)
  columns <- list(
    time_s = list(
      value = from / 1000 + (place$frame - start) / frame_rate_hz, heading = "frame",
      arg = "time_s", unit = "s"
    ),
    x_m = list(value = place$x, heading = names[one], arg = "x_m", unit = "m"),
    y_m = list(value = place$y, heading = names[one], arg = "y_m", unit = "m")
  )
  if (!is.null(centre)) {
    other <- trk_positions(
      tracks[[choose_mark(centre, names, "centre", names, call)]], axes, file, call
    )
    at <- match(place$frame, other$frame)
    centre_m <- cbind(other$x[at], other$y[at])
  }
  build_record(
    columns, length(place$frame), call, source = paste0(basename(file), " (Tracker)"),
    centre_m = centre_m, notes = notes, marks = "keep"
  )
}

choose_mark <- function(mark, names, arg, candidates, call) {
  if (is.null(mark)) {
    if (length(candidates) == 1L) return(match(candidates, names))
    abort_rotdyn(c(
      "{.arg {arg}} is missing: the file has several marks.",
      i = "They are {.val {names}}."
    ), "missing", call)
  }
  at <- match(check_name(mark, arg, call), names)
  if (is.na(at)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be one of {.or {.val {names}}}.", x = "It is {.val {mark}}."
    ), "value", call)
  }
  at
}

# Origin, angle and scale by frame.
trk_axes <- function(panel, file, call) {
  frames <- trk_frames(trk_object(panel, "coords") %||% panel)
  if (!length(frames$frame)) abort_file("It has no axes.", file, call)
  get <- function(name) vapply(frames$data, trk_number, 0, name)
  axes <- data.frame(
    frame = frames$frame, x = get("xorigin"), y = get("yorigin"), angle = get("angle"),
    scale = get("xscale")
  )
  axes$angle[is.na(axes$angle)] <- 0
  axes <- axes[order(axes$frame), ]
  if (!all(is.finite(as.matrix(axes))) || any(axes$scale <= 0)) {
    abort_file("Its axes are damaged.", file, call)
  }
  axes
}

# Marks in m: the picture's y is down, the axes are turned counter-clockwise by an angle in degrees.
trk_positions <- function(track, axes, file, call) {
  marks <- trk_frames(track)
  px <- vapply(marks$data, trk_number, 0, "x")
  py <- vapply(marks$data, trk_number, 0, "y")
  order <- order(marks$frame)
  frame <- marks$frame[order]
  if (length(frame) < 2L) abort_file("The mark is set in fewer than two frames.", file, call)
  a <- axes[pmax(findInterval(frame, axes$frame), 1L), ]
  dx <- px[order] - a$x
  dy <- a$y - py[order]
  turn <- a$angle * pi / 180
  list(
    frame = frame, x = (dx * cos(turn) + dy * sin(turn)) / a$scale,
    y = (dy * cos(turn) - dx * sin(turn)) / a$scale
  )
}

# ---- exported text ------------------------------------------------------------------------------

tracker_text <- function(file, bytes, call, mark, centre_m, frame_rate_hz, angle_unit) {
  table <- read_delimited(decode_bytes(bytes, file, call), file, call)
  # Names of tracks are in the line above, at their first columns.
  heads <- gsub("^(.*)\u03b8.*$", "\\1theta", table$headings)
  heads <- gsub("^(.*)\u03c9.*$", "\\1omega", heads)
  bare <- lower_case(sub("\\s*[[(].*$", "", heads))
  if (!"t" %in% bare) abort_file("It has no column \"t\".", file, call)
  pick <- function(name) {
    at <- which(bare == name)
    if (length(at) > 1L) {
      abort_file("It has several tracks.", file, call, "Export one track at a time.")
    }
    at
  }
  x <- pick("x")
  y <- pick("y")
  angle <- pick("theta")
  time <- which(bare == "t")[1]
  column <- function(at, arg, factor, unit) {
    list(
      value = table$columns[[at]] * factor, heading = file_headings(table$headings[at]), arg = arg,
      unit = unit
    )
  }
  in_si <- function(at, arg, kind) {
    heading <- parse_heading(table$headings[at])
    unit <- heading$unit
    if (is.null(heading$said)) return(column(at, arg, 1, record_arguments[[arg]][[2]]))
    if (!identical(unit$kind, kind)) {
      abort_file(
        paste0("The unit of ", quote_all(table$headings[at]), " is no unit of ", kind, "."), file,
        call, if (kind == "length") {
          "Calibrate the video in Tracker and export lengths, as {.val x (cm)}."
        }
      )
    }
    column(at, arg, unit$factor, unit$text)
  }
  columns <- list(time_s = in_si(time, "time_s", "time"))
  frame <- pick("frame")
  if (!is.null(frame_rate_hz)) {
    seconds <- columns$time_s$value
    counted <- if (length(frame)) table$columns[[frame]] else seq_along(seconds)
    if (length(frame) && (!isTRUE(all(diff(counted[!is.na(counted)]) > 0)) ||
      any(counted %% 1 != 0, na.rm = TRUE))) {
      abort_file("Its frame numbers are no whole numbers that increase.", file, call)
    }
    step <- stats::median(diff(seconds) / diff(counted), na.rm = TRUE)
    if (!isTRUE(step > 0)) abort_file("Its times do not increase.", file, call)
    if (length(frame)) {
      # The frames are exact, the times of the file are rounded.
      first <- which(!is.na(counted) & !is.na(seconds))[1]
      start <- seconds[first] / step
      columns$time_s$value <- (start + counted - counted[first]) / frame_rate_hz
      notes <- "times are those of the frame numbers"
    } else {
      columns$time_s$value <- seconds / step / frame_rate_hz
      notes <- "the median step of time is one frame"
    }
  } else {
    notes <- "times are those of the file; of a slow-motion video they may be the playback's"
  }
  if (length(x) && (length(y) || !length(angle))) {
    columns$x_m <- in_si(x, "x_m", "length")
    if (length(y)) columns$y_m <- in_si(y, "y_m", "length")
    bare_units <- vapply(table$headings[c(x, y)], function(heading) {
      is.null(parse_heading(heading)$said)
    }, NA)
    if (any(bare_units)) notes <- c(notes, "positions without a unit are in m")
  } else if (length(angle)) {
    said <- parse_heading(table$headings[angle])$unit
    if (is.null(angle_unit) && (is.null(said) || said$kind != "angle")) {
      abort_rotdyn(c(
        "{.arg angle_unit} is missing: Tracker exports angles without their unit.",
        x = "Column {.field {table$headings[angle]}} runs from
             {format(min(table$columns[[angle]], na.rm = TRUE))} to
             {format(max(table$columns[[angle]], na.rm = TRUE))}.",
        i = "It is {.val deg} unless {.emph Angles: Radians} was chosen there."
      ), "missing", call)
    }
    factor <- if (is.null(angle_unit)) said$factor else c(deg = pi / 180, rad = 1)[[angle_unit]]
    columns$theta_rad <- column(angle, "theta_rad", factor, angle_unit %||% said$text)
  } else {
    abort_file("It has neither positions nor an angle.", file, call)
  }
  build_record(
    columns, length(table$columns[[1]]), call, source = paste0(basename(file), " (Tracker)"),
    centre_m = centre_m, notes = notes, marks = "keep", dropped = table$dropped
  )
}
