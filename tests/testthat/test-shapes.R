# A formula of the catalogue as R reads it: a blank between factors multiplies.
evaluate <- function(text, values) {
  text <- gsub("([A-Za-z0-9)]) (?=[A-Za-z0-9(])", "\\1 * ", text, perl = TRUE)
  eval(parse(text = text)[[1]], values, baseenv())
}

values_of <- function(row, size, mass) {
  letters <- sub(" = .*$", "", strsplit(row$sizes, ", ")[[1]])
  c(stats::setNames(as.list(size), letters), list(m = mass))
}

test_that("the words are of the shapes that the core knows, with their sizes", {
  core <- .Call(rotdyn:::ffi_shapes_list)
  table <- shapes()
  expect_identical(table$shape, core$shape)
  expect_identical(sort(rotdyn:::shape_words_table$shape), sort(core$shape))
  expect_identical(table$dimension, core$dimension)
  names <- lapply(strsplit(table$sizes, ", "), function(x) sub("^.* = ", "", x))
  expect_identical(names, core$sizes)
  letters <- lapply(strsplit(table$sizes, ", "), function(x) sub(" = .*$", "", x))
  expect_false(any(vapply(letters, anyDuplicated, integer(1)) > 0))
  expect_gte(nrow(table), 30)
})

test_that("every formula gives what the core computes", {
  table <- shapes()
  for (shape in names(test_sizes)) {
    row <- table[table$shape == shape, ]
    for (size in test_sizes[[shape]]) {
      values <- values_of(row, size, 2.5)
      value <- function(field) evaluate(row[[field]], values)
      body <- body_of_shape(shape, size, mass_kg = 2.5)
      moments <- c(value("ixx_formula"), value("iyy_formula"), value("izz_formula"))
      scale <- max(moments)
      expect_lte(max(abs(diag(body$inertia_kg_m2) - moments)), 1e-14 * scale, label = shape)
      centre <- evaluate(sub("^\\(", "c(", row$centre_formula), c(values, c = c))
      if ("c" %in% names(values)) centre <- c(0, 0, 0)
      expect_lte(max(abs(body$centre_m - centre)), 1e-14 * body$reach_m, label = shape)
      expect_equal(is.na(row$beta_formula), is.na(body$beta), label = shape)
      if (!is.na(body$beta)) {
        expect_equal(body$beta, value("beta_formula"), tolerance = 1e-14, label = shape)
      }
      if (!is.na(row$measure_formula)) {
        dense <- body_of_shape(shape, size, density = 3)
        expect_equal(dense$mass_kg, 3 * value("measure_formula"), tolerance = 1e-14, label = shape)
      }
      args <- c(list(shape = shape, mass_kg = 2.5), as.list(body$size_m))
      reported <- inertia_table(as.data.frame(args))$moment_of_inertia_kg_m2
      expect_equal(reported, value("formula"), tolerance = 1e-14, label = shape)
    }
  }
})

test_that("a triangle's product of inertia, as its help says", {
  evaluated <- evaluate("-m h (2 p - b) / 36", list(m = 2.5, b = 3, h = 5, p = -2))
  expect_equal(body_triangle(2.5, 3, 5, apex_m = -2)$inertia_kg_m2[1, 2], evaluated)
})

test_that("points: what the axis says", {
  table <- shapes()
  formula <- function(shape) {
    row <- table[table$shape == shape, ]
    evaluate(row$formula, values_of(row, 3, 2))
  }
  rows <- data.frame(shape = c("point", "sliding_point"), mass_kg = 2, radius_m = 3)
  expect_identical(
    inertia_table(rows)$moment_of_inertia_kg_m2, c(formula("point"), formula("sliding_point"))
  )
})

test_that("every shape has its constructor, and every constructor its sizes", {
  table <- shapes()
  table <- table[!is.na(table$constructor), ]
  expect_equal(nrow(table), nrow(shapes()) - 1)
  for (i in seq_len(nrow(table))) {
    args <- names(formals(getExportedValue("rotdyn", table$constructor[i])))
    sizes <- sub("^.* = ", "", strsplit(table$sizes[i], ", ")[[1]])
    expect_identical(args[1], "mass_kg")
    expect_true(all(sizes %in% args), label = table$constructor[i])
    density <- c("linear_density_kg_m", "areal_density_kg_m2", "density_kg_m3")[table$dimension[i]]
    expect_identical(intersect(args, density), if (is.na(table$measure_formula[i])) {
      character()
    } else {
      density
    }, label = table$constructor[i])
  }
})

test_that("the help of a family has every shape of it, with its formulas", {
  families <- unique(shapes()$family)
  for (family in families) {
    text <- rotdyn:::describe_shapes(family)
    for (i in which(shapes()$family == family)) {
      expect_match(text, shapes()$shape[i], fixed = TRUE)
      expect_match(text, shapes()$izz_formula[i], fixed = TRUE)
    }
  }
})

test_that("the catalogue's columns are of the dictionary", {
  expect_setequal(setdiff(names(shapes()), column_table()$name), character())
  expect_identical(names(shapes()), rotdyn:::shape_columns)
})

test_that("texts of shapes have the order of the numbers", {
  expect_identical(rotdyn:::shape_words_table$shape, .Call(rotdyn:::ffi_shapes_list)$shape)
})
