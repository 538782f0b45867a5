# A body on a fixed axle, seen along it: a wheel with torque, brake, spring and start; a pendulum; a
# skater. Gear trains are in R/plot-gears.R.
# `ray`: where the radius of a wheel is drawn.
draw_axle <- function(scene, ray = -0.6) {
  if (!is.null(changing_inertia(scene))) return(draw_skater(scene))
  torque <- axle_torque(scene)
  terms <- torque_loads(torque)$terms
  kinds <- vapply(terms, function(term) term$kind, "")
  if ("gravity" %in% kinds) return(draw_pendulum(scene))
  look <- axle_outline(scene)
  spring <- Filter(function(term) term$kind == "spring", terms)
  coiled <- length(spring) > 0L
  d <- new_drawing()
  for (one in look$marks) d$add(one)
  d$key(quantity("I", "moment of inertia", value_text(scene$moment_of_inertia_kg_m2, "kg m^2")))
  d$keys(size_quantities(scene$body))
  # Spokes of a wheel, which show turns.
  if (!coiled && (!is.null(look$radius) || is.na(look$unit))) {
    long <- if (is.null(look$radius)) 1 else look$unit * look$radius
    for (k in 1:5) d$add(spoke(0, 0, 0.92 * long, ray + k * pi / 3, "shaft"))
  }
  if (!is.null(look$radius)) {
    tip <- look$unit * look$radius * c(cos(ray), sin(ray))
    d$add(mark("line", rbind(c(0, 0), tip), "body"))
    d$say(look$symbol, 0.62 * tip[1] + 0.07, 0.62 * tip[2] + 0.1)
  }
  d$add(mark("fill", draw_circle(0, 0, 0.06), "shaft"))
  rim <- look$reach
  # The letters of the bearing and of the angle stand outside of a spring.
  draw_start(d, scene, rim, if (coiled) 0.7 else 0.42)
  draw_torque(d, torque_without(torque, c("gravity", "spring")), rim + 0.16)
  for (term in spring) draw_torsion_spring(d, term)
  away <- if (coiled) c(0.3, 0.74) else c(0.16, 0.15)
  draw_resistance(d, axle_resistance(scene), rim, away = away)
  d$done(c(-1.5, 1.5, -1.5, 1.5), look$note)
}

# A row of a scene at its start, or NULL where there is none (a rope that is slack, an R function
# that fails): forces of drawings.
start_row <- function(scene) {
  tryCatch(
    suppressMessages(suppressWarnings(trajectory(scene, scene$start_s))), error = function(e) NULL
  )
}

# Tensions of a row: c(first, second).
tensions_of <- function(rows, i = 1L) {
  at <- function(name) if (is.null(rows[[name]])) NA_real_ else rows[[name]][i]
  if (!is.null(rows[["tension_n"]])) c(at("tension_n"), NA) else
    c(at("tension_1_n"), at("tension_2_n"))
}

