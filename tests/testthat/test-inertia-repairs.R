test_that("a lost decimal point is the one repair", {
  for (izz in c(0.213, 2.13, 21.3, 213, 2130)) {
    check <- check_inertia(six(0.0123, 0.0145, izz))
    repairs <- inertia_repairs(check)
    smallest <- repairs[repairs$size == min(repairs$size), ]
    expect_equal(at(check, "triangle inequality")$verdict, "fails")
    expect_equal(smallest$entry, "izz")
    expect_equal(smallest$from, izz)
    expect_equal(smallest$to, 0.0213, tolerance = 1e-14)
    expect_equal(smallest$kind, "decimal point")
    expect_match(at(check, "triangle inequality")$suggestion, "^izz = 0.0213 instead of")
  }
  # RealMan RX75 C3, Link1 (github.com/RealManRobot/rm_models, issue 6): izz was 1676.359e-6.
  link <- six(2661.9e-6, 2302.5e-6, 1676359e-6, -31.029e-6, 9.34e-6, 151.466e-6)
  repairs <- inertia_repairs(check_inertia(link, mass_kg = 1.559))
  expect_equal(repairs$entry[1], "izz")
  expect_equal(repairs$to[1], 1676.359e-6, tolerance = 1e-14)
  expect_equal(sum(repairs$size == repairs$size[1]), 1L)
})

test_that("equally small repairs are alternatives, and what is known rules some out", {
  # iyy 100.11 (osrf/gazebo_models, issue 33): itself, or its neighbour in the same error.
  arm <- six(1.11, 100.11, 1.01)
  repairs <- inertia_repairs(check_inertia(arm))
  expect_setequal(repairs$entry[repairs$size == 3], c("iyy", "izz"))
  expect_match(
    at(check_inertia(arm), "triangle inequality")$suggestion, "which is right is unknown"
  )
  repairs <- inertia_repairs(check_inertia(arm, mass_kg = 1, size_m = 2))
  expect_equal(repairs$entry[repairs$size == min(repairs$size)], "iyy")
  expect_equal(repairs$to[1], 1.0011)
})

test_that("other slips are found", {
  smallest <- function(...) {
    repairs <- inertia_repairs(check_inertia(...))
    repairs[repairs$size == min(repairs$size), ]
  }
  # A plate, rounded to two digits.
  found <- smallest(six(0.0012, 0.0023, 0.0036))
  expect_true(all(found$kind == "last digit"))
  expect_equal(found$to[found$entry == "izz"], 0.0035)
  # The sign of a moment.
  found <- smallest(six(2, -1.5, 2.5))
  expect_equal(as.data.frame(found[c("kind", "entry", "to")]), data.frame(
    kind = "sign of a moment", entry = "iyy", to = 1.5
  ))
  # The sign of the products: one of them and all three have the same eigenvalues.
  found <- smallest(six(1.15, 1.53, 1.9, 0.52, 0.25, 0.34))
  expect_equal(sum(found$kind == "sign of a product"), 3L)
  expect_equal(found$to[found$kind == "sign convention of the products"], -c(0.52, 0.25, 0.34))
  # In the user's own numbers when those are of the other convention.
  found <- smallest(six(1.15, 1.53, 1.9, -0.52, -0.25, -0.34), products = "positive")
  expect_equal(found$to[found$kind == "sign convention of the products"], c(0.52, 0.25, 0.34))
  # iyy and ixy in each other's place.
  found <- inertia_repairs(check_inertia(six(0.3, 0.01, 0.35, 0.29, 0.02, 0.01)))
  swapped <- found[found$kind == "entries swapped", ]
  expect_true(any(swapped$entry == "iyy" & swapped$to == 0.29))
  # A product that is a copy of a moment.
  found <- smallest(six(1, 1.2, 1.1, 1))
  expect_true(any(found$kind == "repetition of a moment" & found$entry == "ixy" & found$to == 0))
  # Units.
  found <- smallest(1e6 * c(0.02, 0.03, 0.04), mass_kg = 2, size_m = 0.25)
  expect_equal(unique(found$kind), "unit (kg mm^2)")
  expect_equal(found$to, c(0.02, 0.03, 0.04))
  found <- smallest(c(0.02, 0.03, 0.04), mass_kg = 2, size_m = 250)
  expect_equal(as.data.frame(found[c("kind", "entry", "to")]), data.frame(
    kind = "unit (mm)", entry = "size_m", to = 0.25
  ))
  expect_true(holds(check_inertia(c(0.02, 0.03, 0.04), mass_kg = 2, size_m = 250)))
  # One half of a matrix.
  upper <- matrix(c(2, 0, 0, 0.2, 3, 0, 0.1, 0.3, 4), 3)
  expect_equal(smallest(upper)$to, c(0.2, 0.1, 0.3))
  expect_equal(smallest(t(upper))$to, c(0.2, 0.1, 0.3))
  # Two readings of one pair.
  found <- smallest(matrix(c(2, 0.1, 0, -0.1, 3, 0, 0, 0, 4), 3))
  expect_setequal(found$to, c(-0.1, 0.1))
  expect_equal(unique(found$kind), "sign of a product")
  # Nothing small explains these.
  expect_equal(nrow(inertia_repairs(check_inertia(six(1, 13, 10, -3, -3, -6)))), 0L)
  expect_equal(nrow(inertia_repairs(check_inertia(c(1, 1, 1), mass_kg = 0))), 0L)
})

test_that("a body that is there passes, and each slip of its point is listed", {
  set.seed(20)
  passed <- 0L
  broken <- listed <- alone <- 0L
  for (b in 1:300) {
    # From one point and two (a rod) to three (a plate) and many.
    tensor <- random_tensor(if (b <= 60) 1 + (b - 1) %/% 20 else 5 + b %% 40)
    passed <- passed + holds(check_inertia(tensor))
    if (b <= 60) next
    tensor <- signif(tensor, 6)
    entry <- 1 + b %% 3
    slip <- tensor
    slip[entry] <- slip[entry] * (if (b %% 2) 10 else 100)
    check <- check_inertia(slip)
    if (!holds(check)) {
      found <- inertia_repairs(check)
      true <- found$entry == names(slip)[entry] & abs(found$to / tensor[entry] - 1) < 1e-9
      broken <- broken + 1L
      listed <- listed + any(true)
      alone <- alone + (sum(found$size == min(found$size)) == 1L && true[1])
    }
  }
  expect_equal(passed, 300L)
  expect_gt(broken, 200L)
  expect_equal(listed, broken)
  # The help says 88 % of slips of every kind.
  expect_gt(alone / broken, 0.8)
})

test_that("a repair in the eleventh digit shows both numbers", {
  error <- expect_error(body_tensor(1, c(1, 1, 2 + 1e-11)), class = "rotdyn_error_inertia")
  expect_match(gsub("\\s+", " ", conditionMessage(error)), "izz = 2 instead of 2[.]00000000001")
})
