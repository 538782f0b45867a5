"""A free body by scipy: space-scipy.py METHOD TOLERANCE I1 I2 I3 w1 w2 w3 t ...

A line for each time: t, the quaternion, body to space, the angular velocity along the body's axes,
CPU seconds, right-hand sides.
"""
import sys
import time

from scipy.integrate import solve_ivp

method, tolerance = sys.argv[1], float(sys.argv[2])
i = [float(x) for x in sys.argv[3:6]]


def rates(t, y):
    a, b, c, d, u, v, w = y
    return [
        0.5 * (-b * u - c * v - d * w),
        0.5 * (a * u + c * w - d * v),
        0.5 * (a * v + d * u - b * w),
        0.5 * (a * w + b * v - c * u),
        (i[1] - i[2]) / i[0] * v * w,
        (i[2] - i[0]) / i[1] * w * u,
        (i[0] - i[1]) / i[2] * u * v,
    ]


for end in sys.argv[9:]:
    start = time.process_time()
    y = [1.0, 0.0, 0.0, 0.0] + [float(x) for x in sys.argv[6:9]]
    run = solve_ivp(rates, (0.0, float(end)), y, method=method, rtol=tolerance, atol=tolerance)
    last = " ".join("%.17g" % x for x in run.y[:, -1])
    print(end, last, time.process_time() - start, run.nfev)
