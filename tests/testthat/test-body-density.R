# True error of the second moment, relative to the trace.
second_error <- function(body, exact) {
  if (length(exact) == 3L) exact <- diag(exact)
  max(abs(body$second_moment_kg_m2 - exact)) / sum(diag(exact))
}

expect_good <- function(body, mass, exact, at_most = 1e-10) {
  error <- second_error(body, exact)
  testthat::expect_lte(error, body$error)
  testthat::expect_lte(body$error, at_most)
  testthat::expect_lte(abs(body$mass_kg / mass - 1), body$detail$mass_error)
}

test_that("a density with a unit is converted", {
  skip_if_not_installed("units")
  steel <- function(x, y, z) {
    units::set_units(rep(7.5, length(x)), "g/cm^3", mode = "standard")
  }
  block <- body_density(steel, domain_box(c(0, 0, 0), c(0.1, 0.2, 0.3)))
  expect_equal(block$mass_kg, 7500 * 0.006, tolerance = 1e-12)
})

test_that("uniform bodies have the moments of the books", {
  expect_good(
    body_density(3, domain_box(c(0, 0, 0), c(2, 3, 5))), 90, 90 / 12 * c(4, 9, 25), 3e-15
  )
  expect_good(
    body_density(2, domain_ellipsoid(2, 3, 5)), 80 * pi, 80 * pi / 5 * c(4, 9, 25), 3e-15
  )
  tube <- body_density(2, domain_cylinder(3, 5, inner_radius_m = 2))
  expect_good(tube, 50 * pi, 50 * pi * c(13 / 4, 13 / 4, 25 / 12), 3e-15)
  expect_equal(tube$size_m, c(radius_m = 3, length_m = 5, inner_radius_m = 2))
  # A shell of 2^-20 radii: 2/3 m R^2 about a diameter.
  t <- 2^-20
  thin <- body_density(1, domain_ball(1, inner_radius_m = 1 - t))
  expect_good(
    thin, 4 / 3 * pi * t * (3 - 3 * t + t^2),
    rep(4 * pi / 15 * t * (5 - 10 * t + 10 * t^2 - 5 * t^3 + t^4), 3), 4e-15
  )
  expect_equal(thin$inertia_kg_m2[1, 1] / thin$mass_kg, 2 / 3, tolerance = 1e-5)
  half <- body_density(1, domain_cylinder(2, 1, angle_rad = c(-pi / 2, pi / 2)))
  expect_equal(unname(half$centre_m), c(8 / (3 * pi), 0, 0))
})

test_that("a planet, denser inside, has the closed form's moment", {
  # rho = rho0 (1 - a r/R): M = 4 pi rho0 R^3 (1/3 - a/4), int x^2 = 4 pi/3 rho0 R^5 (1/5 - a/6).
  radius <- 6.371e6
  a <- 0.6
  planet <- body_density(
    function(x, y, z) 13000 * (1 - a * sqrt(x^2 + y^2 + z^2) / radius), domain_ball(radius)
  )
  expect_good(
    planet, 4 * pi * 13000 * radius^3 * (1 / 3 - a / 4),
    rep(4 * pi / 3 * 13000 * radius^5 * (1 / 5 - a / 6), 3)
  )
  expect_equal(
    planet$inertia_kg_m2[3, 3] / (planet$mass_kg * radius^2),
    2 / 3 * (1 / 5 - a / 6) / (1 / 3 - a / 4)
  )
  expect_equal(planet$provenance, "quadrature")
  expect_equal(planet$error_kind, "estimate")
  expect_gte(planet$reach_m, radius)
  expect_lte(planet$detail$evaluations, 8000)
})

