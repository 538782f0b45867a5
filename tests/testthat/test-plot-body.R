skip_if_not_installed("ggplot2")

# What is drawn, by kind of geom.
layer <- function(plot, geom, which = 1) {
  hits <- Filter(function(one) inherits(one$geom, geom), plot$layers)
  hits[[which]]$data
}

outline <- function(body) layer(ggplot2::autoplot(body), "GeomPath")

test_that("the outline is the shadow of the equivalent ellipsoid", {
  # (p - g)' M^-1 (p - g) = 1 with M the block of 5 C/m; random body, turned, off the origin.
  body <- place_body(
    body_tensor(3, c(0.02, 0.05, 0.06)), c(0.2, 0.1, -0.1),
    rotation_about(c(1, 2, 3), angle_deg = 50)
  )
  edge <- outline(body)
  m <- 5 * body$second_moment_kg_m2 / body$mass_kg
  planes <- list(c(1, 2), c(1, 3), c(2, 3))
  for (k in 1:3) {
    one <- edge[as.integer(edge$panel) == k, ]
    plane <- planes[[k]]
    p <- rbind(one$across, one$up) - body$centre_m[plane]
    expect_equal(colSums(p * solve(m[plane, plane], p)), rep(1, nrow(one)), tolerance = 1e-12)
    # All round it, and closed.
    expect_equal(max(one$across), body$centre_m[[plane[1]]] + sqrt(m[plane[1], plane[1]]),
                 tolerance = 1e-3)
    expect_equal(one$across[1], one$across[nrow(one)])
  }
})

test_that("a solid sphere is itself", {
  edge <- outline(body_sphere(2, 0.3))
  expect_equal(sqrt(edge$across^2 + edge$up^2), rep(0.3, nrow(edge)), tolerance = 1e-14)
})

test_that("an ellipsoid is itself: semi-axes 5, 4, 3", {
  # Drake, unit_inertia_test.cc: the ellipsoid of unit moments 5.0, 6.8, 8.2.
  solid <- layer(ggplot2::autoplot(body_tensor(1, c(5, 6.8, 8.2))), "GeomSegment", 2)
  half <- pmax(abs(solid$across_end - solid$across), abs(solid$up_end - solid$up)) / 2
  expect_equal(as.double(tapply(half, solid$axis, max)), c(5, 4, 3), tolerance = 1e-14)
})

test_that("a plate is a line from its edge, a rod a line or a dot", {
  edge <- outline(body_disk(2, 0.25))
  side <- edge[as.integer(edge$panel) == 2, ]
  expect_equal(max(abs(side$up)), 0)
  # C = m r^2/4 in the plane: a = r sqrt(5)/2.
  expect_equal(range(side$across), c(-1, 1) * 0.25 * sqrt(5) / 2)
  edge <- outline(place_body(body_rod(1, 2), rotation = rotation_about("z", angle_deg = 30)))
  top <- edge[as.integer(edge$panel) == 1, ]
  expect_equal(top$up, top$across * tan(pi / 6), tolerance = 1e-12)
  expect_equal(max(sqrt(top$across^2 + top$up^2)), sqrt(5 / 3), tolerance = 1e-12)
  end <- outline(body_rod(1, 2))
  end <- end[as.integer(end$panel) == 3, ]
  expect_equal(c(end$across, end$up), rep(0, 2 * nrow(end)))
})

test_that("axes have the semi-axes' lengths, and go on in their directions", {
  body <- body_tensor(3, c(0.02, 0.05, 0.06))
  plot <- ggplot2::autoplot(body)
  solid <- layer(plot, "GeomSegment", 2)
  dashed <- layer(plot, "GeomSegment", 1)
  # Axis 1, of the least moment, lies along x: c1 = (0.05 + 0.06 - 0.02)/2.
  first <- solid[solid$axis == "1" & as.integer(solid$panel) == 1, ]
  expect_equal(abs(c(first$across, first$across_end)), rep(sqrt(5 * 0.045 / 3), 2))
  expect_equal(c(first$up, first$up_end), c(0, 0))
  reach <- function(lines) sqrt((lines$across_end - lines$across)^2 + (lines$up_end - lines$up)^2)
  expect_true(all(reach(dashed) >= reach(solid)))
  # A disk's third axis has no length, but a direction.
  disk <- ggplot2::autoplot(body_disk(2, 0.25))
  third <- function(which) {
    lines <- layer(disk, "GeomSegment", which)
    reach(lines[lines$axis == "3" & as.integer(lines$panel) == 2, ])
  }
  expect_equal(third(2), 0)
  expect_gt(third(1), 0.1)
})