# A pulley with one or two masses and all forces on each: weights, and the tensions of the ropes on
# masses and pulley, in one scale. Positive is where the first goes down: on the left. In motion,
# `down`: how far it has, and the tensions.
draw_hanging <- function(scene, down = NULL, tension = tensions_of(start_row(scene))) {
  masses <- masses_of(scene)
  weight <- masses * scene$gravity_m_per_s2
  unit <- 0.42 / max(weight, tension, 1e-300, na.rm = TRUE)
  look <- axle_outline(scene, 0.6)
  drawn <- if (is.na(look$unit)) 0.6 else min(max(look$unit * scene$radius_m, 0.15), 0.9)
  d <- new_drawing()
  for (one in look$marks) d$add(one)
  if (drawn < 0.95 * look$reach) d$add(mark("line", draw_circle(0, 0, drawn), "spring"))
  d$add(mark("line", rbind(c(0, 0), c(-drawn, 0)), "shaft"))
  d$say("r[1]", -drawn / 2, 0.12)
  d$add(mark("fill", draw_circle(0, 0, 0.05), "shaft"))
  both <- masses[2] > 0
  # The cube of the side shows the mass.
  side <- 0.42 * (masses / max(masses))^(1 / 3)
  for (i in seq_len(1L + both)) {
    x <- c(-1, 1)[i] * drawn
    y <- -1 + c(-1, 1)[i] * (down %||% 0)
    half <- max(side[i], 0.12) / 2
    side_of <- c(-1, 1)[i]
    d$add(mark("line", rbind(c(x, 0), c(x, y)), "spring"))
    d$add(mark("fill", draw_box(x, y - half, 2 * half, 2 * half), "body"))
    if (weight[i] > 0) {
      tip <- y - half - unit * weight[i]
      d$add(mark("arrow", rbind(c(x, y - half), c(x, tip)), "weight"))
      d$say(paste0("W[", i, "]"), x - 0.17 * side_of, min(tip, y - 2 * half) - 0.1)
    }
    if (isTRUE(tension[i] * unit > 0.01)) {
      for (from in c(y, 0)) {
        to <- from + (if (from == 0) -1 else 1) * unit * tension[i]
        d$add(mark("arrow", rbind(c(x, from), c(x, to)), "torque"))
      }
      d$say(paste0("T[", i, "]"), x + 0.17 * side_of, y + 0.7 * unit * tension[i])
    }
    d$say(paste0("m[", i, "]"), x + side_of * (half + 0.18), y - half)
    name <- if (!both) "hanging mass" else c("mass, down is positive", "other mass")[i]
    d$key(quantity(paste0("m[", i, "]"), name, value_text(masses[i], "kg")))
  }
  for (i in seq_len(1L + both)) {
    d$key(quantity(paste0("W[", i, "]"), "weight", value_text(weight[i], "N"), "weight"))
    if (is.finite(tension[i])) {
      d$key(quantity(
        paste0("T[", i, "]"), "tension at start", value_text(tension[i], "N"), "torque"
      ))
    }
  }
  d$key(quantity("r[1]", "radius of the rope", value_text(scene$radius_m, "m")))
  d$key(quantity("I", "inertia of all", value_text(scene$moment_of_inertia_kg_m2, "kg m^2")))
  # The rope lies on the upper half of its wheel.
  if (both) d$add(mark("line", draw_arc(0, 0, drawn, 0, 180), "spring"))
  at_rim <- isTRUE(all.equal(look$radius, scene$radius_m))
  if (inherits(scene$body, "rot_body")) {
    sizes <- size_quantities(scene$body, if (at_rim) 0L else 1L)
    sizes$name[1] <- "mass of the pulley"
    d$keys(sizes)
  }
  if (is.null(down)) {
    draw_start(d, scene, look$reach)
  } else {
    d$add(spoke(0, 0, look$reach, scene$theta0_rad))
  }
  draw_resistance(d, axle_resistance(scene), look$reach)
  out <- d$done(c(-1.5, 1.5, -1.95, 1.05), if (is.na(look$unit)) "not to scale" else
    "the pulley to scale")
  out$title <- sentence(hanging_title(scene))
  out
}

# A drawing in the making.
new_drawing <- function() {
  marks <- list()
  labels <- label_at(character(), double(), double())
  quantities <- NULL
  list(
    add = function(...) marks <<- c(marks, list(...)),
    say = function(...) labels <<- rbind(labels, label_at(...)),
    key = function(one) quantities <<- rbind(quantities, one),
    keys = function(all) quantities <<- rbind(quantities, all),
    done = function(limits, note = NULL) {
      list(marks = marks, labels = labels, quantities = quantities, limits = limits, note = note)
    }
  )
}

# A point of the axle, in the body's own axes. A pulley turns about its centre.
axle_point <- function(scene) {
  body <- scene$body
  through <- .subset2(scene, "through")
  if (is.null(through) && is.null(.subset2(scene, "radius_m"))) return(named_point(body))
  as_point(through %||% "centre", body, "through", NULL)
}

