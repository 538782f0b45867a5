test_that("the table of bounces, as a user would call it", {
  table <- utils::read.csv(shared("refs/ball_bounce.csv"), colClasses = "character")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], as.numeric)
    ball <- if (r$beta == 0.4) body_sphere(r$m, r$R) else if (r$beta == 0.5) body_disk(r$m, r$R)
    if (is.null(ball)) next
    hit <- ball_bounce(ball, r$vx, r$vy, r$omega, r$e, r$mu)
    size <- abs(r$vx) + r$R * abs(r$omega)
    expect_identical(hit$grips, r$grip == 1)
    expect_equal(hit$vx_m_per_s, r$vx1, tolerance = 1e-14)
    expect_ulps(hit$vy_m_per_s, r$vy1, 1)
    expect_lte(abs(hit$omega_rad_per_s - r$omega1), 4e-15 * size / r$R)
    expect_equal(-hit$normal_loss_j - hit$friction_loss_j, r$dE, tolerance = 1e-14)
  }
})

test_that("a disk strikes a stick on a nail (College Physics 10.5)", {
  # 0.050 kg at 30 m/s sticks to a rod of 2 kg and 1.2 m, 0.1 m from the nail: CP10-23 to CP10-25.
  hit <- hinged_hit(body_rod(2, 1.2), 0.6, 0.1, 0.05, 30)
  expect_equal(hit$omega_rad_per_s, 0.1561686622, tolerance = 1e-9)
  expect_equal(hit$particle_v_m_per_s, 0.01561686622, tolerance = 1e-9)
  kinetic <- 0.5 * 0.96 * hit$omega_rad_per_s^2 + 0.5 * 0.05 * hit$particle_v_m_per_s^2
  expect_equal(kinetic, 0.01171264966, tolerance = 1e-9)
  expect_equal(0.5 * 0.05 * 900 - kinetic, hit$normal_loss_j, tolerance = 1e-12)
  expect_equal(2 * 0.6 * hit$omega_rad_per_s + 0.05 * hit$particle_v_m_per_s, 0.1881832379,
    tolerance = 1e-9)
  # UP11-32: a bullet of 2 g and 500 m/s in the rim of a disk.
  bullet <- hinged_hit(body_disk(3.2, 0.5), 0, 0.5, 0.002, 500)
  expect_equal(bullet$omega_rad_per_s, 1.248439451, tolerance = 1e-9)
})

test_that("the centre of percussion", {
  expect_equal(centre_of_percussion(body_rod(2, 1.2), 0.6), 0.8, tolerance = 1e-15)
  # Young and Freedman: a bat of 0.8 kg, 0.6 m from the handle, 0.053 kg m^2 about its centre.
  bat <- body_disk(0.8, sqrt(2 * 0.053 / 0.8))
  expect_equal(centre_of_percussion(bat, 0.6), 0.7104166667, tolerance = 1e-9)
  expect_identical(centre_of_percussion(bat, 0), Inf)
  hit <- hinged_hit(bat, 0.6, centre_of_percussion(bat, 0.6), 0.1, 10, 0.5)
  expect_lte(abs(hit$hinge_impulse_n_s), 1e-15 * hit$impulse_n_s)
})

test_that("arguments are columns; bad ones name the row", {
  ball <- body_sphere(1, 0.1)
  hit <- ball_bounce(ball, c(1, NA, 2), -1, 0, 0.5, 0.1)
  expect_identical(nrow(hit), 3L)
  expect_true(is.na(hit$vx_m_per_s[2]) && is.na(hit$grips[2]))
  expect_setequal(setdiff(names(hit), rotdyn_columns()$name), character())
  expect_error(ball_bounce(ball, 1, -1, restitution = c(0.5, 1.1)), "row 2",
    class = "rotdyn_error_value")
  expect_error(ball_bounce(ball, 1, -1, restitution = -0.1), class = "rotdyn_error_value")
  expect_error(ball_bounce(ball, 1, -1, friction = -1), class = "rotdyn_error_value")
  expect_error(ball_bounce(ball, Inf, -1), class = "rotdyn_error_value")
  expect_error(ball_bounce(ball, 1:2, -(1:3)), class = "rotdyn_error_size")
  expect_error(ball_bounce(ball, "fast", -1), class = "rotdyn_error_type")
  expect_error(ball_bounce(ball, 1), class = "rotdyn_error_missing")
  expect_error(hinged_hit(ball, 1, 1, 0, 1), class = "rotdyn_error_value")
  expect_error(hinged_hit(ball, -1, 1, 1, 1), class = "rotdyn_error_value")
  expect_error(ball_bounce(ball, 1, -1, mu = 1), class = "rotdyn_error_argument")
  expect_error(centre_of_percussion(2, 1), class = "rotdyn_error_type")
})
