# The constructors of the standard shapes. Sizes, limits and moments come from the C core, formulas
# and sources from shapes.R.

# The names used in the article.
shape_aliases <- c(
  solid_disk = "disk",
  solid_cylinder = "disk",
  solid_sphere = "sphere",
  thin_spherical_shell = "spherical_shell",
  ring = "hoop",
  rod_center = "rod",
  point_mass = "point",
  point_mass_sliding = "sliding_point"
)

# The value of a missing argument without a default in its frame.
left_out <- formals(function(x) NULL)

many_bodies <- "{.fn inertia_table} takes many bodies: a data frame with a row for each."

# A body of a shape, from the arguments of its constructor, whose frame is `call`. Called often:
# only the usual case is handled here; densities and messages are elsewhere.
new_shape_body <- function(shape, call) {
  of <- shape_cache[[shape]]
  if (is.null(of)) of <- shape_parts(shape)
  density <- .subset2(of, "density")
  amount <- if ((is.null(density) || is.null(call[[density]])) && !is.symbol(call[["mass_kg"]])) {
    check_number(call[["mass_kg"]], "mass_kg", "kg", call, 0, remedy = many_bodies)
  } else {
    mass_or_density(density, .subset2(of, "density_unit"), call)
  }
  names <- .subset2(of, "names")
  units <- .subset2(of, "units")
  size <- .subset2(of, "lower")
  for (i in seq_along(names)) {
    name <- names[i]
    if (is.symbol(call[[name]])) check_supplied(name, call)
    size[i] <- check_number(call[[name]], name, units[i], call, size[i], remedy = many_bodies)
  }
  parts <- .Call(ffi_shapes_body, .subset2(of, "id"), amount, !is.null(names(amount)), size)
  if (!is.list(parts)) abort_shape(parts, names, size, NULL, call)
  attr(size, "names") <- names
  finish_body(shape, parts, size, of, amount, call)
}

# A body of the C core's results: mass, second moments, centre, reach, beta, error. `of` has its
# formula and source. A density is stored in `detail`.
finish_body <- function(shape, parts, size, of, amount, call) {
  mass <- .subset2(parts, 1L)
  second <- .subset2(parts, 2L)
  if (!is.finite(mass) || !is.finite(sum(second))) {
    abort_rotdyn(c(
      "The mass or the moments of this body exceed double precision.",
      x = "Its mass is {format_si(mass)} kg."
    ), "range", call)
  }
  detail <- if (is.null(names(amount))) list() else as.list(amount)
  centre <- .subset2(parts, 3L)
  # At most eight roundings.
  if (any(centre != 0)) detail$centre_error_m <- 4 * .Machine$double.eps * max(abs(centre))
  new_body(
    shape, mass, second, centre, size, .subset2(parts, 4L), .subset2(parts, 5L),
    .subset2(of, "formula"), .subset2(of, "source"),
    detail = detail, error = .subset2(parts, 6L), call = call
  )
}

# `mass_kg` or the density, of which one must be given; a density is returned with its name.
mass_or_density <- function(density, unit, call) {
  no_mass <- identical(call[["mass_kg"]], left_out[[1L]])
  given <- if (!is.null(density)) call[[density]]
  if (is.null(given)) {
    if (no_mass) abort_mass_left_out(density, call)
    return(check_number(call[["mass_kg"]], "mass_kg", "kg", call, 0))
  }
  if (!no_mass) {
    abort_rotdyn(c(
      "Give {.arg mass_kg} or {.arg {density}}, not both.",
      i = "With {.arg {density}}, the sizes must be named."
    ), "value", call)
  }
  stats::setNames(check_number(given, density, unit, call, 0), density)
}

abort_mass_left_out <- function(density, call) {
  abort_rotdyn(c(
    "{.arg mass_kg} is missing: it has no default.",
    i = if (!is.null(density)) "Give it, or {.arg {density}} instead of it."
  ), "missing", call)
}

# Properties of a shape, cached.
shape_parts <- function(shape) {
  parts <- shape_cache[[shape]]
  if (is.null(parts)) {
    table <- shape_table()
    i <- match(shape, table$shape)
    sizes <- size_table()
    kind <- sizes$kind[match(table$names[[i]], sizes$name)]
    dimension <- table$dimension[i]
    weighs <- nzchar(table$measure[i])
    parts <- list(
      id = i,
      names = table$names[[i]],
      units = ifelse(kind == "count", "1", "m"),
      lower = ifelse(kind == "length", 0, -Inf),
      density = if (weighs) density_names[dimension + 1L],
      density_unit = density_units[dimension + 1L],
      formula = paste0(table$formula[i], "  (", table$axis[i], ")"),
      source = table$source[i]
    )
    shape_cache[[shape]] <- parts
  }
  parts
}

