# Bodies in space as drawings: solids, their marks in space, and the projection of these marks to
# those of a drawing (R/draw.R). A mark in space is list(type, points, style, part, edge):
#   type     "face" (a side of a convex part, counter-clockwise from outside), "line", "arrow"
#   points   n x 3
#   style    of R/draw.R, or a colour
#   part     what hides and is hidden as one: parts are drawn by their depth; "behind" and "over"
#            are before and after all others
#   edge     of a face: whether its edge is drawn
# A constraint joins by solid(scene): list of
#   points    n x 3: corners of a convex body, along its axes, in m or in parts of the largest
#   faces     list: the corners of each side, in order
#   fill      a colour for each; edged: whether its edge is drawn
#   tip       the point of the body whose path is shown
#   rod       NULL, or 2 x 3: a line from the origin to where it enters the body
#   held      TRUE: the origin is a fixed point, with the vertical through it
#   weight_at NULL, or where the arrow of the weight begins
#   stand     NULL, or 1 or -1: a stand below or above the fixed point
#   wheels    NULL, or a list of rims: n x 3, of rotors in the body, with their axes: wheel_marks()

mark_in_space <- function(type, points, style, part, edge = FALSE) {
  list(
    type = type, points = matrix(as.double(points), ncol = 3L), style = style, part = part,
    edge = edge
  )
}

# What turns a vector of space into the two components of the picture, seen from 30 degrees beside
# x, towards y, and 25 degrees above: y points to the right, z up, x towards the reader.
view_of_space <- function() whole_view()[1:2, ]

space_view_deg <- c(beside = 30, above = 25)

# The rows: to the right, up, and towards the reader. The page's script has the same
# (inst/animate/player.js).
whole_view <- function(view_deg = space_view_deg) {
  beside <- view_deg[[1]] * pi / 180
  above <- view_deg[[2]] * pi / 180
  rbind(
    c(-sin(beside), cos(beside), 0),
    c(-cos(beside) * sin(above), -sin(beside) * sin(above), cos(above)),
    c(cos(beside) * cos(above), sin(beside) * cos(above), sin(above))
  )
}

# Marks in space as those of a drawing, what is farther first. Of a convex part the sides that are
# turned to the reader are all that is seen. A trail is drawn twice: what lies behind the origin
# before the parts, the rest after them.
project_marks <- function(marks, view = whole_view()) {
  toward <- view[3, ]
  parts <- vapply(marks, `[[`, "", "part")
  depth <- vapply(unique(parts), function(part) {
    if (part == "behind") return(-Inf)
    if (part == "over") return(Inf)
    mean(do.call(rbind, lapply(marks[parts == part], `[[`, "points")) %*% toward)
  }, 0)
  marks <- marks[order(depth[parts])]
  flat <- lapply(marks, function(one) {
    points <- one$points %*% t(view[1:2, ])
    if (one$type == "face") {
      if (!(signed_area(points) > 0)) return(NULL)
      return(c(mark("fill", points, one$style), edge = one$edge))
    }
    out <- mark(one$type, points, one$style)
    if (is.null(one$trail)) return(out)
    list(trail = out, depth = as.vector(one$points %*% toward))
  })
  trails <- Filter(function(one) !is.null(one$trail), flat)
  side <- function(hidden) {
    shown <- Filter(function(one) sum(!hidden(one$depth)) > 1L, trails)
    lapply(shown, function(one) {
      one$trail$points[hidden(one$depth), ] <- NA
      one$trail
    })
  }
  rest <- Filter(function(one) !is.null(one) && is.null(one$trail), flat)
  c(side(function(depth) depth > 0), rest, side(function(depth) depth <= 0))
}

# Of a closed polygon, positive counter-clockwise.
signed_area <- function(points) {
  x <- points[, 1]
  y <- points[, 2]
  after <- c(seq_along(x)[-1], 1L)
  sum(x * y[after] - x[after] * y) / 2
}

