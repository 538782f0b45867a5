box <- function(mass_kg, x, y, z) {
  body_tensor(mass_kg, mass_kg * c(y^2 + z^2, x^2 + z^2, x^2 + y^2) / 12)
}

expect_same_body <- function(got, want, tolerance = 1e-14) {
  expect_equal(got$mass_kg, want$mass_kg, tolerance = tolerance)
  expect_lte(max(abs(got$centre_m - want$centre_m)), tolerance * max(1, abs(want$centre_m)))
  expect_lte(
    max(abs(got$second_moment_kg_m2 - want$second_moment_kg_m2)),
    tolerance * sum(diag(want$second_moment_kg_m2))
  )
}

test_that("bricks make the box", {
  # Chrono's utest_CH_composite_inertia: half-lengths 2, 4, 6 m, 100 kg/m^3, centre at (1, 2, 3),
  # of 5 x 3 x 2 bricks.
  x <- 4 / 5
  y <- 8 / 3
  z <- 12 / 2
  bricks <- list()
  for (i in 0:4) for (j in 0:2) for (k in 0:1) {
    bricks <- c(bricks, list(place_body(
      box(100 * x * y * z, x, y, z),
      c(1 - 2 + (i + 0.5) * x, 2 - 4 + (j + 0.5) * y, 3 - 6 + (k + 0.5) * z)
    )))
  }
  whole <- join_bodies(bricks)
  expect_equal(whole$mass_kg, 38400, tolerance = 1e-15)
  expect_equal(as.double(whole$centre_m), c(1, 2, 3), tolerance = 1e-15)
  expect_equal(unname(diag(whole$inertia_kg_m2)), c(665600, 512000, 256000), tolerance = 1e-15)
  expect_lte(max(abs(whole$inertia_kg_m2[upper.tri(diag(3))])), 1e-9)
  expect_equal(nrow(whole$detail$parts), 30)
  # However they are grouped.
  nested <- join_bodies(join_bodies(bricks[1:11]), list(bricks[12:20], join_bodies(bricks[21:30])))
  expect_same_body(nested, whole)
})

test_that("two hemispheres make the sphere", {
  # Chrono, r = 1.5 m, 50 kg/m^3: 353.429173528852 kg, 206.259056739103 kg m^2 across at its centre,
  # which is 0.5625 m from the flat face.
  r <- 1.5
  m <- 50 * 2 / 3 * pi * r^3
  expect_equal(m, 353.429173528852, tolerance = 1e-14)
  half <- body_tensor(m, m * r^2 * c(83 / 320, 83 / 320, 2 / 5), c(0, 0, 3 / 8 * r))
  expect_equal(half$inertia_kg_m2["x", "x"], 206.259056739103, tolerance = 1e-14)
  expect_equal(half$centre_m[["z"]], 0.5625)
  upper <- place_body(half, c(0, 0, 2))
  lower <- place_body(half, c(0, 0, 2), rotation_about("x", angle_deg = 180))
  sphere <- join_bodies(upper, lower)
  expect_equal(as.double(sphere$centre_m), c(0, 0, 2), tolerance = 1e-15)
  expect_equal(unname(diag(sphere$inertia_kg_m2)), rep(636.172512351933, 3), tolerance = 1e-14)
  expect_equal(symmetry_class(sphere), "spherical")
  expect_same_body(sphere, place_body(body_sphere(2 * m, r), c(0, 0, 2)))
})

