# ---- meshes to try ------------------------------------------------------------------------------

corner <- function(at = c(0, 0, 0)) {
  list(
    vertices = sweep(rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)), 2, at, "+"),
    faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  )
}

box <- function(lo, hi) {
  v <- as.matrix(expand.grid(x = c(lo[1], hi[1]), y = c(lo[2], hi[2]), z = c(lo[3], hi[3])))
  quads <- rbind(
    c(1, 3, 4, 2), c(5, 6, 8, 7), c(1, 2, 6, 5), c(3, 7, 8, 4), c(1, 5, 7, 3), c(2, 4, 8, 6)
  )
  list(vertices = unname(v), faces = quads)
}

split_box <- function(...) {
  of <- box(...)
  list(vertices = of$vertices, faces = rbind(of$faces[, 1:3], of$faces[, c(1, 3, 4)]))
}

both <- function(a, b) {
  list(vertices = rbind(a$vertices, b$vertices), faces = rbind(a$faces, b$faces + nrow(a$vertices)))
}

flip <- function(mesh, which = seq_len(nrow(mesh$faces))) {
  mesh$faces[which, ] <- mesh$faces[which, rev(seq_len(ncol(mesh$faces)))]
  mesh
}

torus <- function(n = 24, m = 12, ring = 2, tube = 0.75) {
  at <- expand.grid(j = seq_len(m) - 1, i = seq_len(n) - 1)
  u <- 2 * pi * at$i / n
  v <- 2 * pi * at$j / m
  number <- function(i, j) (i %% n) * m + j %% m + 1
  list(
    vertices = cbind(
      (ring + tube * cos(v)) * cos(u), (ring + tube * cos(v)) * sin(u), tube * sin(v)
    ),
    faces = rbind(
      cbind(number(at$i, at$j), number(at$i + 1, at$j), number(at$i + 1, at$j + 1)),
      cbind(number(at$i, at$j), number(at$i + 1, at$j + 1), number(at$i, at$j + 1))
    )
  )
}

# Each face into four.
split_faces <- function(mesh) {
  f <- mesh$faces
  v <- mesh$vertices
  n <- nrow(v)
  k <- nrow(f)
  middle <- function(a, b) (v[f[, a], ] + v[f[, b], ]) / 2
  at <- n + seq_len(k)
  ab <- at
  bc <- at + k
  ca <- at + 2 * k
  list(
    vertices = rbind(v, middle(1, 2), middle(2, 3), middle(3, 1)),
    faces = rbind(
      cbind(f[, 1], ab, ca), cbind(f[, 2], bc, ab), cbind(f[, 3], ca, bc), cbind(ab, bc, ca)
    )
  )
}

turn <- function() {
  # About (1, 2, 2)/3 by 0.7 rad.
  n <- c(1, 2, 2) / 3
  k <- rbind(c(0, -n[3], n[2]), c(n[3], 0, -n[1]), c(-n[2], n[1], 0))
  diag(3) + sin(0.7) * k + (1 - cos(0.7)) * k %*% k
}

off <- function(got, want) max(abs(got - want)) / sum(diag(want))

failed <- function(check) check$condition[check$verdict == "fails"]

# ---- figures ------------------------------------------------------------------------------------

test_that("a tetrahedron is exact at any offset", {
  reference <- utils::read.csv(shared("refs", "tetrahedron.csv"))
  expect_equal(max(reference$offset), 1e8)
  for (i in seq_len(nrow(reference))) {
    want <- reference[i, ]
    body <- body_mesh(corner(rep(want$offset, 3)), density_kg_m3 = 1, length_unit = "m")
    inertia <- matrix(
      unlist(want[c(
        "Ixx_cm", "Ixy_cm", "Ixz_cm", "Ixy_cm", "Iyy_cm", "Iyz_cm", "Ixz_cm", "Iyz_cm", "Izz_cm"
      )]), 3
    )
    expect_lte(off(body$inertia_kg_m2, inertia), 1e-15)
    expect_lte(abs(body$mass_kg - 1), 1e-15)
    expect_ulps(unname(body$centre_m), c(want$cx, want$cy, want$cz), 1)
    expect_lte(body$error, 1e-13)
    # What half a last digit of a coordinate costs is told apart.
    expect_gt(body$detail$coordinate_error, want$offset * 2^-53)
  }
})

