skip_if_not_installed("ggplot2")

crane <- function() {
  static_equilibrium(
    forces(
      load_weight(100, c(2, 0), name = "jib"), load_force(c(0, -5000), c(4, 0), name = "load")
    ),
    list(foot = support_pin(c(0, 0)), cable = support_cable(c(3, 0), to_m = c(0, 3)))
  )
}
drawing_of <- function(x) draw_statics(attr(x, "rest"))
arrows <- function(drawing) {
  ends <- Filter(function(one) one$type == "arrow", drawing$marks)
  t(vapply(ends, function(one) one$points[nrow(one$points), ] - one$points[1, ], numeric(2)))
}

test_that("every force has an arrow along it, and a key", {
  drawing <- drawing_of(crane())
  expect_equal(drawing$quantities$symbol, c("F[1]", "F[2]", "R[1]", "R[2]"))
  expect_equal(drawing$quantities$name, c("jib", "load", "foot", "cable"))
  expect_equal(drawing$quantities$value[1:2], c("980.7 N down", "5000 N down"))
  way <- arrows(drawing)
  unit <- way / sqrt(rowSums(way^2))
  expect_equal(unit[1, ], c(0, -1))
  # The cable pulls up and to the left at 45 degrees; larger forces have longer arrows.
  expect_equal(unit[4, ], c(-1, 1) / sqrt(2))
  expect_equal(order(rowSums(way^2)), c(1L, 2L, 3L, 4L))
})

test_that("a bar is a rectangle along its ends, wherever they are", {
  for (ends in list(rbind(c(1, 1), c(1, 3)), rbind(c(-2, 5), c(2, 2)))) {
    bar <- thick_line(ends, half = 0.1)[[1]]$points
    expect_equal(colMeans(bar), colMeans(ends))
    sides <- sqrt(rowSums((bar - bar[c(2, 3, 4, 1), ])^2))
    long <- sqrt(sum((ends[2, ] - ends[1, ])^2))
    expect_equal(sides, c(long, 0.2, long, 0.2))
    expect_equal(sum((bar[2, ] - bar[1, ]) * (bar[3, ] - bar[2, ])), 0)
  }
})

test_that("couples turn as their sign, space is oblique, and all is drawn without a warning", {
  clamped <- function(couple) {
    static_equilibrium(load_couple(couple, c(1, 0)), support_fixed(c(0, 0), name = "wall"))
  }
  ends <- function(x) {
    turn <- Filter(function(one) one$type == "arrow", drawing_of(x)$marks)[[1]]$points
    turn[2, 2] - turn[1, 2]
  }
  expect_gt(ends(clamped(3)) * -ends(clamped(-3)), 0)
  expect_equal(drawing_of(clamped(3))$quantities$value, c("3 N m", "-3 N m"))
  door <- static_equilibrium(
    load_weight(25, c(0.4, 0, 1)),
    list(bottom = support_pin(c(0, 0, 0.2)), top = support_pin(c(0, 0, 1.8))),
    outline_m = cbind(c(0, 0.8, 0.8, 0, 0), 0, c(0, 0, 2, 2, 0)), name = "door"
  )
  expect_match(drawing_of(door)$note, "minimum norm")
  hinged <- static_equilibrium(
    load_force(c(0, 0, -60), c(0.5, 1, 0)),
    list(support_hinge(c(0, 0, 0), c(1, 0, 0)), support_rod(c(0, 1, 0), c(0, 0, 1)))
  )
  one <- static_equilibrium(load_weight(1, c(0, 0)), support_surface(c(0, 0), friction = 1))
  none <- static_equilibrium(forces(), support_pin(c(1, 1)))
  for (x in list(crane(), clamped(3), door, hinged, one, none)) {
    plot <- ggplot2::autoplot(x)
    expect_silent(ggplot2::ggplotGrob(plot))
    expect_match(plot$labels$alt, "^Drawing[.]")
  }
  expect_match(ggplot2::autoplot(door)$labels$title, "Door: rests")
  expect_error(ggplot2::autoplot(door, size = 2), class = "rotdyn_error_argument")
})

test_that("normals are dashed arrows into the body, with a key", {
  ladder <- static_equilibrium(
    load_weight(70, c(1, 2)), list(
      floor = support_surface(c(0, 0), friction = 0.6),
      wall = support_surface(c(2, 4), normal = c(-5, 0))
    )
  )
  drawing <- drawing_of(ladder)
  key <- drawing$quantities
  expect_equal(key$name[key$symbol == "n[2]"], "normal, wall")
  expect_equal(key$value[key$symbol %in% c("n[1]", "n[2]")], c("(0, 1)", "(-1, 0)"))
  dashed <- Filter(function(one) one$type == "arrow" && one$style == "dashed", drawing$marks)
  way <- vapply(dashed, function(one) one$points[2, ] - one$points[1, ], double(2))
  expect_equal(way, cbind(c(0, 0.3), c(-0.3, 0)))
  expect_silent(ggplot2::ggplotGrob(ggplot2::autoplot(ladder)))
})