test_that("a thin face has a side, one seen from its edge within rounding has none", {
  # Twice the area is 1 and `height`.
  shown <- function(height) {
    flat <- cbind(c(0, 1, 0, 0.5), c(0, 0, 1, height))
    nrow(rotdyn:::mesh_shadow(flat, rbind(c(1, 2, 3), c(1, 2, 4)))$front)
  }
  expect_identical(shown(1e-10), 2L)
  expect_identical(shown(1e-13), 1L)
})

test_that("all panels span the same length", {
  plot <- ggplot2::autoplot(place_body(body_rod(1, 2), c(3, 0, 0)))
  frame <- layer(plot, "GeomBlank")
  span <- tapply(frame$across, frame$panel, function(x) diff(range(x)))
  expect_equal(as.double(span), rep(span[[1]], 3))
  expect_equal(as.double(tapply(frame$up, frame$panel, function(x) diff(range(x)))),
               as.double(span))
  # The origin is in it.
  expect_lte(min(frame$across), 0)
})

test_that("the words give mass, moments with their unit, class, and what is not unique", {
  labels <- ggplot2::autoplot(body_disk(2, 0.25))$labels
  expect_equal(labels$title, "Disk")
  expect_equal(
    labels$subtitle,
    paste0(
      "2 kg; I1, I2, I3 = 0.03125, 0.03125, 0.0625 kg m^2\n",
      "plate (axes 1 and 2 not unique: their moments are equal)"
    )
  )
  axes <- levels(layer(ggplot2::autoplot(body_disk(2, 0.25)), "GeomSegment")$axis)
  expect_equal(axes, c("1 (not unique)", "2 (not unique)", "3"))
})

test_that("parts of unknown outline are marked where the body was placed, holes as holes", {
  ball <- body_tensor(2, c(0.008, 0.008, 0.008))
  pair <- join_bodies(place_body(ball, c(1, 0, 0)), place_body(ball, c(-1, 0, 0)))
  placed <- place_body(pair, c(0, 0, 3), rotation_about("z", angle_deg = 90))
  pieces <- layer(ggplot2::autoplot(placed), "GeomPoint")
  expect_equal(as.character(unique(pieces$what)), "part")
  top <- pieces[as.integer(pieces$panel) == 3, ]
  expect_equal(sort(top$across), c(-1, 1))
  expect_equal(top$up, c(3, 3))
  plate <- body_tensor(4, c(0.04, 0.04, 0.08))
  hole <- cut_body(plate, place_body(body_disk(0.25, 0.05), c(0.1, 0, 0)))
  pieces <- layer(ggplot2::autoplot(hole), "GeomPoint")
  expect_equal(pieces$across[pieces$what == "cut out" & as.integer(pieces$panel) == 1], 0.1)
})

test_that("at most 2000 points of a kind are drawn, the first and the last among them", {
  body <- body_disk(2, 0.25)
  body$detail$points <- data.frame(x_m = seq(-1, 1, length.out = 9999), y_m = 0, z_m = 0)
  pieces <- layer(ggplot2::autoplot(body), "GeomPoint")
  top <- pieces[as.integer(pieces$panel) == 1, ]
  expect_equal(nrow(top), 2000)
  expect_equal(range(top$across), c(-1, 1))
})

test_that("pieces are drawn from where the picture has its zero", {
  body <- body_disk(2, 0.25)
  body$detail$parts <- data.frame(x_m = c(11, 12), y_m = c(21, 23), z_m = c(31, 34))
  pieces <- rotdyn:::body_pieces(body, c(10, 20, 30))
  expect_equal(pieces[c("x", "y", "z")], data.frame(x = 1:2, y = c(1, 3), z = c(1, 4)))
})

