# Rotors in a line, from the side: rotors on one shaft, two bodies and a clutch, and the chains of
# scenes without a drawing of their own. `couplings`: kind and ratio of each. `more`: quantities
# besides those of shafting_quantities(); `clutch_labels`, and which rotors have brakes. `theta`: in
# motion, the angles.
draw_shafting <- function(scene, inertia, couplings, more = NULL, clutch_labels = NULL,
                       brakes = logical(length(inertia)), theta = NULL) {
  n <- length(inertia)
  # Heights and not areas: a rotor of a 16th of the inertia has half the height.
  height <- pmax(0.75 * (inertia / max(inertia))^0.25, 0.18)
  step <- 1.5
  x <- step * (seq_len(n) - 1)
  y <- double(n)
  marks <- list()
  labels <- label_at(character(), double(), double())
  add <- function(...) marks <<- c(marks, list(...))
  say <- function(...) labels <<- rbind(labels, label_at(...))
  few <- n <= 8L
  name <- function(symbol, i) paste0(symbol, "[", i, "]")
  stiff <- rep_len(scene[["stiffness_n_m_per_rad"]] %||% 1, max(n - 1L, 1L))
  for (i in seq_len(n - 1L)) {
    from <- x[i] + 0.2
    to <- x[i + 1L] - 0.2
    y[i + 1L] <- y[i]
    middle <- (from + to) / 2
    kind <- couplings$kind[i]
    if (kind == "gear" || abs(couplings$ratio[i]) != 1) {
      # The wheels touch; the larger one turns slower.
      r <- 0.9 * c(1, abs(couplings$ratio[i])) / (1 + abs(couplings$ratio[i]))
      down <- if (y[i] < 0) 1 else -1
      y[i + 1L] <- y[i] + down * sum(r)
      add(
        # The shaft of a coupling with a ratio is before its gears.
        if (kind == "spring" && stiff[i] > 0) {
          mark("line", draw_spring(from, middle, y[i], 0.08, 3L), "spring")
        } else {
          mark("line", rbind(c(from, y[i]), c(middle, y[i])), "body")
        },
        mark("line", rbind(c(middle, y[i + 1L]), c(to, y[i + 1L])), "body"),
        mark("fill", draw_box(middle, y[i], 0.14, 2 * r[1]), "shaft"),
        mark("fill", draw_box(middle, y[i + 1L], 0.14, 2 * r[2]), "shaft")
      )
      if (kind == "spring" && stiff[i] > 0 && few) {
        say(name("k", i), (from + middle) / 2, y[i] + 0.24)
      }
    } else if (kind %in% c("clutch", "locked")) {
      gap <- if (kind == "clutch") 0.09 else 0.05
      add(
        mark("line", rbind(c(from, y[i]), c(middle - gap, y[i])), "body"),
        mark("line", rbind(c(middle + gap, y[i]), c(to, y[i])), "body"),
        mark("fill", draw_box(middle - gap, y[i], 0.1, 0.7), "shaft"),
        mark("fill", draw_box(middle + gap, y[i], 0.1, 0.7), "shaft")
      )
      if (!is.null(clutch_labels)) say(clutch_labels[i], middle, y[i] + 0.52)
    } else if (stiff[i] > 0) {
      add(mark("line", draw_spring(from, to, y[i], 0.1), "spring"))
      if (few) say(name("k", i), middle, y[i] + 0.3 + 0.02 * n)
    } else {
      add(mark("line", rbind(c(from, y[i]), c(to, y[i])), "dashed"))
    }
  }
  torque <- scene[["torque"]]
  omega <- scene[["omega0_rad_per_s"]]
  acts <- function(i) {
    if (is.numeric(torque)) rep_len(torque, n)[i] else if (is.list(torque)) {
      law <- torque[[i]]
      if (is.null(law) || torque_is_zero(law)) 0 else torque_sign(law)
    } else 0
  }
  for (i in seq_len(n)) {
    add(mark("fill", draw_box(x[i], y[i], 0.4, 2 * height[i]), "body"))
    if (few) say(name("I", i), x[i], y[i])
    if (!is.null(theta)) marks <- c(marks, rotor_stripes(x[i], y[i], height[i], theta[i]))
    push <- acts(i)
    if (push != 0) {
      add(turn_arrow(x[i], y[i] + height[i] + 0.05, 0.28, 20, 140, push, "torque"))
      if (few) say(name("tau", i), x[i], y[i] + height[i] + 0.52)
    }
    if (brakes[i]) {
      under <- y[i] - height[i]
      add(
        mark("fill", draw_box(x[i], under - 0.07, 0.3, 0.12), "fixed"),
        mark("arrow", rbind(c(x[i], under - 0.36), c(x[i], under - 0.14)), "resistance")
      )
      if (few) say(name("B", i), x[i] + 0.26, under - 0.28)
    }
    rate <- if (is.numeric(omega)) rep_len(omega, n)[i] else 0
    if (rate != 0) {
      # Below the brake and its arrow.
      under <- y[i] - height[i] - if (brakes[i]) 0.4 else 0
      add(turn_arrow(x[i], under - 0.05, 0.28, 200, 140, rate, "speed"))
      if (few) say(name("omega", i), x[i], under - 0.54)
    }
  }
  list(
    marks = marks, labels = labels, quantities = rbind(shafting_quantities(scene, inertia), more),
    limits = c(
      -0.5, max(x) + 0.5, min(y - height) - if (any(brakes)) 1.15 else 0.75,
      max(y + height) + 0.75
    ),
    note = "from the side, not to scale"
  )
}

