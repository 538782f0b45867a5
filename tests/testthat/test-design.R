# Designs: rows by their numbers, each kind, names and units of inputs, errors, correlated inputs.

laws <- function() {
  list(
    a = vary_uniform(0, 1), b = 2.5, c = vary_normal(3, 2),
    d = vary_values(c(3, -0, 7), c(1, 2, 1)), e = vary_lognormal(1, 1.5),
    `body$mass_kg` = vary_triangular(0, 1, 3)
  )
}
unit_interval <- vary_uniform(0, 1)
drawn <- function(make, n, ...) do.call(make, c(n, laws(), ...))

designs <- function(n = 10000) {
  list(
    grid = design_grid(a = 1:25, b = 2, c = c(0.1, 0.2, 0.4, -0), d = 1:10, e = 1:10),
    list = design_list(data.frame(a = sqrt(1:n), b = -0, c = n:1)),
    random = drawn(design_random, n, seed = 2^40 + 1), latin = drawn(design_latin, n, seed = 5),
    sobol = drawn(design_sobol, n, seed = 42), plain = drawn(design_sobol, n),
    saltelli = drawn(design_saltelli, n, seed = 42)
  )
}

bits <- function(x) lapply(x, writeBin, raw())

test_that("rows by their numbers are the rows of longer pieces, each kind", {
  for (design in designs()) {
    whole <- design_rows(design, n = 1e5)
    expect_identical(whole$row, as.double(seq_len(nrow(whole))))
    set.seed(3)
    for (i in sample(nrow(whole) - 3L, or_long(60, 10000))) {
      expect_identical(bits(design_rows(design, i, 3)), bits(whole[i + 0:2, ]))
    }
  }
})

test_that("rows beyond 2^31, the last one of 2^52, and one row alone", {
  for (kind in c("random", "latin", "sobol")) {
    make <- get(paste0("design_", kind))
    design <- drawn(make, 2^52, seed = 2^53)
    piece <- design_rows(design, 2^52 - 99, 200)
    expect_identical(piece$row, 2^52 - 99:0)
    expect_true(all(piece$a > 0 & piece$a < 1))
    expect_identical(bits(design_rows(design, 2^52, 1)), bits(piece[100, ]))
    expect_false(identical(piece$c, design_rows(design, 1, 100)$c))
    expect_identical(nrow(design_rows(drawn(make, 1, seed = 0))), 1L)
  }
  expect_identical(design_rows(design_grid(x = 1:1000, y = 1:1000, z = 1:1000), 1e9)$z, 1000)
  expect_identical(nrow(design_rows(design_grid(x = 1), n = 0)), 0L)
})

test_that("a grid is expand.grid()", {
  design <- design_grid(x = c(3, -0, 7), y = 5, z = vary_values(c(1, 2)))
  rows <- design_rows(design, n = 100)
  want <- expand.grid(x = c(3, -0, 7), y = 5, z = c(1, 2))
  expect_identical(bits(rows[-1]), bits(as.list(want)))
  expect_identical(1 / rows$x[2], -Inf)
})

test_that("a list is its rows", {
  data <- data.frame(a = c(1.5, -0, Inf), b = 3:1)
  rows <- design_rows(design_list(data), 2, 2)
  expect_identical(bits(rows[-1]), bits(list(a = c(-0, Inf), b = c(2, 1))))
})

test_that("a Latin hypercube has one row in each stratum of each input", {
  for (n in c(1, 7, 1000, 65537)) {
    design <- design_latin(n, x = unit_interval, y = unit_interval, seed = 9)
    rows <- design_rows(design, n = n)
    expect_identical(sort(floor(rows$x * n)), as.double(seq_len(n) - 1))
    expect_identical(sort(floor(rows$y * n)), as.double(seq_len(n) - 1))
    if (n > 7) expect_lt(abs(cor(rows$x, rows$y)), 4.5 / sqrt(n))
  }
})