# beta of a shape whose beta does not depend on its size.
shape_beta <- function(shape) {
  vapply(shape, function(s) {
    .Call(ffi_shapes_body, shape_parts(s)$id, 1, FALSE, 1)[[5L]]
  }, double(1), USE.NAMES = FALSE)
}

# c(fault, row, slot) from the C core, in the order of rot_shape_fault. `size`: the row's sizes.
abort_shape <- function(fault, names, size, row, call) {
  slot <- fault[3]
  where <- if (is.null(row)) "" else paste0(" in row ", format(row, big.mark = ","))
  name <- names[slot]
  of <- names[1]
  value <- format_si(size[slot])
  limit <- format_si(size[1])
  switch(fault[1],
    abort_domain(size[slot], name, "m", call, 0, Inf, FALSE, row = row),
    abort_rotdyn(
      c("{.arg {name}} must be a whole number of at least 3.", x = "It is {value}{where}."),
      "value", call
    ),
    abort_rotdyn(
      c(
        "{.arg {name}} must be at most {.arg {of}}.",
        x = "It is {value} m{where}, and {.arg {of}} is {limit} m.",
        i = if (name == "tube_radius_m") {
          "A wider tube would intersect itself."
        } else {
          "Equal ones make a thin shell."
        }
      ), "value", call
    ),
    abort_rotdyn(c(
      "{.arg {name}} must be at most twice {.arg {of}}.",
      x = "It is {value} m{where}, and {.arg {of}} is {limit} m.",
      i = "{.arg {of}} is that of the sphere, not of the cap's rim."
    ), "value", call)
  )
}

#' Bodies of standard shapes: points, rods and hoops
#'
#' A body has a mass, a centre of mass, second moments about that centre in the body's own axes, and
#' a size. Its `z` axis is the symmetry axis, or the usual axis of rotation; a rod lies along `x`.
#' [shapes()] lists all shapes; those of more dimensions are in [body_plates], [body_shells],
#' [body_round_solids] and [body_flat_faced_solids].
#'
#' `r describe_shapes("lines")`
#' `r formula_note`
#'
#' `beta` is `Izz/(m r^2)`, which determines the acceleration of a rolling body: [rolling_table()].
#'
#' @param mass_kg Mass, one number, at least 0 kg. Omitted if a density is given.
#' @param radius_m Radius, one number, at least 0 m; of a point, its distance from the axis.
#' @param length_m Length of the rod, one number, at least 0 m.
#' @param ... Not used; names after it must be given in full.
#' @param linear_density_kg_m Mass per length, instead of `mass_kg`.
#' @return A `rot_body`: a list with `shape`, `mass_kg`, `size_m` (the sizes as given), `centre_m`
#'   (in the own axes), `second_moment_kg_m2` and `inertia_kg_m2` (3 x 3, about the centre of mass;
#'   off-diagonal elements of the latter are minus the products of inertia), `point`, `axes`,
#'   `reach_m` (from the centre of mass to the farthest point), `beta`, `formula`, `source`,
#'   `provenance`, `detail`, `error` and `error_kind`.
#'
#'   `error` is a bound of the rounding error of the second moments, relative to their sum: at most
#'   4e-15, for most shapes 6e-16, for sizes in ratios of up to 1e150.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size` and `rotdyn_error_value` unless each
#'   argument is one finite number of at least 0, for inconsistent sizes, and for a mass with a
#'   density; `rotdyn_error_missing`; `rotdyn_error_range` for moments that exceed double precision;
#'   `rotdyn_error_unit` for a units object of another dimension.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), chapter 5; Beer and
#'   Johnston, Vector Mechanics for Engineers, inside cover; Meriam and Kraige, Engineering
#'   Mechanics: Dynamics, tables D/3 and D/4. [shapes()] has the source of each formula.
#' @seealso [scene_axle()] puts a body on an axle; [inertia_table()] compares shapes.
#' @concept moment of inertia
#' @concept ring
#' @concept hoop
#' @concept rod
#' @concept ball
#' @concept cylinder
#' @concept sphere
#' @concept bowling ball
#' @concept beam
#' @examples
#' body_hoop(mass_kg = 2, radius_m = 0.25)
#' body_rod(mass_kg = 1.5, length_m = 2)$inertia_kg_m2
#' body_rod(length_m = 2, linear_density_kg_m = 0.75)
#' body_half_hoop(mass_kg = 2, radius_m = 0.25)$centre_m # an arch: 2 r/pi above its ends
#' @name body_shapes
NULL