# Four stripes on the rim, where they are on this side: at the top at first, then to the front.
rotor_stripes <- function(x, y, height, theta) {
  at <- theta + pi / 2 * (3:0)
  style <- rep(c("body", "speed"), c(3L, 1L))
  front <- which(sin(at) >= -1e-9)
  lapply(front, function(k) {
    mark("line", cbind(x + c(-0.2, 0.2), y + height * cos(at[k])), style[k])
  })
}

# drawn(scene, theta) for each time of a motion: theta and omega have a column for each.
shafting_frames <- function(scene, theta, omega, drawn) {
  lapply(seq_len(ncol(theta)), function(i) {
    scene$omega0_rad_per_s <- omega[, i]
    drawn(scene, theta[, i])
  })
}

# Of rows by time, then rotor.
shafting_frames_long <- function(drawn) {
  function(scene, rows) {
    by_rotor <- function(column) matrix(column, nrow = length(scene$moment_of_inertia_kg_m2))
    shafting_frames(scene, by_rotor(rows$theta_rad), by_rotor(rows$omega_rad_per_s), drawn)
  }
}

torque_sign <- function(law) {
  if (!inherits(law, "rot_torque_knots")) return(1)
  values <- c(law$torque_n_m, law$outside)
  if (sum(values) < 0) -1 else 1
}

shafting_quantities <- function(scene, inertia) {
  any_of <- function(field) {
    x <- scene[[field]]
    is.numeric(x) && any(x != 0)
  }
  of <- function(field, symbol, name, unit, style) {
    if (any_of(field)) quantity(symbol, name, value_text(scene[[field]], unit), style)
  }
  laws <- scene[["torque"]]
  acting <- if (is.list(laws) && !inherits(laws, "rot_torque")) {
    which(!vapply(laws, function(law) is.null(law) || torque_is_zero(law), NA))
  }
  rbind(
    quantity("I[i]", "moment of inertia", value_text(inertia, "kg m^2")),
    of("stiffness_n_m_per_rad", "k[i]", "stiffness", "N m/rad", "spring"),
    of("damping_n_m_s", "", "damping between", "N m s", "spring"),
    if (is.numeric(scene[["resistance"]])) {
      of("resistance", "", "damping outside", "N m s", "resistance")
    },
    if (!is.null(scene[["capacity_n_m"]])) {
      quantity(
        "T", "clutch", paste0(
          value_text(scene$capacity_n_m, "N m"),
          if (scene$static_capacity_n_m > scene$capacity_n_m) {
            paste0(", ", value_text(scene$static_capacity_n_m, "N m locked"))
          },
          if (is.finite(scene$engage_s) && scene$engage_s > scene$start_s) {
            paste0(", from ", format_si(scene$engage_s), " s")
          }
        ), "resistance"
      )
    },
    if (is.numeric(laws)) of("torque", "tau[i]", "torque", "N m", "torque"),
    if (length(acting)) {
      do.call(rbind, lapply(acting, function(i) {
        quantity(paste0("tau[", i, "]"), "torque", torque_text(laws[[i]]), "torque")
      }))
    },
    of("theta0_rad", "theta[i]", "angle at start", "rad", "speed"),
    of("omega0_rad_per_s", "omega[i]", "rate at start", "rad/s", "speed")
  )
}
