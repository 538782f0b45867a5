test_that("a level rod on an edge, by hand", {
  # 2 kg and 1 m, 0.3 m from its centre, 2 m/s, e = 1/4: J = 1.25 * 2/(1/2 + 0.09 * 6).
  hit <- collide(
    body_rod(2, 1), velocity_1_m_per_s = c(0, 0, -2), normal = c(0, 0, 1),
    arm_1_m = c(0.3, 0, 0), restitution = 0.25
  )
  expect_equal(hit$normal_impulse_n_s, 2.5 / 1.04, tolerance = 1e-15)
  expect_equal(hit$vz_1_m_per_s, -2 + 1.25 / 1.04, tolerance = 1e-15)
  expect_equal(hit$omega_y_1_rad_per_s, -1.8 * 2.5 / 1.04, tolerance = 1e-15)
  expect_equal(hit$normal_loss_j, (1 - 1 / 16) * 4 / 1.04 / 2, tolerance = 1e-15)
  expect_false(any(grepl("_2_", names(hit))))
  expect_setequal(setdiff(names(hit), column_table()$name), character())
  # The same rod in other axes: the body is turned by its attitude.
  turned <- collide(
    body_rod(2, 1), velocity_1_m_per_s = c(0, 0, -2), normal = c(0, 0, 3),
    arm_1_m = c(0, 0.3, 0), restitution = 0.25, attitude_1 = rotation_about("z", angle_deg = 90)
  )
  expect_equal(turned$omega_x_1_rad_per_s, -hit$omega_y_1_rad_per_s, tolerance = 1e-15)
  half <- sqrt(0.5)
  quaternion <- collide(
    body_rod(2, 1), velocity_1_m_per_s = c(0, 0, -2), normal = c(0, 0, 3),
    arm_1_m = c(0, 0.3, 0), restitution = 0.25, attitude_1 = rbind(c(half, 0, 0, half))
  )
  expect_equal(quaternion$omega_x_1_rad_per_s, turned$omega_x_1_rad_per_s, tolerance = 1e-14)
})

test_that("two balls: a head-on one, one that grips, a point mass", {
  ball <- body_sphere(0.17, 0.0286)
  centre <- collide(
    ball, ball, velocity_1_m_per_s = c(2, 0, 0), normal = c(-1, 0, 0), restitution = 0.9
  )
  expect_equal(centre$vx_2_m_per_s, 1.9, tolerance = 1e-14)
  expect_equal(centre$vx_1_m_per_s, 0.1, tolerance = 1e-14)
  # A ball and a floor: the closed form of ball_bounce().
  floor <- collide(
    ball, velocity_1_m_per_s = c(3, 0, -2), omega_1_rad_per_s = c(0, 40, 0), normal = c(0, 0, 1),
    restitution = 0.6, friction = c(0.05, 0.5)
  )
  same <- ball_bounce(ball, 3, -2, 40, 0.6, c(0.05, 0.5))
  expect_equal(floor$vx_1_m_per_s, same$vx_m_per_s, tolerance = 1e-14)
  expect_equal(floor$omega_y_1_rad_per_s, same$omega_rad_per_s, tolerance = 1e-14)
  expect_equal(floor$friction_loss_j, same$friction_loss_j, tolerance = 1e-13)
  expect_identical(floor$sticks, same$sticks)
  point <- body_points(data.frame(x_m = 0, y_m = 0, z_m = 0, mass_kg = 1))
  bounce <- collide(point, velocity_1_m_per_s = c(1, 0, -1), normal = c(0, 0, 1), friction = 0.1)
  expect_equal(bounce$vx_1_m_per_s, 0.8, tolerance = 1e-15)
})

