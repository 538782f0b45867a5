#' A body from a mesh of triangles
#'
#' Mass, centre of mass and second moment of the solid inside a closed mesh, by the exact integrals
#' of the tetrahedra spanned by its faces, or of the surface itself. With d = a . (b - a) x (c - a)
#' and s = a + b + c for each face a, b, c,
#' \deqn{V = \frac{1}{6}\sum d,\quad g = \frac{1}{24 V}\sum d\,s,\quad
#'   C = \frac{m}{120 V}\sum d\,(s s^T + a a^T + b b^T + c c^T) - m\,g g^T}{
#'   V = sum d / 6,  g = sum d s / (24 V),
#'   C = m/(120 V) sum d (s s' + a a' + b b' + c c') - m g g'}
#' `check_mesh()` lists the defects of a mesh and says whether it bounds a solid.
#'
#' A mesh bounds a solid if exactly two faces use each edge, in opposite directions. The volume of a
#' mesh that is open or inconsistently oriented depends on the origin, so it is refused; `method`
#' offers alternatives.
#'
#' | method | body | mesh |
#' |---|---|---|
#' | `"solid"` | the enclosed volume | closed, consistently oriented |
#' | `"shell"` | the faces, with uniform areal density | any |
#' | `"hull"` | the convex hull of the vertices; needs the package geometry | any |
#' | `"box"` | the bounding box of the vertices, along the axes | any |
#'
#' **Parts** are connected components: faces connected by shared edges. Several parts are legal; a
#' part inside another and oriented the opposite way is a cavity. If all faces are oriented inwards,
#' `detail$flipped` says so. Not legal are a single inverted part, a part inside another with the
#' same orientation, parts that intersect, and duplicate parts. Parts may touch. A part that
#' intersects itself is not detected, and for large parts that intersect in a small region not every
#' pair of faces is tested.
#'
#' **Welding.** If the mesh is not closed, vertices with the same coordinates are merged (an STL
#' file repeats each vertex in each face), then vertices that differ only by rounding: by 2^-46 of
#' the largest coordinate, or 2^-23 for single precision. `weld_m` sets this distance; 0 merges only
#' equal vertices. The check counts `merged_vertices`; `error` includes the effect of moved
#' vertices.
#'
#' **Files.** OBJ, PLY (text and binary) and text STL need no other package, binary STL needs rgl.
#' Polygons are triangulated. The formats have no unit.
#'
#' @param mesh One of:
#'   * a `mesh3d` object as rgl, Rvcg and Morpho have them. Quadrangles are split in two.
#'   * a list of `vertices` (a numeric matrix of three columns, or a data frame of `x_m`, `y_m` and
#'     `z_m`; `x`, `y`, `z` in another unit) and `faces` (a matrix of three or four columns: the
#'     numbers of the vertices, from 1).
#'   * the path of an STL, OBJ or PLY file.
#' @param ... Not used; names after it must be given in full.
#' @param mass_kg Mass. Either this or a density must be given.
#' @param density_kg_m3 Density; not for `method = "shell"`.
#' @param areal_density_kg_m2 Mass per area, for `method = "shell"`.
#' @param length_unit Unit of the coordinates: "m", "cm", "mm", "in", "ft", ... It is not guessed; a
#'   mesh larger than 100 m without this argument gives a warning. Units objects have their own
#'   unit.
#' @param method The body made of the mesh: see above.
#' @param weld_m Distance within which vertices are merged; NULL: see above.
#' @param name Name of the body.
#' @return `body_mesh()`: a `rot_body` in the axes of the mesh, whose origin is the mesh's.
#'   `size_m` is that of the bounding box. `error` bounds the effect of rounding and welding; the
#'   coordinates are taken as exact. `detail$coordinate_error` is the effect of half an ulp of each
#'   coordinate, which is large for a mesh far from its origin. `detail` also has the method, the
#'   counts, volume or area, `closure` (the sum of the faces' area vectors relative to the area: 0
#'   within rounding), `volume_error`, `defects` (the counts that fail) and the whole `check`.
#'
#'   `check_mesh()`: a tibble of class `rot_mesh_check`, one row for each condition:
#'   `r describe_columns(c("condition", "count", "verdict", "meaning"), check_verdict)`
#' @section Errors: `rotdyn_error_mesh` for a mesh that does not bound a solid (the message counts
#'   the defects, and the condition's `check` is the result of `check_mesh()`), for coordinates that
#'   are not finite, invalid vertex numbers, and no faces. `rotdyn_error_missing` and
#'   `rotdyn_error_value` unless exactly one of mass and density is given, `rotdyn_error_file`,
#'   `rotdyn_error_package`, `rotdyn_error_type`, `rotdyn_error_unit`, `rotdyn_error_range`. A
#'   warning `rotdyn_warning_unit` for a mesh that seems to be in millimetres.
#' @source Tonon, Journal of Mathematics and Statistics 1 (2005) 8; van Oosterom and Strackee, IEEE
#'   Transactions on Biomedical Engineering 30 (1983) 125, for solid angles.
#' @seealso [body_points()], [body_density()], [join_bodies()]
#' @concept CAD
#' @concept STL
#' @concept triangle mesh
#' @examples
#' # A tetrahedron.
#' corner <- list(
#'   vertices = rbind(c(0, 0, 0), c(1, 0, 0), c(0, 2, 0), c(0, 0, 3)),
#'   faces = rbind(c(1, 3, 2), c(1, 2, 4), c(1, 4, 3), c(2, 3, 4))
#' )
#' body_mesh(corner, density_kg_m3 = 1000)
#'
#' # Without one face it is open.
#' open <- list(vertices = corner$vertices, faces = corner$faces[-1, ])
#' check_mesh(open)
#' try(body_mesh(open, mass_kg = 1))
#' body_mesh(open, mass_kg = 1, method = "shell")$detail$area_m2
#' @export
body_mesh <- function(mesh, ..., mass_kg = NULL, density_kg_m3 = NULL, areal_density_kg_m2 = NULL,
                      length_unit = "m", method = c("solid", "shell", "hull", "box"),
                      weld_m = NULL, name = NULL) {
  call <- check_no_dots(...)
  check_supplied("mesh", call)
  method <- if (missing(method)) "solid" else method
  check_string(method, "method", c("solid", "shell", "hull", "box"), call)
  amount <- mesh_amount(mass_kg, density_kg_m3, areal_density_kg_m2, method, call)
  name <- if (!is.null(name)) {
    check_name(name, "name", call)
  } else if (is.character(mesh) && length(mesh) == 1L) {
    basename(mesh)
  } else {
    "mesh"
  }
  read <- as_mesh(mesh, length_unit, call)
  found <- inspect_mesh(read, weld_m, call)
  check <- found_table(found)
  check_mesh_fits(check, found, method, call)
  of <- switch(method,
    box = mesh_box(read, found, call),
    hull = mesh_hull(read, found, call),
    mesh_moments(read, found, method == "shell", call)
  )
  if (missing(length_unit)) warn_of_millimetres(of, call)
  mesh_body(name, of, amount, read, found, check, method, call)
}

