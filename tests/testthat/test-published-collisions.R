# Published answers on impulse, collision and the conservation of angular momentum, as a user would
# ask for them: the inputs of the row in its own units, the answer within its digits.

rpm <- pi / 30
rev_s <- 2 * pi

test_that("OpenStax: bodies that couple", {
  rows <- published("openstax_rotation")
  of <- function(id) inputs_of(rows[[id]])
  x <- of("UP11-30")
  lock <- disks_lock(1, x$ratio, x$rpm * rpm, 0)
  expect_published(lock$common_omega_rad_per_s / rpm, rows[["UP11-30"]])
  energy <- collision_ledger(lock)
  energy <- energy[energy$balance == "energy", ]
  expect_published(energy$dissipated / energy$before, rows[["UP11-31"]])
  x <- of("UP11-42")
  both <- disks_lock(body_cylinder(1, 0.2, 0.1), body_cylinder(1, 0.2, 0.1), x$rpm[1] * rpm,
    x$rpm[2] * rpm)
  expect_published(both$common_omega_rad_per_s / rpm, rows[["UP11-42"]])
})

test_that("OpenStax: collisions with what turns", {
  rows <- published("openstax_rotation")
  of <- function(id) inputs_of(rows[[id]])
  x <- of("UP11-32") # a bullet embeds in the rim of a disk
  bullet <- hinged_hit(body_disk(x$M, x$R), 0, x$R, x$m, x$v)
  expect_published(bullet$omega_rad_per_s, rows[["UP11-32"]])
  # A disk of 50 g and 30 m/s strikes a stick of 2 kg and 1.2 m, nailed at its end.
  x <- of("CP10-23")
  hit <- hinged_hit(body_rod(2, 1.2), 0.6, x$b, 0.05, 30)
  expect_published(hit$omega_rad_per_s, rows[["CP10-23"]])
  ledger <- collision_ledger(hit)
  expect_published(ledger$after[ledger$balance == "energy"], rows[["CP10-24"]])
  expect_published(ledger$after[ledger$balance == "momentum_y"], rows[["CP10-25"]])
  expect_true(all(ledger$verdict == "balanced"))
  # Two skaters lock hands: a free body of two points keeps the angular momentum that they bring.
  x <- of("UP11-38")
  pair <- data.frame(x_m = c(-x$r, x$r), y_m = 0, z_m = 0, mass_kg = x$m)
  of_one <- function(side) {
    angular_momentum_of(x$m, velocity_m_per_s = c(-side * x$v, 0, 0),
      position_m = c(0, side * x$r, 0))[[3]]
  }
  moment <- inertia_tensor(body_points(pair))["z", "z"]
  brought <- of_one(1) + of_one(-1)
  expect_published(brought / moment, rows[["UP11-38"]])
})

test_that("OpenStax: angular impulse", {
  rows <- published("openstax_rotation")
  x <- inputs_of(rows[["CP10-11"]])
  kick <- angular_impulse(torque_pulse(0, x$dt, x$F * x$R), body = body_disk(x$M, x$R))
  expect_published(kick$omega_change_rad_per_s, rows[["CP10-11"]])
})

test_that("OpenStax: bodies that change their shape", {
  rows <- published("openstax_rotation")
  of <- function(id) inputs_of(rows[[id]])
  # The last row of a motion whose moment of inertia changes within a second.
  changed <- function(from, to, omega) {
    scene <- scene_axle(inertia_knots(c(0, 1), c(from, to)), omega0_rad_per_s = omega)
    expect_true(conserved(scene)$conserved[2])
    motion <- trajectory(scene, c(0, 1))
    expect_true(all(audit(motion)$verdict == "balanced"))
    motion
  }
  x <- of("UP11-34") # a bug walks from the rim of a disk to its centre
  disk <- 0.5 * x$M * x$R^2
  bug <- changed(disk + x$m * x$R^2, disk, x$w)
  expect_published(bug$omega_rad_per_s[2], rows[["UP11-34"]])
  expect_published(diff(bug$rotational_kinetic_energy_j), rows[["UP11-35"]])
  x <- of("UP11-39")
  tuck <- changed(1, x$ratio^2, 1 * rev_s)
  expect_published(tuck$omega_rad_per_s[2] / rev_s, rows[["UP11-39"]])
  x <- of("CP10-13")
  skater <- changed(x$I1, x$I2, x$rev_s * rev_s)
  expect_published(skater$omega_rad_per_s[2] / rev_s, rows[["CP10-13"]])
  expect_published(skater$rotational_kinetic_energy_j[2], rows[["CP10-14"]])
})

test_that("the centre of percussion of a bat (Young and Freedman)", {
  row <- published("impulse_center_of_percussion")[["yf_bat"]]
  x <- inputs_of(row)
  # Of the bat the moment about the axis across is known alone.
  bat <- body_tensor(diag(c(x$I, 0.1 * x$I, x$I)), mass_kg = x$m)
  at <- centre_of_percussion(bat, x$d)
  expect_equal(at, as.numeric(row$computed), tolerance = 1e-9)
  # A free bat struck there: its handle stays at rest.
  ball <- body_sphere(0.145, 0.037)
  hit <- collide(
    bat, ball, velocity_1_m_per_s = c(0, 0, 0), velocity_2_m_per_s = c(0, 30, 0),
    normal = c(0, 1, 0), arm_1_m = c(at - x$d, 0, 0), arm_2_m = c(0, 0.037, 0), restitution = 0.5
  )
  handle <- hit$vy_1_m_per_s - x$d * hit$omega_z_1_rad_per_s
  expect_lte(abs(handle), 1e-14 * hit$vy_1_m_per_s)
})