test_that("Newton's coefficient creates energy where Stronge's cannot", {
  # Routh's rod, planar: m = 1, I = 1/12, arm (x, -h), slip that is reversed by the friction.
  rod <- body_tensor(diag(rep(1 / 12, 3)), mass_kg = 1)
  a <- 35 * pi / 180
  hit <- function(coefficient) {
    collide(
      rod, velocity_1_m_per_s = c(-0.2, 0, -1), normal = c(0, 0, 1),
      arm_1_m = -0.5 * c(cos(a), 0, sin(a)), restitution = 0.9, friction = 0.6,
      coefficient = coefficient
    )
  }
  newton <- hit("kinematic")
  stronge <- hit("energetic")
  kinetic <- function(h) {
    0.5 * (h$vx_1_m_per_s^2 + h$vz_1_m_per_s^2) + h$omega_y_1_rad_per_s^2 / 24
  }
  expect_false(stronge$creates_energy)
  expect_lt(kinetic(stronge), 0.52)
  expect_equal(0.52 - kinetic(stronge), stronge$normal_loss_j + stronge$friction_loss_j,
    tolerance = 1e-13)
  expect_equal(0.52 - kinetic(newton), newton$normal_loss_j + newton$friction_loss_j,
    tolerance = 1e-13)
  # By definition of each.
  contact <- function(h) {
    h$vz_1_m_per_s - h$omega_y_1_rad_per_s * -0.5 * cos(a)
  }
  expect_equal(contact(newton), 0.9, tolerance = 1e-13)
  table <- collide(
    rod, velocity_1_m_per_s = c(0, 0, -1), normal = c(0, 0, 1), omega_1_rad_per_s = c(0, 0, 0),
    arm_1_m = -0.5 * cbind(cos(seq(0.1, 1.5, 0.1)), 0, sin(seq(0.1, 1.5, 0.1))),
    restitution = 1, friction = 0.2, coefficient = "kinematic"
  )
  # Slip that starts from rest never turns: the three coefficients agree.
  expect_false(any(table$creates_energy))
})

test_that("many collisions are one call; rows are those of single calls", {
  set.seed(7)
  n <- 40
  vectors <- function(size = 1) matrix(stats::rnorm(3 * n, sd = size), n)
  box <- body_box(1, 0.1, 0.2, 0.3)
  rod <- body_cylinder(2, 0.02, 0.5)
  q <- matrix(stats::rnorm(4 * n), n)
  q <- q / sqrt(rowSums(q^2))
  given <- list(
    velocity_1_m_per_s = vectors(), velocity_2_m_per_s = vectors(),
    omega_1_rad_per_s = vectors(5), normal = vectors(), arm_1_m = vectors(0.1),
    arm_2_m = vectors(0.1), attitude_1 = q, friction = stats::runif(n), separating = "keep"
  )
  all <- do.call(collide, c(list(box, rod, restitution = 0.5), given))
  expect_gt(sum(all$normal_impulse_n_s > 0), 10)
  for (i in c(1, 17, 40)) {
    one <- lapply(given, function(x) {
      if (is.matrix(x)) x[i, ] else if (length(x) == n) x[i] else x
    })
    alone <- do.call(collide, c(list(box, rod, restitution = 0.5), one))
    expect_identical(lapply(alone, identity), lapply(all[i, ], identity))
  }
  frame <- as.data.frame(given$velocity_1_m_per_s)
  given$velocity_1_m_per_s <- frame
  expect_identical(do.call(collide, c(list(box, rod, restitution = 0.5), given)), all)
  bodies <- collide(
    list(body_sphere(1, 0.1), body_sphere(3, 0.1)), body_sphere(1, 0.1),
    velocity_1_m_per_s = c(2, 0, 0), normal = c(-1, 0, 0)
  )
  expect_equal(bodies$vx_2_m_per_s, c(2, 3), tolerance = 1e-14)
  given$friction[3] <- NA
  expect_true(all(is.na(unlist(do.call(collide, c(list(box, rod), given))[3, ]))))
})

