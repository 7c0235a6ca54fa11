"""Cylindrical cavity under a step of pressure in an infinite isotropic medium, in closed form.

The transform is Selberg's (1952) in the form of FORMULATION 9: with k = s/c_P, in the Laplace domain,

    u_r(r, s) = (p0/s) K1(k r) / [(lambda + 2G) k K0(k a) + (2G/a) K1(k a)].

Everything below is written in the dimensionless radius rho = r/a and the time tau = c_P t/a - (rho - 1) since the front
has arrived. The scaled Bessel functions kve carry the factor exp(-(rho - 1) s) of the delay, so what is inverted is
smooth for tau > 0: the front costs no accuracy.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import kve

from .signals import gaussian_filter_from_front

Array = NDArray[np.float64]

# Contour of Talbot with the coefficients of Trefethen, Weideman and Schmelzer, "Talbot quadratures and rational
# approximations", BIT 46 (2006): s(theta) = (N/t) [mu theta cot(alpha theta) - sigma + nu i theta], -pi < theta < pi.
_MU, _ALPHA, _SIGMA, _NU = 0.5017, 0.6407, 0.6122, 0.2645
# 32 points: for tau up to 10 a/c_P against 40 points the result is the same to 1e-11, up to 20 to 1e-9. Round-off is
# amplified by exp(0.17 N) = 240.
_TALBOT_POINTS = 32
# The transform has a pair of poles near |s| = 1, which have to stay inside the contour, of size N/tau.
_LARGEST_TAU = 20.0


def invert_laplace(transform, times: ArrayLike) -> Array:
    """Inverse Laplace transform at positive times, by the modified Talbot contour.

    `transform` takes and returns complex arrays; its singularities lie on or near the negative real axis.
    """
    times = np.atleast_1d(np.asarray(times, dtype=float))
    if np.any(times <= 0):
        raise ValueError("the contour needs times > 0")
    theta = np.pi * (2 * np.arange(_TALBOT_POINTS // 2) + 1) / _TALBOT_POINTS  # upper half; the lower is its conjugate
    scaled = theta * _ALPHA
    z = _TALBOT_POINTS * (-_SIGMA + _MU * theta / np.tan(scaled) + _NU * 1j * theta)
    dz = _TALBOT_POINTS * (_MU / np.tan(scaled) - _MU * scaled / np.sin(scaled) ** 2 + _NU * 1j)
    weights = np.exp(z) * dz * 2 / (_TALBOT_POINTS * 1j)
    s = z[None, :] / times[:, None]
    return np.real(np.sum(transform(s) * weights, axis=1)) / times


@dataclass(frozen=True)
class CavityStep:
    """Step pressure p0 (Pa) at t = 0 in a cavity of radius a (m); lambda and 2G in Pa, density in kg/m3.

    In Munjiza's constants of an isotropic plane problem lambda = M_v and 2G = M_alpha.
    """

    pressure: float
    radius: float
    lame_lambda: float
    two_g: float
    density: float

    @property
    def c_p(self) -> float:
        """Speed of the compression wave, m/s."""
        return float(np.sqrt((self.lame_lambda + self.two_g) / self.density))

    def arrival(self, r: float) -> float:
        """Time at which the front reaches the radius r, s."""
        return (r - self.radius) / self.c_p

    def _inverted(self, r: float, t: ArrayLike, power: int) -> Array:
        """Inverse of s^(power-1) K1(rho s)/(s K0(s) + q K1(s)) against t, dimensionless; 0 before the front."""
        if r < self.radius:
            raise ValueError(f"r = {r} m lies inside the cavity of radius {self.radius} m")
        rho = r / self.radius
        q = self.two_g / (self.lame_lambda + self.two_g)
        tau = (np.atleast_1d(np.asarray(t, dtype=float)) - self.arrival(r)) * self.c_p / self.radius
        if np.any(tau > _LARGEST_TAU):
            raise ValueError(f"later than {_LARGEST_TAU} a/c_P behind the front: outside the range of the contour")
        result = np.zeros_like(tau)
        behind = tau > 0

        def transform(s):
            return s ** (power - 1) * kve(1, rho * s) / (s * kve(0, s) + q * kve(1, s))

        if np.any(behind):
            result[behind] = invert_laplace(transform, tau[behind])
        return result

    def displacement(self, r: float, t: ArrayLike) -> Array:
        """Radial displacement at r (m, >= a) and times t (s), m. Continuous at the front."""
        return self._inverted(r, t, 0) * self.pressure * self.radius / (self.lame_lambda + self.two_g)

    def velocity(self, r: float, t: ArrayLike) -> Array:
        """Radial velocity, m/s. Jumps by front_jump(r) on arrival; the value at the jump itself is 0."""
        return self._inverted(r, t, 1) * self.pressure * self.c_p / (self.lame_lambda + self.two_g)

    def front_jump(self, r: float) -> float:
        """Jump of the radial velocity on arrival, (p0/rho c_P) sqrt(a/r), m/s."""
        return self.pressure / (self.density * self.c_p) * float(np.sqrt(self.radius / r))

    def filtered_velocity(self, r: float, t: ArrayLike, sigma: float) -> Array:
        """Radial velocity after a Gaussian filter of standard deviation sigma (s) in time, m/s.

        The convolution starts at the front, where the velocity is known exactly, so the jump is integrated exactly.
        """
        return gaussian_filter_from_front(lambda at: self.velocity(r, at), self.arrival(r), t, sigma)

    def filtered_displacement(self, r: float, t: ArrayLike, sigma: float) -> Array:
        """Radial displacement after the same filter, m."""
        return gaussian_filter_from_front(lambda at: self.displacement(r, at), self.arrival(r), t, sigma)
