#' Supports of a body at rest
#'
#' What holds a body: each support has unknown forces, and couples where it prevents a rotation.
#' [static_equilibrium()] finds them.
#'
#' | support | in a plane | in space | prevents |
#' |---|---|---|---|
#' | `support_pin()` | 2 forces | 3 forces | motion of the point: a pin, a ball joint |
#' | `support_roller()` | 1 | 1 | motion along the normal, both ways |
#' | `support_surface()` | 1, with friction 2 | 1, with friction 3 | motion into the surface |
#' | `support_fixed()` | 2 and a couple | 3 and 3 couples | every motion |
#' | `support_hinge()` | - | 3 and 2 couples | all but rotation about its axis |
#' | `support_cable()` | 1, a pull | 1, a pull | motion away from the anchor |
#' | `support_rod()` | 1 | 1 | motion along the rod: hinged at both ends, push or pull |
#'
#' A surface pushes along its normal, and has friction of at most `friction` times the push;
#' it lifts off rather than pull. A rod's and a cable's own weight is ignored.
#'
#' @param at_m The point of the body that is supported: two numbers in a plane, three in space.
#' @param normal Direction of the push on the body, of any length. By default up, for supports at
#'   the ground: as low as the lowest point of supports, forces and outline, but for a thousandth of
#'   their extent. Elsewhere [static_equilibrium()] asks for it: a wall is no floor.
#' @param friction Coefficient of static friction, at least 0; Inf: a surface that never slides.
#' @param to_m The other end of a cable or rod.
#' @param axis Direction of the hinge's axis: `"x"`, `"y"`, `"z"` or three numbers.
#' @param slides Whether the hinge lets the body slide along its axis.
#' @param ... Not used: an unknown argument is an error.
#' @param name Name of the support.
#' @return A `rot_support`.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size`, `rotdyn_error_value` for a direction
#'   without length, `rotdyn_error_unit`, `rotdyn_error_missing`, `rotdyn_error_argument`.
#' @source Hibbeler, Engineering Mechanics: Statics, 14th ed. (2016), chapter 5.
#' @seealso [static_equilibrium()], [forces()].
#' @concept reaction
#' @concept hinge
#' @concept ladder
#' @concept cable
#' @concept support
#' @examples
#' support_pin(c(0, 0))
#' support_surface(c(4, 0), friction = 0.4, name = "floor")
#' support_surface(c(2, 4), normal = c(-1, 0), name = "wall")
#' support_cable(c(3, 0), to_m = c(0, 2))
#' support_rod(c(3, 0), to_m = c(0, -2))
#' support_fixed(c(0, 0))
#' support_hinge(c(0, 0, 2), axis = "z", slides = TRUE, name = "upper hinge") # of a door
#' @name supports
NULL

#' @rdname supports
#' @export
support_pin <- function(at_m, ..., name = "pin") {
  call <- check_no_dots(...)
  new_support("pin", at_m, name, call)
}

#' @rdname supports
#' @export
support_roller <- function(at_m, normal = NULL, ..., name = "roller") {
  call <- check_no_dots(...)
  new_support("roller", at_m, name, call, normal = normal)
}

#' @rdname supports
#' @export
support_surface <- function(at_m, normal = NULL, friction = 0, ..., name = "surface") {
  call <- check_no_dots(...)
  if (!identical(friction, Inf)) {
    friction <- check_number(friction, "friction", "1", call, lower = 0)
  }
  new_support("surface", at_m, name, call, normal = normal, friction = friction)
}

#' @rdname supports
#' @export
support_fixed <- function(at_m, ..., name = "fixed end") {
  call <- check_no_dots(...)
  new_support("fixed", at_m, name, call)
}

#' @rdname supports
#' @export
support_hinge <- function(at_m, axis, slides = FALSE, ..., name = "hinge") {
  call <- check_no_dots(...)
  check_supplied(c("at_m", "axis"), call)
  if (!isTRUE(slides) && !isFALSE(slides)) {
    abort_rotdyn(c(
      "{.arg slides} must be {.code TRUE} or {.code FALSE}.", x = "It is {describe_value(slides)}."
    ), "type", call)
  }
  out <- new_support("hinge", at_m, name, call, normal = as_axis(axis, call), arg = "axis")
  if (length(out$at_m) == 2L) {
    abort_rotdyn(c(
      "A hinge has an axis in space: {.arg at_m} must have three numbers.",
      i = "In a plane {.fn support_pin} is a hinge."
    ), "size", call)
  }
  out$slides <- slides
  out
}

