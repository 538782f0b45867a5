# Triangulates polygons with the same number of corners (in columns), keeping their orientation:
# fans from the first corner, or ear clipping where a polygon is not convex.
polygon_triangles <- function(vertices, polygons) {
  n <- nrow(polygons)
  fan <- rbind(1L, seq_len(n - 2L) + 1L, seq_len(n - 2L) + 2L)
  if (n == 3L || anyNA(polygons) || any(polygons < 1 | polygons > ncol(vertices))) {
    return(matrix(polygons[fan, ], 3L))
  }
  flat <- flat_polygons(vertices, polygons)
  out <- array(polygons[fan, ], c(3L, n - 2L, ncol(polygons)))
  for (i in which(!flat$convex)) {
    out[, , i] <- polygons[cut_ears(flat$u[, i], flat$v[, i]), i]
  }
  matrix(out, 3L)
}

# The corners projected along the axis nearest to the normal, counter-clockwise. Newell's normal:
# the sum of the cross products of neighbours.
flat_polygons <- function(vertices, polygons) {
  n <- nrow(polygons)
  turn <- c(2:n, 1L)
  at <- lapply(1:3, function(k) {
    x <- matrix(vertices[k, polygons], n)
    x - rep(x[1L, ], each = n)
  })
  normal <- vapply(1:3, function(k) {
    u <- at[[k %% 3L + 1L]]
    v <- at[[(k + 1L) %% 3L + 1L]]
    colSums(u * v[turn, , drop = FALSE] - v * u[turn, , drop = FALSE])
  }, numeric(ncol(polygons)))
  normal <- matrix(normal, ncol = 3L)
  normal[is.na(normal)] <- 0
  axis <- max.col(abs(normal), "first")
  sign <- ifelse(normal[cbind(seq_along(axis), axis)] < 0, -1, 1)
  pick <- function(offset) {
    matrix(vapply(seq_along(axis), function(i) {
      at[[(axis[i] + offset) %% 3L + 1L]][, i]
    }, numeric(n)), n)
  }
  u <- pick(0L)
  v <- pick(1L) * rep(sign, each = n)
  before <- c(n, seq_len(n - 1L))
  corner <- (u - u[before, , drop = FALSE]) * (v[turn, , drop = FALSE] - v) -
    (v - v[before, , drop = FALSE]) * (u[turn, , drop = FALSE] - u)
  minimum <- -1e-12 * apply(abs(u) + abs(v), 2, max)^2
  list(u = u, v = v, convex = colSums(corner < rep(minimum, each = n)) %in% 0)
}

# Ear clipping: a triangle of neighbours that contains no other corner is cut off, until three
# corners are left.
cut_ears <- function(u, v) {
  area <- function(a, b, c) (u[b] - u[a]) * (v[c] - v[a]) - (v[b] - v[a]) * (u[c] - u[a])
  # Corners at the same place are from a cut to a hole and do not count as inside.
  place <- match(paste(u, v), paste(u, v))
  left <- seq_along(u)
  out <- integer()
  ear <- 1L
  while (length(left) > 3L) {
    n <- length(left)
    from <- ear
    ear <- 0L
    for (i in (from + seq_len(n) - 2L) %% n + 1L) {
      a <- left[(i - 2L) %% n + 1L]
      b <- left[i]
      c <- left[i %% n + 1L]
      if (!isTRUE(area(a, b, c) > 0)) next
      others <- left[!place[left] %in% place[c(a, b, c)]]
      inside <- area(a, b, others) >= 0 & area(b, c, others) >= 0 & area(c, a, others) >= 0
      if (!any(inside, na.rm = TRUE)) {
        ear <- i
        break
      }
    }
    # Without an ear (the polygon crosses itself or is collinear) any corner is cut off.
    if (!ear) ear <- 2L
    out <- c(out, left[c((ear - 2L) %% n + 1L, ear, ear %% n + 1L)])
    left <- left[-ear]
  }
  c(out, left)
}
