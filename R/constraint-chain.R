# A chain of pendulums in a plane. Rows in long form: by time, then link.
chain_constraint <- function() {
  equations <- "sum A (cos(d) theta_j'' + sin(d) theta_j'^2) + g B sin(theta_i) = tau, d between"
  assumptions <- "rigid links in one plane; joints without play"
  table_constraint(
    "chain",
    models = c(
      list(chain_modes = list(
        equations = "M theta'' + K theta = 0", assumptions = assumptions,
        limits = "swings to half a radian; what the linear equations leave out is in the error",
        requires = "links that hang, viscous joints left out",
        source = "a sum of normal modes; Goldstein 2002, section 6.2"
      )),
      integrated_words(
        "chain", equations = equations, assumptions = assumptions, requires = "a chain of links"
      )
    ),
    title = function(run) {
      n <- length(run$scene$length_m)
      what <- if (run$scene$links == "rods") "rod" else "point mass"
      if (n == 1L) return(paste0("A pendulum: a ", what))
      many <- paste0(if (n == 2L) "two" else n, " ", what, if (what == "rod") "s" else "es")
      paste0(if (n == 2L) "A double pendulum: " else "A chain of ", many)
    },
    panels = list(
      panel("angle from the vertical (rad)", c(theta_rad = "")),
      omega_panel(),
      panel("height of the lower end (m)", c(y_m = ""))
    ),
    drawing = draw_chain, frames = chain_frames,
    periods = function(scene, call) {
      modes <- chain_modes(scene)
      periods_of_modes(modes$natural_rad_per_s[!duplicated(modes$mode)])
    }
  )
}

chain_meanings <- c(
  link = "number of the link, from the pivot down", theta_rad = "angle from the downward vertical",
  x_m = "x of its lower end, from the pivot", y_m = "y of its lower end, upward from the pivot",
  kinetic_energy_j = "kinetic energy of the link",
  potential_energy_j = "potential energy of the link, 0 where all hang"
)
chain_mode_columns <- c("mode", "natural_rad_per_s", "period_s", "link", "relative_theta")
chain_column_words <- list(
  c("joint_torque_n_m", "N m", "viscous torque on the link from the joint above it"),
  c("relative_theta", "1", "angle of the link in a mode, relative to the largest one")
)
