# Events and rows of the two drives: exponentials of the matrices of each stretch, torques and
# capacities as components of the state, events by bisection, in 34 digits (mpmath).
geared_drive <- function() {
  scene_drive(
    c(0.1, 2, 2), list(coupling_gear(10), coupling_shaft(1e4, 5)),
    torque = list(torque_sinusoid(5, 12.5, -pi / 2), NULL, NULL),
    resistance = list(NULL, NULL, resistance(0.5, coulomb_n_m = 30, static_n_m = 40))
  )
}

clutch_drive <- function() {
  scene_drive(
    c(0.4, 2),
    coupling_clutch(
      torque_knots(c(0, 0.25, 0.75, 3, 3.5, 6), c(0, 0, 60, 60, 25, 25), outside = "hold"),
      static_ratio = 1.2
    ),
    torque = list(torque_motor(40, 200), torque_knots(c(0, 2, 4, 6), c(0, 0, -60, -60))),
    resistance = list(NULL, resistance(0.1, coulomb_n_m = 5, static_n_m = 6)),
    omega0_rad_per_s = c(100, 0)
  )
}

figures <- function(motion) attr(motion, "run")$info

# Largest difference of a measure, relative to its size.
apart <- function(motion, measure, want) {
  column <- c(theta = "theta_rad", omega = "omega_rad_per_s")[[measure]]
  max(abs(motion[[column]] - want)) / figures(motion)$sizes[[measure]]
}

test_that("a driven geared inertia with an elastic shaft sticks and slips as it must", {
  theta_1 <- c(
    0, 0.30092502400167525731, -0.009030333340384870369, 0.26257916044872790489,
    -0.021738983256737857078, 0.23848200204729225377, -0.033584029037207921898,
    0.21745439352401082838, -0.042944394101025930862
  )
  omega_1 <- c(
    0, 1.6051063037831263496, -1.9662202841983185995, 1.8872159922062640907,
    -1.9927286665148730471, 1.9104818024354837191, -1.9959475731671196893,
    1.9263279455353453054, -1.9970424560371434132
  )
  theta_3 <- c(
    0, 0.027137654438558076897, 0.00029256760738437181854, 0.025320090085771474397,
    -0.001321681708840549864, 0.022940000790965954183, -0.0024943674732208901857,
    0.020765558015440562358, -0.0033332987102930431891
  )
  omega_3 <- c(
    0, 0.090154171287948265129, -0.13441504246188550948, 0.17361014523995315535,
    -0.18916881861981561102, 0.20733551201756176874, -0.21972856201613514042,
    0.23524321568862713127, -0.2480702526980504367
  )
  events <- c(
    0.088071995248678629707, 0.30368587970939837808, 0.35260240116480134082,
    0.56841484560433863694, 0.60777609578413135354, 0.82171616031061812878,
    0.8581717985312616392, 1.0736118136033621733, 1.1108541690759558434, 1.3248879149282604632,
    1.3610613635573950516, 1.5763846333681073079, 1.6134445055372349763, 1.8275817619947780534,
    1.8638020957048985701
  )
  torque_2 <- c(29.900261911546310187, -12.267044344018320307)
  for (model in c("drive_rk8pd", "drive_radau")) {
    for (accuracy in c(1e-6, 1e-9, 1e-12)) {
      motion <- trajectory(geared_drive(), seq(0, 2, by = 0.25), accuracy, model)
      bound <- max(accuracy, 1e-11)
      expect_equal(attr(motion, "run")$model, model)
      expect_lt(apart(motion, "theta", as.vector(rbind(theta_1, theta_1 / 10, theta_3))), bound)
      expect_lt(apart(motion, "omega", as.vector(rbind(omega_1, omega_1 / 10, omega_3))), bound)
      expect_lte(apart(motion, "theta", as.vector(rbind(theta_1, theta_1 / 10, theta_3))),
                 figures(motion)$error)
      happened <- motion_events(motion)
      expect_equal(happened$event, c("slip", rep(c("stick", "slip"), 7)))
      expect_equal(happened$where, rep("rotor 3", 15))
      expect_lt(max(abs(happened$time_s - events)), 10 * bound)
      expect_equal(motion$coupling_torque_n_m[c(5, 8)], torque_2, tolerance = 100 * bound)
      expect_true(all(audit(motion)$verdict == "balanced"))
    }
  }
})

test_that("a clutch between a motor and a load sticks and slips as it must", {
  theta_1 <- c(
    0, 55.002722817309940525, 102.80783483783099435, 129.60646989544624562,
    145.19058106446292287, 162.77055867996127651, 181.29709545825430836, 199.24920917032297306,
    219.38164491078397297, 243.35577226541205585, 270.32181205747231231, 299.61795559868582119,
    330.72878576437749938
  )
  omega_1 <- c(
    100, 113.12363859134502974, 73.596082581084502823, 35.196765052276877192,
    33.115327870225223026, 36.646997334954595488, 36.935346904334633174, 35.742256458472481627,
    44.42603858824198167, 51.188974910927940232, 56.455955014897812, 60.557883244291057561,
    63.752468161445218465
  )
  theta_2 <- c(
    0, 0.089767149167895239912, 3.3655166826891992098, 13.197292271917185587,
    28.350968985668801636, 45.930946601167155274, 64.45748337946018712, 82.348244007533198182,
    97.207867497607806199, 107.06928679617243534, 111.74920919039653956, 111.58182027510398693,
    107.60499386453543702
  )
  omega_2 <- c(
    0, 1.295511642541605238, 13.00672416586554004, 26.265135386404140721,
    33.115327870225223026, 36.646997334954595488, 36.935346904334633174, 33.85921559089654646,
    24.991234416392816059, 14.498163451464584602, 4.264167331753379391, -4.2878628925953405373,
    -11.589021572066913041
  )
  for (model in c("drive_rk8pd", "drive_radau")) {
    for (accuracy in c(1e-6, 1e-9, 1e-12)) {
      motion <- trajectory(clutch_drive(), seq(0, 6, by = 0.5), accuracy, model)
      expect_lt(apart(motion, "theta", as.vector(rbind(theta_1, theta_2))), accuracy)
      expect_lt(apart(motion, "omega", as.vector(rbind(omega_1, omega_2))), accuracy)
      happened <- motion_events(motion)
      expect_equal(happened$event, c("slip", "lock", "slip", "reverse"))
      expect_equal(happened$where, c("rotor 2", "coupling 1", "coupling 1", "rotor 2"))
      expect_equal(
        happened$time_s,
        c(0.3, 1.5969678397703648864, 3.4274956887864074522, 5.2120799340226695119),
        tolerance = 10 * accuracy
      )
      expect_true(all(audit(motion)$verdict == "balanced"))
      # Before and after the locked stretch; at a break the rows are after it.
      expect_equal(motion$locked[seq(1, 26, by = 2)], seq(0, 6, by = 0.5) %in% c(2, 2.5, 3))
    }
  }
})

