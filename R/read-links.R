# Robot descriptions (URDF, SDF): the inertia of every link, checked. The tensor is about the centre
# of mass, in a frame of its own, with negative products off the diagonal.

link_columns <- c(
  "link", "mass_kg", "centre_x_m", "centre_y_m", "centre_z_m", "reach_m", "verdict", "fault",
  "suggestion", "body", "check"
)

#' The links of a robot description, checked
#'
#' Reads the mass, the centre of mass and the inertia of every link of a URDF or SDF file, checks
#' each with [check_inertia()], and makes bodies of those that are physical. Simulators accept
#' tensors that are not physical and may fail later for other apparent reasons.
#'
#' The inertia is about the centre of mass, in the axes of `<inertial><origin>` (SDF: `<pose>`):
#' fixed-axis roll, pitch and yaw, R = Rz(yaw) Ry(pitch) Rx(roll). The bodies are in the link's own
#' frame: I_link = R I R'.
#'
#' If the visual and collision geometry of a link consists of boxes, cylinders, capsules and
#' spheres, `reach_m` is its largest distance from the centre of mass, and the radius of gyration is
#' checked against it. With a mesh, or a pose in another frame, `reach_m` is unknown and not
#' checked.
#'
#' `verdict` is the worst of the link's conditions: "holds", "holds within rounding", "fails", or
#' "no inertia" for a link without `<inertial>` (a frame). A link that fails only by its size has a
#' body, since its tensor is physical, though not for this geometry.
#'
#' @param file A URDF or SDF file, XML text (beginning with `<`), or an `xml_document` of xml2. A
#'   xacro file must be expanded first: `xacro robot.urdf.xacro > robot.urdf`.
#' @param ... Not used.
#' @return A tibble, one row for each link:
#'   `r describe_columns(link_columns)`
#'   In an SDF file with several models, links are named `model::link`, with several worlds
#'   `world::model::link`.
#' @section Errors: `rotdyn_error_package` without the package xml2; `rotdyn_error_file` for a file
#'   that is missing, not XML, not a robot description, contains xacro, no link, or two links of one
#'   name, and for a link (named in the message) with missing or repeated elements;
#'   `rotdyn_error_value` for text that is not a number, and a pose that is not finite;
#'   `rotdyn_error_unit` for a unit, which the format does not have; `rotdyn_error_type` for other
#'   types. A mass or a tensor that is not finite or not physical is no error: it is reported in
#'   `verdict`, `fault` and `suggestion`.
#' @source URDF: the XML specification of the `urdf` package of ROS. SDF: sdformat.org, version
#'   1.11.
#' @seealso [check_inertia()], [inertia_repairs()].
#' @concept robot
#' @concept URDF
#' @examples
#' file <- system.file("extdata", "arm.urdf", package = "rotdyn")
#' if (requireNamespace("xml2", quietly = TRUE)) {
#'   links <- read_links(file)
#'   print(links[c("link", "mass_kg", "verdict", "suggestion")])
#'   # The check of the link that fails.
#'   print(links$check[[match("fails", links$verdict)]])
#' }
#' @export
read_links <- function(file, ...) {
  call <- check_no_dots(...)
  check_supplied("file", call)
  need_package("xml2", "Reading a robot description", call)
  root <- description_root(file, call)
  check_expanded(root, call)
  links <- switch(xml2::xml_name(root),
    robot = lapply(children(root, "link"), urdf_link, call = call),
    sdf_links(root, call)
  )
  if (!length(links)) abort_rotdyn("{.arg file} describes no link.", "file", call)
  check_unique(vapply(links, `[[`, "", "name"), call)
  links_table(links, call)
}

# Unexpanded macros would leave links incomplete.
check_expanded <- function(root, call) {
  left <- xml2::xml_find_first(root, "//*[starts-with(name(), 'xacro:')]")
  if (!is.na(left)) {
    abort_rotdyn(c(
      "{.arg file} must be a description without xacro.",
      x = "It has {.code <{xml2::xml_name(left, xml2::xml_ns(root))}>}.",
      i = xacro_remedy
    ), "file", call)
  }
}

xacro_remedy <- "This is xacro: expand it first, {.code xacro robot.urdf.xacro > robot.urdf}."