test_that("the meshes of MuJoCo's tests have the inertia of its formulas", {
  # google-deepmind/mujoco, test/user/user_mesh_test.cc: an open-top cup, 1 x 1 x 1 with a pocket of
  # 0.8 x 0.8 x 0.9; a cube of six plates; a cube; a tetrahedron.
  outer <- split_box(c(-0.5, -0.5, 0), c(0.5, 0.5, 1))
  pocket <- flip(split_box(c(-0.4, -0.4, 0.1), c(0.4, 0.4, 1)))
  # The lids (quad 2, faces 2 and 8) go, and a rim joins both.
  cup <- both(
    list(vertices = outer$vertices, faces = outer$faces[-c(2, 8), ]),
    list(vertices = pocket$vertices, faces = pocket$faces[-c(2, 8), ])
  )
  rim <- rbind(
    c(5, 6, 14), c(5, 14, 13), c(6, 8, 16), c(6, 16, 14), c(8, 7, 15), c(8, 15, 16), c(7, 5, 13),
    c(7, 13, 15)
  )
  cup$faces <- rbind(cup$faces, rim)
  body <- body_mesh(cup, density_kg_m3 = 2)
  expect_equal(body$mass_kg, 0.848, tolerance = 1e-15)
  expect_equal(body$centre_m[["z"]], 0.4320754716981131, tolerance = 1e-15)
  expect_equal(
    unname(diag(body$inertia_kg_m2)),
    c(0.1873408805031446, 0.1873408805031446, 0.21045333333333333),
    tolerance = 1e-14
  )
  cube <- box(c(0, 0, 0), c(1, 1, 1))
  shell <- body_mesh(cube, areal_density_kg_m2 = 1, method = "shell")
  expect_equal(shell$mass_kg, 6, tolerance = 1e-15)
  expect_equal(unname(diag(shell$inertia_kg_m2)), rep(5 / 3, 3), tolerance = 1e-15)
  expect_equal(
    unname(diag(body_mesh(cube, density_kg_m3 = 1)$inertia_kg_m2)), rep(1 / 6, 3),
    tolerance = 1e-15
  )
  unit <- corner()
  unit$vertices <- unit$vertices %*% diag(c(1, 1 / 2, 1 / 3))
  inertia <- body_mesh(unit, density_kg_m3 = 1000)$inertia_kg_m2
  expect_equal(
    unname(inertia), matrix(c(6, 1, 1, 1, 6, 1, 1, 1, 6) / 6 * 12.5, 3),
    tolerance = 1e-14
  )
})

test_that("size, reach and detail are those of the body", {
  body <- body_mesh(box(c(1, 2, 3), c(3, 5, 8)), density_kg_m3 = 0.5, name = "brick")
  expect_equal(body$shape, "brick")
  expect_equal(body$size_m, c(length_x_m = 2, length_y_m = 3, length_z_m = 5))
  expect_equal(unname(body$centre_m), c(2, 3.5, 5.5))
  expect_gte(body$reach_m, sqrt(38) / 2)
  expect_lte(body$reach_m, sqrt(38) / 2 * (1 + 1e-14))
  expect_equal(body$provenance, "mesh")
  expect_equal(body$error_kind, "bound")
  detail <- body$detail
  expect_equal(detail$volume_m3, 30)
  expect_equal(detail$area_m2, 62)
  expect_equal(detail$faces, 12)
  expect_equal(detail$parts, 1)
  expect_equal(detail$part_volume_m3, 30)
  expect_equal(detail$method, "solid")
  expect_lte(detail$closure, 1e-15)
  expect_false(detail$flipped)
  expect_length(detail$defects, 0)
  expect_s3_class(detail$check, "rot_mesh_check")
  expect_output(print(body), "mesh, exact integrals")
})

