g <- 9.80665
reaction <- function(x, support) unlist(x[x$support == support, c("fx_n", "fy_n")])

beam <- function() {
  static_equilibrium(
    forces(load_weight(20, c(2, 0), name = "beam"), load_weight(50, c(1, 0), name = "box")),
    list(left = support_pin(c(0, 0)), right = support_roller(c(4, 0)))
  )
}

# A ladder of 5 m at an angle, with a man on it at a share of its length.
ladder <- function(friction, share = 0.8, wall = 0, man = 70) {
  top <- 5 * c(cospi(1 / 3), sinpi(1 / 3))
  static_equilibrium(
    forces(load_weight(12, top / 2, name = "ladder"), load_weight(man, share * top, name = "man")),
    list(
      floor = support_surface(c(0, 0), friction = friction),
      wall = support_surface(top, normal = c(-1, 0), friction = wall)
    )
  )
}

block <- function(push, friction, height = 1.5) {
  static_equilibrium(
    forces(load_weight(10, c(0.5, 1)), push = load_force(c(push, 0), c(0, height))),
    list(
      left = support_surface(c(0, 0), friction = friction),
      right = support_surface(c(1, 0), friction = friction)
    )
  )
}

test_that("lever, see-saw, beam: by hand", {
  # 800 N at 0.3 m are lifted by 200 N at 1.2 m; the fulcrum bears both.
  lever <- static_equilibrium(
    forces(load_force(c(0, -800), c(-0.3, 0)), load_force(c(0, -200), c(1.2, 0))),
    support_pin(c(0, 0), name = "fulcrum")
  )
  expect_equal(reaction(lever, "fulcrum"), c(fx_n = 0, fy_n = 1000))
  expect_equal(summary(lever)$verdict, "rests")
  expect_equal(summary(lever)$free_motions, 1)
  # 30 kg at 2 m against 40 kg at 1.5 m; 41 kg turn it down on the right.
  seesaw <- function(mass) {
    static_equilibrium(
      forces(load_weight(30, c(-2, 0)), boy = load_weight(mass, c(1.5, 0))), support_pin(c(0, 0))
    )
  }
  expect_equal(reaction(seesaw(40), "pin")[["fy_n"]], 70 * g)
  expect_equal(summary(seesaw(41))$verdict, "moves")
  expect_equal(summary(seesaw(41))$motion, "rotation about (0, 0) m, clockwise")
  expect_match(summary(seesaw(39))$motion, "counter-clockwise")
  expect_equal(unlist(load_factors(seesaw(40))[2, 2:3]), c(1, 1), ignore_attr = TRUE)
  # Torques about the left end: 4 R = 2 20 g + 1 50 g.
  expect_equal(reaction(beam(), "right")[["fy_n"]], 22.5 * g, tolerance = 1e-15)
  expect_equal(reaction(beam(), "left")[["fy_n"]], 47.5 * g, tolerance = 1e-15)
  expect_equal(beam()$normal_n, c(NA, 22.5 * g))
})

test_that("a ladder: the friction that it needs", {
  # About the foot: N_wall 5 sin 60 = 12 g 2.5 cos 60 + 70 g 4 cos 60.
  wall <- (12 * 2.5 + 70 * 4) * g * 0.5 / (5 * sqrt(0.75))
  held <- ladder(0.5)
  expect_equal(held$normal_n, c(82 * g, wall), tolerance = 1e-14)
  expect_equal(held$friction_n[1], wall, tolerance = 1e-14)
  expect_equal(held$friction_needed[1], wall / (82 * g), tolerance = 1e-14)
  expect_equal(held$sliding_margin[1], 1 - wall / (82 * g) / 0.5, tolerance = 1e-13)
  expect_equal(summary(held)$tipping_margin_n, wall, tolerance = 1e-14)
  expect_equal(reaction(held, "floor"), c(fx_n = wall, fy_n = 82 * g), tolerance = 1e-14)
  needed <- held$friction_needed[1]
  expect_equal(summary(ladder(needed * (1 + 1e-12)))$verdict, "rests")
  slipping <- ladder(needed * (1 - 1e-9))
  expect_equal(summary(slipping)$verdict, "slides")
  expect_equal(slipping$state, c("slides", "holds"))
  # It turns about the point where the two normals meet: above the foot, beside the top.
  expect_equal(summary(slipping)$motion, "rotation about (0, 4.33) m, clockwise")
  # With friction 0.4 the man stands where his torque is 0.4 82 g 5 sin 60 - 12 g 1.25.
  share <- (0.4 * 82 * 5 * sqrt(0.75) - 12 * 1.25) / (70 * 2.5)
  expect_equal(summary(ladder(0.4, share - 1e-9))$verdict, "rests")
  expect_equal(summary(ladder(0.4, share + 1e-9))$verdict, "slides")
})

