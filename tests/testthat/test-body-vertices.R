ell <- cbind(c(0, 2, 2, 1, 1, 0), c(0, 0, 1, 1, 2, 2))

test_that("a polygon has the moments of what it is", {
  square <- body_polygon(2, cbind(c(0, 3, 3, 0), c(0, 0, 5, 5)))
  same <- body_rectangle(2, 3, 5)
  expect_ulps(diag(square$inertia_kg_m2), diag(same$inertia_kg_m2), 2)
  expect_equal(as.double(square$centre_m), c(1.5, 2.5, 0))
  expect_identical(square$detail$area_m2, 15)

  triangle <- body_polygon(2, cbind(c(0, 3, -2), c(0, 0, 5)))
  same <- body_triangle(2, 3, 5, apex_m = -2)
  expect_equal(triangle$inertia_kg_m2, same$inertia_kg_m2, tolerance = 1e-15)
  expect_equal(triangle$centre_m, same$centre_m, tolerance = 1e-15)
  expect_equal(triangle$reach_m, same$reach_m, tolerance = 1e-15)

  angles <- 2 * pi * (0:6) / 7
  regular <- body_polygon(2, 3 * cbind(cos(angles), sin(angles)))
  expect_equal(
    diag(regular$inertia_kg_m2), diag(body_polygon_plate(2, 3, 7)$inertia_kg_m2),
    tolerance = 1e-15
  )
})

test_that("against quadrature, in both senses, and as parts", {
  maps <- lapply(2:5, function(k) triangle_map(ell[1, ], ell[k, ], ell[k + 1, ]))
  # The L is star-shaped about its first corner, so that no triangle counts twice.
  want <- quadrature(maps[2:3], 2)
  parts <- quadrature(maps, 2)
  body <- body_polygon(3, ell)
  expect_equal(unname(body$second_moment_kg_m2), 3 * parts$second, tolerance = 1e-13)
  expect_equal(as.double(body$centre_m), parts$centre, tolerance = 1e-13)
  expect_gt(abs(want$mass - parts$mass), 0.5)
  back <- body_polygon(3, ell[6:1, ])
  expect_equal(back$second_moment_kg_m2, body$second_moment_kg_m2, tolerance = 1e-15)
  joined <- join_bodies(
    place_body(body_rectangle(2, 2, 1), c(1, 0.5, 0)),
    place_body(body_rectangle(1, 1, 1), c(0.5, 1.5, 0))
  )
  expect_equal(body$second_moment_kg_m2, joined$second_moment_kg_m2, tolerance = 1e-14)
  expect_equal(body$centre_m, joined$centre_m, tolerance = 1e-14)
})

test_that("the error of the centre is the rounding of a vertex and of its distance", {
  # In roundings: a number as small as they are equals 0 to expect_equal().
  roundings <- function(body) body$detail$centre_error_m / .Machine$double.eps
  square <- body_polygon(1, cbind(c(-1, 1, 1, -1), c(-1, -1, 1, 1)))
  expect_equal(roundings(square), sqrt(2))
  far <- body_polygon(1, cbind(c(99, 101, 101, 99), c(-1, -1, 1, 1)))
  expect_equal(roundings(far), 100 + sqrt(2))
})

test_that("a tetrahedron, against quadrature, and the regular one", {
  corners <- rbind(c(0.3, 0.1, -0.2), c(2, 0.2, 0.1), c(0.1, 1.5, 0.4), c(0.7, 0.3, 2.5))
  map <- function(p) {
    a <- p[, 1]
    b <- a * p[, 2]
    c <- b * p[, 3]
    at <- function(k) {
      corners[1, k] + a * (corners[2, k] - corners[1, k]) + b * (corners[3, k] - corners[2, k]) +
        c * (corners[4, k] - corners[3, k])
    }
    list(at(1), at(2), at(3))
  }
  want <- quadrature(list(map), 3)
  body <- body_tetrahedron(vertices_m = corners, density_kg_m3 = 2)
  expect_equal(body$mass_kg, 2 * want$mass, tolerance = 1e-13)
  expect_equal(as.double(body$centre_m), want$centre, tolerance = 1e-13)
  expect_equal(
    unname(body$second_moment_kg_m2), body$mass_kg * want$second, tolerance = 1e-13
  )
  expect_equal(body$detail$volume_m3, want$mass, tolerance = 1e-13)
  base <- 0.7 / sqrt(3) * cbind(cos(2 * pi * (0:2) / 3), sin(2 * pi * (0:2) / 3), 0)
  regular <- body_tetrahedron(2, rbind(base, c(0, 0, 0.7 * sqrt(2 / 3))))
  same <- body_regular_tetrahedron(2, 0.7)
  expect_equal(regular$second_moment_kg_m2, same$second_moment_kg_m2, tolerance = 1e-14)
  expect_equal(regular$reach_m, same$reach_m, tolerance = 1e-14)
})

test_that("a place far away costs no digits", {
  here <- body_polygon(1, ell)
  there <- body_polygon(1, ell + 1e8)
  expect_identical(there$second_moment_kg_m2, here$second_moment_kg_m2)
  cases <- read.csv(shared("refs", "tetrahedron.csv"))
  corners <- rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3))
  for (i in seq_len(nrow(cases))) {
    body <- body_tetrahedron(vertices_m = corners + cases$offset[i], density_kg_m3 = 1)
    tensor <- body$inertia_kg_m2
    want <- unlist(cases[i, c("Ixx_cm", "Iyy_cm", "Izz_cm", "Ixy_cm", "Ixz_cm", "Iyz_cm")])
    got <- tensor[cbind(c(1, 2, 3, 1, 1, 2), c(1, 2, 3, 2, 3, 3))]
    expect_ulps(got, unname(want), 3)
    expect_equal(body$mass_kg, cases$volume[i])
  }
})