test_that("mass and density say the same", {
  mesh <- torus()
  by_density <- body_mesh(mesh, density_kg_m3 = 7.5)
  by_mass <- body_mesh(mesh, mass_kg = by_density$mass_kg)
  expect_equal(by_mass$inertia_kg_m2, by_density$inertia_kg_m2, tolerance = 1e-15)
  expect_equal(body_mesh(mesh, mass_kg = 0)$mass_kg, 0)
  expect_error(body_mesh(mesh), class = "rotdyn_error_missing")
  expect_error(body_mesh(mesh, mass_kg = 1, density_kg_m3 = 1), class = "rotdyn_error_value")
  expect_error(body_mesh(mesh, areal_density_kg_m2 = 1), class = "rotdyn_error_value")
  expect_error(
    body_mesh(mesh, density_kg_m3 = 1, method = "shell"),
    class = "rotdyn_error_value"
  )
  expect_error(body_mesh(mesh, mass_kg = -1), class = "rotdyn_error_value")
  expect_error(body_mesh(mesh, mass_kg = NA), class = "rotdyn_error_type")
  expect_error(body_mesh(), class = "rotdyn_error_missing")
  expect_error(body_mesh(mesh, 1), class = "rotdyn_error_argument")
})

# ---- what must change nothing -------------------------------------------------------------------

test_that("moving, turning, renaming and splitting leave the body what it is", {
  mesh <- torus()
  one <- body_mesh(mesh, mass_kg = 3)
  moved <- mesh
  moved$vertices <- sweep(mesh$vertices, 2, c(1000, -2000, 512), "+")
  body <- body_mesh(moved, mass_kg = 3)
  expect_lte(off(body$inertia_kg_m2, one$inertia_kg_m2), body$detail$coordinate_error)

  by <- turn()
  turned <- mesh
  turned$vertices <- mesh$vertices %*% t(by)
  body <- body_mesh(turned, mass_kg = 3)
  expect_lte(off(body$inertia_kg_m2, by %*% one$inertia_kg_m2 %*% t(by)), 2e-15)

  set.seed(4)
  order <- sample(nrow(mesh$vertices))
  renamed <- list(
    vertices = mesh$vertices[order, ],
    faces = matrix(match(mesh$faces, order), ncol = 3)[sample(nrow(mesh$faces)), c(2, 3, 1)]
  )
  body <- body_mesh(renamed, mass_kg = 3)
  expect_lte(off(body$inertia_kg_m2, one$inertia_kg_m2), 1e-15)

  body <- body_mesh(split_faces(mesh), mass_kg = 3)
  expect_equal(body$detail$faces, 4 * one$detail$faces)
  expect_lte(off(body$inertia_kg_m2, one$inertia_kg_m2), 2e-15)
  shell <- body_mesh(mesh, mass_kg = 3, method = "shell")
  body <- body_mesh(split_faces(mesh), mass_kg = 3, method = "shell")
  expect_lte(off(body$inertia_kg_m2, shell$inertia_kg_m2), 2e-15)
})

test_that("a mirror and faces inwards make no negative mass", {
  mesh <- corner()
  one <- body_mesh(mesh, density_kg_m3 = 2)
  inwards <- body_mesh(flip(mesh), density_kg_m3 = 2)
  expect_true(inwards$detail$flipped)
  expect_equal(inwards$mass_kg, one$mass_kg)
  expect_equal(inwards$inertia_kg_m2, one$inertia_kg_m2, tolerance = 1e-15)
  check <- check_mesh(flip(mesh))
  expect_equal(check$verdict[check$condition == "faces point outwards"], "note")
  mesh$vertices[, 1] <- -mesh$vertices[, 1]
  mirrored <- body_mesh(mesh, density_kg_m3 = 2)
  expect_true(mirrored$detail$flipped)
  expect_equal(mirrored$mass_kg, one$mass_kg)
  signs <- outer(c(-1, 1, 1), c(-1, 1, 1))
  expect_equal(mirrored$inertia_kg_m2, one$inertia_kg_m2 * signs, tolerance = 1e-15)
})

