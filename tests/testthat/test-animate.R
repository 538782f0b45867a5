nut <- function(...) trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), ...)

spinning_top <- function(...) {
  scene_pivot(
    place_body(body_disk(2, 0.15), c(0, 0, 0.15)), c(0, 0, 60),
    attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle"), ...
  )
}

# The JSON of a page, read by the package that reads JSON.
film_of_page <- function(lines) {
  from <- which(lines == "<script type=\"application/json\">")
  to <- which(lines == "</script>")
  lapply(from, function(at) {
    text <- paste(lines[(at + 1L):(min(to[to > at]) - 1L)], collapse = "")
    yyjsonr::read_json_str(text, yyjsonr::opts_read_json(obj_of_arrs_to_df = FALSE,
      arr_of_objs_to_df = FALSE))
  })
}

# Of arrays of one length the reader makes a matrix.
item_of <- function(x, i) if (is.matrix(x)) x[i, ] else x[[i]]

test_that("frames are evenly spaced, and the last one is at the end", {
  expect_equal(film_times(c(1, 5), 0.25, NULL), seq(1, 5, by = 0.25))
  expect_equal(film_times(c(0, 1.1), 0.25, NULL), c(0, 0.25, 0.5, 0.75, 1, 1.1))
  expect_identical(film_times(c(0, 0.3), 0.1, NULL)[4], 0.3)
  # Through the contact of a collision.
  times <- film_times(c(-1, 1), 0.3, NULL, 0)
  expect_equal(times, 0.3 * (-3:3))
  expect_identical(times[4], 0)
  slow <- vapply(c(1, 30, 0.01, 2e-3, 600), round_slow_motion, 0)
  expect_identical(slow, c(1, 1, 500, 2000, 0.01))
})

test_that("a page has all in itself, its frames and the numbers of the last row", {
  skip_if_not_installed("yyjsonr")
  path <- tempfile(fileext = ".html")
  on.exit(unlink(path))
  motion <- trajectory(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1), seq(0, 2.05, 0.05))
  shown <- withVisible(animate_motion(motion, path, frames_per_s = 10))
  expect_false(shown$visible)
  expect_identical(shown$value, path)
  lines <- readLines(path, encoding = "UTF-8")
  text <- paste(lines, collapse = "\n")
  # Namespaces are names; nothing is loaded, nor could code be.
  urls <- regmatches(text, gregexpr("https?://[^\"' ]*", text))[[1]]
  expect_setequal(urls, "http://www.w3.org/2000/svg")
  expect_false(grepl("(src|href)=\"(?!data:)", text, perl = TRUE))
  expect_false(grepl("@import|url\\(|fetch\\(|XMLHttpRequest|import ", text))
  for (word in c("<title>A pendulum: a rod on a fixed axle</title>", "aria-live=\"polite\"",
                 "<noscript>",
                 "prefers-reduced-motion", "aria-label=\"time\"")) {
    expect_true(grepl(word, text, fixed = TRUE), label = word)
  }
  # Tags are closed.
  for (tag in c("div", "p", "ul", "li", "table", "button", "script", "style", "select", "span")) {
    count <- function(what) lengths(regmatches(text, gregexpr(what, text)))
    expect_identical(count(paste0("<", tag, "[ >]")), count(paste0("</", tag, ">")), label = tag)
  }
  film <- film_of_page(lines)[[1]]
  expect_length(film$time, 22)
  expect_identical(film$time[22], 2.05)
  rows <- predict(motion, film$time)
  expect_identical(film$values[[1]]$x, signif(rows$theta_rad, 5))
  last <- motion[nrow(motion), ]
  expect_identical(film$values[[1]]$x[22], signif(last$theta_rad, 5))
  expect_identical(film$values[[2]]$x[22], signif(last$omega_rad_per_s, 5))
  expect_true(grepl(paste0("to 1 rad, at last ", signif(last$theta_rad, 3)), text, fixed = TRUE))
  expect_identical(film_time_digits(list(time_s = film$time)), 3)
  expect_identical(film_time_digits(list(time_s = 0:3 / 4)), 1 + 2)
})

