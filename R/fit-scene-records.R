# Records of motions as a fit of a scene takes them: times and observed columns, counters by their
# edges.

# Records as lists of time_s and series (named list of columns), one for each segment.
fit_records <- function(records, scene, observed, call) {
  if (is.data.frame(records)) records <- list(records)
  if (!is.list(records) || !length(records) || !all(vapply(records, is.data.frame, NA))) {
    abort_rotdyn(c(
      "{.arg records} must be a data frame, or a list of data frames.",
      x = "It is {describe_value(records)}."
    ), "type", call)
  }
  known <- fit_observables(scene, call)
  labels <- names(records) %||% rep("", length(records))
  out <- list()
  for (i in seq_along(records)) {
    one <- records[[i]]
    if (!"time_s" %in% names(one)) {
      abort_missing_column("time_s", one, call)
    }
    computed <- inherits(one, "rot_trajectory")
    one <- one_row_a_time(one, i, scene, known, call)
    wanted <- observed %||% observed_columns(one, computed, scene, known)
    missing <- setdiff(wanted, intersect(names(one), known))
    if (length(missing) || !length(wanted)) {
      abort_rotdyn(c(
        if (length(missing)) {
          "{.field {missing}} {?is/are} no column{?s} of record {i} and of the motion."
        } else {
          "Record {i} has no column of this scene's motion."
        },
        i = "The motion has {.field {known}}.",
        i = if ("omega_rad_per_s" %in% names(one) && "omega_x_rad_per_s" %in% known) {
          "{.code axis = \"all\"} of {.fn motion_record} and {.fn read_motion} keeps the rates about
           three axes."
        }
      ), "argument", call)
    }
    time_s <- if (is_date_time(one$time_s)) seconds_since_first(one$time_s) else one$time_s
    time_s <- check_finite(time_s, "time_s", "s", call)
    rows <- seq_along(time_s)
    parts <- if ("segment" %in% names(one)) split(rows, one$segment) else list(rows)
    values <- lapply(stats::setNames(wanted, wanted), function(name) {
      observed_numbers(one[[name]], name, call)
    })
    # A row that a logger or a table has twice is one sample.
    again <- logical(length(time_s))
    if (anyDuplicated(time_s)) {
      segment <- if ("segment" %in% names(one)) list(one$segment)
      again <- duplicated(list2DF(c(list(time_s), segment, values)))
    }
    if (any(again)) {
      warn_rotdyn(
        "{sum(again)} row{?s} of record {i} {cli::qty(sum(again))}repeat{?s/} another exactly
         and {?is/are} left out.",
        "fit", call
      )
    }
    for (k in seq_along(parts)) {
      rows <- parts[[k]][!again[parts[[k]]]]
      rows <- rows[order(time_s[rows])]
      series <- lapply(values, `[`, rows)
      label <- if (nzchar(labels[i])) labels[i] else as.character(i)
      out[[length(out) + 1L]] <- by_edges(list(
        name = if (length(parts) > 1L) paste0(label, ".", k) else label,
        time_s = time_s[rows], series = series
      ))
    }
  }
  start <- scene$start_s %||% 0
  early <- vapply(out, function(r) length(r$time_s) && r$time_s[1] < start, NA)
  if (any(early)) {
    one <- out[[which(early)[1]]]
    abort_rotdyn(c(
      "Record {one$name} begins before the scene does.",
      x = "It begins at {format(one$time_s[1])} s, the scene at {format(start)} s.",
      i = "{.arg start_s} of the scene says when its start holds."
    ), "value", call)
  }
  out
}

# A motion of several rows for each time with a column for each of them, as they are observed.
one_row_a_time <- function(record, i, scene, known, call) {
  index <- constraint_of(scene)$index
  if (is.null(index) || !index %in% names(record)) return(record)
  times <- split(record$time_s, record[[index]])
  if (length(unique(unname(times))) != 1L) {
    abort_rotdyn(c(
      "Record {i} must have the same times for each {.field {index}}.",
      x = "Rows: {lengths(times)}, for {.field {index}} {names(times)}.",
      i = "NA stands for what was not measured."
    ), "value", call)
  }
  names <- known[without_place(known) %in% names(record)]
  columns <- series_of_motion(record, index, names)
  list2DF(c(list(time_s = times[[1]]), columns[lengths(columns) == length(times[[1]])]))
}

# What a record has of the motion. No instrument reads the other columns of a computed motion: as
# samples of their own they made intervals too narrow.
observed_columns <- function(record, computed, scene, known) {
  found <- intersect(names(record), known)
  if (!computed) return(found)
  measures <- constraint_of(scene)$measures
  state <- unlist(lapply(measures[names(measures) != "angular_momentum"], `[[`, "columns"))
  read <- found[without_place(found) %in% state]
  if (!length(read) || length(read) == length(found)) return(found)
  inform_quickly(c(
    paste0("Of a computed motion the state is fitted: ", paste(read, collapse = ", "), "."),
    "The other columns follow from it. `observed` names columns to fit."
  ), "fit")
  read
}

