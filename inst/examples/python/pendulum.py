"""A pendulum at any amplitude, and which models could compute it.

    python3 pendulum.py [theta0_rad [end_s]]
"""
import sys

from rotdyn_objects import candidates, run

theta0 = float(sys.argv[1]) if len(sys.argv) > 1 else 3.0
end = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0

# A mass of 1 kg at 1 m.
pendulum = {
    "body": 1.0,
    "torque": {"torque_gravity": {"mass_kg": 1.0, "distance_m": 1.0}},
    "theta0_rad": theta0,
}
n = 101
time = [end * i / (n - 1) for i in range(n)]
for model, words in candidates("scene_axle", pendulum, time):
    print(f"{model}: {words or 'applies'}", file=sys.stderr)
report, columns = run("scene_axle", pendulum, time)
print("time_s,theta_rad,omega_rad_per_s")
for row in zip(time, columns["theta_rad"], columns["omega_rad_per_s"]):
    print(*map(repr, row), sep=",")
