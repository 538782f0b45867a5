"""A pendulum at any amplitude, and which models could compute it.

    python3 pendulum.py [theta0_rad [end_s]]

The library is librotdyn.so.1, or what ROTDYN_LIBRARY names.
"""
import ctypes as c
import os
import sys

D, Z, T, P = c.c_double, c.c_size_t, c.c_char_p, c.c_void_p
Doubles = c.POINTER(D)


class Struct(c.Structure):
    """A struct that begins with its size; members that are not given are 0."""

    def __init__(self, **members):
        super().__init__(size=c.sizeof(self), **members)


class Term(Struct):
    _fields_ = [("size", Z), ("kind", T), ("n_x", Z), ("x", Doubles), ("from_s", D), ("to_s", D)]


class Axle(Struct):
    _fields_ = (
        [("size", Z)]
        + [(name, D) for name in (
            "inertia_kg_m2", "start_s", "theta0_rad", "omega0_rad_per_s", "viscous_n_m_s",
            "quadratic_n_m_s2", "coulomb_n_m", "static_n_m", "motor_n_m_s")]
        + [("n_knots", Z), ("knot_time_s", Doubles), ("knot_torque_n_m", Doubles),
           ("before_n_m", D), ("after_n_m", D), ("n_terms", Z), ("terms", c.POINTER(Term))]
    )


class Columns(Struct):
    _fields_ = [("size", Z), ("theta_rad", Doubles), ("omega_rad_per_s", Doubles)]


class Candidate(Struct):
    _fields_ = [("size", Z), ("model", T), ("applies", c.c_int), ("error", D),
                ("error_is_bound", c.c_int), ("cost_s", D), ("reason", c.c_char * 512)]


lib = c.CDLL(os.environ.get("ROTDYN_LIBRARY", "librotdyn.so.1"))
lib.rotdyn_status_text.restype = T
lib.rotdyn_axle_candidate.argtypes = [P, Z, Doubles, P, Z, P]
lib.rotdyn_axle_rows.argtypes = [P, Z, Doubles, P, P, P]

theta0 = float(sys.argv[1]) if len(sys.argv) > 1 else 3.0
end = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0

# A mass of 1 kg at 1 m: -m g d sin(theta).
term = Term(kind=b"gravity", n_x=2, x=(D * 2)(9.80665, 0.0))
axle = Axle(inertia_kg_m2=1.0, theta0_rad=theta0, n_terms=1, terms=c.pointer(term))
n = 101
time = (D * n)(*(end * i / (n - 1) for i in range(n)))

k, candidate = 0, Candidate()
while lib.rotdyn_axle_candidate(c.byref(axle), n, time, None, k, c.byref(candidate)) == 0:
    words = candidate.reason.decode() or "applies"
    print(f"{candidate.model.decode()}: {words}", file=sys.stderr)
    k += 1

theta, omega = (D * n)(), (D * n)()
columns = Columns(theta_rad=theta, omega_rad_per_s=omega)
status = lib.rotdyn_axle_rows(c.byref(axle), n, time, None, c.byref(columns), None)
if status:
    sys.exit(lib.rotdyn_status_text(status).decode())
print("time_s,theta_rad,omega_rad_per_s")
for row in zip(time, theta, omega):
    print(*map(repr, row), sep=",")
