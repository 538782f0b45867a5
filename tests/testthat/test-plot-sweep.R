skip_if_not_installed("ggplot2")

wheel <- scene_axle(
  0.0625, resistance = resistance(4e-4, 2e-5, 0.01), omega0_rad_per_s = 20
)
swept <- function(design, ..., time_s = 60) sweep_run(sweep_plan(wheel, time_s, design, ...))
many <- swept(
  design_random(5000, seed = 1, omega0_rad_per_s = vary_normal(20, 1)), keep = "summary"
)
grid <- swept(design_grid(body = seq(0.02, 0.1, by = 0.01), omega0_rad_per_s = 5:20))
few <- swept(design_grid(body = seq(0.02, 0.1, by = 0.01), omega0_rad_per_s = c(5, 10)))
split_up <- swept(design_saltelli(
  256, seed = 1, omega0_rad_per_s = vary_normal(20, 1),
  "resistance$coulomb_n_m" = vary_lognormal(0.01, 1.2)
), outputs = c("final_theta_rad", "error"))

draws <- function(plot) {
  for (size in c(13, 24)) {
    expect_silent(ggplot2::ggplotGrob(plot + plot_theme(size)))
  }
  expect_gt(nchar(plot$labels$alt), 20)
}

test_that("a histogram has all rows, with median and 90 %", {
  plot <- ggplot2::autoplot(many)
  draws(plot)
  bars <- ggplot2::layer_data(plot, 1)
  expect_equal(as.double(tapply(bars$y, bars$PANEL, sum)), c(100, 100))
  one <- bars[bars$PANEL == 1, ]
  expect_equal(diff(range(one$xmax - one$xmin)), 0, tolerance = 1e-9)
  lines <- ggplot2::layer_data(plot, 2)
  expect_equal(
    sort(lines$xintercept[lines$PANEL == 1]),
    quantile(many, c(0.05, 0.5, 0.95))$value[1:3]
  )
  expect_match(plot$labels$title, "5,000 rows of a body on a fixed axle")
})

test_that("bins from sums are those of the rows", {
  design <- design_random(5000, seed = 1, omega0_rad_per_s = vary_normal(20, 1))
  rows <- swept(design)$final_theta_rad
  bars <- ggplot2::layer_data(ggplot2::autoplot(many, panels = "final_theta_rad"), 1)
  true <- 100 * vapply(seq_len(nrow(bars)), function(i) {
    mean(rows >= bars$xmin[i] & rows < bars$xmax[i])
  }, double(1))
  # A bucket has 2^-8 of its value, about a quarter of a bin.
  expect_lt(max(abs(bars$y - true)), 1.5)
})

test_that("counts at a point and in an interval fall into their bins", {
  expect_equal(counts_in_bins(c(0, 1, 2), c(0, 1, 2), c(1, 2, 3), 0:2), c(1, 5))
  expect_equal(counts_in_bins(0, 4, 8, c(0, 1, 3)), c(2, 4))
  expect_equal(counts_in_bins(-1, 1, 2, c(-1, 0, 1)), c(1, 1))
})

test_that("counts of events have bins of whole numbers, equal values one bar", {
  counted <- swept(
    design_grid(omega0_rad_per_s = c(1, 20, 30)), time_s = 30, outputs = c("n_stick", "start_s")[1]
  )
  bars <- ggplot2::layer_data(ggplot2::autoplot(counted, kind = "histogram"), 1)
  expect_equal(bars$x, 0:1)
  expect_equal(sum(bars$y), 100)
  same <- swept(design_random(10, seed = 1, theta0_rad = vary_normal(0, 1)),
                outputs = "final_omega_rad_per_s")
  expect_equal(sum(ggplot2::layer_data(ggplot2::autoplot(same), 1)$y), 100)
})

test_that("rows that are narrower than a bucket are binned themselves", {
  narrow <- swept(design_random(500, seed = 1, theta0_rad = vary_normal(1e4, 1)),
                  outputs = "final_theta_rad")
  bars <- ggplot2::layer_data(ggplot2::autoplot(narrow), 1)
  expect_gt(sum(bars$y > 0), 10)
  expect_equal(sum(bars$y), 100)
})