#' @rdname body_shapes
#' @export
body_point <- function(mass_kg, radius_m = 0, ...) {
  new_shape_body("point", check_no_dots(...))
}

#' @rdname body_shapes
#' @export
body_rod <- function(mass_kg, length_m, ..., linear_density_kg_m = NULL) {
  new_shape_body("rod", check_no_dots(...))
}

#' @rdname body_shapes
#' @export
body_rod_end <- function(mass_kg, length_m, ..., linear_density_kg_m = NULL) {
  new_shape_body("rod_end", check_no_dots(...))
}

#' @rdname body_shapes
#' @export
body_hoop <- function(mass_kg, radius_m, ..., linear_density_kg_m = NULL) {
  new_shape_body("hoop", check_no_dots(...))
}

#' @rdname body_shapes
#' @export
body_half_hoop <- function(mass_kg, radius_m, ..., linear_density_kg_m = NULL) {
  new_shape_body("half_hoop", check_no_dots(...))
}

#' Bodies of standard shapes: plates
#'
#' Thin plates in the plane of x and y, of uniform density. For a plate given by its vertices see
#' [body_polygon()]. The own axes are principal axes, except for the triangle:
#' Ixy = -m h (2 p - b) / 36.
#'
#' `r describe_shapes("plates")`
#' `r formula_note`
#'
#' @param radius_m Radius, at least 0 m; of a regular polygon, of the circle through its corners.
#' @param outer_radius_m,inner_radius_m Radii of the rim and of the hole, `inner_radius_m` at most
#'   `outer_radius_m`. Equal ones make a hoop.
#' @param semi_x_m,semi_y_m Half axes.
#' @param length_m,width_m Sides along x and y.
#' @param base_m,height_m,apex_m A triangle has the corners (0, 0), (`base_m`, 0) and (`apex_m`,
#'   `height_m`); `apex_m` may be any number and is half the base if left out.
#' @param sides Number of sides, a whole number of at least 3.
#' @param areal_density_kg_m2 Mass per area, instead of `mass_kg`.
#' @inheritParams body_shapes
#' @inherit body_shapes return source
#' @inheritSection body_shapes Errors
#' @seealso [shapes()], [body_shapes], [join_bodies()], [cut_body()].
#' @concept disc
#' @concept disk
#' @concept ring
#' @concept annulus
#' @concept wheel
#' @concept flywheel
#' @concept merry-go-round
#' @concept door
#' @concept moment of inertia
#' @examples
#' body_disk(mass_kg = 2, radius_m = 0.25)
#' body_annulus(outer_radius_m = 0.3, inner_radius_m = 0.1, areal_density_kg_m2 = 20)
#' body_triangle(mass_kg = 1, base_m = 3, height_m = 4, apex_m = 0) # right-angled
#' # A door of 0.9 m about its hinges, along its height, here y.
#' door <- body_rectangle(mass_kg = 25, length_m = 0.9, width_m = 2)
#' moment_of_inertia(door, axis = "y", through = c(-0.45, 0, 0))
#' body_half_disk(mass_kg = 1, radius_m = 0.3)$centre_m
#' body_elliptic_plate(mass_kg = 1, semi_x_m = 0.3, semi_y_m = 0.2)
#' body_polygon_plate(mass_kg = 1, radius_m = 0.3, sides = 5)
#' @name body_plates
NULL

#' @rdname body_plates
#' @export
body_disk <- function(mass_kg, radius_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("disk", check_no_dots(...))
}

#' @rdname body_plates
#' @export
body_annulus <- function(mass_kg, outer_radius_m, inner_radius_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("annulus", check_no_dots(...))
}

#' @rdname body_plates
#' @export
body_half_disk <- function(mass_kg, radius_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("half_disk", check_no_dots(...))
}

#' @rdname body_plates
#' @export
body_elliptic_plate <- function(mass_kg, semi_x_m, semi_y_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("elliptic_plate", check_no_dots(...))
}

#' @rdname body_plates
#' @export
body_rectangle <- function(mass_kg, length_m, width_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("rectangle", check_no_dots(...))
}