test_that("what a page draws is what the frames have", {
  skip_if_not_installed("yyjsonr")
  scene <- scene_incline(body_sphere(1, 0.1), 30, static_friction = 0.1)
  page <- animate_motion(trajectory(scene, c(0, 1)), frames_per_s = 5)
  frames <- page$film$frames
  film <- film_of_page(format(page))[[1]]
  grid <- grid_of(page$film$box, FALSE)
  # The points of a track in a frame, as the script finds them.
  points_of <- function(track, i) {
    p <- if (!is.null(track[["f"]])) item_of(track[["f"]], i) else track[["p"]]
    if (identical(as.double(unlist(p)), 0)) return(NULL)
    if (is.list(p)) {
      a <- p$a
      angle <- seq(a[4], a[5], length.out = 181) * pi / 180
      p <- as.vector(rbind(a[1] + a[3] * cos(angle), a[2] + a[3] * sin(angle)))
    }
    p <- matrix(p, ncol = 2, byrow = TRUE)
    if (is.null(track[["of"]])) return(p)
    map <- matrix(item_of(film$moves, track[["of"]] + 1), 6)[, i]
    cbind(p, 1) %*% rbind(map[1:2] / 1e4, map[3:4] / 1e4, map[5:6])
  }
  slots <- film_slots(frames)
  expect_length(film$marks, length(slots))
  for (i in c(1, length(frames))) {
    for (k in seq_along(slots)) {
      one <- slots[[k]][[i]]
      got <- points_of(film$marks[[k]], i)
      expect_identical(is.null(got), is.null(one))
      if (is.null(one)) next
      want <- grid$to(one$points)
      expect_lt(max(abs(apply(got, 2, range) - apply(want, 2, range))), 2)
    }
  }
})

test_that("a label has its letter and its index apart", {
  skip_if_not_installed("yyjsonr")
  ball <- scene_incline(body_sphere(1, 0.1), 30, static_friction = 0.1, omega0_rad_per_s = 0)
  page <- animate_motion(trajectory(ball, c(0, 1)), frames_per_s = 2)
  text <- rotdyn:::labels_json(page$film)
  expect_true(any(grepl("\"t\":[\"F\",\"f\"]", text, fixed = TRUE)))
  expect_true(any(grepl("\"t\":[\"mg\",\"\"]", text, fixed = TRUE)))
})

test_that("arcs and maps stand for points", {
  arc <- as_arc(draw_arc(1, 2, 3, 30, -140))
  expect_equal(arc, c(1, 2, 3, 30, -140))
  expect_equal(diff(unname(as_arc(draw_circle(0, 1, 2)))[4:5]), 360)
  expect_null(as_arc(draw_box(0, 0, 1, 2)))
  expect_null(as_arc(cbind(1:20, 1:20)))
  expect_null(as_arc(matrix(1, 20, 2)))
  expect_null(as_arc(draw_circle(0, 0, 1) %*% diag(c(1, 2))))
  points <- draw_box(0, 0, 100, 300)
  turned <- lapply(c(0, 0.3, 2), function(a) {
    points %*% rbind(c(cos(a), sin(a)), c(-sin(a), cos(a))) + 100 * a
  })
  maps <- affine_maps(turned)
  expect_equal(maps[2, ], c(cos(0.3), sin(0.3), -sin(0.3), cos(0.3), 30, 30), tolerance = 1e-9)
  bent <- turned
  bent[[2]][1, 1] <- bent[[2]][1, 1] + 5
  expect_null(affine_maps(bent))
})

