names_of_motion <- c(
  "theta_rad", "omega0_rad_per_s", "omega_rad_per_s", "alpha_rad_per_s2", "time_s"
)
# One motion to 20 digits (mpmath, 50 digits, from the doubles 0.3, -1.7 and 2.9).
motion_known <- c(
  theta_rad = 0.3 * 2.9 - 0.85 * 2.9^2, omega0_rad_per_s = 0.3, omega_rad_per_s = 0.3 - 1.7 * 2.9,
  alpha_rad_per_s2 = -1.7, time_s = 2.9
)

test_that("any three of the five give the other two", {
  threes <- utils::combn(names_of_motion, 3, simplify = FALSE)
  expect_length(threes, 10)
  for (three in threes) {
    motion <- do.call(angular_motion, as.list(motion_known[three]))
    two <- "alpha_rad_per_s2" %in% three && "theta_rad" %in% three && !"time_s" %in% three
    expect_equal(nrow(motion), if (two) 2 else 1)
    expect_equal(motion$root, seq_len(nrow(motion)))
    expect_equal(motion$row, rep(1L, nrow(motion)))
    distance <- apply(as.matrix(motion[names_of_motion]), 1, function(x) {
      max(abs(x - motion_known))
    })
    expect_lt(min(distance), 1e-14)
    # Both roots obey the laws.
    with(motion, {
      expect_equal(omega_rad_per_s, omega0_rad_per_s + alpha_rad_per_s2 * time_s)
      expect_equal(theta_rad, (omega0_rad_per_s + omega_rad_per_s) / 2 * time_s)
    })
  }
})

test_that("the columns are those of the dictionary", {
  known <- column_table()$name
  expect_true(all(names(angular_motion(1, 2, 3)) %in% known))
  expect_true(all(names(point_motion(1, 3, 2)) %in% known))
})

test_that("two motions: the smaller time first, one row each, beside the rows with one", {
  # omega^2 = 9 - 4 = 5; t = (3 -+ sqrt(5))/2.
  both <- angular_motion(
    theta_rad = c(1, 2.25, 1), omega0_rad_per_s = 3, alpha_rad_per_s2 = c(-2, -2, 0)
  )
  expect_equal(both$row, c(1, 1, 2, 3))
  expect_equal(both$root, c(1, 2, 1, 1))
  expect_ulps(both$time_s, c(0.38196601125010515180, 2.6180339887498948482, 1.5, 1 / 3), 0)
  expect_ulps(both$omega_rad_per_s, c(2.2360679774997896964, -2.2360679774997896964, 0, 3), 0)
  back <- angular_motion(theta_rad = 1, omega_rad_per_s = 3, alpha_rad_per_s2 = 2)
  expect_ulps(back$time_s, c(0.38196601125010515180, 2.6180339887498948482), 0)
  expect_ulps(back$omega0_rad_per_s, c(2.2360679774997896964, -2.2360679774997896964), 0)
})

test_that("nothing is lost where the textbook's formulas cancel", {
  # sqrt(1e16 + 2e-3) - 1e8 is 0 in doubles; the time is 1e-11 (1 - 5e-20).
  fast <- angular_motion(theta_rad = 1e-3, omega0_rad_per_s = 1e8, alpha_rad_per_s2 = 1)
  expect_ulps(fast$time_s[2], 1e-11, 1)
  # 2 alpha theta = -(n - 1)(n + 1), so omega^2 = n^2 - n^2 + 1.
  n <- 9007199254740881
  almost <- angular_motion(
    theta_rad = n + 1, omega0_rad_per_s = n, alpha_rad_per_s2 = -(n - 1) / 2
  )
  expect_identical(almost$omega_rad_per_s, c(1, -1))
  # Beyond the range on the way.
  far <- angular_motion(omega0_rad_per_s = 1e200, omega_rad_per_s = 3e200, theta_rad = 1e250)
  expect_equal(far$alpha_rad_per_s2, 4e150)
  expect_equal(far$time_s, 5e49)
})

