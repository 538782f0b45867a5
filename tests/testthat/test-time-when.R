# Passage times at 40 digits (mpmath): (K(m) - F(asin(sin(theta/2)/k), m))/w0 of a pendulum let go
# at theta0, I = 0.7, m g d = 3.1; the zeros of exp(-g t)(cos w t + g/w sin w t), or of two
# exponentials, of an oscillator with I = 2, k = 8 that starts at 1 rad.
passed <- data.frame(
  theta0 = c(1e-09, 1e-09, 1e-09, 0.3, 0.3, 0.3, 2.0, 2.0, 2.0, 2.0, 3.1, 3.1, 3.1, 3.1415926535,
    3.1415926535, 3.1415926535, rep(3.141592653589793, 4)),
  theta = c(5e-10, 0.0, -9.9e-10, 0.1, 0.0, -0.25, 1.9, 0.5, 0.0, -1.0, 3.0, 1.0, 0.0, 3.0, 0.0,
    -3.0, 3.0, 0.5, 0.0, -3.141),
  time_s = c(
    0.4976188131305461599, 0.74642821969581923985, 1.4255981607160028821, 0.5885310836915528836,
    0.75064865630372532483, 1.2209961747203345666, 0.22205426150947400754, 0.84861755428743612293,
    0.99193178418883617726, 1.2930271916223065802, 0.90118863262250310371, 2.2511905852225431366,
    2.4994122405251946499, 10.393507921550375214, 11.980967701225770797, 13.56842748090116638,
    16.81105547990398104, 18.278460348617001827, 18.398515259579376623, 22.588366573614193917
  )
)
damped <- data.frame(
  viscous = c(rep(c(0.0, 1e-09, 0.01, 0.5, 3.0, 7.0, 7.9), each = 3), 8.0, 8.000000000000002, 9.0,
    40.0, 10000.0),
  omega0 = c(rep(0, 21), -17.0, -17.000000000000004, -18.5, -65.0, -15005.0),
  nth = c(rep(c(1, 2, 6), 7), 1, 1, 1, 1, 1),
  time_s = c(
    0.78539816339744830962, 2.3561944901923449288, 8.6393797973719314058, 0.78539816345994830962,
    2.3561944902548449289, 8.6393797974344314058, 0.78602377764152499879, 2.3568213316224900354,
    8.6400115475463501818, 0.81826828832497917251, 2.3921415942230446832, 8.6876348178153067259,
    1.0545527359833271389, 2.7490018039559434117, 9.5267980758464085028, 2.7226888500691766428,
    5.9673117908480661603, 18.945803553963624231, 9.4636863363240856859, 19.429466478763534332,
    59.292587048521328919, 0.066666666666666666667, 0.066666666666666653026,
    0.061621198165962234791, 0.018377902236554281323, 0.000081059701455315153394
  )
)
pendulum <- function(...) {
  scene_axle(0.7, torque_gravity(1, 3.1, gravity_m_per_s2 = 1), ...)
}
oscillator <- function(c, ...) scene_axle(2, torque_spring(8), resistance(c), theta0_rad = 1, ...)

test_that("a pendulum of any amplitude passes an angle on time", {
  for (i in seq_len(nrow(passed))) {
    row <- passed[i, ]
    got <- time_when(pendulum(theta0_rad = row$theta0), theta_rad = row$theta)
    expect_lte(abs(got$time_s / row$time_s - 1), 1e-14)
    expect_equal(got$direction, "down")
  }
})

test_that("an oscillator of any damping passes its rest angle on time", {
  for (i in seq_len(nrow(damped))) {
    row <- damped[i, ]
    scene <- oscillator(row$viscous, omega0_rad_per_s = row$omega0)
    got <- time_when(scene, theta_rad = 0, occurrence = "all", until_s = 1.001 * row$time_s)
    expect_lte(abs(got$time_s[row$nth] / row$time_s - 1), 1e-14)
    expect_equal(nrow(got), row$nth)
  }
})

test_that("turning points, and the amplitude that is only touched", {
  scene <- pendulum(theta0_rad = 2)
  cycle <- period_of(scene)$period_s
  turns <- time_when(scene, omega_rad_per_s = 0, occurrence = "all", until_s = 2.2 * cycle)
  expect_equal(turns$time_s, (0:4) / 2 * cycle, tolerance = 1e-15)
  expect_equal(turns$theta_rad, 2 * (-1)^(0:4), tolerance = 1e-14)
  tops <- time_when(scene, theta_rad = 2, occurrence = "all", until_s = 2.2 * cycle)
  expect_equal(tops$time_s, (0:2) * cycle, tolerance = 1e-15)
  expect_true(is.na(time_when(scene, theta_rad = 2.001)$time_s))
})

