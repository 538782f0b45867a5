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
  result <- drive_result(result, scene, time_s)
  if (!is.null(called)) result$info$resolution <- resolution_of(scene)
  result
}

# What C returns as a run has it: rows in long form, events with their places, the ledger a matrix.
drive_result <- function(result, scene, time_s) {
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
  flows <- core_table("drive")$flows
  errors <- rep(sums$errors, each = length(time_s))
  dim(errors) <- c(length(time_s), length(flows))
  colnames(errors) <- paste0(flows, "_error")
  result$ledger <- cbind(do.call(cbind, c(list(time_s = time_s), sums[flows])), errors)
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
    run = function(scene, time_s, accuracy, max_steps, call, asked, flows = TRUE) {
      integrate_drive(scene, time_s, accuracy, max_steps, call, if (asked) method else 0)
    }
  )
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

# ---- closed forms -------------------------------------------------------------------------------

# `form`: the place in src/core/scene/drive/exact.h. The ledger takes a quadrature of the motion, so
# it is made where it is asked for.
drive_exact <- function(id, form, ...) {
  list(
    id = id, ...,
    run = function(scene, time_s, accuracy, max_steps, call, asked, flows = FALSE) {
      result <- .Call(
        ffi_drive_exact, scene, form, time_s, as.double(flows), progress_bar("closed form")
      )
      result <- drive_result(result, scene, time_s)
      if (!flows) result$ledger <- NULL
      result
    }
  )
}

drive_axle <- drive_exact(
  "drive_axle", 0,
  equations = "sum(J/P^2) omega' = sum(tau/P) - sum(c/P^2) omega, at the first shaft",
  assumptions = "rigid gears without backlash",
  limits = "those of the axle's closed forms",
  requires = "gears alone; torques of time, motors; viscous resistance or none",
  source = "the axle's closed forms; Shigley 2004, section 16-7"
)

drive_clutch <- drive_exact(
  "drive_clutch", 1,
  equations = "J1 omega1' = tau1 - T, J2 omega2' = tau2 + T at the first shaft, gears in J and tau",
  assumptions = "rigid gears; capacity constant; torques constant between jumps",
  limits = "not before the start; where a torque equals the static capacity, rounding decides",
  requires = "one clutch of constant capacity; constant or stepped torques; no resistance",
  source = "closed form between exact events; Shigley 2004, chapter 16"
)

drive_modal <- drive_exact(
  "drive_modal", 2,
  loses = "Stiff springs turn through many radians of phase, and large terms may cancel.",
  equations = "J x'' + C x' + K x = tau at the first shaft, mean motion and twists in modes",
  assumptions = "rigid gears, linear springs and dampers, constant torques",
  limits = "constant torques; the error grows with the phase where rotors are damped unevenly",
  requires = "shafts and gears; constant torques; viscous resistance or none",
  source = "Meirovitch 2001, chapter 7; Higham 2005 (exponential of a matrix)"
)
