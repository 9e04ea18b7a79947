#!/usr/bin/env python3
"""Fits the polynomials of math_f32.h: weighted least squares on Chebyshev nodes, Lawson's reweighting towards the
minimax polynomial, coefficients rounded to the working format one at a time, lowest first, the rest refitted.
Needs mpmath. Prints each kernel's coefficients, lowest first, and the greatest relative error of the whole."""
import struct
import mpmath as mp

mp.mp.dps = 40


def to_float(x):
    return mp.mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def to_double(x):
    return mp.mpf(float(x))


def solve(nodes, values, weights, powers):
    """Least squares of sum c_i x^powers[i] against values."""
    n = len(powers)
    matrix, right = mp.zeros(n), mp.zeros(n, 1)
    for x, v, w in zip(nodes, values, weights):
        row = [x ** p for p in powers]
        for i in range(n):
            right[i] += w * row[i] * v
            for j in range(n):
                matrix[i, j] += w * row[i] * row[j]
    return [c for c in mp.lu_solve(matrix, right)]


def fit(name, target, weight, low, high, degree, rounding, whole):
    count = 12 * (degree + 1)
    nodes = [(low + high) / 2 + (high - low) / 2 * mp.cos(mp.pi * (k + mp.mpf(1) / 2) / count) for k in range(count)]
    values = [target(x) for x in nodes]
    base = [weight(x) ** 2 for x in nodes]
    fixed = []
    for first in range(degree + 1):
        rest = [v - sum(c * x ** i for i, c in enumerate(fixed)) for x, v in zip(nodes, values)]
        lawson = [mp.mpf(1)] * count
        for _ in range(12):
            weights = [b * l for b, l in zip(base, lawson)]
            found = solve(nodes, rest, weights, range(first, degree + 1))
            errors = [abs(mp.sqrt(b) * (r - sum(c * x ** (first + i) for i, c in enumerate(found))))
                      for b, x, r in zip(base, nodes, rest)]
            total = sum(l * e for l, e in zip(lawson, errors))
            if total == 0:
                break
            lawson = [l * e / total + mp.mpf(10) ** -12 for l, e in zip(lawson, errors)]
        fixed.append(rounding(found[0]))
    worst = max(abs(whole(x, sum(c * x ** i for i, c in enumerate(fixed)))) for x in nodes)
    print(f"{name}: error {mp.nstr(worst, 3)} = 2^{mp.nstr(mp.log(worst, 2), 4)}")
    print("  {" + ", ".join(float(c).hex() for c in fixed) + "}")


EPS = mp.mpf(10) ** -9


def odd(name, f, limit, degree, rounding=to_float):
    """f(x) = x + x z P(z), z = x^2"""
    fit(name, lambda z: (f(mp.sqrt(z)) / mp.sqrt(z) - 1) / z, lambda z: z * mp.sqrt(z) / f(mp.sqrt(z)), EPS, limit ** 2, degree,
        rounding, lambda z, p: (1 + z * p) * mp.sqrt(z) / f(mp.sqrt(z)) - 1)


QUARTER = mp.pi / 4 * mp.mpf("1.0001")
odd("sin", mp.sin, QUARTER, 2)
fit("cos: 1 - z/2 + z^2 P(z), z = x^2", lambda z: (mp.cos(mp.sqrt(z)) - 1 + z / 2) / z ** 2, lambda z: z ** 2, EPS, QUARTER ** 2, 2,
    to_float, lambda z, p: (1 - z / 2 + z * z * p) / mp.cos(mp.sqrt(z)) - 1)
odd("tan", mp.tan, QUARTER, 6)
odd("asin", mp.asin, mp.mpf("0.5"), 4)

odd("atan", mp.atan, mp.mpf(1), 8)
HALF_LN2 = mp.log(2) / 2 * mp.mpf("1.0001")
fit("exp: 1 + x + x^2 P(x)", lambda x: (mp.exp(x) - 1 - x) / x ** 2, lambda x: x ** 2 / mp.exp(x), -HALF_LN2, HALF_LN2, 4, to_float,
    lambda x, p: (1 + x + x * x * p) / mp.exp(x) - 1)
fit("log(1+x): x + x^2 (-1/2 + x P(x))", lambda x: ((mp.log(1 + x) - x) / x ** 2 + mp.mpf(1) / 2) / x,
    lambda x: abs(x ** 3 / mp.log(1 + x)), mp.sqrt(2) / 2 - 1, mp.sqrt(2) - 1, 7, to_float,
    lambda x, p: (x + x * x * (-mp.mpf(1) / 2 + x * p)) / mp.log(1 + x) - 1)
LIMIT = ((mp.sqrt(2) - 1) / (mp.sqrt(2) + 1)) ** 2
fit("log2((1+s)/(1-s)) = s P(s^2), double", lambda z: 2 * mp.atanh(mp.sqrt(z)) / mp.sqrt(z) / mp.log(2), lambda z: mp.mpf(1) / 3,
    EPS, LIMIT, 5, to_double, lambda z, p: p * mp.sqrt(z) * mp.log(2) / 2 / mp.atanh(mp.sqrt(z)) - 1)
fit("2^x, double", lambda x: mp.mpf(2) ** x, lambda x: mp.mpf(2) ** -x, -mp.mpf("0.5001"), mp.mpf("0.5001"), 7, to_double,
    lambda x, p: p / mp.mpf(2) ** x - 1)
for name, value, parts in (("pi", mp.pi, 2), ("pi/2", mp.pi / 2, 3), ("ln 2", mp.log(2), 2)):
    split = []
    for _ in range(parts):  # rounded downwards, so that all parts are positive
        unit = mp.mpf(2) ** (mp.floor(mp.log(value, 2)) - 23)
        split.append(mp.floor(value / unit) * unit)
        value -= split[-1]
    print(name, "=", " + ".join(float(c).hex() for c in split))
mp.mp.dps = 90
bits = int(mp.floor(mp.mpf(2) ** 224 / mp.pi))
print("1/pi in words of 32 bits:", ", ".join(f"0x{(bits >> (192 - 32 * i)) & 0xffffffff:08x}" for i in range(7)))