test_that("infinite times are said, and are no bars", {
  design <- design_random(1000, seed = 1, "resistance$coulomb_n_m" = vary_uniform(0, 0.05))
  stops <- swept(design, outputs = "stop_time_s")
  plot <- ggplot2::autoplot(stops, kind = "histogram")
  draws(plot)
  share <- 100 * mean(is.infinite(stops$stop_time_s))
  expect_gt(share, 1)
  expect_equal(sum(ggplot2::layer_data(plot, 1)$y), 100 - share)
  expect_match(gsub("\n", " ", plot$labels$subtitle), paste(
    "stop time infinite in", format(share, digits = 2), "% of the rows"
  ))
})

test_that("a grid of two inputs is a map, its values those of the rows", {
  plot <- ggplot2::autoplot(grid)
  draws(plot)
  expect_equal(plot$data$value, grid$final_theta_rad)
  expect_equal(plot$labels$x, "omega0 (rad/s)")
  expect_equal(plot$labels$y, "body (kg m^2)")
  expect_s3_class(plot$layers[[1]]$geom, "GeomRaster")
  later <- grid
  later$many <- later$row %% 3
  later$many[2] <- NaN
  plot <- ggplot2::autoplot(later, panels = "many", x = c("body", "omega0_rad_per_s"))
  expect_equal(levels(plot$data$value), c("0", "1", "2"))
  expect_match(plot$labels$subtitle, "Grey: 1 rows")
  expect_equal(sum(ggplot2::layer_data(plot, 1)$fill == "grey75"), 1)
  draws(plot)
})

test_that("tiles that are not even have their own sizes, logarithmic ones are even", {
  uneven <- swept(design_grid(body = c(0.02, 0.03, 0.1), omega0_rad_per_s = 1:9))
  tiles <- ggplot2::layer_data(ggplot2::autoplot(uneven, kind = "map"), 1)
  expect_equal(sort(unique(round(tiles$ymax - tiles$ymin, 9))), c(0.01, 0.04, 0.07))
  expect_true(map_axis(10^(-3:2))$even && map_axis(10^(-3:2))$log)
  expect_false(map_axis(1:5)$log)
})

test_that("a third input of a map has panels, more rows for a tile are refused", {
  three <- swept(design_grid(
    body = seq(0.02, 0.1, by = 0.01), omega0_rad_per_s = 5:20, theta0_rad = c(0, 1)
  ))
  plot <- ggplot2::autoplot(three, kind = "map")
  draws(plot)
  expect_equal(nlevels(plot$data$panel), 2)
  expect_error(
    ggplot2::autoplot(three, kind = "map", x = c("body", "omega0_rad_per_s")),
    class = "rotdyn_error_value"
  )
})

test_that("lines are coloured by a second input of few values", {
  plot <- ggplot2::autoplot(few)
  draws(plot)
  expect_equal(levels(plot$data$key), c("5", "10"))
  expect_equal(nrow(plot$data), 2 * nrow(few))
  one <- plot$data[plot$data$panel == "final theta (rad)" & plot$data$key == "5", ]
  expect_equal(one$p50, few$final_theta_rad[few$omega0_rad_per_s == 5])
})

test_that("several rows of a place are bands of their quantiles", {
  plot <- ggplot2::autoplot(grid, kind = "lines", x = "body", panels = "final_theta_rad")
  draws(plot)
  some <- grid$final_theta_rad[grid$body == 0.02]
  got <- unlist(plot$data[plot$data$across == 0.02, c("p5", "p25", "p50", "p75", "p95")])
  expect_equal(
    unname(got), quantile(some, c(0.05, 0.25, 0.5, 0.75, 0.95), type = 1, names = FALSE)
  )
  drawn <- swept(design_random(
    1000, seed = 1, omega0_rad_per_s = vary_normal(20, 1), body = vary_uniform(0.05, 0.1)
  ))
  plot <- ggplot2::autoplot(drawn, kind = "lines", x = "body", panels = "final_theta_rad")
  expect_equal(nrow(plot$data), 20)
  draws(plot)
})

test_that("indices are those of sweep_indices(), with two standard errors", {
  plot <- ggplot2::autoplot(split_up, panels = "final_theta_rad")
  draws(plot)
  indices <- sweep_indices(split_up)
  indices <- indices[indices$output == "final_theta_rad", ]
  bars <- ggplot2::layer_data(plot, 1)
  expect_setequal(round(bars$xmax, 8), round(100 * c(indices$first, indices$total), 8))
  lines <- ggplot2::layer_data(plot, 2)
  expect_setequal(
    round(lines$xmax - lines$xmin, 8),
    round(400 * c(indices$first_error, indices$total_error), 8)
  )
  expect_match(plot$labels$alt, "resistance coulomb")
})

