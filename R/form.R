# What an object consists of. A form is a word, or a list of forms by the names of the parts. C
# checks it (src/glue/form.c) in two microseconds, at the start of every verb that takes an object:
# one that was edited, invalid or kept from another version is reported there and nowhere else.
#
# Words: number, numbers (finite), limit, limits (may be infinite), values (any), sorted (finite,
# not decreasing), count, text, texts, flag, flags, function, list, term (that the core may read).
# After a word: ":3" three of them, "=time_s" as many as the part of that name has, "=time_s-1" one
# less, "?" or NULL.
# In a list: .class of the object, .is (a word that it fits), .each (of its elements), .one_of
# (forms), .optional (may be NULL).

knots_form <- list(
  .class = "rot_torque_knots", time_s = "sorted", torque_n_m = "numbers=time_s",
  outside = "numbers:2"
)

term_form <- list(
  .class = "rot_torque_term", .is = "term", from_s = "limit", to_s = "limit", breaks_s = "numbers",
  text = "text", parts = "numbers?"
)

law_form <- list(
  .class = "rot_torque_function", f = "function", breaks_s = "numbers?", arguments = "count",
  vectorised = "flag"
)

motor_form <- list(
  .class = "rot_torque_motor", stall_torque_n_m = "number", no_load_omega_rad_per_s = "number"
)

single_torque <- list(.one_of = list(knots_form, term_form, law_form, motor_form))

torque_form <- list(.one_of = list(
  knots_form, term_form, law_form, motor_form,
  list(.class = "rot_torque_sum", laws = list(.each = single_torque))
))

resistance_form <- list(
  .class = "rot_resistance", viscous_n_m_s = "number", quadratic_n_m_s2 = "number",
  coulomb_n_m = "number", static_n_m = "number", damping_per_s = "number",
  drag_n_s_per_m = "number", drag_n_s2_per_m2 = "number"
)

inertia_knots_form <- list(
  .class = "rot_inertia_knots", time_s = "sorted", moment_of_inertia_kg_m2 = "numbers=time_s"
)

body_form <- list(
  .class = "rot_body", shape = "text", mass_kg = "number", size_m = "numbers",
  centre_m = "numbers:3", second_moment_kg_m2 = "numbers:9", inertia_kg_m2 = "numbers:9",
  point = "text", axes = "text", reach_m = "values:1", beta = "values:1", formula = "text",
  source = "text", provenance = "text",
  detail = list(.is = "list", centre_error_m = "values:1?"), error = "values:1", error_kind = "text"
)

domain_form <- list(
  .class = "rot_domain", kind = "text", size_m = "numbers", centre_m = "numbers:3",
  chart = "numbers:10", periodic = "flags:3", parameter = "numbers?", map = "function?",
  jacobian = "function?", inside = "function?"
)

friction_parts <- list(
  capacity_n_m = torque_form, static_ratio = "number", from_s = "limit", to_s = "limit"
)

brake_form <- c(list(.class = "rot_brake"), friction_parts)

# Without a torque its motor keeps its speed.
rotor_form <- list(
  .class = "rot_rotor", axis = "numbers:3", moment_of_inertia_kg_m2 = "number",
  omega_rad_per_s = "number", torque = list(.optional = TRUE, .one_of = list(
    "number", "function", list(time_s = "sorted", torque_n_m = "numbers=time_s")
  )), breaks_s = "sorted"
)

# Three numbers, a list of columns, or a function.
torques_form <- list(.one_of = list("numbers:3", "function", list(
  time_s = "sorted", x_n_m = "numbers=time_s", y_n_m = "numbers=time_s", z_n_m = "numbers=time_s"
)))

# A body, its principal moments, or these about axes of their own.
tensor_form <- list(.one_of = list(body_form, "numbers:3", list(
  .class = "rot_principal_moments", moment_of_inertia_kg_m2 = "numbers:3", axes = "numbers:4"
)))

coupling_form <- list(.one_of = list(
  list(
    .class = "rot_coupling_shaft", stiffness_n_m_per_rad = "number", damping_n_m_s = "number",
    ratio = "number"
  ),
  c(list(.class = "rot_coupling_clutch"), friction_parts, ratio = "number"),
  list(.class = "rot_coupling_gear", ratio = "number", efficiency = "number")
))

# The attributes of a matrix.
inertia_tensor_form <- list(
  about = "text", point_m = "numbers:3", rotation = "numbers:9", products = "text"
)

# A trajectory's attribute; its scenes have their own form.
run_form <- list(
  model = "text", accuracy = "number", error_kind = "text", ledger = "values?",
  max_steps = "number", scene = "list", solved = "list",
  info = list(
    kind = "text", error = "values:1", time_s = "values:1", errors = "values",
    sizes = "values=errors", step_s = "number?", resolution = "number?", lost = "flag?"
  ),
  body = list(.optional = TRUE, inertia = "values:1", effect = "values:1"),
  events = list(.optional = TRUE, time_s = "numbers", event = "texts=time_s"),
  dropped = list(
    .optional = TRUE, effects = "texts", until_s = "limit", errors = "values", each = "values"
  )
)

