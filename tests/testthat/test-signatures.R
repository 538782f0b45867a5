# Arguments and defaults of all functions that users call. Where one changes on purpose, write it in
# NEWS.md and call testthat::snapshot_accept("signatures").

exported <- sort(getNamespaceExports("rotdyn"), method = "radix")
functions <- mget(exported, asNamespace("rotdyn"), inherits = TRUE)
functions <- functions[vapply(functions, is.function, NA)]

test_that("the default of gravity is the standard one (CGPM 1901)", {
  defaults <- lapply(functions, function(f) formals(f)$gravity_m_per_s2)
  defaults <- Filter(is.numeric, defaults)
  expect_gt(length(defaults), 10)
  for (name in names(defaults)) expect_identical(defaults[[!!name]], 9.80665)
})

test_that("functions have these arguments and defaults", {
  lines <- vapply(exported[exported %in% names(functions)], function(name) {
    given <- formals(functions[[name]])
    values <- vapply(given, function(one) paste(deparse(one, 500L), collapse = " "), "")
    paste0(name, "(", paste0(names(given), ifelse(nzchar(values), " = ", ""), values,
      collapse = ", "), ")")
  }, "")
  expect_snapshot(writeLines(lines))
})
