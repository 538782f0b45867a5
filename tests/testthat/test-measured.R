test_that("the uncertainty of a function of one number is that of its slope", {
  x <- measured(0.3, 1e-3)
  for (name in c("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan")) {
    slope <- eval(D(call(name, quote(v)), "v"), list(v = 0.3))
    y <- do.call(name, list(x))
    expect_equal(y$u / (1e-3 * abs(slope)), 1, tolerance = 1e-14, info = name)
    expect_equal(y$value, do.call(name, list(0.3)), info = name)
    # Its sign: y - slope x has no part of x left.
    expect_lt((y - slope * x)$u, 1e-17)
  }
})

test_that("readings: mean, s/sqrt(n), n - 1", {
  x <- measured(c(5.007, 4.994, 5.005, 4.990, 4.999))
  # JCGM 100, table H.2.
  expect_equal(x$value, 4.9990, tolerance = 1e-12)
  expect_equal(round(x$u, 4), 0.0032)
  expect_equal(x$dof, 4)
})

test_that("arithmetic carries what is in common", {
  m <- measured(1.55, 0.005)
  r <- measured(0.336, 0.001)
  expect_equal((m - m)$u, 0)
  expect_equal((m / m)$u, 0)
  expect_equal((m + m)$u, 0.01)
  expect_equal((m * m)$u, (m^2)$u)
  i <- m * r^2
  expect_equal(i$u / i$value, sqrt((0.005 / 1.55)^2 + (2 * 0.001 / 0.336)^2), tolerance = 1e-12)
  expect_equal((i / r^2)$u, 0.005, tolerance = 1e-12)
  expect_equal(sqrt(m^2)$u, 0.005, tolerance = 1e-12)
  expect_equal(exp(log(m))$u, 0.005, tolerance = 1e-12)
  expect_equal((sin(m)^2 + cos(m)^2)$u, 0, tolerance = 1e-15)
  expect_equal((-m)$parts$u, -0.005)
  expect_equal((2^m)$u, 2^1.55 * log(2) * 0.005, tolerance = 1e-12)
  # By the shares of m: a sum and a difference of what is correlated, and of what is not.
  r12 <- (0.005 / 1.55) / (i$u / i$value)
  expect_equal((m + i)$u^2, m$u^2 + i$u^2 + 2 * r12 * m$u * i$u, tolerance = 1e-12)
  expect_equal((m - r)$u^2, m$u^2 + r$u^2, tolerance = 1e-12)
})

test_that("effective degrees of freedom of Welch and Satterthwaite", {
  # JCGM 100, G.4.1: relative uncertainties .25, .57, .82 % with 9, 4, 14 give 1.03 % and 19.
  y <- measured(1, 0.0025, 9) * measured(1, 0.0057, 4) * measured(1, 0.0082, 14)
  expect_equal(round(100 * y$u, 2), 1.03)
  expect_equal(round(y$dof, 1), 19.0)
  expect_equal((measured(1, 0.1) + 3)$dof, Inf)
})

test_that("the concise form", {
  shown <- function(v, u) format(measured(v, u))
  expect_equal(shown(127.7322, 0.0711), "127.732(71)")
  expect_equal(shown(14.91114, 0.00112), "14.9111(11)")
  expect_equal(shown(12.3, 1.5), "12.3(1.5)")
  expect_equal(shown(-3.14159, 0.0996), "-3.14(10)")
  expect_equal(shown(250, 30), "250(30)")
  expect_equal(shown(0, 0.1), "0.00(10)")
  expect_equal(shown(5e-7, 1e-8), "5.00(10)e-7")
  expect_equal(shown(2, 0), "2")
})

test_that("objects of the errors package keep their identity", {
  skip_if_not_installed("errors")
  x <- errors::set_errors(2, 0.1)
  expect_equal(measured(x)$u, 0.1)
  expect_equal((measured(x) - measured(x))$u, 0)
  expect_equal((measured(x) - measured(errors::set_errors(2, 0.1)))$u, 0.1 * sqrt(2))
})

test_that("a measured number is a number wherever one is taken", {
  expect_equal(body_disk(measured(2, 0.1), 0.25)$mass_kg, 2)
  scene <- scene_axle(measured(0.05, 0.001), omega0_rad_per_s = 1)
  expect_equal(scene$moment_of_inertia_kg_m2, 0.05)
  expect_equal(as.double(measured(3, 1)), 3)
})

