# The true outline of a body: solids of which a projection is drawn. A solid is
#   kind     "hull": the convex hull of points and balls; "polygon": a flat outline, not convex;
#            "curve": a line; "mesh": triangles
#   points   n x 3, in m (of a mesh, its vertices); faces: of a mesh, in rows
#   balls    list(centre, axes): ellipsoids, their semi-axes in columns
#   hole     TRUE: it is cut out
# A catalogue shape is described in its own axes, with the origin that shapes() states.
new_solid <- function(kind, points = NULL, ..., balls = list(), hole = FALSE) {
  list(kind = kind, points = points, balls = balls, hole = hole, ...)
}

# NULL where the outline is unknown: a tensor, a density, points.
body_solids <- function(body) {
  detail <- body$detail
  solids <- if (!is.null(detail$bodies)) {
    joined_solids(detail$bodies, detail$signs)
  } else if (!is.null(detail$vertices_m)) {
    flat <- ncol(detail$vertices_m) == 2L
    list(new_solid(if (flat) "polygon" else "hull", cbind(detail$vertices_m, if (flat) 0)))
  } else if (!is.null(detail$mesh)) {
    list(mesh_solid(detail$mesh, detail$method))
  } else if (identical(body$provenance, "formula") && has_own_sizes(body)) {
    shape_solids[[body$shape]](unname(body$size_m))
  }
  frame <- detail$frame
  if (is.null(frame)) solids else lapply(solids, move_solid, frame$turn, frame$at_m)
}

has_own_sizes <- function(body) {
  shapes <- shape_table()
  of <- match(body$shape, shapes$shape)
  body$shape %in% names(shape_solids) && identical(names(body$size_m), shapes$names[[of]])
}

# NULL where one of the parts is unknown: half an outline would mislead.
joined_solids <- function(bodies, signs) {
  parts <- lapply(bodies, body_solids)
  # A point has no outline, and needs none.
  unknown <- vapply(parts, is.null, NA) & !vapply(bodies, function(b) b$shape == "point", NA)
  if (any(unknown)) return(NULL)
  unlist(Map(function(part, sign) {
    lapply(part, function(solid) {
      if (sign < 0) solid$hole <- !solid$hole
      solid
    })
  }, parts, signs), recursive = FALSE)
}

# The frame of a body that is placed once more.
placed_frame <- function(frame, turn, at_m) {
  turn <- turn %||% diag(3)
  if (is.null(frame)) return(list(turn = turn, at_m = at_m))
  list(turn = turn %*% frame$turn, at_m = as.double(turn %*% frame$at_m) + at_m)
}

move_solid <- function(solid, turn, at_m) {
  if (!is.null(solid$points)) solid$points <- t(turn %*% t(solid$points) + at_m)
  solid$balls <- lapply(solid$balls, function(ball) {
    list(centre = as.double(turn %*% ball$centre) + at_m, axes = turn %*% ball$axes)
  })
  solid
}

# Of a mesh that stands for its hull or its box, that.
mesh_solid <- function(mesh, method) {
  points <- mesh$vertices
  faces <- mesh$faces
  if (mesh$by_column) {
    points <- t(points[1:3, , drop = FALSE])
    faces <- t(faces)
  }
  points <- points[, 1:3, drop = FALSE] * mesh$factor
  dimnames(points) <- NULL
  if (method %in% c("hull", "box")) {
    points <- points[sort(unique(as.vector(faces))), , drop = FALSE]
    if (method == "hull") return(new_solid("hull", points))
    ends <- apply(points, 2, range)
    return(new_solid("hull", as.matrix(expand.grid(ends[, 1], ends[, 2], ends[, 3]))))
  }
  # Vertices that were merged are one, so that edges are shared.
  if (!is.null(mesh$same)) faces[] <- mesh$same[faces] + 1L
  new_solid("mesh", points, faces = faces)
}

# ---- the catalogue ------------------------------------------------------------------------------

ring <- function(a, b = a, z = 0, from = 0, to = 2 * pi, n = 181L) {
  angle <- seq(from, to, length.out = n)
  cbind(a * cos(angle), b * sin(angle), z)
}

hull_of <- function(...) list(new_solid("hull", rbind(...)))

curve_of <- function(points) list(new_solid("curve", points))

ball_of <- function(a, b = a, c = a, z = 0, hole = FALSE) {
  list(new_solid("hull", balls = list(list(centre = c(0, 0, z), axes = diag(c(a, b, c)))),
                 hole = hole))
}

with_hole <- function(solids, ...) c(solids, list(new_solid("hull", rbind(...), hole = TRUE)))

# Round about z: the radius at heights z.
turned <- function(radius, z) {
  hull_of(do.call(rbind, Map(function(r, z) ring(r, z = z), radius, z)))
}

