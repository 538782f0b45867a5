wheel <- scene_axle(
  body_disk(2, 0.25), resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
)
rows_of <- function(...) design_list(data.frame(..., check.names = FALSE))
refused <- function(class, ..., message = NULL) {
  expect_error(sweep_plan(...), message, class = paste0("rotdyn_error_", class))
}

test_that("a path that the scene lacks gets the nearest ones, or what it is derived from", {
  refused("argument", wheel, 400, rows_of("body$mas_kg" = 1:3), message = "body\\$mass_kg")
  refused("argument", wheel, 400, rows_of("radius_m" = 1:3), message = "body\\$radius_m")
  refused("argument", wheel, 400, rows_of(moment_of_inertia_kg_m2 = 1:3),
          message = "derived from.*body\\$mass_kg")
  refused("argument", wheel, 400, rows_of("body$inertia_kg_m2" = 1:3), message = "derived from")
  refused("argument", scene_axle(0.1), 4, rows_of("resistance$coulomb_n_m" = 1:3),
          message = "has no resistance")
  refused("argument", wheel, 400, rows_of("body$mass_kg" = 1:2, body = 1:2),
          message = "takes the place")
})

test_that("a law that leaves the domain of its input is refused with the share outside", {
  refused("value", wheel, 400, message = "2.3 %", design_random(10, seed = 1,
    "body$mass_kg" = vary_normal(2, 1)
  ))
  refused("value", wheel, 400, rows_of("body$mass_kg" = c(-1, 1, 2)), message = "33 %")
  plan <- sweep_plan(wheel, 400, design_random(10, seed = 1,
    "body$mass_kg" = vary_truncated(vary_normal(2, 1), 0.1, 5)
  ))
  expect_s3_class(plan, "rot_sweep_plan")
})

test_that("outputs, times, models, conditions and chunks are checked", {
  one <- rows_of("body$mass_kg" = 1:2)
  refused("argument", wheel, 400, one, "final_theta", message = "final_theta_rad")
  refused("type", wheel, 400, one, 3)
  refused("time", wheel, c(3, 1), one)
  refused("time", wheel, double(), one)
  refused("type", wheel, 400, 3)
  refused("missing", wheel, 400)
  refused("model", wheel, 400, one, model = "axle_linear", message = "None of the rows")
  refused("value", wheel, 400, one, model = "axle_lin")
  refused("value", wheel, 400, one, keep = "x")
  refused("value", wheel, 400, one, keep = ~ system("ls"), message = "system")
  refused("value", wheel, 400, one, chunk_rows = 1000)
  refused("value", wheel, 400, one, chunk_rows = 100000)
  refused("value", wheel, 400, one, accuracy = 0)
  refused("argument", wheel, 400, one, acuracy = 1)
})

test_that("derived inputs are formulas of others", {
  refused("value", wheel, 400, rows_of(density = 1:2), message = "volume",
          derive = list("body$mass_kg" = ~ density * volume))
  refused("argument", wheel, 400, rows_of("body$mass_kg" = 1:2),
          derive = list("body$mass_kg" = ~ 1))
  refused("type", wheel, 400, rows_of("body$mass_kg" = 1:2), derive = ~ 1)
  plan <- sweep_plan(wheel, 400, rows_of(density = c(1, 2), unused = 1), derive = list(
    area = ~ pi * 0.25^2 * unused, "body$mass_kg" = ~ density * area
  ))
  rows <- sweep_run(plan)
  expect_identical(rows[["body$mass_kg"]], c(1, 2) * (pi * 0.25^2))
  direct <- sweep_run(sweep_plan(wheel, 400, rows_of("body$mass_kg" = c(1, 2) * (pi * 0.25^2))))
  expect_identical(rows$final_theta_rad, direct$final_theta_rad)
})

test_that("a function that builds scenes uses nothing but its row and what is given", {
  design <- rows_of(m = 1:2)
  k <- 3
  refused("value", NULL, 1, design, build = function(row) scene_axle(row$m * k), message = "`k`")
  refused("argument", wheel, 1, design, build = function(row) wheel)
  refused("type", NULL, 1, design, build = 3)
  refused("type", NULL, 1, design, build = function(row) scene_axle(1), given = 3)
  expect_s3_class(sweep_plan(NULL, 1, design, given = list(k = k), build = function(row) {
    half <- row$m / 2
    masses <- vapply(1:2, function(i) i * half, 1)
    scene_axle(sum(masses) * k + base::pi)
  }), "rot_sweep_plan")
})

test_that("the model is one for all rows: what acts in any row decides", {
  losses <- rows_of("resistance$coulomb_n_m" = c(0, 0.01), "resistance$quadratic_n_m_s2" = 0)
  plan <- sweep_plan(wheel, 400, losses)
  expect_identical(plan$model, "axle_drag")
  expect_identical(sweep_run(plan)$status, c("ok", "ok"))
})

test_that("the print says what the sweep will take", {
  plan <- sweep_plan(wheel, 400, design_grid("body$mass_kg" = 1:1000, theta0_rad = 1:1000,
                                             omega0_rad_per_s = 1:1000, start_s = 1:1000))
  said <- capture.output(print(plan))
  expect_match(said[1], "1,000,000,000,000 rows, scene_axle, axle_drag")
  expect_true(any(grepl("^  kept +all rows: [0-9.]+ TB$", said)))
  expect_true(all(nchar(said) <= 80))
  expect_error(sweep_run(plan), class = "rotdyn_error_memory")
  expect_identical(prefixed(2.22e-6, "s"), "2.22 us")
  expect_identical(prefixed(999.9, "B"), "1 kB")
  expect_identical(prefixed(0, "B"), "0 B")
  expect_identical(seconds_words(3 * 86400), "3 days")
})

test_that("rows beyond 2^31, seeds beyond it, one row: all are rows", {
  plan <- sweep_plan(wheel, 400, design_random(2^40, seed = 2^52,
    "body$mass_kg" = vary_uniform(1, 2)
  ))
  scene <- sweep_scene(plan, 2^39 + 1)
  expect_identical(
    scene$body$mass_kg, design_rows(plan$design, 2^39 + 1, 1)[["body$mass_kg"]]
  )
  expect_identical(nrow(sweep_run(sweep_plan(wheel, 400, rows_of("body$mass_kg" = 2)))), 1L)
  zero <- sweep_run(sweep_plan(wheel, 400, rows_of("omega0_rad_per_s" = c(-0, 20))))
  expect_identical(zero$final_theta_rad[1], 0)
})