test_that("Sobol points are those of Joe and Kuo, and scrambled ones are nets", {
  rows <- design_rows(design_sobol(8, x = unit_interval, y = unit_interval), n = 8)
  expect_identical(rows$x, c(2^-53, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125))
  expect_identical(rows$y, c(2^-53, 0.5, 0.25, 0.75, 0.375, 0.875, 0.125, 0.625))
  design <- design_sobol(1024, x = unit_interval, y = unit_interval, seed = 1)
  rows <- design_rows(design, n = 1024)
  expect_identical(sort(floor(32 * rows$x) + 32 * floor(32 * rows$y)), as.double(0:1023))
  expect_false(any(rows$x[1:8] == c(2^-53, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125)))
  # An input that is fixed takes no coordinate, and n changes no row.
  other <- design_sobol(99, x = unit_interval, z = 3, y = unit_interval, seed = 1)
  expect_identical(design_rows(other, n = 50)$y, rows$y[1:50])
})

test_that("rows of a Saltelli design are A, B and A with one input of B", {
  design <- design_saltelli(100, x = unit_interval, f = 2, y = unit_interval,
                            z = unit_interval, seed = 3)
  rows <- design_rows(design, n = 1000)
  expect_identical(nrow(rows), 500L)
  v <- vapply(c("x", "y", "z"), function(name) matrix(rows[[name]], 5), matrix(0, 5, 100))
  for (i in 1:3) {
    expect_identical(v[2 + i, , i], v[2, , i])
    for (j in setdiff(1:3, i)) expect_identical(v[2 + i, , j], v[1, , j])
    expect_true(all(v[1, , i] != v[2, , i]))
  }
  points <- design_rows(design_sobol(100, x = unit_interval, y = unit_interval,
    z = unit_interval, p = unit_interval, q = unit_interval, r = unit_interval,
    seed = 3), n = 100)
  expect_identical(v[1, , 2], points$y)
  expect_identical(v[2, , 2], points$q)
  # First indices of x + 2 y, by Jansen's estimator: 1/5 and 4/5.
  design <- design_saltelli(4096, x = unit_interval, y = unit_interval, seed = 1)
  large <- design_rows(design, n = 4 * 4096)
  f <- matrix(large$x + 2 * large$y, 4)
  first <- 1 - c(mean((f[2, ] - f[3, ])^2), mean((f[2, ] - f[4, ])^2)) / (2 * var(f[1, ]))
  expect_lt(max(abs(first - c(0.2, 0.8))), 0.01)
})

test_that("seeds are independent, and the same seed gives the same rows", {
  for (make in list(design_random, design_latin, design_sobol)) {
    one <- design_rows(drawn(make, 1000, seed = 7), n = 1000)
    expect_identical(design_rows(drawn(make, 1000, seed = 7), n = 1000), one)
    for (seed in c(8, 7 + 2^32)) {
      other <- design_rows(drawn(make, 1000, seed = seed), n = 1000)
      expect_true(all(other$a != one$a))
      # Scramblings of one sequence: each is even, together they are not.
      if (!identical(make, design_sobol)) expect_lt(abs(cor(one$a, other$a)), 0.15)
    }
  }
  # R's own random numbers are left alone.
  set.seed(1)
  before <- .Random.seed
  design_rows(drawn(design_random, 10, seed = 1))
  expect_identical(.Random.seed, before)
})

test_that("a design is plain data and prints what it is", {
  for (design in designs(100)) {
    expect_identical(class(design), "rot_design")
    plain <- rapply(unclass(design), function(x) is.null(attributes(x)) && !is.function(x))
    expect_true(all(plain))
  }
  shown <- capture.output(print(designs(1000)$sobol))
  expect_match(shown[1], "<rot_design> Sobol, 1,000 rows, seed 42", fixed = TRUE)
  expect_match(shown[2], "a +uniform, 0 to 1")
  expect_match(shown, "no power of two: 512 or 1,024", all = FALSE)
  expect_match(shown, "design_rows(design, first = 1000)", fixed = TRUE, all = FALSE)
  expect_output(print(designs(1024)$plain), "not scrambled")
  expect_false(any(grepl("power", capture.output(print(designs(1024)$sobol)))))
  expect_output(print(designs(64)$saltelli), "448 rows of 64 base points, seed 42", fixed = TRUE)
  expect_output(print(designs(64)$list), "64 given numbers, 1 to 8", fixed = TRUE)
  expect_output(print(design_grid(x = 1)), "grid, 1 row\n", fixed = TRUE)
})

