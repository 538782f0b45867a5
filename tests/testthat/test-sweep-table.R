# Sweeps by batch kernels: which plans, the numbers of the tables that use the same kernels, and of
# the rows without them within both error figures.

wheel <- scene_axle(0.0625, 0.8, resistance(0.03))
design <- design_random(5000, seed = 3, "omega0_rad_per_s" = vary_uniform(-3, 3),
  "resistance$viscous_n_m_s" = vary_uniform(0, 0.05), "theta0_rad" = vary_uniform(0, 1)
)

test_that("a plan names its kernel, and does without it when asked to or where outputs need it", {
  plan <- sweep_plan(wheel, 2, design)
  expect_identical(plan$kind, "table")
  expect_output(print(plan), "table: many rows at a time by a kernel")
  expect_identical(sweep_plan(wheel, 2, design, kernel = FALSE)$kind, "core")
  expect_identical(sweep_plan(wheel, 2, design, outputs = "lost_j")$kind, "core")
  expect_identical(sweep_plan(wheel, c(1, 2), design)$kind, "core")
  expect_error(sweep_plan(wheel, 2, design, kernel = NA), class = "rotdyn_error_type")
  disk <- scene_axle(body_disk(2, 0.25), 0.8, resistance(0.03))
  by_mass <- design_list(data.frame("body$mass_kg" = 2, check.names = FALSE))
  expect_identical(sweep_plan(disk, 2, by_mass)$kind, "core")
  expect_identical(sweep_plan(disk, 2, design)$kind, "table")
})

test_that("rows by a kernel agree with those without it within both error figures", {
  quick <- sweep_run(sweep_plan(wheel, 2, design))
  rows <- sweep_run(sweep_plan(wheel, 2, design, kernel = FALSE))
  allowed <- quick$error + rows$error
  expect_true(all(allowed < 1e-13))
  for (name in c("final_theta_rad", "final_omega_rad_per_s")) {
    off <- abs(quick[[name]] - rows[[name]])
    size <- pmax(abs(rows[[name]]), abs(quick$theta0_rad), abs(quick$omega0_rad_per_s), 1)
    expect_true(all(off <= allowed * size))
    expect_gt(max(off), 0)
  }
  # Row by row as trajectory() has it.
  for (i in c(1, 77, 5000)) {
    motion <- trajectory(sweep_scene(quick, i), c(0, 2))
    expect_equal(quick$final_theta_rad[i], motion$theta_rad[2], tolerance = 1e-14)
  }
})

test_that("the kernels are those of the tables", {
  rows <- sweep_run(sweep_plan(wheel, 2, design))
  table <- spin_up_table(
    data.frame(moment_of_inertia_kg_m2 = 0.0625, omega0_rad_per_s = rows$omega0_rad_per_s,
               theta0_rad = rows$theta0_rad, viscous_n_m_s = rows[["resistance$viscous_n_m_s"]]),
    0.8, 2
  )
  expect_identical(rows$final_theta_rad, table$final_theta_rad)
  expect_identical(rows$error, table$error)
  brick <- scene_free(c(1, 2, 3), c(0.1, 1, 0.2))
  turns <- sweep_run(sweep_plan(brick, 60, design_random(500, seed = 1,
    "body[1]" = vary_uniform(1, 3), "omega0_rad_per_s[2]" = vary_uniform(-1, 1)
  )))
  tumbling <- tumbling_table(
    data.frame(ixx_kg_m2 = turns[["body[1]"]], iyy_kg_m2 = 2, izz_kg_m2 = 3,
               omega_x_rad_per_s = 0.1, omega_y_rad_per_s = turns[["omega0_rad_per_s[2]"]],
               omega_z_rad_per_s = 0.2),
    60
  )
  expect_identical(turns$final_qw, tumbling$final_qw)
  expect_identical(turns$final_omega_z_rad_per_s, tumbling$final_omega_z_rad_per_s)
  # The error of a row covers rates and angular momentum, too.
  expect_true(all(turns$error >= tumbling$error & turns$error < 1e-12))
  slope <- scene_incline(body_sphere(1, 0.1), 20, static_friction = 0.2, omega0_rad_per_s = 10)
  slides <- sweep_run(sweep_plan(slope, 2, design_random(500, seed = 1,
    "static_friction" = vary_uniform(0, 0.3), "v0_m_per_s" = vary_uniform(-1, 1)
  )))
  inclines <- incline_table(
    data.frame(beta = 0.4, radius_m = 0.1, mass_kg = 1, incline_angle_deg = 20,
               static_friction = slides$static_friction, v0_m_per_s = slides$v0_m_per_s,
               omega0_rad_per_s = 10),
    2
  )
  expect_equal(slides$final_x_m, inclines$final_x_m, tolerance = 1e-13)
  expect_equal(slides$final_omega_rad_per_s, inclines$final_omega_rad_per_s, tolerance = 1e-13)
})