# The outline of the scene's body along its axle, turned by the start: marks, reach (in the
# drawing), unit (length of a metre), radius and its symbol for a round body.
axle_outline <- function(scene, radius = 1) {
  body <- scene$body
  solids <- if (inherits(body, "rot_body")) body_solids(body)
  wheel <- list(
    marks = list(mark("fill", draw_circle(0, 0, radius), "body")), reach = radius, unit = NA,
    note = "not to scale"
  )
  if (!length(solids)) return(wheel)
  plane <- across_axle(scene$axis, scene$theta0_rad)
  at <- axle_point(scene)
  flat <- project_solids(lapply(solids, move_solid, diag(3), -at), plane)
  all <- do.call(rbind, flat)
  reach <- max(sqrt(all$across^2 + all$up^2))
  if (!is.finite(reach) || reach == 0) return(wheel)
  marks <- outline_marks(flat, radius / reach)
  letters <- size_letters(body)
  round <- letters[letters$word %in% c("radius", "outer radius"), ]
  fits <- nrow(round) && isTRUE(all.equal(round$value[1], reach, tolerance = 1e-6))
  list(
    marks = marks, reach = radius, unit = radius / reach, note = "the body to scale",
    radius = if (fits) round$value[1], symbol = if (fits) round$letter[1]
  )
}

# Shadows as marks, with lengths multiplied by `unit`.
outline_marks <- function(flat, unit, at = c(0, 0)) {
  of <- function(table, type, style) {
    lapply(split(table, table$group), function(one) {
      xy <- cbind(at[1] + unit * one$across, at[2] + unit * one$up)
      mark(type, xy, if (isTRUE(one$hole[1])) "hole" else style)
    })
  }
  # The triangles of a mesh would be many marks: its convex outline stands for them.
  mesh <- flat$mesh
  if (nrow(mesh)) mesh <- mesh[grDevices::chull(mesh$across, mesh$up), ]
  if (nrow(mesh)) mesh$group <- 0
  line <- if (nrow(mesh)) flat$line[flat$line$group < 1e7, ] else flat$line
  unname(c(of(mesh, "fill", "body"), of(flat$fill, "fill", "body"), of(line, "line", "body")))
}

# Letter, word and value of each size of a catalogue body, as in its formulas.
size_letters <- function(body) {
  none <- data.frame(letter = character(), word = character(), value = double())
  if (!inherits(body, "rot_body") || !length(body$size_m)) return(none)
  row <- match(body$shape, shape_words_table$shape)
  if (is.na(row)) return(none)
  parts <- strsplit(strsplit(shape_words_table$sizes[row], ", ")[[1]], " = ")
  if (length(parts) != length(body$size_m)) return(none)
  data.frame(
    # l looks like the I of the moment of inertia.
    letter = sub("^l$", "L", vapply(parts, `[`, "", 1L)),
    word = gsub("_", " ", sub("_m$", "", vapply(parts, `[`, "", 2L))),
    value = unname(body$size_m)
  )
}

size_quantities <- function(body, maximum = 3L) {
  if (!inherits(body, "rot_body")) return(NULL)
  sizes <- utils::head(size_letters(body), maximum)
  rbind(
    quantity("m", "mass", value_text(body$mass_kg, "kg")),
    if (nrow(sizes)) {
      do.call(rbind, Map(function(letter, word, value) {
        quantity(letter, word, value_text(value, if (word == "sides") "" else "m"))
      }, sizes$letter, sizes$word, sizes$value))
    }
  )
}

start_rate <- function(scene) {
  quantity("omega[0]", "rate at start", value_text(scene$omega0_rad_per_s, "rad/s"), "speed")
}

draw_start <- function(d, scene, rim, arc = 0.42) {
  if (scene$theta0_rad != 0) {
    theta <- scene$theta0_rad
    end <- (rim + 0.08) * c(cos(theta), sin(theta))
    d$add(mark("line", rbind(c(0, 0), c(rim + 0.08, 0)), "dashed"))
    d$add(mark("line", rbind(c(0, 0), end), "dashed"))
    shown <- (theta * 180 / pi) %% (360 * sign(theta))
    d$add(mark("line", draw_arc(0, 0, arc, 0, shown), "speed"))
    middle <- shown / 2 * pi / 180
    # There is no room between the rays of a small angle.
    out <- if (abs(shown) < 25) rim + 0.26 else arc + 0.2
    d$say("theta[0]", out * cos(middle), out * sin(middle))
    d$key(quantity("theta[0]", "angle at start", value_text(theta, "rad"), "speed"))
  }
  if (scene$omega0_rad_per_s != 0) {
    d$add(turn_arrow(0, 0, rim + 0.16, 20, 50, scene$omega0_rad_per_s, "speed"))
    d$say("omega[0]", (rim + 0.36) * cos(pi / 4), (rim + 0.36) * sin(pi / 4))
    d$key(start_rate(scene))
  }
}

