# inertia_table() over a million rows of mixed shapes, against the same formulas in vectorised base
# R, shape by shape as one would write them, and as they must be written to keep their digits.

shape_rows <- function(n) {
  d <- data.frame(
    shape = sample(c("disk", "rod", "hollow_sphere", "cone", "frustum", "capsule", "box"), n, TRUE),
    mass_kg = stats::runif(n, 0.5, 2), radius_m = stats::runif(n, 0.5, 2),
    length_m = stats::runif(n, 0.5, 2), width_m = stats::runif(n, 0.5, 2),
    height_m = stats::runif(n, 0.5, 2), outer_radius_m = stats::runif(n, 1, 2),
    base_radius_m = stats::runif(n, 0.5, 2), top_radius_m = stats::runif(n, 0.5, 2)
  )
  # Walls from thick to thin.
  d$inner_radius_m <- d$outer_radius_m * (1 - 10^-stats::runif(n, 0, 14))
  d
}

# Ixx, Iyy, Izz and beta of the rows of one shape.
plain_shapes <- list(
  disk = function(d) {
    with(d, list(
      mass_kg * radius_m^2 / 4, mass_kg * radius_m^2 / 4, mass_kg * radius_m^2 / 2, 0.5
    ))
  },
  rod = function(d) with(d, list(0, mass_kg * length_m^2 / 12, mass_kg * length_m^2 / 12, NA)),
  hollow_sphere = function(d) {
    with(d, {
      k <- 0.4 * (outer_radius_m^5 - inner_radius_m^5) / (outer_radius_m^3 - inner_radius_m^3)
      i <- mass_kg * k
      list(i, i, i, k / outer_radius_m^2)
    })
  },
  cone = function(d) {
    with(d, {
      across <- mass_kg * (3 * radius_m^2 / 20 + 3 * height_m^2 / 80)
      list(across, across, 3 * mass_kg * radius_m^2 / 10, NA)
    })
  },
  frustum = function(d) {
    with(d, {
      R <- base_radius_m
      r <- top_radius_m
      s <- R^2 + R * r + r^2
      axis <- 3 * mass_kg * (R^4 + R^3 * r + R^2 * r^2 + R * r^3 + r^4) / (10 * s)
      along <- 3 * mass_kg * height_m^2 *
        (R^4 + 4 * R^3 * r + 10 * R^2 * r^2 + 4 * R * r^3 + r^4) / (80 * s^2)
      list(axis / 2 + along, axis / 2 + along, axis, NA)
    })
  },
  capsule = function(d) {
    with(d, {
      r <- radius_m
      cylinder <- 3 * length_m / (3 * length_m + 4 * r)
      axis <- r^2 * (cylinder / 2 + 2 * (1 - cylinder) / 5)
      across <- cylinder * (r^2 / 4 + length_m^2 / 12) +
        (1 - cylinder) * (2 * r^2 / 5 + length_m^2 / 4 + 3 * length_m * r / 8)
      list(mass_kg * across, mass_kg * across, mass_kg * axis, axis / r^2)
    })
  },
  box = function(d) {
    with(d, list(
      mass_kg * (width_m^2 + height_m^2) / 12, mass_kg * (length_m^2 + height_m^2) / 12,
      mass_kg * (length_m^2 + width_m^2) / 12, NA
    ))
  }
)

# The same columns as inertia_table(), but for the texts.
plain_table <- function(d, shapes = plain_shapes) {
  n <- nrow(d)
  values <- matrix(NA_real_, n, 4)
  for (shape in names(shapes)) {
    rows <- which(d$shape == shape)
    part <- shapes[[shape]](d[rows, ])
    for (k in 1:4) values[rows, k] <- part[[k]]
  }
  d$moment_of_inertia_kg_m2 <- d$izz_kg_m2 <- values[, 3]
  d$ixx_kg_m2 <- values[, 1]
  d$iyy_kg_m2 <- values[, 2]
  d$beta <- values[, 4]
  d$radius_of_gyration_m <- sqrt(values[, 3] / d$mass_kg)
  d
}

# The wall of a hollow sphere as it must be written.
careful_shapes <- plain_shapes
careful_shapes$hollow_sphere <- function(d) {
  with(d, {
    x <- inner_radius_m / outer_radius_m
    k <- 0.4 * (1 + x + x^2 + x^3 + x^4) / (1 + x + x^2)
    i <- mass_kg * outer_radius_m^2 * k
    list(i, i, i, k)
  })
}

# Izz of the hollow spheres among the rows, in 31 digits: they are what loses digits.
hollow_reference <- function(d) {
  outer <- d$outer_radius_m
  inner <- d$inner_radius_m
  square <- two_prod(outer, outer)
  hole <- two_prod(inner, inner)
  both <- two_prod(outer, inner)
  below <- plus(plus(square, both), hole)
  above <- plus(
    plus(times(square, square), times(square, both)),
    plus(times(both, both), plus(times(both, hole), times(hole, hole)))
  )
  times(over(times(above, 2), times(below, 5)), d$mass_kg)
}

run_shapes <- function(rounds) {
  set.seed(21)
  one <- function(case, n) {
    objects <- shape_rows(n)
    sample_rows <- utils::head(which(objects$shape == "hollow_sphere"), 1e4)
    reference <- hollow_reference(objects[sample_rows, ])
    judged <- function(name, run) {
      error <- max(off_by(run()$izz_kg_m2[sample_rows], reference) / abs(reference$hi))
      contender(name, run, error)
    }
    paired(
      "shapes", case,
      list(
        judged("rotdyn, inertia_table()", function() rotdyn::inertia_table(objects)),
        judged("base R, textbook formulas", function() plain_table(objects)),
        judged("base R, walls written with care", function() plain_table(objects, careful_shapes))
      ),
      rounds = if (n > 1e5) max(3, rounds %/% 3) else rounds, batches = 3, collect = n >= 1e5
    )
  }
  rbind(one("1e4 rows of seven shapes", 1e4), one("1e6 rows of seven shapes", 1e6))
}