test_that("threads and pieces change no bit of a sweep by a kernel", {
  plan <- sweep_plan(wheel, 2, design)
  whole <- rows_of_sweep(plan, 1, 5000, call = environment())
  expect_identical(rows_of_sweep(plan, 1, 5000, threads = 2, call = environment()), whole)
  for (i in c(1, 256, 257, 4999)) {
    one <- rows_of_sweep(plan, i, 1, call = environment())
    expect_identical(one$output, lapply(whole$output, `[`, i))
    expect_identical(one$error, whole$error[i])
  }
})

test_that("a folder keeps the way of its rows", {
  skip_if_not_installed("nanoparquet")
  skip_if_not_installed("yyjsonr")
  plan <- sweep_plan(wheel, 2, design)
  folder <- folder_of()
  kept <- sweep_run(plan, folder)
  expect_identical(sweep_digest(kept), sweep_digest(sweep_run(plan)))
  unlink(file.path(folder, "sums", part_name(1)))
  expect_identical(sweep_digest(sweep_resume(folder)), sweep_digest(kept))
  expect_error(sweep_run(sweep_plan(wheel, 2, design, kernel = FALSE), folder), "kind",
               class = "rotdyn_error_folder")
})

test_that("threads that take whole blocks change no row, no sum and no order", {
  quick <- function(keep, design) {
    sweep_plan(wheel, 2, design, c("final_theta_rad", "error"), keep = keep)
  }
  designs <- list(
    design_random(6 * 2^16 + 7, seed = 3, "omega0_rad_per_s" = vary_uniform(-3, 3)),
    design_saltelli(2^16, seed = 3, "omega0_rad_per_s" = vary_uniform(-3, 3),
                    "body" = vary_uniform(0.05, 0.08))
  )
  for (design in designs) {
    for (keep in list("rows", "summary", ~ final_theta_rad > 22)) {
      plan <- quick(keep, design)
      one <- sweep_run(plan)
      for (threads in 2:3) {
        more <- sweep_run(plan, threads = threads)
        expect_identical(sweep_digest(more), sweep_digest(one))
        expect_identical(as.list(more), as.list(one), ignore_attr = TRUE)
      }
    }
  }
  expect_gt(nrow(one), 0)
  expect_lt(nrow(one), plan$n / 2)
  expect_identical(one$row[one$final_theta_rad <= 22], double())
})

test_that("the error of a short tumble is its rounding, and not much more", {
  short <- sweep_run(sweep_plan(
    scene_free(c(1, 2, 2.5), omega0_rad_per_s = c(1, 0.2, 0.1)), 1e-3,
    design_list(data.frame("omega0_rad_per_s[1]" = 1:3, check.names = FALSE))
  ))
  expect_true(all(short$error > 4 * 2^-52 & short$error < 40 * 2^-52))
})

test_that("the kernel of free bodies keeps its phase over a million radians", {
  rates <- c(0.3, 0.5, 1:6)
  columns <- c("omega_x_rad_per_s", "qw", "qx", "qy", "qz")
  body <- function(rate) scene_free(c(1, 2, 2.9), c(rate, 0.01, 2))
  rows <- sweep_run(sweep_plan(
    body(1), 1e6, design_list(data.frame("omega0_rad_per_s[1]" = rates, check.names = FALSE)),
    outputs = paste0("final_", columns)
  ))
  for (i in seq_along(rates)) {
    alone <- trajectory(body(rates[i]), 1e6)
    expect_within(
      unlist(rows[i, paste0("final_", columns)]) + 10, unlist(alone[columns]) + 10, 1e-15
    )
  }
})
