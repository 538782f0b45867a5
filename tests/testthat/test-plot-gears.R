skip_if_not_installed("ggplot2")

wheels <- function(drawing) {
  all <- Filter(function(one) one$type == "fill" && one$style == "body", drawing$marks)
  t(vapply(all, function(one) {
    c(x = mean(range(one$points[, 1])), r = diff(range(one$points[, 1])) / 2)
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
  expect_match(ggplot2::autoplot(train)$labels$alt, "ratio to the first 1, 5, -15")
  expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(gear_train(2, numeric()))))
  expect_error(ggplot2::autoplot(train["shaft"]), class = "rotdyn_error_type")
})
