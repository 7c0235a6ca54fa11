"""The cohesion law of FORMULATION 7, written from the formulas alone, to judge the program's by.

Along a path of opening o and slip s the law's damage grows by dD = q(omega) d lambda. Here that is integrated by short
steps of the midpoint rule; in pure modes and constant mixes the program's own steps are exact.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

A, B, C = 0.63, 1.8, 6.0  # Munjiza, Andrews and White (1999)
SOFTENING_INTEGRAL = 0.3863073


def softening(damage: ArrayLike) -> Array:
    """z(D), 1 at D = 0, 0 at D = 1."""
    d = np.minimum(np.asarray(damage, dtype=float), 1.0)
    exponent = d * (A + C * B) / ((A + B) * (1 - A - B))
    return (1 - (A + B - 1) / (A + B) * np.exp(exponent)) * (A * (1 - d) + B * (1 - d) ** C)


@dataclass(frozen=True)
class Properties:
    """Of a joint, SI units."""

    tensile: float
    cohesion: float
    friction: float
    residual_friction: float
    G_I: float
    G_II: float
    penalty: float  # k, Pa/m
    extrinsic: bool = False  # it begins at the envelope, its springs loaded

    @property
    def opening_at_peak(self) -> float:
        return self.tensile / self.penalty

    @property
    def slip_at_peak(self) -> float:
        return self.cohesion / self.penalty

    def elastic_ratio(self, omega: ArrayLike) -> Array:
        """B of FORMULATION 7."""
        omega = np.asarray(omega, dtype=float)
        return (self.tensile * self.opening_at_peak * omega / self.G_I
                + self.cohesion * self.slip_at_peak * (1 - omega) / self.G_II)

    def rate(self, omega: ArrayLike) -> Array:
        """q = dD/d lambda."""
        b = self.elastic_ratio(omega)
        return SOFTENING_INTEGRAL * b / (1 if self.extrinsic else 1 - b / 2)

    def last_lambda(self, omega: float) -> float:
        """lambda at which D reaches 1 on a ray of constant omega."""
        return 1 + 1 / float(self.rate(omega))


@dataclass(frozen=True)
class Answer:
    """Along a path, one value per point."""

    normal: Array    # Pa, tension positive
    shear: Array     # Pa, cohesion and friction
    friction: Array  # Pa, the part of it that is friction
    damage: Array


def traction(p: Properties, opening: ArrayLike, slip: ArrayLike, start: tuple[float, float] = (0.0, 0.0)) -> Answer:
    """Along a path whose points are close to each other. Opening while friction acts is not asked for here.
    start: of an extrinsic joint, normal and shear traction at o = s = 0, on the envelope, Pa."""
    o_all, s_all = np.asarray(opening, dtype=float), np.asarray(slip, dtype=float)
    normal, shear, friction, damage = (np.zeros_like(o_all) for _ in range(4))
    parted, share, slider, d, lam_max = False, 0.0, 0.0, 0.0, 1.0
    x_old = y_old = 0.0
    if p.extrinsic:
        parted = True
        rubs = float(np.sign(start[1])) * min(p.friction * max(-start[0], 0.0), abs(start[1]))
        o_all = o_all + start[0] / p.penalty
        share = -(start[1] - rubs) / p.penalty
        slider = -rubs / p.penalty
        x_old, y_old = max(start[0], 0.0) / p.tensile, (start[1] - rubs) / p.cohesion
    for i, (o, s) in enumerate(zip(o_all, s_all)):
        closing = p.penalty * max(-o, 0.0)
        if not parted:
            inside = (max(o, 0.0) / p.opening_at_peak) ** 2 + \
                (max(abs(p.penalty * s) - p.friction * closing, 0.0) / p.cohesion) ** 2 <= 1
            if inside:
                normal[i], shear[i] = p.penalty * o, p.penalty * s
                x_old, y_old = max(o, 0.0) / p.opening_at_peak, s / p.slip_at_peak
                continue
            parted = True
            share = float(np.sign(s)) * min(p.friction * closing / p.penalty, abs(s))
            slider = s - share  # the friction spring carries what friction may carry
            y_old -= share / p.slip_at_peak
        x, y = max(o, 0.0) / p.opening_at_peak, (s - share) / p.slip_at_peak
        lam = float(np.hypot(x, y))
        if lam > lam_max:
            middle = np.hypot((x + x_old) / 2, (y + y_old) / 2)
            omega = ((x + x_old) / 2 / middle) ** 2
            d = min(1.0, d + float(p.rate(omega)) * (lam - lam_max))
            lam_max = lam
        x_old, y_old = x, y
        limit = (p.friction + (p.residual_friction - p.friction) * d) * closing
        spring = p.penalty * (s - slider)
        if abs(spring) > limit:
            slider = s - np.sign(spring) * limit / p.penalty
            spring = np.sign(spring) * limit
        secant = float(softening(d)) / lam_max * p.penalty
        normal[i] = secant * max(o, 0.0) - closing
        friction[i] = spring
        shear[i] = secant * (s - share) + spring
        damage[i] = d
    return Answer(normal, shear, friction, damage)


def along(points: list[tuple[float, float]], n: int) -> tuple[Array, Array]:
    """Straight ways between points, n steps each."""
    corners = np.asarray(points, dtype=float)
    ways = [corners[i] + np.linspace(0, 1, n + 1)[1:, None] * (corners[i + 1] - corners[i])
            for i in range(len(corners) - 1)]
    path = np.vstack([corners[:1], *ways])
    return path[:, 0], path[:, 1]
