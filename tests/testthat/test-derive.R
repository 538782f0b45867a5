# Derived inputs: the values of R's own arithmetic, canonical text, what is refused.

special <- c(0, -0, 1, -1, 2, 0.5, -2.5, 3, -3, Inf, -Inf, NaN, 1e300, 1e-300, pi, 7)
grid <- expand.grid(a = special, b = special)
grid$`body$mass_kg` <- seq(-2, 5, length.out = nrow(grid))

derived <- function(x, data = grid) {
  program <- derived_input(x, names(data), "x", rlang::current_env())
  derived_values(program, as.list(data), nrow(data))
}

# Bits, with one NaN.
same_bits <- function(got, want) {
  want[is.na(want)] <- NaN
  got[is.na(got)] <- NaN
  identical(writeBin(got, raw()), writeBin(as.double(want), raw()))
}

test_that("results have the bits of R's arithmetic", {
  set.seed(1)
  mixed <- data.frame(a = rnorm(1000), b = exp(rnorm(1000, 0, 20)))
  mixed$`body$mass_kg` <- runif(1000)
  formulas <- list(
    ~ a + b, ~ a - b, ~ a * b, ~ a / b, ~ a^b, ~ b^2, ~ a^-1, ~ a^0.5, ~ -a, ~ +a, ~ sqrt(a),
    ~ exp(a), ~ log(b), ~ sin(b), ~ cos(a), ~ tan(a), ~ abs(a), ~ pmin(a, b), ~ pmax(a, b, 1),
    ~ pmin(a, b, 0.5, 2), ~ a < b, ~ a <= b, ~ a > b, ~ a >= b, ~ a == b, ~ a != b,
    ~ ifelse(a < b, a + 1, b * 2), ~ ifelse(a, b, 3), ~ pi * a^2 / 4, ~ -a^2, ~ (-a)^2,
    ~ a - (b - 1), ~ a - b - 1, ~ a / (b / 3), ~ 2^a^b, ~ (2^a)^b, ~ -(a + b) * 3,
    ~ (a < b) * 2 - 1, ~ a * -b, ~ 1 / 3 * a, ~ 0.1 + a, ~ a^(b * 2), ~ exp(-(a^2) / 2) * (a > 0),
    ~ `body$mass_kg` * a, ~ 2L * a
  )
  for (data in list(grid, mixed)) {
    for (f in formulas) {
      want <- suppressWarnings(eval(f[[2]], data))
      expect_true(same_bits(derived(f, data), want), info = deparse(f))
      # The canonical text is the same formula.
      text <- derived_input(f, names(data), "x", NULL)$text
      expect_true(same_bits(derived(text, data), want), info = text)
      expect_identical(derived_input(text, names(data), "x", NULL)$text, text)
    }
  }
  expect_identical(derived(~ body$mass_kg * 2), grid$`body$mass_kg` * 2)
})

test_that("the text is canonical", {
  text <- function(x) derived_input(x, names(grid), "x", NULL)$text
  expect_identical(text(~ ((a)) *(b^2)/2), "a * b^2 / 2")
  expect_identical(text("a*( b+1 )"), "a * (b + 1)")
  expect_identical(text(~ a - (b - 1)), "a - (b - 1)")
  expect_identical(text(~ (a - b) - 1), "a - b - 1")
  expect_identical(text(~ (a^b)^2), "(a^b)^2")
  expect_identical(text(~ a^(b^2)), "a^b^2")
  expect_identical(text(~ -(a * b)), "-(a * b)")
  expect_identical(text(~ body$mass_kg + 0.1), "`body$mass_kg` + 0.1")
  expect_identical(text(~ pmin(a,b,  pi)), "pmin(a, b, pi)")
  negative <- eval(bquote(~ .(-2)^a))
  expect_identical(text(negative), "(-2)^a")
  expect_true(same_bits(derived(negative), (-2)^grid$a))
  expect_identical(text(~ 1e-300 * a), "1e-300 * a")
})

test_that("a program is plain data", {
  program <- derived_input(~ (a + 2) * b, c("a", "b"), "x", NULL)
  expect_identical(program$arg, c(0L, 0L, 0L, 1L, 0L))
  expect_identical(program$constant, 2)
  expect_null(attributes(program$op))
})

test_that("what is not allowed is named", {
  error <- function(x, said, class = "value") {
    e <- expect_error(derived(x), class = paste0("rotdyn_error_", class))
    expect_match(conditionMessage(e), said, fixed = TRUE)
  }
  error(~ system("ls"), "system")
  error(~ gamma(a), "gamma")
  error(~ a %% 2, "%%")
  error(~ base::exp(a), "base::exp")
  error(~ (function(x) x)(a), "not allowed")
  error(~ {a}, "{")
  error(~ a[1], "[")
  error(~ c, "c")
  error(~ inertia * 2, "inertia")
  error(~ log(a, 2), "log")
  error(~ exp(x = a), "exp")
  error(~ pmin(a), "pmin")
  error(~ pmin(a, b, na.rm = TRUE), "pmin")
  error(~ ifelse(a, b), "ifelse")
  error(~ ifelse(a, b, ), "ifelse")
  error(~ "a", "neither")
  error(~ TRUE, "neither")
  error(~ NULL, "neither")
  error(~ NA_real_, "neither")
  error(~ Inf, "Inf")
  error(y ~ a, "left side")
  error("a; b", "one expression")
  error("a +", "one expression")
  error("", "one expression")
  error(strrep("(", 20000), "one expression")
  error(c("a", "b"), "formula", "type")
  error(1, "formula", "type")
  error(NA_character_, "formula", "type")
  error(quote(a), "formula", "type")
  deep <- Reduce(function(x, i) call("+", quote(a), x), 1:40, quote(b))
  error(eval(call("~", deep)), "deeply")
  very <- Reduce(function(x, i) call("-", x), 1:300, quote(b))
  error(eval(call("~", very)), "deeply")
  # A formula of many terms is not deep.
  long <- Reduce(function(x, i) call("+", x, quote(a)), 1:100, quote(b))
  expect_identical(derived(eval(call("~", long)), data.frame(a = 1, b = 2)), 102)
})

test_that("a damaged program is an error, not a crash", {
  program <- derived_input(~ a + b, c("a", "b"), "x", NULL)
  run <- function(...) {
    changed <- utils::modifyList(program, list(...))
    expect_error(derived_values(changed, list(c(1, 2), c(3, 4)), 2), "internal")
  }
  expect_identical(derived_values(program, list(c(1, 2), c(3, 4)), 2), c(4, 6))
  run(op = c(1L, 1L, 99L))
  run(op = c(1L, 1L))
  run(op = c(1, 1, 2))
  run(op = c(2L, 1L, 1L))
  run(arg = c(0L, 2L, 0L))
  run(arg = c(0L, NA, 0L))
  run(arg = c(-1L, 0L, 0L))
  run(constant = "a")
  expect_error(derived_values(program, list(c(1, 2), 3), 2), "internal")
  expect_error(derived_values(program, list(c(1, 2)), 2), "internal")
  expect_error(derived_values(program, list(1:2, 3:4), 2), "internal")
})