test_that("no motion, or many: NaN and one warning that names the rows", {
  warned <- expect_warning(
    motion <- angular_motion(
      theta_rad = c(1, 3, NA, 0, 5), omega0_rad_per_s = c(3, 3, 3, 0, 0),
      alpha_rad_per_s2 = c(-2, -2, 1, 0, 0)
    ),
    class = "rotdyn_warning_value"
  )
  expect_match(conditionMessage(warned), "The three values are inconsistent in rows 2 and 5")
  expect_match(conditionMessage(warned), "They do not determine the motion in row 4")
  expect_equal(motion$row, c(1, 1, 2, 3, 4, 5))
  expect_equal(motion$root, c(1, 2, NA, 1, NA, NA))
  expect_equal(is.nan(motion$time_s), c(FALSE, FALSE, TRUE, FALSE, TRUE, TRUE))
  expect_true(is.na(motion$omega_rad_per_s[4]) && !is.nan(motion$omega_rad_per_s[4]))
  expect_identical(motion$omega_rad_per_s[5], 0)
  expect_warning(
    angular_motion(omega0_rad_per_s = 1, omega_rad_per_s = 2, time_s = 0),
    class = "rotdyn_warning_value"
  )
})

test_that("no row, units, and what is not numbers", {
  expect_equal(nrow(angular_motion(numeric(), 1, 2)), 0)
  expect_equal(nrow(point_motion(numeric(), 2, 1)), 0)
  expect_error(angular_motion(1, 2), class = "rotdyn_error_missing")
  expect_error(angular_motion(), class = "rotdyn_error_missing")
  expect_error(angular_motion(1, 2, 3, 4), class = "rotdyn_error_size")
  expect_error(angular_motion(1:2, 1:3, 1), class = "rotdyn_error_size")
  expect_error(angular_motion("a", 2, 3), class = "rotdyn_error_type")
  expect_match(
    conditionMessage(expect_error(angular_motion(1:2, c(1, Inf), 3), class = "rotdyn_error_value")),
    "row 2"
  )
  expect_error(point_motion(1, -1, 2), class = "rotdyn_error_value")
  expect_error(point_motion(1), class = "rotdyn_error_missing")
  expect_error(convert_angle(1, "rpm"), class = "rotdyn_error_missing")
  expect_error(convert_angle(1, "rpm", "rad"), class = "rotdyn_error_unit")
  expect_error(convert_angle(1, "Hz", "rad/s"), class = "rotdyn_error_value")
  expect_error(convert_angle("a", "degree", "rad"), class = "rotdyn_error_type")
  skip_if_not_installed("units")
  expect_equal(convert_angle(units::set_units(180, "degree"), "turn", "rad"), pi)
  expect_equal(convert_angle(units::set_units(2, "turn/s"), "rpm", "rad/s"), 4 * pi)
  expect_error(convert_angle(units::set_units(1, "m"), "degree", "rad"),
    class = "rotdyn_error_unit")
  expect_equal(
    angular_motion(units::set_units(180, "degree"), 0, time_s = 2)$alpha_rad_per_s2, pi / 2
  )
})

test_that("a point that goes round", {
  point <- point_motion(6, 0.3, c(-2.5, NA))
  expect_equal(names(point), c("omega_rad_per_s", "radius_m", "alpha_rad_per_s2", point_columns))
  # mpmath, 60 digits.
  expect_ulps(point$tangential_speed_m_per_s[1], 1.7999999999999999334, 1)
  expect_ulps(point$tangential_acceleration_m_per_s2[1], -0.74999999999999997224, 1)
  expect_ulps(point$centripetal_acceleration_m_per_s2[1], 10.7999999999999996, 2)
  expect_ulps(point$total_acceleration_m_per_s2[1], 10.82601034545967868, 3)
  expect_ulps(point$acceleration_angle_rad[1], -0.069333133688208584975, 2)
  expect_equal(is.na(unlist(point[2, ])), !names(point) %in% c(
    "omega_rad_per_s", "radius_m", "tangential_speed_m_per_s", "centripetal_acceleration_m_per_s2"
  ), ignore_attr = TRUE)
  skip_if_not_installed("dplyr")
  wheel <- data.frame(omega = c(1, 2, NA), r = c(3, 4, 5))
  expect_equal(dplyr::mutate(wheel, v = point_motion(omega, r)$tangential_speed_m_per_s)$v,
    c(3, 8, NA))
  expect_equal(dplyr::mutate(wheel, a = point_motion(omega, r)$centripetal_acceleration_m_per_s2)$a,
    c(3, 16, NA))
})

