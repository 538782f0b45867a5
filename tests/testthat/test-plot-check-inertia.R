test_that("margins are drawn for each tensor, with what fails in words", {
  skip_if_not_installed("ggplot2")
  tensors <- data.frame(
    object = c("arm", "lid"), ixx = 1, iyy = c(2, 1), izz = c(2.5, 3), ixy = 0, ixz = 0, iyz = 0
  )
  check <- check_inertia(tensors)
  p <- ggplot2::autoplot(check)
  expect_s3_class(ggplot2::ggplot_build(p)$plot, "ggplot")
  # By hand: c_min/I_max = (I1 + I2 - I3)/I_max: 0.5/2.5 of the arm, -1/3 of the lid.
  of <- function(name) {
    p$data$reach[p$data$tensor == name & p$data$condition == "triangle inequality"]
  }
  expect_equal(c(of("arm"), of("lid")), c(0.2, -1 / 3))
  expect_match(p$labels$alt, "arm: none; lid: triangle inequality", fixed = TRUE)
  # What fails alone leaves a tenth on the other side.
  bad <- check_inertia(data.frame(ixx = -1, iyy = -1, izz = -1, ixy = 0, ixz = 0, iyz = 0))
  expect_equal(ggplot2::autoplot(bad)$scales$get_scales("x")$limits, c(-1, 0.1))
  one <- ggplot2::autoplot(check_inertia(body_disk(1, 1)), base_size = 20)
  expect_s3_class(ggplot2::ggplot_build(one)$plot, "ggplot")
})

test_that("many tensors have twelve panels, a damaged check is refused", {
  skip_if_not_installed("ggplot2")
  many <- check_inertia(data.frame(ixx = 1, iyy = 1, izz = 1:30 / 10, ixy = 0, ixz = 0, iyz = 0))
  expect_equal(nlevels(ggplot2::autoplot(many)$data$tensor), 12)
  check <- check_inertia(body_disk(1, 1))
  for (name in c("margin", "verdict")) {
    damaged <- check
    damaged[[name]] <- NULL
    expect_error(ggplot2::autoplot(damaged), class = "rotdyn_error_type")
  }
  check$margin <- "a"
  expect_error(ggplot2::autoplot(check), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(check[0, ]), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(many, colour = 1), class = "rotdyn_error_argument")
})

test_that("a condition without a margin is drawn as missed", {
  skip_if_not_installed("ggplot2")
  checked <- check_inertia(diag(c(1, 2, 2.5)))
  checked$margin[1] <- NA
  expect_identical(ggplot2::autoplot(checked)$data$reach[1], -1)
  expect_true(all(ggplot2::autoplot(checked)$data$reach[-1] > -1))
})