draw_torque <- function(d, torque, radius, from = 110) {
  if (is.null(torque) || torque_is_zero(torque)) return(invisible())
  d$add(turn_arrow(0, 0, radius, from, 50, torque_sign(torque), "torque"))
  middle <- (from + 25) * pi / 180
  d$say("tau", (radius + 0.2) * cos(middle), (radius + 0.2) * sin(middle))
  d$key(quantity("tau", "torque", torque_text(torque), "torque"))
}

# The law without terms of some kinds, which are drawn otherwise; NULL if nothing is left.
torque_without <- function(torque, kinds) {
  laws <- if (inherits(torque, "rot_torque_sum")) torque$laws else list(torque)
  laws <- Filter(function(law) {
    !(inherits(law, "rot_torque_term") && law$kind %in% kinds) && !torque_is_zero(law)
  }, laws)
  if (length(laws) > 1L) do.call(sum_torques, laws) else if (length(laws)) laws[[1]]
}

draw_torsion_spring <- function(d, term) {
  turn <- seq(0, 5 * pi, length.out = 200L)
  radius <- 0.1 + 0.45 * turn / max(turn)
  d$add(mark("line", cbind(radius * cos(turn), radius * sin(turn)), "spring"))
  end <- utils::tail(cbind(radius * cos(turn), radius * sin(turn)), 1L)
  d$add(mark("fill", draw_box(end[1], end[2], 0.1, 0.1), "fixed"))
  d$say("k", end[1] - 0.02, end[2] - 0.2)
  rest <- term$x[2]
  d$key(quantity(
    "k", "spring", paste0(
      value_text(term$x[1], "N m/rad"),
      if (rest != 0) paste0(", at rest at ", format_si(rest), " rad")
    ), "spring"
  ))
}

# A brake shoe under the rim for dry friction; the bearing's letters at the axle, `away` from it on
# the left (on the right where it is negative).
draw_resistance <- function(d, resistance, rim, at = c(0, 0), away = c(0.16, 0.15)) {
  if (resistance$static_n_m != 0) {
    d$add(mark("fill", draw_box(at[1], at[2] - rim - 0.09, 0.5, 0.16), "fixed"))
    d$add(mark("arrow", rbind(
      c(at[1], at[2] - rim - 0.42), c(at[1], at[2] - rim - 0.19)
    ), "resistance"))
    d$say("tau[f]", at[1] + 0.2, at[2] - rim - 0.34)
    more <- if (resistance$static_n_m > resistance$coulomb_n_m) {
      paste0(", ", format_si(signif(resistance$static_n_m, 4)), " at rest")
    }
    d$key(quantity(
      "tau[f]", "dry friction", paste0(value_text(resistance$coulomb_n_m, "N m"), more),
      "resistance"
    ))
  }
  if (resistance$viscous_n_m_s != 0) {
    d$say("c", at[1] - away[1], at[2] - away[2])
    d$key(quantity("c", "viscous", value_text(resistance$viscous_n_m_s, "N m s"), "resistance"))
  }
  if (resistance$quadratic_n_m_s2 != 0) {
    d$say("q", at[1] - away[1], at[2] + away[2])
    d$key(quantity(
      "q", "quadratic drag", value_text(resistance$quadratic_n_m_s2, "N m s^2"), "resistance"
    ))
  }
}