check_unique <- function(names, call) {
  twice <- unique(names[duplicated(names)])
  if (length(twice)) {
    abort_rotdyn(
      c("Names of links must be unique.", x = "More than one link is named {.val {twice}}."),
      "file", call
    )
  }
}

# ---- the document ---------------------------------------------------------------------------

description_root <- function(file, call) {
  if (inherits(file, "xml_document")) {
    root <- xml2::xml_root(file)
  } else {
    root <- xml2::xml_root(parse_description(file, call))
  }
  name <- xml2::xml_name(root)
  # Without the prefix of a namespace.
  if (!sub("^.*:", "", name) %in% c("robot", "sdf", "gazebo")) {
    abort_rotdyn(c(
      "{.arg file} must be a URDF or SDF description.",
      x = "Its root is {.code <{name}>}, not {.code <robot>} or {.code <sdf>}."
    ), "file", call)
  }
  root
}

parse_description <- function(file, call) {
  if (!is.character(file) || length(file) != 1L || is.na(file)) {
    abort_rotdyn(c(
      "{.arg file} must be a path, XML text or an {.cls xml_document}.",
      x = "It is {describe_value(file)}."
    ), "type", call)
  }
  if (!is_readable_text(file)) abort_unreadable(file, "file", call)
  if (!grepl("^[[:space:]\ufeff]*<", file)) {
    if (!file.exists(file) || dir.exists(file)) {
      abort_rotdyn(c(
        "{.arg file} must be a file, or XML text.",
        x = "There is no file {.file {file}}.",
        i = if (grepl("^[a-z]+://", file)) "Download it first."
      ), "file", call)
    }
    # As bytes: the parser leaves a file that it opened open after an error.
    text <- tryCatch(
      suppressWarnings(readBin(file, "raw", file.size(file))),
      error = function(e) abort_rotdyn("{.file {file}} cannot be read.", "file", call)
    )
    encoding <- ""
  } else {
    # Text in R is UTF-8, regardless of its XML declaration.
    text <- charToRaw(enc2utf8(sub("^[[:space:]\ufeff]+", "", file)))
    encoding <- "UTF-8"
  }
  tryCatch(
    # Older files have undeclared prefixes, of which the parser warns.
    suppressWarnings(xml2::read_xml(text, encoding = encoding)),
    error = function(e) {
      reason <- gsub("\\s+", " ", encodeString(conditionMessage(e)))
      abort_rotdyn(
        c("{.arg file} must be well-formed XML.", x = "The parser reports: {reason}"), "file", call
      )
    }
  )
}

# Children by local name, since some files declare a default namespace.
children <- function(node, name) {
  as.list(xml2::xml_find_all(node, paste0("./*[local-name()='", name, "']")))
}

child <- function(node, name) {
  found <- children(node, name)
  if (length(found)) found[[1L]]
}

# An element that may occur at most once; NULL if missing.
only_child <- function(node, name, link, call) {
  found <- children(node, name)
  if (length(found) > 1L) {
    abort_rotdyn(c(
      "Link {.val {link}} must have one {.code <{name}>}.",
      x = "Its {.code <{xml2::xml_name(node)}>} has {length(found)}."
    ), "file", call)
  }
  if (length(found)) found[[1L]]
}

numbers_of <- function(text, n, what, link, call) {
  words <- strsplit(trimws(text), "[[:space:]]+")[[1L]]
  # R in a Turkish locale does not know "inf".
  plain <- sub("^([-+]?)[iI][nN][fF]([iI][nN][iI][tT][yY])?$", "\\1Inf", words)
  values <- suppressWarnings(as.numeric(plain))
  # as.numeric() reads NA as missing without a warning.
  bad <- is.na(values) & !is.nan(values)
  if (any(bad)) {
    word <- words[bad][1L]
    abort_rotdyn(c(
      "{what} of link {.val {link}} must be {cli::qty(n)}{?a number/numbers}.",
      x = "It is {.val {text}}.",
      i = if (grepl("$", text, fixed = TRUE)) {
        xacro_remedy
      } else if (grepl("^[-+0-9.]*,[0-9]+$", word)) {
        "Decimals are written with a point."
      }
    ), "value", call)
  }
  if (length(values) != n) {
    abort_rotdyn(c(
      "{what} of link {.val {link}} must be {n} number{?s}.",
      x = "It has {length(values)}: {.val {text}}."
    ), "value", call)
  }
  values
}

