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