test_that("a cylinder with rho = k r, and a box whose density rises", {
  # int x^2 = k pi R^5/5 h, m = 2 pi k R^3/3 h, int z^2 = m h^2/12.
  disk <- body_density(function(x, y, z) 4 * sqrt(x^2 + y^2), domain_cylinder(1.5, 0.7))
  mass <- 2 * pi * 4 * 1.5^3 / 3 * 0.7
  expect_good(disk, mass, c(rep(4 * pi * 1.5^5 / 5 * 0.7, 2), mass * 0.49 / 12))
  # 1 + 3 x on [0, 2] x [0, 1] x [0, 1]: m = 8, int x = 10, int x^2 = 44/3.
  box <- body_density(function(x, y, z) 1 + 3 * x, domain_box(c(0, 0, 0), c(2, 1, 1)))
  expect_good(box, 8, c(44 / 3 - 100 / 8, 8 / 12, 8 / 12), 1e-14)
  expect_equal(unname(box$centre_m), c(1.25, 0.5, 0.5))
})

test_that("where the domain is costs nothing", {
  at <- c(1e6, -1e6, 1e6)
  near <- body_density(function(x, y, z) exp(x + y / 2), domain_ball(1))
  far <- body_density(
    function(x, y, z) exp(x - at[1] + (y - at[2]) / 2), domain_ball(1, centre_m = at)
  )
  expect_lte(second_error(far, near$second_moment_kg_m2), 1e-10) # the density's own rounding
  expect_equal(unname(far$centre_m - at), unname(near$centre_m), tolerance = 1e-8)
  uniform <- body_density(2, domain_box(at - 1, at + 1))
  expect_lte(second_error(uniform, rep(16 / 3, 3)), 4e-16)
})

test_that("a map serves as well as a domain of the house", {
  # Torus, 2 and 0.5: m = 2 pi^2 R a^2, int z^2 = m a^2/4, int x^2 = m (R^2/2 + 3 a^2/8).
  torus <- domain_map(
    function(r, t, p) cbind((2 + r * cos(t)) * cos(p), (2 + r * cos(t)) * sin(p), 7 + r * sin(t)),
    function(r, t, p) r * (2 + r * cos(t)),
    c(0, 0, 0), c(0.5, 2 * pi, 2 * pi), periodic = c(FALSE, TRUE, TRUE)
  )
  mass <- 3 * 2 * pi^2 * 2 * 0.25
  body <- body_density(3, torus)
  expect_good(body, mass, mass * c(rep(2 + 3 / 32, 2), 1 / 16), 4e-15)
  expect_equal(body$centre_m[["z"]], 7)
  expect_true(is.na(body$reach_m))
  # Places as a list; parameters that do not say that they go round.
  egg <- domain_map(
    function(r, c, p) {
      s <- r * sqrt(1 - c^2)
      list(2 * s * cos(p), 3 * s * sin(p), 5 * r * c)
    },
    function(r, c, p) 30 * r^2, c(0, -1, 0), c(1, 1, 2 * pi)
  )
  expect_good(body_density(1, egg), 40 * pi, 40 * pi / 5 * c(4, 9, 25))
})

test_that("a mass that is given scales the density", {
  f <- function(x, y, z) 1 + x
  body <- body_density(f, domain_box(c(0, 0, 0), c(1, 1, 1)), mass_kg = 6)
  free <- body_density(f, domain_box(c(0, 0, 0), c(1, 1, 1)))
  expect_equal(body$mass_kg, 6)
  expect_equal(body$second_moment_kg_m2, free$second_moment_kg_m2 * 6 / free$mass_kg)
  expect_equal(body$detail$mass_error, 0)
})

test_that("a jump is not met in silence, and the error stays honest", {
  # A core of radius r, d denser: int x^2 = 4 pi/15 (1 + d r^5).
  for (r in c(0.35, 0.546, 0.8)) {
    f <- function(x, y, z) 1 + 3 * (x^2 + y^2 + z^2 < r^2)
    expect_warning(
      body <- body_density(f, domain_ball(1), max_evaluations = 2e4),
      class = "rotdyn_warning_accuracy"
    )
    true <- second_error(body, rep(4 * pi / 15 * (1 + 3 * r^5), 3))
    expect_lte(true, body$error)
    expect_lte(body$error, 0.05)
    expect_lte(body$detail$evaluations, 2e4)
  }
  # Split there, and nothing is lost.
  parts <- join_bodies(
    body_density(4, domain_ball(0.8)), body_density(1, domain_ball(1, inner_radius_m = 0.8))
  )
  expect_lte(second_error(parts, rep(4 * pi / 15 * (1 + 3 * 0.8^5), 3)), 1e-14)
  expect_warning(
    body_density(1, domain_ball(1), accuracy = 1e-17), "double precision",
    class = "rotdyn_warning_accuracy"
  )
})