support_form <- list(
  .class = "rot_support", kind = "text", name = "text", at_m = "numbers", normal = "numbers",
  to_m = "numbers", friction = "limit", slides = "flag",
  assumed = "flag"
)

# The attribute of a static equilibrium.
rest_form <- list(
  reaction = "numbers", error = "values=reaction", determined = "flags=reaction",
  lowest = "values=reaction", highest = "values=reaction", sigma = "numbers",
  about_m = "numbers:3", velocity = "numbers:3", omega = "numbers:3", equations = "count",
  rank = "count", driven = "flag", rests = "flag", sticks = "flag", projected = "flag",
  residual_force = "values:1", residual_torque = "values:1", outline = "list", name = "text",
  structure = list(
    loads = "list", supports = list(.each = support_form), owner = "numbers=component",
    component = "texts", problem = list(
      plane = "number", at = "numbers", from = "numbers=at", to = "numbers=at",
      is_couple = "numbers", one_sided = "numbers=is_couple", first = "numbers",
      normal = "numbers", friction = "limits", load_at = "numbers", load_force = "numbers=load_at",
      load_couple = "numbers=load_at", rank_tolerance = "number"
    )
  )
)

curve_form <- list(
  .class = "rot_curve", x = "function", y = "function", dx = "function", dy = "function",
  ddx = "function", ddy = "function", kind = "text", knots = "sorted"
)

curve_run_form <- list(
  last = "list", min_normal = "values:1", needed = "values:1", error = "values:1",
  shape = "values", finest = "values:1", along = "text"
)

# `what`: the object in words.
check_form <- function(x, form, arg, what, call) {
  fault <- .Call(ffi_form_fault, x, form)
  if (!is.null(fault)) abort_form(fault, arg, what, call)
  x
}

abort_form <- function(part, arg, what, call) {
  abort_rotdyn(c(
    "{.arg {arg}} is not a valid {what} of this version of rotdyn.",
    x = if (nzchar(part)) "Its part {.field {part}} is missing or damaged." else
      "Its parts are missing or damaged.",
    i = "Make it again: its parts must not be edited, nor kept from another version."
  ), "type", call)
}

check_inertia_tensor <- function(x, arg, call) {
  fits <- is.double(x) && identical(dim(x), c(3L, 3L))
  fault <- if (fits) .Call(ffi_form_fault, attributes(x), inertia_tensor_form) else ""
  if (!is.null(fault)) abort_form(fault, arg, "inertia tensor", call)
  x
}

# The run of a trajectory, for the verbs.
check_trajectory <- function(x, arg, call) {
  run <- check_form(trajectory_run(x), run_form, arg, "trajectory", call)
  for (part in c("scene", "solved")) {
    if (is.null(fault_of_scene(run[[part]]))) next
    abort_form(part, arg, "trajectory", call)
  }
  constraint <- constraint_of(run$scene)
  known <- names(constraint$measures)
  if (!run$model %in% names(constraint$models)) abort_form("model", arg, "trajectory", call)
  if (!all(known %in% names(run$info$errors) & known %in% names(run$info$sizes))) {
    abort_form("info$errors", arg, "trajectory", call)
  }
  lost <- setdiff(constraint$keys, names(x))
  if (length(lost)) abort_form(lost[1], arg, "trajectory", call)
  run
}

# A scene from its constructor, whose arguments are sound: what follows from them may be beyond
# double precision.
sound_scene <- function(scene, call) {
  part <- fault_of_scene(scene)
  if (is.null(part)) return(scene)
  value <- tryCatch(
    format(scene[[strsplit(part, "[$[]")[[1]][1]]], digits = 3), error = function(e) NULL
  )
  abort_rotdyn(c(
    "The scene exceeds double precision.",
    x = "{.field {part}} follows from the arguments{if (length(value)) paste(' and is', value[1])}."
  ), "range", call)
}

# NULL, or the path of a part of a scene that does not fit its constraint.
fault_of_scene <- function(scene) {
  constraint <- if (inherits(scene, "rot_scene")) constraint_of(scene)
  if (is.null(constraint)) return("")
  fault <- .Call(ffi_scene_fault, constraint$id, constraint$form, scene)
  if (is.null(fault) && !is.null(constraint$fault)) constraint$fault(scene) else fault
}

check_scene <- function(scene, call) {
  constraint <- if (inherits(scene, "rot_scene")) constraint_of(scene)
  if (!is.null(constraint)) {
    fault <- fault_of_scene(scene)
    if (is.null(fault)) return()
    abort_form(fault, "scene", "scene", call)
  }
  check_class(scene, "rot_scene", "scene", "Describe one with {.fn scene_axle}.", call)
  abort_rotdyn("No constraint has scenes of class {.cls {class(scene)[1]}}.", "type", call)
}

# A scene of the constraint `id`.
check_scene_of <- function(scene, id, call, remedy = NULL) {
  wanted <- Filter(function(one) one$id == id, all_constraints())[[1L]]
  check_class(
    scene, wanted$scene_class, "scene",
    remedy %||% paste0("Describe one with {.fn ", names(wanted$texts)[1L], "}."), call
  )
  check_scene(scene, call)
}

trajectory_run <- function(x) attr(x, "run", exact = TRUE)
