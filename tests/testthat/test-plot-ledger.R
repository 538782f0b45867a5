test_that("the energy bars have the heights of the energies", {
  skip_if_not_installed("ggplot2")
  hit <- ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, 0.75, 0.5)
  ledger <- collision_ledger(hit)
  plot <- ggplot2::autoplot(ledger)
  expect_silent(built <- ggplot2::ggplot_build(plot))
  bars <- built$data[[1]]
  tops <- tapply(bars$ymax, as.integer(bars$x), max)
  expect_equal(unname(tops[1]), ledger$before[4], tolerance = 1e-14)
  expect_equal(unname(tops[2]), ledger$before[4], tolerance = 1e-12)
  # Each number stands in the middle of its bar.
  text <- built$data[[2]]
  text <- text[text$label != "", ]
  expect_gt(nrow(text), 3)
  for (i in seq_len(nrow(text))) {
    middle <- bars$x == text$x[i] & abs((bars$ymin + bars$ymax) / 2 - text$y[i]) < 1e-9
    size <- (bars$ymax - bars$ymin)[middle]
    expect_true(any(abs(size / as.numeric(sub(" J", "", text$label[i])) - 1) < 0.01))
  }
  expect_match(plot$labels$title, "balanced")
  expect_match(plot$labels$alt, "lost to friction 5.839 J")
  expect_error(ggplot2::autoplot(ledger, colour = 1), class = "rotdyn_error_argument")
  expect_error(
    ggplot2::autoplot(collision_ledger(disks_lock(1, 2, 0, 0))), class = "rotdyn_error_value"
  )
  expect_error(ggplot2::autoplot(ledger[1]), class = "rotdyn_error_type")
})

test_that("each loss has its colour, at rest and by friction", {
  skip_if_not_installed("ggplot2")
  hit <- ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, 0.75, 0.5)
  bars <- ggplot2::ggplot_build(ggplot2::autoplot(collision_ledger(hit)))$data[[1]]
  expect_false(anyNA(bars$fill))
  expect_length(unique(bars$fill[bars$ymax > bars$ymin]), 4)
  expect_true(all(rotdyn:::plot_colours[c(2, 5)] %in% bars$fill))
})
