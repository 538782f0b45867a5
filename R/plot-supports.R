# A support alone, with the forces that it may give.

#' Draw a support
#'
#' The support with a piece of the body that it holds, and its unknown forces and couples. Arrows in
#' both senses may push or pull; a surface only pushes, a cable only pulls. In space the drawing is
#' oblique, with x to the right, z up and y into the page.
#'
#' @param object One of the [supports].
#' @inheritParams autoplot.rot_trajectory
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`.
#' @seealso [supports], [autoplot.rot_equilibrium()].
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(support_surface(c(4, 0), normal = c(-1, 2), friction = 0.4, name = "floor"))
#' @exportS3Method ggplot2::autoplot
#' @concept plot
#' @concept reaction
autoplot.rot_support <- function(object, ..., base_size = 13) {
  call <- check_plot(base_size, ...)
  check_form(object, support_form, "object", "support", call)
  kind <- c(
    pin = "a pin", roller = "a roller", surface = "a surface", fixed = "a fixed end",
    hinge = "a hinge", cable = "a cable", rod = "a rod"
  )[[object$kind]]
  name <- if (object$name %in% c(object$kind, "fixed end")) "A support" else sentence(object$name)
  draw(draw_support(object), paste0(name, ": ", kind), base_size)
}

# The directions of the unknown forces, columns, with letters; `one_sided`: of a push or a pull.
support_unknowns <- function(one, plane) {
  n <- if (plane) 2L else 3L
  every <- diag(3)[, if (plane) 1:2 else 1:3]
  letters <- paste0("R[", c("x", "y", "z")[seq_len(n)], "]")
  unit <- function(v) c(v, 0)[1:3] / length_of(v)
  along <- function(v, letter, one_sided) {
    list(force = cbind(unit(v)), symbol = letter, one_sided = one_sided)
  }
  switch(one$kind,
    roller = along(one$normal, "R[n]", FALSE),
    cable = along(one$to_m - one$at_m, "R", TRUE),
    rod = along(one$to_m - one$at_m, "R", FALSE),
    surface = {
      normal <- unit(one$normal)
      across <- if (plane) cbind(c(-normal[2], normal[1], 0)) else
        qr.Q(qr(cbind(normal, diag(3))))[, 2:3]
      rough <- one$friction > 0
      list(
        force = cbind(normal, if (rough) across),
        symbol = c("R[n]", if (rough) paste0("F[", seq_len(ncol(across)), "]")),
        one_sided = c(TRUE, rep(FALSE, if (rough) ncol(across) else 0L))
      )
    },
    hinge = {
      # Along the axis only where it does not slide.
      kept <- if (!one$slides) rep(TRUE, 3) else abs(unit(one$normal)) < 1 - 1e-9
      list(force = every[, kept, drop = FALSE], symbol = letters[kept], one_sided = rep(FALSE, n))
    },
    list(force = every, symbol = letters, one_sided = rep(FALSE, n))
  )
}

draw_support <- function(object) {
  plane <- length(object$at_m) == 2L
  d <- new_drawing()
  place <- function(points) flatten_points(points, plane)
  there <- if (length(object$to_m)) {
    (object$to_m - object$at_m) / length_of(object$to_m - object$at_m)
  }
  drawn <- object
  drawn$at_m <- 0 * object$at_m
  drawn$to_m <- 0.75 * there
  unknown <- support_unknowns(object, plane)
  # A piece of the body: across the normal, or to the right.
  across <- c(1, 0)
  if (object$kind %in% c("roller", "surface")) {
    normal <- as.double(flatten_points(rbind(c(object$normal, 0)[1:3]), plane))
    if (length_of(normal) > 0) across <- c(normal[2], -normal[1]) / length_of(normal)
  }
  from <- if (object$kind == "fixed") 0 else -0.4
  for (one in thick_line(rbind(from * across, 0.6 * across), 0.04)) d$add(one)
  for (one in support_marks(drawn, place, plane)) d$add(one)
  if (object$kind == "hinge") {
    axis <- as.double(place(rbind(object$normal / length_of(object$normal))))
    d$add(mark("line", rbind(-0.75 * axis, 0.75 * axis), "dashed"))
  }
  names <- c(n = "along the normal", x = "along x", y = "along y", z = "along z")
  for (k in seq_along(unknown$symbol)) {
    direction <- as.double(place(rbind(unknown$force[, k])))
    direction <- direction / max(length_of(direction), 0.4)
    symbol <- unknown$symbol[k]
    style <- if (startsWith(symbol, "F")) "resistance" else "torque"
    # A push ends at the body, a pull leaves it.
    if (object$kind == "surface" && k == 1L) {
      d$add(mark("arrow", rbind(-0.6 * direction, c(0, 0)), style))
      at <- -0.6 * direction
    } else {
      d$add(mark("arrow", rbind(c(0, 0), 0.55 * direction), style))
      if (!unknown$one_sided[k]) {
        d$add(mark("arrow", rbind(c(0, 0), -0.38 * direction), style))
      }
      at <- 0.55 * direction
    }
    aside <- c(-direction[2], direction[1])
    d$say(symbol, at[1] * 1.08 + 0.1 * aside[1], at[2] * 1.08 + 0.1 * aside[2])
    words <- names[gsub("^.*\\[|\\]", "", symbol)]
    d$key(quantity(
      symbol, if (style == "resistance") "friction, either sense" else
        if (object$kind == "surface") "push" else if (object$kind == "cable") "pull" else
          paste("force", if (is.na(words)) "along the rod" else words), "", style
    ))
  }
  couples <- if (object$kind == "fixed") (if (plane) 1L else 3L) else
    if (object$kind == "hinge") 2L else 0L
  if (couples) {
    d$add(turn_arrow(0, 0, 0.24, 30, 240, 1, "spring"))
    d$say("C", -0.25, 0.25)
    d$key(quantity(
      "C", if (couples == 1L) "couple, either sense" else paste(couples, "couples"), "", "spring"
    ))
  }
  if (object$kind == "surface") {
    d$key(quantity("", "static friction", format_si(object$friction), "resistance"))
  }
  at <- paste0("(", paste(format_si(object$at_m), collapse = ", "), ") m")
  d$key(quantity("", "at", at))
  d$done(c(-0.85, 0.85, -0.85, 0.85), if (plane) "Arrows: unknown, not to scale." else
    "Oblique: x to the right, z up, y into the page. Arrows: unknown, not to scale.")
}