test_that("every scene, race and collision has a page with pictures and words", {
  skip_on_cran() # exhaustive: `make test` runs it
  skip_if_not_installed("yyjsonr")
  ball <- body_sphere(0.06, 0.033)
  cases <- list(
    trajectory(scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03, coulomb_n_m = 0.1)), c(0, 2)),
    trajectory(scene_axle(inertia_knots(c(0, 1), c(4, 1)), omega0_rad_per_s = 2), c(0, 2)),
    trajectory(scene_rotors(c(1, 2), 500, omega0_rad_per_s = c(3, 3)), c(0, 1)),
    trajectory(scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(4, 0)), c(0, 1)),
    trajectory(scene_drive(c(1, 2), coupling_shaft(50), omega0_rad_per_s = c(2, 2)), c(0, 1)),
    trajectory(scene_gears(c(0.01, 0.5), ratios = -5, torque = c(2, 0)), c(0, 1)),
    trajectory(scene_hanging_mass(body_disk(2, 0.1), 2, 0.1, counter_mass_kg = 1), c(0, 1)),
    trajectory(scene_hoop(0.05, 0.2, 9, theta0_rad = 1), c(0, 1)),
    trajectory(scene_chain(c(1, 1), c(1, 1), theta0_rad = c(2, 2)), c(0, 1)),
    trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01), rotors = rotor("z", 0.1, 30)), c(0, 1)),
    trajectory(spinning_top(), c(0, 1)),
    roll_race(c("hoop", "sliding_point", "sphere"), static_friction = 0.15),
    ball_bounce(ball, 20, -5, -300, restitution = 0.75, friction = 0.5),
    collide(ball, ball, velocity_1_m_per_s = c(1, 0.2, 0), normal = c(-1, 0, 0)),
    hinged_hit(body_rod(2, 1.2), 0.6, 1.2, particle_mass_kg = 0.05, particle_v_m_per_s = 30),
    disks_lock(1, 3, omega_1_rad_per_s = 60, omega_2_rad_per_s = 0),
    rims_meet(body_disk(1, 0.1), body_disk(2, 0.2), 10, 0)
  )
  ids <- character()
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (one in cases) {
    page <- animate_motion(one, frames_per_s = 4)
    lines <- format(page)
    ids <- c(ids, grep("class=\"rotdyn-film\"", lines, value = TRUE))
    film <- film_of_page(lines)[[1]]
    expect_gt(length(film$marks), 1)
    expect_identical(length(film$values[[1]]$x), length(film$time))
    expect_match(page$film$alt, "^Animation[.] .*at last")
    for (label in film$labels) expect_true(NROW(label$at) %in% c(1L, length(film$time)))
    if (requireNamespace("ggplot2", quietly = TRUE)) {
      expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(page)))
    }
  }
  expect_identical(anyDuplicated(ids), 0L)
})

test_that("a race ends where the rows do, and a collision is as computed", {
  race <- roll_race(c("hoop", "disk", "sphere"), length_m = 2)
  film <- animate_motion(race)$film
  expect_equal(vapply(film$values, function(one) one$x[length(one$x)], 0), rep(2, 3))
  expect_identical(film$frames[[length(film$frames)]]$says, "arrived: sphere, disk, hoop")
  expect_identical(film$frames[[1]]$says, "all on the way")
  # Lanes are in the order of the finish.
  expect_identical(film$values[[1]]$label, "path, sphere")
  bounce <- ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, restitution = 0.75, friction = 0.5)
  film <- animate_motion(bounce)$film
  speed <- film$values[[1]]$x
  expect_equal(speed[1], sqrt(20^2 + 5^2))
  expect_equal(speed[length(speed)], sqrt(bounce$vx_m_per_s^2 + bounce$vy_m_per_s^2))
  expect_equal(film$values[[2]]$x[c(1, length(speed))], c(300, -bounce$omega_rad_per_s))
  # The ball touches the floor at time 0.
  at <- which(film$time_s == 0)
  balls <- vapply(film$frames, function(one) {
    min(Filter(function(m) m$style == "#A5CFEA", one$marks)[[1]]$points[, 2])
  }, 0)
  expect_equal(balls[at], 0)
  expect_true(all(balls[-at] > 0))
  # A hinged rod turns about its hinge.
  hit <- hinged_hit(body_rod(2, 1.2), 0.6, 1.2, particle_mass_kg = 0.05, particle_v_m_per_s = 30)
  film <- animate_motion(hit)$film
  bars <- lapply(film$frames, function(one) {
    Filter(function(m) m$style == "#A5CFEA", one$marks)[[1]]$points
  })
  expect_equal(vapply(bars, function(p) sqrt(sum((colMeans(p) + c(1.2, 0))^2)), 0),
    rep(0.6, length(bars)))
})