box_corners <- function(a, b, c) {
  as.matrix(expand.grid(c(-a, a) / 2, c(-b, b) / 2, c(-c, c) / 2, KEEP.OUT.ATTRS = FALSE))
}

drawn_out <- function(flat, length) {
  flat[, 3] <- -length / 2
  top <- flat
  top[, 3] <- length / 2
  hull_of(flat, top)
}

# More than 720 sides are drawn as 720.
corners_of <- function(radius, sides) {
  n <- min(sides, 720)
  ring(radius, to = 2 * pi * (n - 1) / n, n = n)
}

triangle_of <- function(base, height, apex) {
  cbind(c(0, base, apex), c(0, 0, height), 0)
}

cap_of <- function(s) {
  z <- s[2] * (1 - cos(seq(0, pi / 2, length.out = 46L)))
  z <- sort(unique(c(z, if (s[2] > s[1]) s[2] - s[1])))
  below <- s[2] - z # (2 R - below) below is R^2 - (R - below)^2, and R^2 may be beyond the doubles
  turned(sqrt(2 * below) * sqrt(pmax(s[1] - below / 2, 0)), z)
}

dome_of <- function(s) {
  angle <- seq(0, pi / 2, length.out = 46L)
  turned(s * cos(angle), s * sin(angle))
}

# A ring of tubes is drawn about its hole.
torus_of <- function(s) {
  angle <- seq(0, 2 * pi, length.out = 73L)
  with_hole(turned(s[1] + s[2] * cos(angle), s[2] * sin(angle)), ring(s[1] - s[2]))
}

# By shape, of its sizes in the order of its constructor.
shape_solids <- list(
  rod = function(s) curve_of(cbind(c(-s, s) / 2, 0, 0)),
  rod_end = function(s) curve_of(cbind(c(0, s), 0, 0)),
  hoop = function(s) curve_of(ring(s)),
  half_hoop = function(s) curve_of(ring(s, to = pi)),
  disk = function(s) hull_of(ring(s)),
  annulus = function(s) with_hole(hull_of(ring(s[1])), ring(s[2])),
  half_disk = function(s) hull_of(ring(s, to = pi)),
  elliptic_plate = function(s) hull_of(ring(s[1], s[2])),
  rectangle = function(s) hull_of(box_corners(s[1], s[2], 0)),
  triangle = function(s) hull_of(triangle_of(s[1], s[2], s[3])),
  polygon_plate = function(s) hull_of(corners_of(s[1], s[2])),
  tube = function(s) {
    ends <- rbind(ring(s[1], z = -s[2] / 2), ring(s[1], z = s[2] / 2))
    with_hole(hull_of(ends), ends)
  },
  can = function(s) drawn_out(ring(s[1]), s[2]),
  spherical_shell = function(s) ball_of(s),
  hemispherical_shell = dome_of,
  spherical_cap_shell = cap_of,
  cone_shell = function(s) hull_of(ring(s[1]), c(0, 0, s[2])),
  frustum_shell = function(s) hull_of(ring(s[1]), ring(s[2], z = s[3])),
  torus_shell = torus_of,
  ellipsoid_shell = function(s) ball_of(s[1], s[2], s[3]),
  box_shell = function(s) hull_of(box_corners(s[1], s[2], s[3])),
  cylinder = function(s) drawn_out(ring(s[1]), s[2]),
  thick_tube = function(s) {
    with_hole(
      drawn_out(ring(s[1]), s[3]), ring(s[2], z = -s[3] / 2), ring(s[2], z = s[3] / 2)
    )
  },
  half_cylinder = function(s) drawn_out(ring(s[1], to = pi), s[2]),
  elliptic_cylinder = function(s) drawn_out(ring(s[1], s[2]), s[3]),
  sphere = function(s) ball_of(s),
  hollow_sphere = function(s) c(ball_of(s[1]), ball_of(s[2], hole = TRUE)),
  hemisphere = dome_of,
  spherical_cap = cap_of,
  cone = function(s) hull_of(ring(s[1]), c(0, 0, s[2])),
  frustum = function(s) hull_of(ring(s[1]), ring(s[2], z = s[3])),
  paraboloid = function(s) {
    share <- seq(0, 1, length.out = 46L)
    turned(s[1] * share, s[2] * (1 - share^2))
  },
  ellipsoid = function(s) ball_of(s[1], s[2], s[3]),
  torus = torus_of,
  capsule = function(s) {
    ends <- lapply(c(-s[2], s[2]) / 2, function(z) {
      list(centre = c(0, 0, z), axes = diag(rep(s[1], 3)))
    })
    list(new_solid("hull", balls = ends))
  },
  box = function(s) hull_of(box_corners(s[1], s[2], s[3])),
  cube = function(s) hull_of(box_corners(s, s, s)),
  polygon_prism = function(s) drawn_out(corners_of(s[1], s[2]), s[3]),
  triangular_prism = function(s) drawn_out(triangle_of(s[1], s[2], s[3]), s[4]),
  pyramid = function(s) {
    hull_of(box_corners(s[1], s[2], 0), c(0, 0, s[3]))
  },
  regular_tetrahedron = function(s) {
    hull_of(corners_of(s / sqrt(3), 3L), c(0, 0, s * sqrt(2 / 3)))
  },
  regular_octahedron = function(s) {
    hull_of(box_corners(s, s, 0), c(0, 0, s / sqrt(2)), c(0, 0, -s / sqrt(2)))
  }
)

