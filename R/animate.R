# Motions in space as moving pictures. A constraint joins by solid(scene): list of
#   points    n x 3: corners of a convex body, along its axes, in m or in parts of the largest
#   faces     list: the corners of each side, in order
#   fill      a colour for each; edged: whether its edge is drawn
#   tip       the point of the body whose path is shown
#   rod       NULL, or 2 x 3: a line from the origin to where it enters the body
#   held      TRUE: the origin is a fixed point, with the vertical through it
# or, where it moves in a plane, by frames(scene, rows): for each time of the rows of its motion
# list(marks, limits), as in a drawing (R/draw.R), and perhaps `says`, a word on the state.

#' Animate a motion
#'
#' A body that moves, as a moving picture: an animated GIF, for slides, or, of a body that turns in
#' space, an interactive WebGL page that the mouse turns. A body in space is shown as the
#' homogeneous box with its moments of inertia, or as the cylinder where two of them are equal; the
#' sides have colours, so that turns show. Arrows are the angular velocity and the angular momentum;
#' a thin line is the path of a point of the body.
#'
#' Other motions are shown as [autoplot()][autoplot.rot_scene] draws their scene. A body on an
#' incline is to scale, with arrows of its velocity and of the friction on it; where the path is
#' longer than 14 radii, the picture follows the body past marks a radius apart. Rotors in a line,
#' seen from the side, have a stripe, blue, that comes to the front once a turn.
#'
#' The frames are evenly spaced in time, and each is computed by the model of the motion, as
#' [predict()][predict.rot_trajectory] does: none is interpolated.
#'
#' @param motion From [trajectory()]. It is shown from its first row to its last.
#' @param file A file to write, ending in `.gif`, by the package gifski. NULL gives the interactive
#'   page, by the package rgl, of a body that turns in space.
#' @param ... Not used; names after it must be given in full.
#' @param frames_per_s Frames in a second of the film, 1 to 50. In a GIF the time of a frame is a
#'   whole number of hundredths of a second.
#' @param slow_motion How many seconds of film one second of the motion takes: 1 as it is, 10 ten
#'   times as slow, 0.1 ten times as fast.
#' @param width_px Width and height in pixels, 64 to 2000.
#' @return With a `file`, its path, invisibly. Otherwise a page, which a console, a notebook and R
#'   Markdown show, and `htmltools::save_html()` stores.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value` (also for more than 2000 frames),
#'   `rotdyn_error_time` for a motion of fewer than two times, `rotdyn_error_file`,
#'   `rotdyn_error_package` without gifski or rgl; `rotdyn_error_unit`,
#'   `rotdyn_error_argument`, and those of [predict()][predict.rot_trajectory].
#' @seealso [axis_path()], [polhode()], [autoplot.rot_trajectory()], [roll_race()] for frames of a
#'   race.
#' @concept animation
#' @concept gif
#' @concept webgl
#' @examples
#' nut <- trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), time_s = c(0, 12))
#' if (requireNamespace("gifski", quietly = TRUE)) {
#'   file <- animate_motion(nut, tempfile(fileext = ".gif"), frames_per_s = 5, width_px = 160)
#'   file.size(file)
#' }
#' if (interactive() && requireNamespace("rgl", quietly = TRUE)) animate_motion(nut)
#' @export
animate_motion <- function(motion, file = NULL, ..., frames_per_s = 25, slow_motion = 1,
                           width_px = 480) {
  call <- check_no_dots(...)
  check_supplied("motion", call)
  run <- check_trajectory(motion, "motion", call)
  constraint <- constraint_of(run$scene)
  in_space <- !is.null(constraint$solid)
  if (!in_space && is.null(constraint$frames)) {
    abort_rotdyn(c(
      "{.arg motion} must be one of a scene that has moving pictures.",
      x = "It is of a {.cls {class(run$scene)[1]}}."
    ), "type", call)
  }
  if (!in_space && is.null(file)) {
    abort_rotdyn(c(
      "The interactive page shows bodies that turn in space.",
      x = "{.arg motion} is of a {.cls {class(run$scene)[1]}}.",
      i = "With a {.arg file} it becomes a GIF."
    ), "type", call)
  }
  rate <- check_number(frames_per_s, "frames_per_s", "Hz", call, lower = 1, upper = 50)
  slow <- check_number(slow_motion, "slow_motion", "1", call, lower = 0, open = TRUE)
  width <- round(check_number(width_px, "width_px", "1", call, lower = 64, upper = 2000))
  if (is.null(file)) {
    need_rgl("The interactive animation", call)
    need_package("htmltools", "The interactive animation", call)
    frame_s <- 1 / rate
  } else {
    file <- check_gif_name(file, call)
    frame_s <- round(100 / rate) / 100
  }
  time_s <- film_times(motion, frame_s / slow, call)
  if (!is.null(file)) need_package("gifski", "A GIF", call)
  rows <- stats::predict(motion, time_s)
  film <- if (in_space) {
    space_film(rows, constraint$solid(run$scene))
  } else {
    plane_film(constraint$frames(run$scene, rows))
  }
  film$time_s <- time_s
  film$slow <- slow
  if (is.null(file)) return(film_widget(film, frame_s, width))
  draw <- if (in_space) draw_frame else draw_plane_frame
  write_gif(file, length(time_s), function(i) draw(film, i), width, frame_s, call)
  invisible(file)
}