# A label stands beyond its point, seen from the origin, or `beside` that line, by `gap`; `free`: on
# the side where the other points are further away. In a film its side does not change.
project_labels <- function(labels, gap, view = whole_view(), free = FALSE) {
  at <- as.matrix(labels[c("x", "y", "z")]) %*% t(view[1:2, ])
  long <- sqrt(rowSums(at^2))
  direction <- at / pmax(long, .Machine$double.xmin)
  direction[long < gap, ] <- rep(c(0, 1), each = sum(long < gap))
  aside <- labels$beside
  direction[aside, ] <- cbind(-direction[aside, 2], direction[aside, 1])
  for (k in if (free) which(aside)) {
    others <- sweep(at[-k, , drop = FALSE], 2, at[k, ]) %*% direction[k, ]
    if (isTRUE(others[which.min(abs(others))] > 0)) direction[k, ] <- -direction[k, ]
  }
  at <- at + gap * direction
  data.frame(symbol = labels$symbol, x = at[, 1], y = at[, 2], style = labels$style)
}

# ---- solids -------------------------------------------------------------------------------------

# A homogeneous box, a cylinder where two moments are equal, or a ball where all are, with these
# principal moments along `axes` (columns): in m where the mass is known. Nothing is thinner than a
# twentieth of the longest, so that plates and rods have sides.
solid_of_inertia <- function(moments, axes, mass_kg = NULL) {
  second <- pmax(sum(moments) / 2 - moments, 0)
  if (all(second == 0)) second[] <- 1
  if (is.null(mass_kg)) mass_kg <- 3 * max(second)
  equal <- c(abs(diff(moments[2:3])), abs(diff(moments[c(1, 3)])), abs(diff(moments[1:2])))
  along <- which(equal <= 1e-6 * max(moments))
  round <- length(along) == 1L
  semi <- sqrt(3 * second / mass_kg)
  if (round) semi[-along] <- 2 * sqrt(mean(second[-along]) / mass_kg)
  if (length(along) == 3L) semi <- sqrt(5 * second / mass_kg)
  semi <- pmax(semi, max(semi) / 20)
  solid <- if (round) unit_cylinder(along) else if (length(along) == 3L) unit_ball() else unit_box()
  solid$points <- solid$points %*% (semi * t(axes))
  solid$faces <- outward(solid$points, solid$faces)
  solid$semi <- semi
  solid
}

solid_fills <- list(
  near = c("#F2C879", "#A5CFEA", "#D3BFE2"), far = c("#C79A45", "#6FA6CB", "#A88BC0")
)

# The corners of each side counter-clockwise, seen from outside.
outward <- function(points, faces) {
  middle <- colMeans(points)
  lapply(faces, function(at) {
    side <- points[at, ]
    normal <- cross_product(side[2, ] - side[1, ], side[3, ] - side[1, ])
    if (sum(normal * (colMeans(side) - middle)) < 0) rev(at) else at
  })
}

# The sides along the three axes have three colours, and dark ones at their negative ends.
unit_box <- function() {
  points <- as.matrix(expand.grid(c(-1, 1), c(-1, 1), c(-1, 1)))
  sides <- expand.grid(sense = c(-1, 1), axis = 1:3)
  faces <- lapply(seq_len(nrow(sides)), function(k) {
    which(points[, sides$axis[k]] == sides$sense[k])[c(1, 2, 4, 3)]
  })
  points <- unname(points)
  list(
    points = points, faces = outward(points, faces),
    fill = ifelse(sides$sense > 0, solid_fills$near[sides$axis], solid_fills$far[sides$axis]),
    edged = TRUE
  )
}

# In octants of two colours.
unit_ball <- function() {
  n <- 16L
  rows <- 8L
  ring <- function(k) {
    at <- 2 * pi * (seq_len(n) - 1) / n
    cbind(sinpi(k / rows) * cos(at), sinpi(k / rows) * sin(at), cospi(k / rows))
  }
  points <- rbind(c(0, 0, 1), do.call(rbind, lapply(seq_len(rows - 1L), ring)), c(0, 0, -1))
  last <- nrow(points)
  corner <- function(k, i) {
    i <- (i - 1L) %% n + 1L
    if (k == 0L) 1L else if (k == rows) last else 1L + (k - 1L) * n + i
  }
  sides <- expand.grid(i = seq_len(n), k = seq_len(rows) - 1L)
  faces <- Map(function(i, k) {
    unique(c(corner(k, i), corner(k + 1L, i), corner(k + 1L, i + 1L), corner(k, i + 1L)))
  }, sides$i, sides$k)
  octant <- (sides$i - 1L) %/% 4L + sides$k %/% 4L
  list(
    points = points, faces = outward(points, faces), fill = solid_fills$near[1 + octant %% 2],
    edged = FALSE
  )
}

