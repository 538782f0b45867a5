skip_if_not_installed("ggplot2")

# By their pitch circles, of those with teeth: 4 corners each.
wheels <- function(drawing) {
  all <- Filter(function(one) one$type == "fill" && one$style == "body", drawing$marks)
  t(vapply(all, function(one) {
    round <- nrow(one$points) == 181L
    x <- mean(if (round) range(one$points[, 1]) else one$points[, 1])
    r <- range(sqrt((one$points[, 1] - x)^2 + one$points[, 2]^2))
    # Teeth reach out by 1 and in by 1.1 of their depth.
    c(x = x, r = if (round) r[2] else (r[1] + 1.1 * r[2]) / 2.1)
  }, double(2)))
}

test_that("wheels that mesh touch, in the ratio of their radii", {
  at <- wheels(rotdyn:::draw_train(gear_train(c(0.01, 0.5), -4)))
  at <- at[order(at[, "x"]), ]
  expect_equal(at[2, "r"] / at[1, "r"], 4, ignore_attr = TRUE)
  expect_equal(diff(at[, "x"]), sum(at[, "r"]), ignore_attr = TRUE)
})

test_that("pulleys that turn alike stand apart, with a belt that touches both", {
  look <- rotdyn:::draw_train(gear_train(c(0.01, 0.5), 4))
  at <- wheels(look)
  at <- at[order(at[, "x"]), ]
  expect_gt(diff(at[, "x"]), sum(at[, "r"]))
  belt <- Filter(function(one) one$style == "spring", look$marks)
  expect_length(belt, 2)
  for (one in belt) {
    # The distance of each centre from the line is the radius.
    p <- one$points
    along <- (p[2, ] - p[1, ]) / sqrt(sum((p[2, ] - p[1, ])^2))
    away <- apply(cbind(at[, "x"], 0), 1, function(c) {
      v <- c - p[1, ]
      abs(v[1] * along[2] - v[2] * along[1])
    })
    expect_equal(away, at[, "r"], ignore_attr = TRUE)
  }
})

test_that("a train and its scene draw without a warning", {
  train <- gear_train(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4))
  expect_s3_class(train, "rot_gear_train")
  for (size in c(13, 24)) {
    expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(train, base_size = size)))
  }
  expect_match(ggplot2::autoplot(train)$labels$alt, "speed over first speed 1, 1/5, -1/15")
  expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(gear_train(2, numeric()))))
  expect_error(ggplot2::autoplot(train["shaft"]), class = "rotdyn_error_type")
})

test_that("teeth mesh: a tooth of one wheel is in a gap of the other, at all times", {
  expect_equal(mesh_teeth(4), c(9, 36))
  expect_equal(mesh_teeth(1 / 4), c(36, 9))
  expect_equal(mesh_teeth(2.5), c(10, 25))
  expect_true(all(mesh_teeth(sqrt(2)) >= 9))
  train <- gear_train(c(0.01, 0.5), -4)
  for (theta in c(0, 0.3, 2, -7)) {
    drawing <- draw_train(train, theta = theta)
    all <- Filter(function(one) one$type == "fill" && one$style == "body", drawing$marks)
    small <- all[[which.min(vapply(all, function(one) nrow(one$points), 0L))]]$points
    large <- all[[which.max(vapply(all, function(one) nrow(one$points), 0L))]]$points
    # Corners of the teeth in the space between the pitch circles: none is inside the other wheel.
    inside <- function(p, polygon) {
      x <- polygon[, 1]
      y <- polygon[, 2]
      j <- c(length(x), seq_along(x)[-length(x)])
      cross <- (y > p[2]) != (y[j] > p[2]) & p[1] < (x[j] - x) * (p[2] - y) / (y[j] - y) + x
      sum(cross) %% 2 == 1
    }
    expect_false(any(apply(small, 1, inside, large)))
    expect_false(any(apply(large, 1, inside, small)))
  }
  expect_identical(vapply(c(1, 5, -15, 0.5, 2.5), fraction_text, ""),
    c("1", "1/5", "-1/15", "2", "0.4"))
})

test_that("the speed of a small wheel is written outside of its rim", {
  drawing <- draw_train(gear_train(c(0.01, 0.5, 2), ratios = c(5, -3)))
  at <- drawing$labels[drawing$labels$symbol == "omega[1]", ]
  expect_gt(sqrt(at$x^2 + at$y^2) - drawing$reach[1], 0.15)
})
