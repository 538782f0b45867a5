identity_q <- c(qw = 1, qx = 0, qy = 0, qz = 0)

test_that("forms agree with mpmath at 40 digits", {
  # A rotation of 1 rad about (1, 2, 2)/3: cos(1/2), sin(1/2)/3, tan(1/4)/3.
  q <- c(0.87758256189037271612, 0.15980851286806766770, 0.31961702573613533541,
         0.31961702573613533541)
  v <- c(1, 2, 2) / 3
  from <- attitude_from(v, "rotation_vector")
  expect_equal(unlist(from, use.names = FALSE), q, tolerance = 1e-15)
  expect_equal(
    unlist(attitude_to(from, "rodrigues"), use.names = FALSE),
    0.25534192122103626650 * v, tolerance = 1e-15
  )
  expect_equal(
    unlist(attitude_to(from, "axis_angle"), use.names = FALSE), c(v, 1), tolerance = 1e-15
  )
  expect_equal(
    matrix(unlist(attitude_to(from, "matrix")), 3, byrow = TRUE), rotation_about(v, angle_rad = 1),
    tolerance = 1e-15
  )
  expect_equal(attitude_from(rotation_about(v, angle_rad = 1), "matrix"), from, tolerance = 1e-15)
})

test_that("all 24 sequences are products of rotations about their axes", {
  axes <- c("x", "y", "z")
  triples <- expand.grid(i = axes, j = axes, k = axes, stringsAsFactors = FALSE)
  triples <- triples[triples$i != triples$j & triples$j != triples$k, ]
  angles <- c(0.4, 1.1, -2.3)
  count <- 0
  for (row in seq_len(nrow(triples))) {
    of <- unlist(triples[row, ])
    each <- Map(function(axis, angle) rotation_about(axis, angle_rad = angle), of, angles)
    for (kind in c("intrinsic", "extrinsic")) {
      count <- count + 1
      want <- if (kind == "intrinsic") Reduce(`%*%`, each) else Reduce(`%*%`, rev(each))
      name <- paste(kind, paste(of, collapse = ""))
      q <- attitude_from(angles, "euler", sequence = name)
      got <- matrix(unlist(attitude_to(q, "matrix")), 3, byrow = TRUE)
      expect_lt(max(abs(got - want)), 2e-15)
      back <- attitude_to(q, "euler", sequence = name)
      expect_false(back$gimbal_lock)
      again <- attitude_from(back, "euler", sequence = name)
      expect_lt(attitude_difference(q, again), 2e-15)
    }
  }
  expect_identical(count, 24)
})

test_that("gimbal lock is flagged, and the attitude keeps its digits", {
  angles <- data.frame(
    angle_1_rad = 0.3, angle_2_rad = pi / 2 - c(1e-6, 1e-8, 0), angle_3_rad = -1.2
  )
  q <- attitude_from(angles, "euler", sequence = "intrinsic zyx")
  back <- attitude_to(q, "euler", sequence = "intrinsic zyx")
  expect_identical(back$gimbal_lock, c(FALSE, TRUE, TRUE))
  expect_identical(back$angle_3_rad[3], 0)
  again <- attitude_from(back, "euler", sequence = "intrinsic_zyx")
  expect_lt(max(attitude_difference(q, again)), 2e-15)
})

test_that("small rotations and half turns keep their digits", {
  small <- attitude_from(c(3e-200, 0, 4e-200), "rotation_vector")
  expect_equal(unlist(attitude_to(small, "rotation_vector"), use.names = FALSE) * 1e200,
               c(3, 0, 4), tolerance = 1e-15)
  half <- attitude_from(c(0, 0, 1, pi), "axis_angle")
  expect_equal(unlist(attitude_to(half, "rotation_vector"), use.names = FALSE), c(0, 0, pi),
               tolerance = 4e-16)
  expect_equal(unlist(attitude_to(half, "rodrigues"), use.names = FALSE), c(0, 0, 1),
               tolerance = 4e-16)
})

test_that("the order of a quaternion must be named, and the direction may be", {
  expect_error(attitude_from(c(0, 0, 0.6, 0.8), "quaternion"), class = "rotdyn_error_missing")
  last <- attitude_from(c(0, 0, 0.6, 0.8), "quaternion", order = "xyzw")
  expect_equal(unlist(last), c(qw = 0.8, qx = 0, qy = 0, qz = 0.6))
  first <- attitude_from(c(0.8, 0, 0, 0.6), "quaternion", order = "wxyz")
  expect_identical(last, first)
  expect_identical(attitude_from(last, "quaternion"), last)
  other <- attitude_from(last, "quaternion", maps = "space_to_body")
  expect_identical(other, attitude_inverse(last))
  expect_error(attitude_from(c(1, 2, 3), "euler"), class = "rotdyn_error_missing")
  expect_error(
    attitude_from(c(1, 2, 3), "euler", sequence = "zyx"), class = "rotdyn_error_value"
  )
  expect_error(
    attitude_from(c(1, 2, 3), "euler", sequence = "intrinsic zzx"), class = "rotdyn_error_value"
  )
})