test_that("a tetrahedron about its corner, and a cylinder about its end", {
  # Drake, unit_inertia_test.cc, per kg. The solid tetrahedron has the second moment of a twentieth
  # of its mass at each corner and the rest at its centre.
  corners <- rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3))
  points <- c(
    lapply(1:4, function(i) body_tensor(1 / 20, c(0, 0, 0), corners[i, ])),
    list(body_tensor(16 / 20, c(0, 0, 0), colMeans(corners)))
  )
  expect_equal(
    unname(as.matrix(inertia_tensor(join_bodies(points), "origin"))),
    matrix(c(1.3, -0.1, -0.15, -0.1, 1, -0.3, -0.15, -0.3, 0.5), 3), tolerance = 1e-15
  )
  # Radius 2.5 m, length 1.5 m, along z from its end at the origin: of ever thinner disks, whose
  # sum lacks L^2/(12 n^2).
  n <- 300
  disks <- lapply(seq_len(n), function(i) {
    place_body(body_disk(1 / n, 2.5), c(0, 0, 1.5 * (i - 0.5) / n))
  })
  cylinder <- join_bodies(disks)
  lack <- 1.5^2 / (12 * n^2)
  expect_equal(moment_of_inertia(cylinder, "x", "origin") + lack, 2.3125, tolerance = 1e-14)
  expect_equal(moment_of_inertia(cylinder, "x") + lack, 1.75, tolerance = 1e-14)
  expect_equal(moment_of_inertia(cylinder, "z"), 3.125, tolerance = 1e-14)
})

test_that("a sphere less a sphere is the hollow one", {
  # Chrono, 2.1 to 2.3 m, 50 kg/m^3.
  ball <- function(r) body_sphere(50 * 4 / 3 * pi * r^3, r)
  hollow <- cut_body(ball(2.3), ball(2.1))
  expect_equal(hollow$mass_kg, 608.631216755462, tolerance = 1e-14)
  expect_equal(unname(diag(hollow$inertia_kg_m2)), rep(1970.60964977743, 3), tolerance = 1e-14)
  expect_equal(hollow$detail$parts$mass_kg[2], -ball(2.1)$mass_kg)
  # What the cut loses is in the bound: a shell of 1e-10 of the radius.
  thin <- cut_body(ball(1), ball(1 - 1e-10))
  expect_gt(thin$error, 1e-7)
  exact <- 2 / 3 * thin$mass_kg * (1 - 1e-10)
  expect_lte(abs(thin$inertia_kg_m2[[1]] / exact - 1), thin$error + 1e-9)
})

test_that("a dumbbell by hand", {
  rod <- body_rod(0.5, 1)
  ball <- body_sphere(2, 0.1)
  dumbbell <- join_bodies(rod, place_body(ball, c(0.6, 0, 0)), place_body(ball, c(-0.6, 0, 0)))
  expect_equal(dumbbell$mass_kg, 4.5)
  expect_equal(unname(dumbbell$centre_m), c(0, 0, 0))
  balls <- 2 * 0.4 * 2 * 0.01
  expect_equal(dumbbell$inertia_kg_m2["x", "x"], balls, tolerance = 1e-15)
  expect_equal(
    dumbbell$inertia_kg_m2["z", "z"], 0.5 / 12 + balls + 2 * 2 * 0.36, tolerance = 1e-15
  )
  expect_equal(dumbbell$provenance, "compound")
  expect_true(is.na(dumbbell$beta))
})

test_that("a body split in two and joined is the body", {
  # A rod of 3 kg and 2 m in pieces of 0.6 and 1.4 m; a box cut across.
  whole <- body_rod(3, 2)
  pieces <- join_bodies(
    place_body(body_rod(0.9, 0.6), c(-0.7, 0, 0)), place_body(body_rod(2.1, 1.4), c(0.3, 0, 0))
  )
  expect_same_body(pieces, whole)
  turn <- rotation_about(c(1, 2, -1), angle_deg = 77)
  shift <- c(3, -5, 7)
  split <- join_bodies(
    place_body(place_body(box(2, 0.5, 1, 2), c(-0.75, 0, 0)), shift, turn),
    place_body(place_body(box(6, 1.5, 1, 2), c(0.25, 0, 0)), shift, turn)
  )
  expect_same_body(split, place_body(box(8, 2, 1, 2), shift, turn))
})

