# Text about the standard shapes: formulas, origin, source. Their sizes and moments are in
# src/core/body/shapes_geometry.c; a test evaluates every formula here and compares the results.
#
# m is the mass; a blank multiplies. Moments are about the centre of mass, along the own axes;
# `axis` and `formula` belong to the moment reported by inertia_table().
shape_words <- function(shape, family, sizes, ixx, iyy = ixx, izz = ixx, centre = "(0, 0, 0)",
                        origin = "its centre", beta = "", measure = "", axis, formula = izz,
                        source = "by integration") {
  c(
    shape = shape, family = family, sizes = sizes, ixx = ixx, iyy = iyy, izz = izz, centre = centre,
    origin = origin, beta = beta, measure = measure, axis = axis, formula = formula, source = source
  )
}

beer_johnston <- "Beer and Johnston, inside cover"
meriam_kraige <- "Meriam and Kraige, table D/4"

shape_list <- list(
  shape_words(
    "point", "lines", "r = radius_m", "0", centre = "(r, 0, 0)", origin = "on the axis",
    axis = "at distance r", formula = "m r^2", source = "from the definition"
  ),
  shape_words(
    "sliding_point", "lines", "r = radius_m", "0", origin = "the point", beta = "0",
    axis = "none: it slides", formula = "0", source = "from the definition"
  ),
  shape_words(
    "rod", "lines", "l = length_m", "0", iyy = "m l^2 / 12", izz = "m l^2 / 12", measure = "l",
    axis = "perpendicular, through the centre", source = beer_johnston
  ),
  shape_words(
    "rod_end", "lines", "l = length_m", "0", iyy = "m l^2 / 12", izz = "m l^2 / 12",
    centre = "(l / 2, 0, 0)", origin = "one end", measure = "l",
    axis = "perpendicular, through one end", formula = "m l^2 / 3",
    source = beer_johnston
  ),
  shape_words(
    "hoop", "lines", "r = radius_m", "m r^2 / 2", izz = "m r^2", beta = "1", measure = "2 pi r",
    axis = "symmetry axis", source = "from the definition"
  ),
  shape_words(
    "half_hoop", "lines", "r = radius_m", "m r^2 (1 / 2 - 4 / pi^2)", iyy = "m r^2 / 2",
    izz = "m r^2 (1 - 4 / pi^2)", centre = "(0, 2 r / pi, 0)", origin = "centre of the full hoop",
    measure = "pi r", axis = "perpendicular, through the centre of mass"
  ),
  shape_words(
    "disk", "plates", "r = radius_m", "m r^2 / 4", izz = "m r^2 / 2", beta = "1 / 2",
    measure = "pi r^2", axis = "symmetry axis", source = beer_johnston
  ),
  shape_words(
    "annulus", "plates", "R = outer_radius_m, r = inner_radius_m", "m (R^2 + r^2) / 4",
    izz = "m (R^2 + r^2) / 2", beta = "(1 + (r / R)^2) / 2", measure = "pi (R^2 - r^2)",
    axis = "symmetry axis"
  ),
  shape_words(
    "half_disk", "plates", "r = radius_m", "m r^2 (1 / 4 - 16 / (9 pi^2))", iyy = "m r^2 / 4",
    izz = "m r^2 (1 / 2 - 16 / (9 pi^2))", centre = "(0, 4 r / (3 pi), 0)",
    origin = "centre of the full disk", measure = "pi r^2 / 2",
    axis = "perpendicular, through the centre of mass", source = "Meriam and Kraige, table D/3"
  ),
  shape_words(
    "elliptic_plate", "plates", "a = semi_x_m, b = semi_y_m", "m b^2 / 4", iyy = "m a^2 / 4",
    izz = "m (a^2 + b^2) / 4", measure = "pi a b",
    axis = "perpendicular, through the centre of mass", source = "Meriam and Kraige, table D/3"
  ),
  shape_words(
    "rectangle", "plates", "a = length_m, b = width_m", "m b^2 / 12", iyy = "m a^2 / 12",
    izz = "m (a^2 + b^2) / 12", measure = "a b", axis = "perpendicular, through the centre of mass",
    source = beer_johnston
  ),
  shape_words(
    "triangle", "plates", "b = base_m, h = height_m, p = apex_m", "m h^2 / 18",
    iyy = "m (b^2 - b p + p^2) / 18", izz = "m (b^2 - b p + p^2 + h^2) / 18",
    centre = "((b + p) / 3, h / 3, 0)",
    origin = "corner of the base, which lies along x; the apex is at (p, h)", measure = "b h / 2",
    axis = "perpendicular, through the centre of mass"
  ),
  shape_words(
    "polygon_plate", "plates", "r = radius_m, n = sides", "m r^2 (2 + cos(2 pi / n)) / 12",
    izz = "m r^2 (2 + cos(2 pi / n)) / 6",
    origin = "its centre; corners on the circle of radius r, one on x",
    measure = "n r^2 sin(2 pi / n) / 2", axis = "perpendicular, through the centre of mass"
  ),
  shape_words(
    "tube", "shells", "r = radius_m, l = length_m", "m r^2 / 2 + m l^2 / 12", izz = "m r^2",
    beta = "1", measure = "2 pi r l", axis = "symmetry axis",
    source = meriam_kraige
  ),
  shape_words(
    "can", "shells", "r = radius_m, l = length_m",
    "m r^2 (2 l + r) / (4 (l + r)) + m l^2 (l + 3 r) / (12 (l + r))",
    izz = "m r^2 (2 l + r) / (2 (l + r))", beta = "(2 l + r) / (2 (l + r))",
    measure = "2 pi r (l + r)", axis = "symmetry axis"
  ),
  shape_words(
    "spherical_shell", "shells", "r = radius_m", "2 m r^2 / 3", beta = "2 / 3",
    measure = "4 pi r^2", axis = "any diameter", source = meriam_kraige
  ),
  shape_words(
    "hemispherical_shell", "shells", "r = radius_m", "5 m r^2 / 12", izz = "2 m r^2 / 3",
    centre = "(0, 0, r / 2)", origin = "centre of the rim", measure = "2 pi r^2",
    axis = "symmetry axis", source = meriam_kraige
  ),
  shape_words(
    "spherical_cap_shell", "shells", "R = radius_m, h = height_m",
    "m h (6 R - 2 h) / 12 + m h^2 / 12", izz = "m h (3 R - h) / 3", centre = "(0, 0, h / 2)",
    origin = "centre of the rim", measure = "2 pi R h", axis = "symmetry axis"
  ),
  shape_words(
    "cone_shell", "shells", "r = radius_m, h = height_m", "m r^2 / 4 + m h^2 / 18",
    izz = "m r^2 / 2", centre = "(0, 0, h / 3)", origin = "centre of the rim",
    measure = "pi r sqrt(r^2 + h^2)", axis = "symmetry axis",
    source = meriam_kraige
  ),
  shape_words(
    "frustum_shell", "shells", "R = base_radius_m, r = top_radius_m, h = height_m",
    "m (R^2 + r^2) / 4 + m h^2 (R^2 + 4 R r + r^2) / (18 (R + r)^2)", izz = "m (R^2 + r^2) / 2",
    centre = "(0, 0, h (R + 2 r) / (3 (R + r)))", origin = "centre of the rim of radius R",
    measure = "pi (R + r) sqrt((R - r)^2 + h^2)", axis = "symmetry axis"
  ),
  shape_words(
    "torus_shell", "shells", "R = ring_radius_m, a = tube_radius_m", "m (2 R^2 + 5 a^2) / 4",
    izz = "m (R^2 + 3 a^2 / 2)", beta = "(R^2 + 3 a^2 / 2) / (R + a)^2", measure = "4 pi^2 R a",
    axis = "symmetry axis"
  ),
  shape_words(
    "ellipsoid_shell", "shells", "a = semi_x_m, b = semi_y_m, c = semi_z_m", "m (b^2 + c^2) / 3",
    iyy = "m (a^2 + c^2) / 3", izz = "m (a^2 + b^2) / 3", axis = "z, through the centre of mass"
  ),
  shape_words(
    "box_shell", "shells", "a = length_m, b = width_m, c = height_m",
    "m b^2 (1 + 2 a c / (a b + b c + a c)) / 12 + m c^2 (1 + 2 a b / (a b + b c + a c)) / 12",
    iyy = "m a^2 (1 + 2 b c / (a b + b c + a c)) / 12 + m c^2 (1 + 2 a b / (a b + b c + a c)) / 12",
    izz = "m a^2 (1 + 2 b c / (a b + b c + a c)) / 12 + m b^2 (1 + 2 a c / (a b + b c + a c)) / 12",
    measure = "2 (a b + b c + a c)", axis = "z, through the centre of mass"
  ),
  shape_words(
    "cylinder", "round solids", "r = radius_m, l = length_m", "m r^2 / 4 + m l^2 / 12",
    izz = "m r^2 / 2", beta = "1 / 2", measure = "pi r^2 l", axis = "symmetry axis",
    source = beer_johnston
  ),
  shape_words(
    "thick_tube", "round solids", "R = outer_radius_m, r = inner_radius_m, l = length_m",
    "m (R^2 + r^2) / 4 + m l^2 / 12", izz = "m (R^2 + r^2) / 2", beta = "(1 + (r / R)^2) / 2",
    measure = "pi (R^2 - r^2) l", axis = "symmetry axis"
  ),
  shape_words(
    "half_cylinder", "round solids", "r = radius_m, l = length_m",
    "m r^2 (1 / 4 - 16 / (9 pi^2)) + m l^2 / 12", iyy = "m r^2 / 4 + m l^2 / 12",
    izz = "m r^2 (1 / 2 - 16 / (9 pi^2))", centre = "(0, 4 r / (3 pi), 0)",
    origin = "centre of the full cylinder", measure = "pi r^2 l / 2",
    axis = "parallel to the edges, through the centre of mass",
    source = meriam_kraige
  ),
  shape_words(
    "elliptic_cylinder", "round solids", "a = semi_x_m, b = semi_y_m, l = length_m",
    "m b^2 / 4 + m l^2 / 12", iyy = "m a^2 / 4 + m l^2 / 12", izz = "m (a^2 + b^2) / 4",
    measure = "pi a b l", axis = "axis of the cylinder", source = meriam_kraige
  ),
  shape_words(
    "sphere", "round solids", "r = radius_m", "2 m r^2 / 5", beta = "2 / 5",
    measure = "4 pi r^3 / 3", axis = "any diameter", source = beer_johnston
  ),
  shape_words(
    "hollow_sphere", "round solids", "R = outer_radius_m, r = inner_radius_m",
    "2 m (R^4 + R^3 r + R^2 r^2 + R r^3 + r^4) / (5 (R^2 + R r + r^2))",
    beta = "2 (R^4 + R^3 r + R^2 r^2 + R r^3 + r^4) / (5 R^2 (R^2 + R r + r^2))",
    measure = "4 pi (R^3 - r^3) / 3", axis = "any diameter"
  ),
  shape_words(
    "hemisphere", "round solids", "r = radius_m", "83 m r^2 / 320", izz = "2 m r^2 / 5",
    centre = "(0, 0, 3 r / 8)", origin = "centre of the base", measure = "2 pi r^3 / 3",
    axis = "symmetry axis", source = meriam_kraige
  ),
  shape_words(
    "spherical_cap", "round solids", "R = radius_m, h = height_m",
    paste(
      "m h (20 R^2 - 15 R h + 3 h^2) / (20 (3 R - h))",
      "+ m h^2 (40 R^2 - 24 R h + 3 h^2) / (80 (3 R - h)^2)"
    ),
    izz = "m h (20 R^2 - 15 R h + 3 h^2) / (10 (3 R - h))",
    centre = "(0, 0, h (4 R - h) / (4 (3 R - h)))", origin = "centre of the base",
    measure = "pi h^2 (3 R - h) / 3", axis = "symmetry axis"
  ),
  shape_words(
    "cone", "round solids", "r = radius_m, h = height_m", "3 m r^2 / 20 + 3 m h^2 / 80",
    izz = "3 m r^2 / 10", centre = "(0, 0, h / 4)", origin = "centre of the base",
    measure = "pi r^2 h / 3", axis = "symmetry axis", source = beer_johnston
  ),
  shape_words(
    "frustum", "round solids", "R = base_radius_m, r = top_radius_m, h = height_m",
    paste(
      "3 m (R^4 + R^3 r + R^2 r^2 + R r^3 + r^4) / (20 (R^2 + R r + r^2))",
      "+ 3 m h^2 (R^4 + 4 R^3 r + 10 R^2 r^2 + 4 R r^3 + r^4) / (80 (R^2 + R r + r^2)^2)"
    ),
    izz = "3 m (R^4 + R^3 r + R^2 r^2 + R r^3 + r^4) / (10 (R^2 + R r + r^2))",
    centre = "(0, 0, h (R^2 + 2 R r + 3 r^2) / (4 (R^2 + R r + r^2)))",
    origin = "centre of the base of radius R", measure = "pi h (R^2 + R r + r^2) / 3",
    axis = "symmetry axis"
  ),
  shape_words(
    "paraboloid", "round solids", "r = radius_m, h = height_m", "m r^2 / 6 + m h^2 / 18",
    izz = "m r^2 / 3", centre = "(0, 0, h / 3)", origin = "centre of the base",
    measure = "pi r^2 h / 2", axis = "symmetry axis", source = meriam_kraige
  ),
  shape_words(
    "ellipsoid", "round solids", "a = semi_x_m, b = semi_y_m, c = semi_z_m", "m (b^2 + c^2) / 5",
    iyy = "m (a^2 + c^2) / 5", izz = "m (a^2 + b^2) / 5", measure = "4 pi a b c / 3",
    axis = "z, through the centre of mass", source = meriam_kraige
  ),
  shape_words(
    "torus", "round solids", "R = ring_radius_m, a = tube_radius_m", "m (4 R^2 + 5 a^2) / 8",
    izz = "m (R^2 + 3 a^2 / 4)", beta = "(R^2 + 3 a^2 / 4) / (R + a)^2", measure = "2 pi^2 R a^2",
    axis = "symmetry axis", source = meriam_kraige
  ),
  shape_words(
    "capsule", "round solids", "r = radius_m, l = length_m",
    "m (l (3 r^2 + l^2) / 12 + r (8 r^2 / 15 + l^2 / 3 + l r / 2)) / (l + 4 r / 3)",
    izz = "m (l r^2 / 2 + 8 r^3 / 15) / (l + 4 r / 3)",
    origin = "its centre; l is the length of the cylinder between the half spheres",
    beta = "(l / 2 + 8 r / 15) / (l + 4 r / 3)", measure = "pi r^2 (l + 4 r / 3)",
    axis = "symmetry axis"
  ),
  shape_words(
    "box", "flat-faced solids", "a = length_m, b = width_m, c = height_m", "m (b^2 + c^2) / 12",
    iyy = "m (a^2 + c^2) / 12", izz = "m (a^2 + b^2) / 12", measure = "a b c",
    axis = "z, through the centre of mass", source = beer_johnston
  ),
  shape_words(
    "cube", "flat-faced solids", "a = edge_m", "m a^2 / 6", measure = "a^3",
    axis = "any, through the centre", source = beer_johnston
  ),
  shape_words(
    "polygon_prism", "flat-faced solids", "r = radius_m, n = sides, l = length_m",
    "m r^2 (2 + cos(2 pi / n)) / 12 + m l^2 / 12", izz = "m r^2 (2 + cos(2 pi / n)) / 6",
    origin = "its centre; corners on the circle of radius r, an edge along z crosses x",
    measure = "n r^2 sin(2 pi / n) l / 2", axis = "symmetry axis"
  ),
  shape_words(
    "triangular_prism", "flat-faced solids", "b = base_m, h = height_m, p = apex_m, l = length_m",
    "m h^2 / 18 + m l^2 / 12", iyy = "m (b^2 - b p + p^2) / 18 + m l^2 / 12",
    izz = "m (b^2 - b p + p^2 + h^2) / 18", centre = "((b + p) / 3, h / 3, 0)",
    origin = "corner of the base, half way along the prism; the apex is at (p, h)",
    measure = "b h l / 2", axis = "parallel to the edges, through the centre of mass"
  ),
  shape_words(
    "pyramid", "flat-faced solids", "a = length_m, b = width_m, h = height_m",
    "m b^2 / 20 + 3 m h^2 / 80", iyy = "m a^2 / 20 + 3 m h^2 / 80", izz = "m (a^2 + b^2) / 20",
    centre = "(0, 0, h / 4)", origin = "centre of the base", measure = "a b h / 3",
    axis = "through the apex and the centre of the base"
  ),
  shape_words(
    "regular_tetrahedron", "flat-faced solids", "a = edge_m", "m a^2 / 20",
    centre = "(0, 0, a sqrt(6) / 12)", origin = "centre of a face", measure = "a^3 sqrt(2) / 12",
    axis = "any, through the centre"
  ),
  shape_words(
    "regular_octahedron", "flat-faced solids", "a = edge_m", "m a^2 / 10",
    measure = "a^3 sqrt(2) / 3", axis = "any, through the centre"
  )
)