finite_numbers <- function(text, n, what, link, call) {
  values <- numbers_of(text, n, what, link, call)
  if (!all(is.finite(values))) {
    abort_rotdyn(
      c("{what} of link {.val {link}} must be finite.", x = "It is {.val {text}}."), "value", call
    )
  }
  values
}

# `why`: URDF requires it; SDF has defaults of 1, or uses the inertia of the shape.
abort_lacking <- function(what, link, call, why = "The format requires it in {.code <inertial>}.") {
  abort_rotdyn(c(
    "Link {.val {link}} has no {.code {what}}.",
    i = paste(why, "A frame without mass has no {.code <inertial>}.")
  ), "file", call)
}

link_name <- function(node, number, call) {
  name <- xml2::xml_attr(node, "name")
  if (is.na(name) || !nzchar(name)) {
    abort_rotdyn(c("Every link must have a name.", x = "Link {number} has none."), "file", call)
  }
  name
}

# R = Rz(yaw) Ry(pitch) Rx(roll).
rotation_rpy <- function(rpy) {
  co <- cos(rpy)
  si <- sin(rpy)
  matrix(
    c(
      co[3] * co[2], si[3] * co[2], -si[2],
      co[3] * si[2] * si[1] - si[3] * co[1], si[3] * si[2] * si[1] + co[3] * co[1], co[2] * si[1],
      co[3] * si[2] * co[1] + si[3] * si[1], si[3] * si[2] * co[1] - co[3] * si[1], co[2] * co[1]
    ),
    3L
  )
}

# ---- URDF -----------------------------------------------------------------------------------

urdf_link <- function(node, call) {
  number <- length(xml2::xml_find_all(node, "preceding-sibling::*[local-name()='link']")) + 1L
  link <- list(name = link_name(node, number, call))
  inertial <- only_child(node, "inertial", link$name, call)
  if (!is.null(inertial)) {
    link$pose <- urdf_pose(inertial, "<inertial>", link$name, call)
    mass <- only_child(inertial, "mass", link$name, call)
    link$mass_kg <- urdf_number(mass, "value", "mass", link$name, call)
    inertia <- only_child(inertial, "inertia", link$name, call)
    link$six <- vapply(inertia_entries, function(entry) {
      urdf_number(inertia, entry, "inertia", link$name, call)
    }, 0)
  }
  link$parts <- geometry_parts(node, link$name, call, urdf_pose, urdf_solid)
  link
}

urdf_number <- function(node, attribute, element, link, call) {
  text <- if (is.null(node)) NA_character_ else xml2::xml_attr(node, attribute)
  what <- paste0("<", element, " ", attribute, ">")
  if (is.na(text)) abort_lacking(what, link, call)
  unit <- c(xml2::xml_attr(node, "unit"), xml2::xml_attr(node, "units"))
  unit <- unit[!is.na(unit)]
  if (length(unit)) {
    abort_rotdyn(c(
      "{what} of link {.val {link}} must be in kg and m.",
      x = "Its unit is {.val {unit}}, and the format has no units."
    ), "unit", call)
  }
  numbers_of(text, 1L, what, link, call)
}

urdf_pose <- function(node, where, link, call) {
  origin <- only_child(node, "origin", link, call)
  read <- function(attribute) {
    text <- if (is.null(origin)) NA_character_ else xml2::xml_attr(origin, attribute)
    if (is.na(text)) return(c(0, 0, 0))
    finite_numbers(text, 3L, paste0("<origin ", attribute, "> in ", where), link, call)
  }
  list(at = read("xyz"), rpy = read("rpy"))
}

urdf_solid <- function(shape, kind, link, call) {
  read <- function(attribute, n = 1L) {
    text <- xml2::xml_attr(shape, attribute)
    what <- paste0("<", kind, " ", attribute, ">")
    if (is.na(text)) {
      abort_rotdyn(
        "Link {.val {link}} has a {.code <{kind}>} without {.code {attribute}}.", "file", call
      )
    }
    finite_numbers(text, n, what, link, call)
  }
  solid_of(kind, read)
}

# ---- SDF ------------------------------------------------------------------------------------

