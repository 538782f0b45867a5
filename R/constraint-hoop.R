# A bead on a hoop that turns about its vertical diameter.
hoop_constraint <- function() {
  words <- function(...) {
    list(
      equations = "theta'' = (W^2 cos - g/R) sin - c theta'/m - mu N/(m R) sign(theta')",
      assumptions = "a point on a thin rigid hoop; constant rate of the hoop and coefficients",
      requires = "a bead on a turning hoop", ...
    )
  }
  table_constraint(
    "hoop", "scene_hoop",
    models = list(
      hoop_rk8pd = words(
        limits = "not stiff: a step is at most about 6 times the shortest decay",
        source = "Prince & Dormand 1981, order 8(7), as in the GNU Scientific Library"
      ),
      hoop_radau = words(
        limits = "each step solves a system of equations",
        source = "Hairer & Wanner 1996, section IV.8 (Radau IIA)"
      )
    ),
    title = function(run) {
      paste("A bead on a hoop that turns at", format_si(run$scene$hoop_omega_rad_per_s), "rad/s")
    },
    panels = list(
      panel("angle from the lowest point (rad)", c(theta_rad = "")),
      panel("angular velocity (rad/s)", c(omega_rad_per_s = "")),
      panel("energy (J)", c(kinetic_energy_j = "kinetic", potential_energy_j = "potential"))
    ),
    drawing = draw_hoop, frames = hoop_frames
  )
}