#' @rdname body_plates
#' @export
body_triangle <- function(mass_kg, base_m, height_m, ..., apex_m = base_m / 2,
                          areal_density_kg_m2 = NULL) {
  new_shape_body("triangle", check_no_dots(...))
}

#' @rdname body_plates
#' @export
body_polygon_plate <- function(mass_kg, radius_m, sides, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("polygon_plate", check_no_dots(...))
}

#' Bodies of standard shapes: shells
#'
#' Thin shells of uniform areal density, except the `ellipsoid_shell`: the region between two
#' similar ellipsoids, whose thickness varies.
#'
#' `r describe_shapes("shells")`
#' `r formula_note`
#'
#' @param radius_m Radius, at least 0 m; of a cap, of the whole sphere; of a cone, of the rim.
#' @param length_m Length along z, at least 0 m; of a box, the edge along x.
#' @param height_m Height along z, at least 0 m; of a cap at most `2 radius_m`.
#' @param base_radius_m,top_radius_m Radii at z = 0 and at z = `height_m`; either may be the larger.
#' @param ring_radius_m,tube_radius_m From the centre to the middle of the tube, and the radius of
#'   the tube, which is at most `ring_radius_m`.
#' @param semi_x_m,semi_y_m,semi_z_m Half axes.
#' @param width_m Edge along y.
#' @param areal_density_kg_m2 Mass per area, instead of `mass_kg`.
#' @inheritParams body_shapes
#' @inherit body_shapes return source
#' @inheritSection body_shapes Errors
#' @seealso [shapes()], [body_shapes], [join_bodies()], [cut_body()].
#' @concept hollow
#' @concept shell
#' @concept can
#' @concept tube
#' @concept moment of inertia
#' @examples
#' body_spherical_shell(mass_kg = 1, radius_m = 0.1)
#' body_can(radius_m = 0.033, length_m = 0.115, areal_density_kg_m2 = 0.6)
#' body_spherical_cap_shell(mass_kg = 1, radius_m = 2, height_m = 0.5)
#' body_tube(mass_kg = 1, radius_m = 0.1, length_m = 0.5)
#' body_hemispherical_shell(mass_kg = 0.3, radius_m = 0.1)$centre_m # a bowl
#' body_cone_shell(mass_kg = 0.1, radius_m = 0.1, height_m = 0.3)$centre_m
#' body_frustum_shell(mass_kg = 0.1, base_radius_m = 0.1, top_radius_m = 0.05, height_m = 0.3)
#' body_torus_shell(mass_kg = 0.2, ring_radius_m = 0.3, tube_radius_m = 0.02)
#' body_ellipsoid_shell(mass_kg = 0.4, semi_x_m = 0.14, semi_y_m = 0.085, semi_z_m = 0.085)
#' body_box_shell(mass_kg = 0.5, length_m = 0.3, width_m = 0.2, height_m = 0.1)
#' @name body_shells
NULL

