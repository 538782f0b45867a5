# Is the verdict of static_equilibrium() right, and its reactions possible, where surfaces in space
# are redundant? Random bodies on 3 to 8 surfaces (friction 0, finite, Inf), rods, cables, rollers,
# pins and hinges; judged by linear programs of another program (lpSolve) and by certificates.
#
#   Rscript bench/coverage/statics.R [SCENES of each class [SEED]]
#
# Circular friction cones are judged by two pyramids of 64 sides, one inside and one outside: rests
# by the inner one, does not rest by the outer one, else not judged. A body on the edge of rest has
# a certificate: loads and a motion are drawn first, the normals and reactions after them, so that
# the motion is about to begin; then loads a part of 1e-7 to 0.1 inside, or outside. Where the body
# rests: balance of forces and torques by the errors, pushes, friction in its cone, the friction
# needed where the reactions are determined, and one range. Ends with status 1 where one
# contradicts.
# COVERAGE_SHOW=yes prints the calls of those.
suppressMessages(library(rotdyn))
if (!requireNamespace("lpSolve", quietly = TRUE)) {
  cat("statics: NOT RUN, the R package lpSolve is missing (tools/setup.sh coverage)\n")
  quit(status = 1L)
}

args <- commandArgs(trailingOnly = TRUE)
scenes <- if (length(args)) as.integer(args[1]) else 300L
seed <- if (length(args) > 1L) as.integer(args[2]) else as.integer(Sys.time()) %% 1000000L
set.seed(seed)

sides <- 64L
between <- function(lo, hi, n = 1L) stats::runif(n, lo, hi)
power <- function(lo, hi) 10^between(lo, hi)
chance <- function(p) stats::runif(1) < p
size <- function(v) sqrt(sum(v^2))
cross <- function(a, b) {
  c(a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1])
}
direction <- function() {
  v <- stats::rnorm(3)
  v / size(v)
}
# Two unit vectors across n.
across <- function(n) {
  one <- cross(n, diag(3)[, which.min(abs(n))])
  one <- one / size(one)
  cbind(one, cross(n, one))
}

# ---- scenes -------------------------------------------------------------------------------------

draw_friction <- function() {
  switch(sample(4L, 1L), 0, between(0.05, 1.5), between(0.05, 1.5), Inf)
}

# A support that does not matter to the class: at, direction, kind, friction.
draw_support <- function(surfaces) {
  kind <- if (surfaces) "surface" else {
    sample(c("surface", "rod", "cable", "roller", "pin", "hinge"), 1L,
           prob = c(0.6, 0.15, 0.1, 0.05, 0.03, 0.07))
  }
  list(kind = kind, at = between(-1, 1, 3L), along = direction(), friction = draw_friction())
}

# Surfaces that more or less face up, as those of a body on the ground.
draw_supports <- function(n) {
  surfaces <- chance(0.5)
  spread <- between(0, 1.5)
  lapply(seq_len(n), function(i) {
    one <- draw_support(surfaces)
    if (one$kind == "surface") {
      up <- c(0, 0, 1) + spread * direction()
      one$along <- up / size(up)
    }
    one
  })
}

# Forces (in units of the load) that a support can bear, well within its cone.
draw_reaction <- function(one) {
  push <- between(0, 1)
  switch(one$kind,
    surface = {
      t <- across(one$along)
      grip <- min(one$friction, 2) * push * between(0, 0.9)
      turn <- between(0, 2 * pi)
      list(force = push * one$along + grip * as.vector(t %*% c(cos(turn), sin(turn))))
    },
    cable = list(force = push * one$along),
    rod = , roller = list(force = between(-1, 1) * one$along),
    pin = list(force = between(-1, 1, 3L)),
    hinge = list(
      force = between(-1, 1, 3L), couple = as.vector(across(one$along) %*% between(-1, 1, 2L))
    )
  )
}

wrench_of <- function(at, force, couple = c(0, 0, 0)) c(force, cross(at, force) + couple)

total_of <- function(supports) {
  Reduce(`+`, lapply(supports, function(one) {
    r <- draw_reaction(one)
    wrench_of(one$at, r$force, r$couple %||% c(0, 0, 0))
  }))
}
`%||%` <- function(a, b) if (is.null(a)) b else a