# Of 6, 9 and 11 nodes a side none lies in it.
test_that("a small grain is not overlooked", {
  f <- function(x, y, z) 1 + 8 * ((x - 0.13)^2 + (y + 0.13)^2 + (z - 0.13)^2 < 0.13^2)
  body <- suppressWarnings(
    body_density(f, domain_box(c(-1, -1, -1), c(1, 1, 1)), max_evaluations = 1e5)
  )
  expect_gt(body$mass_kg, 8.01)
  exact <- 8 + 8 * 4 / 3 * pi * 0.13^3
  expect_lte(abs(body$mass_kg / exact - 1), body$detail$mass_error)
  # Nor where it is all there is.
  f <- function(x, y, z) 8 * ((x - 0.13)^2 + (y + 0.13)^2 + (z - 0.13)^2 < 0.13^2)
  body <- suppressWarnings(
    body_density(f, domain_box(c(-1, -1, -1), c(1, 1, 1)), max_evaluations = 1e6)
  )
  exact <- 8 * 4 / 3 * pi * 0.13^3
  expect_lte(abs(body$mass_kg / exact - 1), body$detail$mass_error)
  expect_lte(max(abs(body$centre_m - c(0.13, -0.13, 0.13))), body$detail$centre_error_m)
  expect_lte(body$detail$centre_error_m, 0.13)
})

test_that("easier accuracies cost less, and are met", {
  f <- function(x, y, z) 1 / (1 + 25 * x^2 + y^2)
  domain <- domain_box(c(-1, -1, -1), c(1, 1, 1))
  good <- body_density(f, domain, accuracy = 1e-12)
  cost <- Inf
  for (accuracy in c(1e-10, 1e-7, 1e-4)) {
    body <- body_density(f, domain, accuracy = accuracy)
    expect_lte(body$error, accuracy)
    expect_lte(second_error(body, good$second_moment_kg_m2), body$error)
    expect_lt(body$detail$evaluations, cost)
    cost <- body$detail$evaluations
  }
})

# ---- random points ------------------------------------------------------------------------------

torus_inside <- function() {
  domain_inside(
    function(x, y, z) (sqrt(x^2 + y^2) - 2)^2 + (z - 1)^2 < 0.25,
    c(-2.5, -2.5, 0.5), c(2.5, 2.5, 1.5)
  )
}
torus_mass <- 3 * 2 * pi^2 * 2 * 0.25
torus_second <- diag(torus_mass * c(rep(2 + 3 / 32, 2), 1 / 16))

test_that("a torus of which only the inside is known", {
  body <- body_density(3, torus_inside(), max_evaluations = 1e5)
  expect_equal(body$provenance, "monte_carlo")
  expect_equal(body$error_kind, "estimate")
  expect_lte(second_error(body, torus_second), 4 * body$error)
  expect_lte(abs(body$mass_kg / torus_mass - 1), 4 * body$detail$mass_error)
  expect_lte(abs(body$centre_m[["z"]] - 1), 4 * body$detail$centre_error_m)
  # Better than points without cells: 1e5 of those leave 2.5e-3 of the mass.
  expect_lte(body$detail$mass_error, 2e-3)
  expect_gte(body$detail$mass_error, 2e-4)
  expect_lte(body$detail$points, 1e5)
  share <- torus_mass / 3 / 25
  expect_equal(body$detail$inside / body$detail$points, share, tolerance = 0.02)
})

