arrival <- function(...) summary(roll_on_curve(...))
g <- 9.80665

test_that("descent times of the shared table, to a few ulp", {
  rows <- utils::read.csv(shared("refs", "curve_descent_time.csv"))
  curves <- list("0.5*(x-2)^2" = function(x) 0.5 * (x - 2)^2, "cos(x)" = function(x) cos(x))
  expect_setequal(rows$y_of_x, names(curves))
  for (i in seq_len(nrow(rows))) {
    row <- rows[i, ]
    got <- arrival(
      curves[[row$y_of_x]], row$x0, row$x1, body = row$beta, gravity_m_per_s2 = row$g
    )
    expect_ulps(got$time_s, row$time, 3)
    expect_equal(got$event, "arrives")
    expect_gte(got$error, abs(got$time_s / row$time - 1))
  }
})

test_that("times of other curves, by 50-digit quadrature", {
  # Far up, fast and slow starts, a turn, leftward.
  expect_ulps(arrival(function(x) exp(-x), 0, 5)$time_s, 1.8610896791115425349, 3)
  expect_ulps(
    arrival(function(x) 1000 + cos(x), 0.5, 2.5, body = 0.5)$time_s, 1.2124328892262876371, 3
  )
  expect_ulps(arrival(cos, 0, 3, body = 1, v0_m_per_s = 0.75)$time_s, 1.6324886566047339371, 3)
  expect_ulps(
    arrival(function(x) -x^2 / 4 - x / 8, 0, 1, body = 0, v0_m_per_s = 2^-20)$time_s,
    1.0805152378365426463, 4
  )
  turn <- arrival(function(x) x^4 / 4 - x, 0, 2)
  expect_ulps(turn$time_s, 1.2855086787106383861, 4)
  expect_equal(c(turn$x_m, turn$v_m_per_s), c(4^(1 / 3), 0), tolerance = 1e-15)
  expect_ulps(
    arrival(function(x) x^2 + x^3 / 8, 1, 0, body = 2 / 3)$time_s, 0.78014254768709769022, 3
  )
})

test_that("a cycloid takes the same time from anywhere, and less than a line", {
  # pi sqrt(a/g) to the lowest point, for a sliding body.
  for (start in c(0, 1, 2, 3)) {
    expect_equal(
      arrival(curve_cycloid(0.5), start, pi, body = 0)$time_s, pi * sqrt(0.5 / g),
      tolerance = 1e-14
    )
  }
  line <- arrival(function(x) -2 * x / pi, 0, pi, body = 0)
  # Length and drop: t = s sqrt(2/(g h)).
  expect_equal(line$time_s, sqrt(pi^2 + 4) * sqrt(2 / (2 * g)), tolerance = 1e-14)
  expect_lt(arrival(curve_cycloid(1), 0, pi, body = 0)$time_s, line$time_s)
  full <- arrival(curve_cycloid(1), 0, 2 * pi, body = 0.4)
  expect_equal(full$event, "turns")
  expect_equal(full$time_s, 2 * pi * sqrt(1.4 / g), tolerance = 1e-14)
  expect_equal(full$path_m, 8, tolerance = 1e-14)
})

test_that("a plane is the incline's closed form, with its friction", {
  slope <- tan(25 * pi / 180)
  motion <- roll_on_curve(function(x) -slope * x, 0, 2, body_sphere(3, 0.1), rows = 3)
  s <- motion$path_m
  a <- rolling_acceleration(0.4, 25)
  expect_equal(motion$time_s, sqrt(2 * s / a), tolerance = 1e-14)
  expect_equal(motion$v_m_per_s, sqrt(2 * a * s), tolerance = 1e-14)
  expect_equal(motion$omega_rad_per_s, motion$v_m_per_s / 0.1)
  expect_equal(motion$friction_needed, rep(rolling_friction_coefficient(0.4, 25), 3))
  # Uphill along the path: against the motion.
  expect_equal(motion$friction_force_n, rep(-3 * g * sin(25 * pi / 180) * 2 / 7, 3))
  expect_equal(motion$normal_n, rep(3 * g * cos(25 * pi / 180), 3))
})