test_that("videos are whole, and an encoder's empty file is an error", {
  skip_if_not_installed("gifski")
  motion <- nut(time_s = c(0, 1))
  if (requireNamespace("av", quietly = TRUE)) {
    for (end in c(".mp4", ".webm")) {
      path <- tempfile(fileext = end)
      animate_motion(motion, path, frames_per_s = 5, width_px = 81)
      expect_true(is_film(path, substring(end, 2)))
      expect_equal(av::av_media_info(path)$video$width, 82)
      unlink(path)
    }
  }
  path <- tempfile(fileext = ".gif")
  writeBin(raw(0), path)
  expect_false(is_film(path, "gif"))
  writeBin(as.raw(rep(1, 600)), path)
  expect_false(is_film(path, "mp4"))
  expect_false(is_film(path, "webm"))
  unlink(path)
  # An encoder that writes an empty file and raises nothing, and one that writes none.
  folder <- tempfile("frames")
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  grDevices::png(file.path(folder, "1.png"), 64, 64)
  draw_film_frame(animate_motion(motion)$film, 1)
  grDevices::dev.off()
  bytes <- function(kind, encode) encoded_bytes(folder, kind, 64, 0.1, NULL, encode)
  empty <- function(pictures, made, ...) file.create(made)
  for (kind in c("gif", "mp4", "webm")) {
    expect_error(bytes(kind, empty), "empty or a damaged", class = "rotdyn_error_file")
    unlink(file.path(folder, paste0("film.", kind)))
    expect_error(bytes(kind, function(...) NULL), "empty or", class = "rotdyn_error_file")
  }
})

test_that("an animation prints, and stands in documents", {
  skip_if_not_installed("knitr")
  page <- animate_motion(roll_race(c("hoop", "sphere")), frames_per_s = 10)
  expect_output(print(page), "rot_animation.*frames from 0 to")
  on.exit(knitr::opts_knit$restore())
  knitr::opts_knit$set(rmarkdown.pandoc.to = "html")
  out <- paste(knit_print.rot_animation(page), collapse = "")
  expect_match(out, "```\\{=html\\}")
  expect_match(out, "<script type=\"application/json\">", fixed = TRUE)
  again <- paste(knit_print.rot_animation(page), collapse = "")
  id <- function(text) sub(".*class=\"rotdyn-film\" id=\"([^\"]*)\".*", "\\1", text)
  expect_false(id(out) == id(again))
  # In print its last frame, with its words.
  old <- setwd(tempdir())
  on.exit(setwd(old), add = TRUE)
  knitr::opts_knit$set(rmarkdown.pandoc.to = "latex")
  out <- paste(knit_print.rot_animation(page), collapse = "")
  expect_match(out, "!\\[Animation[.] A race from rest down 20 degrees.*\\]\\(.*pdf\\)")
  expect_gt(file.size(sub(".*\\]\\((.*)\\).*", "\\1", trimws(out))), 1000)
})