# The wrench of the loads that reactions with this total balance, and noise of any size.
random_case <- function() {
  supports <- draw_supports(sample(3:8, 1L))
  total <- total_of(supports)
  noise <- if (chance(0.2)) 0 else power(-1.5, 0.7)
  list(supports = supports, load = -total + noise * size(total) * stats::rnorm(6) / 3)
}

# A motion v + omega x r that is about to begin: each contact's velocity u lies in the dual of its
# cone, on its boundary where the contact bears load. No reaction does negative work on the motion,
# so a load that does positive work drives it.
edge_case <- function() {
  v <- stats::rnorm(3)
  omega <- stats::rnorm(3) * sample(0:1, 1L)
  n <- sample(3:8, 1L)
  inside <- total <- double(6)
  supports <- list()
  for (i in seq_len(n)) {
    at <- between(-1, 1, 3L)
    u <- v + cross(omega, at)
    unit <- u / size(u)
    kind <- sample(c("edge", "lifts", "rod", "free"), 1L, prob = c(0.6, 0.15, 0.1, 0.15))
    t <- across(unit)
    turn <- between(0, 2 * pi)
    side <- as.vector(t %*% c(cos(turn), sin(turn)))
    one <- list(kind = "surface", at = at, along = unit, friction = draw_friction())
    force <- double(3)
    if (kind == "edge") {
      # u = s (mu e + n) with n across e: the friction is along -e, against the sliding.
      if (one$friction == Inf) one$friction <- between(0.05, 1.5)
      angle <- atan(one$friction)
      one$along <- cos(angle) * side + sin(angle) * unit
      slide <- unit - sum(unit * one$along) * one$along
      slide <- slide / size(slide)
      force <- between(0.1, 1) * (one$along - one$friction * slide)
    } else if (kind == "lifts") {
      if (one$friction < Inf) {
        angle <- atan(one$friction)
        up <- between(angle + 0.1, pi / 2)
        one$along <- cos(up) * side + sin(up) * unit
      }
    } else if (kind == "rod") {
      one <- list(kind = "rod", at = at, along = side, friction = 0)
      force <- between(-1, 1) * side
    } else {
      one <- list(kind = "cable", at = at, along = unit, friction = 0)
    }
    total <- total + wrench_of(at, force)
    inside <- inside + {
      r <- draw_reaction(one)
      wrench_of(at, r$force)
    }
    supports[[i]] <- one
  }
  part <- power(-7, -1)
  motion <- c(v, omega)
  # Without reactions there is no size of loads: none, which rest.
  out <- chance(0.5) && size(total) > 0
  load <- -(total + part * if (out) -size(total) * motion / size(motion) else inside)
  list(supports = supports, load = load, edge = if (out) "outside" else "inside", motion = motion)
}

# In SI units: extents and loads of any size, a far origin. The doubles given are what is judged.
scene_of <- function(case) {
  extent <- power(-2, 2)
  force <- power(-2, 4)
  origin <- if (chance(0.5)) extent * between(-3, 3, 3L) else double(3)
  place <- function(at) origin + extent * at
  supports <- lapply(case$supports, function(one) {
    p <- place(one$at)
    along <- one$along * if (chance(0.5)) power(-1, 1) else 1
    switch(one$kind,
      surface = support_surface(p, along, one$friction),
      rod = support_rod(p, p + extent * along), cable = support_cable(p, p + extent * along),
      roller = support_roller(p, along), pin = support_pin(p),
      hinge = support_hinge(p, along, slides = FALSE)
    )
  })
  # Some forces anywhere; the last one and a couple make up the rest.
  at <- matrix(between(-1, 1, 9L), 3L)
  pull <- matrix(stats::rnorm(9), 3L) * size(case$load) / 3
  n <- sample(3L, 1L)
  rest <- case$load
  loads <- list()
  for (i in seq_len(n)) {
    if (i == n) pull[, i] <- rest[1:3]
    rest <- rest - wrench_of(at[, i], pull[, i])
    loads[[i]] <- load_force(force * pull[, i], place(at[, i]), name = paste("load", i))
  }
  loads[[n + 1L]] <- load_couple(force * extent * rest[4:6], name = "couple")
  table <- do.call(forces, loads)
  given <- lapply(seq_len(nrow(table)), function(i) {
    row <- unlist(table[i, -1L])
    list(at = row[1:3], force = row[4:6], couple = row[7:9])
  })
  names(supports) <- paste0("s", seq_along(supports))
  list(supports = supports, loads = table, given = given, extent = extent, force = force,
       origin = origin)
}