test_that("units of length give the same body, and sizes go to the ends", {
  mesh <- torus()
  one <- body_mesh(mesh, density_kg_m3 = 2)
  for (unit in c("mm", "cm", "in", "ft", "km")) {
    factor <- c(mm = 1e-3, cm = 0.01, "in" = 0.0254, ft = 0.3048, km = 1000)[[unit]]
    scaled <- list(vertices = mesh$vertices / factor, faces = mesh$faces)
    body <- body_mesh(scaled, density_kg_m3 = 2, length_unit = unit)
    expect_equal(body$mass_kg, one$mass_kg, tolerance = 1e-14)
    expect_lte(off(body$inertia_kg_m2, one$inertia_kg_m2), 5e-15)
    expect_equal(body$size_m, one$size_m, tolerance = 1e-14)
    expect_equal(body$reach_m, one$reach_m, tolerance = 1e-14)
    expect_equal(body$detail$area_m2, one$detail$area_m2, tolerance = 1e-14)
    expect_equal(body$detail$part_volume_m3, one$detail$part_volume_m3, tolerance = 1e-14)
  }
  for (size in c(1e-100, 1e100)) {
    scaled <- list(vertices = mesh$vertices * size, faces = mesh$faces)
    body <- body_mesh(scaled, mass_kg = one$mass_kg, length_unit = "m")
    expect_lte(off(body$inertia_kg_m2 / size / size, one$inertia_kg_m2), 5e-15)
    expect_lte(body$error, 1e-13)
  }
  expect_error(
    body_mesh(scaled, density_kg_m3 = 1e10, length_unit = "m"),
    class = "rotdyn_error_range"
  )
  expect_error(
    body_mesh(mesh, mass_kg = 1, length_unit = "kg"),
    class = "rotdyn_error_unit"
  )
  expect_error(body_mesh(mesh, mass_kg = 1, length_unit = 3), class = "rotdyn_error_type")
})

test_that("a body longer than 100 m is warned of, unless its unit was given", {
  mesh <- box(c(0, 0, 0), c(150, 20, 30))
  expect_warning(body_mesh(mesh, mass_kg = 1), class = "rotdyn_warning_unit")
  expect_no_warning(body_mesh(mesh, mass_kg = 1, length_unit = "m"))
  expect_no_warning(body_mesh(mesh, mass_kg = 1, length_unit = "mm"))
  expect_no_warning(body_mesh(box(c(0, 0, 0), c(99, 20, 30)), mass_kg = 1))
})

test_that("meshes of growing resolution come to the formula", {
  relative <- function(n) {
    body <- body_mesh(torus(n, n), mass_kg = 1)
    # Izz = R^2 + 3 a^2/4
    body$inertia_kg_m2[3, 3] / (4 + 0.75 * 0.5625) - 1
  }
  coarse <- relative(40)
  fine <- relative(80)
  expect_lt(abs(coarse), 0.02)
  expect_equal(coarse / fine, 4, tolerance = 0.03)
})

# ---- defects ------------------------------------------------------------------------------------

test_that("a missing, flipped, duplicated face is named with its count", {
  mesh <- split_box(c(0, 0, 0), c(1, 2, 3))
  expect_equal(failed(check_mesh(mesh)), character())
  open <- list(vertices = mesh$vertices, faces = mesh$faces[-5, ])
  expect_error(body_mesh(open, mass_kg = 1), "3 boundary edges", class = "rotdyn_error_mesh")
  expect_equal(failed(check_mesh(open)), "no boundary edges")
  expect_error(body_mesh(flip(mesh, 5), mass_kg = 1), "3 edges", class = "rotdyn_error_mesh")
  expect_equal(failed(check_mesh(flip(mesh, 5))), "consistent orientation")
  twice <- list(vertices = mesh$vertices, faces = mesh$faces[c(1:12, 5), ])
  expect_error(body_mesh(twice, mass_kg = 1), "1 duplicate face", class = "rotdyn_error_mesh")
  expect_equal(
    failed(check_mesh(twice)), c("no non-manifold edges", "no duplicate faces")
  )
  whole <- list(vertices = mesh$vertices, faces = mesh$faces[c(1:12, 1:12), ])
  expect_error(body_mesh(whole, mass_kg = 1), "12 duplicate faces", class = "rotdyn_error_mesh")
  # The condition carries the check.
  error <- tryCatch(body_mesh(open, mass_kg = 1), error = identity)
  expect_equal(error$check, check_mesh(open))
})

