# A free body: the ellipsoid of its second moments, with its principal axes, its angular velocity
# and angular momentum, and the wheels of its rotors. Seen from 30 degrees beside x, towards y, and
# 25 degrees above: y points to the right, z up, x towards the reader.
draw_free <- function(scene) {
  d <- new_drawing()
  view <- view_of_space()
  moments <- scene$moment_of_inertia_kg_m2
  turn <- matrix_of_quaternion(scene$attitude0, "attitude0", NULL)
  principal <- turn
  if (scene$axes[1] != 1) principal <- turn %*% matrix_of_quaternion(scene$axes, "axes", NULL)
  semi <- sqrt(pmax(sum(moments) / 2 - moments, 1e-4 * max(moments)))
  semi <- 0.8 * semi / max(semi)
  flat <- view %*% principal %*% (semi^2 * t(principal)) %*% t(view)
  root <- eigen(flat, symmetric = TRUE)
  around <- seq(0, 2 * pi, length.out = 181)
  outline <- t(root$vectors %*% (sqrt(pmax(root$values, 1e-6)) * rbind(cos(around), sin(around))))
  d$add(mark("fill", outline, "body"))
  for (k in 1:3) {
    # Arrows point along positive axes more often than not: the names stand at the other ends.
    tip <- -as.vector(view %*% principal[, k]) * (semi[k] + 0.15)
    d$add(mark("line", rbind(-tip, tip), "resistance"))
    away <- tip + 0.12 * tip / max(sqrt(sum(tip^2)), 1e-3)
    d$say(paste0("I[", k, "]"), away[1], away[2])
  }
  for (k in 1:3) {
    value <- value_text(moments[k], "kg m^2")
    d$key(quantity(paste0("I[", k, "]"), "principal moment", value, "resistance"))
  }
  arrow <- function(v, symbol, name, value, style, long, aside) {
    size <- sqrt(sum(v^2))
    if (size > 0) {
      tip <- as.vector(view %*% (turn %*% v)) * long / size
      d$add(mark("arrow", rbind(c(0, 0), tip), style))
      # Beside the tip: two arrows may have one direction.
      at <- tip + aside * c(-tip[2], tip[1]) / max(sqrt(sum(tip^2)), 1e-3)
      d$say(symbol, at[1], at[2])
    }
    d$key(quantity(symbol, name, value, style))
  }
  omega <- scene$omega0_rad_per_s
  momentum <- as.vector(free_tensor(scene) %*% omega) + rotor_momentum(scene)
  size <- function(v, unit) value_text(signif(sqrt(sum(v^2)), 4), unit)
  arrow(omega, "omega", "angular velocity", size(omega, "rad/s"), "speed", 1.35, -0.12)
  arrow(momentum, "L", "angular momentum", size(momentum, "kg m^2/s"), "weight", 1.1, 0.12)
  draw_rotors(d, scene, view %*% turn)
  torque <- scene$torque
  if (is.numeric(torque)) {
    if (scene$torque_axes == "space") torque <- as.vector(t(turn) %*% torque)
    arrow(torque, "tau", "torque", size(torque, "N m"), "torque", 1.2, 0.12)
  }
  damping <- resistance_term(scene, "damping_per_s")
  if (damping != 0) {
    d$key(quantity("gamma", "damping", value_text(damping, "1/s"), "resistance"))
  }
  d$done(c(-1.5, 1.5, -1.5, 1.5), "the ellipsoid of the second moments; not to scale")
}

# Wheels on their axes, each with the arrow of its spin.
draw_rotors <- function(d, scene, view) {
  around <- seq(0, 2 * pi, length.out = 61)
  for (k in seq_along(scene$rotors)) {
    one <- scene$rotors[[k]]
    basis <- qr.Q(qr(cbind(one$axis, diag(3))))[, 2:3]
    spin <- sign(one$omega_rad_per_s)
    out <- if (spin < 0) -one$axis else one$axis
    rim <- 0.4 * out + 0.22 * basis %*% rbind(cos(around), sin(around))
    d$add(mark("line", t(view %*% rim), "spring"))
    tip <- 0.75 * as.vector(view %*% out)
    d$add(mark(if (spin == 0) "line" else "arrow", rbind(c(0, 0), tip), "spring"))
    symbol <- if (length(scene$rotors) > 1) paste0("W[", k, "]") else "W"
    aside <- c(-tip[2], tip[1]) / max(sqrt(sum(tip^2)), 1e-3)
    d$say(symbol, 1.12 * tip[1] - 0.1 * aside[1], 1.12 * tip[2] - 0.1 * aside[2])
    d$key(quantity(
      symbol, "rotor", value_text(one$omega_rad_per_s, "rad/s"), "spring"
    ))
  }
}

# What turns a vector of space into the two components of the picture.
view_of_space <- function() {
  beside <- pi / 6
  above <- 25 * pi / 180
  rbind(
    c(-sin(beside), cos(beside), 0),
    c(-cos(beside) * sin(above), -sin(beside) * sin(above), cos(above))
  )
}