test_that("loops: the least height, and where a lower start leaves", {
  expect_equal(loop_start_height(c(0, 2 / 5, 1), 0.48), c(2.5, 2.7, 3) * 0.48)
  through <- function(height) {
    arrival(
      curve_circle(0.48), 0, 2 * pi, body = 2 / 5, v0_m_per_s = sqrt(2 * g * height / 1.4)
    )
  }
  expect_equal(through(2.7 * 0.48 * (1 + 1e-9))$event, "arrives")
  low <- through(2.7 * 0.48 * (1 - 1e-6))
  expect_equal(low$event, "leaves")
  for (height in c(0.6, 1, 1.25)) {
    end <- through(height)
    expect_equal(end$event, "leaves")
    # The angle from the lowest point of the place where it leaves.
    expect_equal(
      acos(1 - end$y_m / 0.48) * 180 / pi, loop_leaving_angle(2 / 5, 0.48, height),
      tolerance = 1e-10
    )
  }
  back <- through(0.4)
  expect_equal(back$event, "turns")
  expect_equal(back$y_m, 0.4)
  expect_true(is.nan(loop_leaving_angle(2 / 5, 0.48, 0.4)))
  expect_equal(loop_leaving_angle(2 / 5, 1, c(2.7, 5, NA)), c(180, 180, NA))
})

test_that("a ball leaves a hill where cos = 2/(3 + beta)", {
  expect_equal(cos(hill_leaving_angle(c(0, 2 / 5)) * pi / 180), c(2 / 3, 10 / 17))
  for (beta in c(0, 2 / 5, 1)) {
    # From the angle a: 2 cos a = (3 + beta) cos b.
    end <- arrival(curve_path(sin, cos), 0.1, 1.5, body = beta)
    expect_equal(end$event, "leaves")
    expect_equal(end$y_m, 2 * cos(0.1) / (3 + beta), tolerance = 1e-12)
    expect_equal(end$min_normal_n, 0, tolerance = 1e-10)
  }
  # It slips before: mu (g cos - v^2) = beta/(1 + beta) g sin.
  end <- arrival(curve_path(sin, cos), 0.1, 1.5, body = 2 / 5, friction = 0.3)
  expect_equal(end$event, "slips")
  cosine <- end$y_m
  v2 <- 2 * (cos(0.1) - cosine) / 1.4
  expect_equal(0.3 * (cosine - v2), 2 / 7 * sqrt(1 - cosine^2), tolerance = 1e-10)
  expect_equal(end$friction_needed, 0.3, tolerance = 1e-9)
})

test_that("contact and friction are never violated on the way", {
  set.seed(31)
  seen <- character()
  for (i in seq_len(or_long(50, 150))) {
    k <- rnorm(3)
    curve <- function(x) k[1] * sin(x) + k[2] * cos(2 * x) / 4 + k[3] * x
    friction <- sample(c(0.1, 0.3, 1, Inf), 1)
    way <- sample(c(-1, 1), 1) * 4
    motion <- tryCatch(
      roll_on_curve(
        curve, 0, way, body = sample(c(0, 0.4, 1), 1), v0_m_per_s = sample(c(0, 2), 1),
        friction = friction, rows = 41
      ),
      rotdyn_error_value = function(e) NULL
    )
    if (is.null(motion)) next
    seen <- c(seen, summary(motion)$event)
    size <- max(abs(motion$normal_n))
    expect_gte(min(motion$normal_n), -1e-12 * size)
    expect_lte(max(motion$friction_needed), friction * (1 + 1e-9))
    expect_false(is.unsorted(motion$time_s, strictly = TRUE))
    # Energy: m v^2 (1 + beta)/2 + m g y, from row to row, in the rate of the path.
    rate <- diff(motion$path_m) / diff(motion$time_s)
    time_scales <- pmax(motion$v_m_per_s[-1], motion$v_m_per_s[-nrow(motion)])
    expect_lte(max(rate / time_scales), 1.05)
  }
  expect_setequal(unique(seen), c("arrives", "turns", "leaves", "slips"))
})

test_that("tables, derivatives given, paths", {
  x <- seq(0, 3, length.out = 200)
  table <- arrival(curve_table(x, 0.5 * (x - 2)^2), 0.1, 2)
  exact <- arrival(function(x) 0.5 * (x - 2)^2, 0.1, 2)
  expect_equal(table$time_s, exact$time_s, tolerance = 1e-4)
  expect_lt(table$error, 1e-12)
  given <- curve_function(
    function(x) ifelse(x < 9, 0.5 * (x - 2)^2, 0), function(x) x - 2, function(x) 1 + 0 * x
  )
  expect_equal(arrival(given, 0.1, 2)$time_s, exact$time_s, tolerance = 1e-15)
  path <- curve_path(function(u) u^2, function(u) 0.5 * (u^2 - 2)^2)
  expect_equal(arrival(path, sqrt(0.1), sqrt(2))$time_s, exact$time_s, tolerance = 1e-14)
  expect_output(print(path), "<rot_curve> path")
})