test_that("the spin-up: its rows do not matter", {
  # mpmath: 1 + I/c log((tau/c - omega(1))/(tau/c - 10)).
  few <- time_when(spin_up(time_s = 0:8), omega_rad_per_s = 10, occurrence = "all")
  expect_equal(few$time_s[1], 1.4991359674257020701, tolerance = 1e-14)
  expect_equal(few$direction, c("up", "down"))
  expect_equal(few, time_when(spin_up(), omega_rad_per_s = 10, occurrence = "all"),
    tolerance = 1e-12)
  expect_equal(nrow(time_when(spin_up(time_s = 0:1), omega_rad_per_s = 10, occurrence = "all")), 0)
})

test_that("integrated motions, bodies on a shaft, units, rest", {
  # The same motion by an integrator.
  law <- scene_axle(0.7, function(t, theta, omega) -3.1 * sin(theta), theta0_rad = 2)
  got <- time_when(trajectory(law, c(0, 3), accuracy = 1e-10), theta_rad = -1)
  expect_equal(got$time_s, 1.2930271916223065802, tolerance = 1e-9)
  shaft <- scene_rotors(c(1, 1), 50, omega0_rad_per_s = c(2, 0))
  # omega_2 = 1 - cos(10 t)
  got <- time_when(shaft, omega_rad_per_s = 1, rotor = 2, occurrence = "all", until_s = 1)
  expect_equal(got$time_s, pi / 20 * c(1, 3, 5), tolerance = 1e-14)
  wheel <- scene_axle(2, resistance = resistance(coulomb_n_m = 0.5), omega0_rad_per_s = 10)
  expect_equal(time_when(wheel, omega_rad_per_s = 0)$time_s, 40, tolerance = 1e-15)
  expect_equal(time_when(wheel, omega_rad_per_s = 0)$direction, "reached")
  skip_if_not_installed("units")
  expect_equal(time_when(scene_axle(2, 1),
    omega_rad_per_s = units::set_units(30 / pi, "rpm"))$time_s, 2,
    tolerance = 1e-14)
})

test_that("errors", {
  scene <- oscillator(0)
  expect_error(time_when(3, theta_rad = 1), class = "rotdyn_error_type")
  expect_error(time_when(scene), class = "rotdyn_error_type")
  expect_error(time_when(scene, 3), class = "rotdyn_error_type")
  expect_error(time_when(scene, theta_rad = 0, omega_rad_per_s = 0), class = "rotdyn_error_type")
  expect_error(time_when(scene, theta = 0), class = "rotdyn_error_value")
  expect_error(time_when(scene, time_s = 0), class = "rotdyn_error_value")
  expect_error(time_when(scene, theta_rad = NA_real_), class = "rotdyn_error_value")
  expect_error(time_when(scene, theta_rad = 0, occurrence = "all"), class = "rotdyn_error_type")
  expect_error(time_when(scene, theta_rad = 3, until_s = 1e9), class = "rotdyn_error_time")
  expect_error(time_when(spin_up(), theta_rad = 3, until_s = 1e9), class = "rotdyn_error_type")
  expect_error(time_when(scene_rotors(c(1, 1), 1), theta_rad = 3), class = "rotdyn_error_type")
  expect_error(time_when(scene_rotors(c(1, 1), 1), rotor = 1, 3), class = "rotdyn_error_type")
  expect_error(time_when(scene_rotors(c(1, 1), 1), theta_rad = 3, rotor = 3),
    class = "rotdyn_error_value")
  expect_error(time_when(scene_rotors(c(1, 1), 1), theta_rad = 3, rotor = 1.5), "whole number",
    class = "rotdyn_error_value")
})

