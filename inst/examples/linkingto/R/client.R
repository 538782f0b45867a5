c_interface <- function() .Call(client_interface)

rolling <- function(beta, angle_deg) .Call(client_rolling, as.double(beta), as.double(angle_deg))

coasting <- function(moment_of_inertia_kg_m2, viscous_n_m_s, omega0_rad_per_s, time_s) {
  .Call(
    client_coasting, as.double(moment_of_inertia_kg_m2), as.double(viscous_n_m_s),
    as.double(omega0_rad_per_s), as.double(time_s)
  )
}