test_that("constant torques: lock, slip and stick where a hand finds them", {
  # As scene_clutch(2, 3, 12, omega0_rad_per_s = c(10, 0)): 10 rad/s go at 12 (1/2 + 1/3) in 1 s.
  motion <- trajectory(
    scene_drive(c(2, 3), coupling_clutch(12), omega0_rad_per_s = c(10, 0)), c(0, 0.5, 1, 2),
    model = "drive_rk8pd"
  )
  expect_named(motion, columns_of_motion("drive"))
  expect_equal(motion$omega_rad_per_s, c(10, 0, 7, 2, 4, 4, 4, 4), tolerance = 1e-14)
  expect_equal(motion$coupling_heat_j[c(1, 3, 5, 7)], c(0, 45, 60, 60), tolerance = 1e-14)
  expect_equal(motion$coupling_torque_n_m, c(12, NA, 12, NA, 12, NA, 0, NA), tolerance = 1e-14)
  expect_equal(motion_events(motion)$time_s, 1, tolerance = 1e-14)
  # Locked, 3/5 of the ramp 30 (t - 2) reaches 1.25 * 12 at 2 + 5/6.
  ramp <- scene_drive(
    c(2, 3), coupling_clutch(12, static_ratio = 1.25),
    torque = list(torque_knots(c(0, 2, 4), c(0, 0, 60), outside = "hold"), NULL),
    omega0_rad_per_s = c(10, 0)
  )
  happened <- motion_events(trajectory(ramp, 0:6))
  expect_equal(happened$event, c("lock", "slip"))
  expect_equal(happened$time_s, c(1, 2 + 5 / 6), tolerance = 1e-14)
  # A brake of 3 N m from 1 to 4 s on 2 kg m^2 under 1 N m: 2.5 rad/s at 1 s, at rest 2.5 s later.
  braked <- trajectory(
    scene_drive(2, brake = brake(3, from_s = 1, to_s = 4), torque = 1, omega0_rad_per_s = 2),
    0:6, model = "drive_rk8pd"
  )
  expect_equal(braked$omega_rad_per_s, c(2, 2.5, 1.5, 0.5, 0, 0.5, 1), tolerance = 1e-14)
  expect_equal(braked$heat_j, c(0, 0, 6, 9, 9.375, 9.375, 9.375), tolerance = 1e-14)
  expect_equal(motion_events(braked)$event, c("stick", "slip"))
  expect_equal(motion_events(braked)$time_s, c(3.5, 4), tolerance = 1e-14)
})