# Where the body hangs is known, how it is turned about its centre is not: its longest side points
# to the axle.
draw_pendulum <- function(scene) {
  hangs <- !is.null(.subset2(scene, "distance_m"))
  torque <- axle_torque(scene)
  terms <- torque_loads(torque)$terms
  term <- Find(function(term) term$kind == "gravity", terms)
  rest <- term$x[2]
  swing <- scene$theta0_rad - rest
  body <- scene$body
  d <- new_drawing()
  solids <- if (inherits(body, "rot_body")) body_solids(body)
  flat <- if (length(solids)) {
    centre <- as.double(body$centre_m)
    solids <- lapply(solids, move_solid, diag(3), -centre)
    plane <- across_axle(scene$axis, 0)
    own <- eigen(t(plane) %*% body$second_moment_kg_m2 %*% plane, symmetric = TRUE)$vectors
    # The first own direction down, then turned by the angle of the start.
    down <- cbind(own[, 1], c(-own[2, 1], own[1, 1])) %*% rbind(c(0, -1), c(1, 0))
    turn <- rbind(c(cos(swing), sin(swing)), c(-sin(swing), cos(swing)))
    project_solids(solids, plane %*% down %*% turn)
  }
  distance <- if (hangs) scene$distance_m else 1
  all <- if (!is.null(flat)) do.call(rbind, flat)
  size <- if (is.null(all)) 0 else max(sqrt(all$across^2 + all$up^2))
  unit <- 1.2 / max(distance + size, .Machine$double.xmin)
  to <- function(angle) c(sin(angle), -cos(angle))
  at <- unit * distance * to(swing)
  for (one in if (!is.null(flat)) outline_marks(flat, unit, at)) d$add(one)
  d$add(mark("line", rbind(c(0, 0), 1.3 * to(0)), "dashed"))
  d$add(mark("line", rbind(c(0, 0), at), "body"))
  d$add(mark("fill", draw_circle(at[1], at[2], if (is.null(flat)) 0.09 else 0.035), "shaft"))
  d$add(mark("fill", draw_circle(0, 0, 0.05), "fixed"))
  d$add(mark("arrow", rbind(at, at - c(0, 0.42)), "weight"))
  side <- if (swing < 0) -1 else 1
  if (!hangs) {
    d$say("m*g*d", at[1] + 0.4, at[2] - 0.3)
    d$key(quantity("m*g*d", "weight times distance", value_text(term$x[1], "N m"), "weight"))
  } else {
    # Inside small angles, outside the arc of large ones.
    d$say("m*g", at[1] + (if (abs(swing) > 1) 0.18 else -0.18) * side, at[2] - 0.36)
    away <- 0.14 * side
    d$say("d", 0.5 * at[1] + away * cos(swing), 0.5 * at[2] + away * sin(swing))
    weight <- body$mass_kg * scene$gravity_m_per_s2
    d$key(quantity("m*g", "weight", value_text(weight, "N"), "weight"))
    d$key(quantity("m", "mass", value_text(body$mass_kg, "kg")))
    d$key(quantity("d", "axle to centre", value_text(scene$distance_m, "m")))
  }
  d$key(quantity("I", "moment of inertia", value_text(scene$moment_of_inertia_kg_m2, "kg m^2")))
  sizes <- size_letters(body)
  if (nrow(sizes)) {
    d$keys(size_quantities(body, 2L)[-1, ])
  }
  if (swing != 0) {
    shown <- (swing * 180 / pi) %% (360 * sign(swing))
    d$add(mark("line", draw_arc(0, 0, 0.36, -90, -90 + shown), "speed"))
    middle <- swing / 2
    d$say("theta[0]", 0.54 * sin(middle), -0.54 * cos(middle))
    d$key(quantity("theta[0]", "angle at start", value_text(scene$theta0_rad, "rad"), "speed"))
  }
  if (scene$omega0_rad_per_s != 0) {
    d$add(turn_arrow(0, 0, 1.32, -90 + swing * 180 / pi + 8, 30, scene$omega0_rad_per_s, "speed"))
    d$say("omega[0]", 1.46 * sin(swing + 0.4), -1.46 * cos(swing + 0.4))
    d$key(start_rate(scene))
  }
  driven <- torque_without(torque, c("gravity", "spring"))
  draw_torque(d, driven, 0.6, from = 60)
  for (term in Filter(function(term) term$kind == "spring", terms)) {
    draw_torsion_spring(d, term)
  }
  draw_resistance(d, axle_resistance(scene), 0.12, away = c(0.18 * side, -0.16))
  top <- max(0.4, at[2] + unit * size, if (cos(swing) < 0.2) 1.4, if (!is.null(driven)) 0.85)
  d$done(
    c(-1.35, 1.35, -1.55, top + 0.1),
    if (is.null(flat)) "not to scale" else "the body to scale"
  )
}

