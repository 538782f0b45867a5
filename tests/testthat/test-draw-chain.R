test_that("a chain is drawn from its pivot to its end", {
  chain <- scene_chain(c(1, 3), 1, c(0.5, 2), links = "points", resistance = 0.1)
  places <- chain_places(chain, c(0.5, 2))
  expect_equal(places[3, ], c(sin(0.5) + 3 * sin(2), -cos(0.5) - 3 * cos(2)) / 4)
  drawing <- draw_chain(chain)
  expect_true(all(c("l", "m", "theta[i]", "omega[0]", "c") %in% drawing$quantities$symbol))
  skip_if_not_installed("ggplot2")
  expect_match(ggplot2::autoplot(chain)$labels$alt, "lengths 1, 3 m")
  rods <- scene_chain(c(1, 3), 1, c(0.5, 2))
  expect_match(ggplot2::autoplot(rods)$labels$title, "A double pendulum: two rods")
  skip_if_not_installed("gifski")
  motion <- trajectory(rods, c(0, 0.5, 1))
  frames <- chain_frames(rods, motion)
  path <- frames[[3]]$marks[[1]]$points
  expect_equal(path[2, ], c(motion$x_m[6], motion$y_m[6]) / 4)
  film <- animate_motion(motion, tempfile(fileext = ".gif"), frames_per_s = 2, width_px = 100)
  expect_gt(file.size(film), 1000)
})

test_that("the picture of a chain holds all of it, whichever way it hangs", {
  for (theta in list(c(0, 0), c(pi / 2, pi / 2), c(-pi / 2, 0), c(pi, 3))) {
    chain <- scene_chain(c(1, 3), 1, theta, links = "points")
    limits <- draw_chain(chain)$limits
    places <- chain_places(chain, theta)
    expect_true(all(limits[1] <= places[, 1] - 0.1 & places[, 1] + 0.1 <= limits[2]))
    expect_true(all(limits[3] <= places[, 2] - 0.1 & places[, 2] + 0.1 <= limits[4]))
  }
})

test_that("angles are drawn from the vertical to each link", {
  theta <- c(0.5, -1)
  drawing <- draw_chain(scene_chain(c(1, 3), 1, theta))
  arcs <- Filter(function(one) one$style == "resistance", drawing$marks)
  expect_length(arcs, 2)
  at <- chain_places(scene_chain(c(1, 3), 1, theta), theta)
  for (i in 1:2) {
    ends <- arcs[[i]]$points[c(1, 61), ] - rep(at[i, ], each = 2)
    expect_equal(atan2(ends[, 1], -ends[, 2]), c(0, theta[i]))
  }
  expect_true(all(c("theta[1]", "theta[2]") %in% drawing$labels$symbol))
})

test_that("of many links the first four numbers are said, then that there are more", {
  said <- function(length_m) {
    quantities <- draw_chain(scene_chain(length_m, 1, rep(0.1, length(length_m))))$quantities
    paste(unlist(quantities), collapse = "; ")
  }
  expect_match(said(1:5), "1, 2, 3, 4, ... m", fixed = TRUE)
  expect_match(said(1:4), "1, 2, 3, 4 m", fixed = TRUE)
  expect_match(said(c(2, 2)), "; 2 m", fixed = TRUE)
})