test_that("a ladder with friction at the wall, too, is redundant: ranges by hand", {
  both <- ladder(0.5, wall = 0.2)
  expect_equal(summary(both)$redundant, 1)
  expect_false(any(both$determined))
  ends <- reactions(both)
  # The wall's push is least with the wall's full friction: N (5 s + 0.2 5 c) = M.
  m <- (12 * 2.5 + 70 * 4) * g * 0.5
  c5 <- 2.5
  s5 <- 5 * sqrt(0.75)
  least <- m / (s5 + 0.2 * c5)
  # It is largest where the floor's grip is used up or the wall's friction points down.
  # f = N, floor's push P = 82 g - F, N s + F c = M; with N = 0.5 P: F = (M - N s)/c.
  most <- (0.5 * (82 * g * c5 - m)) / (c5 - 0.5 * s5)
  most <- min(most, m / (s5 - 0.2 * c5))
  wall <- ends[ends$support == "wall" & ends$component == "fx_n", ]
  expect_equal(c(-wall$highest, -wall$lowest), c(least, most), tolerance = 1e-9)
  # The reactions given are inside, and of least norm among those that hold.
  expect_true(all(ends$value >= ends$lowest - ends$error & ends$value <= ends$highest + ends$error))
})

test_that("a block that is pushed tips or slides, whichever comes first", {
  # It tips about its right edge beyond W/2/1.5, slides beyond mu W.
  weight <- 10 * g
  expect_equal(summary(block(weight / 3 - 1e-6, 0.5))$verdict, "rests")
  tips <- block(weight / 3 + 1e-6, 0.5)
  expect_equal(summary(tips)$verdict, "tips")
  expect_equal(summary(tips)$motion, "rotation about (1, 0) m, clockwise")
  expect_equal(summary(block(0.2 * weight - 1e-6, 0.2))$verdict, "rests")
  expect_equal(summary(block(0.2 * weight + 1e-6, 0.2))$verdict, "slides")
  limits <- load_factors(block(10, 0.5))
  push <- limits[limits$load == "push", ]
  expect_equal(push$highest_factor, weight / 30, tolerance = 1e-10)
  expect_equal(push$lowest_factor, -weight / 30, tolerance = 1e-10)
  expect_equal(c(push$below, push$above), c("tips", "tips"))
  low <- load_factors(block(10, 0.2))
  expect_equal(low$highest_factor[2], 0.02 * weight, tolerance = 1e-10)
  expect_equal(low$above[2], "slides")
  # Each grip may be anything; both pushes are determined.
  ends <- reactions(block(10, 0.5))
  expect_equal(ends$determined, c(FALSE, TRUE, FALSE, TRUE))
  expect_equal(ends$value[c(2, 4)], c(weight / 2 - 15, weight / 2 + 15))
})

test_that("a door on two hinges: sideways determined, upright not", {
  door <- static_equilibrium(
    load_weight(25, c(0.4, 0, 1)),
    list(bottom = support_pin(c(0, 0, 0.2)), top = support_pin(c(0, 0, 1.8)))
  )
  # About the bottom: F 1.6 = 25 g 0.4.
  expect_equal(door$fx_n, c(1, -1) * 25 * g / 4, tolerance = 1e-15)
  expect_equal(door$fz_n, rep(12.5 * g, 2), tolerance = 1e-15)
  ends <- reactions(door)
  expect_equal(ends$determined, rep(c(TRUE, TRUE, FALSE), 2))
  expect_equal(ends$highest[3], Inf)
  s <- summary(door)
  expect_equal(c(s$redundant, s$free_motions), c(1, 1))
  expect_match(s$motion, "rotation about the axis through (0, 0, 0.2) m along (0, 0, 1)",
               fixed = TRUE)
  # One hinge that slides: all is determined.
  one <- static_equilibrium(
    load_weight(25, c(0.4, 0, 1)),
    list(bottom = support_pin(c(0, 0, 0.2)), top = support_roller(c(0, 0, 1.8), c(1, 0, 0)),
         side = support_roller(c(0, 0, 1.8), c(0, 1, 0)))
  )
  expect_equal(summary(one)$redundant, 0)
  expect_equal(one$fz_n[1], 25 * g)
})

