# The rows of a table of published cases, by id.
published <- function(folder) {
  table <- utils::read.csv(shared("cases", folder, "cases.csv"), colClasses = "character")
  split(table, table$id)
}

# The inputs of a row, in its own units: {"m": 1, "r": [1, 2]} as a list.
inputs_of <- function(row) {
  text <- gsub("}", ")", gsub("{", "list(", row$inputs, fixed = TRUE), fixed = TRUE)
  text <- gsub("]", ")", gsub("[", "c(", text, fixed = TRUE), fixed = TRUE)
  eval(parse(text = gsub("\":", "\" =", text, fixed = TRUE)), baseenv())
}

# Within the digits of the answer; to 1e-8 of the value computed independently. 1e-4: a difference
# of exactly the last digit is not one in doubles.
expect_published <- function(got, row) {
  expect_equal(length(got), 1, label = row$id)
  expect_lte(abs(got - as.numeric(row$published)), 1.0001 * as.numeric(row$tol_abs), label = row$id)
  expect_equal(got, as.numeric(row$computed), tolerance = 1e-8, label = row$id)
}
