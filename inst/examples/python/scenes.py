"""Scenes of every constraint by name, as JSON holds them: two columns of each motion.

    python3 scenes.py [FILE.json]

FILE.json is a list of [name, {constructor: arguments}, [column, column]]; without it, those below.
What write_scene() of R writes is such a {constructor: arguments}, but for its scene_format.
"""
import json
import sys

from rotdyn_objects import run

SCENES = """[
["axle", {"scene_axle": {
  "body": {"body_disk": {"mass_kg": 2, "radius_m": 0.25}},
  "torque": [
    {"torque_motor": {"stall_torque_n_m": 2, "no_load_omega_rad_per_s": 300}},
    {"torque_pulse": {"start_s": [0.5, 0.9], "duration_s": [0.6, 0.3], "torque_n_m": [1, -2]}},
    {"torque_knots": {"time_s": [0, 1, 2], "torque_n_m": [0, 0.8, 0], "outside": "hold"}},
    0.1],
  "resistance": {"viscous_n_m_s": 0.03}
 }}, ["theta_rad", "omega_rad_per_s"]],
["swing", {"scene_axle": {
  "body": {"body_rod_end": {"mass_kg": 1, "length_m": 2}},
  "torque": [{"torque_gravity": {"mass_kg": 1, "distance_m": 1}},
             {"torque_sinusoid": {"amplitude_n_m": 2, "angular_frequency_rad_per_s": 3}}],
  "theta0_rad": 2.5
 }}, ["theta_rad", "applied_torque_n_m"]],
["clutch", {"scene_clutch": {
  "body_1": {"body_disk": {"mass_kg": 20, "radius_m": 0.15}}, "body_2": 0.8,
  "capacity_n_m": 60, "static_capacity_n_m": 75,
  "torque": [{"torque_steps": {"time_s": [0, 1.2], "torque_n_m": [30, -10]}}, -5],
  "omega0_rad_per_s": [15, 0], "engage_s": 0.25
 }}, ["omega_1_rad_per_s", "heat_j"]],
["drive", {"scene_drive": {
  "bodies": [0.4, 2, {"body_disk": {"mass_kg": 3, "radius_m": 0.5}}],
  "couplings": [
    {"coupling_clutch": {
      "capacity_n_m": {"torque_knots": {"time_s": [0, 0.5], "torque_n_m": [0, 60],
                                        "outside": "hold"}},
      "static_ratio": 1.2}},
    {"coupling_shaft": {"stiffness_n_m_per_rad": 400, "damping_n_m_s": 0.4, "ratio": 3}}],
  "torque": [[{"torque_motor": {"stall_torque_n_m": 40, "no_load_omega_rad_per_s": 200}}, 1],
             null, -5],
  "resistance": [null, null, {"viscous_n_m_s": 0.05, "coulomb_n_m": 1}],
  "brake": [null, null, {"capacity_n_m": 12, "from_s": 1.5}],
  "omega0_rad_per_s": [150, 0, 0]
 }}, ["omega_rad_per_s", "heat_j"]],
["rotors", {"scene_rotors": {
  "bodies": [{"body_disk": {"mass_kg": 4, "radius_m": 0.2}}, 0.005, 0.27],
  "stiffness_n_m_per_rad": [800, 1200], "damping_n_m_s": 0.05, "torque": [2, 0, -2]
 }}, ["theta_rad", "shaft_torque_n_m"]],
["incline", {"scene_incline": {
  "body": {"body_tensor": {"mass_kg": 2, "inertia_kg_m2": [0.05, 0.05, 0.05]}},
  "incline_angle_deg": 10, "static_friction": 0.2, "kinetic_friction": 0.15, "radius_m": 0.25,
  "v0_m_per_s": 3, "omega0_rad_per_s": -2
 }}, ["x_m", "omega_rad_per_s"]],
["free", {"scene_free": {"body": [1, 1.5, 2], "omega0_rad_per_s": [0.01, 6, 0.02]}},
 ["qw", "omega_y_rad_per_s"]],
["satellite", {"scene_free": {
  "body": {"join_bodies": {"bodies": [
    {"body_box": {"mass_kg": 40, "length_m": 0.6, "width_m": 0.5, "height_m": 0.8}},
    {"place_body": {"body": {"body_points": {"data": {
      "mass_kg": [1, 1], "x_m": [0, 0], "y_m": [-1.5, 1.5], "z_m": 0}}}, "at_m": [0.1, 0, 0]}}]}},
  "omega0_rad_per_s": [0, 0, 0.01],
  "rotors": [{"rotor": {"axis": [0, 0, 1], "moment_of_inertia_kg_m2": 0.01,
                        "omega_rad_per_s": 0,
                        "torque": {"time_s": [0, 0.9, 1.1, 2],
                                   "torque_n_m": [0.1, 0.1, -0.1, -0.1]}}}]
 }}, ["omega_z_rad_per_s", "rotor_1_omega_rad_per_s"]],
["pivot", {"scene_pivot": {
  "body": {"body_tensor": {"mass_kg": 0.5, "inertia_kg_m2": [0.002, 0.002, 0.001],
                           "centre_m": [0, 0, 0.08]}},
  "omega0_rad_per_s": [0, 0, 60], "attitude0": [0.8, 0.6, 0, 0]
 }}, ["qw", "omega_x_rad_per_s"]]
]"""

if len(sys.argv) > 1:
    with open(sys.argv[1], encoding="utf-8") as file:
        SCENES = file.read()
times = [0.05 * i for i in range(41)]
print("scene,time_s,first,second")
for name, scene, columns in json.loads(SCENES):
    scene.pop("scene_format", None)
    (constructor, arguments), = scene.items()
    report, motion = run(constructor, arguments, times, columns)
    rows = [t for t in times for _ in range(report.rows_per_time)]
    for t, a, b in zip(rows, *(motion[column] for column in columns)):
        print(f"{name},{t!r},{a!r},{b!r}")