test_that("a crane with a cable, which does not push", {
  crane <- function(load) {
    static_equilibrium(
      forces(
        load_weight(100, c(2, 0), name = "jib"), load_force(c(0, -load), c(4, 0), name = "load")
      ),
      list(foot = support_pin(c(0, 0)), cable = support_cable(c(3, 0), to_m = c(0, 3)))
    )
  }
  # About the foot: T 3/sqrt(2) = 200 g + 4 load.
  up <- crane(5000)
  expect_equal(up$normal_n[2], (200 * g + 20000) * sqrt(2) / 3, tolerance = 1e-14)
  expect_equal(up$fx_n, c(1, -1) * up$normal_n[2] / sqrt(2), tolerance = 1e-14)
  lifted <- crane(-500)
  expect_equal(lifted$state, c("holds", "slack"))
  expect_equal(summary(lifted)$verdict, "tips")
  expect_equal(load_factors(up)$lowest_factor[2], -200 * g / 20000, tolerance = 1e-10)
})

test_that("one unknown for each motion: fixed ends, hinges, rods", {
  wall <- static_equilibrium(
    forces(load_line(c(0, 300), c(0, 0), c(3, 0)), load_couple(50, c(2, 0))),
    support_fixed(c(0, 0), name = "wall")
  )
  expect_equal(c(wall$fy_n, wall$torque_n_m), c(450, 900 - 50))
  # A shelf on a hinge along x and a rod: 6 unknowns.
  shelf <- static_equilibrium(
    load_force(c(0, 0, -60), c(0.5, 1, 0)),
    list(hinge = support_hinge(c(0, 0, 0), c(1, 0, 0)), rod = support_rod(c(0, 1, 0), c(0, 0, 1)))
  )
  expect_equal(summary(shelf)$redundant, 0)
  # About the hinge's axis: T/sqrt(2) 1 = 60.
  expect_equal(shelf$normal_n[2], 60 * sqrt(2))
  expect_equal(unlist(shelf[1, c("fx_n", "fy_n", "fz_n")]), c(0, 60, 0), ignore_attr = TRUE)
  # The couple about y bears the load's 0.5 m along x.
  expect_equal(
    unlist(shelf[1, c("torque_x_n_m", "torque_y_n_m", "torque_z_n_m")]), c(0, -30, 0),
    ignore_attr = TRUE
  )
})

test_that("forces and torques of loads and supports add up to nothing, about any point", {
  set.seed(11)
  for (i in 1:60) {
    plane <- i %% 2 == 0
    n <- if (plane) 2L else 3L
    point <- function() round(rnorm(n), 2)
    loads <- forces(lapply(1:3, function(j) load_force(rnorm(n), point())))
    supports <- if (plane) {
      list(support_pin(point()), support_rod(point(), point()))
    } else {
      c(list(support_pin(point())), lapply(1:3, function(j) support_rod(point(), point())))
    }
    x <- static_equilibrium(loads, supports)
    all <- forces(loads, as.data.frame(x)[setdiff(names(loads), "load")])
    sum <- resultant(all, rnorm(n))
    size <- max(x$force_n)
    expect_lte(sum$force_n, 1e-14 * size)
    torque <- unlist(sum[grep("^torque_(|._)n_m", names(sum))])
    expect_lte(max(abs(torque)), 1e-13 * size)
    expect_lte(summary(x)$residual_force_n, 1e-15 * size)
  }
})

test_that("the error covers half an ulp of each number, and grows near to a mechanism", {
  # Three rods of which the third misses the common point by 1e-6: a condition of 1e6.
  near <- function(shift, load = 1) {
    static_equilibrium(
      load_force(c(0, -load), c(0.3, 0)),
      list(support_rod(c(0, 0), c(1, 1)), support_rod(c(2, 0), c(1, 1)),
           support_rod(c(1, 0), c(1 + shift, 1)))
    )
  }
  good <- near(0.5)
  bad <- near(1e-6)
  expect_lt(max(good$error_n), 3e-14)
  expect_gt(min(bad$error_n), 1e-11)
  expect_lt(max(bad$error_n / bad$force_n), 1e-8)
  expect_gt(summary(bad)$condition_number, 1e5)
  # A change of the last digit moves the reactions by no more than the error.
  moved <- near(1e-6 * (1 + 2^-52), 1 + 2^-52)
  expect_true(all(abs(moved$normal_n - bad$normal_n) <= 2 * bad$error_n))
  expect_equal(summary(near(0))$verdict, "moves")
  expect_equal(summary(near(1e-14))$free_motions, 1)
})