test_that("barriers and dips far narrower than the rows end the motion", {
  # A hump of 1 m, which 0.6 m of fall and 2 m/s do not climb (v^2 = 4 + 0.6 c against 1 c).
  for (width in c(0.5, 0.05, 0.006)) {
    hump <- eval(bquote(function(x) -0.1 * x + exp(-((x - 6.1234) / .(width))^2)))
    for (rows in c(2, 101)) {
      got <- arrival(hump, 0, 10, v0_m_per_s = 2, rows = rows)
      expect_true(got$event %in% c("leaves", "turns"))
      expect_lt(abs(got$x_m - 6.1234), 1.5 * width)
    }
  }
  # 1.2e-4 of the span: missed and said, found where asked for or told.
  hump <- function(x) -0.1 * x + exp(-((x - 6.1234) / 0.0006)^2)
  missed <- roll_on_curve(hump, 0, 10, v0_m_per_s = 2)
  expect_equal(summary(missed)$finest, 1e-3)
  expect_output(print(missed), "narrower than 0.001 of the")
  fine <- arrival(hump, 0, 10, v0_m_per_s = 2, finest = 1e-4)
  expect_equal(fine$finest, 1e-4)
  near <- arrival(hump, 0, 10, v0_m_per_s = 2, breaks = 6.1234)
  expect_true(near$event %in% c("leaves", "turns"))
  expect_lt(abs(near$x_m - 6.1234), 0.001)
  expect_equal(near$event, fine$event)
  expect_equal(near$x_m, fine$x_m, tolerance = 1e-12)
  # A dip passes, and takes its time: as one panel each by another rule.
  dip <- function(x) -0.1 * x - 0.005 * exp(-((x - 6.1234) / 0.3)^2)
  slope <- function(x) -0.1 + 0.005 * 2 * (x - 6.1234) / 0.09 * exp(-((x - 6.1234) / 0.3)^2)
  time_scales <- function(x) sqrt((1 + slope(x)^2) / (25 - 2 * g / 1.4 * dip(x)))
  ends <- c(0, 4, 5.5, 6.1234, 6.7, 8, 10)
  time <- sum(mapply(function(a, b) {
    stats::integrate(time_scales, a, b, rel.tol = 1e-12)$value
  }, ends[-7], ends[-1]))
  for (rows in c(2, 301)) {
    got <- arrival(dip, 0, 10, v0_m_per_s = 5, rows = rows)
    expect_equal(got$event, "arrives")
    expect_equal(got$time_s, time, tolerance = 1e-12)
  }
})

test_that("a summary is of the motion, not of its rows", {
  # N/m = v^2 y''/(1 + y'^2)^1.5 + g cos, f/m = 2/7 g sin, on a grid of 1e6 places.
  curve <- function(x) -x / 2 + 0.01 * sin(3 * x)
  x <- seq(0, 6, length.out = 1e6)
  d1 <- -1 / 2 + 0.03 * cos(3 * x)
  d2 <- -0.09 * sin(3 * x)
  push <- -2 * g / 1.4 * curve(x) * d2 / (1 + d1^2)^1.5 + g / sqrt(1 + d1^2)
  needed <- 2 / 7 * g * abs(d1) / sqrt(1 + d1^2) / push
  all <- lapply(c(2, 3, 5, 101, 5001), function(rows) arrival(curve, 0, 6, rows = rows))
  for (one in all) {
    expect_equal(one$event, "arrives")
    expect_equal(one$min_normal_n, min(push), tolerance = 1e-9)
    expect_equal(one$friction_needed, max(needed), tolerance = 1e-9)
    expect_equal(one$time_s, all[[1]]$time_s, tolerance = 1e-14)
  }
})

test_that("friction is positive in the direction of the motion, leftwards, too", {
  down <- function(x) 0.3 * x + 0.05 * x^2
  left <- roll_on_curve(down, 2, 0, rows = 5)
  right <- roll_on_curve(function(x) -0.3 * x + 0.05 * x^2, -2, 0, rows = 5)
  expect_true(all(left$friction_force_n < 0))
  for (name in c("time_s", "friction_force_n", "normal_n", "friction_needed", "v_m_per_s")) {
    expect_equal(left[[name]], right[[name]], tolerance = 1e-14)
  }
  # f/m = -beta/(1 + beta) g sin at the start.
  expect_equal(left$friction_force_n[1], -2 / 7 * g * 0.5 / sqrt(1.25), tolerance = 1e-14)
})

