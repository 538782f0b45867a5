# Films: the frames of a motion, as every writer takes them (R/animate-page.R, R/animate-video.R,
# autoplot() of an animation). A film is list of
#   title, alt    what it shows, in a line and in a sentence
#   time_s        of each frame; slow, frame_s: seconds of film for one of the motion, for a frame
#   space         TRUE: marks and labels are in space (R/draw-space.R), else in the plane (R/draw.R)
#   box           c(left, right, bottom, top)
#   frames        list(marks, labels, says) for each time; labels: symbol, x, y, (z,) style
#   key           quantity() rows of what does not change; "" as value of what does
#   values        list(label, unit, x): numbers shown beside the picture, one for each time
# A constraint joins by solid(scene) (R/draw-space.R) or by frames(scene, rows): for each time of
# the rows list(marks, limits), as in a drawing, and perhaps `labels`, `quantities`, and `says`, a
# word on the state.

max_frames <- 2000

# Frames from one time to another, step_s apart, the last one at the end. `through`: a time that one
# of them has, where the ends may move by less than a step.
film_times <- function(ends, step_s, call, through = NULL) {
  if (!is.null(through)) {
    ends <- through + step_s * trunc((ends - through) / step_s * (1 + 1e-12))
  }
  n <- floor(diff(ends) / step_s * (1 + 1e-12)) + 1
  if (n < 2 || n > max_frames) {
    film_s <- signif(diff(ends), 3)
    abort_rotdyn(c(
      "The film must have 2 to {max_frames} frames.",
      x = "It has {format(n, big.mark = ',')}: the motion takes {film_s} s.",
      i = if (n < 2) {
        "A larger {.arg slow_motion} gives more."
      } else {
        "A smaller {.arg slow_motion} gives fewer, and so do fewer rows of {.arg x}."
      }
    ), "value", call)
  }
  times <- ends[1] + step_s * (seq_len(n) - 1)
  if (!is.null(through)) times[which.min(abs(times - through))] <- through
  if (ends[2] - times[n] > 1e-9 * step_s) times <- c(times, ends[2]) else times[n] <- ends[2]
  times
}

# NULL: as it is, where the film then takes 1 to 60 s; else a round number that makes it 4 to 10 s.
round_slow_motion <- function(span_s) {
  if (span_s >= 1 && span_s <= 60) return(1)
  minimum <- 4 / span_s
  power <- 10^floor(log10(minimum))
  power * c(1, 2, 5, 10)[which(c(1, 2, 5, 10) * power >= minimum * (1 - 1e-9))[1]]
}

# What a class shows: ends and perhaps `through`, for film_times(), and film(time_s).
film_plan <- function(x, call) {
  if (inherits(x, "rot_race")) return(race_plan(x, call))
  if (inherits(x, "rot_collision")) return(collision_plan(x, call))
  run <- check_trajectory(x, "x", call)
  constraint <- constraint_of(run$scene)
  if (is.null(constraint$solid) && is.null(constraint$frames)) {
    abort_rotdyn(c(
      "{.arg x} must be a motion of a scene that has moving pictures.",
      x = "It is of a {.cls {class(run$scene)[1]}}."
    ), "type", call)
  }
  known <- x$time_s[is.finite(x$time_s)]
  list(
    ends = known_ends(known, call),
    film = function(time_s) motion_film(x, run, constraint, time_s)
  )
}

known_ends <- function(time_s, call) {
  ends <- if (length(time_s)) range(time_s) else c(0, 0)
  if (!(diff(ends) > 0)) {
    abort_rotdyn("{.arg x} must have rows at two times or more.", "time", call)
  }
  ends
}

motion_film <- function(motion, run, constraint, time_s) {
  rows <- stats::predict(motion, time_s)
  scene <- run$scene
  title <- constraint$title(run)
  values <- motion_values(rows, constraint)
  if (!is.null(constraint$solid)) {
    return(space_film(rows, constraint$solid(scene), title, values, constraint$drawing(scene)))
  }
  drawing <- if (!is.null(constraint$drawing)) constraint$drawing(scene)
  plane_film(
    constraint$frames(scene, rows), drawing$title %||% title, values, drawing$quantities
  )
}

# ---- numbers beside the picture -----------------------------------------------------------------

max_values <- 6L

# The columns of the panels of a motion, as far as there is room: whole panels, a line for each
# value of the index.
motion_values <- function(rows, constraint) {
  panels <- choose_panels(constraint, NULL, names(rows), NULL)
  index <- constraint$index
  out <- list()
  for (one in panels) {
    columns <- one$columns[names(one$columns) %in% names(rows)]
    added <- unlist(lapply(names(columns), function(name) {
      lines <- if (is.null(index)) list(rows[[name]]) else split(rows[[name]], rows[[index]])
      lapply(seq_along(lines), function(k) {
        words <- trimws(c(columns[[name]], if (length(lines) > 1L) paste(index, k)))
        list(
          label = paste(c(sub(" \\(.*", "", one$label), words[nzchar(words)]), collapse = ", "),
          unit = sub("^[^(]*\\(?([^)]*)\\)?$", "\\1", one$label), x = as.double(lines[[k]])
        )
      })
    }), recursive = FALSE)
    added <- Filter(function(one) any(is.finite(one$x)), added)
    if (length(out) + length(added) > max_values && length(out)) break
    out <- c(out, utils::head(added, max_values))
  }
  out
}