test_that("a hole filled again leaves what was there", {
  disk <- body_disk(4, 0.2)
  plug <- place_body(body_disk(0.25, 0.05), c(0.1, 0.03, 0))
  cut <- cut_body(disk, plug)
  expect_equal(cut$mass_kg, 3.75)
  expect_equal(cut$centre_m[["x"]], -0.25 * 0.1 / 3.75)
  # By hand: m r^2/4 less that of the plug, about the new centre.
  expect_equal(
    cut$inertia_kg_m2["z", "z"],
    4 * 0.02 - 0.25 * (0.05^2 / 2 + 0.1^2 + 0.03^2) - 3.75 * sum(cut$centre_m^2),
    tolerance = 1e-14
  )
  expect_same_body(join_bodies(cut, plug), disk)
  # Cut first and placed, or placed and cut: the same.
  turn <- rotation_about(c(0, 1, 1), angle_deg = 33)
  expect_same_body(
    place_body(cut, c(1, 2, 3), turn),
    cut_body(place_body(disk, c(1, 2, 3), turn), place_body(plug, c(1, 2, 3), turn))
  )
})

test_that("turning there and back changes nothing", {
  body <- body_tensor(2, matrix(c(0.5, 0.1, 0, 0.1, 0.6, -0.05, 0, -0.05, 0.7), 3), c(1, 2, 3))
  set.seed(9)
  for (i in 1:20) {
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, -6, 6))
    there <- place_body(body, rotation = turn)
    expect_same_body(place_body(there, rotation = t(turn)), body)
    expect_equal(sum(diag(there$inertia_kg_m2)), sum(diag(body$inertia_kg_m2)), tolerance = 1e-14)
    # R I R', and the centre goes with it.
    expect_equal(
      unname(there$inertia_kg_m2), turn %*% unname(body$inertia_kg_m2) %*% t(turn),
      tolerance = 1e-14
    )
    expect_equal(as.double(there$centre_m), as.double(turn %*% body$centre_m), tolerance = 1e-14)
  }
  expect_same_body(place_body(place_body(body, c(1, 1, 0)), c(-1, -1, 0)), body)
})

test_that("bodies are turned about their own origin first, then moved", {
  body <- body_tensor(1, c(1, 2, 2.5), c(1, 0, 0))
  placed <- place_body(body, c(10, 0, 0), rotation_about("z", angle_deg = 90))
  expect_equal(as.double(placed$centre_m), c(10, 1, 0))
  expect_equal(unname(diag(placed$inertia_kg_m2)), c(2, 1, 2.5))
})

test_that("far origins cost no digits", {
  ball <- body_sphere(2, 0.125)
  near <- join_bodies(ball, place_body(ball, c(0.5, 0.25, 0)), place_body(ball, c(0, 1, -0.5)))
  # 2^27 m is 1.3e8, and a multiple of the last place of all coordinates.
  shift <- c(2^27, -2^27, 2^26)
  far <- join_bodies(
    place_body(ball, shift), place_body(ball, shift + c(0.5, 0.25, 0)),
    place_body(ball, shift + c(0, 1, -0.5))
  )
  expect_identical(far$second_moment_kg_m2, near$second_moment_kg_m2)
  expect_lt(far$error, 1e-14)
})

test_that("the error of a whole is made of the parts' errors", {
  one <- body_sphere(1, 1)
  two <- body_sphere(3, 1)
  one$error <- 1e-3
  two$error <- 1e-6
  pair <- join_bodies(one, two)
  expect_equal(pair$error, (1e-3 * 1 + 1e-6 * 3) / 4, tolerance = 1e-9)
  expect_equal(pair$error_kind, "bound")
  one$error_kind <- "estimate"
  expect_equal(join_bodies(one, two)$error_kind, "estimate")
  # A cut makes it larger: the errors add, the inertia does not.
  expect_equal(cut_body(two, one)$error, (1e-6 * 3 + 1e-3) / 2, tolerance = 1e-9)
  # Turning costs roundings, a place costs none.
  expect_identical(place_body(two, c(1, 2, 3))$error, two$error)
  expect_gt(place_body(body_disk(1, 1), rotation = rotation_about("x", angle_rad = 1))$error,
            body_disk(1, 1)$error)
})

