# Moments of a shape by quadrature over its geometry, and nothing else: a shape is one or more maps
# of the unit interval, square or cube, and the element of length, area or volume comes from their
# derivatives (by steps in the complex direction, which lose no digits).

# Nodes and weights on [0, 1], from the eigenvectors of Jacobi's matrix (Golub and Welsch 1969).
gauss_legendre <- function(n) {
  k <- seq_len(n - 1)
  off <- k / sqrt(4 * k^2 - 1)
  jacobi <- matrix(0, n, n)
  jacobi[cbind(k, k + 1)] <- jacobi[cbind(k + 1, k)] <- off
  e <- eigen(jacobi, symmetric = TRUE)
  list(x = (1 + e$values) / 2, w = e$vectors[1, ]^2)
}

# A map takes a matrix with a column for each parameter and returns list(x, y, z).
map_moments <- function(map, dimension) {
  # Degrees of up to 8, and angles that go all the way round.
  nodes <- list(24, c(24, 24), c(12, 20, 20))[[dimension]]
  rules <- lapply(nodes, gauss_legendre)
  p <- as.matrix(expand.grid(lapply(rules, `[[`, "x")))
  w <- Reduce(`*`, expand.grid(lapply(rules, `[[`, "w")))
  at <- function(p) do.call(cbind, lapply(map(p), function(x) rep_len(x, nrow(p))))
  x <- Re(at(p + 0i))
  d <- lapply(seq_len(dimension), function(k) {
    step <- p + 0i
    step[, k] <- step[, k] + 1e-30i
    Im(at(step)) / 1e-30
  })
  w <- w * element(d)
  list(
    mass = sum(w), first = colSums(w * x), second = crossprod(x, w * x), points = x
  )
}

# Length, area or volume of what the derivatives span.
element <- function(d) {
  cross <- function(a, b) {
    cbind(
      a[, 2] * b[, 3] - a[, 3] * b[, 2], a[, 3] * b[, 1] - a[, 1] * b[, 3],
      a[, 1] * b[, 2] - a[, 2] * b[, 1]
    )
  }
  switch(length(d),
    sqrt(rowSums(d[[1]]^2)),
    sqrt(rowSums(cross(d[[1]], d[[2]])^2)),
    abs(rowSums(cross(d[[1]], d[[2]]) * d[[3]]))
  )
}

# Mass for a density of 1, centre, second moments of a mass of 1 about it, farthest node.
quadrature <- function(maps, dimension) {
  parts <- lapply(maps, map_moments, dimension = dimension)
  sum_of <- function(name) Reduce(`+`, lapply(parts, `[[`, name))
  mass <- sum_of("mass")
  centre <- sum_of("first") / mass
  # About the centre found, so that the shift back cancels nothing.
  about <- lapply(maps, function(map) {
    function(p) Map(`-`, map(p), centre)
  })
  parts <- lapply(about, map_moments, dimension = dimension)
  far <- max(vapply(parts, function(part) max(rowSums(part$points^2)), double(1)))
  list(mass = mass, centre = centre, second = sum_of("second") / mass, far = sqrt(far))
}

# ---- maps ---------------------------------------------------------------------------------------

# Round about z, between two radii that are functions of z, for z from `low` to `high`.
revolved_solid <- function(low, high, outer, inner = function(z) 0) {
  function(p) {
    z <- low + (high - low) * p[, 1]
    r <- inner(z) + (outer(z) - inner(z)) * p[, 2]
    list(r * cos(2 * pi * p[, 3]), r * sin(2 * pi * p[, 3]), z)
  }
}

# The curve (r(t), z(t)), t from 0 to 1, turned about z.
revolved_curve <- function(r, z) {
  function(p) {
    list(r(p[, 1]) * cos(2 * pi * p[, 2]), r(p[, 1]) * sin(2 * pi * p[, 2]), z(p[, 1]))
  }
}

# A flat map, drawn out along z by `length` about z = 0.
prism_of <- function(map, length) {
  function(p) {
    flat <- map(p[, 1:2, drop = FALSE])
    list(flat[[1]], flat[[2]], length * (p[, 3] - 0.5))
  }
}

