designs <- data.frame(
  name = c("light", "heavy", "oily", "back"),
  moment_of_inertia_kg_m2 = c(0.05, 0.2, 0.05, 0.0625),
  viscous_n_m_s = c(0.03, 0.03, 0.3, 0),
  torque_scale = c(1, 2, 0.5, -1),
  omega0_rad_per_s = c(0, -3, 10, 0),
  theta0_rad = c(0, 1, -2, 0)
)

one <- function(row, torque, time_s, resistance = rotdyn::resistance(row$viscous_n_m_s)) {
  scene <- scene_axle(
    row$moment_of_inertia_kg_m2, row$torque_scale * torque, resistance, row$theta0_rad,
    row$omega0_rad_per_s
  )
  trajectory(scene, time_s)
}

test_that("each row is the trajectory of its scene", {
  table <- spin_up_table(designs, article_torque(), time_s = c(8, 5, 3, 8))
  expect_equal(names(table), c(names(designs), rotdyn:::spin_up_table_columns))
  expect_equal(table$name, designs$name)
  for (i in seq_len(4)) {
    end <- c(8, 5, 3, 8)[i]
    fine <- one(designs[i, ], article_torque(), seq(0, end, length.out = 20001))
    expect_equal(table$final_theta_rad[i], fine$theta_rad[20001], tolerance = 1e-14)
    expect_equal(table$final_omega_rad_per_s[i], fine$omega_rad_per_s[20001], tolerance = 1e-14)
    # The true maximum is above any row, by no more than the spacing allows.
    expect_gte(table$max_omega_rad_per_s[i], max(fine$omega_rad_per_s) * (1 - 1e-15))
    expect_equal(table$max_omega_rad_per_s[i], max(fine$omega_rad_per_s), tolerance = 1e-6)
    expect_equal(table$min_omega_rad_per_s[i], min(fine$omega_rad_per_s), tolerance = 1e-6)
    expect_equal(table$max_omega_time_s[i], fine$time_s[which.max(fine$omega_rad_per_s)],
      tolerance = 1e-3)
  }
  expect_equal(table$max_abs_omega_rad_per_s,
    pmax(table$max_omega_rad_per_s, -table$min_omega_rad_per_s))
  expect_true(all(table$error < 1e-13))
})

test_that("the maximum is where the torque balances the resistance", {
  # In the article's last piece: 0.4 (6 - t) = 0.03 omega at the maximum.
  table <- spin_up_table(data.frame(moment_of_inertia_kg_m2 = 0.0625, viscous_n_m_s = 0.03),
    article_torque(), time_s = 8)
  expect_equal(0.4 * (6 - table$max_omega_time_s), 0.03 * table$max_omega_rad_per_s,
    tolerance = 1e-12)
})

test_that("any number of threads gives the same bits", {
  many <- designs[rep(1:4, 5000), ]
  many$viscous_n_m_s <- seq(0, 1, length.out = nrow(many))
  expect_identical(
    spin_up_table(many, article_torque(), 8),
    spin_up_table(many, article_torque(), 8, threads = 2)
  )
  many$coulomb_n_m <- 0.01
  steps <- torque_steps(c(0, 3), c(1, -0.2))
  expect_identical(
    spin_up_table(many, steps, 8), spin_up_table(many, steps, 8, threads = 2)
  )
})

test_that("friction and drag row by row", {
  designs$quadratic_n_m_s2 <- c(0, 0.01, 0.002, 0.1)
  designs$coulomb_n_m <- c(0.1, 0, 0.02, 0.3)
  steps <- torque_steps(c(0, 3), c(1, 0))
  table <- spin_up_table(designs, steps, time_s = 6)
  for (i in seq_len(4)) {
    row <- designs[i, ]
    losses <- resistance(row$viscous_n_m_s, row$quadratic_n_m_s2, row$coulomb_n_m)
    motion <- one(row, steps, c(0, 3, 6), losses)
    expect_equal(table$final_theta_rad[i], motion$theta_rad[3], tolerance = 1e-14)
    expect_equal(table$final_omega_rad_per_s[i], motion$omega_rad_per_s[3], tolerance = 1e-14)
    expect_equal(table$max_abs_omega_rad_per_s[i], max(abs(motion$omega_rad_per_s)),
      tolerance = 1e-14)
  }
  fine <- one(designs[2, ], steps, seq(0, 6, length.out = 6001), resistance(0.03, 0.01))
  expect_equal(table$max_omega_rad_per_s[2], max(fine$omega_rad_per_s), tolerance = 1e-9)
  expect_equal(table$min_omega_rad_per_s[2], min(fine$omega_rad_per_s), tolerance = 1e-9)
})

