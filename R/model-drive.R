# Models of a drive.

# The R functions of a scene as the core calls them: list(law, stops) or NULL for each rotor, brake
# and coupling. NULL where there are none.
drive_calls <- function(scene, span, call) {
  one <- function(part) {
    law <- part$loads$law
    if (is.null(law)) return(NULL)
    reader <- law_reader(law, part, call)
    seen <- law_breaks(law, reader$at, span[1], span[2], call, resolution_of(scene))
    list(law = reader$own, stops = seen$stops)
  }
  calls <- list(
    rotors = lapply(scene$rotors, one),
    brakes = lapply(scene$rotors, function(rotor) one(rotor$brake)),
    couplings = lapply(scene$couplings, function(coupling) one(coupling$grip))
  )
  if (all(vapply(unlist(calls, recursive = FALSE), is.null, NA))) return(NULL)
  calls
}

integrate_drive <- function(scene, time_s, accuracy, max_steps, call, method) {
  called <- drive_calls(scene, range(scene$start_s, time_s), call)
  result <- .Call(
    ffi_drive_integrate, scene, called, time_s,
    c(accuracy, max_steps, method, resolution_of(scene)),
    progress_bar("integrating")
  )
  n <- length(scene$rotors)
  result$columns <- c(
    list(time_s = rep(time_s, each = n), rotor = rep.int(seq_len(n), length(time_s))),
    result$columns
  )
  result$events <- list(
    time_s = as.double(result$events$time_s), event = as.character(result$events$event),
    where = places_in_words(result$ledger$places)
  )
  sums <- result$ledger
  errors <- rep(sums$errors, each = length(time_s))
  dim(errors) <- c(length(time_s), 4L)
  colnames(errors) <- c("work_error_j", "heat_error_j", "impulse_error_n_m_s", "twist_error_rad")
  sums <- sums[!names(sums) %in% c("errors", "places")]
  result$ledger <- cbind(do.call(cbind, c(list(time_s = time_s), sums)), errors)
  if (!is.null(called)) result$info$resolution <- resolution_of(scene)
  result
}

places_in_words <- function(place) {
  paste(ifelse(place > 0, "rotor", "coupling"), abs(place), recycle0 = TRUE)
}

drive_integrator <- function(id, method, ...) {
  list(
    id = id,
    equations = "J omega' = torque + resistance + ratio T(before) - T(behind); stick and slip",
    assumptions = "rigid rotors; torques finite, and smooth between their breaks",
    requires = "any torque, any resistance",
    ...,
    adapts = TRUE,
    ran_as = function(info) {
      if (info$method %in% c("rk8pd", "radau")) paste0("drive_", info$method) else id
    },
    run = function(scene, time_s, accuracy, max_steps, call, asked) {
      integrate_drive(scene, time_s, accuracy, max_steps, call, if (asked) method else 0)
    },
    ledger = drive_ledger
  )
}

drive_ledger <- function(scene, run, from_s, to_s) {
  sums <- drive_sums(scene, run, c(from_s, to_s))
  if (is.null(sums)) return(c(work_j = NA_real_, dissipated_j = NA_real_))
  flow <- sums[2, ] - sums[1, ]
  c(flow["work_j"], dissipated_j = sum(flow[drive_heats(sums)]))
}

# The columns of a ledger that are heat; a ledger of version 0.5.0 has none of gears.
drive_heats <- function(sums) {
  intersect(c("resistance_j", "brake_j", "damper_j", "clutch_j", "mesh_j"), colnames(sums))
}

# The ledger since the start at these times (increasing), a row each: that of the run, or of another
# run. NULL where that failed.
drive_sums <- function(scene, run, time_s) {
  known <- run$ledger
  at <- if (is.null(known)) NA else match(time_s, known[, "time_s"])
  if (!anyNA(at)) return(known[at, , drop = FALSE])
  record <- record_of(run)
  if (!is.null(record$sums)) return(record$sums(scene, run, time_s))
  result <- record$run(
    scene, time_s, run$accuracy, run$max_steps + length(time_s), run$call, TRUE
  )
  if (result$info$kind == "none") result$ledger
}

drive_rk8pd <- drive_integrator(
  "drive_rk8pd", 1,
  limits = "not stiff: a step is at most about 6 times the shortest decay",
  source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library"
)

drive_radau <- drive_integrator(
  "drive_radau", 2,
  limits = "each step solves a system of equations: expensive for a motion that is not stiff",
  source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)"
)