test_that("units stay beside the numbers", {
  skip_if_not_installed("units")
  design <- design_grid(m = units::set_units(c(1, 2), "g", mode = "standard"), r = 0.2)
  expect_identical(design$inputs$m, list(kind = "values", x = c(1, 2), unit = "g"))
  data <- data.frame(t = c(1, 2))
  data$t <- as.difftime(data$t, units = "mins")
  expect_identical(design_list(data)$inputs$t, list(kind = "column", x = c(60, 120), unit = "s"))
})

test_that("what is wrong is an error with its class", {
  error <- function(x, class = "value") expect_error(x, class = paste0("rotdyn_error_", class))
  u <- unit_interval
  error(design_random(10, x = u), "missing")
  error(design_latin(10, x = u), "missing")
  error(design_saltelli(10, x = u), "missing")
  error(design_sobol(x = u), "missing")
  error(design_random(10, x = u, seed = NULL), "type")
  for (n in list(0, 1.5, 2^52 + 2, NA_real_, Inf)) error(design_sobol(n, x = u))
  for (seed in list(-1, 0.5, 2^53 + 2, NaN)) error(design_sobol(1, x = u, seed = seed))
  error(design_sobol(10, u), "argument")
  error(design_sobol(10), "size")
  error(design_sobol(10, x = u, x = u))
  error(design_sobol(10, row = u))
  error(design_sobol(10, x = 3))
  error(design_sobol(10, x = 1:3), "size")
  error(design_sobol(10, x = "a"), "type")
  error(design_sobol(10, x = u, y = NA_real_))
  many <- stats::setNames(rep(list(u), 65), paste0("x", 1:65))
  error(do.call(design_sobol, c(10, many)))
  error(do.call(design_saltelli, c(10, many[1:33], seed = 1)))
  expect_identical(ncol(design_rows(do.call(design_random, c(10, many, seed = 1)))), 66L)
  error(design_saltelli(2^51, x = u, seed = 1))
  error(design_grid(x = u), "type")
  error(design_grid(x = vary_values(1:3, 1:3)), "type")
  error(design_grid(x = c(1, NaN)))
  error(design_grid(x = double()), "size")
  error(do.call(design_grid, stats::setNames(rep(list(1:1000), 6), letters[1:6])))
  error(design_list(3), "type")
  error(design_list(data.frame(x = double())), "size")
  error(design_list(data.frame(x = c(1, NA))))
  error(design_list(data.frame(x = "a")), "type")
  error(design_list(data.frame(x = factor("a"))), "type")
  error(design_list(data.frame(x = 1), dat = 3), "argument")
  design <- design_sobol(10, x = u)
  error(design_rows(design, 11))
  error(design_rows(design, 0))
  error(design_rows(design, 1.5))
  error(design_rows(design, n = -1))
  error(design_rows(list()), "type")
  error(design_rows(design, frist = 3), "argument")
})

test_that("a damaged design is an error of the package", {
  sound <- correlate(design_sobol(10, x = vary_normal(0, 1), y = vary_values(1:3, 1:3), seed = 1),
                     matrix(c(1, 0.5, 0.5, 1), 2, dimnames = list(c("x", "y"))))
  expect_identical(nrow(design_rows(sound)), 6L)
  damages <- list(
    quote(design$kind <- "odd"), quote(design$kind <- 3), quote(design$kind <- NULL),
    quote(design$n <- 0), quote(design$n <- 1.5), quote(design$n <- "a"), quote(design$n <- NaN),
    quote(design$seed <- -1), quote(design$seed <- 2^60), quote(design$seed <- "a"),
    quote(design$inputs <- NULL), quote(design$inputs <- list()), quote(design$inputs <- 3),
    quote(names(design$inputs) <- NULL), quote(names(design$inputs) <- c("x", "x")),
    quote(names(design$inputs) <- c("x", NA)), quote(design$inputs$x <- 3),
    quote(design$inputs$x$kind <- "odd"), quote(design$inputs$x$sd <- -1),
    quote(design$inputs$x$sd <- NULL), quote(design$inputs$x$mean <- NA_real_),
    quote(design$inputs$x$at_least <- "a"), quote(design$inputs$y$weights <- c(1, 2)),
    quote(design$inputs$y$x <- double()), quote(design$inputs$y$kind <- "column"),
    quote(design$correlation$inputs <- c("x", "z")),
    quote(design$correlation$inputs <- c("y", "x")),
    quote(design$correlation$inputs <- c("x", "x")), quote(design$correlation$inputs <- "x"),
    quote(design$correlation$matrix <- 1), quote(design$correlation$matrix <- c(1, 2, 2, 1)),
    quote(design$correlation$matrix <- c(1, 1, 1, 1)), quote(design$correlation <- 3),
    quote(design$kind <- "saltelli"), quote(design$kind <- "list")
  )
  expect_error(design_rows(structure(3, class = "rot_design")), class = "rotdyn_error_type")
  for (damage in damages) {
    design <- sound
    eval(damage)
    info <- deparse(damage)
    expect_error(design_rows(design), class = "rotdyn_error_type", info = info)
    expect_error(print(design), class = "rotdyn_error_type", info = info)
    expect_error(correlate(design, NULL), class = "rotdyn_error_type", info = info)
  }
})