# The pictures that draw(i) makes, i from 1 to n, each for delay_s.
write_gif <- function(file, n, draw, width_px, delay_s, call) {
  folder <- tempfile("frames")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  before <- grDevices::dev.cur()
  grDevices::png(file.path(folder, "%05d.png"), width_px, width_px)
  device <- grDevices::dev.cur()
  shut <- function() {
    if (device %in% grDevices::dev.list()) grDevices::dev.off(device)
    if (before %in% grDevices::dev.list()) grDevices::dev.set(before)
  }
  on.exit(shut(), add = TRUE, after = FALSE)
  for (i in seq_len(n)) draw(i)
  shut()
  write_file(gif_bytes(folder, width_px, delay_s, call), file, call)
}

# The GIF of the pictures in a folder, made there. The encoder prints what is wrong and goes on
# without damaged pictures.
gif_bytes <- function(folder, width_px, delay_s, call) {
  pictures <- list.files(folder, full.names = TRUE)
  gif <- file.path(folder, "film.gif")
  fault <- "The disk is full, perhaps."
  whole <- length(pictures) && all(vapply(pictures, ends_with, NA, png_end))
  if (whole) {
    fault <- tryCatch({
      gifski::gifski(pictures, gif, width_px, width_px, delay_s, progress = FALSE)
      ""
    }, error = conditionMessage)
    whole <- !nzchar(fault) && ends_with(gif, as.raw(0x3b))
  }
  if (whole) return(readBin(gif, "raw", file.size(gif)))
  # Space that is left shows that the disk is not the reason.
  probe <- tempfile("space", dirname(folder))
  on.exit(unlink(probe))
  full <- put_file(raw(2^20), probe)
  abort_rotdyn(c(
    "The pictures of the GIF cannot be stored in {.file {dirname(folder)}}.",
    x = braces_doubled(if (nzchar(full)) full else fault)
  ), "file", call)
}

png_end <- as.raw(c(0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82)) # IEND and its checksum

ends_with <- function(path, bytes) {
  size <- file.size(path)
  if (is.na(size) || size < length(bytes)) return(FALSE)
  con <- file(path, "rb")
  on.exit(close(con))
  seek(con, size - length(bytes))
  identical(readBin(con, "raw", length(bytes)), bytes)
}

check_gif_name <- function(file, call) {
  path <- check_file_name(file, call)
  if (!grepl("\\.gif$", path, ignore.case = TRUE)) {
    abort_rotdyn(c(
      "{.arg file} must end in {.file .gif}.", x = "It is {.file {path}}.",
      i = "Without {.arg file} there is an interactive page."
    ), "value", call)
  }
  path
}

