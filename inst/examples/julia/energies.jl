# Energies of bodies that rolled down an incline: julia energies.jl [height_m [beta...]]
# The library is librotdyn.so.1, or what ROTDYN_LIBRARY names.
const lib = get(ENV, "ROTDYN_LIBRARY", "librotdyn.so.1")

mutable struct Energies
    size::Csize_t
    inertia_kg_m2::Cdouble
    omega_rad_per_s::Cdouble
    translational_j::Cdouble
    rotational_j::Cdouble
    total_j::Cdouble
end

final_speed(beta, height_m) = ccall((:rotdyn_rolling_final_speed, lib), Cdouble,
    (Cdouble, Cdouble, Cdouble), beta, height_m, 9.80665)

function energies(mass_kg, radius_m, beta, speed_m_per_s)
    out = Energies(sizeof(Energies), 0, 0, 0, 0, 0)
    status = ccall((:rotdyn_rolling_energies, lib), Cint,
        (Cdouble, Cdouble, Cdouble, Cdouble, Ref{Energies}),
        mass_kg, radius_m, beta, speed_m_per_s, out)
    status == 0 || error(unsafe_string(ccall((:rotdyn_status_text, lib), Cstring, (Cint,), status)))
    out
end

numbers = parse.(Float64, ARGS)
height_m = isempty(numbers) ? 1.0 : numbers[1]
betas = length(numbers) > 1 ? numbers[2:end] : [1.0, 0.5, 0.4, 2 / 3, 0.0]
println("beta,speed_m_per_s,omega_rad_per_s,translational_energy_j,rotational_energy_j,total_energy_j")
for beta in betas
    v = final_speed(beta, height_m)
    e = energies(1.0, 0.1, beta, v)
    println(join((beta, v, e.omega_rad_per_s, e.translational_j, e.rotational_j, e.total_j), ","))
end