test_that("a motor resists as it should, also scaled", {
  rows <- data.frame(moment_of_inertia_kg_m2 = 0.1, torque_scale = c(1, 3))
  table <- spin_up_table(rows, torque_motor(2, 100), 0.7)
  # I w' = s ts (1 - w/wn)
  expect_equal(table$final_omega_rad_per_s, 100 * -expm1(-c(1, 3) * 2 * 0.7 / (0.1 * 100)),
    tolerance = 1e-14)
})

test_that("NA rows are NA, and the others what they were", {
  holes <- designs
  holes$viscous_n_m_s[2] <- NA
  holes$moment_of_inertia_kg_m2[3] <- NA
  whole <- spin_up_table(designs, article_torque(), 8)
  table <- spin_up_table(holes, article_torque(), 8)
  columns <- rotdyn:::spin_up_table_columns
  expect_identical(table[c(1, 4), columns], whole[c(1, 4), columns])
  expect_true(all(is.na(unlist(table[2:3, rotdyn:::spin_up_table_columns]))))
  expect_true(is.na(spin_up_table(designs, article_torque(), c(8, NA, 8, 8))$error[2]))
})

test_that("wrong rows and laws are refused with the row", {
  bad <- function(...) spin_up_table(transform(designs, ...), article_torque(), 8)
  expect_error(bad(moment_of_inertia_kg_m2 = 0), class = "rotdyn_error_value")
  expect_error(bad(moment_of_inertia_kg_m2 = c(1, 2, -1, 1)), "row 3", class = "rotdyn_error_value")
  expect_error(bad(coulomb_n_m = -1), class = "rotdyn_error_value")
  expect_error(bad(coulomb_n_m = 1, static_n_m = 0.5), class = "rotdyn_error_value")
  expect_error(bad(viscous_n_m_s = "a"), class = "rotdyn_error_type")
  expect_error(spin_up_table(designs["name"], 1, 8), class = "rotdyn_error_type")
  expect_error(spin_up_table(designs, 1), class = "rotdyn_error_missing")
  expect_error(spin_up_table(designs, 1, -1), class = "rotdyn_error_time")
  expect_error(spin_up_table(designs, 1, c(1, 2)), class = "rotdyn_error_size")
  expect_error(spin_up_table(1:3, 1, 8), class = "rotdyn_error_type")
  expect_error(spin_up_table(designs, function(t) t, 8), class = "rotdyn_error_model")
  expect_error(spin_up_table(designs, torque_sinusoid(1, 1), 8), class = "rotdyn_error_model")
  expect_error(spin_up_table(designs, 1, 8, threads = 0), class = "rotdyn_error_value")
  expect_equal(nrow(spin_up_table(designs[0, ], 1, 8)), 0L)
  expect_warning(
    table <- spin_up_table(data.frame(moment_of_inertia_kg_m2 = c(1e-300, 1)), 1e300, 8),
    class = "rotdyn_warning_range"
  )
  expect_equal(table$final_omega_rad_per_s[1], NaN)
})

test_that("a row with something missing does not change the others", {
  rows <- data.frame(
    moment_of_inertia_kg_m2 = c(1, 1), coulomb_n_m = c(0, NA), quadratic_n_m_s2 = c(0, NA),
    viscous_n_m_s = c(0.1, NA)
  )
  law <- torque_knots(c(0, 1, 2), c(0, 1, 0))
  got <- spin_up_table(rows, law, time_s = 3)
  expect_equal(got[1, -(1:4)], spin_up_table(rows[1, ], law, time_s = 3)[, -(1:4)])
  expect_true(is.finite(got$max_omega_rad_per_s[1]))
  expect_true(all(is.na(got[2, rotdyn:::spin_up_table_columns])))
})

