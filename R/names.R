# Names that users mistype: the nearest known ones, and hints for other units.

# For each of `given` the most similar of `known`, where one is as similar as `least`. Of many, and
# of long ones, that takes long and helps nobody: ten of up to 100 characters are looked at.
near_names <- function(given, known, minimum = 0.5) {
  given <- given[!is.na(given) & nchar(given, "bytes") <= 100L]
  near <- lapply(utils::head(given, 10L), function(name) {
    score <- vapply(known, function(k) name_likeness(name, k), double(1))
    known[which.max(score)][max(score, 0) >= minimum]
  })
  unique(as.character(unlist(near)))
}

# Of names that a message lists: ten, the long ones cut.
some_names <- function(names) {
  long <- nchar(names, "bytes") > 100L
  names <- utils::head(names, 10L)
  ifelse(utils::head(long, 10L), paste0(substr(names, 1L, 60L), "..."), names)
}

# Words that say a unit: names are compared without them first.
unit_words <- c(
  "deg", "degree", "degrees", "rad", "rpm", "turns", "rev", "hz", "per", "s", "s2", "m", "mm", "cm",
  "kg", "kg2", "m2", "m3", "n", "nm", "j", "g"
)

# From 0 (nothing in common) to 1 (equal). The words of a name (`theta0`, `viscous`) count, its unit
# hardly; within a word a prefix (`visc`) counts as much as the word, else the share of its letters
# that need no edit.
name_likeness <- function(a, b) {
  if (identical(lower_case(a), lower_case(b))) return(1)
  wa <- name_words(a)
  wb <- name_words(b)
  if (!length(wa) || !length(wb)) return(0)
  pairs <- vapply(wa, function(x) max(vapply(wb, word_likeness, double(1), x)), double(1))
  back <- vapply(wb, function(x) max(vapply(wa, word_likeness, double(1), x)), double(1))
  # The order of the words of a name decides between equals.
  0.98 * (0.7 * mean(pairs) + 0.3 * mean(back)) + 0.01 * (word_likeness(wa[1], wb[1]))
}

name_words <- function(name) {
  words <- strsplit(gsub("[0-9]+", "", lower_case(name)), "[^a-z]+")[[1]]
  words <- words[nzchar(words)]
  bare <- setdiff(words, unit_words)
  if (length(bare)) bare else words
}

word_synonyms <- c(
  diameter = "radius", d = "radius", r = "radius", angle = "theta", speed = "omega",
  velocity = "omega", w = "omega", time = "time", times = "time", t = "time",
  mass = "mass", weight = "mass", friction = "coulomb", drag = "quadratic", damping = "viscous",
  height = "height", h = "height", slope = "incline", inertia = "moment", moi = "moment",
  torques = "torque", tau = "torque", rate = "omega", distance = "radius", distance = "lever",
  distance = "pivot", arm = "radius", speed = "v",
  velocity = "v", spin = "omega", omega = "spin", position = "place"
)

word_likeness <- function(a, b) {
  if (a == b) return(1)
  if (min(nchar(a), nchar(b)) >= 3L && (startsWith(a, b) || startsWith(b, a))) return(0.95)
  same <- function(x, y) y %in% word_synonyms[names(word_synonyms) == x]
  if (same(a, b) || same(b, a)) return(0.8)
  edits <- 1 - utils::adist(a, b)[1] / max(nchar(a), nchar(b))
  if (edits >= 0.6) edits else 0
}

# A column of numbers that no function reads, and that is nearly a known one which is not given: the
# user's own columns are kept, so it would be ignored in silence. `given`: known ones, as columns or
# as arguments.
check_near_columns <- function(data, known, given, kept, call) {
  # Names of the same words (x_1, x_2, ...) are alike to the same ones: the first is looked at.
  others <- Filter(function(name) is_number(data[[name]]), setdiff(names(data), c(known, kept)))
  words <- vapply(others, function(name) paste(name_words(name), collapse = " "), "")
  for (name in others[!duplicated(words)]) {
    near <- setdiff(near_names(name, known, 0.6), given)
    if (length(near)) {
      abort_rotdyn(c(
        "The table has an unknown column {.field {name}}.",
        x = "It would be ignored. Did you mean {.field {near}}?",
        unit_hints(name, angles = !endsWith(near, "_deg")),
        i = "For another quantity, take a name that is less similar."
      ), "argument", call)
    }
  }
}

