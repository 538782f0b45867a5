# Whether a body rolls on a plane with its own z axis across the slope: a part of it is round about
# a line along z, and the centre of mass is on that line.

# Round about the z axis of their own, whatever their sizes; about every axis.
round_about_z <- c(
  "hoop", "disk", "annulus", "tube", "can", "spherical_shell", "hemispherical_shell",
  "spherical_cap_shell", "cone_shell", "frustum_shell", "torus_shell", "cylinder", "thick_tube",
  "sphere", "hollow_sphere", "hemisphere", "spherical_cap", "cone", "frustum", "paraboloid",
  "torus", "capsule"
)
round_about_all <- c("spherical_shell", "sphere", "hollow_sphere")
# Round where their first two sizes are equal.
round_where_equal <- c("elliptic_plate", "ellipsoid_shell", "elliptic_cylinder", "ellipsoid")

# Largest relative deviation of corners from a circle, and of the sides between them: a regular
# polygon of 71 sides is round; a mesh stands for a smooth body from 12 sides on.
round_corners <- 1e-3
round_sides <- c(polygon = 1e-3, mesh = 0.035)

# The round parts of a body, in its own axes, each list(at_m, axis, radius_m, close, all): a point
# and the direction of its axis, the relative distance that counts as on it, whether each axis
# through the point is one. Without elements where no part is round; NULL where none is, and the
# outline of one is unknown.
round_parts <- function(body) {
  detail <- body$detail
  parts <- if (is.null(detail$bodies)) {
    round_outline(body)
  } else {
    each <- lapply(detail$bodies[detail$signs > 0], round_parts)
    found <- unlist(each, recursive = FALSE)
    if (length(found) || !any(vapply(each, is.null, NA))) found %||% list()
  }
  frame <- detail$frame
  if (is.null(frame)) return(parts)
  # lapply(NULL) is a list.
  if (!is.null(parts)) lapply(parts, function(part) {
    part$at_m <- as.double(frame$turn %*% part$at_m) + frame$at_m
    part$axis <- as.double(frame$turn %*% part$axis)
    part
  })
}

round_outline <- function(body) {
  shape <- body$shape
  size <- unname(body$size_m)
  if (shape %in% c("point", "sliding_point")) return(list())
  if (!is.null(body$detail$vertices_m) || !is.null(body$detail$mesh)) return(faceted_part(body))
  if (!(identical(body$provenance, "formula") && has_own_sizes(body))) return(NULL)
  round <- shape %in% round_about_z || (shape %in% round_where_equal && size[1] == size[2]) ||
    (shape %in% c("polygon_plate", "polygon_prism") &&
       1 - cos(pi / size[2]) <= round_sides[["polygon"]])
  if (!round) return(list())
  list(list(
    at_m = c(0, 0, 0), axis = c(0, 0, 1), radius_m = size[1], close = 1e-9,
    all = shape %in% round_about_all
  ))
}

# A mesh or a polygon, seen along z: its convex hull, compared with a circle.
faceted_part <- function(body) {
  body$detail$frame <- NULL
  flat <- do.call(rbind, lapply(body_solids(body), function(solid) {
    if (!isTRUE(solid$hole)) solid$points[, 1:2, drop = FALSE]
  }))
  if (is.null(flat) || nrow(flat) < 3L) return(list())
  middle <- colMeans(apply(flat, 2, range))
  size <- max(abs(flat - rep(middle, each = nrow(flat))))
  if (!is.finite(size) || size == 0) return(list())
  flat <- (flat - rep(middle, each = nrow(flat))) / size
  hull <- flat[grDevices::chull(flat), , drop = FALSE]
  if (nrow(hull) < 4L) return(list())
  # Least squares: x^2 + y^2 = 2 a x + 2 b y + c.
  circle <- qr.coef(qr(cbind(2 * hull, 1)), rowSums(hull^2))
  centre <- circle[1:2]
  radius <- sqrt(circle[[3]] + sum(centre^2))
  out <- hull - rep(centre, each = nrow(hull))
  turn <- sort(atan2(out[, 2], out[, 1]))
  gap <- max(diff(c(turn, turn[1] + 2 * pi)))
  off <- max(abs(sqrt(rowSums(out^2)) / radius - 1))
  sides <- round_sides[[if (is.null(body$detail$mesh)) "polygon" else "mesh"]]
  if (!is.finite(off) || off > round_corners || 1 - cos(gap / 2) > sides) return(list())
  list(list(
    at_m = c(middle + size * centre, 0), axis = c(0, 0, 1), radius_m = size * radius,
    close = round_corners, all = FALSE
  ))
}

# An error where the body is not round about its own z axis, or where its centre of mass is beside
# the axis on which it would roll. A body of unknown outline is taken as round about its own z axis.
check_rolls <- function(body, call, arg = "body") {
  parts <- round_parts(body)
  centre <- as.double(body$centre_m)
  if (is.null(parts)) {
    frame <- body$detail$frame
    if (!is.null(frame)) centre <- as.double(t(frame$turn) %*% (centre - frame$at_m))
    size <- sqrt(sum(diag(body$second_moment_kg_m2)) / body$mass_kg)
    off <- sqrt(sum(centre[1:2]^2))
    known <- max(1e-9, 4 * body$error, na.rm = TRUE) * size
    if (off <= known + max(0, body$detail$centre_error_m)) return(invisible(body))
    abort_eccentric(off, arg, call)
  }
  upright <- Filter(function(part) {
    part$all || sqrt(sum(part$axis[1:2]^2)) <= 1e-9
  }, parts)
  if (!length(upright)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be round about its own z axis, on which it rolls.",
      x = if (length(parts)) {
        "It is a {.val {body$shape}}, whose axis is not along z: see {.fn place_body}."
      } else {
        "It is a {.val {body$shape}}."
      },
      i = "{.fn body_tensor} takes the mass and the moments of a wheel of any form."
    ), "value", call)
  }
  off <- vapply(upright, function(part) sqrt(sum((centre - part$at_m)[1:2]^2)), double(1))
  close <- vapply(upright, function(part) part$close * part$radius_m, double(1))
  if (all(off > close)) abort_eccentric(min(off), arg, call)
  invisible(body)
}

abort_eccentric <- function(off_m, arg, call) {
  abort_rotdyn(c(
    "The centre of mass of {.arg {arg}} must be on the axis on which it rolls.",
    x = "It is {format_si(off_m)} m beside it.",
    i = "An eccentric body rolls with a varying moment and normal force: balance it with
         {.fn join_bodies}."
  ), "value", call)
}