test_that("coordinates and faces that are nothing are refused by every method", {
  mesh <- corner()
  for (bad in c(NA, NaN, Inf)) {
    broken <- mesh
    broken$vertices[2, 3] <- bad
    for (method in c("solid", "shell", "box", "hull")) {
      expect_error(
        body_mesh(broken, mass_kg = 1, method = method), "1 vertex",
        class = "rotdyn_error_mesh"
      )
    }
  }
  for (bad in list(0, 5, -1, NA, 1.5, 1e12, Inf)) {
    broken <- mesh
    broken$faces[3, 2] <- bad
    for (method in c("solid", "shell", "box", "hull")) {
      expect_error(
        body_mesh(broken, mass_kg = 1, method = method), "1 face",
        class = "rotdyn_error_mesh"
      )
    }
  }
  none <- list(vertices = mesh$vertices, faces = mesh$faces[0, ])
  expect_error(body_mesh(none, mass_kg = 1), "no faces", class = "rotdyn_error_mesh")
  expect_error(
    body_mesh(list(vertices = mesh$vertices[0, ], faces = mesh$faces[0, ]), mass_kg = 1),
    class = "rotdyn_error_mesh"
  )
  expect_equal(failed(check_mesh(none)), "there are faces")
})

test_that("parts, cavities and parts inside out are told apart", {
  outer <- split_box(c(0, 0, 0), c(4, 4, 4))
  inner <- split_box(c(1, 1, 1), c(3, 3, 2))
  beside <- split_box(c(6, 0, 0), c(7, 1, 1))
  hollow <- body_mesh(both(outer, flip(inner)), density_kg_m3 = 1)
  expect_equal(hollow$mass_kg, 60)
  expect_equal(hollow$detail$part_volume_m3, c(64, -4))
  cut <- cut_body(
    body_mesh(outer, density_kg_m3 = 1), body_mesh(inner, density_kg_m3 = 1)
  )
  expect_lte(off(hollow$inertia_kg_m2, cut$inertia_kg_m2), 1e-14)
  check <- check_mesh(both(outer, flip(inner)))
  expect_equal(check$count[check$condition == "cavities"], 1)
  two <- body_mesh(both(outer, beside), density_kg_m3 = 1)
  expect_equal(two$mass_kg, 65)
  expect_equal(two$detail$parts, 2)
  joined <- join_bodies(
    body_mesh(outer, density_kg_m3 = 1), body_mesh(beside, density_kg_m3 = 1)
  )
  expect_lte(off(two$inertia_kg_m2, joined$inertia_kg_m2), 1e-14)
  expect_error(
    body_mesh(both(outer, flip(beside)), mass_kg = 1), "1 inverted part",
    class = "rotdyn_error_mesh"
  )
  expect_error(
    body_mesh(both(outer, inner), mass_kg = 1), "1 overlapping part",
    class = "rotdyn_error_mesh"
  )
})

test_that("the hull of points in planes closes, though rounding makes slivers of them", {
  skip_if_not_installed("geometry")
  grid <- as.matrix(expand.grid(0:6, 0:6, 0:6))
  # Found among 90: the first two have a triangle folded over, the third a sliver.
  for (case in list(c(0.1, 1e3), c(1.6, 1e3), c(1, 1e4), c(0.3, 0))) {
    far <- case[2]
    points <- grid %*% rotation_rpy(c(case[1], -0.7, 1.2)) + far
    mesh <- list(vertices = points, faces = matrix(c(seq_len(343), 1, 1), ncol = 3))
    body <- body_mesh(mesh, density_kg_m3 = 1, length_unit = "m", method = "hull")
    expect_lte(abs(body$mass_kg - 216), 216 * (1e-14 + far * 1e-15))
    expect_lte(max(abs(body$inertia_kg_m2 - 216 * 6 * diag(3))), 1296 * (1e-14 + far * 1e-15))
  }
})

test_that("what a double cannot hold is refused in the user's own call", {
  cube <- split_box(c(0, 0, 0), c(1, 1, 1))
  for (scale in c(1e-300, 1e-200, 1e200, 1e300)) {
    cube$vertices <- split_box(c(0, 0, 0), c(scale, scale, scale))$vertices
    error <- tryCatch(body_mesh(cube, mass_kg = 1, length_unit = "m"), error = identity)
    expect_s3_class(error, "rotdyn_error_range")
    expect_equal(error$call[[1]], quote(body_mesh))
  }
})

