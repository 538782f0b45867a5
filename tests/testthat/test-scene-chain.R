# A chain of pendulums.
test_that("one link is a pendulum", {
  for (links in c("rods", "points")) {
    chain <- scene_chain(0.8, 3, 2, links = links, omega0_rad_per_s = 1)
    body <- if (links == "rods") body_rod_end(3, 0.8) else body_point(3)
    one <- if (links == "rods") {
      scene_pendulum(body, theta0_rad = 2, omega0_rad_per_s = 1)
    } else {
      scene_pendulum(body, 0.8, theta0_rad = 2, omega0_rad_per_s = 1)
    }
    time <- c(0, 0.5, 4)
    motion <- trajectory(chain, time, accuracy = 1e-12)
    expect_equal(motion$theta_rad, trajectory(one, time)$theta_rad, tolerance = 1e-10)
    expect_equal(motion$link, rep(1L, 3))
  }
})

test_that("two pendulums move as Lagrange's equations say, in an inertial frame", {
  # From forces: tension in each rod from the accelerations, by central differences of the rows.
  chain <- scene_chain(c(0.5, 0.3), c(2, 0.7), c(1, -2), links = "points")
  h <- 1e-4
  motion <- trajectory(chain, 0.4 + c(-h, 0, h), accuracy = 1e-12)
  at <- function(link, column) motion[[column]][motion$link == link]
  acceleration <- function(link, column) (at(link, column)[3] - at(link, column)[1]) / (2 * h)
  g <- 9.80665
  theta <- c(at(1, "theta_rad")[2], at(2, "theta_rad")[2])
  a1 <- c(acceleration(1, "vx_m_per_s"), acceleration(1, "vy_m_per_s"))
  a2 <- c(acceleration(2, "vx_m_per_s"), acceleration(2, "vy_m_per_s"))
  # The lower rod pulls along itself alone, the upper one too: no force across.
  across <- function(f, angle) f[1] * cos(angle) + f[2] * sin(angle)
  pull <- 0.7 * (a2 + c(0, g))
  expect_lt(abs(across(pull, theta[2])), 1e-4)
  expect_lt(abs(across(2 * (a1 + c(0, g)) + pull, theta[1])), 1e-4)
})

test_that("places and velocities are those of the links", {
  chain <- scene_chain(c(1, 2, 0.5), c(1, 3, 2), c(0.3, -1, 2), omega0_rad_per_s = c(2, -1, 4),
    resistance = c(0.1, 0.2, 0.3))
  row <- trajectory(chain, 0)
  l <- c(1, 2, 0.5)
  t <- c(0.3, -1, 2)
  w <- c(2, -1, 4)
  expect_equal(row$x_m, cumsum(l * sin(t)))
  expect_equal(row$y_m, -cumsum(l * cos(t)))
  expect_equal(row$vx_m_per_s, cumsum(l * w * cos(t)))
  expect_equal(row$vy_m_per_s, cumsum(l * w * sin(t)))
  expect_equal(row$joint_torque_n_m, -c(0.1, 0.2, 0.3) * c(2, -3, 5))
  centre <- function(x) c(0, x[-3]) + diff(c(0, x)) / 2
  vx <- centre(row$vx_m_per_s)
  vy <- centre(row$vy_m_per_s)
  expect_equal(row$kinetic_energy_j, c(1, 3, 2) / 2 * (vx^2 + vy^2 + l^2 * w^2 / 12))
  rise <- centre(cumsum(l * (1 - cos(t))))
  expect_equal(row$potential_energy_j, c(1, 3, 2) * 9.80665 * rise)
})

test_that("modes are those of the textbook", {
  two <- chain_modes(scene_chain(c(1.3, 1.3), 4, 0, links = "points"))
  rate <- sqrt((2 + c(-1, 1) * sqrt(2)) * 9.80665 / 1.3)
  expect_equal(two$natural_rad_per_s, rep(rate, each = 2), tolerance = 1e-14)
  expect_equal(two$relative_theta, c(sqrt(0.5), 1, -sqrt(0.5), 1), tolerance = 1e-14)
  expect_equal(two$period_s, 2 * pi / two$natural_rad_per_s)
  rod <- chain_modes(scene_chain(2, 5, 0))
  expect_equal(rod$natural_rad_per_s, sqrt(1.5 * 9.80665 / 2), tolerance = 1e-15)
  # A heavy rope of n short links: the slowest rate tends to 1.2024 sqrt(g/L).
  rope <- chain_modes(scene_chain(rep(1 / 16, 16), 1, 0))
  expect_equal(rope$natural_rad_per_s[1], 1.20241 * sqrt(9.80665), tolerance = 3e-4)
  expect_equal(chain_modes(scene_chain(1, 1, 0, gravity_m_per_s2 = 0))$period_s, Inf)
  expect_error(chain_modes(scene_axle(1)), class = "rotdyn_error_type")
  # A start in a mode comes back after its period.
  chain <- scene_chain(c(1.3, 1.3), 4, 1e-6 * two$relative_theta[3:4], links = "points")
  motion <- trajectory(chain, c(0, two$period_s[3] / 2, two$period_s[3]), accuracy = 1e-6)
  turns <- rep(c(1, -1, 1), each = 2)
  expect_within(motion$theta_rad, 1e-6 * turns * two$relative_theta[c(3:4, 3:4, 3:4)], 1e-6)
})

