# A bead on a hoop that turns about its vertical diameter.
hoop_constraint <- function() table_constraint(
  "hoop",
  models = integrated_words(
    "hoop", equations = "theta'' = (W^2 cos - g/R) sin - c theta'/m - mu N/(m R) sign(theta')",
    assumptions = "a point on a thin rigid hoop; constant rate of the hoop and coefficients",
    requires = "a bead on a turning hoop"
  ),
  title = function(run) {
    paste("A bead on a hoop that turns at", format_si(run$scene$hoop_omega_rad_per_s), "rad/s")
  },
  panels = list(
    panel("angle from the lowest point (rad)", c(theta_rad = "")), omega_panel(),
    panel("energy (J)", c(kinetic_energy_j = "kinetic", potential_energy_j = "potential"))
  ),
  drawing = draw_hoop, frames = hoop_frames, stops = stops_at_rest(stop_theta_rad = "theta_rad"),
  periods = function(scene, call) small_swings(hoop_equilibria(scene))
)

hoop_column_words <- list(c("drive_torque_n_m", "N m", "torque that keeps the rate of a hoop"))
