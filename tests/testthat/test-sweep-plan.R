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

test_that("rows, seeds and conditions beyond 2^31 are those of the design", {
  plan <- sweep_plan(wheel, 400, design_random(2^52, seed = 2^53,
    omega0_rad_per_s = vary_normal(20, 1)), keep = ~ omega0_rad_per_s > 21)
  expect_identical(n_chunks(plan) <= 65536, TRUE)
  first <- 2^51 + 1
  found <- chunk_of_sweep(plan, first, 2^16, call = environment())
  rows <- rows_table(plan, found)
  design <- design_rows(plan$design, first, 2^16)
  wanted <- design[design$omega0_rad_per_s > 21, ]
  expect_gt(nrow(rows), 5000)
  expect_identical(rows$row, wanted$row)
  expect_identical(rows$omega0_rad_per_s, wanted$omega0_rad_per_s)
  for (row in c(2^31, 2^31 + 1, 2^52)) {
    expect_identical(
      sweep_scene(plan, row)$omega0_rad_per_s, design_rows(plan$design, row, 1)$omega0_rad_per_s
    )
  }
  # With all digits.
  expect_error(sweep_scene(plan, 2^52 + 1), "4503599627370496.*4503599627370497",
               class = "rotdyn_error_value")
  expect_error(sweep_plan(wheel, 400, plan$design, chunk_rows = 2^16), "4294967296",
               class = "rotdyn_error_value")
})

test_that("a chunk beyond row 2^31 is committed and read", {
  skip_if_not_installed("nanoparquet")
  skip_if_not_installed("yyjsonr")
  plan <- sweep_plan(
    wheel, 400, design_latin(2^35, seed = 1, omega0_rad_per_s = vary_normal(20, 1)),
    chunk_rows = 2^16, keep = ~ omega0_rad_per_s > 23
  )
  folder <- tempfile("sweep-")
  on.exit(unlink(folder, recursive = TRUE))
  sweep_create(plan, folder)
  chunk <- 2^19 - 1
  sweep_chunk(folder, chunk)
  first <- (chunk - 1) * 2^16 + 1
  part <- nanoparquet::read_parquet(file.path(folder, "rows", part_name(chunk)))
  design <- design_rows(plan$design, first, 2^16)
  expect_identical(part$row, design$row[design$omega0_rad_per_s > 23])
  expect_identical(sweep_status(folder)$rows_done, 2^16)
  expect_identical(look_at_part(plan_of(folder, FALSE, NULL), folder, chunk)$kept,
                   as.double(nrow(part)))
})

test_that("numbers that are none are refused in times, lists, laws and accuracies", {
  one <- rows_of("body$mass_kg" = 1:2)
  for (bad in c(NaN, NA, Inf, -Inf)) {
    refused("time", wheel, bad, one)
    refused("time", wheel, c(1, bad), one)
    if (is.na(bad)) expect_error(rows_of(a = c(1, bad)), class = "rotdyn_error_value")
    expect_error(vary_normal(bad, 1), class = "rotdyn_error")
    expect_error(vary_normal(1, bad), class = "rotdyn_error")
    expect_error(vary_uniform(0, bad), class = "rotdyn_error")
    expect_error(vary_lognormal(1, bad), class = "rotdyn_error")
    expect_error(vary_triangular(0, bad, 2), class = "rotdyn_error")
    expect_error(vary_values(c(1, bad)), class = "rotdyn_error")
    expect_error(vary_values(1:2, c(1, bad)), class = "rotdyn_error")
    expect_error(design_random(bad, a = vary_uniform(0, 1), seed = 1), class = "rotdyn_error")
    expect_error(design_random(2, a = vary_uniform(0, 1), seed = bad), class = "rotdyn_error")
    refused("value", wheel, 4, one, accuracy = as.double(bad))
    refused("value", wheel, 4, one, chunk_rows = as.double(bad))
    refused("value", wheel, 4, one, audit_rows = as.double(bad))
  }
  # Infinite ones of a list, where the input takes none.
  refused("value", wheel, 4, rows_of(omega0_rad_per_s = c(1, Inf)), message = "50 %.*Leave")
  refused("value", wheel, 4, rows_of(time_s = c(1, -Inf)), message = "any finite number")
  refused("value", wheel, 4, design_grid(time_s = c(1, Inf)), message = "50 %")
  refused("value", wheel, 4, message = "Cut it off",
          design_random(9, time_s = vary_lognormal(1e300, 1e9), seed = 1))
})