# A homogeneous box, or a cylinder where two moments are equal, with these principal moments along
# `axes` (columns): in m where the mass is known. Nothing is thinner than a twentieth of the
# longest, so that plates and rods have sides.
solid_of_inertia <- function(moments, axes, mass_kg = NULL) {
  second <- pmax(sum(moments) / 2 - moments, 0)
  if (all(second == 0)) second[] <- 1
  if (is.null(mass_kg)) mass_kg <- 3 * max(second)
  equal <- c(abs(diff(moments[2:3])), abs(diff(moments[c(1, 3)])), abs(diff(moments[1:2])))
  along <- which(equal <= 1e-6 * max(moments))
  round <- length(along) == 1L
  semi <- sqrt(3 * second / mass_kg)
  if (round) semi[-along] <- 2 * sqrt(mean(second[-along]) / mass_kg)
  semi <- pmax(semi, max(semi) / 20)
  solid <- if (round) unit_cylinder(along) else unit_box()
  solid$points <- solid$points %*% (semi * t(axes))
  solid$semi <- semi
  solid
}

solid_fills <- list(
  near = c("#F2C879", "#A5CFEA", "#D3BFE2"), far = c("#C79A45", "#6FA6CB", "#A88BC0")
)

# The sides along the three axes have three colours, and dark ones at their negative ends.
unit_box <- function() {
  points <- as.matrix(expand.grid(c(-1, 1), c(-1, 1), c(-1, 1)))
  sides <- expand.grid(sense = c(-1, 1), axis = 1:3)
  list(
    points = unname(points),
    faces = lapply(seq_len(nrow(sides)), function(k) {
      which(points[, sides$axis[k]] == sides$sense[k])[c(1, 2, 4, 3)]
    }),
    fill = ifelse(sides$sense > 0, solid_fills$near[sides$axis], solid_fills$far[sides$axis]),
    edged = TRUE
  )
}

# About an axis, in quarters of two colours.
unit_cylinder <- function(along) {
  n <- 32L
  angle <- 2 * pi * (seq_len(n) - 1) / n
  ring <- cbind(cos(angle), sin(angle))
  across <- setdiff(1:3, along)
  points <- matrix(0, 2 * n + 2, 3)
  points[seq_len(n), c(across, along)] <- cbind(ring, 1)
  points[n + seq_len(n), c(across, along)] <- cbind(ring, -1)
  points[2 * n + 1:2, along] <- c(1, -1)
  at <- function(i) (i - 1) %% n + 1
  quarter <- (seq_len(n) - 1) %/% (n / 4) + 1
  caps <- lapply(1:8, function(k) {
    from <- (k - 1) %% 4 * n / 4
    low <- k > 4
    c(2 * n + 1 + low, low * n + at(from + seq_len(n / 4 + 1)))
  })
  walls <- lapply(seq_len(n), function(i) c(i, at(i + 1), n + at(i + 1), n + i))
  near <- rep(solid_fills$near[1:2], 2)
  far <- rep(solid_fills$far[1:2], 2)
  list(
    points = points, faces = c(caps, walls), fill = c(near, far, near[c(2, 1, 2, 1)][quarter]),
    edged = rep(c(TRUE, FALSE), c(8L, n))
  )
}

# The principal axes of a scene, in columns.
axes_of <- function(scene) {
  if (scene$axes[1] == 1) diag(3) else matrix_of_quaternion(scene$axes, "axes", NULL)
}

free_solid <- function(scene) {
  axes <- axes_of(scene)
  solid <- solid_of_inertia(scene$moment_of_inertia_kg_m2, axes)
  along <- as.vector(scene$omega0_rad_per_s %*% axes)
  maximum <- which.max(abs(along))
  side <- if (along[maximum] < 0) -1 else 1
  c(solid, list(tip = side * 1.25 * solid$semi[maximum] * axes[, maximum], held = FALSE))
}