test_that("legs that only push: a corner lifts, or the table tips", {
  legs <- lapply(list(c(0, 0, 0), c(1, 0, 0), c(0, 1, 0), c(1, 1, 0)), support_surface)
  table <- function(x, y) static_equilibrium(load_weight(10, c(x, y, 1)), legs)
  even <- table(0.5, 0.5)
  expect_equal(even$normal_n, rep(2.5 * g, 4))
  expect_equal(summary(even)$redundant, 1)
  # Near a corner the minimum norm without conditions pulls at the opposite leg.
  corner <- table(0.9, 0.9)
  expect_equal(corner$normal_n, c(0, 1, 1, 8) * g, tolerance = 1e-14)
  expect_identical(corner$normal_n[1], 0)
  expect_equal(summary(corner)$verdict, "rests")
  expect_output(print(corner), "minimum norm among those that only push")
  outside <- table(1.1, 0.5)
  expect_equal(summary(outside)$verdict, "tips")
  expect_match(summary(outside)$motion, "along (0, 1, 0)", fixed = TRUE)
})

test_that("many rough feet in space", {
  feet <- lapply(1:12, function(i) support_surface(c(cos(i), sin(i), 0), friction = 0.3))
  x <- static_equilibrium(
    forces(weight = load_weight(5, c(0, 0, 0.5)), pull = load_force(c(8, 3, 0), c(0, 0, 0))), feet
  )
  expect_equal(summary(x)$verdict, "rests")
  expect_equal(sum(x$fz_n), 5 * g)
  expect_equal(c(sum(x$fx_n), sum(x$fy_n)), c(-8, -3))
  # Circular friction, all feet together: 0.3 5 g against sqrt(73).
  limits <- load_factors(x)
  expect_equal(limits$highest_factor[2], 1.5 * g / sqrt(73), tolerance = 1e-7)
  expect_equal(limits$above[2], "slides")
})

test_that("three wedged surfaces in space: the least norm that pushes, by another program", {
  x <- static_equilibrium(
    forces(
      load_force(c(0, 0, -247.1276), c(0.97, 1.02, 0.07)),
      load_force(c(-1.5, -21.4, 16.3), c(1.33, -0.89, 1.19))
    ), list(
      a = support_surface(c(2.95, 3.01, -1.45), c(0.36, 1.8, 0.22), Inf),
      b = support_surface(c(2.85, 2.84, -0.68), c(0.07, 0.2, 0.39), 0.5),
      c = support_surface(c(-2.55, 3.56, 2.18), c(0.08, 1.2, 0.42), Inf)
    )
  )
  # Sequential quadratic programming (SLSQP of scipy 1.10), which has 8 digits.
  expect_equal(
    reactions(x)$value,
    c(17418.50640581, -1781.94549181, -13923.45645835, 267.36042906, 21.80169867, 2480.24288754,
      -17684.36683487, 1781.54379314, 11674.04117081), tolerance = 1e-7
  )
  # The first surface only grips; it never slides. The second is at its limit.
  expect_gte(min(x$normal_n), 0)
  expect_lt(x$normal_n[1], 1e-8)
  expect_equal(x$friction_needed[2], 0.5, tolerance = 1e-14)
  expect_gte(min(x$sliding_margin), 0)
  expect_equal(summary(x)$verdict, "rests")
  expect_lt(summary(x)$residual_force_n, 1e-11)
  expect_true(all(x$error_n < 1e-7))
})

