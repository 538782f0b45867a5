# The times at which a motion passes a value, and its extremes. They are bracketed between the times
# of a grid and refined by runs of the model at the bracketed times; no row is interpolated.

# ---- the motion at any time ---------------------------------------------------------------------

# A function of times, in any order: the columns of the motion there, of one body where the rows
# have an index (`body`).
motion_reader <- function(run, body, call) {
  record <- record_of(run)
  constraint <- constraint_of(run$scene)
  function(time_s) {
    order <- order(time_s)
    times <- time_s[order]
    result <- record$run(
      run$solved, times, run$accuracy, run$max_steps + length(times), call, TRUE
    )
    if (result$info$kind != "none") failed_run(result$info, length(times), "abort", call)
    columns <- result$columns
    if (!is.null(constraint$more_columns)) {
      columns <- constraint$more_columns(columns, run$scene, times)
    }
    rows <- order(order)
    if (!is.null(constraint$index)) {
      each <- constraint$rows_per_time(run$scene)
      rows <- (rows - 1L) * each + body
    }
    lapply(columns, `[`, rows)
  }
}

# ---- the grid -----------------------------------------------------------------------------------

# Times so dense that between two of them a quantity has one extreme at most: breaks and events,
# times that double their distance from these, and 16 for each cycle of the fastest swing. NULL
# where the cycles are too many.
search_times <- function(run, from_s, to_s) {
  time_scales <- time_scales_of(run)
  cycles <- time_scales$swing_rad_per_s * (to_s - from_s) / (2 * pi)
  if (!is.finite(cycles) || cycles > 1e4) return(NULL)
  marks <- sort(unique(c(time_scales$breaks_s, run$events$time_s, run$scene$start_s)))
  inside <- function(t) t[t > from_s & t < to_s]
  fades <- graded_times(marks, run$scene$start_s, time_scales$fades_s, from_s, to_s)
  ends <- unique(c(from_s, inside(marks), to_s))
  # Pieces of their own: an eighth, and closer to their ends.
  parts <- c(2^-(12:4), seq_len(15) / 16, 1 - 2^-(4:12))
  n <- length(ends)
  pieces <- if (n <= 2000L) outer(diff(ends), parts) + ends[-n]
  intervals <- 129 + ceiling(16 * cycles)
  even <- from_s + (to_s - from_s) * (seq_len(intervals - 1) / intervals)
  sort(unique(c(from_s, inside(c(marks, fades, pieces, even)), to_s)))
}

# Times that double their distance from where the motion is disturbed: a panel much longer than the
# shortest time would miss what fades after it. `anchors`: breaks, events and the start, increasing.
graded_times <- function(anchors, start_s, shortest_s, from_s, to_s) {
  if (!is.finite(shortest_s)) return(double())
  anchors <- c(min(from_s, anchors[1]), anchors, max(to_s, anchors[length(anchors)]))
  begin <- anchors[-length(anchors)]
  end <- anchors[-1]
  long <- end - begin > 50 * shortest_s & end > from_s & begin < to_s
  unlist(Map(function(begin, end) {
    first <- max(shortest_s, (end - begin) * 2^-1000) # 2^1024 is no double
    away <- first * 2^seq.int(-1, floor(log2((end - begin) / first)))
    if (end <= start_s) end - away else begin + away
  }, begin[long], end[long]))
}

# As R/constraints.R says; of constraints that do not say, nothing that hurries.
time_scales_of <- function(run) {
  time_scales <- constraint_of(run$scene)$time_scales
  if (is.null(time_scales)) return(list(breaks_s = double(), fades_s = Inf, swing_rad_per_s = 0))
  time_scales(run$scene, run$info$sizes, run$model)
}

# ---- zeros --------------------------------------------------------------------------------------