# About an axis, in quarters of two colours.
unit_cylinder <- function(along) {
  n <- 32L
  angle <- 2 * pi * (seq_len(n) - 1) / n
  ring <- cbind(cos(angle), sin(angle))
  across <- setdiff(1:3, along)
  points <- matrix(0, 2 * n + 2, 3)
  points[seq_len(n), c(across, along)] <- cbind(ring, 1)
  points[n + seq_len(n), c(across, along)] <- cbind(ring, -1)
  points[2 * n + 1:2, along] <- c(1, -1)
  at <- function(i) (i - 1) %% n + 1
  quarter <- (seq_len(n) - 1) %/% (n / 4) + 1
  caps <- lapply(1:8, function(k) {
    from <- (k - 1) %% 4 * n / 4
    low <- k > 4
    c(2 * n + 1 + low, low * n + at(from + seq_len(n / 4 + 1)))
  })
  walls <- lapply(seq_len(n), function(i) c(i, at(i + 1), n + at(i + 1), n + i))
  near <- rep(solid_fills$near[1:2], 2)
  far <- rep(solid_fills$far[1:2], 2)
  list(
    points = points, faces = outward(points, c(caps, walls)),
    fill = c(near, far, near[c(2, 1, 2, 1)][quarter]), edged = rep(c(TRUE, FALSE), c(8L, n))
  )
}

# The principal axes of a scene, in columns.
axes_of <- function(scene) {
  if (scene$axes[1] == 1) diag(3) else matrix_of_quaternion(scene$axes, "axes", NULL)
}

free_solid <- function(scene) {
  axes <- axes_of(scene)
  solid <- solid_of_inertia(scene$moment_of_inertia_kg_m2, axes)
  along <- as.vector(scene$omega0_rad_per_s %*% axes)
  maximum <- which.max(abs(along))
  side <- if (along[maximum] < 0) -1 else 1
  if (is_phone(scene, solid$semi)) solid <- with_screen(solid, axes)
  c(solid, list(
    tip = side * 1.25 * solid$semi[maximum] * axes[, maximum], held = FALSE,
    wheels = rotor_wheels(scene, 1.15 * max(solid$semi))
  ))
}

# A box with the proportions of a phone is drawn as one.
is_phone <- function(scene, semi) {
  part <- sort(semi) / max(semi)
  body <- scene[["body"]]
  inherits(body, "rot_body") && identical(body$shape, "box") && part[1] < 0.1 &&
    part[2] > 0.4 && part[2] < 0.65
}

# A dark case, with a screen on the side of the shortest axis.
with_screen <- function(solid, axes) {
  k <- which.min(solid$semi)
  across <- setdiff(1:3, k)
  corners <- matrix(0, 4L, 3L)
  corners[, across] <- 0.9 * cbind(c(-1, 1, 1, -1), c(-1, -1, 1, 1)) *
    rep(solid$semi[across], each = 4L)
  corners[, k] <- solid$semi[k]
  n <- nrow(solid$points)
  solid$points <- rbind(solid$points, corners %*% t(axes))
  solid$faces <- outward(solid$points, c(solid$faces, list(n + 1:4)))
  solid$fill <- c(rep("#4A5560", length(solid$fill)), "#A5CFEA")
  solid
}