test_that("redundant supports in space: table, verdict and limits agree", {
  set.seed(7)
  seen <- character()
  for (i in 1:60) {
    at <- function() round(rnorm(3), 2)
    feet <- lapply(1:sample(2:6, 1), function(i) {
      support_surface(at(), c(round(rnorm(2), 2), round(runif(1, 0.2, 2), 2)),
                      sample(c(0, 0.2, 0.5, Inf), 1, prob = c(1, 3, 3, 2)))
    })
    loads <- forces(load_force(c(0, 0, -100), at()), load_force(round(rnorm(3, 0, 9), 1), at()))
    cable <- at()
    rest <- static_equilibrium(loads, c(feet, list(support_cable(cable, cable + c(0.2, 0, 1)))))
    verdict <- summary(rest)$verdict
    seen <- c(seen, verdict)
    limits <- load_factors(rest)
    inside <- limits$lowest_factor <= 1 & limits$highest_factor >= 1
    size <- max(rest$force_n)
    if (verdict == "rests") {
      expect_true(all(rest$state == "holds") && all(rest$normal_n >= -1e-14 * size))
      rough <- !is.na(rest$friction_n)
      friction <- vapply(feet, `[[`, 0, "friction")[rough[seq_along(feet)]]
      expect_true(all(rest$friction_needed[rough] <= friction * (1 + 1e-12)))
      expect_true(all(rest$sliding_margin[rough] >= 0))
      all <- forces(loads, as.data.frame(rest)[names(loads)[-1]])
      total <- resultant(all)
      expect_lte(total$force_n, 1e-13 * size)
      expect_lte(max(abs(unlist(total[couple_columns(FALSE)]))), 1e-12 * size)
      expect_true(all(inside))
      ends <- reactions(rest)
      expect_true(all(ends$value >= ends$lowest & ends$value <= ends$highest))
    } else if (verdict != "moves") {
      expect_false(all(rest$state == "holds"))
      expect_false(any(inside %in% TRUE))
    }
  }
  expect_true(all(table(seen)[c("rests", "slides", "tips")] > 4))
})

test_that("at the edge of rest the ranges of redundant reactions are finite", {
  # Each contact is about to slide: forces only along the edges of the cones, and across s1, in
  # self-stress along one vector of mixed signs (by singular values of those 6 columns): s3 from 0
  # to 7.661 N. Inside by 3e-7 of the loads, the cones open by the square root of that.
  at <- rbind(
    c(-0.227947303587505, 0.475587317546567, 0.633637812060369),
    c(-0.505048865162588, 0.609510161919548, 0.582778913270913),
    c(-0.621589799430354, 0.361449122572236, 0.564413454398882),
    c(-0.649522958321476, 0.380025271285642, 0.743057324158504),
    c(-0.292296446994436, 0.638529601759886, 0.402229673459524),
    c(-0.69887730726378, 0.74867108094964, 0.577941992431611)
  )
  along <- rbind(
    c(0.720069273523599, 0.100543697605239, 0.686579351713306),
    c(-0.20702597995844, 0.651123273256432, 0.866940961066565),
    c(-0.241056628280863, -0.115071660874332, 0.269666136938301),
    c(0.0119805160117967, 0.40346271423006, 0.914917649552245),
    c(0.422950390385406, -0.377723940291109, 1.24645826783949),
    c(0.0676028155025921, -0.0923985711955425, -0.0301052991360866)
  )
  friction <- c(Inf, NA, 0, 0.920751772960648, 1.43059881667141, 0.160139768163208)
  supports <- lapply(1:6, function(i) {
    if (i == 2) return(support_cable(at[i, ], along[i, ]))
    support_surface(at[i, ], along[i, ], friction[i])
  })
  loads <- forces(
    load_force(c(6.98362130491128, -6.70527190083603, -6.17624066189524),
               c(-0.469711690220027, 0.29072898518036, 0.704926091139186)),
    load_force(c(2.84146858126742, 12.1396810388645, -4.92392453073774),
               c(-0.703946584494016, 0.599737471736528, 0.767508674253963)),
    load_couple(c(3.27929797691406, 0.109690183866251, 3.46867577072112))
  )
  edge <- static_equilibrium(loads, supports)
  expect_identical(summary(edge)$verdict, "rests")
  range <- reactions(edge)
  expect_true(all(is.finite(c(range$lowest, range$highest))))
  expect_equal(range$highest[range$component == "normal_n"], 7.661247, tolerance = 3e-3)
  expect_lt(abs(range$lowest[range$component == "normal_n"]), 1e-2)
})