# A measured column in SI units; NaN: not measured.
observed_numbers <- function(x, name, call) {
  if (inherits(x, "units")) x <- as_si(x, unit_of_column(name), name, call)
  if (!is.numeric(x) || is.object(x)) {
    abort_rotdyn(c(
      "The column {.field {name}} of a record must be numbers.", x = "It is {describe_value(x)}."
    ), "type", call)
  }
  infinite <- which(is.infinite(x))
  if (length(infinite)) {
    abort_rotdyn(c(
      "The column {.field {name}} of a record must be finite or missing.",
      x = "Row {infinite[1]} is infinite."
    ), "value", call)
  }
  replace(as.double(x), is.na(x), NaN)
}

# Of a column of a motion, by the dictionary.
unit_of_column <- function(name) {
  table <- column_table()
  table$unit[match(without_place(name), table$name)]
}

# The columns of a scene's motion that are numbers.
fit_observables <- function(scene, call) {
  outputs <- outputs_of_scene(scene, call)$path
  sub("^final_", "", grep("^final_", outputs, value = TRUE))
}

# Whole counts from the first: sums of decimals differ in their last bits.
counts_of <- function(y, step) round((y - y[!is.nan(y)][1]) / step)

# Of counts that go to and fro the times tell no place: they are digits with noise, or the motion
# turns within a count (rotors on a shaft: 95 % intervals held 62 %).
reverses <- function(counts) {
  moved <- sign(diff(counts[!is.nan(counts)]))
  length(unique(moved[moved != 0])) > 1L
}

weight_of_counts <- function(counts) {
  size <- rle(replace(counts, is.nan(counts), Inf))$lengths
  size <- rep(size, size)
  known <- which(!is.nan(counts))
  steps <- rle(diff(counts[known]))
  n <- length(steps$values)
  # Where the speed passes a whole number of counts a sample the error stands still as it does at
  # rest: the steps before such a run differ from those after it. Errors of short runs average out.
  before <- c(NA, steps$values[-n])
  behind <- c(steps$values[-1], NA)
  still <- steps$values != 0 & steps$lengths >= max(4, length(known) / 10) &
    (is.na(before) | is.na(behind) | before != behind)
  last <- cumsum(steps$lengths)
  for (i in which(still)) {
    rows <- known[seq(last[i] - steps$lengths[i] + 1L, last[i] + 1L)]
    size[rows] <- pmax(size[rows], length(rows))
  }
  sqrt(size)
}

# A record with the least s.d. of its columns, of counters D/sqrt(12), and with weights: s.d. of
# samples in those of the column. Of a counter's record alone the slow counts are replaced by the
# times between them. At rest a counter has one error: the rest is one sample, and so are n equal
# counts of other records, of which each has the weight sqrt(n).
by_edges <- function(record) {
  n <- length(record$time_s)
  segment <- rep(1L, n)
  step <- vapply(record$series, function(y) {
    y[is.nan(y)] <- NA
    found <- if (sum(!is.na(y)) > 8L) find_resolution(y, segment) else NA
    if (is.na(found)) 0 else real_step(y, segment, found)
  }, double(1))
  record$floor <- as.list(step / sqrt(12))
  record$count <- as.list(step)
  record$all <- record$series
  record$weight <- Map(function(y, step) {
    if (step > 0) weight_of_counts(counts_of(y, step))
  }, record$series, step)
  if (length(step) > 1L || step == 0 || reverses(counts_of(record$series[[1]], step))) {
    return(record)
  }
  y <- replace(record$series[[1]], is.nan(record$series[[1]]), NA)
  edges <- edges_of(list(
    rates_only = FALSE, omega = NULL, step = step, theta = y, segment = segment,
    time_s = record$time_s, core = list(floor = step / sqrt(12), clock = seq_len(n))
  ))
  if (is.null(edges)) return(record)
  time <- edges$core$time_s
  value <- edges$core$theta
  rest <- edges$core$slow %||% rep(0, length(time)) > 0
  keep <- !rest | !c(FALSE, rest[-length(rest)])
  # The rate beside an edge, by its neighbours.
  m <- length(time)
  before <- pmax(seq_len(m) - 1L, 1L)
  behind <- pmin(seq_len(m) + 1L, m)
  rate <- abs(value[behind] - value[before]) / (time[behind] - time[before])
  off <- ifelse(is.na(edges$interval), 1, pmin(rate * edges$interval / step, 1))
  # Not less than a twentieth of a count: the clock has an error, too.
  record$weight <- list(pmax(off, 0.05)[keep])
  record$time_s <- time[keep]
  record$series[[1]] <- value[keep]
  names(record$weight) <- names(record$series)
  record$count <- NULL
  record$all <- record$series
  record
}