# ---- the judge ----------------------------------------------------------------------------------

# What a support can bear: forces and couples by columns, with factors of at least 0. `outer`: the
# pyramid outside the cone.
generators <- function(one, friction, outer) {
  along <- switch(one$kind,
    rod = , cable = one$to_m - one$at_m, surface = , roller = , hinge = one$normal
  )
  if (!is.null(along)) along <- along / size(along)
  pushes <- function(m) rbind(m, matrix(0, 3L, ncol(m)))
  both <- function(m) cbind(m, -m)
  t <- if (one$kind %in% c("surface", "hinge")) across(along)
  switch(one$kind,
    cable = pushes(cbind(along)), rod = , roller = pushes(both(cbind(along))),
    pin = pushes(both(diag(3))), hinge = cbind(
      pushes(both(diag(3))), rbind(matrix(0, 3L, 4L), both(t))
    ),
    surface = if (friction == 0) pushes(cbind(along)) else if (friction == Inf) {
      pushes(cbind(along, both(t)))
    } else {
      turn <- 2 * pi * seq_len(sides) / sides
      reach <- friction / if (outer) cos(pi / sides) else 1
      rays <- along + reach * t %*% rbind(cos(turn), sin(turn))
      pushes(rays / sqrt(1 + reach^2))
    }
  )
}

# Wrenches about `origin`, in units of the extent and of the loads.
columns_of <- function(scene, outer = FALSE, sticks = FALSE, pulls = FALSE) {
  parts <- lapply(scene$supports, function(one) {
    g <- generators(one, if (sticks && one$friction > 0) Inf else one$friction, outer)
    if (pulls) g <- cbind(g, -g)
    r <- (one$at_m - scene$origin) / scene$extent
    apply(g, 2L, function(f) wrench_of(r, f[1:3], f[4:6]))
  })
  out <- do.call(cbind, parts)
  structure(out, owner = rep(seq_along(parts), vapply(parts, ncol, 0L)))
}

load_of <- function(scene) {
  rows <- lapply(scene$given, function(one) {
    wrench_of((one$at - scene$origin) / scene$extent, one$force / scene$force,
              one$couple / scene$force / scene$extent)
  })
  Reduce(`+`, rows)
}

# The least sum of absolute residuals, of the load.
gap_of <- function(columns, load) {
  m <- ncol(columns)
  out <- lpSolve::lp(
    "min", rep(0:1, c(m, 12L)), cbind(columns, diag(6), -diag(6)), rep("=", 6L), -load / size(load)
  )
  if (out$status != 0L) return(NA_real_)
  x <- out$solution[seq_len(m)]
  # By the solution itself.
  sum(abs(columns %*% x + load / size(load))) / (1 + 1e-3 * max(x))
}

# TRUE, FALSE, or NA between.
possible <- function(inner, outer, load) {
  if (isTRUE(gap_of(inner, load) < 1e-9)) return(TRUE)
  if (isTRUE(gap_of(outer, load) > 1e-6)) return(FALSE)
  NA
}

# "rests", "slides", "tips", "moves", or NA.
verdict_of <- function(scene, load) {
  yes <- possible(columns_of(scene), columns_of(scene, outer = TRUE), load)
  if (!(yes %in% FALSE)) return(if (is.na(yes)) NA else "rests")
  sticks <- columns_of(scene, sticks = TRUE)
  yes <- possible(sticks, sticks, load)
  if (!(yes %in% FALSE)) return(if (is.na(yes)) NA else "slides")
  pulls <- columns_of(scene, sticks = TRUE, pulls = TRUE)
  yes <- possible(pulls, pulls, load)
  if (is.na(yes)) NA else if (yes) "tips" else "moves"
}

# The extreme values of d.force of support i: c(inner, outer) of the largest.
largest_of <- function(scene, load, i, d) {
  vapply(c(FALSE, TRUE), function(outer) {
    columns <- columns_of(scene, outer = outer)
    mine <- attr(columns, "owner") == i
    gain <- ifelse(mine, as.vector(d %*% columns[1:3, ]), 0)
    out <- lpSolve::lp("max", gain, unclass(columns), rep("=", 6L), -load)
    if (out$status == 3L) Inf else if (out$status == 0L) out$objval else NA_real_
  }, 0)
}

# ---- what is checked ----------------------------------------------------------------------------