test_that("small swings are a sum of modes with a bound, larger ones are integrated", {
  small <- scene_chain(c(0.5, 0.3), c(2, 0.7), c(1e-6, -2e-6))
  time <- seq(0, 5, 0.5)
  modes <- trajectory(small, time, accuracy = 1e-6)
  expect_match(attr(modes, "run")$model, "chain_modes")
  whole <- trajectory(small, time, accuracy = 1e-11, model = "chain_rk8pd")
  off <- max(abs(modes$theta_rad - whole$theta_rad)) / max(abs(whole$theta_rad))
  expect_lt(off, summary(modes)$error)
  large <- choose_model(scene_chain(c(0.5, 0.3), c(2, 0.7), c(1, -2)), 0:3)
  expect_match(large$reason[large$model == "chain_modes"], "half a radian")
  damped <- choose_model(scene_chain(c(0.5, 0.3), 1, 1e-6, resistance = 1), 0:3, accuracy = 1e-3)
  expect_match(damped$reason[damped$model == "chain_modes"], "viscous joints")
})

test_that("audits balance, and find what was edited", {
  for (chain in list(
    scene_chain(c(0.5, 0.3), c(2, 0.7), c(1, -2)),
    scene_chain(c(0.5, 0.3, 0.4), 1, c(2, 1, 3), links = "points", resistance = 0.02),
    scene_chain(c(0.5, 0.3), c(2, 0.7), c(1e-6, -2e-6)),
    scene_chain(c(1, 1), 1, 0, omega0_rad_per_s = c(3, -5), gravity_m_per_s2 = 0)
  )) {
    motion <- trajectory(chain, seq(0, 2, 0.25), accuracy = 1e-8)
    expect_equal(audit(motion)$verdict, rep("balanced", 2))
    n <- nrow(motion)
    size <- max(abs(motion$kinetic_energy_j)) + max(abs(motion$potential_energy_j))
    expect_lt(audit(motion)$rounding[1], 1e-3 * size)
    motion$omega_rad_per_s[n] <- motion$omega_rad_per_s[n] + 0.05 * max(abs(motion$omega_rad_per_s))
    expect_true("unbalanced" %in% audit(motion)$verdict)
    expect_equal(audit(motion[-n, ])$verdict, c(NA_character_, NA_character_))
  }
  expect_equal(conserved(scene_chain(1:2, 1, 0))$conserved, c(TRUE, FALSE))
  expect_equal(conserved(scene_chain(1:2, 1, 0, resistance = 1))$conserved, c(FALSE, FALSE))
  expect_equal(conserved(scene_chain(1:2, 1, 0, gravity_m_per_s2 = 0))$conserved, c(TRUE, TRUE))
  ledger <- augment(trajectory(scene_chain(1:2, 1, 1, resistance = 0.3), 0:3))
  total <- function(x) x$kinetic_energy_j + x$potential_energy_j
  by_time <- rowsum(total(ledger), ledger$time_s)[, 1]
  heat <- ledger$dissipated_j[ledger$link == 1]
  expect_equal(unname(by_time[1] - by_time), heat, tolerance = 1e-8)
})

test_that("the error of a chaotic motion grows until nothing is known", {
  chain <- scene_chain(c(1, 1), 1, c(2.5, 2), links = "points")
  short <- trajectory(chain, c(0, 5))
  expect_lt(summary(short)$error, 1e-7)
  expect_warning(long <- trajectory(chain, c(0, 120)), class = "rotdyn_warning_accuracy")
  expect_lt(glance(long)$rhs_calls, 2e6) # 2.7e7 before it was seen that more steps say no more
})

test_that("verbs work on rows of several links, and texts come back", {
  chain <- scene_chain(c(0.5, 0.3), c(2, 0.7), c(1, -2), start_s = 1)
  motion <- trajectory(chain, c(1, 2, 3))
  again <- predict(motion, c(2.5, 2))
  expect_equal(again$link, c(1L, 2L, 1L, 2L))
  expect_equal(again$theta_rad[3:4], motion$theta_rad[3:4], tolerance = 1e-7)
  down <- time_when(chain, theta_rad = 0, link = 1)
  expect_equal(predict(motion, down$time_s)$theta_rad[1], 0, tolerance = 1e-7)
  skip_if_not_installed("yyjsonr")
  expect_identical(read_scene(write_scene(chain)), chain)
  expect_snapshot(error = TRUE, {
    scene_chain(c(1, 1), c(1, 2, 3), 0)
    scene_chain(c(1, -1), 1, 0)
    scene_chain(rep(1, 17), 1, 0)
    scene_chain(numeric(), 1, 0)
    scene_chain(1, 1, 0, links = "ropes")
    scene_chain(1, 1, NA)
  })
  expect_snapshot(print(chain))
  chain$mass_kg <- c(1, 2, 3)
  expect_error(trajectory(chain, 0:1), class = "rotdyn_error_type")
})

test_that("links that are NULL are refused, not another chain", {
  expect_error(scene_chain(1, 1, 1, links = NULL), "rods", class = "rotdyn_error_value")
  expect_identical(scene_chain(1, 1, 1)$links, "rods")
})