test_that("passages of a shaft that swings fast, and drifts", {
  # omega_2 = 1 - cos(50 t): 1 is passed twice in each cycle.
  shaft <- scene_rotors(c(1, 1), 1250, omega0_rad_per_s = c(2, 0))
  got <- time_when(shaft, omega_rad_per_s = 1, rotor = 2, occurrence = "all", until_s = 10)
  expect_equal(got$time_s, (2 * (1:159) - 1) * pi / 100, tolerance = 1e-14)
  drive <- scene_drive(c(1, 1), coupling_shaft(1250), omega0_rad_per_s = c(2, 0))
  got <- time_when(drive, omega_rad_per_s = 1, rotor = 2, occurrence = "all", until_s = 10)
  expect_equal(got$time_s, (2 * (1:159) - 1) * pi / 100, tolerance = 1e-14)
  expect_no_warning(first <- time_when(shaft, omega_rad_per_s = 1, rotor = 2))
  expect_equal(first$time_s, pi / 100, tolerance = 1e-14)
  # omega_2 = t - sin(50 t)/50: far more than 1000 cycles until it is 150.
  driven <- scene_rotors(c(1, 1), 1250, torque = c(2, 0))
  t <- 150
  for (i in 1:60) t <- t - (t - sin(50 * t) / 50 - 150) / (1 - cos(50 * t) + 0.1)
  expect_equal(time_when(driven, omega_rad_per_s = 150, rotor = 2)$time_s, t, tolerance = 1e-12)
  # Behind a gear the same spring swings faster: k (1/J1 + N^2/J2).
  geared <- scene_drive(
    c(1, 1), coupling_shaft(100, ratio = 7), omega0_rad_per_s = c(7, -1)
  )
  swing <- sqrt(100 * 50)
  # The mean motion is that of J1 + J2/49 at the first; twist rate 7 - 7 (-1) = 14 at the start.
  got <- time_when(geared, coupling_torque_n_m = 0, rotor = 1, occurrence = "all", until_s = 20)
  expect_equal(got$time_s, (0:floor(20 * swing / pi)) * pi / swing, tolerance = 1e-12)
})

test_that("a motion that fades within the least of times", {
  # 1e-310 kg m^2: it stands after some 1e-310 s.
  scene <- scene_axle(1e-310, torque_constant(1), resistance(0.1, 0.1, 0.1, 0.1))
  late <- time_when(scene, theta_rad = 1, until_s = 1)$time_s
  # Then omega is where 1 = 0.1 (1 + w + w^2).
  expect_equal(late, 1 / ((sqrt(37) - 1) / 2), tolerance = 1e-12)
})

test_that("a passage long after the first swings is found where a torque begins", {
  late <- scene_axle(
    1, torque_spring(1) + torque_steps(c(0, 3000), c(0, 5)), theta0_rad = 0.1
  )
  found <- time_when(late, theta_rad = 8)$time_s
  expect_gt(found, 3000)
  # 5 (1 - cos s) + 0.1 cos(3000 + s) = 8
  s <- found - 3000
  expect_equal(5 * (1 - cos(s)) + 0.1 * cos(found), 8, tolerance = 1e-9)
})

test_that("the value at which geared rotors come to rest is reached once, when they do", {
  # One wheel in the end: J = sum J_i/N_i^2, stopped by torque and friction of both.
  inertia <- c(0.4, 0.027)
  ratio <- 0.326
  drive <- scene_drive(
    inertia, coupling_gear(ratio), torque = list(0.46, -0.5),
    resistance = list(resistance(coulomb_n_m = 0.48), resistance(coulomb_n_m = 0.6)),
    theta0_rad = -2.52, omega0_rad_per_s = 3.7
  )
  whole <- inertia[1] + inertia[2] / ratio^2
  slows <- (0.48 - 0.46 + (0.6 + 0.5) / ratio) / whole
  stop_s <- 3.7 / slows
  rest <- -2.52 + 3.7^2 / (2 * slows)
  # Within rounding the value lies on either side of the rest.
  for (off in c(-4, -2, 0, 2, 4) * .Machine$double.eps) {
    value <- rest * (1 + off) / ratio
    got <- time_when(drive, theta_rad = value, rotor = 2, occurrence = "all", until_s = 9)
    expect_equal(got$time_s, stop_s, tolerance = 1e-7)
    first <- time_when(drive, theta_rad = value, rotor = 2)
    expect_equal(first$time_s, stop_s, tolerance = 1e-7)
  }
})

test_that("a terminal speed is reached once, within rounding", {
  for (seed in 1:8) {
    set.seed(seed)
    c <- runif(1, 0.5, 2)
    torque <- runif(1, 1, 3)
    inertia <- runif(1, 0.03, 0.1)
    wheel <- scene_axle(inertia, torque, resistance(c), omega0_rad_per_s = runif(1, -5, 0))
    end <- trajectory(wheel, 9)$omega_rad_per_s
    got <- time_when(wheel, omega_rad_per_s = end, occurrence = "all", until_s = 9)
    expect_equal(nrow(got), 1)
    # exp(-c t/J) is below the rounding.
    expect_gt(got$time_s, 30 * inertia / c)
  }
})