test_that("a whole reaches as far as its farthest part", {
  ball <- body_tensor(1, c(0.004, 0.004, 0.004), reach_m = 0.1)
  pair <- join_bodies(place_body(ball, c(1, 0, 0)), place_body(ball, c(-1, 0, 0)))
  expect_equal(pair$reach_m, 1.1)
  expect_true(is.na(join_bodies(ball, body_tensor(1, c(1, 1, 1)))$reach_m))
})

test_that("massless bodies may be joined, and one body may", {
  none <- join_bodies(body_disk(0, 1), place_body(body_disk(0, 1), c(1, 0, 0)))
  expect_equal(none$mass_kg, 0)
  expect_equal(symmetry_class(none), "point")
  disk <- place_body(body_disk(0.3, 0.7), c(1e8, 0.1, 0.2))
  alone <- join_bodies(disk)
  expect_identical(alone$second_moment_kg_m2, disk$second_moment_kg_m2)
  expect_identical(alone$centre_m, disk$centre_m)
})

test_that("parts go where the whole is placed", {
  pair <- join_bodies(
    place_body(body_disk(1, 1), c(1, 0, 0)), place_body(body_disk(1, 1), c(-1, 0, 0))
  )
  placed <- place_body(pair, c(0, 0, 5), rotation_about("z", angle_deg = 90))
  expect_equal(placed$detail$parts$y_m, c(1, -1))
  expect_equal(placed$detail$parts$z_m, c(5, 5))
  expect_equal(place_body(pair, c(0, 0, 5))$detail$parts$x_m, c(1, -1))
  # With a row for each, and the mass of what was cut out negative.
  expect_named(pair$detail$parts, c("shape", "mass_kg", "x_m", "y_m", "z_m"))
})

test_that("bad arguments are refused by class", {
  disk <- body_disk(2, 0.25)
  expect_error(place_body(), class = "rotdyn_error_missing")
  expect_error(place_body(3), class = "rotdyn_error_type")
  expect_error(place_body(disk, 1), class = "rotdyn_error_size")
  expect_error(place_body(disk, c(1, NA, 0)), class = "rotdyn_error_value")
  expect_error(place_body(disk, "there"), class = "rotdyn_error_type")
  expect_error(place_body(disk, c(0, 0, 0), NULL, 1), class = "rotdyn_error_argument")
  expect_error(
    place_body(place_body(disk, c(1e308, 0, 0)), c(1e308, 0, 0)), class = "rotdyn_error_range"
  )
  expect_error(join_bodies(), class = "rotdyn_error_missing")
  expect_error(join_bodies(list()), class = "rotdyn_error_missing")
  expect_error(join_bodies(disk, 3), "\\.\\.2", class = "rotdyn_error_type")
  expect_error(join_bodies(inertia_tensor(disk)), "no mass and no position",
               class = "rotdyn_error_type")
  expect_error(join_bodies(list(disk, NULL)), class = "rotdyn_error_type")
  expect_error(
    join_bodies(place_body(disk, c(1e200, 0, 0)), place_body(disk, c(-1e200, 0, 0))),
    class = "rotdyn_error_range"
  )
  expect_error(cut_body(disk), class = "rotdyn_error_missing")
  expect_error(cut_body(disk, 3), class = "rotdyn_error_type")
  expect_error(cut_body(3, disk), class = "rotdyn_error_type")
  expect_error(cut_body(disk, disk), "lighter", class = "rotdyn_error_value")
  expect_error(cut_body(disk, body_disk(3, 0.1)), class = "rotdyn_error_value")
  expect_error(cut_body(disk, body_disk(1, 0.1), 3), class = "rotdyn_error_argument")
  # A hole larger than what it is cut from.
  expect_error(cut_body(disk, body_hoop(1, 1)), class = "rotdyn_error_inertia")
})

