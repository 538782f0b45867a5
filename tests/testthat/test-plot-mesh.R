skip_if_not_installed("ggplot2")

test_that("each condition has its verdict and its count", {
  open <- list(vertices = rbind(0, diag(3)), faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3)))
  check <- check_mesh(open)
  plot <- ggplot2::autoplot(check)
  expect_equal(nrow(plot$data), nrow(check))
  failing <- plot$data[plot$data$verdict == "fails", ]
  expect_equal(failing$text, "no boundary edges: 3")
  expect_equal(sum(plot$data$verdict == "holds"), sum(check$verdict %in% "holds"))
  expect_false(any(duplicated(plot$data[c("x", "y")])))
  expect_match(plot$labels$alt, "fails: no boundary edges: 3.*fails: 1")
  closed <- check_mesh(list(
    vertices = open$vertices, faces = rbind(open$faces, c(2, 3, 4))
  ))
  expect_match(ggplot2::autoplot(closed)$labels$subtitle, "no condition that was checked fails")
  expect_error(ggplot2::autoplot(check["condition"]), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(check, 2), class = "rotdyn_error_argument")
  check$count <- "x"
  expect_error(ggplot2::autoplot(check), class = "rotdyn_error_type")
})
