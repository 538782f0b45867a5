skip_if_not_installed("ggplot2")

bars <- function(a) ggplot2::autoplot(a)$data

test_that("bars have the terms' lengths and meet where the motion balances", {
  # A wheel that coasts: I = 2, 10 rad/s, friction of 0.5 N m for 4 s: omega = 9.
  wheel <- scene_axle(2, 1, resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
  drawn <- bars(audit(trajectory(wheel, c(0, 4))))
  energy <- drawn[drawn$panel == "energy (J)", ]
  # Turned 10 * 4 + 0.25 * 16/2 = 42 rad: work 42 J, heat 21 J, change 21 J.
  expect_equal(energy$role, c("supplied", "dissipated", "change"))
  expect_equal(energy$from, c(0, 42, 0))
  expect_equal(energy$to, c(42, 21, 21))
  expect_equal(energy$value_text, c("42 J", "21 J", "21 J"))
  momentum <- drawn[drawn$panel != "energy (J)", ]
  expect_equal(last <- momentum$to[momentum$role == "change"], 2)
  expect_equal(momentum$to[momentum$role == "dissipated"], last)
})

test_that("terms of zero are left out, several changes follow each other", {
  drawn <- bars(audit(trajectory(scene_axle(2, 3), c(0, 4))))
  expect_false(any(grepl("heat", drawn$term)))
  shaft <- bars(audit(trajectory(scene_rotors(c(1, 2), 8, torque = c(3, 3)), c(0, 1))))
  energy <- shaft[shaft$panel == "energy (J)", ]
  change <- energy[energy$role == "change", ]
  expect_equal(change$from[2], change$to[1])
  expect_equal(change$to[2], energy$to[1])
})

test_that("it draws without a warning in letters of any size; without values it says so", {
  a <- audit(spin_up())
  for (size in c(13, 24)) expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(a, base_size = size)))
  expect_match(ggplot2::autoplot(a)$labels$alt, "work of the torque 55.12 J")
  expect_error(ggplot2::autoplot(audit(spin_up()[0, ])), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(a["balance"]), class = "rotdyn_error_type")
})

test_that("labels of many rows are made smaller until all fit the height of the picture", {
  size <- function(n, base = 13) {
    scene <- scene_rotors(rep(1, n), 8, torque = c(3, rep(0.5, n - 1)))
    a <- audit(trajectory(scene, c(0, 1)))
    plot <- ggplot2::autoplot(a, base_size = base)
    small <- plot$theme$axis.text.y$size
    drawn <- plot$data
    panels <- length(unique(drawn$panel))
    lines <- max(nchar(gsub("[^\n]", "", drawn$label))) + 1.3
    high <- 1.05 * small * max(table(drawn$panel)) * panels * lines
    # What titles and the strips of the panels leave of five inches.
    c(small = small, left = 360 - 4 * base - 2.3 * base * panels - high)
  }
  for (base in c(13, 18, 24)) {
    got <- size(2, base)
    expect_lte(got[["small"]], 0.66 * base)
    expect_true(got[["left"]] >= 0 || got[["small"]] <= 6)
  }
})

test_that("what is rounding is no bar", {
  # A free body: all changes are rounding.
  drawn <- bars(audit(trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), 0:5)))
  expect_true(all(drawn$from == 0 & drawn$to == 0))
  expect_false(any(duplicated(drawn$panel)))
  terms <- data.frame(
    term = c("work", "heat", "change"), role = c("supplied", "dissipated", "change"),
    value = c(2, 1e-15, 2)
  )
  expect_equal(balance_bars(terms, "J", "energy")$term, c("work", "change"))
  expect_equal(balance_bars(terms, "J", "energy", 3)$to, 0)
  # A small loss is one.
  terms$value[2] <- 1e-11
  expect_equal(balance_bars(terms, "J", "energy")$term, terms$term)
})

test_that("balances of nothing but rounding are named beside those with bars", {
  a <- audit(trajectory(scene_free(c(1, 2, 3), c(0.1, 4, 0.1), torque = c(0, 0, 1)), 0:3))
  plot <- ggplot2::autoplot(a)
  expect_true(all(tapply(plot$data$from != plot$data$to, as.character(plot$data$panel), any)))
  expect_match(plot$labels$subtitle, "0, but for rounding: quaternion norm")
  expect_match(plot$labels$alt, "Nothing but rounding: quaternion norm")
  small <- audit(trajectory(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1e-5), 0:5))
  plot <- ggplot2::autoplot(small)
  expect_equal(levels(plot$data$panel)[1], "energy (1e-12 J)")
  terms <- small$terms[[1]]
  expect_equal(plot$data$to[1], 1e12 * terms$value[terms$value != 0][1])
})

test_that("the rows of short balances fit a picture of three inches", {
  height <- function(motion) {
    plot <- ggplot2::autoplot(audit(motion))
    panels <- length(unique(plot$data$panel))
    lines <- max(nchar(gsub("[^\n]", "", plot$data$label))) + 1
    rows <- max(table(plot$data$panel)) * panels
    plot$theme$axis.text.y$size * 0.9 * lines * rows / (216 - 13 * (4 + 2.3 * panels))
  }
  expect_lt(height(spin_up()), 1)
  expect_lt(height(trajectory(scene_incline(body_sphere(1, 0.1), 30), 0:2)), 1)
})