# What converts a quantity whose name has another unit, or is a diameter.
unit_hints <- function(names, angles = TRUE) {
  words <- unlist(strsplit(lower_case(names), "[^a-z]+"))
  hints <- c(
    if (angles && any(c("deg", "degree", "degrees") %in% words)) {
      "Angles are in rad: {.code convert_angle(x, \"degree\", \"rad\")} converts degrees."
    },
    if ("rpm" %in% words) {
      "Speeds are in rad/s: {.code convert_angle(x, \"rpm\", \"rad/s\")} converts rpm."
    },
    if (any(c("turn", "turns", "rev", "revs", "revolutions") %in% words)) {
      "Angles are in rad: {.code convert_angle(x, \"turn\", \"rad\")} converts turns."
    },
    if ("hz" %in% words) "Rates are in rad/s: 2 pi times the frequency in Hz.",
    if (any(c("diameter", "d") %in% words)) "A radius is half the diameter.",
    if (any(c("cm", "mm", "g", "ft", "lb", "inch") %in% words)) {
      "Quantities are in SI units, or {.pkg units} objects: {.code units::set_units(25, \"cm\")}."
    }
  )
  if (length(hints)) stats::setNames(hints, rep("i", length(hints)))
}

# What an unknown argument of a function is asked of another one for; both are patterns.
asked_elsewhere <- list(
  list("spin_up", "^(omega|alpha)_", paste(
    "{.fn angular_motion} finds the angular acceleration from two angular velocities and the time;",
    "the torque is the moment of inertia times it."
  )),
  list("energy_partition", "^(omega|moment)_", paste(
    "{.fn kinetic_energy} takes the angular velocity of a body that need not roll."
  )),
  list("angular_momentum_of", "^mass", "{.arg body} takes the mass in kg, or a body."),
  list("precession_table", "^(mass|moment|precession)_", paste(
    "Without a body these are columns of a data frame: {.code precession_table(data.frame(mass_kg",
    "= , moment_of_inertia_kg_m2 = , spin_rad_per_s = , lever_arm_m = ))}."
  )),
  list("scene_incline", "^(friction|mu)", paste(
    "A body that slides at first has {.code omega0_rad_per_s = 0}; where it is not given, it rolls",
    "from the start."
  )),
  list("body_points", "^[xyz]_m$", paste(
    "Coordinates are columns of a table: {.code body_points(data.frame(mass_kg = , x_m = , y_m =",
    "0))}."
  )),
  list("angular_impulse", "^time", "The times are {.arg from_s} and {.arg to_s}."),
  list("scene_pivot", "^(distance|lever|arm|radius)", paste(
    "{.arg pivot_m} is where the body is held, in its own axes: {.code pivot_m = c(0, 0, -0.1)} on",
    "the axis of a disk, 0.1 m below its centre."
  )),
  # What acts where a scene does not take it.
  list("scene_hanging_mass", "^torque", paste(
    "The weights turn the pulley. With another torque, too, it is {.code scene_axle(torque = )}:",
    "the masses add m r^2 to the moment of inertia."
  )),
  list("scene_chain", "^torque", "One link under a torque is {.code scene_pendulum(torque = )}."),
  list("scene_incline", "^torque", paste(
    "What pushes the body along the slope is {.arg force}; a body on an axle is a {.fn scene_axle}."
  )),
  list(c(
    "scene_axle", "scene_pendulum", "scene_hanging_mass", "scene_rotors", "scene_gears",
    "scene_clutch", "scene_drive", "scene_free", "scene_pivot"
  ), "^force", "A force at a distance is a torque: {.fn torque_of_force}."),
  list("scene_[a-z_]+", "^torque", paste(
    "A {.arg torque} acts in {.fn scene_axle} and other scenes of bodies on axles, in",
    "{.fn scene_free} and {.fn scene_pivot}."
  )),
  list("scene_[a-z_]+", "^brake", paste(
    "A {.fn brake} acts in {.fn scene_axle}, {.fn scene_rotors}, {.fn scene_gears},",
    "{.fn scene_clutch} and {.fn scene_drive}."
  )),
  list(c("scene_pendulum", "scene_hanging_mass"), "^brake",
       "Dry friction that always acts is {.code resistance(coulomb_n_m = )}."),
  list(c("scene_free", "scene_pivot"), "^brake", paste(
    "What slows the body down is {.code resistance(damping_per_s = )}, or a {.arg torque} that is",
    "a function."
  ))
)

# `fn`: the name of the function; `names`: its unknown arguments.
elsewhere_hints <- function(fn, names) {
  called <- function(patterns) {
    is.character(fn) && grepl(paste0("^(", paste(patterns, collapse = "|"), ")$"), fn)
  }
  hints <- Filter(function(one) called(one[[1]]) && any(grepl(one[[2]], names)),
                  asked_elsewhere)
  said <- vapply(hints, `[[`, "", 3L)
  if (length(said)) stats::setNames(said, rep("i", length(said)))
}

# What to give for a required argument that is missing.
missing_hints <- c(
  axis = "Give {.or {.val {c('x', 'y', 'z')}}}, or three numbers.",
  centre_m = "It is 0 for a body whose axle passes through its centre of mass.",
  omega_2_rad_per_s = "It is 0 for a body at rest."
)
