"""Taylor models against arithmetic with forty digits: no function may leave its model."""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
import pytest

import mcplan
from mcplan import sip

DIGITS = 40


class Case:
    """A function as a Taylor model, and its true values at a few places."""

    def __init__(self, model: sip.TaylorModel, values: list[mp.mpf], degree: int | None = None) -> None:
        self.model, self.values = model, values
        self.degree = degree  # of a polynomial; None: something else

    def __add__(self, other: Case) -> Case:
        return Case(self.model + other.model, [a + b for a, b in zip(self.values, other.values, strict=True)])

    def __sub__(self, other: Case) -> Case:
        return Case(self.model - other.model, [a - b for a, b in zip(self.values, other.values, strict=True)])

    def __mul__(self, other: Case) -> Case:
        return Case(self.model * other.model, [a * b for a, b in zip(self.values, other.values, strict=True)])

    def sine(self) -> Case:
        return Case(self.model.sine(), [mp.sin(a) for a in self.values])

    def cosine(self) -> Case:
        return Case(self.model.cosine(), [mp.cos(a) for a in self.values])

    def scaled(self, factor: float) -> Case:
        return Case(self.model.scaled(factor), [a * mp.mpf(factor) for a in self.values])

    def negated(self) -> Case:
        return Case(-self.model, [-a for a in self.values])


def exact(coefficients: np.ndarray, s: float) -> mp.mpf:
    """Value of a polynomial, coefficients and place taken as the exact numbers that they are."""
    value = mp.mpf(0)
    for a in coefficients[::-1]:
        value = value * s + float(a)
    return value


def escapes(case: Case, places: list[float]) -> bool:
    """Whether the function is further from the polynomial than the remainder, or outside the range, anywhere."""
    coefficients, remainder = case.model.coefficients, mp.mpf(case.model.remainder)
    low, high = (mp.mpf(bound) for bound in case.model.range())
    for s, value in zip(places, case.values, strict=True):
        at_low, at_high = case.model.at(s)
        if abs(value - exact(coefficients, s)) > remainder or not low <= value <= high:
            return True
        if not at_low <= value <= at_high:
            return True
    return False


def draw_polynomial(rng: np.random.Generator, order: int, places: list[float], degree: int) -> Case:
    size = 10.0 ** rng.uniform(-3, 0.3)
    a = size * rng.normal(size=degree + 1)
    return Case(sip.TaylorModel(a, order), [exact(a, s) for s in places], degree)


def draw_composition(rng: np.random.Generator, order: int, places: list[float]) -> Case:
    """Sums, differences and products of sines and cosines of cubics and of polynomials, up to three levels deep."""

    def leaf() -> Case:
        p = draw_polynomial(rng, order, places, int(rng.integers(0, 4)))
        return [p, p.sine(), p.cosine()][rng.integers(3)] if rng.random() < 0.9 else p.sine().cosine()

    case = leaf()
    for _ in range(rng.integers(1, 5)):
        other = leaf() if rng.random() < 0.7 else leaf() * leaf()
        kind = rng.integers(5)
        if kind == 0:
            case = case + other
        elif kind == 1:
            case = case - other
        elif kind == 2:
            case = case.scaled(float(10.0 ** rng.uniform(-2, 3))).negated()
        else:
            case = case * other
    return case


def draw_integral(rng: np.random.Generator, order: int, places: list[float]) -> Case:
    """Integral of a product of two polynomials and of a sine of a line, whose integrals have closed forms."""
    a, b = rng.normal(size=rng.integers(1, 6)), rng.normal(size=rng.integers(1, 6))
    model = sip.TaylorModel(a, order) * sip.TaylorModel(b, order)
    exact_a, exact_b = ([mp.mpf(float(x)) for x in p] for p in (a, b))
    product = [mp.mpf(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(exact_a):
        for j, y in enumerate(exact_b):
            product[i + j] += x * y
    line = rng.normal(size=2)
    model = (model + sip.TaylorModel(line, order).sine()).integral()
    c, d = (mp.mpf(float(x)) for x in line)
    values = []
    for s in map(mp.mpf, places):
        of_product = sum(x * s ** (k + 1) / (k + 1) for k, x in enumerate(product))
        values.append(of_product + (mp.cos(c) - mp.cos(c + d * s)) / d)
    return Case(model, values)


@pytest.mark.parametrize(
    ("draw", "count", "seed"),
    [(draw_composition, 2500, 1), (draw_integral, 1500, 2)],
    ids=["compositions", "integrals"],
)
def test_no_function_leaves_its_model(draw, count, seed):
    rng = np.random.default_rng(seed)
    with mp.workdps(DIGITS):
        for index in range(count):
            order = int(rng.integers(2, 13))
            places = [-1.0, 1.0, float(rng.uniform(-1, 1))]
            case = draw(rng, order, places)
            assert not escapes(case, places), f"case {index} of seed {seed}, order {order}: {case.model!r}"


def test_integrals_of_sines_of_cubics_stay_in_their_models():
    rng = np.random.default_rng(3)
    with mp.workdps(25):
        for _ in range(40):
            a = 0.5 * rng.normal(size=4)
            s = float(rng.uniform(-1, 1))
            model = sip.TaylorModel(a, 10).sine().integral()
            truth = mp.quad(lambda x, a=a: mp.sin(exact(a, x)), [0, s])
            assert abs(truth - exact(model.coefficients, s)) <= model.remainder
            assert not escapes(Case(model, [truth]), [s])


@pytest.mark.parametrize("order", [2, 5, 8, 12])
def test_remainder_of_a_sine_is_not_far_above_the_true_one(order):
    """For sin(x + s) with x = 0 the series' own tail is what remains, up to the terms that happen to be zero."""
    a = np.array([math.pi / 4, 0.5])
    model = sip.TaylorModel(a, order).sine()
    with mp.workdps(DIGITS):
        true = max(abs(mp.sin(exact(a, s)) - exact(model.coefficients, s)) for s in np.linspace(-1, 1, 101))
    assert float(true) <= model.remainder <= 3.0 * float(true) + 1e-14


def test_rounding_is_carried_apart_and_is_small():
    model = sip.TaylorModel([0.3, 0.1, -0.05, 0.02], 12).sine()
    square = model * model
    assert 0.0 < square.rounding < 1e-13
    assert square.truncation < 1e-7
    assert square.remainder == square.truncation + square.rounding


def test_a_known_error_of_a_factor_is_counted():
    model = sip.TaylorModel([1.0, 2.0], 3).scaled(0.1, 1e-3)
    assert model.range()[1] >= 3.0 * 0.101
    assert model.range()[1] <= 3.0 * 0.101 + 1e-12


def test_bad_models_are_refused():
    with pytest.raises(mcplan.errors.InvalidOptions, match="order"):
        sip.TaylorModel([1.0], 13)
    with pytest.raises(mcplan.InvalidInput, match="coefficients"):
        sip.TaylorModel([], 3)
    with pytest.raises(mcplan.InvalidInput, match="coefficients"):
        sip.TaylorModel(np.zeros(14), 3)
    with pytest.raises(mcplan.InvalidInput, match="order"):
        sip.TaylorModel([1.0], 3) + sip.TaylorModel([1.0], 4)
