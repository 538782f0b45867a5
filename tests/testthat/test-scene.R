test_that("the moment of inertia is that about the axle", {
  disk <- body_disk(2, 3)
  expect_equal(scene_axle(disk)$moment_of_inertia_kg_m2, 9)
  expect_equal(scene_axle(disk, axis = c(5, 0, 0))$moment_of_inertia_kg_m2, 4.5)
  expect_equal(scene_axle(disk, axis = c(1e-200, 0, 1e-200))$moment_of_inertia_kg_m2, 6.75)
  expect_equal(scene_axle(0.7)$moment_of_inertia_kg_m2, 0.7)
})

test_that("without inertia about the axle there is no motion", {
  expect_error(scene_axle(body_disk(0, 1)), class = "rotdyn_error_value")
  expect_error(scene_axle(body_rod(1, 1), axis = c(1, 0, 0)), class = "rotdyn_error_value")
  expect_error(scene_axle(0), class = "rotdyn_error_value")
  expect_error(scene_axle(-1), class = "rotdyn_error_value")
  expect_error(scene_axle("disk"), class = "rotdyn_error_type")
  expect_error(scene_axle(body_disk(1, 1), axis = c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(scene_axle(1, omega0_rad_per_s = Inf), class = "rotdyn_error_value")
})

test_that("a scene prints itself", {
  expect_snapshot(article_scene(omega0_rad_per_s = 3, start_s = -1))
})

test_that("an axle goes through the centre, or the point that is asked for", {
  rod <- body_rod_end(2, 3)
  expect_message(centre <- scene_axle(rod), class = "rotdyn_message_axle")
  expect_equal(centre$moment_of_inertia_kg_m2, 2 * 3^2 / 12)
  expect_no_message(end <- scene_axle(rod, through = "origin"))
  expect_equal(end$moment_of_inertia_kg_m2, 2 * 3^2 / 3)
  expect_no_message(same <- scene_axle(rod, through = "centre"))
  expect_equal(same$moment_of_inertia_kg_m2, 2 * 3^2 / 12)
  aside <- place_body(body_disk(2, 0.5), c(1, 2, 7))
  expect_equal(scene_axle(aside, through = "origin")$moment_of_inertia_kg_m2, 0.25 + 2 * 5)
  expect_equal(scene_axle(aside, through = c(1, 0, 0))$moment_of_inertia_kg_m2, 0.25 + 2 * 4)
  expect_equal(
    scene_axle(aside, axis = "x", through = "origin")$moment_of_inertia_kg_m2, 0.125 + 2 * 53
  )
  expect_equal(
    scene_axle(body_rod(1.5, 2), axis = "y", through = c(0, 5, 0))$moment_of_inertia_kg_m2, 0.5
  )
  # Along the axle a place is of no account.
  expect_no_message(scene_axle(place_body(body_disk(2, 0.5), c(0, 0, 7))))
  expect_no_message(scene_axle(body_cone(1, 0.5, 2)))
  expect_error(scene_axle(rod, through = "end"), class = "rotdyn_error_value")
  expect_error(scene_axle(rod, through = 1), class = "rotdyn_error_size")
})

test_that("an axis is checked where it has no effect, too", {
  expect_error(scene_axle(1, axis = "nonsense"), class = "rotdyn_error_value")
  expect_error(scene_axle(1, axis = c(0, 0, 0)), class = "rotdyn_error_value")
  expect_error(scene_pendulum(1, 1, axis = "nonsense"), class = "rotdyn_error_value")
})
