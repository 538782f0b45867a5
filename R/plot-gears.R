#' Draw a gear train
#'
#' The wheels of each stage with the ratio of their radii, all stages with one distance of shafts:
#' wheels that mesh where neighbours turn opposite ways, pulleys with a belt where they turn alike.
#' Arrows of rotation are for a first shaft that turns in the positive sense. A [scene_gears()] is
#' drawn likewise.
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

# `scene`: that of the train, for the start of its first shaft.
draw_train <- function(train, scene = NULL) {
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
    for (k in wheels) d$add(mark("fill", draw_circle(i - 2 + k, 0, radius[k]), "body"))
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
  turns <- sign(total) * if (is.null(scene) || scene$omega0_rad_per_s >= 0) 1 else -1
  for (i in seq_len(n)) {
    x <- i - 1
    d$add(mark("fill", draw_circle(x, 0, 0.05), "shaft"))
    d$add(turn_arrow(x, 0, max(min(0.62 * reach[i], 0.4), 0.24), 30, 100, turns[i], "speed"))
    if (few) d$say(paste0("I[", i, "]"), x, -max(reach) - 0.2)
    if (isTRUE(torque[i] != 0)) {
      d$add(turn_arrow(x, 0, max(reach) + 0.12, 65, 50, torque[i], "torque"))
      if (few) d$say(paste0("tau[", i, "]"), x, max(reach) + 0.34)
    }
  }
  d$key(quantity("I[i]", "moment of inertia", value_text(train$moment_of_inertia_kg_m2, "kg m^2")))
  if (n > 1L) d$key(quantity("omega[i]", "ratio to the first", value_text(total, ""), "speed"))
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
