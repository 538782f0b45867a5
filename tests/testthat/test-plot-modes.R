skip_if_not_installed("ggplot2")

test_that("shapes are those of equal rotors: cos((k - 1/2) m pi/n)", {
  n <- 5
  shapes <- rotdyn:::mode_shapes(rep(2, n), rep(100, n - 1))
  for (m in 0:(n - 1)) {
    want <- cos((seq_len(n) - 0.5) * m * pi / n)
    # Up to sign; the largest is 1.
    cosine <- sum(shapes[, m + 1] * want) / sqrt(sum(shapes[, m + 1]^2) * sum(want^2))
    expect_equal(abs(cosine), 1)
    expect_equal(max(abs(shapes[, m + 1])), 1)
  }
})

test_that("two rotors turn against each other, inversely to their inertia", {
  shapes <- rotdyn:::mode_shapes(c(1, 4), 100)
  expect_equal(shapes, cbind(c(1, 1), c(1, -0.25)))
})

test_that("modes draw without a warning, with their frequencies", {
  modes <- shaft_modes(scene_rotors(c(1, 4), 100))
  plot <- ggplot2::autoplot(modes)
  # sqrt(k (1/J1 + 1/J2)).
  expect_equal(levels(plot$data$panel), c("mode 1 (0 rad/s)", "mode 2 (11.2 rad/s)"))
  many <- shaft_modes(scene_rotors(rep(1, 30), 100))
  for (size in c(13, 24)) {
    expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(many, base_size = size)))
  }
  expect_equal(nlevels(ggplot2::autoplot(many)$data$panel), 6)
  # Panels side by side fill their rows.
  columns <- function(modes, size = 13) {
    length(unique(ggplot2::ggplot_build(
      ggplot2::autoplot(many, modes = modes, base_size = size)
    )$layout$layout$COL))
  }
  expect_equal(vapply(1:6, function(n) columns(seq_len(n)), 0), c(1, 1, 3, 2, 3, 3))
  expect_equal(columns(1:3, 18), 2)
  expect_match(levels(ggplot2::autoplot(many, modes = 30)$data$panel), "mode 30")
  expect_error(ggplot2::autoplot(many, modes = 31), class = "rotdyn_error_value")
})

test_that("the largest angle of each shape is 1, and shapes are orthogonal by the inertia", {
  expect_identical(mode_shapes(2, numeric()), matrix(1))
  inertia <- c(1, 2, 5)
  shapes <- mode_shapes(inertia, c(100, 30))
  expect_equal(apply(abs(shapes), 2, max), c(1, 1, 1))
  product <- crossprod(shapes, inertia * shapes)
  expect_lt(max(abs(product[upper.tri(product)])), 1e-12)
  expect_equal(shapes[, 1], c(1, 1, 1)) # all turn together without a spring
})