test_that("no supports, no loads", {
  free <- static_equilibrium(load_force(c(1, 0), c(0, 0)), list())
  expect_equal(summary(free)$verdict, "moves")
  expect_equal(summary(free)$motion, "translation along (1, 0)")
  expect_equal(nrow(free), 0)
  idle <- static_equilibrium(forces(), support_pin(c(1, 1)))
  expect_equal(idle$force_n, 0)
  expect_equal(summary(idle)$verdict, "rests")
  expect_equal(nrow(load_factors(idle)), 0)
})

test_that("extreme units change no bit", {
  x <- function(length, force) {
    static_equilibrium(
      load_force(c(0, -8) * force, c(1, 0) * length),
      list(support_pin(c(0, 0)), support_roller(c(4, 0) * length))
    )$fy_n / force
  }
  for (length in 2^c(-990, 0, 990)) for (force in 2^c(-1000, 0, 1000)) {
    expect_identical(x(length, force), c(6, 2))
  }
})

test_that("prints, columns and damaged results", {
  expect_output(print(beam()), "determinate: 3 unknowns, 3 equations")
  expect_output(print(ladder(0.5)), "friction left 12.7 %", fixed = TRUE)
  expect_output(print(ladder(0.3)), "slides: more friction is needed")
  known <- column_table()$name
  for (table in list(
    beam(), summary(beam()), reactions(beam()), load_factors(beam()), resultant(load_couple(1)),
    force_torques(load_force(c(1, 2, 3), c(1, 2, 3))), resultant(load_couple(c(1, 2, 3)))
  )) expect_identical(setdiff(names(table), known), character())
  expect_identical(glance(beam()), summary(beam()))
  forged <- beam()
  rest <- attr(forged, "rest")
  rest$structure$problem$at <- rest$structure$problem$at + 1
  attr(forged, "rest") <- rest
  expect_error(summary(forged), class = "rotdyn_error_type")
  expect_error(reactions(1), class = "rotdyn_error_type")
  expect_error(load_factors(), class = "rotdyn_error_missing")
  expect_error(static_equilibrium(load_couple(1)), class = "rotdyn_error_missing")
  expect_error(
    static_equilibrium(load_couple(1), list(), rank_tolerance = 0), class = "rotdyn_error_value"
  )
  expect_error(
    static_equilibrium(load_couple(1), list(), outline_m = 1), class = "rotdyn_error_type"
  )
})

test_that("reactions so large that their rounding bears the load are none", {
  surface <- function(...) {
    x <- c(...)
    support_surface(x[1:3], x[4:6], x[7])
  }
  rod <- function(...) support_rod(c(...)[1:3], c(...)[4:6])
  supports <- list(
    surface(
      20.503972579436805, 6.903759681585007, -5.8668503009207855,
      -0.8707655240634338, 0.14386139406037682, 0.47018220021768037, 0.2865261561702937
    ),
    surface(
      29.40351002666219, 2.9835399633491217, -13.120079141546839,
      -0.0303487798707643, 0.7826254198304042, -0.6217526870031521, 1.2057813659659586
    ),
    surface(
      38.17177380000044, 17.785332739344916, -7.942271447813268,
      0.7665221815807356, 1.0775875276104268, 0.7314638610873622, 0.8302431867341511
    ),
    rod(
      38.5774617197949, 14.352112675269666, -5.604126244392244,
      36.454732376451844, 13.88282795375833, 5.270748023757072
    ),
    rod(
      32.64953539315099, 18.841966887409654, -4.853322352511871,
      31.389899019269393, 18.669234604546773, -5.6825384025721375
    ),
    surface(
      26.55294822425412, 19.12260079293285, -22.667874538676926,
      -2.3977845357249623, 2.1653972419426295, -2.5824990798300753, 0.7366401601349936
    ),
    surface(
      21.160456890430822, 16.99122359354101, -18.717702480027302,
      0.15215478364486704, 0.2375294897611153, 0.9593897348355401, 0.2327507205773145
    )
  )
  names(supports) <- letters[1:7]
  one <- c(-0.05359219183102313, -0.02303662835643951, 0.11540564677558832)
  two <- c(-0.04443485795545432, 0.01004010321829943, -0.20830894075710552)
  loads <- forces(
    load_force(one, c(22.856961359528555, 19.487219399321038, -13.56972839131447), name = "one"),
    load_force(two, c(19.248612008026107, 18.81852060307252, -21.794330108410954), name = "two"),
    load_couple(c(-1.57863211004738, 0.21737971329458153, -0.2100410624744298), name = "couple")
  )
  # No reaction works against this velocity, by the angles of its normals, and the loads drive it.
  along <- c(-0.1027604, 0.7005403, 0.0101721)
  along <- along / sqrt(sum(along^2))
  for (s in supports[-(4:5)]) {
    up <- sum(s$normal * along) / sqrt(sum(s$normal^2))
    expect_lte(s$friction * sqrt(1 - up^2), up + 1e-7)
  }
  for (s in supports[4:5]) expect_lte(abs(sum((s$to_m - s$at_m) * along)), 1e-5)
  expect_gt(sum((one + two) * along), 3e-5)
  expect_identical(summary(static_equilibrium(loads, supports))$verdict, "slides")
})

