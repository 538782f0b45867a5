test_that("each dialect has its types, SQLite its strict tables", {
  tables <- all_tables()
  sql <- table_sql(tables$constants, tables, "sqlite")
  expect_match(sql, "value REAL NOT NULL", fixed = TRUE)
  expect_match(sql, "unit TEXT NOT NULL REFERENCES rot_unit (unit)", fixed = TRUE)
  expect_match(sql, "CHECK (exact = 0 OR standard_uncertainty = 0)", fixed = TRUE)
  expect_match(sql, ") STRICT", fixed = TRUE)
  expect_match(table_sql(tables$constants, tables, "postgresql"), "value DOUBLE PRECISION")
  expect_match(table_sql(tables$constants, tables, "duckdb"), "value DOUBLE NOT NULL")
  expect_match(
    table_sql(tables$model_effects, tables, "sqlite"),
    "FOREIGN KEY (constraint_kind, effect) REFERENCES rot_effect (constraint_kind, effect)",
    fixed = TRUE
  )
})

test_that("every table refers to itself or to those before it", {
  tables <- all_tables()
  for (i in seq_along(tables)) {
    refers <- c(
      unlist(lapply(tables[[i]]$columns, `[[`, "refers")),
      unlist(lapply(tables[[i]]$rules, `[[`, "refers"))
    )
    expect_true(all(refers %in% names(tables)[seq_len(i)]))
  }
  expect_false(anyDuplicated(vapply(tables, `[[`, "", "sql")) > 0)
})

test_that("the value that breaks a check does", {
  seen <- 0
  for (table in all_tables()) {
    for (column in table$columns) {
      check <- column$check
      if (is.null(check)) next
      expect_false(isTRUE(as.logical(check$holds(check$wrong))))
      seen <- seen + 1
    }
  }
  expect_gt(seen, 20)
  expect_true(at_least(3)$holds(3) && !at_least(3)$holds(2.5))
  expect_identical(at_least(3)$wrong, 2)
})