# Names of what contradicts.
faults_of <- function(x, scene, load, verdict) {
  said <- summary(x)$verdict
  if (!identical(said == "rests", verdict == "rests")) {
    return(sprintf("verdict %s for %s", said, verdict))
  }
  if (said != "rests") {
    # Of a body at an edge it is only known that it does not rest.
    return(if (verdict != "not" && said != verdict) sprintf("verdict %s for %s", said, verdict))
  }
  force <- t(as.matrix(x[c("fx_n", "fy_n", "fz_n")]))
  couple <- t(as.matrix(x[c("torque_x_n_m", "torque_y_n_m", "torque_z_n_m")]))
  arm <- vapply(scene$supports, function(one) one$at_m - scene$origin, double(3))
  given <- vapply(scene$given, function(one) c(one$at - scene$origin, one$force, one$couple),
                  double(9))
  turn <- function(r, f) vapply(seq_len(ncol(r)), function(i) cross(r[, i], f[, i]), double(3))
  lengths_of <- function(m) sqrt(colSums(m^2))
  torques <- cbind(turn(arm, force), couple, turn(given[1:3, , drop = FALSE],
                                                  given[4:6, , drop = FALSE]), given[7:9, ])
  faults <- character()
  fault <- function(bad, ...) if (!isTRUE(!bad)) faults <<- c(faults, sprintf(...))
  all_force <- cbind(force, given[4:6, ])
  left_force <- size(rowSums(all_force))
  left_torque <- size(rowSums(torques))
  fault(left_force > sum(x$error_n) + 1e-15 * sum(lengths_of(all_force)),
        "force left %.2g, errors %.2g", left_force, sum(x$error_n))
  far <- lengths_of(arm)
  stated <- sum(x$error_n * far + x$error_n_m)
  fault(left_torque > stated + 4e-15 * (sum(lengths_of(torques)) + size(scene$origin) *
                                        sum(lengths_of(all_force))),
        "torque left %.2g, errors %.2g", left_torque, stated)
  exact <- determined_values(scene, load)
  for (i in seq_along(scene$supports)) {
    one <- scene$supports[[i]]
    slack <- x$error_n[i] + 1e-15 * x$force_n[i]
    if (one$kind == "cable") {
      along <- one$to_m - one$at_m
      fault(sum(force[, i] * along) / size(along) < -slack, "cable %d pushes", i)
    }
    if (one$kind == "surface") {
      n <- one$normal / size(one$normal)
      push <- sum(force[, i] * n)
      grip <- size(force[, i] - push * n)
      fault(push < -slack, "push %.3g of %d", push, i)
      # Without a limit the cone is a half-space.
      mu <- min(one$friction, 1e12)
      fault(one$friction < Inf && grip > mu * max(push, 0) + (1 + mu) * slack,
            "friction %.6g of %.6g in %d", grip, mu * push, i)
    }
    know <- exact$known[i]
    fault(!is.na(know) && know != x$determined[i], "determined %s of %d", x$determined[i], i)
    if (isTRUE(know)) {
      off <- size(exact$force[, i] * scene$force - force[, i])
      fault(off > x$error_n[i] + 1e-13 * exact$condition * max(x$force_n, scene$force),
            "reaction %d off by %.2g, error %.2g", i, off, x$error_n[i])
      if (one$kind == "surface" && one$friction > 0) {
        near <- push > 1e6 * slack && grip > 1e6 * slack
        fault(near && abs(x$friction_needed[i] / (grip / push) - 1) > 1e-5,
              "friction needed %.9g of %d for %.9g", x$friction_needed[i], i, grip / push)
      }
    }
  }
  c(faults, range_faults(x, scene, load))
}

