bounce <- function(...) {
  ball_bounce(
    body_sphere(0.06, 0.033), vx_m_per_s = 20, vy_m_per_s = -5, omega_rad_per_s = -300,
    restitution = 0.75, friction = 0.5, ...
  )
}

test_that("the ledger of a bounce, by hand", {
  ledger <- collision_ledger(bounce())
  expect_s3_class(ledger, "rot_ledger")
  expect_equal(ledger$balance, c("momentum_x", "momentum_y", "angular_momentum_z", "energy"))
  # J_n = 1.75 * 0.06 * 5, friction slides: J_t = -J_n/2.
  expect_equal(ledger$before, c(1.2, -0.3, -1.2 * 0.033 + 0.4 * 0.06 * 0.033^2 * 300,
    12.75 + 0.2 * 0.06 * 0.033^2 * 9e4), tolerance = 1e-14)
  expect_equal(ledger$change[1:2], c(-0.2625, 0.525), tolerance = 1e-14)
  expect_equal(ledger$change[3], 0)
  expect_equal(ledger$dissipated[4], 0.5 * 0.06 * 25 * (1 - 0.75^2) + sum(0.2625 * (
    29.9 + (29.9 - 0.2625 / 0.06 * 3.5)) / 2), tolerance = 1e-14)
  expect_true(all(ledger$verdict == "balanced"))
  expect_setequal(setdiff(names(ledger), column_table()$name), character())
  centre <- collision_ledger(bounce(), about = "the centre")
  expect_equal(centre$supplied[3], 0.033 * -0.2625, tolerance = 1e-14)
  expect_equal(centre$verdict[3], "balanced")
  elsewhere <- collision_ledger(bounce(), about = c(1, 2, 0))
  expect_equal(elsewhere$supplied[3], -(1 * 0.525 - 2 * -0.2625), tolerance = 1e-13)
  expect_true(all(elsewhere$verdict == "balanced"))
})

test_that("every kind of collision balances about every point that it names", {
  hits <- list(
    bounce(tangential_restitution = 0.5), hinged_hit(body_rod(2, 1.2), 0.6, 1.1, 0.05, 30, 0.4, -1),
    disks_lock(1, 3, 60, -10), rims_meet(1, 3, 60, 5, radius_1_m = 0.1, radius_2_m = 0.25),
    rims_meet(
      1, 3, 60, 5, largest_impulse_n_s = 1, radius_1_m = 0.1, radius_2_m = -0.25
    ),
    collide(
      body_box(1, 1, 2, 3), body_box(2, 1, 1, 1), velocity_1_m_per_s = c(1, 2, -3),
      omega_1_rad_per_s = c(1, 2, 3), normal = c(0.1, 0, 1), arm_1_m = c(0.5, 0.2, -1.4),
      arm_2_m = c(0.2, 0.1, 0.5), restitution = 0.4, friction = 0.3
    )
  )
  for (hit in hits) {
    expect_gt(sum(hit[["normal_loss_j"]], hit[["friction_loss_j"]]), 0)
    for (about in names(attr(hit, "collision")$about)) {
      a <- audit(hit, about = about)
      expect_s3_class(a, "rot_audit")
      expect_true(all(a$verdict == "balanced"))
    }
    expect_true(all(collision_ledger(hit, about = c(3, -2, 1))$verdict == "balanced"))
    expect_output(print(collision_ledger(hit)), "<rot_ledger> balanced")
  }
})

