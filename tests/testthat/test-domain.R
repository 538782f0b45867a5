test_that("domains print their kind and size", {
  expect_output(print(domain_ball(2, inner_radius_m = 1)), "ball: radius_m = 2, inner_radius_m = 1")
  expect_output(print(domain_box(c(0, 0, 0), c(1, 2, 3))), "length_y_m = 2")
  expect_output(print(domain_box(c(0, 0, 0), c(1, 2, 3))), "0.5, 1, 1.5")
  expect_output(
    print(domain_inside(function(x, y, z) x < 1, c(0, 0, 0), c(1, 1, 1))), "random points only"
  )
})

test_that("an empty or impossible domain is an error", {
  expect_error(domain_box(c(0, 0, 0), c(1, 0, 1)), "Component 2", class = "rotdyn_error_value")
  expect_error(domain_box(c(0, 0), c(1, 1, 1)), class = "rotdyn_error_size")
  expect_error(domain_box(c(0, 0, NA), c(1, 1, 1)), class = "rotdyn_error_value")
  expect_error(domain_box(c(0, 0, 0)), class = "rotdyn_error_missing")
  expect_error(domain_cylinder(1, 0), class = "rotdyn_error_value")
  expect_error(domain_cylinder(1, 2, inner_radius_m = 1), class = "rotdyn_error_value")
  expect_error(domain_cylinder(1, 2, angle_rad = c(0, 7)), class = "rotdyn_error_value")
  expect_error(domain_cylinder(1, 2, angle_rad = c(1, 1)), class = "rotdyn_error_value")
  expect_error(domain_cylinder(1, 2, angle_rad = 1), class = "rotdyn_error_size")
  expect_error(domain_ball(-1), class = "rotdyn_error_value")
  expect_error(domain_ball(1, inner_radius_m = 2), class = "rotdyn_error_value")
  expect_error(domain_ellipsoid(1, 0, 1), class = "rotdyn_error_value")
  expect_error(domain_ellipsoid(1, 1), class = "rotdyn_error_missing")
  expect_error(domain_inside(1, c(0, 0, 0), c(1, 1, 1)), class = "rotdyn_error_type")
  expect_error(
    domain_map(identity, identity, c(0, 0, 0), c(1, 1, 1), periodic = NA),
    class = "rotdyn_error_type"
  )
})

test_that("units are understood", {
  skip_if_not_installed("units")
  cm <- function(x) units::set_units(x, "cm", mode = "standard")
  expect_equal(domain_ball(cm(250))$size_m, c(radius_m = 2.5))
  turn <- units::set_units(c(0, 90), "degree", mode = "standard")
  body <- body_density(1, domain_cylinder(1, 1, angle_rad = turn))
  expect_equal(body$mass_kg, pi / 4)
})

test_that("a wrong Jacobian, and a map that gives no places, are found out", {
  polar <- function(r, t, z) cbind(r * cos(t), r * sin(t), z)
  good <- domain_map(polar, function(r, t, z) r, c(0, 0, 0), c(1, 2 * pi, 1))
  expect_s3_class(good, "rot_domain")
  wrong <- function(jacobian) domain_map(polar, jacobian, c(0, 0, 0), c(1, 2 * pi, 1))
  expect_error(wrong(function(r, t, z) 2 * r), "determinant", class = "rotdyn_error_density")
  expect_error(wrong(function(r, t, z) r^2), class = "rotdyn_error_density")
  expect_error(wrong(function(r, t, z) -r), "at least 0", class = "rotdyn_error_density")
  expect_error(wrong(function(r, t, z) 1), "Vectorize", class = "rotdyn_error_density")
  expect_error(
    domain_map(function(r, t, z) r, function(r, t, z) r, c(0, 0, 0), c(1, 1, 1)),
    class = "rotdyn_error_density"
  )
})

test_that("the reach is never less than the farthest point", {
  set.seed(1)
  p <- matrix(runif(3e4, -1, 1), ncol = 3)
  from <- c(0.3, -0.4, 2)
  farthest <- function(p, at) max(sqrt(colSums((t(p) + at - from)^2)))
  reach <- function(domain) rotdyn:::domain_reach(domain, from)
  size <- c(2, 3, 0.5)
  box <- t(t(p) * size)
  expect_gte(reach(domain_box(-size + 1, size + 1)), farthest(box, 1))
  expect_lte(reach(domain_box(-size + 1, size + 1)), 1.1 * farthest(box, 1))
  inside <- p[rowSums(p^2) < 1, ]
  expect_gte(reach(domain_ball(2, centre_m = c(1, 1, 1))), farthest(2 * inside, 1))
  expect_lte(reach(domain_ball(2, centre_m = c(1, 1, 1))), 1.1 * farthest(2 * inside, 1))
  expect_gte(
    reach(domain_ellipsoid(2, 3, 0.5, centre_m = c(1, 1, 1))), farthest(t(t(inside) * size), 1)
  )
  round <- p[rowSums(p[, 1:2]^2) < 1, ]
  tall <- t(t(round) * c(2, 2, 0.5))
  expect_gte(reach(domain_cylinder(2, 1, centre_m = c(1, 1, 1))), farthest(tall, 1))
  expect_lte(reach(domain_cylinder(2, 1, centre_m = c(1, 1, 1))), 1.1 * farthest(tall, 1))
})

test_that("a function of too few arguments is refused at the door", {
  two <- function(x, y) x
  three <- function(u, v, w) 1 + 0 * u
  expect_error(domain_inside(two, c(0, 0, 0), c(1, 1, 1)), "takes 2", class = "rotdyn_error_type")
  expect_error(domain_map(two, three, c(0, 0, 0), c(1, 1, 1)), class = "rotdyn_error_type")
  expect_error(
    domain_map(function(u, v, w) cbind(u, v, w), two, c(0, 0, 0), c(1, 1, 1)),
    class = "rotdyn_error_type"
  )
  box <- domain_box(c(0, 0, 0), c(1, 1, 1))
  expect_error(body_density(function() 1, box), "takes 0", class = "rotdyn_error_type")
  expect_equal(body_density(function(...) 1 + 0 * ..1, box)$mass_kg, 1)
})

test_that("a value that a field may not have is told with its place", {
  places <- list(c(1, 2, 3), c(4, 5, 6), c(7, 8, 9))
  field <- function(x) rotdyn:::check_field(x, "f", places, NULL)
  expect_identical(field(c(1L, 0L, 2L)), c(1, 0, 2))
  expect_error(
    field(c(1, -2, 3)), "It is -2 at u = 2, v = 5, w = 8", class = "rotdyn_error_density"
  )
  expect_error(field(c(1, 2, Inf)), "It is Inf at u = 3", class = "rotdyn_error_density")
  expect_error(field(c(NaN, -2, 3)), "It is NaN at u = 1", class = "rotdyn_error_density")
})

test_that("a turn is full to rounding, and periodic then", {
  turn <- function(part) domain_cylinder(1, 2, angle_rad = c(1, 1 + part * 2 * pi))$periodic
  expect_identical(turn(1 - 1e-13), c(FALSE, TRUE, FALSE))
  expect_identical(turn(1 - 1e-10), c(FALSE, FALSE, FALSE))
})
