# The standard shapes, from the list in src/rot_shapes.h: shape, axis, formula, size (the name of
# the length that sizes it), k = I/(m size^2) about the axis named, kx, ky, kz about the centre.
shape_table <- function() {
  if (is.null(shape_cache$table)) {
    shape_cache$table <- .Call(ffi_shapes_list)
  }
  shape_cache$table
}

shape_cache <- new.env(parent = emptyenv())

# The article's names of the same things.
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

new_shape_body <- function(shape, mass_kg, size_m, rolls, call) {
  of <- shape_parts(shape)
  mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  size_m <- check_number(size_m, .subset2(of, "size_name"), "m", call, lower = 0)
  moments <- .Call(ffi_shapes_table, .subset2(of, "k"), mass_kg, size_m)[[1L]]
  k <- .subset2(of, "k")
  second <- c(
    (moments[2L] + moments[3L] - moments[1L]) / 2, (moments[1L] + moments[3L] - moments[2L]) / 2,
    (moments[1L] + moments[2L] - moments[3L]) / 2, 0, 0, 0
  )
  names(size_m) <- .subset2(of, "size_name")
  new_body(
    shape, mass_kg, second, c(0, 0, 0), size_m,
    beta = if (rolls) k[3L] else NA_real_,
    formula = .subset2(of, "formula"),
    error = 8 * .Machine$double.eps
  )
}

# What all bodies of a shape share, put together once.
shape_parts <- function(shape) {
  parts <- shape_cache[[shape]]
  if (is.null(parts)) {
    shapes <- shape_table()
    i <- match(shape, shapes$shape)
    axes <- c("x", "y", "z")
    parts <- list(
      size_name = shapes$size[i],
      k = c(shapes$kx[i], shapes$ky[i], shapes$kz[i]),
      tensor = list(dim = c(3L, 3L), dimnames = list(axes, axes)),
      formula = paste0(shapes$formula[i], "  (", shapes$axis[i], ")")
    )
    shape_cache[[shape]] <- parts
  }
  parts
}

#' Bodies of a standard shape
#'
#' A body has a mass, a centre of mass, an inertia tensor about that centre in the body's own axes,
#' and a size. Its `z` axis is the one it is usually spun about; a rod lies along `x`.
#'
#' | constructor | Ixx | Iyy | Izz | beta |
#' |---|---|---|---|---|
#' | `body_disk()` thin disk, or a cylinder about its axis | m r^2/4 | m r^2/4 | m r^2/2 | 1/2 |
#' | `body_hoop()` thin ring | m r^2/2 | m r^2/2 | m r^2 | 1 |
#' | `body_sphere()` solid | 2 m r^2/5 | 2 m r^2/5 | 2 m r^2/5 | 2/5 |
#' | `body_spherical_shell()` thin | 2 m r^2/3 | 2 m r^2/3 | 2 m r^2/3 | 2/3 |
#' | `body_rod()` thin | 0 | m l^2/12 | m l^2/12 | does not roll |
#'
#' `beta` is `Izz/(m r^2)`, what decides a race down an incline: see [rolling_table()].
#'
#' @param mass_kg Mass, one number, at least 0 kg.
#' @param radius_m Radius, one number, at least 0 m.
#' @param length_m Length of the rod, one number, at least 0 m.
#' @return A `rot_body`: a list with `shape`, `mass_kg`, `size_m`, `centre_m` (in the own axes),
#'   `inertia_kg_m2` (3 x 3, about the centre of mass; off-diagonal elements are minus the products
#'   of inertia), `point`, `axes`, `beta` and `formula`. Products carry at most four roundings.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_size` and `rotdyn_error_value` for what is
#'   not one finite number of at least 0 (NA, NaN and Inf included); `rotdyn_error_unit` for a units
#'   object of another dimension.
#' @source Goldstein, Poole and Safko, Classical Mechanics, 3rd ed. (2002), chapter 5.
#' @seealso [scene_axle()] puts a body on an axle; [inertia_table()] compares shapes.
#' @examples
#' body_disk(mass_kg = 2, radius_m = 0.25)
#' body_rod(mass_kg = 1.5, length_m = 2)$inertia_kg_m2
#' @name body_shapes
NULL

#' @rdname body_shapes
#' @export
body_disk <- function(mass_kg, radius_m) {
  if (missing(mass_kg) || missing(radius_m)) {
    check_supplied(c("mass_kg", "radius_m"), environment())
  }
  new_shape_body("disk", mass_kg, radius_m, TRUE, environment())
}

#' @rdname body_shapes
#' @export
body_hoop <- function(mass_kg, radius_m) {
  if (missing(mass_kg) || missing(radius_m)) {
    check_supplied(c("mass_kg", "radius_m"), environment())
  }
  new_shape_body("hoop", mass_kg, radius_m, TRUE, environment())
}

#' @rdname body_shapes
#' @export
body_sphere <- function(mass_kg, radius_m) {
  if (missing(mass_kg) || missing(radius_m)) {
    check_supplied(c("mass_kg", "radius_m"), environment())
  }
  new_shape_body("sphere", mass_kg, radius_m, TRUE, environment())
}

#' @rdname body_shapes
#' @export
body_spherical_shell <- function(mass_kg, radius_m) {
  if (missing(mass_kg) || missing(radius_m)) {
    check_supplied(c("mass_kg", "radius_m"), environment())
  }
  new_shape_body("spherical_shell", mass_kg, radius_m, TRUE, environment())
}

#' @rdname body_shapes
#' @export
body_rod <- function(mass_kg, length_m) {
  if (missing(mass_kg) || missing(length_m)) {
    check_supplied(c("mass_kg", "length_m"), environment())
  }
  new_shape_body("rod", mass_kg, length_m, FALSE, environment())
}