test_that("labels of paths have places and units", {
  plan <- attr(grid, "sweep")$plan
  expect_identical(sweep_label("bodies[2]$mass_kg", plan), "bodies[2] mass (kg)")
  expect_identical(sweep_label("pivot_m[3]", plan), "pivot [3] (m)")
  expect_identical(sweep_label("axis[1]", plan), "axis [1]")
  expect_identical(sweep_label("body", plan), "body (kg m^2)")
})

test_that("what cannot be drawn is refused by class", {
  expect_error(ggplot2::autoplot(many, kind = "lines"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(many, kind = "map"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(many, kind = "indices"), class = "rotdyn_error_argument")
  expect_error(ggplot2::autoplot(many, kind = "fan"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(many, x = "body"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(many, panels = "speed"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(split_up, x = "body"), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(grid, panels = names(grid)[4:5]), class = "rotdyn_error_value")
  expect_error(
    ggplot2::autoplot(grid, kind = "lines", x = c("body", "omega0_rad_per_s")),
    class = "rotdyn_error_value"
  )
  expect_error(ggplot2::autoplot(grid, kind = "lines", x = 1), class = "rotdyn_error_type")
  expect_error(ggplot2::autoplot(grid, colour = "body"), class = "rotdyn_error_argument")
  attr(grid, "sweep") <- NULL
  expect_error(ggplot2::autoplot(grid), class = "rotdyn_error_type")
})

test_that("a sweep of a function, and one with rows that failed", {
  build <- function(row) scene_axle(row$inertia_kg_m2, 1)
  made <- sweep_run(sweep_plan(
    build = build, time_s = 1, design = design_grid(inertia_kg_m2 = c(1, -1, 2, 3))
  ))
  plot <- ggplot2::autoplot(made)
  draws(plot)
  expect_match(plot$labels$title, "scenes of a function")
  expect_match(plot$labels$subtitle, "25 % of the rows not computed")
  expect_equal(plot$labels$x, "inertia (kg m^2)")
})

test_that("the head of the print says how many rows there are, and how many are kept", {
  expect_output(print(grid), "# A rotdyn sweep: 144 x 7, all kept of 144 rows", fixed = TRUE)
  expect_output(print(many), "# A rotdyn sweep: 0 x 6, 0 kept of 5,000 rows", fixed = TRUE)
})

test_that("laws with units are those of SI", {
  skip_if_not_installed("units")
  rpm <- units::set_units(c(60, 120), "rpm", mode = "standard")
  plain <- swept(design_grid(omega0_rad_per_s = c(2, 4) * pi))
  expect_equal(swept(design_grid(omega0_rad_per_s = rpm))$final_theta_rad, plain$final_theta_rad)
  metres <- units::set_units(1, "m")
  expect_error(swept(design_grid(body = metres)), class = "rotdyn_error_unit")
  expect_error(
    sweep_plan(wheel, 1, design_grid(a = metres), derive = list(body = ~a)),
    class = "rotdyn_error_unit"
  )
})

test_that("a sweep without numbers says why", {
  wheel <- scene_axle(0.1, resistance = resistance(coulomb_n_m = 0.01, static_n_m = 0.02),
                      omega0_rad_per_s = 3)
  plan <- sweep_plan(wheel, 5, design_list(data.frame(
    "resistance$static_n_m" = c(0.02, 0.005, 0.006), check.names = FALSE
  )))
  plan$design <- design_list(data.frame(
    "resistance$static_n_m" = c(0.001, 0.005, 0.006), check.names = FALSE
  ))
  expect_error(ggplot2::autoplot(sweep_run(plan)), "value 3", class = "rotdyn_error_value")
})

test_that("nearly equal rows have the few others beside them", {
  rows <- data.frame(omega0_rad_per_s = c(rep(20, 200), 5, 40))
  bars <- ggplot2::layer_data(ggplot2::autoplot(
    swept(design_list(rows), time_s = 1, outputs = "final_omega_rad_per_s", keep = "summary")
  ), 1)
  expect_lt(min(bars$xmin[bars$y > 0]), 6)
  expect_gt(max(bars$xmax[bars$y > 0]), 38)
  expect_equal(sum(bars$y), 100)
})