#' @rdname supports
#' @export
support_cable <- function(at_m, to_m, ..., name = "cable") {
  call <- check_no_dots(...)
  check_supplied(c("at_m", "to_m"), call)
  new_support("cable", at_m, name, call, to_m = to_m)
}

#' @rdname supports
#' @export
support_rod <- function(at_m, to_m, ..., name = "rod") {
  call <- check_no_dots(...)
  check_supplied(c("at_m", "to_m"), call)
  new_support("rod", at_m, name, call, to_m = to_m)
}

#' @export
print.rot_support <- function(x, ...) {
  call <- current_env()
  check_form(x, support_form, "x", "support", call)
  if (!support_is_whole(x)) abort_form("kind", "x", "support", call)
  point <- function(p) paste0("(", paste(format_si(p), collapse = ", "), ") m")
  say(
    "<support> ", if (x$name != x$kind) c(x$name, ": "), x$kind, " at ", point(x$at_m),
    if (length(x$to_m)) c(" to ", point(x$to_m)),
    if (length(x$normal)) {
      c(if (x$kind == "hinge") ", axis (" else ", normal (", toString(format_si(x$normal)), ")")
    },
    if (x$kind == "surface") c(", friction ", format_si(x$friction)),
    if (x$assumed) " (up by default, at the ground alone)"
  )
  invisible(x)
}

new_support <- function(kind, at_m, name, call, normal = NULL, to_m = NULL, friction = 0,
                        arg = "normal") {
  check_supplied("at_m", call)
  name <- check_name(name, "name", call)
  at_m <- check_point(at_m, "at_m", "m", call)
  directed <- kind %in% c("roller", "surface", "hinge")
  assumed <- directed && is.null(normal)
  if (directed) {
    normal <- check_point(normal %||% -down_of(at_m), arg, "1", call)
    points <- stats::setNames(list(at_m, normal), c("at_m", arg))
    check_dimensions(points, call)
    if (all(normal == 0)) {
      abort_rotdyn("{.arg {arg}} must have a length: it is 0.", "value", call)
    }
  }
  if (!is.null(to_m)) {
    to_m <- check_point(to_m, "to_m", "m", call)
    check_dimensions(list(at_m = at_m, to_m = to_m), call)
    if (all(at_m == to_m)) {
      abort_rotdyn(c(
        "{.arg to_m} must differ from {.arg at_m}.",
        x = "Both are {.val {at_m}}: the {kind} has no direction."
      ), "value", call)
    }
  }
  structure(
    list(
      kind = kind, name = name, at_m = at_m, normal = as.double(normal), to_m = as.double(to_m),
      friction = friction, slides = FALSE, assumed = assumed
    ),
    class = "rot_support"
  )
}

# A list of supports that are whole, all of the dimension of the loads.
check_supports <- function(supports, plane, call) {
  if (inherits(supports, "rot_support")) supports <- list(supports)
  if (!is.list(supports) || is.object(supports)) {
    abort_rotdyn(c(
      "{.arg supports} must be a list of supports.",
      x = "It is {describe_value(supports)}.",
      i = "{.code list(support_pin(c(0, 0)), support_roller(c(4, 0)))}"
    ), "type", call)
  }
  named <- rlang::names2(supports)
  for (i in seq_along(supports)) {
    support <- supports[[i]]
    check_class(support, "rot_support", "supports", "See the help page of supports.", call)
    check_form(support, support_form, "supports", "list of supports", call)
    if (!support_is_whole(support)) abort_form("kind", "supports", "list of supports", call)
    if ((length(support$at_m) == 2L) != plane) {
      abort_rotdyn(c(
        "Loads and supports must all be in a plane, or all in space.",
        x = "The loads are in {if (plane) 'a plane' else 'space'}, {.val {support$name}} is not.",
        i = "Give every point and vector {if (plane) 'two' else 'three'} numbers."
      ), "size", call)
    }
    if (nzchar(named[i])) supports[[i]]$name <- named[i]
  }
  unname(supports)
}