# The moments are about the fixed point: those about the centre of mass are less.
pivot_solid <- function(scene) {
  centre <- scene$centre_m
  mass <- scene$mass_kg
  long <- sqrt(sum(centre^2))
  at_centre <- free_tensor(scene) - mass * (long^2 * diag(3) - outer(centre, centre))
  principal <- eigen(at_centre, symmetric = TRUE)
  axes <- principal$vectors
  moments <- pmax(principal$values, 0)
  solid <- if (!(mass > 0)) {
    solid_of_inertia(scene$moment_of_inertia_kg_m2, axes_of(scene))
  } else if (max(moments) > 1e-9 * mass * long^2) {
    solid_of_inertia(moments, axes, mass)
  } else { # a point, on a rod without mass
    solid_of_inertia(rep(mass * (0.1 * long)^2, 3), diag(3), mass)
  }
  if (long == 0) return(c(solid, list(tip = axes[, 1] * max(solid$semi) * 1.25, held = TRUE)))
  # The ends of the body along the line to the centre of mass.
  ends <- 1 + range(solid$points %*% centre) / long^2
  solid$points <- solid$points + rep(centre, each = nrow(solid$points))
  c(solid, list(
    tip = centre * ends[2], rod = if (ends[1] > 0) rbind(0, centre * ends[1]), held = TRUE
  ))
}

# ---- the frames ---------------------------------------------------------------------------------

max_frames <- 2000

film_times <- function(motion, step_s, call) {
  known <- motion$time_s[is.finite(motion$time_s)]
  ends <- if (length(known)) range(known) else c(0, 0)
  if (!(diff(ends) > 0)) {
    abort_rotdyn("{.arg motion} must have rows at two times or more.", "time", call)
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
        "A smaller {.arg slow_motion} gives fewer, and so do fewer rows of {.arg motion}."
      }
    ), "value", call)
  }
  ends[1] + step_s * (seq_len(n) - 1)
}

space_film <- function(rows, solid) {
  n <- nrow(rows)
  columns <- function(names) unname(do.call(cbind, unclass(rows)[names]))
  turned <- attitude_to(rows[quaternion_columns], "matrix")
  arrows <- list(omega = columns(free_rates("space_")), L = columns(free_momenta))
  film <- list(
    solid = solid, turn = array(t(as.matrix(turned)), c(3, 3, n)),
    radius = sqrt(max(rowSums(rbind(solid$points, solid$tip)^2)))
  )
  # The longest of each arrow ends beyond the body.
  film$arrows <- Map(function(v, reach) {
    size <- max(sqrt(rowSums(v^2)))
    if (size > 0) v * (reach * film$radius / size)
  }, arrows, c(1.3, 1.15))
  film$path <- turned_points(film, rbind(solid$tip))
  film
}

# Points of the body in space, frame by frame: n x 3 for one point; (points x n) x 3 otherwise.
turned_points <- function(film, points) {
  # turn[j, i, k]: element (i, j) of the matrix of frame k.
  out <- apply(film$turn, 3, function(m) points %*% m)
  if (nrow(points) == 1L) return(t(out))
  matrix(aperm(array(out, c(nrow(points), 3, dim(film$turn)[3])), c(1, 3, 2)), ncol = 3)
}

frame_turn <- function(film, i) t(film$turn[, , i])

# view_of_space(), and the way towards the reader.
whole_view <- function() {
  view <- view_of_space()
  rbind(view, c(
    view[1, 2] * view[2, 3] - view[1, 3] * view[2, 2],
    view[1, 3] * view[2, 1] - view[1, 1] * view[2, 3],
    view[1, 1] * view[2, 2] - view[1, 2] * view[2, 1]
  ))
}

arrow_colours <- c(omega = "#0072B2", L = "#009E73")