test_that("units of angles there and back", {
  expect_identical(convert_angle(c(180, -90, 0, NA), "degree", "rad"), c(pi, -pi / 2, 0, NA))
  expect_identical(convert_angle(c(1, Inf), "turn", "rad"), c(2 * pi, Inf))
  expect_identical(convert_angle(60, "rpm", "rad/s"), 2 * pi)
  # The factors, mpmath, 60 digits: 180/pi, 1/(2 pi), 30/pi, pi/30.
  expect_identical(convert_angle(1, "rad", "degree"), 57.29577951308232087680)
  expect_identical(convert_angle(1, "rad", "turn"), 0.15915494309189533577)
  expect_identical(convert_angle(1, "rad/s", "rpm"), 9.54929658551372014613)
  expect_identical(convert_angle(1, "rpm", "rad/s"), 0.10471975511965977462)
  expect_identical(convert_angle(NA, "degree", "rad"), NA_real_)
  # Rational ratios: one rounding.
  expect_identical(convert_angle(c(540, 1), "deg", "turns"), c(1.5, 1 / 360))
  expect_identical(convert_angle(1 / 3, "rev", "deg"), 120)
  expect_identical(convert_angle(7, "rpm", "degree/s"), 42)
  expect_identical(convert_angle(7, "turn/s", "rpm"), 420)
  expect_identical(convert_angle(7, "degree/s", "rpm"), 7 / 6)
  expect_identical(convert_angle(180, "degree/s", "rad/s"), pi)
  expect_identical(convert_angle(2, "turn/s", "rad/s"), 4 * pi)
  expect_warning(convert_angle(1e308, "turn", "degree"), class = "rotdyn_warning_range")
  x <- c(1e-300, 0.1, 7, 1e300)
  expect_ulps(convert_angle(convert_angle(x, "degree", "rad"), "rad", "degree"), x, 2)
  expect_ulps(convert_angle(convert_angle(x, "turn", "rad"), "rad", "turn"), x, 2)
  expect_ulps(convert_angle(convert_angle(x, "rpm", "rad/s"), "rad/s", "rpm"), x, 2)
})

test_that("textbook parts: University Physics 1, chapter 10", {
  rows <- published("openstax_rotation")
  is <- function(id, got) expect_published(got, rows[[id]])
  # (t - 30)^2/100: 9 rad/s at the start, 0 after 30 s.
  is("UP10-01", angular_motion(
    omega0_rad_per_s = 9, omega_rad_per_s = 0, time_s = 30
  )$alpha_rad_per_s2)
  is("UP10-04", angular_motion(
    omega0_rad_per_s = convert_angle(7000, "rpm", "rad/s"), omega_rad_per_s = 0, time_s = 10
  )$theta_rad)
  from_rest <- angular_motion(300, 0, alpha_rad_per_s2 = 5)[2, ]
  is("UP10-06", from_rest$omega_rad_per_s)
  is("UP10-07", from_rest$time_s)
  is("UP10-09", angular_motion(
    omega0_rad_per_s = 2, alpha_rad_per_s2 = 1, time_s = 5
  )$theta_rad)
  # Friction holds him where omega^2 r <= mu g.
  is("UP10-11", 0.5 * 9.8 / point_motion(2.5, 1)$centripetal_acceleration_m_per_s2)
  is("UP10-81", convert_angle(angular_motion(
    omega0_rad_per_s = convert_angle(100 / 3, "rpm", "rad/s"), omega_rad_per_s = 0, time_s = 60
  )$theta_rad, "rad", "turns"))
})

