"""Writes splines.txt: random B-splines and NURBS, evaluated by scipy and by geomdl (NURBS-Python).

    python3 -m venv venv && venv/bin/pip install scipy geomdl && venv/bin/python splines.py

One case a line, of numbers. `curve DEGREE COUNT RATIONAL`, the knots, the control points, the weights of a rational
one; then three times a parameter, the point, its first and its second derivative. `surface DEGREE_U DEGREE_V COUNT_U
COUNT_V RATIONAL`, the knots in u and v, the control points with u running fastest, the weights; then twice u, v, the
point and its derivatives by u, v, uu, uv and vv. All points have three coordinates.
"""

import random
from pathlib import Path

import numpy
from geomdl import BSpline as geomdl_bspline
from geomdl import NURBS as geomdl_nurbs
from scipy.interpolate import BSpline

CURVES, SURFACES = 120, 80


def knots(degree, count, clamped):
    """Random knots over about [0, 1]; some stand twice or more."""
    inner = count - degree - 1
    breaks = sorted(round(random.uniform(0.05, 0.95), 2) for _ in range(inner))
    for i in range(1, inner):
        if random.random() < 0.25 and breaks[:i].count(breaks[i - 1]) < degree:
            breaks[i] = breaks[i - 1]
    breaks.sort()
    for knot in set(breaks):
        if breaks.count(knot) > degree:
            return knots(degree, count, clamped)
    if clamped:
        return [0.0] * (degree + 1) + breaks + [1.0] * (degree + 1)
    before = sorted(round(random.uniform(-0.5, 0.0), 2) for _ in range(degree))
    after = sorted(round(random.uniform(1.0, 1.5), 2) for _ in range(degree))
    return before + [0.0] + breaks + [1.0] + after


def points(count):
    return [[round(random.uniform(-10, 10), 2) for _ in range(3)] for _ in range(count)]


def weights(count):
    return [round(random.uniform(0.2, 4.0), 2) for _ in range(count)]


def line(name, integers, *lists):
    numbers = [x for values in lists for x in numpy.ravel(values)]
    return " ".join([name, *map(str, integers), *(f"{float(x)!r}" for x in numbers)])


def curve(number):
    degree = random.randint(1, 7)
    count = degree + 1 + random.randint(0, 5)
    rational = number % 2
    own, control = knots(degree, count, rational or number % 4), points(count)
    at = [round(random.uniform(0, 1), 3) for _ in range(3)]
    at[0] = random.choice([0.0, 0.5, 1.0]) if not rational else at[0]
    if rational:
        weight = weights(count)
        spline = geomdl_nurbs.Curve(normalize_kv=False)
        spline.degree, spline.ctrlpts, spline.weights = degree, control, weight
        spline.knotvector = own
        values = [[t] + list(numpy.ravel(spline.derivatives(t, order=2))) for t in at]
    else:
        weight = []
        spline = BSpline(own, control, degree)
        values = [[t] + [x for order in range(3) for x in spline(t, nu=order)] for t in at]
    return line("curve", [degree, count, rational], own, control, weight, values)


def surface(number):
    degrees = [random.randint(1, 4) for _ in range(2)]
    counts = [degree + 1 + random.randint(0, 2) for degree in degrees]
    rational = number % 2
    own = [knots(degree, count, True) for degree, count in zip(degrees, counts)]
    control = points(counts[0] * counts[1])
    weight = weights(len(control)) if rational else []
    # In geomdl v runs fastest.
    order = [j * counts[0] + i for i in range(counts[0]) for j in range(counts[1])]
    spline = (geomdl_nurbs if rational else geomdl_bspline).Surface(normalize_kv=False)
    spline.degree_u, spline.degree_v = degrees
    spline.ctrlpts_size_u, spline.ctrlpts_size_v = counts
    spline.ctrlpts = [control[k] for k in order]
    if rational:
        spline.weights = [weight[k] for k in order]
    spline.knotvector_u, spline.knotvector_v = own
    values = []
    for _ in range(2):
        u, v = (round(random.uniform(0, 1), 3) for _ in range(2))
        by = spline.derivatives(u, v, order=2)
        values.append([u, v, *by[0][0], *by[1][0], *by[0][1], *by[2][0], *by[1][1], *by[0][2]])
    return line("surface", [*degrees, *counts, rational], *own, control, weight, values)


random.seed(5)
lines = [curve(i) for i in range(CURVES)] + [surface(i) for i in range(SURFACES)]
Path(__file__).with_name("splines.txt").write_text("\n".join(lines) + "\n")