# Seen as autoplot() of the scene shows it: what lies behind the body is drawn before it.
draw_frame <- function(film, i) {
  view <- whole_view()
  toward <- view[3, ]
  flat <- function(points) points %*% t(view[1:2, ])
  turn <- frame_turn(film, i)
  solid <- film$solid
  room <- 1.35 * film$radius
  old <- graphics::par(mar = c(0, 0, 0, 0), bg = "white")
  on.exit(graphics::par(old))
  graphics::plot.new()
  graphics::plot.window(c(-room, room), c(-room, room), asp = 1)
  path <- film$path[seq_len(i), , drop = FALSE]
  in_front <- as.vector(path %*% toward) > 0
  draw_path <- function(hidden) {
    path[hidden, ] <- NA
    graphics::lines(flat(path), col = "#AA4499", lwd = 1.2)
  }
  arrow <- function(name, before) {
    v <- film$arrows[[name]][i, ]
    if ((sum(v * toward) < 0) != before) return()
    ends <- flat(rbind(0, v))
    if (sum((ends[2, ] - ends[1, ])^2) < (0.02 * room)^2) return()
    graphics::arrows(
      ends[1, 1], ends[1, 2], ends[2, 1], ends[2, 2], length = 0.11, angle = 20, lwd = 2.6,
      col = arrow_colours[[name]]
    )
  }
  if (solid$held) {
    graphics::lines(flat(rbind(c(0, 0, -0.3), c(0, 0, 1.2)) * film$radius), col = "grey60", lty = 2)
  }
  draw_path(in_front)
  for (name in names(film$arrows)) arrow(name, TRUE)
  points <- solid$points %*% t(turn)
  rod <- if (!is.null(solid$rod)) solid$rod %*% t(turn)
  # The fixed end lies on this side of the body, or behind it.
  ahead <- !is.null(rod) && sum(colMeans(points) * toward) < 0
  draw_rod <- function() graphics::lines(flat(rod), col = "grey25", lwd = 3)
  if (!is.null(rod) && !ahead) draw_rod()
  draw_solid(solid, points, flat, toward)
  if (ahead) draw_rod()
  for (name in names(film$arrows)) arrow(name, FALSE)
  draw_path(!in_front)
  if (solid$held) graphics::points(0, 0, pch = 16, cex = 1.1)
  graphics::text(-room, 0.97 * room, expression(omega), col = arrow_colours[["omega"]],
                 adj = c(0, 1), cex = 1.3)
  graphics::text(-0.88 * room, 0.97 * room, "L", col = arrow_colours[["L"]], adj = c(0, 1),
                 cex = 1.3)
  film_text(film, i, room)
}

# A convex body: the sides that are turned to the reader are all that is seen.
draw_solid <- function(solid, points, flat, toward) {
  middle <- colMeans(points)
  edged <- rep_len(solid$edged, length(solid$faces))
  for (k in seq_along(solid$faces)) {
    side <- points[solid$faces[[k]], ]
    first <- side[2, ] - side[1, ]
    second <- side[3, ] - side[1, ]
    normal <- c(
      first[2] * second[3] - first[3] * second[2], first[3] * second[1] - first[1] * second[3],
      first[1] * second[2] - first[2] * second[1]
    )
    # The order of the corners has either sense.
    if (sum(normal * toward) * sum(normal * (colMeans(side) - middle)) <= 0) next
    fill <- solid$fill[k]
    graphics::polygon(flat(side), col = fill, border = if (edged[k]) "grey25" else fill, lwd = 1)
  }
}

film_text <- function(film, i, room) {
  step <- film$time_s[2] - film$time_s[1]
  shown <- formatC(film$time_s[i], format = "f", digits = max(0, ceiling(-log10(step))))
  graphics::text(-room, -0.97 * room, paste("t =", shown, "s"), adj = c(0, 0))
  speed <- if (film$slow > 1) {
    paste0("1/", format(signif(film$slow, 3)), " of the speed")
  } else if (film$slow < 1) {
    paste(format(signif(1 / film$slow, 3)), "times as fast")
  }
  if (length(speed)) graphics::text(room, -0.97 * room, speed, adj = c(1, 0))
}

# ---- in the plane -------------------------------------------------------------------------------

plane_film <- function(frames) {
  limits <- vapply(frames, function(one) as.double(one$limits), double(4))
  list(
    marks = lapply(frames, `[[`, "marks"),
    says = vapply(frames, function(one) one$says %||% "", ""),
    limits = c(min(limits[1, ]), max(limits[2, ]), min(limits[3, ]), max(limits[4, ]))
  )
}

