"""Reference values for periods, passages and stops on a fixed axle, from outside the package.

    python3 tools/passages.py > tests/testthat/passages.csv

needs mpmath and nothing else. Values have 40 digits, from textbook formulas with 400. Inputs are
doubles, written as hexadecimal numbers, so that every reader gets the very same ones.

pendulum    I theta'' = -k sin(theta): first passage of `value`; the period in `second`
oscillator  I theta'' = -c theta' - k theta: passage number `value` of 0; the cycle in `second`
stop        I omega' = -(c omega + q omega^2 + f): time to the stop; the angle in `second`
"""

import csv
import random
import sys

from mpmath import asin, atan, atanh, ellipf, ellipk, inf, isinf, log, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 400
COLUMNS = ["kind", "inertia", "c", "k", "q", "f", "theta0", "omega0", "value", "time_s", "second"]
writer = csv.writer(sys.stdout, lineterminator="\n")


def text(x):
    return "Inf" if isinf(x) else nstr(x, 40)


def row(kind, time_s, second, **given):
    numbers = [float(given.get(name, 0.0)).hex() for name in COLUMNS[1:9]]
    writer.writerow([kind] + numbers + [text(time_s), text(second)])


# Let go at theta0, or pushed at the lowest point; the first passage of an angle.
def pendulum(inertia, k, theta0, omega0, value):
    rate = sqrt(mpf(k) / mpf(inertia))
    v = mpf(value)
    if omega0 == 0.0:
        s = sin(abs(mpf(theta0)) / 2)
        time = (ellipk(s * s) - ellipf(asin(sin(v / 2) / s), s * s)) / rate
        period = 4 * ellipk(s * s) / rate
    else:
        s = mpf(omega0) / (2 * rate)
        if s < 1:
            time = ellipf(asin(sin(v / 2) / s), s * s) / rate
            period = 4 * ellipk(s * s) / rate
        else:
            time = ellipf(v / 2, 1 / (s * s)) / (s * rate)
            period = 2 * ellipk(1 / (s * s)) / (s * rate)
    row("pendulum", time, period, inertia=inertia, k=k, theta0=theta0, omega0=omega0, value=value)


# Half a cycle lies between passages, without damping or with; overdamped there is one at most.
def oscillator(inertia, c, k, theta0, omega0, n):
    g = mpf(c) / (2 * mpf(inertia))
    square = mpf(k) / mpf(inertia) - g * g
    slope = mpf(omega0) + g * mpf(theta0)
    if square > 0:
        w = sqrt(square)
        first = atan(-mpf(theta0) * w / slope) if slope != 0 else pi / 2
        first = (first + pi if first <= 0 else first) / w
        time, cycle = first + (n - 1) * pi / w, 2 * pi / w
    elif square == 0:
        time, cycle = -mpf(theta0) / slope, inf
    else:
        s = sqrt(-square)
        time, cycle = atanh(-mpf(theta0) * s / slope) / s, inf
    assert time > 0
    row("oscillator", time, cycle, inertia=inertia, c=c, k=k, theta0=theta0, omega0=omega0, value=n)


def stop(inertia, c, q, f, omega0):
    i, cc, qq, ff, w = (mpf(x) for x in (inertia, c, q, f, omega0))
    if ff == 0:
        time = inf
        angle = i * w / cc if qq == 0 else i / qq * log(1 + qq * w / cc)
    elif qq == 0 and cc == 0:
        time, angle = i * w / ff, i * w * w / (2 * ff)
    elif qq == 0:
        time = i / cc * log(1 + cc * w / ff)
        angle = i / cc * (w - ff / cc * log(1 + cc * w / ff))
    else:
        root = sqrt(cc * cc - 4 * qq * ff)  # imaginary where the roots of the drag are complex
        if root == 0:
            root = mpf(10) ** -150
        time = 2 * i / root * atanh(root * w / (2 * ff + cc * w))
        time = time.real if hasattr(time, "real") else time
        angle = i / (2 * qq) * log(1 + (cc * w + qq * w * w) / ff) - cc / (2 * qq) * time
    row("stop", time, angle, inertia=inertia, c=c, q=q, f=f, omega0=omega0)


writer.writerow(COLUMNS)

amplitudes = [10.0 ** -e for e in (300, 150, 30, 12, 8, 4, 2)]
amplitudes += [0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.1, 3.14]
amplitudes += [3.141592653589793 - 10.0 ** -e for e in (3, 5, 7, 9, 11, 13, 15)]
amplitudes += [3.1415926535897927, 3.141592653589793]
for a in amplitudes:
    for part in (0.9, 0.3, 0.0, -0.7):
        pendulum(0.7, 3.1, a, 0.0, part * a)
# Beside the separatrix, from the lowest point: 2^-e below and above the speed that leads to the top.
for e in (1, 4, 10, 20, 30, 40, 45, 50, 51):
    for value in (0.5, 2.0, 3.0) if e > 4 else (0.3, 0.9):
        pendulum(1.0, 1.0, 0.0, 2.0 - 2.0 ** -e, value)
    for value in (0.5, 3.0, 3.2, 20.0):
        pendulum(1.0, 1.0, 0.0, 2.0 + 2.0 ** -e, value)
pendulum(2e200, 5e-200, 1.0, 0.0, 0.25)
pendulum(1e-200, 1e100, 2.0, 0.0, -1.0)

# Damping from nothing to far above the critical one, which is 8.
for c in (0.0, 1e-300, 1e-12, 1e-6, 0.01, 0.5, 3.0, 7.0, 7.9, 7.99, 7.9992):
    for n in (1, 2, 9) if c < 7.999 else (1, 2):  # the amplitude must be a double
        oscillator(2.0, c, 8.0, 1.0, 0.0, n)
        oscillator(2.0, c, 8.0, -0.3, 1.7, n)
for c in (7.999999, 7.9999999999, 7.999999999999999, 8.0, 8.000000000000002, 8.0000000001, 8.000001):
    oscillator(2.0, c, 8.0, 1.0, -17.0, 1)
for c in (8.1, 9.0, 40.0, 1e3, 1e6, 1e12):
    oscillator(2.0, c, 8.0, 1.0, -(c + 1.0), 1)
oscillator(1e120, 1e70, 1e30, 1.0, 0.0, 2)

random.seed(12)
for c, q, f in [(1, 0, 0), (1, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)]:
    for i in range(16 if c + q + f == 3 else 8):
        wide = [10.0 ** random.uniform(-8, 8) for _ in range(5)]
        stop(wide[0], c * wide[1], q * wide[2], f * wide[3], wide[4])
stop(0.0625, 0.03, 0.0, 0.0, 30.0)
stop(1.0, 2.0, 1.0, 1.0, 3.0)  # a double root
stop(1.0, 2.0, 1.0000000000000002, 1.0, 3.0)
stop(1.0, 2.0, 0.9999999999999999, 1.0, 3.0)
stop(1.0, 1e-300, 1e-300, 1.0, 1.0)