test_that("a problem in numbers whose contact has no reactions is refused", {
  problem <- structure_of(
    forces(load_weight(1, c(0, 0))), list(floor = support_surface(c(0, 0), friction = 1)), 1e-10
  )$problem
  expect_length(.Call(ffi_statics_solve, problem), 10)
  for (first in c(-1, 5, NaN)) {
    problem$first <- first
    expect_error(.Call(ffi_statics_solve, problem), "internal")
  }
})

# A structure of bench/coverage/statics.R at the edge of rest: two surfaces that cannot slide, of
# one normal, may be squeezed without limit, as a linear program in exact directions says. The
# search has no answer beyond 1e10 times the loads.
test_that("a range that is not bounded is not given a far bound", {
  normal <- c(0.77035564667771, -0.303156203922847, 0.560935373866595)
  x <- static_equilibrium(
    forces(
      load_force(
        c(1.47648949404312, -4.44794782887807, -1.14072231821282),
        c(-0.0156687890916224, 0.0413912683469518, -0.00656717601011748)
      ),
      load_force(
        c(-2.77643049230985, 3.74716288530595, 2.54714454204311),
        c(-0.0338298306230141, -0.0100212470103778, 0.0166785932074493)
      ),
      load_couple(c(0.345406349218839, -0.148811593034169, 0.187667067370903))
    ),
    list(
      s1 = support_surface(
        c(0.00398391138370484, -0.0101492232516916, 0.0367783258364228), normal, friction = Inf
      ),
      s2 = support_surface(
        c(-0.00902559260343295, 0.0085912426763352, -0.0114976334930544),
        c(-0.158016374521525, -0.943067422491792, -0.292668177323333), friction = 0
      ),
      s3 = support_rod(
        c(-0.00538057757827384, -0.0355836257239149, -0.0326523456229543),
        c(0.0885042655383402, 0.195341578787111, -0.0367852827680744)
      ),
      s4 = support_surface(
        c(-0.0263859898172759, -0.0258155529847502, 0.0235093498019939),
        c(0.798845934656411, 0.349833439073925, 0.489348278415931), friction = 1.2622729345574
      ),
      s5 = support_cable(
        c(0.0257106123563686, 0.0330625976242817, 0.0108706269218386),
        c(0.0585901617004607, 0.0201235876892783, 0.0348119096052762)
      ),
      s6 = support_surface(
        c(0.022711855197292, 0.0158692208322221, -0.0200727463650268),
        c(0.859908225746299, 0.182951162135619, -0.47653616396563), friction = 0
      ),
      s7 = support_surface(
        c(-0.0201164484842, -0.0417847449280092, 0.0288573813147612), normal, friction = Inf
      ),
      s8 = support_rod(
        c(0.0361439881141298, 0.0305690177605245, 0.0424856646626491),
        c(0.0322842238955802, 0.0278478199520597, 0.0463157728408112)
      )
    )
  )
  r <- reactions(x)
  squeezed <- r[r$support %in% c("s1", "s7"), ]
  expect_identical(squeezed$lowest, rep(-Inf, 6))
  expect_identical(squeezed$highest, rep(Inf, 6))
  # What the loads alone decide stays bounded.
  expect_lt(max(r$highest[r$support %in% c("s5", "s6")]), 1e-3)
})

test_that("the core takes no contact beside the reactions", {
  plank <- structure_of(
    forces(load_force(c(0, -10), c(1, 0))),
    list(support_surface(c(0, 0), c(0, 1), 0.5), support_surface(c(2, 0), c(0, 1), 0.5)), 1e-9
  )
  expect_type(.Call(rotdyn:::ffi_statics_solve, plank$problem), "list")
  for (first in c(-1, 3, NaN)) {
    wrong <- plank$problem
    wrong$first[2] <- first
    expect_error(.Call(rotdyn:::ffi_statics_solve, wrong), "first")
  }
})