test_that("a name is one piece of text", {
  disk <- body_disk(1, 1)
  hole <- body_disk(0.1, 0.1)
  expect_error(join_bodies(disk, name = 1), class = "rotdyn_error_type")
  expect_error(join_bodies(disk, name = NULL), class = "rotdyn_error_type")
  expect_error(join_bodies(disk, name = c("a", "b")), class = "rotdyn_error_size")
  expect_error(cut_body(disk, hole, name = NA), class = "rotdyn_error_type")
  expect_error(body_tensor(1, diag(3), name = 1), class = "rotdyn_error_type")
  expect_error(
    body_points(data.frame(mass_kg = 1, x_m = 0, y_m = 0), name = sum),
    class = "rotdyn_error_type"
  )
  expect_error(body_density(1, domain_ball(1), name = NULL), class = "rotdyn_error_type")
  expect_equal(cut_body(disk, hole)$shape, "disk with a hole")
})

test_that("a hole beyond the body is refused, one at its very edge is not", {
  ball <- body_sphere(10, 1)
  hole <- body_sphere(0.01, 0.1)
  expect_error(cut_body(ball, place_body(hole, c(1.5, 0, 0))), class = "rotdyn_error_inertia")
  expect_error(
    cut_body(place_body(ball, c(9, 0, 0)), hole),
    class = "rotdyn_error_inertia"
  )
  far <- c(1e8, 1e8, 0)
  left <- cut_body(place_body(ball, far), place_body(hole, far + c(0.9, 0, 0)))
  expect_equal(left$mass_kg, 9.99)
  hoop <- body_hoop(3, 0.7)
  expect_equal(cut_body(hoop, place_body(body_point(1), c(0.7, 0, 0)))$mass_kg, 2)
  # Nothing is known of how far it reaches.
  given <- body_tensor(10, c(4, 4, 4))
  expect_equal(cut_body(given, place_body(hole, c(1.5, 0, 0)))$mass_kg, 9.99)
})

test_that("far away, the error says what rounding of the places costs", {
  # Two halves of a disk, and a cone cut in two: what they make is known.
  half <- body_half_disk(1, 0.3)
  disk <- body_disk(2, 0.3)
  cone <- body_cone(radius_m = 0.3, height_m = 1, density_kg_m3 = 1000)
  low <- body_frustum(
    base_radius_m = 0.3, top_radius_m = 0.15, height_m = 0.5, density_kg_m3 = 1000
  )
  high <- body_cone(radius_m = 0.15, height_m = 0.5, density_kg_m3 = 1000)
  corner <- function(...) body_polygon(vertices_m = rbind(...), areal_density_kg_m2 = 3)
  off_by <- function(got, want) {
    wanted <- want$second_moment_kg_m2
    max(abs(got$second_moment_kg_m2 - wanted)) / sum(diag(wanted))
  }
  set.seed(5)
  for (far in c(0, 1, 1e4, 1e8, 1e12)) {
    p <- c(far, -far / 3, far / 7)
    turn <- rotation_about("z", angle_deg = 180)
    disks <- join_bodies(place_body(half, p), place_body(half, p, turn))
    cones <- join_bodies(place_body(low, p), place_body(place_body(high, c(0, 0, 0.5)), p))
    back <- place_body(cones, rotation = rotation_about(rnorm(3), angle_rad = 1))
    nested <- join_bodies(disks, place_body(disk, p))
    expect_lte(off_by(disks, disk), disks$error)
    expect_lte(off_by(cones, cone), cones$error)
    expect_lte(off_by(nested, body_disk(4, 0.3)), nested$error)
    expect_lte(
      abs(sum(diag(back$second_moment_kg_m2)) / sum(diag(cone$second_moment_kg_m2)) - 1),
      back$error
    )
    # Some digits of what the places are rounded to, no more.
    expect_lte(cones$error, 1e-14 + 8 * far * .Machine$double.eps)
    expect_lte(max(abs(disks$centre_m - p)), disks$detail$centre_error_m)
    f <- far + 2^-3
    if (far < 1e10) {
      square <- corner(c(far, f), c(far + 2^-4, f), c(far + 2^-4, f + 2^-3), c(far, f + 2^-3))
      halves <- join_bodies(
        corner(c(far, f), c(far + 2^-4, f), c(far + 2^-4, f + 2^-3)),
        corner(c(far, f), c(far + 2^-4, f + 2^-3), c(far, f + 2^-3))
      )
      expect_lte(off_by(halves, square), halves$error)
    }
  }
  # Where nothing is rounded, nothing is lost.
  ball <- body_sphere(1, 0.5)
  pair <- join_bodies(place_body(ball, c(1e8, 0, 0)), place_body(ball, c(1e8 + 2, 0, 0)))
  expect_lt(pair$error, 1e-14)
  expect_null(place_body(ball, c(1e8, 0, 0))$detail$centre_error_m)
})