#' @rdname body_mesh
#' @export
check_mesh <- function(mesh, ..., length_unit = "m", weld_m = NULL) {
  call <- check_no_dots(...)
  check_supplied("mesh", call)
  found_table(inspect_mesh(as_mesh(mesh, length_unit, call), weld_m, call))
}

# ---- arguments ----------------------------------------------------------------------------------

mesh_amount <- function(mass_kg, density_kg_m3, areal_density_kg_m2, method, call) {
  given <- list(
    mass_kg = mass_kg, density_kg_m3 = density_kg_m3, areal_density_kg_m2 = areal_density_kg_m2
  )
  given <- given[!vapply(given, is.null, logical(1))]
  density <- if (method == "shell") "areal_density_kg_m2" else "density_kg_m3"
  wanted <- c("mass_kg", density)
  if (!length(given)) {
    abort_rotdyn("One of {.arg mass_kg} and {.arg {density}} must be given.", "missing", call)
  }
  if (length(given) > 1L || !names(given) %in% wanted) {
    abort_rotdyn(c(
      "Exactly one of {.arg mass_kg} and {.arg {density}} must be given with
       {.code method = \"{method}\"}.",
      x = "Given {?is/are} {.arg {names(given)}}."
    ), "value", call)
  }
  kind <- names(given)
  unit <- c(mass_kg = "kg", density_kg_m3 = "kg/m^3", areal_density_kg_m2 = "kg/m^2")[[kind]]
  list(kind = kind, value = check_number(given[[1L]], kind, unit, call, lower = 0))
}

warn_of_millimetres <- function(of, call) {
  side <- max(of$hi - of$lo)
  if (side > 100) {
    warn_rotdyn(c(
      "The mesh is {format(side, digits = 3)} m long.",
      i = "Mesh files have no unit. For coordinates in millimetres, use
           {.code length_unit = \"mm\"}; for metres, {.code length_unit = \"m\"}."
    ), "unit", call)
  }
}

# ---- defects ------------------------------------------------------------------------------------

# Unchanged, then with equal vertices merged, then with those that differ by rounding: the first
# that is closed, or else the one with the fewest bad edges.
inspect_mesh <- function(read, weld_m, call) {
  largest <- if (length(read$vertices)) max(abs(read$vertices[is.finite(read$vertices)]), 0) else 0
  rounding <- largest * c(2^-46, if (isTRUE(read$single)) 2^-23)
  distances <- if (is.null(weld_m)) {
    # Loose triangles need not be tried unchanged.
    loose <- length(read$faces) > 3 && length(read$faces) <= mesh_vertex_count(read)
    c(if (!loose) -1, 0, rounding[rounding > 0])
  } else {
    check_number(weld_m, "weld_m", "m", call, lower = 0) / read$factor
  }
  best <- NULL
  for (distance in distances) {
    one <- .Call(
      ffi_mesh_check, read$vertices, read$faces, read$by_column, distance, progress_bar("mesh")
    )
    if (one$kind == "value") {
      abort_rotdyn(c(
        "{.arg weld_m} must be at least 2^-52 of the largest coordinate, or 0.",
        x = "It is {format(weld_m)}, and the largest coordinate
             {format(largest * read$factor, digits = 3)} m.",
        i = "0 merges only equal vertices."
      ), "value", call)
    }
    check_core_status(one$kind, call)
    one$distance <- if (isTRUE(one$counts[["merged_vertices"]] > 0)) max(distance, 0) else 0
    bad <- sum(one$counts[c("open_edges", "miswound", "crowded", "touching")])
    if (is.null(best) || isTRUE(bad < best$bad)) {
      best <- one
      best$bad <- bad
    }
    if (is.na(bad) || bad == 0) break
  }
  best
}

mesh_vertex_count <- function(read) dim(read$vertices)[1L + read$by_column]

check_core_status <- function(kind, call) {
  if (kind == "memory") abort_rotdyn("There is not enough memory for the mesh.", "memory", call)
  if (!kind %in% c("none", "range")) {
    abort_rotdyn("The mesh cannot be computed: {kind}.", kind, call)
  }
}

# key: of the counts that C returns. fails: the methods for which a count above 0 fails ("any":
# all).
mesh_conditions <- as.data.frame(do.call(rbind, list(
  c("faces", "any", "there are faces", "number of faces", "no faces", "Add faces."),
  c(
    "bad_vertices", "any", "coordinates are finite", "vertices with NA, NaN or Inf",
    "{n} vert{?ex/ices} with a coordinate that is not finite",
    "Correct or remove them."
  ),
  c(
    "bad_faces", "any", "vertex numbers are valid",
    "faces with a vertex number below 1, above the number of vertices, NA or not whole",
    "{n} face{?s} with an invalid vertex number", "Vertices are counted from 1."
  ),
  c(
    "open_edges", "solid", "no boundary edges", "edges of one face: the rims of holes",
    "{n} boundary edge{?s}, with only one face", "Close the holes."
  ),
  c(
    "miswound", "solid", "consistent orientation",
    "edges that two faces use in the same direction: one of them is flipped",
    "{n} edge{?s} between inconsistently oriented faces", "Flip some faces."
  ),
  c(
    "crowded", "solid", "no non-manifold edges",
    "edges of more than two faces, with directions not balanced",
    "{n} non-manifold edge{?s}, with more than two faces", "Remove inner walls and fins."
  ),
  c(
    "touching", "solid", "parts do not touch along an edge",
    "non-manifold edges with as many faces in one direction as in the other",
    "{n} non-manifold edge{?s} with four faces or more, where parts touch",
    "Give each part its own vertices, or make a body of each."
  ),
  c(
    "duplicate_faces", "solid", "no duplicate faces",
    "faces with the vertices of an earlier one", "{n} duplicate face{?s}", "Remove them."
  ),
  c(
    "inverted", "solid", "no inverted parts",
    "parts oriented against the whole that are not cavities", "{n} inverted part{?s}",
    "Flip their faces."
  ),
  c(
    "overlapping", "solid", "no overlapping parts",
    "parts inside others or intersecting them: mass counted twice",
    "{n} overlapping part{?s}", "Make a body of each part, or take their union."
  ),
  c(
    "flat", "flat", "parts have a volume", "parts with zero volume, within rounding",
    "zero volume, within rounding", "Use {.code method = \"shell\"} for a sheet."
  ),
  c("components", "", "parts", "connected components", "", ""),
  c("cavities", "", "cavities", "parts inside the whole, oriented against it", "", ""),
  c("flipped", "", "faces point outwards", "1 if all faces point inwards", "", ""),
  c("degenerate", "", "no degenerate faces", "faces with a vertex twice: ignored", "", ""),
  c("zero_area", "", "faces have an area", "faces with collinear vertices", "", ""),
  c("merged_vertices", "", "no vertices to merge", "vertices merged with another", "", ""),
  c("unused", "", "vertices are in use", "vertices that no face uses", "", ""),
  c("unchecked_parts", "", "all parts are checked", "parts not checked for overlap", "", "")
)))
names(mesh_conditions) <- c("key", "fails", "condition", "meaning", "fault", "remedy")

found_table <- function(found) {
  of <- mesh_conditions
  count <- unname(found$counts[of$key])
  bad <- count > 0
  bad[of$key == "faces"] <- count[of$key == "faces"] == 0
  bad[of$key == "flat"] <- isTRUE(found$counts[["flat"]] == found$counts[["components"]])
  fails <- of$fails != ""
  note <- !fails & count > (of$key == "components")
  note[of$key == "flat"] <- isTRUE(found$counts[["flat"]] > 0)
  verdict <- ifelse(fails & bad, "fails", ifelse(note, "note", "holds"))
  verdict[is.na(count)] <- "not checked"
  out <- as_table(
    condition = of$condition, count = count, verdict = verdict, meaning = of$meaning
  )
  class(out) <- c("rot_mesh_check", class(out))
  out
}

# Aborts if the method does not accept the mesh.
check_mesh_fits <- function(check, found, method, call) {
  fatal <- mesh_conditions$fails == "any" |
    (method == "solid" & mesh_conditions$fails %in% c("solid", "flat"))
  bad <- which(fatal & check$verdict == "fails")
  if (!length(bad)) return()
  faults <- vapply(bad, function(i) {
    n <- check$count[i]
    cli::format_inline(mesh_conditions$fault[i])
  }, character(1))
  remedies <- unique(mesh_conditions$remedy[bad])
  only_solid <- !any(mesh_conditions$fails[bad] == "any")
  names(faults) <- rep("x", length(faults))
  names(remedies) <- rep("i", length(remedies))
  abort_rotdyn(c(
    if (only_solid) "{.arg mesh} does not bound a solid." else "{.arg mesh} is damaged.",
    gsub("([{}])", "\\1\\1", faults),
    remedies,
    i = if (only_solid) {
      "Or use {.code method = \"shell\"}, {.code \"hull\"} or {.code \"box\"}.
       {.fn check_mesh} lists all conditions."
    }
  ), "mesh", call, check = check)
}

# ---- the integrals ------------------------------------------------------------------------------

# In metres, per unit of mass.
mesh_moments <- function(read, found, shell, call) {
  of <- .Call(
    ffi_mesh_moments, read$vertices, read$faces, read$by_column, found$same, shell,
    progress_bar("mesh")
  )
  if (of$kind == "range") {
    abort_rotdyn(
      if (shell) "The faces of {.arg mesh} have no area." else "{.arg mesh} encloses no volume.",
      "mesh", call, check = found_table(found)
    )
  }
  check_core_status(of$kind, call)
  of$error <- of$error + of$moved_error * found$distance
  mesh_in_metres(of, read$factor, if (shell) 2 else 3)
}

mesh_in_metres <- function(of, factor, power) {
  of$dimension <- power
  if (factor == 1) return(of)
  for (length in c("centre", "lo", "hi", "reach")) of[[length]] <- factor * of[[length]]
  of$reach <- of$reach * (1 + 2 * .Machine$double.eps)
  of$second <- factor * (factor * of$second)
  of$area <- factor * (factor * of$area)
  of$size <- of$size * factor^power
  of$error <- of$error + 4 * .Machine$double.eps
  of$size_error <- of$size_error + 4 * .Machine$double.eps
  of
}

mesh_hull <- function(read, found, call) {
  need_package("geometry", "The convex hull of a mesh", call)
  points <- if (read$by_column) t(read$vertices[1:3, , drop = FALSE]) else read$vertices
  points <- unique(points[sort(unique(as.vector(read$faces))), , drop = FALSE])
  # Quickhull has absolute thresholds.
  middle <- (apply(points, 2, min) + apply(points, 2, max)) / 2
  scale <- max(abs(sweep(points, 2, middle)))
  local <- sweep(points, 2, middle) / if (scale > 0) scale else 1
  faces <- tryCatch(
    geometry::convhulln(local),
    error = function(e) {
      abort_rotdyn(
        c("The vertices of {.arg mesh} have no convex hull with a volume.",
          i = "Use {.code method = \"shell\"} for a sheet."
        ), "mesh", call
      )
    }
  )
  hull <- list(
    vertices = points, faces = outward_faces(local, faces), by_column = FALSE, factor = read$factor
  )
  found$same <- NULL
  found$distance <- 0
  of <- mesh_moments(hull, found, FALSE, call)
  # Slivers may have either orientation, which has no effect, so the edges are not checked.
  if (!(of$closure <= 1e-9)) {
    abort_rotdyn(c(
      "The convex hull of {.arg mesh} does not close.",
      i = "Use {.code method = \"box\"} or {.code \"shell\"}."
    ), "mesh", call)
  }
  of$faces <- nrow(faces)
  of
}

# Quickhull's triangles are not oriented; the mean of their vertices is inside.
outward_faces <- function(points, faces) {
  inside <- colMeans(points[unique(as.vector(faces)), , drop = FALSE])
  a <- points[faces[, 1], , drop = FALSE]
  u <- points[faces[, 2], , drop = FALSE] - a
  v <- points[faces[, 3], , drop = FALSE] - a
  n <- cbind(
    u[, 2] * v[, 3] - u[, 3] * v[, 2], u[, 3] * v[, 1] - u[, 1] * v[, 3],
    u[, 1] * v[, 2] - u[, 2] * v[, 1]
  )
  inwards <- rowSums(n * sweep(a, 2, inside)) < 0
  faces[inwards, 2:3] <- faces[inwards, 3:2]
  wind_alike(faces)
}

# Where many points are coplanar within rounding, some triangles are slivers or folded over their
# neighbours, and are oriented like these: a triangle is flipped if it is inconsistent with two of
# them or all three.
wind_alike <- function(faces) {
  maximum <- max(faces)
  for (pass in 1:20) {
    from <- as.double(faces)
    to <- as.vector(faces[, c(2, 3, 1)])
    along <- from * maximum + to
    same <- duplicated(along) | duplicated(along, fromLast = TRUE)
    against <- rowSums(matrix(same, ncol = 3L)) >= 2
    if (!any(against)) break
    faces[against, 2:3] <- faces[against, 3:2]
  }
  faces
}

mesh_box <- function(read, found, call) {
  at <- if (read$by_column) t(read$vertices[1:3, , drop = FALSE]) else read$vertices
  at <- at[sort(unique(as.vector(read$faces))), , drop = FALSE]
  lo <- apply(at, 2, min)
  hi <- apply(at, 2, max)
  side <- hi - lo
  of <- list(
    size = prod(side), size_error = 8 * .Machine$double.eps, centre = lo / 2 + hi / 2,
    second = c(side^2 / 12, 0, 0, 0), error = 8 * .Machine$double.eps,
    coordinate_error = 4 * sum(pmax(abs(lo), abs(hi)) * side) / sum(side^2) * 2^-53,
    reach = sqrt(sum(side^2)) / 2 * (1 + 4 * .Machine$double.eps),
    area = 2 * (side[1] * side[2] + side[2] * side[3] + side[3] * side[1]), closure = 0,
    lo = lo, hi = hi
  )
  if (!all(side > 0)) abort_rotdyn("The box of {.arg mesh} has no volume.", "mesh", call)
  mesh_in_metres(of, read$factor, 3)
}

mesh_body <- function(name, of, amount, read, found, check, method, call) {
  size <- abs(of$size)
  mass <- if (amount$kind == "mass_kg") amount$value else amount$value * size
  error <- of$error
  if (amount$kind != "mass_kg") error <- error + of$size_error
  trace <- sum(mass * of$second[1:3])
  if (!is.finite(mass + trace) || (amount$value > 0 && trace < .Machine$double.xmin)) {
    abort_rotdyn(c(
      "The mass or the second moment exceeds double precision.",
      x = "Mass {format(mass)} kg, trace of the second moment {format(trace)} kg m^2.",
      i = "Use other units of mass or length, as if they were kg and m."
    ), "range", call)
  }
  side <- of$hi - of$lo
  new_body(
    name, mass, mass * of$second, of$centre,
    size_m = c(length_x_m = side[1], length_y_m = side[2], length_z_m = side[3]),
    reach_m = of$reach,
    formula = switch(method,
      shell = "sum of |n| (s s' + a a' + b b' + c c')/24, the surface",
      box = "m l^2 / 12, the box of the mesh",
      hull = "sum of d (s s' + a a' + b b' + c c')/120, the convex hull",
      "sum of d (s s' + a a' + b b' + c c')/120"
    ),
    source = if (is.null(read$file)) "the mesh given" else basename(read$file),
    provenance = "mesh",
    detail = mesh_detail(of, read, found, check, method),
    error = error
  )
}

mesh_detail <- function(of, read, found, check, method) {
  counts <- found$counts
  failed <- check$verdict == "fails"
  size <- abs(of$size)
  list(
    method = method,
    vertices = counts[["vertices"]],
    faces = if (is.null(of$faces)) counts[["faces"]] else of$faces,
    parts = counts[["components"]],
    part_volume_m3 = if (is.null(found$volume)) NULL else found$volume * read$factor^3,
    flipped = method == "solid" && of$size < 0,
    volume_m3 = if (of$dimension == 3) size else NA_real_,
    area_m2 = of$area,
    volume_error = if (of$dimension == 3) of$size_error else NA_real_,
    coordinate_error = of$coordinate_error,
    closure = of$closure,
    weld_m = found$distance * read$factor,
    reader = read$reader,
    defects = stats::setNames(check$count[failed], mesh_conditions$key[failed]),
    check = check,
    # For its picture; no copy is made.
    mesh = c(read[c("vertices", "faces", "by_column", "factor")], found["same"])
  )
}

# ---- print --------------------------------------------------------------------------------------

#' @export
print.rot_mesh_check <- function(x, ...) {
  # Unless rows or columns were removed.
  columns <- c("condition", "count", "verdict", "meaning")
  if (!all(columns %in% names(x)) || !identical(x$condition, mesh_conditions$condition)) {
    return(NextMethod())
  }
  failed <- sum(x$verdict == "fails")
  say("<rot_mesh_check> ", if (failed) {
    paste0("not a solid: ", failed, " condition", if (failed == 1L) " fails" else "s fail")
  } else {
    "bounds a solid"
  }, "\n")
  told <- x[x$verdict %in% c("fails", "note"), columns]
  verdict <- ifelse(told$verdict == "fails", "FAILS", told$verdict)
  labels <- paste0("  ", format(verdict), "  ", format(told$condition), "  ")
  text <- paste0(format_si(told$count), ": ", told$meaning)
  for (i in seq_len(nrow(told))) {
    indent <- nchar(labels[i])
    lines <- strwrap(text[i], max(print_width() - indent, 16L), exdent = 2L)
    say(paste0(c(labels[i], rep(strrep(" ", indent), length(lines) - 1L)), lines), sep = "\n")
  }
  for (verdict in c("holds", "not checked")) {
    rest <- paste(x$condition[x$verdict == verdict], collapse = ", ")
    if (nzchar(rest)) {
      say(
        strwrap(paste0(verdict, ": ", rest), print_width() + 1L, indent = 2L, exdent = 4L),
        sep = "\n"
      )
    }
  }
  invisible(x)
}

# For the help page: the dictionary has the word of an audit.
check_verdict <- c(
  verdict = "\"holds\", \"fails\", \"note\" (legal, of interest) or \"not checked\""
)