test_that("supports that were filtered or changed are no equilibrium of the whole", {
  whole <- beam()
  expect_identical(whole[], whole)
  for (part in list(whole[1, ], whole["support"], whole[2:1, ])) {
    expect_false(inherits(part, "rot_equilibrium"))
    expect_error(summary(reactions(part)), class = "rotdyn_error_type")
  }
  skip_if_not_installed("dplyr")
  expect_s3_class(dplyr::mutate(whole, force_kn = force_n / 1e3), "rot_equilibrium")
  expect_false(inherits(dplyr::filter(whole, support == "left"), "rot_equilibrium"))
  expect_false(inherits(dplyr::mutate(whole, force_n = 0), "rot_equilibrium"))
})

test_that("a wedge that no load pushes sideways grips from friction 5 on", {
  # Only the wedge has a force along x, which is 0: it pushes straight down, at the angle of tangent
  # 5 from its normal. Torques about x = 0: 2.2 n - 0.1 f = -60 g with the floor's n >= 0.
  wedged <- function(friction) {
    static_equilibrium(load_weight(20, c(-0.6, -0.5)), list(
      floor = support_surface(c(1.9, 0), c(0, 1)),
      wedge = support_surface(c(-0.2, 0), c(-1, -0.2), friction),
      step = support_surface(c(-0.3, 0.4), c(0, 1))
    ))
  }
  verdict <- vapply(c(3, 4.99, 5.01, 1e3, Inf), function(f) summary(wedged(f))$verdict, "")
  expect_identical(verdict, rep(c("slides", "rests"), 2:3))
  r <- reactions(wedged(5.01))
  expect_equal(r$value, c(0, 0, -60 * g, 80 * g), tolerance = 1e-13)
  expect_equal(r$highest[3], -60 * g, tolerance = 1e-9)
  expect_identical(c(r$lowest[2], r$highest[2]), c(0, 0))
})

test_that("no load at all: a body rests, however its supports stand", {
  x <- static_equilibrium(load_force(c(0, 0, -196), c(0.7, 1.4, 1.6), name = "one"), list(
    support_surface(c(0.4, 1.3, 0), c(-1.75, 1.95, 0.6), 0.5),
    support_roller(c(2.79, -1.88, 0.817), c(-1.7, 1.1, 1.3)),
    support_surface(c(-0.248, 0.501, 0), c(0, 0, 1), 0.3),
    support_rod(c(-0.3, -0.9, 1.4), c(-0.506, 1.15, -0.00267))
  ))
  limits <- load_factors(x)
  expect_identical(c(limits$lowest_factor, limits$highest_factor), c(0, 0))
  expect_identical(c(limits$below, limits$above), c("slides", "slides"))
})

test_that("a limit has its verdict where the search has none next to it", {
  x <- static_equilibrium(
    forces(
      load_force(c(10, -7, 11), c(-0.82, -1.03, -0.89), name = "up"),
      load_force(c(5, -6, -10), c(-1, 0.16, 0.48), name = "down")
    ), list(
      support_surface(c(-0.58, -1, -0.43), c(0, 0, 1), 1),
      support_surface(c(-0.69, 0.07, 0), c(0, 0, 1), 0.5),
      support_surface(c(-0.9, 0.3, -0.7), c(-0.5, 0.2, -0.4), 0.3)
    )
  )
  limits <- load_factors(x)
  expect_identical(limits$below, c("slides", "slides"))
  expect_identical(limits$above, c("slides", NA))
  # Both loads count by their ratio alone.
  expect_equal(limits$lowest_factor[2] * limits$highest_factor[1], 1, tolerance = 1e-6)
})

test_that("loads far beyond the supports leave the supports what they are", {
  for (x in 10^c(0, 6, 12, 14, 20, 100, 290)) {
    rest <- static_equilibrium(
      load_weight(20, c(x, 0)), list(left = support_pin(c(0, 0)), right = support_roller(c(4, 0)))
    )
    expect_identical(summary(rest)$verdict, "rests")
    expect_equal(rest$fy_n, 20 * 9.80665 * c(1 - x / 4, x / 4), tolerance = 1e-14)
  }
})