test_that("corners may come as a data frame", {
  flat <- data.frame(y_m = ell[, 2], x_m = ell[, 1], name = letters[1:6])
  expect_identical(body_polygon(1, flat)$inertia_kg_m2, body_polygon(1, ell)$inertia_kg_m2)
  expect_error(body_polygon(1, data.frame(x = 1:3, y = 1:3)), "x_m", class = "rotdyn_error_type")
})

test_that("corners that make no body are refused, and it is said why", {
  bow <- cbind(c(0, 2, 0, 2), c(0, 2, 2, 0))
  expect_error(body_polygon(1, bow), "corner 1 crosses.*corner 3", class = "rotdyn_error_value")
  line <- cbind(c(0, 0.1, 0.7), c(0, 0.3, 2.1))
  expect_error(body_polygon(1, line), "no area", class = "rotdyn_error_value")
  flat <- rbind(c(0, 0, 1), c(1, 0, 1), c(0, 1, 1), c(1, 1, 1))
  expect_error(body_tetrahedron(1, flat), "no volume", class = "rotdyn_error_value")
  expect_error(body_polygon(1, ell[1:2, ]), "three corners", class = "rotdyn_error_size")
  expect_error(body_tetrahedron(1, flat[1:3, ]), "four corners", class = "rotdyn_error_size")
  expect_error(body_polygon(1, flat), "2 columns", class = "rotdyn_error_size")
  expect_error(body_polygon(1, 1:6), class = "rotdyn_error_type")
  expect_error(body_polygon(1, matrix(c("a", "b"), 3, 2)), class = "rotdyn_error_type")
  bad <- ell
  bad[2, 1] <- NaN
  expect_error(body_polygon(1, bad), class = "rotdyn_error_value")
  expect_error(body_polygon(-1, ell), class = "rotdyn_error_value")
  expect_error(body_polygon(1), "vertices_m", class = "rotdyn_error_missing")
  expect_error(body_polygon(vertices_m = ell), "areal", class = "rotdyn_error_missing")
  expect_error(body_polygon(1, ell, areal_density_kg_m2 = 1), class = "rotdyn_error_value")
})

test_that("a column that is a matrix is no column; a mass that vanished is not exact", {
  corners <- data.frame(x_m = c(0, 1, 1))
  corners$y_m <- matrix(1:6, 3)
  expect_error(body_polygon(1, corners), class = "rotdyn_error_size")
  small <- cbind(c(0, 1, 1), c(0, 0, 1)) * 1e-170
  expect_equal(body_polygon(vertices_m = small, areal_density_kg_m2 = 1)$error, Inf)
  # 5/2 smallest doubles of mass are 2 of them: a fifth is lost.
  some <- body_polygon(
    vertices_m = rbind(c(0, 0), c(2^300, 0), c(0, 5 * 2^-300)), areal_density_kg_m2 = 2^-1074
  )
  expect_identical(some$mass_kg, 2^-1073)
  expect_gte(some$error, 0.2)
  expect_equal(body_polygon(0, small)$error, 0)
})

test_that("outlines that cross in a corner cross; those that touch do not", {
  crossing <- list(
    # An hourglass with a corner in its waist on both ways, on one way, and turned.
    rbind(c(0, -1), c(1, 0), c(4, 3), c(4, -3), c(1, 0), c(0, 1)),
    rbind(c(0, 0), c(1, 1), c(2, 2), c(2, 0), c(0, 2)),
    rbind(c(0, 0), c(2, 2), c(2, 0), c(1, 1), c(0, 2)),
    rbind(c(0, -1), c(1, 0), c(4, 1), c(4, -3), c(1, 0), c(0, 3))
  )
  touching <- list(
    # Two squares that share a corner, in the order that does not cross.
    list(rbind(c(0, 0), c(1, 0), c(1, 1), c(2, 1), c(2, 2), c(1, 2), c(1, 1), c(0, 1)), 2),
    # A corner on the edge across.
    list(rbind(c(0, 0), c(4, 0), c(4, 2), c(2, 0), c(0, 2)), 4),
    # A square with a square hole, at the end of a slit.
    list(rbind(
      c(0, 0), c(3, 0), c(3, 3), c(0, 3), c(0, 0), c(1, 1), c(1, 2), c(2, 2), c(2, 1), c(1, 1)
    ), 8)
  )
  turn <- rotation_about("z", angle_deg = 30)[1:2, 1:2]
  for (around in c(0, 1, 3)) {
    moved <- function(x) {
      n <- nrow(x)
      x[(seq_len(n) + around - 1) %% n + 1, ]
    }
    for (x in crossing) {
      expect_error(body_polygon(1, moved(x)), "cross", class = "rotdyn_error_value")
      expect_error(body_polygon(1, moved(x)[rev(seq_len(nrow(x))), ]), "cross")
      expect_error(body_polygon(1, 1e5 + moved(x)), "cross")
    }
    for (x in touching) {
      expect_equal(body_polygon(1, moved(x[[1]]))$detail$area_m2, x[[2]])
      expect_equal(body_polygon(1, moved(x[[1]]) %*% turn)$detail$area_m2, x[[2]])
    }
  }
})
