# A chain of pendulums in its plane, to scale; the length of all is 1.
draw_chain <- function(scene, theta = scene$theta0_rad) {
  d <- new_drawing()
  n <- length(scene$length_m)
  theta <- rep_len(theta, n)
  at <- chain_places(scene, theta)
  for (one in chain_marks(scene, theta)) d$add(one)
  # Angles from the vertical through the upper end of each link, named on its other side.
  if (n <= 4L) {
    for (i in which(abs(theta) >= 0.05)) {
      long <- 0.35 * scene$length_m[i] / sum(scene$length_m)
      down <- rbind(at[i, ], at[i, ] - c(0, 1.5 * long))
      d$add(mark("line", down, "dashed"))
      d$add(mark("line", draw_arc(
        at[i, 1], at[i, 2], long, -90, -90 + theta[i] * 180 / pi
      ), "resistance"))
      symbol <- if (n == 1L) "theta" else paste0("theta[", i, "]")
      d$say(symbol, at[i, 1] - 0.07 * sign(theta[i]), at[i, 2] - long)
    }
  }
  shown <- function(x, unit) {
    if (length(unique(x)) == 1L) x <- x[1]
    more <- if (length(x) > 4L) ", ..."
    paste0(paste(format_si(signif(utils::head(x, 4L), 4)), collapse = ", "), more, " ", unit)
  }
  d$key(quantity("l", "lengths", shown(scene$length_m, "m")))
  what <- if (scene$links == "rods") "masses of the rods" else "masses at the ends"
  d$key(quantity("m", what, shown(scene$mass_kg, "kg"), "weight"))
  symbol <- if (n == 1L) "theta" else "theta[i]"
  d$key(quantity(symbol, "angles at start", shown(scene$theta0_rad, "rad"), "resistance"))
  d$key(quantity("omega[0]", "rates at start", shown(scene$omega0_rad_per_s, "rad/s"), "speed"))
  if (any(scene$resistance > 0)) {
    d$key(quantity("c", "viscous joints", shown(scene$resistance, "N m s"), "resistance"))
  }
  half <- max(0.4, 0.15 + diff(range(at[, 1])) / 2, 0.15 + diff(range(at[, 2])) / 2)
  middle <- c(mean(range(at[, 1])), mean(range(at[, 2])))
  d$done(c(middle[1] + c(-half, half), middle[2] + c(-half, half)), "to scale")
}

# Ends of the links, from the pivot down, in parts of the whole length.
chain_places <- function(scene, theta) {
  part <- scene$length_m / sum(scene$length_m)
  rbind(c(0, 0), cbind(cumsum(part * sin(theta)), -cumsum(part * cos(theta))))
}

chain_marks <- function(scene, theta) {
  at <- chain_places(scene, theta)
  n <- length(scene$length_m)
  links <- lapply(seq_len(n), function(i) {
    if (scene$links == "points") return(mark("line", at[i + 0:1, ], "body"))
    aside <- 0.022 * c(cos(theta[i]), sin(theta[i]))
    corners <- rbind(at[i, ] + aside, at[i + 1, ] + aside, at[i + 1, ] - aside, at[i, ] - aside)
    mark("fill", corners, "body")
  })
  mass <- rep_len(scene$mass_kg, n)
  balls <- if (scene$links == "points") {
    radius <- 0.05 * (mass / max(mass))^(1 / 3)
    lapply(seq_len(n), function(i) {
      mark("fill", draw_circle(at[i + 1, 1], at[i + 1, 2], radius[i]), "body")
    })
  } else {
    lapply(seq_len(n)[-1], function(i) {
      mark("fill", draw_circle(at[i, 1], at[i, 2], 0.015), "shaft")
    })
  }
  pivot <- mark("fill", draw_circle(0, 0, 0.03), "fixed")
  c(list(pivot), links, balls)
}

# In motion, with the path of the lowest end in the last twelfth of the film.
chain_frames <- function(scene, rows) {
  theta <- matrix(rows$theta_rad, nrow = length(scene$length_m))
  last <- t(apply(theta, 2, function(one) {
    at <- chain_places(scene, one)
    at[nrow(at), ]
  }))
  n <- ncol(theta)
  lapply(seq_len(n), function(i) {
    path <- last[max(1L, i - ceiling(n / 12)):i, , drop = FALSE]
    list(
      marks = c(
        if (nrow(path) > 1L) list(mark("line", path, "speed")), chain_marks(scene, theta[, i])
      ),
      says = "", limits = c(-1.15, 1.15, -1.15, 1.15)
    )
  })
}
