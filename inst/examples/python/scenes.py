"""A ball on a slope, a body that tumbles, and a top: scenes by name, input by input.

    python3 scenes.py

The library is librotdyn.so.1, or what ROTDYN_LIBRARY names.
"""
import ctypes as c
import os

D, Z, T, P = c.c_double, c.c_size_t, c.c_char_p, c.c_void_p
Doubles = c.POINTER(D)


class Body(c.Structure):
    _fields_ = [("size", Z), ("mass_kg", D), ("centre_m", D * 3), ("inertia_kg_m2", D * 6),
                ("radius_m", D)]


class Report(c.Structure):
    _fields_ = [("size", Z), ("status", c.c_int), ("rows_done", Z), ("time_s", D), ("steps", Z),
                ("rejected", Z), ("law_calls", Z), ("error", D), ("error_is_bound", c.c_int),
                ("n_measures", Z), ("measure", T * 8), ("measure_error", D * 8),
                ("measure_largest", D * 8), ("model", T), ("input", T),
                ("reason", c.c_char * 512)]


lib = c.CDLL(os.environ.get("ROTDYN_LIBRARY", "librotdyn.so.1"))
lib.rotdyn_status_text.restype = T
lib.rotdyn_scene_new.restype = P
lib.rotdyn_scene_free.argtypes = [P]
lib.rotdyn_scene_number.argtypes = [P, T, D]
lib.rotdyn_scene_numbers.argtypes = [P, T, Z, Doubles]
lib.rotdyn_scene_body.argtypes = [P, T, P]
lib.rotdyn_scene_run.argtypes = [P, Z, Doubles, P, Z, c.POINTER(T), c.POINTER(Doubles), P]


def doubles(values):
    return (D * len(values))(*values)


def run(constructor, time_s, columns, **inputs):
    """Columns of a motion; each input is a number, a list of numbers or a Body."""
    scene = lib.rotdyn_scene_new(constructor.encode())
    for name, value in inputs.items():
        name = name.encode()
        if isinstance(value, Body):
            status = lib.rotdyn_scene_body(scene, name, c.byref(value))
        elif isinstance(value, list):
            status = lib.rotdyn_scene_numbers(scene, name, len(value), doubles(value))
        else:
            status = lib.rotdyn_scene_number(scene, name, value)
        if status:
            raise ValueError(f"{name.decode()}: {lib.rotdyn_status_text(status).decode()}")
    out = [(D * len(time_s))() for _ in columns]
    report = Report(size=c.sizeof(Report))
    status = lib.rotdyn_scene_run(
        scene, len(time_s), doubles(time_s), None, len(columns),
        (T * len(columns))(*(name.encode() for name in columns)),
        (Doubles * len(columns))(*(c.cast(x, Doubles) for x in out)), c.byref(report))
    lib.rotdyn_scene_free(scene)
    if status:
        raise ValueError(f"{(report.input or b'').decode()} {report.reason.decode()}")
    return out


def body(mass_kg, moments, radius_m=0.0, centre_m=(0.0, 0.0, 0.0)):
    return Body(size=c.sizeof(Body), mass_kg=mass_kg, radius_m=radius_m,
                centre_m=(D * 3)(*centre_m), inertia_kg_m2=(D * 6)(*moments))


times = [0.05 * i for i in range(41)]
motions = {
    "incline": (run(
        "scene_incline", times, ["x_m", "omega_rad_per_s"],
        body=body(2.0, [0.05] * 3, radius_m=0.25), incline_angle_deg=10.0, static_friction=0.2,
        kinetic_friction=0.15, v0_m_per_s=3.0, omega0_rad_per_s=-2.0)),
    "free": (run(
        "scene_free", times, ["qw", "omega_y_rad_per_s"],
        body=body(1.0, [1.0, 1.5, 2.0]), omega0_rad_per_s=[0.01, 6.0, 0.02])),
    "pivot": (run(
        "scene_pivot", times, ["qw", "omega_x_rad_per_s"],
        body=body(0.5, [0.002, 0.002, 0.001], centre_m=(0.0, 0.0, 0.08)),
        omega0_rad_per_s=[0.0, 0.0, 60.0], attitude0=[0.8, 0.6, 0.0, 0.0])),
}
print("scene,time_s,first,second")
for name, (first, second) in motions.items():
    for t, a, b in zip(times, first, second):
        print(f"{name},{t!r},{a!r},{b!r}")