test_that("the standard error is what the seeds scatter by", {
  runs <- lapply(1:20, function(seed) {
    body_density(3, torus_inside(), max_evaluations = 2e4, seed = seed)
  })
  off <- vapply(runs, function(b) (b$mass_kg / torus_mass - 1) / b$detail$mass_error, double(1))
  expect_lte(max(abs(off)), 4)
  # The root mean square of 20 is within 0.6 and 1.5 of 1.
  expect_gt(sqrt(mean(off^2)), 0.6)
  expect_lt(sqrt(mean(off^2)), 1.5)
  part <- vapply(runs, function(b) second_error(b, torus_second) / b$error, double(1))
  expect_lte(max(part), 4)
  expect_gt(max(part), 0.5)
})

test_that("random points are repeatable, and R's own are left alone", {
  set.seed(4)
  before <- .Random.seed
  one <- body_density(1, torus_inside(), max_evaluations = 1e4, seed = 7)
  expect_identical(.Random.seed, before)
  expect_identical(body_density(1, torus_inside(), max_evaluations = 1e4, seed = 7), one)
  other <- body_density(1, torus_inside(), max_evaluations = 1e4, seed = 8)
  expect_false(identical(other$mass_kg, one$mass_kg))
})

test_that("random points serve any domain, and an accuracy that is asked for", {
  body <- body_density(
    function(x, y, z) exp(x), domain_ball(1), method = "monte_carlo", accuracy = 1e-3
  )
  good <- body_density(function(x, y, z) exp(x), domain_ball(1))
  expect_lte(body$error, 1e-3)
  expect_lte(second_error(body, good$second_moment_kg_m2), 4 * body$error)
  expect_lt(body$detail$evaluations, 3e5)
  expect_warning(
    body_density(1, torus_inside(), accuracy = 1e-6, max_evaluations = 1e4),
    class = "rotdyn_warning_accuracy"
  )
  far <- domain_inside(
    function(x, y, z) (x - 1e8)^2 + y^2 + z^2 < 1, c(1e8 - 1, -1, -1), c(1e8 + 1, 1, 1)
  )
  ball <- body_density(1, far, max_evaluations = 2e4)
  expect_lte(second_error(ball, rep(4 * pi / 15, 3)), 4 * ball$error)
})

# ---- what may go wrong --------------------------------------------------------------------------

test_that("a density that is none says where", {
  box <- domain_box(c(-1, -1, -1), c(1, 1, 1))
  density <- function(f) body_density(f, box)
  expect_error(density(function(x, y, z) x), "x_m = -0.9", class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) ifelse(x > 0, 1, NA)), class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) 1 / (x > 0)), class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) "heavy"), class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) NULL), class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) 3), "is a number", class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) max(x)), "Vectorize", class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) 0 * x), "no mass", class = "rotdyn_error_density")
  expect_error(density(function(x, y, z) stop("mine")), "mine")
  own <- function(x, y, z) rlang::abort("mine", class = "my_error")
  expect_error(density(own), class = "my_error")
  expect_error(body_density(-1, box), class = "rotdyn_error_value")
  expect_error(body_density("lead", box), class = "rotdyn_error_type")
  expect_error(body_density(1, 2), class = "rotdyn_error_type")
  expect_error(body_density(1), class = "rotdyn_error_missing")
  error <- tryCatch(density(function(x, y, z) x), error = identity)
  expect_equal(error$call[[1]], quote(body_density))
})

test_that("options out of their domain are errors", {
  box <- domain_box(c(-1, -1, -1), c(1, 1, 1))
  expect_error(body_density(1, box, accuracy = 0), class = "rotdyn_error_value")
  expect_error(body_density(1, box, max_evaluations = 10), class = "rotdyn_error_value")
  expect_error(body_density(1, box, seed = -1), class = "rotdyn_error_value")
  expect_error(body_density(1, box, seed = 1.5), class = "rotdyn_error_value")
  expect_error(body_density(1, box, method = "exact"), class = "rotdyn_error_value")
  expect_error(body_density(1, box, 2))
  expect_error(body_density(1, torus_inside(), method = "quadrature"), class = "rotdyn_error_model")
  nothing <- domain_inside(function(x, y, z) x > 2, c(0, 0, 0), c(1, 1, 1))
  expect_error(
    body_density(1, nothing, max_evaluations = 1e4), "None of", class = "rotdyn_error_density"
  )
  predicate <- function(inside) body_density(1, domain_inside(inside, c(0, 0, 0), c(1, 1, 1)))
  expect_error(predicate(function(x, y, z) TRUE), "Vectorize", class = "rotdyn_error_density")
  expect_error(
    predicate(function(x, y, z) ifelse(x > 0.5, TRUE, NA)), "NA", class = "rotdyn_error_density"
  )
  expect_error(predicate(function(x, y, z) x), class = "rotdyn_error_density")
})

