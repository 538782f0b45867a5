# Moments of m = 2 kg, r or l = 3 m, by hand from the textbook formulas.
test_that("shapes have the moments of the textbook", {
  diagonal <- function(body) unname(diag(body$inertia_kg_m2))
  expect_equal(diagonal(body_disk(2, 3)), c(4.5, 4.5, 9))
  expect_equal(diagonal(body_hoop(2, 3)), c(9, 9, 18))
  expect_equal(diagonal(body_sphere(2, 3)), c(7.2, 7.2, 7.2))
  expect_equal(diagonal(body_spherical_shell(2, 3)), c(12, 12, 12))
  expect_equal(diagonal(body_rod(2, 3)), c(0, 1.5, 1.5))
  expect_identical(body_disk(2, 0.25)$inertia_kg_m2[3, 3], 0.0625)
})

test_that("the tensor is diagonal in the own axes and obeys I1 + I2 >= I3", {
  for (body in list(body_disk(2, 3), body_hoop(2, 3), body_sphere(2, 3), body_rod(2, 3))) {
    tensor <- body$inertia_kg_m2
    expect_equal(unname(tensor), diag(diag(tensor)))
    moments <- sort(diag(tensor))
    expect_gte(moments[1] + moments[2], moments[3] * (1 - 1e-15))
  }
})

test_that("beta is there where a body rolls", {
  expect_identical(body_disk(2, 3)$beta, 0.5)
  expect_identical(body_hoop(2, 3)$beta, 1)
  expect_identical(body_sphere(2, 3)$beta, 0.4)
  expect_identical(body_spherical_shell(2, 3)$beta, 2 / 3)
  expect_identical(body_rod(2, 3)$beta, NA_real_)
})

test_that("moments survive sizes whose square does not", {
  expect_ulps(body_hoop(1e300, 1e-200)$inertia_kg_m2[3, 3], 1e-100, 2)
  expect_ulps(body_hoop(1e-300, 1e200)$inertia_kg_m2[3, 3], 1e100, 2)
})

test_that("an impossible body is an error", {
  expect_error(body_disk(-1, 1), class = "rotdyn_error_value")
  expect_error(body_rod(1, -1), class = "rotdyn_error_value")
  expect_equal(sum(body_disk(0, 1)$inertia_kg_m2), 0)
})