#' @rdname body_shells
#' @export
body_tube <- function(mass_kg, radius_m, length_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("tube", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_can <- function(mass_kg, radius_m, length_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("can", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_spherical_shell <- function(mass_kg, radius_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("spherical_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_hemispherical_shell <- function(mass_kg, radius_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("hemispherical_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_spherical_cap_shell <- function(mass_kg, radius_m, height_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("spherical_cap_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_cone_shell <- function(mass_kg, radius_m, height_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("cone_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_frustum_shell <- function(mass_kg, base_radius_m, top_radius_m, height_m, ...,
                               areal_density_kg_m2 = NULL) {
  new_shape_body("frustum_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_torus_shell <- function(mass_kg, ring_radius_m, tube_radius_m, ...,
                             areal_density_kg_m2 = NULL) {
  new_shape_body("torus_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_ellipsoid_shell <- function(mass_kg, semi_x_m, semi_y_m, semi_z_m, ...) {
  new_shape_body("ellipsoid_shell", check_no_dots(...))
}

#' @rdname body_shells
#' @export
body_box_shell <- function(mass_kg, length_m, width_m, height_m, ..., areal_density_kg_m2 = NULL) {
  new_shape_body("box_shell", check_no_dots(...))
}

#' Bodies of standard shapes: round solids
#'
#' Solids with z as an axis of symmetry, or with elliptic sections perpendicular to it, of uniform
#' density.
#'
#' `r describe_shapes("round solids")`
#' `r formula_note`
#'
#' @param radius_m Radius, at least 0 m; of a cap, that of the whole sphere; of a cone and a
#'   paraboloid, that of the base.
#' @param length_m Length along z, at least 0 m; of a capsule, without its half spheres.
#' @param height_m Height along z, at least 0 m; of a cap at most `2 radius_m`.
#' @param outer_radius_m,inner_radius_m Radii outside and inside, `inner_radius_m` at most
#'   `outer_radius_m`; thin walls, also of thickness 0, lose no digits.
#' @param base_radius_m,top_radius_m Radii at z = 0 and at z = `height_m`; either may be the larger.
#' @param ring_radius_m,tube_radius_m From the centre to the middle of the tube, and the radius of
#'   the tube, which is at most `ring_radius_m`.
#' @param semi_x_m,semi_y_m,semi_z_m Half axes.
#' @param density_kg_m3 Mass per volume, instead of `mass_kg`.
#' @inheritParams body_shapes
#' @inherit body_shapes return source
#' @inheritSection body_shapes Errors
#' @seealso [shapes()], [body_shapes], [join_bodies()], [cut_body()].
#' @concept cylinder
#' @concept sphere
#' @concept flywheel
#' @concept disc
#' @examples
#' body_sphere(mass_kg = 1, radius_m = 0.1)
#' body_cylinder(radius_m = 0.05, length_m = 0.3, density_kg_m3 = 7850)
#' body_hollow_sphere(mass_kg = 1, outer_radius_m = 0.1, inner_radius_m = 0.0999)$beta
#' body_cone(mass_kg = 1, radius_m = 0.1, height_m = 0.4)$centre_m
#' # Where the centres of mass are, over the base: 3/8, 1/4, 1/3 of the height.
#' body_hemisphere(mass_kg = 1, radius_m = 0.1)$centre_m
#' body_paraboloid(mass_kg = 1, radius_m = 0.1, height_m = 0.4)$centre_m
#' body_frustum(mass_kg = 1, base_radius_m = 0.1, top_radius_m = 0.05, height_m = 0.4)$centre_m
#' body_spherical_cap(mass_kg = 1, radius_m = 0.1, height_m = 0.05)
#' body_ellipsoid(mass_kg = 0.4, semi_x_m = 0.14, semi_y_m = 0.085, semi_z_m = 0.085) # rugby
#' body_capsule(mass_kg = 0.001, radius_m = 0.003, length_m = 0.01)
#' body_torus(mass_kg = 1.2, ring_radius_m = 0.3, tube_radius_m = 0.02) # a tyre
#' body_half_cylinder(mass_kg = 2, radius_m = 0.1, length_m = 0.5)
#' body_elliptic_cylinder(mass_kg = 2, semi_x_m = 0.1, semi_y_m = 0.05, length_m = 0.5)
#' @name body_round_solids
NULL

#' @rdname body_round_solids
#' @export
body_cylinder <- function(mass_kg, radius_m, length_m, ..., density_kg_m3 = NULL) {
  new_shape_body("cylinder", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_thick_tube <- function(mass_kg, outer_radius_m, inner_radius_m, length_m, ...,
                            density_kg_m3 = NULL) {
  new_shape_body("thick_tube", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_half_cylinder <- function(mass_kg, radius_m, length_m, ..., density_kg_m3 = NULL) {
  new_shape_body("half_cylinder", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_elliptic_cylinder <- function(mass_kg, semi_x_m, semi_y_m, length_m, ...,
                                   density_kg_m3 = NULL) {
  new_shape_body("elliptic_cylinder", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_sphere <- function(mass_kg, radius_m, ..., density_kg_m3 = NULL) {
  new_shape_body("sphere", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_hollow_sphere <- function(mass_kg, outer_radius_m, inner_radius_m, ..., density_kg_m3 = NULL) {
  new_shape_body("hollow_sphere", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_hemisphere <- function(mass_kg, radius_m, ..., density_kg_m3 = NULL) {
  new_shape_body("hemisphere", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_spherical_cap <- function(mass_kg, radius_m, height_m, ..., density_kg_m3 = NULL) {
  new_shape_body("spherical_cap", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_cone <- function(mass_kg, radius_m, height_m, ..., density_kg_m3 = NULL) {
  new_shape_body("cone", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_frustum <- function(mass_kg, base_radius_m, top_radius_m, height_m, ...,
                         density_kg_m3 = NULL) {
  new_shape_body("frustum", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_paraboloid <- function(mass_kg, radius_m, height_m, ..., density_kg_m3 = NULL) {
  new_shape_body("paraboloid", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_ellipsoid <- function(mass_kg, semi_x_m, semi_y_m, semi_z_m, ..., density_kg_m3 = NULL) {
  new_shape_body("ellipsoid", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_torus <- function(mass_kg, ring_radius_m, tube_radius_m, ..., density_kg_m3 = NULL) {
  new_shape_body("torus", check_no_dots(...))
}

#' @rdname body_round_solids
#' @export
body_capsule <- function(mass_kg, radius_m, length_m, ..., density_kg_m3 = NULL) {
  new_shape_body("capsule", check_no_dots(...))
}

#' Bodies of standard shapes: solids with flat faces
#'
#' Polyhedra of uniform density. For a tetrahedron given by its vertices see [body_tetrahedron()].
#' The own axes are principal axes, except for the triangular prism: Ixy = -m h (2 p - b) / 36.
#'
#' `r describe_shapes("flat-faced solids")`
#' `r formula_note`
#'
#' @param length_m,width_m,height_m Edges along x, y and z; the length of a prism is along z, and a
#'   pyramid has a rectangular base and its apex above the middle.
#' @param edge_m Edge, at least 0 m.
#' @param radius_m Radius of the circle through the corners of the prism's base.
#' @param sides Number of sides, a whole number of at least 3.
#' @param base_m,apex_m The triangle across a prism, as in [body_triangle()], with `height_m`.
#' @param density_kg_m3 Mass per volume, instead of `mass_kg`.
#' @inheritParams body_shapes
#' @inherit body_shapes return source
#' @inheritSection body_shapes Errors
#' @seealso [shapes()], [body_shapes], [join_bodies()], [cut_body()].
#' @concept box
#' @concept cube
#' @concept prism
#' @concept pyramid
#' @concept moment of inertia
#' @examples
#' body_box(mass_kg = 2, length_m = 0.3, width_m = 0.2, height_m = 0.1)
#' body_cube(edge_m = 0.1, density_kg_m3 = 1000)
#' body_polygon_prism(radius_m = 0.008, sides = 6, length_m = 0.013, density_kg_m3 = 7850)
#' body_triangular_prism(mass_kg = 1, base_m = 0.1, height_m = 0.1, length_m = 0.3)
#' body_pyramid(mass_kg = 6e9, length_m = 230, width_m = 230, height_m = 147)$centre_m
#' # The moments of the regular solids are equal about every axis.
#' body_regular_tetrahedron(mass_kg = 1, edge_m = 0.1)
#' body_regular_octahedron(mass_kg = 1, edge_m = 0.1)
#' @name body_flat_faced_solids
NULL

#' @rdname body_flat_faced_solids
#' @export
body_box <- function(mass_kg, length_m, width_m, height_m, ..., density_kg_m3 = NULL) {
  new_shape_body("box", check_no_dots(...))
}

#' @rdname body_flat_faced_solids
#' @export
body_cube <- function(mass_kg, edge_m, ..., density_kg_m3 = NULL) {
  new_shape_body("cube", check_no_dots(...))
}

#' @rdname body_flat_faced_solids
#' @export
body_polygon_prism <- function(mass_kg, radius_m, sides, length_m, ..., density_kg_m3 = NULL) {
  new_shape_body("polygon_prism", check_no_dots(...))
}

#' @rdname body_flat_faced_solids
#' @export
body_triangular_prism <- function(mass_kg, base_m, height_m, length_m, ..., apex_m = base_m / 2,
                                  density_kg_m3 = NULL) {
  new_shape_body("triangular_prism", check_no_dots(...))
}

#' @rdname body_flat_faced_solids
#' @export
body_pyramid <- function(mass_kg, length_m, width_m, height_m, ..., density_kg_m3 = NULL) {
  new_shape_body("pyramid", check_no_dots(...))
}

#' @rdname body_flat_faced_solids
#' @export
body_regular_tetrahedron <- function(mass_kg, edge_m, ..., density_kg_m3 = NULL) {
  new_shape_body("regular_tetrahedron", check_no_dots(...))
}

#' @rdname body_flat_faced_solids
#' @export
body_regular_octahedron <- function(mass_kg, edge_m, ..., density_kg_m3 = NULL) {
  new_shape_body("regular_octahedron", check_no_dots(...))
}