# Arms with masses at the radius of gyration, before and after.
draw_skater <- function(scene) {
  knots <- changing_inertia(scene)
  moments <- knots$moment_of_inertia_kg_m2
  n <- length(moments)
  arm <- sqrt(moments / max(moments))
  d <- new_drawing()
  balls <- function(r, style) {
    for (side in c(-1, 1)) d$add(mark("fill", draw_circle(side * r, 0, 0.11), style))
  }
  d$add(mark("line", rbind(c(-max(arm), 0), c(max(arm), 0)), "body"))
  balls(arm[n], "hole")
  balls(arm[1], "body")
  d$add(mark("fill", draw_circle(0, 0, 0.14), "shaft"))
  if (arm[n] != arm[1]) {
    step <- sign(arm[n] - arm[1])
    for (side in c(-1, 1)) {
      ends <- side * c(arm[1] + 0.02 * step, arm[n] - 0.12 * step)
      d$add(mark("arrow", cbind(ends, 0.24), "body"))
    }
  }
  d$say("I", arm[1], -0.3)
  d$key(quantity("I", "moment of inertia", paste(
    paste(format_si(signif(moments[c(1, n)], 4)), collapse = " to "), "kg m^2,",
    paste(format_si(signif(knots$time_s[c(1, n)], 4)), collapse = " to "), "s"
  )))
  draw_start(d, scene, 1.1)
  draw_torque(d, torque_without(axle_torque(scene), character()), 1.26)
  draw_resistance(d, axle_resistance(scene), 0.2)
  d$done(c(-1.5, 1.5, -1.5, 1.5), "masses at the radius of gyration, dashed at the end")
}

# ---- in motion ----------------------------------------------------------------------------------

axle_frames <- function(scene, rows) {
  frame <- if (is.null(changing_inertia(scene))) {
    function(i, theta) {
      scene$theta0_rad <- theta
      scene$omega0_rad_per_s <- rows$omega_rad_per_s[i]
      draw_axle(scene, theta)
    }
  } else {
    skater_frame(scene, rows$moment_of_inertia_kg_m2)
  }
  frames_of(rows, frame)
}

frames_of <- function(rows, frame) {
  lapply(seq_along(rows$theta_rad), function(i) frame(i, rows$theta_rad[i]))
}

spoke <- function(x, y, radius, theta, style = "body") {
  mark("line", rbind(c(x, y), c(x, y) + radius * c(cos(theta), sin(theta))), style)
}

train_frames <- function(scene, rows) {
  train <- train_of_scene(scene)
  frames_of(rows, function(i, theta) {
    scene$omega0_rad_per_s <- rows$omega_rad_per_s[i]
    draw_train(train, scene, theta)
  })
}

skater_frame <- function(scene, moments) {
  arm <- sqrt(moments / max(changing_inertia(scene)$moment_of_inertia_kg_m2))
  function(i, theta) {
    out <- arm[i] * c(cos(theta), sin(theta))
    list(
      marks = list(
        mark("line", rbind(-out, out), "body"),
        mark("fill", draw_circle(-out[1], -out[2], 0.11), "body"),
        mark("fill", draw_circle(out[1], out[2], 0.11), "body"),
        mark("fill", draw_circle(0, 0, 0.14), "shaft")
      ),
      limits = c(-1.5, 1.5, -1.5, 1.5)
    )
  }
}

# The masses move by 0.8 of the drawing in all.
hanging_frames <- function(scene, rows) {
  theta <- rows$theta_rad
  span <- diff(range(theta))
  down <- if (span > 0) 0.8 * (theta - mean(range(theta))) / span else 0 * theta
  frames_of(rows, function(i, theta) {
    scene$theta0_rad <- theta
    out <- draw_hanging(scene, down[i], tensions_of(rows, i))
    out$limits[3] <- -2.35
    out
  })
}