# Up is the default direction of a push from the ground alone: at the lowest point of the body.
check_default_normals <- function(supports, loads, outline, call) {
  assumed <- vapply(supports, `[[`, NA, "assumed")
  if (!any(assumed)) return(invisible())
  system <- system_of(loads)
  pulls <- colSums(system$force != 0) > 0
  up <- 3L - is_plane(loads)
  points <- rbind(
    t(vapply(supports, function(one) c(one$at_m, 0)[1:3], double(3))),
    t(system$at[, pulls, drop = FALSE]), if (length(outline)) cbind(outline, 0)[, 1:3]
  )
  points <- points[stats::complete.cases(points), , drop = FALSE]
  extent <- max(apply(points, 2L, function(x) max(x / 2) - min(x / 2)))
  lowest <- min(points[, up])
  heights <- vapply(supports, function(one) one$at_m[up], 0)
  high <- which(assumed & heights / 2 - lowest / 2 > 1e-3 * extent)
  if (!length(high)) return(invisible())
  one <- supports[[high[1]]]
  axis <- c("x", "y", "z")[up]
  wall <- if (up == 2L) "c(-1, 0)" else "c(-1, 0, 0)"
  floor <- if (up == 2L) "c(0, 1)" else "c(0, 0, 1)"
  abort_rotdyn(c(
    "The direction in which the {one$kind} {.val {one$name}} pushes is unknown.",
    x = "It is at {axis} = {format_si(heights[high[1]])} m, the lowest point at
         {format_si(lowest)} m: up is the default at the ground alone.",
    i = "Give {.arg normal}: {.code {wall}} for a wall to the right, {.code {floor}} for a step."
  ), "value", call)
}

# What check_form() cannot say of a support that was edited.
support_is_whole <- function(support) {
  size <- length(support$at_m)
  needs <- switch(support$kind,
    pin = , fixed = c(0L, 0L), roller = , surface = c(size, 0L),
    hinge = if (size == 3L) c(size, 0L) else NULL, cable = , rod = c(0L, size), NULL
  )
  if (!size %in% 2:3 || !length(needs)) return(FALSE)
  directed <- needs[1] == 0L || !all(support$normal == 0)
  anchored <- needs[2] == 0L || !all(support$to_m == support$at_m)
  identical(lengths(list(support$normal, support$to_m)), needs) && directed && anchored &&
    !is.na(support$friction) && support$friction >= 0
}

# The unknown reactions of one support: columns `component`, `unit`, and their directions.
# `friction` is NA where the contact has none.
reactions_of <- function(support) {
  at <- c(support$at_m, 0)[1:3]
  plane <- length(support$at_m) == 2L
  axes <- if (plane) diag(3)[, 1:2] else diag(3)
  forces <- c("fx_n", "fy_n", "fz_n")[seq_len(ncol(axes))]
  turns <- if (plane) diag(3)[, 3, drop = FALSE] else diag(3)
  couples <- couple_columns(plane)
  one <- function(component, from, to, couple = FALSE, one_sided = FALSE) {
    list(component = component, from = from, to = to, couple = couple, one_sided = one_sided)
  }
  along <- function(components, directions, couple = FALSE) {
    lapply(seq_along(components), function(j) {
      one(components[j], c(0, 0, 0), directions[, j], couple)
    })
  }
  normal <- c(support$normal, 0)[1:3]
  parts <- switch(support$kind,
    pin = along(forces, axes),
    fixed = c(along(forces, axes), along(couples, turns, TRUE)),
    roller = list(one("normal_n", c(0, 0, 0), normal)),
    surface = if (support$friction > 0) along(forces, axes) else
      list(one("normal_n", c(0, 0, 0), normal, one_sided = TRUE)),
    cable = list(one("tension_n", at, c(support$to_m, 0)[1:3], one_sided = TRUE)),
    rod = list(one("tension_n", at, c(support$to_m, 0)[1:3])),
    hinge = {
      across <- across_hinge(normal)
      c(
        if (support$slides) along(across$forces, across$directions) else along(forces, axes),
        along(across$couples, across$directions, TRUE)
      )
    }
  )
  lapply(parts, function(part) c(part, list(at = at)))
}

# Two directions across an axis: coordinate axes where the axis is one of them.
across_hinge <- function(axis) {
  axis <- axis / length_of(axis)
  main <- which(abs(axis) == 1)
  if (length(main)) {
    across <- setdiff(1:3, main)
    return(list(
      directions = diag(3)[, across], forces = c("fx_n", "fy_n", "fz_n")[across],
      couples = couple_columns(FALSE)[across]
    ))
  }
  list(
    directions = across_axle(axis, 0), forces = c("across_1_n", "across_2_n"),
    couples = c("across_1_n_m", "across_2_n_m")
  )
}