test_that("GIF files have the frames and the delay asked for", {
  skip_if_not_installed("gifski")
  path <- tempfile(fileext = ".gif")
  on.exit(unlink(path))
  devices <- grDevices::dev.list()
  shown <- withVisible(
    animate_motion(nut(time_s = c(0, 1)), path, frames_per_s = 10, width_px = 80)
  )
  expect_false(shown$visible)
  expect_identical(shown$value, path)
  # The control block of a frame: its time in hundredths of a second, low byte first.
  frames <- function(hundredths) {
    bytes <- paste(readBin(path, "raw", file.size(path)), collapse = "")
    length(gregexpr(sprintf("21f904[0-9a-f]{2}%02x00[0-9a-f]{2}002c", hundredths), bytes)[[1]])
  }
  expect_identical(frames(10), 11L)
  head <- as.integer(readBin(path, "raw", 10))
  expect_identical(rawToChar(as.raw(head[1:6])), "GIF89a")
  expect_identical(head[7:10], c(80L, 0L, 80L, 0L))
  slow <- file.size(path)
  animate_motion(nut(time_s = c(0, 1)), path, frames_per_s = 10, slow_motion = 2, width_px = 80)
  expect_identical(frames(10), 21L)
  expect_gt(file.size(path), 1.3 * slow) # pictures that differ
  top <- trajectory(spinning_top(), c(0, 0.2))
  animate_motion(top, path, frames_per_s = 5, slow_motion = 5, width_px = 80)
  expect_identical(frames(20), 6L)
  # The open device stays the one it was.
  expect_identical(grDevices::dev.list(), devices)
})

test_that("a body on an axle is drawn at its angle", {
  motion <- trajectory(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = pi / 3), c(0, 2))
  scene <- attr(motion, "run")$scene
  rows <- predict(motion, c(0, 0.3, 0.9))
  frames <- constraint_of(scene)$frames(scene, rows)
  expect_length(frames, 3)
  # The rod is the longest line of the body, from the axle down.
  angle <- vapply(frames, function(frame) {
    lines <- Filter(function(one) one$type == "line" && one$style == "body", frame$marks)
    ends <- vapply(lines, function(one) one$points[nrow(one$points), ], c(0, 0))
    low <- ends[, which.max(colSums(ends^2))]
    atan2(low[1], -low[2])
  }, 0)
  expect_equal(angle, rows$theta_rad, tolerance = 1e-12)
  skip_if_not_installed("gifski")
  path <- tempfile(fileext = ".gif")
  on.exit(unlink(path))
  animate_motion(motion, path, frames_per_s = 5, width_px = 80)
  expect_gt(file.size(path), 1000)
})