shape_words_table <- as.data.frame(do.call(rbind, shape_list))

# The standard shapes: the text above and the properties in C, in the order of C.
shape_table <- function() {
  if (is.null(shape_cache$table)) {
    list <- .Call(ffi_shapes_list)
    table <- shape_words_table # in the order of C
    table$names <- list$sizes
    table$dimension <- list$dimension
    shape_cache$sizes <- data.frame(
      name = list$size, kind = c("length", "offset", "count")[list$kind + 1L]
    )
    shape_cache$table <- table
  }
  shape_cache$table
}

# All sizes of shapes, in the order of the C core.
size_table <- function() {
  shape_table()
  shape_cache$sizes
}

shape_cache <- new.env(parent = emptyenv())

# The density of a shape, by its dimension.
density_names <- c("", "linear_density_kg_m", "areal_density_kg_m2", "density_kg_m3")
density_units <- c("", "kg/m", "kg/m^2", "kg/m^3")

shape_constructor <- function(shape) {
  ifelse(shape == "sliding_point", NA_character_, paste0("body_", shape))
}

#' The catalogue of shapes
#'
#' The standard shapes and their formulas.
#'
#' @return A tibble, one row for each shape: `r describe_columns(shape_columns)`
#'   In the formulas m is the mass and a blank multiplies; the letters are those of `sizes`. Moments
#'   are about the centre of mass, along the own axes. These are principal axes, except for the
#'   triangle and its prism: Ixy = -m h (2 p - b) / 36.
#' @seealso The constructors: [body_shapes], [body_plates], [body_shells], [body_round_solids],
#'   [body_flat_faced_solids]; [inertia_table()] for numbers.
#' @concept list of shapes
#' @concept moment of inertia
#' @concept formulas
#' @examples
#' shapes()
#' subset(shapes(), family == "plates", c(shape, sizes, izz_formula))
#' @export
shapes <- function() {
  table <- shape_table()
  new_table(list(
    shape = table$shape,
    family = table$family,
    constructor = shape_constructor(table$shape),
    dimension = table$dimension,
    sizes = table$sizes,
    ixx_formula = table$ixx,
    iyy_formula = table$iyy,
    izz_formula = table$izz,
    centre_formula = table$centre,
    origin = table$origin,
    beta_formula = ifelse(nzchar(table$beta), table$beta, NA_character_),
    measure_formula = ifelse(nzchar(table$measure), table$measure, NA_character_),
    axis = table$axis,
    formula = table$formula,
    source = table$source
  ), nrow = nrow(table))
}

