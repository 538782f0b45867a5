# The R functions among the inputs of a scene: how C calls them, and what is looked for in them
# before a run.

# The functions in an input, a part of it or a list of them, as C finds them.
functions_in <- function(x) {
  if (inherits(x, "rot_torque_function")) return(list(x$f))
  if (is.function(x)) return(list(x))
  if (!is.list(x) || inherits(x, "rot_body")) return(list())
  unlist(lapply(unclass(x), functions_in), recursive = FALSE, use.names = FALSE)
}

# What C calls for the functions among the inputs, in their order: f with so many arguments, or a
# complaint about what it returned.
table_laws <- function(scene, call) {
  if (!.Call(ffi_law_called, scene)) return(list()) # the rest takes 60 us
  inputs <- constraint_of(scene)$inputs
  laws <- function(x, name) {
    form <- inputs[[name]]$form
    if (form == "rates") return(list(rates_law(x, scene, call)))
    part <- c(rotors = "rotor", laws = "rotor", brakes = "rotor", couplings = "coupling")[form]
    motor <- form %in% c("rotors", "laws", "brakes", "couplings")
    unit <- if (motor) "N*m" else inputs[[name]]$unit
    arg <- switch(form,
      rotors = "torque_n_m", brakes = , couplings = "capacity_n_m", name
    )
    each <- function(x, of) {
      lapply(functions_in(x), function(f) {
        list(
          as.call(c(quote(f), rep(list(NULL), count_law_arguments(f, function(n) n)))),
          list2env(list(f = f), parent = baseenv()),
          function(value, time_s) {
            abort_law_value(value, time_s, arg, unit, call, of, if (form == "torques") 3 else 1)
          }
        )
      })
    }
    if (is.na(part)) return(each(x, ""))
    unlist(Map(each, x, paste0(" of ", part, " ", seq_along(x))), recursive = FALSE)
  }
  given <- unclass(scene)[intersect(names(inputs), names(scene))]
  Filter(length, Map(laws, given, names(given)))
}

# The scene with each torque function f(law, state, acts) in its place; `state`: the angle and rate
# at the start, by the names of scenes, of the rotor that it acts on; 0 for a clutch or brake, which
# does not act by itself.
map_torque_functions <- function(scene, f) {
  walk <- function(x, state, acts) {
    if (inherits(x, "rot_torque_function")) return(f(x, state, acts))
    if (!is.list(x) || inherits(x, "rot_body")) return(x)
    for (i in which(!vapply(x, is.null, NA))) x[[i]] <- walk(.subset2(x, i), state, acts)
    x
  }
  inputs <- constraint_of(scene)$inputs
  for (name in names(inputs)) {
    form <- inputs[[name]]$form
    x <- .subset2(scene, name)
    if (form == "torque" && !is.null(x)) {
      state <- unclass(scene)[c("theta0_rad", "omega0_rad_per_s", "start_s")]
      scene[[name]] <- walk(x, state, TRUE)
    } else if (form %in% c("laws", "brakes", "couplings")) {
      for (i in which(!vapply(x, is.null, NA))) {
        acts <- form == "laws"
        state <- list(
          theta0_rad = if (acts) scene$theta0_rad[i] else 0,
          omega0_rad_per_s = if (acts) scene$omega0_rad_per_s[i] else 0, start_s = scene$start_s
        )
        scene[[name]][[i]] <- walk(x[[i]], state, acts)
      }
    }
  }
  scene
}

# A law that needs more is called: a run takes 2,000 to 10,000 calls.
few_samples <- 5000L

# A scene whose functions of time are sampled, so that a run does not call them, or have their
# breaks: those given, or those that are found. The samples are as good as an integrator can be
# asked for.
with_found_breaks <- function(scene, span, call) {
  resolution <- resolution_of(scene)
  scene <- map_torque_functions(scene, function(law, state, acts) {
    reader <- law_reader(law, state, call)
    seen <- law_breaks(law, reader$at, span[1], span[2], call, resolution)
    sampled <- if (acts && law$arguments == 1L) {
      sample_and_compare(reader, resolution, span, seen, 1e-13, few_samples)
    }
    if (!is.null(sampled)) return(sampled_law(sampled))
    law$breaks_s <- seen$stops
    law
  })
  inputs <- constraint_of(scene)$inputs
  breaks <- names(Filter(function(one) one$form == "sorted", inputs))
  for (name in names(inputs)) {
    f <- .subset2(scene, name)
    if (!is.function(f) || inputs[[name]]$form == "rates") next
    stops <- as.double(.subset2(scene, breaks))
    sampled <- sample_function(f, name, inputs[[name]], stops, resolution, span, call)
    if (is.null(sampled)) next
    scene[[name]] <- structure(
      list(terms = sampled$terms, noise = sampled$error), class = "rot_samples"
    )
    # Neighbours differ by rounding where they meet.
    scene[[breaks]] <- sort(unique(c(stops, sampled$terms[[1]]$breaks_s)))
  }
  scene
}

# A function among the inputs, sampled where it is one of time alone; else NULL.
sample_function <- function(f, name, input, stops, resolution, span, call) {
  values <- if (input$form == "torques") 3L else 1L
  if (count_law_arguments(f, function(n) n) != 1L) return(NULL)
  at <- function(time_s) {
    value <- vapply(time_s, function(t) {
      x <- f(t)
      if (length(x) == values && (is.numeric(x) || is.logical(x)) && !is.object(x)) {
        as.double(x)
      } else {
        abort_law_value(x, t, name, input$unit, call, values = values)
      }
    }, double(values))
    matrix(value, length(time_s), values, byrow = TRUE)
  }
  if (span[2] > span[1]) check_repeats(at, span[1], span[2], call)
  sample_and_compare(list(at = at), resolution, span, list(stops = stops), 1e-13, few_samples)
}

# Calls all torque functions once, at the start; NULL where there are none.
call_table_laws <- function(scene, call) {
  readers <- list()
  map_torque_functions(scene, function(law, state, acts) {
    readers[[length(readers) + 1L]] <<- law_reader(law, state, call)
    law
  })
  if (length(readers)) function() for (reader in readers) reader$at(scene$start_s)
}

abort_law_value <- function(value, time_s, name, unit, call, of = "", values = 1) {
  abort_rotdyn(c(
    "The function {.arg {name}}{of} must return {c('one number', 'three numbers')[1 + (values > 1)]}
     in {plain_unit(unit)}.",
    x = "At {format(time_s, digits = 17)} s it returned {describe_value(value)}."
  ), "torque", call)
}