test_that("a gear reflects inertia by the square of its ratio, and its housing takes the rest", {
  for (ratio in c(5, -5, 0.2)) {
    inertia <- 0.1 + 0.5 / ratio^2
    torque <- 2 - 4 / ratio
    motion <- trajectory(
      scene_drive(c(0.1, 0.5), coupling_gear(ratio), torque = list(2, -4)), c(0, 3),
      model = "drive_rk8pd"
    )
    omega <- 3 * torque / inertia
    expect_equal(motion$omega_rad_per_s[3:4], c(omega, omega / ratio), tolerance = 1e-14)
    expect_equal(motion$theta_rad[3], 1.5 * omega, tolerance = 1e-14)
    # Rotor 1 alone: J omega' = 2 - T.
    expect_equal(motion$coupling_torque_n_m[1], 2 - 0.1 * omega / 3, tolerance = 1e-13)
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
})

test_that("a gear in an elastic shaft is a softer shaft, at a reflected inertia", {
  # J2/N^2 on the first shaft, k the same: omega^2 = k (1/J1 + N^2/J2).
  ratio <- -3
  frequency <- sqrt(50 * (1 / 0.4 + ratio^2 / 6))
  t <- seq(0, 2, length.out = 9)
  motion <- trajectory(
    scene_drive(c(0.4, 6), coupling_shaft(50, ratio = ratio), omega0_rad_per_s = c(2, 0)), t,
    1e-11, "drive_rk8pd"
  )
  twist <- motion$theta_rad[motion$rotor == 1] - ratio * motion$theta_rad[motion$rotor == 2]
  expect_equal(twist, 2 * sin(frequency * t) / frequency, tolerance = 1e-9)
  expect_true(all(audit(motion)$verdict == "balanced"))
})

test_that("contacts that share a load hold together, and let go together", {
  # Three bodies at rest, brakes of 4, 3 and 2 N m, clutches of 100: they hold 9 N m on any of them.
  held <- function(clutch) {
    scene_drive(
      c(1, 1, 1), list(coupling_clutch(clutch), coupling_clutch(100)),
      torque = list(torque_knots(c(0, 20), c(0, 20), outside = "hold"), NULL, NULL),
      brake = list(brake(4), brake(3), brake(2))
    )
  }
  together <- trajectory(held(100), c(0, 5, 8, 10))
  expect_equal(motion_events(together)$time_s, rep(9, 3), tolerance = 1e-12)
  expect_equal(together$omega_rad_per_s[10:12], rep(1 / 6, 3), tolerance = 1e-9)
  # At 5 and 8 N m the contacts carry the load, none beyond what it holds.
  expect_true(all(abs(together$damping_torque_n_m) <= rep(c(4, 3, 2), 4) + 1e-12))
  expect_equal(
    tapply(together$damping_torque_n_m, together$time_s, sum)[["8"]], -8, tolerance = 1e-13
  )
  # A clutch of 1.5 N m passes no more: the first body breaks loose at 5.5 N m, alone.
  alone <- trajectory(held(1.5), c(0, 6, 10))
  expect_equal(motion_events(alone)$time_s, c(5.5, 5.5), tolerance = 1e-12)
  expect_setequal(motion_events(alone)$where, c("rotor 1", "coupling 1"))
  expect_equal(alone$omega_rad_per_s[7:9], c(4.5^2 / 2, 0, 0), tolerance = 1e-9)
})

# All locked, the clutches would carry 2.67 and 6.33 N m. The first, with the larger excess, lets
# go; then the second does, and with both sliding the second body would overtake the first: the
# first clutch carries 2.49 N m and stays locked.
test_that("a contact that let go first may stick again when another lets go", {
  for (second in c(5.97, 6 - 1e-9)) {
    motion <- trajectory(scene_drive(
      c(1, 1, 1), list(coupling_clutch(2.5), coupling_clutch(second)), torque = list(-1, NULL, -10)
    ), 1)
    together <- -(1 + second) / 2
    expect_equal(
      motion$omega_rad_per_s, c(together, together, second - 10), tolerance = 1e-14
    )
    expect_identical(motion$locked, c(TRUE, FALSE, NA))
    expect_equal(motion$coupling_torque_n_m[1:2], c((second - 1) / 2, second), tolerance = 1e-14)
  }
})

test_that("bodies that are locked reach rest together, however their friction is divided", {
  # Two locked bodies with resistance on both are one body with the sum.
  torque <- torque_sinusoid(3, 4, 0.5) + torque_sinusoid(1, 9)
  one <- scene_axle(
    3, torque, resistance(0.02, quadratic_n_m_s2 = 0.01, coulomb_n_m = 0.3, static_n_m = 0.5),
    omega0_rad_per_s = 1
  )
  two <- function(first, second, ratio = 1) {
    scene_drive(
      c(1, 2 * ratio^2), coupling_clutch(1e3, ratio = ratio), torque = list(torque, NULL),
      resistance = list(first, second), omega0_rad_per_s = 1
    )
  }
  t <- seq(0, 30, by = 0.5)
  want <- trajectory(one, t, 1e-12, "axle_rk8pd")
  halves <- list(
    two(resistance(0.02, 0.01), resistance(0, 0, 0.3, 0.5)),
    two(resistance(0.02, 0, 0.1, 0.2), resistance(0, 0.01, 0.2, 0.3)),
    two(resistance(0, 0, 0.3, 0.5), resistance(0.02 * 9, 0.01 * 27), 3)
  )
  for (scene in halves) {
    motion <- trajectory(scene, t, 1e-9)
    at <- motion$rotor == 1
    expect_equal(motion$omega_rad_per_s[at], want$omega_rad_per_s, tolerance = 1e-8)
    expect_equal(motion$theta_rad[at], want$theta_rad, tolerance = 1e-8)
    expect_equal(
      unique(motion_events(motion)$time_s), motion_events(want)$time_s, tolerance = 1e-9
    )
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
})

test_that("R functions are torques and capacities", {
  # I omega' = -c omega by a function, against the exponential.
  law <- function(time_s, theta_rad, omega_rad_per_s) -0.5 * omega_rad_per_s
  motion <- trajectory(
    scene_drive(
      c(1, 3), coupling_gear(2), torque = list(torque_function(law, breaks_s = numeric()), NULL),
      omega0_rad_per_s = 4
    ), c(0, 1, 3), 1e-10
  )
  expect_equal(
    motion$omega_rad_per_s[motion$rotor == 1], 4 * exp(-0.5 / 1.75 * c(0, 1, 3)), tolerance = 1e-10
  )
  # A capacity that grows as t: slip 10 - (1/2 + 1/3) 6 t^2 ends at sqrt(2).
  clutch <- scene_drive(
    c(2, 3), coupling_clutch(torque_function(function(time_s) 12 * time_s, breaks_s = numeric())),
    omega0_rad_per_s = c(10, 0)
  )
  expect_equal(motion_events(trajectory(clutch, 0:3))$time_s, sqrt(2), tolerance = 1e-10)
  # A capacity that falls with the slip speed: w' = -(10 - w/4) (1/2 + 1/3) from 10 to 0.
  falling <- scene_drive(
    c(2, 3), coupling_clutch(torque_curve(c(0, 40), c(10, 0))), omega0_rad_per_s = c(10, 0)
  )
  rate <- 0.25 * (1 / 2 + 1 / 3)
  expect_equal(
    motion_events(trajectory(falling, 0:3))$time_s, log(40 / 30) / rate, tolerance = 1e-9
  )
  # An error of the function's own keeps its class.
  broken <- scene_drive(
    c(1, 3), coupling_gear(2), torque = list(function(time_s) stop("mine"), NULL)
  )
  expect_error(trajectory(broken, 0:1), "mine")
})

test_that("quadratic and viscous drag act on any rotor", {
  # The second rotor carries the drag: q omega^2 = q (omega_1/2)^2, through the gear.
  motion <- trajectory(
    scene_drive(
      c(1, 4), coupling_gear(2), resistance = list(NULL, resistance(quadratic_n_m_s2 = 0.8)),
      omega0_rad_per_s = 10
    ), c(0, 1, 4), 1e-10
  )
  # omega_1' = -(0.8/8) omega_1^2/2
  expect_equal(
    motion$omega_rad_per_s[motion$rotor == 1], 10 / (1 + 0.5 * c(0, 1, 4)), tolerance = 1e-10
  )
  back <- trajectory(
    scene_drive(c(1, 4), coupling_gear(2),
                resistance = list(NULL, resistance(quadratic_n_m_s2 = 0.8)),
                torque = list(-3, NULL), omega0_rad_per_s = 10), c(0, 2, 8), 1e-10
  )
  expect_true(all(audit(back)$verdict == "balanced"))
  # 2 omega' = -3 - 0.1 omega |omega|: a tangent up to rest, then its hyperbolic twin.
  rate <- sqrt(3 * 0.1) / 2
  stop_s <- atan(10 * sqrt(0.1 / 3)) / rate
  expect_equal(
    back$omega_rad_per_s[back$rotor == 1][2:3],
    sqrt(30) * c(tan(rate * (stop_s - 2)), -tanh(rate * (8 - stop_s))), tolerance = 1e-10
  )
})

test_that("times before the start are reached backwards where nothing sticks", {
  scene <- scene_drive(
    c(1, 2), coupling_shaft(30, 0.2), torque = list(torque_sinusoid(1, 3), NULL),
    omega0_rad_per_s = c(1, -1), start_s = 1
  )
  there <- trajectory(scene, c(0, 1, 2), 1e-11)
  again <- scene_drive(
    c(1, 2), coupling_shaft(30, 0.2), torque = list(torque_sinusoid(1, 3), NULL),
    theta0_rad = there$theta_rad[1:2], omega0_rad_per_s = there$omega_rad_per_s[1:2]
  )
  expect_equal(trajectory(again, 2, 1e-11)$omega_rad_per_s, there$omega_rad_per_s[5:6],
               tolerance = 1e-9)
  expect_error(
    trajectory(scene_drive(c(1, 2), coupling_clutch(3), omega0_rad_per_s = c(1, 0)), -1),
    class = "rotdyn_error_time"
  )
})

test_that("every verb works on a drive", {
  motion <- trajectory(clutch_drive(), seq(0, 6, by = 0.5))
  one <- summary(motion)
  expect_equal(one$moment_of_inertia_kg_m2, 2.4)
  expect_equal(
    one$heat_j, sum(motion$heat_j[25:26], motion$coupling_heat_j[25:26], na.rm = TRUE)
  )
  expect_equal(generics::glance(motion), one)
  more <- generics::augment(motion)
  expect_equal(more$power_w, more$applied_torque_n_m * more$omega_rad_per_s)
  kinetic <- tapply(more$rotational_kinetic_energy_j, more$time_s, sum)
  at <- more$rotor == 1
  expect_equal(
    as.vector(kinetic - kinetic[1]), more$work_j[at] - more$dissipated_j[at], tolerance = 1e-10
  )
  expect_equal(
    more$dissipated_j[at], as.vector(tapply(
      rowSums(cbind(more$heat_j, more$coupling_heat_j), na.rm = TRUE), more$time_s, sum
    )), tolerance = 1e-12
  )
  there <- predict(motion, time_s = c(2, 0.5, NA))
  expect_equal(there$omega_rad_per_s[1:4], motion$omega_rad_per_s[c(9, 10, 3, 4)],
               tolerance = 1e-9)
  expect_equal(there$rotor, rep(1:2, 3))
  part <- motion[motion$time_s >= 1 & motion$time_s <= 5, ]
  expect_true(all(audit(part)$verdict == "balanced"))
  wrong <- motion
  wrong$heat_j[nrow(wrong)] <- wrong$heat_j[nrow(wrong)] * 1.001
  expect_equal(audit(wrong)$verdict[1], "unbalanced")
  wrong <- motion
  wrong$omega_rad_per_s[nrow(wrong)] <- wrong$omega_rad_per_s[nrow(wrong)] * 1.001
  expect_equal(audit(wrong)$verdict, rep("unbalanced", 2))
  expect_true(is.na(audit(motion[0, ])$verdict[1]))
  expect_true(any(choose_model(clutch_drive(), 0:6)$chosen))
  expect_named(motion_events(motion), c("time_s", "event", "where"))
  quiet <- trajectory(scene_drive(c(1, 2), coupling_gear(2)), 0:1)
  expect_identical(
    as.data.frame(motion_events(quiet)),
    data.frame(time_s = double(), event = character(), where = character())
  )
  none <- trajectory(clutch_drive(), double())
  expect_equal(nrow(none), 0L)
  expect_equal(nrow(generics::augment(none)), 0L)
})

test_that("a drive is drawn and measured", {
  skip_if_not_installed("ggplot2")
  motion <- trajectory(geared_drive(), seq(0, 1, by = 0.05))
  expect_s3_class(ggplot2::autoplot(motion), "ggplot")
  expect_s3_class(ggplot2::autoplot(geared_drive()), "ggplot")
  expect_s3_class(ggplot2::autoplot(clutch_drive()), "ggplot")
  cost <- work_precision(
    clutch_drive(), 0:3, accuracies = c(1e-4, 1e-8), min_batch_s = 1e-3, batches = 1
  )
  expect_true(all(cost$covered, na.rm = TRUE))
  expect_gt(nrow(cost), 2L)
})

test_that("a run that fails keeps its good rows", {
  scene <- scene_drive(
    c(1, 2), coupling_clutch(3), omega0_rad_per_s = c(5, 0),
    torque = list(torque_function(function(time_s, theta_rad, omega_rad_per_s) {
      if (time_s > 2.5) NaN else 1
    }, breaks_s = numeric()), NULL)
  )
  expect_error(trajectory(scene, 0:4), class = "rotdyn_error_torque")
  expect_warning(
    part <- trajectory(scene, 0:4, on_fail = "truncate"), class = "rotdyn_warning_truncated"
  )
  expect_equal(part$time_s, rep(0:2, each = 2))
})

# In quadruple precision, by extrapolated midpoint steps and a search for the modes that fit.
test_that("what breaks loose without an acceleration is caught again, whatever the accuracy", {
  scene <- scene_drive(
    c(0.60443311974904901, 1.2017364799756416, 0.12172819401953867),
    list(coupling_gear(1), coupling_shaft(9.0543870135328586, ratio = -1.1004760971758514)),
    torque = list(
      NULL,
      torque_constant(0.82192812978397534) +
        torque_sinusoid(1.0210005863516791, 2.1673578116754482, 1.2704658647999167),
      -1.1925762278901675
    ),
    resistance = list(
      resistance(0.010748775331828754, coulomb_n_m = 4.8880839230268833),
      resistance(0.30743865486772309), resistance(0.051096648710286602)
    ),
    theta0_rad = c(0.47863700799643993, -0.0094552924856543541, 0.40556392492726445),
    omega0_rad_per_s = c(1.2804273012559861, 1.2804273012559861, -1.3599364606896416)
  )
  for (accuracy in c(3e-4, 1e-4, 1e-6, 1e-9)) {
    motion <- trajectory(scene, c(0, 1.1410921271262), accuracy)
    events <- motion_events(motion)
    expect_equal(events$event, c("stick", "slip", "stick"))
    expect_equal(
      events$time_s, c(0.658709368085, 0.953573236424, 1.00637078805), tolerance = 10 * accuracy
    )
  }
})

# At rest the shaft is slack: rotor 2 slips while the torque exceeds 0.2 N m, by 0.2 %, twice a
# period, and the steps of a motion at rest are long.
test_that("no stretch of slip is passed over, whatever the accuracy", {
  scene <- scene_drive(
    c(1, 0.25), coupling_shaft(5), torque = list(NULL, torque_sinusoid(0.2004, 9.36, -1.5)),
    resistance = list(resistance(coulomb_n_m = 5), resistance(coulomb_n_m = 0.2))
  )
  for (accuracy in c(1e-3, 1e-6, 1e-9, 1e-12)) {
    events <- motion_events(suppressWarnings(
      trajectory(scene, c(0, 30), accuracy), classes = "rotdyn_warning_accuracy"
    ))
    expect_equal(sum(events$event == "slip"), floor((30 * 9.36 - 1.5) / pi + 0.5))
    expect_equal(events$time_s[1], (1.5 - acos(0.2 / 0.2004)) / 9.36, tolerance = 1e-12)
  }
})

test_that("from rest, the contact that is loaded most gives way first", {
  # The torque on rotor 2 passes a clutch (2 N m at rest, 1.5 sliding) to rotor 1, which its axle
  # holds with 1.7 N m at rest, 1 sliding. A clutch that slips and an axle that holds 1.5 N m are
  # always consistent; but as a torque grows, the axle gives way at 1.7 N m.
  after_2_s <- function(torque_n_m) {
    scene <- scene_drive(
      c(1, 2), coupling_clutch(1.5, static_ratio = 4 / 3), torque = list(NULL, torque_n_m),
      resistance = list(resistance(coulomb_n_m = 1, static_n_m = 1.7), NULL)
    )
    trajectory(scene, 2)$omega_rad_per_s
  }
  expect_identical(after_2_s(1.6), c(0, 0))
  expect_equal(after_2_s(3), rep((3 - 1) / (1 + 2) * 2, 2)) # the clutch carries 3 - 2 * 2 / 3
  expect_equal(after_2_s(5), c((1.5 - 1) / 1, (5 - 1.5) / 2) * 2)
})

test_that("a jump of a rotor's torque that is not announced is found over the whole span", {
  jump <- function(t) ifelse(t > 1.234, 1, 0)
  scene <- scene_drive(c(2, 3), coupling_gear(2), torque = list(jump, NULL))
  expect_warning(x <- trajectory(scene, c(0, 3)), class = "rotdyn_warning_breaks")
  last <- x$omega_rad_per_s[x$time_s == 3 & x$rotor == 1]
  # theta_1 = 2 theta_2: 2 + 3/4 kg m^2 at the first shaft.
  expect_equal(last, (3 - 1.234) / 2.75, tolerance = 1e-7)
})

test_that("hundreds of jumps that no break tells are met on an elastic drive, too", {
  wave <- function(time_s) if (time_s %% 1 < 0.5) 1 else -1
  drive <- function(breaks_s) {
    scene_drive(
      c(1, 0.5), coupling_shaft(100, 0.1),
      torque = list(torque_function(wave, breaks_s = breaks_s), NULL)
    )
  }
  found <- trajectory(drive(numeric()), 257)
  told <- trajectory(drive(seq(0.5, 257, by = 0.5)), 257)
  expect_equal(found$theta_rad, told$theta_rad, tolerance = 1e-9)
  # All turn at 1 rad/s^2 over 1.5 kg m^2, forth and back: a quarter over 1.5 each period.
  momentum <- sum(found$angular_momentum_kg_m2_per_s)
  expect_lt(abs(momentum), 1e-8)
  expect_equal(sum(c(1, 0.5) * found$theta_rad), 257 / 4, tolerance = 1e-8)
})

# ---- gears with a loss -----------------------------------------------------------------------

geared_pair <- function(torque, ratio = 3, efficiency = 0.8, omega0 = 0, ...) {
  scene_drive(
    c(0.2, 1.7), coupling_gear(ratio, efficiency = efficiency), torque = torque,
    omega0_rad_per_s = omega0, ...
  )
}

test_that("a gear passes its efficiency of all the power, whichever way it flows", {
  # J1 a + J2 a/(r^2 eta) = tau1 + tau2/(r eta) where power flows forward; backward 1/eta for eta.
  alpha <- function(tau, ratio, eta) {
    (tau[1] + tau[2] / ratio / eta) / (0.2 + 1.7 / ratio^2 / eta)
  }
  cases <- list(
    list(tau = c(2, 0), omega = 4, forward = TRUE),   # accelerates the load
    list(tau = c(-2, 0), omega = 4, forward = FALSE), # the load gives back
    list(tau = c(0, 5), omega = 4, forward = FALSE),  # the load drives
    list(tau = c(0, -5), omega = 4, forward = TRUE),
    list(tau = c(2, 0), omega = -4, forward = FALSE)
  )
  for (case in cases) for (ratio in c(3, -3)) {
    tau <- case$tau * c(1, sign(ratio))
    scene <- geared_pair(as.list(tau), ratio, omega0 = case$omega)
    motion <- trajectory(scene, c(0, 0.1))
    a <- alpha(tau, ratio, if (case$forward) 0.8 else 1 / 0.8)
    first <- motion[motion$rotor == 1, ]
    expect_lt(abs(first$omega_rad_per_s[2] - (case$omega + 0.1 * a)), 1e-13)
    passed <- tau[1] - 0.2 * a # on the gear
    expect_lt(abs(first$coupling_torque_n_m[2] - passed), 1e-12)
    turned <- case$omega * 0.1 + a * 0.005
    loss <- abs(passed * turned) * (if (case$forward) 0.2 else 1 / 0.8 - 1)
    expect_lt(abs(first$coupling_heat_j[2] - loss), 1e-12)
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
})

test_that("a train with losses moves as scene_gears(), through rest and turning power flows", {
  inertia <- c(0.3, 0.2, 2)
  ratios <- c(-2, 3)
  eta <- c(0.9, 0.7)
  trains <- list(
    list(tau = c(-3, 0, 4), omega = 9, viscous = c(0.1, 0.3, 2)), # slows down, turns round
    list(tau = c(2, 0, -3), omega = 0, viscous = 0),
    list(tau = c(0.1, 0, 1), omega = 3, viscous = 0), # stops, and stays
    list(tau = c(5, -1, 0), omega = -20, viscous = c(0, 0, 1))
  )
  time_s <- c(0.2, 0.5, 1.1, 3)
  for (train in trains) {
    want <- trajectory(scene_gears(
      inertia, ratios, efficiency = eta, torque = train$tau, resistance = train$viscous,
      omega0_rad_per_s = train$omega
    ), time_s)
    viscous <- rep_len(train$viscous, 3)
    got <- trajectory(scene_drive(
      inertia, Map(function(r, e) coupling_gear(r, efficiency = e), ratios, eta),
      torque = as.list(train$tau), resistance = lapply(viscous, resistance),
      omega0_rad_per_s = train$omega
    ), time_s, 1e-11)
    last <- got[got$rotor == 3, ]
    expect_lt(max(abs(last$omega_rad_per_s - want$omega_3_rad_per_s)), 1e-10)
    expect_lt(max(abs(last$theta_rad - want$theta_3_rad)), 1e-10)
    expect_true(all(audit(got)$verdict == "balanced"))
  }
})

test_that("a loss holds a drive at rest until the load exceeds it", {
  # Forward the motor needs 6/(3 * 0.8) = 2.5 N m; 2 N m hold the load, and 1.6 N m no longer do.
  ramp <- torque_knots(c(0, 4), c(0, 4))
  events <- motion_events(trajectory(geared_pair(list(2, -6)), 0:2))
  expect_equal(nrow(events), 0L)
  still <- trajectory(geared_pair(list(2, -6)), 0:2)
  expect_true(all(still$omega_rad_per_s == 0))
  expect_true(all(still$coupling_torque_n_m[still$rotor == 1] == 2))
  raised <- trajectory(geared_pair(list(sum_torques(torque_constant(1.6), ramp), -6)), c(0, 1, 2))
  expect_equal(motion_events(raised)$event, "slip")
  expect_lt(abs(motion_events(raised)$time_s - 0.9), 1e-12)
  # From 0.9 s on it accelerates by (t - 0.9)/(J1 + J2/(9 * 0.8)).
  expect_lt(
    abs(raised$omega_rad_per_s[5] - 0.5 * 1.1^2 / (0.2 + 1.7 / 7.2)), 1e-11
  )
  expect_true(all(audit(raised)$verdict == "balanced"))
})

test_that("friction, brakes, shafts and laws of the rate meet a gear with a loss", {
  # A brake on the second shaft: 4 N m through the gear, backward from 12 rad/s until it stands.
  braked <- scene_drive(
    c(0.2, 1.7), coupling_gear(3, efficiency = 0.8), brake = list(NULL, brake(4)),
    omega0_rad_per_s = 12
  )
  # J2 gives to the brake, and what J1 gives passes the gear: power forward.
  a <- -4 / 3 / 0.8 / (0.2 + 1.7 / 9 / 0.8)
  b <- -4 / 3 * 0.8 / (0.2 + 1.7 / 9 * 0.8)
  slows <- if (0.2 * -a > 0) a else b
  events <- motion_events(trajectory(braked, 0:10))
  expect_equal(events$event, "stick")
  expect_lt(abs(events$time_s - -12 / slows), 1e-12)
  # A motor's law behind a gear and a shaft, against a geared axle of the same efficiency where the
  # shaft is stiff and damped: omega within the twist that the torque needs.
  law <- function(time_s, theta_rad, omega_rad_per_s) 5 - 0.2 * omega_rad_per_s
  soft <- scene_drive(
    c(0.2, 1.7, 0.5), list(coupling_gear(3, efficiency = 0.8), coupling_shaft(4e5, 300)),
    torque = list(law, NULL, -2)
  )
  motion <- trajectory(soft, c(0, 1, 2))
  J <- 0.2 + 2.2 / 7.2
  end <- (5 - 2 / 2.4) / 0.2
  omega <- end * (1 - exp(-0.2 * 2 / J))
  expect_lt(abs(motion$omega_rad_per_s[7] - omega), 1e-4)
  expect_true(all(audit(motion)$verdict == "balanced"))
})

test_that("an efficiency of 1 computes as none, and others are refused", {
  plain <- scene_drive(c(1, 2), coupling_gear(2), torque = list(torque_sinusoid(1, 2), -1))
  same <- scene_drive(
    c(1, 2), coupling_gear(2, efficiency = 1), torque = list(torque_sinusoid(1, 2), -1)
  )
  expect_identical(same, plain)
  chosen <- choose_model(geared_pair(list(1, 0)), 1)
  expect_match(chosen$model, "drive_rk8pd|drive_radau", all = FALSE)
  for (bad in list(0, -0.1, 1.01, Inf)) {
    expect_error(coupling_gear(2, efficiency = bad), class = "rotdyn_error_value")
  }
  expect_error(
    scene_drive(c(1, 1, 1), list(coupling_gear(2, efficiency = 0.9), coupling_clutch(1))),
    "coupling_shaft", class = "rotdyn_error_value"
  )
  lossy <- geared_pair(list(1, 0))
  skip_if_not_installed("yyjsonr")
  expect_identical(read_scene(write_scene(lossy)), lossy)
  expect_output(print(lossy), "gear, ratio 3, efficiency 0.8", fixed = TRUE)
  expect_false(conserved(geared_pair(NULL, omega0 = 1))$conserved[1])
  expect_error(trajectory(lossy, c(-1, 0)), class = "rotdyn_error")
})

test_that("a jump in the angle on an elastic drive: the two modes in closed form", {
  # J1 = J2 = 1, torque 1 up to the angle, then -1: mean m'' = +-1/2, twist d'' = +-1 - 2 k d.
  for (k in c(8, 900)) {
    law <- function(time_s, theta_rad, omega_rad_per_s) if (theta_rad < 2) 1 else -1
    w <- sqrt(2 * k)
    first <- function(t) t^2 / 4 + (1 - cos(w * t)) / (4 * k)
    at <- uniroot(function(t) first(t) - 2, c(0, 4), tol = 1e-15)$root
    at <- at - (first(at) - 2) / (at / 2 + sin(w * at) * w / (4 * k))
    # Both modes after it, from their states there.
    d <- (1 - cos(w * at)) / (2 * k) + 1 / (2 * k)
    v <- sin(w * at) * w / (2 * k)
    s <- 0.5
    twist <- -d * w * sin(w * s) + v * cos(w * s)
    want <- (at - s) / 2 + c(1, -1) * twist / 2
    motion <- trajectory(
      scene_drive(c(1, 1), coupling_shaft(k), torque = list(law, NULL)), c(0, at + s)
    )
    expect_lt(max(abs(motion$omega_rad_per_s[3:4] - want)), 1e-9)
    expect_true(all(audit(motion)$verdict == "balanced"))
  }
})

test_that("work and heat of augment() count from the first row, whenever that is", {
  scene <- scene_drive(
    c(1, 0.4), coupling_gear(2), torque = list(3, NULL), resistance = list(resistance(0.5), NULL)
  )
  late <- generics::augment(trajectory(scene, c(1, 2, 3)))
  work <- late$work_j[late$rotor == 1]
  all <- generics::augment(trajectory(scene, c(0, 1, 2, 3)))
  whole <- all$work_j[all$rotor == 1]
  expect_identical(work[1], 0)
  expect_equal(work, whole[-1] - whole[2])
  expect_gt(work[3], 1)
})

test_that("a coupling without teeth is no gear, and one with a ratio is", {
  effects <- function(coupling) core_effects("drive", scene_drive(c(1, 2), coupling))
  expect_identical(effects(coupling_clutch(3)), "clutch")
  expect_identical(effects(coupling_shaft(5)), "shaft")
  expect_identical(effects(coupling_gear(2)), "gear")
  expect_setequal(effects(coupling_shaft(5, ratio = 2)), c("shaft", "gear"))
})

# Acceleration of the first of rotors in mesh, each with a torque: the directions of the power in
# the meshes give one, by the torque balance of the last rotor, the one before, ...; those that it
# has itself are the answer. `turn`: 1 forward, -1 backward.
meshed_acceleration <- function(inertia, ratio, efficiency, torque, turn) {
  n <- length(inertia)
  speed <- cumprod(c(1, 1 / ratio))
  flows <- as.matrix(expand.grid(rep(list(c(1, -1)), n - 1)))
  unlist(lapply(seq_len(nrow(flows)), function(k) {
    needs <- c(0, 0) # a torque, and its change with the acceleration of the first
    power <- matrix(0, n - 1, 2)
    for (i in n:1) {
      needs <- needs + c(-torque[i], inertia[i] * speed[i])
      if (i == 1) break
      power[i - 1, ] <- needs * speed[i] * turn
      needs <- needs * speed[i] / speed[i - 1] / efficiency[i - 1]^flows[k, i - 1]
    }
    a <- -needs[1] / needs[2]
    if (all(sign(power %*% c(1, a)) == flows[k, ])) a
  }))
}

test_that("lossy meshes lose power in the direction in which it flows, in rows of three to five", {
  set.seed(3)
  for (j in 1:30) {
    n <- 3 + j %% 3
    inertia <- runif(n, 0.1, 2)
    ratio <- runif(n - 1, 0.3, 3) * sample(c(-1, 1), n - 1, TRUE)
    efficiency <- runif(n - 1, 0.5, 0.95)
    torque <- runif(n, -5, 5)
    turn <- if (j %% 2) 1 else -1
    drive <- scene_drive(
      inertia, Map(function(r, e) coupling_gear(r, efficiency = e), ratio, efficiency),
      torque = torque, omega0_rad_per_s = 100 * turn * cumprod(c(1, 1 / ratio))
    )
    motion <- trajectory(drive, c(0, 1))
    gained <- diff(motion$omega_rad_per_s[motion$rotor == 1])
    expect_equal(gained, meshed_acceleration(inertia, ratio, efficiency, torque, turn),
      tolerance = 1e-11)
  }
})

test_that("a stop shorter than the resolution of its time keeps the momentum", {
  for (omega in c(1, 1e-6, 1e-12)) {
    motion <- trajectory(
      scene_drive(1, brake = list(brake(2, from_s = 1)), omega0_rad_per_s = omega), 0:2
    )
    expect_identical(audit(motion)$verdict, rep("balanced", 2))
    expect_equal(generics::augment(motion)$damping_impulse_n_m_s[3], -omega, tolerance = 1e-12)
  }
})

test_that("at rest the angle has the error that it came to rest with", {
  scene <- scene_drive(1, brake = list(brake(2)), omega0_rad_per_s = 1)
  for (end_s in c(1, 1e6, 1e9)) {
    motion <- trajectory(scene, c(0, end_s))
    expect_equal(motion$theta_rad[2], 0.25, tolerance = 1e-14)
    expect_lt(glance(motion)$error, 1e-14)
  }
})

test_that("what is locked to a body at rest gains no error there", {
  # Locked within 1e-9 s and braked: rotor 2 has no contact to ground of its own.
  for (end_s in c(1, 100)) {
    motion <- trajectory(
      scene_drive(
        list(1, 1), list(coupling_clutch(5)), brake = list(brake(2), NULL),
        omega0_rad_per_s = c(1e-8, 0)
      ), c(5e-10, end_s)
    )
    expect_lt(glance(motion)$error, 1e-13)
  }
})

test_that("gears with a loss reverse as the train of an axle does", {
  axle <- scene_gears(c(0.1, 2), 5, efficiency = 0.8, torque = c(2, 0), omega0_rad_per_s = -6)
  drive <- scene_drive(
    c(0.1, 2), coupling_gear(5, efficiency = 0.8), torque = c(2, 0), omega0_rad_per_s = -6
  )
  want <- motion_events(trajectory(axle, c(0, 3)))
  got <- motion_events(trajectory(drive, c(0, 3)))
  expect_identical(want$event, "reverse")
  expect_identical(got$event, want$event)
  expect_equal(got$time_s, want$time_s, tolerance = 1e-12)
})

test_that("an open clutch whose slip changes its sign reverses, as scene_clutch() says", {
  # The slip is 2 - t; from 5 s on it falls from 3 by 2 x 2 - 1 = 3 rad/s^2.
  torque <- list(torque_constant(-1), NULL)
  drive <- scene_drive(c(1, 1), coupling_clutch(2, from_s = 5), torque = torque,
                       omega0_rad_per_s = c(2, 0))
  clutch <- scene_clutch(1, 1, 2, torque = torque, omega0_rad_per_s = c(2, 0), engage_s = 5)
  expected <- motion_events(trajectory(clutch, 0:12))
  expect_equal(expected$time_s, c(2, 6))
  for (model in c("drive_clutch", "drive_rk8pd", "drive_radau")) {
    events <- motion_events(trajectory(drive, 0:12, model = model))
    expect_identical(events$event, c("reverse", "lock"))
    expect_equal(events$time_s, c(2, 6), tolerance = 1e-9)
  }
})

test_that("a shaft drives a gear with losses: two masses in closed form", {
  k <- 50
  ratio <- 2
  efficiency <- 0.8
  twist <- 0.1
  drive <- scene_drive(
    list(2, 1, 3), list(coupling_shaft(k), coupling_gear(ratio, efficiency = efficiency)),
    theta0_rad = c(twist, 0, 0), omega0_rad_per_s = c(1, 1, 1 / ratio)
  )
  # While the shaft pushes, power flows forward: the third body weighs 1/efficiency as much.
  reduced <- 1 + 3 / (efficiency * ratio^2)
  rate <- sqrt(k * (1 / 2 + 1 / reduced))
  time_s <- seq(0, 1.5, 0.1) / rate
  for (model in c("drive_rk8pd", "drive_radau")) {
    motion <- trajectory(drive, time_s, model = model)
    second <- motion$omega_rad_per_s[motion$rotor == 2]
    expect_equal(second, 1 + k * twist / (reduced * rate) * sin(rate * time_s), tolerance = 1e-9)
  }
})

test_that("a run that is no better than the one before does not end the refinement", {
  scene <- scene_drive(
    c(35.73377654725153, 0.0048263451476713475, 13.948608812730683, 1.2543375684051687),
    list(
      coupling_clutch(0.736, ratio = 0.5), coupling_shaft(21300, ratio = -3),
      coupling_clutch(2.32, ratio = 0.5)
    ),
    torque = list(
      -3.37, torque_motor(1.86, 6.1), torque_motor(6.48, 6.3) + torque_constant(-1.8),
      torque_motor(4.94, 3.3)
    ),
    resistance = list(
      resistance(0.12), resistance(0.13), resistance(coulomb_n_m = 1), resistance()
    ),
    brake = list(NULL, NULL, NULL, brake(
      torque_knots(c(8.79, 9.11, 9.28), c(4.4, 7.1, 3.9), outside = "hold"),
      from_s = 6.16, to_s = 12.13
    )),
    theta0_rad = c(-0.36, 0.85, -0.92, 0.57), omega0_rad_per_s = c(0, 4.2, -2.9, -1.6),
    start_s = 5
  )
  run <- trajectory(scene, seq(5, 15, 0.5), model = "drive_radau")
  expect_lt(glance(run)$error, 2e-10) # 7.7e-8 after two runs
  other <- trajectory(scene, seq(5, 15, 0.5), model = "drive_rk8pd")
  errors <- trajectory_run(run)$info$errors + trajectory_run(other)$info$errors
  expect_lt(max(abs(run$theta_rad - other$theta_rad)), errors[["theta"]])
  expect_lt(max(abs(run$omega_rad_per_s - other$omega_rad_per_s)), errors[["omega"]])
})

test_that("a clutch that a sinusoid drives for ever ends far before its budget", {
  scene <- scene_drive(
    c(1, 2), list(coupling_clutch(3)),
    torque = list(torque_sinusoid(2, 1), NULL), omega0_rad_per_s = c(1, 0)
  )
  error <- expect_error(trajectory(scene, c(0, 1, 1e80)), class = "rotdyn_error_budget")
  at_s <- as.double(sub(".*failed at ([0-9.e+]+) s.*", "\\1", conditionMessage(error)))
  expect_lt(at_s, 1e5) # 5e5 where the budget ends
})

test_that("a brake that begins to act on a drive at rest holds it from the start", {
  ramp <- function(to_n_m) torque_knots(c(0, 2), c(0, to_n_m), outside = "hold")
  for (to_n_m in c(20, 0.02, 2e-9)) {
    alone <- scene_drive(1, brake = brake(ramp(to_n_m)), torque = list(ramp(to_n_m / 2)))
    beside <- scene_drive(
      c(1, 1), coupling_clutch(0), brake = list(brake(ramp(to_n_m)), brake(0)),
      torque = list(ramp(to_n_m / 2), NULL)
    )
    for (scene in list(alone, beside)) {
      motion <- trajectory(scene, 0:4)
      expect_identical(nrow(motion_events(motion)), 0L)
      expect_true(all(motion$omega_rad_per_s == 0))
      expect_identical(glance(motion)$error, 0)
      expect_true(all(audit(motion)$verdict == "balanced"))
    }
  }
})

test_that("bodies locked by a clutch swing under quadratic drag on one of them", {
  # b = drag/inertia, n = stiffness/inertia: in a swing of one direction
  # exp(2 b s theta) (omega^2 + n (s theta/b - 1/(2 b^2))) is constant, s the sign of omega.
  for (seed in 1:8) {
    set.seed(seed)
    inertia <- runif(2, 0.1, 3)
    ratio <- runif(1, 0.3, 3)
    stiffness <- runif(1, 1, 9)
    drag <- runif(1, 0.05, 0.5)
    scene <- scene_drive(
      inertia, coupling_clutch(500, ratio = ratio), torque = list(torque_spring(stiffness), NULL),
      resistance = list(NULL, resistance(quadratic_n_m_s2 = drag)), omega0_rad_per_s = 3
    )
    motion <- trajectory(scene, seq(0, 10, 0.05), max_steps = 1e4)
    theta <- motion$theta_rad[motion$rotor == 1]
    omega <- motion$omega_rad_per_s[motion$rotor == 1]
    whole <- inertia[1] + inertia[2] / ratio^2
    b <- drag / ratio^3 / whole
    first <- exp(2 * b * sign(omega) * theta) *
      (omega^2 + stiffness / whole * (sign(omega) * theta / b - 1 / (2 * b^2)))
    swing <- cumsum(c(TRUE, diff(sign(omega)) != 0))
    expect_gt(max(swing), 2)
    expect_lt(max(tapply(first, swing, function(x) diff(range(x)) / abs(x[1]))), 1e-8)
  }
})

test_that("a clutch is open before it acts and after, whatever holds the rotors", {
  # 1 N m of the sinusoid on rotor 1, 4 N m of each brake: nothing moves.
  for (brake in list(list(brake(4), brake(4)), list(brake(4), NULL))) {
    held <- scene_drive(
      c(1, 1), coupling_clutch(5, from_s = 1, to_s = 3), brake = brake,
      torque = list(torque_sinusoid(1, 1), NULL)
    )
    motion <- trajectory(held, c(0, 0.5, 1, 2, 2.9, 3, 4))
    expect_identical(
      motion$locked[motion$rotor == 1], c(FALSE, FALSE, TRUE, TRUE, TRUE, FALSE, FALSE)
    )
    expect_identical(unique(motion$omega_rad_per_s), 0)
    events <- motion_events(motion)
    expect_equal(events$time_s, c(1, 3))
    expect_identical(as.character(events$event), c("lock", "slip"))
  }
})

test_that("implicit steps begin at rest at a kink of a torque curve", {
  expect_agrees <- function(inertia, shaft, torque, curve, theta0_rad, unit_s, start_s) {
    unit_n_m <- 7 / unit_s^2
    scene <- scene_drive(
      inertia,
      list(
        coupling_shaft(shaft[1] * unit_n_m, shaft[2] * unit_n_m * unit_s, ratio = -3),
        coupling_gear(-1)
      ),
      torque = list(
        NULL, -torque * unit_n_m,
        torque_curve(c(-10, 0, 3, 10) / unit_s, -curve[1] * unit_n_m * c(1, 1, curve[2], -1))
      ),
      resistance = list(0.12 * unit_n_m * unit_s, NULL, NULL), theta0_rad = theta0_rad,
      start_s = start_s
    )
    time_s <- start_s + unit_s * c(0, 0.58, 1.23, 4.16, 8.77)
    explicit <- trajectory(scene, time_s, model = "drive_rk8pd", accuracy = 1e-11)
    for (accuracy in c(1e-9, 1e-10)) {
      implicit <- suppressWarnings(
        trajectory(scene, time_s, model = "drive_radau", accuracy = accuracy)
      )
      errors <- trajectory_run(implicit)$info$errors + trajectory_run(explicit)$info$errors
      expect_lt(max(abs(implicit$theta_rad - explicit$theta_rad)), errors[["theta"]])
      expect_lt(max(abs(implicit$omega_rad_per_s - explicit$omega_rad_per_s)), errors[["omega"]])
    }
  }
  expect_agrees(
    7 * c(0.37, 0.14, 0.22), c(140, 0.38), 1.2, c(0.53, 0.5), c(1.8, -1.2, -1.8), 1e-4, 1e-4
  )
  expect_agrees(
    c(1.51, 1.19, 1.08), c(169, 0.356), 1.25, c(0.321, 0.531), c(2.5, -1.2, -1.8), 10, 0
  )
})

test_that("a shaft twisted by its load swings slowly within the figure", {
  # Extrapolation with 34 digits (mpmath 1.3.0) from these doubles; both torques balance the twist.
  # Of a function, which is sampled, the figure lacked the error: the truth was 1.2 times as much.
  load <- -0x1.69013ecd0fab0p+3
  for (second in list(load, function(time_s) load)) {
    gravity <- torque_gravity(1, 1, gravity_m_per_s2 = 0x1.768eaf3cef703p-1)
    scene <- scene_drive(
      list(0x1.0f1d17e64d40fp-3, 0x1.0b9c5e76bd224p-2),
      coupling_shaft(0x1.df909548816b5p+5, ratio = 1.0),
      torque = list(gravity + 0x1.7e86da7725bafp+3, second),
      theta0_rad = c(0x1.2a9b5f4cc2095p+0, 0x1.f4dbc7a956cc5p-1),
      omega0_rad_per_s = c(0x1.3a6a58abf79f6p-14, -0x1.a338763a9f7f3p-16)
    )
    motion <- suppressWarnings(trajectory(scene, seq(0, 2, length.out = 11)))
    size <- max(abs(motion$omega_rad_per_s))
    last <- c(-0x1.ffb2b814478e6p-16, 0x1.c9a1d2ce66d05p-17)
    off <- max(abs(motion$omega_rad_per_s[21:22] - last))
    expect_lt(off, glance(motion)$error * size)
  }
})