# Reactions without a null space, by singular values: force (in units of the loads), known (NA: too
# near to say).
determined_values <- function(scene, load) {
  parts <- lapply(scene$supports, function(one) {
    if (one$kind == "surface") {
      n <- one$normal / size(one$normal)
      g <- if (one$friction > 0) cbind(n, across(n)) else cbind(n)
      rbind(g, matrix(0, 3L, ncol(g)))
    } else {
      g <- generators(one, 0, FALSE)
      if (one$kind == "cable") g else g[, seq_len(ncol(g) / 2), drop = FALSE]
    }
  })
  # The columns of a hinge are pairs of forces, then pairs of couples.
  parts <- Map(function(g, one) {
    if (one$kind == "hinge") generators(one, 0, FALSE)[, c(1:3, 7:8)] else g
  }, parts, scene$supports)
  owner <- rep(seq_along(parts), vapply(parts, ncol, 0L))
  columns <- do.call(cbind, Map(function(g, one) {
    r <- (one$at_m - scene$origin) / scene$extent
    apply(g, 2L, function(f) wrench_of(r, f[1:3], f[4:6]))
  }, parts, scene$supports))
  s <- svd(columns, nu = 6L, nv = ncol(columns))
  rank <- sum(s$d > 1e-9 * s$d[1])
  unsure <- any(s$d > 1e-14 * s$d[1] & s$d < 1e-6 * s$d[1])
  null <- s$v[, seq_len(ncol(columns)) > rank, drop = FALSE]
  free <- sqrt(rowSums(null^2))
  x <- s$v[, seq_len(rank), drop = FALSE] %*%
    (crossprod(s$u[, seq_len(rank), drop = FALSE], -load) / s$d[seq_len(rank)])
  known <- vapply(seq_along(parts), function(i) {
    mine <- free[owner == i]
    if (unsure || any(mine > 1e-12 & mine < 1e-5)) NA else all(mine <= 1e-12)
  }, NA)
  force <- vapply(seq_along(parts), function(i) {
    as.vector(parts[[i]][1:3, , drop = FALSE] %*% x[owner == i])
  }, double(3))
  list(known = known, force = force, condition = s$d[1] / s$d[rank])
}

# One range of one surface: its push, or a component of its force.
range_faults <- function(x, scene, load) {
  r <- reactions(x)
  of <- match(r$support, names(scene$supports))
  rows <- which(x$kind[of] == "surface" & !r$determined)
  if (!length(rows)) return(NULL)
  row <- rows[sample.int(length(rows), 1L)]
  i <- of[row]
  one <- scene$supports[[i]]
  d <- if (one$friction == 0) one$normal / size(one$normal) else
    diag(3)[, match(r$component[row], c("fx_n", "fy_n", "fz_n"))]
  up <- largest_of(scene, load, i, d)
  down <- -rev(largest_of(scene, load, i, -d))
  got <- c(r$lowest[row], r$highest[row]) / scene$force
  # The ends of a range are ill-conditioned at the edge: to 1e-5.
  slack <- 1e-5 * max(1, abs(c(up, down)[is.finite(c(up, down))]))
  outside <- c(got[2] > up[2] + slack, got[1] < down[1] - slack)
  within <- c(got[2] < up[1] - slack, got[1] > down[2] + slack)
  if (any(outside, within, na.rm = TRUE)) {
    sprintf("range of %d %s: %.8g to %.8g; lowest %.8g %.8g, highest %.8g %.8g", i,
            r$component[row], got[1], got[2], down[1], down[2], up[1], up[2])
  }
}

# ---- go -----------------------------------------------------------------------------------------

contradicted <- 0L
for (class in c("random", "edge")) {
  judged <- unjudged <- bad <- 0L
  said <- character()
  while (judged < scenes && unjudged < 20L * scenes) {
    case <- if (class == "edge") edge_case() else random_case()
    scene <- scene_of(case)
    load <- unname(load_of(scene))
    verdict <- if (class == "random") verdict_of(scene, load) else
      if (case$edge == "inside") "rests" else "not"
    if (is.na(verdict)) {
      unjudged <- unjudged + 1L
      next
    }
    judged <- judged + 1L
    said <- c(said, verdict)
    faults <- tryCatch(
      faults_of(static_equilibrium(scene$loads, scene$supports), scene, load, verdict),
      rotdyn_error = function(e) paste("error:", conditionMessage(e)[1])
    )
    if (!length(faults)) next
    bad <- bad + 1L
    cat(sprintf("  %s %d: %s\n", class, judged, faults), sep = "")
    if (nzchar(Sys.getenv("COVERAGE_SHOW"))) dput(scene[c("loads", "supports")])
  }
  cat(sprintf("statics, %s: %d structures (%s), %d not judged, %d contradicted\n", class, judged,
              paste(names(table(said)), table(said), collapse = ", "), unjudged, bad))
  contradicted <- contradicted + bad
}
cat("statics, seed ", seed, ": ", if (contradicted) "FAILED" else "ok", "\n", sep = "")
quit(status = as.integer(contradicted > 0))