# A zero of f in each bracket, f(from) f(to) < 0, to 2 roundings of the time, all brackets at once.
# Chandrupatla, Adv. Eng. Software 28 (1997) 145: inverse quadratic steps, halvings where they fail.
zeros_between <- function(f, from, to, f_from, f_to) {
  n <- length(from)
  zero <- double(n)
  x1 <- to
  x2 <- x3 <- from
  f1 <- f_to
  f2 <- f3 <- f_from
  part <- rep(0.5, n)
  open <- seq_len(n)
  for (step in seq_len(300L)) {
    if (!length(open)) break
    x <- x1 + part * (x2 - x1)
    fx <- f(x)
    same <- sign(fx) == sign(f1)
    x3 <- ifelse(same, x1, x2)
    f3 <- ifelse(same, f1, f2)
    x2 <- ifelse(same, x2, x1)
    f2 <- ifelse(same, f2, f1)
    x1 <- x
    f1 <- fx
    best <- ifelse(abs(f1) < abs(f2), x1, x2)
    minimum <- (.Machine$double.eps * abs(best) + 1e-300) / abs(x2 - x1)
    done <- !(minimum < 0.5) | f1 == 0 | is.nan(f1)
    zero[open[done]] <- ifelse(f1 == 0, x1, best)[done]
    xi <- (x1 - x2) / (x3 - x2)
    phi <- (f1 - f2) / (f3 - f2)
    part <- f1 / (f2 - f1) * f3 / (f2 - f3) +
      (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
    smooth <- phi^2 < xi & (1 - phi)^2 < 1 - xi & is.finite(part)
    part <- ifelse(smooth & !is.na(smooth), part, 0.5)
    part <- pmin(pmax(part, minimum), 1 - minimum)
    keep <- !done
    open <- open[keep]
    x1 <- x1[keep]
    x2 <- x2[keep]
    x3 <- x3[keep]
    f1 <- f1[keep]
    f2 <- f2[keep]
    f3 <- f3[keep]
    part <- part[keep]
  }
  zero[open] <- x1
  zero
}

# ---- extremes and passages ----------------------------------------------------------------------

# A column at the times of the grid and at its extremes between them: list(time_s, value, extreme).
search_column <- function(read, slopes, column, time_s) {
  columns <- read(time_s)
  value <- columns[[column]]
  slope <- if (!is.null(slopes)) slopes(columns)[[column]]
  at <- if (is.null(slope)) {
    extremes_by_values(read, column, time_s, value)
  } else {
    turns <- which(changes_sign(slope))
    zeros_between(
      function(t) slopes(read(t))[[column]], time_s[turns], time_s[turns + 1L], slope[turns],
      slope[turns + 1L]
    )
  }
  # At rest, and where what fades has come to its end within rounding.
  same <- abs(diff(value)) <= 4 * .Machine$double.eps * abs(value[-1])
  flat <- c(FALSE, same) | c(same, FALSE)
  if (!is.null(slope)) flat <- flat | slope == 0
  all <- c(time_s, at)
  order <- order(all)
  list(
    time_s = all[order], value = c(value, if (length(at)) read(at)[[column]])[order],
    extreme = c(flat, rep(TRUE, length(at)))[order]
  )
}

# The largest value of each column (the least of those in `least`) within the span of the rows, and
# the first time there: list(value, time_s), named. Of values that the run did not compute, and
# where the model does not run again, those of the rows, with a warning.
largest_values <- function(x, run, columns, call, minimum = character()) {
  rows <- unclass(x)[intersect(columns, names(x))]
  found <- list(time_s = x$time_s, columns = rows)
  span <- x$time_s[!is.na(x$time_s)]
  if (length(span) && is.finite(run$info$error)) {
    again <- tryCatch(
      search_extremes(run, columns, range(span), call),
      rotdyn_error = function(e) tell_rows_only(e, call)
    )
    found <- again %||% found
  }
  at <- Map(function(value, name) {
    if (name %in% minimum) value <- -value
    top <- suppressWarnings(max(value))
    which(value >= top - 4 * .Machine$double.eps * abs(top))[1]
  }, found$columns, names(found$columns))
  list(
    value = Map(function(value, i) value[i], found$columns, at),
    time_s = lapply(at, function(i) found$time_s[i])
  )
}

tell_rows_only <- function(error, call) {
  why <- cli::ansi_strip(rlang::cnd_header(error))
  warn_rotdyn(c(
    "The maxima are those of the rows: between them the model does not run again.", x = "{why}"
  ), "failed", call)
  NULL
}

# list(time_s, columns): the columns at the times of the grid and at the extremes of any of them.
search_extremes <- function(run, columns, span, call) {
  grid <- if (span[1] == span[2]) span[1] else search_times(run, span[1], span[2])
  if (is.null(grid)) return(NULL)
  constraint <- constraint_of(run$scene)
  read <- motion_reader(run, 1L, call)
  slopes <- if (!is.null(constraint$slopes)) function(x) constraint$slopes(x, run$scene)
  found <- lapply(columns, function(column) search_column(read, slopes, column, grid)$time_s)
  time_s <- sort(unique(unlist(found)))
  list(time_s = time_s, columns = read(time_s)[columns])
}

# Where the slope is unknown: the middle of three closes in on the extreme, to the root of the
# precision in time.
extremes_by_values <- function(read, column, time_s, value) {
  n <- length(time_s)
  if (n < 3L) return(double())
  i <- 1L + which(diff(sign(diff(value))) != 0 & diff(value)[-1] != 0)
  if (!length(i)) return(double())
  from <- time_s[i - 1L]
  to <- time_s[i + 1L]
  top <- sign(value[i] - value[i - 1L])
  for (zoom in 1:14) {
    parts <- outer(to - from, seq_len(7L) / 8) + from
    values <- matrix(read(as.vector(parts))[[column]], nrow = length(i)) * top
    best <- max.col(values, ties.method = "first")
    width <- (to - from) / 8
    at <- parts[cbind(seq_along(i), best)]
    from <- at - width
    to <- at + width
  }
  at
}

# Between which elements the sign changes. A product of small numbers would be 0.
changes_sign <- function(x) {
  sign <- sign(x)
  sign[-1] * sign[-length(sign)] < 0
}

# The times at which the column is `value`: list(time_s, direction). `close`: the relative error of
# the column; an extreme or an end closer to the value, relative to the distances around, touches
# it: what fades away keeps its passages. Where it stays at the value, the first time.
passages <- function(read, slopes, column, value, time_s, close) {
  found <- search_column(read, slopes, column, time_s)
  off <- found$value - value
  near <- close * around(abs(off), 16L) +
    4 * .Machine$double.eps * pmax(abs(found$value), abs(value))
  n <- length(off)
  end <- seq_len(n) %in% c(1L, n)
  off[(found$extreme | end) & abs(off) <= near] <- 0
  here <- which(off == 0 & c(TRUE, off[-n] != 0))
  between <- which(changes_sign(off))
  zeros <- zeros_between(
    function(t) read(t)[[column]] - value, found$time_s[between], found$time_s[between + 1L],
    off[between], off[between + 1L]
  )
  # Before and after a time of the grid, where it is not the value.
  before <- vapply(here, function(i) last(c(0, sign(off[seq_len(i)][off[seq_len(i)] != 0]))), 0)
  after <- sign(off[pmin(here + 1L, n)])
  direction <- function(from, to) {
    ifelse(from < 0 & to > 0, "up", ifelse(from > 0 & to < 0, "down", "reached"))
  }
  order <- order(c(found$time_s[here], zeros))
  list(
    time_s = c(found$time_s[here], zeros)[order],
    direction = c(
      direction(before, after), ifelse(off[between] < 0, "up", "down")
    )[order]
  )
}

# The largest of each element and those up to `reach` places from it.
around <- function(x, reach) {
  n <- length(x)
  out <- x
  for (away in seq_len(min(reach, n - 1L))) {
    out <- pmax(out, c(x[-seq_len(away)], rep(0, away)), c(rep(0, away), x[seq_len(n - away)]))
  }
  out
}

# The relative error of a column: that of the measure, that of the run else.
column_error <- function(run, column) {
  measures <- constraint_of(run$scene)$measures
  of <- names(measures)[vapply(measures, function(m) column %in% m$columns, NA)]
  error <- if (length(of)) run$info$errors[[of[1]]] / run$info$sizes[[of[1]]] else run$info$error
  max(if (is.finite(error)) error else 0, 8 * .Machine$double.eps)
}