test_that("bodies that do not approach keep their motion, to the bit", {
  ball <- body_sphere(1, 0.1)
  away <- collide(
    ball, ball, velocity_1_m_per_s = c(0.1, 0.2, 0.3), velocity_2_m_per_s = c(-1, 0, 0),
    normal = c(1, 0, 0), friction = 0.5, separating = "keep"
  )
  expect_identical(away$vx_1_m_per_s, 0.1)
  expect_identical(away$vx_2_m_per_s, -1)
  expect_identical(away$normal_impulse_n_s, 0)
  graze <- collide(ball, velocity_1_m_per_s = c(1, 0, 0), normal = c(0, 0, 1), friction = 1)
  expect_identical(graze$vx_1_m_per_s, 1)
})

test_that("bad input is the package's own error", {
  ball <- body_sphere(1, 0.1)
  hit <- function(...) {
    given <- list(
      body_1 = ball, velocity_1_m_per_s = c(0, 0, -1), normal = c(0, 0, 1)
    )
    new <- list(...)
    do.call(collide, c(new, given[setdiff(names(given), names(new))]))
  }
  expect_error(hit(restitution = 1.01), class = "rotdyn_error_value")
  expect_error(hit(restitution = -0.1), class = "rotdyn_error_value")
  expect_error(hit(friction = -1), class = "rotdyn_error_value")
  expect_error(hit(normal = c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(hit(normal = c(1, 0)), class = "rotdyn_error_size")
  expect_error(hit(normal = "z"), class = "rotdyn_error_type")
  expect_error(hit(body_1 = 1), class = "rotdyn_error_type")
  expect_error(hit(body_1 = list()), class = "rotdyn_error_size")
  expect_error(hit(body_1 = body_box(1, 1, 1, 1)), class = "rotdyn_error_missing")
  expect_error(hit(body_1 = body_hemisphere(1, 1)), class = "rotdyn_error_missing")
  expect_error(hit(coefficient = "elastic"), class = "rotdyn_error_value")
  expect_error(hit(velocity_2_m_per_s = c(1, 0, 0)), class = "rotdyn_error_argument")
  expect_error(hit(attitude_1 = diag(4)[1:2, ] * 2), class = "rotdyn_error_value")
  expect_error(hit(speed = 1), class = "rotdyn_error_argument")
  expect_error(
    hit(normal = diag(3)[c(3, 3), ], friction = c(0.1, 0.2, 0.3)), class = "rotdyn_error_size"
  )
  expect_error(
    hit(body_1 = body_rod(1, 1), arm_1_m = c(0.1, 0.1, 0)), class = "rotdyn_error_value"
  )
  expect_identical(hit(friction = matrix(c(0.1, 0.2), 1))$sticks, c(TRUE, TRUE))
  expect_error(collision_ledger(factor("a")), class = "rotdyn_error_type")
  expect_error(collide(ball), class = "rotdyn_error_missing")
  expect_warning(
    beyond <- hit(
      velocity_1_m_per_s = c(1e308, 0, -1), omega_1_rad_per_s = c(0, -1e308, 0), friction = 0.1,
      arm_1_m = c(0, 0, -10)
    ), class = "rotdyn_warning_range"
  )
  expect_true(is.nan(beyond$vx_1_m_per_s))
  # The speed of the contact along the normal alone is no number: inf - inf.
  expect_warning(
    beyond <- hit(
      omega_1_rad_per_s = c(1e308, 1e308, 0), arm_1_m = c(10, 10, 0)
    ), class = "rotdyn_warning_range"
  )
  expect_true(is.nan(beyond$vz_1_m_per_s))
})

test_that("a normal along which the bodies separate is refused, with the rule of its sign", {
  ball <- body_sphere(1, 0.1)
  expect_error(
    collide(ball, ball, velocity_1_m_per_s = c(2, 0, 0), normal = c(1, 0, 0)),
    "out of body 2 .*into body 1.*apart along it at 2 m/s", class = "rotdyn_error_value"
  )
  # The other sign is the collision: equal balls exchange their velocities.
  hit <- collide(ball, ball, velocity_1_m_per_s = c(2, 0, 0), normal = c(-1, 0, 0))
  expect_equal(c(hit$vx_1_m_per_s, hit$vx_2_m_per_s), c(0, 2))
  expect_error(
    collide(
      ball, velocity_1_m_per_s = rbind(c(0, 0, -1), c(0, 0, 0), c(0, 0, 3)), normal = c(0, 0, 1)
    ), "row 3", class = "rotdyn_error_value"
  )
  # The rotation alone separates the points of contact.
  spin <- function(omega_y) {
    collide(
      body_rod(1, 1), omega_1_rad_per_s = c(0, omega_y, 0), velocity_1_m_per_s = c(0, 0, 0),
      normal = c(0, 0, 1), arm_1_m = c(0.5, 0, 0)
    )
  }
  expect_error(spin(-1), "at 0.5 m/s", class = "rotdyn_error_value")
  expect_gt(spin(1)$normal_impulse_n_s, 0)
  # And that of body 2, a rod along x: its contact rises by 0.5 m/s, and 1/m1 + 1/m2 + 0.25 m^2/I2
  # is 1 + 1 + 3.
  lift <- function(omega_y) {
    collide(
      ball, body_rod(1, 1), omega_2_rad_per_s = c(0, omega_y, 0), velocity_1_m_per_s = c(0, 0, 0),
      normal = c(0, 0, 1), arm_2_m = c(0.5, 0, 0), restitution = 0
    )
  }
  expect_error(lift(1), "at 0.5 m/s", class = "rotdyn_error_value")
  expect_equal(lift(-1)$normal_impulse_n_s, 0.5 / 5, tolerance = 1e-14)
  # Without approach, also within the rounding of large velocities, nothing happens.
  along <- collide(
    ball, ball, velocity_1_m_per_s = c(1e8, 0.1, 0), velocity_2_m_per_s = c(1e8, -3, 0),
    normal = c(1, 1e-9, 0)
  )
  expect_equal(along$normal_impulse_n_s, 0)
  # NA is no separation.
  expect_true(is.na(collide(
    ball, velocity_1_m_per_s = c(0, 0, NA), normal = c(0, 0, 1)
  )$vz_1_m_per_s))
})

test_that("spheres in a list need no arm, and have their rims in the picture", {
  balls <- list(body_sphere(1, 0.1), body_sphere(3, 0.2), body_spherical_shell(1, 0.3))
  at <- list(
    balls, body_sphere(1, 0.5), velocity_1_m_per_s = c(0, 1, -2), normal = c(0, 0, 1),
    friction = 0.02
  )
  all <- do.call(collide, at)
  given <- do.call(collide, c(at, list(arm_1_m = cbind(0, 0, -c(0.1, 0.2, 0.3)))))
  expect_identical(lapply(all, identity), lapply(given, identity))
  # The friction mu J turns a solid ball by mu J R/I, against the slip.
  expect_equal(
    all$omega_x_1_rad_per_s[2], -0.02 * all$normal_impulse_n_s[2] * 0.2 / (0.4 * 3 * 0.04),
    tolerance = 1e-14
  )
  # A normal for each ball.
  tilted <- diag(3)[c(3, 3, 3), ] + cbind(c(0, 0.1, 0.2), 0, 0)
  each <- do.call(collide, utils::modifyList(at, list(normal = tilted)))
  one <- do.call(collide, utils::modifyList(at, list(
    normal = tilted[2, ]
  )))
  expect_equal(each$vz_1_m_per_s[2], one$vz_1_m_per_s[2], tolerance = 1e-15)
  expect_error(
    do.call(collide, utils::modifyList(at, list(normal = tilted[1:2, ]))),
    class = "rotdyn_error_size"
  )
  expect_error(
    collide(
      list(body_sphere(1, 1), body_box(1, 1, 1, 1)), velocity_1_m_per_s = c(0, 0, -1),
      normal = c(0, 0, 1)
    ), class = "rotdyn_error_missing"
  )
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(all, row = 2), "ggplot")
})

test_that("the length of the normal does not count, however small or large", {
  ball <- body_sphere(1, 0.1)
  hit <- function(size) {
    collide(
      ball, ball, velocity_1_m_per_s = c(2, 0.3, 0), normal = size * c(-1, 0.5, 0.25),
      friction = 0.1, restitution = 0.5
    )
  }
  plain <- hit(1)
  for (size in c(1e-300, 1e-160, 1e160, 1e300)) {
    expect_equal(as.list(hit(size)), as.list(plain), tolerance = 1e-15)
    expect_true(all(audit(hit(size))$verdict == "balanced"))
  }
})

test_that("creates_energy is no matter of rounding", {
  set.seed(5)
  n <- 400
  vectors <- function(size = 1) matrix(stats::rnorm(3 * n, sd = size), n)
  rod <- body_cylinder(2, 0.02, 0.5)
  for (law in c("energetic", "kinetic", "kinematic")) {
    # Without friction the three coefficients agree: at e = 1 nothing is lost or won.
    hit <- collide(
      rod, rod, velocity_1_m_per_s = vectors(3), velocity_2_m_per_s = vectors(3),
      omega_1_rad_per_s = vectors(30), normal = vectors(), arm_1_m = vectors(0.1),
      arm_2_m = vectors(0.1), coefficient = law, separating = "keep"
    )
    expect_false(any(hit$creates_energy))
    expect_gt(sum(hit$normal_impulse_n_s > 0), 100)
  }
  # What is created is still said: grip and Newton's coefficient.
  made <- collide(
    rod, velocity_1_m_per_s = vectors(3), omega_1_rad_per_s = vectors(30), normal = vectors(),
    arm_1_m = vectors(0.1), friction = Inf, coefficient = "kinematic", separating = "keep"
  )
  expect_gt(sum(made$creates_energy), 5)
  i <- which(made$creates_energy)[1]
  ledger <- collision_ledger(made, row = i)
  energy <- ledger[ledger$balance == "energy", ]
  expect_gt(energy$after - energy$before, 1e-6)
})

test_that("rows of attitudes must have length 1 to eight digits", {
  rows <- function(off) rotdyn:::as_attitudes(rbind(c(1, 0, 0, 0), c(0, 1 + off, 0, 0)), "q", NULL)
  expect_equal(dim(rows(5e-9)), c(2, 9))
  expect_equal(rows(5e-9)[2, ], c(1, 0, 0, 0, -1, 0, 0, 0, -1), tolerance = 1e-15)
  expect_error(rows(2e-8), "row 2 is off", class = "rotdyn_error_value")
  expect_error(rows(-1e-6), "row 2 is off", class = "rotdyn_error_value")
})

test_that("a closing speed beyond double precision, along the normal or across it, is no answer", {
  ball <- body_sphere(1, 0.1)
  far <- 1.7e308
  for (v in list(c(far, 0, 0), c(1, far, 0), c(1, 0, far))) {
    expect_warning(
      hit <- collide(ball, ball, velocity_1_m_per_s = v, velocity_2_m_per_s = -v,
        normal = c(-1, 0, 0)),
      "double precision"
    )
    expect_true(is.nan(hit$vx_1_m_per_s) && is.nan(hit$impulse_x_n_s))
  }
  # An impulse of friction alone, on a body that comes to roll.
  for (across in list(c(far, 0, -1), c(0, far, -1))) {
    expect_warning(
      hit <- collide(
        body_sphere(10, 0.1), velocity_1_m_per_s = across, normal = c(0, 0, 1), friction = Inf
      ),
      class = "rotdyn_warning_range"
    )
    expect_true(is.nan(hit$vz_1_m_per_s) && is.nan(hit$friction_impulse_n_s))
  }
})

test_that("a moment about the axis of a rod is none only to rounding", {
  struck <- function(aside) {
    collide(
      body_rod(2, 1), velocity_1_m_per_s = c(0, 0, -2), normal = c(0, 0, 1),
      arm_1_m = c(0.3, aside, 0)
    )
  }
  expect_equal(struck(1e-14)$normal_impulse_n_s, struck(0)$normal_impulse_n_s)
  expect_error(struck(1e-10), class = "rotdyn_error_value")
})