test_that("a far origin is left out, and the caption says so", {
  plot <- ggplot2::autoplot(place_body(body_disk(2, 0.25), c(1e8, 0, 3)))
  expect_equal(
    plot$labels$caption,
    "measured from the centre of mass, at (1e+08, 0, 3) m in the own axes"
  )
  expect_lt(max(abs(layer(plot, "GeomBlank")$across)), 1)
  marks <- rbind(layer(plot, "GeomPoint", 2), layer(plot, "GeomPoint", 3))
  expect_equal(as.character(unique(marks$what)), "centre of mass")
  expect_null(ggplot2::autoplot(place_body(body_disk(2, 0.25), c(1, 0, 3)))$labels$caption)
})

test_that("it builds without a warning, also for a point and for no mass", {
  bodies <- list(
    body_disk(2, 0.25), body_rod(1, 2), body_disk(0, 1), body_tensor(1, c(0, 0, 0), c(1, 2, 3)),
    body_sphere(1e-30, 1e-10)
  )
  for (body in bodies) {
    expect_silent(built <- ggplot2::ggplot_build(ggplot2::autoplot(body)))
    expect_gt(nrow(built$data[[1]]), 0)
  }
})

test_that("coordinates are in a power of 1000 m of few digits, and the heads name it", {
  head <- function(body) {
    plot <- ggplot2::autoplot(body)
    panel <- ggplot2::ggplot_build(plot)$layout$panel_params[[1]]
    list(
      unit = plot$facet$params$labeller(data.frame(panel = "y over x"))[[1]][[1]],
      x = panel$x$get_labels(), y = panel$y$get_labels()
    )
  }
  expect_equal(
    head(body_sphere(2, 0.1)),
    list(unit = "y over x (m)", x = c("-0.1", "0.0", "0.1"), y = c("-0.1", "0.0", "0.1"))
  )
  expect_equal(head(body_sphere(2, 0.002))$unit, "y over x (mm)")
  expect_equal(head(body_sphere(2, 0.002))$x, c("-2", "0", "2"))
  expect_equal(head(body_sphere(1e22, 6.4e6))$unit, "y over x (1e6 m)")
  expect_equal(head(body_sphere(1e-26, 1e-10))$unit, "y over x (1e-12 m)")
  expect_equal(head(body_sphere(1e-26, 1e-10))$x, c("-100", "0", "100"))
})

test_that("a point has no axes in its picture, and a long name is broken", {
  expect_equal(nrow(layer(ggplot2::autoplot(body_point(1, 0.5)), "GeomSegment")), 0)
  long <- body_tensor(1, c(1, 1, 1.5), name = strrep("arm ", 40))
  lines <- strsplit(ggplot2::autoplot(long)$labels$title, "\n")[[1]]
  expect_gt(length(lines), 1)
  expect_lte(max(nchar(lines)), 70)
})

test_that("a body near the end of double precision is drawn", {
  skip_if_not_installed("ggplot2")
  expect_s3_class(ggplot2::autoplot(body_hoop(1e8, 1e150)), "ggplot")
})

test_that("a body near the ends of the doubles is not drawn", {
  skip_if_not_installed("ggplot2")
  expect_error(ggplot2::autoplot(body_hoop(1, 1e-310)), class = "rotdyn_error_range")
})

test_that("sizes at the ends of the doubles and many sides end in a picture or an error", {
  skip_if_not_installed("ggplot2")
  refused <- function(body) {
    expect_no_warning(
      expect_error(ggplot2::autoplot(body), class = "rotdyn_error_range")
    )
  }
  refused(body_disk(1, 4e-324))
  refused(body_polygon_plate(1.44, 4.94e-324, 5))
  refused(body_disk(0, 1.7976931348623157e308))
  many <- ggplot2::ggplot_build(ggplot2::autoplot(body_polygon_prism(4.3, 4.8, 2^53, 2)))
  expect_s3_class(many$plot, "ggplot")
  plate <- ggplot2::ggplot_build(ggplot2::autoplot(body_polygon_plate(1, 1, 1e9)))
  round <- layer(plate$plot, "GeomPolygon")
  expect_lte(nrow(round), 3 * 720)
})