test_that("parts that cross, and parts that are there twice, are refused", {
  cube <- split_box(c(0, 0, 0), c(1, 1, 1))
  expect_refused <- function(mesh, count) {
    error <- tryCatch(body_mesh(mesh, mass_kg = 1), error = identity)
    expect_s3_class(error, "rotdyn_error_mesh")
    fails <- error$check[error$check$verdict == "fails", ]
    expect_equal(fails$condition, "no overlapping parts")
    expect_equal(fails$count, count)
  }
  expect_refused(both(cube, cube), 2)
  expect_refused(both(cube, split_box(c(0.5, 0.5, 0.5), c(2, 2, 2))), 2)
  expect_refused(both(cube, flip(split_box(c(0.9, 0.4, 0.4), c(9, 0.6, 0.6)))), 2)
  # Side by side, and corner to corner.
  beside <- body_mesh(both(cube, split_box(c(1, 0, 0), c(2, 1, 1))), density_kg_m3 = 1)
  expect_equal(beside$mass_kg, 2, tolerance = 1e-15)
  corners <- body_mesh(both(cube, split_box(c(1, 1, 1), c(2, 2, 2))), density_kg_m3 = 1)
  expect_equal(corners$mass_kg, 2, tolerance = 1e-15)
})

test_that("where welding leaves no face, the check says so", {
  cube <- split_box(c(0, 0, 0), c(1, 1, 1))
  error <- tryCatch(body_mesh(cube, mass_kg = 1, weld_m = 10), error = identity)
  expect_s3_class(error, "rotdyn_error_mesh")
  expect_equal(error$check$condition[error$check$verdict == "fails"], "parts have a volume")
  expect_match(conditionMessage(error), "shell")
})

test_that("a sheet has a surface and no volume", {
  sheet <- list(
    vertices = rbind(c(0, 0, 0), c(3, 0, 0), c(0, 3, 0)), faces = rbind(c(1, 2, 3), c(2, 1, 3))
  )
  expect_error(body_mesh(sheet, mass_kg = 1), "zero volume", class = "rotdyn_error_mesh")
  one <- list(vertices = sheet$vertices, faces = sheet$faces[1, , drop = FALSE])
  body <- body_mesh(one, mass_kg = 12, method = "shell")
  # A triangle: C = m/12 (sum of (v - g)(v - g)').
  expect_equal(diag(body$second_moment_kg_m2), c(6, 6, 0), tolerance = 1e-14, ignore_attr = TRUE)
  expect_equal(body$second_moment_kg_m2[1, 2], -3, tolerance = 1e-14)
  expect_equal(body$detail$area_m2, 4.5)
  point <- list(vertices = matrix(1, 3, 3), faces = matrix(1:3, 1))
  expect_error(body_mesh(point, mass_kg = 1, method = "shell"), class = "rotdyn_error_mesh")
})

test_that("loose triangles are welded, and what differs by rounding", {
  mesh <- torus()
  loose <- list(
    vertices = mesh$vertices[t(mesh$faces), ],
    faces = matrix(seq_along(mesh$faces), ncol = 3, byrow = TRUE)
  )
  one <- body_mesh(mesh, mass_kg = 3)
  body <- body_mesh(loose, mass_kg = 3)
  expect_equal(body$detail$weld_m, 0)
  expect_equal(body$inertia_kg_m2, one$inertia_kg_m2, tolerance = 1e-15)
  check <- check_mesh(loose)
  expect_equal(
    check$count[check$condition == "no vertices to merge"],
    nrow(loose$vertices) - nrow(mesh$vertices)
  )
  set.seed(8)
  near <- loose
  near$vertices <- near$vertices * (1 + 2^-52 * sample(-1:1, length(near$vertices), TRUE))
  body <- body_mesh(near, mass_kg = 3)
  expect_identical(body$detail$weld_m, max(abs(near$vertices)) * 2^-46)
  expect_lte(off(body$inertia_kg_m2, one$inertia_kg_m2), body$error)
  expect_gt(body$error, 1e-14)
  expect_error(body_mesh(near, mass_kg = 3, weld_m = 0), class = "rotdyn_error_mesh")
  wide <- loose
  wide$vertices <- wide$vertices + 1e-6 * matrix(stats::runif(length(wide$vertices)), ncol = 3)
  expect_error(body_mesh(wide, mass_kg = 3), class = "rotdyn_error_mesh")
  body <- body_mesh(wide, mass_kg = 3, weld_m = 2e-6)
  expect_lte(off(body$inertia_kg_m2, one$inertia_kg_m2), body$error)
  expect_gt(body$error, 1e-6)
  expect_error(
    body_mesh(wide, mass_kg = 3, weld_m = 1e-30), "It is 1e-30",
    class = "rotdyn_error_value"
  )
  expect_error(body_mesh(wide, mass_kg = 3, weld_m = -1), class = "rotdyn_error_value")
})

