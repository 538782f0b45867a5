h2 <- cbind(
  v = c(5.007, 4.994, 5.005, 4.990, 4.999),
  i = c(19.663, 19.639, 19.640, 19.685, 19.678) / 1000,
  phi = c(1.0456, 1.0438, 1.0468, 1.0428, 1.0433)
)
impedance <- function(v, i, phi) c(R = v / i * cos(phi), X = v / i * sin(phi), Z = v / i)

test_that("JCGM 100, example H.2: simultaneous readings of three quantities", {
  b <- uncertainty_budget(
    impedance, v = measured(h2[, "v"]), i = measured(h2[, "i"]), phi = measured(h2[, "phi"]),
    correlation = cor(h2)
  )
  expect_equal(round(b$value, 3), c(R = 127.732, X = 219.847, Z = 254.260))
  expect_equal(round(b$u, 3), c(R = 0.071, X = 0.296, Z = 0.236))
  expect_equal(round(b$correlation[c("R", "R", "X"), c("X", "Z")], 3)[c(1, 4, 6)],
    c(-0.588, -0.485, 0.993))
  expect_equal(unname(b$dof), c(4, 4, 4))
  # The draws agree to their own error.
  expect_true(all(b$draws$agrees))
  expect_lt(max(abs(b$draws$u / b$u - 1)), 0.01)
  # Approach 2 of H.2.4: a result of each reading, then mean and s/sqrt(5).
  each <- apply(h2, 1, function(r) impedance(r[1], r[2], r[3]))
  expect_equal(unname(b$u), unname(apply(each, 1, stats::sd) / sqrt(5)), tolerance = 2e-3)
  expect_equal(unname(b$correlation), unname(cor(t(each))), tolerance = 2e-3)
  # What they have in common goes on: R^2 + X^2 = Z^2, whose correlated uncertainties must agree.
  z <- sqrt(b$results$R^2 + b$results$X^2)
  expect_equal((z - b$results$Z)$u / b$u[["Z"]], 0, tolerance = 1e-3)
  expect_equal(z$u, b$u[["Z"]], tolerance = 1e-3)
})

test_that("a quantity used twice is one quantity", {
  m <- measured(2, 0.1)
  other <- measured(2, 0.1)
  expect_equal(uncertainty_budget(function(a, b) a - b, m, m)$u[[1]], 0)
  expect_equal(
    uncertainty_budget(function(a, b) a - b, m, other)$u[[1]], 0.1 * sqrt(2), tolerance = 1e-12
  )
  expect_equal(
    uncertainty_budget(function(a, b) a + b, m, m)$u[[1]], 0.2, tolerance = 1e-12
  )
  # Also inside results.
  r <- uncertainty_budget(function(a, c) a * c, m, measured(3, 0.2))$results$y
  ratio <- uncertainty_budget(function(x, a) x / a, r, m)
  expect_equal(ratio$u[[1]], 0.2, tolerance = 1e-3)
  expect_equal(nrow(ratio$contributions), 2)
})

test_that("contributions, shares, sensitivities of a product", {
  b <- uncertainty_budget(
    function(mass, radius) mass * radius^2,
    mass = measured(1.55, 0.01), radius = measured(0.3, 0.002)
  )
  rows <- b$contributions
  expect_equal(rows$input, c("mass", "radius"))
  expect_equal(rows$sensitivity, c(0.09, 2 * 1.55 * 0.3), tolerance = 1e-12)
  expect_equal(rows$contribution, c(0.0009, 2 * 1.55 * 0.3 * 0.002), tolerance = 1e-12)
  expect_equal(sum(rows$share), 1)
  expect_equal(b$interval[1, ], c(lower = 1, upper = 1) * b$value +
    c(-1, 1) * stats::qnorm(0.975) * b$u, ignore_attr = TRUE)
  expect_equal(b$interval_from[[1]], "formula")
})

test_that("a curved function: the drawn interval replaces the formula's", {
  # x^2 of N(0.5, 1) is chi^2 with one degree, non-central by 0.25.
  b <- uncertainty_budget(function(x) x^2, measured(0.5, 1))
  expect_equal(b$interval_from[[1]], "draws")
  f <- function(q) stats::pchisq(q, 1, ncp = 0.25)
  expect_equal(f(b$interval[1, "upper"])[[1]], 0.975, tolerance = 2e-3)
  expect_within(f(b$interval[1, "lower"])[[1]], 0.025, 0.1)
  expect_false(b$draws$agrees)
})