test_that("a wheel that slows by 5 rpm a second (BYU Physics 121)", {
  cases <- utils::read.csv(shared("cases", "coastdown_damping", "cases.csv"))
  computed <- function(id) cases$computed[cases$id == id]
  stop <- angular_motion(
    omega0_rad_per_s = convert_angle(900, "rpm", "rad/s"), omega_rad_per_s = 0,
    alpha_rad_per_s2 = convert_angle(-5, "rpm", "rad/s")
  )
  expect_equal(stop$time_s, computed("byu_t"), tolerance = 1e-14)
  expect_equal(convert_angle(stop$theta_rad, "rad", "turn"), computed("byu_rev"), tolerance = 1e-14)
  after <- angular_motion(
    theta_rad = convert_angle(1000, "turn", "rad"),
    omega0_rad_per_s = convert_angle(900, "rpm", "rad/s"),
    alpha_rad_per_s2 = convert_angle(-5, "rpm", "rad/s")
  )
  expect_equal(convert_angle(after$omega_rad_per_s[1], "rad/s", "rpm"), computed("byu_1000"),
    tolerance = 1e-9)
})

test_that("what exceeds double precision is said", {
  expect_warning(x <- point_motion(1e200, 1, 1), class = "rotdyn_warning_range")
  expect_equal(x$centripetal_acceleration_m_per_s2, Inf)
  expect_warning(point_motion(c(1, 1e200), 1)$centripetal_acceleration_m_per_s2, "row 2",
    class = "rotdyn_warning_range")
  expect_silent(point_motion(1e160, 1e-200, 1e308))
  expect_warning(
    angular_motion(omega0_rad_per_s = 1e308, alpha_rad_per_s2 = 1e308, time_s = 10),
    class = "rotdyn_warning_range"
  )
})

test_that("a wheel by its speed, and units as in names of arguments", {
  wheel <- point_motion(radius_m = c(0.35, 0.5), speed_m_per_s = 5)
  expect_equal(wheel$omega_rad_per_s, c(5 / 0.35, 10))
  expect_equal(wheel$tangential_speed_m_per_s, c(5, 5))
  expect_equal(point_motion(radius_m = body_disk(1, 0.5), speed_m_per_s = 5)$omega_rad_per_s, 10)
  expect_identical(point_motion(radius_m = 1, speed_m_per_s = NA)$omega_rad_per_s, NA_real_)
  expect_error(point_motion(1, 2, speed_m_per_s = 3), class = "rotdyn_error_argument")
  expect_error(point_motion(radius_m = 0, speed_m_per_s = 3), class = "rotdyn_error_value")
  expect_error(point_motion(radius_m = 1:2, speed_m_per_s = 1:3), class = "rotdyn_error_size")
  expect_error(point_motion(radius_m = 1e-300, speed_m_per_s = 1e300), class = "rotdyn_error_range")
  expect_error(point_motion(radius_m = 1), class = "rotdyn_error_missing")
  for (unit in c("rad/s", "degree/s", "turn/s")) {
    in_name <- sub("/", "_per_", unit)
    expect_identical(convert_angle(7, "rpm", in_name), convert_angle(7, "rpm", unit))
  }
  expect_identical(convert_angle(7, "deg_per_s", "rad_per_s"), convert_angle(7, "deg/s", "rad/s"))
  expect_error(angular_motion(omega_rad_per_s = 1, time_s = 2), "alpha_rad_per_s2.* is 0",
               class = "rotdyn_error_missing")
})

test_that("the core takes no unit beside its list", {
  for (unit in c(-1, 99, NaN)) expect_error(.Call(rotdyn:::ffi_convert_angle, 1, unit), "unit")
})

test_that("one row without a solution and one with many are told as well", {
  expect_warning(
    angular_motion(theta_rad = c(0, 5), omega0_rad_per_s = c(0, 0), omega_rad_per_s = c(0, 0)),
    "inconsistent in row 2.*not determine the motion in row 1", class = "rotdyn_warning_value"
  )
})