test_that("vertices out of use do not count, and are told", {
  mesh <- torus()
  one <- body_mesh(mesh, mass_kg = 3)
  mesh$vertices <- rbind(mesh$vertices, c(1e9, 0, 0))
  body <- body_mesh(mesh, mass_kg = 3)
  expect_equal(body$inertia_kg_m2, one$inertia_kg_m2)
  expect_equal(body$reach_m, one$reach_m)
  expect_equal(body$size_m, one$size_m)
  check <- check_mesh(mesh)
  expect_equal(check$count[check$condition == "vertices are in use"], 1)
  expect_equal(body_mesh(mesh, mass_kg = 3, method = "box")$size_m, one$size_m)
})

# ---- fall-backs ---------------------------------------------------------------------------------

test_that("an open mesh has a shell, a box, a hull, and the result says which", {
  open <- corner()
  open$faces <- open$faces[-4, ]
  expect_error(body_mesh(open, mass_kg = 1), class = "rotdyn_error_mesh")
  shell <- body_mesh(open, mass_kg = 1, method = "shell")
  expect_equal(shell$detail$method, "shell")
  expect_output(print(shell), "the surface")
  expect_equal(shell$detail$defects, c(open_edges = 3))
  expect_equal(shell$detail$area_m2, (2 + 3 + 6) / 2)
  # Three right triangles: areas 1, 3/2 and 3; the z of their middles 0, 1 and 1.
  expect_equal(shell$centre_m[["z"]], 4.5 / 5.5)
  brick <- body_mesh(open, density_kg_m3 = 2, method = "box")
  expect_equal(brick$detail$method, "box")
  expect_output(print(brick), "the box of the mesh")
  expect_equal(brick$mass_kg, 12)
  expect_equal(unname(diag(brick$inertia_kg_m2)), c(13, 10, 5))
  expect_equal(unname(brick$centre_m), c(0.5, 1, 1.5))
  skip_if_not_installed("geometry")
  hull <- body_mesh(open, density_kg_m3 = 1, method = "hull")
  expect_equal(hull$detail$method, "hull")
  expect_equal(hull$mass_kg, 1, tolerance = 1e-15)
  whole <- body_mesh(corner(), density_kg_m3 = 1)
  expect_equal(hull$inertia_kg_m2, whole$inertia_kg_m2, tolerance = 1e-15)
})

test_that("the hull of a hollow thing is solid, far away and small too", {
  skip_if_not_installed("geometry")
  set.seed(11)
  points <- matrix(stats::rnorm(300), 100)
  mesh <- list(vertices = points, faces = matrix(c(1:99), ncol = 3))
  hull <- body_mesh(mesh, density_kg_m3 = 1, method = "hull")
  expect_equal(hull$detail$closure, 0, tolerance = 1e-15)
  small <- list(vertices = points * 2^-40, faces = mesh$faces)
  body <- body_mesh(small, density_kg_m3 = 2^120, method = "hull")
  expect_equal(body$mass_kg, hull$mass_kg, tolerance = 1e-13)
  flat <- list(vertices = cbind(points[, 1:2], 0), faces = mesh$faces)
  expect_error(body_mesh(flat, mass_kg = 1, method = "hull"), class = "rotdyn_error_mesh")
  expect_error(body_mesh(flat, mass_kg = 1, method = "box"), class = "rotdyn_error_mesh")
  square <- box(c(0, 0, 0), c(1, 2, 3))
  body <- body_mesh(square, density_kg_m3 = 1, method = "hull")
  expect_equal(unname(diag(body$inertia_kg_m2)), 6 * c(13, 10, 5) / 12, tolerance = 1e-14)
})