test_that("other motions in a plane are drawn at their angles", {
  frames_of <- function(scene, time_s) {
    motion <- trajectory(scene, c(0, max(time_s)))
    run <- attr(motion, "run")
    rows <- predict(motion, time_s)
    list(rows = rows, frames = constraint_of(run$scene)$frames(run$scene, rows))
  }
  lines_of <- function(frame, style) {
    keep <- Filter(function(one) one$type == "line" && one$style == style, frame$marks)
    lapply(keep, `[[`, "points")
  }
  spokes <- function(frame) {
    lines <- lines_of(frame, "body")
    vapply(lines, function(p) atan2(p[2, 2] - p[1, 2], p[2, 1] - p[1, 1]), 0)
  }
  same_turn <- function(got, want) expect_equal(sin((got - want) / 2), 0 * want, tolerance = 1e-9)
  t <- c(0, 0.2, 0.5)
  # Wheels of a train turn by theta/ratio: 5, then -3.
  train <- frames_of(scene_gears(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4)), t)
  theta <- train$rows$theta_rad
  for (i in 2:3) same_turn(spokes(train$frames[[i]]), theta[i] * c(1, 1 / 5, -1 / 15))
  # The masses of Atwood's machine move by equal lengths, the heavy one down.
  atwood <- frames_of(scene_hanging_mass(body_disk(2, 0.1), 2, 0.1, counter_mass_kg = 1), t)
  ends <- vapply(atwood$frames, function(one) {
    vapply(lines_of(one, "spring")[1:2], function(p) p[2, 2], 0)
  }, c(0, 0))
  expect_equal(colSums(ends), rep(-2, 3))
  expect_equal(diff(ends[1, ]) / diff(atwood$rows$theta_rad), rep(diff(ends[1, 1:2]) /
    diff(atwood$rows$theta_rad[1:2]), 2))
  expect_lt(ends[1, 3], ends[1, 1])
  same_turn(spokes(atwood$frames[[3]]), atwood$rows$theta_rad[3])
  # The stripe is at the top at first, and comes down in front by 1 - cos theta.
  shaft <- frames_of(scene_rotors(c(1, 2), 500, omega0_rad_per_s = c(3, 3)), t)
  for (i in 1:3) {
    y <- vapply(lines_of(shaft$frames[[i]], "speed"), function(p) p[1, 2], 0)
    expect_equal(y / y[2], c(0.5^0.25, 1))
    expect_equal(y[2], 0.75 * cos(3 * t[i]))
  }
  pair <- frames_of(scene_clutch(2, 3, capacity_n_m = 12, omega0_rad_per_s = c(4, 0)), t)
  y <- vapply(lines_of(pair$frames[[3]], "speed"), function(p) p[1, 2], 0)
  expect_equal(y[1], 0.75 * (2 / 3)^0.25 * cos(pair$rows$theta_1_rad[3]))
  drive <- frames_of(scene_drive(c(1, 2), coupling_shaft(50), omega0_rad_per_s = c(2, 2)), t)
  y <- vapply(lines_of(drive$frames[[3]], "speed"), function(p) p[1, 2], 0)
  expect_equal(y, 0.75 * c(0.5^0.25, 1) * cos(1))
  # The arms of a skater are at the radius of gyration.
  arms <- inertia_knots(c(0, 1), c(4, 1))
  skater <- frames_of(scene_axle(arms, omega0_rad_per_s = 2), c(0, 1))
  reach <- vapply(skater$frames, function(one) {
    sqrt(sum(lines_of(one, "body")[[1]][2, ]^2))
  }, 0)
  expect_equal(reach, c(1, 0.5))
})

test_that("a body on an incline is drawn to scale, where it is and as it is turned", {
  frames_of <- function(scene, time_s) {
    motion <- trajectory(scene, c(0, max(time_s)))
    rows <- predict(motion, time_s)
    list(rows = rows, frames = incline_frames(attr(motion, "run")$scene, rows))
  }
  of <- function(frame, type, style) {
    Filter(function(one) one$type == type && one$style == style, frame$marks)
  }
  circle <- function(frame) of(frame, "fill", "body")[[1]]$points
  # A ball that slips at first: 20 cm wide, 30 degrees.
  ball <- frames_of(
    scene_incline(body_sphere(1, 0.1), 30, static_friction = 0.1), c(0, 0.3, 0.6)
  )
  centre <- vapply(ball$frames, function(one) colMeans(circle(one)[-1, ]), c(0, 0))
  size <- diff(range(circle(ball$frames[[1]])[, 1])) / 2
  # One scale for lengths: the centre moves x/r radii, down the slope.
  gone <- diff(ball$rows$x_m) / 0.1 * size
  expect_equal(diff(t(centre)), cbind(gone * cos(pi / 6), -gone * sin(pi / 6)))
  for (i in 1:3) {
    ray <- of(ball$frames[[i]], "line", "body")[[1]]$points
    turned <- pi / 3 - atan2(diff(ray[, 2]), diff(ray[, 1]))
    expect_equal(sin((turned - ball$rows$theta_rad[i]) / 2), 0, tolerance = 1e-9)
  }
  expect_identical(vapply(ball$frames, `[[`, "", "says"), rep("slips", 3))
  # Friction acts up the slope, the ball moves down.
  arrow <- function(style) diff(of(ball$frames[[3]], "arrow", style)[[1]]$points)
  expect_lt(arrow("resistance")[1], 0)
  expect_gt(arrow("speed")[1], 0)
  # A long path: the ball stays in the middle, the marks go by.
  far <- frames_of(
    scene_incline(body_sphere(6, 0.11), 0, static_friction = 0.2, v0_m_per_s = 5), c(0, 0.5, 1.5)
  )
  centre <- vapply(far$frames, function(one) colMeans(circle(one)[-1, ]), c(0, 0))
  expect_equal(centre[1, ], rep(centre[1, 1], 3))
  expect_identical(far$frames[[3]]$says, "rolls")
  ticks <- vapply(of(far$frames[[2]], "line", "shaft"), function(one) {
    one$points[1, 1]
  }, 0)
  expect_equal(diff(ticks), rep(1 / 6, length(ticks) - 1))
  stations <- ticks * 6 + far$rows$x_m[2] / 0.11
  expect_equal(stations, round(stations))
  skip_if_not_installed("gifski")
  path <- tempfile(fileext = ".gif")
  on.exit(unlink(path))
  animate_motion(
    trajectory(scene_incline(body_sphere(1, 0.1), 30, static_friction = 0.1), c(0, 0.6)), path,
    frames_per_s = 5, width_px = 80
  )
  expect_gt(file.size(path), 1000)
})