ellipse_map <- function(a, b, turn = 2 * pi) {
  function(p) list(a * p[, 1] * cos(turn * p[, 2]), b * p[, 1] * sin(turn * p[, 2]), 0)
}

triangle_map <- function(a, b, c) {
  function(p) {
    u <- p[, 1]
    v <- p[, 1] * p[, 2]
    list(
      a[1] + u * (b[1] - a[1]) + v * (c[1] - b[1]), a[2] + u * (b[2] - a[2]) + v * (c[2] - b[2]), 0
    )
  }
}

polygon_maps <- function(radius, sides) {
  corner <- function(k) radius * c(cos(2 * pi * k / sides), sin(2 * pi * k / sides))
  lapply(seq_len(sides), function(k) triangle_map(c(0, 0), corner(k), corner(k + 1)))
}

box_map <- function(a, b, c) {
  function(p) list(a * (p[, 1] - 0.5), b * (p[, 2] - 0.5), c * (p[, 3] - 0.5))
}

# A solid that is drawn together towards `apex`, from what `map` gives at its base.
drawn_to <- function(map, apex) {
  function(p) {
    flat <- map(p[, 2:3, drop = FALSE])
    t <- p[, 1]
    Map(function(x, tip) tip * (1 - t) + x * t, flat, apex)
  }
}

box_faces <- function(s) {
  sides <- expand.grid(axis = 1:3, sign = c(-0.5, 0.5))
  lapply(seq_len(6), function(i) {
    force(i)
    function(p) {
      at <- list(s[1] * (p[, 1] - 0.5), s[2] * (p[, 1] - 0.5), s[3] * (p[, 2] - 0.5))
      axis <- sides$axis[i]
      if (axis == 3) at[[2]] <- s[2] * (p[, 2] - 0.5)
      at[[axis]] <- s[axis] * sides$sign[i] + 0 * p[, 1]
      at
    }
  })
}