test_that("a crest that is barely reached: an error, no warning of base R", {
  hill <- function(x) cos(x)
  crest <- sqrt(2 * g / 1.4 * (1 - cos(1.5)))
  for (part in or_long(c(-1e-9, 0, 1e-9), c(-1e-6, -1e-9, -1e-13, 0, 1e-13, 1e-9, 1e-6))) {
    got <- tryCatch(
      arrival(hill, -1.5, 1, v0_m_per_s = crest * (1 + part)),
      rotdyn_error_value = function(e) conditionMessage(e)
    )
    if (is.character(got)) {
      expect_match(got, "crest")
      expect_lt(abs(part), 1e-10)
    } else {
      expect_equal(got$event, if (part < 0) "turns" else "arrives")
    }
  }
  # Level at the end, at the height of the start: it takes infinitely long.
  expect_error(roll_on_curve(function(x) -(x - 1) * (x - 3)^2, 1, 3), "crest",
               class = "rotdyn_error_value")
})

test_that("the figure of a turn on a steep, narrow barrier holds the rounding of its place", {
  # Times of rows 2 to 4 in quadruple precision (bench/coverage/curves.c). The slope at the barrier
  # is 2e4: a rounding of the place is 1e-11 of the square of the speeds.
  barrier <- function(x) {
    -0.21874648870119975 - 1.0026224165922031 * x + 1.1785129937559686 * x^2 -
      0.011007484902103187 * sin(13.599699864249262 * x - 0.96999381411580205) +
      0.0065105522115733363 * exp(-((x - 0.035578863662235553) / 3.5324743987051825e-07)^2)
  }
  motion <- roll_on_curve(
    barrier, 0.034391803127442097, 0.037480875402249945, 2 * 5.6603451644372793 /
      10.606693425194608 - 1, rows = 9, gravity_m_per_s2 = 5.6603451644372793, finest = 1e-4
  )
  true_s <- c(0.017076183278599166, 0.024148240527088971, 0.029574043376746857)
  off <- max(abs(motion$time_s[2:4] - true_s)) / max(true_s)
  expect_identical(summary(motion)$event, "turns")
  expect_lt(off, summary(motion)$error)
  expect_lt(summary(motion)$error, 1e-9)
})

test_that("the figure of a short way holds the rounding of the height, whose terms are larger", {
  # Times of rows 2 to 4 in quadruple precision (bench/coverage/curves.c). The body falls by 1e-3 of
  # the height, and the slope times x is as large as that.
  short <- function(x) {
    1.1818226145516417 - 0.79227519256528467 * x - 0.36275069733621557 * x^2 -
      0.079133183972083063 * sin(3.2999695960603446 * x - 1.9996296772733331) -
      0.0021301541180086085 * exp(-((x - 0.13285832891928329) / 4.4274392595360928e-05)^2)
  }
  motion <- roll_on_curve(
    short, 0.13224585475662001, 0.13344270708969758, 0.5, rows = 9, gravity_m_per_s2 = 1.5,
    finest = 1e-4
  )
  true_s <- c(0.024545859221265683, 0.034713680098733768, 0.042516186061930542)
  off <- max(abs(motion$time_s[2:4] - true_s)) / max(true_s)
  expect_identical(summary(motion)$event, "leaves")
  # An estimate: it was 1/14 of the error.
  expect_lt(off, 2 * summary(motion)$error)
  expect_lt(summary(motion)$error, 1e-12)
})