test_that("one row, one output, an output twice, no column", {
  one <- sweep_run(sweep_plan(wheel, 4, design_latin(1, seed = 1, omega0_rad_per_s =
    vary_uniform(1, 2)), outputs = c("stop_time_s", "stop_time_s")))
  expect_named(one, c("row", "omega0_rad_per_s", "stop_time_s", "error", "status"))
  expect_identical(nrow(summary(one)), 1L)
  expect_identical(summary(one)$infinite, 1)
  expect_error(design_list(data.frame(row.names = 1:3)), class = "rotdyn_error_size")
  expect_error(design_list(data.frame(a = double())), class = "rotdyn_error_size")
  expect_error(sweep_plan(wheel, 4, list()), class = "rotdyn_error_type")
  refused("type", wheel, 4, rows_of("body$mass_kg" = 1), character())
  refused("type", wheel, 4, rows_of("body$mass_kg" = 1), NA_character_)
  # An input that is kept as it is, -0 with its sign.
  zero <- sweep_run(sweep_plan(wheel, 4, rows_of(theta0_rad = c(-0, 0), omega0_rad_per_s = 0)))
  expect_identical(1 / zero$theta0_rad, c(-Inf, Inf))
})

test_that("no input takes the name of another column of the rows", {
  for (name in c("error", "status", "final_theta_rad")) {
    design <- design_list(stats::setNames(data.frame(1:3), name))
    derive <- list(omega0_rad_per_s = stats::as.formula(paste("~", name)))
    refused("argument", wheel, 4, design, derive = derive, message = name)
  }
  refused("argument", wheel, 4, rows_of(a = 1:3), message = "row",
          derive = list(row = ~ a, omega0_rad_per_s = ~ row))
})

test_that("what is kept is named in the error: near names, and what it may be", {
  one <- rows_of("body$mass_kg" = 1:2)
  refused("value", wheel, 4, one, keep = ~ final_tehta_rad > 1, message = "final_theta_rad")
  refused("value", wheel, 4, one, keep = ~ rwo > 1, message = "no\\s+input or\\s+output")
  refused("type", wheel, 4, one, keep = 3, message = "formula")
  refused("type", wheel, 4, one, keep = NULL)
  refused("value", wheel, 4, one, keep = "all")
  refused("value", wheel, 4, one, keep = final_theta_rad ~ 1)
})

test_that("a function with free variables is refused before it is called", {
  called <- FALSE
  build <- function(row) {
    called <<- TRUE
    scene_axle(row$m * stiffness + damping)
  }
  refused("value", NULL, 1, rows_of(m = 1:2), build = build, given = list(called = FALSE),
          message = "stiffness.*damping")
  expect_false(called)
  # The first rows are refused by the constructor: others show what comes out.
  some <- sweep_run(sweep_plan(NULL, 3, rows_of(m = c(-1, 0, 1, 2)),
                               build = function(row) scene_axle(row$m, 0.2)))
  expect_identical(some$status, c("value", "value", "ok", "ok"))
})

test_that("blocks are small where rows are integrated", {
  design <- design_grid(omega0_rad_per_s = vary_values(1:4))
  hoop <- scene_hoop(1, 1, 5, theta0_rad = 1)
  expect_identical(sweep_plan(hoop, 1, design)$block_rows, 2^8)
  wheel <- scene_axle(1, 1)
  expect_identical(sweep_plan(wheel, 1, design, model = "axle_linear")$block_rows, 2^16)
})

test_that("a function of a row calls those of packages by their names, and its own", {
  plan <- sweep_plan(
    time_s = 1, design = design_grid(k = c(4, 9)),
    build = function(row) rotdyn::scene_axle(1, theta0_rad = (function(y) base::sqrt(y))(row$k))
  )
  expect_identical(sweep_run(plan)$final_theta_rad, c(2, 3))
})

test_that("the scenes of a function are of one kind", {
  plan <- function() {
    sweep_plan(time_s = 1, design = design_grid(k = 1:2), build = function(row) {
      if (row$k > 1) scene_free(1:3 / 1, c(1, 0, 0)) else scene_axle(1)
    })
  }
  expect_error(plan(), "of row 2", class = "rotdyn_error_type")
})

test_that("without a number of rows a chunk is about ten seconds of work", {
  rows <- function(row_s, keep = "rows", n = 1e6) {
    check_chunk_rows(NULL, list(keep = keep, row_s = row_s, block_rows = 256, n = n))
  }
  # 10 s / 1e-4 s = 1e5 rows, between 2^16 and 2^17: nearer to the second.
  expect_identical(rows(1e-4), 2^17)
  expect_identical(rows(1e-2), 2^10)
  expect_identical(rows(1), 256)
  expect_identical(rows(1e-9), 2^22)
  expect_identical(rows(1e-9, "summary"), 2^26)
  expect_identical(rows(1, n = 1e12), 2^24)
})