# The moments are about the fixed point: those about the centre of mass are less.
pivot_solid <- function(scene) {
  centre <- scene$centre_m
  mass <- scene$mass_kg
  long <- sqrt(sum(centre^2))
  at_centre <- free_tensor(scene) - mass * (long^2 * diag(3) - outer(centre, centre))
  principal <- eigen(at_centre, symmetric = TRUE)
  axes <- principal$vectors
  moments <- pmax(principal$values, 0)
  solid <- if (!(mass > 0)) {
    solid_of_inertia(scene$moment_of_inertia_kg_m2, axes_of(scene))
  } else if (max(moments) > 1e-9 * mass * long^2) {
    solid_of_inertia(moments, axes, mass)
  } else { # a point, on a rod without mass
    solid_of_inertia(rep(mass * (0.1 * long)^2, 3), diag(3), mass)
  }
  wheels <- rotor_wheels(scene, 1.15 * max(solid$semi), centre)
  if (long == 0) {
    return(c(solid, list(
      tip = axes[, 1] * max(solid$semi) * 1.25, held = TRUE, wheels = wheels
    )))
  }
  # The ends of the body along the line to the centre of mass.
  ends <- 1 + range(solid$points %*% centre) / long^2
  solid$points <- solid$points + rep(centre, each = nrow(solid$points))
  turn <- matrix_of_quaternion(scene$attitude0, "attitude0", NULL)
  outside <- ends[1] > 0
  c(solid, list(
    weight_at = if (mass * scene$gravity_m_per_s2 > 0) centre,
    tip = centre * ends[2], rod = if (outside) rbind(0, centre * ends[1]), held = TRUE,
    stand = if (outside) if ((turn %*% centre)[3] < -0.3 * long) -1 else 1, wheels = wheels
  ))
}

# The wheels of rotors: rims of a radius about the centre and axes. Drawn over the body, which would
# hide them.
rotor_wheels <- function(scene, radius, centre = c(0, 0, 0)) {
  around <- seq(0, 2 * pi, length.out = 61L)
  lapply(scene$rotors, function(one) {
    basis <- qr.Q(qr(cbind(one$axis, diag(3))))[, 2:3]
    rim <- radius * t(basis %*% rbind(cos(around), sin(around)))
    side <- if (one$omega_rad_per_s < 0) -1 else 1
    list(
      rim = sweep(rim, 2, centre, "+"),
      axis = rbind(centre, centre + 1.25 * side * radius * one$axis),
      stands = one$omega_rad_per_s == 0
    )
  })
}

# ---- a body in space at one time ----------------------------------------------------------------

arrow_styles <- c(omega = "speed", L = "resistance", tau = "torque")

# A letter beside an arrow, in parts of the radius.
label_gap <- 0.11

# The look of a motion: the solid, and lengths of the arrows by the largest ones of the motion.
# `arrows`: by name, n x 3.
space_look <- function(solid, arrows) {
  corners <- rbind(solid$points, solid$tip, do.call(rbind, lapply(solid$wheels, function(wheel) {
    rbind(wheel$rim, wheel$axis)
  })))
  radius <- sqrt(max(rowSums(corners^2)))
  reach <- c(omega = 1.3, L = 1.15, tau = 1.2)
  arrows <- Map(function(v, name) {
    size <- max(sqrt(rowSums(v^2)), 0)
    if (size > 0) v * (reach[[name]] * radius / size)
  }, arrows, names(arrows))
  list(solid = solid, radius = radius, arrows = Filter(Negate(is.null), arrows))
}