sdf_links <- function(root, call) {
  nodes <- as.list(xml2::xml_find_all(root, ".//*[local-name()='model']/*[local-name()='link']"))
  # Models and worlds are part of the name only if there are several.
  scopes <- Filter(
    function(scope) length(xml2::xml_find_all(root, paste0(".//*[", scope, "]"))) > 1L,
    c("local-name()='model'", "local-name()='world'")
  )
  lapply(seq_along(nodes), function(i) sdf_link(nodes[[i]], i, scopes, call))
}

sdf_link <- function(node, number, scopes, call) {
  name <- link_name(node, number, call)
  if (length(scopes)) {
    around <- paste0("ancestor::*[", paste(scopes, collapse = " or "), "]")
    around <- xml2::xml_attr(xml2::xml_find_all(node, around), "name")
    name <- paste(c(around, name), collapse = "::")
  }
  link <- list(name = name)
  inertial <- only_child(node, "inertial", name, call)
  if (!is.null(inertial)) {
    link$pose <- sdf_pose(inertial, "<inertial>", name, call)
    link$mass_kg <- sdf_number(inertial, "mass", NULL, name, call)
    inertia <- only_child(inertial, "inertia", name, call)
    if (is.null(inertia)) abort_lacking("<inertia>", name, call, sdf_default)
    # Missing products are 0.
    defaults <- list(NULL, NULL, NULL, 0, 0, 0)
    link$six <- mapply(
      function(entry, default) sdf_number(inertia, entry, default, name, call),
      inertia_entries, defaults
    )
  }
  link$parts <- geometry_parts(node, name, call, sdf_pose, sdf_solid)
  link
}

sdf_default <- "A simulator would use 1, or the shape's: write it in {.code <inertial>}."

sdf_number <- function(node, element, default, link, call) {
  found <- only_child(node, element, link, call)
  if (is.null(found)) {
    if (is.null(default)) abort_lacking(paste0("<", element, ">"), link, call, sdf_default)
    return(default)
  }
  numbers_of(xml2::xml_text(found), 1L, paste0("<", element, ">"), link, call)
}

sdf_pose <- function(node, where, link, call) {
  pose <- only_child(node, "pose", link, call)
  if (is.null(pose) || !nzchar(trimws(xml2::xml_text(pose)))) {
    return(list(at = c(0, 0, 0), rpy = c(0, 0, 0)))
  }
  what <- paste("<pose> in", where)
  format <- xml2::xml_attr(pose, "rotation_format")
  frame <- xml2::xml_attr(pose, "relative_to")
  if (!format %in% c(NA, "euler_rpy") || !frame %in% c(NA, "", sub("^.*::", "", link))) {
    # For visual and collision elements the reach is then unknown.
    if (where != "<inertial>") return(NULL)
    abort_rotdyn(c(
      "{what} of link {.val {link}} must be roll, pitch and yaw in the link's own frame.",
      x = if (format %in% c(NA, "euler_rpy")) {
        "It is relative to {.val {frame}}."
      } else {
        "Its rotation is given as {.val {format}}."
      }
    ), "file", call)
  }
  pose_numbers <- finite_numbers(xml2::xml_text(pose), 6L, what, link, call)
  degrees <- lower_case(xml2::xml_attr(pose, "degrees")) %in% c("true", "1")
  rpy <- pose_numbers[4:6]
  list(at = pose_numbers[1:3], rpy = if (degrees) rpy * pi / 180 else rpy)
}

sdf_solid <- function(shape, kind, link, call) {
  read <- function(element, n = 1L) {
    found <- child(shape, element)
    if (is.null(found)) {
      abort_rotdyn(
        "Link {.val {link}} has a {.code <{kind}>} without {.code <{element}>}.", "file", call
      )
    }
    finite_numbers(xml2::xml_text(found), n, paste0("<", element, "> in <", kind, ">"), link, call)
  }
  solid_of(kind, read)
}

# ---- reach of the geometry ------------------------------------------------------------------

# The solids of all visual and collision elements; NULL if one of them is a mesh or unknown, or in
# another frame.
geometry_parts <- function(node, link, call, read_pose, read_solid) {
  elements <- c(children(node, "visual"), children(node, "collision"))
  parts <- list()
  for (element in elements) {
    geometry <- child(element, "geometry")
    shape <- if (!is.null(geometry)) xml2::xml_children(geometry)
    kind <- if (length(shape)) xml2::xml_name(shape[[1L]]) else "none"
    if (!kind %in% c("box", "sphere", "cylinder", "capsule")) return(NULL)
    pose <- read_pose(element, paste0("<", xml2::xml_name(element), ">"), link, call)
    if (is.null(pose)) return(NULL)
    parts <- c(parts, list(c(pose, read_solid(shape[[1L]], kind, link, call))))
  }
  parts
}