test_that("errors are the package's own", {
  expect_error(measured(), class = "rotdyn_error_missing")
  expect_error(measured(1), class = "rotdyn_error_missing")
  expect_error(measured("a", 1), class = "rotdyn_error_type")
  expect_error(measured(1, -1), class = "rotdyn_error_value")
  expect_error(measured(NA, 1), class = "rotdyn_error")
  expect_error(measured(1, 1, 0), class = "rotdyn_error_value")
  expect_error(measured(1, 1, sigma = 1), class = "rotdyn_error_argument")
  expect_error(measured(1, 0.1) / 0, class = "rotdyn_error_value")
  expect_error(measured(1, 0.1) %% 2, class = "rotdyn_error_type")
  expect_error(gamma(measured(1, 0.1)), class = "rotdyn_error_type")
  # Of the list that it is inside: they would give its fields.
  expect_error(rep(measured(1, 0.1), 2), class = "rotdyn_error_type")
  expect_error(measured(1, 0.1)[1], class = "rotdyn_error_type")
  forged <- measured(1, 0.1)
  forged$parts <- 3
  expect_error(body_disk(forged, 1), class = "rotdyn_error_type")
})

test_that("uncertainties beyond the digits of a double are shown as they are", {
  expect_identical(format(measured(1, 1e-320)), "1 +- 1e-320")
  expect_identical(format(measured(1e308, 1e-300)), "1e+308 +- 1e-300")
  expect_identical(format(measured(0.1, 1e300)), "0.1 +- 1e+300")
})

test_that("a damaged object of the errors package is refused for what it is", {
  wrong <- list(
    structure(2, errors = "much", class = "errors"), structure(2, class = "errors"),
    structure(c(1, 2), errors = c(0.1, 0.1), class = "errors"),
    structure("2", errors = 0.1, class = "errors")
  )
  for (x in wrong) {
    expect_error(
      rotdyn:::from_errors(x, "x", NULL), "must be one number", class = "rotdyn_error_size"
    )
  }
})

test_that("parts of other types are a damaged number", {
  x <- measured(2, 0.1)
  fits <- function(x) rotdyn:::check_measured(x, "x", rlang::current_env())
  expect_identical(fits(x), x)
  for (column in c("id", "group")) {
    odd <- x
    odd$parts[[column]] <- 1
    expect_error(fits(odd), "damaged", class = "rotdyn_error_type")
  }
  for (dof in list(0, NA_real_, "3")) {
    odd <- x
    odd$parts$dof <- dof
    expect_error(fits(odd), "damaged", class = "rotdyn_error_type")
  }
})

test_that("a result is named after its parts", {
  a <- measured(2, 0.1, name = "a")
  b <- measured(3, 0.1, name = "b")
  expect_identical((a + b)$name, "a + b")
  expect_identical((a / b)$name, "a / b")
  expect_identical((a - 1)$name, "a - 1")
  expect_identical((2 * b)$name, "2 * b")
})

test_that("sum() is that of `+`; other summaries are refused", {
  a <- measured(3, 0.1, dof = 5)
  b <- measured(2, 0.2)
  c <- a * b
  parts <- function(x) {
    part <- x$parts[order(x$parts$id), ]
    rownames(part) <- NULL
    part
  }
  for (pair in list(
    list(sum(a, b), a + b), list(sum(a, b, c), a + b + c), list(sum(a, a), a + a),
    list(sum(a), +a), list(sum(a, 1.5, b), a + 1.5 + b), list(sum(a, -a), a + -a)
  )) {
    expect_s3_class(pair[[1]], "rot_measured")
    for (name in c("value", "u", "dof")) expect_equal(pair[[1]][[name]], pair[[2]][[name]])
    expect_equal(parts(pair[[1]]), parts(pair[[2]]))
  }
  expect_identical(sum(a, b)$name, (a + b)$name)
  expect_equal(sum(a, a)$u, 0.2)
  expect_identical(sum(a, -a)$u, 0)
  expect_identical(sum(a, b, na.rm = TRUE)$value, 5)
  expect_error(mean(a), class = "rotdyn_error_type")
  expect_error(sum(a, "1"), class = "rotdyn_error_type")
  expect_error(sum(a, NA), class = "rotdyn_error")
  expect_error(sum(a, 1:3), class = "rotdyn_error")
  for (verb in list(max, min, range, prod, any, all)) {
    expect_error(verb(a, b), "not defined", class = "rotdyn_error_type")
  }
})

test_that("a logarithm has the base that is given, and |x| no uncertainty at 0", {
  x <- measured(100, 1)
  expect_identical(log(x, 10)$value, 2)
  expect_equal(log(x, base = 10)$u, 0.01 / log(10), tolerance = 1e-14)
  expect_error(log(x, 0), class = "rotdyn_error_value")
  expect_error(log(x, 1), class = "rotdyn_error_value")
  expect_error(abs(measured(0, 1)), class = "rotdyn_error_value")
  expect_identical(abs(measured(-2, 1))$value, 2)
})

test_that("a value outside of the domain of a function is one error, without R's warning", {
  outside <- list(quote(log(x)), quote(log(x, 2)), quote(sqrt(x)), quote(asin(x)), quote(acos(x)))
  for (code in outside) {
    expect_no_warning(expect_error(
      eval(code, list(x = measured(-2, 0.1))), "not finite", class = "rotdyn_error_value"
    ))
  }
})
