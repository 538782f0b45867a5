# Scenes of masses that hang from a pulley: what they change in the record of R/constraint-axle.R.

hanging_maker <- function() {
  list(
    title = function(run) sentence(hanging_title(run$scene)),
    quick = FALSE,
    torque = function(scene) {
      difference <- scene$mass_kg - scene$counter_mass_kg
      torque_constant(
        .Call(ffi_sum_product, 0, c(difference, scene$gravity_m_per_s2, scene$radius_m))[1]
      )
    },
    ends = slack_rope,
    # The net torque is that on the pulley alone, and 0 where it has no inertia.
    slopes = function(columns, scene) {
      slopes <- axle_slopes(columns, scene, columns$alpha_rad_per_s2)
      c(hanging_slopes(columns, scene), slopes)
    },
    drawing = draw_hanging,
    frames = hanging_frames
  )
}

# What has the sign of the slope of these columns.
hanging_slopes <- function(columns, scene) {
  omega <- columns$omega_rad_per_s
  up <- function(i) {
    side <- c(-1, 1)[i]
    falls <- side * omega * sign(scene$gravity_m_per_s2)
    list(side * omega, columns$alpha_rad_per_s2 * omega, falls)
  }
  masses <- 1L + (scene$counter_mass_kg > 0)
  names <- hanging_names_of(masses)
  slopes <- unlist(lapply(seq_len(masses), up), recursive = FALSE)
  stats::setNames(slopes, names[!grepl("^(alpha|tension)", names)])
}

# The flows of the weights, since the first of the rates `omega`, as those of the rope on the
# pulley: the masses take the rest.
hanging_flows <- function(flows, scene, omega) {
  moment <- sum(masses_of(scene)) * scene$radius_m^2
  n <- length(omega)
  taken <- moment * (omega[-1] - omega[-n])
  since <- function(x) c(0, cumsum(x))
  flows[, "work_j"] <- flows[, "work_j"] - since(0.5 * taken * (omega[-1] + omega[-n]))
  flows[, "impulse_n_m_s"] <- flows[, "impulse_n_m_s"] - since(taken)
  flows
}

# ---- a slack rope -------------------------------------------------------------------------------

# From when on the rope would be slack, in words; NULL: it is taut. Forward it is slack from the
# start on or never: a tension falls below 0 with the rate, which decreases or tends to that of a
# taut rope. Rows before the start are looked at.
slack_rope <- function(scene, columns) {
  from <- scene$start_s
  start <- run_table_model(
    "axle", "axle_rk8pd", scene, from, c(1, 1, TRUE, 0, FALSE, FALSE, 0), NULL, looks = FALSE
  )$columns
  lowest <- function(columns) {
    do.call(pmin, unname(unclass(columns)[grepl("^tension(_[12])?_n$", names(columns))]))
  }
  rounding <- 16 * .Machine$double.eps * sum(masses_of(scene)) * abs(scene$gravity_m_per_s2)
  tension <- lowest(start)
  if (!(tension < -rounding) && any(grepl("^tension", names(columns)))) {
    row <- match(TRUE, lowest(columns) < -rounding)
    if (is.na(row)) return(NULL)
    from <- columns$time_s[row]
    tension <- lowest(columns)[row]
  }
  if (!(tension < -rounding)) return(NULL)
  paste0(
    "the rope would be slack from ", format_si(from), " s on (its tension would be ",
    format_si(tension), " N there): the motion is that of a rope that can push"
  )
}