# The marks as draw_mark() (R/draw.R) draws them; a frame of ggplot2 would take ten times as long.
draw_plane_frame <- function(film, i) {
  box <- film$limits
  middle <- c(mean(box[1:2]), mean(box[3:4]))
  room <- max(diff(box[1:2]), diff(box[3:4])) / 2
  old <- graphics::par(mar = c(0, 0, 0, 0), bg = "white")
  on.exit(graphics::par(old))
  graphics::plot.new()
  graphics::plot.window(c(-room, room), c(-room, room), asp = 1)
  for (one in film$marks[[i]]) {
    points <- sweep(one$points, 2, middle)
    dashed <- one$style %in% c("dashed", "hole")
    if (one$type == "fill") {
      graphics::polygon(points, col = draw_fills[[one$style]], border = "grey25",
                        lty = if (dashed) 2 else 1)
      next
    }
    colour <- if (dashed) "grey50" else draw_colours[[one$style]]
    graphics::lines(points, col = colour, lty = if (dashed) 2 else 1, lwd = 2)
    n <- nrow(points)
    if (one$type == "arrow" && sum((points[n, ] - points[n - 1L, ])^2) > 1e-6 * room^2) {
      graphics::arrows(points[n - 1L, 1], points[n - 1L, 2], points[n, 1], points[n, 2],
                       length = 0.11, angle = 20, lwd = 2, col = colour)
    }
  }
  graphics::text(-room, 0.97 * room, film$says[i], adj = c(0, 1))
  film_text(film, i, room)
}

# ---- the page -----------------------------------------------------------------------------------

# Each object is drawn once; a player moves its vertices.
film_widget <- function(film, frame_s, width_px) {
  old <- options(rgl.useNULL = TRUE)
  on.exit(options(old))
  device <- rgl::open3d(useNULL = TRUE)
  on.exit(rgl::close3d(device), add = TRUE, after = FALSE)
  n <- length(film$time_s)
  film_s <- frame_s * (seq_len(n) - 1)
  control <- function(points, draw) {
    each <- nrow(points) / n
    id <- draw(points[seq_len(each), , drop = FALSE])
    values <- t(apply(array(points, c(each, n, 3)), 2, as.vector))
    rgl::vertexControl(
      values = values, vertices = rep(seq_len(each), 3), objid = id, param = film_s,
      attributes = rep(c("x", "y", "z"), each = each)
    )
  }
  solid <- film$solid
  triangles <- lapply(solid$faces, function(at) rbind(at[1], at[-c(1, length(at))], at[-(1:2)]))
  colour <- rep(solid$fill, 3L * vapply(triangles, ncol, 0L))
  controls <- list(control(
    turned_points(film, solid$points[unlist(triangles), ]),
    function(points) rgl::triangles3d(points, col = colour, lit = FALSE)
  ))
  segment <- function(ends, colour) {
    control(ends, function(points) rgl::segments3d(points, col = colour, lwd = 4, lit = FALSE))
  }
  for (name in names(film$arrows)) {
    ends <- array(0, c(2, n, 3))
    ends[2, , ] <- film$arrows[[name]]
    controls <- c(controls, list(segment(matrix(ends, ncol = 3), arrow_colours[[name]])))
  }
  if (!is.null(solid$rod)) {
    controls <- c(controls, list(segment(turned_points(film, solid$rod), "grey25")))
  }
  rgl::lines3d(film$path, col = "#AA4499", lit = FALSE)
  if (solid$held) {
    rgl::segments3d(cbind(0, 0, c(-0.3, 1.2) * film$radius), col = "grey60", lit = FALSE)
  }
  # The view: a box about all that moves.
  room <- 1.3 * film$radius
  rgl::points3d(expand.grid(c(-room, room), c(-room, room), c(-room, room)), alpha = 0)
  rgl::view3d(userMatrix = rbind(cbind(whole_view(), 0), c(0, 0, 0, 1)), zoom = 0.6)
  id <- paste0("rotdyn", basename(tempfile("")))
  htmltools::browsable(htmltools::tagList(
    rgl::rglwidget(rgl::scene3d(), width = width_px, height = width_px, elementId = id),
    rgl::playwidget(
      id, controls, start = 0, stop = film_s[n], interval = frame_s,
      components = c("Reverse", "Play", "Slower", "Faster", "Reset", "Slider")
    )
  ))
}
