#' Draw a gear train
#'
#' The wheels of each stage with the ratio of their radii, all stages with one distance of shafts:
#' toothed wheels that mesh where neighbours turn opposite ways, pulleys with a belt where they turn
#' alike. Speeds are fractions of the first shaft's, negative where it turns the other way. Arrows
#' of rotation are for a first shaft that turns in the positive sense. A [scene_gears()] is drawn
#' likewise.
#'
#' @param object From [gear_train()].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [gear_train()], [autoplot.rot_scene()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(gear_train(c(0.01, 0.5, 2), ratios = c(5, -3), torque = c(2, 0, -4)))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept gear
#' @concept drawing of gears
autoplot.rot_gear_train <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  for (column in c("ratio_to_first", "moment_of_inertia_kg_m2")) {
    if (is.null(object[[column]])) abort_missing_column(column, object, call)
  }
  draw(draw_train(object), paste("A gear train of", nrow(object), "shafts"), base_size)
}

# The teeth of two wheels with radii that add up to 1: numbers in the ratio of the radii, as nearly
# as 9 to 16 teeth of the smaller one allow.
mesh_teeth <- function(ratio) {
  few <- 9:16
  large <- few * max(ratio, 1 / ratio)
  best <- which.min(round(abs(large - round(large)), 9))
  z <- pmin(c(few[best], round(large[best])), 240)
  if (ratio >= 1) z else rev(z)
}

# The outline of a wheel with z teeth about its pitch circle; one of them is at `angle`.
gear_outline <- function(x, y, radius, z, angle) {
  pitch <- 2 * pi / z
  deep <- 0.22 * pitch * radius
  each <- c(-0.25, -0.11, 0.11, 0.25) * pitch
  at <- angle + rep(pitch * (seq_len(z) - 1), each = 4L) + each
  r <- radius + deep * c(-1.1, 1, 1, -1.1)
  cbind(x + r * cos(at), y + r * sin(at))
}

# "1", "1/5", "-1/15": 1 over a ratio.
fraction_text <- function(ratio) {
  if (abs(ratio) == 1 || abs(ratio - round(ratio)) > 1e-9 * abs(ratio)) {
    return(format_si(signif(1 / ratio, 3)))
  }
  paste0(if (ratio < 0) "-", "1/", format_si(abs(round(ratio))))
}

# `scene`: that of the train, for the start of its first shaft. `theta`: in motion, its angle.
draw_train <- function(train, scene = NULL, theta = NULL) {
  n <- nrow(train)
  total <- train$ratio_to_first
  ratio <- total[-1] / total[-n]
  d <- new_drawing()
  torque <- attr(train, "torque_n_m") %||% train$reflected_torque_n_m
  reach <- double(n)
  few <- n <= 6L
  for (i in seq_len(n - 1L)) {
    meshes <- ratio[i] < 0
    # Pulleys stand apart.
    radius <- c(1, abs(ratio[i])) / (1 + abs(ratio[i])) * if (meshes) 1 else 0.8
    wheels <- order(-radius)
    teeth <- if (meshes) mesh_teeth(abs(ratio[i]))
    for (k in wheels) {
      x <- i - 2 + k
      # A tooth of the first meets a gap of the second.
      angle <- (theta %||% 0) / total[i + k - 1L] + if (k == 2L) pi + pi / teeth[2] else 0
      d$add(mark("fill", if (meshes) {
        gear_outline(x, 0, radius[k], teeth[k], angle)
      } else {
        draw_circle(x, 0, radius[k])
      }, "body"))
    }
    if (!meshes) {
      # Both straight parts of the belt touch both pulleys.
      lean <- asin(max(min(radius[1] - radius[2], 1), -1))
      for (side in c(-1, 1)) {
        touch <- c(sin(lean), side * cos(lean))
        d$add(mark("line", rbind(
          c(i - 1, 0) + radius[1] * touch, c(i, 0) + radius[2] * touch
        ), "spring"))
      }
    }
    reach[i + 0:1] <- pmax(reach[i + 0:1], radius)
  }
  if (n == 1L) {
    reach <- 0.6
    d$add(mark("fill", draw_circle(0, 0, 0.6), "body"))
  }
  if (!is.null(theta)) {
    for (i in seq_len(n)) d$add(spoke(i - 1, 0, 0.85 * reach[i], theta / total[i]))
  }
  turns <- sign(total) * if (is.null(scene) || scene$omega0_rad_per_s >= 0) 1 else -1
  for (i in seq_len(n)) {
    x <- i - 1
    d$add(mark("fill", draw_circle(x, 0, 0.05), "shaft"))
    d$add(turn_arrow(x, 0, max(min(0.62 * reach[i], 0.4), 0.24), 30, 100, turns[i], "speed"))
    if (few) {
      d$say(paste0("I[", i, "]"), x, -max(reach) - 0.2)
      if (n > 1L) {
        # Beside a small wheel, outside of its belt or mesh.
        small <- reach[i] < 0.35
        d$say(
          paste0("omega[", i, "]"), x,
          if (small) -reach[i] - 0.34 else -0.6 * min(reach[i], 0.7)
        )
      }
    }
    if (isTRUE(torque[i] != 0)) {
      d$add(turn_arrow(x, 0, max(reach) + 0.12, 65, 50, torque[i], "torque"))
      if (few) d$say(paste0("tau[", i, "]"), x, max(reach) + 0.34)
    }
  }
  d$key(quantity("I[i]", "moment of inertia", value_text(train$moment_of_inertia_kg_m2, "kg m^2")))
  if (n > 1L) {
    speeds <- paste(vapply(utils::head(total, 8L), fraction_text, ""), collapse = ", ")
    if (n > 8L) speeds <- paste0(speeds, ", ...")
    d$key(quantity("omega[i]", "speed over first speed", speeds, "speed"))
  }
  efficiency <- attr(train, "efficiency")
  if (any(efficiency < 1)) {
    d$key(quantity("", "efficiency of a mesh", value_text(efficiency, ""), "resistance"))
  }
  if (any(torque != 0)) d$key(quantity("tau[i]", "torque", value_text(torque, "N m"), "torque"))
  if (!is.null(scene)) {
    if (scene$omega0_rad_per_s != 0) {
      d$key(quantity(
        "omega[1]", "rate at start", value_text(scene$omega0_rad_per_s, "rad/s"), "speed"
      ))
    }
    c_first <- sum(train$reflected_viscous_n_m_s)
    if (c_first != 0) {
      d$key(quantity("", "viscous, at the first", value_text(c_first, "N m s"), "resistance"))
    }
  }
  top <- max(reach)
  out <- d$done(
    c(
      -max(reach[1], 0.24) - 0.25, n - 1 + reach[n] + 0.25, -top - 0.4,
      top + if (any(torque != 0)) 0.55 else 0.15
    ),
    "radii of each stage to scale"
  )
  out$reach <- reach
  if (!is.null(scene)) out$title <- paste("A gear train of", n, "shafts")
  out
}