test_that("unnormalised input is normalised and said", {
  expect_warning(
    q <- attitude_from(c(2, 0, 0, 2), "quaternion", order = "wxyz"),
    class = "rotdyn_warning_normalised"
  )
  expect_equal(unlist(q), c(qw = 1, qx = 0, qy = 0, qz = 1) / sqrt(2), tolerance = 1e-15)
  # What ten digits leave is said, what arithmetic leaves is not.
  expect_warning(
    attitude_from(c(1 + 1e-10, 0, 0, 0), "quaternion", order = "wxyz"),
    class = "rotdyn_warning_normalised"
  )
  expect_no_warning(attitude_from(c(1 + 1e-14, 0, 0, 0), "quaternion", order = "wxyz"))
  rough <- rotation_about("z", angle_rad = 0.3) * (1 + 1e-8)
  expect_warning(q <- attitude_from(rough, "matrix"), class = "rotdyn_warning_normalised")
  expect_equal(unlist(attitude_to(q, "rotation_vector"), use.names = FALSE), c(0, 0, 0.3),
               tolerance = 1e-8)
})

test_that("rows, missing values and bad rows", {
  table <- data.frame(qw = c(1, NA, 0), qx = 0, qy = c(0, 0, 1), qz = 0)
  out <- attitude_to(table, "euler", sequence = "extrinsic zxz")
  expect_identical(is.na(out$angle_1_rad), c(FALSE, TRUE, FALSE))
  expect_identical(is.na(out$gimbal_lock), c(FALSE, TRUE, FALSE))
  expect_identical(attitude_difference(identity_q, table), c(0, NA, pi))
  table$qw[1] <- 0
  expect_error(attitude_to(table, "matrix"), "row 1", class = "rotdyn_error_value")
  table$qw[1] <- Inf
  expect_error(attitude_to(table, "matrix"), class = "rotdyn_error_value")
  expect_error(attitude_to(data.frame(qw = 1), "matrix"), class = "rotdyn_error_type")
  expect_error(attitude_to(1:4, "matrix"), class = "rotdyn_error_type")
  mirror <- diag(c(1, 1, -1))
  expect_error(attitude_from(mirror, "matrix"), "reflection", class = "rotdyn_error_value")
  expect_error(attitude_from(1:2, "rodrigues"), class = "rotdyn_error_size")
  expect_error(attitude_from(array(1, c(2, 2, 2)), "rodrigues"), class = "rotdyn_error_size")
  expect_identical(nrow(attitude_to(table[0, ], "matrix")), 0L)
})

test_that("composition, slerp and turned vectors", {
  a <- attitude_from(c(0, 0, pi / 2), "rotation_vector")
  b <- attitude_from(c(pi / 2, 0, 0), "rotation_vector")
  ab <- attitude_compose(a, b)
  # First b about x takes y to z; then a about z leaves it.
  expect_equal(unlist(attitude_turn(ab, c(0, 1, 0))), c(x = 0, y = 0, z = 1), tolerance = 1e-15)
  expect_equal(unlist(attitude_turn(ab, c(0, 0, 1), "body")), c(x = 0, y = 1, z = 0),
               tolerance = 1e-15)
  expect_lt(attitude_difference(attitude_compose(ab, attitude_inverse(ab)), identity_q), 1e-15)
  way <- attitude_slerp(identity_q, a, (0:4) / 4)
  expect_equal(attitude_difference(identity_q, way), (0:4) * pi / 8, tolerance = 1e-15)
  expect_error(attitude_compose(way, way[1:2, ]), class = "rotdyn_error_size")
})

test_that("the core takes no axis beside the three, and none twice in a row", {
  from <- function(sequence) {
    form <- match("euler", names(attitude_forms)) - 1
    .Call(rotdyn:::ffi_attitude_from, form, list(0.1, 0.2, 0.3), sequence)
  }
  expect_type(from(c(2, 1, 0, 1)), "list")
  for (wrong in list(c(0, 3, 0, 1), c(-1, 1, 0, 1), c(0, 0, 1, 1))) {
    expect_error(from(wrong), "sequence")
  }
})

test_that("an axis of length 0 is refused", {
  expect_error(attitude_from(c(0, 0, 0, 1), "axis_angle"), "length 0", class = "rotdyn_error_value")
  expect_error(
    attitude_from(rbind(c(0, 0, 1, 1), c(0, 0, 0, 0.5)), "axis_angle"), "row 2",
    class = "rotdyn_error_value"
  )
})

test_that("infinite fractions and vectors are refused with their row, large ones turn", {
  q <- c(qw = 0.6, qx = 0.8, qy = 0, qz = 0)
  refused <- function(expr) expect_error(expr, "row 2", class = "rotdyn_error_value")
  refused(attitude_slerp(q, q, c(0, Inf)))
  refused(attitude_turn(q, data.frame(x = 1:2, y = c(0, -Inf), z = 1)))
  expect_error(attitude_turn(q, c(1, Inf, 2)), class = "rotdyn_error_value")
  expect_identical(attitude_slerp(q, q, c(0.5, NA))$qw, c(0.6, NA))
  # By 2 acos(0.6) about x: the cosine of the angle is 2 * 0.36 - 1, the sine 2 * 0.6 * 0.8.
  expect_equal(attitude_turn(q, c(0, 1e200, 0))$y, -0.28e200, tolerance = 1e-15)
  expect_equal(attitude_turn(q, c(0, 1e200, 0))$z, 0.96e200, tolerance = 1e-15)
  huge <- attitude_from(c(1e200, 0, 0, 2 * acos(0.6)), "axis_angle")
  expect_equal(unlist(huge), q, tolerance = 1e-15)
})