formula_note <- paste(
  "In the formulas m is the mass and a blank multiplies. Moments are about the centre of mass, in",
  "the own axes; the centre of mass is at the origin unless stated otherwise; `measure` is the",
  "volume, area or length: the mass is its product with the density."
)

# For the help pages: the shapes of a family and their formulas.
describe_shapes <- function(family) {
  words <- shape_words_table[shape_words_table$family == family, ]
  code <- function(x) paste0("\\code{", x, "}")
  line <- function(name, x) ifelse(nzchar(x), paste0("; ", name, " ", code(x)), "")
  round <- words$ixx == words$iyy & words$iyy == words$izz
  moments <- ifelse(
    round, paste0("Ixx = Iyy = Izz = ", code(words$ixx)),
    ifelse(
      words$ixx == words$iyy,
      paste0("Ixx = Iyy = ", code(words$ixx), ", Izz = ", code(words$izz)),
      paste0("Ixx = ", code(words$ixx), ", Iyy = ", code(words$iyy), ", Izz = ", code(words$izz))
    )
  )
  centre <- ifelse(words$centre == "(0, 0, 0)", "", words$centre)
  items <- paste0(
    "\\item ", ifelse(
      words$shape == "sliding_point", code("\"sliding_point\""),
      code(paste0("body_", words$shape, "()"))
    ), ", ", words$sizes, ": ", moments, line("beta", words$beta), line("measure", words$measure),
    ". Origin: ", words$origin, line("centre of mass", centre), "."
  )
  paste0("\\itemize{\n", paste0(items, collapse = "\n"), "\n}")
}