# A solid as the Minkowski sum of a box (half edges), a disk (radius `round`) and a ball.
solid_of <- function(kind, read) {
  switch(kind,
    box = list(half = read("size", 3L) / 2, ball = 0),
    sphere = list(half = c(0, 0, 0), ball = read("radius")),
    cylinder = list(half = c(0, 0, read("length") / 2), round = read("radius"), ball = 0),
    capsule = list(half = c(0, 0, read("length") / 2), ball = read("radius"))
  )
}

# The distance of the farthest point of a solid from `centre`: at a corner of the box, or on a rim
# of a cylinder.
part_reach <- function(part, centre) {
  turn <- rotation_rpy(part$rpy)
  # The centre in the axes of the solid.
  from <- abs(as.double(crossprod(turn, centre - part$at)))
  if (!is.null(part$round)) {
    return(sqrt((sqrt(sum(from[1:2]^2)) + part$round)^2 + (from[3L] + part$half[3L])^2))
  }
  sqrt(sum((from + part$half)^2)) + part$ball
}

link_reach <- function(link) {
  if (!length(link$parts) || is.null(link$pose)) return(NA_real_)
  reach <- max(vapply(link$parts, part_reach, 0, centre = link$pose$at))
  # A shape without extent is a placeholder.
  if (reach > 0 && is.finite(reach)) reach else NA_real_
}

# ---- the table ------------------------------------------------------------------------------

links_table <- function(links, call) {
  rows <- lapply(links, link_row, call = call)
  column <- function(name, kind) vapply(rows, `[[`, kind, name)
  new_table(list(
    link = column("link", ""),
    mass_kg = column("mass_kg", 0),
    centre_x_m = vapply(rows, function(row) row$centre[1L], 0),
    centre_y_m = vapply(rows, function(row) row$centre[2L], 0),
    centre_z_m = vapply(rows, function(row) row$centre[3L], 0),
    reach_m = column("reach_m", 0),
    verdict = column("verdict", ""),
    fault = column("fault", ""),
    suggestion = column("suggestion", ""),
    body = lapply(rows, `[[`, "body"),
    check = lapply(rows, `[[`, "check")
  ), nrow = length(rows))
}

link_row <- function(link, call) {
  if (is.null(link$six)) {
    return(list(
      link = link$name, mass_kg = NA_real_, centre = rep(NA_real_, 3L), reach_m = NA_real_,
      verdict = "no inertia", fault = NA_character_, suggestion = NA_character_
    ))
  }
  reach <- link_reach(link)
  check <- check_tensors(
    list(tensor = list(six_to_tensor(link$six)), sign = 1), link$mass_kg, reach, link$name
  )
  failed <- check$condition[check$verdict == "fails"]
  given <- check$suggestion[!is.na(check$suggestion)]
  list(
    link = link$name,
    mass_kg = link$mass_kg,
    centre = link$pose$at,
    reach_m = reach,
    verdict = worst_verdict(check$verdict),
    fault = if (length(failed)) link_fault(check) else NA_character_,
    suggestion = c(given, NA_character_)[1L],
    # A tensor that the geometry is too small for: a body whose reach is unknown.
    body = if (!length(setdiff(failed, "size"))) {
      link_body(link, if ("size" %in% failed) NA_real_ else reach, call)
    },
    check = check
  )
}

worst_verdict <- function(verdict) {
  if ("fails" %in% verdict) {
    "fails"
  } else if ("holds within rounding" %in% verdict) {
    "holds within rounding"
  } else {
    "holds"
  }
}

link_fault <- function(check) {
  first <- check[check$verdict == "fails", ][1L, ]
  paste0(first$condition, ": ", first$meaning)
}

# The message about rounding is suppressed, since it is in the check.
link_body <- function(link, reach, call) {
  body <- withCallingHandlers(
    body_tensor(link$mass_kg, six_to_tensor(link$six), name = link$name),
    rotdyn_message_inertia = function(m) tryInvokeRestart("muffleMessage")
  )
  body$reach_m <- reach
  place_body(body, at_m = link$pose$at, rotation = rotation_rpy(link$pose$rpy))
}