# Marks and labels in space of the i-th time, with this attitude; `path`: of the tip, n x 3.
space_frame <- function(look, turn, i, path = NULL) {
  solid <- look$solid
  radius <- look$radius
  moved <- function(points) points %*% t(turn)
  points <- moved(solid$points)
  edged <- rep_len(solid$edged, length(solid$faces))
  faces <- lapply(seq_along(solid$faces), function(k) {
    mark_in_space("face", points[solid$faces[[k]], ], solid$fill[k], "body", edged[k])
  })
  shown <- Filter(function(name) {
    sum(look$arrows[[name]][i, ]^2) > (0.02 * radius)^2
  }, names(look$arrows))
  arrows <- lapply(shown, function(name) {
    arrow_in_space(c(0, 0, 0), look$arrows[[name]][i, ], arrow_styles[[name]], name)
  })
  labels <- lapply(shown, function(name) {
    label_in_space(name, look$arrows[[name]][i, ], arrow_styles[[name]], name != "omega")
  })
  if (!is.null(solid[["weight_at"]])) {
    from <- as.vector(moved(rbind(solid$weight_at)))
    tip <- from - c(0, 0, 0.6 * radius)
    arrows <- c(arrows, list(list(mark_in_space("arrow", rbind(from, tip), "weight", "over"))))
    labels <- c(labels, list(label_in_space("m*g", tip, "weight", TRUE)))
  }
  trail <- if (!is.null(path)) {
    c(mark_in_space("line", path[seq_len(i), , drop = FALSE], "spring", "over"),
      list(trail = list(path = path, from = 1L, to = i)))
  }
  wheels <- do.call(c, lapply(solid$wheels, function(wheel) {
    list(
      mark_in_space("line", moved(wheel$rim), "spring", "over"),
      mark_in_space(if (wheel$stands) "line" else "arrow", moved(wheel$axis), "spring", "over")
    )
  }))
  list(
    marks = c(
      if (!is.null(trail)) list(trail), if (solid$held) held_marks(solid, radius), faces,
      if (!is.null(solid$rod)) list(mark_in_space("line", moved(solid$rod), "body", "rod")),
      do.call(c, arrows), wheels
    ),
    labels = do.call(rbind, labels)
  )
}

# In three pieces: a body hides what lies behind it and not the rest.
arrow_in_space <- function(from, tip, style, name) {
  at <- function(k) from + (tip - from) * k / 3
  lapply(1:3, function(k) {
    mark_in_space(if (k == 3L) "arrow" else "line", rbind(at(k - 1), at(k)), style,
                  paste0(name, k))
  })
}

label_in_space <- function(symbol, at, style, beside) {
  data.frame(symbol = symbol, x = at[1], y = at[2], z = at[3], style = style, beside = beside)
}

# The vertical through the fixed point, and a stand that ends there.
held_marks <- function(solid, radius) {
  line <- mark_in_space("line", rbind(c(0, 0, -0.3), c(0, 0, 1.2)) * radius, "dashed", "behind")
  side <- solid[["stand"]]
  if (is.null(side)) return(list(line))
  line <- mark_in_space("line", rbind(0, c(0, 0, side * 1.2)) * radius, "dashed", "behind")
  n <- 12L
  around <- 2 * pi * (seq_len(n) - 1) / n
  rim <- function(r, z) radius * cbind(r * cos(around), r * sin(around), -side * z)
  frustum <- function(r, z, part) {
    points <- rbind(rim(r[1], z[1]), rim(r[2], z[2]))
    after <- c(seq_len(n)[-1], 1L)
    faces <- c(
      list(seq_len(n), n + seq_len(n)),
      lapply(seq_len(n), function(i) c(i, after[i], n + after[i], n + i))
    )
    lapply(outward(points, faces), function(at) {
      mark_in_space("face", points[at, ], if (length(at) > 4L) "fixed" else "shaft", part)
    })
  }
  c(list(line), frustum(c(0.4, 0.34), c(1, 0.92), "foot"),
    frustum(c(0.07, 0.02), c(0.92, 0), "post"))
}

# How far a drawing of the look reaches, from the origin.
space_room <- function(look) 1.42 * look$radius

# The drawing of a scene in space: its body at the start, with arrows of the largest length.
# list(marks, labels, limits) in the plane, 1 : the drawing is 3 wide.
space_still <- function(solid, turn, arrows) {
  look <- space_look(solid, lapply(Filter(Negate(is.null), arrows), rbind))
  frame <- space_frame(look, turn, 1L)
  unit <- 1.5 / space_room(look)
  marks <- lapply(project_marks(frame$marks), function(one) {
    one$points <- one$points * unit
    one
  })
  labels <- if (!is.null(frame$labels)) {
    project_labels(frame$labels, label_gap * look$radius, free = TRUE)
  }
  list(
    marks = marks, unit = unit,
    labels = if (!is.null(labels)) label_at(labels$symbol, unit * labels$x, unit * labels$y)
  )
}
