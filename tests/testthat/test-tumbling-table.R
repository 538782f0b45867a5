draw_bodies <- function(n) {
  r <- matrix(((1:(7 * n)) * 0.6180339887498949) %% 1, n)
  data.frame(
    ixx_kg_m2 = 1 + r[, 1], iyy_kg_m2 = 1 + r[, 2], izz_kg_m2 = 1 + r[, 3],
    omega_x_rad_per_s = r[, 4] - 0.5, omega_y_rad_per_s = r[, 5] - 0.5,
    omega_z_rad_per_s = r[, 6] - 0.5, name = seq_len(n)
  )
}

test_that("each row is the motion of its scene", {
  bodies <- draw_bodies(40)
  times <- 10^(1:40 / 4) * (-1)^(1:40)
  out <- tumbling_table(bodies, times)
  expect_identical(out$name, 1:40)
  for (i in c(1, 17, 40)) {
    row <- bodies[i, ]
    motion <- trajectory(
      scene_free(unlist(row[1:3], use.names = FALSE), unlist(row[4:6], use.names = FALSE)), times[i]
    )
    got <- list(qw = out$final_qw[i], qx = out$final_qx[i], qy = out$final_qy[i],
                qz = out$final_qz[i])
    expect_lt(attitude_difference(got, motion), 2e-15)
    expect_equal(out$final_omega_y_rad_per_s[i], motion$omega_y_rad_per_s, tolerance = 4e-15)
    expect_lt(out$error[i], 2e-14)
  }
  turned <- cbind(bodies, attitude_from(c(0.3, 0.2, -1), "rotation_vector"))
  expect_equal(
    tumbling_table(turned, times)$final_omega_x_rad_per_s, out$final_omega_x_rad_per_s
  )
})

test_that("columns may have units of their own: moments, rates, attitudes", {
  skip_if_not_installed("units")
  bodies <- cbind(draw_bodies(5), attitude_from(c(0.3, 0.2, -1), "rotation_vector"))
  given <- bodies
  as_units <- function(columns, factor, unit) {
    given[columns] <<- lapply(given[columns], function(x) {
      units::set_units(factor * x, unit, mode = "standard")
    })
  }
  as_units(1:3, 1e4, "kg*cm^2")
  as_units(4:6, 60, "rad/min")
  as_units(quaternion_columns, 1, "1")
  expect_equal(
    tumbling_table(given, 3)[tumbling_columns], tumbling_table(bodies, 3)[tumbling_columns]
  )
  given$omega_x_rad_per_s <- units::set_units(1, "kg")
  expect_error(tumbling_table(given, 3), class = "rotdyn_error_unit")
})

test_that("threads change no bit", {
  bodies <- draw_bodies(20000)
  out <- tumbling_table(bodies, 1e4)
  for (threads in c(2, 3, 8)) {
    expect_identical(tumbling_table(bodies, 1e4, threads = threads), out)
  }
  # Nor do the other rows.
  expect_identical(tumbling_table(bodies[777:900, ], 1e4), out[777:900, ])
})

test_that("rows without a motion are NA, bad tables are errors", {
  bodies <- draw_bodies(4)
  bodies$ixx_kg_m2[1] <- NA
  bodies$iyy_kg_m2[2] <- -1
  bodies$omega_x_rad_per_s[3] <- Inf
  out <- tumbling_table(bodies, 1)
  expect_identical(is.na(out$final_qw), c(TRUE, TRUE, TRUE, FALSE))
  expect_identical(is.na(out$error), c(TRUE, TRUE, TRUE, FALSE))
  expect_error(tumbling_table(bodies[-1], 1), class = "rotdyn_error_type")
  expect_error(tumbling_table(bodies, 1:3), class = "rotdyn_error_size")
  expect_error(tumbling_table(1, 1), class = "rotdyn_error_type")
  expect_error(tumbling_table(bodies), class = "rotdyn_error_missing")
  expect_identical(nrow(tumbling_table(bodies[0, ], 1)), 0L)
})

test_that("rates over the whole range turn alike in their own time", {
  bodies <- draw_bodies(40)
  rates <- grep("^omega", names(bodies))
  turned <- function(power) {
    faster <- bodies
    faster[rates] <- bodies[rates] * 2^power
    tumbling_table(faster, 7 / 2^power)
  }
  own <- turned(0)
  for (power in c(-320, -40, 40, 320)) {
    far <- turned(power)
    attitude <- paste0("final_", c("qw", "qx", "qy", "qz"))
    expect_identical(far[attitude], own[attitude])
    expect_identical(far$final_omega_y_rad_per_s, own$final_omega_y_rad_per_s * 2^power)
  }
})

test_that("moments that no body has are computed, up to a ratio of 1e100", {
  rows <- data.frame(
    ixx_kg_m2 = 1, iyy_kg_m2 = 1, izz_kg_m2 = c(2.5, 1e90, 1e100), omega_x_rad_per_s = 1,
    omega_y_rad_per_s = 0, omega_z_rad_per_s = 0
  )
  # A spin about a principal axis stays.
  expect_equal(tumbling_table(rows, 1)$final_omega_x_rad_per_s, c(1, 1, NA))
})
