nut <- function(...) trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), ...)

spinning_top <- function(...) {
  scene_pivot(
    place_body(body_disk(2, 0.15), c(0, 0, 0.15)), c(0, 0, 60),
    attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle"), ...
  )
}

test_that("frames are those of the model, evenly spaced", {
  motion <- nut(time_s = c(1, 3, 5))
  scene <- attr(motion, "run")$scene
  times <- film_times(motion, 0.25, NULL)
  expect_equal(times, seq(1, 5, by = 0.25))
  film <- space_film(predict(motion, times), free_solid(scene))
  want <- predict(motion, 3.25)
  turn <- matrix(unlist(attitude_to(want[quaternion_columns], "matrix")), 3, byrow = TRUE)
  expect_identical(frame_turn(film, 10), turn)
  expect_equal(film$path[10, ], as.vector(turn %*% film$solid$tip))
  # L stays where it is; omega does not.
  expect_equal(film$arrows$L[1, ], film$arrows$L[17, ], tolerance = 1e-13)
  expect_gt(max(abs(film$arrows$omega[1, ] - film$arrows$omega[8, ])), 0.01)
  points <- turned_points(film, film$solid$points)
  expect_equal(points[9 * 8 + 1:8, ], film$solid$points %*% t(turn))
})

test_that("the solid has the body's moments of inertia", {
  # Of a box of 2 kg, 0.3 x 0.2 x 0.1 m: its half edges.
  moments <- 2 / 12 * c(0.2^2 + 0.1^2, 0.3^2 + 0.1^2, 0.3^2 + 0.2^2)
  box <- solid_of_inertia(moments, diag(3), 2)
  expect_equal(box$semi, c(0.15, 0.1, 0.05))
  expect_equal(apply(abs(box$points), 2, max), box$semi)
  expect_length(box$faces, 6)
  # Of a cylinder of 2 kg, 0.4 m along y, radius 0.1 m.
  moments <- 2 * c(0.1^2 / 4 + 0.4^2 / 12, 0.1^2 / 2, 0.1^2 / 4 + 0.4^2 / 12)
  cylinder <- solid_of_inertia(moments, diag(3), 2)
  expect_equal(cylinder$semi, c(0.1, 0.2, 0.1))
  # A turned box, and one of a rod, a plate, a ball and a point.
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  expect_equal(
    solid_of_inertia(c(1, 2, 2.5), turn)$points,
    solid_of_inertia(c(1, 2, 2.5), diag(3))$points %*% t(turn)
  )
  for (one in list(c(1, 1, 0), c(1, 2, 3), c(1, 1, 1), c(0, 0, 0))) {
    expect_true(all(solid_of_inertia(one, diag(3))$semi > 0))
  }
})

test_that("sides have corners in one plane, in order, and outward normals can be told", {
  for (solid in list(unit_box(), unit_cylinder(1), unit_cylinder(3))) {
    seen <- integer()
    for (at in solid$faces) {
      side <- solid$points[at, ]
      flat <- svd(sweep(side, 2, colMeans(side)))$d
      expect_lt(flat[3], 1e-12)
      seen <- c(seen, at)
    }
    expect_setequal(seen, seq_len(nrow(solid$points)))
    expect_identical(length(solid$fill), length(solid$faces))
  }
})

test_that("the sides of a box that are drawn are those turned to the reader", {
  box <- unit_box()
  turn <- rotation_about(c(1, 2, 3), angle_rad = 0.7)
  points <- box$points %*% t(turn)
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  graphics::plot.new()
  for (toward in list(c(1, 0, 0), c(0, -1, 0), c(0, 0, 1), c(0.6, 0.3, -0.74))) {
    drawn <- matrix(0, 0, 3)
    draw_solid(box, points, function(side) {
      drawn <<- rbind(drawn, colMeans(side))
      side[, 1:2]
    }, toward)
    # A unit box's sides are centred at their normals.
    normals <- rbind(diag(3), -diag(3)) %*% t(turn)
    seen <- normals[drop(normals %*% toward) > 0, ]
    expect_equal(nrow(drawn), 3)
    expect_equal(drawn[order(drawn[, 1]), ], seen[order(seen[, 1]), ])
  }
})

test_that("of a fixed point, the body hangs where its centre of mass is", {
  solid <- pivot_solid(spinning_top())
  expect_equal(colMeans(solid$points), c(0, 0, 0.15))
  # A disk without thickness: radius 0.15 m, as thick as it has to be to have a side.
  expect_equal(range(solid$points[, 1]), c(-0.15, 0.15), tolerance = 1e-3)
  expect_lt(diff(range(solid$points[, 3])), 0.016)
  expect_gt(solid$tip[3], 0.15)
  expect_equal(unname(solid$rod[2, ]), c(0, 0, min(solid$points[, 3])))
  # The fixed point inside the body: there is no rod to be seen.
  expect_null(pivot_solid(scene_pivot(
    place_body(body_sphere(2, 0.15), c(0, 0, 0.1)), c(0, 0, 6)
  ))$rod)
  point <- pivot_solid(scene_pivot(diag(c(0.02, 0.02, 0)), c(1, 0, 0), mass_kg = 2,
                                   centre_m = c(0, 0, 0.1)))
  expect_equal(colMeans(point$points), c(0, 0, 0.1))
  expect_gt(diff(range(point$points[, 1])), 0)
  light <- pivot_solid(scene_pivot(c(1, 2, 2.5), c(1, 0, 0), mass_kg = 0, centre_m = c(0, 0, 0)))
  expect_equal(colMeans(light$points), c(0, 0, 0))
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
  film <- plane_film(constraint_of(scene)$frames(scene, rows))
  expect_length(film$marks, 3)
  # The rod is the longest line of the body, from the axle down.
  angle <- vapply(film$marks, function(marks) {
    lines <- Filter(function(one) one$type == "line" && one$style == "body", marks)
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
    vapply(lines_of(one, "spring"), function(p) p[2, 2], 0)
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
    ray <- utils::tail(of(ball$frames[[i]], "line", "body"), 1)[[1]]$points
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
  ticks <- vapply(utils::head(of(far$frames[[2]], "line", "body"), -1), function(one) {
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

test_that("the interactive page has a scene and a player", {
  withr_null()
  skip_if_not_installed("rgl")
  skip_if_not_installed("htmltools")
  page <- animate_motion(nut(time_s = c(0, 1)), frames_per_s = 5)
  expect_s3_class(page[[1]], "rglWebGL")
  expect_s3_class(page[[2]], "rglPlayer")
  expect_length(page[[2]]$x$actions, 3) # the body and two arrows
  expect_identical(page[[2]]$x$stop, 1)
  top <- animate_motion(trajectory(spinning_top(), c(0, 0.2)), frames_per_s = 5, slow_motion = 5)
  expect_length(top[[2]]$x$actions, 4) # and the rod
})

test_that("bad arguments are errors", {
  motion <- nut(time_s = c(0, 1))
  error <- function(code, kind) expect_error(code, class = paste0("rotdyn_error_", kind))
  error(animate_motion(), "missing")
  error(animate_motion(1), "type")
  error(animate_motion(spin_up(time_s = 0:8)), "type") # a page of what moves in a plane
  error(animate_motion(motion, "a.mp4"), "value")
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