test_that("few degrees of freedom: the drawn interval is that of t", {
  b <- uncertainty_budget(function(x) 3 * x, measured(2, 0.1, dof = 4))
  expect_equal(b$interval[[1, "upper"]], 6 + 0.3 * stats::qt(0.975, 4))
  expect_equal(b$draws$upper, 6 + 0.3 * stats::qt(0.975, 4), tolerance = 0.01)
  expect_true(b$draws$agrees)
})

test_that("functions that take no vectors, and exact numbers", {
  f <- function(a, b) if (a > 0) a * b else 0
  b <- uncertainty_budget(f, measured(2, 0.1), 3, draws = 2000)
  expect_equal(b$u[[1]], 0.3, tolerance = 1e-12)
  expect_true(b$draws$agrees)
  exact <- uncertainty_budget(function(a) a, 3)
  expect_equal(exact$u[[1]], 0)
})

test_that("the random numbers of the session stay unchanged", {
  set.seed(7)
  before <- .Random.seed
  b <- uncertainty_budget(function(a) a^2, measured(2, 0.1), draws = 100)
  expect_identical(.Random.seed, before)
  again <- uncertainty_budget(function(a) a^2, measured(2, 0.1), draws = 100)
  expect_identical(b$draws, again$draws)
})

test_that("errors are the package's own", {
  m <- measured(2, 0.1)
  expect_error(uncertainty_budget(), class = "rotdyn_error_missing")
  expect_error(uncertainty_budget(function(x) x), class = "rotdyn_error_missing")
  expect_error(uncertainty_budget(3, m), class = "rotdyn_error_type")
  expect_error(uncertainty_budget(function(x) "a", m), class = "rotdyn_error_type")
  expect_error(uncertainty_budget(function(x) log(x - 2), m), class = "rotdyn_error_value")
  f <- function(a, b) a + b
  n <- measured(1, 1)
  bad <- list(
    size = diag(3), size = 1,
    value = matrix(c(1, 2, 2, 1), 2), value = matrix(c(1, 0.5, 0.4, 1), 2),
    # Of a size that rounding does not have.
    value = matrix(1 + 1e-7 * c(0, 1, 1, 0), 2), value = matrix(c(1, 0.5, 0.5 + 1e-7, 1), 2),
    value = diag(1 + 1e-7, 2)
  )
  for (k in seq_along(bad)) {
    expect_error(uncertainty_budget(f, m, n, correlation = bad[[k]]),
      class = paste0("rotdyn_error_", names(bad)[k]))
  }
  r <- matrix(c(1, 0.9, -0.9, 0.9, 1, 0.9, -0.9, 0.9, 1), 3)
  expect_error(uncertainty_budget(function(a, b, c) a, m, n, measured(1, 1), correlation = r),
    class = "rotdyn_error_value")
  # Three that are correlated alike by r: the lowest eigenvalue is 1 + 2 r, of -1e-6 at most.
  alike <- function(lowest) {
    r <- matrix((lowest - 1) / 2, 3, 3)
    diag(r) <- 1
    uncertainty_budget(function(a, b, c) a, m, n, measured(1, 1), correlation = r)
  }
  expect_s3_class(alike(-0.9e-6), "rot_uncertainty_budget")
  expect_error(alike(-1.1e-6), class = "rotdyn_error_value")
})

test_that("numbers without a name are the arguments that are left, in their order", {
  area <- measured(0.1, 1e-3)
  budget <- uncertainty_budget(function(m, r) m * r^2, r = area, measured(1, 0.01))
  expect_identical(budget$contributions$input, c("r", "m"))
  # Of m r^2: 2 m r and r^2.
  expect_equal(budget$contributions$sensitivity, c(0.2, 0.01), tolerance = 1e-6)
  expect_equal(budget$contributions$share, c(4, 1) / 5, tolerance = 1e-6)
})

test_that("a name that the function does not take is said, and integers are numbers", {
  x <- measured(1, 0.1)
  expect_error(
    uncertainty_budget(function(alpha) alpha, alpha = x, beta = x), "no argument",
    class = "rotdyn_error_argument"
  )
  expect_equal(uncertainty_budget(function(alpha) alpha, al = x)$value[["y"]], 1)
  expect_equal(uncertainty_budget(function(...) sum(...), a = x, b = x)$value[["y"]], 2)
  whole <- uncertainty_budget(function(n) as.integer(n), n = measured(3, 0), draws = 0)
  expect_type(whole$value, "double")
  expect_output(print(whole), "y = 3")
})