test_that("bad arguments are errors", {
  motion <- nut(time_s = c(0, 1))
  error <- function(code, kind) expect_error(code, class = paste0("rotdyn_error_", kind))
  error(animate_motion(), "missing")
  error(animate_motion(1), "type")
  error(animate_motion(scene_axle(2)), "type")
  error(animate_motion(roll_race()[1:3, c("time_s", "x_m")]), "type")
  error(animate_motion(roll_race(time_s = 1)), "time")
  error(animate_motion(motion, "a.avi"), "value")
  skip_if_not_installed("ggplot2")
  error(autoplot.rot_animation(animate_motion(motion), time_s = NA), "type")
  error(animate_motion(motion, 1), "type")
  error(animate_motion(motion, "a.gif", 25), "argument")
  error(animate_motion(motion, "a.gif", frames_per_s = 51), "value")
  error(animate_motion(motion, "a.gif", slow_motion = 0), "value")
  error(animate_motion(motion, "a.gif", width_px = 10), "value")
  error(animate_motion(motion, "a.gif", slow_motion = 1e4), "value")
  error(animate_motion(motion, "a.gif", slow_motion = 1e-4), "value")
  error(animate_motion(nut(time_s = 1), "a.gif"), "time")
  error(animate_motion(motion[0, ], "a.gif"), "time")
  skip_if_not_installed("gifski")
  for (name in c(file.path(tempfile(), "a.gif"), paste0(strrep("long ", 2000), ".gif"))) {
    expect_no_warning(
      error(animate_motion(motion, name, frames_per_s = 2, width_px = 64), "file")
    )
  }
  expect_null(grDevices::dev.list())
  # Of two open devices, the one that was in use stays so.
  grDevices::pdf(NULL)
  mine <- grDevices::dev.cur()
  grDevices::pdf(NULL)
  other <- grDevices::dev.cur()
  on.exit(for (one in c(mine, other)) grDevices::dev.off(one))
  grDevices::dev.set(mine)
  path <- tempfile(fileext = ".gif")
  on.exit(unlink(path), add = TRUE)
  animate_motion(motion, path, frames_per_s = 2, width_px = 64)
  expect_identical(grDevices::dev.cur(), mine)
})

test_that("the window of a frame holds the whole box, and not much more", {
  swing <- scene_pendulum(body_rod(1, 1), 0.5, theta0_rad = 1)
  film <- animate_motion(trajectory(swing, 0:4 / 4))$film
  grDevices::pdf(NULL, 5, 5)
  on.exit(grDevices::dev.off())
  draw_film_frame(film, 1)
  window <- graphics::par("usr")
  middle <- c(mean(film$box[1:2]), mean(film$box[3:4]))
  half <- max(diff(film$box[1:2]), diff(film$box[3:4])) / 2
  expect_true(all(abs(window) >= half & abs(window) < 1.2 * half))
})
