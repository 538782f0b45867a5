"""Reference values for extreme scenes on a fixed axle, from outside the package.

    python3 tools/extremes.py | gzip -9n > inst/extdata/extremes.csv.gz

needs mpmath and nothing else. Every value is computed with more and more digits, 500 at first,
until two runs agree to 45 of them. Inputs are doubles, written as C99 hexadecimal numbers, so that
every reader gets the very same ones; theta and omega are decimal, 40 digits.

The equations are those of the plain textbook form, divided by what may be small: with hundreds of
digits nothing is lost by that. Where a formula has 0/0 (no damping, a resonance met exactly) the
small number is moved off zero by less than counts.
"""

import csv
import sys

from mpmath import mp, mpf, mpc

AGREE = mpf(10) ** -45


def small(s):
    """Moves a zero off zero: far below the digits that count, far above those that are lost."""
    return mpf(10) ** (-(mp.dps // 4)) / abs(s)


# ---- torque over time: straight lines ------------------------------------------------------------


def pulse(x):
    """start, duration, torque"""
    return [x[0], x[2], x[0] + x[1], x[2]]


def line(law, x, a, b):
    """Torque just after a and just before b; no knot lies between them."""
    if law == "pulse":
        law, x = "knots", pulse(x)
    if law == "constant":
        return x[0], x[0]
    if law in ("knots", "steps"):
        t, tau = x[0::2], x[1::2]
        if law == "steps":
            now = [v for u, v in zip(t, tau) if u <= a]
            return (now[-1], now[-1]) if now else (mpf(0), mpf(0))
        for i in range(len(t) - 1):
            if t[i] <= a and b <= t[i + 1] and t[i] < t[i + 1]:
                slope = (tau[i + 1] - tau[i]) / (t[i + 1] - t[i])
                return tau[i] + slope * (a - t[i]), tau[i] + slope * (b - t[i])
    return mpf(0), mpf(0)


def breaks(law, x):
    if law == "pulse":
        x = pulse(x)
    return x[0::2] if law in ("knots", "steps", "pulse") else []


# ---- one stretch, from (theta, omega) at a, over s -----------------------------------------------


def damped(p, law, x, theta, omega, a, s):
    """I omega' = torque(t) - c omega"""
    b = p["c"] / p["I"] if p["c"] else small(s)
    gone = (1 - mp.exp(-b * s)) / b
    y0, y1 = line(law, x, a, a + s)
    slope = (y1 - y0) / s / p["I"]
    ramp = (s - gone) / b
    d_omega = omega * mp.exp(-b * s) + y0 / p["I"] * gone + slope * ramp
    d_theta = omega * gone + y0 / p["I"] * ramp + slope * (s * s / 2 - ramp) / b
    if law in ("sinusoid", "exponential"):
        mu = mpc(0, x[1]) if law == "sinusoid" else -x[1]
        size = x[0] * (mp.expj(x[1] * a + x[2]) if law == "sinusoid" else mp.exp(mu * (a - x[2])))
        mu = mu if mu else small(s) * 2
        if mu + b == 0:
            mu += small(s) * 3
        force = size / p["I"] / (mu + b)
        d_omega += mp.re(force * (mp.exp(mu * s) - mp.exp(-b * s)))
        d_theta += mp.re(force * ((mp.exp(mu * s) - 1) / mu - gone))
    return theta + d_theta, d_omega


def swinging(p, law, x, theta, omega, a, s):
    """I omega' = -k theta - c omega + A cos(f t); x = k, A, f"""
    k, A, f = x[0], x[1], x[2]
    half = p["c"] / p["I"] / 2
    d = half * half - k / p["I"]
    r = mp.sqrt(mpc(d if d else small(s) ** 2))
    r1, r2 = -half + r, -half - r
    below = k - p["I"] * f * f + mpc(0, p["c"] * f)
    if below == 0:
        f += small(s)
        below = k - p["I"] * f * f + mpc(0, p["c"] * f)
    start = A * mp.expj(f * a) / below
    end = start * mp.expj(f * s)
    u, v = theta - mp.re(start), omega - mp.re(mpc(0, f) * start)
    a1, a2 = (v - r2 * u) / (r1 - r2), (r1 * u - v) / (r1 - r2)
    e1, e2 = mp.exp(r1 * s), mp.exp(r2 * s)
    return (
        mp.re(a1 * e1 + a2 * e2) + mp.re(end),
        mp.re(a1 * r1 * e1 + a2 * r2 * e2) + mp.re(mpc(0, f) * end),
    )


def dragged(p, drive, omega, s):
    """I omega' = drive - c omega - q omega^2 for omega >= 0; theta and omega after s, and when it
    stops."""
    A, b, k = drive / p["I"], p["c"] / p["I"], p["q"] / p["I"]
    if k == 0:
        k = small(s) / (omega + abs(A * s))
    d = b * b / 4 + A * k
    root = mp.sqrt(mpc(d if d else small(s) ** 2))
    stop = mp.inf
    if A < 0:
        stop = mp.re(mp.atanh(root * omega / (b * omega / 2 - A)) / root)
    s = min(s, stop)
    sinh, cosh = mp.sinh(root * s) / root, mp.cosh(root * s)
    below = cosh + (b / 2 + k * omega) * sinh
    theta = mp.re((mp.log(below) - b * s / 2) / k)
    return theta, mpf(0) if s == stop else mp.re((omega * (cosh - b / 2 * sinh) + A * sinh) / below), s


def pendulum(p, x, theta, omega, s):
    """I omega' = -x sin theta, by Jacobi's functions; below the separatrix."""
    w = mp.sqrt(x[0] / p["I"])
    m = mp.sin(theta / 2) ** 2 + (omega / (2 * w)) ** 2
    if not m < 1:
        raise ValueError("over the top")
    u = mp.ellipf(mp.atan2(mp.sin(theta / 2), omega / (2 * w)), m) + w * s
    period = 4 * mp.ellipk(m)
    u -= period * mp.nint(u / period)
    k = mp.sqrt(m)
    sn, cn = mp.ellipfun("sn", u, m=m), mp.ellipfun("cn", u, m=m)
    return 2 * mp.asin(k * sn), 2 * w * k * cn


def skater(x, theta, omega, s):
    """I omega constant, I from x[1] at x[0] to x[3] at x[2], starting at x[0]."""
    rise = (x[3] - x[1]) / (x[2] - x[0])
    inside = min(s, x[2] - x[0])
    now = x[1] + rise * inside
    momentum = x[1] * omega
    theta += momentum * mp.log(now / x[1]) / rise + momentum / now * (s - inside)
    return theta, momentum / now


# ---- scenes --------------------------------------------------------------------------------------


def solve(case):
    p = {key: mpf(case[key]) for key in ("I", "c", "q", "coulomb", "static")}
    law, x = case["law"], [mpf(v) for v in case["x"]]
    theta, omega, t = mpf(case["theta0"]), mpf(case["omega0"]), mpf(case["start"])
    end = mpf(case["t"])
    if law == "pendulum":
        return pendulum(p, x, theta, omega, end - t)
    if law == "skater":
        return skater(x, theta, omega, end - t)
    if law in ("oscillator", "stiff"):
        full = x if law == "oscillator" else [x[0], mpf(0), mpf(1)]
        return swinging(p, law, full, theta, omega, t, end - t)
    if law == "motor":
        p["c"] += x[0] / x[1]
        law, x = "constant", [x[0]]
    ahead = end > t
    stops = sorted({v for v in breaks(law, x) if min(t, end) < v < max(t, end)} | {end})
    for stop in stops if ahead else reversed(stops):
        while t != stop:
            if not (p["q"] or p["static"]):
                theta, omega = damped(p, law, x, theta, omega, t, stop - t)
                t = stop
                continue
            torque = line(law, x, t, stop)[0]
            if omega == 0 and abs(torque) <= p["static"]:
                t = stop
                continue
            sign = 1 if (omega if omega else torque) > 0 else -1
            turned, fast, s = dragged(p, sign * torque - p["coulomb"], abs(omega), stop - t)
            theta, omega = theta + sign * turned, sign * fast
            t = t + s if s < stop - t else stop
    return theta, omega


def same(u, v):
    return all(a == b or abs(a - b) <= AGREE * max(abs(a), abs(b)) for a, b in zip(u, v))


def truth(case):
    last, mp.dps = None, 500
    while mp.dps < 10000:
        now = solve(case)
        if last is not None and same(last, now):
            return now
        last, mp.dps = now, 2 * mp.dps
    raise ArithmeticError(case["case"])


# ---- the cases -----------------------------------------------------------------------------------


def case(name, group, t, law="constant", x=(0.0,), I=1.0, c=0.0, q=0.0, coulomb=0.0, static=None,
         theta0=0.0, omega0=0.0, start=0.0, expect="value"):
    return dict(case=name, group=group, I=I, c=c, q=q, coulomb=coulomb,
                static=coulomb if static is None else static, law=law, x=list(x), theta0=theta0,
                omega0=omega0, start=start, t=t, expect=expect)


def atlas():
    """Damping and inertia: torque up, held, down to nothing; seen at 5 s."""
    for i in range(-300, 301, 100):
        I = float(f"1e{i}")
        knots = [0.0, 0.0, 1.0, 0.8 * I, 4.0, 0.8 * I, 6.0, 0.0, 8.0, 0.0]
        for r in range(-32, 29, 4):
            if -307 <= i + r <= 307:
                yield case(f"I 1e{i}, c/I 1e{r}", "atlas", 5.0, "knots", knots, I, float(f"1e{i + r}"))


def ulp(x):
    return 2.0 ** (mp.floor(mp.log(x, 2)) - 52)


def torques():
    g = "torques that vanish"
    for t in (0.5, 1.0, 1.5, 2.0, 3.0):
        yield case(f"from 1 to -1 N m in 2 s, seen at {t:g} s", g, t, "knots", [0.0, 1.0, 2.0, -1.0], 2.0, 0.1)
    yield case("ends at zero, seen later", g, 1e6, "knots", [0.0, 1.0, 1.0, 0.0], 2.0)
    yield case("ends at zero, all but stopped by damping", g, 1300.0, "knots", [0.0, 1.0, 1.0, 0.0], 2.0, 1.0)
    yield case("decays to 1e-347 N m", g, 800.0, "exponential", [1.0, 1.0, 0.0])
    yield case("decays to 1e-347 N m, with damping at the same rate", g, 700.0, "exponential", [1.0, 1.0, 0.0], 1.0, 1.0)
    yield case("1e-300 N m on 1e-300 kg m^2", g, 3.0, "constant", [1e-300], 1e-300, 1e-301)
    g = "times"
    yield case("a wave of 3 rad/s after 1e12 s", g, 1e12, "sinusoid", [1.0, 3.0, 0.0])
    yield case("a wave of 3 rad/s after 1e12 s, damped", g, 1e12, "sinusoid", [1.0, 3.0, 0.0], 2.0, 0.5)
    yield case("coasting for 1e12 s", g, 1e12, omega0=1 / 3)
    yield case("a second of torque at 1e12 s", g, 1e12 + 1, "knots", [1e12, 1.0, 1e12 + 1, 1.0], c=0.1)
    yield case("start at 1e12 s", g, 1e12 + 0.5, "knots", [1e12, 1.0, 1e12 + 1, 0.0], c=0.1, start=1e12)
    yield case("before the start, against damping", g, -20.0, "constant", [1.0], c=0.5, omega0=3.0)
    yield case("before a start at 1e12 s", g, 1e12 - 3, "constant", [1.0], c=0.5, omega0=3.0, start=1e12)
    g = "pulses and knots"
    yield case("a pulse of 1e-300 s at 0", g, 1.0, "pulse", [0.0, 1e-300, 1e300])
    yield case("a pulse of 1e-6 s at 1e12 s", g, 1e12 + 1, "pulse", [1e12, 1e-6, 1.0], expect="time")
    yield case("a pulse of 1e-12 s at 1000 s", g, 1001.0, "pulse", [1000.0, 1e-12, 1.0], expect="time")
    yield case("a pulse of 1e-9 s at 1000 s", g, 1e6, "pulse", [1000.0, 1e-9, 1e9])
    close = 1.0 + 5 * 2.0**-52
    yield case("knots 1e-15 s apart", g, 2.0, "knots", [1.0, 1e15, close, 1e15])
    yield case("knots 1e-15 s apart, from 1 to -3e15 N m", g, 2.0, "knots", [1.0, 1e15, close, -3e15], c=0.1)
    yield case("a repeated knot: the torque jumps", g, 1.5, "knots", [0.0, 1.0, 1.0, 1.0, 1.0, -4.0, 2.0, 0.0], c=0.1)
    yield case("a knot three times", g, 1.5, "knots", [0.0, 1.0, 1.0, 1.0, 1.0, 9.0, 1.0, -4.0, 2.0, 0.0], c=0.1)


def friction():
    g = "friction"
    above = 0.3 + 2.0**-54
    yield case("torque equal to the static friction", g, 10.0, "constant", [0.3], coulomb=0.2, static=0.3)
    yield case("torque one ulp above it", g, 10.0, "constant", [above], coulomb=0.2, static=0.3)
    yield case("one ulp above, sliding friction the same", g, 10.0, "constant", [above], coulomb=0.3)
    yield case("at rest from the start, 1e300 N m of friction", g, 1e12, "constant", [1e299], coulomb=1e300)
    yield case("held, then loose", g, 3.0, "steps", [0.0, 0.1, 1.0, 0.5, 2.0, 0.0], coulomb=0.2, static=0.3)
    yield case("a stop at 40 s, seen at 100 s", g, 100.0, I=2.0, coulomb=0.5, omega0=10.0)
    yield case("a stop at 40 s, seen at 1e12 s", g, 1e12, I=2.0, coulomb=0.5, omega0=10.0)
    yield case("a stop after 1e-599 s", g, 1.0, I=1e-300, coulomb=1e300, omega0=10.0)
    yield case("friction 1e-300 N m, 1e12 s", g, 1e12, I=2.0, coulomb=1e-300, omega0=10.0)
    yield case("viscous, quadratic and dry, to the stop", g, 5e3, I=2.5, c=0.004, q=2e-5, coulomb=0.05, omega0=150.0)
    yield case("stop and turn back", g, 9.0, "constant", [-1.0], I=2.0, q=0.01, coulomb=0.5, omega0=5.0)
    for e in (-100, 100):
        v = float(f"1e{e}")
        yield case(f"quadratic drag 1e{e}, torque 1e{e}", g, 1 / v, "constant", [v], q=v)
        yield case(f"quadratic drag 1e{e}, omega 1e{e}", g, 1.0, q=v, omega0=v)
        yield case(f"quadratic drag 1e{e}, viscous 1e{-e}", g, 1.0, "constant", [1.0], c=1 / v, q=v)


def swings():
    g = "swings"
    pi = 3.141592653589793
    for t in (1.0, 20.0, 28.0, 100.0):
        yield case(f"amplitude pi - 1e-12, at {t:g} s", g, t, "pendulum", [1.0], theta0=pi - 1e-12)
    yield case("amplitude 1e-300", g, 7.0, "pendulum", [2.0], theta0=1e-300)
    yield case("amplitude 3, 1e12 s", g, 1e12, "pendulum", [1.0], theta0=3.0)
    yield case("oscillator at resonance, undamped", g, 100.0, "oscillator", [4.0, 1.0, 2.0])
    yield case("oscillator at resonance, c = 1e-20", g, 100.0, "oscillator", [4.0, 1.0, 2.0], c=1e-20)
    yield case("oscillator 1 ulp off resonance", g, 100.0, "oscillator", [4.0, 1.0, 2.0 + 2.0**-51])
    yield case("oscillator, critical", g, 5.0, "oscillator", [1.0, 0.5, 1.0], c=2.0, theta0=1.0)
    yield case("oscillator, critical but for an ulp", g, 5.0, "oscillator", [1.0, 0.5, 1.0], c=2.0 + 2.0**-51, theta0=1.0)
    yield case("oscillator, c = 1e20", g, 5.0, "oscillator", [1.0, 0.5, 1.0], c=1e20, theta0=1.0)
    yield case("oscillator, I = 1e-300", g, 5.0, "oscillator", [1e-300, 1e-300, 0.5], I=1e-300, c=1e-301, theta0=1.0)
    yield case("arms from 1e-150 to 1e150 kg m^2", g, 0.5, "skater", [0.0, 1e-150, 1.0, 1e150], I=1e-150, omega0=1.0)
    yield case("arms in, by an ulp", g, 2.0, "skater", [0.0, 1.0, 1.0, 1.0 - 2.0**-53], omega0=3.0)


def growth():
    g = "growth"
    yield case("negative damping, exp(700)", g, 700.0, c=-1.0, omega0=1.0)
    yield case("negative damping, exp(711)", g, 711.0, c=-1.0, omega0=1.0, expect="range")
    yield case("negative damping, at rest", g, 1e300, c=-1.0)
    yield case("1e300 N m for 1e10 s", g, 1e10, "constant", [1e300], expect="range")
    yield case("a motor whose resistance drives", g, 600.0, "motor", [1.0, 3.0], c=-1.0)


def stiff():
    g = "stiff R functions"
    for e in range(0, 13, 2):
        yield case(f"c/I = 1e{e}", g, 1.0, "stiff", [2.0], c=float(f"1e{e}"), theta0=1.0, omega0=1.0)


def main():
    names = ["case", "group", "expect", "I", "c", "q", "coulomb", "static", "law", "x", "theta0", "omega0",
             "start", "t", "theta", "omega"]
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(names)
    for one in [*atlas(), *torques(), *friction(), *swings(), *growth(), *stiff()]:
        mp.dps = 60
        row = dict(one, theta="", omega="")
        if one["expect"] == "value":
            theta, omega = truth(one)
            row["theta"], row["omega"] = mp.nstr(theta, 40), mp.nstr(omega, 40)
        for key in ("I", "c", "q", "coulomb", "static", "theta0", "omega0", "start", "t"):
            row[key] = float(one[key]).hex()
        row["x"] = ";".join(float(v).hex() for v in one["x"])
        out.writerow([row[key] for key in names])


if __name__ == "__main__":
    main()
