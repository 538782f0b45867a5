test_that("values are described in words", {
  describe <- rotdyn:::describe_value
  expect_equal(describe(NULL), "NULL")
  expect_equal(describe("a"), "\"a\"")
  expect_equal(describe(c(1, 2)), "a double vector of length 2")
  expect_equal(describe(factor("a")), "a <factor> object of length 1")
  expect_equal(describe(list(1)), "a list of length 1")
  expect_equal(describe(sum), "a function")
  expect_equal(describe(NA_character_), "NA")
  long <- strrep("word ", 1e5)
  expect_equal(describe(long), paste0("\"", strrep("word ", 12), "\" ... (500000 bytes)"))
  expect_lt(nchar(describe(strrep("\xff", 1e5))), 300)
  error <- expect_error(body_disk(long, 1), class = "rotdyn_error_type")
  expect_lt(nchar(conditionMessage(error)), 500)
})

test_that("one number is one finite number", {
  for (bad in list(NA_real_, NaN, Inf, -Inf)) {
    expect_error(body_disk(bad, 1), class = "rotdyn_error_value")
  }
  for (bad in list("1", NULL, TRUE, factor(1), list(1), NA)) {
    expect_error(body_disk(bad, 1), class = "rotdyn_error")
  }
  expect_error(body_disk(numeric(), 1), class = "rotdyn_error_size")
  expect_equal(body_disk(2L, 1L), body_disk(2, 1))
})

test_that("output times: empty, one, repeated; not missing, infinite or backwards", {
  scene <- article_scene()
  expect_equal(nrow(trajectory(scene, numeric())), 0)
  expect_equal(nrow(trajectory(scene, 3)), 1)
  twice <- trajectory(scene, c(1, 2, 2, 3))
  expect_equal(twice$theta_rad[2], twice$theta_rad[3])
  for (bad in list(c(2, 1), c(0, NA), c(0, Inf), NaN)) {
    expect_error(trajectory(scene, bad), class = "rotdyn_error_time")
  }
  expect_error(trajectory(article_scene(start_s = -1.7e308), 1.7e308), class = "rotdyn_error_time")
  expect_error(trajectory(scene, "now"), class = "rotdyn_error_type")
  expect_error(trajectory(scene, NULL), class = "rotdyn_error_type")
})

test_that("arguments behind the dots must be named in full", {
  expect_error(trajectory(article_scene(), 1, 1e-9, NULL, "abort"))
  expect_error(torque_knots(0:1, 0:1, "hold"))
})

test_that("an argument that was left out is named", {
  for (left_out in expression(
    body_disk(2), trajectory(), trajectory(article_scene()), torque_knots(1:2), scene_axle(),
    energy_partition(1), rolling_acceleration(), choose_model(), torque_function(),
    predict(spin_up(time_s = 1))
  )) {
    error <- expect_error(eval(left_out), class = "rotdyn_error_missing")
    expect_match(conditionMessage(error), "is missing")
  }
  # One that is unknown is what was meant by it.
  error <- expect_error(work_precision(article_scene(), times = 9), class = "rotdyn_error_argument")
  expect_match(conditionMessage(error), "1 unknown argument.*Unknown: `times = 9`.*`time_s`")
})

test_that("arrays are plain numbers", {
  expect_no_warning(earth <- foucault_pendulum(array(1, 1), array(45, 1), 10))
  expect_identical(earth, foucault_pendulum(1, 45, 10))
  expect_null(dim(rotdyn:::check_column(matrix(1:4 / 2, 2), "x", "m", NULL)))
})

test_that("letters are made small alike in every locale", {
  mixed <- c("IXX", "Stl", NA, "\u0130")
  expect_identical(rotdyn:::lower_case(mixed), c("ixx", "stl", NA, "\u0130"))
  old <- Sys.getlocale("LC_CTYPE")
  on.exit(suppressWarnings(Sys.setlocale("LC_CTYPE", old)))
  # Where this locale is not installed the present one stays.
  suppressWarnings(Sys.setlocale("LC_CTYPE", "tr_TR.UTF-8"))
  expect_identical(rotdyn:::lower_case("IXX"), "ixx")
  named <- c(IXX = 1, IYY = 1, IZZ = 1, IXY = 0, IXZ = 0, IYZ = 0)
  expect_false("fails" %in% check_inertia(named)$verdict)
})

test_that("an infinite number is said to be infinite", {
  e <- expect_error(body_disk(2, Inf), class = "rotdyn_error_value")
  expect_match(conditionMessage(e), "finite")
  expect_no_match(conditionMessage(e), "at least")
  expect_match(conditionMessage(expect_error(body_disk(2, -Inf))), "at least 0 m")
  expect_match(conditionMessage(expect_error(body_disk(2, -1))), "at least 0 m")
})

test_that("a vector where one number is needed points to the table of bodies", {
  e <- expect_error(body_disk(c(1, 2), 0.1), class = "rotdyn_error_size")
  expect_match(conditionMessage(e), "inertia_table")
  expect_match(conditionMessage(expect_error(body_disk(1, c(0.1, 0.2)))), "inertia_table")
})

test_that("times that go back are told with the first place where they do", {
  e <- expect_error(
    rotdyn:::check_times(c(0, 2, 2, 1.5, 3, 1), NULL), class = "rotdyn_error_time"
  )
  expect_match(conditionMessage(e), "Element 4 is 1.5 after 2")
})

test_that("a name is one plain text", {
  expect_identical(check_name("a", "x", NULL), "a")
  wrong <- list(type = 1, type = structure("a", class = "b"), type = NA_character_, type = NULL,
                type = list("a"), size = c("a", "b"), size = character())
  for (k in seq_along(wrong)) {
    expect_error(
      check_name(wrong[[k]], "x", NULL), class = paste0("rotdyn_error_", names(wrong)[k])
    )
  }
})