# The geometry of every shape, in its own axes, from its sizes in the order of the catalogue.
shape_maps <- list(
  rod = function(s) list(function(p) list(s * (p[, 1] - 0.5), 0, 0)),
  rod_end = function(s) list(function(p) list(s * p[, 1], 0, 0)),
  hoop = function(s) list(function(p) list(s * cos(2 * pi * p[, 1]), s * sin(2 * pi * p[, 1]), 0)),
  half_hoop = function(s) list(function(p) list(s * cos(pi * p[, 1]), s * sin(pi * p[, 1]), 0)),
  disk = function(s) list(ellipse_map(s, s)),
  annulus = function(s) {
    list(function(p) {
      r <- s[2] + (s[1] - s[2]) * p[, 1]
      list(r * cos(2 * pi * p[, 2]), r * sin(2 * pi * p[, 2]), 0)
    })
  },
  half_disk = function(s) list(ellipse_map(s, s, pi)),
  elliptic_plate = function(s) list(ellipse_map(s[1], s[2])),
  rectangle = function(s) list(function(p) list(s[1] * (p[, 1] - 0.5), s[2] * (p[, 2] - 0.5), 0)),
  triangle = function(s) list(triangle_map(c(0, 0), c(s[1], 0), c(s[3], s[2]))),
  polygon_plate = function(s) polygon_maps(s[1], s[2]),
  tube = function(s) list(revolved_curve(function(t) s[1], function(t) s[2] * (t - 0.5))),
  can = function(s) {
    list(
      revolved_curve(function(t) s[1], function(t) s[2] * (t - 0.5)),
      revolved_curve(function(t) s[1] * t, function(t) s[2] / 2),
      revolved_curve(function(t) s[1] * t, function(t) -s[2] / 2)
    )
  },
  spherical_shell = function(s) {
    list(revolved_curve(function(t) s * sin(pi * t), function(t) s * cos(pi * t)))
  },
  hemispherical_shell = function(s) {
    list(revolved_curve(function(t) s * sin(pi * t / 2), function(t) s * cos(pi * t / 2)))
  },
  spherical_cap_shell = function(s) {
    angle <- acos(1 - s[2] / s[1])
    list(revolved_curve(
      function(t) s[1] * sin(angle * t), function(t) s[1] * cos(angle * t) - s[1] + s[2]
    ))
  },
  cone_shell = function(s) list(revolved_curve(function(t) s[1] * (1 - t), function(t) s[2] * t)),
  frustum_shell = function(s) {
    list(revolved_curve(function(t) s[1] + (s[2] - s[1]) * t, function(t) s[3] * t))
  },
  torus_shell = function(s) {
    list(revolved_curve(
      function(t) s[1] + s[2] * cos(2 * pi * t), function(t) s[2] * sin(2 * pi * t)
    ))
  },
  box_shell = box_faces,
  cylinder = function(s) list(revolved_solid(-s[2] / 2, s[2] / 2, function(z) s[1])),
  thick_tube = function(s) {
    list(revolved_solid(-s[3] / 2, s[3] / 2, function(z) s[1], function(z) s[2]))
  },
  half_cylinder = function(s) list(prism_of(ellipse_map(s[1], s[1], pi), s[2])),
  elliptic_cylinder = function(s) list(prism_of(ellipse_map(s[1], s[2]), s[3])),
  sphere = function(s) list(revolved_solid(-s, s, function(z) sqrt(s^2 - z^2))),
  hollow_sphere = function(s) {
    list(function(p) {
      r <- s[2] + (s[1] - s[2]) * p[, 1]
      across <- r * sin(pi * p[, 2])
      list(across * cos(2 * pi * p[, 3]), across * sin(2 * pi * p[, 3]), r * cos(pi * p[, 2]))
    })
  },
  hemisphere = function(s) list(revolved_solid(0, s, function(z) sqrt(s^2 - z^2))),
  spherical_cap = function(s) {
    list(revolved_solid(0, s[2], function(z) sqrt(s[1]^2 - (z + s[1] - s[2])^2)))
  },
  cone = function(s) list(revolved_solid(0, s[2], function(z) s[1] * (1 - z / s[2]))),
  frustum = function(s) {
    list(revolved_solid(0, s[3], function(z) s[1] + (s[2] - s[1]) * z / s[3]))
  },
  paraboloid = function(s) list(revolved_solid(0, s[2], function(z) s[1] * sqrt(1 - z / s[2]))),
  ellipsoid = function(s) {
    list(function(p) {
      across <- p[, 1] * sin(pi * p[, 2])
      list(
        s[1] * across * cos(2 * pi * p[, 3]), s[2] * across * sin(2 * pi * p[, 3]),
        s[3] * p[, 1] * cos(pi * p[, 2])
      )
    })
  },
  torus = function(s) {
    list(function(p) {
      r <- s[1] + s[2] * p[, 1] * cos(2 * pi * p[, 2])
      list(
        r * cos(2 * pi * p[, 3]), r * sin(2 * pi * p[, 3]),
        s[2] * p[, 1] * sin(2 * pi * p[, 2])
      )
    })
  },
  capsule = function(s) {
    half <- s[2] / 2
    end <- function(z) sqrt(s[1]^2 - (abs_of(z) - half)^2)
    list(
      revolved_solid(-half, half, function(z) s[1]),
      revolved_solid(half, half + s[1], end),
      revolved_solid(-half - s[1], -half, end)
    )
  },
  box = function(s) list(box_map(s[1], s[2], s[3])),
  cube = function(s) list(box_map(s, s, s)),
  polygon_prism = function(s) lapply(polygon_maps(s[1], s[2]), prism_of, length = s[3]),
  triangular_prism = function(s) {
    list(prism_of(triangle_map(c(0, 0), c(s[1], 0), c(s[3], s[2])), s[4]))
  },
  pyramid = function(s) {
    base <- function(p) list(s[1] * (p[, 1] - 0.5), s[2] * (p[, 2] - 0.5), 0)
    list(drawn_to(base, c(0, 0, s[3])))
  },
  regular_tetrahedron = function(s) {
    r <- s / sqrt(3)
    corner <- function(k) r * c(cos(2 * pi * k / 3), sin(2 * pi * k / 3))
    list(drawn_to(triangle_map(corner(0), corner(1), corner(2)), c(0, 0, s * sqrt(2 / 3))))
  },
  regular_octahedron = function(s) {
    base <- function(p) list(s * (p[, 1] - 0.5), s * (p[, 2] - 0.5), 0)
    list(drawn_to(base, c(0, 0, s / sqrt(2))), drawn_to(base, c(0, 0, -s / sqrt(2))))
  }
)