test_that("errors of curves", {
  expect_error(roll_on_curve(cos, 0, 3), class = "rotdyn_error_value") # level at the start
  expect_error(roll_on_curve(cos, -1, 3), class = "rotdyn_error_value") # uphill
  expect_error(roll_on_curve(cos, 1, 1), class = "rotdyn_error_value")
  expect_error(roll_on_curve(function(x) abs(x - 1), 0, 3), class = "rotdyn_error_type")
  expect_error(roll_on_curve(function(x) 1 / (x - 2)^2, 1, 3), class = "rotdyn_error_value")
  expect_error(roll_on_curve(1, 0, 3), class = "rotdyn_error_type")
  expect_error(
    roll_on_curve(function(x, y, z) x, 0, 3), "3 arguments", class = "rotdyn_error_type"
  )
  edited <- curve_table(0:3, c(3, 2, 1, 0))
  edited$dy <- function(x, y) x
  expect_error(roll_on_curve(edited, 0, 2), "dy", class = "rotdyn_error_type")
  expect_error(roll_on_curve(cos), class = "rotdyn_error_missing")
  expect_error(roll_on_curve(cos, 1, 2, friction = -1), class = "rotdyn_error_value")
  expect_error(roll_on_curve(function(x) -x, 0, 1, friction = 0.1), class = "rotdyn_error_value")
  # A crest that is sharper than the ball.
  expect_error(
    roll_on_curve(function(x) exp(-x^2 / 0.01), 1e-3, 1, body_sphere(1, 0.1)),
    class = "rotdyn_error_value"
  )
  expect_error(curve_table(c(0, 2, 1), 1:3), class = "rotdyn_error_value")
  expect_error(curve_table(1:2, 1:2), class = "rotdyn_error_size")
  expect_error(
    roll_on_curve(curve_table(0:3, c(3, 2, 1, 0)), -1, 2), class = "rotdyn_error_value"
  )
  expect_error(curve_circle(0), class = "rotdyn_error_value")
  expect_error(curve_path(cos, sin, list(1)), class = "rotdyn_error_type")
  expect_error(loop_start_height(-1, 1), class = "rotdyn_error_value")
  expect_error(loop_leaving_angle(0.4, 1:2, 1:3), class = "rotdyn_error_size")
  forged <- roll_on_curve(cos, 1, 2)
  attr(forged, "run") <- NULL
  expect_error(summary(forged), class = "rotdyn_error_type")
})

test_that("a steep dip further on does not hide where it begins", {
  f <- function(x) {
    3.1101667937736313 - 2.2652676083380356 * x - 0.17918544854236759 * x^2 -
      0.15540582977340003 * sin(1.8590247269083042 * x + 2.5764564885757864) -
      0.018936205772485452 * exp(-((x - 1.3225842251355977) / 2.7185408513078652e-05)^2)
  }
  motion <- roll_on_curve(
    f, 1.3271509475960996, 1.3182385281540407, 2 * 18.933494741291899 / 23.4267096698497 - 1,
    0.62620555941197409, rows = 9, gravity_m_per_s2 = 18.933494741291899
  )
  expect_identical(motion$x_m[5], 1.3226947378750702)
  # In quadruple precision (bench/coverage/curves.c).
  expect_lte(abs(motion$time_s[5] / 0.028585257481405842 - 1), summary(motion)$error)
})

test_that("columns are in the dictionary", {
  known <- column_table()$name
  motion <- roll_on_curve(cos, 1, 2)
  expect_identical(setdiff(c(names(motion), names(summary(motion))), known), character())
})

test_that("a crest that is reached without speed is seen on the way, and beside the start", {
  # v^2 = 4 (x - 1)^2: no place is below 0, and beyond the crest the body would go on.
  hill <- function(x) -(x - 1)^2
  expect_error(
    roll_on_curve(hill, 0, 2, body = 0, v0_m_per_s = 2, gravity_m_per_s2 = 2), "crest",
    class = "rotdyn_error_value"
  )
  # v^2 = 4 (x - 1)^2 + 0.41: it passes.
  passes <- arrival(hill, 0, 2, body = 0, v0_m_per_s = 2.1, gravity_m_per_s2 = 2)
  expect_equal(passes$event, "arrives")
  expect_equal(passes$v_m_per_s, 2.1)
  # v^2 = 4e-16 on the crest, a rounding of the 4 at the end; the start has 8e-16.
  expect_error(
    roll_on_curve(
      function(x) -(x - 1e-8)^2, 0, 1, body = 0, v0_m_per_s = sqrt(8e-16), gravity_m_per_s2 = 2,
      breaks = 1e-8
    ), "crest is at 1e-08", class = "rotdyn_error_value"
  )
})

test_that("a slope that is small is none that is level", {
  nearly <- curve_function(function(x) -1e-10 * x)
  expect_gt(max(roll_on_curve(nearly, 0, 1, body_sphere(1, 0.01))$v_m_per_s), 0)
  level <- curve_function(function(x) -1e-13 * x)
  expect_error(
    roll_on_curve(level, 0, 1, body_sphere(1, 0.01)), "level", class = "rotdyn_error_value"
  )
})