test_that("the name of a force stands at its right, above a force along x", {
  label <- function(force) {
    d <- new_drawing()
    draw_force(d, c(0, 0), force, 1, "F", "load", TRUE, FALSE)
    drawing <- d$done(c(-1, 1, -1, 1), "")
    unlist(drawing$labels[c("x", "y")], use.names = FALSE) - drawing$marks[[1]]$points[2, ]
  }
  # Across the force, 0.17 from the tip.
  expect_equal(label(c(-1, -2, 0)), 0.17 * c(2, -1) / sqrt(5))
  expect_equal(label(c(1, 2, 0)), 0.17 * c(2, -1) / sqrt(5))
  expect_equal(label(c(0, 3, 0)), c(0.17, 0))
  expect_equal(label(c(2, 0, 0)), c(0, 0.17))
})

test_that("components of a force that are rounding are shown as zero, smaller ones are not", {
  text <- rotdyn:::force_text
  expect_identical(text(c(3, 4, 1e-14), 5, FALSE), "(3, 4, 0) N")
  expect_identical(text(c(3, 4, 1e-10), 5, FALSE), "(3, 4, 1e-10) N")
  expect_identical(text(c(0, -5), 5, TRUE), "5 N down")
})

test_that("the arrow of a pin ends at its point where it pushes, and leaves it where it pulls", {
  rest <- function(support) list(structure = list(supports = list(support)))
  pin <- support_pin(c(1, 0))
  expect_true(rotdyn:::pushes(rest(pin), 1, c(-1, 0, 0), c(1, 0, 0), c(0, 0, 0)))
  expect_true(rotdyn:::pushes(rest(pin), 1, c(0, 1, 0), c(1, 0, 0), c(0, 0, 0)))
  expect_false(rotdyn:::pushes(rest(pin), 1, c(1, 0, 0), c(1, 0, 0), c(0, 0, 0)))
  surface <- support_surface(c(1, 0))
  expect_true(rotdyn:::pushes(rest(surface), 1, c(1, 0, 0), c(1, 0, 0), c(0, 0, 0)))
})

drawn_rest <- function(x) draw_statics(check_equilibrium(x, "x", NULL))

test_that("a load along a line is arrows along it, with its sum", {
  beam <- static_equilibrium(
    forces(load_line(c(0, 300), from_m = c(0, 0), to_m = c(3, 0), name = "sand"),
           load_weight(20, c(2, 0), name = "beam")),
    list(left = support_pin(c(0, 0)), right = support_roller(c(3, 0)))
  )
  drawing <- drawn_rest(beam)
  key <- drawing$quantities
  expect_identical(key$value[key$symbol == "w[1]"], "0, 300 N/m, together 450 N down")
  expect_identical(key$name[key$symbol == "w[1]"], "sand")
  expect_false("F[1]" %in% key$symbol)
  down <- Filter(function(one) one$type == "arrow" && one$style == "weight", drawing$marks)
  long <- vapply(down, function(one) one$points[1, 2] - one$points[2, 2], 0)
  n <- length(long) - 1L # and the weight of the beam
  expect_equal(diff(long[seq_len(n)]), rep(diff(long[1:2]), n - 1L))
  # A table whose rows were changed is drawn by its resultants.
  loads <- load_line(150, from_m = c(1, 0), to_m = c(3, 0))
  loads$fy_n <- 2 * loads$fy_n
  rest <- static_equilibrium(loads, list(support_pin(c(0, 0)), support_roller(c(4, 0))))
  expect_true("F[1]" %in% drawn_rest(rest)$quantities$symbol)
})

test_that("a body on legs is a table", {
  legs <- list(a = c(0, 0, 0), b = c(1.2, 0, 0), c = c(1.2, 0.8, 0), d = c(0, 0.8, 0))
  stand <- function(z) {
    static_equilibrium(
      load_weight(20, c(0.5, 0.3, z)), lapply(legs, function(p) support_surface(p, friction = 0.4))
    )
  }
  bodies <- function(rest) {
    Filter(function(one) one$type == "fill" && one$style == "body", drawn_rest(rest)$marks)
  }
  expect_length(bodies(stand(0.7)), 5)
  expect_length(bodies(stand(0)), 1)
})

test_that("loads at one point stand beside each other", {
  rest <- static_equilibrium(
    forces(load_weight(20, c(2, 0)), load_weight(10, c(2, 0))),
    list(support_pin(c(0, 0)), support_roller(c(4, 0)))
  )
  down <- Filter(function(one) one$type == "arrow" && one$style == "weight",
                 drawn_rest(rest)$marks)
  expect_equal(down[[2]]$points[1, 1] - down[[1]]$points[1, 1], 0.07)
})

test_that("arrows are to scale, but for small forces", {
  rest <- static_equilibrium(
    forces(load_force(c(0, -10), c(1, 0)), load_force(c(0, -0.1), c(1.5, 0))),
    list(support_pin(c(0, 0)), support_roller(c(2, 0), c(0, 1)))
  )
  long <- function(drawing) {
    marks <- Filter(function(one) one$type == "arrow" && one$style != "dashed", drawing$marks)
    vapply(marks, function(one) sqrt(sum(diff(one$points)^2)), 0)
  }
  drawing <- drawing_of(rest)
  expect_equal(long(drawing), 0.75 * c(1, 0.2, 0.5025, 0.5075))
  expect_match(drawing$note, "to scale, but for small forces")
})