test_that("odd data frames are told what is wrong with them", {
  rows <- data.frame(moment_of_inertia_kg_m2 = c(1, 2, 4))
  fails <- function(rows, kind, ...) {
    expect_error(spin_up_table(rows, 1, 3, ...), class = paste0("rotdyn_error_", kind))
  }
  twice <- cbind(rows, rows)
  fails(twice, "value")
  wide <- rows
  wide$viscous_n_m_s <- matrix(1, 3, 2)
  fails(wide, "size")
  # The drag kernel takes no negative viscous coefficient.
  fails(cbind(rows, viscous_n_m_s = c(-1, 1, 1), quadratic_n_m_s2 = 0.1), "model")
  expect_equal(spin_up_table(rows, 1, 3, threads = 1e9), spin_up_table(rows, 1, 3))
})

test_that("a warning names several rows", {
  rows <- data.frame(
    moment_of_inertia_kg_m2 = rep(1e-300, 3), omega0_rad_per_s = c(1e300, 0, 1e300)
  )
  rows$viscous_n_m_s <- -1
  expect_warning(
    spin_up_table(rows, NULL, 3), "Rows 1 and 3 are NaN",
    class = "rotdyn_warning_range"
  )
})

test_that("a child forked after threads were used does not wait for them", {
  skip_on_os("windows")
  rows <- data.frame(moment_of_inertia_kg_m2 = rep(1, 2e5))
  run <- function(...) {
    spin_up_table(rows, torque_constant(1), time_s = 1, threads = 2)$final_omega_rad_per_s[1]
  }
  expect_equal(run(), 1)
  child <- parallel::mcparallel(run())
  done <- parallel::mccollect(child, wait = FALSE, timeout = 60)
  if (is.null(done)) tools::pskill(child$pid, 9)
  expect_equal(done[[1]], 1)
})

test_that("a number of threads that no machine has is refused", {
  sweep <- function(threads) {
    .Call(rotdyn:::ffi_axle_sweep, "axle_linear", scene_axle(1), list(), threads, NULL)
  }
  for (threads in c(-1, 4097, NaN)) expect_error(sweep(threads), "internal: `threads`")
})

test_that("the extremes on the way are told where the model has them, and else left out", {
  rows <- data.frame(moment_of_inertia_kg_m2 = 2, omega0_rad_per_s = c(0, 1))
  # It swings: the closed form knows the rows alone.
  swings <- spin_up_table(rows, torque_spring(4), time_s = 3)
  expect_equal(swings$final_omega_rad_per_s, c(0, cos(3 * sqrt(2))))
  for (name in c("max_omega_rad_per_s", "min_omega_rad_per_s", "max_abs_omega_rad_per_s")) {
    expect_true(all(is.na(swings[[name]])))
  }
  # A curve of two points is a motor: omega goes to 10 rad/s as exp(-0.2 t/2).
  bands <- spin_up_table(rows, torque_curve(c(0, 5, 10), c(2, 1, 0)), time_s = 3)
  want <- 10 - (10 - c(0, 1)) * exp(-0.3)
  expect_equal(bands$final_omega_rad_per_s, want)
  expect_equal(bands$max_omega_rad_per_s, want)
  expect_equal(bands$min_omega_rad_per_s, c(0, 1))
  drag <- spin_up_table(
    cbind(rows, quadratic_n_m_s2 = 0.5), torque_constant(2), time_s = 3
  )
  # omega' = 1 - omega^2/4: 2 tanh(t/2).
  expect_equal(drag$max_omega_rad_per_s[1], 2 * tanh(1.5))
})

test_that("a table without columns is named as such", {
  expect_error(
    spin_up_table(data.frame(), torque_constant(1), time_s = 1), "It has no columns",
    class = "rotdyn_error_type"
  )
})