# |z| for complex steps.
abs_of <- function(z) ifelse(Re(z) < 0, -z, z)

# Two sets of sizes for each shape, none of them 1.
test_sizes <- list(
  rod = list(3, 0.7), rod_end = list(3, 0.7), hoop = list(3, 0.7), half_hoop = list(3, 0.7),
  disk = list(3, 0.7), annulus = list(c(3, 2), c(0.7, 0.1)), half_disk = list(3, 0.7),
  elliptic_plate = list(c(3, 5), c(0.7, 0.2)), rectangle = list(c(3, 5), c(0.7, 0.2)),
  triangle = list(c(3, 5, -2), c(0.7, 0.2, 0.5)), polygon_plate = list(c(3, 3), c(0.7, 8)),
  tube = list(c(3, 5), c(0.7, 0.2)), can = list(c(3, 5), c(0.7, 0.2)),
  spherical_shell = list(3, 0.7), hemispherical_shell = list(3, 0.7),
  spherical_cap_shell = list(c(3, 5), c(0.7, 0.2)), cone_shell = list(c(3, 5), c(0.7, 0.2)),
  frustum_shell = list(c(3, 2, 5), c(0.7, 1.9, 0.2)), torus_shell = list(c(3, 2), c(0.7, 0.1)),
  ellipsoid_shell = list(c(3, 5, 2), c(0.7, 0.2, 1.9)),
  box_shell = list(c(3, 5, 2), c(0.7, 0.2, 1.9)),
  cylinder = list(c(3, 5), c(0.7, 0.2)), thick_tube = list(c(3, 2, 5), c(0.7, 0.6, 0.2)),
  half_cylinder = list(c(3, 5), c(0.7, 0.2)),
  elliptic_cylinder = list(c(3, 5, 2), c(0.7, 0.2, 1.9)),
  sphere = list(3, 0.7), hollow_sphere = list(c(3, 2), c(0.7, 0.6)), hemisphere = list(3, 0.7),
  spherical_cap = list(c(3, 5), c(0.7, 0.2)), cone = list(c(3, 5), c(0.7, 0.2)),
  frustum = list(c(3, 2, 5), c(0.7, 1.9, 0.2)), paraboloid = list(c(3, 5), c(0.7, 0.2)),
  ellipsoid = list(c(3, 5, 2), c(0.7, 0.2, 1.9)), torus = list(c(3, 2), c(0.7, 0.1)),
  capsule = list(c(3, 5), c(0.7, 0.2)), box = list(c(3, 5, 2), c(0.7, 0.2, 1.9)),
  cube = list(3, 0.7), polygon_prism = list(c(3, 5, 2), c(0.7, 6, 1.9)),
  triangular_prism = list(c(3, 5, -2, 4), c(0.7, 0.2, 0.5, 1.9)),
  pyramid = list(c(3, 5, 2), c(0.7, 0.2, 1.9)), regular_tetrahedron = list(3, 0.7),
  regular_octahedron = list(3, 0.7)
)

# A body of a shape by its constructor, with `mass_kg` or a density of `density`.
body_of_shape <- function(shape, size, mass_kg = NULL, density = NULL) {
  rows <- shapes()
  row <- rows[rows$shape == shape, ]
  args <- as.list(size)
  names(args) <- sub("^.* = ", "", strsplit(row$sizes, ", ")[[1]])
  if (is.null(density)) {
    args$mass_kg <- mass_kg
  } else {
    name <- c("linear_density_kg_m", "areal_density_kg_m2", "density_kg_m3")[row$dimension]
    args[[name]] <- density
  }
  do.call(getExportedValue("rotdyn", row$constructor), args)
}