# ---- projection ---------------------------------------------------------------------------------

# The shadows of solids on the plane of two unit vectors (columns of `plane`): data frames with
# across, up, group, hole: `fill`, closed outlines; `line`, paths; `mesh`, triangles.
project_solids <- function(solids, plane) {
  none <- data.frame(across = double(), up = double(), group = integer(), hole = logical())
  out <- list(fill = list(none), line = list(none), mesh = list(none))
  for (i in seq_along(solids)) {
    solid <- solids[[i]]
    flat <- if (!is.null(solid$points)) solid$points %*% plane
    table <- function(points) {
      data.frame(
        across = points[, 1], up = points[, 2], group = rep(i, nrow(points)), hole = solid$hole
      )
    }
    if (solid$kind == "hull") {
      shadows <- lapply(solid$balls, ball_shadow, plane)
      points <- do.call(rbind, c(list(flat), shadows))
      out$fill <- c(out$fill, list(table(points[grDevices::chull(points), , drop = FALSE])))
    } else if (solid$kind == "polygon") {
      out$fill <- c(out$fill, list(table(flat)))
    } else if (solid$kind == "curve") {
      out$line <- c(out$line, list(table(flat)))
    } else {
      seen <- mesh_shadow(flat, solid$faces)
      front <- table(flat[as.vector(t(seen$front)), , drop = FALSE])
      front$group <- 1e7 * i + rep(seq_len(nrow(seen$front)), each = 3L)
      edges <- table(flat[as.vector(t(seen$edges)), , drop = FALSE])
      edges$group <- 1e7 * i + rep(seq_len(nrow(seen$edges)), each = 2L)
      out$mesh <- c(out$mesh, list(front))
      out$line <- c(out$line, list(edges))
    }
  }
  lapply(out, function(parts) do.call(rbind, parts))
}

# The columns of B are the projected semi-axes; the left singular vectors and values of B also give
# a flat projection as a line of the right length.
ball_shadow <- function(ball, plane, n = 181L) {
  angle <- 2 * pi * seq(0, 1, length.out = n)
  largest <- max(abs(ball$axes), .Machine$double.xmin) # squares of the sizes may leave the range
  seen <- svd(t(plane) %*% (ball$axes / largest), nv = 0)
  edge <- largest * (seen$u %*% (seen$d * rbind(cos(angle), sin(angle))))
  t(edge + as.double(ball$centre %*% plane))
}

# The triangles on one side (of an open mesh on both), and the edges where the surface turns away
# or ends. Above `most` triangles only edges are drawn.
mesh_shadow <- function(flat, faces, maximum = 20000L) {
  if (ncol(faces) == 4L) faces <- rbind(faces[, c(1, 2, 3)], faces[, c(1, 3, 4)])
  a <- flat[faces[, 1], , drop = FALSE]
  u <- flat[faces[, 2], , drop = FALSE] - a
  v <- flat[faces[, 3], , drop = FALSE] - a
  side <- u[, 1] * v[, 2] - u[, 2] * v[, 1]
  # A face seen from its edge, within rounding, belongs to no side.
  side[abs(side) <= 1e-12 * max(abs(side), 0)] <- 0
  from <- as.vector(faces)
  to <- as.vector(faces[, c(2, 3, 1)])
  low <- pmin(from, to)
  high <- pmax(from, to)
  key <- low * (nrow(flat) + 1) + high
  of <- match(key, unique(key))
  sign <- rep(sign(side), 3L)
  front <- tabulate(of[sign > 0], max(of, 0L)) > 0
  back <- tabulate(of[sign <= 0], max(of, 0L)) > 0
  single <- tabulate(of, max(of, 0L)) == 1L
  rim <- (front & back) | single
  first <- !duplicated(of)
  shown <- first & rim[of]
  towards <- faces[if (any(single)) side != 0 else side > 0, , drop = FALSE]
  list(
    front = if (nrow(towards) > maximum) towards[0, , drop = FALSE] else towards,
    edges = cbind(low[shown], high[shown])
  )
}
