test_that("the table of bounces, as a user would call it", {
  table <- utils::read.csv(shared("refs/ball_bounce.csv"), colClasses = "character")
  for (i in seq_len(nrow(table))) {
    r <- lapply(table[i, ], as.numeric)
    shape <- if (r$beta == 0.4) body_sphere else if (r$beta == 0.5) body_disk else
      body_spherical_shell
    ball <- shape(r$m, r$R)
    hit <- ball_bounce(ball, r$vx, r$vy, r$omega, r$e, r$mu)
    size <- abs(r$vx) + r$R * abs(r$omega)
    expect_identical(hit$sticks, r$grip == 1)
    expect_equal(hit$vx_m_per_s, r$vx1, tolerance = 1e-14)
    expect_ulps(hit$vy_m_per_s, r$vy1, 1)
    expect_lte(abs(hit$omega_rad_per_s - r$omega1), 4e-15 * size / r$R)
    expect_equal(-hit$normal_loss_j - hit$friction_loss_j, r$dE, tolerance = 1e-14)
    # The same by the collision of a free body with a plane.
    same <- collide(
      ball, velocity_1_m_per_s = c(r$vx, r$vy, 0), omega_1_rad_per_s = c(0, 0, -r$omega),
      normal = c(0, 1, 0), arm_1_m = c(0, -r$R, 0), restitution = r$e, friction = r$mu
    )
    expect_lte(abs(same$vx_1_m_per_s - r$vx1), 1e-15 * size)
    expect_lte(abs(same$vy_1_m_per_s - r$vy1), 1e-15 * abs(r$vy))
    expect_lte(abs(same$omega_z_1_rad_per_s + r$omega1), 4e-15 * size / r$R)
    expect_identical(same$sticks, r$grip == 1)
    expect_true(all(collision_ledger(hit)$verdict == "balanced"))
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

test_that("tangential restitution: the superball, and what friction allows of it", {
  ball <- body_sphere(1, 0.1)
  # Garwin: without spin vx falls to 3/7 and omega becomes 10/7 vx/r; nothing is lost.
  hit <- ball_bounce(ball, 7, -2, 0, 1, Inf, 1)
  expect_equal(hit$vx_m_per_s, 3, tolerance = 1e-15)
  expect_equal(hit$omega_rad_per_s, 100, tolerance = 1e-15)
  expect_identical(hit$friction_loss_j, 0)
  # The second bounce undoes the first: v = 3 - 4/7 (3 - 10), omega = 100 + 4/7 (3 - 10)/0.04.
  again <- ball_bounce(ball, hit$vx_m_per_s, -2, hit$omega_rad_per_s, 1, Inf, 1)
  expect_equal(again$vx_m_per_s, 7, tolerance = 1e-14)
  expect_lte(abs(again$omega_rad_per_s), 1e-13)
  # Friction gives at most 0.5 * 4 N s: enough for 2/7 * 6.3, too little for 1.5 of it.
  slides <- ball_bounce(ball, 6.3, -2, 0, 1, 0.5, c(0, 0.5))
  expect_equal(slides$friction_impulse_n_s, c(-1.8, -2), tolerance = 1e-15)
  expect_identical(slides$sticks, c(TRUE, FALSE))
  expect_error(ball_bounce(ball, 1, -1, tangential_restitution = 1.5), class = "rotdyn_error_value")
})

test_that("a particle that sticks to a hinged rod, and one that bounces", {
  # L is conserved about the hinge: m v d = (I + m d^2) omega, here 0.2 * 5 * 1 = (2/3 + 0.2) omega.
  stick <- hinged_hit(body_rod(2, 1), 0.5, 1, 0.2, 5)
  expect_equal(stick$omega_rad_per_s, 1 / (2 / 3 + 0.2), tolerance = 1e-15)
  expect_equal(stick$particle_v_m_per_s, stick$omega_rad_per_s, tolerance = 1e-15)
  # Pivot reaction J (M a d/I - 1) = J (3/2 - 1).
  expect_equal(stick$hinge_impulse_n_s, stick$impulse_n_s / 2, tolerance = 1e-15)
  elastic <- hinged_hit(body_rod(2, 1), 0.5, 1, 0.2, 5, restitution = 1)
  expect_equal(elastic$omega_rad_per_s, 2 / (2 / 3 + 0.2), tolerance = 1e-15)
  expect_identical(elastic$normal_loss_j, 0)
  late <- hinged_hit(body_rod(2, 1), 0.5, 1, 0.2, 5, omega_rad_per_s = 6)
  expect_identical(late$impulse_n_s, 0)
})

test_that("disks that lock and rims that meet (University Physics 11.3)", {
  rpm <- pi / 30
  # UP11-30, UP11-31: 600 rpm couples to three times the inertia at rest.
  lock <- disks_lock(1, 3, 600 * rpm, 0)
  expect_equal(lock$common_omega_rad_per_s / rpm, 150, tolerance = 1e-14)
  expect_equal(lock$friction_loss_j / (0.5 * (600 * rpm)^2), 0.75, tolerance = 1e-14)
  expect_equal(lock$angular_impulse_n_m_s, -450 * rpm, tolerance = 1e-14)
  # UP11-42: equal cylinders at +600 and -900 rpm.
  both <- disks_lock(2, 2, 600 * rpm, -900 * rpm)
  expect_equal(both$common_omega_rad_per_s / rpm, -150, tolerance = 1e-14)
  # The same as a clutch of infinite capacity.
  clutch <- clutch_engagement(1, 3, Inf, 600 * rpm, 0)
  expect_equal(lock$friction_loss_j, clutch$heat_j, tolerance = 1e-14)
  # Gears: 0.01 and 0.16 kg m^2, radii 0.1 and 0.2 m: slip 6 m/s, J = 6/(1 + 1/4).
  mesh <- rims_meet(body_disk(2, 0.1), body_disk(8, 0.2), 60, 0)
  expect_equal(mesh$impulse_n_s, -4.8, tolerance = 1e-14)
  expect_equal(mesh$omega_1_rad_per_s, 12, tolerance = 1e-14)
  expect_equal(mesh$omega_2_rad_per_s, -6, tolerance = 1e-14)
  ring <- rims_meet(1, 1, 10, 0, radius_1_m = 0.1, radius_2_m = -0.3)
  expect_equal(0.1 * ring$omega_1_rad_per_s, 0.3 * ring$omega_2_rad_per_s, tolerance = 1e-14)
  slips <- rims_meet(
    1, 1, 100, 0, largest_impulse_n_s = c(1, NA), radius_1_m = 0.1, radius_2_m = 0.1
  )
  expect_identical(slips$locked, c(FALSE, NA))
  expect_equal(slips$omega_1_rad_per_s[1], 99.9, tolerance = 1e-14)
  for (hit in list(lock, mesh)) {
    expect_setequal(setdiff(names(hit), column_table()$name), character())
  }
  expect_error(rims_meet(1, 1, 1, 0, radius_1_m = 0, radius_2_m = 0.1),
    class = "rotdyn_error_value")
  expect_error(rims_meet(1, 1, 1, 0, radius_1_m = 0.1, radius_2_m = 0),
    class = "rotdyn_error_value")
  expect_error(rims_meet(1, 1, 1, 0), class = "rotdyn_error_missing")
  expect_error(disks_lock(1, -1, 1, 0), class = "rotdyn_error_value")
  expect_error(disks_lock(1, 1, 1), class = "rotdyn_error_missing")
})

test_that("arguments are columns; bad ones name the row", {
  ball <- body_sphere(1, 0.1)
  hit <- ball_bounce(ball, c(1, NA, 2), -1, 0, 0.5, 0.1)
  expect_identical(nrow(hit), 3L)
  expect_true(is.na(hit$vx_m_per_s[2]) && is.na(hit$sticks[2]))
  expect_setequal(setdiff(names(hit), column_table()$name), character())
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

# m v = (m + M) V; the height V^2/(2 g) of a ballistic pendulum.
test_that("a point mass on a hinge is a ballistic pendulum", {
  hit <- hinged_hit(
    body_point(2), centre_m = 1.5, distance_m = 1.5, particle_mass_kg = 0.01,
    particle_v_m_per_s = 300
  )
  expect_equal(hit$omega_rad_per_s, 0.01 * 300 / 2.01 / 1.5, tolerance = 1e-15)
  expect_equal(hit$particle_v_m_per_s, 0.01 * 300 / 2.01, tolerance = 1e-13)
  expect_equal(hit$hinge_impulse_n_s, 0, tolerance = 1e-15)
  expect_equal(hit$normal_loss_j, 450 - 4.5 / 2.01, tolerance = 1e-14)
  expect_true(all(audit(hit)$verdict == "balanced"))
  expect_equal(centre_of_percussion(body_point(2), 1.5), 1.5)
  # Bodies that name an axle of their own are hinged at centre_m all the same.
  on <- function(body) hinged_hit(body, 0.5, 1, 0.01, 300)$omega_rad_per_s
  expect_equal(on(body_rod_end(1, 1)), on(body_rod(1, 1)), tolerance = 1e-14)
  expect_equal(on(body_rod(1, 1)), 3 / (1 / 3 + 0.01), tolerance = 1e-14)
  expect_equal(on(body_point(1, 0.7)), 3 / (0.25 + 0.01), tolerance = 1e-14)
  expect_error(
    hinged_hit(body_point(1), c(1, 0), 1, 0.01, 300), "row 2", class = "rotdyn_error_value"
  )
})

test_that("rims meet between their axles: what the axles take balances the moment of momentum", {
  for (radius_2 in c(0.2, -0.5)) { # outside, and within a ring
    hit <- rims_meet(
      0.02, 0.05, 30, 10, radius_1_m = 0.3, radius_2_m = radius_2, restitution = 0.4
    )
    ledger <- collision_ledger(hit)
    expect_true(all(ledger$verdict == "balanced"))
  }
})

test_that("energies beyond double precision are Inf, with a warning", {
  ball <- body_sphere(1, 0.1)
  beyond <- function(expr, column) {
    expect_warning(hit <- expr, column, class = "rotdyn_warning_range")
    expect_identical(hit[[column]], Inf)
    expect_true(all(is.finite(unlist(hit[grep("^v|omega|impulse", names(hit))]))))
  }
  beyond(ball_bounce(ball, 0, -1e200, restitution = 0.5), "normal_loss_j")
  beyond(hinged_hit(body_rod(1, 1), 0.5, 1, 1, 1e200), "normal_loss_j")
  beyond(disks_lock(1, 1, 1e200, 0), "friction_loss_j")
  beyond(rims_meet(1, 1, 1e200, 0, radius_1_m = 1, radius_2_m = 1), "friction_loss_j")
  beyond(
    collide(ball, velocity_1_m_per_s = c(0, 0, -1e200), normal = c(0, 0, 1), restitution = 0.5),
    "normal_loss_j"
  )
  expect_no_warning(ball_bounce(ball, 0, -1e150, restitution = 0.5))
})
