rolls <- function(body, ...) {
  expect_s3_class(scene_incline(body, 10, radius_m = 0.1, ...), "rot_scene_incline")
}
refused <- function(body, what) {
  expect_error(
    scene_incline(body, 10, radius_m = 0.1), what, class = "rotdyn_error_value"
  )
}

test_that("bodies that are not round about z are refused, with a remedy", {
  for (body in list(
    body_box(1, 0.2, 0.2, 0.2), body_cube(1, 0.2), body_box_shell(1, 0.2, 0.2, 0.2),
    body_rod(1, 0.2), body_rod_end(1, 0.2), body_half_disk(1, 0.1), body_half_cylinder(1, 0.1, 1),
    body_half_hoop(1, 0.1), body_rectangle(1, 0.2, 0.2), body_triangle(1, 0.2, 0.2),
    body_elliptic_plate(1, 0.1, 0.11), body_elliptic_cylinder(1, 0.1, 0.11, 1),
    body_ellipsoid(1, 0.1, 0.11, 0.1), body_polygon_prism(1, 0.1, 6, 1),
    body_polygon_plate(1, 0.1, 12), body_pyramid(1, 0.2, 0.2, 0.2),
    body_regular_tetrahedron(1, 0.2), body_regular_octahedron(1, 0.2), body_point(1, 0.1),
    body_polygon(1, rbind(c(-1, -1), c(1, -1), c(1, 1), c(-1, 1)) / 10),
    join_bodies(body_box(1, 0.2, 0.2, 0.2), place_body(body_box(1, 0.1, 0.1, 0.1), c(0, 0, 1)))
  )) refused(body, "round about its own z axis")
  # A cylinder that lies across: its axis is along x.
  across <- place_body(body_cylinder(1, 0.1, 0.5), rotation = rotation_about("y", angle_deg = 90))
  refused(across, "not along z")
  expect_error(scene_incline(body_cube(1, 0.2), 10), class = "rotdyn_error_value")
})

test_that("round bodies roll, wherever they are placed", {
  for (body in list(
    body_sphere(1, 0.1), body_disk(1, 0.1), body_hoop(1, 0.1), body_cylinder(1, 0.1, 1),
    body_tube(1, 0.1, 1), body_thick_tube(1, 0.1, 0.05, 1), body_annulus(1, 0.1, 0.05),
    body_hollow_sphere(1, 0.1, 0.05), body_spherical_shell(1, 0.1), body_torus(1, 0.1, 0.02),
    body_capsule(1, 0.1, 0.2), body_elliptic_cylinder(1, 0.1, 0.1, 1),
    body_polygon_plate(1, 0.1, 100),
    place_body(body_disk(1, 0.1), c(3, -2, 1)),
    place_body(body_sphere(1, 0.1), c(3, 0, 0), rotation_about("x", angle_deg = 40)),
    place_body(body_cylinder(1, 0.1, 1), c(3, 0, 0), rotation_about("x", angle_deg = 180)),
    body_tensor(1, c(1, 1, 0.2) / 100)
  )) rolls(body)
})

test_that("the outline of a body of given numbers is unknown, whatever its name", {
  measured <- body_box(1, 0.2, 0.2, 0.2)
  measured$provenance <- "tensor"
  expect_null(round_parts(measured))
  rolls(measured)
})

test_that("a compound rolls about the axis of a round part, through its centre of mass", {
  wheel <- body_disk(2, 0.1)
  weight <- body_point(0.1)
  refused(join_bodies(wheel, place_body(weight, c(0.05, 0, 0))), "0.00238.* m beside")
  # As far off as a millionth of the radius.
  refused(join_bodies(wheel, place_body(weight, c(2.1e-6, 0, 0))), "beside")
  # Balanced by a second weight, or above the centre.
  rolls(join_bodies(
    wheel, place_body(weight, c(0.05, 0, 0)), place_body(weight, c(-0.05, 0, 0))
  ))
  rolls(join_bodies(wheel, place_body(weight, c(0, 0, 0.3))))
  # The centre of the whole wheel may be anywhere.
  rolls(place_body(join_bodies(wheel, weight), c(5, 6, 7)))
  # A hole off the axis; two of them opposite.
  hole <- function(x) place_body(body_disk(0.02, 0.01), c(x, 0, 0))
  refused(cut_body(wheel, hole(0.05)), "beside")
  rolls(cut_body(cut_body(wheel, hole(0.05)), hole(-0.05)))
  # A box on a round shaft rolls on the shaft.
  rolls(join_bodies(body_box(1, 0.5, 0.5, 0.1), body_cylinder(1, 0.1, 1)))
  # Two wheels side by side have their centre of mass on neither axis.
  refused(join_bodies(wheel, place_body(wheel, c(0.3, 0, 0))), "0.15 m beside")
  # A part of unknown outline: the wheel counts, else the own z axis.
  rolls(join_bodies(wheel, body_tensor(1, c(1, 1, 1) / 100)))
  refused(join_bodies(wheel, place_body(body_tensor(1, c(1, 1, 1) / 100), c(0.1, 0, 0))), "beside")
  rolls(join_bodies(body_tensor(1, c(1, 1, 1) / 100), weight))
})

test_that("meshes and polygons count as round where their corners lie on a circle", {
  prism <- function(n, a = 1, b = 1) {
    angle <- 2 * pi * seq_len(n) / n
    ring <- cbind(0.1 * a * cos(angle), 0.1 * b * sin(angle))
    next_one <- c(seq_len(n)[-1], 1L)
    side <- seq_len(n)
    list(
      vertices = rbind(cbind(ring, -0.02), cbind(ring, 0.02), c(0, 0, -0.02), c(0, 0, 0.02)),
      faces = rbind(
        cbind(side, next_one, next_one + n), cbind(side, next_one + n, side + n),
        cbind(next_one, side, 2 * n + 1), cbind(side + n, next_one + n, 2 * n + 2)
      )
    )
  }
  mesh <- function(...) body_mesh(prism(...), density_kg_m3 = 1000)
  rolls(mesh(24))
  refused(mesh(6), "round about")
  refused(mesh(24, 1, 1.02), "round about")
  rolls(place_body(mesh(24), c(1, 2, 3)))
  refused(join_bodies(mesh(24), place_body(body_point(0.5), c(0.05, 0, 0))), "beside")
  angle <- 2 * pi * (1:100) / 100
  rolls(body_polygon(1, 0.1 * cbind(cos(angle), sin(angle))))
  refused(body_polygon(1, 0.1 * cbind(cos(angle), 0.9 * sin(angle))), "round about")
})

test_that("a ball that bounces is round, too", {
  bounce <- function(body) ball_bounce(body, 1, -1)
  expect_s3_class(bounce(body_sphere(1, 0.1)), "rot_collision")
  expect_error(bounce(body_box(1, 0.1, 0.1, 0.1)), class = "rotdyn_error_value")
})

test_that("a centre beside the axis is taken as on it within four errors of the body", {
  wheel <- body_tensor(1, diag(rep(0.4, 3)))
  wheel$error <- 1e-3
  size <- sqrt(sum(diag(wheel$second_moment_kg_m2)))
  beside <- function(errors) {
    wheel$centre_m[1] <- errors * 1e-3 * size
    rotdyn:::check_rolls(wheel, NULL)
  }
  expect_s3_class(beside(3.9), "rot_body")
  expect_error(beside(4.1), class = "rotdyn_error_value")
})