test_that("sizes whose volume is no double are none to the moments", {
  # Volumes of 1e-343 and 1e343 m^3.
  for (size in c(2^-380, 2^380)) {
    rho <- size^-2.5
    body <- body_density(rho, domain_ball(size), mass_kg = 1)
    expect_equal(body$second_moment_kg_m2[1, 1] / size / size, 1 / 5)
  }
  expect_error(
    body_density(1e300, domain_ball(1e100)), class = "rotdyn_error_range"
  )
})

test_that("what is no number, or no place, is an error that says where", {
  ball <- domain_ball(2)
  for (value in c(NA, NaN, Inf, -1)) {
    error <- expect_error(
      body_density(function(x, y, z) ifelse(x > 1, value, 1), ball), class = "rotdyn_error_density"
    )
    expect_match(conditionMessage(error), "x_m = *1[.]", fixed = FALSE)
  }
  one <- function(u, v, w) 1 + 0 * u
  place <- expect_error(
    domain_map(function(u, v, w) cbind(u, v, w / 0), one, c(1, 1, 1), c(2, 2, 2)),
    class = "rotdyn_error_density"
  )
  expect_match(conditionMessage(place), "u = 1[.].*Inf")
  expect_error(
    domain_map(function(u, v, w) cbind(u, v, NA * w), one, c(1, 1, 1), c(2, 2, 2)),
    class = "rotdyn_error_density"
  )
  # Finite where the Jacobian was held against it, not everywhere.
  hole <- domain_map(
    function(u, v, w) cbind(u, v, ifelse(u > 1.99, NaN, w)), one, c(1, 1, 1), c(2, 2, 2)
  )
  expect_error(body_density(1, hole), class = "rotdyn_error_density")
  for (method in list(sum, quote(x), NULL, 1, data.frame())) {
    expect_error(body_density(1, ball, method = method), class = "rotdyn_error_value")
  }
})

test_that("sizes of a rule that are none are refused", {
  for (n in c(-1, NaN, 2^52)) {
    expect_error(.Call(rotdyn:::ffi_density_size, n), "`n` is not a size")
  }
})

test_that("the centre is known to a rounding of its place, and to no less", {
  body <- body_density(function(x, y, z) 1000 + 0 * x, domain_box(c(3e5, 0, 0), c(3e5 + 0.1, 1, 1)))
  expect_gte(body$detail$centre_error_m, .Machine$double.eps * (3e5 + 0.05))
  expect_lt(body$detail$centre_error_m, 2 * .Machine$double.eps * 3e5)
})

test_that("what the sums leave of the centre counts beside the error of the rule", {
  moments <- stats::setNames(numeric(length(rotdyn:::moment_names)), rotdyn:::moment_names)
  moments[c("mass", "x", "x_lo", "centre_error")] <- c(2, 0.25, -1e-17, 3e-17)
  found <- function(centre) {
    list(
      moments = replace(moments, 8:10, 0.5), errors = c(second = 0, mass = 0, centre = centre),
      detail = list(), evaluations = 1
    )
  }
  run <- list(domain = domain_box(c(-1.25, -1, -1), c(0.75, 1, 1)))
  error <- function(centre) {
    rotdyn:::density_body(found(centre), run, "rule", "box")$detail$centre_error_m
  }
  # At the origin no rounding of the place itself counts.
  expect_within(error(0), 4e-17, 1e-30)
  expect_within(error(1e-10) - error(0), 1e-10 * sqrt(0.75), 1e-16)
})