test_that("what is left of a rod is no matter for a message", {
  turn <- rotation_about(c(1, 2, 3), angle_rad = 1)
  rod <- place_body(body_rod(2, 1), c(3, 1, 2), turn)
  hole <- place_body(place_body(body_rod(1, 0.5), c(0.25, 0, 0)), c(3, 1, 2), turn)
  expect_silent(left <- cut_body(rod, hole))
  # Whether rounding falls on one side or the other: many of them.
  set.seed(3)
  for (i in 1:20) {
    turn <- rotation_about(rnorm(3), angle_rad = runif(1, -3, 3))
    expect_silent(left <- cut_body(
      place_body(body_rod(2, 1), rotation = turn),
      place_body(place_body(body_rod(1, 0.5), c(0.25, 0, 0)), rotation = turn)
    ))
    expect_equal(symmetry_class(left), "rod")
  }
})

test_that("a part too small for doubles leaves the error of the whole a number", {
  speck <- body_disk(1, 1e-200)
  both <- join_bodies(speck, place_body(speck, c(1, 0, 0)))
  expect_lt(both$error, 1e-14)
  expect_lt(join_bodies(speck, body_disk(1, 1))$error, 1e-14)
  expect_equal(join_bodies(speck, speck)$error, Inf)
  expect_equal(join_bodies(body_point(1), body_point(1))$error, 0)
})

test_that("beyond doubles: an error of the call, or numbers", {
  called <- function(expr) {
    error <- tryCatch(expr, rotdyn_error_range = identity)
    deparse(conditionCall(error)[[1]])
  }
  heavy <- body_disk(1.2e308, 0.1)
  expect_equal(called(join_bodies(heavy, heavy)), "join_bodies")
  rod <- body_rod(8e307, 4.5)
  across <- place_body(rod, rotation = rotation_about("z", angle_deg = 90))
  expect_equal(called(join_bodies(rod, across)), "join_bodies")
  light <- body_point(1e-300)
  apart <- join_bodies(light, place_body(light, c(1e200, 0, 0)))
  expect_equal(apart$reach_m / 5e199, 1)
  expect_equal(apart$inertia_kg_m2[[5]] / 5e99, 1)
  expect_lt(apart$error, 1e-14)
  expect_lt(apart$detail$centre_error_m, 1e185)
})

test_that("a shape that was turned says that its formula is from before", {
  box <- body_box(2, 0.3, 0.2, 0.1)
  turn <- rotation_about("y", angle_deg = 90)
  once <- place_body(box, rotation = turn)
  expect_equal(once$formula, paste0(box$formula, ", then rotated"))
  expect_equal(place_body(once, rotation = turn)$formula, once$formula)
  expect_equal(place_body(box, c(1, 2, 3), diag(3))$formula, box$formula)
  # What names no axis stays as it is.
  pair <- join_bodies(box, once)
  expect_equal(place_body(pair, rotation = turn)$formula, pair$formula)
})

test_that("a turn carries the error of the centre along, by the square root of three", {
  joined <- join_bodies(body_sphere(1, 0.1), place_body(body_sphere(3, 0.2), c(1, 0.5, -0.25)))
  off <- rotdyn:::centre_error(joined)
  expect_gt(off, 0)
  turned <- place_body(joined, rotation = rotation_rpy(c(0.3, -0.7, 1.2)))
  rounding <- 8 * .Machine$double.eps * max(abs(turned$centre_m))
  expect_within(turned$detail$centre_error_m, sqrt(3) * off + rounding, 1e-9)
})
