numbers_of <- function(x) .Call(ffi_text_numbers, x)

test_that("doubles of all exponents come back from the reader bit for bit", {
  skip_if_not_installed("yyjsonr")
  set.seed(7)
  n <- or_long(1e5, 1e6)
  bytes <- as.raw(sample(0:255, 8 * n, TRUE))
  x <- c(readBin(bytes, "double", n), 0, -0, .Machine$double.xmax, .Machine$double.xmin, 5e-324)
  x <- x[is.finite(x)]
  text <- json_canonical(list(x = x))
  back <- read_json(text, "text", "scene", NULL)$x
  expect_gt(length(x), 0.99 * n)
  expect_identical(writeBin(back, raw()), writeBin(x, raw()))
})

test_that("numbers are the shortest that come back", {
  expect_identical(
    numbers_of(c(0, -0, 1, 0.1, 2 / 3, 1e22, Inf, -Inf, NaN)),
    c("0", "-0.0", "1", "0.1", "0.6666666666666666", "1e+22", "Inf", "-Inf", "NaN")
  )
})

test_that("the canonical text has sorted keys and no blanks; strings are escaped", {
  x <- list(b = 1:2, B = "a\"\\\n\001é", a = NULL, n = c(1, Inf, NaN), m = diag(2), e = list())
  x["a"] <- list(NULL)
  expect_identical(
    json_canonical(x),
    enc2utf8(paste0(
      "{\"B\":\"a\\\"\\\\\\n\\u0001é\",\"a\":null,\"b\":[1,2],\"e\":[],",
      "\"m\":[[1,0],[0,1]],\"n\":[1,\"Inf\",\"NaN\"]}"
    ))
  )
  expect_identical(json_canonical(stats::setNames(list(), character())), "{}")
})

test_that("what was written is read: numbers, rows, strings, levels", {
  skip_if_not_installed("yyjsonr")
  x <- list(
    a = c(1, -0, Inf, NaN), b = matrix(c(1, 2, 3, 4, 5, 6), 2), c = c("x", "NA"), d = TRUE,
    e = list(f = 2.5, g = list("a", 1)), h = numeric(), i = matrix(c(1, Inf)),
    j = matrix(c(NaN, -Inf, 1, 2), 2)
  )
  for (indent in c(0L, 2L)) {
    back <- read_json(json_text(x, indent), "text", "scene", NULL)
    expect_identical(1 / back$a[2], -Inf)
    expect_identical(back$b, x$b)
    expect_identical(back[c("c", "d")], x[c("c", "d")])
    expect_identical(back$e, list(f = 2.5, g = list("a", 1)))
    expect_identical(back$h, list())
    expect_identical(back[c("i", "j")], x[c("i", "j")])
  }
})

test_that("texts that are no JSON, too deep, or say a key twice are refused", {
  skip_if_not_installed("yyjsonr")
  refused <- function(text, says) {
    expect_error(read_json(text, "scene", "scene", NULL), says, class = "rotdyn_error_scene")
  }
  refused("", "empty|length")
  refused("{\"a\": 1", "end of data")
  refused("{\"a\": 1, \"a\": 2}", "twice")
  refused("{\"a\": {\"b\": 1, \"b\": 2}}", "twice")
  refused("{\"a\": NaN}", "unexpected")
  refused("{\"a\": 1e999}", "infinity")
  refused("{\"a\": \"\\u0000b\"}", "character 0")
  refused(paste0(strrep("[", 1e5), strrep("]", 1e5)), "100 levels")
  refused("{\"a\": \"\xff\"}", "UTF-8")
  expect_identical(
    read_json(paste0("{\"a\": \"", strrep("[", 200), "\"}"), "text", "scene", NULL)$a,
    strrep("[", 200)
  )
})

test_that("the hash is XXH128 of the bytes", {
  # xxhsum -H2 of an empty file, and of the three bytes abc.
  expect_identical(hash_text(""), "99aa06d3014798d86001c324468d497f")
  expect_identical(hash_text("abc"), "06b05ab6733a618578af5f94892f3950")
})

test_that("the hash of numbers is that of their bytes, the lowest first", {
  hash <- function(...) .Call(rotdyn:::ffi_hash, list(...))
  bytes <- function(x) writeBin(x, raw(), endian = "little")
  expect_identical(hash(c(1.5, -2)), hash(bytes(c(1.5, -2))))
  expect_identical(hash(7L, 0.1), hash(c(bytes(7L), bytes(0.1))))
  expect_identical(hash(TRUE), hash(bytes(1L)))
})
