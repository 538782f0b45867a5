# Writes tests/core/statics_cases.h: random determinate structures with exact reactions, from
# 60-digit linear algebra on the doubles given. Run: python3 tools/statics-cases.py
import random
from mpmath import mp, mpf, matrix, lu_solve, sqrt

mp.dps = 60
random.seed(20261122)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    size = sqrt(sum(x * x for x in v))
    return [x / size for x in v]


def wrench(reaction):
    at, start, end, couple = reaction
    d = unit([mpf(e) - mpf(s) for s, e in zip(start, end)])
    if couple:
        return [mpf(0)] * 3 + d
    return d + cross([mpf(x) for x in at], d)


def point(plane, scale, offset):
    p = [(random.uniform(-1, 1) + offset) * scale for _ in range(3)]
    if plane:
        p[2] = 0.0
    return p


def axis(i):
    return [1.0 if j == i else 0.0 for j in range(3)]


def supports(plane, scale, offset, near):
    here = lambda: point(plane, scale, offset)
    zero = [0.0, 0.0, 0.0]
    kind = random.choice(["rods", "pin", "fixed"])
    if plane:
        if kind == "fixed":
            p = here()
            return [(p, zero, axis(0), 0), (p, zero, axis(1), 0), (p, zero, axis(2), 1)]
        if kind == "pin":
            p, q = here(), here()
            return [(p, zero, axis(0), 0), (p, zero, axis(1), 0), (q, q, here(), 0)]
        rods = [(p, p, here(), 0) for p in [here() for _ in range(3)]]
        if near:  # almost through one point
            joint = here()
            rods = [(p, p, [j + near * scale * random.uniform(-1, 1) * (1 - (i == 2)) for i, j in
                            enumerate(joint)], 0) for p in [here() for _ in range(3)]]
        return rods
    if kind == "fixed":
        p = here()
        return [(p, zero, axis(i), 0) for i in range(3)] + [(p, zero, axis(i), 1) for i in range(3)]
    if kind == "pin":
        p = here()
        rods = [(q, q, here(), 0) for q in [here() for _ in range(3)]]
        return [(p, zero, axis(i), 0) for i in range(3)] + rods
    return [(q, q, here(), 0) for q in [here() for _ in range(6)]]


def case(number):
    plane = number % 2 == 0
    scale = 2.0 ** random.choice([0, 0, 0, -300, 300])
    strength = 2.0 ** random.choice([0, 0, 0, -600, 600])
    offset = random.choice([0, 0, 0, 1000.0])
    near = random.choice([0, 0, 1e-3, 1e-6])
    all_supports = supports(plane, scale, offset, near)
    loads = []
    for _ in range(random.randint(1, 4)):
        f = [random.uniform(-1, 1) * strength for _ in range(3)]
        c = [random.choice([0.0, random.uniform(-1, 1)]) * strength * scale for _ in range(3)]
        if plane:
            f[2] = c[0] = c[1] = 0.0
        loads.append((point(plane, scale, offset), f, c))
    rows = [0, 1, 5] if plane else range(6)
    columns = [wrench(r) for r in all_supports]
    sums = [mpf(0)] * 6
    for at, f, c in loads:
        f = [mpf(x) for x in f]
        turn = cross([mpf(x) for x in at], f)
        for i in range(3):
            sums[i] += f[i]
            sums[i + 3] += turn[i] + mpf(c[i])
    # A couple in units of a force at the extent.
    units = [mpf(scale) if r[3] else mpf(1) for r in all_supports]
    a = matrix([[columns[j][i] * units[j] / (scale if i > 2 else 1) for j in range(len(columns))]
                for i in rows])
    b = matrix([-sums[i] / (scale if i > 2 else 1) for i in rows])
    x = lu_solve(a, b)
    return plane, all_supports, loads, [float(v * u) for v, u in zip(x, units)]


def numbers(values):
    return ", ".join(float(v).hex() if v else "0.0" for v in values)


with open("tests/core/statics_cases.h", "w") as out:
    out.write("/* Random determinate structures and their exact reactions: written by\n"
              " * tools/statics-cases.py, with 60-digit linear algebra. */\n"
              "#include \"tables/statics.h\"\n\n"
              "typedef struct statics_case {\n"
              "  int plane;\n  size_t reactions, loads;\n  rot_reaction reaction[6];\n"
              "  double at[12], force[12], couple[12], want[6];\n} statics_case;\n\n"
              "/* clang-format off */\nstatic const statics_case statics_cases[] = {\n")
    for number in range(80):
        plane, all_supports, loads, x = case(number)
        reactions = ", ".join(
            "{{%s}, {%s}, {%s}, %d, 0}" % (numbers(at), numbers(s), numbers(e), c)
            for at, s, e, c in all_supports)
        fields = [numbers([v for load in loads for v in load[i]]) for i in range(3)]
        out.write("{%d, %d, %d, {%s},\n" % (plane, len(all_supports), len(loads), reactions))
        out.write("{%s},\n{%s},\n{%s}, {%s}},\n" % (*fields, numbers(x)))
    out.write("};\n/* clang-format on */\n")
