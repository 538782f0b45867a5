# A race as moving picture: each body on its lane, which falls as the incline does, with its name
# and the time of its arrival. R/plot-race.R draws the same wheels at some times beside each other.

# A body of a race in units of `unit`, its radius: a wheel with the hole that its beta says, a block
# where it does not turn.
racer_marks <- function(x, y, unit, angle, beta) {
  if (!isTRUE(beta > 0)) {
    return(list(mark("fill", draw_box(x, y, 2 * unit, 1.6 * unit), "body")))
  }
  wheel_marks(x, y, unit, angle, hole_of_beta(beta))
}

race_plan <- function(race, call) {
  about <- attr(race, "race", exact = TRUE)
  if (is.null(about) || !all(race_columns %in% names(race))) {
    abort_rotdyn("These rows are no race any more.", "type", call)
  }
  list(
    ends = known_ends(race[["time_s"]], call),
    film = function(time_s) race_film(about, time_s)
  )
}

# The bodies that a picture has room for, the first to arrive on top.
shown_racers <- function(about) utils::head(order(about$starts$finish_time_s), 12L)

race_film <- function(about, time_s) {
  rows <- .Call(ffi_incline_frames, about$starts, as.double(time_s), NULL)
  bodies <- length(about$starts$finish_time_s)
  of <- function(column) matrix(column, nrow = bodies)
  x <- of(rows$x_m)
  v <- of(rows$v_m_per_s)
  theta <- of(rows$theta_rad)
  shown <- shown_racers(about)
  named <- make.unique(race_labels(about)[shown], " ")
  lengths <- rep_len(about$columns$length_m, bodies)
  angles <- rep_len(about$columns$incline_angle_deg, bodies) * pi / 180
  beta <- about$objects[["beta"]]
  # Steep lanes would make a tall picture: they fall by 35 degrees at most in it.
  lean <- pmin(pmax(angles, -35 * pi / 180), 35 * pi / 180)
  long <- max(lengths)
  unit <- long / max(14, 2.2 * length(shown))
  finish_s <- about$starts$finish_time_s
  at <- function(k, s) {
    lane <- shown[k]
    c(s * cos(lean[lane]), -s * sin(lean[lane]) - 3.1 * unit * (k - 1))
  }
  out <- function(k) c(sin(lean[shown[k]]), cos(lean[shown[k]]))
  ground <- lapply(seq_along(shown), function(k) {
    ends <- rbind(at(k, -1.4 * unit), at(k, lengths[shown[k]] + 1.4 * unit))
    mark("fill", rbind(ends, ends[2:1, ] - rep(0.25 * unit * out(k), each = 2)), "fixed")
  })
  flags <- lapply(seq_along(shown), function(k) {
    foot <- at(k, lengths[shown[k]])
    mark("line", rbind(foot, foot + 2.3 * unit * out(k)), "dashed")
  })
  names <- do.call(rbind, lapply(seq_along(shown), function(k) {
    foot <- at(k, -1.8 * unit) + 0.9 * unit * out(k)
    word_at(named[k], foot[1], foot[2], 1)
  }))
  frames <- lapply(seq_along(time_s), function(i) {
    bodies <- lapply(seq_along(shown), function(k) {
      lane <- shown[k]
      centre <- at(k, x[lane, i]) + unit * out(k)
      racer_marks(centre[1], centre[2], unit, pi / 2 - lean[lane] - theta[lane, i], beta[lane])
    })
    done <- which(finish_s[shown] <= time_s[i])
    times <- lapply(done, function(k) {
      foot <- at(k, lengths[shown[k]] + 2.1 * unit) + 1.1 * unit * out(k)
      word_at(paste(format_si(signif(finish_s[shown[k]], 3)), "s"), foot[1], foot[2], 0, "speed")
    })
    list(
      marks = c(ground, flags, do.call(c, bodies)),
      labels = do.call(rbind, c(list(names), times)),
      says = if (length(done)) {
        paste("arrived:", paste(named[done], collapse = ", "))
      } else {
        "all on the way"
      }
    )
  })
  falls <- vapply(seq_along(shown), function(k) at(k, lengths[shown[k]])[2], 0)
  starts <- vapply(seq_along(shown), function(k) at(k, 0)[2], 0)
  wide <- unit * (2.5 + 0.6 * max(nchar(named)))
  frames <- lapply(frames, function(one) {
    c(one, list(limits = c(
      -wide, long * max(cos(lean[shown])) + 6.5 * unit, min(falls, starts) - 1.2 * unit,
      max(falls, starts) + 2.8 * unit
    )))
  })
  values <- lapply(seq_len(min(length(shown), max_values)), function(k) {
    list(label = paste("path,", named[k]), unit = "m", x = x[shown[k], ])
  })
  key <- quantity("", "A hole shows that the mass is at the rim; the bodies are not to scale.", "")
  plane_film(frames, race_title(about), values, key)
}

race_title <- function(about) {
  angle <- unique(about$columns$incline_angle_deg)
  paste0(
    "A race from rest", if (length(angle) == 1L) paste0(" down ", format_si(angle), " degrees")
  )
}