# ---- films --------------------------------------------------------------------------------------

plane_film <- function(frames, title, values = list(), quantities = NULL) {
  limits <- vapply(frames, function(one) as.double(one$limits), double(4))
  key <- moving_key(quantities)
  list(
    title = title, space = FALSE, key = key, values = values,
    frames = lapply(frames, function(one) {
      list(
        marks = one$marks, labels = moving_labels(one$labels, one$quantities %||% quantities),
        says = one$says %||% ""
      )
    }),
    box = c(min(limits[1, ]), max(limits[2, ]), min(limits[3, ]), max(limits[4, ]))
  )
}

# What a scene has at its start is the present one in a film: theta[0] is theta, without a value.
moving_symbol <- function(symbol) sub("\\[0\\]$", "", symbol)

moving_key <- function(quantities) {
  if (is.null(quantities)) return(NULL)
  starts <- grepl(" at start$", quantities$name)
  quantities$symbol[starts] <- moving_symbol(quantities$symbol[starts])
  quantities$name[starts] <- sub(" at start$", "", quantities$name[starts])
  quantities$value[starts] <- ""
  quantities
}

# In space, what the arrows show changes as well.
space_key <- function(quantities) {
  key <- moving_key(quantities)
  key$value[key$symbol %in% c("omega", "L")] <- ""
  key
}

moving_labels <- function(labels, quantities) {
  if (is.null(labels) || !nrow(labels)) return(NULL)
  if (is.null(labels[["style"]])) {
    key <- match(labels$symbol, quantities$symbol)
    any_of <- match(sub("\\[.*", "[i]", labels$symbol), quantities$symbol)
    key[is.na(key)] <- any_of[is.na(key)]
    labels$style <- quantities$style[key]
    labels$style[is.na(labels$style)] <- "body"
  }
  labels$symbol <- moving_symbol(labels$symbol)
  labels
}

space_film <- function(rows, solid, title = "", values = list(), drawing = NULL) {
  columns <- function(names) unname(do.call(cbind, unclass(rows)[names]))
  turned <- as.matrix(attitude_to(rows[quaternion_columns], "matrix"))
  look <- space_look(
    solid, list(omega = columns(free_rates("space_")), L = columns(free_momenta))
  )
  turns <- lapply(seq_len(nrow(rows)), function(i) matrix(turned[i, ], 3L, byrow = TRUE))
  path <- do.call(rbind, lapply(turns, function(turn) as.vector(turn %*% solid$tip)))
  room <- space_room(look)
  list(
    title = title, space = TRUE, key = space_key(drawing$quantities), values = values,
    frames = lapply(seq_along(turns), function(i) {
      c(space_frame(look, turns[[i]], i, path), says = "")
    }),
    box = c(-room, room, -room, room), look = look
  )
}

# The i-th frame in the plane: list(marks, labels, says).
flat_frame <- function(film, i) {
  frame <- film$frames[[i]]
  if (!film$space) return(frame)
  list(
    marks = project_marks(frame$marks), says = frame$says,
    labels = if (!is.null(frame$labels)) project_labels(frame$labels, label_gap * film$look$radius)
  )
}

# "1/10 of the speed", "5 times as fast", "".
speed_words <- function(slow) {
  if (slow > 1) {
    paste0("1/", format(signif(slow, 3)), " of the speed")
  } else if (slow < 1) {
    paste(format(signif(1 / slow, 3)), "times as fast")
  } else {
    ""
  }
}

# Digits of the time that tell frames apart, two more where the last one is between two steps.
film_time_digits <- function(film) {
  step <- film$time_s[2] - film$time_s[1]
  digits <- max(0, ceiling(-log10(step) - 1e-9))
  exact <- all(abs(film$time_s - round(film$time_s, digits)) < 1e-3 * step)
  digits + if (exact) 0 else 2
}

# A paragraph on the whole, for readers who do not see it.
film_alt <- function(film) {
  ends <- format_si(signif(film$time_s[c(1, length(film$time_s))], 4))
  said <- vapply(film$values, function(one) {
    x <- one$x[is.finite(one$x)]
    if (!length(x)) return("")
    last <- one$x[length(one$x)]
    paste0(
      one$label, " ", range_in_words(x), if (nzchar(one$unit)) paste0(" ", one$unit),
      ", at last ", format_si(signif(last, 3))
    )
  }, "")
  says <- unique(vapply(film$frames, `[[`, "", "says"))
  says <- says[nzchar(says)]
  paste0(
    "Animation. ", film$title, ", from ", ends[1], " to ", ends[2], " s. ",
    if (any(nzchar(said))) paste0(sentence(paste(said[nzchar(said)], collapse = "; ")), ". "),
    if (length(says) && length(says) < 4L) {
      paste0("It says in turn: ", paste(says, collapse = ", "), ". ")
    }
  )
}