test_that("check_mesh() is a table of the dictionary", {
  check <- check_mesh(corner())
  expect_setequal(setdiff(names(check), column_table()$name), character())
  expect_s3_class(check, "rot_mesh_check")
  expect_true(all(check$verdict == "holds"))
  open <- corner()
  open$faces <- open$faces[-1, ]
  check <- check_mesh(open)
  expect_equal(check$verdict[check$condition == "no inverted parts"], "not checked")
  expect_true(is.na(check$count[check$condition == "cavities"]))
})

test_that("errors say what is wrong and what to do", {
  mesh <- split_box(c(0, 0, 0), c(1, 2, 3))
  open <- list(vertices = mesh$vertices, faces = rbind(mesh$faces[-5, ], c(1, 2, 1)))
  expect_snapshot(error = TRUE, {
    body_mesh(open, mass_kg = 1)
    body_mesh(flip(open, 2), mass_kg = 1)
    body_mesh(mesh)
    body_mesh(list(vertices = mesh$vertices, faces = mesh$faces + 5L), mass_kg = 1)
    body_mesh(1:3, mass_kg = 1)
  })
  expect_snapshot(check_mesh(open)[c("condition", "count", "verdict")])
})

test_that("a check prints what fails, with its count, and keeps to the width", {
  mesh <- list(
    vertices = rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)),
    faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
  )
  print_check <- function(x) capture.output(rotdyn:::print.rot_mesh_check(x))
  closed <- print_check(check_mesh(mesh))
  expect_equal(closed[1], "<rot_mesh_check> bounds a solid")
  expect_match(closed[2], "^  holds: there are faces, coordinates are finite")
  mesh$faces <- mesh$faces[-1, ]
  open <- print_check(check_mesh(mesh))
  expect_equal(open[1], "<rot_mesh_check> not a solid: 1 condition fails")
  expect_equal(open[2], "  FAILS  no boundary edges  3: edges of one face: the rims of holes")
  expect_match(paste(open, collapse = " "), "not checked: no inverted parts", fixed = TRUE)
  expect_lte(max(nchar(c(closed, open))), 80)
})

test_that("faces that are turned over are wound like their neighbours", {
  faces <- rbind(c(1L, 3L, 2L), c(1L, 2L, 4L), c(2L, 3L, 4L), c(1L, 4L, 3L))
  edges <- function(faces) {
    sort(paste(as.vector(faces), as.vector(faces[, c(2, 3, 1)])))
  }
  expect_identical(rotdyn:::wind_alike(faces), faces)
  for (i in 1:4) {
    turned <- faces
    turned[i, 2:3] <- faces[i, 3:2]
    expect_identical(edges(rotdyn:::wind_alike(turned)), edges(faces))
  }
  # Two neighbours of an octahedron: poles 5 and 6, the others about them.
  about <- cbind(1:4, c(2:4, 1L))
  eight <- rbind(cbind(about, 5L), cbind(about[, 2:1], 6L))
  expect_identical(rotdyn:::wind_alike(eight), eight)
  turned <- eight
  turned[1:2, 2:3] <- eight[1:2, 3:2]
  expect_identical(edges(rotdyn:::wind_alike(turned)), edges(eight))
})

test_that("the error of a surface is the same along each axis", {
  corners <- rbind(c(0, 0, 0), c(1, 0, 0), c(1, 1, 0), c(0, 1, 0)) / 3
  faces <- rbind(1:3, c(1L, 3L, 4L))
  error <- function(order) {
    mesh <- list(vertices = corners[, order], faces = faces)
    body_mesh(mesh, areal_density_kg_m2 = 2, method = "shell")$error
  }
  expect_gt(error(1:3), 0)
  for (order in list(c(2, 3, 1), c(3, 1, 2))) expect_equal(error(order), error(1:3))
})