test_that("correlated inputs have the correlation of their scores, and their own laws", {
  r <- matrix(c(1, 0.5, -0.3, 0.5, 1, 0.2, -0.3, 0.2, 1), 3)
  # In another order than the inputs.
  dimnames(r) <- list(c("e", "a", "c"), c("e", "a", "c"))
  for (make in list(design_random, design_latin, design_sobol)) {
    n <- 2^14
    plain <- drawn(make, n, seed = 11)
    design <- correlate(plain, r)
    expect_identical(design$correlation$inputs, c("a", "c", "e"))
    rows <- design_rows(design, n = n)
    scores <- cbind(e = log(rows$e) / log(1.5), a = qnorm(rows$a), c = (rows$c - 3) / 2)
    expect_lt(max(abs(cor(scores) - r)), 4.5 / sqrt(n))
    expect_lt(max(abs(colMeans(scores))), 4.5 / sqrt(n))
    expect_lt(max(abs(apply(scores, 2, var) - 1)), 4.5 * sqrt(2 / n))
    before <- design_rows(plain, n = n)
    # To the rounding of the score and back.
    expect_lt(max(abs(rows$a - before$a)), 1e-14)
    expect_identical(rows$d, before$d)
    expect_lt(abs(cor(scores[, "c"], rows$`body$mass_kg`)), 4.5 / sqrt(n))
    expect_identical(correlate(design, NULL), plain)
  }
  expect_output(print(design), "correlated: a, e 0.5; c, e -0.3; a, c 0.2", fixed = TRUE)
})

test_that("no matrix of correlations is refused", {
  design <- drawn(design_sobol, 8, seed = 1)
  error <- function(x, class = "value", design_ = design) {
    expect_error(correlate(design_, x), class = paste0("rotdyn_error_", class))
  }
  named <- function(x, names = c("a", "c", "e")[seq_len(sqrt(length(x)))]) {
    matrix(x, length(names), dimnames = list(names, names))
  }
  error(named(c(1, 0.9, -0.9, 0.9, 1, 0.9, -0.9, 0.9, 1)))
  error(named(c(1, 1, 1, 1)))
  error(named(c(1, 0.5, 0.4, 1)))
  error(named(c(1, 0.5, 0.5, 0.9)))
  error(named(c(1, NA, NA, 1)))
  error(named(c(1, 0.5, 0.5, 1), c("a", "b")))
  error(named(c(1, 0.5, 0.5, 1), c("a", "z")))
  error(named(c(1, 0.5, 0.5, 1), c("a", "a")))
  error(matrix(c(1, 0.5, 0.5, 1), 2))
  error(named(1), "size")
  error(matrix(1, 2, 3), "size")
  error(3, "type")
  error(named(c(1, 0.5, 0.5, 1)), "type", 3)
  error(named(c(1, 0.5, 0.5, 1)), "value", drawn(design_saltelli, 8, seed = 1))
  error(named(c(1, 0.5, 0.5, 1)), "value", design_grid(a = 1:2, c = 1:2))
  expect_error(correlate(design), class = "rotdyn_error_missing")
  expect_error(correlate(design, named(c(1, 0, 0, 1)), tow = 1), class = "rotdyn_error_argument")
})