test_that("an edited velocity shows; changed rows are a plain tibble", {
  two <- ball_bounce(body_sphere(1, 0.1), c(1, 2), -1, 0, 0.5, 0.1)
  expect_equal(collision_ledger(two, 2)$before[1], 2)
  edited <- two
  edited$vx_m_per_s[2] <- edited$vx_m_per_s[2] * (1 + 1e-9)
  expect_true(all(collision_ledger(edited, 1)$verdict == "balanced"))
  expect_true("unbalanced" %in% collision_ledger(edited, 2)$verdict)
  # So does a loss that is wrong by what twelve digits leave.
  edited <- two
  edited$normal_loss_j[2] <- edited$normal_loss_j[2] * (1 + 1e-12)
  expect_true("unbalanced" %in% collision_ledger(edited, 2)$verdict)
  expect_false(inherits(two[2:1, ], "rot_collision"))
  expect_false(inherits(two["sticks"], "rot_collision"))
  expect_s3_class(two[1:2, ], "rot_collision")
  expect_error(collision_ledger(two[1, ]), class = "rotdyn_error_type")
  expect_error(collision_ledger(two, 3), class = "rotdyn_error_value")
  expect_error(collision_ledger(two, about = "the moon"), class = "rotdyn_error_value")
  expect_error(collision_ledger(two, about = 1), class = "rotdyn_error_size")
  expect_error(collision_ledger(1), class = "rotdyn_error_type")
  expect_error(collision_ledger(), class = "rotdyn_error_missing")
  damaged <- two
  attr(damaged, "collision")$parties <- 1
  expect_error(collision_ledger(damaged), class = "rotdyn_error_type")
  gone <- ball_bounce(body_sphere(1, 0.1), NA, -1)
  expect_true(anyNA(collision_ledger(gone)$verdict))
  expect_output(print(collision_ledger(gone)), "not known")
  skip_if_not_installed("dplyr")
  expect_s3_class(dplyr::mutate(two, case = 1), "rot_collision")
  expect_false(inherits(dplyr::filter(two, vx_m_per_s > 1), "rot_collision"))
  expect_false(inherits(dplyr::arrange(two, -vx_m_per_s), "rot_collision"))
})

test_that("a ledger prints each balance once, the energy last", {
  lines <- utils::capture.output(print(collision_ledger(bounce())))
  names <- c("momentum x", "momentum y", "angular momentum z", "energy \\(J\\)")
  at <- vapply(names, function(name) {
    found <- grep(paste0("^ *", name), lines)
    if (length(found) == 1L) found else NA_integer_
  }, 1L)
  expect_false(is.unsorted(at, na.rm = FALSE))
  expect_match(lines[at[1]], "1\\.2 +0\\.9375")
})

test_that("a ledger prints within 80 columns", {
  hits <- list(
    collide(
      body_sphere(1, 0.1), body_sphere(2, 0.1), velocity_1_m_per_s = c(2, 0.3, 0),
      normal = c(-1, 0, 0), restitution = 0.5
    ),
    hinged_hit(body_rod_end(1, 1), 0.5, 0.9, 0.05, 5), disks_lock(1, 3, 60, 0)
  )
  for (hit in hits) {
    shown <- capture.output(print(collision_ledger(hit)))
    expect_lte(max(nchar(shown)), 80)
    expect_match(shown[2], "before +after +outside +lost$")
  }
})

test_that("rims meet between the axles", {
  met <- rims_meet(1, 3, 60, 5, radius_1_m = 0.1, radius_2_m = 0.25)
  expect_equal(attr(met, "collision")$contact, cbind(0.1, 0, 0))
})

test_that("a light touch of fast bodies has the rounding of their energy alone", {
  ball <- body_sphere(1, 0.1)
  touch <- collide(
    ball, ball, velocity_1_m_per_s = c(1, 0, 0), velocity_2_m_per_s = c(1 - 1e-6, 0, 0),
    normal = c(-1, 0, 0), restitution = 1
  )
  ledger <- collision_ledger(touch)
  # 32 roundings of the 1 J before and the 1 J after.
  energy <- ledger$rounding[ledger$balance == "energy"]
  expect_lt(energy, 1.01 * 64 * .Machine$double.eps)
  expect_gt(energy, 0.99 * 64 * .Machine$double.eps)
})

test_that("the momentum of a bounce has some ten roundings of its terms", {
  ledger <- collision_ledger(bounce())
  eps <- .Machine$double.eps
  # The ball before (faster than after), and the table's impulses.
  p <- 0.06 * sqrt(20^2 + 5^2) + sqrt(0.525^2 + 0.2625^2)
  expect_equal(ledger$rounding[1:2], rep(16 * eps * p, 2), tolerance = 1e-12)
  # About the contact: the spin 2/5 m r^2 omega, and the momentum with its arm of 0.033 m.
  l <- 0.4 * 0.06 * 0.033^2 * 300 + 0.033 * 0.06 * sqrt(20^2 + 5^2) + 0.033 * p
  expect_equal(ledger$rounding[3], 32 * eps * l, tolerance = 1e-12)
})

test_that("a row of NA is printed", {
  ledger <- collision_ledger(ball_bounce(body_sphere(1, 0.1), 1, -1))
  expect_output(print(ledger[c(1, NA), ]), "rot_ledger")
})
