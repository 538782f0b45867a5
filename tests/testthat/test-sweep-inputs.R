wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = 0.03))

test_that("inputs are the numbers of the constructors, with units and domains", {
  found <- sweep_inputs(wheel)
  expect_named(found, c("input", "unit", "value", "domain", "meaning"))
  row <- function(path) found[found$input == path, ]
  expect_identical(row("body$mass_kg")$value, 2)
  expect_identical(row("body$radius_m")$unit, "m")
  expect_identical(row("body$mass_kg")$domain, ">= 0")
  expect_identical(row("body")$domain, "> 0")
  expect_identical(row("resistance$viscous_n_m_s")$domain, "any")
  expect_identical(row("torque")$value, 0.8)
  expect_identical(row("axis[3]")$value, 0)
  # Terms of a resistance that an axle does not take are no inputs; nor is what is derived.
  expect_false(any(grepl("damping_per_s|drag_n_s|second_moment|inertia", found$input)))
  expect_identical(
    sweep_inputs(scene_incline(body_sphere(1, 0.1), 20))$domain[2:4], c(">= 0", ">= 0", "-90 to 90")
  )
})

test_that("paths lead through lists, vectors and parts in parts", {
  drive <- scene_drive(
    list(body_disk(1, 0.2), 0.3), list(coupling_shaft(10, 0.1)),
    torque = list(NULL, torque_knots(c(0, 1), c(0, 2)))
  )
  known <- sweep_inputs(drive)
  expect_true(all(c(
    "bodies[1]$radius_m", "bodies[2]", "couplings[1]$stiffness_n_m_per_rad",
    "torque[2]$time_s[2]", "torque[2]$torque_n_m[2]"
  ) %in% known$input))
  expect_false(any(c("bodies", "torque") %in% known$input))
  expect_identical(known$value[known$input == "torque[2]$torque_n_m[2]"], 2)
  top <- scene_pivot(c(0.0042, 0.0042, 0.002), c(0, 0, 60), mass_kg = 0.5, centre_m = c(0, 0, 0.08))
  known <- sweep_inputs(top)
  expect_identical(known$value[known$input == "omega0_rad_per_s[3]"], 60)
  # A vector that was not given has its default.
  expect_identical(known$value[startsWith(known$input, "attitude0")], c(1, 0, 0, 0))
  joined <- scene_free(
    join_bodies(body_box(1, 0.1, 0.2, 0.3), list(place_body(body_sphere(1, 0.1), c(1, 0, 0)))),
    c(1, 2, 3)
  )
  expect_true("body$bodies[2]$at_m[1]" %in% sweep_inputs(joined)$input)
})

test_that("a scene with R functions has inputs, and numbers that no text shows have none", {
  pushed <- scene_axle(0.1, function(time_s) sin(time_s))
  expect_true("body" %in% sweep_inputs(pushed)$input)
  turn <- rotation_about(c(1, 2, 3), angle_rad = 1)
  moved <- place_body(body_box(1, 0.1, 0.2, 0.3), c(0.1, 0.2, 0.3), turn)
  joined <- join_bodies(moved, list(moved, body_sphere(1, 0.1)))
  known <- sweep_inputs(scene_free(joined, c(1, 0, 0)))
  expect_false(any(grepl("size_m|frame|second_moment", known$input)))
})

test_that("outputs have the units of the dictionary, and those of copies a number", {
  found <- sweep_outputs(wheel)
  expect_named(found, c("output", "unit", "meaning"))
  expect_identical(found$unit[found$output == "final_omega_rad_per_s"], "rad/s")
  expect_identical(found$unit[found$output == "lost_j"], "J")
  expect_false(anyNA(found$unit))
  expect_true(all(c("first_stick_time_s", "n_reverse", "stop_time_s") %in% found$output))
  rotors <- scene_rotors(c(1, 2), 10)
  expect_true("final_theta_rad[2]" %in% sweep_outputs(rotors)$output)
  expect_false(any(c("final_theta_rad", "stop_time_s") %in% sweep_outputs(rotors)$output))
  expect_true("first_flip_time_s" %in% sweep_outputs(scene_free(c(1, 2, 3), c(0, 1, 0.1)))$output)
})

test_that("what is no scene is refused", {
  expect_error(sweep_inputs(3), class = "rotdyn_error_type")
  expect_error(sweep_outputs(), class = "rotdyn_error_missing")
  expect_error(sweep_inputs(wheel, 2), class = "rotdyn_error_argument")
})

test_that("what a constructor made of other inputs follows them", {
  ball <- body_sphere(6, 0.108)
  lane <- function(v, ...) suppressMessages(scene_incline(ball, 1, v0_m_per_s = v, ...))
  final <- c("x_m", "omega_rad_per_s")
  of <- function(scene, design) {
    plan <- sweep_plan(scene, 2, design, outputs = paste0("final_", final), audit_rows = 0)
    rows <- suppressMessages(sweep_run(plan))
    matrix(unlist(rows[paste0("final_", final)]), ncol = 2)
  }
  last <- function(scene) unlist(trajectory(scene, c(0, 2))[2, final], use.names = FALSE)
  speeds <- c(0, 3)
  rolling <- of(lane(2), design_grid(v0_m_per_s = speeds))
  expect_identical(rolling, rbind(last(lane(0)), last(lane(3))))
  # Given numbers stay, and what varies has its own.
  sliding <- function(v) lane(v, omega0_rad_per_s = 5, static_friction = 0.3)
  given <- of(sliding(2), design_grid(v0_m_per_s = speeds))
  slides <- lapply(speeds, function(v) last(sliding(v)))
  expect_identical(given, do.call(rbind, slides))
  both <- of(lane(2, static_friction = 0.3), design_grid(v0_m_per_s = 3, omega0_rad_per_s = 4))
  expect_identical(both[1, ], last(lane(3, omega0_rad_per_s = 4, static_friction = 0.3)))
  # The radius of the body, on which it rolls.
  small <- of(lane(2), design_grid("body$radius_m" = c(0.05, 0.108)))
  expect_identical(
    small[1, ],
    last(suppressMessages(scene_incline(body_sphere(6, 0.05), 1, v0_m_per_s = 2)))
  )
})

test_that("numbers are shown with six digits", {
  expect_identical(format_each(c(1 / 3, 2e7 / 3, 5)), c("0.333333", "6666667", "5"))
})
