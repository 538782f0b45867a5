"""The spin-up by scipy's solve_ivp. A child of bench/peers.R, as child.h describes."""

import math
import sys
import time

import numpy
from scipy.integrate import solve_ivp

INERTIA, VISCOUS = 0.0625, 0.03
OPTIONS = {
    "rk45-default": {"method": "RK45"},
    "rk45-tight": {"method": "RK45", "rtol": 1e-9, "atol": 1e-11},
    "lsoda-tight": {"method": "LSODA", "rtol": 1e-9, "atol": 1e-11},
}


def torque(t):
    if t < 1:
        return 0.8 * t
    if t < 4:
        return 0.8
    return 0.4 * (6 - t) if t < 6 else 0.0


def rates(t, y):
    return [y[1], (torque(t) - VISCOUS * y[1]) / INERTIA]


def main(how, file, what, batches=0, batch_us=0):
    with open(file, encoding="ascii") as lines:
        times = numpy.array([float.fromhex(line) for line in lines])

    def solve():
        return solve_ivp(rates, (times[0], times[-1]), [0.0, 0.0], t_eval=times, **OPTIONS[how])

    def time_batch(calls):
        start = time.perf_counter()
        for _ in range(calls):
            solve()
        return (time.perf_counter() - start) * 1e6 / calls

    solution = solve()
    if what == "solve":
        for theta, omega in solution.y.T:
            print(float(theta).hex(), float(omega).hex())
        print(solution.nfev)
    else:
        calls = max(1, math.ceil(float(batch_us) / time_batch(1)))
        print(min([time_batch(calls) for _ in range(int(batches))][1:]))


main(*sys.argv[1:])
